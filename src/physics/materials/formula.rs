//! n and k as functions of wavelength ([`DispersionCurve`]): a table, linear between its points, or a formula ([`Formula`]).
//!
//! The formulas are the dispersion formulas 1 to 9 of refractiveindex.info. L is the vacuum wavelength in micrometres. A missing
//! coefficient is 0, but the exponent or pole that belongs to a factor must be given ([`Formula::missing_partner`]).
//!
//! ```text
//! 1  n² - 1 = C1 + Σ C(2i) L² / (L² - C(2i+1)²)                      Sellmeier
//! 2  n² - 1 = C1 + Σ C(2i) L² / (L² - C(2i+1))                       Sellmeier, poles given as squares
//! 3  n²     = C1 + Σ C(2i) L^C(2i+1)                                 polynomial
//! 4  n²     = C1 + C2 L^C3 / (L² - C4^C5) + C6 L^C7 / (L² - C8^C9) + Σ C(2i) L^C(2i+1), i from 5
//! 5  n      = C1 + Σ C(2i) L^C(2i+1)                                 Cauchy
//! 6  n - 1  = C1 + Σ C(2i) / (C(2i+1) - L^-2)                        gases
//! 7  n      = C1 + C2/(L² - 0.028) + C3/(L² - 0.028)² + C4 L² + C5 L⁴ + C6 L⁶      Herzberger
//! 8  (n² - 1)/(n² + 2) = C1 + C2 L²/(L² - C3) + C4 L²                retro
//! 9  n²     = C1 + C2/(L² - C3) + C4 (L - C5)/((L - C5)² + C6)       exotic
//! ```
//!
//! Source: M. N. Polyanskiy, *Refractiveindex.info database of optical constants*, Scientific Data 11, 94 (2024),
//! <https://doi.org/10.1038/s41597-023-02898-2>, and the document "Dispersion formulas" of that database.

use serde::Deserialize;

use super::decimal::short;
use crate::physics::num::{Interval, Num};
use crate::physics::spectra::Spectrum;

/// A dispersion formula with its coefficients and the range that it was fitted to.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "struct RawFormula")]
pub struct Formula {
    /// 1 to 9.
    pub number: u8,
    /// The shortest wavelength, in nanometres.
    pub from_nm: f64,
    /// The longest wavelength, in nanometres.
    pub to_nm: f64,
    /// C1, C2, …
    pub coefficients: Vec<f64>,
}

/// The formula numbers that exist.
pub const NUMBERS: std::ops::RangeInclusive<u8> = 1..=9;

/// The one pole of formula 7, in square micrometres.
const HERZBERGER_POLE: f64 = 0.028;

/// The narrowest piece of a range that is examined, as a fraction of the wavelength. If interval arithmetic cannot bound the index
/// even there, the formula has a pole.
const NARROWEST: f64 = 1e-9;
/// The most pieces of a range that are examined. A formula whose terms nearly cancel takes many. After this number, each piece
/// that is left is sampled.
const MOST_PIECES: usize = 20_000;

/// A wavelength at which a formula gives no index within limits, and its value there.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlier {
    /// In nanometres.
    pub nm: f64,
    /// `n = 7.1e154`, `n^2 = -3`.
    pub gives: String,
}

/// A wavelength or an interval of wavelengths: a number that can be raised to a power.
trait Length: Num {
    fn power(self, exponent: f64) -> Self;
}

impl Length for f64 {
    fn power(self, exponent: f64) -> f64 {
        libm::pow(self, exponent)
    }
}

impl Length for Interval {
    /// Wavelengths are above 0.
    fn power(self, exponent: f64) -> Interval {
        (self.log2() * Interval::from_f64(exponent)).exp2()
    }
}

impl Formula {
    /// n at a wavelength, or what the formula gives instead of a refractive index.
    ///
    /// # Errors
    /// There is no formula of this number, or its value is no refractive index.
    pub fn n(&self, nm: f64) -> Result<f64, String> {
        if !NUMBERS.contains(&self.number) {
            return Err(format!(
                "there is no formula {}; there are 1 to 9",
                self.number
            ));
        }
        let value = self.value(nm / 1000.0);
        if value > 0.0 && value.is_finite() {
            Ok(if self.gives_square() {
                value.sqrt()
            } else {
                value
            })
        } else {
            Err(self.said(value))
        }
    }

