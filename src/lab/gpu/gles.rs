//! Runs GLSL ES 3.00 as it is written: a vertex shader whose output is captured by transform feedback, exact to the bit.
#![allow(unsafe_code)]

use std::rc::Rc;

use glow::{HasContext, PixelUnpackData};

use super::egl::Context;
use super::program::{Argument, PointInputs, Program, ShaderCode, Uniform, check_fit};
use super::texture::{Texture, TextureFilter, TextureFormat, TextureShape, Wrap};
use crate::lab::fault::Fault;

/// The number of cosines in a draw.
const BLOCK: usize = 1 << 18;
/// Bytes of a result.
const RESULT: usize = 12;
/// The fragment shader that every program needs, although nothing is rasterised.
const FRAGMENT: &str = "#version 300 es\nvoid main() {}\n";
/// Bytes of four numbers.
const PLACE: usize = 16;
/// GL_RGBA16_EXT, of the extension GL_EXT_texture_norm16.
const RGBA16: u32 = 0x805B;
/// GL_CONTEXT_LOST, of the extension GL_KHR_robustness.
const CONTEXT_LOST: u32 = 0x0507;

/// A linked program in its context.
pub(super) struct Kernel {
    context: Rc<Context>,
    program: glow::Program,
    uniforms: Vec<Uniform>,
    texture: Option<TextureShape>,
    inputs: PointInputs,
}

/// The objects that a run needs on the device, deleted when the run ends.
struct Objects<'a> {
    gl: &'a glow::Context,
    array: glow::VertexArray,
    points: glow::Buffer,
    results: glow::Buffer,
    target: glow::Framebuffer,
    pixels: glow::Renderbuffer,
    table: Option<glow::Texture>,
}

impl Kernel {
    /// Compiles and links a program.
    pub fn new(
        context: &Rc<Context>,
        program: &Program,
        inputs: PointInputs,
    ) -> Result<Kernel, Fault> {
        let ShaderCode::Gles(text) = program.code else {
            let name = &context.adapter.name;
            return Err(Fault::unable(name, "anything but GLSL ES in OpenGL ES"));
        };
        let gl = context.enter()?;
        Ok(Kernel {
            program: link(gl, text, inputs)?,
            context: context.clone(),
            uniforms: program.uniforms.to_vec(),
            texture: program.texture,
            inputs,
        })
    }

    /// Runs over points, whose numbers follow each other point by point.
    pub fn run(
        &self,
        points: &[f32],
        uniforms: &[Uniform],
        texture: Option<&Texture>,
    ) -> Result<Vec<[f32; 3]>, Fault> {
        check_fit(&self.uniforms, uniforms, self.texture, texture)?;
        let gl = self.context.enter()?;
        let each = numbers(self.inputs);
        let most = (points.len() / each).min(BLOCK);
        let objects = Objects::new(gl, most, self.inputs).map_err(Fault::lost)?;
        // SAFETY: the context is current, and so are all names below.
        unsafe {
            gl.use_program(Some(self.program));
            self.set(gl, uniforms);
        }
        let objects = match texture {
            Some(texture) => objects.with(texture, &self.context)?,
            None => objects,
        };
        let mut results = Vec::with_capacity(points.len() / each);
        for block in points.chunks(BLOCK * each) {
            objects.draw(block, block.len() / each, &mut results);
            check(gl)?;
        }
        Ok(results)
    }

    /// Sets the arguments. One that the compiler found unused has no location and is skipped.
    unsafe fn set(&self, gl: &glow::Context, uniforms: &[Uniform]) {
        for uniform in uniforms {
            // SAFETY: the caller has made the context current, and the program.
            unsafe {
                let place = gl.get_uniform_location(self.program, &uniform.name);
                match uniform.value {
                    Argument::Scalar(value) => gl.uniform_1_f32(place.as_ref(), value),
                    Argument::Rgb([r, g, b]) => gl.uniform_3_f32(place.as_ref(), r, g, b),
                }
            }
        }
    }
}

impl Drop for Kernel {
    fn drop(&mut self) {
        if let Ok(gl) = self.context.enter() {
            // SAFETY: the context is current, and the program is its own.
            unsafe { gl.delete_program(self.program) };
        }
    }
}

