//! The Petrov type of a spacetime, without a null tetrad.
//!
//! On bivectors of a spacetime of dimension 4 the Hodge star is a complex structure, `** = -1`. The Weyl tensor is a
//! complex linear map `C` of these bivectors, with trace zero. Its Jordan form is the Petrov type (A. Z. Petrov, *Gen. Rel. Grav.* 32 (2000)
//! 1665-1685, a translation of the paper of 1954). The type follows from polynomials in `C`
//! (H. Stephani and others, *Exact Solutions of Einstein's Field Equations* (2003), chapters 4 and 9):
//!
//! ```text
//! I = tr C^2 / 2,   J = tr C^3 / 6        (complex)
//! I^3 != 27 J^2                            type I
//! I = J = 0:  C = 0, C^2 = 0, other        types O, N, III
//! other:      2 I C^2 - 6 J C = 4/3 I^2    type D, and type II if not
//! ```
//!
//! The root `s` of `-det g` occurs in the star only, so a complex number is a pair `(a, b)` that means `a + i s b`.
//! All entries are exact values of the field of the metric.

use crate::Error;
use crate::algebra::frame::formula;
use crate::algebra::structure::GroundField;
use crate::geometry::connection::Connection;
use crate::geometry::isometry::is_positive_at_sample;
use crate::geometry::metric::Metric;
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Tensor, TensorError};
use std::fmt;

/// The algebraic type of the Weyl tensor of a spacetime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PetrovType {
    /// The Weyl tensor is zero.
    O,
    /// One principal null direction, of multiplicity four: gravitational waves.
    N,
    /// A principal null direction of multiplicity three, and a simple one.
    III,
    /// Two principal null directions, both of multiplicity two: black holes.
    D,
    /// A principal null direction of multiplicity two, and two simple ones.
    II,
    /// Four simple principal null directions.
    I,
}

impl fmt::Display for PetrovType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// The Petrov type and the invariants of the Weyl tensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Petrov<S> {
    /// The type at generic points and for generic parameters.
    pub kind: PetrovType,
    /// The invariant `I` as `[a, b]`, which means `a + i s b` with `s^2 = -det g`.
    pub quadratic: [S; 2],
    /// The invariant `J` in the same form.
    pub cubic: [S; 2],
    /// The number `s^2 = -det g`.
    pub volume_squared: S,
}

