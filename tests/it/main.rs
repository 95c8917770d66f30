//! The integration tests, one binary.
// These lints are for the library. A test that could not check something says so on stderr.
#![allow(clippy::unwrap_used, clippy::print_stdout, clippy::print_stderr)]

mod audit;
mod bless;
mod bounds;
mod browser;
mod catalogue;
mod chart_page;
mod claims;
mod cli;
mod code_bounds;
mod code_error;
mod compensation;
mod compilers;
mod costs;
mod database;
mod domains;
mod effects;
mod exhaustive;
mod f82;
mod films;
mod fits;
mod flavours;
mod forms;
mod furnace;
mod gallery;
mod gamut;
mod golden;
mod gpu;
mod graph;
mod grey_tint;
mod half;
mod headline;
mod incidents;
mod licences;
mod lut;
mod numbers;
mod oracle;
mod overdraw;
mod pages;
mod physics;
mod pictures;
mod plan;
mod published_costs;
mod raster;
mod readme;
mod recorded_errors;
mod records;
mod release;
mod reproduce;
mod reread;
mod samples;
mod scene;
mod shapes;
mod snapshots;
mod specialise;
mod spectral;
mod split_sum;
mod stability;
mod stated;
mod tables;
mod tidy;
mod tinted;
mod tree;
mod verify;
mod working_spaces;

use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::generator::request::{Materials, Request, Source};

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
