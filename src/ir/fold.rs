//! Constant folding and specialising: what a material's constants leave of a method.
//!
//! A function is rebuilt node by node until nothing changes. Each node is, in this order: computed in f64 where
//! its arguments are constants; dropped where the *range* of its arguments decides it (a comparison that always
//! holds, a guard that never acts), ranges being intervals from an evaluation of the whole function; or
//! rewritten by an identity of [`identity`]. Equal nodes are shared by the builder.
//!
//! The only algebra is what constants make trivial. `0 x = 0` is used: no formula here relies on infinities.

use std::collections::BTreeMap;

use crate::num::{Interval, Truth};

use super::build::{Builder, Expr};
use super::evaluate::{Column, Value, apply, evaluate_nodes};
use super::graph::{Function, Node, NodeId, Ty};
use super::op::{Op, Payload, Signature};

/// A guard or a comparison is dropped only where the ranges are apart by this share of their size, so that
/// rounding in f32 (6e-8) or f16 (5e-4) cannot bring the other side about.
const MARGIN: f64 = 1e-3;
/// Into how many parts [0, 1] is cut to find ranges.
const PIECES: usize = 64;

/// The function with these arguments fixed (a scalar argument takes the first number), folded.
/// Arguments that are not named stay.
pub fn specialise(function: &Function, constants: &BTreeMap<String, [f64; 3]>) -> Function {
    let builder = Builder::new();
    let arguments: Vec<Expr> = function
        .params
        .iter()
        .map(|param| match (constants.get(&param.name), param.ty) {
            (Some(value), Ty::Rgb) => builder.colour(*value),
            (Some(value), _) => builder.number(value[0]),
            (None, ty) => builder.param(&param.name, ty),
        })
        .collect();
    fold(&rebuild(function, &builder, &arguments, |_, _, _| None))
}

/// The function with all that is constant or decided taken out.
pub fn fold(function: &Function) -> Function {
    let mut current = function.compact();
    loop {
        let next = pass(&current);
        if next == current {
            return next;
        }
        current = next;
    }
}

fn pass(function: &Function) -> Function {
    let ranges = ranges(function);
    let uses = function.uses();
    let builder = Builder::new();
    let params: Vec<Expr> = function
        .params
        .iter()
        .map(|param| builder.param(&param.name, param.ty))
        .collect();
    rebuild(function, &builder, &params, |id, node, args| {
        constant(&builder, node, args)
            .or_else(|| decided(node, args, &ranges))
            .or_else(|| identity(&builder, node, args))
            .or_else(|| spread(&builder, node, args))
            .or_else(|| merged(&builder, function, &uses, id, args))
    })
}

/// The range of every node, over pieces that together cover all inputs: the first argument, if it is a scalar, is cut
/// so that what depends on it twice (`r c² + (1-c²)²`) keeps a narrow range in each piece.
fn ranges(function: &Function) -> Vec<Value<Interval>> {
    let whole = |ty: Ty| match ty {
        Ty::Rgb => Value::Rgb([0, 1, 2].map(|_| Column::Same(Interval::EVERYTHING))),
        _ => Value::Scalar(Column::Same(Interval::EVERYTHING)),
    };
    let mut arguments: Vec<Value<Interval>> = function
        .params
        .iter()
        .map(|param| whole(param.ty))
        .collect();
    if let Some(first) = arguments
        .first_mut()
        .filter(|_| function.params[0].ty == Ty::Scalar)
    {
        *first = Value::Scalar(Column::Each(pieces()));
    }
    evaluate_nodes(function, &arguments)
}

/// Everything below 0, [0, 1] in equal parts, everything above 1.
fn pieces() -> Vec<Interval> {
    let part = |i: usize| i as f64 / PIECES as f64;
    let inside = (0..PIECES).map(|i| Interval::new(part(i), part(i + 1)));
    let outside = [
        Interval::new(f64::NEG_INFINITY, 0.0),
        Interval::new(1.0, f64::INFINITY),
    ];
    outside.into_iter().chain(inside).collect()
}

