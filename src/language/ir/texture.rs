//! Textures and cube maps: their texels, and the filter that defines what sampling them gives.
//!
//! A linear sampler that clamps to the edge mixes the four texels whose centres surround the sampled point. The centre of
//! texel i of N lies at u = (i + 1/2)/N. GPUs keep eight fractional bits between two centres (Vulkan's
//! `subPixelPrecisionBits` and Direct3D's 8-bit fraction), so weights are multiples of 1/256. Source: Microsoft,
//! *Direct3D 11.3 Functional Specification*, section 7.18.8, 2015,
//! <https://microsoft.github.io/DirectX-Specs/d3d/archive/D3D11_3_FunctionalSpec.htm>.

use std::sync::Arc;

use crate::physics::num::{Num, each_channel};

/// The resolution of filter weights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// That of the coordinate.
    Exact,
    /// Steps of 1/256, as on GPUs.
    Steps256,
}

/// How a sampler filters the texels around a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// It interpolates them.
    #[default]
    Linear,
    /// It takes the one that contains the point.
    Nearest,
}

/// The texels of a texture, as a sampler returns them.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    /// Texels in a row.
    pub width: usize,
    /// Row by row, starting at v = 0.
    pub texels: Arc<[[f32; 3]]>,
    /// The fourth channel, where the texture has one. Otherwise it is sampled as 1.
    pub alpha: Option<Arc<[f32]>>,
    /// How they are filtered.
    pub filter: Filter,
}

/// The texels of a cube map, as a sampler returns them. Faces and their axes are those of OpenGL and Vulkan: left-handed,
/// seen from inside. Source: Khronos, *Vulkan 1.3 specification*, section 16.5.4, "Cube Map Face Selection",
/// <https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#_cube_map_face_selection_and_transformations>.
#[derive(Clone, Debug, PartialEq)]
pub struct CubeTexels {
    /// Texels in a row of a face.
    pub size: usize,
    /// The faces +x, -x, +y, -y, +z, -z, each row by row.
    pub texels: Arc<[[f32; 3]]>,
}

/// The texels before and after a point, and its fraction of the way between them.
struct TexelPair<N> {
    before: usize,
    after: usize,
    share: N,
}

impl Texels {
    /// One row.
    #[inline]
    pub fn row(texels: &[[f32; 3]]) -> Texels {
        Texels {
            width: texels.len(),
            texels: texels.into(),
            alpha: None,
            filter: Filter::Linear,
        }
    }

    /// The number of rows.
    #[inline]
    pub fn height(&self) -> usize {
        self.texels.len().checked_div(self.width).unwrap_or(0)
    }

    /// The filtered value at (u, v). A NaN coordinate gives the first texel. An empty texture is black.
    pub fn sample<N: Num>(&self, weights: Weights, u: N, v: N) -> [N; 3] {
        self.filtered(weights, u, v, &|at| {
            let texel = self.texels.get(at).copied().unwrap_or_default();
            each_channel(|i| N::from_f64(f64::from(texel[i])))
        })
    }

    /// The fourth channel at (u, v).
    pub fn sample_alpha<N: Num>(&self, weights: Weights, u: N, v: N) -> N {
        let Some(alpha) = &self.alpha else {
            return N::from_f64(1.0);
        };
        let texel = |at: usize| {
            let alpha = alpha.get(at).copied().unwrap_or_default();
            [N::from_f64(f64::from(alpha)); 3]
        };
        self.filtered(weights, u, v, &texel)[0]
    }

    fn filtered<N: Num>(
        &self,
        weights: Weights,
        u: N,
        v: N,
        texel: &impl Fn(usize) -> [N; 3],
    ) -> [N; 3] {
        if self.filter == Filter::Nearest {
            let place = |coordinate: N, count: usize| {
                let place = (coordinate.to_f64() * count as f64).floor();
                place.max(0.0).min(count as f64 - 1.0) as usize
            };
            return texel(place(v, self.height()) * self.width + place(u, self.width));
        }
        let across = between(weights, u, self.width);
        let row = |row: usize| {
            let start = row * self.width;
            let (before, after) = (texel(start + across.before), texel(start + across.after));
            mixed(before, after, across.share)
        };
        if self.height() < 2 {
            return row(0);
        }
        let down = between(weights, v, self.height());
        mixed(row(down.before), row(down.after), down.share)
    }
}

