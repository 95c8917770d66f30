//! What is wrong with a G-buffer, and where.

use thiserror::Error;

use super::GREATEST_SIDE;
use crate::physics::foreign::{Foreign, one_line};

/// Why a file is no usable G-buffer. The caller puts the file's name before it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum GbufferFault {
    /// The file is no OpenEXR file, or is truncated or broken.
    #[error("not a readable OpenEXR file: {}", Foreign(_0))]
    Unreadable(String),
    /// The frame has too many pixels.
    #[error(
        "a frame of {width} x {height} pixels; the largest has {GREATEST_SIDE} x {GREATEST_SIDE}, the smallest 1 x 1"
    )]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The light is in another space than the plan's.
    #[error(
        "its `chromaticities` are those of {stated}, and the plan's light is in {wanted}: {advice}"
    )]
    Primaries {
        /// The space of the file.
        stated: &'static str,
        /// The space of the plan.
        wanted: &'static str,
        /// What to do.
        advice: String,
    },
    /// The header announces more than the file can hold.
    #[error(
        "its header announces {announced} bytes of pixels, which {held} bytes of file cannot hold: the file is broken or cut short"
    )]
    Announced {
        /// Bytes of all pixels, uncompressed.
        announced: u64,
        /// Bytes of the file.
        held: usize,
    },
    /// A part is stored in a way that is not read.
    #[error("the part with channel `{channel}` has {}; {allowed}", Foreign(found))]
    Stored {
        /// The first wanted channel of that part.
        channel: &'static str,
        /// How it is stored.
        found: String,
        /// What is read.
        allowed: &'static str,
    },
    /// A required channel is missing.
    #[error(
        "channel `{channel}` is missing{}; the file has {}",
        one_line(offered),
        Foreign(present)
    )]
    Missing {
        /// The channel.
        channel: &'static str,
        /// The question whether a present channel was meant, or nothing.
        offered: String,
        /// The names of the channels that are present.
        present: String,
    },
    /// A channel stands twice.
    #[error(
        "channel `{channel}` stands twice, {}; it must stand once",
        twice_in(names, *parts)
    )]
    Twice {
        /// The channel.
        channel: &'static str,
        /// Its names in the file, with the layers that they stand in.
        names: [String; 2],
        /// The parts that hold it, counted from 0: two, or one twice.
        parts: [usize; 2],
    },
    /// Two parts have different pixels.
    #[error(
        "channel `{channel}` has the data window {found}, and `{first_channel}` has {first}; all channels need the same"
    )]
    Windows {
        /// A channel.
        channel: &'static str,
        /// Its data window.
        found: String,
        /// A channel before it.
        first_channel: &'static str,
        /// The data window of that channel.
        first: String,
    },
    /// A value that the channel cannot have.
    #[error("channel {channel}, pixel ({x}, {y}): {what}")]
    Value {
        /// The channel.
        channel: &'static str,
        /// The pixel's column, from 0.
        x: usize,
        /// The pixel's row, from 0 at the top.
        y: usize,
        /// What was found, and what is allowed.
        what: String,
    },
}

/// Where a channel stands twice: its names where they differ, else the parts, counted from 1.
fn twice_in([name, other]: &[String; 2], [first, second]: [usize; 2]) -> String {
    if name != other {
        return format!("as `{}` and as `{}`", Foreign(name), Foreign(other));
    }
    if first == second {
        format!("both times in part {}", first + 1)
    } else {
        format!("in part {} and in part {}", first + 1, second + 1)
    }
}
