//! Table 8: the error of three wavelengths in place of a spectrum, and the third error, of colours in three channels.
//!
//! Errors of three channels are combined in two ways: their mean, as in the thesis, and weighted by luminance, which its last
//! section leaves open.
//!
//! Source of the weights: ITU-R BT.709-6, 2015, <https://www.itu.int/rec/R-REC-BT.709>, from the chromaticities of sRGB. The
//! thesis's three wavelengths are not primaries, but its programs show them as if they were.

use super::comparison::{self, ComparisonRow, Figure, ThesisSection};
use super::specialised;
use crate::generator::fit;
use crate::physics::materials::{Material, Surface, THESIS_NM, ViewingConditions};
use crate::physics::num::each_channel;
use crate::physics::spectra::{Gamut, Illuminant, Integration, Space, Step};

const TABLE: &str = "table8_three_wavelength_colour_error_percent";
/// The thesis's metals, and the pages that it most probably used: for gold and platinum those of Table 1, for aluminium and
/// silver the same model as platinum's.
const METALS: [(&str, &str); 4] = [
    ("aluminium", "aluminium_rakic"),
    ("silver", "silver_rakic"),
    ("platinum", "platinum"),
    ("gold", "gold_hagemann_2"),
];
/// More metals for the colour error, such as warm brass and grey chromium.
const ALSO: [&str; 4] = ["copper", "brass", "silver", "chromium"];

/// The largest difference that is not a finding, in percentage points, since the definition and the pages are inferred.
const INFERRED: f64 = 0.15;

const DEFINITION: &str = "The thesis calls it the relative colour error at 0 degrees and defines it no further. Of all \
    definitions tried this one comes nearest: the largest absolute difference of a channel, linear sRGB under D65, \
    unclipped and not adapted. Which pages it took is inferred for aluminium and silver. Gold errs most because its red \
    lies outside sRGB, where no single wavelength can follow";
const COLOUR: &str = "Not an error of Table 8 and not to be added to it: three channels integrated under D65, lit by another \
    light, against the whole spectrum under that light, in Delta E 2000. It is what no function of three channels can show";

/// Table 8, followed by the colour error.
pub fn section() -> ThesisSection {
    let colour = METALS.iter().map(|(_, page)| *page).chain(ALSO);
    ThesisSection {
        title: "Table 8: three wavelengths in place of the spectrum".to_owned(),
        rows: METALS
            .into_iter()
            .map(page_row)
            .chain(colour.flat_map(colour_errors))
            .collect(),
    }
}

fn page_row((metal, page): (&'static str, &'static str)) -> ComparisonRow {
    let printed = comparison::number(&[TABLE, metal]);
    let ours = 100.0 * three_against_all(&specialised::material(page));
    let row = ComparisonRow::new("table8", metal, page)
        .percents(printed, ours)
        .remark(DEFINITION);
    if (printed - ours).abs() < INFERRED {
        row.explained()
    } else {
        row
    }
}

/// The largest absolute difference of a channel at normal incidence between three wavelengths and the whole spectrum.
fn three_against_all(material: &Material) -> f64 {
    let whole = seen(material, None);
    let unadapted = whole.unpolarised(1.0) * whole.integrator.mirror;
    let three = seen(material, Some(THESIS_NM)).unpolarised(1.0);
    (three - unadapted).abs().max_element()
}

/// The default integration with finer steps, on which a digit of Table 8 depends.
fn integration() -> Integration {
    Integration {
        step: Step::Nm1,
        ..Integration::default()
    }
}

fn seen(material: &Material, wavelengths_nm: Option<[f64; 3]>) -> Surface {
    let viewing = ViewingConditions {
        integration: integration(),
        gamut: Gamut::Keep,
        wavelengths_nm,
        ..ViewingConditions::default()
    };
    Surface::new(material, None, &viewing)
        .expect("the metals are known over the whole spectrum; a test sees them")
}

/// A row for each light after one bounce, and one for the first light after three bounces.
fn colour_errors(page: &'static str) -> Vec<ComparisonRow> {
    let surface = seen(&specialised::material(page), None);
    let errors = fit::colour_errors(&surface, &integration()).unwrap_or_default();
    let row = |column: String, error: f64| {
        ComparisonRow::new("table8", page, &column)
            .thesis(Figure::Missing("the thesis does not measure it"))
            .ours(Figure::Number(error, 2, ""))
            .remark(COLOUR)
    };
    let once = errors
        .iter()
        .map(|(light, error)| row(format!("colour error under {}", light.name()), error[0]));
    let thrice = errors.iter().filter(|(light, _)| *light == Illuminant::A);
    let thrice =
        thrice.map(|(light, error)| row(format!("under {}, 3 bounces", light.name()), error[2]));
    once.chain(thrice).collect()
}

/// The remark on the weighted figures.
const BY_LUMINANCE: &str = "the channels weighted by what they add to luminance in sRGB (.2126, .7152, .0722) and not by a third \
    each: the question with which the thesis ends";

/// The mean of three channels.
pub fn mean(errors: [f64; 3]) -> f64 {
    errors.iter().sum::<f64>() / 3.0
}

/// A row with the mean of three channels, weighted by luminance.
pub fn weighted(table: &'static str, row: &str, column: &str, errors: [f64; 3]) -> ComparisonRow {
    let weights = Space::Srgb.rgb_to_xyz().row(1).to_array();
    let mean = each_channel(|i| weights[i] * errors[i]).iter().sum();
    ComparisonRow::new(table, row, column)
        .thesis(Figure::Missing("the thesis leaves it open"))
        .ours(Figure::Number(mean, 3, " %"))
        .remark(BY_LUMINANCE)
}
