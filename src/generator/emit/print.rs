//! The printer: a checked graph as the body of a function, in the spelling of a target.
//!
//! Labelled steps become variables with their reason beside them. Everything else is written in place, without parentheses that
//! precedence makes needless. Equal precedence on the right keeps its parentheses, because floating-point sums and products do
//! not associate.

use crate::language::ir::{Checked, Node, NodeId, Op, Payload, Ty};
use crate::language::targets::{Form, Spelling, filled, precedence};

/// Longer lines are broken, and their comments then stand above.
const WIDTH: usize = 110;

/// The lines of a function's body, without indentation.
pub fn body(function: &Checked, spelling: &Spelling) -> Vec<String> {
    let printer = Printer { function, spelling };
    let mut lines = Vec::new();
    for (id, node) in function.nodes.iter().enumerate() {
        if let Some(label) = node.label.as_ref().filter(|_| id != function.result) {
            let statement = |value: &str| {
                let (ty, name) = (spelling.ty(node.ty), label.name.as_str());
                let holes: &[(&str, &str)] = &[("type", ty), ("name", name), ("value", value)];
                filled(spelling.local, holes)
            };
            push(
                &mut lines,
                printer.statement(id, statement),
                &label.why,
                spelling.comment,
            );
        }
    }
    let why = function.nodes[function.result]
        .label
        .as_ref()
        .map_or("", |label| &label.why);
    let returned = printer.statement(function.result, |value| format!("return {value};"));
    push(&mut lines, returned, why, spelling.comment);
    lines
}

/// The signature of a function: name, arguments, result.
pub fn head(function: &Checked, name: &str, spelling: &Spelling) -> String {
    let params: Vec<String> = function
        .params
        .iter()
        .map(|param| {
            let pattern = match param.ty {
                Ty::Texture => spelling.texture,
                Ty::Cube => spelling.cube,
                _ => spelling.param,
            };
            let holes: &[(&str, &str)] = &[("type", spelling.ty(param.ty)), ("name", &param.name)];
            filled(pattern, holes)
        })
        .collect();
    let holes: &[(&str, &str)] = &[
        ("name", name),
        ("type", spelling.ty(function.ty())),
        ("params", &params.join(", ")),
    ];
    filled(spelling.head, holes)
}

/// A function alone, without comments: the part of its text that a compiler reads.
pub fn bare(function: &Checked, name: &str, spelling: &Spelling) -> String {
    let lines = body(function, spelling);
    let code = lines.iter().map(|line| {
        let code = line.split(spelling.comment).next();
        code.unwrap_or_default().trim_end()
    });
    let body: String = code.map(|line| format!("    {line}\n")).collect();
    format!("{} {{\n{body}}}\n", head(function, name, spelling))
}

/// The signature as a page shows it: each argument on its own line where one line is too short for all.
pub fn shown_head(function: &Checked, name: &str, spelling: &Spelling) -> String {
    let whole = head(function, name, spelling);
    if whole.len() <= WIDTH {
        return whole;
    }
    let broken = whole.replacen('(', "(\n    ", 1).replace(", ", ",\n    ");
    match broken.rsplit_once(')') {
        Some((arguments, result)) => format!("{arguments}\n){result}"),
        None => whole,
    }
}

fn push(lines: &mut Vec<String>, statement: Vec<String>, why: &str, comment: &str) {
    let one_line = statement.len() == 1;
    match (
        why.is_empty(),
        one_line && statement[0].len() + why.len() + 4 <= WIDTH,
    ) {
        (true, _) => lines.extend(statement),
        (false, true) => lines.push(format!("{} {comment} {why}", statement[0])),
        (false, false) => {
            lines.push(format!("{comment} {why}"));
            lines.extend(statement);
        }
    }
}

/// Text and how tightly it binds.
struct Text {
    text: String,
    tightness: u8,
}

impl Text {
    fn tight(text: String) -> Text {
        Text {
            text,
            tightness: precedence::TIGHT,
        }
    }

    /// The text, in parentheses unless it binds at least this tightly.
    fn at(self, tightness: u8) -> String {
        if self.tightness >= tightness {
            self.text
        } else {
            format!("({})", self.text)
        }
    }
}

struct Printer<'a> {
    function: &'a Checked,
    spelling: &'a Spelling,
}

