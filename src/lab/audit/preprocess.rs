//! Decides the conditions of a user's text. Lines that they drop become blank, so that lines keep their numbers. Macros stay for
//! compilers to replace.
//!
//! Other files are not read, so an unknown name counts as undefined unless `-D` defines it. WGSL has no preprocessor. Its lines
//! that begin with `#` are read as those of naga_oil, which Bevy uses.

use serde::Serialize;

use super::condition::{Macro, Macros, condition_value, defined_macro, plain_macro, words};
use super::directives::{self, TextFault};
use super::error::Error;
use super::language::Language;
use crate::lab::verify::shader_words::{Token, text_at, tokens};
use crate::physics::foreign::Foreign;

/// A name that the user defines for the preprocessor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Define {
    /// The name.
    pub name: String,
    /// Its replacement.
    pub value: String,
}

impl Define {
    /// A name defined as a number.
    pub fn of(name: &str, value: u32) -> Define {
        Define {
            name: name.to_owned(),
            value: value.to_string(),
        }
    }

    /// Parses `NAME=VALUE`, or `NAME`, whose value is 1.
    ///
    /// # Errors
    /// It is not of that form.
    pub fn read(word: &str) -> Result<Define, Error> {
        let (name, value) = word.split_once('=').unwrap_or((word, "1"));
        let is_free = !name.starts_with("fg_") && !name.starts_with("__");
        let is_text = !value.contains(|c: char| c.is_control() || "#\\\"'".contains(c))
            && !value.contains("//")
            && !value.contains("/*");
        let is_name = matches!(tokens(name).as_slice(), [one] if one.is_word() && one.text == name);
        if is_name && is_free && is_text {
            Ok(Define {
                name: name.to_owned(),
                value: value.to_owned(),
            })
        } else {
            Err(Error::Define(word.to_owned()))
        }
    }
}

/// A condition of the text, and how it was decided.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Condition {
    /// Its line.
    pub line: usize,
    /// The line of its `#endif`.
    #[serde(skip)]
    pub end: usize,
    /// Its text.
    pub text: String,
    /// Whether the lines after it are taken.
    pub is_taken: bool,
}

/// A text without the lines that conditions drop.
#[derive(Clone, Debug)]
pub struct Preprocessed {
    /// The text, with comments and dropped lines blank.
    pub text: String,
    /// Its conditions, without those in dropped lines.
    pub conditions: Vec<Condition>,
}

/// The names that a language predefines in the version that is run.
fn predefined(language: Language) -> &'static [(&'static str, &'static str)] {
    match language {
        Language::Wgsl => &[("true", "1")],
        Language::Gles => &[
            ("GL_ES", "1"),
            ("__VERSION__", "300"),
            ("GL_FRAGMENT_PRECISION_HIGH", "1"),
        ],
        // The version comes from the text.
        Language::Glsl => &[("GL_core_profile", "1")],
        Language::Hlsl => &[
            ("__hlsl_dx_compiler", "1"),
            ("__HLSL_VERSION", "2018"),
            ("__SHADER_TARGET_MAJOR", "6"),
            ("__SHADER_TARGET_MINOR", "0"),
            ("__spirv__", "1"),
        ],
        Language::Slang => &[
            ("__SLANG__", "1"),
            ("__SLANG_COMPILER__", "1"),
            ("__HLSL_VERSION", "2018"),
        ],
    }
}

/// Joins continued lines into one line, followed by empty lines.
pub fn joined_lines(text: &str) -> String {
    let (mut out, mut owed) = (String::with_capacity(text.len()), 0);
    for line in text.split_inclusive('\n') {
        let bare = line.trim_end_matches(['\n', '\r']);
        match bare.strip_suffix('\\') {
            Some(begun) => {
                out += begun;
                owed += usize::from(line.ends_with('\n'));
            }
            None => {
                out += line;
                out.extend(std::iter::repeat_n('\n', owed));
                owed = 0;
            }
        }
    }
    out.extend(std::iter::repeat_n('\n', owed));
    out
}

