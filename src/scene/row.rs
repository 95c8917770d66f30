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
        wrong: "rays that are reflected totally leave after one reflection; edges between facets",
    },
];

impl RenderRow {
    /// Whether light passes through the body.
    pub fn is_transparent(&self) -> bool {
        self.true_paths != Paths::Mirror
    }
}

/// The row of this name.
pub fn find(name: &str) -> Option<&'static RenderRow> {
    ALL.iter().find(|row| row.name == name)
}
