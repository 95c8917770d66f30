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

use super::build::{Builder, Expr};
use super::check::wants_name;
use super::evaluate::{Column, Value, apply, evaluate_nodes};
use super::graph::{Function, Label, Node, NodeId};
use super::op::{Op, Payload, Signature, Ty};
use crate::physics::num::{Interval, Precision, each_channel};

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
    // What was specialised before may have such names.
    let labels = function.nodes.iter().filter_map(|node| node.label.as_ref());
    let taken: Vec<String> = labels.map(|label| label.name.clone()).collect();
    let free = (1..)
        .map(|i| format!("part_{i}"))
        .filter(|name| !taken.contains(name));
    for (id, name) in unnamed.into_iter().zip(free) {
        function.nodes[id].label = Some(Label {
            name,
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

/// The identities that constants make trivial.
fn identity<'b>(builder: &'b Builder, node: &Node, args: &[Expr<'b>]) -> Option<Expr<'b>> {
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

/// Merges the constants of a product: `(a + b x) c = ac + bc x` and `(b x) c = bc x`. Division by a constant becomes a
/// product. Each saves one operation, and a product is merged only where nothing else uses the inner step.
/// The terms of every such sum here have one sign. If `a + b x` cancelled, `ac + bc x` would round differently.
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

/// The number in all channels of a constant expression, where they are equal.
fn uniform_of(expr: Expr) -> Option<f64> {
    let [red, green, blue] = value_of(expr.builder(), expr.id())?.at(0);
    (red == green && green == blue).then_some(red)
}

/// A guard or a comparison is dropped only where the ranges are apart by this share of the largest number in either.
/// Then f32 rounding (6e-8) cannot change the outcome, even in a difference whose terms nearly cancel.
const MARGIN: f64 = 1e-3;
/// The same for f16, whose rounding is 8000 times as coarse (5e-4).
const HALF_MARGIN: f64 = 1.0 / 32.0;
/// The number of parts that [0, 1] is cut into to find ranges.
const PIECES: usize = 64;

/// The range of every node, over pieces that together cover all inputs. The first argument, if it is a scalar, is cut
/// into pieces, so that an expression that uses it twice (`r c² + (1-c²)²`) keeps a narrow range in each.
fn ranges(function: &Function) -> Vec<Value<Interval>> {
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
fn decided<'b>(
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
    if let (Some(a), Some(b)) = (single_value(a), single_value(b)) {
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
fn single_value(range: &Value<Interval>) -> Option<f64> {
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
