//! The split-sum table: what a rough surface reflects of light from all directions, for all materials of one shape.
//!
//! ```text
//! E(cos θ_v, roughness) = Σ c_i T_i(cos θ_v, α),   T_i = ∫ b_i(h·v) D G2 / (4 (n·v) (n·l)) (n·l) dl,   α = roughness²
//! ```
//!
//! The c_i are numbers of a material, and F = Σ c_i b_i: coefficients of a fitted method, or F0 and others of a method that is
//! affine in them ([`Basis`](crate::language::methods::Basis)), or what follows from them where a texture would hold the b_i poorly
//! ([`Orthogonal`](super::Orthogonal)). The terms T_i do not depend on the material: one texture serves all, or two where there are
//! more than four. T_0 is the albedo of a surface that reflects everything. The microfacets are GGX with height-correlated Smith masking ([`Ggx`]). The clamp of F to
//! [0, 1] is left out: it acts only for colours outside the working space.
//!
//! Source: Karis, "Real Shading in Unreal Engine 4", SIGGRAPH course, 2013,
//! <https://blog.selfshadow.com/publications/s2013-shading-course/>, for the split of lighting and surface and its table for
//! Schlick's two terms.
//!
//! The valley where masking is strongest lies at cos θ_v ≈ α. Along ∜c and √roughness it follows the diagonal, and is equally
//! many texels wide everywhere except at the very corner. Largest error of the lookup of T_0 at roughness .05 and above, which is
//! that of a material with c_0 = 1, with half precision and weights in steps of 1/256:
//!
//! | axes | 64² | 128² |
//! |---|---:|---:|
//! | c, roughness | .0746 | .0748 |
//! | √c, roughness | .0086 | .0026 |
//! | √c, √roughness | .0060 | .0018 |
//! | √c, ∜roughness | .0056 | .0017 |
//! | ∜c, roughness | .0064 | .0019 |
//! | ∜c, √roughness | .0024 | .0007 |
//! | ∜c, ∜roughness | .0022 | .0007 |
//!
//! The compensation adds what microfacets reflect more than once, as a geometric series.
//!
//! A rough white surface reflects E of the incident light after one bounce, and would reflect all of it in the end: 1 - E is
//! reflected again. Let F̄ and Ē be the means of F and E over the hemisphere. At each bounce F̄ is left, and Ē escapes. So a
//! surface with the single-bounce albedo E_F reflects in all
//!
//! ```text
//! E_F + (1 - E) F_ms,  F_ms = F̄² Ē + F̄³ (1 - Ē) Ē + ... = F̄² Ē / (1 - F̄ (1 - Ē))
//! ```
//!
//! For white, F_ms is 1. Lights and image are multiplied by 1 + (1 - E) F_ms / E_F.
//!
//! Source: Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course, 2017,
//! <https://blog.selfshadow.com/publications/s2017-shading-course/>, with F̄ squared, since light that is reflected twice has met
//! the surface twice: Hill, "A Multi-Faceted Exploration (Part 3)", 2018,
//! <https://blog.selfshadow.com/2018/08/05/multi-faceted-part-3/>.

use super::split_sum_design::SplitSumDesign;
use super::texel::{Depth, Error, check_side};
use crate::language::ir::Weights;
use crate::language::methods::Basis;
use crate::physics::num::in_parallel;
use crate::physics::optics::Ggx;

/// The most terms of a table: the channels of two textures.
pub const TERMS: usize = 8;
/// Texels per side by default.
pub const SPLIT_SUM_SIZE: usize = 128;
/// The roughness from which the lookup's error is measured: below it, the valley lies between the first texels.
pub const LEAST_ROUGHNESS: f64 = 0.05;

/// The terms T_i at the centres of texels: rows by roughness, 0 first, each with texels by cos θ_v, 0 first.
#[derive(Clone, Debug)]
pub struct SplitSum {
    /// Its axes, size and channels.
    pub design: SplitSumDesign,
    /// The texels, row by row.
    pub texels: Vec<[f64; TERMS]>,
}