    /// The first wavelength from one to another at which n lies outside of limits, if any. The formula is evaluated in intervals
    /// of wavelengths, so that no pole is missed between two samples.
    pub fn outlier(&self, from_nm: f64, to_nm: f64, least: f64, most: f64) -> Option<Outlier> {
        let limits = if self.gives_square() {
            Interval::new(least * least, most * most)
        } else {
            Interval::new(least, most)
        };
        let mut left = MOST_PIECES;
        let mut pieces = vec![(from_nm, to_nm)];
        while let Some((from, to)) = pieces.pop() {
            left = left.saturating_sub(1);
            let reach = self.value(Interval::new(from / 1000.0, to / 1000.0));
            if limits.contains(reach.lo()) && limits.contains(reach.hi()) {
                continue;
            }
            let middle = from + 0.5 * (to - from);
            let is_narrow = to - from <= NARROWEST * from;
            if !is_narrow && left > 0 {
                pieces.extend([(middle, to), (from, middle)]);
                continue;
            }
            let value = |nm: f64| (nm, self.value(nm / 1000.0));
            let mut samples = [from, middle, to].map(value).into_iter();
            let outside = samples.find(|(_, value)| !limits.contains(*value));
            if let Some((nm, value)) = outside.or(is_narrow.then_some((middle, f64::INFINITY))) {
                let gives = self.said(value);
                return Some(Outlier { nm, gives });
            }
        }
        None
    }

    /// What is missing if the last term has a factor but not its exponent or pole. Taking these as 0 would make it another formula.
    pub fn missing_partner(&self) -> Option<String> {
        let (number, count) = (self.number, self.coefficients.len());
        let first = *self.terms().iter().rfind(|(first, _)| *first <= count)?;
        let (first, last) = match (number, first) {
            // After the terms with fixed places, all are pairs.
            (1..=6, (pairs, 2)) => {
                let first = pairs + (count - pairs) / 2 * 2;
                (first, first + 1)
            }
            (_, (first, size)) => (first, first + size - 1),
        };
        (count < last && self.c(first) != 0.0).then(|| {
            format!(
                "formula {number} has {count} coefficients, and C{first} wants all up to C{last}, in the order of the formula; 0 is written too"
            )
        })
    }

