//! Error against cost, as a picture and as a page. The data stand in the room `chart` of the lab.
//!
//! The picture is self-contained SVG, with both axes in powers of ten. Names beside points are placed so that none overlaps another
//! or a point.
//!
//! The page has all charts, and a reader chooses the set, the axes and what is shown. It is self-contained, for any browser.

use serde::Serialize;
use tera::Context;

use crate::generator::fit::MethodErrors;
use crate::lab::chart::{
    ChartData, ChartEntry, ChartPoint, ChartView, CostAxis, ERRORS, FunctionOrigin, LEAST_ERROR,
    drawn, without_point,
};
use crate::pictures::html;
use crate::pictures::plot::{
    AXIS, Area, Axes, BLUE, FOOT, Font, GREEN, INK, Layout, PURPLE, PanelFrame, SUBTITLE, Scale,
    TICK, TITLE, Tick, VERMILION, capital, labelled, log_ticks, plain_label,
};

/// The size of the picture.
const FRAME: PanelFrame = PanelFrame {
    width: 860.0,
    height: 600.0,
    margin: 24.0,
    upper: 20.0,
    lower: 18.0,
};
/// Room for the labels of the vertical axis and for its name.
const LEFT: f64 = 84.0;
/// Room for the labels and the name of the horizontal axis.
const BELOW: f64 = 62.0;
/// Room for the foot.
const FOOT_ROOM: f64 = 34.0;
/// The factor by which the axes are wider than the points.
const SLACK: f64 = 1.25;

const FITTED: &str = BLUE;
/// Forms of ours that take F0 and F82, or n and k.
const PROPOSED: &str = PURPLE;
const THEIRS: &str = VERMILION;
const YOURS: &str = GREEN;

/// A chart's axes and their ticks.
struct Plane {
    axes: Axes,
    x: Vec<Tick>,
    y: Vec<Tick>,
}

impl Plane {
    /// The axes around these points, in powers of ten.
    fn new(points: &[ChartPoint], area: Area) -> Plane {
        let costs = ends(points.iter().map(|point| point.cost));
        let errors = ends(points.iter().map(|point| drawn(point.error)));
        Plane {
            axes: Axes {
                area,
                x: Scale::log(costs, [area.left, area.right]),
                y: Scale::log(errors, [area.bottom, area.top]),
            },
            x: power_ticks(costs),
            y: power_ticks(errors),
        }
    }

    /// The position of a point.
    fn at(&self, point: &ChartPoint) -> (f64, f64) {
        let Axes { x, y, .. } = self.axes;
        (x.at(point.cost), y.at(drawn(point.error)))
    }
}

/// The ends of an axis that holds these values with some room.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    [low / SLACK, high * SLACK]
}

/// 1, 2 and 5 times the powers of ten on the axis; powers alone where those are many.
fn power_ticks([low, high]: [f64; 2]) -> Vec<Tick> {
    let is_long = libm::log10(high) - libm::log10(low) > 2.5;
    let multiples: &[f64] = if is_long { &[1.0] } else { &[1.0, 2.0, 5.0] };
    labelled(log_ticks(low, high, multiples), plain_label)
}

/// The picture of a view; `None` where it has no known points.
pub fn chart_svg(view: &ChartView) -> Option<String> {
    let points = view.points();
    if points.is_empty() {
        return None;
    }
    let mut layout = Layout::new(FRAME);
    let title = capital(&view.title());
    layout.paragraph(&TITLE, &title);
    let key = key(view);
    layout.paragraph(&SUBTITLE, &key);
    let bottom = FRAME.height - BELOW - FOOT_ROOM;
    let across = [FRAME.margin + LEFT - 30.0, FRAME.right() - 8.0];
    let area = Area::between(across, [layout.bottom + 12.0, bottom]);
    let plane = Plane::new(&points, area);
    let mut elements = plane.axes.grid(&plane.x, &plane.y);
    elements.extend(plane.axes.tick_labels(&plane.x, &plane.y));
    elements.extend(titles(view, &plane.axes));
    let (corners, pairs) = (staircase(&points, &plane), pairs(&points, &plane));
    elements.push(staircase_path(&corners));
    elements.extend(pairs.iter().map(|(line, colour)| pair_path(line, colour)));
    // A full dot lies over a hollow one at the same place, and a user's dot over all.
    let mut layers: Vec<&ChartPoint> = points.iter().collect();
    layers.sort_by_key(|point| (point.entry.user().is_some(), !point.entry.is_best));
    elements.extend(layers.into_iter().map(|point| dot(point, &plane)));
    let steps = corners.windows(2).map(|ends| [ends[0], ends[1]]);
    let lines: Vec<[(f64, f64); 2]> = steps
        .chain(pairs.into_iter().map(|(line, _)| line))
        .collect();
    elements.extend(labels(&points, &lines, &plane));
    layout.extend(elements, bottom + BELOW - 8.0);
    layout.paragraph(&FOOT, &format!("fresnel-gen {}", view.data.command));
    Some(layout.document(&title, &key))
}

