//! The page in a real browser without a window, by WebGL 2 and by WebGPU.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use fresnel_gen::fit::values_for_material;
use fresnel_gen::gallery::{CUBE, reduced_tables, unpacked_environment};
use fresnel_gen::gpu::{Device, DeviceFault, Wanted};
use fresnel_gen::reference::MaterialInMedium;
use fresnel_gen::scene::{
    self, Around, Camera, Environment, Glass, RenderRow, RowText, Scenery, Things,
};
use glam::DVec3;
use serde_json::{Value, json};

use super::{page, subjects};
use crate::cli::Place;
use crate::compilers::Tool;
use crate::not_checked;

const CHROMIUM: Tool = Tool {
    command: "chromium",
    package: "chromium",
};

/// Stands in the page before anything of it runs, and hears what goes wrong.
const EARS: &str = r#"<script>
const faults = [];
addEventListener("error", event => faults.push(event.message));
addEventListener("unhandledrejection", event => faults.push(String(event.reason)));
addEventListener("securitypolicyviolation", event => faults.push("it asks for " + event.blockedURI));
for (const kind of ["error", "warn"]) console[kind] = (...words) => faults.push(words.join(" "));
</script><title>"#;
const HANDS: &str = include_str!("hands.js");

/// Pixels a side of a panel in `HANDS`.
const PANEL: usize = 50;

/// What the hands saw in the page.
fn told(backend: &str) -> Value {
    let place = Place::new();
    let hands = format!("<script>{HANDS}</script></html>");
    let page = page()
        .replacen("<title>", EARS, 1)
        .replace("</html>", &hands);
    place.put("tried.html", page);
    let profile = format!("--user-data-dir={}", place.path("profile").display());
    let page = format!(
        "file://{}?backend={backend}",
        place.path("tried.html").display()
    );
    let dom = CHROMIUM.run([
        "--headless",
        "--no-sandbox",
        "--no-first-run",
        "--disable-quic",
        "--disable-sync",
        "--disable-background-networking",
        "--disable-component-update",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--enable-unsafe-webgpu",
        "--use-webgpu-adapter=swiftshader",
        "--enable-features=Vulkan",
        "--use-vulkan=swiftshader",
        &profile,
        "--dump-dom",
        &page,
    ]);
    let dom = dom.expect("the page is rendered");
    let told = dom
        .split("<pre id=\"told\">")
        .nth(1)
        .expect("the script came to its end");
    let told = told.split('<').next().unwrap();
    serde_json::from_slice(&BASE64_STANDARD.decode(told).unwrap()).unwrap()
}

fn pixels(picture: &Value) -> Vec<DVec3> {
    let bytes = BASE64_STANDARD.decode(picture.as_str().unwrap()).unwrap();
    let numbers = bytes
        .chunks_exact(4)
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()));
    let numbers: Vec<f64> = numbers.map(f64::from).collect();
    numbers.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// The same row by this program's own device.
fn drawn(
    device: &Device,
    row: &'static RenderRow,
    subjects: &[MaterialInMedium],
    sky: &Environment,
) -> Vec<DVec3> {
    let subject = subjects
        .iter()
        .find(|subject| subject.name == row.material)
        .expect("it is there");
    let whole = Glass::of_surface(&subject.reference.surface);
    let flat = whole.at_one_index();
    let body = row.body.body();
    let relief = row.is_hammered.then(scene::Relief::hammered);
    let things = Things {
        body: &body,
        glass: if row.disperses { &whole } else { &flat },
        around: if row.in_room {
            Around::Room
        } else {
            Around::Far(sky)
        },
        relief: relief.as_ref(),
    };
    let text = RowText::usual(row);
    let inputs = text.inputs(&values_for_material(subject, text.method));
    let scenery = Scenery {
        tables: reduced_tables(&body),
        cube: CUBE,
        ..Scenery::of(things, sky)
    };
    let camera = Camera::around(DVec3::from_array(row.eye), body.radius());
    let each = scene::SAMPLES as usize;
    let side = PANEL * each;
    let drawn = scene::draw(device, (&text, inputs), &scenery, &camera, side as u32);
    let samples = drawn.expect("it is drawn").samples;
    let mut means = vec![DVec3::ZERO; PANEL * PANEL];
    for (i, [r, g, b, _]) in samples.into_iter().enumerate() {
        let pixel = i / side / each * PANEL + i % side / each;
        means[pixel] += DVec3::new(r.into(), g.into(), b.into()) / (each * each) as f64;
    }
    means
}

/// Radiance may differ by this, and by this share of it, in all but one of a hundred pixels: drivers round, and the page's ball has half
/// the rows.
const TOLERANCE: f64 = 0.02;
const OUTSIDE: f64 = 0.01;

/// The share of the pixels that differ by more.
fn share_apart(one: &[DVec3], other: &[DVec3]) -> f64 {
    let is_apart = |(a, b): &(&DVec3, &DVec3)| {
        let most = a.max(**b).max_element();
        (**a - **b).abs().max_element() > TOLERANCE * (1.0 + most)
    };
    assert_eq!(one.len(), other.len());
    one.iter().zip(other).filter(is_apart).count() as f64 / one.len() as f64
}

