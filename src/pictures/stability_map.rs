//! Maps of where functions fail, over angle and index or a film's thickness, and their page.
//!
//! A map is a picture: the formula's error on the left, its rounding error on the right, each with a colour bar.
//!
//! The page has all maps, and a sentence for each failure: how much of a region fails, where it is worst, and the result there. It is
//! self-contained.

use std::collections::BTreeSet;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde::Serialize;
use tera::Context;

use crate::generator::emit::xml_text;
use crate::lab::stability::{Cell, Failure, Finding, Map, StabilityRow, short};
use crate::language::methods::Method;
use crate::pictures::html;
use crate::pictures::plot::{
    Area, Axes, PANEL, SHADES, SUBTITLE, Scale, TICK, Tick, labelled, log_ticks, plain_label,
    power_label, shade, ticks,
};

const WIDTH: f64 = 920.0;
const HEIGHT: f64 = 366.0;
/// The size of a panel's plot.
const PLOT: (f64, f64) = (300.0, 220.0);
const TOP: f64 = 90.0;
/// The left edges of the panels' plots.
const LEFTS: [f64; 2] = [70.0, 540.0];
/// The gap between a plot and its colour bar, and the bar's width.
const BAR: (f64, f64) = (14.0, 14.0);
/// The colour where a result is not a reflectance.
const BROKEN: &str = "#d7263d";

/// The contents of a panel.
struct Panel {
    /// The title: what is compared with what.
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

/// The picture of a map, as SVG.
pub fn heat_map(method: &str, map: &Map) -> String {
    let title = format!("{method} over angle and {}", map.axis.name);
    let held = format!(
        "{}; red: not a number, infinite, below 0 or above 1",
        map.held
    );
    let mut parts = vec![
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
             font-family=\"system-ui, sans-serif\"><title>{}</title><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
            xml_text(&title)
        ),
        PANEL.draw_line(&title, 24.0, 14.0, "start"),
        SUBTITLE.draw_line(&held, 24.0, 36.0, "start"),
    ];
    for (panel, left) in PANELS.iter().zip(LEFTS) {
        parts.extend(panel.draw(map, left));
    }
    parts.push("</svg>\n".to_owned());
    parts.join("\n")
}

impl Panel {
    fn draw(&self, map: &Map, left: f64) -> Vec<String> {
        let axes = axes(map, left);
        let title = (self.title)(map.precision.name());
        let (x, y) = (angles(), values(map));
        let (centre, below) = (axes.area.centre(), axes.area.bottom + 21.0);
        let value = [map.axis.name.to_owned()];
        let mut parts = vec![SUBTITLE.draw_line(&title, centre, TOP - 24.0, "middle")];
        parts.extend(self.cells(map, left));
        parts.extend(axes.outer_ticks(&x, &y));
        parts.extend(axes.tick_labels(&x, &y));
        parts.push(TICK.draw_line("angle of incidence", centre, below, "middle"));
        parts.extend(TICK.draw_upwards(&value, left - 60.0, axes.area.middle()));
        parts.extend(self.bar(left + PLOT.0 + BAR.0));
        parts
    }

