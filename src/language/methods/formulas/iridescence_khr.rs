//! `F = R12 + R_s + Σ 2 C_m S(m D)`: a film's fringes as a few terms of Airy's series, weighted with Gaussians that stand for an
//! observer, as the glTF extension KHR_materials_iridescence states it. It is kept for comparison.
//!
//! ```text
//! D = 2 n₂ d c₂                         the path; n₂ the film's index, c₂ the cosine in it
//! R12, R23                              by Schlick, of the film's and the base's F0; the base's index is real: (1 + √F0) / (1 - √F0)
//! T = 1 - R12, R_s = T² R23 / (1 - R12 R23), C_m = (R_s - T) (R12 R23)^(m/2), m = 1, 2
//! S(p) = a cos(2π b p + φ) exp(-s (2π p)²)    in X, Y and Z, then in linear sRGB
//! ```
//!
//! Source: Belcour, Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", ACM Transactions on
//! Graphics 36(4), 2017, <https://doi.org/10.1145/3072959.3073620>, in the form of
//! <https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_materials_iridescence>. The base's F0 is limited to .9999
//! in place of 1.0001 - F0, as three.js does it: the extension's text is not a number at F0 = .9999.
//! Domain: F0 from 0 to 1, film_ior from .05 to 10. Error: a metal has no real index, so its fringes have the wrong phase: .29 and more.
//! Of a film without thickness the bare base does not come back: three.js fades to it below .03 nm, the extension's text does not. The
//! result may exceed 1.

use super::*;

use crate::language::ir::{Builder, Ty};

/// Fringes as a series.
pub(super) const BELCOUR_BARLA_2017: Citation = Citation {
    authors: "Belcour, Barla",
    title: "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence",
    place: "ACM Transactions on Graphics 36(4)",
    year: 2017,
    link: "https://doi.org/10.1145/3072959.3073620",
};

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const FILM_IOR: Input = Input::scalar(
        "film_ior",
        "refractive index of the film at 550 nm, relative to the medium outside",
        [0.05, 10.0],
        InputSource::Material(|known| [known.film.ior; 3]),
    )
    .tried(&[1.3, 1.0, 2.4])
    .scanned(&[0.7, 1.0, 1.3, 1.5, 2.0, 2.6]);

    pub const BASE_F0: Input = Input::rgb(
        "base_f0",
        "reflectance of the base without its film at normal incidence, linear",
        [0.0, 1.0],
        InputSource::Material(|known| known.film.bare.f0),
    )
    .tried(&[0.04, 0.0, 0.5, 1.0])
    .scanned(&[0.0, 0.02, 0.04, 0.3, 0.6, 0.9, 0.99, 0.9999, 1.0]);
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "iridescence_khr",
    summary: "a film as KHR_materials_iridescence has it, for comparison",
    formula: &[
        "F = R12 + R_s + sum of 2 C_m S(m D), m = 1, 2, D = 2 film_ior d c2, C_m = (R_s - T) (R12 R23)^(m/2)",
        "T = 1 - R12, R_s = T^2 R23 / (1 - R12 R23), R12 and R23 by Schlick, the base's index (1 + sqrt(f0)) / (1 - sqrt(f0))",
    ],
    source: BELCOUR_BARLA_2017,
    origin: Origin::Adapted(
        "as KHR_materials_iridescence has it, with f0 limited to .9999 as in three.js",
    ),
    inputs: &[Input::THICKNESS, Input::FILM_IOR, Input::BASE_F0],
    class: Class::OneFilm,
    domain: "a real index stands for the base, so metals have the wrong phase; a film without thickness does not give the bare base",
    contract: Contract::Exempt("it may exceed 1"),
    claims: Claims {
        code_abs: 1.7e-6,
        ..Claims::NONE
    },
    half: InHalf::Refused("half precision keeps no phase"),
    build,
    ..Method::BASE
};

