//! `cost`: what functions cost by the compilers of real GPUs.

use core::time::Duration;
use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::{
    Choice, each_once, effect_or_all, family, family_or_all, method_or_all, precision,
};
use crate::cli::flags::material::MaterialFlags;
use crate::cli::flags::output::{PictureFlags, ReportFlags};
use crate::cli::output::{Output, Progress, check_limit, report_beside};
use crate::cli::places::try_places;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::request::Request;
use crate::lab::cost::{
    CostRecord, CostRow, CostSource, CostedFunction, FAMILIES, Family, ask_compilers, cost_rows,
    functions, functions_of_effect, records, serve,
};
use crate::lab::process::{Pool, Surroundings};
use crate::lab::verify::machine;
use crate::language::effects::{self, Effect, USUAL_METHOD};
use crate::language::methods::{self, Method};
use crate::physics::foreign;
use crate::physics::num::Precision;
use crate::pictures::cost_page::{cost_page, percent, short};
use crate::pictures::table;

/// The flags of `cost`.
#[derive(Args, Debug)]
#[command(
    mut_arg("out_dir", |arg| arg.help("Write a page with all figures as cost.html into this folder")),
    after_help = "Examples:\n  fresnel-gen cost --gpu rdna2\n  fresnel-gen cost --gpu rdna2,adreno330 --method schlick,conductor_exact --material gold\n  fresnel-gen cost --gpu rdna2 --effect interior --method schlick_ior\n  fresnel-gen cost --check\n\nA figure is that of one evaluation: a quarter of what eight of them in a chain cost more than four, less the chain's own price. Shares are of dielectric_exact with its argument from a uniform. What this program has recorded of a shader is its answer; compilers are asked only about shaders without a record, and with --check about all. Exit codes: 0 done, 1 --check found a difference, 2 wrong input, 3 with --require-all: something could not be measured, with --check: nothing could."
)]
pub struct CostFlags {
    /// Family of GPUs: operations (before any compiler), gcn4, rdna1, rdna2, rdna3, adreno330, malig72 ... [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = family_or_all())]
    pub gpu: Vec<Choice<&'static Family>>,
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Effect, see `fresnel-gen effects`, or all: its functions and nothing else, with R by --method [default: all where no method is named]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = effect_or_all(), conflicts_with = "material")]
    pub effect: Vec<Choice<&'static Effect>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What functions compute in: f32, f16 [default: each]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = precision())]
    pub precision: Vec<Precision>,
    /// Ask compilers about every function, and compare what they say with what was recorded; exit 1 where it differs
    #[arg(long)]
    pub check: bool,
    /// Folder whose folder `mesa` holds compilers, searched before the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that a compiler may take for one shader
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub limit: u64,
    /// Exit with 3 where anything could not be measured or checked
    #[arg(long)]
    pub require_all: bool,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
    /// Answer shaders with what this family's compiler says
    #[arg(long, hide = true, value_name = "NAME", value_parser = family())]
    pub worker: Option<&'static Family>,
}

impl CostFlags {
    /// The command that makes this report again, without paths.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("cost")
            .list("gpu", &self.gpu)
            .list("method", &self.method)
            .list("effect", &self.effect)
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list(
                "precision",
                self.precision.iter().map(|precision| precision.name()),
            )
            .switch("check", self.check)
    }
}

/// The page's name in its folder.
const PAGE: &str = "cost.html";

