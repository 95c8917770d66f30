//! Code error: a function in unfused f32 against itself in f64, at the same f32 inputs. It is never added to model error.

use crate::physics::num::ulp_distance;

/// How far the code is from what it means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodeError {
    /// Largest distance in ulp. Differences within [`ABSOLUTE_FLOOR`] do not count.
    pub max_ulp: f64,
    /// Largest absolute difference.
    pub max_abs: f64,
    /// The cosine of the largest distance in ulp.
    pub worst_cos: f64,
}

/// 2⁻²². Near a zero (Brewster's angle, the corrected method) an error in ulp has no bound, so a floor is needed.
pub const ABSOLUTE_FLOOR: f64 = 1.0 / 4_194_304.0;

impl CodeError {
    /// No difference.
    pub const NONE: CodeError = CodeError {
        max_ulp: 0.0,
        max_abs: 0.0,
        worst_cos: 0.0,
    };

    /// Includes a result. Differences up to `floor` do not count in ulp.
    pub fn include(&mut self, got: f32, want: f64, cos_theta: f32, floor: f64) {
        let difference = (f64::from(got) - want).abs();
        self.max_abs = self.max_abs.max(difference);
        let ulp = ulp_distance(got, want);
        let counts = difference.is_nan() || difference > floor;
        if counts && ulp > self.max_ulp {
            (self.max_ulp, self.worst_cos) = (ulp, f64::from(cos_theta));
        }
    }

    /// The larger of two.
    #[must_use]
    pub fn worst(self, other: CodeError) -> CodeError {
        let max_abs = self.max_abs.max(other.max_abs);
        let worse = if other.max_ulp > self.max_ulp {
            other
        } else {
            self
        };
        CodeError { max_abs, ..worse }
    }
}