/// The largest F0 that has an index.
const MOST_F0: f64 = 0.9999;
/// The limits of R12 R23.
const PRODUCT: [f64; 2] = [1e-5, 0.9999];

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, ior) = (x.cosine(), x.get(Input::FILM_IOR));
    let number = |value: f64| c.builder().number(value);
    let (one, pi) = (number(1.0), number(std::f64::consts::PI));
    let inside2 = (1.0 - (1.0 - c.squared()) / ior.squared()).named("inside2", "");
    let inside = inside2
        .at_least(1e-12)
        .sqrt()
        .named("inside", "the cosine in the film");
    let outer = schlick(squared_ratio(ior, one), c, "outer_m").named("outer", "R12");
    let through = (1.0 - outer).named("through", "T");

    let root = x.get(Input::BASE_F0).at_least(1e-37);
    let root = root.min(number(MOST_F0).rgb()).sqrt().named("root", "");
    let base = ((1.0 + root) / (1.0 - root)).named("base", "the base's index");
    let inner = schlick(squared_ratio(base, ior), inside, "inner_m").named("inner", "R23");

    let product = (outer * inner).max(number(PRODUCT[0]).rgb());
    let product = product
        .min(number(PRODUCT[1]).rgb())
        .named("product", "R12 R23");
    let all = (through.squared() * inner / (1.0 - product)).named("sum", "R_s");
    let turned = ior.choose_below(one, number(0.0), pi)
        + base.choose_below(ior.rgb(), pi.rgb(), number(0.0).rgb());
    let turned = turned.named("turned", "what both faces add to the phase");
    let path = (2.0 * ior * x.get(Input::THICKNESS) * inside).named("path", "D");

    let step = product.sqrt().named("factor", "");
    let first = ((all - through) * step).named("first", "C_1");
    let fringe = |m: f64, part: Expr<'b>| {
        let order = (m * path).named(&format!("path_{m}"), "");
        2.0 * part * to_rgb(observed(order, m * turned, m), SRGB, m)
    };
    let whole = outer + all + fringe(1.0, first) + fringe(2.0, first * step);
    let whole = whole.max(number(0.0).rgb()).named("whole", "");
    inside2.choose_below(number(0.0), one.rgb(), whole)
}

/// ((a - b) / (a + b))²
fn squared_ratio<'b>(a: Expr<'b>, b: Expr<'b>) -> Expr<'b> {
    let ratio = ((a - b) / (a + b)).named(
        if a.ty() == Ty::Vec3 {
            "inner_ratio"
        } else {
            "outer_ratio"
        },
        "",
    );
    ratio.squared()
}

/// `F0 + (1 - F0) (1 - c)⁵`
fn schlick<'b>(f0: Expr<'b>, c: Expr<'b>, name: &str) -> Expr<'b> {
    let m = (1.0 - c).named(name, "");
    let m2 = m.squared().named(&format!("{name}2"), "");
    let f0 = f0.named(&format!("{name}_f0"), "");
    f0 + (1.0 - f0) * (m2 * m2 * m)
}

