//! Which methods are written in the precision of a request: half precision cannot bear all of them.

use crate::app::error::Error;
use crate::app::request::Request;
use crate::emit::Subject;
use crate::methods::{self, InHalf, Method};

type Named<'a> = Option<&'a [&'static Method]>;

/// The methods of library files.
pub fn library_methods(request: &Request, named: Named) -> Vec<&'static Method> {
    let mut methods = named.unwrap_or(methods::ALL).to_vec();
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
pub fn usual(request: &Request, subject: &Subject) -> Vec<&'static str> {
    let mut usual = subject.default_methods();
    usual.retain(|name| is_written(request, name));
    usual
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
