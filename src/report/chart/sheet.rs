//! The sheet the chart is set on: text and legend, from the top down.

use crate::emit::MARK;

use super::text::{Font, LEGEND, escape};
use super::{Look, Series, Style};

/// The size of a sheet and its margins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The width.
    pub width: f64,
    /// The usual height, and the least.
    pub height: f64,
    /// The margin on the left and right.
    pub margin: f64,
    /// The margin above the first line.
    pub upper: f64,
    /// The margin beneath the last line, which has white of its own.
    pub lower: f64,
}

/// The sheet of a chart that stands alone.
pub const ALONE: Frame = Frame {
    width: 720.0,
    height: 440.0,
    margin: 24.0,
    upper: 20.0,
    lower: 18.0,
};

impl Frame {
    /// The width inside the margins.
    pub fn room(&self) -> f64 {
        self.width - 2.0 * self.margin
    }

    /// The right end of the room.
    pub fn right(&self) -> f64 {
        self.margin + self.room()
    }
}

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

/// The radius of a dot.
const DOT: f64 = 2.4;

/// What has been set so far, and where the next thing goes.
pub struct Sheet {
    frame: Frame,
    elements: Vec<String>,
    bottom: f64,
}

impl Sheet {
    /// An empty sheet.
    pub fn new(frame: Frame) -> Sheet {
        Sheet {
            frame,
            elements: Vec::new(),
            bottom: frame.upper,
        }
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

    /// Sets text across the sheet.
    pub fn paragraph(&mut self, font: &Font, text: &str) {
        let lines = font.wrap(text, self.frame.room());
        let elements = font.draw(&lines, self.frame.margin, self.bottom, "start");
        let height = paragraph_height(font, text, self.frame.room());
        self.extend(elements, self.bottom + height);
    }

    /// Sets other sheets side by side from `left` on, each in its own frame.
    pub fn row(&mut self, left: f64, panels: Vec<Sheet>) {
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

    /// Sets a line sample and a name for each curve, in as many rows as needed.
    pub fn legend(&mut self, series: &[Series]) {
        let Frame { margin, .. } = self.frame;
        let (mut left, mut top) = (margin, self.bottom + 7.0);
        for one in series {
            let lines = LEGEND.wrap(&one.name, self.frame.room() - SAMPLE - SAMPLE_GAP);
            let width = SAMPLE + SAMPLE_GAP + LEGEND.widest(&lines);
            if left > margin && left + width > self.frame.right() {
                (left, top) = (margin, self.bottom);
            }
            self.elements.extend(entry(one.style, &lines, left, top));
            self.bottom = self.bottom.max(top + LEGEND.height(&lines));
            left += width + ENTRY_GAP;
        }
    }

    /// The finished SVG document.
    pub fn document(&self, title: &str, description: &str) -> String {
        let (width, height) = (self.frame.width, self.height().round());
        let head = format!(
            "<!-- {MARK} -->\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"system-ui, sans-serif\">"
        );
        // The card is opaque so that the chart reads on a dark page as well.
        let card = format!(
            "<rect x=\"0.5\" y=\"0.5\" width=\"{}\" height=\"{}\" rx=\"8\" \
             fill=\"#ffffff\" stroke=\"#d5dae1\"/>",
            width - 1.0,
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
    pub fn attributes(self) -> String {
        match self {
            Style::Exact => "fill=\"none\" stroke=\"#17202b\" stroke-width=\"3\"".into(),
            Style::Approximate(number) => format!(
                "fill=\"none\" stroke=\"{}\" stroke-dasharray=\"{}\" stroke-width=\"2.2\"",
                COLOURS[number % COLOURS.len()],
                DASHES[number % DASHES.len()]
            ),
            Style::Own(look) => look.attributes(),
        }
    }

    /// A dot of this style, where it has dots.
    pub fn dot(self, x: f64, y: f64) -> Option<String> {
        let Style::Own(Look {
            colour, dots: true, ..
        }) = self
        else {
            return None;
        };
        Some(format!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{DOT}\" fill=\"{colour}\"/>"
        ))
    }
}

impl Look {
    fn attributes(self) -> String {
        let (colour, width) = (self.colour, self.width);
        let dashes = match self.dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        format!("fill=\"none\" stroke=\"{colour}\"{dashes} stroke-width=\"{width}\"")
    }
}

/// The height that a paragraph takes; none when it is blank.
pub fn paragraph_height(font: &Font, text: &str, room: f64) -> f64 {
    match font.wrap(text, room) {
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
    elements.extend(style.dot(left + SAMPLE / 2.0, top + LEGEND.leading / 2.0));
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
            let mut sheet = Sheet::new(ALONE);
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
