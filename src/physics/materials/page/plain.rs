//! Converts HTML or Markdown to one line of plain text, and finds its link. Pages use a handful of tags, and will use Markdown.

use crate::physics::materials::is_hidden;

/// The longest tag or mark that is searched for. Without an end within it, a `<` is a `<`. Together with the limit on the text,
/// ten times what any page has, it keeps a hostile text from being searched to its end at every letter.
const LONGEST: usize = 2_000;
const LONGEST_TEXT: usize = 20_000;
/// The deepest nesting of marks, as in `[*Phys. Rev.* **6**](...)`.
const DEEPEST: u8 = 4;

/// One line of text, without tags and marks, and with entities resolved. A superscript keeps a `^`: 10<sup>15</sup> is not 1015.
pub fn line(text: &str) -> String {
    let plain = |line| unmarked(&untagged(line), DEEPEST);
    let lines: Vec<String> = first(text, LONGEST_TEXT).lines().map(plain).collect();
    let whole = resolved(&lines.join(" "));
    let legal: String = whole
        .chars()
        .map(|c| if is_hidden(c) { ' ' } else { c })
        .collect();
    legal.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The first DOI as a link, or else the first link, or else nothing.
pub fn link(text: &str) -> String {
    let links = || links(first(text, LONGEST_TEXT));
    links()
        .find_map(doi)
        .or_else(|| links().next())
        .unwrap_or_default()
}

fn links(text: &str) -> impl Iterator<Item = String> {
    let starts = text.match_indices("http").map(|(at, _)| at);
    starts.filter_map(|at| link_at(text, at))
}

/// The link that starts here. It ends at the quote that it began with, or at a space or bracket.
fn link_at(text: &str, at: usize) -> Option<String> {
    let rest = &text[at..];
    if !rest.starts_with("http://") && !rest.starts_with("https://") {
        return None;
    }
    let quote = text[..at]
        .chars()
        .next_back()
        .filter(|c| ['"', '\''].contains(c));
    let mut open = 0;
    let ends = |c: char| match quote {
        Some(quote) => c == quote || c.is_control(),
        None => {
            open += i32::from(c == '(') - i32::from(c == ')');
            open < 0 || c.is_whitespace() || ['"', '\'', '<', '>', ']', '['].contains(&c)
        }
    };
    let length = rest.find(ends).unwrap_or(rest.len());
    let found = rest[..length].trim_end_matches(['.', ',', ';', ' ']);
    (found.len() <= LONGEST).then(|| resolved(found).replace(' ', "%20"))
}

/// `https://doi.org/10....` for a link that holds a DOI, at doi.org or at a journal.
fn doi(link: String) -> Option<String> {
    let at = link.find("/10.")?;
    let registrant = link[at + 4..].split('/').next()?;
    let is_doi =
        registrant.len() >= 4 && registrant.chars().all(|c| c.is_ascii_digit() || c == '.');
    let path = &link[at..];
    (is_doi && path.len() > registrant.len() + 5).then(|| format!("https://doi.org{path}"))
}

fn untagged(text: &str) -> String {
    replaced(text, '<', |rest| {
        let length = tag_length(rest)?;
        let begins = |tag: &str| rest.starts_with(tag);
        let meant = if begins("<sup") {
            "^"
        } else if begins("<br") || begins("</br") {
            " "
        } else {
            ""
        };
        Some((meant.to_owned(), length))
    })
}

/// A text in which `meant` says what stands for the rest of it from each `mark` on, and how many bytes that replaces. Where it
/// says nothing, the mark stays.
fn replaced(text: &str, mark: char, meant: impl Fn(&str) -> Option<(String, usize)>) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(mark) {
        plain.push_str(&rest[..at]);
        rest = &rest[at..];
        let (meant, length) = meant(rest).unwrap_or((mark.to_string(), mark.len_utf8()));
        plain.push_str(&meant);
        rest = &rest[length..];
    }
    plain + rest
}

/// The length in bytes of the tag that a text starts with. `<100>` is a direction in a crystal, and `<` alone means less than.
fn tag_length(text: &str) -> Option<usize> {
    let name = text[1..].strip_prefix('/').unwrap_or(&text[1..]);
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return None;
    }
    let mut quote = None;
    for (at, c) in text.char_indices().take(LONGEST) {
        match (quote, c) {
            (None, '>') => return Some(at + 1),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
    }
    None
}

/// Markdown's links and emphases reduced to their text. A `*` that nothing closes marks a footnote, and stays.
fn unmarked(text: &str, depth: u8) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let starts = !plain.ends_with(|c: char| c.is_alphanumeric());
        let marked = match c {
            _ if depth == 0 => None,
            '[' => linked(rest),
            '*' | '_' if starts => emphasised(rest, c),
            _ => None,
        };
        let length = match marked {
            Some((inside, length)) => {
                plain.push_str(&unmarked(inside, depth - 1));
                length
            }
            None => {
                plain.push(c);
                c.len_utf8()
            }
        };
        rest = &rest[length..];
    }
    plain
}

/// The text of `[text](link)`, and the length of the whole in bytes.
fn linked(rest: &str) -> Option<(&str, usize)> {
    let middle = first(rest, LONGEST).find("](")?;
    let link = link_at(rest, middle + 2).unwrap_or_default();
    let end = middle + 2 + link.len();
    let is_link =
        !link.is_empty() && !rest[1..middle].contains('[') && rest.get(end..)?.starts_with(')');
    is_link.then_some((&rest[1..middle], end + 1))
}

