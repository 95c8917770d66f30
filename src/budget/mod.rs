//! The budget: the one cheapest function of each material that errs no more than it may, on the recorded costs of a family of GPUs.
//! Pure: nothing is measured here.

mod choice;
mod error;
mod spread;
mod text;

use std::collections::BTreeMap;

use crate::cost::{CostRecord, Family, GpuCompiler, function_cost, library_cost, records};
use crate::emit::{Bounds, specialised_graph};
use crate::fit::single_error;
use crate::ir::Checked;
use crate::materials::{self, Material, ViewingConditions};
use crate::methods::{Contract, Light, Method};
use crate::num::{Precision, in_parallel};
use crate::reference::MaterialInMedium;

use choice::{BudgetCandidate, cheapest, nearest};

pub use error::Error;
use spread::spread;
use text::CostBasis;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    most: f64,
    family: &'static Family,
}

impl Budget {
    /// The largest error of reflectance, over angles and channels, and the GPUs whose costs decide.
    ///
    /// # Errors
    /// It is no error of reflectance, or no costs are recorded of these GPUs.
    pub fn new(most: f64, family: &'static Family) -> Result<Budget, Error> {
        if !(most > 0.0 && most.is_finite()) {
            return Err(Error::OutOfRange { most });
        }
        if let GpuCompiler::None(reason) = family.compiler {
            let gpu = family.name;
            return Err(Error::NoCosts { gpu, reason });
        }
        Ok(Budget { most, family })
    }
}

/// The method of each material, by the material's name, and what is said of each choice.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BudgetChoice {
    /// The methods.
    pub methods: BTreeMap<String, &'static str>,
    /// A sentence or two each.
    pub remarks: Vec<String>,
}

/// Chooses one of these methods for each material.
///
/// # Errors
/// None of the methods is for unpolarised light and keeps the contract, or a material has no function within the budget.
pub fn choose_within(
    budget: Budget,
    methods: Vec<&'static Method>,
    subjects: &[MaterialInMedium],
    sight: &ViewingConditions,
) -> Result<BudgetChoice, Error> {
    let search = Search {
        methods: candidate_methods(methods)?,
        catalogue: materials::list().map_err(Error::Material)?,
        record: records(budget.family.name),
        bounds: Bounds::recorded(),
        sight,
        budget,
    };
    let choose = |i: usize| search.choice_for(&subjects[i]);
    let found = in_parallel(subjects.len(), &choose, &mut |_, _| {});
    let (mut choice, mut faults) = (BudgetChoice::default(), Vec::new());
    for (subject, found) in subjects.iter().zip(found) {
        match found? {
            Ok((method, remarks)) => {
                choice.methods.insert(subject.name.clone(), method);
                choice.remarks.extend(remarks);
            }
            Err(why) => faults.push(why),
        }
    }
    if faults.is_empty() {
        return Ok(choice);
    }
    let most = budget.most;
    Err(Error::NothingWithin { most, faults })
}

/// The methods among which a budget chooses: those for unpolarised light that keep the contract.
fn candidate_methods(mut methods: Vec<&'static Method>) -> Result<Vec<&'static Method>, Error> {
    methods
        .retain(|method| method.light == Light::Unpolarised && method.contract == Contract::Kept);
    match methods.is_empty() {
        true => Err(Error::NoMethod),
        false => Ok(methods),
    }
}

/// What is the same for all materials.
struct Search<'a> {
    sight: &'a ViewingConditions,
    budget: Budget,
    methods: Vec<&'static Method>,
    catalogue: Vec<Material>,
    record: CostRecord,
    bounds: Bounds,
}

/// A material's method with what is said of it, or why it has none.
type Found = Result<(&'static str, Vec<String>), String>;

impl Search<'_> {
    fn choice_for(&self, subject: &MaterialInMedium) -> Result<Found, Error> {
        let (candidates, form) = self.candidates(subject)?;
        let family = self.budget.family;
        let Some(choice) = cheapest(&candidates, self.budget.most) else {
            let best = nearest(candidates.iter());
            return Ok(Err(text::no_choice(&subject.name, best.as_ref(), family)));
        };
        let spread = spread(subject, &self.catalogue, self.sight);
        let measured = CostBasis { family, form };
        let lines =
            text::choice_remarks(&subject.name, &choice, spread, self.budget.most, measured);
        Ok(Ok((choice.chosen.method, lines)))
    }

    /// The functions that could be taken, and the form whose costs are theirs: the specialised one's where all are recorded, else
    /// the library's, since costs of two forms cannot be compared.
    fn candidates(
        &self,
        subject: &MaterialInMedium,
    ) -> Result<(Vec<BudgetCandidate>, &'static str), Error> {
        let methods = self.methods.iter().copied();
        let functions = methods
            .filter(|method| subject.is_described_by(method))
            .map(|method| Ok((method, self.function(method, subject)?)))
            .collect::<Result<Vec<(&'static Method, Checked)>, Error>>()?;
        let own = |(_, function): &(_, Checked)| {
            function_cost(function, self.budget.family, &self.record)
        };
        let specialised: Option<Vec<f64>> = functions.iter().map(own).collect();
        let library = |method| library_cost(method, self.budget.family, &self.record);
        let (costs, form): (Vec<Option<f64>>, _) = match specialised {
            Some(costs) => (costs.into_iter().map(Some).collect(), "specialised"),
            None => (
                functions
                    .iter()
                    .map(|(method, _)| library(method))
                    .collect(),
                "library",
            ),
        };
        let candidate = |((method, function), cost): (&(&'static Method, Checked), Option<f64>)| {
            let error = single_error(function, &subject.truth_for(method));
            Some(BudgetCandidate {
                method: method.name,
                error: error.max_abs,
                cost: cost.filter(|_| error.undefined == 0)?,
                is_textured: method.is_textured(),
            })
        };
        Ok((
            functions.iter().zip(costs).filter_map(candidate).collect(),
            form,
        ))
    }

    fn function(&self, method: &Method, subject: &MaterialInMedium) -> Result<Checked, Error> {
        let made = specialised_graph(method, subject, Precision::F32, &self.bounds)?;
        Ok(made.function)
    }
}
