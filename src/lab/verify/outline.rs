//! The outline of a generated file: its declarations and its comments, with their lines. A file that somebody may have edited is
//! compared by it with what would be written.
//!
//! The outline of a text errs on the safe side: what our own text never holds (a quote, a backslash, a digraph) counts as a
//! declaration, because compilers disagree about what it hides.
//!
//! The outline of a module of SPIR-V has its entry points, its variables with their bindings, the number of its functions, and what
//! it asks of a device.

use crate::lab::gpu::spirv::{ENTRY_POINT, instructions, literal, words};
use crate::lab::verify::shader_words::{block_comment, is_name_part};

/// What a file declares, and what its comments say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outline {
    /// Declarations outside all bodies, directives, and characters that our text never holds.
    pub declared: Vec<Item>,
    /// Comments, a line each.
    pub comments: Vec<Item>,
    /// Words that begin a loop. No generated function holds one, and an endless one would hang a device.
    pub loops: Vec<Item>,
    /// Words that lower precision. Devices that heed them give wrong results; devices that ignore them give right ones.
    pub narrow: Vec<Item>,
}

impl Outline {
    /// The names of the functions that it declares.
    pub fn functions(&self) -> Vec<String> {
        let declared = self.declared.iter();
        let names = declared.filter_map(|item| function_name(&item.words));
        names.map(str::to_owned).collect()
    }
}

/// A declaration or a line of a comment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its line, from 1; 0 in a module, which has no lines.
    pub line: usize,
    /// Its words, separated by one space. For a function, its head.
    pub words: String,
}

/// What some language takes as the end of a line. WGSL ends `//` comments at all of them.
const LINE_ENDS: [char; 7] = [
    '\n', '\r', '\u{b}', '\u{c}', '\u{85}', '\u{2028}', '\u{2029}',
];
/// Characters that our text never holds, because languages read them differently: quotes, digraphs, trigraphs, `\` before a
/// line's end.
const STRANGE: [char; 5] = ['"', '\'', '\\', '%', '$'];

/// Words that begin a loop, or jump.
const LOOPS: [&str; 5] = ["for", "while", "loop", "do", "goto"];

/// How languages say that numbers have fewer bits: qualifiers of GLSL, types of HLSL, MSL and WGSL, without their sizes.
const NARROW: [&str; 7] = [
    "mediump",
    "lowp",
    "min16float",
    "min10float",
    "half",
    "float16_t",
    "f16",
];

/// The outline of a text. `nests`: whether comments within comments count, as in WGSL.
pub fn outline(text: &str, nests: bool) -> Outline {
    let text = text.replace("\r\n", "\n");
    let mut reader = Reader {
        rest: &text,
        line: 1,
        depth: 0,
        head: Vec::new(),
        begun: 1,
        found: Outline::default(),
    };
    while !reader.rest.is_empty() {
        reader.step(nests);
    }
    reader.close("");
    reader.found
}

struct Reader<'a> {
    rest: &'a str,
    line: usize,
    /// How many bodies are open.
    depth: usize,
    /// The words of the current declaration.
    head: Vec<&'a str>,
    /// The line of its first word.
    begun: usize,
    found: Outline,
}

impl<'a> Reader<'a> {
    /// Consumes so many bytes.
    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.line += taken.matches('\n').count();
        self.rest = rest;
        taken
    }

    fn step(&mut self, nests: bool) {
        let rest = self.rest;
        let first = rest.chars().next().unwrap_or(' ');
        if rest.starts_with("//") {
            self.comment(rest.find(LINE_ENDS).unwrap_or(rest.len()));
        } else if rest.starts_with("/*") {
            self.comment(block_comment(rest, nests));
        } else if first == '#' {
            let end = rest.find(LINE_ENDS).unwrap_or(rest.len());
            let end = rest[..end].find("//").unwrap_or(end);
            self.directive(end);
        } else if is_name_part(first) {
            let end = rest.find(|c| !is_name_part(c)).unwrap_or(rest.len());
            self.word(end);
        } else {
            self.sign(first);
        }
    }

    /// Consumes a comment of so many bytes: one item for each line.
    fn comment(&mut self, bytes: usize) {
        let first = self.line;
        let lines = self.take(bytes).lines().enumerate();
        let items = lines.map(|(i, line)| Item {
            line: first + i,
            words: line.trim_start_matches(['/', '*']).trim().to_owned(),
        });
        self.found.comments.extend(items);
    }

    fn directive(&mut self, bytes: usize) {
        let line = self.line;
        let text = self.take(bytes);
        let held = text.split(|c| !is_name_part(c));
        held.for_each(|word| self.note(line, word));
        let words: Vec<&str> = text.split_whitespace().collect();
        self.declare(line, words.join(" "));
    }

    fn word(&mut self, bytes: usize) {
        if self.head.is_empty() {
            self.begun = self.line;
        }
        let line = self.line;
        let word = self.take(bytes);
        self.note(line, word);
        if self.depth == 0 {
            self.head.push(word);
        }
    }

    /// Records a word that begins a loop or lowers precision.
    fn note(&mut self, line: usize, word: &str) {
        let words = word.to_owned();
        if LOOPS.contains(&word) {
            self.found.loops.push(Item { line, words });
        } else if NARROW.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit() || c == 'x'))
            || NARROW.contains(&word)
        {
            self.found.narrow.push(Item { line, words });
        }
    }

    fn sign(&mut self, sign: char) {
        if STRANGE.contains(&sign) || self.rest.starts_with("??") || self.rest.starts_with("<:") {
            self.declare(self.line, format!("{sign}"));
        }
        match sign {
            '{' => {
                self.close("{");
                self.depth += 1;
            }
            '}' if self.depth == 0 => self.declare(self.line, "}".to_owned()),
            '}' => self.depth -= 1,
            ';' => self.close(";"),
            _ if sign.is_whitespace() => {}
            _ => return self.word(sign.len_utf8()),
        }
        self.take(sign.len_utf8());
    }

    /// Ends the current declaration.
    fn close(&mut self, end: &str) {
        if self.depth == 0 && !self.head.is_empty() {
            let words = self.head.join(" ") + " " + end;
            self.declare(self.begun, words.trim_end().to_owned());
            self.head.clear();
        }
    }

    fn declare(&mut self, line: usize, words: String) {
        self.found.declared.push(Item { line, words });
    }
}

