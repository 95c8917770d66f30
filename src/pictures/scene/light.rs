//! What light does outside of bodies: where it comes from, and how surfaces turn it. Also the result of a traced sample.

use glam::DVec3;

use super::environment::Environment;
use super::room::room_radiance;

/// How far light is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paths {
    /// Until less than a ten-thousandth is left, or for 64 reflections inside.
    All,
    /// A ray that is refracted once counts as outside.
    OneSurface,
    /// A ray is refracted at the second surface too. Where it is reflected totally there, it counts as outside after that.
    TwoSurfaces,
    /// Only what is reflected outside; nothing enters.
    Mirror,
}

/// The result of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traced {
    /// Radiance by the first of the two kinds of paths.
    pub colour: DVec3,
    /// Radiance by the second kind.
    pub own: DVec3,
    /// Whether it shows the body.
    pub is_body: bool,
    /// Whether the ray inside of the middle wavelength is reflected totally where it first meets the surface.
    pub is_total: bool,
}

impl Traced {
    /// A sample beside the body.
    pub fn beside(colour: DVec3) -> Traced {
        Traced {
            colour,
            own: colour,
            ..Traced::default()
        }
    }
}

/// The surroundings of a body.
#[derive(Clone, Copy, Debug)]
pub enum Around<'a> {
    /// An environment, whose radiance depends on the direction alone.
    Far(&'a Environment),
    /// The room.
    Room,
}

impl Around<'_> {
    /// The radiance that reaches a place along a direction that points away from it.
    pub fn radiance(&self, place: DVec3, direction: DVec3) -> DVec3 {
        match self {
            Around::Far(environment) => environment.radiance(direction),
            Around::Room => room_radiance(place, direction),
        }
    }
}

/// The law of reflection.
pub fn mirrored(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// Snell's law: the part along the surface is scaled by the ratio of indices. `None` past the critical angle.
pub fn refracted(direction: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    let along = (direction - direction.dot(normal) * normal) / eta;
    let rest = 1.0 - along.length_squared();
    (rest > 0.0).then(|| along - rest.sqrt() * normal)
}