impl<S: GroundField> Connection<S> {
    /// The Petrov type of a Levi-Civita connection; `None` unless the metric is Lorentzian in
    /// dimension 4. The signature is `(3,1)` or `(1,3)` at one of 33 sample points. The type is that
    /// at generic points and for generic parameters.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::geometry::petrov::PetrovType;
    /// use affinor::{Connection, Metric, Rational};
    /// // the product of a line and the group SU(2) with an invariant metric of two parameters
    /// let line = catalogue::algebra::<Rational>("R^1")?;
    /// let algebra = catalogue::algebra::<Rational>("su(2)")?.direct_sum(&line)?;
    /// let metric = Metric::diagonal([1, 1, 2, -1].map(Rational::from))?;
    /// let connection = Connection::levi_civita(algebra.left_frame(), &metric)?;
    /// let petrov = connection.petrov(&metric)?.expect("a Lorentzian metric");
    /// assert_eq!(petrov.kind, PetrovType::D);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`weyl`](Self::weyl).
    #[doc(alias("algebraically special", "principal null directions", "Weyl invariants"))]
    pub fn petrov(&self, metric: &Metric<S>) -> Result<Option<Petrov<S>>, Error> {
        if self.frame().dimension() != 4 {
            return Ok(None);
        }
        let _stage = stage("petrov");
        let share = |n: i64| S::from_i64(n).recip().ok_or(TensorError::NotInvertible(n));
        let half = share(2)?;
        let star = star(metric)?;
        let product = |a: &Tensor<S>, b: &Tensor<S>| {
            formula("A^ab_ef B^ef_cd -> ^ab_[cd]", &[("A", a), ("B", b)]).scale(&half)
        };
        let trace = |a: &Tensor<S>| formula("A^ab_ab -> ", &[("A", a)]).get(&[]) * &half;
        // star star = -1 / s^2 on the six bivectors
        let inverse = trace(&product(&star, &star)) * &-share(6)?;
        let Some(d) = inverse.recip() else { return Ok(None) };
        if !is_positive_at_sample(&d.symbolic(), &[]) {
            return Ok(None);
        }
        let weyl = self.weyl(metric)?.raise(1, metric.inverse())?;
        let square = product(&weyl, &weyl);
        // the complex trace is half the real trace of the part that commutes with the star
        let complex_trace =
            |a: &Tensor<S>| [trace(a) * &half, -(trace(&product(&star, a)) * &half)];
        let second = complex_trace(&square);
        let third = complex_trace(&product(&square, &weyl));
        let scaled = |[a, b]: &[S; 2], by: &S| [a.clone() * by, b.clone() * by];
        let [quadratic, cubic] = [scaled(&second, &half), scaled(&third, &share(6)?)];
        let petrov = |kind| {
            let (quadratic, cubic) = (quadratic.clone(), cubic.clone());
            Ok(Some(Petrov { kind, quadratic, cubic, volume_squared: d.clone() }))
        };
        let times = |[a, b]: &[S; 2], [x, y]: &[S; 2]| {
            let real = a.clone() * x - &(b.clone() * y * &d);
            [real, a.clone() * y + &(b.clone() * x)]
        };
        let cube = times(&quadratic, &times(&quadratic, &quadratic));
        let limit = scaled(&times(&cubic, &cubic), &S::from_i64(27));
        let is_zero = |pair: &[S; 2]| pair.iter().all(S::vanishes);
        if cube != limit {
            return petrov(PetrovType::I);
        }
        if is_zero(&quadratic) {
            return petrov(match (weyl.is_empty(), square.is_empty()) {
                (true, _) => PetrovType::O,
                (_, true) => PetrovType::N,
                _ => PetrovType::III,
            });
        }
        // a complex number a + i s b acts on bivectors as a + s^2 b star
        let acting = |[a, b]: &[S; 2], on: &Tensor<S>| {
            let turned = product(&star, on).scale(&(b.clone() * &d));
            formula("A^ab_cd + B^ab_cd -> ^ab_[cd]", &[("A", &on.scale(a)), ("B", &turned)])
        };
        let unit = formula("d^a_c d^b_d - d^a_d d^b_c -> ^ab_[cd]", &[("d", &Tensor::identity(4))]);
        let terms = [
            acting(&scaled(&quadratic, &S::from_i64(2)), &square),
            acting(&scaled(&cubic, &S::from_i64(6)), &weyl),
            acting(&scaled(&times(&quadratic, &quadratic), &(S::from_i64(4) * &share(3)?)), &unit),
        ];
        let [first, second, third] = &terms;
        let minimal = formula(
            "A^ab_cd - B^ab_cd - C^ab_cd -> ^ab_[cd]",
            &[("A", first), ("B", second), ("C", third)],
        );
        petrov(if minimal.is_empty() { PetrovType::D } else { PetrovType::II })
    }
}

/// The Hodge star of bivectors divided by `s`: `g^ai g^bj [ijcd]`.
fn star<S: GroundField>(metric: &Metric<S>) -> Result<Tensor<S>, Error> {
    let mut entries = vec![];
    for code in 0..256usize {
        let at = [code >> 6, code >> 4 & 3, code >> 2 & 3, code & 3];
        let pairs = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)));
        let sign: i64 = pairs.map(|(i, j)| (at[j] as i64 - at[i] as i64).signum()).product();
        if sign != 0 {
            entries.push((at, S::from_i64(sign)));
        }
    }
    let symbol = Tensor::from_components(4, &[Down; 4], entries)?;
    let inverse = metric.inverse();
    Ok(formula("I^ai I^bj e_ijcd -> ^ab_[cd]", &[("I", inverse), ("e", &symbol)]))
}
