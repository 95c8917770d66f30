//! `bake`: lookup tables as files, and how wrong each is.

use crate::cli::args::{BakeFlags, Choice};
use crate::generator::output::artifact::Artifact;
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::generate::provenance;
use crate::generator::output::lock::{Announce, Lock};
use crate::generator::output::scope::Scope;
use crate::generator::generate::tables::{WantedTables, artifacts, table_materials};
use crate::generator::output::tree::plan;
use crate::generator::output::write::write;
use crate::generator::bake::{ATLAS, BakeRequest, BakeRow, Baked, DEFAULT_AXIS, DEFAULT_FORMATS, SplitSumRequest, TableMaterial, TableSize, as_tables_are_seen, bake, bake_split_sum, material_words, usual_method, viewing_flags};
use crate::generator::command_line::CommandLine;
use crate::generator::lut::{Format, SPLIT_SUM_SIZE, SplitSumLayout, TableAxis, check_size};
use crate::language::methods::TEXELS;
use crate::language::targets::{self, Finish, Target};
use crate::generator::envelope::Report;
use crate::pictures::table;

use crate::cli::command::generate::named;
use crate::cli::command::{Output, Progress, folder_or_current, refuse_within_tree, reported, try_places};

/// The files that a search chooses from where none are asked for: one of each depth.
const SEARCHED_FORMATS: [Format; 4] = [
    Format::Png8,
    Format::ExrHalf,
    Format::Png16,
    Format::ExrFloat,
];

/// Bakes.
pub fn run(flags: &BakeFlags, progress: Progress, announce: Announce) -> Result<Output, Error> {
    if flags.dfg {
        return split_sum(flags, progress, announce);
    }
    let shape = shape(flags)?;
    let viewing = flags.viewing.conditions()?;
    let wanted = WantedTables {
        materials: flags.materials.materials()?,
        medium: flags.medium.source()?,
        viewing: as_tables_are_seen(&viewing, flags.viewing.gamut.is_some()),
    };
    let (subjects, left_out) = table_materials(&wanted)?;
    check_names(&subjects, flags.atlas)?;
    let request = BakeRequest {
        typed: if flags.materials.choices().eq([&Choice::All]) {
            vec!["all".to_owned()]
        } else {
            material_words(&subjects)
        },
        flags: viewing_flags(&subjects, &wanted.viewing),
        subjects,
        formats: formats(flags),
        shape,
        atlas: flags.atlas,
        targets: targets(&flags.target),
        prefix: flags.prefix.clone(),
    };
    try_places(flags.report.json(), None)?;
    let baked = bake(&request, progress)?;
    finished(flags, request.command_line(), baked, &left_out, announce)
}

/// Bakes the split-sum table of a method.
fn split_sum(flags: &BakeFlags, progress: Progress, announce: Announce) -> Result<Output, Error> {
    let layout = flags.layout.unwrap_or(SplitSumLayout::Terms);
    let request = SplitSumRequest {
        method: flags.method.unwrap_or(usual_method(layout)),
        layout,
        size: flags.size.unwrap_or(SPLIT_SUM_SIZE),
        axes: flags.split_sum_axes()?,
        formats: match flags.format.is_empty() {
            true => Vec::new(),
            false => formats(flags),
        },
    };
    try_places(flags.report.json(), None)?;
    let baked = bake_split_sum(&request, progress)?;
    finished(flags, request.command_line(), vec![baked], &[], announce)
}

/// Writes what was baked, and tells of it.
fn finished(
    flags: &BakeFlags,
    command: CommandLine,
    baked: Vec<Baked>,
    left_out: &[String],
    announce: Announce,
) -> Result<Output, Error> {
    let out_dir = folder_or_current(&flags.tree.out_dir);
    let rows: Vec<BakeRow> = baked.iter().flat_map(|one| one.rows.clone()).collect();
    let files: Vec<Artifact> = baked.into_iter().flat_map(artifacts).collect();
    let mut lock = Lock::take(out_dir, announce);
    let plan = plan(out_dir, &files, &Scope::default(), &provenance(Vec::new()))?;
    refuse_within_tree(&plan, flags.report.json())?;
    let text = if flags.quiet {
        String::new()
    } else {
        bake_text(&rows)
    };
    let (mut output, json) = reported(text, &Report::new(command, rows), flags.report.json());
    let written = write(&plan, json.as_slice(), flags.tree.overwrite, &mut lock)?;
    output
        .remarks
        .extend(named(&plan, flags.tree.overwrite, "replaced"));
    if flags.quiet {
        return Ok(output);
    }
    output.remarks.extend(left_out.iter().map(|why| {
        format!(
            "left out: {}",
            crate::physics::foreign::one_line(&why.to_string())
        )
    }));
    output.remarks.push(format!(
        "{}: {} written, {} unchanged",
        crate::physics::foreign::path(&out_dir),
        written.written,
        written.unchanged
    ));
    Ok(output)
}

