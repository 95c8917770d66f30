//! `plan` as users run it: what is chosen and said, the files of a plan, what is refused.

use serde_json::Value;

use super::MY_METAL;
use super::OUT;
use super::Place;

/// A sphere of this material in this light, on few pixels.
fn sphere(material: &str, light: &str) -> String {
    format!(
        "size = [64, 64]\n[camera]\northographic = 2.0\neye = [0, 0, 4]\n[light]\nuniform = {light}\n[[object]]\nbody = \"sphere\"\nextent = 2.0\nmaterial = \"{material}\"\n"
    )
}

/// The same sphere twice, side by side.
const TWO: &str = "size = [128, 64]\n[camera]\northographic = 2.0\neye = [0, 0, 4]\n[light]\nuniform = [1, 1, 1]\n[[object]]\nbody = \"sphere\"\nextent = 2.0\nmaterial = \"gold\"\nat = [-1, 0, 0]\n[[object]]\nbody = \"sphere\"\nextent = 2.0\nmaterial = \"platinum\"\nat = [1, 0, 0]\n";

fn row<'a>(report: &'a Value, material: &str) -> &'a Value {
    let mut rows = report["rows"].as_array().unwrap().iter();
    rows.find(|row| row["material"] == material).unwrap()
}

#[test]
fn light_decides_what_gold_needs() {
    let place = Place::new();
    place.put("white.toml", sphere("gold", "[1, 1, 1]"));
    place.put("dim.toml", sphere("gold", "[0.05, 0.04, 0.0275]"));
    let white = place.done("plan white.toml --json -").json();
    assert_eq!(white["command"], "plan white.toml");
    let chosen = row(&white, "gold");
    assert_eq!(
        (&chosen["method"], &chosen["form"]),
        (&"fitted".into(), &"specialised".into())
    );
    assert!(
        chosen["why"]
            .as_str()
            .unwrap()
            .contains("is the cheapest of")
    );
    // Everything that costs less fails, and by what error.
    let cheaper = chosen["cheaper"].as_array().unwrap();
    assert!(cheaper.len() > 3);
    for one in cheaper {
        assert!(one["error"].as_f64().unwrap() > 1.0, "{one}");
        assert!(one["cost"].as_f64().unwrap() < chosen["cost"].as_f64().unwrap());
    }
    let dim = place.done("plan dim.toml --json -").json();
    assert_eq!(row(&dim, "gold")["method"], "schlick_spherical_gaussian");
    let text = place.done("plan dim.toml").out;
    assert!(
        text.contains("All together") && text.contains("the exact laws"),
        "{text}"
    );
}

#[test]
fn the_files_of_a_plan_are_exactly_its_functions() {
    let place = Place::new();
    place.put("two.toml", TWO);
    place.done("plan two.toml --json plan.json");
    let plan: Value = serde_json::from_str(&place.read("plan.json")).unwrap();
    place.done("--plan plan.json --target gles --depfile plan.d");
    assert_eq!(
        place.listed(),
        ["gles/materials/gold.glsl", "gles/materials/platinum.glsl"]
    );
    assert!(place.read("plan.d").contains("plan.json"));
    for file in place.manifest()["files"].as_array().unwrap() {
        let functions = file["functions"].as_array().unwrap();
        assert_eq!(functions.len(), 1, "{file}");
        let material = file["material"].as_str().unwrap();
        assert_eq!(functions[0]["method"], row(&plan, material)["method"]);
    }
    assert_eq!(place.done("--plan plan.json --target gles --check").out, "");
    // Where functions have a price, one serves both.
    let line = "plan two.toml --method fitted,schlick --variant-cost 1e9 --json shared.json";
    place.done(line);
    let shared: Value = serde_json::from_str(&place.read("shared.json")).unwrap();
    let form = |material: &str| row(&shared, material)["form"].clone();
    assert_eq!([form("gold"), form("platinum")], ["library", "library"]);
    place.done("--plan shared.json --target wgsl --out-dir shared");
    assert!(place.path("shared/wgsl/fresnel_fitted.wgsl").exists());
    assert!(!place.path("shared/wgsl/materials").exists());
    assert!(place.path(OUT).exists());
}

