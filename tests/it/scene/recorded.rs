//! What each picture says of itself: recorded, so that better and worse are both seen. `BLESS=1` rewrites the record.

use std::path::Path;

use super::{device, glass_of, pictured};
use crate::{bless, records};
use fresnel_gen::physics::records::rows;
use fresnel_gen::pictures::scene::{self, OpticalMaterial, sky};

const SIZE: u32 = 128;
const HEAD: [&str; 12] = [
    "name",
    "n",
    "hits",
    "total",
    "true_total",
    "false_total",
    "missed_total",
    "error_mean",
    "error_p99",
    "own_mean",
    "own_p99",
    "leaks",
];

/// A line of the record: a picture, its index, the figures in the order of the head, and leaks where there is water.
type Line = (String, String, [f64; 9], Option<u64>);

/// Pictures with other indices beside those of their materials.
const MORE: [(&str, f64); 4] = [
    ("double_refraction", 1.5),
    ("double_refraction", 2.42),
    ("double_refraction_gem", 1.5),
    ("double_refraction_gem", 2.42),
];

#[test]
fn figures_of_pictures_are_the_recorded_ones() {
    let Some(device) = device() else { return };
    let sky = sky();
    let own = scene::ALL.iter().map(|row| (row.name, glass_of(row)));
    let more = MORE.map(|(name, n)| (name, OpticalMaterial::of_index(n)));
    let measured: Vec<Line> = own
        .chain(more)
        .map(|(name, glass)| {
            let row = pictured(&device, name, &glass, &sky, SIZE).row;
            let figures = [
                row.hits,
                row.total,
                row.true_total,
                row.false_total,
                row.missed_total,
                row.error.mean,
                row.error.p99,
                row.own_error.mean,
                row.own_error.p99,
            ];
            (name.to_owned(), format!("{:.4}", row.n), figures, row.leaks)
        })
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/records/renders.csv");
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let recorded: Vec<Line> = rows(&text);
    let faults = faults(&measured, &recorded);
    if bless::is_on() && !faults.is_empty() {
        std::fs::write(&path, written(&measured)).unwrap();
        return;
    }
    assert!(
        faults.is_empty(),
        "{faults}BLESS=1 cargo test rewrites them"
    );
}

fn written(measured: &[Line]) -> String {
    let cells = |(name, n, figures, leaks): &Line| -> [String; 12] {
        let figures = figures.iter().map(|figure| format!("{figure:.4}"));
        let cells: Vec<String> = [name.clone(), n.clone()]
            .into_iter()
            .chain(figures)
            .chain([leaks.map_or_else(String::new, |leaks| leaks.to_string())])
            .collect();
        cells.try_into().unwrap()
    };
    let lines: Vec<[String; 12]> = measured.iter().map(cells).collect();
    records::text(HEAD, &lines)
}

/// Shares within .003, errors within a twentieth: drivers round in their own ways. Leaks are counted.
fn faults(measured: &[Line], recorded: &[Line]) -> String {
    if measured.len() != recorded.len() {
        return format!("{} pictures, {} recorded\n", measured.len(), recorded.len());
    }
    let mut faults = String::new();
    for (is, was) in measured.iter().zip(recorded) {
        let differs = (0..9).any(|i| {
            let within = if i < 5 { 0.003 } else { 0.05 + 0.05 * was.2[i] };
            (is.2[i] - was.2[i]).abs() > within
        });
        if (&is.0, &is.1, is.3) != (&was.0, &was.1, was.3) || differs {
            faults += &format!("measured {is:?}\nrecorded {was:?}\n");
        }
    }
    faults
}
