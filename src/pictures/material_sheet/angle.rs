//! Reflectance against angle, for red, green and blue.

use glam::DVec3;

pub use crate::physics::optics::cosine;
use crate::pictures::plot::{ChartAxis, GREEN, LineChart, Look, Series, Style};

use crate::pictures::material_sheet::{DrawnMaterial, axis};

/// From 0 to 90 degrees, a quarter of a degree apart.
const POINTS: u32 = 361;

/// Solid below, dashed above with one period: where the three coincide, each still has a third of the line.
const CHANNELS: [(&str, Look); 3] = [
    ("red", look("#d5432a", "", 3.6)),
    ("green", look(GREEN, "14 7", 2.8)),
    ("blue", look("#1f5fd0", "7 14", 2.8)),
];

const fn look(colour: &'static str, dashes: &'static str, width: f64) -> Look {
    Look {
        colour,
        dashes,
        width,
        dots: false,
    }
}

/// The reflected share of unpolarised light in each channel, by the exact law.
pub(super) fn angle_chart(drawn: &DrawnMaterial) -> LineChart {
    let degrees: Vec<f64> = (0..POINTS)
        .map(|i| 90.0 * f64::from(i) / f64::from(POINTS - 1))
        .collect();
    let colours: Vec<DVec3> = degrees
        .iter()
        .map(|at| drawn.surface.unpolarised(cosine(*at)))
        .collect();
    let series = |(channel, (name, look)): (usize, (&str, Look))| Series {
        name: name.to_owned(),
        style: Style::Own(look),
        points: degrees
            .iter()
            .zip(&colours)
            .map(|(at, colour)| (*at, colour[channel]))
            .collect(),
    };
    let series: Vec<Series> = CHANNELS.into_iter().enumerate().map(series).collect();
    LineChart {
        title: "Reflectance against angle".to_owned(),
        subtitle: subtitle(&series),
        x: ChartAxis::angle_of_incidence(),
        y: axis::reflectance(&series),
        series,
        marks: Vec::new(),
        foot: String::new(),
    }
}

fn subtitle(series: &[Series]) -> String {
    let law = "Unpolarised light, exact law.";
    let beyond = |value: f64| !(-5e-4..=1.0005).contains(&value);
    if axis::values(series).any(beyond) {
        return format!("{law} Outside 0 to 1: a colour that the space cannot hold, kept.");
    }
    law.to_owned()
}
