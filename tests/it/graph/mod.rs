//! The graph, over all methods: its text form, its checker, its meaning in every kind of number.

mod fold;
mod text;

use self::text::parse;
use super::numbers::Dd;
use fresnel_gen::generator::fit;
use fresnel_gen::language::ir::{
    BrokenRule, Checked, Function, Label, Op, Payload, Ty, Value, check, evaluate, print,
};
use fresnel_gen::language::methods::{self, InHalf};
use fresnel_gen::physics::num::{Half, Num, Precision};

fn all_functions() -> Vec<Checked> {
    let colour = methods::ALL
        .iter()
        .map(|method| method.function(false).expect("well formed"));
    let scalar = methods::ALL
        .iter()
        .filter(|method| method.has_scalar_form());
    colour
        .chain(scalar.map(|method| method.function(true).expect("well formed")))
        .collect()
}

#[test]
fn the_text_form_prints_and_parses() {
    for function in all_functions() {
        let text = print(&function);
        let read = parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(print(&read), text);
        assert_eq!(read, *function, "{text}");
    }
}

/// Many points are evaluated in chunks; each comes out as it does alone.
#[test]
fn each_point_of_many_is_what_it_is_alone() {
    let cosines: Vec<f64> = (0..2500).map(|i| f64::from(i) / 2499.0).collect();
    for function in all_functions() {
        let values = |param: &fresnel_gen::language::ir::Param| match param.ty {
            Ty::Scalar => Value::scalar(0.4),
            Ty::Vec3 => Value::rgb([0.3, 0.7, 1.2]),
            _ => Value::Texture(None),
        };
        let mut arguments: Vec<Value<f64>> = function.params.iter().map(values).collect();
        let run = |arguments: &[Value<f64>], point| evaluate(&function, arguments).at(point);
        arguments[0] = Value::each(cosines.clone());
        let many = evaluate(&function, &arguments);
        for point in [0, 1, 1023, 1024, 1025, 2047, 2048, 2499] {
            arguments[0] = Value::scalar(cosines[point]);
            let (all, alone) = (many.at(point), run(&arguments, 0));
            let is_same = (0..3).all(|i| all[i].to_bits() == alone[i].to_bits());
            assert!(
                is_same,
                "{} at {point}: {all:?}, {alone:?}",
                print(&function)
            );
        }
    }
}

#[test]
fn a_text_that_is_wrong_names_its_line() {
    let cases = [
        ("", 1, "empty"),
        ("fn f(x) -> scalar\n  return x", 1, "expected"),
        (
            "fn f(x: scalar) -> scalar\n  y = pow x x\n  return y",
            2,
            "no such operation",
        ),
        (
            "fn f(x: scalar) -> scalar\n  y = add x\n  return y",
            2,
            "does not take",
        ),
        (
            "fn f(x: scalar) -> scalar\n  y = add x z\n  return y",
            2,
            "`z` is no",
        ),
        (
            "fn f(x: rgb) -> scalar\n  y = channel 3 x\n  return y",
            2,
            "the last is 2",
        ),
        (
            "fn f(x: rgb) -> scalar\n  y = add x 1\n  return y",
            3,
            "a rgb is returned",
        ),
        (
            "fn f(x: scalar) -> scalar\n  y = add x 1",
            2,
            "without `return`",
        ),
    ];
    for (text, line, says) in cases {
        let error = parse(text).expect_err(text);
        assert!(
            error.line == line && error.what.contains(says),
            "{text}: {error}"
        );
    }
}

fn mutated(change: impl Fn(&mut Function)) -> BrokenRule {
    let good = parse(
        "fn f(x: scalar, y: rgb) -> rgb\n  a = add x 1\n  b = mul a y\n  c = div b a\n  return c",
    )
    .expect("good");
    check(good.clone()).expect("it is well formed");
    let mut bad = good;
    change(&mut bad);
    check(bad).expect_err("a broken rule")
}

fn place(function: &Function, op: Op) -> usize {
    function
        .nodes
        .iter()
        .position(|node| node.op == op)
        .expect("it is there")
}

