//! Mutants: functions with one thing wrong, written in every language and run. All must be caught, on every target; one
//! that cannot be is named below, with the reason.

use super::subjects;
use crate::not_checked;
use fresnel_gen::generator::emit::{self, EmittedFunction, Naming};
use fresnel_gen::generator::fit::{self, Measured, values_for_material};
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::Wanted;
use fresnel_gen::lab::verify::run::{Devices, ExecutionPath, ShippedFunction};
use fresnel_gen::lab::verify::{ABSOLUTE_FLOOR, Trial, beyond, cosines_around};
use fresnel_gen::language::ir::{Checked, Function, Label, Node, NodeId, Op, Payload, Ty, check};
use fresnel_gen::language::methods::{self, Class, Contract, Method};
use fresnel_gen::language::targets;

const TARGETS: [&str; 4] = ["wgsl", "spirv", "gles", "hlsl"];
const POINTS: usize = 2000;

/// What is done to a function.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wrong {
    Constant,
    Operator,
    Clamp,
    Factor,
    Channels,
    Inverted,
    Sides,
}

const ALL: [Wrong; 7] = [
    Wrong::Constant,
    Wrong::Operator,
    Wrong::Clamp,
    Wrong::Factor,
    Wrong::Channels,
    Wrong::Inverted,
    Wrong::Sides,
];

/// Methods for which a kind of mistake changes no result anywhere, and why.
const NOT_CAUGHT: [(&str, Wrong, &str); 4] = [
    (
        "iridescence_khr",
        Wrong::Clamp,
        "it is exempt from the contract, and is tried between 0 and 1 only",
    ),
    (
        "empirical",
        Wrong::Clamp,
        "below 0 and above 1 the guarded power and the clamp of the result give what the clamp of the cosine gives",
    ),
    (
        "empirical",
        Wrong::Channels,
        "it is grey: its channels are one number",
    ),
    (
        "schlick_ior",
        Wrong::Inverted,
        "reflectance at normal incidence is the same from either side: ((1 - eta) / (1 + eta))^2",
    ),
];

/// The mutants of a function: for each kind the first place at which it changes a result by more than rounding may.
fn mutants(trial: &Trial) -> Vec<(Wrong, Option<Checked>)> {
    let original: &Function = &trial.function;
    let can_be =
        |wrong: &Wrong| (0..original.nodes.len()).any(|id| changed(original, id, *wrong).is_some());
    let mutant = |wrong: Wrong| {
        let places = 0..original.nodes.len();
        let all = places
            .filter_map(|id| changed(original, id, wrong))
            .map(well_formed);
        (
            wrong,
            all.into_iter().find(|function| differs(trial, function)),
        )
    };
    ALL.into_iter().filter(can_be).map(mutant).collect()
}

/// Whether a function gives other results than the trial's, in f64.
fn differs(trial: &Trial, function: &Checked) -> bool {
    let other = Trial {
        function: function.clone(),
        ..trial.clone()
    };
    let points = points(trial);
    let [want, got] = [trial, &other].map(|trial| trial.run::<f64>(&points));
    (0..points.len()).any(|i| {
        let pairs = want.at(i).into_iter().zip(got.at(i));
        pairs
            .into_iter()
            .any(|(want, got)| (want - got).is_nan() || (want - got).abs() > 2.0 * ABSOLUTE_FLOOR)
    })
}

/// The cosines of a trial.
fn points(trial: &Trial) -> Vec<f32> {
    let mut points = cosines_around(POINTS, &[]);
    points.extend(beyond());
    points.retain(|c| trial.is_guarded || (1e-6..=1.0).contains(c));
    points
}

