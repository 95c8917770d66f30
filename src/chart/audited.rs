//! A user's function as a point of charts, from its rows.

use std::collections::BTreeMap;

use super::{ChartedFunction, UserFunction};
use crate::audit::AuditRow;
use crate::fit::MethodErrors;
use crate::verify::Status;

/// Errors leave out cosines at which it gives no number. Above this share they are no longer those of the function.
const MOST_UNDEFINED: f64 = 0.01;

/// The point, from the rows of all materials; none where there are no rows.
pub fn charted_function(rows: &[AuditRow]) -> Option<ChartedFunction> {
    let first = rows.first()?;
    let about = match &first.device {
        Some(device) => format!("From {}, run on {device}", first.file),
        None => format!("From {}", first.file),
    };
    let failing = rows.iter().find(|row| row.status == Status::Fail);
    let fault = |row: &AuditRow| row.reason.clone().unwrap_or_default().replace('\n', "; ");
    Some(ChartedFunction {
        user: UserFunction {
            name: first.function.clone(),
            about,
            fails: failing.map(fault),
        },
        errors: rows.iter().map(errors).collect(),
        costs: costs(rows),
    })
}

/// Its error on each axis; none where it was not run, or gives no number too often.
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

/// The cost on each family where it is known: of materials, the most. A function of single numbers is called once where channels
/// are the same.
fn costs(rows: &[AuditRow]) -> BTreeMap<String, f64> {
    let mut costs = BTreeMap::new();
    for cost in rows.iter().flat_map(|row| &row.cost) {
        let Ok(figures) = &cost.figures else { continue };
        let net = figures.cost();
        let most = costs.entry(cost.family.name.to_owned()).or_insert(net);
        *most = net.max(*most);
    }
    costs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{AuditCost, PerceivedFigures};
    use crate::cost::{CostFigures, Counts, find};
    use crate::fit::ModelError;

    fn cost(gpu: &str, net: Option<f64>) -> AuditCost {
        let counts = |instructions| Counts {
            instructions,
            ..Counts::default()
        };
        let figures = |net| CostFigures {
            net: counts(net),
            ..CostFigures::default()
        };
        AuditCost {
            family: find(gpu).unwrap(),
            compiler: None,
            figures: net.map(figures).ok_or_else(String::new),
        }
    }

    fn row(undefined: usize, net: Option<f64>, status: Status) -> AuditRow {
        AuditRow {
            target: "wgsl",
            method: "f".to_owned(),
            material: "gold".to_owned(),
            form: "user",
            precision: "f32",
            function: "f".to_owned(),
            file: "f.wgsl".to_owned(),
            arguments: Vec::new(),
            filled: Vec::new(),
            device: Some("a device".to_owned()),
            points: Some(2000),
            code_error: None,
            code_error_reason: "",
            model_error: Some(ModelError {
                max_abs: 0.1,
                mean_abs: 0.0,
                mean_rel: None,
                worst_cos: 0.0,
                undefined,
            }),
            perceived: Some(PerceivedFigures {
                luminance: 0.05,
                de2000: 3.0,
            }),
            accepts: Vec::new(),
            edges: None,
            beyond: None,
            cost: vec![cost("rdna2", net), cost("gcn4", None)],
            dominated_by: Vec::new(),
            says: Vec::new(),
            status,
            reason: Some("one\ntwo".to_owned()),
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
}
