//! A verification dealt to shards and put together again: the same report to the byte, and nothing else is taken for one.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::{Value, json};

use crate::cli::{OUT, Place, Ran};
use fresnel_gen::lab::verify::merge::{merged, parsed};

/// Variables in which schedulers number tasks, and one that counts them, which nobody may believe.
const VARIABLES: [&str; 3] = [
    "SLURM_ARRAY_TASK_ID",
    "JOB_COMPLETION_INDEX",
    "SLURM_ARRAY_TASK_COUNT",
];

/// A small run: six files. No compiler of these targets is slow, so that none is stopped for its time where a machine is busy.
const SMALL: &str =
    "verify --target spirv,gles --method schlick,dielectric_exact --material water --points 100";

/// Runs the program with these variables and none of a scheduler's own.
fn run_with(place: &Place, line: &str, variables: &[(&str, &str)]) -> Ran {
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut command = place.command(&words);
    for name in VARIABLES {
        command.env_remove(name);
    }
    let output = command.envs(variables.iter().copied()).output().unwrap();
    Ran::new(line.to_owned(), output)
}

/// Runs it, and each of its shards, with reports `whole.json` and `part-I.json`; the exit codes.
fn run_all(place: &Place, line: &str, shards: usize) -> (Ran, Vec<Ran>) {
    let whole = run_with(place, &format!("{line} --json whole.json"), &[]);
    let shard = |index: usize| {
        let line = format!("{line} --shards {shards} --shard {index} --json part-{index}.json");
        run_with(place, &line, &[])
    };
    (whole, (0..shards).map(shard).collect())
}

/// Merges them, last first.
fn merge(place: &Place, shards: usize, flags: &str) -> Ran {
    let parts: Vec<String> = (0..shards)
        .rev()
        .map(|index| format!("part-{index}.json"))
        .collect();
    place.run(&format!("merge {} {flags}", parts.join(" ")))
}

fn report(place: &Place, name: &str) -> Value {
    serde_json::from_str(&place.read(name)).unwrap()
}

/// The rows of a report without their places, as text.
fn bare_rows(report: &Value) -> Vec<String> {
    let rows = report["rows"].as_array().unwrap().iter();
    let bare = rows.map(|row| {
        let mut row = row.clone();
        for key in ["place", "number"] {
            row.as_object_mut().unwrap().shift_remove(key);
        }
        row.to_string()
    });
    bare.collect()
}

#[test]
fn merged_shards_are_the_report_of_a_whole_run_to_the_byte() {
    for shards in [1, 2, 3, 7] {
        let place = Place::new();
        let (whole, parts) = run_all(&place, SMALL, shards);
        let ran = merge(&place, shards, "-o merged.json").ends(whole.code.unwrap());
        assert!(
            place.read("merged.json") == place.read("whole.json"),
            "{shards} shards: {}",
            ran.err
        );
        // What is for people is the same too.
        assert_eq!(ran.out, whole.out);
        let summary = |ran: &Ran| {
            ran.err
                .lines()
                .find(|line| line.contains("functions run"))
                .map(str::to_owned)
        };
        assert_eq!(summary(&ran), summary(&whole));
        // Each row stands in one shard.
        let mut dealt = Vec::new();
        for index in 0..shards {
            let part = report(&place, &format!("part-{index}.json"));
            assert_eq!(
                (&part["shard"], &part["shards"]),
                (&json!(index), &json!(shards))
            );
            assert_eq!(part["command"], report(&place, "whole.json")["command"]);
            dealt.extend(bare_rows(&part));
        }
        let mut all = bare_rows(&report(&place, "whole.json"));
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
        dealt.sort();
        all.sort();
        assert_eq!(dealt, all, "{shards} shards");
        // There is work for six; a seventh has nothing to do, and that is no fault.
        let empty: Vec<&Ran> = parts
            .iter()
            .filter(|ran| ran.err.contains(": 0 of 6 parts"))
            .collect();
        assert_eq!(empty.len(), shards.saturating_sub(6));
        for ran in empty {
            assert_eq!(ran.code, Some(0), "{ran:?}");
        }
    }
}