/// The table as stored in a GPU texture.
#[derive(Clone, Debug)]
pub struct StoredSplitSum {
    /// Its axes, size and channels.
    pub design: SplitSumDesign,
    /// The number type.
    pub depth: Depth,
    /// The value of each texel that a sampler returns.
    pub texels: Vec<[f32; TERMS]>,
}

/// Receives the number of rows done, and of all rows.
pub type RowProgress<'a> = &'a mut dyn FnMut(u64, u64);

impl SplitSum {
    /// The table of a design. Rows are computed in parallel, and the result does not depend on the number of threads.
    ///
    /// # Errors
    /// A size that no texture can have.
    pub fn new(design: &SplitSumDesign, progress: RowProgress) -> Result<SplitSum, Error> {
        check_side(design.width)?;
        check_side(design.height)?;
        let rule = Ggx::default();
        let row = |j: usize| -> Vec<[f64; TERMS]> {
            let texel = |i: usize| {
                let (cos_v, roughness) = design.at(i as f64, j as f64);
                design.channels_at(&rule, cos_v, roughness)
            };
            (0..design.width).map(texel).collect()
        };
        let texels = in_parallel(design.height, &row, progress).concat();
        Ok(SplitSum {
            design: design.clone(),
            texels,
        })
    }

    /// The table in a depth that holds 0 to 1.
    pub fn stored(&self, depth: Depth) -> StoredSplitSum {
        let rounded = |texel: &[f64; TERMS]| texel.map(|value| depth.nearest(value));
        StoredSplitSum {
            design: self.design.clone(),
            depth,
            texels: self.texels.iter().map(rounded).collect(),
        }
    }
}

/// The largest term that is left to half precision, which has 11 significant bits: above 4, its error is .002.
pub const MOST_TERM: f64 = 4.0;

/// The least and the largest factor of a material's numbers, over all angles. Terms are means, so they lie between.
pub fn term_range(basis: &Basis) -> [f64; 2] {
    const STEPS: usize = 1000;
    let mut range = [0.0, 1.0];
    for step in 0..=STEPS {
        let mut values = [0.0; TERMS];
        basis.add(
            step as f64 / STEPS as f64,
            1.0,
            &mut values[..basis.terms()],
        );
        for value in values {
            range = [f64::min(range[0], value), f64::max(range[1], value)];
        }
    }
    range
}

impl StoredSplitSum {
    /// The bilinear lookup at a cosine and a roughness, clamped to [0, 1].
    pub fn lookup(&self, weights: Weights, cos_v: f64, roughness: f64) -> [f64; TERMS] {
        let (width, height) = (self.design.width, self.design.height);
        let (column, row) = self.design.texel(cos_v, roughness);
        let (left, x) = neighbours(weights, column, width);
        let (top, y) = neighbours(weights, row, height);
        let texel = |i: usize, j: usize| self.texels[j * width + i].map(f64::from);
        let mixed = |j: usize| mix(texel(left, j), texel(left + 1, j), x);
        mix(mixed(top), mixed(top + 1), y)
    }
}

/// The index of the texel before a place, and the weight of the next.
fn neighbours(weights: Weights, at: f64, texels: usize) -> (usize, f64) {
    let before = (at.floor() as usize).min(texels - 2);
    let share = at - before as f64;
    match weights {
        Weights::Exact => (before, share),
        Weights::Steps256 => (before, (share * 256.0).floor() / 256.0),
    }
}

fn mix(a: [f64; TERMS], b: [f64; TERMS], share: f64) -> [f64; TERMS] {
    let mut mixed = a;
    for (mixed, b) in mixed.iter_mut().zip(b) {
        *mixed += share * (b - *mixed);
    }
    mixed
}

