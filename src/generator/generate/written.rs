//! Decides what a run writes into its files: their methods, function names, commands and form of comments.
//!
//! The methods of a file are those asked for and those that earlier runs put there by name. In half precision, methods that it
//! cannot represent are left out. No two functions may have one name ([`Owners`]). [`generate_single`] is the one file of
//! functions that `-o` writes.

use std::collections::BTreeMap;

use crate::generator::command_line::CommandLine;
use crate::generator::emit::{self, EmittedFunction, HeaderForm, Heading, Naming};
use crate::generator::error::{Error, RequestFault};
use crate::generator::generate::{KeptMethods, Run};
use crate::generator::output::manifest::{Entry, Manifest};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request};
use crate::language::effects::Effect;
use crate::language::methods::{self, Gpu, InHalf, Method};
use crate::language::targets::{Finish, Target};
use crate::physics::num::Precision;

type Named<'a> = Option<&'a [&'static Method]>;

/// The methods of library files. Where each material's function is chosen by a budget, only named methods have one.
pub fn library_methods(request: &Request, named: Named) -> Vec<&'static Method> {
    let all = if request.chosen.is_empty() {
        methods::ALL
    } else {
        &[]
    };
    let mut methods = named.unwrap_or(all).to_vec();
    methods.retain(|method| request.refusal(method, true).is_none());
    methods
}

/// The methods whose library file is asked for but not written, with the reason.
pub fn refused(request: &Request, named: Named) -> Vec<String> {
    let asked = named.unwrap_or(methods::ALL).iter();
    let refused = |method: &&'static Method| {
        let why = request.refusal(method, true)?;
        Some(format!(
            "{} in {}: {why}",
            method.name,
            request.precision.name()
        ))
    };
    asked.filter_map(refused).collect()
}

/// The default methods of a material's file.
pub fn usual(request: &Request, subject: &MaterialInMedium) -> Vec<&'static Method> {
    let names = subject.default_methods().into_iter();
    names
        .map(registered)
        .filter(|method| is_written(request, method))
        .collect()
}

/// The method of a name that stands in this program.
fn registered(name: &str) -> &'static Method {
    methods::find(name).expect("a material's methods are registered")
}

/// The methods for a material: the one that a budget chose, those named, or the default ones.
fn named_or(run: &Run, material: &str, usual: &[&'static Method]) -> Vec<&'static Method> {
    match (run.request.chosen.get(material), &run.named) {
        (Some(chosen), _) => vec![*chosen],
        (None, Some(named)) => named.clone(),
        (None, None) => usual.to_vec(),
    }
}

/// The methods of a material's file, the exact one first.
pub fn methods_of(
    run: &Run,
    target: &Target,
    subject: &MaterialInMedium,
    kept: &KeptMethods,
) -> Vec<&'static Method> {
    let usual = usual(run.request, subject);
    let file = (target.name.to_owned(), subject.name.clone());
    let exactly = run
        .existing
        .and_then(|existing| existing.methods.get(&file));
    let mut chosen = match exactly {
        Some(_) => Vec::new(),
        None => named_or(run, &subject.name, &usual),
    };
    chosen.retain(|method| is_written(run.request, method));
    chosen.extend(exactly.or_else(|| kept.get(&file)).into_iter().flatten());
    let rank = |method: &Method| {
        let place = usual.iter().position(|other| other.name == method.name);
        place.unwrap_or(usual.len())
    };
    chosen.sort_by_key(|method| (rank(method), method.name));
    chosen.dedup_by_key(|method| method.name);
    chosen
}

/// Whether a method is written for materials in the request's precision.
fn is_written(request: &Request, method: &Method) -> bool {
    request.refusal(method, false).is_none()
}

/// Refuses named methods that cannot be written in the request's precision.
pub fn check(request: &Request, named: Named, no_materials: bool) -> Result<(), Error> {
    for method in named.unwrap_or_default() {
        if let Some(why) = request.refusal(method, no_materials) {
            let remedy = match method.half {
                InHalf::Specialised(_) => {
                    "name a --material, to which it can be specialised, or --force it"
                }
                _ => "--force writes it all the same, with no promise",
            };
            let (name, precision) = (method.name, request.precision.name());
            let what = format!("method `{name}` cannot be saved in {precision}: {why}; {remedy}");
            return Err(RequestFault::refused(what).into());
        }
    }
    Ok(())
}

/// The owner of each function name: the part of the output that holds the function.
#[derive(Default)]
pub struct Owners(BTreeMap<String, String>);

impl Owners {
    /// Refuses two functions with one name, such as a material called `gold_schlick` and gold's `schlick`.
    pub fn claim(&mut self, name: &str, owner: &str) -> Result<(), Error> {
        let other = self.0.insert(name.to_owned(), owner.to_owned());
        match other.filter(|other| other != owner) {
            None => Ok(()),
            Some(other) => {
                let why =
                    format!("`{name}` would stand in {other} and in {owner}; rename a material");
                Err(RequestFault::refused(why).into())
            }
        }
    }
}

/// The methods in a folder's material files of this precision, according to its manifest.
pub fn kept(manifest: &Manifest, precision: Precision) -> KeptMethods {
    let mut kept = KeptMethods::new();
    let is_kept = |entry: &&Entry| entry.effect.is_none() && entry.precision() == precision.name();
    for entry in manifest.files.iter().filter(is_kept) {
        let methods = entry.function_methods().filter_map(methods::find);
        if let Some(material) = &entry.material {
            let file = (entry.target.clone(), material.clone());
            kept.entry(file).or_default().extend(methods);
        }
    }
    kept
}

impl Run<'_> {
    /// The form of comments in a file, named without its extension. Modules have no comments.
    pub(super) fn form(&self, target: &Target, stem: &str) -> HeaderForm {
        let stem = format!("{}/{stem}", target.name);
        let is_full = (self.existing).is_some_and(|existing| existing.full_headers.contains(&stem));
        match target.finish {
            Finish::Spirv => HeaderForm::Short,
            _ if is_full => HeaderForm::Full,
            _ => self.request.header,
        }
    }

    /// The command that makes a file again: one of an effect, of a material, or of the library.
    pub(super) fn command(
        &self,
        (target, gpu): (&Target, Option<Gpu>),
        effect: Option<&Effect>,
        methods: &[&str],
        subject: Option<&MaterialInMedium>,
        form: HeaderForm,
    ) -> String {
        let request = self.request;
        let precision = Some(request.precision).filter(|one| *one != Precision::default());
        let medium = subject.and_then(|subject| subject.medium.as_ref());
        let is_matched = subject.is_some() && effect.is_none();
        CommandLine::new("fresnel-gen")
            .list("target", [target.name])
            .list("effect", effect.map(|effect| effect.name))
            .list("method", methods)
            .list("material", subject.map(|subject| &subject.argument))
            .each(
                "film",
                subject.map_or(Vec::new(), |one| one.material.film_arguments()),
            )
            .list("medium", medium.map(|(argument, _)| argument))
            .list("prefix", Naming::flag_of_prefix(&request.prefix))
            .list("precision", precision.map(Precision::name))
            .list("gpu", gpu.filter(|gpu| *gpu != target.gpu).map(Gpu::name))
            .switch("force", request.force && request.precision.is_half())
            .seen_on(&request.viewing, subject.map(|one| &one.reference.surface))
            .list(
                "matching-angle",
                request.matching_angle.filter(|_| is_matched),
            )
            .list("header", form.flag())
            .into()
    }
}

