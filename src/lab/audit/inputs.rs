//! The inputs of a function from outside. Those that need a value become variables that our function sets.

use std::collections::BTreeSet;

use super::hidden::{DeclaredTypes, HiddenInput, UnreadFault, distinct, held};
use super::language::Language;
use super::parts::{Part, PartKind};
use super::reach::{Reached, Use};
use super::type_names::TypeNames;
use super::variables::{Storage, Variable};
use crate::lab::verify::shader_words::Token;

/// An input with the value that the text gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Initialised {
    /// Its name.
    pub name: String,
    /// Its line.
    pub line: usize,
    /// The value as it is written.
    pub value: String,
}

impl Initialised {
    /// In words, for people.
    pub fn words(&self) -> String {
        format!("{} = {} (line {})", self.name, self.value, self.line)
    }
}

/// A piece of the text with its line and column.
pub type Piece = (usize, usize, String);

/// What the inputs of a function are found from.
pub struct Inputs<'a> {
    /// The language.
    pub language: Language,
    /// Names of types.
    pub names: &'a TypeNames,
    /// The text.
    pub code: &'a str,
    /// Its words.
    pub words: &'a [Token<'a>],
    /// Its parts.
    pub parts: &'a [Part],
    /// The parts that the function needs.
    pub reached: &'a Reached,
    /// The names with given values.
    pub given: &'a [&'a str],
}

