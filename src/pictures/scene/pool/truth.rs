//! The true light of the pool, in f64: from the eye to the water, and from there along the reflected and the refracted ray to
//! what they meet. Rays meet the waves once as a surface with its heights, and once as a plane with the waves' normals.
//!
//! The waves are a sum of sines. Their height is the surface of the truth; their slopes are the normal map of the drawn picture.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::solids::{Hit, hit};
use super::{BASIN_MAX, BASIN_MIN, Pool, is_within_sides};
use crate::physics::optics;
use crate::pictures::scene::light::{Around, Traced, mirrored, refracted};
use crate::pictures::scene::material::OpticalMaterial;

/// How many places are tried along a ray between the highest crest and the lowest trough, and the steps of the search between two
/// of them.
const TRIES: usize = 12;
const STEPS: usize = 6;
/// The most reflections of a ray at the water.
const MOST_REFLECTIONS: usize = 3;

/// The surface of the water.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Surface {
    /// With the heights of the waves.
    Waves,
    /// The plane, with the normals of the waves.
    Plane,
}

/// The pool and its surroundings, as light meets them.
struct Light<'a> {
    pool: &'a Pool,
    /// The index of the water.
    n: f64,
    /// Its absorption coefficient, per metre.
    absorption: DVec3,
    around: Around<'a>,
}

impl Pool {
    /// What a ray from the eye shows: by the waves' heights, and by their normals alone.
    pub fn seen(
        &self,
        water: &OpticalMaterial,
        around: Around,
        eye: DVec3,
        direction: DVec3,
    ) -> Traced {
        let light = Light {
            pool: self,
            n: water.n.y,
            absorption: water.absorption(),
            around,
        };
        let solid = hit(eye, direction);
        let nearest = solid.map_or(f64::INFINITY, |solid| solid.distance);
        let by = |surface: Surface| match light.meets(surface, eye, direction) {
            Some(distance) if distance < nearest => {
                let place = eye + distance * direction;
                Some(light.at_water(surface, place, direction, MOST_REFLECTIONS))
            }
            _ => None,
        };
        let without = light.without_water(solid, eye, direction);
        let (waves, plane) = (by(Surface::Waves), by(Surface::Plane));
        Traced {
            colour: waves.unwrap_or(without),
            own: plane.unwrap_or(without),
            is_body: waves.is_some() && plane.is_some(),
            is_total: false,
        }
    }
}

impl Light<'_> {
    fn without_water(&self, solid: Option<Hit>, place: DVec3, direction: DVec3) -> DVec3 {
        match solid {
            Some(hit) => self.pool.paint.at(hit.part.uv(hit.at)).truncate(),
            None => self.around.radiance(place, direction),
        }
    }

    /// The radiance along a ray above the water that may be reflected this many more times.
    fn above(&self, surface: Surface, place: DVec3, direction: DVec3, left: usize) -> DVec3 {
        let solid = hit(place, direction);
        let nearest = solid.map_or(f64::INFINITY, |solid| solid.distance);
        match self.meets(surface, place, direction) {
            Some(distance) if distance < nearest && left > 0 => {
                self.at_water(surface, place + distance * direction, direction, left)
            }
            _ => self.without_water(solid, place, direction),
        }
    }

    /// The radiance of a place of the surface along a ray from above.
    fn at_water(&self, surface: Surface, place: DVec3, direction: DVec3, left: usize) -> DVec3 {
        let normal = self.normal(surface, place);
        let cosine = (-direction.dot(normal)).clamp(0.0, 1.0);
        let r = optics::dielectric(self.n, cosine).unpolarised();
        let up = mirrored(direction, normal);
        let reflection = self.above(surface, place + 1e-6 * normal, up, left - 1);
        let refraction = match refracted(direction, normal, self.n) {
            Some(down) => self.below(place - 1e-6 * normal, down),
            None => DVec3::ZERO,
        };
        r * reflection + (1.0 - r) * refraction
    }

    fn below(&self, place: DVec3, direction: DVec3) -> DVec3 {
        let Some(hit) = hit(place, direction) else {
            return DVec3::ZERO;
        };
        let dimmed = (-self.absorption * hit.distance).exp();
        dimmed * self.pool.paint.at(hit.part.uv(hit.at)).truncate()
    }

    fn normal(&self, surface: Surface, place: DVec3) -> DVec3 {
        let place = place.xz();
        match surface {
            Surface::Waves => self.pool.waves.normal(place),
            Surface::Plane => {
                let [min, max] = [BASIN_MIN, BASIN_MAX].map(|corner| corner.xz());
                let uv = (place - min) / (max - min);
                let mapped = self.pool.normals.at(uv);
                DVec3::new(mapped.x, mapped.z, mapped.y).normalize()
            }
        }
    }

    /// The distance to the water, for rays that go down.
    fn meets(&self, surface: Surface, origin: DVec3, direction: DVec3) -> Option<f64> {
        if direction.y >= 0.0 {
            return None;
        }
        let distance = match surface {
            Surface::Plane => Some(-origin.y / direction.y).filter(|distance| *distance > 1e-5),
            Surface::Waves => self.meets_waves(origin, direction),
        }?;
        is_within_sides(origin + distance * direction).then_some(distance)
    }

    /// Finds the first sample below the surface, and searches between it and the one before.
    fn meets_waves(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let waves = &self.pool.waves;
        let to_height = |height: f64| ((height - origin.y) / direction.y).max(0.0);
        let (first, last) = (to_height(waves.highest), to_height(-waves.highest));
        let above = |distance: f64| {
            let place = origin + distance * direction;
            place.y - waves.height(place.xz())
        };
        let mut before = (first, above(first));
        if before.1 <= 0.0 {
            return Some(first);
        }
        for i in 1..=TRIES {
            let distance = first + (last - first) * i as f64 / TRIES as f64;
            let after = (distance, above(distance));
            if after.1 <= 0.0 {
                return Some(between(before, after, above));
            }
            before = after;
        }
        None
    }
}

