//! What a device computes is what the graph means: WGSL, SPIR-V and GLSL ES against f64.

use std::fs;
use std::path::Path;

use super::device;
use super::gles;
use super::program;
use super::wgsl;
use fresnel_gen::generator::emit::{self, Bounds, Naming};
use fresnel_gen::generator::request;
use fresnel_gen::generator::request::{Materials, Request};
use fresnel_gen::lab::gpu::{Argument, Backend, ShaderCode, Uniform};
use fresnel_gen::lab::verify::{ABSOLUTE_FLOOR, cosines};
use fresnel_gen::language::ir::{Checked, Value, evaluate};
use fresnel_gen::language::methods;
use fresnel_gen::physics::num::ulp_distance;

/// Twice what unfused f32 may be off: a device may fuse, and divide in two steps.
const ULP: f64 = 16.0;

fn shader(path: &str) -> Vec<u8> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-generated");
    fs::read(root.join(path)).unwrap()
}

fn text(path: &str) -> String {
    String::from_utf8(shader(path)).unwrap()
}

/// The arguments of a run, all colours.
fn uniforms(arguments: &[(&str, [f32; 3])]) -> Vec<Uniform> {
    let uniform = |&(name, value): &(&str, [f32; 3])| Uniform {
        name: name.to_owned(),
        value: Argument::Rgb(value),
    };
    arguments.iter().map(uniform).collect()
}

#[track_caller]
fn check(backend: Backend, code: ShaderCode, function: &Checked, arguments: &[(&str, [f32; 3])]) {
    let Some(device) = device(backend) else {
        return;
    };
    let uniforms = uniforms(arguments);
    let cosines = cosines(20_000);
    let kernel = device.prepare(&program(code, &uniforms)).unwrap();
    let got = kernel.run(&cosines, &uniforms, None).unwrap();
    assert_eq!(got.len(), cosines.len());
    let mut inputs = vec![Value::each(cosines.iter().map(|c| f64::from(*c)).collect())];
    inputs.extend(arguments.iter().map(|(_, v)| Value::rgb(v.map(f64::from))));
    let want = evaluate::<f64>(function, &inputs);
    for (i, cos_theta) in cosines.iter().enumerate() {
        for (got, want) in got[i].into_iter().zip(want.at(i)) {
            let (off, ulp) = ((f64::from(got) - want).abs(), ulp_distance(got, want));
            let near = off <= ABSOLUTE_FLOOR || ulp <= ULP;
            let on = &device.adapter;
            assert!(
                near,
                "{on}: {got} at {cos_theta}, and {want} in f64: {ulp} ulp"
            );
        }
    }
}

fn gold() -> Checked {
    let request = Request {
        materials: Materials::These(vec![request::Source::Named("gold".to_owned())]),
        ..Request::default()
    };
    let subject = &request.subjects().unwrap().materials()[0];
    let method = methods::find("conductor_exact").unwrap();
    emit::specialised_function(method, subject, &Naming::default(), &Bounds::default())
        .unwrap()
        .function
}

fn conductor() -> Checked {
    let method = methods::find("conductor_exact").unwrap();
    method.function(false).unwrap()
}

/// Gold in linear sRGB, about.
const METAL: [(&str, [f32; 3]); 2] = [("n", [0.17, 0.42, 1.37]), ("k", [3.1, 2.35, 1.77])];

#[test]
fn a_material_in_wgsl() {
    let text = wgsl(&text("wgsl/materials/gold.wgsl"), "fresnel_gold", &[]);
    check(Backend::Vulkan, ShaderCode::Wgsl(&text), &gold(), &[]);
}

#[test]
fn a_material_in_wgsl_on_opengl() {
    let text = wgsl(&text("wgsl/materials/gold.wgsl"), "fresnel_gold", &[]);
    check(Backend::OpenGl, ShaderCode::Wgsl(&text), &gold(), &[]);
}

#[test]
fn a_material_in_spirv() {
    let bytes = shader("spirv/materials/gold.comp.spv");
    check(Backend::Vulkan, ShaderCode::Spirv(&bytes), &gold(), &[]);
}

#[test]
fn a_material_in_gles() {
    let text = gles(&text("gles/materials/gold.glsl"), "fresnel_gold", &[]);
    check(Backend::Gles, ShaderCode::Gles(&text), &gold(), &[]);
}

#[test]
fn the_library_in_wgsl() {
    let text = text("wgsl/fresnel_conductor_exact.wgsl");
    let text = wgsl(&text, "fresnel_conductor_exact", &["n", "k"]);
    check(
        Backend::Vulkan,
        ShaderCode::Wgsl(&text),
        &conductor(),
        &METAL,
    );
}

#[test]
fn the_library_in_spirv() {
    let bytes = shader("spirv/fresnel_conductor_exact.comp.spv");
    check(
        Backend::Vulkan,
        ShaderCode::Spirv(&bytes),
        &conductor(),
        &METAL,
    );
}

#[test]
fn the_library_in_gles() {
    let text = text("gles/fresnel_conductor_exact.glsl");
    let text = gles(&text, "fresnel_conductor_exact", &["n", "k"]);
    check(Backend::Gles, ShaderCode::Gles(&text), &conductor(), &METAL);
}

#[test]
fn more_than_a_block_comes_back_in_order() {
    let source = "fn twice(x: f32) -> vec3<f32> { return vec3<f32>(x, 2.0 * x, 1.0); }";
    let texts = [
        (Backend::Vulkan, wgsl(source, "twice", &[])),
        (
            Backend::Gles,
            gles(
                "highp vec3 twice(highp float x) { return vec3(x, 2.0 * x, 1.0); }",
                "twice",
                &[],
            ),
        ),
    ];
    let points: Vec<f32> = (0..1_000_001).map(|i| i as f32).collect();
    for (backend, text) in &texts {
        let Some(device) = device(*backend) else {
            continue;
        };
        let code = match backend {
            Backend::Gles => ShaderCode::Gles(text),
            _ => ShaderCode::Wgsl(text),
        };
        let kernel = device.prepare(&program(code, &[])).unwrap();
        let got = kernel.run(&points, &[], None).unwrap();
        assert!(
            got.iter().eq(points
                .iter()
                .map(|&x| [x, 2.0 * x, 1.0])
                .collect::<Vec<_>>()
                .iter())
        );
        assert!(kernel.run(&[], &[], None).unwrap().is_empty());
    }
}
