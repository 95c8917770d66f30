//! `F = F0 + (1 - F0) b1 + w2 b2 + w3 b3`: four curves that all materials share, two of them of residuals.
//!
//! Source: Belcour, Bati, Barla, "Bringing an Accurate Fresnel to Real-Time Rendering: a Preintegrable Decomposition",
//! ACM SIGGRAPH 2020 Talks, <https://blog.selfshadow.com/publications/s2020-shading-course/>. There the curves are a table, the
//! singular vectors of a thousand reflectance curves. w2 and w3 are solved so that F is exact at 82.64 and 64.38 degrees.
//! Because it is linear, it can be integrated once for all materials, over a spectrum and over a lobe.
//! Here each curve is `(1 - c) (a0 + r (a1 + r (a2 + r a3)))`, `r = 1 / (1 + 3 c)`, fitted to that table: within 8e-5 of b1, .006
//! of b2 and .018 of b3. w3 lies within .05 of 0 except near n = 1 (-.07 at η 1.03), so errors are those of the table to .001
//! (η 1.333: .0018 against .0016, 1.5: .0039 against .0040, 3: .0018 against .0023).
//! Domain: F0 from 0 to 1, weights that belong to it; the result is clamped to [0, 1]. Error: see [`METHOD`]'s claims.

use super::schlick::to_white;
use super::*;

/// The curves b1, b2 and b3, divided by 1 - c, by powers of r: minimax fits by a linear program, to seven digits.
const CURVES: [[f64; 4]; 3] = [
    [-0.013_613_34, -0.322_009_4, 1.603_441, -0.267_739_9],
    [-0.727_217, 2.665_895, 4.683_322, -6.616_088],
    [6.709_838, -48.357_06, 91.435_01, -49.805_98],
];

/// The 3 in `r = 1 / (1 + 3 c)`.
const FALL: f64 = 3.0;

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const B2_WEIGHT: Input = Input::rgb(
        "b2_weight",
        "weight of the second curve, solved at 82.64 degrees",
        [-1000.0, 1000.0],
        InputSource::Material(|known| each_channel(|i| weights_of(known, i)[0])),
    )
    .tried(&[0.0, -0.3, 0.2])
    .scanned(&[-1.0, -0.3, -0.05, 0.0, 0.05, 0.3, 1.0]);

    pub const B3_WEIGHT: Input = Input::rgb(
        "b3_weight",
        "weight of the third curve, solved at 64.38 degrees",
        [-1000.0, 1000.0],
        InputSource::Material(|known| each_channel(|i| weights_of(known, i)[1])),
    )
    .tried(Input::B2_WEIGHT.tried)
    .scanned(Input::B2_WEIGHT.scanned);
}

fn weights_of(known: &KnownSurface, i: usize) -> [f64; 2] {
    belcour_weights(known.f0[i], known.belcour.map(|seen| seen[i]))
}

/// The record of this method.
pub static METHOD: Method = Method {
    name: "belcour_decomposition",
    summary: "Belcour's four shared curves, two of them weighted",
    formula: &[
        "F = f0 + (1 - f0) b1 + b2_weight b2 + b3_weight b3, limited to [0, 1]",
        "b_i = (1 - c) (a0 + r (a1 + r (a2 + r a3))), r = 1 / (1 + 3 c)",
    ],
    source: Citation {
        authors: "Belcour, Bati, Barla",
        title: "Bringing an Accurate Fresnel to Real-Time Rendering: a Preintegrable Decomposition",
        place: "ACM SIGGRAPH 2020 Talks",
        year: 2020,
        link: "https://blog.selfshadow.com/publications/s2020-shading-course/",
    },
    origin: Origin::Adapted("the polynomials that follow its tables are fresnel-gen's"),
    inputs: &[Input::F0, Input::B2_WEIGHT, Input::B3_WEIGHT],
    forms: Forms::ColourAndScalar,
    domain: "weights solved for f0; limited to [0, 1]",
    claims: Claims {
        model: &[Claim::dielectrics(0.0043, 87.8), Claim::metals(0.024, 87.3)],
        code_ulp: 11.5,
        code_over: MediaSet::Metals,
        colours: ColourClaim::within(8e-6),
        ..Claims::NONE
    },
    half: InHalf::within_over(
        0.0035,
        MediaSet::Metals,
        "for what is nearly matched, where weights are large, off by .008",
    )
    .materials_within(0.0036),
    build,
    for_constants: Some(for_constants),
    affine: Some(Affine {
        numbers: &["f0", "1 - f0", "b2_weight", "b3_weight"],
        build: numbers,
        weights: affine_weights,
    }),
    ..Method::BASE
};