impl<'a> Objects<'a> {
    /// Buffers for blocks of so many points, and a render target, without which every draw is an error.
    fn new(
        gl: &'a glow::Context,
        points: usize,
        inputs: PointInputs,
    ) -> Result<Objects<'a>, String> {
        let attributes = attributes(inputs).len();
        let stride = (numbers(inputs) * size_of::<f32>()) as i32;
        let size = (numbers(inputs) / attributes.max(1)) as i32;
        // SAFETY: the caller has made the context current. All sizes are those of the buffers they are for.
        unsafe {
            let objects = Objects {
                gl,
                array: gl.create_vertex_array()?,
                points: gl.create_buffer()?,
                results: gl.create_buffer()?,
                target: gl.create_framebuffer()?,
                pixels: gl.create_renderbuffer()?,
                table: None,
            };
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(objects.pixels));
            gl.renderbuffer_storage(glow::RENDERBUFFER, glow::RGBA8, 1, 1);
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(objects.target));
            gl.framebuffer_renderbuffer(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT0,
                glow::RENDERBUFFER,
                Some(objects.pixels),
            );
            gl.bind_vertex_array(Some(objects.array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(objects.points));
            for at in 0..attributes {
                let place = at as u32;
                gl.enable_vertex_attrib_array(place);
                let offset = (at * PLACE) as i32;
                gl.vertex_attrib_pointer_f32(place, size, glow::FLOAT, false, stride, offset);
            }
            gl.bind_buffer_base(glow::TRANSFORM_FEEDBACK_BUFFER, 0, Some(objects.results));
            let size = (points * RESULT) as i32;
            gl.buffer_data_size(glow::TRANSFORM_FEEDBACK_BUFFER, size, glow::STREAM_READ);
            gl.enable(glow::RASTERIZER_DISCARD);
            Ok(objects)
        }
    }

    /// These objects with a texture in unit 0, the default unit of a sampler.
    fn with(mut self, texture: &Texture, context: &Context) -> Result<Objects<'a>, Fault> {
        let gl = self.gl;
        let (internal, ty, needed) = match texture.format {
            TextureFormat::Half => (glow::RGBA16F, glow::HALF_FLOAT, None),
            TextureFormat::Float => (
                glow::RGBA32F,
                glow::FLOAT,
                Some("GL_OES_texture_float_linear"),
            ),
            TextureFormat::Unorm8 => (glow::RGBA8, glow::UNSIGNED_BYTE, None),
            TextureFormat::Unorm16 => (RGBA16, glow::UNSIGNED_SHORT, Some("GL_EXT_texture_norm16")),
            TextureFormat::Srgb8 => (glow::SRGB8_ALPHA8, glow::UNSIGNED_BYTE, None),
        };
        if let Some(needed) = needed.filter(|needed| !gl.supported_extensions().contains(*needed)) {
            return Err(Fault::unable(&context.adapter.name, needed));
        }
        let (width, rows) = (texture.width as i32, texture.height()? as i32);
        let (kind, sides, height) = match texture.shape {
            TextureShape::Flat => (glow::TEXTURE_2D, vec![glow::TEXTURE_2D], rows),
            TextureShape::Cube => (glow::TEXTURE_CUBE_MAP, cube_sides(), width),
        };
        let filter = match texture.filter {
            TextureFilter::Linear => glow::LINEAR,
            TextureFilter::Nearest => glow::NEAREST,
        };
        let bytes = texture.bytes();
        let wrap = match texture.wrap {
            Wrap::Clamp => glow::CLAMP_TO_EDGE,
            Wrap::Repeat => glow::REPEAT,
        };
        // SAFETY: the context is current. Rows are whole multiples of 4 bytes, so that the bytes are as many as are read.
        unsafe {
            let table = gl.create_texture().map_err(Fault::lost)?;
            self.table = Some(table);
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(kind, Some(table));
            for (side, rows) in sides.iter().zip(bytes.chunks(bytes.len() / sides.len())) {
                let pixels = PixelUnpackData::Slice(Some(rows));
                let internal = internal as i32;
                gl.tex_image_2d(*side, 0, internal, width, height, 0, glow::RGBA, ty, pixels);
            }
            for (name, value) in [
                (glow::TEXTURE_MIN_FILTER, filter),
                (glow::TEXTURE_MAG_FILTER, filter),
                (glow::TEXTURE_WRAP_S, wrap),
                (glow::TEXTURE_WRAP_T, wrap),
                (glow::TEXTURE_MAX_LEVEL, 0),
            ] {
                gl.tex_parameter_i32(kind, name, value as i32);
            }
        }
        check(gl).map(|()| self)
    }

    /// Draws so many points and reads the captured results.
    fn draw(&self, numbers: &[f32], points: usize, results: &mut Vec<[f32; 3]>) {
        let gl = self.gl;
        let bytes = bytemuck::cast_slice(numbers);
        let size = (points * RESULT) as i32;
        let caught = glow::TRANSFORM_FEEDBACK_BUFFER;
        // SAFETY: the context is current and the buffers are bound. What is mapped is as long as what was drawn, is read
        // before it is unmapped, and is looked at only where the driver gave an address.
        unsafe {
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytes, glow::STREAM_DRAW);
            gl.begin_transform_feedback(glow::POINTS);
            gl.draw_arrays(glow::POINTS, 0, points as i32);
            gl.end_transform_feedback();
            let mapped = gl.map_buffer_range(caught, 0, size, glow::MAP_READ_BIT);
            if !mapped.is_null() {
                let read = std::slice::from_raw_parts(mapped, size as usize);
                results.extend(bytemuck::pod_collect_to_vec::<u8, [f32; 3]>(read));
                gl.unmap_buffer(caught);
            }
        }
    }
}

