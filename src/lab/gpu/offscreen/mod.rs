//! Pictures drawn to textures of floats and read back: meshes with a depth test, or triangles that cover the target.
//!
//! Every draw has its uniforms at binding 0, a sampler that clamps at 1, one that repeats along u at 2, and images from 3 on.
//! There is no other state: a draw names all that it reads and writes.

mod image;
mod pass;

use std::rc::Rc;

use wgpu::{BufferUsages, Features, TextureFormat, TextureUsages, TextureViewDimension};

use super::compute::Compute;
use crate::lab::fault::Fault;
use pass::{DEPTH_FORMAT, kinds, pass};

/// The numbers of a vertex: position, normal, tangent with the bitangent's sign, texture coordinates.
pub const VERTEX_FLOATS: usize = 12;

/// The binding of the first image.
const FIRST_IMAGE: u32 = 3;

/// A device that draws to images.
pub struct Offscreen {
    compute: Rc<Compute>,
    /// binary32 where the device filters and blends it, otherwise binary16.
    format: TextureFormat,
    samplers: [wgpu::Sampler; 2],
}

/// A texture of four floats.
pub struct Image {
    texture: wgpu::Texture,
    dimension: TextureViewDimension,
}

/// Triangles, three vertices each.
pub struct Mesh {
    buffer: wgpu::Buffer,
    vertices: u32,
}

/// The depth test: which of several surfaces a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// The one that is drawn last.
    Unused,
    /// The nearest.
    Nearest,
    /// The farthest: the back of a body.
    Farthest,
}

/// A draw.
pub struct Draw<'a> {
    /// The module in WGSL.
    pub text: &'a str,
    /// The vertex entry point.
    pub vertex: &'a str,
    /// The fragment entry point.
    pub fragment: &'a str,
    /// The bytes of the uniform block at binding 0.
    pub uniforms: &'a [u8],
    /// The images that it reads.
    pub images: &'a [&'a Image],
    /// The mesh, or a number of vertices that the entry point generates itself.
    pub mesh: Result<&'a Mesh, u32>,
    /// The images that it writes, all of one size.
    pub targets: &'a [&'a Image],
    /// Whether the targets are cleared to zero before.
    pub clears: bool,
    /// The depth test.
    pub depth: Depth,
    /// Whether it is blended additively.
    pub adds: bool,
}

impl Offscreen {
    pub(super) fn new(compute: &Rc<Compute>) -> Result<Offscreen, Fault> {
        let all = Features::FLOAT32_FILTERABLE | Features::FLOAT32_BLENDABLE;
        let format = if compute.has(all) {
            TextureFormat::Rgba32Float
        } else {
            TextureFormat::Rgba16Float
        };
        let along_u = [wgpu::AddressMode::ClampToEdge, wgpu::AddressMode::Repeat];
        let sampler = |address_mode_u| {
            compute.device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            })
        };
        let samplers = compute.guarded(|| along_u.map(sampler))?;
        Ok(Offscreen {
            compute: compute.clone(),
            format,
            samplers,
        })
    }

    /// Triangles of vertices of [`VERTEX_FLOATS`] numbers.
    ///
    /// # Errors
    /// The device does not accept them.
    pub fn mesh(&self, vertices: &[[f32; VERTEX_FLOATS]]) -> Result<Mesh, Fault> {
        let bytes: &[u8] = bytemuck::cast_slice(vertices);
        let buffer = self.buffer(bytes, BufferUsages::VERTEX)?;
        let vertices = u32::try_from(vertices.len()).map_err(Fault::refused)?;
        Ok(Mesh { buffer, vertices })
    }

    fn buffer(&self, bytes: &[u8], usage: BufferUsages) -> Result<wgpu::Buffer, Fault> {
        self.compute
            .guarded(|| self.compute.filled_buffer(bytes, usage))
    }

    /// Draws, and waits for it.
    ///
    /// # Errors
    /// The text does not compile or does not fit its inputs, or the device is lost.
    pub fn draw(&self, draw: &Draw) -> Result<(), Fault> {
        let (compute, device) = (&self.compute, &self.compute.device);
        let block = self.buffer(draw.uniforms, BufferUsages::UNIFORM)?;
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let layout = compute.guarded(|| compute.group_layout(stages, &kinds(draw)))?;
        let pipeline = compute.guarded(|| self.pipeline(draw, &layout))?;
        let depth = match (draw.depth, draw.targets.first()) {
            (Depth::Unused, _) | (_, None) => None,
            (_, Some(target)) => {
                let size = target.texture.size();
                let usage = TextureUsages::RENDER_ATTACHMENT;
                Some(self.image([size.width, size.height, 1], DEPTH_FORMAT, usage)?)
            }
        };
        let submission = compute.guarded(|| {
            let group = self.group(draw, &layout, &block);
            let mut encoder = device.create_command_encoder(&Default::default());
            pass(&mut encoder, draw, depth.as_ref(), &pipeline, &group);
            compute.queue.submit([encoder.finish()])
        })?;
        compute.wait(submission)
    }
}