/// Some of these, each once.
fn some_of(
    names: &'static [&'static str],
    count: impl Into<prop::sample::SizeRange>,
) -> impl Strategy<Value = String> {
    prop::sample::subsequence(names.to_vec(), count).prop_map(|some| some.join(","))
}

/// A run of few functions: `verify` with its flags. Some are refused.
fn small_run() -> impl Strategy<Value = String> {
    const METHODS: [&str; 8] = [
        "schlick",
        "schlick_f90",
        "fitted",
        "fitted_dielectric",
        "dielectric_exact",
        "conductor_exact",
        "conductor_exact_metal",
        "table",
    ];
    const MATERIALS: [&str; 6] = ["none", "gold", "water", "diamond", "silver", "bk7"];
    let target = some_of(&["gles", "glsl", "msl", "spirv", "wgsl"], 1..=2);
    let what = prop_oneof![
        4 => some_of(&METHODS, 1..=2).prop_map(|names| format!("--method {names}")),
        1 => some_of(&["coat", "interface", "dispersion"], 1..=2)
            .prop_map(|names| format!("--effect {names}")),
    ];
    let materials = prop_oneof![
        1 => Just("none".to_owned()),
        5 => some_of(&MATERIALS[1..], 1..=3),
    ];
    let precision = prop::sample::select(vec!["f32", "f32", "f32", "f16"]);
    let medium = prop::sample::select(vec!["", "", "", " --medium water", " --medium 1.5"]);
    (target, what, materials, precision, medium, 100..400_usize).prop_map(
        |(target, what, materials, precision, medium, points)| {
            format!("verify --target {target} {what} --material {materials} --precision {precision}{medium} --points {points}")
        },
    )
}

/// Places of all runs that gave no row.
static WITHOUT_ROWS: AtomicUsize = AtomicUsize::new(0);

/// Holds a run in shards, numbered by Slurm, against the whole run.
fn check_shards(line: &str, shards: usize) {
    let place = Place::new();
    let whole = run_with(&place, &format!("{line} --json whole.json"), &[]);
    for index in 0..shards {
        let sharded = format!("{line} --shards {shards} --json part-{index}.json");
        let ran = run_with(&place, &sharded, &[(VARIABLES[0], &index.to_string())]);
        assert_eq!(ran.code == Some(2), whole.code == Some(2), "{ran:?}");
        if whole.code == Some(2) {
            assert_eq!(ran.err, whole.err);
            continue;
        }
        let part = report(&place, &format!("part-{index}.json"));
        for part in part["parts"].as_array().unwrap() {
            // What came to nothing says why, and nothing else does.
            let is_without = part["rows"] == json!(0);
            assert_eq!(is_without, part["reason"].is_string(), "{part}");
            WITHOUT_ROWS.fetch_add(usize::from(is_without), Ordering::Relaxed);
        }
    }
    if whole.code == Some(2) {
        return;
    }
    let ran = merge(&place, shards, "-o merged.json").ends(whole.code.unwrap());
    assert!(place.read("merged.json") == place.read("whole.json"));
    assert_eq!(ran.out, whole.out);
    let unrun = |ran: &Ran| -> Vec<String> {
        let lines = ran.err.lines().filter(|line| line.contains("not run: "));
        lines.map(str::to_owned).collect()
    };
    assert_eq!(unrun(&ran), unrun(&whole));
}

/// A failure prints the command and the number of shards, shrunk; the seed is a constant.
#[test]
fn shards_of_every_kind_of_run_are_put_together() {
    let config = ProptestConfig {
        cases: 16,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        max_shrink_iters: 20,
        ..ProptestConfig::default()
    };
    proptest!(config, |(line in small_run(), shards in 1..6_usize)| {
        check_shards(&line, shards);
    });
    // Places without rows, and the kinds of run that the draw may miss.
    check_shards("verify --target gles --material gold --points 100", 2);
    check_shards(
        "verify --target glsl,msl --material water --medium water --points 100",
        3,
    );
    assert!(
        WITHOUT_ROWS.load(Ordering::Relaxed) > 0,
        "no place of any run gave no row"
    );
}

