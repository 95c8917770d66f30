//! The device of wgpu that programs run on, what is made on it, and its errors, which are values: none of them prints or panics.

use std::sync::{Arc, Mutex, PoisonError};

use pollster::block_on;
use wgpu::{
    BindingResource, BindingType, BufferBindingType, BufferUsages, ErrorFilter, Features, PollType,
};

use super::adapter::{Adapter, AdapterKind, describe};
use crate::lab::fault::Fault;

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

    /// A buffer of so many bytes.
    pub fn buffer(&self, size: u64, usage: BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// A buffer that holds these bytes.
    pub fn filled_buffer(&self, bytes: &[u8], usage: BufferUsages) -> wgpu::Buffer {
        // A buffer may not be empty, even if it is never read.
        let buffer = self.buffer(bytes.len().max(16) as u64, usage | BufferUsages::COPY_DST);
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    /// A two-dimensional texture of one level, or the six sides of a cube.
    pub fn texture(
        &self,
        size: wgpu::Extent3d,
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// A module of a text in WGSL.
    pub fn module(&self, text: &str) -> wgpu::ShaderModule {
        self.device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(text.into()),
            })
    }

    /// The layout of bindings, by their numbers in rising order.
    pub fn group_layout(
        &self,
        visibility: wgpu::ShaderStages,
        kinds: &[(u32, BindingType)],
    ) -> wgpu::BindGroupLayout {
        let entry = |(binding, ty): &(u32, BindingType)| wgpu::BindGroupLayoutEntry {
            binding: *binding,
            visibility,
            ty: *ty,
            count: None,
        };
        self.device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: None,
                entries: &kinds.iter().map(entry).collect::<Vec<_>>(),
            })
    }

    /// The layout of a pipeline with this one group.
    pub fn pipeline_layout(&self, group: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
        self.device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &[Some(group)],
                immediate_size: 0,
            })
    }

    /// What a program reads and writes, by the numbers of its bindings.
    pub fn bind_group<'a>(
        &self,
        layout: &wgpu::BindGroupLayout,
        resources: impl IntoIterator<Item = (u32, BindingResource<'a>)>,
    ) -> wgpu::BindGroup {
        let resources = resources.into_iter();
        let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &resources.map(entry).collect::<Vec<_>>(),
        })
    }

    /// A pipeline that draws by a text in WGSL with a vertex and a fragment entry point. Without a layout it is derived from the text.
    pub fn render_pipeline(
        &self,
        text: &str,
        [vertex, fragment]: [&str; 2],
        layout: Option<&wgpu::PipelineLayout>,
        buffers: &[Option<wgpu::VertexBufferLayout>],
        targets: &[Option<wgpu::ColorTargetState>],
        depth_stencil: Option<wgpu::DepthStencilState>,
    ) -> wgpu::RenderPipeline {
        let module = self.module(text);
        self.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: None,
                layout,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers,
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets,
                }),
                multiview_mask: None,
                cache: None,
            })
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

/// A colour target, which draws are added to or replace.
pub(super) fn colour_target(
    format: wgpu::TextureFormat,
    adds: bool,
) -> Option<wgpu::ColorTargetState> {
    let sum = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    let blend = wgpu::BlendState {
        color: sum,
        alpha: sum,
    };
    Some(wgpu::ColorTargetState {
        format,
        blend: adds.then_some(blend),
        write_mask: wgpu::ColorWrites::ALL,
    })
}

/// A uniform block as a binding.
pub(super) const UNIFORM_BLOCK: BindingType = buffer_binding(BufferBindingType::Uniform);

/// A buffer as a binding.
pub(super) const fn buffer_binding(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

/// A sampler that filters, as a binding.
pub(super) const SAMPLER: BindingType = BindingType::Sampler(wgpu::SamplerBindingType::Filtering);

/// A texture that is filtered, as a binding.
pub(super) fn texture_binding(view_dimension: wgpu::TextureViewDimension) -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension,
        multisampled: false,
    }
}
