//! Trials: a function with the values of its arguments, compared with what it means in f64 at the same inputs.
//!
//! Code error is a function in unfused f32 against itself in f64, at the same f32 inputs. It is never added to model error.

use crate::generator::fit::Measured;
use crate::language::ir::{Checked, Column, Op, Param, Texels, Ty, Value, evaluate};
use crate::physics::num::{Num, VulkanTolerance, each_channel, ulp_distance};

/// A function to try, and what it promises.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The function as its text computes it.
    pub function: Checked,
    /// The values of its arguments after `cos_theta`, without the texture. A scalar is the first number.
    pub values: Vec<[f32; 3]>,
    /// The texture that it reads.
    pub table: Option<Texels>,
    /// Its promise in ulp, or the reason why there is none. Without a promise it must come near what unfused f32 gives.
    pub bound: Measured<f64>,
    /// Absolute differences up to this are no error, whatever they are in ulp: [`ABSOLUTE_FLOOR`], or what coefficients promise.
    pub floor: f64,
    /// Whether it keeps the contract. If so it is tried beyond [0, 1] too, otherwise not at 0.
    pub is_guarded: bool,
}

/// What is expected at some cosines.
#[derive(Clone, Debug)]
pub struct Expected {
    /// The cosines.
    pub cosines: Vec<f32>,
    /// The results in f64.
    want: Value<f64>,
    /// By how much each may be off in addition to the promise in ulp: the tolerance of a sampler's weights or a GPU's powers.
    slack: Option<Value<f64>>,
    /// The promise in ulp.
    pub bound: f64,
    /// Differences up to this are no error, whatever they are in ulp.
    floor: f64,
    /// The smallest and the largest of these results, with 0 and 1. For a NaN cosine any value between them is right.
    pub(super) range: [f64; 2],
}

/// A result that is too far off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// The input.
    pub cos_theta: f32,
    /// 0 for red, 1 for green, 2 for blue.
    pub channel: usize,
    /// The result.
    pub got: f32,
    /// The expected result.
    pub expected: f64,
    /// Their distance in ulp.
    pub ulp: f64,
}

/// The result of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The largest differences.
    pub error: CodeError,
    /// The result that is furthest beyond what is allowed.
    pub miss: Option<Miss>,
}

/// Where nothing is promised, a result may be this many times as far off as in unfused f32 here: a formula that loses digits loses
/// others with another root or another order of operations.
const ROOM: f64 = 2.0;
/// The steps of a sampler's weights.
const WEIGHTS: f64 = 256.0;
/// Below this cosine a textbook form promises nothing.
pub(super) const TEXTBOOK_FROM: f32 = 1e-6;

impl Trial {
    /// What the function means at these cosines, in any kind of number.
    pub fn run<N: Num>(&self, cosines: &[f32]) -> Value<N> {
        self.run_with(self.table.as_ref(), cosines)
    }

    fn run_with<N: Num>(&self, table: Option<&Texels>, cosines: &[f32]) -> Value<N> {
        let arguments = arguments(&self.function, &self.values, table, cosines);
        evaluate(&self.function, &arguments)
    }

    /// What is expected at these cosines. Those at which nothing is promised are left out.
    pub fn expected(&self, cosines: &[f32]) -> Expected {
        let is_inside = |c: &f32| self.is_guarded || (TEXTBOOK_FROM..=1.0).contains(c);
        let cosines: Vec<f32> = cosines.iter().copied().filter(is_inside).collect();
        let want = self.run::<f64>(&cosines);
        let mut expected = self.expected_of(cosines, want);
        match self.bound {
            Measured::Yes(ulp) => expected.bound = ulp,
            Measured::No(_) => {
                expected.bound = self.unfused(&expected);
                expected.floor = ROOM * self.floor;
            }
        }
        expected
    }

    /// What is expected where the results in f64 are known. There is no bound in ulp yet.
    pub(super) fn expected_of(&self, cosines: Vec<f32>, want: Value<f64>) -> Expected {
        Expected {
            slack: self.slack(&cosines, &want),
            range: result_range(&cosines, &want),
            want,
            bound: f64::INFINITY,
            floor: self.floor,
            cosines,
        }
    }

    /// The error of unfused f32 at these points in [0, 1], in ulp, with some room. Beyond [0, 1] results are those of the ends.
    fn unfused(&self, expected: &Expected) -> f64 {
        let mut error = CodeError::NONE;
        let got = self.run::<f32>(&expected.cosines);
        for (point, cos_theta) in expected.cosines.iter().enumerate() {
            if (0.0..=1.0).contains(cos_theta) {
                for (got, want) in got.at(point).into_iter().zip(expected.want.at(point)) {
                    error.include(got, want, *cos_theta, ABSOLUTE_FLOOR);
                }
            }
        }
        ROOM * error.max_ulp
    }

