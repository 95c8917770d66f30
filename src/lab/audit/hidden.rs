//! The inputs of a function that are not arguments: uniforms, members of blocks, and variables set by other shader stages or the
//! host. Each number among them needs a value, as an argument does. An input that is not made of numbers is named and refused.

use std::collections::BTreeMap;

use super::parts::{Part, PartKind};
use super::reach::Use;
use super::type_names::TypeNames;
use super::variables::Variable;
use crate::lab::verify::function_head::{NumberShape, type_shape};
use crate::lab::verify::shader_words::tokens;

/// A number, or three, that a function reads from outside of itself.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HiddenInput {
    /// Its name in the text: `water.bias`, `params.x`.
    pub path: String,
    /// The line where it is declared.
    pub line: usize,
    /// Whether it is three numbers.
    pub is_rgb: bool,
    /// The type that the number is converted to, where that is not a floating-point type.
    pub cast: Option<String>,
    /// The namespaces that it stands in.
    pub scope: Vec<String>,
}

impl HiddenInput {
    /// The variables that it is assigned to, each with the channel of the value.
    pub fn places(&self) -> Vec<(String, &'static str)> {
        let around = self.scope.iter().filter(|name| !name.is_empty());
        let around: String = around.map(|name| format!("{name}::")).collect();
        match self.path.strip_suffix(".rgb") {
            Some(path) if self.is_rgb => ["x", "y", "z"]
                .map(|channel| (format!("{around}{path}.{channel}"), channel))
                .to_vec(),
            _ => vec![(around + &self.path, "")],
        }
    }
}

/// The line of a read, and why no number can stand for it.
pub type UnreadFault = (usize, String);

/// The types that a text declares.
pub struct DeclaredTypes<'a> {
    /// Their members.
    members: BTreeMap<&'a str, &'a [Variable]>,
    names: &'a TypeNames,
}

impl<'a> DeclaredTypes<'a> {
    /// The types among these parts.
    pub fn new(parts: &'a [Part], names: &'a TypeNames) -> DeclaredTypes<'a> {
        let types = parts.iter().filter_map(|part| match &part.kind {
            PartKind::Type(name, members, _) if !members.is_empty() => {
                Some((name.as_str(), members.as_slice()))
            }
            _ => None,
        });
        DeclaredTypes {
            members: types.collect(),
            names,
        }
    }

    /// The numbers of a variable that a use of it reads.
    ///
    /// # Errors
    /// It reads something that is not a number.
    pub fn numbers(
        &self,
        variable: &Variable,
        used: &Use,
    ) -> Result<Vec<HiddenInput>, UnreadFault> {
        let mut found = Vec::new();
        let walk = Walk {
            root: variable,
            used,
        };
        self.enter(&walk, &variable.name, variable, &used.path, &mut found)?;
        Ok(found)
    }

    /// The numbers that a use reads of the members of a named block.
    ///
    /// # Errors
    /// It reads something that is not a number.
    pub fn numbers_of_members(
        &self,
        members: &[Variable],
        used: &Use,
    ) -> Result<Vec<HiddenInput>, UnreadFault> {
        let mut found = Vec::new();
        for member in members_at(members, &used.path) {
            let walk = Walk { root: member, used };
            let path = format!("{}.{}", used.name, member.name);
            self.enter(&walk, &path, member, behind_first(&used.path), &mut found)?;
        }
        Ok(found)
    }

    fn enter(
        &self,
        walk: &Walk,
        path: &str,
        variable: &Variable,
        rest: &[String],
        found: &mut Vec<HiddenInput>,
    ) -> Result<(), UnreadFault> {
        let (ty, number) = self.number_type(&variable.ty);
        let members = self.members.get(ty.as_str());
        let mut add = |path: String, is_rgb: bool, cast: Option<String>| {
            found.push(HiddenInput {
                path,
                line: walk.root.line,
                is_rgb,
                cast,
                scope: Vec::new(),
            });
        };
        let is_whole = !variable.is_array;
        match (number, members) {
            (Some(number), _) if is_whole && (!walk.used.is_indexed || !rest.is_empty()) => {
                match number {
                    NumberType::One(cast) => add(path.to_owned(), false, cast),
                    NumberType::Three => add(path.to_owned(), true, None),
                    NumberType::Components(count) => {
                        for letters in components(count, rest.first().map(String::as_str)) {
                            add(format!("{path}.{letters}"), letters == "rgb", None);
                        }
                    }
                }
                Ok(())
            }
            (None, Some(members)) if is_whole && path.len() < LONGEST => {
                let mut each = members_at(members, rest);
                each.try_for_each(|member| {
                    let path = format!("{path}.{}", member.name);
                    self.enter(walk, &path, member, behind_first(rest), found)
                })
            }
            _ => {
                let array = if is_whole { "" } else { "an array of " };
                Err((
                    walk.used.line,
                    format!(
                        "it reads `{path}` (line {}), {array}{ty}, which no number stands for: give the function what it takes from it as an argument",
                        walk.root.line
                    ),
                ))
            }
        }
    }

    /// A type without its precision, and its numbers.
    fn number_type(&self, written: &str) -> (String, Option<NumberType>) {
        let written = tokens(held(written));
        let words = self.names.replaced(&written);
        let precisions = ["highp", "mediump", "lowp"];
        let words = words.iter().map(|token| token.text);
        let words: Vec<&str> = words.filter(|word| !precisions.contains(word)).collect();
        let ty = words.concat();
        let number = match ty.as_str() {
            "int" | "uint" | "bool" | "i32" | "u32" | "min16int" | "min16uint" | "int16_t" => {
                Some(NumberType::One(Some(ty.clone())))
            }
            "vec2" | "float2" | "half2" | "min16float2" | "vec2f" | "vec2<f32>" => {
                Some(NumberType::Components(2))
            }
            "vec4" | "float4" | "half4" | "min16float4" | "vec4f" | "vec4<f32>" => {
                Some(NumberType::Components(4))
            }
            _ => match type_shape(&words) {
                Some(Some(NumberShape::Scalar)) => Some(NumberType::One(None)),
                Some(Some(NumberShape::Rgb)) => Some(NumberType::Three),
                _ => None,
            },
        };
        (ty, number)
    }
}

