//! How many digits the stable forms of the exact laws keep, run-time indices and all angles, without the absolute floor
//! that claims have: a reflectance of 1e-9 has its digits too. Beside the root of the critical angle, where the law itself
//! turns a rounding of its inputs into more, a result may be off by what such roundings do.

mod published;
mod recorded;

use crate::numbers::Dd;
use fresnel_gen::lab::verify::cosines;
use fresnel_gen::language::ir::{Checked, Value, evaluate};
use fresnel_gen::language::methods;
use fresnel_gen::physics::num::{Num, ulp_distance, ulp_of};
use fresnel_gen::physics::optics;

/// What unfused f32 may be off, in ulp.
const ULP: f64 = 16.0;
/// So many roundings of each input are allowed for beside the critical angle.
const ROUNDINGS: f64 = 4.0;
/// Half an ulp, relative.
const ROUNDING: f64 = 1.0 / 16_777_216.0;
/// Below this a reflectance is nothing: squares that are subnormal have lost digits.
const NOTHING: f64 = 1e-20;
/// Below this index, next to nothing to see through, n² has fewer digits than n² - 1 rounded leaves it.
const LEAST_INDEX: f64 = 0.25;

/// n and k.
pub type Medium = (f32, f32);

/// How three media at a time are computed at some cosines.
pub type Run<'a> = &'a dyn Fn(&[Medium; 3], &[f32]) -> Vec<[f32; 3]>;

/// The worst that was seen.
#[derive(Debug, Default)]
pub struct Worst {
    /// In ulp, away from the critical angle.
    pub ulp: f64,
    /// Where: n, k, cos.
    pub at: (f32, f32, f32),
    /// What was allowed for least, beside the critical angle: the error over it.
    pub share: f64,
    /// The largest condition number met where it was needed.
    pub condition: f64,
    /// What is further off than it may be.
    pub beyond: Vec<String>,
}

/// A library function by its name.
pub fn exact(name: &str) -> Checked {
    methods::find(name).unwrap().function(false).unwrap()
}

fn arguments<N: Num>(function: &Checked, media: &[Medium; 3], cosines: &[f32]) -> Vec<Value<N>> {
    let number = |c: &f32| N::from_f64(f64::from(*c));
    let n = Value::rgb(media.map(|(n, _)| f64::from(n)));
    let k = Value::rgb(media.map(|(_, k)| f64::from(k)));
    let all = [Value::each(cosines.iter().map(number).collect()), n, k];
    all.into_iter().take(function.params.len()).collect()
}

/// Unfused f32, here.
pub fn unfused(function: &Checked, media: &[Medium; 3], cosines: &[f32]) -> Vec<[f32; 3]> {
    let got = evaluate::<f32>(function, &arguments(function, media, cosines));
    (0..cosines.len()).map(|i| got.at(i)).collect()
}

/// One value in f64.
fn double(function: &Checked, n: f64, k: f64, c: f64) -> f64 {
    let all = [
        Value::<f64>::scalar(c),
        Value::rgb([n; 3]),
        Value::rgb([k; 3]),
    ];
    let count = function.params.len();
    evaluate(function, &all[..count]).at(0)[0]
}

/// Whether the root of (n + ik)² - sin² is small beside the cosine: the law has a square root's singularity where it is 0.
fn is_singular(n: f64, k: f64, c: f64) -> bool {
    let w2 = ((n - 1.0) * (n + 1.0) - k * k + c * c).hypot(2.0 * n * k);
    w2 < 0.25 * c * c
}

/// An index of exactly 1 and next to no absorption, at less than a millionth of a second of arc from 90 degrees: all that
/// the law is made of has a square that is 0.
fn is_lost(n: f64, k: f64, c: f64) -> bool {
    n == 1.0 && k < 1e-18 && c < 1e-9
}

/// By how much the law moves where each input moves by some roundings either way.
fn moved(function: &Checked, (n, k): (f64, f64), c: f64) -> f64 {
    let here = double(function, n, k, c);
    let off = |n, k, c| (double(function, n, k, c) - here).abs();
    let (less, more) = (1.0 - ROUNDINGS * ROUNDING, 1.0 + ROUNDINGS * ROUNDING);
    let either = |off: &dyn Fn(f64) -> f64| off(less).max(off(more));
    either(&|by| off(n * by, k, c))
        + either(&|by| off(n, k * by, c))
        + either(&|by| off(n, k, c * by))
}

