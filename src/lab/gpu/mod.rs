//! Shaders run on a real graphics stack: cosines in, reflectances out.
//!
//! A [`Device`] is chosen among those of the machine. It takes a [`Program`] and gives a [`Kernel`], which is run over cosines,
//! or a [`Stream`], which is run over all numbers of a range without uploading them. WGSL and SPIR-V run as compute shaders
//! through wgpu (Vulkan, Metal, Direct3D 12, OpenGL). GLSL ES 3.00 runs as a vertex shader in a context of exactly that version.
//! Its results are captured by transform feedback, exact to the bit.
//!
//! No driver library is linked. A missing one is a [`Fault::Absent`] that says what to install, never a result.

mod adapter;
mod canvas;
mod compute;
mod egl;
mod gles;
mod gles_compiler;
mod kernel;
mod offscreen;
mod program;
mod quiet;
pub mod spirv;
mod texture;
mod vulkan_compiler;

use std::rc::Rc;

use crate::lab::fault::Fault;
use compute::Compute;
use program::PointInputs;

pub use adapter::{Adapter, AdapterKind, Backend, Wanted};
pub use canvas::{Canvas, Layer, Shader};
pub use gles_compiler::GlesCompiler;
pub use kernel::Stream;
pub use offscreen::{Depth, Draw, Image, Mesh, Offscreen, VERTEX_FLOATS};
pub use program::{Argument, Program, ShaderCode, Uniform};
pub use texture::{Texture, TextureFilter, TextureFormat, TextureShape, Wrap};
pub use vulkan_compiler::{ModuleEntry, VulkanCompiler};

/// A device that shaders are run on. It stays on its thread.
pub struct Device {
    /// Its description.
    pub adapter: Adapter,
    stack: Stack,
}

enum Stack {
    Compute(Rc<Compute>),
    Gles(Rc<egl::Context>),
}

/// A program ready to run.
pub struct Kernel(Prepared);

/// A program of many arguments, ready to run.
pub struct Batch {
    prepared: Prepared,
    places: usize,
}

enum Prepared {
    Compute(kernel::Kernel),
    Gles(gles::Kernel),
}

/// All devices here that can run shaders.
pub fn adapters() -> Vec<Adapter> {
    let gles = egl::Context::open().map(|context| context.adapter.clone());
    adapter::all().chain(gles).collect()
}

impl Device {
    /// Opens the requested device. Of several it is the fastest by its kind.
    ///
    /// # Errors
    /// There is none, and the fault says what there is, or what to install.
    pub fn open(wanted: &Wanted) -> Result<Device, Fault> {
        if wanted.backend == Some(Backend::Gles) {
            return Device::gles();
        }
        let found = adapter::choose(wanted)?;
        let compute = Compute::open(found)?;
        Ok(Device {
            adapter: compute.adapter.clone(),
            stack: Stack::Compute(Rc::new(compute)),
        })
    }

    /// Opens OpenGL ES 3.0, for GLSL ES.
    ///
    /// # Errors
    /// There is none, and the fault says what to install.
    pub fn gles() -> Result<Device, Fault> {
        let context = egl::Context::open()?;
        Ok(Device {
            adapter: context.adapter.clone(),
            stack: Stack::Gles(Rc::new(context)),
        })
    }

    /// Whether it computes in 16 bits where a text says so. In OpenGL ES that is left to the driver.
    pub fn has_half(&self) -> bool {
        match &self.stack {
            Stack::Compute(compute) => compute.has(wgpu::Features::SHADER_F16),
            Stack::Gles(_) => true,
        }
    }

    /// A square target for full-screen shaders, with so many pixels per side.
    ///
    /// # Errors
    /// It is larger than the device allows, or the device does not draw here: OpenGL ES does not.
    pub fn canvas(&self, pixels: u32) -> Result<Canvas, Fault> {
        Canvas::new(self.compute("drawing in OpenGL ES")?, pixels)
    }

