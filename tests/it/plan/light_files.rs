//! Environments: what a picture's metadata says of its numbers is followed, or refused.

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};

use fresnel_gen::physics::spectra::Space;
use fresnel_gen::pictures::plan::check_primaries;
use fresnel_gen::pictures::scene::Environment;

const REC2020: [[f64; 2]; 4] = [
    [0.708, 0.292],
    [0.17, 0.797],
    [0.131, 0.046],
    [0.3127, 0.329],
];
/// 200, 40, 40 of Rec. 2020, in sRGB: computed apart in Python.
const IN_SRGB: [f32; 3] = [305.678_6, 20.071_9, 37.095_9];

fn light(bytes: &[u8], space: Space) -> [f32; 3] {
    let environment = Environment::read(bytes, space).unwrap();
    let [red, green, blue, _] = environment.table.texels()[0];
    [red, green, blue]
}

#[track_caller]
fn check(bytes: &[u8], space: Space, wanted: [f32; 3]) {
    let found = light(bytes, space);
    let is_near = found
        .iter()
        .zip(wanted)
        .all(|(a, b)| (a - b).abs() <= 1e-3 * b.max(0.1));
    assert!(is_near, "{found:?}, {wanted:?}");
}

#[track_caller]
fn refused(bytes: &[u8], says: &str) {
    let fault = Environment::read(bytes, Space::Srgb)
        .unwrap_err()
        .to_string();
    assert!(fault.contains(says), "{fault}");
}

/// Two pixels of 200, 40, 40.
fn hdr(lines: &str) -> Vec<u8> {
    let mut bytes =
        format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{lines}\n-Y 1 +X 2\n").into_bytes();
    bytes.extend([200, 40, 40, 136].repeat(2));
    bytes
}

#[test]
fn radiance_divides_by_exposure_and_knows_its_primaries() {
    check(&hdr(""), Space::Srgb, [200.0, 40.0, 40.0]);
    check(&hdr("EXPOSURE=2\n"), Space::Srgb, [100.0, 20.0, 20.0]);
    check(
        &hdr("EXPOSURE=2\nEXPOSURE= 4\n"),
        Space::Srgb,
        [25.0, 5.0, 5.0],
    );
    check(
        &hdr("EXPOSURE=.5\nCOLORCORR=2 1 4\n"),
        Space::Srgb,
        [200.0, 80.0, 20.0],
    );
    let primaries = "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n";
    check(&hdr(primaries), Space::Srgb, IN_SRGB);
    check(&hdr(primaries), Space::Rec2020, [200.0, 40.0, 40.0]);
    // Radiance's own, whose white is that of equal power: white stays white.
    let grey =
        String::from_utf8_lossy(b"PRIMARIES=.64 .33 .29 .60 .15 .06 .333 .333\n").into_owned();
    let mut bytes = hdr(&grey);
    let end = bytes.len();
    bytes[end - 8..].copy_from_slice(&[200, 200, 200, 136].repeat(2));
    check(&bytes, Space::AcesCg, [200.0; 3]);
    refused(&hdr("EXPOSURE=0\n"), "must be above 0");
    refused(&hdr("EXPOSURE=-1\n"), "must be above 0");
    refused(&hdr("GAMMA=2.2\n"), "GAMMA=2.2");
    refused(&hdr("PRIMARIES=.64 .33\n"), "it wants x and y");
    refused(
        &hdr("PRIMARIES=.1 .1 .2 .2 .3 .3 .3 .3\n"),
        "span no colours",
    );
    let turned = String::from_utf8_lossy(&hdr("")).replace("-Y 1 +X 2", "+Y 1 +X 2");
    refused(turned.as_bytes(), "rientation");
}

