//! Files, names and arguments that are made to do harm: numbers that explode, text that a terminal obeys, names that compilers
//! and systems keep.

use std::collections::BTreeSet;

use super::MY_METAL;
use super::OUT;
use super::Place;
use super::Ran;
use fresnel_gen::generator::generate::generate;
use fresnel_gen::generator::request::{Materials, Methods, Request, Source};
use fresnel_gen::generator::{exchange, flavours};
use fresnel_gen::language::methods::Method;
use fresnel_gen::language::targets::{self, Target};

/// A material whose index is a formula.
fn formula(class: &str, formula: &str) -> String {
    let head = MY_METAL.split("data").next().unwrap();
    let head = head.replace("\"metal\"", &format!("\"{class}\""));
    format!("{head}n_formula = {{ {formula} }}\n")
}

const BOMB: &str = "number = 1, from_nm = 300, to_nm = 2500, coefficients = [1e155]";

/// The commands that look at a material, with its file.
const COMMANDS: [&str; 8] = [
    "--material bomb --target gles",
    "--material bomb --budget 0.01",
    "--medium bomb --material gold --target gles",
    "chart --material bomb",
    "fit --material bomb",
    "bake --material bomb",
    "materials params bomb",
    "materials show bomb",
];

#[test]
fn a_formula_that_explodes_is_refused_by_every_command() {
    let place = Place::new();
    for class in ["metal", "semiconductor", "dielectric"] {
        place.put("bomb.toml", formula(class, BOMB));
        for line in COMMANDS {
            place.refused(
                &line.replace("bomb", "bomb.toml"),
                &[
                    "bomb.toml:7:13: field `n_formula`: formula 1 gives n^2 = 1e155 at 300 nm",
                    "n must lie between 0.001 and 10000",
                ],
            );
        }
    }
    place.refused("cost --material bomb.toml --gpu gcn4", &["bomb.toml:7:13"]);
}

#[test]
fn an_index_beyond_the_laws_is_refused_wherever_it_is_taken() {
    let place = Place::new();
    for (rows, says) in [
        ("360,1e155,0\n830,1.5,0", "n is 9.5745e154 at 380 nm"),
        ("360,5e-324,0\n830,1e-9,0", "n is 4.2553e-11 at 380 nm"),
        ("360,1,1e200\n830,1,0", "k is 9.5745e199 at 380 nm"),
        ("360,-3,0\n830,2,0", "n is -2.7872 at 380 nm"),
    ] {
        place.put("bomb.csv", format!("nm,n,k\n{rows}\n"));
        for line in COMMANDS
            .iter()
            .filter(|line| !line.contains("medium") && !line.contains("show"))
        {
            place.refused(
                &line.replace("bomb", "bomb.csv"),
                &[says, "it must lie between"],
            );
        }
    }
}

/// At the limits of n and k, matched, and in media of all of these.
#[test]
fn params_prints_numbers_only() {
    let place = Place::new();
    let all = [
        "1,0",
        "0.001,0",
        "10000,0",
        "1,10000",
        "0.001,10000",
        "10000,10000",
    ];
    for (i, index) in all.iter().enumerate() {
        place.put(
            &format!("{i}.csv"),
            format!("nm,n,k\n360,{index}\n830,{index}\n"),
        );
    }
    for material in 0..all.len() {
        for medium in ["", " --medium 1.csv", " --medium 2.csv"] {
            let line = format!("materials params {material}.csv{medium}");
            let text = place.done(&line).out;
            let words = text.split_whitespace();
            let wrong: Vec<&str> = words
                .filter(|word| ["NaN", "inf", "-inf"].contains(word))
                .collect();
            assert!(wrong.is_empty(), "{line}: {text}");
            let json = place.done(&format!("{line} --json -")).json();
            for key in [
                "f0",
                "f82",
                "f82_tint",
                "f90",
                "n",
                "k",
                "average",
                "reflectivity",
                "edge_tint",
            ] {
                let numbers = json[key].as_array().unwrap();
                assert!(
                    numbers.iter().all(|number| number.is_number()),
                    "{line}: {key} {json}"
                );
            }
        }
    }
}

/// What stands in none of these: the beginning of a terminal's commands, and what turns its lines.
const OBEYED: [char; 5] = ['\u{1b}', '\u{7}', '\u{9b}', '\u{9d}', '\u{202e}'];

#[track_caller]
fn is_plain(text: &str) {
    let found = text.chars().find(|c| OBEYED.contains(c));
    assert_eq!(found, None, "{text:?}");
}

const EVIL: &str = "\u{1b}[31m\u{9b}2J\u{1b}]0;x\u{7}\u{202e}";

