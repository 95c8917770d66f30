//! The request for lookup tables: its materials in their medium, its defaults, the command that makes it again, and the errors of
//! baking.

use crate::generator::command_line::CommandLine;
use crate::generator::emit::{self, Naming};
use crate::generator::lut::{self, Format, TableAxis};
use crate::generator::reference::{ReferenceCurve, Typed};
use crate::language::methods::{self, Light, TEXELS};
use crate::language::targets::Target;
use crate::physics::materials::{Material, Surface, SurfaceError, ViewingConditions};
use crate::physics::spectra::{Gamut, Space};

/// The name of the picture with all materials.
pub const ATLAS: &str = "atlas";

/// The request for lookup tables.
#[derive(Clone, Debug)]
pub struct BakeRequest {
    /// The materials, sorted by name.
    pub subjects: Vec<TableMaterial>,
    /// The arguments that name all of them again: names, or `all`.
    pub typed: Vec<String>,
    /// The files wanted.
    pub formats: Vec<Format>,
    /// The size of the tables.
    pub shape: TableSize,
    /// Whether to write a picture with one row per material, too.
    pub atlas: bool,
    /// The languages that get a function for each picture.
    pub targets: Vec<&'static Target>,
    /// The prefix of these functions' names.
    pub prefix: String,
    /// The flags of the viewing conditions and the medium, each with a space before it.
    pub flags: String,
}

/// The size of tables.
#[derive(Clone, Debug, PartialEq)]
pub enum TableSize {
    /// This many texels along this axis.
    Fixed {
        /// The axis.
        axis: TableAxis,
        /// The number of texels.
        texels: usize,
    },
    /// The fewest bytes within this error, along one of these axes.
    Within {
        /// The largest error of the filtered lookup.
        budget: f64,
        /// The axes.
        axes: Vec<TableAxis>,
    },
}

impl BakeRequest {
    /// The command that reports this again, without the output path.
    pub fn command_line(&self) -> CommandLine {
        let command = CommandLine::new("bake")
            .list("material", &self.typed)
            .with(&self.flags);
        let command = match &self.shape {
            TableSize::Fixed { axis, texels } => {
                command.list("size", [texels]).list("axis", [axis.name()])
            }
            TableSize::Within { budget, axes } => {
                let only = axes.first().filter(|_| axes.len() == 1);
                command
                    .number("budget", format_args!("{budget:?}"))
                    .list("axis", only.map(|axis| axis.name()))
            }
        };
        let command = command
            .list("format", self.formats.iter().map(|format| format.name()))
            .switch("atlas", self.atlas);
        with_functions(command, &self.targets, &self.prefix)
    }
}

