//! [`Complex`]: complex numbers over any [`Num`].
//!
//! The modulus is scaled, so that it neither overflows nor loses small parts. The product is not: |z| must stay below 1e150.

use std::ops::{Add, Mul, Sub};

use super::{Num, Truth};

/// re + i·im
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex<N> {
    /// The real part.
    pub re: N,
    /// The imaginary part.
    pub im: N,
}

impl<N: Num> Complex<N> {
    /// re + i·im
    #[inline]
    pub fn new(re: N, im: N) -> Self {
        Complex { re, im }
    }

    /// A real number as a complex one.
    #[inline]
    pub fn real(re: N) -> Self {
        Complex::new(re, N::from_f64(0.0))
    }

    /// |z|² = re² + im², for |z| from 1e-150 to 1e150.
    #[inline]
    pub fn norm_sqr(self) -> N {
        self.re * self.re + self.im * self.im
    }

    /// |z|, without overflow or underflow of the squares.
    #[inline]
    pub fn modulus(self) -> N {
        let large = self.re.abs().max(self.im.abs());
        let small = self.re.abs().min(self.im.abs());
        if large.to_f64() == 0.0 {
            return large;
        }
        let ratio = small / large;
        large * (N::from_f64(1.0) + ratio * ratio).sqrt()
    }

    /// The principal square root: re ≥ 0, and on the cut (z real and negative) im ≥ 0.
    ///
    /// The larger part is √((|z| + |re|)/2), where nothing cancels; the other is im divided by twice that.
    #[inline]
    pub fn sqrt(self) -> Self {
        let half = N::from_f64(0.5);
        let zero = N::from_f64(0.0);
        let large = (half * (self.modulus() + self.re.abs())).sqrt();
        if large.to_f64() == 0.0 {
            return Complex::new(zero, zero);
        }
        let small = half * self.im / large;
        match (negative(self.re), negative(self.im)) {
            (false, _) => Complex::new(large, small),
            (true, false) => Complex::new(small, large),
            (true, true) => Complex::new(-small, -large),
        }
    }

    /// The product with a real number.
    #[inline]
    pub fn scale(self, factor: N) -> Self {
        Complex::new(self.re * factor, self.im * factor)
    }
}

#[inline]
fn negative<N: Num>(x: N) -> bool {
    x.less(N::from_f64(0.0)) == Truth::Yes
}

impl<N: Num> Add for Complex<N> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Complex::new(self.re + other.re, self.im + other.im)
    }
}

impl<N: Num> Sub for Complex<N> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Complex::new(self.re - other.re, self.im - other.im)
    }
}

impl<N: Num> Mul for Complex<N> {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        Complex::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_on_the_cut_points_up() {
        assert_eq!(Complex::new(-4.0, 0.0).sqrt(), Complex::new(0.0, 2.0));
        assert_eq!(Complex::new(0.0, 0.0).sqrt(), Complex::new(0.0, 0.0));
        assert_eq!(Complex::new(0.0, -8.0).sqrt(), Complex::new(2.0, -2.0));
        assert_eq!(Complex::new(3.0, -4.0).modulus(), 5.0);
    }
}
