//! `--material`: files of the user's, good and bad, and the words `all` and `none`.

use std::fs::File;

use super::MY_METAL;
use super::OUT;
use super::Place;
use fresnel_gen::physics::materials;

#[test]
fn a_users_file_becomes_functions_named_after_it() {
    let place = Place::new();
    place.put("data/my.toml", MY_METAL);
    let absolute = place.path("data/my.toml");
    for (name, again) in [
        ("data/my.toml", "data/my.toml"),
        ("./data/my.toml", "data/my.toml"),
        (absolute.to_str().unwrap(), "my.toml"),
    ] {
        place.done(&format!("--target hlsl --material {name}"));
        let text = place.read(&format!("{OUT}/hlsl/materials/my_metal.hlsl"));
        assert!(
            text.contains("float3 fresnel_my_metal(float cos_theta)"),
            "{text}"
        );
        assert!(text.contains("Nobody, Nothing, 2020"), "{text}");
        // The folders of this machine would make the bytes differ between machines.
        assert!(
            text.contains(&format!("--target hlsl --material {again}\n")),
            "{text}"
        );
        let inputs = place.manifest()["inputs"].to_string();
        assert!(
            inputs.contains("my_metal") && !inputs.contains("data"),
            "{inputs}"
        );
    }
}

/// Materials of the catalogue that are known over the whole spectrum, or at three wavelengths: `all` leaves out the others.
fn known_where_seen() -> usize {
    let find = |name: &&'static str| materials::find(name)?.ok();
    let names = materials::names();
    let known = names.iter().filter_map(find);
    known
        .filter(|material| material.rgb_nm.is_some() || material.covers(380.0, 780.0))
        .count()
}

#[test]
fn all_and_none() {
    let place = Place::new();
    let written = |line: &str| {
        let ran = place.done(&format!("--list --target gles {line}"));
        ran.out
            .lines()
            .filter(|path| path.contains("/materials/"))
            .count()
    };
    assert_eq!(written("--material none"), 0);
    assert_eq!(written("--material all"), known_where_seen());
    assert_eq!(written(""), 4);
    assert_eq!(
        written("--material gold_thesis --material gold_thesis,water_thesis"),
        2
    );
    assert_eq!(written("--method schlick"), 0);
}

/// Spoiled material files: what is replaced in a good one, by what, and what the program says of it.
#[rustfmt::skip]
const FAULTS: &[(&str, &str, &str)] = &[
    ("licence = \"CC0-1.0\"\n", "", "my.toml:1:1: missing field `licence`"),
    ("0.23", "-0.23", "my.toml:9:9: field `data`: n is -0.23; it must lie between"),
    ("1.72", "-1.72", "my.toml:8:15: field `data`: k is -1.72"),
    ("3.94", "nan", "my.toml:9:15: field `data`: k is NaN"),
    ("1.39", "inf", "my.toml:8:9: field `data`: n is inf"),
    ("780", "-780", "my.toml:9:4: field `data`: wavelength_nm is -780"),
    ("780", "380", "my.toml:9:3: field `data`: 380 nm after 380 nm; wavelengths must ascend"),
    ("1.39, ", "", "my.toml:8:"),
    ("[380", "[\"380\"", "my.toml:8:4: "),
    ("link", "lnik", "my.toml:6:1: unknown field `lnik`"),
    ("link", "lnik", "did you mean `link`?"),
    ("link", "name", "my.toml:6:1: "),
    ("\"metal\"", "\"metall\"", "my.toml:3:9: "),
    ("my_metal", "My Metal", "my.toml:1:8: field `name`"),
    ("my_metal", "Gold", "my.toml:1:8: field `name`: `Gold` is no name: capital letters"),
    ("my_metal", "../../etc", "my.toml:1:8: field `name`"),
    ("An invented metal", " ", "my.toml:2:11: field `summary` is empty"),
    ("  [380, 1.39, 1.72],\n  [780, 0.23, 3.94],\n", "", "my.toml:7:8: field `data` is empty"),
    ("],\n]", "", "my.toml:"),
    ("780", "600", "material `my_metal`: n is known from 380 to 600 nm, and 605 nm is wanted"),
    ("my_metal", "schlick", "has the name of a method's function"),
    ("my_metal", "schlick_scalar", "has the name of a method's function"),
    (MY_METAL, "", "my.toml:1:1: missing fields `name`, `summary`, `class`, `licence`"),
    (MY_METAL, "\0", "my.toml:1:"),
    (MY_METAL, "{}", "my.toml:1:"),
];

