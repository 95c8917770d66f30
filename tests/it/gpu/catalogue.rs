//! The catalogue from a storage buffer and from a texture: the functions that `docs/shaders.md` shows, on real stacks with the
//! committed files, against an evaluation on the CPU.

use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::json;

use super::device;
use crate::browser::{self, CHROMIUM};
use crate::catalogue::{evaluated, rows_named};
use crate::cli::Place;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{
    Argument, Backend, Program, ShaderCode, Texture, TextureFilter, TextureFormat, TextureShape,
    Uniform, Wrap,
};

const MATERIALS: [&str; 4] = ["gold", "silver", "water", "diamond"];
const POINTS: u32 = 512;
/// What single precision and a device's `exp2` may add: Vulkan asks for an error of 3 + 2 |x| ulp, and x is at most 6.5.
const CLOSE: f64 = 2e-6;

fn cosines() -> Vec<f32> {
    (0..=POINTS).map(|i| i as f32 / POINTS as f32).collect()
}

/// The committed tree.
fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-generated")
}

/// A tree with a catalogue of these materials in an order that mixes methods.
fn own(place: &Place) -> PathBuf {
    place.done("--material gold,water,silver,diamond --catalogue --target wgsl,gles --out-dir own");
    place.path("own")
}

fn read(root: &Path, path: &str) -> Vec<u8> {
    std::fs::read(root.join(path)).expect(path)
}

fn rows(root: &Path) -> Vec<(usize, String, Vec<f32>)> {
    rows_named(&root.join("catalogue.json"), &MATERIALS)
}

/// The files of a language that the example stands below, and the example: the one that reads this file.
fn example(root: &Path, folder: &str, language: &str, extension: &str, reads: &str) -> String {
    let page = include_str!("../../../docs/shaders.md");
    let fence = format!("```{language}\n");
    let blocks = page.split(&fence).skip(1);
    let mut blocks = blocks.map(|after| after.split_once("```").expect("it ends").0);
    let example = blocks.find(|block| block.contains(reads)).expect(reads);
    let names = ["catalogue", "fresnel_fitted", "fresnel_fitted_dielectric"];
    let files = names.map(|name| read(root, &format!("{folder}/{name}.{extension}")));
    String::from_utf8(files.concat()).unwrap() + example
}

/// The largest difference of what a device gave for a material from the CPU's evaluation with these coefficients.
fn difference(got: &[[f32; 3]], method: &str, coefficients: &[f32]) -> f64 {
    let cosines: Vec<f64> = cosines().into_iter().map(f64::from).collect();
    let want = evaluated(method, coefficients, &cosines);
    assert_eq!(got.len(), want.len());
    let pairs = got.iter().flatten().zip(want.iter().flatten());
    pairs
        .map(|(got, want)| (f64::from(*got) - want).abs())
        .fold(0.0, f64::max)
}

/// Each material by its own method, and not by the other one: a wrong branch or a wrong row would be seen.
#[track_caller]
fn check(name: &str, got: &[[f32; 3]], method: &str, coefficients: &[f32]) {
    let off = difference(got, method, coefficients);
    assert!(off < CLOSE, "{name} is off by {off}");
    let other = match method {
        "fitted" => "fitted_dielectric",
        _ => "fitted",
    };
    let off = difference(got, other, coefficients);
    assert!(off > 1e-3, "{name} by {other} is off by {off} only");
}

#[test]
fn a_storage_buffer_in_wgsl() {
    a_storage_buffer_of(&committed());
}

#[test]
fn a_storage_buffer_of_ones_own_order_in_wgsl() {
    a_storage_buffer_of(&own(&Place::new()));
}

fn a_storage_buffer_of(root: &Path) {
    let Some(device) = device(Backend::Vulkan) else {
        return;
    };
    let bytes = read(root, "catalogue.std430.bin");
    let words = bytes.chunks_exact(4);
    let words: Vec<f32> = words
        .map(|word| f32::from_le_bytes(word.try_into().unwrap()))
        .collect();
    let mut points: Vec<[f32; 4]> = words
        .chunks_exact(4)
        .map(|four| four.try_into().unwrap())
        .collect();
    let first = points.len();
    // What is asked stands in the same buffer, behind the catalogue: the device has one for what it reads.
    let example = example(root, "wgsl", "wgsl", "wgsl", "catalogue.std430.bin");
    let example = example.replace("@binding(0)", "@binding(1)");
    let program = format!(
        "{example}
@group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) invocation: vec3<u32>) {{
    let index = invocation.x;
    if index >= {first}u && index < arrayLength(&coefficients) {{
        let asked = coefficients[index];
        results[index] = vec4<f32>(material_reflectance(u32(asked.x), asked.y), 1.0);
    }}
}}
"
    );
    let rows = rows(root);
    for (row, _, _) in &rows {
        points.extend(cosines().iter().map(|c| [*row as f32, *c, 0.0, 0.0]));
    }
    let batch = device.prepare_batch(&super::program(ShaderCode::Wgsl(&program), &[]), 1);
    let results = batch.unwrap().run(&points, None).unwrap();
    let each = cosines().len();
    let results = results[first..].chunks_exact(each);
    assert_eq!(results.len(), rows.len());
    for ((name, (_, method, coefficients)), got) in MATERIALS.iter().zip(&rows).zip(results) {
        check(name, got, method, coefficients);
    }
}

