//! G-buffers in OpenEXR: what is read, and what is refused with its channel and pixel.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes,
    IntegerBounds, Layer, LayerAttributes, LineOrder, Text, Vec2, WritableImage, f16,
};

use fresnel_gen::pictures::plan::{FramePixels, MaterialIds, ScenePixel, read_gbuffer};

/// The map of all files here.
const MAP: &str = "ignore = [7]\n[[material]]\nid = 1\nname = \"statue\"\nmaterial = \"gold\"\n[[material]]\nid = 4294967295\nmaterial = \"water\"\n";
/// Pixels of the small file.
const SIZE: [usize; 2] = [19, 37];

fn ids() -> MaterialIds {
    MaterialIds::parse("scene.toml", MAP).unwrap()
}

/// A channel: its name and samples.
type Channel = (&'static str, FlatSamples);

/// How the samples are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stored {
    Half,
    Float,
    /// Ids as uint, all else as float.
    Uint,
}

fn samples(stored: Stored, values: Vec<f32>) -> FlatSamples {
    match stored {
        Stored::Half => FlatSamples::F16(values.into_iter().map(f16::from_f32).collect()),
        _ => FlatSamples::F32(values),
    }
}

/// A number in [0, 1) for a pixel, exact in half precision.
fn number(place: usize, salt: usize) -> f32 {
    let mixed = (place as u64 * 8 + salt as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 53;
    mixed as f32 / 2048.0
}

/// Background, both materials, and what is ignored.
fn id(place: usize, stored: Stored) -> u32 {
    let water = if stored == Stored::Uint { u32::MAX } else { 1 };
    [0, 1, water, 7][place % 4]
}

/// All channels of a good file.
fn channels(stored: Stored) -> Vec<Channel> {
    let all = SIZE[0] * SIZE[1];
    let plane = |salt: usize| {
        let values = (0..all).map(|place| number(place, salt)).collect();
        samples(stored, values)
    };
    let ids = (0..all).map(|place| id(place, stored));
    let ids = match stored {
        Stored::Uint => FlatSamples::U32(ids.collect()),
        _ => samples(stored, ids.map(|id| id as f32).collect()),
    };
    vec![
        ("cos_theta", plane(0)),
        ("material_id", ids),
        ("roughness", plane(1)),
        ("coverage", plane(2)),
        ("light.R", plane(3)),
        ("light.G", plane(4)),
        ("light.B", plane(5)),
        ("other.R", plane(6)),
        ("other.G", plane(7)),
        ("other.B", plane(8)),
    ]
}

/// What those channels show.
fn pixels(stored: Stored) -> FramePixels {
    let mut frame = FramePixels::new(SIZE.map(|side| side as u32), 2);
    for place in 0..SIZE[0] * SIZE[1] {
        let material = match id(place, stored) {
            0 | 7 => continue,
            1 => 0,
            _ => 1,
        };
        let coverage = number(place, 2);
        if coverage > 0.0 {
            frame.of_material[material].push(ScenePixel {
                place: place as u32,
                cos_theta: number(place, 0),
                roughness: number(place, 1),
                coverage,
                light: [3, 4, 5].map(|salt| number(place, salt)),
                other: [6, 7, 8].map(|salt| number(place, salt)),
            });
        }
    }
    frame
}

const LINES: Blocks = Blocks::ScanLines;
const TILES: Blocks = Blocks::Tiles(Vec2(8, 16));

/// A part of a file.
fn part(
    name: Option<&str>,
    channels: Vec<Channel>,
    (compression, blocks): (Compression, Blocks),
    size: [usize; 2],
) -> Layer<AnyChannels<FlatSamples>> {
    let attributes = LayerAttributes {
        layer_name: name.map(Text::from),
        ..LayerAttributes::default()
    };
    let encoding = Encoding {
        compression,
        blocks,
        line_order: LineOrder::Increasing,
    };
    let channels = channels
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples));
    let channels = AnyChannels::sort(channels.collect());
    Layer::new((size[0], size[1]), attributes, encoding, channels)
}

