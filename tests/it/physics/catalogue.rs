//! What every method that keeps the contract promises, with the inputs of every material of the catalogue that it describes: a
//! reflectance, and where its form has that, all light at 90 degrees.

use super::cosines;
use super::function;
use crate::fits::catalogue;
use fresnel_gen::generator::fit::values_for_material;
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods::{self, Contract, Method};

/// The methods whose form does not end at 1. The others do, to two ulp.
const ENDS_ELSEWHERE: [&str; 7] = [
    "belcour_decomposition",
    "constant_f0",
    "fitted",
    "fitted_dielectric",
    "fitted_dielectric_rational",
    "fitted_five",
    "fitted_rational",
];

/// The least of a method at 90 degrees, in f32, over all materials. All that it gives lies in [0, 1].
fn least_at_grazing(method: &'static Method, cosines: &[f32]) -> f32 {
    let function = function(method.name);
    let described = catalogue().iter().filter(|one| one.is_described_by(method));
    let mut least = f32::INFINITY;
    for subject in described {
        let values = values_for_material(subject, method);
        let inputs = method
            .inputs
            .iter()
            .map(|input| Value::rgb(values[input.name]));
        let arguments: Vec<Value<f32>> = [Value::each(cosines.to_vec())]
            .into_iter()
            .chain(inputs)
            .collect();
        let given = evaluate::<f32>(&function, &arguments);
        for (i, c) in cosines.iter().enumerate() {
            for f in given.at(i) {
                assert!(
                    (0.0..=1.0).contains(&f),
                    "{} of {} at {c:e}: {f:e}",
                    method.name,
                    subject.name
                );
            }
        }
        least = given.at(0).into_iter().fold(least, f32::min);
    }
    least
}

#[test]
fn every_material_reflects_a_share_and_all_at_grazing() {
    let mut cosines = cosines();
    cosines.sort_by(f32::total_cmp);
    assert_eq!(cosines[0], 0.0);
    let kept = methods::ALL
        .iter()
        .filter(|method| method.contract == Contract::Kept);
    for method in kept.filter(|method| !method.is_textured()) {
        let least = least_at_grazing(method, &cosines);
        let ends_elsewhere = ENDS_ELSEWHERE.contains(&method.name);
        assert_eq!(
            least < 1.0 - f32::EPSILON,
            ends_elsewhere,
            "{}: {least}",
            method.name
        );
    }
}
