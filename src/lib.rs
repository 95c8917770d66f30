//! fresnel-gen turns measured optical constants into Fresnel reflectance functions that a shader can afford.
//!
//! # In a build script
//!
//! ```toml
//! [build-dependencies]
//! fresnel-gen = { version = "0.1", default-features = false }
//! ```
//!
//! A `build.rs` that writes gold from the catalogue and a material of its own as WGSL:
//!
//! ```no_run
//! use fresnel_gen::{Method, Request, Space, Target, generate};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let request = Request::new()
//!         .target(Target::WGSL)
//!         .method(Method::CONDUCTOR_EXACT)
//!         .material("gold")
//!         .material_file("materials/brass.toml")?
//!         .space(Space::DisplayP3);
//!     for input in request.inputs() {
//!         println!("cargo::rerun-if-changed={input}");
//!     }
//!     // For example OUT_DIR/wgsl/materials/gold.wgsl. What an earlier build wrote there and this one does not goes.
//!     generate(&request)?.write_to(std::env::var("OUT_DIR")?)?;
//!     Ok(())
//! }
//! ```
//!
//! # What is stable
//!
//! The names at the root of this crate. [`Request`] says what is wanted, step by step; [`Target`], [`Method`], [`Effect`], [`Flavour`]
//! and [`Space`] are read from their names (`"wgsl".parse()`) or named as constants, and their fields are internal. [`generate()`] and
//! [`generate_single`] give [`Generated`], [`Artifact`]s or bytes; [`Generated::write_to`] and [`write_file`] write them; [`Error`]
//! says what was wrong. A change of them has an entry in the changelog. Fields and variants whose types are not among these names
//! keep their default values, and are internal.
//!
//! All modules are internal. They are public for the program and its tests, and may change in any release.
//!
//! # Inside
//!
//! One description of each method ([`language::methods`]), an intermediate representation ([`language::ir`]) and a table per language
//! ([`language::targets`]) give WGSL, GLSL ES 3.00, HLSL, SPIR-V, MSL and GLSL 450. The exact laws ([`physics::optics`]) are written a
//! second time without the IR, and all else is held against them. ARCHITECTURE.md says more.
#![cfg_attr(test, allow(clippy::print_stdout, clippy::unwrap_used))]

// Wings: physics < language < generator < lab < pictures < cli
#[cfg(feature = "cli")]
pub mod cli;
pub mod generator;
#[cfg(feature = "lab")]
pub mod lab;
pub mod language;
pub mod physics;
#[cfg(feature = "pictures")]
pub mod pictures;

// What build scripts use. The test `snapshots::api` lists it.
pub use generator::emit::{Artifact, HeaderForm};
pub use generator::error::Error;
pub use generator::flavours::Flavour;
pub use generator::generate::{Generated, generate, generate_single};
pub use generator::output::write::write_file;
pub use generator::request::{Materials, Methods, Request, Source};
pub use language::effects::Effect;
pub use language::methods::Method;
pub use language::targets::Target;
pub use physics::materials::ViewingConditions;
pub use physics::num::Precision;
pub use physics::spectra::Space;

/// The documents' Rust is compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../docs/builds.md")]
pub struct Documents;
