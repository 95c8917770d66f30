//! Where methods fail: the document is what a scan says, what keeps the contract keeps it, and what is known as worst gets no worse.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use serde::Deserialize;

use crate::physics::films::filmed;
use crate::tables::stability::stability_document;
use fresnel_gen::generator::reference::{Derivation, MaterialInMedium};
use fresnel_gen::lab::stability::{Cell, Failure, Map, StabilityRow, film_map, scan};
use fresnel_gen::language::methods::{self, Class, Contract, MediaSet, Method};
use fresnel_gen::physics::materials::ViewingConditions;
use fresnel_gen::physics::num::Precision;
use fresnel_gen::physics::records;

/// All methods scanned, once for all tests.
static ROWS: LazyLock<Vec<StabilityRow>> = LazyLock::new(|| scanned(Precision::F32));
/// In half precision those that are written in it.
static HALF: LazyLock<Vec<StabilityRow>> = LazyLock::new(|| scanned(Precision::F16));

fn scanned(precision: Precision) -> Vec<StabilityRow> {
    let is_written = |method: &&&'static Method| {
        let refused = precision.is_half() && method.half.library_refusal().is_some();
        !method.is_textured() && !refused && !method.keeps_inputs()
    };
    let mut rows = Vec::new();
    for method in methods::ALL.iter().filter(is_written) {
        let found = scan(method, precision, &mut |_, _| {});
        rows.extend(found.into_iter().map(|finding| StabilityRow {
            method,
            material: None,
            precision,
            finding: Some(finding),
        }));
    }
    rows
}

fn at(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

#[test]
fn the_document_is_what_the_scan_says() {
    super::bless::check(
        &at("docs/stability.md"),
        stability_document(&ROWS, &HALF).as_bytes(),
    );
}

#[test]
fn the_maps_of_the_document_are_what_is_drawn() {
    use fresnel_gen::lab::stability::maps;
    use fresnel_gen::pictures::png::png;
    use fresnel_gen::pictures::stability_map::heat_map;

    for (method, over) in [("schlick", "eta"), ("dielectric_textbook", "eta")] {
        let maps = maps(methods::find(method).unwrap(), Precision::F32);
        let map = maps.iter().find(|map| map.axis.name == over).unwrap();
        let picture = png(&heat_map(method, map), 1.0).unwrap();
        super::bless::check(&at(&format!("docs/{method}_{over}.png")), &picture);
    }
}

/// The maps of films in `docs/films.md`: the method, the material and its film, and the picture.
const FILM_MAPS: [(&str, &str, &str, &str); 3] = [
    (
        "iridescence_khr",
        "titanium_dioxide:400nm",
        "titanium",
        "film_map_titanium",
    ),
    ("iridescence_khr", "1.38:400nm", "bk7", "film_map_glass"),
    (
        "film_spectral_six",
        "titanium_dioxide:400nm",
        "titanium",
        "film_map_six",
    ),
];

fn film_maps() -> [Map; 3] {
    FILM_MAPS.map(|(method, film, base, _)| {
        let material = filmed(film, base);
        let typed = (material.name.clone(), material);
        let viewing = ViewingConditions::default();
        let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default()).unwrap();
        film_map(methods::find(method).unwrap(), &subject, Precision::F32).unwrap()
    })
}

