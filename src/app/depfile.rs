//! The depfile: which outputs depend on which inputs, in the syntax that Make and Ninja read.

use std::collections::BTreeSet;

/// One rule, `out1 out2: in1 in2`, each side sorted and without doubles.
pub fn depfile(outputs: &[String], inputs: &[String]) -> String {
    let outputs = escape_all(outputs);
    let inputs = escape_all(inputs);
    let space = if inputs.is_empty() { "" } else { " " };
    format!("{outputs}:{space}{inputs}\n")
}

fn escape_all(paths: &[String]) -> String {
    let paths: BTreeSet<&String> = paths.iter().collect();
    let paths: Vec<String> = paths.into_iter().map(|path| escape(path)).collect();
    paths.join(" ")
}

/// Make's quoting, as GCC 10 writes it and Ninja reads it: backslashes stand for themselves,
/// except before a space and at the end of a name, where they are doubled (Ninja knows no such ending).
fn escape(path: &str) -> String {
    let mut text = String::new();
    let mut backslashes = 0;
    for letter in path.chars() {
        match letter {
            ' ' | '\t' => text.push_str(&"\\".repeat(backslashes + 1)),
            '#' | ':' => text.push('\\'),
            '$' => text.push('$'),
            _ => {}
        }
        text.push(letter);
        backslashes = if letter == '\\' { backslashes + 1 } else { 0 };
    }
    text + &"\\".repeat(backslashes)
}
