//! `stability`: where methods fail.

use std::path::PathBuf;

use crate::app::args::StabilityFlags;
use crate::app::error::Error;
use crate::app::names::{flag, unknown};
use crate::app::precision::named;
use crate::app::request::Request;
use crate::app::source::materials;
use crate::app::write::{try_places_of_ours, write_report};
use crate::emit::{Bounds, Naming, specialised_function};
use crate::methods::{self, Method};
use crate::num::Precision;
use crate::reference::Subject;
use crate::report::Report;
use crate::report::stability::{Row, heat, page, text};
use crate::stability::{Code, Finding, maps, scan, scan_specialised};

use super::{Output, Progress, png, replaced, report, try_places};

/// Pixels of a map to a unit of its drawing.
const SCALE: f32 = 1.0;

/// What is scanned.
struct Asked<'a> {
    flags: &'a StabilityFlags,
    methods: Vec<&'static Method>,
    precision: Precision,
}

/// The page in the folder asked for.
fn index(precision: Precision) -> String {
    format!("index{}.html", precision.suffix())
}

/// Scans.
pub fn run(flags: &StabilityFlags, progress: Progress) -> Result<Output, Error> {
    let precision = named(flags.precision.as_deref())?;
    let is_library = flags.material.is_empty();
    let (methods, left_out) = methods_of(&flags.method, precision, is_library)?;
    let asked = Asked {
        flags,
        methods,
        precision,
    };
    let page = flags
        .out_dir
        .as_ref()
        .map(|folder| folder.join(index(precision)));
    try_places(flags.json.as_deref(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.overwrite)?;
    let rows = if flags.material.is_empty() {
        asked.libraries(progress)
    } else {
        asked.specialised(progress)?
    };
    if rows.is_empty() {
        let what = "there is nothing to scan: no such method for these materials".to_owned();
        return Err(Error::Usage { what });
    }
    let json = Report::new(canonical(flags), rows.iter().map(Row::json).collect());
    let drawn = asked.drawn(&rows, progress)?;
    let mut output = report(text(&rows), &json, flags.json.as_deref())?;
    output.remarks.extend(left_out);
    output.remarks.extend(drawn);
    Ok(output)
}

/// The methods asked for, and why others are left out. What reads a texture is as stable as its sampler; what is not
/// written in this precision is scanned where it is named.
fn methods_of(
    names: &[String],
    precision: Precision,
    is_library: bool,
) -> Result<(Vec<&'static Method>, Vec<String>), Error> {
    let numeric = methods::ALL.iter().copied();
    let scanned: Vec<&'static Method> = numeric.filter(|method| !method.is_textured()).collect();
    if names.is_empty() || names.iter().any(|name| name == "all") {
        let refusal = |method: &&'static Method| {
            let why = if is_library {
                method.half.library_refusal()
            } else {
                method.half.refusal()
            };
            why.filter(|_| precision.is_half())
        };
        let told = |method: &&'static Method| {
            refusal(method).map(|why| format!("left out: {}: {why}", method.name))
        };
        let left_out = scanned.iter().filter_map(told).collect();
        let kept = scanned.iter().filter(|method| refusal(method).is_none());
        return Ok((kept.copied().collect(), left_out));
    }
    let all: Vec<&str> = scanned.iter().map(|method| method.name).collect();
    let find = |name: &String| {
        if methods::find(name).is_some_and(Method::is_textured) {
            let what =
                format!("`{name}` reads a texture, and is as stable as its sampler: not scanned");
            return Err(Error::Usage { what });
        }
        let found = scanned.iter().find(|method| method.name == name);
        found.copied().ok_or_else(|| unknown("method", name, &all))
    };
    let found: Result<Vec<&'static Method>, Error> = names.iter().map(find).collect();
    let mut found = found?;
    found.sort_by_key(|method| method.name);
    found.dedup_by_key(|method| method.name);
    Ok((found, Vec::new()))
}

