//! Reflectance against wavelength at a few angles, and reflectance against angle for red, green and blue.

use glam::DVec3;

use crate::physics::materials::{AtWavelength, Extrapolate, Material};
use crate::physics::optics::cosine;
use crate::pictures::material_sheet::{DrawnMaterial, axis};
use crate::pictures::plot::{
    BLUE, ChartAxis, GREEN, INK, LineChart, Look, Series, Style, VERMILION,
};

/// Angles in degrees, from near normal incidence to where metals are palest.
const ANGLES: [(f64, &str, &str); 4] = [
    (0.0, INK, ""),
    (45.0, BLUE, "9 4"),
    (70.0, VERMILION, "2.5 3"),
    (82.0, "#8a4fb5", "10 3 2.5 3"),
];

/// The reflected share of unpolarised light, by the exact law.
pub(super) fn spectrum_chart(drawn: &DrawnMaterial) -> LineChart {
    let three = drawn.three_nm();
    let (range, indices) = match three {
        Some(rgb) => (Some(axis::around(rgb)), points(drawn)),
        None => measured(drawn),
    };
    let dots = three.is_some() || indices.len() == 1;
    let width = if dots { 1.4 } else { 2.2 };
    let series = ANGLES.map(|(degrees, colour, dashes)| {
        let line = Look::new(colour, dashes, width);
        let points = reflectance(&indices, cosine(degrees));
        Series::new(
            &format!("{degrees}°"),
            Style::Own(Look { dots, ..line }),
            points,
        )
    });
    let subtitle = match (three, range) {
        (Some([red, green, blue]), _) => {
            format!("Known at {red}, {green} and {blue} nm; the lines only join the points.")
        }
        (None, Some(_)) => "Unpolarised light, exact law.".to_owned(),
        (None, None) => "Not measured in visible light.".to_owned(),
    };
    LineChart {
        title: "Reflectance against wavelength".to_owned(),
        subtitle,
        x: axis::wavelength_axis(range),
        y: axis::reflectance(&series),
        series: series.to_vec(),
        ..LineChart::default()
    }
}

/// The surface by wavelength.
type Indices = Vec<(f64, AtWavelength)>;

/// The surface at three wavelengths, where it is known only at these.
fn points(drawn: &DrawnMaterial) -> Indices {
    let surface = &drawn.surface;
    let wavelengths = surface.integrator.wavelengths.iter().copied();
    let at = |(i, nm)| {
        let (index, films) = (surface.indices[i], surface.films_at(i).to_vec());
        (nm, AtWavelength { index, films })
    };
    let mut points: Indices = wavelengths.enumerate().map(at).collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    points
}

/// The visible range in which everything was measured, and the surface in it.
fn measured(drawn: &DrawnMaterial) -> (Option<(f64, f64)>, Indices) {
    let medium = drawn.medium.map(Material::range_nm);
    let (from, to) = drawn.material.range_nm();
    let (low, high) = medium.unwrap_or((from, to));
    let range = axis::shown((from.max(low), to.min(high)));
    let samples = range.map_or(Vec::new(), axis::samples);
    let index = |nm: f64| {
        let at = AtWavelength::new(drawn.material, drawn.medium, nm, Extrapolate::Refuse);
        Some((nm, at.ok()?))
    };
    (range, samples.into_iter().filter_map(index).collect())
}

fn reflectance(indices: &Indices, cos_theta: f64) -> Vec<(f64, f64)> {
    let law = |at: &AtWavelength| at.reflectance(cos_theta).unpolarised();
    let points = indices.iter().map(|(nm, at)| (*nm, law(at)));
    points.collect()
}

/// The number of angles: from 0 to 90 degrees, a quarter of a degree apart.
const POINTS: u32 = 361;

/// The angles at which curves are drawn, in degrees.
pub(super) fn angles() -> impl Iterator<Item = f64> {
    (0..POINTS).map(|i| 90.0 * f64::from(i) / f64::from(POINTS - 1))
}

/// Red is solid below, and the others are dashed above it with one period. Where the three coincide, each still shows on a third
/// of the line.
const CHANNELS: [(&str, Look); 3] = [
    ("red", Look::new("#d5432a", "", 3.6)),
    ("green", Look::new(GREEN, "14 7", 2.8)),
    ("blue", Look::new("#1f5fd0", "7 14", 2.8)),
];

/// The reflected share of unpolarised light in each channel, by the exact law.
pub(super) fn angle_chart(drawn: &DrawnMaterial) -> LineChart {
    let colour = |degrees| (degrees, drawn.surface.unpolarised(cosine(degrees)));
    let colours: Vec<(f64, DVec3)> = angles().map(colour).collect();
    let series = [0, 1, 2].map(|channel| {
        let (name, look) = CHANNELS[channel];
        let points = colours.iter().map(|(at, colour)| (*at, colour[channel]));
        Series::new(name, Style::Own(look), points.collect())
    });
    LineChart {
        title: "Reflectance against angle".to_owned(),
        subtitle: subtitle(&series),
        x: ChartAxis::angle_of_incidence(),
        y: axis::reflectance(&series),
        series: series.to_vec(),
        ..LineChart::default()
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
