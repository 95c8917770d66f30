//! The thesis's measure of functions and of tables (section 5.2): the mean relative difference from the exact law at angles that
//! are uniform from 0 to 90 degrees.
//!
//! In 32-bit floats it is computed as the thesis's program does throughout (section 4): angles, both functions, their difference
//! and the sums. Over 10⁶ angles, a sum loses its last digits, and the mean moves by about 10⁻⁴ of its value. That can change a
//! printed digit.

use std::ops::Range;

use crate::generator::lut::Stored;
use crate::generator::reference::{ReferenceCurve, cosine_of_part};
use crate::language::ir::{Checked, Value, Weights, evaluate};
use crate::physics::materials::Channels;
use crate::physics::num::each_channel;
use crate::physics::optics;

/// How many angles are computed at once.
const CHUNK: usize = 4096;

/// The thesis's measure of several functions of `cos_theta` alone for one material: mean relative difference per channel at
/// `angles` angles, uniform from 0 to 90 degrees (midpoints of equal steps). The exact law, which costs the most, is computed
/// once. `progress` receives how many angles are done.
pub fn thesis_errors(
    functions: &[&Checked],
    channels: &Channels,
    angles: usize,
    progress: &mut dyn FnMut(usize),
) -> Vec<[f64; 3]> {
    let Channels { n, k } = channels;
    let mut sums = vec![[0.0; 3]; functions.len()];
    for start in (0..angles).step_by(CHUNK) {
        let cosines: Vec<f64> = (start..(start + CHUNK).min(angles))
            .map(|i| cosine_of_part(2 * i + 1, 2 * angles))
            .collect();
        let want = each_channel(|i| {
            let law = cosines.iter().map(|c| optics::unpolarised(n[i], k[i], *c));
            law.collect::<Vec<f64>>()
        });
        let points = cosines.len();
        let arguments = [Value::each(cosines)];
        for (function, sums) in functions.iter().zip(&mut sums) {
            add_differences(&evaluate(function, &arguments), &want, sums);
        }
        progress(points);
    }
    let mean = |sums: [f64; 3]| sums.map(|sum| sum / angles as f64);
    sums.into_iter().map(mean).collect()
}

/// Adds the relative differences, point by point.
fn add_differences(got: &Value<f64>, want: &[Vec<f64>; 3], sums: &mut [f64; 3]) {
    for (i, sum) in sums.iter_mut().enumerate() {
        let got = got.channel(i);
        for (point, want) in want[i].iter().enumerate() {
            *sum += (got.at(point) - want).abs() / want;
        }
    }
}

/// Mean relative difference between two functions of the cosine, over angles and channels, all in f32.
pub fn thesis_error_in_floats(got: &Checked, want: &Checked, angles: usize) -> f32 {
    let mut sums = [0.0f32; 3];
    for start in (0..angles).step_by(CHUNK) {
        let cosines: Vec<f32> = (start..(start + CHUNK).min(angles))
            .map(|i| libm::cosf(i as f32 / angles as f32 * std::f32::consts::FRAC_PI_2))
            .collect();
        let points = cosines.len();
        let arguments = [Value::each(cosines)];
        let [got, want] = [got, want].map(|function| evaluate::<f32>(function, &arguments));
        for (i, sum) in sums.iter_mut().enumerate() {
            let (got, want) = (got.channel(i), want.channel(i));
            for point in 0..points {
                *sum += (got.at(point) - want.at(point)).abs() / want.at(point);
            }
        }
    }
    sums.map(|sum| sum / angles as f32).iter().sum::<f32>() / 3.0
}

/// The exact law at the midpoints of equal steps of angle: cosines, and reflectance in three channels.
pub struct ThesisMeasure(Vec<(f64, [f64; 3])>);

impl ThesisMeasure {
    /// The law at `angles` angles.
    pub fn new(reference: &ReferenceCurve, angles: usize) -> ThesisMeasure {
        ThesisMeasure::part(reference, 0..angles, angles)
    }

    /// The law at a range of these angles.
    fn part(reference: &ReferenceCurve, some: Range<usize>, angles: usize) -> ThesisMeasure {
        let at = |i: usize| {
            let theta = (i as f64 + 0.5) / angles as f64 * std::f64::consts::FRAC_PI_2;
            let cos_theta = libm::cos(theta);
            (cos_theta, reference.at(cos_theta))
        };
        ThesisMeasure(some.map(at).collect())
    }

    /// The coordinates of the angles in a table.
    fn coordinates(&self, stored: &Stored) -> Vec<f32> {
        let angles = self.0.iter();
        angles
            .map(|(cos_theta, _)| stored.coordinate(*cos_theta as f32))
            .collect()
    }

    /// The sum of relative differences over angles and channels, with the angles' coordinates in the table.
    fn sum(&self, stored: &Stored, coordinates: &[f32]) -> f64 {
        let differences = self.0.iter().zip(coordinates).map(|((_, want), u)| {
            let got = stored.scaled_sample(Weights::Steps256, *u);
            let relative = |i: usize| (f64::from(got[i]) - want[i]).abs() / want[i];
            (0..3).map(relative).sum::<f64>()
        });
        differences.sum()
    }

    /// The mean relative difference of a lookup, in per cent.
    pub fn error(&self, stored: &Stored) -> f64 {
        percent(self.sum(stored, &self.coordinates(stored)), self.0.len())
    }
}

fn percent(sum: f64, angles: usize) -> f64 {
    100.0 * sum / (3 * angles) as f64
}

/// The thesis's measure of several tables of one reference and one size, in per cent: mean relative difference of the lookup at `angles`
/// angles, uniform in angle, over three channels. `progress` receives how many angles are done.
pub fn thesis_table_errors(
    reference: &ReferenceCurve,
    tables: &[Stored],
    angles: usize,
    progress: &mut dyn FnMut(usize),
) -> Vec<f64> {
    let mut sums = vec![0.0; tables.len()];
    for start in (0..angles).step_by(CHUNK) {
        let part = ThesisMeasure::part(reference, start..(start + CHUNK).min(angles), angles);
        // Tables of one axis stand beside each other, and share coordinates.
        let mut axis = None;
        let mut coordinates = Vec::new();
        for (sum, stored) in sums.iter_mut().zip(tables) {
            if axis != Some(stored.axis) {
                axis = Some(stored.axis);
                coordinates = part.coordinates(stored);
            }
            *sum += part.sum(stored, &coordinates);
        }
        progress(part.0.len());
    }
    sums.into_iter().map(|sum| percent(sum, angles)).collect()
}
