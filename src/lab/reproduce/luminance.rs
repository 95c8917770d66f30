//! Errors of three channels as one: their mean, as the thesis takes it, and weighted by what each adds to luminance, which its
//! last section leaves open.
//!
//! Source of the weights: ITU-R BT.709-6, 2015, <https://www.itu.int/rec/R-REC-BT.709>, from the chromaticities of sRGB. The
//! thesis's three wavelengths are no primaries; its programs show them as if they were.

use crate::physics::num::each_channel;
use crate::physics::spectra::Space;

/// Why the weighted figures stand there.
pub const BY_LUMINANCE: &str = "the channels weighted by what they add to luminance in sRGB (.2126, .7152, .0722) and not by a third \
    each: the question with which the thesis ends";

/// The mean of three channels.
pub fn mean(errors: [f64; 3]) -> f64 {
    errors.iter().sum::<f64>() / 3.0
}

/// The mean of three channels by luminance.
pub fn by_luminance(errors: [f64; 3]) -> f64 {
    let weights = Space::Srgb.rgb_to_xyz().row(1).to_array();
    each_channel(|i| weights[i] * errors[i]).iter().sum()
}
