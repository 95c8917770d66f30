//! `F = (c² g² + s⁴) q²`, with `s² = 1 - c²`, `τ = η² - 1`, `g = √(τ + c²)`, `q = τ / (c (η² (g + c) + g) + g²)`:
//! the exact law for dielectrics with one division and one root, stable near η = 1.
//!
//! Source: Fresnel 1823 in the g-form of Cook and Torrance, "A Reflectance Model for Computer Graphics", 1982,
//! <https://doi.org/10.1145/357290.357293>, rearranged: r_s = (g-c)/(g+c) is τ/u² without its cancellation, r_p / r_s is
//! (cg-s²)/(cg+s²), so F = ½ (r_s² + r_p²) is (c²g²+s⁴) (τ / (u² (cg+s²)))², u = g+c, and u² (cg+s²) = c (η² u + g) + g²,
//! where nothing is subtracted. τ must come from η-1, and η² from τ, so that they share one rounding error. Past the critical
//! angle g is close to 0 and the quotient is 1 or more: the clamp makes it 1.
//! In half precision it is F = ½ (r_s² + r_p²) with r_s = 1 - 2c/(g+c) and r_p = 1 - 2η²c/(η²c+g). Where F is near 1 little
//! is subtracted, and two roundings remain of eight.
//! Domain: η from 0.001 to 1e12 (beyond, η³ overflows), on both sides of 1; η = 1 gives 0 at every angle, 90° too. Past the
//! critical angle it is exactly 1, except at the 34 numbers next to its cosine. There the rounding of c² decides, and √6e-8 is
//! 2.4e-4.
//! Error: none in the model; the code error is [`METHOD`]'s claim. Close to the critical angle the law itself is
//! ill-conditioned (a square root reaches 0 there), and the error follows its condition number.

use super::*;

/// Fresnel's law in the g-form.
pub const COOK_TORRANCE_1982: Citation = Citation {
    authors: "Cook, Torrance",
    title: "A Reflectance Model for Computer Graphics",
    place: "ACM Transactions on Graphics 1(1), 7-24",
    year: 1982,
    link: "https://doi.org/10.1145/357290.357293",
};

/// The effect of half precision on total reflection.
pub(super) const BELOW_ONE: &str =
    "below eta = 1 off by tenths next to the critical angle, where a root reaches 0";

/// The record of this method.
pub static METHOD: Method = Method {
    name: "dielectric_exact",
    summary: "the exact law for dielectrics, stable near eta = 1, total reflection included",
    formula: &[
        "s2 = 1 - c^2, t = eta^2 - 1, g = sqrt(max(t + c^2, 1e-18))",
        "F = min((c^2 g^2 + s2^2) q^2, 1), q = t / (c (eta^2 (g + c) + g) + g^2)",
    ],
    source: COOK_TORRANCE_1982,
    inputs: &[Input::ETA],
    forms: Forms::ColourAndScalar,
    class: Class::Dielectric,
    domain: "on both sides of 1; eta = 1 gives 0 at every angle. Past the critical angle exactly 1, but for up to 34 values of f32 next to its \
             cosine, where rounding decides: 0.99 or more for eta from 0.25 on. Before it the law is steep: f32 may be off by 0.01 for \
             eta from 0.25 to 0.999",
    claims: Claims {
        model: &[Claim::exact(MediaSet::Dielectrics)],
        code_ulp: 10.0,
        ..Claims::NONE
    },
    half: InHalf::within_but(0.0015, BELOW_ONE).ending(&[("eta", 180.0)]),
    build,
    variants: &[&TWO_SQUARES, &MULTIPLIED_OUT],
    plain: Some(plain),
    average: Some(FittedAverage {
        build: average,
        max_abs: 0.0008,
        over: "eta 1/3 to 3",
        published: "Kulla and Conty's fits (2017) are off by .0066 above 1 and .0027 below",
    }),
    ..Method::BASE
};

/// `F = ((cg)² + s⁴) q²`: for GPUs that count waits.
static TWO_SQUARES: Method = Method {
    variant: "two_squares",
    build: two_squares,
    variants: &[],
    ..METHOD
};

