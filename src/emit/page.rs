//! The page around functions: a template of the target, rendered. Numbers reach it as text.

use serde::Serialize;
use tera::{Context, Tera};

use crate::ir::Param;
use crate::targets::{Finish, Page, Target};

use super::error::Error;
use super::function::Emitted;
use super::{print, wgsl};

/// What a template sees.
#[derive(Serialize)]
struct View<'a> {
    header: &'a [String],
    guard: &'a str,
    functions: Vec<FunctionView>,
    /// The run-time arguments of a library method, after `cos_theta`.
    parameters: Vec<ParameterView>,
}

#[derive(Serialize)]
struct FunctionView {
    /// Comments above it.
    doc: Vec<String>,
    head: String,
    body: Vec<String>,
    name: String,
    /// The entry point of a module that calls it.
    entry: String,
}

#[derive(Serialize)]
struct ParameterView {
    name: String,
    ty: &'static str,
}

/// A page to render.
pub struct Request<'a> {
    /// The language.
    pub target: &'static Target,
    /// Which of its pages.
    pub page: &'static Page,
    /// Lines of the head.
    pub header: &'a [String],
    /// The include guard's name, or nothing.
    pub guard: &'a str,
    /// The functions, each with the comments above it.
    pub functions: &'a [(Vec<String>, Emitted)],
    /// The name of the file, for messages.
    pub file: &'a str,
}

/// The bytes of a file.
pub fn render(request: &Request) -> Result<Vec<u8>, Error> {
    let wrong = |what: String| Error::Generated {
        file: request.file.to_owned(),
        what,
    };
    let mut tera = Tera::new();
    tera.add_raw_template("page", request.page.template)
        .map_err(|error| wrong(error.to_string()))?;
    let context =
        Context::from_serialize(&view(request)).map_err(|error| wrong(error.to_string()))?;
    let text = tera
        .render("page", &context)
        .map_err(|error| wrong(error.to_string()))?;
    let text = text.trim_end().to_owned() + "\n";
    match request.target.finish {
        Finish::Text => Ok(text.into_bytes()),
        Finish::ValidWgsl => wgsl::validate(&text)
            .map(|_| text.into_bytes())
            .map_err(wrong),
        Finish::Spirv => wgsl::spirv(&text).map_err(wrong),
    }
}

fn view<'a>(request: &'a Request) -> View<'a> {
    let functions = request.functions.iter().enumerate();
    let runtime = |param: &&Param| param.name != "cos_theta";
    let first = &request.functions[0].1.function;
    View {
        header: request.header,
        guard: request.guard,
        functions: functions
            .map(|(i, (doc, emitted))| function(request.target, i, doc, emitted))
            .collect(),
        parameters: first
            .params
            .iter()
            .filter(runtime)
            .map(|param| ParameterView {
                name: param.name.clone(),
                ty: request.target.spelling.ty(param.ty),
            })
            .collect(),
    }
}

fn function(target: &Target, index: usize, doc: &[String], emitted: &Emitted) -> FunctionView {
    FunctionView {
        doc: doc.to_vec(),
        head: print::head(&emitted.function, &emitted.name, &target.spelling),
        body: print::body(&emitted.function, &target.spelling),
        name: emitted.name.clone(),
        entry: entry_point(index, emitted),
    }
}

/// A module's entry points: `main` for its first function, the method's name for the others.
pub fn entry_point(index: usize, emitted: &Emitted) -> String {
    if index == 0 {
        "main".to_owned()
    } else {
        emitted.method.name.to_owned()
    }
}

/// The head of a file as comment lines of a language.
pub fn comments(target: &Target, lines: &[String]) -> Vec<String> {
    lines
        .iter()
        .map(|line| {
            format!("{} {line}", target.spelling.comment)
                .trim_end()
                .to_owned()
        })
        .collect()
}

/// The include guard of a file, where the language has a preprocessor.
pub fn guard(target: &Target, stem: &str) -> String {
    if !target.spelling.guard {
        return String::new();
    }
    format!("{stem}_{}", target.name).to_uppercase()
}
