//! Reads the files that a user names, and the materials of a request, each in its medium.
//!
//! A source is a material of the catalogue, a text already read, or a medium that is a number.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::generator::command_line::path_again;
use crate::generator::error::{Error, RequestFault, unknown};
use crate::generator::output::folder::{self, is_below};
use crate::generator::reference::MaterialInMedium;
use crate::physics::foreign::{self, one_line};
use crate::physics::materials::{self, ConstantIndex, Film, Material, SurfaceError};
use crate::physics::user_text::{FileFault, TextFault, mesh_text, user_text};

/// The largest material file in bytes: 10⁶ rows fit.
const LARGEST: u64 = 64 << 20;

/// The largest file with a user's own function, in bytes.
const LARGEST_SHADER: u64 = 1 << 20;

/// The largest picture in bytes: 8192 x 4096 pixels of four floats fit.
const LARGEST_PICTURE: u64 = 1 << 30;

/// The largest mesh in bytes: three million triangles fit.
const LARGEST_MESH: u64 = 256 << 20;

/// The largest report of a shard in bytes: 10⁵ rows fit.
const LARGEST_REPORT: u64 = 256 << 20;

/// Whether a name is a path: names of the catalogue have neither dots nor slashes.
pub fn is_path(name: &str) -> bool {
    name.contains(['.', '/', '\\'])
}

/// The words of a comma-separated list. The path of an existing file is kept whole, whatever commas it holds. Of two such paths,
/// the longer one is taken.
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

/// Refuses a file that another file names and that lies elsewhere. What a scene, a plan or a list of materials names must lie
/// below its own folder, with links resolved, unless the command line allows that file, or a folder above it, with `--allow`.
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
/// The file is missing, not an ordinary file, too large, or not UTF-8.
pub fn read(name: &str) -> Result<String, Error> {
    read_within(LARGEST, Path::new(name))
}

/// The text of a file at a path that a user names.
///
/// # Errors
/// The file is missing, not an ordinary file, too large, or not UTF-8.
pub fn text(path: &Path) -> Result<String, Error> {
    read_within(LARGEST, path)
}

/// The text of a file with a user's own function.
///
/// # Errors
/// The file is missing, not an ordinary file, too large, or not UTF-8.
pub fn shader(name: &str) -> Result<String, Error> {
    read_within(LARGEST_SHADER, Path::new(name))
}

/// The text of a mesh that a user names.
///
/// # Errors
/// The file is missing, not an ordinary file, too large, or not text.
pub fn mesh(path: &Path) -> Result<String, Error> {
    mesh_text(bytes_within(LARGEST_MESH, path)?).map_err(|fault| no_text(path, fault))
}

/// The text of a shard's report.
///
/// # Errors
/// The file is missing, not an ordinary file, too large, or not UTF-8.
pub fn report(path: &Path) -> Result<String, Error> {
    read_within(LARGEST_REPORT, path)
}

/// The bytes of a picture that a user names.
///
/// # Errors
/// The file is missing, not an ordinary file, or too large.
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

/// The pages below a folder, by their paths in it with `/`, sorted. Links to folders are not followed. A file is its own only
/// page, with an empty path.
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

/// Whether a file of the database is a page. Other files describe a book, or list the shelves.
fn is_page(name: &str) -> bool {
    [".yml", ".yaml"]
        .iter()
        .any(|ending| name.ends_with(ending))
        && name != "about.yml"
        && !name.starts_with("catalog-")
        && name != "library.yml"
}

/// The source of a material.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A material of the catalogue. A medium can also be a refractive index from 1 to 10, such as `1.5`, without absorption and
    /// dispersion.
    Named(String),
    /// A material of the catalogue that `all` includes. It is left out where it is not known over the whole spectrum.
    BroughtAlong(String),
    /// A user's file, already read.
    File {
        /// Its name, for messages and for the command in headers.
        file: String,
        /// Its text.
        text: String,
    },
    /// A material under films.
    UnderFilms {
        /// What lies below.
        base: Box<Source>,
        /// Each film and its thickness in nanometres, outermost first. A film can be an index, as a medium can.
        films: Vec<(Source, f64)>,
    },
}

impl Source {
    /// This material under films, outermost first; itself where there are none.
    pub fn under_films(self, films: Vec<(Source, f64)>) -> Source {
        if films.is_empty() {
            return self;
        }
        let base = Box::new(self);
        Source::UnderFilms { base, films }
    }

