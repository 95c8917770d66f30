//! Where methods hold: over the whole stated range of every argument, both ends included, each function gives a number in its
//! range, whatever a compiler makes of its arithmetic. What artists feed is held to a bound over all colours.

mod arithmetic;
mod halves;

use arithmetic::{FUSED_LEFT, FUSED_RIGHT, Fast, RECIPROCAL, UNFUSED};
use fresnel_gen::generator::emit::{self, HeaderForm, Heading, Naming};
use fresnel_gen::lab::verify::cosines;
use fresnel_gen::language::ir::{Checked, Ty, Value, evaluate};
use fresnel_gen::language::methods::{self, ColourClaim, Contract, Input, Method, Range};
use fresnel_gen::language::targets;
use fresnel_gen::physics::num::{Num, Precision};

/// The seed of random colours.
const SEED: u64 = 18;
/// So many of them.
const RANDOM: usize = 3000;

/// Methods whose functions take numbers, and keep the contract.
pub fn numeric() -> impl Iterator<Item = &'static Method> {
    let kept = |method: &&&Method| method.contract == Contract::Kept && !method.is_textured();
    methods::ALL
        .iter()
        .filter(kept)
        .flat_map(|method| method.with_variants())
}

pub fn library(method: &Method, precision: Precision) -> Checked {
    method
        .function_in(precision, false)
        .expect("a test builds all")
}

/// The arguments of a function for three sets of values, one a channel. A scalar argument has the first.
pub fn arguments<N: Num>(method: &Method, sets: &[Vec<f32>; 3], cosines: &[f32]) -> Vec<Value<N>> {
    let number = |c: &f32| N::from_f64(f64::from(*c));
    let cosines = Value::each(cosines.iter().map(number).collect());
    let value = |(i, input): (usize, &Input)| {
        let colour = [0, 1, 2].map(|channel| f64::from(sets[channel][i]));
        match input.ty {
            Ty::Vec3 => Value::rgb(colour),
            _ => Value::scalar(colour[0]),
        }
    };
    let rest = method.inputs.iter().enumerate().map(value);
    [cosines].into_iter().chain(rest).collect()
}

/// Values of an argument: both ends, 0 and 1 and their neighbours where they lie between, and some inside.
pub fn values(method: &Method, input: &Input, precision: Precision) -> Vec<f32> {
    let range = method.range(input, precision);
    let (least, most) = (range.least as f32, range.most as f32);
    let steps = [
        0.0, 1e-30, 1e-19, 1e-6, 0.04, 0.3, 0.75, 1.0, 1.5, 12.0, 1e4, 1e8,
    ];
    let near_one = [1.0f32.next_down(), 1.0f32.next_up()];
    let inside = steps.into_iter().chain(near_one);
    let inside = inside
        .flat_map(|x: f32| [x, -x])
        .filter(|x| (least..=most).contains(x));
    let mut values: Vec<f32> = [least, most].into_iter().chain(inside).collect();
    values.sort_by(f32::total_cmp);
    values.dedup();
    values
}

/// All combinations of the values of a method's arguments; of many arguments, fitted coefficients, the ends and 0 and 1 only.
fn combinations(method: &Method) -> Vec<Vec<f32>> {
    let is_short = method.inputs.len() > 3;
    let of = |input: &Input| {
        let mut values = values(method, input, Precision::F32);
        if is_short {
            values.retain(|x| *x == 0.0 || *x == 1.0 || x.abs() == 1000.0);
        }
        values
    };
    method
        .inputs
        .iter()
        .fold(vec![Vec::new()], |sets: Vec<Vec<f32>>, input| {
            let more = of(input);
            let longer = |set: Vec<f32>| {
                more.iter()
                    .map(move |x| [&set[..], &[*x]].concat())
                    .collect::<Vec<_>>()
            };
            sets.into_iter().flat_map(longer).collect()
        })
}

