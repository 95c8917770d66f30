//! Errors of this program. Those of the output folder and the disk name the path, the fault and the way out. Those of a request
//! say what was given, what is allowed, and where.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::generator::{emit, lut};
use crate::language::methods::Method;
use crate::physics::foreign::{self, Foreign, one_line};
use crate::physics::materials;
use crate::physics::names::UnknownName;
use crate::physics::user_text::FileFault;

/// An error of a run: of its request, of what it generates, or of the output folder.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A name that does not exist.
    #[error(transparent)]
    Unknown(#[from] UnknownName),
    /// A fault of the request that several commands share.
    #[error(transparent)]
    Request(#[from] RequestFault),
    /// Something that the command needs is missing.
    #[error("{}", one_line(what))]
    Lacking {
        /// What is missing, and how to get it.
        what: String,
    },
    /// A material that is not known at the wavelengths needed.
    #[error(transparent)]
    Unseen(#[from] materials::SurfaceError),
    /// A file that the user named cannot be read.
    #[error("cannot read {}: {source}", foreign::path(path))]
    Input {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A material file with a fault.
    #[error(transparent)]
    Material(#[from] FileFault),
    /// Emission failed.
    #[error(transparent)]
    Emit(#[from] emit::Error),
    /// An adapter cannot be written.
    #[error(transparent)]
    Flavour(#[from] crate::generator::flavours::Error),
    /// A table cannot be made.
    #[error(transparent)]
    Lut(#[from] lut::Error),
    /// A table cannot be baked.
    #[error(transparent)]
    Bake(#[from] crate::generator::bake::Error),
    /// An artifact's path cannot be used.
    #[error(
        "the output path `{}` cannot be used: {}",
        Foreign(path),
        one_line(reason)
    )]
    Path {
        /// The path, relative to the output folder.
        path: String,
        /// The rule that it breaks.
        reason: String,
    },
    /// `manifest.json` is not JSON, or not our manifest.
    #[error(
        "{}:{line}:{column}: {}; nothing was written. Restore the file, or delete it and run again, or choose another --out-dir",
        foreign::path(path),
        one_line(reason)
    )]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// The line of the fault, from 1.
        line: usize,
        /// The column of the fault, from 1.
        column: usize,
        /// What was found and what was expected.
        reason: String,
    },
    /// An existing file or folder cannot be read.
    #[error(
        "cannot read {}: {source}; nothing was written. Check its permissions and that each folder above it is a folder",
        foreign::path(path)
    )]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A folder, pipe or device is in the place of a file to be written.
    #[error(
        "{} is not a file; nothing was written. Move it away or choose another output",
        foreign::path(path)
    )]
    NotAFile {
        /// What is there.
        path: PathBuf,
    },
    /// A file is in the place of one to be written, and nothing proves that this program wrote it.
    #[error(
        "{}: {}; nothing was written. Move it away, choose another place, or replace it with --overwrite",
        foreign::path(path),
        one_line(what)
    )]
    NotOurs {
        /// The place.
        path: PathBuf,
        /// What is there.
        what: String,
    },
    /// A folder of the output is a link: what lies behind it is not this run's.
    #[error(
        "{} is a link to {}; nothing was written. Name the folder itself with --out-dir, or put a folder in the link's place",
        foreign::path(link),
        foreign::path(leads_to)
    )]
    Linked {
        /// The link.
        link: PathBuf,
        /// Where it leads.
        leads_to: PathBuf,
    },
    /// An output leads through a link, or into a pipe, that another user may have put there.
    #[error(
        "{} is a link or a pipe of another user in a folder that users share; nothing was written. Name another place, or remove it",
        foreign::path(link)
    )]
    Planted {
        /// The link.
        link: PathBuf,
    },
    /// A file could not be prepared: no old file was touched.
    #[error(
        "cannot write {}: {source}; no file was changed. Check permissions and free space, then run again",
        foreign::path(path)
    )]
    Stage {
        /// The file that was to be written.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// All files were prepared, but one could not be put in place.
    #[error(
        "cannot replace {}: {source}; {replaced} of {pending} files are new, the others are as before. Close whatever holds the file and run again",
        foreign::path(path)
    )]
    Replace {
        /// The file that was to be replaced.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
        /// How many files were replaced before this one.
        replaced: usize,
        /// How many files were to be replaced.
        pending: usize,
    },
    /// All files were prepared, but something has appeared in the place of one.
    #[error(
        "{}: what lies there appeared or changed while this run wrote, or cannot be read, and stays; {replaced} of {pending} files are new, the others are as before. Move it away, or replace it with --overwrite, and run again",
        foreign::path(path)
    )]
    Taken {
        /// The place.
        path: PathBuf,
        /// How many files were replaced before this one.
        replaced: usize,
        /// How many files were to be replaced.
        pending: usize,
    },
    /// All files were written, but an orphan could not be removed.
    #[error(
        "cannot remove {}, which is no longer generated: {source}; all other files are written. Remove it by hand",
        foreign::path(path)
    )]
    Remove {
        /// The orphan.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

/// The error for a name that does not exist.
pub fn unknown(kind: &'static str, name: &str, all: &[&str]) -> Error {
    UnknownName::new(kind, name, all).into()
}

/// The advice on how to rename a material.
pub const NEW_NAME: &str = "rename one in its file; a page or a table is named after its file: rename that, or let `fresnel-gen materials import FILE --name NAME -o NAME.toml` make a material file";

/// What is wrong with a request.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RequestFault {
    /// A flag's number outside its limits.
    #[error("--{flag} is {}; it {}", Foreign(value), one_line(allowed))]
    OutOfRange {
        /// The flag.
        flag: &'static str,
        /// What was given.
        value: String,
        /// What is allowed: `is 1 to 1000`.
        allowed: String,
    },
    /// A request that contradicts itself, or that cannot be met.
    #[error("{}", one_line(why))]
    Refused {
        /// What is wrong, and what is allowed or to be left out.
        why: String,
    },
    /// Names that leave nothing to do.
    #[error("there is nothing to {work}: {why}")]
    NothingToDo {
        /// What the command does: `run`, `scan`, `measure`.
        work: &'static str,
        /// Why nothing is left.
        why: &'static str,
    },
    /// Two materials with one name.
    #[error("two different materials are named `{}`: `{}` and `{}`; {NEW_NAME}", Foreign(name), Foreign(&words[0]), Foreign(&words[1]))]
    SameName {
        /// The name.
        name: String,
        /// The words that name them on the command line.
        words: [String; 2],
    },
    /// A file of one material in the place of another's.
    #[error("{} was written of `{}`, and `{}` comes out with the same name; nothing was written; {NEW_NAME}", Foreign(file), Foreign(&words[0]), Foreign(&words[1]))]
    Namesake {
        /// The file.
        file: String,
        /// The words that name them, quoted for a shell.
        words: [String; 2],
    },
    /// A material whose name means something else.
    #[error(
        "the material `{}` has the name of {meaning}; choose another `name` in its file",
        Foreign(name)
    )]
    NameTaken {
        /// The name.
        name: String,
        /// What the name already means.
        meaning: &'static str,
    },
    /// A medium that is not transparent.
    #[error(
        "the medium `{}` is a {class}; a medium must be transparent: a dielectric",
        Foreign(name)
    )]
    OpaqueMedium {
        /// The medium.
        name: String,
        /// Its class.
        class: &'static str,
    },
    /// A light's file that has the name of a standard light.
    #[error(
        "the light's file is named `{}`, as a standard light is; rename it",
        Foreign(name)
    )]
    LightNameTaken {
        /// The name.
        name: String,
    },
    /// An output that must not lie where it should.
    #[error("{}: {why}", foreign::path(place))]
    Place {
        /// The output.
        place: PathBuf,
        /// What is there, and the way out.
        why: &'static str,
    },
}

impl RequestFault {
    /// The error for a request that contradicts itself, or that cannot be met.
    pub fn refused(why: impl Into<String>) -> RequestFault {
        RequestFault::Refused { why: why.into() }
    }

    /// The error for a method from which an effect cannot take R.
    pub fn textured_reflectance(method: &Method) -> RequestFault {
        RequestFault::refused(format!(
            "method `{}` reads a texture of its own, which effects do not pass on; name another --method",
            method.name
        ))
    }
}
