//! Full-screen shaders drawn over each other into one target, to measure their time, by the device's timestamps where it has them.
//!
//! A blended layer is added to those below, so that none of its draws can be skipped. The target holds half floats, like those of
//! scenes.

use std::rc::Rc;

use wgpu::{BindingResource, BufferUsages, Features};

use super::adapter::Adapter;
use super::compute::{Compute, colour_target};
use super::texture::{self, Texture};
use crate::lab::fault::Fault;

/// The format of the target. Half floats can be blended on all devices.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// The bytes of the two timestamps of a pass.
const STAMPS: u64 = 2 * wgpu::QUERY_SIZE as u64;

/// A square target.
pub struct Canvas {
    compute: Rc<Compute>,
    view: wgpu::TextureView,
    pixels: u32,
    stamps: Option<Stamps>,
}

/// A shader to be drawn: text in WGSL with both entry points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shader<'a> {
    /// The module.
    pub text: &'a str,
    /// The vertex entry point. Its three vertices make a triangle that covers the target.
    pub vertex: &'a str,
    /// The fragment entry point.
    pub fragment: &'a str,
    /// The bytes of the uniform block at binding 0. Empty if there is none.
    pub uniforms: &'a [u8],
    /// The texture at binding 3, with its sampler at 4.
    pub texture: Option<&'a Texture<'a>>,
    /// Whether it is added to the layers below, or replaces them.
    pub blends: bool,
}

/// A shader ready to be drawn.
pub struct Layer {
    pipeline: wgpu::RenderPipeline,
    group: Option<wgpu::BindGroup>,
}

/// The queries and buffers of the timestamps at both ends of a pass.
struct Stamps {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
    nanoseconds: f64,
}

impl Canvas {
    pub(super) fn new(compute: &Rc<Compute>, pixels: u32) -> Result<Canvas, Fault> {
        let most = compute.device.limits().max_texture_dimension_2d;
        if pixels == 0 || pixels > most {
            let what = format!("a target of {pixels} pixels a side; at most {most}");
            return Err(Fault::unable(&compute.adapter.name, what));
        }
        let (view, stamps) = compute.guarded(|| {
            let stamps = compute.has(Features::TIMESTAMP_QUERY);
            (
                target(compute, pixels),
                stamps.then(|| Stamps::new(compute)),
            )
        })?;
        Ok(Canvas {
            compute: compute.clone(),
            view,
            pixels,
            stamps,
        })
    }

    /// The device that draws.
    pub fn adapter(&self) -> &Adapter {
        &self.compute.adapter
    }

    /// Whether it computes in 16 bits where a text says so.
    pub fn has_half(&self) -> bool {
        self.compute.has(Features::SHADER_F16)
    }

    /// The number of pixels in the target.
    pub fn pixels(&self) -> u64 {
        u64::from(self.pixels).pow(2)
    }

    /// Compiles a shader and uploads its inputs.
    ///
    /// # Errors
    /// It does not compile, or not for this device.
    pub fn layer(&self, shader: &Shader) -> Result<Layer, Fault> {
        let compute = &*self.compute;
        let table = shader
            .texture
            .map(|texture| texture::table(compute, texture));
        let table = table.transpose()?;
        compute.guarded(|| {
            let targets = [colour_target(FORMAT, shader.blends)];
            let entries = [shader.vertex, shader.fragment];
            let pipeline = compute.render_pipeline(shader.text, entries, None, &[], &targets, None);
            let group = bound(compute, &pipeline, shader.uniforms, table.as_ref());
            Layer { pipeline, group }
        })
    }

    /// Records one pass that draws each layer so many times.
    ///
    /// # Errors
    /// The device does not accept it.
    pub fn record(&self, layers: &[(&Layer, u32)]) -> Result<wgpu::CommandBuffer, Fault> {
        let device = &self.compute.device;
        self.compute.guarded(|| {
            let mut encoder = device.create_command_encoder(&Default::default());
            self.pass(&mut encoder, layers);
            if let Some(stamps) = &self.stamps {
                stamps.resolve(&mut encoder);
            }
            encoder.finish()
        })
    }