/// What a browser drew, by the backend's name.
#[track_caller]
fn every_row_is_drawn(told: &Value, backend: &str) {
    assert_eq!(told["faults"], json!([]), "{}", told["faults"]);
    assert_eq!(told["asked"], json!([]));
    assert_eq!(told["drawn_by"], backend);
    let device = match Device::open(&Wanted::default()) {
        Ok(device) => Some(device),
        Err(fault @ DeviceFault::Absent { .. }) => {
            not_checked(&format!("pixels of the gallery: {fault}"));
            None
        }
        Err(fault) => panic!("{fault}"),
    };
    let (subjects, sky) = (subjects(), unpacked_environment());
    let mut faults = String::new();
    for row in scene::ALL.iter().filter(|row| !row.passes.is_empty()) {
        let seen = &told["rows"][row.name];
        let status = seen["status"].as_str().expect("the row was shown");
        let begins = format!(
            "{}, {} by {}, drawn by {backend}.",
            row.name, row.material, row.method
        );
        assert!(status.starts_with(&begins), "{status}");
        let is_exact = row.method.ends_with("_exact");
        assert_eq!(status.ends_with("mean 0, largest 0."), is_exact, "{status}");
        let Some(device) = &device else { continue };
        let apart = share_apart(
            &pixels(&seen["picture"]),
            &drawn(device, row, &subjects, &sky),
        );
        println!(
            "{backend}, {}: {:.2} % of pixels are apart",
            row.name,
            100.0 * apart
        );
        if apart > OUTSIDE {
            faults += &format!("{}: {:.2} %\n", row.name, 100.0 * apart);
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn webgpu_draws_every_row() {
    if CHROMIUM.is_here("the gallery by WebGPU") {
        every_row_is_drawn(&told("webgpu"), "WebGPU");
    }
}

#[test]
fn webgl_draws_every_row_and_follows_the_reader() {
    if !CHROMIUM.is_here("the gallery by WebGL 2") {
        return;
    }
    let told = told("webgl2");
    every_row_is_drawn(&told, "WebGL 2");
    changes_are_seen(&told["changes"]);
    figures_are_recorded(&told);
    everything_is_reached(&told);
}

/// Each step of the reader changes pixels and what is said.
#[track_caller]
fn changes_are_seen(changes: &Value) {
    let steps = [
        "gold_schlick",
        "gold_exact",
        "silver_exact",
        "own_exact",
        "own_k",
        "turned",
        "raised",
    ];
    for pair in steps.windows(2) {
        let [one, other] = [pair[0], pair[1]].map(|name| &changes[name]);
        assert_ne!(one["picture"], other["picture"], "{pair:?}");
    }
    let status = |name: &str| changes[name]["status"].as_str().unwrap().to_owned();
    assert!(!status("gold_schlick").contains("largest 0."));
    assert!(status("gold_exact").ends_with("mean 0, largest 0."));
    assert!(status("silver_exact").contains("silver by conductor_exact"));
    assert!(status("own_exact").contains("an index of your own"));
}

/// Errors and costs are those of the chart.
#[track_caller]
fn figures_are_recorded(told: &Value) {
    let place = Place::new();
    let ran = place.done("chart --material gold --show gold --gpu rdna2 --json -");
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    let mut rows = report["rows"].as_array().unwrap().iter();
    let recorded = rows.find(|row| row["method"] == "schlick" && row["inputs"] == "intended");
    let recorded = recorded.expect("the chart has it");
    let number = |cell: &Value| cell.as_str().unwrap().parse::<f64>().unwrap();
    let (error, cost) = (number(&told["errors"][0]), number(&told["costs"][0]));
    let want = recorded["value"].as_f64().unwrap();
    assert!((error / want - 1.0).abs() < 0.005, "{error} {want}");
    assert_eq!(cost, recorded["cost"].as_f64().unwrap());
}

/// The page is used by keyboard and read by voice.
#[track_caller]
fn everything_is_reached(told: &Value) {
    assert!(told["controls"].as_u64().unwrap() > 15, "{told}");
    assert_eq!(told["unlabelled"], json!([]));
    assert_eq!(told["unreached"], json!([]));
    assert_eq!(told["live"], json!(["status", "copied"]));
    assert_eq!(told["own"], "index of the sliders");
    assert_ne!(told["before"], told["after"]);
    for way in ["copied", "selected"] {
        assert_eq!(told[way][0], true, "{way}");
        assert!(
            told[way][1].as_str().unwrap().ends_with("is copied."),
            "{}",
            told[way]
        );
    }
    let head = format!(" {}(", told["gles"][0].as_str().unwrap());
    let text = told["gles"][1].as_str().unwrap();
    assert!(text.contains(&head) && text.contains("highp"), "{text}");
    let label = told["rows"]["complex_f0"]["label"].as_str().unwrap();
    assert!(label.contains("Three panels: by schlick; by the exact law, conductor_exact"));
}
