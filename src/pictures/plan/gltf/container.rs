//! The two containers of a glTF file: JSON, or GLB, which holds JSON and one buffer as chunks (section 4.4 of the specification).
//! Also the faults of a glTF file, with their place in its JSON, and the contents of accessors: numbers in buffers, strided, with
//! single elements replaced where an accessor is sparse.

use std::borrow::Cow;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use glam::DVec3;
use gltf_json::accessor::sparse::Sparse;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root, buffer};

use crate::lab::raster::MOST_TRIANGLES;
use crate::physics::foreign::{Foreign, one_line};
use crate::pictures::plan::frame::ReadFile;

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
fn path_of(uri: &str) -> Result<String, String> {
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

/// The most elements of an accessor: three corners for each triangle.
pub const MOST_ELEMENTS: usize = 3 * MOST_TRIANGLES;
/// The most elements of an accessor without a buffer, whose elements are 0 except those that it replaces.
const MOST_ZEROS: usize = 1 << 20;

/// The most bytes of all buffers together. Several buffers may name one file.
const MOST_BYTES: usize = 1 << 30;

/// All buffers of a file.
pub struct Buffers<'a> {
    root: &'a Root,
    bytes: Vec<Cow<'a, [u8]>>,
}

impl<'a> Buffers<'a> {
    /// The bytes of all buffers. Each has at least as many as the file announces.
    pub fn read(
        root: &'a Root,
        container: &Container<'a>,
        read: ReadFile,
    ) -> Result<Buffers<'a>, GltfFault> {
        let mut bytes: Vec<Cow<[u8]>> = Vec::new();
        let mut total = 0;
        for (i, buffer) in root.buffers.iter().enumerate() {
            let fault = |what: String| GltfFault::new(format!("buffers[{i}].uri"), what);
            let found: Cow<[u8]> = match (&buffer.uri, container.binary) {
                (Some(uri), _) => Cow::Owned(match embedded(uri) {
                    Some(data) => data.map_err(fault)?,
                    None => {
                        let path = path_of(uri).map_err(fault)?;
                        read(&path).map_err(|why| fault(format!("{path}: {why}")))?
                    }
                }),
                (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
                (None, _) => {
                    return Err(fault(
                        "it is missing, and no chunk of a GLB stands for it".to_owned(),
                    ));
                }
            };
            let length = buffer.byte_length.0;
            if length > found.len() as u64 {
                let what = format!("it says {length} bytes and has {}", found.len());
                return Err(GltfFault::new(format!("buffers[{i}].byteLength"), what));
            }
            total += found.len();
            if total > MOST_BYTES {
                let what = format!("the buffers up to here have more than {MOST_BYTES} bytes");
                return Err(GltfFault::new(format!("buffers[{i}]"), what));
            }
            bytes.push(found);
        }
        Ok(Buffers { root, bytes })
    }

    /// Vectors of three floats.
    pub fn vectors(&self, index: Index<Accessor>, place: &str) -> Result<Vec<DVec3>, GltfFault> {
        let accessor = &self.root.accessors[index.value()];
        self.check(accessor, Type::Vec3, &[ComponentType::F32], index, place)?;
        let all = self.elements(accessor, 12, place, vector)?;
        match all.iter().position(|vector| !vector.is_finite()) {
            Some(at) => Err(GltfFault::new(place, format!("element {at} is not finite"))),
            None => Ok(all),
        }
    }

    /// Colours of three or four channels in [0, 1]; a missing fourth is 1. The specification wants floats clamped (section
    /// 3.7.2.1).
    pub fn colours(&self, index: Index<Accessor>, place: &str) -> Result<Vec<[f32; 4]>, GltfFault> {
        let accessor = &self.root.accessors[index.value()];
        let kinds = [ComponentType::F32, ComponentType::U8, ComponentType::U16];
        let kind = match accessor.type_ {
            Checked::Valid(Type::Vec4) => Type::Vec4,
            _ => Type::Vec3,
        };
        let component = self.check(accessor, kind, &kinds, index, place)?;
        if component != ComponentType::F32 && !accessor.normalized {
            let what = format!(
                "accessors[{}] has whole numbers that are not normalized",
                index.value()
            );
            return Err(GltfFault::new(place, what));
        }
        let channels = if kind == Type::Vec4 { 4 } else { 3 };
        let size = channels * component.size();
        let all = self.elements(accessor, size, place, |bytes| colour(bytes, component))?;
        if all.iter().flatten().any(|channel| channel.is_nan()) {
            Err(GltfFault::new(place, "a colour is no number"))
        } else {
            Ok(all)
        }
    }

    /// Indices of corners.
    pub fn indices(&self, index: Index<Accessor>, place: &str) -> Result<Vec<u32>, GltfFault> {
        let accessor = &self.root.accessors[index.value()];
        let kinds = [ComponentType::U8, ComponentType::U16, ComponentType::U32];
        let component = self.check(accessor, Type::Scalar, &kinds, index, place)?;
        self.elements(accessor, component.size(), place, whole)
    }

    /// How many elements an accessor announces.
    pub fn count(&self, index: Index<Accessor>, place: &str) -> Result<usize, GltfFault> {
        count(&self.root.accessors[index.value()], place)
    }

    fn check(
        &self,
        accessor: &Accessor,
        wanted: Type,
        allowed: &[ComponentType],
        index: Index<Accessor>,
        place: &str,
    ) -> Result<ComponentType, GltfFault> {
        let fault = || {
            let what = format!(
                "accessors[{}] has another type: {wanted:?} of {allowed:?} is read",
                index.value()
            );
            GltfFault::new(place, what)
        };
        let component = match accessor.component_type {
            Checked::Valid(component) => component.0,
            Checked::Invalid => return Err(fault()),
        };
        let is_wanted = matches!(accessor.type_, Checked::Valid(kind) if kind == wanted);
        if is_wanted && allowed.contains(&component) {
            Ok(component)
        } else {
            Err(fault())
        }
    }

