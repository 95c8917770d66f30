//! An item of a page's DATA: a table or a formula.

use serde_saphyr::{Location, Spanned};

use super::material::GUESS_NM;
use super::yaml::{self, RawItem};
use crate::physics::materials::decimal::{self, Unit, clipped};
use crate::physics::materials::file::MOST_COEFFICIENTS;
use crate::physics::materials::formula::{DispersionCurve, Formula, NUMBERS};
use crate::physics::materials::material::{GREATEST, LEAST_N};
use crate::physics::materials::rows::{Columns, RowFault, TableReader};
use crate::physics::user_text::FileFault;

/// The curves that an item gives, and remarks.
#[derive(Default)]
pub struct Item {
    pub n: Option<DispersionCurve>,
    pub k: Option<DispersionCurve>,
    pub remarks: Vec<String>,
}

const ALLOWED: &str = "tabulated nk, tabulated n, tabulated k, formula 1 to formula 9";

/// The items of DATA.
pub fn read(
    file: &str,
    text: &str,
    data: Option<Vec<Spanned<RawItem>>>,
) -> Result<Vec<Item>, FileFault> {
    let whole = |what: &str| FileFault::new(file, 1, 1, what.to_owned());
    match data {
        None => Err(whole("DATA is missing: no page of refractiveindex.info")),
        Some(items) if items.is_empty() => Err(whole("DATA is empty")),
        Some(items) => {
            let source = Source { file, text };
            items.iter().map(|item| source.item(item)).collect()
        }
    }
}

/// The text that an item stands in.
struct Source<'a> {
    file: &'a str,
    text: &'a str,
}

type Field<'a> = Option<&'a Spanned<String>>;

impl Source<'_> {
    fn item(&self, item: &Spanned<RawItem>) -> Result<Item, FileFault> {
        let raw = &item.value;
        let Some(kind) = &raw.kind else {
            let what = format!("an item of DATA without `type`; allowed: {ALLOWED}");
            return Err(self.fault(item.defined, what));
        };
        let words: Vec<&str> = kind.value.split_whitespace().collect();
        let columns = match words[..] {
            ["tabulated", "nk"] => Columns::Nk,
            ["tabulated", "n"] => Columns::N,
            ["tabulated", "k"] => Columns::K,
            ["formula", number] => return self.formula(kind, number, raw),
            ["tabulated", "n2"] => {
                let what = "the page gives the nonlinear index n2, not n and k";
                return Err(self.fault(kind.defined, what.to_owned()));
            }
            _ => return Err(self.unknown(kind)),
        };
        self.table(columns, kind, raw)
    }

    fn unknown(&self, kind: &Spanned<String>) -> FileFault {
        let found = clipped(&kind.value);
        self.fault(
            kind.defined,
            format!("unknown type `{found}`; allowed: {ALLOWED}"),
        )
    }

    fn table(
        &self,
        columns: Columns,
        kind: &Spanned<String>,
        raw: &RawItem,
    ) -> Result<Item, FileFault> {
        let mut rows = TableReader::new(columns, Unit::Um);
        if let Some(data) = &raw.data {
            let lines = data.value.lines().enumerate();
            for (at, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
                let fault = |fault| self.in_row(data, at, line, fault);
                rows.push(line.split_whitespace()).map_err(fault)?;
            }
        }
        if rows.is_empty() {
            let what = format!("the table `{}` has no rows", kind.value);
            return Err(self.fault(kind.defined, what));
        }
        let mut remarks = Vec::new();
        let (n, k) = rows.curves(&mut remarks);
        for (name, field) in [
            ("wavelength_range", &raw.wavelength_range),
            ("coefficients", &raw.coefficients),
        ] {
            if field.is_some() {
                remarks.push(format!("a table has no `{name}`: not used"));
            }
        }
        Ok(Item { n, k, remarks })
    }

    fn formula(
        &self,
        kind: &Spanned<String>,
        number: &str,
        raw: &RawItem,
    ) -> Result<Item, FileFault> {
        let number = number.parse().ok();
        let Some(number) = number.filter(|number| NUMBERS.contains(number)) else {
            return Err(self.unknown(kind));
        };
        let (from_nm, to_nm) = self.range(kind, raw.wavelength_range.as_ref())?;
        let field = raw.coefficients.as_ref();
        let coefficients = self.coefficients(kind, field)?;
        let remarks = unused(number, coefficients.len());
        let formula = Formula {
            number,
            coefficients,
            from_nm,
            to_nm,
        };
        if let Some(what) = formula.missing_partner() {
            let at = field.map_or(kind.defined, |field| field.defined);
            return Err(self.fault(at, what));
        }
        let (formula, cut) = cut(formula).map_err(|what| self.fault(kind.defined, what))?;
        Ok(Item {
            n: Some(DispersionCurve::Formula(formula)),
            k: None,
            remarks: remarks.into_iter().chain(cut).collect(),
        })
    }

    fn range(&self, kind: &Spanned<String>, field: Field) -> Result<(f64, f64), FileFault> {
        let wanted = "the shortest and the longest wavelength in micrometres";
        let missing = format!("`{}` without `wavelength_range`: {wanted}", kind.value);
        let field = field.ok_or_else(|| self.fault(kind.defined, missing))?;
        let tokens: Vec<&str> = field.value.split_whitespace().collect();
        let [from, to] = tokens[..] else {
            let what = format!(
                "`wavelength_range` has {} numbers; it wants {wanted}",
                tokens.len()
            );
            return Err(self.fault(field.defined, what));
        };
        let read = |token| {
            let said = |why| format!("`wavelength_range`: {why}");
            decimal::nm(token, Unit::Um).map_err(|why| self.fault(field.defined, said(why)))
        };
        let (from, to) = (read(from)?, read(to)?);
        if from < to {
            return Ok((from, to));
        }
        let what = format!("`wavelength_range` does not ascend; it wants {wanted}");
        Err(self.fault(field.defined, what))
    }

    fn coefficients(&self, kind: &Spanned<String>, field: Field) -> Result<Vec<f64>, FileFault> {
        let missing = format!("`{}` without `coefficients`", kind.value);
        let field = field.ok_or_else(|| self.fault(kind.defined, missing))?;
        let said = |why| self.fault(field.defined, format!("`coefficients`: {why}"));
        let count = field.value.split_whitespace().count();
        if !(1..=MOST_COEFFICIENTS).contains(&count) {
            let why = format!("{count} of them; a formula has 1 to {MOST_COEFFICIENTS}");
            return Err(said(why));
        }
        let tokens = field.value.split_whitespace();
        tokens
            .map(|token| decimal::finite(token).map_err(said))
            .collect()
    }

    /// The place of a fault in a row of a block of text, if the block's lines are the file's. Otherwise it is the block's place.
    fn in_row(&self, data: &Spanned<String>, at: usize, row: &str, fault: RowFault) -> FileFault {
        // The block is placed at its first line that is not empty.
        let empty = data.value.lines().take_while(|line| line.trim().is_empty());
        let number = (data.defined.line() as usize + at).saturating_sub(empty.count());
        let line = self
            .text
            .lines()
            .nth(number.saturating_sub(1))
            .unwrap_or("");
        if line.trim() != row.trim() {
            return self.fault(data.defined, fault.what);
        }
        let token = line.split_whitespace().nth(fault.column).unwrap_or(line);
        let before = token.as_ptr() as usize - line.as_ptr() as usize;
        let column = line[..before].chars().count() + 1;
        FileFault::new(self.file, number, column, fault.what)
    }

    fn fault(&self, at: Location, what: String) -> FileFault {
        yaml::fault(self.file, at, what)
    }
}

