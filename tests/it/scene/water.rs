//! Water: nothing leaks through its surface, and it reflects and refracts as physics says.

use glam::DVec3;

use super::around;
use super::at;
use super::device;
use super::pictured;
use super::pictured_row;
use super::row;
use fresnel_gen::lab::gpu::Device;
use fresnel_gen::physics::optics;
use fresnel_gen::pictures::scene::{
    Camera, Environment, OpticalMaterial, PassRow, RenderRow, View,
};

const N: f64 = 1.333;
const SIZE: u32 = 128;
/// A post of the pool: where it stands, its top, the floor, its radius.
const POST: DVec3 = DVec3::new(-1.15, 0.0, 0.35);
const POST_TOP: f64 = 0.95;
const FLOOR: f64 = -1.4;
const POST_RADIUS: f64 = 0.1;

/// The row of water with another text and other views.
fn changed(text: String, view: impl Fn(View) -> View) -> &'static RenderRow {
    let water = row("water");
    let passes = water.passes.iter().map(|pass| PassRow {
        view: view(pass.view),
        ..*pass
    });
    Box::leak(Box::new(RenderRow {
        text: Box::leak(text.into_boxed_str()),
        passes: Box::leak(passes.collect()),
        ..*water
    }))
}

fn leaks(device: &Device, row: &'static RenderRow) -> u64 {
    let (glass, grey) = (OpticalMaterial::of_index(N), around(|_| DVec3::splat(0.5)));
    let picture = pictured_row(device, row, &glass, (&grey, false), SIZE);
    picture.row.leaks.expect("there is water")
}

/// Posts and a ball stand in the water, the floor and the walls lie below it. As it is drawn, nothing leaks. Without the mask, with bent
/// look-ups wherever they lead, posts and ball leak into what lies below. Without the clipping plane, what stands below the surface leaks
/// into the mirror.
#[test]
fn nothing_leaks_through_the_surface() {
    let Some(device) = device() else { return };
    let water = row("water");
    let mut bare = water.text.to_owned();
    for map in ["below", "below_positions"] {
        let masked = format!("fresnel_water_refraction(uv, bend, {map}, clamped)");
        assert!(bare.contains(&masked), "{masked}");
        let raw = format!("textureSampleLevel({map}, clamped, uv + bend, 0.0).rgb");
        bare = bare.replace(&masked, &raw);
    }
    let unclipped = |view| match view {
        View::Mirrored => View::MirroredUnclipped,
        other => other,
    };
    let real = leaks(&device, water);
    let without_mask = leaks(&device, changed(bare, |view| view));
    let without_plane = leaks(&device, changed(water.text.to_owned(), unclipped));
    println!("leaks: {real}; without the mask {without_mask}; without the plane {without_plane}");
    assert_eq!(real, 0);
    assert!(without_mask > 50, "{without_mask}");
    assert!(without_plane > 50, "{without_plane}");
}

/// What a white world adds to a black one is what is mirrored: R, row by row, from looking down to looking along the water.
#[test]
fn water_reflects_the_more_the_lower_one_looks() {
    let Some(device) = device() else { return };
    let glass = OpticalMaterial::of_index(N);
    let [white, black] = [1.0, 0.0].map(|light| {
        let world = around(|_| DVec3::splat(light));
        pictured(&device, "water", &glass, &world, SIZE)
    });
    let camera = camera();
    for (lit, dark) in [(&white.drawn, &black.drawn), (&white.truth, &black.truth)] {
        let mut before = 0.0;
        for y in [0.97, 0.85, 0.7, 0.6] {
            let (mut seen, mut want) = (0.0, 0.0);
            for i in 0..40 {
                // Right of the posts and left of the ball.
                let x = 0.32 + 0.005 * f64::from(i);
                seen += (at(lit, x, y) - at(dark, x, y)).y / 40.0;
                let cosine = -camera.direction(x, y).y;
                want += optics::dielectric(N, cosine).unpolarised() / 40.0;
            }
            println!("at {y}: R {seen:.4}, of still water {want:.4}");
            assert!(seen > before, "{y}: {seen} {before}");
            // Waves tilt the surface, by a few degrees.
            assert!((seen - want).abs() < 0.25 * want, "{y}: {seen} {want}");
            before = seen;
        }
    }
}

