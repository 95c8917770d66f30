//! The shader text of a row: the functions that users import, the calls of its method, the frame, and the row's own passes.
//!
//! Passes know no method. They call `reflectance` and `transmittance_out`, or `film_reflectance` under a film, whose text is made here
//! from the method's inputs. The values of the inputs stand in the frame's block, so one text serves every material.

use super::material::OpticalMaterial;
use super::table::RenderRow;
use crate::generator::emit::{
    self, EffectRequest, EmittedFunction, FunctionForm, Naming, effect_function_text,
    library_functions,
};
use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::effects::{self, Reflectance, USUAL_METHOD};
use crate::language::ir::Ty;
use crate::language::methods::{self, Forms, Input, Method, Values};
use crate::language::targets;
use crate::physics::materials::Channels;

/// The most inputs that the frame's block has room for.
pub const INPUTS: usize = 16;

/// The declarations that every pass sees.
pub const FRAME: &str = include_str!("passes/frame.wgsl");

/// How calls are written in a language.
#[derive(Clone, Copy, Debug)]
pub struct CallSyntax {
    /// The name of the frame's block.
    pub frame: &'static str,
    scalar: &'static str,
    vector: &'static str,
    /// Whether types stand before names.
    type_first: bool,
}

/// WGSL.
pub const WGSL_CALLS: CallSyntax = CallSyntax {
    frame: "frame",
    scalar: "f32",
    vector: "vec3<f32>",
    type_first: false,
};
/// GLSL ES, where naga names the block.
pub const GLES_CALLS: CallSyntax = CallSyntax {
    frame: "_group_0_binding_0_fs",
    scalar: "float",
    vector: "vec3",
    type_first: true,
};

impl CallSyntax {
    fn head(&self, name: &str, arguments: &[(&str, &str)], result: &str) -> String {
        let each = |(name, ty): &(&str, &str)| match self.type_first {
            true => format!("{ty} {name}"),
            false => format!("{name}: {ty}"),
        };
        let arguments: Vec<String> = arguments.iter().map(each).collect();
        let arguments = arguments.join(", ");
        match self.type_first {
            true => format!("{result} {name}({arguments})"),
            false => format!("fn {name}({arguments}) -> {result}"),
        }
    }
}

/// A row drawn by a method: the functions that it needs, and its calls.
#[derive(Clone, Copy, Debug)]
pub struct RowText {
    /// The row.
    pub row: &'static RenderRow,
    /// The method that computes R.
    pub method: &'static Method,
}

impl RowText {
    /// The row by its own method.
    pub fn usual(row: &'static RenderRow) -> RowText {
        let method = methods::find(row.method).expect("a row names a method");
        RowText { row, method }
    }

    /// The functions of the row's effects in their default form, the same for every method.
    ///
    /// # Errors
    /// A graph breaks a rule: a bug.
    pub fn common_functions(&self) -> Result<Vec<EmittedFunction>, emit::Error> {
        let mut all = Vec::new();
        for name in self.row.effects {
            all.extend(request(name, usual_method()).functions(&Naming::default())?);
        }
        Ok(all)
    }

    /// The functions that the method's calls need, including the default ones.
    ///
    /// # Errors
    /// A graph breaks a rule: a bug.
    pub fn called_functions(&self) -> Result<Vec<EmittedFunction>, emit::Error> {
        if self.row.film.is_some() {
            return library_functions(self.method, &Naming::default());
        }
        let mut called = vec![self.surface_function("interface")?];
        if self.leaves_a_body() {
            called.push(self.exit_function()?);
        }
        if self.is_rough() {
            called.insert(0, self.surface_function("ggx_specular")?);
        }
        Ok(called)
    }

    /// Whether rays leave the body, so that passes need the transmittance there.
    fn leaves_a_body(&self) -> bool {
        self.row.effects.contains(&"interior")
    }

    /// Whether a rough surface reflects light, so that passes need its BRDF.
    pub fn is_rough(&self) -> bool {
        self.row.effects.contains(&"ggx_specular")
    }

