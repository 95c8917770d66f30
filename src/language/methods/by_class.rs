//! How well fitted methods follow classes of materials: metals, semiconductors, and dielectrics of n 1.2 or more, in air.
//!
//! The largest error over all angles and channels of each material, as median and 90th percentile: over the pages of the
//! catalogue, and over the pages of `data/outside.csv`, which had no part in any choice of a shape. The figures stand in the
//! methods' own files. The test `fits::classes_are_followed_as_promised` holds each in both directions.

use super::ALL;
use super::method::Method;

/// Median and 90th percentile of the largest errors of some materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Half of them err no more.
    pub median: f64,
    /// Nine of ten err no more.
    pub ninth: f64,
}

/// What a fitted method promises of a class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByClass {
    /// `metal`, `semiconductor` or `dielectric`.
    pub class: &'static str,
    /// Over the catalogue.
    pub catalogue: Spread,
    /// Over pages that are not in the catalogue.
    pub outside: Spread,
    /// Nine of ten of both together err no more. A fit that errs more misses its class.
    pub limit: f64,
}

impl ByClass {
    /// A promise of a class: median and 90th percentile over the catalogue and outside it, and what nine of ten of both err at
    /// most.
    pub(super) const fn of_class(
        class: &'static str,
        catalogue: [f64; 2],
        outside: [f64; 2],
        limit: f64,
    ) -> ByClass {
        ByClass {
            class,
            catalogue: Spread::new(catalogue),
            outside: Spread::new(outside),
            limit,
        }
    }
}

impl Spread {
    const fn new([median, ninth]: [f64; 2]) -> Spread {
        Spread { median, ninth }
    }
}

/// Every promise with its method.
pub fn promises_by_class() -> impl Iterator<Item = (&'static Method, &'static ByClass)> {
    let own = |method: &'static Method| method.claims.by_class.iter().map(move |row| (method, row));
    ALL.iter().copied().flat_map(own)
}

/// What a method promises of a class, where it promises anything.
pub fn by_class(method: &Method, class: &str) -> Option<&'static ByClass> {
    let mut own = method.claims.by_class.iter();
    own.find(|row| row.class == class)
}

#[cfg(test)]
mod tests {
    use super::ALL;

    #[test]
    fn every_fitted_method_promises_something_of_a_class() {
        for method in ALL {
            let promises = !method.claims.by_class.is_empty();
            let is_meant_to = method.name.starts_with("fitted");
            assert_eq!(promises, is_meant_to, "{}", method.name);
            assert!(is_meant_to || !method.is_fitted(), "{}", method.name);
        }
    }
}
