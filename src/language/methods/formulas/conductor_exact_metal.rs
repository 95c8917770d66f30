//! `F = R_s x / (x + u s²)`, with `s² = 1-c²`, `t = k²-n²+s²`, `r = √(t²+4n²k²)`, `u = 2ac`, `a = nk/b`, `b² = ½(r+t)`,
//! `R_s = (r+c²-u)/(r+c²+u)`, `x = r c²+s⁴`: the exact law for metals, with n and k at run time.
//!
//! Source: the a, b form of Glassner, "Principles of Digital Image Synthesis", 1995,
//! <https://www.realtimerendering.com/Principles_of_Digital_Image_Synthesis_v1.0.1.pdf>. `conductor_exact` serves any k: it computes
//! a in two ways and chooses between them. A metal needs only one: with t = k²-n²+s², b keeps its digits as long as k is not small
//! beside n, and a follows from a b = n k. That halves the cost.
//! Domain: n from 0.001, k from n / 4, both up to 1e9. With less k it loses digits. As k → 0 it fails and reflects everything: for
//! semiconductors and glass take `conductor_exact`.
//! Error: none in the model; the code error is [`METHOD`]'s claim.

use super::conductor_textbook::GLASSNER_1995;
use super::*;

/// The record of this method.
pub static METHOD: Method = Method {
    name: "conductor_exact_metal",
    summary: "the exact law for metals, at half the cost; not for small k",
    formula: &[
        "t = k^2 - n^2 + s^2, r = sqrt(t^2 + 4 n^2 k^2), u = 2 c n k / sqrt((r + t) / 2), s^2 = 1 - c^2",
        "R_s = (r + c^2 - u) / (r + c^2 + u), x = r c^2 + s^4, F = R_s x / (x + u s^2)",
    ],
    source: GLASSNER_1995,
    inputs: &[Input::N, Input::K],
    class: Class::Metal,
    domain: "k of n / 4 and more; with less it loses digits, and near k = 0 it is wrong: there conductor_exact serves",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Metals)],
        code_ulp: 0.0,
        code_over: MediaSet::Metals,
        ..Claims::NONE
    },
    half: InHalf::Specialised("t squared overflows for k of 16 and more"),
    build,
    variants: &[&ONE_DIVISION, &SUM_FIRST],
    replacement: Some(conductor_exact::as_it_is),
    ..Method::BASE
};

/// R_s and R_p over one denominator.
static ONE_DIVISION: Method = Method {
    variant: "one_division",
    build: one_division,
    variants: &[],
    ..METHOD
};

/// The usual form with other sums and products first: for VideoCore.
static SUM_FIRST: Method = Method {
    variant: "sum_first",
    build: sum_first,
    ..ONE_DIVISION
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let smallest = conductor_exact::least_squared(x.precision());
    let roots = roots(x, |n, k| 2.0 * n * k, smallest);
    let c = x.cosine();
    let u = std::f64::consts::SQRT_2 * c * (roots.twice * roots.b);
    reflected(roots, u.named("u", "2 a c, since a b = n k"))
}

fn sum_first<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let smallest = conductor_exact::least_squared(x.precision());
    let twice = |n: Expr<'b>, k: Expr<'b>| {
        let product = (n * k).named("nk", "");
        product + product
    };
    let roots = roots(x, twice, smallest);
    let c = x.cosine();
    let u = std::f64::consts::SQRT_2 * c * roots.twice * roots.b;
    reflected(roots, u.named("u", "2 a c, since a b = n k"))
}

fn reflected<'b>(Roots { c2, s2, r, .. }: Roots<'b>, u: Expr<'b>) -> Expr<'b> {
    let sum = (r + c2).named("sum", "");
    let r_s = (1.0 - 2.0 * u / (sum + u))
        .named("r_s", "R_s, without a difference that rounds twice near 1");
    let whole = (r * c2 + s2.squared()).named("x", "");
    (r_s * (whole / (whole + u * s2))).saturate()
}

/// The least 2 b² of a metal, of n = .001 and k = n / 4. With a smaller one products overflow outside of the domain.
const LEAST_B2: f64 = 1e-7;

/// `F = (d - 2 u) (x / (d (x + u s²)))`, `d = r + c² + u`.
fn one_division<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let roots = roots(x, |n, k| 2.0 * n * k, LEAST_B2);
    let c = x.cosine();
    let u = std::f64::consts::SQRT_2 * c * (roots.twice * roots.b);
    let u = u.named("u", "2 a c, since a b = n k");
    let Roots { c2, s2, r, .. } = roots;
    let d = (r + c2 + u).named("d", "");
    let whole = (r * c2 + s2.squared()).named("x", "");
    ((d - 2.0 * u) * (whole / (d * (whole + u * s2)))).saturate()
}

/// What the forms begin with.
struct Roots<'b> {
    c2: Expr<'b>,
    s2: Expr<'b>,
    /// 2 n k.
    twice: Expr<'b>,
    /// a² + b².
    r: Expr<'b>,
    /// 1 / (√2 b).
    b: Expr<'b>,
}

fn roots<'b>(
    x: &Inputs<'b>,
    twice: impl Fn(Expr<'b>, Expr<'b>) -> Expr<'b>,
    least_b2: f64,
) -> Roots<'b> {
    let (c, n, k) = (x.cosine(), x.get(Input::N), x.get(Input::K));
    let smallest = conductor_exact::least_squared(x.precision());
    let c2 = c.squared().named("c2", "");
    let s2 = (1.0 - c2).named("s2", "sin^2 theta");
    let t = (k.squared() + s2 - n.squared()).named("t", "k^2 - n^2 + sin^2 theta");
    let twice = twice(n, k).named("nk2", "");
    // `smallest` is added, since a GPU fuses the sum with the product. Compilers may use x / sqrt(x) for a root: NaN at 0.
    let r = (t.squared() + (twice.squared() + smallest)).sqrt();
    let r = r.named("r", "a^2 + b^2, above 0");
    let b2 = (r + t).at_least(least_b2).named("b2", "2 b^2");
    Roots {
        c2,
        s2,
        twice,
        r,
        b: b2.inverse_sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_normal_incidence_and_grazing() {
        check(&METHOD, 1.0, &[0.23, 3.94], 16.1165 / 17.0365);
        check(&METHOD, 0.0, &[0.23, 3.94], 1.0);
    }

    /// Silver, platinum, tungsten, and the end of the domain.
    #[test]
    fn it_is_the_law_for_conductors() {
        for (n, k) in [(0.13, 3.2), (2.3, 4.1), (3.5, 2.7), (4.0, 1.0)] {
            for c in [0.0, 0.02, 0.3, 0.7, 1.0] {
                let law = value(&conductor_exact::METHOD, c, &[n, k]);
                check(&METHOD, c, &[n, k], law);
            }
        }
    }
}