/// The function with this done to a node, where it can be.
fn changed(original: &Function, id: NodeId, wrong: Wrong) -> Option<Function> {
    let mut function = original.clone();
    let node = original.nodes[id].clone();
    match (wrong, node.op, node.payload) {
        // The smallest numbers guard divisions.
        (Wrong::Constant, Op::Number, Payload::Number(value)) if value.abs() > 1e-6 => {
            function.nodes[id].payload = Payload::Number(value * 1.01);
        }
        (Wrong::Operator, Op::Add, _) => function.nodes[id].op = Op::Sub,
        (Wrong::Operator, Op::Sub, _) => function.nodes[id].op = Op::Add,
        (Wrong::Operator, Op::Mul, _) => function.nodes[id].op = Op::Add,
        (Wrong::Clamp, Op::Saturate, _) => replace(&mut function, id, node.args[0]),
        // One factor less: an exponent of 4 for 5.
        (Wrong::Factor, Op::Mul, _) if original.nodes[node.args[0]].ty == node.ty => {
            replace(&mut function, id, node.args[0]);
        }
        (Wrong::Channels, _, _) if id == original.result && node.ty == Ty::Vec3 => {
            swap(&mut function)
        }
        (Wrong::Inverted, Op::Param, Payload::Index(index)) => {
            let name = original.params[index].name.as_str();
            if !["eta", "n", "ior", "f0", "reflectivity", "warp"].contains(&name) {
                return None;
            }
            invert(&mut function, id);
        }
        (Wrong::Sides, Op::Select, _) => function.nodes[id].args.swap(1, 2),
        _ => return None,
    }
    Some(function)
}

/// Whoever used one node uses another.
fn replace(function: &mut Function, id: NodeId, other: NodeId) {
    for node in &mut function.nodes {
        for argument in node.args.iter_mut().filter(|argument| **argument == id) {
            *argument = other;
        }
    }
    if function.result == id {
        function.result = other;
    }
}

fn node(op: Op, args: &[NodeId], payload: Payload, ty: Ty) -> Node {
    Node {
        op,
        args: args.to_vec(),
        payload,
        ty,
        label: None,
    }
}

/// Red and green change places.
fn swap(function: &mut Function) {
    let (result, next) = (function.result, function.nodes.len());
    for channel in [1, 0, 2] {
        let taken = node(Op::Channel, &[result], Payload::Index(channel), Ty::Scalar);
        function.nodes.push(taken);
    }
    let all = [next, next + 1, next + 2];
    function
        .nodes
        .push(node(Op::Compose, &all, Payload::None, Ty::Vec3));
    function.result = next + 3;
}

/// 1 over an argument in its place.
fn invert(function: &mut Function, id: NodeId) {
    let ty = function.nodes[id].ty;
    let shift = |other: NodeId| if other > id { other + 2 } else { other };
    for node in &mut function.nodes {
        node.args
            .iter_mut()
            .for_each(|argument| *argument = shift(*argument));
    }
    function.result = if function.result == id {
        id + 2
    } else {
        shift(function.result)
    };
    function.nodes.insert(
        id + 1,
        node(Op::Number, &[], Payload::Number(1.0), Ty::Scalar),
    );
    function
        .nodes
        .insert(id + 2, node(Op::Div, &[id + 1, id], Payload::None, ty));
    for node in function.nodes.iter_mut().skip(id + 3) {
        for argument in node.args.iter_mut().filter(|argument| **argument == id) {
            *argument = id + 2;
        }
    }
}

/// The function with only what it needs, and names where the printer wants them.
fn well_formed(function: Function) -> Checked {
    let mut function = function.compact();
    let uses = function.uses();
    for (id, node) in function.nodes.iter_mut().enumerate() {
        if uses[id] > 1 && node.label.is_none() && node.ty != Ty::Bool && !node.is_leaf() {
            node.label = Some(Label {
                name: format!("part_{id}"),
                why: String::new(),
            });
        }
    }
    check(function).unwrap()
}

