//! The first picture of README: platinum, and gold below a clear coat, by Schlick's approximation, by `fitted` and by the exact law over
//! the whole spectrum, as spheres and as curves.
//!
//! A sphere is seen from afar in a room that is white everywhere, so a pixel's colour is the reflectance at its angle:
//! at r of the radius sin θ = r. The right half of a sphere shows the error instead of the colour.

use fresnel_gen::generator::flavours::{ANGLES, Compared, Flavour};
use fresnel_gen::physics::materials::ViewingConditions;
use fresnel_gen::pictures::plot::{
    BLUE, ChartAxis, FOOT, GREEN, HEADING, Layout, LineChart, Look, PANEL, PanelFrame, SUBTITLE,
    Series, Style, TICK, VERMILION, hex_colour,
};

/// The materials, whether below a clear coat, and the lowest reflectance on the axis.
const MATERIALS: [(&str, bool, f64); 2] = [("platinum", false, 0.4), ("gold", true, 0.2)];
/// The exact law's name in the picture.
const EXACT: &str = "exact law";
/// The channels with their colours, and the lines of methods, in the order of [`curves`].
const CHANNELS: [(&str, &str); 3] = [("red", VERMILION), ("green", GREEN), ("blue", BLUE)];
const LINES: [(&str, f64); 3] = [("2.5 2.5", 1.8), ("8 4", 2.4), ("", 1.4)];
/// The factor that brightens the error.
const BRIGHTER: f64 = 5.0;
/// The stride in the angles of a sphere's gradient, and of a curve.
const STOPS: usize = 16;
const POINTS: usize = 8;

const PICTURE: PanelFrame = PanelFrame {
    width: 1040.0,
    height: 700.0,
    margin: 24.0,
    upper: 20.0,
    lower: 14.0,
};
const SPHERES: PanelFrame = PanelFrame {
    width: 580.0,
    height: 310.0,
    margin: 8.0,
    upper: 12.0,
    lower: 8.0,
};
const CURVES: PanelFrame = PanelFrame {
    width: 420.0,
    ..SPHERES
};
const RADIUS: f64 = 90.0;

/// A reflectance at all angles, and its name.
struct Curve {
    name: &'static str,
    colours: Vec<[f64; 3]>,
}

/// The picture as SVG text, with `foot` below it.
pub fn headline(foot: &str) -> String {
    let mut layout = Layout::new(PICTURE);
    let title = "Schlick's approximation, fitted, and the exact law";
    layout.paragraph(&HEADING, title);
    let words = format!(
        "Spheres in a white room. Left half: the colour of the reflection. Right half: the error, {BRIGHTER} times \
         brighter; black is no error."
    );
    layout.paragraph(&SUBTITLE, &words);
    for (material, with_coat, low) in MATERIALS {
        let curves = curves(material, with_coat);
        let title = if with_coat {
            format!("{material} below a clear coat; Schlick with its colours in air")
        } else {
            material.to_owned()
        };
        let (spheres, chart) = (
            spheres(material, &title, &curves),
            chart(&title, &curves, low),
        );
        layout.side_by_side(
            PICTURE.margin - SPHERES.margin,
            vec![spheres, chart.panel(CURVES, material)],
        );
    }
    layout.paragraph(&FOOT, foot);
    layout.document(title, &words)
}

fn degrees() -> impl Iterator<Item = f64> {
    (0..ANGLES).map(|i| 90.0 * i as f64 / (ANGLES - 1) as f64)
}

/// What an engine with Schlick's approximation and a clear coat makes of a material, what ours does there, and the whole spectrum.
fn curves(material: &str, with_coat: bool) -> [Curve; 3] {
    let subject = &crate::subjects(&[material])[0];
    let viewing = ViewingConditions::default();
    let found = Compared::new(Flavour::PLAYCANVAS, subject, &viewing, with_coat).unwrap();
    [
        ("Schlick", found.stock),
        ("fitted", found.ours),
        (EXACT, found.truth),
    ]
    .map(|(name, colours)| Curve { name, colours })
}

