//! The linear form whose largest error is least, by exchange: among `terms + 1` points the best form has errors of
//! one size with signs that are known; a point where more is missed takes the place of one of them, until there is none.
//!
//! Source: Stiefel, "Über diskrete und lineare Tschebyscheff-Approximationen", Numerische Mathematik 1, 1959,
//! <https://doi.org/10.1007/BF01386369>. It is the simplex method on the dual of the linear program, and its end is the
//! optimum over the points given, not a guess.

/// Coefficients, and the largest error that they leave at the points, weighted.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimax {
    /// One for each function of the basis.
    pub coefficients: Vec<f64>,
    /// The largest weighted error.
    pub error: f64,
}

/// Exchanges after which it is given up: some dozen are usual.
const MOST: usize = 400;
/// By how much a point must be missed more than those of the reference, as a share, to enter it.
const MORE: f64 = 1e-9;
/// An error that is rounding.
const ROUNDING: f64 = 1e-14;

/// The points of the reference, and on which side of the form they lie there.
struct Reference {
    points: Vec<usize>,
    signs: Vec<f64>,
}

/// Fits `wanted` at some points by a basis: a row of its functions' values for each point, in an order along which the
/// points run. None where the functions do not tell the points apart.
pub fn minimax(rows: &[Vec<f64>], wanted: &[f64], weights: &[f64]) -> Option<Minimax> {
    let terms = rows.first()?.len();
    if rows.len() <= terms {
        return None;
    }
    let row = |point: usize| -> Vec<f64> {
        let weighted = rows[point].iter().map(|value| value * weights[point]);
        weighted.collect()
    };
    let mut reference = Reference::first(rows.len(), terms, &row)?;
    for _ in 0..MOST {
        let (coefficients, level) = reference.level(&row, wanted, weights)?;
        let missed = |point: usize| {
            let form: f64 = rows[point]
                .iter()
                .zip(&coefficients)
                .map(|(b, c)| b * c)
                .sum();
            (wanted[point] - form) * weights[point]
        };
        let (worst, error) = furthest(rows.len(), missed);
        if error.abs() <= level * (1.0 + MORE) + ROUNDING {
            return Some(Minimax {
                coefficients,
                error: error.abs(),
            });
        }
        reference.exchange(worst, error.signum(), &row)?;
    }
    None
}

/// The point that is missed most, and by how much.
fn furthest(points: usize, missed: impl Fn(usize) -> f64) -> (usize, f64) {
    let all = (0..points).map(|point| (point, missed(point)));
    all.fold((0, 0.0), |most: (usize, f64), next| {
        if next.1.abs() > most.1.abs() {
            next
        } else {
            most
        }
    })
}

impl Reference {
    /// Points spread as Chebyshev's are, with the signs of the combination of their rows that is nothing.
    fn first(points: usize, terms: usize, row: &dyn Fn(usize) -> Vec<f64>) -> Option<Reference> {
        let place = |i: usize| {
            let share = (1.0 - libm::cos(std::f64::consts::PI * i as f64 / terms as f64)) / 2.0;
            libm::round(share * (points - 1) as f64) as usize
        };
        let points: Vec<usize> = (0..=terms).map(place).collect();
        // The first row as a combination of the others.
        let others: Vec<Vec<f64>> = points[1..].iter().map(|point| row(*point)).collect();
        let parts = solve(transposed(&others), row(points[0]))?;
        let sign = |part: &f64| if *part > 0.0 { -1.0 } else { 1.0 };
        let signs = [1.0].into_iter().chain(parts.iter().map(sign)).collect();
        Some(Reference { points, signs })
    }

    /// The form that misses all points of the reference by the same, each on its side; the level is made positive.
    fn level(
        &mut self,
        row: &dyn Fn(usize) -> Vec<f64>,
        wanted: &[f64],
        weights: &[f64],
    ) -> Option<(Vec<f64>, f64)> {
        let with_sign = |(point, sign): (&usize, &f64)| {
            let mut row = row(*point);
            row.push(*sign);
            row
        };
        let rows = self.points.iter().zip(&self.signs).map(with_sign).collect();
        let values = self
            .points
            .iter()
            .map(|point| wanted[*point] * weights[*point]);
        let mut solved = solve(rows, values.collect())?;
        let level = solved.pop()?;
        if level < 0.0 {
            self.signs.iter_mut().for_each(|sign| *sign = -*sign);
        }
        Some((solved, level.abs()))
    }