impl Inputs<'_> {
    /// Whether a value is given for a variable, or for a part of it.
    fn is_given(&self, name: &str) -> bool {
        let is_of_it = |given: &&&str| {
            let rest = given.strip_prefix(name);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        self.given.iter().any(|given| is_of_it(&given))
    }

    /// Whether a variable has no value of its own.
    fn is_open(&self, variable: &Variable) -> bool {
        match variable.storage {
            Storage::Constant => false,
            Storage::Own if variable.value.is_some() => self.is_given(&variable.name),
            Storage::Own => !self.is_set_first(variable),
            Storage::Input => variable.value.is_none() || self.is_given(&variable.name),
        }
    }

    /// Whether a variable is set before it is read, either by each function that reads it or by the audited one.
    fn is_set_first(&self, variable: &Variable) -> bool {
        let (uses, start) = (&self.reached.uses, self.reached.start);
        let is_it = |one: &&Use| one.name == variable.name;
        let first = |part: usize| uses.iter().filter(is_it).find(|one| one.part == part);
        let sets = |one: &&Use| first(one.part).is_some_and(|first| first.is_set);
        let readers = uses.iter().filter(is_it).filter(|one| !sets(one));
        let mut readers: BTreeSet<usize> = readers.map(|one| one.part).collect();
        let calls = |one: &&Use, readers: &BTreeSet<usize>| {
            let mut names = readers.iter().flat_map(|place| self.parts[*place].names());
            names.any(|name| name == one.name)
        };
        loop {
            let callers = uses.iter().filter(|one| calls(one, &readers));
            let callers: BTreeSet<usize> = callers.map(|one| one.part).collect();
            if callers.is_subset(&readers) {
                break;
            }
            readers.extend(callers);
        }
        // A function's head holds its own name.
        let is_read = readers.remove(&start);
        let mut own = uses.iter().filter(|one| one.part == start);
        !is_read
            || own
                .find(|one| is_it(one) || calls(one, &readers))
                .is_some_and(|one| is_it(&one) && one.is_set)
    }

    /// The numbers that are read and have no value.
    ///
    /// # Errors
    /// Something that is read is not made of numbers.
    pub fn numbers(&self) -> Result<Vec<HiddenInput>, UnreadFault> {
        let types = DeclaredTypes::new(self.parts, self.names);
        let mut all = Vec::new();
        for place in &self.reached.parts {
            let part = &self.parts[*place];
            for used in &self.reached.uses {
                let mut found = match &part.kind {
                    PartKind::Variables(variables) | PartKind::Block(_, variables, None) => {
                        let mut variables = variables.iter();
                        match variables.find(|one| one.name == used.name && self.is_open(one)) {
                            Some(variable) => types.numbers(variable, used)?,
                            None => continue,
                        }
                    }
                    PartKind::Block(_, members, Some(name)) if *name == used.name => {
                        types.numbers_of_members(members, used)?
                    }
                    _ => continue,
                };
                self.check_order(used)?;
                for one in &mut found {
                    one.scope.clone_from(&part.scope);
                }
                all.extend(found);
            }
        }
        Ok(distinct(all))
    }

    /// Refuses a global variable that is computed from an input before our function has set that input.
    fn check_order(&self, used: &Use) -> Result<(), UnreadFault> {
        let Some(place) = used.by_global else {
            return Ok(());
        };
        let names = self.parts[place].names().join("`, `");
        Err((
            used.line,
            format!(
                "`{names}` is computed from `{}` outside of all functions: compute it in the function, or give it a value",
                used.name
            ),
        ))
    }

    /// The text of all parts that are reached, and the inputs whose values the text gives.
    pub fn pieces(&self, numbers: &[HiddenInput]) -> (Vec<Piece>, Vec<Initialised>) {
        let (mut pieces, mut initialised) = (Vec::new(), Vec::new());
        for place in &self.reached.parts {
            let part = &self.parts[*place];
            let first = &self.words[part.start];
            if let PartKind::Variables(all) | PartKind::Block(_, all, None) = &part.kind {
                initialised.extend(all.iter().filter_map(|one| self.initialised(one)));
            }
            let text = match &part.kind {
                PartKind::Variables(all) if all.iter().any(|one| self.is_rewritten(one)) => {
                    let used = all.iter().filter(|one| self.is_used(&one.name));
                    used.map(|one| self.declaration(one)).collect()
                }
                PartKind::Block(_, members, None) => {
                    let used = members.iter().filter(|one| self.is_used(&one.name));
                    used.map(|one| self.declaration(one)).collect()
                }
                PartKind::Block(name, members, Some(instance)) => {
                    let member =
                        |one: &Variable| format!("{} {}; ", one.ty, self.source(one.declarator));
                    let members: String = members.iter().map(member).collect();
                    format!("struct {name} {{ {members}}}; {name} {instance};")
                }
                // It names a namespace that may be empty by now.
                PartKind::Setting if first.text == "using" => {
                    let words = &self.words[part.start + 2..part.end];
                    let names = words.iter().filter(|word| word.is_word());
                    let names: Vec<String> = names.map(|word| word.text.to_owned()).collect();
                    scoped(&names, String::new()) + &self.source((part.start, part.end))
                }
                _ => self.source((part.start, part.end)),
            };
            pieces.push((first.line, first.column, scoped(&part.scope, text)));
        }
        let has_numbers = |one: &Initialised| {
            let is_of_it = |number: &HiddenInput| number.path.split('.').next() == Some(&one.name);
            numbers.iter().any(is_of_it)
        };
        initialised.retain(|one| !has_numbers(one));
        (pieces, initialised)
    }

    fn is_used(&self, name: &str) -> bool {
        self.reached.uses.iter().any(|one| one.name == name)
    }

    /// Whether its declaration is rewritten, because something else sets it or a value is given for it.
    fn is_rewritten(&self, variable: &Variable) -> bool {
        let is_given = variable.value.is_some() && self.is_open(variable);
        variable.storage == Storage::Input || is_given
    }

    /// The value of a variable that other code can set, where it is read before the function sets it.
    fn initialised(&self, variable: &Variable) -> Option<Initialised> {
        let is_taken = match variable.storage {
            Storage::Constant => false,
            Storage::Own => !self.is_set_first(variable),
            Storage::Input => true,
        };
        if !is_taken || !self.is_used(&variable.name) {
            return None;
        }
        Some(Initialised {
            name: variable.name.clone(),
            line: variable.line,
            value: flat(&self.source(variable.value?)),
        })
    }

    /// The declaration of an input as an ordinary variable of the text.
    fn declaration(&self, variable: &Variable) -> String {
        let Variable { ty, name, .. } = variable;
        let value = variable.value.filter(|_| !self.is_open(variable));
        let value = value.map(|value| flat(&self.source(value)));
        if self.language == Language::Wgsl {
            return match (value, ty.as_str()) {
                (Some(value), "") => format!("const {name} = {value};"),
                (Some(value), ty) => format!("const {name}: {ty} = {value};"),
                (None, "") => format!("var<private> {name}: f32;"),
                (None, ty) => format!("var<private> {name}: {ty};"),
            };
        }
        let keeps = match self.language {
            Language::Gles | Language::Glsl => "",
            _ => "static ",
        };
        let declarator = flat(&self.source(variable.declarator));
        let value = value.map_or(String::new(), |value| format!(" = {value}"));
        format!("{keeps}{} {declarator}{value};", held(ty))
    }

    /// The text of words from one place to another.
    fn source(&self, (from, to): (usize, usize)) -> String {
        let Some((first, last)) = self.words.get(from).zip(self.words.get(to.wrapping_sub(1)))
        else {
            return String::new();
        };
        let last_end = last.column + last.text.chars().count();
        let lines = self
            .code
            .lines()
            .skip(first.line - 1)
            .take(last.line + 1 - first.line);
        let cut: Vec<String> = lines
            .enumerate()
            .map(|(number, line)| {
                let begin = if number == 0 { first.column - 1 } else { 0 };
                let end = if number + first.line == last.line {
                    last_end - 1
                } else {
                    usize::MAX
                };
                line.chars().take(end).skip(begin).collect()
            })
            .collect();
        cut.join("\n")
    }
}

/// A text enclosed in its namespaces.
fn scoped(scope: &[String], text: String) -> String {
    let within = |text, name: &String| format!("namespace {name} {{ {text} }}");
    scope.iter().rev().fold(text, within)
}

fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
