//! Reads back a plan that `plan --json` wrote, as the request for exactly its functions.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::cli::error::Error;
use crate::cli::flags::material::MaterialName;
use crate::generator::emit::FunctionForm;
use crate::generator::envelope::{SCHEMA, TOOL};
use crate::generator::error::unknown;
use crate::generator::request::source::{self, load};
use crate::generator::request::{Materials, Methods, Request};
use crate::lab::budget::is_choosable;
use crate::language::methods::{Gpu, Method};
use crate::physics::foreign::Foreign;
use crate::physics::materials;
use crate::physics::num::Precision;
use crate::physics::spectra::Space;
use crate::physics::user_text::FileFault;
use crate::pictures::plan::{PLANNED_FORMS, PlanFile, PlanFileRow};

/// The first word of a plan's command.
const COMMAND: &str = "plan";

/// The request for a plan's functions: those of each material, and library files.
///
/// # Errors
/// The plan names something that does not exist, or a file that it must not name.
pub fn planned(
    file: &Path,
    plan: &PlanFile,
    allowed: &[PathBuf],
    request: Request,
) -> Result<Request, Error> {
    let mut sources = Vec::new();
    let mut chosen = BTreeMap::new();
    let mut library = Vec::new();
    for (place, row) in plan.rows.iter().enumerate() {
        let at_row = |error: Error| {
            Error::usage(format!(
                "{}: row {} ({}): {error}",
                crate::physics::foreign::path(&file),
                place + 1,
                Foreign(&row.material)
            ))
        };
        let method = method(row).map_err(at_row)?;
        if row.form != FunctionForm::Specialised {
            library.push(method);
            continue;
        }
        let material = MaterialName::parse(&row.material).map_err(Error::from);
        let name = material.map_err(at_row)?;
        check_place(file, &name, allowed).map_err(at_row)?;
        let source = name.source().map_err(at_row)?;
        let loaded = load(&source).map_err(|fault| at_row(fault.into()))?;
        let name = loaded.material.name;
        if chosen.insert(name, method).is_some() {
            let what =
                "another row gives this material a function; a plan has one for each".to_owned();
            return Err(at_row(Error::usage(what)));
        }
        sources.push(source);
    }
    let mut viewing = request.viewing.clone();
    viewing.integration.space = space(plan)?;
    Ok(Request {
        methods: if library.is_empty() {
            Methods::Default
        } else {
            Methods::These(library)
        },
        materials: if sources.is_empty() {
            Materials::None
        } else {
            Materials::These(sources)
        },
        chosen,
        viewing,
        precision: precision(file, plan)?,
        gpu: request.gpu.or_else(|| Gpu::find(&plan.gpu)),
        ..request
    })
}

/// Refuses a material file that a plan must not name.
fn check_place(plan: &Path, name: &MaterialName, allowed: &[PathBuf]) -> Result<(), Error> {
    let Some(path) = name.path() else {
        return Ok(());
    };
    let checked = source::check_below(plan, Path::new(path), allowed);
    checked.map_err(Error::usage)
}

/// The method of a row, which must be one that plans choose, in a form that they choose.
fn method(row: &PlanFileRow) -> Result<&'static Method, Error> {
    let method: &Method = row.method.parse()?;
    if !is_choosable(method) || !PLANNED_FORMS.contains(&row.form) {
        let what = format!(
            "no plan chooses `{}` as a function that is {}",
            method.name,
            row.form.name()
        );
        return Err(Error::usage(what));
    }
    Ok(method)
}

/// The paths of material files that a plan names.
pub fn material_paths(plan: &PlanFile) -> impl Iterator<Item = &str> {
    let own = plan.rows.iter();
    let own = own.filter(|row| row.form == FunctionForm::Specialised);
    own.map(|row| &*row.material)
        .filter(|material| materials::source(material).is_none())
}

/// Reads a plan.
///
/// # Errors
/// The file cannot be read, or is no plan.
pub fn read(file: &Path) -> Result<PlanFile, Error> {
    let text = source::text(file)?;
    let fault = |line: usize, column: usize, what: String| FileFault {
        file: file.display().to_string(),
        line: line.max(1),
        column: column.max(1),
        what,
    };
    let made_by = "`fresnel-gen plan --json FILE` makes one";
    let plan: PlanFile = serde_json::from_str(&text).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        let error = error.to_string();
        let why = error.split(" at line ").next().unwrap_or_default();
        let what = format!("this is no plan: {why}; {made_by}");
        fault(line, column, what)
    })?;
    let is_ours = plan.tool == TOOL && plan.schema == SCHEMA;
    let is_plan = plan.command.split(' ').next() == Some(COMMAND);
    if !is_ours || !is_plan || plan.rows.is_empty() {
        let what = format!("this is no plan with functions; {made_by}");
        return Err(fault(1, 1, what).into());
    }
    Ok(plan)
}

fn space(plan: &PlanFile) -> Result<Space, Error> {
    let found = Space::ALL
        .into_iter()
        .find(|space| space.name() == plan.space);
    found.ok_or_else(|| unknown("space", &plan.space, &Space::ALL.map(Space::name)).into())
}

/// The precision of a plan, which must have only one.
fn precision(file: &Path, plan: &PlanFile) -> Result<Precision, Error> {
    let first = plan.rows[0].precision;
    if plan.rows.iter().all(|row| row.precision == first) {
        Ok(first)
    } else {
        Err(Error::usage(format!(
            "{}: its functions compute in different precisions; a plan has one",
            crate::physics::foreign::path(&file)
        )))
    }
}
