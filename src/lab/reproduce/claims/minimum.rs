//! The claims about the angle at which metals reflect least (sections 3.2.3 and 3.2.4).

use crate::lab::reproduce::comparison::{
    ComparisonRow, ComparisonVerdict, Figure, measured, statement,
};
use crate::lab::reproduce::figures::{cosine, exact, highest, lowest};
use crate::lab::reproduce::specialised;
use crate::physics::materials::{Channels, THESIS_NM};
use crate::physics::num::each_channel;

/// Where the thesis puts the minimum: cos θ = 0.15 and 0.10.
const CLAIMED: std::ops::RangeInclusive<f64> = 81.37..=84.26;
/// The error of the rescaled Schlick from which on a correction is worthwhile: a hundredth, two or three steps of an eight-bit
/// display.
const WORTH_CORRECTING: f64 = 0.01;

/// More metals, to test what the thesis says of metals in general.
const OTHERS: [&str; 6] = [
    "silver",
    "aluminium_rakic",
    "chromium",
    "copper",
    "sodium",
    "tungsten",
];

/// One metal at one wavelength.
struct MetalAtWavelength {
    name: String,
    /// The angle of the least reflectance.
    minimum: f64,
    least: f64,
    /// The angle at which the rescaled Schlick is furthest from the exact law.
    furthest: f64,
    apart: f64,
}

/// The claims about the minimum.
pub fn minimum_claims() -> Vec<ComparisonRow> {
    let curves = curves();
    let worth: Vec<&MetalAtWavelength> = curves
        .iter()
        .filter(|c| c.apart > WORTH_CORRECTING)
        .collect();
    let mut rows = vec![
        of_reflectance(&worth, curves.len()),
        of_difference(&worth, curves.len()),
    ];
    rows.extend(curves.iter().flat_map(figures));
    rows
}

fn curves() -> Vec<MetalAtWavelength> {
    let thesis =
        ["gold", "platinum"].map(|name| (format!("thesis {name}"), specialised::channels(name)));
    let others = OTHERS.map(|name| (name.to_owned(), specialised::unrounded(name)));
    let all = thesis.into_iter().chain(others);
    all.flat_map(|(name, channels)| three(&name, &channels))
        .collect()
}

fn three(name: &str, channels: &Channels) -> [MetalAtWavelength; 3] {
    each_channel(|i| {
        let name = format!("{name}, {} nm", THESIS_NM[i]);
        curve(name, [channels.n[i], channels.k[i]])
    })
}

fn curve(name: String, index: [f64; 2]) -> MetalAtWavelength {
    let function = specialised::function("schlick_rescaled", &specialised::grey(index));
    let reflectance = |degrees| exact(index, degrees).unpolarised();
    let (minimum, least) = lowest(reflectance);
    let (furthest, apart) = highest(|degrees| {
        (specialised::at(&function, cosine(degrees)) - reflectance(degrees)).abs()
    });
    MetalAtWavelength {
        name,
        minimum,
        least,
        furthest,
        apart,
    }
}

fn of_reflectance(curves: &[&MetalAtWavelength], all: usize) -> ComparisonRow {
    let (inside, low, high) = within(curves, |curve| curve.minimum);
    let ours = format!(
        "{inside} of {} (those of {all} metal channels for which the rescaled Schlick is more than {WORTH_CORRECTING} \
         off): the least unpolarised reflectance stands at {low:.2}° to {high:.2}° (0° is a curve that only rises)",
        curves.len()
    );
    let claim = "for most metals whose error is worth correcting, the local minimum lies between 81.37° and 84.26°";
    statement("minimum of metals", "section 3.2.4", claim, ours)
        .verdict(ComparisonVerdict::of_claim(2 * inside > curves.len()))
}

fn of_difference(curves: &[&MetalAtWavelength], all: usize) -> ComparisonRow {
    let (inside, low, high) = within(curves, |curve| curve.furthest);
    let ours = format!(
        "{inside} of the same {} (of {all}): the rescaled Schlick is furthest off at {low:.2}° to {high:.2}°",
        curves.len()
    );
    let claim = "the same range, read as the place of the largest error, which is what the correction is made for";
    statement("largest error on metals", "section 3.2.4", claim, ours)
        .verdict(ComparisonVerdict::of_claim(2 * inside > curves.len()))
}

/// How many lie in the claimed range, and the range of all.
fn within(
    curves: &[&MetalAtWavelength],
    angle: fn(&MetalAtWavelength) -> f64,
) -> (usize, f64, f64) {
    let angles: Vec<f64> = curves.iter().map(|curve| angle(curve)).collect();
    let inside = angles
        .iter()
        .filter(|angle| CLAIMED.contains(angle))
        .count();
    let low = angles.iter().copied().fold(90.0, f64::min);
    (inside, low, angles.into_iter().fold(0.0, f64::max))
}

fn figures(curve: &MetalAtWavelength) -> [ComparisonRow; 4] {
    let row = |column: &str, figure| measured(&curve.name, column, figure);
    [
        row("minimum", Figure::percent(100.0 * curve.least)),
        row("its angle", Figure::Number(curve.minimum, 2, "°")),
        row(
            "largest error of rescaled",
            Figure::Number(curve.apart, 4, ""),
        ),
        row("angle of that", Figure::Number(curve.furthest, 2, "°")),
    ]
}
