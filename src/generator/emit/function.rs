//! A function ready to be printed: its name, its form, its graph, and what is known of its errors.

use serde::{Deserialize, Serialize};

use super::effect_file::EffectPart;
use super::figures::{Bounds, CodeBound, FILTERED, Missed, PLAIN_ULP, missed};
use super::file::Error;
use crate::generator::fit::{Measured, ModelError, model_error, values_for_material_in};
use crate::generator::reference::MaterialInMedium;
use crate::language::ir::{BrokenRule, Checked};
use crate::language::methods::{Method, Values};
use crate::physics::num::Precision;

/// How functions are named. The name shows half precision.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Naming {
    /// The prefix of every function's name.
    pub prefix: String,
    /// The functions' precision.
    pub precision: Precision,
}

impl Default for Naming {
    fn default() -> Naming {
        Naming {
            prefix: "fresnel_".to_owned(),
            precision: Precision::F32,
        }
    }
}

impl Naming {
    /// The value of `--prefix` in a command that repeats a run; none where it is the default.
    pub(crate) fn flag_of_prefix(prefix: &str) -> Option<&str> {
        Some(prefix).filter(|prefix| *prefix != Naming::default().prefix)
    }

    /// The name of a method's function for a material. The exact law's function has the material's name alone.
    pub fn specialised(&self, method: &Method, subject: &MaterialInMedium) -> String {
        if method.name == subject.exact_method() {
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
    /// The meaning of the function. In single precision it is its own graph. In half precision it is the graph of single
    /// precision, so that half precision's own guards and rounded constants count as code error.
    ///
    /// # Errors
    /// The graph breaks a rule of the representation: a bug.
    pub fn meaning(&self) -> Result<Checked, BrokenRule> {
        let (method, single) = (self.method, Precision::F32);
        if self.precision == single {
            return Ok(self.function.clone());
        }
        let average = |is_scalar| {
            let average = method.average_in(single, is_scalar);
            average.expect("what has a mean in half precision has it in single precision")
        };
        let coefficient = |place| {
            let coefficient = method.coefficient_in(single, place);
            coefficient
                .expect("what finds coefficients in half precision finds them in single precision")
        };
        match self.form {
            FunctionForm::Library => method.function(false),
            FunctionForm::Scalar => method.function(true),
            FunctionForm::Specialised => method.specialise(&self.constants),
            FunctionForm::Average => average(false),
            FunctionForm::AverageScalar => average(true),
            FunctionForm::C0 => coefficient(0),
            FunctionForm::C1 => coefficient(1),
            FunctionForm::C2 => coefficient(2),
            FunctionForm::C3 => coefficient(3),
        }
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
    let forms = [(FunctionForm::Library, false), (FunctionForm::Scalar, true)];
    let wanted = forms
        .into_iter()
        .filter(|(_, is_scalar)| !is_scalar || method.has_scalar_form());
    wanted
        .map(|(form, is_scalar)| {
            let function = method.function_in(naming.precision, is_scalar);
            library_function(method, naming, form, function)
        })
        .collect()
}

/// A function with run-time arguments.
pub(super) fn library_function(
    method: &'static Method,
    naming: &Naming,
    form: FunctionForm,
    function: Result<Checked, BrokenRule>,
) -> Result<EmittedFunction, Error> {
    let function = function.map_err(|fault| Error::Generated {
        file: method.name.to_owned(),
        what: fault.to_string(),
    })?;
    Ok(EmittedFunction {
        name: naming.name(method.name, &form.suffix()),
        method,
        effect: None,
        form,
        precision: naming.precision,
        function,
        constants: Values::new(),
        model_error: None,
        code: promised(method, form, naming.precision),
        plain_for: None,
        written_as: None,
        missed: None,
    })
}

/// The code error that a library function promises.
fn promised(method: &Method, form: FunctionForm, precision: Precision) -> Measured<CodeBound> {
    let refused = method.half.library_refusal();
    let finds = method.coefficients.filter(|_| form.coefficient().is_some());
    if let (Precision::F32, Some(finds)) = (precision, finds) {
        return Measured::Yes(CodeBound::Absolute(finds.code_abs));
    }
    match (precision, method.half.claim(), refused) {
        (Precision::F16, Some(claim), _) => Measured::Yes(CodeBound::Absolute(claim.max_abs)),
        (Precision::F16, None, why) => Measured::No(why.unwrap_or_default().to_owned()),
        (Precision::F32, ..) if method.is_textured() => Measured::No(FILTERED.to_owned()),
        (Precision::F32, ..) => Measured::Yes(CodeBound::Ulp(method.claims.code_ulp)),
    }
}

/// A method's formula with a material's constants folded in, in the form that is written.
#[derive(Clone, Debug)]
pub struct Specialised {
    /// The graph.
    pub function: Checked,
    /// The values that were folded in.
    pub constants: Values,
    /// For a plain form: the operations of the stable one.
    pub plain_for: Option<usize>,
}

/// A method's formula specialised to a material, without its errors.
///
/// # Errors
/// The method does not describe this, or the graph with these constants breaks a rule of
/// [`crate::language::ir::RULES`].
pub fn specialised_graph(
    method: &Method,
    subject: &MaterialInMedium,
    precision: Precision,
    bounds: &Bounds,
) -> Result<Specialised, Error> {
    if !subject.is_described_by(method) {
        let serves = if method.is_fitted() {
            subject.fitted_method().unwrap_or("fitted_five")
        } else {
            subject.exact_method()
        };
        let what = format!("it describes {}; {serves} serves it", method.class.media());
        return Err(refused(method, subject, &what));
    }
    let constants = values_for_material_in(precision, subject, method);
    let stable = specialise(method, subject, precision, &constants)?;
    let plain = match precision {
        Precision::F32 => plain(method, &constants, &stable, bounds),
        Precision::F16 => None,
    };
    Ok(Specialised {
        plain_for: plain.as_ref().map(|_| stable.work()),
        function: plain.unwrap_or(stable),
        constants,
    })
}

fn specialise(
    method: &Method,
    subject: &MaterialInMedium,
    precision: Precision,
    constants: &Values,
) -> Result<Checked, Error> {
    let function = method.specialise_in(precision, constants);
    function.map_err(|fault| refused(method, subject, &fault.to_string()))
}

fn refused(method: &Method, subject: &MaterialInMedium, what: &str) -> Error {
    Error::Specialise {
        method: method.name.to_owned(),
        material: subject.name.clone(),
        what: what.to_owned(),
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
    let Specialised {
        function,
        constants,
        plain_for,
    } = specialised_graph(method, subject, naming.precision, bounds)?;
    let meant = match naming.precision {
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
        code: match (naming.precision, method.half.refusal()) {
            (Precision::F16, Some(why)) => Measured::No(why.to_owned()),
            _ if method.is_textured() => Measured::No(FILTERED.to_owned()),
            (precision, _) => bounds.of(precision, &function),
        },
        written_as: Some(method.specialised_as(&constants))
            .filter(|other| other.name != method.name),
        constants,
        function,
        plain_for,
    })
}

/// The plain form, where it is cheaper and recorded as accurate.
fn plain(
    method: &Method,
    constants: &Values,
    stable: &Checked,
    bounds: &Bounds,
) -> Option<Checked> {
    let plain = method.specialise_plain(constants)?.ok()?;
    let bound = bounds.of(Precision::F32, &plain);
    let keeps = matches!(bound, Measured::Yes(CodeBound::Ulp(ulp)) if ulp <= PLAIN_ULP);
    (keeps && plain.work() < stable.work()).then_some(plain)
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
    pub(super) fn suffix(self) -> String {
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
}