    /// Takes a point in, and that one out without which the rest is still a reference.
    fn exchange(&mut self, point: usize, sign: f64, row: &dyn Fn(usize) -> Vec<f64>) -> Option<()> {
        let signed = |point: usize, sign: f64| {
            let mut row: Vec<f64> = row(point).iter().map(|value| value * sign).collect();
            row.push(1.0);
            row
        };
        let all = self.points.iter().zip(&self.signs);
        let rows: Vec<Vec<f64>> = all.map(|(point, sign)| signed(*point, *sign)).collect();
        let columns = transposed(&rows);
        let mut nothing = vec![0.0; columns.len()];
        *nothing.last_mut()? = 1.0;
        let shares = solve(columns.clone(), nothing)?;
        let parts = solve(columns, signed(point, sign))?;
        let ratios = shares.iter().zip(&parts).enumerate();
        let leaves = ratios.filter(|(_, (_, part))| **part > ROUNDING);
        let leaves = leaves.map(|(i, (share, part))| (i, share / part));
        let (leaves, _) = leaves.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (self.points[leaves], self.signs[leaves]) = (point, sign);
        Some(())
    }
}

fn transposed(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let columns = 0..rows.first().map_or(0, Vec::len);
    columns
        .map(|column| rows.iter().map(|row| row[column]).collect())
        .collect()
}

/// The solution of a few linear equations by elimination with the largest pivots; none where they have no single one.
fn solve(mut rows: Vec<Vec<f64>>, mut values: Vec<f64>) -> Option<Vec<f64>> {
    let count = values.len();
    for step in 0..count {
        let rest = step..count;
        let pivot = rest.max_by(|a, b| rows[*a][step].abs().total_cmp(&rows[*b][step].abs()))?;
        rows.swap(step, pivot);
        values.swap(step, pivot);
        if rows[step][step].abs() < f64::MIN_POSITIVE {
            return None;
        }
        let (done, below) = rows.split_at_mut(step + 1);
        let (top, value) = (&done[step], values[step]);
        for (row, own) in below.iter_mut().zip(&mut values[step + 1..]) {
            let share = row[step] / top[step];
            for (cell, above) in row.iter_mut().zip(top).skip(step) {
                *cell -= share * above;
            }
            *own -= share * value;
        }
    }
    for step in (0..count).rev() {
        let known: f64 = (step + 1..count).map(|i| rows[step][i] * values[i]).sum();
        values[step] = (values[step] - known) / rows[step][step];
    }
    values
        .iter()
        .all(|value| value.is_finite())
        .then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(count: usize) -> Vec<f64> {
        (0..=count).map(|i| i as f64 / count as f64).collect()
    }

    fn fit(f: fn(f64) -> f64, powers: &[i32], count: usize) -> Minimax {
        let at = points(count);
        let rows: Vec<Vec<f64>> = at
            .iter()
            .map(|x| powers.iter().map(|p| x.powi(*p)).collect())
            .collect();
        let wanted: Vec<f64> = at.into_iter().map(f).collect();
        minimax(&rows, &wanted, &vec![1.0; rows.len()]).expect("powers tell points apart")
    }

    /// x² on [0, 1] by a line: x - 1/8, within 1/8. x³ by a parabola: Chebyshev's 1/32.
    #[test]
    fn the_best_forms_of_textbooks_come_out() {
        let line = fit(|x| x * x, &[0, 1], 1000);
        assert!((line.error - 0.125).abs() < 1e-12, "{line:?}");
        assert!((line.coefficients[0] + 0.125).abs() < 1e-12, "{line:?}");
        assert!((line.coefficients[1] - 1.0).abs() < 1e-12, "{line:?}");
        let parabola = fit(|x| x * x * x, &[0, 1, 2], 4000);
        assert!((parabola.error - 0.031_25).abs() < 1e-7, "{parabola:?}");
    }

    #[test]
    fn what_the_basis_holds_is_found_exactly() {
        let found = fit(|x| 0.5 - 2.0 * x.powi(3), &[0, 3, 8], 50);
        assert!(found.error < 1e-13, "{found:?}");
        assert!((found.coefficients[1] + 2.0).abs() < 1e-10, "{found:?}");
    }

    #[test]
    fn a_weight_counts() {
        let at = points(200);
        let rows: Vec<Vec<f64>> = at.iter().map(|x| vec![1.0, *x]).collect();
        let wanted: Vec<f64> = at.iter().map(|x| x * x).collect();
        let weights: Vec<f64> = at.iter().map(|x| 1.0 + 9.0 * x).collect();
        let found = minimax(&rows, &wanted, &weights).expect("lines tell points apart");
        let missed = |x: f64| x * x - found.coefficients[0] - found.coefficients[1] * x;
        // The end that counts most is missed by no more than the rest, weighted.
        assert!(
            (missed(1.0) * 10.0 - found.error).abs() < 1e-12,
            "{found:?}"
        );
        let largest = at.iter().map(|x| (missed(*x) * (1.0 + 9.0 * x)).abs());
        let largest = largest.fold(0.0, f64::max);
        assert!((largest - found.error).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn what_tells_nothing_apart_has_no_fit() {
        let rows = vec![vec![1.0, 1.0]; 10];
        assert_eq!(minimax(&rows, &[0.0; 10], &[1.0; 10]), None);
        assert_eq!(minimax(&[], &[], &[]), None);
    }
}
