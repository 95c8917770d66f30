//! Reads the rows of third-party tables: checked one by one, then sorted, each wavelength once. Also cuts a material to a
//! range of wavelengths.
//!
//! A table is repaired where possible, and each repair is reported to the user in a remark. Rows out of order are sorted. A
//! wavelength with several rows gets their mean. A k just below 0 is measurement noise and becomes 0, since a passive medium
//! has no gain.

use super::decimal::{self, Unit};
use super::formula::DispersionCurve;
use super::material::Material;

/// The least k that is taken for noise. The worst page of refractiveindex.info that is right elsewhere has -0.148.
const LEAST_K: f64 = -0.2;

/// The columns after the wavelength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Columns {
    /// n alone.
    N,
    /// k alone.
    K,
    /// n, then k.
    Nk,
}

impl Columns {
    /// How many they are.
    pub fn count(self) -> usize {
        self.names().len()
    }

    fn names(self) -> &'static [&'static str] {
        match self {
            Columns::N => &["n"],
            Columns::K => &["k"],
            Columns::Nk => &["n", "k"],
        }
    }
}

/// A wavelength in nanometres, and the columns after it; with one column the second value is 0.
#[derive(Clone, Copy, PartialEq)]
struct WavelengthRow {
    nm: f64,
    values: [f64; 2],
}

/// A table that is being read.
pub struct TableReader {
    columns: Columns,
    unit: Unit,
    rows: Vec<WavelengthRow>,
    gains: usize,
    least_k: f64,
}

/// What is wrong with a row, and in which column.
pub struct RowFault {
    /// The column, from 0.
    pub column: usize,
    /// What was found, and what is allowed.
    pub what: String,
}

impl TableReader {
    /// A table without rows yet.
    pub fn new(columns: Columns, unit: Unit) -> TableReader {
        TableReader {
            columns,
            unit,
            rows: Vec::new(),
            gains: 0,
            least_k: 0.0,
        }
    }

    /// Whether there is no row yet.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Reads a row.
    pub fn push<'a>(&mut self, tokens: impl Iterator<Item = &'a str>) -> Result<(), RowFault> {
        let names = self.columns.names();
        let mut row = WavelengthRow {
            nm: 0.0,
            values: [0.0; 2],
        };
        let mut found = 0;
        for (column, token) in tokens.enumerate() {
            let fault = |what| RowFault { column, what };
            found += 1;
            if column == 0 {
                row.nm = decimal::nm(token, self.unit).map_err(fault)?;
            } else if let Some(name) = names.get(column - 1) {
                row.values[column - 1] = self.value(name, token).map_err(fault)?;
            }
        }
        if found != names.len() + 1 {
            let wanted = format!("wavelength, {}", names.join(", "));
            let what = format!("a row of {found} numbers; it wants {wanted}");
            return Err(RowFault { column: 0, what });
        }
        self.rows.push(row);
        Ok(())
    }

    fn value(&mut self, name: &str, token: &str) -> Result<f64, String> {
        // Some glass catalogues print -0.0000E+00; plus 0 it is 0.
        let value = decimal::finite(token)? + 0.0;
        if name != "k" || value >= 0.0 {
            return Ok(value);
        }
        if value < LEAST_K {
            return Err(format!(
                "k is {value}; it must not be below 0, and only down to {LEAST_K} is it taken for noise"
            ));
        }
        self.gains += 1;
        self.least_k = self.least_k.min(value);
        Ok(0.0)
    }

    /// The curves of n and of k, as far as the table has them. Repairs are added to the remarks. The table must have a row.
    pub fn curves(
        mut self,
        remarks: &mut Vec<String>,
    ) -> (Option<DispersionCurve>, Option<DispersionCurve>) {
        if self.gains > 0 {
            remarks.push(format!(
                "k was below 0 in {}, at worst {}: taken as 0",
                counted(self.gains, "row"),
                decimal::short(self.least_k)
            ));
        }
        if !self.rows.is_sorted_by(|a, b| a.nm <= b.nm) {
            remarks.push("rows were not in order of wavelength: sorted".to_owned());
            self.rows.sort_by(|a, b| a.nm.total_cmp(&b.nm));
        }
        let rows = each_wavelength_once(self.rows, remarks);
        let column = |at: usize| {
            let point = |row: &WavelengthRow| (row.nm, row.values[at]);
            DispersionCurve::table(rows.iter().map(point).collect())
        };
        match self.columns {
            Columns::N => (column(0), None),
            Columns::K => (None, column(0)),
            Columns::Nk => (column(0), column(1)),
        }
    }
}

/// Equal rows become one; different rows of one wavelength become their mean.
fn each_wavelength_once(rows: Vec<WavelengthRow>, remarks: &mut Vec<String>) -> Vec<WavelengthRow> {
    let mut once: Vec<WavelengthRow> = Vec::with_capacity(rows.len());
    let mut differing = Vec::new();
    for same in rows.chunk_by(|a, b| a.nm == b.nm) {
        let mut same = same.to_vec();
        same.sort_by(|a, b| {
            let second = || a.values[1].total_cmp(&b.values[1]);
            a.values[0].total_cmp(&b.values[0]).then_with(second)
        });
        same.dedup();
        if same.len() > 1 {
            differing.push(same[0].nm);
        }
        once.push(mean(&same));
    }
    if let Some(first) = differing.first() {
        remarks.push(format!(
            "{} had several rows that differ, the first at {first} nm: their mean was taken",
            counted(differing.len(), "wavelength")
        ));
    }
    once
}

