//! Differences of colours that the eye sees: CIELAB and CIEDE2000.
//!
//! ```text
//! L* = 116 f(Y/Yw) − 16,  a* = 500 (f(X/Xw) − f(Y/Yw)),  b* = 200 (f(Y/Yw) − f(Z/Zw))
//! f(t) = ∛t for t > (6/29)³, else (841/108) t + 4/29
//! ```
//!
//! Source: CIE 015:2018, *Colorimetry*, <https://doi.org/10.25039/TR.015.2018>; CIEDE2000 with its test pairs in G. Sharma,
//! W. Wu, E. N. Dalal, *The CIEDE2000 Color-Difference Formula*, Color Research and Application 30(1), 2005, 21-30,
//! <https://doi.org/10.1002/col.20070>. Computed by the crate `palette`. Unit: about 1 is the least difference that is
//! seen side by side, above 5 the formula was never fitted and says only "much".

use glam::DVec3;
use palette::color_difference::Ciede2000;
use palette::convert::FromColorUnclamped;
use palette::white_point::E;

/// A colour in CIELAB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// Lightness, 0 for black, 100 for white.
    pub l: f64,
    /// Green to red.
    pub a: f64,
    /// Blue to yellow.
    pub b: f64,
}

impl Lab {
    /// The colour `xyz` beside a white. Both in the same unit; the white above 0 in each of X, Y and Z.
    pub fn from_xyz(xyz: DVec3, white: DVec3) -> Lab {
        // The white of `E` is (1, 1, 1): the division is ours.
        let relative = xyz / white;
        let lab = palette::Lab::<E, f64>::from_color_unclamped(palette::Xyz::new(
            relative.x, relative.y, relative.z,
        ));
        Lab {
            l: lab.l,
            a: lab.a,
            b: lab.b,
        }
    }
}

/// The difference ΔE₀₀ of two colours.
///
/// ```
/// use fresnel_gen::physics::spectra::{Lab, ciede2000};
///
/// let grey = Lab { l: 50.0, a: 0.0, b: 0.0 };
/// assert_eq!(ciede2000(grey, grey), 0.0);
/// ```
pub fn ciede2000(one: Lab, other: Lab) -> f64 {
    let [one, other] = [one, other].map(|lab| palette::Lab::<E, f64>::new(lab.l, lab.a, lab.b));
    Ciede2000::difference(one, other)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// L, a, b of two colours and their difference: table 1 of Sharma, Wu and Dalal.
    #[rustfmt::skip]
    const PAIRS: [[f64; 7]; 34] = [
        [50.0, 2.6772, -79.7751, 50.0, 0.0, -82.7485, 2.0425],
        [50.0, 3.1571, -77.2803, 50.0, 0.0, -82.7485, 2.8615],
        [50.0, 2.8361, -74.02, 50.0, 0.0, -82.7485, 3.4412],
        [50.0, -1.3802, -84.2814, 50.0, 0.0, -82.7485, 1.0],
        [50.0, -1.1848, -84.8006, 50.0, 0.0, -82.7485, 1.0],
        [50.0, -0.9009, -85.5211, 50.0, 0.0, -82.7485, 1.0],
        [50.0, 0.0, 0.0, 50.0, -1.0, 2.0, 2.3669],
        [50.0, -1.0, 2.0, 50.0, 0.0, 0.0, 2.3669],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.0009, 7.1792],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.001, 7.1792],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.0011, 7.2195],
        [50.0, 2.49, -0.001, 50.0, -2.49, 0.0012, 7.2195],
        [50.0, -0.001, 2.49, 50.0, 0.0009, -2.49, 4.8045],
        [50.0, -0.001, 2.49, 50.0, 0.001, -2.49, 4.8045],
        [50.0, -0.001, 2.49, 50.0, 0.0011, -2.49, 4.7461],
        [50.0, 2.5, 0.0, 50.0, 0.0, -2.5, 4.3065],
        [50.0, 2.5, 0.0, 73.0, 25.0, -18.0, 27.1492],
        [50.0, 2.5, 0.0, 61.0, -5.0, 29.0, 22.8977],
        [50.0, 2.5, 0.0, 56.0, -27.0, -3.0, 31.903],
        [50.0, 2.5, 0.0, 58.0, 24.0, 15.0, 19.4535],
        [50.0, 2.5, 0.0, 50.0, 3.1736, 0.5854, 1.0],
        [50.0, 2.5, 0.0, 50.0, 3.2972, 0.0, 1.0],
        [50.0, 2.5, 0.0, 50.0, 1.8634, 0.5757, 1.0],
        [50.0, 2.5, 0.0, 50.0, 3.2592, 0.335, 1.0],
        [60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644],
        [63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.263],
        [61.2901, 3.7196, -5.3901, 61.4292, 2.248, -4.962, 1.8731],
        [35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645],
        [22.7233, 20.0904, -46.694, 23.0331, 14.973, -42.5619, 2.0373],
        [36.4612, 47.858, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146],
        [90.8027, -2.0831, 1.441, 91.1528, -1.6435, 0.0447, 1.4441],
        [90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381],
        [6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377],
        [2.0776, 0.0795, -1.135, 0.9033, -0.0636, -0.5514, 0.9082],
    ];

    #[test]
    fn the_published_pairs_come_out_both_ways() {
        assert_eq!(PAIRS.len(), 34);
        for [l1, a1, b1, l2, a2, b2, wanted] in PAIRS {
            let (one, other) = (
                Lab {
                    l: l1,
                    a: a1,
                    b: b1,
                },
                Lab {
                    l: l2,
                    a: a2,
                    b: b2,
                },
            );
            assert!(
                (ciede2000(one, other) - wanted).abs() < 1e-4,
                "{one:?} {other:?}"
            );
            assert!(
                (ciede2000(other, one) - wanted).abs() < 1e-4,
                "{other:?} {one:?}"
            );
            assert_eq!(ciede2000(one, one), 0.0);
        }
    }

    #[test]
    fn lab_of_white_grey_and_black() {
        let white = DVec3::new(0.95, 1.0, 1.09);
        let check = |share: f64, l: f64| {
            let lab = Lab::from_xyz(white * share, white);
            assert!(
                (lab.l - l).abs() < 1e-12 && lab.a.abs() < 1e-12 && lab.b.abs() < 1e-12,
                "{lab:?}"
            );
        };
        check(1.0, 100.0);
        check(0.125, 42.0);
        check(0.001, 116.0 * (0.841 / 108.0 + 4.0 / 29.0) - 16.0);
        check(0.0, 0.0);
    }
}
