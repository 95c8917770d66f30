//! A texture as a program reads it: a picture or the six sides of a cube, one level.

use half::f16;

use super::DeviceFault;

/// The texels and how they are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture<'a> {
    /// Texels of a row.
    pub width: usize,
    /// The rows one after the other, the first at v = 0.
    pub texels: &'a [[f32; 4]],
    /// What each becomes.
    pub format: TextureFormat,
    /// What lies beyond the edge.
    pub wrap: Wrap,
    /// What the rows are.
    pub shape: TextureShape,
    /// What lies between texels.
    pub filter: TextureFilter,
}

/// What the rows of a texture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureShape {
    /// A picture.
    Flat,
    /// The sides of a cube, one below the other, as OpenGL and Vulkan order and turn them: +x, -x, +y, -y, +z, -z.
    Cube,
}

/// What a sampler gives between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureFilter {
    /// A mixture of neighbours.
    Linear,
    /// The nearest texel.
    Nearest,
}

/// The kind of number that a texel holds. What is given is rounded to the nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureFormat {
    /// binary16.
    Half,
    /// binary32. Not every device filters it.
    Float,
    /// 8 bits, 0 to 1.
    Unorm8,
    /// 16 bits, 0 to 1. Not every device has it.
    Unorm16,
    /// The same bits as [`TextureFormat::Unorm8`], which the sampler takes through the curve of sRGB.
    Srgb8,
}

/// What a sampler gives beyond the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The last texel.
    Clamp,
    /// The texels again.
    Repeat,
}

impl Texture<'_> {
    /// The number of rows.
    ///
    /// # Errors
    /// The texels are no whole rows.
    pub(super) fn height(&self) -> Result<usize, DeviceFault> {
        let (texels, width) = (self.texels.len(), self.width);
        if width == 0 || texels == 0 || !texels.is_multiple_of(width) {
            return Err(DeviceFault::refused(format!(
                "a texture of {texels} texels has no whole rows of {width}"
            )));
        }
        let rows = texels / width;
        if self.shape == TextureShape::Cube && rows != 6 * width {
            return Err(DeviceFault::refused(format!(
                "a cube of sides of {width} has {} rows, not {rows}",
                6 * width
            )));
        }
        Ok(rows)
    }

    /// The bytes of a row.
    pub(super) fn row_bytes(&self) -> usize {
        self.width * self.format.bytes()
    }

    /// All texels as the device takes them.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let values = self.texels.iter().flatten().copied();
        let steps = |value: f32, largest: f32| (value.clamp(0.0, 1.0) * largest).round();
        match self.format {
            TextureFormat::Half => values
                .flat_map(|v| f16::from_f32(v).to_ne_bytes())
                .collect(),
            TextureFormat::Float => values.flat_map(f32::to_ne_bytes).collect(),
            TextureFormat::Unorm8 | TextureFormat::Srgb8 => {
                values.map(|v| steps(v, 255.0) as u8).collect()
            }
            TextureFormat::Unorm16 => values
                .flat_map(|v| (steps(v, 65_535.0) as u16).to_ne_bytes())
                .collect(),
        }
    }
}

impl TextureFormat {
    /// Bytes of a texel.
    fn bytes(self) -> usize {
        match self {
            TextureFormat::Unorm8 | TextureFormat::Srgb8 => 4,
            TextureFormat::Half | TextureFormat::Unorm16 => 8,
            TextureFormat::Float => 16,
        }
    }
}
