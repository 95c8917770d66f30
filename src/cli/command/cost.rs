//! `cost`: what compilers of real GPUs make of functions.

use core::time::Duration;
use std::path::PathBuf;

use crate::cli::args::{Choice, CostFlags, each_once};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::Request;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::lab::cost::{CostFigures, CostRecord, CostRow, CostSource, CostedFunction, FAMILIES, ask_compilers, cost_rows, functions, functions_of_effect, records, serve};
use crate::lab::process::{Pool, Surroundings};
use crate::lab::verify::machine;
use crate::language::effects::{self, USUAL_METHOD};
use crate::language::methods;
use crate::physics::num::Precision;
use crate::generator::envelope::Report;
use crate::pictures::cost_page::cost_page;
use crate::cli::cost_text::cost_text;

use crate::cli::command::{Output, Progress, check_limit, not_drawn, report_beside, try_places};

/// The page in the folder asked for.
const PAGE: &str = "cost.html";

/// Measures.
pub fn run(flags: &CostFlags, progress: Progress) -> Result<Output, Error> {
    if let Some(family) = flags.worker {
        let served = serve(family);
        // The supervisor has gone: nobody is there to be told.
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
    let answers = ask_compilers(&families, &functions, pool, &surroundings, progress)?;
    let table: Vec<Vec<CostRow>> = families
        .iter()
        .zip(&answers)
        .map(|(family, answers)| {
            cost_rows(family, answers.as_ref(), &records(family.name), &functions)
        })
        .collect();
    let json = Report::new(
        flags.command_line(),
        table.iter().flatten().collect::<Vec<&CostRow>>(),
    );
    let (text, checked) = if flags.check {
        check(&table)
    } else {
        (cost_text(&table), Checks::NONE)
    };
    let page = page.map(|page| paged(flags, &table, page)).transpose()?;
    let said = page.as_ref().map(|page| {
        format!(
            "{}: a page with all figures",
            crate::physics::foreign::path(page.path())
        )
    });
    let files = page.into_iter().collect();
    let mut output = report_beside(text, &json, flags.report.json(), files)?;
    output.remarks.splice(0..0, left_out);
    output.remarks.extend(said);
    output.code = ending(flags, &table, &checked);
    Ok(output)
}

/// 1 where a check found something, 3 where something that could be measured was not and all was required.
fn ending(flags: &CostFlags, table: &[Vec<CostRow>], checked: &Checks) -> u8 {
    let is_lacking = |row: &CostRow| {
        let cannot = row.precision.is_half() && !row.family.half;
        row.family.compiler.dialect().is_some() && !cannot && row.figures.is_err()
    };
    let is_lacking = !checked.whole || table.iter().flatten().any(is_lacking);
    match checked.differ {
        0 if flags.require_all && is_lacking => 3,
        // What nothing was held against is not checked.
        0 if flags.check && checked.agree == 0 && !checked.whole => 3,
        0 => 0,
        _ => 1,
    }
}

/// The functions of a request, and why some are left out.
fn requested(flags: &CostFlags) -> Result<(Vec<CostedFunction>, Vec<String>), Error> {
    let request = Request {
        materials: flags.materials.materials()?,
        ..Request::default()
    };
    let precisions = each_once(&flags.precision);
    let is_of_effects = !flags.effect.is_empty();
    let methods = match is_of_effects {
        true => Vec::new(),
        false => Choice::methods(&flags.method),
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

/// The functions of the effects, by each method that is named.
fn of_effects(flags: &CostFlags) -> Result<Vec<CostedFunction>, Error> {
    let usual = methods::find(USUAL_METHOD).expect("the usual method is registered");
    let named = match flags.method.is_empty() {
        true => vec![usual],
        false => Choice::methods(&flags.method),
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
        return Err(RequestFault::conflict(why).into());
    }
    Ok(functions)
}

/// Fresh counts against the record: what differs, how much, and whether all that has a compiler was compared.
fn check(table: &[Vec<CostRow>]) -> (String, Checks) {
    let (mut text, mut all) = (String::new(), Checks::NONE);
    for rows in table {
        let Some(first) = rows.first() else { continue };
        let found = RecordComparison::new(rows, &records(first.family.name));
        all.agree += found.agree;
        all.differ += found.differences.len();
        all.whole &= found.unchecked.is_none() || first.family.compiler.dialect().is_none();
        text += &found.text(first.family.name);
    }
    (text, all)
}

/// What came of `--check`, all families together.
struct Checks {
    /// Counts that are as recorded, and that are not.
    agree: usize,
    differ: usize,
    /// Whether every family was asked that has a compiler.
    whole: bool,
}

impl Checks {
    const NONE: Checks = Checks {
        agree: 0,
        differ: 0,
        whole: true,
    };
}

/// A family's fresh counts against its record.
#[derive(Default)]
struct RecordComparison {
    agree: usize,
    unknown: usize,
    differences: Vec<String>,
    unchecked: Option<String>,
}

impl RecordComparison {
    fn new(rows: &[CostRow], record: &CostRecord) -> RecordComparison {
        let fresh = rows
            .iter()
            .find(|row| row.source == Some(CostSource::Compiler));
        let compiler = fresh.and_then(|row| row.compiler.as_deref());
        let mut checked = RecordComparison::default();
        match compiler {
            _ if record.compiler.is_empty() => {
                checked.unchecked = Some(
                    "this program holds no record of it: run `tests/costs`, then build it again"
                        .to_owned(),
                );
            }
            None => checked.unchecked = Some(unasked(rows)),
            Some(compiler) if compiler != record.compiler => {
                let recorded = &record.compiler;
                checked.unchecked = Some(format!("here is {compiler}, and recorded {recorded}"));
            }
            Some(_) => rows.iter().for_each(|row| checked.add(row, record)),
        }
        checked
    }

    fn add(&mut self, row: &CostRow, record: &CostRecord) {
        let key = row.key();
        let Some(hash) = record.functions.get(&key) else {
            self.unknown += 1;
            return;
        };
        let known = record.figures.get(hash);
        if row.shader.as_ref() != Some(hash) {
            self.differences
                .push(format!("{key}: the shader is another one"));
        } else if row.figures.as_ref().ok() != known {
            let text = |figures: Option<&CostFigures>| {
                figures.map_or("nothing".to_owned(), CostFigures::text)
            };
            let (now, then) = (text(row.figures.as_ref().ok()), text(known));
            self.differences
                .push(format!("{key}: recorded is {then}, and now it is {now}"));
        } else {
            self.agree += 1;
        }
    }

    fn text(&self, family: &str) -> String {
        if let Some(why) = &self.unchecked {
            return format!("{family}: not checked: {why}\n");
        }
        let differences = self.differences.iter();
        let lines: String = differences
            .map(|line| format!("{family}: {line}\n"))
            .collect();
        let (agree, differ) = (self.agree, self.differences.len());
        let unknown = self.unknown;
        format!("{lines}{family}: {agree} agree, {differ} differ, {unknown} not recorded\n")
    }
}

/// Why a family has no fresh counts.
fn unasked(rows: &[CostRow]) -> String {
    let why = rows.iter().find_map(|row| row.figures.as_ref().err());
    why.cloned()
        .unwrap_or_else(|| "its compiler is not here".to_owned())
}

/// The page, as a file that is to be written.
fn paged(flags: &CostFlags, table: &[Vec<CostRow>], file: PathBuf) -> Result<OutputFile, Error> {
    let page = cost_page(table, &String::from(flags.command_line())).map_err(not_drawn)?;
    Ok(OutputFile::of_report(file, page, flags.pictures.overwrite))
}
