//! Textures and meshes as text: little-endian numbers, deflated, in base64.

use std::borrow::Cow;
use std::collections::BTreeMap;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use half::f16;
use serde::Serialize;

use crate::pictures::scene::{
    Body, Relief, RenderRow, Slot, Texels, Vertex, room_cube, sky, vertex_numbers,
};

/// Bytes as a page holds them.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Packed(String);

impl Packed {
    /// Deflates bytes.
    pub fn new(bytes: &[u8]) -> Packed {
        let deflated = miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL);
        Packed(BASE64_STANDARD.encode(deflated))
    }

    /// Deflates numbers.
    pub fn floats(numbers: &[f32]) -> Packed {
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        Packed::new(&bytes)
    }
}

/// The encoder's level of compression. Level 9 makes the page a hundredth smaller, for three times the time.
const LEVEL: u8 = 6;

/// A texture of the page.
#[derive(Clone, Debug, Serialize)]
pub struct PackedTexture {
    /// Its name.
    pub name: String,
    /// Width, height and layers; six layers are a cube map.
    pub size: [usize; 3],
    /// The format by its name in WebGPU.
    pub format: &'static str,
    /// Its texels, each byte less the one in the row above.
    pub texels: Packed,
}

/// The sky's name among textures.
pub const SKY: &str = "Sky";
/// Texels along a side of the room's cube map: fewer than in pictures, since every reader downloads them.
pub const CUBE: usize = 512;
/// The greatest width of a body's tables after reduction: for colours, and for others, which deflate badly.
const WIDEST: [usize; 2] = [512, 320];

/// The sky as a texture.
pub fn sky_texture() -> PackedTexture {
    texture(SKY.to_owned(), &sky().table)
}

/// A texture that rows read, before it is packed. Several rows read the same one.
pub enum TextureSource {
    /// The room around a body.
    Room,
    /// Dents of this slope.
    Dents(f64),
    /// A table of a body.
    Table(Body, Slot, &'static Texels),
}

/// The textures that a row reads besides what it draws, by slot.
pub fn textures_of(row: &RenderRow) -> BTreeMap<Slot, TextureSource> {
    let mut all = BTreeMap::new();
    if row.in_room {
        all.insert(Slot::Room, TextureSource::Room);
    }
    if let Some(slope) = row.dents {
        all.insert(Slot::Relief, TextureSource::Dents(slope));
    }
    for (slot, table) in row.body.tables() {
        all.insert(slot, TextureSource::Table(row.body, slot, table));
    }
    all
}

impl TextureSource {
    /// Its name, which no other texture has.
    pub fn name(&self) -> String {
        match self {
            TextureSource::Room => "Room".to_owned(),
            TextureSource::Dents(slope) => format!("dents of {slope}"),
            TextureSource::Table(body, slot, _) => format!("{} {slot:?}", body.name()),
        }
    }

