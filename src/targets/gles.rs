//! GLSL ES 3.00, as OpenGL ES 3.0 and WebGL 2 take it.
//!
//! Everything is declared `highp`, in half precision `mediump`: the exact forms need it, and the default precision is the
//! including shader's.

use super::glsl;
use super::spelling::Spelling;
use super::target::{Finish, Frame, GLSLANG, HalfText, Page, Target, Validator};

/// The record of this target.
pub static TARGET: Target = Target {
    name: "gles",
    summary: "GLSL ES 3.00 for phones and WebGL 2",
    source: "The OpenGL ES Shading Language 3.00, Khronos, https://registry.khronos.org/OpenGL/specs/es/3.0/GLSL_ES_Specification_3.00.pdf",
    extension: "glsl",
    by_default: true,
    spelling: Spelling {
        param: "highp {type} {name}",
        texture: "highp sampler2D {name}",
        local: "highp {type} {name} = {value};",
        head: "highp {type} {name}({params})",
        ..glsl::SPELLING
    },
    half: HalfText {
        spelling: glsl::HALF_SPELLING,
        directive: "",
        remark: "mediump: 16 bits on most phones, 32 on desktops, which ignore it.",
        validators: VALIDATORS,
    },
    reserved: &[glsl::RESERVED],
    reserved_prefixes: &["gl_"],
    pages: &[Page {
        suffix: "",
        template: include_str!("../../templates/glsl.tera"),
    }],
    catalogue: Some(include_str!("../../templates/catalogue.gles.tera")),
    finish: Finish::Text,
    validators: VALIDATORS,
};

const VALIDATORS: &[Validator] = &[Validator {
    name: "glslang",
    compiler: &GLSLANG,
    options: "-S frag FILE",
    frame: Frame {
        // All declarations say their precision, so that a shader without a default one can include them.
        beginnings: &[
            "#version 300 es\nprecision highp float;\n#line 1\n",
            "#version 300 es\nprecision mediump float;\n#line 1\n",
            "#version 300 es\n#line 1\n",
        ],
        ending: glsl::ENDING,
    },
}];
