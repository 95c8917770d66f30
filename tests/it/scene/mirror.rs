//! Metals: a room seen in a ball, and dents.

use glam::DVec3;

use super::at;
use super::device;
use super::one_surface::glass_of;
use super::pictured;
use fresnel_gen::physics::materials::{self, Surface, ViewingConditions};
use fresnel_gen::pictures::scene::{
    self, Around, Camera, OpticalMaterial, Paths, Picture, ROOM_MAX, ROOM_MIN, Relief, Things,
    room_radiance, sky,
};

/// The share of pixels whose channels all differ by less than 3 hundredths from the truth.
fn share_alike(picture: &Picture) -> f64 {
    let pairs = picture.drawn.iter().zip(&picture.truth);
    let alike = pairs.filter(|(a, b)| (**a - **b).abs().max_element() < 0.03);
    alike.count() as f64 / picture.drawn.len() as f64
}

/// One cube map, taken beside the ball, shows the room as it is from every place: all but texels.
#[test]
fn a_room_is_mirrored_as_it_is() {
    let Some(device) = device() else { return };
    let picture = pictured(
        &device,
        "parallax_corrected",
        &glass_of("silver"),
        &sky(),
        128,
    );
    let alike = share_alike(&picture);
    println!("pixels as in truth: {alike:.4}");
    assert!(alike > 0.93, "{alike}");
    // The ball's middle shows what is behind the eye: the wall at +z, which is yellow.
    let middle = at(&picture.drawn, 0.5, 0.55);
    assert!(middle.x > 2.0 * middle.z, "{middle}");
}

#[test]
fn rays_from_inside_a_room_meet_the_wall_ahead() {
    let place = DVec3::new(0.3, 0.2, -0.4);
    let window = room_radiance(place, DVec3::new(0.0, 1.0, 0.0));
    assert_eq!(window, DVec3::splat(4.0), "the window in the ceiling");
    let red = room_radiance(place, DVec3::new(-1.0, 0.001, 0.002));
    assert!(red.x > 4.0 * red.y, "{red}");
    assert!((ROOM_MAX - ROOM_MIN).min_element() > 4.0);
}

/// The normal map turns normals, and what a hammered ball shows is what its truth shows.
#[test]
fn dents_turn_the_mirror_and_not_the_world() {
    let relief = Relief::hammered(0.35);
    let mut most: f64 = 1.0;
    for i in 0..200 {
        let angle = f64::from(i) * 0.7;
        let normal = DVec3::new(angle.sin(), (0.31 * angle).cos() * 0.8, angle.cos()).normalize();
        let dented = relief.on_ball(normal);
        assert!((dented.length() - 1.0).abs() < 1e-12);
        most = most.min(dented.dot(normal));
    }
    assert!((0.9..0.99).contains(&most), "the steepest dent: {most}");
    let Some(device) = device() else { return };
    let sky = sky();
    let picture = pictured(&device, "normal_mapped", &glass_of("silver"), &sky, 128);
    let alike = share_alike(&picture);
    println!("pixels as in truth: {alike:.4}");
    assert!(alike > 0.9, "{alike}");
    // In a world without light a mirror is black, dents and all.
    let dark = super::around(|_| DVec3::ZERO);
    let black = pictured(
        &device,
        "normal_mapped",
        &OpticalMaterial::of_index(1.5),
        &dark,
        16,
    );
    assert!(black.drawn.iter().all(|pixel| *pixel == DVec3::ZERO));
}

/// In a world of ones a ball shows R: the truth of every pixel is the law at each wavelength, before any gamut.
#[test]
fn the_truth_of_a_metal_is_the_law_at_each_wavelength() {
    let white = super::around(|_| DVec3::ONE);
    for name in ["gold", "silver", "copper", "platinum"] {
        let material = materials::find(name).unwrap().unwrap();
        let surface = Surface::new(&material, None, &ViewingConditions::default()).unwrap();
        let (body, glass) = (
            super::row("complex_f0").body,
            OpticalMaterial::of_surface(&surface),
        );
        let things = Things {
            body,
            material: &glass,
            around: Around::Far(&white),
            relief: None,
        };
        let eye = DVec3::from_array(super::row("complex_f0").eye);
        let camera = Camera::around(eye, body.radius());
        let side = 64;
        let seen = scene::trace(things, &camera, side, [Paths::Mirror; 2], &mut |_, _| {});
        for (i, sample) in seen.iter().enumerate().filter(|(_, sample)| sample.is_body) {
            let place = |i: usize| (i as f64 + 0.5) / side as f64;
            let direction = camera.direction(place(i % side), place(i / side));
            let height = (eye - eye.dot(direction) * direction).length_squared();
            let law = surface.unpolarised((1.0 - height).max(0.0).sqrt());
            let apart = (sample.colour - law).abs().max_element();
            assert!(apart < 1e-5, "{name}: {} and not {law}", sample.colour);
        }
    }
}

/// What is stated of gold head-on: (1.0383, .7727, .3399), of which three channels know no red above 1.
#[test]
fn the_truth_of_gold_head_on_is_known() {
    let glass = glass_of("gold");
    let head_on = glass.samples.iter().map(|sample| {
        let (n, k) = (sample.index.n, sample.index.k);
        sample.weight * (((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k))
    });
    let head_on: DVec3 = head_on.sum();
    let known = DVec3::new(1.0383, 0.7727, 0.3399);
    assert!((head_on - known).abs().max_element() < 3e-4, "{head_on}");
}
