//! `bake`: lookup tables as files, and how wrong each is.

use crate::app::args::BakeFlags;
use crate::app::artifact::Artifact;
use crate::app::error::Error;
use crate::app::fault::RequestFault;
use crate::app::generate::provenance;
use crate::app::lock::{Announce, Lock};
use crate::app::names::unknown;
use crate::app::scope::Scope;
use crate::app::sight::sight;
use crate::app::source::{materials, source};
use crate::app::tables::{WantedTables, artifacts, table_materials};
use crate::app::tree::plan;
use crate::app::write::write;
use crate::bake::{
    ATLAS, BakeRequest, BakeRow, Baked, DEFAULT_AXIS, DEFAULT_FORMATS, SplitSumRequest,
    TableMaterial, TableSize, as_tables_are_seen, bake, bake_split_sum, material_words,
    viewing_flags,
};
use crate::emit::CommandLine;
use crate::lut::{Format, SPLIT_SUM_SIZE, TableAxis, check_size};
use crate::methods::{self, Method, TEXELS};
use crate::report::Report;
use crate::report::table;
use crate::targets::{self, Finish, Target};

use super::generate::named;
use super::{Output, Progress, folder_or_current, refuse_within_tree, report, try_places};

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
    let formats = formats(flags)?;
    let targets = targets(&flags.target)?;
    let sight = sight(&flags.sight.words(flags.gamut.as_deref()))?;
    let wanted = WantedTables {
        materials: materials(&flags.material)?,
        medium: flags.medium.as_deref().map(source).transpose()?,
        sight: as_tables_are_seen(&sight, flags.gamut.is_some()),
    };
    let (subjects, left_out) = table_materials(&wanted)?;
    check_names(&subjects, flags.atlas)?;
    let request = BakeRequest {
        typed: if flags.material == ["all"] {
            "all".to_owned()
        } else {
            material_words(&subjects)
        },
        flags: viewing_flags(&subjects, &wanted.sight),
        subjects,
        formats,
        shape,
        atlas: flags.atlas,
        targets,
        prefix: flags.prefix.clone(),
    };
    try_places(flags.json.as_deref(), None)?;
    let baked = bake(&request, progress)?;
    finished(flags, request.command_line(), baked, &left_out, announce)
}

/// Bakes the split-sum table of a method.
fn split_sum(flags: &BakeFlags, progress: Progress, announce: Announce) -> Result<Output, Error> {
    let name = flags.method.as_deref().unwrap_or("fitted");
    let all = || methods::ALL.iter().filter(|method| method.is_fitted());
    let names: Vec<&str> = all().map(|method| method.name).collect();
    let request = SplitSumRequest {
        method: methods::find(name).ok_or_else(|| unknown("method", name, &names))?,
        size: flags.size.unwrap_or(SPLIT_SUM_SIZE),
        formats: formats(flags)?,
    };
    try_places(flags.json.as_deref(), None)?;
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
    let out_dir = folder_or_current(&flags.out_dir);
    let rows: Vec<BakeRow> = baked.iter().flat_map(|one| one.rows.clone()).collect();
    let files: Vec<Artifact> = baked.into_iter().flat_map(artifacts).collect();
    let mut lock = Lock::take(out_dir, announce);
    let plan = plan(out_dir, &files, &Scope::default(), &provenance(Vec::new()))?;
    refuse_within_tree(&plan, flags.json.as_deref())?;
    let written = write(&plan, flags.overwrite, &mut lock)?;
    let text = if flags.quiet {
        String::new()
    } else {
        bake_text(&rows)
    };
    let mut output = report(text, &Report::new(command, rows), flags.json.as_deref())?;
    output
        .remarks
        .extend(named(&plan, flags.overwrite, "replaced"));
    if flags.quiet {
        return Ok(output);
    }
    output
        .remarks
        .extend(left_out.iter().map(|why| format!("left out: {why}")));
    output.remarks.push(format!(
        "{}: {} written, {} unchanged",
        out_dir.display(),
        written.written,
        written.unchanged
    ));
    Ok(output)
}