/// A face of a cube: its signed major axis, and the signed axes along which s and t grow.
struct Face {
    lies: (usize, f64),
    s: (usize, f64),
    t: (usize, f64),
}

const fn face(lies: (usize, f64), s: (usize, f64), t: (usize, f64)) -> Face {
    Face { lies, s, t }
}

impl Face {
    /// Where a direction hits the plane of the face, along both axes: from -1 to 1 inside it.
    fn hit<N: Num>(&self, direction: [N; 3]) -> [N; 2] {
        let place = |(axis, sign): (usize, f64)| {
            N::from_f64(sign) * direction[axis] / direction[self.lies.0].abs()
        };
        [self.s, self.t].map(place)
    }
}

const FACES: [Face; 6] = [
    face((0, 1.0), (2, -1.0), (1, -1.0)),
    face((0, -1.0), (2, 1.0), (1, -1.0)),
    face((1, 1.0), (0, 1.0), (2, 1.0)),
    face((1, -1.0), (0, 1.0), (2, -1.0)),
    face((2, 1.0), (0, 1.0), (1, -1.0)),
    face((2, -1.0), (0, -1.0), (1, -1.0)),
];

impl CubeTexels {
    /// The value in a direction of any length, filtered across the edges of faces. A NaN or a zero vector gives some texel.
    pub fn sample<N: Num>(&self, direction: [N; 3]) -> [N; 3] {
        let face = face_of(direction.map(N::to_f64));
        let half = N::from_f64(0.5);
        let size = N::from_f64(self.size as f64);
        let place = |along: N| {
            let place = (along + N::from_f64(1.0)) * half * size - half;
            // `min` and `max` of a NaN and a number give the number.
            place.max(N::from_f64(-1.0)).min(size)
        };
        let [s, t] = FACES[face].hit(direction).map(place);
        let [left, top] = [s, t].map(|place| place.to_f64().floor());
        let texel = |right: f64, down: f64| {
            let texel = self.texel(face, left + right, top + down);
            each_channel(|i| N::from_f64(f64::from(texel[i])))
        };
        let (across, down) = (s - N::from_f64(left), t - N::from_f64(top));
        let above = mixed(texel(0.0, 0.0), texel(1.0, 0.0), across);
        let below = mixed(texel(0.0, 1.0), texel(1.0, 1.0), across);
        mixed(above, below, down)
    }

    /// The direction through the centre of a texel of a face; it may lie beyond the face's edges.
    pub fn direction(&self, face: usize, column: f64, row: f64) -> [f64; 3] {
        let Face { lies, s, t } = &FACES[face];
        let along = |place: f64| 2.0 * (place + 0.5) / self.size as f64 - 1.0;
        let mut direction = [0.0; 3];
        direction[lies.0] = lies.1;
        direction[s.0] = s.1 * along(column);
        direction[t.0] = t.1 * along(row);
        direction
    }

    /// A texel of a face. Beyond an edge it is the adjacent texel of the neighbouring face.
    fn texel(&self, face: usize, column: f64, row: f64) -> [f32; 3] {
        let last = self.size as f64 - 1.0;
        let is_inside = |place: f64| (0.0..=last).contains(&place);
        let (face, column, row) = if is_inside(column) && is_inside(row) {
            (face, column, row)
        } else {
            self.nearest(self.direction(face, column, row))
        };
        let at = (face * self.size + row as usize) * self.size + column as usize;
        self.texels.get(at).copied().unwrap_or_default()
    }

    /// The texel that a direction hits.
    fn nearest(&self, direction: [f64; 3]) -> (usize, f64, f64) {
        let face = face_of(direction);
        let place = |along: f64| {
            let place = ((along + 1.0) / 2.0 * self.size as f64).floor();
            place.max(0.0).min(self.size as f64 - 1.0)
        };
        let [column, row] = FACES[face].hit(direction).map(place);
        (face, column, row)
    }
}

/// The face that a direction hits: that of its largest component. Ties go to z before y, and to y before x.
fn face_of(direction: [f64; 3]) -> usize {
    let [x, y, z] = direction.map(f64::abs);
    let axis = if z >= x && z >= y {
        2
    } else if y >= x {
        1
    } else {
        0
    };
    2 * axis + usize::from(direction[axis] < 0.0)
}

