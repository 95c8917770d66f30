//! The flavour `materialx` in MaterialX: documents that it validates, shaders that it generates, and F of these shaders against f64.

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::rows;
use crate::catalogue::evaluated;
use crate::cli::{OUT, Place, Ran};
use crate::compilers::Tool;
use crate::gpu;
use crate::not_checked;
use fresnel_gen::lab::gpu::{Argument, Backend, Device, ShaderCode, Uniform};
use fresnel_gen::lab::verify::cosines;

/// Where `tests/run` installs MaterialX.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/target/exchange");
const MATERIALS: [&str; 6] = [
    "anodised_titanium_purple",
    "diamond",
    "gold",
    "oil_on_water",
    "silver",
    "water",
];
const TARGETS: [&str; 7] = ["glsl", "essl", "vulkan", "msl", "osl", "mdl", "slang"];
const READ_BY_GLSLANG: [&str; 3] = ["glsl", "essl", "vulkan"];
/// The targets whose shaders are one text.
const NO_STAGES: [&str; 2] = ["osl", "mdl"];
const GLSLANG: Tool = Tool {
    command: "glslangValidator",
    package: "glslang-tools",
};

/// What MaterialX did with the files of the flavour, and the folder that holds its shaders. None where it is not here.
#[track_caller]
fn checked() -> Option<(Place, Value)> {
    if !Path::new(FOLDER).join("MaterialX").exists() {
        let what = "the flavour materialx by MaterialX: it is not in target/exchange, where tests/run installs it";
        assert!(std::env::var_os("CI").is_none(), "not checked: {what}");
        not_checked(what);
        return None;
    }
    let place = Place::new();
    let materials = MATERIALS.join(",");
    place.done(&format!("--flavour materialx --material {materials}"));
    let script = "tests/it/flavours/materialx/check.py";
    let output = Command::new("python3")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join(script))
        .arg(FOLDER)
        .arg(place.path(&format!("{OUT}/materialx")))
        .arg(place.path("shaders"))
        .output()
        .unwrap();
    let told = Ran::new(script.to_owned(), output).ends(0).json();
    Some((place, told))
}

/// The names of a document's shaders in a target.
fn shaders<'a>(told: &'a Value, document: &str, target: &str) -> Vec<&'a str> {
    let names = told["shaders"][document][target].as_array();
    let names = names.unwrap_or_else(|| panic!("no {target} of {document}: {told}"));
    names.iter().map(|name| name.as_str().unwrap()).collect()
}

/// Each file alone, each two in both orders, each twice, all of them; and the README's document and F alone in every target.
#[test]
fn documents_are_valid_and_become_shaders_that_glslang_accepts() {
    let Some((place, told)) = checked() else {
        return;
    };
    let files = MATERIALS.len() + 1;
    assert_eq!(told["files"].as_array().unwrap().len(), files, "{told}");
    let mut documents = vec!["readme".to_owned()];
    for row in rows(&MATERIALS) {
        documents.push(row.name.clone());
        documents.extend(row.coated.map(|_| format!("{}_under_coat", row.name)));
    }
    let made = told["shaders"].as_object().unwrap();
    assert_eq!(made.len(), documents.len(), "{told}");
    let mut all: Vec<(&str, &str)> = documents
        .iter()
        .flat_map(|document| TARGETS.map(|target| (document.as_str(), target)))
        .collect();
    for &(document, target) in &all {
        let stages = shaders(&told, document, target).len();
        let want = if NO_STAGES.contains(&target) { 1 } else { 2 };
        assert_eq!(stages, want, "{document}: {target}");
    }
    not_checked("OSL, MSL, MDL and Slang of the flavour materialx: no compiler");
    if !GLSLANG.is_here("shaders of the flavour materialx") {
        return;
    }
    let module = place.path("module.spv");
    all.retain(|(_, target)| READ_BY_GLSLANG.contains(target));
    for (document, target) in all {
        for name in shaders(&told, document, target) {
            let shader = place.path(&format!("shaders/{name}"));
            let mut arguments = vec![shader.as_os_str()];
            if target == "vulkan" {
                arguments.extend([OsStr::new("-V"), OsStr::new("-o"), module.as_os_str()]);
            }
            let judged = GLSLANG.run(arguments);
            judged.unwrap_or_else(|said| panic!("{name}: {said}"));
        }
    }
}

