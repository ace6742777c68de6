//! 2-jets: the value, the gradient and the Hessian of a function at a point.

use super::operators::forward_operators;
use super::{ExactSum, Field, Ring, Summable};
use num_traits::One;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg};

/// The value, the gradient and the Hessian of a function of coordinates at one point, in floats.
///
/// The arithmetic differentiates automatically: a closure over jets computes the derivatives of its
/// result. Third derivatives are unknown, and are returned as NaN. A tensor does not show a jet
/// whose value and known derivatives are zero. However, it stores the jet if a derivative is
/// unknown, so that this derivative is NaN and not zero. Rounding errors are not removed.
///
/// ```
/// use affinor_tensors::Jet;
/// let [x, y] = Jet::coordinates([2.0, 3.0]);
/// let f = x.clone() * &x * &y.sin(); // x^2 sin y
/// assert_eq!(f.derivative(0).value(), 4.0 * 3f64.sin());
/// assert_eq!(f.derivative(0).derivative(1).value(), 4.0 * 3f64.cos());
/// ```
#[must_use]
#[derive(Clone, Debug, PartialEq)]
pub struct Jet {
    value: f64,
    /// The gradient. It is `None` if it is unknown, and empty for a constant, whose derivatives
    /// vanish in any coordinates.
    gradient: Option<Vec<f64>>,
    /// The rows of the Hessian in one list. It is `None` or empty as for the gradient.
    hessian: Option<Vec<f64>>,
}

impl Jet {
    /// The coordinate functions at a point, as jets.
    pub fn coordinates<const N: usize>(point: [f64; N]) -> [Jet; N] {
        std::array::from_fn(|at| Self::coordinate(point[at], at, N))
    }

    /// The coordinate function with the index `at`, from 0, among `n` coordinates.
    pub fn coordinate(value: f64, at: usize, n: usize) -> Jet {
        let gradient = (0..n).map(|a| if a == at { 1.0 } else { 0.0 }).collect();
        Jet { value, gradient: Some(gradient), hessian: Some(vec![0.0; n * n]) }
    }

    /// A constant.
    pub fn constant(value: f64) -> Jet {
        Jet { value, gradient: Some(vec![]), hessian: Some(vec![]) }
    }

    /// The value.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Whether the value and all known derivatives are finite.
    pub fn is_finite(&self) -> bool {
        self.value.is_finite() && self.known().all(|derivative| derivative.is_finite())
    }

    /// All known derivatives.
    fn known(&self) -> impl Iterator<Item = &f64> {
        self.gradient.iter().chain(&self.hessian).flatten()
    }

    /// The partial derivative with respect to the coordinate `at`, from 0.
    pub fn derivative(&self, at: usize) -> Jet {
        let Some(gradient) = &self.gradient else {
            return Jet { value: f64::NAN, gradient: None, hessian: None };
        };
        let n = gradient.len();
        let Some(&value) = gradient.get(at) else { return Jet::constant(0.0) };
        let row = self.hessian.as_ref().map(|hessian| hessian[at * n..(at + 1) * n].to_vec());
        Jet { value, gradient: row, hessian: None }
    }

    /// The jet of `f(self)`, computed from the value and the first two derivatives of `f` at the
    /// value.
    pub fn chain(&self, [f, df, ddf]: [f64; 3]) -> Jet {
        let gradient = self.gradient.as_ref();
        let hessian = gradient.zip(self.hessian.as_ref()).map(|(g, hessian)| {
            let n = g.len();
            let second = |(at, h): (usize, &f64)| df * h + ddf * g[at / n] * g[at % n];
            hessian.iter().enumerate().map(second).collect()
        });
        let gradient = gradient.map(|g| g.iter().map(|g| df * g).collect());
        Jet { value: f, gradient, hessian }
    }

    /// The sine.
    pub fn sin(&self) -> Jet {
        let (s, c) = self.value.sin_cos();
        self.chain([s, c, -s])
    }

    /// The cosine.
    pub fn cos(&self) -> Jet {
        let (s, c) = self.value.sin_cos();
        self.chain([c, -s, -c])
    }

    /// The exponential.
    pub fn exp(&self) -> Jet {
        let e = self.value.exp();
        self.chain([e, e, e])
    }

    /// The natural logarithm.
    pub fn ln(&self) -> Jet {
        let r = self.value.recip();
        self.chain([self.value.ln(), r, -r * r])
    }

    /// The square root.
    pub fn sqrt(&self) -> Jet {
        let r = self.value.sqrt();
        self.chain([r, 0.5 / r, -0.25 / (r * self.value)])
    }

    /// Combines the parts of two jets: values, gradients and Hessians.
    fn with(
        self,
        other: &Jet,
        value: f64,
        first: impl Fn(f64, f64) -> f64,
        second: impl Fn(f64, f64, [f64; 2], [f64; 2]) -> f64,
    ) -> Jet {
        // extends the derivatives of a constant by zeros, to the length of the other operand
        let both = |a: Option<Vec<f64>>, b: &Option<Vec<f64>>| {
            let (mut a, mut b) = (a?, b.clone()?);
            let n = a.len().max(b.len());
            a.resize(n, 0.0);
            b.resize(n, 0.0);
            Some((a, b))
        };
        let gradients = both(self.gradient, &other.gradient);
        let hessians = both(self.hessian, &other.hessian);
        let hessian = gradients.as_ref().zip(hessians).map(|((g, k), (h, l))| {
            let n = g.len();
            let part = |at: usize| {
                let (a, b) = (at / n, at % n);
                second(h[at], l[at], [g[a], g[b]], [k[a], k[b]])
            };
            (0..n * n).map(part).collect()
        });
        let gradient =
            gradients.map(|(g, k)| g.iter().zip(&k).map(|(g, k)| first(*g, *k)).collect());
        Jet { value, gradient, hessian }
    }
}

impl Add<&Jet> for Jet {
    type Output = Jet;
    fn add(self, other: &Jet) -> Jet {
        let value = self.value + other.value;
        self.with(other, value, |g, k| g + k, |h, l, _, _| h + l)
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
    /// Divides two jets. Division by zero yields infinities and NaN, as for floats.
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

impl Ring for Jet {
    fn from_i64(n: i64) -> Self {
        Jet::constant(n as f64)
    }
    fn vanishes(&self) -> bool {
        self.value == 0.0 && self.known().all(|derivative| *derivative == 0.0)
    }
    fn from_quotient(numerator: i64, denominator: i64) -> Option<Self> {
        f64::from_quotient(numerator, denominator).map(Jet::constant)
    }
}

impl Summable for Jet {
    type Sum = ExactSum<Self>;
    /// Whether the value and all known derivatives are zero. Unknown derivatives may differ from
    /// zero.
    fn is_small(&self) -> bool {
        let is_unknown = self.gradient.is_none() || self.hessian.is_none();
        is_unknown && self.vanishes()
    }
    fn is_number(&self) -> bool {
        self.is_finite()
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
    /// Writes only the value.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}
