//! The document that says where methods fail, written from a scan.

use std::collections::BTreeSet;
use std::mem::{Discriminant, discriminant};

use super::markdown::markdown_table;
use fresnel_gen::lab::stability::{Failure, Finding, StabilityRow};
use fresnel_gen::pictures::stability_map::{percent, worst};

const HEAD: &str = "# Where methods fail

In f32, what this program writes for use is a reflectance for every medium of the scan, at every cosine. Schlick's family knows neither
total reflection, nor indices near 1, nor the dip of metals. The textbook forms of the exact laws give NaN at 90 degrees, for a cosine
above 1 or past the critical angle, and lose all their digits near eta = 1 and k = 0.

Written by `fresnel-gen stability`, and held by a test. Each method was run in unfused f32 over its domain and past it: cosines from
-1 to 8 ulp above 1, indices from 0.001 to 1000 with 1 and its neighbours, k from subnormal numbers to 10000. Two things go wrong, and
they are never added:

- the **formula**, compared with the exact law: a large error at any angle; a missing minimum, where the exact curve of metals has
  one; a rise where the exact curve falls. Approximations are compared for k = 0 (over eta) and for k ≥ 0.1 (over n and k);
- its **rounding**, compared with the same formula in f64: NaN, infinities, results below 0 or above 1, steps that no slope explains, lost
  digits. What lies within 2 ulp of the cosine is no fault: at the critical angle and at Brewster's no rounding can do better.

A share says how much of a region fails. The methods marked *exempt* are textbook forms, kept for comparison.
`fresnel-gen stability --out-dir DIR` draws maps of all this.
";

/// The document of a scan in single precision and of one in half.
pub fn stability_document(rows: &[StabilityRow], half: &[StabilityRow]) -> String {
    let head = ["method", "failure", "where", "worst"];
    let findings_table = |rows, wanted| markdown_table(&head, grouped(rows, wanted).into_iter());
    let is_media = |finding: &Finding| finding.is_media;
    let of_media = |finding: &Finding| finding.is_media && !finding.failure.is_of_the_model();
    format!(
        "{HEAD}\n## Each method in a line\n\n{}\n## Media\n\n{}\n## Arguments that no medium has\n\n{}\n## Half precision\n\n{HALF}\n{}",
        markdown_table(
            &[
                "method",
                "its failures in f32, each with its largest region; all regions stand below"
            ],
            summaries(rows).into_iter()
        ),
        findings_table(rows, is_media),
        findings_table(rows, |finding| !finding.is_media),
        findings_table(half, of_media),
    )
}

const HALF: &str = "Rounded to f16 after every operation, at inputs that f16 has; the formulas' own errors are those above. Distances are \
absolute: 11 bits leave 0.0005 near 1. Methods that `--precision f16` refuses are not here; others that are not here do not fail.
";

/// A line for each method: its gravest failures over media, with the first of their regions.
fn summaries(rows: &[StabilityRow]) -> Vec<Vec<String>> {
    let methods: BTreeSet<&'static str> = rows.iter().map(|row| row.method.name).collect();
    let summary = |method: &'static str| {
        let of_method = rows.iter().filter(|row| row.method.name == method);
        let findings = of_method.filter_map(|row| row.finding.as_ref());
        let findings: Vec<&Finding> = findings.filter(|finding| finding.is_media).collect();
        let mut failures: Vec<String> = Vec::new();
        let mut kinds: Vec<Discriminant<Failure>> = Vec::new();
        for finding in &findings {
            // Of errors above several limits, and of several distances in ulp, the largest says enough.
            let kind = discriminant(&finding.failure);
            if !kinds.contains(&kind) {
                kinds.push(kind);
                failures.push(format!("{}: {}", finding.failure.words(), finding.region));
            }
        }
        let words = if failures.is_empty() {
            "no failure found".to_owned()
        } else {
            failures.join("; ")
        };
        vec![format!("`{method}`{}", exempt(method)), words]
    };
    methods.into_iter().map(summary).collect()
}

/// A line for each method and failure, with all its regions.
fn grouped(rows: &[StabilityRow], wanted: fn(&Finding) -> bool) -> Vec<Vec<String>> {
    let mut lines: Vec<(&'static str, Vec<&Finding>)> = Vec::new();
    let found = rows
        .iter()
        .filter_map(|row| Some((row.method.name, row.finding.as_ref()?)));
    for (method, finding) in found.filter(|(_, finding)| wanted(finding)) {
        match lines
            .iter_mut()
            .find(|(of, all)| *of == method && all[0].failure == finding.failure)
        {
            Some((_, all)) => all.push(finding),
            None => lines.push((method, vec![finding])),
        }
    }
    lines.sort_by_key(|(method, _)| *method);
    lines
        .iter()
        .map(|(method, findings)| line(method, findings))
        .collect()
}

fn line(method: &str, findings: &[&Finding]) -> Vec<String> {
    let region = |finding: &&Finding| {
        let share = if finding.share < 1.0 {
            format!(" ({})", percent(finding.share))
        } else {
            String::new()
        };
        finding.region.clone() + &share
    };
    let mut regions: Vec<String> = findings.iter().map(region).collect();
    let mut known = BTreeSet::new();
    regions.retain(|region| known.insert(region.clone()));
    let gravest = findings
        .iter()
        .reduce(|a, b| if b.amount > a.amount { b } else { a });
    vec![
        format!("`{method}`{}", exempt(method)),
        findings[0].failure.words(),
        regions.join("; "),
        gravest.map_or_else(String::new, |finding| worst(finding)),
    ]
}

fn exempt(method: &str) -> &'static str {
    use fresnel_gen::language::methods::{Contract, find};
    match find(method).map(|method| method.contract) {
        Some(Contract::Exempt(_)) => " (exempt)",
        _ => "",
    }
}