const KEY: &str = "Blue: fitted here. Purple: proposed here, from F0 and F82. Orange: published. Full: with the inputs that it is meant to have; hollow (*): with those whose \
largest error is least. Square: reads a texture; its cost excludes the fetch. The line: of functions that read no texture none is both cheaper and as accurate; those that fail inside their domain are left out of it.";

/// The key, with a sentence on a user's function and on what is left out.
fn key(view: &ChartView) -> String {
    let user = view.data.entries.iter().find_map(ChartEntry::user);
    let own = user.map(|user| match view.lacks() {
        None => format!(" Green diamond: {}, your own.", user.name),
        Some(lacks) => format!(" {lacks}"),
    });
    let without = without_point(view);
    let head = if without.is_empty() { "" } else { " Left out:" };
    let without: String = without.iter().map(|line| format!(" {line}")).collect();
    format!("{KEY}{}{head}{without}", own.unwrap_or_default())
}

/// The titles of the axes.
fn titles(view: &ChartView, axes: &Axes) -> Vec<String> {
    let area = &axes.area;
    let cost = format!("Cost: {}", view.cost.title);
    let under = AXIS.wrap(&cost, area.right - area.left);
    let error = capital(ERRORS[view.error].short);
    let beside = AXIS.wrap(&error, area.bottom - area.top);
    axes.titles(&under, 24.0, &beside, FRAME.margin - 8.0)
}

/// The corners of the frontier, a staircase of the least error at each cost, from the top to the right edge.
fn staircase(points: &[ChartPoint], plane: &Plane) -> Vec<(f64, f64)> {
    let Area { top, right, .. } = plane.axes.area;
    let best = points.iter().filter(|point| point.is_on_frontier);
    let mut corners = Vec::new();
    for point in best {
        let (across, down) = plane.at(point);
        let above = corners.last().map_or(top, |(_, above)| *above);
        corners.extend([(across, above), (across, down)]);
    }
    corners.extend(corners.last().map(|(_, down)| (right, *down)));
    corners
}

fn staircase_path(corners: &[(f64, f64)]) -> String {
    let mut line = String::new();
    for (place, (across, down)) in corners.iter().enumerate() {
        line += &match place {
            0 => format!("M{across:.2} {down:.2}"),
            place if place % 2 == 1 => format!("V{down:.2}"),
            _ => format!("H{across:.2}"),
        };
    }
    format!(
        "<path fill=\"none\" stroke=\"{FITTED}\" stroke-opacity=\"0.55\" stroke-width=\"2\" d=\"{line}\"/>"
    )
}

/// A line for each method, from its point with intended inputs to its point with the best inputs, and its colour.
fn pairs(points: &[ChartPoint], plane: &Plane) -> Vec<([(f64, f64); 2], &'static str)> {
    let best = points.iter().filter(|point| point.entry.is_best);
    let line = |best: &ChartPoint| {
        let is_same = |point: &&ChartPoint| {
            point.entry.inputs() == "intended" && point.entry.name() == best.entry.name()
        };
        let intended = points.iter().find(is_same)?;
        Some(([plane.at(intended), plane.at(best)], colour(best)))
    };
    best.filter_map(line).collect()
}

fn pair_path([from, to]: &[(f64, f64); 2], colour: &str) -> String {
    format!(
        "<path stroke=\"{colour}\" stroke-opacity=\"0.5\" d=\"M{:.2} {:.2}V{:.2}\"/>",
        to.0, from.1, to.1
    )
}

fn colour(point: &ChartPoint) -> &'static str {
    match point.entry {
        entry if !entry.is_ours() => THEIRS,
        entry if entry.is_fitted() => FITTED,
        _ => PROPOSED,
    }
}

