//! Round axis ticks and their labels.

/// Ticks from `low` to `high` at a step of 1, 2 or 5 times a power of ten.
///
/// The step is the one that comes nearest to `about` intervals (from 1 to
/// 100). A range that is empty, reversed or not finite has no ticks.
pub fn ticks(low: f64, high: f64, about: usize) -> Vec<f64> {
    let span = high - low;
    // Beyond these bounds the powers of ten below would overflow.
    if !(1e-200..1e200).contains(&span) {
        return Vec::new();
    }
    let raw = span / about.clamp(1, 100) as f64;
    let exponent = libm::log10(raw).floor() as i32;
    // The bounds are the geometric means of neighbouring digits.
    let digit = match raw / libm::exp10(f64::from(exponent)) {
        lead if lead < 2f64.sqrt() => 1.0,
        lead if lead < 10f64.sqrt() => 2.0,
        lead if lead < 50f64.sqrt() => 5.0,
        _ => 10.0,
    };
    let power = libm::exp10(f64::from(exponent.abs()));
    // One rounding only, so that three steps of 0.1 are 0.3 and nothing else.
    let times = |count: f64| match exponent {
        ..0 => count * digit / power,
        _ => count * digit * power,
    };
    let step = times(1.0);
    // The slack keeps an end that rounding moved just past a multiple.
    let first = (low / step - 1e-9).ceil();
    let last = (high / step + 1e-9).floor();
    let count = (last - first).max(-1.0) as i64;
    let multiples = (0..=count).map(|index| times(first + index as f64));
    let mut values: Vec<f64> = multiples.collect();
    // A span of a few rounding errors maps several multiples to one number.
    values.dedup();
    values
}

/// Ticks of an axis in powers of ten: these multiples of each power, from `low` to `high`, give or take a thousandth.
pub fn log_ticks(low: f64, high: f64, multiples: &[f64]) -> Vec<f64> {
    let powers = libm::floor(libm::log10(low)) as i32..=libm::ceil(libm::log10(high)) as i32;
    let all = powers.flat_map(|power| {
        let power = libm::exp10(f64::from(power));
        multiples.iter().map(move |multiple| multiple * power)
    });
    let is_inside = |value: &f64| (low * 0.999..=high * 1.001).contains(value);
    all.filter(is_inside).collect()
}

/// A number without trailing zeros.
pub fn plain_label(value: f64) -> String {
    format!("{}", value as f32)
}

/// A power of ten, in plain form where that is short.
pub fn power_label(exponent: i32) -> String {
    match exponent {
        -2..=3 => plain_label(libm::exp10(f64::from(exponent))),
        _ => format!("1e{exponent}"),
    }
}

/// The fewest decimals, up to six, that show all the ticks exactly.
pub(super) fn decimals(ticks: &[f64]) -> usize {
    let exact = |places: &usize| ticks.iter().all(|tick| is_exact(*tick, *places));
    (0..6).find(exact).unwrap_or(6)
}

/// A tick label, with a true minus sign.
pub(super) fn label(value: f64, decimals: usize, unit: &str) -> String {
    // Adding zero turns a negative zero into a positive one.
    format!("{:.decimals$}{unit}", value + 0.0).replace('-', "−")
}

fn is_exact(value: f64, places: usize) -> bool {
    let scaled = value * libm::exp10(places as f64);
    (scaled - scaled.round()).abs() <= 1e-9 * scaled.abs().max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        let cases: [(f64, f64, usize, &[f64]); 9] = [
            (
                0.0,
                90.0,
                9,
                &[0., 10., 20., 30., 40., 50., 60., 70., 80., 90.],
            ),
            (0.0, 100.0, 5, &[0.0, 20.0, 40.0, 60.0, 80.0, 100.0]),
            (0.0, 1.0, 4, &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]),
            (0.3, 0.7, 4, &[0.3, 0.4, 0.5, 0.6, 0.7]),
            (-1.0, 1.0, 4, &[-1.0, -0.5, 0.0, 0.5, 1.0]),
            (88.3, 100.0, 2, &[90.0, 95.0, 100.0]),
            (0.0, 1000.0, 1, &[0.0, 1000.0]),
            (0.0, 0.003, 3, &[0.0, 0.001, 0.002, 0.003]),
            (7.0, 9.0, 0, &[8.0]),
        ];
        for (low, high, about, expected) in cases {
            assert_eq!(ticks(low, high, about), expected, "{low} to {high}");
        }
    }

    #[test]
    fn ranges_without_extent_have_no_ticks() {
        let cases = [
            (1.0, 1.0),
            (2.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
            (f64::MIN, f64::MAX),
            (0.0, 1e-310),
        ];
        for (low, high) in cases {
            assert!(ticks(low, high, 5).is_empty(), "{low} to {high}");
        }
    }

    #[test]
    fn ticks_stay_in_range_and_apart() {
        for (low, high) in [(0.1, 0.7), (-3e7, 9e9), (1e16, 1e16 + 4.0), (-2e-9, 1e-9)] {
            let values = ticks(low, high, usize::MAX);
            assert!(values.len() <= 160, "{low} to {high}");
            assert!(values.iter().all(|value| (low..=high).contains(value)));
            assert!(values.is_sorted_by(|before, after| before < after));
        }
    }

    #[test]
    fn powers_of_ten_have_ticks() {
        assert_eq!(
            log_ticks(0.4, 20.0, &[1.0, 2.0, 5.0]),
            [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]
        );
        assert_eq!(log_ticks(0.4, 20.0, &[1.0]), [1.0, 10.0]);
        assert_eq!([plain_label(0.002), plain_label(20.0)], ["0.002", "20"]);
        assert_eq!([power_label(-2), power_label(-5)], ["0.01", "1e-5"]);
    }

    #[test]
    fn labels_use_the_fewest_decimals() {
        assert_eq!(decimals(&[0.0, 20.0]), 0);
        assert_eq!(decimals(&[0.0, 0.1, 0.25]), 2);
        assert_eq!(decimals(&[1.0 / 3.0]), 6);
        assert_eq!(label(-2.5, 1, "%"), "−2.5%");
        assert_eq!(label(-0.0, 0, "°"), "0°");
    }
}
