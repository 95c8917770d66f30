//! What an effect is: a plain record in a static table, with its functions.

use std::collections::BTreeMap;

use crate::cite::Citation;
use crate::ir::{
    BrokenRule, Builder, Checked, Expr, Letters, Ty, check, identifier_fault, specialise,
};
use crate::methods::{Forms, Inputs, Method};
use crate::num::Precision;

/// Something that Fresnel's equations make visible, as functions that an application calls.
#[derive(Debug)]
pub struct Effect {
    /// Its one name: file, `--effect`, row in every report.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// The formulas, in ASCII, a line each.
    pub formula: &'static [&'static str],
    /// Who published it.
    pub source: Citation,
    /// What its arguments mean beyond what each says of itself, and what is left to the application, a line each.
    pub conventions: &'static [&'static str],
    /// Where it must be wrong, a line each.
    pub fails: &'static [&'static str],
    /// Its functions. Each gives one result.
    pub functions: &'static [EffectFunction],
}

/// One function of an effect.
#[derive(Debug)]
pub struct EffectFunction {
    /// Its name after the prefix.
    pub name: &'static str,
    /// What it gives.
    pub gives: &'static str,
    /// Its arguments; those of the Fresnel method come after them.
    pub arguments: &'static [Argument],
    /// Whether it asks for the reflectance, so that a Fresnel method is part of it.
    pub reflectance: Reflectance,
    /// Whether its numbers are colours, or places and directions.
    pub letters: Letters,
    /// Builds the formula.
    pub build: for<'b> fn(&Arguments<'b>) -> Expr<'b>,
}

/// The reflectance that a function asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reflectance {
    /// None.
    Unused,
    /// One for each channel; where the method has a scalar form there is a second function with one for all.
    EachChannel,
}

/// An argument of an effect's function.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    /// Its name, the same in every language.
    pub name: &'static str,
    /// What it means, with its unit.
    pub meaning: &'static str,
    /// Its type.
    pub ty: Ty,
}

impl Argument {
    /// A number.
    pub const fn scalar(name: &'static str, meaning: &'static str) -> Argument {
        Argument::of(name, meaning, Ty::Scalar)
    }

    /// A place, a direction or a colour.
    pub const fn vector(name: &'static str, meaning: &'static str) -> Argument {
        Argument::of(name, meaning, Ty::Rgb)
    }

    /// Of any type.
    pub const fn of(name: &'static str, meaning: &'static str, ty: Ty) -> Argument {
        Argument { name, meaning, ty }
    }
}

/// The arguments of a function while it is built.
#[derive(Debug)]
pub struct Arguments<'b> {
    builder: &'b Builder,
    given: Vec<(&'static str, Expr<'b>)>,
    fresnel: Option<(&'static Method, Vec<Expr<'b>>)>,
}

impl<'b> Arguments<'b> {
    /// An argument that the function declares.
    pub fn get(&self, argument: Argument) -> Expr<'b> {
        let found = self.given.iter().find(|(name, _)| *name == argument.name);
        let found = found.expect("a function asks only for arguments that it declares");
        found.1
    }

    /// A constant.
    pub fn number(&self, value: f64) -> Expr<'b> {
        self.builder.number(value)
    }

    /// A place or a direction from three numbers.
    pub fn vector(&self, x: Expr<'b>, y: Expr<'b>, z: Expr<'b>) -> Expr<'b> {
        self.builder.compose(x, y, z)
    }

    /// The reflectance by the chosen method at the cosine of an angle of incidence.
    pub fn fresnel(&self, cos_theta: Expr<'b>) -> Expr<'b> {
        let (method, inputs) = self.fresnel.as_ref().expect("the function asks for it");
        let inputs = Inputs::given(cos_theta, method.inputs, inputs, Precision::F32);
        (method.build)(&inputs)
    }
}

/// A function of an effect, made for a Fresnel method and a number of channels.
#[derive(Clone, Debug)]
pub struct BuiltEffect {
    /// Its name after the prefix.
    pub name: String,
    /// What it was made from.
    pub record: &'static EffectFunction,
    /// The graph.
    pub function: Checked,
}

impl EffectFunction {
    /// This function in each form that it has with this method: one, or one for three channels and one for one.
    ///
    /// # Errors
    /// The graph breaks a rule of [`crate::ir::RULES`]; tests hold that none does.
    pub fn built(&'static self, method: &'static Method) -> Result<Vec<BuiltEffect>, BrokenRule> {
        let has_scalar_form =
            self.reflectance == Reflectance::EachChannel && method.forms == Forms::ColourAndScalar;
        let forms = [(false, ""), (true, "_scalar")];
        let forms = forms
            .into_iter()
            .filter(|(is_scalar, _)| !is_scalar || has_scalar_form);
        forms
            .map(|(is_scalar, suffix)| {
                Ok(BuiltEffect {
                    name: format!("{}{suffix}", self.name),
                    record: self,
                    function: self.graph(method, is_scalar)?,
                })
            })
            .collect()
    }

    fn graph(&self, method: &'static Method, is_scalar: bool) -> Result<Checked, BrokenRule> {
        let builder = Builder::with_letters(self.letters);
        let declare = |argument: &Argument| {
            debug_assert_eq!(identifier_fault(argument.name), None);
            (argument.name, builder.param(argument.name, argument.ty))
        };
        let given = self.arguments.iter().map(declare).collect();
        let fresnel = (self.reflectance == Reflectance::EachChannel).then(|| {
            let ty = |ty: Ty| if is_scalar { Ty::Scalar } else { ty };
            let declare = |input: &crate::methods::Input| builder.param(input.name, ty(input.ty));
            (method, method.inputs.iter().map(declare).collect())
        });
        let arguments = Arguments {
            builder: &builder,
            given,
            fresnel,
        };
        let result = (self.build)(&arguments);
        let whole = builder.finish(self.name, result);
        check(specialise(&whole, &BTreeMap::new()))
    }
}
