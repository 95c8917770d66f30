//! Values along a line of a picture: evenly, or in powers of ten.

/// Where values lie between two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    is_log: bool,
    /// The values at both ends, or their logarithms.
    low: f64,
    high: f64,
    /// The coordinates of both ends.
    from: f64,
    to: f64,
}

impl Scale {
    /// Values from `low` to `high`, evenly from one coordinate to the other.
    pub fn linear([low, high]: [f64; 2], [from, to]: [f64; 2]) -> Scale {
        Scale {
            is_log: false,
            low,
            high,
            from,
            to,
        }
    }

    /// Values from `low` to `high`, both above 0: each power of ten takes as much room.
    pub fn log(ends: [f64; 2], coordinates: [f64; 2]) -> Scale {
        Scale {
            is_log: true,
            ..Scale::linear(ends.map(libm::log10), coordinates)
        }
    }

    /// Where a value lies on the way: 0 at the low end, 1 at the high end.
    pub fn fraction(&self, value: f64) -> f64 {
        let span = self.high - self.low;
        if span == 0.0 {
            return 0.5;
        }
        let value = if self.is_log {
            libm::log10(value)
        } else {
            value
        };
        (value - self.low) / span
    }

    /// Whether a value lies between the ends, give or take rounding.
    pub fn holds(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }

    /// The coordinate of a value, held near the picture since viewers fail on huge numbers.
    pub fn at(&self, value: f64) -> f64 {
        (self.from + (self.to - self.from) * self.fraction(value)).clamp(-9999.0, 9999.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_evenly_or_by_their_powers() {
        let even = Scale::linear([0.0, 10.0], [100.0, 200.0]);
        assert_eq!(even.at(5.0), 150.0);
        let powers = Scale::log([1.0, 100.0], [100.0, 200.0]);
        assert_eq!(powers.at(10.0), 150.0);
        assert!(powers.holds(100.0) && !powers.holds(101.0));
        assert_eq!(Scale::linear([3.0, 3.0], [0.0, 8.0]).at(7.0), 4.0);
    }

    #[test]
    fn coordinates_stay_near_the_picture() {
        let scale = Scale::linear([0.0, 1.0], [10.0, 20.0]);
        assert_eq!(scale.at(0.5), 15.0);
        assert_eq!(scale.at(1e300), 9999.0);
        let falling = Scale::linear([0.0, 1.0], [20.0, 10.0]);
        assert_eq!(falling.at(f64::INFINITY), -9999.0);
    }
}
