//! Reads light from the bytes of a picture: its samples, and what its metadata states about them.
//!
//! ```text
//! light = M curve(sample) / divisor        M: from the primaries that the file states to the working space, white to white by Bradford
//! ```
//!
//! A file that states no primaries is assumed to be in the working space. What is stated and cannot be followed is refused, as is
//! a cropped OpenEXR file.
//!
//! | format | curve | divisor | primaries |
//! |---|---|---|---|
//! | Radiance HDR | linear | product of all `EXPOSURE=` and `COLORCORR=` | `PRIMARIES=` |
//! | OpenEXR | linear | 1 | `chromaticities` |
//! | PNG | cICP, iCCP, sRGB, gAMA, in this order; sRGB without any | 1 | cICP, iCCP, sRGB, cHRM |
//! | JPEG | sRGB | 1 | ICC |
//!
//! Sources: G. Ward, *Radiance File Formats*, <https://radsite.lbl.gov/radiance/refer/filefmts.pdf>; W3C, *PNG Specification
//! (Third Edition)*, 2025, <https://www.w3.org/TR/png-3/>, section 4.3; ITU-T H.273 for the numbers of cICP. Alpha of OpenEXR is
//! not read: its colours are the light itself.

use std::io::Cursor;

use exr::meta::MetaData;
use exr::meta::header::Header;
use glam::{DMat3, DVec3};
use image::codecs::hdr::{HdrDecoder, HdrMetadata};
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, ImageFormat, Limits, Rgb32FImage};

use super::icc::is_srgb;
use crate::physics::spectra::{Space, bradford, rgb_to_xyz, srgb_linear, xyz_of};

/// A picture, and how its samples become light.
pub struct LightFile {
    pub picture: Rgb32FImage,
    numbers: Numbers,
    into_space: Option<DMat3>,
}

/// The encoding of samples.
struct Numbers {
    curve: Curve,
    divisor: DVec3,
    primaries: Option<Primaries>,
}

/// The light of a sample: in [0, 1], or of any size where it is linear.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Curve {
    Linear,
    Srgb,
    Power(f64),
}

/// Chromaticities (x, y) of red, green and blue, and of white.
type Primaries = ([[f64; 2]; 3], [f64; 2]);

impl Numbers {
    fn new(curve: Curve, primaries: Option<Primaries>) -> Numbers {
        Numbers {
            curve,
            divisor: DVec3::ONE,
            primaries,
        }
    }
}

impl LightFile {
    /// Reads a picture, to give its light in a space.
    ///
    /// # Errors
    /// It cannot be read, or it states an encoding that cannot be followed.
    pub fn read(bytes: &[u8], space: Space) -> Result<LightFile, String> {
        let format = image::guess_format(bytes).map_err(in_words)?;
        let (picture, numbers) = match format {
            ImageFormat::Hdr => hdr(bytes)?,
            ImageFormat::OpenExr => exr(bytes)?,
            ImageFormat::Png => png(bytes)?,
            ImageFormat::Jpeg => jpeg(bytes)?,
            other => return Err(format!("it is {other:?}; EXR, HDR, PNG and JPEG are read")),
        };
        let into_space = match &numbers.primaries {
            Some(primaries) => into_space(primaries, space)?,
            None => None,
        };
        let picture = picture.into_rgb32f();
        let is_light = |sample: &f32| sample.is_finite() && *sample >= 0.0;
        let mut pixels = picture.enumerate_pixels();
        if let Some((x, y, pixel)) = pixels.find(|(.., pixel)| !pixel.0.iter().all(is_light)) {
            let [red, green, blue] = pixel.0;
            return Err(format!(
                "its pixel {x}, {y} is ({red}, {green}, {blue}); light must be finite and not negative"
            ));
        }
        Ok(LightFile {
            picture,
            numbers,
            into_space,
        })
    }

    /// The light of a pixel in the space.
    pub fn light(&self, samples: [f32; 3]) -> DVec3 {
        let linear = samples.map(|sample| {
            let sample = f64::from(sample);
            match self.numbers.curve {
                Curve::Linear => sample,
                Curve::Srgb => srgb_linear(sample),
                Curve::Power(power) => libm::pow(sample, power),
            }
        });
        let light = DVec3::from_array(linear) / self.numbers.divisor;
        self.into_space.map_or(light, |matrix| matrix * light)
    }
}