/// Copies a function into a builder. `rewrite` may offer another expression for a node.
fn rebuild<'b>(
    function: &Function,
    builder: &'b Builder,
    arguments: &[Expr<'b>],
    rewrite: impl Fn(NodeId, &Node, &[Expr<'b>]) -> Option<Expr<'b>>,
) -> Function {
    let mut exprs: Vec<Expr<'b>> = Vec::new();
    for (id, node) in function.nodes.iter().enumerate() {
        let args: Vec<Expr<'b>> = node.args.iter().map(|a| exprs[*a]).collect();
        let expr = match (node.op, node.payload) {
            (Op::Param, Payload::Index(index)) => arguments[index],
            _ => rewrite(id, node, &args).unwrap_or_else(|| copy(builder, node, &args)),
        };
        if let Some(label) = node
            .label
            .as_ref()
            .filter(|_| !builder.node(expr.id()).is_leaf())
        {
            expr.named(&label.name, &label.why);
        }
        exprs.push(expr);
    }
    builder.finish(&function.name, exprs[function.result])
}

fn copy<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Expr<'b> {
    let ids: Vec<NodeId> = args.iter().map(|arg| arg.id()).collect();
    builder.push(node.op, &ids, node.payload)
}

/// The value of a constant expression: a number, or a colour of numbers.
fn value_of(builder: &Builder, id: NodeId) -> Option<Value<f64>> {
    let node = builder.node(id);
    let number = |id: &NodeId| match builder.node(*id).payload {
        Payload::Number(value) => Some(value),
        _ => None,
    };
    match (node.op.info().signature, node.args.as_slice()) {
        (Signature::Number, _) => number(&id).map(Value::scalar),
        (Signature::Splat, [a]) => number(a).map(|value| Value::rgb([value; 3])),
        (Signature::Compose, [r, g, b]) => Some(Value::rgb([number(r)?, number(g)?, number(b)?])),
        _ => None,
    }
}

/// The number in all channels of a constant expression, where they agree.
fn uniform_of(expr: Expr) -> Option<f64> {
    let [red, green, blue] = value_of(expr.builder(), expr.id())?.at(0);
    (red == green && green == blue).then_some(red)
}

fn constant<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    // Compose and splat of numbers *are* how a constant colour is written.
    if node.is_leaf() || matches!(node.op, Op::Compose | Op::Splat | Op::Less) {
        return None;
    }
    if node.op == Op::Select {
        return None;
    }
    let values: Vec<Value<f64>> = args
        .iter()
        .map(|arg| value_of(builder, arg.id()))
        .collect::<Option<_>>()?;
    let same = node.args.len() == 2 && node.args[0] == node.args[1];
    let places = if same {
        vec![0, 0]
    } else {
        (0..node.args.len()).collect()
    };
    let value = apply(
        &Node {
            args: places,
            ..node.clone()
        },
        &values,
        &[],
    );
    let channels = value.at(0);
    if !channels.iter().all(|channel| channel.is_finite()) {
        return None;
    }
    Some(if node.ty == Ty::Rgb {
        builder.colour(channels)
    } else {
        builder.number(channels[0])
    })
}

/// What the ranges decide: which side of a select, whether a guard acts, which sign an absolute value sees.
fn decided<'b>(node: &Node, args: &[Expr<'b>], ranges: &[Value<Interval>]) -> Option<Expr<'b>> {
    let zero = Value::scalar(0.0);
    let range = |i: usize| &ranges[node.args[i]];
    match node.op {
        Op::Select => match verdict(range(0)) {
            Truth::Yes => Some(args[1]),
            Truth::No => Some(args[2]),
            Truth::Either => None,
        },
        Op::Max if apart(range(1), range(0)) => Some(args[0]),
        Op::Max if apart(range(0), range(1)) => Some(args[1]),
        Op::Min if apart(range(0), range(1)) => Some(args[0]),
        Op::Min if apart(range(1), range(0)) => Some(args[1]),
        Op::Abs if apart(range(0), &zero) => Some(-args[0]),
        Op::Abs if apart(&zero, range(0)) => Some(args[0]),
        _ => None,
    }
}

/// What a comparison answers in all pieces.
fn verdict(range: &Value<Interval>) -> Truth {
    let Value::Bool(answers) = range else {
        return Truth::Either;
    };
    let first = answers.at(0);
    if answers.all(|answer| answer == first) {
        first
    } else {
        Truth::Either
    }
}

