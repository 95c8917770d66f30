//! Unreal Engine 5: shader headers for the material node Custom, and for users' own shaders.

use super::flavour::{Flavour, FlavourPage};
use crate::generator::exchange::Model;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "unreal",
    summary: "shader headers for the node Custom of materials",
    host: "Unreal Engine 5",
    source: "https://dev.epicgames.com/documentation/en-us/unreal-engine/custom-material-expressions-in-unreal-engine",
    proof: "compiled by DXC as HLSL 2021, not run",
    stock: Some(|material| {
        let f0 = material.f0_in_engines();
        let words = "Schlick's approximation, F90 by min(50 F0, 1)";
        Model::schlick_f90(words, f0, (50.0 * f0[1]).min(1.0))
    }),
    coated_f0: None,
    languages: &["hlsl"],
    table: None,
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/unreal/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.ush",
            template: include_str!("../../../templates/flavours/unreal/fresnel.ush.tera"),
        },
        FlavourPage {
            name: "{material}.ush",
            template: include_str!("../../../templates/flavours/unreal/material.ush.tera"),
        },
    ],
};
