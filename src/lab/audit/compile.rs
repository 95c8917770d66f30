//! The compilers of a user's text, run by a worker: ending the worker ends a compiler that hangs.
//!
//! Their messages have the place in the user's file before them, and the user's names as they wrote them.

use core::cell::RefCell;
use core::time::Duration;

use super::compilers::{Accepted, compiler_name};
use super::language::Language;
use super::program::own_names;
use super::worker::{AuditRequest, AuditResponse};
use crate::lab::fault::Fault;
use crate::lab::process::{Error, Launch, NoAnswer, Surroundings, Worker};
use crate::physics::foreign::Foreign;
use crate::physics::num::Precision;

/// The process that asks them.
pub struct Compilers {
    limit: Duration,
    worker: RefCell<Worker>,
}

impl Compilers {
    /// Each step may take this long, however many compilers it asks.
    pub fn new(limit: Duration, surroundings: &Surroundings) -> Compilers {
        Compilers {
            limit,
            worker: RefCell::new(Worker::new(Launch::new(
                &["audit", "--worker"],
                surroundings,
            ))),
        }
    }

    /// What the compilers of a language say of a whole program.
    ///
    /// # Errors
    /// No process can be started.
    pub fn accepted(
        &self,
        language: Language,
        precision: Precision,
        program: String,
    ) -> Result<Accepted, Error> {
        let request = AuditRequest::Accept(language, precision, program);
        // This says nothing of the text: the compiler or the machine may be at fault.
        let silent = |words: String| Accepted {
            verdicts: vec![(
                compiler_name(language).to_owned(),
                Err(Fault::Absent(words.clone())),
            )],
            code: Err(Fault::Absent(words)),
        };
        let accepted = self.ask(&request, language, |response| match response {
            AuditResponse::Accepted(accepted) => Some(accepted),
            _ => None,
        })?;
        Ok(accepted.unwrap_or_else(silent))
    }

    /// The SPIR-V of a shader in a language.
    ///
    /// # Errors
    /// No process can be started.
    pub fn module(
        &self,
        language: Language,
        precision: Precision,
        shader: String,
    ) -> Result<Result<Vec<u8>, Fault>, Error> {
        let request = AuditRequest::Module(language, precision, shader);
        let made = self.ask(&request, language, |response| match response {
            AuditResponse::Module(made) => Some(made),
            _ => None,
        })?;
        Ok(made.unwrap_or_else(|words| Err(Fault::Absent(words))))
    }

    /// The response, or why there is none.
    fn ask<T>(
        &self,
        request: &AuditRequest,
        language: Language,
        read: impl Fn(AuditResponse) -> Option<T>,
    ) -> Result<Result<T, String>, Error> {
        let response = self.worker.borrow_mut().ask(request, self.limit)?;
        Ok(match response.map(read) {
            Ok(read) => read.ok_or_else(|| "the process answers another question".to_owned()),
            Err(no_answer) => Err(reason(&no_answer, self.limit, language)),
        })
    }
}

fn reason(no_answer: &NoAnswer, limit: Duration, language: Language) -> String {
    let compiler = compiler_name(language);
    match no_answer {
        NoAnswer::TooLong => format!(
            "{compiler} did not end within {} s, which is all that --limit allows",
            limit.as_secs()
        ),
        NoAnswer::Ended(status) => format!("the process that asks {compiler} ended ({status})"),
    }
}

/// A compiler's message with the place of its first fault before it: `FILE:LINE:COL: what`.
pub fn placed(file: &str, lines: usize, words: &str) -> String {
    let (file, words) = (Foreign(file), own_names(words));
    let first = words.lines().enumerate().find_map(|(i, line)| {
        let (line_number, column) = place(line)?;
        Some((i, line_number, column))
    });
    let Some((i, line, column)) = first else {
        return format!("{file}: {}", words.trim_end());
    };
    let all: Vec<&str> = words.lines().collect();
    // naga puts the message in the line before the place.
    let is_arrow = all[i].contains("┌─") || all[i].trim_start().starts_with("-->");
    let said = if is_arrow && i > 0 {
        all[i - 1]
    } else {
        all[i]
    };
    let said = message(said);
    let column = column.map_or(String::new(), |column| format!("{column}:"));
    if line > lines {
        // What is unclosed at the end is reported in the code after it.
        return format!("{file}:{}: at the end of the file: {said}", lines.max(1));
    }
    format!("{file}:{line}:{column} {said}")
}

