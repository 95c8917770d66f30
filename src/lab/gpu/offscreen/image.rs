//! Images: made, filled, read back.

use half::f16;
use wgpu::{BufferUsages, TextureFormat, TextureUsages, TextureViewDimension};

use super::{Image, Offscreen};
use crate::lab::fault::Fault;

impl Offscreen {
    /// An image to draw to.
    ///
    /// # Errors
    /// It is larger than the device allows.
    pub fn target(&self, width: u32, height: u32) -> Result<Image, Fault> {
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        self.image([width, height, 1], self.format, usage)
    }

    /// An image with these texels, row by row, each rounded to binary16. Six squares are a cube map: +x, -x, +y, -y, +z, -z.
    ///
    /// # Errors
    /// It is larger than the device allows, or the texels do not fill it.
    pub fn upload(
        &self,
        [width, height, layers]: [u32; 3],
        texels: &[[f32; 4]],
    ) -> Result<Image, Fault> {
        if texels.len() as u64 != u64::from(width) * u64::from(height) * u64::from(layers) {
            return Err(Fault::refused("texels that do not fill their image"));
        }
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
        let image = self.image([width, height, layers], TextureFormat::Rgba16Float, usage)?;
        let halves = texels.iter().flatten();
        let bytes: Vec<u8> = halves
            .flat_map(|value| f16::from_f32(*value).to_ne_bytes())
            .collect();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * 8),
            rows_per_image: Some(height),
        };
        let whole = image.texture.as_image_copy();
        let size = image.texture.size();
        self.compute.guarded(|| {
            self.compute
                .queue
                .write_texture(whole, &bytes, layout, size)
        })?;
        Ok(image)
    }

    pub(super) fn image(
        &self,
        [width, height, layers]: [u32; 3],
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<Image, Fault> {
        let most = self.compute.device.limits().max_texture_dimension_2d;
        if !(1..=most).contains(&width) || !(1..=most).contains(&height) {
            let what = format!("an image of {width} x {height} pixels; at most {most} a side");
            return Err(Fault::unable(&self.compute.adapter.name, what));
        }
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        };
        let texture = self
            .compute
            .guarded(|| self.compute.texture(size, format, usage))?;
        let dimension = match layers {
            6 => TextureViewDimension::Cube,
            _ => TextureViewDimension::D2,
        };
        Ok(Image { texture, dimension })
    }

    /// The texels of a target, row by row.
    ///
    /// # Errors
    /// The device is lost.
    pub fn read(&self, image: &Image) -> Result<Vec<[f32; 4]>, Fault> {
        let (compute, size) = (&self.compute, image.texture.size());
        let is_half = self.format == TextureFormat::Rgba16Float;
        let row = size.width * if is_half { 8 } else { 16 };
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let (buffer, submission) = compute.guarded(|| {
            let buffer = compute.buffer(
                u64::from(padded) * u64::from(size.height),
                BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            );
            let mut encoder = compute.device.create_command_encoder(&Default::default());
            let into = wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            };
            encoder.copy_texture_to_buffer(image.texture.as_image_copy(), into, size);
            let submission = compute.queue.submit([encoder.finish()]);
            buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
            (buffer, submission)
        })?;
        compute.wait(submission)?;
        let bytes = buffer.slice(..).get_mapped_range().map_err(Fault::lost)?;
        let rows = bytes.chunks_exact(padded as usize);
        let rows = rows.map(|padded| &padded[..row as usize]);
        Ok(rows.flat_map(|row| texels(row, is_half)).collect())
    }
}

impl Image {
    pub(super) fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(self.dimension),
            ..Default::default()
        })
    }
}

/// The texels of a row.
fn texels(row: &[u8], is_half: bool) -> Vec<[f32; 4]> {
    let numbers: Vec<f32> = if is_half {
        row.chunks_exact(2)
            .map(|bytes| f16::from_ne_bytes([bytes[0], bytes[1]]).to_f32())
            .collect()
    } else {
        bytemuck::pod_collect_to_vec(row)
    };
    let four = |four: &[f32]| [four[0], four[1], four[2], four[3]];
    numbers.chunks_exact(4).map(four).collect()
}
