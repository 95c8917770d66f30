//! The buffers of one block of points, which is uploaded, computed and read back, and the textures that programs read: a picture
//! or the six sides of a cube, one level.

use std::sync::mpsc::{Receiver, channel};

use half::f16;
use wgpu::{BufferUsages, CommandEncoderDescriptor, MapMode};

use super::kernel::{Compute, Kernel, Resources};
use super::program::PointInputs;
use crate::lab::fault::Fault;

/// The number of points in a block.
pub(super) const BLOCK: usize = 1 << 18;
/// The number of points in a block of a program of many arguments.
pub(super) const BATCH: usize = 1 << 14;
/// Bytes of a result.
const RESULT: u64 = 16;
/// Bytes of an input, and of a uniform.
const INPUT: u64 = 4;
const UNIFORM: u64 = 16;

/// The points of a block.
pub(super) enum Block<'a> {
    /// These cosines.
    Cosines(&'a [f32]),
    /// `count` numbers with consecutive bits, from `first` on.
    Bits { first: u32, count: usize },
    /// These points, of so many groups of four numbers each.
    Places {
        points: &'a [[f32; 4]],
        places: usize,
    },
}

/// The buffers of one block.
pub(super) struct Slot {
    inputs: wgpu::Buffer,
    results: wgpu::Buffer,
    /// The buffer that the processor reads, where it cannot read the results directly.
    landing: Option<wgpu::Buffer>,
}

/// A block in flight on the device.
pub(super) struct Flight {
    submission: wgpu::SubmissionIndex,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
    bytes: u64,
}

impl Block<'_> {
    fn points(&self) -> usize {
        match self {
            Block::Cosines(cosines) => cosines.len(),
            Block::Bits { count, .. } => *count,
            Block::Places { points, places } => points.len() / places,
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            Block::Cosines(cosines) => bytemuck::cast_slice(cosines).to_vec(),
            Block::Places { points, .. } => bytemuck::cast_slice(points).to_vec(),
            Block::Bits { first, .. } => bytemuck::cast_slice(&[*first, 0, 0, 0]).to_vec(),
        }
    }
}

impl Slot {
    /// Buffers for whole blocks.
    pub fn new(compute: &Compute, inputs: PointInputs) -> Slot {
        let buffer = |size, usage| {
            compute.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let points = match inputs {
            PointInputs::Places(_) => BATCH as u64,
            PointInputs::Cosines | PointInputs::Bits => BLOCK as u64,
        };
        let (size, usage) = match inputs {
            PointInputs::Places(places) => (points * places as u64 * RESULT, BufferUsages::STORAGE),
            PointInputs::Cosines => (points * INPUT, BufferUsages::STORAGE),
            PointInputs::Bits => (UNIFORM, BufferUsages::UNIFORM),
        };
        let inputs = buffer(size, usage | BufferUsages::COPY_DST);
        let results = |usage| buffer(points * RESULT, usage);
        if compute.shares_memory() {
            return Slot {
                inputs,
                results: results(BufferUsages::STORAGE | BufferUsages::MAP_READ),
                landing: None,
            };
        }
        Slot {
            inputs,
            results: results(BufferUsages::STORAGE | BufferUsages::COPY_SRC),
            landing: Some(results(BufferUsages::MAP_READ | BufferUsages::COPY_DST)),
        }
    }

    /// The buffer that the processor reads.
    fn readable(&self) -> &wgpu::Buffer {
        self.landing.as_ref().unwrap_or(&self.results)
    }

    /// Submits a block to the device, without waiting for it.
    pub fn submit(
        &self,
        compute: &Compute,
        kernel: &Kernel,
        resources: &Resources,
        block: &Block,
    ) -> Result<Flight, Fault> {
        let inputs = block.bytes();
        let bytes = block.points() as u64 * RESULT;
        compute.guarded(|| {
            compute.queue.write_buffer(&self.inputs, 0, &inputs);
            // The bindings are as long as the block, because the program queries the length.
            let group = kernel.bind(
                &compute.device,
                resources,
                part(&self.inputs, inputs.len() as u64),
                part(&self.results, bytes),
            );
            let descriptor = CommandEncoderDescriptor::default();
            let mut encoder = compute.device.create_command_encoder(&descriptor);
            kernel.dispatch(&mut encoder, &group, block.points());
            if let Some(landing) = &self.landing {
                encoder.copy_buffer_to_buffer(&self.results, 0, landing, 0, bytes);
            }
            let submission = compute.queue.submit([encoder.finish()]);
            let (tell, mapped) = channel();
            self.readable()
                .map_async(MapMode::Read, ..bytes, move |done| {
                    // The receiver is gone after a fault.
                    let _ = tell.send(done);
                });
            Flight {
                submission,
                mapped,
                bytes,
            }
        })
    }

    /// Waits for a block and passes its results on in mapped memory.
    pub fn read(
        &self,
        compute: &Compute,
        flight: Flight,
        take: &mut impl FnMut(&[[f32; 4]]),
    ) -> Result<(), Fault> {
        compute.wait(flight.submission)?;
        let mapped = flight.mapped.try_recv();
        mapped.map_err(Fault::lost)?.map_err(Fault::lost)?;
        let view = self.readable().get_mapped_range(..flight.bytes);
        let view = view.map_err(Fault::lost)?;
        take(bytemuck::try_cast_slice(&view).map_err(Fault::lost)?);
        drop(view);
        self.readable().unmap();
        Ok(())
    }
}

/// The beginning of a buffer, as a binding.
fn part(buffer: &wgpu::Buffer, bytes: u64) -> wgpu::BindingResource<'_> {
    wgpu::BindingResource::Buffer(wgpu::BufferBinding {
        buffer,
        offset: 0,
        size: wgpu::BufferSize::new(bytes),
    })
}

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
