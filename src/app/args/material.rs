//! Materials and media, as the command line names them.

use core::fmt;

use clap::Args;

use crate::app::error::Error;
use crate::app::request::{Materials, Source};
use crate::app::source::{is_path, read};
use crate::materials;
use crate::names::UnknownName;

use super::choice::Choice;

/// A material of the catalogue, or the path of a material file, a page or a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialName {
    word: String,
    is_file: bool,
}

impl MaterialName {
    /// The parser of a material's name.
    ///
    /// # Errors
    /// It is no path, and the catalogue has no such material.
    pub fn parse(word: &str) -> Result<MaterialName, UnknownName> {
        let is_known = materials::source(word).is_some();
        if !is_known && !is_path(word) {
            return Err(UnknownName::new("material", word, &materials::names()));
        }
        Ok(MaterialName {
            word: word.to_owned(),
            is_file: !is_known,
        })
    }

    /// The path, of a file.
    pub fn path(&self) -> Option<&str> {
        self.is_file.then_some(&self.word)
    }

    /// The material's source, read where it is a file.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn source(&self) -> Result<Source, Error> {
        let word = self.word.clone();
        Ok(match self.is_file {
            false => Source::Named(word),
            true => Source::File {
                text: read(&word)?,
                file: word,
            },
        })
    }
}

impl fmt::Display for MaterialName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.word)
    }
}

/// The parser of a word of `--material`.
fn choice(word: &str) -> Result<Choice<MaterialName>, UnknownName> {
    Ok(match word {
        "all" => Choice::All,
        "none" => Choice::None,
        name => Choice::One(name.to_owned(), MaterialName::parse(name)?),
    })
}

/// Which materials.
#[derive(Args, Clone, Debug, Default)]
pub struct MaterialFlags {
    /// Names, paths of material files, all, or none [default: gold, platinum, water, diamond]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = choice)]
    pub material: Vec<Choice<MaterialName>>,
}

impl MaterialFlags {
    /// The materials, read where they are files.
    ///
    /// # Errors
    /// `none` stands beside another name, or a file cannot be read.
    pub fn materials(&self) -> Result<Materials, Error> {
        if self.material.is_empty() {
            return Ok(Materials::Default);
        }
        if Choice::is_none(&self.material, "materials")? {
            return Ok(Materials::None);
        }
        let mut sources = Vec::new();
        for choice in &self.material {
            match choice {
                Choice::One(_, name) => sources.push(name.source()?),
                Choice::All | Choice::None => sources.extend(Source::catalogue()),
            }
        }
        Ok(Materials::These(sources))
    }

    /// The paths among them.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        let names = self.material.iter().filter_map(Choice::named);
        names.filter_map(MaterialName::path)
    }
}

/// What the light comes from.
#[derive(Args, Clone, Debug, Default)]
pub struct MediumFlags {
    /// Medium on the incident side: name or file of a transparent material [default: air]
    #[arg(long, value_name = "NAME", value_parser = MaterialName::parse)]
    pub medium: Option<MaterialName>,
}

impl MediumFlags {
    /// The medium, read where it is a file; none for air.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn source(&self) -> Result<Option<Source>, Error> {
        self.medium.as_ref().map(MaterialName::source).transpose()
    }

    /// The path, of a file.
    pub fn path(&self) -> Option<&str> {
        self.medium.as_ref().and_then(MaterialName::path)
    }
}
