//! How fast are tables made? Tables per second, from the truth to bytes in all formats, and the search for the smallest.
#![allow(missing_docs)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use fresnel_gen::generator::bake::{BakeRequest, TableSize, bake};
use fresnel_gen::generator::generate::tables::table_materials;
use fresnel_gen::generator::lut::{Depth, Format, Table, TableAxis, smallest};
use fresnel_gen::generator::reference::ReferenceCurve;
use fresnel_gen::generator::request::Request;
use fresnel_gen::language::methods::Light;
use fresnel_gen::physics::materials::{Surface, ViewingConditions, find};

fn gold() -> ReferenceCurve {
    let gold = find("gold")
        .expect("it is there")
        .expect("it is well formed");
    let surface = Surface::new(&gold, None, &ViewingConditions::default()).expect("gold is seen");
    ReferenceCurve::new(surface, Light::Unpolarised)
}

fn one(c: &mut Criterion) {
    let gold = gold();
    let mut group = c.benchmark_group("tables");
    group.throughput(Throughput::Elements(1));
    group.bench_function("256 texels of gold", |b| {
        b.iter(|| Table::new("gold", &gold, TableAxis::Rational, 256))
    });
    group.finish();
}

fn all_formats(c: &mut Criterion) {
    let (subjects, _) = table_materials(&Request::default()).expect("the four are seen");
    let request = BakeRequest {
        subjects,
        typed: Vec::new(),
        formats: Format::ALL.to_vec(),
        shape: TableSize::Fixed {
            axis: TableAxis::Rational,
            texels: 256,
        },
        atlas: false,
        targets: Vec::new(),
        prefix: "fresnel_".to_owned(),
        flags: String::new(),
    };
    let mut group = c.benchmark_group("tables");
    group.throughput(Throughput::Elements(4));
    group.bench_function("256 texels of four materials, all formats, measured", |b| {
        b.iter(|| bake(&request, &mut |_, _, _| {}))
    });
    group.finish();
}

fn search(c: &mut Criterion) {
    let gold = gold();
    c.bench_function("the smallest table of gold within 0.001", |b| {
        b.iter(|| smallest(&[&gold], 0.001, &TableAxis::ALL, &Depth::ALL))
    });
}

criterion_group!(benches, one, all_formats, search);
criterion_main!(benches);
