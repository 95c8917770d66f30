//! Stained glass: what it lets through.

use glam::{DVec2, DVec3};

use super::around;
use super::device;
use super::pictured;
use super::row;
use fresnel_gen::physics::optics;
use fresnel_gen::pictures::scene::{Camera, OpticalMaterial, Picture, Slot};

const N: f64 = 1.525;
const SIZE: u32 = 128;
/// The brightest light of the room.
const ROOM: f64 = 0.055 * 2.0;

fn lit_by(light: f64) -> Option<Picture> {
    let device = device()?;
    let world = around(|_| DVec3::splat(light));
    Some(pictured(
        &device,
        "stained_glass",
        &OpticalMaterial::of_index(N),
        &world,
        SIZE,
    ))
}

/// A white sky adds to a black one what is transmitted: nothing through leads and stone, and nowhere more than comes.
#[test]
fn leads_are_dark_and_panes_transmit_their_tint() {
    let (Some(white), Some(black)) = (lit_by(1.0), lit_by(0.0)) else {
        return;
    };
    for (lit, dark) in [(&white.drawn, &black.drawn), (&white.truth, &black.truth)] {
        let through: Vec<DVec3> = lit.iter().zip(dark).map(|(a, b)| *a - *b).collect();
        let most = through.iter().map(|t| t.max_element()).fold(0.0, f64::max);
        let least = through.iter().map(|t| t.min_element()).fold(0.0, f64::min);
        let opaque = through.iter().filter(|t| t.max_element() == 0.0).count();
        let share = opaque as f64 / through.len() as f64;
        println!("transmitted {least:.4} to {most:.4}; {share:.3} of the picture is opaque");
        assert!(least > -1e-6 && most < 0.92, "{least} {most}");
        assert!((0.4..0.8).contains(&share), "{share}");
        let brightest = dark.iter().map(|pixel| pixel.max_element());
        let brightest = brightest.fold(0.0, f64::max);
        // The stone beside the panes has light of theirs painted on it.
        assert!(brightest < 5.0 * ROOM, "{brightest}");
    }
}

/// The hub of the rose is gold. Its mean is what two surfaces and the tint of its path leave, and what the truth has.
#[test]
fn the_golden_pane_transmits_what_its_tint_says() {
    let (Some(white), Some(black)) = (lit_by(1.0), lit_by(0.0)) else {
        return;
    };
    let tables = row("stained_glass").body.tables();
    let (_, paint) = tables
        .iter()
        .find(|(slot, _)| *slot == Slot::Paint)
        .expect("its paint");
    let eye = DVec3::from_array(row("stained_glass").eye);
    let camera = Camera::around(eye, 1.02);
    let mut means = [DVec3::ZERO; 3];
    let mut count = 0.0;
    for i in -3..=3 {
        let at = DVec3::new(0.0, 0.17 + 0.015 * f64::from(i), 0.0);
        let clip = camera.view_projection.project_point3(at);
        let pixel = |share: f64| (share * f64::from(SIZE)) as usize;
        let (x, y) = (pixel(0.5 + 0.5 * clip.x), pixel(0.5 - 0.5 * clip.y));
        let i = y * SIZE as usize + x;
        means[0] += white.drawn[i] - black.drawn[i];
        means[1] += white.truth[i] - black.truth[i];
        let outward = DVec3::new(-0.45, 0.0, 0.4).normalize();
        let cosine = (at - eye).normalize().dot(outward);
        let inside = (1.0 - (1.0 - cosine * cosine) / (N * N)).sqrt();
        let r = optics::dielectric(N, cosine).unpolarised();
        let tint = paint.at(DVec2::new(0.5, 0.5 - 0.5 * at.y / 1.9)).truncate();
        means[2] += (1.0 - r) * (1.0 - r) * tint.powf(1.0 / inside);
        count += 1.0;
    }
    let [drawn, truth, law] = means.map(|sum| sum / count);
    println!("drawn {drawn}, truth {truth}, by the law {law}");
    assert!(
        drawn.x > 1.1 * drawn.y && drawn.y > 3.0 * drawn.z,
        "{drawn}"
    );
    // Reflections inside the glass are missing: R squared of the light, times what the tint leaves of three paths.
    assert!(
        (drawn - truth).abs().max_element() < 0.01,
        "{drawn} {truth}"
    );
    assert!((drawn - law).abs().max_element() < 0.04, "{drawn} {law}");
}
