//! A figure of the thesis as a chart.

use crate::lab::reproduce::{DrawnCurve, FIGURE_POINTS, ThesisFigure};
use crate::pictures::plot::{ChartAxis, LineChart, Series, Style};

/// The chart of a figure.
pub fn figure_chart(figure: &ThesisFigure) -> LineChart {
    let series = |curve: &DrawnCurve, style| Series::new(curve.name, style, curve.points.clone());
    let mut all = vec![series(&figure.exact, Style::Exact)];
    for (i, curve) in figure.curves.iter().enumerate() {
        all.push(series(curve, Style::Approximate(i)));
    }
    LineChart {
        title: format!("Figure {}: {}", figure.plan.number, figure.plan.subject),
        subtitle: subtitle(figure),
        x: ChartAxis::angle_of_incidence(),
        y: ChartAxis::new("unpolarised reflectance", [figure.plan.low, 100.0], 5, "%"),
        series: all,
        marks: figure.marks.clone(),
        foot: "fresnel-gen reproduce figures".to_owned(),
    }
}

fn subtitle(figure: &ThesisFigure) -> String {
    let difference = |curve: &DrawnCurve| {
        let (at, apart) = curve.largest_difference(&figure.exact);
        format!("{} {apart:.2} percentage points at {at}°", curve.name)
    };
    let differences: Vec<String> = figure.curves.iter().map(difference).collect();
    let mut parts = vec![
        format!("Reflectance computed at {FIGURE_POINTS} angles, a quarter of a degree apart."),
        format!(
            "Largest difference from the exact law: {}.",
            differences.join("; ")
        ),
        figure.derived.clone(),
        figure.plan.note.to_owned(),
    ];
    if figure.plan.low > 0.0 {
        parts.push(format!("The axis starts at {} %.", figure.plan.low));
    }
    parts.retain(|part| !part.is_empty());
    parts.join(" ")
}
