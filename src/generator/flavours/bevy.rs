//! Bevy: modules to import, in WESL for Bevy 0.20 and for naga_oil, which Bevy used up to 0.19.

use super::flavour::{Flavour, FlavourPage};
use crate::generator::exchange::Model;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "bevy",
    summary: "modules to be imported, in WESL and for naga_oil",
    host: "Bevy 0.20",
    source: "https://docs.rs/naga_oil/0.23.0/naga_oil/",
    proof: "composed by naga_oil 0.23 and run through wgpu 30; not run in Bevy",
    stock: Some(|material| Model::schlick_f90_of_sum(material.f0_in_engines())),
    coated_f0: None,
    languages: &["wgsl"],
    table: None,
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/bevy/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.wesl",
            template: include_str!("../../../templates/flavours/bevy/fresnel.wesl.tera"),
        },
        FlavourPage {
            name: "fresnel.wgsl",
            template: include_str!("../../../templates/flavours/bevy/fresnel.wgsl.tera"),
        },
        FlavourPage {
            name: "{material}.wesl",
            template: include_str!("../../../templates/flavours/bevy/material.wesl.tera"),
        },
        FlavourPage {
            name: "{material}.wgsl",
            template: include_str!("../../../templates/flavours/bevy/material.wgsl.tera"),
        },
    ],
};
