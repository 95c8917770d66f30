//! The files of effects in every language.

use fresnel_gen::emit::{EffectRequest, effect_file};
use fresnel_gen::{effects, methods, targets};

/// WGSL and SPIR-V are parsed and validated by naga; the other languages have validators of their own.
#[test]
fn every_effect_is_written_in_every_language_by_every_method() {
    for effect in effects::ALL {
        for method in methods::ALL {
            for target in targets::ALL.iter().filter(|target| target.name != "spirv") {
                let request = EffectRequest {
                    effect,
                    method,
                    prefix: "fresnel_",
                    command: "fresnel-gen",
                };
                let text = effect_file(target, &request)
                    .unwrap_or_else(|fault| panic!("{} {}: {fault}", effect.name, target.name));
                let text = String::from_utf8(text).expect("text");
                for function in effect.functions {
                    assert!(
                        text.contains(&format!("fresnel_{}(", function.name)),
                        "{text}"
                    );
                }
                if std::env::var_os("SHOW").is_some() && method.name == effects::USUAL_METHOD {
                    println!("{text}");
                }
            }
        }
    }
}
