//! Text that nobody vouches for: whatever it holds, a run ends within a limit, with a word.

use std::time::{Duration, Instant};

use super::audit;
use super::rows;
use crate::cli::Place;

const FILES: [(&str, &str); 3] = [
    ("f.wgsl", "fn f(c: f32) -> f32 {\n    var x = c;\n"),
    ("f.glsl", "float f(float c) {\n    float x = c;\n"),
    ("f.hlsl", "float f(float c)\n{ float x = c;\n"),
];

/// Runs a function in every language; its body begins in the third line.
#[track_caller]
fn each(bodies: [&str; 3], code: i32, says: &[&str]) {
    for ((file, head), body) in FILES.into_iter().zip(bodies) {
        let place = Place::new();
        place.put(file, format!("{head}{body}"));
        let line = format!("{file} --material gold --gpu none --limit 5");
        let start = Instant::now();
        let Some(ran) = audit(&place, &line) else {
            continue;
        };
        let ran = ran.ends(code);
        assert!(start.elapsed() < Duration::from_secs(60), "{file}");
        for says in says {
            assert!(
                ran.err.contains(&says.replace("FILE", file)),
                "{says}: {ran:?}"
            );
        }
    }
}

#[test]
fn a_loop_without_end_is_an_error_within_the_limit() {
    let says = ["FAIL FILE: f: ", "have not ended after 10000 turns"];
    let c = "    while (x >= 0.0) { x = x * 0.5 + 0.1; }\n    return x;\n}\n";
    let wgsl = "    loop { x = x * 0.5 + 0.1; if x < 0.0 { break; } }\n    return x;\n}\n";
    each([wgsl, c, c], 1, &says);
    let c = "    for (;;) { do { for (; x > 0.0;) x = 0.5; } while (true); }\n    return x;\n}\n";
    let wgsl = "    loop { while true { for (;;) { x = 0.5; } } }\n    return x;\n}\n";
    each([wgsl, c, c], 1, &says);
}

#[test]
fn a_loop_with_an_end_is_run() {
    let c = "    for (int i = 0; i < 4; i++) x *= c;\n    return x;\n}\n";
    let wgsl = "    for (var i = 0; i < 4; i++) { x *= c; }\n    return x;\n}\n";
    each([wgsl, c, c], 0, &[]);
}

#[test]
fn broken_code_is_told_with_file_line_and_column() {
    let c = "    return x + y;\n}\n";
    each([c, c, c], 1, &["FAIL FILE:3:"]);
    for (file, says) in [
        ("f.wgsl", "f.wgsl:3:16"),
        ("f.glsl", "f.glsl:3:"),
        ("f.hlsl", "f.hlsl:3:16"),
    ] {
        let place = Place::new();
        let head = FILES.iter().find(|(name, _)| *name == file).unwrap().1;
        place.put(file, format!("{head}{c}"));
        if let Some(ran) = audit(&place, &format!("{file} --material gold --gpu none")) {
            assert!(ran.err.contains(says), "{ran:?}");
        }
    }
    let open = "    return x;\n";
    each([open, open, open], 1, &["FILE:3: at the end of the file"]);
    let deep = format!(
        "    return {}x{};\n}}\n",
        "(".repeat(20_000),
        ")".repeat(20_000)
    );
    each([&deep, &deep, &deep], 1, &["FAIL FILE"]);
}

#[test]
fn a_function_that_gives_nan_is_found_and_told() {
    let c = "    return sqrt(x - 0.5);\n}\n";
    each(
        [c, c, c],
        1,
        &["at cos_theta = 0 it is NaN", "it gives no number at"],
    );
    let c = "    return x * 2.0 - 0.5;\n}\n";
    each(
        [c, c, c],
        1,
        &[
            "at cos_theta = 0 it is below 0",
            "at cos_theta = 1 it is above 1",
        ],
    );
}

