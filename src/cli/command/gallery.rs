//! `gallery`: the effects as a page that draws them.

use crate::cli::args::GalleryFlags;
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::{Materials, Request};
use crate::generator::output::write::{OutputFile, try_places_of_ours, write_outputs};
use crate::pictures::gallery::gallery;
use crate::pictures::gallery::page::gallery_page;

use crate::cli::command::{Output, Progress, folder_or_current, not_drawn, replaced, try_files};

/// The page in its folder.
const PAGE: &str = "index.html";

/// Writes the page.
pub fn run(flags: &GalleryFlags, progress: Progress) -> Result<Output, Error> {
    let file = folder_or_current(&flags.out_dir).join(PAGE);
    try_files(&[&file])?;
    try_places_of_ours(std::slice::from_ref(&file), flags.overwrite)?;
    let request = Request {
        materials: chosen(flags)?,
        ..Request::default()
    };
    let found = request.subjects()?;
    let mut remarks = found.left_out_lines();
    let space = request.viewing.integration.space;
    let gallery = gallery(&found.materials(), space, progress);
    let gallery = gallery.map_err(|fault| not_drawn(fault.to_string()))?;
    let command: String = flags.command_line().into();
    let page = gallery_page(&gallery, &command).map_err(not_drawn)?;
    let old = write_outputs(&[OutputFile::of_report(&file, page, flags.overwrite)])?;
    let (rows, methods, materials) = (
        gallery.rows.len(),
        gallery.methods.len(),
        gallery.materials.len(),
    );
    remarks.extend(replaced(&old));
    remarks.push(format!(
        "{}: {rows} effects, {methods} methods, {materials} materials",
        crate::physics::foreign::path(&file)
    ));
    Ok(Output {
        remarks,
        ..Output::default()
    })
}

/// The materials of the page: the whole catalogue unless others are asked for.
fn chosen(flags: &GalleryFlags) -> Result<Materials, Error> {
    match flags.materials.materials()? {
        Materials::Default => Ok(Materials::All),
        Materials::None => Err(RequestFault::NoMaterial {
            why: "a gallery shows materials; `none` leaves nothing to show",
        }
        .into()),
        named => Ok(named),
    }
}