/// The Gaussians of the observer: height, place and width in X, Y and Z, as functions of 2π times a path in metres, and X's second.
const HEIGHTS: [f64; 3] = [5.4856e-13, 4.4201e-13, 5.2481e-13];
const PLACES: [f64; 3] = [1.6810e6, 1.7953e6, 2.2084e6];
const WIDTHS: [f64; 3] = [4.3278e9, 9.3046e9, 6.6121e9];
const SECOND: [f64; 3] = [9.7470e-14, 2.2399e6, 4.5282e9];
/// The integral of Y.
const INTEGRAL: f64 = 1.0685e-7;
/// 2π times nanometres in a metre.
const TURN: f64 = std::f64::consts::TAU * 1e-9;
/// XYZ to linear sRGB, row by row.
const SRGB: [[f64; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

/// How high a Gaussian is, and by how much its exponent of two falls with the square of a path in nanometres.
fn gaussian(height: f64, width: f64) -> (f64, f64) {
    let high = height * (std::f64::consts::TAU * width).sqrt() / INTEGRAL;
    (high, -width * TURN * TURN * std::f64::consts::LOG2_E)
}

/// The same of X, Y and Z.
fn gaussians(builder: &Builder) -> (Expr<'_>, Expr<'_>) {
    let rows = each_channel(|i| gaussian(HEIGHTS[i], WIDTHS[i]));
    let high = builder.colour(rows.map(|row| row.0));
    (high, builder.colour(rows.map(|row| row.1)))
}

/// S in X, Y and Z: the fringes of this path, a scalar in nanometres, that an observer sees; `turned` is a phase in each.
fn observed<'b>(path: Expr<'b>, turned: Expr<'b>, m: f64) -> Expr<'b> {
    let builder = path.builder();
    let square = path.squared().named(&format!("square_{m}"), "");
    let turned = turned.named(&format!("turned_{m}"), "");
    let (high, falls) = gaussians(builder);
    let place = builder.colour(PLACES.map(|place| place * TURN));
    let waves = high * (place * path + turned).cos() * (falls * square).exp2();
    let waves = waves.named(&format!("waves_{m}"), "");
    let (high, falls) = gaussian(SECOND[0], SECOND[2]);
    let second =
        high * (SECOND[1] * TURN * path + turned.channel(0)).cos() * (falls * square).exp2();
    builder.compose(
        waves.channel(0) + second,
        waves.channel(1),
        waves.channel(2),
    )
}

/// S before a phase is added to it: cosine and sine of the fringes in X, Y and Z, and of X's second Gaussian.
pub(super) struct Waves<'b> {
    own: [Expr<'b>; 2],
    second: [Expr<'b>; 2],
}

/// S for a path, a scalar in nanometres; `m` tells names apart.
pub(super) fn observer(path: Expr<'_>, m: f64) -> Waves<'_> {
    let builder = path.builder();
    let square = path.squared().named(&format!("square_{m}"), "");
    let (high, falls) = gaussians(builder);
    let own = (high * (falls * square).exp2()).named(&format!("high_{m}"), "");
    let angle = builder.colour(PLACES.map(|place| place * TURN)) * path;
    let angle = angle.named(&format!("angle_{m}"), "");
    let (high, falls) = gaussian(SECOND[0], SECOND[2]);
    let second = (high * (falls * square).exp2()).named(&format!("second_high_{m}"), "");
    let second_angle = (SECOND[1] * TURN * path).named(&format!("second_angle_{m}"), "");
    Waves {
        own: [(own * angle.cos()), (own * angle.sin())],
        second: [second * second_angle.cos(), second * second_angle.sin()],
    }
    .named(m)
}

impl<'b> Waves<'b> {
    fn named(self, m: f64) -> Waves<'b> {
        let parts = [self.own[0], self.own[1], self.second[0], self.second[1]];
        for (part, name) in parts
            .into_iter()
            .zip(["cos_x", "sin_x", "second_cos", "second_sin"])
        {
            part.named(&format!("{name}_{m}"), "");
        }
        self
    }

    /// S with a phase of this cosine and sine in each channel.
    pub(super) fn turned(&self, cos: Expr<'b>, sin: Expr<'b>) -> Expr<'b> {
        let xyz = self.own[0] * cos - self.own[1] * sin;
        let second = self.second[0] * cos.channel(0) - self.second[1] * sin.channel(0);
        xyz + xyz.builder().compose(
            second,
            second.builder().number(0.0),
            second.builder().number(0.0),
        )
    }
}

/// XYZ in the channels of these rows.
pub(super) fn to_rgb<'b>(xyz: Expr<'b>, rows: [[f64; 3]; 3], m: f64) -> Expr<'b> {
    let xyz = xyz.named(&format!("xyz_{m}"), "");
    let builder = xyz.builder();
    let [red, green, blue] = rows.map(|row| xyz.dot(builder.colour(row)));
    builder.compose(red, green, blue)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::ir::{Value, evaluate};

    /// Computed from the extension's formulas by a program of its own, in f64, with three.js' limit.
    #[test]
    fn it_is_what_the_extension_says() {
        for (c, f0, ior, nm, want) in [
            (
                1.0,
                [0.04; 3],
                1.3,
                400.0,
                [0.0074565, 0.0383517, 0.0160382],
            ),
            (
                0.5,
                [0.04; 3],
                1.3,
                400.0,
                [0.0608344, 0.0228908, 0.0505085],
            ),
            (
                0.15,
                [0.02; 3],
                1.45,
                300.0,
                [0.4003339, 0.4473867, 0.4990931],
            ),
            (
                1.0,
                [0.542, 0.497, 0.449],
                2.6,
                45.0,
                [0.1206282, 0.0593838, 0.0482429],
            ),
            (
                0.6,
                [0.95, 0.64, 0.54],
                1.4,
                200.0,
                [0.9316993, 0.6211137, 0.5485381],
            ),
        ] {
            let numbers = [Value::scalar(nm), Value::scalar(ior), Value::rgb(f0)];
            let arguments = [&[Value::scalar(c)], &numbers[..]].concat();
            let got = evaluate::<f64>(&METHOD.function(false).unwrap(), &arguments).at(0);
            let near = |i: usize| (got[i] - want[i]).abs() < 1e-6;
            assert!((0..3).all(near), "{c} {ior} {nm}: {got:?} {want:?}");
        }
    }
}
