//! `materials params --as`: every format written for five materials, its numbers, its errors, and read by tools that are not ours.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::Place;
use super::Ran;
use crate::flavours::two_interfaces;
use crate::not_checked;
use fresnel_gen::generator::exchange;
use fresnel_gen::physics::optics;

/// A coloured metal, a white one, two dielectrics, a semiconductor.
const MATERIALS: [&str; 5] = ["gold", "silver", "water", "bk7", "silicon"];

/// The packages that read the formats, as `tests/run` installs them, and where to.
const MATERIALX: &str = "MaterialX==1.39.5";
const USD: &str = "usd-core==26.11";
const GLTF: &str = "gltf-validator@2.0.0-dev.3.10";
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/target/exchange");

fn written(place: &Place, material: &str, format: &str) -> Ran {
    place.done(&format!("materials params {material} --as {format}"))
}

/// The error that a text states of a node.
#[track_caller]
fn stated(text: &str, node: &str) -> f64 {
    let joined = joined(text);
    let after = |from: &str, mark: &str| from.split_once(mark).map(|(_, rest)| rest.to_owned());
    let rest = after(&joined, &format!("{node} computes "))
        .and_then(|rest| after(&rest, "error at most "));
    let rest = rest.unwrap_or_else(|| panic!("no error of {node} in {text}"));
    let number = rest.split_whitespace().next().unwrap();
    number
        .parse()
        .unwrap_or_else(|_| panic!("{number} in {text}"))
}

