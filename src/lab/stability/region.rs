//! Regions: the parts of a grid at which something fails, as boxes of inequalities that a person can read.

use std::ops::Range;

use super::space::ScanAxis;

/// A grid of up to four axes, with the amount of failure at each point.
#[derive(Clone, Debug)]
pub struct FailureGrid<'a> {
    /// The axes. The last one varies fastest.
    pub axes: &'a [ScanAxis],
    /// The amounts. 0 where a point does not fail.
    pub amounts: Vec<f32>,
}

/// A box of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The range of indices on each axis.
    pub extent: Vec<Range<usize>>,
    /// The number of its points that fail.
    pub failing: usize,
    /// The number of its points.
    pub points: usize,
    /// The point that fails most: an index on each axis.
    pub worst: Vec<usize>,
    /// The amount at that point.
    pub amount: f32,
}

/// The most boxes. More would not help a reader.
const MOST: usize = 4;
/// The least factor by which a cut must make the boxes tighter.
const GAIN: f64 = 1.5;
/// A box with at least this share of failing points needs no cut.
const FULL: f64 = 0.9;

impl FailureGrid<'_> {
    fn places(&self, mut index: usize) -> Vec<usize> {
        let mut places = vec![0; self.axes.len()];
        for (place, axis) in places.iter_mut().zip(self.axes).rev() {
            *place = index % axis.values.len();
            index /= axis.values.len();
        }
        places
    }

    /// The boxes that hold all failing points: one, or a few where that is tighter.
    pub fn regions(&self) -> Vec<Region> {
        let amounts = self.amounts.iter().enumerate();
        let failing = amounts.filter(|(_, amount)| **amount > 0.0);
        let point = |(i, amount): (usize, &f32)| FailingPoint {
            places: self.places(i),
            amount: *amount,
        };
        let points: Vec<FailingPoint> = failing.map(point).collect();
        if points.is_empty() {
            return Vec::new();
        }
        let parts = if self.axes.len() == 1 {
            runs(points)
        } else {
            cut(points)
        };
        let mut regions: Vec<Region> = parts.iter().map(|part| region(part)).collect();
        regions.sort_by_key(|region| (std::cmp::Reverse(region.failing), region.worst.clone()));
        regions
    }
}

/// The points divided into parts by the few cuts that make their boxes tightest.
fn cut(points: Vec<FailingPoint>) -> Vec<Vec<FailingPoint>> {
    let mut parts = vec![points];
    while parts.len() < MOST {
        let cut = |(i, part): (usize, &Vec<FailingPoint>)| {
            let (axis, at, gain) = best_cut(part)?;
            Some((i, axis, at, gain * part.len() as f64))
        };
        let best = parts
            .iter()
            .enumerate()
            .filter_map(cut)
            .max_by(|a, b| a.3.total_cmp(&b.3));
        let Some((i, axis, at, _)) = best else { break };
        let part = parts.swap_remove(i);
        let (low, high) = part.into_iter().partition(|point| point.places[axis] < at);
        parts.extend([low, high]);
    }
    parts
}

/// The cut of a set of points that makes their boxes tightest: axis, index and gain. None where no cut is worthwhile.
fn best_cut(points: &[FailingPoint]) -> Option<(usize, usize, f64)> {
    let whole = bounds(points.iter());
    let volume = size(&whole);
    if points.len() as f64 >= FULL * volume as f64 {
        return None;
    }
    let mut best: Option<(usize, usize, f64)> = None;
    for (axis, range) in whole.iter().enumerate() {
        for (at, low, high) in halves(points, axis, range) {
            let gain = volume as f64 / (size(&low) + size(&high)) as f64;
            if gain >= GAIN && best.is_none_or(|(_, _, other)| gain > other) {
                best = Some((axis, at, gain));
            }
        }
    }
    best
}

/// The points of a single axis in runs, divided at the widest gaps.
fn runs(mut points: Vec<FailingPoint>) -> Vec<Vec<FailingPoint>> {
    let width = |i: &usize| points[*i].places[0] - points[i - 1].places[0];
    let mut gaps: Vec<usize> = (1..points.len()).filter(|i| width(i) > 1).collect();
    gaps.sort_by_key(|i| std::cmp::Reverse(width(i)));
    gaps.truncate(MOST - 1);
    gaps.sort_unstable();
    let mut parts = Vec::new();
    for gap in gaps.into_iter().rev() {
        parts.push(points.split_off(gap));
    }
    parts.push(points);
    parts
}

