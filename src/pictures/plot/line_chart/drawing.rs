//! The plot itself: grid, guide lines, curves and axis labels.

use crate::pictures::plot::axes::{
    Area, Axes, PanelFrame, Scale, TICK_GAP, Tick, paragraph_height,
};
use crate::pictures::plot::line_chart::{LineChart, Mark, Series};
use crate::pictures::plot::palette::Style;
use crate::pictures::plot::text::{AXIS, FOOT, MARK, TICK};

/// The least height of the plot; the picture grows rather than go below it.
const LEAST_HEIGHT: f64 = 210.0;
/// The gap between the plot's end and the margin: half of the last tick's label.
const RIGHT_GAP: f64 = 8.0;
/// The height in which the line from a label slants to its position.
const SLANT: f64 = 11.0;
const LABEL_GAP: f64 = 10.0;
/// Half of the widest line, so that a curve along the edge stays whole.
const EDGE: f64 = 1.5;

/// The area of the plot, and the text around it broken into lines.
pub(super) struct Plot<'a> {
    chart: &'a LineChart,
    frame: PanelFrame,
    /// The name of the clip path. A document may hold several.
    clip: &'a str,
    labels: Vec<Label>,
    x_label: Vec<String>,
    y_label: Vec<String>,
    x_ticks: Vec<Tick>,
    y_ticks: Vec<Tick>,
    axes: Axes,
}

/// The label of a guide line: `at` is where it points, `centre` where it stands.
struct Label {
    lines: Vec<String>,
    at: f64,
    centre: f64,
}

