//! `fresnel-gen` without a subcommand: generate, check, list.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::app::args::Generate;
use crate::app::bake::{add_tables, as_tables_are_seen};
use crate::app::budget::{Budget, within};
use crate::app::catalogue::add_catalogue;
use crate::app::error::Error;
use crate::app::generate::{Generated, Kept, generate_beside, generate_single};
use crate::app::manifest::{self, Manifest};
use crate::app::names::family;
use crate::app::request::Request;
use crate::app::sight::{input, sight};
use crate::app::source::{is_path, materials, source};
use crate::app::tree::{Plan, plan};
use crate::app::write::{write, write_file};
use crate::app::{check, depfile, folder};
use crate::num::Precision;

use super::Output;

/// Generates.
pub fn run(flags: &Generate) -> Result<Output, Error> {
    let (request, said) = chosen(flags, request(flags)?)?;
    if flags.depfile.as_deref() == Some(Path::new("-")) {
        return Err(Error::Usage {
            what: "--depfile takes a file; stdout is not one of its places".to_owned(),
        });
    }
    let mut output = match &flags.output {
        Some(file) => single(flags, &request, file)?,
        None => tree(flags, &request)?,
    };
    let said = said.into_iter().filter(|_| !flags.quiet);
    output.remarks = said.chain(output.remarks).collect();
    Ok(output)
}

/// The tree of files: listed, compared or written.
fn tree(flags: &Generate, request: &Request) -> Result<Output, Error> {
    let out_dir = if flags.out_dir.as_os_str().is_empty() {
        Path::new(".")
    } else {
        &flags.out_dir
    };
    // Only a run that names methods adds to what a material's file holds.
    let kept = if flags.method.is_empty() && request.chosen.is_empty() {
        Kept::new()
    } else {
        kept(out_dir, request.precision)?
    };
    let mut generated = generate_beside(request, &kept)?;
    if request.names_nothing() {
        add_catalogue(&mut generated, request)?;
    }
    if generated.scope.whole {
        let sight = as_tables_are_seen(&request.sight, flags.gamut.is_some());
        add_tables(&mut generated, request.medium.clone(), sight)?;
    }
    if flags.list {
        let names: Vec<String> = generated
            .artifacts
            .iter()
            .map(|artifact| artifact.path.clone() + "\n")
            .collect();
        return Ok(Output {
            stdout: names.concat().into_bytes(),
            ..Output::default()
        });
    }
    let plan = plan(
        out_dir,
        &generated.artifacts,
        &generated.scope,
        &generated.provenance,
    )?;
    if flags.check {
        return Ok(checked(flags, &plan));
    }
    written(flags, &generated, &plan, out_dir)
}

/// The request with the methods that a budget chooses, where one is given, and what is said of the choice.
fn chosen(flags: &Generate, request: Request) -> Result<(Request, Vec<String>), Error> {
    let Some(most) = flags.budget else {
        return Ok((request, Vec::new()));
    };
    let family = family(flags.gpu.as_deref().unwrap_or(USUAL_GPU))?;
    within(request, Budget { most, family })
}

/// Whose costs decide where none is named.
const USUAL_GPU: &str = "rdna2";

fn request(flags: &Generate) -> Result<Request, Error> {
    Ok(Request {
        targets: flags.target.clone(),
        methods: flags.method.clone(),
        materials: materials(&flags.material)?,
        medium: flags.medium.as_deref().map(source).transpose()?,
        prefix: flags.prefix.clone(),
        matching_angle: flags.matching_angle,
        precision: flags.precision.read()?,
        force: flags.precision.force,
        chosen: BTreeMap::new(),
        sight: sight(&flags.sight.words(flags.gamut.as_deref()))?,
    })
}

fn single(flags: &Generate, request: &Request, file: &Path) -> Result<Output, Error> {
    let bytes = generate_single(request)?;
    let mut output = Output::default();
    if file == Path::new("-") {
        output.stdout = bytes;
    } else {
        write_file(file, &bytes)?;
    }
    write_depfile(flags, &[file.display().to_string()])?;
    Ok(output)
}

fn checked(flags: &Generate, plan: &Plan) -> Output {
    let (text, drift) = check::report(plan);
    let mut output = Output {
        stdout: text.into_bytes(),
        code: u8::from(drift),
        ..Output::default()
    };
    if drift && !flags.quiet {
        output.remarks.push(
            "the folder differs from what this run would write; run without --check to write it"
                .into(),
        );
    }
    output
}

fn written(
    flags: &Generate,
    generated: &Generated,
    plan: &Plan,
    out_dir: &Path,
) -> Result<Output, Error> {
    let counts = write(plan)?;
    let outputs: Vec<String> = generated
        .artifacts
        .iter()
        .map(|artifact| out_dir.join(&artifact.path).display().to_string())
        .collect();
    write_depfile(flags, &outputs)?;
    let mut output = Output::default();
    for why in generated.left_out.iter().filter(|_| !flags.quiet) {
        output.remarks.push(format!("left out: {}", why.why));
    }
    for why in generated.refused.iter().filter(|_| !flags.quiet) {
        output.remarks.push(format!("left out: {why}"));
    }
    for path in plan.orphans.iter().filter(|_| !flags.quiet) {
        output
            .remarks
            .push(format!("removed: {path}, which is no longer generated"));
    }
    for path in &plan.foreign {
        output
            .remarks
            .push(format!("left alone: {path} was not written by fresnel-gen"));
    }
    if !flags.quiet {
        let folder = out_dir.display();
        output.remarks.push(format!(
            "{folder}: {} written, {} unchanged, {} removed",
            counts.written, counts.unchanged, counts.removed
        ));
    }
    Ok(output)
}

fn write_depfile(flags: &Generate, outputs: &[String]) -> Result<(), Error> {
    let Some(file) = &flags.depfile else {
        return Ok(());
    };
    let named = flags.material.iter().chain(&flags.medium);
    let light = input(&flags.sight.words(None)).map(str::to_owned);
    let inputs: Vec<String> = named
        .filter(|name| is_path(name))
        .cloned()
        .chain(light)
        .collect();
    write_file(file, depfile::depfile(outputs, &inputs).as_bytes())?;
    Ok(())
}

/// The methods that the folder's material files of this precision hold, by its manifest.
pub fn kept(out_dir: &Path, precision: Precision) -> Result<Kept, Error> {
    let path: PathBuf = out_dir.join(manifest::FILE);
    let Some(text) = folder::read(&path)? else {
        return Ok(Kept::new());
    };
    let mut kept = Kept::new();
    let mut entries = Manifest::parse(&path, &text)?.files;
    entries.retain(|entry| entry.precision() == precision.name());
    for entry in entries {
        let Some(material) = entry.material else {
            continue;
        };
        let functions = entry
            .detail
            .get("functions")
            .and_then(|value| value.as_array())
            .cloned()
            .unwrap_or_default();
        let methods = functions
            .iter()
            .filter_map(|function| Some(function.get("method")?.as_str()?.to_owned()));
        kept.entry((entry.target, material))
            .or_default()
            .extend(methods);
    }
    Ok(kept)
}
