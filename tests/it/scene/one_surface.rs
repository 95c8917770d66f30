//! What one look-up shows, and metals.

use glam::DVec3;

use super::around;
use super::at;
use super::device;
use super::pictured;
use super::row;
use super::traced;
use fresnel_gen::physics::materials::{self, Surface, ViewingConditions};
use fresnel_gen::physics::optics;
use fresnel_gen::pictures::scene::{OpticalMaterial, Paths};

pub fn glass_of(material: &str) -> OpticalMaterial {
    let material = materials::find(material).unwrap().unwrap();
    OpticalMaterial::of_surface(
        &Surface::new(&material, None, &ViewingConditions::default()).unwrap(),
    )
}

/// One surface bends light toward the normal, and turns nothing upside down beyond the middle of the focus: what one look-up
/// draws is what the tracer sees that stops after one surface, and not what a ball shows.
#[test]
fn one_look_up_is_the_first_surface_and_not_a_ball() {
    let Some(device) = device() else { return };
    let world = around(|direction| direction / 2.0 + DVec3::splat(0.5));
    let glass = OpticalMaterial::of_index(1.5);
    let picture = pictured(&device, "reflection_refraction", &glass, &world, 64);
    let side = 128;
    let samples = traced(
        "reflection_refraction",
        1.5,
        &world,
        side,
        Paths::OneSurface,
    );
    for y in 8..56 {
        let x = 32;
        let [a, b] = [2 * y * side + 2 * x, (2 * y + 1) * side + 2 * x];
        let want = (samples[a] + samples[a + 1] + samples[b] + samples[b + 1]) / 4.0;
        let error = (picture.drawn[y * 64 + x] - want).length();
        assert!(error < 5e-3, "{y}: {} {want}", picture.drawn[y * 64 + x]);
    }
    let apart = (at(&picture.drawn, 0.5, 0.2) - at(&picture.truth, 0.5, 0.2)).length();
    assert!(apart > 0.1, "{apart}");
}

/// In a white world one look-up along each ray is white everywhere: the shares are R and 1 - R. A ball of air in glass too, which
/// reflects totally toward its rim.
#[test]
fn one_look_up_each_loses_no_light() {
    let Some(device) = device() else { return };
    let white = around(|_| DVec3::ONE);
    for n in [1.5, 2.42, 1.0 / 1.5] {
        let picture = pictured(
            &device,
            "reflection_refraction",
            &OpticalMaterial::of_index(n),
            &white,
            32,
        );
        for seen in &picture.drawn {
            assert!(
                (*seen - DVec3::ONE).abs().max_element() < 1e-3,
                "{n}: {seen}"
            );
        }
    }
}

/// In a white world a gem is white but for light that its picture stops following: of a picture that it fills by half less than a
/// hundredth. No pixel is brighter than the world, and what is drawn follows less than the truth.
#[test]
fn a_gem_makes_no_light() {
    let Some(device) = device() else { return };
    let (name, white) = ("double_refraction_gem", around(|_| DVec3::ONE));
    let picture = pictured(&device, name, &glass_of(row(name).material), &white, 64);
    let [drawn, truth] = [&picture.drawn, &picture.truth].map(|seen| {
        assert!(seen.iter().all(|one| one.max_element() < 1.001), "{name}");
        let count = seen.len() as f64;
        1.0 - seen.iter().map(|one| one.x).sum::<f64>() / count
    });
    assert!(
        0.0 < truth && truth < drawn && drawn < 0.01,
        "{drawn} {truth}"
    );
}

/// Blue is bent more than red, drawn and in truth: across an edge between dark and light they part.
#[test]
fn blue_is_bent_more_than_red() {
    let Some(device) = device() else { return };
    let glass = glass_of("sf11");
    assert!(
        glass.n.z > glass.n.y && glass.n.y > glass.n.x,
        "{}",
        glass.n
    );
    let light_below = around(|direction| DVec3::splat(f64::from(u8::from(direction.y < 0.0))));
    for name in ["dispersion", "double_refraction_dispersion"] {
        let picture = pictured(&device, name, &glass, &light_below, 128);
        for seen in [&picture.drawn, &picture.truth] {
            let column: Vec<DVec3> = (0..128).map(|y| seen[y * 128 + 64]).collect();
            let parts = column.iter().any(|pixel| (pixel.z - pixel.x).abs() > 0.05);
            assert!(parts, "{name}: {column:?}");
        }
        let white = around(|_| DVec3::ONE);
        let picture = pictured(&device, name, &glass, &white, 32);
        let colour = picture.drawn[16 * 32 + 16];
        // Through one surface white stays white; through two each colour loses what its own index reflects inside.
        let left = |n: f64| {
            let r = ((n - 1.0) / (n + 1.0)).powi(2);
            if name == "dispersion" {
                1.0
            } else {
                r + (1.0 - r).powi(2)
            }
        };
        let want = DVec3::from_array(glass.n.to_array().map(left));
        assert!(
            (colour - want).abs().max_element() < 2e-3,
            "{colour} {want}"
        );
    }
}

/// In a white world a ball of gold shows its reflectance: F0 in the middle, 1 at the rim.
#[test]
fn gold_is_gold_in_the_middle_and_white_at_its_rim() {
    let Some(device) = device() else { return };
    let white = around(|_| DVec3::ONE);
    let gold = glass_of("gold");
    let picture = pictured(&device, "complex_f0", &gold, &white, 64);
    let middle = at(&picture.drawn, 0.5, 0.5);
    for i in 0..3 {
        let f0 = optics::normal_incidence(gold.n[i], gold.k[i]);
        assert!((middle[i] - f0).abs() < 2e-3, "{middle} {f0}");
    }
    assert!(middle.x > 1.5 * middle.z, "{middle}");
    // Gold's red lies outside sRGB: its F0 is above 1 there, and no index reflects more than all.
    let truth = at(&picture.truth, 0.5, 0.5);
    let apart = (truth - middle).abs().max_element();
    assert!(apart < 0.045 && truth.x > 1.02, "{truth} {middle}");
    assert_eq!(row("complex_f0").true_paths, Paths::Mirror);
    let blues: Vec<f64> = (0..32).map(|x| picture.drawn[32 * 64 + x].z).collect();
    let first = blues
        .iter()
        .position(|blue| *blue < 0.999)
        .expect("the ball");
    let falls = blues[first + 1..]
        .windows(2)
        .all(|pair| pair[1] <= pair[0] + 1e-4);
    assert!(falls && blues[first + 1] > 0.45, "{blues:?}");
}
