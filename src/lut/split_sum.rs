//! The split-sum table: what a rough surface reflects of light from everywhere, for every material of one shape at once.
//!
//! ```text
//! E(cos θ_v, roughness) = Σ c_i T_i(cos θ_v, α),   T_i = ∫ b_i(h·v) D G2 / (4 (n·v) (n·l)) (n·l) dl,   α = roughness²
//! ```
//!
//! A fitted method is linear in its coefficients c_i, F = Σ c_i b_i, so that its directional albedo is linear in them too, and
//! the terms T_i hold no material: one RGBA texture serves all. T_0 is the albedo of what reflects everything. The microfacets
//! are GGX with height-correlated Smith masking ([`Ggx`]). The limit of F to [0, 1] is left out: it acts for colours outside the
//! working space only.
//!
//! Source: the split of lighting and surface, and its table for Schlick's two terms, of Karis, "Real Shading in Unreal Engine 4",
//! SIGGRAPH course, 2013, <https://blog.selfshadow.com/publications/s2013-shading-course/>.
//!
//! The valley where masking takes most lies at cos θ_v ≈ α: it runs along the diagonal of fourth roots, and is as many texels
//! wide everywhere but at the very corner. Largest error of the lookup of T_0 at roughness .05 and above, which is that of a
//! material with c_0 = 1, exact weights:
//!
//! | axes | 64² | 96² | 128² |
//! |---|---:|---:|---:|
//! | √c, roughness | .0087 | .0037 | |
//! | √c, √roughness | .0060 | .0029 | .0017 |
//! | ∛c, √roughness | .0028 | .0013 | .0008 |
//! | ∜c, √roughness | .0023 | .0011 | .0006 |

use crate::ir::Weights;
use crate::methods::Shape;
use crate::num::in_parallel;
use crate::optics::Ggx;

use super::depth::Depth;
use super::error::Error;
use super::table::LEAST_TEXELS;

/// Terms of a table: the channels of a texture.
pub const TERMS: usize = 4;
/// Texels of a side where nothing else is asked for: within .001, half precision and weights of 1/256 included.
pub const SPLIT_SUM_SIZE: usize = 128;
/// The most texels of a side: the errors fall with the square of the size, and are those of half precision from 256 on.
pub const MOST_SIDE: usize = 1024;
/// The roughness from which on the lookup's error is measured: below it the valley lies between the first texels.
pub const LEAST_ROUGHNESS: f64 = 0.05;

/// The terms T_i at the centres of texels: rows by roughness, 0 first, in each a texel by cos θ_v, 0 first.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitSum {
    /// Texels of a side.
    pub size: usize,
    /// The texels, row by row.
    pub texels: Vec<[f64; TERMS]>,
}

/// The same as a GPU has it.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredSplitSum {
    /// Texels of a side.
    pub size: usize,
    /// The kind of number.
    pub depth: Depth,
    /// What a sampler gives back for each texel.
    pub texels: Vec<[f32; TERMS]>,
}

/// How much of a run is done: rows, of how many.
pub type RowProgress<'a> = &'a mut dyn FnMut(u64, u64);

/// The cosine at a place of the axis, from 0 to 1: its fourth power.
pub fn split_sum_cosine(w: f64) -> f64 {
    split_sum_roughness(w) * split_sum_roughness(w)
}

/// The roughness at a place of the axis, from 0 to 1: its square.
pub fn split_sum_roughness(w: f64) -> f64 {
    w * w
}

/// The terms of a shape at a cosine and a roughness, both in [0, 1].
pub fn split_sum_terms(rule: &Ggx, shape: &Shape, cos_v: f64, roughness: f64) -> [f64; TERMS] {
    let (mut sums, terms) = ([0.0; TERMS], shape.terms());
    rule.each(cos_v, roughness * roughness, |cos_h, weight| {
        shape.add(cos_h, weight, &mut sums[..terms]);
    });
    sums
}

impl SplitSum {
    /// The table of a shape. Rows are shared among threads; the bytes are the same for any number of them.
    ///
    /// # Errors
    /// A shape of more terms than a texture has channels, a size that no texture has.
    pub fn new(shape: &Shape, size: usize, progress: RowProgress) -> Result<SplitSum, Error> {
        check_side(size)?;
        check_terms(shape)?;
        let rule = Ggx::default();
        let place = |i: usize| i as f64 / (size - 1) as f64;
        let row = |j: usize| -> Vec<[f64; TERMS]> {
            let roughness = split_sum_roughness(place(j));
            let texel =
                |i: usize| split_sum_terms(&rule, shape, split_sum_cosine(place(i)), roughness);
            (0..size).map(texel).collect()
        };
        let texels = in_parallel(size, &row, progress).concat();
        Ok(SplitSum { size, texels })
    }

    /// The table in a depth, which holds 0 to 1.
    pub fn stored(&self, depth: Depth) -> StoredSplitSum {
        let rounded = |texel: &[f64; TERMS]| texel.map(|value| depth.nearest(value));
        StoredSplitSum {
            size: self.size,
            depth,
            texels: self.texels.iter().map(rounded).collect(),
        }
    }
}

