//! The specialiser changes rounding and nothing else: a specialised function against the library function with the same
//! values, over hard media, in f64 where rounding does not hide a wrong branch, and in f32 where it must stay small.

use fresnel_gen::generator::fit::{self, values, values_for_material};
use fresnel_gen::generator::reference::Derivation;
use fresnel_gen::language::ir::{Op, Texels, Value, evaluate};
use fresnel_gen::language::methods::{self, Contract, Method, Values};
use fresnel_gen::physics::materials::Channels;
use fresnel_gen::physics::num::Num;

/// Channels on both sides of every branch, equal and unequal, matched, barely absorbing, far from any material.
const MEDIA: [([f64; 3], [f64; 3]); 12] = [
    ([0.23, 0.57, 1.39], [3.94, 2.18, 1.72]),
    ([1.5, 1.5, 1.5], [0.0, 0.0, 0.0]),
    ([1.331, 1.3336, 1.336], [0.0, 0.0, 0.0]),
    ([0.7, 1.0, 1.3], [0.0, 0.0, 0.0]),
    ([0.7, 0.7, 0.7], [0.0, 0.0, 0.0]),
    ([4.1, 4.6, 5.2], [0.03, 0.3, 2.4]),
    ([0.05, 0.13, 1.0], [3.0, 0.1, 1e-6]),
    ([1.0, 1.0, 1.0], [1.0, 0.5, 4.0]),
    ([1e-3, 1e3, 1.0], [1.0, 10.0, 1e3]),
    ([2.0, 2.0, 2.0], [2.0, 2.0, 2.0]),
    ([1.41, 1.42, 1.0001], [1.0, 1.004, 0.01]),
    ([1.2, 0.9, 2.4], [1e-20, 1e-3, 1e-41]),
];

/// A table whose texels all differ.
fn table() -> Texels {
    fit::texels(|c| [1.0 - 0.9 * c, 1.0 - 0.5 * c * c, 0.5])
}

fn run<N: Num>(
    method: &Method,
    constants: &Values,
    cosines: &[f64],
    specialised: bool,
) -> Vec<[f64; 3]> {
    let cos_theta = Value::each(cosines.iter().map(|c| N::from_f64(*c)).collect());
    let values = if specialised {
        let mut arguments = vec![cos_theta];
        arguments.extend(method.is_textured().then(|| Value::Texture(Some(table()))));
        let function = method.specialise(constants).expect("it specialises");
        evaluate::<N>(&function, &arguments)
    } else {
        let function = method.function(false).expect("it is well formed");
        let mut arguments = vec![cos_theta];
        arguments.extend(method.arguments(constants, Some(&table())));
        evaluate::<N>(&function, &arguments)
    };
    (0..cosines.len())
        .map(|point| values.at(point).map(N::to_f64))
        .collect()
}

#[test]
fn only_rounding_changes() {
    let cosines: Vec<f64> = (0..=200)
        .map(|i| f64::from(i) / 200.0)
        .chain([1e-3, 1e-6, -1.0, 2.0])
        .collect();
    let kept = methods::ALL
        .iter()
        .filter(|method| method.contract == Contract::Kept && method.replacement.is_none());
    for method in kept {
        for (n, k) in MEDIA {
            if !(0..3).all(|i| method.class.describes(n[i], k[i])) {
                continue;
            }
            let constants = values(method, &Channels { n, k }, &Derivation::default());
            let [library, special] =
                [false, true].map(|special| run::<f64>(method, &constants, &cosines, special));
            let single = run::<f32>(method, &constants, &cosines, true);
            for (i, cos_theta) in cosines.iter().enumerate() {
                for channel in 0..3 {
                    let (want, got) = (library[i][channel], special[i][channel]);
                    let what = format!(
                        "{}({cos_theta}) for n {n:?}, k {k:?}, channel {channel}",
                        method.name
                    );
                    assert!(
                        (got - want).abs() < 1e-9,
                        "{what}: {got} specialised, {want} in the library"
                    );
                    // Next to a critical angle the law itself is ill-conditioned.
                    let critical = 1.0 - n[channel] * n[channel];
                    let ill = n[channel] < 1.0 && (cos_theta * cos_theta - critical).abs() < 0.02;
                    let tolerance = if ill { 1e-2 } else { 2e-5 };
                    let single = single[i][channel];
                    assert!(
                        (single - want).abs() < tolerance,
                        "{what}: {single} in f32, {want} in f64"
                    );
                }
            }
        }
    }
}

/// Metals on both sides of t = 0, all of which have one side only; a channel that has both keeps its choice.
const METALS: [&str; 12] = [
    "aluminium",
    "chromium",
    "copper",
    "germanium",
    "gold",
    "iron",
    "nickel",
    "platinum",
    "silicon",
    "silver",
    "titanium",
    "tungsten",
];

/// A metal that pays for the branch that it never takes, or for a guard against what it never meets.
#[test]
fn metals_have_no_branch_and_no_guard_left() {
    let method = methods::find("conductor_exact").expect("it is there");
    let library = method.function(false).expect("it is well formed");
    assert_eq!((library.count(Op::Select), library.count(Op::Max)), (6, 12));
    let mut sides = [0, 0];
    for subject in crate::subjects(&METALS) {
        let channels = &subject.effective.channels;
        let mut open = 0;
        for (n, k) in channels.n.into_iter().zip(channels.k) {
            // t = n^2 - k^2 - sin^2, at 0 and at 90 degrees.
            let (greatest, least) = (n * n - k * k, n * n - k * k - 1.0);
            sides[usize::from(least >= 0.0)] += 1;
            open += usize::from(greatest >= 0.0 && least < 0.0);
        }
        let function = method
            .specialise(&values_for_material(&subject, method))
            .expect("it specialises");
        let left = [Op::Select, Op::Less, Op::Max].map(|op| function.count(op));
        assert_eq!(left[0], 2 * open, "{}: {channels:?}", subject.name);
        assert!(
            open > 0 || left == [0, 0, 0],
            "{}: {left:?} left",
            subject.name
        );
    }
    assert!(sides.iter().all(|channels| *channels > 3), "{sides:?}");
}
