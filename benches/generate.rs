//! How fast is generation? Everything that is committed, one target, and a check that finds nothing to do.
#![allow(missing_docs)]

use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};

use fresnel_gen::generator::generate;
use fresnel_gen::generator::output::tree;
use fresnel_gen::generator::request::Request;
use fresnel_gen::language::targets::Target;

fn everything(c: &mut Criterion) {
    c.bench_function("generate everything that is committed", |b| {
        b.iter(|| generate(&Request::default()))
    });
}

fn one_target(c: &mut Criterion) {
    for target in [Target::GLES, Target::SPIRV] {
        let request = Request {
            targets: vec![target],
            ..Request::default()
        };
        c.bench_function(&format!("generate {}", target.name), |b| {
            b.iter(|| generate(&request))
        });
    }
}

fn no_op_check(c: &mut Criterion) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-generated");
    c.bench_function("check, nothing to do", |b| {
        b.iter(|| {
            let generated = generate(&Request::default()).expect("the catalogue generates");
            let plan = tree::plan(
                &folder,
                &generated.artifacts,
                &generated.scope,
                &generated.provenance,
            );
            tree::report(&plan.expect("a plan"))
        });
    });
}

criterion_group!(benches, everything, one_target, no_op_check);
criterion_main!(benches);
