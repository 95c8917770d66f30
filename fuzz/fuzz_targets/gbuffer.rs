//! Any bytes as a G-buffer: no panic, no memory for what the file cannot hold, and what is read can be shaded.
#![no_main]

use std::sync::LazyLock;

use fresnel_gen::pictures::plan::{MaterialIds, read_gbuffer};
use libfuzzer_sys::fuzz_target;

const MAP: &str = "ignore = [2]\n[[material]]\nid = 1\nmaterial = \"gold\"\n";
static IDS: LazyLock<Option<MaterialIds>> =
    LazyLock::new(|| MaterialIds::parse("map.toml", MAP).ok());

fuzz_target!(|bytes: &[u8]| {
    let Some(ids) = &*IDS else { return };
    let Ok(frame) = read_gbuffer(bytes, ids) else {
        return;
    };
    let pixels = frame.size[0] * frame.size[1];
    for pixel in frame.of_material.iter().flatten() {
        assert!(pixel.place < pixels, "{pixel:?}");
        let shares = [pixel.cos_theta, pixel.roughness, pixel.coverage];
        assert!(
            shares.iter().all(|share| (0.0..=1.0).contains(share)),
            "{pixel:?}"
        );
        let light = pixel.light.iter().chain(&pixel.other);
        assert!(
            light.into_iter().all(|light| light.is_finite()),
            "{pixel:?}"
        );
    }
});
