//! The plot itself: grid, guide lines, curves and axis labels.

use super::sheet::{Frame, paragraph_height};
use super::text::{AXIS, FOOT, MARK, TICK};
use super::{Axis, Chart, Mark, Series, Style};

/// The least height of the plot; the sheet grows rather than go below it.
const LEAST_HEIGHT: f64 = 210.0;
/// From the end of the plot to the margin: half of the last tick's label.
const RIGHT_GAP: f64 = 8.0;
const TICK_GAP: f64 = 7.0;
/// The height in which the line from a label slants to its place.
const SLANT: f64 = 11.0;
const LABEL_GAP: f64 = 10.0;
/// Half of the widest line, so that a curve along the edge stays whole.
const EDGE: f64 = 1.5;

/// The area of the plot, and the text around it broken into lines.
pub(super) struct Plot<'a> {
    chart: &'a Chart,
    frame: Frame,
    /// The name of the clip path, of which a document may hold several.
    clip: &'a str,
    labels: Vec<Label>,
    x_label: Vec<String>,
    y_label: Vec<String>,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// The label of a guide line: `at` is where it points, `centre` where it is.
struct Label {
    lines: Vec<String>,
    at: f64,
    centre: f64,
}

impl<'a> Plot<'a> {
    /// Lays out the plot from `head` down, leaving room for the foot.
    pub(super) fn below(chart: &'a Chart, frame: Frame, clip: &'a str, head: f64) -> Plot<'a> {
        let y_label = AXIS.wrap(&chart.y.label, LEAST_HEIGHT + 20.0);
        let left = frame.margin + left_of_plot(&chart.y, AXIS.height(&y_label));
        let right = frame.right() - RIGHT_GAP;
        let x_label = AXIS.wrap(&chart.x.label, right - left);
        let labels = place_labels(&chart.marks, &chart.x, left, right);
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
            left,
            right,
            top,
            bottom,
        }
    }

    /// The lower edge of everything that belongs to the plot.
    pub(super) fn end(&self) -> f64 {
        self.bottom + height_below(&self.x_label)
    }

    /// All elements, from the back to the front.
    pub(super) fn draw(&self) -> Vec<String> {
        let parts = [
            self.grid(),
            self.tick_labels(),
            self.axis_labels(),
            self.guides(),
            self.curves(),
        ];
        parts.concat()
    }

    fn grid(&self) -> Vec<String> {
        let (left, right, top, bottom) = (self.left, self.right, self.top, self.bottom);
        let mut lines = String::new();
        for (tick, _) in self.chart.x.labelled_ticks() {
            lines += &format!("M{:.2} {top:.2}V{bottom:.2}", self.x(tick));
        }
        for (tick, _) in self.chart.y.labelled_ticks() {
            lines += &format!("M{left:.2} {:.2}H{right:.2}", self.y(tick));
        }
        let axes = format!("M{left:.2} {top:.2}V{bottom:.2}H{right:.2}");
        vec![
            format!("<path fill=\"none\" stroke=\"#e4e8ed\" d=\"{lines}\"/>"),
            format!("<path fill=\"none\" stroke=\"#7d8794\" d=\"{axes}\"/>"),
        ]
    }

    fn tick_labels(&self) -> Vec<String> {
        let mut elements = Vec::new();
        for (tick, label) in self.chart.x.labelled_ticks() {
            let top = self.bottom + TICK_GAP - 2.0;
            elements.extend(TICK.draw(&[label], self.x(tick), top, "middle"));
        }
        for (tick, label) in self.chart.y.labelled_ticks() {
            let top = self.y(tick) - TICK.leading / 2.0;
            elements.extend(TICK.draw(&[label], self.left - TICK_GAP, top, "end"));
        }
        elements
    }

    fn axis_labels(&self) -> Vec<String> {
        let (across, up) = (
            (self.left + self.right) / 2.0,
            (self.top + self.bottom) / 2.0,
        );
        let top = self.bottom + TICK_GAP + TICK.leading;
        let mut elements = AXIS.draw(&self.x_label, across, top, "middle");
        elements.extend(AXIS.draw_upwards(&self.y_label, self.frame.margin - 4.0, up));
        elements
    }

    fn guides(&self) -> Vec<String> {
        let lines_end = self.top - SLANT;
        let mut elements = Vec::new();
        for label in &self.labels {
            elements.push(format!(
                "<path fill=\"none\" stroke=\"#8b95a3\" \
                 d=\"M{:.2} {lines_end:.2}L{:.2} {:.2}V{:.2}\"/>",
                label.centre, label.at, self.top, self.bottom
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
        format!(
            "<clipPath id=\"{}\"><rect x=\"{:.2}\" y=\"{:.2}\" \
             width=\"{:.2}\" height=\"{:.2}\"/></clipPath>",
            self.clip,
            self.left - EDGE,
            self.top - EDGE,
            self.right - self.left + 2.0 * EDGE,
            self.bottom - self.top + 2.0 * EDGE
        )
    }

    fn curve(&self, series: &Series) -> String {
        let mut data = String::new();
        let mut joined = false;
        for &(x, y) in &series.points {
            let finite = x.is_finite() && y.is_finite();
            if finite {
                let command = if joined { 'L' } else { 'M' };
                data += &format!("{command}{:.2} {:.2}", self.x(x), self.y(y));
            }
            joined = finite;
        }
        format!("<path {} d=\"{data}\"/>", series.style.attributes())
    }

    /// The dots of a curve, where its style has any: whole ones, on both axes.
    fn dots(&self, series: &Series) -> Vec<String> {
        let (x, y) = (&self.chart.x, &self.chart.y);
        let points = series.points.iter();
        let inside = points.filter(|point| x.holds(point.0) && y.holds(point.1));
        inside
            .filter_map(|point| series.style.dot(self.x(point.0), self.y(point.1)))
            .collect()
    }

    fn x(&self, value: f64) -> f64 {
        along(self.left, self.right, self.chart.x.fraction(value))
    }

    fn y(&self, value: f64) -> f64 {
        along(self.bottom, self.top, self.chart.y.fraction(value))
    }
}

/// A coordinate, held near the sheet since viewers fail on huge numbers.
fn along(start: f64, end: f64, fraction: f64) -> f64 {
    (start + (end - start) * fraction).clamp(-9999.0, 9999.0)
}

/// The room that an axis and its labels take on the left.
fn left_of_plot(axis: &Axis, label_width: f64) -> f64 {
    let ticks: Vec<String> = axis
        .labelled_ticks()
        .into_iter()
        .map(|(_, label)| label)
        .collect();
    label_width + TICK.widest(&ticks) + TICK_GAP
}

fn height_below(x_label: &[String]) -> f64 {
    TICK_GAP + TICK.leading + AXIS.height(x_label) + 8.0
}

fn labels_height(labels: &[Label]) -> f64 {
    let heights = labels.iter().map(|label| MARK.height(&label.lines) + SLANT);
    heights.fold(0.0, f64::max)
}

/// The labels of the guide lines in one row, in order and clear of each other.
fn place_labels(marks: &[Mark], axis: &Axis, left: f64, right: f64) -> Vec<Label> {
    let shown = marks.iter().filter(|mark| axis.holds(mark.at));
    let mut shown: Vec<&Mark> = shown.collect();
    shown.sort_by(|one, other| axis.fraction(one.at).total_cmp(&axis.fraction(other.at)));
    // With no more than an equal share each, the labels fit side by side.
    let share = (right - left) / shown.len().max(1) as f64 - LABEL_GAP;
    let label = |mark: &Mark| {
        let at = along(left, right, axis.fraction(mark.at));
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
        let axis = Axis {
            label: "Angle".into(),
            low: 0.0,
            high: 90.0,
            ticks: vec![],
            unit: "°",
        };
        let mark = |&(at, label): &(f64, &str)| Mark {
            at,
            label: label.into(),
        };
        let marks: Vec<Mark> = marks.iter().map(mark).collect();
        place_labels(&marks, &axis, 80.0, 688.0)
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

    #[test]
    fn coordinates_stay_near_the_sheet() {
        assert_eq!(along(10.0, 20.0, 0.5), 15.0);
        assert_eq!(along(10.0, 20.0, 1e300), 9999.0);
        assert_eq!(along(20.0, 10.0, f64::INFINITY), -9999.0);
    }
}
