//! A line chart as SVG: curves over two axes, with titles, a legend, a grid and guide lines.

use super::axes::{decimals, label, ticks};
use crate::pictures::plot::axes::{Area, Axes, Scale, TICK_GAP, Tick, labelled};
use crate::pictures::plot::layout::{Layout, PanelFrame, paragraph_height};
use crate::pictures::plot::palette::Style;
use crate::pictures::plot::text::{AXIS, FOOT, Font, LEGEND, MARK, PANEL, SUBTITLE, TICK, TITLE};

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

/// The frame of a chart that stands alone.
const ALONE: PanelFrame = PanelFrame {
    width: 720.0,
    height: 440.0,
    margin: 24.0,
    upper: 20.0,
    lower: 18.0,
};

/// The least height of the plot; the picture grows rather than go below it.
const LEAST_HEIGHT: f64 = 210.0;
/// The gap between the plot's end and the margin: half of the last tick's label.
const RIGHT_GAP: f64 = 8.0;
/// The height in which the line from a label slants to its position.
const SLANT: f64 = 11.0;
const LABEL_GAP: f64 = 10.0;
/// Half of the widest line, so that a curve along the edge stays whole.
const EDGE: f64 = 1.5;
/// The length of a line sample: two periods of the longest dash pattern.
const SAMPLE: f64 = 38.0;
const SAMPLE_GAP: f64 = 8.0;
const ENTRY_GAP: f64 = 24.0;

/// The label of a guide line: `at` is where it points, `centre` where it stands.
struct Label {
    lines: Vec<String>,
    at: f64,
    centre: f64,
}

impl LineChart {
    /// The chart as a complete SVG document that ends with a line feed.
    ///
    /// It is 720 wide and 440 high, or higher when long text would otherwise
    /// leave too little room for the plot.
    pub fn svg(&self) -> String {
        let layout = self.set(ALONE, &TITLE, "plot-area");
        layout.document(&self.title, &self.description())
    }

    /// The chart as a panel of a larger picture; `clip` is a name that no other
    /// part of the document has.
    pub fn panel(&self, frame: PanelFrame, clip: &str) -> Layout {
        self.set(frame, &PANEL, clip)
    }

    fn set(&self, frame: PanelFrame, title: &Font, clip: &str) -> Layout {
        let mut layout = Layout::new(frame);
        layout.paragraph(title, &self.title);
        layout.paragraph(&SUBTITLE, &self.subtitle);
        set_legend(&mut layout, &self.series);
        self.set_plot(&mut layout, clip);
        layout.paragraph(&FOOT, &self.foot);
        layout
    }

    /// Sets the plot and its axes, leaving room for the foot. Elements go from the back to the front.
    fn set_plot(&self, layout: &mut Layout, clip: &str) {
        let frame = layout.frame;
        let (x_ticks, y_ticks) = (self.x.labelled_ticks(), self.y.labelled_ticks());
        let y_label = AXIS.wrap(&self.y.label, LEAST_HEIGHT + 20.0);
        let y_labels = TICK.widest(y_ticks.iter().map(|tick| &tick.label));
        let left = frame.margin + (AXIS.height(&y_label) + y_labels + TICK_GAP);
        let right = frame.right() - RIGHT_GAP;
        let x_label = AXIS.wrap(&self.x.label, right - left);
        let x = self.x.scale([left, right]);
        let labels = place_labels(&self.marks, x, left, right);
        let heights = labels.iter().map(|label| MARK.height(&label.lines) + SLANT);
        let top = layout.bottom + 12.0 + heights.fold(0.0, f64::max);
        let to_title = TICK_GAP + TICK.leading;
        let below = to_title + AXIS.height(&x_label) + 8.0;
        let foot = paragraph_height(&FOOT, &FOOT.wrap(&self.foot, frame.room()));
        let bottom = (frame.height - (below + foot + frame.lower)).max(top + LEAST_HEIGHT);
        let axes = Axes {
            area: Area::between([left, right], [top, bottom]),
            x,
            y: self.y.scale([bottom, top]),
        };
        let mut elements = axes.grid(&x_ticks, &y_ticks);
        elements.extend(axes.tick_labels(&x_ticks, &y_ticks));
        elements.extend(axes.titles(&x_label, to_title, &y_label, frame.margin - 4.0));
        elements.extend(guides(&labels, &axes.area));
        elements.extend(curves(&self.series, &axes, clip));
        layout.extend(elements, bottom + below);
    }
}

