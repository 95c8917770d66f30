//! `F_c = 1 - Σ w_c (T_s + T_p) / 2` over three wavelengths: the exact law of one clear film, whose thickness may change from pixel
//! to pixel.
//!
//! At each wavelength, with the film's index n₁ and the base's m = n + ik, all relative to the medium outside:
//!
//! ```text
//! y  = √(n₁² - s²), a + ib = √(m² - s²)     s² = 1 - c²; components across the film and in the base
//! φ  = 2π d y / λ                           the film's phase
//! P  = C² (c² + q) + σ² (c² q + y⁴) + 2 C σ b (c² - y²)      C = cos φ, σ = sin φ / y, q = a² + b²
//! T_s = 4 a c / (P + 2 a c)                 what enters the base; T_p likewise, with a, b, q of (a + ib)/m² and y/n₁²
//! ```
//!
//! It is |D - N|² / |D + N|² of Abelès' matrix, D and N being the fields at the film's outer face, with Re(D N*) = a c at any
//! thickness, since a clear film absorbs nothing. So R needs no complex quotient. Thickness 0 leaves the law of the bare base, and
//! σ has a limit where y is 0. Past the film's critical angle y² is negative: there C and σ are hyperbolic, and all is multiplied
//! by e^(-2|φ|), so that a thick film overflows nothing.
//! The wavelengths and their weights follow from observer, light and space. They are fitted to the material, over thicknesses from
//! 0 to that of its film.
//!
//! Source: ours, of the matrix in M. Born, E. Wolf, "Principles of Optics", 7th edition, Cambridge University Press, 1999, section 1.6,
//! <https://doi.org/10.1017/CBO9781139644181>. Three wavelengths in place of the spectrum are the thesis's idea.
//! Domain: film_n from .05 to 10, base n to 100 and k to 100; thickness_nm from 0 to 1e4. A film that absorbs is taken as clear.
//! Error: the head of each function says it. Of a phase of 100 single precision keeps 1e-5.

use super::*;

use crate::physics::cite::Citation;

/// Fields in layers.
const BORN_WOLF_1999: Citation = Citation {
    authors: "Born, Wolf",
    title: "Principles of Optics, 7th edition, section 1.6",
    place: "Cambridge University Press",
    year: 1999,
    link: "https://doi.org/10.1017/CBO9781139644181",
};

/// Thicknesses in nanometres: none, usual ones, and the thickest film that is allowed.
const THICKNESSES: &[f64] = &[300.0, 0.0, 1e-3, 3000.0];
const THICKNESSES_AND_BEYOND: &[f64] = &[
    -10.0, 0.0, 1e-3, 10.0, 100.0, 200.0, 300.0, 400.0, 600.0, 800.0, 1000.0, 3000.0, 1e4,
];
const WAVELENGTHS: [f64; 2] = [1.0, 1e5];
/// The phase of a film of no index is lost; that of a larger one is none of light.
const FILM: [f64; 2] = [0.05, 10.0];
const BASE_N: [f64; 2] = [1e-3, 100.0];
const BASE_K: [f64; 2] = [0.0, 100.0];
const SHARE: [f64; 2] = [-100.0, 100.0];

