//! Colours and dashes.

use crate::physics::spectra::srgb_byte;

/// The colour of text and of the exact law.
pub const INK: &str = "#17202b";
/// The colour of grid lines.
pub const GRID: &str = "#e4e8ed";
/// The colour of axes and outlines.
pub const EDGE: &str = "#7d8794";

/// From the colours of Okabe and Ito, which colour-blind readers can tell apart.
pub const VERMILION: &str = "#d55e00";
/// From the same colours.
pub const BLUE: &str = "#0072b2";
/// From the same colours.
pub const GREEN: &str = "#009e73";

/// From the same colours.
pub const PURPLE: &str = "#cc79a7";

/// These colours in their order for curves.
const COLOURS: [&str; 6] = [VERMILION, BLUE, GREEN, PURPLE, "#e69f00", "#56b4e9"];
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

/// The number of colour steps in a map.
pub const SHADES: usize = 48;

/// Perceptually even and safe for the colour-blind: nine points of Matplotlib's viridis (CC0 1.0,
/// <https://bids.github.io/colormap/>).
const VIRIDIS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 45.0, 123.0],
    [59.0, 82.0, 139.0],
    [44.0, 114.0, 142.0],
    [33.0, 145.0, 140.0],
    [40.0, 174.0, 128.0],
    [94.0, 201.0, 98.0],
    [173.0, 220.0, 48.0],
    [253.0, 231.0, 37.0],
];

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Style {
    /// The reference: solid, dark and thick, beneath all other curves.
    Exact,
    /// An approximation: dashed, with a colour and dash pattern by number.
    Approximate(usize),
    /// A look of the caller's; later curves lie above earlier ones.
    Own(Look),
}

/// A look that a caller chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The colour in SVG notation.
    pub colour: &'static str,
    /// Lengths of dashes and gaps in SVG notation; empty for a solid line.
    pub dashes: &'static str,
    /// The width of the line.
    pub width: f64,
    /// Whether each point on the axes is a dot too.
    pub dots: bool,
}

impl Look {
    /// A line without dots.
    pub const fn new(colour: &'static str, dashes: &'static str, width: f64) -> Look {
        Look {
            colour,
            dashes,
            width,
            dots: false,
        }
    }
}

impl Style {
    /// Colour, dashes and width.
    pub fn look(self) -> Look {
        match self {
            Style::Exact => Look::new(INK, "", 3.0),
            Style::Approximate(number) => {
                let dashes = DASHES[number % DASHES.len()];
                Look::new(COLOURS[number % COLOURS.len()], dashes, 2.2)
            }
            Style::Own(look) => look,
        }
    }

    /// The attributes of a path in this style.
    pub fn attributes(self) -> String {
        let look = self.look();
        let (colour, width) = (look.colour, look.width);
        let dashes = match look.dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        format!("fill=\"none\" stroke=\"{colour}\"{dashes} stroke-width=\"{width}\"")
    }

    /// A dot of this style, where it has dots.
    pub fn dot(self, x: f64, y: f64) -> Option<String> {
        let Look { colour, dots, .. } = self.look();
        dots.then(|| format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{DOT}\" fill=\"{colour}\"/>"))
    }
}

/// A colour in linear sRGB in SVG notation, clipped to the gamut.
pub fn hex_colour(linear: [f64; 3]) -> String {
    hex(linear.map(srgb_byte))
}

fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// One of [`SHADES`] colours, from dark to bright.
pub fn shade(step: usize) -> String {
    hex(shade_bytes(step as f64 / (SHADES - 1) as f64))
}

/// The colour of a share, 0 dark to 1 bright, in bytes of sRGB.
pub fn shade_bytes(share: f64) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let at = (place as usize).min(VIRIDIS.len() - 2);
    let share = place - at as f64;
    let (one, other) = (VIRIDIS[at], VIRIDIS[at + 1]);
    [0, 1, 2].map(|i| (one[i] + share * (other[i] - one[i])).round() as u8)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn approximations_differ_without_colour() {
        let all = (0..42).map(|number| Style::Approximate(number).attributes());
        assert_eq!(all.collect::<BTreeSet<String>>().len(), 42);
    }
}
