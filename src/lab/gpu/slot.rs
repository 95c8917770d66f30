//! One block of points on its way: in, computed, and read from where the device left it.
//!
//! A texture as a program reads it: a picture or the six sides of a cube, one level.

use std::sync::mpsc::{Receiver, channel};

use half::f16;
use wgpu::{BufferUsages, CommandEncoderDescriptor, MapMode};

use super::adapter::DeviceFault;
use super::kernel::{Compute, Kernel, Resources};
use super::program::PointInputs;

/// Points of a block.
pub(super) const BLOCK: usize = 1 << 18;
/// Points of a block whose points have many arguments.
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
    /// So many numbers, from that with these bits on.
    Bits { first: u32, count: usize },
    /// These points, of so many places each.
    Places {
        points: &'a [[f32; 4]],
        places: usize,
    },
}

/// The buffers of one block.
pub(super) struct Slot {
    inputs: wgpu::Buffer,
    results: wgpu::Buffer,
    /// What the processor reads, where it cannot read the results themselves.
    landing: Option<wgpu::Buffer>,
}

/// A block that the device is at.
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

    /// What the processor reads.
    fn readable(&self) -> &wgpu::Buffer {
        self.landing.as_ref().unwrap_or(&self.results)
    }

    /// Sets the device to work on a block, and does not wait for it.
    pub fn submit(
        &self,
        compute: &Compute,
        kernel: &Kernel,
        resources: &Resources,
        block: &Block,
    ) -> Result<Flight, DeviceFault> {
        let inputs = block.bytes();
        let bytes = block.points() as u64 * RESULT;
        compute.guarded(|| {
            compute.queue.write_buffer(&self.inputs, 0, &inputs);
            // The bindings are as long as the block: the program asks for the length.
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
                    // Nobody listens any more after a fault.
                    let _ = tell.send(done);
                });
            Flight {
                submission,
                mapped,
                bytes,
            }
        })
    }

    /// Waits for a block and hands its results over where they lie.
    pub fn read(
        &self,
        compute: &Compute,
        flight: Flight,
        take: &mut impl FnMut(&[[f32; 4]]),
    ) -> Result<(), DeviceFault> {
        compute.wait(flight.submission)?;
        let mapped = flight.mapped.try_recv();
        mapped
            .map_err(DeviceFault::lost)?
            .map_err(DeviceFault::lost)?;
        let view = self.readable().get_mapped_range(..flight.bytes);
        let view = view.map_err(DeviceFault::lost)?;
        take(bytemuck::try_cast_slice(&view).map_err(DeviceFault::lost)?);
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
