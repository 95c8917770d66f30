//! The plan of a verification, made from a request, an output folder and its manifest: which files are run, and what their
//! functions mean. Supervisor and workers make the same plan from the same flags, so that a number names a file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::generator::emit::{Artifact, EmittedFunction, HeaderForm};
use crate::generator::error::{Error, RequestFault};
use crate::generator::generate::{
    ExistingContents, GeneratedFile, GeneratedWithGraphs, KeptMethods, generate_with_graphs,
};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::source::Source;
use crate::generator::request::{Materials, Methods, Request};
use crate::lab::verify::shipped::{Folder, ShippedPage, replace_with_today};
use crate::language::methods::{self, Gpu, Method};
use crate::language::targets::{self, Target};
use crate::physics::num::Precision;

/// A folder that is not there: what would be written is planned.
const NO_FOLDER: &str = "/nonexistent/fresnel-gen";

/// The plan of a request, with the text of the files in a folder.
///
/// # Errors
/// The request cannot be met, or a file cannot be read.
pub fn plan_of_request(request: &Request, folder: &Path) -> Result<VerifyPlan, Error> {
    let shipped = Folder::new(folder)?;
    // Functions that earlier runs put into a material's file belong to it: they would be written again.
    let kept = shipped.kept(request.precision);
    let meant = generate_with_graphs(request, &kept, &ExistingContents::default())?;
    let held = ExistingContents {
        methods: held_methods(request, &meant, &shipped, &kept)?,
        full_headers: full_headers(&meant, &shipped)?,
        gpus: gpus(request, &meant, &shipped),
    };
    let exact = if is_as_meant(&meant, &held) {
        meant.files.clone()
    } else {
        generate_with_graphs(request, &kept, &held)?.files
    };
    let mut files: Vec<PlannedFile> = Vec::new();
    for (meant, exact) in meant.files.into_iter().zip(exact) {
        let (made, page) = page(request, &shipped, meant, exact)?;
        let stem = |path: &str| path.split('.').next().unwrap_or("").to_owned();
        match files.last_mut() {
            Some(last) if stem(&last.pages[0].path) == stem(&page.path) => last.add(page),
            _ => files.push(planned(made, page)?),
        }
    }
    // A request that names methods and no material has library files only, which still need values.
    let others = if meant.subjects.is_empty() {
        usual_subjects(request)?
    } else {
        Vec::new()
    };
    let of_films = |file: &PlannedFile| {
        let mut functions = file.functions.iter();
        functions.any(|emitted| emitted.method.class.is_of_films())
    };
    let films = if files.iter().any(of_films) {
        usual_films(request)?
    } else {
        Vec::new()
    };
    let pages: BTreeSet<&str> = (files.iter().flat_map(|file| &file.pages))
        .map(|page| page.path.as_str())
        .collect();
    let mut places = shipped.files();
    places.extend(pages.iter().map(|page| folder.join(page)));
    let unasked = if request.selects_nothing() {
        shipped.others(&request.targets, &pages)
    } else {
        Vec::new()
    };
    Ok(VerifyPlan {
        places,
        unasked,
        files,
        others,
        films,
        subjects: meant.subjects,
        left_out: meant
            .left_out
            .into_iter()
            .map(|unseen| unseen.why)
            .collect(),
    })
}

/// The methods that material files in the folder hold, by the manifest and by the names of their functions. Such a file is compared
/// with one of exactly these methods.
fn held_methods(
    request: &Request,
    meant: &GeneratedWithGraphs,
    shipped: &Folder,
    kept: &KeptMethods,
) -> Result<KeptMethods, Error> {
    let naming = request.naming();
    let mut held = KeptMethods::new();
    for made in &meant.files {
        let Some((file, subject)) = material_file(meant, made) else {
            continue;
        };
        let names = shipped.functions_in(&made.artifact.path)?;
        let in_text = methods::ALL
            .iter()
            .copied()
            .filter(|method| names.contains(&naming.specialised(method, subject)));
        let mut all = kept.get(&file).cloned().unwrap_or_default();
        all.extend(in_text);
        if !all.is_empty() {
            held.entry(file).or_default().extend(all);
        }
    }
    Ok(held)
}