#[test]
fn a_terminal_obeys_no_text_of_a_user() {
    let place = Place::new();
    // TOML has these as escapes.
    let escaped = "\\u001b[31m\\u009b2J\\u001b]0;x\\u0007\\u202e";
    place.put(
        "note.toml",
        MY_METAL.replace("link", &format!("note = \"{escaped}\"\nlink")),
    );
    let shown = place.done("materials show note.toml");
    assert!(shown.out.contains("\\u{1b}[31m\\u{9b}2J"), "{shown:?}");
    is_plain(&shown.out);
    let json = place.done("materials show note.toml --json -");
    is_plain(&json.out);
    assert_eq!(json.json()["note"], EVIL);
    place.put("page.csv", format!("nm,n,k\n{EVIL},1,1\n"));
    let material = format!("{EVIL}.toml");
    for arguments in [
        vec!["--material", "page.csv"],
        vec!["--material", material.as_str()],
        vec!["--target", EVIL],
        vec!["--method", "schlick", "--prefix", EVIL],
        vec![EVIL],
        vec!["materials", EVIL],
        vec!["--precision", EVIL],
        vec!["materials", "show", EVIL],
    ] {
        let ran = place.run_with(&arguments).ends(2);
        is_plain(&ran.err);
        is_plain(&ran.out);
    }
}

#[test]
fn a_difference_is_shown_and_not_obeyed() {
    let place = Place::new();
    place.done("--target gles --method schlick");
    let file = format!("{OUT}/gles/fresnel_schlick.glsl");
    place.put(&file, place.read(&file) + EVIL);
    let ran = place.run("--target gles --method schlick --check").ends(1);
    assert!(ran.out.contains("\\u{1b}]0;x"), "{ran:?}");
    is_plain(&ran.out);
}

#[test]
fn headers_hold_plain_text() {
    let place = Place::new();
    let page = "REFERENCES: \"a\\x1b[31m\\x9b\\u202eb\"\nCOMMENTS: \"c\\ed\"\nDATA:\n- type: tabulated nk\n  data: |\n    0.36 1 2\n    0.83 1 2\n";
    place.put("page.yml", page);
    let ran = place.done("--material page.yml -o -");
    assert!(ran.out.is_ascii(), "{ran:?}");
    is_plain(&ran.out);
    let toml = place.done("materials import page.yml -o -");
    is_plain(&toml.out);
}

#[test]
fn a_field_of_one_line_has_no_break() {
    let place = Place::new();
    let summary = "summary = \"An invented\\nmetal\"";
    let broken = MY_METAL.replace("summary = \"An invented metal\"", summary);
    assert_ne!(broken, MY_METAL);
    place.put("m.toml", broken);
    place.refused(
        "--material m.toml --target gles",
        &["m.toml:2:11: field `summary` holds a line break; it wants one line"],
    );
}

/// Every reserved word of every language as the name of a material without a prefix: refused for each target, since a function
/// has one name in all. With the prefix each is a good name, where a material may have it at all.
#[test]
fn every_reserved_word_is_refused_as_a_whole_name() {
    let request = |word: &str, prefix: &str| Request {
        targets: vec![Target::GLES],
        methods: Methods::These(vec![Method::CONDUCTOR_EXACT]),
        materials: Materials::These(vec![Source::File {
            file: "m.toml".to_owned(),
            text: MY_METAL.replace("\"my_metal\"", &format!("\"{word}\"")),
        }]),
        prefix: prefix.to_owned(),
        ..Request::default()
    };
    let lists = targets::ALL.iter().flat_map(|target| target.reserved);
    let words: BTreeSet<&str> = lists.copied().flatten().copied().collect();
    let mut refused = 0;
    for word in &words {
        let bare = generate(&request(word, ""));
        let why = bare.expect_err(word).to_string();
        if generate(&request(word, "fresnel_")).is_ok() {
            let expected = format!("`{word}` is a reserved word of ");
            assert!(why.contains(&expected), "{word}: {why}");
            refused += 1;
        }
    }
    println!("{refused} of {} words are names", words.len());
    assert!(refused > 600, "{refused}");
}

/// Words of the six languages and names that their compilers know, as a material's name without a prefix.
#[test]
fn a_name_that_a_language_keeps_is_refused_whole() {
    let place = Place::new();
    let named = |name: &str| MY_METAL.replace("\"my_metal\"", &format!("\"{name}\""));
    for name in [
        "average", "texture", "half", "lerp", "fract", "kernel", "saturate", "fwidth",
    ] {
        place.put("m.toml", named(name));
        for target in ["gles", "wgsl"] {
            place.refused(
                &format!("--material m.toml --prefix= --target {target}"),
                &[&format!("`{name}` is a reserved word of ")],
            );
        }
        place.done(&format!("--material m.toml --target gles --out-dir {name}"));
    }
    // Neither part is a word, and both together are.
    place.put("m.toml", named("nan"));
    place.refused(
        "--material m.toml --prefix is --target gles",
        &["`isnan` is a reserved word of "],
    );
    for name in ["lpt1", "com9", "nul"] {
        place.put("m.toml", named(name));
        place.refused("--material m.toml --target gles", &["Windows"]);
    }
    place.put("m.toml", named("comb"));
    place.done("--material m.toml --target gles");
}

