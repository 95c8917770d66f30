//! A layout sets text, panels and elements from the top down.

use crate::generator::emit::{MARK, xml_text};
use crate::pictures::plot::text::Font;

/// The size of a picture or a panel, and its margins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelFrame {
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

    /// The right end of the room.
    pub fn right(&self) -> f64 {
        self.margin + self.room()
    }
}

/// The gap between one paragraph and the next.
const PARAGRAPH_GAP: f64 = 2.0;
/// What has been set so far, and where the next thing goes.
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
        // The card is opaque so that the chart reads on a dark page as well.
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