/// Places between the texels of a table with the channels' values: filtering errs most there.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenSplitSum {
    /// Cosine, roughness, channels.
    points: Vec<(f64, f64, [f64; TERMS])>,
}

impl BetweenSplitSum {
    /// The middles of all cells and of their sides, from [`LEAST_ROUGHNESS`] on.
    pub fn new(design: &SplitSumDesign, progress: RowProgress) -> BetweenSplitSum {
        let rule = Ggx::default();
        let halves = |texels: usize| 2 * texels - 1;
        let row = |j: usize| -> Vec<(f64, f64, [f64; TERMS])> {
            let columns = (0..halves(design.width)).filter(|i| i % 2 == 1 || j % 2 == 1);
            let places = columns.map(|i| design.at(0.5 * i as f64, 0.5 * j as f64));
            let places = places.filter(|(_, roughness)| *roughness >= LEAST_ROUGHNESS);
            let point = |(cos_v, roughness)| {
                let channels = design.channels_at(&rule, cos_v, roughness);
                (cos_v, roughness, channels)
            };
            places.map(point).collect()
        };
        BetweenSplitSum {
            points: in_parallel(halves(design.height), &row, progress).concat(),
        }
    }

    /// The largest error of each channel's lookup.
    pub fn errors(&self, stored: &StoredSplitSum, weights: Weights) -> [f64; TERMS] {
        let mut most = [0.0; TERMS];
        for (cos_v, roughness, terms) in &self.points {
            let got = stored.lookup(weights, *cos_v, *roughness);
            for (most, (got, want)) in most.iter_mut().zip(got.iter().zip(terms)) {
                *most = f64::max(*most, (got - want).abs());
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::super::split_sum_design::SplitSumAxis;
    use super::*;
    use crate::language::methods::find;

    fn basis(name: &str) -> Basis {
        find(name).and_then(|method| method.basis()).unwrap()
    }

    #[test]
    fn corners_are_what_they_must_be() {
        for axes in [
            [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt],
            [SplitSumAxis::Sqrt, SplitSumAxis::Linear],
        ] {
            let design = SplitSumDesign::square(basis("fitted_dielectric"), 9, axes);
            let mut last = 0;
            let table = SplitSum::new(&design, &mut |done, of| {
                assert_eq!((done, of), (last + 1, 9));
                last = done;
            });
            let table = table.unwrap();
            // A mirror at 90 degrees, and from above.
            let of_four = |texel: usize| &table.texels[texel][..4];
            assert_eq!(of_four(0), [1.0; 4]);
            assert_eq!(of_four(8), [1.0, 0.0, 0.0, 0.0]);
            // The roughest from above: T_0 is 1 - ln 2.
            assert!((table.texels[80][0] - 0.306_853).abs() < 1e-5);
            let stored = table.stored(Depth::Float);
            for (i, texel) in table.texels.iter().enumerate() {
                let (c, r) = design.at((i % 9) as f64, (i / 9) as f64);
                for (got, want) in stored.lookup(Weights::Exact, c, r).iter().zip(texel) {
                    assert!((got - want).abs() < 1e-6, "{c} {r}: {got} {want}");
                }
            }
        }
    }

    #[test]
    fn terms_that_a_texture_holds_poorly_are_replaced() {
        let table = |name: &str| {
            let design = SplitSumDesign::square(basis(name), 9, [SplitSumAxis::Linear; 2]);
            SplitSum::new(&design, &mut |_, _| {}).unwrap()
        };
        for name in ["fitted_five", "fitted_rational", "fitted_film_eight"] {
            let table = table(name);
            assert!(table.design.functions.is_some(), "{name}");
            let most = table.texels.iter().flatten().map(|term| term.abs());
            assert!(most.fold(0.0, f64::max) <= 1.0 + 1e-9, "{name}");
        }
        assert!(table("fitted_f82").design.functions.is_none());
    }
}
