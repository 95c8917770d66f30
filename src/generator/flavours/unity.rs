//! Unity: HLSL for Shader Graph's node Custom Function, and for users' own lighting functions.

use super::flavour::{Flavour, FlavourPage};
use crate::generator::exchange::Model;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "unity",
    summary: "HLSL for Shader Graph's node Custom Function",
    host: "Unity 6",
    source: "https://docs.unity3d.com/Packages/com.unity.shadergraph@17.0/manual/Custom-Function-Node.html",
    proof: "compiled by DXC with Unity's macros, not run",
    stock: Some(|material| Model::schlick(material.f0_in_engines())),
    coated_f0: None,
    languages: &["hlsl"],
    table: None,
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/unity/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.hlsl",
            template: include_str!("../../../templates/flavours/unity/fresnel.hlsl.tera"),
        },
        FlavourPage {
            name: "{material}.hlsl",
            template: include_str!("../../../templates/flavours/unity/material.hlsl.tera"),
        },
    ],
};
