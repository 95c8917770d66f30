//! The functions among which a plan chooses for a material: each method, in each form whose cost is known.

use std::sync::Arc;

use super::curve::step_cosines;
use super::request::{PlanRequest, PlannedMaterial};
use crate::generator::emit::{Bounds, Error, FunctionForm, specialised_graph};
use crate::generator::fit::{arguments, table_of};
use crate::generator::reference::MaterialInMedium;
use crate::lab::budget::is_choosable;
use crate::lab::cost::{CostBasis, CostRecord, KnownCost, known_cost, known_library_cost, records};
use crate::language::ir::{Checked, evaluate};
use crate::language::methods::{self, Method};
use crate::physics::num::{Half, Num, Precision, each_channel, in_parallel};

/// The library function that every plan is compared with: it suits every material.
pub const SHARED: &str = "fitted";

/// What functions cost.
pub struct Prices<'a> {
    request: &'a PlanRequest,
    /// The recorded costs on the request's GPUs.
    record: CostRecord,
    /// The recorded bounds of functions.
    bounds: Bounds,
}

/// A function that may be chosen.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Its method.
    pub method: &'static Method,
    /// Its form: specialised, library, or scalar with the values of the green channel.
    pub form: FunctionForm,
    /// The cost of one evaluation.
    pub cost: f64,
    /// How the cost is known.
    pub basis: CostBasis,
    /// Its values at [`step_cosines`]; forms of a method share them.
    pub values: Arc<[[f64; 3]]>,
    /// The error in the frame where it is worst: 0 until it is judged, and infinite where it need not be, because a cheaper
    /// candidate is within the budget.
    pub error: f64,
    /// That frame, from 0.
    pub worst_frame: usize,
}

impl Candidate {
    /// Its method and form in words: `schlick`, `schlick, library`.
    pub fn name(&self) -> String {
        match self.form {
            FunctionForm::Specialised => self.method.name.to_owned(),
            form => format!("{}, {}", self.method.name, form.name()),
        }
    }

    /// Whether it serves this material alone.
    pub fn is_specialised(&self) -> bool {
        self.form == FunctionForm::Specialised
    }

    /// Whether it is the library function that every plan is compared with.
    pub fn is_shared(&self) -> bool {
        self.method.name == SHARED && self.form == FunctionForm::Library
    }

    /// How many channels it returns.
    pub fn channels(&self) -> usize {
        match self.form {
            FunctionForm::Scalar => 1,
            _ => 3,
        }
    }
}

/// The forms of functions that plans choose.
pub const PLANNED_FORMS: [FunctionForm; 3] = [
    FunctionForm::Specialised,
    FunctionForm::Library,
    FunctionForm::Scalar,
];

/// The candidates for a material, in the order of methods.
///
/// # Errors
/// A method cannot be specialised to the material.
pub fn candidates(material: &PlannedMaterial, prices: &Prices) -> Result<Vec<Candidate>, Error> {
    let (subject, request) = (&material.subject, prices.request);
    let is_one = |method: &&&'static Method| {
        is_choosable(method)
            && subject.is_described_by(method)
            && (request.fetch.is_some() || !method.is_textured())
            && !(request.precision.is_half() && method.half.refusal().is_some())
    };
    let methods: Vec<&'static Method> = request.methods.iter().filter(is_one).copied().collect();
    let of_method = |i: usize| of_method(methods[i], material, prices);
    let found = in_parallel(methods.len(), &of_method, &mut |_, _| {});
    let found = found.into_iter().collect::<Result<Vec<_>, Error>>()?;
    Ok(found.concat())
}

/// The candidates of a method whose cost is known and whose values are numbers.
fn of_method(
    method: &'static Method,
    material: &PlannedMaterial,
    prices: &Prices,
) -> Result<Vec<Candidate>, Error> {
    let (subject, request) = (&material.subject, prices.request);
    let function = prices.specialised(method, subject)?;
    let all: Arc<[_]> = values(&function, subject, request.precision).into();
    let mut candidates = Vec::new();
    for form in PLANNED_FORMS {
        if material.is_library_only && form == FunctionForm::Specialised {
            continue;
        }
        let Some(KnownCost { cost, basis }) = prices.cost(method, form, &function) else {
            continue;
        };
        let values = match form {
            FunctionForm::Scalar => all.iter().map(|value| [value[1]; 3]).collect(),
            _ => Arc::clone(&all),
        };
        let candidate = Candidate {
            method,
            form,
            cost,
            basis,
            values,
            error: 0.0,
            worst_frame: 0,
        };
        let mut numbers = candidate.values.iter().flatten();
        if request.channels.contains(&candidate.channels())
            && numbers.all(|value| value.is_finite())
        {
            candidates.push(candidate);
        }
    }
    Ok(candidates)
}

impl<'a> Prices<'a> {
    /// The prices that a plan's request asks for.
    pub fn of(request: &'a PlanRequest) -> Prices<'a> {
        Prices {
            request,
            record: records(request.family.name),
            bounds: Bounds::recorded(),
        }
    }

    fn specialised(&self, method: &Method, subject: &MaterialInMedium) -> Result<Checked, Error> {
        let precision = self.request.precision;
        Ok(specialised_graph(method, subject, precision, &self.bounds)?.function)
    }

    /// The cost of a form of a method, where it is known.
    fn cost(
        &self,
        method: &'static Method,
        form: FunctionForm,
        specialised: &Checked,
    ) -> Option<KnownCost> {
        let (precision, family) = (self.request.precision, self.request.family);
        let known = match form {
            FunctionForm::Specialised => known_cost(specialised, precision, family, &self.record)?,
            _ => known_library_cost(method, form, precision, family, &self.record)?,
        };
        let fetch = self.request.fetch.filter(|_| method.is_textured());
        Some(KnownCost {
            cost: known.cost + fetch.unwrap_or(0.0),
            ..known
        })
    }

    /// The cost of a material's exact law, the reference of every saving.
    ///
    /// # Errors
    /// It cannot be specialised to the material.
    pub fn cost_exact(&self, subject: &MaterialInMedium) -> Result<Option<f64>, Error> {
        let method = methods::find(subject.main_method()).expect("a test names it");
        let function = self.specialised(method, subject)?;
        let known = |form| self.cost(method, form, &function).map(|known| known.cost);
        Ok(known(FunctionForm::Specialised).or_else(|| known(FunctionForm::Library)))
    }
}

/// The values of a function of `cos_theta` in this precision, with the material's table where the function reads one.
fn values(function: &Checked, subject: &MaterialInMedium, precision: Precision) -> Vec<[f64; 3]> {
    match precision {
        Precision::F32 => values_in::<f32>(function, subject),
        Precision::F16 => values_in::<Half>(function, subject),
    }
}

fn values_in<N: Num>(function: &Checked, subject: &MaterialInMedium) -> Vec<[f64; 3]> {
    let table = table_of(function, |cos_theta| subject.reference.at(cos_theta));
    let cosines: Vec<N> = step_cosines().into_iter().map(N::from_f64).collect();
    let count = cosines.len();
    let got = evaluate(function, &arguments(cosines, table.as_ref()));
    let at = |point: usize| {
        let value = got.at(point);
        each_channel(|i| value[i].to_f64())
    };
    (0..count).map(at).collect()
}
