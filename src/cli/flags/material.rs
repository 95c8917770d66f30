//! Flags for materials and media.

use core::fmt;

use clap::Args;
use thiserror::Error;

use crate::cli::error::Error;
use crate::cli::flags::choice::Choice;
use crate::cli::flags::viewing::ColourFlags;
use crate::generator::command_line::{CommandLine, path_again};
use crate::generator::request::source::{Loaded, comma_list, is_path, load, read, same_name};
use crate::generator::request::{Materials, Source};
use crate::physics::materials::{self, ConstantIndex, FilmFault, IndexFault, film_of_word};
use crate::physics::names::UnknownName;

/// Why a word is no medium.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NoMedium {
    /// The word is no known name.
    #[error("{0}; a medium can be a refractive index from 1 to 10 too, such as 1.5")]
    Unknown(#[from] UnknownName),
    /// A number outside its limits.
    #[error(transparent)]
    Index(#[from] IndexFault),
}

/// A material of the catalogue, or the path of a material file, a page or a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialName {
    word: String,
    is_file: bool,
}

impl MaterialName {
    /// Parses a material's name.
    ///
    /// # Errors
    /// The word is no path, and the catalogue has no such material.
    pub fn parse(word: &str) -> Result<MaterialName, UnknownName> {
        let is_known = materials::source(word).is_some();
        if !is_known && !is_path(word) {
            return Err(UnknownName::new("material", word, &materials::known()));
        }
        Ok(MaterialName {
            word: word.to_owned(),
            is_file: !is_known,
        })
    }

    /// Parses a medium: a material's name, or a number.
    ///
    /// # Errors
    /// The word is no path, no material of the catalogue, and no refractive index within limits.
    pub fn parse_medium(word: &str) -> Result<MaterialName, NoMedium> {
        match ConstantIndex::parse(word) {
            Some(index) => Ok(MaterialName {
                word: index?.to_string(),
                is_file: false,
            }),
            None => Ok(MaterialName::parse(word)?),
        }
    }

    /// The path, if the material is a file.
    pub fn path(&self) -> Option<&str> {
        self.is_file.then_some(&self.word)
    }

    /// The material's source, read if it is a file.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn source(&self) -> Result<Source, Error> {
        let word = self.word.clone();
        Ok(if self.is_file {
            Source::File {
                text: read(&word)?,
                file: word,
            }
        } else {
            Source::Named(word)
        })
    }
}

/// The name or path as a user would type it again.
impl fmt::Display for MaterialName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.is_file {
            f.write_str(&path_again(&self.word))
        } else {
            f.write_str(&self.word)
        }
    }
}

/// Materials, as one word lists them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialList(Vec<Choice<MaterialName>>);

/// Parses a word of `--material`.
fn material_list(list: &str) -> Result<MaterialList, UnknownName> {
    let choice = |word: String| {
        Ok(match word.as_str() {
            "all" => Choice::All,
            "none" => Choice::None,
            name => {
                let named = MaterialName::parse(name)?;
                Choice::One(named.to_string(), named)
            }
        })
    };
    let choices = comma_list(list).into_iter().map(choice);
    choices.collect::<Result<_, _>>().map(MaterialList)
}

/// Which materials.
#[derive(Args, Clone, Debug, Default)]
pub struct MaterialFlags {
    /// Names, paths of material files, all, or none [default: gold, platinum, water, diamond]
    #[arg(long, value_name = "NAME", value_parser = material_list)]
    pub material: Vec<MaterialList>,
    /// A film on each of these materials: its material or index, and its thickness; once for each film, the outermost first
    #[arg(long, value_name = "MATERIAL:THICKNESS", value_parser = FilmName::parse, requires = "material")]
    pub film: Vec<FilmName>,
}

/// The films on one material.
#[derive(Args, Clone, Debug, Default)]
pub struct FilmFlags {
    /// A film on the material: its material or index, and its thickness, such as titanium_dioxide:60nm; once for each film, the outermost first
    #[arg(long, value_name = "MATERIAL:THICKNESS", value_parser = FilmName::parse)]
    pub film: Vec<FilmName>,
}

impl FilmFlags {
    /// A material under these films.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn on(&self, material: Source) -> Result<Source, Error> {
        Ok(material.under_films(film_sources(&self.film)?))
    }

    /// The paths among them.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.film.iter().filter_map(|film| film.name.path())
    }
}

fn film_sources(films: &[FilmName]) -> Result<Vec<(Source, f64)>, Error> {
    let source = |film: &FilmName| Ok((film.name.source()?, film.thickness_nm));
    films.iter().map(source).collect()
}

/// A film: a material or an index, and a thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmName {
    name: MaterialName,
    thickness_nm: f64,
}

/// Why a word is no film.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NoFilm {
    /// It is not of a material and a thickness.
    #[error(transparent)]
    Word(#[from] FilmFault),
    /// There is no such material.
    #[error("{0}; a film can be a refractive index from 1 to 10 too, such as 1.38:100nm")]
    Unknown(UnknownName),
    /// A number outside its limits.
    #[error(transparent)]
    Index(IndexFault),
}

