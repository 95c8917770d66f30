//! The row of the report for a user's function and a material, with the checks and their results. A check that was not made is not
//! passed.

use serde::Serialize;

use super::bind::{Bound, BoundArgument};
use super::comparison::{Comparison, Competitor, ExactFit, Own, dominating, sentence};
use super::cost::AuditCost;
use super::edges::{EdgeRow, Edges};
use super::inputs::Initialised;
use super::ours::Ours;
use super::preprocess::Condition;
use super::request::{Audit, DefaultArgument};
use super::slice::Slice;
use super::worker::RunError;
use crate::generator::fit::{ModelError, Perceived};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::CostAndError;
use crate::lab::fault::Fault;
use crate::lab::verify::compilers::Verdict;
use crate::lab::verify::{Answer, Status, as_object};
use crate::language::methods;
use crate::physics::foreign::Foreign;

/// A user's function with the values of a material: which compilers accept it, its error against the law, and its cost.
#[derive(Clone, Debug, Default, Serialize)]
pub struct AuditRow {
    /// The target of its language, or the language where that is no target.
    pub target: &'static str,
    /// The function's name, where rows of our functions have the method.
    pub method: String,
    /// The material, as a user types it.
    pub material: String,
    /// Always `user`.
    pub form: &'static str,
    /// The precision that it computes in.
    pub precision: &'static str,
    /// The function.
    pub function: String,
    /// The line of its name.
    pub line: usize,
    /// The argument that is the cosine.
    pub cosine: String,
    /// The form of that argument, as `--arg` takes it: `cos`, `angle` …
    pub cosine_is: &'static str,
    /// The form in words, where the argument's name does not say it.
    pub cosine_words: Option<String>,
    /// The version of its language that it is run as, where the file does not say.
    pub language_remark: Option<String>,
    /// The conditions that it depends on, and how they were decided.
    pub conditions: Vec<Condition>,
    /// Its file, without folders.
    pub file: String,
    /// How many channels a call returns.
    pub channels: usize,
    /// How many numbers describe a material.
    pub input_numbers: usize,
    /// Its arguments, in order.
    #[serde(serialize_with = "as_object")]
    pub arguments: Vec<(String, ArgumentValue)>,
    /// The arguments that have the material's values, in words.
    pub filled: Vec<String>,
    /// The inputs and arguments that keep the values in the file, in words.
    pub initialised: Vec<String>,
    /// The device that it ran on.
    pub device: Option<String>,
    /// The number of cosines.
    pub points: Option<usize>,
    /// Always none.
    pub code_error: Option<f64>,
    /// Why there is no code error.
    pub code_error_reason: &'static str,
    /// Its error against the law.
    pub model_error: Option<ModelError>,
    /// That error under viewing conditions.
    pub perceived: Option<Perceived>,
    /// Which of our methods it computes, if any.
    pub computes: Option<&'static str>,
    /// The other quantity for an argument with which it would compute one of our methods, where it computes none as bound.
    pub fits_exactly_with: Option<ExactFit>,
    /// What each compiler says of the file.
    #[serde(serialize_with = "as_object")]
    pub accepts: Vec<(String, Answer)>,
    /// The results at the ends of the domain.
    pub edges: Option<Vec<EdgeRow>>,
    /// The results beyond the domain that are not reflectances, in words.
    pub beyond: Option<Vec<String>>,
    /// Its cost on each GPU.
    pub cost: Vec<AuditCost>,
    /// Whether these costs are compared with ours.
    pub is_cost_comparable: bool,
    /// Why these costs are not compared.
    pub cost_remark: Option<String>,
    /// The methods that dominate it and take no more numbers of a material.
    pub dominated_by: Vec<Dominating>,
    /// The methods that are no worse in error and cost and better in one of them, but take more numbers of a material.
    pub better_with_more_inputs: Vec<Dominating>,
    /// For each GPU whether a method dominates it, in words. None where the methods' costs are not known there.
    #[serde(serialize_with = "as_object")]
    pub says: Vec<(String, Option<String>)>,
    /// What was checked.
    pub checked: CheckResults,
    /// The status by all checks.
    pub status: Status,
    /// Why it is not a pass.
    pub reason: Option<String>,
}

