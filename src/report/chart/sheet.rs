//! The sheet the chart is set on: text and legend, from the top down.

use super::text::{Font, LEGEND, escape};
use super::{Series, Style};

/// The width of the sheet.
pub(super) const WIDTH: f64 = 720.0;
/// The usual height of the sheet, and the least.
pub(super) const HEIGHT: f64 = 440.0;
/// The margin on the left and right.
pub(super) const MARGIN: f64 = 24.0;
/// The margin beneath the last line, which has white of its own.
pub(super) const LOWER_MARGIN: f64 = 18.0;
/// The width inside the margins.
pub(super) const ROOM: f64 = WIDTH - 2.0 * MARGIN;

const UPPER_MARGIN: f64 = 20.0;
/// The gap between one paragraph and the next.
const PARAGRAPH_GAP: f64 = 2.0;
/// The length of a line sample: two periods of the longest dash pattern.
const SAMPLE: f64 = 38.0;
const SAMPLE_GAP: f64 = 8.0;
const ENTRY_GAP: f64 = 24.0;

/// Colours by Okabe and Ito, which colour-blind readers can tell apart.
const COLOURS: [&str; 6] = [
    "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];
/// One more than the colours: grey is enough to tell the first seven curves
/// apart, and no pair of colour and dashes repeats before forty-two.
const DASHES: [&str; 7] = [
    "8 4",
    "2.5 2.5",
    "10 3 2.5 3",
    "14 5",
    "6 2.5 2 2.5 2 2.5",
    "3.5 7",
    "13 2",
];

/// What has been set so far, and where the next thing goes.
pub(super) struct Sheet {
    elements: Vec<String>,
    bottom: f64,
}

impl Default for Sheet {
    fn default() -> Sheet {
        Sheet {
            elements: Vec::new(),
            bottom: UPPER_MARGIN,
        }
    }
}

impl Sheet {
    /// The lower edge of what has been set.
    pub(super) fn bottom(&self) -> f64 {
        self.bottom
    }

    /// Adds elements that reach down to `bottom`.
    pub(super) fn extend(&mut self, elements: Vec<String>, bottom: f64) {
        self.elements.extend(elements);
        self.bottom = bottom;
    }

    /// Sets text across the sheet.
    pub(super) fn paragraph(&mut self, font: &Font, text: &str) {
        let lines = font.wrap(text, ROOM);
        let elements = font.draw(&lines, MARGIN, self.bottom, "start");
        self.extend(elements, self.bottom + paragraph_height(font, text));
    }

    /// Sets a line sample and a name for each curve, in as many rows as needed.
    pub(super) fn legend(&mut self, series: &[Series]) {
        let (mut left, mut top) = (MARGIN, self.bottom + 7.0);
        for one in series {
            let lines = LEGEND.wrap(&one.name, ROOM - SAMPLE - SAMPLE_GAP);
            let width = SAMPLE + SAMPLE_GAP + LEGEND.widest(&lines);
            if left > MARGIN && left + width > MARGIN + ROOM {
                (left, top) = (MARGIN, self.bottom);
            }
            self.elements.extend(entry(one.style, &lines, left, top));
            self.bottom = self.bottom.max(top + LEGEND.height(&lines));
            left += width + ENTRY_GAP;
        }
    }

    /// The finished SVG document.
    pub(super) fn document(&self, title: &str, description: &str) -> String {
        let height = (self.bottom + LOWER_MARGIN).max(HEIGHT).round();
        let head = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
             viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" font-family=\"system-ui, sans-serif\">"
        );
        // The card is opaque so that the chart reads on a dark page as well.
        let card = format!(
            "<rect x=\"0.5\" y=\"0.5\" width=\"{}\" height=\"{}\" rx=\"8\" \
             fill=\"#ffffff\" stroke=\"#d5dae1\"/>",
            WIDTH - 1.0,
            height - 1.0
        );
        let title = format!("<title>{}</title>", escape(title));
        let description = format!("<desc>{}</desc>", escape(description));
        let body = self.elements.join("\n");
        format!("{head}\n{title}\n{description}\n{card}\n{body}\n</svg>\n")
    }
}

impl Style {
    /// The attributes of a path in this style.
    pub(super) fn attributes(self) -> String {
        match self {
            Style::Exact => "fill=\"none\" stroke=\"#17202b\" stroke-width=\"3\"".into(),
            Style::Approximate(number) => format!(
                "fill=\"none\" stroke=\"{}\" stroke-dasharray=\"{}\" stroke-width=\"2.2\"",
                COLOURS[number % COLOURS.len()],
                DASHES[number % DASHES.len()]
            ),
        }
    }
}

/// The height that a paragraph takes; none when it is blank.
pub(super) fn paragraph_height(font: &Font, text: &str) -> f64 {
    match font.wrap(text, ROOM) {
        lines if lines.is_empty() => 0.0,
        lines => font.height(&lines) + PARAGRAPH_GAP,
    }
}

fn entry(style: Style, lines: &[String], left: f64, top: f64) -> Vec<String> {
    let sample = format!(
        "<path {} d=\"M{left:.2} {:.2}H{:.2}\"/>",
        style.attributes(),
        top + LEGEND.leading / 2.0,
        left + SAMPLE
    );
    let mut elements = vec![sample];
    elements.extend(LEGEND.draw(lines, left + SAMPLE + SAMPLE_GAP, top, "start"));
    elements
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let mut sheet = Sheet::default();
            let start = sheet.bottom();
            sheet.legend(&names.iter().map(|name| named(name)).collect::<Vec<_>>());
            ((sheet.bottom() - start) / LEGEND.leading).floor()
        };
        let (half, long) = ("word ".repeat(12), "word ".repeat(40));
        assert_eq!(rows(&[]), 0.0);
        assert_eq!(rows(&["a", "b", "c"]), 1.0);
        assert_eq!(rows(&[&half, &half, "c"]), 2.0);
        assert_eq!(rows(&["a", &long, "c"]), 5.0);
    }

    #[test]
    fn approximations_differ_without_colour() {
        let all: Vec<String> = (0..42)
            .map(|number| Style::Approximate(number).attributes())
            .collect();
        let mut distinct = all.clone();
        distinct.sort();
        distinct.dedup();
        assert_eq!(distinct.len(), all.len());
    }
}
