//! The flavours `playcanvas` and `babylon` in their engines: F of lamps, image light and area lights against the CPU, a white furnace,
//! what is refused.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::coefficients;
use super::host::Host;
use super::host::number;
use super::host::shows_a_gold_sphere;
use super::{FILMS, two_interfaces};
use crate::catalogue::evaluated;
use crate::compensation::compensation;
use fresnel_gen::generator::lut::{Depth, SplitSum, SplitSumAxis, SplitSumDesign, StoredSplitSum};
use fresnel_gen::language::ir::Weights;
use fresnel_gen::language::methods;

const PLAYCANVAS: Host = Host {
    flavour: "playcanvas",
    folder: "engines",
    package: "playcanvas",
    stands_for: None,
    version: "2.23.3",
    page: include_str!("playcanvas/page.html"),
    scripts: &[],
    hands: concat!(
        "<script>",
        include_str!("playcanvas/hands.js"),
        "</script></html>"
    ),
    bundled: Some(include_str!("playcanvas/entry.js")),
    materials: "gold,water,anodised_titanium_purple,oil_on_water",
};

const BABYLON: Host = Host {
    flavour: "babylon",
    folder: "engines",
    package: "@babylonjs/core",
    stands_for: None,
    version: "9.35.0",
    page: include_str!("babylon/page.html"),
    scripts: &[],
    hands: concat!(
        "<script>",
        include_str!("babylon/hands.js"),
        "</script></html>"
    ),
    bundled: Some(include_str!("babylon/entry.js")),
    materials: "gold,water,anodised_titanium_purple,oil_on_water",
};

/// The oldest versions that the adapters say they know.
const OLDEST: [Host; 2] = [
    Host {
        package: "playcanvas-oldest",
        stands_for: Some("playcanvas"),
        version: "2.8.2",
        ..PLAYCANVAS
    },
    Host {
        package: "babylon-oldest",
        stands_for: Some("@babylonjs/core"),
        version: "9.0.0",
        ..BABYLON
    },
];

/// What is asked of an engine; what was seen is a thousandth of it.
const CLOSE: f64 = 1e-3;

/// A material of a page, with the tables of its method.
struct Material {
    method: &'static str,
    coefficients: Vec<f32>,
    /// What the channels of the tables are multiplied by.
    numbers: Vec<[f64; 3]>,
    table: StoredSplitSum,
}

impl Material {
    fn new(method: &'static str, coefficients: Vec<f32>) -> Material {
        let basis = methods::find(method).unwrap().basis().unwrap();
        let axes = [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt];
        let design = SplitSumDesign::square(basis, 80, axes);
        let rows = coefficients.chunks_exact(3);
        let rows: Vec<[f64; 3]> = rows.map(|c| [c[0], c[1], c[2]].map(f64::from)).collect();
        let table = SplitSum::new(&design, &mut |_, _| {}).unwrap();
        Material {
            method,
            coefficients,
            numbers: design.numbers(&rows),
            table: table.stored(Depth::Half),
        }
    }

    fn f(&self, cos: f64) -> [f64; 3] {
        evaluated(self.method, &self.coefficients, &[cos])[0]
    }

    fn terms(&self, cos: f64, roughness: f64) -> [f64; 8] {
        self.table.lookup(Weights::Exact, cos, roughness)
    }

    /// What an image is multiplied by, once reflected.
    fn image(&self, cos: f64, roughness: f64) -> [f64; 3] {
        let terms = self.terms(cos, roughness);
        sum(self.numbers.iter().copied(), &terms).map(|value| value.clamp(0.0, terms[0]))
    }

    /// What gives back the light that is reflected more than once.
    fn compensation(&self, cos: f64, roughness: f64) -> [f64; 3] {
        let basis = methods::find(self.method).unwrap().basis().unwrap();
        let rows = self.coefficients.chunks_exact(3);
        let rows = rows.map(|c| [c[0], c[1], c[2]].map(f64::from));
        let average = sum(rows, &basis.averages()).map(|mean| mean.clamp(0.0, 1.0));
        let white = self.terms(cos, roughness)[0];
        compensation(self.image(cos, roughness), white, average, roughness)
    }
}

/// The sum of colours times these.
fn sum(colours: impl Iterator<Item = [f64; 3]>, terms: &[f64]) -> [f64; 3] {
    let products = colours.zip(terms);
    products.fold([0.0; 3], |sum, (colour, term)| {
        [0, 1, 2].map(|i| sum[i] + colour[i] * term)
    })
}

fn materials() -> BTreeMap<&'static str, Material> {
    let names = ["gold", "water", FILMS[0], FILMS[1]];
    let rows = names.into_iter().zip(coefficients(&names));
    let mut all: BTreeMap<&str, Material> = rows
        .map(|(name, (method, coefficients))| (name, Material::new(method, coefficients)))
        .collect();
    let white = [1.0; 3].into_iter().chain([0.0; 9]).collect();
    all.insert("white", Material::new("fitted", white));
    all
}

