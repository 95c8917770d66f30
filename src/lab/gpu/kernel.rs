//! A compute program ready to run, with its pipeline and bindings: over points, or as a stream over all numbers of a range without
//! uploading them.
//!
//! In a stream the program makes its own point, `bitcast<f32>(first + index)`, from the uniform `first` in binding 1. Two blocks are
//! in flight: the device computes one while the other is read in mapped memory. The buffers of a block (`Slot`) are uploaded,
//! computed and read back.

use std::rc::Rc;
use std::sync::mpsc::{Receiver, channel};

use wgpu::{
    BindingResource, BindingType, BufferBindingType, BufferUsages, CommandEncoderDescriptor,
    MapMode,
};

use super::compute::{Compute, SAMPLER, UNIFORM_BLOCK, buffer_binding, texture_binding};
use super::program::{PointInputs, Program, ShaderCode, Uniform, block, check_fit};
use super::spirv;
use super::texture::{Texture, TextureShape, table, view_dimension};
use crate::lab::fault::Fault;

/// A pipeline on its device.
pub(super) struct Kernel {
    compute: Rc<Compute>,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    inputs: PointInputs,
    uniforms: Vec<Uniform>,
    texture: Option<TextureShape>,
    has_block: bool,
}

/// The arguments and the texture of a run, on the device.
struct Resources {
    block: Option<wgpu::Buffer>,
    table: Option<(wgpu::TextureView, wgpu::Sampler)>,
}

impl Kernel {
    /// Compiles a program.
    pub fn new(
        compute: &Rc<Compute>,
        program: &Program,
        inputs: PointInputs,
    ) -> Result<Kernel, Fault> {
        let module = module(compute, program)?;
        let (pipeline, layout) = compute.guarded(|| pipeline(compute, &module, program, inputs))?;
        Ok(Kernel {
            compute: compute.clone(),
            pipeline,
            layout,
            inputs,
            uniforms: program.uniforms.to_vec(),
            texture: program.texture,
            has_block: has_block(program),
        })
    }

    /// Runs over cosines, block by block, and passes on the results of each block in order.
    pub fn run(
        &self,
        cosines: &[f32],
        uniforms: &[Uniform],
        texture: Option<&Texture>,
        take: impl FnMut(&[[f32; 4]]),
    ) -> Result<(), Fault> {
        let blocks = cosines.chunks(BLOCK).map(Block::Cosines);
        self.pump(blocks, uniforms, texture, take)
    }

    /// Runs over points of so many groups of four numbers, block by block, and passes on the results of each block in order.
    pub fn run_batch(
        &self,
        points: &[[f32; 4]],
        places: usize,
        texture: Option<&Texture>,
        take: impl FnMut(&[[f32; 4]]),
    ) -> Result<(), Fault> {
        let blocks = points.chunks(BATCH * places);
        let blocks = blocks.map(|points| Block::Places { points, places });
        self.pump(blocks, &[], texture, take)
    }

    /// Runs over blocks: while one is read, the device computes the next.
    pub fn pump<'a>(
        &self,
        blocks: impl Iterator<Item = Block<'a>>,
        uniforms: &[Uniform],
        texture: Option<&Texture>,
        mut take: impl FnMut(&[[f32; 4]]),
    ) -> Result<(), Fault> {
        check_fit(&self.uniforms, uniforms, self.texture, texture)?;
        let compute = &*self.compute;
        let resources = self.resources(uniforms, texture)?;
        let slots = compute.guarded(|| [(); 2].map(|()| Slot::new(compute, self.inputs)))?;
        let mut ahead = None;
        for (block, slot) in blocks.zip(slots.iter().cycle()) {
            let flight = slot.submit(compute, self, &resources, &block)?;
            if let Some((slot, flight)) = ahead.replace((slot, flight)) {
                slot.read(compute, flight, &mut take)?;
            }
        }
        match ahead {
            Some((slot, flight)) => slot.read(compute, flight, &mut take),
            None => Ok(()),
        }
    }

    fn resources(
        &self,
        uniforms: &[Uniform],
        texture: Option<&Texture>,
    ) -> Result<Resources, Fault> {
        let compute = &*self.compute;
        let bytes = block(uniforms);
        let block = || compute.guarded(|| compute.filled_buffer(&bytes, BufferUsages::UNIFORM));
        let table = texture.map(|texture| table(compute, texture));
        Ok(Resources {
            block: self.has_block.then(block).transpose()?,
            table: table.transpose()?,
        })
    }

    /// The bindings of one block.
    fn bind(
        &self,
        resources: &Resources,
        inputs: BindingResource,
        results: BindingResource,
    ) -> wgpu::BindGroup {
        let mut bound = vec![(1, inputs), (2, results)];
        if let Some(block) = &resources.block {
            bound.push((0, block.as_entire_binding()));
        }
        if let Some((view, sampler)) = &resources.table {
            bound.push((3, BindingResource::TextureView(view)));
            bound.push((4, BindingResource::Sampler(sampler)));
        }
        self.compute.bind_group(&self.layout, bound)
    }

    /// The commands of one block, up to the results.
    pub fn dispatch(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        group: &wgpu::BindGroup,
        points: usize,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(points.div_ceil(64) as u32, 1, 1);
    }
}

