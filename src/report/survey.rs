//! A survey of pages of refractiveindex.info: what each is, its colour, or why it cannot be used.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::fit::ior_d;
use crate::materials::{Curve, Extrapolate, Material, Page, Sight, Surface};
use crate::optics::{COS_82, cosine};

/// Angles at which each surface is seen: every degree from 0 to 90.
pub const ANGLES: usize = 91;

/// A page and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Surveyed {
    /// The page's file.
    pub file: String,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// n and k are known over the whole visible spectrum: its colours.
    Seen(About, Colours),
    /// n and k are known, but not everywhere in the visible spectrum.
    Elsewhere(About, String),
    /// It cannot be used, and why.
    Refused(String),
}

/// What is known of every page that can be used.
#[derive(Clone, Debug, PartialEq)]
pub struct About {
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
pub struct Colours {
    /// What was extrapolated, in words, where anything was.
    pub held: Option<String>,
    /// At each whole degree from 0 to 90.
    pub by_degree: Vec<[f64; 3]>,
    /// At 81.79 degrees.
    pub f82: [f64; 3],
}

/// Reads a page and looks at it.
pub fn survey(file: &str, text: &str, sight: &Sight) -> Surveyed {
    let outcome = outcome(file, text, sight).unwrap_or_else(Outcome::Refused);
    Surveyed {
        file: file.to_owned(),
        outcome,
    }
}

fn outcome(file: &str, text: &str, sight: &Sight) -> Result<Outcome, String> {
    let page =
        Page::parse(file, text).map_err(|fault| format!("line {}: {}", fault.line, fault.what))?;
    let material = page.material(None).map_err(|fault| fault.what)?;
    let about = about(&page, &material)?;
    Ok(match Surface::new(&material, None, sight) {
        Ok(surface) => Outcome::Seen(about, colours(&surface)),
        Err(unseen) => Outcome::Elsewhere(about, unseen.why),
    })
}

/// What is known of a material; refused where it has no index in the middle of its own range.
fn about(page: &Page, material: &Material) -> Result<About, String> {
    let (from, to) = material.range_nm();
    material.index(0.5 * (from + to), Extrapolate::Refuse)?;
    let nd = page
        .nd
        .and_then(|printed| Some((printed, ior_d(material)? - printed)));
    Ok(About {
        class: material.kind.name(),
        range_nm: (from, to),
        formula: match &material.n {
            Curve::Formula(formula) => formula.number,
            Curve::Table(_) => 0,
        },
        nd,
    })
}

fn colours(surface: &Surface) -> Colours {
    Colours {
        held: surface.held(),
        by_degree: (0..ANGLES)
            .map(|degree| surface.unpolarised(cosine(degree as f64)).to_array())
            .collect(),
        f82: surface.unpolarised(COS_82).to_array(),
    }
}

impl Surveyed {
    /// The row of a report.
    pub fn json(&self) -> Value {
        let mut row = json!({ "page": self.file });
        let (status, about) = match &self.outcome {
            Outcome::Seen(about, colours) => {
                row["f0"] = json!(colours.by_degree[0]);
                row["f82"] = json!(colours.f82);
                row["by_degree"] = json!(colours.by_degree);
                row["extrapolated"] = json!(colours.held);
                ("seen", Some(about))
            }
            Outcome::Elsewhere(about, why) => {
                row["reason"] = json!(why);
                ("elsewhere", Some(about))
            }
            Outcome::Refused(why) => {
                row["reason"] = json!(why);
                ("refused", None)
            }
        };
        row["status"] = json!(status);
        if let Some(about) = about {
            row["class"] = json!(about.class);
            (row["from_nm"], row["to_nm"]) = (json!(about.range_nm.0), json!(about.range_nm.1));
            row["formula"] = json!(about.formula);
            row["nd"] = json!(about.nd.map(|(printed, _)| printed));
            row["nd_difference"] = json!(about.nd.map(|(_, difference)| difference));
        }
        row
    }

    fn about(&self) -> Option<&About> {
        match &self.outcome {
            Outcome::Seen(about, _) | Outcome::Elsewhere(about, _) => Some(about),
            Outcome::Refused(_) => None,
        }
    }
}

/// The survey in words: counts, what was refused and why, how far glasses are from their makers' indices.
pub fn text(all: &[Surveyed]) -> String {
    let count = |wanted: fn(&Outcome) -> bool| all.iter().filter(|s| wanted(&s.outcome)).count();
    let seen = count(|outcome| matches!(outcome, Outcome::Seen(..)));
    let elsewhere = count(|outcome| matches!(outcome, Outcome::Elsewhere(..)));
    let mut lines = vec![format!(
        "{} pages: {seen} seen over the whole visible spectrum at {ANGLES} angles, {elsewhere} known elsewhere, {} refused",
        all.len(),
        all.len() - seen - elsewhere
    )];
    lines.extend(extrapolated(all));
    lines.extend(refusals(all));
    lines.extend(glasses(all));
    lines.join("\n") + "\n"
}

/// How many colours rest on held ends.
fn extrapolated(all: &[Surveyed]) -> Option<String> {
    let is_held =
        |s: &&Surveyed| matches!(&s.outcome, Outcome::Seen(_, colours) if colours.held.is_some());
    let count = all.iter().filter(is_held).count();
    (count > 0).then(|| {
        format!(
            "of these {count} are extrapolated: beyond the measured range the last index is held"
        )
    })
}

/// Reasons with the number of pages, and the page where it is one alone.
fn refusals(all: &[Surveyed]) -> Vec<String> {
    let mut reasons: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for surveyed in all {
        if let Outcome::Refused(why) = &surveyed.outcome {
            let why = why
                .split_once(": ")
                .filter(|(line, _)| line.starts_with("line "))
                .map_or(why.as_str(), |(_, why)| why);
            reasons.entry(why).or_default().push(&surveyed.file);
        }
    }
    let line = |(why, pages): (&str, Vec<&str>)| match pages.as_slice() {
        [one] => format!("refused: {one}: {why}"),
        many => format!("refused: {} pages: {why}", many.len()),
    };
    reasons.into_iter().map(line).collect()
}

/// How far each formula is from the indices that glass makers print.
fn glasses(all: &[Surveyed]) -> Vec<String> {
    let mut formulas: BTreeMap<u8, (usize, f64)> = BTreeMap::new();
    for about in all.iter().filter_map(Surveyed::about) {
        if let Some((_, difference)) = about.nd {
            let (count, most) = formulas.entry(about.formula).or_default();
            *count += 1;
            *most = most.max(difference.abs());
        }
    }
    let name = |formula: u8| match formula {
        0 => "tables".to_owned(),
        number => format!("formula {number}"),
    };
    let line = |(formula, (count, most)): (u8, (usize, f64))| {
        format!(
            "index at the d line, {}: {count} pages within {most:.1e} of what the maker prints",
            name(formula)
        )
    };
    formulas.into_iter().map(line).collect()
}
