//! The law of `optics` against tables computed independently at 50 digits: `reference/oracle.csv`, keyed by the
//! angle in degrees, and `reference/oracle_cos.csv`, keyed by its cosine.
//!
//! The inputs are the `f64` nearest to the printed decimals, and the angle is converted exactly. Double-double must
//! agree with every row to 1e-16, which is what rounding the table to `f64` takes. `f64` must agree to 1e-14 on ordinary
//! rows and to 1e-7 on hard ones (these reach 6e-11; at the critical angle itself √1e-16 = 1e-8 is what an `f64` allows).

use super::numbers::Dd;
use fresnel_gen::physics::num::Num;
use fresnel_gen::physics::optics::{Reflectance, conductor};

/// One line of either table.
struct Row {
    line: String,
    n: f64,
    k: f64,
    cos_theta: Dd,
    expected: [f64; 3],
}

impl Row {
    /// Near the critical angle w² = m² − sin²θ nearly vanishes, and R depends on its square root: the rounding of
    /// cos θ to `f64`, 1e-16, then moves R by up to 1e-16/√|w²|. A row is hard where |w²| < 1e-3 and cos θ is not itself
    /// that small (at grazing incidence of an index near 1, w² is small but is computed with all its digits).
    fn is_hard(&self) -> bool {
        let one = Dd::from(1.0);
        let (n, k) = (Dd::from(self.n), Dd::from(self.k));
        let cos_squared = self.cos_theta * self.cos_theta;
        let real = (n - one) * (n + one) - k * k + cos_squared;
        let w_squared = real.to_f64().hypot(2.0 * self.n * self.k);
        w_squared < 1e-3 * cos_squared.to_f64()
    }

    fn error<N: Num>(&self, law: Reflectance<N>) -> f64 {
        [law.s, law.p, law.unpolarised()]
            .into_iter()
            .zip(self.expected)
            .map(|(got, want)| (got - N::from_f64(want)).abs().to_f64())
            .fold(0.0, f64::max)
    }

    fn error_of_dd(&self) -> f64 {
        self.error(conductor(
            Dd::from(self.n),
            Dd::from(self.k),
            self.cos_theta,
        ))
    }

    fn error_of_f64(&self) -> f64 {
        self.error(conductor(self.n, self.k, self.cos_theta.to_f64()))
    }
}

/// The rows of a table whose columns n, k, angle, Rs, Rp, R come last; `cosine` reads the angle.
fn rows(file: &str, cosine: fn(f64) -> Dd) -> Vec<Row> {
    let path = format!("{}/tests/reference/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("the table is part of the repository");
    text.lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let numbers: Vec<f64> = cells[cells.len() - 6..]
                .iter()
                .map(|cell| cell.parse().expect("the last six cells are numbers"))
                .collect();
            Row {
                line: line.to_string(),
                n: numbers[0],
                k: numbers[1],
                cos_theta: cosine(numbers[2]),
                expected: [numbers[3], numbers[4], numbers[5]],
            }
        })
        .collect()
}

fn all_rows() -> Vec<Row> {
    let mut all = rows("oracle.csv", |degrees| Dd::sin_cos_degrees(degrees).1);
    all.extend(rows("oracle_cos.csv", Dd::from));
    all
}

#[track_caller]
fn check<'a>(title: &str, rows: impl Iterator<Item = &'a Row>, error: fn(&Row) -> f64, limit: f64) {
    let measured: Vec<(f64, &Row)> = rows.map(|row| (error(row), row)).collect();
    let (worst, row) = measured
        .iter()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .expect("each table has such rows");
    println!(
        "{title}: {} rows, worst error {worst:.2e} at {}",
        measured.len(),
        row.line
    );
    assert!(
        *worst <= limit,
        "{title}: {worst:e} exceeds {limit:e} at {}",
        row.line
    );
}

#[test]
fn double_double_agrees_with_every_row() {
    let rows = all_rows();
    check("double-double", rows.iter(), Row::error_of_dd, 1e-16);
}

#[test]
fn f64_agrees_with_ordinary_rows() {
    let rows = all_rows();
    let ordinary = rows.iter().filter(|row| !row.is_hard());
    check("f64, ordinary", ordinary, Row::error_of_f64, 1e-14);
}

#[test]
fn f64_is_near_the_hard_rows() {
    let rows = all_rows();
    let hard = rows.iter().filter(|row| row.is_hard());
    check("f64, hard", hard, Row::error_of_f64, 1e-7);
}
