//! The operators of a scalar in all forms. They are derived from the form `a + &b`.

/// Forwards operators by value, by reference and by assignment to `Scalar op &Scalar`. Also
/// implements subtraction, `Zero`, `One`, `iter::Sum`, `iter::Product`, `Default` (zero),
/// `From<i32>` and `From<i64>`.
macro_rules! forward_operators {
    ($scalar:ty: $($operator:ident $method:ident $assign:ident $assigned:ident),*) => {
        $(
            impl std::ops::$operator for $scalar {
                type Output = $scalar;
                fn $method(self, other: $scalar) -> $scalar {
                    std::ops::$operator::$method(self, &other)
                }
            }
            impl std::ops::$operator<$scalar> for &$scalar {
                type Output = $scalar;
                fn $method(self, other: $scalar) -> $scalar {
                    std::ops::$operator::$method(<$scalar>::clone(self), &other)
                }
            }
            impl std::ops::$operator<&$scalar> for &$scalar {
                type Output = $scalar;
                fn $method(self, other: &$scalar) -> $scalar {
                    std::ops::$operator::$method(<$scalar>::clone(self), other)
                }
            }
            impl std::ops::$assign<&$scalar> for $scalar {
                fn $assigned(&mut self, other: &$scalar) {
                    *self = std::ops::$operator::$method(std::mem::take(self), other);
                }
            }
            impl std::ops::$assign for $scalar {
                fn $assigned(&mut self, other: $scalar) {
                    std::ops::$assign::$assigned(self, &other);
                }
            }
        )*
        impl std::ops::Sub<&$scalar> for $scalar {
            type Output = $scalar;
            fn sub(self, other: &$scalar) -> $scalar {
                self + &-other.clone()
            }
        }
        impl num_traits::Zero for $scalar {
            fn zero() -> Self {
                $crate::Ring::from_i64(0)
            }
            fn is_zero(&self) -> bool {
                $crate::Ring::vanishes(self)
            }
        }
        impl num_traits::One for $scalar {
            fn one() -> Self {
                $crate::Ring::from_i64(1)
            }
        }
        impl<T: std::borrow::Borrow<$scalar>> std::iter::Sum<T> for $scalar {
            fn sum<I: Iterator<Item = T>>(terms: I) -> $scalar {
                terms.fold(num_traits::Zero::zero(), |sum: $scalar, term| sum + term.borrow())
            }
        }
        impl<T: std::borrow::Borrow<$scalar>> std::iter::Product<T> for $scalar {
            fn product<I: Iterator<Item = T>>(factors: I) -> $scalar {
                factors.fold(num_traits::One::one(), |product: $scalar, x| product * x.borrow())
            }
        }
        impl Default for $scalar {
            /// The default value is zero.
            fn default() -> $scalar {
                num_traits::Zero::zero()
            }
        }
        impl From<i64> for $scalar {
            fn from(n: i64) -> $scalar {
                $crate::Ring::from_i64(n)
            }
        }
        impl From<i32> for $scalar {
            fn from(n: i32) -> $scalar {
                $crate::Ring::from_i64(n.into())
            }
        }
    };
}
pub(super) use forward_operators;
