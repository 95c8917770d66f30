//! The files that a command line names: what a run reads, and what it writes by name.

use std::path::{Path, PathBuf};

use crate::app::sight;
use crate::app::source::is_path;

use super::{MaterialsCommand, MaterialsFlags, SightFlags};

/// The files of a run that stand on its command line.
#[derive(Debug, Default)]
pub struct NamedFiles<'a> {
    /// Materials, media, lights, pages, shaders of the user's.
    pub inputs: Vec<&'a Path>,
    /// `-o`, `--depfile`, `--json`, `--junit`, `--svg`, `--png`; not stdout.
    pub outputs: Vec<&'a Path>,
}

impl<'a> NamedFiles<'a> {
    pub(super) fn read(&mut self, names: impl IntoIterator<Item = &'a String>) {
        let paths = names.into_iter().filter(|name| is_path(name));
        self.inputs.extend(paths.map(Path::new));
    }

    pub(super) fn seen(&mut self, flags: &'a SightFlags) {
        self.inputs
            .extend(sight::input(&flags.words(None)).map(Path::new));
    }

    pub(super) fn report(&mut self, materials: &'a [String], json: &'a Option<PathBuf>) {
        self.read(materials);
        self.write(json);
    }

    pub(super) fn materials(&mut self, flags: &'a MaterialsFlags) {
        self.write(&flags.json);
        match &flags.what {
            Some(MaterialsCommand::Show(show)) => {
                self.read([&show.of.name].into_iter().chain(&show.of.medium));
                self.seen(&show.of.sight);
                self.write(show.svg.iter().chain(&show.png));
            }
            Some(MaterialsCommand::Params(params)) => {
                self.read([&params.name].into_iter().chain(&params.medium));
                self.seen(&params.sight);
            }
            Some(MaterialsCommand::Import(import)) => {
                self.inputs.push(Path::new(&import.page));
                self.write(&import.output);
            }
            Some(MaterialsCommand::Survey(survey)) => self.inputs.push(&survey.folder),
            Some(MaterialsCommand::List(_)) | None => {}
        }
    }

    pub(super) fn write<P: AsRef<Path> + 'a>(&mut self, files: impl IntoIterator<Item = &'a P>) {
        let files = files.into_iter().map(AsRef::as_ref);
        self.outputs
            .extend(files.filter(|file| *file != Path::new("-")));
    }
}
