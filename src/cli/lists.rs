//! `methods`, `effects` and `targets`: list and show.

use std::collections::BTreeSet;
use std::path::Path;

use clap::{Args, Subcommand};
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, one_of};
use crate::cli::flags::output::ReportFlags;
use crate::cli::output::{Output, report};
use crate::generator::emit;
use crate::generator::envelope::{Report, SCHEMA};
use crate::generator::error::RequestFault;
use crate::language::effects::{self, Effect, EffectFunction};
use crate::language::methods::{self, Contract, Method};
use crate::language::targets::{self, Target};
use crate::physics::num::Precision;
use crate::pictures::table;

/// The flags of `methods`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct MethodsFlags {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<MethodsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed of methods.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum MethodsCommand {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of("method", methods::ALL.iter().copied(), |method| method.name))]
        name: &'static Method,
    },
}

/// The flags of `effects`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct EffectsFlags {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<EffectsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed of effects.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum EffectsCommand {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of("effect", effects::ALL.iter().copied(), |effect| effect.name))]
        name: &'static Effect,
    },
}

/// The flags of `targets`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct TargetsFlags {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<TargetsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed of targets.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum TargetsCommand {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of("target", targets::ALL.iter().copied(), |target| target.name))]
        name: &'static Target,
    },
}

/// `fresnel-gen methods`.
pub fn methods(flags: &MethodsFlags) -> Result<Output, Error> {
    let file = flags.report.json();
    if let Some(MethodsCommand::Show { name: method }) = flags.what {
        return report(method_text(method), &MethodSheet::new(method), file);
    }
    let row = |method: &&'static Method| NameRow {
        name: method.name,
        summary: method.summary,
        source: method.source_in_full(),
    };
    listed("methods", methods::ALL.iter().map(row).collect(), file)
}

/// `fresnel-gen effects`.
pub fn effects(flags: &EffectsFlags) -> Result<Output, Error> {
    let file = flags.report.json();
    if let Some(EffectsCommand::Show { name: effect }) = flags.what {
        return report(effect_text(effect), &EffectSheet::new(effect), file);
    }
    let row = |effect: &&'static Effect| NameRow {
        name: effect.name,
        summary: effect.summary,
        source: effect.source.line(),
    };
    listed("effects", effects::ALL.iter().map(row).collect(), file)
}

/// `fresnel-gen targets`.
pub fn targets(flags: &TargetsFlags) -> Result<Output, Error> {
    let file = flags.report.json();
    if let Some(TargetsCommand::Show { name: target }) = flags.what {
        return report(target_text(target), &TargetSheet::new(target), file);
    }
    let row = |target: &&'static Target| NameRow {
        name: target.name,
        summary: target.summary,
        source: target.source.to_owned(),
    };
    listed("targets", targets::ALL.iter().map(row).collect(), file)
}

/// A name in a list, with its summary and source.
#[derive(Serialize)]
struct NameRow {
    name: &'static str,
    summary: &'static str,
    source: String,
}

/// All names.
fn listed(command: &str, rows: Vec<NameRow>, file: Option<&Path>) -> Result<Output, Error> {
    let cells = |row: &NameRow| [row.name, row.summary].map(str::to_owned).to_vec();
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let text = table::text_table(&["name", "summary"], &cells);
    report(text, &Report::new(command, rows), file)
}

fn method_text(method: &Method) -> String {
    let mut lines = vec![
        format!("{}: {}", method.name, method.summary),
        String::new(),
    ];
    lines.extend(method.formula.iter().map(|line| format!("  {line}")));
    lines.push(String::new());
    lines.push(format!("source      {}", method.source_in_full()));
    lines.push(format!("domain      {}", method.domain));
    lines.extend(
        method
            .inputs
            .iter()
            .map(|i| format!("argument    {}: {}; {}", i.name, i.meaning, i.range.words())),
    );
    lines.extend(emit::promises(Precision::F32, method));
    lines.push(format!("in f16      {}", emit::half_promise(method)));
    if let Contract::Exempt(why) = method.contract {
        lines.push(format!("fails       {why}"));
    }
    lines.join("\n") + "\n"
}

