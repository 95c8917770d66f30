//! Files: which functions stand together, under which name, with which details for the manifest.

use serde_json::{Value, json};

use crate::fit::Measured;
use crate::ir::{Checked, Param, Ty};
use crate::methods::{self, Method, Values};
use crate::num::Precision;
use crate::reference::By;
use crate::targets::{self, Finish, Page, Target};

use super::average::Average;
use super::bounds::CodeBound;
use super::comment;
use super::error::Error;
use super::function::{Emitted, Naming};
use super::page::{Request, comments, entry_point, guard, render};
use super::{header, print};
use crate::reference::Subject;

/// A file of one target, in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// Below the target's folder, with `/`.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// What the manifest says of it.
    pub detail: Value,
}

/// The library files of a method: one, or one for each page of a target that writes modules.
///
/// # Errors
/// A function's name is a reserved word of a target, or naga refuses the text.
pub fn library(
    target: &'static Target,
    method: &'static Method,
    functions: &[Emitted],
    command: &str,
) -> Result<Vec<File>, Error> {
    check_names(functions)?;
    let head = comments(target, &header::library(target, method, functions, command));
    let plain: Vec<(Vec<String>, Emitted)> = written_for(target, functions.to_vec())
        .map(|f| (Vec::new(), f))
        .collect();
    let stem = functions[0].name.clone();
    target
        .pages
        .iter()
        .map(|page| file(target, page, &stem, &stem, &head, &plain, command))
        .collect()
}

/// The functions of a method that a target writes: a module returns a colour, so that it has no scalar form.
pub fn written_for(target: &Target, functions: Vec<Emitted>) -> impl Iterator<Item = Emitted> {
    let modules = target.finish == Finish::Spirv;
    functions
        .into_iter()
        .filter(move |function| !modules || function.function.ty() != Ty::Scalar)
}

/// The files of a material: its functions together.
///
/// # Errors
/// A function's name is a reserved word of a target, or naga refuses the text.
pub fn material(
    target: &'static Target,
    subject: &Subject,
    functions: &[Emitted],
    naming: &Naming,
    command: &str,
) -> Result<Vec<File>, Error> {
    check_names(functions)?;
    let head = comments(
        target,
        &header::material(target, subject, naming.precision, command),
    );
    let documented: Vec<(Vec<String>, Emitted)> = functions
        .iter()
        .map(|f| (comments(target, &header::specialised(f)), f.clone()))
        .collect();
    let name = format!("{}{}", subject.name, naming.precision.suffix());
    let stem = format!("materials/{name}");
    let unique = format!("{}{name}_material", naming.prefix);
    target
        .pages
        .iter()
        .map(|page| {
            let mut file = file(target, page, &stem, &unique, &head, &documented, command)?;
            file.detail["seen"] = seen(subject);
            Ok(file)
        })
        .collect()
}

/// What the manifest says of how a material is seen: its modules have no head to say it in.
fn seen(subject: &Subject) -> Value {
    let surface = &subject.truth.surface;
    let effective = &subject.effective;
    json!({
        "truth": surface.seen, "extrapolated": surface.held(),
        "n": effective.channels.n, "k": effective.channels.k, "nk_by": effective.by.map(By::text),
    })
}

/// Where a function stands in a text of several. Directives such as `enable f16;` stand in the first only: no code may be before them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// At its beginning.
    First,
    /// After another function.
    Later,
}

impl Place {
    /// The place behind these pages.
    pub fn behind(pages: &[Vec<u8>]) -> Place {
        match pages {
            [] => Place::First,
            _ => Place::Later,
        }
    }
}

/// One function with a short head, to be pasted: no guard, no includes.
///
/// # Errors
/// The function's name is a reserved word of a target, or naga refuses the text.
pub fn single(
    target: &'static Target,
    emitted: &Emitted,
    subject: Option<&Subject>,
    command: &str,
    place: Place,
) -> Result<Vec<u8>, Error> {
    check_names(std::slice::from_ref(emitted))?;
    let head = comments(target, &header::brief(target, emitted, subject, command));
    let functions = [(Vec::new(), emitted.clone())];
    let request = Request {
        target,
        page: &target.pages[0],
        header: &head,
        guard: "",
        functions: &functions,
        file: &emitted.name,
    };
    let bytes = render(&request)?;
    Ok(match place {
        Place::First => bytes,
        Place::Later => without(bytes, target.directive_in(emitted.precision)),
    })
}

/// A page without the line of its directive: it was validated with it.
fn without(bytes: Vec<u8>, directive: &str) -> Vec<u8> {
    if directive.is_empty() {
        return bytes;
    }
    let text = String::from_utf8_lossy(&bytes);
    text.replacen(&format!("\n{directive}\n"), "", 1)
        .into_bytes()
}

