//! What a file says that is not read, though it changes what is seen: a remark each, so that nothing is passed over in silence.

use gltf_json::{Material, Root};

use crate::physics::foreign::Foreign;

/// Extensions that are read, or that a material's own reason names.
const READ: [&str; 3] = ["KHR_materials_", "KHR_texture_", "EXT_texture_"];
/// A camera's aspect may differ from that of the frames by rounding.
const ROUNDING: f64 = 0.005;

/// What of a material is not read.
pub fn not_read(material: &Material, name: &str) -> Option<String> {
    let pbr = &material.pbr_metallic_roughness;
    let emits = material.emissive_factor.0 != [0.0; 3];
    let parts = [
        (pbr.base_color_texture.is_some(), "baseColorTexture"),
        (
            pbr.metallic_roughness_texture.is_some(),
            "metallicRoughnessTexture",
        ),
        (material.normal_texture.is_some(), "normalTexture"),
        (material.occlusion_texture.is_some(), "occlusionTexture"),
        (
            emits && material.emissive_texture.is_some(),
            "emissiveTexture",
        ),
        (
            emits && material.emissive_texture.is_none(),
            "emissiveFactor",
        ),
    ];
    let parts = parts.iter().filter(|(is_there, _)| *is_there);
    let parts: Vec<&str> = parts.map(|(_, part)| *part).collect();
    let list = parts.join(", ");
    (!parts.is_empty()).then(|| format!("{name}: not read: {list}"))
}

/// What of the scene is not read; `size` is that of the frames.
pub fn of_scene(root: &Root, size: [u32; 2]) -> Vec<String> {
    let mut remarks = Vec::new();
    let primitives = || root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let parts = [
        (!root.skins.is_empty(), "skins"),
        (
            primitives().any(|part| part.targets.is_some()),
            "morph targets",
        ),
        (!root.animations.is_empty(), "animations"),
    ];
    let parts: Vec<&str> = parts
        .iter()
        .filter(|part| part.0)
        .map(|part| part.1)
        .collect();
    if !parts.is_empty() {
        let list = parts.join(", ");
        remarks.push(format!(
            "not read: {list}; the scene is drawn as its nodes stand"
        ));
    }
    for name in &root.extensions_used {
        if !READ.iter().any(|start| name.starts_with(start)) {
            remarks.push(format!("the extension {} is not read", Foreign(name)));
        }
    }
    remarks.extend(aspect(root, f64::from(size[0]) / f64::from(size[1])));
    remarks
}

/// A camera of another shape than the frames. Its height is kept.
fn aspect(root: &Root, frames: f64) -> Option<String> {
    let own = root.cameras.iter().filter_map(|camera| {
        let perspective = camera
            .perspective
            .as_ref()
            .map(|lens| lens.aspect_ratio.map(f64::from));
        let orthographic = camera.orthographic.as_ref();
        perspective
            .unwrap_or_else(|| orthographic.map(|lens| f64::from(lens.xmag) / f64::from(lens.ymag)))
    });
    let mut other = own.filter(|own| (own / frames - 1.0).abs() > ROUNDING);
    let other = other.next()?;
    Some(format!(
        "a camera has an aspect of {other:.3}, and the frames {frames:.3} (--size): they show as much in height, and more or less in width"
    ))
}