/// The value of an argument.
#[derive(Clone, Debug, Serialize)]
pub struct ArgumentValue {
    /// The value of each channel.
    pub value: [f64; 3],
    /// `material`, or `--arg` where numbers were given.
    pub from: &'static str,
    /// The quantity that it stands for, where the material gives it.
    pub quantity: Option<&'static str>,
}

/// A method of ours with no larger error and no higher cost on a GPU.
#[derive(Clone, Debug, Serialize)]
pub struct Dominating {
    /// The method.
    pub method: &'static str,
    /// `library`, `scalar` or `specialised`.
    pub form: &'static str,
    /// How many numbers describe a material in it.
    pub input_numbers: usize,
    /// The user's error divided by the method's.
    pub error_times: f64,
    /// The user's cost divided by the method's. None where the method costs nothing.
    pub cost_times: Option<f64>,
    /// The family of GPUs.
    pub gpu: &'static str,
}

impl AuditRow {
    /// The sentence about its cost on a GPU.
    pub fn sentence_on(&self, gpu: &str) -> Option<&str> {
        let (_, sentence) = self.says.iter().find(|(name, _)| name == gpu)?;
        sentence.as_deref()
    }
}

/// The result of running a function.
#[derive(Clone, Debug)]
pub struct Ran {
    /// The device that it ran on.
    pub device: String,
    /// The number of cosines.
    pub points: usize,
    /// The results at the ends of the domain.
    pub edges: Edges,
    /// The error against the reference.
    pub error: ModelError,
    /// That error under viewing conditions.
    pub perceived: Perceived,
    /// Which of our methods it computes.
    pub computes: Option<&'static str>,
    /// The other quantity for an argument with which it would compute one.
    pub exact_fit: Option<ExactFit>,
}

/// What is known of a function for a material.
pub struct Audited<'a> {
    /// The request.
    pub audit: &'a Audit,
    /// What compilers see of the text.
    pub slice: &'a Slice,
    /// The function with its arguments.
    pub bound: &'a Bound,
    /// The material.
    pub subject: &'a MaterialInMedium,
    /// What compilers say.
    pub verdicts: &'a [(String, Verdict)],
    /// The result of running it.
    pub ran: &'a Result<Ran, RunError>,
    /// Its costs.
    pub costs: &'a [AuditCost],
    /// Our methods.
    pub ours: &'a [Ours],
    /// Why its cost is not compared with theirs.
    pub cost_remark: Option<String>,
}

