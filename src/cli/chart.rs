//! `chart`: draws error against cost.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::one_of;
use crate::cli::flags::material::MaterialFlags;
use crate::cli::flags::output::{PictureFlags, ReportFlags};
use crate::cli::output::{Output, Progress, report_beside};
use crate::cli::places::try_files;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::generator::error::unknown;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::{MaterialClass, MaterialInMedium};
use crate::generator::request::Request;
use crate::lab::chart::{
    ChartData, ChartPoint, ChartView, ERRORS, ErrorAxis, STATISTICS, chart_data, cost_names,
    set_name, without_point,
};
use crate::physics::names::UnknownName;
use crate::pictures::frontier::{chart_page, chart_svg};
use crate::pictures::plot::capital;
use crate::pictures::table::{self, short_number};

/// The flags of charts.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Materials on the page: names, paths of material files, all [default: all]")),
    mut_arg("out_dir", |arg| arg.help("Write chart.svg and chart.html into this folder")),
    after_help = "Examples:\n  fresnel-gen chart --out-dir charts\n  fresnel-gen chart --material gold --gpu adreno330 --error de2000\n  fresnel-gen chart --show dielectrics --of worst --gpu time --json -\n\nCosts are those of library functions, one evaluation, as recorded; `fresnel-gen cost` tells and checks them. Each method with inputs to choose stands twice: with those that it is meant to have, and with those whose largest error is least. Into the folder go chart.svg, the picture of what is shown, and chart.html, a page with all of them to choose from."
)]
pub struct ChartFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What is shown: metals, semiconductors, dielectrics, or a material [default: the first of these that there is]
    #[arg(long, value_name = "NAME")]
    pub show: Option<String>,
    /// How a class is taken together: median, p90, worst, substances (the median, each substance one vote)
    #[arg(long, value_name = "NAME", default_value = "median", value_parser = one_of("way of taking a class together", STATISTICS, |name| name))]
    pub of: &'static str,
    /// Whose cost: operations, gcn4, rdna1, rdna2, rdna3, adreno330, malig72 ... or time, on the device of the record
    #[arg(long, value_name = "NAME", default_value = "rdna2", value_parser = cost)]
    pub gpu: &'static str,
    /// Which error: max, mean-rel (as the thesis measures), luminance, de2000
    #[arg(long, value_name = "NAME", default_value = "max", value_parser = one_of("error", ERRORS, |error| error.name))]
    pub error: ErrorAxis,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl ChartFlags {
    /// The command that makes this report again, without paths.
    pub fn command_line(&self) -> CommandLine {
        let unless = |usual: &'static str, name: &'static str| (name != usual).then_some(name);
        CommandLine::new("chart")
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list("show", &self.show)
            .list("of", unless("median", self.of))
            .list("gpu", unless("rdna2", self.gpu))
            .list("error", unless("max", self.error.name))
    }
}

/// Parses the name of a cost that charts know. The cost records are read only if they are needed.
fn cost(word: &str) -> Result<&'static str, UnknownName> {
    one_of("cost", cost_names(), |name| name)(word)
}

const PICTURE: &str = "chart.svg";
const PAGE: &str = "chart.html";
const NO_MATERIALS: &str = "a chart is of materials; `none` leaves nothing to show";

/// Draws.
pub fn run(flags: &ChartFlags, progress: Progress) -> Result<Output, Error> {
    let place = |all: &[&str], name: &str| {
        let found = all.iter().position(|other| *other == name);
        found.expect("the command line has names of these")
    };
    let error = place(&ERRORS.map(|error| error.name), flags.error.name);
    let cost = place(&cost_names(), flags.gpu);
    let folder = flags.pictures.folder();
    let files = files(folder);
    let all = flags.report.json.iter().chain(&files);
    try_files(&all.map(PathBuf::as_path).collect::<Vec<_>>())?;
    try_places_of_ours(&files, flags.pictures.overwrite)?;
    let request = Request {
        materials: flags.materials.materials_or_all(NO_MATERIALS)?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let remarks = found.left_out_lines();
    let materials = found.materials();
    check_shown(flags, &materials)?;
    let space = request.viewing.integration.space;
    let command = flags.command_line();
    let data = chart_data(&materials, space, None, command.clone().into(), progress);
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

/// The paths of a chart's files, if it has a folder.
pub(super) fn files(folder: Option<&Path>) -> Vec<PathBuf> {
    let each = |folder: &Path| [PICTURE, PAGE].map(|file| folder.join(file));
    folder.into_iter().flat_map(each).collect()
}

/// Picture and page as files to be written.
///
/// # Errors
/// The view has no known points.
pub(super) fn drawn_files(
    folder: &Path,
    overwrite: bool,
    view: &ChartView,
    first: [usize; 3],
) -> Result<Vec<OutputFile>, Error> {
    let page = chart_page(view.data, first).map_err(Error::usage)?;
    let picture = chart_svg(view).ok_or_else(|| {
        Error::usage(format!(
            "nothing is known of {} on {}: there is no picture to draw",
            view.set.title, view.cost.name
        ))
    })?;
    let files = files(Some(folder)).into_iter().zip([picture, page]);
    let file = |(path, text)| OutputFile::of_report(path, text, overwrite);
    Ok(files.map(file).collect())
}

/// Remarks on where picture and page lie, and what they are.
pub(super) fn drawn_remarks(files: &[OutputFile]) -> Vec<String> {
    let about = ["the picture of what is shown", "a page with all charts"];
    let remark = |(file, about): (&OutputFile, &str)| {
        format!("{}: {about}", crate::physics::foreign::path(file.path()))
    };
    files.iter().zip(about).map(remark).collect()
}

/// The default set: the first class with two materials, otherwise the first material.
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
        return found.ok_or_else(|| {
            Error::usage(format!(
                "--show {show} needs two {show} or more among the materials"
            ))
        });
    }
    let found = names.iter().position(|other| other == show);
    Ok(found.expect("what is shown was checked"))
}

