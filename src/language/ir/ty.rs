//! The types of values, and the names of their channels.

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Ty {
    /// One number.
    Scalar,
    /// Three channels: a colour, or a point or a direction in space.
    Vec3,
    /// The answer to a comparison.
    Bool,
    /// A texture with the sampler that filters it: an argument only.
    Texture,
    /// A cube map with its sampler: an argument only.
    Cube,
    /// Two numbers: an argument only.
    Vec2,
    /// Four numbers: an argument only.
    Vec4,
    /// A 4 by 4 matrix, column-major, which multiplies column vectors: an argument only.
    Mat4,
}

impl Ty {
    /// How many channels a value of this type has.
    pub fn channels(self) -> usize {
        match self {
            Ty::Vec3 => 3,
            Ty::Vec2 => 2,
            Ty::Vec4 => 4,
            Ty::Mat4 => 16,
            Ty::Scalar | Ty::Bool | Ty::Texture | Ty::Cube => 1,
        }
    }

    /// Whether it is a texture or a cube, which fetches read.
    pub fn is_sampled(self) -> bool {
        matches!(self, Ty::Texture | Ty::Cube)
    }

    /// The name in the text form.
    pub fn name(self) -> &'static str {
        match self {
            Ty::Scalar => "scalar",
            Ty::Vec3 => "rgb",
            Ty::Bool => "bool",
            Ty::Texture => "texture",
            Ty::Cube => "cube",
            Ty::Vec2 => "vec2",
            Ty::Vec4 => "vec4",
            Ty::Mat4 => "mat4",
        }
    }
}

/// The names of the channels of three numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Letters {
    /// r, g, b: the function computes with colours.
    #[default]
    Rgb,
    /// x, y, z: it computes with points and directions.
    Xyz,
}

impl Letters {
    /// The letter of a channel of this type.
    pub fn letter(self, ty: Ty, channel: usize) -> &'static str {
        let letters = match (self, ty) {
            (Letters::Rgb, Ty::Vec3) => ["r", "g", "b", "a"],
            _ => ["x", "y", "z", "w"],
        };
        letters[channel]
    }
}
