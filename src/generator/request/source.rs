//! Reading the files that a user names.
//!
//! The materials of a request, each in its medium.
//!
//! A source read: a material of the catalogue, of a text at hand, or a medium that is a number.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::generator::command_line::path_again;
use crate::generator::error::{Error, RequestFault, unknown};
use crate::generator::output::folder::{self, is_below};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::Source;
use crate::physics::foreign::{self, one_line};
use crate::physics::materials::{self, ConstantIndex, FileFault, Material, Unseen};
use crate::physics::spectra::{TextFault, mesh_text, user_text};

/// A material file has at most this many bytes: 10⁶ rows fit.
const LARGEST: u64 = 64 << 20;

/// A file with a function of a user's has at most this many bytes.
const LARGEST_SHADER: u64 = 1 << 20;

/// A picture has at most this many bytes: 8192 x 4096 pixels of four floats fit.
const LARGEST_PICTURE: u64 = 1 << 30;

/// A mesh has at most this many bytes: three million triangles fit.
const LARGEST_MESH: u64 = 256 << 20;

/// A shard's report has at most this many bytes: 10⁵ rows fit.
const LARGEST_REPORT: u64 = 256 << 20;

/// Whether a name means a file: names of the catalogue have neither dots nor slashes.
pub fn is_path(name: &str) -> bool {
    name.contains(['.', '/', '\\'])
}

/// The words of a list with commas between. A path that exists is a path, whatever commas it holds; of two the longer one.
pub fn comma_list(list: &str) -> Vec<String> {
    let parts: Vec<&str> = list.split(',').collect();
    let is_file = |word: &String| is_path(word) && Path::new(word).is_file();
    let (mut words, mut start) = (Vec::new(), 0);
    while start < parts.len() {
        let longer = (start + 2..=parts.len()).rev();
        let found = longer
            .map(|end| (end, parts[start..end].join(",")))
            .find(|(_, word)| is_file(word));
        let (end, word) = found.unwrap_or((start + 1, parts[start].to_owned()));
        words.push(word);
        start = end;
    }
    words
}

/// Refuses a file that another file names and that lies elsewhere: what a scene, a plan or a list of materials names lies below
/// its own folder, links resolved, unless the command line names it, or a folder above it, with `--allow`.
///
/// # Errors
/// It lies elsewhere.
pub fn check_below(naming: &Path, named: &Path, allowed: &[PathBuf]) -> Result<(), String> {
    let folder = naming.parent().unwrap_or(Path::new(""));
    if is_below(folder, named) || allowed.iter().any(|one| is_below(one, named)) {
        return Ok(());
    }
    Err(format!(
        "it lies outside of the folder of `{}`; move it there, or name it, or a folder above it, with --allow",
        foreign::path(naming)
    ))
}

/// The text of a file that a user names.
///
/// # Errors
/// The file is not there, not an ordinary file, too large, or not UTF-8.
pub fn read(name: &str) -> Result<String, Error> {
    read_within(LARGEST, Path::new(name))
}

/// The text of a file at a path that a user names.
///
/// # Errors
/// The file is not there, not an ordinary file, too large, or not UTF-8.
pub fn text(path: &Path) -> Result<String, Error> {
    read_within(LARGEST, path)
}

/// The text of a file with a function of a user's.
///
/// # Errors
/// The file is not there, not an ordinary file, too large, or not UTF-8.
pub fn shader(name: &str) -> Result<String, Error> {
    read_within(LARGEST_SHADER, Path::new(name))
}

/// The text of a mesh that a user names.
///
/// # Errors
/// The file is not there, not an ordinary file, too large, or no text.
pub fn mesh(path: &Path) -> Result<String, Error> {
    mesh_text(bytes_within(LARGEST_MESH, path)?).map_err(|fault| no_text(path, fault))
}

/// The text of a shard's report.
///
/// # Errors
/// The file is not there, not an ordinary file, too large, or not UTF-8.
pub fn report(path: &Path) -> Result<String, Error> {
    read_within(LARGEST_REPORT, path)
}

/// The bytes of a picture that a user names.
///
/// # Errors
/// The file is not there, not an ordinary file, or too large.
pub fn picture(path: &Path) -> Result<Vec<u8>, Error> {
    bytes_within(LARGEST_PICTURE, path)
}

fn bytes_within(largest: u64, path: &Path) -> Result<Vec<u8>, Error> {
    let fail = |source: io::Error| Error::Input {
        path: path.to_owned(),
        source,
    };
    folder::bytes(path, largest).map_err(fail)
}

fn read_within(largest: u64, path: &Path) -> Result<String, Error> {
    user_text(bytes_within(largest, path)?).map_err(|fault| no_text(path, fault))
}

fn no_text(path: &Path, fault: TextFault) -> Error {
    Error::Material(FileFault {
        file: path.display().to_string(),
        line: fault.line,
        column: fault.column,
        what: fault.what.to_owned(),
    })
}

