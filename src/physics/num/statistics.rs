//! Robust statistics of measurements: the median, their spread, and the median's confidence interval. All are by rank, so that
//! a single disturbed reading changes nothing. Also least squares, and the rank correlation.

use std::collections::BTreeMap;

/// The value below which this fraction of all lies, interpolated linearly between two values. NaN where there are none.
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let place = share.clamp(0.0, 1.0) * last as f64;
    let (below, above) = (place as usize, (place as usize + 1).min(last));
    sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
}

/// The median.
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// The median of the values of each name, in the order of names: one number a name, however many values it has.
pub fn medians<'a>(values: &[f64], names: impl IntoIterator<Item = &'a str>) -> Vec<f64> {
    let mut of: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (value, name) in values.iter().zip(names) {
        of.entry(name).or_default().push(*value);
    }
    of.into_values().map(|own| median(&own)).collect()
}

/// The interquartile range, as a fraction of the median.
pub fn spread(values: &[f64]) -> f64 {
    (quantile(values, 0.75) - quantile(values, 0.25)) / median(values).abs()
}

/// Bootstrap samples: each is `count` indices below `count`, drawn with replacement. A statistic of the samples scatters as it
/// would over repeated measurements. The samples are the same in every run.
///
/// Source: B. Efron, "Bootstrap Methods: Another Look at the Jackknife", Annals of Statistics 7(1), 1979,
/// <https://doi.org/10.1214/aos/1176344552>.
pub fn resamples(count: usize) -> impl Iterator<Item = Vec<usize>> {
    const TIMES: usize = 400;
    let mut random = fastrand::Rng::with_seed(count as u64);
    let draw = move |_| (0..count).map(|_| random.usize(0..count)).collect();
    (0..TIMES).map(draw)
}

/// The limits within which 95 % of the values lie. For a statistic over [`resamples`] it is its confidence interval.
pub fn interval(values: &[f64]) -> (f64, f64) {
    (quantile(values, 0.025), quantile(values, 0.975))
}

/// The least-squares line through these points: its intercept and its slope.
pub fn least_squares(x: &[f64], y: &[f64]) -> (f64, f64) {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (about, level) = (mean(x), mean(y));
    let pairs = || x.iter().zip(y);
    let across: f64 = pairs().map(|(x, y)| (x - about) * (y - level)).sum();
    let square: f64 = x.iter().map(|x| (x - about).powi(2)).sum();
    let rate = across / square;
    (level - rate * about, rate)
}

/// Spearman's rank correlation: 1 if both are in the same order, -1 if in opposite orders.
pub fn rank_correlation(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let mean = (a.len() as f64 + 1.0) / 2.0;
    let product = |x: &[f64], y: &[f64]| -> f64 {
        x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum()
    };
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}

/// The rank of each value, from 1. Equal values share the mean of their ranks.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count() as f64;
        let equal = values.iter().filter(|other| *other == value).count() as f64;
        below + (equal + 1.0) / 2.0
    };
    values.iter().map(rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_does_not_hear_an_outlier() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[1.0, 2.0, 3.0, 1e9]), 2.5);
        assert_eq!(spread(&[1.0, 2.0, 3.0, 4.0, 5.0]), 2.0 / 3.0);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn the_interval_holds_what_it_should() {
        // The lower decile of these numbers is known: 0.1.
        let mut random = fastrand::Rng::with_seed(7);
        let holds = |_| {
            let drawn: Vec<f64> = (0..75).map(|_| random.f64()).collect();
            let of = |places: Vec<usize>| {
                let values: Vec<f64> = places.iter().map(|place| drawn[*place]).collect();
                quantile(&values, 0.1)
            };
            let (low, high) = interval(&resamples(drawn.len()).map(of).collect::<Vec<f64>>());
            usize::from(low <= 0.1 && 0.1 <= high)
        };
        let held: usize = (0..200).map(holds).sum();
        assert!((180..=198).contains(&held), "{held} of 200");
    }

    #[test]
    fn ranks_correlate_from_minus_one_to_one() {
        assert_eq!(rank_correlation(&[1.0, 2.0, 9.0], &[0.1, 0.2, 0.3]), 1.0);
        assert_eq!(rank_correlation(&[1.0, 2.0, 9.0], &[3.0, 2.0, 1.0]), -1.0);
        assert_eq!(ranks(&[5.0, 1.0, 5.0]), [2.5, 1.0, 2.5]);
    }

    #[test]
    fn a_line_is_found() {
        let (fixed, rate) = least_squares(&[0.0, 50.0, 100.0], &[20.0, 60.0, 100.0]);
        assert!((fixed - 20.0).abs() < 1e-9 && (rate - 0.8).abs() < 1e-9);
    }
}
