//! The catalogue of fitted coefficients as a texture: one row per material, four texels c0 to c3, which a shader fetches by
//! number.

use serde::Serialize;

use super::axis::TableAxis;
use super::ktx2::ktx2;
use super::picture::Picture;
use super::texel::Depth;
use crate::generator::emit::{COEFFICIENTS, CatalogueRow, FOURTH, fourths};
use crate::physics::spectra::Space;

/// The number type of the catalogue's texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CatalogueTexture {
    /// binary16: coefficients rounded to the nearest number.
    Half,
    /// binary32: the same numbers as in the array.
    Float,
}

/// The entry of a texture's file in `catalogue.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CatalogueTextureDetail {
    file: &'static str,
    format: &'static str,
    width: usize,
    height: usize,
    texel: &'static str,
    alpha: &'static str,
}

impl CatalogueTexture {
    /// Both, the smaller first.
    pub const ALL: [CatalogueTexture; 2] = [CatalogueTexture::Half, CatalogueTexture::Float];

    /// The file's name, the format of its texels by Vulkan's name, and their depth.
    const fn row(self) -> (&'static str, &'static str, Depth) {
        match self {
            CatalogueTexture::Half => ("catalogue.f16.ktx2", "R16G16B16A16_SFLOAT", Depth::Half),
            CatalogueTexture::Float => ("catalogue.f32.ktx2", "R32G32B32A32_SFLOAT", Depth::Float),
        }
    }

    /// The file's name.
    pub const fn file(self) -> &'static str {
        self.row().0
    }

    /// The entry of its file.
    pub fn detail(self, rows: &[CatalogueRow]) -> CatalogueTextureDetail {
        let (file, format, _) = self.row();
        CatalogueTextureDetail {
            file,
            format,
            width: COEFFICIENTS,
            height: rows.len(),
            texel: "x is i of c_i, y is row / 4; fetch, do not filter",
            alpha: FOURTH,
        }
    }

    /// Its file. `space` is the colours' space.
    pub fn encode(self, rows: &[CatalogueRow], space: Option<Space>) -> Vec<u8> {
        let (_, _, depth) = self.row();
        let colours = rows.iter().flat_map(|row| &row.coefficients);
        let texels = colours.map(|colour| colour.map(|value| depth.nearest(value)));
        ktx2(&Picture {
            name: String::new(),
            axis: TableAxis::Cos,
            depth,
            scale: 1.0,
            width: COEFFICIENTS,
            rows: rows.iter().map(|row| row.name.clone()).collect(),
            texels: texels.collect(),
            alpha: Some(fourths(rows).collect()),
            space,
            about: Vec::new(),
        })
    }
}
