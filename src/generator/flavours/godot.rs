//! Godot 4: functions for its shading language, as include files.

use super::flavour::{Flavour, FlavourPage};
use crate::generator::exchange::Model;
use crate::generator::lut::SplitSumAxis;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "godot",
    summary: "include files of the shading language, as an add-on",
    host: "Godot 4.6",
    source: "https://docs.godotengine.org/en/stable/tutorials/shaders/shader_reference/shading_language.html",
    proof: "run in Godot 4.6, in its Compatibility renderer; the script of the add-on parsed and not run",
    stock: Some(|material| Model::schlick_f90_of_sum(material.f0_in_engines())),
    coated_f0: None,
    languages: &["glsl"],
    table: Some((32, [SplitSumAxis::Sqrt; 2])),
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/godot/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.gdshaderinc",
            template: include_str!("../../../templates/flavours/godot/fresnel.gdshaderinc.tera"),
        },
        FlavourPage {
            name: "table_fitted.tres",
            template: include_str!("../../../templates/flavours/godot/table_fitted.tres.tera"),
        },
        FlavourPage {
            name: "table_fitted_dielectric.tres",
            template: include_str!(
                "../../../templates/flavours/godot/table_fitted_dielectric.tres.tera"
            ),
        },
        FlavourPage {
            name: "table_fitted_film.tres",
            template: include_str!("../../../templates/flavours/godot/table_fitted_film.tres.tera"),
        },
        FlavourPage {
            name: "plugin.cfg",
            template: include_str!("../../../templates/flavours/godot/plugin.cfg.tera"),
        },
        FlavourPage {
            name: "plugin.gd",
            template: include_str!("../../../templates/flavours/godot/plugin.gd.tera"),
        },
        FlavourPage {
            name: "{material}.gdshaderinc",
            template: include_str!("../../../templates/flavours/godot/material.gdshaderinc.tera"),
        },
    ],
};