/// What is wrong over these sets of values with the results of one arithmetic, the first few, and the largest difference to f64.
fn faults<const KIND: u8>(
    method: &Method,
    sets: &[Vec<f32>],
    cosines: &[f32],
) -> (Vec<String>, f64) {
    let function = library(method, Precision::F32);
    let (mut faults, mut off) = (Vec::new(), 0.0f64);
    let scalars = method.inputs.iter().any(|input| input.ty != Ty::Vec3);
    for chunk in sets.chunks(if scalars { 1 } else { 3 }) {
        let three = [0, 1, 2].map(|i| chunk[i.min(chunk.len() - 1)].clone());
        let got = evaluate::<Fast<KIND>>(&function, &arguments(method, &three, cosines));
        let want = evaluate::<f64>(&function, &arguments(method, &three, cosines));
        for (i, c) in cosines.iter().enumerate() {
            for (channel, inputs) in three.iter().enumerate() {
                let (got, want) = (got.at(i)[channel].to_f64(), want.at(i)[channel]);
                off = off.max((got - want).abs());
                if !(0.0..=1.0).contains(&got) {
                    faults.push(format!(
                        "{} {}({c:e}, {inputs:?}) = {got:e}",
                        method.name,
                        Fast::<KIND>::NAME
                    ));
                }
            }
        }
    }
    (faults, off)
}

/// The same in every arithmetic.
fn in_all(method: &Method, sets: &[Vec<f32>], cosines: &[f32]) -> [(Vec<String>, f64); 4] {
    [
        faults::<UNFUSED>(method, sets, cosines),
        faults::<FUSED_LEFT>(method, sets, cosines),
        faults::<FUSED_RIGHT>(method, sets, cosines),
        faults::<RECIPROCAL>(method, sets, cosines),
    ]
}

#[test]
fn every_function_gives_a_reflectance_over_the_ranges_that_it_states() {
    let cosines = cosines(60);
    let mut all = Vec::new();
    for method in numeric() {
        for (faults, _) in in_all(method, &combinations(method), &cosines) {
            all.extend(faults.into_iter().take(6));
        }
    }
    assert!(all.is_empty(), "{} faults:\n{}", all.len(), all.join("\n"));
}

/// Colours over the ranges of a promise: in a grid that holds both ends, and random ones.
fn colours(method: &Method, claim: &ColourClaim) -> Vec<Vec<f32>> {
    let count = method.inputs.len() as u32;
    let places: u32 = if count > 2 { 6 } else { 16 };
    let set = |share: &mut dyn FnMut(u32) -> f32| -> Vec<f32> {
        let inputs = method.inputs.iter().zip(0..);
        let value = |(input, axis)| {
            let Range { least, most } = claim.range(input);
            (least + (most - least) * f64::from(share(axis))) as f32
        };
        inputs.map(value).collect()
    };
    let grid = (0..(places + 1).pow(count)).map(|i| {
        set(&mut |axis| ((i / (places + 1).pow(axis)) % (places + 1)) as f32 / places as f32)
    });
    let mut sets: Vec<Vec<f32>> = grid.collect();
    let mut state = SEED;
    sets.extend((0..RANDOM).map(|_| set(&mut |_| unit(&mut state))));
    sets
}

/// SplitMix64, as the points of `verify` are random.
fn unit(state: &mut u64) -> f32 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 40) as f32 / 16_777_216.0
}

#[test]
fn what_artists_feed_is_within_the_stated_bound() {
    let cosines = cosines(120);
    let mut all = String::new();
    for method in numeric() {
        let Some(claim) = method.claims.colours else {
            continue;
        };
        let measured = in_all(method, &colours(method, &claim), &cosines).map(|(_, off)| off);
        let (worst, promised) = (measured.into_iter().fold(0.0, f64::max), claim.max_abs);
        println!("{}: {measured:?}, promised {promised}", method.name);
        if worst > promised || worst < 0.25 * promised || worst.is_nan() {
            all += &format!(
                "{}: measured {measured:?}, promised {promised}\n",
                method.name
            );
        }
    }
    assert!(all.is_empty(), "{all}");
}

/// Indices below 1 with the numbers from the critical cosine downwards, the nearest first.
fn beside_critical(eta: f32, count: u32) -> Vec<f32> {
    let critical = (1.0 - f64::from(eta).powi(2)).sqrt();
    let nearest = critical as f32;
    let first = if f64::from(nearest) > critical {
        nearest.next_down()
    } else {
        nearest
    };
    (0..count)
        .map(|step| f32::from_bits(first.to_bits() - step))
        .collect()
}