    /// The cells. Adjacent ones of one colour in a row become one rectangle.
    fn cells(&self, map: &Map, left: f64) -> Vec<String> {
        let columns = map.degrees.len();
        let width = PLOT.0 / columns as f64;
        let height = PLOT.1 / map.axis.values.len() as f64;
        let mut parts = vec!["<g shape-rendering=\"crispEdges\">".to_owned()];
        for (row, cells) in map.cells.chunks(columns).enumerate() {
            let y = TOP + PLOT.1 - height * (row + 1) as f64;
            let mut first = 0;
            while first < columns {
                let colour = self.colour(&cells[first]);
                let rest = cells[first..].iter();
                let count = rest.take_while(|cell| self.colour(cell) == colour).count();
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
        let (low, high) = self.decades;
        let ends = [low, high].map(|decade| libm::exp10(f64::from(decade)));
        let area = area(left, BAR.1);
        let axes = Axes {
            area,
            x: Scale::linear([0.0, 1.0], [area.left, area.right]),
            y: Scale::log(ends, [area.bottom, area.top]),
        };
        let step = if high - low > 6 { 2 } else { 1 };
        let decades = (low..=high).step_by(step);
        let ticks = labelled(decades.map(|decade| libm::exp10(f64::from(decade))), power);
        parts.push(area.outline());
        parts.extend(axes.right_ticks(&ticks));
        parts
    }
}

/// The area of a panel's plot, or of its colour bar.
fn area(left: f64, width: f64) -> Area {
    Area::between([left, left + width], [TOP, TOP + PLOT.1])
}

/// The axes of a map. A value stands in the middle of its cell.
fn axes(map: &Map, left: f64) -> Axes {
    let area = area(left, PLOT.0);
    let (degrees, values) = (&map.degrees, &map.axis.values);
    let half = [
        PLOT.0 / degrees.len() as f64 / 2.0,
        PLOT.1 / values.len() as f64 / 2.0,
    ];
    // Thicknesses begin at 0.
    let scale = match values[0] > 0.0 {
        true => Scale::log,
        false => Scale::linear,
    };
    Axes {
        area,
        x: Scale::linear(ends(degrees), [area.left + half[0], area.right - half[0]]),
        y: scale(ends(values), [area.bottom - half[1], area.top + half[1]]),
    }
}

fn ends(values: &[f64]) -> [f64; 2] {
    [values[0], values[values.len() - 1]]
}

fn angles() -> Vec<Tick> {
    let degrees = (0..=90).step_by(15).map(f64::from);
    labelled(degrees, |degree| format!("{degree}°"))
}

/// The ticks of the values: six per decade, or one where there are many decades.
fn values(map: &Map) -> Vec<Tick> {
    let [low, high] = ends(&map.axis.values);
    if low == 0.0 {
        return labelled(ticks(low, high, 6), plain_label);
    }
    if high / low > 1e4 {
        return labelled(log_ticks(low, high, &[1.0]), power);
    }
    let multiples = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0];
    labelled(log_ticks(low, high, &multiples), plain_label)
}

/// The label of a power of ten.
fn power(value: f64) -> String {
    power_label(libm::round(libm::log10(value)) as i32)
}

static TEMPLATE: &str = include_str!("../../templates/stability.html.tera");

/// A method on the page.
#[derive(Serialize)]
struct MethodSection {
    method: &'static str,
    summary: &'static str,
    /// What goes wrong and where, a sentence for each failure.
    formula: Vec<String>,
    rounding: Vec<String>,
    arguments: Vec<String>,
    pictures: Vec<Picture>,
}

/// A picture with its caption.
#[derive(Serialize)]
struct Picture {
    about: String,
    data: String,
}

/// The page of these rows and pictures (method, second axis, PNG), or why it cannot be made.
///
/// # Errors
/// The page's template cannot be filled.
pub fn stability_page(
    rows: &[StabilityRow],
    pictures: &[(&'static str, String, Vec<u8>)],
    command: &str,
) -> Result<String, String> {
    let mut methods: Vec<&'static Method> = rows.iter().map(|row| row.method).collect();
    let mut seen = BTreeSet::new();
    methods.retain(|method| seen.insert(method.name));
    let sections = methods.into_iter();
    let sections: Vec<MethodSection> = sections
        .map(|method| section(method, rows, pictures))
        .collect();
    let mut context = Context::new();
    context.insert("sections", &sections);
    context.insert("command", command);
    context.insert(
        "precision",
        rows.first().map_or("f32", |row| row.precision.name()),
    );
    html::fill(TEMPLATE, &context)
}

fn section(
    method: &'static Method,
    rows: &[StabilityRow],
    pictures: &[(&'static str, String, Vec<u8>)],
) -> MethodSection {
    let own = rows.iter().filter(|row| row.method.name == method.name);
    let findings: Vec<(String, &Finding)> = own
        .filter_map(|row| Some((about(row), row.finding.as_ref()?)))
        .collect();
    let sentences = |wanted: fn(&Finding) -> bool| -> Vec<String> {
        let findings = findings.iter().filter(|(_, finding)| wanted(finding));
        findings
            .map(|(about, finding)| about.clone() + &sentence(finding))
            .collect()
    };
    let own = pictures.iter().filter(|(of, _, _)| *of == method.name);
    let picture = |(_, over, png): &(&str, String, Vec<u8>)| Picture {
        about: format!("Errors of {} over angle and {over}", method.name),
        data: BASE64_STANDARD.encode(png),
    };
    MethodSection {
        method: method.name,
        summary: method.summary,
        formula: sentences(|finding| finding.is_media && finding.is_of_formula()),
        rounding: sentences(|finding| finding.is_media && !finding.is_of_formula()),
        arguments: sentences(|finding| !finding.is_media),
        pictures: own.map(picture).collect(),
    }
}

/// The material and the channel of a row, before its sentence.
fn about(row: &StabilityRow) -> String {
    let material = row.material.as_ref();
    material.map_or_else(String::new, |(name, channel)| {
        format!("{name}, {channel}: ")
    })
}

/// A finding as a sentence.
fn sentence(finding: &Finding) -> String {
    let share = match finding.share {
        1.0.. => String::new(),
        share => format!(" ({} of it)", percent(share)),
    };
    format!(
        "{}: {}{share}; worst at {}",
        finding.region,
        finding.failure.words(),
        worst(finding)
    )
}

/// The share of a region that fails.
pub fn percent(share: f64) -> String {
    match share {
        1.0.. => "all".to_owned(),
        share => format!("{} %", (100.0 * share).round().clamp(1.0, 99.0)),
    }
}

/// Where it is worst, and the result there.
pub fn worst(finding: &Finding) -> String {
    let at = finding.worst.iter();
    let at: Vec<String> = at
        .map(|(name, x)| format!("{name} {}", short(*x)))
        .collect();
    let at = at.join(", ");
    let what = match (finding.failure, finding.point) {
        (Failure::Digits(_), _) => format!("{} ulp", rounded(finding.amount)),
        (Failure::Error(_), Some(shown)) => {
            let law = shown.law.map_or_else(String::new, number);
            format!("{}, the law {law}", number(shown.want))
        }
        (Failure::Monotony | Failure::Minimum, _) => format!("by {:.3}", finding.amount),
        (_, Some(shown)) => number(shown.got),
        (_, None) => String::new(),
    };
    if at.is_empty() {
        what
    } else {
        format!("{at}: {what}")
    }
}

/// A reflectance with four digits.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 || size >= 1e4 && size.is_finite() => format!("{x:.1e}"),
        size if size.is_finite() => format!("{x:.4}"),
        _ => x.to_string(),
    }
}

/// A number with two digits.
fn rounded(x: f64) -> String {
    if x >= 1e4 {
        format!("{x:.1e}")
    } else {
        format!("{x:.0}")
    }
}