/// The functions of our nodes in a shader.
fn functions(shader: &str) -> String {
    let (mut kept, mut inside) = (String::new(), false);
    for line in shader.lines() {
        inside |= line.starts_with("void NG_fresnel_");
        if inside {
            kept += &format!("{line}\n");
        }
        inside &= line != "}";
    }
    kept
}

/// Coefficients as arguments of a run.
fn uniforms(coefficients: &[f32]) -> Vec<Uniform> {
    let terms = coefficients.chunks_exact(3).enumerate();
    let uniform = |(i, term): (usize, &[f32])| Uniform {
        name: format!("c{i}"),
        value: Argument::Rgb([term[0], term[1], term[2]]),
    };
    terms.map(uniform).collect()
}

/// The largest difference of what a call sets from F in f64.
#[track_caller]
fn off(
    device: &Device,
    functions: &str,
    call: &str,
    uniforms: &[Uniform],
    want: impl Fn(&[f64]) -> Vec<[f64; 3]>,
) -> f64 {
    let declared: String = uniforms
        .iter()
        .map(|uniform| format!("uniform highp vec3 {};\n", uniform.name))
        .collect();
    let shader = format!(
        "#version 300 es
{functions}{declared}in highp float cos_theta;
out highp vec3 reflectance;
void main() {{
    {call}
}}
"
    );
    let kernel = device.prepare(&gpu::program(ShaderCode::Gles(&shader), uniforms));
    let kernel = kernel.unwrap_or_else(|fault| panic!("{fault}: {shader}"));
    let points = cosines(1000);
    let got = kernel.run(&points, uniforms, None).unwrap();
    let points: Vec<f64> = points.iter().map(|c| f64::from(*c)).collect();
    let want = want(&points);
    assert_eq!(got.len(), want.len());
    let pairs = got.iter().flatten().zip(want.iter().flatten());
    pairs
        .map(|(got, want)| (f64::from(*got) - want).abs())
        .fold(0.0, f64::max)
}

/// What f32 adds to the difference from f64.
const ROUNDING: f64 = 1e-6;

/// MaterialX writes numbers into shaders with six decimals. Coefficients are off by half a unit of the last one each, and are multiplied by
/// 1 at most, under films by 94 together.
const SIX_DECIMALS: f64 = 0.5e-6;

/// The nodes with coefficients as inputs, and those of a material with its own, as OpenGL ES computes MaterialX's code of them.
#[test]
fn shaders_give_the_reflectance_of_the_catalogue() {
    let Some((place, _)) = checked() else { return };
    let Some(device) = gpu::device(Backend::Gles) else {
        return;
    };
    let flat = |terms: &[[f64; 3]]| -> Vec<f32> {
        terms.as_flattened().iter().map(|one| *one as f32).collect()
    };
    for row in rows(&MATERIALS) {
        let (material, method) = (&row.name, row.method.name);
        let bare = ("", flat(&row.coefficients));
        let coated = row
            .coated
            .map(|one| ("_under_coat", flat(&one.coefficients)));
        for (suffix, coefficients) in [bare].into_iter().chain(coated) {
            let shader = place.read(&format!("shaders/{material}{suffix}_essl.frag"));
            let text = functions(&shader);
            let want = |points: &[f64]| evaluated(method, &coefficients, points);
            let count = coefficients.len() / 3;
            let names: String = (0..count).map(|i| format!("c{i}, ")).collect();
            let call = format!("NG_fresnel_{method}(cos_theta, {names}reflectance);");
            let library = off(&device, &text, &call, &uniforms(&coefficients), want);
            assert!(library <= ROUNDING, "{method}: {library}");
            let call = format!("NG_fresnel_{material}_{method}{suffix}(cos_theta, reflectance);");
            let own = off(&device, &text, &call, &[], want);
            let factors = if count > 4 { 94.0 } else { 4.0 };
            assert!(
                own <= ROUNDING + factors * SIX_DECIMALS,
                "{material}{suffix}: {own}"
            );
        }
    }
}
