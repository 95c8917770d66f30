//! What several effects do with vectors, and arguments that several take.

use crate::language::ir::{Expr, Ty, USED_TWICE};

use super::effect::{Argument, Arguments};

/// The smallest squared length that is no zero vector.
const SHORTEST: f64 = 1e-30;

/// The direction of arriving light.
pub const INCIDENT: Argument = Argument::direction(
    "incident",
    "direction of travel, of unit length, toward the surface",
);
/// The surface's normal, as all but exits take it.
pub const NORMAL: Argument = Argument::direction(
    "normal",
    "of unit length, on the side that the light comes from; the function never flips it",
);
/// The relative index.
pub const ETA: Argument = Argument::scalar(
    "eta",
    "n_t / n_i, the index behind the surface by that before it, above 0; GLSL's refract takes the inverse",
    0.4,
    2.5,
);
/// A matrix from the world to clip space.
pub const VIEW_PROJECTION: Argument = Argument::whole(
    "view_projection",
    "from world to clip space, applied to columns",
    Ty::Mat4,
);
/// From normalised device coordinates to texture coordinates.
pub const UV_SCALE_BIAS: Argument = Argument::whole(
    "uv_scale_bias",
    "uv = ndc.xy * this.xy + this.zw: (.5, .5, .5, .5) where v points up, (.5, -.5, .5, .5) where it points down",
    Ty::Vec4,
);

/// A vector by its length; a zero vector stays one.
pub fn unit_or_zero<'b>(vector: Expr<'b>) -> Expr<'b> {
    vector * vector.dot(vector).at_least(SHORTEST).inverse_sqrt()
}

/// The length of a vector.
pub fn length<'b>(vector: Expr<'b>) -> Expr<'b> {
    vector.dot(vector).sqrt()
}

/// The vector product.
pub fn cross<'b>(with: &Arguments<'b>, a: Expr<'b>, b: Expr<'b>) -> Expr<'b> {
    let part = |i: usize, j: usize| a.channel(i) * b.channel(j) - a.channel(j) * b.channel(i);
    with.vector(part(1, 2), part(2, 0), part(0, 1))
}

/// incident - 2 (incident . normal) normal
pub fn mirrored<'b>(incident: Expr<'b>, normal: Expr<'b>) -> Expr<'b> {
    incident - normal * (2.0 * incident.dot(normal))
}

/// What Snell's law makes of a direction.
pub struct Refraction<'b> {
    /// The direction behind the surface; of no meaning where `passes` is 0.
    pub direction: Expr<'b>,
    /// 1 where light passes, 0 past the critical angle, at grazing incidence and for a zero vector.
    pub passes: Expr<'b>,
}

/// Snell's law for vectors: t = r (i + c n) - n sqrt(1 - r^2 (1 - c^2)) with r = 1/eta and c = -i . n.
pub fn refraction<'b>(
    with: &Arguments<'b>,
    incident: Expr<'b>,
    normal: Expr<'b>,
    eta: Expr<'b>,
) -> Refraction<'b> {
    let c = -incident.dot(normal);
    let c = c
        .saturate()
        .named("c", "clamp: a rounded dot product may exceed 1");
    let r = (1.0 / eta).named("r", "sin theta_t = r sin theta_i");
    let along_normal = (r * c).named("rc", USED_TWICE);
    let squared = ((1.0 - r) * (1.0 + r) + along_normal * along_normal).named(
        "cos2_t",
        "1 - r^2 (1 - c^2), the squared cosine behind the surface; negative past the critical angle",
    );
    let meets = with.number(0.0).choose_below(c, squared, with.number(-1.0));
    let passes = with
        .number(0.0)
        .choose_below(meets, with.number(1.0), with.number(0.0))
        .named("passes", "0 past the critical angle and for a zero vector");
    let along = squared.at_least(0.0).sqrt();
    let direction = (incident + normal * c) * r - normal * along;
    Refraction { direction, passes }
}