/// One function as text for pasting, or, without a material, the functions of a library file: for `-o`.
///
/// ```
/// use fresnel_gen::{Materials, Request, Source, Target, generate_single};
///
/// let request = Request {
///     targets: vec![Target::GLES],
///     materials: Materials::These(vec![Source::Named("gold".into())]),
///     ..Request::default()
/// };
/// let text = String::from_utf8(generate_single(&request)?).expect("UTF-8");
/// assert!(text.contains("vec3 fresnel_gold("));
/// # Ok::<(), fresnel_gen::Error>(())
/// ```
///
/// # Errors
/// As [`generate()`](crate::generator::generate::generate). Also if the request has several targets.
pub fn generate_single(request: &Request) -> Result<Vec<u8>, Error> {
    let mut request = request.clone();
    if request.targets.is_empty() {
        request.targets = vec![Target::WGSL];
    }
    if request.materials == Materials::Default {
        request.materials = Materials::None;
    }
    let run = Run::new(&request)?;
    let [target] = run.targets.as_slice() else {
        return Err(RequestFault::refused("-o takes one --target").into());
    };
    if run.is_of_effects() {
        return effects(&run, target);
    }
    let (mut pages, mut owners) = (Vec::new(), Owners::default());
    let form = run.form(target, "");
    let naming = run.naming(target, "");
    let mut add = |emitted: &EmittedFunction, method: &Method, subject| {
        let written = (*target, naming.gpu);
        let command = run.command(written, None, &[method.name], subject, form) + " -o -";
        let heading = Heading {
            form,
            command: &command,
            gpu: naming.gpu,
        };
        let page = emit::single(target, emitted, subject, heading)?;
        // Only the first function keeps directives such as `enable f16;`: no code may precede them.
        pages.push(if pages.is_empty() {
            page
        } else {
            emit::without_directive(target, emitted.precision, page)
        });
        Ok::<(), Error>(())
    };
    for (subject, _) in &run.subjects {
        let methods = named_or(&run, &subject.name, &[registered(subject.main_method())]);
        for emitted in run.specialised(&methods, subject, &naming, &mut BTreeMap::new())? {
            owners.claim(&emitted.name, &format!("material {}", subject.name))?;
            add(&emitted, emitted.method, Some(subject))?;
        }
    }
    if run.subjects.is_empty() {
        for method in library_methods(run.request, run.named.as_deref()) {
            // Only one function of a module can be written: the method's own.
            let functions = match target.pages.len() {
                1 => run.library_functions(method, &naming)?,
                _ => emit::library_functions(method, &naming)?,
            };
            for emitted in emit::written_for(target, functions) {
                add(&emitted, method, None)?;
            }
        }
    }
    if target.pages.len() > 1 && pages.len() > 1 {
        let target = target.name;
        let why = format!("-o takes one function for {target}: name one --method");
        return Err(RequestFault::refused(why).into());
    }
    Ok(pages.join(&b"\n"[..]))
}

/// The functions of effects, one after the other. Those that the method and the material do not change are in their default form.
fn effects(run: &Run, target: &'static Target) -> Result<Vec<u8>, Error> {
    let all = run.whole_effects(target)?;
    if target.finish == Finish::Spirv && all.len() > 1 {
        let why = format!("-o takes one effect for {}: name one --effect", target.name);
        return Err(RequestFault::refused(why).into());
    }
    let mut pages = Vec::new();
    for (request, functions) in &all {
        let command = run.effect_command(target, request) + " -o -";
        pages.push(emit::effect_text(target, request, functions, &command)?);
    }
    Ok(pages.join(&b"\n"[..]))
}
