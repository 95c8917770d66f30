//! Pictures as PNG: SVG text drawn by `resvg` with embedded fonts, and raw pixels.
//!
//! No font and no file of the machine is read, so equal text gives equal bytes everywhere. The fonts are parts of DejaVu Sans,
//! Latin and Greek. A character that they lack is drawn as an empty box.

use std::sync::Arc;

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, Tree, fontdb};

use crate::generator::emit::MARK;

/// The regular font comes first. It has letters that the bold one lacks, and is searched for these.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../../data/fonts/DejaVuSans-subset.ttf"),
    include_bytes!("../../data/fonts/DejaVuSans-Bold-subset.ttf"),
];
const FAMILY: &str = "DejaVu Sans";

/// The largest side of a picture, which most viewers can still show.
const MOST_PIXELS: f32 = 16_384.0;

/// A self-contained SVG document as PNG on white, with `scale` pixels to each of its units, or why it cannot be drawn.
///
/// # Errors
/// The text is not SVG, or the picture is too large.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, String> {
    let (colours, size) = rasterised(svg, scale)?;
    let intent = SrgbRenderingIntent::RelativeColorimetric;
    let (how, texts) = (
        (Compression::Balanced, intent),
        [("Software", MARK.to_owned())],
    );
    encoded(&colours, size, how, &texts)
        .map_err(|why| format!("the picture cannot be written as PNG: {why}"))
}

/// A self-contained SVG document as bytes of red, green and blue, with its pixels across and down.
///
/// # Errors
/// The text is not SVG, or the picture is too large.
pub fn rasterised(svg: &str, scale: f32) -> Result<(Vec<u8>, [u32; 2]), String> {
    let tree = parse(svg)?;
    let width = pixels(tree.size().width(), scale)?;
    let height = pixels(tree.size().height(), scale)?;
    let mut map = Pixmap::new(width, height)
        .ok_or_else(|| format!("a picture of {width} x {height} pixels is too large"))?;
    map.fill(Color::WHITE);
    resvg::render(
        &tree,
        Transform::from_scale(scale, scale),
        &mut map.as_mut(),
    );
    // On the white ground nothing is transparent.
    let colours = map.data().chunks_exact(4).flat_map(|rgba| &rgba[..3]);
    Ok((colours.copied().collect(), [width, height]))
}

/// The document as `resvg` understands it.
fn parse(svg: &str) -> Result<Tree, String> {
    let mut options = Options {
        font_family: FAMILY.to_owned(),
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        fontdb: Arc::new(fonts()),
        ..Options::default()
    };
    options.languages.clear();
    Tree::from_str(svg, &options)
        .map_err(|why| format!("the picture is not well-formed SVG: {why}"))
}

/// The embedded fonts, which serve every font family that a text names.
fn fonts() -> fontdb::Database {
    let mut fonts = fontdb::Database::new();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family(FAMILY);
    fonts.set_serif_family(FAMILY);
    fonts.set_monospace_family(FAMILY);
    fonts
}

fn pixels(length: f32, scale: f32) -> Result<u32, String> {
    let pixels = (length * scale).round();
    if (1.0..=MOST_PIXELS).contains(&pixels) {
        return Ok(pixels as u32);
    }
    Err(format!(
        "a scale of {scale} makes a picture {pixels} pixels long; it can have 1 to {MOST_PIXELS} a side"
    ))
}

/// A PNG from bytes of red, green and blue, row by row, in sRGB. `about` is ASCII.
///
/// # Errors
/// The picture cannot be encoded; the text says why.
pub fn rgb_png(pixels: &[u8], size: [u32; 2], about: String) -> Result<Vec<u8>, String> {
    let how = (Compression::High, SrgbRenderingIntent::Perceptual);
    encoded(pixels, size, how, &[("Comment", about)]).map_err(|why| why.to_string())
}

/// A PNG of panels from bytes of red, green and blue, row by row, in sRGB. `about` and `panels`, where they are, are ASCII.
///
/// # Errors
/// The picture cannot be encoded; the text says why.
pub fn encoded_sheet(
    pixels: &[u8],
    size: [u32; 2],
    about: String,
    panels: String,
) -> Result<Vec<u8>, String> {
    let how = (Compression::High, SrgbRenderingIntent::Perceptual);
    let texts = [("Comment", about), ("Panels", panels)];
    encoded(pixels, size, how, &texts).map_err(|why| why.to_string())
}

/// A PNG with texts beside its pixels, by their keywords.
fn encoded(
    pixels: &[u8],
    [width, height]: [u32; 2],
    (compression, intent): (Compression, SrgbRenderingIntent),
    texts: &[(&str, String)],
) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(compression);
    encoder.set_source_srgb(intent);
    for (keyword, text) in texts {
        encoder.add_text_chunk((*keyword).to_owned(), text.clone())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Width, height and pixels of a PNG.
    fn decoded(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        (info.width, info.height, pixels)
    }

    fn drawn_text(words: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"40\" \
             font-family=\"system-ui, sans-serif\"><text x=\"4\" y=\"30\" font-size=\"20\">{words}</text></svg>"
        )
    }

    #[test]
    fn size_follows_the_scale_and_equal_text_gives_equal_bytes() {
        let once = png(&drawn_text("n = 1.5"), 1.0).unwrap();
        assert_eq!(once, png(&drawn_text("n = 1.5"), 1.0).unwrap());
        let (width, height, pixels) = decoded(&once);
        assert_eq!((width, height, pixels.len()), (200, 40, 3 * 200 * 40));
        assert!(pixels.iter().any(|value| *value < 60), "no ink");
        let (width, height, _) = decoded(&png(&drawn_text("n"), 2.5).unwrap());
        assert_eq!((width, height), (500, 100));
        assert!(once.windows(4).any(|name| name == b"sRGB"));
    }

    #[test]
    fn each_letter_has_its_own_shape() {
        let picture = |letter: char| png(&drawn_text(&letter.to_string()), 1.0).unwrap();
        // A Chinese character, which no font has.
        let missing = picture('\u{6c34}');
        for letter in "aZ9°θληΔµ×−–·…²³₀₂₈éáčćšžüöäøåłşğő".chars()
        {
            assert_ne!(picture(letter), missing, "{letter}");
            assert_ne!(picture(letter), picture(' '), "{letter}");
        }
    }

    #[test]
    fn bold_is_bolder() {
        let ink = |svg: &str| {
            let (_, _, pixels) = decoded(&png(svg, 1.0).unwrap());
            pixels
                .iter()
                .map(|value| u64::from(255 - value))
                .sum::<u64>()
        };
        let bold = drawn_text("gold").replace("<text", "<text font-weight=\"600\"");
        assert!(ink(&bold) > ink(&drawn_text("gold")) * 11 / 10);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        for (svg, scale) in [
            ("gold", 1.0),
            ("<svg", 1.0),
            (&drawn_text("n"), 0.0),
            (&drawn_text("n"), -1.0),
            (&drawn_text("n"), f32::NAN),
            (&drawn_text("n"), f32::INFINITY),
            (&drawn_text("n"), 1e9),
        ] {
            assert!(png(svg, scale).is_err(), "{svg} at {scale}");
        }
    }
}
