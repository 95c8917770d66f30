//! Axes: where a cosine lies along a table.
//!
//! ```text
//! u = (1/2 + w(c) (N - 1)) / N        c = cos θ, clamped to [0, 1]; N texels; w(0) = 0, w(1) = 1
//! ```
//!
//! The centre of the first texel is c = 0 and that of the last c = 1, exactly. A sampler that clamps to the edge never reaches
//! past them, and the whole range is covered.
//!
//! Linear filtering has an error of h²/8 times the second derivative. Reflectance bends most near grazing, so an axis should be
//! dense there: the warp w. Largest error of f32 texels over the catalogue in air at 64 texels, and the texels needed for an
//! error of 1/1023, by the 90th percentile of the catalogue's 137 materials:
//!
//! | axis | w | error | texels |
//! |---|---|---:|---:|
//! | cos | c | .0039 | 130 |
//! | square | c (2 - c) | .0010 | 64 |
//! | sqrt | √c | .00054 | 48 |
//! | rational | 5 c / (4 c + 1) | .00014 | 25 |
//! | steep | 9 c / (8 c + 1) | .00040 | 41 |
//!
//! The mean relative error (the thesis's measure) ranks the axes differently for materials that are dark at normal incidence: at
//! 64 texels, water has .04 % along cos, .05 along square, .15 along rational.
//!
//! Tried and left out: 1 - (1 - c)³ and higher powers, which are sparse at normal incidence; log(1 + 20 c), as good and more
//! costly; √(c + b), between sqrt and rational; other constants of the rational one (1/5 and 3/10 in place of its 1/4 need 28 and
//! 26 texels).

use crate::language::methods::{WARP, unwarped, warped};
use crate::physics::num::Num;

/// How cosines are spread over a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableAxis {
    /// w = c: the thesis's. Nothing to compute.
    Cos,
    /// w = c (2 - c) = 1 - (1 - c)²: two operations, no division.
    Square,
    /// w = √c, as in engines. Its first texels lie closer together than any material in air needs.
    Sqrt,
    /// w = 5 c / (4 c + 1): one division, and the fewest texels for nearly all materials.
    Rational,
    /// w = 9 c / (8 c + 1): for indices whose curves have a trough near grazing (zinc by Querry in red).
    Steep,
    /// w = 65 c / (64 c + 1): for indices near 1 (gases, a material in a medium like it), whose curves bend close to grazing.
    Grazing,
}

impl TableAxis {
    /// All of them, the cheapest in a shader first.
    pub const ALL: [TableAxis; 6] = [
        TableAxis::Cos,
        TableAxis::Square,
        TableAxis::Sqrt,
        TableAxis::Rational,
        TableAxis::Steep,
        TableAxis::Grazing,
    ];

    /// The name on the command line; w of c, as every shading language writes it; k of the axes w = (1 + k) c / (1 + k c).
    fn row(self) -> (&'static str, &'static str, Option<f64>) {
        match self {
            TableAxis::Cos => ("cos", "c", Some(0.0)),
            TableAxis::Square => ("square", "c * (2.0 - c)", None),
            TableAxis::Sqrt => ("sqrt", "sqrt(c)", None),
            TableAxis::Rational => ("rational", "5.0 * c / (4.0 * c + 1.0)", Some(WARP)),
            TableAxis::Steep => ("steep", "9.0 * c / (8.0 * c + 1.0)", Some(8.0)),
            TableAxis::Grazing => ("grazing", "65.0 * c / (64.0 * c + 1.0)", Some(64.0)),
        }
    }

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// w of c, as every shading language writes it.
    pub fn formula(self) -> &'static str {
        self.row().1
    }

    /// The constant k of the axes w = (1 + k) c / (1 + k c), which the method `table` takes as `warp`.
    pub fn constant(self) -> Option<f64> {
        self.row().2
    }

    /// w of a cosine in [0, 1], in any number type: 0 at 0 and 1 at 1, exactly.
    pub fn warp<N: Num>(self, c: N) -> N {
        match (self, self.constant()) {
            (TableAxis::Cos, _) => c,
            (_, Some(constant)) => warped(constant, c),
            (TableAxis::Sqrt, None) => c.sqrt(),
            (_, None) => c * (N::from_f64(2.0) - c),
        }
    }

    /// The cosine of a w in [0, 1].
    pub fn cosine(self, w: f64) -> f64 {
        match (self, self.constant()) {
            (_, Some(constant)) => unwarped(constant, w),
            (TableAxis::Sqrt, None) => w * w,
            (_, None) => 1.0 - (1.0 - w).sqrt(),
        }
    }

    /// The scale and offset that turn w into u: u = scale w + offset.
    pub fn half_texel(texels: usize) -> (f64, f64) {
        let texels = texels as f64;
        ((texels - 1.0) / texels, 0.5 / texels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::num::Half;

    #[test]
    fn ends_are_exact_and_each_warp_is_undone() {
        for axis in TableAxis::ALL {
            assert_eq!((axis.warp(0.0), axis.warp(1.0)), (0.0, 1.0), "{axis:?}");
            assert_eq!((axis.warp(0f32), axis.warp(1f32)), (0.0, 1.0), "{axis:?}");
            assert_eq!(axis.warp(Half::from_f32(1.0)).to_f32(), 1.0, "{axis:?}");
            assert_eq!((axis.cosine(0.0), axis.cosine(1.0)), (0.0, 1.0), "{axis:?}");
            let mut last = -1.0;
            for step in 0..=1000 {
                let c = f64::from(step) / 1000.0;
                let w = axis.warp(c);
                assert!((axis.cosine(w) - c).abs() < 1e-12, "{axis:?} at {c}");
                assert!(w > last, "{axis:?} does not grow at {c}");
                last = w;
            }
        }
    }

    #[test]
    fn half_a_texel_stays_at_each_end() {
        let (scale, offset) = TableAxis::half_texel(64);
        assert_eq!(offset * 64.0, 0.5);
        assert_eq!((scale + offset) * 64.0, 63.5);
    }
}
