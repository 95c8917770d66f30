//! What a method is: a plain record in a static table.
//!
//! The media that methods describe.
//!
//! Whose a method's form is, and how its source is cited.
//!
//! How well fitted methods follow classes of materials: metals, semiconductors, and dielectrics of n 1.2 or more, in air.
//!
//! The largest error over all angles and channels of each material, as median and 90th percentile: over the pages of the
//! catalogue, and over the pages of `data/outside.csv`, which had no part in any choice of a shape. The figures stand in the
//! methods' own files. The test `fits::classes_are_followed_as_promised` holds each in both directions.

use std::collections::BTreeMap;

use super::ALL;
use super::affine::{Affine, FittedAverage};
use super::half::InHalf;
use super::input::{Input, Inputs, Range};
use super::shape::Shape;
use crate::language::ir::{
    BrokenRule, Builder, Checked, Expr, Function, Texels, Ty, Value, check_in, fold_in,
    specialise_in,
};
use crate::physics::cite::Citation;
use crate::physics::num::{Num, Precision};

/// A formula for reflectance.
#[derive(Debug)]
pub struct Method {
    /// Its one name: file, `--method`, function after the prefix, row in every report.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// The formula, in ASCII, a line each.
    pub formula: &'static [&'static str],
    /// Who published it, or what it is built on.
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
    /// The domain in which it holds, and what it does outside.
    pub domain: &'static str,
    /// What it promises.
    pub claims: Claims,
    /// Whether it keeps the function contract.
    pub contract: Contract,
    /// How it is written in half precision, or why it is not.
    pub half: InHalf,
    /// Builds the formula.
    pub build: Build,
    /// The formula that constants are folded into, where other steps are cheaper then: with F0 known, F0 + (1 - F0) w is one
    /// multiplication and addition a channel; without it F0 (1 - w) + w is, since 1 - w is one number for three channels.
    pub for_constants: Option<Build>,
    /// Of a method that finds the coefficients of a fitted one from its inputs: these, as functions without a cosine, so that a shader
    /// finds them once a pixel.
    pub coefficients: Option<CoefficientsFromInputs>,
    /// The formula without the steps that keep it stable for every argument, if these steps cost something. A material gets
    /// this form if the record of code bounds says that its function loses no digits without them.
    pub plain: Option<Build>,
    /// A better method for a material with these constants, if there is one: the other method and the values of its inputs,
    /// from the values of this method's inputs.
    pub replacement: Option<Better>,
    /// The shape of a fitted method: the functions that its coefficients multiply.
    pub shape: Option<Shape>,
    /// The numbers of a material that F is affine in before its limit, of a method that is not fitted.
    pub affine: Option<Affine>,
    /// The mean over the hemisphere, of a method for which it does not follow from [`Method::basis`].
    pub average: Option<FittedAverage>,
}

impl Method {
    /// What most methods have: it keeps the contract, for light as it comes from lamps, and has nothing further. The rest is empty.
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
        claims: Claims {
            model: &[],
            code_ulp: 0.0,
            code_over: Over::Wide,
            colours: None,
            by_class: &[],
        },
        contract: Contract::Kept,
        half: InHalf::within(0.0),
        build: |x| x.cosine(),
        for_constants: None,
        coefficients: None,
        plain: None,
        replacement: None,
        shape: None,
        affine: None,
        average: None,
    };
}

/// How the coefficients of a fitted method follow from other inputs.
#[derive(Clone, Copy, Debug)]
pub struct CoefficientsFromInputs {
    /// The fitted method.
    pub fitted: &'static str,
    /// The coefficients from the inputs.
    pub build: for<'b> fn(&Inputs<'b>) -> [Expr<'b>; 4],
    /// The most that a coefficient in unfused f32 is off, for the media of the method's code error. It is absolute: terms that are
    /// larger than their sum cancel. Tests hold it in both directions.
    pub code_abs: f64,
}

/// From arguments to a formula.
pub type Build = for<'b> fn(&Inputs<'b>) -> Expr<'b>;

/// Gives the method, and the values of its inputs, that a specialised function is made of instead.
pub type Better = fn(&Values) -> Option<(&'static Method, Values)>;

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
    /// As from most lamps and the sun.
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
    /// It does not: it is kept for comparison. Says where it fails.
    Exempt(&'static str),
}

/// What a method promises. Tests hold each figure in both directions: not exceeded, and not slack.
#[derive(Clone, Copy, Debug)]
pub struct Claims {
    /// Model error: maximum absolute difference to the exact law, over stated sets of media and all angles.
    pub model: &'static [Claim],
    /// Code error: the most ulp by which unfused f32 differs from f64 at the same inputs, over these media and all
    /// angles; differences within 2⁻²² do not count. 0 for what a texture is read for: its sampler decides.
    pub code_ulp: f64,
    /// The media that the code error is stated over.
    pub code_over: Over,
    /// The code error over all that artists feed, where a method takes colours.
    pub colours: Option<Colours>,
    /// How well a fitted method follows classes of materials.
    pub by_class: &'static [ByClass],
}

/// A promised code error of a method that artists feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colours {
    /// The most by which f32, unfused or fused, differs from f64 at the same inputs, over every argument from 0 to 1 and every
    /// angle.
    pub max_abs: f64,
    /// Arguments that it holds for from and up to other values.
    pub ends: &'static [(&'static str, Range)],
    /// What is promised less beyond these; may be empty.
    pub beyond: &'static str,
}

