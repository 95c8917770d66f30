//! A map as a picture: the formula's error on the left, that of its rounding on the right, each with its colour bar.

use crate::report::chart::{Font, PANEL, SUBTITLE, TICK, escape};
use crate::stability::{Cell, Map};

const WIDTH: f64 = 920.0;
const HEIGHT: f64 = 366.0;
/// The plot of a panel.
const PLOT: (f64, f64) = (300.0, 220.0);
const TOP: f64 = 90.0;
/// The left edges of the panels' plots.
const LEFTS: [f64; 2] = [70.0, 540.0];
/// From a plot to its colour bar, and how wide that is.
const BAR: (f64, f64) = (14.0, 14.0);
/// Steps of colour.
const SHADES: usize = 48;
/// Where a result is no reflectance at all.
const BROKEN: &str = "#d7263d";

/// What a panel shows.
struct Panel {
    /// What comes against what.
    title: fn(&str) -> String,
    /// The powers of ten at both ends of the colour bar.
    decades: (i32, i32),
    value: fn(&Cell) -> f64,
}

static PANELS: [Panel; 2] = [
    Panel {
        title: |_| "formula against the law, absolute".to_owned(),
        decades: (-6, 0),
        value: |cell| cell.error,
    },
    Panel {
        title: |precision| format!("{precision} against the formula in f64, ulp"),
        decades: (0, 8),
        value: |cell| cell.digits,
    },
];

/// Perceptually even and safe for the colour-blind: nine points of Matplotlib's viridis (CC0 1.0,
/// <https://bids.github.io/colormap/>).
const VIRIDIS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 45.0, 123.0],
    [59.0, 82.0, 139.0],
    [44.0, 114.0, 142.0],
    [33.0, 145.0, 140.0],
    [40.0, 174.0, 128.0],
    [94.0, 201.0, 98.0],
    [173.0, 220.0, 48.0],
    [253.0, 231.0, 37.0],
];

/// The picture of a map, as SVG.
pub fn heat(method: &str, map: &Map) -> String {
    let mut parts = vec![format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"system-ui, sans-serif\"><title>{}</title><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
        escape(&format!("{method} over angle and {}", map.axis.name))
    )];
    let line = |font: &Font, text: String, top: f64| font.draw(&[text], 24.0, top, "start");
    parts.extend(line(
        &PANEL,
        format!("{method} over angle and {}", map.axis.name),
        14.0,
    ));
    parts.extend(line(
        &SUBTITLE,
        format!(
            "{}; red: not a number, infinite, below 0 or above 1",
            map.held
        ),
        36.0,
    ));
    for (panel, left) in PANELS.iter().zip(LEFTS) {
        parts.extend(panel.draw(map, left));
    }
    parts.push("</svg>\n".to_owned());
    parts.join("\n")
}

impl Panel {
    fn draw(&self, map: &Map, left: f64) -> Vec<String> {
        let middle = left + PLOT.0 / 2.0;
        let mut parts = SUBTITLE.draw(
            &[(self.title)(map.precision.name())],
            middle,
            TOP - 24.0,
            "middle",
        );
        parts.extend(self.cells(map, left));
        parts.push(frame(left, PLOT.0));
        for degree in (0..=90).step_by(15) {
            let x = left + PLOT.0 * column(map, f64::from(degree));
            parts.push(tick(x, TOP + PLOT.1, 0.0, 4.0));
            parts.extend(TICK.draw(&[format!("{degree}°")], x, TOP + PLOT.1 + 5.0, "middle"));
        }
        parts.extend(TICK.draw(
            &["angle of incidence".to_owned()],
            middle,
            TOP + PLOT.1 + 21.0,
            "middle",
        ));
        let (low, high) = ends(map);
        for (value, label) in marks(low, high) {
            let y = TOP + PLOT.1 * (1.0 - row(map, value));
            parts.push(tick(left - 4.0, y, 4.0, 0.0));
            parts.extend(TICK.draw(&[label], left - 7.0, y - TICK.leading / 2.0, "end"));
        }
        parts.extend(TICK.draw_upwards(
            &[map.axis.name.to_owned()],
            left - 60.0,
            TOP + PLOT.1 / 2.0,
        ));
        parts.extend(self.bar(left + PLOT.0 + BAR.0));
        parts
    }

    /// The cells, those of one colour in a row as one rectangle.
    fn cells(&self, map: &Map, left: f64) -> Vec<String> {
        let columns = map.degrees.len();
        let (width, height) = (
            PLOT.0 / columns as f64,
            PLOT.1 / map.axis.values.len() as f64,
        );
        let mut parts = vec!["<g shape-rendering=\"crispEdges\">".to_owned()];
        for (row, cells) in map.cells.chunks(columns).enumerate() {
            let y = TOP + PLOT.1 - height * (row + 1) as f64;
            let mut first = 0;
            while first < columns {
                let colour = self.colour(&cells[first]);
                let same = cells[first..]
                    .iter()
                    .take_while(|cell| self.colour(cell) == colour);
                let count = same.count();
                parts.push(format!(
                    "<rect x=\"{:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{colour}\"/>",
                    left + width * first as f64,
                    width * count as f64,
                    height
                ));
                first += count;
            }
        }
        parts.push("</g>".to_owned());
        parts
    }

