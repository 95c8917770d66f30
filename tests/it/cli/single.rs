//! `-o`: one function, to a file or to stdout, ready to be pasted.

use super::MY_METAL;
use super::Place;

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

/// An ending, the language that it means, and whether that is what all files of this language end in.
const ENDINGS: [(&str, &str, bool); 12] = [
    (".wgsl", "wgsl", true),
    (".glsl", "gles", true),
    (".hlsl", "hlsl", true),
    (".hlsli", "hlsl", false),
    (".fxh", "hlsl", false),
    (".cginc", "hlsl", false),
    (".ush", "hlsl", false),
    (".usf", "hlsl", false),
    (".spv", "spirv", true),
    (".metal", "msl", true),
    (".HLSL", "hlsl", true),
    ("", "wgsl", true),
];

#[test]
fn the_ending_names_the_language() {
    let place = Place::new();
    for (ending, target, _) in ENDINGS {
        place.done(&format!("--method schlick -o a{ending}"));
        place.done(&format!("--method schlick --target {target} -o b{ending}"));
        let bytes = |name: &str| std::fs::read(place.path(&format!("{name}{ending}"))).unwrap();
        assert_eq!(bytes("a"), bytes("b"), "{ending}");
        let out = place.command(&["--method", "schlick", "--target", target, "-o", "-"]);
        let out = { out }.output().unwrap().stdout;
        assert_eq!(bytes("a"), out, "{ending}");
        let other = if target == "hlsl" { "gles" } else { "hlsl" };
        if !ending.is_empty() {
            place.refused(
                &format!("--method schlick --target {other} -o c{ending}"),
                &[
                    &format!("c{ending}"),
                    target,
                    &format!("--target is {other}"),
                ],
            );
        }
    }
    // Both languages of GLSL end so.
    place.done("--method schlick --target glsl -o d.glsl");
    assert!(place.read("d.glsl") != place.read("a.glsl"));
    for file in ["e.vert", "e.h", "e.txt", "e."] {
        let says = [file, "--target", ".hlsl", ".ush", ".wgsl", ".metal", ".spv"];
        place.refused(&format!("--method schlick -o {file}"), &says);
        place.done(&format!("--method schlick --target gles -o {file}"));
    }
}

#[test]
fn every_target_has_its_endings_in_the_table() {
    for target in fresnel_gen::language::targets::ALL {
        for ending in target.endings() {
            let is_it = |row: &&(&str, &str, bool)| row.0 == format!(".{ending}");
            let row = ENDINGS.iter().find(is_it).expect(ending);
            assert_eq!(row.2, target.extension == ending, "{ending}");
            assert!(
                row.1 == target.name || target.extension == "glsl",
                "{ending}"
            );
        }
    }
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
    place.refused("-o new.hlsl/", &["new.hlsl/ is not a file"]);
    assert!(!place.path("new.hlsl").exists());
    place.refused("-o folder/file/below", &["cannot write"]);
}
