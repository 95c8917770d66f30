//! How well fitted methods follow classes of materials: metals, semiconductors, and dielectrics of n 1.2 or more, in air.
//!
//! The largest error over all angles and channels of each material, as median and 90th percentile: over the pages of the
//! catalogue, and over the pages of `data/outside.csv`, which had no part in any choice of a shape. The test
//! `fits::classes_are_followed_as_promised` holds each figure in both directions.

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
    /// The method's name.
    pub method: &'static str,
    /// `metal`, `semiconductor` or `dielectric`.
    pub class: &'static str,
    /// Over the catalogue.
    pub catalogue: Spread,
    /// Over pages that are not in the catalogue.
    pub outside: Spread,
    /// Nine of ten of both together err no more. A fit that errs more misses its class.
    pub limit: f64,
}

const fn row(
    method: &'static str,
    class: &'static str,
    catalogue: [f64; 2],
    outside: [f64; 2],
    limit: f64,
) -> ByClass {
    let [median, ninth] = catalogue;
    let catalogue = Spread { median, ninth };
    let [median, ninth] = outside;
    let outside = Spread { median, ninth };
    ByClass {
        method,
        class,
        catalogue,
        outside,
        limit,
    }
}

/// Every promise, by method and class.
#[rustfmt::skip]
pub static BY_CLASS: [ByClass; 10] = [
    row("fitted", "metal", [0.0020, 0.0030], [0.0019, 0.0118], 0.0032),
    row("fitted", "semiconductor", [0.0040, 0.0052], [0.0036, 0.0066], 0.0064),
    row("fitted", "dielectric", [0.0036, 0.0038], [0.0030, 0.0037], 0.0038),
    row("fitted_rational", "metal", [0.0022, 0.0036], [0.0023, 0.0100], 0.0037),
    row("fitted_rational", "semiconductor", [0.0027, 0.0039], [0.0026, 0.0056], 0.0054),
    row("fitted_rational", "dielectric", [0.0030, 0.0033], [0.0030, 0.0033], 0.0033),
    row("fitted_five", "metal", [0.0006, 0.0011], [0.0006, 0.0071], 0.0012),
    row("fitted_five", "semiconductor", [0.0005, 0.0005], [0.0006, 0.0008], 0.0008),
    row("fitted_five", "dielectric", [0.0015, 0.0015], [0.0013, 0.0015], 0.0015),
    row("fitted_dielectric", "dielectric", [0.0007, 0.0011], [0.0011, 0.0012], 0.0012),
];

/// What a method promises of a class, where it promises anything.
pub fn by_class(method: &Method, class: &str) -> Option<&'static ByClass> {
    let is_it = |row: &&ByClass| row.method == method.name && row.class == class;
    BY_CLASS.iter().find(is_it)
}

#[cfg(test)]
mod tests {
    use super::super::ALL;
    use super::BY_CLASS;

    #[test]
    fn every_fitted_method_promises_something_of_a_class() {
        for method in ALL {
            let promises = BY_CLASS.iter().any(|row| row.method == method.name);
            assert_eq!(promises, method.is_fitted(), "{}", method.name);
        }
    }
}