impl Worst {
    /// Takes a result into account.
    fn include(&mut self, function: &Checked, (n, k, c): (f32, f32, f32), got: f32, want: f64) {
        let off = (f64::from(got) - want).abs();
        let wide = (f64::from(n), f64::from(k));
        if off <= NOTHING || is_lost(wide.0, wide.1, f64::from(c)) {
            return;
        }
        let ulp = ulp_distance(got, want);
        if !is_singular(wide.0, wide.1, f64::from(c)) {
            if ulp > self.ulp {
                (self.ulp, self.at) = (ulp, (n, k, c));
            }
            if ulp.is_nan() || ulp > ULP {
                self.beyond
                    .push(format!("({n:e}, {k:e}, {c:e}): {ulp:.1} ulp"));
            }
        } else if ulp.is_nan() || ulp > ULP / 2.0 {
            let moved = moved(function, wide, f64::from(c));
            let condition = moved / want / (ROUNDINGS * ROUNDING);
            self.condition = self.condition.max(condition);
            let most = ULP * (LEAST_INDEX / wide.0).max(1.0) + moved / ulp_of(want);
            self.share = self.share.max(ulp / most);
            if ulp.is_nan() || ulp > most {
                let text = format!("({n:e}, {k:e}, {c:e}): {ulp:.1} ulp of {most:.1}");
                self.beyond.push(text);
            }
        }
    }

    /// Fails where something was beyond its bound; says what was measured.
    #[track_caller]
    pub fn check(&self, what: &str) {
        let Worst {
            ulp,
            at,
            share,
            condition,
            beyond,
        } = self;
        println!(
            "{what}: {ulp:.2} ulp at {at:?}; beside the critical angle {share:.2} of what is allowed, condition up to {condition:.3e}"
        );
        let first: Vec<&str> = beyond.iter().take(12).map(String::as_str).collect();
        assert!(
            beyond.is_empty(),
            "{what}: {} are beyond: {}",
            beyond.len(),
            first.join("; ")
        );
    }
}

/// The worst over some media, at cosines that may depend on them.
pub fn worst(
    function: &Checked,
    media: &[Medium],
    cosines: &dyn Fn(&[Medium; 3]) -> Vec<f32>,
    run: Run,
) -> Worst {
    let mut worst = Worst::default();
    for three in media.chunks(3) {
        let last = three.len() - 1;
        let three = [0, 1, 2].map(|i: usize| three[i.min(last)]);
        let cosines = cosines(&three);
        let got = run(&three, &cosines);
        let want = evaluate::<f64>(function, &arguments(function, &three, &cosines));
        for (i, c) in cosines.iter().enumerate() {
            for (channel, (n, k)) in three.iter().enumerate() {
                worst.include(function, (*n, *k, *c), got[i][channel], want.at(i)[channel]);
            }
        }
    }
    worst
}

/// Shares in [0, 1) that fill a square evenly (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018,
/// <https://extremelearning.com.au/unreasonable-effectiveness-of-quasirandom-sequences/>).
fn even(count: usize) -> impl Iterator<Item = (f64, f64)> {
    let share = |i: usize, step: f64| (0.5 + i as f64 * step).fract();
    (1..=count).map(move |i| {
        (
            share(i, 0.754_877_666_246_692_7),
            share(i, 0.569_840_290_998_053_2),
        )
    })
}

/// Indices above 1, from nearly matched on.
fn above(share: f64) -> f32 {
    (1.0 + 1e-4 * libm::pow(1.1e5, share)) as f32
}

/// Indices below 1, from nearly matched to germanium seen from within.
fn below(share: f64) -> f32 {
    1.0 - (0.75 * libm::pow(1e4, -share)) as f32
}

/// Extinction: none, what vanishes, what has a subnormal square, and what metals have.
fn extinction(share: f64) -> f32 {
    let inside = (share * 5.0).fract();
    match (share * 5.0) as usize {
        0 => [0.0, 1e-45, 1e-41, 1e-38, 6.85e-31][(inside * 5.0) as usize],
        1 => libm::exp2(-149.0 * inside) as f32,
        2 => libm::pow(10.0, -8.0 * inside) as f32,
        _ => (13.0 * inside * inside) as f32,
    }
}

