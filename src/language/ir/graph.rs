//! The graph: functions, nodes and labels; which nodes a result needs; how many operations it costs.
//!
//! The text form of a function has one step a line, `name = operation arguments # why`. It makes tests readable files, and bug
//! reports text that can be pasted. The tests have the parser.
//!
//! ```text
//! fn schlick(cos_theta: scalar, f0: rgb) -> rgb
//!   c = saturate cos_theta # clamped first
//!   %0 = sub 1 c
//!   ...
//!   return f
//! ```
//! An argument is a number, the name of a parameter or step, or the `%i` of a step without a name.

use std::fmt::Write;

use super::op::{Letters, Op, Payload, Signature, Ty};

/// The index of a node in [`Function::nodes`].
pub type NodeId = usize;

/// The name of a step, and why it is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// A snake_case name, unique in its function.
    pub name: String,
    /// One line that says what the step is for; may be empty.
    pub why: String,
}

/// An argument of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Param {
    /// Its name, the same in every language.
    pub name: String,
    /// Its type: any but `Bool`.
    pub ty: Ty,
}

/// The name of the cosine, the first argument of every function that depends on it.
pub const COSINE: &str = "cos_theta";

impl Param {
    /// Whether this is the cosine.
    pub fn is_cosine(&self) -> bool {
        self.name == COSINE
    }
}

/// One operation applied to earlier nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The operation.
    pub op: Op,
    /// Earlier nodes, as many as the operation's signature requires.
    pub args: Vec<NodeId>,
    /// The number or index that some operations carry.
    pub payload: Payload,
    /// The type of the result.
    pub ty: Ty,
    /// The name of the step, where it has one.
    pub label: Option<Label>,
}

impl Node {
    /// Whether the node only names a constant or an argument.
    pub fn is_leaf(&self) -> bool {
        matches!(
            self.op.info().signature,
            Signature::Number | Signature::Param
        )
    }
}

/// A function: arguments, nodes in order of evaluation, the node that is the result.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name in the text form.
    pub name: String,
    /// Its arguments in order.
    pub params: Vec<Param>,
    /// Its nodes; arguments stand before the nodes that use them.
    pub nodes: Vec<Node>,
    /// The node that is returned.
    pub result: NodeId,
    /// The names of its channels.
    pub letters: Letters,
}

impl Function {
    /// The type of the result.
    pub fn ty(&self) -> Ty {
        self.nodes[self.result].ty
    }

