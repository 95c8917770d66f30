//! What puts the panels side by side on the page.

use serde::Serialize;

use super::lower::{GlesProgram, LoweringFault, lowered};

/// Its text.
pub const SHOW: &str = include_str!("show.wgsl");

/// Its programs.
#[derive(Clone, Debug, Serialize)]
pub struct ShowPrograms {
    /// For WebGPU.
    pub wgsl: &'static str,
    /// For WebGL 2.
    pub vertex: GlesProgram,
    /// For WebGL 2.
    pub fragment: GlesProgram,
}

/// Its text in both languages.
///
/// # Errors
/// naga refuses it: a bug.
pub fn programs() -> Result<ShowPrograms, LoweringFault> {
    Ok(ShowPrograms {
        wgsl: SHOW,
        vertex: lowered(SHOW, "vs_cover", &[], false)?,
        fragment: lowered(SHOW, "fs_show", &[], false)?,
    })
}