/// KHR_materials_iridescence has one real index for a metal, so it is wrong there at nearly every thickness, and beyond 1 near grazing.
/// On glass it leaves the law where Schlick's approximation does. The sum over six wavelengths is a reflectance everywhere.
#[test]
fn maps_over_thickness_show_where_films_fail() {
    use fresnel_gen::physics::num::statistics::quantile;
    let [on_titanium, on_glass, six] = film_maps();
    let errors = |map: &Map, degrees: [usize; 2]| -> Vec<f64> {
        let is_there = |(i, _): &(usize, &Cell)| (degrees[0]..=degrees[1]).contains(&(i % 91));
        let cells = map.cells.iter().enumerate().filter(is_there);
        cells.map(|(_, cell)| cell.error).collect()
    };
    let most = |map: &Map, degrees| errors(map, degrees).into_iter().fold(0.0, f64::max);
    assert!(quantile(&errors(&on_titanium, [0, 60]), 0.5) > 0.1);
    let broken = |map: &Map| -> Vec<usize> {
        let cells = map.cells.iter().enumerate();
        cells
            .filter(|(_, cell)| cell.is_broken)
            .map(|(i, _)| i % 91)
            .collect()
    };
    let beyond = broken(&on_titanium);
    assert!(
        beyond.len() > 50 && beyond.iter().all(|degree| *degree > 70),
        "{beyond:?}"
    );
    let (head_on, grazing) = (most(&on_glass, [0, 0]), most(&on_glass, [75, 85]));
    println!("on glass {head_on:.4} head-on, {grazing:.4} from 75 to 85 degrees");
    assert!(
        head_on < 0.005 && (0.05..0.1).contains(&grazing),
        "{head_on} {grazing}"
    );
    let (whole, bare) = (
        most(&six, [0, 85]),
        six.cells[..86].iter().map(|cell| cell.error),
    );
    let bare = bare.fold(0.0, f64::max);
    println!("six wavelengths {whole:.4}, without a film {bare:.4}");
    assert!(broken(&six).is_empty());
    assert!(whole < 0.1 && bare < 0.01, "{whole} {bare}");
}

#[test]
fn the_maps_of_films_are_what_is_drawn() {
    use fresnel_gen::pictures::png::png;
    use fresnel_gen::pictures::stability_map::heat_map;
    for (map, (method, .., file)) in film_maps().iter().zip(FILM_MAPS) {
        let picture = png(&heat_map(method, map), 1.0).unwrap();
        super::bless::check(&at(&format!("docs/{file}.png")), &picture);
    }
}

fn fails(rows: &[StabilityRow], method: &str, failure: Failure) -> bool {
    let of = |row: &&StabilityRow| row.method.name == method;
    let mut findings = rows
        .iter()
        .filter(of)
        .filter_map(|row| row.finding.as_ref());
    findings.any(|finding| finding.failure == failure && finding.is_media)
}

/// What is no reflectance at all.
const BROKEN: [Failure; 4] = [
    Failure::NotANumber,
    Failure::Infinite,
    Failure::Negative,
    Failure::AboveOne,
];

#[test]
fn what_keeps_the_contract_is_a_reflectance_everywhere() {
    let kept = methods::ALL
        .iter()
        .filter(|method| method.contract == Contract::Kept);
    for method in kept {
        for failure in BROKEN {
            let what = failure.words();
            assert!(
                !fails(&ROWS, method.name, failure),
                "{}: {what}",
                method.name
            );
        }
    }
}

/// Half precision overflows far beyond any medium: it says for which media it is meant.
#[test]
fn half_precision_is_a_reflectance_for_the_media_that_it_is_meant_for() {
    let findings = HALF
        .iter()
        .filter_map(|row| Some((row.method.name, row.finding.as_ref()?)));
    for (method, finding) in
        findings.filter(|(_, finding)| finding.is_media && BROKEN.contains(&finding.failure))
    {
        let of = |name: &str| finding.worst.iter().find(|(of, _)| *of == name);
        let value = |name: &str| of(name).map_or(0.0, |(_, value)| *value);
        let n = value("n").max(value("eta"));
        let what = format!(
            "{method}: {} where {}",
            finding.failure.words(),
            finding.region
        );
        assert!(!MediaSet::Half.holds(n, value("k")), "{what}");
    }
}

