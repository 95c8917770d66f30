//! The textures that programs read, a picture or the six sides of a cube, of one level, and their samplers.

use half::f16;
use wgpu::{Features, TextureUsages};

use super::compute::Compute;
use crate::lab::fault::Fault;

/// The texels and how they are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture<'a> {
    /// Texels of a row.
    pub width: usize,
    /// The rows one after the other, the first at v = 0.
    pub texels: &'a [[f32; 4]],
    /// The format of a texel on the device.
    pub format: TextureFormat,
    /// The addressing beyond the edge.
    pub wrap: Wrap,
    /// Whether the rows are a picture or a cube map.
    pub shape: TextureShape,
    /// The filter between texels.
    pub filter: TextureFilter,
}

/// The shape of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureShape {
    /// A picture.
    Flat,
    /// The sides of a cube map, one below the other, in the order and orientation of OpenGL and Vulkan: +x, -x, +y, -y, +z, -z.
    Cube,
}

/// The result of a sampler between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureFilter {
    /// Linear interpolation of neighbours.
    Linear,
    /// The nearest texel.
    Nearest,
}

/// The number format of a texel. Given values are rounded to nearest.
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
    /// The bits of [`TextureFormat::Unorm8`], which the sampler decodes by the sRGB curve.
    Srgb8,
}

/// The result of a sampler beyond the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The last texel.
    Clamp,
    /// The texture, repeated.
    Repeat,
}

impl Texture<'_> {
    /// The number of rows.
    ///
    /// # Errors
    /// The texels do not fill whole rows.
    pub(super) fn height(&self) -> Result<usize, Fault> {
        let (texels, width) = (self.texels.len(), self.width);
        if width == 0 || texels == 0 || !texels.is_multiple_of(width) {
            return Err(Fault::refused(format!(
                "a texture of {texels} texels has no whole rows of {width}"
            )));
        }
        let rows = texels / width;
        if self.shape == TextureShape::Cube && rows != 6 * width {
            return Err(Fault::refused(format!(
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

    /// The bytes of all texels, in the format of the device.
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

/// A texture on the device, and its sampler.
pub(super) fn table(
    compute: &Compute,
    texture: &Texture,
) -> Result<(wgpu::TextureView, wgpu::Sampler), Fault> {
    let (format, needed) = match texture.format {
        TextureFormat::Half => (wgpu::TextureFormat::Rgba16Float, Features::empty()),
        TextureFormat::Float => (
            wgpu::TextureFormat::Rgba32Float,
            Features::FLOAT32_FILTERABLE,
        ),
        TextureFormat::Unorm8 => (wgpu::TextureFormat::Rgba8Unorm, Features::empty()),
        TextureFormat::Unorm16 => (
            wgpu::TextureFormat::Rgba16Unorm,
            Features::TEXTURE_FORMAT_16BIT_NORM,
        ),
        TextureFormat::Srgb8 => (wgpu::TextureFormat::Rgba8UnormSrgb, Features::empty()),
    };
    if !compute.has(needed) {
        let what = format!("filter a texture of {format:?}");
        return Err(Fault::unable(&compute.adapter.name, what));
    }
    let rows = texture.height()? as u32;
    let width = texture.width as u32;
    let (height, layers) = match texture.shape {
        TextureShape::Flat => (rows, 1),
        TextureShape::Cube => (width, 6),
    };
    let size = wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: layers,
    };
    compute.guarded(|| {
        (
            upload(compute, texture, format, size),
            sampler(compute, texture),
        )
    })
}

fn upload(
    compute: &Compute,
    texture: &Texture,
    format: wgpu::TextureFormat,
    size: wgpu::Extent3d,
) -> wgpu::TextureView {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let made = compute.texture(size, format, usage);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(texture.row_bytes() as u32),
        rows_per_image: Some(size.height),
    };
    compute
        .queue
        .write_texture(made.as_image_copy(), &texture.bytes(), layout, size);
    made.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(view_dimension(texture.shape)),
        ..Default::default()
    })
}

pub(super) fn view_dimension(shape: TextureShape) -> wgpu::TextureViewDimension {
    match shape {
        TextureShape::Flat => wgpu::TextureViewDimension::D2,
        TextureShape::Cube => wgpu::TextureViewDimension::Cube,
    }
}

fn sampler(compute: &Compute, texture: &Texture) -> wgpu::Sampler {
    let address = match texture.wrap {
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
        Wrap::Repeat => wgpu::AddressMode::Repeat,
    };
    let filter = match texture.filter {
        TextureFilter::Linear => wgpu::FilterMode::Linear,
        TextureFilter::Nearest => wgpu::FilterMode::Nearest,
    };
    compute.device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: address,
        address_mode_v: address,
        mag_filter: filter,
        min_filter: filter,
        ..Default::default()
    })
}