#[test]
fn a_budget_that_nothing_meets_takes_the_best_and_ends_with_1() {
    let place = Place::new();
    place.put("gold.toml", sphere("gold", "[1, 1, 1]"));
    let line = "plan gold.toml --budget 0 --method schlick,fitted --json -";
    let report = place.run(line).ends(1).json();
    let least = row(&report, "gold");
    assert_eq!(
        (&least["method"], &least["is_within"]),
        (&"fitted".into(), &false.into())
    );
    assert!(
        least["why"]
            .as_str()
            .unwrap()
            .starts_with("nothing is within 0 ")
    );
    // Against its own law the exact method errs by nothing.
    let line = "plan gold.toml --budget 0 --reference exact --json -";
    let exact = place.done(line).json();
    assert_eq!(row(&exact, "gold")["error"], 0.0);
}

/// A smaller budget never makes a plan cheaper.
#[test]
fn a_plan_grows_dearer_as_its_budget_shrinks() {
    let place = Place::new();
    place.put("two.toml", TWO);
    let mut last = 0.0;
    for budget in ["20", "5", "2", "1", "0.3", "0.1", "0.01", "0"] {
        let line = format!("plan two.toml --budget {budget} --json -");
        let report = place.run(&line).json();
        let total = report["total"]["cost"].as_f64().unwrap();
        assert!(total >= last, "{budget}: {total} after {last}");
        last = total;
    }
}

#[test]
fn a_material_that_few_pixels_show_is_held_to_every_angle() {
    let place = Place::new();
    place.put(
        "far.toml",
        sphere("gold", "[1, 1, 1]").replace("orthographic = 2.0", "orthographic = 20.0"),
    );
    let report = place.done("plan far.toml --json -").json();
    assert_eq!(row(&report, "gold")["judged_by"], "every_angle");
    let report = place.done("plan far.toml --min-pixels 1 --json -").json();
    assert_eq!(row(&report, "gold")["judged_by"], "largest");
}

#[test]
fn a_users_own_material_is_planned_and_written() {
    let place = Place::new();
    place.put("scenes/mine.toml", MY_METAL);
    place.put("scenes/scene.toml", sphere("mine.toml", "[1, 1, 1]"));
    place.done("plan scenes/scene.toml --json plan.json");
    let plan: Value = serde_json::from_str(&place.read("plan.json")).unwrap();
    assert_eq!(plan["rows"][0]["material"], "scenes/mine.toml");
    place.done("--plan plan.json --target wgsl");
    assert_eq!(place.listed(), ["wgsl/materials/my_metal.wgsl"]);
}

#[test]
fn the_page_shows_each_material_and_replaces_nothing_of_others() {
    let place = Place::new();
    place.put("two.toml", TWO);
    place.done("plan two.toml --out-dir page");
    let page = place.read("page/plan.html");
    for part in [
        "<h2>gold</h2>",
        "<h2>platinum</h2>",
        "exact law",
        "<svg",
        "data:image/png;base64,",
    ] {
        assert!(page.contains(part), "{part}");
    }
    place.done("plan two.toml --out-dir page");
    assert_eq!(page, place.read("page/plan.html"));
    place.put("page/plan.html", "my own words");
    place.refused(
        "plan two.toml --out-dir page",
        &["plan.html", "--overwrite"],
    );
}

#[test]
fn the_chosen_text_is_run_and_holds() {
    let place = Place::new();
    place.put("two.toml", TWO);
    let ran = place.run("plan two.toml --prove --json -");
    if ran.code == Some(3) && std::env::var_os("CI").is_none() {
        crate::not_checked("the proof of a plan");
        return;
    }
    let report = ran.ends(0).json();
    let proofs = report["proofs"].as_array().unwrap();
    assert_eq!(proofs.len(), 4);
    for proof in proofs {
        assert_eq!(proof["status"], "pass", "{proof}");
        let planned = row(&report, proof["material"].as_str().unwrap());
        let [told, shown] = [&planned["error"], &proof["error"]].map(|e| e.as_f64().unwrap());
        assert!((told - shown).abs() < 1e-3, "{proof}");
    }
}

