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
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::Request;
use crate::lab::stability::{Finding, Map, StabilityRow, Study, film_map, maps};
use crate::language::methods::{self, Method};
use crate::physics::num::Precision;
use crate::pictures::stability_map::{heat_map, percent, stability_page, worst};
use crate::pictures::table;

/// The flags of `stability`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Scan the functions specialised to these instead: names, paths of material files, or all")),
    mut_arg("out_dir", |arg| arg.help("Draw maps of the errors and a page that shows them into this folder; of a material, over the thickness of its film")),
    after_help = "Examples:\n  fresnel-gen stability\n  fresnel-gen stability --method schlick,conductor_textbook --out-dir stability\n  fresnel-gen stability --material gold --json -\n  fresnel-gen stability --material titanium --film titanium_dioxide:400nm --method iridescence_khr --out-dir films"
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
            .each("film", &self.materials.film)
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
    let page = flags
        .pictures
        .folder()
        .map(|folder| folder.join(index(precision)));
    try_places(flags.report.json(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.pictures.overwrite)?;
    let subjects = if is_library {
        Vec::new()
    } else {
        let request = Request {
            materials: flags.materials.materials()?,
            ..Request::default()
        };
        request.subjects()?.materials()
    };
    let mapped = mapped(&study, &subjects);
    if flags.pictures.folder().is_some() && !is_library && mapped.is_empty() {
        let why = "--out-dir draws a material over the thickness of its film: name one clear film (k below .05) with --film, and with --method one that takes its thickness, such as film_spectral_six";
        return Err(Error::usage(why));
    }
    let rows = if is_library {
        study.library_rows(progress)
    } else {
        study.specialised_rows(&subjects, progress)?
    };
    if rows.is_empty() {
        return Err(RequestFault::NothingToDo {
            work: "scan",
            why: if is_library {
                "such a method wants a film: --material titanium --film titanium_dioxide:60nm"
            } else {
                "no such method for these materials"
            },
        }
        .into());
    }
    let json = Report::new(flags.command_line(), rows.clone());
    let (drawn, said) = match flags.pictures.folder() {
        Some(folder) => drawn(flags, &study, &mapped, &rows, folder, progress)?,
        None => (Vec::new(), Vec::new()),
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
    let is_one =
        |method: &&'static Method| !(method.is_textured() || is_library && method.keeps_inputs());
    let numeric = numeric.filter(is_one);
    let chosen = Choice::chosen(words, numeric, |method| method.name);
    let refusal = |method: &Method| {
        if is_library {
            method.half.library_refusal()
        } else {
            method.half.refusal()
        }
    };
    let named = words.iter().filter_map(|word| match word {
        Choice::One(_, method) => Some(*method),
        _ => None,
    });
    let kept = named.filter(|method| is_library && method.keeps_inputs());
    let kept: Vec<String> = kept
        .map(|method| {
            format!(
                "left out: {}: its channels share wavelengths: name a material under a film",
                method.name
            )
        })
        .collect();
    if !Choice::is_all(words) || !precision.is_half() {
        return (chosen, kept);
    }
    let (mut written, mut left_out) = (Vec::new(), kept);
    for method in chosen {
        match refusal(method) {
            Some(why) => left_out.push(format!("left out: {}: {why}", method.name)),
            None => written.push(method),
        }
    }
    (written, left_out)
}

/// The materials under a film with each method that takes its thickness.
fn mapped<'a>(
    study: &Study,
    subjects: &'a [MaterialInMedium],
) -> Vec<(&'a MaterialInMedium, &'static Method)> {
    let of = |subject: &'a MaterialInMedium| {
        let methods = study.methods.iter().copied();
        let takes = move |method: &&'static Method| {
            method.keeps_inputs() && subject.is_described_by(method)
        };
        methods.filter(takes).map(move |method| (subject, method))
    };
    subjects.iter().flat_map(of).collect()
}

/// The maps and the page as files to be written, and the remarks on them.
fn drawn(
    flags: &StabilityFlags,
    study: &Study,
    mapped: &[(&MaterialInMedium, &'static Method)],
    rows: &[StabilityRow],
    folder: &Path,
    progress: Progress,
) -> Result<(Vec<OutputFile>, Vec<String>), Error> {
    let Study { methods, precision } = study;
    let (mut pictures, mut said) = (Vec::new(), Vec::new());
    let picture = |method: &'static Method, map: &Map| png(&heat_map(method.name, map), SCALE);
    for (i, (subject, method)) in mapped.iter().enumerate() {
        progress(i as u64, mapped.len() as u64, "maps");
        let map = film_map(method, subject, *precision)?;
        let (degrees, nm, error) = map.worst();
        let own = subject.material.films[0].thickness_nm;
        said.push(format!(
            "{} for {}, thickness 0 to {own} nm: at most {error:.4} from the law, at {degrees} degrees and {nm:.1} nm; the rows above are of {own} nm",
            method.name, subject.name,
        ));
        let over = format!("{}_{}", map.axis.name, subject.name);
        pictures.push((method.name, over, picture(method, &map)?));
    }
    let bare = methods.iter().filter(|_| mapped.is_empty());
    for (i, method) in bare.enumerate() {
        progress(i as u64, methods.len() as u64, "maps");
        for map in maps(method, *precision) {
            pictures.push((
                method.name,
                map.axis.name.to_owned(),
                picture(method, &map)?,
            ));
        }
    }
    let command = String::from(flags.command_line());
    let page = stability_page(rows, &pictures, &command).map_err(Error::usage)?;
    let index = index(*precision);
    said.push(format!(
        "{}: {} maps, and {index} that shows them",
        crate::physics::foreign::path(&folder),
        pictures.len()
    ));
    let overwrite = flags.pictures.overwrite;
    let suffix = precision.suffix();
    let map = |(method, over, bytes): (&str, String, Vec<u8>)| {
        let path = folder.join(format!("{method}_{over}{suffix}.png"));
        OutputFile::of_report(path, bytes, overwrite)
    };
    let mut files: Vec<OutputFile> = pictures.into_iter().map(map).collect();
    files.push(OutputFile::of_report(folder.join(&index), page, overwrite));
    Ok((files, said))
}

fn cells(row: &StabilityRow) -> Vec<String> {
    let about = match &row.material {
        None => String::new(),
        Some((name, channel)) => format!("{name}, {channel}"),
    };
    let mut cells = vec![row.method.name.to_owned(), about];
    match &row.finding {
        None => cells.extend(["none", "", "", ""].map(str::to_owned)),
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

/// The text of all rows. The column of materials stands where there are any.
fn stability_text(rows: &[StabilityRow]) -> String {
    let mut head = vec!["method", "material", "failure", "where", "of it", "worst"];
    let mut lines: Vec<Vec<String>> = rows.iter().map(cells).collect();
    if rows.iter().all(|row| row.material.is_none()) {
        head.remove(1);
        for line in &mut lines {
            line.remove(1);
        }
    }
    table::text_table(&head, &lines)
}
