//! Gauss-Legendre quadrature: exact for polynomials up to degree 2 n - 1 with n points.
//!
//! Source: Gauss, "Methodus nova integralium valores per approximationem inveniendi", Commentationes Societatis Regiae
//! Scientiarum Gottingensis Recentiores 3, 1815, <https://archive.org/details/methodusnovainte00gaus>. The points are the zeros of
//! Legendre's polynomial, by Newton's method from `cos(π (i + 3/4) / (n + 1/2))`; the weights are `2 / ((1 - x²) P'(x)²)`.

/// A quadrature rule of n points.
#[derive(Clone, Debug, PartialEq)]
pub struct Legendre {
    /// Points in (0, 1), ascending, and their weights, whose sum is 1; within 1e-15.
    points: Vec<(f64, f64)>,
}

/// Newton's method doubles the digits each step: three at the start, sixteen after three steps. Two more are margin.
const ITERATIONS: usize = 5;

impl Legendre {
    /// The rule with this many points.
    pub fn new(points: usize) -> Legendre {
        let points = (0..points).rev().map(|from_end| point(points, from_end));
        Legendre {
            points: points.collect(),
        }
    }

    /// Points and weights over an interval, ascending.
    pub fn over(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let size = to - from;
        let points = self.points.iter();
        points.map(move |(x, weight)| (from + size * x, size * weight))
    }
}

/// A point on (0, 1), counted from its right end, and its weight.
fn point(count: usize, from_end: usize) -> (f64, f64) {
    let start = (from_end as f64 + 0.75) / (count as f64 + 0.5);
    let mut x = libm::cos(std::f64::consts::PI * start);
    for _ in 0..ITERATIONS {
        let (value, slope) = polynomial(count, x);
        x -= value / slope;
    }
    let (_, slope) = polynomial(count, x);
    (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
}

/// Legendre's polynomial of this degree and its derivative, inside (-1, 1), by Bonnet's recursion.
fn polynomial(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 1..=degree {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k;
        (before, value) = (value, next);
    }
    let slope = degree as f64 * (x * value - before) / (x * x - 1.0);
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for count in [1, 2, 5, 16, 64, 128] {
            let rule = Legendre::new(count);
            for degree in 0..(2 * count).min(60) as i32 {
                let sum: f64 = rule.over(0.0, 1.0).map(|(x, w)| w * x.powi(degree)).sum();
                let want = 1.0 / f64::from(degree + 1);
                assert!((sum - want).abs() < 1e-14, "{count} {degree}: {sum}");
            }
            let ascending: Vec<f64> = rule.over(2.0, 3.0).map(|(x, _)| x).collect();
            assert!(ascending.is_sorted() && ascending[0] > 2.0);
        }
    }
}
