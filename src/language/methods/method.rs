//! What a method is: a record in a static table ([`Method`]), with its promised errors ([`Claims`]), the media that it
//! describes ([`Class`]) and the origin of its form ([`Origin`]).
//!
//! Fitted methods also promise how well they follow classes of materials ([`ByClass`]): metals, semiconductors, and
//! dielectrics of n 1.2 or more, in air. The figure is the largest error over all angles and channels of each material, as
//! median and 90th percentile: over the pages of the catalogue, and over the pages of `data/outside.csv`, which had no part
//! in any choice of a shape. The figures stand in the methods' own files. The test `fits::classes_are_followed_as_promised`
//! checks that each is neither exceeded nor slack.

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
    pub replacement: Option<Better>,
    /// For a fitted method, its shape: the functions that its coefficients multiply.
    pub shape: Option<Shape>,
    /// For a method that is not fitted: the numbers of a material that F is affine in before clamping.
    pub affine: Option<Affine>,
    /// The mean over the hemisphere, where it does not follow from [`Method::basis`].
    pub average: Option<FittedAverage>,
}

impl Method {
    /// The defaults of most methods: it keeps the contract, for unpolarised light, without optional parts. The rest is empty.
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
    /// The largest error of a coefficient in unfused f32, for the media of the method's code error. It is absolute, because terms
    /// that are larger than their sum cancel. Tests check that it is neither exceeded nor slack.
    pub code_abs: f64,
}

/// From arguments to a formula.
pub type Build = for<'b> fn(&Inputs<'b>) -> Expr<'b>;

/// The method that a specialised function is made of instead, and the values of its inputs.
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

/// What a method promises. Tests check each figure in both directions: not exceeded, and not slack.
#[derive(Clone, Copy, Debug)]
pub struct Claims {
    /// Model error: maximum absolute difference to the exact law, over stated sets of media and all angles.
    pub model: &'static [Claim],
    /// Code error: the largest difference in ulp between unfused f32 and f64 at the same inputs, over these media and all
    /// angles. Differences within 2⁻²² do not count. 0 for a method that reads a texture, where the sampler decides.
    pub code_ulp: f64,
    /// The media that the code error is stated over.
    pub code_over: Over,
    /// The code error over all colours that artists may enter, where a method takes colours.
    pub colours: Option<Colours>,
    /// How well a fitted method follows classes of materials.
    pub by_class: &'static [ByClass],
}

/// A promised code error of a method whose inputs artists enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colours {
    /// The largest difference between f32, unfused or fused, and f64 at the same inputs, over every argument from 0 to 1 and
    /// every angle.
    pub max_abs: f64,
    /// Arguments for which it holds over another range than 0 to 1.
    pub ends: &'static [(&'static str, Range)],
    /// The weaker promise beyond these; may be empty.
    pub beyond: &'static str,
}

impl Colours {
    /// An error of at most this, over arguments from 0 to 1.
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
    /// The media that it is stated over.
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
    /// The media of claims in half precision: n 1.001 to 12 and k 0 to 60 (0 for dielectrics), and metals.
    Half,
}

impl Over {
    /// A medium of the set, n and k, from two parameters in [0, 1]. [`Over::Wide`] and [`Over::Half`] are dense where formulas
    /// break, near n = 1 and k = 0. Their metals are those of [`Over::Metals`].
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

    /// The function with these constants folded in. Inputs without a value stay arguments.
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

    /// The method whose formula a function specialised to these constants uses: this one, or a better one.
    pub fn specialised_as(&'static self, values: &Values) -> &'static Method {
        let better = self.better(values);
        better.map_or(self, |(method, values)| method.specialised_as(&values))
    }

    /// The better method for a specialised function, if there is one and all inputs have a value.
    fn better(&self, values: &Values) -> Option<(&'static Method, Values)> {
        let mut names = self.inputs.iter().map(|input| input.name);
        let complete = names.all(|name| values.contains_key(name));
        let better = self.replacement.filter(|_| complete)?;
        better(values)
    }

    /// These values as the library function takes them after `cos_theta`, and the texture where it reads one. An input
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

    /// Whether the method's inputs are fitted coefficients, in which it is linear.
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
    /// k of at least a quarter of n.
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

    /// The media in words.
    pub fn described(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics (k = 0)",
            Class::Metal => "metals (k of n / 4 and more)",
            Class::Any => "all media",
        }
    }

    /// The media in words, for a message that refuses another medium.
    pub fn media(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics only, and this absorbs (k > 0)",
            Class::Metal => "metals only, with k of at least n / 4, and this has less",
            Class::Any => "all media",
        }
    }
}

/// The least k of a metal, as a fraction of n: semiconductors have less at visible wavelengths.
const LEAST_METALLIC: f64 = 0.25;

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
    /// Half of the materials err no more.
    pub median: f64,
    /// The 90th percentile: nine of ten err no more.
    pub ninth: f64,
}

/// What a fitted method promises for a class of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByClass {
    /// `metal`, `semiconductor` or `dielectric`.
    pub class: &'static str,
    /// Over the catalogue.
    pub catalogue: Spread,
    /// Over pages that are not in the catalogue.
    pub outside: Spread,
    /// The 90th percentile over both together. A fit that errs more misses its class.
    pub limit: f64,
}

impl ByClass {
    /// A promise for a class: median and 90th percentile over the catalogue and outside it, and the 90th percentile over both.
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

/// What a method promises for a class, if anything.
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
