//! What a method is: a record in a static table ([`Method`]), and the functions that follow from it.

use std::collections::BTreeMap;

use super::affine::{Affine, Basis};
use super::claims::{Claims, InHalf};
use super::formulas::ALL;
use super::input::{Input, Inputs, Range};
use super::media::{Class, MediaSet};
use super::shape::Shape;
use crate::language::ir::{
    BrokenRule, Builder, Checked, Expr, Texels, Ty, Value, check_in, evaluate, fold_in,
    specialise_in,
};
use crate::physics::cite::Citation;
use crate::physics::num::{Num, Precision};

/// A formula for reflectance.
#[derive(Debug)]
#[non_exhaustive]
pub struct Method {
    /// Its one name: of its file, in `--method`, of its function after the prefix, and as a row in reports.
    pub name: &'static str,
    /// A description in one line.
    pub summary: &'static str,
    /// The lines of its formula, in ASCII.
    pub formula: &'static [&'static str],
    /// The publication that it is from, or is built on.
    pub source: Citation,
    /// Whether its form is the source's.
    pub origin: Origin,
    /// The arguments after `cos_theta`. Methods with the same arguments have them in the same order.
    pub inputs: &'static [Input],
    /// Which forms it has.
    pub forms: Forms,
    /// Which media it describes.
    pub class: Class,
    /// The polarisation that it describes.
    pub light: Light,
    /// The domain in which it holds, and its behaviour outside.
    pub domain: &'static str,
    /// What it promises.
    pub claims: Claims,
    /// Whether it keeps the function contract.
    pub contract: Contract,
    /// How it is written in half precision, or why it is not.
    pub half: InHalf,
    /// Builds the formula.
    pub build: Build,
    /// The name of this way to write it; empty for the usual one.
    pub variant: &'static str,
    /// Other ways to write it in single precision, which mean the same and are cheaper on some GPUs: this method with another `build`. They
    /// promise what it promises. See [`Gpu`](super::Gpu).
    pub variants: &'static [&'static Method],
    /// A form that is cheaper once constants are folded in. With F0 known, F0 + (1 - F0) w is one multiplication and addition a
    /// channel. At run time F0 (1 - w) + w is, since 1 - w is one number for three channels.
    pub for_constants: Option<Build>,
    /// For a method that computes the coefficients of a fitted one from its inputs: these, as functions without a cosine, so that
    /// a shader computes them once a pixel.
    pub coefficients: Option<CoefficientsFromInputs>,
    /// The formula without the steps that keep it stable for every argument, if these steps cost something. A material gets
    /// this form if the record of code bounds says that its function loses no digits without them.
    pub plain: Option<Build>,
    /// A better method for a material with these constants, if there is one. It maps the values of this method's inputs to
    /// the other method and the values of its inputs.
    pub replacement: Option<Replacement>,
    /// For a fitted method, its shape: the functions that its coefficients multiply.
    pub shape: Option<Shape>,
    /// For a method that is not fitted: the numbers of a material that F is affine in before clamping.
    pub affine: Option<Affine>,
    /// The mean over the hemisphere, where it does not follow from [`Method::basis`].
    pub average: Option<FittedAverage>,
    /// At how many wavelengths it computes the law of a film; 0 for one that knows no wavelengths.
    pub wavelengths: usize,
}

impl Method {
    /// The defaults: three channels of unpolarised light for any medium, in keeping with the contract, without optional parts.
    /// The rest is empty.
    pub const BASE: Method = Method {
        name: "",
        summary: "",
        formula: &[],
        source: Citation {
            authors: "",
            title: "",
            place: "",
            year: 0,
            link: "",
        },
        origin: Origin::Published,
        inputs: &[],
        forms: Forms::Colour,
        class: Class::Any,
        light: Light::Unpolarised,
        domain: "",
        claims: Claims::NONE,
        contract: Contract::Kept,
        half: InHalf::within(0.0),
        build: |x| x.cosine(),
        variant: "",
        variants: &[],
        for_constants: None,
        coefficients: None,
        plain: None,
        replacement: None,
        shape: None,
        affine: None,
        average: None,
        wavelengths: 0,
    };
}

