//! The function contract on every target, by running it: one table of rules over one table of inputs, hard ones and such
//! as no function is meant for. A rule that fails says that a target's text, or what a stack makes of it, breaks a
//! promise that each file's reader relies on.

use crate::not_checked;
use crate::physics::critical_cos;
use fresnel_gen::generator::emit::{self, Bounds, EmittedFunction, Naming};
use fresnel_gen::generator::fit::{self, Measured};
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::generator::request::{Materials, Request, Source};
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::Wanted;
use fresnel_gen::lab::verify::run::{Devices, ExecutionPath, ShippedFunction};
use fresnel_gen::lab::verify::{ABSOLUTE_FLOOR, Trial};
use fresnel_gen::language::ir::Ty;
use fresnel_gen::language::methods::{self, Contract, Method, find_input};
use fresnel_gen::language::targets::{self, Finish};
use fresnel_gen::physics::optics;

/// The cosines: within the domain, and beyond it on both sides.
const COSINES: [f32; 16] = [
    0.0,
    1.0,
    1e-6,
    0.1,
    0.5,
    0.9,
    0.999_999_94,
    1.000_000_1,
    1.0001,
    2.0,
    f32::INFINITY,
    -1e-41,
    -1e-6,
    -1.0,
    f32::NEG_INFINITY,
    f32::NAN,
];

/// What inputs are tried with that are tried with more, or less, than they say: with what lies outside their domain too.
const INPUTS: &[(&[&str], &[f32])] = &[
    (
        &["eta", "n", "ior"],
        &[1.0, 1.5, 0.5, 0.0, 2.4, 1e-3, 1.0001],
    ),
    (&["k"], &[0.0, 3.0, 1e-3, 20.0]),
    (&["f0", "reflectivity", "f82"], &[0.04, 1.06, 0.0, 1.0, 0.9]),
    (&["tint"], &[1.0, 0.0, 0.4, 1.5]),
    (&["f90", "edge_tint", "bias", "scale"], &[1.0, 0.0, 0.3]),
    (&["power", "exponent"], &[5.0, 0.2, 40.0]),
    (&["texels"], &[64.0]),
    (&["warp"], &[4.0, 0.0, 0.5]),
    (&["row"], &[1.0]),
];

/// The methods that compute the exact law, by whatever inputs.
const EXACT: [&str; 6] = [
    "conductor_artistic",
    "conductor_exact",
    "conductor_from_f0_f82",
    "dielectric_exact",
    "dielectric_exact_p",
    "dielectric_exact_s",
];

/// How far a stack's powers and a sampler's weights may be off; code errors proper are held elsewhere, in ulp.
const NEAR: f64 = 1e-4;
const SAMPLED: f64 = 1e-2;

/// A result with what it came from.
struct Seen<'a> {
    method: &'a Method,
    cos_theta: f32,
    /// The inputs of its channel by name; none for a specialised function.
    inputs: Vec<(&'a str, f32)>,
    /// What f64 gives.
    want: f64,
    got: f32,
    /// What came at cosines of 0 and 1.
    ends: [f32; 2],
}

impl Seen<'_> {
    fn input(&self, name: &str) -> Option<f32> {
        let found = self.inputs.iter().find(|(other, _)| *other == name);
        found.map(|(_, value)| *value)
    }

    /// n and k, where the method takes them.
    fn index(&self) -> Option<(f32, f32)> {
        let n = ["eta", "n", "ior"]
            .into_iter()
            .find_map(|name| self.input(name))?;
        Some((n, self.input("k").unwrap_or(0.0)))
    }

    fn is_exact(&self) -> bool {
        EXACT.contains(&self.method.name)
    }

    /// Both sides alike: exactly, by whichever inputs.
    fn is_matched(&self) -> bool {
        let black = ["f0", "reflectivity"].map(|name| self.input(name) == Some(0.0));
        self.index() == Some((1.0, 0.0)) || black.contains(&true)
    }

    /// All light, to the last bit.
    fn is_one(&self) -> bool {
        self.got == 1.0
    }

    /// The largest result: a run-time F0 above 1 is taken as it is.
    fn most(&self) -> f32 {
        self.input("f0").map_or(1.0, |f0| f0.max(1.0))
    }

    /// Clearly past the critical angle of something transparent; of a material f64 knows it.
    fn is_past_critical(&self) -> bool {
        let past = |(n, k): (f32, f32)| {
            let critical = critical_cos(f64::from(n));
            k == 0.0 && critical.is_some_and(|c| f64::from(self.cos_theta) < c - 1e-3)
        };
        let known = self.want == 1.0 && !self.cos_theta.is_nan();
        self.is_exact() && self.index().map_or(known, past)
    }

    /// Where f64 says what is right, and not only how many digits are left.
    fn has_value(&self) -> bool {
        let class = self.method.class;
        let is_described = |(n, k): (f32, f32)| n >= 0.25 && class.describes(n.into(), k.into());
        let is_index = self.index().is_none_or(is_described);
        is_index && !self.cos_theta.is_nan()
    }
}

