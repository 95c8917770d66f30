//! The keys of every report, with the kinds of their values. A value that is null says nothing of its kind. The values of reports
//! that are the same on every machine are kept whole, in `values/`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use serde_json::Value;

use crate::cli::{OUT, Place, Ran};
use crate::not_checked;

/// A name in the list, and a command whose stdout is the report.
const REPORTS: [(&str, &str); 26] = [
    ("methods", "methods --json -"),
    ("methods show", "methods show fitted --json -"),
    ("targets", "targets --json -"),
    ("targets show", "targets show gles --json -"),
    ("materials list", "materials list --json -"),
    ("materials params", "materials params gold --json -"),
    (
        "materials compare",
        "materials compare silver gold --json -",
    ),
    (
        "materials reflectance",
        "materials reflectance gold --angles 0,60,90 --json -",
    ),
    (
        "materials reflectance by wavelength",
        "materials reflectance gold --angles 0,60 --wavelengths 450,650 --json -",
    ),
    (
        "materials coat",
        "materials coat --f0 1,.71,.29 --f82 .98,.91,.66 --json -",
    ),
    ("fit", "fit --material gold --json -"),
    (
        "fit of colours",
        "fit --f0 1,.71,.29 --f82 .98,.91,.66 --json -",
    ),
    ("bake", "bake --material gold --json - --out-dir baked"),
    (
        "bake of a split-sum table",
        "bake --dfg --size 8 --json - --out-dir baked",
    ),
    ("chart", "chart --material gold --json -"),
    ("stability", "stability --method schlick --json -"),
    ("reproduce", "reproduce table3 --json -"),
    ("cost", "cost --gpu adreno330 --method schlick --json -"),
    (
        "verify",
        "verify --target wgsl --method schlick --material gold --points 500 --json -",
    ),
    (
        "verify of a shard",
        "verify --target wgsl --method schlick --material gold --points 500 --shards 2 --shard 0 --json -",
    ),
    (
        "time",
        "time --method schlick --material none --precision f32 --size 32 --operations 1000 --rounds 5 --json -",
    ),
    (
        "scene-error",
        "scene-error cube --material gold --method schlick --size 16x16 --frames 1 --json -",
    ),
    ("render", "render double_refraction --size 16 --json -"),
    ("compare", "compare gold:coat --size 64 --json -"),
    ("plan", "plan scene.toml --prove --json -"),
    (
        "audit",
        "audit mine.wgsl --function schlick --material gold --gpu rdna2 --json -",
    ),
];

/// Reports of [`REPORTS`] whose values no machine has a part in: neither its graphics stacks, nor its compilers, nor its clock.
const SAME_EVERYWHERE: [&str; 19] = [
    "compare",
    "methods",
    "methods show",
    "targets",
    "targets show",
    "materials params",
    "materials compare",
    "materials reflectance",
    "materials reflectance by wavelength",
    "materials coat",
    "fit",
    "fit of colours",
    "bake",
    "bake of a split-sum table",
    "chart",
    "stability",
    "reproduce",
    "cost",
    "scene-error",
];

const SCENE: &str = "size = [32, 32]\n[camera]\northographic = 2.0\neye = [0, 0, 4]\n[light]\nuniform = [1, 1, 1]\n[[object]]\nbody = \"sphere\"\nextent = 2.0\nmaterial = \"gold\"\n";

const MINE: &str = "fn schlick(c: f32, f0: vec3<f32>) -> vec3<f32> {\n    let m = clamp(1.0 - c, 0.0, 1.0);\n    return f0 + (1.0 - f0) * m * m * m * m * m;\n}\n";

/// Enters the keys of a value below a path.
fn enter(path: &str, value: &Value, found: &mut BTreeMap<String, BTreeSet<&'static str>>) {
    let kind = match value {
        Value::Null => None,
        Value::Bool(_) => Some("yes or no"),
        Value::Number(_) => Some("number"),
        Value::String(_) => Some("text"),
        Value::Array(_) => Some("list"),
        Value::Object(_) => Some("object"),
    };
    found.entry(path.to_owned()).or_default().extend(kind);
    match value {
        Value::Array(all) => all
            .iter()
            .for_each(|one| enter(&format!("{path}[]"), one, found)),
        Value::Object(all) => all
            .iter()
            .for_each(|(key, one)| enter(&format!("{path}.{key}"), one, found)),
        _ => {}
    }
}

fn lines(name: &str, report: &Value) -> Vec<String> {
    let mut found = BTreeMap::new();
    enter("", report, &mut found);
    let kinds = |kinds: &BTreeSet<&str>| match kinds.len() {
        0 => "null".to_owned(),
        _ => kinds.iter().copied().collect::<Vec<_>>().join(" or "),
    };
    let keys = found.iter().filter(|(path, _)| !path.is_empty());
    keys.map(|(path, all)| format!("{name}: {} = {}", path.trim_start_matches('.'), kinds(all)))
        .collect()
}

/// The lines of a report in the committed list, for a command that lacks something here.
fn committed(name: &str) -> Vec<String> {
    let text =
        fs::read_to_string(super::root().join("tests/it/snapshots/json.txt")).unwrap_or_default();
    let head = format!("{name}: ");
    text.lines()
        .filter(|line| line.starts_with(&head))
        .map(str::to_owned)
        .collect()
}

/// Whether an audit could not ask the GPU's compiler: its costs are null then.
fn lacks_compiler(audit: &Value) -> bool {
    audit["rows"][0]["cost"][0]["compiler"].is_null()
}

/// Whether another compiler that gives an opinion is not here: the reason is text then.
fn lacks_opinion(verify: &Value) -> bool {
    let rows = verify["rows"].as_array().into_iter().flatten();
    let mut opinions = rows.flat_map(|row| row["second_opinions"].as_array().into_iter().flatten());
    opinions.any(|opinion| opinion["reason"].is_string())
}

#[test]
fn the_keys_of_every_report_are_the_committed_ones() {
    let place = Place::new();
    place.put("mine.wgsl", MINE);
    place.put("scene.toml", SCENE);
    let mut all = Vec::new();
    for (name, line) in REPORTS {
        let ran: Ran = place.run(line);
        let lacks = ran.code == Some(3)
            || name == "audit" && lacks_compiler(&ran.json())
            || name.starts_with("verify") && lacks_opinion(&ran.json());
        if lacks && std::env::var_os("CI").is_none() {
            not_checked(&format!("the JSON keys of {line}: {}", ran.err));
            all.extend(committed(name));
            continue;
        }
        assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
        if SAME_EVERYWHERE.contains(&name) {
            let kept = format!("tests/it/snapshots/values/{}.json", name.replace(' ', "_"));
            crate::bless::check(&super::root().join(kept), ran.out.as_bytes());
        }
        let mut report = ran.json();
        // What a machine has and lacks has names of its own.
        if let Some(machine) = report.get_mut("machine").and_then(Value::as_object_mut) {
            machine
                .values_mut()
                .for_each(|own| *own = Value::Object(Default::default()));
        }
        all.extend(lines(name, &report));
    }
    place.done("--target gles,spirv --material gold");
    all.extend(lines("manifest.json", &place.manifest()));
    // The test `golden` holds these to what a run writes.
    for (name, file) in [
        ("catalogue.json", "catalogue.json"),
        ("lut/NAME.json", "lut/gold.json"),
        ("lut/atlas.json", "lut/atlas.json"),
    ] {
        let text = fs::read_to_string(super::root().join(OUT).join(file)).unwrap();
        all.extend(lines(name, &serde_json::from_str(&text).unwrap()));
    }
    super::check("json", &all);
}
