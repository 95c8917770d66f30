//! The truth of pictures: rays followed through a body in f64, by Snell's and Fresnel's laws alone. Nothing here is generated and
//! no graph is evaluated, so the effects are compared with an independent second implementation.

use glam::DVec3;

use super::body::Body;
use super::frame::Camera;
use super::light::{Around, Paths, Traced, mirrored, refracted};
use super::material::{OpticalMaterial, SpectralSample};
use super::pool::POOL;
use super::room::Relief;
use super::window::WINDOW;
use crate::physics::num::in_parallel;

/// The contents of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Things<'a> {
    /// The body.
    pub body: Body,
    /// Its material.
    pub material: &'a OpticalMaterial,
    /// Its surroundings.
    pub around: Around<'a>,
    /// Dents of its surface, seen from outside and inside; only for a ball.
    pub relief: Option<&'a Relief>,
}

/// A scene and the two kinds of paths that are followed.
struct Scene<'a> {
    things: Things<'a>,
    paths: [Paths; 2],
}

const MOST_REFLECTIONS: usize = 64;
const LEAST: f64 = 1e-4;

/// A square picture with this many samples a side, row by row, by two kinds of paths at once. `progress` gets the number of rows
/// done and the total.
pub fn trace(
    things: Things,
    camera: &Camera,
    side: usize,
    paths: [Paths; 2],
    progress: &mut dyn FnMut(u64, u64),
) -> Vec<Traced> {
    let scene = Scene { things, paths };
    let at = |i: usize| (i as f64 + 0.5) / side as f64;
    let row = |row: usize| -> Vec<Traced> {
        let sample = |column| scene.seen(camera.eye, camera.direction(at(column), at(row)));
        (0..side).map(sample).collect()
    };
    in_parallel(side, &row, progress).concat()
}

impl Scene<'_> {
    /// What a ray from the eye shows.
    fn seen(&self, eye: DVec3, direction: DVec3) -> Traced {
        let (material, around) = (self.things.material, self.things.around);
        match self.things.body {
            Body::Pool => POOL.seen(material, around, eye, direction),
            Body::Window => WINDOW.seen(material, around, eye, direction),
            Body::Ball | Body::Gem => self.convex(eye, direction),
        }
    }

    /// The same for a convex body.
    fn convex(&self, eye: DVec3, direction: DVec3) -> Traced {
        let crossing = self.things.body.crossing(eye, direction);
        let Some(crossing) = crossing.filter(|crossing| crossing.entry.0 > 0.0) else {
            return Traced::beside(self.things.around.radiance(eye, direction));
        };
        let (distance, normal) = crossing.entry;
        let place = eye + distance * direction;
        let normal = self.dented(normal);
        let share = self.film_share(place);
        let cosine = (-direction.dot(normal)).clamp(0.0, 1.0);
        let up = mirrored(direction, normal);
        let mirrored = self.things.around.radiance(place, up);
        let mut seen = Traced {
            is_body: true,
            ..Traced::default()
        };
        let samples = &self.things.material.samples;
        let middle = samples[samples.len() / 2].index.n;
        // Rays of one index take one way.
        for rays in samples.chunk_by(|one, next| one.index.n == next.index.n) {
            let r = |ray: &SpectralSample| ray.reflectance(cosine, share);
            let mirrored_share: DVec3 = rays.iter().map(|ray| ray.weight * r(ray)).sum();
            let mut colours = [mirrored_share * mirrored; 2];
            if self.paths != [Paths::Mirror; 2] {
                let n = rays[0].index.n;
                if let Some(inside) = refracted(direction, normal, n) {
                    let entered = rays.iter().map(|ray| ray.weight * (1.0 - r(ray))).collect();
                    let (inside, is_total) = self.inside(place, inside, rays, entered);
                    colours = [0, 1].map(|path| colours[path] + inside[path]);
                    seen.is_total |= n == middle && is_total;
                }
            }
            seen.colour += colours[0];
            seen.own += colours[1];
        }
        seen
    }

    /// The share of the film's thickness at a place on the body.
    fn film_share(&self, place: DVec3) -> f64 {
        match self.things.material.film_nm > 0.0 {
            true => OpticalMaterial::share_at(place.y / self.things.body.radius()),
            false => 1.0,
        }
    }

    /// The normal, tilted by the dents.
    fn dented(&self, normal: DVec3) -> DVec3 {
        let relief = self.things.relief;
        relief.map_or(normal, |relief| relief.on_ball(normal))
    }

    /// The radiance along rays of one index inside, of which these shares entered, by both kinds of paths, and whether they are first
    /// reflected totally.
    fn inside(
        &self,
        place: DVec3,
        direction: DVec3,
        rays: &[SpectralSample],
        entered: Vec<DVec3>,
    ) -> ([DVec3; 2], bool) {
        let whole: DVec3 = entered.iter().sum();
        let goes_on = |paths: &Paths| matches!(paths, Paths::All | Paths::TwoSurfaces);
        let (two, all, is_total) = if self.paths.iter().any(goes_on) {
            self.beyond(place, direction, rays, entered)
        } else {
            (DVec3::ZERO, DVec3::ZERO, false)
        };
        let by = |paths: Paths| match paths {
            Paths::All => all,
            Paths::TwoSurfaces => two,
            Paths::OneSurface => whole * self.things.around.radiance(place, direction),
            Paths::Mirror => DVec3::ZERO,
        };
        (self.paths.map(by), is_total)
    }

    /// The radiance through the second surface alone, the radiance by all paths, and whether the rays are reflected totally at the
    /// second surface. `left` is the share of each ray that is still inside.
    fn beyond(
        &self,
        mut place: DVec3,
        mut direction: DVec3,
        rays: &[SpectralSample],
        mut left: Vec<DVec3>,
    ) -> (DVec3, DVec3, bool) {
        let n = rays[0].index.n;
        let (mut two, mut all, mut is_total) = (DVec3::ZERO, DVec3::ZERO, false);
        for turn in 0..MOST_REFLECTIONS {
            let Some(crossing) = self.things.body.crossing(place, direction) else {
                break;
            };
            let (distance, smooth) = crossing.exit;
            let normal = self.dented(smooth);
            place += distance * direction;
            let cosine = direction.dot(normal).clamp(0.0, 1.0);
            let share = self.film_share(place);
            let out = refracted(direction, -normal, 1.0 / n);
            let bounced = mirrored(direction, normal);
            // Where a dent would send the ray out of the body, the smooth surface keeps it inside.
            direction = if bounced.dot(smooth) < 0.0 {
                bounced
            } else {
                mirrored(direction, smooth)
            };
            let whole: DVec3 = left.iter().sum();
            for (left, ray) in left.iter_mut().zip(rays) {
                *left *= ray.reflectance_inside(cosine, share);
            }
            let kept: DVec3 = left.iter().sum();
            if let Some(out) = out {
                all += (whole - kept) * self.things.around.radiance(place, out);
            }
            if turn == 0 {
                is_total = out.is_none();
                two = match out {
                    Some(_) => all,
                    None => whole * self.things.around.radiance(place, direction),
                };
            }
            let rest: DVec3 = left.iter().map(|left| left.abs()).sum();
            if rest.max_element() < LEAST || !self.paths.contains(&Paths::All) {
                break;
            }
        }
        (two, all, is_total)
    }
}
