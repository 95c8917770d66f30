//! SPIR-V for Vulkan: ready modules, lowered by naga from WGSL.
//!
//! SPIR-V has no useful library form: a module without entry points needs the Linkage capability, which Vulkan
//! forbids. So each method and material comes as two modules: a fragment shader that takes the normal and the view
//! direction, and a compute shader that maps an array of cosines. The templates document their interfaces.

use super::target::{Compiler, Finish, Frame, HalfText, Page, Stack, Target, Validator};
use super::wgsl;
use crate::language::methods::Gpu;

/// The record of this target.
pub static TARGET: Target = Target {
    name: "spirv",
    summary: "SPIR-V 1.3 modules for Vulkan 1.1: a fragment and a compute shader per method and material",
    source: "SPIR-V Specification 1.3, Khronos, https://registry.khronos.org/SPIR-V/",
    extension: "spv",
    other_extensions: &[],
    by_default: true,
    spelling: wgsl::SPELLING,
    half: HalfText {
        spelling: wgsl::HALF_SPELLING,
        directive: wgsl::HALF_DIRECTIVE,
        remark: "the device must have shaderFloat16; what goes in and comes out is float",
        validators: VALIDATORS,
    },
    reserved: &[
        naga::keywords::wgsl::RESERVED,
        naga::keywords::wgsl::BUILTIN_IDENTIFIERS,
        OWN,
    ],
    reserved_prefixes: &[],
    pages: &[
        Page {
            suffix: ".frag",
            template: include_str!("../../../templates/spirv.frag.tera"),
        },
        Page {
            suffix: ".comp",
            template: include_str!("../../../templates/spirv.comp.tera"),
        },
    ],
    catalogue: None,
    finish: Finish::Spirv,
    validators: VALIDATORS,
    nests_comments: true,
    stack: Stack::SpirvModule,
    gpu: Gpu::DESKTOP,
};

const VALIDATORS: &[Validator] = &[Validator {
    name: "spirv-val",
    compiler: &SPIRV_VAL,
    options: "--target-env vulkan1.1 FILE",
    frame: Frame::NONE,
}];

/// Khronos's SPIR-V validator.
static SPIRV_VAL: Compiler = Compiler {
    name: "spirv-val",
    command: Some("spirv-val"),
    get: "Debian package spirv-tools",
};

/// Names that the templates define themselves.
const OWN: &[&str] = &[
    "main",
    "normal",
    "direction",
    "cosines",
    "reflectances",
    "parameters",
    "Parameters",
    "table_texture",
    "table_filter",
];
