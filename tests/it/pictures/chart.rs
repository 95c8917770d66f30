//! Error against cost: each function stands where its numbers are, and what is cheaper or nearer lies on the right side.

use roxmltree::{Document, Node};
use serde_json::Value;

use super::Fact;
use super::check_all;
use super::reader::NEAR;
use super::reader::Scale;
use super::reader::across;
use super::reader::attribute;
use super::reader::numbers;
use super::reader::upwards;
use super::reader::words;
use crate::cli::Place;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*chart.svg",
        says: "cost rises to the right and error upwards, by powers of ten, and the frontier falls from left to right",
        holds: |shown| the_frontier_falls(&shown.text()),
    },
    Fact {
        pictures: "*chart.svg",
        says: "what has fitted coefficients errs less than every published formula that costs no more",
        holds: |shown| fitted_lies_below_what_is_cheaper(&shown.text()),
    },
    Fact {
        pictures: "*films.svg",
        says: "fitted forms of films stand far below and left of what engines compute of films",
        holds: |shown| {
            let text = shown.text();
            the_frontier_falls(&text);
            let place = |name: &str| {
                let end = format!(">{name}</text>");
                let line = text.lines().find(|line| line.ends_with(&end)).unwrap();
                let number = |key: &str| {
                    let (_, rest) = line.split_once(&format!(" {key}=\"")).unwrap();
                    rest.split_once('"').unwrap().0.parse::<f64>().unwrap()
                };
                (number("x"), number("y"))
            };
            let engine = place("iridescence_khr");
            for name in ["fitted_film", "fitted_film_eight"] {
                let ours = place(name);
                assert!(
                    ours.0 < engine.0 - 200.0 && ours.1 > engine.1 + 100.0,
                    "{name}"
                );
            }
        },
    },
    Fact {
        pictures: "*ours/chart.svg",
        says: "every function stands at its own cost and error, in the colour of its kind",
        holds: |shown| {
            let rows = shown.beside("ours/chart.json").unwrap();
            functions_stand_at_their_numbers(
                &shown.text(),
                &serde_json::from_slice(&rows).unwrap(),
            );
        },
    },
    Fact {
        pictures: "*theirs/chart.svg",
        says: "a user's function is a green diamond at its own cost and error",
        holds: |shown| {
            let rows = shown.beside("theirs/audit.json").unwrap();
            the_users_stands_at_its_numbers(&shown.text(), &serde_json::from_slice(&rows).unwrap());
        },
    },
    Fact {
        pictures: "*chart.html",
        says: "for gold the exact law costs more than Schlick and errs less, and `fitted` errs less than Schlick",
        holds: |shown| the_page_knows_gold(&shown.text()),
    },
    Fact {
        pictures: "*cost.html",
        says: "Schlick costs less than the exact law for dielectrics and that less than the one for conductors; bars are as long",
        holds: |shown| bars_follow_costs(&shown.text()),
    },
];

const FITTED: &str = "#0072b2";
const PROPOSED: &str = "#cc79a7";
const THEIRS: &str = "#d55e00";
const YOURS: &str = "#009e73";

/// A mark of the chart, where it stands.
struct Mark {
    stroke: String,
    is_hollow: bool,
    at: (f64, f64),
    is_texture: bool,
}

struct Chart {
    x: Scale,
    y: Scale,
    marks: Vec<Mark>,
    /// The corners of the frontier.
    frontier: Vec<(f64, f64)>,
}

impl Chart {
    #[track_caller]
    fn new(svg: &str) -> Chart {
        let document = Document::parse(svg).unwrap();
        let root = document.root_element();
        let words = words(root);
        let (x, y) = (across(&words), upwards(&words));
        assert!(x.is_logarithmic && y.is_logarithmic && x.rises_rightwards());
        assert!(y.place(0.1) < y.place(0.01), "the axis of error runs down");
        let line = root
            .children()
            .find(|node| node.attribute("stroke-opacity") == Some("0.55"));
        Chart {
            x,
            y,
            marks: root.children().filter_map(mark).collect(),
            frontier: corners(line.unwrap().attribute("d").unwrap()),
        }
    }

    /// The mark of a colour that stands at these numbers.
    #[track_caller]
    fn find(&self, stroke: &str, cost: f64, error: f64) -> &Mark {
        let want = (self.x.place(cost), self.y.place(error));
        let is_there = |mark: &&Mark| {
            let (across, down) = (mark.at.0 - want.0, mark.at.1 - want.1);
            mark.stroke == stroke && across.abs() < NEAR && down.abs() < NEAR
        };
        let found = self.marks.iter().find(is_there);
        found.unwrap_or_else(|| panic!("nothing of {stroke} at cost {cost}, error {error}"))
    }
}

