//! The recorded code bounds of the catalogue's specialised functions: measured again, each way.
//! `data/code-bounds.csv` is keyed by what a function computes; `BLESS=1` rewrites it.

use std::fmt::Write;
use std::path::Path;

use fresnel_gen::app::request::DEFAULT_MATERIALS;
use fresnel_gen::app::{Materials, Request};
use fresnel_gen::emit::{Bounds, Naming, Subject, fingerprint, specialised_function};
use fresnel_gen::methods::{self, Class, Contract, Method};
use fresnel_gen::verify::code_error;

/// Cosines tried for each function.
const POINTS: usize = 200_000;

/// All methods for the materials that are committed, the usual ones for the others.
fn methods_of(subject: &Subject) -> Vec<&'static Method> {
    let transparent = subject.effective.channels.is_transparent();
    let name = subject.name.trim_end_matches("_thesis");
    let committed = DEFAULT_MATERIALS.contains(&name);
    let wanted = |method: &&&Method| {
        let fits = method.class == Class::Any || transparent;
        let usual = subject.default_methods().contains(&method.name);
        let numeric = method.contract == Contract::Kept && !method.is_textured();
        numeric && fits && (committed || usual)
    };
    methods::ALL.iter().filter(wanted).copied().collect()
}

/// What holds everywhere: what all numbers gave, where they were run; else a sample finds nearly the worst, so that a fifth
/// more is promised. Up to the next half.
fn promised(sampled: f64, fingerprint: &str) -> f64 {
    let all = super::exhaustive::max_ulp(fingerprint);
    let ulp = if all > 0.0 {
        sampled.max(all)
    } else {
        sampled * 1.2
    };
    (ulp * 2.0).ceil() / 2.0
}

#[test]
fn the_record_is_what_is_measured() {
    let request = Request {
        materials: Materials::All,
        ..Request::default()
    };
    let mut record = String::from("fingerprint,material,method,max_ulp,max_abs,worst_cos\n");
    for (subject, _) in request.subjects().expect("the catalogue is good").ready {
        for method in methods_of(&subject) {
            let emitted =
                specialised_function(method, &subject, &Naming::default(), &Bounds::default())
                    .expect("every method specialises to the catalogue");
            let error = code_error(&emitted.function, POINTS);
            let mark = fingerprint(&emitted.function);
            let ulp = promised(error.max_ulp, &mark);
            let _ = writeln!(
                record,
                "{mark},{},{},{ulp},{:e},{:e}",
                subject.name, method.name, error.max_abs, error.worst_cos
            );
        }
    }
    super::bless::check(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("data/code-bounds.csv"),
        record.as_bytes(),
    );
}