fn dot(point: &ChartPoint, plane: &Plane) -> String {
    let (x, y) = plane.at(point);
    if point.entry.user().is_some() {
        return diamond(x, y);
    }
    let colour = colour(point);
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

/// Names of points: a user's first, then those of the frontier. A method's point with its best inputs has a
/// name only on the frontier, where there is room.
fn labels(points: &[ChartPoint], lines: &[[(f64, f64); 2]], plane: &Plane) -> Vec<String> {
    const FONT: &Font = &TICK;
    let has_name = |point: &&ChartPoint| point.is_on_frontier || !point.entry.is_best;
    let mut order: Vec<&ChartPoint> = points.iter().filter(has_name).collect();
    order.sort_by_key(|point| {
        let entry = point.entry;
        (entry.user().is_none(), entry.is_best, !point.is_on_frontier)
    });
    let all: Vec<(f64, f64)> = points.iter().map(|point| plane.at(point)).collect();
    let names: Vec<((f64, f64), String)> = order
        .iter()
        .map(|point| (plane.at(point), point.entry.label()))
        .collect();
    let sized: Vec<((f64, f64), f64)> = names
        .iter()
        .map(|(at, text)| (*at, FONT.width(text)))
        .collect();
    let page = Area {
        right: FRAME.width - 6.0,
        ..plane.axes.area
    };
    let places = place_all(&sized, FONT.leading - 3.0, &all, lines, page);
    let mut elements = Vec::new();
    for ((at, text), place) in names.iter().zip(places) {
        let Some(place) = place else { continue };
        if place.is_led {
            elements.push(led(place.leader(*at)));
        }
        let top = place.middle - FONT.leading / 2.0;
        elements.extend(FONT.draw_with_rim(text, place.left, top, "start"));
    }
    elements
}

/// A thin line from a point to its name.
fn led([(x, y), (to_x, to_y)]: [(f64, f64); 2]) -> String {
    format!(
        "<path stroke=\"{INK}\" stroke-opacity=\"0.45\" stroke-width=\"1\" d=\"M{x:.2} {y:.2}L{to_x:.2} {to_y:.2}\"/>"
    )
}

/// A name's place, and whether it is so far from its point that a line leads to it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LabelPlace {
    /// The left end.
    left: f64,
    /// The middle of its height.
    middle: f64,
    /// What the name covers.
    area: Area,
    is_led: bool,
}

impl LabelPlace {
    /// The line from its point to the nearest place of the name.
    fn leader(&self, (x, y): (f64, f64)) -> [(f64, f64); 2] {
        let Area {
            left,
            right,
            top,
            bottom,
        } = self.area;
        [(x, y), (x.clamp(left, right), y.clamp(top, bottom))]
    }
}

/// Whether a line runs through an area.
fn runs_through([from, to]: [(f64, f64); 2], area: &Area) -> bool {
    const STEPS: u32 = 200;
    (0..=STEPS).any(|step| {
        let share = f64::from(step) / f64::from(STEPS);
        let x = from.0 + share * (to.0 - from.0);
        let y = from.1 + share * (to.1 - from.1);
        x > area.left && x < area.right && y > area.top && y < area.bottom
    })
}

/// Half the width of a point.
const DOT: f64 = 4.5;
/// The gap between a line and a name.
const LINE: f64 = 1.5;
/// The gap between a point and its name.
const GAP: f64 = 3.0;

/// The area with these half sizes around a point.
fn around((x, y): (f64, f64), half_width: f64, half_height: f64) -> Area {
    let across = [x - half_width, x + half_width];
    Area::between(across, [y - half_height, y + half_height])
}

/// Places as [`place_names`] finds them, with names that found none put first, where that leaves fewer without a place.
fn place_all(
    names: &[((f64, f64), f64)],
    height: f64,
    all: &[(f64, f64)],
    lines: &[[(f64, f64); 2]],
    page: Area,
) -> Vec<Option<LabelPlace>> {
    let without = |places: &[Option<LabelPlace>]| places.iter().filter(|one| one.is_none()).count();
    let mut order: Vec<usize> = (0..names.len()).collect();
    let mut last = place_names(names, height, all, lines, page);
    let mut best = last.clone();
    for _ in names {
        let Some(missing) = last.iter().position(Option::is_none) else {
            break;
        };
        order.retain(|place| *place != missing);
        order.insert(0, missing);
        let sorted: Vec<((f64, f64), f64)> = order.iter().map(|place| names[*place]).collect();
        let found = place_names(&sorted, height, all, lines, page);
        for (place, found) in order.iter().zip(found) {
            last[*place] = found;
        }
        if without(&last) < without(&best) {
            best.clone_from(&last);
        }
    }
    best
}

