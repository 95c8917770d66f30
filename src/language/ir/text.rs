//! The text form of a function: one step a line, `name = operation arguments # why`. It makes tests readable files, and bug
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

use super::graph::{Function, Node, Param};
use super::op::Payload;
use super::ty::{Letters, Ty};

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
