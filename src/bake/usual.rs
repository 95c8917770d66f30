//! What is baked unless asked otherwise; a run of the generator without flags writes it beside the shaders, so that what
//! their functions called `table` read is there.

use crate::app::error::Error;
use crate::app::generate::Generated;
use crate::app::request::{Materials, Source};
use crate::emit::Naming;
use crate::lut::{Axis, Format};
use crate::materials::Sight;
use crate::methods::TEXELS;
use crate::spectra::Gamut;

use super::words::{said, typed};
use super::{Request, Shape, Wanted, lit, picture};

/// The axis: the one with the smallest errors at equal size.
pub const DEFAULT_AXIS: Axis = Axis::Rational;
/// The files: what most programs read, what engines without float textures read, and what GPUs take.
pub const DEFAULT_FORMATS: [Format; 3] = [Format::ExrHalf, Format::Png16, Format::Ktx2];

/// How materials are seen: colours outside the working space stay in a table, unless another policy was asked for.
pub fn as_tables_are_seen(sight: &Sight, gamut_was_said: bool) -> Sight {
    let mut sight = sight.clone();
    // Where a channel is one wavelength there is no space to be outside of.
    if !gamut_was_said && sight.wavelengths_nm.is_none() {
        sight.gamut = Gamut::Keep;
    }
    sight
}

/// Adds the tables of the usual materials and their atlas to what a run without flags generates. They are not made the
/// run's own: it replaces tables, and removes none, since `bake` writes others beside them.
pub fn add_tables(
    generated: &mut Generated,
    medium: Option<Source>,
    sight: Sight,
) -> Result<(), Error> {
    let request = request(medium, sight)?;
    for (name, subjects) in request.pictures() {
        generated
            .artifacts
            .extend(picture(&request, name, subjects)?.files);
    }
    generated.artifacts.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(())
}

fn request(medium: Option<Source>, sight: Sight) -> Result<Request, Error> {
    let wanted = Wanted {
        materials: Materials::Default,
        medium,
        sight,
    };
    let (subjects, _) = lit(&wanted)?;
    Ok(Request {
        typed: typed(&subjects),
        flags: said(&subjects, &wanted.sight),
        subjects,
        formats: DEFAULT_FORMATS.to_vec(),
        shape: Shape::Fixed {
            axis: DEFAULT_AXIS,
            texels: TEXELS,
        },
        atlas: true,
        targets: Vec::new(),
        prefix: Naming::default().prefix,
    })
}
