//! The contents of accessors: numbers in buffers, strided, with single elements replaced where an accessor is sparse.

use std::borrow::Cow;

use glam::DVec3;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root, buffer};

use super::super::scene_file::ReadFile;
use super::container::{Container, Place, embedded, path_of};
use crate::lab::raster::MOST_TRIANGLES;

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

/// Elements in a buffer, each of `size` bytes.
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Strided<'a> {
    fn elements(&self) -> impl Iterator<Item = &'a [u8]> + '_ {
        (0..self.count).map(|i| &self.bytes[i * self.stride..][..self.size])
    }
}

impl<'a> Buffers<'a> {
    /// The bytes of all buffers. Each has at least as many as the file announces.
    pub fn read(
        root: &'a Root,
        container: &Container<'a>,
        read: ReadFile,
    ) -> Result<Buffers<'a>, Place> {
        let mut bytes: Vec<Cow<[u8]>> = Vec::new();
        let mut total = 0;
        for (i, buffer) in root.buffers.iter().enumerate() {
            let fault = |what: String| Place::new(format!("buffers[{i}].uri"), what);
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
                return Err(Place::new(format!("buffers[{i}].byteLength"), what));
            }
            total += found.len();
            if total > MOST_BYTES {
                let what = format!("the buffers up to here have more than {MOST_BYTES} bytes");
                return Err(Place::new(format!("buffers[{i}]"), what));
            }
            bytes.push(found);
        }
        Ok(Buffers { root, bytes })
    }

    /// Vectors of three floats.
    pub fn vectors(&self, index: Index<Accessor>, place: &str) -> Result<Vec<DVec3>, Place> {
        let accessor = &self.root.accessors[index.value()];
        self.check(accessor, Type::Vec3, &[ComponentType::F32], index, place)?;
        let mut all: Vec<DVec3> = match self.base(accessor, 12, place)? {
            Some(elements) => elements.elements().map(vector).collect(),
            None => vec![DVec3::ZERO; count(accessor, place)?],
        };
        self.replace(accessor, 12, place, &mut |at, bytes| {
            all[at] = vector(bytes)
        })?;
        match all.iter().position(|vector| !vector.is_finite()) {
            Some(at) => Err(Place::new(place, format!("element {at} is not finite"))),
            None => Ok(all),
        }
    }

    /// Colours of three or four channels in [0, 1]; a missing fourth is 1. The specification wants floats clamped (section
    /// 3.7.2.1).
    pub fn colours(&self, index: Index<Accessor>, place: &str) -> Result<Vec<[f32; 4]>, Place> {
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
            return Err(Place::new(place, what));
        }
        let channels = if kind == Type::Vec4 { 4 } else { 3 };
        let size = channels * component.size();
        let colour = |bytes: &[u8]| colour(bytes, component);
        let mut all: Vec<[f32; 4]> = match self.base(accessor, size, place)? {
            Some(elements) => elements.elements().map(colour).collect(),
            None => vec![colour(&vec![0; size]); count(accessor, place)?],
        };
        self.replace(accessor, size, place, &mut |at, bytes| {
            all[at] = colour(bytes)
        })?;
        if all.iter().flatten().any(|channel| channel.is_nan()) {
            Err(Place::new(place, "a colour is no number"))
        } else {
            Ok(all)
        }
    }

    /// Indices of corners.
    pub fn indices(&self, index: Index<Accessor>, place: &str) -> Result<Vec<u32>, Place> {
        let accessor = &self.root.accessors[index.value()];
        let kinds = [ComponentType::U8, ComponentType::U16, ComponentType::U32];
        let component = self.check(accessor, Type::Scalar, &kinds, index, place)?;
        let size = component.size();
        let mut all: Vec<u32> = match self.base(accessor, size, place)? {
            Some(elements) => elements.elements().map(whole).collect(),
            None => vec![0; count(accessor, place)?],
        };
        self.replace(accessor, size, place, &mut |at, bytes| {
            all[at] = whole(bytes)
        })?;
        Ok(all)
    }

    /// How many elements an accessor announces.
    pub fn count(&self, index: Index<Accessor>, place: &str) -> Result<usize, Place> {
        count(&self.root.accessors[index.value()], place)
    }

    fn check(
        &self,
        accessor: &Accessor,
        wanted: Type,
        allowed: &[ComponentType],
        index: Index<Accessor>,
        place: &str,
    ) -> Result<ComponentType, Place> {
        let fault = || {
            let what = format!(
                "accessors[{}] has another type: {wanted:?} of {allowed:?} is read",
                index.value()
            );
            Place::new(place, what)
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

    /// The elements in the accessor's buffer; `None` where it has no buffer.
    fn base(
        &self,
        accessor: &Accessor,
        size: usize,
        place: &str,
    ) -> Result<Option<Strided<'_>>, Place> {
        let count = count(accessor, place)?;
        let Some(view) = accessor.buffer_view else {
            return Ok(None);
        };
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        self.strided(view, offset, [count, size], place).map(Some)
    }

    /// Passes on the elements that a sparse accessor replaces.
    fn replace(
        &self,
        accessor: &Accessor,
        size: usize,
        place: &str,
        enter: &mut dyn FnMut(usize, &[u8]),
    ) -> Result<(), Place> {
        let Some(sparse) = &accessor.sparse else {
            return Ok(());
        };
        let all = count(accessor, place)?;
        let replaced = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
        if replaced > all {
            let what = format!("it replaces {replaced} of {all} elements");
            return Err(Place::new(place, what));
        }
        let kind = match sparse.indices.component_type {
            Checked::Valid(kind) => kind.0.size(),
            Checked::Invalid => return Err(Place::new(place, "its sparse indices have no type")),
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
        for (at, value) in at.elements().map(whole).zip(values.elements()) {
            if last.is_some_and(|last| last >= at) {
                return Err(Place::new(place, "its sparse indices do not increase"));
            }
            last = Some(at);
            if at as usize >= all {
                let what = format!("it replaces element {at} of {all}");
                return Err(Place::new(place, what));
            }
            enter(at as usize, value);
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
    ) -> Result<Strided<'_>, Place> {
        let index = view.value();
        let view = &self.root.buffer_views[index];
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            let what = format!("elements of {size} bytes, {stride} apart");
            return Err(Place::new(format!("bufferViews[{index}].byteStride"), what));
        }
        let bytes = &self.bytes[view.buffer.value()];
        let from = view.byte_offset.map_or(0, |offset| offset.0);
        let part = part(bytes, from, view.byte_length.0);
        let part = part.ok_or_else(|| {
            let what = format!("it leaves its buffer, which has {} bytes", bytes.len());
            Place::new(format!("bufferViews[{index}]"), what)
        })?;
        let needed = match count {
            0 => Some(0),
            _ => (count - 1)
                .checked_mul(stride)
                .and_then(|all| all.checked_add(size)),
        };
        let length = (part.len() as u64).saturating_sub(offset);
        let fits = needed.is_some_and(|needed| needed as u64 <= length);
        let bytes = super::accessor::part(part, offset, length).filter(|_| fits);
        let bytes = bytes.ok_or_else(|| {
            let what = format!(
                "{count} elements do not fit into bufferViews[{index}], which has {} bytes",
                part.len()
            );
            Place::new(place, what)
        })?;
        Ok(Strided {
            bytes,
            stride,
            size,
            count,
        })
    }
}

/// A range of bytes, if it lies within them.
fn part(bytes: &[u8], from: u64, length: u64) -> Option<&[u8]> {
    let end = from.checked_add(length)?;
    bytes.get(usize::try_from(from).ok()?..usize::try_from(end).ok()?)
}

/// The number of elements, checked against the limit.
fn count(accessor: &Accessor, place: &str) -> Result<usize, Place> {
    let most = match accessor.buffer_view {
        Some(_) => MOST_ELEMENTS,
        None => MOST_ZEROS,
    };
    let count = accessor.count.0;
    if count <= most as u64 {
        Ok(count as usize)
    } else {
        Err(Place::new(
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
