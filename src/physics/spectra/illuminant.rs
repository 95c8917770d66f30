//! Lights: relative spectral power, of standard illuminants and of a user's file.
//!
//! ```text
//! S_A(λ) = 100 (560/λ)⁵ (exp(1.435e7 / (2848 · 560)) − 1) / (exp(1.435e7 / (2848 λ)) − 1)      λ in nm
//! ```
//!
//! Source: CIE 015:2018, *Colorimetry*, 4th edition, <https://doi.org/10.25039/TR.015.2018>. A is this formula (Planck's
//! law at 2856 K with today's constants). D65, FL11 and LED-B3 are tables, linear between their rows. E is equal power.
//! Units do not matter: colours are relative to the light's own Y.

use std::sync::LazyLock;

use super::spectrum::{FIRST_NM, LAST_NM, Spectrum, Step};
use super::table::{SpectrumRow, rows};
use crate::physics::user_text::FileFault;

/// A light.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Illuminant {
    /// Daylight, 6504 K.
    #[default]
    D65,
    /// Equal power at every wavelength.
    E,
    /// An incandescent lamp, 2856 K.
    A,
    /// CIE FL11: a fluorescent lamp with three narrow bands, 4000 K.
    F11,
    /// A white lamp of blue diodes and phosphor, about 4100 K.
    LedB3,
    /// A user's light.
    Table {
        /// The file's name, without folders.
        name: String,
        /// Its power, which [`Illuminant::parse`] has checked to cover 380 to 780 nm.
        power: Spectrum<f64>,
    },
}

static D65: LazyLock<Spectrum<f64>> =
    LazyLock::new(|| embedded(include_str!("../../../data/spectra/d65.csv")));
static F11: LazyLock<Spectrum<f64>> =
    LazyLock::new(|| embedded(include_str!("../../../data/spectra/f11.csv")));
static LED_B3: LazyLock<Spectrum<f64>> =
    LazyLock::new(|| embedded(include_str!("../../../data/spectra/led_b3.csv")));

impl Illuminant {
    /// The standard illuminants, which have names.
    pub const NAMED: [Illuminant; 5] = [
        Illuminant::D65,
        Illuminant::A,
        Illuminant::E,
        Illuminant::F11,
        Illuminant::LedB3,
    ];

    /// The name on the command line and in headers; of a user's light, its file's.
    pub fn name(&self) -> &str {
        match self {
            Illuminant::D65 => "D65",
            Illuminant::E => "E",
            Illuminant::A => "A",
            Illuminant::F11 => "F11",
            Illuminant::LedB3 => "LED-B3",
            Illuminant::Table { name, .. } => name,
        }
    }

    /// The standard illuminant of this name, in upper or lower case.
    ///
    /// ```
    /// use fresnel_gen::physics::spectra::Illuminant;
    ///
    /// assert_eq!(Illuminant::find("d65"), Some(Illuminant::D65));
    /// ```
    pub fn find(name: &str) -> Option<Illuminant> {
        Illuminant::NAMED
            .into_iter()
            .find(|light| light.name().eq_ignore_ascii_case(name))
    }

    /// A light from a user's table: wavelength in nm and power in any unit, 0 to 1e30, in two columns. It must cover
    /// 380 to 780 nm and have power somewhere in there. `file` is its name, for messages and for [`Illuminant::name`].
    ///
    /// # Errors
    /// The text is not a table of two columns, a value lies outside its limits, or the table does not cover 380 to 780 nm.
    pub fn parse(file: &str, text: &str) -> Result<Illuminant, FileFault> {
        let rows = rows(file, text, COLUMNS)?;
        if let Some((line, what)) = range_fault(&rows) {
            return Err(FileFault::new(file, line, 1, what));
        }
        let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
        Ok(Illuminant::Table {
            name: without_controls(name),
            power: spectrum(&rows),
        })
    }

    /// The same light under another name, if it is a user's table. A standard one keeps its name.
    pub fn named(self, name: &str) -> Illuminant {
        match self {
            Illuminant::Table { power, .. } => Illuminant::Table {
                name: without_controls(name),
                power,
            },
            standard => standard,
        }
    }

    /// Its relative power at each wavelength of a sum in equal steps (nm, ascending). Where a user's table has rows between them,
    /// such as a lamp's lines, the mean about each wavelength is taken ([`Spectrum::mean_about`]), so that no line is lost.
    pub fn powers(&self, wavelengths: &[f64]) -> Vec<f64> {
        if let (Illuminant::Table { power, .. }, [first, second, ..]) = (self, wavelengths) {
            let range = *first..=wavelengths[wavelengths.len() - 1];
            let mut rows = power.points().iter().map(|point| point.0);
            if rows.any(|nm| range.contains(&nm) && !wavelengths.contains(&nm)) {
                let about = |nm: &f64| power.mean_about(*nm, second - first).unwrap_or(0.0);
                return wavelengths.iter().map(about).collect();
            }
        }
        wavelengths.iter().map(|nm| self.power(*nm)).collect()
    }

