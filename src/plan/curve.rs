//! Reflectance over all angles, and its mean over a rough surface, as tables that pixels look up.
//!
//! A table has a value at each of 8192 equal steps of angle and is linear between: it is off by less than 2e-7 times the second
//! derivative in radians. The mean over GGX is linear in F, so that what its coarser table leaves out is left out of every function
//! alike.

use crate::num::each_channel;
use crate::optics::Ggx;
use crate::reference::cosine_of_part;

use super::pixels::ScenePixel;

/// Steps of angle between 0 and 90 degrees.
pub const STEPS: usize = 8192;
/// The same of rough surfaces, and steps of roughness between 0 and 1.
const ROUGH_STEPS: usize = 128;
const LEVELS: usize = 32;

/// The cosines of all steps, from 1 to 0.
pub fn step_cosines() -> Vec<f64> {
    (0..=STEPS)
        .map(|step| cosine_of_part(step, STEPS))
        .collect()
}

/// A place in a table: between a step and the next one.
#[derive(Clone, Copy, Debug)]
struct Place {
    step: u32,
    share: f32,
}

impl Place {
    fn of(cos_theta: f64, steps: usize) -> Place {
        let angle = libm::acos(cos_theta.clamp(0.0, 1.0)) / std::f64::consts::FRAC_PI_2;
        let at = angle * steps as f64;
        let step = (at as usize).min(steps - 1);
        Place {
            step: step as u32,
            share: (at - step as f64) as f32,
        }
    }

    fn of_table(self, table: &[[f64; 3]]) -> [f64; 3] {
        let [one, next] = [0, 1].map(|i| table[self.step as usize + i]);
        let share = f64::from(self.share);
        each_channel(|i| one[i] + share * (next[i] - one[i]))
    }
}

/// Where a pixel looks a function's values up: the same place for every function.
#[derive(Clone, Copy, Debug)]
pub struct PixelPlace {
    mirror: Place,
    /// The level of roughness, and the share of the next one; none for a mirror.
    rough: Option<(Place, usize, f64)>,
}

impl PixelPlace {
    /// The place of a pixel.
    pub fn of(pixel: &ScenePixel) -> PixelPlace {
        PixelPlace::at(f64::from(pixel.cos_theta), f64::from(pixel.roughness))
    }

    /// The place of a cosine and a perceptual roughness.
    pub fn at(cos_theta: f64, roughness: f64) -> PixelPlace {
        let at = roughness.clamp(0.0, 1.0) * LEVELS as f64;
        let level = (at as usize).min(LEVELS - 1);
        let rough = || (Place::of(cos_theta, ROUGH_STEPS), level, at - level as f64);
        PixelPlace {
            mirror: Place::of(cos_theta, STEPS),
            rough: (at > 0.0).then(rough),
        }
    }

    /// The levels whose tables it reads.
    fn levels(&self) -> impl Iterator<Item = usize> + use<> {
        let pair = self.rough.map(|(_, level, _)| [level, level + 1]);
        pair.into_iter().flatten().filter(|level| *level > 0)
    }
}

/// Half vectors under which a rough surface is seen, with their weights.
type HalfVectors = Vec<(Place, f64)>;

/// The rule of the mean for the levels of roughness that occur.
pub struct RoughRule {
    /// For each level that occurs, for each step the places and weights of half vectors.
    points: Vec<Option<Vec<HalfVectors>>>,
}

impl RoughRule {
    /// For the levels that these places need.
    pub fn of<'a>(places: impl Iterator<Item = &'a PixelPlace>) -> RoughRule {
        let mut is_needed = [false; LEVELS + 1];
        for level in places.flat_map(PixelPlace::levels) {
            is_needed[level] = true;
        }
        let rule = Ggx::default();
        let points = |level: usize| is_needed[level].then(|| level_points(&rule, level));
        RoughRule {
            points: (0..=LEVELS).map(points).collect(),
        }
    }
}

fn level_points(rule: &Ggx, level: usize) -> Vec<HalfVectors> {
    let roughness = level as f64 / LEVELS as f64;
    let step = |step: usize| {
        let mut points = Vec::new();
        let cos_v = cosine_of_part(step, ROUGH_STEPS);
        rule.each(cos_v, roughness * roughness, |cos_h, weight| {
            points.push((Place::of(cos_h, STEPS), weight));
        });
        points
    };
    (0..=ROUGH_STEPS).map(step).collect()
}

/// A function's values over all angles and the levels of roughness that occur.
#[derive(Clone, Debug)]
pub struct Curve {
    mirror: Vec<[f64; 3]>,
    rough: Vec<Option<Vec<[f64; 3]>>>,
}

impl Curve {
    /// From values at [`step_cosines`].
    pub fn new(mirror: Vec<[f64; 3]>, rule: &RoughRule) -> Curve {
        let mean = |points: &HalfVectors| {
            let mut sum = [0.0; 3];
            for (place, weight) in points {
                let value = place.of_table(&mirror);
                sum = each_channel(|i| sum[i] + weight * value[i]);
            }
            sum
        };
        let level = |points: &Option<Vec<HalfVectors>>| {
            let steps = points.as_ref()?;
            Some(steps.iter().map(mean).collect())
        };
        Curve {
            rough: rule.points.iter().map(level).collect(),
            mirror,
        }
    }

    /// The value of a pixel.
    pub fn at(&self, place: &PixelPlace) -> [f64; 3] {
        let Some((rough, level, share)) = place.rough else {
            return place.mirror.of_table(&self.mirror);
        };
        let value = |level: usize| match self.rough.get(level).and_then(Option::as_ref) {
            Some(table) => rough.of_table(table),
            // Level 0 is the mirror.
            None => place.mirror.of_table(&self.mirror),
        };
        let [one, next] = [value(level), value(level + 1)];
        each_channel(|i| one[i] + share * (next[i] - one[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schlick(c: f64) -> [f64; 3] {
        let x = 1.0 - c;
        [0.0, 0.04, 0.5].map(|f0| f0 + (1.0 - f0) * x.powi(5))
    }

    fn curve(places: &[PixelPlace]) -> Curve {
        let values = step_cosines().into_iter().map(schlick).collect();
        Curve::new(values, &RoughRule::of(places.iter()))
    }

    #[test]
    fn a_table_is_the_function() {
        let curve = curve(&[]);
        for i in 0..=1000 {
            let c = f64::from(i) / 1000.0;
            let got = curve.at(&PixelPlace::at(c, 0.0));
            let off = each_channel(|i| (got[i] - schlick(c)[i]).abs());
            assert!(off.iter().all(|off| *off < 3e-7), "{c}: {off:?}");
        }
    }

    #[test]
    fn a_rough_surface_takes_the_mean_over_half_vectors() {
        let places: Vec<PixelPlace> = [0.05, 0.3, 0.5, 0.77, 1.0]
            .iter()
            .flat_map(|r| [0.0, 0.1, 0.5, 0.9, 1.0].map(|c| PixelPlace::at(c, *r)))
            .collect();
        let curve = curve(&places);
        let rule = Ggx::default();
        for (i, place) in places.iter().enumerate() {
            let roughness = [0.05, 0.3, 0.5, 0.77, 1.0][i / 5];
            let cos_v = [0.0, 0.1, 0.5, 0.9, 1.0][i % 5];
            let mut want = 0.0;
            rule.each(cos_v, roughness * roughness, |c, w| {
                want += w * schlick(c)[1]
            });
            let got = curve.at(place)[1];
            // Linear between levels of roughness.
            assert!(
                (got - want).abs() < 0.006,
                "{roughness} {cos_v}: {got} {want}"
            );
        }
    }
}
