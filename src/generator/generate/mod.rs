//! Generation: a request becomes artifacts in memory. Only [`Generated::write_to`] touches the disk.

pub mod catalogue;
mod effects;
mod flavours;
pub mod tables;
mod written;

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::generator::bake::as_tables_are_seen;
use crate::generator::emit::{
    self, Artifact, Bounds, EmittedFunction, FunctionForm, Heading, NAGA_VERSION, Naming,
};
use crate::generator::error::{Error, RequestFault};
use crate::generator::flavours::Flavour;
use crate::generator::generate::tables::add_tables;
use crate::generator::output::lock::Lock;
use crate::generator::output::manifest::{Input, Provenance, Scope};
use crate::generator::output::tree::plan;
use crate::generator::output::write::write;
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::source::Subjects;
use crate::generator::request::{Materials, Request, each_once};
use crate::language::methods::{Gpu, Method};
use crate::language::targets::Target;
use crate::physics::digest::sha256;
use crate::physics::foreign;
use crate::physics::materials::SurfaceError;
use effects::WantedEffects;
use written::Owners;

pub use written::{generate_single, kept};

/// The result of a request.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The files, sorted by path.
    pub artifacts: Vec<Artifact>,
    /// The manifest entries of an output folder that the run owns.
    #[doc(hidden)]
    pub scope: Scope,
    /// Versions and inputs, for the manifest.
    #[doc(hidden)]
    pub provenance: Provenance,
    /// Why some materials that `all` includes are left out.
    pub left_out: Vec<SurfaceError>,
    /// Methods that nobody named and that half precision cannot represent, with the reason.
    pub refused: Vec<String>,
}

/// Methods that a material's file holds besides those of the request, by target and material. Earlier runs put them there by
/// name. A run that names methods adds to a file and removes nothing from it.
pub type KeptMethods = BTreeMap<(String, String), Vec<&'static Method>>;

/// Generates everything that the request asks for.
///
/// ```
/// use fresnel_gen::{Method, Request, Target, generate};
///
/// let request = Request::new().target(Target::WGSL).method(Method::SCHLICK);
/// let files = generate(&request)?.artifacts;
/// assert_eq!(files[0].path, "wgsl/fresnel_schlick.wgsl");
/// # Ok::<(), fresnel_gen::Error>(())
/// ```
///
/// # Errors
/// The request names what does not exist or contradicts itself, a material's file has a fault, a material was not measured over
/// the whole spectrum, or two functions would have the same name.
pub fn generate(request: &Request) -> Result<Generated, Error> {
    let mut generated = generate_beside(request, &KeptMethods::new())?;
    if request.tables {
        let request = Request {
            viewing: as_tables_are_seen(&request.viewing, false),
            ..request.clone()
        };
        add_tables(&mut generated, &request)?;
    }
    Ok(generated)
}

impl Generated {
    /// Writes the files into a folder that is this request's alone, such as `OUT_DIR`, and gives their paths, sorted. It also removes
    /// what an earlier request wrote there and this one does not. A file that is right already keeps its time, and a file that this
    /// program did not write is neither replaced nor removed. `manifest.json` beside them says which files are ours. Two requests take two
    /// folders, since each removes the files of the other.
    ///
    /// # Errors
    /// A file of others lies where one is to be written, another run writes there for two minutes, or the disk refuses: then all stays as
    /// it was. If the disk refuses to remove a file of an earlier request, the new files are there, and the next run removes it.
    pub fn write_to(&self, out_dir: impl AsRef<Path>) -> Result<Vec<PathBuf>, Error> {
        let out_dir = out_dir.as_ref();
        let mut lock = Lock::take(out_dir, &|_| ());
        // Nobody reads what a build script says, so it fails in place of going on beside another run.
        if lock.is_busy {
            let folder = foreign::path(&out_dir);
            let why = format!("another run has written into {folder} for two minutes");
            return Err(RequestFault::refused(why).into());
        }
        let scope = Scope {
            alone: true,
            ..self.scope.clone()
        };
        let plan = plan(out_dir, &self.artifacts, &scope, &self.provenance)?;
        write(&plan, &[], false, &mut lock)?;
        let paths = self.artifacts.iter();
        Ok(paths.map(|file| out_dir.join(&file.path)).collect())
    }
}

/// The same, for a folder whose material files already hold these methods.
///
/// # Errors
/// As [`generate()`].
pub fn generate_beside(request: &Request, kept: &KeptMethods) -> Result<Generated, Error> {
    if request.catalogue {
        return catalogue::own_catalogue(request);
    }
    let run = Run::new(request)?;
    let mut artifacts: Vec<Artifact> = made(&run, kept)?
        .into_iter()
        .map(|made| made.artifact)
        .collect();
    let (adapters, without_adapters) = run.flavour_files()?;
    artifacts.extend(adapters);
    artifacts.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(Generated {
        scope: run.scope(&artifacts),
        provenance: run.provenance(),
        refused: written::refused(request, run.named.as_deref())
            .into_iter()
            .chain(run.unchanged_effects(&artifacts))
            .chain(without_adapters)
            .collect(),
        left_out: run.left_out,
        artifacts,
    })
}