/// `q = τ / (v + τ v + h + g²)`, `v = c² + h`, `h = cg`: for Mali-G72.
static MULTIPLIED_OUT: Method = Method {
    variant: "multiplied_out",
    build: multiplied_out,
    ..TWO_SQUARES
};

/// The smallest radicand, so that the quotient stays finite past the critical angle, and at 90 degrees where η = 1.
/// Its root is small beside the smallest η², 1e-6. The square of the quotient that results is below the largest f32.
pub(super) const SMALLEST_SQUARE: f64 = 1e-18;

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    if x.is_half() {
        let steps = steps(x);
        return steps.reflected(steps.mean());
    }
    let roots = roots(x);
    let Roots { c2, s4, g2, .. } = roots;
    let q = quotient(x.cosine(), roots);
    ((c2 * g2 + s4) * q.squared()).at_most(1.0)
}

fn two_squares<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let roots = roots(x);
    let q = quotient(x.cosine(), roots);
    let h = (x.cosine() * roots.g).named("h", "");
    ((h.squared() + roots.s4) * q.squared()).at_most(1.0)
}

fn multiplied_out<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let Roots { tau, c2, s4, g2, g } = roots(x);
    let h = (x.cosine() * g).named("h", "");
    let v = (c2 + h).named("v", "");
    let q = (tau / ((v + tau * v) + (h + g2))).named("q", "");
    ((c2 * g2 + s4) * q.squared()).at_most(1.0)
}

/// What q is made of.
#[derive(Clone, Copy)]
struct Roots<'b> {
    tau: Expr<'b>,
    c2: Expr<'b>,
    s4: Expr<'b>,
    g2: Expr<'b>,
    g: Expr<'b>,
}

fn roots<'b>(x: &Inputs<'b>) -> Roots<'b> {
    let (c, eta) = (x.cosine(), x.get(Input::ETA));
    let (c2, s4) = squares(c);
    let apart = (eta - 1.0).named("apart", "");
    let tau = (apart * eta + apart).named("tau", "eta^2 - 1 without its cancellation near 1");
    let g2 = (tau + c2).at_least(SMALLEST_SQUARE).named(
        "g2",
        "square of eta cos theta_t; next to 0 past the critical angle",
    );
    let g = g2.sqrt().named("g", "");
    Roots { tau, c2, s4, g2, g }
}

fn quotient<'b>(c: Expr<'b>, Roots { tau, g2, g, .. }: Roots<'b>) -> Expr<'b> {
    let q = tau / (c * ((tau + 1.0) * (g + c) + g) + g2);
    q.named("q", "")
}

/// For eta well above 1, where nothing cancels: `q = (g - c) / (g + η² c)`.
fn plain<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (c, eta) = (x.cosine(), x.get(Input::ETA));
    let (c2, s4) = squares(c);
    let tau = ((eta - 1.0) * (eta + 1.0)).named("tau", "eta^2 - 1");
    let g2 = (tau + c2).named("g2", "");
    let g = g2
        .sqrt()
        .named("g", "eta times the cosine of the refracted ray");
    let q = ((g - c) / (g + eta.squared() * c)).named("q", "");
    (c2 * g2 + s4) * q.squared()
}

/// `cos² θ` and `sin⁴ θ`.
fn squares(c: Expr<'_>) -> (Expr<'_>, Expr<'_>) {
    let c2 = c.squared().named("c2", "");
    let s2 = (1.0 - c2).named("s2", "sin^2 theta");
    (c2, s2.squared().named("s4", ""))
}

/// The steps that the polarised forms share.
pub(super) struct Steps<'b> {
    /// η² - 1.
    tau: Expr<'b>,
    /// τ + c², negative past the critical angle.
    g2: Expr<'b>,
    /// The amplitude ratio of s-polarised light.
    r_s: Expr<'b>,
    /// The amplitude ratio of p-polarised light.
    r_p: Expr<'b>,
    is_half: bool,
}