/// A place for the name of each of these points, by its width and the height of all, in order, so that no name covers any of all
/// points and no line of the chart, nor one to another name, crosses a name. Lines of the chart run across or down. A line to a name
/// passes no other point where there is such a place. `None` where there is no room.
fn place_names(
    names: &[((f64, f64), f64)],
    height: f64,
    all: &[(f64, f64)],
    lines: &[[(f64, f64); 2]],
    page: Area,
) -> Vec<Option<LabelPlace>> {
    let mut taken: Vec<Area> = all.iter().map(|point| around(*point, DOT, DOT)).collect();
    taken.extend(lines.iter().map(|[from, to]| {
        let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
        let half = |a: f64, b: f64| (a - b).abs() / 2.0 + LINE;
        around(middle, half(from.0, to.0), half(from.1, to.1))
    }));
    let (mut set, mut leaders): (Vec<Area>, Vec<[(f64, f64); 2]>) = (Vec::new(), Vec::new());
    let mut places = Vec::new();
    for (point, width) in names {
        let others = all.iter().filter(|other| *other != point);
        let others: Vec<Area> = others.map(|other| around(*other, DOT, DOT)).collect();
        let is_free = |place: &LabelPlace| {
            let area = &place.area;
            let leader = place.leader(*point);
            area.lies_in(&page)
                && !taken.iter().any(|other| area.meets(other))
                && !leaders.iter().any(|line| runs_through(*line, area))
                && !set.iter().any(|name| runs_through(leader, name))
        };
        let passes_none = |place: &LabelPlace| {
            let leader = place.leader(*point);
            !others.iter().any(|other| runs_through(leader, other))
        };
        let free: Vec<LabelPlace> = candidates(*point, *width, height)
            .into_iter()
            .filter(is_free)
            .collect();
        let place = free
            .iter()
            .find(|place| passes_none(place))
            .or(free.first());
        if let Some(place) = place {
            taken.push(place.area);
            set.push(place.area);
            leaders.extend(place.is_led.then(|| place.leader(*point)));
        }
        places.push(place.copied());
    }
    places
}

/// The area of a name, from its left end and the middle of its height.
fn beside(left: f64, middle: f64, width: f64, height: f64) -> Area {
    around((left + width / 2.0, middle), width / 2.0, height / 2.0)
}

/// The candidates for a place: right, left, above and below, then all around, the nearest first.
fn candidates((x, y): (f64, f64), width: f64, height: f64) -> Vec<LabelPlace> {
    let near = DOT + GAP;
    let place = |dx: f64, dy: f64, is_led: bool| {
        let (left, middle) = (x + dx, y + dy);
        LabelPlace {
            left,
            middle,
            area: beside(left, middle, width, height),
            is_led,
        }
    };
    let half = height / 2.0;
    let sides = [
        (near, 0.0),
        (-near - width, 0.0),
        (-width / 2.0, -near - half),
        (-width / 2.0, near + half),
        (near, -height),
        (near, height),
        (-near - width, -height),
        (-near - width, height),
    ];
    // Steps of a few units, as far as an eye follows a line.
    let rows = (-12..=12).map(|row| 9.0 * f64::from(row));
    let columns = || (-8..=8).map(|column| near + 12.0 * f64::from(column));
    let around = rows.flat_map(|dy| {
        let right = columns().map(move |dx| (dx, dy));
        let left = columns().map(move |dx| (-dx - width, dy));
        right.chain(left)
    });
    let mut led: Vec<LabelPlace> = around.map(|(dx, dy)| place(dx, dy, true)).collect();
    led.sort_by(|one, other| {
        let length = |place: &LabelPlace| {
            let [from, to] = place.leader((x, y));
            libm::hypot(to.0 - from.0, to.1 - from.1)
        };
        length(one).total_cmp(&length(other))
    });
    let beside = sides.map(|(dx, dy)| place(dx, dy, false));
    beside.into_iter().chain(led).collect()
}

static TEMPLATE: &str = include_str!("../../templates/chart.html.tera");

