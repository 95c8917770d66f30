//! Any text as a scene file: no panic, and what is read of small frames can be drawn.
#![no_main]

use fresnel_gen::lab::raster::{CUBE, SPHERE};
use fresnel_gen::pictures::plan::SceneFile;
use libfuzzer_sys::fuzz_target;

/// Pixels of a frame that is drawn here.
const FEW: u32 = 64 * 64;

fuzz_target!(|text: &str| {
    let Ok(scene) = SceneFile::parse("scene.toml", text) else {
        return;
    };
    // A mesh for whatever the scene names; nothing of it is a picture.
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n";
    let Ok(drawn) = scene.read(&mut |_| Ok(mesh.as_bytes().to_vec())) else {
        return;
    };
    let [width, height] = scene.cameras[0].lens.size;
    let round = [&CUBE, &SPHERE]
        .map(|body| body.mesh().triangles.len())
        .iter()
        .sum::<usize>();
    if width * height > FEW || drawn.triangles() > 4 * round {
        return;
    }
    let frame = scene.frame(scene.frames() - 1, &drawn);
    assert_eq!(frame.of_material.len(), scene.materials().len());
    for pixel in frame.of_material.iter().flatten() {
        assert!(pixel.place < width * height, "{pixel:?}");
        assert!((0.0..=1.0).contains(&pixel.cos_theta), "{pixel:?}");
        assert!(
            pixel
                .light
                .iter()
                .all(|light| *light >= 0.0 && light.is_finite())
        );
    }
});
