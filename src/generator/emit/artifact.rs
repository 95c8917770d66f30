//! An artifact: one output file in memory, with the manifest's details of it: its command, its functions, and the viewing conditions
//! of a material. The rows are typed; only the manifest is JSON.

use std::collections::BTreeMap;

use serde::Serialize;

use super::average::{self, Average};
use super::code_bound::CodeBound;
use super::figures::promises;
use super::function::{EffectPart, EmittedFunction, FunctionForm};
use super::header::{OUTPUT_LICENCE, source, table_line};
use super::page::{Documented, entry_point, is_number, uniform_offsets};
use super::print;
use super::specialised::Missed;
use crate::generator::fit::{Measured, ModelError};
use crate::generator::reference::{IndexSource, MaterialInMedium};
use crate::language::ir::{Param, Ty};
use crate::language::methods::{Contract, Input};
use crate::language::targets::{Finish, Target};

/// One output file, and what the manifest says about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Artifact {
    /// Where it goes: relative to the output folder, parts separated by `/`.
    pub path: String,
    /// The file's content.
    pub bytes: Vec<u8>,
    /// The target that it is written for.
    pub target: String,
    /// The effect, in a file of effects.
    pub effect: Option<String>,
    /// In a library file, its method. In an effect's file, the method that computes R, unless it is the default.
    pub method: Option<String>,
    /// The material of a specialised file.
    pub material: Option<String>,
    /// Functions, parameters, errors.
    pub detail: Detail,
}

impl Artifact {
    /// A file that belongs to no effect, method or material.
    pub(in crate::generator) fn new(
        target: &str,
        path: String,
        bytes: Vec<u8>,
        detail: Detail,
    ) -> Artifact {
        Artifact {
            path,
            bytes,
            target: target.to_owned(),
            effect: None,
            method: None,
            material: None,
            detail,
        }
    }
}

/// The manifest's details of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Detail {
    /// For a file of functions.
    Functions(Box<FunctionsDetail>),
    /// For a file of the catalogue.
    Catalogue(CatalogueDetail),
    /// For a lookup table, or its description.
    Table(TableDetail),
    /// For a file of a flavour.
    Adapter(AdapterDetail),
}

impl Detail {
    /// The functions of the file.
    pub fn functions(&self) -> &[FunctionDetail] {
        match self {
            Detail::Functions(file) => &file.functions,
            Detail::Catalogue(_) | Detail::Table(_) | Detail::Adapter(_) => &[],
        }
    }

    /// The materials of an atlas or of the catalogue's buffer, in the order of its rows; empty for other files.
    pub fn row_materials(&self) -> &[String] {
        match self {
            Detail::Table(file) => &file.row_materials,
            Detail::Catalogue(file) => &file.row_materials,
            Detail::Functions(_) | Detail::Adapter(_) => &[],
        }
    }

    /// The viewing conditions of the material of a file of functions.
    pub fn seen(&self) -> Option<&ViewingDetail> {
        match self {
            Detail::Functions(file) => file.seen.as_ref(),
            Detail::Catalogue(_) | Detail::Table(_) | Detail::Adapter(_) => None,
        }
    }
}

/// The manifest's details of a file of functions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FunctionsDetail {
    /// The command that writes it.
    pub command: String,
    /// Its functions in order.
    pub functions: Vec<FunctionDetail>,
    /// Their precision; none for single precision.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub precision: Option<&'static str>,
    /// The viewing conditions of the material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen: Option<ViewingDetail>,
    /// The source of the material's indices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<DataDetail>,
}

/// The manifest's details of a file of the catalogue: an array of a language, `catalogue.json`, a buffer or a texture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CatalogueDetail {
    /// The command that writes it.
    pub command: String,
    /// The array's name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub array: Option<String>,
    /// The number of materials.
    pub materials: usize,
    /// The number of rows of the array or the buffer, four per material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<usize>,
    /// The materials in the order of the rows, in the entry of the buffer; empty for the other files.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub row_materials: Vec<String>,
    /// The viewing conditions of the materials, in words.
    pub seen: String,
    /// The licence of the file.
    pub licence: &'static str,
}

/// The manifest's details of a lookup table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableDetail {
    /// The command that writes it.
    pub command: String,
    /// The materials of an atlas, one per row, from row 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub row_materials: Vec<String>,
    /// The file that describes it.
    pub description: String,
    /// The licence of the file.
    pub licence: &'static str,
}

/// The manifest's details of a file of a flavour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AdapterDetail {
    /// The command that writes it.
    pub command: String,
    /// The host, with the version in which the adapter was tested.
    pub host: &'static str,
    /// The viewing conditions of the materials, in words.
    pub seen: String,
    /// The licence of the file.
    pub licence: &'static str,
}