    /// What lies below its films; itself where there are none.
    pub(in crate::generator) fn base(&self) -> &Source {
        match self {
            Source::UnderFilms { base, .. } => base.base(),
            bare => bare,
        }
    }

    /// Whether `all` includes it.
    pub fn is_brought_along(&self) -> bool {
        matches!(self.base(), Source::BroughtAlong(_))
    }

    /// The files that it was read from.
    pub fn files(&self) -> Vec<&str> {
        match self {
            Source::File { file, .. } => vec![file],
            Source::UnderFilms { base, films } => {
                let below = films.iter().flat_map(|(film, _)| film.files());
                base.files().into_iter().chain(below).collect()
            }
            Source::Named(_) | Source::BroughtAlong(_) => Vec::new(),
        }
    }

    /// The argument that names it again on the command line.
    ///
    /// # Errors
    /// As [`load`].
    #[doc(hidden)]
    pub fn argument(&self) -> Result<String, Error> {
        Ok(load(self)?.argument)
    }

    /// All materials of the catalogue.
    #[doc(hidden)]
    pub fn catalogue() -> impl Iterator<Item = Source> {
        materials::names()
            .into_iter()
            .map(|name| Source::BroughtAlong(name.to_owned()))
    }
}

/// The materials of a request.
#[derive(Clone, Debug, Default)]
pub struct Subjects {
    /// Each material in its medium, with the text of both files; sorted by name, each once.
    pub ready: Vec<(MaterialInMedium, String)>,
    /// Why some of the materials that `all` includes are left out.
    pub left_out: Vec<SurfaceError>,
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

/// The error for two materials with one name, and the words that name them.
pub fn same_name(name: &str, words: [&str; 2]) -> Error {
    RequestFault::SameName {
        name: name.to_owned(),
        words: words.map(str::to_owned),
    }
    .into()
}

/// A material, and what it was read from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The record.
    pub material: Material,
    /// The argument that names it again on the command line.
    pub argument: String,
    /// Its file's text.
    pub text: String,
}

/// Reads a material from the catalogue, or from a text already read.
///
/// # Errors
/// The catalogue has no material of this name, the number lies outside its limits, or the text is not a material.
pub fn load(source: &Source) -> Result<Loaded, Error> {
    match source {
        Source::Named(word) if ConstantIndex::parse(word).is_some() => constant(word),
        Source::Named(name) | Source::BroughtAlong(name) => {
            let found = materials::find(name).zip(materials::source(name));
            let (material, text) =
                found.ok_or_else(|| unknown("material", name, &materials::known()))?;
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
        Source::UnderFilms { base, films } => {
            let mut loaded = load(base)?;
            let mut on_it = Vec::new();
            for (source, thickness_nm) in films {
                let film = load(source)?;
                check_is_bare(&film.material, "film")?;
                let argument = format!("{}:{thickness_nm}nm", film.argument);
                loaded.text = format!("{}\n{argument}\n{}", loaded.text, film.text);
                on_it.push(Film {
                    material: film.material,
                    thickness_nm: *thickness_nm,
                    argument,
                });
            }
            let under = loaded.material.under_films(on_it);
            loaded.material = under.map_err(RequestFault::refused)?;
            Ok(loaded)
        }
    }
}

/// Refuses a film or a medium that is itself a material under films.
pub(super) fn check_is_bare(material: &Material, wanted: &'static str) -> Result<(), Error> {
    if material.films.is_empty() {
        return Ok(());
    }
    Err(RequestFault::refused(format!(
        "`{}` has films, so it is no {wanted}; name the material of one layer",
        material.name
    ))
    .into())
}

/// A medium that is a number.
fn constant(word: &str) -> Result<Loaded, Error> {
    let index = ConstantIndex::parse(word).expect("it was found to be a number");
    let index = index.map_err(|fault| RequestFault::refused(fault.to_string()))?;
    Ok(Loaded {
        material: index.material(),
        argument: index.to_string(),
        text: index.to_string(),
    })
}

/// The argument that names a file again. A page at an absolute path is named by its place in its database, since its name is made
/// of that.
fn argument(file: &str, page: &str) -> String {
    let is_absolute = Path::new(file).is_absolute();
    if is_absolute && !page.is_empty() && file.replace('\\', "/").ends_with(page) {
        page.to_owned()
    } else {
        path_again(file)
    }
}
