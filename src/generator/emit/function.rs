//! A function ready to be printed: its name, its form, its graph, and what is known of its errors.

use serde::{Deserialize, Serialize};

use super::code_bound::{Bounds, CodeBound, FILTERED};
use super::error::Error;
use super::specialised::{Missed, Specialised, missed, specialise, specialised_graph, whole};
use crate::generator::fit::{Measured, ModelError, known_film, model_error, thickness_error};
use crate::generator::reference::MaterialInMedium;
use crate::language::effects::{Effect, EffectFunction};
use crate::language::ir::{BrokenRule, Checked};
use crate::language::methods::{Gpu, Method, Values};
use crate::language::targets;
use crate::physics::names::identifier_fault;
use crate::physics::num::Precision;

/// How functions are named and written. The name shows half precision.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Naming {
    /// The prefix of every function's name.
    pub prefix: String,
    /// The functions' precision.
    pub precision: Precision,
    /// The GPU whose variants of methods are written; none for each method as it is given.
    pub gpu: Option<Gpu>,
}

impl Default for Naming {
    fn default() -> Naming {
        Naming {
            prefix: "fresnel_".to_owned(),
            precision: Precision::F32,
            gpu: None,
        }
    }
}

impl Naming {
    /// The name of a method's library function, which its file has too.
    pub fn library(&self, method: &Method) -> String {
        self.name(method.name, "")
    }

    /// A method as it is written here.
    pub(in crate::generator) fn written(
        &self,
        method: &'static Method,
        form: FunctionForm,
    ) -> &'static Method {
        let of = |gpu| method.written_for(gpu, form.name(), self.precision);
        self.gpu.map_or(method, of)
    }

    /// The value of `--prefix` in a command that repeats a run; none where it is the default.
    pub(crate) fn flag_of_prefix(prefix: &str) -> Option<&str> {
        Some(prefix).filter(|prefix| *prefix != Naming::default().prefix)
    }

    /// The name of a method's function for a material. The exact law's function has the material's name alone.
    pub fn specialised(&self, method: &Method, subject: &MaterialInMedium) -> String {
        if method.name == subject.main_method() {
            self.name(&subject.name, "")
        } else {
            self.name(&subject.name, &format!("_{}", method.name))
        }
    }

    /// The name of a material's file.
    pub fn material(&self, subject: &MaterialInMedium) -> String {
        format!("{}{}", subject.name, self.precision.suffix())
    }

    /// The name of a function, from a method or a material and a variant of it.
    fn name(&self, of: &str, variant: &str) -> String {
        format!("{}{of}{variant}{}", self.prefix, self.precision.suffix())
    }
}

/// A requested function of an effect.
#[derive(Clone, Copy, Debug)]
pub struct EffectPart {
    /// The effect.
    pub effect: &'static Effect,
    /// The function.
    pub function: &'static EffectFunction,
}

/// A function with everything that its page says about it.
#[derive(Clone, Debug)]
pub struct EmittedFunction {
    /// Its name in the language.
    pub name: String,
    /// Its method. For an effect's function, the method that computes R.
    pub method: &'static Method,
    /// For an effect's function: which one.
    pub effect: Option<EffectPart>,
    /// Its arguments and result.
    pub form: FunctionForm,
    /// Its precision.
    pub precision: Precision,
    /// The graph.
    pub function: Checked,
    /// The values that were folded in, for a specialised function.
    pub constants: Values,
    /// Method against exact law, for a specialised function.
    pub model_error: Option<ModelError>,
    /// For a method that computes at a few wavelengths: the film's thickness in nanometres, and the largest error from 0 to it.
    pub thicknesses: Option<(f64, f64)>,
    /// The error of its own precision against f64.
    pub code: Measured<CodeBound>,
    /// The method whose formula it has, if that is another one's.
    pub written_as: Option<&'static Method>,
    /// For a plain form: the operations of the stable one.
    pub plain_for: Option<usize>,
    /// For a fit: whether it misses what its method promises for the material's class.
    pub missed: Option<Missed>,
}

