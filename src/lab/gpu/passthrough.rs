//! SPIR-V modules passed to the driver unchanged.
#![allow(unsafe_code)]

use super::adapter::Backend;
use super::compute::Compute;
use super::spirv::{HEADER, MAGIC, compute_entries, words};
use crate::lab::fault::Fault;

/// A shader module of these bytes.
pub(super) fn module(
    compute: &Compute,
    bytes: &[u8],
    entry: &str,
) -> Result<wgpu::ShaderModule, Fault> {
    let words = words(bytes);
    if !bytes.len().is_multiple_of(4) || words.len() < HEADER || words[0] != MAGIC {
        return Err(Fault::refused("this is no SPIR-V module"));
    }
    let there = compute_entries(&words);
    if !there.iter().any(|name| name == entry) {
        let there = there.join(", ");
        let log = format!("no compute entry point `{entry}`; there is {there}");
        return Err(Fault::refused(log));
    }
    // OpenGL has the feature too, but for GLSL.
    let is_vulkan = compute.adapter.backend == Backend::Vulkan;
    if !is_vulkan || !compute.has(wgpu::Features::PASSTHROUGH_SHADERS) {
        let device = format!(
            "{}: {}",
            compute.adapter.backend.name(),
            compute.adapter.name
        );
        return Err(Fault::unable(
            &device,
            "SPIR-V as it is, which takes Vulkan",
        ));
    }
    compute.guarded(|| pass(compute, &words, entry))
}

fn pass(compute: &Compute, words: &[u32], entry: &str) -> wgpu::ShaderModule {
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        entry_points: vec![wgpu::PassthroughShaderEntryPoint {
            name: entry.into(),
            workgroup_size: (64, 1, 1),
        }]
        .into(),
        spirv: Some(words.into()),
        ..Default::default()
    };
    // SAFETY: the driver takes the words unseen. The header is checked above, and so is the entry point; that modules be
    // valid is what `ShaderCode::Spirv` demands of its caller.
    unsafe { compute.device.create_shader_module_passthrough(descriptor) }
}
