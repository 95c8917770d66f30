//! `F_c = 1 - Σ w_c (T_s + T_p) / 2` over six wavelengths: the exact law of one clear film, whose thickness may change from pixel to
//! pixel.
//!
//! The law at each wavelength, its domain and its limits are those of
//! [`film_spectral_three`](crate::language::methods::formulas::film_spectral_three). Twice as many wavelengths follow the spectrum of a
//! thicker film.
//!
//! Source: ours, of the matrix in M. Born, E. Wolf, "Principles of Optics", 7th edition, Cambridge University Press, 1999, section 1.6,
//! <https://doi.org/10.1017/CBO9781139644181>, as there.
//! Domain: as there. Error: the head of each function says it.

use super::film_spectral_three::{self as three, entered};
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const WAVELENGTHS_1: Input = Input {
        name: "wavelengths_nm_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.wavelength_nm)),
        ..Input::WAVELENGTHS
    }
    .tried_once();

    pub const FILM_N_1: Input = Input {
        name: "film_n_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.film_n)),
        ..Input::FILM_N
    }
    .tried_once();

    pub const BASE_N_1: Input = Input {
        name: "base_n_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.base[0])),
        ..Input::BASE_N
    }
    .tried_once();

    pub const BASE_K_1: Input = Input {
        name: "base_k_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.base[1])),
        ..Input::BASE_K
    }
    .tried_once();

    pub const WEIGHTS_RED_1: Input = Input {
        name: "weights_red_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.weights[0])),
        ..Input::WEIGHTS_RED
    }
    .tried_once();

    pub const WEIGHTS_GREEN_1: Input = Input {
        name: "weights_green_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.weights[1])),
        ..Input::WEIGHTS_GREEN
    }
    .tried_once();

    pub const WEIGHTS_BLUE_1: Input = Input {
        name: "weights_blue_1",
        source: InputSource::Material(|known| known.film.three(0, |sample| sample.weights[2])),
        ..Input::WEIGHTS_BLUE
    }
    .tried_once();

    pub const WAVELENGTHS_2: Input = Input {
        name: "wavelengths_nm_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.wavelength_nm)),
        ..Input::WAVELENGTHS
    }
    .tried_once();

    pub const FILM_N_2: Input = Input {
        name: "film_n_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.film_n)),
        ..Input::FILM_N
    }
    .tried_once();

    pub const BASE_N_2: Input = Input {
        name: "base_n_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.base[0])),
        ..Input::BASE_N
    }
    .tried_once();

    pub const BASE_K_2: Input = Input {
        name: "base_k_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.base[1])),
        ..Input::BASE_K
    }
    .tried_once();

    pub const WEIGHTS_RED_2: Input = Input {
        name: "weights_red_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.weights[0])),
        ..Input::WEIGHTS_RED
    }
    .tried_once();

    pub const WEIGHTS_GREEN_2: Input = Input {
        name: "weights_green_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.weights[1])),
        ..Input::WEIGHTS_GREEN
    }
    .tried_once();

    pub const WEIGHTS_BLUE_2: Input = Input {
        name: "weights_blue_2",
        source: InputSource::Material(|known| known.film.three(3, |sample| sample.weights[2])),
        ..Input::WEIGHTS_BLUE
    }
    .tried_once();
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "film_spectral_six",
    summary: "the exact law of one clear film at six wavelengths, thickness at run time",
    formula: &[
        "as film_spectral_three, over six wavelengths: F = 1 - sum of weight (T_s + T_p) / 2",
        "the inputs that end with _1 are those of three wavelengths, with _2 of the other three",
    ],
    inputs: &[
        Input::THICKNESS,
        Input::WAVELENGTHS_1,
        Input::FILM_N_1,
        Input::BASE_N_1,
        Input::BASE_K_1,
        Input::WEIGHTS_RED_1,
        Input::WEIGHTS_GREEN_1,
        Input::WEIGHTS_BLUE_1,
        Input::WAVELENGTHS_2,
        Input::FILM_N_2,
        Input::BASE_N_2,
        Input::BASE_K_2,
        Input::WEIGHTS_RED_2,
        Input::WEIGHTS_GREEN_2,
        Input::WEIGHTS_BLUE_2,
    ],
    build: |x| {
        let (first, second) = (
            entered(x, &METHOD.inputs[1..5]),
            entered(x, &METHOD.inputs[8..12]),
        );
        let channel = |channel: usize| {
            let weights = [5, 12].map(|from| x.get(METHOD.inputs[from + channel]));
            1.0 - (weights[0].dot(first) + weights[1].dot(second))
        };
        let rgb = x.cosine().builder();
        rgb.compose(channel(0), channel(1), channel(2)).saturate()
    },
    claims: Claims {
        code_abs: 1e-5,
        ..three::METHOD.claims
    },
    wavelengths: 6,
    ..three::METHOD
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::{Layer, under_films};

    #[test]
    fn it_is_the_mean_of_two_wavelengths() {
        let law = |nm: f64| {
            let layer = Layer {
                n: 1.4,
                k: 0.0,
                waves: 200.0 / nm,
            };
            under_films(&[layer], 0.2, 3.4, 0.4).unpolarised()
        };
        let of = |nm: f64, share: f64| [nm, 1.4, 0.2, 3.4, share, share, share];
        let inputs = [&[200.0], &of(450.0, 0.25)[..], &of(600.0, 1.0 / 12.0)].concat();
        check(&METHOD, 0.4, &inputs, 0.75 * law(450.0) + 0.25 * law(600.0));
    }
}
