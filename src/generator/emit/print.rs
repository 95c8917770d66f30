//! The printer: a checked graph as the body of a function, in the spelling of a target.
//!
//! Labelled steps become variables with their reason beside them. Everything else is written in place, without parentheses that
//! precedence makes needless. Equal precedence on the right keeps its parentheses, because floating-point sums and products do
//! not associate.

use crate::language::ir::{Checked, Node, NodeId, Op, Param, Payload, Ty};
use crate::language::targets::{Form, Spelling, filled, precedence};

/// Longer lines are broken at their outermost operation, and their comments then stand above.
const WIDTH: usize = 110;
/// Lines that are longer still, with four spaces before them, are broken wherever they are least nested.
const MOST: usize = 126;

/// The lines of a function's body, without indentation.
pub fn body(function: &Checked, spelling: &Spelling) -> Vec<String> {
    let printer = Printer { function, spelling };
    let mut lines = Vec::new();
    let steps = function.nodes.iter().enumerate();
    for (id, node) in steps.filter(|(id, _)| *id != function.result) {
        let Some(label) = &node.label else { continue };
        let (ty, name) = (spelling.ty(node.ty), label.name.as_str());
        let statement = printer.statement(id, |value| {
            let holes: &[(&str, &str)] = &[("type", ty), ("name", name), ("value", value)];
            filled(spelling.local, holes)
        });
        push(&mut lines, statement, &label.why, spelling.comment);
    }
    let label = function.nodes[function.result].label.as_ref();
    let why = label.map_or("", |label| &label.why);
    let returned = printer.statement(function.result, |value| format!("return {value};"));
    push(&mut lines, returned, why, spelling.comment);
    lines
}

/// The same as a page shows it, with its longest lines broken.
pub fn shown_body(function: &Checked, spelling: &Spelling) -> Vec<String> {
    let lines = body(function, spelling).into_iter();
    let shown = |line: String| {
        if line.starts_with(spelling.comment) {
            vec![line]
        } else {
            wrapped(line)
        }
    };
    lines.flat_map(shown).collect()
}

/// The signature of a function: name, arguments, result.
pub fn head(function: &Checked, name: &str, spelling: &Spelling) -> String {
    let param = |param: &Param| {
        let pattern = match param.ty {
            Ty::Texture => spelling.texture,
            Ty::Cube => spelling.cube,
            _ => spelling.param,
        };
        let holes: &[(&str, &str)] = &[("type", spelling.ty(param.ty)), ("name", &param.name)];
        filled(pattern, holes)
    };
    let params: Vec<String> = function.params.iter().map(param).collect();
    let holes: &[(&str, &str)] = &[
        ("name", name),
        ("type", spelling.ty(function.ty())),
        ("params", &params.join(", ")),
    ];
    filled(spelling.head, holes)
}

