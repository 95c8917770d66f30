//! PNG: 8 or 16 bits, marked as linear.
//!
//! Source: W3C, *Portable Network Graphics (PNG) Specification (Third Edition)*, 2025, <https://www.w3.org/TR/png-3/>. The chunk
//! gAMA says 1.0 and there is no sRGB chunk, so a reader that follows them applies no curve. cHRM names the primaries of a space
//! other than sRGB, since a file without it means sRGB. Engines often ignore these chunks: switch sRGB off where textures are
//! imported.

use png::{BitDepth, ColorType, Compression, Encoder, ScaledFloat, SourceChromaticities};

use super::picture::Picture;
use super::texel::Depth;
use crate::physics::spectra::Space;

/// The file, or the reason why it cannot be made.
pub fn png(picture: &Picture) -> Result<Vec<u8>, String> {
    encoded(picture).map_err(|why| why.to_string())
}

fn encoded(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let side = |texels: usize| u32::try_from(texels).unwrap_or(u32::MAX);
    let mut encoder = Encoder::new(&mut bytes, side(picture.width), side(picture.height()));
    encoder.set_color(match picture.alpha {
        Some(_) => ColorType::Rgba,
        None => ColorType::Rgb,
    });
    let is_byte = picture.depth == Depth::Unorm8;
    encoder.set_depth(if is_byte {
        BitDepth::Eight
    } else {
        BitDepth::Sixteen
    });
    encoder.set_compression(Compression::Balanced);
    encoder.set_source_gamma(ScaledFloat::new(1.0));
    if let Some(space) = picture.space.filter(|space| *space != Space::Srgb) {
        encoder.set_source_chromaticities(chromaticities(space));
    }
    encoder.add_text_chunk("Comment".to_owned(), picture.about.join("\n"))?;
    let mut writer = encoder.write_header()?;
    let data: Vec<u8> = if is_byte {
        picture.integers().map(|value| value as u8).collect()
    } else {
        picture.integers().flat_map(u16::to_be_bytes).collect()
    };
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

fn chromaticities(space: Space) -> SourceChromaticities {
    let place = |[x, y]: [f64; 2]| (x as f32, y as f32);
    let [red, green, blue] = space.primaries().map(place);
    SourceChromaticities::new(place(space.white_xy()), red, green, blue)
}