/// A root of a function between two places, by the secant method.
fn between(mut before: (f64, f64), mut after: (f64, f64), of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..STEPS {
        let share = before.1 / (before.1 - after.1);
        let distance = before.0 + share.clamp(0.05, 0.95) * (after.0 - before.0);
        let value = of(distance);
        if value > 0.0 {
            before = (distance, value);
        } else {
            after = (distance, value);
        }
    }
    before.0 + (after.0 - before.0) * before.1 / (before.1 - after.1)
}

/// Wavelength in metres, direction in radians, steepest slope, phase.
const WAVES: [[f64; 4]; 7] = [
    [2.6, 1.1, 0.030, 0.0],
    [1.5, 0.4, 0.032, 1.3],
    [1.05, 2.0, 0.030, 4.1],
    [0.72, 0.9, 0.028, 2.2],
    [0.53, 2.6, 0.024, 5.3],
    [0.41, 0.1, 0.020, 0.7],
    [0.33, 1.6, 0.018, 3.6],
];

/// A sine wave.
#[derive(Clone, Debug, PartialEq)]
struct Wave {
    /// 2 pi over the wavelength, along its direction.
    wave_vector: DVec2,
    amplitude: f64,
    phase: f64,
}

/// The surface y = height(x, z).
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    waves: Vec<Wave>,
    /// The height that no crest exceeds.
    pub highest: f64,
}

impl Waves {
    /// The waves of the pictures.
    pub fn new() -> Waves {
        let wave = |[length, direction, slope, phase]: [f64; 4]| {
            let (sin, cos) = libm::sincos(direction);
            let number = std::f64::consts::TAU / length;
            Wave {
                wave_vector: number * DVec2::new(cos, sin),
                amplitude: slope / number,
                phase,
            }
        };
        let waves = WAVES.map(wave).to_vec();
        Waves {
            highest: waves.iter().map(|wave| wave.amplitude).sum(),
            waves,
        }
    }

    /// The height at x and z.
    pub fn height(&self, place: DVec2) -> f64 {
        let each = |wave: &Wave| wave.amplitude * libm::sin(wave.angle(place));
        self.waves.iter().map(each).sum()
    }

    /// The normal at x and z, upward.
    pub fn normal(&self, place: DVec2) -> DVec3 {
        let each = |wave: &Wave| {
            let cosine = libm::cos(wave.angle(place));
            wave.amplitude * cosine * wave.wave_vector
        };
        let slope: DVec2 = self.waves.iter().map(each).sum();
        DVec3::new(-slope.x, 1.0, -slope.y).normalize()
    }
}

impl Wave {
    fn angle(&self, place: DVec2) -> f64 {
        self.wave_vector.dot(place) + self.phase
    }
}