/// Where a body is as bright as its light nobody sees its reflectance.
#[test]
fn what_is_as_bright_as_its_light_needs_no_fresnel() {
    let place = Place::new();
    let scene = sphere("bk7", "[0.4, 0.5, 0.6]") + "other = [0.4, 0.5, 0.6]\n";
    place.put("scene.toml", scene);
    let report = place.done("plan scene.toml --budget 0 --json -").json();
    let chosen = row(&report, "bk7");
    assert_eq!(
        (&chosen["method"], &chosen["error"]),
        (&"constant_f0".into(), &0.0.into())
    );
}

/// On rough platinum no Fresnel is more accurate than Schlick's, and the fitted method than both.
#[test]
fn roughness_decides_on_platinum() {
    let place = Place::new();
    let scene = sphere("platinum", "[1, 1, 1]") + "roughness = 0.8\n";
    place.put("scene.toml", scene);
    let error = |method: &str| {
        let line = format!("plan scene.toml --budget 100 --method {method} --json -");
        row(&place.done(&line).json(), "platinum")["error"]
            .as_f64()
            .unwrap()
    };
    let [constant, schlick, fitted] = ["constant_f0", "schlick", "fitted"].map(error);
    assert!(
        fitted < 0.2 && 5.0 * fitted < constant && constant < schlick,
        "{constant} {schlick} {fitted}"
    );
}

/// A range of exposures never makes an error smaller.
#[test]
fn more_exposures_show_no_less() {
    let place = Place::new();
    place.put("scene.toml", sphere("gold", "[0.3, 0.3, 0.3]"));
    let error = |range: &str| {
        let line = format!(
            "plan scene.toml --budget 100 --method schlick --exposure-range {range} --json -"
        );
        row(&place.done(&line).json(), "gold")["error"]
            .as_f64()
            .unwrap()
    };
    let errors = ["0", "1", "2", "4"].map(error);
    assert!(errors.is_sorted() && errors[3] > errors[0], "{errors:?}");
}

/// Files that a scene or a plan names are read too: no output takes the place of one.
#[test]
fn what_a_scene_reads_is_not_overwritten() {
    let place = Place::new();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    place.put("triangle.obj", triangle);
    place.put("mine.toml", MY_METAL);
    let scene =
        sphere("mine.toml", "[1, 1, 1]").replace("body = \"sphere\"", "mesh = \"triangle.obj\"");
    place.put("scene.toml", scene);
    for file in ["triangle.obj", "mine.toml", "scene.toml"] {
        let line = format!("plan scene.toml --json {file}");
        place.refused(&line, &[file, "this run reads that file"]);
    }
    place.done("plan scene.toml --json plan.json");
    for file in ["mine.toml", "plan.json"] {
        let line = format!("--plan plan.json --target gles -o {file}");
        place.refused(&line, &[file, "this run reads that file"]);
    }
}

/// A library function is called with values, which the plan states.
#[test]
fn a_shared_function_comes_with_its_values() {
    let place = Place::new();
    place.put("two.toml", TWO);
    let line = "plan two.toml --method schlick --variant-cost 1e9 --budget 50 --json -";
    let report = place.done(line).json();
    let f0 = &row(&report, "gold")["values"]["f0"];
    assert_eq!(f0.as_array().unwrap().len(), 3);
    let red = f0[0].as_f64().unwrap();
    assert!((0.99..1.1).contains(&red), "{f0}");
    let line = "plan two.toml --json -";
    assert!(
        row(&place.done(line).json(), "gold")
            .get("values")
            .is_none()
    );
}

/// Parallel rays see the same wherever they start.
#[test]
fn an_orthographic_camera_may_stand_anywhere() {
    let place = Place::new();
    let pixels = |eye: &str| {
        let scene = sphere("gold", "[1, 1, 1]").replace("eye = [0, 0, 4]", eye);
        place.put("scene.toml", scene);
        row(
            &place
                .done("plan scene.toml --method fitted --json -")
                .json(),
            "gold",
        )["pixels"]
            .clone()
    };
    let near = pixels("eye = [0, 0, 4]");
    assert_eq!(near, pixels("eye = [0, 0, 900000]"));
    assert_eq!(near, pixels("eye = [0, 0, 0.5]"));
}