/// A pixel of a page, and what it was drawn with.
struct Reading<'a> {
    told: &'a Value,
    name: &'a str,
    kind: &'a str,
    cos: f64,
    roughness: f64,
    rgb: [f64; 3],
}

impl<'a> Reading<'a> {
    fn new(told: &'a Value) -> Reading<'a> {
        let gloss = told["gloss"].as_f64().map(|gloss| 1.0 - gloss);
        Reading {
            told,
            name: told["name"].as_str().unwrap(),
            kind: told["kind"].as_str().unwrap(),
            cos: number(&told["angle"]).cos(),
            roughness: gloss.unwrap_or_else(|| number(&told["roughness"])),
            rgb: [0, 1, 2].map(|i| told["rgb"][i].as_f64().unwrap_or(f64::NAN)),
        }
    }

    fn is(&self, flag: &str) -> bool {
        self.told[flag].as_bool().unwrap_or(false)
    }

    /// What a reading has in common with that of the white material.
    fn key(&self) -> String {
        let told = self.told;
        let (clustered, stretched, energy) =
            (&told["clustered"], &told["is_anisotropic"], &told["energy"]);
        format!(
            "{} {clustered} {stretched} {energy} {} {:.4}",
            self.kind, self.roughness, self.cos
        )
    }
}

fn apart(one: [f64; 3], other: [f64; 3]) -> f64 {
    let each = one.iter().zip(other).map(|(a, b)| (a - b).abs());
    each.fold(0.0, |most, value| if value <= most { most } else { value })
}

fn each(a: [f64; 3], b: [f64; 3], f: fn(f64, f64) -> f64) -> [f64; 3] {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])]
}

fn ratio(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    each(a, b, |a, b| a / b)
}

fn product(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    each(a, b, |a, b| a * b)
}

/// All readings but those of variants, which must be drawn only. How many of each kind were held.
#[track_caller]
fn held(told: &Value) -> BTreeMap<String, usize> {
    let materials = materials();
    let readings: Vec<Reading> = told["readings"]
        .as_array()
        .unwrap()
        .iter()
        .map(Reading::new)
        .collect();
    let is_lit = |reading: &&Reading| {
        !["is_furnace", "is_variant", "is_coated"]
            .iter()
            .any(|flag| reading.is(flag))
    };
    let white: BTreeMap<String, [f64; 3]> = readings
        .iter()
        .filter(|reading| reading.name == "white" && is_lit(reading))
        .map(|reading| (reading.key(), reading.rgb))
        .collect();
    let (mut counts, mut engine) = (BTreeMap::new(), 0.0);
    for reading in &readings {
        let material = &materials[reading.name];
        let (what, off) = if reading.is("is_variant") {
            let is_drawn = reading.rgb.iter().all(|value| value.is_finite());
            ("variant", if is_drawn { 0.0 } else { f64::NAN })
        } else if reading.is("is_furnace") {
            // Metals have no diffuse light that could make up for what they do not reflect.
            let is_whole = !["gold", FILMS[0]].contains(&reading.name);
            (
                "furnace",
                if is_whole {
                    apart(reading.rgb, [1.0; 3])
                } else {
                    0.0
                },
            )
        } else if reading.is("is_coated") {
            ("coated", 0.0)
        } else if reading.is("plain") {
            // The engine's own F is another one: a patch that does nothing would be seen.
            let seen = ratio(reading.rgb, white[&reading.key()]);
            engine = f64::max(engine, apart(seen, material.f(reading.cos)));
            ("engine", 0.0)
        } else {
            let white = white[&reading.key()];
            (
                reading.kind,
                off(reading, material, &materials["white"], white),
            )
        };
        assert!(
            off <= if what == "furnace" { 0.002 } else { CLOSE },
            "{what}: off by {off}: {}",
            reading.told
        );
        *counts.entry(what.to_owned()).or_default() += 1;
    }
    assert!(engine > 0.01, "the engine's own F is off by {engine} only");
    counts
}

/// How far a reading is from the CPU's, as a share of what the white material shows, or for images as it is.
fn off(reading: &Reading, material: &Material, all: &Material, white: [f64; 3]) -> f64 {
    let (cos, roughness, rgb) = (reading.cos, reading.roughness, reading.rgb);
    let is_compensated = reading.told["energy"].as_bool();
    let lobe = |roughness: f64| {
        let most = material.terms(cos, roughness)[0];
        material.image(cos, roughness).map(|value| value / most)
    };
    match (reading.kind, is_compensated) {
        ("image", None) => apart(ratio(rgb, white), lobe(roughness)).max(apart(white, [1.0; 3])),
        ("image", Some(false)) => apart(rgb, material.image(cos, roughness)),
        ("image", Some(true)) => {
            let want = product(
                material.image(cos, roughness),
                material.compensation(cos, roughness),
            );
            apart(rgb, want)
        }
        // PlayCanvas takes the square of the roughness for area lights.
        ("rectangle", _) if reading.told["gloss"].is_number() => {
            apart(ratio(rgb, white), lobe(roughness * roughness))
        }
        ("rectangle", _) => apart(ratio(rgb, white), lobe(roughness)),
        (_, energy) => {
            let seen = ratio(rgb, white);
            let seen = match energy {
                Some(true) => {
                    let [ours, whites] =
                        [material, all].map(|one| one.compensation(cos, roughness));
                    product(seen, ratio(whites, ours))
                }
                _ => seen,
            };
            apart(seen, material.f(cos))
        }
    }
}