/// Joins a comment that extends a directive over several lines into one line, followed by empty lines. Compilers remove comments
/// before they look where a directive ends.
pub fn joined_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut lines = text.split_inclusive('\n');
    while let Some(line) = lines.next() {
        let (mut whole, mut owed) = (line.to_owned(), 0);
        while line.trim_start().starts_with('#') && has_open_comment(&whole) {
            let Some(next) = lines.next() else { break };
            whole.truncate(whole.trim_end_matches(['\n', '\r']).len());
            whole += next;
            owed += 1;
        }
        out += &whole;
        out.extend(std::iter::repeat_n('\n', owed));
    }
    out
}

/// Whether a comment begins in a line and does not end in it.
fn has_open_comment(line: &str) -> bool {
    let mut rest = line;
    loop {
        let Some(at) = rest.find('/') else {
            return false;
        };
        rest = match rest.as_bytes().get(at + 1) {
            Some(b'/') => return false,
            Some(b'*') => match rest[at + 2..].find("*/") {
                None => return true,
                Some(end) => &rest[at + 2 + end + 2..],
            },
            _ => &rest[at + 1..],
        };
    }
}

/// Decides the conditions of a text that holds no comments.
///
/// # Errors
/// A condition cannot be decided, or has no end.
pub fn preprocessed(
    code: &str,
    language: Language,
    defines: &[Define],
) -> Result<Preprocessed, TextFault> {
    let mut reader = Reader::new(language, defines);
    let mut kept: Vec<String> = Vec::new();
    for (number, line) in code.lines().enumerate() {
        reader.line = number + 1;
        kept.push(reader.kept(line)?.unwrap_or_default());
    }
    match reader.open.last() {
        None => Ok(Preprocessed {
            text: kept.join("\n") + "\n",
            conditions: reader.conditions,
        }),
        Some(open) => Err((open.line, 1, "this condition has no `#endif`".to_owned())),
    }
}

/// A condition without its `#endif` yet.
struct Open {
    line: usize,
    /// Whether the code around it is taken.
    is_around_taken: bool,
    /// Whether one of its branches was taken.
    is_decided: bool,
    has_else: bool,
}

struct Reader {
    language: Language,
    macros: Macros,
    open: Vec<Open>,
    is_taken: bool,
    /// Whether a list of imports continues.
    in_import: bool,
    line: usize,
    conditions: Vec<Condition>,
}

impl Reader {
    fn new(language: Language, defines: &[Define]) -> Reader {
        let own = predefined(language).iter();
        let own = own.map(|(name, value)| ((*name).to_owned(), plain_macro(value)));
        let theirs = defines.iter();
        let theirs = theirs.map(|one| (one.name.clone(), plain_macro(&one.value)));
        Reader {
            language,
            macros: own.chain(theirs).collect(),
            open: Vec::new(),
            is_taken: true,
            in_import: false,
            line: 0,
            conditions: Vec::new(),
        }
    }

    /// A line as it is kept. None where it is dropped.
    fn kept(&mut self, line: &str) -> Result<Option<String>, TextFault> {
        if self.in_import {
            self.in_import = !line.contains('}');
            return Ok(None);
        }
        if !line.trim_start().starts_with('#') || line.trim_start().starts_with("#{") {
            return Ok(self.is_taken.then(|| self.replaced(line)));
        }
        let tokens = tokens(line);
        let rest = tokens.get(1..).unwrap_or(&[]);
        let word = text_at(rest, 0);
        match word {
            "if" | "ifdef" | "ifndef" => self.begin(line, rest)?,
            "elif" | "else" => self.otherwise(line, rest)?,
            "endif" => self.end()?,
            _ if !self.is_taken => {}
            _ if self.language == Language::Wgsl => self.oil(line, word, &tokens)?,
            "define" => {
                self.macros.extend(defined_macro(&tokens));
                return Ok(Some(line.to_owned()));
            }
            "undef" => {
                self.macros.remove(text_at(rest, 1));
                return Ok(Some(line.to_owned()));
            }
            "error" => return Err(self.fault(&Foreign(line.trim()).to_string())),
            "line" | "pragma" => {}
            _ => return Ok(Some(line.to_owned())),
        }
        Ok(None)
    }

