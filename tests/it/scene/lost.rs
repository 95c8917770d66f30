//! Where the light in pictures of transparent bodies comes from, and how much of it is lost, as `docs/renders.md` says.

use fresnel_gen::gpu::Device;
use fresnel_gen::scene::{Camera, SAMPLES};
use glam::DVec3;

use super::one_surface::glass_of;
use super::{around, device, pictured, row};
use crate::stated::{check_stated, stated};

const PAGE: &str = "docs/renders.md";

/// White in red; in green white from below and black from above.
fn lit(direction: DVec3) -> DVec3 {
    DVec3::new(1.0, f64::from(u8::from(direction.y < 0.0)), 0.0)
}

/// What samples beside a body show together, and how many show the body.
fn beside(name: &str, size: u32) -> (DVec3, f64) {
    let body = row(name).body.body();
    let camera = Camera::around(DVec3::from_array(row(name).eye), body.radius());
    let side = size * SAMPLES;
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
    let (mut sum, mut count) = (DVec3::ZERO, 0.0);
    for i in 0..side * side {
        let direction = camera.direction(place(i % side), place(i / side));
        match body.crossing(camera.eye, direction) {
            Some(_) => count += 1.0,
            None => sum += lit(direction),
        }
    }
    (sum, count)
}

/// The mean light that comes from a body, and that from below: as drawn, and in truth.
fn means(device: &Device, name: &str, size: u32) -> [[f64; 2]; 2] {
    let glass = glass_of(row(name).material);
    let picture = pictured(device, name, &glass, &around(lit), size);
    let (beside, count) = beside(name, size);
    [picture.drawn, picture.truth].map(|seen| {
        let all: DVec3 = seen.iter().sum();
        let samples = f64::from(SAMPLES * SAMPLES);
        let mean = (samples * all - beside) / count;
        [mean.x, mean.y]
    })
}

#[test]
fn probe_gem() {
    let Some(device) = device() else { return };
    for name in ["double_refraction_gem", "double_refraction_normal_mapped"] {
        for size in [64, 96, 128, 256] {
            let t = std::time::Instant::now();
            println!(
                "{name} {size} {:?} {:?}",
                means(&device, name, size),
                t.elapsed()
            );
        }
    }
    let _ = (
        PAGE,
        check_stated,
        stated as fn(&'static str, &'static str, &'static str, String) -> _,
    );
}
