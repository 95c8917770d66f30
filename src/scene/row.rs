//! What a row of the table of pictures says: its passes, what they read and write, and its scene.

use super::body::Body;
use super::trace::Paths;

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

/// Where a pass is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The eye.
    Eye,
    /// The eye mirrored in the plane y = 0. What lies below the plane is clipped.
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
