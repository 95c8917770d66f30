//! The wavelengths that a material sheet shows: the measured part of 360 to 830 nm, what an eye can see.

use crate::physics::materials::{DispersionCurve, Material};
use crate::physics::spectra::OBSERVED_NM;
use crate::pictures::plot::{ChartAxis, ticks};

/// Beside points that stand alone.
const BESIDE_NM: f64 = 20.0;

/// The part of a range that is shown, if any.
pub fn shown((from, to): (f64, f64)) -> Option<(f64, f64)> {
    let inside = (from.max(OBSERVED_NM.0), to.min(OBSERVED_NM.1));
    (inside.0 <= inside.1).then_some(inside)
}

/// The part that is shown where n or k is known.
pub fn either(material: &Material) -> Option<(f64, f64)> {
    let n = shown(material.n.range_nm());
    let k = material
        .k
        .as_ref()
        .map(DispersionCurve::range_nm)
        .and_then(shown);
    match (n, k) {
        (Some(n), Some(k)) => Some((n.0.min(k.0), n.1.max(k.1))),
        (one, other) => one.or(other),
    }
}

/// From below the least to above the greatest of three wavelengths.
pub fn around(rgb: [f64; 3]) -> (f64, f64) {
    let [least, greatest] = [f64::min, f64::max].map(|end| rgb.into_iter().fold(rgb[0], end));
    (least - BESIDE_NM, greatest + BESIDE_NM)
}

/// The axis of a range, wide enough to look at; all that is visible where there is none.
pub fn wavelength_axis(range: Option<(f64, f64)>) -> ChartAxis {
    let (mut low, mut high) = range.unwrap_or(OBSERVED_NM);
    if high - low < BESIDE_NM {
        (low, high) = (low - BESIDE_NM, high + BESIDE_NM);
    }
    ChartAxis {
        label: "wavelength in vacuum (nm)".to_owned(),
        low,
        high,
        ticks: ticks(low, high, 8),
        unit: "",
    }
}

/// Wavelengths at which a curve is drawn: both ends, and each whole nanometre between.
pub fn samples((from, to): (f64, f64)) -> Vec<f64> {
    let whole = (from.floor() as i64 + 1..to.ceil() as i64).map(|nm| nm as f64);
    let mut samples: Vec<f64> = std::iter::once(from).chain(whole).chain([to]).collect();
    samples.dedup();
    samples
}

/// A range in words, without needless digits.
pub fn words((from, to): (f64, f64)) -> String {
    let [from, to] = [from, to].map(|nm| (10.0 * nm).round() / 10.0);
    if from < to {
        return format!("from {from} to {to} nm");
    }
    format!("at {from} nm")
}
