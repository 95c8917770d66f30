//! The scan: a method at all points of its spaces, in one precision, compared with its value in f64 and with the law.

use super::failure::{Failure, NEAR, ResultPoint, is_flushed};
use super::region::{FailureGrid, Region};
use super::space::{ScanAxis, ScanPoint, ScanSpace, dense, is_lawful, law, spaces};
use crate::lab::verify::limits;
use crate::language::ir::{Checked, Value, evaluate};
use crate::language::methods::Method;
use crate::physics::num::{Half, Num, Precision, in_parallel};

/// A failure of a method, and where it happens.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The kind of failure.
    pub failure: Failure,
    /// Whether it was found for media. Otherwise it is for arguments that no medium has.
    pub is_media: bool,
    /// The region, in inequalities.
    pub region: String,
    /// The share of the region's points that fail.
    pub share: f64,
    /// The worst point: names and values.
    pub worst: Vec<(&'static str, f64)>,
    /// The result, the formula and the law at that point.
    pub point: Option<ResultPoint>,
    /// The amount of the failure at that point.
    pub amount: f64,
}

/// What f64 has above 1, or below 0, by more than this is so without any rounding.
const BEYOND: f64 = 1e-6;

impl Finding {
    /// Whether it is the formula's fault, and not that of its rounding.
    pub fn is_of_formula(&self) -> bool {
        match (self.failure, &self.point) {
            (Failure::Negative, Some(point)) => point.want < -BEYOND,
            (Failure::AboveOne, Some(point)) => point.want > point.limit + BEYOND,
            (failure, _) => failure.is_of_the_model(),
        }
    }
}

/// The results of a function of scalars at these cosines, in a kind of number.
fn in_numbers<N: Num>(
    function: &Checked,
    channel: usize,
    arguments: &[f64],
    cosines: &[f64],
) -> Vec<f64> {
    let count = cosines.len();
    let cosines = cosines.iter().map(|c| N::from_f64(*c)).collect();
    let given = arguments.iter().map(|x| Value::scalar(*x));
    let all: Vec<Value<N>> = std::iter::once(Value::each(cosines)).chain(given).collect();
    let result = evaluate(function, &all);
    let column = result.channel(channel);
    (0..count).map(|i| column.at(i).to_f64()).collect()
}

/// The spacing of numbers of a precision, in units of that of f32.
fn spacing(precision: Precision) -> f64 {
    match precision {
        Precision::F32 => 1.0,
        Precision::F16 => 8192.0,
    }
}

/// Called with how many points are done, of how many.
pub type ScanProgress<'a> = &'a mut dyn FnMut(usize, usize);

/// Scans a method.
pub fn scan(method: &'static Method, precision: Precision, progress: ScanProgress) -> Vec<Finding> {
    let code = ScannedFunction::library(method, precision);
    let spaces = spaces(method, precision);
    let total: usize = spaces.iter().map(ScanSpace::count).sum();
    let mut before = 0;
    let mut findings = Vec::new();
    for space in &spaces {
        let scan = Scan {
            code: &code,
            channel: 0,
            space,
            point: &|index| space.point(method, index, precision),
            law: &|point, c| {
                let medium = point.medium.filter(|medium| is_lawful(method, *medium))?;
                Some(law(method, medium, c))
            },
        };
        findings.extend(scan.findings(&mut |done| progress(before + done, total)));
        before += space.count();
    }
    findings
}

/// A function, and what it means.
#[derive(Clone, Debug)]
pub struct ScannedFunction {
    /// The function as its text computes it.
    pub function: Checked,
    /// What it means. In half precision some formulas are written differently.
    pub meaning: Checked,
    /// The precision that it computes in.
    pub precision: Precision,
}

impl ScannedFunction {
    /// A method's library function of scalars.
    pub(super) fn library(method: &Method, precision: Precision) -> ScannedFunction {
        let built = |precision| {
            let function = method.function_in(precision, true);
            function.expect("every method's function is well formed; a test builds all")
        };
        ScannedFunction {
            function: built(precision),
            meaning: built(Precision::F32),
            precision,
        }
    }
}

/// Scans one channel of a function of the cosine alone, compared with the law.
pub fn scan_specialised(
    code: &ScannedFunction,
    channel: usize,
    law: &(dyn Fn(f64) -> f64 + Sync),
) -> Vec<Finding> {
    let space = ScanSpace {
        is_media: true,
        axes: Vec::new(),
        cosines: dense().rounded(code.precision),
    };
    let point = ScanPoint {
        arguments: Vec::new(),
        medium: None,
        limit: 1.0,
    };
    let scan = Scan {
        code,
        channel,
        space: &space,
        point: &|_| point.clone(),
        law: &|_, c| Some(law(c)),
    };
    scan.findings(&mut |_| {})
}

