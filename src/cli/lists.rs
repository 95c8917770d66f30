//! `methods`, `effects` and `targets`: list and show.

use clap::{Args, Subcommand};
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::choice::one_of;
use crate::cli::flags::output::ReportFlags;
use crate::cli::output::{Output, report};
use crate::generator::emit;
use crate::generator::envelope::{Report, SCHEMA};
use crate::language::effects::{self, Effect, EffectFunction};
use crate::language::methods::{self, Contract, Method};
use crate::language::targets::{self, Target};
use crate::physics::num::Precision;
use crate::pictures::table;

/// What is listed and shown: methods, effects, targets.
pub trait Listed: std::fmt::Debug + Sync + 'static {
    /// What one is called: `method`. The command is the plural.
    const KIND: &'static str;

    /// All of them.
    fn all() -> &'static [&'static Self];

    /// Its row in the list.
    fn row(&self) -> NameRow;

    /// All that is known of it, as text.
    fn text(&self) -> String;

    /// All that is known of it, as JSON.
    fn sheet(&self) -> impl Serialize;
}

/// The flags of `methods`, `effects` and `targets`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct ListFlags<T: Listed> {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<ListCommand<T>>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed.
#[derive(Debug, Subcommand)]
pub enum ListCommand<T: Listed> {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of(T::KIND, T::all().iter().copied(), |item| item.row().name))]
        name: &'static T,
    },
}

/// A name in a list, with its summary and source.
#[derive(Serialize)]
pub struct NameRow {
    name: &'static str,
    summary: &'static str,
    source: String,
}

/// Lists all, or shows one.
pub fn run<T: Listed>(flags: &ListFlags<T>) -> Result<Output, Error> {
    let file = flags.report.json();
    if let Some(ListCommand::Show { name: item }) = flags.what {
        return report(item.text(), &item.sheet(), file);
    }
    let rows: Vec<NameRow> = T::all().iter().map(|item| item.row()).collect();
    let cells = |row: &NameRow| [row.name, row.summary].map(str::to_owned).to_vec();
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let text = table::text_table(&["name", "summary"], &cells);
    report(text, &Report::new(format!("{}s", T::KIND), rows), file)
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

impl Listed for Method {
    const KIND: &'static str = "method";

    fn all() -> &'static [&'static Method] {
        methods::ALL
    }

    fn row(&self) -> NameRow {
        NameRow {
            name: self.name,
            summary: self.summary,
            source: self.source_in_full(),
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![format!("{}: {}", self.name, self.summary), String::new()];
        lines.extend(self.formula.iter().map(|line| format!("  {line}")));
        lines.push(String::new());
        lines.push(format!("source      {}", self.source_in_full()));
        lines.push(format!("domain      {}", self.domain));
        lines.extend(
            self.inputs
                .iter()
                .map(|i| format!("argument    {}: {}; {}", i.name, i.meaning, i.range.words())),
        );
        lines.extend(emit::promises(Precision::F32, self));
        lines.push(format!("in f16      {}", emit::half_promise(self)));
        if let Contract::Exempt(why) = self.contract {
            lines.push(format!("fails       {why}"));
        }
        lines.join("\n") + "\n"
    }

    fn sheet(&self) -> impl Serialize {
        let arguments = self.inputs.iter().map(|input| ArgumentRow {
            name: input.name,
            meaning: input.meaning,
            domain: input.range.words(),
        });
        let claims = self.claims.model.iter().map(|claim| ClaimRow {
            over: claim.over.text(),
            max_abs: claim.max_abs,
        });
        let half = self.half.claim();
        MethodSheet {
            schema: SCHEMA,
            name: self.name,
            summary: self.summary,
            source: self.source_in_full(),
            formula: self.formula,
            domain: self.domain,
            arguments: arguments.collect(),
            claims: claims.collect(),
            code_ulp: self.claims.code_ulp,
            f16: HalfRow {
                max_abs: half.map(|claim| claim.max_abs),
                over: half.map(|claim| self.media(claim.over)),
                reason: self.half.library_refusal(),
                specialised: self.half.refusal().is_none(),
            },
        }
    }
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

impl Listed for Effect {
    const KIND: &'static str = "effect";

    fn all() -> &'static [&'static Effect] {
        effects::ALL
    }

    fn row(&self) -> NameRow {
        NameRow {
            name: self.name,
            summary: self.summary,
            source: self.source.line(),
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![format!("{}: {}", self.name, self.summary), String::new()];
        lines.extend(self.formula.iter().map(|line| format!("  {line}")));
        lines.push(String::new());
        lines.push(format!("source      {}", self.source.line()));
        for (title, said) in [("use", self.conventions), ("fails", self.fails)] {
            lines.extend(said.iter().map(|line| format!("{title:<12}{line}")));
        }
        for function in self.functions {
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

    fn sheet(&self) -> impl Serialize {
        let row = |function: &EffectFunction| EffectFunctionRow {
            name: function.name,
            gives: function.gives,
            arguments: effect_arguments(function),
            asks_for_reflectance: function.reflectance.is_used(),
            code_abs: function.code_abs,
        };
        EffectSheet {
            schema: SCHEMA,
            name: self.name,
            summary: self.summary,
            source: self.source.line(),
            formula: self.formula,
            conventions: self.conventions,
            fails: self.fails,
            functions: self.functions.iter().map(row).collect(),
        }
    }
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

impl Listed for Target {
    const KIND: &'static str = "target";

    fn all() -> &'static [&'static Target] {
        targets::ALL
    }

    fn row(&self) -> NameRow {
        NameRow {
            name: self.name,
            summary: self.summary,
            source: self.source.to_owned(),
        }
    }

    fn text(&self) -> String {
        let mut lines = vec![
            format!("{}: {}", self.name, self.summary),
            format!("source      {}", self.source),
            format!("extension   {}", self.extension),
            format!(
                "by default  {}",
                if self.by_default {
                    "yes"
                } else {
                    "only by name"
                }
            ),
        ];
        for validator in self.validators {
            lines.push(format!(
                "validator   {}: {} ({})",
                validator.name,
                validator.command(),
                validator.compiler.get
            ));
        }
        lines.join("\n") + "\n"
    }

    fn sheet(&self) -> impl Serialize {
        let validators = self.validators.iter().map(|validator| ValidatorRow {
            name: validator.name,
            command: validator.command(),
            get: validator.compiler.get,
        });
        TargetSheet {
            schema: SCHEMA,
            name: self.name,
            summary: self.summary,
            source: self.source,
            extension: self.extension,
            by_default: self.by_default,
            validators: validators.collect(),
        }
    }
}
