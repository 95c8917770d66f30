//! Angles in degrees, as the thesis draws and names them, and what curves do over them.

pub use crate::physics::optics::cosine;
use crate::physics::optics::{self, Reflectance};

/// Steps of a degree in which minima and largest differences are looked for: the thesis names angles to 0.01 degrees.
const STEPS: u32 = 100;

/// The exact law at an angle.
pub fn exact([n, k]: [f64; 2], degrees: f64) -> Reflectance<f64> {
    optics::conductor(n, k, cosine(degrees))
}

/// Where a curve over 0 to 90 degrees is lowest, and how low.
pub fn lowest(curve: impl Fn(f64) -> f64) -> (f64, f64) {
    let points = (0..=90 * STEPS).map(|i| f64::from(i) / f64::from(STEPS));
    points
        .map(|degrees| (degrees, curve(degrees)))
        .fold((0.0, f64::INFINITY), |best, point| {
            if point.1 < best.1 { point } else { best }
        })
}

/// Where a curve over 0 to 90 degrees is highest, and how high.
pub fn highest(curve: impl Fn(f64) -> f64) -> (f64, f64) {
    let (degrees, value) = lowest(|degrees| -curve(degrees));
    (degrees, -value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brewsters_angle_is_found() {
        let (degrees, least) = lowest(|degrees| exact([1.5, 0.0], degrees).p);
        // atan 1.5 = 56.31 degrees.
        assert_eq!(degrees, 56.31);
        assert!(least < 1e-8);
        assert_eq!(highest(|degrees| exact([1.5, 0.0], degrees).s), (90.0, 1.0));
    }
}
