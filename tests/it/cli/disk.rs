//! Folders that cannot be written: exit 2, a reason, and everything as it was.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

use super::OUT;
use super::PROGRAM;
use super::Place;
use super::Ran;
use super::contents;
use crate::not_checked;
use fresnel_gen::generator::output::{folder, lock};

#[test]
fn a_file_in_the_place_of_a_folder() {
    let place = Place::new();
    place.put(OUT, "mine\n");
    place.refused(
        "--target gles",
        &["cannot read shaders-generated/manifest.json"],
    );
    place.refused(
        "--target gles --out-dir shaders-generated/below",
        &["cannot read"],
    );
    place.put("out/gles", "mine\n");
    place.refused("--target gles --out-dir out", &["out/gles"]);
    place.put("out/hlsl/fresnel_schlick.hlsl/file", "mine\n");
    place.refused(
        "--target hlsl --out-dir out",
        &["fresnel_schlick.hlsl is not a file"],
    );
}

#[test]
fn a_manifest_that_is_not_ours() {
    let place = Place::new();
    place.done("--target gles");
    let good = place.read("shaders-generated/manifest.json");
    for (text, says) in [
        ("", "manifest.json:1:0: "),
        ("{}", "missing field `tool`"),
        ("[1, 2]\n", "manifest.json:1:"),
        (&good[..good.len() / 2], "manifest.json:"),
        (
            &good.replace("\"fresnel-gen\"", "\"other\""),
            "manifest.json:2:",
        ),
        (
            &good.replace("\"gles/fresnel_schlick.glsl\"", "\"../../mine\""),
            "`file` is `../../mine`",
        ),
    ] {
        place.put("shaders-generated/manifest.json", text);
        place.refused("--target gles", &[says, "nothing was written"]);
        place.refused("--target gles --check", &[says]);
    }
}

/// A limit on the size of a file stands in for a full disk, and needs no rights.
#[test]
fn a_disk_that_fills_up_leaves_the_old_tree() {
    let place = Place::new();
    place.done("--target gles");
    let before = place.files();
    // The manifest is larger than 128 blocks, the other files are not: all is staged before the fault.
    let script = format!("ulimit -f 128; exec '{PROGRAM}' --target gles,wgsl --prefix other_");
    let run = Command::new("sh")
        .args(["-c", &script])
        .current_dir(place.path(""))
        .output();
    let ran = Ran::new(script, run.unwrap()).ends(2);
    assert!(
        ran.err
            .contains("cannot write shaders-generated/manifest.json: File too large"),
        "{ran:?}"
    );
    assert!(ran.err.contains("no file was changed"), "{ran:?}");
    assert!(before == place.files(), "{ran:?} changed files");
    assert!(!place.path("shaders-generated/wgsl").exists());
}

/// The limit's signal says nothing, and would end the program: the write fails instead.
#[test]
fn a_limit_on_the_size_of_files_is_an_error() {
    let place = Place::new();
    place.put("o/old.txt", "old\n");
    place.put("s.wgsl", "old\n");
    for line in [
        "--method schlick,fitted --material gold --target wgsl -o s.wgsl --depfile new/s.d",
        "chart --material gold,platinum --out-dir o --json o/chart.json",
        "scene-error sphere --frames 1 --size 64x64 --material gold --method schlick --out-dir o --json s.json",
        "bake --material gold --out-dir o",
        "methods --json new/m.json",
        "materials show gold --svg gold.svg --png gold.png",
    ] {
        let before = place.files();
        let script = format!("ulimit -f 1; exec '{PROGRAM}' {line}");
        let run = Command::new("sh")
            .args(["-c", &script])
            .current_dir(place.path(""))
            .output();
        let ran = Ran::new(script, run.unwrap()).ends(2);
        assert!(ran.err.contains("File too large"), "{ran:?}");
        assert!(ran.err.contains("no file was changed"), "{ran:?}");
        assert!(before == place.files(), "{ran:?} changed files");
        assert!(!place.path("new").exists());
    }
}