/// The viewing conditions of a material: SPIR-V modules have no head to state them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewingDetail {
    /// What the reference reflectance is, in words.
    pub truth: String,
    /// In words, beyond which wavelengths its index was held constant; none if nowhere.
    pub extrapolated: Option<String>,
    /// The effective n of each channel.
    pub n: [f64; 3],
    /// The effective k of each channel.
    pub k: [f64; 3],
    /// How n and k were found.
    pub nk_by: [&'static str; 3],
}

/// The source of a material's indices.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DataDetail {
    /// The publication.
    pub reference: String,
    /// A link to it.
    pub link: String,
    /// The licence of the data.
    pub licence: String,
    /// How it was measured.
    pub conditions: String,
}

/// The manifest's details of a function.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FunctionDetail {
    /// Its name.
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    method: Option<&'static str>,
    form: FunctionForm,
    /// Its signature, as in the file.
    pub signature: String,
    parameters: Parameters,
    operations: usize,
    fetches: usize,
    code_error: CodeErrorDetail,
    licence: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    model_error: Option<ModelErrorDetail>,
    #[serde(skip_serializing_if = "Option::is_none")]
    misses_its_class: Option<Missed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    average: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    average_unlimited: Option<[f64; 3]>,
    /// The entry point, for a function of a module.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entry_point: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    uniforms: Option<Vec<UniformDetail>>,
    #[serde(flatten)]
    notes: Notes,
}

/// A library function's run-time arguments, or a specialised one's constants per channel. A constant is null where a channel has
/// none (gold's green has no lambda).
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Parameters {
    Arguments(Vec<ArgumentDetail>),
    Constants(BTreeMap<String, [Option<f64>; 3]>),
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct ArgumentDetail {
    name: &'static str,
    meaning: &'static str,
    domain: String,
}

impl ArgumentDetail {
    fn new(input: &Input, domain: String) -> ArgumentDetail {
        ArgumentDetail {
            name: input.name,
            meaning: input.meaning,
            domain,
        }
    }
}

/// A code error, or null with the reason why there is none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum CodeErrorDetail {
    Ulp { max_ulp: f64 },
    Absolute { max_abs: f64 },
    NoUlp { max_ulp: (), reason: String },
    NoAbsolute { max_abs: (), reason: String },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct ModelErrorDetail {
    #[serde(flatten)]
    error: ModelError,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// A run-time argument in the uniform block of a module, with its offset in bytes.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct UniformDetail {
    name: String,
    #[serde(rename = "type")]
    ty: &'static str,
    offset: usize,
}

/// What full headers say of a function besides its figures, and short ones do not.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Notes {
    formula: &'static [&'static str],
    source: String,
    /// Where it holds. For an effect, each argument says it.
    #[serde(skip_serializing_if = "Option::is_none")]
    domain: Option<&'static str>,
    /// For an effect's function: what it returns.
    #[serde(skip_serializing_if = "Option::is_none")]
    gives: Option<&'static str>,
    /// For an effect: where it must be wrong.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    wrong: Vec<&'static str>,
    /// For a method that is exempt from the contract of the others: where it fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    fails: Option<&'static str>,
    /// What a library function promises, one sentence each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    promises: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    written_as: Option<&'static str>,
    /// For a plain form: the operations of the stable one.
    #[serde(skip_serializing_if = "Option::is_none")]
    stable_operations: Option<usize>,
}

impl Notes {
    fn of_method(emitted: &EmittedFunction) -> Notes {
        let method = emitted.method;
        Notes {
            formula: method.formula,
            source: source(method),
            domain: Some(method.domain),
            fails: match method.contract {
                Contract::Kept => None,
                Contract::Exempt(why) => Some(why),
            },
            promises: match emitted.form {
                FunctionForm::Specialised => Vec::new(),
                _ => promises(emitted.precision, method),
            },
            mean: average::mean_line(emitted).or_else(|| average::coefficients_line(emitted)),
            table: table_line(emitted),
            written_as: emitted.written_as.map(|method| method.name),
            stable_operations: emitted.plain_for,
            ..Notes::default()
        }
    }

    fn of_effect(EffectPart { effect, function }: EffectPart) -> Notes {
        Notes {
            formula: effect.formula,
            source: format!("Source: {}", effect.source.line()),
            gives: Some(function.gives),
            wrong: effect.fails.to_vec(),
            ..Notes::default()
        }
    }
}

impl FunctionsDetail {
    /// The manifest's details of a file of these functions.
    pub(super) fn new(target: &Target, functions: &[Documented], command: &str) -> Self {
        let precision = functions[0].1.precision;
        let functions = functions.iter().enumerate();
        FunctionsDetail {
            command: command.to_owned(),
            functions: functions
                .map(|(i, (_, emitted))| function_detail(target, i, emitted))
                .collect(),
            precision: precision.is_half().then(|| precision.name()),
            seen: None,
            data: None,
        }
    }