fn build<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let [b1, others] = parts(x);
    (to_white(x.get(Input::F0), b1) + others).saturate()
}

fn for_constants<'b>(x: &Inputs<'b>) -> Expr<'b> {
    let (f0, [b1, others]) = (x.get(Input::F0), parts(x));
    (f0 + (1.0 - f0) * b1 + others).saturate()
}

/// b1, the weight of white, and `w2 b2 + w3 b3`.
fn parts<'b>(x: &Inputs<'b>) -> [Expr<'b>; 2] {
    let c = x.cosine();
    let m = (1.0 - c).named("m", "0 at normal incidence, 1 at grazing");
    let r = (1.0 / (1.0 + FALL * c)).named("r", "");
    let curve = |i: usize| {
        let [a0, a1, a2, a3] = CURVES[i];
        let curve = m * (a0 + r * (a1 + r * (a2 + r * a3)));
        curve.named(["b1", "b2", "b3"][i], "")
    };
    let second = x.get(Input::B2_WEIGHT) * curve(1);
    let third = x.get(Input::B3_WEIGHT) * curve(2);
    [curve(0), second + third]
}

/// The weights that make F exact at [`BELCOUR_COSINES`], for one channel: the solution of two linear equations.
pub fn belcour_weights(f0: f64, wanted: [f64; 2]) -> [f64; 2] {
    let [first, second] = BELCOUR_COSINES.map(curves_at);
    let left = |wanted: f64, curves: [f64; 3]| wanted - f0 - (1.0 - f0) * curves[0];
    let (p, q) = (left(wanted[0], first), left(wanted[1], second));
    let whole = first[1] * second[2] - first[2] * second[1];
    [
        (p * second[2] - q * first[2]) / whole,
        (q * first[1] - p * second[1]) / whole,
    ]
}

fn curves_at(c: f64) -> [f64; 3] {
    let r = 1.0 / (1.0 + FALL * c);
    CURVES.map(|[a0, a1, a2, a3]| (1.0 - c) * (a0 + r * (a1 + r * (a2 + r * a3))))
}

fn numbers<'b>(x: &Inputs<'b>) -> Vec<Expr<'b>> {
    let f0 = x.get(Input::F0);
    vec![
        f0,
        1.0 - f0,
        x.get(Input::B2_WEIGHT),
        x.get(Input::B3_WEIGHT),
    ]
}

/// The weights of the affine numbers, in f64.
fn affine_weights(c: f64) -> [f64; 4] {
    let [b1, b2, b3] = curves_at(c);
    [1.0, b1, b2, b3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_begins_at_f0_and_is_limited() {
        check(&METHOD, 1.0, &[0.04, 0.5, 0.25], 0.04);
        check(&METHOD, 0.5, &[0.04, 4.0, 0.0], 1.0);
        check(&METHOD, 0.5, &[0.04, -4.0, 0.0], 0.0);
    }

    #[test]
    fn weights_meet_what_they_are_solved_for() {
        let wanted = [0.55, 0.21];
        let [b2, b3] = belcour_weights(0.17, wanted);
        for (cosine, wanted) in BELCOUR_COSINES.into_iter().zip(wanted) {
            check(&METHOD, cosine, &[0.17, b2, b3], wanted);
        }
    }
}
