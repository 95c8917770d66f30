//! Any bytes as glTF: no panic, no memory for what the file cannot hold, and what is read can be drawn.
#![no_main]

use fresnel_gen::pictures::plan::{GltfScene, GltfView, SceneLight};
use libfuzzer_sys::fuzz_target;

const VIEW: GltfView = GltfView {
    size: [16, 16],
    light: SceneLight::Uniform([1.0; 3]),
};

fuzz_target!(|bytes: &[u8]| {
    // Of a file beside it, the same bytes.
    let mut beside = |_: &str| Ok(bytes.to_vec());
    let Ok(scene) = GltfScene::read(bytes, &VIEW, &mut beside) else {
        return;
    };
    for index in 0..scene.frames().min(4) {
        for pixel in scene.frame(index).of_material.iter().flatten() {
            assert!(pixel.place < 256, "{pixel:?}");
            let shares = [pixel.cos_theta, pixel.roughness, pixel.coverage];
            assert!(
                shares.iter().all(|share| (0.0..=1.0).contains(share)),
                "{pixel:?}"
            );
        }
    }
});
