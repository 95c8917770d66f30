//! How far a text in unfused f32 is from the method's meaning in f64, over random inputs and the worst that are known.

use fresnel_gen::generator::fit::values;
use fresnel_gen::generator::reference::Derivation;
use fresnel_gen::lab::verify::{ABSOLUTE_FLOOR, Random, worst_media};
use fresnel_gen::language::ir::{Checked, Ty, Value, evaluate};
use fresnel_gen::language::methods::{Class, MediaSet, Method};
use fresnel_gen::physics::materials::Channels;

/// Random media, three channels each.
const MEDIA: usize = 400;
/// Cosines for each.
const COSINES: usize = 200;
/// A text means the same if no result in f64 differs by more.
const SAME: f64 = 1e-9;

/// What f32 may err at the ends of ranges, where the usual form errs less.
const END_SLACK: f64 = 1e-5;

/// A unit in the last place of results from 1/2 to 1.
const HALF_UNIT: f64 = 1.0 / (1u64 << 24) as f64;

/// What texts of a method are held against.
pub struct Judge {
    method: &'static Method,
    is_scalar: bool,
    /// The inputs of a run, rounded to f32, with its cosines and the method's results in f64.
    runs: Vec<Run>,
}

struct Run {
    inputs: Vec<[f32; 3]>,
    cosines: Vec<f32>,
    meaning: Vec<[f64; 3]>,
}

impl Judge {
    pub fn new(method: &'static Method, is_scalar: bool) -> Judge {
        let mut random = Random(5);
        let mut channels: Vec<(Channels, Vec<f32>)> = Vec::new();
        for _ in 0..MEDIA {
            let three = [0; 3].map(|_| medium(method, &mut random));
            let cosines = (0..COSINES).map(|place| match place % 3 {
                0 => random.unit() as f32,
                1 => f32::powf(10.0, -5.0 * random.unit() as f32),
                _ => 1.0 - f32::powf(10.0, -1.0 - 5.0 * random.unit() as f32),
            });
            let cosines: Vec<f32> = cosines.chain([0.0, 1.0]).collect();
            let of = Channels {
                n: three.map(|one| one.0),
                k: three.map(|one| one.1),
            };
            channels.push((of, cosines));
        }
        channels.extend(worst_media(method).map(|(of, cosine)| (of, vec![cosine])));
        let usual = method
            .function(is_scalar)
            .expect("every method is well formed");
        let mut judge = Judge {
            method,
            is_scalar,
            runs: Vec::new(),
        };
        for (of, cosines) in channels {
            let known = values(method, &of, &Derivation::default());
            let inputs = method.inputs.iter();
            let inputs: Vec<[f32; 3]> = inputs
                .map(|input| known[input.name].map(|value| value as f32))
                .collect();
            let arguments = judge.arguments::<f64>(&inputs, &cosines);
            let results = evaluate(&usual, &arguments);
            let meaning = (0..cosines.len()).map(|place| results.at(place)).collect();
            judge.runs.push(Run {
                inputs,
                cosines,
                meaning,
            });
        }
        judge
    }

    /// What the method promises, in units in the last place; where it promises no unit, in units of results from 1/2 to 1.
    pub fn promised(&self) -> f64 {
        match self.method.claims.code_ulp {
            0.0 => 4.0,
            ulp => ulp,
        }
    }

    fn arguments<N: fresnel_gen::physics::num::Num>(
        &self,
        inputs: &[[f32; 3]],
        cosines: &[f32],
    ) -> Vec<Value<N>> {
        let number = |c: &f32| N::from_f64(f64::from(*c));
        let cosines = Value::each(cosines.iter().map(number).collect());
        let input = |(input, value): (&fresnel_gen::language::methods::Input, &[f32; 3])| {
            let value = value.map(f64::from);
            match input.ty {
                Ty::Vec3 if !self.is_scalar => Value::rgb(value),
                _ => Value::scalar(value[0]),
            }
        };
        let rest = self.method.inputs.iter().zip(inputs).map(input);
        std::iter::once(cosines).chain(rest).collect()
    }

    /// Whether f32 is as good as the usual form's at the ends of every argument's range.
    pub fn holds_at_ends(&self, graph: &Checked, usual: &Checked) -> bool {
        let ends = self.method.inputs.iter().map(|input| {
            let usual = input.tried.first().copied().unwrap_or(1.0);
            [input.range.least, usual, input.range.most].map(|value| value as f32)
        });
        let sets = ends.fold(vec![Vec::new()], |sets: Vec<Vec<[f32; 3]>>, ends| {
            let longer = |set: Vec<[f32; 3]>| ends.map(|end| [&set[..], &[[end; 3]]].concat());
            sets.into_iter().flat_map(longer).collect()
        });
        let cosines = [0.0, 1e-6, 0.1, 0.5, 0.9, 1.0];
        sets.iter().all(|inputs| {
            let meaning = evaluate(usual, &self.arguments::<f64>(inputs, &cosines));
            let [single, usual] =
                [graph, usual].map(|of| evaluate(of, &self.arguments::<f32>(inputs, &cosines)));
            (0..cosines.len()).all(|place| {
                let off = |got: f32| (f64::from(got) - meaning.at(place)[0]).abs();
                off(single.at(place)[0]) <= END_SLACK.max(2.0 * off(usual.at(place)[0]))
            })
        })
    }

    /// The largest error in units in the last place, differences within the floor left out; none where the meaning is another.
    pub fn ulp(&self, graph: &Checked) -> Option<f64> {
        let channels = if self.is_scalar { 1 } else { 3 };
        let floor_only = self.method.claims.code_ulp == 0.0;
        let mut worst = 0.0f64;
        for run in &self.runs {
            let exact = evaluate(graph, &self.arguments::<f64>(&run.inputs, &run.cosines));
            let single = evaluate(graph, &self.arguments::<f32>(&run.inputs, &run.cosines));
            for (place, meaning) in run.meaning.iter().enumerate() {
                let (exact, single) = (exact.at(place), single.at(place));
                for ((want, exact), single) in meaning.iter().zip(exact).zip(single).take(channels)
                {
                    let off = (f64::from(single) - want).abs();
                    if off.is_nan() || (exact - want).is_nan() || (exact - want).abs() > SAME {
                        return None;
                    }
                    let unit = if floor_only { HALF_UNIT } else { unit(*want) };
                    if floor_only || off > ABSOLUTE_FLOOR {
                        worst = worst.max(off / unit);
                    }
                }
            }
        }
        Some(worst)
    }
}

/// The distance from a number to the next f32.
fn unit(value: f64) -> f64 {
    let single = value as f32;
    f64::from(single.next_up()) - f64::from(single)
}

/// A medium that the method's promise is of.
fn medium(method: &Method, random: &mut Random) -> (f64, f64) {
    let over = method.claims.code_over;
    let is_glass = method.class == Class::Dielectric;
    if over == MediaSet::Metals || !is_glass && random.unit() < 0.3 {
        return MediaSet::Metals.medium(random.unit(), random.unit());
    }
    let k_share = if is_glass { 0.0 } else { random.unit() };
    over.medium(random.unit(), k_share)
}