/// Past the critical angle: how many numbers next to its cosine give less than 1, and the least that they give.
#[test]
fn total_reflection_begins_where_headers_say() {
    for (name, most, least) in [
        ("dielectric_exact", 34, 0.99),
        ("dielectric_exact_s", 1, 0.998),
        ("dielectric_exact_p", 1, 0.98),
    ] {
        let function = library(methods::find(name).unwrap(), Precision::F32);
        let (mut last, mut lowest) = (0, 1.0f32);
        for i in 0..6000 {
            // Even below 1, and ever nearer to it; the nearest comes first.
            let eta = match i % 2 {
                _ if i == 0 => f64::from(1.0f32.next_down()),
                0 => 0.25 + 0.75 * i as f64 / 6000.0,
                _ => 1.0 - libm::exp2(-22.0 * i as f64 / 6000.0 - 1.0),
            } as f32;
            let cosines = beside_critical(eta, 80);
            let arguments = [
                Value::each(cosines.clone()),
                Value::rgb([f64::from(eta); 3]),
            ];
            let got = evaluate::<f32>(&function, &arguments);
            for (place, f) in (1..).zip((0..cosines.len()).map(|i| got.at(i)[0])) {
                if f != 1.0 {
                    (last, lowest) = (place.max(last), lowest.min(f));
                }
            }
        }
        println!("{name}: {last} numbers, {lowest}");
        assert!(
            last <= most && last * 2 >= most,
            "{name}: {last} numbers give less than 1"
        );
        assert!(lowest >= least && lowest < least + 0.01, "{name}: {lowest}");
    }
}

/// Both ends of every argument, and the exceptions that are true.
#[test]
fn headers_state_both_ends_of_every_argument_in_either_precision() {
    for precision in Precision::ALL {
        for method in methods::ALL
            .iter()
            .filter(|method| method.half.claim().is_some() || !precision.is_half())
        {
            let naming = Naming {
                precision,
                ..Naming::default()
            };
            let functions = emit::library_functions(method, &naming).unwrap();
            let target = targets::find("hlsl").unwrap();
            for form in [HeaderForm::Short, HeaderForm::Full] {
                let heading = Heading {
                    form,
                    ..Heading::default()
                };
                let pages = emit::library(target, method, &functions, heading).unwrap();
                let text = String::from_utf8(pages[0].bytes.clone()).unwrap();
                let text = text.replace("\n//      ", "").replace("\n//    ", "");
                for input in method.inputs {
                    let range = method.range(input, precision).words();
                    let said = match form {
                        HeaderForm::Full => format!("{}: {}, {range}", input.name, input.meaning),
                        // Coefficients stand together.
                        HeaderForm::Short if text.contains("; c0 to c") => {
                            format!(", coefficients, {range}")
                        }
                        HeaderForm::Short => format!("{}, {}, {range}", input.name, input.meaning),
                    };
                    assert!(text.contains(&said), "{}: {said}\n{text}", method.name);
                }
            }
        }
    }
}

/// Just before the critical angle the law is steep: how far f32 is off there.
#[test]
fn before_total_reflection_f32_is_off_by_what_the_header_says() {
    let function = library(methods::find("dielectric_exact").unwrap(), Precision::F32);
    let mut worst = 0.0f64;
    for i in 0..4000 {
        let eta = (0.25 + 0.749 * f64::from(i) / 4000.0) as f32;
        let past = beside_critical(eta, 1)[0];
        let cosines: Vec<f32> = (1..200)
            .map(|step| f32::from_bits(past.to_bits() + step))
            .collect();
        let wide: Vec<f64> = cosines.iter().map(|c| f64::from(*c)).collect();
        let colour = [f64::from(eta); 3];
        let got = evaluate::<f32>(
            &function,
            &[Value::each(cosines.clone()), Value::rgb(colour)],
        );
        let want = evaluate::<f64>(&function, &[Value::each(wide), Value::rgb(colour)]);
        for place in 0..cosines.len() {
            worst = worst.max((f64::from(got.at(place)[0]) - want.at(place)[0]).abs());
        }
    }
    println!("{worst}");
    assert!((0.005..0.01).contains(&worst), "{worst}");
}