impl Colours {
    /// At most this.
    pub const fn within(max_abs: f64) -> Option<Colours> {
        Some(Colours {
            max_abs,
            ends: &[],
            beyond: "",
        })
    }

    /// Where the promise holds.
    pub fn range(&self, input: &Input) -> Range {
        let own = self.ends.iter().find(|(name, _)| *name == input.name);
        let whole = Range {
            least: 0.0,
            most: 1.0,
        };
        own.map_or(whole, |(_, range)| *range)
    }
}

/// A promised model error.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Over which media.
    pub over: Over,
    /// The promise; 0 where the method is the exact law.
    pub max_abs: f64,
    /// The angle, in degrees, at which it is worst.
    pub at_degrees: f64,
}

/// The sets of media that claims are stated over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// Dielectrics, eta 1.3 to 2.5.
    Dielectrics,
    /// Metals, n 0.05 to 4.5 and k 1.5 to 8.
    Metals,
    /// From nearly matched to far beyond any material, n 1.0001 to 12 and k 0 to 13 (0 for dielectrics), and metals.
    Wide,
    /// What half precision is held to: n 1.001 to 12 and k 0 to 60 (0 for dielectrics), and metals.
    Half,
}

impl Over {
    /// A medium of the set, n and k, from two shares in [0, 1]. [`Over::Wide`] and
    /// [`Over::Half`] are dense where formulas break, near n = 1 and k = 0; their metals are those of [`Over::Metals`].
    pub fn medium(self, n_share: f64, k_share: f64) -> (f64, f64) {
        match self {
            Over::Dielectrics => (1.3 + 1.2 * n_share, 0.0),
            Over::Metals => (0.05 * libm::pow(90.0, n_share), 1.5 + 6.5 * k_share),
            Over::Wide => (
                1.0 + 1e-4 * libm::pow(1.1e5, n_share),
                13.0 * k_share * k_share,
            ),
            Over::Half => (
                1.0 + 1e-3 * libm::pow(1.1e4, n_share),
                60.0 * k_share * k_share,
            ),
        }
    }

    /// Whether a medium lies in the set.
    pub fn holds(self, n: f64, k: f64) -> bool {
        let metal = || (0.05..=4.5).contains(&n) && (1.5..=8.0).contains(&k);
        match self {
            Over::Dielectrics => (1.3..=2.5).contains(&n) && k == 0.0,
            Over::Metals => metal(),
            Over::Wide => (1.0001..=12.0).contains(&n) && (0.0..=13.0).contains(&k) || metal(),
            Over::Half => (1.001..=12.0).contains(&n) && (0.0..=60.0).contains(&k) || metal(),
        }
    }

    /// The set in words.
    pub fn text(self) -> &'static str {
        match self {
            Over::Dielectrics => "eta 1.3 to 2.5",
            Over::Metals => "n 0.05 to 4.5, k 1.5 to 8",
            Over::Wide => "n 1.0001 to 12 with k 0 to 13, and n 0.05 to 4.5 with k 1.5 to 8",
            Over::Half => "n 1.001 to 12 with k 0 to 60, and n 0.05 to 4.5 with k 1.5 to 8",
        }
    }
}

impl Method {
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
        self.built(self.build, precision, scalar_form)
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

