//! The picture of several materials: their reflectance against angle, and their n and k against wavelength, each in one set of
//! axes. Every panel of reflectance has the same axis, which fits the curves.

use glam::DVec3;

use crate::physics::materials::{
    AtWavelength, ComparedMaterial, DispersionCurve, Extrapolate, Material,
};
use crate::physics::optics::{Reflectance, cosine};
use crate::pictures::material_sheet::index::{highest, joined, whole};
use crate::pictures::material_sheet::spectrum::angles;
use crate::pictures::material_sheet::{LEFT, PANEL, PICTURE, axis};
use crate::pictures::plot::{
    ChartAxis, FOOT, HEADING, Layout, LineChart, Look, PanelFrame, SUBTITLE, Series, Style,
};

/// What of reflectance is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShownReflectance {
    /// A panel for each of these wavelengths, in nanometres; where there are none, one for each channel.
    pub wavelengths_nm: Vec<f64>,
    /// Whether both polarisations are drawn too.
    pub polarised: bool,
}

/// Panels of reflectance in a row.
const IN_A_ROW: usize = 3;
/// The size of each: three are as wide as two of the sheet.
const ANGLE_PANEL: PanelFrame = PanelFrame {
    width: 390.0,
    ..PANEL
};
/// Dashes of s and of p, and the width of both.
const POLARISED: ([&str; 2], f64) = (["5 3", "1.5 2.5"], 1.2);

/// The picture of these materials in air or in a medium, as SVG text. `command` makes it again and stands at the foot.
///
/// # Errors
/// A material or the medium is not known at one of the shown wavelengths.
pub fn comparison_sheet(
    all: &[ComparedMaterial],
    medium: Option<&Material>,
    beyond: Extrapolate,
    shown: &ShownReflectance,
    command: &str,
) -> Result<String, String> {
    let angles = angle_charts(all, medium, beyond, shown)?;
    let [n, k] = index_charts(all, beyond, medium.is_some());
    let title = title(all, medium);
    let sources: Vec<String> = all.iter().map(|one| source(one.material)).collect();
    let seen = seen(all, medium, shown);
    let mut layout = Layout::new(PICTURE);
    layout.paragraph(&HEADING, &title);
    for line in &sources {
        layout.paragraph(&SUBTITLE, line);
    }
    for (row, charts) in angles.chunks(IN_A_ROW).enumerate() {
        let panel = |(place, chart): (usize, &LineChart)| {
            chart.panel(ANGLE_PANEL, &format!("angle-{row}-{place}"))
        };
        layout.side_by_side(LEFT, charts.iter().enumerate().map(panel).collect());
    }
    layout.side_by_side(LEFT, vec![n.panel(PANEL, "n"), k.panel(PANEL, "k")]);
    for line in [&seen, command] {
        layout.paragraph(&FOOT, line);
    }
    let charts = angles.iter().chain([&n, &k]).map(LineChart::description);
    let parts: Vec<String> = sources
        .iter()
        .cloned()
        .chain(charts)
        .chain([seen])
        .collect();
    Ok(layout.document(&title, &parts.join(" ")))
}

fn title(all: &[ComparedMaterial], medium: Option<&Material>) -> String {
    let names: Vec<&str> = all.iter().map(|one| one.material.name.as_str()).collect();
    let medium = medium.map_or(String::new(), |medium| format!(" in {}", medium.name));
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}{medium}", rest.join(", ")),
        _ => names.concat() + &medium,
    }
}

/// A line of the legend: what the material is, and who measured it when.
fn source(material: &Material) -> String {
    let Material { name, summary, .. } = material;
    let source = material.source_words(" ").unwrap_or_default();
    format!("{name}: {summary}. {source}").trim_end().to_owned()
}

/// The viewing conditions of channels, in a sentence, and what was held beyond its measured range.
fn seen(all: &[ComparedMaterial], medium: Option<&Material>, shown: &ShownReflectance) -> String {
    let nm = &shown.wavelengths_nm;
    let conditions = all.first().filter(|_| nm.is_empty());
    let mut parts = Vec::from_iter(conditions.map(|one| format!("Seen: {}.", one.surface.seen)));
    for one in all {
        let held = match nm.is_empty() {
            true => one.surface.extrapolation(),
            false => AtWavelength::extrapolation(one.material, medium, nm),
        };
        let name = &one.material.name;
        parts.extend(held.map(|held| format!("Extrapolated, {name}: {held}.")));
    }
    parts.join(" ")
}

/// The reflectance of one material by the cosine of the angle.
type ByAngle<'a> = Box<dyn Fn(f64) -> Reflectance<f64> + 'a>;

