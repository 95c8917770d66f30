//! The table of pictures: a row for each effect, with its passes, what they read and write, and its scene.

use super::body::Body;
use super::light::Paths;
use super::texels::Slot;
use crate::generator::request::Source;
use crate::lab::gpu::Depth;
use crate::physics::materials::{Index, Surface, film_of_word};

/// The sky behind everything.
pub const SKY: PassRow = PassRow {
    fragment: "fs_sky",
    surface: DrawnSurface::Everywhere,
    view: View::Eye,
    writes: &[Slot::Colour],
    reads: &[],
};
/// The back of the body, for the search.
const BACK: PassRow = PassRow {
    fragment: "fs_back",
    surface: DrawnSurface::Back,
    writes: &[Slot::BackPositions, Slot::BackNormals],
    ..SKY
};
/// The body over the sky, seen through its back.
const THROUGH: PassRow = front(&[Slot::BackPositions, Slot::BackNormals]);

/// The body over the sky, by its front alone.
pub const FRONT: PassRow = PassRow {
    fragment: "fs_front",
    surface: DrawnSurface::Front,
    ..SKY
};

/// The body over the sky, with these tables.
const fn front(reads: &'static [Slot]) -> PassRow {
    PassRow { reads, ..FRONT }
}

const FROM_THE_SIDE: [f64; 3] = [0.0, 0.75, 2.9];
const FROM_ABOVE: [f64; 3] = [0.0, 2.6, 3.0];

const OVER_THE_POOL: [f64; 3] = [0.0, 1.2, 4.0];
const BEFORE_THE_WINDOW: [f64; 3] = [1.495, -1.3, -1.329];

/// The passes of water: solid things mirrored in it under the mirrored sky, what lies below it, both as the eye sees them, and
/// the water on top.
const WATER: [PassRow; 6] = [
    PassRow {
        fragment: "fs_mirror_sky",
        view: View::Mirrored,
        writes: &[Slot::Mirror, Slot::MirrorPositions],
        ..SKY
    },
    PassRow {
        fragment: "fs_mirror",
        view: View::Mirrored,
        writes: &[Slot::Mirror, Slot::MirrorPositions],
        reads: &[Slot::Paint],
        ..FRONT
    },
    PassRow {
        fragment: "fs_below",
        view: View::Margin,
        writes: &[Slot::Below, Slot::BelowPositions],
        reads: &[Slot::Paint],
        ..FRONT
    },
    SKY,
    PassRow {
        fragment: "fs_solid",
        reads: &[Slot::Paint],
        ..FRONT
    },
    PassRow {
        fragment: "fs_water",
        surface: DrawnSurface::Water,
        reads: &[
            Slot::Below,
            Slot::BelowPositions,
            Slot::Mirror,
            Slot::MirrorPositions,
            Slot::Relief,
        ],
        ..SKY
    },
];

/// A ball of glass under the sky, seen from the side.
const BALL: RenderRow = RenderRow {
    name: "",
    summary: "",
    effects: &[],
    method: "dielectric_exact",
    text: "",
    passes: &[SKY, FRONT],
    body: Body::Ball,
    material: "bk7",
    film: None,
    disperses: false,
    own_paths: Paths::TwoSurfaces,
    true_paths: Paths::All,
    eye: FROM_THE_SIDE,
    in_room: false,
    dents: None,
    receiver: None,
    wrong: "",
};

/// A ball of a metal, which light does not enter.
pub const METAL: RenderRow = RenderRow {
    method: "conductor_exact",
    disperses: true,
    own_paths: Paths::Mirror,
    true_paths: Paths::Mirror,
    ..BALL
};

