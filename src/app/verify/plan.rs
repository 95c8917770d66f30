//! The plan: which files are run, each with what its functions mean. Supervisor and workers make the same plan from the
//! same flags, so that a number names a file.

use std::path::Path;

use crate::app::error::Error;
use crate::app::folder;
use crate::app::generate::{Made, generate_meant};
use crate::app::manifest::{self, Manifest};
use crate::app::request::{Materials, Request};
use crate::emit::{Emitted, Subject};
use crate::num::Precision;
use crate::targets::{self, Target};

/// What is to be run.
#[derive(Debug)]
pub struct Plan {
    /// The files in order.
    pub files: Vec<Planned>,
    /// The methods asked for by name; none where all are meant.
    methods: Vec<String>,
    /// The materials.
    pub subjects: Vec<Subject>,
    /// The materials with whose values library functions are run, where it is not those.
    others: Vec<Subject>,
    /// Why some are left out.
    pub left_out: Vec<String>,
}

/// A file, or the modules that stand for one.
#[derive(Debug)]
pub struct Planned {
    /// Its target.
    pub target: &'static Target,
    /// Its pages: that which is run comes last.
    pub pages: Vec<Page>,
    /// Its functions in order.
    pub functions: Vec<Emitted>,
    /// The place of its material among the subjects, where it has one.
    pub subject: Option<usize>,
}

/// A file as it is shipped.
#[derive(Debug)]
pub struct Page {
    /// Relative to the output folder.
    pub path: String,
    /// Its bytes: those in the output folder, or, where it is not there, what would be written.
    pub bytes: Vec<u8>,
    /// Whether it lies in the output folder.
    pub is_shipped: bool,
    /// Whether it is what would be written today.
    pub is_current: bool,
    /// The entry point of each function, in order; nothing for text.
    pub entries: Vec<String>,
}

impl Plan {
    /// The materials with whose values library functions are run.
    pub fn trial_subjects(&self) -> &[Subject] {
        if self.others.is_empty() {
            &self.subjects
        } else {
            &self.others
        }
    }

    /// The functions of a file whose methods were asked for.
    pub fn asked_for<'a>(&'a self, file: &'a Planned) -> impl Iterator<Item = &'a Emitted> {
        let wanted = |emitted: &&Emitted| {
            let named = |name: &String| name == "all" || name == emitted.method.name;
            self.methods.is_empty() || self.methods.iter().any(named)
        };
        file.functions.iter().filter(wanted)
    }

    /// What a request comes to, with the text that lies in a folder.
    ///
    /// # Errors
    /// The request cannot be met, or a file cannot be read.
    pub fn new(request: &Request, folder: &Path) -> Result<Plan, Error> {
        let meant = generate_meant(request)?;
        let shipped = manifest(folder)?;
        let mut files: Vec<Planned> = Vec::new();
        for made in meant.files {
            let page = page(&made, folder, shipped.as_ref())?;
            let stem = |path: &str| path.split('.').next().unwrap_or("").to_owned();
            match files.last_mut() {
                Some(last) if stem(&last.pages[0].path) == stem(&page.path) => last.add(page),
                _ => files.push(planned(made, page)?),
            }
        }
        // A request that names methods and no material has library files only; they need values all the same.
        let others = if meant.subjects.is_empty() {
            usual_subjects(request)?
        } else {
            Vec::new()
        };
        Ok(Plan {
            files,
            methods: request.methods.clone(),
            others,
            subjects: meant.subjects,
            left_out: meant
                .left_out
                .into_iter()
                .map(|unseen| unseen.why)
                .collect(),
        })
    }
}

fn usual_subjects(request: &Request) -> Result<Vec<Subject>, Error> {
    let usual = Request {
        materials: Materials::Default,
        ..request.clone()
    };
    let ready = usual.subjects()?.ready;
    Ok(ready.into_iter().map(|(subject, _)| subject).collect())
}

impl Planned {
    /// What its functions compute in.
    pub fn precision(&self) -> Precision {
        self.functions
            .first()
            .map_or_else(Precision::default, |emitted| emitted.precision)
    }

    /// The page that is run.
    pub fn run_page(&self) -> &Page {
        self.pages.last().expect("a planned file has a page")
    }

    /// Adds a page; compute modules are run, so that they come last.
    fn add(&mut self, page: Page) {
        self.pages.push(page);
        self.pages.sort_by_key(|page| page.path.contains(".comp."));
    }
}

fn planned(made: Made, page: Page) -> Result<Planned, Error> {
    let target = targets::find(&made.artifact.target).ok_or_else(|| Error::Usage {
        what: format!("there is no target `{}`", made.artifact.target),
    })?;
    Ok(Planned {
        target,
        pages: vec![page],
        functions: made.functions,
        subject: made.subject,
    })
}

/// The manifest of a folder, where there is one.
fn manifest(folder: &Path) -> Result<Option<Manifest>, Error> {
    let path = folder.join(manifest::FILE);
    let text = folder::read(&path)?;
    text.map(|text| Manifest::parse(&path, &text)).transpose()
}

/// Whether a file of a folder has all functions that are wanted of it: an earlier run may have asked for fewer.
fn has_all(manifest: Option<&Manifest>, made: &Made) -> bool {
    let Some(manifest) = manifest else {
        return true;
    };
    let entry = manifest
        .files
        .iter()
        .find(|entry| entry.file == made.artifact.path);
    let functions = entry.and_then(|entry| entry.detail.get("functions")?.as_array());
    let holds = |name: &str| functions.is_some_and(|all| all.iter().any(|one| one["name"] == name));
    made.functions.iter().all(|emitted| holds(&emitted.name))
}

fn page(made: &Made, folder: &Path, manifest: Option<&Manifest>) -> Result<Page, Error> {
    let path = made.artifact.path.clone();
    let shipped = if has_all(manifest, made) {
        folder::read(&folder.join(&path))?
    } else {
        None
    };
    let functions = made.artifact.detail["functions"].as_array();
    let entry = |function: &serde_json::Value| function["entry_point"].as_str().map(str::to_owned);
    let entries = functions.into_iter().flatten().filter_map(entry).collect();
    Ok(Page {
        is_shipped: shipped.is_some(),
        is_current: shipped
            .as_ref()
            .is_none_or(|bytes| *bytes == made.artifact.bytes),
        bytes: shipped.unwrap_or_else(|| made.artifact.bytes.clone()),
        entries,
        path,
    })
}