/// A way to break a function.
type Change = fn(&mut Function);

#[test]
fn each_rule_of_the_checker_can_be_broken() {
    let rules: [(usize, Change); 9] = [
        (1, |f| {
            let add = place(f, Op::Add);
            f.nodes[add].args[0] = add + 1;
        }),
        (2, |f| {
            let add = place(f, Op::Add);
            f.nodes[add].op = Op::Select;
        }),
        (3, |f| {
            let param = place(f, Op::Param);
            f.nodes[param].payload = Payload::Index(7);
        }),
        (4, |f| {
            let number = place(f, Op::Number);
            f.nodes[number].payload = Payload::Number(f64::NAN);
        }),
        (5, |f| {
            let add = place(f, Op::Add);
            f.nodes[add].label = Some(Label {
                name: "a__b".into(),
                why: String::new(),
            });
        }),
        (6, |f| {
            let mul = place(f, Op::Mul);
            f.nodes[mul].label = Some(Label {
                name: "x".into(),
                why: String::new(),
            });
        }),
        (7, |f| {
            f.params.push(fresnel_gen::language::ir::Param {
                name: "z".into(),
                ty: Ty::Bool,
            })
        }),
        (8, |f| f.result = place(f, Op::Mul)),
        (9, |f| {
            let add = place(f, Op::Add);
            f.nodes[add].label = None;
        }),
    ];
    assert_eq!(rules.len(), fresnel_gen::language::ir::RULES.len());
    for (rule, change) in rules {
        assert_eq!(mutated(change).rule, rule, "{}", mutated(change));
    }
}

/// A library function on one cosine, each input as usual in all channels.
fn run<N: Num>(function: &Checked, cos_theta: f64) -> f64 {
    let value = |name: &str| methods::find_input(name).expect("a method takes it").tried[0];
    let arguments = function
        .params
        .iter()
        .map(|param| match (param.name.as_str(), param.ty) {
            ("cos_theta", _) => Value::scalar(cos_theta),
            (_, Ty::Texture) => Value::Texture(Some(fit::texels(|c| [1.0 - 0.9 * c; 3]))),
            (name, Ty::Vec3) => Value::rgb([value(name); 3]),
            (name, _) => Value::scalar(value(name)),
        });
    evaluate::<N>(function, &arguments.collect::<Vec<_>>()).at(0)[0].to_f64()
}

/// The same function as it is built for half precision, whose constants are those of f16.
fn half_form(function: &Checked) -> Checked {
    let stem = function.name.trim_end_matches("_scalar");
    let method = methods::find(stem).expect("functions are named after methods");
    let scalar = function.name.ends_with("_scalar");
    let half = method.function_in(Precision::F16, scalar);
    half.expect("well formed")
}

/// A method that half precision refuses agrees with nothing there.
fn is_refused_in_half(function: &Checked) -> bool {
    let stem = function.name.trim_end_matches("_scalar");
    matches!(methods::find(stem).unwrap().half, InHalf::Refused(_))
}

#[test]
fn every_kind_of_number_agrees_within_its_precision() {
    for function in all_functions() {
        for cos_theta in [0.25, 0.5, 0.75, 1.0] {
            let reference = run::<Dd>(&function, cos_theta);
            let close = |value: f64, tolerance: f64| (value - reference).abs() <= tolerance;
            let name = &function.name;
            assert!(
                close(run::<f64>(&function, cos_theta), 1e-14),
                "{name} in f64"
            );
            assert!(
                close(run::<f32>(&function, cos_theta), 2e-6),
                "{name} in f32"
            );
            if is_refused_in_half(&function) {
                continue;
            }
            // The thin end of f16: the two methods that solve for n lose most.
            let half = if name == "conductor_from_f0_f82" {
                0.1
            } else {
                0.02
            };
            let got = run::<Half>(&half_form(&function), cos_theta);
            assert!(close(got, half), "{name} in f16: {got}");
        }
    }
}
