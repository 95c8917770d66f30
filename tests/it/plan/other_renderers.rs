//! A plan holds in the pictures of renderers that are not ours: three.js, in a browser, and Mitsuba, a path tracer.
//!
//! Each renderer wrote its G-buffer, and drew its picture twice: by the exact law, and by the functions of the plan. What the plan says
//! of each material is compared with the difference of the two pictures. `gbuffers/README.md` says how the files were made.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use exr::prelude::read_all_flat_layers_from_file;
use glam::DVec3;
use serde_json::{Value, json};

use crate::browser::{self, CHROMIUM};
use crate::cli::Place;
use crate::{bless, not_checked, subjects};
use fresnel_gen::physics::spectra::{Space, ciede2000, xyz_to_lab};
use fresnel_gen::pictures::plan::{FramePixels, MaterialIds, ScenePixel, read_gbuffer};

/// The version of three.js that drew the committed files.
const THREE: &str = "0.187.0";
/// Its table has what is measured here.
const DOCUMENT: &str = include_str!("../../../docs/plan.md");
/// Cosines of a table of the exact law.
const TEXELS: usize = 1024;

/// A scene of a renderer.
#[derive(Clone, Copy)]
struct Scene {
    /// Its G-buffer and map in `gbuffers` have this name.
    name: &'static str,
    /// What is seen in its pictures is recorded under this name.
    record: &'static str,
    /// What is seen lies between these shares of what the plan says.
    holds: [f64; 2],
    /// A half transparent material: the errors of what lies behind are seen through it.
    see_through: &'static str,
}

/// One sample a pixel, in the picture as in the frame.
const STATUE: Scene = Scene {
    name: "statue",
    record: "statue",
    holds: [0.98, 1.02],
    see_through: "",
};
/// Edges are smoothed: there the picture mixes materials, and the frame says how much of the pixel one covers.
const TABLE: Scene = Scene {
    name: "table",
    record: "table",
    holds: [0.8, 1.05],
    see_through: "soda_lime_glass",
};
/// The plan's functions where the camera sees a surface, and the exact law in all later bounces, as plans assume. A pixel is the
/// mean of many samples, and the frame holds means of angles and light.
const ROOM: Scene = Scene {
    name: "room",
    record: "room_first",
    holds: [0.75, 1.25],
    see_through: "",
};
/// The plan's functions in all bounces: mirrors show the errors of what they reflect.
const ROOM_ALL: Scene = Scene {
    record: "room_all",
    ..ROOM
};
/// Differences below this are noise and rounding.
const FLOOR: f64 = 0.02;

/// What is seen of a material in a renderer's pictures.
#[derive(Clone, Debug, PartialEq)]
struct SeenRow {
    material: String,
    method: String,
    /// The 99.9th percentile of ΔE₀₀ over its coverage, and the largest of less than 1000 pixels, as plans measure.
    seen: f64,
}

/// What a plan says of a material.
struct Planned {
    material: String,
    method: String,
    error: f64,
}

fn file(name: &str) -> PathBuf {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/plan/gbuffers");
    PathBuf::from(format!("{folder}/{name}"))
}

impl Scene {
    fn path(self, ending: &str) -> PathBuf {
        file(&format!("{}{ending}", self.name))
    }

    fn csv(self) -> PathBuf {
        file(&format!("{}.csv", self.record))
    }

    fn ids(self) -> MaterialIds {
        let text = fs::read_to_string(self.path(".toml")).unwrap();
        MaterialIds::parse(self.name, &text).unwrap()
    }

    /// The rows of a plan for the committed frame.
    fn plan(self, flags: &[&str]) -> Vec<Planned> {
        let files = [".exr", ".toml"].map(|ending| self.path(ending).display().to_string());
        let files = [
            "plan",
            "--gbuffer",
            &files[0],
            "--materials",
            &files[1],
            "--json",
            "-",
        ];
        let ran = Place::new().run_with(&[&files, flags].concat());
        let report: Value = serde_json::from_str(&ran.out).expect(&ran.err);
        let rows = report["rows"].as_array().unwrap().iter();
        let text = |cell: &Value| cell.as_str().unwrap().to_owned();
        rows.map(|row| Planned {
            material: text(&row["material"]),
            method: text(&row["method"]),
            error: row["error"].as_f64().unwrap(),
        })
        .collect()
    }

