//! The colour of the reflection at a few angles, as a screen shows it, with its numbers. Also the wavelengths that a material
//! sheet shows: the measured part of 360 to 830 nm, the range that an eye can see.

use glam::DVec3;

use crate::physics::materials::{DispersionCurve, Material};
use crate::physics::spectra::{OBSERVED_NM, Space, bradford};
use crate::pictures::material_sheet::DrawnMaterial;
use crate::pictures::material_sheet::spectrum::cosine;
use crate::pictures::plot::{
    Area, ChartAxis, Font, Layout, PANEL, PanelFrame, SUBTITLE, TICK, hex_colour, ticks,
};

/// Angles in degrees; metals and glass change most beyond 75.
const ANGLES: [f64; 7] = [0.0, 30.0, 60.0, 75.0, 82.0, 86.0, 90.0];
const CHANNELS: [&str; 3] = ["red", "green", "blue"];
/// A channel this far outside [0, 1] counts as clipped. Less does not show in the numbers.
const CLIPPED: f64 = 5e-4;
/// Lines below a swatch: three channels, and two for what was clipped.
const LINES_BELOW: f64 = 5.0;

/// One swatch.
struct Swatch {
    degrees: f64,
    /// The colour in the viewing space; colours outside it are kept.
    linear: DVec3,
    /// The colour on a screen, before it is clipped.
    screen: DVec3,
}

/// The panel, and its description in words.
pub(super) fn swatch_panel(drawn: &DrawnMaterial, frame: PanelFrame) -> (Layout, String) {
    let to_screen = to_screen(space(drawn));
    let swatches = ANGLES.map(|degrees| {
        let linear = drawn.surface.unpolarised(cosine(degrees));
        let screen = to_screen(linear);
        Swatch {
            degrees,
            linear,
            screen,
        }
    });
    let mut layout = Layout::new(frame);
    layout.paragraph(&PANEL, "Colour of the reflection, where a mirror is white");
    layout.paragraph(&SUBTITLE, &subtitle(drawn, &swatches));
    let (elements, bottom) = draw(&swatches, frame, layout.bottom() + 8.0);
    layout.extend(elements, bottom);
    (layout, swatches.iter().map(Swatch::words).collect())
}

/// The space of the channels. Three wavelengths are shown as if they were sRGB's primaries.
fn space(drawn: &DrawnMaterial) -> Space {
    match drawn.surface.channels() {
        Some(_) => Space::Srgb,
        None => drawn.viewing.integration.space,
    }
}

/// From a space to linear sRGB, white to white.
fn to_screen(space: Space) -> impl Fn(DVec3) -> DVec3 {
    let screen = Space::Srgb;
    let adapt = bradford(space.white(), screen.white());
    let matrix = screen.xyz_to_rgb() * adapt * space.rgb_to_xyz();
    move |linear| match space {
        Space::Srgb => linear,
        _ => matrix * linear,
    }
}

fn subtitle(drawn: &DrawnMaterial, swatches: &[Swatch]) -> String {
    let numbers = match (drawn.surface.channels(), space(drawn)) {
        (Some(_), _) => {
            "Numbers: reflectance at the wavelengths of red, green and blue, shown as linear sRGB."
                .to_owned()
        }
        (None, Space::Srgb) => "Numbers: linear sRGB, before anything is clipped.".to_owned(),
        (None, space) => format!(
            "Numbers: {}, before anything is clipped; the swatches are sRGB.",
            space.title()
        ),
    };
    let clipped = swatches.iter().any(|swatch| swatch.clipped().is_some());
    let clipped = if clipped {
        " Some colours lie outside sRGB: the swatch is clipped there, as said beneath it."
    } else {
        ""
    };
    numbers + clipped
}

impl Swatch {
    /// The colour of the swatch, as SVG writes it.
    fn fill(&self) -> String {
        hex_colour(self.screen.to_array())
    }

    /// Which channels of the swatch were clipped.
    fn clipped(&self) -> Option<String> {
        let outside = |i: &usize| !(-CLIPPED..=1.0 + CLIPPED).contains(&self.screen[*i]);
        let names: Vec<&str> = (0..3).filter(outside).map(|i| CHANNELS[i]).collect();
        (!names.is_empty()).then(|| format!("{} clipped", names.join(", ")))
    }

