//! KTX 2.0: RGBA of binary16, or of binary32 where that is the picture's depth; one level, no supercompression.
//!
//! Source: Khronos, *KTX File Format Specification, version 2.0*, 2021,
//! <https://registry.khronos.org/KTX/specs/2.0/ktxspec.v2.html>; the data format descriptor by Khronos, *Data Format
//! Specification 1.3*, 2019, <https://registry.khronos.org/DataFormat/specs/1.3/dataformat.1.3.html>. GPUs have no three-channel
//! format of 16 bits that all can filter, so alpha is 1. The transfer function is linear and the orientation `rd`: the first row
//! is the top one.

use super::picture::Picture;
use super::texel::Depth;
use crate::physics::spectra::Space;

const IDENTIFIER: [u8; 12] = [
    0xAB, b'K', b'T', b'X', b' ', b'2', b'0', 0xBB, b'\r', b'\n', 0x1A, b'\n',
];
/// How a file begins, and the mark of this program in its head.
pub const KTX2_MARK: (&[u8], &[u8]) = (b"\xABKTX 20", b"KTXwriter\0fresnel-gen\0");

/// The number type of a file's channels: the number of Vulkan's format with four such channels, and the bytes of one.
type Channel = (u32, usize);

/// VK_FORMAT_R16G16B16A16_SFLOAT.
const HALF: Channel = (97, 2);
/// VK_FORMAT_R32G32B32A32_SFLOAT.
const FLOAT: Channel = (109, 4);

/// Where the header with its index and the one entry of the level index end: 12 + 9·4 + 4·4 + 2·8, and 3·8.
const HEADER: u32 = 80 + 24;
/// Bytes of the descriptor: its length, the basic block's head of six words, and four samples of four.
const DESCRIPTOR: u32 = 4 * (1 + 6 + 4 * 4);

/// The file. Its numbers are binary32 if the picture's are, otherwise binary16.
pub fn ktx2(picture: &Picture) -> Vec<u8> {
    let channel = match picture.depth {
        Depth::Float => FLOAT,
        Depth::Half | Depth::Unorm8 | Depth::Unorm16 => HALF,
    };
    let pairs = key_values();
    let before = HEADER as usize + DESCRIPTOR as usize + pairs.len();
    // The level's first byte lies at a multiple of a texel's bytes.
    let start = before.next_multiple_of(4 * channel.1);
    let data = level(picture);
    let mut bytes = IDENTIFIER.to_vec();
    for word in head(picture, channel, pairs.len() as u32) {
        bytes.extend(word.to_le_bytes());
    }
    // Supercompression data: none. Then the level: offset, length, uncompressed length.
    for word in [0, 0, start, data.len(), data.len()] {
        bytes.extend((word as u64).to_le_bytes());
    }
    for word in descriptor(picture.space, channel) {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(pairs);
    bytes.resize(start, 0);
    bytes.extend(data);
    bytes
}

fn level(picture: &Picture) -> Vec<u8> {
    if picture.depth == Depth::Float {
        let floats = picture.floats().flatten();
        floats.flat_map(f32::to_le_bytes).collect()
    } else {
        let bits = picture.half_bits().flatten();
        bits.flat_map(u16::to_le_bytes).collect()
    }
}

/// The words of the header and of the index up to the supercompression data.
fn head(picture: &Picture, (format, bytes): Channel, pairs: u32) -> [u32; 13] {
    let (depth, layers, faces, levels, supercompression) = (0, 0, 1, 1, 0);
    [
        format,
        bytes as u32,
        picture.width as u32,
        picture.height() as u32,
        depth,
        layers,
        faces,
        levels,
        supercompression,
        HEADER,
        DESCRIPTOR,
        HEADER + DESCRIPTOR,
        pairs,
    ]
}

/// The data format descriptor: one basic block.
fn descriptor(space: Option<Space>, (_, bytes): Channel) -> Vec<u32> {
    const VERSION: u32 = 2;
    const RGBSDA: u32 = 1;
    const LINEAR: u32 = 1;
    const SIGNED_FLOAT: u32 = 0xC0;
    let mut words = vec![
        DESCRIPTOR,
        0,
        VERSION | ((DESCRIPTOR - 4) << 16),
        RGBSDA | (primaries(space) << 8) | (LINEAR << 16),
        0,
        4 * bytes as u32,
        0,
    ];
    let bits = 8 * bytes as u32;
    for (i, name) in [0, 1, 2, 15].into_iter().enumerate() {
        words.push((bits * i as u32) | ((bits - 1) << 16) | ((name | SIGNED_FLOAT) << 24));
        words.extend([0, (-1f32).to_bits(), 1f32.to_bits()]);
    }
    words
}

/// The specification's number of the primaries; 0 where channels are single wavelengths.
fn primaries(space: Option<Space>) -> u32 {
    match space {
        None => 0,
        Some(Space::Srgb) => 1,
        Some(Space::Rec2020) => 4,
        Some(Space::AcesCg) => 6,
        Some(Space::DisplayP3) => 10,
    }
}

/// Keys and values, sorted, each padded to four bytes.
fn key_values() -> Vec<u8> {
    let mut bytes = Vec::new();
    for (key, value) in [("KTXorientation", "rd"), ("KTXwriter", "fresnel-gen")] {
        let pair = format!("{key}\0{value}\0");
        bytes.extend((pair.len() as u32).to_le_bytes());
        bytes.extend(pair.as_bytes());
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}