/// An input of three wavelengths of the material's samples.
const fn of_samples(
    name: &'static str,
    meaning: &'static str,
    range: [f64; 2],
    of: fn(&KnownSurface) -> [f64; 3],
    tried: &'static [f64],
) -> Input {
    Input::rgb(name, meaning, range, InputSource::Material(of))
        .tried(tried)
        .scanned(tried.split_at(1).0)
}

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const THICKNESS: Input = Input::scalar(
        "thickness_nm",
        "thickness of the film in nanometres",
        [0.0, 1e4],
        InputSource::Pixel(|known| known.film.thickness_nm),
    )
    .tried(THICKNESSES)
    .scanned(THICKNESSES_AND_BEYOND);

    pub const WAVELENGTHS: Input = of_samples(
        "wavelengths_nm",
        "three wavelengths in nanometres, in the medium outside",
        WAVELENGTHS,
        |known| known.film.three(0, |sample| sample.wavelength_nm),
        &[550.0],
    );

    pub const FILM_N: Input = of_samples(
        "film_n",
        "refractive index of the film there, relative to the medium outside",
        FILM,
        |known| known.film.three(0, |sample| sample.film_n),
        &[1.4, 1.0, 0.7, 2.4],
    );

    pub const BASE_N: Input = of_samples(
        "base_n",
        "refractive index below the film there, relative to the same",
        BASE_N,
        |known| known.film.three(0, |sample| sample.base[0]),
        &[1.5, 0.05, 1.0, 4.0],
    );

    pub const BASE_K: Input = of_samples(
        "base_k",
        "extinction coefficient below the film there, relative to the same",
        BASE_K,
        |known| known.film.three(0, |sample| sample.base[1]),
        &[0.0, 1e-6, 3.0],
    );

    pub const WEIGHTS_RED: Input = of_samples(
        "weights_red",
        "share of each wavelength in red; those of all wavelengths sum to 1",
        SHARE,
        |known| known.film.three(0, |sample| sample.weights[0]),
        &[0.333],
    );

    pub const WEIGHTS_GREEN: Input = of_samples(
        "weights_green",
        "share of each wavelength in green",
        SHARE,
        |known| known.film.three(0, |sample| sample.weights[1]),
        &[0.333],
    );

    pub const WEIGHTS_BLUE: Input = of_samples(
        "weights_blue",
        "share of each wavelength in blue",
        SHARE,
        |known| known.film.three(0, |sample| sample.weights[2]),
        &[0.333],
    );
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "film_spectral_three",
    summary: "the exact law of one clear film at three wavelengths, thickness at run time",
    formula: &[
        "F = 1 - sum of weight (T_s + T_p) / 2, T = 4 a c / (P + 2 a c), s^2 = 1 - c^2, phase = 2 pi d y / wavelength",
        "P = C^2 (c^2 + q) + S^2 (c^2 q + y^4) + 2 C S b (c^2 - y^2), C = cos phase, S = sin phase / y, q = a^2 + b^2",
        "s: y = sqrt(film_n^2 - s^2), a + ib = sqrt(m^2 - s^2), m = base_n + i base_k; p: y / film_n^2, (a + ib) / m^2",
    ],
    source: BORN_WOLF_1999,
    origin: Origin::Ours("what enters the base of a clear film as one real quotient"),
    inputs: &[
        Input::THICKNESS,
        Input::WAVELENGTHS,
        Input::FILM_N,
        Input::BASE_N,
        Input::BASE_K,
        Input::WEIGHTS_RED,
        Input::WEIGHTS_GREEN,
        Input::WEIGHTS_BLUE,
    ],
    class: Class::ClearFilm,
    domain: "thickness 0 is the bare base; past the critical angle of the film its wave fades; a film that absorbs is taken as clear",
    claims: Claims {
        model: &[
            Claim::exact(MediaSet::Dielectrics),
            Claim::exact(MediaSet::Metals),
        ],
        code_abs: 1.5e-5,
        ..Claims::NONE
    },
    half: InHalf::Refused("half precision keeps no phase"),
    build: |x| {
        let entered = entered(x, &METHOD.inputs[1..5]);
        let channel = |weights: Input| 1.0 - x.get(weights).dot(entered);
        let rgb = x.cosine().builder();
        let [red, green, blue] = [
            Input::WEIGHTS_RED,
            Input::WEIGHTS_GREEN,
            Input::WEIGHTS_BLUE,
        ];
        rgb.compose(channel(red), channel(green), channel(blue))
            .saturate()
    },
    wavelengths: 3,
    ..Method::BASE
};

/// The least |y²|, n₁² - s²: of less, sin φ / y keeps no digits where it is hyperbolic.
const LEAST_SQUARE: f64 = 1e-6;
/// The least square of a component in the base.
const LEAST_BASE: f64 = 1e-12;
/// The least product of denominators: where nothing enters, 0 is divided by this.
const LEAST_PRODUCT: f64 = 1e-30;
/// e^(-2x) is 2^(-2x / ln 2).
const FADE: f64 = -2.0 / std::f64::consts::LN_2;

