//! The inputs of methods: one vocabulary with units and domain, in the order in which functions take them.

use crate::ir::{Builder, COSINE, Expr, Ty};
use crate::num::Precision;

/// An argument that a method takes after `cos_theta`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// Its name in every language.
    pub name: &'static str,
    /// Scalar, a value per channel, or a texture.
    pub ty: Ty,
    /// What it is, and its unit.
    pub meaning: &'static str,
    /// Where it lies in single precision.
    pub range: Range,
}

/// Where an argument lies, both ends included. Within its arguments' ranges a function gives a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub most: f64,
}

impl Range {
    /// In words: `0.001 to 1e9`.
    pub fn words(self) -> String {
        format!("{} to {}", figure(self.least), figure(self.most))
    }
}

/// A number as a person writes it.
fn figure(value: f64) -> String {
    if value.abs() < 1e5 {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

const fn rgb(name: &'static str, meaning: &'static str, least: f64, most: f64) -> Input {
    Input {
        name,
        ty: Ty::Rgb,
        meaning,
        range: Range { least, most },
    }
}

const fn scalar(name: &'static str, meaning: &'static str, least: f64, most: f64) -> Input {
    Input {
        name,
        ty: Ty::Scalar,
        meaning,
        range: Range { least, most },
    }
}

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const ETA: Input = rgb(
        "eta",
        "relative index of refraction, transmitted over incident (n_t / n_i)",
        0.001,
        1e12,
    );
    pub const N: Input = rgb(
        "n",
        "real part of the relative index of refraction",
        0.001,
        1e9,
    );
    pub const K: Input = rgb(
        "k",
        "extinction coefficient, the imaginary part of the relative index",
        0.0,
        1e9,
    );
    pub const F0: Input = rgb("f0", "reflectance at normal incidence, linear", 0.0, 1.0);
    pub const F90: Input = scalar("f90", "reflectance at 90 degrees", 0.0, 1.0);
    pub const F82: Input = rgb(
        "f82",
        "reflectance at cos_theta = 1/7 (81.79 degrees), linear",
        0.0,
        1.0,
    );
    pub const TINT: Input = rgb(
        "tint",
        "reflectance at 81.79 degrees over Schlick's value there",
        0.0,
        2.0,
    );
    pub const REFLECTIVITY: Input = rgb(
        "reflectivity",
        "reflectance at normal incidence, linear",
        0.0,
        1.0,
    );
    pub const EDGE_TINT: Input = rgb(
        "edge_tint",
        "1 for the least n that the reflectivity allows, 0 for the most",
        0.0,
        1.0,
    );
    pub const BIAS: Input = scalar("bias", "reflectance at normal incidence", 0.0, 1.0);
    pub const SCALE: Input = scalar("scale", "what grazing incidence adds", 0.0, 1.0);
    pub const POWER: Input = scalar("power", "how late it is added", 0.2, 1000.0);
    pub const EXPONENT: Input = scalar(
        "exponent",
        "how late the curve rises to f90; 5 is Schlick's",
        0.2,
        1000.0,
    );
    pub const LAMBDA: Input = rgb(
        "lambda",
        "exponent of the correction; 0 or less where there is none",
        -1000.0,
        1000.0,
    );

    pub const B2_WEIGHT: Input = rgb(
        "b2_weight",
        "weight of the second curve, solved at 82.64 degrees",
        -1000.0,
        1000.0,
    );
    pub const B3_WEIGHT: Input = rgb(
        "b3_weight",
        "weight of the third curve, solved at 64.38 degrees",
        -1000.0,
        1000.0,
    );

    pub const C0: Input = rgb("c0", "coefficient of 1", -1000.0, 1000.0);
    pub const C1: Input = rgb("c1", "coefficient of the first term", -1000.0, 1000.0);
    pub const C2: Input = rgb("c2", "coefficient of the second term", -1000.0, 1000.0);
    pub const C3: Input = rgb("c3", "coefficient of the third term", -1000.0, 1000.0);
    pub const C4: Input = rgb("c4", "coefficient of the fourth term", -1000.0, 1000.0);
    pub const COEFFICIENTS: [Input; 5] = [Input::C0, Input::C1, Input::C2, Input::C3, Input::C4];

    pub const TABLE: Input = Input {
        name: "table",
        ty: Ty::Texture,
        meaning: "the texture, and after it the sampler: reflectance along x, cos theta = 0 first, linear and not sRGB; the sampler filters linearly and clamps to the edge",
        range: Range {
            least: 0.0,
            most: 1.0,
        },
    };
    pub const TEXELS: Input = scalar("texels", "texels in a row of the table", 2.0, 16384.0);
    pub const WARP: Input = scalar(
        "warp",
        "how dense the axis is near grazing: 0 for cos theta itself, 4 for `--axis rational`",
        0.0,
        100.0,
    );
    pub const ROW: Input = scalar(
        "row",
        "where the row's middle lies: (index + 0.5) / rows, 0.5 for a table of its own",
        0.0,
        1.0,
    );
    pub const TABLE_SCALE: Input = scalar(
        "table_scale",
        "reflectance of a texel of 1: the `scale` beside the table",
        1.0,
        100.0,
    );

    /// Every input in the order of arguments.
    #[rustfmt::skip]
    pub const ORDER: [Input; 26] = [
        Input::ETA, Input::N, Input::K, Input::F0, Input::F90, Input::F82, Input::TINT, Input::REFLECTIVITY,
        Input::EDGE_TINT, Input::BIAS, Input::SCALE, Input::POWER, Input::EXPONENT, Input::LAMBDA,
        Input::B2_WEIGHT, Input::B3_WEIGHT, Input::C0, Input::C1, Input::C2, Input::C3, Input::C4, Input::TABLE, Input::TEXELS, Input::WARP, Input::ROW, Input::TABLE_SCALE,
    ];
}

/// The input of this name.
pub fn find_input(name: &str) -> Option<Input> {
    Input::ORDER.into_iter().find(|input| input.name == name)
}

/// The arguments of a method while it is built.
#[derive(Debug)]
pub struct Inputs<'b> {
    cos_theta: Expr<'b>,
    given: Vec<(&'static str, Expr<'b>)>,
    precision: Precision,
}

