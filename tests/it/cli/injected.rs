//! Text of others in messages: names, values, paths and words that begin lines of their own, that a terminal or a build server obeys, or
//! that never end. Every reader is fed with them. What comes back is looked at as it leaves the library, before the program's own fence.

use std::path::Path;

use clap::Parser;
use serde_json::{Value, json};

use super::MY_METAL;
use super::OUT;
use super::Place;
use fresnel_gen::cli::{Cli, run};
use fresnel_gen::physics::foreign::is_hidden;

/// Lines that begin with a word of ours, commands of GitHub and of Azure, colours, turned text, breaks of Unicode.
const HOSTILE: &str = "x\nINJECTED\r\n::error::INJECTED\n ::warning::INJECTED\r##[error]INJECTED ##vso[x]\u{1b}[31m\u{9b}2J\u{7}\u{2028}INJECTED\u{202e}\u{85}INJECTED";

/// No line is longer than this.
const LONGEST: usize = 8000;

/// It with a beginning that would never be cut.
fn hostile_and_long() -> String {
    format!("{HOSTILE}{}", "long ".repeat(20_000))
}

/// No line begins with text of others, and nothing in it is obeyed.
#[track_caller]
fn is_clean(what: &str, text: &str) {
    for line in text.split('\n') {
        let begins = line.trim_start();
        let is_ours = !begins.starts_with("INJECTED") && !begins.starts_with("::");
        assert!(
            is_ours,
            "{what}: a line begins with {begins:.80?}\n{text:.2000}"
        );
        let hidden = line.chars().find(|c| is_hidden(*c));
        assert_eq!(hidden, None, "{what}: {line:.300?}");
        let is_obeyed = ["##[", "##vso["].iter().any(|mark| line.contains(mark));
        assert!(!is_obeyed, "{what}: {line:.300}");
        assert!(
            line.len() < LONGEST,
            "{what}: a line of {} bytes",
            line.len()
        );
    }
}

/// All that a run says, as the library gives it.
fn said(words: &[&str]) -> String {
    let words = ["fresnel-gen"].iter().chain(words);
    let cli = Cli::try_parse_from(words).unwrap_or_else(|fault| panic!("{fault}"));
    let mut all = String::new();
    let announced = std::cell::RefCell::new(String::new());
    let announce = |line: &str| announced.borrow_mut().push_str(&format!("{line}\n"));
    match run(&cli, &mut |_, _, _| {}, &announce) {
        Ok(output) => {
            all += &String::from_utf8_lossy(&output.stdout);
            output
                .remarks
                .iter()
                .for_each(|line| all += &format!("\n{line}"));
        }
        Err(error) => all += &format!("error: {error}"),
    }
    all + "\n" + &announced.into_inner()
}

/// A file of a reader, and the words before and behind its path.
#[track_caller]
fn check(place: &Place, file: &str, text: &str, command: &str) {
    place.put(file, text);
    let path = place.path(file).display().to_string();
    let out = place.path("out").display().to_string();
    let words: Vec<String> = command
        .split(' ')
        .map(|word| word.replace("FILE", &path).replace("OUT", &out))
        .collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    is_clean(&format!("{command} with {text:.200?}"), &said(&words));
}

/// TOML's spelling of a text.
fn toml(text: &str) -> String {
    // Its basic strings escape as JSON's do.
    serde_json::Value::from(text).to_string()
}

fn both() -> [String; 2] {
    [HOSTILE.to_owned(), hostile_and_long()]
}

#[test]
fn materials_and_tables() {
    let place = Place::new();
    for hostile in both() {
        let quoted = toml(&hostile);
        for field in [
            "name",
            "summary",
            "class",
            "licence",
            "reference",
            "link",
            "note",
        ] {
            let mut lines: Vec<String> = MY_METAL.lines().map(str::to_owned).collect();
            lines.retain(|line| !line.starts_with(&format!("{field} ")));
            let text = format!("{field} = {quoted}\n{}", lines.join("\n"));
            for command in [
                "--material FILE --target gles --out-dir OUT",
                "materials show FILE",
                "fit --material FILE",
            ] {
                check(&place, "m.toml", &text, command);
            }
        }
        for text in [
            format!("{quoted} = 1\n{MY_METAL}"),
            format!("{MY_METAL}\n[{quoted}]\n"),
            format!("{hostile}\n{MY_METAL}"),
            format!("{MY_METAL}rgb_nm = {quoted}\n"),
        ] {
            check(
                &place,
                "m.toml",
                &text,
                "--material FILE --target gles --out-dir OUT",
            );
        }
        for text in [
            format!("{hostile},n,k\n400,1,1\n"),
            format!("nm,n,k\n400,{hostile},1\n"),
            format!("nm,n,k\n400,1,1\n{hostile}\n"),
        ] {
            check(&place, "m.csv", &text, "materials import FILE -o OUT.toml");
            check(
                &place,
                "m.csv",
                &text,
                "materials params gold --illuminant FILE",
            );
        }
        let quoted = serde_json::to_string(&hostile).unwrap();
        let page = |kind: &str, data: &str| {
            format!(
                "REFERENCES: {quoted}\nCOMMENTS: {quoted}\nDATA:\n- type: {kind}\n  data: {data}\n"
            )
        };
        for text in [
            page(&quoted, "\"400 1 1\""),
            page("tabulated nk", &quoted),
            page("tabulated nk", "\"0.36 1 2\\n0.83 1 2\""),
            format!("{quoted}: 1\n"),
            format!("DATA:\n- {quoted}: 1\n"),
        ] {
            check(&place, "p.yml", &text, "materials import FILE -o OUT.toml");
            check(&place, "p.yml", &text, "materials show FILE");
            check(&place, "p.yml", &text, "materials survey FILE");
        }
    }
}