fn file(parts: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    let size = parts[0].size;
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let image = Image::from_layers(attributes, parts);
    let mut bytes = Cursor::new(Vec::new());
    let writer = image.write().non_parallel();
    writer.to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A file of one part, without compression.
fn plain(channels: Vec<Channel>) -> Vec<u8> {
    let stored = (Compression::Uncompressed, LINES);
    file(vec![part(None, channels, stored, SIZE)])
}

#[track_caller]
fn check_reads(bytes: &[u8], stored: Stored, case: &str) {
    let read = read_gbuffer(bytes, &ids()).unwrap_or_else(|fault| panic!("{case}: {fault}"));
    assert_eq!(read, pixels(stored), "{case}");
}

#[test]
fn every_sample_compression_and_order_is_read() {
    let lossless = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ];
    for stored in [Stored::Half, Stored::Float, Stored::Uint] {
        for compression in lossless {
            for blocks in [LINES, TILES] {
                let one = part(None, channels(stored), (compression, blocks), SIZE);
                let case = format!("{stored:?}, {compression}, {blocks:?}");
                check_reads(&file(vec![one]), stored, &case);
            }
        }
    }
}

/// Channels may lie in several parts, by their whole names or by the part's name and their own; parts of others are not read.
#[test]
fn several_parts_are_one_frame() {
    let mut all = channels(Stored::Float);
    let own = |channels: Vec<Channel>| -> Vec<Channel> {
        let names = ["R", "G", "B"].into_iter();
        let samples = channels.into_iter().map(|(_, samples)| samples);
        names.zip(samples).collect()
    };
    let other = own(all.split_off(7));
    let light = own(all.split_off(4));
    let beauty = vec![("R", FlatSamples::F32(vec![f32::NAN; 12]))];
    let bytes = file(vec![
        part(Some("beauty"), beauty, (Compression::PXR24, LINES), [4, 3]),
        part(Some("light"), light, (Compression::ZIP16, LINES), SIZE),
        part(Some("numbers"), all, (Compression::PIZ, TILES), SIZE),
        part(Some("other"), other, (Compression::RLE, LINES), SIZE),
    ]);
    check_reads(&bytes, Stored::Float, "several parts");
}

/// As Blender names the passes of a view layer, which are its own outputs of shaders.
#[test]
fn a_view_layer_of_blender_is_read() {
    let named = |name: &str| {
        if name.contains('.') {
            format!("ViewLayer.{name}")
        } else {
            format!("ViewLayer.{name}.V")
        }
    };
    let stored = Stored::Half;
    let blender: Vec<Channel> = channels(stored)
        .into_iter()
        .map(|(name, samples)| (&*named(name).leak(), samples))
        .collect();
    check_reads(&plain(blender), stored, "Blender");
    // A right name counts before one in a layer; two layers are told.
    let wrong = || samples(Stored::Float, vec![0.5; SIZE[0] * SIZE[1]]);
    let mut both = channels(stored);
    both.push(("ViewLayer.cos_theta.V", wrong()));
    check_reads(&plain(both), stored, "both");
    let mut two = channels(stored);
    two.retain(|(name, _)| *name != "cos_theta");
    two.push(("one.cos_theta.V", wrong()));
    two.push(("two.cos_theta.V", wrong()));
    check_refuses(
        &plain(two),
        "channel `cos_theta` stands twice, as `one.cos_theta.V` and as `two.cos_theta.V`",
    );
}

#[test]
fn what_may_be_missing_has_its_value() {
    let mut all = channels(Stored::Float);
    all.retain(|(name, _)| !name.starts_with("other") && !["roughness", "coverage"].contains(name));
    let frame = read_gbuffer(&plain(all), &ids()).unwrap();
    let statue = &frame.of_material[0];
    assert_eq!(statue.len(), (SIZE[0] * SIZE[1]).div_ceil(2));
    for pixel in statue {
        assert_eq!(
            (pixel.roughness, pixel.coverage, pixel.other),
            (0.0, 1.0, [0.0; 3])
        );
    }
}

/// A file whose channel has a value at column 12 of row 7, which shows the statue.
fn with(channel: &str, value: f32) -> Vec<u8> {
    let mut all = channels(Stored::Float);
    let place = 7 * SIZE[0] + 12;
    let mut set = |name: &str, value: f32| {
        let (_, samples) = all.iter_mut().find(|(its, _)| *its == name).unwrap();
        let FlatSamples::F32(values) = samples else {
            panic!("they are float");
        };
        values[place] = value;
    };
    set("material_id", 1.0);
    set("coverage", 1.0);
    set(channel, value);
    plain(all)
}

#[track_caller]
fn check_refuses(bytes: &[u8], says: &str) {
    let fault = read_gbuffer(bytes, &ids()).expect_err(says).to_string();
    assert!(fault.contains(says), "{fault}\n{says}");
}

