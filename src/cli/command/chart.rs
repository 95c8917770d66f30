//! `chart`: error against cost.

use std::path::{Path, PathBuf};

use crate::cli::args::ChartFlags;
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::error::unknown;
use crate::generator::request::{Materials, Request};
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::lab::chart::{ChartData, ChartView, ERRORS, chart_data, cost_names, set_name};
use crate::generator::envelope::Report;
use crate::cli::chart_text::chart_text;
use crate::pictures::frontier::{chart_page, chart_svg};

use crate::cli::command::{Output, Progress, not_drawn, report_beside, try_files};

const PICTURE: &str = "chart.svg";
const PAGE: &str = "chart.html";

/// Draws.
pub fn run(flags: &ChartFlags, progress: Progress) -> Result<Output, Error> {
    let place = |all: &[&str], name: &str| all.iter().position(|other| *other == name);
    let place = |all: &[&str], name| place(all, name).expect("the command line has names of these");
    let error = place(&ERRORS.map(|error| error.name), flags.error.name);
    let cost = place(&cost_names(), flags.gpu);
    let folder = flags.pictures.folder();
    let files = files(folder);
    let all = flags.report.json.iter().chain(&files);
    try_files(&all.map(PathBuf::as_path).collect::<Vec<_>>())?;
    try_places_of_ours(&files, flags.pictures.overwrite)?;
    let request = Request {
        materials: chosen(flags)?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let remarks = found.left_out_lines();
    let subjects = found.materials();
    check_shown(flags, &subjects)?;
    let space = request.viewing.integration.space;
    let command = flags.command_line();
    let data = chart_data(&subjects, space, None, command.clone().into(), progress);
    let set = set(flags, &data)?;
    let view = ChartView {
        data: &data,
        set: &data.sets[set],
        cost: &data.costs[cost],
        error,
    };
    let json = Report::new(command, view.point_rows());
    let drawn = match folder {
        Some(folder) => drawn_files(folder, flags.pictures.overwrite, &view, [set, cost, error])?,
        None => Vec::new(),
    };
    let said = drawn_remarks(&drawn);
    let mut output = report_beside(chart_text(&view), &json, flags.report.json(), drawn)?;
    output.remarks.splice(0..0, remarks);
    output.remarks.extend(said);
    Ok(output)
}

/// Materials to chart: the whole catalogue unless others are asked for.
fn chosen(flags: &ChartFlags) -> Result<Materials, Error> {
    match flags.materials.materials()? {
        Materials::Default => Ok(Materials::All),
        Materials::None => Err(RequestFault::NoMaterial {
            why: "a chart is of materials; `none` leaves nothing to show",
        }
        .into()),
        named => Ok(named),
    }
}

/// The files that a chart is, where it has a folder.
pub(super) fn files(folder: Option<&Path>) -> Vec<PathBuf> {
    let each = |folder: &Path| [PICTURE, PAGE].map(|file| folder.join(file));
    folder.into_iter().flat_map(each).collect()
}

/// Picture and page, as files that are to be written.
///
/// # Errors
/// Nothing of the view is known.
pub(super) fn drawn_files(
    folder: &Path,
    overwrite: bool,
    view: &ChartView,
    first: [usize; 3],
) -> Result<Vec<OutputFile>, Error> {
    let page = chart_page(view.data, first).map_err(not_drawn)?;
    let picture = chart_svg(view).ok_or_else(|| {
        not_drawn(format!(
            "nothing is known of {} on {}: there is no picture to draw",
            view.set.title, view.cost.name
        ))
    })?;
    let files = files(Some(folder)).into_iter().zip([picture, page]);
    let file = |(path, text)| OutputFile::of_report(path, text, overwrite);
    Ok(files.map(file).collect())
}

/// Where picture and page lie, and what they are.
pub(super) fn drawn_remarks(files: &[OutputFile]) -> Vec<String> {
    let about = ["the picture of what is shown", "a page with all charts"];
    let remark = |(file, about): (&OutputFile, &str)| {
        format!("{}: {about}", crate::physics::foreign::path(file.path()))
    };
    files.iter().zip(about).map(remark).collect()
}

/// The set that is shown unless another is asked for: the first class of which there are two, else the first material.
pub(super) fn usual_set(data: &ChartData, of: &str) -> usize {
    let class = MaterialClass::ALL.into_iter().find_map(|class| {
        let name = set_name(class, of);
        data.sets.iter().position(|set| set.name == name)
    });
    class.unwrap_or(0)
}

fn set(flags: &ChartFlags, data: &ChartData) -> Result<usize, Error> {
    let names: Vec<&str> = data.sets.iter().map(|set| set.name.as_str()).collect();
    let Some(show) = &flags.show else {
        return Ok(usual_set(data, flags.of));
    };
    let mut classes = MaterialClass::ALL.into_iter();
    if let Some(class) = classes.find(|class| class.name() == show) {
        let name = set_name(class, flags.of);
        let found = names.iter().position(|other| *other == name);
        return found.ok_or_else(|| Error::usage(format!("--show {show} needs two {show} or more among the materials")));
    }
    let found = names.iter().position(|other| other == show);
    Ok(found.expect("what is shown was checked"))
}

/// Refuses, before the work, to show what is not among the materials.
fn check_shown(flags: &ChartFlags, subjects: &[MaterialInMedium]) -> Result<(), Error> {
    let Some(show) = &flags.show else {
        return Ok(());
    };
    let alone = subjects.iter().map(|subject| subject.argument.as_str());
    let all: Vec<&str> = MaterialClass::ALL
        .map(MaterialClass::name)
        .into_iter()
        .chain(alone)
        .collect();
    if all.contains(&show.as_str()) {
        return Ok(());
    }
    Err(unknown("material", show, &all).into())
}