#[test]
fn what_is_no_plan_is_refused() {
    let place = Place::new();
    place.put("gold.toml", sphere("gold", "[1, 1, 1]"));
    place.put("broken.json", "{\"tool\": \"fresnel-gen\",\n\"rows\": [");
    place.put(
        "other.json",
        "{\"tool\": \"fresnel-gen\", \"schema\": 1, \"command\": \"cost\", \"space\": \"srgb\", \"rows\": []}",
    );
    place.refused("--plan broken.json", &["broken.json:2:", "this is no plan"]);
    place.refused(
        "--plan other.json",
        &["other.json:1:1", "no plan with functions"],
    );
    let row = "{\"material\": \"gold\", \"method\": \"schlick\", \"form\": \"specialised\", \"precision\": \"f32\"}";
    let plan = |rows: &str| {
        format!(
            "{{\"tool\": \"fresnel-gen\", \"schema\": 1, \"command\": \"plan x.toml\", \"space\": \"srgb\", \"rows\": [{rows}]}}"
        )
    };
    let faults = [
        (format!("{row}, {row}"), "row 2 (gold): another row"),
        (
            row.replace("\"gold\"", "\"glod\""),
            "row 1 (glod): there is no material",
        ),
        (
            row.replace("schlick", "dielectric_exact_p"),
            "row 1 (gold): no plan chooses",
        ),
        (
            row.replace("specialised", "average"),
            "row 1 (gold): no plan chooses",
        ),
        (
            row.replace("schlick", "schlock"),
            "row 1 (gold): there is no method",
        ),
    ];
    for (rows, says) in faults {
        place.put("edited.json", plan(&rows));
        place.refused("--plan edited.json", &["edited.json: ", says]);
    }
    place.put(
        "edited.json",
        plan(row).replace("\"schema\": 1", "\"schema\": 2"),
    );
    place.refused(
        "--plan edited.json",
        &["edited.json:1:1", "no plan with functions"],
    );
    place.refused("--plan plan.json --material gold", &["--material"]);
    place.refused("plan gold.toml --budget -1", &["--budget is -1"]);
    place.refused(
        "plan gold.toml --exposure-range 9",
        &["--exposure-range is 9"],
    );
    place.refused("plan gold.toml --metric de76", &["de76", "de2000"]);
    place.refused("plan gold.toml --channels 2", &["2"]);
    place.refused("plan", &["SCENE"]);
    place.refused("plan nowhere.toml", &["nowhere.toml"]);
}

/// Scenes in which nothing is in sight, or nothing that could be planned; a glTF whose dielectric has an index and no name.
#[test]
fn what_a_scene_does_not_show_is_not_planned() {
    let place = Place::new();
    let away = sphere("gold", "[1, 1, 1]").replace(
        "orthographic = 2.0",
        "vertical_degrees = 20\nat = [0, 0, 9]",
    );
    place.put("away.toml", away);
    place.refused(
        "plan away.toml",
        &["away.toml:2:1", "no frame shows anything"],
    );
    let numbers: Vec<u8> = [-1.0f32, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0]
        .into_iter()
        .flat_map(f32::to_le_bytes)
        .collect();
    place.put("scene.bin", numbers);
    let file = |metallic: u32| {
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}},\"material\":0}}]}}],\"materials\":[{{\"name\":\"Paint\",\"pbrMetallicRoughness\":{{\"metallicFactor\":{metallic}}}}}],\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":36}}],\"buffers\":[{{\"byteLength\":36,\"uri\":\"scene.bin\"}}]}}"
        )
    };
    place.put("metal.gltf", file(1));
    place.refused(
        "plan metal.gltf --size 64x48",
        &["metal.gltf: no frame shows", "`Paint`: ", "Schlick"],
    );
    place.put("paint.gltf", file(0));
    let report = place.done("plan paint.gltf --size 64x48 --json -").json();
    assert_eq!(report["frames"], 36);
    assert_eq!(row(&report, "ior_1_5")["form"], "library");
}
