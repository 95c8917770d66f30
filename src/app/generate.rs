//! Generation: a request becomes artifacts in memory. Pure: nothing is read, nothing is written.

use std::collections::{BTreeMap, BTreeSet};

use crate::emit::{self, Bounds, Emitted, File, NAGA_VERSION, Naming, Subject};
use crate::materials::Unseen;
use crate::methods::{self, Method};
use crate::targets::Target;

use super::artifact::{Artifact, sha256};
use super::error::Error;
use super::manifest::{Input, Provenance};
use super::names::quoted;
use super::request::{Materials, Request, Subjects};
use super::scope::Scope;
use super::sight;

/// What a request comes to.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The files, sorted by path.
    pub artifacts: Vec<Artifact>,
    /// What the run owns of an output folder.
    pub scope: Scope,
    /// Versions and inputs, for the manifest.
    pub provenance: Provenance,
    /// Why materials that `all` brings along are left out.
    pub left_out: Vec<Unseen>,
}

/// Methods that a material's file holds besides those of the request, by target and material: what earlier runs put
/// there by name. A run that names methods adds to a file and takes nothing from it.
pub type Kept = BTreeMap<(String, String), BTreeSet<String>>;

/// Generates everything that the request asks for.
pub fn generate(request: &Request) -> Result<Generated, Error> {
    generate_beside(request, &Kept::new())
}

/// The same, for a folder whose material files hold these methods already.
pub fn generate_beside(request: &Request, kept: &Kept) -> Result<Generated, Error> {
    let run = Run::new(request)?;
    let mut artifacts = Vec::new();
    let mut owners = Owners::default();
    for method in run.named.clone().unwrap_or_else(|| methods::ALL.to_vec()) {
        let functions = emit::library_functions(method, &run.naming)?;
        for emitted in &functions {
            owners.claim(&emitted.name, "the library")?;
        }
        for target in &run.targets {
            let command = run.command(target, Some(&[method.name]), None);
            for file in emit::library(target, method, &functions, &command)? {
                artifacts.push(artifact(target, file, Some(method.name), None));
            }
        }
    }
    for (subject, _) in &run.subjects {
        let mut ready: BTreeMap<&str, Emitted> = BTreeMap::new();
        for target in &run.targets {
            let methods = run.methods_of(target, subject, kept);
            let functions = run.specialised(&methods, subject, &mut ready)?;
            let usual = methods == subject.default_methods();
            let command = run.command(target, (!usual).then_some(&methods), Some(subject));
            for file in emit::material(target, subject, &functions, &run.naming, &command)? {
                artifacts.push(artifact(target, file, None, Some(&subject.name)));
            }
        }
        for emitted in ready.values() {
            owners.claim(&emitted.name, &format!("material {}", subject.name))?;
        }
    }
    artifacts.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(Generated {
        artifacts,
        scope: run.scope(),
        provenance: run.provenance(),
        left_out: run.left_out,
    })
}

/// One function as text for pasting, or, without a material, the functions of a library file: for `-o`.
pub fn generate_single(request: &Request) -> Result<Vec<u8>, Error> {
    let mut request = request.clone();
    if request.targets.is_empty() {
        request.targets = vec!["wgsl".to_owned()];
    }
    if request.materials == Materials::Default {
        request.materials = Materials::None;
    }
    let run = Run::new(&request)?;
    let [target] = run.targets.as_slice() else {
        return Err(Error::Usage {
            what: "-o takes one --target".to_owned(),
        });
    };
    let mut pages = Vec::new();
    for (subject, _) in &run.subjects {
        let methods = run.named_or(&[subject.exact_method()]);
        for emitted in run.specialised(&methods, subject, &mut BTreeMap::new())? {
            let command =
                run.command(target, Some(&[emitted.method.name]), Some(subject)) + " -o -";
            pages.push(emit::single(target, &emitted, Some(subject), &command)?);
        }
    }
    if run.subjects.is_empty() {
        let methods = run.named.clone().unwrap_or_else(|| methods::ALL.to_vec());
        for method in methods {
            let functions = emit::library_functions(method, &run.naming)?;
            for emitted in emit::written_for(target, functions) {
                let command = run.command(target, Some(&[method.name]), None) + " -o -";
                pages.push(emit::single(target, &emitted, None, &command)?);
            }
        }
    }
    if target.pages.len() > 1 && pages.len() > 1 {
        return Err(Error::Usage {
            what: format!(
                "-o takes one function for {}: name one --method",
                target.name
            ),
        });
    }
    Ok(pages.join(&b"\n"[..]))
}

/// A request with its names resolved.
struct Run<'r> {
    request: &'r Request,
    targets: Vec<&'static Target>,
    /// The methods asked for by name; nothing where all are meant.
    named: Option<Vec<&'static Method>>,
    subjects: Vec<(Subject, String)>,
    left_out: Vec<Unseen>,
    naming: Naming,
    bounds: Bounds,
}

