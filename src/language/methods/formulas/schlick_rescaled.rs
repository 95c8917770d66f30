//! `F = ((n-1)² + 4n (1 - cos θ)⁵ + k²) / ((n+1)² + k²)`: Schlick's approximation rescaled to n and k.
//!
//! Source: Lazányi and Szirmay-Kalos, "Fresnel Term Approximations for Metals", WSCG, 2005,
//! <https://hdl.handle.net/11025/11214>; eq. 14 of the thesis.
//! Domain: n from 0.001 to 1e9, k from 0 to 1e9. It rises monotonically and so misses the minimum of metals. Error: [`METHOD`]'s claims.

use super::schlick::{grazing_rest, grazing_weight};
use super::*;

/// Lazányi and Szirmay-Kalos 2005.
pub const LAZANYI_2005: Citation = Citation {
    authors: "Lazanyi, Szirmay-Kalos",
    title: "Fresnel Term Approximations for Metals",
    place: "WSCG Short Papers, 77-80",
    year: 2005,
    link: "https://hdl.handle.net/11025/11214",
};

/// The record of this method.
pub static METHOD: Method = Method {
    name: "schlick_rescaled",
    summary: "Schlick's approximation rescaled to n and k",
    formula: &["F = ((n - 1)^2 + 4 n (1 - cos_theta)^5 + k^2) / ((n + 1)^2 + k^2)"],
    source: LAZANYI_2005,
    inputs: &[Input::N, Input::K],
    domain: "misses the minimum of metals",
    claims: Claims {
        model: &[Claim::dielectrics(0.0841, 84.5), Claim::metals(0.278, 84.5)],
        code_ulp: 8.0,
        ..Claims::NONE
    },
    half: InHalf::within(0.0024).ending(&[("n", 180.0), ("k", 180.0)]),
    build,
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    rescaled(x).saturate()
}

/// Eq. 14.
pub(super) fn rescaled<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (n, k) = (x.get(Input::N), x.get(Input::K));
    if x.is_half() {
        return half(x.cosine(), n, k);
    }
    let less = (n - 1.0).named("n_less", "");
    let least = (less.squared() + k.squared()).named("least", "(n - 1)^2 + k^2");
    from_least(x, least, n)
}

/// `((n-1)² + k² + 4n (1-c)⁵) / ((n+1)² + k²)` from `least`, (n-1)² + k². The divisor is `least` + 4n. So an error of `least` almost
/// cancels in the quotient, and at grazing dividend and divisor are the same number.
pub(super) fn from_least<'b>(x: &Inputs<'b>, least: Expr<'b>, n: Expr<'b>) -> Expr<'b> {
    let n4 = (4.0 * n).named("n4", "");
    (least + n4 * grazing_weight(x)) / (least + n4)
}

/// The same as 1 minus the light that is not reflected: for metals that is little.
fn half<'b>(c: Expr<'b>, n: Expr<'b>, k: Expr<'b>) -> Expr<'b> {
    let more = (n + 1.0).named("n_more", "");
    let lost = 4.0 * n / (more.squared() + k.squared());
    1.0 - lost.named("lost", "1 - F0") * grazing_rest(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_normal_incidence_and_grazing() {
        check(&METHOD, 1.0, &[0.23, 3.94], 16.1165 / 17.0365);
        check(&METHOD, 0.0, &[0.23, 3.94], 1.0);
        check(&METHOD, 1.0, &[1.5, 0.0], 0.04);
    }
}