    /// The elements of an accessor, each of `size` bytes: those in its buffer, or zeros where it has none, some of them replaced
    /// where it is sparse.
    fn elements<T: Clone>(
        &self,
        accessor: &Accessor,
        size: usize,
        place: &str,
        element: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, GltfFault> {
        let count = count(accessor, place)?;
        let mut all: Vec<T> = match accessor.buffer_view {
            None => vec![element(&vec![0; size]); count],
            Some(view) => {
                let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
                let elements = self.strided(view, offset, [count, size], place)?;
                elements.map(&element).collect()
            }
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace(sparse, size, place, &mut all, element)?;
        }
        Ok(all)
    }

    /// Replaces the elements that a sparse accessor states.
    fn replace<T>(
        &self,
        sparse: &Sparse,
        size: usize,
        place: &str,
        all: &mut [T],
        element: impl Fn(&[u8]) -> T,
    ) -> Result<(), GltfFault> {
        let count = all.len();
        let replaced = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
        if replaced > count {
            let what = format!("it replaces {replaced} of {count} elements");
            return Err(GltfFault::new(place, what));
        }
        let kind = match sparse.indices.component_type {
            Checked::Valid(kind) => kind.0.size(),
            Checked::Invalid => {
                return Err(GltfFault::new(place, "its sparse indices have no type"));
            }
        };
        let (indices, values) = (&sparse.indices, &sparse.values);
        let at = self.strided(
            indices.buffer_view,
            indices.byte_offset.0,
            [replaced, kind],
            place,
        )?;
        let values = self.strided(
            values.buffer_view,
            values.byte_offset.0,
            [replaced, size],
            place,
        )?;
        let mut last = None;
        for (at, value) in at.map(whole).zip(values) {
            if last.is_some_and(|last| last >= at) {
                return Err(GltfFault::new(place, "its sparse indices do not increase"));
            }
            last = Some(at);
            let Some(replaced) = all.get_mut(at as usize) else {
                let what = format!("it replaces element {at} of {count}");
                return Err(GltfFault::new(place, what));
            };
            *replaced = element(value);
        }
        Ok(())
    }

    /// Elements of a view, given their number and their size in bytes, checked to lie in the view and in its buffer.
    fn strided(
        &self,
        view: Index<buffer::View>,
        offset: u64,
        [count, size]: [usize; 2],
        place: &str,
    ) -> Result<impl Iterator<Item = &[u8]>, GltfFault> {
        let index = view.value();
        let view = &self.root.buffer_views[index];
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            let what = format!("elements of {size} bytes, {stride} apart");
            return Err(GltfFault::new(
                format!("bufferViews[{index}].byteStride"),
                what,
            ));
        }
        let bytes = &self.bytes[view.buffer.value()];
        let from = view.byte_offset.map_or(0, |offset| offset.0);
        let of_view = part(bytes, from, view.byte_length.0).ok_or_else(|| {
            let what = format!("it leaves its buffer, which has {} bytes", bytes.len());
            GltfFault::new(format!("bufferViews[{index}]"), what)
        })?;
        let needed = match count {
            0 => Some(0),
            _ => (count - 1)
                .checked_mul(stride)
                .and_then(|all| all.checked_add(size)),
        };
        let elements = needed.and_then(|needed| part(of_view, offset, needed as u64));
        let elements = elements.ok_or_else(|| {
            let what = format!(
                "{count} elements do not fit into bufferViews[{index}], which has {} bytes",
                of_view.len()
            );
            GltfFault::new(place, what)
        })?;
        Ok((0..count).map(move |i| &elements[i * stride..][..size]))
    }
}

/// A range of bytes, if it lies within them.
fn part(bytes: &[u8], from: u64, length: u64) -> Option<&[u8]> {
    let end = from.checked_add(length)?;
    bytes.get(usize::try_from(from).ok()?..usize::try_from(end).ok()?)
}

/// The number of elements, checked against the limit.
fn count(accessor: &Accessor, place: &str) -> Result<usize, GltfFault> {
    let most = match accessor.buffer_view {
        Some(_) => MOST_ELEMENTS,
        None => MOST_ZEROS,
    };
    let count = accessor.count.0;
    if count <= most as u64 {
        Ok(count as usize)
    } else {
        Err(GltfFault::new(
            place,
            format!("it has {count} elements; at most {most} are read"),
        ))
    }
}

fn vector(bytes: &[u8]) -> DVec3 {
    let float = |i: usize| {
        let four: [u8; 4] = bytes[4 * i..][..4].try_into().expect("four bytes");
        f64::from(f32::from_le_bytes(four))
    };
    DVec3::new(float(0), float(1), float(2))
}

fn colour(bytes: &[u8], component: ComponentType) -> [f32; 4] {
    let channel = |bytes: &[u8]| match component {
        ComponentType::F32 => {
            f32::from_le_bytes(bytes.try_into().expect("four bytes")).clamp(0.0, 1.0)
        }
        ComponentType::U8 => f32::from(bytes[0]) / 255.0,
        _ => whole(bytes) as f32 / 65535.0,
    };
    let mut colour = [1.0; 4];
    for (to, from) in colour.iter_mut().zip(bytes.chunks_exact(component.size())) {
        *to = channel(from);
    }
    colour
}

/// An unsigned integer of one, two or four bytes.
fn whole(bytes: &[u8]) -> u32 {
    let mut four = [0; 4];
    four[..bytes.len()].copy_from_slice(bytes);
    u32::from_le_bytes(four)
}