#[derive(Clone, Debug)]
struct FailingPoint {
    places: Vec<usize>,
    amount: f32,
}

type Extent = Vec<Range<usize>>;

fn size(extent: &Extent) -> usize {
    extent.iter().map(ExactSizeIterator::len).product()
}

fn bounds<'a>(points: impl Iterator<Item = &'a FailingPoint>) -> Extent {
    let one = |point: &FailingPoint| -> Extent {
        point.places.iter().map(|place| *place..place + 1).collect()
    };
    points
        .map(one)
        .reduce(|a, b| joined(&a, &b))
        .unwrap_or_default()
}

fn joined(a: &Extent, b: &Extent) -> Extent {
    a.iter()
        .zip(b)
        .map(|(a, b)| a.start.min(b.start)..a.end.max(b.end))
        .collect()
}

/// The boxes on both sides of every cut of an axis.
fn halves(
    points: &[FailingPoint],
    axis: usize,
    range: &Range<usize>,
) -> Vec<(usize, Extent, Extent)> {
    let add = |sum: &mut Option<Extent>, part: &Option<Extent>| {
        if let Some(part) = part {
            *sum = Some(sum.as_ref().map_or(part.clone(), |sum| joined(sum, part)));
        }
        Some(sum.clone())
    };
    let mut slices: Vec<Option<Extent>> = vec![None; range.len()];
    for point in points {
        let one = bounds(std::iter::once(point));
        add(&mut slices[point.places[axis] - range.start], &Some(one));
    }
    let below: Vec<Option<Extent>> = slices.iter().scan(None, add).collect();
    let mut above: Vec<Option<Extent>> = slices.iter().rev().scan(None, add).collect();
    above.reverse();
    let cut = |at: usize| Some((range.start + at, below[at - 1].clone()?, above[at].clone()?));
    (1..range.len()).filter_map(cut).collect()
}

fn region(points: &[FailingPoint]) -> Region {
    let extent = bounds(points.iter());
    let worst = points
        .iter()
        .reduce(|a, b| if b.amount > a.amount { b } else { a });
    let worst = worst.expect("a region has points");
    Region {
        failing: points.len(),
        points: size(&extent),
        worst: worst.places.clone(),
        amount: worst.amount,
        extent,
    }
}

impl Region {
    /// The inequalities, separated by commas. `everywhere` if the region spans the whole grid.
    pub fn inequalities(&self, axes: &[ScanAxis]) -> String {
        let ranges = self.extent.iter().zip(axes);
        let inequalities: Vec<String> = ranges
            .filter_map(|(range, axis)| inequality(axis, range))
            .collect();
        if inequalities.is_empty() {
            "everywhere".to_owned()
        } else {
            inequalities.join(", ")
        }
    }

    /// The share of its points that fail.
    pub fn share(&self) -> f64 {
        self.failing as f64 / self.points as f64
    }
}

/// The inequality of a range on its axis. None if the range is the whole axis.
fn inequality(axis: &ScanAxis, range: &Range<usize>) -> Option<String> {
    let (name, values) = (axis.name, &axis.values);
    if range.len() == 1 {
        return Some(single(axis, range.start));
    }
    let low = (range.start > 0).then(|| bound(values[range.start], values[range.start - 1]));
    let high = (range.end < values.len()).then(|| bound(values[range.end - 1], values[range.end]));
    match (low, high) {
        (None, None) => None,
        (Some(low), None) => Some(format!("{name} {} {}", low.sign('>'), low.text())),
        (None, Some(high)) => Some(format!("{name} {} {}", high.sign('<'), high.text())),
        (Some(low), Some(high)) => Some(format!(
            "{} {} {name} {} {}",
            low.text(),
            low.sign('<'),
            high.sign('<'),
            high.text()
        )),
    }
}

/// A single value of an axis. A value with many digits is given as the roundest number between its two neighbours.
fn single(axis: &ScanAxis, place: usize) -> String {
    let (name, value) = (axis.name, axis.values[place]);
    let neighbour = |place: Option<usize>| place.and_then(|place| axis.values.get(place)).copied();
    let (below, above) = (neighbour(place.checked_sub(1)), neighbour(Some(place + 1)));
    let fits = |x: f64| below.is_none_or(|below| x > below) && above.is_none_or(|above| x < above);
    let is_round = |digits: i32| round_bounds(value, digits).contains(&value);
    if value == 0.0 || is_round(2) {
        return format!("{name} = {}", short(value));
    }
    let rounded =
        (1..8).find_map(|digits| round_bounds(value, digits).into_iter().find(|x| fits(*x)));
    format!("{name} near {}", short(rounded.unwrap_or(value)))
}

