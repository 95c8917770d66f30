//! Where functions of reflectance fail first: the ends of the domain, their neighbours, and what lies beyond.

use core::cell::RefCell;

use serde::Serialize;

use crate::lab::stability::Failure;

/// A cosine that occurs in rendering, if only by rounding.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// In reports.
    pub name: &'static str,
    /// Its bits.
    bits: u32,
    /// Whether a result that is no reflectance is a finding. Outside the domain, failures are reported but not counted.
    counts: bool,
}

const fn edge(name: &'static str, bits: u32, counts: bool) -> Edge {
    Edge { name, bits, counts }
}

/// All of them.
pub const EDGES: [Edge; 12] = [
    edge("0", 0, true),
    edge("-0", 0x8000_0000, true),
    edge("smallest denormal", 1, true),
    edge("smallest normal", 0x0080_0000, true),
    edge("1e-20", 0x1E3C_E508, true),
    edge("1e-4", 0x38D1_B717, true),
    edge("1 - 1 ulp", 0x3F7F_FFFF, true),
    edge("1", 0x3F80_0000, true),
    edge("1 + 1 ulp", 0x3F80_0001, true),
    edge("-1", 0xBF80_0000, false),
    edge("2", 0x4000_0000, false),
    edge("NaN", 0x7FC0_0000, false),
];

/// How far beyond [0, 1] rounding may bring a result.
const ROUNDING: f32 = 1e-6;

/// What is wrong with a result as a reflectance; nothing where it is one.
fn fault(rgb: [f32; 3], most: [f32; 3]) -> Option<&'static str> {
    Failure::of_result(rgb, most, ROUNDING)?.predicate()
}

/// Three numbers for people; a sign of zero is told.
pub fn shown([r, g, b]: [f32; 3]) -> String {
    if r.to_bits() == g.to_bits() && g.to_bits() == b.to_bits() {
        format!("{r:?}")
    } else {
        format!("({r:?}, {g:?}, {b:?})")
    }
}

/// What came at an edge.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct EdgeRow {
    /// The cosine, in words.
    pub cos_theta: &'static str,
    /// Each channel; none where it is not finite.
    pub result: [Option<f64>; 3],
    /// Whether a fault there is a finding.
    pub counts: bool,
    /// What is wrong.
    pub fault: Option<&'static str>,
}

/// The edges as they came out.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    /// A row each.
    pub rows: Vec<EdgeRow>,
    /// What is wrong.
    pub findings: Vec<String>,
    /// What lies beyond the domain, where it is no reflectance.
    pub remarks: Vec<String>,
}

/// The cosines of all edges.
pub fn cosines() -> Vec<f32> {
    EDGES.iter().map(|edge| f32::from_bits(edge.bits)).collect()
}

/// Looks at the results of all edges.
pub fn judged(results: &[[f32; 3]], most: [f32; 3]) -> Edges {
    let mut edges = Edges::default();
    for (edge, rgb) in EDGES.iter().zip(results) {
        let fault = fault(*rgb, most);
        let number = |value: f32| value.is_finite().then_some(f64::from(value));
        edges.rows.push(EdgeRow {
            cos_theta: edge.name,
            result: rgb.map(number),
            counts: edge.counts,
            fault,
        });
        if let Some(fault) = fault {
            let words = format!("at cos_theta = {} it {fault}: {}", edge.name, shown(*rgb));
            let list = if edge.counts {
                &mut edges.findings
            } else {
                &mut edges.remarks
            };
            list.push(words);
        }
    }
    edges
}

/// The first result between the edges that is no reflectance, and how many there are.
#[derive(Debug)]
pub struct FaultBetweenEdges {
    most: [f32; 3],
    first: RefCell<Option<FirstFault>>,
}

/// The first of its kind.
#[derive(Clone, Copy, Debug)]
struct FirstFault {
    cosine: f32,
    rgb: [f32; 3],
    fault: &'static str,
    count: usize,
}

impl FaultBetweenEdges {
    /// Nothing is seen yet.
    pub fn new(most: [f32; 3]) -> FaultBetweenEdges {
        FaultBetweenEdges {
            most,
            first: RefCell::new(None),
        }
    }

    /// Looks at results. The ends are edges, and told there.
    pub fn look(&self, cosines: &[f32], results: &[[f32; 3]]) {
        let mut first = self.first.borrow_mut();
        for (cosine, rgb) in cosines.iter().zip(results) {
            let is_end = *cosine == 0.0 || *cosine == 1.0;
            let Some(fault) = fault(*rgb, self.most).filter(|_| !is_end) else {
                continue;
            };
            let seen = first.get_or_insert(FirstFault {
                cosine: *cosine,
                rgb: *rgb,
                fault,
                count: 0,
            });
            seen.count += 1;
        }
    }

    /// What was seen, for people.
    pub fn finding(&self) -> Option<String> {
        let FirstFault {
            cosine,
            rgb,
            fault,
            count,
        } = (*self.first.borrow())?;
        let rgb = shown(rgb);
        Some(format!(
            "at cos_theta = {cosine:?} it {fault}: {rgb}; so at {count} cosines between the ends"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_reflectance_is_told() {
        let of = |value| fault([0.5, value, 0.5], [1.0; 3]);
        assert_eq!(of(0.0), None);
        assert_eq!(of(1.0 + 1e-7), None);
        assert_eq!(of(1.01), Some("is above 1"));
        assert_eq!(of(-0.01), Some("is below 0"));
        assert_eq!(of(f32::NAN), Some("is NaN"));
        assert_eq!(of(f32::INFINITY), Some("is infinite"));
        assert_eq!(fault([1.03, 0.5, 0.5], [1.03, 1.0, 1.0]), None);
    }

    #[test]
    fn edges_are_the_numbers_that_they_are_called() {
        for (edge, value) in EDGES.iter().zip(cosines()) {
            if let Ok(named) = edge.name.parse::<f32>() {
                assert!(
                    named.to_bits() == value.to_bits() || named.is_nan(),
                    "{}",
                    edge.name
                );
            }
        }
    }

    #[test]
    fn beyond_the_domain_nothing_is_a_finding() {
        let nan = [f32::NAN; 3];
        let edges = judged(&[nan; 12], [1.0; 3]);
        assert_eq!((edges.findings.len(), edges.remarks.len()), (9, 3));
    }
}