/// Measures.
pub fn run(flags: &CostFlags, progress: Progress) -> Result<Output, Error> {
    if let Some(family) = flags.worker {
        let served = serve(family);
        // The supervisor is gone.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    check_limit(flags.limit)?;
    let families = Choice::chosen(&flags.gpu, FAMILIES, |family| family.name);
    let (functions, left_out) = requested(flags)?;
    let page = flags.pictures.folder().map(|folder| folder.join(PAGE));
    try_places(flags.report.json(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.pictures.overwrite)?;
    let pool = Pool {
        limit: Duration::from_secs(flags.limit),
        workers: machine::cores(),
    };
    let surroundings = Surroundings::new(flags.tools.as_deref())?;
    let records = families
        .iter()
        .map(|family| (family.name, records(family.name)));
    let records: BTreeMap<&str, CostRecord> = records.collect();
    let is_asked = |family: &Family, function: &CostedFunction| {
        flags.check || !records[family.name].answers(family, function)
    };
    let answers = ask_compilers(
        &families,
        &functions,
        &is_asked,
        pool,
        &surroundings,
        progress,
    )?;
    let table = families.iter().zip(&answers).map(|(family, answers)| {
        cost_rows(family, answers.as_ref(), &records[family.name], &functions)
    });
    let table: Vec<Vec<CostRow>> = table.collect();
    let json = Report::new(
        flags.command_line(),
        table.iter().flatten().collect::<Vec<&CostRow>>(),
    );
    let (text, checked) = if flags.check {
        let mut checked = RecordCheck::new(&table, &records);
        (std::mem::take(&mut checked.text), checked)
    } else {
        (cost_text(&table), RecordCheck::NONE)
    };
    let page = page.map(|page| paged(flags, &table, page)).transpose()?;
    let said = page
        .as_ref()
        .map(|page| format!("{}: a page with all figures", foreign::path(page.path())));
    let files = page.into_iter().collect();
    let mut output = report_beside(text, &json, flags.report.json(), files)?;
    output.remarks.splice(0..0, left_out);
    output.remarks.extend(said);
    output.code = ending(flags, &table, &checked);
    Ok(output)
}

/// The exit code: 1 where a check found something; 3 where something that can be measured was not, and all was required.
fn ending(flags: &CostFlags, table: &[Vec<CostRow>], checked: &RecordCheck) -> u8 {
    let is_lacking = |row: &CostRow| {
        let cannot = row.id.precision.is_half() && !row.family.half;
        row.family.compiler.dialect().is_some() && !cannot && row.figures.is_err()
    };
    let is_lacking = !checked.is_whole || table.iter().flatten().any(is_lacking);
    match checked.differ {
        0 if flags.require_all && is_lacking => 3,
        // A check that compared nothing has not checked anything.
        0 if flags.check && checked.agree == 0 && !checked.is_whole => 3,
        0 => 0,
        _ => 1,
    }
}

/// The requested functions, and the reasons why some are left out.
fn requested(flags: &CostFlags) -> Result<(Vec<CostedFunction>, Vec<String>), Error> {
    let request = Request {
        materials: flags.materials.materials()?,
        ..Request::default()
    };
    let precisions = each_once(&flags.precision);
    let is_of_effects = !flags.effect.is_empty();
    let methods = if is_of_effects {
        Vec::new()
    } else {
        Choice::methods(&flags.method)
    };
    let subjects = request.subjects()?;
    let left_out = subjects.left_out_lines();
    let mut functions = functions(&methods, &subjects.materials(), &precisions)?;
    let names_no_method = flags.method.is_empty();
    if precisions.contains(&Precision::F32) && (is_of_effects || names_no_method) {
        functions.extend(of_effects(flags)?);
    }
    if !functions.iter().any(|function| function.is_asked) {
        return Err(RequestFault::NothingToDo {
            work: "measure",
            why: "no such method for these materials in this precision",
        }
        .into());
    }
    Ok((functions, left_out))
}

/// The functions of the effects, by each named method.
fn of_effects(flags: &CostFlags) -> Result<Vec<CostedFunction>, Error> {
    let usual = methods::find(USUAL_METHOD).expect("the usual method is registered");
    let named = if flags.method.is_empty() {
        vec![usual]
    } else {
        Choice::methods(&flags.method)
    };
    let (textured, methods): (Vec<_>, Vec<_>) =
        named.into_iter().partition(|method| method.is_textured());
    if let ([textured, ..], []) = (textured.as_slice(), methods.as_slice()) {
        return Err(RequestFault::textured_reflectance(textured).into());
    }
    let effects = Choice::chosen(&flags.effect, effects::ALL.iter().copied(), |effect| {
        effect.name
    });
    let mut functions = Vec::new();
    for effect in effects {
        for method in &methods {
            functions.extend(functions_of_effect(effect, method)?);
        }
    }
    if functions.is_empty() {
        let why = "no function of these effects asks for R; leave --method out";
        return Err(Error::usage(why));
    }
    Ok(functions)
}

/// The comparison of fresh counts with the record, over all families.
struct RecordCheck {
    /// How many counts agree with the record, and how many differ.
    agree: usize,
    differ: usize,
    /// Whether every family with a compiler was measured.
    is_whole: bool,
    /// What differs, by how much, and a line for each family.
    text: String,
}

impl RecordCheck {
    /// The result where nothing was to be compared.
    const NONE: RecordCheck = RecordCheck {
        agree: 0,
        differ: 0,
        is_whole: true,
        text: String::new(),
    };

    fn new(table: &[Vec<CostRow>], records: &BTreeMap<&str, CostRecord>) -> RecordCheck {
        let mut all = RecordCheck::NONE;
        for rows in table {
            if let Some(first) = rows.first() {
                all.add_family(first.family, rows, &records[first.family.name]);
            }
        }
        all
    }

    fn add_family(&mut self, family: &Family, rows: &[CostRow], record: &CostRecord) {
        let name = family.name;
        if let Some(why) = not_comparable(rows, record) {
            self.is_whole &= family.compiler.dialect().is_none();
            self.text += &format!("{name}: not checked: {why}\n");
            return;
        }
        let (mut agree, mut differ, mut unknown) = (0, 0, 0);
        for row in rows {
            match difference(row, record) {
                None => unknown += 1,
                Some(Ok(())) => agree += 1,
                Some(Err(why)) => {
                    differ += 1;
                    self.text += &format!("{name}: {}: {why}\n", row.id);
                }
            }
        }
        self.text += &format!("{name}: {agree} agree, {differ} differ, {unknown} not recorded\n");
        self.agree += agree;
        self.differ += differ;
    }
}

/// Why fresh counts of a family cannot be compared with its record, if they cannot.
fn not_comparable(rows: &[CostRow], record: &CostRecord) -> Option<String> {
    if record.compiler.is_empty() {
        let why = "this program holds no record of it: run `tests/costs`, then build it again";
        return Some(why.to_owned());
    }
    let mut fresh = rows
        .iter()
        .filter(|row| row.source == Some(CostSource::Compiler));
    match fresh.next().and_then(|row| row.compiler.as_deref()) {
        None => Some(unasked(rows)),
        Some(compiler) if compiler != record.compiler => {
            let recorded = &record.compiler;
            Some(format!("here is {compiler}, and recorded {recorded}"))
        }
        Some(_) => None,
    }
}

/// How a count differs from the record, if it does. None where the function is not recorded.
fn difference(row: &CostRow, record: &CostRecord) -> Option<Result<(), String>> {
    let hash = record.functions.get(&row.id.to_string())?;
    if row.shader.as_ref() != Some(hash) {
        return Some(Err("the shader is another one".to_owned()));
    }
    let (now, then) = (row.figures.as_ref().ok(), record.figures.get(hash));
    if now == then {
        return Some(Ok(()));
    }
    let [now, then] = [now, then].map(|figures| match figures {
        Some(figures) => figures.text(),
        None => "nothing".to_owned(),
    });
    Some(Err(format!("recorded is {then}, and now it is {now}")))
}

/// Why a family has no fresh counts.
fn unasked(rows: &[CostRow]) -> String {
    let why = rows.iter().find_map(|row| row.figures.as_ref().err());
    why.cloned()
        .unwrap_or_else(|| "its compiler is not here".to_owned())
}

/// The page as a file to be written.
fn paged(flags: &CostFlags, table: &[Vec<CostRow>], file: PathBuf) -> Result<OutputFile, Error> {
    let page = cost_page(table, &String::from(flags.command_line())).map_err(Error::usage)?;
    Ok(OutputFile::of_report(file, page, flags.pictures.overwrite))
}

/// The rows of each family. All families have the same functions in the same order.
fn cost_text(families: &[Vec<CostRow>]) -> String {
    match families {
        [one] => format!(
            "{}\nThe shader's figures are of a chain of evaluations, four or, in GLSL ES 1.00, one.\n{}\n",
            table::text_table(&ALONE, &alone(one)),
            about(one)
        ),
        several => {
            let body = beside(several);
            let sources: String = several.iter().map(|rows| about(rows) + "\n").collect();
            format!(
                "{body}\nEach cell: the cost in the unit of its column, as README, `audit` and charts print it, and in brackets per cent of dielectric_exact, its argument from a uniform; a + is a texture fetch.\n{sources}"
            )
        }
    }
}

const ALONE: [&str; 8] = [
    "function",
    "an evaluation",
    "share, %",
    "fetches",
    "shader's instructions",
    "latency",
    "inverse throughput",
    "registers",
];

fn alone(rows: &[CostRow]) -> Vec<Vec<String>> {
    let cells = |row: &CostRow| match &row.figures {
        Ok(figures) => vec![
            row.id.label(),
            short(Some(figures.cost())),
            percent(row),
            row.fetches.to_string(),
            short(Some(figures.shader.instructions)),
            short(figures.shader.latency),
            short(figures.shader.inverse_throughput),
            short(figures.registers),
        ],
        Err(why) => vec![row.id.label(), why.clone()],
    };
    rows.iter().map(cells).collect()
}

fn beside(families: &[Vec<CostRow>]) -> String {
    let names = families.iter().filter_map(|rows| rows.first());
    let head: Vec<&str> = ["function"]
        .into_iter()
        .chain(names.map(|row| row.family.name))
        .collect();
    let count = families.first().map_or(0, Vec::len);
    let line = |place: usize| -> Vec<String> {
        let label = families[0][place].id.label();
        let cells = families.iter().map(|rows| cost_and_share(&rows[place]));
        [label].into_iter().chain(cells).collect()
    };
    let lines: Vec<Vec<String>> = (0..count).map(line).collect();
    table::text_table(&head, &lines)
}

fn cost_and_share(row: &CostRow) -> String {
    match &row.figures {
        Ok(figures) => format!("{} ({})", short(Some(figures.cost())), percent(row)),
        Err(_) => percent(row),
    }
}

/// The family's description, and the compilers of its figures: the recorded one, and the one that was asked.
fn about(rows: &[CostRow]) -> String {
    let Some(first) = rows.first() else {
        return String::new();
    };
    let family = first.family;
    let unknown = rows.iter().filter(|row| row.figures.is_err()).count();
    let compiler = |source| {
        let mut of_source = rows.iter().filter(|row| row.source == Some(source));
        of_source
            .find(|row| row.figures.is_ok())?
            .compiler
            .as_deref()
    };
    let mut about = format!(
        "{}: {}, {}",
        family.name, family.gpu, family.columns.measure
    );
    if let Some(compiler) = compiler(CostSource::Record) {
        about += &format!("; recorded with {compiler}");
    }
    if let Some(compiler) = compiler(CostSource::Compiler) {
        about += &format!("; {compiler}");
    }
    if let Some(Err(why)) = rows.iter().map(|row| &row.figures).find(|one| one.is_err()) {
        let why = why.strip_prefix("not measured: ").unwrap_or(why);
        about += &format!("; {unknown} of {} not measured: {why}", rows.len());
    }
    about
}
