//! f32 as compilers are free to make it: products fused into sums, quotients by reciprocals, roots by reciprocal roots.
//! A NaN is never lost on the way: the least and the greatest of a NaN are one, since languages leave that open.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fresnel_gen::physics::num::{Num, Truth};

/// As it is written.
pub const UNFUSED: u8 = 0;
/// A sum takes its left term unrounded where that is a product, else its right.
pub const FUSED_LEFT: u8 = 1;
/// The same, the right term first.
pub const FUSED_RIGHT: u8 = 2;
/// `a / b = a (1 / b)` and `√x = x (1 / √x)`; of 0 that is a NaN.
pub const RECIPROCAL: u8 = 3;

/// A number of such an arithmetic, with the product that it was before it was rounded.
#[derive(Clone, Copy, Debug)]
pub struct Fast<const KIND: u8> {
    value: f32,
    product: Option<f64>,
}

impl<const KIND: u8> Fast<KIND> {
    fn of(value: f32) -> Self {
        Fast {
            value,
            product: None,
        }
    }

    /// A product of two f32 is exact in f64.
    fn exact(self) -> f64 {
        self.product.unwrap_or(f64::from(self.value))
    }

    fn sum(self, other: Self) -> Self {
        let [left, right] = [self, other].map(|term| f64::from(term.value));
        let fused = match (KIND, self.product, other.product) {
            (FUSED_LEFT, Some(_), _) | (FUSED_RIGHT, Some(_), None) => self.exact() + right,
            (FUSED_LEFT | FUSED_RIGHT, _, Some(_)) => left + other.exact(),
            _ => return Fast::of(self.value + other.value),
        };
        Fast::of(fused as f32)
    }

    fn any_nan(self, other: Self) -> Option<Self> {
        let is_nan = self.value.is_nan() || other.value.is_nan();
        is_nan.then(|| Fast::of(f32::NAN))
    }
}

impl<const KIND: u8> Add for Fast<KIND> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.sum(other)
    }
}

impl<const KIND: u8> Sub for Fast<KIND> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.sum(-other)
    }
}

impl<const KIND: u8> Mul for Fast<KIND> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Fast {
            value: self.value * other.value,
            product: Some(f64::from(self.value) * f64::from(other.value)),
        }
    }
}

impl<const KIND: u8> Div for Fast<KIND> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Fast::of(if KIND == RECIPROCAL {
            self.value * (1.0 / other.value)
        } else {
            self.value / other.value
        })
    }
}

impl<const KIND: u8> Neg for Fast<KIND> {
    type Output = Self;

    fn neg(self) -> Self {
        Fast {
            value: -self.value,
            product: self.product.map(|product| -product),
        }
    }
}

impl<const KIND: u8> Fast<KIND> {
    /// The name in messages.
    pub const NAME: &'static str = match KIND {
        UNFUSED => "unfused",
        FUSED_LEFT => "fused, left first",
        FUSED_RIGHT => "fused, right first",
        _ => "by reciprocals",
    };
}

impl<const KIND: u8> Num for Fast<KIND> {
    fn from_f64(x: f64) -> Self {
        Fast::of(x as f32)
    }

    fn to_f64(self) -> f64 {
        f64::from(self.value)
    }

    fn abs(self) -> Self {
        Fast::of(self.value.abs())
    }

    fn min(self, other: Self) -> Self {
        self.any_nan(other)
            .unwrap_or(Fast::of(self.value.min(other.value)))
    }

    fn max(self, other: Self) -> Self {
        self.any_nan(other)
            .unwrap_or(Fast::of(self.value.max(other.value)))
    }

    fn sqrt(self) -> Self {
        Fast::of(if KIND == RECIPROCAL {
            self.value * (1.0 / self.value.sqrt())
        } else {
            self.value.sqrt()
        })
    }

    fn inverse_sqrt(self) -> Self {
        Fast::of(1.0 / self.value.sqrt())
    }

    fn exp2(self) -> Self {
        Fast::of(libm::exp2f(self.value))
    }

    fn log2(self) -> Self {
        Fast::of(libm::log2f(self.value))
    }

    fn sin(self) -> Self {
        Fast::of(libm::sinf(self.value))
    }

    fn cos(self) -> Self {
        Fast::of(libm::cosf(self.value))
    }

    fn less(self, other: Self) -> Truth {
        (self.value < other.value).into()
    }
}
