//! The flags of `gallery`.

use std::path::PathBuf;

use clap::Args;

use crate::generator::command_line::CommandLine;

use crate::cli::args::MaterialFlags;

/// The flags of `gallery`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Materials on the page: names, paths of material files, all [default: all]")),
    after_help = "Example:\n  fresnel-gen gallery --out-dir gallery\n\nThe page is DIR/index.html. It holds all that it shows, asks nothing of the network, and runs from a file. A browser draws it by WebGPU, or else by WebGL 2 with the generated GLSL ES. Exit codes: 0 done, 2 wrong input."
)]
pub struct GalleryFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// Write index.html into this folder
    #[arg(long, value_name = "DIR")]
    pub out_dir: PathBuf,
    /// Also replace a file that fresnel-gen did not write
    #[arg(long)]
    pub overwrite: bool,
}

impl GalleryFlags {
    /// The command that makes the page again, without places.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("gallery").list("material", self.materials.choices())
    }
}
