//! The same bytes from every run, with any number of threads, in any folder, language and time zone.

use std::collections::BTreeMap;
use std::path::Path;

use super::MY_METAL;
use super::OUT;
use super::Place;
use super::contents;

const LINE: &str = "--target all,msl,glsl --material gold_thesis,water_thesis,my.toml";

fn place() -> Place {
    let place = Place::new();
    place.put("my.toml", MY_METAL);
    place
}

fn tree(place: &Place, set: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    let words: Vec<&str> = LINE.split(' ').collect();
    let mut command = place.command(&words);
    command.envs(set.iter().copied());
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{set:?}: {output:?}");
    contents(&place.path(OUT))
}

#[test]
fn surroundings_do_not_matter() {
    let reference = tree(&place(), &[]);
    let surroundings: &[&[(&str, &str)]] = &[
        &[],
        &[("RAYON_NUM_THREADS", "1")],
        &[("LC_ALL", "de_DE.UTF-8"), ("LANG", "de_DE.UTF-8")],
        &[("LC_ALL", "tr_TR.UTF-8"), ("TZ", "Pacific/Kiritimati")],
        &[("TZ", "America/St_Johns"), ("SOURCE_DATE_EPOCH", "1")],
        &[
            ("HOME", "/nonexistent"),
            ("USER", "nobody"),
            ("NO_COLOR", "1"),
            ("CI", "1"),
        ],
    ];
    for set in surroundings {
        assert!(tree(&place(), set) == reference, "{set:?} changed bytes");
    }
}

#[test]
fn concurrent_runs_give_the_same_bytes() {
    let trees = std::thread::scope(|scope| {
        let threads = [(); 4].map(|()| scope.spawn(|| tree(&place(), &[])));
        threads.map(|thread| thread.join().unwrap())
    });
    assert!(
        trees.iter().all(|tree| *tree == trees[0]),
        "the runs differ"
    );
}

#[test]
fn where_the_folder_lies_does_not_matter() {
    let reference = contents_below(&place(), "sub/../out/");
    let place = place();
    let absolute = place.path("deep/er/out");
    assert!(contents_below(&place, absolute.to_str().unwrap()) == reference);
}

fn contents_below(place: &Place, out_dir: &str) -> BTreeMap<String, Vec<u8>> {
    std::fs::create_dir_all(place.path("sub")).unwrap();
    place.done(&format!("{LINE} --out-dir {out_dir}"));
    contents(&place.path(out_dir))
}

#[test]
fn no_path_and_no_date_is_in_any_output() {
    let place = place();
    let temporary = std::env::temp_dir();
    let paths = [
        place.path(""),
        temporary,
        Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf(),
    ];
    let paths = paths.map(|path| path.to_str().unwrap().trim_end_matches('/').to_string());
    for (name, bytes) in tree(&place, &[]) {
        let text = String::from_utf8_lossy(&bytes);
        for path in paths.iter().filter(|path| !path.is_empty()) {
            assert!(
                !text.contains(&format!("{path}/")),
                "{name} holds the path {path}"
            );
        }
        assert!(!has_date(text.as_bytes()), "{name} holds a date");
        let lines = text.ends_with('\n') && !text.contains('\r');
        assert!(name.ends_with(".spv") || lines, "{name} has odd line ends");
    }
}

#[test]
fn a_date_would_be_found() {
    assert!(has_date(b"on 2031-02-28."));
    assert!(!has_date(b"6, 742-744 (1975)") && !has_date(b"page 2031-2-2"));
}

/// Year, month and day in digits with hyphens.
fn has_date(bytes: &[u8]) -> bool {
    let fits = |(byte, like): (&u8, char)| match like {
        '0' => byte.is_ascii_digit(),
        _ => char::from(*byte) == like,
    };
    let windows = bytes.windows("0000-00-00".len());
    let mut dates = windows.filter(|window| window.iter().zip("0000-00-00".chars()).all(fits));
    dates.next().is_some()
}
