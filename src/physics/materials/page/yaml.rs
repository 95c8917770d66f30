//! The YAML of a page: its fields as texts with their places. Aliases, and nesting deeper than any page's, are refused.

use crate::physics::user_text::FileFault;
use std::fmt;

use serde::Deserialize;
use serde::de::{MapAccess, Visitor};
use serde_saphyr::budget::BudgetBreach;
use serde_saphyr::{Error, Location, Options, Spanned};

use super::MOST_BYTES;

#[derive(Deserialize)]
pub struct Raw {
    #[serde(rename = "REFERENCES")]
    pub references: Option<String>,
    #[serde(rename = "COMMENTS")]
    pub comments: Option<String>,
    #[serde(rename = "CONDITIONS")]
    pub conditions: Option<Pairs>,
    #[serde(rename = "PROPERTIES")]
    pub properties: Option<Properties>,
    #[serde(rename = "DATA")]
    pub data: Option<Vec<Spanned<RawItem>>>,
}

#[derive(Deserialize)]
pub struct RawItem {
    #[serde(rename = "type")]
    pub kind: Option<Spanned<String>>,
    pub data: Option<Spanned<String>>,
    /// `range` in older releases of the database.
    #[serde(alias = "range")]
    pub wavelength_range: Option<Spanned<String>>,
    pub coefficients: Option<Spanned<String>>,
}

#[derive(Deserialize)]
pub struct Properties {
    nd: Option<String>,
}

impl Properties {
    /// The index at the d line, if it is a number.
    pub fn nd(&self) -> Option<f64> {
        let nd = self.nd.as_ref()?.parse::<f64>().ok()?;
        nd.is_finite().then_some(nd)
    }
}

/// Keys and their texts in the order of the page.
#[derive(Default)]
pub struct Pairs(Vec<(String, String)>);

impl Pairs {
    /// The pairs as `key: value, key: value`.
    pub fn said(&self) -> String {
        let said = |(key, value): &(String, String)| format!("{key}: {value}");
        self.0.iter().map(said).collect::<Vec<_>>().join(", ")
    }
}

impl<'de> Deserialize<'de> for Pairs {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Pairs, D::Error> {
        deserializer.deserialize_map(PairsVisitor)
    }
}

struct PairsVisitor;

impl<'de> Visitor<'de> for PairsVisitor {
    type Value = Pairs;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("lines of `key: value`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Pairs, A::Error> {
        let mut pairs = Vec::new();
        while let Some((key, value)) = map.next_entry::<String, Option<String>>()? {
            pairs.push((key, value.unwrap_or_default()));
        }
        Ok(Pairs(pairs))
    }
}

/// The fields of a page.
pub fn read(file: &str, text: &str) -> Result<Raw, FileFault> {
    serde_saphyr::from_str_with_options(text, options()).map_err(|error| {
        let line = error.location().map_or(1, |at| at.line() as usize).max(1);
        let column = error.location().map_or(1, |at| at.column() as usize).max(1);
        FileFault::new(file, line, column, message(&error))
    })
}

/// The parser's limits. A page of the database has some 150 events and is 5 deep. None has an anchor, with which a short text
/// can expand to gigabytes.
fn options() -> Options {
    const MOST_EVENTS: usize = 10_000;
    serde_saphyr::options! {
        budget: serde_saphyr::budget! {
            max_events: MOST_EVENTS,
            max_nodes: MOST_EVENTS,
            max_depth: 16,
            flow_nesting_limit: 16,
            max_documents: 1,
            max_anchors: 0,
            max_aliases: 0,
            max_merge_keys: 0,
            max_total_scalar_bytes: MOST_BYTES,
        },
        with_snippet: false,
    }
}

/// The parser's message without its place, which a fault prints in front, and without its advice to programmers.
fn message(error: &Error) -> String {
    const LONGEST: usize = 200;
    let error = error.without_snippet();
    if let Error::Budget { breach, .. } = error {
        return beyond(breach).to_owned();
    }
    let text = error.to_string().replace('\n', "; ");
    let text = text.split(" at line ").next().unwrap_or(&text);
    let advice = text.split(", set DuplicateKeyPolicy").next();
    advice.unwrap_or(text).chars().take(LONGEST).collect()
}

fn beyond(breach: &BudgetBreach) -> &'static str {
    match breach {
        BudgetBreach::Documents { .. } => "a second document; a page is one",
        BudgetBreach::Depth { .. } => "nested deeper than any page",
        BudgetBreach::Anchors { .. }
        | BudgetBreach::Aliases { .. }
        | BudgetBreach::MergeKeys { .. } => "no page has anchors or aliases, and they are not read",
        _ => "more than any page holds",
    }
}

/// The place of a fault in a field.
pub fn fault(file: &str, at: Location, what: String) -> FileFault {
    FileFault::new(file, at.line() as usize, at.column() as usize, what)
}
