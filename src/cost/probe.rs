//! The shaders that are measured: a function in a fragment shader, evaluated once or several times in a chain.
//!
//! Each evaluation takes its cosine from the result before it, `r g - b` and what comes from the vertices, so that no channel
//! can be left out, no compiler can make it simpler, and cosines stay spread where the shader is run; and each has arguments of its own, so that nothing computed from
//! arguments is shared. The chain's own price is that of the [empty](Probe::empty) function in it.
//!
//! Interface: location 0 holds weights and the first cosine; group 0 has the arguments at binding 0 (one block for each
//! evaluation, [`BLOCKS`] in all), a texture at 3 and its sampler at 4, as in our SPIR-V modules.

use crate::emit::{bare, sha256};
use crate::ir::{Checked, Param, Ty};
use crate::num::Precision;
use crate::targets::{GLES, Target, WGSL};

use super::family::Dialect;

/// Most evaluations in one shader.
pub const BLOCKS: usize = 8;
/// The entry point of the fragment shader.
pub const ENTRY: &str = "fg_main";
/// The entry point of the vertex shader.
pub const VERTEX: &str = "fg_vertex";

/// What every function is called in a probe, so that equal functions have equal shaders.
const NAME: &str = "fg_measured";

/// A function as it is measured.
#[derive(Clone, Debug)]
pub struct Probe {
    params: Vec<Param>,
    is_scalar: bool,
    precision: Precision,
    /// In WGSL and in GLSL ES.
    texts: [String; 2],
}

