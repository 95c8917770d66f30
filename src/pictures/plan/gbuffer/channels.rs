//! The channels of a G-buffer, where a file has them, and the colour space of its light where the file states one.

use std::io::Cursor;

use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::Vec2;

use crate::physics::foreign::{Foreign, one_line};
use crate::physics::names::{nearest_names, offered};
use crate::physics::spectra::Space;

/// Why a file is no usable G-buffer: what was found, where, and what is allowed. The caller puts the file's name before it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct GbufferFault(pub(super) String);

/// The name of each channel, and the value used where the file lacks it; `None` where the channel is required.
pub const CHANNELS: [(&str, Option<f64>); 10] = [
    ("cos_theta", None),
    ("material_id", None),
    ("roughness", Some(0.0)),
    ("coverage", Some(1.0)),
    ("light.R", None),
    ("light.G", None),
    ("light.B", None),
    ("other.R", Some(0.0)),
    ("other.G", Some(0.0)),
    ("other.B", Some(0.0)),
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
        for (place, (channel, _)) in places.iter_mut().zip(CHANNELS) {
            let exact = |one: &&PresentChannel| one.has_name(channel);
            let in_layer = |one: &&PresentChannel| one.has_name_in_layer(channel);
            let mut found: Vec<&PresentChannel> = present.iter().filter(exact).collect();
            if found.is_empty() {
                found = present.iter().filter(in_layer).collect();
            }
            *place = found.first().map(|one| one.place);
            if let [first, second, ..] = found[..] {
                let what = twice_in(first, second);
                return Err(GbufferFault(format!(
                    "channel `{channel}` stands twice, {what}; it must stand once"
                )));
            }
        }
        let has_other = places[OTHER..].iter().any(Option::is_some);
        for (at, (place, (channel, default))) in places.iter().zip(CHANNELS).enumerate() {
            let is_needed = default.is_none() || (at >= OTHER && has_other);
            if place.is_none() && is_needed {
                return Err(missing(channel, &present));
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

/// Where a channel stands twice: its names where they differ, else the parts, counted from 1.
fn twice_in(first: &PresentChannel, second: &PresentChannel) -> String {
    let [name, other] = [&first.name, &second.name];
    if name != other {
        return format!("as `{}` and as `{}`", Foreign(name), Foreign(other));
    }
    let [part, other] = [first.place.0 + 1, second.place.0 + 1];
    if part == other {
        format!("both times in part {part}")
    } else {
        format!("in part {part} and in part {other}")
    }
}

fn missing(channel: &str, present: &[PresentChannel]) -> GbufferFault {
    let full = |one: &PresentChannel| one.long_name.clone().unwrap_or(one.name.clone());
    let names: Vec<String> = present.iter().map(full).collect();
    // A channel that is already used under its right name is not offered for another.
    let is_known =
        |one: &PresentChannel, name: &str| one.has_name(name) || one.has_name_in_layer(name);
    let is_free = |one: &&PresentChannel| !CHANNELS.iter().any(|(known, _)| is_known(one, known));
    let free: Vec<String> = present.iter().filter(is_free).map(full).collect();
    let free: Vec<&str> = free.iter().map(String::as_str).collect();
    let listed = names.iter().take(LISTED).cloned().collect::<Vec<_>>();
    let present = match names.len().saturating_sub(LISTED) {
        0 if listed.is_empty() => "no channel".to_owned(),
        0 => listed.join(", "),
        more => format!("{} and {more} more", listed.join(", ")),
    };
    GbufferFault(format!(
        "channel `{channel}` is missing{}; the file has {}",
        one_line(&offered(&nearest_names(channel, &free))),
        Foreign(present)
    ))
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
    let stated = own.map_or("another space", Space::title);
    let advice = match own {
        Some(own) => format!("--space {}", own.name()),
        None => "write the frame in one of the spaces of --space".to_owned(),
    };
    Err(GbufferFault(format!(
        "its `chromaticities` are those of {stated}, and the plan's light is in {}: {advice}",
        space.title()
    )))
}
