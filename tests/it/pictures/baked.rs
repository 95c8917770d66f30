//! Tables as pictures: the first texel is grazing, the last is normal incidence, rows are where their description says.

use std::io::Cursor;

use half::f16;
use serde_json::Value;

use super::Fact;
use super::PictureFile;
use super::check_all;
use crate::cli::Place;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*lut/atlas.*",
        says: "each row is its material's: 1 at grazing on the left, F0 on the right",
        holds: rows_are_their_materials,
    },
    Fact {
        pictures: "*lut/gold.*",
        says: "a row begins with 1 at grazing and ends with gold's F0, yellow",
        holds: rows_are_their_materials,
    },
    Fact {
        pictures: "*lut/platinum.*",
        says: "a row begins with 1, dips, and ends with platinum's F0",
        holds: rows_are_their_materials,
    },
    Fact {
        pictures: "*lut/water.*",
        says: "a row begins with 1 and falls to a fiftieth",
        holds: rows_are_their_materials,
    },
    Fact {
        pictures: "*lut/diamond.*",
        says: "a row begins with 1 and falls to .173",
        holds: rows_are_their_materials,
    },
    Fact {
        pictures: "*lut/dfg_*",
        says: "a white surface reflects all where it is smooth or seen at grazing, never more than all, and 1 - ln 2 where it is rough and seen from above",
        holds: white_loses_what_masking_takes,
    },
];

/// F0 over the visible spectrum in linear sRGB under D65, as tables of n and k give it, and how exact that is.
const F0: [(&str, [f64; 3]); 4] = [
    ("gold", [1.038, 0.773, 0.340]),
    ("platinum", [0.679, 0.640, 0.584]),
    ("water", [0.0202, 0.0205, 0.0210]),
    ("diamond", [0.171, 0.173, 0.175]),
];
const WITHIN: f64 = 5e-3;

/// A picture's texels, before their scale.
pub struct Texels {
    pub width: usize,
    pub height: usize,
    pub values: Vec<[f64; 4]>,
}

impl Texels {
    fn new(shown: &PictureFile) -> Texels {
        let bytes = shown.bytes();
        match shown.file.rsplit('.').next() {
            Some("png") => png_texels(&bytes),
            Some("exr") => exr_texels(&bytes),
            _ => ktx2_texels(&bytes),
        }
    }

    fn at(&self, row: usize, column: usize) -> [f64; 4] {
        self.values[row * self.width + column]
    }
}

fn png_texels(bytes: &[u8]) -> Texels {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut samples = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut samples).unwrap();
    let values: Vec<f64> = match info.bit_depth {
        png::BitDepth::Eight => samples
            .iter()
            .map(|byte| f64::from(*byte) / 255.0)
            .collect(),
        _ => samples
            .chunks(2)
            .map(|pair| f64::from(u16::from_be_bytes([pair[0], pair[1]])) / 65535.0)
            .collect(),
    };
    let channels = info.color_type.samples();
    let texel = |texel: &[f64]| {
        [
            texel[0],
            texel[1],
            texel[2],
            texel.get(3).copied().unwrap_or(1.0),
        ]
    };
    Texels {
        width: info.width as usize,
        height: info.height as usize,
        values: values.chunks(channels).map(texel).collect(),
    }
}

pub fn exr_texels(bytes: &[u8]) -> Texels {
    use exr::prelude::*;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes();
    let image = image.from_buffered(Cursor::new(bytes)).unwrap();
    let layer = &image.layer_data[0];
    let size = layer.size;
    let channel = |name: &str| -> Vec<f64> {
        let own = layer
            .channel_data
            .list
            .iter()
            .find(|channel| channel.name.eq(name));
        let values = own.map(|own| own.sample_data.values_as_f32().map(f64::from).collect());
        values.unwrap_or_else(|| vec![1.0; size.area()])
    };
    let [r, g, b, a] = ["R", "G", "B", "A"].map(channel);
    Texels {
        width: size.width(),
        height: size.height(),
        values: (0..size.area()).map(|i| [r[i], g[i], b[i], a[i]]).collect(),
    }
}

fn ktx2_texels(bytes: &[u8]) -> Texels {
    let reader = ktx2::Reader::new(bytes).unwrap();
    let header = reader.header();
    let level = reader.levels().next().unwrap();
    let half = |pair: &[u8]| f16::from_le_bytes([pair[0], pair[1]]).to_f64();
    let texel = |texel: &[u8]| [0, 2, 4, 6].map(|at| half(&texel[at..at + 2]));
    Texels {
        width: header.pixel_width as usize,
        height: header.pixel_height as usize,
        values: level.data.chunks(8).map(texel).collect(),
    }
}