/// How the coefficients of a fitted method follow from other inputs.
#[derive(Clone, Copy, Debug)]
pub struct CoefficientsFromInputs {
    /// The fitted method.
    pub fitted: &'static str,
    /// The coefficients from the inputs.
    pub build: for<'b> fn(&Inputs<'b>) -> [Expr<'b>; 4],
    /// How far the fitted method is from the law with them: median and 90th percentile of the largest errors over the pages that the
    /// numbers were chosen on.
    pub model: [f64; 2],
    /// The largest error of a coefficient in unfused f32, for the media of the method's code error. It is absolute, because terms
    /// that are larger than their sum cancel. Tests check that it is neither exceeded nor slack.
    pub code_abs: f64,
}

/// A mean over the hemisphere, `2 ∫ F c dc`, that is fitted.
#[derive(Clone, Copy, Debug)]
pub struct FittedAverage {
    /// Builds it. The inputs have no cosine.
    pub build: Build,
    /// Its largest difference from the true mean.
    pub max_abs: f64,
    /// The arguments that this holds for, in words.
    pub over: &'static str,
    /// The errors of published fits of the same mean, with their source.
    pub published: &'static str,
}

/// From arguments to a formula.
pub type Build = for<'b> fn(&Inputs<'b>) -> Expr<'b>;

/// The method that a specialised function is made of instead, and the values of its inputs.
pub type Replacement = fn(&Values) -> Option<(&'static Method, Values)>;

/// Values of inputs by name; a scalar input uses the first number.
pub type Values = BTreeMap<String, [f64; 3]>;

/// The forms that a method's library file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forms {
    /// Three channels.
    Colour,
    /// Three channels, and one with the suffix `_scalar`.
    ColourAndScalar,
}

/// The light that a method describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Light {
    /// As from most lamps and the sun: the mean of both polarisations.
    Unpolarised,
    /// Electric field perpendicular to the plane of incidence.
    S,
    /// Electric field in the plane of incidence.
    P,
}

/// Whether a method keeps the function contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contract {
    /// It does.
    Kept,
    /// It does not, and is kept for comparison. The text says where it fails.
    Exempt(&'static str),
}

