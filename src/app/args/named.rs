//! The files that a command line names: what a run reads, and what it writes by name.

use std::path::{Path, PathBuf};

use crate::app::sight;
use crate::app::source::is_path;

use super::{Cli, Command, MaterialsCommand, MaterialsFlags, SightFlags};

/// The files of a run that stand on its command line.
#[derive(Debug, Default)]
pub struct NamedFiles<'a> {
    /// Materials, media, lights, pages, shaders of the user's.
    pub inputs: Vec<&'a Path>,
    /// `-o`, `--depfile`, `--json`, `--junit`, `--svg`, `--png`; not stdout.
    pub outputs: Vec<&'a Path>,
}

impl<'a> NamedFiles<'a> {
    fn read(&mut self, names: impl IntoIterator<Item = &'a String>) {
        let paths = names.into_iter().filter(|name| is_path(name));
        self.inputs.extend(paths.map(Path::new));
    }

    fn seen(&mut self, flags: &'a SightFlags) {
        self.inputs
            .extend(sight::input(&flags.words(None)).map(Path::new));
    }

    fn report(&mut self, materials: &'a [String], json: &'a Option<PathBuf>) {
        self.read(materials);
        self.write(json);
    }

    fn materials(&mut self, flags: &'a MaterialsFlags) {
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

    fn write<P: AsRef<Path> + 'a>(&mut self, files: impl IntoIterator<Item = &'a P>) {
        let files = files.into_iter().map(AsRef::as_ref);
        self.outputs
            .extend(files.filter(|file| *file != Path::new("-")));
    }
}

impl Cli {
    /// The files that it names.
    pub fn named_files(&self) -> NamedFiles<'_> {
        let mut named = NamedFiles::default();
        let Some(command) = &self.command else {
            let flags = &self.generate;
            named.read(flags.material.iter().chain(&flags.medium));
            named.seen(&flags.sight);
            named.write(flags.output.iter().chain(&flags.depfile));
            return named;
        };
        match command {
            Command::Methods(flags) | Command::Targets(flags) => named.write(&flags.json),
            Command::Materials(flags) => named.materials(flags),
            Command::Bake(flags) => {
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(&flags.json);
            }
            Command::Verify(flags) => {
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(flags.json.iter().chain(&flags.junit));
            }
            Command::Audit(flags) => {
                named.inputs.extend(flags.file.iter().map(Path::new));
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(flags.json.iter().chain(&flags.junit));
            }
            Command::Fit(flags) => {
                named.read(flags.material.iter().chain(&flags.medium));
                named.seen(&flags.sight);
                named.write(&flags.json);
            }
            Command::Cost(flags) => named.report(&flags.material, &flags.json),
            Command::Time(flags) => named.report(&flags.material, &flags.json),
            Command::Chart(flags) => named.report(&flags.material, &flags.json),
            Command::Stability(flags) => named.report(&flags.material, &flags.json),
            Command::Reproduce(flags) => named.write(&flags.json),
        }
        named
    }
}
