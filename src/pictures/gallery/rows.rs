//! The rows of the gallery: those of pictures, and a rough ball, whose truth no tracer of ours has.

use crate::pictures::scene::{self, BodyName, PassRow, Paths, Place, RenderRow, Slot, View};

const DARK: PassRow = PassRow {
    fragment: "fs_dark",
    place: Place::Everywhere,
    view: View::Eye,
    writes: &[Slot::Colour],
    reads: &[],
};

/// A rough ball under three lamps.
static ROUGH: RenderRow = RenderRow {
    name: "ggx_specular",
    summary: "A rough ball under three lamps: GGX, the method at the half vector",
    effects: &["interface", "ggx_specular"],
    method: "schlick",
    text: include_str!("ggx_specular.wgsl"),
    passes: &[
        DARK,
        PassRow {
            fragment: "fs_front",
            place: Place::Front,
            ..DARK
        },
    ],
    body: BodyName::Ball,
    material: "gold",
    disperses: true,
    own_paths: Paths::Mirror,
    true_paths: Paths::Mirror,
    eye: [0.0, 0.75, 2.9],
    in_room: false,
    dents: None,
    receiver: None,
    wrong: "light that bounces twice is missing",
};

/// All of them.
pub fn rows() -> Vec<&'static RenderRow> {
    scene::ALL.iter().chain([&ROUGH]).collect()
}

/// The row of this name.
pub fn find(name: &str) -> Option<&'static RenderRow> {
    rows().into_iter().find(|row| row.name == name)
}
