//! Plans: scenes as they are read, and what their frames show.

mod gltf;
mod scene_file;
mod scenes;