    fn recorded(self) -> Vec<SeenRow> {
        let text = fs::read_to_string(self.csv()).unwrap_or_default();
        let row = |line: &str| {
            let cells: Vec<&str> = line.split(',').collect();
            SeenRow {
                material: cells[0].to_owned(),
                method: cells[1].to_owned(),
                seen: cells[2].parse().unwrap(),
            }
        };
        text.lines().skip(1).map(row).collect()
    }

    /// Compares what is seen with the record, within a share; records it when asked to.
    #[track_caller]
    fn check_recorded(self, rows: &[SeenRow], within: f64) {
        if bless::is_on() {
            let lines = rows.iter().map(|row| {
                let SeenRow {
                    material,
                    method,
                    seen,
                } = row;
                format!("{material},{method},{seen:.4}\n")
            });
            let text = "material,method,seen\n".to_owned() + &lines.collect::<String>();
            return bless::check(&self.csv(), text.as_bytes());
        }
        let recorded = self.recorded();
        let names = |rows: &[SeenRow]| -> Vec<(String, String)> {
            let each = rows.iter();
            each.map(|row| (row.material.clone(), row.method.clone()))
                .collect()
        };
        assert_eq!(names(rows), names(&recorded), "BLESS=1 records anew");
        for (row, recorded) in rows.iter().zip(&recorded) {
            let apart = (row.seen - recorded.seen).abs();
            assert!(
                apart <= within * recorded.seen + 1e-4,
                "{row:?} {recorded:?}"
            );
        }
    }
}

/// ΔE₀₀ of two linear colours on a screen that shows 0 to 1.
fn difference(one: DVec3, other: DVec3) -> f64 {
    let lab = |colour: DVec3| {
        let shown = colour.clamp(DVec3::ZERO, DVec3::ONE);
        xyz_to_lab(Space::Srgb.rgb_to_xyz() * shown, Space::Srgb.white())
    };
    ciede2000(lab(one), lab(other))
}

/// What two pictures show of each material, in the order of the map.
fn seen(frame: &FramePixels, one: &[DVec3], other: &[DVec3]) -> Vec<f64> {
    let of_material = |pixels: &Vec<ScenePixel>| {
        let each = pixels.iter().map(|pixel| {
            let place = pixel.place as usize;
            let difference = difference(one[place], other[place]);
            (difference, f64::from(pixel.coverage))
        });
        let mut each: Vec<(f64, f64)> = each.collect();
        each.sort_by(|a, b| a.0.total_cmp(&b.0));
        let share = if each.len() < 1000 { 1.0 } else { 0.999 };
        let whole: f64 = each.iter().map(|(_, coverage)| coverage).sum();
        let mut held = 0.0;
        let reaches = each.iter().find(|(_, coverage)| {
            held += coverage;
            held >= (share - 1e-12) * whole
        });
        reaches.expect("the frame shows each material").0
    };
    frame.of_material.iter().map(of_material).collect()
}

fn rows(ids: &MaterialIds, methods: &BTreeMap<String, String>, seen: &[f64]) -> Vec<SeenRow> {
    let each = ids.materials.iter().zip(seen);
    each.map(|(mapped, seen)| SeenRow {
        material: mapped.material.clone(),
        method: methods[&mapped.material].clone(),
        seen: *seen,
    })
    .collect()
}

/// The error that the plan states for a method is what the renderer's pictures show.
#[test]
fn plans_hold_in_pictures_of_other_renderers() {
    let mut said = String::new();
    for scene in [STATUE, TABLE, ROOM] {
        let recorded = scene.recorded();
        assert_eq!(
            recorded.len(),
            scene.ids().materials.len(),
            "{}",
            scene.name
        );
        let chosen = scene.plan(&[]);
        for row in &recorded {
            let Some(planned) = planned_for(row, chosen.iter()) else {
                panic!("{}: no plan for {}", scene.name, row.material);
            };
            let mut error = planned.error;
            if planned.method != row.method {
                let (
                    name,
                    SeenRow {
                        material, method, ..
                    },
                ) = (scene.name, row);
                not_checked(&format!(
                    "{name}: {material} by {}, since the renderer drew it by {method}; gbuffers/README.md says how to draw it anew",
                    planned.method
                ));
                // Within so small an error is nothing, so that each material gets what errs least, the other one where this does not describe it.
                let methods = format!("constant_f0,{method}");
                let asked = scene.plan(&["--budget", "1e-6", "--method", &methods]);
                error = planned_for(row, asked.iter())
                    .expect("it was asked for")
                    .error;
            }
            let (plan, seen) = (short(error), short(row.seen));
            let line = format!(
                "| {} | {} | {} | {plan} | {seen} |",
                scene.name, row.material, row.method
            );
            if !DOCUMENT.contains(&line) {
                said += &format!("docs/plan.md lacks the line: {line}\n");
            }
            let behind = chosen.iter().map(|planned| planned.error);
            let [least, mut most] = scene.holds.map(|share| share * error);
            if row.material == scene.see_through {
                most = behind.fold(most, f64::max);
            }
            println!("{}: {row:?}, planned {error:.4}", scene.record);
            if !(least - FLOOR..=most + FLOOR).contains(&row.seen) {
                said += &format!("{}: {row:?}, planned {error}\n", scene.record);
            }
        }
    }
    assert!(said.is_empty(), "{said}");
}

