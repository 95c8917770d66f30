//! MaterialX: nodes for F, as graphs of standard nodes, so that every target has them.

use super::flavour::{Flavour, FlavourPage};
use crate::generator::exchange::Model;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "materialx",
    summary: "nodes for F, as graphs of standard nodes",
    host: "MaterialX 1.39",
    source: "https://github.com/AcademySoftwareFoundation/MaterialX/blob/main/documents/Specification/MaterialX.Specification.md",
    proof: "MaterialX 1.39.5 generates GLSL, ESSL and Vulkan GLSL, which glslang accepts, and F of it runs in OpenGL ES; OSL not checked",
    stock: Some(Model::f82_tint_or_law),
    coated_f0: None,
    languages: &[],
    table: None,
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/materialx/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.mtlx",
            template: include_str!("../../../templates/flavours/materialx/fresnel.mtlx.tera"),
        },
        FlavourPage {
            name: "{material}.mtlx",
            template: include_str!("../../../templates/flavours/materialx/material.mtlx.tera"),
        },
    ],
};
