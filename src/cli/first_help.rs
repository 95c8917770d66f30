//! The first help: what `fresnel-gen` alone prints in a folder without a generated tree.

use crate::cli::generate::GenerateFlags;
use crate::cli::output::Output;
use crate::cli::places::folder_or_current;
use crate::generator::output::{folder, manifest};

const FIRST: &str = "\
fresnel-gen writes Fresnel reflectance functions for shaders. What most people want:

  fresnel-gen --material gold --target hlsl -o gold.hlsl   write a material's exact function into one file
  fresnel-gen --material gold --budget 0.002 -o gold.wgsl  write the cheapest function within an error
  fresnel-gen generate                                     write the library, four materials and effects in four languages
  fresnel-gen --flavour three --material gold              write an adapter for an engine: three, unity, bevy, godot ...
  fresnel-gen audit mine.glsl --material gold              measure a function of your own

`fresnel-gen --help` shows all flags and commands.";

/// The help that replaces a run which names nothing, where the output folder has no manifest.
pub fn first_help(flags: &GenerateFlags) -> Option<Output> {
    let manifest = folder_or_current(&flags.tree.out_dir).join(manifest::FILE);
    // A manifest that cannot be read, or is another program's, is for the run to refuse.
    if !matches!(folder::read(&manifest), Ok(None)) {
        return None;
    }
    let nowhere = format!(
        "Nothing was written: there is no {} here.",
        crate::physics::foreign::path(&manifest)
    );
    Some(Output {
        remarks: FIRST.lines().map(str::to_owned).chain([nowhere]).collect(),
        code: 2,
        ..Output::default()
    })
}
