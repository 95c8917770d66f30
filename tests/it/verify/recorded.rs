//! The record of exhaustive runs: every f32 from 0 to 1 through WGSL. A sampled run must not exceed it, and at the worst
//! input it must come again.

use fresnel_gen::emit::{Bounds, Naming, fingerprint, specialised_function};
use fresnel_gen::methods;
use fresnel_gen::verify::code_error;

use super::subjects;

static RECORD: &str = include_str!("../../../data/records/exhaustive.csv");

/// A line: method, material, fingerprint, points, max_ulp, max_abs, worst_cos, device.
struct Line<'a> {
    method: &'a str,
    material: &'a str,
    fingerprint: &'a str,
    numbers: [f64; 4],
}

fn lines() -> Vec<Line<'static>> {
    let line = |text: &'static str| {
        let cells: Vec<&str> = text.splitn(8, ',').collect();
        let number = |i: usize| cells[i].parse().unwrap();
        Line {
            method: cells[0],
            material: cells[1],
            fingerprint: cells[2],
            numbers: [number(3), number(4), number(5), number(6)],
        }
    };
    let rows = RECORD.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(line).collect()
}

#[test]
fn a_sample_does_not_exceed_what_all_numbers_gave() {
    let subjects = subjects(&["gold", "platinum", "water", "diamond"]);
    for line in lines() {
        let [points, max_ulp, max_abs, _] = line.numbers;
        assert_eq!(points, 1_065_353_217.0);
        let subject = subjects
            .iter()
            .find(|subject| subject.name == line.material)
            .unwrap();
        let method = methods::find(line.method).unwrap();
        let emitted =
            specialised_function(method, subject, &Naming::default(), &Bounds::recorded()).unwrap();
        let what = format!("{} for {}", line.method, line.material);
        assert_eq!(
            line.fingerprint,
            fingerprint(&emitted.function),
            "{what}: run tests/exhaustive again"
        );
        // Unfused f32 here; where a power goes through the platform's exp2 its last bits are the device's own.
        let sampled = code_error(&emitted.function, 20_000);
        let own_powers = emitted.function.count(fresnel_gen::ir::Op::Exp2) > 0;
        if !own_powers && method.contract == methods::Contract::Kept {
            assert!(
                sampled.max_ulp <= max_ulp.max(3.2),
                "{what}: {} ulp",
                sampled.max_ulp
            );
            assert!(
                sampled.max_abs <= max_abs * 1.000_001,
                "{what}: {}",
                sampled.max_abs
            );
        }
        if let Some(bound) = emitted.code_ulp.value() {
            assert!(
                max_ulp <= *bound || own_powers,
                "{what}: {max_ulp} ulp at all numbers, {bound} promised"
            );
        }
    }
}
