//! G-buffers of any renderer: OpenEXR files with a channel for each quantity that a pixel's error depends on.
//!
//! | channel | what it holds | must be there |
//! |---|---|---|
//! | `cos_theta` | cosine between the shading normal and the direction to the camera, 0 to 1 | yes |
//! | `material_id` | a whole number: 0 is the background, all else is in the map of materials | yes |
//! | `roughness` | perceptual roughness, 0 to 1: α is its square | 0 where it is not |
//! | `coverage` | how much of the pixel the material covers, times its opacity, 0 to 1 | 1 where it is not |
//! | `light.R`, `light.G`, `light.B` | incoming light along the mirrored direction, which F multiplies; linear | yes |
//! | `other.R`, `other.G`, `other.B` | all other light, before 1 - F multiplies it; linear | 0 where none is |
//!
//! Samples are half, float or uint, in scan lines or tiles, in one part or several. Where a part of a file is named `light`, its
//! channel `R` is `light.R`. Blender's `ViewLayer.light.R` is `light.R`, and its `ViewLayer.cos_theta.V` is `cos_theta`. Pixels are counted from the top left of the data window.

mod channels;
mod samples;

use super::frame::{FramePixels, ScenePixel};
use super::ids::MaterialIds;
use channels::{COS_THETA, COVERAGE, LIGHT, MATERIAL_ID, OTHER, Places, ROUGHNESS};
use samples::Planes;

pub use channels::{GbufferFault, check_primaries};

/// How far interpolated cosines and rounded shares may leave [0, 1].
const ROUNDING: f64 = 1e-3;

/// The pixels of an OpenEXR file that show a material of the map. Pixels of the background, of ids that the map ignores, and
/// without coverage are skipped unchecked.
///
/// # Errors
/// The file cannot be read, is too large, or lacks a channel. Or a pixel holds a value that the channel cannot have, or an id
/// that the map lacks. The fault names channel and pixel.
pub fn read_gbuffer(bytes: &[u8], ids: &MaterialIds) -> Result<FramePixels, GbufferFault> {
    let reader = samples::opened(bytes)?;
    let places = Places::of(reader.headers())?;
    let [width, height] = samples::size(reader.headers(), &places, bytes.len())?;
    let frame = Frame {
        planes: samples::planes(reader, &places, [width, height])?,
        width,
    };
    let mut pixels = FramePixels::new([width as u32, height as u32], ids.materials.len());
    for place in 0..width * height {
        if let Some((material, pixel)) = frame.pixel(place, ids)? {
            pixels.of_material[material].push(pixel);
        }
    }
    Ok(pixels)
}

/// The samples as read, before they are checked.
struct Frame {
    planes: Planes,
    width: usize,
}

impl Frame {
    /// A pixel and the index of its material; `None` if it shows no material.
    fn pixel(
        &self,
        place: usize,
        ids: &MaterialIds,
    ) -> Result<Option<(usize, ScenePixel)>, GbufferFault> {
        let coverage = self.share(COVERAGE, place)?;
        if coverage == 0.0 {
            return Ok(None);
        }
        let Some(material) = self.material(place, ids)? else {
            return Ok(None);
        };
        let pixel = ScenePixel {
            place: place as u32,
            cos_theta: self.share(COS_THETA, place)?,
            roughness: self.share(ROUGHNESS, place)?,
            coverage,
            light: self.colour(LIGHT, place)?,
            other: self.colour(OTHER, place)?,
        };
        Ok(Some((material, pixel)))
    }

    fn material(&self, place: usize, ids: &MaterialIds) -> Result<Option<usize>, GbufferFault> {
        let value = self.planes.value(MATERIAL_ID, place);
        if value == 0.0 {
            return Ok(None);
        }
        if !(0.0..=f64::from(u32::MAX)).contains(&value) || value.fract() != 0.0 {
            let what = format!(
                "{value} is no id; ids are whole numbers from 0 to {}",
                u32::MAX
            );
            return Err(self.fault(MATERIAL_ID, place, what));
        }
        let material = ids.material_of(value as u32);
        material.map_err(|what| self.fault(MATERIAL_ID, place, what))
    }

    /// A number in [0, 1].
    fn share(&self, channel: usize, place: usize) -> Result<f32, GbufferFault> {
        let value = self.planes.value(channel, place);
        if (-ROUNDING..=1.0 + ROUNDING).contains(&value) {
            return Ok(value.clamp(0.0, 1.0) as f32);
        }
        let what = format!("{value} is not allowed; it must lie between 0 and 1");
        Err(self.fault(channel, place, what))
    }

    /// Three channels of light.
    fn colour(&self, first: usize, place: usize) -> Result<[f32; 3], GbufferFault> {
        let mut colour = [0.0; 3];
        for (channel, part) in (first..).zip(&mut colour) {
            let value = self.planes.value(channel, place);
            if !(0.0..=f64::from(f32::MAX)).contains(&value) {
                let what = format!("{value} is not allowed; light must be finite and not negative");
                return Err(self.fault(channel, place, what));
            }
            *part = value as f32;
        }
        Ok(colour)
    }

    fn fault(&self, channel: usize, place: usize, what: String) -> GbufferFault {
        let (x, y) = (place % self.width, place / self.width);
        let channel = channels::CHANNELS[channel].0;
        GbufferFault(format!("channel {channel}, pixel ({x}, {y}): {what}"))
    }
}