impl Drop for Objects<'_> {
    fn drop(&mut self) {
        let gl = self.gl;
        // SAFETY: the context is current for as long as a run lasts, and the names are its own.
        unsafe {
            gl.delete_vertex_array(self.array);
            gl.delete_buffer(self.points);
            gl.delete_buffer(self.results);
            gl.delete_framebuffer(self.target);
            gl.delete_renderbuffer(self.pixels);
            self.table
                .into_iter()
                .for_each(|table| gl.delete_texture(table));
        }
    }
}

/// The names of a point's vertex attributes, in the order of their locations.
fn attributes(inputs: PointInputs) -> Vec<String> {
    match inputs {
        PointInputs::Places(places) => (0..places).map(|at| format!("fg_{at}")).collect(),
        PointInputs::Cosines | PointInputs::Bits => vec!["cos_theta".to_owned()],
    }
}

/// How many numbers a point has.
fn numbers(inputs: PointInputs) -> usize {
    match inputs {
        PointInputs::Places(places) => 4 * places,
        PointInputs::Cosines | PointInputs::Bits => 1,
    }
}

fn link(gl: &glow::Context, vertex: &str, inputs: PointInputs) -> Result<glow::Program, Fault> {
    let names = attributes(inputs);
    // SAFETY: the caller has made the context current.
    unsafe {
        let program = gl.create_program().map_err(Fault::lost)?;
        let linked = build(gl, program, vertex, FRAGMENT, || {
            for (place, name) in names.iter().enumerate() {
                gl.bind_attrib_location(program, place as u32, name);
            }
            gl.transform_feedback_varyings(program, &["reflectance"], glow::INTERLEAVED_ATTRIBS);
        });
        if linked.is_err() {
            gl.delete_program(program);
        }
        linked.map(|()| program)
    }
}

/// Compiles both shaders of a program, binds names, and links it.
pub(super) unsafe fn build(
    gl: &glow::Context,
    program: glow::Program,
    vertex: &str,
    fragment: &str,
    bind: impl FnOnce(),
) -> Result<(), Fault> {
    // SAFETY: the caller has made the context current.
    unsafe {
        for (ty, text) in [
            (glow::VERTEX_SHADER, vertex),
            (glow::FRAGMENT_SHADER, fragment),
        ] {
            let shader = gl.create_shader(ty).map_err(Fault::lost)?;
            gl.attach_shader(program, shader);
            // It is deleted with the program.
            gl.delete_shader(shader);
            gl.shader_source(shader, text);
            gl.compile_shader(shader);
            if !gl.get_shader_compile_status(shader) {
                return Err(Fault::refused(gl.get_shader_info_log(shader)));
            }
        }
        bind();
        gl.link_program(program);
        if gl.get_program_link_status(program) {
            Ok(())
        } else {
            Err(Fault::refused(gl.get_program_info_log(program)))
        }
    }
}

/// The sides of a cube, in the order in which a texture has them.
fn cube_sides() -> Vec<u32> {
    (0..6)
        .map(|side| glow::TEXTURE_CUBE_MAP_POSITIVE_X + side)
        .collect()
}

/// Reports the first error since the last check.
fn check(gl: &glow::Context) -> Result<(), Fault> {
    // SAFETY: the caller has made the context current.
    match unsafe { gl.get_error() } {
        glow::NO_ERROR => Ok(()),
        glow::OUT_OF_MEMORY => Err(Fault::lost("out of memory")),
        CONTEXT_LOST => Err(Fault::lost("the context was lost")),
        error => Err(Fault::refused(format!(
            "OpenGL ES gives error {error:#06x}"
        ))),
    }
}
