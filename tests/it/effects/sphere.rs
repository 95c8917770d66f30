//! A ball of radius 1 as a camera sees it: how well the search finds where rays leave it, and where they then go.

use super::add;
use super::dot;
use super::function;
use super::many;
use super::numbers;
use super::unit;
use super::vector;
use super::vectors;
use fresnel_gen::language::ir::{Filter, Texels, Value, evaluate};

const SIZE: usize = 512;

/// A ball, and a camera on +z that looks along -z; the silhouette takes 90 % of the picture's height.
struct View {
    n: f64,
    eye: f64,
    filter: Filter,
}

/// Rays that entered the ball.
struct Rays {
    entry: Vec<[f64; 3]>,
    inside: Vec<[f64; 3]>,
}

impl View {
    fn half_height(&self) -> f64 {
        (1.0 / self.eye).asin().tan() / 0.9
    }

    /// From the world to clip space, column after column.
    fn view_projection(&self) -> Value<f64> {
        let scale = 1.0 / self.half_height();
        let mut matrix = [0.0; 16];
        (matrix[0], matrix[5]) = (scale, scale);
        (matrix[10], matrix[11]) = (-1.0, -1.0);
        (matrix[14], matrix[15]) = (self.eye - 0.1, self.eye);
        many(&matrix)
    }

    /// The rays through all pixels.
    fn rays(&self) -> Vec<[f64; 3]> {
        let at = |i: usize| (2.0 * (i as f64 + 0.5) / SIZE as f64 - 1.0) * self.half_height();
        (0..SIZE * SIZE)
            .map(|i| unit([at(i % SIZE), at(i / SIZE), -1.0]))
            .collect()
    }

    /// Where a ray from the eye meets the ball, first and last.
    fn meets(&self, direction: [f64; 3]) -> Option<([f64; 3], [f64; 3])> {
        let eye = [0.0, 0.0, self.eye];
        let b = dot(eye, direction);
        let under = b * b - dot(eye, eye) + 1.0;
        let at = |root: f64| add(eye, direction, -b + root);
        (under > 0.0).then(|| (at(-under.sqrt()), at(under.sqrt())))
    }

    /// The places of the back, which are its normals too, with 1 in alpha.
    fn back(&self) -> Value<f64> {
        let rays = self.rays();
        let back: Vec<_> = rays.iter().map(|ray| self.meets(*ray)).collect();
        let place = |met: &Option<([f64; 3], [f64; 3])>| met.map_or([0.0; 3], |(_, back)| back);
        Value::Texture(Some(Texels {
            width: SIZE,
            texels: back
                .iter()
                .map(|met| place(met).map(|part| part as f32))
                .collect(),
            alpha: Some(back.iter().map(|met| f32::from(met.is_some())).collect()),
            filter: self.filter,
        }))
    }

    fn refracted(&self) -> Rays {
        let incident: Vec<[f64; 3]> = self.rays();
        let met = |ray: &[f64; 3]| self.meets(*ray).map(|(front, _)| (*ray, front));
        let (incident, entry): (Vec<_>, Vec<_>) = incident.iter().filter_map(met).unzip();
        let arguments = [vectors(&incident), vectors(&entry), Value::scalar(self.n)];
        let refracted = evaluate(&function("refracted"), &arguments);
        Rays {
            inside: (0..entry.len()).map(|i| refracted.at(i)).collect(),
            entry,
        }
    }

    /// The distances after each step of the search.
    fn searched(&self, rays: &Rays, steps: usize) -> Vec<Vec<f64>> {
        let step = function("interior_search_step");
        let back = self.back();
        let mut distances = vec![vec![1.0; rays.entry.len()]];
        for _ in 0..steps {
            let arguments = [
                vectors(&rays.entry),
                vectors(&rays.inside),
                numbers(distances.last().expect("it begins with one")),
                self.view_projection(),
                many(&[0.5; 4]),
                back.clone(),
            ];
            let next = evaluate(&step, &arguments);
            distances.push((0..rays.entry.len()).map(|i| next.at(i)[0]).collect());
        }
        distances.split_off(1)
    }

