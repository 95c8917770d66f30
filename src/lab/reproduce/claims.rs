//! The claims in the thesis's text, each tested by numbers.

use crate::lab::reproduce::comparison::{
    self, ComparisonRow, ComparisonVerdict, Figure, Meter, RELATIVE_TIMES, ThesisSection, measured,
    statement,
};
use crate::lab::reproduce::figures::{cosine, exact, highest, lowest};
use crate::lab::reproduce::specialised;
use crate::lab::reproduce::thesis_measure::thesis_errors;
use crate::language::ir::{Checked, Op};
use crate::physics::materials::{Channels, THESIS_NM};
use crate::physics::num::each_channel;

/// All claims.
pub fn section(angles: usize, meter: &mut Meter) -> ThesisSection {
    let rows = [
        schlick_claims(angles, meter),
        minimum_claims(),
        gold_claims(),
        instruction_claims(),
        speed_claims(),
    ];
    ThesisSection {
        title: "Claims of the text".to_owned(),
        rows: rows.concat(),
    }
}

/// The tolerance of "about 77°" in degrees, and of "a little over 20 %" in percentage points.
const ABOUT: f64 = 1.0;
/// How far "a little" reaches above a bound, in percentage points.
const A_LITTLE: f64 = 5.0;

/// The claims about gold at 685 and 475 nm (section 2.2, beside figures 9 and 10).
fn gold_claims() -> Vec<ComparisonRow> {
    let channels = specialised::channels("gold");
    let index = |i: usize| [channels.n[i], channels.k[i]];
    let (red, blue) = (index(0), index(2));
    [at_685(red), at_475(blue)].concat()
}

fn at_685(index: [f64; 2]) -> Vec<ComparisonRow> {
    let (minimum, least) = lowest(|degrees| exact(index, degrees).unpolarised());
    let (minimum_p, least_p) = lowest(|degrees| exact(index, degrees).p);
    let name = "gold at 685 nm";
    vec![
        measured(name, "angle of the minimum", degrees(minimum))
            .thesis(Figure::Number(77.0, 0, "°"))
            .verdict(ComparisonVerdict::of_claim((minimum - 77.0).abs() <= ABOUT))
            .remark(
                "section 2.2: about 77°. Even the p-polarised light alone has its minimum lower",
            ),
        measured(name, "angle of p's minimum", degrees(minimum_p)),
        measured(name, "least reflectance", Figure::percent(100.0 * least))
            .thesis(Figure::Number(92.0, 0, " %"))
            .verdict(ComparisonVerdict::of_claim(least > 0.92))
            .remark("section 2.2: more than 92 % at every angle"),
        measured(
            name,
            "p's least reflectance",
            Figure::percent(100.0 * least_p),
        ),
    ]
}

fn at_475(index: [f64; 2]) -> Vec<ComparisonRow> {
    let (_, least) = lowest(|degrees| exact(index, degrees).unpolarised());
    let (minimum_p, least_p) = lowest(|degrees| exact(index, degrees).p);
    let name = "gold at 475 nm";
    let above = 100.0 * least - 20.0;
    vec![
        measured(name, "least reflectance", Figure::percent(100.0 * least))
            .thesis(Figure::Number(20.0, 0, " %"))
            .verdict(ComparisonVerdict::of_claim(
                (0.0..=A_LITTLE).contains(&above),
            ))
            .remark(
                "section 2.2: a little over 20 %. The unpolarised curve only rises; \
                 the p-polarised light alone falls below 20 %",
            ),
        measured(name, "angle of p's minimum", degrees(minimum_p)),
        measured(
            name,
            "p's least reflectance",
            Figure::percent(100.0 * least_p),
        ),
    ]
}

fn degrees(value: f64) -> Figure {
    Figure::Number(value, 2, "°")
}

/// Where the thesis puts the minimum: cos θ = 0.15 and 0.10.
const CLAIMED: std::ops::RangeInclusive<f64> = 81.37..=84.26;
/// The error of the rescaled Schlick from which on a correction is worthwhile: a hundredth, two or three steps of an eight-bit
/// display.
const WORTH_CORRECTING: f64 = 0.01;

/// More metals, to test what the thesis says of metals in general.
const OTHERS: [&str; 6] = [
    "silver",
    "aluminium_rakic",
    "chromium",
    "copper",
    "sodium",
    "tungsten",
];

/// One metal at one wavelength.
struct MetalAtWavelength {
    name: String,
    /// The angle of the least reflectance.
    minimum: f64,
    least: f64,
    /// The angle at which the rescaled Schlick is furthest from the exact law.
    furthest: f64,
    apart: f64,
}

