//! The graph: functions, nodes, types, labels; which nodes a result needs; how much work it is.

use super::op::{Op, Payload, Signature};

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ty {
    /// One number.
    Scalar,
    /// Three channels.
    Rgb,
    /// The answer to a comparison.
    Bool,
    /// A texture with the sampler that filters it: an argument only.
    Texture,
}

impl Ty {
    /// How many channels a value of this type has.
    pub fn channels(self) -> usize {
        if self == Ty::Rgb { 3 } else { 1 }
    }

    /// The name in the text form.
    pub fn name(self) -> &'static str {
        match self {
            Ty::Scalar => "scalar",
            Ty::Rgb => "rgb",
            Ty::Bool => "bool",
            Ty::Texture => "texture",
        }
    }
}

/// The place of a node in [`Function::nodes`].
pub type NodeId = usize;

/// The name of a step, and why it is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// A snake_case name, unique in its function.
    pub name: String,
    /// One line that says what the step establishes; may be empty.
    pub why: String,
}

/// An argument of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Param {
    /// Its name, the same in every language.
    pub name: String,
    /// Scalar, colour or texture.
    pub ty: Ty,
}

/// The name of the cosine, which comes first among the arguments of what depends on it.
pub const COSINE: &str = "cos_theta";

impl Param {
    /// Whether it is the cosine.
    pub fn is_cosine(&self) -> bool {
        self.name == COSINE
    }
}

/// One operation applied to earlier nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The operation.
    pub op: Op,
    /// Earlier nodes, as many as the operation's signature wants.
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
    /// Which node is returned.
    pub result: NodeId,
}

impl Function {
    /// The type of the result.
    pub fn ty(&self) -> Ty {
        self.nodes[self.result].ty
    }

    /// For each node, by how many nodes it is used (the result counts as one use).
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        uses[self.result] += 1;
        for argument in self.nodes.iter().flat_map(|node| &node.args) {
            uses[*argument] += 1;
        }
        uses
    }

    /// Scalar operations of one evaluation, a colour counted three times; fetches from a texture are not among them.
    pub fn work(&self) -> usize {
        let channels = |node: &Node| {
            node.args
                .iter()
                .map(|a| self.nodes[*a].ty.channels())
                .max()
                .unwrap_or(1)
        };
        self.nodes
            .iter()
            .map(|node| node.op.info().work * channels(node))
            .sum()
    }

    /// How many scalar operations of one kind an evaluation takes.
    pub fn count(&self, op: Op) -> usize {
        self.nodes
            .iter()
            .filter(|node| node.op == op)
            .map(|node| node.ty.channels())
            .sum()
    }

    /// How often an evaluation reads a texture.
    pub fn fetches(&self) -> usize {
        let is_fetch = |node: &&Node| node.op == Op::Sample;
        self.nodes.iter().filter(is_fetch).count()
    }

    /// The same function with only the nodes that the result needs, each leaf just before its first use.
    /// Two functions with the same steps in the same order become equal.
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
