//! README's tables and example are what the program says today; `BLESS=1` rewrites them. Its Rust is compiled by rustdoc.

use std::fs;
use std::path::Path;

use fresnel_gen::app::generate::generate_single;
use fresnel_gen::app::request::DEFAULT_MATERIALS;
use fresnel_gen::app::{Materials, Request, Source};
use fresnel_gen::materials::{self, Sight};
use fresnel_gen::report::card::card;
use fresnel_gen::report::markdown::{
    classes_table, errors_table, half_table, methods_table, targets_table,
};

fn example() -> String {
    let request = Request {
        targets: vec!["hlsl".to_owned()],
        methods: vec!["conductor_exact".to_owned()],
        materials: Materials::These(vec![Source::Named("gold".to_owned())]),
        ..Request::default()
    };
    let text = String::from_utf8(generate_single(&request).expect("it generates")).expect("text");
    format!("```hlsl\n{text}```\n")
}

/// The text with what stands between two marks replaced.
fn replaced(text: &str, name: &str, new: &str) -> String {
    let begin = text
        .find(&format!("<!-- BEGIN {name}"))
        .unwrap_or_else(|| panic!("no BEGIN {name}"));
    let start = begin + text[begin..].find('\n').expect("the mark ends its line") + 1;
    let end = start
        + text[start..]
            .find(&format!("<!-- END {name}"))
            .unwrap_or_else(|| panic!("no END {name}"));
    format!("{}{new}{}", &text[..start], &text[end..])
}

#[test]
fn tables_are_what_the_program_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let materials: Vec<_> = DEFAULT_MATERIALS
        .iter()
        .map(|name| {
            materials::find(name)
                .expect("it is there")
                .expect("it is good")
        })
        .collect();
    let mut text = fs::read_to_string(&path).expect("it is there");
    let parts = [
        ("example", example()),
        ("targets", targets_table()),
        ("methods", methods_table()),
        ("half", half_table()),
        ("classes", classes_table()),
        ("errors", errors_table(materials).expect("all are seen")),
    ];
    for (name, new) in parts {
        text = replaced(&text, name, &new);
    }
    super::bless::check(&path, text.as_bytes());
}

/// The shader that reads an atlas, with the function that it calls.
#[test]
fn lookups_are_accepted() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("it is there");
    let readme = read("README.md");
    let examples: Vec<&str> = readme.split("```wgsl\n").skip(1).collect();
    assert_eq!(examples.len(), 2);
    for after in examples {
        let (example, _) = after.split_once("```").expect("it ends");
        let text = read("shaders-generated/wgsl/fresnel_table.wgsl") + example;
        if let Err(fault) = fresnel_gen::emit::validate_wgsl(&text) {
            panic!("{fault}");
        }
    }
    let atlas: serde_json::Value =
        serde_json::from_str(&read("shaders-generated/lut/atlas.json")).expect("it is JSON");
    let rows = atlas["rows"].as_array().expect("it has rows").iter();
    let mut rows = rows.filter(|row| row["file"] == "lut/atlas.ktx2");
    let gold = rows.find(|row| row["name"] == "gold").expect("gold");
    let said = |key: &str| gold[key].as_f64();
    let keys = ["texels", "row", "rows", "scale"].map(said);
    assert_eq!(keys, [64.0, 1.0, 4.0, 1.0].map(Some));
    assert_eq!(gold["lookup"]["warp"], 4.0);
}

#[test]
fn the_picture_is_what_the_program_draws() {
    let gold = materials::find("gold")
        .expect("it is there")
        .expect("it is good");
    let command = "fresnel-gen materials show gold --svg gold.svg";
    let svg = card(&gold, None, &Sight::default(), command).expect("gold is known everywhere");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/figures/material-gold.svg");
    super::bless::check(&path, svg.as_bytes());
}

/// The nearest published work is named where methods are compared, and what our exact law costs beside it is the record's.
#[test]
fn published_work_is_cited_beside_our_own_figures() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).expect("README");
    let section = readme.split("\n## Speed against accuracy").nth(1);
    let section = section.and_then(|rest| rest.split("\n## ").next());
    let words: Vec<&str> = section.expect("a section").split_whitespace().collect();
    let section = words.join(" ");
    let record = fs::read_to_string(root.join("data/records/costs/rdna2.csv")).expect("a record");
    let units = |method: &str| {
        let start = format!("{method},,library,3,f32,");
        let row = record.lines().find(|line| line.starts_with(&start));
        row.and_then(|row| row.rsplit(',').next()).expect("a cost")
    };
    let costs = format!(
        "one of `dielectric_exact` takes {} units on RDNA 2, one of `schlick` {}.",
        units("dielectric_exact"),
        units("schlick")
    );
    for part in [
        "Vernooij, [A Fresnel Model for Coated Materials](https://doi.org/10.2312/egs.20241028)",
        "Imagire, [Reexamination of the Schlick Approximation with Graphics Hardware in the Early 2020s](",
        "Journal of Digital Games Research 17(1), 23–32, 2024",
        costs.as_str(),
    ] {
        assert!(section.contains(part), "README lacks: {part}");
    }
}
