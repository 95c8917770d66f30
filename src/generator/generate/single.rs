//! One file of functions to be pasted: what `-o` puts out.

use std::collections::BTreeMap;

use crate::generator::emit::{self, Heading, PlaceInFile};
use crate::generator::error::{Error, RequestFault};
use crate::generator::request::{Materials, Request};
use crate::language::targets::{Finish, Target};
use crate::generator::generate::written::{self, Owners};
use crate::generator::generate::Run;

/// One function as text for pasting, or, without a material, the functions of a library file: for `-o`.
///
/// ```
/// use fresnel_gen::{Materials, Request, Source, generate_single};
///
/// let request = Request {
///     targets: vec!["gles".into()],
///     materials: Materials::These(vec![Source::Named("gold".into())]),
///     ..Request::default()
/// };
/// let text = String::from_utf8(generate_single(&request)?).expect("UTF-8");
/// assert!(text.contains("vec3 fresnel_gold("));
/// # Ok::<(), fresnel_gen::Error>(())
/// ```
///
/// # Errors
/// As [`generate()`](crate::generator::generate::generate); also where the request has several targets.
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
        return Err(RequestFault::conflict("-o takes one --target").into());
    };
    if run.is_of_effects() {
        return effects(&run, target);
    }
    let (mut pages, mut owners) = (Vec::new(), Owners::default());
    for (subject, _) in &run.subjects {
        let methods = written::named_or(&run, &subject.name, &[subject.exact_method()]);
        for emitted in run.specialised(&methods, subject, &mut BTreeMap::new())? {
            owners.claim(&emitted.name, &format!("material {}", subject.name))?;
            let (place, of) = (PlaceInFile::behind(&pages), Some(subject));
            let form = run.form(target, "");
            let command = run.command(target, Some(&[emitted.method.name]), of, form) + " -o -";
            let heading = Heading {
                form,
                command: &command,
            };
            pages.push(emit::single(target, &emitted, of, heading, place)?);
        }
    }
    if run.subjects.is_empty() {
        for method in written::library_methods(run.request, run.named.as_deref()) {
            // Of a module one function can be put out, the method's own.
            let functions = match target.pages.len() {
                1 => run.library_functions(method)?,
                _ => emit::library_functions(method, &run.naming)?,
            };
            for emitted in emit::written_for(target, functions) {
                let form = run.form(target, "");
                let command = run.command(target, Some(&[method.name]), None, form) + " -o -";
                let (place, heading) = (
                    PlaceInFile::behind(&pages),
                    Heading {
                        form,
                        command: &command,
                    },
                );
                pages.push(emit::single(target, &emitted, None, heading, place)?);
            }
        }
    }
    if target.pages.len() > 1 && pages.len() > 1 {
        let target = target.name;
        let why = format!("-o takes one function for {target}: name one --method");
        return Err(RequestFault::conflict(why).into());
    }
    Ok(pages.join(&b"\n"[..]))
}

/// The functions of effects, one behind the other; what the method and the material do not change in its usual form.
fn effects(run: &Run, target: &'static Target) -> Result<Vec<u8>, Error> {
    let all = run.whole_effects()?;
    if target.finish == Finish::Spirv && all.len() > 1 {
        let why = format!("-o takes one effect for {}: name one --effect", target.name);
        return Err(RequestFault::conflict(why).into());
    }
    let mut pages = Vec::new();
    for (request, functions) in &all {
        let command = run.effect_command(target, request) + " -o -";
        pages.push(emit::effect_text(target, request, functions, &command)?);
    }
    Ok(pages.join(&b"\n"[..]))
}
