//! What the inputs of methods are derived from: a surface whose index and a few reflectances are known.

use crate::physics::num::each_channel;
use crate::physics::optics::{self, COS_82};

/// cos θ at which the empirical term meets the exact law: 60 degrees.
pub const COS_60: f64 = 0.5;

/// The cosines of the two angles at which Belcour's decomposition is exact: the maxima of b2 and of -b3 in a table of 1000 cosines.
pub const BELCOUR_COSINES: [f64; 2] = [128.0 / 999.0, 432.0 / 999.0];

/// An index per channel, and reflectances at a few angles. Where a channel is one wavelength, these follow from the index by the
/// exact law. Where it is a whole spectrum, they are the spectrum's, and the index represents it.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownSurface {
    /// The real part of the index per channel.
    pub n: [f64; 3],
    /// The extinction coefficient per channel.
    pub k: [f64; 3],
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees.
    pub f82: [f64; 3],
    /// Reflectance at 60 degrees.
    pub f60: [f64; 3],
    /// cos θ at which λ of the corrected method is matched.
    pub matching_cos: f64,
    /// Reflectance there.
    pub matching: [f64; 3],
    /// Reflectance at the two angles that determine Belcour's weights.
    pub belcour: [[f64; 3]; 2],
}

impl KnownSurface {
    /// The surface with this index.
    pub fn of_index(n: [f64; 3], k: [f64; 3], matching_cos: f64) -> KnownSurface {
        let law = |c: f64| each_channel(|i| optics::conductor(n[i], k[i], c).unpolarised());
        KnownSurface {
            f0: each_channel(|i| optics::normal_incidence(n[i], k[i])),
            ..KnownSurface::with(n, k, law, matching_cos)
        }
    }

    /// The surface that this index represents, with its reflectance as a function of the cosine.
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

/// The mean of the channels.
pub fn mean(channels: [f64; 3]) -> f64 {
    channels.iter().sum::<f64>() / 3.0
}