/// The other direction: the scan sees what textbooks do.
#[test]
fn what_fails_is_seen() {
    for (method, failure) in [
        ("dielectric_textbook", Failure::NotANumber),
        ("dielectric_textbook", Failure::Digits(1000.0)),
        ("conductor_textbook", Failure::NotANumber),
        ("conductor_textbook", Failure::Negative),
        ("conductor_textbook", Failure::AboveOne),
        ("conductor_textbook", Failure::Digits(1000.0)),
        ("schlick", Failure::Error(0.2)),
        ("schlick", Failure::Minimum),
        ("schlick", Failure::Monotony),
    ] {
        assert!(
            fails(&ROWS, method, failure),
            "{method}: no {}",
            failure.words()
        );
    }
    // The exact laws fail nowhere as formulas, but for the one that is for metals alone.
    for method in methods::ALL
        .iter()
        .filter(|method| method.name.contains("_exact"))
    {
        assert_eq!(
            fails(&ROWS, method.name, Failure::Error(0.01)),
            method.class == Class::Metal,
            "{}",
            method.name
        );
    }
}

/// Inputs at which rounding was found worst. With `BLESS=1` those of today's scan are added; none is removed.
#[test]
fn the_worst_inputs_known_get_no_worse() {
    let path = at("data/worst-cases/stability.csv");
    let known = fs::read_to_string(&path).unwrap_or_default();
    let mut known: Vec<WorstInput> = records::rows(&known);
    for row in &known {
        check_known(row);
    }
    for found in ROWS.iter().filter_map(worst_input) {
        if !known.contains(&found) {
            known.push(found);
        }
    }
    let mut rows: Vec<[String; 5]> = known.iter().map(WorstInput::cells).collect();
    rows.sort();
    let text = ABOUT.to_owned() + &super::records::text(HEAD, &rows);
    super::bless::check(&path, text.as_bytes());
}

const ABOUT: &str = "\
# The worst input of each region in which a method's rounding fails, for media n + ik (k = 0 where the scan was over eta):
# `fresnel-gen stability`, unfused f32. Lines are added, never removed.
";

/// The columns of the record.
const HEAD: [&str; 5] = ["method", "failure", "n", "k", "cos_theta"];

/// A row of the record.
#[derive(Debug, PartialEq, Deserialize)]
struct WorstInput {
    method: String,
    failure: String,
    n: f64,
    k: f64,
    cos_theta: f64,
}

impl WorstInput {
    fn cells(&self) -> [String; 5] {
        let [n, k, cos_theta] = [self.n, self.k, self.cos_theta].map(|value| format!("{value:e}"));
        [self.method.clone(), self.failure.clone(), n, k, cos_theta]
    }
}

/// The worst input of a failure of rounding over media.
fn worst_input(row: &StabilityRow) -> Option<WorstInput> {
    let finding = row.finding.as_ref()?;
    if !finding.is_media || finding.failure.is_of_the_model() {
        return None;
    }
    let worst = |name: &str| {
        let mut inputs = finding.worst.iter();
        inputs.find(|(of, _)| *of == name).map(|(_, value)| *value)
    };
    Some(WorstInput {
        method: row.method.name.to_owned(),
        failure: finding.failure.words().to_string(),
        n: worst("n").or(worst("eta"))?,
        k: worst("k").unwrap_or(0.0),
        cos_theta: worst("cos_theta")?,
    })
}

/// What was known to fail may be mended; what keeps the contract stays a reflectance there.
fn check_known(row: &WorstInput) {
    use fresnel_gen::generator::fit::values;
    use fresnel_gen::generator::reference::Derivation;
    use fresnel_gen::language::ir::{Value, evaluate};
    use fresnel_gen::physics::materials::Channels;
    let method = methods::find(&row.method).unwrap();
    let (n, k, cos_theta) = (row.n, row.k, row.cos_theta);
    if method.contract != Contract::Kept || method.class == Class::Dielectric && k > 0.0 {
        return;
    }
    let values = values(
        method,
        &Channels {
            n: [n; 3],
            k: [k; 3],
        },
        &Derivation::default(),
    );
    let mut arguments = vec![Value::each(vec![cos_theta as f32])];
    arguments.extend(method.arguments(&values, None));
    let [got, _, _] = evaluate::<f32>(&method.function(false).unwrap(), &arguments).at(0);
    assert!((0.0..=1.0).contains(&got), "{row:?}: {got}");
}
