//! What two colours are worth: methods of F0 and F82 over the sample of metals and semiconductors, and over glasses.

use crate::samples;
use fresnel_gen::generator::fit::{ErrorQuantiles, error_of, values_at, values_for_material};
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::language::methods;
use fresnel_gen::physics::optics;

/// A method with the median and the 90th percentile of its largest errors, each measurement once, as headers and `docs/methods.md` state them of the
/// sample.
const STATED: [(&str, f64, f64); 5] = [
    ("schlick", 0.1221, 0.2307),
    ("hoffman_f82", 0.0179, 0.0471),
    ("f82_tint", 0.0179, 0.0471),
    ("fitted_f82", 0.0133, 0.0210),
    ("fitted_f82_metal", 0.0034, 0.0089),
];
/// Half a unit of the last digit that is stated.
const SLACK: f64 = 0.000_05;

/// The largest error of the library function with the material's colours.
fn error(subject: &MaterialInMedium, name: &str) -> f64 {
    let method = methods::find(name).unwrap();
    let function = method.function(false).unwrap();
    let values = values_for_material(subject, method);
    let run = |cosines: &[f64]| values_at(&function, method.inputs, &values, cosines);
    error_of(&subject.truth_for(method), &run).max_abs
}

#[test]
fn colours_of_metals_are_worth_what_is_stated() {
    let pages = samples::shapes();
    assert_eq!(pages.len(), 75);
    let substances: Vec<String> = pages
        .iter()
        .map(|page| page.material.substance.clone())
        .collect();
    let mut faults = String::new();
    for (name, median, ninth) in STATED {
        let errors: Vec<f64> = pages.iter().map(|page| error(page, name)).collect();
        let found = ErrorQuantiles::new(&errors, &substances);
        if (found.median - median).abs() > SLACK || (found.p90 - ninth).abs() > SLACK {
            faults += &format!("{name}: {found:?}, stated {median} and {ninth}\n");
        }
        println!("{name}: {found:?}");
    }
    assert!(faults.is_empty(), "{faults}");
}

/// From n of 1.2 to 2.5, at every angle.
#[test]
fn two_fitted_curves_serve_glasses_too() {
    let method = methods::find("fitted_f82").unwrap();
    let function = method.function(true).unwrap();
    let mut worst = 0.0_f64;
    for step in 0..=130 {
        let n = 1.2 + f64::from(step) / 100.0;
        let law = |c: f64| optics::dielectric(n, c).unpolarised();
        let (f0, f82) = (law(1.0), law(optics::COS_82));
        for i in 0..=2000 {
            let c = f64::from(i) / 2000.0;
            let values = [c, f0, f82].map(fresnel_gen::language::ir::Value::<f64>::scalar);
            let given = fresnel_gen::language::ir::evaluate(&function, &values).at(0)[0];
            worst = worst.max((given - law(c)).abs());
        }
    }
    assert!((0.0120..0.0135).contains(&worst), "{worst}");
}
