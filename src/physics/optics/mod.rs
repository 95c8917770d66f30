//! Optics: the exact laws of reflection, the reference for every generated formula.
//!
//! Conventions: light arrives from a medium of index 1 (or any, when `n` and `k` are taken relative to it) at the
//! plane surface of a medium m = n + ik, with k > 0 absorbing. `cos_theta` is the cosine of the angle between the surface
//! normal and the direction of the light, in [0, 1]. `eta` is the relative index n_t/n_i. Below 1 there is a
//! critical angle, past which the reflectance is exactly 1. At 90 degrees every reflectance is exactly 1, except
//! that an index-matched surface (n = 1, k = 0) reflects 0 at every angle, 90 degrees included.

mod coat;
mod film;
mod ggx;
mod interface;

use crate::physics::num::Num;

pub use coat::{UnderCoat, under_coat};
pub use film::{Layer, under_films, unpolarised_under_films};
pub use ggx::Ggx;
pub use interface::{
    EffectiveIndex, LARGEST_F0, conductor, dielectric, index_from_f0_f82, normal_incidence,
    unpolarised,
};

/// The angle of the second colour of a metal, about 81.79 degrees: cos θ = 1/7 is where the correction of Schlick's
/// approximation, cos θ (1 − cos θ)⁶, is largest (Hoffman 2019, <https://doi.org/10.2312/mam.20191305>).
pub const COS_82: f64 = 1.0 / 7.0;

/// The cosine of an angle in degrees, exactly 0 at 90.
///
/// ```
/// use fresnel_gen::physics::optics::cosine;
///
/// assert!((cosine(60.0) - 0.5).abs() < 1e-15);
/// assert_eq!(cosine(90.0), 0.0);
/// ```
#[inline]
pub fn cosine(degrees: f64) -> f64 {
    if degrees == 90.0 {
        0.0
    } else {
        libm::cos(degrees.to_radians())
    }
}

/// The reflected fraction of the power, for the two linear polarisations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance<N> {
    /// Electric field perpendicular to the plane of incidence (s, TE).
    pub s: N,
    /// Electric field in the plane of incidence (p, TM).
    pub p: N,
}

impl<N: Num> Reflectance<N> {
    /// The reflectance of unpolarised light: (s + p)/2.
    #[inline]
    pub fn unpolarised(self) -> N {
        N::from_f64(0.5) * (self.s + self.p)
    }
}
