//! What each function states of its error, in both directions, and that it gives numbers at the ends of its domain.

use fresnel_gen::generator::emit::{EffectRequest, EmittedFunction, Naming};
use fresnel_gen::generator::fit::Measured;
use fresnel_gen::lab::verify::effect_trial::EffectTrial;
use fresnel_gen::language::effects;
use fresnel_gen::language::ir::{Checked, Function, NodeId, Op, Payload, check};
use fresnel_gen::language::methods;

/// Every function of every effect in its usual form.
fn functions() -> Vec<EmittedFunction> {
    let method = methods::find(effects::USUAL_METHOD).expect("a method");
    let of = |effect: &&'static effects::Effect| {
        let request = EffectRequest {
            effect,
            method,
            subject: None,
        };
        request.functions(&Naming::default()).expect("well formed")
    };
    effects::ALL.iter().flat_map(of).collect()
}

/// The trial of a function with R for water, diamond, and from within diamond.
fn trial(emitted: &EmittedFunction) -> EffectTrial {
    let value = |n: f64| vec![("eta".to_owned(), [n, n * 1.01, n * 1.02])];
    let part = emitted.effect.expect("a function of an effect");
    EffectTrial::new(
        emitted,
        part,
        &[value(1.33), value(2.42), value(1.0 / 2.42)],
    )
}

/// What a function states of its error, with that of R.
fn stated(emitted: &EmittedFunction) -> f64 {
    match &emitted.code {
        Measured::Yes(bound) => bound.value(),
        Measured::No(why) => panic!("{}: {why}", emitted.name),
    }
}

#[test]
fn single_precision_is_as_exact_as_is_stated_and_not_far_better() {
    /// Below this nothing is gained by stating less: two last places of 1.
    const LEAST: f64 = 2e-7;
    let mut faults = String::new();
    for emitted in functions() {
        let trial = trial(&emitted);
        let outcome = trial.judge(&trial.in_single());
        let stated = stated(&emitted);
        // What R adds is a claim of its method.
        let own = emitted.effect.expect("of an effect").function.code_abs;
        let is_slack = own > LEAST && outcome.max_abs < own / 8.0;
        if outcome.max_abs > stated || is_slack {
            let (name, error) = (&emitted.name, outcome.max_abs);
            faults += &format!("{name}: {error:e}, stated {stated:e}: {}\n", outcome.worst);
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

/// A mistake, and the step of the function that it was made in.
fn mutants(original: &Checked) -> Vec<(String, Function)> {
    let changed = |id: NodeId| {
        let mut function: Function = (**original).clone();
        let node = original.nodes[id].clone();
        match (node.op, node.payload) {
            // The smallest numbers guard divisions.
            (Op::Number, Payload::Number(value)) if value.abs() > 1e-6 => {
                function.nodes[id].payload = Payload::Number(value * 1.01 + 1e-3);
            }
            (Op::Add, _) => function.nodes[id].op = Op::Sub,
            (Op::Sub, _) => function.nodes[id].op = Op::Add,
            (Op::Mul, _) => function.nodes[id].op = Op::Add,
            (Op::Div, _) => function.nodes[id].op = Op::Mul,
            (Op::Select, _) => function.nodes[id].args.swap(1, 2),
            (Op::Min, _) => function.nodes[id].op = Op::Max,
            (Op::Max, _) => function.nodes[id].op = Op::Min,
            _ => return None,
        }
        let value = match original.nodes[id].payload {
            Payload::Number(value) => format!("{value}"),
            _ => String::new(),
        };
        Some((format!("step {id}, {:?} {value}", node.op), function))
    };
    (0..original.nodes.len()).filter_map(changed).collect()
}

/// Mistakes that change nothing: the number that is another one, in how many functions, and why.
const EQUAL: [(&str, usize, &str); 2] = [
    (
        "-1",
        5,
        "refraction marks what does not meet the surface by a negative number, whichever",
    ),
    (
        "0.5",
        1,
        "a squared length is 0 or 1, and any number between tells them apart",
    ),
];

/// A function with one thing wrong is caught by the points that `verify` runs.
#[test]
fn a_function_with_one_thing_wrong_is_caught() {
    let (mut missed, mut count) = (String::new(), 0);
    for emitted in functions() {
        let trial_of_it = trial(&emitted);
        for (what, function) in mutants(&emitted.function) {
            let Ok(function) = check(function) else {
                continue;
            };
            count += 1;
            let wrong = EmittedFunction {
                function,
                ..emitted.clone()
            };
            let outcome = trial_of_it.judge(&trial(&wrong).in_single());
            if outcome.max_abs <= stated(&emitted) {
                missed += &format!("{}, {what}: {:e}\n", emitted.name, outcome.max_abs);
            }
        }
    }
    assert!(count > 100, "{count} mutants");
    for (number, mutants, why) in EQUAL {
        let of_it = missed
            .lines()
            .filter(|line| line.contains(&format!("Number {number}:")));
        assert_eq!(of_it.count(), mutants, "{why}:\n{missed}");
    }
    let expected: usize = EQUAL.iter().map(|(_, mutants, _)| mutants).sum();
    assert_eq!(missed.lines().count(), expected, "of {count}:\n{missed}");
}
