//! The measured shaders: a function in a fragment shader, evaluated once or several times in a chain.
//!
//! Each evaluation takes its first argument from the result before it, as `r g - b` plus an interpolated input. So no channel can
//! be left out, no compiler can simplify it, and cosines stay spread where the shader is run. Each evaluation has arguments of
//! its own, so that nothing computed from arguments is shared. The cost of the chain itself is that of the [empty](Probe::empty)
//! function in it.
//!
//! Interface: location 0 holds weights and the first cosine. Group 0 has the arguments at binding 0 (one block for each evaluation,
//! [`BLOCKS`] or more in all), a texture at 3 and its sampler at 4, as in our SPIR-V modules.

use super::chain::{ChainLanguage, MEASURED, MeasuredFunction, uniforms, without_numbers};
use super::family::Dialect;
use crate::generator::emit::bare;
use crate::language::ir::{Checked, Param, Ty};
use crate::language::targets::{GLES, Target, WGSL, filled};
use crate::physics::digest::sha256;
use crate::physics::num::Precision;

/// Blocks of arguments in a shader of at most as many evaluations. A longer chain has one block for each.
pub const BLOCKS: usize = 8;
/// The entry point of the fragment shader.
pub const ENTRY: &str = "fg_main";
/// The entry point of the vertex shader.
pub const VERTEX: &str = "fg_vertex";

/// A measured function.
#[derive(Clone, Debug)]
pub struct Probe {
    params: Vec<Param>,
    is_scalar: bool,
    precision: Precision,
    /// Its text in WGSL and in GLSL ES.
    texts: [String; 2],
}

/// A full-screen triangle in WGSL whose location 0 varies over (0, 1).
pub const WGSL_VERTEX: &str = "
struct FgVertex {
    @builtin(position) fg_position: vec4<f32>,
    @location(0) fg_in: vec4<f32>,
}
@vertex
fn fg_vertex(@builtin(vertex_index) i: u32) -> FgVertex {
    let at = vec2<f32>(f32(i & 1u), f32(i >> 1u));
    return FgVertex(vec4<f32>(at * 4.0 - 1.0, 0.0, 1.0), vec4<f32>(at, 1.0 - 0.5 * at.x, at.x + 0.25 * at.y));
}
";

impl Probe {
    /// A function whose arguments, if it has any, come from uniforms.
    pub fn new(function: &Checked, precision: Precision) -> Probe {
        let text = |target: &Target| bare(function, MEASURED, target.spelling_in(precision));
        Probe {
            params: function.params.clone(),
            is_scalar: function.ty() == Ty::Scalar,
            precision,
            texts: [text(&WGSL), text(&GLES)],
        }
    }

    /// A function given as text in WGSL and in GLSL ES, as far as it is known, under the name `fg_measured`. It returns one
    /// channel or three.
    pub fn of_text(params: Vec<Param>, is_scalar: bool, [wgsl, gles]: [String; 2]) -> Probe {
        Probe {
            params,
            is_scalar,
            precision: Precision::F32,
            texts: [wgsl, gles],
        }
    }

    /// The empty function with these types of its first argument and its result. It measures the cost of the chain itself.
    pub fn empty(first: Ty, result: Ty, precision: Precision) -> Probe {
        let text = |target: &Target| {
            let spelling = target.spelling_in(precision);
            let ty = spelling.ty(result);
            let value = match (first, result) {
                (Ty::Vec3, Ty::Vec3) => "c".to_owned(),
                (Ty::Vec2, Ty::Vec3) => "c.xyx".to_owned(),
                (Ty::Vec3 | Ty::Vec2, _) => "c.x".to_owned(),
                _ => format!("{ty}(c)"),
            };
            let param: &[(&str, &str)] = &[("type", spelling.ty(first)), ("name", "c")];
            let head: &[(&str, &str)] = &[
                ("name", MEASURED),
                ("type", ty),
                ("params", &filled(spelling.param, param)),
            ];
            let head = filled(spelling.head, head);
            format!("{head} {{\n    return {value};\n}}\n")
        };
        let param = Param {
            name: "c".to_owned(),
            ty: first,
        };
        Probe {
            params: vec![param],
            is_scalar: result == Ty::Scalar,
            precision,
            texts: [text(&WGSL), text(&GLES)],
        }
    }

    /// The arguments that it takes from uniforms, in order.
    pub fn uniforms(&self) -> impl Iterator<Item = &Param> {
        uniforms(&self.params)
    }

    /// The fragment shader in a compiler's language.
    pub fn text(&self, evaluations: usize, dialect: Dialect) -> String {
        match dialect {
            Dialect::Wgsl => self.wgsl(evaluations),
            Dialect::Es300 => self.gles(evaluations, false),
            Dialect::Es100 => self.gles(evaluations, true),
        }
    }