#[test]
fn files_that_are_no_source_are_refused() {
    let place = Place::new();
    place.put("huge.wgsl", vec![b' '; (1 << 20) + 1]);
    place.put("binary.wgsl", [0xFFu8, 0xFE, 0x00, 0x80]);
    place.put("zero.wgsl", "fn f(c: f32) -> f32 { return c; }\n \u{0}");
    place.put(
        "include.hlsl",
        "#include \"/etc/passwd\"\nfloat f(float c) { return c; }\n",
    );
    place.put(
        "macro.glsl",
        "#define EVER for (;;)\nfloat f(float c) { EVER {} return c; }\n",
    );
    place.put(
        "named.hlsl",
        "float f(float c) { return 5.0; }\n#define f(x) 0.5\n",
    );
    place.put(
        "named.glsl",
        "#/* here */define f g\nfloat f(float c) { return 5.0; }\n",
    );
    place.put(
        "asks.hlsl",
        "#if __has_include(\"/etc/passwd\")\n#endif\nfloat f(float c) { return c; }\n",
    );
    place.put(
        "digraph.hlsl",
        "%:include \"/etc/passwd\"\nfloat f(float c) { return c; }\n",
    );
    place.put("folder/file.wgsl", "");
    for (file, says) in [
        ("huge.wgsl", "at most 1048576 are read"),
        ("binary.wgsl", "not UTF-8"),
        ("zero.wgsl", "zero.wgsl:2:2: this is not text"),
        (
            "include.hlsl",
            "include.hlsl:1:2: `#include` is not allowed",
        ),
        ("macro.glsl", "a macro holds a loop"),
        ("named.hlsl", "named.hlsl:2:9: a macro is named `f`"),
        ("named.glsl", "named.glsl:1:19: a macro is named `f`"),
        ("asks.hlsl", "asks.hlsl:1:5: `__has_include` is not allowed"),
        (
            "digraph.hlsl",
            "digraph.hlsl:1:1: some compilers read these two signs",
        ),
        ("missing.wgsl", "cannot read missing.wgsl"),
        ("folder.wgsl", "cannot read folder.wgsl"),
    ] {
        place.refused(&format!("audit {file} --material gold"), &[says]);
    }
    place.refused(
        "audit folder --language wgsl --material gold",
        &["not an ordinary file"],
    );
}

/// Their macros end with their text: ours around it means what it says.
#[test]
fn a_macro_changes_nothing_of_the_program_around_it() {
    for (file, text) in [
        (
            "f.hlsl",
            "float3 f(float c) { return 5.0; }\n#define float4(a, b) float4(0.5, 0.5, 0.5, 1.0)\n",
        ),
        (
            "f.glsl",
            "float f(float c) { return 5.0; }\n#define vec3(a) vec3(0.5)\n",
        ),
        (
            "f.wgsl",
            "fn select(a: vec3<f32>, b: vec3<f32>, c: bool) -> vec3<f32> { return vec3<f32>(0.5); }\nfn f(c: f32) -> f32 { for (var i = 0; i < 3; i++) { } return 5.0; }\n",
        ),
    ] {
        let place = Place::new();
        place.put(file, text);
        let Some(ran) = audit(
            &place,
            &format!("{file} --function f --material gold --gpu none"),
        ) else {
            continue;
        };
        let ran = ran.ends(1);
        assert!(ran.out.contains("it is above 1"), "{ran:?}");
    }
    // Names that a language has, under macros of portable shaders.
    let place = Place::new();
    place.put(
        "f.glsl",
        "#define float3 vec3\n#define saturate(x) clamp(x, 0.0, 1.0)\nfloat3 f(float c) { return float3(saturate(c)); }\n",
    );
    if let Some(ran) = audit(&place, "f.glsl --material gold --gpu none") {
        ran.ends(0);
    }
}

#[test]
fn a_row_of_what_fails_has_its_keys() {
    let place = Place::new();
    place.put("f.wgsl", "fn f(c: f32) -> f32 { return y; }");
    let Some(ran) = audit(&place, "f.wgsl --material gold --json -") else {
        return;
    };
    let row = rows(&ran.ends(1)).remove(0);
    for key in [
        "target",
        "method",
        "material",
        "form",
        "precision",
        "points",
        "code_error",
        "model_error",
        "accepts",
        "status",
        "reason",
        "cost",
        "dominated_by",
    ] {
        assert!(row.get(key).is_some(), "{key}: {row}");
    }
    assert_eq!(
        (&row["status"], &row["accepts"]["naga"]),
        (&"fail".into(), &"no".into())
    );
}