/// The rows.
pub static ALL: &[RenderRow] = &[
    RenderRow {
        name: "double_refraction",
        summary: "A ball of glass: the search of four steps finds where rays leave",
        effects: &["interface", "interior", "water"],
        text: concat!(
            include_str!("passes/second_surface.wgsl"),
            include_str!("passes/double_refraction.wgsl")
        ),
        passes: &[SKY, BACK, THROUGH],
        wrong: "light that is reflected inside is missing; the rim",
        ..BALL
    },
    RenderRow {
        name: "double_refraction_gem",
        summary: "A brilliant of diamond, which reflects most rays totally from inside",
        effects: &["interface", "interior", "water"],
        text: concat!(
            include_str!("passes/second_surface.wgsl"),
            include_str!("passes/double_refraction.wgsl")
        ),
        passes: &[SKY, BACK, THROUGH],
        body: Body::Gem,
        material: "diamond",
        eye: FROM_ABOVE,
        wrong: "rays that are reflected totally leave after one reflection; edges between facets",
        ..BALL
    },
    RenderRow {
        name: "double_refraction_normal_mapped",
        summary: "A hammered ball of glass: a normal map turns the normals of both surfaces",
        effects: &["interface", "interior", "water", "normal_mapping"],
        text: concat!(
            include_str!("passes/second_surface.wgsl"),
            include_str!("passes/double_refraction_normal_mapped.wgsl")
        ),
        passes: &[
            SKY,
            PassRow {
                fragment: "fs_dented_back",
                reads: &[Slot::Relief],
                ..BACK
            },
            front(&[Slot::BackPositions, Slot::BackNormals, Slot::Relief]),
        ],
        dents: Some(0.12),
        wrong: "light that is reflected inside is missing; dents do not hide each other, here and in the truth",
        ..BALL
    },
    RenderRow {
        name: "reflection_refraction",
        summary: "A ball of glass by one look-up along the reflected ray and one along the refracted",
        effects: &["interface"],
        text: include_str!("passes/reflection_refraction.wgsl"),
        own_paths: Paths::OneSurface,
        wrong: "the second surface is missing: the world is far too large, in the middle a single place",
        ..BALL
    },
    RenderRow {
        name: "caustics",
        summary: "Light that a ball of glass gathers on a receiver: 256 x 256 photons as triangles",
        effects: &["interface", "interior", "water", "caustics"],
        text: include_str!("passes/caustics.wgsl"),
        passes: &[],
        true_paths: Paths::TwoSurfaces,
        eye: FROM_ABOVE,
        receiver: Some([1.2, 1.0]),
        wrong: "the edge, where photons fold over each other; light that is reflected inside",
        ..BALL
    },
    RenderRow {
        name: "dispersion",
        summary: "A ball of dense flint glass by one refracted ray for each of red, green and blue",
        effects: &["interface", "dispersion"],
        text: include_str!("passes/dispersion.wgsl"),
        material: "sf11",
        disperses: true,
        own_paths: Paths::OneSurface,
        wrong: "the second surface is missing, and three samples of the spectrum make three edges",
        ..BALL
    },
    RenderRow {
        name: "double_refraction_dispersion",
        summary: "A ball of dense flint glass: the search for each of eight samples of the spectrum",
        effects: &["interface", "interior", "water", "dispersion"],
        text: concat!(
            include_str!("passes/second_surface.wgsl"),
            include_str!("passes/double_refraction_dispersion.wgsl")
        ),
        passes: &[SKY, BACK, THROUGH],
        material: "sf11",
        disperses: true,
        wrong: "light that is reflected inside is missing; three indices stand for a spectrum",
        ..BALL
    },
    RenderRow {
        name: "complex_f0",
        summary: "A ball by Schlick's approximation, F0 from its complex index",
        effects: &["interface", "complex_f0"],
        method: "schlick",
        text: include_str!("passes/complex_f0.wgsl"),
        material: "gold",
        wrong: "Schlick's approximation, near the rim",
        ..METAL
    },
    RenderRow {
        name: "normal_mapped",
        summary: "A hammered ball of silver by a normal map",
        effects: &["interface", "normal_mapping"],
        text: include_str!("passes/normal_mapped.wgsl"),
        passes: &[SKY, front(&[Slot::Relief])],
        material: "silver",
        dents: Some(0.35),
        wrong: "dents cast no shadow and do not mirror each other, here and in the truth",
        ..METAL
    },
    RenderRow {
        name: "parallax_corrected",
        summary: "A ball of silver in a room, by one cube map that was taken beside it",
        effects: &["interface", "parallax"],
        text: include_str!("passes/parallax_corrected.wgsl"),
        passes: &[
            PassRow {
                fragment: "fs_room",
                reads: &[Slot::Room],
                ..SKY
            },
            front(&[Slot::Room]),
        ],
        material: "silver",
        in_room: true,
        wrong: "texels of the cube map; what stands in the room would be drawn on its walls",
        ..METAL
    },
    RenderRow {
        name: "thin_film",
        summary: "A ball of titanium, anodised: no oxide at its top, 150 nm at its bottom",
        effects: &["interface"],
        method: "film_spectral_three",
        text: concat!(
            include_str!("passes/film.wgsl"),
            include_str!("passes/thin_film.wgsl")
        ),
        material: "titanium",
        film: Some("titanium_dioxide:150nm"),
        wrong: "three wavelengths stand for the spectrum; light that enters a clear base is left out, here and in the truth",
        ..METAL
    },
    RenderRow {
        name: "soap_film",
        summary: "A soap bubble that has drained: no water at its top, 800 nm at its bottom",
        effects: &["interface"],
        method: "film_spectral_six",
        text: concat!(
            include_str!("passes/film.wgsl"),
            include_str!("passes/soap_film.wgsl")
        ),
        material: "air",
        film: Some("water:800nm"),
        disperses: true,
        own_paths: Paths::All,
        wrong: "light that is reflected inside more than once, near the rim; six wavelengths stand for the spectrum",
        ..BALL
    },
    RenderRow {
        name: "water",
        summary: "A pool with waves: a mirrored and clipped picture, and a masked one of what lies below",
        effects: &["interface", "interior", "water", "normal_mapping"],
        text: include_str!("passes/water.wgsl"),
        passes: &WATER,
        body: Body::Pool,
        material: "water",
        own_paths: Paths::OneSurface,
        true_paths: Paths::OneSurface,
        eye: OVER_THE_POOL,
        wrong: "a mirrored picture bent on the screen is not what waves mirror; what that picture, or that of the floor, does not show is missing",
        ..BALL
    },
    RenderRow {
        name: "stained_glass",
        summary: "A rose window: tinted panes with a normal map, before the sky",
        effects: &["interface", "interior", "normal_mapping"],
        text: include_str!("passes/stained_glass.wgsl"),
        passes: &[SKY, front(&[Slot::Paint, Slot::Relief])],
        body: Body::Window,
        material: "soda_lime_glass",
        eye: BEFORE_THE_WINDOW,
        wrong: "glass has no thickness: beside leads; light that is reflected between its surfaces is missing",
        ..BALL
    },
];