fn in_words(why: image::ImageError) -> String {
    why.to_string()
}

/// The matrix from these primaries to a space; `None` where they are the space's own.
fn into_space((primaries, white): &Primaries, space: Space) -> Result<Option<DMat3>, String> {
    if space.has(primaries, white) {
        return Ok(None);
    }
    let into_xyz = rgb_to_xyz(*primaries, *white);
    let matrix = space.xyz_to_rgb() * bradford(xyz_of(*white), space.white()) * into_xyz;
    if matrix.is_finite() && into_xyz.determinant().abs() > 1e-6 {
        Ok(Some(matrix))
    } else {
        Err(format!(
            "its primaries {primaries:?} with the white {white:?} span no colours"
        ))
    }
}

fn hdr(bytes: &[u8]) -> Result<(DynamicImage, Numbers), String> {
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(in_words)?;
    let header = decoder.metadata();
    let numbers = numbers_of_hdr(&header)?;
    Ok((decoded(decoder)?, numbers))
}

fn numbers_of_hdr(header: &HdrMetadata) -> Result<Numbers, String> {
    let mut primaries = None;
    for (key, value) in &header.custom_attributes {
        let numbers = value.split_whitespace().map(str::parse);
        let numbers: Option<Vec<f64>> = numbers.collect::<Result<_, _>>().ok();
        match (key.as_str(), numbers.as_deref()) {
            ("PRIMARIES", Some(&[a, b, c, d, e, f, g, h])) => {
                primaries = Some(([[a, b], [c, d], [e, f]], [g, h]));
            }
            ("PRIMARIES", _) => {
                return Err(format!(
                    "PRIMARIES={value}: it wants x and y of red, green, blue and white"
                ));
            }
            ("GAMMA", Some(&[gamma])) if gamma != 1.0 => {
                return Err(format!(
                    "GAMMA={value}: only linear light is read, as Radiance writes it"
                ));
            }
            _ => {}
        }
    }
    let (red, green, blue) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let exposure = f64::from(header.exposure.unwrap_or(1.0));
    let divisor = exposure * DVec3::new(red.into(), green.into(), blue.into());
    if !(divisor.is_finite() && divisor.min_element() > 0.0) {
        return Err("EXPOSURE and COLORCORR must be above 0".to_owned());
    }
    Ok(Numbers {
        divisor,
        ..Numbers::new(Curve::Linear, primaries)
    })
}

/// Whether an OpenEXR file states in its version that it holds deep pixels. The crate does not check this.
pub fn is_deep(bytes: &[u8]) -> bool {
    /// Bit 11 of the word after the magic number, as a bit of the word's second byte.
    const DEEP: u8 = 1 << 3;
    bytes.get(5).is_some_and(|flags| flags & DEEP != 0)
}

fn exr(bytes: &[u8]) -> Result<(DynamicImage, Numbers), String> {
    if is_deep(bytes) {
        return Err("it holds deep pixels; flat ones are read".to_owned());
    }
    let picture =
        image::load_from_memory_with_format(bytes, ImageFormat::OpenExr).map_err(in_words)?;
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false);
    let meta = meta.map_err(|why| why.to_string())?;
    let first = meta.headers.first();
    // A file that is cropped or extends beyond the edges is no whole sphere.
    let is_whole =
        |header: &Header| header.data_window() == header.shared_attributes.display_window;
    if !first.is_none_or(is_whole) {
        return Err("its data window is not its display window, so that the picture is cropped or has overscan; save it whole".to_owned());
    }
    let stated = first.and_then(|header| header.shared_attributes.chromaticities);
    let primaries = stated.map(|stated| {
        let place = |at: exr::prelude::Vec2<f32>| [f64::from(at.0), f64::from(at.1)];
        let rgb = [stated.red, stated.green, stated.blue];
        (rgb.map(place), place(stated.white))
    });
    Ok((picture, Numbers::new(Curve::Linear, primaries)))
}

fn jpeg(bytes: &[u8]) -> Result<(DynamicImage, Numbers), String> {
    let decoder = JpegDecoder::new(Cursor::new(bytes)).map_err(in_words)?;
    let (picture, profile) = upright(decoder)?;
    Ok((picture, of_profile(profile.as_deref())?))
}

