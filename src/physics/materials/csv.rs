//! Tables of n and k as comma-separated values: exports of refractiveindex.info, and plain files. A header names the unit.
//!
//! ```csv
//! wl,n
//! 0.1879,1.28
//!
//! wl,k
//! 0.1879,1.188
//! ```
//!
//! The first column is `wavelength_nm`, `wavelength_um`, `nm` or `um`, followed by `n`, `k`, or `n,k`. A header begins a table.
//! Where the header names no unit (`wavelength`, `lambda`, `wl`), wavelengths from 0.2 to 20 are micrometres, and those of 150 and
//! more nanometres. A `wl` outside of both is in micrometres, as the site exports it.
//!
//! Semicolons, tabs or blanks may replace commas, and `Wavelength (nm)` is read as `wavelength_nm`. Numbers may have decimal
//! commas, where these do not separate columns. The `.txt` and `.tsv` tables of Filmetrics and others have this form.

use std::borrow::Cow;

use super::decimal::{Unit, clipped};
use super::page::{Page, check_text};
use super::rows::{Columns, TableReader};
use crate::physics::spectra::is_separator;
use crate::physics::user_text::FileFault;

const ALLOWED: &str = "allowed are wavelength_nm, wavelength_um, nm, um, or wavelength, lambda or wl without a unit, and then n, k or n,k";

impl Page {
    /// Reads tables of n and k from comma-separated values. `file` is for messages, and for the page's own name.
    ///
    /// # Errors
    /// The text has no table, a row is not numbers, a wavelength or an index lies outside its limits, or the unit of the
    /// wavelengths cannot be told.
    pub fn parse_csv(file: &str, text: &str) -> Result<Page, FileFault> {
        check_text(file, text)?;
        let mut tables: Vec<Table> = Vec::new();
        for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
            // `sep=;` is for Excel.
            if line.trim().is_empty() || line.starts_with('#') || is_separator(line) {
                continue;
            }
            let numbered = Line { number, text: line };
            match (header(numbered), tables.last_mut()) {
                (Some(next), _) => tables.push(next),
                (None, Some(table)) => table.rows.push(numbered),
                (None, None) => return Err(FileFault::new(file, number, 1, no_header(line))),
            }
        }
        if tables.is_empty() {
            let what = format!("no table; a header begins one: {ALLOWED}");
            return Err(FileFault::new(file, 1, 1, what));
        }
        let mut page = Page {
            file: file.to_owned(),
            ..Page::default()
        };
        for table in &tables {
            page.add_table(table)?;
        }
        Ok(page)
    }

    /// The remark on a unit that the header does not name, if it was told by the size of the wavelengths.
    pub fn unit_remark(&self) -> Option<&str> {
        let mut remarks = self.remarks.iter().map(String::as_str);
        remarks.find(|remark| remark.starts_with(NO_UNIT))
    }

    fn add_table(&mut self, table: &Table) -> Result<(), FileFault> {
        let fault = |what| FileFault::new(&self.file, table.header.number, 1, what);
        if table.rows.is_empty() {
            return Err(fault("the table of this header has no rows".to_owned()));
        }
        table.check_decimals(&self.file)?;
        let (unit, remark) = table.unit().map_err(fault)?;
        let mut remarks = Vec::from_iter(remark);
        let mut rows = TableReader::new(table.columns, unit);
        for row in &table.rows {
            let numbers: Vec<Cow<str>> = table.cells(*row).map(with_point).collect();
            let read = rows.push(numbers.iter().map(AsRef::as_ref));
            read.map_err(|mut fault| {
                if table.separator == ',' && numbers.len() > table.columns.count() + 1 {
                    fault.what += DECIMAL_COMMAS;
                }
                let column = table.column(*row, fault.column);
                FileFault::new(&self.file, row.number, column, fault.what)
            })?;
        }
        let (n, k) = rows.curves(&mut remarks);
        self.add(n, k, remarks);
        Ok(())
    }
}

