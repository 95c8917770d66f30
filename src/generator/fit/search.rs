//! Every candidate fitted to every curve: what each would err by.

use crate::physics::num::in_parallel;

use super::candidates::Candidate;
use super::problem::{FitProblem, basis};

/// A candidate, and its largest error for each of the curves, in the measure of their aim.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The candidate.
    pub candidate: Candidate,
    /// The errors, in the order of the curves.
    pub errors: Vec<f64>,
}

/// Tries candidates. One that tells the angles of some curve apart too poorly to be fitted is left out. `progress` hears how
/// many are done, of how many; what comes of it does not depend on how many processors there are.
pub fn search(
    candidates: &[Candidate],
    tasks: &[FitProblem],
    progress: &mut dyn FnMut(u64, u64),
) -> Vec<Tried> {
    let one = |i: usize| tried(&candidates[i], tasks);
    let all = in_parallel(candidates.len(), &one, progress);
    all.into_iter().flatten().collect()
}

fn tried(candidate: &Candidate, tasks: &[FitProblem]) -> Option<Tried> {
    let basis = basis(&candidate.shape);
    let errors = tasks.iter().map(|task| Some(task.fit(&basis)?.error));
    Some(Tried {
        candidate: *candidate,
        errors: errors.collect::<Option<_>>()?,
    })
}
