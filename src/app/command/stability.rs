//! `stability`: where methods fail.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::app::args::StabilityFlags;
use crate::app::error::Error;
use crate::app::names::{quoted, unknown};
use crate::app::request::Request;
use crate::app::source::materials;
use crate::app::write::write_files;
use crate::emit::{Bounds, Naming, Subject, specialised_function};
use crate::methods::{self, Class, Method};
use crate::report::png::png;
use crate::report::stability::{Row, heat, page, text};
use crate::verify::stability::{Finding, Precision, maps, scan, scan_specialised};

use super::{Output, Progress, report};

/// Pixels of a map to a unit of its drawing.
const SCALE: f32 = 1.0;

/// Scans.
pub fn run(flags: &StabilityFlags, progress: Progress) -> Result<Output, Error> {
    let methods = methods_of(&flags.method)?;
    let rows = if flags.material.is_empty() {
        libraries(&methods, progress)
    } else {
        specialised(flags, &methods, progress)?
    };
    let remarks = drawn(flags, &methods, &rows, progress)?;
    let json = json!({
        "tool": "fresnel-gen", "command": canonical(flags), "device": null,
        "rows": rows.iter().map(Row::json).collect::<Vec<Value>>(),
    });
    let mut output = report(text(&rows), &json, flags.json.as_deref())?;
    output.remarks.extend(remarks);
    Ok(output)
}

/// Draws the maps and the page into the folder asked for.
fn drawn(
    flags: &StabilityFlags,
    methods: &[&'static Method],
    rows: &[Row],
    progress: Progress,
) -> Result<Option<String>, Error> {
    let Some(folder) = &flags.out_dir else {
        return Ok(None);
    };
    let failed = |what: String| Error::Usage { what };
    let mut pictures = Vec::new();
    for (i, method) in methods.iter().enumerate() {
        progress(i as u64, methods.len() as u64, "maps");
        for map in maps(method, Precision::F32) {
            let picture = png(&heat(method.name, &map), SCALE).map_err(failed)?;
            pictures.push((method.name, map.axis.name, picture));
        }
    }
    let page = page(rows, &pictures, &canonical(flags)).map_err(failed)?;
    let named = |(method, over, bytes): &(&str, &str, Vec<u8>)| {
        (folder.join(format!("{method}_{over}.png")), bytes.clone())
    };
    let mut files: Vec<(PathBuf, Vec<u8>)> = pictures.iter().map(named).collect();
    files.push((folder.join("index.html"), page.into_bytes()));
    let borrowed: Vec<(PathBuf, &[u8])> = files
        .iter()
        .map(|(path, bytes)| (path.clone(), bytes.as_slice()))
        .collect();
    write_files(&borrowed)?;
    Ok(Some(format!(
        "{}: {} maps, and index.html that shows them",
        folder.display(),
        pictures.len()
    )))
}

/// The methods asked for; what reads a texture is as stable as its sampler.
fn methods_of(names: &[String]) -> Result<Vec<&'static Method>, Error> {
    let scanned: Vec<&'static Method> = methods::ALL
        .iter()
        .copied()
        .filter(|method| !method.is_textured())
        .collect();
    if names.is_empty() || names.iter().any(|name| name == "all") {
        return Ok(scanned);
    }
    let all: Vec<&str> = scanned.iter().map(|method| method.name).collect();
    let find = |name: &String| {
        let found = scanned.iter().find(|method| method.name == name);
        found.copied().ok_or_else(|| unknown("method", name, &all))
    };
    names.iter().map(find).collect()
}

fn libraries(methods: &[&'static Method], progress: Progress) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, method) in methods.iter().enumerate() {
        let mut told = |done: usize, total: usize| {
            let share = (1000 * done / total.max(1)) as u64;
            progress(
                1000 * i as u64 + share,
                1000 * methods.len() as u64,
                method.name,
            );
        };
        rows.extend(rows_of(
            method,
            None,
            scan(method, Precision::F32, &mut told),
        ));
    }
    rows
}

fn specialised(
    flags: &StabilityFlags,
    methods: &[&'static Method],
    progress: Progress,
) -> Result<Vec<Row>, Error> {
    let request = Request {
        materials: materials(&flags.material)?,
        ..Request::default()
    };
    let subjects: Vec<Subject> = request
        .subjects()?
        .ready
        .into_iter()
        .map(|(subject, _)| subject)
        .collect();
    let mut rows = Vec::new();
    for (i, subject) in subjects.iter().enumerate() {
        for method in methods.iter().filter(|method| {
            method.class == Class::Any || subject.effective.channels.is_transparent()
        }) {
            progress(i as u64, subjects.len() as u64, &subject.name);
            let emitted =
                specialised_function(method, subject, &Naming::default(), &Bounds::default())?;
            let truth = subject.truth_for(method);
            for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
                let found = scan_specialised(
                    &emitted.function,
                    channel,
                    &|c| truth.at(c)[channel],
                    Precision::F32,
                );
                rows.extend(rows_of(
                    method,
                    Some((subject.argument.clone(), name)),
                    found,
                ));
            }
        }
    }
    Ok(rows)
}

fn rows_of(
    method: &'static Method,
    material: Option<(String, &'static str)>,
    findings: Vec<Finding>,
) -> Vec<Row> {
    let row = |finding: Option<Finding>| Row {
        method: method.name,
        material: material.clone(),
        precision: Precision::F32.name,
        finding,
    };
    if findings.is_empty() {
        return vec![row(None)];
    }
    findings
        .into_iter()
        .map(|finding| row(Some(finding)))
        .collect()
}

fn canonical(flags: &StabilityFlags) -> String {
    let list = |name: &str, words: &[String]| {
        let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
        if words.is_empty() {
            String::new()
        } else {
            format!(" --{name} {}", words.join(","))
        }
    };
    format!(
        "stability{}{}",
        list("method", &flags.method),
        list("material", &flags.material)
    )
}