/// A circle, a square or the diamond of a function.
fn mark(node: Node) -> Option<Mark> {
    let stroke = node.attribute("stroke")?;
    let at = match node.tag_name().name() {
        "circle" => (attribute(node, "cx")?, attribute(node, "cy")?),
        "rect" if stroke == THEIRS => {
            let half = attribute(node, "width")? / 2.0;
            (attribute(node, "x")? + half, attribute(node, "y")? + half)
        }
        "path" if stroke == YOURS => {
            let places = numbers(node.attribute("d")?);
            (places[2], places[1])
        }
        _ => return None,
    };
    Some(Mark {
        stroke: stroke.to_owned(),
        is_hollow: node.attribute("fill") == Some("#ffffff"),
        at,
        is_texture: node.has_tag_name("rect"),
    })
}

/// The corners of a line of M, V and H.
fn corners(path: &str) -> Vec<(f64, f64)> {
    let mut at = (0.0, 0.0);
    let mut found = Vec::new();
    let parts = path.replace('V', "\nV").replace('H', "\nH");
    for part in parts.lines() {
        let places = numbers(part);
        match &part[..1] {
            "M" => at = (places[0], places[1]),
            "V" => at.1 = places[0],
            _ => at.0 = places[0],
        }
        found.push(at);
    }
    found
}

#[track_caller]
fn the_frontier_falls(svg: &str) {
    let chart = Chart::new(svg);
    let read = |at: &(f64, f64)| (chart.x.value(at.0), chart.y.value(at.1));
    let steps: Vec<(f64, f64)> = chart.frontier.iter().map(read).collect();
    assert!(steps.len() > 3);
    for pair in steps.windows(2) {
        assert!(
            pair[1].0 >= pair[0].0 && pair[1].1 <= pair[0].1,
            "{steps:?}"
        );
    }
    // Every corner below is a function that is drawn.
    for (_, below) in chart
        .frontier
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .step_by(2)
    {
        let stands =
            |mark: &Mark| (mark.at.0 - below.0).abs() < NEAR && (mark.at.1 - below.1).abs() < NEAR;
        assert!(
            chart.marks.iter().any(stands),
            "no function at {:?}",
            read(&below)
        );
    }
}

#[track_caller]
fn fitted_lies_below_what_is_cheaper(svg: &str) {
    let chart = Chart::new(svg);
    let of = |colour: &str| -> Vec<&Mark> {
        let marks = chart.marks.iter();
        marks
            .filter(|mark| !mark.is_texture && mark.stroke == colour)
            .collect()
    };
    let (fitted, others) = (of(FITTED), of(THEIRS));
    assert!(fitted.len() > 2 && of(PROPOSED).len() > 3 && others.len() > 10);
    for mark in fitted {
        let cheaper = others.iter().filter(|other| other.at.0 <= mark.at.0 + NEAR);
        for other in cheaper {
            // Further down errs less.
            assert!(
                mark.at.1 > other.at.1 + 20.0,
                "{:?} and {:?}",
                mark.at,
                other.at
            );
        }
    }
}

#[track_caller]
fn functions_stand_at_their_numbers(svg: &str, report: &Value) {
    let chart = Chart::new(svg);
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), chart.marks.len());
    for row in rows {
        let method = fresnel_gen::language::methods::find(row["method"].as_str().unwrap()).unwrap();
        let colour = match (method.is_ours(), method.is_fitted()) {
            (false, _) => THEIRS,
            (true, true) => FITTED,
            (true, false) => PROPOSED,
        };
        let [cost, error] = ["cost", "value"].map(|key| row[key].as_f64().unwrap());
        let mark = chart.find(colour, cost, error.max(1e-5));
        assert_eq!(mark.is_texture, row["fetches"] != 0, "{row}");
        if row["inputs"] == "best" && row["is_on_frontier"] == true {
            assert!(mark.is_hollow, "{row}");
        }
    }
    let value = |method: &str, key: &str| {
        let row = rows
            .iter()
            .find(|row| row["method"] == method && row["inputs"] != "best");
        row.unwrap()[key].as_f64().unwrap()
    };
    // What a physicist knows of it: the law itself is dear and near, Schlick cheap and off.
    assert!(value("conductor_exact", "cost") > 5.0 * value("schlick", "cost"));
    assert!(value("conductor_exact", "value") < value("schlick", "value") / 10.0);
}

