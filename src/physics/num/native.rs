//! `f32` and `f64`, the machine's own numbers, as [`Num`].
//!
//! `+ - * /` and `sqrt` round correctly (IEEE 754). `exp2` and `log2` come from the `libm` crate, below 1 ulp,
//! because the standard library's call the platform's C library and may differ from machine to machine.

use super::{Num, Truth};

macro_rules! native {
    ($float:ty, $name:literal, $exp2:path, $log2:path) => {
        impl Num for $float {
            const NAME: &'static str = $name;

            #[inline]
            fn from_f64(x: f64) -> Self {
                x as $float
            }

            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            #[inline]
            fn abs(self) -> Self {
                <$float>::abs(self)
            }

            #[inline]
            fn min(self, other: Self) -> Self {
                <$float>::min(self, other)
            }

            #[inline]
            fn max(self, other: Self) -> Self {
                <$float>::max(self, other)
            }

            #[inline]
            fn sqrt(self) -> Self {
                <$float>::sqrt(self)
            }

            #[inline]
            fn exp2(self) -> Self {
                $exp2(self)
            }

            #[inline]
            fn log2(self) -> Self {
                $log2(self)
            }

            #[inline]
            fn less(self, other: Self) -> Truth {
                (self < other).into()
            }
        }
    };
}

native!(f32, "f32", libm::exp2f, libm::log2f);
native!(f64, "f64", libm::exp2, libm::log2);

#[cfg(test)]
mod tests {
    use crate::physics::num::{Num, Truth};

    fn check_exact_values<N: Num + PartialEq>() {
        let number = N::from_f64;
        assert_eq!(number(3.0).exp2(), number(8.0));
        assert_eq!(number(0.25).log2(), number(-2.0));
        assert_eq!(number(4.0).inverse_sqrt(), number(0.5));
        assert_eq!(number(-3.0).saturate(), number(0.0));
        assert_eq!(number(7.0).saturate(), number(1.0));
        assert_eq!(number(f64::NAN).saturate(), number(0.0));
        assert_eq!(number(f64::NAN).max(number(2.0)), number(2.0));
        assert_eq!(number(1.0).less(number(f64::NAN)), Truth::No);
        assert_eq!(number(1.0).less(number(2.0)), Truth::Yes);
    }

    #[test]
    fn exact_values_in_every_point_format() {
        check_exact_values::<f32>();
        check_exact_values::<f64>();
        check_exact_values::<crate::physics::num::Half>();
        check_exact_values::<crate::physics::num::Dd>();
    }
}
