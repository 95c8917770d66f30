//! Is each claim kept, and not slack? A promise is broken where the measured error exceeds it, and slack where it falls
//! below nine tenths of it.

use fresnel_gen::fit::model_error_over;
use fresnel_gen::methods::{self, Contract};
use fresnel_gen::verify::library_code_error;

/// Cosines at which a library function's code error is taken, for each of some 2000 media.
const POINTS: usize = 1000;

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

#[test]
fn code_errors_are_what_methods_promise() {
    for method in methods::ALL {
        let error = library_code_error(method, POINTS);
        let (promised, measured) = (method.claims.code_ulp, error.max_ulp);
        let what = format!(
            "{}: measured {measured:.2} ulp at cos {:e}, promised {promised}",
            method.name, error.worst_cos
        );
        assert!(measured <= promised, "exceeded: {what}");
        assert!(
            measured >= 0.9 * promised,
            "slack, lower the promise: {what}"
        );
        let kept = method.contract == Contract::Kept;
        assert!(
            !kept || promised <= 16.0,
            "a method that keeps the contract stays within 16 ulp: {what}"
        );
    }
}
