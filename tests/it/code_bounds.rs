//! The recorded code bounds of the catalogue's specialised functions: measured again, each way.
//! `data/code-bounds.csv` is keyed by what a function computes; `BLESS=1` rewrites it.

use std::path::Path;

use crate::code_error::{code_error, digits_lost};
use fresnel_gen::generator::emit::{Bounds, Naming, PLAIN_ULP, fingerprint, specialised_function};
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::generator::request::{DEFAULT_MATERIALS, Materials, Request};
use fresnel_gen::language::ir::Checked;
use fresnel_gen::language::methods::{self, Contract, Method};

/// Cosines tried for each function.
const POINTS: usize = 200_000;

/// All methods for the materials that are committed, the usual ones for the others.
fn methods_of(subject: &MaterialInMedium) -> Vec<&'static Method> {
    let name = subject.name.trim_end_matches("_thesis");
    let committed = DEFAULT_MATERIALS.contains(&name);
    let wanted = |method: &&&Method| {
        let fits = subject.is_described_by(method);
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

/// The columns of the record.
const HEAD: [&str; 6] = [
    "fingerprint",
    "material",
    "method",
    "max_ulp",
    "max_abs",
    "worst_cos",
];

/// The row of a method's function for a material, and of its plain form where that keeps its digits.
fn rows(method: &'static Method, subject: &MaterialInMedium) -> Vec<[String; 6]> {
    let stable = specialised_function(method, subject, &Naming::default(), &Bounds::default());
    let stable = stable.expect("every method specialises to the catalogue");
    let row = |function: &Checked, form: &str| {
        let error = code_error(function, POINTS);
        let mark = fingerprint(function);
        let ulp = promised(error.max_ulp, &mark);
        let cells = [
            mark,
            subject.name.clone(),
            format!("{}{form}", method.name),
            ulp.to_string(),
            format!("{:e}", error.max_abs),
            format!("{:e}", error.worst_cos),
        ];
        (ulp, cells)
    };
    let (_, first) = row(&stable.function, "");
    let plain = method
        .specialise_plain(&stable.constants)
        .and_then(Result::ok);
    // Near eta = 1 it stays within 2^-22 and yet loses all digits of so small a reflectance.
    let plain = plain
        .filter(|plain| digits_lost(plain, POINTS) <= PLAIN_ULP)
        .map(|plain| row(&plain, " plain"))
        .filter(|(ulp, _)| *ulp <= PLAIN_ULP);
    [Some(first), plain.map(|(_, cells)| cells)]
        .into_iter()
        .flatten()
        .collect()
}

#[test]
fn the_record_is_what_is_measured() {
    let request = Request {
        materials: Materials::All,
        ..Request::default()
    };
    let mut record = Vec::new();
    for subject in request
        .subjects()
        .expect("the catalogue is good")
        .materials()
    {
        for method in methods_of(&subject) {
            record.extend(rows(method, &subject));
        }
    }
    super::bless::check(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("data/code-bounds.csv"),
        super::records::text(HEAD, &record).as_bytes(),
    );
}
