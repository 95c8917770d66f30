//! The choices that the derivation of a material's inputs leaves open.

/// cos θ at which λ is matched unless asked otherwise: 81.37 degrees. The thesis's text matches at 84.26 degrees, but its Table 2
/// comes out with cos θ = 0.15, the other end of the range that it gives.
///
/// Source of λ: Lazányi and Szirmay-Kalos, "Fresnel Term Approximations for Metals", WSCG, 2005, <https://hdl.handle.net/11025/11214>.
pub const THESIS_MATCHING_COS: f64 = 0.15;

/// The choices that a derivation leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// cos θ at which λ of the corrected method meets the exact law.
    pub matching_cos: f64,
}

impl Default for Derivation {
    fn default() -> Derivation {
        Derivation {
            matching_cos: THESIS_MATCHING_COS,
        }
    }
}