impl<'b> Steps<'b> {
    /// The reflectance of s-polarised light.
    pub fn s(&self) -> Expr<'b> {
        self.r_s.squared()
    }

    /// The reflectance of p-polarised light.
    pub fn p(&self) -> Expr<'b> {
        self.r_p.squared()
    }

    /// The mean of both: unpolarised light.
    fn mean(&self) -> Expr<'b> {
        0.5 * (self.s() + self.p())
    }

    /// `reflectance`, but 1 past the critical angle, and never above 1.
    pub fn reflected(&self, reflectance: Expr<'b>) -> Expr<'b> {
        if self.is_half {
            return self.reflected_in_half(reflectance);
        }
        let builder = self.g2.builder();
        let inside = reflectance
            .at_most(1.0)
            .named("f", "rounding near the critical angle must not exceed 1");
        self.g2
            .choose_below(builder.number(0.0), builder.number(1.0), inside)
    }

    /// The same in half precision. r_s and r_p lie in [-1, 1] by their form, but at 90 degrees and η = 1 they are ±1 and not 0.
    fn reflected_in_half(&self, reflectance: Expr<'b>) -> Expr<'b> {
        let number = |value: f64| self.g2.builder().number(value);
        let refracted = reflectance.named("f_refracted", "");
        let f = self.g2.choose_below(number(0.0), number(1.0), refracted);
        let f = f.named("f", "");
        let apart = self
            .tau
            .abs()
            .named("apart", "0 where there is no interface");
        apart.choose_below(number(Precision::F16.smallest()), number(0.0), f)
    }
}

/// From the cosine and eta to the amplitudes.
pub(super) fn steps<'b>(x: &Inputs<'b>) -> Steps<'b> {
    let (c, eta) = (x.cosine(), x.get(Input::ETA));
    let tau = ((eta - 1.0) * (eta + 1.0)).named("tau", "eta^2 - 1 without its cancellation near 1");
    let g2 = (tau + c.squared()).named("g2", "below 0 past the critical angle");
    if x.is_half() {
        return half_steps(c, eta, tau, g2);
    }
    // A root of 0 computed as x / sqrt(x) is a NaN.
    let u = (g2.at_least(1e-37).sqrt() + c).named("u", "");
    let r_s =
        (tau / (tau + 2.0 * c * u).at_least(1e-37)).named("r_s", "(g - c) / (g + c), as tau / u^2");
    // Both tend to 0 near η = 1, and their ratio does not.
    let ratio = (c * u - 1.0) / (c * tau / u + 1.0);
    let r_p = (r_s * ratio.named("r_ps", "r_p / r_s")).named("r_p", "");
    Steps {
        tau,
        g2,
        r_s,
        r_p,
        is_half: false,
    }
}

fn half_steps<'b>(c: Expr<'b>, eta: Expr<'b>, tau: Expr<'b>, g2: Expr<'b>) -> Steps<'b> {
    let tiny = Precision::F16.smallest();
    let g = g2.at_least(0.0).sqrt().named("g", "eta cos theta_t");
    let r_s = (1.0 - 2.0 * c / (g + c).at_least(tiny)).named("r_s", "(g - c) / (g + c)");
    let dense = (eta.squared() * c).named("eta2_c", "");
    // Only the absolute error counts.
    let r_p = 1.0 - 2.0 * dense / (dense + g).at_least(tiny);
    Steps {
        tau,
        g2,
        r_s,
        r_p: r_p.named("r_p", "(g - eta^2 c) / (g + eta^2 c)"),
        is_half: true,
    }
}

/// The mean over the hemisphere from air into glass: a minimax cubic in s = 1 - 1/η for η from 1 to 3, with an error of .00078, by a
/// linear program over the integrals. The mean from glass into air follows by reciprocity: `1 - F(1/η) = (1 - F(η)) / η²`, Walsh,
/// "The reflection factor of a polished glass surface for diffused light", 1926.
const MEAN: [f64; 3] = [0.3109, -0.3777, 0.7966];