    /// A directive of naga_oil that is not a condition.
    fn oil(&mut self, line: &str, word: &str, tokens: &[Token]) -> Result<(), TextFault> {
        match word {
            "define" => {
                if let Some((name, mut known)) = defined_macro(tokens) {
                    if known.body.is_empty() {
                        known = plain_macro("1");
                    }
                    self.macros.insert(name, known);
                }
            }
            "import" => self.in_import = line.contains('{') && !line.contains('}'),
            "define_import_path" => {}
            _ => return Err(self.fault("WGSL has no such line, nor has naga_oil")),
        }
        Ok(())
    }

    /// A line of WGSL with values in place of `#{NAME}`, as naga_oil does it.
    fn replaced(&self, line: &str) -> String {
        if self.language != Language::Wgsl || !line.contains("#{") {
            return line.to_owned();
        }
        let put = |text: String, (name, known): (&String, &Macro)| {
            text.replace(&format!("#{{{name}}}"), &known.body.concat())
        };
        self.macros.iter().fold(line.to_owned(), put)
    }

    fn fault(&self, what: &str) -> TextFault {
        (self.line, 1, what.to_owned())
    }

    /// Whether a condition holds: `if …`, `ifdef NAME`, `ifndef NAME`, `elif …`.
    fn decided(&self, line: &str, condition: &[Token]) -> Result<bool, TextFault> {
        if let Some((_, column, what)) = directives::fault(line) {
            return Err((self.line, column, what));
        }
        let [word, rest @ ..] = condition else {
            return Ok(true);
        };
        let name = text_at(rest, 0);
        match word.text {
            "ifdef" | "ifndef" if name.is_empty() => Err(self.fault("it asks for no name")),
            "ifdef" => Ok(self.macros.contains_key(name)),
            "ifndef" => Ok(!self.macros.contains_key(name)),
            _ => {
                let value = condition_value(&words(rest), &self.macros);
                let undecided = |why: String| {
                    self.fault(&format!(
                        "the condition cannot be decided: {why}; -D NAME=VALUE gives a name a value"
                    ))
                };
                value.map(|value| value != 0).map_err(undecided)
            }
        }
    }

    fn begin(&mut self, line: &str, condition: &[Token]) -> Result<(), TextFault> {
        let is_around_taken = self.is_taken;
        let is_taken = is_around_taken && self.decided(line, condition)?;
        self.open.push(Open {
            line: self.line,
            is_around_taken,
            is_decided: is_taken,
            has_else: false,
        });
        self.is_taken = is_taken;
        self.record(line, is_around_taken);
        Ok(())
    }

    fn otherwise(&mut self, line: &str, condition: &[Token]) -> Result<(), TextFault> {
        // naga_oil writes `#else if` for `#elif`.
        let condition = match condition {
            [word, rest @ ..] if word.text == "else" => rest,
            all => all,
        };
        let Some(open) = self.open.last().filter(|open| !open.has_else) else {
            return Err(self.fault("no `#if` before it is open"));
        };
        let (is_around_taken, is_decided) = (open.is_around_taken, open.is_decided);
        self.is_taken = is_around_taken && !is_decided && self.decided(line, condition)?;
        if let Some(open) = self.open.last_mut() {
            open.is_decided |= self.is_taken;
            open.has_else = condition.is_empty();
        }
        self.record(line, is_around_taken);
        Ok(())
    }

    fn record(&mut self, line: &str, is_around_taken: bool) {
        if is_around_taken {
            let words: Vec<&str> = line.split_whitespace().collect();
            self.conditions.push(Condition {
                line: self.line,
                end: usize::MAX,
                text: words.join(" "),
                is_taken: self.is_taken,
            });
        }
    }