/// The facts about a method.
#[derive(Serialize)]
struct MethodSheet {
    schema: u32,
    name: &'static str,
    summary: &'static str,
    source: String,
    formula: &'static [&'static str],
    domain: &'static str,
    arguments: Vec<ArgumentRow>,
    claims: Vec<ClaimRow>,
    code_ulp: f64,
    f16: HalfRow,
}

#[derive(Serialize)]
struct ArgumentRow {
    name: &'static str,
    meaning: &'static str,
    domain: String,
}

/// The model error that a method promises over a set of media.
#[derive(Serialize)]
struct ClaimRow {
    over: &'static str,
    max_abs: f64,
}

/// What a method promises in half precision.
#[derive(Serialize)]
struct HalfRow {
    max_abs: Option<f64>,
    over: Option<&'static str>,
    reason: Option<&'static str>,
    specialised: bool,
}

impl MethodSheet {
    fn new(method: &'static Method) -> MethodSheet {
        let arguments = method.inputs.iter().map(|input| ArgumentRow {
            name: input.name,
            meaning: input.meaning,
            domain: input.range.words(),
        });
        let claims = method.claims.model.iter().map(|claim| ClaimRow {
            over: claim.over.text(),
            max_abs: claim.max_abs,
        });
        let half = method.half.claim();
        MethodSheet {
            schema: SCHEMA,
            name: method.name,
            summary: method.summary,
            source: method.source_in_full(),
            formula: method.formula,
            domain: method.domain,
            arguments: arguments.collect(),
            claims: claims.collect(),
            code_ulp: method.claims.code_ulp,
            f16: HalfRow {
                max_abs: half.map(|claim| claim.max_abs),
                over: half.map(|claim| method.media(claim.over)),
                reason: method.half.library_refusal(),
                specialised: method.half.refusal().is_none(),
            },
        }
    }
}

fn effect_text(effect: &Effect) -> String {
    let mut lines = vec![
        format!("{}: {}", effect.name, effect.summary),
        String::new(),
    ];
    lines.extend(effect.formula.iter().map(|line| format!("  {line}")));
    lines.push(String::new());
    lines.push(format!("source      {}", effect.source.line()));
    for (title, said) in [("use", effect.conventions), ("fails", effect.fails)] {
        lines.extend(said.iter().map(|line| format!("{title:<12}{line}")));
    }
    for function in effect.functions {
        lines.push(String::new());
        lines.push(format!("{}: {}", function.name, function.gives));
        for argument in effect_arguments(function) {
            let ArgumentRow {
                name,
                meaning,
                domain,
            } = argument;
            lines.push(
                if domain.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
                    format!("  {name}: {meaning} (error stated for {domain})")
                } else {
                    format!("  {name}: {meaning}")
                },
            );
        }
    }
    lines.join("\n") + "\n"
}

/// The arguments of a function. Behind these stand the inputs of the method, where the function needs R.
fn effect_arguments(function: &EffectFunction) -> Vec<ArgumentRow> {
    let row = |argument: &effects::Argument| ArgumentRow {
        name: argument.name,
        meaning: argument.meaning,
        domain: argument.domain.words(),
    };
    let mut rows: Vec<ArgumentRow> = function.arguments.iter().map(row).collect();
    if function.reflectance.is_used() {
        rows.push(ArgumentRow {
            name: "...",
            meaning: "what the method of R takes after cos_theta: eta for dielectric_exact",
            domain: "as for the method".to_owned(),
        });
    }
    rows
}

/// The facts about an effect.
#[derive(Serialize)]
struct EffectSheet {
    schema: u32,
    name: &'static str,
    summary: &'static str,
    source: String,
    formula: &'static [&'static str],
    conventions: &'static [&'static str],
    fails: &'static [&'static str],
    functions: Vec<EffectFunctionRow>,
}

