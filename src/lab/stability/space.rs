//! The spaces that a method is scanned over, and their axes: cosines, indices and other arguments, over their domains and beyond.

use super::failure::is_flushed;
use crate::generator::fit::values;
use crate::generator::reference::Derivation;
use crate::language::methods::{Class, Input, Method};
use crate::physics::materials::Channels;
use crate::physics::num::Precision;
use crate::physics::optics;

/// A space: its axes, and the meaning of its points.
#[derive(Clone, Debug)]
pub struct ScanSpace {
    /// Whether its points are media, which have a law. Otherwise they are the method's arguments themselves.
    pub is_media: bool,
    /// The axes, without the cosines.
    pub axes: Vec<ScanAxis>,
    /// The cosines.
    pub cosines: ScanAxis,
}

/// The spaces of a method, with values rounded to a precision.
pub fn spaces(method: &Method, precision: Precision) -> Vec<ScanSpace> {
    let mut all: Vec<(bool, Vec<ScanAxis>)> = Vec::new();
    if method.class != Class::Metal {
        all.push((true, vec![index("eta", 40)]));
    }
    if method.class != Class::Dielectric {
        all.push((true, vec![index("n", 12), extinction()]));
    }
    all.push((false, method.inputs.iter().map(argument).collect()));
    let space = |(is_media, axes): (bool, Vec<ScanAxis>)| ScanSpace {
        is_media,
        axes: axes.iter().map(|axis| axis.rounded(precision)).collect(),
        cosines: cosines().rounded(precision),
    };
    all.into_iter().map(space).collect()
}

/// A point of a space without the cosine.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanPoint {
    /// The method's arguments after the cosine, rounded.
    pub arguments: Vec<f64>,
    /// The medium, where there is one.
    pub medium: Option<(f64, f64)>,
    /// The largest allowed result.
    pub limit: f64,
}

impl ScanSpace {
    /// The number of its points, without the cosines.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// The values of a point, one for each axis.
    pub fn at(&self, mut index: usize) -> Vec<f64> {
        let mut values = vec![0.0; self.axes.len()];
        for (value, axis) in values.iter_mut().zip(&self.axes).rev() {
            *value = axis.values[index % axis.values.len()];
            index /= axis.values.len();
        }
        values
    }

    /// The point at an index, for a method.
    pub fn point(&self, method: &Method, index: usize, precision: Precision) -> ScanPoint {
        let at = self.at(index);
        if !self.is_media {
            let limit = limit(method.inputs, &at);
            return ScanPoint {
                arguments: at,
                medium: None,
                limit,
            };
        }
        let medium = (at[0], at.get(1).copied().unwrap_or(0.0));
        let arguments = arguments(method, medium).into_iter();
        ScanPoint {
            arguments: arguments.map(|x| precision.rounded(x)).collect(),
            medium: Some(medium),
            limit: 1.0,
        }
    }
}

/// A method's arguments for a medium.
fn arguments(method: &Method, (n, k): (f64, f64)) -> Vec<f64> {
    let channels = Channels {
        n: [n; 3],
        k: [k; 3],
    };
    let values = values(method, &channels, &Derivation::default());
    let inputs = method.inputs.iter();
    inputs.map(|input| values[input.name][0]).collect()
}

/// The largest result by the function contract: 1, or an F0 above 1.
fn limit(inputs: &[Input], at: &[f64]) -> f64 {
    let inputs = inputs.iter().zip(at);
    let raised = inputs.filter(|(input, _)| input.raises_limit);
    raised.fold(1.0, |limit, (_, value)| limit.max(*value))
}

/// Below this k a medium reflects as if it absorbed nothing, and an approximation has been compared with the law at k = 0 already.
const ABSORBS: f64 = 0.1;

/// Whether a method is compared with the law for this medium. An exact one always is, unless k may be flushed to 0.
pub fn is_lawful(method: &Method, (_, k): (f64, f64)) -> bool {
    let is_exact = method.claims.model.iter().all(|claim| claim.max_abs == 0.0);
    !is_flushed(k) && (is_exact || k == 0.0 || k >= ABSORBS)
}

/// The reflectance of a medium by the law, in the polarisation of a method.
pub fn law(method: &Method, (n, k): (f64, f64), cos_theta: f64) -> f64 {
    use crate::language::methods::Light;
    let reflectance = optics::conductor(n, k, cos_theta);
    match method.light {
        Light::Unpolarised => reflectance.unpolarised(),
        Light::S => reflectance.s,
        Light::P => reflectance.p,
    }
}

/// A quantity and its scanned values, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanAxis {
    /// Its name as an argument of functions.
    pub name: &'static str,
    /// The values, each once. Numbers come first, in order.
    pub values: Vec<f64>,
}