/// Whether `low` stays below `high` in every channel and piece, by more than rounding can bridge.
fn apart(low: &Value<Interval>, high: &Value<Interval>) -> bool {
    let below = |low: Interval, high: Interval| {
        low.hi() < high.lo() - MARGIN * low.hi().abs().max(high.lo().abs())
    };
    (0..3).all(|i| low.channel(i).all_with(high.channel(i), below))
}

/// The identities that constants make trivial.
fn identity<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    let is = |i: usize, wanted: f64| args.get(i).and_then(|arg| uniform_of(*arg)) == Some(wanted);
    let shaped = |expr: Expr<'b>| if node.ty == Ty::Rgb { expr.rgb() } else { expr };
    match node.op {
        Op::Add if is(0, 0.0) => Some(shaped(args[1])),
        Op::Add | Op::Sub if is(1, 0.0) => Some(shaped(args[0])),
        Op::Sub if is(0, 0.0) => Some(-shaped(args[1])),
        Op::Mul if is(0, 1.0) => Some(shaped(args[1])),
        Op::Mul | Op::Div if is(1, 1.0) => Some(shaped(args[0])),
        Op::Mul if is(0, 0.0) || is(1, 0.0) => Some(shaped(builder.number(0.0))),
        Op::Div if is(0, 0.0) => Some(shaped(builder.number(0.0))),
        Op::Add => negated(builder, args[1]).map(|positive| args[0] - positive),
        Op::Div => inverse_root(builder, node, args),
        Op::Min if is(1, 1.0) => saturated(builder, args[0]),
        Op::Select if args[1].id() == args[2].id() => Some(args[1]),
        Op::Channel => part(builder, node, args[0]),
        Op::Compose => whole(builder, args),
        _ => None,
    }
}

/// x, where the expression is -x.
fn negated<'b>(builder: &'b Builder, expr: Expr<'b>) -> Option<Expr<'b>> {
    let node = builder.node(expr.id());
    (node.op == Op::Neg && node.label.is_none()).then(|| builder.expr(node.args[0]))
}

/// `a / √x = a · (1/√x)`, one operation less.
fn inverse_root<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    let root = builder.node(args[1].id());
    let fits = root.op == Op::Sqrt && root.ty == node.ty;
    fits.then(|| args[0] * builder.expr(root.args[0]).inverse_sqrt())
}

/// `min(max(x, 0), 1)` is the saturation of x, which GPUs do for nothing.
fn saturated<'b>(builder: &'b Builder, inner: Expr<'b>) -> Option<Expr<'b>> {
    let node = builder.node(inner.id());
    let is_floor = node.op == Op::Max && uniform_of(builder.expr(node.args[1])) == Some(0.0);
    is_floor.then(|| builder.expr(node.args[0]).saturate())
}

/// `channel` of a colour that was just composed, or spread from a scalar.
fn part<'b>(builder: &'b Builder, node: &Node, colour: Expr<'b>) -> Option<Expr<'b>> {
    let Payload::Index(index) = node.payload else {
        return None;
    };
    let inner = builder.node(colour.id());
    match inner.op {
        Op::Splat => Some(builder.expr(inner.args[0])),
        Op::Compose => Some(builder.expr(inner.args[index])),
        _ => None,
    }
}

/// `compose` of the three channels of one colour, or of one scalar three times.
fn whole<'b>(builder: &'b Builder, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    if args[0].id() == args[1].id() && args[1].id() == args[2].id() {
        return Some(args[0].rgb());
    }
    let nodes = [0, 1, 2].map(|i| builder.node(args[i].id()));
    let channels =
        (0..3).all(|i| nodes[i].op == Op::Channel && nodes[i].payload == Payload::Index(i));
    let source = nodes[0].args.first().copied()?;
    (channels && nodes.iter().all(|n| n.args[0] == source)).then(|| builder.expr(source))
}

/// A scalar that was spread over three channels stays a scalar as long as it can.
fn spread<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    let narrow: Vec<Expr<'b>> = args.iter().map(|arg| narrowed(builder, *arg)).collect();
    let changed = narrow.iter().zip(args).any(|(a, b)| a.id() != b.id());
    let all_scalar = narrow.iter().all(|arg| arg.ty() == Ty::Scalar);
    match node.op.info().signature {
        Signature::Mixed if changed && !all_scalar => Some(copy(builder, node, &narrow)),
        Signature::Mixed | Signature::Alike | Signature::Unary if changed && all_scalar => {
            Some(copy(builder, node, &narrow).rgb())
        }
        _ => None,
    }
}

