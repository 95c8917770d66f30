//! GLSL ES 3.00, for OpenGL ES 3.0 and WebGL 2.
//!
//! Everything is declared `highp`, or `mediump` in half precision. The exact forms need `highp`, and the default precision
//! belongs to the including shader.

use super::glsl;
use super::spelling::Spelling;
use super::target::{Finish, Frame, GLSLANG, HalfText, Harness, Page, Stack, Target, Validator};
use crate::language::methods::Gpu;

/// The record of this target.
pub static TARGET: Target = Target {
    name: "gles",
    summary: "GLSL ES 3.00 for phones and WebGL 2",
    source: "The OpenGL ES Shading Language 3.00, Khronos, https://registry.khronos.org/OpenGL/specs/es/3.0/GLSL_ES_Specification_3.00.pdf",
    extension: "glsl",
    other_extensions: &[],
    by_default: true,
    spelling: Spelling {
        param: "highp {type} {name}",
        texture: "highp sampler2D {name}",
        cube: "highp samplerCube {name}",
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
        template: include_str!("../../../templates/glsl.tera"),
    }],
    catalogue: Some(include_str!("../../../templates/catalogue.gles.tera")),
    finish: Finish::Text,
    validators: VALIDATORS,
    nests_comments: false,
    stack: Stack::OpenGlEs(&HARNESS),
    gpu: Gpu::PHONES,
};

/// OpenGL ES 3.0 has no compute shaders, so a vertex shader writes its result to transform feedback, exact to the last bit.
static HARNESS: Harness = Harness {
    before: "#version 300 es\nprecision highp float;\n",
    member: "uniform highp {type} fg_{name};\n",
    block: "{members}",
    argument: "fg_{name}",
    uniform: "fg_{name}",
    texture: "uniform highp sampler2D table;\n",
    texture_argument: "table",
    cosines: "",
    count: "",
    cosine: "cos_theta",
    splat: "{value}",
    converts: false,
    points: &glsl::POINTS,
    after: "
in highp float cos_theta;
{block}{texture}out highp vec3 reflectance;
void main() {
    reflectance = vec3({value});
    gl_Position = vec4(0.0);
}
",
};

const VALIDATORS: &[Validator] = &[Validator {
    name: "glslang",
    compiler: &GLSLANG,
    options: "-S frag FILE",
    frame: Frame {
        // All declarations state their precision, so that a shader without a default precision can include them.
        beginnings: &[
            "#version 300 es\nprecision highp float;\n#line 1\n",
            "#version 300 es\nprecision mediump float;\n#line 1\n",
            "#version 300 es\n#line 1\n",
        ],
        ending: glsl::ENDING,
    },
}];