    /// For each node, how often it is used as an argument. Being the result counts as one use.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        uses[self.result] += 1;
        for argument in self.nodes.iter().flat_map(|node| &node.args) {
            uses[*argument] += 1;
        }
        uses
    }

    /// Scalar operations of one evaluation. An operation on a colour counts three times; texture fetches do not count.
    pub fn work(&self) -> usize {
        let channels = |node: &Node| {
            let arguments = node.args.iter().map(|a| self.nodes[*a].ty);
            arguments.map(|ty| ty.channels().min(3)).max().unwrap_or(1)
        };
        self.nodes
            .iter()
            .map(|node| node.op.info().work * channels(node))
            .sum()
    }

    /// Whether an evaluation computes and fetches nothing: the result is a constant or an argument.
    pub fn computes_nothing(&self) -> bool {
        self.work() == 0 && self.fetches() == 0
    }

    /// Whether each channel of the result depends on that channel of its arguments alone.
    pub fn keeps_channels_apart(&self) -> bool {
        const ALL: u8 = 0b111;
        // For each component of each node, a bit for each channel that it depends on.
        let mut read: Vec<[u8; 3]> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let arg = |i: usize| read[node.args[i]];
            let union = |i: usize| node.args.iter().fold(0, |all, arg| all | read[*arg][i]);
            read.push(match (node.op.info().signature, node.payload) {
                (Signature::Number, _) => [0; 3],
                (Signature::Param, _) => match node.ty {
                    Ty::Scalar => [0; 3],
                    Ty::Vec3 => [1, 2, 4],
                    _ => [ALL; 3],
                },
                (Signature::Channel, Payload::Index(index @ 0..3)) => [arg(0)[index]; 3],
                (Signature::Compose, _) => [arg(0)[0], arg(1)[0], arg(2)[0]],
                (
                    Signature::Splat
                    | Signature::Unary
                    | Signature::Alike
                    | Signature::Mixed
                    | Signature::Compare
                    | Signature::Choose,
                    _,
                ) => [union(0), union(1), union(2)],
                _ => [ALL; 3],
            });
        }
        let result = read[self.result];
        (0..3).all(|i| result[i] & !(1 << i) == 0)
    }

    /// How many scalar operations of one kind an evaluation takes.
    pub fn count(&self, op: Op) -> usize {
        self.nodes
            .iter()
            .filter(|node| node.op == op)
            .map(|node| node.ty.channels())
            .sum()
    }

    /// The number of texture fetches of an evaluation.
    pub fn fetches(&self) -> usize {
        let is_fetch = |node: &&Node| node.op.is_fetch();
        self.nodes.iter().filter(is_fetch).count()
    }

    /// The same function with only the nodes that the result needs, each leaf just before its first use.
    /// Two functions with the same steps in the same order then compare equal.
    pub fn compact(&self) -> Function {
        let needed = self.needed();
        let mut place = vec![usize::MAX; self.nodes.len()];
        let mut nodes = Vec::new();
        for id in (0..self.nodes.len()).filter(|id| needed[*id] && !self.nodes[*id].is_leaf()) {
            for argument in &self.nodes[id].args {
                if place[*argument] == usize::MAX {
                    place[*argument] = nodes.len();
                    nodes.push(self.nodes[*argument].clone());
                }
            }
            let args = self.nodes[id].args.iter().map(|a| place[*a]).collect();
            place[id] = nodes.len();
            nodes.push(Node {
                args,
                ..self.nodes[id].clone()
            });
        }
        if place[self.result] == usize::MAX {
            place[self.result] = nodes.len();
            nodes.push(self.nodes[self.result].clone());
        }
        Function {
            name: self.name.clone(),
            params: self.params.clone(),
            nodes,
            result: place[self.result],
            letters: self.letters,
        }
    }

    fn needed(&self) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        needed[self.result] = true;
        for id in (0..self.nodes.len()).rev().filter(|id| *id <= self.result) {
            if needed[id] {
                for argument in &self.nodes[id].args {
                    needed[*argument] = true;
                }
            }
        }
        needed
    }
}

/// Prints a function.
pub fn print(function: &Function) -> String {
    let param = |p: &Param| format!("{}: {}", p.name, type_name(function.letters, p.ty));
    let params: Vec<String> = function.params.iter().map(param).collect();
    let mut out = format!(
        "fn {}({}) -> {}\n",
        function.name,
        params.join(", "),
        type_name(function.letters, function.ty())
    );
    let names = names(function);
    let steps = function.nodes.iter().enumerate();
    for (id, node) in steps.filter(|(_, node)| !node.is_leaf()) {
        let mut words = vec![node.op.info().name.to_owned()];
        if let Payload::Index(index) = node.payload {
            words.push(index.to_string());
        }
        words.extend(node.args.iter().map(|a| names[*a].clone()));
        let comment = match &node.label {
            Some(label) if !label.why.is_empty() => format!(" # {}", label.why),
            _ => String::new(),
        };
        let _ = writeln!(out, "  {} = {}{comment}", names[id], words.join(" "));
    }
    let _ = writeln!(out, "  return {}", names[function.result]);
    out
}

/// The name of a type. Three numbers that are not a colour are a `vec3`.
fn type_name(letters: Letters, ty: Ty) -> &'static str {
    match (letters, ty) {
        (Letters::Xyz, Ty::Vec3) => "vec3",
        _ => ty.name(),
    }
}

fn names(function: &Function) -> Vec<String> {
    let mut unnamed = 0;
    let mut name = |node: &Node| match (&node.label, node.payload, node.is_leaf()) {
        (_, Payload::Number(value), _) => format!("{value:?}").trim_end_matches(".0").to_owned(),
        (_, Payload::Index(index), true) => function.params[index].name.clone(),
        (Some(label), _, _) => label.name.clone(),
        (None, _, _) => {
            unnamed += 1;
            format!("%{}", unnamed - 1)
        }
    };
    function.nodes.iter().map(&mut name).collect()
}
