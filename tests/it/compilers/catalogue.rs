//! The array of fitted coefficients beside the library functions that take them, in every language with text: rows by constants
//! and by an index that is known at run time only.

use super::accepted;
use super::msl;
use fresnel_gen::generator::emit::validate_wgsl;
use fresnel_gen::generator::generate;
use fresnel_gen::generator::generate::catalogue::add_catalogue;
use fresnel_gen::generator::request::{Materials, Request};
use fresnel_gen::lab::verify::compilers::{is_here, verdict};
use fresnel_gen::language::targets::{self, Finish, Target};
use fresnel_gen::physics::num::Precision;

/// A function that reads the array by constants and one that reads it by what only a run knows.
fn users(target: &str) -> String {
    let arguments = |row: &str| {
        let rows = [0, 1, 2, 3].map(|i| format!("FRESNEL_CATALOGUE[{row} + {i}]"));
        rows.join(", ")
    };
    let constant = format!("fresnel_fitted(c, {})", arguments("FRESNEL_GOLD"));
    let any = format!("fresnel_fitted_dielectric(c, {})", arguments("row"));
    let first = "FRESNEL_FIRST_DIELECTRIC";
    let target = targets::find(target).unwrap();
    match target.finish {
        Finish::ValidWgsl => format!(
            "fn gold(c: f32) -> vec3<f32> {{\n    return {constant};\n}}\nfn any(c: f32) -> vec3<f32> {{\n    let row = {first} + 4u * \
             u32(30.0 * c);\n    return {any};\n}}\n"
        ),
        _ => {
            let rgb = target.spelling.rgb;
            let (highp, _) = target.spelling.param.split_once("{type}").unwrap();
            format!(
                "{highp}{rgb} gold({highp}float c) {{\n    return {constant};\n}}\n{highp}{rgb} any_of({highp}float c) {{\n    {highp}int \
                 row = {first} + 4 * int(c);\n    return {any};\n}}\n"
            )
        }
    }
}

/// The library functions, the array, and what uses both.
fn program(target: &str) -> String {
    let request = Request {
        targets: vec![targets::find(target).unwrap()],
        materials: Materials::None,
        ..Request::default()
    };
    let mut generated = generate(&request).unwrap();
    let names = ["/fresnel_fitted.", "/fresnel_fitted_dielectric."];
    generated
        .artifacts
        .retain(|file| names.iter().any(|name| file.path.contains(name)));
    add_catalogue(&mut generated, &request).unwrap();
    generated
        .artifacts
        .sort_by_key(|file| file.path.contains("catalogue"));
    let texts = generated.artifacts.into_iter().map(|file| file.bytes);
    let text: Vec<u8> = texts.flatten().collect();
    String::from_utf8(text).unwrap() + &users(target)
}

#[test]
fn the_catalogue_is_accepted_with_what_uses_it() {
    for target in targets::ALL.iter().filter(|t| t.finish != Finish::Spirv) {
        let text = program(target.name);
        let name = format!("catalogue.{}", target.extension);
        let here = target.validators.iter().filter(|v| is_here(v.compiler));
        let validators: Vec<_> = here.collect();
        accepted(&validators, |validator| {
            match verdict(validator, &name, text.as_bytes()) {
                Ok(()) => Ok(String::new()),
                Err(fault) => Err(format!("{}: {}: {fault}", target.name, validator.name)),
            }
        });
    }
    if msl::COMPILER.is_here("the syntax of msl") {
        msl::judge(&[program("msl")]).unwrap();
    }
}

/// The function that `docs/shaders.md` shows for rows of half floats, below the functions that take them.
#[test]
fn rows_of_half_floats_are_accepted_with_what_reads_them() {
    let request = Request::new()
        .target(Target::WGSL)
        .material("gold")
        .material("water")
        .precision(Precision::F16)
        .catalogue();
    let files = generate(&request).unwrap().artifacts;
    let text = |name: &str| {
        let file = files
            .iter()
            .find(|file| file.path == format!("wgsl/{name}.wgsl"));
        String::from_utf8(file.expect(name).bytes.clone()).unwrap()
    };
    let second = text("fresnel_fitted_dielectric_f16").replace("enable f16;", "");
    let page = include_str!("../../../docs/shaders.md");
    let blocks = page.split("```wgsl\n").skip(1);
    let mut blocks = blocks.map(|block| block.split("```").next().unwrap());
    let example = blocks
        .find(|block| block.contains("catalogue.f16.std430.bin"))
        .unwrap();
    let text = text("fresnel_fitted_f16") + &second + &text("catalogue") + example;
    validate_wgsl(&text).unwrap();
    // The same buffer without `enable f16;`.
    let unpacked = "vec4<f32>(unpack2x16float(v.x), unpack2x16float(v.y))";
    assert!(page.contains(unpacked));
    validate_wgsl(&format!(
        "fn halves(v: vec2<u32>) -> vec4<f32> {{ return {unpacked}; }}"
    ))
    .unwrap();
}

#[test]
fn a_module_has_none() {
    let spirv = targets::find("spirv").unwrap();
    assert!(spirv.catalogue.is_none());
    let text = targets::ALL.iter().filter(|t| t.finish != Finish::Spirv);
    assert!(text.into_iter().all(|target| target.catalogue.is_some()));
}
