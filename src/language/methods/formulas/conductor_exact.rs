//! `F = R_s x / (x + u s²)`, with `s² = 1-c²`, `τ = (n-1)(n+1)-k²`, `t = τ+c²`, `r = √(t²+4n²k²)`, `u = 2ac`,
//! `x = r c²+s⁴`: the exact law for conductors, in a form that stays stable where k → 0 and at grazing.
//!
//! Source: the a, b form of Glassner, "Principles of Digital Image Synthesis", 1995,
//! <https://www.realtimerendering.com/Principles_of_Digital_Image_Synthesis_v1.0.1.pdf>, rearranged so that no
//! difference of nearly equal numbers is left. a² = ½(r+t) cancels where t < 0, so there a = nk / √(½(r-t)).
//! Where t ≥ 0, R_s = ((a-c)²+b²) / ((a+c)²+b²) takes (a-c)² as T²/E with T = τ+b² = a²-c² and E = (a+c)².
//! Merging R_s and R_p into one quotient gives F without adding the two.
//! In half precision it is F = (1 - 2u/(r+c²+u)) (1 - us²/(x+us²)). Only the absolute error counts there, so no branch
//! is needed, and where F is near 1 little is subtracted. r is the larger of |t| and 2nk times √(1+ratio²), since t²
//! overflows for k ≥ 16.
//! Domain: n from 0.001 to 1e9, k from 0 to 1e9 (from 3e9 on 4n²k² overflows); k = 0 is the dielectric; n = 1, k = 0 gives 0.
//! Error: none in the model; the code error is [`METHOD`]'s claim.

use super::*;

use super::conductor_textbook::GLASSNER_1995;
use crate::language::ir::USED_TWICE;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_exact",
    summary: "the exact law for conductors, stable at small k and at grazing",
    formula: &[
        "t = (n - 1)(n + 1) - k^2 + c^2, r = sqrt(t^2 + 4 n^2 k^2), a^2 = (r + t) / 2, u = 2 a c",
        "R_s = (r + c^2 - u) / (r + c^2 + u), x = r c^2 + s^4, s^2 = 1 - c^2, F = R_s x / (x + u s^2)",
    ],
    source: GLASSNER_1995,
    inputs: &[Input::N, Input::K],
    domain: "k = 0 is the dielectric; n = 1 with k = 0 gives 0 at every angle; from n = k = 3e9 on it overflows",
    claims: Claims {
        model: &[
            Claim::exact(MediaSet::Dielectrics),
            Claim::exact(MediaSet::Metals),
        ],
        code_ulp: 7.5,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0015, "for n below 1 with k near 0 see dielectric_exact")
        .ending(&[("n", 180.0), ("k", 180.0)]),
    build,
    plain: Some(plain),
    replacement: Some(clear),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    conductor(x.precision(), x.cosine(), x.get(Input::N), x.get(Input::K))
}

/// Up to this k, where n is well above 1, only k² matters, and it changes a reflectance by less than 1e-11.
/// Indices solved from colours have as much by rounding.
const CLEAR: f64 = 1e-6;
const WELL_ABOVE: f64 = 1.2;

/// The smallest radicand in single precision: near the smallest normal f32.
const SMALLEST: f64 = 1e-37;

/// Without absorption it is a dielectric, whose law is shorter.
fn clear(values: &Values) -> Option<(&'static Method, Values)> {
    let (n, k) = (values["n"], values["k"]);
    let is_clear = |i: usize| k[i] == 0.0 || k[i] <= CLEAR && n[i] >= WELL_ABOVE;
    let eta = || Values::from([("eta".to_owned(), n)]);
    (0..3)
        .all(is_clear)
        .then(|| (&dielectric_exact::METHOD, eta()))
}

/// With constants folded in, the general law is as cheap, and right for any k.
pub(super) fn as_it_is(values: &Values) -> Option<(&'static Method, Values)> {
    Some((&METHOD, values.clone()))
}

/// This method with n and k of each channel.
pub(super) fn with(index: [(f64, f64); 3]) -> (&'static Method, Values) {
    let (n, k) = (index.map(|(n, _)| n), index.map(|(_, k)| k));
    let values = [("n".to_owned(), n), ("k".to_owned(), k)];
    (&METHOD, Values::from(values))
}

/// The exact law, for methods that compute n and k themselves.
pub(super) fn conductor<'b>(
    precision: Precision,
    c: Expr<'b>,
    n: Expr<'b>,
    k: Expr<'b>,
) -> Expr<'b> {
    polarised(precision, c, n, k).mean()
}