/// What is hidden from the reader of loops and includes, and not from a compiler.
#[test]
fn text_that_can_be_read_in_two_ways_is_refused() {
    for (file, text) in [
        (
            "f.hlsl",
            "#inc\\\nlude \"other.h\"\nfloat f(float c) { return c; }\n",
        ),
        (
            "f.hlsl",
            "/* /* */\n#include \"other.h\"\n// */\nfloat f(float c) { return c; }\n",
        ),
        (
            "f.hlsl",
            "#pragma message \"/*\"\n#include \"other.h\"\nfloat f(float c) { return c; }\n",
        ),
        (
            "f.hlsl",
            "// \r#include \"other.h\"\nfloat f(float c) { return c; }\n",
        ),
        (
            "f.glsl",
            "float f(float c) { /* /* */ while (c >= 0.0) c = 0.5; // */\n return c; }\n",
        ),
        (
            "f.wgsl",
            "fn f(c: f32) -> f32 { // \u{2028} loop { }\n return c; }\n",
        ),
        (
            "f.wgsl",
            "fn f(c: f32) -> f32 { // \r loop { }\n return c; }\n",
        ),
    ] {
        let place = Place::new();
        place.put(file, text);
        let Some(ran) = audit(&place, &format!("{file} --material gold --gpu none")) else {
            continue;
        };
        let ran = ran.ends(2);
        assert!(ran.err.contains(&format!("{file}:")), "{ran:?}");
    }
    // A line that goes on is one line, and no pragma reaches a compiler.
    let place = Place::new();
    place.put(
        "f.glsl",
        "float f(float c) { fo\\\nr (;;) c = 0.5; return c; }\n",
    );
    if let Some(ran) = audit(&place, "f.glsl --material gold --gpu none") {
        assert!(ran.ends(1).err.contains("have not ended"));
    }
    place.put(
        "f.hlsl",
        "#pragma GCC dependency \"/etc/passwd\"\nfloat f(float c) { return c; }\n",
    );
    if let Some(ran) = audit(&place, "f.hlsl --material gold --gpu none") {
        ran.ends(0);
    }
    // Comments that end before the next begins, and a mark of byte order, are nobody's trick.
    let place = Place::new();
    place.put(
        "f.hlsl",
        "\u{feff}/* one */ /* two */ // /* three\r\nfloat f(float c) { return c; } // \"four\"\r\n",
    );
    if let Some(ran) = audit(&place, "f.hlsl --material gold --gpu none") {
        ran.ends(0);
    }
}

/// Words of a user's text are cut wherever a message shows them.
#[test]
fn a_name_of_a_hundred_thousand_letters_is_cut() {
    let place = Place::new();
    let long = "a".repeat(100_000);
    for (file, text, flags) in [
        (
            "a.wgsl",
            "fn f(c: f32, LONG: f32) -> f32 { return LONG; }",
            "",
        ),
        (
            "b.wgsl",
            "fn LONG(c: f32) -> f32 { return c; }\nfn g(c: f32) -> f32 { return c; }",
            "",
        ),
        (
            "c.wgsl",
            "fn LONG(c: f32) -> f32 { return c; }",
            "--function f",
        ),
        (
            "d.wgsl",
            "fn f(c: f32, x: LONG) -> f32 { return c; }",
            "--function f",
        ),
        (
            "e.glsl",
            "uniform sampler2D LONG;\nfloat f(float c) { return texture(LONG, vec2(0.0)).r; }",
            "",
        ),
        (
            "f.glsl",
            "uniform float LONG;\nfloat f(float c) { return LONG; }",
            "",
        ),
        ("g.glsl", "#LONG\nfloat f(float c) { return c; }", ""),
        (
            "h.glsl",
            "#error LONG a a a a LONG\nfloat f(float c) { return c; }",
            "",
        ),
        (
            "i.glsl",
            "#if LONG(\n#endif\nfloat f(float c) { return c; }",
            "",
        ),
        ("j.glsl", "#pragma LONG\nfloat f(float c) { return c; }", ""),
        (
            "k.hlsl",
            "float f(float c, float LONG) { return c; }\nfloat f(float c, float3 LONG) { return c; }",
            "",
        ),
        (
            "l.hlsl",
            "struct LONG { float x; float f(float c) { return x; } };",
            "",
        ),
        (
            "m.glsl",
            "#define f LONG\nfloat f(float c) { return LONG; }",
            "--function f:7",
        ),
        ("n.glsl", "float f(float c) { return LONG; }", ""),
    ] {
        place.put(file, text.replace("LONG", &long));
        let ran = place.run(&format!("audit {file} --material gold {flags}"));
        assert!(!ran.err.contains("panicked"), "{file}");
        let all = ran.err + &ran.out;
        assert!(!all.is_empty(), "{file} says nothing");
        let longest = all.split(|c| c != 'a').map(str::len).max();
        assert!(longest <= Some(500), "{file}: {longest:?} letters in a row");
    }
}
