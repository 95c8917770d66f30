//! Light that surrounds a drawn scene, blurred for rough surfaces.
//!
//! ```text
//! rough surfaces: the table of the environment with texels as large as the lobe of GGX, 2 π / rows² = 4 π α², α = roughness²
//! ```
//!
//! The width of a lobe is that of a uniform lobe with the density of its peak: seen head-on, D / 4 = 1 / (4 π α²). Tables are
//! halved until the texels are that large. Between two tables the light is linear in the logarithm of their rows. Source: M.
//! Colbert, J. Křivánek, *GPU-Based Importance Sampling*, GPU Gems 3, 2007, section 20.4,
//! <https://developer.nvidia.com/gpugems/gpugems3/part-iii-rendering/chapter-20-gpu-based-importance-sampling>, with one
//! sample, in the mirrored direction. Lobes are taken as round, although at grazing angles they are stretched.

use glam::DVec3;

use crate::pictures::scene::Environment;

/// Light that comes from everywhere around a scene, in the working space, linear.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneLight {
    /// The same from all directions.
    Uniform([f32; 3]),
    /// From an environment.
    Environment(Box<BlurredEnvironment>),
}

impl SceneLight {
    /// The light of an environment.
    pub fn of_environment(environment: Environment) -> SceneLight {
        SceneLight::Environment(Box::new(BlurredEnvironment::new(environment)))
    }

    /// The light from a direction that a surface of a perceptual roughness in [0, 1] mirrors to the camera.
    pub fn along(&self, direction: DVec3, roughness: f64) -> [f32; 3] {
        match self {
            SceneLight::Uniform(light) => *light,
            SceneLight::Environment(environment) => {
                let light = environment.radiance(direction, roughness);
                light.to_array().map(|channel| channel as f32)
            }
        }
    }

    /// The mean over all directions.
    pub fn mean(&self) -> [f32; 3] {
        match self {
            SceneLight::Uniform(light) => *light,
            SceneLight::Environment(environment) => environment.mean(),
        }
    }
}

/// An environment, and smaller versions of it down to two rows.
#[derive(Clone, Debug, PartialEq)]
pub struct BlurredEnvironment {
    tables: Vec<Environment>,
}

impl BlurredEnvironment {
    /// All tables of an environment.
    pub fn new(environment: Environment) -> BlurredEnvironment {
        let tables = std::iter::successors(Some(environment), Environment::halved);
        BlurredEnvironment {
            tables: tables.collect(),
        }
    }

    /// The mean over all directions.
    pub fn mean(&self) -> [f32; 3] {
        let [left, right] = [0, 1].map(|at| self.tables[self.tables.len() - 1].table.texels()[at]);
        [0, 1, 2].map(|channel| (left[channel] + right[channel]) / 2.0)
    }

    /// The radiance from a direction, blurred by the lobe of a perceptual roughness in [0, 1].
    pub fn radiance(&self, direction: DVec3, roughness: f64) -> DVec3 {
        let alpha = roughness * roughness;
        let rows = std::f64::consts::FRAC_1_SQRT_2 / alpha;
        let finest = self.tables[0].table.size()[1] as f64;
        // A mirror's lobe has no width, so that no finite table would be fine enough.
        if rows >= finest {
            return self.tables[0].radiance(direction);
        }
        let level = libm::log2(finest / rows).min((self.tables.len() - 1) as f64);
        let (finer, share) = (level.floor(), level.fract());
        let coarser = &self.tables[level.ceil() as usize];
        let finer = self.tables[finer as usize].radiance(direction);
        finer.lerp(coarser.radiance(direction), share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_sees_the_table_and_a_rough_surface_its_mean() {
        let half = |direction: DVec3| DVec3::splat(f64::from(u8::from(direction.y > 0.0)));
        let blurred = BlurredEnvironment::new(Environment::baked(64, half));
        let at = |y: f64, roughness: f64| {
            let direction = DVec3::new(1.0 - y.abs(), y, 0.1);
            blurred.radiance(direction, roughness).x
        };
        assert_eq!([at(0.3, 0.0), at(-0.3, 0.0)], [1.0, 0.0]);
        assert_eq!([at(0.9, 0.2), at(-0.9, 0.2)], [1.0, 0.0]);
        for y in [-0.9, 0.0, 0.9] {
            assert!((at(y, 1.0) - 0.5).abs() < 1e-3, "{}", at(y, 1.0));
        }
        // The light from a direction near the edge falls as the lobe grows.
        let sinking: Vec<f64> = (0..=10).map(|i| at(0.3, f64::from(i) / 10.0)).collect();
        assert!(sinking.is_sorted_by(|a, b| a + 1e-9 >= *b), "{sinking:?}");
    }
}
