//! The cosines at which reflectance functions fail first: the ends of the domain, their neighbours, and values beyond.

use core::cell::RefCell;

use serde::Serialize;

use crate::lab::stability::Failure;

/// A cosine that occurs in rendering, if only by rounding.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// Its name in reports.
    pub name: &'static str,
    /// Its bits as f32.
    bits: u32,
    /// Whether a result that is not a reflectance is a finding. Outside the domain failures are reported but not counted.
    counts: bool,
}

const fn edge(name: &'static str, bits: u32, counts: bool) -> Edge {
    Edge { name, bits, counts }
}

/// All edges.
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

/// Why a result is not a reflectance. None where it is one.
fn fault(rgb: [f32; 3], largest: [f32; 3]) -> Option<&'static str> {
    Failure::of_result(rgb, largest, ROUNDING)?.predicate()
}

/// Three numbers for people. The sign of a zero is shown.
pub fn shown([r, g, b]: [f32; 3]) -> String {
    if r.to_bits() == g.to_bits() && g.to_bits() == b.to_bits() {
        format!("{r:?}")
    } else {
        format!("({r:?}, {g:?}, {b:?})")
    }
}

/// The result at an edge.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct EdgeRow {
    /// The cosine, in words.
    pub cos_theta: &'static str,
    /// The result in each channel. None where it is not finite.
    pub result: [Option<f64>; 3],
    /// Whether a fault there is a finding.
    pub counts: bool,
    /// The fault, if any.
    pub fault: Option<&'static str>,
}

/// The results at the edges.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    /// A row for each edge.
    pub rows: Vec<EdgeRow>,
    /// The faults within the domain.
    pub findings: Vec<String>,
    /// The faults beyond the domain.
    pub remarks: Vec<String>,
}

/// The cosines of all edges.
pub fn cosines() -> Vec<f32> {
    EDGES.iter().map(|edge| f32::from_bits(edge.bits)).collect()
}

/// Judges the results at all edges.
pub fn judged(results: &[[f32; 3]], largest: [f32; 3]) -> Edges {
    let mut edges = Edges::default();
    for (edge, rgb) in EDGES.iter().zip(results) {
        let fault = fault(*rgb, largest);
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

/// The first result between the edges that is not a reflectance, in words, and how many there are.
#[derive(Debug)]
pub struct FaultBetweenEdges {
    largest: [f32; 3],
    found: RefCell<Option<(String, usize)>>,
}

impl FaultBetweenEdges {
    /// A search that has seen no results yet.
    pub fn new(largest: [f32; 3]) -> FaultBetweenEdges {
        FaultBetweenEdges {
            largest,
            found: RefCell::new(None),
        }
    }

    /// Checks results. The ends are skipped, since they are edges.
    pub fn look(&self, cosines: &[f32], results: &[[f32; 3]]) {
        let mut found = self.found.borrow_mut();
        for (cosine, rgb) in cosines.iter().zip(results) {
            let is_end = *cosine == 0.0 || *cosine == 1.0;
            if let Some(fault) = fault(*rgb, self.largest).filter(|_| !is_end) {
                let first = || format!("at cos_theta = {cosine:?} it {fault}: {}", shown(*rgb));
                let (_, count) = found.get_or_insert_with(|| (first(), 0));
                *count += 1;
            }
        }
    }

    /// The finding, in words.
    pub fn finding(self) -> Option<String> {
        let (first, count) = self.found.into_inner()?;
        Some(format!("{first}; so at {count} cosines between the ends"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_reflectance_is_a_fault() {
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