/// A formula with its range cut to where it gives an index, and a remark on that. It keeps the part that holds visible light, or
/// that is nearest to it. Some formulas of the database are stated for too wide a range, such as GaSe's up to 1.62 mm.
fn cut(formula: Formula) -> Result<(Formula, Option<String>), String> {
    let (from, to) = (formula.from_nm, formula.to_nm);
    let outlier = |from: f64, to: f64| formula.outlier(from, to, LEAST_N, GREATEST);
    let Some(first) = outlier(from, to) else {
        return Ok((formula, None));
    };
    let said = format!("{} at {} nm", first.gives, decimal::short(first.nm));
    let middle = GUESS_NM.max(from).min(to);
    let to_nm = outlier(middle, to).map_or(to, |found| found.nm.ceil() - 1.0);
    let from_nm = match outlier(from, middle) {
        None => from,
        Some(_) => shortest(from, middle, |nm| outlier(nm, middle).is_none()),
    };
    if from_nm >= to_nm {
        return Err(format!(
            "{said}; n must lie between {LEAST_N} and {GREATEST}"
        ));
    }
    let remark = format!("{said}: the range of the formula was cut to {from_nm} to {to_nm} nm");
    let formula = Formula {
        from_nm,
        to_nm,
        ..formula
    };
    Ok((formula, Some(remark)))
}

/// The shortest integer wavelength above `bad` that is good, where all from some wavelength up to `good` are.
fn shortest(mut bad: f64, mut good: f64, is_good: impl Fn(f64) -> bool) -> f64 {
    while good - bad > 0.5 {
        let middle = 0.5 * (bad + good);
        if is_good(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good.ceil()
}

/// The remark on coefficients that the formula does not have, if some are given.
fn unused(number: u8, count: usize) -> Option<String> {
    let most = match number {
        8 => 4,
        7 | 9 => 6,
        _ => return None,
    };
    (count > most).then(|| {
        format!(
            "formula {number} has {most} coefficients, and {count} are given: the rest was not used"
        )
    })
}
