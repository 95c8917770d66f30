//! The first picture of README: gold and platinum by Schlick's approximation, by `fitted` and by the exact law over the whole
//! spectrum, as spheres and as curves.
//!
//! A sphere is seen from afar in a room that is white everywhere, so a pixel's colour is the reflectance at its angle:
//! at r of the radius sin θ = r. The right half of a sphere shows the error instead of the colour.

use fresnel_gen::generator::emit::{Bounds, Naming, specialised_function};
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods;
use fresnel_gen::physics::optics::cosine;
use fresnel_gen::pictures::plot::{
    ChartAxis, FOOT, HEADING, Layout, LineChart, PANEL, PanelFrame, SUBTITLE, Series, Style, TICK,
    hex_colour,
};

/// The materials, each with the lowest reflectance on its axis.
const MATERIALS: [(&str, f64); 2] = [("gold", 0.6), ("platinum", 0.4)];
/// The methods, cheapest first; the exact law comes last.
const METHODS: [(&str, &str); 2] = [("schlick", "Schlick"), ("fitted", "fitted")];
/// The exact law's name in the picture.
const EXACT: &str = "exact law";
/// The factor that brightens the error.
const BRIGHTER: f64 = 5.0;
/// The number of angles: from 0 to 90 degrees, half a degree apart.
const ANGLES: u32 = 181;
/// The stride in these angles of a sphere's gradient.
const STOPS: usize = 4;

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

/// The picture as SVG text. `command` makes it again and stands at its foot.
pub fn headline(command: &str) -> String {
    let mut layout = Layout::new(PICTURE);
    let title = "Schlick's approximation, fitted, and the exact law";
    layout.paragraph(&HEADING, title);
    let words = format!(
        "Spheres in a white room. Left half: the colour of the reflection. Right half: the error, {BRIGHTER} times \
         brighter; black is no error."
    );
    layout.paragraph(&SUBTITLE, &words);
    for (material, low) in MATERIALS {
        let curves = curves(material);
        let (spheres, chart) = (spheres(material, &curves), chart(material, &curves, low));
        layout.side_by_side(
            PICTURE.margin - SPHERES.margin,
            vec![spheres, chart.panel(CURVES, material)],
        );
    }
    layout.paragraph(&FOOT, command);
    layout.document(title, &words)
}

fn degrees() -> impl Iterator<Item = f64> {
    (0..ANGLES).map(|i| 90.0 * f64::from(i) / f64::from(ANGLES - 1))
}

/// The reflectance in air by each method, and last by the whole spectrum.
fn curves(material: &str) -> Vec<Curve> {
    let subject = &crate::subjects(&[material])[0];
    let cosines: Vec<f64> = degrees().map(cosine).collect();
    let mut curves = Vec::new();
    for (method, name) in METHODS {
        let method = methods::find(method).unwrap();
        let emitted =
            specialised_function(method, subject, &Naming::default(), &Bounds::recorded());
        let values = evaluate(&emitted.unwrap().function, &[Value::each(cosines.clone())]);
        let colours = (0..cosines.len()).map(|i| values.at(i)).collect();
        curves.push(Curve { name, colours });
    }
    let exact = cosines.iter().map(|c| subject.reference.at(*c)).collect();
    curves.push(Curve {
        name: EXACT,
        colours: exact,
    });
    curves
}

/// The spheres of a material side by side.
fn spheres(material: &str, curves: &[Curve]) -> Layout {
    let mut layout = Layout::new(SPHERES);
    layout.paragraph(&PANEL, material);
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

/// The mean of the three channels against angle.
fn chart(material: &str, curves: &[Curve], low: f64) -> LineChart {
    let mean = |colour: &[f64; 3]| colour.iter().sum::<f64>() / 3.0;
    let series = curves.iter().rev().enumerate().map(|(i, curve)| Series {
        name: curve.name.to_owned(),
        style: match i {
            0 => Style::Exact,
            i => Style::Approximate(i - 1),
        },
        points: degrees().zip(curve.colours.iter().map(mean)).collect(),
    });
    LineChart {
        title: format!("{material}: mean of the channels"),
        subtitle: String::new(),
        x: ChartAxis::angle_of_incidence(),
        y: ChartAxis::new("reflectance", [low, 1.0], 6, ""),
        series: series.collect(),
        ..LineChart::default()
    }
}
