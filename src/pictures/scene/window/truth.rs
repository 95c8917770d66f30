//! The true light through the window, in f64: slabs of glass with two surfaces, and light that is reflected between them.
//!
//! The thickness matters: a ray leaves beside the point where it entered, under another bump or behind a lead, and its tint grows
//! with its path.

use glam::{DVec2, DVec3};

use super::{WALL, Window, outward, right};
use crate::physics::optics;
use crate::pictures::scene::light::{Around, Traced, mirrored, refracted};
use crate::pictures::scene::material::OpticalMaterial;

/// The thickness of the glass.
const THICKNESS: f64 = 0.006;
/// How many times light is followed from the front to the back.
const MOST_TURNS: usize = 8;
const LEAST: f64 = 1e-5;

impl Window {
    /// What a ray from the eye shows: with all reflections between both surfaces, and by refraction alone in glass without
    /// thickness.
    pub fn seen(
        &self,
        glass: &OpticalMaterial,
        around: Around,
        eye: DVec3,
        direction: DVec3,
    ) -> Traced {
        let distance = -eye.dot(outward()) / direction.dot(outward());
        let place = eye + distance * direction;
        let at = DVec2::new(place.dot(right()), place.y);
        if distance <= 0.0 || at.abs().max_element() > WALL {
            return Traced::beside(around.radiance(eye, direction));
        }
        let (paint, normal) = (self.paint_at(at), self.normal_at(at));
        if paint.w < 0.5 {
            return Traced::beside(paint.truncate() * room(normal));
        }
        let n = glass.n.y;
        let r = optics::dielectric(n, (-direction.dot(normal)).clamp(0.0, 1.0)).unpolarised();
        let reflection = r * room(mirrored(direction, normal));
        let [all, once] = match refracted(direction, normal, n) {
            Some(inside) => self.inside(at, inside, n, around),
            None => [DVec3::ZERO; 2],
        };
        Traced {
            colour: reflection + (1.0 - r) * all,
            own: reflection + (1.0 - r) * once,
            is_body: true,
            is_total: false,
        }
    }

    /// The radiance along a ray in the glass from its front: by all paths, and by what leaves at first as if the glass had no
    /// thickness.
    fn inside(&self, mut at: DVec2, mut direction: DVec3, n: f64, around: Around) -> [DVec3; 2] {
        let (mut all, mut once, mut left) = (DVec3::ZERO, DVec3::ZERO, DVec3::ONE);
        for turn in 0..MOST_TURNS {
            let cosine = direction.dot(outward());
            if cosine <= 1e-6 {
                break;
            }
            left *= self.paint_at(at).truncate().powf(1.0 / cosine);
            at += across(direction, cosine);
            let r = optics::dielectric(1.0 / n, cosine.min(1.0)).unpolarised();
            if let Some(out) = refracted(direction, -outward(), 1.0 / n) {
                let light = left * (1.0 - r) * around.radiance(DVec3::ZERO, out);
                if turn == 0 {
                    once = light;
                }
                if self.is_glass(at) {
                    all += light;
                }
            }
            left *= r;
            direction = mirrored(direction, outward());
            if left.max_element() < LEAST || !self.is_glass(at) {
                break;
            }
            left *= self.paint_at(at).truncate().powf(1.0 / cosine);
            at += across(direction, cosine);
            if !self.is_glass(at) {
                break;
            }
            let normal = self.normal_at(at);
            let cosine = direction.dot(normal).clamp(0.0, 1.0);
            let r = optics::dielectric(1.0 / n, cosine).unpolarised();
            if let Some(out) = refracted(direction, -normal, 1.0 / n) {
                all += left * (1.0 - r) * room(out);
            }
            left *= r;
            direction = mirrored(direction, normal);
        }
        [all, once]
    }

    fn is_glass(&self, at: DVec2) -> bool {
        self.paint_at(at).w >= 0.5
    }
}

/// How far a ray moves along the wall between the two surfaces.
fn across(direction: DVec3, cosine: f64) -> DVec2 {
    THICKNESS / cosine * DVec2::new(direction.dot(right()), direction.y)
}

/// The light in the room by direction: the windows light the floor.
fn room(direction: DVec3) -> DVec3 {
    DVec3::new(0.055, 0.048, 0.04) * (1.2 - 0.8 * direction.y)
}