    /// Draws what was recorded, and waits for it.
    ///
    /// # Errors
    /// The device is lost.
    pub fn draw(&self, recorded: wgpu::CommandBuffer) -> Result<(), Fault> {
        let submission = self
            .compute
            .guarded(|| self.compute.queue.submit([recorded]))?;
        self.compute.wait(submission)
    }

    /// The nanoseconds that the last drawing took by the device's timestamps, where it has them.
    ///
    /// # Errors
    /// The device is lost.
    pub fn nanoseconds(&self) -> Result<Option<f64>, Fault> {
        let read = |stamps: &Stamps| stamps.read(&self.compute);
        self.stamps.as_ref().map(read).transpose()
    }

    fn pass(&self, encoder: &mut wgpu::CommandEncoder, layers: &[(&Layer, u32)]) {
        let stamps = |stamps| wgpu::RenderPassTimestampWrites {
            query_set: stamps,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            timestamp_writes: self.stamps.as_ref().map(|s| stamps(&s.set)),
            ..Default::default()
        });
        for (layer, draws) in layers {
            pass.set_pipeline(&layer.pipeline);
            pass.set_bind_group(0, &layer.group, &[]);
            for _ in 0..*draws {
                pass.draw(0..3, 0..1);
            }
        }
    }
}

impl Stamps {
    fn new(compute: &Compute) -> Stamps {
        let buffer = |usage| compute.buffer(STAMPS, usage | BufferUsages::COPY_DST);
        Stamps {
            set: compute.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
            read: buffer(BufferUsages::MAP_READ),
            nanoseconds: f64::from(compute.queue.get_timestamp_period()),
        }
    }

    fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.set, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read, 0, STAMPS);
    }

    /// The time between both timestamps in nanoseconds. 0 where the clock stands still or runs backwards.
    fn read(&self, compute: &Compute) -> Result<f64, Fault> {
        let whole = self.read.slice(..);
        compute.guarded(|| whole.map_async(wgpu::MapMode::Read, |_| {}))?;
        compute
            .device
            .poll(wgpu::PollType::Poll)
            .map_err(Fault::lost)?;
        let ticks = {
            let bytes = whole.get_mapped_range().map_err(Fault::lost)?;
            let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
            stamps[1].saturating_sub(stamps[0])
        };
        self.read.unmap();
        Ok(ticks as f64 * self.nanoseconds)
    }
}

fn target(compute: &Compute, pixels: u32) -> wgpu::TextureView {
    let size = wgpu::Extent3d {
        width: pixels,
        height: pixels,
        depth_or_array_layers: 1,
    };
    let made = compute.texture(size, FORMAT, wgpu::TextureUsages::RENDER_ATTACHMENT);
    made.create_view(&wgpu::TextureViewDescriptor::default())
}

/// The bind group of a pipeline, where it reads anything. Its layout is derived from its text.
fn bound(
    compute: &Compute,
    pipeline: &wgpu::RenderPipeline,
    uniforms: &[u8],
    table: Option<&(wgpu::TextureView, wgpu::Sampler)>,
) -> Option<wgpu::BindGroup> {
    let block =
        (!uniforms.is_empty()).then(|| compute.filled_buffer(uniforms, BufferUsages::UNIFORM));
    let mut resources = Vec::new();
    if let Some(block) = &block {
        resources.push((0, block.as_entire_binding()));
    }
    if let Some((view, sampler)) = table {
        resources.push((3, BindingResource::TextureView(view)));
        resources.push((4, BindingResource::Sampler(sampler)));
    }
    let layout = || pipeline.get_bind_group_layout(0);
    (!resources.is_empty()).then(|| compute.bind_group(&layout(), resources))
}
