//! What a user's function is compared with, and what is judged of it: channels, branches, numbers of a material, limits of errors.

use serde_json::Value;

use super::audit;
use super::published;
use super::rows;
use crate::cli::Place;

/// The row of a published formula, where its compilers are here.
#[track_caller]
fn row(line: &str) -> Option<Value> {
    let place = published::place();
    let ran = audit(&place, &format!("{line} --json -"))?;
    Some(rows(&ran.ends(0)).remove(0))
}

/// Whether its cost is known; a compiler may be missing.
fn is_counted(row: &Value) -> bool {
    let known = row["cost"][0]["net"].is_number();
    if !known {
        crate::not_checked(&format!("a cost: {}", row["cost"][0]["reason"]));
    }
    known
}

#[test]
fn the_cost_of_branches_is_not_compared() {
    let line = "dielectric.glsl --function dielectric_branch --material water --gpu rdna2";
    if let Some(row) = row(line) {
        assert_eq!(row["is_cost_comparable"], false, "{row}");
        let why = row["cost_remark"].as_str().unwrap();
        assert!(why.contains("it branches (`if` in line 10)"), "{why}");
        assert_eq!(row["dominated_by"], Value::Array(Vec::new()));
        assert_eq!(row["better_with_more_inputs"], Value::Array(Vec::new()));
        if is_counted(&row) {
            assert_eq!(row["says"]["rdna2"], why);
        }
    }
    let line = "dielectric.glsl --function dielectric_choice --material water --gpu rdna2";
    if let Some(row) = row(line) {
        assert_eq!(row["is_cost_comparable"], true, "{row}");
        assert!(row["cost_remark"].is_null(), "{row}");
        if is_counted(&row) {
            let says = row["says"]["rdna2"].as_str().unwrap();
            assert!(!says.contains("not compared"), "{says}");
        }
    }
}

/// Neither may win by its cost: a branch hides what code costs.
#[test]
fn a_branch_keeps_a_bad_function_from_being_dominated() {
    let place = Place::new();
    let body = |guard: &str| {
        format!(
            "vec3 f(float c, vec3 n, vec3 k) {{ {guard} vec3 x = n; for_ return x / (x + k + c); }}"
        )
        .replace(
            "for_",
            &"x = sqrt(x * x + k * c); x = x / (1.0 + x);".repeat(8),
        )
    };
    place.put("plain.glsl", body(""));
    place.put("branch.glsl", body("if (c < 0.0) return vec3(0.0);"));
    for (file, is_compared) in [("plain.glsl", true), ("branch.glsl", false)] {
        let line = format!("{file} --material platinum --gpu rdna2 --json -");
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        let row = rows(&ran).remove(0);
        if is_counted(&row) {
            let dominated = row["dominated_by"].as_array().unwrap();
            assert_eq!(!dominated.is_empty(), is_compared, "{row}");
        }
    }
}

#[test]
fn one_channel_is_counted_once_and_compared_with_one_channel() {
    let net = |function: &str| {
        let line = format!("schlick.glsl --function {function} --material platinum --gpu rdna2");
        let row = row(&line)?;
        is_counted(&row).then_some(row)
    };
    let (Some(one), Some(three)) = (net("schlick_scalar"), net("schlick")) else {
        return;
    };
    assert_eq!(
        (&one["channels"], &three["channels"]),
        (&1.into(), &3.into())
    );
    let cost = |row: &Value| row["cost"][0]["net"].as_f64().unwrap();
    assert!(cost(&one) < cost(&three), "{one}: {three}");
    for (row, form) in [(&one, "scalar"), (&three, "library")] {
        let lists = ["dominated_by", "better_with_more_inputs"];
        let mut all = lists.iter().flat_map(|key| row[key].as_array().unwrap());
        assert!(all.all(|other| other["form"] == form), "{row}");
    }
    // Fitted methods have a form of one channel, and take more numbers.
    assert!(
        !one["better_with_more_inputs"]
            .as_array()
            .unwrap()
            .is_empty(),
        "{one}"
    );
}

