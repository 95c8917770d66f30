//! MSL's syntax and types, read by a C++ compiler with a small stand-in for Metal's library.
//! This is not Metal's own compiler, which exists on macOS only, and the run says so.

use std::fs;

use tempfile::TempDir;

use super::Judgement;
use super::Tool;
use super::files;
use super::joined;
use super::text;
use super::tree;

pub const COMPILER: Tool = Tool {
    command: "g++",
    package: "g++",
};

/// As much of `metal_stdlib` as the files use. As in Metal, a scalar meets a vector in operators but not in functions.
const STAND_IN: &str = "
#pragma once
#define constant const
struct half {
    float value;
    explicit operator float() const;
};
half operator\"\"h(long double);
half operator-(half);
half operator+(half, half);
half operator-(half, half);
half operator*(half, half);
half operator/(half, half);
bool operator<(half, half);
namespace metal {
struct float3 {
    float r, g, b, x, y, z;
    explicit float3(float);
    float3(float, float, float);
};
float3 operator-(float3);
#define OPERATOR(o) float3 operator o(float3, float3); float3 operator o(float3, float); float3 operator o(float, float3);
OPERATOR(+) OPERATOR(-) OPERATOR(*) OPERATOR(/)
#define ONE(f) float f(float); float3 f(float3);
ONE(abs) ONE(cos) ONE(exp2) ONE(log2) ONE(rsqrt) ONE(saturate) ONE(sin) ONE(sqrt)
#define TWO(f) float f(float, float); float3 f(float3, float3);
TWO(max) TWO(min)
struct half3 {
    half r, g, b;
    explicit half3(half);
    explicit half3(float3);
    half3(half, half, half);
};
half3 operator-(half3);
#define HALF_OPERATOR(o) half3 operator o(half3, half3); half3 operator o(half3, half); half3 operator o(half, half3);
HALF_OPERATOR(+) HALF_OPERATOR(-) HALF_OPERATOR(*) HALF_OPERATOR(/)
#define HALF_ONE(f) half f(half); half3 f(half3);
HALF_ONE(abs) HALF_ONE(cos) HALF_ONE(exp2) HALF_ONE(log2) HALF_ONE(rsqrt) HALF_ONE(saturate) HALF_ONE(sin) HALF_ONE(sqrt)
#define HALF_TWO(f) half f(half, half); half3 f(half3, half3);
HALF_TWO(max) HALF_TWO(min)
float dot(float3, float3);
half dot(half3, half3);
struct float2 { float x, y; float2(float, float); explicit float2(half, half); };
struct float4 { float3 rgb; float a, x, y, z, w; float4(float3, float); };
struct float4x4 {};
float4 operator*(float4x4, float4);
struct sampler {};
struct level { explicit level(float); };
template <typename T> struct texture2d { float4 sample(sampler, float2, level) const; };
template <typename T> struct texturecube { float4 sample(sampler, float3, level) const; };
}
";

#[test]
fn msl_is_accepted_by_a_cpp_compiler() {
    if !COMPILER.is_here("the syntax of msl") {
        return;
    }
    let tree = joined(&tree("msl"));
    let mut units: Vec<String> = files("msl")
        .iter()
        .map(|file| text(file).repeat(2))
        .collect();
    // The names of the library are written in full, so that both kinds of including file are served.
    units.push(format!(
        "#include <metal_stdlib>\nusing namespace metal;\n{tree}"
    ));
    units.push(tree.repeat(2));
    judge(&units).unwrap();
}

#[test]
fn broken_msl_is_refused() {
    if !COMPILER.is_here("that broken msl is refused") {
        return;
    }
    let good = joined(&tree("msl"));
    for (from, to) in [
        ("metal::sqrt", "sqrt"),
        ("metal::max(", "metal::max(1.0, "),
        // Without its suffix a number is a double, which Metal does not have.
        ("1.0f", "1.0"),
        ("#ifndef", "#undef"),
    ] {
        assert!(good.contains(from), "{from}");
        judge(&[good.replace(from, to).repeat(2)]).expect_err(to);
    }
}

pub fn judge(units: &[String]) -> Judgement {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("metal_stdlib"), STAND_IN).unwrap();
    let options = "-std=c++14 -fsyntax-only -Wall -Wconversion -Wdouble-promotion -Wno-literal-suffix -Werror -I";
    let mut arguments: Vec<_> = options.split(' ').map(Into::into).collect();
    arguments.push(folder.path().to_owned());
    for (index, unit) in units.iter().enumerate() {
        let file = at(&format!("{index}.cpp"));
        fs::write(&file, unit).unwrap();
        arguments.push(file);
    }
    COMPILER.run(arguments)
}