/// The claims about the angle at which metals reflect least (sections 3.2.3 and 3.2.4).
fn minimum_claims() -> Vec<ComparisonRow> {
    let curves = curves();
    let worth: Vec<&MetalAtWavelength> = curves
        .iter()
        .filter(|c| c.apart > WORTH_CORRECTING)
        .collect();
    let mut rows = vec![
        of_reflectance(&worth, curves.len()),
        of_difference(&worth, curves.len()),
    ];
    rows.extend(curves.iter().flat_map(minimum_figures));
    rows
}

fn curves() -> Vec<MetalAtWavelength> {
    let thesis =
        ["gold", "platinum"].map(|name| (format!("thesis {name}"), specialised::channels(name)));
    let others = OTHERS.map(|name| (name.to_owned(), specialised::unrounded(name)));
    let all = thesis.into_iter().chain(others);
    all.flat_map(|(name, channels)| three(&name, &channels))
        .collect()
}

fn three(name: &str, channels: &Channels) -> [MetalAtWavelength; 3] {
    each_channel(|i| {
        let name = format!("{name}, {} nm", THESIS_NM[i]);
        curve(name, [channels.n[i], channels.k[i]])
    })
}

fn curve(name: String, index: [f64; 2]) -> MetalAtWavelength {
    let function = specialised::function("schlick_rescaled", &specialised::grey(index));
    let reflectance = |degrees| exact(index, degrees).unpolarised();
    let (minimum, least) = lowest(reflectance);
    let (furthest, apart) = highest(|degrees| {
        (specialised::at(&function, cosine(degrees)) - reflectance(degrees)).abs()
    });
    MetalAtWavelength {
        name,
        minimum,
        least,
        furthest,
        apart,
    }
}

fn of_reflectance(curves: &[&MetalAtWavelength], all: usize) -> ComparisonRow {
    let (inside, low, high) = within(curves, |curve| curve.minimum);
    let ours = format!(
        "{inside} of {} (those of {all} metal channels for which the rescaled Schlick is more than {WORTH_CORRECTING} \
         off): the least unpolarised reflectance stands at {low:.2}° to {high:.2}° (0° is a curve that only rises)",
        curves.len()
    );
    let claim = "for most metals whose error is worth correcting, the local minimum lies between 81.37° and 84.26°";
    statement("minimum of metals", "section 3.2.4", claim, ours)
        .verdict(ComparisonVerdict::of_claim(2 * inside > curves.len()))
}

fn of_difference(curves: &[&MetalAtWavelength], all: usize) -> ComparisonRow {
    let (inside, low, high) = within(curves, |curve| curve.furthest);
    let ours = format!(
        "{inside} of the same {} (of {all}): the rescaled Schlick is furthest off at {low:.2}° to {high:.2}°",
        curves.len()
    );
    let claim = "the same range, read as the place of the largest error, which is what the correction is made for";
    statement("largest error on metals", "section 3.2.4", claim, ours)
        .verdict(ComparisonVerdict::of_claim(2 * inside > curves.len()))
}

/// How many lie in the claimed range, and the range of all.
fn within(
    curves: &[&MetalAtWavelength],
    angle: fn(&MetalAtWavelength) -> f64,
) -> (usize, f64, f64) {
    let angles: Vec<f64> = curves.iter().map(|curve| angle(curve)).collect();
    let inside = angles
        .iter()
        .filter(|angle| CLAIMED.contains(angle))
        .count();
    let low = angles.iter().copied().fold(90.0, f64::min);
    (inside, low, angles.into_iter().fold(0.0, f64::max))
}

fn minimum_figures(curve: &MetalAtWavelength) -> [ComparisonRow; 4] {
    let row = |column: &str, figure| measured(&curve.name, column, figure);
    [
        row("minimum", Figure::percent(100.0 * curve.least)),
        row("its angle", Figure::Number(curve.minimum, 2, "°")),
        row(
            "largest error of rescaled",
            Figure::Number(curve.apart, 4, ""),
        ),
        row("angle of that", Figure::Number(curve.furthest, 2, "°")),
    ]
}

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

