//! Scenes that show what functions do, and plans for a scene's materials.

#[cfg(feature = "cli")]
pub mod gallery;
#[cfg(feature = "cli")]
pub mod plan;
#[cfg(feature = "cli")]
pub mod scene;