    /// The function with these constants folded in; inputs that have no value stay arguments.
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
        if let Some((method, values)) = self.better(values) {
            return method.specialise_in(precision, &values);
        }
        let build = self.for_constants.unwrap_or(self.build);
        let library: Function = (*self.built(build, precision, false)?).clone();
        check_in(precision, specialise_in(precision, &library, values))
    }

    /// The plain form with these constants folded in, where the method has one; single precision.
    pub fn specialise_plain(&self, values: &Values) -> Option<Result<Checked, BrokenRule>> {
        if let Some((method, values)) = self.better(values) {
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

    /// The method whose formula a function specialised to these constants has: another one's, where that does the work better.
    pub fn specialised_as(&'static self, values: &Values) -> &'static Method {
        let better = self.better(values);
        better.map_or(self, |(method, values)| method.specialised_as(&values))
    }

    /// What does a specialised function's work better, where all inputs have a value.
    fn better(&self, values: &Values) -> Option<(&'static Method, Values)> {
        let mut names = self.inputs.iter().map(|input| input.name);
        let complete = names.all(|name| values.contains_key(name));
        let better = self.replacement.filter(|_| complete)?;
        better(values)
    }

    /// These values as the library function takes them after `cos_theta`, and the texture where it reads one; an input
    /// without a value is a bug.
    pub fn arguments<N: Num>(&self, values: &Values, table: Option<&Texels>) -> Vec<Value<N>> {
        let argument = |input: &Input| match input.ty {
            Ty::Rgb => Value::rgb(values[input.name]),
            Ty::Texture => Value::Texture(table.cloned()),
            _ => Value::scalar(values[input.name][0]),
        };
        self.inputs.iter().map(argument).collect()
    }

    /// The media that the code error is stated over, in words.
    pub fn code_media(&self) -> &'static str {
        self.media(self.claims.code_over)
    }

    /// Where an argument lies in this precision.
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
    pub fn media(&self, over: Over) -> &'static str {
        match (self.class, over) {
            (Class::Dielectric, Over::Wide) => "eta 1.0001 to 12",
            (Class::Dielectric, Over::Half) => "eta 1.001 to 12",
            _ => over.text(),
        }
    }

    /// Whether the method reads a texture.
    pub fn is_textured(&self) -> bool {
        self.inputs.iter().any(|input| input.ty == Ty::Texture)
    }

    /// Whether the method's inputs are coefficients, in which it is linear: they are fitted.
    pub fn is_fitted(&self) -> bool {
        self.shape.is_some()
    }

    /// Whether the method has a scalar form.
    pub fn has_scalar_form(&self) -> bool {
        self.forms == Forms::ColourAndScalar
    }
}

/// The media that a method describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// k = 0.
    Dielectric,
    /// k of a quarter of n and more.
    Metal,
    /// Any k.
    Any,
}

impl Class {
    /// Whether a method of this class describes a medium with this index.
    pub fn describes(self, n: f64, k: f64) -> bool {
        match self {
            Class::Dielectric => k == 0.0,
            Class::Metal => k >= LEAST_METALLIC * n,
            Class::Any => true,
        }
    }

    /// What it describes, in words.
    pub fn described(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics (k = 0)",
            Class::Metal => "metals (k of n / 4 and more)",
            Class::Any => "all media",
        }
    }

    /// What it describes, in words that refuse another medium.
    pub fn media(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics only, and this absorbs (k > 0)",
            Class::Metal => "metals only, with k of at least n / 4, and this has less",
            Class::Any => "all media",
        }
    }
}

/// The least k of a metal, as a share of n: semiconductors have less where one sees them.
const LEAST_METALLIC: f64 = 0.25;

/// Whose a method's form is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The source's.
    Published,
    /// The source's but for what is said here.
    Adapted(&'static str),
    /// Ours. Says what the source is of.
    Ours(&'static str),
}

impl Method {
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

/// Median and 90th percentile of the largest errors of some materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Half of them err no more.
    pub median: f64,
    /// Nine of ten err no more.
    pub ninth: f64,
}

/// What a fitted method promises of a class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByClass {
    /// `metal`, `semiconductor` or `dielectric`.
    pub class: &'static str,
    /// Over the catalogue.
    pub catalogue: Spread,
    /// Over pages that are not in the catalogue.
    pub outside: Spread,
    /// Nine of ten of both together err no more. A fit that errs more misses its class.
    pub limit: f64,
}

impl ByClass {
    /// A promise of a class: median and 90th percentile over the catalogue and outside it, and what nine of ten of both err at
    /// most.
    pub(super) const fn of_class(
        class: &'static str,
        catalogue: [f64; 2],
        outside: [f64; 2],
        limit: f64,
    ) -> ByClass {
        ByClass {
            class,
            catalogue: Spread::new(catalogue),
            outside: Spread::new(outside),
            limit,
        }
    }
}

impl Spread {
    const fn new([median, ninth]: [f64; 2]) -> Spread {
        Spread { median, ninth }
    }
}

/// Every promise with its method.
pub fn promises_by_class() -> impl Iterator<Item = (&'static Method, &'static ByClass)> {
    let own = |method: &'static Method| method.claims.by_class.iter().map(move |row| (method, row));
    ALL.iter().copied().flat_map(own)
}

/// What a method promises of a class, where it promises anything.
pub fn by_class(method: &Method, class: &str) -> Option<&'static ByClass> {
    let mut own = method.claims.by_class.iter();
    own.find(|row| row.class == class)
}

#[cfg(test)]
mod tests {
    use super::ALL;

    #[test]
    fn every_fitted_method_promises_something_of_a_class() {
        for method in ALL {
            let promises = !method.claims.by_class.is_empty();
            let is_meant_to = method.name.starts_with("fitted");
            assert_eq!(promises, is_meant_to, "{}", method.name);
            assert!(is_meant_to || !method.is_fitted(), "{}", method.name);
        }
    }
}