/// The claims about Schlick's approximation (sections 3.1.3, 3.2.2 and 5.3.1): its range of n, its two forms, its error for water.
fn schlick_claims(angles: usize, meter: &mut Meter) -> Vec<ComparisonRow> {
    let errors: Vec<Error> = INDICES
        .iter()
        .flat_map(|n| errors(*n, angles, meter))
        .collect();
    let mut rows = vec![range(&errors)];
    rows.extend(errors.iter().flat_map(schlick_figures));
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

fn schlick_figures(error: &Error) -> [ComparisonRow; 3] {
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

/// The claims about speed (section 5.3.2), tested by Table 6 itself and not by our own times.
fn speed_claims() -> Vec<ComparisonRow> {
    vec![schlick(), table(), conductor()]
}

/// One method's times on all devices, divided by another's.
fn ratios(method: &str, other: &str) -> Vec<f64> {
    let columns = comparison::names(&[RELATIVE_TIMES, "columns"]);
    let place = |name: &str| columns.iter().position(|column| *column == name);
    let devices = comparison::devices(RELATIVE_TIMES).into_iter();
    let rows = devices.map(|device| comparison::numbers(&[RELATIVE_TIMES, device]));
    rows.filter_map(|row| Some(row[place(method)?] / row[place(other)?]))
        .collect()
}

fn schlick() -> ComparisonRow {
    let mut gains = ratios("dielectric_exact", "schlick_dielectric");
    gains.extend(ratios("conductor_exact", "schlick_conductor"));
    let twice = gains.iter().filter(|gain| **gain >= 2.0).count();
    let ours = format!(
        "by Table 6 in {twice} of {} cases, on five devices for dielectrics and for metals; the least gain is {:.2} times",
        gains.len(),
        least(&gains)
    );
    let claim = "Schlick is at least twice as fast as the exact law it stands for, in all cases";
    statement("Schlick's speed", "section 5.3.2", claim, ours)
        .verdict(ComparisonVerdict::of_cases(twice, gains.len()))
}

fn table() -> ComparisonRow {
    let gains = ratios("dielectric_exact", "table");
    let (low, high) = (least(&gains), most(&gains));
    let ours = format!("by Table 6 {low:.1} to {high:.1} times");
    let claim = "the table lookup is 2 to 4 times as fast as the exact law for dielectrics";
    statement("the table's speed", "section 5.3.2", claim, ours)
        .verdict(ComparisonVerdict::of_claim(low >= 2.0 && high < 4.0))
}

fn conductor() -> ComparisonRow {
    let costs = ratios("conductor_exact", "dielectric_exact");
    let others: Vec<f64> = costs.iter().copied().filter(|cost| *cost < 2.0).collect();
    let ours = format!(
        "by Table 6 {:.0} to {:.0} % slower on four devices, {:.0} % on the Mali 400",
        100.0 * (least(&others) - 1.0),
        100.0 * (most(&others) - 1.0),
        100.0 * (most(&costs) - 1.0)
    );
    // "50 %", rounded to tens, and one ten on both sides.
    let near = others
        .iter()
        .filter(|cost| (1.4..=1.6).contains(*cost))
        .count();
    let claim = "the exact law for metals is only 50 % slower than that for dielectrics, except on the Mali 400";
    statement("the conductor's speed", "section 5.3.2", claim, ours)
        .verdict(ComparisonVerdict::of_cases(near, others.len()))
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The thesis's count of 90 % more is by the compiler of one GPU, ours is by the operations of the formula. An excess from half
/// to twice as large is the same statement.
const COMPARABLE: std::ops::RangeInclusive<f64> = 45.0..=180.0;

const HOW: &str = "section 5.3.2: about 90 % on Adreno, by its compiler. Ours: scalar operations of eqs. 8 to 12 against \
    those of eqs. 1 to 3 as printed (conductor_textbook, dielectric_textbook), before any compiler";

/// The claims about instructions.
fn instruction_claims() -> Vec<ComparisonRow> {
    [(true, "one channel"), (false, "three channels")]
        .into_iter()
        .flat_map(|(scalar_form, form)| of_form(scalar_form, form))
        .collect()
}

fn of_form(scalar_form: bool, form: &str) -> Vec<ComparisonRow> {
    let [conductor, dielectric] =
        ["conductor_textbook", "dielectric_textbook"].map(|name| library(name, scalar_form));
    let more = 100.0 * (conductor.work() as f64 / dielectric.work() as f64 - 1.0);
    let more_roots = roots(&conductor) - roots(&dielectric);
    let name = format!("conductor against dielectric, {form}");
    let row = |column: &str, figure| measured(&name, column, figure);
    let mut rows = vec![
        row("more operations", Figure::Number(more, 0, " %"))
            .thesis(Figure::Number(90.0, 0, " %"))
            .verdict(ComparisonVerdict::of_claim(COMPARABLE.contains(&more)))
            .remark(HOW),
        row("operations, conductor", count(conductor.work() as f64)),
        row("operations, dielectric", count(dielectric.work() as f64)),
        row("roots, conductor", count(roots(&conductor))),
        row("roots, dielectric", count(roots(&dielectric))),
    ];
    if scalar_form {
        let claimed = row("more roots", count(more_roots)).thesis(count(2.0));
        let verdict = ComparisonVerdict::of_claim(more_roots == 2.0);
        rows.insert(1, claimed.verdict(verdict));
    }
    rows
}

fn roots(function: &Checked) -> f64 {
    (function.count(Op::Sqrt) + function.count(Op::InverseSqrt)) as f64
}

fn count(number: f64) -> Figure {
    Figure::Number(number, 0, "")
}

fn library(name: &str, scalar_form: bool) -> Checked {
    let function = specialised::method(name).function(scalar_form);
    function.expect("both methods are well formed, and a test reproduces the claims")
}
