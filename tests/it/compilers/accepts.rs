//! Every file of every target under every compiler that can judge it, each function called with run-time arguments so
//! that nothing is dead code; and broken files, which all of them must refuse.

use std::collections::BTreeMap;

use super::Judgement;
use super::accepted;
use super::files;
use super::joined;
use super::precision;
use super::text;
use super::tree;
use crate::not_checked;
use fresnel_gen::generator::fit::Measured;
use fresnel_gen::generator::generate::generate_single;
use fresnel_gen::generator::request::{Materials, Methods, Request, Source};
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::verify::compilers::{accepts, calls, is_here, verdict, version};
use fresnel_gen::language::methods::Method;
use fresnel_gen::language::targets::{self, Finish, Target, Validator};
use fresnel_gen::physics::num::Precision;

/// The compilers that must be there where `CI` is set.
const PROMISED: [&str; 4] = ["naga", "glslang", "spirv-val", "dxc"];

/// The compilers that take a tenth of a second and more for a file.
const SLOW: [&str; 1] = ["dxc"];

#[test]
fn compilers_that_are_not_here_are_named() {
    for target in targets::ALL {
        assert!(!target.validators.is_empty(), "{}", target.name);
        for validator in target.validators.iter().filter(|v| !is_here(v.compiler)) {
            let file = files(target.name)[0];
            let Err(Fault::Absent(reason)) = verdict(validator, "file", &file.bytes) else {
                panic!("{} judged and is not here", validator.name);
            };
            let remark = format!("{} by {}: {reason}", target.name, validator.name);
            let is_promised = PROMISED.contains(&validator.compiler.name);
            assert!(
                std::env::var_os("CI").is_none() || !is_promised,
                "not checked: {remark}"
            );
            not_checked(&remark);
        }
    }
}

#[test]
fn every_function_is_called() {
    for target in targets::ALL.iter().filter(|t| t.finish != Finish::Spirv) {
        for file in files(target.name) {
            let functions = file.detail.functions();
            let calls = calls(text(file), target.name == "wgsl");
            assert_eq!(calls.lines().count(), functions.len(), "{}", file.path);
            for function in functions {
                // A mean over the hemisphere takes no angle: its first argument is a coefficient.
                let call = format!("    sum += {}(at", function.name);
                assert!(calls.contains(&call), "{}: no {call}", file.path);
            }
        }
    }
}

/// Targets with a test of their own below, so that they are checked side by side.
const OWN: [&str; 6] = ["gles", "glsl", "hlsl", "msl", "spirv", "wgsl"];

#[test]
fn all_other_targets_are_accepted() {
    let names = targets::ALL.iter().map(|target| target.name);
    names.filter(|name| !OWN.contains(name)).for_each(check);
}

#[test]
fn gles_is_accepted() {
    check("gles");
}

#[test]
fn glsl_is_accepted() {
    check("glsl");
}

#[test]
fn hlsl_is_accepted() {
    check("hlsl");
}

#[test]
fn msl_is_accepted() {
    check("msl");
}

#[test]
fn spirv_is_accepted() {
    check("spirv");
}

#[test]
fn wgsl_is_accepted() {
    check("wgsl");
}

#[track_caller]
fn check(target: &str) {
    let target = targets::find(target).unwrap();
    for precision in Precision::ALL {
        let validators = target.validators_in(precision).iter();
        for validator in validators.filter(|v| is_here(v.compiler)) {
            let units = units(target, precision, SLOW.contains(&validator.compiler.name));
            accepted(&units, |(name, bytes)| judge(validator, name, bytes));
        }
    }
}