/// The mean of rows of one wavelength. Each is divided before they are added, so that the sum is finite.
fn mean(same: &[WavelengthRow]) -> WavelengthRow {
    let mean = |at: usize| {
        let share = |row: &WavelengthRow| row.values[at] / same.len() as f64;
        same.iter().map(share).sum()
    };
    WavelengthRow {
        nm: same[0].nm,
        values: [mean(0), mean(1)],
    }
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

impl Material {
    /// The same material with its tables cut to a range of wavelengths: from the last row at or below its start to the
    /// first at or above its end, so that no index inside changes. A formula is not cut.
    #[must_use]
    pub fn trimmed(&self, from_nm: f64, to_nm: f64) -> Material {
        let cut = |curve: &DispersionCurve| match curve {
            DispersionCurve::Table(table) => {
                let kept = within(table.points(), from_nm, to_nm).to_vec();
                DispersionCurve::table(kept).unwrap_or_else(|| curve.clone())
            }
            DispersionCurve::Formula(_) => curve.clone(),
        };
        Material {
            n: cut(&self.n),
            k: self.k.as_ref().map(cut),
            ..self.clone()
        }
    }
}

/// The points within a range and the next ones around it. If the table lies outside, it is the nearest point.
fn within(points: &[(f64, f64)], from_nm: f64, to_nm: f64) -> &[(f64, f64)] {
    let after_start = points.partition_point(|point| point.0 <= from_nm);
    let start = after_start.saturating_sub(1);
    let before_end = points.partition_point(|point| point.0 < to_nm);
    let end = (before_end + 1).clamp(start + 1, points.len().max(start + 1));
    points.get(start..end).unwrap_or(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(columns: Columns, text: &str, n: &[(f64, f64)], k: &[(f64, f64)], remarks: &[&str]) {
        let mut rows = TableReader::new(columns, Unit::Nm);
        for line in text.split(';') {
            let fault = rows.push(line.split_whitespace()).err();
            assert_eq!(fault.map(|fault| fault.what), None);
        }
        let mut said = Vec::new();
        let (got_n, got_k) = rows.curves(&mut said);
        assert_eq!((got_n, got_k), (table(n), table(k)));
        assert_eq!(said, remarks);
    }

    fn table(points: &[(f64, f64)]) -> Option<DispersionCurve> {
        DispersionCurve::table(points.to_vec())
    }

    #[test]
    fn what_is_done_to_rows_is_said() {
        use Columns::{K, N, Nk};
        let one = |value: f64| [(400.0, value)];
        let two = |first: f64, second: f64| [(400.0, first), (500.0, second)];
        check(N, "400 1; 500 2", &two(1.0, 2.0), &[], &[]);
        check(Nk, "400 1 2", &one(1.0), &one(2.0), &[]);
        let sorted = "rows were not in order of wavelength: sorted";
        check(N, "500 2; 400 1", &two(1.0, 2.0), &[], &[sorted]);
        check(N, "400 1; 400 1", &one(1.0), &[], &[]);
        let mean =
            "1 wavelength had several rows that differ, the first at 400 nm: their mean was taken";
        check(N, "400 1; 400 2; 400 2", &one(1.5), &[], &[mean]);
        check(Nk, "400 1 0; 400 1 1", &one(1.0), &one(0.5), &[mean]);
        check(N, "400 1e308; 400 1.5e308", &one(1.25e308), &[], &[mean]);
        let noise = "k was below 0 in 2 rows, at worst -0.2: taken as 0";
        check(K, "400 -0.1; 500 -0.2", &[], &two(0.0, 0.0), &[noise]);
        check(N, "400 -0.1", &one(-0.1), &[], &[]);
    }

    #[track_caller]
    fn refused(columns: Columns, row: &str, column: usize, says: &str) {
        let fault = TableReader::new(columns, Unit::Nm).push(row.split_whitespace());
        let fault = fault.expect_err("it is refused");
        assert_eq!((fault.column, fault.what.as_str()), (column, says));
    }

    #[test]
    fn a_row_that_is_none_is_refused() {
        use Columns::{K, N, Nk};
        for (columns, row, says) in [
            (N, "400", "a row of 1 numbers; it wants wavelength, n"),
            (N, "400 1 2", "a row of 3 numbers; it wants wavelength, n"),
            (Nk, "400 1", "a row of 2 numbers; it wants wavelength, n, k"),
            (K, "", "a row of 0 numbers; it wants wavelength, k"),
        ] {
            refused(columns, row, 0, says);
        }
        refused(Nk, "400 nan 0", 1, "`nan` is not a finite number");
        refused(K, "400 x", 1, "`x` is no number");
        refused(
            Nk,
            "400 1 -0.21",
            2,
            "k is -0.21; it must not be below 0, and only down to -0.2 is it taken for noise",
        );
    }

    #[track_caller]
    fn check_within(from_nm: f64, to_nm: f64, kept: &[f64]) {
        let point = |nm| (nm, 1.0);
        let points = [300.0, 400.0, 500.0, 600.0].map(point);
        let got = within(&points, from_nm, to_nm).iter().map(|p| p.0);
        assert_eq!(got.collect::<Vec<_>>(), kept);
    }

    #[test]
    fn the_rows_around_the_range_stay() {
        check_within(400.0, 500.0, &[400.0, 500.0]);
        check_within(401.0, 499.0, &[400.0, 500.0]);
        check_within(399.0, 501.0, &[300.0, 400.0, 500.0, 600.0]);
        check_within(100.0, 900.0, &[300.0, 400.0, 500.0, 600.0]);
        check_within(100.0, 200.0, &[300.0]);
        check_within(700.0, 900.0, &[600.0]);
        check_within(500.0, 400.0, &[500.0]);
        check_within(f64::NAN, f64::NAN, &[300.0]);
        assert_eq!(within(&[], 1.0, 2.0), &[]);
    }
}