/// Dielectrics on both sides of 1.
pub fn glasses(count: usize) -> Vec<Medium> {
    let glass = |(share, side): (f64, f64)| match (side * 4.0) as usize {
        0 | 1 => (above(share), 0.0),
        2 => (below(share), 0.0),
        // Matched but for a few ulp.
        _ => (
            f32::from_bits(1.0f32.to_bits() + (1000.0 * share * share) as u32 - 200),
            0.0,
        ),
    };
    even(count).map(glass).collect()
}

/// Everything that absorbs, on both sides of 1 and at 1.
pub fn absorbing(count: usize) -> Vec<Medium> {
    let medium = |(i, (share, rest)): (usize, (f64, f64))| match i % 5 {
        0 | 1 => (above(share), extinction(rest)),
        2 => (below(share), extinction(rest)),
        3 => (1.0, extinction(rest)),
        _ => (
            (0.05 * libm::pow(90.0, share)) as f32,
            (1.5 + 6.5 * rest) as f32,
        ),
    };
    even(count).enumerate().map(medium).collect()
}

/// Cosines about the singularity of each of three media, ever nearer.
pub fn beside(media: &[Medium; 3]) -> Vec<f32> {
    let around = |(n, k): &Medium| {
        let (n, k) = (f64::from(*n), f64::from(*k));
        let at = (1.0 - n * n + k * k).abs().sqrt().min(1.0) as f32;
        let step = |power: u32| 1i32 << power;
        (0..22).flat_map(move |power| {
            [-step(power), 0, step(power)]
                .map(|by| f32::from_bits(at.to_bits().saturating_add_signed(by)))
        })
    };
    let mut cosines: Vec<f32> = media
        .iter()
        .flat_map(around)
        .filter(|c| (0.0..=1.0).contains(c))
        .collect();
    cosines.sort_by(f32::total_cmp);
    cosines.dedup();
    cosines
}

#[track_caller]
fn check(name: &str, media: &[Medium], cosines: &dyn Fn(&[Medium; 3]) -> Vec<f32>) {
    let function = exact(name);
    let run = |media: &[Medium; 3], cosines: &[f32]| unfused(&function, media, cosines);
    worst(&function, media, cosines, &run).check(name);
}

#[test]
fn dielectrics_keep_their_digits_at_all_angles() {
    let points = cosines(1500);
    check("dielectric_exact", &glasses(9000), &|_| points.clone());
}

#[test]
fn conductors_keep_their_digits_at_all_angles() {
    let points = cosines(1500);
    check("conductor_exact", &absorbing(12_000), &|_| points.clone());
}

#[test]
fn dielectrics_are_as_good_as_their_condition_beside_the_critical_angle() {
    let media: Vec<Medium> = even(6000).map(|(share, _)| (below(share), 0.0)).collect();
    check("dielectric_exact", &media, &beside);
}

#[test]
fn conductors_are_as_good_as_their_condition_beside_the_critical_angle() {
    let media: Vec<Medium> = even(12_000)
        .map(|(share, rest)| (below(share), extinction(rest)))
        .collect();
    check("conductor_exact", &media, &beside);
}

/// Seen from within something denser than anything clear, digits go as the index does: τ is rounded beside 1, n² is less.
#[test]
fn digits_go_with_an_index_that_nothing_has() {
    let dense = |(share, _): (f64, f64)| ((3.0 * libm::pow(3.0, -share) / 12.0) as f32, 0.0);
    let media: Vec<Medium> = even(1800).map(dense).collect();
    let points = cosines(600);
    check("dielectric_exact", &media, &|three| {
        [beside(three), points.clone()].concat()
    });
}

/// If f64 were wrong, all of the above would be held against nothing.
#[test]
fn double_precision_is_the_law_to_far_more_digits() {
    for name in ["dielectric_exact", "conductor_exact"] {
        let function = exact(name);
        for (n, k) in absorbing(400) {
            let k = if name == "conductor_exact" { k } else { 0.0 };
            let (n, k) = (f64::from(n), f64::from(k));
            for c in cosines(60).into_iter().map(f64::from) {
                let law = optics::conductor(Dd::from(n), Dd::from(k), Dd::from(c));
                let (got, law) = (double(&function, n, k, c), law.unpolarised().hi());
                let off = (got - law).abs();
                let is_open = is_lost(n, k, c) || is_singular(n, k, c);
                let near = off <= 1e-11 * law || off <= NOTHING || is_open;
                assert!(
                    near,
                    "{name}({n}, {k:e}, {c:e}) = {got:e}, {law:e} by the law"
                );
            }
        }
    }
}