    /// The hash of the shader with the longer chain, which is the key of a record.
    pub fn hash(&self, dialect: Dialect) -> String {
        let text = self.text(dialect.chains()[1], dialect);
        sha256(text.as_bytes())[..16].to_owned()
    }

    /// The hash of the same text with a mark in place of each number, shared by functions that differ in constants alone.
    pub fn shape(&self, dialect: Dialect) -> String {
        let text = self.text(dialect.chains()[1], dialect);
        sha256(without_numbers(&text).as_bytes())[..16].to_owned()
    }

    /// The fragment shader in WGSL.
    pub fn wgsl(&self, evaluations: usize) -> String {
        let spelling = WGSL.spelling_in(self.precision);
        let enable = if self.precision.is_half() {
            "enable f16;\n"
        } else {
            ""
        };
        let language = ChainLanguage {
            spelling,
            // The stride of a uniform array is a multiple of 16 bytes.
            member: "    @align(16) {name}: {type},\n",
            block: &format!(
                "struct FgArguments {{\n{{members}}}}\n@group(0) @binding(0) var<uniform> fg_arguments: array<FgArguments, {}>;\n",
                evaluations.max(BLOCKS)
            ),
            argument: "fg_arguments[{i}].{name}",
            texture: "@group(0) @binding(3) var fg_table: texture_2d<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n",
            cube: "@group(0) @binding(3) var fg_table: texture_cube<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n",
            texture_argument: "fg_table, fg_sampler",
            local: spelling.local,
            input: "{type}({value})",
            prefix: "",
            shader: &format!(
                "{enable}{{function}}{{arguments}}@fragment fn {ENTRY}(@location(0) fg_in: vec4<f32>) -> @location(0) vec4<f32> {{
{{chain}}    return vec4<f32>(vec3<f32>({}({{last}})), 1.0);
}}
",
                spelling.rgb
            ),
        };
        self.function(0).shader(&language, evaluations)
    }

    /// The fragment shader in GLSL ES 3.00, or in GLSL ES 1.00 for compilers that support no other. Only names differ.
    fn gles(&self, evaluations: usize, is_old: bool) -> String {
        let spelling = GLES.spelling_in(self.precision);
        let uniform = spelling
            .param
            .replace("{name}", &format!("fg_{{name}}[{BLOCKS}]"));
        let reads_cube = self.params.iter().any(|param| param.ty == Ty::Cube);
        let (head, colour) = match (is_old, reads_cube) {
            (true, true) => (OLD_HEAD_WITH_CUBE, "gl_FragColor"),
            (true, false) => (OLD_HEAD, "gl_FragColor"),
            (false, _) => (NEW_HEAD, "fg_colour"),
        };
        let language = ChainLanguage {
            spelling,
            member: &format!("uniform {uniform};\n"),
            block: "{members}",
            argument: "fg_{name}[{i}]",
            texture: "uniform highp sampler2D fg_table;\n",
            cube: "uniform highp samplerCube fg_table;\n",
            texture_argument: "fg_table",
            local: spelling.local,
            input: "{value}",
            prefix: "",
            shader: &format!(
                "{head}{{function}}{{arguments}}void main() {{
{{chain}}    {colour} = vec4(vec3({{last}}), 1.0);
}}
"
            ),
        };
        self.function(1).shader(&language, evaluations)
    }

    fn function(&self, text: usize) -> MeasuredFunction<'_> {
        MeasuredFunction {
            text: &self.texts[text],
            params: &self.params,
            is_scalar: self.is_scalar,
        }
    }
}

/// The vertex shader that belongs to the fragment shaders in GLSL ES.
pub fn gles_vertex(dialect: Dialect) -> String {
    let (version, input, output) = if dialect == Dialect::Es100 {
        ("100", "attribute", "varying")
    } else {
        ("300 es", "in", "out")
    };
    format!(
        "#version {version}
{input} highp vec4 fg_corner;
{output} highp vec4 fg_in;
void main() {{
    fg_in = fg_corner;
    gl_Position = vec4(fg_corner.xy, 0.0, 1.0);
}}
"
    )
}

const NEW_HEAD: &str = "#version 300 es
in highp vec4 fg_in;
out highp vec4 fg_colour;
";
/// Reads without a level of detail: the textures here have only the base level.
const OLD_HEAD: &str = "#version 100
varying highp vec4 fg_in;
#define textureLod(table, at, level) texture2D(table, at)
";
const OLD_HEAD_WITH_CUBE: &str = "#version 100
varying highp vec4 fg_in;
#define textureLod(table, at, level) textureCube(table, at)
";
