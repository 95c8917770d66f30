//! Our methods for the same material: their errors in single precision, and their costs.

use crate::cost::{
    CostAndError, CostFigures, CostedFunction, Family, FamilyAnswers, ask_compilers, cost_rows,
    functions, records,
};
use crate::emit::FunctionForm;
use crate::fit::{error_of, values_for_material};
use crate::ir::{Column, Value, evaluate};
use crate::methods::{self, Contract, Light, Method};
use crate::num::{Precision, each_channel};
use crate::process::{Pool, Surroundings};
use crate::reference::MaterialInMedium;

use super::comparison::Competitor;
use super::error::Error;

/// A method with its error, and its cost on each family where it is known.
#[derive(Clone, Debug)]
pub struct Ours {
    method: &'static str,
    form: &'static str,
    error: f64,
    costs: Vec<Option<f64>>,
}

impl Ours {
    /// As it stands against a function on the family of this place.
    pub fn competitor(&self, place: usize) -> Option<Competitor> {
        let (cost, error) = (self.costs[place]?, self.error);
        Some(Competitor {
            method: self.method,
            form: self.form,
            point: CostAndError { cost, error },
        })
    }
}

/// The methods that can replace a user's function for a material: in their library form where it takes arguments, else
/// specialised. Methods that read a texture are left out, because counts do not include the fetch; so are those for one
/// polarisation, because they compute something else.
///
/// # Errors
/// No process can be started.
pub fn ours(
    subject: &MaterialInMedium,
    takes_arguments: bool,
    families: &[&'static Family],
    pool: Pool,
    surroundings: &Surroundings,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Ours>, Error> {
    let form = match takes_arguments {
        true => FunctionForm::Library,
        false => FunctionForm::Specialised,
    };
    let fits = |method: &&&'static Method| {
        subject.is_described_by(method)
            && method.light == Light::Unpolarised
            && method.contract == Contract::Kept
            && !method.is_textured()
    };
    let methods: Vec<&'static Method> = methods::ALL.iter().filter(fits).copied().collect();
    let mut all = functions(&methods, std::slice::from_ref(subject), &[Precision::F32])?;
    all.retain(|function| function.is_asked && function.form == form || function.is_reference());
    let answers = ask_compilers(families, &all, pool, surroundings, progress)?;
    let each = families.iter().zip(&answers);
    let columns: Vec<Vec<Option<f64>>> = each
        .map(|(family, answers)| costs(family, answers.as_ref(), &all))
        .collect();
    let asked = all.iter().filter(|function| function.is_asked).enumerate();
    Ok(asked
        .filter(|(_, function)| function.form == form)
        .map(|(place, function)| Ours {
            method: function.method.name,
            form: form.name(),
            error: error(function, subject),
            costs: columns.iter().map(|column| column[place]).collect(),
        })
        .collect())
}

/// The cost of each function that was asked for, in order.
fn costs(
    family: &'static Family,
    answers: Option<&FamilyAnswers>,
    functions: &[CostedFunction],
) -> Vec<Option<f64>> {
    let rows = cost_rows(family, answers, &records(family.name), functions);
    let cost = |figures: Result<CostFigures, String>| figures.ok().map(|figures| figures.cost());
    rows.into_iter().map(|row| cost(row.figures)).collect()
}

/// The largest error in single precision, as a user's function has it.
fn error(function: &CostedFunction, subject: &MaterialInMedium) -> f64 {
    let others: Vec<Value<f32>> = match function.form {
        FunctionForm::Library => function
            .method
            .arguments(&values_for_material(subject, function.method), None),
        _ => Vec::new(),
    };
    let error = error_of(&subject.reference, &|cosines| {
        let single = cosines.iter().map(|c| *c as f32).collect();
        let arguments: Vec<Value<f32>> = [Value::each(single)]
            .into_iter()
            .chain(others.clone())
            .collect();
        let got = evaluate(&function.graph, &arguments);
        let channel = |i: usize| {
            let column = got.channel(i);
            Column::Each(
                (0..cosines.len())
                    .map(|point| f64::from(column.at(point)))
                    .collect(),
            )
        };
        Value::Rgb(each_channel(channel))
    });
    error.max_abs
}
