//! Films that have drained: their colours by thickness, and light that is neither made nor lost.

use glam::DVec3;

use super::{around, device, row};
use fresnel_gen::generator::fit::{known_film, thickness_error};
use fresnel_gen::generator::reference::reference_reflectance;
use fresnel_gen::language::methods::Light;
use fresnel_gen::physics::materials::Surface;
use fresnel_gen::physics::spectra::{Gamut, Space, xyz_to_lab};
use fresnel_gen::pictures::gallery::own_subject;
use fresnel_gen::pictures::scene::{self, Camera, Environment, Picture, sky};

const SIZE: u32 = 96;

/// The picture of a row's own film.
fn pictured(name: &str, environment: &Environment) -> Option<Picture> {
    let glass = super::glass_of(row(name));
    Some(super::pictured(&device()?, name, &glass, environment, SIZE))
}

fn white() -> Environment {
    around(|_| DVec3::ONE)
}

/// Where a pixel meets the ball: its height, and the cosine of the angle of incidence.
fn place(camera: &Camera, pixel: usize) -> Option<(f64, f64)> {
    let at = |i: usize| (i as f64 + 0.5) / f64::from(SIZE);
    let size = SIZE as usize;
    let direction = camera.direction(at(pixel % size), at(pixel / size));
    let crossing = scene::Body::Ball.crossing(camera.eye, direction)?;
    let normal = crossing.entry.1;
    Some((normal.y, -direction.dot(normal)))
}

fn camera(name: &str) -> Camera {
    Camera::around(DVec3::from_array(row(name).eye), 1.0)
}

/// The hue in CIELAB in degrees, and the chroma.
fn hue(rgb: DVec3) -> (f64, f64) {
    let to_xyz = Space::Srgb.rgb_to_xyz();
    let lab = xyz_to_lab(to_xyz * rgb, to_xyz * DVec3::ONE);
    (
        lab.b.atan2(lab.a).to_degrees().rem_euclid(360.0),
        lab.a.hypot(lab.b),
    )
}

/// Diamanti, Del Curto and Pedeferri 2008: as the oxide grows, titanium is grey, gold, purple, blue. In the picture it grows downwards.
#[test]
fn anodised_titanium_is_grey_then_gold_then_purple_then_blue() {
    let Some(picture) = pictured("thin_film", &white()) else {
        return;
    };
    let camera = camera("thin_film");
    // The pixels of the ball's middle whose film is about so thick.
    let seen = |pixels: &[DVec3], nm: f64| {
        let is_there = |pixel: &usize| {
            let found = place(&camera, *pixel);
            found.is_some_and(|(height, cosine)| {
                cosine > 0.6 && (75.0 * (1.0 - height) - nm).abs() < 1.5
            })
        };
        let there: Vec<DVec3> = (0..pixels.len())
            .filter(is_there)
            .map(|i| pixels[i])
            .collect();
        assert!(!there.is_empty(), "{nm} nm is seen");
        hue(there.iter().sum::<DVec3>() / there.len() as f64)
    };
    for pixels in [&picture.drawn, &picture.truth] {
        for (nm, from, to) in [
            (22.0, 60.0, 100.0),
            (40.0, 280.0, 340.0),
            (55.0, 235.0, 280.0),
        ] {
            let (hue, chroma) = seen(pixels, nm);
            assert!(
                (from..to).contains(&hue) && chroma > 10.0,
                "{nm} nm: {hue}, {chroma}"
            );
        }
    }
    let top = super::at(&picture.drawn, 0.5, 0.07);
    assert!(
        hue(top).1 < 15.0 && top.y > 0.4,
        "bare titanium is grey: {top}"
    );
}

