//! `materials params`: the numbers that an engine wants of a material, and how well each is known.

use std::path::Path;

use serde::Serialize;

use crate::app::args::ParamsFlags;
use crate::app::error::Error;
use crate::app::request::load;
use crate::fit::{MaterialParams, material_params};
use crate::materials::{self, ViewingConditions};
use crate::report::SCHEMA;
use crate::report::params::params_text;
use crate::spectra::Gamut;

use super::materials::medium;
use super::{Output, report};

#[derive(Serialize)]
struct ParamsReport<'a> {
    schema: u32,
    #[serde(flatten)]
    params: &'a MaterialParams,
}

/// `fresnel-gen materials params NAME`.
pub fn run(flags: &ParamsFlags, json: Option<&Path>) -> Result<Output, Error> {
    let material = load(&flags.name.source()?)?.material;
    let medium = medium(&flags.medium)?;
    let medium = medium.as_ref().map(|medium| &medium.material);
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..flags.viewing.conditions()?
    };
    let params = &material_params(&material, medium, &viewing, &materials::list()?)?;
    let schema = SCHEMA;
    let text = params_text(params, &material, medium);
    report(text, &ParamsReport { schema, params }, json)
}
