//! Two colours of a surface in air, moved under a coat.

use serde::Serialize;

use crate::physics::num::each_channel;
use crate::physics::optics::{COS_82, UnderCoat, conductor, under_coat};

/// The colours of a surface under a coat.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoatedRow {
    /// The coat's refractive index.
    pub index: f64,
    /// F0 in air, as given.
    pub f0: [f64; 3],
    /// F82 in air, as given.
    pub f82: [f64; 3],
    /// F0 relative to the coat.
    pub f0_in_coat: [f64; 3],
    /// Reflectance at 81.79 degrees within the coat: what methods take that want it.
    pub f82_in_coat: [f64; 3],
    /// n in air of each channel.
    pub n: [f64; 3],
    /// k in air of each channel.
    pub k: [f64; 3],
    /// Of each channel whether an index gives both colours; else n and k are those of the nearest.
    pub exact: [bool; 3],
}

impl CoatedRow {
    /// The colours under a coat of this index.
    pub fn new(f0: [f64; 3], f82: [f64; 3], index: f64) -> CoatedRow {
        let under: [UnderCoat; 3] = [0, 1, 2].map(|i| under_coat(f0[i], f82[i], index));
        let in_coat = |i: usize| {
            let UnderCoat { n, k, .. } = under[i];
            conductor(n / index, k / index, COS_82).unpolarised()
        };
        CoatedRow {
            index,
            f0,
            f82,
            f0_in_coat: under.map(|channel| channel.f0),
            f82_in_coat: each_channel(in_coat),
            n: under.map(|channel| channel.n),
            k: under.map(|channel| channel.k),
            exact: under.map(|channel| channel.exact),
        }
    }
}
