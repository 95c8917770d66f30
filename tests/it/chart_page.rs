//! The page of charts in a real browser without a window: its points, its filters, its frontier, and that it asks nobody.

use fresnel_gen::generator::request::{Materials, Request};
use fresnel_gen::lab::chart::{ChartView, chart_data};
use fresnel_gen::physics::spectra::Space;
use fresnel_gen::pictures::frontier::chart_svg;
use serde_json::Value;

use crate::audit;
use crate::browser::{self, CHROMIUM};
use crate::cli::Place;
use crate::pictures::reader::Scale;

const MATERIALS: &str = "gold,platinum,water,diamond";

/// Stands behind the page, does what a reader does, and leaves in the page what was seen.
const HANDS: &str = r##"<script>
{
  const count = () => document.querySelectorAll("#chart .point").length;
  const click = id => { document.getElementById(id).click(); return count(); };
  const choose = (id, part) => {
    const list = document.getElementById(id);
    list.value = [...list.options].find(option => option.text.startsWith(part)).value;
    list.dispatchEvent(new Event("input", { bubbles: true }));
  };
  const frontier = () => [...document.querySelectorAll("#rows tr.best-row")].map(row => row.cells[0].textContent);
  const told = { all: count(), rows: document.querySelectorAll("#rows tr").length, first: frontier() };
  const number = (one, name) => Number(one.getAttribute(name));
  told.places = [...document.querySelectorAll("#chart circle.point")].map(one =>
    [number(one, "cx"), number(one, "cy"), ...one.textContent.match(/cost (\S+), error (\S+)$/).slice(1).map(Number)]);
  const labels = [...document.querySelectorAll("#chart text")].filter(one => one.hasAttribute("x") && Number(one.textContent) > 0);
  told.across = labels.filter(one => one.getAttribute("text-anchor") === "middle").map(one => [number(one, "x"), Number(one.textContent)]);
  told.upwards = labels.filter(one => one.getAttribute("text-anchor") === "end").map(one => [number(one, "y") - 4, Number(one.textContent)]);
  const own = document.querySelector("#chart .point.yours");
  if (own) {
    own.dispatchEvent(new Event("mouseenter"));
    told.yours = document.getElementById("about").textContent;
    told.others = click("show-yours");
    click("show-yours");
  }
  told.unfitted = click("show-fitted");
  told.again = click("show-fitted");
  told.intended = click("show-best");
  click("show-best");
  choose("set", "gold"); choose("cost", "adreno330"); choose("error", "largest difference of colour");
  told.gold = frontier();
  choose("set", "water"); choose("cost", "time"); choose("error", "mean relative");
  told.water = frontier();
  document.querySelector("#chart .point.fitted").dispatchEvent(new Event("mouseenter"));
  told.about = document.getElementById("about").textContent;
  told.lacks = document.getElementById("lacks")?.textContent;
  told.asked = performance.getEntriesByType("resource").map(one => one.name);
  told.faults = faults;
  const place = document.body.appendChild(document.createElement("pre"));
  place.id = "told";
  place.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(told))));
}
</script></html>"##;

/// The labels on the frontier as the program's own rows tell them.
fn frontier(place: &Place, view: &str) -> (usize, Vec<String>) {
    let ran = place.done(&format!("chart --material {MATERIALS} {view} --json -"));
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    let rows = report["rows"].as_array().unwrap().clone();
    let best = rows.iter().filter(|row| row["is_on_frontier"] == true);
    let label = |row: &Value| {
        let star = if row["inputs"] == "best" { "*" } else { "" };
        format!("{}{star}", row["method"].as_str().unwrap())
    };
    (rows.len(), best.map(label).collect())
}

fn labels(told: &Value) -> Vec<String> {
    let list = told.as_array().unwrap().iter();
    list.map(|one| one.as_str().unwrap().to_owned()).collect()
}

/// What the hands saw in the page.
fn told(place: &Place) -> Value {
    let page = place.read("chart.html");
    browser::told(place, &page, HANDS, "", &["--disable-gpu"])
}

/// Cost rises to the right and error upwards, as the labels say, and each point stands at its own.
#[track_caller]
fn points_stand_at_their_numbers(told: &Value) {
    let numbers = |list: &Value| -> Vec<Vec<f64>> { serde_json::from_value(list.clone()).unwrap() };
    let scale = |name: &str| {
        let mut labels: Vec<(f64, f64)> = numbers(&told[name])
            .iter()
            .map(|label| (label[0], label[1]))
            .collect();
        labels.sort_by(|a, b| a.0.total_cmp(&b.0));
        Scale::through(&labels)
    };
    let (across, upwards) = (scale("across"), scale("upwards"));
    assert!(across.is_logarithmic && across.rises_rightwards());
    assert!(upwards.is_logarithmic && upwards.place(0.1) < upwards.place(0.01));
    let places = numbers(&told["places"]);
    assert!(places.len() > 20);
    for place in places {
        // Told with three digits: up to a pixel and a half.
        let (x, y) = (across.place(place[2]), upwards.place(place[3].max(1e-5)));
        assert!(
            (x - place[0]).abs() < 1.5 && (y - place[1]).abs() < 1.5,
            "{place:?}: not at {x}, {y}"
        );
    }
}

