//! A draw in wgpu's terms: its layout, its pipeline, its render pass.

use wgpu::TextureFormat;

use super::super::compute::SUM;
use super::{Depth, Draw, FIRST_IMAGE, Image, Offscreen, VERTEX_FLOATS};

impl Offscreen {
    pub(super) fn group(
        &self,
        draw: &Draw,
        layout: &wgpu::BindGroupLayout,
        block: &wgpu::Buffer,
    ) -> wgpu::BindGroup {
        let views: Vec<wgpu::TextureView> = draw.images.iter().map(|image| image.view()).collect();
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let mut entries = vec![entry(0, block.as_entire_binding())];
        let samplers = (1..).zip(&self.samplers);
        entries.extend(samplers.map(|(i, of)| entry(i, wgpu::BindingResource::Sampler(of))));
        let images = (FIRST_IMAGE..).zip(&views);
        entries.extend(images.map(|(i, of)| entry(i, wgpu::BindingResource::TextureView(of))));
        let device = &self.compute.device;
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    pub(super) fn pipeline(
        &self,
        draw: &Draw,
        layout: &wgpu::BindGroupLayout,
    ) -> wgpu::RenderPipeline {
        let device = &self.compute.device;
        let module = self.compute.module(draw.text);
        let target = Some(wgpu::ColorTargetState {
            format: self.format,
            blend: draw.adds.then_some(SUM),
            write_mask: wgpu::ColorWrites::ALL,
        });
        let targets = vec![target; draw.targets.len()];
        let buffers = [Some(VERTEX)];
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: Some(
                &device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                    label: None,
                    bind_group_layouts: &[Some(layout)],
                    immediate_size: 0,
                }),
            ),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(draw.vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: match draw.mesh {
                    Ok(_) => &buffers,
                    Err(_) => &[],
                },
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: draw.depth.state(),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(draw.fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

impl Depth {
    fn state(self) -> Option<wgpu::DepthStencilState> {
        let compare = match self {
            Depth::Unused => return None,
            Depth::Nearest => wgpu::CompareFunction::Less,
            Depth::Farthest => wgpu::CompareFunction::Greater,
        };
        Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        })
    }

    /// The clear value of the depth buffer: farther, or nearer, than all surfaces.
    fn cleared(self) -> f32 {
        match self {
            Depth::Farthest => 0.0,
            Depth::Unused | Depth::Nearest => 1.0,
        }
    }
}

pub(super) fn pass(
    encoder: &mut wgpu::CommandEncoder,
    draw: &Draw,
    depth: Option<&Image>,
    pipeline: &wgpu::RenderPipeline,
    group: &wgpu::BindGroup,
) {
    let views: Vec<wgpu::TextureView> = draw.targets.iter().map(|image| image.view()).collect();
    let load = if draw.clears {
        wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
    } else {
        wgpu::LoadOp::Load
    };
    let attachment = |view| {
        Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            },
        })
    };
    let attachments: Vec<_> = views.iter().map(attachment).collect();
    let depth_view = depth.map(Image::view);
    let depth_of = |view| wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(draw.depth.cleared()),
            store: wgpu::StoreOp::Discard,
        }),
        stencil_ops: None,
    };
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &attachments,
        depth_stencil_attachment: depth_view.as_ref().map(depth_of),
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    match draw.mesh {
        Ok(mesh) => {
            pass.set_vertex_buffer(0, mesh.buffer.slice(..));
            pass.draw(0..mesh.vertices, 0..1);
        }
        Err(vertices) => pass.draw(0..vertices, 0..1),
    }
}

pub(super) const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

const VERTEX: wgpu::VertexBufferLayout = wgpu::VertexBufferLayout {
    array_stride: (VERTEX_FLOATS * size_of::<f32>()) as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2],
};

/// The layout of a draw's bindings.
pub(super) fn kinds(draw: &Draw) -> Vec<wgpu::BindGroupLayoutEntry> {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty,
        count: None,
    };
    let block = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let mut kinds = vec![entry(0, block), entry(1, sampler), entry(2, sampler)];
    let images = (FIRST_IMAGE..).zip(draw.images);
    kinds.extend(images.map(|(binding, image)| {
        let ty = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: image.dimension,
            multisampled: false,
        };
        entry(binding, ty)
    }));
    kinds
}