impl<'r> Run<'r> {
    fn new(request: &'r Request) -> Result<Run<'r>, Error> {
        let named = request.resolved_methods()?;
        request.derivation()?;
        let no_materials = named.is_some() && request.materials == Materials::Default;
        let subjects = if no_materials {
            Subjects::default()
        } else {
            request.subjects()?
        };
        Ok(Run {
            request,
            targets: request.resolved_targets()?,
            subjects: subjects.ready,
            left_out: subjects.left_out,
            named,
            naming: request.naming(),
            bounds: Bounds::recorded(),
        })
    }

    fn named_or(&self, usual: &[&'static str]) -> Vec<&'static str> {
        match &self.named {
            Some(named) => named.iter().map(|method| method.name).collect(),
            None => usual.to_vec(),
        }
    }

    /// The methods of a material's file, the exact one first.
    fn methods_of(&self, target: &Target, subject: &Subject, kept: &Kept) -> Vec<&'static str> {
        let usual = subject.default_methods();
        let mut chosen = self.named_or(&usual);
        if self.named.is_some() {
            let kept = kept.get(&(target.name.to_owned(), subject.name.clone()));
            chosen.extend(
                kept.into_iter()
                    .flatten()
                    .filter_map(|name| methods::find(name))
                    .map(|m| m.name),
            );
        }
        let rank = |name: &str| {
            usual
                .iter()
                .position(|other| *other == name)
                .unwrap_or(usual.len())
        };
        chosen.sort_by(|a, b| rank(a).cmp(&rank(b)).then(a.cmp(b)));
        chosen.dedup();
        chosen
    }

    fn specialised<'a>(
        &self,
        methods: &[&'a str],
        subject: &Subject,
        ready: &mut BTreeMap<&'a str, Emitted>,
    ) -> Result<Vec<Emitted>, Error> {
        let mut functions = Vec::new();
        for name in methods {
            if !ready.contains_key(name) {
                let method = methods::find(name).expect("resolved names are names of methods");
                let emitted =
                    emit::specialised_function(method, subject, &self.naming, &self.bounds)?;
                ready.insert(name, emitted);
            }
            functions.push(ready[name].clone());
        }
        Ok(functions)
    }

    /// The command that makes a file again.
    fn command(
        &self,
        target: &Target,
        methods: Option<&[&str]>,
        subject: Option<&Subject>,
    ) -> String {
        let mut command = format!("fresnel-gen --target {}", target.name);
        if let Some(methods) = methods {
            command += &format!(" --method {}", methods.join(","));
        }
        if let Some(subject) = subject {
            command += &format!(" --material {}", quoted(&subject.argument));
            if let Some((argument, _)) = &subject.medium {
                command += &format!(" --medium {}", quoted(argument));
            }
        }
        if self.naming != Naming::default() {
            command += &format!(" --prefix {}", self.request.prefix);
        }
        if let Some(subject) = subject {
            command += &sight::flags_for(&self.request.sight, &subject.truth.surface);
        }
        if let (Some(_), Some(degrees)) = (subject, self.request.matching_angle) {
            command += &format!(" --matching-angle {degrees}");
        }
        command
    }

    fn scope(&self) -> Scope {
        let names = |methods: &Vec<&'static Method>| {
            methods
                .iter()
                .map(|method| method.name.to_owned())
                .collect()
        };
        let request = self.request;
        Scope {
            targets: self
                .targets
                .iter()
                .map(|target| target.name.to_owned())
                .collect(),
            methods: self.named.as_ref().map(names),
            materials: self
                .subjects
                .iter()
                .map(|(subject, _)| subject.name.clone())
                .collect(),
            shared: false,
            whole: request.targets.is_empty()
                && request.methods.is_empty()
                && request.materials == Materials::Default,
        }
    }

    fn provenance(&self) -> Provenance {
        let input = |(subject, text): &(Subject, String)| Input {
            name: subject.name.clone(),
            sha256: sha256(text.as_bytes()),
        };
        Provenance {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            naga: NAGA_VERSION.to_owned(),
            inputs: self.subjects.iter().map(input).collect(),
        }
    }
}

/// Which part of the output holds a function, by its name.
#[derive(Default)]
struct Owners(BTreeMap<String, String>);

impl Owners {
    /// Refuses two functions of one name: a material called `gold_schlick` meets gold's `schlick` so.
    fn claim(&mut self, name: &str, owner: &str) -> Result<(), Error> {
        let other = self.0.insert(name.to_owned(), owner.to_owned());
        match other.filter(|other| other != owner) {
            None => Ok(()),
            Some(other) => Err(Error::Usage {
                what: format!("`{name}` would stand in {other} and in {owner}; rename a material"),
            }),
        }
    }
}

fn artifact(target: &Target, file: File, method: Option<&str>, material: Option<&str>) -> Artifact {
    Artifact {
        path: format!("{}/{}", target.name, file.name),
        bytes: file.bytes,
        target: target.name.to_owned(),
        method: method.map(str::to_owned),
        material: material.map(str::to_owned),
        detail: file.detail,
    }
}