/// (T_s + T_p) / 2 at three wavelengths: `inputs` are these, the film's index, and n and k of the base.
pub(super) fn entered<'b>(x: &Inputs<'b>, inputs: &[Input]) -> Expr<'b> {
    let second = if inputs[0].name.ends_with('2') {
        "_2"
    } else {
        ""
    };
    let name = |expr: Expr<'b>, name: &str, why: &str| expr.named(&format!("{name}{second}"), why);
    let c = x.cosine();
    let number = |value: f64| c.builder().number(value);
    let zero = number(0.0);
    let [wavelengths, film_n, n, k] = [0, 1, 2, 3].map(|i| x.get(inputs[i]));
    let c2 = c.squared().named("c2", "");

    // The film: its component y, and C and S of its phase.
    let film2 = name(film_n.squared(), "film2", "");
    let apart = name((film_n - 1.0) * (film_n + 1.0), "apart", "film_n^2 - 1");
    let y2 = name(apart + c2, "y2", "film_n^2 - s^2");
    let size = name(y2.abs().at_least(LEAST_SQUARE), "size", "");
    let inverse = name(size.inverse_sqrt(), "rest", "1 / |y|");
    let turn = x.get(Input::THICKNESS) * (std::f64::consts::TAU / wavelengths);
    let phase = name(turn * (size * inverse), "phase", "");
    let fade = name((FADE * phase).exp2(), "fade", "past the critical angle");
    let half_fade = name(0.5 * fade, "half_faded", "");
    let (cos, sin) = (
        name(phase.cos(), "cos_phase", ""),
        name(phase.sin(), "sin_phase", ""),
    );
    let cosh = name(0.5 + half_fade, "cosh_phase", "times e^-phase");
    let sinh = name(0.5 - half_fade, "sinh_phase", "likewise");
    let cosine = name(y2.choose_below(zero, cosh, cos), "cosine", "C");
    let sine = y2.choose_below(zero, sinh, sin) * inverse;
    let sine = name(sine, "sine", "S");
    let left = name(y2.choose_below(zero, fade, number(1.0)), "left", "");

    // The base: a + ib, where the smaller of both is a quotient, so that nothing cancels.
    let re = name((n - k) * (n + k), "re", "m^2");
    let im = name(2.0 * n * k, "im", "");
    let im2 = name(im.squared(), "im2", "");
    let above = (n - 1.0) * (n + 1.0) - k.squared();
    let across = name(
        above + c2,
        "across",
        "m^2 - s^2, with all digits beside n = 1",
    );
    let q = (across.squared() + im2).at_least(1e-37).sqrt();
    let q = name(q, "q", "a^2 + b^2");
    let larger2 = (0.5 * q + 0.5 * across.abs()).at_least(LEAST_BASE);
    let larger2 = name(larger2, "larger2", "");
    let root = name(larger2.inverse_sqrt(), "root", "");
    let larger = name(larger2 * root, "larger", "the larger of a and b");
    let smaller = name(0.5 * im * root, "smaller", "the other one");
    let a = name(across.choose_below(zero, smaller, larger), "a", "");
    let b = name(across.choose_below(zero, larger, smaller), "b", "");

    // Sums of squares of the fields, for s, and for p times |m|^4.
    let (cc, ss) = (
        name(cosine.squared(), "cosine2", ""),
        name(sine.squared(), "sine2", ""),
    );
    let cs = name(2.0 * cosine * sine, "twice_cs", "");
    let c2q = name(c2 * q, "c2q", "");
    let y4 = name(y2.squared(), "y4", "");
    let ac = name(c * left, "weight_c", "");
    let a_s = name(2.0 * a * ac, "a_s", "");
    let p_s = cc * (c2 + q) + ss * (c2q + y4) - cs * b * apart;
    let d_s = name(p_s + a_s, "d_s", "");
    let base4 = name(re.squared() + im2, "base4", "|m|^4");
    let film4 = name(film2.squared(), "film4", "");
    let a_p = name(2.0 * (a * re + b * im) * ac, "a_p", "");
    let b_p = b * re - a * im;
    let p_p = cc * (base4 * c2 + q)
        + ss * (film4 * c2q + (base4 / film4) * y4)
        + cs * b_p * (film2 * c2 - (1.0 / film2) * y2);
    let d_p = name(p_p + a_p, "d_p", "");
    let both = (a_s * d_p + a_p * d_s) / (d_s * d_p).at_least(LEAST_PRODUCT);
    name(both, "entered", "(T_s + T_p) / 2")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::{Layer, under_films};

    const NM: f64 = 550.0;

    /// One wavelength in all places.
    fn inputs(nm: f64, film: f64, n: f64, k: f64) -> Vec<f64> {
        let shares = [1.0 / 3.0; 3];
        [&[nm, NM, film, n, k], &shares[..]].concat()
    }

    #[test]
    fn it_is_the_law_of_a_film() {
        for (n, k) in [(1.5, 0.0), (0.2, 3.4), (4.0, 0.3), (0.7, 0.0)] {
            for film in [1.38, 2.4, 0.6, n] {
                for nm in [0.0, 40.0, 300.0, 900.0] {
                    for c in [1.0, 0.9, 0.5, 0.2, 0.01] {
                        let layer = Layer {
                            n: film,
                            k: 0.0,
                            waves: nm / NM,
                        };
                        let law = under_films(&[layer], n, k, c).unpolarised();
                        check(&METHOD, c, &inputs(nm, film, n, k), law);
                    }
                }
            }
        }
    }

    #[test]
    fn no_thickness_is_the_bare_base_and_grazing_reflects_all() {
        let bare = optics::conductor(0.2, 3.4, 0.3).unpolarised();
        check(&METHOD, 0.3, &inputs(0.0, 1.4, 0.2, 3.4), bare);
        check(&METHOD, 0.0, &inputs(200.0, 1.4, 0.2, 3.4), 1.0);
        check(&METHOD, 0.0, &inputs(200.0, 1.4, 1.5, 0.0), 1.0);
    }
}