impl EmittedFunction {
    /// A function in single precision with run-time arguments.
    pub(super) fn new(
        name: String,
        method: &'static Method,
        form: FunctionForm,
        function: Checked,
        code: Measured<CodeBound>,
    ) -> EmittedFunction {
        EmittedFunction {
            name,
            method,
            effect: None,
            form,
            precision: Precision::F32,
            function,
            constants: Values::new(),
            model_error: None,
            thicknesses: None,
            code,
            written_as: None,
            plain_for: None,
            missed: None,
        }
    }

    /// The meaning of the function. In single precision it is its own graph. In half precision it is the graph of single
    /// precision, so that half precision's own guards and rounded constants count as code error.
    ///
    /// # Errors
    /// The graph breaks a rule of the representation: a bug.
    pub fn meaning(&self) -> Result<Checked, BrokenRule> {
        if self.precision == Precision::F32 {
            return Ok(self.function.clone());
        }
        if self.form == FunctionForm::Specialised {
            return self.method.specialise(&self.constants);
        }
        let single = self.form.graph(self.method, Precision::F32);
        single.expect("a form of half precision is one of single precision too")
    }
}

/// The functions of a method's library file.
///
/// # Errors
/// The method's graph breaks a rule of [`crate::language::ir::RULES`].
pub fn library_functions(
    method: &'static Method,
    naming: &Naming,
) -> Result<Vec<EmittedFunction>, Error> {
    in_forms(
        method,
        naming,
        &[FunctionForm::Library, FunctionForm::Scalar],
    )
}

/// The functions beside a method's own that take no cosine: the means in three channels and in one, where the method has them,
/// and the coefficients that a method finds for a fitted one.
///
/// # Errors
/// As [`library_functions`].
pub fn companions(method: &'static Method, naming: &Naming) -> Result<Vec<EmittedFunction>, Error> {
    let [c0, c1, c2, c3] = FunctionForm::COEFFICIENTS;
    let (average, scalar) = (FunctionForm::Average, FunctionForm::AverageScalar);
    in_forms(method, naming, &[average, scalar, c0, c1, c2, c3])
}

/// The functions with run-time arguments in those of these forms that the method has.
fn in_forms(
    method: &'static Method,
    naming: &Naming,
    forms: &[FunctionForm],
) -> Result<Vec<EmittedFunction>, Error> {
    let mut functions = Vec::new();
    for form in forms {
        let method = naming.written(method, *form);
        let Some(function) = form.graph(method, naming.precision) else {
            continue;
        };
        functions.push(EmittedFunction {
            precision: naming.precision,
            ..EmittedFunction::new(
                naming.name(method.name, &form.suffix()),
                method,
                *form,
                function.map_err(|fault| Error::generated(method.name, fault))?,
                promised(method, *form, naming.precision),
            )
        });
    }
    Ok(functions)
}

/// The code error that a library function promises.
fn promised(method: &Method, form: FunctionForm, precision: Precision) -> Measured<CodeBound> {
    let finds = method.coefficients.filter(|_| form.coefficient().is_some());
    match (precision, method.half.claim(), finds) {
        (Precision::F16, Some(claim), _) => Measured::Yes(CodeBound::Absolute(claim.max_abs)),
        (Precision::F16, None, _) => {
            Measured::No(method.half.library_refusal().unwrap_or_default().to_owned())
        }
        (Precision::F32, _, Some(finds)) => Measured::Yes(CodeBound::Absolute(finds.code_abs)),
        (Precision::F32, ..) if method.is_textured() => Measured::No(FILTERED.to_owned()),
        (Precision::F32, ..) if method.claims.code_abs > 0.0 => {
            Measured::Yes(CodeBound::Absolute(method.claims.code_abs))
        }
        (Precision::F32, ..) => Measured::Yes(CodeBound::Ulp(method.claims.code_ulp)),
    }
}