pub(super) struct Scan<'a> {
    pub code: &'a ScannedFunction,
    pub channel: usize,
    pub space: &'a ScanSpace,
    pub point: &'a (dyn Fn(usize) -> ScanPoint + Sync),
    pub law: &'a (dyn Fn(&ScanPoint, f64) -> Option<f64> + Sync),
}

/// The amounts of failure of a point of a space: at each cosine, and as a whole curve with its worst cosine.
struct CurveAmounts {
    at: Vec<Amounts>,
    of_curve: Amounts,
    worst: f64,
}

/// The amount of each failure, in the order of [`Failure::ALL`].
type Amounts = [f32; Failure::ALL.len()];

impl Scan<'_> {
    fn findings(&self, done: &mut dyn FnMut(usize)) -> Vec<Finding> {
        let rows = self.amounts_of_curves(done);
        let mut with_cosine = self.space.axes.clone();
        with_cosine.push(self.space.cosines.clone());
        let mut findings = Vec::new();
        for (kind, failure) in Failure::ALL.into_iter().enumerate() {
            // One curve alone says at which angles it errs.
            let by_angle = self.space.axes.is_empty() && matches!(failure, Failure::Error(_));
            let of_curve = failure.is_of_the_model() && !by_angle;
            let (axes, amounts): (&[ScanAxis], Vec<f32>) = if of_curve {
                (
                    &self.space.axes,
                    rows.iter().map(|row| row.of_curve[kind]).collect(),
                )
            } else {
                let at =
                    |row: &CurveAmounts| row.at.iter().map(|at| at[kind]).collect::<Vec<f32>>();
                (&with_cosine, rows.iter().flat_map(at).collect())
            };
            let regions = FailureGrid { axes, amounts }.regions();
            let finding = |region| self.finding(failure, axes, region, &rows);
            findings.extend(regions.iter().map(finding));
        }
        without_repetitions(findings)
    }

    fn finding(
        &self,
        failure: Failure,
        axes: &[ScanAxis],
        region: &Region,
        rows: &[CurveAmounts],
    ) -> Finding {
        let (given, cosine) = region.worst.split_at(self.space.axes.len());
        let sizes = self.space.axes.iter().map(|axis| axis.values.len());
        let index = given
            .iter()
            .zip(sizes)
            .fold(0, |index, (place, size)| index * size + place);
        let cosine = match (cosine.first(), failure) {
            (Some(place), _) => Some(self.space.cosines.values[*place]),
            (None, Failure::Error(_)) => Some(rows[index].worst),
            _ => None,
        };
        let values = self.space.at(index);
        let names = self.space.axes.iter().map(|axis| axis.name);
        Finding {
            failure,
            is_media: self.space.is_media,
            region: region.inequalities(axes),
            share: region.share(),
            worst: names
                .zip(values)
                .chain(cosine.map(|c| ("cos_theta", c)))
                .collect(),
            point: cosine.map(|c| self.points(&(self.point)(index), &[c])[0]),
            amount: f64::from(region.amount),
        }
    }

    /// The amounts of all points of the space, computed on all cores.
    fn amounts_of_curves(&self, done: &mut dyn FnMut(usize)) -> Vec<CurveAmounts> {
        let row = |index| self.amounts_of_curve(index);
        in_parallel(self.space.count(), &row, &mut |count, _| {
            done(count as usize)
        })
    }

    /// The results of a point of the space at all cosines.
    pub fn curve(&self, index: usize) -> Vec<ResultPoint> {
        self.points(&(self.point)(index), &self.space.cosines.values)
    }

    fn amounts_of_curve(&self, index: usize) -> CurveAmounts {
        let cosines = &self.space.cosines.values;
        let place = (self.point)(index);
        let points = self.points(&place, cosines);
        let amounts =
            |point: &ResultPoint| Failure::ALL.map(|failure| point.amount(failure) as f32);
        let between = self.at_limits(&place);
        let all = points.iter().chain(&between);
        let worst = all.reduce(|a, b| if b.error() > a.error() { b } else { a });
        let worst = worst.expect("a curve has points");
        CurveAmounts {
            at: points.iter().map(amounts).collect(),
            of_curve: curve_amounts(cosines, &points, worst),
            worst: worst.cos_theta,
        }
    }

    /// Results at the critical angle, at Brewster's angle and next to them. Far from an index of 1 the curve changes only there,
    /// and the axis of cosines has no value there.
    fn at_limits(&self, place: &ScanPoint) -> Vec<ResultPoint> {
        let Some((n, _)) = place.medium else {
            return Vec::new();
        };
        let near = |cosine: f32| {
            let beside = [-8, 0, 8].map(|steps| stepped(self.code.precision, cosine.into(), steps));
            beside.into_iter().filter(|c| (0.0..=1.0).contains(c))
        };
        let cosines: Vec<f64> = limits(n).into_iter().flat_map(near).collect();
        self.points(place, &cosines)
    }

    fn points(&self, place: &ScanPoint, cosines: &[f64]) -> Vec<ResultPoint> {
        let (code, arguments) = (self.code, &place.arguments);
        let beside = |steps: i32| -> Vec<f64> {
            let step = |c: &f64| stepped(code.precision, *c, steps);
            cosines.iter().map(step).collect()
        };
        let run = |at: &[f64]| match code.precision {
            Precision::F32 => in_numbers::<f32>(&code.function, self.channel, arguments, at),
            Precision::F16 => in_numbers::<Half>(&code.function, self.channel, arguments, at),
        };
        let mean = |at: &[f64]| in_numbers::<f64>(&code.meaning, self.channel, arguments, at);
        let (got, next) = (run(cosines), run(&beside(1)));
        let (below, want, above) = (mean(&beside(-NEAR)), mean(cosines), mean(&beside(NEAR)));
        let law = |c: f64| {
            let is_inside = (0.0..=1.0).contains(&c) && !is_flushed(c);
            is_inside.then(|| (self.law)(place, c)).flatten()
        };
        let point = |i: usize| ResultPoint {
            cos_theta: cosines[i],
            got: got[i],
            next: next[i],
            want: want[i],
            around: (
                below[i].min(want[i]).min(above[i]),
                below[i].max(want[i]).max(above[i]),
            ),
            law: law(cosines[i]),
            limit: place.limit,
            spacing: spacing(code.precision),
        };
        (0..cosines.len()).map(point).collect()
    }
}

