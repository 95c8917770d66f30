//! Evaluation of a function in any number type, node by node over whole columns of inputs.

use std::ops::Range;

use super::check::Checked;
use super::graph::{Function, Node, NodeId};
use super::op::{Op, Payload};
use super::texture::{CubeTexels, Texels, Weights};
use crate::physics::num::{Num, Truth, each_channel};

/// The numbers of all points: one for all, or one each.
#[derive(Clone, Debug, PartialEq)]
pub enum Column<T> {
    /// The same at every point.
    Same(T),
    /// One for each point.
    Each(Vec<T>),
}

/// The values of a node at all points.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<N> {
    /// One number a point.
    Scalar(Column<N>),
    /// Three numbers a point.
    Rgb([Column<N>; 3]),
    /// One truth value a point.
    Bool(Column<Truth>),
    /// The texels of a texture; none where they are unknown.
    Texture(Option<Texels>),
    /// The texels of a cube; likewise.
    Cube(Option<CubeTexels>),
    /// Two, four or sixteen numbers a point.
    Many(Vec<Column<N>>),
}

impl<T: Copy> Column<T> {
    /// The value at a point.
    #[inline]
    pub fn at(&self, point: usize) -> T {
        match self {
            Column::Same(value) => *value,
            Column::Each(values) => values[point],
        }
    }

    /// Whether this holds at every point for this and another column.
    #[inline]
    pub fn all_with(&self, other: &Column<T>, holds: impl Fn(T, T) -> bool) -> bool {
        match self.zip(other, &holds) {
            Column::Same(answer) => answer,
            Column::Each(answers) => answers.into_iter().all(|answer| answer),
        }
    }

    #[inline]
    fn part(&self, range: &Range<usize>) -> Column<T> {
        match self {
            Column::Same(value) => Column::Same(*value),
            Column::Each(values) => Column::Each(values[range.clone()].to_vec()),
        }
    }

    /// This column with the points of the next chunk appended.
    #[inline]
    fn joined(mut self, next: Column<T>) -> Column<T> {
        if let (Column::Each(values), Column::Each(next)) = (&mut self, next) {
            values.extend(next);
        }
        self
    }

    /// The number of points, where each has its own number; nothing where all share one.
    #[inline]
    fn points(&self) -> Option<usize> {
        match self {
            Column::Same(_) => None,
            Column::Each(values) => Some(values.len()),
        }
    }

    /// The loops of this and of `zip` use no iterator type that holds `f`, so each operation is compiled once for each number type.
    #[inline]
    fn map<U: Copy>(&self, f: &impl Fn(T) -> U) -> Column<U> {
        let values = match self {
            Column::Same(value) => return Column::Same(f(*value)),
            Column::Each(values) => values,
        };
        let Some(first) = values.first() else {
            return Column::Each(Vec::new());
        };
        let mut mapped = vec![f(*first); values.len()];
        for (to, from) in mapped.iter_mut().zip(values) {
            *to = f(*from);
        }
        Column::Each(mapped)
    }

    #[inline]
    fn zip<U: Copy, V: Copy>(&self, other: &Column<U>, f: &impl Fn(T, U) -> V) -> Column<V> {
        let (ours, theirs) = match (self, other) {
            (Column::Same(one), Column::Same(other)) => return Column::Same(f(*one, *other)),
            (Column::Same(one), Column::Each(_)) => return other.map(&|other| f(*one, other)),
            (Column::Each(_), Column::Same(other)) => return self.map(&|one| f(one, *other)),
            (Column::Each(ours), Column::Each(theirs)) => (ours, theirs),
        };
        let (Some(one), Some(other)) = (ours.first(), theirs.first()) else {
            return Column::Each(Vec::new());
        };
        let mut both = vec![f(*one, *other); ours.len()];
        for ((to, one), other) in both.iter_mut().zip(ours).zip(theirs) {
            *to = f(*one, *other);
        }
        Column::Each(both)
    }
}

impl<N: Num> Value<N> {
    /// The same scalar at every point.
    #[inline]
    pub fn scalar(value: f64) -> Value<N> {
        Value::Scalar(Column::Same(N::from_f64(value)))
    }

