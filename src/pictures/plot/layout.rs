//! The layout of a picture, which sets text, panels and elements from the top down.

use crate::generator::emit::{MARK, xml_text};
use crate::pictures::plot::text::Font;

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
    /// The size and the margins.
    pub frame: PanelFrame,
    /// The lower edge of what has been set.
    pub bottom: f64,
    elements: Vec<String>,
}

impl Layout {
    /// An empty layout.
    pub fn new(frame: PanelFrame) -> Layout {
        Layout {
            frame,
            bottom: frame.upper,
            elements: Vec::new(),
        }
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
        self.extend(elements, self.bottom + paragraph_height(font, &lines));
    }

    /// Sets other layouts side by side from `left` on, each in its own frame.
    pub fn side_by_side(&mut self, mut left: f64, panels: Vec<Layout>) {
        let top = self.bottom;
        for panel in panels {
            let height = panel.height();
            let moved = format!("<g transform=\"translate({left:.2} {top:.2})\">");
            self.elements.push(moved);
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
pub fn paragraph_height(font: &Font, lines: &[String]) -> f64 {
    if lines.is_empty() {
        return 0.0;
    }
    font.height(lines) + PARAGRAPH_GAP
}
