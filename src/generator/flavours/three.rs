//! three.js: a module that patches materials of `WebGLRenderer`, and one of nodes for `WebGPURenderer`.

use super::flavour::{Flavour, FlavourPage, MATERIALS_MODULE, MATERIALS_TYPES};
use crate::generator::exchange::Model;
use crate::generator::lut::SplitSumAxis;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "three",
    summary: "modules that patch standard and physical materials",
    host: "three.js r182 to r187",
    source: "https://threejs.org/docs/#Material.onBeforeCompile",
    proof: "run in three.js r182 and r187 by WebGL 2, in r186 and r187 by WebGPU",
    stock: Some(|material| match material.film {
        Some(film) if film.thickness_nm > 0.0 => Model::iridescence(&film, film.f0),
        _ => Model::schlick_gaussian(material.f0_in_engines()),
    }),
    coated_f0: Some(|f0| f0),
    languages: &["gles", "wgsl"],
    // The split sum's error is below .0014 (the report of `bake --dfg`), which a white furnace can show.
    table: Some((80, [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt])),
    parts: &[],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/three/README.md.tera"),
        },
        FlavourPage {
            name: "fresnel.js",
            template: include_str!("../../../templates/flavours/three/fresnel.js.tera"),
        },
        FlavourPage {
            name: "fresnel.d.ts",
            template: include_str!("../../../templates/flavours/three/fresnel.d.ts.tera"),
        },
        FlavourPage {
            name: "fresnel.tsl.js",
            template: include_str!("../../../templates/flavours/three/fresnel.tsl.js.tera"),
        },
        FlavourPage {
            name: "fresnel.tsl.d.ts",
            template: include_str!("../../../templates/flavours/three/fresnel.tsl.d.ts.tera"),
        },
        MATERIALS_MODULE,
        MATERIALS_TYPES,
    ],
};
