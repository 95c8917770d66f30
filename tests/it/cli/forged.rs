//! A manifest that somebody else wrote: no entry of it lets a run replace or remove a file that fresnel-gen did not write.

use std::fs;

use serde_json::{Value, json};

use super::OUT;
use super::Place;
use fresnel_gen::generator::output::contents::has_no_room_for_mark;
use fresnel_gen::generator::output::manifest::Entry;
use fresnel_gen::generator::output::ownership::{bears_mark, could_be_written, is_as_written};
use fresnel_gen::physics::digest::sha256;

const MINE: &str = "mine, by hand\n";

/// A manifest with these entries, each with the hash of [`MINE`].
fn manifest(entries: &[Value]) -> String {
    let mut files = entries.to_vec();
    for entry in &mut files {
        entry["sha256"] = sha256(MINE.as_bytes()).into();
    }
    json!({"tool": "fresnel-gen", "version": "0.1.0", "naga": "", "inputs": [], "files": files})
        .to_string()
}

/// Entries that name a file of the user's, some as this program would have written them.
#[test]
fn a_forged_entry_replaces_nothing() {
    for (line, entry) in [
        (
            "--target wgsl --material silver --method schlick",
            json!({"file": "wgsl/materials/silver.wgsl", "target": "bevy"}),
        ),
        (
            "--target wgsl --material silver --method schlick",
            json!({"file": "wgsl/materials/silver.wgsl", "target": "wgsl", "material": "silver"}),
        ),
        (
            "--target gles --method schlick --material none",
            json!({"file": "gles/fresnel_schlick.glsl", "target": "gles", "method": "schlick"}),
        ),
        (
            "--flavour three",
            json!({"file": "three/README.md", "target": "three"}),
        ),
        (
            "--flavour unity --material gold",
            json!({"file": "unity/gold.hlsl", "target": "unity", "material": "gold"}),
        ),
        (
            "bake --material gold --format c",
            json!({"file": "lut/gold.h", "target": "lut", "material": "gold"}),
        ),
        (
            "bake --material gold --format png8",
            json!({"file": "lut/gold.8bit.png", "target": "lut", "material": "gold"}),
        ),
        (
            "generate",
            json!({"file": "catalogue.json", "target": "json"}),
        ),
        (
            "generate",
            json!({"file": "catalogue.f16.ktx2", "target": "ktx2"}),
        ),
        // Without room for a mark: for another target, and of another form.
        (
            "generate",
            json!({"file": "catalogue.std430.bin", "target": "json"}),
        ),
        (
            "generate",
            json!({"file": "catalogue.std430.bin", "target": "std430", "rows": 524}),
        ),
        (
            "--target spirv --material gold --method schlick",
            json!({"file": "spirv/materials/gold.spv", "target": "spirv", "material": "gold"}),
        ),
        (
            "--target spirv --material gold --method schlick",
            json!({"file": "spirv/materials/gold.spv", "target": "wgsl", "material": "gold"}),
        ),
    ] {
        let place = Place::new();
        let file = entry["file"].as_str().unwrap();
        let ours = place_of(line, file);
        for was in [Value::Null, sha256(MINE.as_bytes()).into()] {
            let mut entry = entry.clone();
            entry["was"] = was;
            place.put(&format!("{OUT}/{ours}"), MINE);
            entry["file"] = ours.clone().into();
            place.put(&format!("{OUT}/manifest.json"), manifest(&[entry]));
            place.refused(line, &[&ours, "did not write", "nothing was written"]);
        }
        place.done(&format!("{line} --overwrite"));
        assert_ne!(
            place.read_bytes(&format!("{OUT}/{ours}")),
            MINE.as_bytes(),
            "{line}"
        );
    }
}

/// The file as the command names it: modules have the names of their stages.
fn place_of(line: &str, file: &str) -> String {
    if !file.ends_with(".spv") {
        return file.to_owned();
    }
    let place = Place::new();
    place.done(line);
    let mut listed = place.listed().into_iter();
    listed.find(|file| file.contains("materials/gold")).unwrap()
}

