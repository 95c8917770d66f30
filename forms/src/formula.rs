//! Formulas as the e-graph holds them, from a graph and back.

use core::fmt;
use core::str::FromStr;
use std::collections::HashMap;

use egg::{Id, Language, RecExpr, Symbol, define_language};
use fresnel_gen::language::ir::{
    Builder, Checked, Expr, Function, Node, Op, Payload, Ty, check_in, fold_in,
};
use fresnel_gen::physics::num::Precision;

/// A number by its bits, so that it can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Number(u64);

impl Number {
    pub fn new(value: f64) -> Number {
        Number(value.to_bits())
    }

    pub fn value(self) -> f64 {
        f64::from_bits(self.0)
    }
}

impl fmt::Display for Number {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "{:?}", self.value())
    }
}

impl FromStr for Number {
    type Err = std::num::ParseFloatError;

    fn from_str(text: &str) -> Result<Number, Self::Err> {
        text.parse().map(Number::new)
    }
}

define_language! {
    pub enum Formula {
        Number(Number),
        "+" = Add([Id; 2]),
        "-" = Sub([Id; 2]),
        "*" = Mul([Id; 2]),
        "/" = Div([Id; 2]),
        "min" = Min([Id; 2]),
        "max" = Max([Id; 2]),
        "neg" = Neg(Id),
        "abs" = Abs(Id),
        "sat" = Saturate(Id),
        "sqrt" = Sqrt(Id),
        "rsqrt" = InverseSqrt(Id),
        "exp2" = Exp2(Id),
        "log2" = Log2(Id),
        Argument(Symbol),
    }
}

/// The expression of a graph. Steps of these names stay as they are.
///
/// # Errors
/// It has an operation that is not searched.
pub fn expression(graph: &Checked, kept: &[&str]) -> Result<RecExpr<Formula>, String> {
    let mut text = RecExpr::default();
    let mut ids: Vec<Id> = Vec::new();
    for node in &graph.nodes {
        let arg = |place: usize| ids[node.args[place]];
        let two = || [arg(0), arg(1)];
        let name = node.label.as_ref().map(|label| label.name.as_str());
        let kept = name.filter(|name| kept.contains(name));
        let formula = match (node.op, node.payload, kept) {
            (_, _, Some(name)) => Formula::Argument(name.into()),
            (Op::Number, Payload::Number(value), _) => Formula::Number(Number::new(value)),
            (Op::Param, Payload::Index(index), _) => {
                Formula::Argument(graph.params[index].name.as_str().into())
            }
            // A scalar beside a colour is applied to each channel.
            (Op::Splat, ..) => {
                ids.push(arg(0));
                continue;
            }
            (Op::Add, ..) => Formula::Add(two()),
            (Op::Sub, ..) => Formula::Sub(two()),
            (Op::Mul, ..) => Formula::Mul(two()),
            (Op::Div, ..) => Formula::Div(two()),
            (Op::Min, ..) => Formula::Min(two()),
            (Op::Max, ..) => Formula::Max(two()),
            (Op::Neg, ..) => Formula::Neg(arg(0)),
            (Op::Abs, ..) => Formula::Abs(arg(0)),
            (Op::Saturate, ..) => Formula::Saturate(arg(0)),
            (Op::Sqrt, ..) => Formula::Sqrt(arg(0)),
            (Op::InverseSqrt, ..) => Formula::InverseSqrt(arg(0)),
            (Op::Exp2, ..) => Formula::Exp2(arg(0)),
            (Op::Log2, ..) => Formula::Log2(arg(0)),
            (op, ..) => return Err(format!("{} is not searched", op.info().name)),
        };
        ids.push(text.add(formula));
    }
    // The root of an expression is its last node.
    let root = ids[graph.result];
    Ok(text[root].build_recexpr(|id| text[id].clone()))
}

/// What an operation gives of the steps before it; none of a leaf.
fn computed<'b>(operation: &Formula, of: impl Fn(&Id) -> Expr<'b>) -> Option<Expr<'b>> {
    Some(match operation {
        Formula::Argument(_) | Formula::Number(_) => return None,
        Formula::Add([a, b]) => of(a) + of(b),
        Formula::Sub([a, b]) => of(a) - of(b),
        Formula::Mul([a, b]) => of(a) * of(b),
        Formula::Div([a, b]) => of(a) / of(b),
        Formula::Min([a, b]) => of(a).min(of(b)),
        Formula::Max([a, b]) => of(a).max(of(b)),
        Formula::Neg(a) => -of(a),
        Formula::Abs(a) => of(a).abs(),
        Formula::Saturate(a) => of(a).saturate(),
        Formula::Sqrt(a) => of(a).sqrt(),
        Formula::InverseSqrt(a) => of(a).inverse_sqrt(),
        Formula::Exp2(a) => of(a).exp2(),
        Formula::Log2(a) => of(a).log2(),
    })
}

/// The graph of an expression, with the arguments, the type and the kept steps of another.
///
/// # Errors
/// It breaks a rule of the representation.
pub fn checked(text: &RecExpr<Formula>, like: &Checked) -> Result<Checked, String> {
    let builder = Builder::new();
    let mut named: HashMap<&str, Expr> = HashMap::new();
    for param in &like.params {
        named.insert(&param.name, builder.param(&param.name, param.ty));
    }
    let labels = like.nodes.iter().filter_map(|node| node.label.as_ref());
    let names: Vec<&str> = labels.map(|label| label.name.as_str()).collect();
    for name in names {
        let wanted = text
            .as_ref()
            .iter()
            .any(|one| matches!(one, Formula::Argument(word) if word.as_str() == name));
        if wanted {
            let own = of_step(like, name, &builder, &named)?;
            named.insert(name, own.named(name, ""));
        }
    }
    let result = built(text, &builder, &named, "t")?;
    let result = if like.ty() == Ty::Vec3 {
        result.rgb()
    } else {
        result
    };
    let whole = builder.finish(&like.name, result);
    check_in(Precision::F32, fold_in(Precision::F32, &whole)).map_err(|fault| fault.to_string())
}

/// A named step of a graph, built again.
fn of_step<'b>(
    like: &Checked,
    name: &str,
    builder: &'b Builder,
    named: &HashMap<&str, Expr<'b>>,
) -> Result<Expr<'b>, String> {
    let is_one = |node: &Node| node.label.as_ref().is_some_and(|label| label.name == name);
    let place = like
        .nodes
        .iter()
        .position(is_one)
        .ok_or("there is no such step")?;
    let part = Function {
        result: place,
        ..Function::clone(like)
    };
    let part = check_in(Precision::F32, part.compact()).map_err(|fault| fault.to_string())?;
    let text = expression(&part, &[])?;
    built(&text, builder, named, name)
}

/// The value of an expression. Its steps are named by a prefix and their place, since what is used twice needs a name.
fn built<'b>(
    text: &RecExpr<Formula>,
    builder: &'b Builder,
    named: &HashMap<&str, Expr<'b>>,
    prefix: &str,
) -> Result<Expr<'b>, String> {
    let mut steps: Vec<Expr> = Vec::new();
    for (place, formula) in text.as_ref().iter().enumerate() {
        let own = match formula {
            Formula::Argument(word) => *named.get(word.as_str()).ok_or("an argument is unknown")?,
            Formula::Number(number) => builder.number(number.value()),
            operation => {
                let of = |id: &Id| steps[usize::from(*id)];
                let own = computed(operation, of).ok_or("it is no operation")?;
                own.named(&format!("{prefix}{place}"), "")
            }
        };
        steps.push(own);
    }
    steps.pop().ok_or_else(|| "it is empty".to_owned())
}
