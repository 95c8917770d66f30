//! The claims about Schlick's approximation (sections 3.1.3, 3.2.2 and 5.3.1): its range of n, its two forms, its error for water.

use crate::lab::reproduce::comparison::{
    ComparisonRow, ComparisonVerdict, Figure, measured, statement,
};
use crate::lab::reproduce::figures::{cosine, exact, highest};
use crate::lab::reproduce::section::Meter;
use crate::lab::reproduce::specialised;
use crate::lab::reproduce::thesis_measure::thesis_errors;
use crate::physics::materials::Channels;

/// Indices from hydrogen to germanium, dense in and around the claimed range, three at a time for three channels.
const INDICES: [[f64; 3]; 7] = [
    [1.001, 1.1, 1.2],
    [1.3, 1.4, 1.5],
    [1.6, 1.7, 1.8],
    [1.9, 2.0, 2.04],
    [2.1, 2.2, 2.3],
    [2.4, 2.5, 3.0],
    [3.5, 4.0, 4.01],
];
/// The claimed range.
const GOOD: std::ops::RangeInclusive<f64> = 1.4..=2.2;

/// The error of Schlick's approximation for an index.
struct Error {
    n: f64,
    mean_percent: f64,
    largest: f64,
    at: f64,
}

/// How often all angles are evaluated.
pub const PASSES: usize = INDICES.len();

/// The claims about Schlick's approximation.
pub fn schlick_claims(angles: usize, meter: &mut Meter) -> Vec<ComparisonRow> {
    let errors: Vec<Error> = INDICES
        .iter()
        .flat_map(|n| errors(*n, angles, meter))
        .collect();
    let mut rows = vec![range(&errors)];
    rows.extend(errors.iter().flat_map(figures));
    rows.push(equal_forms());
    rows.push(water());
    rows
}

fn errors(n: [f64; 3], angles: usize, meter: &mut Meter) -> Vec<Error> {
    let channels = Channels { n, k: [0.0; 3] };
    let function = specialised::function("schlick_ior", &channels);
    let mut progress = |done| meter.add(done, "Schlick's error by n");
    let means = thesis_errors(&[&function], &channels, angles, &mut progress)[0];
    let error = |(n, mean): (f64, f64)| {
        let (at, largest) = largest(n);
        Error {
            n,
            mean_percent: 100.0 * mean,
            largest,
            at,
        }
    };
    n.into_iter().zip(means).map(error).collect()
}

/// The point at which Schlick is furthest from the exact law, and the difference.
fn largest(n: f64) -> (f64, f64) {
    highest(difference(n))
}

fn difference(n: f64) -> impl Fn(f64) -> f64 {
    let channels = specialised::grey([n, 0.0]);
    let function = specialised::function("schlick_ior", &channels);
    move |degrees| {
        let got = specialised::at(&function, cosine(degrees));
        (got - exact([n, 0.0], degrees).unpolarised()).abs()
    }
}

fn range(errors: &[Error]) -> ComparisonRow {
    let (largest, as_small) = inside_and_outside(errors, |error| error.largest);
    let (mean, as_small_in_mean) = inside_and_outside(errors, |error| error.mean_percent);
    let holding = [&as_small, &as_small_in_mean];
    let holding = holding.iter().filter(|exceptions| exceptions.is_empty());
    let ours = format!(
        "by the largest difference: at most {largest:.3} inside, {}. By the thesis's own measure: at most {mean:.2} % inside, {}. \
         All stand below",
        outside(&as_small),
        outside(&as_small_in_mean),
    );
    let claim = "Schlick is precise for n from 1.4 to 2.2; outside, the error grows drastically";
    statement("Schlick by n", "section 3.1.3", claim, ours)
        .verdict(ComparisonVerdict::of_cases(holding.count(), 2))
}

/// The largest error inside the range, and the indices outside whose error is no larger.
fn inside_and_outside(errors: &[Error], figure: fn(&Error) -> f64) -> (f64, Vec<String>) {
    let (inside, outside): (Vec<&Error>, Vec<&Error>) =
        errors.iter().partition(|error| GOOD.contains(&error.n));
    let worst = inside.into_iter().map(figure).fold(0.0, f64::max);
    let as_small = outside.into_iter().filter(|error| figure(error) <= worst);
    (worst, as_small.map(|error| error.n.to_string()).collect())
}

/// Whether all errors outside the range are larger than the worst inside, in words, and if not, for which indices.
fn outside(exceptions: &[String]) -> String {
    if exceptions.is_empty() {
        "more at all other n".to_owned()
    } else {
        format!("more at other n, but for {}", exceptions.join(", "))
    }
}

fn figures(error: &Error) -> [ComparisonRow; 3] {
    let name = format!("Schlick, n = {}", error.n);
    [
        measured(
            &name,
            "mean relative error",
            Figure::percent(error.mean_percent),
        ),
        measured(
            &name,
            "largest difference",
            Figure::Number(error.largest, 4, ""),
        ),
        measured(&name, "its angle", Figure::Number(error.at, 2, "°")),
    ]
}

fn equal_forms() -> ComparisonRow {
    let apart = |n: f64| {
        let channels = specialised::grey([n, 0.0]);
        let [a, b] = ["schlick", "schlick_ior"].map(|name| specialised::function(name, &channels));
        let curve = |degrees| {
            let c = cosine(degrees);
            (specialised::at(&a, c) - specialised::at(&b, c)).abs()
        };
        highest(curve).1
    };
    let apart = [1.001, 1.33, 2.42, 4.01]
        .map(apart)
        .into_iter()
        .fold(0.0, f64::max);
    let ours = if apart < 1e-14 {
        "at n 1.001, 1.33, 2.42 and 4.01 they differ by rounding only".to_owned()
    } else {
        format!("they differ by up to {apart:.1e}")
    };
    let claim = "for dielectrics the two forms, eq. 7 and eq. 13, are equivalent";
    statement("Schlick's two forms", "sections 3.1.3, 3.2.2", claim, ours)
        .verdict(ComparisonVerdict::of_claim(apart < 1e-14))
}

/// Number of equal steps from 0 to 90 degrees, whose middles give a share of the interval to 0.01 %.
const STEPS: u32 = 9000;

fn water() -> ComparisonRow {
    let difference = difference(1.33);
    let middles = (0..STEPS).map(|i| (f64::from(i) + 0.5) * 90.0 / f64::from(STEPS));
    let small = middles
        .filter(|degrees| difference(*degrees) < 0.01)
        .count();
    let share = 100.0 * small as f64 / f64::from(STEPS);
    let claim = "for water the absolute error is below 0.01 in 80 % of the interval";
    let ours = format!(
        "n = 1.33: in {share:.1} %; the largest is {:.3} at {:.2}°",
        largest(1.33).1,
        largest(1.33).0
    );
    // The claim has one digit: 75 to 85 counts as 80.
    statement("Schlick for water", "section 5.3.1", claim, ours)
        .verdict(ComparisonVerdict::of_claim((75.0..85.0).contains(&share)))
}