fn shape(flags: &BakeFlags) -> Result<TableSize, Error> {
    let axis = flags.table_axis()?;
    match flags.budget {
        None => {
            let texels = flags.size.unwrap_or(TEXELS);
            check_size(texels)?;
            Ok(TableSize::Fixed {
                axis: axis.unwrap_or(DEFAULT_AXIS),
                texels,
            })
        }
        Some(budget) if budget > 0.0 && budget.is_finite() => Ok(TableSize::Within {
            budget,
            axes: axis.map_or(TableAxis::ALL.to_vec(), |axis| vec![axis]),
        }),
        Some(budget) => Err(RequestFault::OutOfRange {
            flag: "budget",
            value: budget.to_string(),
            allowed: "is an error of reflectance, above 0, such as 0.001".to_owned(),
        }
        .into()),
    }
}

/// The formats, in the order of the list, each once.
fn formats(flags: &BakeFlags) -> Vec<Format> {
    match (flags.format.is_empty(), flags.budget) {
        (true, Some(_)) => SEARCHED_FORMATS.to_vec(),
        (true, None) => DEFAULT_FORMATS.to_vec(),
        (false, _) => Choice::chosen(&flags.format, Format::ALL, |format| format.name()),
    }
}

/// The languages that get functions, each once; `all` is those that are written by default.
fn targets(words: &[Choice<&'static Target>]) -> Vec<&'static Target> {
    let is_text = |target: &&Target| target.finish != Finish::Spirv;
    let is_chosen = |target: &&Target| {
        words.iter().any(|word| match word {
            Choice::One(name, _) => name == target.name,
            Choice::All | Choice::None => target.by_default,
        })
    };
    let text = targets::ALL.iter().copied().filter(is_text);
    text.filter(is_chosen).collect()
}

/// Whether a table of `--dfg` may have this name.
fn is_split_sum(name: &str) -> bool {
    name.starts_with("dfg_")
}

/// There is something to bake, and no material bears the atlas's name.
fn check_names(subjects: &[TableMaterial], atlas: bool) -> Result<(), Error> {
    if subjects.is_empty() {
        let why = "`--material none` leaves nothing to bake; name materials, or all";
        return Err(RequestFault::NoMaterial { why }.into());
    }
    let taken = |subject: &TableMaterial| match subject.name.as_str() {
        ATLAS if atlas => Some("the picture of all"),
        name if is_split_sum(name) => Some("a table of `bake --dfg`"),
        _ => None,
    };
    match subjects
        .iter()
        .find_map(|subject| Some((&subject.name, taken(subject)?)))
    {
        None => Ok(()),
        Some((name, meaning)) => Err(RequestFault::NameTaken {
            name: name.clone(),
            meaning,
        }
        .into()),
    }
}

/// A line for each row.
fn bake_text(rows: &[BakeRow]) -> String {
    let cells = |row: &BakeRow| {
        let (name, format, texels, axis, file) = match row {
            BakeRow::Table(row) => (
                &row.name,
                row.format,
                row.texels,
                row.axis.to_string(),
                &row.file,
            ),
            BakeRow::SplitSum(row) => (
                &row.name,
                row.format,
                row.texels,
                row.axis.to_string(),
                &row.file,
            ),
        };
        let (scale, max_abs, mean_rel) = match row {
            BakeRow::Table(row) => (row.scale, row.max_abs, row.mean_rel),
            BakeRow::SplitSum(row) => (row.scale, row.max_abs, row.mean_rel),
        };
        vec![
            name.clone(),
            format.to_owned(),
            texels.to_string(),
            axis,
            file.clone(),
            format!("{scale:?}"),
            format!("{max_abs:.6}"),
            mean_rel.map_or("none".to_owned(), |mean| format!("{:.4}", 100.0 * mean)),
        ]
    };
    let head = [
        "name",
        "format",
        "texels",
        "axis",
        "file",
        "scale",
        "max error",
        "mean error, %",
    ];
    table::text_table(&head, &rows.iter().map(cells).collect::<Vec<_>>())
}