#[test]
fn scenes_meshes_and_maps() {
    let place = Place::new();
    place.put("frame.exr", "no picture");
    for hostile in both() {
        let quoted = toml(&hostile);
        let scene = |object: &str| {
            format!(
                "size = [16, 16]\n[camera]\northographic = 2.0\neye = [0, 0, 3]\nat = [0, 0, 0]\n[light]\nuniform = [1, 1, 1]\n[[object]]\n{object}\n"
            )
        };
        for text in [
            scene(&format!("body = \"sphere\"\nmaterial = {quoted}")),
            scene(&format!("body = {quoted}\nmaterial = \"gold\"")),
            scene(&format!("mesh = {quoted}\nmaterial = \"gold\"")),
            scene(&format!(
                "name = {quoted}\nbody = \"sphere\"\nmaterial = \"gold\""
            )),
            scene(&format!(
                "{quoted} = 1\nbody = \"sphere\"\nmaterial = \"gold\""
            )),
            scene("").replace("uniform = [1, 1, 1]", &format!("environment = {quoted}")),
        ] {
            check(&place, "s.toml", &text, "plan FILE");
        }
        for text in [
            format!("v 0 0 {hostile}\n"),
            format!("f {hostile} 1 2\n"),
            format!("{hostile}\n"),
        ] {
            check(
                &place,
                "m.obj",
                &text,
                "scene-error --mesh FILE --eye 1,1,1 --material gold --size 16x16",
            );
        }
        let gltf = |root: Value| root.to_string();
        for text in [
            gltf(json!({"asset": {"version": hostile}})),
            gltf(json!({"asset": {"version": "2.0"}, "extensionsRequired": [hostile]})),
            gltf(
                json!({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 1, "uri": hostile}]}),
            ),
            gltf(json!({"asset": {"version": "2.0"}, hostile.as_str(): 1, "meshes": hostile})),
        ] {
            check(&place, "s.gltf", &text, "plan FILE");
        }
        let frame = place.path("frame.exr").display().to_string();
        for text in [
            format!("[materials]\n1 = {quoted}\n"),
            format!("[[material]]\nid = 1\nmaterial = {quoted}\n"),
            format!("{quoted} = 1\n"),
        ] {
            place.put("ids.toml", &text);
            let map = place.path("ids.toml").display().to_string();
            is_clean(
                &text,
                &said(&["plan", "--gbuffer", &frame, "--materials", &map]),
            );
        }
    }
}

#[test]
fn plans_manifests_and_shards() {
    let place = Place::new();
    place.put(
        "s.toml",
        "size = [16, 16]\n[camera]\northographic = 2.0\neye = [0, 0, 3]\nat = [0, 0, 0]\n[light]\nuniform = [1, 1, 1]\n[[object]]\nbody = \"sphere\"\nmaterial = \"gold\"\n",
    );
    place.done("plan s.toml --json plan.json");
    let plan: Value = serde_json::from_str(&place.read("plan.json")).unwrap();
    place.done("--target gles --method schlick --material gold");
    let manifest = place.manifest();
    for hostile in both() {
        for key in ["tool", "command", "space", "gpu", "rows", "schema"] {
            let mut plan = plan.clone();
            plan[key] = hostile.clone().into();
            check(
                &place,
                "p.json",
                &plan.to_string(),
                "--plan FILE --out-dir OUT",
            );
        }
        for key in ["method", "material", "form", "precision"] {
            let mut plan = plan.clone();
            plan["rows"][0][key] = hostile.clone().into();
            check(
                &place,
                "p.json",
                &plan.to_string(),
                "--plan FILE --out-dir OUT",
            );
        }
        let folder = place.path(OUT).display().to_string();
        let is_plain = |manifest: &Value| {
            place.put(&format!("{OUT}/manifest.json"), manifest.to_string());
            let flags = ["--target", "gles", "--out-dir", folder.as_str()];
            is_clean("a manifest", &said(&flags));
            let check: Vec<&str> = flags.iter().copied().chain(["--check"]).collect();
            is_clean("a manifest, looked at", &said(&check));
        };
        for key in ["tool", "schema", "version", "files"] {
            let mut manifest = manifest.clone();
            manifest[key] = hostile.clone().into();
            is_plain(&manifest);
        }
        for key in ["file", "target", "method", "material", "sha256"] {
            let mut manifest = manifest.clone();
            for entry in manifest["files"].as_array_mut().unwrap() {
                entry[key] = hostile.clone().into();
            }
            is_plain(&manifest);
        }
        let mut seen = manifest.clone();
        for entry in seen["files"].as_array_mut().unwrap() {
            entry["seen"] = json!({ "truth": hostile });
            entry["functions"] = json!([{ "name": hostile, "method": hostile }]);
        }
        is_plain(&seen);
        for key in [
            "tool", "command", "version", "shards", "schema", "machine", "rows",
        ] {
            let mut shard = json!({"tool": "fresnel-gen", "schema": 1, "version": env!("CARGO_PKG_VERSION"), "command": "verify", "shards": 2, "shard": 0});
            shard[key] = hostile.clone().into();
            check(&place, "shard.json", &shard.to_string(), "merge FILE");
        }
    }
}

