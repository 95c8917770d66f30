//! `cost` as users run it: names that are not there, compilers that are not there, records in their place.

use std::collections::BTreeMap;

use serde_json::Value;

use super::Place;
use super::Ran;
use crate::not_checked;

const KEYS: [&str; 18] = [
    "method",
    "material",
    "form",
    "channels",
    "precision",
    "gpu",
    "compiler",
    "instructions",
    "latency",
    "inverse_throughput",
    "registers",
    "fetches",
    "net_instructions",
    "net_inverse_throughput",
    "share",
    "shader",
    "constants",
    "from",
];

fn rows(place: &Place, line: &str) -> Vec<Value> {
    read(&place.done(&format!("{line} --json -")))
}

fn read(ran: &Ran) -> Vec<Value> {
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    report["rows"].as_array().unwrap().clone()
}

/// A run where the loader of Vulkan finds no driver: it is told to look in a file that is not there.
fn without_driver(place: &Place, line: &str) -> Ran {
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut command = place.command(&words);
    command
        .env("VK_DRIVER_FILES", "nowhere")
        .env("VK_ICD_FILENAMES", "nowhere");
    Ran::new(line.to_owned(), command.output().unwrap())
}

#[test]
fn names_that_are_not_there_are_refused_with_those_that_are() {
    let place = Place::new();
    place.refused("cost --gpu rdna", &["GPU family", "rdna2", "adreno330"]);
    place.refused("cost --method schlik", &["schlick"]);
    place.refused("cost --material golt", &["gold"]);
    place.refused("cost --precision f64", &["f32", "f16"]);
}

#[test]
fn operations_are_always_there_and_powervr_never() {
    let place = Place::new();
    let line = "cost --gpu operations,powervr --method schlick,table --material gold";
    let rows = rows(&place, line);
    for row in &rows {
        for key in KEYS {
            assert!(row.get(key).is_some(), "{key}: {row}");
        }
    }
    let (counted, unknown): (Vec<_>, Vec<_>) =
        rows.iter().partition(|row| row["gpu"] == "operations");
    assert!(
        counted
            .iter()
            .all(|row| row["from"] == "graph" && row["instructions"].is_number())
    );
    assert!(
        unknown
            .iter()
            .all(|row| row["instructions"].is_null() && row["reason"].is_string())
    );
    let table = counted.iter().find(|row| row["method"] == "table").unwrap();
    assert_eq!(table["fetches"], 1);
    // The reference was not asked for, and shares are there all the same.
    assert!(counted.iter().all(|row| row["share"].is_number()));
    place.done(&format!("{line} --require-all"));
}

#[test]
fn where_a_compiler_is_absent_the_record_serves_if_it_is_of_the_same_shader() {
    let place = Place::new();
    let line =
        "cost --gpu rdna2 --method schlick,conductor_exact --material gold,copper --precision f32";
    let rows = read(&without_driver(&place, &format!("{line} --json -")).ends(0));
    let (known, unknown): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row["from"] == "record");
    assert!(
        known
            .iter()
            .all(|row| row["net_inverse_throughput"].as_f64().unwrap() > 0.0)
    );
    // Schlick's has a second form, for three channels and for one.
    assert_eq!((known.len(), unknown.len()), (7, 2), "{rows:#?}");
    for row in &unknown {
        assert_eq!(row["material"], "copper");
        assert!(
            row["reason"].as_str().unwrap().contains("not measured"),
            "{row}"
        );
    }
    for (flags, code) in [
        ("--require-all", 3),
        // Nothing was held against the record: that is no pass.
        ("--check", 3),
        ("--check --require-all", 3),
    ] {
        without_driver(&place, &format!("{line} {flags}")).ends(code);
    }
}

/// The record answers for its own shaders whether a compiler is here or not; `--check` asks about them too.
#[test]
fn what_is_recorded_is_not_asked_again() {
    let place = Place::new();
    let line =
        "cost --gpu rdna2,adreno330 --method schlick,conductor_exact --material gold --json -";
    let ran = place.run(line).ends(0);
    assert!(read(&ran).iter().all(|row| row["from"] == "record"));
    assert_eq!(without_driver(&place, line).ends(0).out, ran.out);
    let line = "cost --gpu rdna2 --method conductor_exact --material copper,gold --precision f32";
    let from = |flags: &str| {
        let ran = place.run(&format!("{line} {flags} --json -"));
        let all = read(&ran).into_iter();
        all.map(|row| row["from"].as_str().map(str::to_owned))
            .collect::<Vec<_>>()
    };
    let [record, compiler] = ["record", "compiler"].map(|from| Some(from.to_owned()));
    if from("--check").contains(&None) {
        return not_checked("costs by the compiler of AMD's cards: it is not here");
    }
    assert!(from("--check").iter().all(|from| *from == compiler));
    let usual = from("");
    assert_eq!(usual.iter().filter(|from| **from == compiler).count(), 1);
    assert!(
        usual
            .iter()
            .all(|from| *from == record || *from == compiler)
    );
}

#[test]
fn what_is_counted_today_is_what_was_recorded() {
    let place = Place::new();
    let line = "cost --gpu gcn4,rdna1,rdna2,rdna3 --method schlick,conductor_exact,table --check";
    let ran = place.run(line);
    if ran.code == Some(3) {
        return not_checked("costs by the compiler of AMD's cards: it is not here");
    }
    let said = ran.ends(0).out;
    assert!(
        said.lines()
            .all(|line| line.contains("0 differ") || line.contains("not checked")),
        "{said}"
    );
    assert_eq!(said, place.done(line).out);
}

/// R by a cheaper method makes its functions cheaper, and leaves the others as they are recorded.
#[test]
fn functions_of_effects_are_counted_with_r_by_any_method() {
    let place = Place::new();
    let costs = |flags: &str| {
        let rows = rows(&place, &format!("cost --gpu operations {flags}"));
        let cost = |row: &Value| {
            let name = row["effect"].as_str().unwrap().to_owned();
            let channels = row["channels"].as_u64().unwrap();
            ((name, channels), row["net_instructions"].as_f64().unwrap())
        };
        rows.iter().map(cost).collect::<BTreeMap<_, _>>()
    };
    let all = costs("--effect all");
    let interface = costs("--effect interface --method schlick");
    let reflectance = ("interface_reflectance".to_owned(), 3);
    assert!(interface[&reflectance] < 0.6 * all[&reflectance]);
    assert!(!interface.contains_key(&("refracted".to_owned(), 3)));
    assert!(all.contains_key(&("refracted".to_owned(), 3)));
    let textured = "cost --gpu operations --effect interface --method table";
    assert!(place.run(textured).ends(2).err.contains("reads a texture"));
    let without_r = "cost --gpu operations --effect water --method schlick";
    assert!(place.run(without_r).ends(2).err.contains("asks for R"));
    let of_material = "cost --gpu operations --effect interface --material gold";
    place.run(of_material).ends(2);
}

#[test]
fn a_page_is_written_whole() {
    let place = Place::new();
    place.done("cost --gpu operations,rdna2 --method schlick --out-dir costs");
    let page = place.read("costs/cost.html");
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    assert!(page.contains("RDNA 2") && page.contains("schlick"));
}
