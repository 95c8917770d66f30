//! What is recorded of digits: the bounds of specialised functions, and the worst inputs found so far.

use super::{Medium, exact, unfused, worst};

/// The most that a function specialised to a material of the catalogue may be off, in ulp.
const SPECIALISED: f64 = 10.0;

/// Functions that lose more, and why.
const KNOWN: [(&str, &str, &str); 1] = [(
    "zinc_querry",
    "schlick_corrected",
    "the difference of two terms, each of which has its digits: 4e-7 off at 85 degrees",
)];

/// Their real powers lose digits of their own: log2 near 1, times the power.
const POWERS: [&str; 2] = ["empirical", "schlick_generalised"];

/// A material whose shader is further from its formula than its page lets one think.
#[test]
fn no_specialised_function_loses_more_than_ten_ulp() {
    let text = include_str!("../../../data/code-bounds.csv");
    let mut count = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let (material, method) = (cells[1], cells[2]);
        let ulp: f64 = cells[3].parse().unwrap();
        let is_known = KNOWN
            .iter()
            .any(|known| (known.0, known.1) == (material, method));
        if POWERS.contains(&method) {
            continue;
        }
        assert_eq!(
            ulp > SPECIALISED,
            is_known,
            "{method} of {material}: {ulp} ulp"
        );
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
