//! The reflectance curves of figures 6 and 9 to 16: the exact law and its approximations, with the extrema of curves. Angles are in
//! degrees, as in the thesis.

use super::comparison::{ComparisonRow, Figure, ThesisSection};
use super::specialised;
use crate::generator::fit;
use crate::generator::reference::{Derivation, THESIS_MATCHING_COS};
use crate::language::methods::lambda;
use crate::physics::optics::{self, Reflectance};

pub use crate::physics::optics::cosine;

/// The number of drawn angles, one each quarter of a degree.
pub const POINTS: u32 = 361;

/// A figure of the thesis.
#[derive(Debug, PartialEq)]
pub struct FigurePlan {
    /// Its number in the thesis.
    pub number: u32,
    /// The name of its file.
    pub file: &'static str,
    /// The subject in the thesis's caption.
    pub subject: &'static str,
    /// n and k.
    index: [f64; 2],
    /// Methods, and their names in the legend.
    methods: &'static [(&'static str, &'static str)],
    /// Lowest reflectance on the axis, in per cent.
    pub low: f64,
    /// Marked angles, in degrees, and their labels.
    marks: &'static [(f64, &'static str)],
    /// Whether the minimum of the exact law is marked too.
    shows_minimum: bool,
    /// What a reader should know besides.
    pub note: &'static str,
}

/// A figure of the thesis, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct ThesisFigure {
    /// What it shows.
    pub plan: &'static FigurePlan,
    /// The exact law.
    pub exact: DrawnCurve,
    /// Its approximations.
    pub curves: Vec<DrawnCurve>,
    /// Marked angles, in degrees, and their labels.
    pub marks: Vec<(f64, String)>,
    /// The values derived from n and k, for methods that need more than these, in words.
    pub derived: String,
}

const SCHLICK: (&str, &str) = ("schlick_ior", "Schlick (eq. 7)");
const RESCALED: (&str, &str) = ("schlick_rescaled", "rescaled Schlick (eq. 14)");
const EXACT_ALONE: &str = "The thesis draws the exact law alone.";

/// A figure from 0 per cent on, without marks and notes.
const PLAIN: FigurePlan = FigurePlan {
    number: 0,
    file: "",
    subject: "",
    index: [1.0, 0.0],
    methods: &[],
    low: 0.0,
    marks: &[],
    shows_minimum: false,
    note: "",
};

/// The nine figures. n and k are those of the captions and of Table 1. Platinum's are those of 685 nm.
static PLANS: [FigurePlan; 9] = [
    FigurePlan {
        number: 6,
        file: "figure-06-water.svg",
        subject: "water, n = 1.33",
        index: [1.33, 0.0],
        methods: &[SCHLICK],
        note: EXACT_ALONE,
        ..PLAIN
    },
    FigurePlan {
        number: 9,
        file: "figure-09-gold-685nm.svg",
        subject: "gold at 685 nm, n = 0.23, k = 3.94",
        index: [0.23, 3.94],
        methods: &[RESCALED],
        low: 92.0,
        marks: &[(77.0, "77° in the text")],
        shows_minimum: true,
        note: EXACT_ALONE,
    },
    FigurePlan {
        number: 10,
        file: "figure-10-gold-475nm.svg",
        subject: "gold at 475 nm, n = 1.39, k = 1.72",
        index: [1.39, 1.72],
        methods: &[RESCALED],
        note: EXACT_ALONE,
        ..PLAIN
    },
    FigurePlan {
        number: 11,
        file: "figure-11-water-empirical.svg",
        subject: "water, n = 1.33",
        index: [1.33, 0.0],
        methods: &[("empirical", "NVIDIA's empirical term (eq. 6)")],
        marks: &[(60.0, "60°")],
        ..PLAIN
    },
    FigurePlan {
        number: 12,
        file: "figure-12-hydrogen.svg",
        subject: "hydrogen, n = 1.001",
        index: [1.001, 0.0],
        methods: &[SCHLICK],
        ..PLAIN
    },
    FigurePlan {
        number: 13,
        file: "figure-13-arsenic-trisulphide.svg",
        subject: "arsenic trisulphide, n = 2.04",
        index: [2.04, 0.0],
        methods: &[SCHLICK],
        ..PLAIN
    },
    FigurePlan {
        number: 14,
        file: "figure-14-germanium.svg",
        subject: "germanium, n = 4.01",
        index: [4.01, 0.0],
        methods: &[SCHLICK],
        ..PLAIN
    },
    FigurePlan {
        number: 15,
        file: "figure-15-platinum-schlick.svg",
        subject: "platinum at 685 nm, n = 2.49, k = 4.44",
        index: [2.49, 4.44],
        methods: &[
            ("schlick", "Schlick from F0 (eq. 13)"),
            ("schlick_ior", "Schlick from n alone (eq. 7)"),
        ],
        ..PLAIN
    },
    FigurePlan {
        number: 16,
        file: "figure-16-platinum-corrected.svg",
        subject: "platinum at 685 nm, n = 2.49, k = 4.44",
        index: [2.49, 4.44],
        methods: &[
            RESCALED,
            ("schlick_corrected", "corrected Schlick (eq. 15)"),
        ],
        low: 50.0,
        marks: &[(81.37, "81.37°: λ matched")],
        shows_minimum: true,
        ..PLAIN
    },
];

/// One curve of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCurve {
    /// Its name in the legend.
    pub name: &'static str,
    /// Points of angle in degrees and reflectance in per cent.
    pub points: Vec<(f64, f64)>,
}

