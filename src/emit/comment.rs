//! Comment text that is safe in every language: ASCII, no line longer than a page is wide, none that ends in a
//! backslash, which would swallow the next line.

/// The width that lines are broken at, without the comment's start.
const WIDTH: usize = 112;
/// What a broken line goes on with, beyond its own indentation.
const HANGING: &str = "    ";

/// These lines, made safe and broken between words.
pub fn lines(lines: Vec<String>) -> Vec<String> {
    lines.iter().flat_map(|line| broken(&safe(line))).collect()
}

fn safe(line: &str) -> String {
    let legal = |c: char| {
        if c == ' ' || c.is_ascii_graphic() {
            c
        } else {
            '?'
        }
    };
    line.chars()
        .map(legal)
        .collect::<String>()
        .trim_end_matches(['\\', ' '])
        .to_owned()
}

fn broken(line: &str) -> Vec<String> {
    let indent: String = line.chars().take_while(|c| *c == ' ').collect();
    let mut lines = vec![indent.clone()];
    let mut is_empty = true;
    for word in line.split_whitespace() {
        let last = lines.last_mut().expect("it starts with a line");
        if !is_empty && last.len() + 1 + word.len() > WIDTH {
            lines.push(format!("{indent}{HANGING}{word}"));
        } else {
            last.push_str(if is_empty { "" } else { " " });
            last.push_str(word);
        }
        is_empty = false;
    }
    // A backslash that ended up last on a broken line would swallow the next one just as well.
    lines
        .iter()
        .map(|line| line.trim_end_matches('\\').to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(line: &str, expected: &[&str]) {
        assert_eq!(lines(vec![line.to_owned()]), expected);
    }

    #[test]
    fn what_could_escape_from_a_comment_cannot() {
        check("a\nb", &["a?b"]);
        check("ends in \\", &["ends in"]);
        check("Štetić", &["?teti?"]);
        check("", &[""]);
    }

    #[test]
    fn long_lines_are_broken_between_words() {
        let long = format!("  {} {}", "a".repeat(80), "b".repeat(80));
        let (first, second) = (
            format!("  {}", "a".repeat(80)),
            format!("      {}", "b".repeat(80)),
        );
        check(&long, &[&first, &second]);
    }
}
