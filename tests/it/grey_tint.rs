//! The one tint of F82-tint for all three channels: what it is worth over the catalogue.

use crate::{samples, subjects};
use fresnel_gen::generator::fit::{GreyTint, grey_tint};
use fresnel_gen::physics::num::statistics::quantile;

/// The figures that `docs/materials.md` states: the median and the 90th percentile of the largest error.
const MEDIAN: f64 = 0.027;
const NINTH: f64 = 0.055;
/// Half a unit of the last digit that is stated.
const SLACK: f64 = 0.0005;

#[test]
fn one_tint_serves_metals_and_semiconductors() {
    let pages = samples::shapes();
    assert_eq!(pages.len(), 75);
    let mut errors = Vec::new();
    for page in pages {
        let grey = grey_tint(&page.reference);
        assert!(
            grey.max_abs <= grey.schlick_max_abs,
            "{}: {grey:?}",
            page.name
        );
        assert!((0.0..=1.0).contains(&grey.tint), "{}: {grey:?}", page.name);
        errors.push(grey.max_abs);
    }
    for (share, stated) in [(0.5, MEDIAN), (0.9, NINTH)] {
        let measured = quantile(&errors, share);
        assert!(
            (measured - stated).abs() <= SLACK,
            "{share}: {measured} is not {stated}"
        );
    }
}

/// No tint of a dense grid errs less.
#[test]
fn the_grey_tint_is_the_best() {
    use fresnel_gen::generator::fit::{error_of, values_at};
    use fresnel_gen::language::methods;
    let method = methods::find("f82_tint").unwrap();
    let function = method.function(false).unwrap();
    for subject in subjects(&["gold", "copper", "silicon", "water"]) {
        let GreyTint { max_abs, .. } = grey_tint(&subject.reference);
        let f0 = subject.reference.at(1.0);
        for step in 0..=100 {
            let tint = f64::from(step) / 100.0;
            let values = [("f0".to_owned(), f0), ("tint".to_owned(), [tint; 3])].into();
            let run = |cosines: &[f64]| values_at(&function, method.inputs, &values, cosines);
            let other = error_of(&subject.reference, &run).max_abs;
            assert!(
                other >= max_abs - 1e-6,
                "{}: {tint} gives {other}, not {max_abs}",
                subject.name
            );
        }
    }
}