impl ScanAxis {
    fn new(name: &'static str, mut values: Vec<f64>) -> ScanAxis {
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| a.to_bits() == b.to_bits());
        ScanAxis { name, values }
    }

    /// The values rounded to a precision, each once, without those beyond its range.
    pub fn rounded(&self, precision: Precision) -> ScanAxis {
        let all = self.values.iter().map(|x| precision.rounded(*x));
        ScanAxis::new(self.name, all.filter(|x| x.is_finite()).collect())
    }

    /// The same number of values, each rounded to a precision.
    pub fn each_rounded(mut self, precision: Precision) -> ScanAxis {
        for x in &mut self.values {
            *x = precision.rounded(*x);
        }
        self
    }
}

/// Cosines from -1 to 8 ulp above 1: the edges with their neighbours, even in angle, logarithmic towards 0 and 1.
pub fn cosines() -> ScanAxis {
    let mut values: Vec<f64> = vec![-1.0, -0.5, -0.1, -1e-3, -1e-6, 0.5, 1.0 / 7.0];
    let ulp = f64::from(f32::EPSILON);
    values.extend((-8..=8).map(|step| 1.0 + ulp * f64::from(step)));
    let small =
        [0, 1, 2, 8, 71_362, 0x0080_0000, 0x0080_0001].map(|bits| f64::from(f32::from_bits(bits)));
    values.extend(small.iter().flat_map(|x| [*x, -x]));
    values.extend((0..=90).map(|degree| optics::cosine(f64::from(degree))));
    values.extend((81..90).map(|degree| optics::cosine(f64::from(degree) + 0.5)));
    values.extend((1..=30).map(|i| libm::exp2(-f64::from(i))));
    // Dense towards 1: the critical angle of a small index lies there.
    values.extend((8..=92).map(|i| 1.0 - libm::exp2(-0.25 * f64::from(i))));
    ScanAxis::new("cos_theta", values)
}

/// As [`cosines`] with thousands between them, for a function of the cosine alone.
pub fn dense() -> ScanAxis {
    let mut values = cosines().values;
    let between = crate::lab::verify::cosines(DENSE).into_iter();
    values.extend(between.map(f64::from));
    ScanAxis::new("cos_theta", values)
}

/// The number of cosines that [`dense`] adds.
const DENSE: usize = 5000;

/// Numbers from `low` to `high` in geometric progression.
pub(super) fn logarithmic(low: f64, high: f64, steps: u32) -> impl Iterator<Item = f64> {
    let ratio = high / low;
    (0..=steps).map(move |i| low * libm::pow(ratio, f64::from(i) / f64::from(steps)))
}

/// An index from 1e-3 to 1e3. Around 1 there are its neighbours and distances from 1e-7 to 0.3.
pub fn index(name: &'static str, decade: u32) -> ScanAxis {
    let ulp = f64::from(f32::EPSILON);
    let mut values = vec![1.0];
    values.extend([1.0, 2.0].map(|step| 1.0 + ulp * step));
    values.extend([0.5, 1.0].map(|step| 1.0 - ulp * step));
    values.extend(logarithmic(1e-3, 1e3, 6 * decade));
    let near: Vec<f64> = logarithmic(1e-6, 0.3, 6 * decade / 2).collect();
    values.extend(near.iter().flat_map(|d| [1.0 + d, 1.0 - d]));
    ScanAxis::new(name, values)
}

/// An extinction coefficient above 0: subnormal, and from 1e-30 to 1e4.
pub fn extinction() -> ScanAxis {
    let mut values = vec![f64::from(f32::from_bits(1))];
    values.extend([1e-41, 1.2e-38, 1e-30, 1e-20, 1e-12, 1e-8]);
    values.extend(logarithmic(1e-6, 1e4, 40));
    ScanAxis::new("k", values)
}

/// The values of a method's argument, within its domain and beyond.
pub fn argument(input: &Input) -> ScanAxis {
    ScanAxis::new(input.name, input.scanned.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_their_edges_in_order() {
        let f0 = argument(&Input::F0);
        for axis in [cosines(), index("eta", 20), extinction(), f0] {
            assert!(axis.values.is_sorted_by(|a, b| a <= b), "{}", axis.name);
        }
        let ulp = f64::from(f32::EPSILON);
        assert_eq!(cosines().values.last(), Some(&(1.0 + 8.0 * ulp)));
        assert_eq!(cosines().values[0], -1.0);
        assert!(index("n", 8).values.contains(&(1.0 + ulp)));
        assert_eq!(extinction().values[0], f64::from(f32::from_bits(1)));
    }
}