/// The spheres of a material side by side.
fn spheres(material: &str, title: &str, curves: &[Curve]) -> Layout {
    let mut layout = Layout::new(SPHERES);
    layout.paragraph(&PANEL, title);
    let exact = &curves[curves.len() - 1];
    let (top, mut elements) = (layout.bottom + 18.0, Vec::new());
    let step = SPHERES.room() / curves.len() as f64;
    for (i, curve) in curves.iter().enumerate() {
        let centre = [SPHERES.margin + step * (i as f64 + 0.5), top + RADIUS];
        let id = format!("{material}-{i}");
        elements.extend(half_disc(
            &format!("{id}-colour"),
            &curve.colours,
            centre,
            0,
        ));
        let errors: Vec<[f64; 3]> = errors(curve, exact)
            .map(|error| [BRIGHTER * error; 3])
            .collect();
        elements.extend(half_disc(&format!("{id}-error"), &errors, centre, 1));
        let below = centre[1] + RADIUS + 6.0;
        let most = largest_error(curve, exact);
        let words = match curve.name {
            EXACT => vec![EXACT.to_owned(), "of the whole spectrum".to_owned()],
            name => vec![name.to_owned(), format!("error at most {most:.4}")],
        };
        elements.extend(TICK.draw(&words, centre[0], below, "middle"));
    }
    layout.extend(elements, top + 2.0 * RADIUS + 6.0 + 2.0 * TICK.leading);
    layout
}

/// The largest error of the three channels, at each angle.
fn errors<'a>(curve: &'a Curve, exact: &'a Curve) -> impl Iterator<Item = f64> + 'a {
    let pairs = curve.colours.iter().zip(&exact.colours);
    pairs.map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max))
}

fn largest_error(curve: &Curve, exact: &Curve) -> f64 {
    errors(curve, exact).fold(0.0, f64::max)
}

/// Half a disc, the left one (0) or the right one (1), with a colour for each angle.
fn half_disc(id: &str, colours: &[[f64; 3]], [x, y]: [f64; 2], right: u8) -> Vec<String> {
    let stops = degrees().zip(colours).step_by(STOPS).map(|(at, colour)| {
        let (offset, colour) = (libm::sin(at.to_radians()), hex_colour(*colour));
        format!("<stop offset=\"{offset:.4}\" stop-color=\"{colour}\"/>")
    });
    let head = format!(
        "<radialGradient id=\"{id}\" gradientUnits=\"userSpaceOnUse\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{RADIUS}\">"
    );
    let (top, bottom) = (y - RADIUS, y + RADIUS);
    let disc = format!(
        "<path d=\"M{x:.2} {top:.2}A{RADIUS} {RADIUS} 0 0 {right} {x:.2} {bottom:.2}Z\" fill=\"url(#{id})\"/>"
    );
    [head]
        .into_iter()
        .chain(stops)
        .chain(["</radialGradient>".to_owned(), disc])
        .collect()
}

/// The three channels against angle.
fn chart(title: &str, curves: &[Curve], low: f64) -> LineChart {
    let mut series = Vec::new();
    for (channel, (name, colour)) in CHANNELS.iter().enumerate() {
        // The exact law first, below the others.
        for (curve, (dashes, width)) in curves.iter().zip(LINES).rev() {
            let points = degrees()
                .zip(&curve.colours)
                .step_by(POINTS)
                .map(|(at, rgb)| (at, rgb[channel]));
            series.push(Series::new(
                &format!("{name}: {}", curve.name.trim_start_matches("exact ")),
                Style::Own(Look::new(colour, dashes, width)),
                points.collect(),
            ));
        }
    }
    LineChart {
        title: title.to_owned(),
        subtitle: String::new(),
        x: ChartAxis::angle_of_incidence(),
        y: ChartAxis::new("reflectance", [low, 1.0], 6, ""),
        series,
        ..LineChart::default()
    }
}