    fn end(&mut self) -> Result<(), TextFault> {
        let Some(open) = self.open.pop() else {
            return Err(self.fault("no `#if` before it is open"));
        };
        self.is_taken = open.is_around_taken;
        for condition in &mut self.conditions {
            if condition.line >= open.line && condition.end == usize::MAX {
                condition.end = self.line;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(language: Language, defines: &[&str], text: &str, expected: &str) {
        let defines: Vec<Define> = defines
            .iter()
            .map(|word| Define::read(word).unwrap())
            .collect();
        let made = preprocessed(text, language, &defines).unwrap();
        assert_eq!(made.text.lines().count(), text.lines().count(), "{text}");
        let lines: Vec<&str> = made.text.lines().filter(|line| !line.is_empty()).collect();
        assert_eq!(lines.join("|"), expected, "{text}");
    }

    #[test]
    fn the_branch_that_a_compiler_takes_is_kept() {
        let text = "#ifdef A\na\n#elif B > 1\nb\n#else\nc\n#endif\nd\n";
        check(Language::Gles, &[], text, "c|d");
        check(Language::Gles, &["A"], text, "a|d");
        check(Language::Hlsl, &["B=2"], text, "b|d");
        let nested = "#if 0\n#if 1\na\n#else\nb\n#endif\n#error no\n#elif defined(GL_ES) && __VERSION__ >= 300\nc\n#endif\n";
        check(Language::Gles, &[], nested, "c");
        check(Language::Hlsl, &[], nested, "");
        let set = "#ifndef N\n#define N 3\n#endif\n#if N == 3\na\n#undef N\n#endif\n#ifdef N\nb\n#endif\n";
        check(Language::Hlsl, &[], set, "#define N 3|a|#undef N");
        check(Language::Hlsl, &["N=4"], set, "b");
    }

    #[test]
    fn wgsl_is_read_as_bevy_reads_it() {
        let text = "#define_import_path a::b\n#import c::{\n  d,\n}\n#ifdef A\na\n#else if N == 2\nb\n#else ifdef C\nc\n#else\nconst n = #{N};\n#endif\n";
        check(Language::Wgsl, &["N=3"], text, "const n = 3;");
        check(Language::Wgsl, &["N=2"], text, "b");
        check(Language::Wgsl, &["A=true"], text, "a");
    }

    #[test]
    fn conditions_say_where_they_end_and_what_they_came_to() {
        let made = preprocessed("#ifdef  A\n#else\nx\n#endif\n", Language::Gles, &[]);
        let found: Vec<_> = made
            .unwrap()
            .conditions
            .into_iter()
            .map(|one| (one.line, one.end, one.text, one.is_taken))
            .collect();
        assert_eq!(
            found,
            [
                (1, 4, "#ifdef A".to_owned(), false),
                (2, 4, "#else".to_owned(), true)
            ]
        );
    }

    #[test]
    fn what_cannot_be_decided_is_refused_with_its_line() {
        for (text, line) in [
            ("x\n#if 1\n", 2),
            ("#endif\n", 1),
            ("#if 1\n#else\n#else\n#endif\n", 3),
            ("#if 1.5\n#endif\n", 1),
            ("\n#error use another\n", 2),
            ("#if __has_include(a)\n#endif\n", 1),
        ] {
            let fault = preprocessed(text, Language::Hlsl, &[]).unwrap_err();
            assert_eq!(fault.0, line, "{text}: {fault:?}");
        }
    }

    #[test]
    fn lines_that_go_on_become_one() {
        assert_eq!(
            joined_lines("#define A \\\n b \\\n c\nd\n"),
            "#define A  b  c\n\n\nd\n"
        );
        assert_eq!(joined_lines("a\\\r\nb"), "ab\n");
        let text = "#define A /* one\ntwo */ 5.0\nb /* c\n */ d\n#if X // /*\n";
        let joined = "#define A /* onetwo */ 5.0\n\nb /* c\n */ d\n#if X // /*\n";
        assert_eq!(joined_comments(text), joined);
    }
}
