//! The depfile: which outputs depend on which inputs, in the syntax that Make and Ninja read.
//!
//! A path is spelt so that both read it. Some paths cannot be. In Make, `;` begins a recipe, `=` an assignment and `|` order-only
//! prerequisites, and quoting does not help. Nor does it help a backslash before `#` or `:`. At the other characters of
//! `UNREADABLE`, Ninja ends a name, or Make takes them for patterns. `%` in a target can be written `\\%` for Make, but not for
//! Ninja. `[` is a pattern in Make, and `\[` names another file in Ninja.

use std::collections::BTreeSet;

use crate::generator::error::{Error, RequestFault};

/// Characters that no spelling brings through both programs, measured with GNU Make 4.3 and Ninja 1.11.
const UNREADABLE: &str = "\"%&'*;<=>?^`|\t\n\r";

/// One rule, `out1 out2: in1 in2`, without duplicates. Outputs keep the order given, since Ninja takes the first for its own.
/// Inputs are sorted. An empty rule for each input follows, as `gcc -MP` writes it, so that Make goes on after an input was
/// renamed or removed.
///
/// # Errors
/// A path holds a character that Make or Ninja cannot read in a depfile.
pub fn depfile(outputs: &[String], inputs: &[String]) -> Result<String, Error> {
    if let Some(what) = outputs.iter().chain(inputs).find_map(|path| fault(path)) {
        return Err(RequestFault::refused(what).into());
    }
    let mut inputs = inputs.to_vec();
    inputs.sort();
    inputs.dedup();
    let empty = inputs.iter().filter(|input| !outputs.contains(input));
    let empty: String = empty.map(|input| format!("{}:\n", escape(input))).collect();
    let (outputs, inputs) = (spelt(outputs, escape), spelt(&inputs, escape));
    let space = if inputs.is_empty() { "" } else { " " };
    Ok(format!("{outputs}:{space}{inputs}\n{empty}"))
}

/// The path of this program, an input of all that it writes: another version writes other text. None where a depfile cannot hold
/// the path. That is no error, since nobody chose the path for this run.
pub fn own_program() -> Option<String> {
    let program = std::env::current_exe().ok()?;
    let path = program.to_str()?;
    fault(path).is_none().then(|| path.to_owned())
}

fn fault(path: &str) -> Option<String> {
    let letter = path.chars().find(|c| UNREADABLE.contains(*c));
    let pair = || ["\\#", "\\:"].into_iter().find(|pair| path.contains(pair));
    // Make expands a leading `~` to a home folder, takes a final `)` for the end of an archive's member, and `[` with a later `]`
    // for a pattern.
    let home = || path.starts_with('~').then_some("~");
    let member = || (path.contains('(') && path.ends_with(')')).then_some(")");
    let choice = || {
        let (_, rest) = path.split_once('[')?;
        rest.contains(']').then_some("[")
    };
    let others = || pair().or_else(home).or_else(member).or_else(choice);
    let wrong = letter
        .map(String::from)
        .or_else(|| others().map(str::to_owned))?;
    Some(format!(
        "--depfile: the path {path:?} holds {wrong:?}, which Make and Ninja cannot both read in a depfile; rename it, or leave --depfile out"
    ))
}

fn spelt(paths: &[String], spell: impl Fn(&str) -> String) -> String {
    let mut seen = BTreeSet::new();
    let paths = paths.iter().filter(|path| seen.insert(*path));
    paths.map(|path| spell(path)).collect::<Vec<_>>().join(" ")
}

/// Make's quoting, as GCC 10 writes it and Ninja reads it. Backslashes stand for themselves, except before a space and at the end
/// of a name. There they are doubled, although Ninja cannot read a name that ends so.
fn escape(path: &str) -> String {
    let mut text = String::new();
    let mut backslashes = 0;
    for letter in path.chars() {
        match letter {
            ' ' => text.push_str(&"\\".repeat(backslashes + 1)),
            '#' | ':' => text.push('\\'),
            '$' => text.push('$'),
            _ => {}
        }
        text.push(letter);
        backslashes = if letter == '\\' { backslashes + 1 } else { 0 };
    }
    text + &"\\".repeat(backslashes)
}
