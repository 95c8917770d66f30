//! Files: which functions stand together, under which name, with which details for the manifest. Also the errors of emission.

use super::comment;
use super::detail::{Detail, FunctionsDetail, functions_detail};
use super::figures::FILTERED;
use super::function::{EmittedFunction, FunctionForm, Naming};
use super::header::{Heading, OUTPUT_LICENCE};
use super::page::{PageRequest, comments, guard, render};
use crate::generator::fit::Measured;
use crate::generator::reference::MaterialInMedium;
use crate::language::ir::{Checked, Param, Ty};
use crate::language::methods::{self, Method, Values};
use crate::language::targets::{self, Finish, Page, Target};
use crate::physics::foreign::{Foreign, one_line};
use crate::physics::num::Precision;

/// A file of one target, in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// The path below the target's folder, with `/`.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The manifest's details of it.
    pub detail: Detail,
}

/// The library files of a method: one, or one per page for a target that writes modules.
///
/// # Errors
/// A function's name is a reserved word of a target, or naga refuses the text.
pub fn library(
    target: &'static Target,
    method: &'static Method,
    functions: &[EmittedFunction],
    heading: Heading,
) -> Result<Vec<File>, Error> {
    check_names(functions)?;
    let head = comments(target, &heading.library(target, method, functions));
    let plain: Vec<(Vec<String>, EmittedFunction)> = written_for(target, functions.to_vec())
        .map(|f| (Vec::new(), f))
        .collect();
    let stem = functions[0].name.clone();
    target
        .pages
        .iter()
        .map(|page| {
            let (name, bytes) = rendered(target, page, &stem, &stem, &head, &plain)?;
            let detail = Detail::Functions(Box::new(listed(target, &plain, heading)));
            Ok(File {
                name,
                bytes,
                detail,
            })
        })
        .collect()
}

/// The functions of a method that a target writes. A module returns a colour, so it has no scalar form.
pub fn written_for(
    target: &Target,
    functions: Vec<EmittedFunction>,
) -> impl Iterator<Item = EmittedFunction> {
    let modules = target.finish == Finish::Spirv;
    functions
        .into_iter()
        .filter(move |function| !modules || function.function.ty() != Ty::Scalar)
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
) -> Result<Vec<File>, Error> {
    check_names(functions)?;
    let head = comments(target, &heading.material(target, subject, naming.precision));
    let documented: Vec<(Vec<String>, EmittedFunction)> = functions
        .iter()
        .map(|f| (comments(target, &heading.specialised(f)), f.clone()))
        .collect();
    let name = naming.material(subject);
    let stem = format!("materials/{name}");
    let unique = format!("{}{name}_material", naming.prefix);
    target
        .pages
        .iter()
        .map(|page| {
            let (name, bytes) = rendered(target, page, &stem, &unique, &head, &documented)?;
            let detail = listed(target, &documented, heading).of_material(subject);
            let detail = Detail::Functions(Box::new(detail));
            Ok(File {
                name,
                bytes,
                detail,
            })
        })
        .collect()
}

/// The place of a function in a text of several. Only the first holds directives such as `enable f16;`: no code may precede them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceInFile {
    /// At its beginning.
    First,
    /// After another function.
    Later,
}

impl PlaceInFile {
    /// The place after these pages.
    pub fn behind(pages: &[Vec<u8>]) -> PlaceInFile {
        match pages {
            [] => PlaceInFile::First,
            _ => PlaceInFile::Later,
        }
    }
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
    place: PlaceInFile,
) -> Result<Vec<u8>, Error> {
    check_names(std::slice::from_ref(emitted))?;
    let head = comments(target, &heading.pasted(target, emitted, subject));
    let functions = [(Vec::new(), emitted.clone())];
    let request = PageRequest {
        target,
        page: &target.pages[0],
        header: &head,
        guard: "",
        functions: &functions,
        file: &emitted.name,
    };
    let bytes = render(&request)?;
    Ok(match place {
        PlaceInFile::First => bytes,
        PlaceInFile::Later => without(bytes, target.directive_in(emitted.precision)),
    })
}

/// A page without the line of its directive. The page was validated with it.
fn without(bytes: Vec<u8>, directive: &str) -> Vec<u8> {
    if directive.is_empty() {
        return bytes;
    }
    let text = String::from_utf8_lossy(&bytes);
    text.replacen(&format!("\n{directive}\n"), "", 1)
        .into_bytes()
}