/// A promise of the contract: its words, where it holds, and whether a result keeps it.
type Rule = (&'static str, fn(&Seen) -> bool, fn(&Seen) -> bool);

const RULES: [Rule; 8] = [
    (
        "the result lies in [0, max(1, f0)], and is no NaN whatever comes in",
        |_| true,
        |seen| (0.0..=seen.most()).contains(&seen.got),
    ),
    (
        "a cosine above 1 counts as 1",
        |seen| seen.cos_theta > 1.0,
        |seen| seen.got == seen.ends[1],
    ),
    (
        "a cosine below 0 counts as 0",
        |seen| seen.cos_theta < 0.0,
        |seen| seen.got == seen.ends[0],
    ),
    (
        "an interface that is not there reflects nothing, at 90 degrees too",
        |seen| seen.is_exact() && seen.is_matched(),
        |seen| seen.got == 0.0,
    ),
    (
        "all else reflects everything at 90 degrees, exactly",
        |seen| seen.is_exact() && !seen.is_matched() && seen.cos_theta <= 0.0,
        |seen| seen.is_one(),
    ),
    (
        "past the critical angle everything is reflected, exactly",
        |seen| seen.is_past_critical(),
        |seen| seen.is_one(),
    ),
    (
        "it is what f64 gives",
        |seen| seen.has_value() && !seen.method.is_textured(),
        |seen| (f64::from(seen.got) - seen.want).abs() < NEAR,
    ),
    (
        "it is what f64 gives, but for a sampler's weights",
        |seen| seen.has_value() && seen.method.is_textured(),
        |seen| (f64::from(seen.got) - seen.want).abs() < SAMPLED,
    ),
];

/// Values of a method's arguments: all combinations; the three channels have three of an input's values.
fn rows(emitted: &EmittedFunction) -> Vec<Vec<[f32; 3]>> {
    let params = emitted.function.params.iter().skip(1);
    let numbers = params.filter(|param| param.ty != Ty::Texture);
    numbers.fold(vec![Vec::new()], |rows: Vec<Vec<[f32; 3]>>, param| {
        let names = |(names, _): &&(&[&str], &[f32])| names.contains(&param.name.as_str());
        let own = || find_input(&param.name).expect("a method takes it").tried;
        let own = || own().iter().take(4).map(|value| *value as f32).collect();
        let listed = INPUTS.iter().find(names);
        let values: Vec<f32> = listed.map_or_else(own, |(_, values)| values.to_vec());
        let triple = |i: usize| [0, 1, 2].map(|channel| values[(i + channel) % values.len()]);
        let longer = |row: Vec<[f32; 3]>| {
            (0..values.len()).map(move |i| [row.as_slice(), &[triple(i)]].concat())
        };
        rows.into_iter().flat_map(longer).collect()
    })
}

/// The inputs of a channel by name.
fn inputs<'a>(
    emitted: &'a EmittedFunction,
    row: &[[f32; 3]],
    channel: usize,
) -> Vec<(&'a str, f32)> {
    let params = emitted.function.params.iter().skip(1);
    let numbers = params.filter(|param| param.ty != Ty::Texture);
    numbers
        .zip(row)
        .map(|(param, value)| {
            let place = if param.ty == Ty::Vec3 { channel } else { 0 };
            (param.name.as_str(), value[place])
        })
        .collect()
}