/// The name of the function that a declaration declares.
pub fn function_name(declared: &str) -> Option<&str> {
    let head = declared.strip_suffix(" {")?;
    let mut words = head[..head.find(" (")?].split(' ');
    words.next_back()
}

/// Instructions of SPIR-V 1.3, chapter 3.52: <https://registry.khronos.org/SPIR-V/specs/unified1/SPIRV.html>.
const NAME: u32 = 5;
const EXTENSION: u32 = 10;
const EXECUTION_MODE: u32 = 16;
const CAPABILITY: u32 = 17;
const FUNCTION: u32 = 54;
const VARIABLE: u32 = 59;
const DECORATE: u32 = 71;
const MEMBER_DECORATE: u32 = 72;
const LOOP_MERGE: u32 = 246;
/// Decorations, chapter 3.20.
const RELAXED_PRECISION: u32 = 0;
const LOCATION: u32 = 30;
const BINDING: u32 = 33;
const DESCRIPTOR_SET: u32 = 34;
/// The storage class of a function's local variables, chapter 3.7.
const LOCAL: u32 = 7;

/// What a module declares, in words. No item has a line.
pub fn declarations(bytes: &[u8]) -> Vec<Item> {
    let words = words(bytes);
    let declared = instructions(&words).filter_map(|(code, of)| declaration(code, of, &words));
    declared.map(|words| Item { line: 0, words }).collect()
}

/// The loops of a module.
pub fn loops(bytes: &[u8]) -> Vec<Item> {
    let words = words(bytes);
    let found = instructions(&words).filter(|(code, _)| *code == LOOP_MERGE);
    let item = |_| Item {
        line: 0,
        words: "OpLoopMerge".to_owned(),
    };
    found.map(item).collect()
}

/// All debug names of a module; functions are among them.
pub fn names(bytes: &[u8]) -> Vec<String> {
    let words = words(bytes);
    let named = instructions(&words).filter(|(code, _)| *code == NAME);
    named
        .map(|(_, of)| literal(of.get(1..).unwrap_or_default()))
        .collect()
}

/// The entry points of a module, by name.
pub fn entry_points(bytes: &[u8]) -> Vec<String> {
    let words = words(bytes);
    let name = |(code, operands): (u32, &[u32])| match operands {
        [_, _, name @ ..] if code == ENTRY_POINT => Some(literal(name)),
        _ => None,
    };
    instructions(&words).filter_map(name).collect()
}

fn declaration(instruction: u32, operands: &[u32], words: &[u32]) -> Option<String> {
    Some(match (instruction, operands) {
        (CAPABILITY, [which, ..]) => format!("capability {which}"),
        (EXTENSION, name) => format!("extension {}", literal(name)),
        (ENTRY_POINT, [model, _, name @ ..]) => {
            format!(
                "the entry point {} of execution model {model}",
                literal(name)
            )
        }
        (EXECUTION_MODE, [_, mode @ ..]) => format!("execution mode {mode:?}"),
        (FUNCTION, _) => "a function".to_owned(),
        (DECORATE, [_, RELAXED_PRECISION]) | (MEMBER_DECORATE, [_, _, RELAXED_PRECISION]) => {
            "a number of relaxed precision".to_owned()
        }
        (VARIABLE, [_, id, class, ..]) if *class != LOCAL => {
            format!("a variable of storage class {class}{}", place(*id, words))
        }
        _ => return None,
    })
}

