//! Constant folding and specialising: what is left of a method once a material's constants are put in.
//!
//! A function is rebuilt node by node until nothing changes. For each node, the first of these that applies is done:
//! 1. where its arguments are constants, it is computed in f64;
//! 2. where the *range* of its arguments decides it (a comparison that always holds, a guard that never acts), it is
//!    dropped; ranges come from an interval evaluation of the whole function;
//! 3. where an identity of `identity` fits, it is rewritten.
//!
//! Equal nodes are shared by the builder.
//! The only algebra is what constants make trivial. `0 x = 0` is used: no formula here relies on infinities.
//! For half precision, ranges must lie further apart, and constants below its smallest normal number become 0, since
//! hardware may flush them.

use std::collections::BTreeMap;

mod identity;
mod range;

use super::build::{Builder, Expr};
use super::check::wants_name;
use super::evaluate::{Value, apply};
use super::graph::{Function, Label, Node, NodeId};
use super::op::{Op, Payload};
use crate::language::ir::op::Ty;
use crate::physics::num::Precision;
use identity::{identity, merged, spread, value_of};
use range::{decided, ranges};

/// The function with these arguments fixed, folded. A scalar argument takes the first of the three numbers.
/// Arguments that are not named stay.
pub fn specialise(function: &Function, constants: &BTreeMap<String, [f64; 3]>) -> Function {
    specialise_in(Precision::F32, function, constants)
}

/// The same for code in this precision. Constants are still folded in f64.
pub fn specialise_in(
    precision: Precision,
    function: &Function,
    constants: &BTreeMap<String, [f64; 3]>,
) -> Function {
    let builder = Builder::with_letters(function.letters);
    let arguments: Vec<Expr> = function
        .params
        .iter()
        .map(|param| match (constants.get(&param.name), param.ty) {
            (Some(value), Ty::Vec3) => builder.colour(*value),
            (Some(value), _) => builder.number(value[0]),
            (None, ty) => builder.param(&param.name, ty),
        })
        .collect();
    let fixed = rebuild(function, &builder, &arguments, |_, _, _| None);
    name_shared(without_needless_names(fold_in(precision, &fixed)))
}

/// The reason of a step that has a name only because it is used twice. Where folding leaves one use, the name is dropped.
pub const USED_TWICE: &str = "used twice";

fn without_needless_names(mut function: Function) -> Function {
    let uses = function.uses();
    for (node, uses) in function.nodes.iter_mut().zip(uses) {
        let is_needless = |label: &Label| uses < 2 && label.why == USED_TWICE;
        if node.label.as_ref().is_some_and(is_needless) {
            node.label = None;
        }
    }
    function
}

/// Names steps that folding made shared: two steps that were different and are now one.
fn name_shared(mut function: Function) -> Function {
    let uses = function.uses();
    let unnamed: Vec<NodeId> = (0..function.nodes.len())
        .filter(|id| wants_name(&function, *id, uses[*id]))
        .collect();
    for (count, id) in unnamed.into_iter().enumerate() {
        function.nodes[id].label = Some(Label {
            name: format!("part_{}", count + 1),
            why: String::new(),
        });
    }
    function
}

/// The function with everything that is constant or decided folded.
pub fn fold(function: &Function) -> Function {
    fold_in(Precision::F32, function)
}

/// The same for code in this precision.
pub fn fold_in(precision: Precision, function: &Function) -> Function {
    let mut current = function.compact();
    loop {
        let next = pass(precision, &current);
        if next != current {
            current = next;
        } else if !flush(precision, &mut current) {
            return current;
        }
    }
}

/// Sets constants to 0 that are subnormal in half precision. Returns whether there were any.
fn flush(precision: Precision, function: &mut Function) -> bool {
    let mut found = false;
    for node in function.nodes.iter_mut().filter(|_| precision.is_half()) {
        if let Payload::Number(value) = &mut node.payload {
            let is_small = *value != 0.0 && value.abs() < precision.smallest();
            if is_small {
                (*value, found) = (0.0, true);
            }
        }
    }
    found
}

fn pass(precision: Precision, function: &Function) -> Function {
    let ranges = ranges(function);
    let uses = function.uses();
    let builder = Builder::with_letters(function.letters);
    let params: Vec<Expr> = function
        .params
        .iter()
        .map(|param| builder.param(&param.name, param.ty))
        .collect();
    rebuild(function, &builder, &params, |id, node, args| {
        constant(&builder, node, args)
            .or_else(|| decided(precision, function, node, args, &ranges))
            .or_else(|| identity(&builder, node, args))
            .or_else(|| spread(&builder, node, args))
            .or_else(|| merged(&builder, function, &uses, id, args))
    })
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
        if let Some(label) = &node.label {
            name(builder, expr, label, node.op);
        }
        exprs.push(expr);
    }
    builder.finish(&function.name, exprs[function.result])
}

/// Gives a step its name. Where its channels have become equal, the name goes to the scalar that is left. A single
/// constant needs no name. What is left of a choice takes the choice's name, because its own describes a branch and the
/// branches are gone.
fn name(builder: &Builder, expr: Expr, label: &Label, op: Op) {
    let node = builder.node(expr.id());
    let scalar = if node.op == Op::Splat {
        builder.expr(node.args[0])
    } else {
        expr
    };
    let left = builder.node(scalar.id());
    if left.is_leaf() {
        return;
    }
    // A choice is one select, or a compose of one select for each channel.
    if matches!(op, Op::Select | Op::Compose) && left.op != op {
        scalar.renamed(label.clone());
    } else {
        scalar.named(&label.name, &label.why);
    }
}

fn copy<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Expr<'b> {
    let ids: Vec<NodeId> = args.iter().map(|arg| arg.id()).collect();
    builder.push(node.op, &ids, node.payload)
}

fn constant<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
    // Compose and splat of numbers *are* how a constant colour is written. Ranges decide comparisons and choices.
    let stays = matches!(node.op, Op::Compose | Op::Splat | Op::Less | Op::Select);
    if node.is_leaf() || stays {
        return None;
    }
    let values: Vec<Value<f64>> = args
        .iter()
        .map(|arg| value_of(builder, arg.id()))
        .collect::<Option<_>>()?;
    // Equal arguments have one place: `x x` is a square.
    let place = |arg| node.args.iter().position(|other| other == arg);
    let alone = Node {
        args: node.args.iter().map(place).collect::<Option<_>>()?,
        ..node.clone()
    };
    let channels = apply(&alone, &values, &[]).at(0);
    if !channels.iter().all(|channel| channel.is_finite()) {
        return None;
    }
    Some(if node.ty == Ty::Vec3 {
        builder.colour(channels)
    } else {
        builder.number(channels[0])
    })
}
