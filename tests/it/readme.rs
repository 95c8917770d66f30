//! The tables, examples and pictures of README and of `docs/` are what the program says today; `BLESS=1` rewrites them. Their
//! Rust is compiled by rustdoc, and their links lead somewhere.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::headline::headline;
use super::stated::check_stated;
use super::stated::stated;
use crate::tables::markdown::{
    classes_table, effects_table, errors_table, flavours_table, half_table, methods_table,
    targets_table,
};
use fresnel_gen::generator::generate::generate_single;
use fresnel_gen::generator::request::{DEFAULT_MATERIALS, Materials, Methods, Request, Source};
use fresnel_gen::lab::cost::records;
use fresnel_gen::language::methods::{self, Method};
use fresnel_gen::language::targets::Target;
use fresnel_gen::physics::materials::{self, ViewingConditions};
use fresnel_gen::pictures::material_sheet::material_sheet;

fn example() -> String {
    let request = Request {
        targets: vec![Target::HLSL],
        methods: Methods::These(vec![Method::FITTED]),
        materials: Materials::These(vec![Source::Named("gold".to_owned())]),
        ..Request::default()
    };
    let text = String::from_utf8(generate_single(&request).expect("it generates")).expect("text");
    format!("```hlsl\n{text}```\n")
}

/// The examples that `tests/pipelines` holds, which the page of builds shows.
fn builds() -> [(&'static str, String); 5] {
    let shown = |language: &str, file: &str| {
        let text = page(&format!("tests/pipelines/{file}"));
        let text = text.lines().filter(|line| !line.starts_with("//!"));
        let text: String = text.map(|line| line.to_owned() + "\n").collect();
        format!("```{language}\n{}```\n", text.trim_start_matches('\n'))
    };
    [
        ("cmake", shown("cmake", "cmake/CMakeLists.txt")),
        ("ninja", shown("ninja", "ninja/build.ninja")),
        ("make", shown("make", "make/Makefile")),
        ("npm", shown("json", "npm/package.json")),
        ("cargo", shown("rust,no_run", "cargo/src/build.rs")),
    ]
}

/// The text with what stands between two marks replaced.
pub fn replaced(text: &str, name: &str, new: &str) -> String {
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

/// A page of the documents, by its path in the repository.
pub fn page(path: &str) -> String {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&whole).unwrap_or_else(|why| panic!("{path}: {why}"))
}

/// README and all pages of `docs/`.
pub fn pages() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let names = fs::read_dir(folder).expect("docs").flatten();
    let names = names.map(|entry| format!("docs/{}", entry.file_name().to_string_lossy()));
    let mut pages: Vec<String> = names.filter(|name| name.ends_with(".md")).collect();
    pages.push("README.md".to_owned());
    pages.sort();
    pages
}

#[test]
fn tables_are_what_the_program_says() {
    let materials: Vec<_> = DEFAULT_MATERIALS
        .iter()
        .map(|name| {
            materials::find(name)
                .expect("it is there")
                .expect("it is good")
        })
        .collect();
    let errors = errors_table(materials).expect("all are seen");
    let parts = [
        ("README.md", vec![("example", example())]),
        (
            "docs/shaders.md",
            vec![
                ("scalar", methods_without_scalar_form()),
                ("targets", targets_table()),
            ],
        ),
        (
            "docs/methods.md",
            vec![
                ("methods", methods_table()),
                ("errors", errors),
                ("classes", classes_table()),
            ],
        ),
        (
            "docs/accuracy-and-cost.md",
            vec![("published", super::published_costs::published_table())],
        ),
        ("docs/half-precision.md", vec![("half", half_table())]),
        ("docs/effects.md", vec![("effects", effects_table())]),
        ("docs/engines.md", vec![("flavours", flavours_table())]),
        ("docs/builds.md", builds().to_vec()),
    ];
    for (path, parts) in parts {
        let text = parts
            .into_iter()
            .fold(page(path), |text, (name, new)| replaced(&text, name, &new));
        let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        super::bless::check(&whole, text.as_bytes());
    }
}

/// The methods whose functions have no form of single floats, as a sentence.
fn methods_without_scalar_form() -> String {
    let names = methods::ALL
        .iter()
        .filter(|method| !method.has_scalar_form());
    let names: Vec<String> = names.map(|method| format!("`{}`", method.name)).collect();
    format!("These have three channels only: {}.\n", names.join(", "))
}