/// A file with one function, run over the whole table. Says what breaks a rule.
fn broken(
    devices: &Devices,
    (target, way): (&'static targets::Target, ExecutionPath),
    emitted: &EmittedFunction,
    bytes: &[u8],
) -> Result<Vec<String>, Fault> {
    let shown = ShippedFunction {
        target,
        bytes,
        function: emitted,
        entry: "main",
    };
    let mut trial = Trial {
        function: emitted.function.clone(),
        values: Vec::new(),
        table: fit::table_of(&emitted.function, |c| {
            [1.5, 1.6, 2.4].map(|n| optics::dielectric(n, c).unpolarised())
        }),
        bound: Measured::Yes(emitted.method.claims.code_ulp),
        floor: ABSOLUTE_FLOOR,
        is_guarded: true,
    };
    let rows = rows(emitted);
    trial.values.clone_from(&rows[0]);
    let runnable = devices.prepare(&shown, way, &trial)?;
    let mut faults = Vec::new();
    for row in rows {
        trial.values = row;
        let got = runnable.run(&trial, &COSINES)?;
        faults.extend(judged(emitted, &trial, &got));
    }
    Ok(faults)
}

/// The rules that some results break.
fn judged(emitted: &EmittedFunction, trial: &Trial, got: &[[f32; 3]]) -> Vec<String> {
    let want = trial.run::<f64>(&COSINES);
    let mut faults = Vec::new();
    for (i, cos_theta) in COSINES.iter().enumerate() {
        for channel in 0..3 {
            let seen = Seen {
                method: emitted.method,
                cos_theta: *cos_theta,
                inputs: inputs(emitted, &trial.values, channel),
                want: want.at(i)[channel],
                got: got[i][channel],
                ends: [got[0][channel], got[1][channel]],
            };
            for (words, applies, holds) in RULES {
                if applies(&seen) && !holds(&seen) {
                    let (name, inputs, got, want) =
                        (&emitted.name, &seen.inputs, seen.got, seen.want);
                    faults.push(format!(
                        "{name}({cos_theta:e}, {inputs:?}) = {got:e}, {want:e} in f64: {words}"
                    ));
                }
            }
        }
    }
    faults
}

/// The materials of specialised functions: a metal, what absorbs a little, a liquid, and that seen from within a diamond.
fn subjects() -> Vec<MaterialInMedium> {
    let named = |name: &str| Source::Named(name.to_owned());
    let inside = Request {
        materials: Materials::These(vec![named("water")]),
        medium: Some(named("diamond")),
        ..Request::default()
    };
    let mut all = crate::subjects(&["gold", "silicon", "water"]);
    all.extend(inside.subjects().unwrap().materials());
    all
}

/// Every function that keeps the contract, with a file that holds it alone.
fn files(target: &'static targets::Target) -> Vec<(EmittedFunction, Vec<u8>)> {
    let naming = Naming::default();
    let kept = |method: &&&'static Method| method.contract == Contract::Kept;
    let mut files = Vec::new();
    let written = methods::ALL.iter().filter(kept);
    for method in written.flat_map(|method| method.with_variants()) {
        for emitted in emit::library_functions(method, &naming).unwrap() {
            let one = std::slice::from_ref(&emitted);
            // A module returns a colour: it has no scalar form.
            if target.finish != Finish::Spirv || emitted.form != emit::FunctionForm::Scalar {
                let pages = emit::library(target, method, one, emit::Heading::default()).unwrap();
                files.push((emitted, pages.into_iter().next_back().unwrap().bytes));
            }
        }
    }
    for subject in subjects() {
        let fits = |method: &&&'static Method| subject.is_described_by(method);
        for method in methods::ALL.iter().filter(kept).filter(fits) {
            let emitted =
                emit::specialised_function(method, &subject, &naming, &Bounds::default()).unwrap();
            let one = std::slice::from_ref(&emitted);
            let pages =
                emit::material(target, &subject, one, &naming, emit::Heading::default()).unwrap();
            files.push((emitted, pages.into_iter().next_back().unwrap().bytes));
        }
    }
    files
}

#[track_caller]
fn check(target: &str, way: ExecutionPath) {
    let devices = Devices::new(Wanted::default());
    let target = targets::find(target).unwrap();
    let mut faults = Vec::new();
    let files = files(target);
    assert!(files.len() > 70, "{} functions", files.len());
    for (emitted, bytes) in &files {
        match broken(&devices, (target, way), emitted, bytes) {
            Err(Fault::Absent(why)) => {
                let remark = format!("the contract in {} ({}): {why}", target.name, way.name());
                assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
                return not_checked(&remark);
            }
            Err(fault) => panic!("{} in {}: {fault}", emitted.name, target.name),
            Ok(more) => faults.extend(more),
        }
    }
    let first: Vec<&str> = faults.iter().take(60).map(String::as_str).collect();
    assert!(
        faults.is_empty(),
        "{}: {} promises are broken, the first of them\n{}",
        target.name,
        faults.len(),
        first.join("\n")
    );
}

#[test]
fn the_contract_holds_in_wgsl() {
    check("wgsl", ExecutionPath::Own);
}

#[test]
fn the_contract_holds_in_spirv() {
    check("spirv", ExecutionPath::Own);
}

#[test]
fn the_contract_holds_in_gles() {
    check("gles", ExecutionPath::Own);
}

#[test]
fn the_contract_holds_in_hlsl() {
    check("hlsl", ExecutionPath::Own);
}

#[test]
fn the_contract_holds_in_hlsl_2021() {
    check("hlsl", ExecutionPath::Hlsl2021);
}
