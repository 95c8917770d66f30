//! Linear minimax fits by the exchange algorithm: the linear form with the least largest error. At `terms + 1` reference points,
//! the best form has errors of equal size with known signs. A point with a larger error replaces one of them, until there is
//! none.
//!
//! Source: Stiefel, "Über diskrete und lineare Tschebyscheff-Approximationen", Numerische Mathematik 1, 1959,
//! <https://doi.org/10.1007/BF01386369>. It is the simplex method on the dual of the linear program, so it ends at the optimum
//! over the given points. A range that a sum of coefficients must keep is one more row of that program, with no share in the
//! error.

/// Coefficients, and the largest weighted error that they leave at the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimax {
    /// One for each function of the basis.
    pub coefficients: Vec<f64>,
    /// The largest weighted error.
    pub error: f64,
}

/// The most exchanges. A few dozen are usual.
const MOST: usize = 400;
/// By what share an error must exceed those of the reference for its point to enter.
const MORE: f64 = 1e-9;
/// Errors up to this one are rounding.
const ROUNDING: f64 = 1e-14;
/// By how much a form may leave a range that it must keep.
const BEYOND: f64 = 1e-11;

/// Points, the values wanted there, and limits.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a> {
    /// The values of the basis functions at each point, with the points in order.
    pub rows: &'a [Vec<f64>],
    /// The wanted value at each point.
    pub wanted: &'a [f64],
    /// The weight of the error at each point.
    pub weights: &'a [f64],
    /// The ranges that the form must keep.
    pub limits: &'a [Limit],
}

/// A sum of coefficients that must stay in a range.
#[derive(Clone, Debug)]
pub struct Limit {
    /// The factor of each coefficient in the sum.
    pub row: Vec<f64>,
    /// The least value of the sum.
    pub least: f64,
    /// The largest value of the sum.
    pub most: f64,
}

/// An equation of the reference: on which side of the form its value lies, and whether it is missed by the common error (at a
/// point) or held at the end of a range (of a limit).
#[derive(Clone, Copy, Debug)]
struct Entry {
    place: usize,
    sign: f64,
    held: bool,
}

struct Reference(Vec<Entry>);

/// Fits the wanted values by a basis. There must be many more points than terms, since the reference begins with points spread
/// over them. None where the basis functions are linearly dependent there, where no form keeps the ranges, and where the exchange
/// does not end.
pub fn minimax(points: Points) -> Option<Minimax> {
    let terms = points.rows.first()?.len();
    if points.rows.len() <= terms {
        return None;
    }
    let mut reference = Reference::first(points, terms)?;
    for _ in 0..MOST {
        let (coefficients, level) = reference.level(points)?;
        let missed = |point: usize| points.missed(point, &coefficients);
        let beyond = |limit: usize| points.limits[limit].beyond(&coefficients);
        let (worst, error) = furthest(points.rows.len(), missed);
        let (furthest_out, over) = furthest(points.limits.len(), beyond);
        let (place, off, held) = if over.abs() > BEYOND && over.abs() > error.abs() - level {
            (furthest_out, over, true)
        } else if error.abs() > level * (1.0 + MORE) + ROUNDING {
            (worst, error, false)
        } else {
            return Some(Minimax {
                coefficients,
                error: error.abs(),
            });
        };
        let sign = off.signum();
        reference.exchange(Entry { place, sign, held }, points)?;
    }
    None
}

/// The index with the largest error, and that error.
fn furthest(places: usize, missed: impl Fn(usize) -> f64) -> (usize, f64) {
    let mut most = (0, 0.0f64);
    for next in (0..places).map(|place| (place, missed(place))) {
        if next.1.abs() > most.1.abs() {
            most = next;
        }
    }
    most
}

/// The value of a form whose functions have these values.
pub(super) fn weighted_sum(row: &[f64], coefficients: &[f64]) -> f64 {
    row.iter().zip(coefficients).map(|(b, c)| b * c).sum()
}

impl Limit {
    /// The same for the rest of a sum, of which a part has this value. `row` has the factors of the rest.
    pub(super) fn without(&self, row: Vec<f64>, given: f64) -> Limit {
        Limit {
            row,
            least: self.least - given,
            most: self.most - given,
        }
    }

