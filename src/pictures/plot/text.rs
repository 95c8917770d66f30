//! Text in pictures: fonts, estimated widths and line breaks.

use crate::generator::emit::xml_text;

/// The title of the chart.
pub const TITLE: Font = Font::new(17.0, 23.0, "600", "#17202b");
/// The title of a picture of several charts.
pub const HEADING: Font = Font::new(23.0, 31.0, "600", "#17202b");
/// The title of a panel of such a picture.
pub const PANEL: Font = Font::new(15.0, 21.0, "600", "#17202b");
/// The line beneath the title.
pub const SUBTITLE: Font = Font::new(12.0, 17.0, "400", "#556070");
/// The names of the curves.
pub const LEGEND: Font = Font::new(12.5, 18.0, "400", "#17202b");
/// The labels of the guide lines.
pub const MARK: Font = Font::new(11.5, 14.0, "400", "#3d4856");
/// The labels of the axes.
pub const AXIS: Font = Font::new(12.5, 17.0, "400", "#17202b");
/// The labels of the ticks.
pub const TICK: Font = Font::new(11.5, 16.0, "400", "#3d4856");
/// The command at the foot.
pub const FOOT: Font = Font::new(10.5, 14.0, "400", "#67717f");

/// A size, a line height, a weight and a colour of text.
pub struct Font {
    size: f64,
    /// The distance from one baseline to the next.
    pub leading: f64,
    weight: &'static str,
    fill: &'static str,
}

impl Font {
    const fn new(size: f64, leading: f64, weight: &'static str, fill: &'static str) -> Font {
        Font {
            size,
            leading,
            weight,
            fill,
        }
    }

    /// The estimated width of a line; most fonts set it a little narrower.
    pub fn width(&self, line: &str) -> f64 {
        let bold = if self.weight == "400" { 1.0 } else { 1.1 };
        line.chars().map(advance).sum::<f64>() * self.size * bold
    }

    /// The estimated width of the widest line.
    pub fn widest<L: AsRef<str>>(&self, lines: impl IntoIterator<Item = L>) -> f64 {
        let widths = lines.into_iter().map(|line| self.width(line.as_ref()));
        widths.fold(0.0, f64::max)
    }

    /// The height of a number of lines.
    pub fn height(&self, lines: &[String]) -> f64 {
        self.leading * lines.len() as f64
    }

    /// Breaks text into lines no wider than `room`; blank text has no lines.
    pub fn wrap(&self, text: &str, room: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text
            .split_ascii_whitespace()
            .flat_map(|word| self.cut(word, room))
        {
            match lines.last_mut() {
                Some(line) if self.width(&format!("{line} {word}")) <= room => {
                    line.push(' ');
                    line.push_str(&word);
                }
                _ => lines.push(word),
            }
        }
        lines
    }

    /// Cuts a word that alone is wider than `room`, such as a long path.
    fn cut(&self, word: &str, room: f64) -> Vec<String> {
        let mut pieces = vec![String::new()];
        for letter in word.chars() {
            let last = pieces.len() - 1;
            if !pieces[last].is_empty() && self.width(&format!("{}{letter}", pieces[last])) > room {
                pieces.push(letter.to_string());
            } else {
                pieces[last].push(letter);
            }
        }
        pieces
    }

    /// Lines of text from `top` down; `anchor` says which part of each is at `x`.
    pub fn draw(&self, lines: &[String], x: f64, top: f64, anchor: &str) -> Vec<String> {
        let baseline = top + (self.leading + 0.7 * self.size) / 2.0;
        let place = |(row, line): (usize, &String)| {
            let y = baseline + self.leading * row as f64;
            self.element(line, &format!("x=\"{x:.2}\" y=\"{y:.2}\""), anchor)
        };
        lines.iter().enumerate().map(place).collect()
    }

    /// A line of text as [`Font::draw`] sets it.
    pub fn draw_line(&self, line: &str, x: f64, top: f64, anchor: &str) -> String {
        self.draw(&[line.to_owned()], x, top, anchor).concat()
    }

    /// Lines of text that read upwards, centred on `y`, from `left` rightwards.
    pub fn draw_upwards(&self, lines: &[String], left: f64, y: f64) -> Vec<String> {
        let baseline = left + (self.leading + 0.7 * self.size) / 2.0;
        let place = |(row, line): (usize, &String)| {
            let x = baseline + self.leading * row as f64;
            let turn = format!("transform=\"translate({x:.2} {y:.2}) rotate(-90)\"");
            self.element(line, &turn, "middle")
        };
        lines.iter().enumerate().map(place).collect()
    }

    /// A line of text as [`Font::draw`] sets it, above a copy of itself with a rim in the paper's colour, which keeps it readable
    /// over lines. The copy is an element of its own: not every viewer knows `paint-order`.
    pub fn draw_with_rim(&self, line: &str, x: f64, top: f64, anchor: &str) -> [String; 2] {
        const RIM: &str = "<text aria-hidden=\"true\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" ";
        let text = self.draw_line(line, x, top, anchor);
        [text.replacen("<text ", RIM, 1), text]
    }

    fn element(&self, line: &str, place: &str, anchor: &str) -> String {
        format!(
            "<text {place} font-size=\"{}\" font-weight=\"{}\" fill=\"{}\" \
             text-anchor=\"{anchor}\">{}</text>",
            self.size,
            self.weight,
            self.fill,
            xml_text(line)
        )
    }
}

/// Words that begin with a capital.
pub fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// The width of a character as a part of the font size, after wide sans fonts.
fn advance(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | 'I' | ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.34,
        'f' | 'r' | 't' | '(' | ')' | '[' | ']' | '/' | '-' | 'J' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '—' | '…' => 0.98,
        'A'..='Z' => 0.72,
        '=' | '+' | '<' | '>' | '−' | '×' | '±' | '≈' | '≤' | '≥' => 0.84,
        '\u{2E80}'.. => 1.0,
        _ => 0.63,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_the_room() {
        let text = "one two  three\nfour https://example.org/a/long/path/without/any/break five";
        let lines = LEGEND.wrap(text, 90.0);
        assert!(lines.iter().all(|line| LEGEND.width(line) <= 90.0));
        let joined: String = lines.concat().split_whitespace().collect();
        assert_eq!(joined, text.split_whitespace().collect::<String>());
    }

    /// A viewer that draws strokes above fills must still show every letter.
    #[test]
    fn a_rim_stands_right_before_its_text() {
        let [rim, text] = TICK.draw_with_rim("a < b", 1.0, 2.0, "start");
        assert_eq!(text, TICK.draw_line("a < b", 1.0, 2.0, "start"));
        assert!(
            rim.contains("aria-hidden=\"true\" stroke=\"#ffffff\""),
            "{rim}"
        );
        assert!(!text.contains("stroke"), "{text}");
        let after = |element: &str| element.split_once(" x=").map(|(_, rest)| rest.to_owned());
        assert_eq!(after(&rim), after(&text));
    }

    #[test]
    fn short_text_is_one_line_and_blank_text_none() {
        assert_eq!(LEGEND.wrap("a b", 90.0), ["a b"]);
        assert!(LEGEND.wrap(" \n", 90.0).is_empty());
        assert_eq!(LEGEND.wrap("at 9\u{A0}nm", 50.0), ["at", "9\u{A0}nm"]);
    }

    #[test]
    fn a_room_too_narrow_for_a_letter_still_ends() {
        assert_eq!(LEGEND.wrap("ab", 1.0), ["a", "b"]);
    }
}
