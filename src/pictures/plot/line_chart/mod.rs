//! A line chart: curves over two axes, with a legend and guide lines.

mod drawing;

use crate::pictures::plot::axes::{Scale, Tick, labelled};
use crate::pictures::plot::palette::Style;
use crate::pictures::plot::ticks::{decimals, label, ticks};

/// A line chart: the curves, and the words that say what they are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineChart {
    /// What the chart shows, in one line if possible.
    pub title: String,
    /// What is measured, and from how many points.
    pub subtitle: String,
    /// The horizontal axis.
    pub x: ChartAxis,
    /// The vertical axis.
    pub y: ChartAxis,
    /// The curves, in legend order.
    pub series: Vec<Series>,
    /// Vertical guide lines: the position on the horizontal axis, and the label above the plot, such as "81.37°". Those outside the
    /// axis are left out.
    pub marks: Vec<(f64, String)>,
    /// The command that makes the chart.
    pub foot: String,
}

/// The range of one axis and where it is labelled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartAxis {
    /// The quantity along the axis.
    pub label: String,
    /// The value at the left or bottom end; like `high`, finite.
    pub low: f64,
    /// The value at the right or top end.
    pub high: f64,
    /// Values with a grid line and a label; those off the axis are left out.
    pub ticks: Vec<f64>,
    /// Appended to each tick label as it stands, such as "°", "%" or " nm".
    pub unit: &'static str,
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The name in the legend.
    pub name: String,
    /// How the curve is drawn.
    pub style: Style,
    /// The points, joined in order; one that is not finite leaves a gap.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// A curve through these points.
    pub fn new(name: &str, style: Style, points: Vec<(f64, f64)>) -> Series {
        Series {
            name: name.to_owned(),
            style,
            points,
        }
    }
}

impl LineChart {
    /// What a reader who does not see the chart should hear.
    pub fn description(&self) -> String {
        let names: Vec<&str> = self.series.iter().map(|one| one.name.as_str()).collect();
        let marks: Vec<&str> = self.marks.iter().map(|(_, label)| label.as_str()).collect();
        let mut parts = vec![
            self.subtitle.clone(),
            format!("Vertical: {}", self.y.description()),
            format!("Horizontal: {}", self.x.description()),
            format!("Curves: {}", names.join("; ")),
        ];
        if !marks.is_empty() {
            parts.push(format!("Marked: {}", marks.join("; ")));
        }
        parts.retain(|part| !part.is_empty());
        parts.join(". ")
    }
}

impl ChartAxis {
    /// An axis with ticks at round values, at about so many intervals.
    pub fn new(label: &str, [low, high]: [f64; 2], about: usize, unit: &'static str) -> ChartAxis {
        ChartAxis {
            label: label.to_owned(),
            low,
            high,
            ticks: ticks(low, high, about),
            unit,
        }
    }

    /// The angle of incidence, in degrees.
    pub fn angle_of_incidence() -> ChartAxis {
        ChartAxis::new("angle of incidence", [0.0, 90.0], 9, "°")
    }

    /// Where its values lie between two coordinates.
    fn scale(&self, coordinates: [f64; 2]) -> Scale {
        Scale::linear([self.low, self.high], coordinates)
    }

    /// The ticks on the axis, each with its label.
    fn labelled_ticks(&self) -> Vec<Tick> {
        let scale = self.scale([0.0, 1.0]);
        let mut shown = self.ticks.clone();
        shown.retain(|&tick| scale.holds(tick));
        let decimals = decimals(&shown);
        labelled(shown, |value| label(value, decimals, self.unit))
    }

    fn description(&self) -> String {
        let (low, high, unit) = (self.low, self.high, self.unit);
        format!("{}, {low}{unit} to {high}{unit}", self.label)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> LineChart {
        LineChart {
            title: "Water & <air>".into(),
            subtitle: "Two points".into(),
            x: ChartAxis::new("Angle", [0.0, 90.0], 5, "°"),
            y: ChartAxis::new("Reflectance", [0.0, 100.0], 5, "%"),
            series: vec![
                Series::new(
                    "fit",
                    Style::Approximate(0),
                    vec![(0.0, 5.0), (90.0, 400.0)],
                ),
                Series::new("exact", Style::Exact, vec![(0.0, 2.0), (90.0, 100.0)]),
            ],
            marks: vec![],
            foot: "make \"it\"".into(),
        }
    }

    fn count(svg: &str, part: &str) -> usize {
        svg.matches(part).count()
    }

    #[test]
    fn equal_charts_give_equal_text() {
        assert_eq!(chart().svg(), chart().clone().svg());
        assert!(chart().svg().ends_with("</svg>\n"));
        assert!(!chart().svg().contains('\r'));
    }

    #[test]
    fn all_text_is_escaped() {
        let svg = chart().svg();
        assert!(svg.contains("<title>Water &amp; &lt;air&gt;</title>"));
        assert!(svg.contains(">make &quot;it&quot;</text>"));
        assert!(!svg.contains("<air>"));
    }

    #[test]
    fn curves_are_clipped_to_the_plot() {
        let svg = chart().svg();
        let clipped = svg.split("<g clip-path=\"url(#plot-area)\"").nth(1);
        let curves = clipped.and_then(|rest| rest.split("</g>").next());
        assert_eq!(count(&svg, "<clipPath id=\"plot-area\">"), 1);
        assert_eq!(count(curves.unwrap_or_default(), "<path "), 2);
    }

    #[test]
    fn far_points_stay_short() {
        let mut far = chart();
        far.series[0].points[1].1 = 1e300;
        assert!(far.svg().lines().all(|line| line.len() < 400));
    }

    #[test]
    fn points_that_are_not_finite_leave_a_gap() {
        let mut gap = chart();
        let points = vec![(0.0, 1.0), (1.0, 2.0), (2.0, f64::NAN), (3.0, 4.0)];
        gap.series = vec![Series::new("gap", Style::Exact, points)];
        let svg = gap.svg();
        let data = svg.split("stroke-width=\"3\" d=\"").nth(2);
        let data = data.and_then(|rest| rest.split('"').next());
        assert_eq!(count(data.unwrap_or_default(), "M"), 2);
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn the_exact_curve_lies_beneath() {
        let svg = chart().svg();
        let curves = svg.split("url(#plot-area)").nth(1).unwrap_or_default();
        assert!(curves.find("stroke-width=\"3\"") < curves.find("stroke-dasharray"));
    }

    #[test]
    fn ticks_and_marks_off_the_axis_are_left_out() {
        let mut wide = chart();
        wide.x.ticks.push(120.0);
        wide.marks = [30.0, 95.0].map(|at| (at, format!("at {at}"))).to_vec();
        let svg = wide.svg();
        assert!(!svg.contains(">120°<"));
        assert!(svg.contains(">at 30<") && !svg.contains(">at 95<"));
    }

    #[test]
    fn the_height_grows_only_for_long_text() {
        assert!(chart().svg().contains("viewBox=\"0 0 720 440\""));
        let mut long = chart();
        long.subtitle = "many words ".repeat(200);
        assert!(!long.svg().contains("viewBox=\"0 0 720 440\""));
    }
}