/// Lines of comments that were broken, as one.
fn joined(text: &str) -> String {
    let bare = text
        .lines()
        .map(|line| line.trim_start_matches(['#', '/', ' ', '"']));
    bare.collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn near(got: f64, want: f64, within: f64) {
    assert!((got - want).abs() <= within, "{got} is not {want}");
}

fn toml(text: &str) -> toml::Table {
    text.parse()
        .unwrap_or_else(|fault| panic!("{fault} in {text}"))
}

fn params(place: &Place, material: &str) -> Value {
    place
        .done(&format!("materials params {material} --json -"))
        .json()
}

/// Every format of every material is written, says how, and is the same again.
#[test]
fn every_format_is_written_of_every_class() {
    let place = Place::new();
    for format in exchange::ALL {
        for material in MATERIALS {
            let ran = written(&place, material, format.name);
            let text = &ran.out;
            for says in [
                "fresnel-gen",
                &format!(
                    "fresnel-gen materials params {material} --as {}",
                    format.name
                ),
                material,
                "CC0-1.0",
                "linear sRGB",
                "error at most",
            ] {
                assert!(joined(text).contains(says), "{says} is not in {ran:?}");
            }
            assert_eq!(written(&place, material, format.name).out, *text);
            assert!(text.ends_with('\n') && !text.contains("NaN"), "{text}");
        }
    }
}

#[test]
fn metals_have_f0_and_its_tint() {
    let place = Place::new();
    let silver = params(&place, "silver");
    let green = silver["f0"][1].as_f64().unwrap();
    let text = written(&place, "silver", "openpbr").out;
    let surface = &toml(&text)["open_pbr_surface"];
    near(surface["base_color"][1].as_float().unwrap(), green, 6e-6);
    let tint = silver["f82_tint"][1].as_f64().unwrap();
    near(
        surface["specular_color"][1].as_float().unwrap(),
        tint.min(1.0),
        2e-5,
    );
    assert_eq!(surface["base_metalness"].as_float(), Some(1.0));
    // Gold's red is clipped, and said to be.
    let ran = written(&place, "gold", "gltf");
    let gold = &ran.json()["materials"][0]["pbrMetallicRoughness"];
    assert_eq!(gold["baseColorFactor"][0], 1.0);
    assert_eq!(gold["baseColorFactor"][3], 1.0);
    for text in [&ran.err, &joined(&ran.out)] {
        assert!(
            text.contains("the colour at normal incidence is (1.0")
                && text.contains("clipped to [0, 1]"),
            "{ran:?}"
        );
    }
    let blender = written(&place, "gold", "blender").out;
    for line in [
        "node.inputs[\"Metallic\"].default_value = 1.0",
        "node.inputs[\"Specular Tint\"].default_value = (",
        "node.fresnel_type = \"F82\"",
        "node.inputs[\"Edge Tint\"].default_value = (",
    ] {
        assert!(blender.contains(line), "{blender}");
    }
    // #rrggbb: red is 1, and the rest as the transfer function has it.
    assert!(joined(&blender).contains("F0 in sRGB: #ff"), "{blender}");
    let wide = place
        .done("materials params gold --as blender --space acescg")
        .out;
    assert!(!wide.contains("F0 in sRGB"), "{wide}");
}

/// BK7: n_d = 1.5168, Abbe number 64.17, F0 about .0421.
#[test]
fn dielectrics_have_what_each_format_makes_of_the_index() {
    let place = Place::new();
    let gltf = written(&place, "bk7", "gltf").json();
    let extensions = &gltf["materials"][0]["extensions"];
    let number = |name: &str, key: &str| extensions[name][key].as_f64().unwrap();
    near(number("KHR_materials_ior", "ior"), 1.5168, 5e-6);
    near(
        number("KHR_materials_dispersion", "dispersion"),
        20.0 / 64.17,
        5e-5,
    );
    near(
        extensions["KHR_materials_specular"]["specularColorFactor"][1]
            .as_f64()
            .unwrap(),
        1.0,
        0.01,
    );
    assert_eq!(gltf["extensionsUsed"].as_array().map(Vec::len), Some(5));
    let unreal = toml(&written(&place, "bk7", "unreal").out);
    near(
        unreal["default_lit"]["Specular"].as_float().unwrap(),
        0.0421 / 0.08,
        2e-3,
    );
    let text = written(&place, "bk7", "filament").out;
    // Beside `reflectance`, `ior` would not count.
    assert!(
        text.contains("material.ior = 1.5168;") && !text.contains("material.reflectance"),
        "{text}"
    );
    let openpbr = toml(&written(&place, "bk7", "openpbr").out);
    let surface = &openpbr["open_pbr_surface"];
    near(surface["specular_ior"].as_float().unwrap(), 1.5168, 5e-6);
    near(
        surface["transmission_dispersion_abbe_number"]
            .as_float()
            .unwrap(),
        64.17,
        0.01,
    );
    assert!(
        written(&place, "bk7", "usd")
            .out
            .contains("int inputs:useSpecularWorkflow = 1\n")
    );
    // Diamond reflects more than Default Lit can say.
    let ran = written(&place, "diamond", "unreal");
    assert!(
        ran.err.contains("Specular 2.1") && ran.err.contains("limited to 1"),
        "{ran:?}"
    );
    assert!(joined(&ran.out).contains("limited to 1"), "{ran:?}");
    for (name, format) in [("bk7", "unreal"), ("diamond", "filament")] {
        let ran = written(&place, name, format);
        assert!(!ran.err.contains("limited"), "{ran:?}");
    }
}

/// The errors are those that charts have of the same methods.
#[test]
fn errors_are_those_of_the_methods() {
    let place = Place::new();
    let text = |material: &str, format: &str| written(&place, material, format).out;
    let charted = |material: &str, method: &str| {
        let json = place
            .done(&format!("chart --material {material} --json -"))
            .json();
        let rows = json["rows"].as_array().unwrap();
        let is_it = |row: &&Value| row["method"] == method && row["inputs"] == "intended";
        rows.iter().find(is_it).unwrap()["value"].as_f64().unwrap()
    };
    for (material, format, node, method) in [
        ("gold", "gltf", "material", "schlick"),
        ("gold", "usd", "UsdPreviewSurface", "schlick"),
        ("gold", "filament", "material", "schlick"),
        ("gold", "unreal", "default_lit", "schlick"),
        ("gold", "materialx", "generalized_schlick_bsdf", "f82_tint"),
        ("gold", "materialx", "conductor_bsdf", "conductor_exact"),
        ("silver", "blender", "Principled BSDF", "f82_tint"),
        ("bk7", "gltf", "material", "schlick"),
    ] {
        let (stated, charted) = (
            stated(&text(material, format), node),
            charted(material, method),
        );
        near(stated, charted, 4e-5);
    }
    near(stated(&text("gold", "gltf"), "material"), 0.0223, 6e-5);
    near(
        stated(&text("gold", "openpbr"), "open_pbr_surface"),
        0.0212,
        6e-5,
    );
    // One index in place of a spectrum is nearly exact.
    assert!(stated(&text("bk7", "openpbr"), "open_pbr_surface") < 0.002);
    assert!(stated(&text("bk7", "gltf"), "material") > 0.03);
}

/// UsdPreviewSurface with `metallic` 1 has its colour at 90 degrees too: gold would be .66 off there.
#[test]
fn metals_of_usd_are_white_at_90_degrees() {
    let place = Place::new();
    let text = written(&place, "gold", "usd").out;
    for line in [
        "int inputs:useSpecularWorkflow = 1\n",
        "color3f inputs:diffuseColor = (0.0, 0.0, 0.0)\n",
        "color3f inputs:specularColor = (1.0, 0.77271, ",
    ] {
        assert!(text.contains(line), "{line} is not in {text}");
    }
    assert!(!text.contains("inputs:metallic"), "{text}");
}

/// What a format does with small F0: a slab of Unreal fades F90 out by its largest channel, as Default Lit by green.
#[test]
fn a_slab_fades_out_what_reflects_little() {
    let place = Place::new();
    place.put("thin.toml", THIN);
    let text = place.done("materials params thin.toml --as unreal").out;
    // F0 is .0051 of an index of 1.154, so that F90 is .26 and not 1.
    assert!(stated(&text, "substrate_slab") > 0.7, "{text}");
    assert!(
        joined(&text).contains("50 of the largest channel of F0"),
        "{text}"
    );
}

const THIN: &str = "name = \"thin\"\nclass = \"dielectric\"\nsummary = \"rare glass\"\nreference = \"none\"\nlink = \"https://example.org\"\n\
                    licence = \"CC0-1.0\"\nn = [[360, 1.154], [830, 1.154]]\n";

/// Below a coat light is never steeper than its critical angle: an error at 74 degrees cannot be seen there.
#[test]
fn errors_below_a_coat_are_at_angles_that_light_has_there() {
    let place = Place::new();
    for format in exchange::ALL {
        let text = place
            .done(&format!(
                "materials params gold --medium 1.5 --as {}",
                format.name
            ))
            .out;
        let text = joined(&text);
        let coated = text.split("light in it is at most 41.81 degrees").nth(1);
        let coated = coated.unwrap_or_else(|| panic!("no coat in {text}"));
        let number = |mark: &str| -> f64 {
            let rest = coated.split_once(mark).unwrap().1;
            rest.split_whitespace().next().unwrap().parse().unwrap()
        };
        assert!(number("(at ") <= 41.82, "{text}");
        if format.name == "gltf" {
            let (coat, medium) = (number("the error at most "), stated(&text, "material"));
            assert!(coat < medium / 2.0, "{coat} {medium}");
        }
    }
    let text = written(&place, "gold", "gltf").out;
    assert!(!text.contains("coat"), "{text}");
}

/// Formats have a roughness of their own, 1 in glTF: glass would be frosted.
#[test]
fn no_format_leaves_the_roughness_to_its_default() {
    let place = Place::new();
    for (format, line) in [
        (
            "blender",
            "node.inputs[\"Roughness\"].default_value = 0.0\n",
        ),
        ("filament", "material.roughness = 0.0;\n"),
        ("gltf", "\"roughnessFactor\": 0.0"),
        (
            "materialx",
            "<input name=\"specular_roughness\" type=\"float\" value=\"0.0\" />",
        ),
        ("openpbr", "specular_roughness = 0.0\n"),
        ("unreal", "Roughness = 0.0\n"),
        ("usd", "float inputs:roughness = 0.0\n"),
    ] {
        for material in MATERIALS {
            let ran = written(&place, material, format);
            let nodes = ran.out.matches("computes").count();
            let both = ran
                .out
                .matches("type=\"vector2\" value=\"0.0, 0.0\"")
                .count();
            assert_eq!(
                ran.out.matches(line).count() + both,
                nodes,
                "{format}: {}",
                ran.out
            );
            assert!(
                ran.err.contains("roughness is 0, a smooth surface"),
                "{ran:?}"
            );
        }
    }
}

/// A tint above 1: OpenPBR and Blender limit it and say what that costs; MaterialX's own node takes it.
#[test]
fn capped_tints_are_told() {
    let place = Place::new();
    let (above, below) = ("titanium_nitride", "aluminium");
    for format in ["openpbr", "blender", "materialx"] {
        let ran = written(&place, above, format);
        assert!(ran.err.contains("is limited to 1: the error is"), "{ran:?}");
        let ran = written(&place, below, format);
        assert!(!ran.err.contains("is limited to 1"), "{ran:?}");
    }
    let text = written(&place, above, "materialx").out;
    let whole = stated(&text, "generalized_schlick_bsdf");
    let capped = stated(&text, "open_pbr_surface");
    let ran = written(&place, above, "openpbr");
    let told = ran.err.split("the error is ").nth(1).unwrap();
    let mut told = told
        .split(" in place of ")
        .map(|words| words.split([' ', '\n']).next().unwrap());
    let mut told = || told.next().unwrap().parse::<f64>().unwrap();
    // A figure is rounded up in the text, and to the nearest in the remark.
    near(told(), capped, 1.1e-5);
    near(told(), whole, 1.1e-5);
    assert!(capped >= whole, "{ran:?}");
}

/// ACES pipelines adapt by Bradford; with it gold is (.9150, .7855, .4018).
#[test]
fn acescg_says_which_adaptation_aces_has() {
    let place = Place::new();
    let flags = "materials params gold --space acescg";
    for line in ["", " --as openpbr", " --as materialx"] {
        let ran = place.done(&format!("{flags}{line}"));
        assert!(
            format!("{}{}", ran.out, ran.err).contains("adapt by Bradford"),
            "{ran:?}"
        );
        let ran = place.done(&format!("{flags} --adaptation bradford{line}"));
        assert!(
            !format!("{}{}", ran.out, ran.err).contains("adapt by Bradford"),
            "{ran:?}"
        );
    }
    let text = place
        .done(&format!("{flags} --adaptation bradford --as openpbr"))
        .out;
    let colour = &toml(&text)["open_pbr_surface"]["base_color"];
    for (i, want) in [0.9150, 0.7855, 0.4018].into_iter().enumerate() {
        near(colour[i].as_float().unwrap(), want, 6e-5);
    }
    let text = place.done(&format!("{flags} --as materialx")).out;
    assert!(text.contains("colorspace=\"acescg\""), "{text}");
}

#[test]
fn what_a_format_cannot_hold_is_refused() {
    let place = Place::new();
    for (line, says) in [
        ("gold --as gtlf", "(did you mean gltf"),
        ("gold --as gltf --json -", "leave --json out"),
        ("gold --as gltf --space acescg", "takes colours in srgb"),
        (
            "gold --as materialx --space rec2020",
            "takes colours in srgb, p3, acescg",
        ),
        ("gold -o gold.mtlx", "--as"),
        ("gold --as usd --overwrite", "-o"),
        ("water --medium diamond --as gltf", "1 or more"),
        ("glod --as gltf", "did you mean gold"),
    ] {
        place.refused(&format!("materials params {line}"), &[says]);
    }
    let ran = place.done("materials params gold --as gltf --wavelengths 685,535,475");
    assert!(ran.err.contains("one wavelength"), "{ran:?}");
    let wet = place.done("materials params diamond --medium water --as openpbr");
    let ior = toml(&wet.out)["open_pbr_surface"]["specular_ior"]
        .as_float()
        .unwrap();
    near(ior, 2.4175 / 1.3334, 2e-3);
    assert!(
        wet.out
            .contains("materials params diamond --medium water --as openpbr"),
        "{wet:?}"
    );
}

/// A file of ours is replaced and named; one of the user's is not, unless they say so.
#[test]
fn only_a_file_of_ours_is_replaced() {
    let place = Place::new();
    for format in exchange::ALL {
        let (name, file) = (format.name, format!("mine.{}", format.name));
        let line = |material: &str| format!("materials params {material} --as {name} -o {file}");
        place.put(&file, "mine\n");
        let says = [
            file.as_str(),
            "did not write",
            "nothing was written",
            "--overwrite",
        ];
        place.refused(&line("gold"), &says);
        place.done(&format!("{} --overwrite", line("gold")));
        assert_eq!(place.read(&file), written(&place, "gold", name).out);
        let again = place.done(&line("gold"));
        assert!(!again.err.contains("replaced: "), "{again:?}");
        let ran = place.done(&line("silver"));
        assert!(
            ran.err.contains(&format!("replaced: {file}")) && ran.out.is_empty(),
            "{ran:?}"
        );
        assert_eq!(place.read(&file), written(&place, "silver", name).out);
    }
}

/// Two files of a user that begin like ours, and are not.
#[test]
fn what_only_begins_like_ours_is_not_ours() {
    let place = Place::new();
    for (format, text) in [
        ("usd", "#usda 1.0\n(\n)\n# @generated by fresnel-gen\n"),
        ("gltf", "{ \"asset\": { \"version\": \"2.0\" } }\n"),
    ] {
        place.put("mine", text);
        place.refused(
            &format!("materials params gold --as {format} -o mine"),
            &["did not write"],
        );
    }
}

/// What `tests/run` installs is what reads the files here.
#[test]
fn the_tools_are_those_that_the_script_installs() {
    let run = include_str!("../../run");
    assert!(
        [MATERIALX, USD, GLTF]
            .iter()
            .all(|package| run.contains(package))
    );
}

/// A file whose name, and a text whose words, leave comments and strings of many languages.
const HOSTILE: &str = "a--->b---]]> * '''\"\"\" \u{1b}[31m {{ x }}.toml";
const HOSTILE_TEXT: &str = "--->  --- ]]> */ ''' </script> #endif {{ x }} ??/ \u{fffe} \\\\";

/// What a tool tells of the files of a format, by material. None where the tool is not here.
#[track_caller]
fn told_by(
    reader: &[&str],
    package: &str,
    folder: &str,
    format: &str,
    ending: &str,
) -> Option<Value> {
    if !Path::new(FOLDER).join(folder).exists() {
        let what = format!(
            "{format} by {package}: it is not in target/exchange, where tests/run installs it"
        );
        assert!(std::env::var_os("CI").is_none(), "not checked: {what}");
        not_checked(&what);
        return None;
    }
    let place = Place::new();
    place.put(
        HOSTILE,
        THIN.replace("rare glass", HOSTILE_TEXT)
            .replace("none", HOSTILE_TEXT),
    );
    let materials: Vec<&str> = MATERIALS
        .into_iter()
        .chain(["ice", "air"])
        .chain([HOSTILE])
        .collect();
    let files: Vec<String> = (materials.iter().enumerate())
        .map(|(i, material)| match *material {
            HOSTILE => format!("hostile{i}{ending}"),
            material => format!("{material}{ending}"),
        })
        .collect();
    for (material, file) in materials.iter().zip(&files) {
        let words = ["materials", "params", material, "--as", format, "-o", file];
        place.run_with(&words).ends(0);
    }
    let mut files = files;
    if exchange::find(format).is_some_and(|format| format.coat.is_some()) {
        files.push(format!("coated{ending}"));
        let to = &files[files.len() - 1];
        place.done(&format!(
            "materials params gold --as {format} --coat 1.5 -o {to}"
        ));
    }
    let [command, script] = reader else {
        panic!("a command and its script")
    };
    let output = Command::new(command)
        .arg(format!(
            "{}/tests/reference/{script}",
            env!("CARGO_MANIFEST_DIR")
        ))
        .arg(FOLDER)
        .args(&files)
        .current_dir(place.path(""))
        .output()
        .unwrap();
    Some(Ran::new(script.to_string(), output).ends(0).json())
}

/// MaterialX validates the documents, makes shaders of them, and reads the numbers that were written.
#[test]
fn materialx_reads_its_documents() {
    let reader = ["python3", "read_materialx.py"];
    let Some(told) = told_by(&reader, MATERIALX, "MaterialX", "materialx", ".mtlx") else {
        return;
    };
    let number = |path: &str| {
        told.pointer(path)
            .and_then(Value::as_f64)
            .unwrap_or_else(|| panic!("no {path}: {told}"))
    };
    near(
        number("/bk7.mtlx/open_pbr_surface/specular_ior"),
        1.5168,
        5e-6,
    );
    near(
        number("/gold.mtlx/generalized_schlick_bsdf/color0/1"),
        0.77271,
        1e-5,
    );
    near(
        number("/silver.mtlx/open_pbr_surface/base_metalness"),
        1.0,
        0.0,
    );
    assert!(number("/silicon.mtlx/conductor_bsdf/ior/1") > 3.5);
    let coat = |name: &str| number(&format!("/coated.mtlx/open_pbr_surface/coat_{name}"));
    assert_eq!(
        [coat("weight"), coat("ior"), coat("darkening")],
        [1.0, 1.5, 0.0]
    );
    // An index is no colour: a host moves it into no working space.
    let spaces = &told["gold.mtlx"]["colorspaces"];
    assert_eq!(spaces["conductor_bsdf ior"], "none", "{told}");
    assert_eq!(spaces["conductor_bsdf extinction"], "none", "{told}");
    assert_eq!(
        spaces["generalized_schlick_bsdf color0"], "lin_rec709",
        "{told}"
    );
}

/// USD's own validators find no fault.
#[test]
fn usd_reads_its_layers() {
    let reader = ["python3", "read_usd.py"];
    let Some(told) = told_by(&reader, USD, "pxr", "usd", ".usda") else {
        return;
    };
    let number = |path: &str| {
        told.pointer(path)
            .and_then(Value::as_f64)
            .unwrap_or_else(|| panic!("no {path}: {told}"))
    };
    near(number("/gold.usda/specularColor/1"), 0.77271, 1e-5);
    near(number("/gold.usda/diffuseColor/1"), 0.0, 0.0);
    assert_eq!(told["gold.usda"]["useSpecularWorkflow"], 1);
    near(number("/bk7.usda/ior"), 1.5168, 5e-6);
    assert_eq!(told["water.usda"]["useSpecularWorkflow"], 1);
}

/// Khronos's validator has nothing to say but that nothing uses the material.
#[test]
fn the_validator_of_gltf_finds_no_fault() {
    let reader = ["node", "read_gltf.js"];
    let Some(told) = told_by(
        &reader,
        GLTF,
        "node_modules/gltf-validator",
        "gltf",
        ".gltf",
    ) else {
        return;
    };
    for material in MATERIALS.into_iter().chain(["coated"]) {
        let issues = &told[format!("{material}.gltf")];
        let messages = issues["messages"].as_array().unwrap();
        assert!(
            messages
                .iter()
                .all(|message| message["code"] == "UNUSED_OBJECT"),
            "{issues}"
        );
    }
}

/// What a reader of the file would miss: no mesh, the space of colours that have none beside them, numbers that no host moves.
#[test]
fn what_a_format_leaves_open_is_a_remark() {
    let place = Place::new();
    let says = |line: &str, words: &str| {
        let ran = place.done(&format!("materials params {line}"));
        let in_text = joined(&ran.out).contains(words);
        assert_eq!(in_text, ran.err.contains(words), "{ran:?}");
        in_text
    };
    for material in ["gold", "bk7"] {
        let line = format!("{material} --as gltf");
        assert!(says(&line, "holds a material and no mesh"), "{line}");
    }
    let words = "OpenPBR takes ACEScg where nothing else is said";
    assert!(says("gold --as openpbr", words));
    assert!(says(
        "gold --as openpbr --space p3",
        "colours are in linear Display P3"
    ));
    assert!(!says("gold --as openpbr --space acescg", words));
    assert!(!says("bk7 --as openpbr", words), "an index is no colour");
    let words = "conductor_bsdf: n and k are no colours";
    assert!(says("gold --as materialx", words));
    assert!(says(
        "gold --as materialx --space acescg",
        "they belong to acescg"
    ));
    assert!(!says("water --as materialx", words));
}

/// What a host with the numbers of a format draws of a coated metal, by the formulas that its documents state.
fn coated(f0: [f64; 3], tint: [f64; 3], coat: f64, cos: f64) -> [f64; 3] {
    let rest = (1.0 - cos).powi(5);
    [0, 1, 2].map(|i| {
        let schlick = f0[i] + (1.0 - f0[i]) * rest;
        let at_82 = f0[i] + (1.0 - f0[i]) * (6.0_f64 / 7.0).powi(5);
        let bump = cos * (1.0 - cos).powi(6) / ((1.0 / 7.0) * (6.0_f64 / 7.0).powi(6));
        let base = schlick - at_82 * (1.0 - tint[i]) * bump;
        coat + (1.0 - coat) * base
    })
}

/// Coat and base in Blender are the formula with which the error is stated: pixels of Cycles (`tests/reference/cycles_coats.py`). Near
/// grazing Cycles' own coat lets a little less through.
#[test]
fn coats_of_blender_are_what_cycles_draws() {
    let text = include_str!("../../reference/cycles_coats.csv");
    for line in text.lines().skip(2) {
        let numbers: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let three = |at: usize| [numbers[at], numbers[at + 1], numbers[at + 2]];
        let cos = numbers[7].to_radians().cos();
        let coat = optics::dielectric(numbers[0], cos).unpolarised();
        let (got, want) = (coated(three(1), three(4), coat, cos), three(8));
        let within = if numbers[7] > 80.0 { 0.01 } else { 0.002 };
        for channel in 0..3 {
            near(got[channel], want[channel], within);
        }
    }
}

/// A coated metal: the base's colours are those below the coat, and coat and base together are nearer to both interfaces than the metal's
/// colours in air are below the same coat. The error is the one stated.
#[test]
fn a_coat_comes_with_the_base_that_belongs_to_it() {
    let place = Place::new();
    let error = |name: &str, own: &dyn Fn(f64) -> [f64; 3]| {
        let cosines: Vec<f64> = (0..=256).map(|i| f64::from(i) / 256.0).collect();
        let off = |cos: &f64| {
            let (got, want) = (own(*cos), two_interfaces(name, *cos));
            (0..3).map(|i| (got[i] - want[i]).abs()).fold(0.0, f64::max)
        };
        cosines.iter().map(off).sum::<f64>() / cosines.len() as f64
    };
    for name in ["gold", "copper", "platinum"] {
        let text = place
            .done(&format!("materials params {name} --as openpbr --coat 1.5"))
            .out;
        let surface = toml(&text)["open_pbr_surface"].as_table().unwrap().clone();
        let three = |field: &str| {
            let values = surface[field].as_array().unwrap();
            [0, 1, 2].map(|i| values[i].as_float().unwrap())
        };
        let given = [
            "coat_weight",
            "coat_ior",
            "coat_roughness",
            "coat_darkening",
        ];
        assert_eq!(
            given.map(|field| surface[field].as_float().unwrap()),
            [1.0, 1.5, 0.0, 0.0]
        );
        let (f0, tint) = (three("base_color"), three("specular_color"));
        let bare = &params(&place, name);
        let in_air = |field: &str| [0, 1, 2].map(|i| bare[field][i].as_f64().unwrap().min(1.0));
        let coat = |cos: f64| optics::dielectric(1.5, cos).unpolarised();
        let ours = error(name, &|cos| coated(f0, tint, coat(cos), cos));
        let air = error(name, &|cos| {
            coated(in_air("f0"), in_air("f82_tint"), coat(cos), cos)
        });
        println!("{name} below a coat: {ours:.4} on average, with its colours in air {air:.4}");
        assert!(ours < 0.5 * air, "{name}: {ours} {air}");
        let text = joined(&text);
        let said = text.split("error of both together ").nth(1).unwrap();
        let said: f64 = said.split_whitespace().next().unwrap().parse().unwrap();
        near(said, ours, 2e-3);
    }
    for format in ["blender", "filament", "gltf", "materialx"] {
        place.done(&format!("materials params gold --as {format} --coat 1.5"));
    }
    let text = place.done("materials params gold --as gltf --coat 1.5").out;
    let asset: Value = serde_json::from_str(&text).unwrap();
    let material = &asset["materials"][0];
    let green = material["pbrMetallicRoughness"]["baseColorFactor"][1]
        .as_f64()
        .unwrap();
    near(0.04 + 0.96 * green, two_interfaces("gold", 1.0)[1], 1e-5);
    let coat = &material["extensions"]["KHR_materials_clearcoat"];
    assert_eq!(coat["clearcoatFactor"], 1.0, "{text}");
    for (line, words) in [
        (
            "gold --as usd --coat 1.5",
            "blender, filament, gltf, materialx, openpbr",
        ),
        (
            "gold --as gltf --coat 1.4",
            "an index of 1.5, and not of 1.4",
        ),
        ("water --as gltf --coat 1.5", "metals and semiconductors"),
        (
            "gold --as gltf --coat 1.5 --medium water",
            "leave --medium out",
        ),
        ("gold --coat 1.5", "--as"),
    ] {
        place.refused(&format!("materials params {line}"), &[words]);
    }
}

/// Clear bodies whose k is known have the colour of light that passes: of water red goes first, of window glass too.
#[test]
fn bodies_that_absorb_say_what_passes() {
    let place = Place::new();
    for (name, metres) in [("water", 2.1), ("soda_lime_glass", 0.048)] {
        let text = written(&place, name, "gltf").out;
        let asset: Value = serde_json::from_str(&text).unwrap();
        let volume = &asset["materials"][0]["extensions"]["KHR_materials_volume"];
        let distance = volume["attenuationDistance"].as_f64().unwrap();
        near(distance, metres, 0.05 * metres);
        let colour = [0, 1, 2].map(|i| volume["attenuationColor"][i].as_f64().unwrap());
        near(colour[0], 0.5, 1e-3);
        assert!(colour[1] > 0.7 && colour[2] > 0.7, "{name}: {colour:?}");
        let surface = toml(&written(&place, name, "openpbr").out);
        let surface = surface["open_pbr_surface"].as_table().unwrap();
        near(
            surface["transmission_depth"].as_float().unwrap(),
            distance,
            1e-9,
        );
    }
    // Measured without k.
    let text = written(&place, "diamond", "gltf").out;
    assert!(!text.contains("attenuation"), "{text}");
}

/// The model of Blender's films beside pixels of Cycles (`tests/reference/cycles_films.py`).
#[test]
fn films_of_blender_are_what_cycles_draws() {
    use fresnel_gen::generator::exchange::{CyclesBase, CyclesFilm};
    let text = include_str!("../../reference/cycles_films.csv");
    let (mut most, mut count) = (0.0_f64, 0);
    for line in text.lines().skip(2) {
        let (base, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|x| x.parse().unwrap()).collect();
        let three = |at: usize| [numbers[at], numbers[at + 1], numbers[at + 2]];
        let film = CyclesFilm {
            ior: numbers[6],
            thickness_nm: numbers[7],
            base: match base {
                "tinted" => CyclesBase::Tinted(three(0), three(3)),
                "conductor" => CyclesBase::Conductor(three(0), three(3)),
                _ => CyclesBase::Dielectric(numbers[0]),
            },
        };
        let (got, want) = (film.at(numbers[8].to_radians().cos()), three(9));
        for channel in 0..3 {
            let apart = (got[channel] - want[channel]).abs();
            assert!(apart < 2e-4, "{line}: {got:?}");
            most = most.max(apart);
        }
        count += 1;
    }
    println!("{count} pixels of Cycles, at most {most:.1e} apart");
    assert!(count > 100);
}

/// Films in Blender: from 5.0 on a metal takes its film, before it the film's colours.
#[test]
fn blender_takes_films() {
    let place = Place::new();
    let shown = written(&place, "anodised_titanium_purple", "blender").out;
    for line in [
        "if bpy.app.version < (5, 0, 0):",
        "    node.inputs[\"Specular Tint\"]",
        "else:",
        "    node.inputs[\"Thin Film Thickness\"].default_value = 39",
        "    node.fresnel_type = \"PHYSICAL_CONDUCTOR\"",
        "    node.inputs[\"Extinction\"]",
    ] {
        assert!(shown.contains(line), "{line}: {shown}");
    }
    let oil = written(&place, "oil_on_water", "blender").out;
    assert!(
        oil.contains("node.inputs[\"Thin Film IOR\"].default_value = 1.47"),
        "{oil}"
    );
    assert!(!oil.contains("bpy.app.version"), "{oil}");
}

/// Engines with an adapter and formats with numbers have flags of their own, and each names the other.
#[test]
fn a_flavour_is_no_format_and_the_other_way_round() {
    let place = Place::new();
    place.refused("materials params gold --as three", &["--flavour three"]);
    place.refused("--flavour gltf --material gold", &["--as gltf"]);
}
