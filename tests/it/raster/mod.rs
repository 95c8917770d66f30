//! Pictures drawn on the CPU: what geometry knows of their angles, and what follows for errors.

mod errors;
pub mod obj;
mod surface_points;

use glam::DVec3;

use fresnel_gen::lab::raster::{
    Body, CUBE, Camera, CosineHistogram, Frame, Lens, Mesh, RELIEF, SPHERE, Turntable, Vertex,
    draw, shown,
};

const ORIGIN: DVec3 = DVec3::ZERO;

/// A camera that looks at the origin.
fn camera(eye: [f64; 3], size: [u32; 2], vertical_degrees: f64) -> Camera {
    let lens = Lens {
        size,
        vertical_degrees,
    };
    Camera::looking(DVec3::from_array(eye), ORIGIN, lens)
}

/// The thesis's turntable, coarser.
fn few_cameras(step: usize) -> Vec<Camera> {
    let lens = Lens {
        size: [320, 240],
        ..Turntable::THESIS.lens
    };
    let turntable = Turntable {
        lens,
        ..Turntable::THESIS
    };
    turntable.cameras().into_iter().step_by(step).collect()
}

fn histogram(frame: &Frame) -> CosineHistogram {
    CosineHistogram::of(frame.covered.iter().map(|(_, cos_theta)| *cos_theta))
}

#[test]
fn a_face_that_fills_the_picture_is_seen_head_on() {
    // The face is 2 m away and 1 m wide: half its diagonal is seen under atan(.3536) = 19.5 degrees.
    let frame = draw(&CUBE.mesh(), &camera([0.0, 0.0, -2.5], [200, 200], 28.0));
    assert_eq!(frame.covered.len(), 200 * 200);
    let least = frame.covered.iter().map(|(_, c)| *c).fold(1.0, f64::min);
    assert!((0.942..0.945).contains(&least), "{least}");
    let most = frame.covered.iter().map(|(_, c)| *c).fold(0.0, f64::max);
    assert!(most > 0.99999, "{most}");
}

/// Of a distant sphere the share of pixels with a cosine below c is c²: density 2c.
#[test]
fn a_distant_sphere_shows_every_cosine_as_often_as_itself() {
    let degrees = 2.0 * f64::atan(0.51 / 1000.0).to_degrees();
    let frame = draw(
        &SPHERE.mesh(),
        &camera([0.0, 0.0, -1000.0], [512, 512], degrees),
    );
    let seen = histogram(&frame);
    let closed = CosineHistogram::of_convex_bodies();
    let total = seen.total();
    let (mut below, mut closed_below, mut worst) = (0.0, 0.0, 0.0f64);
    for (weight, closed) in seen.weights().iter().zip(closed.weights()) {
        below += weight / total;
        closed_below += closed;
        worst = worst.max((below - closed_below).abs());
    }
    assert!((closed_below - 1.0).abs() < 1e-12);
    assert!(worst < 0.001, "{worst}");
    // The disc's area: π/4 of the square, as large as the field of view leaves it.
    let share = total / (512.0 * 512.0);
    let disc = std::f64::consts::FRAC_PI_4 / 1.02f64.powi(2);
    assert!((share - disc).abs() < 0.002, "{share} {disc}");
}

/// Where a ray enters a cube, by the slabs between its faces, and the cosine there: written a second time, without triangles.
fn slab_cosine(eye: DVec3, ray: DVec3) -> Option<f64> {
    let (mut enters, mut leaves, mut cosine) = (0.0, f64::INFINITY, 0.0);
    for (origin, slope) in eye.to_array().into_iter().zip(ray.to_array()) {
        let (a, b) = ((-0.5 - origin) / slope, (0.5 - origin) / slope);
        if a.min(b) > enters {
            (enters, cosine) = (a.min(b), slope.abs() / ray.length());
        }
        leaves = f64::min(leaves, a.max(b));
    }
    (enters < leaves).then_some(cosine)
}

