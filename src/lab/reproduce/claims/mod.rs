//! The claims in the thesis's text, each tested by numbers.

mod gold;
mod minimum;
mod schlick;
mod speed;

use crate::lab::reproduce::section::{Meter, ThesisSection};

pub use schlick::PASSES;

/// All claims.
pub fn section(angles: usize, meter: &mut Meter) -> ThesisSection {
    let rows = [
        schlick::schlick_claims(angles, meter),
        minimum::minimum_claims(),
        gold::gold_claims(),
        speed::instruction_claims(),
        speed::speed_claims(),
    ];
    ThesisSection {
        title: "Claims of the text".to_owned(),
        rows: rows.concat(),
    }
}
