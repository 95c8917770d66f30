//! How n and k depend on the wavelength: a table with straight lines between its points, or a formula.

use super::formula::Formula;
use crate::physics::spectra::Spectrum;

/// n(λ) or k(λ).
#[derive(Clone, Debug, PartialEq)]
pub enum DispersionCurve {
    /// Measured points by wavelength in nm; linear between them.
    Table(Spectrum<f64>),
    /// A fitted formula.
    Formula(Formula),
}

/// What is done beyond the measured range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extrapolate {
    /// Nothing: it is refused.
    #[default]
    Refuse,
    /// The value at the nearer end is held; whoever asks for it says so in every output.
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

/// The ends of a range count as inside in spite of rounding: as a share of the wavelength.
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