    fn numbers(&self) -> [String; 3] {
        // Adding zero turns a negative zero into a positive one.
        let number = |value: f64| {
            format!("{:.3}", (1000.0 * value).round() / 1000.0 + 0.0).replace('-', "\u{2212}")
        };
        self.linear.to_array().map(number)
    }

    fn words(&self) -> String {
        let clipped = self.clipped().map_or(String::new(), |it| format!(", {it}"));
        let numbers = self.numbers().join(", ");
        format!("At {}°: {numbers}{clipped}. ", self.degrees)
    }
}

/// All swatches in a row from `top` down, and their lower edge.
fn draw(swatches: &[Swatch], frame: PanelFrame, top: f64) -> (Vec<String>, f64) {
    let names = f64::ceil(widest(&TICK, &CHANNELS)) + 10.0;
    let left = frame.margin + names;
    let width = (frame.right() - left) / swatches.len() as f64;
    let colours = top + TICK.leading + 4.0;
    let bottom = frame.height - frame.lower - 8.0;
    let numbers = bottom - LINES_BELOW * TICK.leading;
    let height = (numbers - colours - 8.0).max(60.0);
    let numbers = colours + height + 8.0;
    let channels = CHANNELS.map(str::to_owned);
    let mut elements = TICK.draw(&channels, frame.margin, numbers, "start");
    for (i, swatch) in swatches.iter().enumerate() {
        // Whole coordinates leave no seam between two colours.
        let edge = |i: usize| (left + width * i as f64).round();
        let (start, width) = (edge(i), edge(i + 1) - edge(i));
        let middle = start + width / 2.0;
        elements.push(format!(
            "<rect x=\"{start:.2}\" y=\"{colours:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" fill=\"{}\"/>",
            swatch.fill()
        ));
        let angle = [format!("{}°", swatch.degrees)];
        elements.extend(TICK.draw(&angle, middle, top, "middle"));
        elements.extend(TICK.draw(&swatch.below(width), middle, numbers, "middle"));
    }
    let outline = Area {
        left,
        top: colours,
        right: frame.right(),
        bottom: colours + height,
    };
    elements.push(outline.outline());
    (elements, numbers + LINES_BELOW * TICK.leading)
}

impl Swatch {
    /// The lines under a swatch.
    fn below(&self, width: f64) -> Vec<String> {
        let clipped = self.clipped().unwrap_or_default();
        let mut lines = self.numbers().to_vec();
        lines.extend(TICK.wrap(&clipped, width - 4.0));
        lines
    }
}

fn widest(font: &Font, names: &[&str]) -> f64 {
    names
        .iter()
        .map(|name| font.width(name))
        .fold(0.0, f64::max)
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
    let k = material
        .k
        .as_ref()
        .map(DispersionCurve::range_nm)
        .and_then(shown);
    match (n, k) {
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
    ChartAxis {
        label: "wavelength in vacuum (nm)".to_owned(),
        low,
        high,
        ticks: ticks(low, high, 8),
        unit: "",
    }
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

    #[test]
    fn white_is_white_on_the_screen() {
        for space in Space::ALL {
            let white = to_screen(space)(DVec3::ONE);
            assert!(white.abs_diff_eq(DVec3::ONE, 1e-12), "{space:?}: {white}");
        }
        let green = to_screen(Space::Rec2020)(DVec3::Y);
        assert!(green.x < -0.5 && green.y > 1.0);
    }

    #[test]
    fn what_is_clipped_is_named() {
        let swatch = |screen: [f64; 3]| Swatch {
            degrees: 0.0,
            linear: screen.into(),
            screen: screen.into(),
        };
        let words = |screen| swatch(screen).clipped();
        assert_eq!(words([1.0, 1.000_4, 0.0]), None);
        assert_eq!(words([1.04, 0.5, 0.2]), Some("red clipped".to_owned()));
        assert_eq!(
            words([1.04, 0.5, -0.2]),
            Some("red, blue clipped".to_owned())
        );
        assert_eq!(
            swatch([1.04, 0.5, -1e-9]).numbers(),
            ["1.040", "0.500", "0.000"]
        );
    }
}