impl Audited<'_> {
    /// The row.
    pub fn audit_row(&self) -> AuditRow {
        let function = &self.bound.function;
        let ran = self.ran.as_ref().ok();
        let (status, reasons) = self.judged();
        let answer = |(name, verdict): &(String, Verdict)| (name.clone(), verdict.into());
        let mut row = AuditRow {
            target: self.audit.language.name(),
            method: function.name.clone(),
            material: self.subject.label().to_owned(),
            form: "user",
            precision: match self.slice.half {
                Some(_) => "f16",
                None => "f32",
            },
            function: function.path(),
            line: function.line,
            cosine: function.params[self.bound.cosine].name.clone(),
            cosine_is: self.bound.form.name(),
            cosine_words: self.bound.cosine_words.clone(),
            language_remark: None,
            conditions: self.slice.conditions.clone(),
            file: crate::generator::command_line::path_again(&self.audit.file),
            channels: if self.bound.is_one_channel() { 1 } else { 3 },
            input_numbers: self.bound.input_numbers(),
            arguments: self.bound.arguments.iter().map(argument_value).collect(),
            filled: self.bound.filled(),
            initialised: self.initialised(),
            device: ran.map(|ran| ran.device.clone()),
            points: ran.map(|ran| ran.points),
            code_error: None,
            code_error_reason: "there is no formula to hold it against but its own text",
            model_error: ran.map(|ran| ran.error),
            perceived: ran.map(|ran| ran.perceived),
            computes: ran.and_then(|ran| ran.computes),
            fits_exactly_with: ran.and_then(|ran| ran.exact_fit.clone()),
            accepts: self.verdicts.iter().map(answer).collect(),
            edges: ran.map(|ran| ran.edges.rows.clone()),
            beyond: ran.map(|ran| ran.edges.remarks.clone()),
            cost: self.costs_with_records(ran),
            is_cost_comparable: self.cost_remark.is_none(),
            cost_remark: self.cost_remark.clone(),
            dominated_by: Vec::new(),
            better_with_more_inputs: Vec::new(),
            says: Vec::new(),
            checked: CheckResults::new(self.verdicts, ran, self.audit.max_error),
            status,
            reason: (!reasons.is_empty()).then(|| reasons.join("\n")),
        };
        self.compare(&mut row);
        row
    }

    /// The costs, with recorded ones of our method that the function computes.
    fn costs_with_records(&self, ran: Option<&Ran>) -> Vec<AuditCost> {
        let method = ran.and_then(|ran| methods::find(ran.computes?));
        let costs = self.costs.iter().cloned();
        match method {
            Some(method) => costs.map(|cost| cost.with_record_of(method)).collect(),
            None => costs.collect(),
        }
    }

    /// The inputs from outside and the arguments that keep the text's values, in words.
    fn initialised(&self) -> Vec<String> {
        let inputs = self.slice.initialised.iter().map(Initialised::words);
        let default = |one: &DefaultArgument| format!("{} = {} (its default)", one.name, one.value);
        inputs
            .chain(self.bound.defaults.iter().map(default))
            .collect()
    }

    /// The status, and the reasons for it.
    fn judged(&self) -> (Status, Vec<String>) {
        let (file, name) = (Foreign(&self.audit.file), &self.bound.function.name);
        let place = format!("{file}: {name}");
        let mut reasons: Vec<String> = Vec::new();
        for (name, verdict) in self.verdicts {
            if let Err(Fault::Failed(words)) = verdict {
                reasons.push(format!("{words} ({name})"));
            }
        }
        match self.ran {
            Ok(ran) => {
                let findings = ran.edges.findings.iter();
                reasons.extend(findings.map(|finding| format!("{place}: {finding}")));
                if ran.error.undefined > 0 {
                    let count = ran.error.undefined;
                    reasons.push(format!(
                        "{place}: it gives no number at {count} cosines, which no error counts"
                    ));
                }
                let above = self.above_limit(&ran.error);
                reasons.extend(above.map(|why| format!("{place}: {why}")));
            }
            Err(RunError::Failed(why)) => reasons.push(format!("{place}: {why}")),
            Err(RunError::Refused(_, why) | RunError::Absent(why)) if reasons.is_empty() => {
                return (Status::NotChecked, vec![why.clone()]);
            }
            Err(RunError::Refused(..) | RunError::Absent(_)) => {}
        }
        let status = if reasons.is_empty() {
            Status::Pass
        } else {
            Status::Fail
        };
        (status, reasons)
    }

    /// Why an error is larger than allowed.
    fn above_limit(&self, error: &ModelError) -> Option<String> {
        let allowed = self.audit.max_error.filter(|max| !is_within(error, *max))?;
        let (max_abs, degrees) = (error.max_abs, libm::acos(error.worst_cos).to_degrees());
        let material = &self.subject.argument;
        Some(format!(
            "its error for {material} is {max_abs:.6} at {degrees:.1} degrees, and --max-error allows {allowed}"
        ))
    }

    /// Enters into the row what the function's costs say beside those of our methods, for each GPU where its cost and error are
    /// known.
    fn compare(&self, row: &mut AuditRow) {
        let Ok(ran) = self.ran else { return };
        let quantities = self.bound.arguments.iter().filter_map(|one| one.quantity);
        let had: Vec<&str> = quantities.map(|one| one.input.name).collect();
        for (place, cost) in self.costs.iter().enumerate() {
            let Some(net) = cost.net else { continue };
            let own = Own {
                inputs: row.input_numbers,
                point: CostAndError {
                    error: ran.error.max_abs,
                    cost: net,
                },
                fails: row.status == Status::Fail,
            };
            let all = self.ours.iter().filter(|_| row.is_cost_comparable);
            let all = all.filter_map(|ours| ours.competitor(place, &had));
            let all: Vec<Competitor> = all.collect();
            let dominates = |one: &Comparison| Dominating {
                method: one.other.method,
                form: one.other.form,
                input_numbers: one.other.inputs,
                error_times: one.times.error,
                cost_times: one.cost_times(),
                gpu: cost.gpu,
            };
            let (with_as_few, with_more) = dominating(&own, &all);
            row.dominated_by.extend(with_as_few.iter().map(dominates));
            row.better_with_more_inputs
                .extend(with_more.iter().map(dominates));
            let known = (!all.is_empty()).then(|| sentence(&own, &all));
            let says = row.cost_remark.clone().or(known);
            row.says.push((cost.gpu.to_owned(), says));
        }
    }
}

