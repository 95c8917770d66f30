//! The thesis's measure of functions (section 5.2), for lookup tables: the mean relative difference from the exact law at angles
//! that are even from 0 to 90 degrees.

use crate::generator::reference::{ReferenceCurve, reference_reflectance};
use crate::language::ir::Weights;

use super::depth::Stored;

/// The exact law at the middles of equal steps of angle: cosines, and reflectance in three channels.
pub struct ThesisMeasure(Vec<(f64, [f64; 3])>);

impl ThesisMeasure {
    /// At so many angles.
    pub fn new(reference: &ReferenceCurve, angles: usize) -> ThesisMeasure {
        ThesisMeasure::part(reference, 0..angles, angles)
    }

    /// At some of these angles.
    fn part(
        reference: &ReferenceCurve,
        some: std::ops::Range<usize>,
        angles: usize,
    ) -> ThesisMeasure {
        let at = |i: usize| {
            let theta = (i as f64 + 0.5) / angles as f64 * std::f64::consts::FRAC_PI_2;
            let cos_theta = libm::cos(theta);
            (
                cos_theta,
                reference_reflectance(&reference.surface, reference.light, cos_theta),
            )
        };
        ThesisMeasure(some.map(at).collect())
    }

    /// The sum over angles and channels of relative differences.
    fn sum(&self, stored: &Stored) -> f64 {
        let differences = self.0.iter().map(|(cos_theta, want)| {
            let got = stored.lookup(Weights::Steps256, *cos_theta as f32);
            let relative = |i: usize| (f64::from(got[i]) - want[i]).abs() / want[i];
            (0..3).map(relative).sum::<f64>()
        });
        differences.sum()
    }

    /// The mean relative difference of a lookup, in per cent.
    pub fn error(&self, stored: &Stored) -> f64 {
        percent(self.sum(stored), self.0.len())
    }
}

fn percent(sum: f64, angles: usize) -> f64 {
    100.0 * sum / (3 * angles) as f64
}

/// The thesis's measure of several tables of one reference, in per cent: mean relative difference of the lookup at `angles`
/// angles, even in angle, over three channels. `progress` hears how many angles are done.
pub fn thesis_table_errors(
    reference: &ReferenceCurve,
    tables: &[Stored],
    angles: usize,
    progress: &mut dyn FnMut(usize),
) -> Vec<f64> {
    const CHUNK: usize = 4096;
    let mut sums = vec![0.0; tables.len()];
    for start in (0..angles).step_by(CHUNK) {
        let part = ThesisMeasure::part(reference, start..(start + CHUNK).min(angles), angles);
        for (sum, stored) in sums.iter_mut().zip(tables) {
            *sum += part.sum(stored);
        }
        progress(part.0.len());
    }
    sums.into_iter().map(|sum| percent(sum, angles)).collect()
}
