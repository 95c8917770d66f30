//! The types of values, and the table of operations: name, signature, meaning, work. All code reads this table, except evaluation and
//! spelling, which define what an operation computes and how a language writes it.

/// An operation. Its row in [`OPS`] says the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // each is documented by its row in the table
pub enum Op {
    Number,
    Param,
    Splat,
    Compose,
    Channel,
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    Abs,
    Min,
    Max,
    Saturate,
    Sqrt,
    InverseSqrt,
    Exp2,
    Log2,
    Sin,
    Cos,
    Less,
    Select,
    Dot,
    Transform,
    Sample,
    SampleAlpha,
    SampleCube,
}

/// What a node carries beside its arguments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Payload {
    /// Nothing.
    None,
    /// The value of a `number`.
    Number(f64),
    /// Which parameter (`param`), which channel (`channel`), or which row (`transform`).
    Index(usize),
}

/// The argument types that an operation takes, and the type of its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signature {
    /// `() -> scalar`, with a number as payload.
    Number,
    /// `() -> the parameter's type`, with an index as payload.
    Param,
    /// `(scalar) -> rgb`
    Splat,
    /// `(scalar, scalar, scalar) -> rgb`
    Compose,
    /// `(rgb, vec2 or vec4) -> scalar`, with a channel as payload.
    Channel,
    /// `(T) -> T`, T scalar or rgb.
    Unary,
    /// `(T, T) -> T`, T scalar or rgb.
    Alike,
    /// `(scalar or rgb, scalar or rgb) -> rgb` if either is rgb, else scalar.
    Mixed,
    /// `(scalar, scalar) -> bool`
    Compare,
    /// `(bool, scalar, scalar) -> scalar`
    Choose,
    /// `(rgb, rgb) -> scalar`
    Dot,
    /// `(mat4, rgb) -> scalar`, with a row, 0 to 3, as payload.
    Transform,
    /// `(texture, scalar, scalar) -> rgb`
    Fetch,
    /// `(texture, scalar, scalar) -> scalar`
    FetchAlpha,
    /// `(cube, rgb) -> rgb`
    FetchCube,
}

impl Signature {
    /// The number of arguments.
    pub fn arity(self) -> usize {
        match self {
            Signature::Number | Signature::Param => 0,
            Signature::Splat | Signature::Channel | Signature::Unary => 1,
            Signature::Alike | Signature::Mixed | Signature::Compare => 2,
            Signature::Dot | Signature::Transform | Signature::FetchCube => 2,
            Signature::Compose | Signature::Choose => 3,
            Signature::Fetch | Signature::FetchAlpha => 3,
        }
    }

    /// The number of values that a node's index can have. None where it carries no index, or where the function's parameters
    /// decide.
    pub fn indices(self, arguments: &[Ty]) -> Option<usize> {
        match (self, arguments) {
            (Signature::Channel, [ty]) => Some(ty.channels()),
            (Signature::Transform, _) => Some(4),
            _ => None,
        }
    }

    /// The result type for these argument types, or nothing where they do not match. A parameter's type is not
    /// known here and is returned as a scalar.
    pub fn result(self, arguments: &[Ty]) -> Option<Ty> {
        use Ty::{Bool, Cube, Mat4, Scalar, Texture, Vec2, Vec3, Vec4};
        match (self, arguments) {
            (Signature::Number | Signature::Param, []) => Some(Scalar),
            (Signature::Splat, [Scalar]) => Some(Vec3),
            (Signature::Compose, [Scalar, Scalar, Scalar]) => Some(Vec3),
            (Signature::Channel, [Vec3 | Vec2 | Vec4]) => Some(Scalar),
            (Signature::Unary, [t @ (Scalar | Vec3)]) => Some(*t),
            (Signature::Alike, [a @ (Scalar | Vec3), b]) if a == b => Some(*a),
            (Signature::Mixed, [Scalar, Scalar]) => Some(Scalar),
            (Signature::Mixed, [Scalar | Vec3, Scalar | Vec3]) => Some(Vec3),
            (Signature::Compare, [Scalar, Scalar]) => Some(Bool),
            (Signature::Choose, [Bool, Scalar, Scalar]) => Some(Scalar),
            (Signature::Dot, [Vec3, Vec3]) => Some(Scalar),
            (Signature::Transform, [Mat4, Vec3]) => Some(Scalar),
            (Signature::Fetch, [Texture, Scalar, Scalar]) => Some(Vec3),
            (Signature::FetchAlpha, [Texture, Scalar, Scalar]) => Some(Scalar),
            (Signature::FetchCube, [Cube, Vec3]) => Some(Vec3),
            _ => None,
        }
    }
}

