//! The space of a G-buffer's light, where its file states one.

use std::io::Cursor;

use exr::meta::MetaData;
use exr::prelude::Vec2;

use super::fault::GbufferFault;
use crate::physics::spectra::Space;

/// Holds the primaries that a file states against the plan's space. A file that states none is taken for it.
///
/// # Errors
/// It states others. What cannot be read at all is left to [`super::read_gbuffer`].
pub fn check_primaries(bytes: &[u8], space: Space) -> Result<(), GbufferFault> {
    let Ok(meta) = MetaData::read_from_buffered(Cursor::new(bytes), false) else {
        return Ok(());
    };
    let mut headers = meta.headers.iter();
    let Some(stated) = headers.find_map(|header| header.shared_attributes.chromaticities) else {
        return Ok(());
    };
    let place = |at: Vec2<f32>| [f64::from(at.0), f64::from(at.1)];
    let primaries = [stated.red, stated.green, stated.blue].map(place);
    let white = place(stated.white);
    if space.has(&primaries, &white) {
        return Ok(());
    }
    let own = Space::ALL
        .into_iter()
        .find(|space| space.has(&primaries, &white));
    Err(GbufferFault::Primaries {
        stated: own.map_or("another space", Space::title),
        wanted: space.title(),
        advice: match own {
            Some(own) => format!("--space {}", own.name()),
            None => "write the frame in one of the spaces of --space".to_owned(),
        },
    })
}