/// The beginning of the remark on a unit that was told by size.
const NO_UNIT: &str = "the header names no unit";

/// The advice for a row with too many columns between commas.
const DECIMAL_COMMAS: &str =
    "; where numbers have decimal commas, semicolons or tabs must stand between columns";

/// A line with its number in the file.
#[derive(Clone, Copy)]
struct Line<'a> {
    number: usize,
    text: &'a str,
}

/// A table: what its header says, and the lines of its rows.
struct Table<'a> {
    header: Line<'a>,
    columns: Columns,
    wavelength: WavelengthColumn,
    separator: char,
    rows: Vec<Line<'a>>,
}

/// What the name of the wavelength column says of the unit.
#[derive(Clone, Copy, PartialEq)]
enum WavelengthColumn {
    /// The unit.
    In(Unit),
    /// Nothing.
    Unsaid,
    /// `wl`: micrometres in the site's exports, and anything in the files of others.
    Wl,
}

/// Wavelengths without a unit that are micrometres.
const TAKEN_AS_UM: std::ops::RangeInclusive<f64> = 0.2..=20.0;
/// The least wavelength without a unit that is in nanometres.
const TAKEN_AS_NM: f64 = 150.0;
/// The largest ratio of neighbouring wavelengths in one unit.
const MOST_JUMP: f64 = 100.0;

impl<'a> Table<'a> {
    fn cells(&self, row: Line<'a>) -> impl Iterator<Item = &'a str> {
        cells(row.text, self.separator)
    }

    /// The column of the line in which a cell begins, both from where they are counted: lines from 1, cells from 0.
    fn column(&self, row: Line, cell: usize) -> usize {
        let before = pieces(row.text, self.separator).take(cell);
        before.map(|cell| cell.chars().count() + 1).sum::<usize>() + 1
    }

    /// The unit of its wavelengths, and a remark where it was told by their size.
    fn unit(&self) -> Result<(Unit, Option<String>), String> {
        if let WavelengthColumn::In(unit) = self.wavelength {
            return Ok((unit, None));
        }
        let wavelengths = self.wavelengths();
        let least = wavelengths.first().copied().unwrap_or(f64::INFINITY);
        let most = wavelengths.last().copied().unwrap_or(0.0);
        let remark = |unit: &str| {
            Some(format!(
                "{NO_UNIT}: wavelengths from {least} to {most} are taken as {unit}"
            ))
        };
        if least >= TAKEN_AS_NM {
            Ok((Unit::Nm, remark("nanometres")))
        } else if self.wavelength == WavelengthColumn::Wl {
            match jump(&wavelengths) {
                None => Ok((Unit::Um, None)),
                Some([low, high]) => Err(format!(
                    "{NO_UNIT}, and wavelengths jump from {low} to {high}: one unit is wanted; name the column wavelength_nm or wavelength_um"
                )),
            }
        } else if TAKEN_AS_UM.contains(&least) && TAKEN_AS_UM.contains(&most) {
            Ok((Unit::Um, remark("micrometres")))
        } else {
            Err(format!(
                "{NO_UNIT}, and wavelengths from {least} to {most} do not tell it: from {} to {} they are micrometres, from {TAKEN_AS_NM} on nanometres; name the column wavelength_nm or wavelength_um",
                TAKEN_AS_UM.start(),
                TAKEN_AS_UM.end()
            ))
        }
    }

    /// Its wavelengths as they stand there, the least first. What is no wavelength is a fault of its row.
    fn wavelengths(&self) -> Vec<f64> {
        let first = |row: &Line<'a>| with_point(self.cells(*row).next()?).parse().ok();
        let mut all: Vec<f64> = self.rows.iter().filter_map(first).collect();
        all.retain(|number| *number > 0.0 && number.is_finite());
        all.sort_by(f64::total_cmp);
        all
    }

    /// Refuses decimal commas beside decimal points: one of them may separate thousands.
    fn check_decimals(&self, file: &str) -> Result<(), FileFault> {
        let (mut points, mut commas) = (false, false);
        for row in &self.rows {
            for (place, cell) in self.cells(*row).enumerate() {
                points |= cell.contains('.');
                commas |= matches!(with_point(cell), Cow::Owned(_));
                if points && commas {
                    let what = format!(
                        "`{}`: this table has decimal commas and decimal points; one of them is allowed, and nothing between thousands",
                        clipped(cell)
                    );
                    let column = self.column(*row, place);
                    return Err(FileFault::new(file, row.number, column, what));
                }
            }
        }
        Ok(())
    }
}

/// The two neighbouring wavelengths between which the unit changes, as micrometres to nanometres would.
fn jump(wavelengths: &[f64]) -> Option<[f64; 2]> {
    let mut pairs = wavelengths.windows(2).map(|pair| [pair[0], pair[1]]);
    pairs.find(|[low, high]| high / low > MOST_JUMP)
}

/// A number with a decimal point in place of its decimal comma. Others are returned unchanged.
fn with_point(cell: &str) -> Cow<'_, str> {
    match cell.split_once(',') {
        Some((whole, rest))
            if !rest.contains(',') && rest.starts_with(|c: char| c.is_ascii_digit()) =>
        {
            Cow::Owned(format!("{whole}.{rest}"))
        }
        _ => Cow::Borrowed(cell),
    }
}