    /// The texture.
    pub fn packed(&self) -> PackedTexture {
        let name = self.name();
        match self {
            TextureSource::Room => halves(name, [CUBE, CUBE, 6], &room_cube(CUBE)),
            TextureSource::Dents(slope) => texture(name, &Relief::hammered(*slope).normals),
            TextureSource::Table(_, _, table) => texture(name, &reduced(table)),
        }
    }
}

/// The tables of a body as the page holds them.
pub fn reduced_tables(body: Body) -> Vec<(Slot, Cow<'static, Texels>)> {
    let tables = body.tables().into_iter();
    tables
        .map(|(slot, table)| (slot, Cow::Owned(reduced(table))))
        .collect()
}

/// A table as the page holds it.
fn reduced(table: &Texels) -> Texels {
    let [colours, others] = WIDEST;
    let widest = if is_opaque(table) { colours } else { others };
    as_stored(&table.reduced(table.size()[0].div_ceil(widest)))
}

/// A table with the precision of the page: colours with a shared exponent, others with few bits.
pub fn as_stored(table: &Texels) -> Texels {
    if !is_opaque(table) {
        return table.mapped(|texel| texel.map(coarse));
    }
    table.mapped(|[r, g, b, _]| {
        let [r, g, b] = from_shared_exponent(shared_exponent([r, g, b]));
        [r, g, b, 1.0]
    })
}

/// Whether a table holds only colours.
fn is_opaque(table: &Texels) -> bool {
    let is_colour = |[r, g, b, a]: &[f32; 4]| *a == 1.0 && r.min(*g).min(*b) >= 0.0;
    table.texels().iter().all(is_colour)
}

/// A number rounded to 7 significant bits. Finer bits deflate badly; dropping them changes a normal's slope by less than a
/// hundredth.
fn coarse(value: f32) -> f32 {
    const DROPPED: u32 = 23 - 6;
    let half = 1 << (DROPPED - 1);
    f32::from_bits((value.to_bits() + half) >> DROPPED << DROPPED)
}

/// A table as a texture: colours as three numbers of 9 bits with a shared exponent, others as halves.
fn texture(name: String, table: &Texels) -> PackedTexture {
    let [width, height] = table.size();
    let size = [width, height, 1];
    if !is_opaque(table) {
        return halves(name, size, table.texels());
    }
    let colours = table.texels().iter().map(|[r, g, b, _]| [*r, *g, *b]);
    let shared = colours.map(shared_exponent);
    let bytes: Vec<u8> = shared.flat_map(u32::to_le_bytes).collect();
    PackedTexture {
        name,
        size,
        format: "rgb9e5ufloat",
        texels: packed_rows(&bytes, 4 * width),
    }
}

fn halves(name: String, size: [usize; 3], texels: &[[f32; 4]]) -> PackedTexture {
    let numbers = texels.iter().flatten();
    let bytes: Vec<u8> = numbers
        .flat_map(|x| f16::from_f32(*x).to_le_bytes())
        .collect();
    PackedTexture {
        name,
        size,
        format: "rgba16float",
        texels: packed_rows(&bytes, 8 * size[0]),
    }
}

/// Each byte less the one above it. Rows resemble each other, so this deflates well.
fn packed_rows(bytes: &[u8], row: usize) -> Packed {
    let above = |i: usize| i.checked_sub(row).map_or(0, |i| bytes[i]);
    let less: Vec<u8> = (0..bytes.len())
        .map(|i| bytes[i].wrapping_sub(above(i)))
        .collect();
    Packed::new(&less)
}

/// Bits of a number, and the bias of the exponent: OpenGL ES 3.0, section 3.8.3.2.
const BITS: i32 = 9;
const BIAS: i32 = 15;

/// A colour as three numbers of 9 bits with a shared exponent.
fn shared_exponent(texel: [f32; 3]) -> u32 {
    let most = texel.into_iter().fold(0.0_f32, f32::max);
    let exponent = |of: f32| (of.log2().floor() as i32).max(-BIAS - 1) + 1 + BIAS;
    let unit = |exponent: i32| libm::exp2f((exponent - BIAS - BITS) as f32);
    let mut shared = exponent(most);
    if (most / unit(shared)).round() >= 512.0 {
        shared += 1;
    }
    let part = |value: f32| ((value / unit(shared)).round() as u32).min(511);
    let [r, g, b] = texel.map(part);
    r | g << 9 | b << 18 | (shared as u32) << 27
}

fn from_shared_exponent(packed: u32) -> [f32; 3] {
    let unit = libm::exp2f(((packed >> 27) as i32 - BIAS - BITS) as f32);
    [0, 9, 18].map(|at| (packed >> at & 511) as f32 * unit)
}

/// A body of the page.
#[derive(Clone, Debug, Serialize)]
pub struct PackedMesh {
    /// Its name.
    pub name: String,
    /// For a ball of radius 1, the rows from pole to pole; the page makes its vertices.
    pub ball: Option<usize>,
    /// Vertices of triangles, with twelve numbers each.
    pub vertices: Option<Packed>,
}

/// Rows of the ball, half as many as in pictures.
const ROWS: usize = 128;

impl PackedMesh {
    /// A body.
    pub fn solid(body: Body) -> PackedMesh {
        if body == Body::Ball {
            return PackedMesh {
                name: body.name().to_owned(),
                ball: Some(ROWS),
                vertices: None,
            };
        }
        PackedMesh::new(body.name().to_owned(), &body.triangles())
    }

    /// A body's water.
    pub fn water(body: Body) -> PackedMesh {
        PackedMesh::new(format!("{} water", body.name()), &body.water())
    }

    fn new(name: String, triangles: &[[Vertex; 3]]) -> PackedMesh {
        PackedMesh {
            name,
            ball: None,
            vertices: Some(Packed::floats(vertex_numbers(triangles).as_flattened())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_exponent_keeps_a_colour_to_a_part_in_five_hundred() {
        for texel in [
            [0.0, 0.0, 0.0],
            [1.0, 0.5, 0.25],
            [60.0, 55.8, 48.0],
            [0.999_9, 0.01, 0.3],
        ] {
            let got = from_shared_exponent(shared_exponent(texel));
            let most = texel.into_iter().fold(0.0_f32, f32::max);
            for (got, want) in got.into_iter().zip(texel) {
                assert!((got - want).abs() <= most / 500.0, "{got} {want}");
            }
        }
    }
}
