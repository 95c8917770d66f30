//! Two axes around an area, with grid, ticks and titles, and their scales, linear or in powers of ten. Ticks are round, and have
//! labels.

use crate::pictures::plot::palette::{EDGE, GRID};
use crate::pictures::plot::text::{AXIS, TICK};

/// The gap between a vertical axis and its tick labels, a little more than for a horizontal one.
pub const TICK_GAP: f64 = 7.0;
/// The length of a tick outside the area.
const TICK_LENGTH: f64 = 4.0;

/// A rectangle of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Its left edge.
    pub left: f64,
    /// Its upper edge.
    pub top: f64,
    /// Its right edge.
    pub right: f64,
    /// Its lower edge.
    pub bottom: f64,
}

/// A value with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// The text of the label.
    pub label: String,
}

/// A tick at each of these values.
pub fn labelled(values: impl IntoIterator<Item = f64>, label: impl Fn(f64) -> String) -> Vec<Tick> {
    let tick = |value| Tick {
        value,
        label: label(value),
    };
    values.into_iter().map(tick).collect()
}

/// An area, and the scales of the values in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The area.
    pub area: Area,
    /// From left to right.
    pub x: Scale,
    /// From the bottom up, unless its ends say otherwise.
    pub y: Scale,
}

impl Area {
    /// The rectangle between these edges.
    pub fn between([left, right]: [f64; 2], [top, bottom]: [f64; 2]) -> Area {
        Area {
            left,
            top,
            right,
            bottom,
        }
    }

    /// Whether the interiors of two areas overlap.
    pub fn meets(&self, other: &Area) -> bool {
        let across = self.left < other.right && other.left < self.right;
        across && self.top < other.bottom && other.top < self.bottom
    }

    /// Whether all of it lies in another.
    pub fn lies_in(&self, other: &Area) -> bool {
        let across = self.left >= other.left && self.right <= other.right;
        across && self.top >= other.top && self.bottom <= other.bottom
    }

    /// The centre between left and right.
    pub fn centre(&self) -> f64 {
        f64::midpoint(self.left, self.right)
    }

    /// The middle between top and bottom.
    pub fn middle(&self) -> f64 {
        f64::midpoint(self.top, self.bottom)
    }

    /// Its outline as SVG.
    pub fn outline(&self) -> String {
        format!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"none\" stroke=\"{EDGE}\"/>",
            self.left,
            self.top,
            self.right - self.left,
            self.bottom - self.top
        )
    }
}

impl Axes {
    /// Lines across the area at the ticks, and the two axes.
    pub fn grid(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.area;
        let upright = |tick: &Tick| format!("M{:.2} {top:.2}V{bottom:.2}", self.x.at(tick.value));
        let level = |tick: &Tick| format!("M{left:.2} {:.2}H{right:.2}", self.y.at(tick.value));
        let lines: String = x.iter().map(upright).chain(y.iter().map(level)).collect();
        let axes = format!("M{left:.2} {top:.2}V{bottom:.2}H{right:.2}");
        vec![
            format!("<path fill=\"none\" stroke=\"{GRID}\" d=\"{lines}\"/>"),
            format!("<path fill=\"none\" stroke=\"{EDGE}\" d=\"{axes}\"/>"),
        ]
    }

    /// The outline of the area, and a short line outwards at each tick.
    pub fn outer_ticks(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let Area { left, bottom, .. } = self.area;
        let mut elements = vec![self.area.outline()];
        for tick in x {
            elements.push(outer_tick(
                self.x.at(tick.value),
                bottom,
                [0.0, TICK_LENGTH],
            ));
        }
        for tick in y {
            let at = self.y.at(tick.value);
            elements.push(outer_tick(left - TICK_LENGTH, at, [TICK_LENGTH, 0.0]));
        }
        elements
    }

