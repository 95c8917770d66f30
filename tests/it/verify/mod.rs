//! The verifier verified: what is right passes, what is wrong is seen, on every target.

mod command;
mod half;
mod mutants;

use fresnel_gen::app::{Request, Source, request::Materials};
use fresnel_gen::emit::Subject;

/// Materials of the catalogue, seen as they are unless asked otherwise.
pub fn subjects(names: &[&str]) -> Vec<Subject> {
    let named = |name: &&str| Source::Named((*name).to_owned());
    let request = Request {
        materials: Materials::These(names.iter().map(named).collect()),
        ..Request::default()
    };
    let ready = request.subjects().unwrap().ready;
    ready.into_iter().map(|(subject, _)| subject).collect()
}
