//! Our methods for the same material: their errors in single precision, and their costs.

use super::comparison::{Competitor, is_comparable};
use super::error::Error;
use crate::generator::emit::FunctionForm;
use crate::generator::fit::{error_of, values_for_material};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{
    CostAndError, CostFigures, CostedFunction, Family, FamilyAnswers, FunctionId, ask_compilers,
    cost_rows, functions, input_numbers, records,
};
use crate::lab::process::{Pool, Surroundings};
use crate::language::ir::{Checked, Column, Value, evaluate};
use crate::language::methods::{self, Input, InputSource, Method, find_input};
use crate::physics::num::{Precision, each_channel};

/// A method with its error, and its cost on each family where it is known.
#[derive(Clone, Debug)]
pub struct Ours {
    method: &'static str,
    form: &'static str,
    inputs: usize,
    error: f64,
    costs: Vec<Option<f64>>,
}

impl Ours {
    /// As a competitor of a user's function that has these inputs of our methods, on the family with this index.
    pub fn competitor(&self, place: usize, had: &[&str]) -> Option<Competitor> {
        let (cost, error) = (self.costs[place]?, self.error);
        Some(Competitor {
            method: self.method,
            form: self.form,
            inputs: self.inputs,
            is_foreign: self.inputs > 0 && takes_others(self.method, had),
            point: CostAndError { cost, error },
        })
    }
}

/// Whether a method takes a number that does not follow from these. All numbers of a material follow from its index and from what was
/// fitted to its spectrum, and F82 from its tint.
fn takes_others(method: &str, had: &[&str]) -> bool {
    let says_all = |name: &&str| {
        let is_fitted = |input: &Input| matches!(input.source, InputSource::Fit);
        ["eta", "n"].contains(name) || find_input(name).is_some_and(is_fitted)
    };
    if had.is_empty() || had.iter().any(says_all) {
        return false;
    }
    let follows = |input: &Input| {
        let same = match input.name {
            "f82" => "tint",
            "tint" => "f82",
            name => name,
        };
        had.iter().any(|name| [input.name, same].contains(name))
    };
    methods::find(method).is_some_and(|method| !method.inputs.iter().all(follows))
}

/// The methods that can replace a user's function, with their costs, for all materials.
#[derive(Debug)]
pub struct CostedMethods {
    form: FunctionForm,
    functions: Vec<CostedFunction>,
    /// The cost of each requested function on each family.
    costs: Vec<Vec<Option<f64>>>,
}

impl CostedMethods {
    /// The methods' functions of this form. Specialised ones are specialised to these materials.
    ///
    /// # Errors
    /// No process can be started.
    pub fn ask(
        form: FunctionForm,
        subjects: &[MaterialInMedium],
        families: &[&'static Family],
        pool: Pool,
        surroundings: &Surroundings,
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<CostedMethods, Error> {
        let methods = methods::ALL.iter().copied();
        let methods: Vec<&'static Method> = methods.filter(|one| is_comparable(one)).collect();
        let subjects = match form {
            FunctionForm::Specialised => subjects,
            _ => &[],
        };
        let mut all = functions(&methods, subjects, &[Precision::F32])?;
        all.retain(|function| {
            function.is_asked && function.id.form == form || function.is_reference()
        });
        let answers = ask_compilers(families, &all, &|_, _| true, pool, surroundings, progress)?;
        let each = families.iter().zip(&answers);
        let costs = each
            .map(|(family, answers)| costs(family, answers.as_ref(), &all))
            .collect();
        all.retain(|function| function.is_asked);
        Ok(CostedMethods {
            form,
            functions: all,
            costs,
        })
    }

    /// The methods for a material that take at most so many numbers.
    pub fn for_material(&self, subject: &MaterialInMedium, max_inputs: Option<usize>) -> Vec<Ours> {
        let is_of = |id: &FunctionId, method: &Method| match &id.material {
            Some(material) => *material == subject.argument,
            None => subject.is_described_by(method),
        };
        let is_allowed = |inputs: usize| max_inputs.is_none_or(|most| inputs <= most);
        let each = self.functions.iter().enumerate();
        let ours = |(place, function): (usize, &CostedFunction)| {
            let method = function.id.method?;
            let inputs = inputs(self.form, method);
            let is_one = function.id.form == self.form && is_of(&function.id, method);
            (is_one && is_allowed(inputs)).then(|| Ours {
                method: method.name,
                form: self.form.name(),
                inputs,
                error: error(function, method, subject),
                costs: self.costs.iter().map(|column| column[place]).collect(),
            })
        };
        each.filter_map(ours).collect()
    }
}

/// How many numbers a call takes. A specialised function takes none.
fn inputs(form: FunctionForm, method: &Method) -> usize {
    match form {
        FunctionForm::Specialised => 0,
        _ => input_numbers(method),
    }
}

/// The cost of each requested function, in order.
fn costs(
    family: &'static Family,
    answers: Option<&FamilyAnswers>,
    functions: &[CostedFunction],
) -> Vec<Option<f64>> {
    let rows = cost_rows(family, answers, &records(family.name), functions);
    let cost = |figures: Result<CostFigures, String>| figures.ok().map(|figures| figures.cost());
    rows.into_iter().map(|row| cost(row.figures)).collect()
}

/// The largest error in single precision, measured as for a user's function. A form of one channel is evaluated for each channel.
fn error(function: &CostedFunction, method: &Method, subject: &MaterialInMedium) -> f64 {
    let (graph, others): (Checked, Vec<Value<f32>>) = match function.id.form {
        FunctionForm::Specialised => (function.graph.clone(), Vec::new()),
        _ => (
            method.function(false).expect("a test builds every method"),
            method.arguments(&values_for_material(subject, method), None),
        ),
    };
    let error = error_of(&subject.reference, &|cosines| {
        let mut arguments = vec![Value::each(cosines.iter().map(|c| *c as f32).collect())];
        arguments.extend(others.iter().cloned());
        let got = evaluate(&graph, &arguments);
        Value::Rgb(each_channel(|i| {
            let column = got.channel(i);
            let points = 0..cosines.len();
            Column::Each(points.map(|point| f64::from(column.at(point))).collect())
        }))
    });
    error.max_abs
}
