//! A compute program ready to run, with its pipeline and bindings, and the wgpu device that it runs on. Errors of the device are
//! values: none of them prints or panics.

use std::rc::Rc;
use std::sync::{Arc, Mutex, PoisonError};

use pollster::block_on;
use wgpu::{BindingType, BufferBindingType, BufferUsages, ErrorFilter, Features, PollType};

use super::adapter::{Adapter, AdapterKind, describe};
use super::passthrough;
use super::program::{PointInputs, Program, ShaderCode, Uniform, block, check_fit};
use super::slot::{
    BATCH, BLOCK, Block, Slot, Texture, TextureFilter, TextureFormat, TextureShape, Wrap,
};
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
        let block = || compute.guarded(|| uniform_block(compute, &block(uniforms)));
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
        ShaderCode::Wgsl(text) => compute.guarded(|| {
            compute
                .device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: None,
                    source: wgpu::ShaderSource::Wgsl(text.into()),
                })
        }),
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

pub(super) fn uniform_block(compute: &Compute, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = compute.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        // A buffer may not be empty, even if it is never read.
        size: bytes.len().max(16) as u64,
        usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    compute.queue.write_buffer(&buffer, 0, bytes);
    buffer
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
    let made = compute.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
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

fn view_dimension(shape: TextureShape) -> wgpu::TextureViewDimension {
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

/// A device and its queue.
pub(super) struct Compute {
    pub adapter: Adapter,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    /// The driver's message when it lost the device, or on an error that no scope caught.
    lost: Arc<Mutex<Option<String>>>,
}

/// The features that are used where an adapter has them.
const FEATURES: Features = Features::PASSTHROUGH_SHADERS
    .union(Features::FLOAT32_BLENDABLE)
    .union(Features::FLOAT32_FILTERABLE)
    .union(Features::TEXTURE_FORMAT_16BIT_NORM)
    .union(Features::MAPPABLE_PRIMARY_BUFFERS)
    .union(Features::SHADER_F16)
    .union(Features::TIMESTAMP_QUERY);

/// How long a block may take. Even on an old processor it takes a fraction of a second, so what takes longer never ends.
const PATIENCE: core::time::Duration = core::time::Duration::from_secs(120);

impl Compute {
    /// Opens a device on an adapter.
    pub fn open(adapter: &wgpu::Adapter) -> Result<Compute, Fault> {
        let descriptor = wgpu::DeviceDescriptor {
            required_features: adapter.features() & FEATURES,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = block_on(adapter.request_device(&descriptor)).map_err(Fault::lost)?;
        let lost = Arc::new(Mutex::new(None));
        let (of_loss, of_error) = (lost.clone(), lost.clone());
        device.set_device_lost_callback(move |_, why| note(&of_loss, why));
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            note(&of_error, error.to_string());
        }));
        Ok(Compute {
            adapter: describe(adapter),
            device,
            queue,
            lost,
        })
    }

    /// Whether the device has these features.
    pub fn has(&self, features: Features) -> bool {
        self.device.features().contains(features)
    }

    /// Whether its memory is the processor's, so that results can be read where the shader wrote them.
    pub fn shares_memory(&self) -> bool {
        let shared = matches!(
            self.adapter.kind,
            AdapterKind::Software | AdapterKind::Integrated
        );
        shared && self.has(Features::MAPPABLE_PRIMARY_BUFFERS)
    }

    /// Does some work, and returns any error that it raised.
    pub fn guarded<T>(&self, work: impl FnOnce() -> T) -> Result<T, Fault> {
        let filters = [
            ErrorFilter::OutOfMemory,
            ErrorFilter::Internal,
            ErrorFilter::Validation,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let done = work();
        // Scopes end in reverse order.
        let mut errors = scopes.into_iter().rev().map(|scope| block_on(scope.pop()));
        let [validation, internal, memory] = [(); 3].map(|()| errors.next().flatten());
        if let Some(why) = memory {
            return Err(Fault::lost(why));
        }
        self.check_alive()?;
        match validation.or(internal) {
            Some(error) => Err(Fault::refused(error)),
            None => Ok(done),
        }
    }

    /// Waits for a submission.
    pub fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), Fault> {
        let wait = PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(PATIENCE),
        };
        match self.device.poll(wait) {
            Ok(_) => self.check_alive(),
            Err(wgpu::PollError::Timeout) => {
                // Dropping them would block forever.
                std::mem::forget((self.device.clone(), self.queue.clone()));
                let seconds = PATIENCE.as_secs();
                Err(Fault::lost(format!("no end within {seconds} seconds")))
            }
            Err(error) => Err(Fault::lost(error)),
        }
    }

    fn check_alive(&self) -> Result<(), Fault> {
        let lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.as_ref().map_or(Ok(()), |why| Err(Fault::lost(why)))
    }
}

/// Keeps the first reason.
fn note(lost: &Mutex<Option<String>>, why: String) {
    lost.lock()
        .unwrap_or_else(PoisonError::into_inner)
        .get_or_insert(why);
}