/// Where the form of a method comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// From the source.
    Published,
    /// From the source, with the changes stated here.
    Adapted(&'static str),
    /// Ours. The text says what was taken from the source.
    Ours(&'static str),
}

impl Method {
    /// The usual way to write it, then its variants.
    pub fn with_variants(&'static self) -> impl Iterator<Item = &'static Method> {
        core::iter::once(self).chain(self.variants.iter().copied())
    }

    /// The library function: three channels, or the scalar form, with run-time arguments.
    ///
    /// # Errors
    /// The method's graph breaks a rule of [`crate::language::ir::RULES`]; tests hold that none does.
    pub fn function(&self, scalar_form: bool) -> Result<Checked, BrokenRule> {
        self.function_in(Precision::F32, scalar_form)
    }

    /// The same as it is computed in this precision.
    ///
    /// # Errors
    /// The method's graph breaks a rule of [`crate::language::ir::RULES`]; tests hold that none does.
    pub fn function_in(
        &self,
        precision: Precision,
        scalar_form: bool,
    ) -> Result<Checked, BrokenRule> {
        self.built(self.written(precision), precision, scalar_form)
    }

    fn built(
        &self,
        build: Build,
        precision: Precision,
        scalar_form: bool,
    ) -> Result<Checked, BrokenRule> {
        let builder = Builder::new();
        let inputs = Inputs::declare(&builder, self.inputs, scalar_form, precision);
        let result = build(&inputs);
        let shaped = if scalar_form { result } else { result.rgb() };
        let whole = builder.finish(self.name, shaped);
        check_in(precision, fold_in(precision, &whole))
    }

    /// How it is built: variants are of single precision, and in half precision the usual form is written.
    fn written(&self, precision: Precision) -> Build {
        let usual = || ALL.iter().find(|method| method.name == self.name);
        match precision {
            Precision::F16 if !self.variant.is_empty() => usual().expect("it has one").build,
            _ => self.build,
        }
    }

    /// A function of the inputs alone, without a cosine.
    fn built_without_cosine(
        &self,
        build: impl for<'b> Fn(&Inputs<'b>) -> Expr<'b>,
        precision: Precision,
        scalar_form: bool,
    ) -> Result<Checked, BrokenRule> {
        let builder = Builder::new();
        let inputs = Inputs::without_cosine(&builder, self.inputs, scalar_form, precision);
        let whole = builder.finish(self.name, build(&inputs));
        check_in(precision, fold_in(precision, &whole))
    }

    /// The function with these constants folded in. Inputs without a value stay arguments, and so do those that change from pixel
    /// to pixel.
    ///
    /// # Errors
    /// With these constants the graph breaks a rule of [`crate::language::ir::RULES`]: one is not finite in f32, for example.
    pub fn specialise(&self, values: &Values) -> Result<Checked, BrokenRule> {
        self.specialise_in(Precision::F32, values)
    }

    /// The same as it is computed in this precision.
    ///
    /// # Errors
    /// With these constants the graph breaks a rule of [`crate::language::ir::RULES`]: one is not finite in this precision, for example.
    pub fn specialise_in(
        &self,
        precision: Precision,
        values: &Values,
    ) -> Result<Checked, BrokenRule> {
        if let Some((method, values)) = self.replaced(values) {
            return method.specialise_in(precision, &values);
        }
        let build = self.for_constants.unwrap_or(self.build);
        let library = self.built(build, precision, false)?;
        let mut folded = values.clone();
        folded.retain(|name, _| self.kept().all(|input| input.name != name));
        check_in(precision, specialise_in(precision, &library, &folded))
    }

    /// The function of the cosine alone: with all of these values folded in.
    ///
    /// # Errors
    /// As [`Method::specialise`].
    pub fn at(&self, values: &Values) -> Result<Checked, BrokenRule> {
        let function = self.specialise(values)?;
        let rest = self.kept_of(values);
        check_in(
            Precision::F32,
            specialise_in(Precision::F32, &function, &rest),
        )
    }

    /// The inputs that a function of a material keeps as arguments.
    pub fn kept(&self) -> impl Iterator<Item = &'static Input> {
        self.inputs.iter().filter(|input| input.is_kept())
    }

    /// The values of those inputs.
    pub fn kept_of(&self, values: &Values) -> Values {
        let kept = self.kept().map(|input| input.name);
        kept.map(|name| (name.to_owned(), values[name])).collect()
    }

    /// Whether a function of a material keeps an argument beside the cosine and a texture.
    pub fn keeps_inputs(&self) -> bool {
        self.kept().next().is_some()
    }

    /// The plain form with these constants folded in, where the method has one; single precision.
    pub fn specialise_plain(&self, values: &Values) -> Option<Result<Checked, BrokenRule>> {
        if let Some((method, values)) = self.replaced(values) {
            return method.specialise_plain(&values);
        }
        let library = self.built(self.plain?, Precision::F32, false);
        let fold = |library: Checked| {
            check_in(
                Precision::F32,
                specialise_in(Precision::F32, &library, values),
            )
        };
        Some(library.and_then(fold))
    }

    /// The method whose formula a function specialised to these constants uses: this one, or its replacement.
    pub fn specialised_as(&'static self, values: &Values) -> &'static Method {
        let replaced = self.replaced(values);
        replaced.map_or(self, |(method, values)| method.specialised_as(&values))
    }

    /// The replacement for a specialised function, if there is one and all inputs have a value.
    fn replaced(&self, values: &Values) -> Option<(&'static Method, Values)> {
        let mut names = self.inputs.iter().map(|input| input.name);
        let complete = names.all(|name| values.contains_key(name));
        self.replacement.filter(|_| complete)?(values)
    }

    /// What a split-sum table of this method integrates; none where F is not affine in numbers of a material.
    pub fn basis(&self) -> Option<Basis> {
        let fitted = self.shape.map(Basis::Fitted);
        fitted.or_else(|| self.affine.map(Basis::Affine))
    }

    /// The mean over the hemisphere with the method's inputs as run-time arguments. None for methods that have neither a basis nor
    /// a fit.
    pub fn average_in(
        &self,
        precision: Precision,
        scalar_form: bool,
    ) -> Option<Result<Checked, BrokenRule>> {
        Some(match (self.basis(), self.average) {
            (Some(basis), _) => {
                self.built_without_cosine(|x| basis.build_average(x), precision, scalar_form)
            }
            (None, fitted) => self.built_without_cosine(fitted?.build, precision, scalar_form),
        })
    }

    /// A coefficient of a fitted method from this method's inputs as run-time arguments, three channels. None for methods that
    /// compute none, and in half precision, where the sum of coefficients that cancel has no digits.
    pub fn coefficient_in(
        &self,
        precision: Precision,
        place: usize,
    ) -> Option<Result<Checked, BrokenRule>> {
        let coefficients = self.coefficients.filter(|_| !precision.is_half())?;
        Some(self.built_without_cosine(|x| (coefficients.build)(x)[place], precision, false))
    }

    /// The number of each term, from values of the method's inputs, three channels each. None where there are none.
    pub fn numbers(&self, values: &Values) -> Option<Vec<[f64; 3]>> {
        let basis = self.basis()?;
        let arguments = self.arguments::<f64>(values, None);
        let number = |place: usize| {
            let number =
                self.built_without_cosine(|x| basis.build(x)[place].rgb(), Precision::F32, false);
            Some(evaluate(&number.ok()?, &arguments).at(0))
        };
        (0..basis.terms()).map(number).collect()
    }

    /// These values as the library function takes them after `cos_theta`, and the texture where it reads one. An input
    /// without a value is a bug.
    pub fn arguments<N: Num>(&self, values: &Values, table: Option<&Texels>) -> Vec<Value<N>> {
        let argument = |input: &Input| match input.ty {
            Ty::Vec3 => Value::rgb(values[input.name]),
            Ty::Texture => Value::Texture(table.cloned()),
            _ => Value::scalar(values[input.name][0]),
        };
        self.inputs.iter().map(argument).collect()
    }

    /// The media that the code error is stated over, in words.
    pub fn code_media(&self) -> &'static str {
        self.media(self.claims.code_over)
    }

    /// The range of an argument in this precision.
    pub fn range(&self, input: &Input, precision: Precision) -> Range {
        let claim = self.half.claim().filter(|_| precision.is_half());
        let ends = claim.map_or(&[][..], |claim| claim.ends);
        let end = ends.iter().find(|(name, _)| *name == input.name);
        Range {
            most: end.map_or(input.range.most, |(_, most)| *most),
            ..input.range
        }
    }

    /// A set of media in words, as far as the method describes them.
    pub fn media(&self, over: MediaSet) -> &'static str {
        match (self.class, over) {
            (Class::Dielectric, MediaSet::Wide) => "eta 1.0001 to 12",
            (Class::Dielectric, MediaSet::Half) => "eta 1.001 to 12",
            _ => over.text(),
        }
    }

    /// Whether the method reads a texture.
    pub fn is_textured(&self) -> bool {
        self.inputs.iter().any(|input| input.ty == Ty::Texture)
    }

    /// Whether the method's inputs are fitted coefficients, in which it is linear.
    pub fn is_fitted(&self) -> bool {
        self.shape.is_some()
    }

    /// Whether the method has a scalar form.
    pub fn has_scalar_form(&self) -> bool {
        self.forms == Forms::ColourAndScalar
    }

    /// Whether its form is ours, and not published elsewhere.
    pub fn is_ours(&self) -> bool {
        matches!(self.origin, Origin::Ours(_))
    }

    /// Where it comes from: the whole citation, and what of it is ours.
    pub fn source_in_full(&self) -> String {
        self.with_origin(&self.source.line())
    }

    /// The same with authors, year and link.
    pub fn source_in_short(&self) -> String {
        self.with_origin(&self.source.short())
    }

    fn with_origin(&self, citation: &str) -> String {
        match self.origin {
            Origin::Published => citation.to_owned(),
            Origin::Adapted(what) => format!("{what}; else {citation}"),
            Origin::Ours(of) => format!("the form is fresnel-gen's; {of}: {citation}"),
        }
    }
}
