//! The samples of the wanted channels, read by the crate `exr`.
//!
//! The crate allocates whatever a header announces. So sizes are compared with the length of the file before anything is
//! allocated, and only lossless compressions are read.

use core::fmt::Display;
use std::collections::BTreeSet;
use std::io::Cursor;
use std::ops::Range;

use exr::block::UncompressedBlock;
use exr::block::reader::{ChunksReader, Reader};
use exr::meta::BlockDescription;
use exr::meta::header::Header;
use exr::prelude::{Compression, SampleType, Vec2, f16};

use super::channels::{CHANNELS, GbufferFault, Places};
use crate::physics::foreign::Foreign;
use crate::pictures::scene::is_deep;

/// Pixels across, and down: no frame has more.
const GREATEST_SIDE: usize = 8192;

/// A file whose headers are read.
pub type Opened<'a> = Reader<Cursor<&'a [u8]>>;

/// # Errors
/// The file does not begin as OpenEXR files do, or its headers contradict themselves.
pub fn opened(bytes: &[u8]) -> Result<Opened<'_>, GbufferFault> {
    if is_deep(bytes) {
        return Err(unreadable("it holds deep pixels; flat ones are read"));
    }
    exr::block::read(Cursor::new(bytes), false).map_err(unreadable)
}

/// The file is no OpenEXR file, or is truncated or broken.
fn unreadable(why: impl Display) -> GbufferFault {
    GbufferFault(format!("not a readable OpenEXR file: {}", Foreign(why)))
}

/// Pixels across and down. `held` is the length of the file.
///
/// # Errors
/// The wanted channels differ in their pixels, are stored in a way that is not read, or do not all fit in the file.
pub fn size(parts: &[Header], places: &Places, held: usize) -> Result<[usize; 2], GbufferFault> {
    let mut first: Option<(usize, &Header)> = None;
    let mut chunks = 0_u64;
    for (part, header) in parts.iter().enumerate() {
        // Each chunk has an entry of 8 bytes in the chunk table, and 8 bytes before its data.
        chunks = chunks.saturating_add(header.chunk_count as u64);
        announced(chunks.saturating_mul(16), held)?;
        check_tiles(part, header)?;
        let Some(channel) = places.first_of(part) else {
            continue;
        };
        check_stored(header, channel)?;
        let Vec2(width, height) = header.layer_size;
        if !is_frame([width, height]) {
            return Err(GbufferFault(format!(
                "a frame of {width} x {height} pixels; the largest has {GREATEST_SIDE} x {GREATEST_SIDE}, the smallest 1 x 1"
            )));
        }
        let bytes_a_pixel = header.channels.bytes_per_pixel as u64;
        let bytes = bytes_a_pixel.saturating_mul((width * height) as u64);
        announced(bytes / most_a_byte(header.compression), held)?;
        let (first_channel, leading) = *first.get_or_insert((channel, header));
        if window(leading) != window(header) {
            return Err(GbufferFault(format!(
                "channel `{}` has the data window {}, and `{}` has {}; all channels need the same",
                CHANNELS[channel].0,
                window(header),
                CHANNELS[first_channel].0,
                window(leading)
            )));
        }
    }
    let size = first.map_or(Vec2(0, 0), |(_, header)| header.layer_size);
    Ok([size.0, size.1])
}

fn announced(bytes: u64, held: usize) -> Result<(), GbufferFault> {
    if bytes <= held as u64 {
        return Ok(());
    }
    Err(GbufferFault(format!(
        "its header announces {bytes} bytes of pixels, which {held} bytes of file cannot hold: the file is broken or cut short"
    )))
}

/// The most bytes that a byte of the file can stand for. RLE: 128 bytes in 2. Deflate, used by ZIP: 258 bytes in 2 bits. PIZ: 256
/// samples of 2 bytes in 10 bits, which is less.
fn most_a_byte(compression: Compression) -> u64 {
    match compression {
        Compression::Uncompressed => 1,
        Compression::RLE => 64,
        _ => 1032,
    }
}

fn window(header: &Header) -> String {
    let Vec2(width, height) = header.layer_size;
    let Vec2(x, y) = header.own_attributes.layer_position;
    format!("{width} x {height} at ({x}, {y})")
}

/// Checks the tiles of any part, since the crate multiplies their sides.
fn check_tiles(part: usize, header: &Header) -> Result<(), GbufferFault> {
    let BlockDescription::Tiles(tiles) = header.blocks else {
        return Ok(());
    };
    let Vec2(width, height) = tiles.tile_size;
    if is_frame([width, height]) {
        return Ok(());
    }
    let part = part + 1;
    let what = format!("part {part} has tiles of {width} x {height} pixels");
    Err(unreadable(what))
}

fn is_frame(sides: [usize; 2]) -> bool {
    sides.iter().all(|side| (1..=GREATEST_SIDE).contains(side))
}