    /// How far the range lies above the sum; negative where the sum is too large.
    fn beyond(&self, coefficients: &[f64]) -> f64 {
        let sum = weighted_sum(&self.row, coefficients);
        sum.clamp(self.least, self.most) - sum
    }
}

impl Points<'_> {
    /// The weighted difference of the wanted value and the form.
    fn missed(&self, point: usize, coefficients: &[f64]) -> f64 {
        (self.wanted[point] - weighted_sum(&self.rows[point], coefficients)) * self.weights[point]
    }

    /// The row of an entry, and what it should sum to.
    fn equation(&self, entry: Entry) -> (Vec<f64>, f64) {
        if entry.held {
            let Limit { row, least, most } = &self.limits[entry.place];
            return (row.clone(), if entry.sign > 0.0 { *least } else { *most });
        }
        let weight = self.weights[entry.place];
        let row = self.rows[entry.place].iter().map(|value| value * weight);
        (row.collect(), self.wanted[entry.place] * weight)
    }
}

impl Reference {
    /// Points spread like Chebyshev's, with the signs of the vanishing combination of their rows.
    fn first(points: Points, terms: usize) -> Option<Reference> {
        let entry = |i: usize| {
            let share = (1.0 - libm::cos(std::f64::consts::PI * i as f64 / terms as f64)) / 2.0;
            Entry {
                place: libm::round(share * (points.rows.len() - 1) as f64) as usize,
                sign: 1.0,
                held: false,
            }
        };
        let mut entries: Vec<Entry> = (0..=terms).map(entry).collect();
        let mut rows = entries.iter().map(|entry| points.equation(*entry).0);
        // The first row as a combination of the others.
        let first = rows.next()?;
        let others: Vec<Vec<f64>> = rows.collect();
        let parts = solve(transposed(&others), first)?;
        for (entry, part) in entries[1..].iter_mut().zip(parts) {
            entry.sign = if part > 0.0 { -1.0 } else { 1.0 };
        }
        Some(Reference(entries))
    }

    /// The form whose errors at all points of the reference have the same size and their known signs, with its limits held at the
    /// ends of their ranges. The level is made positive at the beginning. It stays positive, since it grows with every exchange.
    fn level(&mut self, points: Points) -> Option<(Vec<f64>, f64)> {
        let with_error = |entry: &Entry| {
            let (mut row, value) = points.equation(*entry);
            row.push(if entry.held { 0.0 } else { entry.sign });
            (row, value)
        };
        let (rows, values) = self.0.iter().map(with_error).unzip();
        let mut solved = solve(rows, values)?;
        let level = solved.pop()?;
        if level < 0.0 && self.0.iter().all(|entry| !entry.held) {
            self.0.iter_mut().for_each(|entry| entry.sign = -entry.sign);
        }
        Some((solved, level.abs()))
    }

    /// Takes an entry in, and removes the one without which the rest is still a reference.
    fn exchange(&mut self, enters: Entry, points: Points) -> Option<()> {
        let signed = |entry: &Entry| {
            let (row, _) = points.equation(*entry);
            let mut row: Vec<f64> = row.iter().map(|value| value * entry.sign).collect();
            row.push(if entry.held { 0.0 } else { 1.0 });
            row
        };
        let rows: Vec<Vec<f64>> = self.0.iter().map(signed).collect();
        let columns = transposed(&rows);
        let mut nothing = vec![0.0; columns.len()];
        *nothing.last_mut()? = 1.0;
        let shares = solve(columns.clone(), nothing)?;
        let parts = solve(columns, signed(&enters))?;
        let ratios = shares.iter().zip(&parts).enumerate();
        let leaves = ratios.filter(|(_, (_, part))| **part > ROUNDING);
        let leaves = leaves.map(|(i, (share, part))| (i, share / part));
        let (leaves, _) = leaves.min_by(|a, b| a.1.total_cmp(&b.1))?;
        self.0[leaves] = enters;
        Some(())
    }
}

fn transposed(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let columns = 0..rows.first().map_or(0, Vec::len);
    columns
        .map(|column| rows.iter().map(|row| row[column]).collect())
        .collect()
}

