//! The sky that pictures are taken under unless another is named: a sun, a horizon with coloured posts, a checkered ground.

use glam::DVec3;

use super::environment::Environment;

/// Texels from pole to pole.
const HEIGHT: usize = 1024;
/// The sun's radiance, and the cosines between which it fades: 2 and 3 degrees from its middle.
const SUN: f64 = 60.0;
const SUN_INSIDE: f64 = 0.9994;
const SUN_OUTSIDE: f64 = 0.9986;
/// How far the ground lies below the eye, in sides of its squares.
const GROUND: f64 = 2.2;
/// The distance over which the ground fades into the haze.
const HAZE: f64 = 12.0;
/// Posts on the horizon, and the height of their top: the sine of its elevation.
const POSTS: f64 = 12.0;
const POST_TOP: f64 = 0.3;

/// That sky.
pub fn sky() -> Environment {
    sky_of(HEIGHT)
}

/// The same sky, so many texels from pole to pole.
pub fn sky_of(height: usize) -> Environment {
    Environment::baked(height, radiance)
}

/// The direction of the sun's middle.
pub(super) fn to_sun() -> DVec3 {
    DVec3::new(-0.45, 0.62, 0.4).normalize()
}

fn radiance(direction: DVec3) -> DVec3 {
    let horizon = DVec3::new(0.75, 0.82, 0.9);
    let azimuth = libm::atan2(direction.x, -direction.z) / std::f64::consts::TAU + 0.5;
    let post = azimuth * POSTS;
    if direction.y.abs() < POST_TOP
        && direction.y > -0.04
        && (post - post.floor() - 0.5).abs() < 0.12
    {
        return post_colour(post.floor());
    }
    if direction.y < 0.0 {
        return ground(direction, horizon);
    }
    let zenith = DVec3::new(0.12, 0.28, 0.68);
    let near = direction.dot(to_sun());
    let disc = smooth((near - SUN_OUTSIDE) / (SUN_INSIDE - SUN_OUTSIDE)) * SUN;
    let glow = 0.6 * libm::pow(near.max(0.0), 64.0);
    let blue = horizon.lerp(zenith, libm::sqrt(direction.y));
    blue + (disc + glow) * DVec3::new(1.0, 0.93, 0.8)
}

fn ground(direction: DVec3, horizon: DVec3) -> DVec3 {
    let place = direction * (GROUND / -direction.y);
    let is_light = (place.x.floor() + place.z.floor()).rem_euclid(2.0) == 0.0;
    let square = if is_light {
        DVec3::new(0.8, 0.74, 0.62)
    } else {
        DVec3::new(0.3, 0.1, 0.06)
    };
    let distance = libm::hypot(place.x, place.z);
    horizon.lerp(square, libm::exp(-distance / HAZE))
}

/// Colours that tell the posts apart.
fn post_colour(number: f64) -> DVec3 {
    let hue = std::f64::consts::TAU * number / POSTS;
    let wave = |shift: f64| 0.35 + 0.33 * libm::cos(hue - shift);
    let third = std::f64::consts::TAU / 3.0;
    DVec3::new(wave(0.0), wave(third), wave(2.0 * third))
}

/// A step without corners.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