/// Each file, and what a shader may hold together: each variant of the tree. With guards all may be included twice; WGSL
/// has none, so that no two names of a variant may meet. A slow compiler sees the files of the variants together only, and
/// everything twice only.
fn units(target: &Target, computes_in: Precision, slow: bool) -> Vec<(String, Vec<u8>)> {
    let mut files = files(target.name);
    files.retain(|file| precision(file) == computes_in);
    let lone = files
        .iter()
        .filter(|file| !slow || variant(&file.path).is_empty());
    let mut units: Vec<_> = lone
        .map(|file| (file.path.clone(), file.bytes.clone()))
        .collect();
    if target.finish == Finish::Spirv {
        return units;
    }
    let mut whole = BTreeMap::<&str, Vec<u8>>::new();
    for file in &files {
        let unit = whole.entry(variant(&file.path)).or_default();
        unit.extend(joinable(target, unit.is_empty(), &file.bytes));
    }
    let whole = whole.into_iter();
    units.extend(whole.map(|(name, bytes)| (format!("all-{name}.{}", target.extension), bytes)));
    if target.spelling.guard {
        let twice = units
            .iter()
            .map(|(name, bytes)| (name.clone(), bytes.repeat(2)));
        let twice: Vec<_> = twice.collect();
        if slow {
            return twice;
        }
        units.extend(twice);
    }
    units
}

/// A file as it is joined to others: what must stand first stands in the first.
fn joinable(target: &Target, is_first: bool, bytes: &[u8]) -> Vec<u8> {
    let directive = target.directive_in(Precision::F16);
    if is_first || directive.is_empty() {
        return bytes.to_vec();
    }
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    text.replace(&format!("\n{directive}\n"), "\n").into_bytes()
}

/// Before the folder of a target: `every`, `immersed`; nothing for the tree without flags.
fn variant(path: &str) -> &str {
    let before = path.split('/').next().unwrap();
    if targets::find(before).is_some() {
        ""
    } else {
        before
    }
}

/// Functions of several methods, of the library and of materials, in one file as `-o` writes it: what must stand before all code
/// stands there once.
#[test]
fn several_functions_in_one_file_are_accepted() {
    let gold = Materials::These(vec![Source::Named("gold".to_owned())]);
    for target in targets::ALL.iter().filter(|t| t.finish != Finish::Spirv) {
        for (precision, materials) in Precision::ALL.into_iter().flat_map(|precision| {
            [Materials::None, gold.clone()].map(|materials| (precision, materials))
        }) {
            let request = Request {
                targets: vec![*target],
                methods: Methods::These(vec![
                    Method::SCHLICK,
                    Method::FITTED,
                    Method::CONDUCTOR_EXACT,
                ]),
                precision,
                materials,
                ..Request::default()
            };
            let bytes = generate_single(&request).expect("it generates");
            let text = String::from_utf8(bytes.clone()).expect("text");
            let directive = target.directive_in(precision);
            if !directive.is_empty() {
                assert_eq!(
                    text.matches(&format!("\n{directive}\n")).count(),
                    1,
                    "{text}"
                );
            }
            let name = format!("several.{}", target.extension);
            for validator in target
                .validators_in(precision)
                .iter()
                .filter(|v| is_here(v.compiler))
            {
                judge(validator, &name, &bytes).unwrap_or_else(|words| panic!("{words}\n{text}"));
            }
        }
    }
}

fn judge(validator: &Validator, name: &str, bytes: &[u8]) -> Judgement {
    match verdict(validator, name, bytes) {
        Ok(()) => Ok(String::new()),
        // It is there, so that it must be asked.
        Err(fault) => Err(format!("{name}: {}: {fault}", validator.name)),
    }
}

/// Compilers, and something that each says.
type Words<'a> = &'a [(&'a str, &'a str)];

