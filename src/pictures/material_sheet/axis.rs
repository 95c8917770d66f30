//! Vertical axes that fit their curves.

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
    ChartAxis {
        label: label.to_owned(),
        low,
        high,
        ticks: ticks(low, high, INTERVALS),
        unit: "",
    }
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
