//! The files of effects in every language.

use fresnel_gen::generator::emit::{self, EffectRequest, Naming};
use fresnel_gen::language::effects;
use fresnel_gen::language::methods::{self, Method};
use fresnel_gen::language::targets;

/// WGSL and SPIR-V are parsed and validated by naga; the other languages have validators of their own.
#[test]
fn every_effect_is_written_in_every_language_by_every_method() {
    let naming = Naming::default();
    for effect in effects::ALL {
        // Effects know bare media, and a method that keeps a thickness is refused.
        let taken = |method: &&&Method| !method.is_textured() && !method.keeps_inputs();
        for method in methods::ALL.iter().filter(taken) {
            let request = EffectRequest {
                effect,
                method,
                subject: None,
            };
            let functions = request.functions(&naming).expect("well formed");
            let asks = effect
                .functions
                .iter()
                .any(|one| one.reflectance != effects::Reflectance::Unused);
            let is_usual = method.name == effects::USUAL_METHOD;
            assert_eq!(functions.is_empty(), !asks && !is_usual, "{}", effect.name);
            if functions.is_empty() {
                continue;
            }
            for target in targets::ALL {
                let file = emit::effect_file(target, &request, &functions, &naming, "fresnel-gen")
                    .unwrap_or_else(|fault| panic!("{} {}: {fault}", effect.name, target.name));
                let suffix = request.unusual_method().map(|method| format!("_{method}"));
                let suffix = suffix.unwrap_or_default();
                let stem = format!("{}/effects/{}{suffix}", target.name, effect.name);
                assert!(file.path.starts_with(&stem), "{}", file.path);
                let text = String::from_utf8_lossy(&file.bytes);
                for emitted in functions.iter().filter(|_| target.name != "spirv") {
                    assert!(text.contains(&format!("{}(", emitted.name)), "{text}");
                }
            }
        }
    }
}
