//! The parser of a graph's text form, which `print` writes: one step a line, `name = operation arguments # why`.
//!
//! ```text
//! fn schlick(cos_theta: scalar, f0: rgb) -> rgb
//!   c = saturate cos_theta # clamped first
//!   %0 = sub 1 c
//!   ...
//!   return f
//! ```
//! An argument is a number, the name of a parameter or step, or the `%i` of a step without a name.

use std::collections::BTreeMap;

use fresnel_gen::language::ir::{
    Function, Label, Letters, Node, NodeId, OPS, Op, Param, Payload, Signature, Ty,
};

/// Why a line does not parse.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct ParseError {
    /// The line number, from 1.
    pub line: usize,
    /// What was wrong, and what is allowed.
    pub what: String,
}

/// Parses a function. Types are inferred. `check` does the other checks.
///
/// # Errors
/// A line is not the text form of a head, a node or a return, or uses a name that no earlier line defines.
pub fn parse(text: &str) -> Result<Function, ParseError> {
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line))
        .filter(|(_, line)| !line.trim().is_empty());
    let (line, head) = lines
        .next()
        .ok_or_else(|| fault(1, "an empty text; expected `fn name(...) -> type`"))?;
    let (name, params, ty) = parse_head(line, head)?;
    let letters = if head.contains("vec3") {
        Letters::Xyz
    } else {
        Letters::Rgb
    };
    let mut parser = Parser {
        known: BTreeMap::new(),
        nodes: Vec::new(),
        params,
    };
    for (line, text) in lines {
        if let Some(result) = text.trim().strip_prefix("return ") {
            let result = parser.argument(line, result.trim())?;
            if parser.nodes[result].ty != ty {
                let what = format!(
                    "a {} is returned; the head says {}",
                    parser.nodes[result].ty.name(),
                    ty.name()
                );
                return Err(fault(line, what));
            }
            let whole = Function {
                name,
                params: parser.params,
                nodes: parser.nodes,
                result,
                letters,
            };
            return Ok(whole.compact());
        }
        parser.step(line, text)?;
    }
    Err(fault(
        text.lines().count(),
        "the text ends without `return`",
    ))
}

fn fault(line: usize, what: impl Into<String>) -> ParseError {
    ParseError {
        line,
        what: what.into(),
    }
}

fn parse_head(line: usize, head: &str) -> Result<(String, Vec<Param>, Ty), ParseError> {
    let wrong = || {
        fault(
            line,
            format!("`{head}`; expected `fn name(argument: scalar, argument: rgb) -> type`"),
        )
    };
    let (name, rest) = head
        .strip_prefix("fn ")
        .and_then(|h| h.split_once('('))
        .ok_or_else(wrong)?;
    let (inside, returned) = rest.split_once(") -> ").ok_or_else(wrong)?;
    let number = |name: &str| {
        let arguments = [
            Ty::Scalar,
            Ty::Vec3,
            Ty::Texture,
            Ty::Cube,
            Ty::Vec2,
            Ty::Vec4,
            Ty::Mat4,
        ];
        let mut types = arguments.into_iter();
        match name.trim() {
            "vec3" => Some(Ty::Vec3),
            name => types.find(|ty| ty.name() == name),
        }
    };
    let param = |text: &str| {
        let (name, ty) = text.split_once(':').ok_or_else(wrong)?;
        let ty = number(ty).ok_or_else(wrong)?;
        Ok(Param {
            name: name.trim().to_owned(),
            ty,
        })
    };
    let params = inside
        .split(',')
        .filter(|p| !p.trim().is_empty())
        .map(param)
        .collect::<Result<_, _>>()?;
    Ok((
        name.trim().to_owned(),
        params,
        number(returned).ok_or_else(wrong)?,
    ))
}

struct Parser {
    known: BTreeMap<String, NodeId>,
    nodes: Vec<Node>,
    params: Vec<Param>,
}

impl Parser {
    fn step(&mut self, line: usize, text: &str) -> Result<(), ParseError> {
        let (code, why) = text.split_once('#').unwrap_or((text, ""));
        let (name, code) = code
            .split_once('=')
            .ok_or_else(|| fault(line, "expected `name = operation arguments`"))?;
        let mut words = code.split_whitespace();
        let op = words.next().and_then(operation).ok_or_else(|| {
            let all: Vec<&str> = OPS.iter().map(|row| row.name).collect();
            fault(
                line,
                format!("no such operation; there are {}", all.join(", ")),
            )
        })?;
        let payload = match op.info().signature {
            Signature::Channel | Signature::Transform => Payload::Index(index(line, words.next())?),
            _ => Payload::None,
        };
        let args = words
            .map(|word| self.argument(line, word))
            .collect::<Result<Vec<_>, _>>()?;
        let types: Vec<Ty> = args.iter().map(|a| self.nodes[*a].ty).collect();
        let ty = op.info().signature.result(&types);
        let ty = ty.ok_or_else(|| {
            fault(
                line,
                format!("`{}` does not take {types:?}", op.info().name),
            )
        })?;
        let indices = op.info().signature.indices(&types);
        if let (Payload::Index(index), Some(count)) = (payload, indices)
            && index >= count
        {
            let last = count - 1;
            let what = format!(
                "`{}` has no {index} here; the last is {last}",
                op.info().name
            );
            return Err(fault(line, what));
        }
        let name = name.trim().to_owned();
        let label = (!name.starts_with('%')).then(|| Label {
            name: name.clone(),
            why: why.trim().to_owned(),
        });
        self.nodes.push(Node {
            op,
            args,
            payload,
            ty,
            label,
        });
        self.known.insert(name, self.nodes.len() - 1);
        Ok(())
    }

    fn argument(&mut self, line: usize, word: &str) -> Result<NodeId, ParseError> {
        if let Some(id) = self.known.get(word) {
            return Ok(*id);
        }
        let param = self.params.iter().position(|param| param.name == word);
        let (op, payload, ty) = match (param, word.parse::<f64>()) {
            (Some(index), _) => (Op::Param, Payload::Index(index), self.params[index].ty),
            (None, Ok(value)) if value.is_finite() => {
                (Op::Number, Payload::Number(value), Ty::Scalar)
            }
            _ => {
                return Err(fault(
                    line,
                    format!("`{word}` is no number, parameter or earlier step"),
                ));
            }
        };
        self.nodes.push(Node {
            op,
            args: Vec::new(),
            payload,
            ty,
            label: None,
        });
        self.known.insert(word.to_owned(), self.nodes.len() - 1);
        Ok(self.nodes.len() - 1)
    }
}

fn index(line: usize, word: Option<&str>) -> Result<usize, ParseError> {
    let index = word.and_then(|word| word.parse().ok());
    index.ok_or_else(|| {
        fault(
            line,
            "expected a channel or a row: 0, 1 or 2, and 3 of four",
        )
    })
}

fn operation(name: &str) -> Option<Op> {
    OPS.iter().find(|row| row.name == name).map(|row| row.op)
}