/// Counts in the pages' own sentences.
#[test]
fn counts_are_those_of_the_catalogue() {
    let all = materials::names();
    let found = all.iter().filter_map(|name| materials::find(name)?.ok());
    let spectra = found.filter(|material| material.rgb_nm.is_none()).count();
    let catalogue: serde_json::Value =
        serde_json::from_str(&page("data/records/catalogue.json")).expect("it is JSON");
    let rows = catalogue["rows"].as_array().map_or(0, Vec::len);
    let sample = super::samples::shapes();
    let substances = sample.iter().map(|subject| &subject.material.substance);
    let substances = substances.collect::<BTreeSet<_>>().len();
    let (materials, methods) = ("docs/materials.md", "docs/methods.md");
    check_stated(vec![
        stated("README.md", "**", " spectra of n and k** are", spectra),
        stated(materials, "\n", " spectra of n and k come along", spectra),
        stated(materials, "The catalogue has ", " spectra: ", spectra),
        stated(materials, "`catalogue.*` has ", ": ", rows),
        stated(materials, "(*the sample*: ", " measurements", sample.len()),
        stated(
            "docs/shaders.md",
            "fitted coefficients of ",
            " materials as",
            rows,
        ),
        stated("docs/shaders.md", "gl.RGBA32F, 4, ", ", 0, gl.RGBA", rows),
        stated(methods, "*the sample*, ", " measurements of ", sample.len()),
        stated(
            methods,
            " measurements of ",
            " metals and semiconductors",
            substances,
        ),
    ]);
}

/// README is read in one sitting.
#[test]
fn readme_is_short() {
    let lines = page("README.md").lines().count();
    assert!(
        lines <= 220,
        "{lines} lines; move what is not for the first hour into docs/"
    );
}

/// Links between pages lead to a file, and to a heading of it.
#[test]
fn links_lead_somewhere() {
    for path in pages() {
        let folder = Path::new(&path).parent().expect("a folder");
        for after in page(&path).split("](").skip(1) {
            let link = after.split(')').next().unwrap_or_default();
            if link.contains("://") {
                continue;
            }
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = folder.join(file);
            let target = target.to_string_lossy();
            let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(&*target);
            assert!(whole.exists(), "{path}: there is no {link}");
            let slug = |line: &str| {
                let words = line.trim_start_matches('#').trim().to_lowercase();
                let kept = words
                    .chars()
                    .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
                kept.collect::<String>().replace(' ', "-")
            };
            let has = |text: String| {
                text.lines()
                    .any(|line| line.starts_with('#') && slug(line) == heading)
            };
            assert!(
                heading.is_empty() || has(page(&target)),
                "{path}: there is no {link}"
            );
        }
    }
}

/// The pages' shaders in WGSL, with the functions that they call; and the atlas that one of them reads.
#[test]
fn lookups_are_accepted() {
    let mut shown = 0;
    for path in pages() {
        for after in page(&path).split("```wgsl\n").skip(1) {
            let (example, _) = after.split_once("```").expect("it ends");
            if example.contains("f16>") {
                // `compilers` has it, below functions in half precision.
                continue;
            }
            let library = [
                "fresnel_table",
                "fresnel_fitted",
                "fresnel_schlick",
                "effects/coat",
                "effects/image_light",
                "fresnel_fitted_dielectric",
                "catalogue",
            ]
            .map(|file| page(&format!("shaders-generated/wgsl/{file}.wgsl")));
            if let Err(fault) =
                fresnel_gen::generator::emit::validate_wgsl(&(library.concat() + example))
            {
                panic!("{path}: {fault}");
            }
            shown += 1;
        }
    }
    assert_eq!(shown, 5);
    let atlas: serde_json::Value =
        serde_json::from_str(&page("shaders-generated/lut/atlas.json")).expect("it is JSON");
    let rows = atlas["rows"].as_array().expect("it has rows").iter();
    let mut rows = rows.filter(|row| row["file"] == "lut/atlas.ktx2");
    let gold = rows.find(|row| row["name"] == "gold").expect("gold");
    let said = |key: &str| gold[key].as_f64();
    let keys = ["texels", "row", "rows", "scale"].map(said);
    assert_eq!(keys, [64.0, 1.0, 4.0, 1.0].map(Some));
    assert_eq!(gold["lookup"]["warp"], 4.0);
}

#[test]
fn the_headline_is_what_the_program_draws() {
    let svg = headline("Under a sky, with more materials: fresnel-gen compare platinum gold:coat");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/headline.svg");
    super::bless::check(&path, svg.as_bytes());
}

#[test]
fn the_picture_is_what_the_program_draws() {
    let gold = materials::find("gold")
        .expect("it is there")
        .expect("it is good");
    let command = "fresnel-gen materials show gold --svg gold.svg";
    let svg = material_sheet(&gold, None, &ViewingConditions::default(), command)
        .expect("gold is known everywhere");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/figures/material-gold.svg");
    super::bless::check(&path, svg.as_bytes());
}

/// The nearest published work is named where methods are compared, and what our exact law costs beside it is the record's.
#[test]
fn published_work_is_cited_beside_our_own_figures() {
    let text = page("docs/accuracy-and-cost.md");
    let words: Vec<&str> = text.split_whitespace().collect();
    let section = words.join(" ");
    let record = records("rdna2");
    let units = |method: &str| {
        record
            .library(methods::find(method).unwrap())
            .expect("a cost")
            .cost()
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
        assert!(
            section.contains(part),
            "docs/accuracy-and-cost.md lacks: {part}"
        );
    }
}