fn angle_charts(
    all: &[ComparedMaterial],
    medium: Option<&Material>,
    beyond: Extrapolate,
    shown: &ShownReflectance,
) -> Result<Vec<LineChart>, String> {
    let mut charts = Vec::new();
    if shown.wavelengths_nm.is_empty() {
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            let of = |one| channel_by_angle(one, channel);
            charts.push(angle_chart(name, all.iter().map(of).collect(), all, shown));
        }
    }
    for nm in &shown.wavelengths_nm {
        let mut curves: Vec<ByAngle> = Vec::new();
        for one in all {
            let found = AtWavelength::each(one.material, medium, &[*nm], beyond);
            let known = found.map_err(|unknown| unknown.to_string())?;
            curves.push(Box::new(move |cos_theta| known[0].reflectance(cos_theta)));
        }
        charts.push(angle_chart(&format!("{nm} nm"), curves, all, shown));
    }
    let series: Vec<Series> = charts
        .iter()
        .flat_map(|chart| chart.series.clone())
        .collect();
    let y = axis::holding("reflectance", axis::values(&series));
    for chart in &mut charts {
        chart.y = y.clone();
    }
    Ok(charts)
}

fn channel_by_angle<'a>(one: &'a ComparedMaterial, channel: usize) -> ByAngle<'a> {
    Box::new(move |cos_theta| {
        let Reflectance::<DVec3> { s, p } = one.surface.reflectance(cos_theta);
        Reflectance {
            s: s[channel],
            p: p[channel],
        }
    })
}

/// The chart of one channel or wavelength; the caller gives it the axis that all share.
fn angle_chart(
    name: &str,
    curves: Vec<ByAngle>,
    all: &[ComparedMaterial],
    shown: &ShownReflectance,
) -> LineChart {
    let mut series = Vec::new();
    for (place, (curve, one)) in curves.iter().zip(all).enumerate() {
        let style = Style::Approximate(place);
        let both: Vec<(f64, Reflectance<f64>)> = angles()
            .map(|degrees| (degrees, curve(cosine(degrees))))
            .collect();
        let mut add = |name: &str, style: Style, value: fn(Reflectance<f64>) -> f64| {
            let points = both.iter().map(|(at, both)| (*at, value(*both)));
            series.push(Series::new(name, style, points.collect()));
        };
        add(&one.material.name, style, Reflectance::unpolarised);
        if shown.polarised {
            let ([s, p], width) = POLARISED;
            let thin = |dashes| Style::Own(Look::new(style.look().colour, dashes, width));
            add(&format!("{} s", one.material.name), thin(s), |both| both.s);
            add(&format!("{} p", one.material.name), thin(p), |both| both.p);
        }
    }
    let light = if shown.polarised {
        "Unpolarised light; thin lines: s above, p below."
    } else {
        "Unpolarised light."
    };
    LineChart {
        title: format!("Reflectance, {name}"),
        subtitle: format!("{light} Exact law."),
        x: ChartAxis::angle_of_incidence(),
        series,
        ..LineChart::default()
    }
}

/// The most dots of a curve that do not hide its dashes.
const MOST_DOTS: usize = 80;

fn fewer_dots(series: Series, place: usize) -> Series {
    if series.points.len() <= MOST_DOTS {
        return series;
    }
    let style = Style::Approximate(place);
    Series { style, ..series }
}

/// n and k of the materials themselves, whatever surrounds them.
fn index_charts(all: &[ComparedMaterial], beyond: Extrapolate, in_medium: bool) -> [LineChart; 2] {
    let known = |one: &ComparedMaterial| match one.material.rgb_nm {
        Some(rgb) => Some(axis::around(rgb)),
        None => axis::either(one.material),
    };
    let ranges = all.iter().filter_map(known);
    let range = ranges.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)));
    let curve = |place: usize, material: &Material, curve: &DispersionCurve| {
        let (name, look) = (material.name.as_str(), Style::Approximate(place).look());
        match material.rgb_nm {
            Some(rgb) => joined(name, curve, look, rgb, beyond),
            None => fewer_dots(whole(name, curve, look, range), place),
        }
    };
    let (mut n, mut k, mut clear) = (Vec::new(), Vec::new(), Vec::new());
    for (place, one) in all.iter().enumerate() {
        let material = one.material;
        n.push(curve(place, material, &material.n));
        let own = material.k.as_ref().map(|k| curve(place, material, k));
        match own.filter(|k| highest(k) > 0.0) {
            Some(own) => k.push(own),
            None => clear.push(material.name.as_str()),
        }
    }
    let own = if in_medium {
        " Their own, not divided by the medium's."
    } else {
        ""
    };
    let without = match clear.join(", ") {
        names if names.is_empty() => String::new(),
        names => format!(" 0, or not known here: {names}."),
    };
    let chart = |title: &str, label: &str, more: &str, series: Vec<Series>| LineChart {
        title: title.to_owned(),
        subtitle: format!("Dots are measured points, where these are few.{own}{more}"),
        x: axis::wavelength_axis(range),
        y: axis::holding(label, axis::values(&series)),
        series,
        ..LineChart::default()
    };
    [
        chart("Refractive index", "n", "", n),
        chart("Extinction coefficient", "k", &without, k),
    ]
}