    /// The directions outside from where the search ended, by the picture's normals; those of total reflection point inward.
    fn leaving(&self, rays: &Rays, distances: &[f64]) -> Vec<[f64; 3]> {
        let found = rays.entry.iter().zip(&rays.inside).zip(distances);
        let found: Vec<[f64; 3]> = found
            .map(|((entry, inside), distance)| add(*entry, *inside, distance.abs()))
            .collect();
        let arguments = [vectors(&found), self.view_projection(), many(&[0.5; 4])];
        let uv = evaluate(&function("planar_uv"), &arguments);
        let Value::Texture(Some(back)) = self.back() else {
            unreachable!("it is a texture")
        };
        let normal = |i: usize| {
            let [u, v, _] = uv.at(i);
            unit(back.sample(fresnel_gen::language::ir::Weights::Exact, u, v))
        };
        let normals: Vec<[f64; 3]> = (0..found.len()).map(normal).collect();
        let arguments = [
            vectors(&rays.inside),
            vectors(&normals),
            Value::scalar(1.0 / self.n),
        ];
        let leaving = evaluate(&function("exit_direction"), &arguments);
        (0..found.len()).map(|i| leaving.at(i)).collect()
    }
}

/// The length of the chord that a ray takes.
fn chord(entry: [f64; 3], inside: [f64; 3]) -> f64 {
    -2.0 * dot(entry, inside)
}

fn share(of: impl Iterator<Item = bool>) -> f64 {
    let (mut holds, mut all) = (0usize, 0usize);
    for one in of {
        holds += usize::from(one);
        all += 1;
    }
    holds as f64 / all as f64
}

/// The measured share is the recorded one.
#[track_caller]
fn check_recorded(what: &str, measured: f64, recorded: f64) {
    println!("{what}: {measured:.5}");
    assert!(
        (measured - recorded).abs() < 5e-4,
        "{what}: {measured:.5}, recorded {recorded}"
    );
}

const GLASS: View = View {
    n: 1.5,
    eye: 3.0,
    filter: Filter::Linear,
};

/// A ray is found where it ends within 1 % of the diameter.
#[test]
fn four_steps_find_the_back_of_a_ball() {
    let rays = GLASS.refracted();
    let distances = GLASS.searched(&rays, 4);
    let found = |after: usize| {
        let pairs = rays
            .entry
            .iter()
            .zip(&rays.inside)
            .zip(&distances[after - 1]);
        share(pairs.map(|((entry, inside), d)| (d - chord(*entry, *inside)).abs() < 0.02))
    };
    assert!(found(4) >= 0.999, "{}", found(4));
    check_recorded("found after three", found(3), 0.98153);
    check_recorded("found after two", found(2), 0.71306);
}

#[test]
fn eight_steps_give_the_direction_behind_a_ball() {
    let rays = GLASS.refracted();
    let distances = GLASS.searched(&rays, 8);
    let leaving = GLASS.leaving(&rays, &distances[7]);
    let function = function("exit_direction");
    let right = (0..rays.entry.len()).map(|i| {
        let (entry, inside) = (rays.entry[i], rays.inside[i]);
        let exit = add(entry, inside, chord(entry, inside));
        let arguments = [vector(inside), vector(exit), Value::scalar(1.0 / GLASS.n)];
        let want = evaluate(&function, &arguments).at(0);
        let apart = add(leaving[i], want, -1.0);
        dot(apart, apart).sqrt() < 1e-3
    });
    let right = share(right);
    println!("within 1e-3 rad: {right:.5}");
    assert!(right >= 0.98, "{right}");
}

/// Nothing is reflected totally inside a ball; texels make it seem so near the silhouette.
#[test]
fn few_rays_seem_to_be_reflected_totally_in_a_ball() {
    let views = [(1.5, 3.0, 0.00998), (2.42, 4.0, 0.02373)];
    for (n, eye, recorded) in views {
        let view = View {
            n,
            eye,
            filter: Filter::Nearest,
        };
        let rays = view.refracted();
        let distances = view.searched(&rays, 4);
        let leaving = view.leaving(&rays, &distances[3]);
        let found = rays.entry.iter().zip(&rays.inside).zip(&leaving);
        // A mirrored ray keeps its angle to the normal; one that leaves is bent away from the ray inside by less.
        let seems = share(found.map(|((entry, inside), out)| {
            let exit = add(*entry, *inside, chord(*entry, *inside));
            dot(*out, exit) < 0.0
        }));
        if n == 1.5 {
            assert!(seems <= 0.025, "{seems}");
        }
        check_recorded(
            &format!("seem to be reflected totally, n {n}"),
            seems,
            recorded,
        );
    }
}