fn narrowed<'b>(builder: &'b Builder, arg: Expr<'b>) -> Expr<'b> {
    let node = builder.node(arg.id());
    if node.op == Op::Splat {
        builder.expr(node.args[0])
    } else {
        arg
    }
}

/// Constants that meet in a product: `(a + b x) c = ac + bc x` and `(b x) c = bc x`; a quotient by a constant
/// is a product. One operation less each time, and only where the inner step serves nobody else.
fn merged<'b>(
    builder: &'b Builder,
    function: &Function,
    uses: &[usize],
    id: NodeId,
    args: &[Expr<'b>],
) -> Option<Expr<'b>> {
    let node = &function.nodes[id];
    let is_constant = |expr: Expr<'b>| value_of(builder, expr.id()).is_some();
    match node.op {
        Op::Div if is_constant(args[1]) => Some(args[0] * (1.0 / args[1])),
        Op::Mul => {
            let (inner, constant) = if is_constant(args[1]) {
                (0, args[1])
            } else {
                (1, args[0])
            };
            if !is_constant(constant) || uses[node.args[inner]] > 1 {
                return None;
            }
            scaled(builder, args[inner], constant)
        }
        _ => None,
    }
}

fn scaled<'b>(builder: &'b Builder, inner: Expr<'b>, constant: Expr<'b>) -> Option<Expr<'b>> {
    let node = builder.node(inner.id());
    let sides = || [0, 1].map(|i| builder.expr(node.args[i]));
    let is_constant = |expr: Expr<'b>| value_of(builder, expr.id()).is_some();
    match node.op {
        Op::Mul if sides().into_iter().any(is_constant) => {
            let [a, b] = sides();
            Some(if is_constant(a) {
                (a * constant) * b
            } else {
                (b * constant) * a
            })
        }
        Op::Add if is_constant(sides()[0]) => {
            let [a, b] = sides();
            Some(a * constant + scaled(builder, b, constant)?)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::text::{parse, print};
    use super::*;

    #[track_caller]
    fn check(input: &str, expected: &str) {
        let function = parse(input).expect("the case parses");
        assert_eq!(print(&fold(&function)).trim(), expected.trim());
    }

    #[test]
    fn constants_are_computed() {
        check(
            "fn f(x: scalar) -> scalar\n  a = mul 2 3\n  b = add a x\n  return b",
            "fn f(x: scalar) -> scalar\n  b = add 6 x\n  return b",
        );
    }

    #[test]
    fn a_comparison_that_always_holds_is_dropped() {
        check(
            "fn f(x: scalar) -> scalar\n  c = saturate x\n  t = sub c 2\n  l = less t 0\n  s = select l c t\n  return s",
            "fn f(x: scalar) -> scalar\n  c = saturate x\n  return c",
        );
    }

    #[test]
    fn a_guard_that_never_acts_is_dropped_and_one_that_may_stays() {
        check(
            "fn f(x: scalar) -> scalar\n  c = saturate x\n  t = add c 1\n  g = max t 1e-30\n  q = div c g\n  return q",
            "fn f(x: scalar) -> scalar\n  c = saturate x\n  t = add c 1\n  q = div c t\n  return q",
        );
        check(
            "fn f(x: scalar) -> scalar\n  c = saturate x\n  g = max c 1e-30\n  q = div 1 g\n  return q",
            "fn f(x: scalar) -> scalar\n  c = saturate x\n  g = max c 1e-30\n  q = div 1 g\n  return q",
        );
    }

    #[test]
    fn constants_merge_through_a_sum() {
        check(
            "fn f(x: scalar) -> scalar\n  a = mul 3 x\n  b = add 2 a\n  c = div b 4\n  return c",
            "fn f(x: scalar) -> scalar\n  %0 = mul 0.75 x\n  c = add 0.5 %0\n  return c",
        );
    }

    #[test]
    fn three_channels_of_one_colour_are_the_colour() {
        check(
            "fn f(x: rgb) -> rgb\n  r = channel 0 x\n  g = channel 1 x\n  b = channel 2 x\n  y = compose r g b\n  z = mul y 2\n  return z",
            "fn f(x: rgb) -> rgb\n  z = mul x 2\n  return z",
        );
    }
}