#[test]
fn a_wrong_value_is_named_with_its_channel_and_pixel() {
    for (channel, value, says) in [
        (
            "light.G",
            f32::NAN,
            "NaN is not allowed; light must be finite and not negative",
        ),
        ("light.R", f32::INFINITY, "inf is not allowed"),
        ("light.B", -0.25, "-0.25 is not allowed"),
        ("other.G", f32::NEG_INFINITY, "-inf is not allowed"),
        (
            "cos_theta",
            1.0078125,
            "1.0078125 is not allowed; it must lie between 0 and 1",
        ),
        (
            "cos_theta",
            -0.5,
            "-0.5 is not allowed; it must lie between 0 and 1",
        ),
        ("cos_theta", f32::NAN, "NaN is not allowed; it must lie"),
        ("roughness", 1.5, "1.5 is not allowed"),
        ("coverage", -1.0, "-1 is not allowed"),
        ("coverage", f32::NAN, "NaN is not allowed"),
        ("material_id", 0.5, "0.5 is no id; ids are whole numbers"),
        ("material_id", -1.0, "-1 is no id"),
        ("material_id", f32::NAN, "NaN is no id"),
        ("material_id", 8_589_934_592.0, "8589934592 is no id"),
        (
            "material_id",
            9.0,
            "no material has the id 9; add `[[material]]` with `id = 9` to the map of materials, or 9 to its `ignore`",
        ),
    ] {
        let says = format!("channel {channel}, pixel (12, 7): {says}");
        check_refuses(&with(channel, value), &says);
    }
}

/// Rounding is forgiven, and what is not shown is not looked at.
#[test]
fn a_rounded_cosine_is_one() {
    let place = (7 * SIZE[0] + 12) as u32;
    for (value, wanted) in [(1.0009, 1.0), (-0.0009, 0.0)] {
        let frame = read_gbuffer(&with("cos_theta", value), &ids()).unwrap();
        let mut statue = frame.of_material[0].iter();
        let pixel = statue.find(|pixel| pixel.place == place).unwrap();
        assert_eq!(pixel.cos_theta, wanted);
    }
    let mut all = channels(Stored::Float);
    for (name, samples) in &mut all {
        if !["material_id", "coverage"].contains(name) {
            let FlatSamples::F32(values) = samples else {
                panic!("they are float");
            };
            for background in values.iter_mut().step_by(4) {
                *background = f32::NAN;
            }
        }
    }
    check_reads(&plain(all), Stored::Float, "a background of NaN");
}

#[test]
fn a_wrong_set_of_channels_is_named() {
    let without = |name: &str, instead: Option<&'static str>| {
        let mut all = channels(Stored::Half);
        let at = all.iter().position(|(its, _)| *its == name).unwrap();
        match instead {
            Some(instead) => all[at].0 = instead,
            None => drop(all.remove(at)),
        }
        plain(all)
    };
    check_refuses(
        &without("cos_theta", Some("cosTheta")),
        "channel `cos_theta` is missing (did you mean cosTheta?); the file has cosTheta, coverage, light.B, light.G, light.R, material_id, other.B, other.G, other.R, roughness",
    );
    check_refuses(
        &without("light.B", Some("light.b")),
        "channel `light.B` is missing (did you mean light.b?)",
    );
    check_refuses(
        &without("material_id", None),
        "channel `material_id` is missing; the file has",
    );
    // Light of one colour alone is an oversight.
    check_refuses(&without("other.G", None), "channel `other.G` is missing");
    let stored = (Compression::Uncompressed, LINES);
    let again = vec![(
        "light.R",
        samples(Stored::Float, vec![0.0; SIZE[0] * SIZE[1]]),
    )];
    let bytes = file(vec![
        part(Some("one"), channels(Stored::Half), stored, SIZE),
        part(Some("two"), again, stored, SIZE),
    ]);
    check_refuses(
        &bytes,
        "channel `light.R` stands twice, in part 1 and in part 2; it must stand once",
    );
}

/// The library writes no such file: a channel of another name gets its name afterwards.
#[test]
fn a_channel_that_stands_twice_in_a_part_is_named() {
    let mut all = channels(Stored::Float);
    let again = samples(Stored::Float, vec![0.0; SIZE[0] * SIZE[1]]);
    all.push(("light.S", again));
    let mut bytes = plain(all);
    let name = b"light.S\0";
    let at = bytes.windows(name.len()).position(|held| held == name);
    bytes[at.unwrap() + name.len() - 2] = b'R';
    check_refuses(
        &bytes,
        "channel `light.R` stands twice, both times in part 1; it must stand once",
    );
}