/// A whole run of the small set, and the same as the only shard of one.
fn only_shard() -> &'static (String, Value, i32) {
    static ONLY: OnceLock<(String, Value, i32)> = OnceLock::new();
    ONLY.get_or_init(|| {
        let place = Place::new();
        let (whole, _) = run_all(&place, SMALL, 1);
        (
            place.read("whole.json"),
            report(&place, "part-0.json"),
            whole.code.unwrap(),
        )
    })
}

/// The reports of so many shards, as they would have been written.
fn dealt(shards: usize) -> Vec<Value> {
    let (_, only, _) = only_shard();
    let part = |index: usize| {
        let mut part = only.clone();
        part["shard"] = index.into();
        part["shards"] = shards.into();
        for key in ["rows", "parts"] {
            let all = part[key].as_array_mut().unwrap();
            all.retain(|one| one["place"].as_u64().unwrap() as usize % shards == index);
        }
        part
    };
    (0..shards).map(part).collect()
}

#[test]
fn rows_come_back_in_order_however_many_shards_there_are() {
    let (whole, ..) = only_shard();
    let whole: Value = serde_json::from_str(whole).unwrap();
    for shards in (1..20).chain([100, 1000]) {
        let parts = dealt(shards).into_iter().enumerate();
        let parts = parts.map(|(index, part)| {
            parsed(&PathBuf::from(index.to_string()), &part.to_string()).unwrap()
        });
        let merged = merged(parts.collect()).unwrap();
        assert_eq!(json!(merged.rows), whole["rows"], "{shards} shards");
        assert_eq!(json!(merged.command), whole["command"]);
    }
}

