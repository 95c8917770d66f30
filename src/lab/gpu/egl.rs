//! An OpenGL ES 3.0 context without a window, through the machine's EGL library.
#![allow(unsafe_code)]

use std::sync::OnceLock;

use glow::HasContext;
use khronos_egl as egl;

use super::adapter::{Adapter, AdapterKind, Backend, OPENGL_PACKAGES};
use super::quiet::hush;
use crate::lab::fault::Fault;

pub(super) type Egl = egl::DynamicInstance<egl::EGL1_5>;

/// A context with its functions. Nothing may use [`Context::gl`] before [`Context::enter`] has made it current.
pub(super) struct Context {
    egl: &'static Egl,
    display: egl::Display,
    context: egl::Context,
    /// The description of its device.
    pub adapter: Adapter,
    pub gl: glow::Context,
}

/// `EGL_PLATFORM_SURFACELESS_MESA`, of the extension EGL_MESA_platform_surfaceless.
const SURFACELESS: egl::Enum = 0x31DD;

impl Context {
    /// Opens a context.
    pub fn open() -> Result<Context, Fault> {
        hush();
        let egl = library()?;
        let display = display(egl)?;
        initialize(egl, display)?;
        let context = create(egl, display)?;
        let gl = functions(egl, display, context)?;
        Ok(Context {
            egl,
            display,
            context,
            adapter: describe(&gl),
            gl,
        })
    }

    /// Makes it current on this thread, where another may be current.
    pub fn enter(&self) -> Result<&glow::Context, Fault> {
        self.egl.bind_api(egl::OPENGL_ES_API).map_err(Fault::lost)?;
        enter(self.egl, self.display, self.context).map_err(Fault::lost)?;
        Ok(&self.gl)
    }
}

impl Drop for Context {
    /// The display is kept: it belongs to the process, and others may have contexts on it.
    fn drop(&mut self) {
        if self.egl.get_current_context() == Some(self.context) {
            let _ = self.egl.make_current(self.display, None, None, None);
        }
        let _ = self.egl.destroy_context(self.display, self.context);
    }
}

/// The library, loaded once and never unloaded: drivers leave handlers behind that run when the program ends.
pub(super) fn library() -> Result<&'static Egl, Fault> {
    static LIBRARY: OnceLock<Result<Egl, String>> = OnceLock::new();
    // SAFETY: a library of this name is EGL; loading it runs its initialisers.
    let load = || unsafe { Egl::load_required().map_err(|error| error.to_string()) };
    LIBRARY.get_or_init(load).as_ref().map_err(absent)
}

/// The display without windows, or the default one.
fn display(egl: &Egl) -> Result<egl::Display, Fault> {
    let none = [egl::ATTRIB_NONE];
    // SAFETY: these displays take no pointer; that of the platform must be the default.
    unsafe {
        egl.get_platform_display(SURFACELESS, egl::DEFAULT_DISPLAY, &none)
            .ok()
            .or_else(|| egl.get_display(egl::DEFAULT_DISPLAY))
            .ok_or_else(|| absent("no display"))
    }
}

/// A context of version 3.0, without a configuration, which only surfaces need, or otherwise with the first that fits.
fn create(egl: &Egl, display: egl::Display) -> Result<egl::Context, Fault> {
    let version = [
        egl::CONTEXT_MAJOR_VERSION,
        3,
        egl::CONTEXT_MINOR_VERSION,
        0,
        egl::NONE,
    ];
    // SAFETY: EGL_NO_CONFIG_KHR is the null pointer. It is never dereferenced.
    let no_config = unsafe { egl::Config::from_ptr(std::ptr::null_mut()) };
    if let Ok(context) = egl.create_context(display, no_config, None, &version) {
        return Ok(context);
    }
    let wanted = [egl::RENDERABLE_TYPE, egl::OPENGL_ES3_BIT, egl::NONE];
    let config = egl
        .choose_first_config(display, &wanted)
        .map_err(absent)?
        .ok_or_else(|| absent("no configuration for OpenGL ES 3"))?;
    egl.create_context(display, config, None, &version)
        .map_err(absent)
}

/// Prepares a display for OpenGL ES.
pub(super) fn initialize(egl: &Egl, display: egl::Display) -> Result<(), Fault> {
    egl.initialize(display).map_err(absent)?;
    egl.bind_api(egl::OPENGL_ES_API).map_err(absent)
}

/// The functions of a context, which becomes current.
pub(super) fn functions(
    egl: &Egl,
    display: egl::Display,
    context: egl::Context,
) -> Result<glow::Context, Fault> {
    enter(egl, display, context)?;
    let address = |name: &str| {
        let function = egl.get_proc_address(name);
        function.map_or(std::ptr::null(), |function| function as *const _)
    };
    // SAFETY: the context is current, and EGL 1.5 gives the address of every function, of the core too.
    Ok(unsafe { glow::Context::from_loader_function(address) })
}

fn enter(egl: &Egl, display: egl::Display, context: egl::Context) -> Result<(), Fault> {
    egl.make_current(display, None, None, Some(context))
        .map_err(absent)
}

/// The description of the current context.
fn describe(gl: &glow::Context) -> Adapter {
    // SAFETY: the caller has made the context current.
    let text = |name| unsafe { gl.get_parameter_string(name) };
    let name = text(glow::RENDERER);
    let software = ["llvmpipe", "softpipe", "SwiftShader"];
    let kind = if software.iter().any(|part| name.contains(part)) {
        AdapterKind::Software
    } else {
        AdapterKind::Unknown
    };
    Adapter {
        name,
        driver: text(glow::VERSION),
        backend: Backend::Gles,
        kind,
    }
}

pub(super) fn absent(why: impl ToString) -> Fault {
    let why = why.to_string();
    Fault::Absent(format!(
        "no OpenGL ES 3.0 ({why}); on Debian install {OPENGL_PACKAGES}"
    ))
}
