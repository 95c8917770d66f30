//! fresnel-gen turns measured optical constants into Fresnel reflectance functions that a shader can afford.
//!
//! One description of each method ([`methods`]), an intermediate representation ([`ir`]) and a table per language
//! ([`targets`]) give WGSL, GLSL ES 3.00, HLSL, SPIR-V, MSL and GLSL 450. The exact laws ([`optics`]) are written a
//! second time without the IR, and all else is held against them.
#![cfg_attr(test, allow(clippy::print_stdout, clippy::unwrap_used))]

// The rooms. A room imports only rooms to its left; rooms between the same two `<` do not import each other.
// num, cite, names < ir, optics < spectra < materials, methods, targets < reference < fit < emit < lut < gpu, process < verify, cost < overdraw, stability < audit, budget, bake < scene, effects < report < app

pub mod app;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod audit;
#[cfg(feature = "cli")]
pub mod bake;
pub mod budget;
pub mod cite;
pub mod cost;
pub mod emit;
pub mod fit;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod ir;
pub mod lut;
pub mod materials;
pub mod methods;
pub mod names;
pub mod num;
pub mod optics;
pub mod overdraw;
pub mod process;
pub mod reference;
pub mod report;
pub mod spectra;
pub mod stability;
pub mod targets;
pub mod verify;

/// The documents' Rust is compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../docs/builds.md")]
pub struct Documents;
