//! Lookup tables: how wrong the filtered lookup is, and that files hold what they say, read by programs that are not ours.

use std::fs;
use std::process::Command;

use crate::not_checked;
use crate::stated::{check_stated, stated};
use fresnel_gen::cli::Cli;
use fresnel_gen::generator::bake::{BakeRequest, TableMaterial, TableSize, bake};
use fresnel_gen::generator::generate::tables::{artifacts, table_materials};
use fresnel_gen::generator::lut::{
    BetweenTexels, Depth, Format, Stored, Table, TableAxis, smallest, table_error,
};
use fresnel_gen::generator::reference::ReferenceCurve;
use fresnel_gen::generator::request::{Materials, Request, Source};
use fresnel_gen::language::ir::Weights;
use fresnel_gen::language::methods::Light;
use fresnel_gen::physics::materials::{self, Surface, ViewingConditions};
use fresnel_gen::physics::spectra::Gamut;

fn reference(name: &str) -> Option<ReferenceCurve> {
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..ViewingConditions::default()
    };
    let material = materials::find(name).unwrap().unwrap();
    let surface = Surface::new(&material, None, &viewing).ok()?;
    Some(ReferenceCurve::new(surface, Light::Unpolarised))
}

/// Whether one of the axes is good enough, and the least error of all.
fn least_error(reference: &ReferenceCurve, texels: usize, axes: &[TableAxis]) -> f64 {
    let error = |axis: &TableAxis| {
        let table = Table::new("", reference, *axis, texels).unwrap();
        let between = BetweenTexels::new(reference, *axis, texels);
        let stored = Stored::new(&table, Depth::Half);
        table_error(&stored, Weights::Steps256, reference, &between).max_abs
    };
    axes.iter().map(error).fold(f64::INFINITY, f64::min)
}

/// Half precision, filtered as GPUs do, within a step of a 10-bit screen.
#[test]
fn every_material_has_a_table_of_64_texels() {
    let mut more = Vec::new();
    for name in materials::names() {
        let Some(reference) = reference(name) else {
            continue;
        };
        let error = least_error(&reference, 64, &[TableAxis::Rational]);
        if error > 1.0 / 1023.0 && least_error(&reference, 64, &TableAxis::ALL) > 1.0 / 1023.0 {
            more.push(name);
        }
    }
    assert_eq!(more, MORE_THAN_64);
}

/// Materials that need more texels, and why.
const MORE_THAN_64: [&str; 0] = [];

/// Texels of the smallest table within .001, over all axes and depths that `bake --budget` tries.
#[test]
fn a_thousandth_takes_as_many_texels_as_the_page_says() {
    let depths = [Depth::Unorm8, Depth::Half, Depth::Unorm16, Depth::Float];
    let texels = |name: &str| {
        let reference = reference(name).unwrap();
        smallest(&[&reference], 1e-3, &TableAxis::ALL, &depths)
            .unwrap()
            .texels
    };
    let most = texels("zinc_querry");
    let page = "docs/tables.md";
    check_stated(vec![
        stated(
            page,
            "within .001 gold takes ",
            " texels, water ",
            texels("gold"),
        ),
        stated(
            page,
            " texels, water ",
            ", and no\nmaterial",
            texels("water"),
        ),
        stated(page, "material more than ", " of them. `--axis cos`", most),
    ]);
    // Half a step of 8 bits is more than .001, so that every table has 8 bytes a texel, or more.
    let half_step = 0.5 / f64::from(u8::MAX);
    assert!(half_step > 1e-3);
    for name in materials::names()
        .into_iter()
        .filter(|name| *name != "zinc_querry")
    {
        let Some(reference) = reference(name) else {
            continue;
        };
        let is_met = TableAxis::ALL.into_iter().any(|axis| {
            let table = Table::new("", &reference, axis, most - 1).unwrap();
            let between = BetweenTexels::new(&reference, axis, most - 1);
            let stored = Stored::new(&table, Depth::Unorm16);
            table_error(&stored, Weights::Steps256, &reference, &between).max_abs <= 1e-3
        });
        assert!(is_met, "{name}: {} texels are too few", most - 1);
    }
}

#[test]
fn filtering_is_exact_at_both_ends() {
    for name in ["gold", "water"] {
        let reference = reference(name).unwrap();
        for axis in TableAxis::ALL {
            for texels in [2, 3, 64, 1000] {
                let table = Table::new(name, &reference, axis, texels).unwrap();
                let stored = Stored::new(&table, Depth::Float);
                for (c, texel) in [(0.0, 0), (1.0, texels - 1)] {
                    let got = stored.lookup(Weights::Steps256, c);
                    assert_eq!(got, table.texels[texel].map(|value| value as f32));
                }
            }
        }
    }
}

