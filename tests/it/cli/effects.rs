//! Effects as users ask for them: listed, shown, written alone, by another method, for a material.

use super::OUT;
use super::Place;

/// The functions of the effects that the manifest lists, by file.
fn listed(place: &Place) -> Vec<(String, Vec<String>)> {
    let manifest: serde_json::Value =
        serde_json::from_str(&place.read(&format!("{OUT}/manifest.json"))).expect("JSON");
    let files = manifest["files"].as_array().expect("files").iter();
    let of_effects = files.filter(|file| file["effect"].is_string());
    of_effects
        .map(|file| {
            let functions = file["functions"].as_array().expect("functions").iter();
            let names = functions.map(|one| one["name"].as_str().unwrap().to_owned());
            (file["file"].as_str().unwrap().to_owned(), names.collect())
        })
        .collect()
}

#[test]
fn they_are_listed_and_shown() {
    let place = Place::new();
    let all = place.done("effects").out;
    for effect in fresnel_gen::language::effects::ALL {
        assert!(all.contains(effect.summary), "{all}");
        let shown = place.done(&format!("effects show {}", effect.name)).out;
        for line in effect.formula.iter().chain(effect.fails) {
            assert!(shown.contains(line), "{shown}");
        }
        for function in effect.functions {
            assert!(shown.contains(function.gives), "{shown}");
        }
    }
    let fault = place.run("effects show interier").ends(2).err;
    assert!(fault.contains("interior"), "{fault}");
    let fault = place.run("--effect watr").ends(2).err;
    assert!(fault.contains("water"), "{fault}");
}

#[test]
fn one_is_written_alone_and_stays_beside_others() {
    let place = Place::new();
    place.done("--effect interior --target wgsl,spirv");
    let names = [
        "fresnel_interior_search_step",
        "fresnel_exit_direction",
        "fresnel_exit_transmittance",
        "fresnel_exit_transmittance_scalar",
    ]
    .map(str::to_owned)
    .to_vec();
    let files = [
        "spirv/effects/interior.comp.spv",
        "wgsl/effects/interior.wgsl",
    ];
    assert_eq!(
        listed(&place),
        files.map(|file| (file.to_owned(), names.clone()))
    );
    place.done("--effect interface --target wgsl --method schlick");
    place.done("--effect interface,dispersion,complex_f0 --target wgsl --material diamond");
    let both = listed(&place);
    let of = |file: &str| -> Vec<String> {
        let found = both.iter().find(|(name, _)| name == file);
        found
            .unwrap_or_else(|| panic!("{file}: {both:?}"))
            .1
            .clone()
    };
    assert_eq!(
        of("wgsl/effects/interface_schlick.wgsl"),
        [
            "fresnel_interface_reflectance_schlick",
            "fresnel_interface_reflectance_schlick_scalar"
        ],
        "directions are the same by every method"
    );
    assert_eq!(
        of("wgsl/effects/interface_diamond.wgsl"),
        ["fresnel_interface_reflectance_diamond"]
    );
    let text = place.read(&format!("{OUT}/wgsl/effects/dispersion_diamond.wgsl"));
    assert!(text.contains("fn fresnel_refracted_red_diamond("), "{text}");
    assert!(!text.contains("etas: vec3"), "its three indices are in it");
    place.done("generate");
    let said = place
        .done("--effect interface,water --target wgsl --material diamond")
        .err;
    assert!(said.contains("changes nothing of water"), "{said}");
    let all = listed(&place);
    for (file, _) in &both {
        assert!(all.iter().any(|(other, _)| other == file), "{file} stays");
    }
    place.done("--check");
    place
        .run("--check --effect interface --target wgsl --method schlick")
        .ends(0);
    place.done("--material none");
    assert_eq!(listed(&place), all);
}

#[test]
fn the_whole_tree_holds_all_and_what_is_no_effect_stays() {
    let place = Place::new();
    place.done("--target gles");
    assert_eq!(
        listed(&place).len(),
        fresnel_gen::language::effects::ALL.len()
    );
    let manifest = format!("{OUT}/manifest.json");
    let (old, new) = ("gles/effects/water.glsl", "gles/effects/waves.glsl");
    let bytes = place.read(&format!("{OUT}/{old}"));
    place.put(&format!("{OUT}/{new}"), &bytes);
    let edited = place.read(&manifest).replace(old, new);
    place.put(
        &manifest,
        edited.replace("\"effect\": \"water\"", "\"effect\": \"waves\""),
    );
    let ran = place.done("generate");
    // No effect has or had this name.
    assert!(ran.err.contains(&format!("left alone: {new}")), "{ran:?}");
    assert_eq!(place.read(&format!("{OUT}/{new}")), bytes);
    assert!(place.path(&format!("{OUT}/{old}")).exists());
}

#[test]
fn one_can_be_pasted() {
    let place = Place::new();
    for target in ["wgsl", "gles", "hlsl", "glsl", "msl"] {
        let text = place
            .done(&format!("--effect all --target {target} -o -"))
            .out;
        for effect in fresnel_gen::language::effects::ALL {
            for function in effect.functions {
                assert!(
                    text.contains(&format!(" fresnel_{}(", function.name)),
                    "{text}"
                );
            }
        }
    }
    let diamond = "--effect interior,interface,water --material diamond -o diamond.glsl";
    place.done(diamond);
    let text = place.read("diamond.glsl");
    for name in [
        "interior_search_step",
        "exit_transmittance_diamond",
        "reflected",
        "planar_uv",
    ] {
        assert!(
            text.contains(&format!(" fresnel_{name}(")),
            "{name}: {text}"
        );
    }
    assert!(!text.contains(" fresnel_exit_transmittance("), "{text}");
    place.done("--effect parallax -o parallax.hlsl");
    assert!(place.read("parallax.hlsl").contains("TextureCube<float4>"));
    place.done("--effect parallax -o parallax.spv");
}

#[test]
fn what_cannot_be_is_refused() {
    let place = Place::new();
    for (line, why) in [
        (
            "--effect water --method schlick",
            "changes nothing of water",
        ),
        ("--effect water --material gold", "changes nothing of water"),
        (
            "--effect interface --method schlick,fitted",
            "name one --method",
        ),
        ("--effect interface --precision f16", "single precision"),
        (
            "--effect interface --method dielectric_exact --material gold",
            "absorbs",
        ),
        (
            "--effect interface --method table",
            "reads a texture of its own",
        ),
        ("--effect all -o all.spv", "name one --effect"),
        ("--effect interface --budget 0.1", "--budget"),
    ] {
        let fault = place.run(line).ends(2).err;
        assert!(fault.contains(why), "{line}: {fault}");
    }
    assert!(!place.path(OUT).join("manifest.json").exists());
}