/// The rows that the JSON beside it tells of this file.
fn told(shown: &PictureFile) -> Vec<Value> {
    let name = shown.file.rsplit('/').next().unwrap();
    let json = shown
        .file
        .replace(name, &format!("{}.json", name.split('.').next().unwrap()));
    let report: Value = serde_json::from_slice(&shown.beside(&json).unwrap()).unwrap();
    let rows = report["rows"].as_array().unwrap().iter();
    let own = rows.filter(|row| {
        row["file"]
            .as_str()
            .unwrap()
            .ends_with(&format!("lut/{name}"))
    });
    own.cloned().collect()
}

fn rows_are_their_materials(shown: &PictureFile) {
    let (texels, rows) = (Texels::new(shown), told(shown));
    assert_eq!(rows.len(), texels.height, "{}", shown.file);
    for row in &rows {
        let scale = row["scale"].as_f64().unwrap();
        let place = row["row"].as_u64().unwrap() as usize;
        let line: Vec<[f64; 3]> = (0..texels.width)
            .map(|column| texels.at(place, column))
            .map(|[r, g, b, _]| [r, g, b].map(|value| scale * value))
            .collect();
        row_is_its_materials(row["material"].as_str().unwrap(), &line);
    }
}

#[track_caller]
fn row_is_its_materials(material: &str, line: &[[f64; 3]]) {
    let (_, f0) = F0.iter().find(|(name, _)| *name == material).unwrap();
    let (first, last) = (line[0], line[line.len() - 1]);
    for channel in 0..3 {
        assert!(
            (first[channel] - 1.0).abs() < WITHIN,
            "{material}: {first:?} at grazing"
        );
        assert!(
            (last[channel] - f0[channel]).abs() < WITHIN,
            "{material}: {last:?} at 0 degrees"
        );
        let lowest = line
            .iter()
            .map(|texel| texel[channel])
            .fold(f64::INFINITY, f64::min);
        let dips = lowest < f0[channel] - 0.01;
        let metal_dips = material == "platinum" || material == "gold" && channel == 0;
        assert_eq!(dips, metal_dips, "{material}, channel {channel}: {lowest}");
    }
}

/// With the first term alone, which has no factor, F is 1. A file of the fourth term holds it in every channel.
fn white_loses_what_masking_takes(shown: &PictureFile) {
    let texels = Texels::new(shown);
    if shown.file.contains("_t3.") {
        let grey = |texel: &[f64; 4]| texel[0] == texel[1] && texel[1] == texel[2];
        assert!(texels.values.iter().all(grey) && texels.at(0, 0)[0] > 0.99);
        return;
    }
    let last = texels.width - 1;
    let white = |row: usize, column: usize| texels.at(row, column)[0];
    let all = texels.values.iter().map(|texel| texel[0]);
    assert!(
        all.fold(0.0, f64::max) < 1.0 + WITHIN,
        "more than all is reflected"
    );
    for place in 0..=last {
        assert!(
            (white(0, place) - 1.0).abs() < WITHIN,
            "a mirror loses nothing, at {place}"
        );
        assert!(
            (white(place, 0) - 1.0).abs() < WITHIN,
            "nothing is lost at grazing, at {place}"
        );
    }
    // Rougher is darker, seen from above; at roughness 1 what is left is 1 - ln 2.
    for row in 1..=last {
        assert!(white(row, last) < white(row - 1, last) + WITHIN);
    }
    assert!((white(last, last) - (1.0 - 2.0f64.ln())).abs() < WITHIN);
    // The second term falls from grazing to normal, on a mirror by its own factor.
    let [grazing, normal] = [0, last].map(|column| texels.at(0, column)[1]);
    assert!(grazing > 0.99 && normal < 0.05, "{grazing} {normal}");
}

#[test]
fn tables_hold_reflectance_from_grazing_to_normal() {
    let place = Place::new();
    let formats = "--format exr-half,exr-float,png8,png16,ktx2";
    let materials = "--material gold,platinum,water,diamond --atlas";
    place.done(&format!("bake {materials} --size 32 {formats}"));
    for method in ["fitted", "fitted_dielectric"] {
        place.done(&format!("bake --dfg --method {method} --size 16 {formats}"));
    }
    assert_eq!(check_all(&place.path("")).len(), 43);
}
