//! A search for inputs at which library functions err more than is known. What it finds becomes lines of
//! `data/worst-cases/library-code-error.csv`, and the claims `code_ulp` follow.
//!
//!     SEARCH=all cargo test --release --test it -- --ignored --nocapture worse_inputs
//!
//! In place of `all` stand names of methods, with commas between them. It takes a quarter of an hour for all.

use crate::code_error::{library_code_error_at, random_medium};
use fresnel_gen::generator::request::{Materials, Request};
use fresnel_gen::lab::verify::Random;
use fresnel_gen::language::methods::{self, Class, Contract, Method};
use fresnel_gen::physics::materials::Channels;

/// Random media, and cosines for each: other ones each time.
const MEDIA: usize = 12_000;
const COSINES: usize = 1000;
/// Cosines for each channel of the catalogue's materials.
const CATALOGUE_COSINES: usize = 100_000;
/// So many of the worst are climbed from, with so many steps.
const STARTS: usize = 48;
const STEPS: usize = 400;
/// Cosines tried in each step.
const NEAR: usize = 96;
/// Beside 90 degrees a textbook form promises nothing.
const TEXTBOOK_FROM: f64 = 1.000_000_1e-6;

/// A number near this one: next to it, or up to a tenth away.
fn near(x: f64, random: &mut Random) -> f64 {
    let scale = libm::exp10(-1.0 - 6.0 * random.unit());
    x * (1.0 + scale * (2.0 * random.unit() - 1.0))
}

/// A medium and a cosine, and the error there in ulp.
#[derive(Clone, Copy)]
struct Case {
    ulp: f64,
    n: f64,
    k: f64,
    cos_theta: f32,
}

fn case(method: &Method, n: f64, k: f64, cosines: &[f32]) -> Case {
    let channels = Channels {
        n: [n; 3],
        k: [k; 3],
    };
    let error = library_code_error_at(method, &channels, cosines);
    Case {
        ulp: error.max_ulp,
        n,
        k,
        cos_theta: error.worst_cos as f32,
    }
}

/// Where a method keeps its promise.
fn within(method: &Method, cos_theta: f64) -> f32 {
    let kept = method.contract == Contract::Kept;
    cos_theta.clamp(if kept { 0.0 } else { TEXTBOOK_FROM }, 1.0) as f32
}

fn cosines(method: &Method, count: usize, random: &mut Random) -> Vec<f32> {
    let one = |i: usize| {
        let share = random.unit();
        let cos_theta = match i % 4 {
            0 => share,
            1 => libm::exp2(-30.0 * share),
            2 => libm::exp2(-14.0 * share),
            _ => 1.0 - libm::exp2(-24.0 * share),
        };
        within(method, cos_theta)
    };
    (0..count).map(one).collect()
}

/// The worst of random media.
fn random_cases(method: &Method, random: &mut Random) -> Vec<Case> {
    let one = |_| {
        let (n, k) = random_medium(method, method.claims.code_over, random);
        case(method, n, k, &cosines(method, COSINES, random))
    };
    worst((0..MEDIA).map(one).collect())
}

/// The worst of the catalogue's materials.
fn catalogue_cases(method: &Method, random: &mut Random) -> Vec<Case> {
    let all = Request {
        materials: Materials::All,
        ..Request::default()
    };
    let subjects = all.subjects().expect("the catalogue is good").materials();
    let mut cases = Vec::new();
    for subject in subjects.iter().filter(|s| s.is_described_by(method)) {
        let Channels { n, k } = subject.effective.channels;
        for (n, k) in n.into_iter().zip(k) {
            if method.claims.code_over.holds(n, k) {
                let cosines = cosines(method, CATALOGUE_COSINES, random);
                cases.push(case(method, n, k, &cosines));
            }
        }
    }
    worst(cases)
}

fn worst(mut cases: Vec<Case>) -> Vec<Case> {
    cases.sort_by(|a, b| b.ulp.total_cmp(&a.ulp));
    cases.truncate(STARTS);
    cases
}

/// From a case to worse ones beside it.
fn climb(method: &Method, start: Case, random: &mut Random) -> Case {
    let glass = method.class == Class::Dielectric;
    (0..STEPS).fold(start, |now, step| {
        let (mut n, mut k) = (now.n, now.k);
        if step % 3 != 0 {
            n = 1.0 + near(now.n - 1.0, random);
            k = if glass { 0.0 } else { near(now.k, random) };
        }
        if !method.claims.code_over.holds(n, k) {
            return now;
        }
        let beside = (0..NEAR).map(|_| within(method, near(f64::from(now.cos_theta), random)));
        let tried = case(method, n, k, &beside.collect::<Vec<_>>());
        if tried.ulp > now.ulp { tried } else { now }
    })
}

#[test]
#[ignore = "a search of minutes: what it prints are lines to be added"]
fn worse_inputs_are_looked_for() {
    let wanted = std::env::var("SEARCH").unwrap_or_default();
    let is_wanted = |name: &str| wanted == "all" || wanted.split(',').any(|w| w == name);
    for method in methods::ALL.iter().filter(|m| !m.is_textured()) {
        if !is_wanted(method.name) {
            continue;
        }
        let mut random = Random(0x9E37_79B9_7F4A_7C15);
        let mut starts = random_cases(method, &mut random);
        starts.extend(catalogue_cases(method, &mut random));
        let climbed = starts
            .iter()
            .map(|start| climb(method, *start, &mut random));
        let Case {
            ulp,
            n,
            k,
            cos_theta,
        } = worst(climbed.collect())[0];
        println!(
            "{},{n},{k},{cos_theta} is {ulp:.3} ulp off; claimed are {}",
            method.name, method.claims.code_ulp
        );
    }
}