    fn slack(&self, cosines: &[f32], want: &Value<f64>) -> Option<Value<f64>> {
        if let Some(table) = &self.table {
            let steps = self.run_with(Some(&steps(table)), cosines);
            return Some(each(cosines.len(), |i| {
                steps.at(i).map(|step: f64| step / WEIGHTS)
            }));
        }
        let has_power = [Op::Exp2, Op::Log2]
            .iter()
            .any(|op| self.function.count(*op) > 0);
        has_power.then(|| {
            let off = [
                self.off::<VulkanTolerance<1, 1>>(cosines, want),
                self.off::<VulkanTolerance<1, -1>>(cosines, want),
                self.off::<VulkanTolerance<-1, 1>>(cosines, want),
                self.off::<VulkanTolerance<-1, -1>>(cosines, want),
            ];
            each(cosines.len(), |i| {
                off.iter().fold([0.0; 3], |most, off| {
                    each_channel(|channel| f64::max(most[channel], off[i][channel]))
                })
            })
        })
    }

    /// The absolute differences of this kind of number from `want`.
    fn off<N: Num>(&self, cosines: &[f32], want: &Value<f64>) -> Vec<[f64; 3]> {
        let got = self.run::<N>(cosines);
        let off = |i: usize| {
            let (got, want) = (got.at(i), want.at(i));
            each_channel(|channel| (got[channel].to_f64() - want[channel]).abs())
        };
        (0..cosines.len()).map(off).collect()
    }
}

/// The arguments of a function at these cosines, in any kind of number. `values` are those after the cosine, without textures.
pub(super) fn arguments<N: Num>(
    function: &Checked,
    values: &[[f32; 3]],
    table: Option<&Texels>,
    cosines: &[f32],
) -> Vec<Value<N>> {
    let number = |c: &f32| N::from_f64(f64::from(*c));
    let mut values = values.iter().map(|value| value.map(f64::from));
    let mut value = |param: &Param| match param.ty {
        Ty::Texture => Value::Texture(table.cloned()),
        Ty::Vec3 => Value::rgb(values.next().unwrap_or_default()),
        _ if param.is_cosine() => Value::each(cosines.iter().map(number).collect()),
        _ => Value::scalar(values.next().unwrap_or_default()[0]),
    };
    function.params.iter().map(&mut value).collect()
}

/// The largest difference of each texel to a neighbour. The error of a sampler's weights is a share of it.
fn steps(table: &Texels) -> Texels {
    let texel = |row: usize, i: usize| table.texels[row * table.width + i.min(table.width - 1)];
    let step = |at: usize| {
        let (row, i) = (at / table.width, at % table.width);
        let (here, before, after) = (texel(row, i), texel(row, i.max(1) - 1), texel(row, i + 1));
        each_channel(|c: usize| (here[c] - before[c]).abs().max((here[c] - after[c]).abs()))
    };
    Texels {
        width: table.width,
        texels: (0..table.texels.len()).map(step).collect(),
        alpha: None,
        filter: table.filter,
    }
}

fn each(points: usize, at: impl Fn(usize) -> [f64; 3]) -> Value<f64> {
    let values: Vec<[f64; 3]> = (0..points).map(at).collect();
    let channel = |i: usize| Column::Each(values.iter().map(|value| value[i]).collect());
    Value::Rgb(each_channel(channel))
}

impl Expected {
    /// Judges results, one for each cosine.
    pub fn judge(&self, got: &[[f32; 3]]) -> Outcome {
        let mut outcome = Outcome::NONE;
        for (point, (cos_theta, got)) in self.cosines.iter().zip(got).enumerate() {
            let want = self.want.at(point);
            let slack = self
                .slack
                .as_ref()
                .map_or([0.0; 3], |slack| slack.at(point));
            for channel in 0..3 {
                let (got, want) = (
                    got[channel],
                    self.expected_value(*cos_theta, got[channel], want[channel]),
                );
                outcome.error.include(got, want, *cos_theta, ABSOLUTE_FLOOR);
                if !self.allows(got, want, slack[channel]) {
                    outcome.add(Miss {
                        cos_theta: *cos_theta,
                        channel,
                        got,
                        expected: want,
                        ulp: ulp_distance(got, want),
                    });
                }
            }
        }
        outcome
    }

    /// The expected value. For a NaN cosine every value of the range is right, and the nearest one is expected.
    fn expected_value(&self, cos_theta: f32, got: f32, want: f64) -> f64 {
        let [least, most] = self.range;
        match (cos_theta.is_nan(), got.is_nan()) {
            (false, _) => want,
            (true, true) => least,
            (true, false) => f64::from(got).clamp(least, most),
        }
    }

    fn allows(&self, got: f32, want: f64, slack: f64) -> bool {
        let difference = (f64::from(got) - want).abs();
        let has_no_bound = self.bound == f64::INFINITY;
        has_no_bound || difference <= self.floor + slack || ulp_distance(got, want) <= self.bound
    }
}

/// The smallest and the largest result at cosines that are not NaN, with 0 and 1.
pub fn result_range(cosines: &[f32], want: &Value<f64>) -> [f64; 2] {
    let points = (0..cosines.len()).filter(|i| !cosines[*i].is_nan());
    let results = points.flat_map(|i| want.at(i));
    results.fold([0.0, 1.0], |[least, most], result| {
        [least.min(result), most.max(result)]
    })
}

