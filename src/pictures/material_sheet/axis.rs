//! Vertical axes that fit their curves, and the wavelengths that a material sheet shows: the measured part of 360 to 830 nm, the
//! range that an eye can see.

use crate::physics::materials::{DispersionCurve, Material};
use crate::physics::spectra::OBSERVED_NM;
use crate::pictures::plot::{ChartAxis, Series, ticks};

/// The approximate number of intervals of an axis.
const INTERVALS: usize = 5;
/// The least height of an axis. Below it a curve would show only rounding.
const LEAST_SPAN: f64 = 1e-5;

/// An axis that holds these values, with its ends rounded outwards.
pub fn holding(label: &str, values: impl IntoIterator<Item = f64>) -> ChartAxis {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    // Also where there are no values.
    let (low, high) = if high - low < LEAST_SPAN || low > high {
        let middle = if low > high { 0.5 } else { low };
        (middle - 0.5, middle + 0.5)
    } else {
        (low, high)
    };
    let step = match ticks(low, high, INTERVALS).as_slice() {
        [first, second, ..] => (second - first) / 4.0,
        _ => high - low,
    };
    let low = (low / step + 1e-9).floor() * step;
    let high = (high / step - 1e-9).ceil() * step;
    ChartAxis::new(label, [low, high], INTERVALS, "")
}

/// The axis of reflectance: 0 to 1, extended where a curve leaves that range.
pub fn reflectance(series: &[Series]) -> ChartAxis {
    holding("reflectance", values(series).chain([0.0, 1.0]))
}

/// All values of some curves.
pub fn values(series: &[Series]) -> impl Iterator<Item = f64> {
    series
        .iter()
        .flat_map(|one| one.points.iter().map(|point| point.1))
}

/// The margin beside points that stand alone.
const BESIDE_NM: f64 = 20.0;

/// The part of a range that is shown, if any.
pub fn shown((from, to): (f64, f64)) -> Option<(f64, f64)> {
    let inside = (from.max(OBSERVED_NM.0), to.min(OBSERVED_NM.1));
    (inside.0 <= inside.1).then_some(inside)
}

/// The shown part of the range where n or k is known.
pub fn either(material: &Material) -> Option<(f64, f64)> {
    let n = shown(material.n.range_nm());
    let k = material.k.as_ref().map(DispersionCurve::range_nm);
    match (n, k.and_then(shown)) {
        (Some(n), Some(k)) => Some((n.0.min(k.0), n.1.max(k.1))),
        (one, other) => one.or(other),
    }
}

/// A range from below the least to above the greatest of three wavelengths.
pub fn around(rgb: [f64; 3]) -> (f64, f64) {
    let [least, greatest] = [f64::min, f64::max].map(|end| rgb.into_iter().fold(rgb[0], end));
    (least - BESIDE_NM, greatest + BESIDE_NM)
}

/// The axis of a range, wide enough to look at; the whole visible range where there is none.
pub fn wavelength_axis(range: Option<(f64, f64)>) -> ChartAxis {
    let (mut low, mut high) = range.unwrap_or(OBSERVED_NM);
    if high - low < BESIDE_NM {
        (low, high) = (low - BESIDE_NM, high + BESIDE_NM);
    }
    ChartAxis::new("wavelength in vacuum (nm)", [low, high], 8, "")
}

/// The wavelengths at which a curve is drawn: both ends, and each whole nanometre between.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(values: &[f64], low: f64, high: f64) {
        let axis = holding("n", values.iter().copied());
        let near = |one: f64, other: f64| (one - other).abs() < 1e-9;
        assert!(near(axis.low, low) && near(axis.high, high), "{axis:?}");
        assert!(axis.ticks.len() >= 3, "{axis:?}");
    }

    #[test]
    fn ends_are_round_and_hold_all_values() {
        check(&[0.0, 1.0], 0.0, 1.0);
        check(&[0.0, 1.0 + 1e-15], 0.0, 1.0);
        check(&[0.0, 1.031], 0.0, 1.05);
        check(&[-0.02, 1.0], -0.05, 1.0);
        check(&[0.0, 5.26], 0.0, 5.5);
        check(&[1.51, 1.532], 1.51, 1.5325);
        check(&[1.5, 1.5], 1.0, 2.0);
        check(&[], 0.0, 1.0);
        check(&[f64::NAN, f64::INFINITY], 0.0, 1.0);
    }
}
