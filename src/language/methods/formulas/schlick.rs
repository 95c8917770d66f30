//! `F = F0 + (1 - F0) (1 - cos θ)⁵`: Schlick's approximation from the reflectance at normal incidence.
//!
//! Source: Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994,
//! <https://doi.org/10.1111/1467-8659.1330233>; eq. 13 of the thesis.
//! Domain: F0 ≥ 0; above 1 the result lies between 1 and F0. It rises monotonically, so it misses the dip that
//! metals have near 80 degrees. Error: see [`METHOD`]'s claims.

use super::*;

/// Schlick 1994.
pub const SCHLICK_1994: Citation = Citation {
    authors: "Schlick",
    title: "An Inexpensive BRDF Model for Physically-based Rendering",
    place: "Computer Graphics Forum 13(3), 233-246",
    year: 1994,
    link: "https://doi.org/10.1111/1467-8659.1330233",
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick",
    summary: "Schlick's approximation from F0",
    formula: &["F = F0 + (1 - F0) (1 - cos_theta)^5"],
    source: SCHLICK_1994,
    inputs: &[Input::F0],
    forms: Forms::ColourAndScalar,
    domain: "f0 above 1 is taken as it is: the result then lies in [0, max(1, f0)]. Misses the minimum of metals near 80 degrees",
    claims: Claims {
        model: &[Claim::dielectrics(0.0841, 84.5), Claim::metals(0.278, 84.5)],
        code_ulp: 5.0,
        colours: ColourClaim::within(3e-7),
        ..Claims::NONE
    },
    half: InHalf::within(0.0013),
    build,
    variants: &[&PARABOLA],
    for_constants: Some(for_constants),
    affine: Some(Affine::to_white(affine_weights)),
    ..Method::BASE
};

/// `F0 + (1 - c)² (1 - c)² ((1 - c)(1 - F0))` with `(1 - c)² = 1 - c (2 - c)`: a short chain, for GPUs that count waits.
static PARABOLA: Method = Method {
    variant: "parabola",
    build: parabola,
    variants: &[],
    ..METHOD
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    to_white(x.get(Input::F0), grazing_weight(x))
}

fn parabola<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, f0) = (x.cosine(), x.get(Input::F0));
    let p = (c * (2.0 - c) - 1.0).named("p", "-(1 - c)^2");
    f0 - p.squared() * ((1.0 - c) * (f0 - 1.0))
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let f0 = x.get(Input::F0);
    f0 + (1.0 - f0) * grazing_weight(x)
}

/// The interpolation from F0 to white, `F0 + (1 - F0) w`, as `F0 (1 - w) + w`: 1 - w is one number for three channels. White stays
/// white, since the rounding error of 1 - w is less than half an ulp of 1.
pub(super) fn to_white<'b>(f0: Expr<'b>, weight: Expr<'b>) -> Expr<'b> {
    f0 * (1.0 - weight).named("kept", "the weight of f0") + weight
}

/// `(1 - c)⁵`: 0 at normal incidence, 1 at grazing. Three multiplications, no power.
pub(super) fn grazing_weight<'b>(x: &Inputs<'b>) -> Expr<'b> {
    if x.is_half() {
        return (1.0 - grazing_rest(x.cosine())).named("m5", "(1 - c)^5");
    }
    let m = (1.0 - x.cosine()).named("m", "0 at normal incidence, 1 at grazing");
    let m2 = m.squared().named("m2", "");
    (m2 * m2 * m).named("m5", "")
}

/// `1 - (1 - c)⁵ = c + c m (1 + m)(1 + m²)` for half precision. Near grazing the power of a rounded m would be off by nine
/// roundings. This is small there.
pub(super) fn grazing_rest(c: Expr<'_>) -> Expr<'_> {
    let m = (1.0 - c).named("m", "0 at normal incidence, 1 at grazing");
    let rest = c + c * m * (1.0 + m) * (1.0 + m.squared());
    let rest = rest.at_most(1.0);
    rest.named("rest", "1 - (1 - c)^5, without a power near 1")
}

/// The weights of F0 and 1 - F0, in f64.
pub(super) fn affine_weights(c: f64) -> [f64; 4] {
    [1.0, grazing_power(c), 0.0, 0.0]
}

/// `(1 - c)⁵` in f64.
pub(super) fn grazing_power(c: f64) -> f64 {
    let m2 = (1.0 - c) * (1.0 - c);
    m2 * m2 * (1.0 - c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_f0_and_one() {
        check(&METHOD, 1.0, &[0.04], 0.04);
        check(&METHOD, 0.0, &[0.04], 1.0);
        check(&METHOD, 0.5, &[0.04], 0.04 + 0.96 / 32.0);
    }

    #[test]
    fn a_colour_above_one_stays_between_one_and_itself() {
        check(&METHOD, 1.0, &[1.05], 1.05);
        check(&METHOD, -3.0, &[1.05], 1.0);
    }
}
