//! `stability`: finds where methods fail.

use std::path::Path;

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, one_or_all, precision};
use crate::cli::flags::material::MaterialFlags;
use crate::cli::flags::output::{PictureFlags, ReportFlags};
use crate::cli::output::{Output, Progress, png, report_beside};
use crate::cli::places::try_places;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::request::Request;
use crate::lab::stability::{Finding, StabilityRow, Study, maps};
use crate::language::methods::{self, Method};
use crate::physics::num::Precision;
use crate::pictures::stability_map::{heat_map, percent, stability_page, worst};
use crate::pictures::table;

/// The flags of `stability`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Scan the functions specialised to these instead: names, paths of material files, or all")),
    mut_arg("out_dir", |arg| arg.help("Draw maps of the errors and a page that shows them into this folder").conflicts_with("material")),
    after_help = "Examples:\n  fresnel-gen stability\n  fresnel-gen stability --method schlick,conductor_textbook --out-dir stability\n  fresnel-gen stability --material gold --json -"
)]
pub struct StabilityFlags {
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = scanned_method)]
    pub method: Vec<Choice<&'static Method>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What functions compute in: f32, or f16, rounded after every operation [default: f32]
    #[arg(long, value_name = "NAME", value_parser = precision())]
    pub precision: Option<Precision>,
    /// Pictures and pages.
    #[command(flatten)]
    pub pictures: PictureFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

impl StabilityFlags {
    /// The command that makes this report again, without paths.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("stability")
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .list("precision", self.precision.map(Precision::name))
    }
}

/// Parses a method that is scanned. A method that reads a texture is refused: it is as stable as the sampler.
fn scanned_method(word: &str) -> Result<Choice<&'static Method>, String> {
    if methods::find(word).is_some_and(Method::is_textured) {
        return Err(format!(
            "`{word}` reads a texture, and is as stable as its sampler: not scanned"
        ));
    }
    let scanned = methods::ALL.iter().filter(|method| !method.is_textured());
    let parse = one_or_all("method", scanned.copied(), |method| method.name);
    parse(word).map_err(|unknown| unknown.to_string())
}

/// Pixels of a map for each unit of its drawing.
const SCALE: f32 = 1.0;

/// What is scanned.
struct Asked<'a> {
    flags: &'a StabilityFlags,
    study: Study,
}

/// The page's name in its folder.
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

/// The requested methods, and the reasons why others are left out. A method that reads a texture is as stable as the sampler. A
/// method that is not written in this precision is scanned only if it is named.
fn methods_of(
    words: &[Choice<&'static Method>],
    precision: Precision,
    is_library: bool,
) -> (Vec<&'static Method>, Vec<String>) {
    let numeric = methods::ALL.iter().copied();
    let numeric = numeric.filter(|method| !method.is_textured());
    let chosen = Choice::chosen(words, numeric, |method| method.name);
    let refusal = |method: &Method| {
        if is_library {
            method.half.library_refusal()
        } else {
            method.half.refusal()
        }
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

    /// The maps and the page as files to be written, and the remarks on them.
    fn drawn(
        &self,
        rows: &[StabilityRow],
        folder: &Path,
        progress: Progress,
    ) -> Result<(Vec<OutputFile>, Option<String>), Error> {
        let mut pictures = Vec::new();
        for (i, method) in self.study.methods.iter().enumerate() {
            progress(i as u64, self.study.methods.len() as u64, "maps");
            for map in maps(method, self.study.precision) {
                let picture = png(&heat_map(method.name, &map), SCALE)?;
                pictures.push((method.name, map.axis.name, picture));
            }
        }
        let page = stability_page(rows, &pictures, &String::from(self.flags.command_line()))
            .map_err(Error::usage)?;
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

fn cells(row: &StabilityRow) -> Vec<String> {
    let about = match &row.material {
        None => String::new(),
        Some((name, channel)) => format!("{name}, {channel}"),
    };
    let mut cells = vec![row.method.to_owned(), about];
    match &row.finding {
        None => cells.extend([
            "none".to_owned(),
            String::new(),
            String::new(),
            String::new(),
        ]),
        Some(finding) => cells.extend([
            finding.failure.words(),
            region(finding),
            percent(finding.share),
            worst(finding),
        ]),
    }
    cells
}

/// The region in words, with a note where no medium has such arguments.
fn region(finding: &Finding) -> String {
    if finding.is_media {
        finding.region.clone()
    } else {
        format!("arguments {}", finding.region)
    }
}

/// The text of all rows.
pub fn stability_text(rows: &[StabilityRow]) -> String {
    let head = ["method", "material", "failure", "where", "of it", "worst"];
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let has_material = rows.iter().any(|row| row.material.is_some());
    let wanted = |(i, _): &(usize, String)| *i != 1 || has_material;
    let only = |cells: Vec<String>| -> Vec<String> {
        cells
            .into_iter()
            .enumerate()
            .filter(wanted)
            .map(|(_, cell)| cell)
            .collect()
    };
    let head = only(head.iter().map(|cell| (*cell).to_owned()).collect());
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    table::text_table(&head, &cells.into_iter().map(only).collect::<Vec<_>>())
}