/// What is reflected of light polarised across the plane of incidence, and what the other half is made of.
pub(in crate::language) struct Polarised<'b> {
    /// R_s; in half precision, what it lacks of 1.
    s: Expr<'b>,
    /// x = r c² + s⁴, where R_p / R_s = (x - us2) / (x + us2).
    x: Expr<'b>,
    us2: Expr<'b>,
    /// The dividends of the real and the imaginary part of r_p / r_s, r c² - s⁴ and 2 b c s²; their divisor is x + us2. Where phases are
    /// computed: in single precision, in the stable form.
    phases: Option<[Expr<'b>; 2]>,
    /// In half precision, 0 where there is no interface.
    apart: Option<Expr<'b>>,
}

pub(in crate::language) fn polarised<'b>(
    precision: Precision,
    c: Expr<'b>,
    n: Expr<'b>,
    k: Expr<'b>,
) -> Polarised<'b> {
    if precision.is_half() {
        half(c, n, k)
    } else {
        single(c, n, k)
    }
}

impl<'b> Polarised<'b> {
    /// Unpolarised light, `R_s x / (x + u s²)`. Fused multiply-adds and division by reciprocals could bring it above 1 by two ulp.
    /// The clamp is free on GPUs.
    pub fn mean(&self) -> Expr<'b> {
        match self.apart {
            None => (self.s * (self.x / self.sum())).saturate(),
            Some(_) => self.in_half((1.0 - self.s) * (1.0 - self.lost())),
        }
    }

    /// Light polarised across the plane of incidence.
    pub fn s(&self) -> Expr<'b> {
        match self.apart {
            None => self.s.saturate(),
            Some(_) => self.in_half(1.0 - self.s),
        }
    }

    /// Light polarised in the plane of incidence, `R_s (x - u s²) / (x + u s²)`.
    pub fn p(&self) -> Expr<'b> {
        match self.apart {
            None => (self.s * ((self.x - self.us2) / self.sum())).saturate(),
            Some(_) => self.in_half((1.0 - self.s) * (1.0 - 2.0 * self.lost())),
        }
    }

    /// (R_s - R_p) / 2, in single precision.
    pub fn half_difference(&self) -> Expr<'b> {
        self.s * (self.us2 / self.sum())
    }

    /// The real and the imaginary part of r_p r_s*, in single precision.
    pub fn phases(&self) -> [Expr<'b>; 2] {
        let dividends = self.phases.expect("it is built in single precision");
        dividends.map(|dividend| self.s * (dividend / self.sum()))
    }

    fn sum(&self) -> Expr<'b> {
        (self.x + self.us2).at_least(1e-37)
    }

    /// 1 - F / R_s of unpolarised light, in half precision.
    fn lost(&self) -> Expr<'b> {
        let lost = self.us2 / (self.x + self.us2).at_least(Precision::F16.smallest());
        lost.named("lost", "1 - F / R_s of unpolarised light")
    }

    fn in_half(&self, reflectance: Expr<'b>) -> Expr<'b> {
        let apart = self.apart.expect("it is built in half precision");
        let number = |value: f64| apart.builder().number(value);
        let f = reflectance.saturate().named(
            "f",
            "where next to nothing is reflected, rounding must not make it negative",
        );
        apart.choose_below(number(Precision::F16.smallest()), number(0.0), f)
    }
}

/// The steps that all forms share.
struct Steps<'b> {
    c2: Expr<'b>,
    s2: Expr<'b>,
    tau: Expr<'b>,
    nk: Expr<'b>,
    /// τ + c², whose sign says which of a and b is the larger.
    t: Expr<'b>,
}

fn steps<'b>(c: Expr<'b>, n: Expr<'b>, k: Expr<'b>) -> Steps<'b> {
    let c2 = c.squared().named("c2", "");
    let s2 = (1.0 - c2).named("s2", "sin^2 theta");
    let tau = ((n - 1.0) * (n + 1.0) - k.squared()).named("tau", "n^2 - k^2 - 1");
    let nk = (n * k).named("nk", "");
    let t = (tau + c2).named("t", "n^2 - k^2 - sin^2 theta");
    Steps { c2, s2, tau, nk, t }
}

/// In single precision, from the steps.
fn merged<'b>(s: Expr<'b>, r: Expr<'b>, u: Expr<'b>, c2: Expr<'b>, s2: Expr<'b>) -> Polarised<'b> {
    Polarised {
        s,
        x: (r * c2 + s2.squared()).named("x", ""),
        us2: (u * s2).named("us2", ""),
        phases: None,
        apart: None,
    }
}

/// The smallest radicand in code of this precision.
pub(super) fn least_squared(precision: Precision) -> f64 {
    match precision {
        Precision::F32 => SMALLEST,
        Precision::F16 => precision.smallest(),
    }
}

