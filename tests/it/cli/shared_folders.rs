//! Folders that several users write to: no output follows a link that another user laid there.

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, lchown, symlink};

use super::OUT;
use super::Place;

const STICKY: u32 = 0o1777;
/// Users that nobody is.
const OTHER: u32 = 61_234;
const OWNER: u32 = 61_235;

/// A folder `shared` of [`OWNER`] with this mode, and in it links of [`OTHER`]: to a file, to nothing, and to a folder. None where
/// this user cannot give files away.
fn shared(mode: u32) -> Option<Place> {
    let place = Place::new();
    place.put("mine.wgsl", "mine");
    fs::create_dir_all(place.path("folder")).unwrap();
    fs::create_dir_all(place.path("shared")).unwrap();
    fs::set_permissions(place.path("shared"), Permissions::from_mode(mode)).unwrap();
    for (to, link) in [("mine.wgsl", "file"), ("new", "nothing"), ("folder", "way")] {
        let link = place.path(&format!("shared/{link}"));
        symlink(place.path(to), &link).unwrap();
        if lchown(link, Some(OTHER), None).is_err() {
            eprintln!("not checked: links of another user (only root can make them)");
            return None;
        }
    }
    lchown(place.path("shared"), Some(OWNER), None).unwrap();
    Some(place)
}

#[test]
fn links_of_another_user_in_a_shared_folder_are_not_followed() {
    let Some(place) = shared(STICKY) else { return };
    for (line, link) in [
        (
            "--method schlick --target wgsl -o shared/file",
            "shared/file",
        ),
        (
            "--method schlick --target wgsl -o shared/nothing",
            "shared/nothing",
        ),
        ("--method schlick -o shared/way/a.wgsl", "shared/way"),
        (
            "--method schlick -o a.wgsl --depfile shared/nothing",
            "shared/nothing",
        ),
        (
            "--target wgsl --material none --out-dir shared/way",
            "shared/way",
        ),
        (
            "--target wgsl --material none --out-dir shared/way/inner",
            "shared/way",
        ),
        ("bake --material gold --out-dir shared/way", "shared/way"),
        ("chart --material gold --out-dir shared/way", "shared/way"),
        ("fit --material gold --json shared/file", "shared/file"),
        (
            "materials params gold --as gltf -o shared/way/gold.gltf",
            "shared/way",
        ),
    ] {
        place.refused(line, &[link]);
    }
    place.refused(
        "--method schlick --target wgsl -o shared/file",
        &["shared/file is a link or a pipe of another user in a folder that users share; nothing was written"],
    );
    assert_eq!(place.read("mine.wgsl"), "mine");
}

/// A pipe of another user: to open it would wait for whoever reads it, and write to them.
#[test]
fn pipes_of_another_user_in_a_shared_folder_are_not_opened() {
    let Some(place) = shared(STICKY) else { return };
    let pipe = place.path("shared/pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    lchown(&pipe, Some(OTHER), None).unwrap();
    for line in [
        "--method schlick --target wgsl -o shared/pipe",
        "--method schlick --target wgsl -o a.wgsl --depfile shared/pipe",
        "fit --material gold --json shared/pipe",
    ] {
        // `refused` reads all that lies there, and would wait for the pipe.
        let ran = place.run(line);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        let says = "shared/pipe is a link or a pipe of another user";
        assert!(ran.err.contains(says), "{ran:?}");
        assert!(!place.path("a.wgsl").exists(), "{line}");
    }
}

/// Links of the folder's owner, of root and of the user are followed, and so are all in a folder that is nobody else's.
#[test]
fn links_of_ones_own_are_followed() {
    let line = "--method schlick --target wgsl -o shared/file";
    for user in [OWNER, 0, OTHER] {
        let mode = if user == OTHER { 0o755 } else { STICKY };
        let Some(place) = shared(mode) else { return };
        lchown(place.path("shared/file"), Some(user), None).unwrap();
        place.done(line);
        assert!(place.read("mine.wgsl").contains("fresnel_schlick"));
        lchown(place.path("shared/way"), Some(user), None).unwrap();
        place.done("--target wgsl --material none --out-dir shared/way");
        assert!(place.path("folder/manifest.json").is_file());
    }
}

/// The lock of an output folder makes no file where a link leads.
#[test]
fn a_lock_follows_no_link() {
    let place = Place::new();
    fs::create_dir_all(place.path(OUT)).unwrap();
    symlink(
        place.path("new"),
        place.path(&format!("{OUT}/.fresnel-gen.lock")),
    )
    .unwrap();
    let ran = place.done("--target wgsl --method schlick --material none");
    assert!(ran.err.contains("is not a lock of fresnel-gen"), "{ran:?}");
    assert!(!place.path("new").exists());
}