/// Sets a line sample and a name for each curve, in as many rows as needed.
fn set_legend(layout: &mut Layout, series: &[Series]) {
    let (margin, room) = (layout.frame.margin, layout.frame.room());
    let (mut left, mut top) = (margin, layout.bottom + 7.0);
    for Series { name, style, .. } in series {
        let lines = LEGEND.wrap(name, room - SAMPLE - SAMPLE_GAP);
        let width = SAMPLE + SAMPLE_GAP + LEGEND.widest(&lines);
        if left > margin && left + width > margin + room {
            (left, top) = (margin, layout.bottom);
        }
        let (middle, attributes) = (top + LEGEND.leading / 2.0, style.attributes());
        let end = left + SAMPLE;
        let mut elements = vec![format!(
            "<path {attributes} d=\"M{left:.2} {middle:.2}H{end:.2}\"/>"
        )];
        elements.extend(style.dot(left + SAMPLE / 2.0, middle));
        elements.extend(LEGEND.draw(&lines, left + SAMPLE + SAMPLE_GAP, top, "start"));
        layout.extend(elements, layout.bottom.max(top + LEGEND.height(&lines)));
        left += width + ENTRY_GAP;
    }
}

fn guides(labels: &[Label], area: &Area) -> Vec<String> {
    let Area { top, bottom, .. } = *area;
    let lines_end = top - SLANT;
    let mut elements = Vec::new();
    for label in labels {
        elements.push(format!(
            "<path fill=\"none\" stroke=\"#8b95a3\" \
             d=\"M{:.2} {lines_end:.2}L{:.2} {:.2}V{:.2}\"/>",
            label.centre, label.at, top, bottom
        ));
        let top = lines_end - 1.0 - MARK.height(&label.lines);
        elements.extend(MARK.draw(&label.lines, label.centre, top, "middle"));
    }
    elements
}

/// The curves, clipped to the area, and the dots of those that have any. Only dots whose point lies on both axes are drawn.
fn curves(series: &[Series], Axes { area, x, y }: &Axes, clip: &str) -> Vec<String> {
    let mut series: Vec<&Series> = series.iter().collect();
    // Dashes over the solid line show where the curves coincide.
    series.sort_by_key(|one| one.style != Style::Exact);
    let mut elements = vec![
        format!(
            "<clipPath id=\"{clip}\"><rect x=\"{:.2}\" y=\"{:.2}\" \
             width=\"{:.2}\" height=\"{:.2}\"/></clipPath>",
            area.left - EDGE,
            area.top - EDGE,
            area.right - area.left + 2.0 * EDGE,
            area.bottom - area.top + 2.0 * EDGE
        ),
        format!("<g clip-path=\"url(#{clip})\" stroke-linejoin=\"round\">"),
    ];
    for one in &series {
        let (mut data, mut is_joined) = (String::new(), false);
        for (at, value) in &one.points {
            let is_finite = at.is_finite() && value.is_finite();
            if is_finite {
                let command = if is_joined { 'L' } else { 'M' };
                data += &format!("{command}{:.2} {:.2}", x.at(*at), y.at(*value));
            }
            is_joined = is_finite;
        }
        elements.push(format!("<path {} d=\"{data}\"/>", one.style.attributes()));
    }
    elements.push("</g>".into());
    for one in series {
        let inside = one
            .points
            .iter()
            .filter(|(at, value)| x.holds(*at) && y.holds(*value));
        elements.extend(inside.filter_map(|(at, value)| one.style.dot(x.at(*at), y.at(*value))));
    }
    elements
}