/// The separator that stands for any blanks.
const BLANK: char = ' ';

/// The table that this line begins, if it is a header.
fn header(line: Line) -> Option<Table> {
    let separators = [';', '\t', ',', BLANK];
    separators.into_iter().find_map(|separator| {
        let (wavelength, columns) = columns(line.text, separator)?;
        Some(Table {
            header: line,
            columns,
            wavelength,
            separator,
            rows: Vec::new(),
        })
    })
}

/// What the columns of a header are.
fn columns(line: &str, separator: char) -> Option<(WavelengthColumn, Columns)> {
    // With blanks as separators, a unit in brackets would be a cell of its own.
    let line = match separator {
        BLANK => line.replace(" (", "(").replace(" [", "["),
        _ => line.to_owned(),
    };
    let mut names: Vec<String> = cells(&line, separator).map(plain).collect();
    // `Wavelength, nm` between commas is two cells.
    if let [first, second, _, ..] = &names[..] {
        let is_bare = wavelength(first).is_some_and(|own| !matches!(own, WavelengthColumn::In(_)));
        if is_bare && unit(second).is_some() {
            let joined = format!("{first}_{second}");
            names.splice(..2, [joined]);
        }
    }
    let (first, rest) = names.split_first()?;
    let columns: Vec<&str> = rest.iter().map(|name| quantity(name)).collect();
    let columns = match columns[..] {
        ["n"] => Columns::N,
        ["k"] => Columns::K,
        ["n", "k"] => Columns::Nk,
        _ => return None,
    };
    Some((wavelength(first)?, columns))
}

/// What the name of a wavelength column says of the unit; none if it is the name of something else.
fn wavelength(name: &str) -> Option<WavelengthColumn> {
    match name {
        "wl" => return Some(WavelengthColumn::Wl),
        "wavelength" | "wavelengths" | "lambda" | "\u{3bb}" => {
            return Some(WavelengthColumn::Unsaid);
        }
        _ => {}
    }
    let bare = ["wavelength_", "lambda_", "wl_", "\u{3bb}_"]
        .into_iter()
        .find_map(|start| name.strip_prefix(start));
    let name = bare.unwrap_or(name).trim_start_matches("in_");
    unit(name).map(WavelengthColumn::In)
}