impl Printer<'_> {
    /// A statement around the expression of a node. If it is too long, it is broken at its outermost operation.
    fn statement(&self, id: NodeId, around: impl Fn(&str) -> String) -> Vec<String> {
        let node = &self.function.nodes[id];
        let whole = around(&self.operation(node).text);
        if whole.len() <= WIDTH {
            return vec![whole];
        }
        let broken = match self.spelling.form(node.op) {
            Form::Call(name) => self.broken_call(name, node),
            Form::Infix(sign, tightness) => {
                let (left, sign, right) = self.sides(node, sign, tightness);
                format!("{left} {sign}\n    {right}")
            }
            _ => return vec![whole],
        };
        around(&broken).lines().map(str::to_owned).collect()
    }

    /// A call with each argument on its own line.
    fn broken_call(&self, name: &str, node: &Node) -> String {
        let lines: Vec<String> = node
            .args
            .iter()
            .map(|arg| format!("    {}", self.expression(*arg).text))
            .collect();
        format!("{name}(\n{}\n)", lines.join(",\n"))
    }

    /// A node where it is used: by its name, or written in place.
    fn expression(&self, id: NodeId) -> Text {
        let node = &self.function.nodes[id];
        match &node.label {
            Some(label) => Text::tight(label.name.clone()),
            None => self.operation(node),
        }
    }

    fn operation(&self, node: &Node) -> Text {
        let arg = |i: usize, tightness: u8| self.expression(node.args[i]).at(tightness);
        match self.spelling.form(node.op) {
            Form::Leaf => self.leaf(node),
            Form::Infix(sign, tightness) => self.infix(node, sign, tightness),
            Form::Prefix(sign) => Text {
                text: format!("{sign}{}", arg(0, precedence::PREFIX + 1)),
                tightness: precedence::PREFIX,
            },
            Form::Call(name) => Text::tight(format!("{name}({})", self.arguments(node))),
            Form::CallUnit(name) => {
                let [low, high] = [0.0, 1.0].map(|value| self.spelling.number(value));
                Text::tight(format!("{name}({}, {low}, {high})", arg(0, 0)))
            }
            Form::CallSelect(name) => Text::tight(format!(
                "{name}({}, {}, {})",
                arg(2, 0),
                arg(1, 0),
                arg(0, 0)
            )),
            Form::Postfix(suffix) => {
                Text::tight(format!("{}{suffix}", self.before_dot(node.args[0])))
            }
            Form::Channel => {
                let Payload::Index(index) = node.payload else {
                    unreachable!("a checked channel has an index")
                };
                Text::tight(format!(
                    "{}.{}",
                    arg(0, precedence::TIGHT),
                    self.letter(node, index)
                ))
            }
            Form::Pattern(pattern) => self.filled(pattern, node),
            Form::Ternary => {
                let loose = precedence::TERNARY + 1;
                let text = format!("{} ? {} : {}", arg(0, loose), arg(1, loose), arg(2, loose));
                Text {
                    text,
                    tightness: precedence::TERNARY,
                }
            }
        }
    }

    fn filled(&self, pattern: &str, node: &Node) -> Text {
        let fill = |text: String, (i, arg): (usize, &NodeId)| {
            text.replace(&format!("{{{i}}}"), &self.expression(*arg).text)
        };
        let pattern = match node.payload {
            Payload::Index(row) => pattern.replace("{w}", ["x", "y", "z", "w"][row]),
            _ => pattern.to_owned(),
        };
        let args = node.args.iter().enumerate();
        Text::tight(args.fold(pattern, fill))
    }

    fn letter(&self, node: &Node, channel: usize) -> &'static str {
        let of = self.function.nodes[node.args[0]].ty;
        self.function.letters.letter(of, channel)
    }

    fn leaf(&self, node: &Node) -> Text {
        match node.payload {
            Payload::Number(value) => {
                let tightness = if value.is_sign_negative() {
                    precedence::PREFIX
                } else {
                    precedence::TIGHT
                };
                Text {
                    text: self.spelling.number(value),
                    tightness,
                }
            }
            Payload::Index(index) => Text::tight(self.function.params[index].name.clone()),
            Payload::None => unreachable!("a checked leaf carries its payload"),
        }
    }

    fn infix(&self, node: &Node, sign: &str, tightness: u8) -> Text {
        let (left, sign, right) = self.sides(node, sign, tightness);
        Text {
            text: format!("{left} {sign} {right}"),
            tightness,
        }
    }

    /// The parts of `a + b`. A negative constant on the right of a sum changes the sign instead, which gives the same number.
    fn sides<'s>(&self, node: &Node, sign: &'s str, tightness: u8) -> (String, &'s str, String) {
        let left = self.expression(node.args[0]).at(tightness);
        let negative = match self.function.nodes[node.args[1]].payload {
            Payload::Number(value) if value < 0.0 => Some(self.spelling.number(-value)),
            _ => None,
        };
        match (node.op, negative) {
            (Op::Add, Some(positive)) => (left, "-", positive),
            (Op::Sub, Some(positive)) => (left, "+", positive),
            _ => (left, sign, self.expression(node.args[1]).at(tightness + 1)),
        }
    }

    /// The arguments of a call. Where the language broadcasts a scalar by itself, `max(colour, scalar)` is written.
    fn arguments(&self, node: &Node) -> String {
        let scalar_second = self.spelling.mixed_min_max && matches!(node.op, Op::Min | Op::Max);
        let text = |(i, arg): (usize, &NodeId)| {
            let inner = &self.function.nodes[*arg];
            let narrow = scalar_second && i == 1 && inner.op == Op::Splat && inner.label.is_none();
            self.expression(if narrow { inner.args[0] } else { *arg })
                .text
        };
        node.args
            .iter()
            .enumerate()
            .map(text)
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// The expression before a swizzle: a number needs parentheses there.
    fn before_dot(&self, id: NodeId) -> String {
        let is_number = self.function.nodes[id].op == Op::Number;
        let text = self.expression(id);
        if is_number {
            format!("({})", text.text)
        } else {
            text.at(precedence::TIGHT)
        }
    }
}