/// The mean of F over the hemisphere.
fn average<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let eta = x.get(Input::ETA);
    let thin = eta.min(1.0 / eta);
    let thin = thin.named("thin", "the index below 1 of both directions");
    let s = (1.0 - thin).named("s", "");
    let [first, second, third] = MEAN;
    let outside = s * (first + s * (second + s * third));
    let outside = outside.named("outside", "the mean towards the denser side");
    let inside = (1.0 - (1.0 - outside) * thin.squared()).named("inside", "the mean from there");
    let one = eta.builder().number(1.0);
    eta.choose_below(one, inside, outside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::ir::{Value, evaluate};
    use crate::physics::num::Legendre;
    use optics::dielectric;

    #[test]
    fn it_meets_normal_incidence_and_grazing() {
        check(&METHOD, 1.0, &[1.5], 0.04);
        check(&METHOD, 0.0, &[1.5], 1.0);
        check(&METHOD, 1.0, &[1.0 / 1.5], 0.04);
    }

    #[test]
    fn past_the_critical_angle_all_is_reflected() {
        check(&METHOD, 0.7, &[0.7], 1.0);
        check(&METHOD, 0.0, &[0.7], 1.0);
    }

    #[test]
    fn an_interface_that_is_not_there_reflects_nothing() {
        check(&METHOD, 0.0, &[1.0], 0.0);
        check(&METHOD, 0.3, &[1.0], 0.0);
    }

    /// The mean by Gauss's rule. Past the critical angle F is 1. Below it a square root is substituted for the cosine, which makes
    /// the integrand smooth.
    fn mean(eta: f64) -> f64 {
        let critical = (1.0 - eta * eta).max(0.0).sqrt();
        let rest = 1.0 - critical;
        let rule = Legendre::new(64);
        let terms = rule.over(0.0, 1.0).map(|(root, weight)| {
            let c = critical + rest * root * root;
            4.0 * rest * root * weight * c * dielectric(eta, c).unpolarised()
        });
        critical * critical + terms.sum::<f64>()
    }

    fn fitted(eta: f64) -> f64 {
        let function = METHOD.average_in(Precision::F32, true).unwrap().unwrap();
        evaluate(&function, &[Value::<f64>::scalar(eta)]).at(0)[0]
    }

    /// Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017, <https://blog.selfshadow.com/publications/s2017-shading-course/>.
    fn kulla_conty(eta: f64) -> f64 {
        if eta < 1.0 {
            0.997118 + 0.1014 * eta - 0.965241 * eta * eta - 0.130607 * eta * eta * eta
        } else {
            (eta - 1.0) / (4.08567 + 1.00071 * eta)
        }
    }

    /// The largest error of a fit above and below 1.
    fn worst(fit: fn(f64) -> f64) -> [f64; 2] {
        let steps = 0..=400;
        steps.fold([0.0f64; 2], |most, step| {
            let eta = 1.0 + 1e-6 + 2.0 * f64::from(step) / 400.0;
            let of = |eta: f64| (fit(eta) - mean(eta)).abs();
            [most[0].max(of(eta)), most[1].max(of(1.0 / eta))]
        })
    }

    #[test]
    fn the_mean_is_as_near_as_it_says() {
        let claim = METHOD.average.unwrap().max_abs;
        let [above, below] = worst(fitted);
        println!("fitted mean: {above:.6} above 1, {below:.6} below");
        let most = above.max(below);
        assert!(most <= claim && most >= 0.9 * claim, "{most} for {claim}");
        let [above, below] = worst(kulla_conty);
        println!("Kulla and Conty: {above:.6} above 1, {below:.6} below");
        assert!((0.0065..0.0066).contains(&above) && (0.0026..0.0027).contains(&below));
    }

    /// For glass it is .0918 (Walsh 1926), and for η = 1 it is 0.
    #[test]
    fn the_mean_of_glass_is_known() {
        assert!((mean(1.5) - 0.0918).abs() < 5e-5, "{}", mean(1.5));
        assert_eq!(fitted(1.0), 0.0);
    }
}
