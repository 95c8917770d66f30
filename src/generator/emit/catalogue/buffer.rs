//! The catalogue as a storage buffer takes it: the numbers of the array, each colour as a `vec4`, little endian.
//!
//! Source: std430 aligns an array of `vec4` to 16 bytes an element (Khronos, *The OpenGL Graphics System 4.6*, section 7.6.2.2, 2022,
//! <https://registry.khronos.org/OpenGL/specs/gl/glspec46.core.pdf>), and so does WGSL (W3C, *WebGPU Shading Language*, section 14.4.1,
//! 2024, <https://www.w3.org/TR/WGSL/#alignment-and-size>).

use serde::Serialize;

use super::{COEFFICIENTS, CatalogueRow};

/// The file's name.
pub const CATALOGUE_BUFFER: &str = "catalogue.std430.bin";
/// The fourth number of a `vec4`, and alpha in textures: readers of pictures that multiply by alpha change nothing.
pub const FOURTH: f32 = 1.0;
/// The bytes of a `vec4`.
const ELEMENT: usize = 16;

/// What `catalogue.json` says of the buffer's file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferDetail {
    file: &'static str,
    layout: &'static str,
    stride: usize,
    fourth: f32,
}

impl BufferDetail {
    /// The same for every catalogue.
    pub fn new() -> BufferDetail {
        BufferDetail {
            file: CATALOGUE_BUFFER,
            layout: "std430, little endian, no header: array<vec4<f32>>, c0 to c3 of each material",
            stride: COEFFICIENTS * ELEMENT,
            fourth: FOURTH,
        }
    }
}

impl Default for BufferDetail {
    fn default() -> BufferDetail {
        BufferDetail::new()
    }
}

/// The file's bytes: rows in the order of the array.
pub fn catalogue_buffer(rows: &[CatalogueRow]) -> Vec<u8> {
    let colours = rows.iter().flat_map(|row| &row.coefficients);
    let numbers = colours.flat_map(|[r, g, b]| [*r as f32, *g as f32, *b as f32, FOURTH]);
    numbers.flat_map(f32::to_le_bytes).collect()
}

/// Where in the file the material of this place begins, in bytes.
pub(super) fn offset(place: usize) -> usize {
    place * COEFFICIENTS * ELEMENT
}
