//! `audit`: compares a user's own function with the exact law and with our methods.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::chart;
use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, family_or_all, one_of};
use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::{CheckReportFlags, PictureFlags};
use crate::cli::flags::viewing::GamutFlags;
use crate::cli::junit::audit_junit;
use crate::cli::output::{Output, Progress, check_limit, report_beside};
use crate::cli::places::try_files;
use crate::generator::command_line::{CommandLine, path_again};
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::fit::ModelError;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::source::shader;
use crate::generator::request::{Materials, Request};
use crate::lab::audit::{
    self, Audit, AuditCost, AuditRow, AuditRows, Condition, Define, ExactFit, Given, Language,
    serve,
};
use crate::lab::chart::{ChartView, CostAxis, STATISTICS, chart_data, charted_function};
use crate::lab::cost::{self, FAMILIES, Family};
use crate::lab::verify::{Status, machine};
use crate::physics::foreign::{Foreign, lines as lines_of, one_line};
use crate::physics::materials::ViewingConditions;
use crate::physics::names::UnknownName;
use crate::physics::spectra::Space;

/// The flags of `audit`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Names, or paths of material files").required_unless_present("worker")),
    mut_arg("out_dir", |arg| arg.help("Write chart.svg and chart.html into this folder: `chart` of these materials, with this function as one more point")),
    after_help = "Examples:\n  fresnel-gen audit mine.glsl --function fresnel --material gold\n  fresnel-gen audit mine.hlsl --function schlick --arg f0=1.03,.73,.36 --material gold --json -\n  fresnel-gen audit mine.wgsl --material gold,platinum --out-dir charts\n  fresnel-gen audit mine.slang --arg ior=1/eta --material water,diamond --max-error 0.001\n\nThe function takes the cosine and whatever --arg binds; arguments that are not bound and have names of ours (eta, n, k, f0, f82, lambda, c0 ...) or of engines (ior, extinction, SpecularColor, edgeTint ...) have the material's values. A function of single numbers is called once a channel where they differ. It runs in a process of its own, within --limit. Exit codes: 0 done, 1 a compiler refuses it, it does not end, a result is no reflectance, or its error is above --max-error; 2 wrong input, 3 a compiler or a driver is missing here, or failed without a word about the text. Being dominated is no finding."
)]
pub struct AuditFlags {
    /// The file: .wgsl, .glsl (as GLSL ES 3.00, or of the desktop where it says so), .hlsl or .slang
    #[arg(required_unless_present = "worker")]
    pub file: Option<String>,
    /// The function; a file that holds one needs no name, and NAME:LINE tells two of one name apart
    #[arg(long, value_name = "NAME")]
    pub function: Option<String>,
    /// A name for the preprocessor, as compilers take it: NAME, or NAME=VALUE
    #[arg(short = 'D', long, value_name = "NAME=VALUE")]
    pub define: Vec<String>,
    /// The language, where the file's ending does not tell it: wgsl, glsl, hlsl or slang
    #[arg(long, value_name = "NAME", value_parser = one_of("language", Language::NAMED, |(name, _)| name))]
    pub language: Option<(&'static str, Language)>,
    /// The value of an argument, or of a uniform: name=number, name=number,number,number, a quantity of the material, as in ior=1/eta, or what it is of the angle: cos, 1-cos, cos^2, sin, sin^2, angle, degrees
    #[arg(long, value_name = "NAME=VALUE")]
    pub arg: Vec<String>,
    /// The largest error that is no finding [default: none is]
    #[arg(long, value_name = "ERROR")]
    pub max_error: Option<f64>,
    /// Compare it with methods alone that take at most so many numbers of a material (schlick 3, f82_tint 6, fitted 12)
    #[arg(long, value_name = "NUMBER")]
    pub max_inputs: Option<usize>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// Families of GPUs whose compilers say what it costs, see `fresnel-gen cost`; or none [default: rdna2, adreno330]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = asked_family)]
    pub gpu: Vec<Choice<&'static Family>>,
    /// Folder of compilers, searched before PATH and the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take
    #[arg(long, value_name = "SECONDS", default_value_t = 20)]
    pub limit: u64,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: CheckReportFlags,
    /// Compile and run what is handed over
    #[arg(long, hide = true)]
    pub worker: bool,
}

impl AuditFlags {
    /// The command that makes this report again under these viewing conditions, without paths.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let file = self.file.as_deref().unwrap_or_default();
        let command = CommandLine::new("audit")
            .argument(&path_again(file))
            .list("language", self.language.map(|(name, _)| name))
            .list("function", &self.function);
        let arguments = self.arg.iter();
        let defined = self.define.iter();
        let command = defined.fold(command, |command, one| command.list("define", [one]));
        arguments
            .fold(command, |command, one| command.list("arg", [one]))
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list("medium", &self.medium.medium)
            .seen_as(viewing)
            .list("gpu", &self.gpu)
            .list("max-error", self.max_error)
            .list("max-inputs", self.max_inputs)
    }
}

