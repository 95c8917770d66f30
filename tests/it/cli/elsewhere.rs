//! What a file names: only files below its own folder are read, links resolved, unless the command line names them too. No message holds
//! a word of a file that is not read.

use serde_json::json;

use super::MY_METAL;
use super::Place;

const SECRET: &str = "hunter2";

fn scene(object: &str) -> String {
    format!(
        "size = [16, 16]\n[camera]\northographic = 2.0\neye = [0, 0, 3]\nat = [0, 0, 0]\n[light]\nuniform = [1, 1, 1]\n[[object]]\n{object}\n"
    )
}

/// The words are refused with 2, for the place of what the file names.
#[track_caller]
fn is_refused(place: &Place, words: &[&str]) {
    let ran = place.run_with(words).ends(2);
    assert!(
        ran.err.contains("it lies outside of the folder of "),
        "{ran:?}"
    );
    assert!(
        !format!("{}{}", ran.out, ran.err).contains(SECRET),
        "{ran:?}"
    );
}

/// A place with a secret beside the folder of scenes.
fn place() -> Place {
    let place = Place::new();
    for ending in ["csv", "toml", "yml", "obj", "hdr", "bin"] {
        place.put(&format!("secret/key.{ending}"), format!("{SECRET}\n"));
    }
    place.put("secret/m.toml", MY_METAL);
    place.put("scenes/own/m.toml", MY_METAL);
    place
}

#[test]
fn a_scene_names_files_below_its_folder_only() {
    let place = place();
    let whole = place.path("secret/key.csv").display().to_string();
    for path in [
        "../secret/key.csv",
        "own/../../secret/key.yml",
        whole.as_str(),
        "../secret/absent.csv",
    ] {
        place.put(
            "scenes/s.toml",
            scene(&format!("body = \"sphere\"\nmaterial = \"{path}\"")),
        );
        is_refused(&place, &["plan", "scenes/s.toml"]);
    }
    place.put(
        "scenes/s.toml",
        scene("mesh = \"../secret/key.obj\"\nmaterial = \"gold\""),
    );
    is_refused(&place, &["plan", "scenes/s.toml"]);
    let lit = scene("body = \"sphere\"\nmaterial = \"gold\"");
    let lit = lit.replace("uniform = [1, 1, 1]", "environment = \"../secret/key.hdr\"");
    place.put("scenes/s.toml", lit);
    is_refused(&place, &["plan", "scenes/s.toml"]);
    place.put(
        "scenes/s.toml",
        scene("body = \"sphere\"\nmaterial = \"own/../own/m.toml\""),
    );
    place.done("plan scenes/s.toml");
}

#[test]
fn the_command_line_allows_more() {
    let place = place();
    place.put(
        "scenes/s.toml",
        scene("body = \"sphere\"\nmaterial = \"../secret/m.toml\""),
    );
    is_refused(&place, &["plan", "scenes/s.toml"]);
    is_refused(
        &place,
        &["plan", "scenes/s.toml", "--allow", "secret/key.csv"],
    );
    place.done("plan scenes/s.toml --allow secret/m.toml");
    let ran = place.done("plan scenes/s.toml --allow secret --json plan/p.json");
    drop(ran);
    assert!(
        place
            .read("plan/p.json")
            .contains("plan scenes/s.toml --allow secret")
    );
    // A plan names it too.
    is_refused(&place, &["--plan", "plan/p.json", "--target", "gles"]);
    place.done("--plan plan/p.json --target gles --allow secret");
    place.refused("--target gles --allow secret", &["--plan"]);
}

#[test]
fn a_map_of_ids_names_files_below_its_folder_only() {
    let place = place();
    place.put("scenes/frame.exr", "no picture");
    let map = |path: &str| format!("[[material]]\nid = 1\nmaterial = \"{path}\"\n");
    place.put("scenes/ids.toml", map("../secret/key.csv"));
    let words = [
        "plan",
        "--gbuffer",
        "scenes/frame.exr",
        "--materials",
        "scenes/ids.toml",
    ];
    is_refused(&place, &words);
}

#[cfg(unix)]
#[test]
fn a_link_does_not_lead_out() {
    use std::os::unix::fs::symlink;
    let place = place();
    symlink(place.path("secret/key.bin"), place.path("scenes/b.bin")).unwrap();
    symlink(place.path("secret"), place.path("scenes/linked")).unwrap();
    symlink(place.path("secret/key.csv"), place.path("scenes/m.csv")).unwrap();
    for uri in ["b.bin", "linked/key.bin"] {
        let gltf = json!({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1, "uri": uri}]});
        place.put("scenes/s.gltf", gltf.to_string());
        is_refused(&place, &["plan", "scenes/s.gltf"]);
    }
    for material in ["m.csv", "linked/key.toml"] {
        place.put(
            "scenes/s.toml",
            scene(&format!("body = \"sphere\"\nmaterial = \"{material}\"")),
        );
        is_refused(&place, &["plan", "scenes/s.toml"]);
    }
    // The folder itself may be reached by a link.
    symlink(place.path("scenes"), place.path("by_link")).unwrap();
    place.put(
        "scenes/s.toml",
        scene("body = \"sphere\"\nmaterial = \"own/m.toml\""),
    );
    place.done("plan by_link/s.toml");
}
