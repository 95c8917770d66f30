//! Pictures drawn to textures of floats and read back: meshes with a depth test, or triangles that cover the target.
//!
//! Every draw has its uniforms at binding 0, a sampler that clamps at 1, one that repeats along u at 2, and images from 3 on.
//! There is no other state: a draw names all that it reads and writes.

use std::rc::Rc;

use half::f16;
use wgpu::{
    BindingResource, BindingType, BufferUsages, Features, TextureFormat, TextureUsages,
    TextureViewDimension,
};

use super::compute::{Compute, SAMPLER, UNIFORM_BLOCK, colour_target, texture_binding};
use crate::lab::fault::Fault;

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

impl Offscreen {
    fn group(
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

    fn pipeline(&self, draw: &Draw, layout: &wgpu::BindGroupLayout) -> wgpu::RenderPipeline {
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

fn pass(
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

const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

const VERTEX: wgpu::VertexBufferLayout = wgpu::VertexBufferLayout {
    array_stride: (VERTEX_FLOATS * size_of::<f32>()) as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2],
};

/// The bindings of a draw.
fn kinds(draw: &Draw) -> Vec<(u32, BindingType)> {
    let mut kinds = vec![(0, UNIFORM_BLOCK), (1, SAMPLER), (2, SAMPLER)];
    let images = draw.images.iter();
    kinds.extend((FIRST_IMAGE..).zip(images.map(|image| texture_binding(image.dimension))));
    kinds
}

impl Offscreen {
    /// An image to draw to.
    ///
    /// # Errors
    /// It is larger than the device allows.
    pub fn target(&self, width: u32, height: u32) -> Result<Image, Fault> {
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        self.image([width, height, 1], self.format, usage)
    }

    /// An image with these texels, row by row, each rounded to binary16. Six squares are a cube map: +x, -x, +y, -y, +z, -z.
    ///
    /// # Errors
    /// It is larger than the device allows, or the texels do not fill it.
    pub fn upload(
        &self,
        [width, height, layers]: [u32; 3],
        texels: &[[f32; 4]],
    ) -> Result<Image, Fault> {
        if texels.len() as u64 != u64::from(width) * u64::from(height) * u64::from(layers) {
            return Err(Fault::refused("texels that do not fill their image"));
        }
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
        let image = self.image([width, height, layers], TextureFormat::Rgba16Float, usage)?;
        let halves = texels.iter().flatten();
        let bytes: Vec<u8> = halves
            .flat_map(|value| f16::from_f32(*value).to_ne_bytes())
            .collect();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * 8),
            rows_per_image: Some(height),
        };
        let whole = image.texture.as_image_copy();
        let size = image.texture.size();
        self.compute.guarded(|| {
            self.compute
                .queue
                .write_texture(whole, &bytes, layout, size)
        })?;
        Ok(image)
    }

    fn image(
        &self,
        [width, height, layers]: [u32; 3],
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<Image, Fault> {
        let most = self.compute.device.limits().max_texture_dimension_2d;
        if !(1..=most).contains(&width) || !(1..=most).contains(&height) {
            let what = format!("an image of {width} x {height} pixels; at most {most} a side");
            return Err(Fault::unable(&self.compute.adapter.name, what));
        }
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        };
        let texture = self
            .compute
            .guarded(|| self.compute.texture(size, format, usage))?;
        let dimension = match layers {
            6 => TextureViewDimension::Cube,
            _ => TextureViewDimension::D2,
        };
        Ok(Image { texture, dimension })
    }

    /// The texels of a target, row by row.
    ///
    /// # Errors
    /// The device is lost.
    pub fn read(&self, image: &Image) -> Result<Vec<[f32; 4]>, Fault> {
        let (compute, size) = (&self.compute, image.texture.size());
        let is_half = self.format == TextureFormat::Rgba16Float;
        let row = size.width * if is_half { 8 } else { 16 };
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let (buffer, submission) = compute.guarded(|| {
            let buffer = compute.buffer(
                u64::from(padded) * u64::from(size.height),
                BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            );
            let mut encoder = compute.device.create_command_encoder(&Default::default());
            let into = wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            };
            encoder.copy_texture_to_buffer(image.texture.as_image_copy(), into, size);
            let submission = compute.queue.submit([encoder.finish()]);
            buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
            (buffer, submission)
        })?;
        compute.wait(submission)?;
        let bytes = buffer.slice(..).get_mapped_range().map_err(Fault::lost)?;
        let rows = bytes.chunks_exact(padded as usize);
        let rows = rows.map(|padded| &padded[..row as usize]);
        Ok(rows.flat_map(|row| texels(row, is_half)).collect())
    }
}

impl Image {
    fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(self.dimension),
            ..Default::default()
        })
    }
}

/// The texels of a row.
fn texels(row: &[u8], is_half: bool) -> Vec<[f32; 4]> {
    let numbers: Vec<f32> = if is_half {
        row.chunks_exact(2)
            .map(|bytes| f16::from_ne_bytes([bytes[0], bytes[1]]).to_f32())
            .collect()
    } else {
        bytemuck::pod_collect_to_vec(row)
    };
    let four = |four: &[f32]| [four[0], four[1], four[2], four[3]];
    numbers.chunks_exact(4).map(four).collect()
}