/// The rows of the figures: what is drawn, in numbers.
pub fn section() -> ThesisSection {
    ThesisSection {
        title: format!("Figures: reflectance at {POINTS} angles, exact and approximate"),
        rows: figures().iter().flat_map(ThesisFigure::rows).collect(),
    }
}

/// The figures.
pub fn figures() -> Vec<ThesisFigure> {
    PLANS.iter().map(FigurePlan::figure).collect()
}

impl FigurePlan {
    fn exact(&self) -> DrawnCurve {
        let reflectance = |degrees| 100.0 * exact(self.index, degrees).unpolarised();
        DrawnCurve {
            name: "exact law",
            points: degrees().map(|at| (at, reflectance(at))).collect(),
        }
    }

    fn curves(&self) -> Vec<DrawnCurve> {
        let channels = specialised::grey(self.index);
        let curve = |(method, name): &(&str, &'static str)| {
            let function = specialised::function(method, &channels);
            let values = specialised::curve(&function, degrees().map(cosine).collect());
            let percent = values.into_iter().map(|value| 100.0 * value);
            DrawnCurve {
                name,
                points: degrees().zip(percent).collect(),
            }
        };
        self.methods.iter().map(curve).collect()
    }

    fn figure(&'static self) -> ThesisFigure {
        ThesisFigure {
            plan: self,
            exact: self.exact(),
            curves: self.curves(),
            marks: self.marks(),
            derived: self.derived(),
        }
    }

    /// The values derived from n and k, for methods that need more than these.
    fn derived(&self) -> String {
        let has = |name: &str| self.methods.iter().any(|(method, _)| *method == name);
        if has("empirical") {
            let method = specialised::method("empirical");
            let channels = specialised::grey(self.index);
            let values = fit::values(method, &channels, &Derivation::default());
            let [bias, scale, power] = ["bias", "scale", "power"].map(|name| values[name][0]);
            return format!(
                "Bias {bias:.4} is F0, scale {scale:.4} the rest, power {power:.3} meets the exact law at 60°."
            );
        }
        match lambda(self.index[0], self.index[1], THESIS_MATCHING_COS) {
            Some(lambda) if has("schlick_corrected") => {
                format!(
                    "λ = {lambda:.3} meets the exact law at 81.37°, with the factor cos θ that eq. 15 lost in print."
                )
            }
            _ => String::new(),
        }
    }

    fn marks(&self) -> Vec<(f64, String)> {
        let fixed = self.marks.iter();
        let fixed = fixed.map(|(at, label)| (*at, (*label).to_owned()));
        let (at, _) = lowest(|degrees| exact(self.index, degrees).unpolarised());
        let minimum = (at, format!("minimum {at:.2}°"));
        fixed.chain(self.shows_minimum.then_some(minimum)).collect()
    }
}

impl ThesisFigure {
    fn rows(&self) -> Vec<ComparisonRow> {
        let mut rows = Vec::new();
        for (curve, (method, _)) in self.curves.iter().zip(self.plan.methods) {
            let (at, apart) = curve.largest_difference(&self.exact);
            let name = format!("figure {}, {method}", self.plan.number);
            for (column, ours) in [
                ("largest difference", Figure::Number(apart / 100.0, 4, "")),
                ("its angle", Figure::Number(at, 2, "°")),
            ] {
                let mut row = ComparisonRow::new("figures", &name, column).ours(ours);
                row.file = Some(self.plan.file.to_owned());
                rows.push(row);
            }
        }
        rows
    }
}

fn degrees() -> impl Iterator<Item = f64> {
    (0..POINTS).map(|i| 90.0 * f64::from(i) / f64::from(POINTS - 1))
}

impl DrawnCurve {
    /// The angle at which it is furthest from the exact law, and the difference in percentage points.
    pub fn largest_difference(&self, exact: &DrawnCurve) -> (f64, f64) {
        let pairs = self.points.iter().zip(&exact.points);
        let differences = pairs.map(|((at, value), (_, exact))| (*at, (value - exact).abs()));
        differences.fold(
            (0.0, 0.0),
            |most, one| if one.1 > most.1 { one } else { most },
        )
    }
}

/// Steps per degree in the search for minima and largest differences. The thesis states angles to 0.01 degrees.
const STEPS: u32 = 100;

/// The exact law at an angle.
pub fn exact([n, k]: [f64; 2], degrees: f64) -> Reflectance<f64> {
    optics::conductor(n, k, cosine(degrees))
}

/// The minimum of a curve over 0 to 90 degrees: angle and value.
pub fn lowest(curve: impl Fn(f64) -> f64) -> (f64, f64) {
    let points = (0..=90 * STEPS).map(|i| f64::from(i) / f64::from(STEPS));
    points
        .map(|degrees| (degrees, curve(degrees)))
        .fold((0.0, f64::INFINITY), |best, point| {
            if point.1 < best.1 { point } else { best }
        })
}

/// The maximum of a curve over 0 to 90 degrees: angle and value.
pub fn highest(curve: impl Fn(f64) -> f64) -> (f64, f64) {
    let (degrees, value) = lowest(|degrees| -curve(degrees));
    (degrees, -value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brewsters_angle_is_found() {
        let (degrees, least) = lowest(|degrees| exact([1.5, 0.0], degrees).p);
        // atan 1.5 = 56.31 degrees.
        assert_eq!(degrees, 56.31);
        assert!(least < 1e-8);
        assert_eq!(highest(|degrees| exact([1.5, 0.0], degrees).s), (90.0, 1.0));
    }
}