fn request(names: &str, formats: &[Format], atlas: bool) -> BakeRequest {
    let sources = names.split(',').map(|name| Source::Named(name.to_owned()));
    let wanted = Request {
        materials: Materials::These(sources.collect()),
        viewing: ViewingConditions {
            gamut: Gamut::Keep,
            ..ViewingConditions::default()
        },
        ..Request::default()
    };
    BakeRequest {
        subjects: table_materials(&wanted).unwrap().0,
        typed: names.split(',').map(str::to_owned).collect(),
        formats: formats.to_vec(),
        shape: TableSize::Fixed {
            axis: TableAxis::Rational,
            texels: 64,
        },
        atlas,
        targets: Vec::new(),
        prefix: "fresnel_".to_owned(),
        flags: String::new(),
    }
}

fn files(request: &BakeRequest) -> Vec<(String, Vec<u8>)> {
    let baked = bake(request, &mut |_, _, _| {}).unwrap();
    let files = baked.into_iter().flat_map(artifacts);
    files.map(|file| (file.path, file.bytes)).collect()
}

#[test]
fn equal_requests_give_equal_bytes() {
    let request = request("gold,water", &Format::ALL, true);
    let once = files(&request);
    assert_eq!(once, files(&request));
    assert_eq!(once.len(), 3 * (Format::ALL.len() + 1));
    // Alone or with others: a material's files are the same.
    let alone = files(&self::request("gold", &Format::ALL, false));
    for (file, bytes) in alone {
        let same = once
            .iter()
            .any(|(other, theirs)| *other == file && *theirs == bytes);
        assert!(same, "{file}");
    }
}

/// The values that a picture of these rows has in a depth, row by row.
fn expected(request: &BakeRequest, depth: Depth) -> (f32, Vec<[f32; 3]>) {
    let table = |subject: &TableMaterial| {
        Table::new(&subject.name, &subject.reference, TableAxis::Rational, 64).unwrap()
    };
    let tables: Vec<Table> = request.subjects.iter().map(table).collect();
    let scale = Table::shared_scale(&tables.iter().collect::<Vec<_>>(), depth);
    let texels = tables
        .iter()
        .flat_map(|table| Stored::scaled(table, depth, scale).texels);
    (scale, texels.collect())
}

#[track_caller]
fn file<'a>(files: &'a [(String, Vec<u8>)], name: &str) -> &'a [u8] {
    &files.iter().find(|(file, _)| file == name).unwrap().1
}

#[test]
fn ktx2_is_read_back() {
    let request = request("gold,water", &[Format::Ktx2], true);
    let files = files(&request);
    let (_, want) = expected(&request, Depth::Half);
    let reader = ktx2::Reader::new(file(&files, "lut/atlas.ktx2")).unwrap();
    let header = reader.header();
    assert_eq!(header.format, Some(ktx2::Format::R16G16B16A16_SFLOAT));
    assert_eq!((header.pixel_width, header.pixel_height), (64, 2));
    assert_eq!((header.pixel_depth, header.layer_count), (0, 0));
    assert_eq!((header.face_count, header.level_count), (1, 1));
    assert_eq!(header.type_size, 2);
    assert_eq!(
        reader.transfer_function(),
        Some(ktx2::TransferFunction::Linear)
    );
    assert_eq!(reader.color_primaries(), Some(ktx2::ColorPrimaries::BT709));
    assert_eq!(reader.color_model(), Some(ktx2::ColorModel::RGBSDA));
    assert_eq!(
        reader.writer().map(|name| name.trim_end_matches('\0')),
        Some("fresnel-gen")
    );
    let samples = &reader.basic_dfd().unwrap().sample_information;
    assert_eq!(samples.len(), 4);
    let pairs: Vec<_> = reader.key_value_data().collect();
    assert_eq!(pairs[0], ("KTXorientation", &b"rd\0"[..]));
    let level = reader.levels().next().unwrap();
    let bits: Vec<u16> = level
        .data
        .chunks_exact(2)
        .map(|pair| u16::from_le_bytes([pair[0], pair[1]]))
        .collect();
    check_halves(&bits, &want);
}

#[track_caller]
fn check_halves(bits: &[u16], want: &[[f32; 3]]) {
    assert_eq!(bits.len(), 4 * want.len());
    for (texel, want) in bits.chunks_exact(4).zip(want) {
        let value = |bits: u16| half::f16::from_bits(bits).to_f32();
        assert_eq!([texel[0], texel[1], texel[2]].map(value), *want);
        assert_eq!(texel[3], 0x3c00);
    }
}

#[test]
fn arrays_hold_the_bits() {
    let request = request("gold", &[Format::C, Format::Rust, Format::Js], false);
    let files = files(&request);
    let (_, want) = expected(&request, Depth::Half);
    for ending in ["h", "rs", "js"] {
        let text = std::str::from_utf8(file(&files, &format!("lut/gold.{ending}"))).unwrap();
        assert!(text.is_ascii() && text.starts_with("// @generated by fresnel-gen: "));
        let words = text.split("0x").skip(1);
        let bits: Vec<u16> = words
            .map(|word| u16::from_str_radix(&word[..4], 16).unwrap())
            .collect();
        check_halves(&bits, &want);
    }
}