/// The files of the folder whose comments have the full form, without their extension. They are compared with files of that form.
fn full_headers(meant: &GeneratedWithGraphs, shipped: &Folder) -> Result<BTreeSet<String>, Error> {
    let mut full = BTreeSet::new();
    for made in &meant.files {
        let path = &made.artifact.path;
        if shipped.header_form(path)? == HeaderForm::Full {
            let stem = path
                .rsplit_once('.')
                .map_or(path.as_str(), |(stem, _)| stem);
            full.insert(stem.to_owned());
        }
    }
    Ok(full)
}

/// The GPUs that files of the folder were written for, by the manifest, where this run would write them for another. They are compared
/// with files for these.
fn gpus(request: &Request, meant: &GeneratedWithGraphs, shipped: &Folder) -> BTreeMap<String, Gpu> {
    let gpu = |made: &GeneratedFile| {
        let Artifact { path, target, .. } = &made.artifact;
        let usual = targets::find(target)?.gpu;
        let gpu = shipped.gpu(path, usual)?;
        let is_other = gpu != request.gpu.unwrap_or(usual);
        is_other.then_some((path.split('.').next()?.to_owned(), gpu))
    };
    meant.files.iter().filter_map(gpu).collect()
}

/// The key of a material's file, which is its target and material, and the material itself.
fn material_file<'a>(
    meant: &'a GeneratedWithGraphs,
    made: &GeneratedFile,
) -> Option<((String, String), &'a MaterialInMedium)> {
    let subject = &meant.subjects[made.subject?];
    let file = (made.artifact.target.clone(), subject.name.clone());
    Some((file, subject))
}

/// Whether all files that hold functions hold exactly the methods that would be written, in the usual form. Then nothing need be
/// generated again.
fn is_as_meant(meant: &GeneratedWithGraphs, held: &ExistingContents) -> bool {
    held.full_headers.is_empty()
        && held.gpus.is_empty()
        && meant.files.iter().all(|made| {
            let file = material_file(meant, made);
            let held = file.and_then(|(file, _)| held.methods.get(&file));
            let names = |methods: &[&'static Method]| -> BTreeSet<&str> {
                methods.iter().map(|method| method.name).collect()
            };
            let written: Vec<&Method> = made.functions.iter().map(|one| one.method).collect();
            held.is_none_or(|held| names(held) == names(&written))
        })
}

/// A file of the folder, and what is run of it. `exact` is what the file should hold. `meant` also holds what this run asks for.
fn page(
    request: &Request,
    shipped: &Folder,
    meant: GeneratedFile,
    exact: GeneratedFile,
) -> Result<(GeneratedFile, ShippedPage), Error> {
    let asked_in = |made: &GeneratedFile| -> Vec<bool> {
        let asked = made.functions.iter();
        asked.map(|one| is_asked_for(request, one)).collect()
    };
    let asked = asked_in(&exact);
    let mut page = shipped.page(&exact, &asked)?;
    let has = |name: &str| exact.functions.iter().any(|one| one.name == name);
    let missing = meant.functions.iter().filter(|one| !has(&one.name));
    let lacks: Vec<&str> = missing.map(|one| one.name.as_str()).collect();
    let (mut made, asked) = if matches!(request.methods, Methods::Default) || lacks.is_empty() {
        (exact, asked)
    } else {
        let asked = asked_in(&meant);
        replace_with_today(&mut page, &meant, &asked, &lacks);
        (meant, asked)
    };
    let mut asked = asked.into_iter();
    made.functions.retain(|_| asked.next().unwrap_or(true));
    Ok((made, page))
}

/// Whether a function's method was asked for: by name, or because none was named.
fn is_asked_for(request: &Request, emitted: &EmittedFunction) -> bool {
    let is_named =
        |methods: &Vec<&Method>| methods.iter().any(|one| one.name == emitted.method.name);
    emitted.effect.is_some() || request.methods.named().as_ref().is_none_or(is_named)
}

fn usual_subjects(request: &Request) -> Result<Vec<MaterialInMedium>, Error> {
    let usual = Request {
        materials: Materials::Default,
        ..request.clone()
    };
    Ok(usual.subjects()?.materials())
}

/// Materials under films, for library functions that describe nothing else.
fn usual_films(request: &Request) -> Result<Vec<MaterialInMedium>, Error> {
    let names = ["anodised_titanium_purple", "oil_on_water"];
    let films = Request {
        materials: Materials::These(names.map(|name| Source::Named(name.to_owned())).to_vec()),
        ..request.clone()
    };
    Ok(films.subjects()?.materials())
}

