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
//! use std::path::Path;
//!
//! use fresnel_gen::{Materials, Request, Source, generate, write_file};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let file = "materials/brass.toml";
//!     println!("cargo::rerun-if-changed={file}");
//!     let request = Request {
//!         targets: vec!["wgsl".into()],
//!         methods: vec!["conductor_exact".into()],
//!         materials: Materials::These(vec![
//!             Source::Named("gold".into()),
//!             Source::File {
//!                 file: file.into(),
//!                 text: std::fs::read_to_string(file)?,
//!             },
//!         ]),
//!         ..Request::default()
//!     };
//!     let out_dir = std::env::var("OUT_DIR")?;
//!     for artifact in generate(&request)?.artifacts {
//!         // For example OUT_DIR/wgsl/materials/gold.wgsl. A file that is right already is left alone.
//!         write_file(&Path::new(&out_dir).join(&artifact.path), &artifact.bytes)?;
//!     }
//!     Ok(())
//! }
//! ```
//!
//! # What is stable
//!
//! The names at the root of this crate: [`Request`], [`Materials`], [`Source`] and [`Precision`] say what is wanted;
//! [`generate()`] and [`generate_single`] give [`Generated`], [`Artifact`]s or bytes; [`write_file`] writes them; [`Error`] says
//! what was wrong. A change of them has an entry in the changelog. Fields and variants whose types are not among these names
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
pub use generator::error::Error;
pub use generator::generate::{Generated, generate, generate_single};
pub use generator::output::artifact::Artifact;
pub use generator::output::write::write_file;
pub use generator::request::{Materials, Request, Source};
pub use physics::num::Precision;

/// The documents' Rust is compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../docs/builds.md")]
pub struct Documents;