    /// Its relative power at a wavelength in nm; 0 outside its table.
    pub fn power(&self, nm: f64) -> f64 {
        let table = match self {
            Illuminant::E => return 1.0,
            Illuminant::A => return incandescent(nm),
            Illuminant::D65 => &D65,
            Illuminant::F11 => &F11,
            Illuminant::LedB3 => &LED_B3,
            Illuminant::Table { power, .. } => power,
        };
        table.at(nm).unwrap_or(0.0)
    }
}

const COLUMNS: [&str; 2] = ["nm", "power"];

/// Standard illuminant A by its definition, 100 at 560 nm.
fn incandescent(nm: f64) -> f64 {
    let planck = |nm: f64| libm::expm1(1.435e7 / (2848.0 * nm));
    let ratio = 560.0 / nm;
    100.0 * ratio * ratio * ratio * ratio * ratio * planck(560.0) / planck(nm)
}

/// The line and what is wrong, if the rows do not cover the summed range with power.
fn range_fault(rows: &[SpectrumRow<2>]) -> Option<(usize, String)> {
    let (first, last) = (rows.first()?, rows.last()?);
    let (from, to) = (first.values[0], last.values[0]);
    if from > FIRST_NM || to < LAST_NM {
        let line = if from > FIRST_NM {
            first.line
        } else {
            last.line
        };
        let what =
            format!("the table holds {from} to {to} nm; it must cover {FIRST_NM} to {LAST_NM} nm");
        return Some((line, what));
    }
    let power = spectrum(rows);
    let rows = rows.iter().map(|row| row.values[0]);
    let seen = rows.filter(|nm| (FIRST_NM..=LAST_NM).contains(nm));
    let seen = seen.chain(Step::Nm1.wavelengths());
    let brightest = seen.filter_map(|nm| power.at(nm)).fold(0.0, f64::max);
    (brightest < LEAST_POWER).then(|| {
        let what = format!(
            "no light: power is below {LEAST_POWER:e} at every wavelength from {FIRST_NM} to {LAST_NM} nm"
        );
        (first.line, what)
    })
}

/// A light whose power is nowhere above this is refused: products with it would lose their digits.
const LEAST_POWER: f64 = 1e-30;

fn spectrum(rows: &[SpectrumRow<2>]) -> Spectrum<f64> {
    let points = rows.iter().map(|row| (row.values[0], row.values[1]));
    Spectrum::new(points.collect()).expect("the reader checks that it ascends")
}

fn embedded(text: &str) -> Spectrum<f64> {
    spectrum(&rows("an embedded table", text, COLUMNS).expect("a test reads it"))
}

/// A name that headers and reports can hold.
fn without_controls(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_are_whole() {
        for (table, first, count) in [(&D65, 300.0, 97), (&F11, 380.0, 81), (&LED_B3, 380.0, 81)] {
            assert_eq!(table.range(), (first, 780.0));
            assert_eq!(table.points().len(), count);
        }
        for light in Illuminant::NAMED {
            assert_eq!(Illuminant::find(&light.name().to_lowercase()), Some(light));
        }
        assert_eq!(Illuminant::find("D50"), None);
    }

    #[test]
    fn a_is_its_printed_table() {
        // CIE 15:2004, table T.1: six digits.
        for (nm, power) in [
            (380.0, 9.7951),
            (450.0, 33.0859),
            (560.0, 100.0),
            (600.0, 129.043),
            (700.0, 198.261),
            (780.0, 241.675),
        ] {
            let off = (Illuminant::A.power(nm) - power).abs();
            assert!(off < 5e-6 * power, "{nm}");
        }
    }

    #[test]
    fn tables_are_linear_between_their_rows() {
        assert_eq!(Illuminant::D65.power(560.0), 100.0);
        let middle = 0.5 * (Illuminant::D65.power(380.0) + Illuminant::D65.power(385.0));
        assert!((Illuminant::D65.power(382.5) - middle).abs() < 1e-12);
        let lamp = Illuminant::parse("a/b\\lamp.csv", "nm;W\n300;0\n500;2\n800;0.5\n").unwrap();
        let powers = [400.0, 650.0, 900.0].map(|nm| lamp.power(nm));
        assert_eq!((lamp.name(), powers), ("lamp.csv", [1.0, 1.25, 0.0]));
    }

    #[track_caller]
    fn check(text: &str, line: usize, says: &str) {
        let fault = Illuminant::parse("lamp.csv", text).expect_err("a fault");
        assert!(fault.to_string().contains(says), "{fault}");
        assert_eq!(fault.line, line, "{fault}");
    }

    #[test]
    fn a_light_must_cover_what_is_summed_and_shine() {
        let must = "must cover 380 to 780 nm";
        check("# lamp\n400,1\n800,1\n", 2, "holds 400 to 800 nm");
        check("400,1\n800,1\n", 1, must);
        check("300,1\n779.9,1\n", 2, must);
        check("500,1", 1, "holds 500 to 500 nm");
        check("380,0\n780,0\n", 1, "no light");
        check("300,5\n379,0\n781,1e-300\n900,5", 1, "no light");
        check("380,1\n780,-1\n", 2, "lamp.csv:2:5: power is -1");
    }
}