/// The text between a run of marks and the same run again, and the length of the whole in bytes.
fn emphasised(rest: &str, mark: char) -> Option<(&str, usize)> {
    let run = rest.chars().take(4).take_while(|c| *c == mark).count();
    let marks = &rest[..run];
    let inside = &rest[run..];
    if run > 3 || inside.starts_with(char::is_whitespace) {
        return None;
    }
    let length = first(inside, LONGEST).find(marks)?;
    let after = &inside[length + run..];
    let closes = length > 0
        && !inside[..length].ends_with(char::is_whitespace)
        && !after.starts_with(|c: char| c.is_alphanumeric() || c == mark);
    closes.then_some((&inside[..length], length + 2 * run))
}

/// The first characters of a text.
fn first(text: &str, count: usize) -> &str {
    let end = text.char_indices().nth(count);
    end.map_or(text, |(at, _)| &text[..at])
}

/// The named entities that pages use, and similar ones. Others stay as they are: `&url=` occurs in links.
const ENTITIES: [(&str, &str); 16] = [
    ("amp", "&"),
    ("lt", "<"),
    ("gt", ">"),
    ("quot", "\""),
    ("apos", "'"),
    ("nbsp", " "),
    ("times", "\u{d7}"),
    ("deg", "\u{b0}"),
    ("plusmn", "\u{b1}"),
    ("micro", "\u{b5}"),
    ("mu", "\u{3bc}"),
    ("lambda", "\u{3bb}"),
    ("ndash", "\u{2013}"),
    ("mdash", "\u{2014}"),
    ("minus", "\u{2212}"),
    ("shy", ""),
];

fn resolved(text: &str) -> String {
    replaced(text, '&', entity)
}

/// The meaning of the entity at the start of a text, and its length in bytes.
fn entity(rest: &str) -> Option<(String, usize)> {
    const LONGEST_NAME: usize = 10;
    let end = first(rest, LONGEST_NAME).find(';')?;
    let name = &rest[1..end];
    let meant = match name.strip_prefix('#') {
        Some(number) => numbered(number)?.to_string(),
        None => {
            let known = ENTITIES.iter().find(|(entity, _)| *entity == name)?;
            known.1.to_owned()
        }
    };
    Some((meant, end + 1))
}

fn numbered(number: &str) -> Option<char> {
    let code = match number.strip_prefix(['x', 'X']) {
        Some(hexadecimal) => u32::from_str_radix(hexadecimal, 16).ok()?,
        None => number.parse().ok()?,
    };
    char::from_u32(code)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, plain: &str) {
        assert_eq!(line(text), plain);
    }

    #[test]
    fn html_becomes_a_line() {
        check("a\n  b<br>c <i>J.</i> <b>6</b>", "a b c J. 6");
        check(
            "<a href=\"https://x.y/?a=1&b=<2>\">CH<sub>3</sub></a>",
            "CH3",
        );
        check(
            "2.7&times;10<sup>15</sup> cm<sup>-3</sup>",
            "2.7\u{d7}10^15 cm^-3",
        );
        check(
            "orientation <100>; \u{3bb} < 2 & > 1",
            "orientation <100>; \u{3bb} < 2 & > 1",
        );
        check(
            "&lt;b&gt; &amp;lt; &#176;C &#x3bc;m &#0; &#xffffff; &url=1;",
            "<b> &lt; \u{b0}C \u{3bc}m &#xffffff; &url=1;",
        );
        check("<nobr>a</nobr><a unclosed", "a<a unclosed");
        check("a\tb\u{1b}[0m\u{7f}", "a b [0m");
        check("a\u{9b}b\u{202e}c&#x9d;d&#8238;e", "a b c d e");
        check("", "");
    }

    #[test]
    fn markdown_becomes_a_line() {
        check(
            "[*Phys. Rev. B* **6**, 4370 (1972)](https://doi.org/10.1103/PhysRevB.6.4370) x",
            "Phys. Rev. B 6, 4370 (1972) x",
        );
        check("[a](https://doi.org/10.1016/0925-3467(93)90035-Y).", "a.");
        check("*Ref. 2 provides a formula", "*Ref. 2 provides a formula");
        check("* Ref. 2 * and ** more", "* Ref. 2 * and ** more");
        check("_a_ snake_case_name 2*3*4", "a snake_case_name 2*3*4");
        check("[1] and [see](later)", "[1] and [see](later)");
        check("****a****", "****a****");
    }

    #[track_caller]
    fn leads(text: &str, to: &str) {
        assert_eq!(link(text), to);
    }

    #[test]
    fn a_doi_goes_before_other_links() {
        leads(
            "<a href=\"https://doi.org/10.1103/PhysRevB.6.4370\">",
            "https://doi.org/10.1103/PhysRevB.6.4370",
        );
        leads(
            "http://a.b/c, then (http://dx.doi.org/10.1364/AO.37.005271).",
            "https://doi.org/10.1364/AO.37.005271",
        );
        leads(
            "'https://aip.scitation.org/doi/10.1063/5.0048969'",
            "https://doi.org/10.1063/5.0048969",
        );
        leads(
            "[x](https://doi.org/10.1016/0925-3467(93)90035-Y)",
            "https://doi.org/10.1016/0925-3467(93)90035-Y",
        );
        leads(
            "\"https://doi.org/10.1002/a:2<559::B>3.0\"",
            "https://doi.org/10.1002/a:2<559::B>3.0",
        );
        leads("see https://a.b/10.5/x.", "https://a.b/10.5/x");
        leads("httpd http:/x", "");
    }

    #[test]
    fn a_hostile_text_is_quick() {
        for text in ["<a \"", "[](http", "*a ", "&", "[", "_"] {
            let long = text.repeat(1 << 20);
            line(&long);
            link(&long);
        }
    }
}