/// More pictures than a process may usually open files.
#[test]
fn many_pictures_are_written() {
    let place = Place::new();
    let script = format!(
        "ulimit -S -n 64; exec '{PROGRAM}' scene-error sphere --frames 1 --size 16x16 --material all --method schlick,schlick_generalised --out-dir o"
    );
    let run = Command::new("sh")
        .args(["-c", &script])
        .current_dir(place.path(""))
        .output();
    Ran::new(script, run.unwrap()).ends(0);
    assert!(contents(&place.path("o")).len() > 400);
}

/// A run has several outputs, and the last of them cannot be written: none of the others is changed.
#[test]
fn all_outputs_are_written_or_none() {
    let place = Place::new();
    place.put(
        "f.glsl",
        "vec3 f(float c, vec3 f0) { return f0 + (1.0 - f0) * pow(1.0 - c, 5.0); }\n",
    );
    let lines = [
        ("chart --material gold,platinum --out-dir o", "--json"),
        (
            "scene-error sphere --frames 1 --size 64x64 --material gold --method schlick --out-dir o",
            "--json",
        ),
        ("stability --method schlick --out-dir o", "--json"),
        ("reproduce figures --out-dir o", "--json"),
        ("bake --material gold --size 16 --out-dir o", "--json"),
        ("--target gles --method schlick --out-dir o", "--depfile"),
        ("--target gles --method schlick -o s.glsl", "--depfile"),
        ("materials show gold --svg gold.svg", "--json"),
        (
            "cost --method schlick --material none --gpu gcn4 --out-dir o",
            "--json",
        ),
    ];
    for (line, flag) in lines {
        place.refused(
            &format!("{line} {flag} /dev/full"),
            &[
                "cannot write /dev/full: No space left",
                "no file was changed",
            ],
        );
        assert!(!place.path("o").exists(), "{line}");
    }
}