#[test]
fn a_path_that_no_depfile_can_spell_is_refused_before_anything_is_written() {
    let place = Place::new();
    for folder in ["a;b", "a=b", "a|b"] {
        let line = format!("--target gles --method schlick --out-dir {folder} --depfile d");
        place.refused(&line, &["--depfile: the path", "Make and Ninja"]);
    }
    place.refused(
        "--method schlick -o a;b.wgsl --depfile d",
        &["--depfile: the path"],
    );
    place.done("--target gles --method schlick --out-dir a;b");
}

/// Words and a file's name that leave comments, strings and markup of many languages.
const HOSTILE: &str = "a--->b---]]> * '''\"\"\" \u{1b}[31m ${x} {{ x }} ??.toml";
const HOSTILE_WORDS: &str =
    "--->  --- ]]> */ ''' </script> #endif {{ x }} | ` ${x} ??/ \u{fffe} \\\\";

fn put_hostile(place: &Place) {
    let text = MY_METAL.replace("An invented metal", HOSTILE_WORDS);
    place.put(
        HOSTILE,
        text.replace("Nobody, Nothing, 2020", HOSTILE_WORDS),
    );
}

#[track_caller]
fn is_xml(text: &str) {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    let read = roxmltree::Document::parse_with_options(text, options);
    assert!(read.is_ok(), "{} in {text}", read.unwrap_err());
}

/// No line goes on into the next, and nothing is obeyed by who shows it.
#[track_caller]
fn has_plain_lines(name: &str, text: &str) {
    for line in text.lines() {
        assert!(
            !line.ends_with('\\') || name.ends_with(".sh"),
            "{name}: {line}"
        );
        assert!(!line.ends_with("??/"), "{name}: {line}");
        assert!(
            line.chars().all(|c| c == '\t' || !c.is_control()),
            "{name}: {line}"
        );
    }
}

#[track_caller]
fn is_python(text: &str) {
    let parse = "import ast, sys; ast.parse(sys.argv[1])";
    let output = std::process::Command::new("python3")
        .args(["-c", parse, text])
        .output()
        .unwrap();
    Ran::new("ast.parse".to_owned(), output).ends(0);
}

/// A material for engines stays a document of its format.
#[test]
fn no_text_leaves_a_format_of_engines() {
    let place = Place::new();
    put_hostile(&place);
    for format in exchange::ALL {
        let text = place
            .run_with(&["materials", "params", HOSTILE, "--as", format.name])
            .ends(0)
            .out;
        match format.name {
            "materialx" => is_xml(&text),
            "gltf" => drop(serde_json::from_str::<serde_json::Value>(&text).unwrap()),
            "openpbr" | "unreal" => drop(text.parse::<toml::Table>().unwrap()),
            "blender" => is_python(&text),
            "filament" => assert!(
                text.lines()
                    .all(|line| line.starts_with("// ") || line.starts_with("material.")),
                "{text}"
            ),
            "usd" => {
                let head = text.lines().take_while(|line| *line != "(");
                assert!(head.into_iter().all(|line| line.starts_with('#')), "{text}");
            }
            other => panic!("{other}: what reads it?"),
        }
        has_plain_lines(format.name, &text);
    }
}

/// The same of files that hosts take as they are, of the languages, of arrays, pages and pictures.
#[test]
fn no_text_leaves_a_generated_file() {
    let place = Place::new();
    put_hostile(&place);
    for flavour in flavours::ALL {
        place
            .run_with(&["--flavour", flavour.name, "--material", HOSTILE])
            .ends(0);
    }
    place.run_with(&["--material", HOSTILE]).ends(0);
    place
        .run_with(&["bake", "--material", HOSTILE, "--format", "c,rust,js"])
        .ends(0);
    place
        .run_with(&["chart", "--material", HOSTILE, "--out-dir", "charts"])
        .ends(0);
    place
        .run_with(&["materials", "show", HOSTILE, "--svg", "sheet.svg"])
        .ends(0);
    let mut kinds = BTreeSet::new();
    for (name, (bytes, _)) in place.files() {
        let Ok(text) = std::str::from_utf8(&bytes) else {
            continue;
        };
        let ending = name.rsplit('.').next().unwrap().to_owned();
        match ending.as_str() {
            "toml" => continue,
            "mtlx" | "svg" => is_xml(text),
            "json" => drop(serde_json::from_str::<serde_json::Value>(text).unwrap()),
            "md" => {
                let first = text.lines().next().unwrap();
                assert!(first.find("-->") == Some(first.len() - 3), "{first}");
            }
            "html" => assert_eq!(
                text.matches("</script").count(),
                text.matches("<script").count(),
                "{name}"
            ),
            _ => {}
        }
        has_plain_lines(&name, text);
        kinds.insert(ending);
    }
    for ending in [
        "mtlx",
        "svg",
        "json",
        "md",
        "html",
        "js",
        "hlsl",
        "wgsl",
        "gdshaderinc",
        "h",
        "rs",
    ] {
        assert!(kinds.contains(ending), "{ending} is not among {kinds:?}");
    }
}
