//! Where half precision overflows: up to the ends that headers state it is as near as it promises, and beyond it is not.

use super::library;
use super::numeric;
use fresnel_gen::lab::verify::nearest_half;
use fresnel_gen::language::ir::{Ty, Value, evaluate};
use fresnel_gen::language::methods::{Input, InputSource, Method};
use fresnel_gen::physics::num::{Half, Num, Precision};

/// What is promised is of media; at the ends of ranges results are within so many times that.
const ROOM: f64 = 3.0;
/// Below this index the critical angle decides.
const LEAST: f64 = 1.1;

/// Values of an index from above 1 to an end, even in the logarithm; of k from 0.
fn steps(input: &Input, most: f64) -> Vec<f32> {
    let value = |i: u32| LEAST * (most / LEAST).powf(f64::from(i) / 24.0);
    let zero = if input.name == "k" { vec![0.0] } else { vec![] };
    let all = zero.into_iter().chain((0..=24).map(value));
    all.map(|x| nearest_half(x as f32)).collect()
}

/// The largest difference to f64 over all combinations of these values.
fn off(method: &Method, values: &[Vec<f32>]) -> f64 {
    let (half, meaning) = (
        library(method, Precision::F16),
        library(method, Precision::F32),
    );
    let cosines: Vec<f32> = (0..=64).map(|i| nearest_half(i as f32 / 64.0)).collect();
    let sets = values
        .iter()
        .fold(vec![vec![]], |sets: Vec<Vec<f32>>, more| {
            let longer = |set: Vec<f32>| {
                more.iter()
                    .map(move |x| [&set[..], &[*x]].concat())
                    .collect::<Vec<_>>()
            };
            sets.into_iter().flat_map(longer).collect()
        });
    let differences = sets.iter().flat_map(|set| {
        let got = evaluate::<Half>(&half, &arguments(method, set, &cosines));
        let want = evaluate::<f64>(&meaning, &arguments(method, set, &cosines));
        let off = |i: usize| (got.at(i)[0].to_f64() - want.at(i)[0]).abs();
        (0..cosines.len()).map(off).collect::<Vec<_>>()
    });
    differences.fold(0.0, |most, off| {
        if off.is_nan() {
            f64::INFINITY
        } else {
            off.max(most)
        }
    })
}

fn arguments<N: Num>(method: &Method, set: &[f32], cosines: &[f32]) -> Vec<Value<N>> {
    let number = |c: &f32| N::from_f64(f64::from(*c));
    let cosines = Value::each(cosines.iter().map(number).collect());
    let value = |(input, x): (&Input, &f32)| match input.ty {
        Ty::Vec3 => Value::rgb([f64::from(*x); 3]),
        _ => Value::scalar(f64::from(*x)),
    };
    [cosines]
        .into_iter()
        .chain(method.inputs.iter().zip(set).map(value))
        .collect()
}

#[test]
fn half_precision_overflows_where_headers_say() {
    let mut faults = String::new();
    for method in numeric() {
        let Some(claim) = method.half.claim().filter(|claim| !claim.ends.is_empty()) else {
            continue;
        };
        let end = |input: &Input| method.range(input, Precision::F16).most;
        let own = |input: &Input, beyond: f64| match input.source {
            // Without the correction, whose power has errors of its own.
            InputSource::MaterialOrNone(_) => vec![0.0],
            _ => steps(input, end(input) * beyond),
        };
        let [inside, beyond] = [1.0, 1.02].map(|share| {
            let values: Vec<Vec<f32>> = method
                .inputs
                .iter()
                .map(|input| own(input, share))
                .collect();
            off(method, &values)
        });
        println!(
            "{}: {inside:e} up to the ends, {beyond:e} beyond",
            method.name
        );
        let is_last = method.inputs.iter().all(|input| end(input) >= 65_504.0);
        if inside > ROOM * claim.max_abs || beyond <= ROOM * claim.max_abs && !is_last {
            faults += &format!(
                "{}: {inside:e} up to the ends, {beyond:e} beyond\n",
                method.name
            );
        }
    }
    assert!(faults.is_empty(), "{faults}");
}
