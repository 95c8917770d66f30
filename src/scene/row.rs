//! The table of what is drawn: a row an effect, with its passes, what they read and write, and its scene.

use super::body::Body;
use super::trace::Paths;

/// A picture that is drawn.
#[derive(Debug)]
pub struct RenderRow {
    /// Its name on the command line.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// The effects whose functions it calls, as users import them.
    pub effects: &'static [&'static str],
    /// What R is computed by.
    pub method: &'static str,
    /// Its own text: entry points, look-ups, loops.
    pub text: &'static str,
    /// The draws, one after the other.
    pub passes: &'static [PassRow],
    /// The body.
    pub body: BodyName,
    /// A material of the catalogue.
    pub material: &'static str,
    /// Whether the index depends on the wavelength.
    pub disperses: bool,
    /// The paths that the effect follows.
    pub own_paths: Paths,
    /// The paths of the truth.
    pub true_paths: Paths,
    /// Where the eye is.
    pub eye: [f64; 3],
    /// Whether it stands in the room, and not under the sky.
    pub in_room: bool,
    /// Whether its surface is hammered.
    pub is_hammered: bool,
    /// Light on a receiver in place of what an eye sees: how far that lies below the body's centre, and half its width.
    pub receiver: Option<[f64; 2]>,
    /// Where it must be wrong, in one line.
    pub wrong: &'static str,
}

/// A body by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyName {
    /// The ball of radius 1.
    Ball,
    /// The brilliant.
    Gem,
}

impl BodyName {
    /// The body.
    pub fn body(self) -> Body {
        match self {
            BodyName::Ball => Body::Ball,
            BodyName::Gem => Body::gem(),
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            BodyName::Ball => "ball",
            BodyName::Gem => "gem",
        }
    }
}

/// A picture that a pass writes or reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slot {
    /// What is shown; alpha says what each pixel is.
    Colour,
    /// Where the back of the body is.
    BackPositions,
    /// Its normals.
    BackNormals,
    /// The cube map of the room.
    Room,
    /// The normal map.
    Relief,
}

/// What a pass draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// All pixels.
    Everywhere,
    /// The side of the body that faces the eye.
    Front,
    /// The side that does not.
    Back,
}

/// A draw.
#[derive(Debug)]
pub struct PassRow {
    /// The entry point for pixels.
    pub fragment: &'static str,
    /// What it draws.
    pub place: Place,
    /// What it writes.
    pub writes: &'static [Slot],
    /// What it reads, from binding 4 on.
    pub reads: &'static [Slot],
}

/// The sky behind all.
const SKY: PassRow = PassRow {
    fragment: "fs_sky",
    place: Place::Everywhere,
    writes: &[Slot::Colour],
    reads: &[],
};
/// The back of the body, for the search.
const BACK: PassRow = PassRow {
    fragment: "fs_back",
    place: Place::Back,
    writes: &[Slot::BackPositions, Slot::BackNormals],
    reads: &[],
};
/// The body over the sky, seen through its back.
const THROUGH: PassRow = PassRow {
    fragment: "fs_front",
    place: Place::Front,
    writes: &[Slot::Colour],
    reads: &[Slot::BackPositions, Slot::BackNormals],
};

/// The body over the sky, by its front alone.
const FRONT: PassRow = PassRow {
    fragment: "fs_front",
    place: Place::Front,
    writes: &[Slot::Colour],
    reads: &[],
};

const FROM_THE_SIDE: [f64; 3] = [0.0, 0.75, 2.9];
const FROM_ABOVE: [f64; 3] = [0.0, 2.6, 3.0];