/// A copy of a generated file that the user renamed and changed: it bears the mark, and a manifest lists it as it is.
#[test]
fn a_forged_entry_removes_no_copy() {
    const LINE: &str = "--target wgsl --material none";
    for (name, key, method) in [
        ("wgsl/fresnel_mine.wgsl", "method", "mine"),
        ("wgsl/my_schlick.wgsl", "method", "schlick"),
        ("wgsl/effects/mine.wgsl", "effect", "mine"),
        ("spirv/fresnel_mine.spv", "method", "mine"),
    ] {
        let place = Place::new();
        place.done(&format!("{LINE} --target spirv"));
        let own = if name.starts_with("spirv") {
            place
                .listed()
                .into_iter()
                .find(|file| file.starts_with("spirv/fresnel_schlick"))
                .unwrap()
        } else {
            "wgsl/fresnel_schlick.wgsl".to_owned()
        };
        let copy = place.read_bytes(&format!("{OUT}/{own}"));
        place.put(&format!("{OUT}/{name}"), &copy);
        let mut manifest = place.manifest();
        let target = name.split('/').next().unwrap();
        let mut entry = json!({"file": name, "target": target, "sha256": sha256(&copy)});
        entry[key] = method.into();
        manifest["files"].as_array_mut().unwrap().push(entry);
        place.put(&format!("{OUT}/manifest.json"), manifest.to_string());
        for line in [&format!("{LINE} --target spirv"), "generate"] {
            let ran = place.done(line);
            assert!(!ran.err.contains("removed: "), "{ran:?}");
            // Effects are another run's, unless it is a whole one. What is named has left the manifest, where the method is known.
            let is_named = ran.err.contains(&format!("left alone: {name}"));
            let is_whole = line == "generate";
            let wanted = is_whole || key != "effect";
            assert_eq!(is_named, wanted, "{name}: {ran:?}");
            assert_eq!(place.read_bytes(&format!("{OUT}/{name}")), copy, "{name}");
        }
    }
}

/// A file of the user's that a manifest lists as one that is no longer generated.
#[test]
fn a_forged_entry_removes_nothing() {
    let place = Place::new();
    place.put(&format!("{OUT}/wgsl/fresnel_mine.wgsl"), MINE);
    place.put(&format!("{OUT}/wgsl/effects/mine.wgsl"), MINE);
    let entries = [
        json!({"file": "wgsl/fresnel_mine.wgsl", "target": "wgsl", "method": "mine"}),
        json!({"file": "wgsl/effects/mine.wgsl", "target": "wgsl", "effect": "mine"}),
    ];
    for line in ["--target wgsl --material none", "generate"] {
        place.put(&format!("{OUT}/manifest.json"), manifest(&entries));
        let ran = place.done(line);
        assert!(!ran.err.contains("removed: "), "{ran:?}");
        assert_eq!(place.read(&format!("{OUT}/wgsl/fresnel_mine.wgsl")), MINE);
        assert_eq!(place.read(&format!("{OUT}/wgsl/effects/mine.wgsl")), MINE);
    }
    // In a report's folder a manifest says nothing at all.
    let place = Place::new();
    for file in ["chart.svg", "chart.html", "index.html", "plan.html"] {
        place.put(file, MINE);
    }
    let entries = ["chart.svg", "index.html"].map(|file| json!({"file": file, "target": "wgsl"}));
    place.put("manifest.json", manifest(&entries));
    for line in [
        "chart --material gold,platinum --out-dir .",
        "stability --method schlick --out-dir .",
        "gallery --material gold --out-dir .",
    ] {
        place.refused(line, &["nothing was written"]);
    }
}

/// Commands whose files are of every format that a tree has.
const LINES: [&str; 6] = [
    "generate",
    "--target all,msl,glsl --material gold,water --method schlick,conductor_exact,table",
    "--target all,msl,glsl --material gold --method schlick --precision f16",
    "--target all,msl,glsl --effect all",
    "--flavour babylon,bevy,godot,materialx,playcanvas,three,unity,unreal",
    "bake --material gold,water --atlas --format exr-half,exr-float,png8,png16,ktx2,c,rust,js --target all,msl,glsl",
];

/// Each file bears the mark, unless its format has no room for one; each could have been written for its entry. Files of the user's in
/// their places stay, though the manifest lists them all.
#[test]
fn every_format_proves_who_wrote_it() {
    for line in LINES {
        let place = Place::new();
        place.done(line);
        let path = format!("{OUT}/manifest.json");
        let mut manifest = place.manifest();
        let entries = manifest["files"].as_array_mut().unwrap();
        assert!(entries.len() > 5, "{line}");
        for entry in entries.iter_mut() {
            let typed: Entry = serde_json::from_value(entry.clone()).unwrap();
            let file = format!("{OUT}/{}", typed.file);
            let bytes = place.read_bytes(&file);
            assert_ne!(
                bears_mark(&bytes),
                has_no_room_for_mark(&typed.file),
                "{line}: {file}"
            );
            assert!(is_as_written(&typed, &bytes), "{line}: {file}");
            assert!(could_be_written(&typed), "{line}: {file}");
            place.put(&file, MINE);
            entry["sha256"] = sha256(MINE.as_bytes()).into();
        }
        let others = entries.len() - 1;
        assert!(bears_mark(&place.read_bytes(&path)));
        place.put(&path, serde_json::to_string_pretty(&manifest).unwrap());
        place.refused(
            line,
            &[
                "did not write",
                &format!("and {others} more in other places"),
            ],
        );
    }
}