/// Two digits behind the point, and none before it that is 0.
fn short(error: f64) -> String {
    let text = format!("{error:.2}");
    text.strip_prefix('0').unwrap_or(&text).to_owned()
}

fn planned_for<'a>(
    row: &SeenRow,
    mut plan: impl Iterator<Item = &'a Planned>,
) -> Option<&'a Planned> {
    plan.find(|planned| planned.material == row.material)
}

/// The colours of three channels of a file.
fn colours(file: &PathBuf, name: &str) -> Vec<DVec3> {
    let image = read_all_flat_layers_from_file(file).unwrap();
    let channels = &image.layer_data[0].channel_data.list;
    let planes = ["R", "G", "B"].map(|letter| {
        let name = format!("{name}.{letter}");
        let mut found = channels
            .iter()
            .filter(|channel| channel.name == *name.as_str());
        let samples = &found.next().unwrap().sample_data;
        samples.values_as_f32().map(f64::from).collect::<Vec<f64>>()
    });
    let [red, green, blue] = planes;
    let pairs = red.iter().zip(&green).zip(&blue);
    pairs.map(|((r, g), b)| DVec3::new(*r, *g, *b)).collect()
}

/// What Mitsuba drew is what is recorded of it: its pictures are committed.
#[test]
fn mitsuba_shows_what_is_recorded() {
    let frame = read_gbuffer(&fs::read(ROOM.path(".exr")).unwrap(), &ROOM.ids()).unwrap();
    let methods = ROOM.recorded().into_iter();
    let methods = methods.map(|row| (row.material, row.method)).collect();
    for scene in [ROOM, ROOM_ALL] {
        let pictures = file(&format!("{}.exr", scene.record));
        let [exact, change] = ["exact", "change"].map(|name| colours(&pictures, name));
        let pairs = exact.iter().zip(&change);
        let chosen: Vec<DVec3> = pairs.map(|(exact, change)| *exact + *change).collect();
        let rows = rows(&scene.ids(), &methods, &seen(&frame, &exact, &chosen));
        scene.check_recorded(&rows, 0.0);
    }
}

#[test]
fn three_js_shows_a_statue_as_recorded() {
    three_js_shows(STATUE, 224, 1);
}

#[test]
fn three_js_shows_a_table_as_recorded() {
    three_js_shows(TABLE, 224, 4);
}

/// The text of three.js, where it is: its two modules.
fn three() -> Option<[String; 2]> {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/target/three/node_modules/three"
    );
    let text = |name: &str| fs::read_to_string(format!("{folder}/{name}")).ok();
    let package: Option<Value> =
        text("package.json").and_then(|text| serde_json::from_str(&text).ok());
    if package.is_some_and(|package| package["version"] == THREE) {
        return Some([text("build/three.module.js")?, text("build/three.core.js")?]);
    }
    let remark = format!(
        "scenes in three.js: no three.js {THREE}; install with: npm install --prefix target/three three@{THREE}"
    );
    assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
    not_checked(&remark);
    None
}

