//! The shapes that a search tried, with their costs, and how well a choice among them generalises.

use serde::Serialize;

use super::pareto::{CostAndError, pareto_frontier};
use crate::generator::fit::{Candidate, ErrorQuantiles, LeaveOneOut, Tried, TriedShapes, Weight};
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::language::methods::Method;

/// A class of materials that shapes are searched for together.
#[derive(Debug)]
pub struct SearchedClass {
    /// Its name in reports.
    pub name: &'static str,
    /// Its name in full.
    pub title: &'static str,
    classes: &'static [MaterialClass],
}

/// All classes. Metals and semiconductors share their forms.
pub static SEARCHED: [SearchedClass; 3] = [
    SearchedClass {
        name: "metals",
        title: "metals and semiconductors",
        classes: &[MaterialClass::Metals, MaterialClass::Semiconductors],
    },
    SearchedClass {
        name: "dielectrics",
        title: "dielectrics, n of 1.2 and more",
        classes: &[MaterialClass::Dielectrics],
    },
    SearchedClass {
        name: "films",
        title: "materials under films",
        classes: &[MaterialClass::Films],
    },
];

impl SearchedClass {
    /// Whether this material is in the class.
    pub fn holds(&self, material: &MaterialInMedium) -> bool {
        let class = MaterialClass::containing(material);
        class.is_some_and(|class| self.classes.contains(&class))
    }
}

/// The result of a search for a class.
#[derive(Clone, Debug)]
pub struct SearchResult {
    /// The class.
    pub class: &'static SearchedClass,
    /// The number of shapes that were tried.
    pub tried: usize,
    /// The number of measurements that they were tried on.
    pub materials: usize,
    /// The number of substances in these measurements.
    pub substances: usize,
    /// The shapes on the frontier, and those of methods.
    pub shapes: Vec<ShapeRow>,
    /// The choice for each number of coefficients. None where there is nothing to choose by.
    pub choices: Vec<(usize, Option<ChoiceRow>)>,
}

/// A row of the JSON report.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "row", rename_all = "lowercase")]
pub enum SearchRow {
    /// A shape.
    Shape(ShapeRow),
    /// A choice among shapes.
    Choice(ChoiceRow),
}