fn planned(made: GeneratedFile, page: ShippedPage) -> Result<PlannedFile, Error> {
    let target = targets::find(&made.artifact.target).ok_or_else(|| {
        RequestFault::refused(format!("there is no target `{}`", made.artifact.target))
    })?;
    Ok(PlannedFile {
        target,
        pages: vec![page],
        functions: made.functions,
        subject: made.subject,
    })
}

/// The plan of a verification.
#[derive(Debug)]
pub struct VerifyPlan {
    /// The files in order.
    pub files: Vec<PlannedFile>,
    /// The materials.
    pub subjects: Vec<MaterialInMedium>,
    /// The materials with whose values library functions are run, where they are not `subjects`.
    pub others: Vec<MaterialInMedium>,
    /// Materials under films, for library functions that describe none of these.
    pub films: Vec<MaterialInMedium>,
    /// Why some materials are left out.
    pub left_out: Vec<String>,
    /// Files of functions that the folder's manifest lists and that a run without names leaves out: those of other materials,
    /// methods or precisions.
    pub unasked: Vec<String>,
    /// The files that are read or listed in the folder. No report may overwrite one.
    pub places: Vec<PathBuf>,
}

/// A file, or the modules that together stand for one.
#[derive(Debug)]
pub struct PlannedFile {
    /// Its target.
    pub target: &'static Target,
    /// Its pages. The one that is run comes last.
    pub pages: Vec<ShippedPage>,
    /// Its functions in order.
    pub functions: Vec<EmittedFunction>,
    /// The index of its material in the plan's `subjects`, where it has one.
    pub subject: Option<usize>,
}

impl VerifyPlan {
    /// Adds the library files of the methods' other forms, each once, as they would be written for GPUs that want them.
    ///
    /// # Errors
    /// The request cannot be met.
    pub fn add_variants(&mut self, request: &Request) -> Result<(), Error> {
        let methods = request.methods.named();
        let mut methods = methods.unwrap_or_else(|| methods::ALL.to_vec());
        methods.retain(|method| !method.variants.is_empty());
        if methods.is_empty() || !request.effects.is_empty() {
            return Ok(());
        }
        for gpu in Gpu::covering() {
            let request = Request {
                gpu: Some(gpu),
                methods: Methods::These(methods.clone()),
                materials: Materials::None,
                ..request.clone()
            };
            let others = plan_of_request(&request, Path::new(NO_FOLDER))?;
            for file in others.files {
                let is_planned = |known: &PlannedFile| known.has_text_of(&file);
                if !self.files.iter().any(is_planned) {
                    self.files.push(file);
                }
            }
        }
        Ok(())
    }

    /// The materials with whose values a method's library functions are run.
    pub fn trial_subjects(&self, method: &Method) -> impl Iterator<Item = &MaterialInMedium> {
        let own = if self.others.is_empty() {
            &self.subjects
        } else {
            &self.others
        };
        let is_described = |subject: &&MaterialInMedium| subject.is_described_by(method);
        let has_own = own.iter().any(|subject| subject.is_described_by(method));
        let wants_films = method.class.is_of_films() && !has_own;
        let films = if wants_films { &self.films[..] } else { &[] };
        own.iter().chain(films).filter(is_described)
    }
}

impl PlannedFile {
    /// Whether it is for the same target and holds functions of the same text as another.
    fn has_text_of(&self, other: &PlannedFile) -> bool {
        let variants = |file: &PlannedFile| -> Vec<[&str; 2]> {
            let methods = file.functions.iter().map(|one| one.method);
            methods.map(|one| [one.name, one.variant]).collect()
        };
        let is_library = |file: &PlannedFile| file.subject.is_none();
        self.target.name == other.target.name
            && is_library(self) == is_library(other)
            && self.precision() == other.precision()
            && variants(self) == variants(other)
    }

    /// The precision of its functions.
    pub fn precision(&self) -> Precision {
        self.functions
            .first()
            .map_or_else(Precision::default, |emitted| emitted.precision)
    }

    /// The page that is run.
    pub fn run_page(&self) -> &ShippedPage {
        self.pages.last().expect("a planned file has a page")
    }

    /// Why it has no row, where it has none. Functions of effects and of materials always have one.
    pub fn why_no_row(&self) -> &'static str {
        if self.functions.is_empty() {
            "it holds no function that was asked for"
        } else {
            "its functions describe none of the materials that are run"
        }
    }

    /// Adds a page. Compute modules are run, so they come last.
    pub fn add(&mut self, page: ShippedPage) {
        self.pages.push(page);
        self.pages.sort_by_key(ShippedPage::is_run);
    }
}
