//! Any text as a material's file: no panic, and what is read is written and read again as the same.
#![no_main]

use fresnel_gen::physics::materials::Material;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(material) = Material::parse("mine.toml", text) {
        assert_eq!(
            Material::parse("again.toml", &material.to_toml()),
            Ok(material)
        );
    }
});
