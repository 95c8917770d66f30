//! The integration tests, one binary.
// These lints are for the library. A test that could not check something says so on stderr.
#![allow(clippy::unwrap_used, clippy::print_stdout, clippy::print_stderr)]

#[cfg(all(feature = "cli", feature = "gpu"))]
mod audit;
mod bless;
mod bounds;
#[cfg(any(feature = "pictures", all(feature = "cli", feature = "gpu")))]
mod browser;
mod catalogue;
#[cfg(feature = "pictures")]
mod chart_page;
mod claims;
#[cfg(feature = "cli")]
mod cli;
mod code_bounds;
#[cfg(feature = "compilers")]
mod compilers;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod costs;
mod database;
mod domains;
mod effects;
mod exhaustive;
mod f82;
mod fits;
#[cfg(feature = "cli")]
mod flavours;
mod furnace;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod gallery;
mod gamut;
mod golden;
#[cfg(feature = "gpu")]
mod gpu;
mod graph;
mod grey_tint;
mod half;
mod incidents;
mod licences;
#[cfg(feature = "cli")]
mod lut;
mod oracle;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod overdraw;
mod pages;
mod physics;
#[cfg(feature = "pictures")]
mod pictures;
#[cfg(feature = "cli")]
mod plan;
mod published_costs;
mod raster;
mod readme;
mod records;
mod release;
mod reproduce;
mod reread;
mod samples;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod scene;
mod shapes;
mod snapshots;
mod specialise;
mod spectral;
mod split_sum;
#[cfg(feature = "cli")]
mod stability;
mod stated;
mod tidy;
mod tree;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod verify;
mod working_spaces;

use fresnel_gen::app::{Materials, Request, Source};
use fresnel_gen::generator::reference::MaterialInMedium;

/// Materials of the catalogue, seen as they are unless asked otherwise.
pub fn subjects(names: &[&str]) -> Vec<MaterialInMedium> {
    let named = |name: &&str| Source::Named((*name).to_owned());
    let request = Request {
        materials: Materials::These(names.iter().map(named).collect()),
        ..Request::default()
    };
    request.subjects().unwrap().materials()
}

/// Says what could not be checked here, and how to check it. Unlike what the macros print, this is seen of a test that passes.
pub fn not_checked(what: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "not checked: {what}");
}