/// Refuses, before the work, a set that is not among the materials.
fn check_shown(flags: &ChartFlags, materials: &[MaterialInMedium]) -> Result<(), Error> {
    let Some(show) = &flags.show else {
        return Ok(());
    };
    let alone = materials.iter().map(MaterialInMedium::label);
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

/// The points by cost with the frontier marked, and the headline.
fn chart_text(view: &ChartView) -> String {
    let head = [
        "",
        "method",
        "inputs",
        "cost",
        ERRORS[view.error].name,
        "fetches",
    ];
    let points = view.points();
    let rows: Vec<Vec<String>> = points.iter().map(cells).collect();
    format!(
        "{}\nCost: {}.\n\n{}\nA star marks the frontier: what errs less costs more, and what costs less errs more.\n\
         Left out:\n{}{}\n{}",
        capital(&view.title()),
        view.cost.title,
        table::text_table(&head, &rows),
        absent(view),
        failing(&points),
        gains_of_ours(view)
    )
}

/// The methods that have no point, or one without some materials: a line for each reason.
fn absent(view: &ChartView) -> String {
    let lines = without_point(view).into_iter();
    lines.map(|line| format!("  {line}\n")).collect()
}

/// A remark on each method that fails: the frontier leaves it out.
fn failing(points: &[ChartPoint]) -> String {
    let own = points.iter().filter(|point| !point.entry.is_best);
    let remark = |point: &ChartPoint| {
        let why = point.entry.fails()?;
        Some(format!(
            "{} fails, and takes no part in that: {why}.\n",
            point.entry.name()
        ))
    };
    own.filter_map(remark).collect()
}

fn cells(point: &ChartPoint) -> Vec<String> {
    let star = if point.is_on_frontier { "*" } else { "" };
    vec![
        star.to_owned(),
        point.entry.name().to_owned(),
        point.entry.inputs().to_owned(),
        short_number(point.cost),
        short_number(point.error),
        point.entry.fetches.to_string(),
    ]
}

/// What a method of ours gains on a competitor with its intended inputs and with its best ones, and at which share of its cost.
/// Each is compared with the most accurate competitor that is at most a tenth cheaper and at most twice as expensive.
fn gains_of_ours(view: &ChartView) -> String {
    let points = view.points();
    let ours = points
        .iter()
        .filter(|point| point.entry.is_ours() && !point.entry.is_best);
    ours.filter_map(|our| sentence(our, &points)).collect()
}

fn sentence(our: &ChartPoint, points: &[ChartPoint]) -> Option<String> {
    let is_competitor = |point: &&ChartPoint| {
        let is_published = point.entry.method().is_some_and(|method| !method.is_ours());
        let is_cheap = our.cost <= 1.1 * point.cost && point.cost <= 2.0 * our.cost;
        is_published && point.entry.fetches == 0 && is_cheap && our.error < point.error
    };
    let competitors: Vec<&ChartPoint> = points.iter().filter(is_competitor).collect();
    let intended = competitors.iter().filter(|point| !point.entry.is_best);
    let nearest = intended.min_by(|a, b| a.error.total_cmp(&b.error))?;
    let is_same =
        |point: &&&ChartPoint| point.entry.is_best && point.entry.name() == nearest.entry.name();
    let best = competitors.iter().find(is_same);
    let best = best.map_or(String::new(), |best| {
        format!(", {} with its best", times(best.error / our.error))
    });
    Some(format!(
        "{} errs {} less than {} with its intended inputs{best}, at {} of its cost.\n",
        our.entry.name(),
        times(nearest.error / our.error),
        nearest.entry.name(),
        short_number(our.cost / nearest.cost),
    ))
}

fn times(ratio: f64) -> String {
    format!("{} times", short_number(ratio))
}