/// The unit of this name.
fn unit(name: &str) -> Option<Unit> {
    match name {
        "nm" | "nanometer" | "nanometre" | "nanometers" | "nanometres" => Some(Unit::Nm),
        "um" | "micron" | "microns" | "micrometer" | "micrometre" | "micrometers"
        | "micrometres" => Some(Unit::Um),
        _ => None,
    }
}

/// `n` or `k` for the usual names of these columns. Other names are returned unchanged.
fn quantity(name: &str) -> &str {
    match name {
        "refractive_index" | "refractive_index_n" | "n_refractive_index" | "index" => "n",
        "extinction_coefficient"
        | "extinction_coefficient_k"
        | "k_extinction_coefficient"
        | "kappa" => "k",
        other => other,
    }
}

/// `"Wavelength (µm)"` as `wavelength_um`.
fn plain(cell: &str) -> String {
    let cell = cell.to_lowercase().replace(['\u{b5}', '\u{3bc}'], "u");
    let words = cell.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("_")
}

/// The cells of a line. Blanks and a separator at its end add no empty cell.
fn cells(line: &str, separator: char) -> impl Iterator<Item = &str> {
    let line = line.trim_end();
    let line = line.strip_suffix(separator).unwrap_or(line);
    let is_cell = move |cell: &&str| separator != BLANK || !cell.is_empty();
    pieces(line, separator).filter(is_cell).map(bare)
}

/// What stands between the separators of a line. A separator in quotes is none.
fn pieces(line: &str, separator: char) -> impl Iterator<Item = &str> {
    let mut is_quoted = false;
    line.split(move |c: char| {
        is_quoted ^= c == '"';
        let is_between = match separator {
            BLANK => c.is_whitespace(),
            _ => c == separator,
        };
        is_between && !is_quoted
    })
}

fn bare(cell: &str) -> &str {
    let cell = cell.trim();
    let inside = cell
        .strip_prefix('"')
        .and_then(|cell| cell.strip_suffix('"'));
    inside.unwrap_or(cell)
}

