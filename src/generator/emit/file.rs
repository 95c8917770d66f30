//! Files of functions: which stand together, under which name, with which details for the manifest.

use super::artifact::{Artifact, Detail, FunctionsDetail};
use super::code_bound::FILTERED;
use super::comment;
use super::error::Error;
use super::function::{EmittedFunction, FunctionForm, Naming, check_names};
use super::header::{Heading, licence_line};
use super::page::{Documented, PageRequest, comments, guard};
use crate::generator::fit::Measured;
use crate::generator::reference::MaterialInMedium;
use crate::language::ir::{Checked, Ty};
use crate::language::methods::{self, Method};
use crate::language::targets::{Finish, Page, Target};
use crate::physics::num::Precision;

/// The library files of a method: one, or one per page for a target that writes modules.
///
/// # Errors
/// A function's name is a reserved word of a target, or naga refuses the text.
pub fn library(
    target: &'static Target,
    method: &'static Method,
    functions: &[EmittedFunction],
    heading: Heading,
) -> Result<Vec<Artifact>, Error> {
    check_names(functions)?;
    let head = comments(target, &heading.library(target, method, functions));
    let written = functions.iter().filter(|one| is_written(target, one));
    let plain: Vec<Documented> = written.map(|one| (Vec::new(), one)).collect();
    let stem = &functions[0].name;
    let detail = FunctionsDetail::new(target, &plain, heading.command);
    let mut files = pages(target, [stem, stem], &head, &plain, &detail)?;
    for file in &mut files {
        file.method = Some(method.name.to_owned());
    }
    Ok(files)
}

/// The functions of a method that a target writes. A module returns a colour, so it has no scalar form.
pub fn written_for(
    target: &Target,
    functions: Vec<EmittedFunction>,
) -> impl Iterator<Item = EmittedFunction> {
    functions.into_iter().filter(|one| is_written(target, one))
}

fn is_written(target: &Target, function: &EmittedFunction) -> bool {
    target.finish != Finish::Spirv || function.function.ty() != Ty::Scalar
}

/// The files of a material, with all its functions.
///
/// # Errors
/// A function's name is a reserved word of a target, or naga refuses the text.
pub fn material(
    target: &'static Target,
    subject: &MaterialInMedium,
    functions: &[EmittedFunction],
    naming: &Naming,
    heading: Heading,
) -> Result<Vec<Artifact>, Error> {
    check_names(functions)?;
    let head = comments(target, &heading.material(target, subject, naming.precision));
    let documented: Vec<Documented> = functions
        .iter()
        .map(|one| (comments(target, &heading.specialised(one)), one))
        .collect();
    let name = naming.material(subject);
    let stem = format!("materials/{name}");
    let unique = format!("{}{name}_material", naming.prefix);
    let detail = FunctionsDetail::new(target, &documented, heading.command).of_material(subject);
    let mut files = pages(target, [&stem, &unique], &head, &documented, &detail)?;
    for file in &mut files {
        file.material = Some(subject.name.clone());
    }
    Ok(files)
}

/// A file for each page of a target. `stem` is the name without the page's suffix, `unique` that of its include guard.
fn pages(
    target: &'static Target,
    [stem, unique]: [&str; 2],
    head: &[String],
    functions: &[Documented],
    detail: &FunctionsDetail,
) -> Result<Vec<Artifact>, Error> {
    let guard = guard(target, unique);
    let file = |page: &'static Page| {
        let name = format!("{stem}{}.{}", page.suffix, target.extension);
        let request = PageRequest {
            page,
            header: head,
            guard: &guard,
            ..PageRequest::new(target, functions, &name)
        };
        let detail = Detail::Functions(Box::new(detail.clone()));
        let path = format!("{}/{name}", target.name);
        Ok(Artifact::new(target.name, path, request.render()?, detail))
    };
    target.pages.iter().map(file).collect()
}

/// One function for pasting: no guard, no includes.
///
/// # Errors
/// The function's name is a reserved word of a target, or naga refuses the text.
pub fn single(
    target: &'static Target,
    emitted: &EmittedFunction,
    subject: Option<&MaterialInMedium>,
    heading: Heading,
) -> Result<Vec<u8>, Error> {
    check_names(std::slice::from_ref(emitted))?;
    let functions = [(Vec::new(), emitted)];
    let request = PageRequest {
        header: &comments(target, &heading.pasted(target, emitted, subject)),
        ..PageRequest::new(target, &functions, &emitted.name)
    };
    request.render()
}

/// A function for pasting without the line of its directive. It was validated with it.
pub fn without_directive(target: &Target, precision: Precision, page: Vec<u8>) -> Vec<u8> {
    match target.directive_in(precision) {
        "" => page,
        directive => String::from_utf8_lossy(&page)
            .replacen(&format!("\n{directive}\n"), "", 1)
            .into_bytes(),
    }
}

/// The file of a function that reads a baked table, with a head made of the table's own description.
///
/// # Errors
/// The function's name is a reserved word of a target, or naga refuses the text.
pub fn lookup(
    target: &'static Target,
    name: String,
    function: Checked,
    mut about: Vec<String>,
) -> Result<Vec<u8>, Error> {
    let method = methods::find("table").expect("the method of every table is registered");
    let code = Measured::No(FILTERED.to_owned());
    let emitted = EmittedFunction::new(name, method, FunctionForm::Library, function, code);
    check_names(std::slice::from_ref(&emitted))?;
    about.push(licence_line());
    let functions = [(Vec::new(), &emitted)];
    let request = PageRequest {
        header: &comments(target, &comment::lines(about)),
        guard: &guard(target, &emitted.name),
        ..PageRequest::new(target, &functions, &emitted.name)
    };
    request.render()
}