/// Where a variable is bound.
fn place(id: u32, words: &[u32]) -> String {
    let named = [
        (DESCRIPTOR_SET, "set"),
        (BINDING, "binding"),
        (LOCATION, "location"),
    ];
    let of = |(decoration, name): (u32, &str)| {
        let is_it = |window: &&[u32]| window[..3] == [4 << 16 | DECORATE, id, decoration];
        let found = words.windows(4).find(is_it)?;
        Some(format!(", {name} {}", found[3]))
    };
    named.into_iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn declares(text: &str, nests: bool, expected: &[&str]) {
        let found = outline(text, nests).declared;
        let words: Vec<&str> = found.iter().map(|item| item.words.as_str()).collect();
        assert_eq!(words, expected, "{text}");
    }

    #[test]
    fn declarations_are_heads_and_directives() {
        let text = "// a\n#define A 1 // b\nfloat f(float x)\n{\n  { float y = x; } return y;\n}\nuniform float z;\n";
        let heads = ["#define A 1", "float f ( float x ) {", "uniform float z ;"];
        declares(text, false, &heads);
        assert_eq!(function_name(heads[1]), Some("f"));
        assert_eq!(function_name(heads[2]), None);
        let lines: Vec<usize> = outline(text, false)
            .declared
            .iter()
            .map(|item| item.line)
            .collect();
        assert_eq!(lines, [2, 3, 7]);
    }

    #[test]
    fn what_could_hide_a_declaration_counts_as_one() {
        declares(
            "// a\u{2028}override e: f32;",
            true,
            &["override e : f32 ;"],
        );
        declares("/* /* */ float e; /* */", false, &["float e ;"]);
        declares("/* /* */ float e; */ float f;", true, &["float f ;"]);
        declares(
            "float f() { \"//\"; } float e;",
            false,
            &["float f ( ) {", "\""],
        );
        declares("float f() { } }", false, &["float f ( ) {", "}"]);
        declares(
            "float f() { # define x\n }",
            false,
            &["float f ( ) {", "# define x"],
        );
    }

    #[test]
    fn loops_are_found_in_code_alone() {
        let loops = |text, nests| -> Vec<(usize, String)> {
            let found = outline(text, nests).loops.into_iter();
            found.map(|item| (item.line, item.words)).collect()
        };
        assert_eq!(loops("// for\n/* while\n */ float fore;", false), []);
        let text = "float f() {\n for (;;) {} }\n#define F while (x)\n";
        assert_eq!(
            loops(text, false),
            [(2, "for".to_owned()), (3, "while".to_owned())]
        );
        assert_eq!(loops("// a\u{2028}loop {}", true), [(1, "loop".to_owned())]);
        assert_eq!(loops("/* /* */ do", false).len(), 1);
    }

    #[test]
    fn narrow_numbers_are_found_in_code_alone() {
        let narrow = |text| -> Vec<String> {
            let found = outline(text, false).narrow.into_iter();
            found.map(|item| item.words).collect()
        };
        let text = "// half\nmediump vec3 f(highp vec3 x) { half3 y = f16(x); lowp float halfway; }\n#define F min16float\n";
        assert_eq!(
            narrow(text),
            ["mediump", "half3", "f16", "lowp", "min16float"]
        );
    }

    #[test]
    fn comments_have_their_lines() {
        let found = outline("// one\r\n/* two\r\nthree */ float f; // four", false);
        let comments: Vec<(usize, &str)> = found
            .comments
            .iter()
            .map(|item| (item.line, item.words.as_str()))
            .collect();
        assert_eq!(
            comments,
            [(1, "one"), (2, "two"), (3, "three */"), (3, "four")]
        );
    }

    #[test]
    fn bindings_and_entry_points_are_seen() {
        let name = u32::from_le_bytes(*b"main");
        let words: Vec<u32> = [
            &[0x0723_0203, 0x1_0300, 0, 9, 0][..],
            &[2 << 16 | CAPABILITY, 1],
            &[5 << 16 | ENTRY_POINT, 5, 2, name, 0],
            &[4 << 16 | DECORATE, 3, DESCRIPTOR_SET, 0],
            &[4 << 16 | DECORATE, 3, BINDING, 7],
            &[4 << 16 | VARIABLE, 1, 3, 12],
            &[4 << 16 | VARIABLE, 1, 4, LOCAL],
        ]
        .concat();
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let found: Vec<String> = declarations(&bytes)
            .into_iter()
            .map(|item| item.words)
            .collect();
        let expected = [
            "capability 1",
            "the entry point main of execution model 5",
            "a variable of storage class 12, set 0, binding 7",
        ];
        assert_eq!(found, expected);
        assert_eq!(entry_points(&bytes), ["main"]);
    }
}
