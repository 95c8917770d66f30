//! Is each claim kept, and not slack? A promise is broken where the measured error exceeds it, and slack where it falls
//! below nine tenths of it.

use fresnel_gen::fit::model_error_over;
use fresnel_gen::methods::{self, Contract};
use fresnel_gen::verify::{library_code_error, library_code_error_at, worst_media};

/// Random media over which a library function's code error is taken, and cosines for each.
const MEDIA: usize = 6000;
const POINTS: usize = 800;

/// A model error below this is rounding: the method is exact.
const EXACT: f64 = 1e-12;

#[test]
fn model_errors_are_what_methods_promise() {
    for method in methods::ALL {
        for claim in method.claims.model {
            let error = model_error_over(method, claim.over);
            let (promised, measured) = (claim.max_abs, error.max_abs);
            let what = format!(
                "{} over {}: measured {measured:.6} at cos {:.4}, promised {promised}",
                method.name,
                claim.over.text(),
                error.worst_cos
            );
            if promised == 0.0 {
                assert!(measured <= EXACT, "{what}");
            } else {
                assert!(measured <= promised, "exceeded: {what}");
                assert!(
                    measured >= 0.9 * promised,
                    "slack, lower the promise: {what}"
                );
                let degrees = error.worst_cos.acos().to_degrees();
                let apart = (degrees - claim.at_degrees).abs();
                assert!(apart < 0.3, "worst at {degrees:.1} degrees: {what}");
            }
        }
    }
}

/// The promises stand for the worst of a large search, kept in the file, rounded up.
#[test]
fn code_errors_are_what_methods_promise() {
    // What reads a texture is as exact as its sampler, and has no figure of its own.
    let numeric = methods::ALL.iter().filter(|method| !method.is_textured());
    for method in numeric {
        let searched = library_code_error(method, MEDIA, POINTS).max_ulp;
        let known = worst_media(method).map(|(channels, cos_theta)| {
            library_code_error_at(method, &channels, &[cos_theta]).max_ulp
        });
        let (promised, measured) = (method.claims.code_ulp, known.fold(searched, f64::max));
        let what = format!(
            "{}: measured {measured:.2} ulp, promised {promised}",
            method.name
        );
        assert!(measured <= promised, "exceeded: {what}");
        assert!(
            measured >= 0.8 * promised,
            "slack, lower the promise: {what}"
        );
        let kept = method.contract == Contract::Kept;
        assert!(
            !kept || promised <= 16.0,
            "a method that keeps the contract stays within 16 ulp: {what}"
        );
    }
}