/// The file of a function that reads a baked table, with a head made of the table's own description.
///
/// # Errors
/// The function's name is a reserved word of a target, or naga refuses the text.
pub fn lookup(
    target: &'static Target,
    name: String,
    function: Checked,
    about: Vec<String>,
) -> Result<Vec<u8>, Error> {
    let emitted = EmittedFunction {
        name,
        method: methods::find("table").expect("the method of every table is registered"),
        effect: None,
        form: FunctionForm::Library,
        precision: Precision::F32,
        function,
        constants: Values::new(),
        model_error: None,
        code: Measured::No(FILTERED.to_owned()),
        plain_for: None,
        written_as: None,
        missed: None,
    };
    check_names(std::slice::from_ref(&emitted))?;
    let licence = format!("Licence of this file: {}", OUTPUT_LICENCE);
    let about = about.into_iter().chain([licence]).collect();
    let head = comments(target, &comment::lines(about));
    let guard = guard(target, &emitted.name);
    let file = emitted.name.clone();
    render(&PageRequest {
        target,
        page: &target.pages[0],
        header: &head,
        guard: &guard,
        functions: &[(Vec::new(), emitted)],
        file: &file,
    })
}

fn rendered(
    target: &'static Target,
    page: &'static Page,
    stem: &str,
    unique: &str,
    head: &[String],
    functions: &[(Vec<String>, EmittedFunction)],
) -> Result<(String, Vec<u8>), Error> {
    let name = format!("{stem}{}.{}", page.suffix, target.extension);
    let guard = guard(target, unique);
    let bytes = render(&PageRequest {
        target,
        page,
        header: head,
        guard: &guard,
        functions,
        file: &name,
    })?;
    Ok((name, bytes))
}

/// The manifest's details of these functions.
fn listed(
    target: &Target,
    functions: &[(Vec<String>, EmittedFunction)],
    heading: Heading,
) -> FunctionsDetail {
    let functions: Vec<&EmittedFunction> = functions.iter().map(|(_, emitted)| emitted).collect();
    functions_detail(target, &functions, heading.command)
}

/// The byte offsets, in the uniform block, of the numbers that a function takes after `cos_theta`. The layout is WGSL's, which is
/// std140's for these types.
pub fn uniform_offsets(params: &[Param]) -> Vec<usize> {
    let mut end = 0usize;
    let numbers = params.iter().filter(|param| is_number(param));
    let place = |param: &Param| {
        let (size, align) = if param.ty == Ty::Rgb {
            (12, 16)
        } else {
            (4, 4)
        };
        let offset = end.next_multiple_of(align);
        end = offset + size;
        offset
    };
    numbers.map(place).collect()
}

/// Whether a parameter lies in a module's uniform block: it is neither the cosine nor a texture.
pub(super) fn is_number(param: &Param) -> bool {
    param.ty != Ty::Texture && !param.is_cosine()
}

/// Checks that names are free in every language, since a function has the same name in all. Here names are complete, with their
/// prefix.
pub(super) fn check_names(functions: &[EmittedFunction]) -> Result<(), Error> {
    for emitted in functions {
        let fault = crate::physics::names::identifier_fault(&emitted.name)
            .map(|why| format!("`{}` is no name: {why}", emitted.name))
            .or_else(|| targets::name_fault(&emitted.name));
        if let Some(what) = fault {
            return Err(Error::Name { what });
        }
    }
    Ok(())
}

/// An error of emission.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A name cannot be used in a language, because of the prefix.
    #[error("{}; choose another --prefix", one_line(what))]
    Name {
        /// The name and why.
        what: String,
    },
    /// A method cannot be specialised to a material.
    #[error(
        "method `{}` cannot be specialised to `{}`: {}",
        Foreign(method),
        Foreign(material),
        one_line(what)
    )]
    Specialise {
        /// The method.
        method: String,
        /// The material.
        material: String,
        /// Why not.
        what: String,
    },
    /// A bug: the generated text is not valid in its language.
    #[error("this is a bug in fresnel-gen: {}: {}", Foreign(file), one_line(what))]
    Generated {
        /// The file.
        file: String,
        /// What a checker said.
        what: String,
    },
}
