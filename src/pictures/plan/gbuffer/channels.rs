//! The channels of a G-buffer, where a file has them, and the colour space of its light where the file states one.

use std::io::Cursor;

use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::Vec2;

use super::GbufferFault;
use crate::physics::names::{nearest_names, offered};
use crate::physics::spectra::Space;

/// A channel.
pub struct GbufferChannel {
    /// Its name in the file.
    pub name: &'static str,
    /// The value used where the file lacks the channel; `None` where the channel is required.
    pub default: Option<f64>,
}

const fn needed(name: &'static str) -> GbufferChannel {
    GbufferChannel {
        name,
        default: None,
    }
}

const fn optional(name: &'static str, default: f64) -> GbufferChannel {
    GbufferChannel {
        name,
        default: Some(default),
    }
}

/// All channels.
pub const CHANNELS: [GbufferChannel; 10] = [
    needed("cos_theta"),
    needed("material_id"),
    optional("roughness", 0.0),
    optional("coverage", 1.0),
    needed("light.R"),
    needed("light.G"),
    needed("light.B"),
    optional("other.R", 0.0),
    optional("other.G", 0.0),
    optional("other.B", 0.0),
];
/// Indices into the list; three channels begin at `LIGHT`, and three at `OTHER`.
pub const COS_THETA: usize = 0;
pub const MATERIAL_ID: usize = 1;
pub const ROUGHNESS: usize = 2;
pub const COVERAGE: usize = 3;
pub const LIGHT: usize = 4;
pub const OTHER: usize = 7;

/// The most names of present channels that a message lists.
const LISTED: usize = 40;

/// The place of each channel in the file: part, and channel within the part.
pub struct Places(pub [Option<(usize, usize)>; CHANNELS.len()]);

impl Places {
    /// # Errors
    /// A required channel is missing, or a channel stands twice.
    pub fn of(parts: &[Header]) -> Result<Places, GbufferFault> {
        let present = present_channels(parts);
        let mut places = [None; CHANNELS.len()];
        for (place, channel) in places.iter_mut().zip(&CHANNELS) {
            let exact = |one: &&PresentChannel| one.has_name(channel.name);
            let in_layer = |one: &&PresentChannel| one.has_name_in_layer(channel.name);
            let mut found: Vec<&PresentChannel> = present.iter().filter(exact).collect();
            if found.is_empty() {
                found = present.iter().filter(in_layer).collect();
            }
            *place = found.first().map(|one| one.place);
            if let [first, second, ..] = found[..] {
                return Err(GbufferFault::Twice {
                    channel: channel.name,
                    names: [first, second].map(|one| one.name.clone()),
                    parts: [first, second].map(|one| one.place.0),
                });
            }
        }
        let has_other = places[OTHER..].iter().any(Option::is_some);
        for (at, (place, channel)) in places.iter().zip(&CHANNELS).enumerate() {
            let is_needed = channel.default.is_none() || (at >= OTHER && has_other);
            if place.is_none() && is_needed {
                return Err(missing(channel.name, &present));
            }
        }
        Ok(Places(places))
    }

    /// The first wanted channel of a part; `None` where the part has none.
    pub fn first_of(&self, part: usize) -> Option<usize> {
        let is_there = |place: &Option<(usize, usize)>| place.is_some_and(|(its, _)| its == part);
        self.0.iter().position(is_there)
    }
}

/// A channel of the file.
struct PresentChannel {
    /// Part, and channel within the part.
    place: (usize, usize),
    /// Its name within the part.
    name: String,
    /// With the part's name before it, where the part has one.
    long_name: Option<String>,
}

impl PresentChannel {
    fn has_name(&self, name: &str) -> bool {
        self.name == name || self.long_name.as_deref() == Some(name)
    }

    /// Blender's names: the view layer stands before the name, and a single value is channel `V` of its pass.
    fn has_name_in_layer(&self, name: &str) -> bool {
        let full = self.long_name.as_deref().unwrap_or(&self.name);
        let is_it = |found: &str| found == name || found.strip_suffix(".V") == Some(name);
        // A layer's own name may hold dots.
        let mut dots = full.match_indices('.');
        is_it(full) || is_it(&self.name) || dots.any(|(at, _)| is_it(&full[at + 1..]))
    }
}

fn present_channels(parts: &[Header]) -> Vec<PresentChannel> {
    let mut present = Vec::new();
    for (part, header) in parts.iter().enumerate() {
        for (channel, description) in header.channels.list.iter().enumerate() {
            let name = description.name.to_string();
            let of_part = header.own_attributes.layer_name.as_ref();
            present.push(PresentChannel {
                place: (part, channel),
                long_name: of_part.map(|part| format!("{part}.{name}")),
                name,
            });
        }
    }
    present
}

fn missing(channel: &'static str, present: &[PresentChannel]) -> GbufferFault {
    let full = |one: &PresentChannel| one.long_name.clone().unwrap_or(one.name.clone());
    let names: Vec<String> = present.iter().map(full).collect();
    // A channel that is already used under its right name is not offered for another.
    let is_known =
        |one: &PresentChannel, name: &str| one.has_name(name) || one.has_name_in_layer(name);
    let is_free = |one: &&PresentChannel| !CHANNELS.iter().any(|known| is_known(one, known.name));
    let free: Vec<String> = present.iter().filter(is_free).map(full).collect();
    let free: Vec<&str> = free.iter().map(String::as_str).collect();
    let listed = names.iter().take(LISTED).cloned().collect::<Vec<_>>();
    let rest = match names.len().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    GbufferFault::Missing {
        channel,
        offered: offered(&nearest_names(channel, &free)),
        present: if listed.is_empty() {
            "no channel".to_owned()
        } else {
            listed.join(", ") + &rest
        },
    }
}

/// Checks the primaries that a file states against the plan's space. A file that states none is assumed to be in it.
///
/// # Errors
/// The file states others. A file that cannot be read at all is left to [`super::read_gbuffer`].
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