/// The function of a method with a material's values.
fn trial(emitted: &EmittedFunction, subject: &MaterialInMedium) -> Trial {
    let values = values_for_material(subject, emitted.method);
    let inputs = emitted
        .method
        .inputs
        .iter()
        .filter(|input| input.ty != Ty::Texture);
    let guarded = emitted.method.contract == Contract::Kept;
    Trial {
        function: emitted.function.clone(),
        values: inputs
            .map(|input| values[input.name].map(|value| value as f32))
            .collect(),
        table: fit::table_of(&emitted.function, |c| subject.reference.at(c)),
        bound: if guarded {
            Measured::Yes(emitted.method.claims.code_ulp)
        } else {
            Measured::No("it promises nothing".to_owned())
        },
        // What films promise is held elsewhere: near grazing their fringes are narrower than a cosine's rounding.
        floor: match emitted.method.class.is_of_films() {
            true => ABSOLUTE_FLOOR,
            false => emitted.method.claims.code_abs.max(ABSOLUTE_FLOOR),
        },
        is_guarded: guarded,
    }
}

/// Whether a function's text, run on a target, is found to be another than the trial's.
fn is_caught(
    devices: &Devices,
    target: &str,
    trial: &Trial,
    emitted: &EmittedFunction,
) -> Result<bool, Fault> {
    let target = targets::find(target).unwrap();
    let files = emit::library(
        target,
        emitted.method,
        std::slice::from_ref(emitted),
        emit::Heading::default(),
    )
    .unwrap();
    let shown = ShippedFunction {
        target,
        bytes: &files.last().unwrap().bytes,
        function: emitted,
        entry: "main",
    };
    let runnable = devices.prepare(&shown, ExecutionPath::Own, trial)?;
    let expected = trial.expected(&points(trial));
    let got = runnable.run(trial, &expected.cosines)?;
    Ok(expected.judge(&got).miss.is_some())
}

fn emitted(method: &'static Method) -> EmittedFunction {
    emit::library_functions(method, &Naming::default())
        .unwrap()
        .remove(0)
}

#[track_caller]
fn check_target(target: &str) {
    let devices = Devices::new(Wanted::default());
    let subjects = subjects(&["gold", "diamond"]);
    let mut escaped = Vec::new();
    let mut count = 0;
    for method in methods::all_variants() {
        let (glass, metal) = (&subjects[0], &subjects[1]);
        let subject = if method.class == Class::Dielectric {
            glass
        } else {
            metal
        };
        let right = emitted(method);
        let trial = trial(&right, subject);
        match is_caught(&devices, target, &trial, &right) {
            Err(Fault::Absent(why)) => {
                assert!(
                    std::env::var_os("CI").is_none(),
                    "not checked: mutants in {target}: {why}"
                );
                return not_checked(&format!("mutants in {target}: {why}"));
            }
            result => assert_eq!(
                result,
                Ok(false),
                "{}: what is right is no mutant",
                method.name
            ),
        }
        for (wrong, function) in mutants(&trial) {
            let known = NOT_CAUGHT
                .iter()
                .any(|(name, kind, _)| *name == method.name && *kind == wrong);
            let caught = function.is_some_and(|function| {
                let mutant = EmittedFunction {
                    function,
                    ..right.clone()
                };
                // What a compiler refuses is caught too.
                is_caught(&devices, target, &trial, &mutant).unwrap_or(true)
            });
            count += 1;
            if caught == known {
                let word = if caught {
                    "is caught after all"
                } else {
                    "escapes"
                };
                escaped.push(format!("{} {wrong:?} {word}", method.name));
            }
        }
    }
    assert!(count > 60, "{count} mutants");
    assert!(escaped.is_empty(), "{target}: {}", escaped.join(", "));
}

#[test]
fn mutants_are_caught_in_wgsl() {
    check_target(TARGETS[0]);
}

#[test]
fn mutants_are_caught_in_spirv() {
    check_target(TARGETS[1]);
}

#[test]
fn mutants_are_caught_in_gles() {
    check_target(TARGETS[2]);
}

#[test]
fn mutants_are_caught_in_hlsl() {
    check_target(TARGETS[3]);
}
