//! npm: a package of the modules for three.js, PlayCanvas and Babylon.js, which a bundler reduces to what a page uses.

use super::flavour::{Flavour, FlavourPage, MATERIALS_MODULE, MATERIALS_TYPES};
use crate::generator::lut::SplitSumAxis;

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "npm",
    summary: "a package of the modules for three.js, PlayCanvas and Babylon.js, with types",
    host: "npm",
    source: "https://docs.npmjs.com/cli/configuring-npm/package-json",
    proof: "packed and installed by npm, its types checked by TypeScript 5.9, bundled by esbuild, run in three.js r187",
    stock: None,
    coated_f0: None,
    languages: &["gles", "wgsl"],
    table: Some((80, [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt])),
    parts: &[
        &super::three::FLAVOUR,
        &super::playcanvas::FLAVOUR,
        &super::babylon::FLAVOUR,
    ],
    pages: &[
        FlavourPage {
            name: "README.md",
            template: include_str!("../../../templates/flavours/npm/README.md.tera"),
        },
        FlavourPage {
            name: "package.json",
            template: include_str!("../../../templates/flavours/npm/package.json.tera"),
        },
        MATERIALS_MODULE,
        MATERIALS_TYPES,
    ],
};
