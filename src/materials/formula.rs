//! The dispersion formulas 1 to 9 of refractiveindex.info. L is the vacuum wavelength in micrometres, a coefficient
//! that is not given is 0.
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

use libm::pow;

/// A formula with its coefficients and the range it was fitted to.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// 1 to 9.
    pub number: u8,
    /// C1, C2, …
    pub coefficients: Vec<f64>,
    /// The shortest wavelength, in nanometres.
    pub from_nm: f64,
    /// The longest wavelength, in nanometres.
    pub to_nm: f64,
}

/// The numbers that a formula can have.
pub const NUMBERS: std::ops::RangeInclusive<u8> = 1..=9;

/// The one pole of formula 7, in square micrometres.
const HERZBERGER_POLE: f64 = 0.028;

impl Formula {
    /// n at a wavelength, or what the formula gives instead of a refractive index.
    pub fn n(&self, nm: f64) -> Result<f64, String> {
        let l = nm / 1000.0;
        let n = match self.number {
            1 => self.root_of(1.0 + self.sellmeier(l, |pole| pole * pole))?,
            2 => self.root_of(1.0 + self.sellmeier(l, |pole| pole))?,
            3 => self.root_of(self.polynomial(l, 0))?,
            4 => self.root_of(self.polynomial(l, 4) + self.poles(l))?,
            5 => self.polynomial(l, 0),
            6 => 1.0 + self.gas(l),
            7 => self.herzberger(l),
            8 => self.root_of(self.retro(l))?,
            9 => self.root_of(self.exotic(l))?,
            other => return Err(format!("there is no formula {other}; there are 1 to 9")),
        };
        if n > 0.0 && n.is_finite() {
            Ok(n)
        } else {
            Err(format!("formula {} gives n = {n}", self.number))
        }
    }

    /// C(i), counted from 1.
    fn c(&self, i: usize) -> f64 {
        self.coefficients.get(i - 1).copied().unwrap_or(0.0)
    }

    /// (C(2i), C(2i+1)) from i = 1.
    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        (1..=self.coefficients.len() / 2).map(|i| (self.c(2 * i), self.c(2 * i + 1)))
    }

    fn root_of(&self, square: f64) -> Result<f64, String> {
        if square > 0.0 && square.is_finite() {
            Ok(square.sqrt())
        } else {
            Err(format!("formula {} gives n^2 = {square}", self.number))
        }
    }

    fn sellmeier(&self, l: f64, squared: impl Fn(f64) -> f64) -> f64 {
        let terms = self
            .pairs()
            .map(|(strength, pole)| strength * l * l / (l * l - squared(pole)));
        self.c(1) + terms.sum::<f64>()
    }

    fn polynomial(&self, l: f64, skipped: usize) -> f64 {
        let terms = self
            .pairs()
            .skip(skipped)
            .map(|(factor, power)| factor * pow(l, power));
        self.c(1) + terms.sum::<f64>()
    }

    /// The two poles of formula 4. One that has no strength is left out: 0 to the power 0 is 1.
    fn poles(&self, l: f64) -> f64 {
        let pole = |first: usize| match self.c(first) {
            0.0 => 0.0,
            strength => {
                strength * pow(l, self.c(first + 1))
                    / (l * l - pow(self.c(first + 2), self.c(first + 3)))
            }
        };
        pole(2) + pole(6)
    }

    fn gas(&self, l: f64) -> f64 {
        let terms = self
            .pairs()
            .map(|(strength, pole)| strength / (pole - 1.0 / (l * l)));
        self.c(1) + terms.sum::<f64>()
    }

    fn herzberger(&self, l: f64) -> f64 {
        let square = l * l;
        let near = 1.0 / (square - HERZBERGER_POLE);
        self.c(1)
            + near * (self.c(2) + near * self.c(3))
            + square * (self.c(4) + square * (self.c(5) + square * self.c(6)))
    }

    fn retro(&self, l: f64) -> f64 {
        let square = l * l;
        let share = self.c(1) + self.c(2) * square / (square - self.c(3)) + self.c(4) * square;
        (1.0 + 2.0 * share) / (1.0 - share)
    }

    fn exotic(&self, l: f64) -> f64 {
        let from = l - self.c(5);
        self.c(1) + self.c(2) / (l * l - self.c(3)) + self.c(4) * from / (from * from + self.c(6))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(number: u8, coefficients: &[f64], nm: f64, n: f64, within: f64) {
        let formula = Formula {
            number,
            coefficients: coefficients.to_vec(),
            from_nm: 100.0,
            to_nm: 10_000.0,
        };
        let got = formula.n(nm).expect("an index");
        assert!((got - n).abs() <= within, "{got} {n}");
    }

    /// Each with an index that its maker prints, or that follows by hand.
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
        check(
            3,
            &[2.25, 0.04, -2.0, 0.0001, 4.0],
            500.0,
            (2.41000625_f64).sqrt(),
            1e-15,
        );
        // 2 + 3·0.25/(0.25 - 0.01) + 0 + 0.5·0.25
        let four = [2.0, 3.0, 2.0, 0.1, 2.0, 0.0, 0.0, 0.0, 0.0, 0.5, 2.0];
        check(4, &four, 500.0, (2.0_f64 + 3.125 + 0.125).sqrt(), 1e-15);
        check(5, &[1.5, 0.01, -2.0], 500.0, 1.54, 1e-15);
        check(6, &[0.0, 0.02, 100.0], 500.0, 1.0 + 0.02 / 96.0, 1e-15);
        check(
            7,
            &[1.5, 0.0222, 0.0, 0.0, 0.0, 16.0],
            500.0,
            1.5 + 0.1 + 0.25,
            1e-14,
        );
        // A share of 1/4 is n² = 1.5/0.75.
        check(8, &[0.25], 500.0, 2.0_f64.sqrt(), 1e-15);
        check(
            9,
            &[1.0, 0.24, 0.01, 0.5, 0.5, 1.0],
            500.0,
            2.0_f64.sqrt(),
            1e-15,
        );
    }

    #[test]
    fn a_coefficient_without_its_partner_has_the_partner_0() {
        check(
            2,
            &[0.0, 1.0, 0.01, 0.5],
            500.0,
            (1.0_f64 + 0.25 / 0.24 + 0.5).sqrt(),
            1e-15,
        );
    }

    #[test]
    fn what_is_no_index_is_refused() {
        let formula = |number, coefficients: &[f64]| Formula {
            number,
            coefficients: coefficients.to_vec(),
            from_nm: 100.0,
            to_nm: 1000.0,
        };
        assert!(formula(3, &[-1.0]).n(500.0).is_err());
        assert!(formula(5, &[-1.0]).n(500.0).is_err());
        assert!(formula(2, &[0.0, 1.0, 0.25]).n(500.0).is_err());
        assert!(formula(10, &[1.0]).n(500.0).is_err());
        assert!(formula(5, &[]).n(500.0).is_err());
    }
}