/// The filtered value at u in one row of texels.
#[inline]
pub fn filtered<N: Num>(texels: &[[f32; 3]], weights: Weights, u: N) -> [N; 3] {
    let across = between(weights, u, texels.len());
    let texel = |column: usize| {
        let texel = texels.get(column).copied().unwrap_or_default();
        each_channel(|i| N::from_f64(f64::from(texel[i])))
    };
    mixed(texel(across.before), texel(across.after), across.share)
}

/// a (1 - share) + b share
#[inline]
fn mixed<N: Num>(a: [N; 3], b: [N; 3], share: N) -> [N; 3] {
    let rest = N::from_f64(1.0) - share;
    each_channel(|i| a[i] * rest + b[i] * share)
}

/// The nearest whole number, halves upwards, and 0 for a NaN. Below 0 it may be the next one towards 0. `round` is a call on x86-64.
#[inline]
fn rounded(x: f64) -> f64 {
    let whole = x as i64 as f64;
    whole + f64::from(u8::from(x - whole >= 0.5))
}

/// The pair of texels around a coordinate, of `count` texels.
#[inline]
fn between<N: Num>(weights: Weights, coordinate: N, count: usize) -> TexelPair<N> {
    let last = count.saturating_sub(1);
    let number = |value: usize| N::from_f64(value as f64);
    let place = coordinate * number(count) - N::from_f64(0.5);
    let place = match weights {
        Weights::Exact => place,
        Weights::Steps256 => N::from_f64(rounded(place.to_f64() * 256.0) / 256.0),
    };
    // `min` and `max` of a NaN and a number give the number.
    let place = place.max(number(0)).min(number(last));
    let before = place.to_f64() as usize;
    TexelPair {
        before,
        after: (before + 1).min(last),
        share: place - number(before),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_between_four_centres_mixes_them() {
        let texels = Texels {
            width: 2,
            texels: [[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]].into(),
            alpha: Some([4.0, 4.0, 6.0, 6.0].into()),
            filter: Filter::Linear,
        };
        let nearest = Texels {
            filter: Filter::Nearest,
            ..texels.clone()
        };
        assert_eq!(nearest.sample(Weights::Exact, 0.51, 0.49), [1.0; 3]);
        assert_eq!(nearest.sample_alpha(Weights::Exact, 2.0, f64::NAN), 4.0);
        assert_eq!(texels.sample_alpha(Weights::Exact, 0.9, 0.5), 5.0);
        for (u, v, want) in [
            (0.25, 0.25, 0.0),
            (0.75, 0.25, 1.0),
            (0.25, 0.75, 2.0),
            (0.5, 0.5, 1.5),
            (-1.0, 9.0, 2.0),
            (f64::NAN, 0.25, 0.0),
        ] {
            for weights in [Weights::Exact, Weights::Steps256] {
                assert_eq!(texels.sample(weights, u, v), [want; 3], "{u} {v}");
            }
        }
        let third = texels.sample(Weights::Steps256, 0.25 + 0.5 / 3.0, 0.25);
        assert_eq!(third, [85.0 / 256.0; 3]);
        assert_eq!(Texels::row(&[]).sample(Weights::Exact, 0.5, 0.5), [0.0; 3]);
    }

    /// A cube whose texels hold their directions gives back the sampled direction everywhere, across edges too.
    #[test]
    fn a_cube_is_filtered_across_its_edges() {
        let mut cube = CubeTexels {
            size: 64,
            texels: Arc::new([]),
        };
        let unit = |d: [f64; 3]| {
            let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
            d.map(|x| x / length)
        };
        let texel = |at: usize| {
            let (face, row, column) = (at / 4096, at / 64 % 64, at % 64);
            unit(cube.direction(face, column as f64, row as f64)).map(|x| x as f32)
        };
        cube.texels = (0..6 * 4096).map(texel).collect();
        for direction in [
            [1.0, 0.0, 0.0],
            [-1.0, 0.2, 0.3],
            [0.3, 1.0, 0.999],
            [0.3, -1.0, 0.9999],
            [0.5, 0.5, 0.4999],
            [0.1, -0.7, -0.7],
            [-2.0, 2.0, 2.0],
        ] {
            let got: [f64; 3] = cube.sample(direction);
            for (got, want) in got.into_iter().zip(unit(direction)) {
                assert!((got - want).abs() < 2e-3, "{direction:?}: {got} {want}");
            }
        }
        assert!(cube.sample([0.0; 3]).iter().all(|x: &f64| x.is_finite()));
    }
}
