//! What a scan varies: cosines, indices and other arguments, over their domains and past them.

use crate::language::methods::Input;
use crate::physics::num::Precision;

/// A quantity and the values at which it is tried, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanAxis {
    /// Its name, as functions have it.
    pub name: &'static str,
    /// The values, each once; numbers first, in order.
    pub values: Vec<f64>,
}

impl ScanAxis {
    fn new(name: &'static str, mut values: Vec<f64>) -> ScanAxis {
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| a.to_bits() == b.to_bits());
        ScanAxis { name, values }
    }

    /// The values as a precision has them, without those that it has not.
    pub fn rounded(&self, precision: Precision) -> ScanAxis {
        let all = self.values.iter().map(|x| precision.rounded(*x));
        ScanAxis::new(self.name, all.filter(|x| x.is_finite()).collect())
    }

    /// The same values, as many, each as a precision has it.
    pub fn each_rounded(mut self, precision: Precision) -> ScanAxis {
        self.values
            .iter_mut()
            .for_each(|x| *x = precision.rounded(*x));
        self
    }
}

/// From -1 to 8 ulp above 1: the edges with their neighbours, even in angle, logarithmic towards 0 and 1.
pub fn cosines() -> ScanAxis {
    let mut values: Vec<f64> = vec![-1.0, -0.5, -0.1, -1e-3, -1e-6, 0.5, 1.0 / 7.0];
    let ulp = f64::from(f32::EPSILON);
    values.extend((-8..=8).map(|step| 1.0 + ulp * f64::from(step)));
    let small =
        [0, 1, 2, 8, 71_362, 0x0080_0000, 0x0080_0001].map(|bits| f64::from(f32::from_bits(bits)));
    values.extend(small.iter().flat_map(|x| [*x, -x]));
    values.extend((0..=90).map(|degree| crate::physics::optics::cosine(f64::from(degree))));
    values.extend((81..90).map(|degree| crate::physics::optics::cosine(f64::from(degree) + 0.5)));
    values.extend((1..=30).map(|i| libm::exp2(-f64::from(i))));
    // Dense towards 1: the critical angle of a small index lies there.
    values.extend((8..=92).map(|i| 1.0 - libm::exp2(-0.25 * f64::from(i))));
    ScanAxis::new("cos_theta", values)
}

/// The same with thousands between them, for a function of the cosine alone.
pub fn dense() -> ScanAxis {
    let mut values = cosines().values;
    values.extend(
        crate::lab::verify::cosines(DENSE)
            .into_iter()
            .map(f64::from),
    );
    ScanAxis::new("cos_theta", values)
}

/// How many those are.
const DENSE: usize = 5000;

/// Numbers from `low` to `high` at equal ratios.
pub(super) fn logarithmic(low: f64, high: f64, steps: u32) -> impl Iterator<Item = f64> {
    let ratio = high / low;
    (0..=steps).map(move |i| low * libm::pow(ratio, f64::from(i) / f64::from(steps)))
}

/// An index from 1e-3 to 1e3: around 1 its neighbours and distances from 1e-7 to 0.3.
pub fn index(name: &'static str, decade: u32) -> ScanAxis {
    let ulp = f64::from(f32::EPSILON);
    let mut values = vec![1.0];
    values.extend((1..=2).flat_map(|step| {
        [
            1.0 + ulp * f64::from(step),
            1.0 - 0.5 * ulp * f64::from(step),
        ]
    }));
    values.extend(logarithmic(1e-3, 1e3, 6 * decade));
    let near: Vec<f64> = logarithmic(1e-6, 0.3, 6 * decade / 2).collect();
    values.extend(near.iter().flat_map(|d| [1.0 + d, 1.0 - d]));
    ScanAxis::new(name, values)
}

/// An extinction coefficient above 0: subnormal, and from 1e-30 to 1e4.
pub fn extinction() -> ScanAxis {
    let mut values = vec![
        f64::from(f32::from_bits(1)),
        1e-41,
        1.2e-38,
        1e-30,
        1e-20,
        1e-12,
        1e-8,
    ];
    values.extend(logarithmic(1e-6, 1e4, 40));
    ScanAxis::new("k", values)
}

/// What a method's argument may be given, within its domain and past it.
pub fn argument(input: &Input) -> ScanAxis {
    ScanAxis::new(input.name, input.scanned.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_their_edges_in_order() {
        for axis in [
            cosines(),
            index("eta", 20),
            extinction(),
            argument(&Input::F0),
        ] {
            assert!(axis.values.is_sorted_by(|a, b| a <= b), "{}", axis.name);
        }
        let ulp = f64::from(f32::EPSILON);
        assert_eq!(cosines().values.last(), Some(&(1.0 + 8.0 * ulp)));
        assert_eq!(cosines().values[0], -1.0);
        assert!(index("n", 8).values.contains(&(1.0 + ulp)));
        assert_eq!(extinction().values[0], f64::from(f32::from_bits(1)));
    }
}
