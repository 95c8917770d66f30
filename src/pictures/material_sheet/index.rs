//! n and k against wavelength, as measured.

use crate::physics::materials::{DispersionCurve, Extrapolate};
use crate::pictures::material_sheet::{DrawnMaterial, axis};
use crate::pictures::plot::{BLUE, LineChart, Look, Series, Style, VERMILION};

const N: Look = Look::new(BLUE, "", 2.2);
const K: Look = Look::new(VERMILION, "9 4", 2.2);
/// Dashes of lines that only join points.
const JOINT: &str = "2 5";
/// A k below this is not distinguished from 0 in a chart with n.
const LEAST_K: f64 = 1e-3;

/// n and k of the material itself, whatever surrounds it.
pub(super) fn index_chart(drawn: &DrawnMaterial) -> LineChart {
    let material = drawn.material;
    let three = material
        .rgb_nm
        .map(|rgb| drawn.viewing.wavelengths_nm.unwrap_or(rgb));
    let range = match three {
        Some(rgb) => Some(axis::around(rgb)),
        None => axis::either(material),
    };
    let curve_series = |name: &str, curve: &DispersionCurve, look: Look| match three {
        Some(rgb) => joined(name, curve, look, rgb, drawn.viewing.beyond),
        None => whole(name, curve, look, range),
    };
    let n = curve_series("n", &material.n, N);
    let k = material.k.as_ref().map(|curve| curve_series("k", curve, K));
    let mut subtitle = origin(&n, &material.n, three, range);
    subtitle += &without_k(k.as_ref());
    if !material.films.is_empty() {
        subtitle += " Of what lies below the films.";
    }
    if drawn.medium.is_some() {
        subtitle += " Its own, not divided by the medium's.";
    }
    let k = k.filter(|k| highest(k) >= LEAST_K);
    // With k in the chart, the axis of n begins at 0. Alone, n's dispersion is what matters.
    let ground = k.as_ref().map(|_| 0.0);
    let label = if k.is_some() { "n, k" } else { "n" };
    let mut series: Vec<Series> = std::iter::once(n).chain(k).collect();
    series.retain(|series| !series.points.is_empty());
    let y = axis::holding(label, axis::values(&series).chain(ground));
    if y.low != 0.0 {
        subtitle += " The axis does not start at 0.";
    }
    LineChart {
        title: "Refractive index and extinction".to_owned(),
        subtitle,
        x: axis::wavelength_axis(range),
        y,
        series,
        ..LineChart::default()
    }
}

/// The highest value; negative infinity where there is none.
pub(super) fn highest(series: &Series) -> f64 {
    let values = series.points.iter().map(|point| point.1);
    values.fold(f64::NEG_INFINITY, f64::max)
}

/// The reason why no k is drawn, where none is.
fn without_k(k: Option<&Series>) -> String {
    match k.map(highest) {
        Some(most) if most >= LEAST_K => String::new(),
        Some(f64::NEG_INFINITY) => " k is not known here.".to_owned(),
        Some(most) if most > 0.0 => format!(" k is at most {most:.1e}, not drawn."),
        _ => " k is 0.".to_owned(),
    }
}

/// Three points, joined by dashes to guide the eye.
pub(super) fn joined(
    name: &str,
    curve: &DispersionCurve,
    look: Look,
    mut rgb: [f64; 3],
    beyond: Extrapolate,
) -> Series {
    rgb.sort_by(f64::total_cmp);
    let value = |nm: f64| curve.at(nm, beyond).unwrap_or(f64::NAN);
    let look = Look {
        dots: true,
        ..Look::new(look.colour, JOINT, 1.4)
    };
    let points = rgb.map(|nm| (nm, value(nm))).to_vec();
    Series::new(name, Style::Own(look), points)
}

/// A table with its points as dots, or a formula's curve.
pub(super) fn whole(
    name: &str,
    curve: &DispersionCurve,
    look: Look,
    range: Option<(f64, f64)>,
) -> Series {
    let points = match (curve, range) {
        (_, None) => Vec::new(),
        (DispersionCurve::Table(table), Some(range)) => within(table.points(), range),
        (DispersionCurve::Formula(formula), Some(_)) => {
            let own = axis::shown((formula.from_nm, formula.to_nm));
            let at = |nm: f64| (nm, formula.n(nm).unwrap_or(f64::NAN));
            let samples = own.map_or(Vec::new(), axis::samples);
            samples.into_iter().map(at).collect()
        }
    };
    let dots = matches!(curve, DispersionCurve::Table(_));
    Series::new(name, Style::Own(Look { dots, ..look }), points)
}

/// The points inside a range, and the points where the lines to their neighbours cross its ends.
fn within(points: &[(f64, f64)], (from, to): (f64, f64)) -> Vec<(f64, f64)> {
    let first = points.partition_point(|point| point.0 < from);
    let last = points.partition_point(|point| point.0 <= to);
    let neighbours = first.saturating_sub(1)..points.len().min(last + 1);
    points.get(neighbours).unwrap_or_default().to_vec()
}

/// What the curve is based on.
fn origin(
    n: &Series,
    curve: &DispersionCurve,
    three: Option<[f64; 3]>,
    range: Option<(f64, f64)>,
) -> String {
    if let Some([red, green, blue]) = three {
        return format!("Taken at {red}, {green} and {blue} nm; the dashes only join the points.");
    }
    let Some((from, to)) = range else {
        return "Not measured in visible light.".to_owned();
    };
    match curve {
        DispersionCurve::Formula(formula) => format!("n by dispersion formula {}.", formula.number),
        DispersionCurve::Table(_) => {
            let inside = |point: &&(f64, f64)| (from..=to).contains(&point.0);
            match n.points.iter().filter(inside).count() {
                1 => "One measured point in this range.".to_owned(),
                count => {
                    format!("{count} measured points in this range, straight lines between them.")
                }
            }
        }
    }
}