/// Black water under a black sky shows nothing but what is mirrored: a post hangs from its water line, as long as it stands, and red.
#[test]
fn the_image_of_a_post_hangs_from_its_water_line() {
    let Some(device) = device() else { return };
    let black_water = OpticalMaterial {
        k: DVec3::splat(1e-3),
        ..OpticalMaterial::of_index(N)
    };
    let dark = around(|_| DVec3::ZERO);
    let picture = pictured(&device, "water", &black_water, &dark, SIZE);
    let camera = camera();
    let front = POST + DVec3::new(0.0, 0.0, POST_RADIUS);
    let mean = |seen: &[DVec3], from: f64, to: f64| {
        let mut sum = DVec3::ZERO;
        for i in 0..20 {
            let height = from + (to - from) * (f64::from(i) + 0.5) / 20.0;
            let (x, y) = place(&camera, front + DVec3::new(0.0, height, 0.0));
            sum += at(seen, x, y) / 20.0;
        }
        sum
    };
    for seen in [&picture.drawn, &picture.truth] {
        let image = mean(seen, -0.1, -0.8 * POST_TOP);
        let foot = mean(seen, -0.02, -0.1);
        let beyond = mean(seen, -1.25 * POST_TOP, -1.5 * POST_TOP);
        println!("image {image}, at the foot {foot}, beyond {beyond}");
        // Stripes are red and white: both are bright in red.
        assert!(image.x > 0.01 && foot.x > 0.01);
        assert!(image.x > 4.0 * beyond.x, "{image} {beyond}");
        assert!(
            image.x > 1.2 * image.z,
            "its stripes are red and white: {image}"
        );
    }
}

/// The foot of a post is seen where Snell's law lifts it to: above where it is seen without water.
#[test]
fn the_foot_of_a_post_is_lifted() {
    let Some(device) = device() else { return };
    let grey = around(|_| DVec3::splat(0.4));
    let camera = camera();
    let foot = POST + DVec3::new(0.0, FLOOR, POST_RADIUS);
    let mut before = 1.0;
    for n in [1.0, N] {
        let picture = pictured(&device, "water", &OpticalMaterial::of_index(n), &grey, SIZE);
        let (x, want) = place(&camera, lifted(camera.eye, foot, n));
        for seen in [&picture.drawn, &picture.truth] {
            let lowest = lowest_red(seen, x, 0.45);
            println!("n {n}: the foot is at {lowest:.3}, by Snell's law at {want:.3}");
            assert!((lowest - want).abs() < 0.035, "{lowest} {want}");
        }
        assert!(want < before - 0.05 || n == 1.0);
        before = want;
    }
}

fn camera() -> Camera {
    Camera::around(
        DVec3::from_array(row("water").eye),
        row("water").body.radius(),
    )
}

/// Where a place is in the picture.
fn place(camera: &Camera, of: DVec3) -> (f64, f64) {
    let clip = camera.view_projection.project_point3(of);
    (0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y)
}

/// The place of still water through which an eye sees a place below.
fn lifted(eye: DVec3, below: DVec3, n: f64) -> DVec3 {
    let (mut near, mut far) = (eye, below);
    near.y = 0.0;
    far.y = 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        let sine = |other: DVec3| {
            let along = middle - other;
            DVec3::new(along.x, 0.0, along.z).length() / along.length()
        };
        if sine(eye) < n * sine(below) {
            near = middle;
        } else {
            far = middle;
        }
    }
    near
}

/// The lowest place of a column, below this one, where red is brighter than blue.
fn lowest_red(seen: &[DVec3], x: f64, top: f64) -> f64 {
    let step = 1.0 / f64::from(SIZE);
    let mut lowest = top;
    let mut y = top;
    while y < 1.0 - step {
        let pixel = [-step, 0.0, step].map(|shift| at(seen, x + shift, y));
        if pixel.iter().any(|pixel| pixel.x > 1.2 * pixel.z) {
            lowest = y;
        }
        y += step;
    }
    lowest
}

/// The same sky and the same water, twice: not a byte differs.
#[test]
fn a_picture_of_water_is_the_same_again() {
    let Some(device) = device() else { return };
    let world: Environment = around(|direction| direction.abs());
    let [one, other] =
        [0, 1].map(|_| pictured(&device, "water", &OpticalMaterial::of_index(N), &world, 32).drawn);
    assert_eq!(one, other);
}