fn png(bytes: &[u8]) -> Result<(DynamicImage, Numbers), String> {
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info();
    let reader = reader.map_err(|why| why.to_string())?;
    let stated = stated_by_png(reader.info())?;
    let decoder = PngDecoder::new(Cursor::new(bytes)).map_err(in_words)?;
    let (picture, profile) = upright(decoder)?;
    let is_seen_through = |pixel: &image::Rgba<f32>| pixel.0[3] != 1.0;
    if picture.color().has_alpha() && picture.to_rgba32f().pixels().any(is_seen_through) {
        return Err("it has transparent pixels, and light has no alpha; fill them".to_owned());
    }
    let numbers = stated.map_or_else(|| of_profile(profile.as_deref()), Ok)?;
    Ok((picture, numbers))
}

/// The picture, unless it takes more memory than the crate's default limit, which the crate applies only where it chooses the
/// decoder.
fn decoded(mut decoder: impl ImageDecoder) -> Result<DynamicImage, String> {
    let mut limits = Limits::default();
    limits.reserve(decoder.total_bytes()).map_err(in_words)?;
    decoder.set_limits(limits).map_err(in_words)?;
    DynamicImage::from_decoder(decoder).map_err(in_words)
}

/// The picture, turned as its Exif states, and its ICC profile.
fn upright(mut decoder: impl ImageDecoder) -> Result<(DynamicImage, Option<Vec<u8>>), String> {
    let profile = decoder.icc_profile().map_err(in_words)?;
    let orientation = decoder.orientation().map_err(in_words)?;
    let mut picture = decoded(decoder)?;
    picture.apply_orientation(orientation);
    Ok((picture, profile))
}

fn of_profile(profile: Option<&[u8]>) -> Result<Numbers, String> {
    match profile {
        None => Ok(Numbers::new(Curve::Srgb, None)),
        Some(profile) if is_srgb(profile) => Ok(Numbers::new(Curve::Srgb, Some(of_space(Space::Srgb)))),
        Some(_) => Err("its ICC profile is of another space than sRGB, which is not read; save it as sRGB, or as EXR with linear light".to_owned()),
    }
}

fn of_space(space: Space) -> Primaries {
    (space.primaries(), space.white_xy())
}

/// What the chunks of a PNG state beside iCCP; `None` where iCCP counts, or where no chunk states anything.
fn stated_by_png(info: &png::Info) -> Result<Option<Numbers>, String> {
    if let Some(code) = &info.coding_independent_code_points {
        let curve = match code.transfer_function {
            8 => Curve::Linear,
            13 => Curve::Srgb,
            4 => Curve::Power(2.2),
            5 => Curve::Power(2.8),
            other => {
                return Err(format!(
                    "cICP with the transfer function {other} is not read; 8 (linear) and 13 (sRGB) are"
                ));
            }
        };
        let space = match (code.color_primaries, code.is_video_full_range_image) {
            (1, true) => Space::Srgb,
            (9, true) => Space::Rec2020,
            (12, true) => Space::DisplayP3,
            (other, _) => {
                return Err(format!(
                    "cICP with the primaries {other} is not read in this range; 1 (sRGB), 9 (Rec. 2020) and 12 (P3) are, in full range"
                ));
            }
        };
        return Ok(Some(Numbers::new(curve, Some(of_space(space)))));
    }
    if info.icc_profile.is_some() {
        return Ok(None);
    }
    if info.srgb.is_some() {
        return Ok(Some(Numbers::new(Curve::Srgb, Some(of_space(Space::Srgb)))));
    }
    let primaries = info.chrm_chunk.as_ref().map(|stated| {
        let place = |at: (png::ScaledFloat, png::ScaledFloat)| {
            [at.0, at.1].map(|x| f64::from(x.into_scaled()) / 1e5)
        };
        let rgb = [stated.red, stated.green, stated.blue];
        (rgb.map(place), place(stated.white))
    });
    let curve = match info.gama_chunk.map(png::ScaledFloat::into_scaled) {
        // Writers of sRGB state 45 455 beside it; 0 states nothing.
        None | Some(0 | 45_455) => Curve::Srgb,
        Some(100_000) => Curve::Linear,
        Some(gamma) => Curve::Power(1e5 / f64::from(gamma)),
    };
    Ok(Some(Numbers::new(curve, primaries)))
}
