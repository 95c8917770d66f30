//! In what a file differs from the one that would be written today, in words.

/// Bytes of a word of a module; its second and third say for which SPIR-V and by which program it was written.
const WORD: usize = 4;
const HEAD: std::ops::Range<usize> = WORD..3 * WORD;

/// In what a module differs.
pub fn of_modules(found: &[u8], today: &[u8]) -> &'static str {
    if found.get(HEAD) == today.get(HEAD) {
        "its instructions differ"
    } else {
        "its head differs: the version of SPIR-V, or the program that wrote it"
    }
}

/// In what a text differs.
pub fn of_texts(found: &str, today: &str) -> String {
    let (comments, code) = (
        first_difference(found, today, true),
        first_difference(found, today, false),
    );
    match (code, comments) {
        (Some(place), _) => format!("its code differs, first {place}"),
        (None, Some(place)) => {
            format!("its comments differ, first {place}, and its code does not")
        }
        (None, None) => "its blanks and empty lines differ".to_owned(),
    }
}

/// The first line of a text that is another in the other one: of its comments, or of its code. Lines count from 1.
fn first_difference(found: &str, today: &str, of_comments: bool) -> Option<String> {
    let lines = |text: &'_ str| -> Vec<(usize, String)> {
        let all = text
            .lines()
            .enumerate()
            .map(|(at, line)| (at + 1, line.trim()));
        let is_comment = |line: &str| line.starts_with("//") || line.starts_with("/*");
        let own = all.filter(|(_, line)| !line.is_empty() && is_comment(line) == of_comments);
        own.map(|(at, line)| (at, line.to_owned())).collect()
    };
    let (found_lines, today_lines) = (lines(found), lines(today));
    let pairs = found_lines.iter().zip(&today_lines);
    let same = pairs.take_while(|((_, a), (_, b))| a == b).count();
    match (found_lines.get(same), today_lines.get(same)) {
        (Some((line, _)), _) => Some(format!("in line {line}")),
        (None, Some((line, _))) => Some(format!("by today's line {line}, which it lacks")),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{of_modules, of_texts};

    #[test]
    fn the_first_line_is_named() {
        let today = "// head\n// error .1\n\nfn f() {\n    a\n}\n";
        for (found, says) in [
            (
                "// head\n// error .2\n\nfn f() {\n    a\n}\n",
                "its comments differ, first in line 2, and its code does not",
            ),
            (
                "// head\n\nfn f() {\n    a\n}\n",
                "its comments differ, first by today's line 2, which it lacks, and its code does not",
            ),
            (
                "// other\nfn f() {\n    b\n}\n",
                "its code differs, first in line 3",
            ),
            (
                "// head\n// error .1\nfn f() {\n",
                "its code differs, first by today's line 5, which it lacks",
            ),
            (
                "// head\n// error .1\nfn f() {\n  a\n}\n",
                "its blanks and empty lines differ",
            ),
        ] {
            assert_eq!(of_texts(found, today), says, "{found}");
        }
    }

    #[test]
    fn a_module_has_a_head() {
        let module =
            |version: u8, last: u8| [3, 2, 35, 7, 0, version, 1, 0, 28, 0, 0, 0, last, 0, 0, 0];
        assert!(of_modules(&module(3, 1), &module(4, 1)).starts_with("its head"));
        assert!(of_modules(&module(3, 2), &module(3, 1)).starts_with("its instructions"));
        assert!(of_modules(&[], &module(3, 1)).starts_with("its head"));
    }
}
