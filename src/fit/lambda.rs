//! λ of the corrected method: `(1-c)^λ = (F_rescaled - F_exact) / (2 n c)` at a matching angle.
//!
//! Source: Lazányi and Szirmay-Kalos, "Fresnel Term Approximations for Metals", WSCG, 2005,
//! <https://hdl.handle.net/11025/11214>. The thesis's text matches at 84.26 degrees, but its Table 2 comes out with
//! cos θ = 0.15 (81.37 degrees), the other end of the range that it gives; that is the default.

use crate::optics;

/// cos θ at which λ is matched unless asked otherwise: 81.37 degrees.
pub const THESIS_MATCHING_COS: f64 = 0.15;

/// The λ with which the corrected method meets the exact law at `cos_theta`, for one channel. There is none where
/// the exact law lies above the rescaled Schlick (gold's green), or so far below that λ would not be positive.
pub fn lambda(n: f64, k: f64, cos_theta: f64) -> Option<f64> {
    lambda_for(
        n,
        k,
        cos_theta,
        optics::conductor(n, k, cos_theta).unpolarised(),
    )
}

/// The same for a reflectance that is `exact` at `cos_theta`.
pub fn lambda_for(n: f64, k: f64, cos_theta: f64, exact: f64) -> Option<f64> {
    let (less, more, m) = (n - 1.0, n + 1.0, 1.0 - cos_theta);
    let rescaled = (less * less + 4.0 * n * m * m * m * m * m + k * k) / (more * more + k * k);
    let share = (rescaled - exact) / (2.0 * n * cos_theta);
    (share > 0.0 && share < 1.0).then(|| libm::log2(share) / libm::log2(1.0 - cos_theta))
}
