//! The colour of the reflection at a few angles, as a screen shows it, with its numbers.

use glam::DVec3;

use crate::physics::optics::cosine;
use crate::physics::spectra::{Space, bradford};
use crate::pictures::material_sheet::DrawnMaterial;
use crate::pictures::plot::{Area, Layout, PANEL, PanelFrame, SUBTITLE, TICK, hex_colour};

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
        Swatch {
            degrees,
            linear,
            screen: to_screen(linear),
        }
    });
    let mut layout = Layout::new(frame);
    layout.paragraph(&PANEL, "Colour of the reflection, where a mirror is white");
    layout.paragraph(&SUBTITLE, &subtitle(drawn, &swatches));
    let (elements, bottom) = draw(&swatches, frame, layout.bottom + 8.0);
    layout.extend(elements, bottom);
    (layout, swatches.iter().map(Swatch::words).collect())
}

/// The space of the channels. Three wavelengths are shown as if they were sRGB's primaries.
fn space(drawn: &DrawnMaterial) -> Space {
    if drawn.surface.is_spectral() {
        drawn.viewing.integration.space
    } else {
        Space::Srgb
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
    let numbers = match (drawn.surface.is_spectral(), space(drawn)) {
        (false, _) => {
            "Numbers: reflectance at the wavelengths of red, green and blue, shown as linear sRGB."
                .to_owned()
        }
        (true, Space::Srgb) => "Numbers: linear sRGB, before anything is clipped.".to_owned(),
        (true, space) => format!(
            "Numbers: {}, before anything is clipped; the swatches are sRGB.",
            space.title()
        ),
    };
    if swatches.iter().any(|swatch| swatch.clipped().is_some()) {
        return numbers
            + " Some colours lie outside sRGB: the swatch is clipped there, as said beneath it.";
    }
    numbers
}

impl Swatch {
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
    let names = TICK.widest(CHANNELS).ceil() + 10.0;
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
            hex_colour(swatch.screen.to_array())
        ));
        let angle = format!("{}°", swatch.degrees);
        elements.push(TICK.draw_line(&angle, middle, top, "middle"));
        let mut below = swatch.numbers().to_vec();
        below.extend(TICK.wrap(&swatch.clipped().unwrap_or_default(), width - 4.0));
        elements.extend(TICK.draw(&below, middle, numbers, "middle"));
    }
    let outline = Area::between([left, frame.right()], [colours, colours + height]);
    elements.push(outline.outline());
    (elements, numbers + LINES_BELOW * TICK.leading)
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
        for (screen, words) in [
            ([1.0, 1.000_4, 0.0], None),
            ([1.04, 0.5, 0.2], Some("red clipped")),
            ([1.04, 0.5, -0.2], Some("red, blue clipped")),
        ] {
            assert_eq!(swatch(screen).clipped().as_deref(), words);
        }
        let numbers = swatch([1.04, 0.5, -1e-9]).numbers();
        assert_eq!(numbers, ["1.040", "0.500", "0.000"]);
    }
}