/// The pages below a folder, by their paths in it with `/`, sorted; links to
/// folders are not followed. A file is its own and only
/// page, whose path in itself is empty.
///
/// # Errors
/// A folder cannot be read, or the path does not exist.
pub fn pages(folder: &Path) -> Result<Vec<String>, Error> {
    if folder.is_file() {
        return Ok(vec![String::new()]);
    }
    let mut found = Vec::new();
    let mut waiting = vec![String::new()];
    while let Some(below) = waiting.pop() {
        let path = folder.join(&below);
        let fail = |source: io::Error| Error::Input {
            path: path.clone(),
            source,
        };
        for entry in fs::read_dir(&path).map_err(fail)? {
            let entry = entry.map_err(fail)?;
            let Ok(name) = entry.file_name().into_string() else {
                continue;
            };
            let kind = entry.file_type().map_err(fail)?;
            let place = if below.is_empty() {
                name.clone()
            } else {
                format!("{below}/{name}")
            };
            if kind.is_dir() {
                waiting.push(place);
            } else if is_page(&name) && !entry.path().is_dir() {
                found.push(place);
            }
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// Whether a file of the database is a page: others tell about a book, or list the shelves.
fn is_page(name: &str) -> bool {
    [".yml", ".yaml"]
        .iter()
        .any(|ending| name.ends_with(ending))
        && name != "about.yml"
        && !name.starts_with("catalog-")
        && name != "library.yml"
}

/// The materials of a request.
#[derive(Clone, Debug, Default)]
pub struct Subjects {
    /// Each in its medium, with the text of both files; sorted by name, each once.
    pub ready: Vec<(MaterialInMedium, String)>,
    /// Why some of those that `all` brings along are left out.
    pub left_out: Vec<Unseen>,
}

impl Subjects {
    /// The materials alone.
    pub fn materials(self) -> Vec<MaterialInMedium> {
        self.ready
            .into_iter()
            .map(|(material, _)| material)
            .collect()
    }

    /// A line for each material that is left out.
    pub fn left_out_lines(&self) -> Vec<String> {
        let each = self.left_out.iter();
        each.map(|unseen| format!("left out: {}", one_line(&unseen.why)))
            .collect()
    }

    pub(super) fn sorted(mut self) -> Result<Subjects, Error> {
        self.ready.sort_by(|(a, _), (b, _)| a.name.cmp(&b.name));
        let twice = |pair: &&[(MaterialInMedium, String)]| {
            pair[0].0.name == pair[1].0.name && pair[0].1 != pair[1].1
        };
        if let Some(pair) = self.ready.windows(2).find(twice) {
            let [one, other] = [0, 1].map(|i| pair[i].0.argument.as_str());
            return Err(same_name(&pair[0].0.name, [one, other]));
        }
        self.ready.dedup_by(|(a, _), (b, _)| a.name == b.name);
        match self.left_out.first() {
            Some(fault) if self.ready.is_empty() => Err(fault.clone().into()),
            _ => Ok(self),
        }
    }
}

/// Two materials of one name, and the words that name them.
pub fn same_name(name: &str, words: [&str; 2]) -> Error {
    RequestFault::SameName {
        name: name.to_owned(),
        words: words.map(str::to_owned),
    }
    .into()
}

/// A source read: the material, and what it was read from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The record.
    pub material: Material,
    /// What a user types to name it again.
    pub argument: String,
    /// Its file's text.
    pub text: String,
}

/// Reads a material from the catalogue, or from a text at hand.
///
/// # Errors
/// The catalogue has no material of this name, the number lies outside its limits, or the text is not a material.
pub fn load(source: &Source) -> Result<Loaded, Error> {
    match source {
        Source::Named(word) if ConstantIndex::parse(word).is_some() => constant(word),
        Source::Named(name) | Source::BroughtAlong(name) => {
            let found = materials::find(name).zip(materials::source(name));
            let (material, text) =
                found.ok_or_else(|| unknown("material", name, &materials::names()))?;
            Ok(Loaded {
                material: material?,
                argument: name.clone(),
                text: text.to_owned(),
            })
        }
        Source::File { file, text } => {
            let material = Material::read(file, text)?;
            Ok(Loaded {
                argument: argument(file, &material.page),
                material,
                text: text.clone(),
            })
        }
    }
}

/// A medium that is a number.
fn constant(word: &str) -> Result<Loaded, Error> {
    let index = ConstantIndex::parse(word).expect("it was found to be a number");
    let index = index.map_err(|fault| RequestFault::conflict(fault.to_string()))?;
    Ok(Loaded {
        material: index.material(),
        argument: index.to_string(),
        text: index.to_string(),
    })
}

/// What a user types to name a file again. A page at an absolute path is named by its place in the database that it lies in, since its
/// name is made of that.
fn argument(file: &str, page: &str) -> String {
    let is_absolute = Path::new(file).is_absolute();
    if is_absolute && !page.is_empty() && file.replace('\\', "/").ends_with(page) {
        page.to_owned()
    } else {
        path_again(file)
    }
}