/// Draws a scene anew in a browser, with the functions of a plan for its committed frame.
#[track_caller]
fn three_js_shows(scene: Scene, size: usize, samples: usize) {
    let Some(modules) = three() else { return };
    if !CHROMIUM.is_here("scenes in three.js") {
        return;
    }
    let mut methods: BTreeMap<String, String> = BTreeMap::new();
    for mapped in &scene.ids().materials {
        methods.insert(mapped.material.clone(), "fitted".to_owned());
    }
    // A scene that was never drawn has no frame to plan for: its first frame needs no functions.
    if bless::is_on() {
        let told = drawn(scene, &modules, &methods, size, samples);
        let file = BASE64_STANDARD
            .decode(told["file"].as_str().unwrap())
            .unwrap();
        fs::write(scene.path(".exr"), file).unwrap();
    }
    for planned in scene.plan(&[]) {
        methods.insert(planned.material, planned.method);
    }
    let told = drawn(scene, &modules, &methods, size, samples);
    let file = BASE64_STANDARD
        .decode(told["file"].as_str().unwrap())
        .unwrap();
    let frame = read_gbuffer(&file, &scene.ids()).unwrap();
    let committed = read_gbuffer(&fs::read(scene.path(".exr")).unwrap(), &scene.ids()).unwrap();
    check_alike(&frame, &committed);
    let [exact, chosen] = [0, 1].map(|which| picture(&told["pictures"][which]));
    let rows = rows(&scene.ids(), &methods, &seen(&frame, &exact, &chosen));
    scene.check_recorded(&rows, 0.05);
}

fn picture(told: &Value) -> Vec<DVec3> {
    let bytes = BASE64_STANDARD.decode(told.as_str().unwrap()).unwrap();
    let numbers = bytes
        .chunks_exact(4)
        .map(|four| f64::from(f32::from_le_bytes(four.try_into().unwrap())));
    let numbers: Vec<f64> = numbers.collect();
    numbers.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// Another browser may round otherwise, at edges too.
#[track_caller]
fn check_alike(frame: &FramePixels, committed: &FramePixels) {
    assert_eq!(frame.size, committed.size);
    for (new, old) in frame.of_material.iter().zip(&committed.of_material) {
        let apart = new.len().abs_diff(old.len());
        assert!(100 * apart <= old.len(), "{} {}", new.len(), old.len());
        let mean = |pixels: &[ScenePixel]| {
            let sum: f64 = pixels.iter().map(|pixel| f64::from(pixel.cos_theta)).sum();
            sum / pixels.len() as f64
        };
        assert!((mean(new) - mean(old)).abs() < 2e-3);
    }
}

/// What the page with a scene tells.
fn drawn(
    scene: Scene,
    [module, core]: &[String; 2],
    methods: &BTreeMap<String, String>,
    size: usize,
    samples: usize,
) -> Value {
    const EXR: &str = include_str!("gbuffers/exr.js");
    const SCENES: &str = include_str!("gbuffers/three_scenes.js");
    let address = |text: &str| {
        format!(
            "data:text/javascript;base64,{}",
            BASE64_STANDARD.encode(text)
        )
    };
    let module = module.replace("'./three.core.js'", "'three-core'");
    let imports = json!({ "imports": {
        "three": address(&module), "three-core": address(core), "exr": address(EXR),
    }});
    let each = methods
        .iter()
        .map(|(material, method)| (material.clone(), told_material(material, method)));
    let materials: serde_json::Map<String, Value> = each.collect();
    let job =
        json!({ "scene": scene.name, "size": size, "samples": samples, "materials": materials });
    let page = format!(
        "<!DOCTYPE html><html><head><meta charset=\"utf-8\"><title>{}</title><script type=\"importmap\">{imports}</script></head><body><script>const job = {job};</script></body></html>",
        scene.name
    );
    let hands = format!("<script type=\"module\">{SCENES}</script></html>");
    let flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
    let told = browser::told(&Place::new(), &page, &hands, "", &flags);
    assert_eq!(told["faults"], json!([]), "{}", told["faults"]);
    told
}

/// A material's exact law as a table, and its function as it is shipped.
fn told_material(material: &str, method: &str) -> Value {
    let subject = subjects(&[material]).remove(0);
    let truth = |texel: usize| {
        let cosine = texel as f64 / (TEXELS - 1) as f64;
        subject.reference.at(cosine)
    };
    let numbers = (0..TEXELS).flat_map(truth);
    let bytes: Vec<u8> = numbers
        .flat_map(|number| (number as f32).to_le_bytes())
        .collect();
    let line = format!("--material {material} --method {method} --target gles -o -");
    let text = Place::new().done(&line).out;
    let name = text
        .split("vec3 ")
        .find(|part| part.starts_with("fresnel_"));
    let name = name.and_then(|part| part.split('(').next()).unwrap();
    json!({ "table": BASE64_STANDARD.encode(bytes), "text": text, "name": name })
}

/// What `tests/run` installs is what drew the committed files.
#[test]
fn the_run_of_all_tests_installs_three_js() {
    let run = include_str!("../../run");
    assert!(run.contains(&format!("three@{THREE}")));
}
