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
    pub fn of(bytes: &'a [u8]) -> Result<Container<'a>, Place> {
        if !bytes.starts_with(MAGIC) {
            return Ok(Container {
                json: bytes,
                binary: None,
            });
        }
        if number(bytes, 4) != Some(2) {
            return Err(Place::new("byte 4", "no GLB of version 2"));
        }
        let length = number(bytes, 8).unwrap_or(0) as usize;
        let Some(bytes) = bytes.get(..length) else {
            let what = format!("the GLB says {length} bytes and has {}", bytes.len());
            return Err(Place::new("byte 8", what));
        };
        let json = chunk(bytes, 12, JSON)?;
        let Some(json) = json else {
            return Err(Place::new("byte 12", "the first chunk of a GLB is JSON"));
        };
        let next = 20 + json.len();
        let has_more = bytes.len() > next;
        let binary = if has_more {
            chunk(bytes, next, BINARY)?
        } else {
            None
        };
        Ok(Container {
            json: without_padding(json),
            binary,
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
fn chunk<'a>(bytes: &'a [u8], at: usize, kind: &[u8]) -> Result<Option<&'a [u8]>, Place> {
    let ends = || Place::new(format!("byte {at}"), "the GLB ends within a chunk");
    let length = number(bytes, at).ok_or_else(ends)? as usize;
    let found = bytes.get(at + 4..at + 8).ok_or_else(ends)?;
    let from = at + 8;
    let whole = from
        .checked_add(length)
        .and_then(|end| bytes.get(from..end));
    let whole = whole.ok_or_else(ends)?;
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
    let is_elsewhere = uri.starts_with(['/', '\\']) || uri.contains(':');
    if is_elsewhere || uri.is_empty() {
        return Err("a buffer is in a file below the glTF file's folder, or embedded".to_owned());
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
    let leaves = path.contains('\0')
        || path.starts_with(['/', '\\'])
        || path.split(['/', '\\']).any(|part| part == "..");
    if leaves || path.contains(':') {
        Err("a buffer is in a file below the glTF file's folder, or embedded".to_owned())
    } else {
        Ok(path)
    }
}

/// A fault of a glTF file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {}: {}", Foreign(file), Foreign(place), one_line(what))]
pub struct GltfFault {
    /// The file, as the user named it.
    pub file: String,
    /// The place in its JSON, such as `meshes[2].primitives[0].attributes.POSITION`, or in its bytes.
    pub place: String,
    /// What was found, and what is allowed.
    pub what: String,
}

/// A fault before the file's name is known.
#[derive(Debug)]
pub struct Place {
    place: String,
    what: String,
}

impl Place {
    pub fn new(place: impl Into<String>, what: impl Into<String>) -> Place {
        Place {
            place: place.into(),
            what: what.into(),
        }
    }

    pub fn fault(self, file: &str) -> GltfFault {
        GltfFault {
            file: file.to_owned(),
            place: self.place,
            what: self.what,
        }
    }
}
