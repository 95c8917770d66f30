//! Every picture that the program draws shows a fact that a physicist knows, on the right side of its axis.
//!
//! A fact is measured in the picture: in the pixels of a PNG, in the paths and labels of an SVG, in the texels of a table. Places
//! on an axis are read from its labels, as a person reads them. A picture without a fact fails.

mod baked;
mod chart;
mod comparison;
mod engines;
mod headline;
mod map;
mod plan;
pub mod reader;
mod renders;
mod scene_error;
mod sheet;
mod thesis;

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Command, CommandFactory};

use fresnel_gen::cli::Cli;

/// What a picture must show.
struct Fact {
    /// The pictures: their path, where `*` stands for anything.
    pictures: &'static str,
    /// The fact in words.
    says: &'static str,
    /// Panics where the picture does not show it.
    holds: fn(&PictureFile),
}

/// A picture's file.
struct PictureFile {
    folder: PathBuf,
    file: String,
}

static FACTS: [&[Fact]; 10] = [
    baked::FACTS,
    chart::FACTS,
    comparison::FACTS,
    engines::FACTS,
    headline::FACTS,
    map::FACTS,
    renders::FACTS,
    scene_error::FACTS,
    sheet::FACTS,
    thesis::FACTS,
];

/// What pictures are kept in. Arrays for C, Rust and JavaScript are held to the bit by the test `lut`.
const ENDINGS: [&str; 5] = ["svg", "png", "html", "exr", "ktx2"];

impl PictureFile {
    fn bytes(&self) -> Vec<u8> {
        self.beside(&self.file)
            .unwrap_or_else(|| panic!("{} is not there", self.file))
    }

    fn text(&self) -> String {
        String::from_utf8(self.bytes()).unwrap()
    }

    /// Another file of the same run.
    fn beside(&self, file: &str) -> Option<Vec<u8>> {
        fs::read(self.folder.join(file)).ok()
    }

    /// The same path with another ending.
    fn ending(&self, ending: &str) -> String {
        let path = Path::new(&self.file).with_extension(ending);
        path.to_str().unwrap().to_owned()
    }

    /// The file's name without folder and ending.
    fn name(&self) -> &str {
        Path::new(&self.file).file_stem().unwrap().to_str().unwrap()
    }
}

/// Whether a path is as a pattern says.
fn matches(pattern: &str, path: &str) -> bool {
    let Some((before, after)) = pattern.split_once('*') else {
        return pattern == path;
    };
    let Some(rest) = path.strip_prefix(before) else {
        return false;
    };
    (0..=rest.len())
        .filter(|at| rest.is_char_boundary(*at))
        .any(|at| matches(after, &rest[at..]))
}

/// The pictures below a folder, by their paths in it.
fn pictures(folder: &Path, below: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder.join(below)).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let path = match below {
            "" => name,
            below => format!("{below}/{name}"),
        };
        if folder.join(&path).is_dir() {
            found.extend(pictures(folder, &path));
        } else if ENDINGS
            .iter()
            .any(|ending| path.ends_with(&format!(".{ending}")))
        {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Holds each of these pictures to its facts.
#[track_caller]
fn check(folder: &Path, files: &[String]) {
    assert!(!files.is_empty(), "nothing was drawn");
    for file in files {
        let shown = PictureFile {
            folder: folder.to_owned(),
            file: file.clone(),
        };
        let all = FACTS.iter().flat_map(|facts| facts.iter());
        let own: Vec<&Fact> = all.filter(|fact| matches(fact.pictures, file)).collect();
        assert!(
            !own.is_empty(),
            "{file} has no fact: say in tests/it/pictures what a physicist must see there"
        );
        for fact in own {
            let held = std::panic::catch_unwind(|| (fact.holds)(&shown));
            assert!(held.is_ok(), "{file} does not show that {}", fact.says);
        }
    }
}

/// Holds all pictures in a folder to their facts.
#[track_caller]
fn check_all(folder: &Path) -> Vec<String> {
    let files = pictures(folder, "");
    check(folder, &files);
    files
}

/// What documents show is looked at as it lies there.
#[test]
fn committed_pictures_show_what_a_physicist_knows() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for folder in ["docs", "data/figures", "shaders-generated/lut"] {
        check(root, &pictures(root, folder));
    }
}

/// Which commands have a flag that takes a picture or a folder, and what draws them here.
const DRAW: [(&str, &str); 15] = [
    ("", "tables, as `bake` has them: shaders-generated/lut"),
    (
        "audit",
        "chart::a_users_function_stands_at_its_own_error_and_cost",
    ),
    (
        "bake",
        "baked::tables_hold_reflectance_from_grazing_to_normal",
    ),
    (
        "chart",
        "chart::every_function_stands_at_its_error_and_cost",
    ),
    (
        "clean",
        "nothing: it removes what a folder's manifest lists",
    ),
    ("cost", "chart::bars_are_as_long_as_what_they_stand_for"),
    (
        "gallery",
        "a page without a picture of its own: the test `gallery`",
    ),
    ("generate", "what the program does alone: tables"),
    (
        "materials compare",
        "comparison::measurements_stand_beside_each_other",
    ),
    (
        "materials show",
        "sheet::sheets_show_what_is_known_of_materials",
    ),
    (
        "plan",
        "plan::gold_is_yellow_and_differs_nowhere_in_the_middle",
    ),
    (
        "reproduce",
        "thesis::figures_show_the_law_and_what_misses_it",
    ),
    (
        "scene-error",
        "scene_error::a_sphere_shows_where_schlick_errs",
    ),
    (
        "stability",
        "map::maps_show_total_reflection_beyond_the_critical_angle",
    ),
    ("verify", "nothing: it reads the folder"),
];

#[test]
fn every_command_that_draws_is_held_to_facts() {
    fn drawing(command: &Command, path: &str) -> Vec<String> {
        let flags = ["out_dir", "svg", "png"];
        let draws = command
            .get_arguments()
            .any(|flag| flags.contains(&flag.get_id().as_str()));
        let mut found: Vec<String> = draws.then(|| path.to_owned()).into_iter().collect();
        for below in command.get_subcommands() {
            let path = format!("{path} {}", below.get_name());
            found.extend(drawing(below, path.trim()));
        }
        found
    }
    let mut found = drawing(&Cli::command(), "");
    found.sort();
    assert_eq!(found, DRAW.map(|(command, _)| command));
}