/// A function alone, without comments: the part of its text that a compiler reads.
pub fn bare(function: &Checked, name: &str, spelling: &Spelling) -> String {
    let mut text = format!("{} {{\n", head(function, name, spelling));
    for line in body(function, spelling) {
        let code = line.split(spelling.comment).next().unwrap_or_default();
        text += &format!("    {}\n", code.trim_end());
    }
    text + "}\n"
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

/// Adds a statement with its reason: on the same line if both fit, else above.
fn push(lines: &mut Vec<String>, statement: Vec<String>, why: &str, comment: &str) {
    match &statement[..] {
        _ if why.is_empty() => {}
        [line] if line.len() + why.len() + 4 <= WIDTH => {
            lines.push(format!("{line} {comment} {why}"));
            return;
        }
        _ => lines.push(format!("{comment} {why}")),
    }
    lines.extend(statement);
}

/// A line in parts that are short enough: each ends behind a comma, or before an operator, where brackets are least deep.
fn wrapped(line: String) -> Vec<String> {
    let indent = " ".repeat(4 + line.len() - line.trim_start().len());
    let (mut lines, mut rest) = (Vec::new(), line);
    while rest.len() > MOST {
        let Some(at) = place_to_break(&rest) else {
            break;
        };
        lines.push(rest[..at].to_owned());
        rest = format!("{indent}{}", &rest[at + 1..]);
    }
    lines.push(rest);
    lines
}

/// The place of the space at which a line is broken.
fn place_to_break(line: &str) -> Option<usize> {
    let letters = line.as_bytes();
    let (mut depth, mut best) = (0, None);
    for at in 1..WIDTH {
        match letters[at] {
            b'(' => depth += 1,
            b')' => depth -= 1,
            b' ' => {
                let is_operator = b"+-*/?:".contains(&letters[at + 1]) && letters[at + 2] == b' ';
                let is_place = is_operator || letters[at - 1] == b',';
                if is_place && at > WIDTH / 3 && best.is_none_or(|(least, _)| depth <= least) {
                    best = Some((depth, at));
                }
            }
            _ => {}
        }
    }
    best.map(|(_, at)| at)
}

/// Text and how tightly it binds.
struct Text {
    text: String,
    tightness: u8,
}

impl Text {
    fn new(text: String, tightness: u8) -> Text {
        Text { text, tightness }
    }

    fn tight(text: String) -> Text {
        Text::new(text, precedence::TIGHT)
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
        let line = |arg: &NodeId| format!("    {}", self.expression(*arg).text);
        let lines: Vec<String> = node.args.iter().map(line).collect();
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
            Form::Infix(sign, tightness) => {
                let (left, sign, right) = self.sides(node, sign, tightness);
                Text::new(format!("{left} {sign} {right}"), tightness)
            }
            Form::Prefix(sign) => {
                let text = format!("{sign}{}", arg(0, precedence::PREFIX + 1));
                Text::new(text, precedence::PREFIX)
            }
            Form::Call(name) => Text::tight(format!("{name}({})", self.arguments(node))),
            Form::CallUnit(name) => {
                let [low, high] = [0.0, 1.0].map(|value| self.spelling.number(value));
                Text::tight(format!("{name}({}, {low}, {high})", arg(0, 0)))
            }
            Form::CallSelect(name) => {
                let [condition, yes, no] = [0, 1, 2].map(|i| arg(i, 0));
                Text::tight(format!("{name}({no}, {yes}, {condition})"))
            }
            Form::Postfix(suffix) => {
                Text::tight(format!("{}{suffix}", self.before_dot(node.args[0])))
            }
            Form::Channel => {
                let Payload::Index(index) = node.payload else {
                    unreachable!("a checked channel has an index")
                };
                let of = self.function.nodes[node.args[0]].ty;
                let letter = self.function.letters.letter(of, index);
                Text::tight(format!("{}.{letter}", arg(0, precedence::TIGHT)))
            }
            Form::Pattern(pattern) => self.filled(pattern, node),
            Form::Ternary => {
                let loose = precedence::TERNARY + 1;
                let text = format!("{} ? {} : {}", arg(0, loose), arg(1, loose), arg(2, loose));
                Text::new(text, precedence::TERNARY)
            }
        }
    }

    fn filled(&self, pattern: &str, node: &Node) -> Text {
        let mut text = match node.payload {
            Payload::Index(row) => pattern.replace("{w}", ["x", "y", "z", "w"][row]),
            _ => pattern.to_owned(),
        };
        for (i, arg) in node.args.iter().enumerate() {
            text = text.replace(&format!("{{{i}}}"), &self.expression(*arg).text);
        }
        Text::tight(text)
    }

    fn leaf(&self, node: &Node) -> Text {
        match node.payload {
            Payload::Number(value) if value.is_sign_negative() => {
                Text::new(self.spelling.number(value), precedence::PREFIX)
            }
            Payload::Number(value) => Text::tight(self.spelling.number(value)),
            Payload::Index(index) => Text::tight(self.function.params[index].name.clone()),
            Payload::None => unreachable!("a checked leaf carries its payload"),
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
        let mut arguments = Vec::new();
        for (i, arg) in node.args.iter().enumerate() {
            let inner = &self.function.nodes[*arg];
            let narrow = scalar_second && i == 1 && inner.op == Op::Splat && inner.label.is_none();
            let arg = if narrow { inner.args[0] } else { *arg };
            arguments.push(self.expression(arg).text);
        }
        arguments.join(", ")
    }

    /// The expression before a swizzle: a number needs parentheses there.
    fn before_dot(&self, id: NodeId) -> String {
        let text = self.expression(id);
        if self.function.nodes[id].op == Op::Number {
            format!("({})", text.text)
        } else {
            text.at(precedence::TIGHT)
        }
    }
}
