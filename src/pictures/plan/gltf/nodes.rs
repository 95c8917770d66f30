//! The nodes of the scene with their transforms into the world, and the cameras among them.
//!
//! A file without cameras gets some that turn about its middle. Remarks name what the file states and this program does not read
//! although it changes the picture, so that nothing is ignored silently.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf_json::{Node, Root, camera};

use super::container::GltfFault;
use crate::lab::raster::{Camera, Lens, Mesh, rotated};
use crate::physics::foreign::Foreign;
use crate::pictures::plan::frame::MOST_FRAMES;

/// A node in its place in the world.
pub struct PlacedNode<'a> {
    /// Its index.
    pub index: usize,
    pub node: &'a Node,
    /// The transform from its own axes into the world.
    pub into_world: DAffine3,
}

/// The nodes of the default scene, or of the first scene, or all nodes without a parent; parents come first.
///
/// # Errors
/// A node stands in two places or below itself, or a number of its transform is not finite.
pub fn placed(root: &Root) -> Result<Vec<PlacedNode<'_>>, GltfFault> {
    let first = (!root.scenes.is_empty()).then_some(0);
    let scene = root.scene.map(|scene| scene.value()).or(first);
    let mut seen = vec![false; root.nodes.len()];
    let mut pending: Vec<(usize, DAffine3, String)> = match scene {
        Some(scene) => {
            let nodes = root.scenes[scene].nodes.iter().enumerate();
            let named = |(i, node): (usize, &gltf_json::Index<Node>)| {
                (
                    node.value(),
                    DAffine3::IDENTITY,
                    format!("scenes[{scene}].nodes[{i}]"),
                )
            };
            nodes.map(named).collect()
        }
        None => top(root)
            .map(|node| (node, DAffine3::IDENTITY, format!("nodes[{node}]")))
            .collect(),
    };
    pending.reverse();
    let mut placed = Vec::new();
    while let Some((index, parent, place)) = pending.pop() {
        if std::mem::replace(&mut seen[index], true) {
            let what = format!("node {index} stands in two places, or below itself");
            return Err(GltfFault::new(place, what));
        }
        let node = &root.nodes[index];
        let into_world = parent * own_transform(node);
        if !into_world.is_finite() {
            let what = "its transform into the world is not finite";
            return Err(GltfFault::new(format!("nodes[{index}]"), what));
        }
        placed.push(PlacedNode {
            index,
            node,
            into_world,
        });
        let children: &[_] = node.children.as_deref().unwrap_or_default();
        for (i, child) in children.iter().enumerate().rev() {
            pending.push((
                child.value(),
                into_world,
                format!("nodes[{index}].children[{i}]"),
            ));
        }
    }
    Ok(placed)
}

/// The nodes without a parent.
fn top(root: &Root) -> impl Iterator<Item = usize> {
    let mut is_child = vec![false; root.nodes.len()];
    for child in root
        .nodes
        .iter()
        .flat_map(|node| node.children.iter().flatten())
    {
        is_child[child.value()] = true;
    }
    (0..root.nodes.len()).filter(move |node| !is_child[*node])
}

/// The transform from a node's axes into its parent's: a matrix, or first a scale, then a rotation, then a translation.
fn own_transform(node: &Node) -> DAffine3 {
    if let Some(matrix) = node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from)));
    }
    let vector = |three: [f32; 3]| DVec3::from_array(three.map(f64::from));
    let turn = node.rotation.map_or(DQuat::IDENTITY, |turn| {
        let turn = DQuat::from_array(turn.0.map(f64::from));
        // A quaternion of length zero rotates nothing.
        if turn.length_squared() > 0.0 {
            turn.normalize()
        } else {
            DQuat::IDENTITY
        }
    });
    let scale = node.scale.map_or(DVec3::ONE, vector);
    let by = node.translation.map_or(DVec3::ZERO, vector);
    DAffine3::from_scale_rotation_translation(scale, turn, by)
}

/// Extensions that are read, or that a material's own reason or remark names.
const READ: [&str; 3] = ["KHR_materials_", "KHR_texture_", "EXT_texture_"];
/// How far a camera's aspect may differ from that of the frames, as rounding does.
const ROUNDING: f64 = 0.005;

/// Remarks on the parts of the scene that are not read; `size` is that of the frames.
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

/// A remark on cameras whose aspect differs from that of the frames. Their height is kept.
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

/// The cameras that stand in for those of a file without any.
const FRAMES: u32 = 36;
const ABOVE_DEGREES: f64 = 20.0;
const VERTICAL_DEGREES: f64 = 45.0;

