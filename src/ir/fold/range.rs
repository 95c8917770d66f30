//! Ranges: what the values of a function can reach at all, and what that decides.

use crate::ir::build::Expr;
use crate::ir::evaluate::{Column, Value, evaluate_nodes};
use crate::ir::graph::{Function, Node, Ty};
use crate::ir::op::Op;
use crate::num::{Interval, Truth};

/// A guard or a comparison is dropped only where the ranges are apart by this share of their size, so that
/// rounding in f32 (6e-8) or f16 (5e-4) cannot bring the other side about.
const MARGIN: f64 = 1e-3;
/// Into how many parts [0, 1] is cut to find ranges.
const PIECES: usize = 64;

/// The range of every node, over pieces that together cover all inputs: the first argument, if it is a scalar, is cut
/// so that what depends on it twice (`r c² + (1-c²)²`) keeps a narrow range in each piece.
pub fn ranges(function: &Function) -> Vec<Value<Interval>> {
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

/// What the ranges decide: which side of a select, whether a guard acts, which sign an absolute value sees.
pub fn decided<'b>(node: &Node, args: &[Expr<'b>], ranges: &[Value<Interval>]) -> Option<Expr<'b>> {
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