/// A file, and the functions in it.
#[derive(Clone, Debug)]
pub struct GeneratedFile {
    /// The file.
    pub artifact: Artifact,
    /// Its functions in order.
    pub functions: Vec<EmittedFunction>,
    /// The index of its material among the subjects, if it has one.
    pub subject: Option<usize>,
}

/// The result of a request, with the graphs of its functions.
#[derive(Clone, Debug)]
pub struct GeneratedWithGraphs {
    /// The files.
    pub files: Vec<GeneratedFile>,
    /// The materials.
    pub subjects: Vec<MaterialInMedium>,
    /// Why some materials that `all` includes are left out.
    pub left_out: Vec<SurfaceError>,
}

/// What the files of a folder hold.
#[derive(Clone, Debug, Default)]
pub struct ExistingContents {
    /// The methods of material files, which hold exactly these.
    pub methods: KeptMethods,
    /// The files whose comments have the full form, with their folder and without their extension.
    pub full_headers: BTreeSet<String>,
    /// The GPUs that files were written for, where a command named one; by the same names.
    pub gpus: BTreeMap<String, Gpu>,
}

/// Generates everything that the request asks for, and keeps the graphs. For a file in `existing`, the methods and the form of
/// comments are taken from there.
///
/// # Errors
/// As [`generate()`].
pub fn generate_with_graphs<'r>(
    request: &'r Request,
    kept: &KeptMethods,
    existing: &'r ExistingContents,
) -> Result<GeneratedWithGraphs, Error> {
    let mut run = Run::new(request)?;
    run.existing = Some(existing);
    Ok(GeneratedWithGraphs {
        files: made(&run, kept)?,
        subjects: run
            .subjects
            .into_iter()
            .map(|(subject, _)| subject)
            .collect(),
        left_out: run.left_out,
    })
}

fn made(run: &Run, kept: &KeptMethods) -> Result<Vec<GeneratedFile>, Error> {
    let mut owners = Owners::default();
    if run.targets.is_empty() {
        return Ok(Vec::new());
    }
    if run.is_of_effects() {
        return run.effect_files(&mut owners);
    }
    let mut files = Vec::new();
    for method in written::library_methods(run.request, run.named.as_deref()) {
        files.extend(run.library(method, &mut owners)?);
    }
    for (index, (subject, _)) in run.subjects.iter().enumerate() {
        files.extend(run.material(index, subject, kept, &mut owners)?);
    }
    files.extend(run.effect_files(&mut owners)?);
    Ok(files)
}

/// A request with its names resolved.
struct Run<'r> {
    request: &'r Request,
    targets: Vec<&'static Target>,
    /// The methods asked for by name; none where all are meant.
    named: Option<Vec<&'static Method>>,
    effects: WantedEffects,
    flavours: Vec<&'static Flavour>,
    subjects: Vec<(MaterialInMedium, String)>,
    left_out: Vec<SurfaceError>,
    bounds: Bounds,
    /// The contents of existing files that are compared with what would be written.
    existing: Option<&'r ExistingContents>,
}