fn shape(flags: &BakeFlags) -> Result<TableSize, Error> {
    let axis = flags.axis.as_deref().map(axis).transpose()?;
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

fn axis(name: &str) -> Result<TableAxis, Error> {
    let found = TableAxis::find(&name.to_lowercase());
    found.ok_or_else(|| unknown("axis", name, &TableAxis::ALL.map(TableAxis::name)))
}

/// The formats, in the order of the list, each once.
fn formats(flags: &BakeFlags) -> Result<Vec<Format>, Error> {
    let mut chosen = Vec::new();
    for name in &flags.format {
        let name = name.to_lowercase();
        match Format::find(&name) {
            Some(format) => chosen.push(format),
            None if name == "all" => chosen.extend(Format::ALL),
            None => {
                let all: Vec<&str> = Format::ALL
                    .map(Format::name)
                    .into_iter()
                    .chain(["all"])
                    .collect();
                return Err(unknown("format", &name, &all));
            }
        }
    }
    if chosen.is_empty() {
        let usual: &[Format] = if flags.budget.is_some() {
            &SEARCHED_FORMATS
        } else {
            &DEFAULT_FORMATS
        };
        chosen.extend(usual);
    }
    chosen.sort_unstable();
    chosen.dedup();
    Ok(chosen)
}

/// The languages that get functions, sorted, each once; `all` is those that are written by default.
fn targets(names: &[String]) -> Result<Vec<&'static Target>, Error> {
    let text = || {
        let all = targets::ALL.iter().copied();
        all.filter(|target| target.finish != Finish::Spirv)
    };
    let mut chosen: Vec<&Target> = Vec::new();
    for name in names {
        match targets::find(name) {
            Some(target) if target.finish == Finish::Spirv => return Err(no_function(name)),
            Some(target) => chosen.push(target),
            None if name == "all" => chosen.extend(text().filter(|target| target.by_default)),
            None => {
                let all: Vec<&str> = text().map(|target| target.name).chain(["all"]).collect();
                return Err(unknown("target", name, &all));
            }
        }
    }
    chosen.sort_by_key(|target| target.name);
    chosen.dedup_by_key(|target| target.name);
    Ok(chosen)
}

fn no_function(name: &str) -> Error {
    Error::Usage {
        what: format!(
            "--target {name}: a module is not a function that a shader could call; take wgsl, and compile it with your shader"
        ),
    }
}

/// Whether a table of `--dfg` has this name.
fn is_split_sum(name: &str) -> bool {
    let method = name.strip_prefix("dfg_").and_then(methods::find);
    method.is_some_and(Method::is_fitted)
}

/// There is something to bake, and no material bears the atlas's name.
fn check_names(subjects: &[TableMaterial], atlas: bool) -> Result<(), Error> {
    let what = if subjects.is_empty() {
        "`--material none` leaves nothing to bake; name materials, or all"
    } else if atlas && subjects.iter().any(|subject| subject.name == ATLAS) {
        "a material is named `atlas`, as is the picture of all; choose another `name` in its file"
    } else if subjects.iter().any(|subject| is_split_sum(&subject.name)) {
        "a material is named as a table of `bake --dfg` is; choose another `name` in its file"
    } else {
        return Ok(());
    };
    Err(Error::Usage {
        what: what.to_owned(),
    })
}

/// A line for each row.
fn bake_text(rows: &[BakeRow]) -> String {
    let cells = |row: &BakeRow| {
        let (name, format, texels, axis, file) = match row {
            BakeRow::Table(row) => (&row.name, row.format, row.texels, row.axis, &row.file),
            BakeRow::SplitSum(row) => (&row.name, row.format, row.texels, row.axis, &row.file),
        };
        let (scale, max_abs, mean_rel) = match row {
            BakeRow::Table(row) => (row.scale, row.max_abs, row.mean_rel),
            BakeRow::SplitSum(row) => (row.scale, row.max_abs, row.mean_rel),
        };
        vec![
            name.clone(),
            format.to_owned(),
            texels.to_string(),
            axis.to_owned(),
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
