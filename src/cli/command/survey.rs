//! `materials survey`: every page of refractiveindex.info below a folder.

use std::path::Path;

use crate::cli::args::SurveyFlags;
use crate::cli::error::Error;
use crate::generator;
use crate::generator::request::source::{pages, read};
use crate::generator::command_line::CommandLine;
use crate::generator::fit::{PageOutcome, SurveyedPage, survey_page};
use crate::physics::materials::ViewingConditions;
use crate::physics::spectra::Gamut;
use crate::generator::envelope::Report;
use crate::cli::survey_text::{SurveyRow, survey_text};

use crate::cli::command::{Output, Progress, report};

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
    let rows: Vec<SurveyRow> = all.iter().map(SurveyRow::new).collect();
    let full = Report::new(CommandLine::new("materials survey").seen_as(&viewing), rows);
    report(survey_text(&all), &full, json)
}

/// A page by its name below the folder, so that no report depends on where that lies. One that cannot be read is refused as
/// one that cannot be understood is.
fn surveyed(folder: &Path, file: &str, viewing: &ViewingConditions) -> SurveyedPage {
    let (path, named) = if file.is_empty() {
        (folder.to_owned(), folder.display().to_string())
    } else {
        (folder.join(file), file.to_owned())
    };
    match read(&path.display().to_string()) {
        Ok(text) => survey_page(&named, &text, viewing),
        Err(generator::Error::Input { source, .. }) => refused(named, format!("cannot read it: {source}")),
        Err(other) => refused(named, other.to_string()),
    }
}

fn refused(file: String, why: String) -> SurveyedPage {
    SurveyedPage {
        file,
        outcome: PageOutcome::Refused(why),
    }
}