fn argument_value(argument: &BoundArgument) -> (String, ArgumentValue) {
    let value = ArgumentValue {
        value: argument.value.map(f64::from),
        from: match argument.quantity {
            Some(_) => "material",
            None => "--arg",
        },
        quantity: argument.quantity.map(|quantity| quantity.name),
    };
    (argument.name.clone(), value)
}

/// The results of the checks. None where one was not made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CheckResults {
    /// Whether compilers accept it.
    pub accepted: Option<bool>,
    /// Whether its results are reflectances: numbers from 0 to 1, or to an F0 above 1.
    pub within_range: Option<bool>,
    /// The allowed error.
    pub max_error: Option<f64>,
    /// Whether its error is within that.
    pub within_max_error: Option<bool>,
}

impl CheckResults {
    /// What was checked of a function.
    pub fn new(
        verdicts: &[(String, Verdict)],
        ran: Option<&Ran>,
        max_error: Option<f64>,
    ) -> CheckResults {
        let refuses = |(_, verdict): &(String, Verdict)| matches!(verdict, Err(Fault::Failed(_)));
        let accepts = |(_, verdict): &(String, Verdict)| verdict.is_ok();
        let accepted = if verdicts.iter().any(refuses) {
            Some(false)
        } else {
            verdicts.iter().any(accepts).then_some(true)
        };
        CheckResults {
            accepted,
            within_range: ran.map(|ran| ran.edges.findings.is_empty() && ran.error.undefined == 0),
            max_error,
            within_max_error: ran
                .zip(max_error)
                .map(|(ran, max)| is_within(&ran.error, max)),
        }
    }

    /// In words, for a function that has this status.
    pub fn words(&self, status: Status) -> String {
        let says = |result: Option<bool>, yes: &str, no: &str| {
            result.map(|is| if is { yes } else { no }.to_owned())
        };
        let parts = [
            says(
                self.accepted,
                "compilers accept it",
                "a compiler refuses it",
            ),
            says(
                self.within_range,
                "all results are reflectances",
                "a result is no reflectance",
            ),
            self.error_words(),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        let checks = parts.join("; ");
        match status {
            Status::Pass => checks,
            _ if parts.is_empty() => status.words().to_owned(),
            Status::Fail | Status::NotChecked => format!("{}: {checks}", status.words()),
        }
    }

    fn error_words(&self) -> Option<String> {
        match (self.within_range, self.max_error, self.within_max_error) {
            (_, Some(max), Some(true)) => Some(format!("its error is at most {max}")),
            (_, Some(max), Some(false)) => Some(format!("its error is above {max}")),
            (Some(_), None, _) => {
                Some("its error is not judged (--max-error sets a limit)".to_owned())
            }
            _ => None,
        }
    }
}

/// Whether an error is within the allowed one. A NaN is not.
fn is_within(error: &ModelError, max_error: f64) -> bool {
    error.max_abs <= max_error
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: CheckResults = CheckResults {
        accepted: Some(true),
        within_range: Some(true),
        max_error: None,
        within_max_error: None,
    };

    #[test]
    fn words_say_what_was_checked() {
        assert_eq!(
            ALL.words(Status::Pass),
            "compilers accept it; all results are reflectances; its error is not judged (--max-error sets a limit)"
        );
        let judged = |is_within: bool| CheckResults {
            max_error: Some(0.01),
            within_max_error: Some(is_within),
            ..ALL
        };
        assert_eq!(
            judged(false).words(Status::Fail),
            "fail: compilers accept it; all results are reflectances; its error is above 0.01"
        );
        let within = judged(true).words(Status::Pass);
        assert!(within.ends_with("its error is at most 0.01"));
    }

    /// A function that never ran has no statement about its results or its error.
    #[test]
    fn what_was_not_checked_is_not_said() {
        let refused = CheckResults {
            accepted: Some(false),
            max_error: Some(0.01),
            ..CheckResults::default()
        };
        assert_eq!(refused.words(Status::Fail), "fail: a compiler refuses it");
        assert_eq!(
            CheckResults::default().words(Status::NotChecked),
            "not checked"
        );
        let failed = CheckResults::default().words(Status::Fail);
        assert_eq!(failed, "fail");
    }
}
