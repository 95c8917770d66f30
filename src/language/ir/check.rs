//! The checker: what makes a function well formed. Printers accept only functions that passed it.
//!
//! It verifies, for every function ([`RULES`]):
//! 1. arguments stand before the node that uses them;
//! 2. the number and the types of arguments fit the operation's signature;
//! 3. a node carries the payload that its operation requires, in range, and no other;
//! 4. constants are finite in the precision of the code;
//! 5. names are identifiers in every language: a letter, then letters, digits and single underscores, none last;
//! 6. names of arguments and steps are unique in the function;
//! 7. no argument is the answer to a comparison, and the result is one number or three;
//! 8. the result depends on every node: nothing is computed in vain;
//! 9. a step that is used twice has a name, unless it is a comparison, or only names a constant or an argument.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Deref;

use super::graph::{Function, Node, NodeId};
use super::op::{Op, Payload, Signature, Ty};
use crate::physics::names::identifier_fault;
use crate::physics::num::Precision;

/// The rules, in the order of the list above.
pub const RULES: [&str; 9] = [
    "arguments stand before their use",
    "arguments fit the signature",
    "the payload fits the operation",
    "constants are finite in the precision of the code",
    "names are identifiers in every language",
    "names are unique",
    "no argument is a comparison's answer, the result is one number or three",
    "every node is needed",
    "a shared step has a name, which `.named(...)` gives it (`squared` uses its step twice)",
];

/// A broken rule.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error("function `{function}`, {place}: rule {rule} ({}) is broken: {what}", RULES[*rule - 1])]
pub struct BrokenRule {
    /// The function.
    pub function: String,
    /// The node, argument or result.
    pub place: String,
    /// The number of the rule, from 1.
    pub rule: usize,
    /// What was found.
    pub what: String,
}

/// As people read it: tests unwrap it.
impl fmt::Debug for BrokenRule {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{self}")
    }
}

/// A function that passed [`check`].
#[derive(Clone, Debug, PartialEq)]
pub struct Checked(Function);

impl Deref for Checked {
    type Target = Function;

    fn deref(&self) -> &Function {
        &self.0
    }
}

/// Checks a function against all rules, for code in single precision.
///
/// # Errors
/// A node, or the function as a whole, breaks one of [`RULES`](super::RULES).
pub fn check(function: Function) -> Result<Checked, BrokenRule> {
    check_in(Precision::F32, function)
}

/// Checks a function against all rules, for code in this precision.
///
/// # Errors
/// A node, or the function as a whole, breaks one of [`RULES`](super::RULES).
pub fn check_in(precision: Precision, function: Function) -> Result<Checked, BrokenRule> {
    let broken = |place: String, (rule, what): Broken| BrokenRule {
        function: function.name.clone(),
        place,
        rule,
        what,
    };
    for (id, node) in function.nodes.iter().enumerate() {
        let place = || format!("node {id} ({})", node.op.info().name);
        check_node(precision, &function, id, node).map_err(|fault| broken(place(), fault))?;
    }
    check_whole(&function).map_err(|fault| broken("as a whole".to_owned(), fault))?;
    Ok(Checked(function))
}

type Broken = (usize, String);

fn ensure(holds: bool, rule: usize, what: impl FnOnce() -> String) -> Result<(), Broken> {
    if holds { Ok(()) } else { Err((rule, what())) }
}

fn check_node(
    precision: Precision,
    function: &Function,
    id: NodeId,
    node: &Node,
) -> Result<(), Broken> {
    ensure(node.args.iter().all(|a| *a < id), 1, || {
        format!("it uses {:?}", node.args)
    })?;
    let types: Vec<Ty> = node.args.iter().map(|a| function.nodes[*a].ty).collect();
    let payload = check_payload(precision, function, node)?;
    let result = node.op.info().signature.result(&types);
    let result = payload.or(result);
    ensure(types.len() == node.op.info().signature.arity(), 2, || {
        format!("{} arguments", types.len())
    })?;
    ensure(result == Some(node.ty), 2, || {
        format!("{types:?} give {result:?}, not {:?}", node.ty)
    })
}

/// Checks a node's payload. For a parameter, returns the type that its index refers to; for other operations, nothing.
fn check_payload(
    precision: Precision,
    function: &Function,
    node: &Node,
) -> Result<Option<Ty>, Broken> {
    let what = || format!("{:?}", node.payload);
    match (node.op.info().signature, node.payload) {
        (Signature::Number, Payload::Number(value)) => {
            ensure(precision.rounded(value).is_finite(), 4, what).map(|()| None)
        }
        (Signature::Param, Payload::Index(index)) => {
            ensure(index < function.params.len(), 3, what)?;
            Ok(Some(function.params[index].ty))
        }
        (Signature::Channel | Signature::Transform, Payload::Index(index)) => {
            let types: Vec<Ty> = node.args.iter().map(|a| function.nodes[*a].ty).collect();
            let indices = node.op.info().signature.indices(&types);
            ensure(indices.is_some_and(|count| index < count), 3, what).map(|()| None)
        }
        (Signature::Number | Signature::Param | Signature::Channel | Signature::Transform, _) => {
            Err((3, what()))
        }
        (_, payload) => ensure(payload == Payload::None, 3, what).map(|()| None),
    }
}

fn check_whole(function: &Function) -> Result<(), Broken> {
    let params = function.params.iter().map(|param| &param.name);
    let labels = function
        .nodes
        .iter()
        .filter_map(|node| node.label.as_ref())
        .map(|label| &label.name);
    let mut seen = BTreeSet::new();
    for name in params.chain(labels) {
        ensure(identifier_fault(name).is_none(), 5, || name.clone())?;
        ensure(seen.insert(name), 6, || {
            format!(
                "two of its arguments and steps, those of a method in it included, are called {name}"
            )
        })?;
    }
    ensure(identifier_fault(&function.name).is_none(), 5, || {
        function.name.clone()
    })?;
    ensure(
        function.params.iter().all(|param| param.ty != Ty::Bool),
        7,
        || "an argument is a Bool".to_owned(),
    )?;
    let is_number = matches!(function.ty(), Ty::Scalar | Ty::Vec3);
    ensure(is_number, 7, || {
        format!("the result is a {}", function.ty().name())
    })?;
    let uses = function.uses();
    for (id, node) in function.nodes.iter().enumerate() {
        ensure(uses[id] > 0, 8, || format!("node {id}"))?;
        let what = || format!("node {id} ({})", node.op.info().name);
        ensure(!wants_name(function, id, uses[id]), 9, what)?;
    }
    Ok(())
}

/// Whether a node has no name and is used so often that it needs one.
pub(super) fn wants_name(function: &Function, id: NodeId, uses: usize) -> bool {
    let node = &function.nodes[id];
    uses > 1 && node.label.is_none() && node.ty != Ty::Bool && !is_name_only(function, node)
}

/// Constants, arguments, channels of these and of named steps, and constant colours: nothing is computed there.
fn is_name_only(function: &Function, node: &Node) -> bool {
    let is_name = |a: &NodeId| {
        let of = &function.nodes[*a];
        node.op == Op::Channel && of.label.is_some() || is_name_only(function, of)
    };
    node.is_leaf()
        || node.op.info().work == 0 && !node.op.is_fetch() && node.args.iter().all(is_name)
}