    fn colour(&self, cell: &Cell) -> String {
        if cell.is_broken {
            return BROKEN.to_owned();
        }
        let (low, high) = (f64::from(self.decades.0), f64::from(self.decades.1));
        let place = (libm::log10((self.value)(cell).max(1e-300)) - low) / (high - low);
        shade((place.clamp(0.0, 1.0) * (SHADES - 1) as f64).round() as usize)
    }

    fn bar(&self, left: f64) -> Vec<String> {
        let height = PLOT.1 / SHADES as f64;
        let step = |i: usize| {
            let y = TOP + PLOT.1 - height * (i + 1) as f64;
            format!(
                "<rect x=\"{left:.2}\" y=\"{y:.2}\" width=\"{}\" height=\"{:.2}\" fill=\"{}\"/>",
                BAR.1,
                height + 0.3,
                shade(i)
            )
        };
        let mut parts: Vec<String> = (0..SHADES).map(step).collect();
        parts.push(frame(left, BAR.1));
        let (low, high) = self.decades;
        for decade in (low..=high).step_by(if high - low > 6 { 2 } else { 1 }) {
            let y = TOP + PLOT.1 * (1.0 - f64::from(decade - low) / f64::from(high - low));
            parts.push(tick(left + BAR.1, y, 4.0, 0.0));
            parts.extend(TICK.draw(
                &[power(decade)],
                left + BAR.1 + 7.0,
                y - TICK.leading / 2.0,
                "start",
            ));
        }
        parts
    }
}

/// Where an angle lies from left to right, from 0 to 1: in the middle of its column.
fn column(map: &Map, degrees: f64) -> f64 {
    let (first, last) = (map.degrees[0], map.degrees[map.degrees.len() - 1]);
    middle((degrees - first) / (last - first), map.degrees.len())
}

/// Where a value lies from the bottom up, from 0 to 1: in the middle of its row.
fn row(map: &Map, value: f64) -> f64 {
    let (low, high) = ends(map);
    middle(
        libm::log(value / low) / libm::log(high / low),
        map.axis.values.len(),
    )
}

/// Of so many cells side by side, the middle of the first lies at 0 of the way and that of the last at 1.
fn middle(share: f64, cells: usize) -> f64 {
    (share * (cells - 1) as f64 + 0.5) / cells as f64
}

fn ends(map: &Map) -> (f64, f64) {
    let values = &map.axis.values;
    (values[0], values[values.len() - 1])
}

/// Where a logarithmic axis is labelled: six times a decade, or once where there are many.
fn marks(low: f64, high: f64) -> Vec<(f64, String)> {
    let decades = libm::floor(libm::log10(low)) as i32..=libm::ceil(libm::log10(high)) as i32;
    let is_long = high / low > 1e4;
    let digits: &[f64] = if is_long {
        &[1.0]
    } else {
        &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0]
    };
    let mark = |decade: i32| {
        digits.iter().map(move |digit| {
            let value = digit * libm::exp10(f64::from(decade));
            (
                value,
                if is_long {
                    power(decade)
                } else {
                    format!("{}", value as f32)
                },
            )
        })
    };
    let inside = |(value, _): &(f64, String)| (low * 0.999..=high * 1.001).contains(value);
    decades.flat_map(mark).filter(inside).collect()
}

/// A power of ten as people read it.
fn power(decade: i32) -> String {
    match decade {
        -2..=3 => format!("{}", libm::exp10(f64::from(decade)) as f32),
        _ => format!("1e{decade}"),
    }
}

fn shade(step: usize) -> String {
    let place = step as f64 / (SHADES - 1) as f64 * (VIRIDIS.len() - 1) as f64;
    let at = (place as usize).min(VIRIDIS.len() - 2);
    let share = place - at as f64;
    let channel =
        |i: usize| (VIRIDIS[at][i] + share * (VIRIDIS[at + 1][i] - VIRIDIS[at][i])).round() as u8;
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

fn frame(left: f64, width: f64) -> String {
    format!(
        "<rect x=\"{left:.2}\" y=\"{TOP}\" width=\"{width}\" height=\"{}\" fill=\"none\" stroke=\"#7d8794\"/>",
        PLOT.1
    )
}

fn tick(x: f64, y: f64, right: f64, down: f64) -> String {
    format!("<path stroke=\"#7d8794\" d=\"M{x:.2} {y:.2}l{right} {down}\"/>")
}