    /// The same colour at every point.
    #[inline]
    pub fn rgb(value: [f64; 3]) -> Value<N> {
        Value::Rgb(value.map(|channel| Column::Same(N::from_f64(channel))))
    }

    /// A scalar for each point.
    #[inline]
    pub fn each(values: Vec<N>) -> Value<N> {
        Value::Scalar(Column::Each(values))
    }

    /// One channel; a scalar is the same in all three.
    #[inline]
    pub fn channel(&self, index: usize) -> &Column<N> {
        match self {
            Value::Scalar(column) => column,
            Value::Rgb(columns) => &columns[index],
            Value::Many(columns) => &columns[index],
            Value::Bool(_) | Value::Texture(_) | Value::Cube(_) => {
                unreachable!("a checked function gives no other type where a number is wanted")
            }
        }
    }

    /// The number of points, where each has its own number; nothing where all share one.
    #[inline]
    fn points(&self) -> Option<usize> {
        let columns = match self {
            Value::Scalar(column) => std::slice::from_ref(column),
            Value::Rgb(columns) => columns,
            Value::Many(columns) => columns,
            Value::Bool(_) | Value::Texture(_) | Value::Cube(_) => &[],
        };
        columns.iter().filter_map(Column::points).max()
    }

    #[inline]
    fn part(&self, range: &Range<usize>) -> Value<N> {
        match self {
            Value::Scalar(column) => Value::Scalar(column.part(range)),
            Value::Rgb(columns) => Value::Rgb(each_channel(|i| columns[i].part(range))),
            Value::Bool(_) => unreachable!("no argument is an answer"),
            Value::Texture(texels) => Value::Texture(texels.clone()),
            Value::Cube(texels) => Value::Cube(texels.clone()),
            Value::Many(columns) => {
                Value::Many(columns.iter().map(|column| column.part(range)).collect())
            }
        }
    }

    #[inline]
    fn joined(self, next: Value<N>) -> Value<N> {
        match (self, next) {
            (Value::Scalar(column), Value::Scalar(next)) => Value::Scalar(column.joined(next)),
            (Value::Rgb([a, b, c]), Value::Rgb([d, e, f])) => {
                Value::Rgb([a.joined(d), b.joined(e), c.joined(f)])
            }
            _ => unreachable!("a function's results are numbers, and of one type"),
        }
    }

    /// The three channels at a point.
    #[inline]
    pub fn at(&self, point: usize) -> [N; 3] {
        each_channel(|index| self.channel(index).at(point))
    }

    #[inline]
    fn map(&self, f: impl Fn(N) -> N) -> Value<N> {
        match self {
            Value::Rgb([r, g, b]) => Value::Rgb([r.map(&f), g.map(&f), b.map(&f)]),
            _ => Value::Scalar(self.channel(0).map(&f)),
        }
    }

    #[inline]
    fn zip(&self, other: &Value<N>, f: impl Fn(N, N) -> N) -> Value<N> {
        let channel = |index: usize| self.channel(index).zip(other.channel(index), &f);
        if let (Value::Scalar(_), Value::Scalar(_)) = (self, other) {
            return Value::Scalar(channel(0));
        }
        Value::Rgb([channel(0), channel(1), channel(2)])
    }

    #[inline]
    fn choose(&self, yes: &Value<N>, no: &Value<N>) -> Value<N> {
        let Value::Bool(condition) = self else {
            unreachable!("a checked select starts with a Bool")
        };
        let pairs = yes.channel(0).zip(no.channel(0), &|yes, no| (yes, no));
        Value::Scalar(
            condition.zip(&pairs, &|reference, (yes, no)| match reference {
                Truth::Yes => yes,
                Truth::No => no,
                Truth::Either => yes.either(no),
            }),
        )
    }
}

