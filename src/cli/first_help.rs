//! The first help: what `fresnel-gen` alone prints in a folder without a generated tree, or with adapters for engines only.

use std::path::Path;

use crate::cli::generate::GenerateFlags;
use crate::cli::output::Output;
use crate::cli::places::folder_or_current;
use crate::generator::flavours;
use crate::generator::output::{folder, manifest};

const FIRST: &str = "\
fresnel-gen writes Fresnel reflectance functions for shaders. What most people want:

  fresnel-gen --material gold --target hlsl -o gold.hlsl   write a material's exact function into one file
  fresnel-gen --material gold --budget 0.002 -o gold.wgsl  write the cheapest function within an error
  fresnel-gen generate                                     write the library, four materials and effects in four languages
  fresnel-gen --flavour three --material gold              write an adapter for an engine: three, unity, bevy, godot ...
  fresnel-gen audit mine.glsl --material gold              measure a function of your own

`fresnel-gen --help` shows all flags and commands.";

fn lists_adapters_only(path: &Path, bytes: &[u8]) -> bool {
    let Ok(manifest) = manifest::Manifest::parse(path, bytes) else {
        return false;
    };
    let mut files = manifest.files.iter();
    !manifest.files.is_empty() && files.all(|entry| flavours::find(&entry.target).is_some())
}

/// The help that replaces a run which names nothing, where the output folder has no manifest, or one of adapters only: whoever has an
/// adapter wants no tree of hundreds of files beside it.
pub fn first_help(flags: &GenerateFlags) -> Option<Output> {
    let manifest = folder_or_current(&flags.tree.out_dir).join(manifest::FILE);
    let file = crate::physics::foreign::path(&manifest);
    // A manifest that cannot be read, or is another program's, is for the run to refuse.
    let nowhere = match folder::read(&manifest) {
        Ok(None) => format!("Nothing was written: there is no {file} here."),
        Ok(Some(bytes)) if lists_adapters_only(&manifest, &bytes) => {
            format!("Nothing was written: {file} lists adapters for engines only.")
        }
        _ => return None,
    };
    Some(Output {
        remarks: FIRST.lines().map(str::to_owned).chain([nowhere]).collect(),
        code: 2,
        ..Output::default()
    })
}
