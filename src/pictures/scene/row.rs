//! What a row of the table of pictures says: its passes, what they read and write, and its scene.

use super::body::Body;
use super::pool::pool;
use super::trace::Paths;
use super::window::window;

/// A picture that is drawn.
#[derive(Clone, Copy, Debug)]
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
    /// The steepest slope of its dents, where its surface is hammered.
    pub dents: Option<f64>,
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
    /// The pool.
    Pool,
    /// The window of stained glass.
    Window,
}

impl BodyName {
    /// The body.
    pub fn body(self) -> Body {
        match self {
            BodyName::Ball => Body::Ball,
            BodyName::Gem => Body::gem(),
            BodyName::Pool => Body::Pool(pool()),
            BodyName::Window => Body::Window(window()),
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            BodyName::Ball => "ball",
            BodyName::Gem => "gem",
            BodyName::Pool => "pool",
            BodyName::Window => "window",
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
    /// What lies below the water, with 1 in alpha; 0 for what stands before it.
    Below,
    /// Where that is.
    BelowPositions,
    /// The scene above the water, mirrored in it.
    Mirror,
    /// Where that is, with 1 in alpha; 0 where nothing but the sky is.
    MirrorPositions,
    /// The cube map of the room.
    Room,
    /// The normal map.
    Relief,
    /// The radiance of solid things, by their texture coordinates; of a window the colours of glass, with 1 in alpha, and of lead and stone, with 0.
    Paint,
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
    /// The water's surface, over what is there: what stands before it is for the pass to say.
    Water,
}

/// Where a pass is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The eye.
    Eye,
    /// The eye, in a picture with a margin: for look-ups beyond the edge.
    Margin,
    /// The eye mirrored in the plane y = 0, with that margin. What lies below the plane is clipped.
    Mirrored,
    /// The same without clipping, to show what clipping is for.
    MirroredUnclipped,
}

/// A draw.
#[derive(Clone, Copy, Debug)]
pub struct PassRow {
    /// The entry point for pixels.
    pub fragment: &'static str,
    /// What it draws.
    pub place: Place,
    /// Where it is drawn from.
    pub view: View,
    /// What it writes.
    pub writes: &'static [Slot],
    /// What it reads, from binding 4 on.
    pub reads: &'static [Slot],
}

impl RenderRow {
    /// Whether it searches for the end of a refracted ray in a picture of what is there.
    pub fn searches(&self) -> bool {
        let positions = [Slot::BackPositions, Slot::BelowPositions];
        let mut passes = self.passes.iter();
        passes.any(|pass| positions.iter().any(|slot| pass.reads.contains(slot)))
    }

    /// Whether there is water in it.
    pub fn has_water(&self) -> bool {
        self.body == BodyName::Pool
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