/// A generated file that somebody edited, as a difference.
#[test]
fn a_difference_begins_no_line_of_its_own() {
    let place = Place::new();
    place.done("--target gles --method schlick --material none");
    let file = format!("{OUT}/gles/fresnel_schlick.glsl");
    let text = place.read(&file);
    place.put(
        &file,
        text.replacen('\n', &format!("\n{HOSTILE}\n::error::x\n"), 2),
    );
    let folder = place.path(OUT).display().to_string();
    let flags = [
        "--target",
        "gles",
        "--method",
        "schlick",
        "--material",
        "none",
        "--check",
        "--out-dir",
    ];
    let flags: Vec<&str> = flags.into_iter().chain([folder.as_str()]).collect();
    let text = said(&flags);
    assert!(text.contains("\\u{3a}:error::x"), "{text}");
    is_clean("a difference", &text);
}

/// Words of the command line, and names of files, through the program itself: its parser speaks too.
#[test]
fn words_and_names() {
    let place = Place::new();
    let file = |ending: &str| format!("{HOSTILE}.{ending}");
    for (ending, text) in [
        ("toml", "nonsense"),
        ("csv", "nonsense"),
        ("yml", "- nonsense"),
        ("obj", "f"),
        ("gltf", "{"),
        ("json", "{"),
        ("glsl", "float f("),
    ] {
        std::fs::write(Path::new(&place.path("")).join(file(ending)), text).unwrap();
    }
    let [material, table, page, mesh, scene, plan, shader] =
        ["toml", "csv", "yml", "obj", "gltf", "json", "glsl"].map(file);
    let [material, table, page, mesh, scene, plan, shader] =
        [&material, &table, &page, &mesh, &scene, &plan, &shader].map(String::as_str);
    let absent = format!("{HOSTILE}/absent.toml");
    let runs: &[&[&str]] = &[
        &["--material", material],
        &["--material", table, "--target", "gles"],
        &["--material", &absent],
        &["--material", HOSTILE],
        &["--method", HOSTILE],
        &["--target", HOSTILE],
        &["--effect", HOSTILE],
        &["--prefix", HOSTILE, "--method", "schlick", "-o", "-"],
        &["--medium", HOSTILE],
        &["--illuminant", HOSTILE],
        &["--illuminant", table],
        &["--wavelengths", HOSTILE],
        &["--budget", HOSTILE],
        &["--plan", plan],
        &["-o", material, "--material", material],
        &["-o", &absent, "--method", "schlick"],
        &[
            "--out-dir",
            material,
            "--method",
            "schlick",
            "--target",
            "gles",
        ],
        &[
            "--depfile",
            HOSTILE,
            "--method",
            "schlick",
            "-o",
            "a.wgsl",
            "--depfile-target",
            HOSTILE,
        ],
        &["materials", "import", page],
        &["materials", "import", page, "--name", HOSTILE],
        &["materials", "list", "--substance", HOSTILE],
        &[
            "scene-error",
            "--mesh",
            mesh,
            "--eye",
            "1,1,1",
            "--material",
            "gold",
        ],
        &["scene-error", "cube", "--size", HOSTILE],
        &["scene-error", HOSTILE],
        &["plan", scene],
        &["plan", &absent],
        &["plan", "--gbuffer", scene, "--materials", material],
        &["audit", shader, "--material", "gold"],
        &["audit", shader, "--material", "gold", "--arg", HOSTILE],
        &["audit", shader, "--material", "gold", "--function", HOSTILE],
        &["merge", plan],
        &[HOSTILE],
        &["--", HOSTILE],
        &["--\n::error::INJECTED"],
        &["methods", "show", HOSTILE],
        &["completions", HOSTILE],
    ];
    // A survey counts what it refuses.
    let survey: &[&str] = &["materials", "survey", page];
    let refused = runs.iter().map(|words| (*words, 1..=3));
    for (words, codes) in refused.chain([(survey, 0..=0)]) {
        let ran = place.run_with(words);
        assert!(
            ran.code.is_some_and(|code| codes.contains(&code)),
            "{ran:?}"
        );
        assert!(!ran.err.contains("panicked"), "{ran:?}");
        is_clean(&format!("{words:?}"), &ran.err);
        is_clean(&format!("{words:?}"), &ran.out);
    }
}