/// Whether a compiler's message names a place in the text. Others may be about the compiler or the machine.
pub fn names_place(words: &str) -> bool {
    words.lines().any(|line| place(line).is_some())
}

/// The line and column that a compiler names: `shader.hlsl:3:5: error`, `0:3(5): error`, `ERROR: 0:3:`, `┌─ wgsl:3:5`.
fn place(line: &str) -> Option<(usize, Option<usize>)> {
    let marks = [
        "wgsl:",
        "shader.hlsl:",
        "shader.vert:",
        "shader.frag:",
        "shader.comp:",
        "shader.wgsl:",
        "shader.slang:",
        "0:",
    ];
    // `10:03:05` is a time.
    let is_apart = |at: usize| !line[..at].ends_with(|c: char| c.is_alphanumeric());
    let mark = marks.iter().find_map(|mark| {
        let mut found = line.match_indices(mark).map(|(at, _)| at);
        let at = found.find(|at| mark.len() > 2 || is_apart(*at))?;
        Some(at + mark.len())
    })?;
    let rest = &line[mark..];
    let line_number = number(rest)?;
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    let column = after.strip_prefix([':', '(']).and_then(number);
    Some((line_number, column))
}

fn number(text: &str) -> Option<usize> {
    let end = text.find(|c: char| !c.is_ascii_digit());
    text[..end.unwrap_or(text.len())].parse().ok()
}

/// A compiler's message without the place before it.
fn message(line: &str) -> &str {
    let heads = ["error:", "ERROR:"];
    let found = heads
        .iter()
        .find_map(|head| Some(line.find(head)? + head.len()));
    let rest = found.map_or(line, |at| line[at..].trim_start());
    // glslang: `ERROR: 0:3: 'x' : undeclared identifier`.
    match place(rest) {
        Some(_) => rest.splitn(3, ':').nth(2).unwrap_or(rest).trim_start(),
        None => rest,
    }
}

#[cfg(test)]
mod tests {
    use super::names_place;
    use super::placed;

    #[test]
    fn a_name_of_a_file_makes_no_line() {
        let (name, shown) = ("f\n::error::x.glsl", "f\\n::error::x.glsl");
        for (words, said) in [
            ("gone", format!("{shown}: gone")),
            ("0:3(7): error: a", format!("{shown}:3:7: a")),
            (
                "0:9(1): error: a",
                format!("{shown}:5: at the end of the file: a"),
            ),
        ] {
            assert_eq!(placed(name, 5, words), said);
        }
    }

    #[test]
    fn every_compiler_s_words_get_the_user_s_place() {
        let naga = "error: no definition in scope for identifier: `x`\n  ┌─ wgsl:2:12\n  │";
        let mesa = "the shader was refused: 0:3(7): error: `x' undeclared\n0:4(1): error: b";
        let dxc = "shader.hlsl:2:9: error: use of undeclared identifier 'x'\n  return x;";
        let glslang = "shader.vert\nERROR: 0:2: 'x' : undeclared identifier";
        let slangc = "error[E30015]: undefined identifier\n --> shader.slang:3:12\n  |";
        let shown_at = |words| placed("f.x", 5, words);
        assert_eq!(
            shown_at(naga),
            "f.x:2:12: no definition in scope for identifier: `x`"
        );
        assert_eq!(shown_at(mesa), "f.x:3:7: `x' undeclared");
        assert_eq!(shown_at(dxc), "f.x:2:9: use of undeclared identifier 'x'");
        assert_eq!(shown_at(glslang), "f.x:2: 'x' : undeclared identifier");
        assert_eq!(
            shown_at(slangc),
            "f.x:3:12: error[E30015]: undefined identifier"
        );
        assert_eq!(shown_at("gone"), "f.x: gone");
        assert!(
            [naga, mesa, dxc, glslang, slangc]
                .into_iter()
                .all(names_place)
        );
        for other in [
            "gone",
            "10:03:05 out of memory",
            "Validation Error\n  Binding is missing",
        ] {
            assert!(!names_place(other), "{other}");
        }
        assert_eq!(
            placed("f.x", 2, dxc.replace("2:9", "7:1").as_str()),
            "f.x:2: at the end of the file: use of undeclared identifier 'x'"
        );
    }
}
