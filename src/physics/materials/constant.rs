//! A medium that is a number: one refractive index at all wavelengths, no absorption.
//!
//! It stands for what has no page: a coat of index 1.5, an oil whose label states n. It has no dispersion, so that colours differ
//! slightly from those in a measured medium with the same index in green.

use core::fmt;

use thiserror::Error;

use super::formula::{DispersionCurve, Formula};
use super::material::{Material, MaterialKind};

/// The least index of a medium that is a number: a vacuum's.
pub const LEAST_INDEX: f64 = 1.0;
/// The greatest: above every transparent medium of the catalogue.
pub const GREATEST_INDEX: f64 = 10.0;

/// Wavelengths in nanometres at which it is known: all that a material file may name.
const KNOWN_NM: (f64, f64) = (1.0, 1e6);

/// The refractive index of a medium without absorption and dispersion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantIndex(f64);

/// A number that is no index of a medium.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "`{given}` is no refractive index of a medium; a number from {LEAST_INDEX} to {GREATEST_INDEX} is allowed, such as 1.5, or a material's name"
)]
pub struct IndexFault {
    given: String,
}

impl ConstantIndex {
    /// The index that a word says; none where the word is no number.
    ///
    /// # Errors
    /// The number lies outside its limits.
    pub fn parse(word: &str) -> Option<Result<ConstantIndex, IndexFault>> {
        let index: f64 = word.parse().ok()?;
        let is_allowed = (LEAST_INDEX..=GREATEST_INDEX).contains(&index);
        Some(if is_allowed {
            Ok(ConstantIndex(index))
        } else {
            Err(IndexFault {
                given: word.to_owned(),
            })
        })
    }

    /// The number.
    pub fn value(self) -> f64 {
        self.0
    }

    /// The medium's record. Its name is `index_1_5` for 1.5: the shortest digits of the number, so that 1.50 is the same medium.
    pub fn material(self) -> Material {
        let name = format!("index_{}", self.to_string().replace('.', "_"));
        let (from_nm, to_nm) = KNOWN_NM;
        Material {
            substance: name.clone(),
            name,
            summary: format!("A medium of refractive index {self} at all wavelengths"),
            kind: MaterialKind::Dielectric,
            licence: "CC0-1.0".to_owned(),
            reference: "a number of the user's".to_owned(),
            link: String::new(),
            page: String::new(),
            conditions: String::new(),
            note: String::new(),
            rgb_nm: None,
            // Cauchy's formula with its first coefficient alone is the number itself, without rounding.
            n: DispersionCurve::Formula(Formula {
                number: 5,
                coefficients: vec![self.0],
                from_nm,
                to_nm,
            }),
            k: None,
        }
    }
}

impl fmt::Display for ConstantIndex {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::{Extrapolate, Index, name_fault};

    #[track_caller]
    fn check(word: &str, argument: &str, name: &str) {
        let index = ConstantIndex::parse(word).expect("a number").expect(word);
        assert_eq!(index.to_string(), argument);
        let material = index.material();
        assert_eq!(material.name, name);
        assert_eq!(name_fault(&material.name), None);
        assert_eq!(material.limits_fault(), None);
        for nm in [1.0, 380.0, 589.3, 830.0, 1e6] {
            let n = argument.parse().expect("a number");
            assert_eq!(
                material.index(nm, Extrapolate::Refuse),
                Ok(Index { n, k: 0.0 })
            );
        }
    }

    #[test]
    fn one_number_is_one_medium() {
        for word in [
            "1.5",
            "1.50",
            "1.500",
            "+1.5",
            "15e-1",
            "1.5000000000000000001",
        ] {
            check(word, "1.5", "index_1_5");
        }
        check("1", "1", "index_1");
        check("1.0", "1", "index_1");
        check("10", "10", "index_10");
        check("1.05", "1.05", "index_1_05");
        check(
            "1.3333333333333333",
            "1.3333333333333333",
            "index_1_3333333333333333",
        );
    }

    #[test]
    fn other_numbers_are_refused() {
        for word in ["0", "0.999", "10.001", "-1.5", "inf", "nan", "NaN", "1e400"] {
            let fault = ConstantIndex::parse(word)
                .expect("a number")
                .expect_err(word);
            assert!(fault.to_string().contains("from 1 to 10"), "{fault}");
        }
    }

    #[test]
    fn words_are_no_numbers() {
        for word in ["water", "1.5.toml", "1,5", "", "1.5x", "./1.5"] {
            assert_eq!(ConstantIndex::parse(word), None, "{word}");
        }
    }
}