/// A row of the operation table.
#[derive(Clone, Copy, Debug)]
pub struct OpInfo {
    /// The operation.
    pub op: Op,
    /// Its name in the text form.
    pub name: &'static str,
    /// Its types.
    pub signature: Signature,
    /// Scalar operations for one channel. 0 for an operation that only names or moves a value.
    pub work: usize,
    /// What it computes.
    pub meaning: &'static str,
}

const fn row(
    op: Op,
    name: &'static str,
    signature: Signature,
    work: usize,
    meaning: &'static str,
) -> OpInfo {
    OpInfo {
        op,
        name,
        signature,
        work,
        meaning,
    }
}

/// Every operation, in the order of [`Op`].
#[rustfmt::skip]
pub static OPS: [OpInfo; 27] = [
    row(Op::Number,      "number",       Signature::Number,  0, "a constant"),
    row(Op::Param,       "param",        Signature::Param,   0, "an argument of the function"),
    row(Op::Splat,       "splat",        Signature::Splat,   0, "the same scalar in each channel"),
    row(Op::Compose,     "compose",      Signature::Compose, 0, "a colour from three scalars"),
    row(Op::Channel,     "channel",      Signature::Channel, 0, "one channel of a colour"),
    row(Op::Add,         "add",          Signature::Mixed,   1, "a + b"),
    row(Op::Sub,         "sub",          Signature::Mixed,   1, "a - b"),
    row(Op::Mul,         "mul",          Signature::Mixed,   1, "a b"),
    row(Op::Div,         "div",          Signature::Mixed,   1, "a / b"),
    row(Op::Neg,         "neg",          Signature::Unary,   1, "-a"),
    row(Op::Abs,         "abs",          Signature::Unary,   1, "|a|"),
    row(Op::Min,         "min",          Signature::Alike,   1, "the smaller"),
    row(Op::Max,         "max",          Signature::Alike,   1, "the larger"),
    row(Op::Saturate,    "saturate",     Signature::Unary,   1, "a limited to [0, 1]"),
    row(Op::Sqrt,        "sqrt",         Signature::Unary,   1, "the square root"),
    row(Op::InverseSqrt, "inverse_sqrt", Signature::Unary,   1, "1 / the square root"),
    row(Op::Exp2,        "exp2",         Signature::Unary,   1, "2 to the power a"),
    row(Op::Log2,        "log2",         Signature::Unary,   1, "the logarithm to base 2"),
    row(Op::Sin,         "sin",          Signature::Unary,   1, "the sine of a in radians"),
    row(Op::Cos,         "cos",          Signature::Unary,   1, "the cosine of a in radians"),
    row(Op::Less,        "less",         Signature::Compare, 1, "a < b"),
    row(Op::Select,      "select",       Signature::Choose,  1, "b where a holds, else c"),
    row(Op::Dot,         "dot",          Signature::Dot,     2, "the scalar product: a.x b.x + a.y b.y + a.z b.z"),
    row(Op::Transform,   "transform",    Signature::Transform, 2, "a row of the matrix a times the column (b, 1)"),
    row(Op::Sample,      "sample",       Signature::Fetch,   0, "the texture a at (b, c), filtered linearly, level 0"),
    row(Op::SampleAlpha, "sample_alpha", Signature::FetchAlpha, 0, "its fourth channel"),
    row(Op::SampleCube,  "sample_cube",  Signature::FetchCube, 0, "the cube a in the direction b, filtered linearly, level 0"),
];

impl Op {
    /// Whether it reads a texture or a cube.
    pub fn is_fetch(self) -> bool {
        matches!(self, Op::Sample | Op::SampleAlpha | Op::SampleCube)
    }

    /// The row of this operation.
    pub fn info(self) -> &'static OpInfo {
        &OPS[self as usize]
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_in_the_order_of_the_operations() {
        for (index, row) in OPS.iter().enumerate() {
            assert_eq!(row.op as usize, index, "{}", row.name);
        }
    }

    #[test]
    fn signatures_accept_their_types_and_no_others() {
        use Ty::{Bool, Scalar, Vec3};
        assert_eq!(Signature::Mixed.result(&[Scalar, Vec3]), Some(Vec3));
        assert_eq!(Signature::Mixed.result(&[Bool, Vec3]), None);
        assert_eq!(Signature::Alike.result(&[Scalar, Vec3]), None);
        assert_eq!(
            Signature::Choose.result(&[Bool, Vec3, Vec3]),
            None,
            "a choice is scalar"
        );
        for row in &OPS {
            assert_eq!(
                row.signature.result(&vec![Bool; row.signature.arity() + 1]),
                None,
                "{}",
                row.name
            );
        }
    }
}
