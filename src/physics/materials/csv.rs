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
//! `wl` is in micrometres, as the site exports it. Otherwise the first column is `wavelength_nm`, `wavelength_um`, `nm`
//! or `um`, followed by `n`, `k`, or `n,k`. A header begins a table. Semicolons, tabs or blanks may replace commas, and
//! `Wavelength (nm)` is read as `wavelength_nm`. The `.txt` and `.tsv` tables of Filmetrics and others have this form.

use super::decimal::{Unit, clipped};
use super::page::{Page, check_text};
use super::rows::{Columns, TableReader};
use crate::physics::spectra::is_separator;
use crate::physics::user_text::FileFault;

const ALLOWED: &str =
    "allowed are wavelength_nm, wavelength_um, nm, um or wl (um), and then n, k or n,k";

impl Page {
    /// Reads tables of n and k from comma-separated values. `file` is for messages, and for the page's own name.
    ///
    /// # Errors
    /// The text has no table, a row is not numbers, or a wavelength or an index lies outside its limits.
    pub fn parse_csv(file: &str, text: &str) -> Result<Page, FileFault> {
        check_text(file, text)?;
        let mut page = Page {
            file: file.to_owned(),
            ..Page::default()
        };
        let mut table: Option<Table> = None;
        for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
            // `sep=;` is for Excel.
            if line.trim().is_empty() || line.starts_with('#') || is_separator(line) {
                continue;
            }
            match (header(line, number), &mut table) {
                (Some(next), _) => {
                    if let Some(last) = table.replace(next) {
                        page.add_table(last)?;
                    }
                }
                (None, Some(table)) => {
                    let row = table.rows.push(cells(line, table.separator));
                    row.map_err(|fault| {
                        let cells = line.split(table.separator).take(fault.column);
                        let before: usize = cells.map(|cell| cell.chars().count() + 1).sum();
                        FileFault::new(file, number, before + 1, fault.what)
                    })?;
                }
                (None, None) => return Err(FileFault::new(file, number, 1, no_header(line))),
            }
        }
        let Some(last) = table else {
            let what = format!("no table; a header begins one: {ALLOWED}");
            return Err(FileFault::new(file, 1, 1, what));
        };
        page.add_table(last)?;
        Ok(page)
    }

    fn add_table(&mut self, table: Table) -> Result<(), FileFault> {
        if table.rows.is_empty() {
            let what = "the table of this header has no rows".to_owned();
            return Err(FileFault::new(&self.file, table.line, 1, what));
        }
        let mut remarks = Vec::new();
        let (n, k) = table.rows.curves(&mut remarks);
        self.add(n, k, remarks);
        Ok(())
    }
}

/// A table that is being read, and the place of its header.
struct Table {
    rows: TableReader,
    separator: char,
    line: usize,
}

/// The separator that stands for any blanks.
const BLANK: char = ' ';

/// The table that this line begins, if it is a header.
fn header(line: &str, number: usize) -> Option<Table> {
    let separators = [';', '\t', ',', BLANK];
    separators.into_iter().find_map(|separator| {
        Some(Table {
            rows: rows_with(line, separator)?,
            separator,
            line: number,
        })
    })
}

fn rows_with(line: &str, separator: char) -> Option<TableReader> {
    // With blanks as separators, a unit in brackets would be a cell of its own.
    let line = match separator {
        BLANK => line.replace(" (", "(").replace(" [", "["),
        _ => line.to_owned(),
    };
    let names: Vec<String> = cells(&line, separator).map(plain).collect();
    let (first, rest) = names.split_first()?;
    let columns: Vec<&str> = rest.iter().map(|name| quantity(name)).collect();
    let columns = match columns[..] {
        ["n"] => Columns::N,
        ["k"] => Columns::K,
        ["n", "k"] => Columns::Nk,
        _ => return None,
    };
    Some(TableReader::new(columns, unit(first)?))
}

/// The unit in the name of a wavelength column.
fn unit(name: &str) -> Option<Unit> {
    let bare = ["wavelength_", "lambda_", "wl_", "\u{3bb}_"]
        .into_iter()
        .find_map(|start| name.strip_prefix(start));
    match bare.unwrap_or(name).trim_start_matches("in_") {
        "nm" | "nanometers" | "nanometres" => Some(Unit::Nm),
        "um" | "micron" | "microns" | "micrometers" | "micrometres" => Some(Unit::Um),
        // As the site exports it.
        "wl" if bare.is_none() => Some(Unit::Um),
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
    let is_between = move |c: char| match separator {
        BLANK => c.is_whitespace(),
        _ => c == separator,
    };
    let is_cell = move |cell: &&str| separator != BLANK || !cell.is_empty();
    line.split(is_between).filter(is_cell).map(bare)
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
            "wavelength,n\n400,1.5\n",
            [1, 1],
            "`wavelength,n` is no header that is understood; allowed are",
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
        refused("nm;n\n400;1,5\n", [2, 5], "did you mean 1.5?");
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
