//! The claims about gold at 685 and 475 nm (section 2.2, beside figures 9 and 10).

use crate::lab::reproduce::comparison::{ComparisonRow, ComparisonVerdict, Figure, measured};
use crate::lab::reproduce::figures::{exact, lowest};
use crate::lab::reproduce::specialised;

/// The tolerance of "about 77°" in degrees, and of "a little over 20 %" in percentage points.
const ABOUT: f64 = 1.0;
/// How far "a little" reaches above a bound, in percentage points.
const A_LITTLE: f64 = 5.0;

/// The claims about gold.
pub fn gold_claims() -> Vec<ComparisonRow> {
    let channels = specialised::channels("gold");
    let index = |i: usize| [channels.n[i], channels.k[i]];
    let (red, blue) = (index(0), index(2));
    [at_685(red), at_475(blue)].concat()
}

fn at_685(index: [f64; 2]) -> Vec<ComparisonRow> {
    let (minimum, least) = lowest(|degrees| exact(index, degrees).unpolarised());
    let (minimum_p, least_p) = lowest(|degrees| exact(index, degrees).p);
    let name = "gold at 685 nm";
    vec![
        measured(name, "angle of the minimum", degrees(minimum))
            .thesis(Figure::Number(77.0, 0, "°"))
            .verdict(ComparisonVerdict::of_claim((minimum - 77.0).abs() <= ABOUT))
            .remark(
                "section 2.2: about 77°. Even the p-polarised light alone has its minimum lower",
            ),
        measured(name, "angle of p's minimum", degrees(minimum_p)),
        measured(name, "least reflectance", Figure::percent(100.0 * least))
            .thesis(Figure::Number(92.0, 0, " %"))
            .verdict(ComparisonVerdict::of_claim(least > 0.92))
            .remark("section 2.2: more than 92 % at every angle"),
        measured(
            name,
            "p's least reflectance",
            Figure::percent(100.0 * least_p),
        ),
    ]
}

fn at_475(index: [f64; 2]) -> Vec<ComparisonRow> {
    let (_, least) = lowest(|degrees| exact(index, degrees).unpolarised());
    let (minimum_p, least_p) = lowest(|degrees| exact(index, degrees).p);
    let name = "gold at 475 nm";
    let above = 100.0 * least - 20.0;
    vec![
        measured(name, "least reflectance", Figure::percent(100.0 * least))
            .thesis(Figure::Number(20.0, 0, " %"))
            .verdict(ComparisonVerdict::of_claim(
                (0.0..=A_LITTLE).contains(&above),
            ))
            .remark(
                "section 2.2: a little over 20 %. The unpolarised curve only rises; \
                 the p-polarised light alone falls below 20 %",
            ),
        measured(name, "angle of p's minimum", degrees(minimum_p)),
        measured(
            name,
            "p's least reflectance",
            Figure::percent(100.0 * least_p),
        ),
    ]
}

fn degrees(value: f64) -> Figure {
    Figure::Number(value, 2, "°")
}