impl FilmName {
    /// Parses a film.
    ///
    /// # Errors
    /// The word is no material and thickness.
    pub fn parse(word: &str) -> Result<FilmName, NoFilm> {
        let (name, thickness_nm) = film_of_word(word)?;
        let name = MaterialName::parse_medium(name).map_err(|fault| match fault {
            NoMedium::Unknown(unknown) => NoFilm::Unknown(unknown),
            NoMedium::Index(fault) => NoFilm::Index(fault),
        })?;
        Ok(FilmName { name, thickness_nm })
    }
}

/// The film as a user would type it again.
impl fmt::Display for FilmName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}nm", self.name, self.thickness_nm)
    }
}

impl MaterialFlags {
    /// The words of all lists.
    pub fn choices(&self) -> impl Iterator<Item = &Choice<MaterialName>> {
        self.material.iter().flat_map(|list| &list.0)
    }

    /// The same, with the whole catalogue where none is named. `none` is refused in these words.
    ///
    /// # Errors
    /// As for [`MaterialFlags::materials`], and `none`.
    pub fn materials_or_all(&self, why_some: &str) -> Result<Materials, Error> {
        match self.materials()? {
            Materials::Default => Ok(Materials::All),
            Materials::None => Err(Error::usage(why_some)),
            named => Ok(named),
        }
    }

    /// The materials, read if they are files.
    ///
    /// # Errors
    /// `none` stands beside another name, or a file cannot be read.
    pub fn materials(&self) -> Result<Materials, Error> {
        if self.material.is_empty() {
            return Ok(Materials::Default);
        }
        let choices: Vec<Choice<MaterialName>> = self.choices().cloned().collect();
        if Choice::is_none(&choices, "materials")? {
            if !self.film.is_empty() {
                let why = "--film lies on a material, and `--material none` leaves none";
                return Err(Error::usage(why));
            }
            return Ok(Materials::None);
        }
        let mut sources = Vec::new();
        for choice in &choices {
            match choice {
                Choice::One(_, name) => sources.push(name.source()?),
                Choice::All | Choice::None => sources.extend(Source::catalogue()),
            }
        }
        let films = film_sources(&self.film)?;
        let under = |source: Source| source.under_films(films.clone());
        Ok(Materials::These(sources.into_iter().map(under).collect()))
    }

    /// The paths among them.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        let names = self.choices().filter_map(Choice::named);
        let films = self.film.iter().map(|film| &film.name);
        names.chain(films).filter_map(MaterialName::path)
    }
}

/// What the light comes from.
#[derive(Args, Clone, Debug, Default)]
pub struct MediumFlags {
    /// Medium on the incident side: name or file of a transparent material, or a refractive index from 1 to 10, such as 1.5 [default: air]
    #[arg(long, value_name = "NAME", value_parser = MaterialName::parse_medium, allow_negative_numbers = true)]
    pub medium: Option<MaterialName>,
}

impl MediumFlags {
    /// The medium, read if it is a file; `None` for air.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn source(&self) -> Result<Option<Source>, Error> {
        self.medium.as_ref().map(MaterialName::source).transpose()
    }

    /// The path, if the medium is a file.
    pub fn path(&self) -> Option<&str> {
        self.medium.as_ref().and_then(MaterialName::path)
    }
}

/// Several materials, and how they are looked at.
#[derive(Args, Debug)]
pub struct SeveralFlags {
    /// Names, or paths of material files, pages or tables
    #[arg(required = true, value_name = "NAME", value_parser = MaterialName::parse)]
    pub names: Vec<MaterialName>,
    /// The films on each of them.
    #[command(flatten)]
    pub films: FilmFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// The way to three channels.
    #[command(flatten)]
    pub colour: ColourFlags,
}

impl SeveralFlags {
    /// The materials under their films, each once.
    ///
    /// # Errors
    /// A file cannot be read or is no material, or two materials have one name.
    pub fn loaded(&self) -> Result<Vec<Loaded>, Error> {
        let mut all: Vec<Loaded> = Vec::new();
        for name in &self.names {
            let one = load(&self.films.on(name.source()?)?)?;
            let same = all
                .iter()
                .find(|other| other.material.name == one.material.name);
            match same {
                None => all.push(one),
                Some(other) if other.text == one.text => {}
                Some(other) => {
                    let words = [other.argument.as_str(), one.argument.as_str()];
                    return Err(same_name(&one.material.name, words).into());
                }
            }
        }
        Ok(all)
    }

    /// The command of these words with the materials, their films and their medium.
    pub fn command(
        &self,
        words: &str,
        materials: &[Loaded],
        medium: Option<&Loaded>,
    ) -> CommandLine {
        let command = CommandLine::new(words);
        let command = materials
            .iter()
            .fold(command, |command, one| command.argument(&one.argument));
        command
            .each("film", &self.films.film)
            .list("medium", medium.map(|medium| &medium.argument))
    }

    /// The paths among them.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        let names = self.names.iter().filter_map(MaterialName::path);
        names
            .chain(self.films.paths())
            .chain(self.medium.path())
            .chain(self.colour.path())
    }
}