/// √x that is 0 at 0 even where a compiler computes a root as `x / √x`.
pub(super) fn root_or_zero(precision: Precision, x: Expr<'_>) -> Expr<'_> {
    x * x.at_least(least_squared(precision)).inverse_sqrt()
}

fn single<'b>(c: Expr<'b>, n: Expr<'b>, k: Expr<'b>) -> Polarised<'b> {
    let zero = c.builder().number(0.0);
    let Steps { c2, s2, tau, nk, t } = steps(c, n, k);
    // Where t rounds to 0 and the square of n k underflows (k below 1e-19), `r` and `larger` would be 0. Roots that compilers
    // compute as x / sqrt(x) would then be NaN, and the quotient undefined.
    let r = (t.squared() + 4.0 * nk.squared())
        .at_least(SMALLEST)
        .sqrt()
        .named("r", "a^2 + b^2");

    let larger2 = (0.5 * (r + t.abs())).named("larger2", USED_TWICE);
    let larger = larger2.sqrt().named("larger", "the larger of a and b");
    let smaller = (nk / larger).named("smaller", "the other one, since a b = n k");
    let a = t
        .choose_below(zero, smaller, larger)
        .named("a", "no cancellation on either side of t = 0");
    let b = t.choose_below(zero, larger, smaller).named("b", "");
    let u = (2.0 * a * c).named("u", "");

    let sum = (r + c2).named("sum", "");
    let metal = ((sum - u) / (sum + u)).named("r_s_metal", "R_s where t < 0");
    let b2 = smaller.squared().named("b2", "");
    let gap = (tau + b2).named("gap", "a^2 - c^2");
    let e = (gap + 2.0 * c * (a + c)).named("e", "(a + c)^2");
    let gap2 = (gap * (gap / e.at_least(1e-37))).named("gap2", "(a - c)^2, as gap^2 / e");
    let glass = (gap2 + b2) / (e + b2).at_least(1e-37);
    let glass = glass.named("r_s_glass", "R_s where t >= 0");
    let r_s = t.choose_below(zero, metal, glass).named("r_s", "");

    Polarised {
        phases: Some([r * c2 - s2.squared(), 2.0 * b * c * s2]),
        ..merged(r_s, r, u, c2, s2)
    }
}

fn half<'b>(c: Expr<'b>, n: Expr<'b>, k: Expr<'b>) -> Polarised<'b> {
    let tiny = Precision::F16.smallest();
    let number = |value: f64| c.builder().number(value);
    let Steps { c2, s2, tau, nk, t } = steps(c, n, k);

    let (size, twice) = (t.abs().named("size", ""), (2.0 * nk).named("nk2", ""));
    let most = size.max(twice).named("most", "");
    let ratio = size.min(twice) / most.at_least(tiny);
    let ratio = ratio.named("ratio", "up to 1, where t^2 would overflow");
    let r = (most * (1.0 + ratio.squared()).sqrt()).named("r", "a^2 + b^2");
    let larger = (0.5 * (r + size)).sqrt();
    let larger = larger.named("larger", "the larger of a and b");
    let smaller = (nk / larger.at_least(tiny)).named("smaller", "the other one, since a b = n k");
    let a = t.choose_below(number(0.0), smaller, larger).named("a", "");
    let u = (2.0 * a * c).named("u", "");

    let lost_s = 2.0 * u / (r + c2 + u).at_least(tiny);
    let lost_s = lost_s.named("lost_s", "1 - R_s");
    Polarised {
        s: lost_s,
        x: (r * c2 + s2.squared()).named("x", ""),
        us2: (u * s2).named("us2", ""),
        phases: None,
        apart: Some((tau.abs() + nk).named("apart", "0 where there is no interface")),
    }
}

/// For materials where neither t < 0 nor a small reflectance causes cancellation: a as textbooks print it.
fn plain<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, n, k) = (x.cosine(), x.get(Input::N), x.get(Input::K));
    let Steps { c2, s2, nk, t, .. } = steps(c, n, k);
    let r = (t.squared() + 4.0 * nk.squared()).sqrt();
    let r = r.named("r", "a^2 + b^2");
    let a = (0.5 * (r + t).at_least(SMALLEST)).sqrt().named("a", "");
    let u = (2.0 * a * c).named("u", "");
    let sum = (r + c2).named("sum", "");
    let r_s = ((sum - u) / (sum + u)).named("r_s", "R_s");
    merged(r_s, r, u, c2, s2).mean()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_normal_incidence_and_grazing() {
        check(&METHOD, 1.0, &[0.23, 3.94], 16.1165 / 17.0365);
        check(&METHOD, 0.0, &[0.23, 3.94], 1.0);
        check(&METHOD, 1.0, &[1.5, 0.0], 0.04);
        check(&METHOD, 0.0, &[1.0001, 1e-300], 1.0);
    }

    #[test]
    fn without_absorption_it_is_the_dielectric() {
        for (c, eta) in [(0.3, 1.5), (0.01, 2.4), (0.9, 0.7), (0.5, 0.7), (0.0, 1.0)] {
            let law = value(&dielectric_exact::METHOD, c, &[eta]);
            check(&METHOD, c, &[eta, 0.0], law);
        }
    }
}