#[test]
fn a_cube_is_where_its_slabs_are() {
    let mesh = CUBE.mesh();
    for camera in few_cameras(23) {
        let frame = draw(&mesh, &camera);
        let mut covered = frame.covered.iter().peekable();
        let [width, height] = camera.lens.size;
        let [right, down, forwards] = camera.axes;
        for place in 0..width * height {
            let slope = |place: u32, side: u32| {
                (f64::from(place) + 0.5 - f64::from(side) / 2.0) / camera.pixels_a_slope()
            };
            let (x, y) = (slope(place % width, width), slope(place / width, height));
            let wanted = slab_cosine(camera.eye, forwards + x * right + y * down);
            let drawn = covered.next_if(|(at, _)| *at == place).map(|(_, c)| *c);
            match (drawn, wanted) {
                (Some(drawn), Some(wanted)) => assert!((drawn - wanted).abs() < 1e-9),
                (drawn, wanted) => assert_eq!(drawn, wanted, "pixel {place}"),
            }
        }
    }
}

/// Water to the horizon: triangles that reach behind the camera cover exactly the lower half.
#[test]
fn a_plane_ends_at_the_horizon() {
    let corner = |x: f64, z: f64| Vertex {
        position: DVec3::new(x, -1.7, z),
        normal: DVec3::Y,
    };
    let far = 1e7;
    let mesh = Mesh {
        vertices: vec![
            corner(-far, -far),
            corner(far, -far),
            corner(far, far),
            corner(-far, far),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    let camera = Camera::looking(
        ORIGIN,
        DVec3::new(0.0, 0.0, -1.0),
        Lens {
            size: [64, 48],
            vertical_degrees: 45.0,
        },
    );
    let frame = draw(&mesh, &camera);
    assert_eq!(frame.covered.len(), 64 * 24);
    for (place, cos_theta) in frame.covered {
        let (column, row) = (place % 64, place / 64);
        let slope =
            |place: u32, side: f64| (f64::from(place) + 0.5 - side / 2.0) / camera.pixels_a_slope();
        let (x, y) = (slope(column, 64.0), slope(row, 48.0));
        let wanted = y / DVec3::new(x, y, 1.0).length();
        assert!((cos_theta - wanted).abs() < 1e-9, "{cos_theta} {wanted}");
    }
}

#[test]
fn weights_sum_to_the_covered_pixels() {
    for body in Body::ALL {
        let cameras = few_cameras(60);
        let mesh = body.mesh();
        let frames: Vec<Frame> = cameras.iter().map(|camera| draw(&mesh, camera)).collect();
        let pixels: usize = frames.iter().map(|frame| frame.covered.len()).sum();
        for frame in &frames {
            assert_eq!(histogram(frame).total(), frame.covered.len() as f64);
        }
        let all = shown(&mesh, &cameras, &mut |_, _| {});
        assert_eq!((all.frames, all.pixels), (frames.len(), pixels as u64));
        assert!((all.histogram.total() - 1.0).abs() < 1e-12);
    }
}

/// The same as one thread alone would make of it, bit by bit.
#[test]
fn frames_do_not_depend_on_threads() {
    let (mesh, cameras) = (RELIEF.mesh(), few_cameras(40));
    let together = shown(&mesh, &cameras, &mut |_, _| {});
    let mut alone = CosineHistogram::default();
    for camera in &cameras {
        let frame = histogram(&draw(&mesh, camera));
        alone.merge(&frame, 1.0 / (frame.total() * cameras.len() as f64));
    }
    assert!(together.histogram == alone);
}

#[test]
fn an_object_behind_the_camera_is_not_seen() {
    let mut camera = camera([0.0, 0.0, -2.0], [64, 48], 60.0);
    let [right, down, forwards] = camera.axes;
    camera.axes = [-right, down, -forwards];
    let nothing = shown(&CUBE.mesh(), &[camera], &mut |_, _| {});
    assert_eq!((nothing.frames, nothing.pixels), (0, 0));
    assert_eq!(nothing.histogram.total(), 0.0);
}