#[test]
fn a_fault_is_named_with_its_place_and_field() {
    let place = Place::new();
    for (from, to, says) in FAULTS {
        assert!(MY_METAL.contains(from), "{from}");
        place.put("my.toml", MY_METAL.replacen(from, to, 1));
        place.refused("--material my.toml", &[says]);
        place.refused("--material my.toml -o - --target gles", &[says]);
    }
}

#[test]
fn a_file_that_is_not_text_or_too_large_is_refused() {
    let place = Place::new();
    let mut bytes = MY_METAL.as_bytes().to_vec();
    bytes[MY_METAL.find("vented").unwrap()] = 0xff;
    place.put("my.toml", bytes);
    place.refused(
        "--material my.toml",
        &["my.toml:2:17: the file is not UTF-8 text"],
    );
    let large = File::create(place.path("large.toml")).unwrap();
    large.set_len(65 << 20).unwrap();
    place.refused(
        "--material large.toml",
        &["cannot read large.toml", "at most"],
    );
}

#[test]
fn what_is_no_file_is_refused() {
    let place = Place::new();
    std::fs::create_dir(place.path("folder.toml")).unwrap();
    for (name, says) in [
        ("nofile.toml", "cannot read nofile.toml: No such file"),
        ("./gold_thesis", "cannot read ./gold_thesis: No such file"),
        (
            "folder.toml",
            "cannot read folder.toml: it is not an ordinary file",
        ),
        (".", "cannot read .: it is not an ordinary file"),
        ("nofolder/my.toml", "cannot read nofolder/my.toml"),
    ] {
        place.refused(&format!("--material {name}"), &[says]);
        place.refused(&format!("--material gold_thesis --medium {name}"), &[says]);
        place.refused(&format!("materials show {name}"), &[says]);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_does_not_make_it_wait() {
    let place = Place::new();
    let made = std::process::Command::new("mkfifo")
        .arg(place.path("p.toml"))
        .status();
    assert!(made.unwrap().success());
    let mut child = place
        .command(&["--material", "p.toml"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // Ten seconds in all, on a machine however slow.
    let mut ended = (0..1000).filter_map(|_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        child.try_wait().unwrap()
    });
    let status = ended.next();
    drop(ended);
    child.kill().unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(status.and_then(|status| status.code()), Some(2));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(
        errors.contains("p.toml: it is not an ordinary file"),
        "{errors}"
    );
}

/// A file that says it is ordinary and empty, and has no end or gives nothing.
#[cfg(target_os = "linux")]
#[test]
fn a_file_without_an_end_does_not_make_it_wait() {
    let place = Place::new();
    for file in ["/proc/kmsg", "/proc/kpagecount", "/dev/zero"] {
        for command in ["materials import", "materials show", "--material"] {
            place.refused(&format!("{command} {file}"), &[]);
        }
    }
}

#[test]
fn two_materials_of_one_name_are_refused() {
    let place = Place::new();
    place.put("a.toml", MY_METAL);
    place.put("b.toml", MY_METAL.replace("3.94", "3.95"));
    place.refused(
        "--material a.toml,b.toml",
        &["two different materials are named `my_metal`"],
    );
    place.put("c.toml", MY_METAL);
    place.done("--material a.toml,c.toml --list");
}