    /// The same for a material's file.
    pub(super) fn of_material(self, subject: &MaterialInMedium) -> FunctionsDetail {
        let (surface, effective) = (&subject.reference.surface, &subject.effective);
        let material = &subject.material;
        FunctionsDetail {
            seen: Some(ViewingDetail {
                truth: surface.seen.clone(),
                extrapolated: surface.extrapolation(),
                n: effective.channels.n,
                k: effective.channels.k,
                nk_by: effective.by.map(IndexSource::text),
            }),
            data: Some(DataDetail {
                reference: material.reference.clone(),
                link: material.link.clone(),
                licence: material.licence.clone(),
                conditions: material.conditions.clone(),
            }),
            ..self
        }
    }
}

fn function_detail(target: &Target, index: usize, emitted: &EmittedFunction) -> FunctionDetail {
    let average = Average::of(emitted);
    let is_module = target.finish == Finish::Spirv;
    FunctionDetail {
        name: emitted.name.clone(),
        method: match emitted.effect {
            Some(part) if !part.function.reflectance.is_used() => None,
            _ => Some(emitted.method.name),
        },
        form: emitted.form,
        signature: print::head(
            &emitted.function,
            &emitted.name,
            target.spelling_in(emitted.precision),
        ),
        parameters: parameters(emitted),
        operations: emitted.function.work(),
        fetches: emitted.function.fetches(),
        code_error: code_error(emitted),
        licence: OUTPUT_LICENCE,
        model_error: emitted.model_error.map(model_error),
        misses_its_class: emitted.missed.clone(),
        average: average.map(|average| average.given),
        average_unlimited: average.map(|average| average.unlimited),
        entry_point: is_module.then(|| entry_point(index, emitted)),
        uniforms: (is_module && emitted.effect.is_none()).then(|| uniforms(emitted)),
        notes: match emitted.effect {
            Some(part) => Notes::of_effect(part),
            None => Notes::of_method(emitted),
        },
    }
}

fn code_error(emitted: &EmittedFunction) -> CodeErrorDetail {
    match &emitted.code {
        Measured::Yes(CodeBound::Ulp(ulp)) => CodeErrorDetail::Ulp { max_ulp: *ulp },
        Measured::Yes(CodeBound::Absolute(most)) => CodeErrorDetail::Absolute { max_abs: *most },
        Measured::No(reason) if emitted.precision.is_half() => CodeErrorDetail::NoAbsolute {
            max_abs: (),
            reason: reason.clone(),
        },
        Measured::No(reason) => CodeErrorDetail::NoUlp {
            max_ulp: (),
            reason: reason.clone(),
        },
    }
}

fn model_error(error: ModelError) -> ModelErrorDetail {
    let undefined = "a channel reflects nothing, so that no relative error is defined";
    ModelErrorDetail {
        reason: error.mean_rel.is_none().then_some(undefined),
        error,
    }
}

fn parameters(emitted: &EmittedFunction) -> Parameters {
    let inputs = emitted.method.inputs.iter();
    if let Some(part) = emitted.effect {
        return Parameters::Arguments(arguments_of_effect(part, emitted));
    }
    if emitted.constants.is_empty() {
        let range = |input| emitted.method.range(input, emitted.precision).words();
        let arguments = inputs.map(|input| ArgumentDetail::new(input, range(input)));
        return Parameters::Arguments(arguments.collect());
    }
    let row = |input: &Input| {
        let values = emitted.constants.get(input.name)?;
        Some((
            input.name.to_owned(),
            values.map(|value| input.present(value)),
        ))
    };
    Parameters::Constants(inputs.filter_map(row).collect())
}

/// The arguments of an effect's function that are left at run time.
fn arguments_of_effect(part: EffectPart, emitted: &EmittedFunction) -> Vec<ArgumentDetail> {
    let own = part.function.arguments.iter().map(|one| ArgumentDetail {
        name: one.name,
        meaning: one.meaning,
        domain: one.domain.words(),
    });
    let inputs = emitted.method.inputs.iter();
    let inputs = inputs.map(|input| ArgumentDetail::new(input, input.range.words()));
    let params = &emitted.function.params;
    let is_left = |one: &ArgumentDetail| params.iter().any(|param| param.name == one.name);
    own.chain(inputs).filter(is_left).collect()
}

/// The uniform block of a module: name, type and offset in bytes of each run-time argument.
fn uniforms(emitted: &EmittedFunction) -> Vec<UniformDetail> {
    let params = &emitted.function.params;
    let numbers = params.iter().filter(|param| is_number(param));
    let row = |(param, offset): (&Param, usize)| UniformDetail {
        name: param.name.clone(),
        ty: if param.ty == Ty::Vec3 {
            "vec3"
        } else {
            "float"
        },
        offset,
    };
    numbers.zip(uniform_offsets(params)).map(row).collect()
}