/// Whether a program is there; where it is not, the run says what stays unchecked.
fn is_here(command: &str, package: &str, what: &str) -> bool {
    let found = Command::new(command).arg("--version").output().is_ok();
    if !found {
        not_checked(&format!("{what}: no {command} (Debian package {package})"));
    }
    found
}

/// A picture's 16-bit integers by ImageMagick, which uses other libraries than ours.
fn by_imagemagick(path: &std::path::Path) -> Option<Vec<u16>> {
    let output = Command::new("convert")
        .arg(path)
        .args([
            "-set",
            "colorspace",
            "sRGB",
            "-depth",
            "16",
            "-endian",
            "MSB",
            "rgb:-",
        ])
        .output()
        .unwrap();
    let words = output.stdout.chunks_exact(2);
    let words = words.map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
    output.status.success().then(|| words.collect())
}

#[test]
fn pictures_are_read_back_by_others() {
    let formats = [
        Format::ExrHalf,
        Format::ExrFloat,
        Format::Png8,
        Format::Png16,
    ];
    let request = request("platinum,water", &formats, true);
    let folder = tempfile::tempdir().unwrap();
    for (path, bytes) in files(&request) {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
    if !is_here("convert", "imagemagick", "pictures of tables, read back") {
        return;
    }
    for format in formats {
        let path = folder.path().join(format!("lut/atlas{}", format.ending()));
        let Some(got) = by_imagemagick(&path) else {
            let package = "libmagickcore-6.q16-6-extra";
            not_checked(&format!(
                "{} read back: convert cannot (Debian package {package})",
                format.name()
            ));
            continue;
        };
        let (_, want) = expected(&request, format.depth());
        assert_eq!(got.len(), 3 * want.len(), "{}", format.name());
        for (got, want) in got.iter().zip(want.iter().flatten()) {
            let want = (f64::from(*want) * 65535.0).round();
            // ImageMagick reads an EXR's floats as halves and makes integers of them; of a PNG's it loses nothing.
            let within = match format {
                Format::ExrFloat => 17.0,
                Format::ExrHalf => 1.0,
                _ => 0.0,
            };
            assert!(
                (f64::from(*got) - want).abs() <= within,
                "{}: {got} {want}",
                format.name()
            );
        }
    }
}

/// EXR by a reader of a page of Python, which knows nothing but the file layout: every bit.
#[test]
fn exr_is_read_back_to_the_last_bit() {
    if !is_here("python3", "python3", "EXR tables to the last bit") {
        return;
    }
    let formats = [Format::ExrHalf, Format::ExrFloat];
    let request = request("gold,water", &formats, true);
    let folder = tempfile::tempdir().unwrap();
    for format in formats {
        let name = format!("lut/atlas{}", format.ending());
        let path = folder.path().join("atlas.exr");
        fs::write(&path, file(&files(&request), &name)).unwrap();
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/read_exr.py");
        let output = Command::new("python3")
            .arg(script)
            .arg(&path)
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let got: Vec<f32> = text
            .split_whitespace()
            .map(|word| word.parse().unwrap())
            .collect();
        let (_, want) = expected(&request, format.depth());
        assert_eq!(got, want.concat(), "{name}");
    }
}

#[test]
fn others_find_no_fault_with_the_files() {
    let formats = [
        Format::ExrHalf,
        Format::ExrFloat,
        Format::Png8,
        Format::Png16,
    ];
    let request = request("gold", &formats, false);
    let folder = tempfile::tempdir().unwrap();
    let tools = [
        (".exr", "exrheader", "openexr", "16-bit floating-point"),
        (
            ".float.exr",
            "exrheader",
            "openexr",
            "32-bit floating-point",
        ),
        (
            ".8bit.png",
            "pngcheck",
            "pngcheck",
            "gAMA at offset 0x00025, length 4: 1.0000",
        ),
        (".png", "pngcheck", "pngcheck", "48-bit RGB"),
    ];
    for (ending, tool, package, says) in tools {
        if !is_here(tool, package, &format!("tables as {ending}")) {
            continue;
        }
        let name = format!("gold{ending}");
        let path = folder.path().join(&name);
        fs::write(&path, file(&files(&request), &format!("lut/{name}"))).unwrap();
        let flag = (tool == "pngcheck").then_some("-v");
        let output = Command::new(tool).args(flag).arg(&path).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(
            output.status.success() && text.contains(says),
            "{name}: {text}"
        );
        for absent in ["sRGB", "iCCP", "tIME", "capDate"] {
            let chunk = format!("chunk {absent}");
            assert!(
                !text.contains(&chunk) && !text.contains("capDate"),
                "{name}: {text}"
            );
        }
    }
}

#[test]
fn the_default_materials_are_baked_without_flags() {
    let names: Vec<String> = table_materials(&Request::default())
        .unwrap()
        .0
        .into_iter()
        .map(|one| one.name)
        .collect();
    assert_eq!(names, ["diamond", "gold", "platinum", "water"]);
    use clap::CommandFactory;
    assert!(
        Cli::command()
            .get_subcommands()
            .any(|command| command.get_name() == "bake")
    );
}