#[track_caller]
fn refuses(told: &Value, keys: &[&str]) {
    let unknown = told["unknown"].as_str().unwrap();
    assert!(
        unknown.contains("glod") && unknown.contains("\"gold\""),
        "{unknown}"
    );
    for key in keys {
        let said = told[*key].as_str().unwrap_or_default();
        assert!(said.len() > 20 && said != "nothing", "{key}: {said}");
    }
}

#[track_caller]
fn is_shown(host: &Host, backend: &str, kinds: &[&str], refused: &[&str]) {
    let Some(told) = host.proof(&format!("?backend={backend}")) else {
        return;
    };
    assert_eq!(told["faults"], json!([]), "{}", told["faults"]);
    assert!(told["version"].as_str().unwrap().starts_with(host.version));
    let counts = held(&told);
    for kind in kinds {
        assert!(
            counts.get(*kind).is_some_and(|count| *count >= 8),
            "{kind}: {counts:?}"
        );
    }
    refuses(&told, refused);
    assert_eq!(told["again"], true);
    coats_are_better(&told);
}

const KINDS_OF_PLAYCANVAS: [&str; 6] = [
    "directional",
    "spot",
    "image",
    "rectangle",
    "furnace",
    "variant",
];
const KINDS_OF_BABYLON: [&str; 5] = ["directional", "image", "rectangle", "furnace", "variant"];
const REFUSED_BY_PLAYCANVAS: [&str; 5] = [
    "option",
    "foreign",
    "without_engine",
    "without_chunk",
    "without_place",
];
const REFUSED_BY_BABYLON: [&str; 5] = [
    "option",
    "foreign",
    "without_engine",
    "without_include",
    "without_place",
];

#[test]
fn playcanvas_by_webgl() {
    is_shown(
        &PLAYCANVAS,
        "webgl2",
        &KINDS_OF_PLAYCANVAS,
        &REFUSED_BY_PLAYCANVAS,
    );
}

#[test]
fn playcanvas_by_webgpu() {
    is_shown(
        &PLAYCANVAS,
        "webgpu",
        &KINDS_OF_PLAYCANVAS,
        &REFUSED_BY_PLAYCANVAS,
    );
}

#[test]
fn babylon_by_webgl() {
    is_shown(&BABYLON, "webgl2", &KINDS_OF_BABYLON, &REFUSED_BY_BABYLON);
}

/// Below a clear coat the patch for a coat is nearer to two interfaces than one without it, and than the engine alone.
#[track_caller]
fn coats_are_better(told: &Value) {
    let readings = told["readings"].as_array().unwrap().iter();
    let coated: Vec<Reading> = readings
        .map(Reading::new)
        .filter(|one| one.is("is_coated"))
        .collect();
    let mean = |wanted: &dyn Fn(&Reading) -> bool| {
        let chosen = coated.iter().filter(|one| wanted(one));
        let off: Vec<f64> = chosen
            .map(|one| apart(one.rgb, two_interfaces("gold", one.cos)))
            .collect();
        off.iter().sum::<f64>() / off.len() as f64
    };
    let ours = mean(&|one| one.told["coat"].is_number());
    let bare = mean(&|one| !one.is("plain") && one.told["coat"].is_null());
    let engine = mean(&|one| one.is("plain"));
    println!(
        "gold under a coat: {ours:.4}; patched as in air {bare:.4}; the engine's own {engine:.4}"
    );
    assert!(
        ours < 0.015 && bare > 1.5 * ours && engine > 3.0 * ours,
        "{ours} {bare} {engine}"
    );
}

#[test]
fn the_oldest_versions_take_it_too() {
    let [playcanvas, babylon] = &OLDEST;
    is_shown(
        playcanvas,
        "webgl2&few",
        &KINDS_OF_PLAYCANVAS,
        &REFUSED_BY_PLAYCANVAS,
    );
    is_shown(
        babylon,
        "webgl2&few",
        &KINDS_OF_BABYLON,
        &REFUSED_BY_BABYLON,
    );
}

#[test]
fn babylon_by_webgpu() {
    is_shown(&BABYLON, "webgpu", &KINDS_OF_BABYLON, &REFUSED_BY_BABYLON);
}

#[test]
fn the_page_of_playcanvas_shows_a_gold_sphere() {
    if let Some(picture) = PLAYCANVAS.readme_page() {
        shows_a_gold_sphere(&picture);
    }
}

#[test]
fn the_page_of_babylon_shows_a_gold_sphere() {
    if let Some(picture) = BABYLON.readme_page() {
        shows_a_gold_sphere(&picture);
    }
}
