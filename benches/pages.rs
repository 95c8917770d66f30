//! How fast are pages read and seen? All pages of refractiveindex.info where the database is there (`tests/run` fetches
//! it), or pages made of the catalogue: read, integrated over the spectrum at 91 angles.
#![allow(missing_docs)]

use std::fs;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use fresnel_gen::generator::fit::survey_page;
use fresnel_gen::generator::request::source::pages;
use fresnel_gen::physics::materials::{self, Extrapolate, Material, ViewingConditions};

/// All pages of the database, name and text; none where it is not there.
fn database() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/refractiveindex");
    let text = |name: String| {
        let text = fs::read_to_string(folder.join(&name)).expect("a page");
        (name, text)
    };
    pages(&folder)
        .unwrap_or_default()
        .into_iter()
        .map(text)
        .collect()
}

/// A page with the same numbers at every measured point, or every 10 nm of a formula.
fn page(material: &Material) -> (String, String) {
    let mut places = material.measured_nm();
    if places.is_empty() {
        places = (38..=78).map(|tens| f64::from(tens) * 10.0).collect();
    }
    let row = |nm: &f64| {
        let index = material.index(*nm, Extrapolate::Hold).expect("an index");
        format!("        {} {} {}\n", nm / 1000.0, index.n, index.k)
    };
    let rows: String = places.iter().map(row).collect();
    let text = format!("REFERENCES: none\nDATA:\n  - type: tabulated nk\n    data: |\n{rows}");
    (format!("{}.yml", material.name), text)
}

/// The database, or else the catalogue.
fn all() -> Vec<(String, String)> {
    let found = database();
    if found.is_empty() {
        let all = materials::list().expect("the catalogue is good");
        return all.iter().map(page).collect();
    }
    found
}

fn read_and_see(c: &mut Criterion) {
    let pages = all();
    let viewing = ViewingConditions::default();
    let mut group = c.benchmark_group("pages");
    group.throughput(Throughput::Elements(pages.len() as u64));
    group.sample_size(10);
    group.bench_function(format!("read and see {} pages", pages.len()), |b| {
        b.iter(|| {
            pages
                .iter()
                .map(|(file, text)| survey_page(file, text, &viewing))
                .collect::<Vec<_>>()
        });
    });
}

criterion_group!(benches, read_and_see);
criterion_main!(benches);