/// The number about so many ulp further from 0 than this one: the relative step is fixed, so it may be half as many.
fn stepped(precision: Precision, x: f64, steps: i32) -> f64 {
    let place = f64::from(f32::EPSILON) * spacing(precision);
    precision.rounded(x * (1.0 + f64::from(steps) * place))
}

/// The findings without those that a graver level of the same failure reports for the same region.
fn without_repetitions(findings: Vec<Finding>) -> Vec<Finding> {
    let mut kept: Vec<Finding> = Vec::new();
    for finding in findings {
        let same = |other: &Finding| {
            std::mem::discriminant(&other.failure) == std::mem::discriminant(&finding.failure)
                && other.region == finding.region
        };
        if !kept.iter().any(same) {
            kept.push(finding);
        }
    }
    kept
}

/// The smallest rise or fall of method and law that counts as wrong monotony.
const SEEN: f64 = 0.002;
/// The least depth of the law's minimum that counts.
const DEPTH: f64 = 0.005;

/// The amount of each failure of a whole curve.
fn curve_amounts(cosines: &[f64], points: &[ResultPoint], worst: &ResultPoint) -> Amounts {
    let inside = (0..cosines.len()).filter(|i| (0.0..=1.0).contains(&cosines[*i]));
    let curve: Vec<(f64, f64)> = inside
        .filter_map(|i| Some((points[i].want, points[i].law?)))
        .collect();
    let amount = |failure: Failure| match failure {
        Failure::Monotony => against(&curve),
        Failure::Minimum => missed(&curve),
        Failure::Error(_) => worst.amount(failure),
        _ => 0.0,
    };
    Failure::ALL.map(|failure| amount(failure) as f32)
}

/// How far a curve runs against the law, between two turning points of either.
fn against(curve: &[(f64, f64)]) -> f64 {
    let mut worst = 0.0f64;
    let (mut mine, mut laws) = (0.0f64, 0.0f64);
    for pair in curve.windows(2) {
        let (step, law) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        if step * law < 0.0 {
            (mine, laws) = (mine + step.abs(), laws + law.abs());
            if mine > SEEN && laws > SEEN {
                worst = worst.max(mine);
            }
        } else {
            (mine, laws) = (0.0, 0.0);
        }
    }
    worst
}

/// The depth of the law's minimum below its value at 0 degrees, if the curve's own depth is less than a tenth of it. 0 otherwise.
fn missed(curve: &[(f64, f64)]) -> f64 {
    let Some(last) = curve.last() else { return 0.0 };
    let least = |of: fn(&(f64, f64)) -> f64| curve.iter().map(of).fold(f64::INFINITY, f64::min);
    let depth = last.1 - least(|point| point.1);
    let own = last.0 - least(|point| point.0);
    if depth > DEPTH && own < 0.1 * depth {
        depth
    } else {
        0.0
    }
}