#[track_caller]
fn the_users_stands_at_its_numbers(svg: &str, report: &Value) {
    let chart = Chart::new(svg);
    let row = &report["rows"][0];
    let cost = row["cost"][0]["net"].as_f64().unwrap();
    let error = row["model_error"]["max_abs"].as_f64().unwrap();
    chart.find(YOURS, cost, error);
    assert_eq!(
        chart
            .marks
            .iter()
            .filter(|mark| mark.stroke == YOURS)
            .count(),
        1
    );
}

#[track_caller]
fn the_page_knows_gold(page: &str) {
    let data = page
        .split("const data = ")
        .nth(1)
        .unwrap()
        .split(";\n")
        .next()
        .unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let entries = data["entries"].as_array().unwrap();
    let named = |list: &str, name: &str| {
        let all = data[list].as_array().unwrap();
        all.iter().find(|one| one["name"] == name).unwrap().clone()
    };
    let (gold, rdna2) = (named("sets", "gold"), named("costs", "rdna2"));
    let figures = |label: &str| {
        let place = entries
            .iter()
            .position(|entry| entry["label"] == label)
            .unwrap();
        let error = gold["errors"][place][0].as_f64().unwrap();
        (rdna2["costs"][place].as_f64().unwrap(), error)
    };
    let [schlick, fitted, exact] = ["schlick", "fitted", "conductor_exact"].map(figures);
    assert!(
        exact.0 > schlick.0 && exact.1 < schlick.1,
        "{exact:?} {schlick:?}"
    );
    assert!(
        fitted.1 < schlick.1 / 5.0 && fitted.0 < 2.0 * schlick.0,
        "{fitted:?}"
    );
}

/// A function's share and the length of its bar.
fn bars(section: &str) -> Vec<(String, f64, f64)> {
    let part = |row: &str, from: &str, to: &str| {
        let rest = row.split(from).nth(1)?;
        rest.split(to).next().map(str::to_owned)
    };
    let row = |row: &str| {
        let mut cells = row.split("</td><td>");
        let (name, _cost) = (cells.next()?.trim_start_matches("<td>"), cells.next()?);
        let share = cells.next()?.split('<').next()?.parse().ok()?;
        let length = part(row, "width:", "%")?.parse().ok()?;
        Some((name.to_owned(), share, length))
    };
    section.split("<tr>").filter_map(row).collect()
}

#[track_caller]
fn bars_follow_costs(page: &str) {
    let sections: Vec<&str> = page.split("<h2 ").skip(1).collect();
    let with_bars: Vec<_> = sections
        .iter()
        .map(|section| bars(section))
        .filter(|bars| !bars.is_empty())
        .collect();
    assert!(with_bars.len() > 10);
    for bars in with_bars {
        let share = |name: &str| bars.iter().find(|(of, ..)| of == name).unwrap().1;
        assert_eq!(share("dielectric_exact"), 100.0);
        assert!(share("schlick") < 100.0 && share("conductor_exact") > 200.0);
        let longest = bars
            .iter()
            .fold(0.0f64, |most, (_, share, _)| most.max(*share));
        for (name, share, length) in &bars {
            assert!(
                // Shares are told in whole per cent.
                (length - 100.0 * share / longest).abs() < 0.1 + 100.0 / longest,
                "{name}: {share} is {length} long"
            );
        }
    }
}

#[test]
fn every_function_stands_at_its_error_and_cost() {
    let place = Place::new();
    let materials = "--material gold,platinum,water,diamond";
    place.done(&format!(
        "chart {materials} --out-dir ours --json ours/chart.json"
    ));
    assert_eq!(check_all(&place.path("")).len(), 2);
}

#[test]
fn bars_are_as_long_as_what_they_stand_for() {
    let place = Place::new();
    place.done("cost --out-dir .");
    assert_eq!(check_all(&place.path("")), ["cost.html"]);
}

#[test]
fn a_users_function_stands_at_its_own_error_and_cost() {
    use crate::audit::{audit, thesis};
    let place = thesis::place();
    let line = "thesis.wgsl --function schlick --material gold --gpu rdna2 --out-dir theirs";
    let Some(ran) = audit(&place, &format!("{line} --json theirs/audit.json")) else {
        return;
    };
    ran.ends(0);
    if place.read("theirs/chart.svg").contains("has no point here") {
        return crate::not_checked("a user's function on the chart: no compiler told its cost");
    }
    assert_eq!(check_all(&place.path("")).len(), 2);
}
