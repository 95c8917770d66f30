//! Reads a table of numbers by wavelength and checks it row by row: the embedded tables and a user's light.
//!
//! ```text
//! # a comment; blank lines are allowed too
//! nm, power            one line of names, or none
//! 380, 49.9755         wavelength in nm, ascending; then numbers from 0 to 1e30
//! ```
//!
//! Numbers are separated by semicolons, by commas, or by spaces and tabs: by the first of the three that occurs in
//! the line, so that a decimal comma beside semicolons is found and reported.

use crate::physics::user_text::FileFault;

/// The wavelengths that a table may hold, in nm: 1 nm to 1 mm covers all of optics.
const LEAST_NM: f64 = 1.0;
const GREATEST_NM: f64 = 1e6;

/// The largest value of a table: far above any unit of light, and sums of it stay finite.
const GREATEST_VALUE: f64 = 1e30;

/// One row, and its line.
pub(super) struct SpectrumRow<const N: usize> {
    /// The line number, from 1.
    pub line: usize,
    /// Wavelength in nm, then the other columns.
    pub values: [f64; N],
}

/// Reads rows of `N` numbers, at least one. `columns` are their names and `file` is its name, both for messages.
pub(super) fn rows<const N: usize>(
    file: &str,
    text: &str,
    columns: [&str; N],
) -> Result<Vec<SpectrumRow<N>>, FileFault> {
    let mut rows: Vec<SpectrumRow<N>> = Vec::new();
    let mut names_seen = false;
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let mut fields = fields(line.split('#').next().unwrap_or(""));
        // Spreadsheets write a separator at the end of each line.
        if fields.len() > N && fields[fields.len() - 1].text.is_empty() {
            fields.pop();
        }
        if fields.is_empty() || (index == 0 && is_separator(line)) {
            continue;
        }
        if rows.is_empty() && !names_seen && fields.iter().all(|field| is_name(field.text)) {
            names_seen = true;
            continue;
        }
        let before = rows.last().map(|row| row.values[0]);
        let values = numbers(&fields, columns, before).map_err(|(offset, what)| {
            FileFault::new(file, index + 1, line[..offset].chars().count() + 1, what)
        })?;
        rows.push(SpectrumRow {
            line: index + 1,
            values,
        });
    }
    if rows.is_empty() {
        let what = format!("no row of numbers; a row is {}", columns.join(", "));
        return Err(FileFault::new(file, text.lines().count().max(1), 1, what));
    }
    Ok(rows)
}

struct Field<'a> {
    /// In bytes, from the line's beginning.
    offset: usize,
    text: &'a str,
}

/// The fields of a line without its comment; none for a blank line.
fn fields(line: &str) -> Vec<Field<'_>> {
    if line.trim().is_empty() {
        return Vec::new();
    }
    let separator = [';', ',']
        .into_iter()
        .find(|separator| line.contains(*separator));
    let mut fields = Vec::new();
    let mut offset = 0;
    // Every separator is one byte long.
    for part in line.split(|c: char| separator.map_or(c.is_ascii_whitespace(), |it| it == c)) {
        let text = part.trim();
        if separator.is_some() || !text.is_empty() {
            let blanks = part.len() - part.trim_start().len();
            fields.push(Field {
                offset: offset + blanks,
                text,
            });
        }
        offset += part.len() + 1;
    }
    fields
}

/// Whether a line tells a spreadsheet what separates the others: `sep=,`.
pub fn is_separator(line: &str) -> bool {
    let line = line.trim().trim_matches('"').to_lowercase();
    line.strip_prefix("sep=")
        .is_some_and(|sign| sign.chars().count() <= 1)
}

/// Whether a field can be the name of a column: it does not look like a number, not even like a misspelt one.
fn is_name(field: &str) -> bool {
    let begins_as_number = field.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    !field.is_empty() && !begins_as_number && field.parse::<f64>().is_err()
}