/// The data that the page's script reads.
#[derive(Serialize)]
struct PageData<'a> {
    least_error: f64,
    as_near: f64,
    entries: Vec<EntryColumns<'a>>,
    errors: [[&'static str; 2]; 4],
    costs: &'a [CostAxis],
    sets: Vec<SetColumns<'a>>,
}

#[derive(Serialize)]
struct EntryColumns<'a> {
    label: String,
    inputs: &'static str,
    input_numbers: usize,
    summary: &'a str,
    source: String,
    fetches: usize,
    fails: Option<&'a str>,
    is_ours: bool,
    describes: Option<&'static str>,
    no_cost: Option<&'a str>,
}

#[derive(Serialize)]
struct SetColumns<'a> {
    name: &'a str,
    title: &'a str,
    count: usize,
    undescribed: &'a [Vec<String>],
    errors: Vec<[Option<f64>; 4]>,
}

/// The page, or why it cannot be made. It opens with this set, cost and error.
///
/// # Errors
/// The page's template cannot be filled.
pub fn chart_page(data: &ChartData, [set, cost, error]: [usize; 3]) -> Result<String, String> {
    let mut context = Context::new();
    context.insert("data", &html::script_json(&page_data(data))?);
    context.insert("first", &[set, cost, error]);
    context.insert("command", &data.command);
    let user = data.entries.iter().find_map(ChartEntry::user);
    context.insert("user", &user.map(|user| &user.name));
    html::fill(TEMPLATE, &context)
}

fn page_data(data: &ChartData) -> PageData<'_> {
    let sets = data.sets.iter().map(|set| SetColumns {
        name: &set.name,
        title: &set.title,
        count: set.count,
        undescribed: &set.undescribed,
        errors: set.errors.iter().map(four_digits).collect(),
    });
    PageData {
        least_error: LEAST_ERROR,
        as_near: crate::lab::cost::TIE,
        entries: data.entries.iter().map(entry_columns).collect(),
        errors: ERRORS.map(|error| [error.short, error.title]),
        costs: &data.costs,
        sets: sets.collect(),
    }
}

fn entry_columns(entry: &ChartEntry) -> EntryColumns<'_> {
    let (summary, source) = match &entry.function {
        FunctionOrigin::Method(method) => (method.summary, method.source_in_full()),
        FunctionOrigin::User(user) => (user.about.as_str(), String::new()),
    };
    EntryColumns {
        label: entry.label(),
        inputs: entry.inputs(),
        input_numbers: entry.input_numbers(),
        summary,
        source,
        fetches: entry.fetches,
        fails: entry.fails(),
        is_ours: entry.is_ours(),
        describes: entry.method().map(|method| method.class.described()),
        no_cost: entry.user().and_then(|user| user.no_cost.as_deref()),
    }
}

/// Each error with four significant digits, as much as a reader can see of a point on a page.
pub fn four_digits(errors: &MethodErrors) -> [Option<f64>; 4] {
    ERRORS.map(|axis| {
        let error = (axis.value)(errors)?;
        format!("{error:.3e}").parse().ok()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lie_over_nothing() {
        let point = |i: u32| {
            (
                200.0 + 6.0 * f64::from(i % 3),
                100.0 + 5.0 * f64::from(i / 3),
            )
        };
        let points: Vec<(f64, f64)> = (0..12).map(point).collect();
        let names: Vec<((f64, f64), f64)> = points.iter().map(|at| (*at, 60.0)).collect();
        let page = beside(0.0, 200.0, 600.0, 400.0);
        let places = place_names(&names, 12.0, &points, &[], page);
        let areas: Vec<Area> = places.iter().flatten().map(|place| place.area).collect();
        assert!(areas.len() > 6, "{}", areas.len());
        for (i, one) in areas.iter().enumerate() {
            assert!(one.lies_in(&page));
            assert!(!areas[..i].iter().any(|other| other.meets(one)));
        }
        // No line to a name runs through another name.
        for (at, place) in points.iter().zip(&places) {
            let Some(place) = place else { continue };
            let mut others = areas.iter().filter(|area| **area != place.area);
            assert!(!others.any(|area| runs_through(place.leader(*at), area)));
        }
    }

    #[test]
    fn where_there_is_no_room_there_is_no_name() {
        let (page, at) = (beside(0.0, 10.0, 20.0, 20.0), (10.0, 10.0));
        assert_eq!(place_names(&[(at, 100.0)], 12.0, &[at], &[], page), [None]);
    }
}