/// Solves a few linear equations by elimination with the largest pivots. None where there is no unique solution.
pub(super) fn solve(mut rows: Vec<Vec<f64>>, mut values: Vec<f64>) -> Option<Vec<f64>> {
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
    let is_solved = values.iter().all(|value| value.is_finite());
    is_solved.then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(count: usize) -> Vec<f64> {
        (0..=count).map(|i| i as f64 / count as f64).collect()
    }

    fn fit_free(rows: &[Vec<f64>], wanted: &[f64], weights: &[f64]) -> Option<Minimax> {
        minimax(Points {
            rows,
            wanted,
            weights,
            limits: &[],
        })
    }

    fn fit_within(rows: &[Vec<f64>], wanted: &[f64], (least, most): (f64, f64)) -> Option<Minimax> {
        let limit = |row: &Vec<f64>| Limit {
            row: row.clone(),
            least,
            most,
        };
        let limits: Vec<Limit> = rows.iter().map(limit).collect();
        minimax(Points {
            rows,
            wanted,
            weights: &vec![1.0; rows.len()],
            limits: &limits,
        })
    }

    /// Powers of these points.
    fn rows(at: &[f64], powers: &[i32]) -> Vec<Vec<f64>> {
        let row = |x: &f64| powers.iter().map(|p| x.powi(*p)).collect();
        at.iter().map(row).collect()
    }

    fn fit(f: fn(f64) -> f64, powers: &[i32], count: usize) -> Minimax {
        let at = points(count);
        let wanted: Vec<f64> = at.iter().map(|x| f(*x)).collect();
        let weights = vec![1.0; at.len()];
        fit_free(&rows(&at, powers), &wanted, &weights).expect("powers tell points apart")
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
        let rows = rows(&at, &[0, 1]);
        let wanted: Vec<f64> = at.iter().map(|x| x * x).collect();
        let weights: Vec<f64> = at.iter().map(|x| 1.0 + 9.0 * x).collect();
        let found = fit_free(&rows, &wanted, &weights).expect("lines tell points apart");
        let missed = |x: f64| x * x - found.coefficients[0] - found.coefficients[1] * x;
        // The error at the end with the largest weight is no larger than the others, weighted.
        assert!(
            (missed(1.0) * 10.0 - found.error).abs() < 1e-12,
            "{found:?}"
        );
        let largest = at.iter().map(|x| (missed(*x) * (1.0 + 9.0 * x)).abs());
        let largest = largest.fold(0.0, f64::max);
        assert!((largest - found.error).abs() < 1e-12, "{found:?}");
    }

    /// x² on [0, 1] by a line that stays above 0: x - 1/8 is lifted to go through a point, and 2 (√2 - 1) x has equal errors at 1
    /// and in the middle.
    #[test]
    fn a_range_is_kept_at_the_least_cost() {
        let at = points(10_000);
        let lines = rows(&at, &[0, 1]);
        let wanted: Vec<f64> = at.iter().map(|x| x * x).collect();
        let found = fit_within(&lines, &wanted, (0.0, 1.0)).expect("a line");
        let slope = 2.0 * (2.0_f64.sqrt() - 1.0);
        assert!(found.coefficients[0].abs() < 1e-12, "{found:?}");
        assert!((found.coefficients[1] - slope).abs() < 1e-8, "{found:?}");
        assert!((found.error - (1.0 - slope)).abs() < 1e-8, "{found:?}");
        let wide = fit_within(&lines, &wanted, (-1.0, 2.0)).expect("a line");
        assert!((wide.error - 0.125).abs() < 1e-8, "{wide:?}");
        // A multiple of x is always 0 at 0.
        assert_eq!(fit_within(&rows(&at, &[1]), &wanted, (0.5, 1.0)), None);
    }

    #[test]
    fn what_tells_nothing_apart_has_no_fit() {
        let rows = vec![vec![1.0, 1.0]; 10];
        assert_eq!(fit_free(&rows, &[0.0; 10], &[1.0; 10]), None);
        assert_eq!(fit_free(&[], &[], &[]), None);
    }
}
