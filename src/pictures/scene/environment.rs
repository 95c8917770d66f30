//! The surroundings of a scene: radiance by direction, in a table that both the tracer and the device look up. Also the default
//! sky of pictures: a sun, a horizon with coloured posts, a checkered ground.
//!
//! Longitude lies along the rows, with -z in the middle and +x to the right of it. Latitude lies along the columns, with +y on
//! top.

use glam::{DVec2, DVec3, DVec4};
use half::f16;

use super::light_file::LightFile;
use super::texels::Texels;
use crate::physics::foreign::Foreign;
use crate::physics::spectra::Space;

/// Radiance by direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// The radiance in three channels; the fourth is 1.
    pub table: Texels,
}

/// The most texels in a row of a user's picture.
const LARGEST: usize = 16384;

impl Environment {
    /// An environment from a function of the direction, with this many rows and twice as many columns.
    pub fn baked(height: usize, radiance: impl Fn(DVec3) -> DVec3 + Sync) -> Environment {
        let width = 2 * height;
        // Four samples a texel, so that edges are as smooth as the table is fine.
        let places = [(0.25, 0.25), (0.25, 0.75), (0.75, 0.25), (0.75, 0.75)];
        let texel = |column: usize, row: usize| {
            let sample = |(down, right)| {
                let v = (row as f64 + down) / height as f64;
                radiance(direction((column as f64 + right) / width as f64, v))
            };
            let sum: DVec3 = places.map(sample).iter().sum();
            (sum / 4.0).extend(1.0)
        };
        let table = Texels::baked([width, height], texel);
        Environment { table }
    }

    /// An environment from the bytes of a picture. Radiance HDR and OpenEXR are linear; PNG and JPEG are sRGB unless they state
    /// otherwise. What the file states of its encoding is followed (`light_file.rs`), and light of other primaries is converted
    /// to the space.
    ///
    /// # Errors
    /// In words: the picture cannot be read, states an encoding that cannot be followed, or is not twice as wide as high.
    pub fn read(bytes: &[u8], space: Space) -> Result<Environment, String> {
        // Radiance pictures begin with one of two names of the format; the crate knows the first.
        let renamed = bytes
            .strip_prefix(b"#?RGBE")
            .map(|rest| [b"#?RADIANCE", rest].concat());
        let bytes = renamed.as_deref().unwrap_or(bytes);
        let file = LightFile::read(bytes, space).map_err(|why| Foreign(why).to_string())?;
        let (width, height) = file.picture.dimensions();
        let (width, height) = (width as usize, height as usize);
        if width != 2 * height || !(2..=LARGEST).contains(&width) {
            return Err(format!(
                "it has {width} x {height} pixels; an environment is twice as wide as high, 2 to {LARGEST} pixels wide"
            ));
        }
        let greatest = DVec3::splat(f64::from(f16::MAX));
        let texel = |column: usize, row: usize| {
            let light = file.light(file.picture.get_pixel(column as u32, row as u32).0);
            light.max(DVec3::ZERO).min(greatest).extend(1.0)
        };
        let table = Texels::baked([width, height], texel);
        Ok(Environment { table })
    }

    /// The same with half as many rows. Each texel is the mean of those that it covers, by solid angle. `None` below two rows.
    pub fn halved(&self) -> Option<Environment> {
        let [columns, rows] = self.table.size();
        if rows < 2 {
            return None;
        }
        let height = rows / 2;
        let width = 2 * height;
        let solid_angle =
            |row: usize| libm::sin(std::f64::consts::PI * (row as f64 + 0.5) / rows as f64);
        // With an odd number of rows, two texels share one.
        let covered = |at: usize, all: usize, parts: usize| {
            at * all / parts..((at + 1) * all).div_ceil(parts)
        };
        let texel = |column: usize, row: usize| {
            let (mut sum, mut whole) = (DVec4::ZERO, 0.0);
            for y in covered(row, rows, height) {
                for x in covered(column, columns, width) {
                    sum += solid_angle(y) * self.table.texel(x, y);
                    whole += solid_angle(y);
                }
            }
            sum / whole
        };
        let table = Texels::baked([width, height], texel);
        Some(Environment { table })
    }

    /// The same as an 8-bit picture holds it: nothing is brighter than white.
    pub fn clamped(&self) -> Environment {
        let table = self.table.mapped(|texel| texel.map(|x| x.min(1.0)));
        Environment { table }
    }

    /// The radiance from a direction of any length, linear between texels.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let direction = direction.normalize_or_zero();
        let u = libm::atan2(direction.x, -direction.z) / std::f64::consts::TAU + 0.5;
        let v = libm::acos(direction.y.clamp(-1.0, 1.0)) / std::f64::consts::PI;
        self.table.at_around(DVec2::new(u, v)).truncate()
    }
}

/// The direction at texture coordinates.
fn direction(u: f64, v: f64) -> DVec3 {
    let (sin_u, cos_u) = libm::sincos(std::f64::consts::TAU * (u - 0.5));
    let (sin_v, cos_v) = libm::sincos(std::f64::consts::PI * v);
    DVec3::new(sin_u * sin_v, cos_v, -cos_u * sin_v)
}

/// The sky's texels from pole to pole.
const HEIGHT: usize = 1024;
/// The sun's radiance, and the cosines between which it fades, at 2 and 3 degrees from its middle.
const SUN: f64 = 60.0;
const SUN_INSIDE: f64 = 0.9994;
const SUN_OUTSIDE: f64 = 0.9986;
/// How far the ground lies below the eye, in sides of its squares.
const GROUND: f64 = 2.2;
/// The distance over which the ground fades into the haze.
const HAZE: f64 = 12.0;
/// The number of posts on the horizon, and the sine of the elevation of their tops.
const POSTS: f64 = 12.0;
const POST_TOP: f64 = 0.3;

/// The default sky.
pub fn sky() -> Environment {
    Environment::baked(HEIGHT, radiance)
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

/// The colour of a post, which tells it from the others.
fn post_colour(number: f64) -> DVec3 {
    let hue = std::f64::consts::TAU * number / POSTS;
    let wave = |shift: f64| 0.35 + 0.33 * libm::cos(hue - shift);
    let third = std::f64::consts::TAU / 3.0;
    DVec3::new(wave(0.0), wave(third), wave(2.0 * third))
}

/// A smooth step.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_halved_table_keeps_the_mean_over_all_directions() {
        let mut table = Environment::baked(37, |direction| direction + DVec3::ONE);
        while let Some(next) = table.halved() {
            let [columns, rows] = table.table.size();
            let (mut sum, mut whole) = (DVec4::ZERO, 0.0);
            for row in 0..rows {
                let weight = libm::sin(std::f64::consts::PI * (row as f64 + 0.5) / rows as f64);
                for column in 0..columns {
                    sum += weight * table.table.texel(column, row);
                    whole += weight;
                }
            }
            let off = (sum / whole - DVec4::ONE).abs().max_element();
            assert!(off < 0.02, "{rows} {off}");
            table = next;
        }
        assert_eq!(table.table.size(), [2, 1]);
    }

    #[test]
    fn a_table_gives_back_what_it_was_baked_from() {
        let environment = Environment::baked(64, |direction| direction.abs());
        for direction in [DVec3::X, DVec3::NEG_Z, DVec3::Z, DVec3::new(0.3, -0.8, 0.2)] {
            let direction = direction.normalize();
            let error = environment.radiance(direction) - direction.abs();
            assert!(error.length() < 0.05, "{direction} {error}");
        }
    }
}
