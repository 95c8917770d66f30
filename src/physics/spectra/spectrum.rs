//! A spectrum: values at some wavelengths, linear in between, nothing outside.
//!
//! It is summed over 380 to 780 nm with both ends. The eye sees little beyond them. Summing 400 to 700 nm instead changes the colour
//! of no measured metal by more than 9e-4, and 380 to 780 nm holds all but 5 parts in a million of the sum of ȳ.

use std::ops::{Add, Mul, Sub};

/// Values by ascending wavelength. `V` is a number or several, such as the three functions of an observer, or n and k.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum<V> {
    points: Vec<(f64, V)>,
}

impl<V> Spectrum<V>
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    /// From pairs of wavelength in nm and value. None when there are none, or when a wavelength is not finite or does
    /// not exceed the one before.
    pub fn new(points: Vec<(f64, V)>) -> Option<Spectrum<V>> {
        let ascends = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let finite = points.iter().all(|(nm, _)| nm.is_finite());
        (ascends && finite && !points.is_empty()).then_some(Spectrum { points })
    }

    /// Pairs of wavelength in nm and value.
    pub fn points(&self) -> &[(f64, V)] {
        &self.points
    }

    /// The first and the last wavelength in nm.
    pub fn range(&self) -> (f64, f64) {
        (self.points[0].0, self.points[self.points.len() - 1].0)
    }

    /// The value at a wavelength in nm: as given there, linear between two, None outside.
    pub fn at(&self, nm: f64) -> Option<V> {
        let after = self.points.partition_point(|point| point.0 < nm);
        let high = *self.points.get(after)?;
        if high.0 == nm {
            return Some(high.1);
        }
        let low = self.points[after.checked_sub(1)?];
        let share = (nm - low.0) / (high.0 - low.0);
        // None for a NaN, which is neither above nor below any wavelength.
        (share > 0.0).then(|| low.1 + (high.1 - low.1) * share)
    }

    /// The mean about a wavelength in nm, with weights that fall linearly from 1 there to 0 at this distance on both sides. A sum
    /// in steps of that width then includes all that lies between its wavelengths. None where no value lies within the distance.
    pub fn mean_about(&self, nm: f64, distance: f64) -> Option<V> {
        let (first, last) = self.range();
        let (from, to) = ((nm - distance).max(first), (nm + distance).min(last));
        if from > to {
            return None;
        }
        let start = self.points.partition_point(|point| point.0 <= from);
        let inside = self.points[start..].iter().map(|point| point.0);
        let mut ends: Vec<f64> = inside.take_while(|at| *at < to).collect();
        ends.extend([from, to, nm.clamp(from, to)]);
        ends.sort_by(f64::total_cmp);
        let weight = |at: f64| (1.0 - (at - nm).abs() / distance).max(0.0);
        // Value and weight are linear in each part, so that Simpson's rule is exact.
        let parts = ends.windows(2).filter_map(|part| {
            let [a, b] = [part[0], part[1]];
            let middle = a + (b - a) / 2.0;
            let shares = [(a, 1.0), (middle, 4.0), (b, 1.0)]
                .map(|(at, times)| (at, times * weight(at) * (b - a)));
            let [low, mid, high] = shares;
            let sum = self.at(low.0)? * low.1 + self.at(mid.0)? * mid.1 + self.at(high.0)? * high.1;
            Some((sum, low.1 + mid.1 + high.1))
        });
        let (sum, whole) = parts.reduce(|all, part| (all.0 + part.0, all.1 + part.1))?;
        (whole > 0.0).then(|| sum * (1.0 / whole))
    }
}

/// The first wavelength of a sum, in nm.
pub const FIRST_NM: f64 = 380.0;

/// The last wavelength of a sum, in nm.
pub const LAST_NM: f64 = 780.0;

/// The range of the observers in nm, which is that of the CIE's tables.
pub const OBSERVED_NM: (f64, f64) = (360.0, 830.0);

/// The distance between the wavelengths of a sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Step {
    /// 81 wavelengths. Colours of metals differ from those of 1 nm by at most 2e-4.
    #[default]
    Nm5,
    /// 401 wavelengths.
    Nm1,
}

impl Step {
    /// All of them.
    pub const ALL: [Step; 2] = [Step::Nm5, Step::Nm1];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Step::Nm5 => "5nm",
            Step::Nm1 => "1nm",
        }
    }

    /// Its width in nm.
    pub fn nm(self) -> u16 {
        match self {
            Step::Nm5 => 5,
            Step::Nm1 => 1,
        }
    }

    /// The wavelengths from [`FIRST_NM`] to [`LAST_NM`], in nm, ascending.
    pub fn wavelengths(self) -> Vec<f64> {
        (0..)
            .map(|index: u16| FIRST_NM + f64::from(index * self.nm()))
            .take_while(|nm| *nm <= LAST_NM)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_inside_and_nothing_outside() {
        let spectrum = Spectrum::new(vec![(400.0, 1.0), (410.0, 3.0), (500.0, 0.0)]).unwrap();
        assert_eq!(spectrum.range(), (400.0, 500.0));
        assert_eq!(spectrum.points().len(), 3);
        for (nm, value) in [
            (400.0, 1.0),
            (405.0, 2.0),
            (410.0, 3.0),
            (455.0, 1.5),
            (500.0, 0.0),
        ] {
            assert_eq!(spectrum.at(nm), Some(value), "{nm}");
        }
        for nm in [399.9, 500.1, f64::NAN, f64::INFINITY, -1.0] {
            assert_eq!(spectrum.at(nm), None, "{nm}");
        }
    }

    #[test]
    fn the_mean_about_a_wavelength_holds_what_lies_between_steps() {
        // A line of power 0.5 between two wavelengths of a sum in steps of 5 nm, under a level of 1.
        let points = [
            (380.0, 1.0),
            (436.0, 1.0),
            (436.5, 2.0),
            (437.0, 1.0),
            (780.0, 1.0),
        ];
        let spectrum = Spectrum::new(points.to_vec()).unwrap();
        let steps: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
        let means = steps
            .iter()
            .map(|nm| spectrum.mean_about(*nm, 5.0).unwrap());
        let sum: f64 = means.map(|mean| 5.0 * (mean - 1.0)).sum();
        assert!((sum - 0.5).abs() < 1e-12, "{sum}");
        assert_eq!(spectrum.mean_about(600.0, 5.0), Some(1.0));
        assert_eq!(spectrum.mean_about(380.0, 5.0), Some(1.0));
        assert_eq!(spectrum.mean_about(300.0, 5.0), None);
    }

    #[test]
    fn only_ascending_finite_wavelengths_make_one() {
        for points in [
            vec![],
            vec![(1.0, 0.0), (1.0, 0.0)],
            vec![(2.0, 0.0), (1.0, 0.0)],
            vec![(f64::NAN, 0.0)],
            vec![(1.0, 0.0), (f64::INFINITY, 0.0)],
        ] {
            assert_eq!(Spectrum::new(points), None);
        }
    }

    #[test]
    fn both_ends_are_in() {
        for (step, count) in [(Step::Nm5, 81), (Step::Nm1, 401)] {
            let wavelengths = step.wavelengths();
            assert_eq!(wavelengths.len(), count);
            assert_eq!(wavelengths[0], FIRST_NM);
            assert_eq!(wavelengths[count - 1], LAST_NM);
        }
    }
}