/// Refuses a side that a table cannot have.
///
/// # Errors
/// Fewer than [`LEAST_TEXELS`], or more than a texture may have.
pub fn check_side(size: usize) -> Result<(), Error> {
    if (LEAST_TEXELS..=MOST_SIDE).contains(&size) {
        Ok(())
    } else {
        Err(Error::Side { size })
    }
}

/// Refuses a shape of more terms than a texture has channels, and one whose terms a texture does not hold.
fn check_terms(shape: &Shape) -> Result<(), Error> {
    let terms = shape.terms();
    if terms > TERMS {
        return Err(Error::Terms { terms });
    }
    let mut at_grazing = vec![0.0; terms];
    shape.add(0.0, 1.0, &mut at_grazing);
    match at_grazing.iter().all(|term| *term <= 1.0) {
        true => Ok(()),
        false => Err(Error::Range),
    }
}

impl StoredSplitSum {
    /// The bilinear lookup at a cosine and a roughness, clamped to [0, 1].
    pub fn lookup(&self, weights: Weights, cos_v: f64, roughness: f64) -> [f64; TERMS] {
        let (left, x) = self.place(weights, cos_v.clamp(0.0, 1.0).sqrt().sqrt());
        let (top, y) = self.place(weights, roughness.clamp(0.0, 1.0).sqrt());
        let texel = |i: usize, j: usize| self.texels[j * self.size + i].map(f64::from);
        let mixed = |j: usize| mix(texel(left, j), texel(left + 1, j), x);
        mix(mixed(top), mixed(top + 1), y)
    }

    /// The texel before a place of an axis, and the weight of the next.
    fn place(&self, weights: Weights, w: f64) -> (usize, f64) {
        let at = w * (self.size - 1) as f64;
        let before = (at.floor() as usize).min(self.size - 2);
        let share = at - before as f64;
        match weights {
            Weights::Exact => (before, share),
            Weights::Steps256 => (before, (share * 256.0).floor() / 256.0),
        }
    }
}

fn mix(a: [f64; TERMS], b: [f64; TERMS], share: f64) -> [f64; TERMS] {
    let mut mixed = a;
    for (mixed, b) in mixed.iter_mut().zip(b) {
        *mixed += share * (b - *mixed);
    }
    mixed
}

/// Places between the texels of a table at which its terms are known: filtering errs most there.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenSplitSum {
    /// Cosine, roughness, terms.
    points: Vec<(f64, f64, [f64; TERMS])>,
}

impl BetweenSplitSum {
    /// The middles of all cells and of their sides, for tables of this size, from [`LEAST_ROUGHNESS`] on.
    pub fn new(shape: &Shape, size: usize, progress: RowProgress) -> BetweenSplitSum {
        let rule = Ggx::default();
        let halves = 2 * size - 1;
        let place = |half: usize| half as f64 / (halves - 1) as f64;
        let row = |j: usize| -> Vec<(f64, f64, [f64; TERMS])> {
            let roughness = split_sum_roughness(place(j));
            let is_between = |i: &usize| (i % 2 == 1 || j % 2 == 1) && roughness >= LEAST_ROUGHNESS;
            let point = |i: usize| {
                let cos_v = split_sum_cosine(place(i));
                (
                    cos_v,
                    roughness,
                    split_sum_terms(&rule, shape, cos_v, roughness),
                )
            };
            (0..halves).filter(is_between).map(point).collect()
        };
        BetweenSplitSum {
            points: in_parallel(halves, &row, progress).concat(),
        }
    }

    /// The largest error of each term's lookup.
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
    use super::*;
    use crate::methods::find;

    #[test]
    fn corners_are_what_they_must_be() {
        let shape = find("fitted_dielectric")
            .and_then(|method| method.shape)
            .unwrap();
        let mut last = 0;
        let table = SplitSum::new(&shape, 9, &mut |done, of| {
            assert_eq!((done, of), (last + 1, 9));
            last = done;
        });
        let table = table.unwrap();
        // A mirror at 90 degrees, and from above.
        assert_eq!(table.texels[0], [1.0; TERMS]);
        assert_eq!(table.texels[8], [1.0, 0.0, 0.0, 0.0]);
        // The roughest from above: T_0 is 1 - ln 2.
        assert!((table.texels[80][0] - 0.306_853).abs() < 1e-5);
        let stored = table.stored(Depth::Float);
        for (i, texel) in table.texels.iter().enumerate() {
            let place = |i: usize| i as f64 / 8.0;
            let (c, r) = (
                split_sum_cosine(place(i % 9)),
                split_sum_roughness(place(i / 9)),
            );
            for (got, want) in stored.lookup(Weights::Exact, c, r).iter().zip(texel) {
                assert!((got - want).abs() < 1e-6, "{c} {r}: {got} {want}");
            }
        }
        let five = find("fitted_five").and_then(|method| method.shape).unwrap();
        assert_eq!(
            SplitSum::new(&five, 9, &mut |_, _| {}),
            Err(Error::Terms { terms: 5 })
        );
    }
}
