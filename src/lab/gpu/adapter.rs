//! The adapters of the machine and the choice among them.

use std::fmt;
use std::sync::OnceLock;

use super::quiet::hush;
use crate::lab::fault::Fault;

/// A description of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adapter {
    /// The name that its driver gives it.
    pub name: String,
    /// The driver with its version.
    pub driver: String,
    /// Its graphics interface.
    pub backend: Backend,
    /// Its kind of hardware.
    pub kind: AdapterKind,
}

/// A graphics interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Backend {
    /// Vulkan: WGSL and SPIR-V.
    Vulkan,
    /// Metal: WGSL.
    Metal,
    /// Direct3D 12: WGSL.
    Direct3d12,
    /// OpenGL with compute shaders: WGSL.
    OpenGl,
    /// OpenGL ES 3.0: GLSL ES.
    Gles,
}

/// The kind of hardware of an adapter, the fastest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AdapterKind {
    /// A discrete GPU.
    Discrete,
    /// A GPU integrated with the processor.
    Integrated,
    /// A GPU that a host provides to a guest.
    Virtual,
    /// Not reported.
    Unknown,
    /// Software.
    Software,
}

/// The requested device. If nothing is given: the best there is, without OpenGL.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The interface.
    pub backend: Option<Backend>,
    /// A part of the name, ignoring case.
    pub name: Option<String>,
}

/// Variables that may hide installed drivers.
const DRIVERS: &str =
    "; where VK_DRIVER_FILES or VK_ICD_FILENAMES is set it must name the file of a driver";
/// The packages that Vulkan needs on Debian, and those that OpenGL needs.
const VULKAN_PACKAGES: &str = "mesa-vulkan-drivers libvulkan1";
pub(super) const OPENGL_PACKAGES: &str = "libegl1 libegl-mesa0 libgles2 libgl1-mesa-dri";

impl Backend {
    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Backend::Vulkan => "vulkan",
            Backend::Metal => "metal",
            Backend::Direct3d12 => "dx12",
            Backend::OpenGl => "gl",
            Backend::Gles => "gles",
        }
    }
}

impl fmt::Display for Adapter {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "{}: {} ({})",
            self.backend.name(),
            self.name,
            self.driver
        )
    }
}

/// The devices of wgpu.
pub(super) fn all() -> impl Iterator<Item = Adapter> {
    found().iter().map(describe)
}

/// The adapters of wgpu, the preferred first, searched for once per process and kept. Dropping an instance terminates the EGL
/// display, and other contexts with it. Each search would also give another handle to the same OpenGL context, with a lock of its
/// own, so that two threads could use it at once.
fn found() -> &'static [wgpu::Adapter] {
    static FOUND: OnceLock<(wgpu::Instance, Vec<wgpu::Adapter>)> = OnceLock::new();
    let (_, found) = FOUND.get_or_init(|| {
        hush();
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        // No validation layers: they print, and naga validates what needs it.
        descriptor.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(descriptor);
        let every = wgpu::Backends::all();
        let mut found = pollster::block_on(instance.enumerate_adapters(every));
        found.sort_by_key(|adapter| (describe(adapter).kind, describe(adapter).backend));
        (instance, found)
    });
    found
}

/// The first adapter that fits the request.
pub(super) fn choose(wanted: &Wanted) -> Result<&'static wgpu::Adapter, Fault> {
    let found = found();
    let there: Vec<String> = found.iter().map(|a| describe(a).to_string()).collect();
    let fits = |adapter: &wgpu::Adapter| wanted.fits(&describe(adapter));
    found
        .iter()
        .find(|adapter| fits(adapter))
        .ok_or_else(|| absent(wanted, &there))
}

impl Wanted {
    fn fits(&self, adapter: &Adapter) -> bool {
        let lower = adapter.name.to_lowercase();
        // OpenGL takes no SPIR-V, so it is not a fallback and is used only where it is named.
        self.backend
            .map_or(adapter.backend != Backend::OpenGl, |backend| {
                backend == adapter.backend
            })
            && self
                .name
                .as_ref()
                .is_none_or(|name| lower.contains(&name.to_lowercase()))
    }
}

fn absent(wanted: &Wanted, there: &[String]) -> Fault {
    let mut what = match &wanted.name {
        Some(name) => format!("no graphics adapter named `{name}`"),
        None => "no graphics adapter".to_owned(),
    };
    if let Some(backend) = wanted.backend {
        what += &format!(" for {}", backend.name());
    }
    let packages = match wanted.backend {
        Some(Backend::OpenGl) => OPENGL_PACKAGES,
        _ => VULKAN_PACKAGES,
    };
    let mut install = format!("on Debian install {packages}");
    if wanted.backend != Some(Backend::OpenGl) {
        install += DRIVERS;
    }
    let listed = match wanted.backend {
        None => format!(
            "{}; OpenGL is taken only where it is named",
            there.join(", ")
        ),
        Some(_) => there.join(", "),
    };
    let get = match there {
        [] => install,
        _ if wanted.name.is_some() => format!("there is {listed}"),
        _ => format!("there is {listed}; {install}"),
    };
    Fault::Absent(format!("{what}; {get}"))
}

/// The description of an adapter of wgpu.
pub(super) fn describe(adapter: &wgpu::Adapter) -> Adapter {
    let info = adapter.get_info();
    let driver = format!("{} {}", info.driver, info.driver_info);
    Adapter {
        driver: driver.trim().to_owned(),
        backend: backend(info.backend),
        kind: kind(info.device_type),
        name: info.name,
    }
}

fn backend(backend: wgpu::Backend) -> Backend {
    match backend {
        wgpu::Backend::Metal => Backend::Metal,
        wgpu::Backend::Dx12 => Backend::Direct3d12,
        wgpu::Backend::Gl => Backend::OpenGl,
        // The others are for the web and for tests, and are not compiled in.
        _ => Backend::Vulkan,
    }
}

fn kind(kind: wgpu::DeviceType) -> AdapterKind {
    match kind {
        wgpu::DeviceType::DiscreteGpu => AdapterKind::Discrete,
        wgpu::DeviceType::IntegratedGpu => AdapterKind::Integrated,
        wgpu::DeviceType::VirtualGpu => AdapterKind::Virtual,
        wgpu::DeviceType::Other => AdapterKind::Unknown,
        wgpu::DeviceType::Cpu => AdapterKind::Software,
    }
}
