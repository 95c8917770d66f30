//! The files of flavours: adapters for hosts, with fitted coefficients of the run's materials.

use crate::generator::command_line::CommandLine;
use crate::generator::emit::{self, Artifact, CatalogueRow};
use crate::generator::error::{Error, RequestFault};
use crate::generator::flavours::{self, Fitted, Flavour};
use crate::generator::generate::Run;
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{DEFAULT_MATERIALS, Materials, Request, Source};
use crate::language::methods::Method;
use crate::language::targets::Target;
use crate::physics::materials::ViewingConditions;

/// The example material in files that a run with other materials does not change.
const EXAMPLE: &str = "gold";

/// Refuses requests that adapters cannot follow: their functions, names and languages are the host's.
///
/// # Errors
/// A target that none of the flavours has, or flags that choose functions.
pub fn check(
    request: &Request,
    flavours: &[&'static Flavour],
    targets: &[&'static Target],
    methods: Option<&[&'static Method]>,
) -> Result<(), Error> {
    if flavours.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = flavours.iter().map(|flavour| flavour.name).collect();
    let names = names.join(",");
    let is_foreign = |target: &&&Target| {
        let mut all = flavours.iter();
        !all.any(|flavour| flavour.languages.contains(&target.name))
    };
    if let Some(target) = targets.iter().find(is_foreign) {
        let mut languages: Vec<&str> = flavours
            .iter()
            .flat_map(|one| one.languages)
            .copied()
            .collect();
        languages.sort_unstable();
        languages.dedup();
        let languages = if languages.is_empty() {
            "no target's language".to_owned()
        } else {
            languages.join(" and ")
        };
        let why = format!(
            "--flavour {names} is written in {languages}, and --target is {}; leave --target out",
            target.name
        );
        return Err(RequestFault::refused(why).into());
    }
    let why = if methods.is_some() || !request.chosen.is_empty() {
        "takes the fitted method of each material; leave --method, --budget and --plan out"
    } else if !request.effects.is_empty() {
        "writes no effects; run --effect alone"
    } else if request.precision.is_half() {
        "is written in single precision; leave --precision f16 out"
    } else if request.prefix != Request::default().prefix {
        "has names that its host knows; leave --prefix out"
    } else if request.materials == Materials::None {
        "is of materials; `none` leaves none"
    } else {
        return Ok(());
    };
    Err(RequestFault::refused(format!("--flavour {names} {why}")).into())
}

/// The row of the example, fitted under the default request.
fn example_rows() -> Result<Vec<CatalogueRow>, Error> {
    let usual = Request {
        materials: Materials::These(vec![Source::Named(EXAMPLE.to_owned())]),
        ..Request::default()
    };
    let subjects = usual.subjects()?.materials();
    Ok(emit::adapter_rows(&subjects, &usual.naming())?)
}

impl Run<'_> {
    /// All files of the flavours, and why some materials of `all` have none.
    ///
    /// # Errors
    /// A named material has no fitted form.
    pub fn flavour_files(&self) -> Result<(Vec<Artifact>, Vec<String>), Error> {
        if self.flavours.is_empty() {
            return Ok((Vec::new(), Vec::new()));
        }
        let (subjects, others): (Vec<MaterialInMedium>, Vec<MaterialInMedium>) =
            (self.subjects.iter())
                .map(|(subject, _)| subject.clone())
                .partition(|subject| subject.fitted_in_engines().is_some());
        let without = |subject: &MaterialInMedium| {
            let name = &subject.name;
            format!(
                "material `{name}` in adapters: its refractive index is too near that of the medium for a fitted form"
            )
        };
        if let Some(named) = others
            .iter()
            .find(|subject| !self.is_brought_along(subject))
        {
            return Err(RequestFault::refused(format!("{}; leave it out", without(named))).into());
        }
        self.refuse_names_of_pages(&subjects)?;
        let rows = emit::adapter_rows(&subjects, &self.request.naming())?;
        let reference = subjects
            .first()
            .map(|subject| subject.reference.surface.seen.clone());
        let reference = reference.unwrap_or_default();
        let materials = Fitted {
            rows: &rows,
            reference: &reference,
        };
        let example_rows = example_rows()?;
        let example = Fitted {
            rows: &example_rows,
            reference: &ViewingConditions::default().reference_in_words(),
        };
        let mut artifacts = Vec::new();
        for flavour in &self.flavours {
            let command = |material: Option<&str>| match material {
                Some(name) => self.adapter_command(flavour, &|one| one.name == name),
                None if flavour.is_by_material() => self.adapter_command(flavour, &|_| false),
                None => self.adapter_command(flavour, &|_| true),
            };
            artifacts.extend(flavours::files(flavour, materials, example, &command)?);
        }
        Ok((artifacts, others.iter().map(without).collect()))
    }

    /// Refuses a material whose file would have the name of one of the flavour's shared files.
    fn refuse_names_of_pages(&self, subjects: &[MaterialInMedium]) -> Result<(), RequestFault> {
        for flavour in &self.flavours {
            let clash = |subject: &&MaterialInMedium| {
                let mut own = flavour.pages.iter().filter(|page| page.is_of_material());
                own.any(|page| flavour.has(&page.file_of(&subject.name), None))
            };
            if let Some(subject) = subjects.iter().find(clash) {
                let (name, flavour) = (&subject.name, flavour.name);
                return Err(RequestFault::refused(format!(
                    "material `{name}`: the flavour {flavour} has a file of this name for all materials; give the material another name"
                )));
            }
        }
        let is_base = |subject: &&MaterialInMedium| subject.name.ends_with("_under_coat");
        match subjects.iter().find(is_base) {
            Some(subject) => Err(RequestFault::refused(format!(
                "material `{}`: what ends in _under_coat is the base of a clear coat in adapters; give the material another name",
                subject.name
            ))),
            None => Ok(()),
        }
    }

    /// Whether `all` included this material.
    fn is_brought_along(&self, subject: &MaterialInMedium) -> bool {
        let all = self.request.materials.sources();
        let names_it = Source::BroughtAlong(subject.argument.clone());
        all.iter().any(|source| *source.base() == names_it)
    }

    /// The command that writes the files of some materials again.
    fn adapter_command(
        &self,
        flavour: &Flavour,
        is_meant: &dyn Fn(&MaterialInMedium) -> bool,
    ) -> String {
        let all = self.subjects.iter().map(|(subject, _)| subject);
        let meant: Vec<&MaterialInMedium> = all.filter(|subject| is_meant(subject)).collect();
        let is_all =
            |subject: &&&MaterialInMedium| meant.len() > 1 && self.is_brought_along(subject);
        let all = meant.iter().find(is_all).map(|_| "all");
        let named = meant.iter().filter(|subject| !is_all(subject));
        let mut names: Vec<&str> = all
            .into_iter()
            .chain(named.map(|one| one.argument.as_str()))
            .collect();
        if names == DEFAULT_MATERIALS {
            names.clear();
        }
        let first = meant.first();
        let medium = first.and_then(|subject| subject.medium.as_ref());
        CommandLine::new("fresnel-gen")
            .list("flavour", [flavour.name])
            .list("material", names)
            .each(
                "film",
                first.map_or(Vec::new(), |one| one.material.film_arguments()),
            )
            .list("medium", medium.map(|(argument, _)| argument))
            .seen_on(
                &self.request.viewing,
                first.map(|one| &one.reference.surface),
            )
            .into()
    }
}
