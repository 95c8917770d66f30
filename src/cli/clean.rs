//! `clean`: removes what this program wrote into a folder, and nothing else.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::error::Error;
use crate::cli::output::Output;
use crate::cli::places::folder_or_current;
use crate::generator;
use crate::generator::envelope::json_text;
use crate::generator::error::RequestFault;
use crate::generator::generate::provenance;
use crate::generator::output::folder::read;
use crate::generator::output::lock::{Announce, Lock};
use crate::generator::output::manifest::{self, Entry, Manifest, Scope};
use crate::generator::output::ownership::{KeptFile, could_be_written, remove_manifest};
use crate::generator::output::tree::plan;
use crate::generator::output::write::write;
use crate::physics::foreign::{self, Foreign};

/// The flags of `clean`.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  fresnel-gen clean --list\n\nA file goes if manifest.json lists it and it is as fresnel-gen wrote it. Others stay, and are named."
)]
pub struct CleanFlags {
    /// The folder with the manifest.json
    #[arg(long, value_name = "DIR", default_value = "shaders-generated")]
    pub out_dir: PathBuf,
    /// Print the names of the files that would go, and remove nothing
    #[arg(long)]
    pub list: bool,
}

/// Refuses a folder with a listed file that cannot be read: it would be taken for one that is gone.
fn check_readable(out_dir: &Path, manifest: &Manifest) -> Result<(), Error> {
    let ours = manifest
        .files
        .iter()
        .filter(|entry| could_be_written(entry));
    for entry in ours {
        match read(&out_dir.join(&entry.file)) {
            // What lies there is somebody else's, and stays.
            Ok(_) | Err(generator::error::Error::NotAFile { .. }) => {}
            Err(fault) => return Err(fault.into()),
        }
    }
    Ok(())
}

/// Removes. `announce` gets what a person should know before the run ends.
pub fn run(flags: &CleanFlags, announce: Announce) -> Result<Output, Error> {
    let out_dir = folder_or_current(&flags.out_dir);
    let folder = foreign::path(&out_dir);
    let Some((mut manifest, _)) = Manifest::in_folder(out_dir)? else {
        let why = format!(
            "there is no manifest.json in {folder}: nothing there is known to be fresnel-gen's"
        );
        return Err(RequestFault::refused(why).into());
    };
    check_readable(out_dir, &manifest)?;
    let mut lock = (!flags.list).then(|| Lock::take(out_dir, announce));
    let all = Scope {
        alone: true,
        ..Scope::default()
    };
    let mut plan = plan(out_dir, &[], &all, &provenance(Vec::new()))?;
    // What stays keeps its entry, so that it can be cleaned when it is again as it was written.
    let stays = |entry: &Entry| plan.kept.iter().any(|kept| kept.path == entry.file);
    manifest.files.retain(stays);
    let is_all = manifest.files.is_empty();
    if !is_all {
        plan.manifest.new = json_text(&manifest).into_bytes();
    }
    let left = |kept: &KeptFile| {
        format!(
            "left alone: {}: it is not as fresnel-gen wrote it",
            Foreign(&kept.path)
        )
    };
    let stay: Vec<String> = plan.kept.iter().map(left).collect();
    let Some(lock) = &mut lock else {
        let files = plan.orphans.iter().map(|entry| entry.file.as_str());
        let files = files.chain(is_all.then_some(manifest::FILE));
        let files = files.map(|file| format!("{file}\n"));
        return Ok(Output {
            stdout: files.collect::<String>().into_bytes(),
            remarks: stay,
            ..Output::default()
        });
    };
    let counts = write(&plan, &[], false, lock)?;
    if is_all {
        remove_manifest(out_dir, &plan.manifest.new)?;
    }
    let removed = format!("{folder}: {} removed", counts.removed + usize::from(is_all));
    Ok(Output {
        remarks: stay.into_iter().chain([removed]).collect(),
        ..Output::default()
    })
}
