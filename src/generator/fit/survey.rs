//! A survey of pages of refractiveindex.info: what each is, its colour, or why it cannot be used.

use super::material_params::ior_in;
use crate::physics::materials::{
    DispersionCurve, Extrapolate, Material, Page, Surface, ViewingConditions,
};
use crate::physics::optics::{COS_82, cosine};

/// Angles at which each surface is seen: every degree from 0 to 90.
pub const SURVEYED_ANGLES: usize = 91;

/// A page and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyedPage {
    /// The page's file.
    pub file: String,
    /// What came of it.
    pub outcome: PageOutcome,
}

/// What came of a page.
#[derive(Clone, Debug, PartialEq)]
pub enum PageOutcome {
    /// n and k are known over the whole visible spectrum: its colours.
    Seen(PageFacts, VisibleColours),
    /// n and k are known, but not everywhere in the visible spectrum.
    Elsewhere(PageFacts, String),
    /// It cannot be used, and why.
    Refused(String),
}

/// What is known of every page that can be used.
#[derive(Clone, Debug, PartialEq)]
pub struct PageFacts {
    /// Class of the material.
    pub class: &'static str,
    /// The range of n and k together, in nanometres.
    pub range_nm: (f64, f64),
    /// The number of the formula that gives n; 0 for a table.
    pub formula: u8,
    /// The maker's index at the d line, and ours less it, where the page has one.
    pub nd: Option<(f64, f64)>,
}

/// Unclipped colours of a surface in air.
#[derive(Clone, Debug, PartialEq)]
pub struct VisibleColours {
    /// What was extrapolated, in words, where anything was.
    pub held: Option<String>,
    /// At each whole degree from 0 to 90.
    pub by_degree: Vec<[f64; 3]>,
    /// At 81.79 degrees.
    pub f82: [f64; 3],
}

/// Reads a page and looks at it.
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
    let page =
        Page::parse(file, text).map_err(|fault| format!("line {}: {}", fault.line, fault.what))?;
    let material = page.material(None).map_err(|fault| fault.what)?;
    let about = page_facts(&page, &material)?;
    Ok(match Surface::new(&material, None, viewing) {
        Ok(surface) => PageOutcome::Seen(about, colours(&surface)),
        Err(unseen) => PageOutcome::Elsewhere(about, unseen.why),
    })
}

/// What is known of a material; refused where it has no index in the middle of its own range.
fn page_facts(page: &Page, material: &Material) -> Result<PageFacts, String> {
    let (from, to) = material.range_nm();
    material.index(0.5 * (from + to), Extrapolate::Refuse)?;
    let nd = page
        .nd
        .and_then(|printed| Some((printed, ior_in(material, None)? - printed)));
    Ok(PageFacts {
        class: material.kind.name(),
        range_nm: (from, to),
        formula: match &material.n {
            DispersionCurve::Formula(formula) => formula.number,
            DispersionCurve::Table(_) => 0,
        },
        nd,
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
    /// What is known of it, where it can be used.
    pub fn facts(&self) -> Option<&PageFacts> {
        match &self.outcome {
            PageOutcome::Seen(about, _) | PageOutcome::Elsewhere(about, _) => Some(about),
            PageOutcome::Refused(_) => None,
        }
    }
}