#[test]
fn numbers_of_a_material_are_counted() {
    for (file, function, material, numbers) in [
        ("schlick.glsl", "schlick", "gold", 3),
        ("schlick.glsl", "schlick_f90", "gold", 4),
        ("schlick.glsl", "schlick_scalar", "gold", 3),
        ("f82_tint.glsl", "f82_tint_folded", "gold", 6),
        ("dielectric.glsl", "dielectric_choice", "water", 3),
        ("conductor.glsl", "conductor", "gold", 6),
    ] {
        let line = format!("{file} --function {function} --material {material} --gpu none");
        if let Some(row) = row(&line) {
            assert_eq!(row["input_numbers"], numbers, "{row}");
        }
    }
}

/// Four fitted coefficients are better than F0 and a tint, and take twelve numbers: they dominate nothing, and are named.
#[test]
fn what_takes_more_numbers_dominates_nothing() {
    let line = "f82_tint.glsl --function f82_tint_folded --material platinum --gpu rdna2";
    let Some(plain) = row(line).filter(is_counted) else {
        return;
    };
    let all = |row: &Value, key: &str| row[key].as_array().unwrap().clone();
    let numbers = |other: &Value| other["input_numbers"].as_u64().unwrap();
    let says = |row: &Value| row["says"]["rdna2"].as_str().unwrap().to_owned();
    let dominated = all(&plain, "dominated_by");
    assert!(dominated.iter().all(|other| numbers(other) <= 6), "{plain}");
    let more = all(&plain, "better_with_more_inputs");
    let is_fitted = |other: &Value| other["method"] == "fitted" && numbers(other) == 12;
    assert!(more.iter().any(is_fitted), "{plain}");
    assert!(says(&plain).contains("inputs instead of 6"), "{plain}");
    let few = row(&format!("{line} --max-inputs 6")).unwrap();
    assert_eq!(all(&few, "better_with_more_inputs"), [] as [Value; 0]);
    assert!(!says(&few).contains("inputs instead of 6"), "{few}");
}

#[test]
fn an_error_is_judged_where_a_limit_is_given() {
    let place = published::place();
    let line = "schlick.glsl --function schlick --material platinum --gpu none";
    let Some(ran) = audit(&place, line) else {
        return;
    };
    let ran = ran.ends(0);
    assert!(
        ran.out.contains("its error is not judged (--max-error"),
        "{ran:?}"
    );
    assert!(!ran.out.contains("pass"), "{ran:?}");
    for (limit, code, says) in [
        (
            "0.17",
            1,
            "fail: compilers accept it; all results are reflectances; its error is above 0.17",
        ),
        ("0.18", 0, "its error is at most 0.18"),
    ] {
        let ran = place
            .run(&format!("audit {line} --max-error {limit}"))
            .ends(code);
        assert!(ran.out.contains(says), "{ran:?}");
        let ran = place.run(&format!("audit {line} --max-error {limit} --json -"));
        let row = rows(&ran.ends(code)).remove(0);
        assert_eq!(row["checked"]["within_max_error"], code == 0, "{row}");
        assert_eq!(row["status"], if code == 0 { "pass" } else { "fail" });
    }
    let ran = place.run(&format!("audit {line} --max-error 0.1")).ends(1);
    let says = "schlick.glsl: schlick: its error for platinum is 0.1731";
    assert!(ran.err.contains(says), "{ran:?}");
    for wrong in ["2", "-1", "nan"] {
        place.refused(
            &format!("audit {line} --max-error={wrong}"),
            &["--max-error is"],
        );
    }
}

/// A material that has no value for an argument has no row; where none has one, the run ends with 2.
#[test]
fn materials_without_a_value_are_named_and_left_out() {
    let place = published::place();
    let line = "dielectric.glsl --function dielectric_choice --gpu none";
    let Some(ran) = audit(
        &place,
        &format!("{line} --material gold,water,bk7 --json -"),
    ) else {
        return;
    };
    let ran = ran.ends(0);
    let found = rows(&ran);
    let mut materials: Vec<&str> = found
        .iter()
        .map(|row| row["material"].as_str().unwrap())
        .collect();
    materials.sort_unstable();
    assert_eq!(materials, ["bk7", "water"]);
    let says =
        "not audited: dielectric.glsl:20:7: `dielectric_choice`: gold has no value for `ior` (eta)";
    assert!(ran.err.contains(says), "{ran:?}");
    place.refused(
        &format!("audit {line} --material gold,silver"),
        &["gold has no value for `ior` (eta); bind with --arg ior=NUMBER"],
    );
}