impl<'a> Plot<'a> {
    /// Lays out the plot from `head` down, leaving room for the foot.
    pub(super) fn below(
        chart: &'a LineChart,
        frame: PanelFrame,
        clip: &'a str,
        head: f64,
    ) -> Plot<'a> {
        let (x_ticks, y_ticks) = (chart.x.labelled_ticks(), chart.y.labelled_ticks());
        let y_label = AXIS.wrap(&chart.y.label, LEAST_HEIGHT + 20.0);
        let left = frame.margin + left_of_plot(&y_ticks, AXIS.height(&y_label));
        let right = frame.right() - RIGHT_GAP;
        let x_label = AXIS.wrap(&chart.x.label, right - left);
        let x = chart.x.scale([left, right]);
        let labels = place_labels(&chart.marks, x, left, right);
        let top = head + 12.0 + labels_height(&labels);
        let foot = paragraph_height(&FOOT, &chart.foot, frame.room());
        let below = height_below(&x_label) + foot + frame.lower;
        let bottom = (frame.height - below).max(top + LEAST_HEIGHT);
        Plot {
            chart,
            frame,
            clip,
            labels,
            x_label,
            y_label,
            x_ticks,
            y_ticks,
            axes: Axes {
                area: Area {
                    left,
                    top,
                    right,
                    bottom,
                },
                x,
                y: chart.y.scale([bottom, top]),
            },
        }
    }

    /// The lower edge of everything that belongs to the plot.
    pub(super) fn end(&self) -> f64 {
        self.axes.area.bottom + height_below(&self.x_label)
    }

    /// All elements, from the back to the front.
    pub(super) fn draw(&self) -> Vec<String> {
        let (axes, below) = (&self.axes, TICK_GAP + TICK.leading);
        let left = self.frame.margin - 4.0;
        let parts = [
            axes.grid(&self.x_ticks, &self.y_ticks),
            axes.tick_labels(&self.x_ticks, &self.y_ticks),
            axes.titles(&self.x_label, below, &self.y_label, left),
            self.guides(),
            self.curves(),
        ];
        parts.concat()
    }

    fn guides(&self) -> Vec<String> {
        let Area { top, bottom, .. } = self.axes.area;
        let lines_end = top - SLANT;
        let mut elements = Vec::new();
        for label in &self.labels {
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

    fn curves(&self) -> Vec<String> {
        let mut series: Vec<&Series> = self.chart.series.iter().collect();
        // Dashes over the solid line show where the curves coincide.
        series.sort_by_key(|one| one.style != Style::Exact);
        let mut elements = vec![
            self.clip_path(),
            format!(
                "<g clip-path=\"url(#{})\" stroke-linejoin=\"round\">",
                self.clip
            ),
        ];
        elements.extend(series.iter().map(|one| self.curve(one)));
        elements.push("</g>".into());
        elements.extend(series.iter().flat_map(|one| self.dots(one)));
        elements
    }

    fn clip_path(&self) -> String {
        let area = &self.axes.area;
        format!(
            "<clipPath id=\"{}\"><rect x=\"{:.2}\" y=\"{:.2}\" \
             width=\"{:.2}\" height=\"{:.2}\"/></clipPath>",
            self.clip,
            area.left - EDGE,
            area.top - EDGE,
            area.right - area.left + 2.0 * EDGE,
            area.bottom - area.top + 2.0 * EDGE
        )
    }

    fn curve(&self, series: &Series) -> String {
        let mut data = String::new();
        let mut joined = false;
        for &(x, y) in &series.points {
            let finite = x.is_finite() && y.is_finite();
            if finite {
                let command = if joined { 'L' } else { 'M' };
                data += &format!("{command}{:.2} {:.2}", self.axes.x.at(x), self.axes.y.at(y));
            }
            joined = finite;
        }
        format!("<path {} d=\"{data}\"/>", series.style.attributes())
    }

    /// The dots of a curve, where its style has any. Only dots whose point lies on both axes are drawn.
    fn dots(&self, series: &Series) -> Vec<String> {
        let Axes { x, y, .. } = &self.axes;
        let points = series.points.iter();
        let inside = points.filter(|point| x.holds(point.0) && y.holds(point.1));
        inside
            .filter_map(|point| series.style.dot(x.at(point.0), y.at(point.1)))
            .collect()
    }
}

/// The room that an axis and its labels take on the left.
fn left_of_plot(ticks: &[Tick], label_width: f64) -> f64 {
    let labels: Vec<String> = ticks.iter().map(|tick| tick.label.clone()).collect();
    label_width + TICK.widest(&labels) + TICK_GAP
}

fn height_below(x_label: &[String]) -> f64 {
    TICK_GAP + TICK.leading + AXIS.height(x_label) + 8.0
}

fn labels_height(labels: &[Label]) -> f64 {
    let heights = labels.iter().map(|label| MARK.height(&label.lines) + SLANT);
    heights.fold(0.0, f64::max)
}

/// The labels of the guide lines in one row, in order and clear of each other.
fn place_labels(marks: &[Mark], x: Scale, left: f64, right: f64) -> Vec<Label> {
    let shown = marks.iter().filter(|mark| x.holds(mark.at));
    let mut shown: Vec<&Mark> = shown.collect();
    shown.sort_by(|one, other| x.fraction(one.at).total_cmp(&x.fraction(other.at)));
    // With no more than an equal share each, the labels fit side by side.
    let share = (right - left) / shown.len().max(1) as f64 - LABEL_GAP;
    let label = |mark: &Mark| {
        let at = x.at(mark.at);
        Label {
            lines: MARK.wrap(&mark.label, share),
            at,
            centre: at,
        }
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

    fn placed(marks: &[(f64, &str)]) -> Vec<Label> {
        let x = Scale::linear([0.0, 90.0], [80.0, 688.0]);
        let mark = |&(at, label): &(f64, &str)| Mark {
            at,
            label: label.into(),
        };
        let marks: Vec<Mark> = marks.iter().map(mark).collect();
        place_labels(&marks, x, 80.0, 688.0)
    }

    fn edges(label: &Label) -> (f64, f64) {
        let half = MARK.widest(&label.lines) / 2.0;
        (label.centre - half, label.centre + half)
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
