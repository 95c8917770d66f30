//! A trial of an effect's function: points of its domain and its corners, and what is expected there.
//!
//! Directions come close to the critical angle and look-ups to the edges of texels, where a last bit of an argument turns the result by
//! much. So a result is held against what f64 gives at arguments that differ by some last bits, and at places in textures that
//! differ by a step of a sampler's weights, 1/256 of a texel: it may lie anywhere between those, and its error is how far it lies
//! outside.

use crate::generator::emit::{EffectPart, Emitted};
use crate::language::ir::{Checked, Column, Param, Ty, Value, evaluate};
use crate::physics::num::each_channel;
use super::effect_points::{CORNERS_FROM, CRITICAL_FROM, TEXELS, argument_at, bring_to_critical_angle, cube, flat, input_at, share, texels};

/// Points of a trial.
const POINTS: usize = 2048;
/// How often arguments are disturbed.
const DISTURBED: usize = 16;
/// By how much: a share of the argument, which is two to four units in its last place of f32, and a unit of numbers from 1 to 2.
/// Headers of effects state both.
const RELATIVE: f64 = 1.0 / (1 << 22) as f64;
const ABSOLUTE: f64 = 1.0 / (1 << 23) as f64;
/// Where nothing is promised: how many times as far off as f32 here a result may be, and how far at least.
const ROOM: f64 = 2.0;
const LEAST: f64 = 2e-7;
/// A sampler's weights are whole so many parts of a texel.
const WEIGHTS: f64 = 256.0;

/// The points of a function and its textures.
pub struct EffectTrial {
    params: Vec<Param>,
    function: Checked,
    /// For each point the numbers of each argument.
    points: Vec<Vec<Vec<f32>>>,
    /// What its two-dimensional texture holds, four numbers a texel, row by row; of a cube its six sides.
    pub texels: Vec<[f32; 4]>,
}

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectOutcome {
    /// How many points there were.
    pub points: usize,
    /// The largest error, of results above 1 as a share of them.
    pub max_abs: f64,
    /// The arguments of the largest error, and what came.
    pub worst: String,
}

impl EffectTrial {
    /// The trial of a function; inputs of its method take these values, one set after the other.
    pub fn new(
        emitted: &Emitted,
        part: EffectPart,
        values: &[Vec<(String, [f64; 3])>],
    ) -> EffectTrial {
        let params = emitted.function.params.clone();
        let point = |index: usize| {
            let numbers = params.iter().enumerate().map(|(place, param)| {
                let mut own = part.function.arguments.iter();
                match own.find(|own| own.name == param.name) {
                    Some(argument) => argument_at(argument, index, place),
                    None => input_at(param, index, values),
                }
            });
            let mut numbers: Vec<Vec<f32>> = numbers.collect();
            if (CRITICAL_FROM..CORNERS_FROM).contains(&index) {
                bring_to_critical_angle(&params, part, index, &mut numbers);
            }
            numbers
        };
        EffectTrial {
            texels: texels(&params),
            points: (0..POINTS).map(point).collect(),
            function: emitted.function.clone(),
            params,
        }
    }

    /// The places of four numbers of all points, as a program of many arguments takes them.
    pub fn places(&self) -> Vec<[f32; 4]> {
        let mut places = Vec::new();
        for arguments in &self.points {
            for four in arguments.iter().flat_map(|numbers| numbers.chunks(4)) {
                let mut place = [0.0; 4];
                place[..four.len()].copy_from_slice(four);
                places.push(place);
            }
            if arguments.iter().all(Vec::is_empty) {
                places.push([0.0; 4]);
            }
        }
        places
    }

    /// Judges results, one a point.
    pub fn judge(&self, got: &[[f32; 3]]) -> EffectOutcome {
        self.judge_where(got, |_| true)
    }

    /// Judges results where nothing is promised, and says what is allowed: they may be twice as far off as those of f32 here, as far as these
    /// are numbers.
    pub fn judge_without_promise(&self, got: &[[f32; 3]]) -> (EffectOutcome, f64) {
        let (single, meant) = (self.in_single(), self.meant(0));
        let is_known = |point: usize| {
            let meant: [f64; 3] = meant.at(point);
            single[point].iter().all(|x| x.is_finite()) && meant.iter().all(|x| x.is_finite())
        };
        let own = self.judge_where(&single, is_known).max_abs;
        (self.judge_where(got, is_known), ROOM * own + LEAST)
    }

