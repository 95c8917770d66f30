//! A compute program ready to run, with its pipeline and bindings.

use std::rc::Rc;

use wgpu::{BindingType, BufferBindingType, BufferUsages};

use super::compute::Compute;
use super::passthrough;
use super::program::{PointInputs, Program, ShaderCode, Uniform, block, check_fit};
use super::slot::{BATCH, BLOCK, Block, Slot};
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
pub(super) struct Resources {
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
        let (pipeline, layout) =
            compute.guarded(|| pipeline(&compute.device, &module, program, inputs))?;
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
    pub fn bind(
        &self,
        device: &wgpu::Device,
        resources: &Resources,
        inputs: wgpu::BindingResource,
        results: wgpu::BindingResource,
    ) -> wgpu::BindGroup {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let mut entries = vec![entry(1, inputs), entry(2, results)];
        if let Some(block) = &resources.block {
            entries.push(entry(0, block.as_entire_binding()));
        }
        if let Some((view, sampler)) = &resources.table {
            entries.push(entry(3, wgpu::BindingResource::TextureView(view)));
            entries.push(entry(4, wgpu::BindingResource::Sampler(sampler)));
        }
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &entries,
        })
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

fn module(compute: &Compute, program: &Program) -> Result<wgpu::ShaderModule, Fault> {
    match program.code {
        ShaderCode::Wgsl(text) => compute.guarded(|| compute.module(text)),
        ShaderCode::Spirv(bytes) => passthrough::module(compute, bytes, program.entry),
        ShaderCode::Gles(_) => Err(Fault::unable(&compute.adapter.name, "GLSL ES in compute")),
    }
}

/// The pipeline of a program. Its layout is explicit, since that of a SPIR-V module cannot be derived.
fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    program: &Program,
    inputs: PointInputs,
) -> (wgpu::ComputePipeline, wgpu::BindGroupLayout) {
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries(program, inputs),
    });
    let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&whole),
        module,
        entry_point: Some(program.entry),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    (pipeline, layout)
}

/// Whether binding 0 exists. For SPIR-V it always does: wgpu renumbers the bindings of a layout for Vulkan, without gaps, but not
/// in shaders that it has not compiled (<https://github.com/gfx-rs/wgpu/issues/9326>).
fn has_block(program: &Program) -> bool {
    !program.uniforms.is_empty() || matches!(program.code, ShaderCode::Spirv(_))
}

/// The layout's entries, in the order of binding numbers, for the same reason.
fn entries(program: &Program, inputs: PointInputs) -> Vec<wgpu::BindGroupLayoutEntry> {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    };
    let buffer = |ty| BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let read_only = |read_only| buffer(BufferBindingType::Storage { read_only });
    let uniform = buffer(BufferBindingType::Uniform);
    let first = match inputs {
        PointInputs::Cosines | PointInputs::Places(_) => read_only(true),
        PointInputs::Bits => uniform,
    };
    let mut entries = Vec::new();
    if has_block(program) {
        entries.push(entry(0, uniform));
    }
    entries.extend([entry(1, first), entry(2, read_only(false))]);
    if let Some(shape) = program.texture {
        let table = BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: view_dimension(shape),
            multisampled: false,
        };
        let sampler = BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        entries.extend([entry(3, table), entry(4, sampler)]);
    }
    entries
}