impl Outcome {
    /// The outcome without differences.
    pub const NONE: Outcome = Outcome {
        error: CodeError::NONE,
        miss: None,
    };

    /// The worse of two outcomes.
    pub fn worst(self, other: Outcome) -> Outcome {
        let mut both = Outcome {
            error: self.error.worst(other.error),
            miss: self.miss,
        };
        if let Some(miss) = other.miss {
            both.add(miss);
        }
        both
    }

    /// Keeps the miss with the larger absolute difference, which is the more visible one.
    fn add(&mut self, miss: Miss) {
        let size = |miss: &Miss| {
            let off = (f64::from(miss.got) - miss.expected).abs();
            if off.is_nan() { f64::INFINITY } else { off }
        };
        if self.miss.is_none_or(|known| size(&miss) > size(&known)) {
            self.miss = Some(miss);
        }
    }
}

/// How far the code is from what it means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodeError {
    /// Largest distance in ulp. Differences within [`ABSOLUTE_FLOOR`] do not count.
    pub max_ulp: f64,
    /// Largest absolute difference.
    pub max_abs: f64,
    /// The cosine of the largest distance in ulp.
    pub worst_cos: f64,
}

/// 2⁻²². Near a zero (Brewster's angle, the corrected method) an error in ulp has no bound, so a floor is needed.
pub const ABSOLUTE_FLOOR: f64 = 1.0 / 4_194_304.0;

impl CodeError {
    /// No difference.
    pub const NONE: CodeError = CodeError {
        max_ulp: 0.0,
        max_abs: 0.0,
        worst_cos: 0.0,
    };

    /// Includes a result. Differences up to `floor` do not count in ulp.
    pub fn include(&mut self, got: f32, want: f64, cos_theta: f32, floor: f64) {
        let difference = (f64::from(got) - want).abs();
        self.max_abs = self.max_abs.max(difference);
        let ulp = ulp_distance(got, want);
        let counts = difference.is_nan() || difference > floor;
        if counts && ulp > self.max_ulp {
            (self.max_ulp, self.worst_cos) = (ulp, f64::from(cos_theta));
        }
    }

    /// The larger of two.
    #[must_use]
    pub fn worst(self, other: CodeError) -> CodeError {
        let max_abs = self.max_abs.max(other.max_abs);
        let worse = if other.max_ulp > self.max_ulp {
            other
        } else {
            self
        };
        CodeError { max_abs, ..worse }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods;

    fn trial(name: &str, values: &[[f32; 3]]) -> Trial {
        let method = methods::find(name).unwrap();
        Trial {
            function: method.function(false).unwrap(),
            values: values.to_vec(),
            table: None,
            bound: Measured::Yes(method.claims.code_ulp),
            floor: ABSOLUTE_FLOOR,
            is_guarded: true,
        }
    }

    #[test]
    fn what_f32_gives_passes_and_what_is_off_is_a_miss() {
        let trial = trial("schlick", &[[0.04, 0.5, 1.0]]);
        let expected = trial.expected(&[-1.0, 0.0, 0.3, 1.0, 1.5]);
        let got = trial.run::<f32>(&expected.cosines);
        let mut got: Vec<[f32; 3]> = (0..5).map(|i| got.at(i)).collect();
        assert_eq!(expected.judge(&got).miss, None);
        got[2][1] *= 1.001;
        let miss = expected.judge(&got).miss.unwrap();
        assert_eq!((miss.cos_theta, miss.channel), (0.3, 1));
        got[4][2] = f32::NAN;
        assert!(expected.judge(&got).miss.unwrap().got.is_nan());
    }

    #[test]
    fn for_nan_any_reflectance_is_right_and_nan_is_not() {
        let trial = trial("schlick", &[[0.04, 0.5, 1.2]]);
        let expected = trial.expected(&[f32::NAN, 0.0, 1.0, f32::INFINITY]);
        let ends = [[1.0, 1.0, 1.0], [0.04, 0.5, 1.2], [0.04, 0.5, 1.2]];
        let judge = |first: [f32; 3]| expected.judge(&[&[first], &ends[..]].concat()).miss;
        assert_eq!(judge([0.0, 0.7, 1.2]), None);
        assert_eq!(judge([0.0, 1.3, 1.0]).unwrap().channel, 1);
        assert!(judge([0.0, 0.5, f32::NAN]).unwrap().got.is_nan());
        assert_eq!(judge([-0.1, 0.5, 1.0]).unwrap().channel, 0);
    }

    #[test]
    fn powers_get_what_vulkan_allows_and_no_more() {
        let trial = trial("schlick_generalised", &[[0.04; 3], [1.0; 3], [5.0; 3]]);
        let expected = trial.expected(&[0.5]);
        // 5 · 2⁻²¹ of log2 near 1 and 3 + 2·5 ulp of exp2, in a term of 0.03.
        let slack = expected.slack.as_ref().unwrap().at(0)[0];
        assert!(slack > 2e-8 && slack < 2e-7, "{slack}");
    }
}
