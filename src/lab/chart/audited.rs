//! A user's function as a point of charts, made from its audit rows. It adds one entry, one error for each material, and one cost
//! on each axis.

use std::collections::BTreeMap;

use super::view::{ChartData, ChartEntry, CostAxis, FunctionOrigin, UserFunction};
use crate::generator::fit::MethodErrors;
use crate::lab::audit::AuditRow;
use crate::lab::verify::Status;
use crate::physics::foreign::Foreign;

/// The largest share of cosines without a number. Errors leave those cosines out, and above this share do not describe the
/// function.
const MOST_UNDEFINED: f64 = 0.01;

/// The point, from the rows of all materials. None where there are no rows.
pub fn charted_function(rows: &[AuditRow]) -> Option<ChartedFunction> {
    let first = rows.first()?;
    let file = Foreign(&first.file);
    let about = match &first.device {
        Some(device) => format!("From {file}, run on {device}"),
        None => format!("From {file}"),
    };
    let failing = rows.iter().find(|row| row.status == Status::Fail);
    let fault = |row: &AuditRow| row.reason.clone().unwrap_or_default().replace('\n', "; ");
    Some(ChartedFunction {
        user: UserFunction {
            name: first.function.clone(),
            about,
            fails: failing.map(fault),
            no_cost: no_cost(first),
            input_numbers: first.input_numbers,
        },
        errors: rows.iter().map(errors).collect(),
        costs: costs(rows),
    })
}

/// Why its costs are not comparable with ours: they are those of one channel, or of branches.
fn no_cost(row: &AuditRow) -> Option<String> {
    match (&row.cost_remark, row.channels) {
        (Some(why), _) => Some(format!("its cost is {why}")),
        (None, 1) => Some("its cost is that of one channel".to_owned()),
        _ => None,
    }
}

/// Its error on each axis. None where it was not run, or gives no number too often.
fn errors(row: &AuditRow) -> MethodErrors {
    let (Some(error), Some(perceived)) = (&row.model_error, &row.perceived) else {
        return MethodErrors::default();
    };
    if error.undefined as f64 > MOST_UNDEFINED * row.points.unwrap_or(0) as f64 {
        return MethodErrors::default();
    }
    let known = |figure: f64| Some(figure).filter(|figure| figure.is_finite());
    MethodErrors {
        max_abs: known(error.max_abs),
        mean_rel: error.mean_rel.and_then(known),
        luminance: known(perceived.luminance),
        de2000: known(perceived.de2000),
    }
}

/// The cost on each family where it is known: the largest over materials, since a function of single numbers is called only once
/// where channels are equal.
fn costs(rows: &[AuditRow]) -> BTreeMap<String, f64> {
    let mut costs = BTreeMap::new();
    let rows = rows.iter().filter(|row| no_cost(row).is_none());
    for cost in rows.flat_map(|row| &row.cost) {
        let Some(net) = cost.net else { continue };
        let largest = costs.entry(cost.gpu.to_owned()).or_insert(net);
        *largest = net.max(*largest);
    }
    costs
}

/// A user's function with its errors and costs.
#[derive(Clone, Debug)]
pub struct ChartedFunction {
    /// The function.
    pub user: UserFunction,
    /// The errors for each material. None where it gave no number.
    pub errors: Vec<MethodErrors>,
    /// The cost of an evaluation, by the names of axes.
    pub costs: BTreeMap<String, f64>,
}

impl ChartedFunction {
    /// Appends its errors to those of all others.
    pub fn join(&self, errors: &mut [Vec<MethodErrors>]) {
        for (all, own) in errors.iter_mut().zip(&self.errors) {
            all.push(*own);
        }
    }

    /// The charts with it as their last entry. Its errors have been appended before.
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

    /// Its cost on an axis. A logarithmic axis has no 0, so a function that costs nothing is drawn at one count, or at the least
    /// of ours.
    fn cost(&self, axis: &CostAxis) -> Option<f64> {
        let cost = *self.costs.get(axis.name)?;
        let least = axis.costs.iter().flatten().copied().fold(1.0, f64::min);
        Some(if cost > 0.0 { cost } else { least })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::fit::{ModelError, Perceived};
    use crate::lab::audit::AuditCost;
    use crate::lab::cost::{CostFigures, Counts, find};

    fn cost(gpu: &str, net: Option<f64>) -> AuditCost {
        let counts = |instructions| Counts {
            instructions,
            ..Counts::default()
        };
        let figures = |net| CostFigures {
            net: counts(net),
            ..CostFigures::default()
        };
        let figures = net.map(figures).ok_or_else(String::new);
        AuditCost::new(find(gpu).unwrap(), None, figures)
    }

    fn row(undefined: usize, net: Option<f64>, status: Status) -> AuditRow {
        AuditRow {
            channels: 3,
            points: Some(2000),
            model_error: Some(ModelError {
                max_abs: 0.1,
                mean_abs: 0.0,
                mean_rel: None,
                worst_cos: 0.0,
                undefined,
            }),
            perceived: Some(Perceived {
                luminance: 0.05,
                de2000: 3.0,
            }),
            cost: vec![cost("rdna2", net), cost("gcn4", None)],
            status,
            reason: Some("one\ntwo".to_owned()),
            ..AuditRow::default()
        }
    }

    #[test]
    fn a_point_is_read_from_rows() {
        let known = MethodErrors {
            max_abs: Some(0.1),
            mean_rel: None,
            luminance: Some(0.05),
            de2000: Some(3.0),
        };
        let rows = [
            row(0, Some(20.0), Status::Pass),
            row(1, Some(22.0), Status::Fail),
            row(1000, None, Status::Pass),
        ];
        let own = charted_function(&rows).unwrap();
        assert_eq!(own.errors, [known, known, MethodErrors::default()]);
        assert_eq!(own.costs, BTreeMap::from([("rdna2".to_owned(), 22.0)]));
        assert_eq!(own.user.fails.as_deref(), Some("one; two"));
        assert!(charted_function(&[]).is_none());
    }

    #[test]
    fn what_is_not_comparable_has_no_cost_and_says_why() {
        let branches = AuditRow {
            cost_remark: Some("not compared with ours: it branches".to_owned()),
            ..row(0, Some(20.0), Status::Pass)
        };
        let scalar = AuditRow {
            channels: 1,
            ..row(0, Some(20.0), Status::Pass)
        };
        for (row, says) in [(branches, "it branches"), (scalar, "one channel")] {
            let own = charted_function(&[row]).unwrap();
            assert!(own.costs.is_empty());
            assert!(own.user.no_cost.unwrap().contains(says));
        }
    }
}