/// An end of a range.
struct Bound {
    value: f64,
    /// Whether the value itself belongs to the range.
    is_inside: bool,
}

impl Bound {
    /// `<` or `>`, with `=` where the value belongs to the range.
    fn sign(&self, strict: char) -> String {
        let equal = if self.is_inside { "=" } else { "" };
        format!("{strict}{equal}")
    }

    fn text(&self) -> String {
        short(self.value)
    }
}

/// The roundest bound between the last value inside a range and the first one outside.
fn bound(inside: f64, outside: f64) -> Bound {
    // A reader expects 0 and 1 themselves, not a number near them.
    for plain in [0.0, 1.0] {
        if outside == plain || inside == plain {
            return Bound {
                value: plain,
                is_inside: outside != plain,
            };
        }
    }
    let side = (outside - inside).signum();
    let same = |x: f64, y: f64| (x - y).abs() <= SAME * y.abs();
    let lies_between = |x: &f64| {
        let beyond_inside = side * (*x - inside) > 0.0 || same(*x, inside);
        beyond_inside && side * (outside - *x) > 0.0 && !same(*x, outside)
    };
    let rounded = |digits: i32| {
        let near = |x: f64| round_bounds(x, digits).into_iter();
        let at_inside = near(inside).find(lies_between).map(|x| (x, true));
        at_inside.or_else(|| {
            near(outside)
                .find(|x| same(*x, outside))
                .map(|x| (x, false))
        })
    };
    let (value, is_inside) = (0..8).find_map(rounded).unwrap_or((inside, true));
    Bound { value, is_inside }
}

/// Numbers whose relative difference is at most this count as equal.
const SAME: f64 = 1e-7;

/// A number with so many digits after the first, from below and from above.
fn round_bounds(x: f64, digits: i32) -> [f64; 2] {
    let unit = libm::pow(10.0, libm::floor(libm::log10(x.abs())) - f64::from(digits));
    let exact = |steps: f64| {
        format!("{:.*e}", digits as usize, steps * unit)
            .parse()
            .unwrap_or(x)
    };
    [exact((x / unit).floor()), exact((x / unit).ceil())]
}

/// A number in few digits: plain where that is short, otherwise with an exponent.
pub fn short(x: f64) -> String {
    let single = x as f32 + 0.0;
    let plain = format!("{single}");
    if x == 0.0 || plain.len() <= 10 {
        plain
    } else {
        format!("{single:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(name: &'static str, values: &[f64]) -> ScanAxis {
        ScanAxis {
            name,
            values: values.to_vec(),
        }
    }

    fn field(axes: &[ScanAxis], fails: impl Fn(&[f64]) -> bool) -> Vec<String> {
        let points: usize = axes.iter().map(|axis| axis.values.len()).product();
        let mut field = FailureGrid {
            axes,
            amounts: vec![0.0; points],
        };
        for i in 0..points {
            let places = field.places(i).into_iter().zip(axes);
            let at: Vec<f64> = places.map(|(place, axis)| axis.values[place]).collect();
            field.amounts[i] = f32::from(fails(&at));
        }
        let regions = field.regions().into_iter();
        regions.map(|region| region.inequalities(axes)).collect()
    }

    fn grid() -> [ScanAxis; 2] {
        let cosines: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
        let etas: Vec<f64> = (0..=400).map(|i| 0.5 + f64::from(i) / 200.0).collect();
        [axis("eta", &etas), axis("cos_theta", &cosines)]
    }

    #[test]
    fn an_extent_is_given_by_its_roundest_bounds() {
        assert_eq!(field(&grid(), |at| at[0] < 1.088), ["eta < 1.09"]);
        assert_eq!(
            field(&grid(), |at| at[0] > 1.0 && at[1] < 0.203),
            ["eta > 1, cos_theta <= 0.2"]
        );
        assert_eq!(field(&grid(), |at| at[0] == 1.0), ["eta = 1"]);
        assert_eq!(field(&grid(), |_| true), ["everywhere"]);
        assert!(field(&grid(), |_| false).is_empty());
    }

    #[test]
    fn two_places_are_two_regions() {
        let regions = field(&grid(), |at| at[0] < 0.7 || at[0] > 2.2 && at[1] > 0.5);
        assert_eq!(regions, ["eta < 0.7", "eta > 2.2, cos_theta > 0.5"]);
    }
}
