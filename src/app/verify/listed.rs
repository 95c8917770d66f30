//! What the manifest says of a file, against what is true of it today: functions, signatures, errors, costs.

use serde_json::Value;

use crate::app::manifest::{self, Entry, Manifest};

/// What is said of a function and can be false.
const CLAIMS: [&str; 13] = [
    "method",
    "form",
    "signature",
    "parameters",
    "operations",
    "fetches",
    "code_error",
    "model_error",
    "average",
    "average_unlimited",
    "entry_point",
    "uniforms",
    "licence",
];

/// The manifest's entry of a file.
pub(super) struct Listed<'a> {
    entry: &'a Entry,
    text: &'a str,
}

impl<'a> Listed<'a> {
    /// The entry of a file, where there is one.
    pub fn new(manifest: &'a Manifest, text: &'a str, path: &str) -> Option<Listed<'a>> {
        let entry = manifest.files.iter().find(|entry| entry.file == path)?;
        Some(Listed { entry, text })
    }

    fn functions(&self) -> &'a [Value] {
        let functions = self.entry.detail.get("functions").and_then(Value::as_array);
        functions.map_or(&[], Vec::as_slice)
    }

    /// Whether it lists a function.
    pub fn has(&self, name: &str) -> bool {
        self.functions()
            .iter()
            .any(|function| function["name"] == name)
    }

    /// What it says and is not so, against what would be listed today.
    pub fn findings(&self, today: &Value) -> Vec<String> {
        // As it would be read again: numbers compare by their digits.
        let today: Value = serde_json::from_str(&today.to_string()).unwrap_or_default();
        let mut found = Vec::new();
        for function in self.functions() {
            let name = function["name"].as_str().unwrap_or_default();
            match functions(&today).iter().find(|other| other["name"] == name) {
                None => found.push(self.finding(
                    name,
                    "name",
                    "lists it, and fresnel-gen does not write it",
                )),
                Some(right) => found.extend(self.claims(name, function, right)),
            }
        }
        if let Some(seen) = self
            .entry
            .detail
            .get("seen")
            .filter(|seen| **seen != today["seen"])
        {
            found.push(format!(
                "{}:{}: of {} it says `seen` is {seen}, and right is {}",
                manifest::FILE,
                self.line(&["\"seen\":"]),
                self.entry.file,
                today["seen"]
            ));
        }
        found
    }

    fn claims(&self, name: &str, function: &Value, right: &Value) -> Vec<String> {
        let is_false = |claim: &&&str| {
            function
                .get(**claim)
                .is_some_and(|said| *said != right[**claim])
        };
        let words = |claim: &&str| {
            let what = format!(
                "says `{claim}` is {}, and right is {}",
                function[*claim], right[*claim]
            );
            self.finding(name, claim, &what)
        };
        CLAIMS.iter().filter(is_false).map(words).collect()
    }

    fn finding(&self, name: &str, claim: &str, what: &str) -> String {
        let line = self.line(&[&format!("\"name\": \"{name}\""), &format!("\"{claim}\":")]);
        format!(
            "{}:{line}: of {name} in {} it {what}",
            manifest::FILE,
            self.entry.file
        )
    }

    /// The line of a claim: below that of the file, and of what stands between.
    fn line(&self, marks: &[&str]) -> usize {
        let file = format!("\"file\": \"{}\"", self.entry.file);
        let mut lines = self.text.lines().enumerate().peekable();
        let mut at = 1;
        for mark in [file.as_str()].iter().chain(marks) {
            while let Some((i, line)) = lines.peek() {
                if line.contains(mark) {
                    at = i + 1;
                    break;
                }
                lines.next();
            }
        }
        at
    }
}

/// The functions that a file's detail names.
pub(super) fn functions(detail: &Value) -> &[Value] {
    detail["functions"].as_array().map_or(&[], Vec::as_slice)
}
