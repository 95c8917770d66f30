//! `stability`: where methods fail.

use std::path::PathBuf;

use crate::app::args::StabilityFlags;
use crate::app::error::Error;
use crate::app::fault::RequestFault;
use crate::app::names::unknown;
use crate::app::precision::named;
use crate::app::request::Request;
use crate::app::source::materials;
use crate::app::write::{try_places_of_ours, write_report};
use crate::methods::{self, Method};
use crate::num::Precision;
use crate::report::Report;
use crate::report::stability::{heat_map, stability_page, stability_text};
use crate::stability::{StabilityRow, Study, maps};

use super::{Output, Progress, not_drawn, png, replaced, report, try_places};

/// Pixels of a map to a unit of its drawing.
const SCALE: f32 = 1.0;

/// What is scanned.
struct Asked<'a> {
    flags: &'a StabilityFlags,
    study: Study,
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
    let study = Study { methods, precision };
    let asked = Asked { flags, study };
    let page = flags
        .out_dir
        .as_ref()
        .map(|folder| folder.join(index(precision)));
    try_places(flags.json.as_deref(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.overwrite)?;
    let rows = asked.rows(progress)?;
    if rows.is_empty() {
        return Err(RequestFault::NothingToDo {
            work: "scan",
            why: "no such method for these materials",
        }
        .into());
    }
    let json = Report::new(flags.command_line(), rows.clone());
    let drawn = asked.drawn(&rows, progress)?;
    let mut output = report(stability_text(&rows), &json, flags.json.as_deref())?;
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
    fn rows(&self, progress: Progress) -> Result<Vec<StabilityRow>, Error> {
        if self.flags.material.is_empty() {
            return Ok(self.study.library_rows(progress));
        }
        let request = Request {
            materials: materials(&self.flags.material)?,
            ..Request::default()
        };
        let subjects = request.subjects()?.materials();
        Ok(self.study.specialised_rows(&subjects, progress)?)
    }

    /// Draws the maps and the page into the folder asked for.
    fn drawn(&self, rows: &[StabilityRow], progress: Progress) -> Result<Vec<String>, Error> {
        let Some(folder) = &self.flags.out_dir else {
            return Ok(Vec::new());
        };
        let failed = not_drawn;
        let mut pictures = Vec::new();
        for (i, method) in self.study.methods.iter().enumerate() {
            progress(i as u64, self.study.methods.len() as u64, "maps");
            for map in maps(method, self.study.precision) {
                let picture = png(&heat_map(method.name, &map), SCALE)?;
                pictures.push((method.name, map.axis.name, picture));
            }
        }
        let page = stability_page(rows, &pictures, &String::from(self.flags.command_line()))
            .map_err(failed)?;
        let suffix = self.study.precision.suffix();
        let path = |method: &str, over: &str| folder.join(format!("{method}_{over}{suffix}.png"));
        let mut files: Vec<(PathBuf, &[u8])> = pictures
            .iter()
            .map(|(method, over, bytes)| (path(method, over), bytes.as_slice()))
            .collect();
        let index = index(self.study.precision);
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