/// A method specialised to a material.
///
/// # Errors
/// As [`specialised_graph`].
pub fn specialised_function(
    method: &'static Method,
    subject: &MaterialInMedium,
    naming: &Naming,
    bounds: &Bounds,
) -> Result<EmittedFunction, Error> {
    let method = naming.written(method, FunctionForm::Specialised);
    let Specialised {
        function,
        constants,
        plain_for,
    } = specialised_graph(method, subject, naming.precision, bounds)?;
    let meant = match naming.precision {
        _ if method.keeps_inputs() => whole(method, subject, &constants)?,
        Precision::F32 => function.clone(),
        Precision::F16 => specialise(method, subject, Precision::F32, &constants)?,
    };
    let error = model_error(&meant, &subject.truth_for(method));
    Ok(EmittedFunction {
        name: naming.specialised(method, subject),
        method,
        effect: None,
        form: FunctionForm::Specialised,
        precision: naming.precision,
        missed: missed(subject, method, error.max_abs),
        model_error: Some(error),
        thicknesses: (method.wavelengths > 0).then(|| {
            let film = subject.film(method.wavelengths, known_film);
            let most = thickness_error(subject, film);
            (film.thickness_nm, most)
        }),
        code: match (naming.precision, method.half.refusal()) {
            (Precision::F16, Some(why)) => Measured::No(why.to_owned()),
            _ if method.is_textured() => Measured::No(FILTERED.to_owned()),
            (Precision::F32, _) if method.claims.code_abs > 0.0 => {
                Measured::Yes(CodeBound::Absolute(method.claims.code_abs))
            }
            (precision, _) => bounds.of(precision, &function),
        },
        written_as: Some(method.specialised_as(&constants))
            .filter(|other| other.name != method.name),
        constants,
        function,
        plain_for,
    })
}

/// Checks that names are free in every language, since a function has the same name in all. Here names are complete, with their
/// prefix.
pub(super) fn check_names(functions: &[EmittedFunction]) -> Result<(), Error> {
    for emitted in functions {
        let fault = identifier_fault(&emitted.name)
            .map(|why| format!("`{}` is no name: {why}", emitted.name))
            .or_else(|| targets::name_fault(&emitted.name));
        if let Some(what) = fault {
            return Err(Error::Name { what });
        }
    }
    Ok(())
}

/// The arguments and result of a method's function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FunctionForm {
    /// Takes its arguments at run time, and returns three channels.
    Library,
    /// The same for one channel.
    Scalar,
    /// Has a material's constants folded in.
    Specialised,
    /// The mean over the hemisphere, three channels.
    Average,
    /// The same for one channel.
    AverageScalar,
    /// The first coefficient of a fitted method, from the inputs of a method that finds it.
    C0,
    /// The second.
    C1,
    /// The third.
    C2,
    /// The fourth.
    C3,
}

impl FunctionForm {
    /// The name in reports and in the manifest.
    pub fn name(self) -> &'static str {
        match self {
            FunctionForm::Library => "library",
            FunctionForm::Scalar => "scalar",
            FunctionForm::Specialised => "specialised",
            FunctionForm::Average => "average",
            FunctionForm::AverageScalar => "average_scalar",
            FunctionForm::C0 => "c0",
            FunctionForm::C1 => "c1",
            FunctionForm::C2 => "c2",
            FunctionForm::C3 => "c3",
        }
    }

    /// The suffix after the method's name in the name of a library function.
    fn suffix(self) -> String {
        match self {
            FunctionForm::Library | FunctionForm::Specialised => String::new(),
            other => format!("_{}", other.name()),
        }
    }

    /// The forms that give coefficients, in their order.
    pub const COEFFICIENTS: [FunctionForm; 4] = [
        FunctionForm::C0,
        FunctionForm::C1,
        FunctionForm::C2,
        FunctionForm::C3,
    ];

    /// The index of the coefficient that it gives, if it gives one.
    pub fn coefficient(self) -> Option<usize> {
        FunctionForm::COEFFICIENTS
            .iter()
            .position(|form| *form == self)
    }

    /// Whether it returns one channel.
    pub fn is_scalar(self) -> bool {
        matches!(self, FunctionForm::Scalar | FunctionForm::AverageScalar)
    }

    /// Whether it gives the mean over the hemisphere.
    pub fn is_mean(self) -> bool {
        matches!(self, FunctionForm::Average | FunctionForm::AverageScalar)
    }

    /// The graph of a method in this form, with run-time arguments; none where the method has no such form.
    fn graph(self, method: &Method, precision: Precision) -> Option<Result<Checked, BrokenRule>> {
        if self.is_scalar() && !method.has_scalar_form() {
            return None;
        }
        match self.coefficient() {
            Some(place) => method.coefficient_in(precision, place),
            None if self.is_mean() => method.average_in(precision, self.is_scalar()),
            None => Some(method.function_in(precision, self.is_scalar())),
        }
    }
}
