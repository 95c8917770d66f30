//! How languages spell operations. The C family agrees on most, and each target's table says where it differs.

use crate::language::ir::{Op, Ty};
use crate::physics::num::Precision;

/// How an operation is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `a + b`, with its precedence; left-associative.
    Infix(&'static str, u8),
    /// `-a`
    Prefix(&'static str),
    /// `name(a, b)`
    Call(&'static str),
    /// `a` followed by this suffix, as in `(1.0).xxx`.
    Postfix(&'static str),
    /// `name(a, 0.0, 1.0)`
    CallUnit(&'static str),
    /// `a.r`
    Channel,
    /// `condition ? yes : no`
    Ternary,
    /// `name(no, yes, condition)`
    CallSelect(&'static str),
    /// This text, with `{0}` and so on for the arguments, and `{w}` for the letter of a row.
    Pattern(&'static str),
    /// Not written as an operation: constants and arguments.
    Leaf,
}

/// Operator precedences, from loose to tight.
pub mod precedence {
    /// `a ? b : c`
    pub const TERNARY: u8 = 1;
    /// `a < b`
    pub const COMPARE: u8 = 2;
    /// `a + b`
    pub const SUM: u8 = 3;
    /// `a * b`
    pub const PRODUCT: u8 = 4;
    /// `-a`
    pub const PREFIX: u8 = 5;
    /// `a.r`, `f(a)`, names, numbers
    pub const TIGHT: u8 = 6;
}

/// How a language is written. Its patterns hold the placeholders `{type}`, `{name}`, `{value}` and `{params}`.
#[derive(Debug)]
pub struct Spelling {
    /// The precision of its numbers.
    pub precision: Precision,
    /// The start of a line comment.
    pub comment: &'static str,
    /// The scalar type.
    pub scalar: &'static str,
    /// The colour type.
    pub rgb: &'static str,
    /// The declaration of an argument.
    pub param: &'static str,
    /// The declaration of a texture argument, with its sampler `{name}_sampler` where the language has a separate one.
    pub texture: &'static str,
    /// The declaration of a cube map argument, likewise.
    pub cube: &'static str,
    /// The types of two numbers, of four numbers and of a 4 by 4 matrix.
    pub vec2: &'static str,
    /// See `vec2`.
    pub vec4: &'static str,
    /// See `vec2`.
    pub mat4: &'static str,
    /// The declaration of a named step.
    pub local: &'static str,
    /// The head of a function, without its brace.
    pub head: &'static str,
    /// The suffix of a number.
    pub suffix: &'static str,
    /// Whether `max(colour, scalar)` is legal, so that a scalar need not be splatted.
    pub mixed_min_max: bool,
    /// Whether the language has a preprocessor, and library files an include guard.
    pub guard: bool,
    /// Where the language differs from the C family.
    pub differs: &'static [(Op, Form)],
}

/// What GLSL, HLSL and MSL share. Each states where it differs.
pub(super) const C_FAMILY: Spelling = Spelling {
    precision: Precision::F32,
    comment: "//",
    scalar: "float",
    rgb: "vec3",
    param: "{type} {name}",
    texture: "sampler2D {name}",
    cube: "samplerCube {name}",
    vec2: "vec2",
    vec4: "vec4",
    mat4: "mat4",
    local: "{type} {name} = {value};",
    head: "{type} {name}({params})",
    suffix: "",
    mixed_min_max: true,
    guard: true,
    differs: &[],
};

impl Spelling {
    /// How this language writes an operation.
    pub fn form(&self, op: Op) -> Form {
        let own = self.differs.iter().find(|(other, _)| *other == op);
        own.map_or_else(|| c_family(op), |(_, form)| *form)
    }

    /// The name of a type.
    pub fn ty(&self, ty: Ty) -> &'static str {
        match ty {
            Ty::Vec3 => self.rgb,
            Ty::Vec2 => self.vec2,
            Ty::Vec4 => self.vec4,
            Ty::Mat4 => self.mat4,
            Ty::Scalar | Ty::Bool | Ty::Texture | Ty::Cube => self.scalar,
        }
    }

    /// A number: the fewest digits that read back as the same value in this precision, always with a decimal point.
    pub fn number(&self, value: f64) -> String {
        let digits = match self.precision {
            Precision::F32 => format!("{:?}", value as f32),
            Precision::F16 => format!("{:?}", shortest_half(value)),
        };
        let digits = match digits.split_once('e') {
            Some((mantissa, exponent)) if !mantissa.contains('.') => {
                format!("{mantissa}.0e{exponent}")
            }
            _ => digits,
        };
        digits + self.suffix
    }
}

/// The decimal number with the fewest digits that rounds to the same f16 as this. Five digits tell all f16 apart.
fn shortest_half(value: f64) -> f64 {
    let half = Precision::F16.rounded(value);
    let with = |digits: usize| format!("{half:.digits$e}").parse().unwrap_or(half);
    (0..5)
        .map(with)
        .find(|short| Precision::F16.rounded(*short) == half)
        .unwrap_or(half)
}

/// How GLSL, HLSL and MSL all write an operation.
fn c_family(op: Op) -> Form {
    match op {
        Op::Number | Op::Param => Form::Leaf,
        Op::Splat | Op::Compose => Form::Call("vec3"),
        Op::Channel => Form::Channel,
        Op::Add => Form::Infix("+", precedence::SUM),
        Op::Sub => Form::Infix("-", precedence::SUM),
        Op::Mul => Form::Infix("*", precedence::PRODUCT),
        Op::Div => Form::Infix("/", precedence::PRODUCT),
        Op::Neg => Form::Prefix("-"),
        Op::Abs => Form::Call("abs"),
        Op::Min => Form::Call("min"),
        Op::Max => Form::Call("max"),
        Op::Saturate => Form::Call("saturate"),
        Op::Sqrt => Form::Call("sqrt"),
        Op::InverseSqrt => Form::Call("rsqrt"),
        Op::Exp2 => Form::Call("exp2"),
        Op::Log2 => Form::Call("log2"),
        Op::Sin => Form::Call("sin"),
        Op::Cos => Form::Call("cos"),
        Op::Less => Form::Infix("<", precedence::COMPARE),
        Op::Select => Form::Ternary,
        Op::Dot => Form::Call("dot"),
        Op::Transform => Form::Pattern("({0} * vec4({1}, 1.0)).{w}"),
        Op::Sample => Form::Pattern("textureLod({0}, vec2({1}, {2}), 0.0).rgb"),
        Op::SampleAlpha => Form::Pattern("textureLod({0}, vec2({1}, {2}), 0.0).a"),
        Op::SampleCube => Form::Pattern("textureLod({0}, {1}, 0.0).rgb"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::ALL;
    use crate::physics::num::Precision;

    #[test]
    fn every_half_round_trips_with_a_point_and_few_digits() {
        let halves = (0..0x7c00u16).map(|bits| f64::from(half::f16::from_bits(bits)));
        for value in halves {
            let text = ALL[0].half.spelling.number(value);
            let back: f64 = text.parse().expect("it parses");
            assert_eq!(Precision::F16.rounded(back), value, "{text}");
            assert!(text.contains('.'), "{text}");
            let mantissa = text.split('e').next().unwrap_or_default().replace('.', "");
            assert!(mantissa.trim_matches('0').len() <= 5, "{text}");
        }
        let wgsl = super::super::find("wgsl").expect("it is there");
        let number = |value: f64| wgsl.half.spelling.number(value);
        assert_eq!([0.04, 1.0, -0.5].map(number), ["0.04h", "1.0h", "-0.5h"]);
        assert_eq!(number(Precision::F16.smallest()), "6.104e-5h");
    }

    #[test]
    fn numbers_round_trip_and_have_a_point() {
        let (least, odd) = (f64::from(f32::MIN_POSITIVE), 16_777_217.0);
        let cases = [0.0, -0.0, 1.0, 1e-7, 1e16, 0.1, 1e-37, least, odd, -5.55473];
        for target in ALL {
            for value in cases {
                let text = target.spelling.number(value);
                let digits = text.strip_suffix(target.spelling.suffix);
                let digits = digits.expect("the suffix is there");
                assert!(digits.contains('.'), "{}: {text}", target.name);
                let back: f32 = digits.parse().expect("it parses");
                let is_same = back.to_bits() == (value as f32).to_bits();
                assert!(is_same, "{}: {text}", target.name);
            }
        }
    }
}
