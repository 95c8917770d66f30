//! A row of the report: the error of a method on a material, over the angles that an object shows.

use serde::Serialize;

use super::rendered_error::RenderedError;
use super::shown::Shown;

/// The rendered error of a method on a material.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneErrorRow {
    /// The object: a body's name, or a file's.
    pub object: String,
    /// `turntable` or `fixed`.
    pub view: &'static str,
    /// Frames that show anything of it.
    pub frames: usize,
    /// The pixels that it covers in all of them.
    pub pixels: u64,
    /// The material, with its medium.
    pub material: String,
    /// The method.
    pub method: String,
    /// Mean relative errors in per cent.
    pub mean_rel: Option<ChannelErrors>,
    /// The largest absolute difference of a channel at an angle that is seen.
    pub max_abs: f64,
    /// The cosine at which it stands.
    pub worst_cos: f64,
    /// Why the mean is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
}

/// Errors of three channels in per cent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChannelErrors {
    /// Of each channel.
    pub red: f64,
    /// Of each channel.
    pub green: f64,
    /// Of each channel.
    pub blue: f64,
    /// Their mean.
    pub mean: f64,
    /// Their mean by what each adds to luminance in the working space: no error of luminance, in which channels make up for each other.
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
