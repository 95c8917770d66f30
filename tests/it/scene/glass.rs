//! Transparent bodies.

use glam::DVec3;

use super::around;
use super::at;
use super::device;
use super::pictured;
use super::pictured_in;
use super::plain;
use super::row;
use super::traced;
use fresnel_gen::physics::optics;
use fresnel_gen::pictures::scene::{self, Camera, OpticalMaterial, Paths};

const N: f64 = 1.5;

/// Red above, blue below; through a ball it is the other way round.
#[test]
fn a_ball_shows_the_world_upside_down() {
    let Some(device) = device() else { return };
    let environment = around(|direction| {
        if direction.y > 0.0 {
            DVec3::X
        } else {
            DVec3::Z
        }
    });
    let glass = OpticalMaterial::of_index(N);
    let picture = pictured(&device, "double_refraction", &glass, &environment, 64);
    for seen in [&picture.drawn, &picture.truth] {
        let (above, below) = (at(seen, 0.5, 0.25), at(seen, 0.5, 0.85));
        assert!(above.z > 0.7 && above.x < 0.2, "{above}");
        assert!(below.x > 0.7 && below.z < 0.2, "{below}");
    }
}

/// In a world that is white all around the truth is white, and two surfaces give R + (1 - R)^2: so that every pixel tells R.
#[test]
fn every_pixel_of_a_ball_obeys_fresnel() {
    let Some(device) = device() else { return };
    let white = around(|_| DVec3::ONE);
    let picture = pictured(
        &device,
        "double_refraction",
        &OpticalMaterial::of_index(N),
        &white,
        64,
    );
    for seen in &picture.truth {
        assert!(
            (*seen - DVec3::ONE).length() < 3e-4,
            "energy is lost: {seen}"
        );
    }
    let eye = DVec3::from_array(row("double_refraction").eye);
    let camera = Camera::around(eye, 1.0);
    let mut most: f64 = 0.0;
    for i in 0..64 * 64 {
        let place = |i: usize| (i as f64 + 0.5) / 64.0;
        let direction = camera.direction(place(i % 64), place(i / 64));
        let along = -eye.dot(direction);
        let height = (eye + along * direction).length();
        // A pixel is as wide as its change of R allows.
        if height > 0.95 {
            continue;
        }
        let r = optics::dielectric(N, (1.0 - height * height).sqrt()).unpolarised();
        let want = r + (1.0 - r) * (1.0 - r);
        most = most.max((picture.drawn[i].x - want).abs());
    }
    println!("farthest from R + (1 - R)^2: {most:.5}");
    assert!(most < 0.005, "{most}");
    assert_eq!(plain().shown(DVec3::splat(2.0)), DVec3::ONE);
}

/// At the rim F goes to 1: a pixel that lies a ten-thousandth of the radius within it shows what a mirror does.
#[test]
fn the_rim_of_a_ball_is_a_mirror() {
    let (white, black) = (around(|_| DVec3::ONE), around(|_| DVec3::ZERO));
    let side = 4096;
    let eye = DVec3::from_array(row("double_refraction").eye);
    let camera = Camera::around(eye, 1.0);
    let height = |x: f64| {
        let direction = camera.direction(x, 0.5);
        (eye - eye.dot(direction) * direction).length()
    };
    let line = (0..side).map(|i| (i as f64 + 0.5) / side as f64);
    let rim = line
        .filter(|x| height(*x) < 1.0)
        .map(height)
        .next()
        .expect("the ball");
    let r = optics::dielectric(N, (1.0 - rim * rim).sqrt()).unpolarised();
    assert!(r > 0.7, "{rim}: {r}");
    assert_eq!(row("double_refraction").body.radius(), 1.0);
    let seen =
        [white, black].map(|world| traced("double_refraction", N, &world, 64, Paths::Mirror));
    // What is mirrored alone: R in a white world, nothing in a black one.
    let middle = 32 * 64 + 32;
    assert!(
        (seen[0][middle].x - 0.04).abs() < 1e-3,
        "{}",
        seen[0][middle]
    );
    assert_eq!(seen[1][middle], DVec3::ZERO);
    let along: Vec<f64> = (32..64).map(|x| seen[0][32 * 64 + x].x).collect();
    let inside = along.iter().position(|r| *r == 1.0).unwrap_or(along.len());
    let rises = along[..inside]
        .windows(2)
        .all(|pair| pair[1] >= pair[0] - 1e-12);
    assert!(rises && along[inside - 1] > 0.3, "{along:?}");
}

/// Light is turned by 2 (theta_i - theta_t): the tracer, in a world whose colour is the direction.
#[test]
fn a_ball_turns_light_by_twice_the_difference_of_its_angles() {
    let world = around(|direction| direction / 2.0 + DVec3::splat(0.5));
    let side = 128;
    let seen = traced("double_refraction", N, &world, side, Paths::TwoSurfaces);
    let eye = DVec3::from_array(row("double_refraction").eye);
    let camera = Camera::around(eye, 1.0);
    let colour = |direction: DVec3| direction / 2.0 + DVec3::splat(0.5);
    for i in (0..side * side).step_by(37) {
        let place = |i: usize| (i as f64 + 0.5) / side as f64;
        let direction = camera.direction(place(i % side), place(i / side));
        let to_axis = eye - eye.dot(direction) * direction;
        let height = to_axis.length();
        if height > 0.98 {
            continue;
        }
        let (theta_i, theta_t) = (height.asin(), (height / N).asin());
        let turned = 2.0 * (theta_i - theta_t);
        let toward = -to_axis / height;
        let out = turned.cos() * direction + turned.sin() * toward;
        let outward = -theta_i.cos() * direction - theta_i.sin() * toward;
        let mirrored = direction - 2.0 * direction.dot(outward) * outward;
        let r = optics::dielectric(N, theta_i.cos()).unpolarised();
        let want = r * colour(mirrored) + (1.0 - r) * (1.0 - r) * colour(out);
        let error = (seen[i] - want).length();
        assert!(error < 2e-3, "{height}: {} {want}", seen[i]);
    }
}

/// A sky of 8 bits has no sun: through glass it is no brighter than white, where the glint of the sun is brighter than that.
#[test]
fn a_clamped_sky_has_no_sun() {
    let Some(device) = device() else {
        return;
    };
    let (glass, sky) = (OpticalMaterial::of_index(1.5), scene::sky());
    let drawn = |is_ldr| {
        let picture = pictured_in(&device, "double_refraction", &glass, (&sky, is_ldr), 64);
        let brightest = |picture: &[DVec3]| picture.iter().map(|p| p.y).fold(0.0, f64::max);
        (brightest(&picture.drawn), brightest(&picture.truth))
    };
    let ((bright, truth), (clamped, same)) = (drawn(false), drawn(true));
    assert_eq!(truth, same, "the truth keeps its range");
    assert!(clamped <= 1.001 && bright > 2.0, "{bright} {clamped}");
}
