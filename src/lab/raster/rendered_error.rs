//! The rendered error of a method: over the angles that pictures show.

use crate::generator::fit::{arguments, table_of};
use crate::generator::reference::ReferenceCurve;
use crate::language::ir::{Checked, evaluate};
use crate::physics::num::each_channel;

use super::draw::Frame;
use super::histogram::CosineHistogram;

/// Mean relative errors of the channels, as shares; none where the reference is 0 and the method says otherwise.
pub type RelativeErrors = Option<[f64; 3]>;

/// The rendered error of a method on a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderedError {
    /// Mean relative errors of the channels.
    pub mean_rel: RelativeErrors,
    /// The largest absolute difference at an angle that is seen, of any channel.
    pub max_abs: f64,
    /// The cosine at which it stands.
    pub worst_cos: f64,
}

/// The error of a function of `cos_theta` alone, or with the table that it reads, over a histogram.
pub fn rendered_error(
    histogram: &CosineHistogram,
    function: &Checked,
    reference: &ReferenceCurve,
) -> RenderedError {
    let (cosines, weights) = histogram.seen();
    let got = values(function, reference, &cosines);
    let want: Vec<[f64; 3]> = cosines.iter().map(|c| reference.at(*c)).collect();
    let mut error = RenderedError {
        mean_rel: mean_relative(&got, &want, &weights),
        max_abs: 0.0,
        worst_cos: 1.0,
    };
    for ((got, want), cosine) in got.iter().zip(&want).zip(&cosines) {
        let largest = each_channel(|i| (got[i] - want[i]).abs());
        let largest = largest.into_iter().fold(0.0, f64::max);
        if largest > error.max_abs {
            (error.max_abs, error.worst_cos) = (largest, *cosine);
        }
    }
    error
}

/// The same by direct rendering: reflectances are computed at every pixel of every frame. The mean over pixels, then over frames.
pub fn drawn_errors(
    frames: &[Frame],
    function: &Checked,
    reference: &ReferenceCurve,
) -> RelativeErrors {
    let shown = frames.iter().filter(|frame| !frame.covered.is_empty());
    let mut sum = [0.0; 3];
    let mut count = 0.0;
    for frame in shown {
        let cosines: Vec<f64> = frame.covered.iter().map(|(_, c)| *c).collect();
        let got = values(function, reference, &cosines);
        let want: Vec<[f64; 3]> = cosines.iter().map(|c| reference.at(*c)).collect();
        let mean = mean_relative(&got, &want, &vec![1.0; cosines.len()])?;
        sum = each_channel(|i| sum[i] + mean[i]);
        count += 1.0;
    }
    (count > 0.0).then(|| sum.map(|sum| sum / count))
}

/// The values of a function at these cosines; a table that it reads is of the reference.
pub(super) fn values(
    function: &Checked,
    reference: &ReferenceCurve,
    cosines: &[f64],
) -> Vec<[f64; 3]> {
    let table = table_of(function, |cos_theta| reference.at(cos_theta));
    let got = evaluate(function, &arguments(cosines.to_vec(), table.as_ref()));
    (0..cosines.len()).map(|point| got.at(point)).collect()
}

/// The weighted mean of |got − want| / want in each channel. Where both are the same the error is 0.
pub fn mean_relative(got: &[[f64; 3]], want: &[[f64; 3]], weights: &[f64]) -> RelativeErrors {
    let total: f64 = weights.iter().sum();
    let mut sum = [0.0; 3];
    for ((got, want), weight) in got.iter().zip(want).zip(weights) {
        for channel in 0..3 {
            let difference = (got[channel] - want[channel]).abs();
            if difference > 0.0 {
                sum[channel] += weight * difference / want[channel];
            }
        }
    }
    let mean = sum.map(|sum| sum / total);
    mean.iter().all(|mean| mean.is_finite()).then_some(mean)
}
