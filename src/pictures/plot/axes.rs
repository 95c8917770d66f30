//! What charts are laid out with: two axes around an area with grid, ticks and titles; the legend; scales, linear or in powers of
//! ten; and the layout, which sets text, panels and elements from the top down.

use crate::generator::emit::{MARK, xml_text};
use crate::pictures::plot::line_chart::Series;
use crate::pictures::plot::palette::{EDGE, GRID, Style};
use crate::pictures::plot::text::{AXIS, Font, LEGEND, TICK};

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
        let below = x.iter().map(|tick| {
            let (at, bottom) = (self.x.at(tick.value), self.area.bottom);
            outer_tick(at, bottom, [0.0, TICK_LENGTH])
        });
        let beside = y.iter().map(|tick| {
            let left = self.area.left - TICK_LENGTH;
            outer_tick(left, self.y.at(tick.value), [TICK_LENGTH, 0.0])
        });
        let outline = [self.area.outline()].into_iter();
        outline.chain(below).chain(beside).collect()
    }

    /// Ticks with their labels on the right of the area, as a colour bar has them.
    pub fn right_ticks(&self, ticks: &[Tick]) -> Vec<String> {
        let right = self.area.right;
        let draw = |tick: &Tick| {
            let y = self.y.at(tick.value);
            let line = outer_tick(right, y, [TICK_LENGTH, 0.0]);
            let top = y - TICK.leading / 2.0;
            let label = TICK.draw(
                std::slice::from_ref(&tick.label),
                right + TICK_GAP,
                top,
                "start",
            );
            [line].into_iter().chain(label).collect::<Vec<_>>()
        };
        ticks.iter().flat_map(draw).collect()
    }

    /// The labels of the ticks, below the area and on its left.
    pub fn tick_labels(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let below = x.iter().flat_map(|tick| {
            let top = self.area.bottom + TICK_GAP - 2.0;
            let label = std::slice::from_ref(&tick.label);
            TICK.draw(label, self.x.at(tick.value), top, "middle")
        });
        let beside = y.iter().flat_map(|tick| {
            let top = self.y.at(tick.value) - TICK.leading / 2.0;
            let label = std::slice::from_ref(&tick.label);
            TICK.draw(label, self.area.left - TICK_GAP, top, "end")
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

/// The length of a line sample: two periods of the longest dash pattern.
const SAMPLE: f64 = 38.0;
const SAMPLE_GAP: f64 = 8.0;
const ENTRY_GAP: f64 = 24.0;

impl Layout {
    /// Sets a line sample and a name for each curve, in as many rows as needed.
    pub fn legend(&mut self, series: &[Series]) {
        let (margin, room) = (self.frame().margin, self.frame().room());
        let (mut left, mut top) = (margin, self.bottom() + 7.0);
        for one in series {
            let lines = LEGEND.wrap(&one.name, room - SAMPLE - SAMPLE_GAP);
            let width = SAMPLE + SAMPLE_GAP + LEGEND.widest(&lines);
            if left > margin && left + width > margin + room {
                (left, top) = (margin, self.bottom());
            }
            let bottom = self.bottom().max(top + LEGEND.height(&lines));
            self.extend(legend_entry(one.style, &lines, left, top), bottom);
            left += width + ENTRY_GAP;
        }
    }
}

fn legend_entry(style: Style, lines: &[String], left: f64, top: f64) -> Vec<String> {
    let sample = format!(
        "<path {} d=\"M{left:.2} {:.2}H{:.2}\"/>",
        style.attributes(),
        top + LEGEND.leading / 2.0,
        left + SAMPLE
    );
    let mut elements = vec![sample];
    elements.extend(style.dot(left + SAMPLE / 2.0, top + LEGEND.leading / 2.0));
    elements.extend(LEGEND.draw(lines, left + SAMPLE + SAMPLE_GAP, top, "start"));
    elements
}

/// A map from values to the coordinates between two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    is_log: bool,
    /// The values at both ends, or their logarithms.
    low: f64,
    high: f64,
    /// The coordinates of both ends.
    from: f64,
    to: f64,
}

impl Scale {
    /// Values from `low` to `high`, evenly from one coordinate to the other.
    pub fn linear([low, high]: [f64; 2], [from, to]: [f64; 2]) -> Scale {
        Scale {
            is_log: false,
            low,
            high,
            from,
            to,
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
        let span = self.high - self.low;
        if span == 0.0 {
            return 0.5;
        }
        let value = if self.is_log {
            libm::log10(value)
        } else {
            value
        };
        (value - self.low) / span
    }

    /// Whether a value lies between the ends, give or take rounding.
    pub fn holds(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }

    /// The coordinate of a value, clamped near the picture, since viewers fail on huge numbers.
    pub fn at(&self, value: f64) -> f64 {
        (self.from + (self.to - self.from) * self.fraction(value)).clamp(-9999.0, 9999.0)
    }
}

/// The size of a picture or a panel, and its margins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelFrame {
    /// The width.
    pub width: f64,
    /// The usual height, which is also the least.
    pub height: f64,
    /// The margin on the left and right.
    pub margin: f64,
    /// The margin above the first line.
    pub upper: f64,
    /// The margin beneath the last line, which has its own leading.
    pub lower: f64,
}

/// The frame of a chart that stands alone.
pub const ALONE: PanelFrame = PanelFrame {
    width: 720.0,
    height: 440.0,
    margin: 24.0,
    upper: 20.0,
    lower: 18.0,
};

impl PanelFrame {
    /// The width inside the margins.
    pub fn room(&self) -> f64 {
        self.width - 2.0 * self.margin
    }

    /// The right edge of the room inside the margins.
    pub fn right(&self) -> f64 {
        self.margin + self.room()
    }
}

/// The gap between one paragraph and the next.
const PARAGRAPH_GAP: f64 = 2.0;
/// The elements set so far, and the position of the next one.
pub struct Layout {
    frame: PanelFrame,
    elements: Vec<String>,
    bottom: f64,
}

impl Layout {
    /// An empty layout.
    pub fn new(frame: PanelFrame) -> Layout {
        Layout {
            frame,
            elements: Vec::new(),
            bottom: frame.upper,
        }
    }

    /// The size and the margins.
    pub fn frame(&self) -> PanelFrame {
        self.frame
    }

    /// The lower edge of what has been set.
    pub fn bottom(&self) -> f64 {
        self.bottom
    }

    /// Adds elements that reach down to `bottom`.
    pub fn extend(&mut self, elements: Vec<String>, bottom: f64) {
        self.elements.extend(elements);
        self.bottom = bottom;
    }

    /// Sets text across the layout.
    pub fn paragraph(&mut self, font: &Font, text: &str) {
        let lines = font.wrap(text, self.frame.room());
        let elements = font.draw(&lines, self.frame.margin, self.bottom, "start");
        let height = paragraph_height(font, text, self.frame.room());
        self.extend(elements, self.bottom + height);
    }

    /// Sets other layouts side by side from `left` on, each in its own frame.
    pub fn side_by_side(&mut self, left: f64, panels: Vec<Layout>) {
        let (top, mut left) = (self.bottom, left);
        for panel in panels {
            let height = panel.height();
            self.elements
                .push(format!("<g transform=\"translate({left:.2} {top:.2})\">"));
            self.elements.extend(panel.elements);
            self.elements.push("</g>".into());
            self.bottom = self.bottom.max(top + height);
            left += panel.frame.width;
        }
    }

    /// The height, margins included.
    fn height(&self) -> f64 {
        (self.bottom + self.frame.lower).max(self.frame.height)
    }

    /// The finished SVG document.
    pub fn document(&self, title: &str, description: &str) -> String {
        let (width, height) = (self.frame.width, self.height().round());
        let head = format!(
            "<!-- {MARK} -->\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"system-ui, sans-serif\">"
        );
        // The card is opaque so that the chart reads on a dark page too.
        let card = format!(
            "<rect x=\"0.5\" y=\"0.5\" width=\"{}\" height=\"{}\" rx=\"8\" \
             fill=\"#ffffff\" stroke=\"#d5dae1\"/>",
            width - 1.0,
            height - 1.0
        );
        let title = format!("<title>{}</title>", xml_text(title));
        let description = format!("<desc>{}</desc>", xml_text(description));
        let body = self.elements.join("\n");
        format!("{head}\n{title}\n{description}\n{card}\n{body}\n</svg>\n")
    }
}

/// The height that a paragraph takes; none when it is blank.
pub fn paragraph_height(font: &Font, text: &str, room: f64) -> f64 {
    match font.wrap(text, room) {
        lines if lines.is_empty() => 0.0,
        lines => font.height(&lines) + PARAGRAPH_GAP,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::plot::axes::ALONE;

    fn named(name: &str) -> Series {
        Series {
            name: name.into(),
            style: Style::Exact,
            points: vec![],
        }
    }

    #[test]
    fn legend_rows_follow_the_length_of_the_names() {
        let rows = |names: &[&str]| {
            let mut layout = Layout::new(ALONE);
            let start = layout.bottom();
            layout.legend(&names.iter().map(|name| named(name)).collect::<Vec<_>>());
            ((layout.bottom() - start) / LEGEND.leading).floor()
        };
        let (half, long) = ("word ".repeat(12), "word ".repeat(40));
        assert_eq!(rows(&[]), 0.0);
        assert_eq!(rows(&["a", "b", "c"]), 1.0);
        assert_eq!(rows(&[&half, &half, "c"]), 2.0);
        assert_eq!(rows(&["a", &long, "c"]), 5.0);
    }
}

#[cfg(test)]
mod scale_tests {
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
}
