//! PlayCanvas: a module that patches the shader chunks of standard materials.

use super::flavour::{Flavour, FlavourPage};
use crate::generator::exchange::Model;
use crate::generator::lut::SplitSumAxis;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "playcanvas",
    summary: "a module that patches standard materials",
    host: "PlayCanvas 2.23.3",
    source: "https://developer.playcanvas.com/user-manual/graphics/shaders/",
    proof: "run in PlayCanvas 2.23.3, by WebGL 2 and by WebGPU",
    stock: |material| match material.film {
        Some(film) if film.thickness_nm > 0.0 => Model::iridescence(&film, film.f0),
        _ => Model::schlick(material.f0_in_engines()),
    },
    coated_f0: Some(|f0| f0),
    languages: &["gles", "wgsl"],
    // The module reads it along these axes. Its error is below .003 for every material of the catalogue.
    table: Some((64, [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt])),
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/playcanvas/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.js",
            template: include_str!("../../../templates/flavours/playcanvas/fresnel.js.tera"),
        },
    ],
};
