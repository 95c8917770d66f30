//! The files that a command line names: those that a run reads, and those that it writes by name.

use std::path::{Path, PathBuf};

use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::ReportFlags;
use crate::cli::flags::viewing::ViewingFlags;
use crate::cli::generate::GenerateFlags;
use crate::cli::materials::{MaterialsCommand, MaterialsFlags, SeenFlags};
use crate::cli::merge::MergeFlags;

/// The files that stand on a run's command line.
#[derive(Debug, Default)]
pub struct NamedFiles<'a> {
    /// The user's materials, media, lights, pages, shaders.
    pub inputs: Vec<&'a Path>,
    /// Paths of `-o`, `--depfile`, `--json`, `--junit`, `--csv`, `--svg` and `--png`, except stdout.
    pub outputs: Vec<&'a Path>,
}

impl<'a> NamedFiles<'a> {
    pub fn read(&mut self, paths: impl IntoIterator<Item = &'a str>) {
        self.inputs.extend(paths.into_iter().map(Path::new));
    }

    pub fn seen(
        &mut self,
        materials: &'a MaterialFlags,
        medium: &'a MediumFlags,
        viewing: &'a ViewingFlags,
    ) {
        self.read(materials.paths().chain(medium.path()).chain(viewing.path()));
    }

    pub fn report(&mut self, materials: &'a MaterialFlags, report: &'a ReportFlags) {
        self.read(materials.paths());
        self.write(&report.json);
    }

    pub fn generation(&mut self, flags: &'a GenerateFlags) {
        self.seen(&flags.materials, &flags.medium, &flags.viewing.viewing);
        self.inputs.extend(flags.plan.as_deref());
        self.write(flags.output.iter().chain(&flags.depfile));
    }

    pub fn params(&mut self, flags: &'a SeenFlags) {
        let material = flags.name.path().into_iter();
        self.read(
            material
                .chain(flags.films.paths())
                .chain(flags.medium.path())
                .chain(flags.viewing.path()),
        );
    }

    pub fn materials(&mut self, flags: &'a MaterialsFlags) {
        self.write(&flags.report.json);
        match &flags.what {
            Some(MaterialsCommand::Show(show)) => {
                self.params(&show.of);
                self.write(show.svg.iter().chain(&show.png));
            }
            Some(MaterialsCommand::Params(params)) => {
                self.params(&params.of);
                self.write(&params.output);
            }
            Some(MaterialsCommand::Compare(flags)) => {
                self.read(flags.of.paths());
                self.write(flags.svg.iter().chain(&flags.png).chain(&flags.csv));
            }
            Some(MaterialsCommand::Reflectance(flags)) => {
                self.read(flags.of.paths());
                self.write(&flags.csv);
            }
            Some(MaterialsCommand::Import(import)) => {
                self.inputs.push(Path::new(&import.page));
                self.write(&import.output);
            }
            Some(MaterialsCommand::Survey(survey)) => self.inputs.push(&survey.folder),
            Some(MaterialsCommand::List(_) | MaterialsCommand::Coat(_)) | None => {}
        }
    }

    pub fn merge(&mut self, flags: &'a MergeFlags) {
        self.inputs
            .extend(flags.reports.iter().map(PathBuf::as_path));
        self.write(flags.json.iter().chain(&flags.junit));
    }

    pub fn write<P: AsRef<Path> + 'a>(&mut self, files: impl IntoIterator<Item = &'a P>) {
        let files = files.into_iter().map(AsRef::as_ref);
        self.outputs
            .extend(files.filter(|file| *file != Path::new("-")));
    }
}
