//! The targets, one file each: how a language spells the operations, which words it reserves, how its files are laid
//! out, and which compilers validate them.
//!
//! To add one, write its file and its templates, then run `tests/lists`, which writes the list below. ARCHITECTURE.md lists
//! the next steps.
//! This room knows no method.

use std::str::FromStr;

use crate::physics::names::{UnknownName, named};

mod spelling;
mod target;

pub use gles::TARGET as GLES;
pub use glsl::{DESKTOP, TARGET as GLSL};
pub use hlsl::{DXC, TARGET as HLSL};
pub use spelling::{Form, Spelling, precedence};
pub use target::{
    Compiler, Finish, Frame, GLSLANG, HalfText, Harness, Page, PointHarness, Stack, Target,
    Validator, filled,
};
pub use wgsl::{STREAM, TARGET as WGSL};

// BEGIN list (written by tests/lists)
mod gles;
mod glsl;
mod hlsl;
mod msl;
mod spirv;
mod wgsl;

/// Every target, by name.
#[rustfmt::skip]
pub static ALL: &[&Target] = &[
    &gles::TARGET,
    &glsl::TARGET,
    &hlsl::TARGET,
    &msl::TARGET,
    &spirv::TARGET,
    &wgsl::TARGET,
];

/// Each by its name.
#[rustfmt::skip]
#[allow(missing_docs)]
impl Target {
    pub const GLES: &'static Target = &gles::TARGET;
    pub const GLSL: &'static Target = &glsl::TARGET;
    pub const HLSL: &'static Target = &hlsl::TARGET;
    pub const MSL: &'static Target = &msl::TARGET;
    pub const SPIRV: &'static Target = &spirv::TARGET;
    pub const WGSL: &'static Target = &wgsl::TARGET;
}
// END list

/// Why a name cannot be used in one of the languages, if it cannot.
///
/// ```
/// use fresnel_gen::language::targets::name_fault;
///
/// assert_eq!(name_fault("fresnel_brass"), None);
/// assert!(name_fault("while").is_some());
/// ```
pub fn name_fault(name: &str) -> Option<String> {
    ALL.iter().find_map(|target| target.name_fault(name))
}

/// The target of this name.
///
/// ```
/// let target = fresnel_gen::language::targets::find("gles").expect("it is a target");
/// assert_eq!(target.name, "gles");
/// ```
pub fn find(name: &str) -> Option<&'static Target> {
    ALL.iter().find(|target| target.name == name).copied()
}

impl FromStr for &'static Target {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<&'static Target, UnknownName> {
        named("target", name, find(name), ALL.iter().map(|one| one.name))
    }
}