impl<'b> Inputs<'b> {
    /// Declares `cos_theta` and these inputs as arguments. In the scalar form every input is a scalar.
    pub fn declare(
        builder: &'b Builder,
        inputs: &[Input],
        scalar_form: bool,
        precision: Precision,
    ) -> Inputs<'b> {
        let cos_theta = builder.param(COSINE, Ty::Scalar);
        let ty = |input: &Input| match input.ty {
            Ty::Rgb if scalar_form => Ty::Scalar,
            ty => ty,
        };
        let given = inputs
            .iter()
            .map(|input| (input.name, builder.param(input.name, ty(input))))
            .collect();
        Inputs {
            cos_theta,
            given,
            precision,
        }
    }

    /// What the formula is computed in: one that overflows or cancels in half precision is built otherwise there.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Whether the formula is computed in half precision.
    pub fn is_half(&self) -> bool {
        self.precision.is_half()
    }

    /// `cos_theta` as it came. Only methods that are exempt from the contract use it so.
    pub fn raw_cosine(&self) -> Expr<'b> {
        self.cos_theta
    }

    /// `cos_theta` limited to [0, 1]: a rounded dot product may be 1 + 1 ulp, and a power of 1 - c would be NaN.
    pub fn cosine(&self) -> Expr<'b> {
        self.cos_theta
            .saturate()
            .named("c", "clamp: a rounded dot product may exceed 1")
    }

    /// An input that the method declared.
    pub fn get(&self, input: Input) -> Expr<'b> {
        let found = self.given.iter().find(|(name, _)| *name == input.name);
        found
            .expect("a method asks only for inputs that it declares; its first test would fail")
            .1
    }
}
