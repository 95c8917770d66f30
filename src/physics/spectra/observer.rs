//! Standard observers: the colour matching functions for X, Y and Z.

use std::sync::LazyLock;

use glam::DVec3;

use super::spectrum::Spectrum;
use super::table::rows;

/// A 2 degree standard observer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Observer {
    /// CIE 1931, by which sRGB and all common colour spaces are defined.
    #[default]
    Cie1931,
    /// CIE 2015, from cone fundamentals (CIE 170-2:2015). Its table begins at 390 nm; below, it is taken as 0.
    Cie2015,
}

static CIE_1931: LazyLock<Spectrum<DVec3>> =
    LazyLock::new(|| table(include_str!("../../../data/spectra/cie_1931_2deg.csv")));
static CIE_2015: LazyLock<Spectrum<DVec3>> =
    LazyLock::new(|| table(include_str!("../../../data/spectra/cie_2015_2deg.csv")));

impl Observer {
    /// All of them.
    pub const ALL: [Observer; 2] = [Observer::Cie1931, Observer::Cie2015];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Observer::Cie1931 => "cie1931",
            Observer::Cie2015 => "cie2015",
        }
    }

    /// In words, for headers of files.
    pub fn title(self) -> &'static str {
        match self {
            Observer::Cie1931 => "CIE 1931 2 degree observer",
            Observer::Cie2015 => "CIE 2015 2 degree observer",
        }
    }

    /// The colour matching functions (x̄, ȳ, z̄) at a wavelength in nm: tables of 1 nm, linear in between, 0 outside
    /// (CIE 1931: 360 to 830 nm, CIE 2015: 390 to 830 nm).
    pub fn at(self, nm: f64) -> DVec3 {
        let table = match self {
            Observer::Cie1931 => &CIE_1931,
            Observer::Cie2015 => &CIE_2015,
        };
        table.at(nm).unwrap_or(DVec3::ZERO)
    }
}

fn table(text: &str) -> Spectrum<DVec3> {
    let rows = rows("an embedded table", text, ["nm", "x", "y", "z"]).expect("a test reads it");
    let points = rows
        .iter()
        .map(|row| (row.values[0], DVec3::from_slice(&row.values[1..])));
    Spectrum::new(points.collect()).expect("the reader checks that it ascends")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_are_whole() {
        for (table, first, count) in [(&CIE_1931, 360.0, 471), (&CIE_2015, 390.0, 441)] {
            assert_eq!(table.range(), (first, 830.0));
            assert_eq!(table.points().len(), count);
        }
    }

    #[test]
    fn known_values() {
        // 106.8569 over the whole table, as CIE's tables print it. Only 380 to 780 nm is ever summed.
        let sum = |first: u16, last: u16| -> f64 {
            (first..=last)
                .map(|nm| Observer::Cie1931.at(nm.into()).y)
                .sum()
        };
        let (whole, summed) = (sum(360, 830), sum(380, 780));
        assert!((whole - 106.8569).abs() < 5e-5, "{whole}");
        assert!((summed - 106.856_426).abs() < 1e-6, "{summed}");
        let peak = DVec3::new(0.5120501, 1.0, 0.005_749_999);
        assert_eq!(Observer::Cie1931.at(555.0), peak);
        let between = Observer::Cie1931.at(555.5);
        assert!(between.y < 1.0 && between.y > Observer::Cie1931.at(556.0).y);
        assert_eq!(Observer::Cie2015.at(389.0), DVec3::ZERO);
        assert_eq!(Observer::Cie1931.at(f64::NAN), DVec3::ZERO);
    }
}