/// Parses a word of `--gpu`.
fn asked_family(word: &str) -> Result<Choice<&'static Family>, UnknownName> {
    match word {
        "none" => Ok(Choice::None),
        name => family_or_all()(name),
    }
}

/// The GPUs that are measured unless others are named: one desktop, one phone.
const USUAL: [&str; 2] = ["rdna2", "adreno330"];

/// Audits.
pub fn run(flags: &AuditFlags, progress: Progress) -> Result<Output, Error> {
    if flags.worker {
        let served = serve();
        // The supervisor is gone.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    check_limit(flags.limit)?;
    check_max_error(flags.max_error)?;
    let request = request(flags)?;
    let audit = audit(flags, request.viewing.integration.space)?;
    let subjects = request.subjects()?.materials();
    let charts = chart::files(flags.pictures.folder());
    let all = flags.report.files().chain(&charts);
    try_files(&all.map(PathBuf::as_path).collect::<Vec<_>>())?;
    try_places_of_ours(&charts, flags.pictures.overwrite)?;
    let AuditRows { rows, skipped } = audit.rows(&subjects, progress)?;
    let command = String::from(flags.command_line(&request.viewing));
    let device = rows.first().and_then(|row| row.device.clone());
    let full = Report::new(command.clone(), rows.clone()).with_device(device);
    let (mut files, mut charted) = match flags.pictures.folder() {
        Some(folder) => {
            let place = (folder, flags.pictures.overwrite);
            let subjects = audited(subjects, &rows);
            charted(place, &rows, &subjects, audit.space, command, progress)?
        }
        None => (Vec::new(), Vec::new()),
    };
    if let Some(file) = &flags.report.junit {
        files.push(OutputFile::named(
            file,
            audit_junit(&rows).map_err(Error::usage)?,
        ));
    }
    let texts: Vec<String> = rows.iter().map(audit_text).collect();
    let json = flags.report.report.json();
    let mut output = report_beside(texts.join("\n"), &full, json, files)?;
    charted.splice(0..0, output.remarks);
    let skipped = skipped
        .iter()
        .map(|why| format!("not audited: {}", lines_of(&why.to_string())));
    let remarks = rows.iter().flat_map(audit_remarks);
    output.remarks = remarks.chain(skipped).chain(charted).collect();
    output.code = code(&rows);
    Ok(output)
}

/// The materials that have a row.
fn audited(subjects: Vec<MaterialInMedium>, rows: &[AuditRow]) -> Vec<MaterialInMedium> {
    let has_row = |one: &MaterialInMedium| rows.iter().any(|row| row.material == one.label());
    subjects.into_iter().filter(has_row).collect()
}

/// Draws the charts of these materials with the function as one more point. Returns where they are, and what is missing. The
/// place is a folder, and whether foreign files are replaced there.
fn charted(
    (folder, overwrite): (&Path, bool),
    rows: &[AuditRow],
    subjects: &[MaterialInMedium],
    space: Space,
    command: String,
    progress: Progress,
) -> Result<(Vec<OutputFile>, Vec<String>), Error> {
    let Some(own) = charted_function(rows) else {
        return Ok((Vec::new(), Vec::new()));
    };
    let data = chart_data(subjects, space, Some(&own), command, progress);
    let is_known = |cost: &CostAxis| own.costs.contains_key(cost.name);
    let cost = data.costs.iter().position(is_known);
    let cost = cost.or_else(|| data.costs.iter().position(|cost| cost.name == USUAL[0]));
    let (set, cost) = (chart::usual_set(&data, STATISTICS[0]), cost.unwrap_or(0));
    let view = ChartView {
        data: &data,
        set: &data.sets[set],
        cost: &data.costs[cost],
        error: 0,
    };
    let files = chart::drawn_files(folder, overwrite, &view, [set, cost, 0])?;
    let mut remarks = chart::drawn_remarks(&files);
    remarks.extend(view.lacks());
    Ok((files, remarks))
}

fn request(flags: &AuditFlags) -> Result<Request, Error> {
    let materials = flags.materials.materials()?;
    if materials == Materials::None {
        return Err(Error::usage(
            "--material is none; an audit holds a function against a material",
        ));
    }
    Ok(Request {
        materials,
        medium: flags.medium.source()?,
        viewing: flags.viewing.conditions()?,
        ..Request::default()
    })
}

fn audit(flags: &AuditFlags, space: Space) -> Result<Audit, Error> {
    let file = flags.file.clone().unwrap_or_default();
    let language = match flags.language {
        Some((_, language)) => language,
        None => Language::of_file(&file).ok_or_else(|| audit::Error::NoLanguage(file.clone()))?,
    };
    let given = flags.arg.iter().map(|word| Given::read(word));
    let given = given.collect::<Result<Vec<Given>, _>>()?;
    for (place, one) in given.iter().enumerate() {
        if given[..place].iter().any(|other| other.name == one.name) {
            let why = format!("--arg gives `{}` two values; leave one", one.name);
            return Err(Error::usage(why));
        }
    }
    let defines = flags.define.iter().map(|word| Define::read(word));
    Ok(Audit {
        defines: defines.collect::<Result<_, _>>()?,
        given,
        space,
        families: families(&flags.gpu)?,
        text: shader(&file)?,
        function: flags.function.clone(),
        max_error: flags.max_error,
        max_inputs: flags.max_inputs,
        tools: flags.tools.clone(),
        seconds: flags.limit,
        workers: machine::cores(),
        file,
        language,
    })
}

/// Refuses an error limit without meaning.
fn check_max_error(most: Option<f64>) -> Result<(), Error> {
    match most {
        Some(most) if !(0.0..=1.0).contains(&most) => Err(RequestFault::OutOfRange {
            flag: "max-error",
            value: most.to_string(),
            allowed: "is 0 to 1, a difference of reflectance".to_owned(),
        }
        .into()),
        _ => Ok(()),
    }
}

fn families(asked: &[Choice<&'static Family>]) -> Result<Vec<&'static Family>, Error> {
    if asked.is_empty() {
        return Ok(USUAL.into_iter().filter_map(cost::find).collect());
    }
    if Choice::is_none(asked, "families")? {
        return Ok(Vec::new());
    }
    if Choice::is_all(asked) {
        return Ok(FAMILIES.iter().collect());
    }
    let named = asked.iter().filter_map(Choice::named);
    Ok(named.copied().collect())
}

/// The exit code: 1 for findings; 3 where nothing could be run.
fn code(rows: &[AuditRow]) -> u8 {
    let any = |status| rows.iter().any(|row| row.status == status);
    match (any(Status::Fail), any(Status::NotChecked)) {
        (true, _) => 1,
        (_, true) => 3,
        _ => 0,
    }
}

/// The text of a row.
pub fn audit_text(row: &AuditRow) -> String {
    let [function, file, material] = [&row.function, &row.file, &row.material].map(Foreign);
    let mut text = format!("{function} in {file} (line {}), {material}\n", row.line);
    for (head, line) in lines(row) {
        text += &format!("  {head:<12} {}\n", lines_of(&line));
    }
    text
}

fn lines(row: &AuditRow) -> Vec<(&'static str, String)> {
    let taken = row.cosine_words.as_ref();
    let taken = taken.map_or(String::new(), |words| format!(", taken as {words}"));
    let mut lines = vec![("cosine", format!("`{}`{taken}", row.cosine))];
    if let Some(words) = &row.language_remark {
        lines.push(("run as", words.clone()));
    }
    if !row.conditions.is_empty() {
        lines.push(("conditions", conditions(&row.conditions)));
    }
    if !row.initialised.is_empty() {
        let values = row.initialised.join("; ");
        lines.push(("initialised", format!("{values}, as the file has it")));
    }
    if row.precision == "f16" {
        let words = "16 bits where its types say so";
        lines.push(("precision", words.to_owned()));
    }
    if !row.filled.is_empty() {
        let filled = row.filled.join("; ");
        lines.push(("filled in", format!("{filled}, as the material has it")));
    }
    let accepts = row.accepts.iter();
    let accepts: Vec<String> = accepts
        .map(|(name, answer)| format!("{name}: {}", answer.words()))
        .collect();
    lines.push(("accepted", accepts.join("; ")));
    if let (Some(device), Some(points)) = (&row.device, row.points) {
        lines.push(("run on", format!("{device}, at {points} cosines")));
        lines.push(("edges", edges(row)));
        lines.extend(
            row.model_error
                .iter()
                .map(|error| ("model error", model_error(error))),
        );
        lines.extend(computes(row).map(|words| ("computes", words)));
    }
    lines.push(("inputs", inputs(row)));
    let costs = row.cost.iter();
    lines.extend(costs.map(|cost| ("cost", cost_line(row, cost))));
    lines.push(("checked", row.checked.words(row.status)));
    lines
}

/// How the conditional compilation around a function and in it was decided.
fn conditions(all: &[Condition]) -> String {
    let words = |one: &Condition| {
        let taken = if one.is_taken { "taken" } else { "not taken" };
        format!("line {} `{}`: {taken}", one.line, one.text)
    };
    let all: Vec<String> = all.iter().map(words).collect();
    all.join("; ")
}

/// What the function computes, where it is one of our methods or would be with another argument.
fn computes(row: &AuditRow) -> Option<String> {
    if let Some(method) = row.computes {
        return Some(format!("{method}, as it is bound"));
    }
    let fit = row.fits_exactly_with.as_ref()?;
    let ExactFit {
        argument,
        quantity,
        method,
        max_abs,
    } = fit;
    Some(format!(
        "fits exactly with {quantity} for `{argument}`: it is {method} then, with an error of {max_abs:.6} at most; bind it with --arg {argument}={quantity}"
    ))
}

/// The numbers that it takes, and the number that it returns.
fn inputs(row: &AuditRow) -> String {
    let numbers = match row.input_numbers {
        0 => "no numbers".to_owned(),
        1 => "1 number".to_owned(),
        count => format!("{count} numbers"),
    };
    let channels = match row.channels {
        1 => "; one channel, and costs are those of one",
        _ => "",
    };
    format!("{numbers} of a material{channels}")
}

fn edges(row: &AuditRow) -> String {
    let counted = || row.edges.iter().flatten().filter(|edge| edge.counts);
    let wrong = counted().filter(|edge| edge.fault.is_some()).count();
    let beyond = match row.beyond.as_deref() {
        None | Some([]) => String::new(),
        Some(beyond) => format!("; beyond them, {}", beyond.join(", ")),
    };
    match wrong {
        0 => format!("a reflectance at all of them{beyond}"),
        _ => format!(
            "{wrong} of {} results are no reflectance{beyond}",
            counted().count()
        ),
    }
}

fn model_error(error: &ModelError) -> String {
    let mean = error.mean_rel.map_or("no mean".to_owned(), |mean| {
        format!("{:.3} % in the mean", 100.0 * mean)
    });
    // A figure that is not finite counts as missing, here as in the JSON.
    let number = |figure: f64| if figure.is_finite() { figure } else { f64::NAN };
    format!(
        "{:.6} at most, at {:.1} degrees; {:.6} in the mean; relative {mean}",
        number(error.max_abs),
        libm::acos(error.worst_cos).to_degrees(),
        number(error.mean_abs),
    )
}

fn cost_line(row: &AuditRow, cost: &AuditCost) -> String {
    let gpu = cost.gpu;
    match (cost.net, &cost.reason) {
        (Some(net), _) => {
            let sentence = row.sentence_on(gpu).unwrap_or("ours are not known there");
            format!("{gpu}: {net} ({}): {sentence}", cost.measure)
        }
        (None, why) => {
            let record = match (row.computes, cost.recorded) {
                (Some(method), Some(recorded)) => {
                    format!(
                        "; our library function of {method}, which it computes, costs {recorded} ({}) by the record; yours may be written otherwise",
                        cost.measure
                    )
                }
                _ => String::new(),
            };
            format!(
                "{gpu}: not checked: {}{record}",
                why.as_deref().unwrap_or_default()
            )
        }
    }
}

/// The findings, for stderr.
pub fn audit_remarks(row: &AuditRow) -> Vec<String> {
    let head = match row.status {
        Status::Fail => "FAIL ",
        Status::NotChecked => "not checked: ",
        Status::Pass => "",
    };
    let reasons = row.reason.as_deref().unwrap_or_default().lines();
    reasons
        .map(|reason| format!("{head}{}", one_line(reason)))
        .collect()
}