/// On a disk that is full after the first of a run's files.
#[test]
fn a_full_disk_changes_none_of_several_outputs() {
    let place = Place::new();
    let draw = |size| {
        format!(
            "scene-error sphere --frames 1 --size {size} --material gold --method schlick --out-dir o --json o/j.json"
        )
    };
    let script = format!(
        "mkdir o && mount -t tmpfs -o size=56k tmpfs o || exit 77
        '{PROGRAM}' {} || exit 78
        sha256sum o/* > before; '{PROGRAM}' {}; code=$?
        ls -A o > there; sha256sum -c before >&2 || exit 79
        exit $code",
        draw("48x48"),
        draw("96x96")
    );
    let run = Command::new("unshare")
        .args(["--mount", "sh", "-c", &script])
        .current_dir(place.path(""))
        .output();
    match run.map(|output| Ran::new(script, output)) {
        Ok(ran) if ran.code != Some(77) && !ran.err.contains("unshare:") => {
            let ran = ran.ends(2);
            assert!(ran.err.contains("No space left"), "{ran:?}");
            assert!(ran.err.contains("no file was changed"), "{ran:?}");
            assert!(!place.read("there").contains(".tmp"), "{ran:?}");
        }
        other => not_checked(&format!("a full disk: none can be mounted ({other:?})")),
    }
}

/// A file system without locks: NFS without its daemon, some of those that clouds mount.
#[cfg(target_os = "linux")]
#[test]
fn without_locks_nothing_is_left_behind() {
    let place = Place::new();
    place.put(
        "lib/no_locks.c",
        "#include <errno.h>\nint flock(int f, int how) { errno = ENOLCK; return -1; }\n",
    );
    let built = Command::new("cc")
        .args([
            "-shared",
            "-fPIC",
            "-o",
            "lib/no_locks.so",
            "lib/no_locks.c",
        ])
        .current_dir(place.path(""))
        .status();
    if !built.is_ok_and(|status| status.success()) {
        return not_checked("a file system without locks: there is no C compiler");
    }
    fs::create_dir(place.path("o")).unwrap();
    for line in [
        "--method schlick --target wgsl -o o/s.wgsl --depfile o/s.d",
        "methods --json o/m.json",
        "chart --material gold,platinum --out-dir o --json o/c.json",
        "--target wgsl --method schlick --material none --out-dir o/tree --depfile o/t.d",
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let mut command = place.command(&words);
        command.env("LD_PRELOAD", place.path("lib/no_locks.so"));
        let ran = Ran::new(line.to_owned(), command.output().unwrap()).ends(0);
        let is_told = ran.err.contains("the file system has no locks");
        assert_eq!(is_told, line.contains("tree"), "{ran:?}");
    }
    let files = contents(&place.path("o"));
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "c.json",
            "chart.html",
            "chart.svg",
            "m.json",
            "s.d",
            "s.wgsl",
            "t.d",
            "tree/manifest.json",
            "tree/wgsl/fresnel_schlick.wgsl"
        ]
    );
}

/// In a folder that users share lie files of others which nobody else may read: a leftover beside an output, a lock in a folder.
#[test]
fn an_unreadable_file_of_another_user_holds_nobody_up() {
    let place = Place::new();
    let left = folder::temporary_of(&place.path("a.wgsl"));
    let lock = format!("out/{}", lock::FILE);
    for file in [left.as_str(), lock.as_str()] {
        place.put(file, "");
        fs::set_permissions(place.path(file), fs::Permissions::from_mode(0o000)).unwrap();
    }
    for folder in ["", "out"] {
        fs::set_permissions(place.path(folder), fs::Permissions::from_mode(0o777)).unwrap();
    }
    // Root may read all; another user stands in for it.
    let is_root = fs::read(place.path(&left)).is_ok();
    for (line, says) in [
        ("--method schlick -o a.wgsl", ""),
        (
            "--target wgsl --method schlick --material none --out-dir out",
            ".fresnel-gen.lock cannot be opened (Permission denied",
        ),
    ] {
        let script = if is_root {
            format!(
                "setpriv --reuid=65534 --regid=65534 --clear-groups timeout 60 '{PROGRAM}' {line}"
            )
        } else {
            format!("timeout 60 '{PROGRAM}' {line}")
        };
        let run = Command::new("sh")
            .args(["-c", &script])
            .current_dir(place.path(""))
            .output();
        let ran = Ran::new(script, run.unwrap());
        if is_root && matches!(ran.code, Some(126 | 127)) {
            return not_checked(&format!("files of another user: {}", ran.err));
        }
        let ran = ran.ends(0);
        assert!(ran.err.contains(says), "{ran:?}");
    }
    assert!(place.path(&left).exists() && place.path(&lock).exists());
    assert!(place.read("a.wgsl").contains("fn fresnel_schlick("));
}

#[test]
fn a_full_device() {
    let place = Place::new();
    place.refused(
        "--method schlick --target gles -o /dev/full",
        &["cannot write /dev/full: No space left"],
    );
    for line in ["--method schlick -o -", "--list", "methods --json -"] {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let words: Vec<&str> = line.split(' ').collect();
        let output = place.command(&words).stdout(full).output().unwrap();
        let ran = Ran::new(line.to_string(), output).ends(2);
        assert!(
            ran.err.contains("cannot write to stdout: No space left"),
            "{ran:?}"
        );
    }
    place.done("--method schlick -o /dev/null");
}

#[test]
fn a_folder_without_permission() {
    let place = Place::new();
    place.done("--target gles");
    let probe = place.path("probe");
    fs::create_dir(&probe).unwrap();
    fs::set_permissions(&probe, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(probe.join("a"), "").is_ok() {
        return read_only_mount(&place);
    }
    let folder = place.path("shaders-generated/gles");
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).unwrap();
    place.refused(
        "--target gles --prefix other_",
        &["Permission denied", "no file was changed"],
    );
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).unwrap();
}

/// Permissions do not stop root, and a mount does. It lives in a name space of its own and ends with the process.
fn read_only_mount(place: &Place) {
    let before = contents(&place.path(OUT));
    let script = format!(
        "mount --bind {OUT} {OUT} && mount -o remount,ro,bind {OUT} || exit 77; exec '{PROGRAM}' --target gles --prefix other_"
    );
    let run = Command::new("unshare")
        .args(["--mount", "sh", "-c", &script])
        .current_dir(place.path(""))
        .output();
    match run.map(|output| Ran::new(script, output)) {
        Ok(ran) if ran.code == Some(2) => {
            assert!(ran.err.contains("Read-only file system"), "{ran:?}");
            assert!(ran.err.contains("no file was changed"), "{ran:?}");
            assert!(
                before == contents(&place.path(OUT)),
                "{ran:?} changed files"
            );
        }
        Ok(ran) if ran.code == Some(0) => panic!("{ran:?}"),
        other => not_checked(&format!(
            "a read-only folder: root may not mount one here ({other:?})"
        )),
    }
}

#[test]
fn links_are_not_written_through() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    place.done("--target gles --method schlick");
    let link = place.path("shaders-generated/gles/fresnel_schlick.glsl");
    let text = place.read("shaders-generated/gles/fresnel_schlick.glsl");
    fs::remove_file(&link).unwrap();
    // A link to what would be written passes: build sandboxes are made of them.
    place.put("elsewhere/fresnel_schlick.glsl", &text);
    symlink(place.path("elsewhere/fresnel_schlick.glsl"), &link).unwrap();
    place.done("--target gles --method schlick");
    place.done("--target gles --method schlick --check");
    place.put("elsewhere/fresnel_schlick.glsl", "old\n");
    place.refused(
        "--target gles --method schlick",
        &["fresnel_schlick.glsl: a link to ", "nothing was written"],
    );
    place.done("--target gles --method schlick --overwrite");
    assert_eq!(place.read("elsewhere/fresnel_schlick.glsl"), "old\n");
    assert!(!fs::symlink_metadata(&link).unwrap().is_symlink());
    place.done("-o single.wgsl --method schlick");
    fs::remove_file(place.path("single.wgsl")).unwrap();
    symlink(
        place.path("elsewhere/single.wgsl"),
        place.path("single.wgsl"),
    )
    .unwrap();
    place.run("-o single.wgsl --method schlick").ends(0);
}

#[test]
fn a_folder_of_the_tree_that_is_a_link_is_refused() {
    use std::os::unix::fs::symlink;
    let usual = "--target gles,wgsl --material gold";
    for folder in ["gles", "gles/materials", "lut"] {
        let place = Place::new();
        let run = if folder == "lut" {
            "bake --material gold --format ktx2"
        } else {
            usual
        };
        place.done(run);
        fs::create_dir(place.path("elsewhere")).unwrap();
        fs::rename(place.path(OUT).join(folder), place.path("elsewhere/moved")).unwrap();
        let moved = place.path("elsewhere/moved");
        symlink(&moved, place.path(OUT).join(folder)).unwrap();
        let other = if folder == "lut" {
            "bake --material gold --format ktx2 --size 32"
        } else {
            "--target gles,wgsl --material gold --prefix other_"
        };
        let link = format!("{OUT}/{folder} is a link to {}", moved.display());
        place.refused(other, &[&link, "nothing was written"]);
        if folder != "lut" {
            // `--check` follows links.
            place.done(&format!("{usual} --check"));
        }
    }
    // The output folder itself may be one.
    let place = Place::new();
    fs::create_dir(place.path("real")).unwrap();
    symlink("real", place.path(OUT)).unwrap();
    place.done(usual);
    assert!(place.path("real/gles/materials/gold.glsl").exists());
}

#[test]
fn check_creates_nothing_and_needs_no_right_to_write() {
    let place = Place::new();
    let ran = place.run("--target gles --method schlick --check").ends(1);
    assert!(ran.out.contains("missing: gles/fresnel_schlick.glsl"));
    assert!(!place.path(OUT).exists());
    place.done("--target gles --method schlick");
    let script = format!(
        "mount --bind {OUT} {OUT} && mount -o remount,ro,bind {OUT} || exit 77; '{PROGRAM}' --target gles --method schlick --check && exec '{PROGRAM}' --target gles --method schlick"
    );
    let run = Command::new("unshare")
        .args(["--mount", "sh", "-c", &script])
        .current_dir(place.path(""))
        .output();
    match run.map(|output| Ran::new(script, output)) {
        Ok(ran) if ran.code != Some(77) && !ran.err.contains("unshare:") => drop(ran.ends(0)),
        other => not_checked(&format!(
            "a read-only folder: it cannot be mounted ({other:?})"
        )),
    }
}