    /// A device for drawing to textures of floats, which are read back.
    ///
    /// # Errors
    /// The device does not draw here: OpenGL ES does not.
    pub fn offscreen(&self) -> Result<Offscreen, Fault> {
        Offscreen::new(self.compute("drawing in OpenGL ES")?)
    }

    /// The device of wgpu. `what` is what OpenGL ES cannot do in its place.
    fn compute(&self, what: &str) -> Result<&Rc<Compute>, Fault> {
        match &self.stack {
            Stack::Compute(compute) => Ok(compute),
            Stack::Gles(_) => Err(Fault::unable(&self.adapter.name, what)),
        }
    }

    /// Compiles a program.
    ///
    /// # Errors
    /// It does not compile, or not for this device.
    pub fn prepare(&self, program: &Program) -> Result<Kernel, Fault> {
        self.prepared(program, PointInputs::Cosines).map(Kernel)
    }

    /// Compiles a program of many arguments. Each point has so many groups of four numbers, in binding 1 as
    /// `var<storage, read> points: array<vec4<f32>>`, in OpenGL ES as attributes `fg_0`, `fg_1` and so on.
    ///
    /// # Errors
    /// It does not compile, or not for this device.
    pub fn prepare_batch(&self, program: &Program, places: usize) -> Result<Batch, Fault> {
        let prepared = self.prepared(program, PointInputs::Places(places))?;
        Ok(Batch { prepared, places })
    }

    fn prepared(&self, program: &Program, inputs: PointInputs) -> Result<Prepared, Fault> {
        Ok(match &self.stack {
            Stack::Compute(compute) => {
                Prepared::Compute(kernel::Kernel::new(compute, program, inputs)?)
            }
            Stack::Gles(context) => Prepared::Gles(gles::Kernel::new(context, program, inputs)?),
        })
    }

    /// Compiles a program whose binding 1 is `var<uniform> first: u32`, the bits of the block's first number.
    ///
    /// # Errors
    /// It does not compile, or not for this device: OpenGL ES has no streams.
    pub fn prepare_stream(&self, program: &Program) -> Result<Stream, Fault> {
        let compute = self.compute("a stream in OpenGL ES")?;
        kernel::Kernel::new(compute, program, PointInputs::Bits).map(Stream)
    }
}

impl Kernel {
    /// The reflectance at each cosine. The arguments are those that the program was prepared for, with their values.
    ///
    /// # Errors
    /// Arguments or texture do not fit the program or the device, or the device is lost.
    pub fn run(
        &self,
        cosines: &[f32],
        uniforms: &[Uniform],
        texture: Option<&Texture>,
    ) -> Result<Vec<[f32; 3]>, Fault> {
        match &self.0 {
            Prepared::Compute(kernel) => {
                let mut results = Vec::with_capacity(cosines.len());
                kernel.run(cosines, uniforms, texture, |block| {
                    results.extend(block.iter().map(|&[r, g, b, _]| [r, g, b]));
                })?;
                Ok(results)
            }
            Prepared::Gles(kernel) => kernel.run(cosines, uniforms, texture),
        }
    }
}

impl Batch {
    /// The result at each point. `places` holds the arguments point by point, in groups of four numbers.
    ///
    /// # Errors
    /// The texture does not fit the program or the device, or the device is lost.
    pub fn run(
        &self,
        points: &[[f32; 4]],
        texture: Option<&Texture>,
    ) -> Result<Vec<[f32; 3]>, Fault> {
        match &self.prepared {
            Prepared::Compute(kernel) => {
                let mut results = Vec::with_capacity(points.len() / self.places);
                kernel.run_batch(points, self.places, texture, |block| {
                    results.extend(block.iter().map(|&[x, y, z, _]| [x, y, z]));
                })?;
                Ok(results)
            }
            Prepared::Gles(kernel) => kernel.run(bytemuck::cast_slice(points), &[], texture),
        }
    }
}
