//! `stability`: where methods fail.

use std::path::Path;

use crate::cli::args::{Choice, StabilityFlags};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::Request;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::lab::stability::{StabilityRow, Study, maps};
use crate::language::methods::{self, Method};
use crate::physics::num::Precision;
use crate::generator::envelope::Report;
use crate::pictures::stability_map::heat_map;
use crate::pictures::stability_map::stability_page;
use crate::cli::stability_text::stability_text;

use crate::cli::command::{Output, Progress, not_drawn, png, report_beside, try_places};

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
    let precision = flags.precision.unwrap_or_default();
    let is_library = flags.materials.material.is_empty();
    let (methods, left_out) = methods_of(&flags.method, precision, is_library);
    let study = Study { methods, precision };
    let asked = Asked { flags, study };
    let page = flags
        .pictures
        .folder()
        .map(|folder| folder.join(index(precision)));
    try_places(flags.report.json(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.pictures.overwrite)?;
    let rows = asked.rows(progress)?;
    if rows.is_empty() {
        return Err(RequestFault::NothingToDo {
            work: "scan",
            why: "no such method for these materials",
        }
        .into());
    }
    let json = Report::new(flags.command_line(), rows.clone());
    let (drawn, said) = match flags.pictures.folder() {
        Some(folder) => asked.drawn(&rows, folder, progress)?,
        None => (Vec::new(), None),
    };
    let mut output = report_beside(stability_text(&rows), &json, flags.report.json(), drawn)?;
    output.remarks.splice(0..0, left_out);
    output.remarks.extend(said);
    Ok(output)
}

/// The methods asked for, and why others are left out. What reads a texture is as stable as its sampler; what is not
/// written in this precision is scanned where it is named.
fn methods_of(
    words: &[Choice<&'static Method>],
    precision: Precision,
    is_library: bool,
) -> (Vec<&'static Method>, Vec<String>) {
    let numeric = methods::ALL.iter().copied();
    let numeric = numeric.filter(|method| !method.is_textured());
    let chosen = Choice::chosen(words, numeric, |method| method.name);
    let refusal = |method: &Method| match is_library {
        true => method.half.library_refusal(),
        false => method.half.refusal(),
    };
    if !Choice::is_all(words) || !precision.is_half() {
        return (chosen, Vec::new());
    }
    let left_out = chosen.iter().filter_map(|method| {
        refusal(method).map(|why| format!("left out: {}: {why}", method.name))
    });
    let left_out = left_out.collect();
    let kept = chosen
        .into_iter()
        .filter(|method| refusal(method).is_none());
    (kept.collect(), left_out)
}

impl Asked<'_> {
    fn rows(&self, progress: Progress) -> Result<Vec<StabilityRow>, Error> {
        if self.flags.materials.material.is_empty() {
            return Ok(self.study.library_rows(progress));
        }
        let request = Request {
            materials: self.flags.materials.materials()?,
            ..Request::default()
        };
        let subjects = request.subjects()?.materials();
        Ok(self.study.specialised_rows(&subjects, progress)?)
    }

    /// The maps and the page, as files that are to be written, and what is said of them.
    fn drawn(
        &self,
        rows: &[StabilityRow],
        folder: &Path,
        progress: Progress,
    ) -> Result<(Vec<OutputFile>, Option<String>), Error> {
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
        let index = index(self.study.precision);
        let said = format!(
            "{}: {} maps, and {index} that shows them",
            crate::physics::foreign::path(&folder),
            pictures.len()
        );
        let overwrite = self.flags.pictures.overwrite;
        let map =
            |(method, over, bytes)| OutputFile::of_report(path(method, over), bytes, overwrite);
        let maps = pictures.into_iter().map(map);
        let page = OutputFile::of_report(folder.join(&index), page, overwrite);
        Ok((maps.chain([page]).collect(), Some(said)))
    }
}
