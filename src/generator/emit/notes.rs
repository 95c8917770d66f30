//! What the manifest says of a function besides its figures: what full headers say, and short ones do not.

use serde::Serialize;

use crate::language::methods::Contract;

use super::average;
use super::effect_file::EffectPart;
use super::figures::promises_in;
use super::form::FunctionForm;
use super::function::Emitted;
use super::header::{source, table_line};

/// What full headers say of a function besides, and short ones do not.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Notes {
    formula: &'static [&'static str],
    source: String,
    /// Where it holds; of an effect each argument says it.
    #[serde(skip_serializing_if = "Option::is_none")]
    domain: Option<&'static str>,
    /// Of an effect's function: what it gives.
    #[serde(skip_serializing_if = "Option::is_none")]
    gives: Option<&'static str>,
    /// Of an effect: where it must be wrong.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    wrong: Vec<&'static str>,
    /// Where it fails, of a method that is exempt from the contract of the others.
    #[serde(skip_serializing_if = "Option::is_none")]
    fails: Option<&'static str>,
    /// What a library function promises, a sentence each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    promises: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    written_as: Option<&'static str>,
    /// Of a plain form: the operations of the stable one.
    #[serde(skip_serializing_if = "Option::is_none")]
    stable_operations: Option<usize>,
}

impl Notes {
    /// Those of a function.
    pub(super) fn of(emitted: &Emitted) -> Notes {
        match emitted.effect {
            Some(part) => of_effect(part),
            None => of_method(emitted),
        }
    }
}

fn of_method(emitted: &Emitted) -> Notes {
    let method = emitted.method;
    let is_specialised = emitted.form == FunctionForm::Specialised;
    Notes {
        formula: method.formula,
        source: source(method),
        domain: Some(method.domain),
        gives: None,
        wrong: Vec::new(),
        fails: match method.contract {
            Contract::Kept => None,
            Contract::Exempt(why) => Some(why),
        },
        promises: if is_specialised {
            Vec::new()
        } else {
            promises_in(emitted.precision, method)
        },
        mean: average::mean_line(emitted).or_else(|| average::coefficients_line(emitted)),
        table: table_line(emitted),
        written_as: emitted.written_as.map(|method| method.name),
        stable_operations: emitted.plain_for,
    }
}

fn of_effect(EffectPart { effect, function }: EffectPart) -> Notes {
    Notes {
        formula: effect.formula,
        source: format!("Source: {}", effect.source.line()),
        domain: None,
        gives: Some(function.gives),
        wrong: effect.fails.to_vec(),
        fails: None,
        promises: Vec::new(),
        mean: None,
        table: None,
        written_as: None,
        stable_operations: None,
    }
}
