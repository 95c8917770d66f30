//! Coefficients that serve lamps and image light: their form keeps to [0, 1] by itself, and what that costs.

use super::fits::catalogue;
use super::samples;
use fresnel_gen::generator::emit::recorded_catalogue;
use fresnel_gen::generator::fit::{
    FitCurve, FitObjective, basis, coefficients_and_error, model_error, values_for_material,
};
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::language::methods::{self, Method, Values};
use fresnel_gen::physics::materials::ViewingConditions;
use fresnel_gen::physics::num::statistics::quantile;
use fresnel_gen::physics::spectra::Gamut;

/// What f32 coefficients of some tens move a sum by.
const ROUNDING: f64 = 2e-6;

/// The least and the largest value of a form before its limit.
fn range(method: &Method, coefficients: &[[f64; 3]]) -> (f64, f64) {
    let shape = method.shape.expect("it is fitted");
    let value = |row: &Vec<f64>, i: usize| -> f64 {
        row.iter().zip(coefficients).map(|(b, c)| b * c[i]).sum()
    };
    let rows = basis(&shape);
    let all = rows.iter().flat_map(|row| [0, 1, 2].map(|i| value(row, i)));
    all.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| {
        (least.min(x), most.max(x))
    })
}

/// The coefficients of a method in a gamut.
pub fn fitted(subject: &MaterialInMedium, method: &Method, gamut: Gamut) -> Values {
    let curve = match gamut {
        Gamut::Keep => FitCurve::unclipped(subject),
        _ => FitCurve::of(subject),
    };
    let aim = FitObjective {
        gamut,
        ..FitObjective::default()
    };
    let found = coefficients_and_error(method, &curve, aim);
    found.expect("its terms tell angles apart").0
}

/// The largest error of a method with these.
pub fn error(subject: &MaterialInMedium, method: &Method, gamut: Gamut) -> f64 {
    let function = method.specialise(&fitted(subject, method, gamut));
    let function = function.expect("it is specialised");
    model_error(&function, &subject.truth_for(method)).max_abs
}

fn in_order(method: &Method, values: &Values) -> Vec<[f64; 3]> {
    let inputs = method.inputs.iter();
    inputs.map(|input| values[input.name]).collect()
}

/// The catalogue as it is shipped; and gold before it was clipped, which no unsigned texture holds.
#[test]
fn the_catalogue_reflects_no_more_than_all() {
    let rows = recorded_catalogue(&ViewingConditions::default()).expect("the record is true");
    assert!(rows.len() > 120);
    for row in &rows {
        let (least, most) = range(row.method, &row.coefficients);
        assert!(
            least > -ROUNDING && most < 1.0 + ROUNDING,
            "{}: {least} {most}",
            row.name
        );
        assert!(
            row.coefficients[0]
                .iter()
                .all(|c0| (0.0..=1.0).contains(c0)),
            "{}",
            row.name
        );
        let better = row
            .better
            .as_ref()
            .filter(|better| better.method.is_fitted());
        if let Some(better) = better {
            let (least, most) = range(better.method, &better.coefficients);
            assert!(
                least > -ROUNDING && most < 1.0 + ROUNDING,
                "{}: {least} {most}",
                row.name
            );
        }
        // So the mean needs no limit either.
        for i in 0..3 {
            let off = (row.average.given[i] - row.average.unlimited[i]).abs();
            assert!(off < ROUNDING, "{}: {off:e}", row.name);
        }
    }
    let gold = catalogue().iter().find(|subject| subject.name == "gold");
    let gold = gold.expect("gold is there");
    let method = methods::find("fitted").expect("it is a method");
    let free = in_order(method, &fitted(gold, method, Gamut::Keep));
    assert!((1.040..1.043).contains(&free[0][0]), "{free:?}");
    assert_eq!(in_order(method, &values_for_material(gold, method)), free);
}

/// What the limit costs a function, by class: the largest errors with it, and without.
#[test]
fn the_limit_costs_what_the_document_says() {
    for (name, class, with, without) in [
        ("fitted", "metal", [0.0022, 0.0039], [0.0020, 0.0030]),
        ("fitted_five", "metal", [0.0006, 0.0018], [0.0006, 0.0011]),
        (
            "fitted",
            "semiconductor",
            [0.0040, 0.0052],
            [0.0040, 0.0052],
        ),
        (
            "fitted_dielectric",
            "dielectric",
            [0.0007, 0.0011],
            [0.0007, 0.0011],
        ),
    ] {
        let method = methods::find(name).expect("it is a method");
        let own = catalogue().iter().filter(|subject| {
            subject.material.kind.name() == class && samples::is_of_classes(subject)
        });
        let own: Vec<&MaterialInMedium> = own.collect();
        for (gamut, [median, most]) in [(Gamut::Clip, with), (Gamut::Keep, without)] {
            let error = |subject: &&MaterialInMedium| error(subject, method, gamut);
            let errors: Vec<f64> = own.iter().map(error).collect();
            let found = [quantile(&errors, 0.5), quantile(&errors, 0.9)];
            println!("{name}, {class}, {}: {found:?}", gamut.name());
            assert!(
                found[0] <= median && found[0] > median - 1e-4,
                "{name} {class}: {found:?}"
            );
            assert!(
                found[1] <= most && found[1] > most - 1e-4,
                "{name} {class}: {found:?}"
            );
        }
    }
}
