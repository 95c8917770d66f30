//! The algebra of folding: identities that constants make trivial, and products of constants.

use super::copy;
use crate::language::ir::build::{Builder, Expr};
use crate::language::ir::evaluate::Value;
use crate::language::ir::graph::{Function, Node, NodeId};
use crate::language::ir::op::{Op, Payload, Signature, Ty};
use crate::physics::num::each_channel;

/// The identities that constants make trivial.
pub fn identity<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    let is = |i: usize, wanted: f64| args.get(i).and_then(|arg| uniform_of(*arg)) == Some(wanted);
    let shaped = |expr: Expr<'b>| {
        if node.ty == Ty::Vec3 {
            expr.rgb()
        } else {
            expr
        }
    };
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
        Op::Sqrt => root_of_square(builder, args[0]),
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

/// `√(x x) = |x|`, which is left of a root whose other term vanished.
fn root_of_square<'b>(builder: &'b Builder, inner: Expr<'b>) -> Option<Expr<'b>> {
    let node = builder.node(inner.id());
    let is_square = node.op == Op::Mul && node.args[0] == node.args[1];
    is_square.then(|| builder.expr(node.args[0]).abs())
}

/// `min(max(x, 0), 1)` is `saturate(x)`, which is free on GPUs.
fn saturated<'b>(builder: &'b Builder, inner: Expr<'b>) -> Option<Expr<'b>> {
    let node = builder.node(inner.id());
    let is_floor = node.op == Op::Max && uniform_of(builder.expr(node.args[1])) == Some(0.0);
    is_floor.then(|| builder.expr(node.args[0]).saturate())
}

/// `channel` of a colour that was just composed, or splatted from a scalar.
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
    let nodes = each_channel(|i| builder.node(args[i].id()));
    let channels =
        (0..3).all(|i| nodes[i].op == Op::Channel && nodes[i].payload == Payload::Index(i));
    let source = nodes[0].args.first().copied()?;
    (channels && nodes.iter().all(|n| n.args[0] == source)).then(|| builder.expr(source))
}

/// A scalar that was splatted to three channels stays a scalar as long as it can.
pub fn spread<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
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

/// Merges the constants of a product: `(a + b x) c = ac + bc x` and `(b x) c = bc x`. Division by a constant becomes a
/// product. Each saves one operation, and a product is merged only where nothing else uses the inner step.
/// The terms of every such sum here have one sign. If `a + b x` cancelled, `ac + bc x` would round differently.
pub fn merged<'b>(
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

/// The value of a constant expression: a number, or a colour of numbers.
pub fn value_of(builder: &Builder, id: NodeId) -> Option<Value<f64>> {
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

/// The number in all channels of a constant expression, where they are equal.
fn uniform_of(expr: Expr) -> Option<f64> {
    let [red, green, blue] = value_of(expr.builder(), expr.id())?.at(0);
    (red == green && green == blue).then_some(red)
}
