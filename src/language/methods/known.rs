//! What is known of a surface that inputs are derived from.

use crate::physics::num::each_channel;
use crate::physics::optics::{self, COS_82};

use crate::language::methods::formulas::BELCOUR_COSINES;

/// cos θ at which the empirical term meets the exact law: 60 degrees.
pub const COS_60: f64 = 0.5;

/// An index per channel, and reflectances at a few angles. Where a channel is one wavelength these are the law's; where it is a
/// whole spectrum they are the spectrum's, and the index stands for it.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownSurface {
    /// The real part of the index per channel.
    pub n: [f64; 3],
    /// The extinction coefficient per channel.
    pub k: [f64; 3],
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// At 81.79 degrees.
    pub f82: [f64; 3],
    /// At 60 degrees.
    pub f60: [f64; 3],
    /// cos θ at which λ of the corrected method is matched.
    pub matching_cos: f64,
    /// Reflectance there.
    pub matching: [f64; 3],
    /// At the two angles where Belcour's curves are weighed.
    pub belcour: [[f64; 3]; 2],
}

impl KnownSurface {
    /// A surface that is known by its index alone.
    pub fn of_index(n: [f64; 3], k: [f64; 3], matching_cos: f64) -> KnownSurface {
        let law = |c: f64| each(|i| optics::conductor(n[i], k[i], c).unpolarised());
        KnownSurface {
            f0: each(|i| optics::normal_incidence(n[i], k[i])),
            ..KnownSurface::with(n, k, law, matching_cos)
        }
    }

    /// A surface for which this index stands, by what it reflects at a cosine.
    pub fn with(
        n: [f64; 3],
        k: [f64; 3],
        seen: impl Fn(f64) -> [f64; 3],
        matching_cos: f64,
    ) -> KnownSurface {
        KnownSurface {
            n,
            k,
            f0: seen(1.0),
            f82: seen(COS_82),
            f60: seen(COS_60),
            matching_cos,
            matching: seen(matching_cos),
            belcour: BELCOUR_COSINES.map(&seen),
        }
    }
}

/// A value for each channel.
pub fn each(value: impl Fn(usize) -> f64) -> [f64; 3] {
    each_channel(value)
}

/// The mean of the channels.
pub fn mean(channels: [f64; 3]) -> f64 {
    channels.iter().sum::<f64>() / 3.0
}
