//! The errors of a material's candidates in the pixels of a frame.
//!
//! Candidates are judged with the cheapest first. What costs more than a candidate within the budget cannot be chosen, and no
//! report states its error. So it is not judged, and its error is infinite.

use super::candidate::Candidate;
use super::curve::{Curve, PixelPlace, RoughRule, curves};
use super::frame::ScenePixel;
use super::metric::{ErrorOf, JudgedPixels, Screen};
use super::request::PlanRequest;
use crate::physics::num::in_parallel;

/// Functions that are judged together. With three channels each they fill two blocks of columns.
const TOGETHER: usize = 5;
/// Errors are compared and printed in this many parts of 1. The rounding of single precision is far below that.
const ERROR_PARTS: f64 = 1e4;

/// What judging all candidates of all materials has in common.
pub struct Judge<'a> {
    request: &'a PlanRequest,
    rule: RoughRule,
    screen: Screen,
    /// In stops.
    exposures: Vec<f64>,
}

impl<'a> Judge<'a> {
    /// The judge of a plan's request.
    pub fn new(request: &'a PlanRequest) -> Judge<'a> {
        Judge {
            request,
            rule: RoughRule::new(),
            screen: request.screen(),
            exposures: request.exposures(),
        }
    }

    /// The errors of candidates in some pixels. `truth` has the values of the exact law. After the last pixels of a material, a
    /// candidate within the budget makes it needless to judge those that cost more.
    pub fn errors(
        &self,
        candidates: &[Candidate],
        truth: &[[f64; 3]],
        pixels: &[ScenePixel],
        is_last: bool,
        error_of: ErrorOf,
    ) -> Vec<f64> {
        let places: Vec<PixelPlace> = pixels.iter().map(PixelPlace::of).collect();
        let truth = Curve::new(truth, &places, &self.rule);
        let exact = |pixel: usize| truth.at(&places[pixel]);
        let pixels = JudgedPixels::new(pixels, &self.screen, &self.exposures, exact);
        let mut errors = vec![f64::INFINITY; candidates.len()];
        let mut enough = f64::INFINITY;
        for batch in distinct_functions(candidates).chunks(TOGETHER) {
            if batch[0].cost > enough {
                break;
            }
            let functions: Vec<&[[f64; 3]]> = batch.iter().map(|one| one.values).collect();
            let curves = curves(&functions, &places, &self.rule);
            let error = |i: usize| pixels.error(error_of, |pixel| curves[i].at(&places[pixel]));
            let found = in_parallel(batch.len(), &error, &mut |_, _| {});
            for (function, error) in batch.iter().zip(found) {
                for i in &function.candidates {
                    errors[*i] = error;
                    let candidate = &candidates[*i];
                    if is_last && self.is_enough(error.max(candidate.error)) {
                        enough = enough.min(candidate.cost);
                    }
                }
            }
        }
        errors
    }

    /// Whether a candidate with this error makes it needless to judge those that cost more. This holds only where functions have
    /// no price: with a price, a more expensive one may pay off by being shared.
    fn is_enough(&self, error: f64) -> bool {
        self.request.price == 0.0 && rounded_error(error) <= self.request.budget
    }
}

/// An error rounded as it is compared and printed.
pub fn rounded_error(error: f64) -> f64 {
    (error * ERROR_PARTS).round() / ERROR_PARTS
}

/// The values that one or several candidates have, such as the forms of a method. They are judged once.
pub(super) struct DistinctFunction<'a> {
    pub values: &'a [[f64; 3]],
    /// The indices of these candidates.
    pub candidates: Vec<usize>,
    /// The least cost of these candidates.
    cost: f64,
}

/// The functions of candidates, the cheapest first. The one that the report compares the plan with comes before all others, so
/// that it is always judged.
pub(super) fn distinct_functions(candidates: &[Candidate]) -> Vec<DistinctFunction<'_>> {
    let mut functions: Vec<DistinctFunction> = Vec::new();
    for (i, candidate) in candidates.iter().enumerate() {
        let values = &*candidate.values;
        let is_same = |known: &&mut DistinctFunction| {
            std::ptr::eq(known.values, values) || known.values == values
        };
        let cost = if candidate.is_shared() {
            f64::NEG_INFINITY
        } else {
            candidate.cost
        };
        match functions.iter_mut().find(is_same) {
            Some(known) => {
                known.candidates.push(i);
                known.cost = known.cost.min(cost);
            }
            None => functions.push(DistinctFunction {
                values,
                candidates: vec![i],
                cost,
            }),
        }
    }
    functions.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    functions
}