/// The rows.
pub static ALL: &[RenderRow] = &[
    RenderRow {
        name: "double_refraction",
        summary: "A ball of glass: the search of four steps finds where rays leave",
        effects: &["interface", "interior", "water"],
        method: "dielectric_exact",
        text: include_str!("passes/double_refraction.wgsl"),
        passes: &[SKY, BACK, THROUGH],
        body: BodyName::Ball,
        material: "bk7",
        disperses: false,
        own_paths: Paths::TwoSurfaces,
        true_paths: Paths::All,
        eye: FROM_THE_SIDE,
        in_room: false,
        is_hammered: false,
        receiver: None,
        wrong: "light that is reflected inside is missing; the rim",
    },
    RenderRow {
        name: "double_refraction_gem",
        summary: "A brilliant of diamond, which reflects most rays totally from inside",
        effects: &["interface", "interior", "water"],
        method: "dielectric_exact",
        text: include_str!("passes/double_refraction.wgsl"),
        passes: &[SKY, BACK, THROUGH],
        body: BodyName::Gem,
        material: "diamond",
        disperses: false,
        own_paths: Paths::TwoSurfaces,
        true_paths: Paths::All,
        eye: FROM_ABOVE,
        in_room: false,
        is_hammered: false,
        receiver: None,
        wrong: "rays that are reflected totally leave after one reflection; edges between facets",
    },
    RenderRow {
        name: "reflection_refraction",
        summary: "A ball of glass by one look-up along the reflected ray and one along the refracted",
        effects: &["interface"],
        method: "dielectric_exact",
        text: include_str!("passes/reflection_refraction.wgsl"),
        passes: &[SKY, FRONT],
        body: BodyName::Ball,
        material: "bk7",
        disperses: false,
        own_paths: Paths::OneSurface,
        true_paths: Paths::All,
        eye: FROM_THE_SIDE,
        in_room: false,
        is_hammered: false,
        receiver: None,
        wrong: "the second surface is missing: the world stands upright where it should be upside down",
    },
    RenderRow {
        name: "caustics",
        summary: "Light that a ball of glass gathers on a receiver: 256 x 256 photons as triangles, while the light moves",
        effects: &["interface", "interior", "water", "caustics"],
        method: "dielectric_exact",
        text: include_str!("passes/caustics.wgsl"),
        passes: &[],
        body: BodyName::Ball,
        material: "bk7",
        disperses: false,
        own_paths: Paths::TwoSurfaces,
        true_paths: Paths::TwoSurfaces,
        eye: FROM_ABOVE,
        in_room: false,
        is_hammered: false,
        receiver: Some([1.2, 1.0]),
        wrong: "the edge, where photons fold over each other; light that is reflected inside",
    },
    RenderRow {
        name: "dispersion",
        summary: "A ball of dense flint glass by one refracted ray for each of red, green and blue",
        effects: &["interface", "dispersion"],
        method: "dielectric_exact",
        text: include_str!("passes/dispersion.wgsl"),
        passes: &[SKY, FRONT],
        body: BodyName::Ball,
        material: "sf11",
        disperses: true,
        own_paths: Paths::OneSurface,
        true_paths: Paths::All,
        eye: FROM_THE_SIDE,
        in_room: false,
        is_hammered: false,
        receiver: None,
        wrong: "the second surface is missing, and three samples of the spectrum make three edges",
    },
    RenderRow {
        name: "double_refraction_dispersion",
        summary: "A ball of dense flint glass: the search for each of eight samples of the spectrum",
        effects: &["interface", "interior", "water", "dispersion"],
        method: "dielectric_exact",
        text: include_str!("passes/double_refraction_dispersion.wgsl"),
        passes: &[SKY, BACK, THROUGH],
        body: BodyName::Ball,
        material: "sf11",
        disperses: true,
        own_paths: Paths::TwoSurfaces,
        true_paths: Paths::All,
        eye: FROM_THE_SIDE,
        in_room: false,
        is_hammered: false,
        receiver: None,
        wrong: "light that is reflected inside is missing; three indices stand for a spectrum",
    },
    RenderRow {
        name: "complex_f0",
        summary: "A ball of gold by Schlick's approximation, F0 from its complex index",
        effects: &["interface", "complex_f0"],
        method: "schlick",
        text: include_str!("passes/complex_f0.wgsl"),
        passes: &[SKY, FRONT],
        body: BodyName::Ball,
        material: "gold",
        disperses: true,
        own_paths: Paths::Mirror,
        true_paths: Paths::Mirror,
        eye: FROM_THE_SIDE,
        in_room: false,
        is_hammered: false,
        receiver: None,
        wrong: "Schlick's approximation, near the rim",
    },
    RenderRow {
        name: "normal_mapped",
        summary: "A hammered ball of silver by a normal map",
        effects: &["interface", "normal_mapping"],
        method: "conductor_exact",
        text: include_str!("passes/normal_mapped.wgsl"),
        passes: &[
            SKY,
            PassRow {
                reads: &[Slot::Relief],
                ..FRONT
            },
        ],
        body: BodyName::Ball,
        material: "silver",
        disperses: true,
        own_paths: Paths::Mirror,
        true_paths: Paths::Mirror,
        eye: FROM_THE_SIDE,
        in_room: false,
        is_hammered: true,
        receiver: None,
        wrong: "dents cast no shadow and do not mirror each other, here and in the truth",
    },
    RenderRow {
        name: "parallax_corrected",
        summary: "A ball of silver in a room, by one cube map that was taken beside it",
        effects: &["interface", "parallax"],
        method: "conductor_exact",
        text: include_str!("passes/parallax_corrected.wgsl"),
        passes: &[
            PassRow {
                fragment: "fs_room",
                reads: &[Slot::Room],
                ..SKY
            },
            PassRow {
                reads: &[Slot::Room],
                ..FRONT
            },
        ],
        body: BodyName::Ball,
        material: "silver",
        disperses: true,
        own_paths: Paths::Mirror,
        true_paths: Paths::Mirror,
        eye: FROM_THE_SIDE,
        in_room: true,
        is_hammered: false,
        receiver: None,
        wrong: "texels of the cube map; what stands in the room would be drawn on its walls",
    },
];

impl RenderRow {
    /// Whether it searches for the second surface in a picture of the body's back.
    pub fn searches(&self) -> bool {
        let mut passes = self.passes.iter();
        passes.any(|pass| pass.reads.contains(&Slot::BackPositions))
    }

    /// Whether the environment is seen in it.
    pub fn is_under_the_sky(&self) -> bool {
        !self.in_room && self.receiver.is_none()
    }

    /// Whether light passes through the body.
    pub fn is_transparent(&self) -> bool {
        self.true_paths != Paths::Mirror
    }
}

/// The row of this name.
pub fn find(name: &str) -> Option<&'static RenderRow> {
    ALL.iter().find(|row| row.name == name)
}
