//! A spectrum: values at some wavelengths, linear in between, nothing outside.

use std::ops::{Add, Mul, Sub};

/// Values by ascending wavelength. `V` is a number, or several: the three functions of an observer, n and k.
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
        // Not for a NaN, which is past no wavelength and before none.
        (share > 0.0).then(|| low.1 + (high.1 - low.1) * share)
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
}
