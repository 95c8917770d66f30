//! Ranges: which values each node of a function can have, and which choices and guards that decides.

use crate::language::ir::build::Expr;
use crate::language::ir::evaluate::{Column, Value, evaluate_nodes};
use crate::language::ir::graph::{Function, Node};
use crate::language::ir::op::{Op, Ty};
use crate::physics::num::{Interval, Precision, each_channel};

/// A guard or a comparison is dropped only where the ranges are apart by this share of the largest number in either.
/// Then f32 rounding (6e-8) cannot change the outcome, even in a difference whose terms nearly cancel.
const MARGIN: f64 = 1e-3;
/// The same for f16, whose rounding is 8000 times as coarse (5e-4).
const HALF_MARGIN: f64 = 1.0 / 32.0;
/// The number of parts that [0, 1] is cut into to find ranges.
const PIECES: usize = 64;

/// The range of every node, over pieces that together cover all inputs. The first argument, if it is a scalar, is cut
/// into pieces, so that an expression that uses it twice (`r c² + (1-c²)²`) keeps a narrow range in each.
pub fn ranges(function: &Function) -> Vec<Value<Interval>> {
    let whole = |ty: Ty| match ty {
        Ty::Vec3 => Value::Rgb(each_channel(|_| Column::Same(Interval::EVERYTHING))),
        Ty::Texture => Value::Texture(None),
        Ty::Cube => Value::Cube(None),
        Ty::Vec2 | Ty::Vec4 | Ty::Mat4 => {
            Value::Many(vec![Column::Same(Interval::EVERYTHING); ty.channels()])
        }
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

/// What the ranges decide: the side of a select, whether a guard acts, the sign inside an absolute value.
pub fn decided<'b>(
    precision: Precision,
    function: &Function,
    node: &Node,
    args: &[Expr<'b>],
    ranges: &[Value<Interval>],
) -> Option<Expr<'b>> {
    let zero = Value::scalar(0.0);
    let margin = if precision.is_half() {
        HALF_MARGIN
    } else {
        MARGIN
    };
    let apart = |low: &Value<Interval>, high: &Value<Interval>| apart(low, high, margin);
    let below = |a: usize, b: usize| apart(&ranges[node.args[a]], &ranges[node.args[b]]);
    match node.op {
        Op::Select => chosen(&function.nodes[node.args[0]], args, ranges, margin),
        Op::Max if below(1, 0) => Some(args[0]),
        Op::Max if below(0, 1) => Some(args[1]),
        Op::Min if below(0, 1) => Some(args[0]),
        Op::Min if below(1, 0) => Some(args[1]),
        Op::Abs if apart(&ranges[node.args[0]], &zero) => Some(-args[0]),
        Op::Abs if apart(&zero, &ranges[node.args[0]]) => Some(args[0]),
        _ => None,
    }
}

/// The side of a select that a comparison always takes.
fn chosen<'b>(
    less: &Node,
    args: &[Expr<'b>],
    ranges: &[Value<Interval>],
    margin: f64,
) -> Option<Expr<'b>> {
    let [a, b] = [0, 1].map(|i| &ranges[less.args[i]]);
    if let (Some(a), Some(b)) = (constant(a), constant(b)) {
        Some(if a < b { args[1] } else { args[2] })
    } else if apart(a, b, margin) {
        Some(args[1])
    } else if apart(b, a, margin) {
        Some(args[2])
    } else {
        None
    }
}

/// The number that a scalar equals exactly in all pieces, if there is one.
fn constant(range: &Value<Interval>) -> Option<f64> {
    match range {
        Value::Scalar(Column::Same(range)) if range.lo() == range.hi() => Some(range.lo()),
        _ => None,
    }
}

/// Whether `low` stays below `high` in every channel and piece, by more than rounding can close.
fn apart(low: &Value<Interval>, high: &Value<Interval>, margin: f64) -> bool {
    let below = |low: Interval, high: Interval| {
        let ends = [low.lo(), low.hi(), high.lo(), high.hi()];
        let size = ends
            .into_iter()
            .fold(0.0, |size: f64, end| size.max(end.abs()));
        low.hi() < high.lo() - margin * size
    };
    (0..3).all(|i| low.channel(i).all_with(high.channel(i), below))
}