/// A text of the user's that is not UTF-8 and cites the mark, in the place of each kind of output.
#[test]
fn a_text_in_another_encoding_is_not_ours() {
    const CITES: &[u8] =
        b"// J\xfcrgen wrote it\n// pasted from what was @generated by fresnel-gen: once\n";
    for (line, file) in [
        (
            "--target wgsl --material silver --method schlick",
            "shaders-generated/wgsl/materials/silver.wgsl",
        ),
        (
            "--flavour three --material gold",
            "shaders-generated/three/README.md",
        ),
        (
            "bake --material gold --format c",
            "shaders-generated/lut/gold.h",
        ),
        ("chart --material gold,platinum --out-dir o", "o/chart.svg"),
        ("materials params gold --as usd -o gold.usda", "gold.usda"),
    ] {
        let place = Place::new();
        place.put(file, CITES);
        place.refused(line, &[file.rsplit('/').next().unwrap(), "did not write"]);
        assert_eq!(place.read_bytes(file), CITES, "{line}");
    }
}

/// A lock that somebody wrote: it names what never was, behind a link and beside it. It is a second name of a user's file.
#[cfg(unix)]
#[test]
fn a_forged_lock_reaches_nothing() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    let line = "--target wgsl --material gold --method schlick";
    let lock = format!("{OUT}/.fresnel-gen.lock");
    for folder in ["other/empty", "shaders-generated/mine/empty"] {
        fs::create_dir_all(place.path(folder)).unwrap();
    }
    symlink(place.path("other"), place.path(&format!("{OUT}/link"))).unwrap();
    let named = ["link/empty", "mine/empty"]
        .map(|folder| format!("{folder}/.fresnel-gen-0123456789abcdef.tmp\n"));
    place.put(&lock, named.concat());
    place.done(line);
    assert!(
        place.path("other/empty").is_dir() && place.path(&format!("{OUT}/mine/empty")).is_dir()
    );
    for text in [&b"photo \xff\xd8\n"[..], b""] {
        place.put("victim.jpg", text);
        fs::hard_link(place.path("victim.jpg"), place.path(&lock)).unwrap();
        let ran = place
            .done(&format!("{line} --prefix {}", text.len()).replace("--prefix ", "--prefix f_"));
        assert!(ran.err.contains("is not a lock of fresnel-gen"), "{ran:?}");
        assert_eq!(place.read_bytes("victim.jpg"), text);
        fs::remove_file(place.path(&lock)).unwrap();
    }
}

/// One output lies above another: nothing of either is written.
#[test]
fn an_output_above_another_is_refused() {
    let place = Place::new();
    for line in [
        "--target wgsl --material gold --method schlick --depfile shaders-generated/wgsl",
        "--target wgsl --material gold --method schlick --depfile shaders-generated/wgsl/materials/gold.wgsl/x.d",
        "--material gold --method schlick -o a.wgsl --depfile a.wgsl/b.d",
        "materials show gold --svg s/x --png s",
    ] {
        place.refused(line, &[]);
    }
}

/// A file without room for a mark is replaced and removed by its entry and its form.
#[test]
fn a_module_is_replaced_by_its_entry() {
    let place = Place::new();
    place.done("--target spirv --material gold --method schlick,conductor_exact");
    let ran = place.done("--target spirv --material gold --method schlick,conductor_exact --matching-angle 84 --prefix f_");
    assert!(!ran.err.contains("did not write"), "{ran:?}");
    let module = place_of(
        "--target spirv --material gold --method schlick",
        "gold.spv",
    );
    let mut bytes = place.read_bytes(&format!("{OUT}/{module}"));
    bytes.push(0);
    fs::write(place.path(&format!("{OUT}/{module}")), bytes).unwrap();
    place.refused(
        "--target spirv --material gold --method schlick,conductor_exact",
        &[&module, "did not write"],
    );
}
