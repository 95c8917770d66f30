//! A survey of pages of refractiveindex.info: what each page holds and its colour, or why it cannot be used.

use super::material_params::ior_in;
use crate::physics::materials::{
    DispersionCurve, Extrapolate, Material, Page, Surface, ViewingConditions,
};
use crate::physics::optics::{COS_82, cosine};

/// Angles at which each surface is computed: every degree from 0 to 90.
pub const SURVEYED_ANGLES: usize = 91;

/// A page and its outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyedPage {
    /// The page's file.
    pub file: String,
    /// The result of reading it.
    pub outcome: PageOutcome,
}

/// The result of reading a page.
#[derive(Clone, Debug, PartialEq)]
pub enum PageOutcome {
    /// n and k are known over the whole visible spectrum: its colours.
    Seen(PageFacts, VisibleColours),
    /// n and k are known, but not everywhere in the visible spectrum.
    Elsewhere(PageFacts, String),
    /// It cannot be used, for this reason.
    Refused(String),
}

/// Facts known of every usable page.
#[derive(Clone, Debug, PartialEq)]
pub struct PageFacts {
    /// Class of the material.
    pub class: &'static str,
    /// The range in which both n and k are known, in nanometres.
    pub range_nm: (f64, f64),
    /// The number of the formula that gives n; 0 for a table.
    pub formula: u8,
    /// The maker's index at the d line, and ours minus it, if the page gives one.
    pub nd: Option<(f64, f64)>,
}

/// Unclipped colours of a surface in air.
#[derive(Clone, Debug, PartialEq)]
pub struct VisibleColours {
    /// What was extrapolated, in words; none if nothing was.
    pub held: Option<String>,
    /// The colour at each whole degree from 0 to 90.
    pub by_degree: Vec<[f64; 3]>,
    /// The colour at 81.79 degrees.
    pub f82: [f64; 3],
}

/// Reads a page and computes its colours.
pub fn survey_page(file: &str, text: &str, viewing: &ViewingConditions) -> SurveyedPage {
    let outcome = page_outcome(file, text, viewing).unwrap_or_else(PageOutcome::Refused);
    SurveyedPage {
        file: file.to_owned(),
        outcome,
    }
}

fn page_outcome(
    file: &str,
    text: &str,
    viewing: &ViewingConditions,
) -> Result<PageOutcome, String> {
    let page = Page::parse(file, text);
    let page = page.map_err(|fault| format!("line {}: {}", fault.line, fault.what))?;
    let material = page.material(None).map_err(|fault| fault.what)?;
    let about = page_facts(&page, &material)?;
    Ok(match Surface::new(&material, None, viewing) {
        Ok(surface) => PageOutcome::Seen(about, colours(&surface)),
        Err(unseen) => PageOutcome::Elsewhere(about, unseen.why),
    })
}

/// The facts of a material. Refused where it has no index in the middle of its own range.
fn page_facts(page: &Page, material: &Material) -> Result<PageFacts, String> {
    let (from, to) = material.range_nm();
    material.index(0.5 * (from + to), Extrapolate::Refuse)?;
    let ours_minus = |printed| Some((printed, ior_in(material, None)? - printed));
    Ok(PageFacts {
        class: material.kind.name(),
        range_nm: (from, to),
        formula: match &material.n {
            DispersionCurve::Formula(formula) => formula.number,
            DispersionCurve::Table(_) => 0,
        },
        nd: page.nd.and_then(ours_minus),
    })
}

fn colours(surface: &Surface) -> VisibleColours {
    VisibleColours {
        held: surface.extrapolation(),
        by_degree: (0..SURVEYED_ANGLES)
            .map(|degree| surface.unpolarised(cosine(degree as f64)).to_array())
            .collect(),
        f82: surface.unpolarised(COS_82).to_array(),
    }
}

impl SurveyedPage {
    /// The facts of the page, if it can be used.
    pub fn facts(&self) -> Option<&PageFacts> {
        match &self.outcome {
            PageOutcome::Seen(about, _) | PageOutcome::Elsewhere(about, _) => Some(about),
            PageOutcome::Refused(_) => None,
        }
    }
}
