//! Any text as a page and as a table: no panic, and what is read is written and read again as the same material.
#![no_main]

use fresnel_gen::physics::materials::{Extrapolate, Material, Page};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    for page in [
        Page::parse("main/Au/nk/Mine.yml", text),
        Page::parse_csv("mine.csv", text),
    ] {
        let Ok(material) = page.and_then(|page| page.material(None)) else {
            continue;
        };
        let (from, to) = material.range_nm();
        for nm in [from, (from + to) / 2.0, to, 550.0] {
            if let Ok(index) = material.index(nm, Extrapolate::Hold) {
                assert!(index.n > 0.0 && index.k >= 0.0, "{index:?}");
            }
        }
        for material in [material.trimmed(400.0, 700.0), material] {
            if let Ok(again) = Material::parse("mine.toml", &material.to_toml()) {
                assert_eq!(again, material);
            }
        }
    }
});
