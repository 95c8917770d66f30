//! `-o`: one function, to a file or to stdout, ready to be pasted.

use super::{MY_METAL, Place};

#[test]
fn a_function_for_pasting_is_short_and_stands_alone() {
    let place = Place::new();
    let ran = place.done("--material gold_thesis --method conductor_exact --target hlsl -o -");
    assert!(ran.out.lines().count() <= 25, "{ran:?}");
    assert_eq!(ran.out.matches("float3 fresnel_").count(), 1, "{ran:?}");
    assert!(
        ran.out
            .contains("float3 fresnel_gold_thesis(float cos_theta)\n{\n"),
        "{ran:?}"
    );
    assert!(!ran.out.contains("\n#"), "{ran:?}");
    assert_eq!(ran.err, "");
    assert!(place.files().is_empty(), "it wrote files");
    assert_eq!(
        place
            .done("--material gold_thesis --target hlsl -o -")
            .out
            .lines()
            .count(),
        ran.out.lines().count()
    );
}

#[test]
fn a_file_gets_what_stdout_gets() {
    let place = Place::new();
    place.put("my.toml", MY_METAL);
    for line in [
        "--method schlick",
        "--method schlick,f82_tint --target msl",
        "--material my.toml --target gles",
        "--material gold_thesis --medium water_thesis --target glsl",
        "--material none --target wgsl",
    ] {
        let out = place.done(&format!("{line} -o -")).out;
        let ran = place.done(&format!("{line} -o folder/f"));
        assert_eq!(
            (ran.out.as_str(), place.read("folder/f")),
            ("", out),
            "{line}"
        );
        let before = place.files();
        place.done(&format!("{line} -o folder/f"));
        assert!(before == place.files(), "{line} wrote the same again");
    }
}

#[test]
fn the_ending_names_the_language() {
    let place = Place::new();
    for (file, target) in [
        ("a.hlsl", "hlsl"),
        ("a.glsl", "gles"),
        ("a.metal", "msl"),
        ("a.wgsl", "wgsl"),
        ("a", "wgsl"),
    ] {
        place.done(&format!("--method schlick -o {file}"));
        let out = place.done(&format!("--method schlick --target {target} -o -"));
        assert_eq!(place.read(file), out.out, "{file}");
    }
    place.done("--method schlick --target glsl -o b.glsl");
    place.done("--method schlick --target hlsl -o b.ush");
    place.refused("--method schlick -o c.ush", &["c.ush", "--target", ".hlsl"]);
    place.refused(
        "--method schlick --target gles -o c.hlsl",
        &["c.hlsl", "hlsl", "--target is gles"],
    );
}

#[test]
fn modules_come_alone() {
    let place = Place::new();
    for line in [
        "--method schlick --target spirv",
        "--method conductor_exact --target spirv",
        "--method conductor_exact --material gold_thesis --target spirv",
    ] {
        let mut arguments: Vec<&str> = line.split(' ').collect();
        arguments.extend(["-o", "-"]);
        let output = place.command(&arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{line}: {output:?}");
        assert!(output.stdout.starts_with(b"\x03\x02\x23\x07"), "{line}");
    }
    place.refused("--target spirv -o -", &["name one --method"]);
}

#[test]
fn contradictions_are_refused() {
    let place = Place::new();
    place.refused("--target gles,hlsl -o x", &["-o takes one --target"]);
    for flag in ["--check", "--list", "--out-dir y"] {
        place.refused(&format!("-o x {flag}"), &["cannot be used with"]);
    }
    place.put("folder/file", "");
    place.refused("-o folder", &["folder is not a file"]);
    place.refused("-o folder/file/below", &["cannot write"]);
}
