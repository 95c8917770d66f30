//! Pixels as PNG.

use png::{BitDepth, ColorType, Compression, Encoder};

/// Bytes of red, green and blue, row after row, in sRGB. `about` is ASCII.
///
/// # Errors
/// It cannot be encoded, and why.
pub fn rgb_png(pixels: &[u8], size: [u32; 2], about: String) -> Result<Vec<u8>, String> {
    encoded(pixels, size, about).map_err(|why| why.to_string())
}

fn encoded(
    pixels: &[u8],
    [width, height]: [u32; 2],
    about: String,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Comment".to_owned(), about)?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}
