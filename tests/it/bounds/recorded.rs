//! What is recorded of digits: the bounds of specialised functions, and the worst inputs found so far.

use serde::Deserialize;

use super::Medium;
use super::exact;
use super::unfused;
use super::worst;
use fresnel_gen::language::methods::{self, Method};
use fresnel_gen::physics::records;

/// The most that a function specialised to a material of the catalogue may be off, in ulp.
const SPECIALISED: f64 = 10.0;

/// Methods with a real power, which is as good as a stack's `log2` and `exp2`, and the most of theirs.
const POWERS: [&str; 4] = [
    "empirical",
    "schlick_corrected",
    "schlick_f82_f90",
    "schlick_generalised",
];
const POWER: f64 = 17.0;

/// The most that a fitted one may be off: where nearly nothing is reflected, its fit is off by a thousand times that, and
/// ulp of nearly nothing say nothing.
const FITTED: f64 = 2e-6;

/// A row of the code bounds.
#[derive(Deserialize)]
struct BoundRow {
    material: String,
    method: String,
    max_ulp: f64,
    max_abs: f64,
}

/// A row of the worst inputs of exact forms.
#[derive(Debug, Deserialize)]
struct WorstInput {
    method: String,
    n: f32,
    k: f32,
    cos_theta: f32,
}

/// A material whose shader is further from its formula than its page lets one think.
#[test]
fn no_specialised_function_loses_more_than_ten_ulp() {
    let text = include_str!("../../../data/code-bounds.csv");
    let rows: Vec<BoundRow> = records::rows(text);
    for row in &rows {
        let (material, method, ulp) = (&row.material, row.method.as_str(), row.max_ulp);
        let is_power = POWERS.contains(&method);
        let most = if is_power { POWER } else { SPECIALISED };
        let is_fitted = methods::find(method).is_some_and(Method::is_fitted);
        let is_close = is_fitted && row.max_abs <= FITTED;
        let what = format!("{method} of {material}: {ulp} ulp");
        assert!(ulp <= most || is_close, "{what}");
    }
    assert!(rows.len() > 400, "{} bounds", rows.len());
}

/// An input that once was the worst has become worse.
#[test]
fn the_worst_inputs_known_stay_within_their_bounds() {
    let text = include_str!("../../../data/worst-cases/exact-forms.csv");
    let rows: Vec<WorstInput> = records::rows(text);
    for row in &rows {
        let function = exact(&row.method);
        let run = |media: &[Medium; 3], cosines: &[f32]| unfused(&function, media, cosines);
        let found = worst(&function, &[(row.n, row.k)], &|_| vec![row.cos_theta], &run);
        found.check(&format!("{row:?}"));
    }
    assert!(rows.len() > 5, "{} inputs", rows.len());
}