impl<N: Num> Value<N> {
    /// Weights are exact: a GPU's 8-bit weights come from its sampler, not from the number type.
    #[inline]
    fn sample(&self, u: &Value<N>, v: &Value<N>) -> Value<N> {
        let Value::Texture(texels) = self else {
            unreachable!("a checked sample starts with a texture")
        };
        let at = |u, v| match texels {
            Some(texels) => texels.sample(Weights::Exact, u, v),
            None => [N::unknown(); 3],
        };
        let mixed = u.channel(0).zip(v.channel(0), &at);
        Value::Rgb(each_channel(|i| mixed.map(&|colour: [N; 3]| colour[i])))
    }

    fn sample_alpha(&self, u: &Value<N>, v: &Value<N>) -> Value<N> {
        let Value::Texture(texels) = self else {
            unreachable!("a checked sample starts with a texture")
        };
        let at = |u, v| match texels {
            Some(texels) => texels.sample_alpha(Weights::Exact, u, v),
            None => N::unknown(),
        };
        Value::Scalar(u.channel(0).zip(v.channel(0), &at))
    }

    fn sample_cube(&self, direction: &Value<N>) -> Value<N> {
        let Value::Cube(texels) = self else {
            unreachable!("a checked sample of a cube starts with a cube")
        };
        let at = |direction: [N; 3]| match texels {
            Some(texels) => texels.sample(direction),
            None => [N::unknown(); 3],
        };
        let [x, y, z] = each_channel(|i| direction.channel(i));
        let xy = x.zip(y, &|x, y| (x, y));
        let fetched = xy.zip(z, &|(x, y), z| at([x, y, z]));
        Value::Rgb(each_channel(|i| fetched.map(&|colour: [N; 3]| colour[i])))
    }

    /// The sum of products of channels, in order.
    fn dot(&self, other: &Value<N>) -> Value<N> {
        let product = |i: usize| self.channel(i).zip(other.channel(i), &|a, b| a * b);
        let [x, y, z] = each_channel(product);
        let sum = |a: Column<N>, b: Column<N>| a.zip(&b, &|a, b| a + b);
        Value::Scalar(sum(sum(x, y), z))
    }

    /// A row of this matrix times the column vector (point, 1).
    fn transform(&self, row: usize, place: &Value<N>) -> Value<N> {
        let entry = |column: usize| self.channel(4 * column + row);
        let of_row = Value::Rgb(each_channel(|i| entry(i).clone()));
        let moved = of_row.dot(place);
        Value::Scalar(moved.channel(0).zip(entry(3), &|a, b| a + b))
    }
}

/// Points evaluated at a time: the columns of all nodes then fit into a CPU cache.
const CHUNK: usize = 1024;

/// Evaluates a function for these arguments, in the order of its parameters. Columns with a number for each point must have
/// the same length.
#[inline]
pub fn evaluate<N: Num>(function: &Checked, arguments: &[Value<N>]) -> Value<N> {
    let whole = |arguments: &[Value<N>]| {
        let mut values = evaluate_nodes(function, arguments);
        values.swap_remove(function.result)
    };
    let points = arguments
        .iter()
        .filter_map(Value::points)
        .max()
        .unwrap_or(0);
    if points <= CHUNK {
        return whole(arguments);
    }
    let chunks = (0..points).step_by(CHUNK).map(|start| {
        let range = start..(start + CHUNK).min(points);
        let parts: Vec<Value<N>> = arguments.iter().map(|one| one.part(&range)).collect();
        whole(&parts)
    });
    let joined = chunks.reduce(Value::joined);
    joined.expect("there are more points than a chunk has")
}

/// A function that is evaluated again and again with the same first arguments. What depends on nothing else is computed once.
pub struct Repeated<'a, N> {
    function: &'a Checked,
    /// The values of all nodes, the last ones of those that vary.
    values: Vec<Value<N>>,
    /// The nodes that depend on other arguments, in order.
    varying: Vec<NodeId>,
}

