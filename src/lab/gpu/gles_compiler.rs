//! A context of OpenGL ES on a device's render node that keeps the driver's debug messages. If told to, Mesa reports statistics
//! of every compiled shader in them. Nothing is drawn, so a stand-in for the kernel driver is enough.
#![allow(unsafe_code)]

use std::ffi::{c_int, c_void};
use std::fs::File;
use std::os::fd::AsRawFd;
use std::sync::{Arc, Mutex, PoisonError};

use glow::HasContext;
use khronos_egl as egl;

use super::egl::{Egl, absent, functions, initialize, library};
use super::gles::build;
use crate::lab::fault::Fault;

/// A context on a render node. It lives as long as the process.
pub struct GlesCompiler {
    /// The driver's name of the device.
    pub name: String,
    /// The version of OpenGL ES and of the driver.
    pub driver: String,
    gl: glow::Context,
    remarks: Arc<Mutex<Vec<String>>>,
}

/// The render node of the first device.
const PATH: &str = "/dev/dri/renderD128";
/// `EGL_PLATFORM_GBM_KHR`, of the extension EGL_KHR_platform_gbm.
const PLATFORM_GBM: egl::Enum = 0x31D7;
/// `EGL_CONTEXT_FLAGS_KHR` and `EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR`, of the extension EGL_KHR_create_context. Older drivers have no
/// other way to ask for debug messages.
const CONTEXT_FLAGS: egl::Int = 0x30FC;
const DEBUG_BIT: egl::Int = 1;
/// The location of the vertex attribute.
const CORNER: u32 = 0;

impl GlesCompiler {
    /// Opens the node with a context of this version of OpenGL ES, or a later one that takes its shaders.
    ///
    /// # Errors
    /// There is no node, or its driver gives no context.
    pub fn open(major: i32) -> Result<GlesCompiler, Fault> {
        let egl = library()?;
        let display = display(egl)?;
        initialize(egl, display)?;
        let context = context(egl, display, major)?;
        let mut gl = functions(egl, display, context)?;
        let remarks = Arc::new(Mutex::new(Vec::new()));
        listen(&mut gl, remarks.clone());
        // SAFETY: the context is current.
        let text = |name| unsafe { gl.get_parameter_string(name) };
        Ok(GlesCompiler {
            name: text(glow::RENDERER),
            driver: text(glow::VERSION),
            gl,
            remarks,
        })
    }

    /// Compiles and links a program, and returns the driver's debug messages. The vertex attribute is `fg_corner`.
    ///
    /// # Errors
    /// The driver refuses it, with this message.
    pub fn link(&self, vertex: &str, fragment: &str) -> Result<Vec<String>, Fault> {
        self.take();
        // SAFETY: the context is current on this thread, and the program is its own.
        unsafe {
            let program = self.gl.create_program().map_err(Fault::lost)?;
            let linked = build(&self.gl, program, vertex, fragment, || {
                self.gl.bind_attrib_location(program, CORNER, "fg_corner");
            });
            self.gl.delete_program(program);
            linked?;
        }
        Ok(self.take())
    }

    fn take(&self) -> Vec<String> {
        let mut remarks = self.remarks.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(&mut *remarks)
    }
}

/// Keeps the driver's debug messages.
fn listen(gl: &mut glow::Context, remarks: Arc<Mutex<Vec<String>>>) {
    let keep = move |_source, _type, _id, _severity, text: &str| {
        let mut kept = remarks.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push(text.to_owned());
    };
    // SAFETY: the context is current; the function belongs to it.
    unsafe {
        gl.enable(glow::DEBUG_OUTPUT);
        gl.enable(glow::DEBUG_OUTPUT_SYNCHRONOUS);
        gl.debug_message_callback(keep);
    }
}

/// The display of a render node, through the library that allocates its buffers.
fn display(egl: &Egl) -> Result<egl::Display, Fault> {
    let node = File::options().read(true).write(true).open(PATH);
    let node = node.map_err(|error| absent(format!("{PATH}: {error}")))?;
    type Create = unsafe extern "C" fn(c_int) -> *mut c_void;
    // SAFETY: a library of this name is Mesa's GBM, and its function has had this signature since the first version. The
    // device, the node and the library are never given back.
    unsafe {
        let gbm = libloading::Library::new("libgbm.so.1").map_err(absent)?;
        let create = gbm.get::<Create>(b"gbm_create_device\0").map_err(absent)?;
        let device = create(node.as_raw_fd());
        std::mem::forget(node);
        std::mem::forget(gbm);
        if device.is_null() {
            return Err(absent(format!("{PATH} has no driver")));
        }
        egl.get_platform_display(PLATFORM_GBM, device, &[egl::ATTRIB_NONE])
            .map_err(absent)
    }
}

/// A debug context.
fn context(egl: &Egl, display: egl::Display, major: i32) -> Result<egl::Context, Fault> {
    // SAFETY: EGL_NO_CONFIG_KHR is the null pointer. It is never dereferenced.
    let no_config = unsafe { egl::Config::from_ptr(std::ptr::null_mut()) };
    let wanted = [
        egl::CONTEXT_MAJOR_VERSION,
        major,
        CONTEXT_FLAGS,
        DEBUG_BIT,
        egl::NONE,
    ];
    egl.create_context(display, no_config, None, &wanted)
        .map_err(absent)
}