/// A shape with its errors and its cost.
#[derive(Clone, Debug, Serialize)]
pub struct ShapeRow {
    class: &'static str,
    /// Its number of coefficients.
    pub terms: usize,
    /// The shape in symbols.
    pub shape: String,
    family: &'static str,
    /// The method that has this shape.
    pub method: Option<&'static str>,
    weight: &'static str,
    materials: usize,
    substances: usize,
    /// The operations of its graph.
    pub operations: usize,
    /// The cost of its method's library function, where that is recorded.
    pub cost: Option<f64>,
    /// Whether no shape of fewer operations is as accurate.
    pub is_on_frontier: bool,
    /// Its errors over all measurements.
    pub errors: ErrorQuantiles,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// The shape that is chosen among those with so many coefficients, and its errors on substances left out of the choice.
#[derive(Clone, Debug, Serialize)]
pub struct ChoiceRow {
    class: &'static str,
    /// The number of coefficients.
    pub terms: usize,
    by: &'static str,
    shape: String,
    method: Option<&'static str>,
    /// Its errors on the measurements by which it was chosen.
    pub errors: ErrorQuantiles,
    /// The errors on each substance of the shape that was chosen without it.
    pub errors_left_out: ErrorQuantiles,
    /// The shapes chosen with one substance left out.
    pub chosen: Vec<ChosenShape>,
}

/// A shape that was chosen when one substance was left out.
#[derive(Clone, Debug, Serialize)]
pub struct ChosenShape {
    /// The shape in symbols.
    pub shape: String,
    method: Option<&'static str>,
    /// The number of substances for which it was chosen.
    pub substances: usize,
}

impl SearchResult {
    /// The result from the errors of these shapes. `cost` gives that of a method's library function, where it is recorded.
    pub fn new(
        class: &'static SearchedClass,
        tried: &TriedShapes,
        terms: &[usize],
        weight: Weight,
        cost: &dyn Fn(&'static Method) -> Option<f64>,
    ) -> SearchResult {
        let choice = |terms: &usize| {
            let left_out = tried.leave_one_out(*terms);
            let choice = left_out.map(|left_out| ChoiceRow::new(class, *terms, &left_out));
            (*terms, choice)
        };
        SearchResult {
            class,
            tried: tried.tried.len(),
            materials: tried.substances.len(),
            substances: tried.substance_count(),
            shapes: best_shapes(class, tried, weight, cost),
            choices: terms.iter().map(choice).collect(),
        }
    }

    /// The rows of the JSON report: shapes first, choices after.
    pub fn search_rows(&self) -> impl Iterator<Item = SearchRow> {
        let choices = self.choices.iter().filter_map(|(_, choice)| choice.clone());
        let shapes = self.shapes.iter().cloned().map(SearchRow::Shape);
        shapes.chain(choices.map(SearchRow::Choice))
    }
}

/// The shapes on the frontier of operations and 90th percentile, and those of methods, the fewest operations first.
fn best_shapes(
    class: &'static SearchedClass,
    tried: &TriedShapes,
    weight: Weight,
    cost: &dyn Fn(&'static Method) -> Option<f64>,
) -> Vec<ShapeRow> {
    let row = |shape: &Tried| {
        let cost = shape.candidate.method.and_then(cost);
        ShapeRow::new(class, tried, shape, weight, cost)
    };
    let mut rows: Vec<ShapeRow> = tried.tried.iter().map(row).collect();
    let point = |row: &ShapeRow| {
        Some(CostAndError {
            cost: row.operations as f64,
            error: row.errors.p90,
        })
    };
    let points: Vec<_> = rows.iter().map(point).collect();
    for place in pareto_frontier(&points) {
        rows[place].is_on_frontier = true;
    }
    rows.retain(|row| row.is_on_frontier || row.method.is_some());
    let order = |a: &ShapeRow, b: &ShapeRow| a.errors.p90.total_cmp(&b.errors.p90);
    rows.sort_by(|a, b| a.operations.cmp(&b.operations).then(order(a, b)));
    rows
}

impl ShapeRow {
    fn new(
        class: &'static SearchedClass,
        all: &TriedShapes,
        tried: &Tried,
        weight: Weight,
        cost: Option<f64>,
    ) -> ShapeRow {
        let candidate = &tried.candidate;
        ShapeRow {
            class: class.name,
            terms: candidate.shape.terms(),
            shape: candidate.shape.to_string(),
            family: candidate.family,
            method: method_name(candidate),
            weight: weight.name(),
            materials: all.substances.len(),
            substances: all.substance_count(),
            operations: candidate.operations(),
            cost,
            is_on_frontier: false,
            errors: ErrorQuantiles::new(&tried.errors, &all.substances),
            reason: cost.is_none().then_some("its cost is not recorded there"),
        }
    }
}

impl ChoiceRow {
    fn new(class: &'static SearchedClass, terms: usize, left_out: &LeaveOneOut) -> ChoiceRow {
        let chosen = |(candidate, substances): &(Candidate, usize)| ChosenShape {
            shape: candidate.shape.to_string(),
            method: method_name(candidate),
            substances: *substances,
        };
        ChoiceRow {
            class: class.name,
            terms,
            by: "p90 over the measurements of all other substances",
            shape: left_out.choice.shape.to_string(),
            method: method_name(&left_out.choice),
            errors: left_out.seen,
            errors_left_out: left_out.unseen,
            chosen: left_out.chosen.iter().map(chosen).collect(),
        }
    }
}

fn method_name(candidate: &Candidate) -> Option<&'static str> {
    candidate.method.map(|method| method.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::fit::candidates;

    #[test]
    fn what_is_beaten_is_left_out_unless_it_is_shipped() {
        let tried = candidates(4).into_iter().zip([1.0, 2.0]);
        let tried = tried.map(|(candidate, error)| Tried {
            candidate,
            errors: vec![error],
        });
        let tried = TriedShapes {
            substances: vec!["gold".to_owned()],
            tried: tried.collect(),
        };
        let rows = best_shapes(&SEARCHED[0], &tried, Weight::default(), &|_| None);
        assert!(rows.iter().any(|row| row.is_on_frontier));
        assert!(rows.is_sorted_by_key(|row| row.operations));
    }
}
