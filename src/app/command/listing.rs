//! `methods` and `targets`: list and show.

use serde_json::{Value, json};

use crate::app::args::{Listing, ListingCommand};
use crate::app::error::Error;
use crate::app::names::unknown;
use crate::emit;
use crate::methods::{self, Contract, Method};
use crate::report::SCHEMA;
use crate::report::table;
use crate::targets::{self, Target};

use super::{Output, report};

/// `fresnel-gen methods`.
pub fn methods(flags: &Listing) -> Result<Output, Error> {
    let rows = || {
        methods::ALL
            .iter()
            .map(|m| [m.name.to_owned(), m.summary.to_owned(), m.source.line()])
            .collect()
    };
    let show = |name: &str| {
        let all: Vec<&str> = methods::ALL.iter().map(|method| method.name).collect();
        let method = methods::find(name).ok_or_else(|| unknown("method", name, &all))?;
        Ok((method_text(method), method_json(method)))
    };
    listing(flags, "methods", rows(), show)
}

/// `fresnel-gen targets`.
pub fn targets(flags: &Listing) -> Result<Output, Error> {
    let rows = targets::ALL
        .iter()
        .map(|t| [t.name, t.summary, t.source].map(str::to_owned))
        .collect();
    let show = |name: &str| {
        let all: Vec<&str> = targets::ALL.iter().map(|target| target.name).collect();
        let target = targets::find(name).ok_or_else(|| unknown("target", name, &all))?;
        Ok((target_text(target), target_json(target)))
    };
    listing(flags, "targets", rows, show)
}

fn listing(
    flags: &Listing,
    command: &str,
    rows: Vec<[String; 3]>,
    show: impl Fn(&str) -> Result<(String, Value), Error>,
) -> Result<Output, Error> {
    let (text, json) = match &flags.what {
        Some(ListingCommand::Show { name }) => show(name)?,
        Some(ListingCommand::List) | None => {
            let short: Vec<Vec<String>> = rows
                .iter()
                .map(|[name, summary, _]| vec![name.clone(), summary.clone()])
                .collect();
            let json_rows: Vec<Value> = rows
                .iter()
                .map(|[name, summary, source]| json!({ "name": name, "summary": summary, "source": source }))
                .collect();
            let full = json!({ "tool": "fresnel-gen", "schema": SCHEMA, "command": command, "device": null, "rows": json_rows });
            (table::text(&["name", "summary"], &short), full)
        }
    };
    report(text, &json, flags.json.as_deref())
}

fn method_text(method: &Method) -> String {
    let mut lines = vec![
        format!("{}: {}", method.name, method.summary),
        String::new(),
    ];
    lines.extend(method.formula.iter().map(|line| format!("  {line}")));
    lines.push(String::new());
    lines.push(format!("source      {}", method.source.line()));
    lines.push(format!("domain      {}", method.domain));
    lines.extend(
        method
            .inputs
            .iter()
            .map(|i| format!("argument    {}: {}; {}", i.name, i.meaning, i.range.words())),
    );
    lines.extend(emit::promises(method));
    lines.push(format!("in f16      {}", emit::half_promise(method)));
    if let Contract::Exempt(why) = method.contract {
        lines.push(format!("fails       {why}"));
    }
    lines.join("\n") + "\n"
}

fn method_json(method: &Method) -> Value {
    json!({
        "schema": SCHEMA, "name": method.name, "summary": method.summary, "source": method.source.line(),
        "formula": method.formula, "domain": method.domain,
        "arguments": method.inputs.iter()
            .map(|i| json!({ "name": i.name, "meaning": i.meaning, "domain": i.range.words() })).collect::<Vec<_>>(),
        "claims": method.claims.model.iter()
            .map(|c| json!({ "over": c.over.text(), "max_abs": c.max_abs })).collect::<Vec<_>>(),
        "code_ulp": method.claims.code_ulp,
        "f16": {
            "max_abs": method.half.claim().map(|claim| claim.max_abs),
            "over": method.half.claim().map(|claim| method.media(claim.over)),
            "reason": method.half.library_refusal(), "specialised": method.half.refusal().is_none(),
        },
    })
}

fn target_text(target: &Target) -> String {
    let mut lines = vec![
        format!("{}: {}", target.name, target.summary),
        format!("source      {}", target.source),
        format!("extension   {}", target.extension),
        format!(
            "by default  {}",
            if target.by_default {
                "yes"
            } else {
                "only by name"
            }
        ),
    ];
    for validator in target.validators {
        lines.push(format!(
            "validator   {}: {} ({})",
            validator.name,
            validator.command(),
            validator.compiler.get
        ));
    }
    lines.join("\n") + "\n"
}

fn target_json(target: &Target) -> Value {
    json!({
        "schema": SCHEMA, "name": target.name, "summary": target.summary, "source": target.source,
        "extension": target.extension, "by_default": target.by_default,
        "validators": target.validators.iter()
            .map(|v| json!({ "name": v.name, "command": v.command(), "get": v.compiler.get })).collect::<Vec<_>>(),
    })
}
