//! A user's function among ours: one entry more, one error more of each material, one cost more on each axis.

use std::collections::BTreeMap;

use crate::generator::fit::MethodErrors;

use super::{ChartData, ChartEntry, CostAxis, FunctionOrigin, UserFunction};

/// What is known of a user's function.
#[derive(Clone, Debug)]
pub struct ChartedFunction {
    /// The function.
    pub user: UserFunction,
    /// For each material the error on each axis; none where it gave no number.
    pub errors: Vec<MethodErrors>,
    /// What an evaluation costs, by the names of axes.
    pub costs: BTreeMap<String, f64>,
}

impl ChartedFunction {
    /// Its errors behind those of all others.
    pub fn join(&self, errors: &mut [Vec<MethodErrors>]) {
        for (all, own) in errors.iter_mut().zip(&self.errors) {
            all.push(*own);
        }
    }

    /// The charts with it as their last entry; its errors have joined already.
    pub fn with_function(&self, mut data: ChartData) -> ChartData {
        for axis in &mut data.costs {
            axis.costs.push(self.cost(axis));
        }
        data.entries.push(ChartEntry {
            function: FunctionOrigin::User(self.user.clone()),
            is_best: false,
            fetches: 0,
        });
        data
    }

    /// An axis in powers of ten has no 0: what costs nothing to the last count costs a count, or as little as any of ours.
    fn cost(&self, axis: &CostAxis) -> Option<f64> {
        let cost = *self.costs.get(axis.name)?;
        let least = axis.costs.iter().flatten().copied().fold(1.0, f64::min);
        Some(if cost > 0.0 { cost } else { least })
    }
}