/// The texels of a file, and the format that they are uploaded as.
fn texels(root: &Path, path: &str) -> (Vec<[f32; 4]>, TextureFormat) {
    let bytes = read(root, path);
    let reader = ktx2::Reader::new(&bytes).unwrap();
    let level = reader.levels().next().unwrap();
    let half = |pair: &[u8]| half::f16::from_le_bytes(pair.try_into().unwrap()).to_f32();
    let single = |word: &[u8]| f32::from_le_bytes(word.try_into().unwrap());
    let (numbers, format): (Vec<f32>, _) = match reader.header().format {
        Some(ktx2::Format::R16G16B16A16_SFLOAT) => (
            level.data.chunks_exact(2).map(half).collect(),
            TextureFormat::Half,
        ),
        _ => (
            level.data.chunks_exact(4).map(single).collect(),
            TextureFormat::Float,
        ),
    };
    let texels = numbers
        .chunks_exact(4)
        .map(|four| four.try_into().unwrap())
        .collect();
    (texels, format)
}

/// Each material by the function that reads a texture, with the texels of a file; the coefficients as its numbers hold them.
fn check_texture(root: &Path, path: &str, rounded: fn(f32) -> f32) {
    let Some(device) = device(Backend::Gles) else {
        return;
    };
    let example = example(root, "gles", "glsl", "glsl", "catalogue.f32.ktx2");
    let program = format!(
        "#version 300 es
{example}
uniform highp float row_of_material;
in highp float cos_theta;
out highp vec3 reflectance;
void main() {{
    reflectance = material_reflectance(int(row_of_material), cos_theta);
}}
"
    );
    let row_uniform = |row: usize| {
        [Uniform {
            name: "row_of_material".to_owned(),
            value: Argument::Scalar(row as f32),
        }]
    };
    let kernel = device.prepare(&Program {
        code: ShaderCode::Gles(&program),
        entry: "main",
        uniforms: &row_uniform(0),
        texture: Some(TextureShape::Flat),
    });
    let kernel = kernel.unwrap();
    let (texels, format) = texels(root, path);
    let texture = Texture {
        width: 4,
        texels: &texels,
        format,
        wrap: Wrap::Clamp,
        shape: TextureShape::Flat,
        filter: TextureFilter::Nearest,
    };
    for (name, (row, method, coefficients)) in MATERIALS.iter().zip(rows(root)) {
        let got = match kernel.run(&cosines(), &row_uniform(row), Some(&texture)) {
            Err(fault @ Fault::Absent(_)) => {
                return crate::not_checked(&fault.to_string());
            }
            got => got.unwrap(),
        };
        let held: Vec<f32> = coefficients.into_iter().map(rounded).collect();
        check(name, &got, &method, &held);
    }
}

#[test]
fn a_texture_in_gles() {
    check_texture(&committed(), "catalogue.f32.ktx2", |value| value);
}

#[test]
fn a_texture_of_ones_own_order_in_gles() {
    check_texture(&own(&Place::new()), "catalogue.f32.ktx2", |value| value);
}

#[test]
fn a_texture_of_halves_in_gles() {
    check_texture(&committed(), "catalogue.f16.ktx2", |value| {
        half::f16::from_f32(value).to_f32()
    });
}

/// The bytes of the buffer as a texture of WebGL 2 in a browser, a pixel a cosine.
#[test]
fn a_texture_in_a_browser() {
    if !CHROMIUM.is_here("the catalogue by WebGL 2") {
        return;
    }
    let root = &committed();
    let example = example(root, "gles", "glsl", "glsl", "catalogue.f32.ktx2");
    let fragment = format!(
        "#version 300 es
precision highp float;
{example}
uniform highp int row;
out highp vec4 pixel;
void main() {{
    pixel = vec4(material_reflectance(row, floor(gl_FragCoord.x) / {POINTS}.0), 1.0);
}}
"
    );
    let rows = rows(root);
    let asked: Vec<usize> = rows.iter().map(|(row, ..)| *row).collect();
    let hands = format!(
        "<body><script>const FRAGMENT = {}, BYTES = {}, ROWS = {};\n{}</script></body></html>",
        json!(fragment),
        json!(BASE64_STANDARD.encode(read(root, "catalogue.std430.bin"))),
        json!({ "rows": asked, "points": cosines().len() }),
        include_str!("catalogue_page.js")
    );
    let page = "<!doctype html><html><head><title>catalogue</title></head></html>";
    let flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
    let told = browser::told(&Place::new(), page, &hands, "", &flags);
    assert_eq!(told["faults"], json!([]), "{}", told["faults"]);
    for (place, (name, (_, method, coefficients))) in MATERIALS.iter().zip(&rows).enumerate() {
        let pixels = told["rows"][place].as_array().unwrap();
        let numbers: Vec<f32> = pixels.iter().map(|x| x.as_f64().unwrap() as f32).collect();
        let pixels = numbers.chunks_exact(4);
        let got: Vec<[f32; 3]> = pixels.map(|four| [four[0], four[1], four[2]]).collect();
        check(name, &got, method, coefficients);
    }
}
