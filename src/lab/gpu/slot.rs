//! The buffers of one block of points, which is uploaded, computed and read back.

use std::sync::mpsc::{Receiver, channel};

use wgpu::{BufferUsages, CommandEncoderDescriptor, MapMode};

use super::compute::Compute;
use super::kernel::{Kernel, Resources};
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
        let points = match inputs {
            PointInputs::Places(_) => BATCH as u64,
            PointInputs::Cosines | PointInputs::Bits => BLOCK as u64,
        };
        let (size, usage) = match inputs {
            PointInputs::Places(places) => (points * places as u64 * RESULT, BufferUsages::STORAGE),
            PointInputs::Cosines => (points * INPUT, BufferUsages::STORAGE),
            PointInputs::Bits => (UNIFORM, BufferUsages::UNIFORM),
        };
        let inputs = compute.buffer(size, usage | BufferUsages::COPY_DST);
        let results = |usage| compute.buffer(points * RESULT, usage);
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
