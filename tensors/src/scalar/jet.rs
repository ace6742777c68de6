//! 2-jets: the value, gradient and Hessian of a function at a point.

use super::operators::forward_operators;
use super::{ExactSum, Field, Ring};
use num_traits::{One, Zero};
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The value, gradient and Hessian of a function of coordinates at one point, in floats.
///
/// Arithmetic differentiates automatically: a closure over jets computes the derivatives of its
/// result. Third derivatives are unknown and returned as NaN. A tensor drops a jet only if its value
/// and all known derivatives are zero. Rounding noise is not removed.
///
/// ```
/// use affinor_tensors::Jet;
/// let [x, y] = Jet::coordinates([2.0, 3.0]);
/// let f = x.clone() * &x * &y.sin(); // x^2 sin y
/// assert_eq!(f.derivative(0).value(), 4.0 * 3f64.sin());
/// assert_eq!(f.derivative(0).derivative(1).value(), 4.0 * 3f64.cos());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Jet {
    value: f64,
    derivatives: Derivatives,
}

#[derive(Clone, Debug, PartialEq)]
enum Derivatives {
    /// All zero, in any coordinates.
    Constant,
    /// Gradient and Hessian, row by row, as far as they are known.
    Known(Option<Vec<f64>>, Option<Vec<f64>>),
}

use Derivatives::{Constant, Known};

impl Jet {
    /// The coordinates at a point.
    pub fn coordinates<const N: usize>(point: [f64; N]) -> [Jet; N] {
        let mut at = 0;
        point.map(|value| {
            at += 1;
            Self::coordinate(value, at - 1, N)
        })
    }

    /// The coordinate function with number `at`, from 0, of `n` coordinates.
    pub fn coordinate(value: f64, at: usize, n: usize) -> Jet {
        let gradient = (0..n).map(|a| if a == at { 1.0 } else { 0.0 }).collect();
        Jet { value, derivatives: Known(Some(gradient), Some(vec![0.0; n * n])) }
    }

    /// A constant.
    pub fn constant(value: f64) -> Jet {
        Jet { value, derivatives: Constant }
    }

    /// The value.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Whether the value and all derivatives that are known are finite.
    pub fn is_finite(&self) -> bool {
        let finite = |values: &Option<Vec<f64>>| values.iter().flatten().all(|v| v.is_finite());
        self.value.is_finite()
            && match &self.derivatives {
                Constant => true,
                Known(gradient, hessian) => finite(gradient) && finite(hessian),
            }
    }

    /// The partial derivative by coordinate `at`, from 0.
    #[must_use]
    pub fn derivative(&self, at: usize) -> Jet {
        let Known(gradient, hessian) = &self.derivatives else { return Jet::constant(0.0) };
        let Some(gradient) = gradient else {
            return Jet { value: f64::NAN, derivatives: Known(None, None) };
        };
        let n = gradient.len();
        let Some(value) = gradient.get(at) else { return Jet::constant(0.0) };
        let row = hessian.as_ref().map(|hessian| hessian[at * n..(at + 1) * n].to_vec());
        Jet { value: *value, derivatives: Known(row, None) }
    }

    /// The jet of `f(self)`, from the value and the first two derivatives of `f` at the value.
    #[must_use]
    pub fn chain(&self, [f, df, ddf]: [f64; 3]) -> Jet {
        let derivatives = match &self.derivatives {
            Constant => Constant,
            Known(gradient, hessian) => {
                let first = gradient.as_ref().map(|g| g.iter().map(|g| df * g).collect());
                let second = gradient.as_ref().zip(hessian.as_ref()).map(|(g, hessian)| {
                    let n = g.len();
                    let second = |(at, h): (usize, &f64)| df * h + ddf * g[at / n] * g[at % n];
                    hessian.iter().enumerate().map(second).collect()
                });
                Known(first, second)
            }
        };
        Jet { value: f, derivatives }
    }

    /// The sine.
    #[must_use]
    pub fn sin(&self) -> Jet {
        let (s, c) = self.value.sin_cos();
        self.chain([s, c, -s])
    }

    /// The cosine.
    #[must_use]
    pub fn cos(&self) -> Jet {
        let (s, c) = self.value.sin_cos();
        self.chain([c, -s, -c])
    }

    /// The exponential.
    #[must_use]
    pub fn exp(&self) -> Jet {
        let e = self.value.exp();
        self.chain([e, e, e])
    }

