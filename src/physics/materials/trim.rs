//! A material cut down to a range of wavelengths.

use super::dispersion::DispersionCurve;
use super::material::Material;

impl Material {
    /// The same material with its tables cut to a range of wavelengths: from the last row at or below its start to the
    /// first at or above its end, so that every index inside stays what it was. A formula stays whole.
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

/// At least one point, the nearest, where the table lies outside.
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
    fn check(from_nm: f64, to_nm: f64, kept: &[f64]) {
        let point = |nm| (nm, 1.0);
        let points = [300.0, 400.0, 500.0, 600.0].map(point);
        let got = within(&points, from_nm, to_nm).iter().map(|p| p.0);
        assert_eq!(got.collect::<Vec<_>>(), kept);
    }

    #[test]
    fn the_rows_around_the_range_stay() {
        check(400.0, 500.0, &[400.0, 500.0]);
        check(401.0, 499.0, &[400.0, 500.0]);
        check(399.0, 501.0, &[300.0, 400.0, 500.0, 600.0]);
        check(100.0, 900.0, &[300.0, 400.0, 500.0, 600.0]);
        check(100.0, 200.0, &[300.0]);
        check(700.0, 900.0, &[600.0]);
        check(500.0, 400.0, &[500.0]);
        check(f64::NAN, f64::NAN, &[300.0]);
        assert_eq!(within(&[], 1.0, 2.0), &[]);
    }
}
