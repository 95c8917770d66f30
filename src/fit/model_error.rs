//! Model error: a method against the exact law, over all angles. Never to be added to code error.

use serde::Serialize;

use crate::ir::{Checked, Value, evaluate};
use crate::materials::Channels;
use crate::methods::Light;
use crate::optics;

/// How wrong a method is for a material, whatever computes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ModelError {
    /// Largest absolute difference, over angles and channels.
    pub max_abs: f64,
    /// Mean absolute difference, even in angle, mean of the channels.
    pub mean_abs: f64,
    /// Mean relative difference, even in angle, mean of the channels, as the thesis measures.
    pub mean_rel: f64,
    /// The cosine at which the largest difference stands.
    pub worst_cos: f64,
}

/// Angles between 0 and 90 degrees at which errors are taken. The curves are smooth: 2048 find a maximum to 1e-6 of
/// its value.
pub(super) const ANGLES: usize = 2048;

/// What a method is held against: the exact law for these channels and this light.
#[derive(Clone, Copy, Debug)]
pub struct Truth<'a> {
    /// The relative index per channel.
    pub channels: &'a Channels,
    /// Polarised or not.
    pub light: Light,
}

impl Truth<'_> {
    /// The exact reflectance of each channel at a cosine.
    pub fn at(&self, cos_theta: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| {
            let exact = optics::conductor(self.channels.n[i], self.channels.k[i], cos_theta);
            match self.light {
                Light::Unpolarised => exact.unpolarised(),
                Light::S => exact.s,
                Light::P => exact.p,
            }
        })
    }
}

/// The exact reflectance of each channel at a cosine, unpolarised.
pub fn truth(channels: &Channels, cos_theta: f64) -> [f64; 3] {
    Truth {
        channels,
        light: Light::Unpolarised,
    }
    .at(cos_theta)
}

/// The model error of a function of `cos_theta` alone.
pub fn model_error(function: &Checked, truth: &Truth) -> ModelError {
    let cosines = cosines(ANGLES);
    let values = evaluate(function, &[Value::each(cosines.clone())]);
    difference(&values, truth, &cosines)
}

/// Both ends, and between them the middles of equal steps of angle, over which means are taken.
pub(super) fn cosines(angles: usize) -> Vec<f64> {
    let middles = (0..angles).map(|i| cosine(2 * i + 1, 2 * angles));
    [1.0].into_iter().chain(middles).chain([0.0]).collect()
}

/// Values at these cosines, of which the first and the last are the ends, against the exact law.
pub(super) fn difference(values: &Value<f64>, truth: &Truth, cosines: &[f64]) -> ModelError {
    let mut error = ModelError {
        max_abs: 0.0,
        mean_abs: 0.0,
        mean_rel: 0.0,
        worst_cos: 1.0,
    };
    let last = cosines.len() - 1;
    for (point, cos_theta) in cosines.iter().enumerate() {
        let weight = if point == 0 || point == last {
            0.0
        } else {
            1.0 / (3 * (last - 1)) as f64
        };
        for (got, want) in values.at(point).into_iter().zip(truth.at(*cos_theta)) {
            let difference = (got - want).abs();
            error.mean_abs += weight * difference;
            error.mean_rel += weight * difference / want.max(f64::MIN_POSITIVE);
            if difference > error.max_abs || difference.is_nan() {
                (error.max_abs, error.worst_cos) = (difference, *cos_theta);
            }
        }
    }
    error
}

/// The thesis's measure: mean relative difference per channel at `angles` angles, uniform from 0 to 90 degrees
/// (middles of equal steps), of several functions of `cos_theta` alone for one material: the exact law, which costs the
/// most, is computed once. `progress` hears how many angles are done.
pub fn thesis_errors(
    functions: &[&Checked],
    channels: &Channels,
    angles: usize,
    progress: &mut dyn FnMut(usize),
) -> Vec<[f64; 3]> {
    const CHUNK: usize = 4096;
    let mut sums = vec![[0.0; 3]; functions.len()];
    for start in (0..angles).step_by(CHUNK) {
        let cosines: Vec<f64> = (start..(start + CHUNK).min(angles))
            .map(|i| cosine(2 * i + 1, 2 * angles))
            .collect();
        let want: Vec<[f64; 3]> = cosines.iter().map(|c| truth(channels, *c)).collect();
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
fn add_differences(got: &Value<f64>, want: &[[f64; 3]], sums: &mut [f64; 3]) {
    for (i, sum) in sums.iter_mut().enumerate() {
        let got = got.channel(i);
        for (point, want) in want.iter().enumerate() {
            *sum += (got.at(point) - want[i]).abs() / want[i];
        }
    }
}

/// cos of `part/whole` of a right angle, exactly 1 and 0 at the ends.
fn cosine(part: usize, whole: usize) -> f64 {
    if part == whole {
        0.0
    } else {
        libm::cos(part as f64 / whole as f64 * std::f64::consts::FRAC_PI_2)
    }
}
