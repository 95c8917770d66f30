//! The chart as a self-contained SVG: both axes in powers of ten.

use crate::report::chart::{AXIS, FOOT, Font, Frame, SUBTITLE, Sheet, TICK, TITLE};

use super::labels::{Area, DOT, Place, places};
use super::{ERRORS, Entry, Point, View, capital, drawn};

/// The size of the picture.
const FRAME: Frame = Frame {
    width: 860.0,
    height: 600.0,
    margin: 24.0,
    upper: 20.0,
    lower: 18.0,
};
/// Room for the labels of the vertical axis and for its name.
const LEFT: f64 = 84.0;
/// Room for the same below.
const BELOW: f64 = 62.0;
/// Room for the foot.
const FOOT_ROOM: f64 = 34.0;
/// How much wider than the points the axes are.
const SLACK: f64 = 1.25;

/// Colours by Okabe and Ito, which colour-blind readers can tell apart.
const OURS: &str = "#0072b2";
const THEIRS: &str = "#d55e00";
const YOURS: &str = "#009e73";
const INK: &str = "#17202b";
const GRID: &str = "#e4e8ed";
const EDGE: &str = "#7d8794";

/// An axis in powers of ten, on the page.
#[derive(Clone, Copy)]
struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    fn of(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Scale {
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        Scale {
            low: libm::log10(low / SLACK),
            high: libm::log10(high * SLACK),
            from,
            to,
        }
    }

    fn at(&self, value: f64) -> f64 {
        let share = (libm::log10(value) - self.low) / (self.high - self.low);
        self.from + share * (self.to - self.from)
    }

    /// 1, 2 and 5 times the powers of ten on the axis; powers alone where those are many.
    fn ticks(&self) -> Vec<f64> {
        let powers = libm::floor(self.low) as i32..=libm::ceil(self.high) as i32;
        let steps: &[f64] = if self.high - self.low > 2.5 {
            &[1.0]
        } else {
            &[1.0, 2.0, 5.0]
        };
        let all = powers.flat_map(|power| {
            steps
                .iter()
                .map(move |step| step * libm::exp10(f64::from(power)))
        });
        let holds = |value: &f64| (self.low..=self.high).contains(&libm::log10(*value));
        all.filter(holds).collect()
    }
}

/// The picture of a view; none where nothing of it is known.
pub fn svg(view: &View) -> Option<String> {
    let points = view.points();
    if points.is_empty() {
        return None;
    }
    let mut sheet = Sheet::new(FRAME);
    sheet.paragraph(&TITLE, &view.title());
    let key = key(view);
    sheet.paragraph(&SUBTITLE, &key);
    let top = sheet.bottom() + 12.0;
    let bottom = FRAME.height - BELOW - FOOT_ROOM;
    let (left, right) = (FRAME.margin + LEFT - 30.0, FRAME.right() - 8.0);
    let x = Scale::of(points.iter().map(|point| point.cost), left, right);
    let y = Scale::of(points.iter().map(|point| drawn(point.error)), bottom, top);
    let page = Area([left, top, right, bottom]);
    let mut elements = grid(&x, &y, page);
    elements.extend(names(view, page));
    elements.push(staircase(&points, &x, &y, page));
    elements.extend(pairs(&points, &x, &y));
    // A full dot lies over its hollow one where they are the same, and a user's over all.
    let mut layers: Vec<&Point> = points.iter().collect();
    layers.sort_by_key(|point| (point.entry.user().is_some(), !point.entry.is_best));
    elements.extend(layers.into_iter().map(|point| dot(point, &x, &y)));
    elements.extend(labels(&points, &x, &y, page));
    sheet.extend(elements, bottom + BELOW - 8.0);
    sheet.paragraph(&FOOT, &format!("fresnel-gen {}", view.data.command));
    Some(sheet.document(&view.title(), &key))
}

const KEY: &str = "Blue: fitted here. Orange: published; full with the inputs that its authors meant, hollow (*) with those whose \
largest error is least. Square: reads a texture, whose fetch no count holds. The line: nothing is cheaper and as near; what fails inside its domain has no part in it.";

/// The key, with what is said of a user's function.
fn key(view: &View) -> String {
    let user = view.data.entries.iter().find_map(Entry::user);
    let own = user.map(|user| match view.lacks() {
        None => format!(" Green diamond: {}, your own.", user.name),
        Some(lacks) => format!(" {lacks}"),
    });
    format!("{KEY}{}", own.unwrap_or_default())
}

fn grid(x: &Scale, y: &Scale, Area([left, top, right, bottom]): Area) -> Vec<String> {
    let mut lines = String::new();
    let mut elements = Vec::new();
    for tick in x.ticks() {
        let at = x.at(tick);
        lines += &format!("M{at:.2} {top:.2}V{bottom:.2}");
        elements.extend(TICK.draw(&[power(tick)], at, bottom + 5.0, "middle"));
    }
    for tick in y.ticks() {
        let at = y.at(tick);
        lines += &format!("M{left:.2} {at:.2}H{right:.2}");
        elements.extend(TICK.draw(&[power(tick)], left - 7.0, at - TICK.leading / 2.0, "end"));
    }
    let axes = format!("M{left:.2} {top:.2}V{bottom:.2}H{right:.2}");
    let path =
        |stroke: &str, d: &str| format!("<path fill=\"none\" stroke=\"{stroke}\" d=\"{d}\"/>");
    [path(GRID, &lines), path(EDGE, &axes)]
        .into_iter()
        .chain(elements)
        .collect()
}