    /// Ticks with their labels on the right of the area, as a colour bar has them.
    pub fn right_ticks(&self, ticks: &[Tick]) -> Vec<String> {
        let right = self.area.right;
        let draw = |tick: &Tick| {
            let (y, left) = (self.y.at(tick.value), right + TICK_GAP);
            let label = TICK.draw_line(&tick.label, left, y - TICK.leading / 2.0, "start");
            [outer_tick(right, y, [TICK_LENGTH, 0.0]), label]
        };
        ticks.iter().flat_map(draw).collect()
    }

    /// The labels of the ticks, below the area and on its left.
    pub fn tick_labels(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let (top, right) = (self.area.bottom + TICK_GAP - 2.0, self.area.left - TICK_GAP);
        let below = x
            .iter()
            .map(|tick| TICK.draw_line(&tick.label, self.x.at(tick.value), top, "middle"));
        let beside = y.iter().map(|tick| {
            let top = self.y.at(tick.value) - TICK.leading / 2.0;
            TICK.draw_line(&tick.label, right, top, "end")
        });
        below.chain(beside).collect()
    }

    /// The titles of both axes: one whose text begins `below` the area, one that reads upwards from `left`.
    pub fn titles(&self, x: &[String], below: f64, y: &[String], left: f64) -> Vec<String> {
        let area = &self.area;
        let mut elements = AXIS.draw(x, area.centre(), area.bottom + below, "middle");
        elements.extend(AXIS.draw_upwards(y, left, area.middle()));
        elements
    }
}

fn outer_tick(x: f64, y: f64, [right, down]: [f64; 2]) -> String {
    format!("<path stroke=\"{EDGE}\" d=\"M{x:.2} {y:.2}l{right} {down}\"/>")
}

/// A map from values to the coordinates between two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    is_log: bool,
    /// The values at both ends, or their logarithms.
    values: [f64; 2],
    /// The coordinates of both ends.
    coordinates: [f64; 2],
}

impl Scale {
    /// Values from `low` to `high`, evenly from one coordinate to the other.
    pub fn linear(values: [f64; 2], coordinates: [f64; 2]) -> Scale {
        Scale {
            is_log: false,
            values,
            coordinates,
        }
    }

    /// Values from `low` to `high`, both above 0; each power of ten takes equal room.
    pub fn log(ends: [f64; 2], coordinates: [f64; 2]) -> Scale {
        Scale {
            is_log: true,
            ..Scale::linear(ends.map(libm::log10), coordinates)
        }
    }

    /// The place of a value on the scale: 0 at the low end, 1 at the high end.
    pub fn fraction(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        let span = high - low;
        if span == 0.0 {
            return 0.5;
        }
        let value = if self.is_log {
            libm::log10(value)
        } else {
            value
        };
        (value - low) / span
    }

    /// Whether a value lies between the ends, give or take rounding.
    pub fn holds(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }

    /// The coordinate of a value, clamped near the picture, since viewers fail on huge numbers.
    pub fn at(&self, value: f64) -> f64 {
        let [from, to] = self.coordinates;
        (from + (to - from) * self.fraction(value)).clamp(-9999.0, 9999.0)
    }
}

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
    fn values_lie_evenly_or_by_their_powers() {
        let even = Scale::linear([0.0, 10.0], [100.0, 200.0]);
        assert_eq!(even.at(5.0), 150.0);
        let powers = Scale::log([1.0, 100.0], [100.0, 200.0]);
        assert_eq!(powers.at(10.0), 150.0);
        assert!(powers.holds(100.0) && !powers.holds(101.0));
        assert_eq!(Scale::linear([3.0, 3.0], [0.0, 8.0]).at(7.0), 4.0);
    }

    #[test]
    fn coordinates_stay_near_the_picture() {
        let scale = Scale::linear([0.0, 1.0], [10.0, 20.0]);
        assert_eq!(scale.at(0.5), 15.0);
        assert_eq!(scale.at(1e300), 9999.0);
        let falling = Scale::linear([0.0, 1.0], [20.0, 10.0]);
        assert_eq!(falling.at(f64::INFINITY), -9999.0);
    }

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