/// The labels of the guide lines in one row, in order and clear of each other.
fn place_labels(marks: &[(f64, String)], x: Scale, left: f64, right: f64) -> Vec<Label> {
    let mut shown: Vec<&(f64, String)> = marks.iter().filter(|(at, _)| x.holds(*at)).collect();
    shown.sort_by(|(one, _), (other, _)| x.fraction(*one).total_cmp(&x.fraction(*other)));
    // With no more than an equal share each, the labels fit side by side.
    let share = (right - left) / shown.len().max(1) as f64 - LABEL_GAP;
    let label = |(at, label): &(f64, String)| Label {
        lines: MARK.wrap(label, share),
        at: x.at(*at),
        centre: x.at(*at),
    };
    let mut labels: Vec<Label> = shown.into_iter().map(label).collect();
    spread(&mut labels, left, right + RIGHT_GAP);
    labels
}

/// Moves labels right to clear their neighbours, then back left into the row.
fn spread(labels: &mut [Label], left: f64, right: f64) {
    let mut free = left;
    for label in labels.iter_mut() {
        let half = MARK.widest(&label.lines) / 2.0;
        label.centre = label.centre.max(free + half);
        free = label.centre + half + LABEL_GAP;
    }
    let mut free = right;
    for label in labels.iter_mut().rev() {
        let half = MARK.widest(&label.lines) / 2.0;
        label.centre = label.centre.min(free - half);
        free = label.centre - half - LABEL_GAP;
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

    fn placed(marks: &[(f64, &str)]) -> Vec<Label> {
        let x = Scale::linear([0.0, 90.0], [80.0, 688.0]);
        let marks: Vec<(f64, String)> = marks
            .iter()
            .map(|(at, label)| (*at, (*label).to_owned()))
            .collect();
        place_labels(&marks, x, 80.0, 688.0)
    }

    fn edges(label: &Label) -> (f64, f64) {
        let half = MARK.widest(&label.lines) / 2.0;
        (label.centre - half, label.centre + half)
    }

    #[test]
    fn legend_rows_follow_the_length_of_the_names() {
        let rows = |names: &[&str]| {
            let mut layout = Layout::new(ALONE);
            let start = layout.bottom;
            let named = |name: &&str| Series::new(name, Style::Exact, vec![]);
            set_legend(&mut layout, &names.iter().map(named).collect::<Vec<_>>());
            ((layout.bottom - start) / LEGEND.leading).floor()
        };
        let (half, long) = ("word ".repeat(12), "word ".repeat(40));
        assert_eq!(rows(&[]), 0.0);
        assert_eq!(rows(&["a", "b", "c"]), 1.0);
        assert_eq!(rows(&[&half, &half, "c"]), 2.0);
        assert_eq!(rows(&["a", &long, "c"]), 5.0);
    }

    #[test]
    fn a_lone_label_stands_over_its_line() {
        let labels = placed(&[(45.0, "45°")]);
        assert_eq!(labels[0].centre, labels[0].at);
    }

    #[test]
    fn labels_that_nearly_coincide_are_kept_apart() {
        let long = "a label of several words";
        let labels = placed(&[(90.0, long), (0.0, long), (81.4, "b"), (81.5, long)]);
        for pair in labels.windows(2) {
            assert!(pair[0].at <= pair[1].at);
            assert!(edges(&pair[0]).1 + LABEL_GAP <= edges(&pair[1]).0 + 1e-9);
        }
        assert!(edges(&labels[0]).0 >= 80.0);
        assert!(edges(&labels[3]).1 <= 688.0 + RIGHT_GAP);
    }
}