/// A camera for each node that has one. It looks along its own -z, its +y is up, and it sees what lies between its clip planes.
///
/// # Errors
/// A field of view or a height lies outside its limits, a transform has no directions, or there are too many cameras.
pub fn cameras(
    root: &Root,
    nodes: &[PlacedNode],
    size: [u32; 2],
) -> Result<Vec<Camera>, GltfFault> {
    let mut cameras = Vec::new();
    for node in nodes {
        let Some(index) = node.node.camera.map(|camera| camera.value()) else {
            continue;
        };
        let matrix = node.into_world.matrix3;
        let axes = axes(-matrix.z_axis, matrix.y_axis).ok_or_else(|| {
            let what = "its transform leaves the camera no direction";
            GltfFault::new(format!("nodes[{}]", node.index), what)
        })?;
        let place = format!("cameras[{index}]");
        let eye = node.into_world.translation;
        cameras.push(camera(&root.cameras[index], eye, axes, size, &place)?);
        if cameras.len() > MOST_FRAMES {
            return Err(GltfFault::new(
                place,
                format!("the scene has more than {MOST_FRAMES} cameras"),
            ));
        }
    }
    Ok(cameras)
}

/// The camera's axes: right, down and forwards; `None` where the directions are degenerate.
fn axes(forwards: DVec3, up: DVec3) -> Option<[DVec3; 3]> {
    let forwards = forwards.try_normalize()?;
    let right = forwards.cross(up).try_normalize()?;
    Some([right, forwards.cross(right), forwards])
}

fn camera(
    camera: &camera::Camera,
    eye: DVec3,
    axes: [DVec3; 3],
    size: [u32; 2],
    place: &str,
) -> Result<Camera, GltfFault> {
    let within = |value: f64, [low, high]: [f64; 2], what: &str| {
        if (low..=high).contains(&value) {
            Ok(value)
        } else {
            let says = format!("it is {value}; it must lie between {low} and {high}");
            Err(GltfFault::new(format!("{place}.{what}"), says))
        }
    };
    match (&camera.perspective, &camera.orthographic) {
        (Some(perspective), _) => {
            let field = f64::from(perspective.yfov);
            let field = within(field, [2e-4, 2.97], "perspective.yfov")?;
            let vertical_degrees = field.to_degrees();
            let lens = Lens {
                size,
                vertical_degrees,
            };
            let far = perspective.zfar.map_or(f64::INFINITY, f64::from);
            let planes = planes([perspective.znear.into(), far], place, "perspective")?;
            Ok(Camera::new(eye, axes, lens).clipped(planes, None))
        }
        (None, Some(orthographic)) => {
            let half = f64::from(orthographic.ymag);
            let half = within(half, [1e-6, 1e6], "orthographic.ymag")?;
            let ends = [orthographic.znear, orthographic.zfar].map(f64::from);
            let planes = planes(ends, place, "orthographic")?;
            let height = 2.0 * half;
            Ok(Camera::orthographic(eye, axes, height, size).clipped(planes, Some(height)))
        }
        (None, None) => Err(GltfFault::new(
            place,
            "it is neither perspective nor orthographic",
        )),
    }
}

/// The distances of a camera's clip planes (section 3.10.3).
fn planes([near, far]: [f64; 2], place: &str, what: &str) -> Result<[f64; 2], GltfFault> {
    if near < 0.0 {
        let says = format!("it is {near}; it must not be below 0");
        return Err(GltfFault::new(format!("{place}.{what}.znear"), says));
    }
    if far <= near {
        let says = format!("it is {far}; it must be greater than znear, {near}");
        return Err(GltfFault::new(format!("{place}.{what}.zfar"), says));
    }
    Ok([near, far])
}

/// Cameras that turn about the middle of a mesh, far enough to see all of it.
pub fn around(mesh: &Mesh, size: [u32; 2]) -> Vec<Camera> {
    let places = || mesh.vertices.iter().map(|vertex| vertex.position);
    let least = places().fold(DVec3::INFINITY, DVec3::min);
    let most = places().fold(DVec3::NEG_INFINITY, DVec3::max);
    let middle = (least + most) / 2.0;
    let radius = places()
        .map(|place| (place - middle).length())
        .fold(1e-6, f64::max);
    let half = (VERTICAL_DEGREES / 2.0).to_radians();
    // A picture that is higher than wide shows less at its sides.
    let aspect = (f64::from(size[0]) / f64::from(size[1])).min(1.0);
    let distance = radius / libm::sin(libm::atan(aspect * libm::tan(half)));
    let start = rotated(
        distance * DVec3::Z,
        DVec3::NEG_X,
        ABOVE_DEGREES.to_radians(),
    );
    let lens = Lens {
        size,
        vertical_degrees: VERTICAL_DEGREES,
    };
    let turned = |frame: u32| {
        let angle = std::f64::consts::TAU * f64::from(frame) / f64::from(FRAMES);
        Camera::looking(middle + rotated(start, DVec3::Y, angle), middle, lens)
    };
    (0..FRAMES).map(turned).collect()
}