    fn judge_where(&self, got: &[[f32; 3]], is_judged: impl Fn(usize) -> bool) -> EffectOutcome {
        let results: Vec<Value<f64>> = (0..=DISTURBED).map(|round| self.meant(round)).collect();
        let mut outcome = EffectOutcome {
            points: got.len(),
            max_abs: 0.0,
            worst: String::new(),
        };
        for (point, got) in got
            .iter()
            .enumerate()
            .filter(|(point, _)| is_judged(*point))
        {
            let all: Vec<[f64; 3]> = results.iter().map(|result| result.at(point)).collect();
            let outside = each_channel(|i: usize| {
                let values = all.iter().map(|value| value[i]);
                let least = values.clone().fold(f64::INFINITY, f64::min);
                let most = values.fold(f64::NEG_INFINITY, f64::max);
                let got = f64::from(got[i]);
                if got.is_finite() {
                    (least - got).max(got - most).max(0.0)
                } else {
                    f64::INFINITY
                }
            });
            let largest = all[0].iter().fold(1.0, |most, x| f64::max(most, x.abs()));
            let error = outside.into_iter().fold(0.0, f64::max) / largest;
            if error > outcome.max_abs {
                outcome.max_abs = error;
                outcome.worst = self.told(point, *got, all[0]);
            }
        }
        outcome
    }

    /// What f32 gives at the points.
    pub fn in_single(&self) -> Vec<[f32; 3]> {
        let arguments: Vec<Value<f32>> = self.arguments(0, |x| x as f32);
        let result = evaluate(&self.function, &arguments);
        (0..self.points.len()).map(|i| result.at(i)).collect()
    }

    /// What f64 gives at arguments that are disturbed; as they are in round 0.
    fn meant(&self, round: usize) -> Value<f64> {
        evaluate(&self.function, &self.arguments(round, |x| x))
    }

    fn arguments<N: Copy>(&self, round: usize, number: impl Fn(f64) -> N) -> Vec<Value<N>> {
        let column = |place: usize, component: usize| {
            let values = self.points.iter().enumerate().map(|(point, arguments)| {
                let value = f64::from(arguments[place][component]);
                let seed = (point * 37 + place) * 17 + component;
                number(self.disturbed(place, component, value, round, seed))
            });
            Column::Each(values.collect())
        };
        let argument = |(place, param): (usize, &Param)| match param.ty {
            Ty::Texture => Value::Texture(Some(flat(&self.texels))),
            Ty::Cube => Value::Cube(Some(cube(&self.texels))),
            Ty::Rgb => Value::Rgb([0, 1, 2].map(|component| column(place, component))),
            Ty::Scalar | Ty::Bool => Value::Scalar(column(place, 0)),
            ty => Value::Many((0..ty.channels()).map(|c| column(place, c)).collect()),
        };
        self.params.iter().enumerate().map(argument).collect()
    }

    /// An argument of a round, by some last bits off; where a texture is read, by a step of its weights too.
    fn disturbed(
        &self,
        place: usize,
        component: usize,
        value: f64,
        round: usize,
        seed: usize,
    ) -> f64 {
        if round == 0 {
            return value;
        }
        let sign = 2.0 * share(seed, round) - 1.0;
        let last_bits = value.abs() * RELATIVE + ABSOLUTE * f64::from(value != 0.0);
        let reads = self.params.iter().find(|param| param.ty.is_sampled());
        let texel = match (reads, self.params[place].ty) {
            (Some(_), Ty::Vec2) => 1.0 / TEXELS as f64,
            (Some(_), Ty::Vec4) if component >= 2 => 1.0 / TEXELS as f64,
            _ => 0.0,
        };
        value + sign * (last_bits + texel / WEIGHTS)
    }

    fn told(&self, point: usize, got: [f32; 3], want: [f64; 3]) -> String {
        let arguments = self.params.iter().zip(&self.points[point]);
        let told = arguments.filter(|(_, numbers)| !numbers.is_empty());
        let told = told.map(|(param, numbers)| format!("{} = {numbers:?}", param.name));
        let told: Vec<String> = told.collect();
        format!("at {} it is {got:?}, expected {want:?}", told.join(", "))
    }
}