/// What is wrong with a line before any header.
fn no_header(line: &str) -> String {
    let found = clipped(line.trim());
    let sign = line.trim_start_matches(['"', ' ', '+', '-', '.']);
    if sign.starts_with(|c: char| c.is_ascii_digit()) {
        format!("`{found}` stands before any header, which names the unit; {ALLOWED}")
    } else {
        format!("`{found}` is no header that is understood; {ALLOWED}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::DispersionCurve;

    fn table(points: &[(f64, f64)]) -> Option<DispersionCurve> {
        DispersionCurve::table(points.to_vec())
    }

    #[track_caller]
    fn check(text: &str, n: &[(f64, f64)], k: &[(f64, f64)]) {
        let page = Page::parse_csv("gold.csv", text).expect("it is good");
        assert_eq!((page.n, page.k), (table(n), table(k)));
    }

    #[test]
    fn exports_and_plain_files_are_read() {
        let (n, k) = ([(226.1, 1.5)], [(226.1, 2.0)]);
        check("wl,n\n0.2261,1.5\n\nwl,k\n0.2261,2\n", &n, &k);
        check("wl,n\r\n2.26100E-01,1.5\r\nwl,k\r\n0.2261,2\r\n", &n, &k);
        check("wavelength_nm,n,k\n226.1,1.5,2\n", &n, &k);
        check("um, n, k\n0.2261, 1.5, 2", &n, &k);
        check(
            "\u{feff}# mine\n\"Wavelength (\u{b5}m)\",\"n\"\n\"0.2261\",\"1.5\"\n",
            &n,
            &[],
        );
        check("nm;n;k\n226.1;1.5;2\n", &n, &k);
        check("nm\tk\n226.1\t2\n", &[], &k);
        // Filmetrics, the site's text with tabs, a header of words, blanks as separators, a separator at the end.
        check("Wavelength(nm)\tn\tk\r\n226.1\t1.5\t2\r\n", &n, &k);
        check("wl\tn\tk\n0.2261\t1.5\t2\n", &n, &k);
        check("Wavelength, \u{b5}m\tn\tk\n0.2261\t1.5\t2\n", &n, &k);
        check(
            "Wavelength [nm]; Refractive index n; Extinction coefficient k\n226.1;1.5;2;\n",
            &n,
            &k,
        );
        check("  wavelength (nm)   n   k\n  226.1   1.5   2.0\n", &n, &k);
        check("\u{3bb} (nm),n,k,\n226.1,1.5,2,\n", &n, &k);
        check("sep=;\nnm;n;k\n226.1;1.5;2\n", &n, &k);
        check("Wavelength in microns,n,k\n0.2261,1.5,2\n", &n, &k);
    }

    /// Tables as spreadsheets and instruments of many countries write them.
    #[test]
    fn tables_are_read_as_people_have_them() {
        let (n, k) = ([(226.1, 1.5)], [(226.1, 2.0)]);
        // A comma before the unit, with each separator, quoted and not.
        check("Wavelength, \u{b5}m;n;k\n0.2261;1.5;2\n", &n, &k);
        check("Wavelength, \u{b5}m,n,k\n0.2261,1.5,2\n", &n, &k);
        check("\"Wavelength, nm\",n,k\n226.1,1.5,2\n", &n, &k);
        check("Wavelength, um n k\n0.2261 1.5 2\n", &n, &k);
        check("Wavelength [um]\tn\tk\n0.2261\t1.5\t2\n", &n, &k);
        check("Wavelength [um] n k\n0.2261 1.5 2\n", &n, &k);
        check("WAVELENGTH_NM,N,K\n226.1,1.5,2\n", &n, &k);
        check("lambda (nanometer)\tn\tk\n226.1\t1.5\t2\n", &n, &k);
        // Decimal commas.
        check("nm;n;k\n226,1;1,5;2\n", &n, &k);
        check("um\tn\tk\n0,2261\t1,5\t2,0\n", &n, &k);
        check("um n k\n2,261E-01 1,5 2\n", &n, &k);
        check("um,n,k\n\"0,2261\",\"1,5\",\"2\"\n", &n, &k);
        // Excel's, with all that it adds.
        let excel = "\u{feff}sep=;\r\nWavelength (nm);Refractive index n;Extinction coefficient k\r\n226,1;1,5;2\r\n";
        check(excel, &n, &k);
    }

    #[track_caller]
    fn unit_of(text: &str, nm: f64, remarks: &[&str]) {
        let page = Page::parse_csv("gold.csv", text).expect("it is good");
        assert_eq!(page.n, table(&[(nm, 1.5)]), "{text}");
        assert_eq!(page.remarks, remarks, "{text}");
    }

    #[test]
    fn a_unit_that_is_not_named_is_told_by_size() {
        let taken = |range: &str, unit: &str| {
            format!("the header names no unit: wavelengths from {range} are taken as {unit}")
        };
        let um = taken("0.55 to 0.55", "micrometres");
        for name in ["wavelength", "Lambda", "\u{3bb}", "\"Wavelengths\""] {
            unit_of(&format!("{name},n\n0.55,1.5\n"), 550.0, &[&um]);
        }
        unit_of("lambda;n\n0,55;1,5\n", 550.0, &[&um]);
        let nm = taken("550 to 550", "nanometres");
        for name in ["wavelength", "wl"] {
            unit_of(&format!("{name},n\n550,1.5\n"), 550.0, &[&nm]);
        }
        unit_of(
            "wavelength,n\n0.2,1.5\n",
            200.0,
            &[&taken("0.2 to 0.2", "micrometres")],
        );
        unit_of(
            "wavelength,n\n20,1.5\n",
            2e4,
            &[&taken("20 to 20", "micrometres")],
        );
        unit_of(
            "wavelength,n\n150,1.5\n",
            150.0,
            &[&taken("150 to 150", "nanometres")],
        );
        // The site's own exports: micrometres without a remark, also beyond these limits.
        let mixed = Page::parse_csv("m.csv", "wl,n\n0.38,1.5\n0.48,1.5\n500,1.5\n");
        assert!(mixed.is_err_and(|fault| fault.what.contains("jump from 0.48 to 500")));
        unit_of("wl,n\n0.55,1.5\n", 550.0, &[]);
        unit_of("wl,n\n0.1,1.5\n", 100.0, &[]);
        unit_of("wl,n\n30,1.5\n", 3e4, &[]);
    }

    #[test]
    fn what_cannot_be_decided_is_refused() {
        for (rows, range) in [
            ("0.1,1.5", "0.1 to 0.1"),
            ("21,1.5", "21 to 21"),
            ("149,1.5", "149 to 149"),
            ("0.5,1.5\n500,1.5", "0.5 to 500"),
        ] {
            let says = format!(
                "names no unit, and wavelengths from {range} do not tell it: from 0.2 to 20 they are micrometres, from 150 on nanometres"
            );
            refused(&format!("wavelength,n\n{rows}\n"), [1, 1], &says);
        }
        let both = "decimal commas and decimal points; one of them is allowed";
        refused("nm;n\n400;1,5\n500;1.5\n", [3, 5], both);
        refused("nm;n\n1,234.5;1\n", [2, 1], both);
        refused("nm;n\n400;1,234,5\n", [2, 5], "`1,234,5` is no number");
        let says = "a row of 3 numbers; it wants wavelength, n; where numbers have decimal commas, semicolons or tabs must stand between columns";
        refused("nm,n\n400,1,5\n", [2, 1], says);
        refused(
            "photon energy,n\n4,1.5\n",
            [1, 1],
            "no header that is understood; allowed are",
        );
    }

    #[track_caller]
    fn refused(text: &str, at: [usize; 2], says: &str) {
        let fault = Page::parse_csv("gold.csv", text).expect_err("it is refused");
        assert!(fault.what.contains(says), "{fault}");
        assert_eq!([fault.line, fault.column], at, "{fault}");
    }

    #[test]
    fn each_fault_names_its_line() {
        refused("", [1, 1], "no table");
        refused("# nothing\n", [1, 1], "no table");
        refused(
            "400,1.5\n",
            [1, 1],
            "`400,1.5` stands before any header, which names the unit; allowed are",
        );
        refused(
            "wave,n\n400,1.5\n",
            [1, 1],
            "`wave,n` is no header that is understood; allowed are",
        );
        refused("ev,n\n4,1.5\n", [1, 1], "no header that is understood");
        refused("nm,n\n", [1, 1], "has no rows");
        refused("nm,n\nnm,k\n400,1", [1, 1], "has no rows");
        refused("nm,n\n400,1.5\n\n500,x\n", [4, 5], "`x` is no number");
        refused(
            "nm,n,k\n400,1.5\n",
            [2, 1],
            "a row of 2 numbers; it wants wavelength, n, k",
        );
        refused("nm,n\n400,1.80-17\n", [2, 5], "did you mean 1.80e-17?");
        refused("nm,n\n0,1\n", [2, 1], "must be above 0");
        refused("nm,n\n400,nan\n", [2, 5], "not a finite number");
        refused("nm,k\n400,-1\n", [2, 5], "k is -1");
        refused("nm,n\n400,1\0\n", [2, 6], "NUL");
    }

    #[test]
    fn a_table_given_twice_counts_once() {
        let page = Page::parse_csv("gold.csv", "nm,n\n400,1\nnm,n\n400,2\n").expect("it is good");
        assert_eq!(page.n, table(&[(400.0, 1.0)]));
        assert_eq!(page.remarks, ["n is given twice: the first was taken"]);
        let material = page.material(None).expect("it has n");
        assert_eq!([material.name, material.page], ["gold", ""]);
    }
}
