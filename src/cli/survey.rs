//! `materials survey`: every page of refractiveindex.info below a folder.

use std::collections::BTreeMap;
use std::path::Path;

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::cli::error::Error;
use crate::cli::materials::SurveyFlags;
use crate::cli::output::{Output, Progress, report};
use crate::generator;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::generator::fit::{PageOutcome, SURVEYED_ANGLES, SurveyedPage, survey_page};
use crate::generator::request::source::{pages, read};
use crate::physics::foreign::one_line;
use crate::physics::materials::ViewingConditions;
use crate::physics::spectra::Gamut;

/// `fresnel-gen materials survey FOLDER`.
pub fn run(flags: &SurveyFlags, json: Option<&Path>, progress: Progress) -> Result<Output, Error> {
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..flags.viewing.conditions()?
    };
    let files = pages(&flags.folder)?;
    if files.is_empty() {
        return Err(Error::usage(format!(
            "there is no page (.yml) below {}",
            crate::physics::foreign::path(&flags.folder)
        )));
    }
    let mut all: Vec<SurveyedPage> = Vec::with_capacity(files.len());
    for (done, file) in files.iter().enumerate() {
        progress(done as u64, files.len() as u64, "pages");
        all.push(surveyed(&flags.folder, file, &viewing));
    }
    let rows: Vec<SurveyRow> = all.iter().map(SurveyRow).collect();
    let full = Report::new(CommandLine::new("materials survey").seen_as(&viewing), rows);
    report(survey_text(&all), &full, json)
}

/// A page by its name below the folder, so that no report depends on the folder's place. A page that cannot be read is refused in
/// the same way as one that cannot be understood.
fn surveyed(folder: &Path, file: &str, viewing: &ViewingConditions) -> SurveyedPage {
    let (path, named) = if file.is_empty() {
        (folder.to_owned(), folder.display().to_string())
    } else {
        (folder.join(file), file.to_owned())
    };
    match read(&path.display().to_string()) {
        Ok(text) => survey_page(&named, &text, viewing),
        Err(generator::Error::Input { source, .. }) => {
            refused(named, format!("cannot read it: {source}"))
        }
        Err(other) => refused(named, other.to_string()),
    }
}

fn refused(file: String, why: String) -> SurveyedPage {
    SurveyedPage {
        file,
        outcome: PageOutcome::Refused(why),
    }
}

/// A page in a JSON report.
#[derive(Clone, Copy, Debug)]
struct SurveyRow<'a>(&'a SurveyedPage);

impl Serialize for SurveyRow<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut row = to.serialize_map(None)?;
        row.serialize_entry("page", &self.0.file)?;
        let status = match &self.0.outcome {
            PageOutcome::Seen(_, colours) => {
                row.serialize_entry("f0", &colours.by_degree[0])?;
                row.serialize_entry("f82", &colours.f82)?;
                row.serialize_entry("by_degree", &colours.by_degree)?;
                row.serialize_entry("extrapolated", &colours.held)?;
                "seen"
            }
            PageOutcome::Elsewhere(_, why) => {
                row.serialize_entry("reason", why)?;
                "elsewhere"
            }
            PageOutcome::Refused(why) => {
                row.serialize_entry("reason", why)?;
                "refused"
            }
        };
        row.serialize_entry("status", status)?;
        if let Some(facts) = self.0.facts() {
            let (nd, nd_difference) = facts.nd.unzip();
            row.serialize_entry("class", facts.class)?;
            row.serialize_entry("from_nm", &facts.range_nm.0)?;
            row.serialize_entry("to_nm", &facts.range_nm.1)?;
            row.serialize_entry("formula", &facts.formula)?;
            row.serialize_entry("nd", &nd)?;
            row.serialize_entry("nd_difference", &nd_difference)?;
        }
        row.end()
    }
}

/// The survey in words: counts, refusals and their reasons, and how far glasses are from their makers' indices.
fn survey_text(all: &[SurveyedPage]) -> String {
    let count =
        |wanted: fn(&PageOutcome) -> bool| all.iter().filter(|s| wanted(&s.outcome)).count();
    let seen = count(|outcome| matches!(outcome, PageOutcome::Seen(..)));
    let elsewhere = count(|outcome| matches!(outcome, PageOutcome::Elsewhere(..)));
    let mut lines = vec![format!(
        "{} pages: {seen} seen over the whole visible spectrum at {SURVEYED_ANGLES} angles, {elsewhere} known elsewhere, {} refused",
        all.len(),
        all.len() - seen - elsewhere
    )];
    lines.extend(extrapolated(all));
    lines.extend(refusals(all));
    lines.extend(glasses(all));
    let lines: Vec<String> = lines.iter().map(|line| one_line(line)).collect();
    lines.join("\n") + "\n"
}

/// How many colours use extrapolated data, held from the ends of the measured range.
fn extrapolated(all: &[SurveyedPage]) -> Option<String> {
    let is_held = |s: &&SurveyedPage| matches!(&s.outcome, PageOutcome::Seen(_, colours) if colours.held.is_some());
    let count = all.iter().filter(is_held).count();
    (count > 0).then(|| {
        format!(
            "of these {count} are extrapolated: beyond the measured range the last index is held"
        )
    })
}

/// Reasons with their number of pages; a reason with a single page names it.
fn refusals(all: &[SurveyedPage]) -> Vec<String> {
    let mut reasons: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for surveyed in all {
        if let PageOutcome::Refused(why) = &surveyed.outcome {
            let why = why
                .split_once(": ")
                .filter(|(line, _)| line.starts_with("line "))
                .map_or(why.as_str(), |(_, why)| why);
            reasons.entry(why).or_default().push(&surveyed.file);
        }
    }
    let line = |(why, pages): (&str, Vec<&str>)| match pages.as_slice() {
        [one] => format!("refused: {one}: {why}"),
        many => format!("refused: {} pages: {why}", many.len()),
    };
    reasons.into_iter().map(line).collect()
}

/// How far each formula is from the indices that glass makers publish.
fn glasses(all: &[SurveyedPage]) -> Vec<String> {
    let mut formulas: BTreeMap<u8, (usize, f64)> = BTreeMap::new();
    for about in all.iter().filter_map(SurveyedPage::facts) {
        if let Some((_, difference)) = about.nd {
            let (count, max_difference) = formulas.entry(about.formula).or_default();
            *count += 1;
            *max_difference = max_difference.max(difference.abs());
        }
    }
    let name = |formula: u8| match formula {
        0 => "tables".to_owned(),
        number => format!("formula {number}"),
    };
    let line = |(formula, (count, max_difference)): (u8, (usize, f64))| {
        format!(
            "index at the d line, {}: {count} pages within {max_difference:.1e} of what the maker prints",
            name(formula)
        )
    };
    formulas.into_iter().map(line).collect()
}
