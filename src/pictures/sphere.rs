//! A mirror sphere under an environment, seen from afar.
//!
//! A point at r of the radius has the angle of incidence asin r. Pixels hold the mean of their samples.

use glam::DVec3;

use super::scene::Environment;

/// The samples of a sphere: for each, its pixel, its angle of incidence in radians, and the light that it mirrors.
#[derive(Clone, Debug)]
pub struct Sphere {
    /// Pixels across and down.
    pub size: u32,
    /// The share of each pixel that shows the sphere.
    pub coverage: Vec<f64>,
    samples: Vec<(u32, f64, DVec3)>,
}

/// Samples along each side of a pixel.
const SAMPLES: u32 = 3;
/// The space around the sphere, as a share of half of the picture.
const MARGIN: f64 = 0.04;

impl Sphere {
    /// A sphere under an environment.
    pub fn new(size: u32, environment: &Environment) -> Sphere {
        let side = size * SAMPLES;
        let place = |i: u32| (2.0 * (f64::from(i) + 0.5) / f64::from(side) - 1.0) / (1.0 - MARGIN);
        let mut coverage = vec![0.0; (size * size) as usize];
        let mut samples = Vec::new();
        for row in 0..side {
            for column in 0..side {
                let (x, y) = (place(column), -place(row));
                let square = x * x + y * y;
                if square >= 1.0 {
                    continue;
                }
                let pixel = row / SAMPLES * size + column / SAMPLES;
                // The eye looks along -z.
                let normal = DVec3::new(x, y, (1.0 - square).sqrt());
                let mirrored = 2.0 * normal.z * normal - DVec3::Z;
                let light = environment.radiance(mirrored);
                coverage[pixel as usize] += f64::from(SAMPLES * SAMPLES).recip();
                samples.push((pixel, libm::asin(square.sqrt()), light));
            }
        }
        Sphere {
            size,
            coverage,
            samples,
        }
    }

    /// The radiance of each pixel of a sphere with this reflectance at equal steps of the angle, 0 to 90 degrees. What is around it is
    /// black.
    pub fn drawn(&self, curve: &[[f64; 3]]) -> Vec<DVec3> {
        let last = curve.len() - 1;
        let mut pixels = vec![DVec3::ZERO; self.coverage.len()];
        let weight = f64::from(SAMPLES * SAMPLES).recip();
        for (pixel, angle, light) in &self.samples {
            let at = angle / std::f64::consts::FRAC_PI_2 * last as f64;
            let lower = (at as usize).min(last - 1);
            let [low, high] = [curve[lower], curve[lower + 1]].map(DVec3::from_array);
            pixels[*pixel as usize] += weight * *light * low.lerp(high, at - lower as f64);
        }
        pixels
    }

    /// The light that each sample mirrors.
    pub fn lights(&self) -> impl Iterator<Item = DVec3> {
        self.samples.iter().map(|(_, _, light)| *light)
    }

    /// Whether each pixel shows nothing but the sphere.
    pub fn is_whole(&self) -> Vec<bool> {
        self.coverage.iter().map(|share| *share > 0.999).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_in_a_white_room_is_white_and_a_sphere_fills_its_share() {
        let white = Environment::baked(8, |_| DVec3::ONE);
        let sphere = Sphere::new(64, &white);
        let drawn = sphere.drawn(&[[1.0; 3]; 3]);
        let whole = sphere.is_whole();
        for (pixel, whole) in drawn.iter().zip(&whole) {
            assert!(!whole || (*pixel - DVec3::ONE).length() < 1e-9);
        }
        let share = sphere.coverage.iter().sum::<f64>() / (64.0 * 64.0);
        let area = std::f64::consts::FRAC_PI_4 * (1.0 - MARGIN).powi(2);
        assert!((share - area).abs() < 0.002, "{share} {area}");
    }

    #[test]
    fn the_middle_shows_0_degrees_and_the_rim_90() {
        let white = Environment::baked(8, |_| DVec3::ONE);
        let sphere = Sphere::new(65, &white);
        let drawn = sphere.drawn(&[[0.0; 3], [1.0; 3]]);
        assert!(drawn[65 * 32 + 32].x < 0.02);
        assert!(drawn[65 * 32 + 62].x > 0.7, "{}", drawn[65 * 32 + 62].x);
    }
}