/// Two pixels of OpenEXR.
fn exr(light: [f32; 3], primaries: Option<[[f64; 2]; 4]>) -> Vec<u8> {
    let [red, green, blue] = light;
    let channels = SpecificChannels::rgb(move |_: Vec2<usize>| (red, green, blue));
    let layer = Layer::new(
        (2, 1),
        LayerAttributes::default(),
        Encoding::UNCOMPRESSED,
        channels,
    );
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = primaries.map(|all| {
        let [red, green, blue, white] = all.map(|[x, y]| Vec2(x as f32, y as f32));
        Chromaticities {
            red,
            green,
            blue,
            white,
        }
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

/// A plan would take it for darkness, in which no error shows.
#[test]
fn what_is_no_light_is_refused_with_its_pixel() {
    for (green, says) in [
        (f32::NAN, "its pixel 0, 0 is (200, NaN, 40)"),
        (f32::INFINITY, "(200, inf, 40)"),
        (-1.0, "(200, -1, 40); light must be finite and not negative"),
    ] {
        refused(&exr([200.0, green, 40.0], None), says);
    }
}

/// A picture of a part of the sphere would be stretched over all of it.
#[test]
fn a_cropped_exr_is_refused() {
    let whole = exr([200.0, 40.0, 40.0], None);
    let name = b"displayWindow\0box2i\0";
    let at = whole.windows(name.len()).position(|bytes| bytes == name);
    // Behind the name and the length: the first pixel, and the last.
    let last_y = at.unwrap() + name.len() + 4 + 12;
    let mut cropped = whole.clone();
    assert_eq!(cropped[last_y..last_y + 4], [0, 0, 0, 0]);
    cropped[last_y] = 1;
    refused(&cropped, "its data window is not its display window");
}

#[test]
fn exr_knows_its_primaries() {
    let of = |primaries| exr([200.0, 40.0, 40.0], primaries);
    check(&of(None), Space::Rec2020, [200.0, 40.0, 40.0]);
    check(&of(Some(REC2020)), Space::Rec2020, [200.0, 40.0, 40.0]);
    check(&of(Some(REC2020)), Space::Srgb, IN_SRGB);
    // A G-buffer is refused, since its light is read as it comes.
    assert_eq!(check_primaries(&of(None), Space::AcesCg), Ok(()));
    assert_eq!(check_primaries(&of(Some(REC2020)), Space::Rec2020), Ok(()));
    let fault = check_primaries(&of(Some(REC2020)), Space::Srgb).unwrap_err();
    assert!(fault.to_string().ends_with("--space rec2020"), "{fault}");
}

/// Two pixels of half of white, with what a chunk says.
fn png(kind: png::ColorType, say: impl Fn(&mut png::Info)) -> Vec<u8> {
    let mut info = png::Info::with_size(2, 1);
    info.color_type = kind;
    info.bit_depth = png::BitDepth::Eight;
    say(&mut info);
    let mut bytes = Vec::new();
    let encoder = png::Encoder::with_info(&mut bytes, info).unwrap();
    let mut writer = encoder.write_header().unwrap();
    writer
        .write_image_data(&vec![128; 2 * kind.samples()])
        .unwrap();
    writer.finish().unwrap();
    bytes
}

#[test]
fn png_says_how_it_is_encoded() {
    const HALF: f64 = 128.0 / 255.0;
    let rgb = |say: &dyn Fn(&mut png::Info)| png(png::ColorType::Rgb, say);
    let gamma = |gamma: f32| rgb(&|info| info.source_gamma = Some(png::ScaledFloat::new(gamma)));
    let grey = |light: f64| [light as f32; 3];
    let srgb = grey(0.215_861);
    check(&rgb(&|_| ()), Space::Srgb, srgb);
    check(&gamma(1.0), Space::Srgb, grey(HALF));
    check(&gamma(0.45455), Space::Srgb, srgb);
    check(&gamma(0.55556), Space::Srgb, grey(HALF.powf(1.8)));
    let intent = Some(png::SrgbRenderingIntent::Perceptual);
    check(&rgb(&|info| info.srgb = intent), Space::DisplayP3, srgb);
    refused(
        &rgb(&|info| info.icc_profile = Some(vec![0; 200].into())),
        "ICC profile",
    );
    refused(&png(png::ColorType::Rgba, |_| ()), "transparent pixels");
    // A chunk of Rec. 2020, beside which white stays white; what it makes of colours is the same as of Radiance's.
    let stated = |info: &mut png::Info| {
        let [red, green, blue, white] = REC2020.map(|[x, y]| (x as f32, y as f32));
        info.source_gamma = Some(png::ScaledFloat::new(1.0));
        info.source_chromaticities = Some(png::SourceChromaticities::new(white, red, green, blue));
    };
    let mut info = png::Info::with_size(2, 1);
    info.color_type = png::ColorType::Rgb;
    stated(&mut info);
    let mut bytes = Vec::new();
    let mut writer = png::Encoder::with_info(&mut bytes, info)
        .unwrap()
        .write_header()
        .unwrap();
    writer
        .write_image_data(&[200, 40, 40, 200, 40, 40])
        .unwrap();
    writer.finish().unwrap();
    check(&bytes, Space::Srgb, IN_SRGB.map(|channel| channel / 255.0));
}

/// What a fuzzer would try, a little of it on every machine.
#[test]
fn changed_bytes_do_no_harm() {
    let stated = |info: &mut png::Info| {
        info.source_gamma = Some(png::ScaledFloat::new(1.0));
        let half = (0.3, 0.3);
        info.source_chromaticities = Some(png::SourceChromaticities::new(
            half,
            (0.7, 0.3),
            half,
            (0.1, 0.0),
        ));
    };
    let primaries = "EXPOSURE=2\nPRIMARIES=.64 .33 .29 .60 .15 .06 .333 .333\n";
    let good = [hdr(primaries), png(png::ColorType::Rgb, stated)];
    let mut random = fastrand::Rng::with_seed(3);
    for bytes in good {
        for _ in 0..3000 {
            let mut bytes = bytes.clone();
            for _ in 0..random.usize(1..4) {
                let at = random.usize(..bytes.len());
                bytes[at] = random.u8(..);
            }
            if let Ok(environment) = Environment::read(&bytes, Space::AcesCg) {
                let all = environment.table.texels().as_flattened();
                assert!(all.iter().all(|light| (0.0..=65504.0).contains(light)));
            }
        }
    }
}