/// The type that a buffer's type holds: `T` of `ConstantBuffer < T >`.
pub fn held(ty: &str) -> &str {
    let inside = ["ConstantBuffer", "ParameterBlock"]
        .iter()
        .find_map(|name| ty.strip_prefix(name))
        .and_then(|rest| rest.trim().strip_prefix('<'))
        .and_then(|rest| rest.strip_suffix('>'));
    inside.map_or(ty, str::trim)
}

/// A longer name of a member means that a type contains itself.
const LONGEST: usize = 400;

/// A variable whose numbers are being collected, and the use that reads them.
struct Walk<'a> {
    root: &'a Variable,
    used: &'a Use,
}

/// The member that a path names first, or all members where it names none.
fn members_at<'a>(
    members: &'a [Variable],
    path: &'a [String],
) -> impl Iterator<Item = &'a Variable> {
    let is_named = |member: &&Variable| path.first().is_none_or(|first| *first == member.name);
    members.iter().filter(is_named)
}

/// The path without its first name.
fn behind_first(path: &[String]) -> &[String] {
    path.get(1..).unwrap_or_default()
}

/// The numbers of a type.
enum NumberType {
    /// One, with the type that it is converted to.
    One(Option<String>),
    Three,
    /// Two or four separate numbers. The first three of four may be a colour.
    Components(usize),
}

/// The components of a vector that a swizzle takes.
fn components(count: usize, swizzle: Option<&str>) -> Vec<&'static str> {
    const LETTERS: [(&str, &str); 4] = [("x", "r"), ("y", "g"), ("z", "b"), ("w", "a")];
    match (swizzle, count) {
        (Some("rgb" | "xyz"), 4) => vec!["rgb"],
        (None, 4) => vec!["rgb", "w"],
        (None, _) => vec!["x", "y"],
        (Some(swizzle), _) => {
            let is_taken =
                |(x, r): &&(&'static str, &str)| swizzle.contains(x) || swizzle.contains(r);
            LETTERS.iter().filter(is_taken).map(|(x, _)| *x).collect()
        }
    }
}

/// Numbers in order, each once. A colour stands for its components.
pub fn distinct(mut all: Vec<HiddenInput>) -> Vec<HiddenInput> {
    all.sort_by(|a, b| (a.line, &a.path).cmp(&(b.line, &b.path)));
    all.dedup();
    let colours: Vec<String> = all
        .iter()
        .filter_map(|one| one.path.strip_suffix(".rgb").map(str::to_owned))
        .collect();
    let is_part = |one: &HiddenInput| {
        let split = one.path.rsplit_once('.');
        split.is_some_and(|(path, letter)| {
            ["x", "y", "z"].contains(&letter) && colours.iter().any(|colour| colour == path)
        })
    };
    all.retain(|one| !is_part(one));
    all
}
