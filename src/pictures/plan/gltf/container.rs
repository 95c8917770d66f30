//! The two containers of a glTF file: JSON, or GLB, which holds JSON and one buffer as chunks (section 4.4 of the specification).
//! Also the faults of a glTF file, with their place in its JSON.

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use crate::physics::foreign::{Foreign, one_line};

const MAGIC: &[u8] = b"glTF";
const JSON: &[u8] = b"JSON";
const BINARY: &[u8] = b"BIN\0";

/// The parts of a file.
pub struct Container<'a> {
    pub json: &'a [u8],
    /// The buffer of a GLB.
    pub binary: Option<&'a [u8]>,
}

impl<'a> Container<'a> {
    pub fn of(bytes: &'a [u8]) -> Result<Container<'a>, GltfFault> {
        if !bytes.starts_with(MAGIC) {
            return Ok(Container {
                json: bytes,
                binary: None,
            });
        }
        if number(bytes, 4) != Some(2) {
            return Err(GltfFault::new("byte 4", "no GLB of version 2"));
        }
        let length = number(bytes, 8).unwrap_or(0) as usize;
        let Some(bytes) = bytes.get(..length) else {
            let what = format!("the GLB says {length} bytes and has {}", bytes.len());
            return Err(GltfFault::new("byte 8", what));
        };
        let Some(json) = chunk(bytes, 12, JSON)? else {
            return Err(GltfFault::new(
                "byte 12",
                "the first chunk of a GLB is JSON",
            ));
        };
        let next = 20 + json.len();
        Ok(Container {
            json: without_padding(json),
            binary: if bytes.len() > next {
                chunk(bytes, next, BINARY)?
            } else {
                None
            },
        })
    }
}

/// The JSON of a chunk without the NUL padding that some writers append. The specification wants spaces, which JSON ignores.
fn without_padding(json: &[u8]) -> &[u8] {
    let end = json.iter().rposition(|byte| *byte != 0);
    &json[..end.map_or(0, |end| end + 1)]
}

fn number(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at.checked_add(4)?)?;
    bytes.try_into().ok().map(u32::from_le_bytes)
}

/// The chunk that begins here, if it is of this kind.
fn chunk<'a>(bytes: &'a [u8], at: usize, kind: &[u8]) -> Result<Option<&'a [u8]>, GltfFault> {
    let ends = || GltfFault::new(format!("byte {at}"), "the GLB ends within a chunk");
    let length = number(bytes, at).ok_or_else(ends)? as usize;
    let found = bytes.get(at + 4..at + 8).ok_or_else(ends)?;
    let from = at + 8;
    let end = from.checked_add(length).ok_or_else(ends)?;
    let whole = bytes.get(from..end).ok_or_else(ends)?;
    Ok((found == kind).then_some(whole))
}

/// The bytes of a `data:` URI; `None` for any other URI.
pub fn embedded(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let rest = uri.strip_prefix("data:")?;
    let Some((_, data)) = rest.split_once(";base64,") else {
        return Some(Err("the data of a URI must be base64".to_owned()));
    };
    let lenient =
        GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    let decoded = GeneralPurpose::new(&STANDARD, lenient).decode(data);
    Some(decoded.map_err(|error| format!("no base64: {error}")))
}

/// The path that a relative URI means, with `%20` and the like decoded.
pub fn path_of(uri: &str) -> Result<String, String> {
    const ELSEWHERE: &str = "a buffer is in a file below the glTF file's folder, or embedded";
    if uri.starts_with(['/', '\\']) || uri.contains(':') || uri.is_empty() {
        return Err(ELSEWHERE.to_owned());
    }
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        let hex = after.get(..2).and_then(|hex| std::str::from_utf8(hex).ok());
        let decoded = hex.and_then(|hex| u8::from_str_radix(hex, 16).ok());
        match (first, decoded) {
            (b'%', Some(byte)) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    let path = String::from_utf8(bytes).map_err(|_| "the path is not UTF-8".to_owned())?;
    let leaves = path.contains(['\0', ':'])
        || path.starts_with(['/', '\\'])
        || path.split(['/', '\\']).any(|part| part == "..");
    if leaves {
        Err(ELSEWHERE.to_owned())
    } else {
        Ok(path)
    }
}

/// A fault of a glTF file. The caller puts the file's name before it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {}", Foreign(place), one_line(what))]
pub struct GltfFault {
    /// The place in its JSON, such as `meshes[2].primitives[0].attributes.POSITION`, or in its bytes.
    pub place: String,
    /// What was found, and what is allowed.
    pub what: String,
}

impl GltfFault {
    pub(super) fn new(place: impl Into<String>, what: impl Into<String>) -> GltfFault {
        GltfFault {
            place: place.into(),
            what: what.into(),
        }
    }
}
