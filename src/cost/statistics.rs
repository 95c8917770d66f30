//! What is told of readings: the middle, how far they scatter, and how sure the middle is. All by rank, so that one reading
//! that something else disturbed moves nothing.

/// The value below which this share of all lies; between two values it is interpolated. NaN where there are none.
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

/// The middle.
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// How far the middle half reaches, as a share of the median.
pub fn spread(values: &[f64]) -> f64 {
    (quantile(values, 0.75) - quantile(values, 0.25)) / median(values).abs()
}

/// An interval that holds the median of what the values are drawn from with at least 95 %, from two of the values. Nothing
/// is assumed of how they scatter: each lies below the true median with probability ½, and so the number below it is binomial.
/// None where there are too few values for that.
///
/// Source: W. R. Thompson, "On Confidence Ranges for the Median", Annals of Mathematical Statistics 7(3), 1936,
/// <https://doi.org/10.1214/aoms/1177732502>.
pub fn interval(values: &[f64]) -> Option<(f64, f64)> {
    const OUTSIDE: f64 = 0.05;
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len();
    let mut chance = libm::exp2(-(count as f64));
    let (mut tail, mut cut) = (0.0, 0);
    for below in 0..count / 2 {
        tail += chance;
        if 2.0 * tail > OUTSIDE {
            break;
        }
        cut = below + 1;
        chance *= (count - below) as f64 / (below + 1) as f64;
    }
    cut.checked_sub(1)
        .map(|place| (sorted[place], sorted[count - 1 - place]))
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
    fn the_interval_has_the_ranks_of_tables() {
        // Conover, "Practical Nonparametric Statistics", 1999, table A3: the ranks for a median at 95 %.
        for (count, rank) in [(6, 1), (8, 1), (9, 2), (15, 4), (21, 6), (30, 10)] {
            let values: Vec<f64> = (1..=count).rev().map(f64::from).collect();
            let expected = (f64::from(rank), f64::from(count + 1 - rank));
            assert_eq!(interval(&values), Some(expected), "{count}");
        }
        assert_eq!(interval(&[1.0, 2.0, 3.0, 4.0, 5.0]), None);
        assert_eq!(interval(&[]), None);
    }
}