/// Comments of shaders, depfiles and reports of a file whose name breaks lines.
#[test]
fn heads_and_reports() {
    let place = Place::new();
    let name = "a\n::error::INJECTED\u{1b}\u{202e}*.csv";
    std::fs::write(place.path(name), "nm,n,k\n360,1,2\n830,1,2\n").unwrap();
    for target in ["gles", "wgsl", "hlsl", "msl", "glsl"] {
        let ran = place
            .run_with(&["--material", name, "--target", target, "-o", "-"])
            .ends(0);
        is_clean(target, &ran.out);
        assert!(ran.out.is_ascii(), "{ran:?}");
    }
    for command in ["fit", "bake", "chart", "materials show", "materials params"] {
        let material: &[&str] = if command.starts_with("materials") {
            &[]
        } else {
            &["--material"]
        };
        let words = command
            .split(' ')
            .chain(material.iter().copied())
            .chain([name]);
        let words: Vec<&str> = words.collect();
        let ran = place.run_with(&words).ends(0);
        is_clean(command, &ran.out);
        is_clean(command, &ran.err);
    }
    for format in [
        "materialx",
        "usd",
        "blender",
        "unreal",
        "filament",
        "openpbr",
        "gltf",
    ] {
        let ran = place.run_with(&["materials", "params", name, "--as", format]);
        assert!(matches!(ran.code, Some(0 | 2)), "{ran:?}");
        is_clean(format, &ran.out);
        is_clean(format, &ran.err);
    }
    let depfile = [
        "--material",
        name,
        "--method",
        "fitted",
        "-o",
        "a.wgsl",
        "--depfile",
        "d",
    ];
    let ran = place.run_with(&depfile).ends(2);
    is_clean("a depfile", &ran.err);
}

/// Reports of files whose names break lines, where the run succeeds or finds something: text, stderr, JUnit, SVG, HTML.
#[test]
fn reports_name_files_on_one_line() {
    const NAME: &str = "h\n::error::INJECTED\u{1b}[31m";
    let place = Place::new();
    let file = |ending: &str, text: &str| {
        let name = format!("{NAME}.{ending}");
        std::fs::write(place.path(&name), text).unwrap();
        name
    };
    let table = file("csv", "nm,n,k\n360,1,2\n830,1,2\n");
    let mesh = file(
        "obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 3 4\n",
    );
    let shader = file(
        "wgsl",
        "fn schlick(c: f32, f0: vec3<f32>) -> vec3<f32> { return 2.0 * f0 * pow(1.0 - c, 5.0); }\n",
    );
    let broken = file("glsl", "vec3 f(float c, vec3 f0) { return zz * f0; }\n");
    let [table, mesh, shader, broken] = [&table, &mesh, &shader, &broken].map(String::as_str);
    let mut runs: Vec<Vec<&str>> = vec![vec![
        "scene-error",
        "--mesh",
        mesh,
        "--eye",
        "0,1,-3",
        "--material",
        table,
        "--size",
        "16x16",
        "--out-dir",
        "scene",
    ]];
    let junit = ["--junit", "j.xml", "--out-dir", "charts"];
    for file in [shader, broken] {
        runs.push([&["audit", file, "--material", table], &junit[..]].concat());
    }
    let verify = ["verify", "--material", table, "--target", "gles"];
    runs.push([&verify[..], &["--method", "schlick"], &junit[..2]].concat());
    for words in runs {
        let ran = place.run_with(&words);
        assert!(matches!(ran.code, Some(0 | 1 | 3)), "{ran:?}");
        is_clean(&format!("{words:?}"), &ran.out);
        is_clean(&format!("{words:?}"), &ran.err);
        for file in ["j.xml", "charts/chart.svg"] {
            if place.path(file).exists() {
                let text = place.read(file);
                let is_clean = text
                    .lines()
                    .all(|line| !line.trim_start().starts_with("::") && !line.contains('\u{1b}'));
                assert!(is_clean, "{words:?}: {file}: {text:.4000}");
            }
        }
    }
}
