//! The page around functions: a template of the target, rendered. Numbers reach it as text.
//!
//! naga parses and validates WGSL in process, and generates SPIR-V from it.

use std::collections::BTreeSet;

use naga::back::spv;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use serde::Serialize;
use tera::{Context, Tera};

use super::batch::batch_entry;
use super::error::Error;
use super::function::{EmittedFunction, FunctionForm};
use super::print;
use crate::language::ir::{Param, Ty};
use crate::language::targets::{Finish, Page, Target};
use crate::physics::num::Precision;

/// The data of a template.
#[derive(Serialize)]
struct PageView<'a> {
    /// Lines of the head.
    header: &'a [String],
    /// The include guard's name; empty if there is none.
    guard: &'a str,
    /// The directive that must precede all code.
    directive: &'a str,
    /// The functions in their order.
    functions: Vec<FunctionView<'a>>,
    /// The numbers that a library method takes after `cos_theta`.
    parameters: Vec<ParameterView<'a>>,
    /// The textures that the functions read.
    textures: BTreeSet<&'a str>,
}

#[derive(Serialize)]
struct FunctionView<'a> {
    /// Comments above it.
    doc: &'a [String],
    /// Its signature, without a brace.
    head: String,
    /// The lines of its body.
    body: Vec<String>,
    /// The entry point of a module that calls it.
    entry: String,
    /// How a module calls it. `cos_theta`, the numbers of the module's block and the result are f32.
    call: String,
}

#[derive(Serialize)]
struct ParameterView<'a> {
    name: &'a str,
    ty: &'static str,
}

impl<'a> FunctionView<'a> {
    fn new(target: &Target, index: usize, (doc, emitted): &'a Documented) -> FunctionView<'a> {
        let spelling = target.spelling_in(emitted.precision);
        FunctionView {
            doc,
            head: print::shown_head(&emitted.function, &emitted.name, spelling),
            body: print::shown_body(&emitted.function, spelling),
            entry: entry_point(index, emitted),
            call: call(target, emitted),
        }
    }
}

/// A function, and the comments above it.
pub type Documented<'a> = (Vec<String>, &'a EmittedFunction);

/// A page to render.
pub struct PageRequest<'a> {
    /// The language.
    pub target: &'static Target,
    /// The page of that target.
    pub page: &'static Page,
    /// Lines of the head.
    pub header: &'a [String],
    /// The include guard's name; empty if there is none.
    pub guard: &'a str,
    /// The functions.
    pub functions: &'a [Documented<'a>],
    /// The name of the file, for messages.
    pub file: &'a str,
}