    /// The natural logarithm.
    #[must_use]
    pub fn ln(&self) -> Jet {
        let r = self.value.recip();
        self.chain([self.value.ln(), r, -r * r])
    }

    /// The square root.
    #[must_use]
    pub fn sqrt(&self) -> Jet {
        let r = self.value.sqrt();
        self.chain([r, 0.5 / r, -0.25 / (r * self.value)])
    }

    /// Combines two jets part by part.
    fn with(
        self,
        other: &Jet,
        value: f64,
        first: impl Fn(f64, f64) -> f64,
        second: impl Fn(f64, f64, [f64; 2], [f64; 2]) -> f64,
    ) -> Jet {
        let zeros = |like: &Option<Vec<f64>>| like.as_ref().map(|like| vec![0.0; like.len()]);
        let ((g, h), (k, l)) = match (self.derivatives, &other.derivatives) {
            (Constant, Constant) => return Jet::constant(value),
            (Known(g, h), Constant) => {
                let none = (zeros(&g), zeros(&h));
                ((g, h), none)
            }
            (Constant, Known(k, l)) => ((zeros(k), zeros(l)), (k.clone(), l.clone())),
            (Known(g, h), Known(k, l)) => ((g, h), (k.clone(), l.clone())),
        };
        let gradients = g.zip(k);
        let hessian = gradients.as_ref().zip(h.zip(l)).map(|((g, k), (h, l))| {
            let n = g.len();
            let part = |at: usize| {
                let (a, b) = (at / n, at % n);
                second(h[at], l[at], [g[a], g[b]], [k[a], k[b]])
            };
            (0..n * n).map(part).collect()
        });
        let gradient =
            gradients.map(|(g, k)| g.iter().zip(&k).map(|(g, k)| first(*g, *k)).collect());
        Jet { value, derivatives: Known(gradient, hessian) }
    }
}

impl Add<&Jet> for Jet {
    type Output = Jet;
    fn add(self, other: &Jet) -> Jet {
        let value = self.value + other.value;
        self.with(other, value, |g, k| g + k, |h, l, _, _| h + l)
    }
}

impl Sub<&Jet> for Jet {
    type Output = Jet;
    fn sub(self, other: &Jet) -> Jet {
        let value = self.value - other.value;
        self.with(other, value, |g, k| g - k, |h, l, _, _| h - l)
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "Leibniz adds")]
impl Mul<&Jet> for Jet {
    type Output = Jet;
    fn mul(self, other: &Jet) -> Jet {
        let (u, v) = (self.value, other.value);
        self.with(
            other,
            u * v,
            |g, k| g * v + u * k,
            |h, l, [ga, gb], [ka, kb]| h * v + ga * kb + gb * ka + u * l,
        )
    }
}

impl Div<&Jet> for Jet {
    type Output = Jet;
    /// Division by zero gives infinities and NaN, as for floats.
    fn div(self, other: &Jet) -> Jet {
        let r = other.value.recip();
        self * &other.chain([r, -r * r, 2.0 * r * r * r])
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        self.chain([-self.value, -1.0, 0.0])
    }
}

forward_operators!(Jet: Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign, Div div DivAssign div_assign);

impl Zero for Jet {
    fn zero() -> Self {
        Jet::constant(0.0)
    }
    fn is_zero(&self) -> bool {
        self.vanishes()
    }
}

impl One for Jet {
    fn one() -> Self {
        Jet::constant(1.0)
    }
}

impl Ring for Jet {
    type Sum = ExactSum<Self>;

    fn from_i64(n: i64) -> Self {
        Jet::constant(n as f64)
    }
    fn vanishes(&self) -> bool {
        let zero = |values: &Option<Vec<f64>>| values.iter().flatten().all(|v| *v == 0.0);
        let flat = match &self.derivatives {
            Constant => true,
            Known(gradient, hessian) => zero(gradient) && zero(hessian),
        };
        self.value == 0.0 && flat
    }
    fn is_number(&self) -> bool {
        self.is_finite()
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| Jet::constant(numerator as f64 / denominator as f64))
    }
}

impl Field for Jet {
    fn recip(&self) -> Option<Self> {
        (self.value != 0.0).then(|| Jet::one() / self)
    }
    fn pivot_weight(&self) -> f64 {
        self.value.abs()
    }
}

impl fmt::Display for Jet {
    /// The value alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}
