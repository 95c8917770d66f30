//! The nodes of the scene, with their transforms into the world.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf_json::{Node, Root};

use super::fault::Place;

/// A node where it is.
pub struct PlacedNode<'a> {
    /// Its index.
    pub index: usize,
    pub node: &'a Node,
    /// From its own axes into the world.
    pub into_world: DAffine3,
}

/// The nodes of the default scene, or of the first one, or all that are nobody's children: parents first.
///
/// # Errors
/// A node stands in two places, or below itself, or a number of its transform is not finite.
pub fn placed(root: &Root) -> Result<Vec<PlacedNode<'_>>, Place> {
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
            return Err(Place::new(place, what));
        }
        let node = &root.nodes[index];
        let into_world = parent * own_transform(node);
        if !into_world.is_finite() {
            let what = "its transform into the world is not finite";
            return Err(Place::new(format!("nodes[{index}]"), what));
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

/// Nodes that are nobody's children.
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

/// From a node's axes into its parent's: a matrix, or first a scale, then a turn, then a move.
fn own_transform(node: &Node) -> DAffine3 {
    if let Some(matrix) = node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from)));
    }
    let vector = |three: [f32; 3]| DVec3::from_array(three.map(f64::from));
    let turn = node.rotation.map_or(DQuat::IDENTITY, |turn| {
        let turn = DQuat::from_array(turn.0.map(f64::from));
        // A quaternion without a length turns nothing.
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
