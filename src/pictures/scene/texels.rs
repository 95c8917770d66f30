//! Tables of four channels, rounded to binary16 as the device holds them, so that the tracer and the device look up the same
//! values.

use std::iter::Sum;
use std::ops::Div;

use glam::{DVec2, DVec4};
use half::f16;

use crate::physics::num::in_parallel;

/// A table of texels, row after row.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    width: usize,
    height: usize,
    texels: Vec<[f32; 4]>,
}

impl Texels {
    /// A table from a function of column and row.
    pub fn baked(
        [width, height]: [usize; 2],
        texel: impl Fn(usize, usize) -> DVec4 + Sync,
    ) -> Texels {
        let [table] = Texels::baked_together([width, height], |column, row| [texel(column, row)]);
        table
    }

    /// Several tables of one size, whose texels at a column and row are computed together.
    pub fn baked_together<const N: usize>(
        [width, height]: [usize; 2],
        texels: impl Fn(usize, usize) -> [DVec4; N] + Sync,
    ) -> [Texels; N] {
        let rounded = |texel: DVec4| texel.to_array().map(|value| f16::from_f64(value).to_f32());
        let row = |row: usize| -> Vec<[[f32; 4]; N]> {
            let at = |column| texels(column, row).map(rounded);
            (0..width).map(at).collect()
        };
        let rows = in_parallel(height, &row, &mut |_, _| {});
        std::array::from_fn(|i| Texels {
            width,
            height,
            texels: rows.iter().flatten().map(|texels| texels[i]).collect(),
        })
    }

    /// Its width and height.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The texels.
    pub fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// The texel at a column and a row.
    pub fn texel(&self, column: usize, row: usize) -> DVec4 {
        DVec4::from_array(self.texels[row * self.width + column].map(f64::from))
    }

    /// The same with every texel changed.
    pub fn mapped(&self, change: impl Fn([f32; 4]) -> [f32; 4]) -> Texels {
        let texels = self.texels.iter();
        Texels {
            texels: texels.map(|texel| change(*texel)).collect(),
            ..*self
        }
    }

    /// The means of squares of this many texels a side, rounded to binary16.
    pub fn reduced(&self, by: usize) -> Texels {
        Texels::baked([self.width / by, self.height / by], |column, row| {
            let mut sum = DVec4::ZERO;
            for y in row * by..(row + 1) * by {
                for x in column * by..(column + 1) * by {
                    sum += self.texel(x, y);
                }
            }
            sum / (by * by) as f64
        })
    }

    /// The value at texture coordinates, (0, 0) in the corner of the first texel. It is linear between texels, and clamped beyond
    /// the edge.
    pub fn at(&self, uv: DVec2) -> DVec4 {
        let last = self.width as f64 - 1.0;
        self.linear(uv, &|x| x.clamp(0.0, last) as usize)
    }

    /// The same, but wrapped around along the rows.
    pub fn at_around(&self, uv: DVec2) -> DVec4 {
        let width = self.width as i64;
        self.linear(uv, &|x| (x as i64).rem_euclid(width) as usize)
    }

    fn linear(&self, uv: DVec2, column: &dyn Fn(f64) -> usize) -> DVec4 {
        let place = uv * DVec2::new(self.width as f64, self.height as f64) - 0.5;
        let first = place.floor();
        let texel = |x: f64, y: f64| {
            let row = y.clamp(0.0, self.height as f64 - 1.0) as usize;
            self.texel(column(x), row)
        };
        let between = place - first;
        let along = |y: f64| texel(first.x, y).lerp(texel(first.x + 1.0, y), between.x);
        along(first.y).lerp(along(first.y + 1.0), between.y)
    }
}

/// A picture that a pass writes or reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slot {
    /// The shown picture; alpha says what each pixel shows.
    Colour,
    /// Positions of the body's back.
    BackPositions,
    /// Normals of the body's back.
    BackNormals,
    /// What lies below the water, with 1 in alpha; 0 for what stands in front of it.
    Below,
    /// Positions of what lies below the water.
    BelowPositions,
    /// The scene above the water, mirrored in it.
    Mirror,
    /// Positions of what is mirrored, with 1 in alpha; 0 where there is only the sky.
    MirrorPositions,
    /// The cube map of the room.
    Room,
    /// The normal map.
    Relief,
    /// The radiance of solid things, by their texture coordinates. For a window the colours: of glass with 1 in alpha, of lead
    /// and stone with 0.
    Paint,
}

/// The means of squares of this many samples a side, of a square picture.
pub fn square_means<T>(samples: &[T], each: usize) -> Vec<T>
where
    T: Copy + Sum + Div<f64, Output = T>,
{
    let side = samples.len().isqrt();
    let pixels = side / each;
    let pixel = |i: usize| {
        let (x, y) = (i % pixels * each, i / pixels * each);
        let rows = (y..y + each).flat_map(|y| &samples[y * side + x..][..each]);
        rows.copied().sum::<T>() / (each * each) as f64
    };
    (0..pixels * pixels).map(pixel).collect()
}

/// A pseudo-random number from 0 to 1, always the same for the same pair, by the mixing steps of SplitMix64 (Steele, Lea,
/// Flood, *Fast Splittable Pseudorandom Number Generators*, OOPSLA 2014, <https://doi.org/10.1145/2660193.2660195>).
pub fn scattered(a: i64, b: i64) -> f64 {
    let mut z = (a as u64)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .wrapping_add((b as u64).wrapping_mul(0xd1b5_4a32_d192_ed03));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) as f64 / u64::MAX as f64
}

/// [`scattered`], smooth between whole numbers.
pub fn smooth_noise(place: DVec2) -> f64 {
    let first = place.floor();
    let between = place - first;
    let share = between * between * (3.0 - 2.0 * between);
    let at = |x: f64, y: f64| scattered((first.x + x) as i64, (first.y + y) as i64);
    let along = |y: f64| at(0.0, y) + share.x * (at(1.0, y) - at(0.0, y));
    along(0.0) + share.y * (along(1.0) - along(0.0))
}
