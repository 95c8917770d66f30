//! The rendered error of a method: its error on a material over the angles that pictures show, its row in the report, and frames
//! painted with reflectance, by a method, by the reference, and with their difference.

use serde::Serialize;

use super::draw::Frame;
use super::histogram::{CosineHistogram, Shown};
use crate::generator::fit::{arguments, table_of};
use crate::generator::reference::ReferenceCurve;
use crate::language::ir::{Checked, evaluate};
use crate::physics::num::each_channel;

/// Mean relative errors of the channels, as fractions. None where the reference is 0 and the method is not.
pub type RelativeErrors = Option<[f64; 3]>;

/// The rendered error of a method on a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderedError {
    /// Mean relative errors of the channels.
    pub mean_rel: RelativeErrors,
    /// The largest absolute difference of any channel at a visible angle.
    pub max_abs: f64,
    /// Its cosine.
    pub worst_cos: f64,
}

/// The error over a histogram of a function of `cos_theta` alone, or with the table that it reads.
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

/// The values of a function at these cosines. A table that it reads is made from the reference.
fn values(function: &Checked, reference: &ReferenceCurve, cosines: &[f64]) -> Vec<[f64; 3]> {
    let table = table_of(function, |cos_theta| reference.at(cos_theta));
    let got = evaluate(function, &arguments(cosines.to_vec(), table.as_ref()));
    (0..cosines.len()).map(|point| got.at(point)).collect()
}

/// The weighted mean of |got − want| / want in each channel. Where both are equal the error is 0.
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

/// The rendered error of a method on a material.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneErrorRow {
    /// The object: a body's name, or a file's.
    pub object: String,
    /// `turntable` or `fixed`.
    pub view: &'static str,
    /// The number of frames in which it is visible.
    pub frames: usize,
    /// The number of pixels that it covers in all of them.
    pub pixels: u64,
    /// The material, with its medium.
    pub material: String,
    /// The method.
    pub method: String,
    /// Mean relative errors in per cent.
    pub mean_rel: Option<ChannelErrors>,
    /// The largest absolute difference of any channel at a visible angle.
    pub max_abs: f64,
    /// Its cosine.
    pub worst_cos: f64,
    /// Why the mean is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
}

/// Errors of three channels in per cent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChannelErrors {
    /// The error of red.
    pub red: f64,
    /// The error of green.
    pub green: f64,
    /// The error of blue.
    pub blue: f64,
    /// Their mean.
    pub mean: f64,
    /// Their mean weighted by luminance in the working space. It is not the error of luminance, in which errors of channels cancel.
    pub by_luminance: f64,
}

const NO_REFERENCE: &str = "the reference reflects nothing at an angle that is seen";

impl SceneErrorRow {
    /// A row. `luminance` are the weights of the channels.
    pub fn new(
        object: &str,
        view: &'static str,
        shown: &Shown,
        [material, method]: [&str; 2],
        error: &RenderedError,
        luminance: [f64; 3],
    ) -> SceneErrorRow {
        let mean_rel = error.mean_rel.map(|shares| {
            let [red, green, blue] = shares.map(|share| 100.0 * share);
            ChannelErrors {
                red,
                green,
                blue,
                mean: (red + green + blue) / 3.0,
                by_luminance: red * luminance[0] + green * luminance[1] + blue * luminance[2],
            }
        });
        SceneErrorRow {
            object: object.to_owned(),
            view,
            frames: shown.frames,
            pixels: shown.pixels,
            material: material.to_owned(),
            method: method.to_owned(),
            mean_rel,
            max_abs: error.max_abs,
            worst_cos: error.worst_cos,
            reason: mean_rel.is_none().then_some(NO_REFERENCE),
        }
    }
}

/// A picture of three channels, row by row. Pixels that the object does not cover are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Painted {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The channels of every pixel, linear.
    pub pixels: Vec<[f64; 3]>,
}

impl Painted {
    /// cos θ in all three channels.
    pub fn angles(frame: &Frame) -> Painted {
        let cosines = frame.covered.iter().map(|(_, cos_theta)| [*cos_theta; 3]);
        Painted::new(frame, cosines)
    }

    /// The reference reflectance.
    pub fn reference(frame: &Frame, reference: &ReferenceCurve) -> Painted {
        let covered = frame.covered.iter();
        Painted::new(
            frame,
            covered.map(|(_, cos_theta)| reference.at(*cos_theta)),
        )
    }

    /// A function's reflectance.
    pub fn function(frame: &Frame, function: &Checked, reference: &ReferenceCurve) -> Painted {
        let cosines: Vec<f64> = frame.covered.iter().map(|(_, c)| *c).collect();
        Painted::new(frame, values(function, reference, &cosines).into_iter())
    }

    /// The largest difference of a channel from another picture of the same size, of each pixel.
    pub fn difference(&self, other: &Painted) -> Vec<f64> {
        let pixels = self.pixels.iter().zip(&other.pixels);
        let apart = pixels.map(|(a, b)| each_channel(|i| (a[i] - b[i]).abs()));
        apart
            .map(|apart| apart.into_iter().fold(0.0, f64::max))
            .collect()
    }

    fn new(frame: &Frame, values: impl Iterator<Item = [f64; 3]>) -> Painted {
        let [width, height] = frame.size.map(|side| side as usize);
        let mut pixels = vec![[0.0; 3]; width * height];
        for ((place, _), value) in frame.covered.iter().zip(values) {
            pixels[*place as usize] = value;
        }
        Painted {
            size: frame.size,
            pixels,
        }
    }
}
