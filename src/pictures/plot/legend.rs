//! The legend: a line sample and a name for each curve.

use crate::pictures::plot::layout::Layout;
use crate::pictures::plot::line_chart::Series;
use crate::pictures::plot::palette::Style;
use crate::pictures::plot::text::LEGEND;

/// The length of a line sample: two periods of the longest dash pattern.
const SAMPLE: f64 = 38.0;
const SAMPLE_GAP: f64 = 8.0;
const ENTRY_GAP: f64 = 24.0;

impl Layout {
    /// Sets a line sample and a name for each curve, in as many rows as needed.
    pub fn legend(&mut self, series: &[Series]) {
        let (margin, room) = (self.frame().margin, self.frame().room());
        let (mut left, mut top) = (margin, self.bottom() + 7.0);
        for one in series {
            let lines = LEGEND.wrap(&one.name, room - SAMPLE - SAMPLE_GAP);
            let width = SAMPLE + SAMPLE_GAP + LEGEND.widest(&lines);
            if left > margin && left + width > margin + room {
                (left, top) = (margin, self.bottom());
            }
            let bottom = self.bottom().max(top + LEGEND.height(&lines));
            self.extend(legend_entry(one.style, &lines, left, top), bottom);
            left += width + ENTRY_GAP;
        }
    }
}

fn legend_entry(style: Style, lines: &[String], left: f64, top: f64) -> Vec<String> {
    let sample = format!(
        "<path {} d=\"M{left:.2} {:.2}H{:.2}\"/>",
        style.attributes(),
        top + LEGEND.leading / 2.0,
        left + SAMPLE
    );
    let mut elements = vec![sample];
    elements.extend(style.dot(left + SAMPLE / 2.0, top + LEGEND.leading / 2.0));
    elements.extend(LEGEND.draw(lines, left + SAMPLE + SAMPLE_GAP, top, "start"));
    elements
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::plot::layout::ALONE;

    fn named(name: &str) -> Series {
        Series {
            name: name.into(),
            style: Style::Exact,
            points: vec![],
        }
    }

    #[test]
    fn legend_rows_follow_the_length_of_the_names() {
        let rows = |names: &[&str]| {
            let mut layout = Layout::new(ALONE);
            let start = layout.bottom();
            layout.legend(&names.iter().map(|name| named(name)).collect::<Vec<_>>());
            ((layout.bottom() - start) / LEGEND.leading).floor()
        };
        let (half, long) = ("word ".repeat(12), "word ".repeat(40));
        assert_eq!(rows(&[]), 0.0);
        assert_eq!(rows(&["a", "b", "c"]), 1.0);
        assert_eq!(rows(&[&half, &half, "c"]), 2.0);
        assert_eq!(rows(&["a", &long, "c"]), 5.0);
    }
}