#[test]
fn what_is_stored_otherwise_is_refused() {
    let stored = (Compression::Uncompressed, LINES);
    let mut all = channels(Stored::Float);
    all.truncate(4);
    let light = |size: [usize; 2]| -> Vec<Channel> {
        let plane = || FlatSamples::F32(vec![0.5; size[0] * size[1]]);
        vec![("R", plane()), ("G", plane()), ("B", plane())]
    };
    let bytes = file(vec![
        part(Some("numbers"), all, stored, SIZE),
        part(Some("light"), light([19, 36]), stored, [19, 36]),
    ]);
    check_refuses(
        &bytes,
        "channel `light.R` has the data window 19 x 36 at (0, 0), and `cos_theta` has 19 x 37 at (0, 0)",
    );
    for (compression, name) in [(Compression::B44, "b44"), (Compression::PXR24, "pxr24")] {
        let one = part(None, channels(Stored::Float), (compression, LINES), SIZE);
        let says = format!(
            "the part with channel `cos_theta` has {name} compression; lossless ones are read"
        );
        check_refuses(&file(vec![one]), &says);
    }
    let mut deep = plain(channels(Stored::Float));
    deep[5] |= 8;
    check_refuses(&deep, "deep pixels");
    check_refuses(b"", "not a readable OpenEXR file");
    check_refuses(b"\x89PNG\r\n\x1a\n", "not a readable OpenEXR file");
}

/// A header that lies about its size costs no memory.
#[test]
fn a_frame_is_no_larger_than_its_file_can_hold() {
    let good = plain(channels(Stored::Float));
    let window = good
        .windows(10)
        .position(|part| part == b"dataWindow")
        .unwrap();
    let corner = window + b"dataWindow\0box2i\0".len() + 4 + 8;
    for ([x, y], says) in [
        ([8191_i32, 36], "bytes of pixels, which"),
        (
            [8192, 36],
            "a frame of 8193 x 37 pixels; the largest has 8192 x 8192",
        ),
        ([(1 << 20) - 1, 36], "a frame of 1048576 x 37 pixels"),
        ([8191, 8191], "not a readable OpenEXR file"),
        ([i32::MAX, i32::MIN], "not a readable OpenEXR file"),
    ] {
        let mut bytes = good.clone();
        bytes[corner..corner + 4].copy_from_slice(&x.to_le_bytes());
        bytes[corner + 4..corner + 8].copy_from_slice(&y.to_le_bytes());
        check_refuses(&bytes, says);
    }
}

#[test]
fn a_file_cut_short_is_refused() {
    for compression in [
        Compression::Uncompressed,
        Compression::ZIP16,
        Compression::PIZ,
    ] {
        let one = part(None, channels(Stored::Half), (compression, LINES), SIZE);
        let bytes = file(vec![one]);
        for end in (0..bytes.len()).step_by(97) {
            let fault = read_gbuffer(&bytes[..end], &ids()).expect_err("it is cut short");
            let fault = fault.to_string();
            let reasons = ["not a readable OpenEXR file", "broken or cut short"];
            let is_named = reasons.iter().any(|reason| fault.contains(reason));
            assert!(is_named, "{end}: {fault}");
        }
    }
}

/// What a fuzzer would try, a little of it on every machine: good files with a few bits changed.
#[test]
fn changed_bits_do_no_harm() {
    let mut random = fastrand::Rng::with_seed(11);
    let mut read = 0;
    for (compression, blocks) in [
        (Compression::Uncompressed, LINES),
        (Compression::RLE, TILES),
        (Compression::ZIP16, LINES),
        (Compression::PIZ, LINES),
        (Compression::PIZ, TILES),
    ] {
        let good = file(vec![part(
            None,
            channels(Stored::Uint),
            (compression, blocks),
            SIZE,
        )]);
        for round in 0..600 {
            let mut bytes = good.clone();
            // Half of the changes are in the header.
            let end = if round % 2 == 0 { 900 } else { bytes.len() };
            for _ in 0..random.usize(1..4) {
                bytes[random.usize(..end)] ^= 1 << random.u32(..8);
            }
            let Ok(frame) = read_gbuffer(&bytes, &ids()) else {
                continue;
            };
            read += 1;
            for pixel in frame.of_material.iter().flatten() {
                assert!((0.0..=1.0).contains(&pixel.cos_theta), "{pixel:?}");
                assert!(
                    pixel.light.iter().all(|light| light.is_finite()),
                    "{pixel:?}"
                );
            }
        }
    }
    assert!((100..2900).contains(&read), "{read} of 3000 are read");
}