/// The numbers of a row that follows the wavelength `before`; a fault has its offset in bytes.
fn numbers<const N: usize>(
    fields: &[Field],
    columns: [&str; N],
    before: Option<f64>,
) -> Result<[f64; N], (usize, String)> {
    if fields.len() != N {
        let what = format!(
            "{} fields; a row is {} numbers: {}, separated by commas, semicolons, tabs or spaces",
            fields.len(),
            N,
            columns.join(", ")
        );
        return Err((fields[0].offset, what));
    }
    let mut values = [0.0; N];
    for (index, (field, name)) in fields.iter().zip(columns).enumerate() {
        values[index] =
            number(field.text, name, index == 0).map_err(|what| (field.offset, what))?;
    }
    match before {
        Some(before) if values[0] <= before => {
            let what = format!(
                "{} nm after {before} nm; wavelengths must ascend, each once",
                values[0]
            );
            Err((fields[0].offset, what))
        }
        _ => Ok(values),
    }
}

fn number(text: &str, name: &str, is_wavelength: bool) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| {
        format!("{name} is `{text}`, which is no number; a number is written like 0.5 or 1e-3")
    })?;
    let (low, high) = if is_wavelength {
        (LEAST_NM, GREATEST_NM)
    } else {
        (0.0, GREATEST_VALUE)
    };
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(format!(
            "{name} is {value}; it must lie between {low} and {high:e}"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<[f64; 2]>, FileFault> {
        let rows = rows("lamp.csv", text, ["nm", "power"])?;
        Ok(rows.into_iter().map(|row| row.values).collect())
    }

    #[test]
    fn every_separator_and_one_line_of_names() {
        let wanted = vec![[380.0, 1.0], [780.0, 2.5]];
        for text in [
            "380,1\n780,2.5",
            "380 , 1\r\n780 , 2.5\r\n",
            "380;1\n780; 2.5\n",
            "380\t1\n780\t2.5\n",
            "  380   1 # violet\n\n780 \t 2.5e0\n",
            "# a lamp\nnm,power\n380,1\n# half\n780,2.5\n",
            "\u{feff}Wavelength (nm); Power (W)\n380;1\n780,2.5\n",
            "wavelength power of it\n380 1\n780 2.5\n",
            "sep=,\r\nnm,power\r\n380,1\r\n780,2.5\r\n",
            "sep=;\nnm;power;\n380;1;\n780;2.5;\n",
        ] {
            assert_eq!(read(text).as_ref(), Ok(&wanted), "{text:?}");
        }
    }

    #[track_caller]
    fn check(text: &str, at: [usize; 2], says: &str) {
        let fault = read(text).expect_err("a fault");
        assert!(fault.what.contains(says), "{fault}");
        assert_eq!([fault.line, fault.column], at, "{fault}");
    }

    #[test]
    fn each_fault_names_its_place_and_what_is_allowed() {
        check("", [1, 1], "no row of numbers");
        check("# only this\nnm,power\n", [2, 1], "no row of numbers");
        check("380,1\n780", [2, 1], "1 fields; a row is 2 numbers");
        check("380,1\n 780,2,3", [2, 2], "3 fields");
        check("380,1,,\n", [1, 1], "3 fields");
        check("380;1\n780;2,5", [2, 5], "`2,5`, which is no number");
        check("380,1\n780,", [2, 5], "``, which is no number");
        check("38O,1\n", [1, 1], "`38O`");
        check("nm,power\nnm,power\n380,1", [2, 1], "`nm`");
        check("380,1\nnm,power", [2, 1], "`nm`");
        check("nan,nan", [1, 1], "nm is NaN");
        check("380,1\nινφ,inf", [2, 1], "`ινφ`");
        check(
            "380,1\n390, inf",
            [2, 6],
            "power is inf; it must lie between 0 and 1e30",
        );
        check("380,-1", [1, 5], "power is -1");
        check("380,1e400", [1, 5], "power is inf");
        check("0.38,1", [1, 1], "between 1 and 1e6");
        check("380,1\n380,1", [2, 1], "must ascend");
        check("380,1\n379,1", [2, 1], "379 nm after 380 nm");
    }

    #[test]
    fn nothing_makes_it_panic() {
        let text = "# é\nnm;µW\n380;1\n400 \t2\n780,2.5 #\n";
        for end in (0..text.len()).filter(|end| text.is_char_boundary(*end)) {
            for put in ["", "\0", "é", ",", ";", "\u{2003}", "#", "\n"] {
                let _ = read(&format!("{}{put}{}", &text[..end], &text[end..]));
                let _ = read(&format!("{}{put}", &text[..end]));
            }
        }
    }
}
