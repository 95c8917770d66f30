//! Half precision: every f16 from 0 to 1, rounded after every operation, against f64. Library functions over random media,
//! specialised ones for the whole catalogue; `data/code-bounds-f16.csv` records the latter, `data/records/half.csv` those that err
//! more than their method's file says, and `BLESS=1` rewrites both.

use std::fmt::Write;
use std::path::Path;

use crate::code_error::library_half_error;
use fresnel_gen::generator::emit::{Bounds, EmittedFunction, Naming, specialised_function};
use fresnel_gen::generator::error::{Error, RequestFault};
use fresnel_gen::generator::generate;
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::generator::request::{Materials, Methods, Request, Source};
use fresnel_gen::lab::verify::{HalfTrial, halves};
use fresnel_gen::language::ir::Value;
use fresnel_gen::language::methods::{self, Contract, HALF_AIM, InHalf, Method};
use fresnel_gen::language::targets::Target;
use fresnel_gen::physics::num::{Half, Num, Precision};

/// Random media over which a library function's error is taken.
const MEDIA: usize = 120;
/// What a promise may be above what is measured.
const SLACK: f64 = 0.85;
/// The methods that are the exact law, which reflects everything at 90 degrees.
const EXACT: [&str; 5] = [
    "conductor_artistic",
    "conductor_exact",
    "conductor_from_f0_f82",
    "dielectric_exact",
    "dielectric_exact_s",
];

fn naming() -> Naming {
    Naming {
        precision: Precision::F16,
        ..Naming::default()
    }
}

fn in_half(methods: Methods, force: bool) -> Request {
    Request {
        methods,
        materials: Materials::None,
        precision: Precision::F16,
        force,
        ..Request::default()
    }
}

#[test]
fn library_functions_keep_what_they_promise() {
    let check = |method: &'static Method| {
        let claim = method.half.claim()?;
        let error = library_half_error(method, MEDIA)?;
        let (promised, measured) = (claim.max_abs, error.max_abs);
        let what = format!(
            "{} {}: measured {measured:.6} at cos {}, promised {promised}",
            method.name, method.variant, error.worst_cos
        );
        if measured > promised {
            Some(format!("exceeded: {what}"))
        } else if measured < SLACK * promised && method.variant.is_empty() {
            Some(format!("slack, lower the promise: {what}"))
        } else {
            None
        }
    };
    let broken: Vec<String> = methods::all_variants().filter_map(check).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// All methods that are written for a material.
fn methods_of(subject: &MaterialInMedium) -> impl Iterator<Item = &'static Method> {
    let fits =
        move |method: &&&Method| method.half.refusal().is_none() && subject.is_described_by(method);
    methods::ALL.iter().filter(fits).copied()
}

/// The columns of the record of all functions.
const BOUNDS: [&str; 5] = ["fingerprint", "material", "method", "max_abs", "worst_cos"];
/// The columns of the record of those that err more than their method promises.
const BEYOND: [&str; 4] = ["material", "method", "max_abs", "promised"];

/// What is measured of a material's function.
struct Row {
    method: &'static Method,
    max_abs: f64,
    /// Its line in the record of all.
    bound: [String; 5],
    /// Its line in the record of those that err more than their method promises, where it is one.
    beyond: Option<[String; 4]>,
    fault: Option<String>,
}

fn measured(emitted: &EmittedFunction, subject: &MaterialInMedium, cosines: &[f32]) -> Row {
    let meaning = emitted.meaning().expect("it is well formed");
    let trial = HalfTrial {
        function: &emitted.function,
        meaning: &meaning,
        values: &[],
        table: None,
    };
    let error = trial.error(cosines);
    let mark = fresnel_gen::generator::emit::fingerprint(&emitted.function);
    let (material, method, max_abs) = (&subject.name, emitted.method.name, error.max_abs);
    let promised = promised(emitted.method);
    Row {
        method: emitted.method,
        max_abs,
        bound: [
            mark,
            material.clone(),
            method.to_owned(),
            format!("{max_abs:e}"),
            format!("{:e}", error.worst_cos),
        ],
        beyond: (max_abs > promised).then(|| {
            [
                material.clone(),
                method.to_owned(),
                format!("{max_abs:.3e}"),
                promised.to_string(),
            ]
        }),
        fault: range_fault(emitted, &trial.emulated(cosines), cosines.len()),
    }
}

