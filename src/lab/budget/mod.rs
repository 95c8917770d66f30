//! The budget: for each material the cheapest function whose error is within a limit, by the recorded costs of a family of GPUs.
//! Pure: nothing is measured here.

mod choice;

use crate::generator::emit::{Bounds, FunctionForm, specialised_graph};
use crate::generator::fit::single_error;
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::{
    CostAndError, CostRecord, Family, GpuCompiler, function_cost, library_cost, records,
};
use crate::language::ir::Checked;
use crate::language::methods::{Contract, Light, Method};
use crate::physics::materials::{self, Material, ViewingConditions};
use crate::physics::num::{Precision, in_parallel};
use choice::{CheapestFunction, cheapest, most_accurate, spread};

pub use choice::{BudgetCandidate, Error, NoFunction, Spread, rounded_error};

/// The request: an error and a family of GPUs.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// The largest error of reflectance, over angles and channels.
    pub max_error: f64,
    /// The GPUs whose recorded costs decide.
    pub family: &'static Family,
}

impl Budget {
    /// A budget of this error on these GPUs.
    ///
    /// # Errors
    /// The error is not a positive number, or no costs are recorded for these GPUs.
    pub fn new(max_error: f64, family: &'static Family) -> Result<Budget, Error> {
        if !(max_error > 0.0 && max_error.is_finite()) {
            return Err(Error::OutOfRange { max_error });
        }
        if let GpuCompiler::None(reason) = family.compiler {
            let gpu = family.name;
            return Err(Error::NoCosts { gpu, reason });
        }
        Ok(Budget { max_error, family })
    }
}

/// The function that is chosen for a material.
#[derive(Clone, Debug)]
pub struct BudgetRow {
    /// The material's name.
    pub material: String,
    /// The request.
    pub budget: Budget,
    /// The function, and alternatives to it.
    pub choice: CheapestFunction,
    /// The form whose costs decided: `specialised`, or `library` where the record lacks a specialised function of the material.
    pub form: FunctionForm,
    /// How far published measurements of the material differ, where that is known.
    pub spread: Option<Spread>,
}

/// Chooses one of these methods for each material.
///
/// # Errors
/// None of the methods is for unpolarised light and keeps the contract, or a material has no function within the budget.
pub fn choose_within(
    budget: Budget,
    methods: Vec<&'static Method>,
    described: &[MaterialInMedium],
    viewing: &ViewingConditions,
) -> Result<Vec<BudgetRow>, Error> {
    let search = Search {
        methods: candidate_methods(methods)?,
        catalogue: materials::list().map_err(Error::Material)?,
        record: records(budget.family.name),
        bounds: Bounds::recorded(),
        viewing,
        budget,
    };
    let choose = |i: usize| search.choice_for(&described[i]);
    let found = in_parallel(described.len(), &choose, &mut |_, _| {});
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    for row in found {
        match row? {
            Ok(row) => rows.push(row),
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() {
        return Ok(rows);
    }
    let max_error = budget.max_error;
    Err(Error::NothingWithin { max_error, faults })
}

/// Whether budgets and plans may choose a method: it must describe unpolarised light and keep the contract.
pub fn is_choosable(method: &Method) -> bool {
    method.light == Light::Unpolarised
        && method.contract == Contract::Kept
        && !method.keeps_inputs()
}

/// The methods among which a budget chooses.
fn candidate_methods(mut methods: Vec<&'static Method>) -> Result<Vec<&'static Method>, Error> {
    methods.retain(|method| is_choosable(method));
    if methods.is_empty() {
        Err(Error::NoMethod)
    } else {
        Ok(methods)
    }
}

/// The parts of the search that are the same for all materials.
struct Search<'a> {
    viewing: &'a ViewingConditions,
    budget: Budget,
    methods: Vec<&'static Method>,
    catalogue: Vec<Material>,
    record: CostRecord,
    bounds: Bounds,
}

impl Search<'_> {
    fn choice_for(
        &self,
        material: &MaterialInMedium,
    ) -> Result<Result<BudgetRow, NoFunction>, Error> {
        let (candidates, form) = self.candidates(material)?;
        let Some(choice) = cheapest(&candidates, self.budget.max_error) else {
            return Ok(Err(NoFunction {
                material: material.name.clone(),
                gpu: self.budget.family.name,
                best: most_accurate(candidates.iter()),
            }));
        };
        Ok(Ok(BudgetRow {
            material: material.name.clone(),
            budget: self.budget,
            choice,
            form,
            spread: spread(material, &self.catalogue, self.viewing),
        }))
    }

    /// The candidates, and the form that their costs are of: the specialised one where all are recorded, otherwise the library's,
    /// since costs of two forms cannot be compared.
    fn candidates(
        &self,
        material: &MaterialInMedium,
    ) -> Result<(Vec<BudgetCandidate>, FunctionForm), Error> {
        let Search { budget, record, .. } = self;
        let mut functions = Vec::new();
        for method in self.methods.iter().copied() {
            if material.is_described_by(method) {
                let made = specialised_graph(method, material, Precision::F32, &self.bounds)?;
                let cost = function_cost(&made.function, Precision::F32, budget.family, record);
                functions.push((method, made.function, cost));
            }
        }
        let form = if functions.iter().all(|(_, _, cost)| cost.is_some()) {
            FunctionForm::Specialised
        } else {
            FunctionForm::Library
        };
        let candidate = |(method, function, cost): (&'static Method, Checked, Option<f64>)| {
            let error = single_error(&function, &material.truth_for(method));
            let cost = match form {
                FunctionForm::Specialised => cost,
                _ => library_cost(method, budget.family, record),
            };
            Some(BudgetCandidate {
                method,
                point: CostAndError {
                    cost: cost.filter(|_| error.undefined == 0)?,
                    error: error.max_abs,
                },
            })
        };
        let candidates = functions.into_iter().filter_map(candidate).collect();
        Ok((candidates, form))
    }
}
