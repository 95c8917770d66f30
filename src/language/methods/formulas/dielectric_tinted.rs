//! `F = F90 + (F0 - F90) (1 - R) / (1 - R0)`: the exact law R for dielectrics, rescaled between two colours that artists set.
//!
//! R is unpolarised light's, R0 is R at normal incidence, `1 / (1 - R0) = (η + 2 + 1/η) / 4`. Renderers mix by `(R - R0) / (1 - R0)`, which costs
//! two divisions more, and compute R in a form that loses its digits next to η = 1.
//! Source: ours; the law is that of `dielectric_exact` (Cook and Torrance, 1982, <https://doi.org/10.1145/357290.357293>). That artists'
//! colours rescale it is from Cycles (`generalized_schlick` with a negative exponent) and from OpenPBR.
//! Domain: η from 0.001 to 10000, on both sides of 1, one number for all channels; far from 1 the error grows with η + 1/η. F0 at normal
//! incidence, F90 at grazing and past the critical angle; η = 1 gives F0 at every angle. Above an index of 2.6 R falls below R0 near
//! Brewster's angle, so that there F lies beyond F0. With F0 of the index and F90 = 1 it is the exact law. Error: [`METHOD`]'s claims.

use super::dielectric_exact::{COOK_TORRANCE_1982, SMALLEST_SQUARE};
use super::*;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const IOR: Input = Input::scalar(
        "ior",
        "relative index of refraction of all channels, transmitted over incident (n_t / n_i)",
        [0.001, 1e4],
        InputSource::Material(|known| [known.n[1]; 3]),
    )
    .tried(Input::ETA.tried)
    .scanned(Input::ETA.scanned);
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "dielectric_tinted",
    summary: "the exact law for dielectrics, rescaled between F0 and F90",
    formula: &[
        "F = F90 + (F0 - F90) k, k = (1 - R) / (1 - R0) = (1 - R) (ior + 2 + 1 / ior) / 4, limited to [0, 1]",
        "R of dielectric_exact, R0 at normal incidence",
    ],
    source: COOK_TORRANCE_1982,
    origin: Origin::Ours("the law that it rescales"),
    inputs: &[Input::IOR, Input::F0, Input::F90_COLOUR],
    class: Class::Dielectric,
    domain: "on both sides of 1; ior = 1 gives f0 at every angle. f90 past the critical angle. Far from 1 the error grows with ior + 1 / ior. The code error is that of f90 = 1",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Dielectrics)],
        code_abs: 1.4e-6,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0028, super::dielectric_exact::BELOW_ONE)
        .materials_within(0.0028)
        .ending(&[("ior", 252.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, eta) = (x.cosine(), x.get(Input::IOR));
    let kept = match x.is_half() {
        false => kept(c, eta),
        true => kept_in_half(c, eta),
    };
    let kept = kept.at_least(0.0).named("kept", "the weight of f0");
    let (f0, f90) = (x.get(Input::F0), x.get(Input::F90_COLOUR));
    (f90 + (f0 - f90) * kept).saturate()
}

/// The steps are those of `dielectric_exact`.
fn kept<'b>(c: Expr<'b>, eta: Expr<'b>) -> Expr<'b> {
    let apart = (eta - 1.0).named("apart", "");
    let tau = (apart * eta + apart).named("tau", "eta^2 - 1 without its cancellation near 1");
    let c2 = c.squared().named("c2", "");
    let s2 = (1.0 - c2).named("s2", "sin^2 theta");
    let g2 = (tau + c2).at_least(SMALLEST_SQUARE).named(
        "g2",
        "square of eta cos theta_t; next to 0 past the critical angle",
    );
    let g = g2.sqrt().named("g", "");
    let q = (tau / (c * ((tau + 1.0) * (g + c) + g) + g2)).named("q", "");
    let through = 1.0 - (c2 * g2 + s2.squared()) * q.squared();
    through * (0.25 * (eta + 1.0 / eta) + 0.5)
}

/// The same as a quotient of transmittances, in which nothing is large.
fn kept_in_half<'b>(c: Expr<'b>, eta: Expr<'b>) -> Expr<'b> {
    let tiny = Precision::F16.smallest();
    let tau = ((eta - 1.0) * (eta + 1.0)).named("tau", "");
    let g2 = tau + c.squared();
    let g = g2.at_least(0.0).sqrt().named("g", "eta cos theta_t");
    let inverse = (1.0 / eta).named("per_eta", "");
    let p = (1.0 / (g + c).at_least(tiny)).named("p", "");
    let q = (1.0 / (eta * c + inverse * g).at_least(tiny)).named("q", "");
    let through = (c * p) * (g * p) + (c * q) * (g * q);
    let kept = (through * (0.5 * (eta + inverse) + 1.0)).named("refracted", "");
    let number = |value: f64| eta.builder().number(value);
    let apart = tau.abs().named("apart", "0 where there is no interface");
    apart.choose_below(number(tiny), number(1.0), kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_the_index_s_own_colours_it_is_the_law() {
        for (c, eta) in [
            (1.0, 1.5),
            (0.3, 1.5),
            (0.0, 1.5),
            (0.1, 1.0001),
            (0.9, 0.7),
            (0.5, 0.7),
        ] {
            let r = (eta - 1.0) / (eta + 1.0);
            let law = value(&dielectric_exact::METHOD, c, &[eta]);
            check(&METHOD, c, &[eta, r * r, 1.0], law);
        }
    }

    #[test]
    fn it_goes_from_f0_to_f90() {
        check(&METHOD, 1.0, &[1.5, 0.2, 0.6], 0.2);
        check(&METHOD, 0.0, &[1.5, 0.2, 0.6], 0.6);
        check(&METHOD, 0.5, &[0.7, 0.2, 0.6], 0.6);
        check(&METHOD, 0.3, &[1.0, 0.2, 0.6], 0.2);
    }
}