/// Of a run over all numbers functions are dealt. A table's own are run at a sample only, so that this takes no time.
#[test]
fn functions_are_dealt_where_all_numbers_are_run() {
    let place = Place::new();
    let line = "verify --exhaustive --target wgsl --method table --material gold,water,diamond";
    let (whole, parts) = run_all(&place, line, 2);
    let places = |name: &str| {
        let report = report(&place, name);
        let rows = report["rows"].as_array().unwrap().iter();
        rows.map(|row| row["place"].as_u64().unwrap())
            .collect::<Vec<_>>()
    };
    assert_eq!(places("part-0.json"), [0, 2]);
    assert_eq!(places("part-1.json"), [1]);
    merge(&place, 2, "-o merged.json").ends(whole.code.unwrap());
    assert!(place.read("merged.json") == place.read("whole.json"));
    // No machine would run them, so that a shard does not say that this one lacks something.
    let has_device = report(&place, "part-0.json")["machine"]["has"]["wgsl"].is_string();
    for ran in parts.iter().filter(|_| has_device) {
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    // An error of the whole run is one of each shard.
    let line = "verify --exhaustive --method schlick --material none --shards 9 --shard 8";
    place.refused(line, &["--exhaustive"]);
}

#[test]
fn a_scheduler_says_which_shard_it_is_and_never_how_many_there_are() {
    let place = Place::new();
    let sharded = format!("{SMALL} --shards 7 --json part.json");
    let shard = |variables: &[(&str, &str)]| {
        run_with(&place, &sharded, variables);
        let part = report(&place, "part.json");
        fs::remove_file(place.path("part.json")).unwrap();
        assert_eq!(part["shards"], 7);
        part["shard"].as_u64().unwrap()
    };
    // An array of which one task is run again.
    let again = [
        ("SLURM_ARRAY_TASK_ID", "5"),
        ("SLURM_ARRAY_TASK_COUNT", "1"),
    ];
    assert_eq!(shard(&again), 5);
    assert_eq!(shard(&[("JOB_COMPLETION_INDEX", "6")]), 6);
    // A run without --shards is whole, wherever it runs.
    let whole = format!("{SMALL} --json whole.json");
    run_with(
        &place,
        &whole,
        &[
            ("SLURM_ARRAY_TASK_ID", "nonsense"),
            ("JOB_COMPLETION_INDEX", "3"),
        ],
    );
    let (expected, ..) = only_shard();
    assert!(place.read("whole.json") == *expected);
}

#[test]
fn what_names_no_shard_is_refused() {
    let place = Place::new();
    for (line, variables, says) in [
        (
            "--shards 4",
            &[][..],
            &[
                "--shard I",
                "0 to 3",
                "SLURM_ARRAY_TASK_ID",
                "JOB_COMPLETION_INDEX",
            ][..],
        ),
        ("--shards 0 --shard 0", &[], &["--shards is 0"]),
        ("--shards 4 --shard 4", &[], &["--shard is 4", "0 to 3"]),
        ("--shard 1", &[], &["--shards"]),
        ("--shards four --shard 1", &[], &["four"]),
        ("--shards 4 --shard 1.5", &[], &["1.5"]),
        ("--shards 4 --shard -1", &[], &["-1"]),
        (
            "--shards 4",
            &[("SLURM_ARRAY_TASK_ID", "4")],
            &["SLURM_ARRAY_TASK_ID is 4", "0 to 3"],
        ),
        (
            "--shards 4",
            &[("JOB_COMPLETION_INDEX", "x")],
            &["JOB_COMPLETION_INDEX is `x`"],
        ),
        (
            "--shards 4",
            &[("SLURM_ARRAY_TASK_ID", "1"), ("JOB_COMPLETION_INDEX", "2")],
            &[
                "SLURM_ARRAY_TASK_ID is 1",
                "JOB_COMPLETION_INDEX is 2",
                "--shard I",
            ],
        ),
    ] {
        let ran = run_with(
            &place,
            &format!("verify {line} --json part.json"),
            variables,
        )
        .ends(2);
        for text in says {
            assert!(ran.err.contains(text), "{text} is not in {ran:?}");
        }
    }
    assert!(place.files().is_empty());
}

#[test]
fn a_finding_is_of_its_shard_and_of_the_whole() {
    let place = Place::new();
    place.done("--target spirv,gles --method schlick,dielectric_exact --material water");
    let file = place.path(&format!("{OUT}/gles/fresnel_schlick.glsl"));
    let text = fs::read_to_string(&file).unwrap();
    fs::write(
        &file,
        format!("{text}float added(float c) {{ return c; }}\n"),
    )
    .unwrap();
    let (whole, parts) = run_all(&place, &format!("{SMALL} --require-all"), 3);
    whole.ends(1);
    let found: Vec<&Ran> = parts.iter().filter(|ran| ran.code == Some(1)).collect();
    assert_eq!(found.len(), 1, "{parts:?}");
    assert!(found[0].err.contains("gles/fresnel_schlick.glsl"));
    let ran = merge(&place, 3, "--json merged.json --junit merged.xml").ends(1);
    assert!(ran.err.contains("gles/fresnel_schlick.glsl"), "{ran:?}");
    assert!(place.read("merged.json") == place.read("whole.json"));
    let rows = bare_rows(&report(&place, "whole.json")).len();
    assert_eq!(place.read("merged.xml").matches("<testcase ").count(), rows);
}

#[test]
fn what_was_not_checked_ends_with_3_where_all_is_asked_for() {
    let place = Place::new();
    for flags in ["", " --require-all"] {
        // No file of this name is a compiler.
        let line =
            format!("verify --target msl --method schlick --material none --points 100{flags}");
        let (whole, _) = run_all(&place, &line, 2);
        assert_eq!(whole.code, Some(3), "{whole:?}");
        merge(&place, 2, "-o merged.json").ends(3);
        assert!(place.read("merged.json") == place.read("whole.json"));
    }
}

/// What is done to the second of four reports, and what is said of it.
type Tampered = (&'static str, fn(&mut Value), &'static [&'static str]);

const TAMPERED: [Tampered; 15] = [
    (
        "the version of the program",
        |part| part["version"] = json!("0.0.9"),
        &["0.0.9 wrote it"],
    ),
    (
        "the version of the form",
        |part| part["schema"] = json!(99),
        &["wrote it"],
    ),
    (
        "another program",
        |part| part["tool"] = json!("another"),
        &["no report of fresnel-gen"],
    ),
    (
        "the flags",
        |part| {
            part["command"] = json!(
                part["command"]
                    .as_str()
                    .unwrap()
                    .replace("--points 100", "--points 200")
            )
        },
        &[
            "the command is",
            "--points 200",
            "--points 100",
            "part-0.json",
        ],
    ),
    (
        "the command",
        |part| part["command"] = json!("cost --gpu rdna2"),
        &["`cost --gpu rdna2`", "only reports of `verify`"],
    ),
    (
        "what is run",
        |part| part["inputs"] = json!("0123"),
        &["files and materials differ", "0123"],
    ),
    (
        "what ends with 3",
        |part| part["require_all"] = json!(true),
        &["--require-all"],
    ),
    (
        "the device",
        |part| {
            part["machine"]["lacks"]
                .as_object_mut()
                .unwrap()
                .shift_remove("spirv");
            part["machine"]["has"]["spirv"] = json!("vulkan: another card (its driver 2.0)");
        },
        &["`spirv` is", "another card (its driver 2.0)"],
    ),
    (
        "a compiler",
        |part| part["machine"]["has"]["gles by glslang"] = json!("0.1"),
        &["`gles by glslang` is 0.1"],
    ),
    (
        "how many there are",
        |part| {
            part["shards"] = json!(8);
            part["rows"] = json!([]);
            part["parts"] = json!([]);
            part["places"] = json!(0);
            part["plan"] = json!([]);
        },
        &["the number of shards is 8", "4"],
    ),
    (
        "fewer places",
        |part| {
            part["places"] = json!(5);
            part["plan"].as_array_mut().unwrap().pop();
            for key in ["rows", "parts"] {
                let all = part[key].as_array_mut().unwrap();
                all.retain(|one| one["place"] != json!(5));
            }
        },
        &["planned rows differ: there are 5 places", "6 places"],
    ),
    (
        "another row and its plan",
        |part| {
            part["rows"][0]["material"] = json!("gold");
            part["plan"][1]["rows"] = json!("0");
        },
        &["the rows of place 1 are not those that its `plan` has"],
    ),
    (
        "the plan",
        |part| part["plan"][0]["rows"] = json!("0"),
        &["planned rows differ"],
    ),
    (
        "a shard beyond",
        |part| part["shard"] = json!(4),
        &["shard 4 of 4"],
    ),
    (
        "a whole run",
        |part| {
            part.as_object_mut().unwrap().shift_remove("shards");
        },
        &["whole run"],
    ),
];

#[test]
fn shards_of_another_run_are_refused() {
    let parts = dealt(4);
    for (what, tamper, says) in TAMPERED {
        let place = Place::new();
        for (index, part) in parts.iter().enumerate() {
            let mut part = part.clone();
            if index == 1 {
                tamper(&mut part);
            }
            place.put(&format!("part-{index}.json"), part.to_string());
        }
        let line = "merge part-0.json part-1.json part-2.json part-3.json -o merged.json";
        println!("{what}");
        let says: Vec<&str> = says.iter().copied().chain(["part-1.json"]).collect();
        place.refused(line, &says);
    }
}

/// A folder with the reports of four shards.
fn four() -> Place {
    let place = Place::new();
    for (index, part) in dealt(4).iter().enumerate() {
        place.put(&format!("part-{index}.json"), part.to_string());
    }
    place
}

#[test]
fn missing_shards_and_those_that_are_there_twice_are_named() {
    let place = four();
    place.refused(
        "merge part-0.json part-2.json",
        &["2 of 4 shards missing: 1, 3;"],
    );
    place.refused("merge part-3.json", &["3 of 4 shards missing: 0, 1, 2;"]);
    place.refused(
        "merge part-0.json part-1.json part-0.json",
        &["shard 0", "part-0.json"],
    );
    place.put("again.json", place.read("part-2.json"));
    place.refused(
        "merge part-0.json part-1.json part-2.json part-3.json again.json",
        &["again.json: this is shard 2, and so is part-2.json"],
    );
    // So many that nobody wants to read all of them.
    let mut one = dealt(1).remove(0);
    one["shards"] = json!(u64::MAX);
    one["rows"] = json!([]);
    one["parts"] = json!([]);
    one["places"] = json!(0);
    one["plan"] = json!([]);
    place.put("one.json", one.to_string());
    let says = [
        "18446744073709551614 of",
        "18, 19, 20, and 18446744073709551594 more",
    ];
    place.refused("merge one.json", &says);
    place.refused("merge", &[]);
}

#[test]
fn what_is_no_report_is_refused_with_its_place() {
    let place = four();
    let deep = "[".repeat(1_000_000);
    let deep_row = format!("{{\"tool\": {deep}");
    let half = place.read("part-0.json");
    let tampered = |tamper: fn(&mut Value)| {
        let mut part = dealt(4).remove(0);
        tamper(&mut part);
        part.to_string()
    };
    fn rows(part: &mut Value) -> &mut Vec<Value> {
        part["rows"].as_array_mut().unwrap()
    }
    let stray = tampered(|part| rows(part)[0]["place"] = json!(1));
    let fewer = tampered(|part| drop(rows(part).pop()));
    let none = tampered(|part| rows(part).clear());
    let twice = tampered(|part| {
        let first = rows(part)[0].clone();
        rows(part).push(first);
    });
    let replaced = tampered(|part| {
        let first = rows(part)[0].clone();
        rows(part)[1] = first;
    });
    let moved = tampered(|part| rows(part).swap(0, 1));
    let unlisted = tampered(|part| drop(part["parts"].as_array_mut().unwrap().pop()));
    let forgotten = tampered(|part| {
        part["parts"].as_array_mut().unwrap().remove(0);
        rows(part).retain(|row| row["place"] != json!(0));
    });
    let beyond = tampered(|part| rows(part)[0]["place"] = json!(4000));
    // What is left is numbered again, and `parts` agrees.
    let renumbered = tampered(|part| {
        let first = part["parts"][0]["place"].clone();
        let at = rows(part).iter().position(|row| row["place"] == first);
        rows(part).remove(at.unwrap());
        let left = rows(part).iter_mut().filter(|row| row["place"] == first);
        let mut count = 0;
        for row in left {
            row["number"] = json!(count);
            count += 1;
        }
        part["parts"][0]["rows"] = json!(count);
        if count == 0 {
            part["parts"][0]["reason"] = json!("it holds no function that was asked for");
        }
    });
    let renamed = tampered(|part| rows(part)[0]["function"] = json!("fresnel_other"));
    let contradicts = tampered(|part| {
        let passes = |row: &&mut Value| row["status"] == "pass";
        let row = rows(part).iter_mut().find(passes);
        row.unwrap()["accepts"] = json!({ "glslang": "no" });
    });
    let hidden = tampered(|part| rows(part)[0]["material"] = json!("g\n::notice::x"));
    let hidden_reason = tampered(|part| part["parts"][0]["reason"] = json!("g\n::notice::x"));
    let words = half.replacen("\"shards\":4", "\"shards\":\"four\"", 1);
    for (name, text, says) in [
        ("empty.json", "", "empty.json:1:"),
        ("garbage.json", "not JSON", "garbage.json:1:"),
        ("list.json", "[1, 2]", "list.json:1:"),
        ("number.json", "7", "expected an object"),
        ("empty_object.json", "{}", "no report of fresnel-gen"),
        ("null.json", "null", "null.json:1:"),
        ("deep.json", &deep, "deep.json:1:"),
        ("deep_row.json", &deep_row, "deep_row.json:1:"),
        ("half.json", &half[..half.len() / 2], "half.json:1:"),
        (
            "twice.json",
            "{\"tool\": \"fresnel-gen\", \"tool\": \"fresnel-gen\"}",
            "duplicate field",
        ),
        (
            "stray.json",
            &stray,
            "place 1, which is not dealt to shard 0 of 4",
        ),
        ("fewer.json", &fewer, "rows, and"),
        ("none.json", &none, "rows, and 0 are there"),
        ("doubled.json", &twice, "rows, and"),
        (
            "replaced.json",
            &replaced,
            "one is missing, is there twice, or was moved",
        ),
        (
            "moved.json",
            &moved,
            "one is missing, is there twice, or was moved",
        ),
        (
            "unlisted.json",
            &unlisted,
            "`parts` does not list each place",
        ),
        (
            "forgotten.json",
            &forgotten,
            "`parts` does not list each place",
        ),
        (
            "contradicts.json",
            &contradicts,
            "passes, and a compiler refuses its file",
        ),
        ("hidden_reason.json", &hidden_reason, "\\n::notice::x"),
        ("beyond.json", &beyond, "place 4000, which is not dealt"),
        ("hidden.json", &hidden, "\\n::notice::x"),
        ("words.json", &words, "expected a whole number"),
        (
            "renumbered.json",
            &renumbered,
            "the rows of place 0 are not those that its `plan` has",
        ),
        (
            "renamed.json",
            &renamed,
            "the rows of place 0 are not those that its `plan` has",
        ),
    ] {
        place.put(name, text);
        place.refused(
            &format!("merge {name} part-1.json -o merged.json"),
            &[name, says],
        );
    }
    // Nobody reads a message of a million characters.
    let mut long = dealt(4).remove(0);
    long["command"] = json!(format!("cost {}", "x".repeat(1_000_000)));
    place.put("long.json", long.to_string());
    let ran = place.run("merge long.json").ends(2);
    assert!(ran.err.len() < 2000 && ran.err.contains("only reports of `verify`"));
    place.put("bytes.json", [0xff, 0xfe, 0, 1]);
    place.refused("merge bytes.json", &["bytes.json:1:1", "not UTF-8"]);
    fs::create_dir(place.path("folder.json")).unwrap();
    place.refused(
        "merge folder.json",
        &["folder.json", "not an ordinary file"],
    );
    place.refused("merge absent.json", &["absent.json"]);
    File::create(place.path("huge.json"))
        .unwrap()
        .set_len(1 << 30)
        .unwrap();
    place_refuses_unread(&place, "merge huge.json", "at most");
}

/// As [`Place::refused`], where a file is too large to look at.
fn place_refuses_unread(place: &Place, line: &str, says: &str) {
    let ran = place.run(line).ends(2);
    assert!(ran.err.contains(says) && ran.out.is_empty(), "{ran:?}");
}

#[test]
fn an_output_takes_the_place_of_no_input_and_of_no_file_of_a_tree() {
    let place = four();
    let all = "merge part-0.json part-1.json part-2.json part-3.json";
    place.refused(
        &format!("{all} -o part-2.json"),
        &["part-2.json", "reads that file"],
    );
    place.refused(
        &format!("{all} -o ./part-0.json"),
        &["part-0.json", "reads that file"],
    );
    place.refused(&format!("{all} --junit part-1.json"), &["part-1.json"]);
    place.refused(&format!("{all} -o a.json --junit a.json"), &["two outputs"]);
    fs::create_dir(place.path("folder")).unwrap();
    place.refused(&format!("{all} -o folder"), &["folder"]);
    place.done("--target gles --method schlick --material none");
    place.refused(
        &format!("{all} -o {OUT}/gles/fresnel_schlick.glsl"),
        &["generated tree"],
    );
    // A report that is named replaces what lies there, as that of every command does, and stdout takes it as well.
    place.put("mine.json", "mine");
    let (whole, _, code) = only_shard();
    place.run(&format!("{all} -o mine.json")).ends(*code);
    assert_eq!(place.read("mine.json"), *whole);
    assert_eq!(
        place.run(&format!("{all} --json -")).ends(*code).out,
        *whole
    );
}
