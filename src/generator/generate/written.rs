//! Which methods are written: those asked for, those that a file holds already, and in half precision those that it can bear.

use crate::generator::error::Error;
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::Request;
use crate::language::methods::{self, InHalf, Method};
use crate::language::targets::Target;

use crate::generator::generate::{Kept, Run};

type Named<'a> = Option<&'a [&'static Method]>;

/// The methods of library files: where each material's function is chosen only those that are named.
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

/// The methods whose library file is asked for and not written, with the reason.
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

/// The methods that a material's file holds unless others are asked for.
pub fn usual(request: &Request, subject: &MaterialInMedium) -> Vec<&'static str> {
    let mut usual = subject.default_methods();
    usual.retain(|name| is_written(request, name));
    usual
}

/// The methods asked for of a material: the one that a budget chose, those named, or the usual ones.
pub fn named_or(run: &Run, material: &str, usual: &[&'static str]) -> Vec<&'static str> {
    if let Some(chosen) = run.request.chosen.get(material) {
        return vec![*chosen];
    }
    match &run.named {
        Some(named) => named.iter().map(|method| method.name).collect(),
        None => usual.to_vec(),
    }
}

/// The methods of a material's file, the exact one first.
pub fn methods_of(
    run: &Run,
    target: &Target,
    subject: &MaterialInMedium,
    kept: &Kept,
) -> Vec<&'static str> {
    let usual = usual(run.request, subject);
    let file = (target.name.to_owned(), subject.name.clone());
    let exactly = run.held.and_then(|held| held.methods.get(&file));
    let mut chosen = match exactly {
        Some(_) => Vec::new(),
        None => named_or(run, &subject.name, &usual),
    };
    chosen.retain(|name| is_written(run.request, name));
    let kept = exactly.or_else(|| kept.get(&file)).into_iter().flatten();
    chosen.extend(kept.filter_map(|name| methods::find(name)).map(|m| m.name));
    let rank = |name: &str| {
        let place = usual.iter().position(|other| *other == name);
        place.unwrap_or(usual.len())
    };
    chosen.sort_by(|a, b| rank(a).cmp(&rank(b)).then(a.cmp(b)));
    chosen.dedup();
    chosen
}

/// Whether a method is written for materials.
pub fn is_written(request: &Request, name: &str) -> bool {
    let method = methods::find(name);
    method.is_none_or(|method| request.refusal(method, false).is_none())
}

/// Refuses methods that were named and cannot be written in the precision of the request.
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
            return Err(Error::Usage { what });
        }
    }
    Ok(())
}
