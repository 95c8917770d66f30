//! `clean`: what is listed and as it was written goes, and nothing else.

use super::{OUT, Place};

#[test]
fn what_was_written_goes_and_nothing_else() {
    let place = Place::new();
    place.done("--target wgsl,gles --material gold --method fitted");
    place.done("bake --dfg --method schlick --size 4 --format ktx2");
    place.put(&format!("{OUT}/wgsl/mine.wgsl"), "// mine\n");
    let edited = format!("{OUT}/gles/materials/gold.glsl");
    place.put(&edited, &(place.read(&edited) + "// my line\n"));
    let listed = place.done("clean --list");
    assert!(
        listed.out.contains("wgsl/materials/gold.wgsl\n"),
        "{listed:?}"
    );
    assert!(listed.out.contains("lut/dfg_schlick.ktx2\n"), "{listed:?}");
    assert!(
        !listed.out.contains("mine.wgsl") && !listed.out.contains("gles/materials"),
        "{listed:?}"
    );
    assert!(
        place
            .path(&format!("{OUT}/wgsl/materials/gold.wgsl"))
            .exists()
    );
    let told = place.done("clean");
    assert!(
        told.err.contains("left alone: gles/materials/gold.glsl"),
        "{told:?}"
    );
    let stay = |path: &str| place.path(&format!("{OUT}/{path}")).exists();
    assert!(stay("wgsl/mine.wgsl") && stay("gles/materials/gold.glsl"));
    assert!(!stay("wgsl/materials") && !stay("lut") && stay("manifest.json"));
    // As it was again, it goes too, and the manifest with it.
    place.put(&edited, place.read(&edited).replace("// my line\n", ""));
    place.done("clean");
    assert!(stay("wgsl/mine.wgsl") && !stay("gles") && !stay("manifest.json"));
    place.refused("clean", &["there is no manifest.json"]);
    // A folder that holds nothing else goes with its last file.
    place.done("--target wgsl --material gold --method fitted --out-dir alone");
    place.done("clean --out-dir alone");
    assert!(!place.path("alone/wgsl").exists() && !place.path("alone/manifest.json").exists());
}

/// A manifest that somebody forged lists a file of the user's: it does not bear our mark and stays.
#[test]
fn a_forged_manifest_removes_nothing() {
    let place = Place::new();
    place.done("--target wgsl --material gold --method fitted");
    let manifest = format!("{OUT}/manifest.json");
    let mut json: serde_json::Value = serde_json::from_str(&place.read(&manifest)).unwrap();
    let mut entry = json["files"][0].clone();
    entry["file"] = "wgsl/fresnel_mine.wgsl".into();
    place.put(&format!("{OUT}/wgsl/fresnel_mine.wgsl"), "fn mine() {}\n");
    json["files"].as_array_mut().unwrap().push(entry);
    place.put(&manifest, json.to_string());
    let told = place.run("clean");
    assert!(
        place
            .path(&format!("{OUT}/wgsl/fresnel_mine.wgsl"))
            .exists(),
        "{told:?}"
    );
}

/// Whoever has an adapter wants no tree of hundreds of files beside it.
#[test]
fn a_folder_of_adapters_gets_no_tree_unasked() {
    let place = Place::new();
    place.done("--flavour godot --material gold");
    let before = place.listed();
    let told = place.run("");
    assert_eq!(told.code, Some(2), "{told:?}");
    assert!(told.err.contains("adapters for engines only"), "{told:?}");
    assert_eq!(place.listed(), before);
}

/// A listed file that cannot be read is no file that is gone: the manifest would be lost, and what it lists could never be cleaned.
#[cfg(unix)]
#[test]
fn what_cannot_be_read_keeps_its_manifest() {
    let place = Place::new();
    place.done("--target wgsl,gles --material gold --method fitted");
    let folder = place.path(&format!("{OUT}/wgsl"));
    let aside = place.path("aside");
    std::fs::rename(&folder, &aside).unwrap();
    std::os::unix::fs::symlink("wgsl", &folder).unwrap(); // a link to itself
    for command in ["clean", "clean --list"] {
        let told = place.run(command);
        assert_eq!(told.code, Some(2), "{told:?}");
    }
    std::fs::remove_file(&folder).unwrap();
    std::fs::rename(&aside, &folder).unwrap();
    place.done("clean");
    assert!(!place.path(&format!("{OUT}/manifest.json")).exists());
}
