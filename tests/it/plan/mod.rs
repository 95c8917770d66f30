//! Plans: scenes and frames as they are read, what their frames show, and what is chosen for them.

mod gbuffer;
mod gltf;
mod gltf_seen;
mod light_files;
mod other_renderers;
mod planned;
mod scene_file;
mod scenes;
