//! Eigenvalues of Casimir elements of higher degree.

use super::{Decomposition, HighestWeight, RepresentationError};
use crate::algebra::roots::Series;
use crate::algebra::structure::dynkin::exponents;
use affinor_tensors::Rational;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// A Casimir element of a simple factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CasimirElement {
    /// The trace of a power; see [`HighestWeight::trace_casimir`].
    Trace {
        /// The exponent.
        degree: u32,
    },
    /// The Pfaffian of so(2n), of degree `n`; see [`HighestWeight::pfaffian`].
    Pfaffian,
}

impl HighestWeight {
    /// The eigenvalue of `tr_U(A^p)`, where `A` is the sum of `x_a ⊗ x^a` over dual bases of a simple
    /// factor. The trace is taken in its defining representation `U`. The dimension of `U` is `n + 1`
    /// for `A_n`, `2n + 1` for `B_n`, and `2n` for `C_n` and `D_n`. It is 7 for G2, 26 for F4, and 27, 56,
    /// 248 for E6, E7, E8. Long roots have squared length 2. For `p = 2` it is the Casimir eigenvalue times the
    /// Dynkin index of `U`.
    ///
    /// On a component `V_μ` of `V ⊗ U`, the operator `A` is the number `(C(μ) - C(λ) - C(U))/2`, with
    /// the quadratic Casimir eigenvalues `C`. So the eigenvalue is the sum of the powers of these
    /// numbers with the weights `dim V_μ/dim V`. A. M. Perelomov and V. S. Popov, *Sov. J. Nucl. Phys.*
    /// 3 (1966) 676-680.
    ///
    /// # Errors
    /// [`RepresentationError::TooLarge`] if the product exceeds the limits.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let su3: ReductiveAlgebra = "SU(3)".parse()?;
    /// let quark = HighestWeight::parse(&su3, "3")?;
    /// let antiquark = quark.dual();
    /// let [cubic, conjugate] = [&quark, &antiquark].map(|w| w.trace_casimir(0, 3));
    /// // the symmetric tensor d_abc has opposite eigenvalues on the two
    /// assert_eq!(cubic? - &conjugate?, Rational::new(40, 9).unwrap());
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    #[doc(alias("Perelomov-Popov", "Casimir invariant"))]
    pub fn trace_casimir(
        &self,
        factor: usize,
        degree: u32,
    ) -> Result<Rational, RepresentationError> {
        let values = self.eigenvalues(factor)?;
        Ok(self.power_sum(&values, degree))
    }

    /// The eigenvalue of the Pfaffian of so(2n): the product of the orthogonal coordinates of `λ + ρ`.
    /// It changes its sign if the two half-spin representations are exchanged. `None` if the factor is
    /// not of series D.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::representation::{HighestWeight, ReductiveAlgebra};
    /// let so8: ReductiveAlgebra = "SO(8)".parse()?;
    /// let spinor = HighestWeight::new(&so8, [0, 0, 0, 1])?;
    /// assert_eq!(spinor.pfaffian(0), Rational::new(7 * 5 * 3, 16));
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn pfaffian(&self, factor: usize) -> Option<Rational> {
        let one = self.algebra().simple_factors().get(factor)?;
        if one.series() != Series::D {
            return None;
        }
        let labels = &self.labels()[self.algebra().positions(factor)];
        let (last, others) = labels.split_last()?;
        let (previous, others) = others.split_last()?;
        // twice the coordinates, from the last one
        let mut coordinate = last + previous + 2;
        let mut product = BigInt::from(last - previous) * coordinate;
        for label in others.iter().rev() {
            coordinate += 2 * (label + 1);
            product *= coordinate;
        }
        Some(BigRational::new(product, BigInt::one() << labels.len()).into())
    }

    /// The Casimir elements of each simple factor with their eigenvalues. They are traces in the degrees
    /// of the algebra, which are the exponents plus 1. For series D, the Pfaffian replaces the trace of
    /// degree `n`.
    ///
    /// # Errors
    /// As [`HighestWeight::trace_casimir`].
    ///
    /// ```
    /// use affinor::representation::{CasimirElement, HighestWeight, ReductiveAlgebra};
    /// let e8: ReductiveAlgebra = "E8".parse()?;
    /// let all = HighestWeight::adjoint(&e8)[0].casimirs()?;
    /// let degrees: Vec<_> = all[0].iter().map(|(element, _)| *element).collect();
    /// let expected = [2, 8, 12, 14, 18, 20, 24, 30].map(|degree| CasimirElement::Trace { degree });
    /// assert_eq!(degrees, expected);
    /// # Ok::<(), affinor::representation::RepresentationError>(())
    /// ```
    pub fn casimirs(&self) -> Result<Vec<Vec<(CasimirElement, Rational)>>, RepresentationError> {
        let factors = self.algebra().simple_factors().iter().enumerate();
        let of_factor = |(at, factor): (usize, &crate::algebra::roots::CartanType)| {
            let values = self.eigenvalues(at)?;
            let pfaffian = self.pfaffian(at);
            let mut degrees: Vec<u32> =
                exponents(*factor).into_iter().map(|m| m as u32 + 1).collect();
            degrees.sort_unstable();
            if pfaffian.is_some() {
                let own = degrees.iter().position(|degree| *degree as usize == factor.rank());
                own.map(|at| degrees.remove(at));
            }
            let traces = degrees
                .into_iter()
                .map(|degree| (CasimirElement::Trace { degree }, self.power_sum(&values, degree)));
            let last = pfaffian.map(|value| (CasimirElement::Pfaffian, value));
            Ok(traces.chain(last).collect())
        };
        factors.map(of_factor).collect()
    }

    /// The eigenvalues of `A` with the dimensions of their spaces.
    fn eigenvalues(
        &self,
        factor: usize,
    ) -> Result<Vec<(BigRational, BigInt)>, RepresentationError> {
        let defining = self.defining(factor);
        let casimir = |weight: &HighestWeight| {
            weight.casimir().get(factor).map_or_else(BigRational::zero, BigRational::from)
        };
        let fixed = casimir(self) + casimir(&defining);
        let product: Decomposition = self.tensor(&defining)?;
        let values = product.components().map(|(weight, multiplicity)| {
            let value = (casimir(weight) - &fixed) / BigInt::from(2);
            (value, BigInt::from(weight.dimension()) * multiplicity)
        });
        Ok(values.collect())
    }

    fn power_sum(&self, values: &[(BigRational, BigInt)], degree: u32) -> Rational {
        let terms = values.iter().map(|(value, dimension)| value.pow(degree as i32) * dimension);
        let sum = terms.fold(BigRational::zero(), |sum, term| sum + term);
        (sum / BigInt::from(self.dimension())).into()
    }

    /// The defining representation of a simple factor.
    fn defining(&self, factor: usize) -> HighestWeight {
        let algebra = self.algebra();
        let mut labels = vec![0; algebra.rank()];
        if let Some(one) = algebra.simple_factors().get(factor) {
            let node = match (one.series(), one.rank()) {
                (Series::F | Series::E, rank @ (4 | 7 | 8)) => rank - 1,
                _ => 0,
            };
            labels[algebra.positions(factor).start + node] = 1;
        }
        HighestWeight::of(algebra, labels)
    }
}
