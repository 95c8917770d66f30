//! What cannot run says why, in the words of what refused it.

use super::device;
use super::gles;
use super::program;
use super::wgsl;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{
    Argument, Backend, Device, ShaderCode, Texture, TextureFilter, TextureFormat, TextureShape,
    Uniform, Wanted, Wrap, adapters,
};

/// The log of a refusal, or nothing where there is no device.
#[track_caller]
fn refused(backend: Backend, code: ShaderCode) -> Option<String> {
    let device = device(backend)?;
    match device.prepare(&program(code, &[])) {
        Err(Fault::Failed(log)) => Some(log),
        Err(fault) => panic!("{fault}"),
        Ok(_) => panic!("it was accepted"),
    }
}

#[test]
fn broken_wgsl() {
    for (source, word) in [
        (
            "fn f(x: f32) -> vec3<f32> { return vec3<f32>(x) }",
            "expected `;`",
        ),
        ("fn f(x: f32) -> vec3<f32> { return wrong; }", "wrong"),
        (
            "fn f(x: f32) -> vec3<f32> { return vec2<f32>(x); }",
            "Function [0] 'f' is invalid",
        ),
    ] {
        let text = wgsl(source, "f", &[]);
        for backend in [Backend::Vulkan, Backend::OpenGl] {
            if let Some(log) = refused(backend, ShaderCode::Wgsl(&text)) {
                assert!(log.contains(word), "{log}");
            }
        }
    }
}

#[test]
fn a_layout_that_does_not_fit() {
    let source = "fn f(x: f32, n: vec3<f32>) -> vec3<f32> { return n * x; }";
    // The program says that it has no arguments, and the text has a block of them.
    let text = wgsl(source, "f", &["n"]);
    if let Some(log) = refused(Backend::Vulkan, ShaderCode::Wgsl(&text)) {
        assert!(log.contains("binding"), "{log}");
    }
}

#[test]
fn broken_gles() {
    for (source, word) in [
        (
            "highp vec3 f(highp float x) { return vec3(x) }",
            "syntax error",
        ),
        ("highp vec3 f(highp float x) { return wrong; }", "wrong"),
    ] {
        if let Some(log) = refused(Backend::Gles, ShaderCode::Gles(&gles(source, "f", &[]))) {
            assert!(log.contains(word), "{log}");
        }
    }
    let unnamed = "#version 300 es\nin highp float cos_theta;\nvoid main() { gl_Position = vec4(cos_theta); }\n";
    if let Some(log) = refused(Backend::Gles, ShaderCode::Gles(unnamed)) {
        assert!(log.contains("reflectance"), "{log}");
    }
}

#[test]
fn broken_spirv() {
    let fragment = include_bytes!("../../../shaders-generated/spirv/fresnel_schlick.frag.spv");
    for (bytes, word) in [
        (&fragment[..], "no compute entry point `main`"),
        (b"text", "no SPIR-V"),
        (&fragment[..fragment.len() - 1], "no SPIR-V"),
    ] {
        if let Some(log) = refused(Backend::Vulkan, ShaderCode::Spirv(bytes)) {
            assert!(log.contains(word), "{log}");
        }
    }
}

#[test]
fn a_language_on_the_wrong_stack() {
    for (backend, code) in [
        (Backend::Vulkan, ShaderCode::Gles("")),
        (Backend::Gles, ShaderCode::Wgsl("")),
    ] {
        if let Some(device) = device(backend) {
            let fault = device.prepare(&program(code, &[])).err();
            assert!(matches!(fault, Some(Fault::Absent(_))), "{fault:?}");
        }
    }
}

#[test]
fn arguments_and_textures_that_do_not_fit() {
    let uniform = |value| Uniform {
        name: "n".to_owned(),
        value,
    };
    let uniforms = [uniform(Argument::Rgb([1.0; 3]))];
    let texels = [[0.0; 4]; 3];
    let texture = Texture {
        width: 2,
        texels: &texels,
        format: TextureFormat::Half,
        wrap: Wrap::Clamp,
        shape: TextureShape::Flat,
        filter: TextureFilter::Linear,
    };
    let wgsl = wgsl(
        "fn f(x: f32, n: vec3<f32>) -> vec3<f32> { return n * x; }",
        "f",
        &["n"],
    );
    let gles = gles(
        "highp vec3 f(highp float x, highp vec3 n) { return n * x; }",
        "f",
        &["n"],
    );
    for (backend, code) in [
        (Backend::Vulkan, ShaderCode::Wgsl(&wgsl)),
        (Backend::Gles, ShaderCode::Gles(&gles)),
    ] {
        let Some(device) = device(backend) else {
            continue;
        };
        let kernel = device.prepare(&program(code, &uniforms)).unwrap();
        let fault = |uniforms: &[Uniform], texture| {
            kernel
                .run(&[0.5], uniforms, texture)
                .unwrap_err()
                .to_string()
        };
        assert!(fault(&[], None).contains("(n: rgb)"));
        assert!(fault(&[uniform(Argument::Scalar(1.0))], None).contains("(n: scalar)"));
        assert!(fault(&uniforms, Some(&texture)).contains("no texture"));
        assert_eq!(kernel.run(&[0.5], &uniforms, None).unwrap(), [[0.5; 3]]);
    }
}

#[test]
fn an_adapter_that_is_not_there() {
    let wanted = Wanted {
        backend: None,
        name: Some("abacus".to_owned()),
    };
    let Err(Fault::Absent(why)) = Device::open(&wanted) else {
        panic!("there is an abacus");
    };
    let (what, get) = why.split_once("; ").unwrap();
    assert!(what.contains("`abacus`"), "{what}");
    let there = adapters();
    for adapter in there.iter().filter(|a| a.backend != Backend::Gles) {
        assert!(get.contains(&adapter.name), "{get}");
    }
    if there.is_empty() {
        assert!(get.contains("mesa-vulkan-drivers"), "{get}");
    }
}
