//! Any text as an OBJ file: no panic, and what is read can be drawn.
#![no_main]

use fresnel_gen::lab::raster::{Turntable, draw, mesh_of_obj};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(mesh) = mesh_of_obj(text) else {
        return;
    };
    let mesh = mesh.with_extent(1.0);
    let corners = mesh.triangles.iter().flatten();
    assert!(
        corners
            .into_iter()
            .all(|corner| (*corner as usize) < mesh.vertices.len())
    );
    let mut turntable = Turntable::THESIS;
    turntable.lens.size = [16, 12];
    for camera in turntable.cameras().iter().step_by(60) {
        for (_, cos_theta) in draw(&mesh, camera).covered {
            assert!((0.0..=1.0).contains(&cos_theta), "{cos_theta}");
        }
    }
});
