//! `gallery`: writes the page that draws the effects.

use std::path::PathBuf;

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::material::MaterialFlags;
use crate::cli::output::{Output, Progress};
use crate::cli::places::{folder_or_current, replaced, try_files};
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::json_text;
use crate::generator::output::write::{OutputFile, try_places_of_ours, write_outputs};
use crate::generator::request::Request;
use crate::physics::materials::escaped;
use crate::pictures::gallery::{ListedMaterials, films, gallery, gallery_page, is_shown};

/// The flags of `gallery`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Materials on the page: names, paths of material files, all [default: all]")),
    after_help = "Example:\n  fresnel-gen gallery --out-dir gallery\n\nThe page is DIR/index.html; DIR/materials.json has its materials with the keys of physicallybased.info. The page holds all that it shows, asks nothing of the network, and runs from a file. A browser draws it by WebGPU, or else by WebGL 2 with the generated GLSL ES. Exit codes: 0 done, 2 wrong input."
)]
pub struct GalleryFlags {
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// Write index.html and materials.json into this folder
    #[arg(long, value_name = "DIR")]
    pub out_dir: PathBuf,
    /// Also replace a file that fresnel-gen did not write
    #[arg(long)]
    pub overwrite: bool,
}

impl GalleryFlags {
    /// The command that makes the page again, without paths.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("gallery")
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
    }
}

/// The page's name in its folder.
const PAGE: &str = "index.html";
/// The name of the materials' JSON.
const LIST: &str = "materials.json";
const NO_MATERIALS: &str = "a gallery shows materials; `none` leaves nothing to show";

/// Writes the page.
pub fn run(flags: &GalleryFlags, progress: Progress) -> Result<Output, Error> {
    let folder = folder_or_current(&flags.out_dir);
    let [file, list] = [PAGE, LIST].map(|name| folder.join(name));
    try_files(&[&file, &list])?;
    try_places_of_ours(&[file.clone(), list.clone()], flags.overwrite)?;
    let request = Request {
        materials: flags.materials.materials_or_all(NO_MATERIALS)?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let mut remarks = found.left_out_lines();
    let mut subjects = found.materials();
    if let Some(hidden) = subjects.iter().find(|one| !is_shown(one)) {
        return Err(Error::usage(format!(
            "the material `{}` is under films that no effect shows; those show one clear film",
            hidden.name
        )));
    }
    for film in films(flags.materials.material.is_empty()) {
        match subjects.iter().find(|own| own.name == film.name) {
            None => subjects.push(film),
            Some(own) if own.reference.surface == film.reference.surface => {}
            Some(_) => {
                return Err(Error::usage(format!(
                    "the page has another material that is named `{}`; give yours another name",
                    film.name
                )));
            }
        }
    }
    let space = request.viewing.integration.space;
    let gallery = gallery(&subjects, space, progress);
    let gallery = gallery.map_err(|fault| Error::usage(fault.to_string()))?;
    let command: String = flags.command_line().into();
    let page = gallery_page(&gallery, &command).map_err(Error::usage)?;
    let materials = escaped(&json_text(&ListedMaterials::new(&command, &subjects)));
    let old = write_outputs(&[
        OutputFile::of_report(&file, page, flags.overwrite),
        OutputFile::of_report(&list, materials, flags.overwrite),
    ])?;
    remarks.extend(replaced(&old));
    remarks.push(format!(
        "{}: {} effects, {} methods, {} materials",
        crate::physics::foreign::path(&file),
        gallery.rows.len(),
        gallery.methods.len(),
        gallery.materials.len()
    ));
    Ok(Output {
        remarks,
        ..Output::default()
    })
}