/// The most that a method promises of functions of materials in half precision.
fn promised(method: &Method) -> f64 {
    let claim = method.half.claim();
    claim.map_or(HALF_AIM, |claim| claim.of_materials)
}

/// What is wrong with a promise: it leaves out more than a tenth of all materials, or is above the aim and slack.
fn promise_fault(method: &Method, rows: &[Row]) -> Option<String> {
    let own: Vec<&Row> = rows
        .iter()
        .filter(|row| row.method.name == method.name)
        .collect();
    let (name, promised) = (method.name, promised(method));
    let within = own.iter().filter(|row| row.beyond.is_none());
    let beyond = own.len() - within.clone().count();
    let largest = within.map(|row| row.max_abs).fold(0.0, f64::max);
    if beyond * 10 > own.len() {
        let all = own.len();
        Some(format!(
            "{name}: {beyond} of {all} materials err more than {promised}\n"
        ))
    } else if promised != HALF_AIM && largest < SLACK * promised {
        Some(format!(
            "{name}: slack, lower {promised} of materials; the others err {largest} at most\n"
        ))
    } else {
        None
    }
}

/// What is wrong with results: they lie in [0, 1], and the exact law is exactly 1 at 90 degrees.
fn range_fault(emitted: &EmittedFunction, got: &Value<Half>, count: usize) -> Option<String> {
    let number = |i: usize| got.at(i).map(Num::to_f64);
    let inside = |value: f64| (0.0..=1.0).contains(&value);
    let kept = emitted.method.contract == Contract::Kept;
    if let Some(i) = (0..count).find(|i| kept && !number(*i).into_iter().all(inside)) {
        return Some(format!("{} leaves [0, 1]: {:?}", emitted.name, number(i)));
    }
    let is_exact = EXACT.contains(&emitted.method.name);
    (is_exact && number(0) != [1.0; 3])
        .then(|| format!("{} at 90 degrees: {:?}", emitted.name, number(0)))
}