/// The file of a function that reads a baked table, below a head made of what the table says of itself.
///
/// # Errors
/// The function's name is a reserved word of a target, or naga refuses the text.
pub fn lookup(
    target: &'static Target,
    name: String,
    function: Checked,
    about: Vec<String>,
) -> Result<Vec<u8>, Error> {
    let emitted = Emitted {
        name,
        method: methods::find("table").expect("the method of every table is registered"),
        form: "lookup",
        precision: Precision::F32,
        function,
        constants: Values::new(),
        model_error: None,
        code: Measured::No(header::FILTERED.to_owned()),
        plain_for: None,
        written_as: None,
        missed: None,
    };
    check_names(std::slice::from_ref(&emitted))?;
    let licence = format!("Licence of this file: {}", header::OUTPUT_LICENCE);
    let about = about.into_iter().chain([licence]).collect();
    let head = comments(target, &comment::lines(about));
    let guard = guard(target, &emitted.name);
    let file = emitted.name.clone();
    render(&Request {
        target,
        page: &target.pages[0],
        header: &head,
        guard: &guard,
        functions: &[(Vec::new(), emitted)],
        file: &file,
    })
}

fn file(
    target: &'static Target,
    page: &'static Page,
    stem: &str,
    unique: &str,
    head: &[String],
    functions: &[(Vec<String>, Emitted)],
    command: &str,
) -> Result<File, Error> {
    let name = format!("{stem}{}.{}", page.suffix, target.extension);
    let guard = guard(target, unique);
    let bytes = render(&Request {
        target,
        page,
        header: head,
        guard: &guard,
        functions,
        file: &name,
    })?;
    let details: Vec<Value> = functions
        .iter()
        .enumerate()
        .map(|(i, (_, f))| detail(target, i, f))
        .collect();
    let mut about = json!({ "command": command, "functions": details });
    let precision = functions[0].1.precision;
    if precision.is_half() {
        about["precision"] = json!(precision.name());
    }
    Ok(File {
        name,
        bytes,
        detail: about,
    })
}

/// What the manifest says of a function.
fn detail(target: &Target, index: usize, emitted: &Emitted) -> Value {
    let mut value = json!({
        "name": emitted.name,
        "method": emitted.method.name,
        "form": emitted.form,
        "signature": print::head(&emitted.function, &emitted.name, target.spelling_in(emitted.precision)),
        "parameters": parameters(emitted),
        "operations": emitted.function.work(),
        "fetches": emitted.function.fetches(),
        "code_error": match &emitted.code {
            Measured::Yes(CodeBound::Ulp(ulp)) => json!({ "max_ulp": ulp }),
            Measured::Yes(CodeBound::Absolute(most)) => json!({ "max_abs": most }),
            Measured::No(reason) if emitted.precision.is_half() => {
                json!({ "max_abs": null, "reason": reason })
            }
            Measured::No(reason) => json!({ "max_ulp": null, "reason": reason }),
        },
        "licence": header::OUTPUT_LICENCE,
    });
    if let Some(error) = &emitted.model_error {
        value["model_error"] = json!(error);
        if error.mean_rel.is_none() {
            value["model_error"]["reason"] =
                json!("a channel reflects nothing, so that no relative error is defined");
        }
    }
    if let Some(missed) = &emitted.missed {
        value["misses_its_class"] = missed.json();
    }
    if let Some(average) = Average::of(emitted) {
        value["average"] = json!(average.given);
        value["average_unlimited"] = json!(average.unlimited);
    }
    if target.finish == Finish::Spirv {
        value["entry_point"] = json!(entry_point(index, emitted));
        value["uniforms"] = uniforms(emitted);
    }
    value
}

/// A library function's run-time arguments with what they are; a specialised one's constants per channel, null where a
/// channel has none (gold's green has no lambda).
fn parameters(emitted: &Emitted) -> Value {
    if emitted.constants.is_empty() {
        let rows = emitted.method.inputs.iter();
        let domain = |i| emitted.method.range(i, emitted.precision).words();
        return rows
            .map(|i| json!({ "name": i.name, "meaning": i.meaning, "domain": domain(i) }))
            .collect();
    }
    let cell = |name: &str, value: f64| {
        if name == "lambda" && value <= 0.0 {
            Value::Null
        } else {
            json!(value)
        }
    };
    let row = |(name, values): (&String, &[f64; 3])| {
        (name.clone(), json!(values.map(|value| cell(name, value))))
    };
    Value::Object(emitted.constants.iter().map(row).collect())
}

/// The uniform block of a module: name, type and offset in bytes of each run-time argument.
fn uniforms(emitted: &Emitted) -> Value {
    let params = &emitted.function.params;
    let numbers = params.iter().filter(|param| is_number(param));
    let row = |(param, offset): (&Param, usize)| {
        let ty = if param.ty == Ty::Rgb { "vec3" } else { "float" };
        json!({ "name": param.name, "type": ty, "offset": offset })
    };
    numbers.zip(uniform_offsets(params)).map(row).collect()
}

/// Where the numbers that a function takes after `cos_theta` lie in its uniform block, in bytes: WGSL's layout, which is
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

/// Whether it stands in the uniform block of a module: it is neither the cosine nor a texture.
fn is_number(param: &Param) -> bool {
    param.ty != Ty::Texture && !param.is_cosine()
}

/// A name is whole here, with its prefix, and must be free in every language: the same function has one name in all.
fn check_names(functions: &[Emitted]) -> Result<(), Error> {
    for emitted in functions {
        let fault = crate::ir::identifier_fault(&emitted.name)
            .map(|why| format!("`{}` is no name: {why}", emitted.name))
            .or_else(|| targets::name_fault(&emitted.name));
        if let Some(what) = fault {
            return Err(Error::Name { what });
        }
    }
    Ok(())
}