    /// The terms of more than one coefficient: the index of the first, which is a factor, and their number.
    fn terms(&self) -> &'static [(usize, usize)] {
        match self.number {
            4 => &[(2, 4), (6, 4), (10, 2)],
            7 => &[],
            8 => &[(2, 2)],
            9 => &[(2, 2), (4, 3)],
            _ => &[(2, 2)],
        }
    }

    /// Whether the formula gives n² and not n.
    fn gives_square(&self) -> bool {
        !matches!(self.number, 5..=7)
    }

    fn said(&self, value: f64) -> String {
        let square = if self.gives_square() { "^2" } else { "" };
        let number = self.number;
        format!("formula {number} gives n{square} = {}", short(value))
    }

    /// n or n² at a wavelength in micrometres.
    fn value<L: Length>(&self, l: L) -> L {
        let one = L::from_f64(1.0);
        match self.number {
            1 => one + self.sellmeier(l, |pole| pole * pole),
            2 => one + self.sellmeier(l, |pole| pole),
            3 => self.polynomial(l, 1),
            4 => self.polynomial(l, 5) + self.poles(l),
            5 => self.polynomial(l, 1),
            6 => one + self.gas(l),
            7 => self.herzberger(l),
            8 => self.retro(l),
            9 => self.exotic(l),
            _ => L::unknown(),
        }
    }

    /// C(i), counted from 1.
    fn c(&self, i: usize) -> f64 {
        self.coefficients.get(i - 1).copied().unwrap_or(0.0)
    }

    /// C(i) as a number of this type.
    fn constant<L: Length>(&self, i: usize) -> L {
        L::from_f64(self.c(i))
    }

    /// The pairs (C(2i), C(2i+1)) from a first one on, without those that add nothing.
    fn pairs(&self, first: usize) -> impl Iterator<Item = (f64, f64)> {
        let places = first..=self.coefficients.len() / 2;
        let pairs = places.map(|i| (self.c(2 * i), self.c(2 * i + 1)));
        pairs.filter(|(factor, _)| *factor != 0.0)
    }

    /// C1 and these terms.
    fn sum<L: Length>(&self, terms: impl Iterator<Item = L>) -> L {
        let zero = L::from_f64(0.0);
        self.constant::<L>(1) + terms.fold(zero, |sum, term| sum + term)
    }

    fn sellmeier<L: Length>(&self, l: L, squared: impl Fn(f64) -> f64) -> L {
        let term = |(strength, pole): (f64, f64)| {
            L::from_f64(strength) * l * l / (l.squared() - L::from_f64(squared(pole)))
        };
        self.sum(self.pairs(1).map(term))
    }

    fn polynomial<L: Length>(&self, l: L, first: usize) -> L {
        let term = |(factor, power): (f64, f64)| L::from_f64(factor) * l.power(power);
        self.sum(self.pairs(first).map(term))
    }

    /// The two pole terms of formula 4. One with a factor of 0 is left out: 0 to the power 0 is 1.
    fn poles<L: Length>(&self, l: L) -> L {
        let pole = |first: usize| match self.c(first) {
            0.0 => L::from_f64(0.0),
            strength => {
                L::from_f64(strength) * l.power(self.c(first + 1))
                    / (l.squared() - L::from_f64(self.c(first + 2).power(self.c(first + 3))))
            }
        };
        pole(2) + pole(6)
    }

    fn gas<L: Length>(&self, l: L) -> L {
        let one = L::from_f64(1.0);
        let term = |(strength, pole): (f64, f64)| {
            L::from_f64(strength) / (L::from_f64(pole) - one / l.squared())
        };
        self.sum(self.pairs(1).map(term))
    }

    fn herzberger<L: Length>(&self, l: L) -> L {
        let square = l.squared();
        let near = L::from_f64(1.0) / (square - L::from_f64(HERZBERGER_POLE));
        self.constant::<L>(1)
            + near * (self.constant::<L>(2) + near * self.constant(3))
            + square
                * (self.constant::<L>(4)
                    + square * (self.constant::<L>(5) + square * self.constant(6)))
    }

    fn retro<L: Length>(&self, l: L) -> L {
        let (square, one) = (l.squared(), L::from_f64(1.0));
        let share = self.constant::<L>(1)
            + self.constant::<L>(2) * square / (square - self.constant(3))
            + self.constant::<L>(4) * square;
        (one + L::from_f64(2.0) * share) / (one - share)
    }

    fn exotic<L: Length>(&self, l: L) -> L {
        let from = l - self.constant(5);
        self.constant::<L>(1)
            + self.constant::<L>(2) / (l.squared() - self.constant(3))
            + self.constant::<L>(4) * from / (from.squared() + self.constant(6))
    }
}

/// n(λ) or k(λ).
#[derive(Clone, Debug, PartialEq)]
pub enum DispersionCurve {
    /// Measured points by wavelength in nm; linear between them.
    Table(Spectrum<f64>),
    /// A fitted formula.
    Formula(Formula),
}

/// What is done outside the measured range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extrapolate {
    /// Nothing: it is refused.
    #[default]
    Refuse,
    /// The value at the nearer end is held. Every output then says so.
    Hold,
}

impl Extrapolate {
    /// Both; the first is the default.
    pub const ALL: [Extrapolate; 2] = [Extrapolate::Refuse, Extrapolate::Hold];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Extrapolate::Refuse => "refuse",
            Extrapolate::Hold => "hold",
        }
    }
}

/// The tolerance at the ends of a range, as a fraction of the wavelength, so that they count as inside in spite of rounding.
const END: f64 = 1e-9;

impl DispersionCurve {
    /// A table of pairs of wavelength in nm and value; none where they do not ascend.
    pub fn table(points: Vec<(f64, f64)>) -> Option<DispersionCurve> {
        Spectrum::new(points).map(DispersionCurve::Table)
    }