/// # Errors
/// The part is deep, subsampled or compressed with loss.
fn check_stored(header: &Header, channel: usize) -> Result<(), GbufferFault> {
    let fault = |found: &str, allowed: &str| {
        let (channel, found) = (CHANNELS[channel].0, Foreign(found));
        Err(GbufferFault(format!(
            "the part with channel `{channel}` has {found}; {allowed}"
        )))
    };
    if header.deep {
        return fault("deep pixels", "flat ones are read");
    }
    match header.compression {
        Compression::Uncompressed
        | Compression::RLE
        | Compression::ZIP1
        | Compression::ZIP16
        | Compression::PIZ => {}
        other => {
            let allowed = "lossless ones are read: none, RLE, ZIPS, ZIP and PIZ, since others change ids and cosines";
            return fault(&other.to_string(), allowed);
        }
    }
    let mut sampled = header.channels.list.iter().map(|one| one.sampling);
    if sampled.any(|sampling| sampling != Vec2(1, 1)) {
        let found = "a channel with fewer samples than pixels";
        return fault(found, "every pixel needs its sample");
    }
    Ok(())
}

/// The samples of one channel, as they are stored.
enum Samples {
    Half(Vec<f16>),
    Float(Vec<f32>),
    Uint(Vec<u32>),
    /// One value everywhere: the file lacks the channel.
    Same(f64),
}

/// The wanted channels.
pub struct Planes([Samples; CHANNELS.len()]);

impl Planes {
    /// The sample of a channel at a place.
    pub fn value(&self, channel: usize, place: usize) -> f64 {
        match &self.0[channel] {
            Samples::Half(all) => all[place].to_f64(),
            Samples::Float(all) => f64::from(all[place]),
            Samples::Uint(all) => f64::from(all[place]),
            Samples::Same(value) => *value,
        }
    }
}

/// Reads the wanted channels.
///
/// # Errors
/// The pixels are truncated or broken.
pub fn planes(
    reader: Opened<'_>,
    places: &Places,
    [width, height]: [usize; 2],
) -> Result<Planes, GbufferFault> {
    let parts = reader.headers();
    let empty = |channel: usize| match places.0[channel] {
        None => Samples::Same(CHANNELS[channel].1.unwrap_or(0.0)),
        Some((part, at)) => match parts[part].channels.list[at].sample_type {
            SampleType::F16 => Samples::Half(vec![f16::ZERO; width * height]),
            SampleType::F32 => Samples::Float(vec![0.0; width * height]),
            SampleType::U32 => Samples::Uint(vec![0; width * height]),
        },
    };
    let mut planes = Planes(std::array::from_fn(empty));
    let mut chunks = reader.all_chunks(false).map_err(unreadable)?;
    let headers = chunks.meta_data().headers.clone();
    let mut seen = BTreeSet::new();
    while let Some(chunk) = chunks.next() {
        let chunk = chunk.map_err(unreadable)?;
        let part = chunk.layer_index;
        if places.first_of(part).is_none() {
            continue;
        }
        let block = UncompressedBlock::decompress_chunk(chunk, chunks.meta_data(), false)
            .map_err(unreadable)?;
        let (level, position) = (block.index.level, block.index.pixel_position);
        seen.insert((part, [level.0, level.1], [position.0, position.1]));
        if level == Vec2(0, 0) {
            planes.enter(&block, &headers[part], places, width)?;
        }
    }
    for (part, header) in headers.iter().enumerate() {
        let blocks = seen.iter().filter(|(its, ..)| *its == part).count();
        if places.first_of(part).is_some() && blocks != header.chunk_count {
            let (part, wanted) = (part + 1, header.chunk_count);
            let what = format!("part {part} has {blocks} of its {wanted} blocks of pixels");
            return Err(unreadable(what));
        }
    }
    Ok(planes)
}

impl Planes {
    /// Stores the wanted samples of a block.
    fn enter(
        &mut self,
        block: &UncompressedBlock,
        header: &Header,
        places: &Places,
        width: usize,
    ) -> Result<(), GbufferFault> {
        for line in block.lines(&header.channels) {
            let wanted = Some((block.index.layer, line.location.channel));
            let Some(channel) = places.0.iter().position(|place| *place == wanted) else {
                continue;
            };
            let Vec2(x, y) = line.location.position;
            let first = y * width + x;
            let range = first..first + line.location.sample_count;
            if self.0[channel].enter(range, line.value).is_none() {
                let what = format!("a block of pixels at ({x}, {y}) lies outside of the frame");
                return Err(unreadable(what));
            }
        }
        Ok(())
    }
}

impl Samples {
    /// Stores samples in native byte order; `None` where they do not fit.
    fn enter(&mut self, range: Range<usize>, bytes: &[u8]) -> Option<()> {
        fn copy<T, const N: usize>(into: &mut [T], bytes: &[u8], number: fn([u8; N]) -> T) {
            let (numbers, _) = bytes.as_chunks::<N>();
            for (sample, bytes) in into.iter_mut().zip(numbers) {
                *sample = number(*bytes);
            }
        }
        match self {
            Samples::Half(all) => copy(all.get_mut(range)?, bytes, f16::from_ne_bytes),
            Samples::Float(all) => copy(all.get_mut(range)?, bytes, f32::from_ne_bytes),
            Samples::Uint(all) => copy(all.get_mut(range)?, bytes, u32::from_ne_bytes),
            Samples::Same(_) => {}
        }
        Some(())
    }
}