impl<'a> PageRequest<'a> {
    /// The functions on the first page of a target, without a head and a guard.
    pub fn new(target: &'static Target, functions: &'a [Documented<'a>], file: &'a str) -> Self {
        PageRequest {
            target,
            page: &target.pages[0],
            header: &[],
            guard: "",
            functions,
            file,
        }
    }

    /// The bytes of a file.
    pub fn render(&self) -> Result<Vec<u8>, Error> {
        let (target, first) = (self.target, self.functions[0].1);
        let params = || {
            self.functions
                .iter()
                .flat_map(|(_, one)| &one.function.params)
        };
        let mut numbers: Vec<&Param> = Vec::new();
        for param in params().filter(|param| is_number(param)) {
            if !numbers.contains(&param) {
                numbers.push(param);
            }
        }
        let textures = params().filter(|param| param.ty == Ty::Texture);
        let functions = self.functions.iter().enumerate();
        let view = PageView {
            header: self.header,
            guard: self.guard,
            directive: target.directive_in(first.precision),
            functions: functions
                .map(|(i, one)| FunctionView::new(target, i, one))
                .collect(),
            textures: textures.map(|param| param.name.as_str()).collect(),
            parameters: numbers
                .into_iter()
                .map(|param| ParameterView {
                    name: &param.name,
                    ty: target.spelling.ty(param.ty),
                })
                .collect(),
        };
        render_template(self.page.template, &view, target.finish, self.file)
    }
}

/// Functions without a head and without comments above them.
///
/// # Errors
/// The language refuses the text: a bug.
pub fn bare_text(target: &'static Target, functions: &[EmittedFunction]) -> Result<String, Error> {
    let plain: Vec<Documented> = functions.iter().map(|one| (Vec::new(), one)).collect();
    let bytes = PageRequest::new(target, &plain, &functions[0].name).render()?;
    Ok(String::from_utf8_lossy(&bytes).trim_start().to_owned())
}

/// The bytes of a template with its data. The file's name is for messages.
///
/// # Errors
/// The template is wrong, or the language refuses the text: a bug.
pub fn render_template(
    template: &str,
    view: &impl Serialize,
    finish: Finish,
    file: &str,
) -> Result<Vec<u8>, Error> {
    let tera = |fault: tera::Error| Error::generated(file, fault);
    let mut templates = Tera::new();
    templates.add_raw_template("page", template).map_err(tera)?;
    let context = Context::from_serialize(view).map_err(tera)?;
    let text = templates.render("page", &context).map_err(tera)?;
    let text = text.trim_end().to_owned() + "\n";
    let bytes = match finish {
        Finish::Text => return Ok(text.into_bytes()),
        Finish::ValidWgsl => validate(&text).map(|_| text.into_bytes()),
        Finish::Spirv => spirv(&text),
    };
    bytes.map_err(|fault| Error::generated(file, fault))
}

/// Whether a parameter lies in a module's uniform block: it is neither the cosine nor a texture.
pub(super) fn is_number(param: &Param) -> bool {
    param.ty != Ty::Texture && !param.is_cosine()
}

/// The byte offsets, in the uniform block, of the numbers that a function takes after `cos_theta`. The layout is WGSL's, which is
/// std140's for these types.
pub fn uniform_offsets(params: &[Param]) -> Vec<usize> {
    let mut end = 0usize;
    let numbers = params.iter().filter(|param| is_number(param));
    let place = |param: &Param| {
        let (size, align) = if param.ty == Ty::Vec3 {
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

/// How a module's entry point calls a function: numbers lie in its block, textures and samplers beside it.
fn call(target: &Target, emitted: &EmittedFunction) -> String {
    let narrow = |ty: Ty, value: String| match emitted.precision {
        Precision::F32 => value,
        Precision::F16 => format!("{}({value})", target.half.spelling.ty(ty)),
    };
    let argument = |param: &Param| match param.ty {
        Ty::Texture => format!("{0}_texture, {0}_filter", param.name),
        ty if param.is_cosine() => narrow(ty, param.name.clone()),
        ty => narrow(ty, format!("parameters.{}", param.name)),
    };
    let params = emitted.function.params.iter();
    let arguments: Vec<String> = params.map(argument).collect();
    let call = format!("{}({})", emitted.name, arguments.join(", "));
    match emitted.precision {
        Precision::F32 => call,
        Precision::F16 => format!("{}({call})", target.spelling.ty(emitted.function.ty())),
    }
}

/// A module's entry points: `main` for its first function, `average` for a mean over the hemisphere, `c0` and so on for
/// coefficients, and the method's name for others. An effect's are named after its functions.
pub fn entry_point(index: usize, emitted: &EmittedFunction) -> String {
    match emitted.form {
        _ if emitted.effect.is_some() => batch_entry(&emitted.name),
        _ if index == 0 => "main".to_owned(),
        form if form == FunctionForm::Average || form.coefficient().is_some() => {
            form.name().to_owned()
        }
        _ => emitted.method.name.to_owned(),
    }
}

/// The head of a file as comment lines of a language.
pub fn comments(target: &Target, lines: &[String]) -> Vec<String> {
    let comment = |line| format!("{} {line}", target.spelling.comment);
    let lines = lines.iter().map(comment);
    lines.map(|line| line.trim_end().to_owned()).collect()
}

/// The include guard of a file; empty unless the language has a preprocessor.
pub fn guard(target: &Target, stem: &str) -> String {
    if !target.spelling.guard {
        return String::new();
    }
    format!("{stem}_{}", target.name).to_uppercase()
}

/// Parses and validates a module. On failure, the error is naga's message, with the line.
///
/// # Errors
/// The text is not valid WGSL.
pub fn validate(text: &str) -> Result<(naga::Module, ModuleInfo), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    // f16 is allowed only in files that say `enable f16;`; every file may unpack halves (`unpack2x16float`).
    let halves = Capabilities::SHADER_FLOAT16 | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    let mut validator = Validator::new(ValidationFlags::all(), halves);
    let info = validator
        .validate(&module)
        .map_err(|error| error.emit_to_string(text))?;
    Ok((module, info))
}

/// Translates a module to SPIR-V 1.3, with names for human readers, as little-endian bytes.
pub fn spirv(text: &str) -> Result<Vec<u8>, String> {
    Ok(bytes(&without_storage(&words(text)?)))
}

/// The same for a module that stores 16-bit numbers in buffers.
///
/// # Errors
/// The text is not valid WGSL, or naga cannot write SPIR-V of it.
pub fn spirv_with_storage(text: &str) -> Result<Vec<u8>, String> {
    Ok(bytes(&words(text)?))
}

fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn words(text: &str) -> Result<Vec<u32>, String> {
    let (module, info) = validate(text)?;
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::DEBUG | spv::WriterFlags::LABEL_VARYINGS,
        use_storage_input_output_16: false,
        ..Default::default()
    };
    spv::write_vec(&module, &info, &options, None).map_err(|error| error.to_string())
}

/// Removes the capabilities to store 16-bit numbers in buffers, which naga adds whenever something computes with them. Our
/// modules hold them only in registers, so a device without these capabilities can run them.
fn without_storage(words: &[u32]) -> Vec<u32> {
    const HEAD: usize = 5;
    const EXTENSION: u32 = 10;
    const CAPABILITY: u32 = 17;
    const STORAGE: [u32; 2] = [4433, 4434];
    let mut kept = words[..HEAD.min(words.len())].to_vec();
    let mut rest = &words[kept.len()..];
    while let Some(first) = rest.first() {
        let length = ((first >> 16) as usize).clamp(1, rest.len());
        let (instruction, after) = rest.split_at(length);
        let is_storage = match first & 0xffff {
            CAPABILITY => STORAGE.contains(&instruction[length - 1]),
            EXTENSION => literal(&instruction[1..]) == "SPV_KHR_16bit_storage",
            _ => false,
        };
        if !is_storage {
            kept.extend(instruction);
        }
        rest = after;
    }
    kept
}

/// A string of SPIR-V, which ends in a zero.
fn literal(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let text = bytes.take_while(|byte| *byte != 0).map(char::from);
    text.collect()
}
