//! Plans for scenes: what frames show, whoever drew them.

mod gbuffer;
#[cfg(any(feature = "pictures", feature = "gpu"))]
mod other_renderers;
