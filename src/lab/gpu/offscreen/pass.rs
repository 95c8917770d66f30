//! A draw in wgpu's terms: its layout, its pipeline, its render pass.

use wgpu::{BindingResource, BindingType, TextureFormat};

use super::super::compute::{SAMPLER, UNIFORM_BLOCK, colour_target, texture_binding};
use super::{Depth, Draw, FIRST_IMAGE, Image, Offscreen, VERTEX_FLOATS};

impl Offscreen {
    pub(super) fn group(
        &self,
        draw: &Draw,
        layout: &wgpu::BindGroupLayout,
        block: &wgpu::Buffer,
    ) -> wgpu::BindGroup {
        let views: Vec<wgpu::TextureView> = draw.images.iter().map(|image| image.view()).collect();
        let block = [(0, block.as_entire_binding())].into_iter();
        let samplers = (1..).zip(self.samplers.iter().map(BindingResource::Sampler));
        let images = (FIRST_IMAGE..).zip(views.iter().map(BindingResource::TextureView));
        self.compute
            .bind_group(layout, block.chain(samplers).chain(images))
    }

    pub(super) fn pipeline(
        &self,
        draw: &Draw,
        layout: &wgpu::BindGroupLayout,
    ) -> wgpu::RenderPipeline {
        let targets = vec![colour_target(self.format, draw.adds); draw.targets.len()];
        let buffers: &[_] = match draw.mesh {
            Ok(_) => &[Some(VERTEX)],
            Err(_) => &[],
        };
        let (compute, entries) = (&self.compute, [draw.vertex, draw.fragment]);
        let layout = compute.pipeline_layout(layout);
        let depth = draw.depth.state();
        compute.render_pipeline(draw.text, entries, Some(&layout), buffers, &targets, depth)
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

/// The bindings of a draw.
pub(super) fn kinds(draw: &Draw) -> Vec<(u32, BindingType)> {
    let mut kinds = vec![(0, UNIFORM_BLOCK), (1, SAMPLER), (2, SAMPLER)];
    let images = draw.images.iter();
    kinds.extend((FIRST_IMAGE..).zip(images.map(|image| texture_binding(image.dimension))));
    kinds
}