/// In a world of ones every pixel of the truth is the law of layers at its angle and thickness.
#[test]
fn the_truth_of_a_film_is_the_law_of_layers() {
    let Some(picture) = pictured("thin_film", &white()) else {
        return;
    };
    let camera = camera("thin_film");
    let subject = own_subject(row("thin_film"));
    let surface = &subject.reference.surface;
    let (mut law_apart, mut drawn_apart): (f64, f64) = (0.0, 0.0);
    for pixel in (0..picture.truth.len()).step_by(7) {
        let Some((height, cosine)) = place(&camera, pixel).filter(|(_, cosine)| *cosine > 0.3)
        else {
            continue;
        };
        let films = surface.films.iter();
        let here = Surface {
            films: films
                .map(|films| vec![films[0].of_share(0.5 - 0.5 * height)])
                .collect(),
            gamut: Gamut::Keep,
            ..surface.clone()
        };
        let law = DVec3::from_array(reference_reflectance(&here, Light::Unpolarised, cosine));
        law_apart = law_apart.max((picture.truth[pixel] - law).abs().max_element());
        let drawn = picture.drawn[pixel] - law.clamp(DVec3::ZERO, DVec3::ONE);
        drawn_apart = drawn_apart.max(drawn.abs().max_element());
    }
    println!("truth and law {law_apart:.4}, drawn and law {drawn_apart:.4}");
    assert!(law_apart < 0.01, "{law_apart}");
    // What the head of the function says of it.
    let stated = thickness_error(&subject, subject.film(3, known_film));
    assert!(drawn_apart < stated + 0.005, "{drawn_apart} {stated}");
}

/// A bubble takes no light away and makes none, and before it bursts it is black: it mirrors nothing.
#[test]
fn a_bubble_loses_no_light_and_is_black_where_it_is_thinnest() {
    let Some(picture) = pictured("soap_film", &white()) else {
        return;
    };
    let camera = camera("soap_film");
    for (pixel, truth) in picture.truth.iter().enumerate() {
        // At the rim light is left inside after the last reflection that the tracer follows.
        if place(&camera, pixel).is_none_or(|(_, cosine)| cosine > 0.15) {
            assert!((*truth - DVec3::ONE).abs().max_element() < 1e-3, "{truth}");
        }
        let drawn = picture.drawn[pixel];
        assert!(drawn.max_element() < 1.0 + 1e-4, "{drawn}");
        if place(&camera, pixel).is_some_and(|(_, cosine)| cosine > 0.5) {
            assert!(drawn.min_element() > 0.95, "{drawn}");
        }
    }
    // Light that comes from behind the eye alone: only what is mirrored is seen.
    let behind = around(|direction| DVec3::splat(f64::from(u8::from(direction.z > 0.3))));
    let Some(mirrored) = pictured("soap_film", &behind) else {
        return;
    };
    for pixels in [&mirrored.drawn, &mirrored.truth] {
        let (mut thin, mut thick): (f64, f64) = (0.0, 0.0);
        for (pixel, seen) in pixels.iter().enumerate() {
            match place(&camera, pixel) {
                // Both walls that mirror towards the eye lie here: near and far.
                Some((height, cosine)) if cosine > 0.75 && height.abs() < 0.3 => {
                    thick = thick.max(seen.max_element());
                }
                Some((height, _)) if height > 0.985 => thin = thin.max(seen.min_element()),
                _ => {}
            }
        }
        assert!(thick > 0.06, "{thick}");
        assert!(thin < 0.02, "{thin}");
    }
}

/// Three wavelengths and six follow the spectrum closely enough that nobody sees more than the sky's own steps.
#[test]
fn films_look_as_the_spectrum_has_them() {
    for (name, most) in [("thin_film", 1.5), ("soap_film", 1.6)] {
        let Some(picture) = pictured(name, &sky()) else {
            return;
        };
        let error = picture.row.error;
        println!(
            "{name}: mean {:.2}, 99th percentile {:.2}",
            error.mean, error.p99
        );
        assert!(error.mean < most, "{name}: {}", error.mean);
    }
}