#[test]
fn a_browser_shows_every_point_and_asks_nobody() {
    let place = Place::new();
    place.done(&format!("chart --material {MATERIALS} --out-dir ."));
    if !CHROMIUM.is_here("the page of charts") {
        return;
    }
    let told = told(&place);
    assert_eq!(told["faults"], serde_json::json!([]), "{told}");
    assert_eq!(told["asked"], serde_json::json!([]), "{told}");
    let (points, first) = frontier(&place, "");
    assert_eq!(told["all"], points);
    assert_eq!(told["rows"], points);
    assert_eq!(told["again"], points);
    points_stand_at_their_numbers(&told);
    assert!(told["unfitted"].as_u64() < told["all"].as_u64());
    assert!(told["intended"].as_u64() < told["all"].as_u64());
    assert_eq!(labels(&told["first"]), first);
    let gold = "--show gold --gpu adreno330 --error de2000";
    assert_eq!(labels(&told["gold"]), frontier(&place, gold).1);
    let water = "--show water --gpu time --error mean-rel";
    assert_eq!(labels(&told["water"]), frontier(&place, water).1);
    assert!(
        told["about"].as_str().unwrap().starts_with("fitted"),
        "{told}"
    );
}

#[test]
fn a_users_function_is_one_more_point() {
    let place = audit::thesis::place();
    let line = format!("thesis.wgsl --function schlick --material {MATERIALS} --out-dir .");
    let Some(ran) = audit::audit(&place, &line) else {
        return;
    };
    ran.ends(0);
    if !CHROMIUM.is_here("the page of charts") || place.read("chart.svg").contains("has no point") {
        return;
    }
    let told = told(&place);
    assert_eq!(told["faults"], serde_json::json!([]), "{told}");
    let (points, _) = frontier(&place, "");
    assert_eq!(told["all"], points + 1);
    assert_eq!(told["rows"], points + 1);
    assert_eq!(told["others"], points);
    let about = told["yours"].as_str().unwrap();
    assert!(about.starts_with("schlick (yours) (your own"), "{told}");
    assert_eq!(
        told["lacks"],
        "schlick (yours) has no point here: its cost is not known."
    );
}

/// Every name of a point stands right above a copy of itself with a rim: viewers that know no `paint-order` show it too.
#[track_caller]
fn names_are_readable(svg: &str) {
    assert!(!svg.contains("paint-order"));
    let lines: Vec<&str> = svg.lines().collect();
    let is_rim = |line: &str| line.starts_with("<text aria-hidden=\"true\" stroke=");
    let rims = lines.windows(2).filter(|pair| is_rim(pair[0]));
    let after = |line: &str| line.split_once(" x=").map(|(_, rest)| rest.to_owned());
    let mut count = 0;
    for pair in rims {
        assert!(pair[1].starts_with("<text x="), "{pair:?}");
        assert_eq!(after(pair[0]), after(pair[1]));
        count += 1;
    }
    assert!(count > 15, "{count}");
    // Nothing else is drawn with a stroke and letters at once.
    let stroked = lines
        .iter()
        .filter(|line| line.starts_with("<text") && line.contains("stroke="));
    assert_eq!(stroked.count(), count);
    assert!(
        !lines
            .iter()
            .any(|line| line.starts_with("<g ") && line.contains("stroke"))
    );
}

/// The pictures in docs are of the whole catalogue: README's on RDNA 2, and the same on a phone's GPU.
#[test]
fn the_pictures_in_docs_are_of_the_whole_catalogue() {
    let request = Request {
        materials: Materials::All,
        ..Request::default()
    };
    let materials = request
        .subjects()
        .expect("the catalogue is read")
        .materials();
    let mut data = chart_data(
        &materials,
        Space::Srgb,
        None,
        String::new(),
        &mut |_, _, _| {},
    );
    for (gpu, command, file) in [
        ("rdna2", "chart", "chart.svg"),
        ("adreno630", "chart --gpu adreno630", "adreno630-chart.svg"),
    ] {
        command.clone_into(&mut data.command);
        let set = data.sets.iter().find(|set| set.name == "metals-median");
        let cost = data.costs.iter().find(|cost| cost.name == gpu);
        let view = ChartView {
            data: &data,
            set: set.expect("it is a set"),
            cost: cost.expect("it is an axis"),
            error: 0,
        };
        let picture = chart_svg(&view).expect("it has points");
        names_are_readable(&picture);
        let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
        crate::bless::check(&docs.join(file), picture.as_bytes());
    }
}