/// The same command, with the functions beside the tables.
pub fn with_functions(
    command: CommandLine,
    targets: &[&'static Target],
    prefix: &str,
) -> CommandLine {
    if targets.is_empty() {
        return command;
    }
    command
        .list("target", targets.iter().map(|target| target.name))
        .list("prefix", Naming::flag_of_prefix(prefix))
}

/// The request for the tables of these materials and an atlas that a run without flags makes.
pub fn usual_request(subjects: Vec<TableMaterial>, viewing: &ViewingConditions) -> BakeRequest {
    BakeRequest {
        typed: material_words(&subjects),
        flags: viewing_flags(&subjects, viewing),
        subjects,
        formats: DEFAULT_FORMATS.to_vec(),
        shape: TableSize::Fixed {
            axis: DEFAULT_AXIS,
            texels: TEXELS,
        },
        atlas: true,
        targets: Vec::new(),
        prefix: Naming::default().prefix,
    }
}

/// A material in its medium under viewing conditions.
#[derive(Clone, Debug)]
pub struct TableMaterial {
    /// The material's name, followed by `_in_` and the medium's name if there is one.
    pub name: String,
    /// The argument that names it again on the command line.
    pub argument: String,
    /// The words of `--film` that name its films again, outermost first.
    pub films: Vec<String>,
    /// The argument that names the medium again; none for air.
    pub medium: Option<String>,
    /// Its reference reflectance.
    pub reference: ReferenceCurve,
    /// The working space; none where a channel is one wavelength.
    pub space: Option<Space>,
}

impl TableMaterial {
    /// A material and a medium, each with the argument that names it again.
    ///
    /// # Errors
    /// It is not known at the wavelengths needed.
    pub fn new(
        (argument, material): (&str, &Material),
        medium: Option<&Typed>,
        viewing: &ViewingConditions,
    ) -> Result<TableMaterial, SurfaceError> {
        let surface = Surface::new(material, medium.map(|(_, medium)| medium), viewing)?;
        let name = &material.name;
        let is_spectral = surface.is_spectral();
        Ok(TableMaterial {
            name: medium.map_or(name.clone(), |(_, medium)| {
                format!("{name}_in_{}", medium.name)
            }),
            argument: argument.to_owned(),
            films: material
                .film_arguments()
                .into_iter()
                .map(str::to_owned)
                .collect(),
            medium: medium.map(|(argument, _)| argument.clone()),
            space: is_spectral.then_some(viewing.integration.space),
            reference: ReferenceCurve::new(surface, Light::Unpolarised),
        })
    }

    /// The viewing conditions, in words.
    pub fn seen(&self) -> &str {
        &self.reference.surface.seen
    }
}

/// The default axis: the one with the smallest errors at equal size.
pub const DEFAULT_AXIS: TableAxis = TableAxis::Rational;
/// The default formats: one that most programs read, one for engines without float textures, and one that GPUs take.
pub const DEFAULT_FORMATS: [Format; 3] = [Format::ExrHalf, Format::Png16, Format::Ktx2];

/// The viewing conditions of tables: colours outside the working space are kept, unless another policy was requested.
pub fn as_tables_are_seen(viewing: &ViewingConditions, gamut_was_said: bool) -> ViewingConditions {
    let mut viewing = viewing.clone();
    // Where a channel is one wavelength, there is no colour space.
    if !gamut_was_said && viewing.wavelengths_nm.is_none() {
        viewing.gamut = Gamut::Keep;
    }
    viewing
}

/// The arguments that name the materials on the command line.
pub fn material_words(subjects: &[TableMaterial]) -> Vec<String> {
    subjects.iter().map(|one| one.argument.clone()).collect()
}

/// The flags of the medium and the viewing conditions, each with a space before it.
pub fn viewing_flags(subjects: &[TableMaterial], viewing: &ViewingConditions) -> String {
    let first = subjects.first();
    let medium = first.and_then(|subject| subject.medium.as_ref());
    // Tables keep colours outside the space by default; functions clip them.
    let clips = viewing.gamut == Gamut::Clip && viewing.wavelengths_nm.is_none();
    CommandLine::new("")
        .each("film", first.map_or(&[][..], |subject| &subject.films))
        .list("medium", medium)
        .seen_as(viewing)
        .list("gamut", clips.then_some(Gamut::Clip.name()))
        .into()
}

/// An error of baking.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A table cannot be made.
    #[error(transparent)]
    Table(#[from] lut::Error),
    /// A language refuses the function that reads a table.
    #[error(transparent)]
    Function(#[from] emit::Error),
    /// A split-sum table of a method that is not affine in numbers of the material.
    #[error(
        "--dfg takes a method that is affine in numbers of a material ({}), and `{method}` is none",
        split_sum_methods().join(", ")
    )]
    NotAffine {
        /// The method.
        method: &'static str,
    },
    /// An engine's table with a method that the engine does not use.
    #[error(
        "--layout {layout} holds the terms of schlick, and not of `{method}`: leave --method out"
    )]
    EnginesMethod {
        /// The layout.
        layout: &'static str,
        /// The method.
        method: &'static str,
    },
    /// Terms below 0 or above 1 in an integer format.
    #[error(
        "the terms of `{method}` lie beyond 0 to 1, which {format} does not hold: take exr-half, exr-float, ktx2, c, rust or js"
    )]
    Integers {
        /// The method.
        method: &'static str,
        /// The format.
        format: &'static str,
    },
}

/// The methods that have a split-sum table.
pub fn split_sum_methods() -> Vec<&'static str> {
    let all = methods::ALL.iter();
    let all = all.filter(|method| method.basis().is_some());
    all.map(|method| method.name).collect()
}