impl<'r> Run<'r> {
    fn new(request: &'r Request) -> Result<Run<'r>, Error> {
        let named = request.methods.named();
        request.derivation()?;
        let names_others = named.is_some() || !request.effects.is_empty();
        let no_materials = names_others && request.materials == Materials::Default
            || request.materials == Materials::None;
        written::check(request, named.as_deref(), no_materials)?;
        let targets = request.targets_or_default();
        let flavours = each_once(request.flavours.clone(), |flavour| flavour.name);
        flavours::check(request, &flavours, &targets, named.as_deref())?;
        let subjects = if no_materials {
            Subjects::default()
        } else {
            request.subjects()?
        };
        Ok(Run {
            request,
            targets,
            flavours,
            subjects: subjects.ready,
            left_out: subjects.left_out,
            effects: effects::wanted(request, named.as_deref())?,
            named,
            bounds: Bounds::recorded(),
            existing: None,
        })
    }

    /// How functions are named and written in a file of a target, named without its extension.
    fn naming(&self, target: &Target, stem: &str) -> Naming {
        let stem = format!("{}/{stem}", target.name);
        let there = self.existing.and_then(|existing| existing.gpus.get(&stem));
        Naming {
            gpu: there.copied().or(self.request.gpu).or(Some(target.gpu)),
            ..self.request.naming()
        }
    }

    /// The functions of a method's library file, and their companions.
    fn library_functions(
        &self,
        method: &'static Method,
        naming: &Naming,
    ) -> Result<Vec<EmittedFunction>, Error> {
        let mut functions = emit::library_functions(method, naming)?;
        functions.extend(emit::companions(method, naming)?);
        Ok(functions)
    }

    fn library(
        &self,
        method: &'static Method,
        owners: &mut Owners,
    ) -> Result<Vec<GeneratedFile>, Error> {
        let mut files = Vec::new();
        for target in &self.targets {
            let naming = self.naming(target, &self.request.naming().library(method));
            let functions = self.library_functions(method, &naming)?;
            for emitted in &functions {
                owners.claim(&emitted.name, "the library")?;
            }
            let form = self.form(target, &functions[0].name);
            let command = self.command((target, naming.gpu), None, &[method.name], None, form);
            let heading = Heading {
                form,
                command: &command,
                gpu: naming.gpu,
            };
            for artifact in emit::library(target, method, &functions, heading)? {
                files.push(GeneratedFile {
                    artifact,
                    functions: emit::written_for(target, functions.clone()).collect(),
                    subject: None,
                });
            }
        }
        Ok(files)
    }

    fn material(
        &self,
        index: usize,
        subject: &MaterialInMedium,
        kept: &KeptMethods,
        owners: &mut Owners,
    ) -> Result<Vec<GeneratedFile>, Error> {
        let mut ready = BTreeMap::new();
        let mut files = Vec::new();
        for target in &self.targets {
            let methods = written::methods_of(self, target, subject, kept);
            let stem = format!("materials/{}", self.request.naming().material(subject));
            let naming = self.naming(target, &stem);
            let functions = self.specialised(&methods, subject, &naming, &mut ready)?;
            let usual = written::usual(self.request, subject);
            let names = |methods: &[&'static Method]| -> Vec<&str> {
                methods.iter().map(|method| method.name).collect()
            };
            let mut named = names(&methods);
            if named == names(&usual) {
                named.clear();
            }
            let form = self.form(target, &stem);
            let command = self.command((target, naming.gpu), None, &named, Some(subject), form);
            let heading = Heading {
                form,
                command: &command,
                gpu: naming.gpu,
            };
            for artifact in emit::material(target, subject, &functions, &naming, heading)? {
                files.push(GeneratedFile {
                    artifact,
                    functions: functions.clone(),
                    subject: Some(index),
                });
            }
        }
        for emitted in ready.values() {
            owners.claim(&emitted.name, &format!("material {}", subject.name))?;
        }
        Ok(files)
    }

    /// The functions of these methods for a material. Those that are ready, by the method's name and variant, are taken.
    fn specialised(
        &self,
        methods: &[&'static Method],
        subject: &MaterialInMedium,
        naming: &Naming,
        ready: &mut BTreeMap<[&'static str; 2], EmittedFunction>,
    ) -> Result<Vec<EmittedFunction>, Error> {
        let mut functions = Vec::new();
        for method in methods {
            let method = naming.written(method, FunctionForm::Specialised);
            let key = [method.name, method.variant];
            functions.push(match ready.entry(key) {
                Entry::Occupied(known) => known.get().clone(),
                Entry::Vacant(place) => {
                    let made = emit::specialised_function(method, subject, naming, &self.bounds)?;
                    place.insert(made).clone()
                }
            });
        }
        Ok(functions)
    }

    /// What the run owns. Of files of effects, it owns those that it made.
    fn scope(&self, artifacts: &[Artifact]) -> Scope {
        let request = self.request;
        let is_of_effects = self.is_of_effects();
        let subjects = self.subjects.iter().filter(|_| !is_of_effects);
        Scope {
            targets: self
                .targets
                .iter()
                .map(|target| target.name.to_owned())
                .collect(),
            methods: match &self.named {
                Some(named) if !is_of_effects => {
                    Some(named.iter().map(|method| method.name.to_owned()).collect())
                }
                None if !is_of_effects && request.chosen.is_empty() => None,
                _ => Some(BTreeSet::new()),
            },
            materials: subjects.map(|(subject, _)| subject.name.clone()).collect(),
            effects: artifacts.iter().filter_map(Artifact::effect_key).collect(),
            shared: false,
            flavours: (self.flavours.iter())
                .map(|flavour| flavour.name.to_owned())
                .collect(),
            precision: request.precision,
            alone: false,
            whole: request.targets.is_empty()
                && request.flavours.is_empty()
                && request.selects_nothing(),
        }
    }

    fn provenance(&self) -> Provenance {
        let input = |(subject, text): &(MaterialInMedium, String)| Input {
            name: subject.name.clone(),
            sha256: sha256(text.as_bytes()),
        };
        provenance(self.subjects.iter().map(input).collect())
    }
}

/// What a manifest says about a run with these inputs.
pub fn provenance(inputs: Vec<Input>) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        naga: NAGA_VERSION.to_owned(),
        inputs,
    }
}