impl Asked<'_> {
    fn libraries(&self, progress: Progress) -> Vec<Row> {
        const PARTS: u64 = 1000;
        let all = PARTS * self.methods.len() as u64;
        let mut rows = Vec::new();
        for (i, method) in self.methods.iter().enumerate() {
            let before = PARTS * i as u64;
            let mut told = |done: usize, total: usize| {
                let done = PARTS * done as u64 / total.max(1) as u64;
                progress(before + done, all, method.name);
            };
            let found = scan(method, self.precision, &mut told);
            rows.extend(self.rows(method, None, found));
        }
        rows
    }

    fn specialised(&self, progress: Progress) -> Result<Vec<Row>, Error> {
        let request = Request {
            materials: materials(&self.flags.material)?,
            ..Request::default()
        };
        let ready = request.subjects()?.ready;
        let mut rows = Vec::new();
        for (i, (subject, _)) in ready.iter().enumerate() {
            progress(i as u64, ready.len() as u64, &subject.name);
            let fits = |method: &&&Method| subject.is_described_by(method);
            for method in self.methods.iter().filter(fits) {
                rows.extend(self.channels(method, subject)?);
            }
        }
        Ok(rows)
    }

    fn channels(&self, method: &'static Method, subject: &Subject) -> Result<Vec<Row>, Error> {
        let function = |precision: Precision| {
            let naming = Naming {
                precision,
                ..Naming::default()
            };
            specialised_function(method, subject, &naming, &Bounds::recorded())
        };
        let code = Code {
            function: function(self.precision)?.function,
            meaning: function(Precision::F32)?.function,
            precision: self.precision,
        };
        let truth = subject.truth_for(method);
        let channel = |(channel, name): (usize, &'static str)| {
            let found = scan_specialised(&code, channel, &|c| truth.at(c)[channel]);
            self.rows(method, Some((subject.argument.clone(), name)), found)
        };
        let names = ["red", "green", "blue"].into_iter().enumerate();
        Ok(names.flat_map(channel).collect())
    }

    /// A row for each finding, or one that says that there is none.
    fn rows(
        &self,
        method: &'static Method,
        material: Option<(String, &'static str)>,
        findings: Vec<Finding>,
    ) -> Vec<Row> {
        let row = |finding: Option<Finding>| Row {
            method: method.name,
            material: material.clone(),
            precision: self.precision.name(),
            finding,
        };
        if findings.is_empty() {
            return vec![row(None)];
        }
        let all = findings.into_iter().map(Some);
        all.map(row).collect()
    }

    /// Draws the maps and the page into the folder asked for.
    fn drawn(&self, rows: &[Row], progress: Progress) -> Result<Vec<String>, Error> {
        let Some(folder) = &self.flags.out_dir else {
            return Ok(Vec::new());
        };
        let failed = |what: String| Error::Usage { what };
        let mut pictures = Vec::new();
        for (i, method) in self.methods.iter().enumerate() {
            progress(i as u64, self.methods.len() as u64, "maps");
            for map in maps(method, self.precision) {
                let picture = png(&heat(method.name, &map), SCALE)?;
                pictures.push((method.name, map.axis.name, picture));
            }
        }
        let page = page(rows, &pictures, &canonical(self.flags)).map_err(failed)?;
        let suffix = self.precision.suffix();
        let path = |method: &str, over: &str| folder.join(format!("{method}_{over}{suffix}.png"));
        let mut files: Vec<(PathBuf, &[u8])> = pictures
            .iter()
            .map(|(method, over, bytes)| (path(method, over), bytes.as_slice()))
            .collect();
        let index = index(self.precision);
        files.push((folder.join(&index), page.as_bytes()));
        let old = write_report(&files, self.flags.overwrite)?;
        let said = format!(
            "{}: {} maps, and {index} that shows them",
            folder.display(),
            pictures.len()
        );
        Ok(replaced(&old).chain([said]).collect())
    }
}

fn canonical(flags: &StabilityFlags) -> String {
    format!(
        "stability{}{}{}",
        flag("method", &flags.method),
        flag("material", &flags.material),
        flag("precision", flags.precision.as_slice())
    )
}