impl<'a, N: Num> Repeated<'a, N> {
    /// The function with these arguments first. What varies is computed by [`Repeated::result`].
    pub fn new(function: &'a Checked, first: &[Value<N>]) -> Repeated<'a, N> {
        let mut values: Vec<Value<N>> = Vec::with_capacity(function.nodes.len());
        let mut varying: Vec<NodeId> = Vec::new();
        for (id, node) in function.nodes.iter().enumerate() {
            let is_later = matches!((node.op, node.payload), (Op::Param, Payload::Index(index)) if index >= first.len());
            if is_later
                || node
                    .args
                    .iter()
                    .any(|arg| varying.binary_search(arg).is_ok())
            {
                varying.push(id);
                values.push(Value::scalar(0.0));
            } else {
                let value = apply(node, &values, first);
                values.push(value);
            }
        }
        Repeated {
            function,
            values,
            varying,
        }
    }

    /// The result for these arguments, the first ones included.
    pub fn result(&mut self, arguments: &[Value<N>]) -> &Value<N> {
        for id in &self.varying {
            let value = apply(&self.function.nodes[*id], &self.values, arguments);
            self.values[*id] = value;
        }
        &self.values[self.function.result]
    }
}

/// The values of all nodes, not only of the result.
#[inline]
pub(super) fn evaluate_nodes<N: Num>(function: &Function, arguments: &[Value<N>]) -> Vec<Value<N>> {
    let mut values: Vec<Value<N>> = Vec::with_capacity(function.nodes.len());
    for node in &function.nodes {
        let value = apply(node, &values, arguments);
        values.push(value);
    }
    values
}

/// The value of a node: what each operation computes.
#[inline]
pub(super) fn apply<N: Num>(node: &Node, values: &[Value<N>], arguments: &[Value<N>]) -> Value<N> {
    let arg = |i: usize| &values[node.args[i]];
    match (node.op, node.payload) {
        (Op::Number, Payload::Number(value)) => Value::scalar(value),
        (Op::Param, Payload::Index(index)) => arguments[index].clone(),
        (Op::Channel, Payload::Index(index)) => Value::Scalar(arg(0).channel(index).clone()),
        (Op::Splat, _) => Value::Rgb(each_channel(|_| arg(0).channel(0).clone())),
        (Op::Compose, _) => Value::Rgb(each_channel(|i| arg(i).channel(0).clone())),
        (Op::Add, _) => arg(0).zip(arg(1), |a, b| a + b),
        (Op::Sub, _) => arg(0).zip(arg(1), |a, b| a - b),
        (Op::Mul, _) if node.args[0] == node.args[1] => arg(0).map(N::squared),
        (Op::Mul, _) => arg(0).zip(arg(1), |a, b| a * b),
        (Op::Div, _) => arg(0).zip(arg(1), |a, b| a / b),
        (Op::Neg, _) => arg(0).map(|a| -a),
        (Op::Abs, _) => arg(0).map(N::abs),
        (Op::Min, _) => arg(0).zip(arg(1), N::min),
        (Op::Max, _) => arg(0).zip(arg(1), N::max),
        (Op::Saturate, _) => arg(0).map(N::saturate),
        (Op::Sqrt, _) => arg(0).map(N::sqrt),
        (Op::InverseSqrt, _) => arg(0).map(N::inverse_sqrt),
        (Op::Exp2, _) => arg(0).map(N::exp2),
        (Op::Log2, _) => arg(0).map(N::log2),
        (Op::Sin, _) => arg(0).map(N::sin),
        (Op::Cos, _) => arg(0).map(N::cos),
        (Op::Less, _) => Value::Bool(arg(0).channel(0).zip(arg(1).channel(0), &N::less)),
        (Op::Select, _) => arg(0).choose(arg(1), arg(2)),
        (Op::Dot, _) => arg(0).dot(arg(1)),
        (Op::Transform, Payload::Index(row)) => arg(0).transform(row, arg(1)),
        (Op::Sample, _) => arg(0).sample(arg(1), arg(2)),
        (Op::SampleAlpha, _) => arg(0).sample_alpha(arg(1), arg(2)),
        (Op::SampleCube, _) => arg(0).sample_cube(arg(1)),
        (Op::Number | Op::Param | Op::Channel | Op::Transform, _) => {
            unreachable!("a checked node carries its payload")
        }
    }
}