/// Whether a film hangs free: what lies below it is as what lies outside.
pub fn hangs_free(surface: &Surface) -> bool {
    let outside = Index { n: 1.0, k: 0.0 };
    surface.indices.iter().all(|index| *index == outside)
}

/// The row of this name.
pub fn find(name: &str) -> Option<&'static RenderRow> {
    ALL.iter().find(|row| row.name == name)
}

/// A picture that is drawn.
#[derive(Clone, Copy, Debug)]
pub struct RenderRow {
    /// Its name on the command line.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// The effects whose functions it calls, as users import them.
    pub effects: &'static [&'static str],
    /// The method that computes R.
    pub method: &'static str,
    /// The row's own shader text: entry points, look-ups, loops.
    pub text: &'static str,
    /// The draws in order.
    pub passes: &'static [PassRow],
    /// The body.
    pub body: Body,
    /// The material's name in the catalogue.
    pub material: &'static str,
    /// The film on it, as `--film` names it: gone at the body's top, of this thickness at its bottom.
    pub film: Option<&'static str>,
    /// Whether the index depends on the wavelength.
    pub disperses: bool,
    /// The paths that the effect follows.
    pub own_paths: Paths,
    /// The paths of the truth.
    pub true_paths: Paths,
    /// The position of the eye.
    pub eye: [f64; 3],
    /// Whether the scene is in the room rather than under the sky.
    pub in_room: bool,
    /// The steepest slope of the dents, where the surface is hammered.
    pub dents: Option<f64>,
    /// For light on a receiver instead of an eye's view: the receiver's distance below the body's centre, and half its width.
    pub receiver: Option<[f64; 2]>,
    /// Where it must be wrong, in one line.
    pub wrong: &'static str,
}

/// What a pass draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnSurface {
    /// All pixels.
    Everywhere,
    /// The side of the body that faces the eye.
    Front,
    /// The side that faces away.
    Back,
    /// The water's surface. The pass itself decides what stands in front of it.
    Water,
}

impl DrawnSurface {
    /// The vertex entry point.
    pub fn vertex(self) -> &'static str {
        match self {
            DrawnSurface::Everywhere => "vs_cover",
            DrawnSurface::Front | DrawnSurface::Back | DrawnSurface::Water => "vs_body",
        }
    }

    /// The depth test.
    pub fn depth(self) -> Depth {
        match self {
            DrawnSurface::Everywhere | DrawnSurface::Water => Depth::Unused,
            DrawnSurface::Front => Depth::Nearest,
            DrawnSurface::Back => Depth::Farthest,
        }
    }
}

/// Where a pass is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The eye.
    Eye,
    /// The eye, in a picture with a margin, for look-ups beyond the edge.
    Margin,
    /// The eye mirrored in the plane y = 0, with the same margin. What lies below the plane is clipped.
    Mirrored,
    /// The same without clipping, to show why clipping is needed.
    MirroredUnclipped,
}

/// A draw.
#[derive(Clone, Copy, Debug)]
pub struct PassRow {
    /// The fragment entry point.
    pub fragment: &'static str,
    /// What it draws.
    pub surface: DrawnSurface,
    /// Where it is drawn from.
    pub view: View,
    /// The slots that it writes.
    pub writes: &'static [Slot],
    /// The slots that it reads, from binding 4 on.
    pub reads: &'static [Slot],
}

impl RenderRow {
    /// Whether a pass searches for the end of a refracted ray in a picture of the scene.
    pub fn searches(&self) -> bool {
        let positions = [Slot::BackPositions, Slot::BelowPositions];
        let mut passes = self.passes.iter();
        passes.any(|pass| positions.iter().any(|slot| pass.reads.contains(slot)))
    }

    /// Whether the scene has water.
    pub fn has_water(&self) -> bool {
        self.body == Body::Pool
    }

    /// Whether the environment is visible.
    pub fn is_under_the_sky(&self) -> bool {
        !self.in_room && self.receiver.is_none()
    }

    /// Its own material, under its film.
    pub fn source(&self) -> Source {
        let named = |name: &str| Source::Named(name.to_owned());
        let film = self.film.map(|word| {
            let (name, thickness_nm) = film_of_word(word).expect("a row's film has a thickness");
            (named(name), thickness_nm)
        });
        named(self.material).under_films(film.into_iter().collect())
    }

    /// Whether light passes through the body.
    pub fn is_transparent(&self) -> bool {
        self.true_paths != Paths::Mirror
    }
}