/// A compute program ready to run over consecutive bit patterns.
pub struct Stream(pub(super) Kernel);

impl Stream {
    /// Runs over `count` numbers with consecutive bits, from `first` on. Block by block and in order, `take` gets the bits of the
    /// block's first number and the results, in mapped memory that is valid during the call. After 2³² numbers the bits wrap
    /// around.
    ///
    /// # Errors
    /// Arguments or texture do not fit the program or the device, or the device is lost.
    pub fn run(
        &self,
        first: u32,
        count: u64,
        uniforms: &[Uniform],
        texture: Option<&Texture>,
        mut take: impl FnMut(u32, &[[f32; 4]]),
    ) -> Result<(), Fault> {
        let at = |done: u64| first.wrapping_add(done as u32);
        let blocks = (0..count).step_by(BLOCK).map(|done| Block::Bits {
            first: at(done),
            count: (count - done).min(BLOCK as u64) as usize,
        });
        let mut next = first;
        self.0.pump(blocks, uniforms, texture, |results| {
            take(next, results);
            next = next.wrapping_add(results.len() as u32);
        })
    }
}

fn module(compute: &Compute, program: &Program) -> Result<wgpu::ShaderModule, Fault> {
    match program.code {
        ShaderCode::Wgsl(text) => compute.guarded(|| compute.module(text)),
        ShaderCode::Spirv(bytes) => spirv::module(compute, bytes, program.entry),
        ShaderCode::Gles(_) => Err(Fault::unable(&compute.adapter.name, "GLSL ES in compute")),
    }
}

/// The pipeline of a program. Its layout is explicit, since that of a SPIR-V module cannot be derived.
fn pipeline(
    compute: &Compute,
    module: &wgpu::ShaderModule,
    program: &Program,
    inputs: PointInputs,
) -> (wgpu::ComputePipeline, wgpu::BindGroupLayout) {
    let kinds = kinds(program, inputs);
    let layout = compute.group_layout(wgpu::ShaderStages::COMPUTE, &kinds);
    let descriptor = wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&compute.pipeline_layout(&layout)),
        module,
        entry_point: Some(program.entry),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    };
    (compute.device.create_compute_pipeline(&descriptor), layout)
}

/// Whether binding 0 exists. For SPIR-V it always does: wgpu renumbers the bindings of a layout for Vulkan, without gaps, but not
/// in shaders that it has not compiled (<https://github.com/gfx-rs/wgpu/issues/9326>).
fn has_block(program: &Program) -> bool {
    !program.uniforms.is_empty() || matches!(program.code, ShaderCode::Spirv(_))
}

/// The bindings, in the order of their numbers, for the same reason.
fn kinds(program: &Program, inputs: PointInputs) -> Vec<(u32, BindingType)> {
    let read_only = |read_only| buffer_binding(BufferBindingType::Storage { read_only });
    let first = match inputs {
        PointInputs::Cosines | PointInputs::Places(_) => read_only(true),
        PointInputs::Bits => UNIFORM_BLOCK,
    };
    let mut kinds = Vec::new();
    if has_block(program) {
        kinds.push((0, UNIFORM_BLOCK));
    }
    kinds.extend([(1, first), (2, read_only(false))]);
    if let Some(shape) = program.texture {
        kinds.extend([(3, texture_binding(view_dimension(shape))), (4, SAMPLER)]);
    }
    kinds
}

/// The number of points in a block.
pub(super) const BLOCK: usize = 1 << 18;
/// The number of points in a block of a program of many arguments.
const BATCH: usize = 1 << 14;
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
struct Flight {
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
    fn submit(
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
    fn read(
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