    /// Whether the method has one value for all channels where light passes through the body.
    fn is_scalar(&self) -> bool {
        self.row.is_transparent() && self.method.forms == Forms::ColourAndScalar
    }

    /// The method that computes R where light leaves the body. Of all inputs, only an index tells from which side light comes and
    /// where it is reflected totally.
    pub fn exit_method(&self) -> &'static Method {
        let takes_index_alone = matches!(self.method.inputs, [input] if input.name == "eta");
        if takes_index_alone && self.is_scalar() {
            self.method
        } else {
            usual_method()
        }
    }

    /// The function of an effect that takes R of the body's surface from outside.
    fn surface_function(&self, effect: &str) -> Result<EmittedFunction, emit::Error> {
        let each = Reflectance::EachChannel;
        function(effect, self.method, each, self.is_scalar())
    }

    fn exit_function(&self) -> Result<EmittedFunction, emit::Error> {
        let within = Reflectance::FromWithin;
        function("interior", self.exit_method(), within, true)
    }

    /// The text of `reflectance` and `transmittance_out` in a language, which call these functions: [`RowText::called_functions`].
    pub fn calls(&self, syntax: &CallSyntax, called: &[EmittedFunction]) -> String {
        let CallSyntax { scalar, vector, .. } = *syntax;
        if self.row.film.is_some() {
            return self.film_call(syntax, &called[0]);
        }
        let of = |effect: &str, asked: Reflectance| {
            let is_it = |one: &&EmittedFunction| {
                let part = one
                    .effect
                    .map(|part| (part.effect.name, part.function.reflectance));
                part == Some((effect, asked))
            };
            called.iter().find(is_it).expect("it is one that is called")
        };
        let each = Reflectance::EachChannel;
        let rays = [("incident", vector), ("normal", vector)];
        let head = syntax.head("reflectance", &rays, vector);
        let call = self.call(syntax, of("interface", each), &rays);
        let method = self.method.name;
        let mut text = format!("\n// R by {method}\n{head} {{\n    return {call};\n}}\n");
        if self.leaves_a_body() {
            let rays = [("direction", vector), ("normal_out", vector)];
            let takes = [rays.as_slice(), &[("eta", scalar)]].concat();
            let head = syntax.head("transmittance_out", &takes, scalar);
            let name = &of("interior", Reflectance::FromWithin).name;
            let method = self.exit_method().name;
            text += &format!(
                "\n// T where light leaves, by {method}\n{head} {{\n    return {name}(direction, normal_out, eta);\n}}\n"
            );
        }
        if self.is_rough() {
            let takes = ["n_dot_v", "n_dot_l", "n_dot_h", "v_dot_h", "alpha"];
            let takes = takes.map(|name| (name, scalar));
            let head = syntax.head("specular", &takes, vector);
            let call = self.call(syntax, of("ggx_specular", each), &takes);
            text += &format!("\n{head} {{\n    return {call};\n}}\n");
        }
        text
    }

    /// The text of `film_reflectance`: the method's library function with the pixel's cosine and thickness.
    fn film_call(&self, syntax: &CallSyntax, function: &EmittedFunction) -> String {
        let scalar = syntax.scalar;
        let takes = [("cos_theta", scalar), ("thickness_nm", scalar)];
        let head = syntax.head("film_reflectance", &takes, syntax.vector);
        let input = |(place, input): (usize, &Input)| match input.is_kept() {
            true => input.name.to_owned(),
            false => self.argument(syntax.frame, place, input),
        };
        let inputs = self.method.inputs.iter().enumerate().map(input);
        let arguments: Vec<String> = ["cos_theta".to_owned()].into_iter().chain(inputs).collect();
        format!(
            "\n// R by {}\n{head} {{\n    return {}({});\n}}\n",
            self.method.name,
            function.name,
            arguments.join(", ")
        )
    }

    /// The call of an effect's function that needs R: its own arguments, then the method's inputs. Where it returns one value, that
    /// value serves all channels.
    fn call(
        &self,
        syntax: &CallSyntax,
        function: &EmittedFunction,
        own: &[(&str, &str)],
    ) -> String {
        let own = own.iter().map(|(name, _)| (*name).to_owned());
        let places = self.method.inputs.iter().enumerate();
        let inputs = places.map(|(place, input)| self.argument(syntax.frame, place, input));
        let arguments: Vec<String> = own.chain(inputs).collect();
        let call = format!("{}({})", function.name, arguments.join(", "));
        match function.function.ty() {
            Ty::Scalar => format!("{}({call})", syntax.vector),
            _ => call,
        }
    }

    /// Where a call reads an input: in the frame's block, with green's value where one R serves all channels. A row of the effect
    /// that computes F0 computes it in the shader.
    fn argument(&self, frame: &str, place: usize, input: &Input) -> String {
        if input.name == "f0" && self.row.effects.contains(&"complex_f0") {
            return format!("fresnel_complex_f0({frame}.n.xyz, {frame}.k.xyz)");
        }
        let part = match input.ty {
            Ty::Scalar => "x",
            _ if self.is_scalar() => "y",
            _ if self.row.is_transparent() && self.row.film.is_none() => "yyy",
            _ => "xyz",
        };
        format!("{frame}.inputs[{place}].{part}")
    }

    /// The module: the functions as users import them, the frame, the calls, the row's own passes.
    ///
    /// # Errors
    /// A function cannot be written: a bug.
    pub fn module(&self) -> Result<String, emit::Error> {
        let mut functions = self.common_functions()?;
        let called = self.called_functions()?;
        for called in &called {
            if functions.iter().all(|other| other.name != called.name) {
                functions.push(called.clone());
            }
        }
        let wgsl = targets::find("wgsl").expect("a target");
        let mut text = String::new();
        for function in &functions {
            text += &effect_function_text(wgsl, function)?;
        }
        Ok(text + FRAME + &self.calls(&WGSL_CALLS, &called) + self.row.text)
    }

    /// The values of the method's inputs, in the layout of the block.
    pub fn inputs(&self, values: &Values) -> [[f32; 4]; INPUTS] {
        let mut block = [[0.0; 4]; INPUTS];
        for (place, input) in block.iter_mut().zip(self.method.inputs) {
            let [r, g, b] = values.get(input.name).copied().unwrap_or([0.0; 3]);
            *place = [r as f32, g as f32, b as f32, 0.0];
        }
        block
    }

    /// The same, for a body of this index.
    pub fn inputs_for(&self, material: &OpticalMaterial) -> [[f32; 4]; INPUTS] {
        let channels = Channels {
            n: material.n.to_array(),
            k: material.k.to_array(),
        };
        self.inputs(&values(self.method, &channels, &Derivation::default()))
    }
}

fn usual_method() -> &'static Method {
    methods::find(USUAL_METHOD).expect("the usual method is registered")
}

fn request(effect: &str, method: &'static Method) -> EffectRequest<'static> {
    EffectRequest {
        effect: effects::find(effect).expect("a row names effects"),
        method,
        subject: None,
    }
}

/// The function of an effect that needs R in this way, by a method.
fn function(
    effect: &str,
    method: &'static Method,
    asked: Reflectance,
    is_scalar: bool,
) -> Result<EmittedFunction, emit::Error> {
    let functions = request(effect, method).functions(&Naming::default())?;
    let mut found = functions.into_iter().filter(|emitted| {
        let own = emitted.effect.map(|part| part.function.reflectance);
        own == Some(asked) && (emitted.form == FunctionForm::Scalar) == is_scalar
    });
    Ok(found.next().expect("every method has this form"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_block_has_room_for_the_inputs_of_every_method() {
        for method in methods::ALL {
            assert!(method.inputs.len() <= INPUTS, "{}", method.name);
        }
    }
}