    /// The shortest and the longest wavelength, in nanometres.
    pub fn range_nm(&self) -> (f64, f64) {
        match self {
            DispersionCurve::Table(table) => table.range(),
            DispersionCurve::Formula(formula) => (formula.from_nm, formula.to_nm),
        }
    }

    /// Whether a wavelength was measured, or lies between measured ones.
    pub fn covers(&self, nm: f64) -> bool {
        let (from, to) = self.range_nm();
        (from * (1.0 - END)..=to * (1.0 + END)).contains(&nm)
    }

    /// The wavelengths of its measured points; none for a formula.
    pub fn measured_nm(&self) -> Vec<f64> {
        match self {
            DispersionCurve::Table(table) => table.points().iter().map(|(nm, _)| *nm).collect(),
            DispersionCurve::Formula(_) => Vec::new(),
        }
    }

    /// The value at a wavelength, or why there is none.
    ///
    /// # Errors
    /// The wavelength lies outside the measured range and may not be extrapolated, or the formula has no value there.
    pub fn at(&self, nm: f64, beyond: Extrapolate) -> Result<f64, String> {
        let (from, to) = self.range_nm();
        if !self.covers(nm) && beyond == Extrapolate::Refuse {
            return Err(format!(
                "is known from {from} to {to} nm, and {nm} nm is wanted"
            ));
        }
        // Not `clamp`, which panics where the range is empty: a file's range is checked, a value made in Rust is not.
        let inside = nm.max(from).min(to);
        match self {
            DispersionCurve::Table(table) => table
                .at(inside)
                .ok_or_else(|| format!("has no value at {nm} nm")),
            DispersionCurve::Formula(formula) => formula
                .n(inside)
                .map_err(|why| format!("has no value at {nm} nm: {why}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formula(number: u8, coefficients: &[f64]) -> Formula {
        Formula {
            number,
            coefficients: coefficients.to_vec(),
            from_nm: 100.0,
            to_nm: 10_000.0,
        }
    }

    #[track_caller]
    fn check(number: u8, coefficients: &[f64], nm: f64, n: f64, within: f64) {
        let got = formula(number, coefficients).n(nm).expect("an index");
        assert!((got - n).abs() <= within, "{got} {n}");
    }

    /// The same at 500 nm, for what follows by hand: the formula's value is n², to rounding.
    #[track_caller]
    fn check_square(number: u8, coefficients: &[f64], square: f64) {
        check(number, coefficients, 500.0, square.sqrt(), 1e-15);
    }

    /// Each with an index that the manufacturer prints, or that follows by hand.
    #[test]
    fn each_formula_gives_a_known_index() {
        let malitson = [
            0.0, 0.6961663, 0.0684043, 0.4079426, 0.1162414, 0.8974794, 9.896161,
        ];
        check(1, &malitson, 587.6, 1.45846, 5e-6);
        let bk7 = [
            0.0,
            1.03961212,
            0.00600069867,
            0.231792344,
            0.0200179144,
            1.01046945,
            103.560653,
        ];
        check(2, &bk7, 587.5618, 1.5168, 5e-6);
        check_square(3, &[2.25, 0.04, -2.0, 0.0001, 4.0], 2.41000625);
        // 2 + 3·0.25/(0.25 - 0.01) + 0 + 0.5·0.25
        let four = [2.0, 3.0, 2.0, 0.1, 2.0, 0.0, 0.0, 0.0, 0.0, 0.5, 2.0];
        check_square(4, &four, 2.0 + 3.125 + 0.125);
        check(5, &[1.5, 0.01, -2.0], 500.0, 1.54, 1e-15);
        check(6, &[0.0, 0.02, 100.0], 500.0, 1.0 + 0.02 / 96.0, 1e-15);
        let seven = [1.5, 0.0222, 0.0, 0.0, 0.0, 16.0];
        check(7, &seven, 500.0, 1.5 + 0.1 + 0.25, 1e-14);
        // A value of 1/4 is n² = 1.5/0.75.
        check_square(8, &[0.25], 2.0);
        check_square(9, &[1.0, 0.24, 0.01, 0.5, 0.5, 1.0], 2.0);
    }

    #[test]
    fn a_coefficient_without_its_partner_has_the_partner_0() {
        check_square(2, &[0.0, 1.0, 0.01, 0.5], 1.0 + 0.25 / 0.24 + 0.5);
    }

    #[track_caller]
    fn misses(number: u8, count: usize, says: Option<&str>) {
        let found = formula(number, &vec![1.0; count]).missing_partner();
        let is_said = match (&found, says) {
            (Some(found), Some(says)) => found.contains(says),
            (found, says) => found.is_none() && says.is_none(),
        };
        assert!(is_said, "formula {number} of {count}: {found:?}");
    }

    /// All numbers of coefficients that occur in the database, and those next to them.
    #[test]
    fn a_factor_has_what_goes_with_it() {
        for number in [1, 2, 3, 5, 6] {
            for count in (1..=17).step_by(2) {
                misses(number, count, None);
            }
            misses(number, 2, Some("C2 wants all up to C3"));
            misses(number, 16, Some("C16 wants all up to C17"));
        }
        for count in [1, 5, 9, 11, 13, 15] {
            misses(4, count, None);
        }
        for count in [2, 3, 4] {
            misses(4, count, Some("C2 wants all up to C5"));
        }
        for count in [6, 7, 8] {
            misses(4, count, Some("C6 wants all up to C9"));
        }
        misses(4, 10, Some("C10 wants all up to C11"));
        misses(4, 14, Some("C14 wants all up to C15"));
        for count in 1..=6 {
            misses(7, count, None);
        }
        for (number, count) in [(8, 1), (8, 3), (8, 4), (9, 1), (9, 3), (9, 6)] {
            misses(number, count, None);
        }
        misses(8, 2, Some("C2 wants all up to C3"));
        misses(9, 2, Some("C2 wants all up to C3"));
        misses(9, 4, Some("C4 wants all up to C6"));
        misses(9, 5, Some("C4 wants all up to C6"));
        // A factor of 0 adds nothing, whatever its exponent or pole.
        let zeros = [2.0, 1.0, 2.0, 0.1, 2.0, 0.0, 0.0];
        assert_eq!(formula(4, &zeros).missing_partner(), None);
    }

    #[test]
    fn what_is_no_index_is_refused() {
        assert!(formula(3, &[-1.0]).n(500.0).is_err());
        assert!(formula(5, &[-1.0]).n(500.0).is_err());
        assert!(formula(2, &[0.0, 1.0, 0.25]).n(500.0).is_err());
        assert!(formula(10, &[1.0]).n(500.0).is_err());
        assert!(formula(5, &[]).n(500.0).is_err());
    }

    fn table() -> DispersionCurve {
        DispersionCurve::table(vec![(400.0, 1.0), (500.0, 3.0)]).expect("it ascends")
    }

    #[test]
    fn linear_between_points_and_exact_at_them() {
        for (nm, value) in [(400.0, 1.0), (450.0, 2.0), (500.0, 3.0)] {
            assert_eq!(table().at(nm, Extrapolate::Refuse), Ok(value));
        }
    }

    #[test]
    fn beyond_the_range_only_when_asked() {
        let refused = table().at(399.0, Extrapolate::Refuse).expect_err("outside");
        assert_eq!(refused, "is known from 400 to 500 nm, and 399 nm is wanted");
        assert_eq!(table().at(399.0, Extrapolate::Hold), Ok(1.0));
        assert_eq!(table().at(501.0, Extrapolate::Hold), Ok(3.0));
        assert_eq!(table().at(500.000_000_1, Extrapolate::Refuse), Ok(3.0));
        assert!(table().at(f64::NAN, Extrapolate::Refuse).is_err());
    }

    #[test]
    fn one_point_is_a_range_of_its_own() {
        let one = DispersionCurve::table(vec![(589.0, 1.5)]).expect("it ascends");
        assert_eq!(one.at(589.0, Extrapolate::Refuse), Ok(1.5));
        assert!(one.at(590.0, Extrapolate::Refuse).is_err());
    }
}
