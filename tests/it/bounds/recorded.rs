//! What is recorded of digits: the bounds of specialised functions, and the worst inputs found so far.

use fresnel_gen::methods::{self, Method};

use super::{Medium, exact, unfused, worst};

/// The most that a function specialised to a material of the catalogue may be off, in ulp.
const SPECIALISED: f64 = 10.0;

/// Methods with a real power, which is as good as a stack's `log2` and `exp2`, and the most of theirs.
const POWERS: [&str; 3] = ["empirical", "schlick_corrected", "schlick_generalised"];
const POWER: f64 = 17.0;

/// The most that a fitted one may be off: where nearly nothing is reflected, its fit is off by a thousand times that, and
/// ulp of nearly nothing say nothing.
const FITTED: f64 = 2e-6;

/// A material whose shader is further from its formula than its page lets one think.
#[test]
fn no_specialised_function_loses_more_than_ten_ulp() {
    let text = include_str!("../../../data/code-bounds.csv");
    let mut count = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let (material, method) = (cells[1], cells[2]);
        let ulp: f64 = cells[3].parse().unwrap();
        let is_power = POWERS.contains(&method);
        let most = if is_power { POWER } else { SPECIALISED };
        let is_fitted = methods::find(method).is_some_and(Method::is_fitted);
        let is_close = is_fitted && cells[4].parse::<f64>().unwrap() <= FITTED;
        let what = format!("{method} of {material}: {ulp} ulp");
        assert!(ulp <= most || is_close, "{what}");
        count += 1;
    }
    assert!(count > 400, "{count} bounds");
}

/// An input that once was the worst has become worse.
#[test]
fn the_worst_inputs_known_stay_within_their_bounds() {
    let text = include_str!("../../../data/worst-cases/exact-forms.csv");
    let mut count = 0;
    for line in text.lines().filter(|line| line.contains("_exact,")) {
        let cells: Vec<&str> = line.split(',').collect();
        let [n, k, c] = [1, 2, 3].map(|i| cells[i].parse::<f32>().unwrap());
        let function = exact(cells[0]);
        let run = |media: &[Medium; 3], cosines: &[f32]| unfused(&function, media, cosines);
        worst(&function, &[(n, k)], &|_| vec![c], &run).check(line);
        count += 1;
    }
    assert!(count > 5, "{count} inputs");
}
