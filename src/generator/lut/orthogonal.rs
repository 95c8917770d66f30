//! What the split-sum tables of a method hold whose terms half precision holds poorly: orthogonal functions.
//!
//! The terms of `fitted_film` are nearly alike and reach 40, and cancel, so half precision of their means is poor. Functions that
//! span the same curves, orthogonal over the cosine and at most 1, are held well. The first is 1, so its mean is the albedo of a
//! surface that reflects everything, as in every split-sum table. A material's numbers are a matrix times its coefficients.
//!
//! Source: the modified Gram-Schmidt process, Björck, "Solving linear least squares problems by Gram-Schmidt orthogonalization",
//! BIT 7, 1967, <https://doi.org/10.1007/BF01934122>.

use super::split_sum::{MOST_TERM, term_range};
use crate::language::methods::{Basis, MOST_TERMS};

/// Orthogonal functions that span what the terms of a basis do.
#[derive(Clone, Debug)]
pub struct Orthogonal {
    /// Term j is the sum over functions i of `rows[i][j]` times function i; 0 for i above j. So a material's number of function i
    /// is row i times its coefficients.
    pub rows: Vec<Vec<f64>>,
}

impl Orthogonal {
    /// The functions that stand for the terms of a basis in a table; none where a texture holds these terms well.
    pub fn of(basis: &Basis) -> Option<Orthogonal> {
        let is_needed = basis.terms() > MOST_TERMS || term_range(basis)[1] > MOST_TERM;
        is_needed.then(|| Orthogonal::new(basis))
    }

    /// The functions of a basis, over equal steps of the cosine.
    pub fn new(basis: &Basis) -> Orthogonal {
        const STEPS: usize = 1000;
        let count = basis.terms();
        let at = |step: usize| {
            let mut terms = vec![0.0; count];
            basis.add(step as f64 / STEPS as f64, 1.0, &mut terms);
            terms
        };
        let points: Vec<Vec<f64>> = (0..=STEPS).map(at).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut rows = vec![vec![0.0; count]; count];
        let mut functions: Vec<Vec<f64>> = Vec::new();
        for j in 0..count {
            let mut rest: Vec<f64> = points.iter().map(|terms| terms[j]).collect();
            for (row, function) in rows.iter_mut().zip(&functions) {
                row[j] = dot(&rest, function) / dot(function, function);
                for (rest, value) in rest.iter_mut().zip(function) {
                    *rest -= row[j] * value;
                }
            }
            let most = rest
                .iter()
                .fold(0.0, |most, value| f64::max(most, value.abs()));
            rows[j][j] = most;
            functions.push(rest.iter().map(|value| value / most).collect());
        }
        Orthogonal { rows }
    }

    /// The functions, or means of them, from terms or the same means of these.
    pub fn functions(&self, terms: &[f64]) -> Vec<f64> {
        let mut functions: Vec<f64> = Vec::new();
        for (j, term) in terms.iter().enumerate() {
            let others = functions.iter().zip(&self.rows);
            let others: f64 = others.map(|(value, row)| row[j] * value).sum();
            functions.push((term - others) / self.rows[j][j]);
        }
        functions
    }

    /// A material's numbers from its coefficients.
    pub fn numbers(&self, coefficients: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let number = |row: &Vec<f64>| {
            [0, 1, 2].map(|channel| {
                let products = row.iter().zip(coefficients);
                products.map(|(factor, c)| factor * c[channel]).sum()
            })
        };
        self.rows.iter().map(number).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;

    #[test]
    fn numbers_times_functions_are_coefficients_times_terms() {
        let basis = find("fitted_film")
            .and_then(|method| method.basis())
            .unwrap();
        let functions = Orthogonal::new(&basis);
        let coefficients = [0.3, -0.1, 0.02, 0.05, -0.2, 0.1].map(|c| [c, 2.0 * c, -c]);
        let numbers = functions.numbers(&coefficients);
        for step in 0..=100 {
            let mut terms = [0.0; 6];
            basis.add(f64::from(step) / 100.0, 1.0, &mut terms);
            let values = functions.functions(&terms);
            assert_eq!(values[0], 1.0);
            assert!(values.iter().all(|value| value.abs() < 1.0 + 1e-9));
            for channel in 0..3 {
                let sum = |factors: &[[f64; 3]], of: &[f64]| -> f64 {
                    factors.iter().zip(of).map(|(a, b)| a[channel] * b).sum()
                };
                let off = sum(&numbers, &values) - sum(&coefficients, &terms);
                assert!(off.abs() < 1e-12, "{off}");
            }
        }
    }
}
