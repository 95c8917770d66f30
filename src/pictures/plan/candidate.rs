//! The functions among which a plan chooses for a material: each method, in each form whose cost is known.

use std::sync::Arc;

use super::curve::step_cosines;
use super::request::PlanRequest;
use crate::generator::emit::{Bounds, Error, FunctionForm, specialised_graph};
use crate::generator::fit::{arguments, table_of};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{
    CostBasis, CostRecord, Family, KnownCost, known_cost, known_library_cost, records,
};
use crate::language::ir::{Checked, evaluate};
use crate::language::methods::{Contract, Light, Method};
use crate::physics::num::{Half, Num, Precision, each_channel, in_parallel};

/// What functions cost, and which of them may be chosen.
pub struct Prices<'a> {
    /// The GPU family.
    pub family: &'static Family,
    /// The recorded costs on these GPUs.
    pub record: CostRecord,
    /// The recorded bounds of functions.
    pub bounds: Bounds,
    /// The precision that functions compute in.
    pub precision: Precision,
    /// How many channels functions may return: 3, or 1 for all three alike.
    pub channels: &'a [usize],
    /// The cost of a texture fetch, beside that of the instructions around it. Without it no table is chosen.
    pub fetch: Option<f64>,
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

    /// How many channels it returns.
    pub fn channels(&self) -> usize {
        match self.form {
            FunctionForm::Scalar => 1,
            _ => 3,
        }
    }
}

/// Whether plans may choose a method: it must describe unpolarised light and keep the contract.
pub fn is_plannable(method: &Method) -> bool {
    method.light == Light::Unpolarised && method.contract == Contract::Kept
}

/// The candidates for a material, in the order of methods. `is_library_only` means that the material has no file to specialise
/// to.
///
/// # Errors
/// A method cannot be specialised to the material.
pub fn candidates(
    subject: &MaterialInMedium,
    is_library_only: bool,
    methods: &[&'static Method],
    prices: &Prices,
) -> Result<Vec<Candidate>, Error> {
    let is_one = |method: &&&'static Method| {
        is_plannable(method)
            && subject.is_described_by(method)
            && (prices.fetch.is_some() || !method.is_textured())
            && !(prices.precision.is_half() && method.half.refusal().is_some())
    };
    let methods: Vec<&'static Method> = methods.iter().filter(is_one).copied().collect();
    let of_method = |i: usize| {
        let method = methods[i];
        let function =
            specialised_graph(method, subject, prices.precision, &prices.bounds)?.function;
        let values: Arc<[_]> = values(&function, subject, prices.precision).into();
        let forms = [
            FunctionForm::Specialised,
            FunctionForm::Library,
            FunctionForm::Scalar,
        ];
        let forms = forms
            .into_iter()
            .filter(|form| !is_library_only || *form != FunctionForm::Specialised);
        let candidate = |form: FunctionForm| {
            let KnownCost { cost, basis } = prices.cost(method, form, &function)?;
            let values = match form {
                FunctionForm::Scalar => values.iter().map(|value| [value[1]; 3]).collect(),
                _ => Arc::clone(&values),
            };
            let found = Candidate {
                method,
                form,
                cost,
                basis,
                values,
            };
            prices.channels.contains(&found.channels()).then_some(found)
        };
        Ok(forms.filter_map(candidate).collect())
    };
    let found: Vec<Result<Vec<Candidate>, Error>> =
        in_parallel(methods.len(), &of_method, &mut |_, _| {});
    let found = found.into_iter().collect::<Result<Vec<_>, Error>>()?;
    let is_number = |one: &Candidate| one.values.iter().flatten().all(|value| value.is_finite());
    Ok(found.into_iter().flatten().filter(is_number).collect())
}

impl Prices<'_> {
    /// The prices that a plan's request asks for.
    pub fn of(request: &PlanRequest) -> Prices<'_> {
        Prices {
            family: request.family,
            record: records(request.family.name),
            bounds: Bounds::recorded(),
            precision: request.precision,
            channels: &request.channels,
            fetch: request.fetch,
        }
    }

    /// The cost of a form of a method, where it is known.
    fn cost(
        &self,
        method: &'static Method,
        form: FunctionForm,
        specialised: &Checked,
    ) -> Option<KnownCost> {
        let known = match form {
            FunctionForm::Specialised => {
                known_cost(specialised, self.precision, self.family, &self.record)?
            }
            _ => known_library_cost(method, form, self.precision, self.family, &self.record)?,
        };
        let fetch = self.fetch.filter(|_| method.is_textured());
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
        let method =
            crate::language::methods::find(subject.exact_method()).expect("a test names it");
        let function = specialised_graph(method, subject, self.precision, &self.bounds)?.function;
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
