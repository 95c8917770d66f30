//! The program killed at any moment: each file is old or new, and the next run repairs.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;

use super::OUT;
use super::Place;
use super::contents;
use fresnel_gen::generator::output::{folder, lock, manifest};

const KILLS: usize = 24;

/// Two editions of a tree, which replace each other: other names, other bytes.
const LINES: [&str; 2] = [
    "--target all,msl,glsl",
    "--target all,msl,glsl --prefix brdf_ --matching-angle 84",
];

/// How the names of their files begin.
const PREFIXES: [&str; 2] = ["fresnel_", "brdf_"];

#[test]
fn a_killed_run_leaves_each_file_old_or_new() {
    let whole = LINES.map(|line| {
        let place = Place::new();
        place.done(line);
        contents(&place.path(OUT))
    });
    let place = Place::new();
    place.done(LINES[0]);
    let (mut seed, mut leftovers, mut mixed) = (41_u64, 0, 0);
    for turn in 0..KILLS {
        let new = (turn + 1) % 2;
        let words: Vec<&str> = LINES[new].split(' ').collect();
        let mut child = place.command(&words).stderr(Stdio::null()).spawn().unwrap();
        let (sign, longest): (&dyn Fn(&str) -> bool, u64) = match turn / 2 % 2 {
            0 => (&folder::is_temporary, 12_000),
            _ => (&|name| name.starts_with(PREFIXES[new]), 3_000),
        };
        wait(&mut child, &place.path(OUT), sign);
        // Knuth's MMIX generator: the delays are arbitrary, and the same in every run.
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        std::thread::sleep(Duration::from_micros((seed >> 33) % longest));
        child.kill().unwrap();
        child.wait().unwrap();
        let (temporary, counts) = sorted(&contents(&place.path(OUT)), &whole);
        leftovers += temporary;
        mixed += usize::from(counts.iter().all(|count| *count > 0));
        place.done(LINES[new]);
        assert!(
            contents(&place.path(OUT)) == whole[new],
            "the next run did not end the work of the killed one"
        );
    }
    eprintln!(
        "{KILLS} kills with seed 41: {mixed} left a mixed tree, {leftovers} temporary files stayed behind"
    );
}

/// Until the run prepares files, or puts the first one in its place, or has ended: what comes before touches nothing.
fn wait(child: &mut Child, out: &Path, sign: &dyn Fn(&str) -> bool) {
    let is_seen = || {
        let files = std::fs::read_dir(out.join("gles")).unwrap().flatten();
        let mut names = files.map(|file| file.file_name().to_string_lossy().into_owned());
        names.any(|name| sign(&name))
    };
    while child.try_wait().unwrap().is_none() && !is_seen() {
        std::thread::yield_now();
    }
}

/// How many temporary files there are, and how many files of the old edition only and of the new edition only.
#[track_caller]
fn sorted(
    found: &BTreeMap<String, Vec<u8>>,
    whole: &[BTreeMap<String, Vec<u8>>; 2],
) -> (usize, [usize; 2]) {
    let (mut temporary, mut counts) = (0, [0, 0]);
    for (path, bytes) in found {
        // While a run writes, the manifest lists both editions.
        if path == lock::FILE || path == manifest::FILE {
            continue;
        }
        let of = [0, 1].map(|edition: usize| whole[edition].get(path) == Some(bytes));
        match of {
            _ if folder::is_temporary(path) => temporary += 1,
            [true, false] => counts[0] += 1,
            [false, true] => counts[1] += 1,
            [true, true] => {}
            [false, false] => panic!("{path} is neither old nor new"),
        }
    }
    (temporary, counts)
}