/// Faults of texts: the target, what is spoilt in its tree, and what each of its compilers says then.
#[rustfmt::skip]
const FAULTS: &[(&str, &str, &str, Words)] = &[
    ("gles", "sqrt(", "root(", &[("glslang", "'root' : no matching overloaded function found")]),
    // All is declared highp, so that a shader without a default precision can include it.
    ("gles", "highp ", "", &[("glslang", "default precision qualifier")]),
    ("gles", "#ifndef", "#undef", &[("glslang", "#endif")]),
    ("glsl", "vec3", "float3", &[("glslang", "syntax error")]),
    ("glsl", "return", "retrun", &[("glslang", "'retrun'")]),
    ("hlsl", "float3", "vec3", &[("glslang", "parsing failed"), ("dxc", "unknown type name 'vec3'")]),
    ("hlsl", ";", "", &[("glslang", "';'"), ("dxc", "expected ';'")]),
    ("hlsl", "#endif", "", &[("glslang", "endif"), ("dxc", "unterminated conditional directive")]),
    ("wgsl", ";", "", &[("naga", "expected"), ("tint", "expected ';'")]),
    ("wgsl", "-> f32", "-> u32", &[("naga", "is invalid"), ("tint", "expected 'u32'")]),
    ("wgsl", "saturate(", "saturated(", &[("naga", "saturated"), ("tint", "saturated")]),
    ("wgsl", "_scalar(", "(", &[("naga", "redefinition"), ("tint", "redeclaration")]),
];

#[test]
fn broken_files_are_refused_with_the_words_of_the_compiler() {
    for (name, good, bad, words) in FAULTS {
        let target = targets::find(name).unwrap();
        let tree = joined(&tree(name)).repeat(if target.spelling.guard { 2 } else { 1 });
        assert!(tree.contains(good), "{name}: no {good}");
        refused(target, tree.replace(good, bad).as_bytes(), words);
    }
}

#[test]
fn broken_modules_are_refused() {
    let target = targets::find("spirv").unwrap();
    let good = &files("spirv")[0].bytes;
    // The last instruction is missing.
    refused(target, &good[..good.len() - 4], &[("spirv-val", "rror")]);
    // The sixth word is the first instruction, which declares the capability Shader. Vulkan has none named Linkage.
    let mut other = good.clone();
    other[24] = 5;
    refused(target, &other, &[("spirv-val", "Linkage")]);
}

#[track_caller]
fn refused(target: &Target, bytes: &[u8], words: Words) {
    let verdicts = accepts(
        Precision::F32,
        target,
        &format!("a.{}", target.extension),
        bytes,
    );
    for (validator, (_, verdict)) in target.validators.iter().zip(verdicts) {
        match verdict {
            Ok(()) => panic!("{} accepts it", validator.name),
            Err(Fault::Failed(said)) => {
                let mut expected = words
                    .iter()
                    .filter(|(name, _)| *name == validator.compiler.name);
                let (_, expected) = expected.next().unwrap();
                assert!(
                    said.contains(expected),
                    "{}: no `{expected}` in {said}",
                    validator.name
                );
                assert!(!said.contains("/tmp"), "{said}");
            }
            Err(Fault::Absent(_)) => assert!(!is_here(validator.compiler)),
        }
    }
}

#[test]
fn dxc_judges_by_two_versions_of_the_language() {
    let target = targets::find("hlsl").unwrap();
    let text = "float3 f(float3 a)\n{\n    return a > 0.5 ? a : 1.0 - a;\n}\n";
    for (name, verdict) in accepts(Precision::F32, target, "a.hlsl", text.as_bytes()) {
        match (name, verdict) {
            (_, Err(Fault::Absent(_))) => {}
            ("dxc -HV 2021", Err(Fault::Failed(words))) => {
                assert!(words.contains("a.hlsl:3:20: error"), "{words}")
            }
            ("dxc -HV 2021", Ok(())) => panic!("2021 has no condition of vectors"),
            (_, verdict) => assert_eq!(verdict, Ok(()), "{name}"),
        }
    }
}

#[test]
fn versions_are_told() {
    let all = targets::ALL.iter().flat_map(|target| target.validators);
    for Validator { compiler, .. } in all.filter(|v| is_here(v.compiler) && v.name != "tint") {
        let version = version(compiler);
        let is_digit = |c: char| c.is_ascii_digit();
        let has_number = matches!(&version, Measured::Yes(said) if said.contains(is_digit));
        assert!(has_number, "{}: {version:?}", compiler.name);
    }
}