#[test]
fn the_catalogue_keeps_within_the_aim_and_is_recorded() {
    let request = Request {
        materials: Materials::All,
        ..Request::default()
    };
    let subjects = request
        .subjects()
        .expect("the catalogue is good")
        .materials();
    let cosines = halves();
    let of = |subject: &MaterialInMedium| -> Vec<Row> {
        let emitted = methods_of(subject).map(|method| {
            specialised_function(method, subject, &naming(), &Bounds::default())
                .expect("every method specialises to the catalogue")
        });
        emitted
            .map(|emitted| measured(&emitted, subject, &cosines))
            .collect()
    };
    let share = subjects.len().div_ceil(2);
    let rows: Vec<Row> = std::thread::scope(|scope| {
        let parts = subjects.chunks(share);
        let threads: Vec<_> = parts
            .map(|part| scope.spawn(|| part.iter().flat_map(&of).collect()))
            .collect();
        let joined = threads.into_iter().map(|thread| {
            let rows: Vec<Row> = thread.join().expect("no thread panics");
            rows
        });
        joined.flatten().collect()
    });
    let mut faults: String = methods::ALL
        .iter()
        .filter_map(|method| promise_fault(method, &rows))
        .collect();
    let (mut bounds, mut beyond) = (Vec::new(), Vec::new());
    for row in rows {
        bounds.push(row.bound);
        beyond.extend(row.beyond);
        if let Some(fault) = row.fault {
            let _ = writeln!(faults, "{fault}");
        }
    }
    let bounds = super::records::text(BOUNDS, &bounds);
    let beyond = super::records::text(BEYOND, &beyond);
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    super::bless::check(&data.join("code-bounds-f16.csv"), bounds.as_bytes());
    super::bless::check(&data.join("records/half.csv"), beyond.as_bytes());
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn an_interface_that_is_not_there_reflects_nothing() {
    for (name, values) in [
        ("conductor_exact", vec![[1.0; 3], [0.0; 3]]),
        ("dielectric_exact", vec![[1.0; 3]]),
        ("dielectric_exact_s", vec![[1.0; 3]]),
        ("dielectric_exact_p", vec![[1.0; 3]]),
    ] {
        let method = methods::find(name).expect("it is registered");
        let function = method
            .function_in(Precision::F16, false)
            .expect("it is well formed");
        let trial = HalfTrial {
            function: &function,
            meaning: &function,
            values: &values,
            table: None,
        };
        let got = trial.emulated(&halves());
        assert!(
            (0..15_361).all(|i| got.at(i).map(Num::to_f64) == [0.0; 3]),
            "{name}"
        );
    }
}

#[test]
fn a_method_that_cannot_be_saved_is_refused_by_name_unless_forced() {
    for method in methods::ALL {
        let result = generate(&in_half(Methods::These(vec![method]), false));
        let Some(why) = method.half.library_refusal() else {
            assert!(result.is_ok(), "{}", method.name);
            continue;
        };
        let Err(error @ Error::Request(RequestFault::Refused { .. })) = result else {
            panic!("{} is written", method.name);
        };
        let words = error.to_string();
        assert_eq!(fresnel_gen::cli::Error::from(error).exit_code(), 2);
        for part in [method.name, why, "--force"] {
            assert!(words.contains(part), "{words}");
        }
        let forced = generate(&in_half(Methods::These(vec![method]), true)).expect("it is forced");
        let text = &forced.artifacts[0].bytes;
        let text = String::from_utf8_lossy(text);
        assert!(text.contains("nothing is promised"), "{text}");
        assert!(text.contains(" --precision f16 --force\n"), "{text}");
    }
}

#[test]
fn without_a_name_such_methods_are_left_out_with_a_remark() {
    let generated = generate(&in_half(Methods::Default, false)).expect("it generates");
    let refused: Vec<&&Method> = methods::ALL
        .iter()
        .filter(|method| method.half.library_refusal().is_some())
        .collect();
    assert_eq!(generated.refused.len(), refused.len());
    for method in refused {
        let file = format!("fresnel_{}_f16.", method.name);
        assert!(
            generated
                .artifacts
                .iter()
                .all(|artifact| !artifact.path.contains(&file))
        );
    }
}

#[test]
fn what_is_solved_in_f64_is_written_for_materials() {
    let solved = methods::ALL
        .iter()
        .filter(|method| matches!(method.half, InHalf::Specialised(_)));
    for method in solved {
        let request = Request {
            materials: Materials::These(vec![Source::Named("gold".to_owned())]),
            ..in_half(Methods::These(vec![method]), false)
        };
        let generated = generate(&request).expect("it generates");
        let name = format!("fresnel_gold_{}_f16", method.name);
        for artifact in generated.artifacts {
            assert!(artifact.path.contains("/materials/gold_f16."));
            assert_eq!(artifact.detail.functions()[0].name, name);
        }
    }
}

#[test]
fn half_precision_stands_beside_single_precision() {
    let request = |precision| Request {
        targets: vec![Target::WGSL],
        precision,
        ..Request::default()
    };
    let [single, half] = Precision::ALL.map(|precision| generate(&request(precision)).unwrap());
    for artifact in &half.artifacts {
        assert!(artifact.path.ends_with("_f16.wgsl"), "{}", artifact.path);
        assert_eq!(serde_json::json!(artifact.detail)["precision"], "f16");
        let text = String::from_utf8_lossy(&artifact.bytes);
        assert!(
            text.contains("\nenable f16;\n") && !text.contains("f32>"),
            "{text}"
        );
        assert!(text.contains(" --precision f16\n"), "{text}");
    }
    for artifact in &single.artifacts {
        assert!(!artifact.path.contains("_f16"));
        let entry = fresnel_gen::generator::output::manifest::Entry::of(artifact);
        assert!(single.scope.owns(&entry) && !half.scope.owns(&entry));
    }
}
