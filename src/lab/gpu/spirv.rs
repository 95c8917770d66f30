//! The words and the instructions of a module of SPIR-V, and a module passed to the driver unchanged.
//!
//! Source: Khronos Group, *SPIR-V Specification*, version 1.6, 2021, sections 2.3, 3.3 and 3.42.5,
//! <https://registry.khronos.org/SPIR-V/specs/unified1/SPIRV.html>.

#![allow(unsafe_code)]

use super::adapter::Backend;
use super::compute::Compute;
use crate::lab::fault::Fault;

/// The first word of every module.
pub(super) const MAGIC: u32 = 0x0723_0203;
/// The number of words before the first instruction.
pub(super) const HEADER: usize = 5;
/// The instruction that names an entry point: execution model, function, name, variables.
pub const ENTRY_POINT: u32 = 15;
const GL_COMPUTE: u32 = 5;

/// The words of a module's bytes.
pub fn words(bytes: &[u8]) -> Vec<u32> {
    bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

/// Each instruction with its operands. Each states its own length.
pub fn instructions(words: &[u32]) -> impl Iterator<Item = (u32, &[u32])> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let first = *words.get(at)?;
        let length = (first >> 16).max(1) as usize;
        let operands = words.get(at + 1..at + length).unwrap_or_default();
        at += length;
        Some((first & 0xFFFF, operands))
    })
}

/// A string: four bytes a word, up to a zero.
pub fn literal(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let name: Vec<u8> = bytes.take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&name).into_owned()
}

/// The names of the compute entry points.
fn compute_entries(words: &[u32]) -> Vec<String> {
    let name = |(code, operands): (u32, &[u32])| match operands {
        [GL_COMPUTE, _, name @ ..] if code == ENTRY_POINT => Some(literal(name)),
        _ => None,
    };
    instructions(words).filter_map(name).collect()
}

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
