//! The record of all numbers: whole, current, within what is promised, and met again by a sample.

use std::process::Command;

use super::subjects;
use crate::exhaustive::{Line, lines};
use fresnel_gen::generator::emit::{
    Bounds, CodeBound, EmittedFunction, Naming, fingerprint, specialised_function,
};
use fresnel_gen::generator::fit::Measured;
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::generator::request::DEFAULT_MATERIALS as MATERIALS;
use fresnel_gen::language::ir::Op;
use fresnel_gen::language::methods::{self, Class, Contract, Method};

fn emitted(method: &'static Method, subject: &MaterialInMedium) -> EmittedFunction {
    specialised_function(method, subject, &Naming::default(), &Bounds::recorded()).unwrap()
}

/// Every pair that there can be.
fn pairs() -> Vec<(EmittedFunction, &'static str)> {
    let subjects = subjects(&MATERIALS);
    let mut all = Vec::new();
    for method in methods::ALL.iter().filter(|method| !method.is_textured()) {
        for (subject, name) in subjects.iter().zip(MATERIALS) {
            if subject.is_described_by(method) {
                all.push((emitted(method, subject), name));
            }
        }
    }
    all
}

fn line(emitted: &EmittedFunction, material: &str) -> &'static Line {
    let name = emitted.method.name;
    let found = lines().find(|line| line.method == name && line.material == material);
    found.unwrap_or_else(|| panic!("{name} for {material} is not in the record"))
}

#[test]
fn it_is_whole_and_current_and_within_the_bounds() {
    for (emitted, material) in pairs() {
        let line = line(&emitted, material);
        let what = format!("{} for {material}: {} ulp", line.method, line.max_ulp);
        let current = fingerprint(&emitted.function);
        assert_eq!(line.fingerprint, current, "{what}: run tests/exhaustive");
        let is_kept = emitted.method.contract == Contract::Kept;
        // The numbers from 0 to 1, or all there are.
        let is_whole = [1_065_353_217, 1 << 32].contains(&line.points);
        assert!(!is_kept || is_whole, "{what}");
        // Vulkan's exp2 and log2 have a room of their own.
        let has_power = [Op::Exp2, Op::Log2]
            .iter()
            .any(|op| emitted.function.count(*op) > 0);
        if let (Measured::Yes(CodeBound::Ulp(bound)), false) = (&emitted.code, has_power) {
            assert!(line.max_ulp <= *bound, "{what}, {bound} promised");
        }
    }
}

/// The report's rows for these methods and materials; none without an adapter.
fn sampled(class: Class, materials: &[&str]) -> Option<Vec<serde_json::Value>> {
    let named = methods::ALL
        .iter()
        .filter(|method| method.class == class && !method.is_textured());
    let names: Vec<&str> = named.map(|method| method.name).collect();
    let empty = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_fresnel-gen"))
        .args([
            "verify", "--target", "wgsl", "--points", "5000", "--json", "-",
        ])
        .args([
            "--method",
            &names.join(","),
            "--material",
            &materials.join(","),
        ])
        .arg("--out-dir")
        .arg(empty.path())
        .output()
        .unwrap();
    if output.status.code() == Some(3) {
        return None;
    }
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    report["rows"].as_array().cloned()
}

#[test]
fn a_sample_meets_the_worst_of_all_numbers_and_nothing_worse() {
    let of_classes = [
        sampled(Class::Any, &MATERIALS),
        sampled(Class::Dielectric, &["diamond", "water"]),
        sampled(Class::Metal, &["gold", "platinum"]),
    ];
    let Some(rows) = of_classes.into_iter().collect::<Option<Vec<_>>>() else {
        return crate::not_checked("the record of all numbers: no adapter");
    };
    for (emitted, material) in pairs() {
        let line = line(&emitted, material);
        let is_it = |row: &&serde_json::Value| {
            row["form"] == "specialised"
                && row["method"] == line.method
                && row["material"] == material
        };
        let row = rows.iter().flatten().find(is_it).unwrap();
        if row["device"] != line.device {
            return crate::not_checked(&format!(
                "the record of all numbers: it is of {}",
                line.device
            ));
        }
        let error = &row["code_error"];
        let [ulp, abs] = ["max_ulp", "max_abs"].map(|key| error[key].as_f64().unwrap());
        let what = format!("{} for {material}: {ulp} ulp, {abs:e}", line.method);
        let apart = (ulp - line.max_ulp).abs();
        assert!(
            apart < 1e-6 * line.max_ulp.max(1.0),
            "{what}, recorded {}",
            line.max_ulp
        );
        assert!(
            abs <= line.max_abs * 1.000_001,
            "{what}, recorded {:e}",
            line.max_abs
        );
    }
}