/// A function of an effect.
#[derive(Serialize)]
struct EffectFunctionRow {
    name: &'static str,
    gives: &'static str,
    arguments: Vec<ArgumentRow>,
    asks_for_reflectance: bool,
    code_abs: f64,
}

impl EffectSheet {
    fn new(effect: &'static Effect) -> EffectSheet {
        let row = |function: &EffectFunction| EffectFunctionRow {
            name: function.name,
            gives: function.gives,
            arguments: effect_arguments(function),
            asks_for_reflectance: function.reflectance.is_used(),
            code_abs: function.code_abs,
        };
        EffectSheet {
            schema: SCHEMA,
            name: effect.name,
            summary: effect.summary,
            source: effect.source.line(),
            formula: effect.formula,
            conventions: effect.conventions,
            fails: effect.fails,
            functions: effect.functions.iter().map(row).collect(),
        }
    }
}

fn target_text(target: &Target) -> String {
    let mut lines = vec![
        format!("{}: {}", target.name, target.summary),
        format!("source      {}", target.source),
        format!("extension   {}", target.extension),
        format!(
            "by default  {}",
            if target.by_default {
                "yes"
            } else {
                "only by name"
            }
        ),
    ];
    for validator in target.validators {
        lines.push(format!(
            "validator   {}: {} ({})",
            validator.name,
            validator.command(),
            validator.compiler.get
        ));
    }
    lines.join("\n") + "\n"
}

/// The facts about a target.
#[derive(Serialize)]
struct TargetSheet {
    schema: u32,
    name: &'static str,
    summary: &'static str,
    source: &'static str,
    extension: &'static str,
    by_default: bool,
    validators: Vec<ValidatorRow>,
}

#[derive(Serialize)]
struct ValidatorRow {
    name: &'static str,
    command: String,
    get: &'static str,
}

impl TargetSheet {
    fn new(target: &'static Target) -> TargetSheet {
        let validators = target.validators.iter().map(|validator| ValidatorRow {
            name: validator.name,
            command: validator.command(),
            get: validator.compiler.get,
        });
        TargetSheet {
            schema: SCHEMA,
            name: target.name,
            summary: target.summary,
            source: target.source,
            extension: target.extension,
            by_default: target.by_default,
            validators: validators.collect(),
        }
    }
}

/// The targets of a request: those of `--target`, or the one of the file's extension. Empty where neither names one.
///
/// # Errors
/// No language's files have this extension, or the extension is of another language than `--target`.
pub fn requested_targets(
    words: &[Choice<&'static Target>],
    file: Option<&Path>,
) -> Result<Vec<&'static Target>, Error> {
    let named = Choice::targets(words);
    let Some(file) = file.filter(|file| *file != Path::new("-")) else {
        return Ok(named);
    };
    let ending = file.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_lowercase);
    let of_ending = of_ending(ending.as_deref().unwrap_or_default());
    // If two languages share the extension, the default one.
    let usual = of_ending.iter().find(|target| target.by_default);
    match (usual.or(of_ending.first()), words) {
        (Some(first), []) => Ok(vec![*first]),
        (None, []) if ending.is_some() => Err(no_language(file).into()),
        (Some(first), [Choice::One(one, _)]) if of_ending.iter().all(|it| it.name != one) => {
            let (file, language) = (crate::physics::foreign::path(&file), first.name);
            let why = format!("`{file}` ends as a file of {language}, and --target is {one}");
            Err(Error::usage(why))
        }
        _ => Ok(named),
    }
}

/// The targets whose files have this extension.
fn of_ending(ending: &str) -> Vec<&'static Target> {
    let all = targets::ALL.iter().copied();
    all.filter(|target| target.endings().any(|one| one == ending))
        .collect()
}

fn no_language(file: &Path) -> RequestFault {
    let endings: BTreeSet<&str> = targets::ALL.iter().flat_map(|it| it.endings()).collect();
    let endings: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    RequestFault::refused(format!(
        "`{}` says no language by its ending; name one with --target, or end the file in {}",
        crate::physics::foreign::path(&file),
        endings.join(", ")
    ))
}
