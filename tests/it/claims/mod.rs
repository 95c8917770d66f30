//! Is each claim kept, and not slack? A promise is broken where the measured error exceeds it, and slack where it falls
//! below nine tenths of it.

mod over;
mod search;

use crate::code_error::{coefficient_code_error, library_code_error, library_code_error_at};
use fresnel_gen::generator::request::{Materials, Request};
use fresnel_gen::lab::verify::{cosines, worst_media};
use fresnel_gen::language::methods::{self, Contract, Method};

/// Random media over which a library function's code error is taken, and cosines for each.
const MEDIA: usize = 6000;
const POINTS: usize = 800;
/// Random media over which coefficients are taken, which have no cosine.
const COEFFICIENT_MEDIA: usize = 300_000;

/// A model error below this is rounding: the method is exact.
const EXACT: f64 = 1e-12;

/// A promise is slack below this share of it: of a model error, and of a code error, which a search finds less sharply.
const SLACK: [f64; 2] = [0.9, 0.8];
/// The angle of the worst error is right to so many degrees.
const DEGREES: f64 = 0.3;

/// All faults at once, so that one run says what every claim of a new method should be.
fn expect_none(faults: impl Iterator<Item = String>) {
    let faults: Vec<String> = faults.collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn model_errors_are_what_methods_promise() {
    let methods = methods::ALL.iter();
    let claims = methods.flat_map(|method| method.claims.model.iter().map(move |c| (method, c)));
    expect_none(claims.filter_map(|(method, claim)| {
        let error = over::model_error_over(method, claim.over);
        let (promised, measured) = (claim.max_abs, error.max_abs);
        let degrees = error.worst_cos.acos().to_degrees();
        let fault = if promised == 0.0 {
            (measured > EXACT).then(|| "not exact".to_owned())
        } else if measured > promised {
            Some("exceeded".to_owned())
        } else if measured < SLACK[0] * promised {
            Some(format!("slack, below {} of the promise", SLACK[0]))
        } else {
            let is_apart = (degrees - claim.at_degrees).abs() >= DEGREES;
            is_apart.then(|| format!("more than {DEGREES} degrees from its `at_degrees`"))
        };
        fault.map(|fault| {
            format!(
                "{} over {}: {fault}: measured {measured:.6} at {degrees:.2} degrees, promised {promised} at {}",
                method.name,
                claim.over.text(),
                claim.at_degrees
            )
        })
    }));
}

/// The promises stand for the worst of a large search, kept in the file, rounded up.
#[test]
fn code_errors_are_what_methods_promise() {
    // What reads a texture is as exact as its sampler, and has no figure of its own.
    // What is promised of films is absolute: `films` measures it.
    let numeric = methods::all_variants();
    let numeric = numeric.filter(|method| !method.is_textured() && method.claims.code_abs == 0.0);
    expect_none(numeric.filter_map(|method| {
        let searched = library_code_error(method, MEDIA, POINTS).max_ulp;
        let known = worst_media(method).map(|(channels, cos_theta)| {
            library_code_error_at(method, &channels, &[cos_theta]).max_ulp
        });
        let (promised, measured) = (method.claims.code_ulp, known.fold(searched, f64::max));
        let kept = method.contract == Contract::Kept;
        let fault = if measured > promised {
            Some("exceeded".to_owned())
        } else if measured < SLACK[1] * promised && method.variant.is_empty() {
            Some(format!("slack, below {} of the promise", SLACK[1]))
        } else {
            let is_much = kept && promised > 16.0;
            is_much.then(|| "a method that keeps the contract stays within 16 ulp".to_owned())
        };
        let name = [method.name, method.variant].join(" ");
        fault.map(|fault| {
            format!("{name}: {fault}: measured {measured:.2} ulp, `code_ulp` is {promised}")
        })
    }));
}

/// Cosines for each channel of the catalogue's materials, which a search by random media does not meet.
const CATALOGUE_POINTS: usize = 2000;

/// What people run first is the catalogue.
#[test]
fn code_errors_over_the_catalogue_are_within_promises() {
    let all = Request {
        materials: Materials::All,
        ..Request::default()
    };
    let subjects = all.subjects().unwrap().materials();
    let cosines = cosines(CATALOGUE_POINTS);
    // Beside 90 degrees a textbook form promises nothing.
    let kept = |method: &Method| {
        !method.is_textured() && method.contract == Contract::Kept && method.claims.code_abs == 0.0
    };
    let numeric = methods::all_variants().filter(|method| kept(method));
    let each = numeric.flat_map(|method| subjects.iter().map(move |subject| (method, subject)));
    expect_none(each.filter_map(|(method, subject)| {
        let channels = &subject.effective.channels;
        let over = method.claims.code_over;
        let is_promised = subject.is_described_by(method)
            && (0..3).all(|i| over.holds(channels.n[i], channels.k[i]));
        if !is_promised {
            return None;
        }
        let (name, promised) = (method.name, method.claims.code_ulp);
        let measured = library_code_error_at(method, channels, &cosines).max_ulp;
        (measured > promised).then(|| {
            format!(
                "{name} {}: {} is {measured:.2} ulp off, `code_ulp` is {promised}",
                method.variant, subject.material.name
            )
        })
    }));
}

/// Coefficients cancel, so that what they promise is absolute.
#[test]
fn coefficients_are_off_by_what_methods_promise() {
    let finding = methods::ALL
        .iter()
        .filter_map(|method| Some((method, method.coefficients?)));
    expect_none(finding.filter_map(|(method, finds)| {
        let measured = coefficient_code_error(method, COEFFICIENT_MEDIA).unwrap();
        let promised = finds.code_abs;
        let is_kept = (SLACK[1] * promised..=promised).contains(&measured);
        let name = method.name;
        (!is_kept)
            .then(|| format!("{name}: measured {measured:e} absolute, `code_abs` is {promised:e}"))
    }));
}