/// A tick's number, without needless digits.
fn power(value: f64) -> String {
    let digits = (-libm::floor(libm::log10(value * 1.000_001))).max(0.0) as usize;
    format!("{value:.digits$}")
}

/// The names of the axes.
fn names(view: &View, Area([left, top, right, bottom]): Area) -> Vec<String> {
    let under = AXIS.wrap(&format!("Cost: {}", view.cost.title), right - left);
    let mut elements = AXIS.draw(&under, (left + right) / 2.0, bottom + 24.0, "middle");
    let error = capital(ERRORS[view.error].short);
    let beside = AXIS.wrap(&error, bottom - top);
    elements.extend(AXIS.draw_upwards(&beside, FRAME.margin - 8.0, (top + bottom) / 2.0));
    elements
}

/// The frontier, as the least error that a cost buys.
fn staircase(points: &[Point], x: &Scale, y: &Scale, Area([_, top, right, _]): Area) -> String {
    let best = points.iter().filter(|point| point.is_on_frontier);
    let mut line = String::new();
    for point in best {
        let (across, down) = (x.at(point.cost), y.at(drawn(point.error)));
        line += &if line.is_empty() {
            format!("M{across:.2} {top:.2}V{down:.2}")
        } else {
            format!("H{across:.2}V{down:.2}")
        };
    }
    format!(
        "<path fill=\"none\" stroke=\"{OURS}\" stroke-opacity=\"0.55\" stroke-width=\"2\" d=\"{line}H{right:.2}\"/>"
    )
}

/// A line from each method with its intended inputs to itself with its best ones.
fn pairs(points: &[Point], x: &Scale, y: &Scale) -> Vec<String> {
    let best = points.iter().filter(|point| point.entry.is_best);
    let line = |best: &Point| {
        let is_same = |point: &&Point| {
            point.entry.inputs() == "intended" && point.entry.name() == best.entry.name()
        };
        let intended = points.iter().find(is_same)?;
        let (across, from, to) = (
            x.at(best.cost),
            y.at(drawn(intended.error)),
            y.at(drawn(best.error)),
        );
        Some(format!(
            "<path stroke=\"{THEIRS}\" stroke-opacity=\"0.5\" d=\"M{across:.2} {from:.2}V{to:.2}\"/>"
        ))
    };
    best.filter_map(line).collect()
}

fn dot(point: &Point, x: &Scale, y: &Scale) -> String {
    let (x, y) = (x.at(point.cost), y.at(drawn(point.error)));
    if point.entry.user().is_some() {
        return diamond(x, y);
    }
    let colour = if point.entry.is_fitted() {
        OURS
    } else {
        THEIRS
    };
    let fill = if point.entry.is_best {
        "#ffffff"
    } else {
        colour
    };
    let look = format!("fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.6\"");
    if point.entry.fetches > 0 {
        let size = 2.0 * DOT - 1.6;
        let (left, top) = (x - size / 2.0, y - size / 2.0);
        return format!(
            "<rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{size}\" height=\"{size}\" {look}/>"
        );
    }
    format!(
        "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.1}\" {look}/>",
        DOT - 0.8
    )
}

/// The mark of a user's function.
fn diamond(x: f64, y: f64) -> String {
    let half = DOT + 1.5;
    format!(
        "<path fill=\"{YOURS}\" stroke=\"{YOURS}\" stroke-width=\"1.6\" d=\"M{:.2} {y:.2}L{x:.2} {:.2}L{:.2} {y:.2}L{x:.2} {:.2}Z\"/>",
        x - half,
        y - half,
        x + half,
        y + half
    )
}

/// Names of points, a user's first, then those of the frontier. A method at its best, on a line with itself, has one only there.
fn labels(points: &[Point], x: &Scale, y: &Scale, page: Area) -> Vec<String> {
    const FONT: &Font = &TICK;
    let has_name = |point: &&Point| point.is_on_frontier || !point.entry.is_best;
    let mut order: Vec<&Point> = points.iter().filter(has_name).collect();
    order.sort_by_key(|point| {
        let entry = point.entry;
        (entry.user().is_none(), !point.is_on_frontier, entry.is_best)
    });
    let all: Vec<(f64, f64)> = points
        .iter()
        .map(|point| (x.at(point.cost), y.at(drawn(point.error))))
        .collect();
    let at: Vec<(f64, f64)> = order
        .iter()
        .map(|point| (x.at(point.cost), y.at(drawn(point.error))))
        .collect();
    let texts: Vec<String> = order.iter().map(|point| point.entry.label()).collect();
    let widths: Vec<f64> = texts.iter().map(|text| FONT.width(text)).collect();
    let found = places(&at, &widths, FONT.leading - 3.0, &all, page);
    let draw = |(i, place): (usize, Option<Place>)| {
        let place = place?;
        let line = place.is_led.then(|| led(at[i], &place, widths[i]));
        let top = place.middle - FONT.leading / 2.0;
        let text = FONT.draw_with_rim(&texts[i..=i], place.left, top, "start");
        Some(line.into_iter().chain(text).collect::<Vec<String>>())
    };
    let drawn = found.into_iter().enumerate().filter_map(draw);
    drawn.flatten().collect()
}

/// A thin line from a point to its name.
fn led((x, y): (f64, f64), place: &Place, width: f64) -> String {
    let nearest = x.clamp(place.left, place.left + width);
    format!(
        "<path stroke=\"{INK}\" stroke-opacity=\"0.3\" stroke-width=\"1\" d=\"M{x:.2} {y:.2}L{nearest:.2} {:.2}\"/>",
        place.middle
    )
}