/// A full-screen triangle in WGSL whose location 0 runs over (0, 1) and is no constant.
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
    /// A function with its arguments, if it has any, from uniforms.
    pub fn new(function: &Checked, precision: Precision) -> Probe {
        let text = |target: &Target| bare(function, NAME, target.spelling_in(precision));
        Probe {
            params: function.params.clone(),
            is_scalar: function.ty() == Ty::Scalar,
            precision,
            texts: [text(&WGSL), text(&GLES)],
        }
    }

    /// A function that is there as text, under the name `fg_measured`: in WGSL, and in GLSL ES, as far as it is known. It gives
    /// three channels.
    pub fn of_text(params: Vec<Param>, wgsl: String, gles: String) -> Probe {
        Probe {
            params,
            is_scalar: false,
            precision: Precision::F32,
            texts: [wgsl, gles],
        }
    }

    /// What a chain costs where nothing is evaluated in it.
    pub fn empty(is_scalar: bool, precision: Precision) -> Probe {
        let text = |target: &Target| {
            let spelling = target.spelling_in(precision);
            let ty = spelling.ty(if is_scalar { Ty::Scalar } else { Ty::Rgb });
            let param = spelling.param.replace("{type}", spelling.scalar);
            let head = spelling.head.replace("{name}", NAME);
            let head = head.replace("{type}", ty);
            let head = head.replace("{params}", &param.replace("{name}", "c"));
            format!("{head} {{\n    return {ty}(c);\n}}\n")
        };
        Probe {
            params: Vec::new(),
            is_scalar,
            precision,
            texts: [text(&WGSL), text(&GLES)],
        }
    }

    /// What it takes from uniforms after `cos_theta`, in order.
    pub fn uniforms(&self) -> impl Iterator<Item = &Param> {
        let params = self.params.iter().skip(1);
        params.filter(|param| param.ty != Ty::Texture)
    }

    /// Whether it reads a texture.
    pub fn is_textured(&self) -> bool {
        self.params.iter().any(|param| param.ty == Ty::Texture)
    }

    /// The fragment shader in a compiler's language.
    pub fn text(&self, evaluations: usize, dialect: Dialect) -> String {
        match dialect {
            Dialect::Wgsl => self.wgsl(evaluations),
            Dialect::Es300 => self.gles(evaluations, false),
            Dialect::Es100 => self.gles(evaluations, true),
        }
    }

    /// The shader of the longer chain by its hash: what a record belongs to.
    pub fn hash(&self, dialect: Dialect) -> String {
        let text = self.text(dialect.chains()[1], dialect);
        sha256(text.as_bytes())[..16].to_owned()
    }

    /// The fragment shader in WGSL.
    pub fn wgsl(&self, evaluations: usize) -> String {
        let spelling = WGSL.spelling_in(self.precision);
        let enable = if self.precision.is_half() {
            "enable f16;\n"
        } else {
            ""
        };
        // Elements of an array in uniforms lie 16 bytes apart, or a multiple of it.
        let member = |param: &Param| {
            let ty = spelling.ty(param.ty);
            format!("    @align(16) {}: {ty},\n", param.name)
        };
        let members: String = self.uniforms().map(member).collect();
        let block = if members.is_empty() {
            String::new()
        } else {
            format!(
                "struct FgArguments {{\n{members}}}\n@group(0) @binding(0) var<uniform> fg_arguments: array<FgArguments, {BLOCKS}>;\n"
            )
        };
        let texture = if self.is_textured() {
            "@group(0) @binding(3) var fg_table: texture_2d<f32>;\n@group(0) @binding(4) var fg_sampler: sampler;\n"
        } else {
            ""
        };
        let call = |i: usize| {
            self.call("fg_table, fg_sampler", |name| {
                format!("fg_arguments[{i}].{name}")
            })
        };
        let (scalar, rgb) = (spelling.scalar, spelling.rgb);
        let steps = self.steps(evaluations, "let {name} = {value};", &call);
        format!(
            "{enable}{}{block}{texture}@fragment fn {ENTRY}(@location(0) fg_in: vec4<f32>) -> @location(0) vec4<f32> {{
    let w = {rgb}(fg_in.xyz);
    let c0 = {scalar}(fg_in.w);
{steps}    return vec4<f32>(vec3<f32>({rgb}(r{})), 1.0);
}}
",
            self.texts[0],
            evaluations - 1
        )
    }

    /// The fragment shader in GLSL ES 3.00, or in GLSL ES 1.00 for what knows no other: the same text under other names.
    fn gles(&self, evaluations: usize, is_old: bool) -> String {
        let spelling = GLES.spelling_in(self.precision);
        let uniform = |param: &Param| {
            let declared = spelling.param.replace("{type}", spelling.ty(param.ty));
            let name = format!("fg_{}[{BLOCKS}]", param.name);
            format!("uniform {};\n", declared.replace("{name}", &name))
        };
        let uniforms: String = self.uniforms().map(uniform).collect();
        let texture = if self.is_textured() {
            "uniform highp sampler2D fg_table;\n"
        } else {
            ""
        };
        let call = |i: usize| self.call("fg_table", |name| format!("fg_{name}[{i}]"));
        let head = if is_old { OLD_HEAD } else { NEW_HEAD };
        let colour = if is_old { "gl_FragColor" } else { "fg_colour" };
        let local = |ty| spelling.local.replace("{type}", spelling.ty(ty));
        let ty = if self.is_scalar { Ty::Scalar } else { Ty::Rgb };
        let cosine = local(Ty::Scalar);
        let result = local(ty);
        let steps = self.typed_steps(evaluations, &cosine, &result, &call);
        let weights = local(Ty::Rgb)
            .replace("{name}", "w")
            .replace("{value}", "fg_in.xyz");
        let first = cosine.replace("{name}", "c0").replace("{value}", "fg_in.w");
        format!(
            "{head}{}{uniforms}{texture}void main() {{
    {weights}
    {first}
{steps}    {colour} = vec4(vec3(r{}), 1.0);
}}
",
            self.texts[1],
            evaluations - 1
        )
    }

    fn steps(&self, evaluations: usize, local: &str, call: &dyn Fn(usize) -> String) -> String {
        self.typed_steps(evaluations, local, local, call)
    }

    /// `r0 = f(c0); c1 = weighted r0; r1 = f(c1); ...`
    fn typed_steps(
        &self,
        evaluations: usize,
        cosine: &str,
        result: &str,
        call: &dyn Fn(usize) -> String,
    ) -> String {
        let line = |pattern: &str, name: String, value: String| {
            let filled = pattern.replace("{name}", &name).replace("{value}", &value);
            format!("    {filled}\n")
        };
        let step = |i: usize| {
            let r = format!("r{}", i.saturating_sub(1));
            let next = if self.is_scalar {
                format!("{r} * w.x + w.y")
            } else {
                format!("{r}.x * {r}.y - {r}.z + w.z")
            };
            let chained = if i == 0 {
                String::new()
            } else {
                line(cosine, format!("c{i}"), next)
            };
            let called = call(i).replace("fg_cosine", &format!("c{i}"));
            chained + &line(result, format!("r{i}"), called)
        };
        (0..evaluations).map(step).collect()
    }

    /// The call: its cosine is `fg_cosine`.
    fn call(&self, texture: &str, uniform: impl Fn(&str) -> String) -> String {
        let argument = |param: &Param| match param.ty {
            Ty::Texture => texture.to_owned(),
            _ => uniform(&param.name),
        };
        let rest = self.params.iter().skip(1).map(argument);
        let arguments: Vec<String> = ["fg_cosine".to_owned()].into_iter().chain(rest).collect();
        format!("{NAME}({})", arguments.join(", "))
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
/// Without a level there is only the base one: what is read here has no other.
const OLD_HEAD: &str = "#version 100
varying highp vec4 fg_in;
#define textureLod(table, at, level) texture2D(table, at)
";
