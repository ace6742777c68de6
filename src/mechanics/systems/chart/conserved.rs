//! Polynomials in the velocity that are constant along the curves of a chart.

use super::ChartEquations;
use crate::algebra::frame::{expect_slots, formula};
use crate::{Error, Law};
use affinor_tensors::{Down, Ring, Symbolic, Tensor, Up};

/// The polynomial `K_ij v^i v^j + L_i v^i + C` in the velocity, whose coefficients are functions of
/// the coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityPolynomial {
    /// The symmetric components `K_ij`, slots `[Down, Down]`.
    pub quadratic: Tensor<Symbolic>,
    /// The components `L_i`, slots `[Down]`.
    pub linear: Tensor<Symbolic>,
    /// The value `C`.
    pub constant: Symbolic,
}

impl VelocityPolynomial {
    /// The polynomial 0 in a dimension.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large.
    pub fn zero(dimension: usize) -> Result<Self, Error> {
        Ok(VelocityPolynomial {
            quadratic: Tensor::zero(dimension, &[Down, Down])?,
            linear: Tensor::zero(dimension, &[Down])?,
            constant: Symbolic::default(),
        })
    }
}

impl ChartEquations {
    /// The momentum `p_i = m g_ij v^j + q A_i`.
    ///
    /// # Errors
    /// [`Error::NoMetric`].
    pub fn momentum(&self, i: usize) -> Result<VelocityPolynomial, Error> {
        let n = self.coordinates.len();
        let unit = Tensor::from_components(n, &[Up], [([i], Symbolic::from_i64(1))])?;
        self.momentum_along(&unit)
    }

    /// The momentum `m g(X, v) + q A(X)` along a vector field `X`, slots `[Up]`. It is conserved
    /// for a Killing field that leaves the potential and the vector potential invariant.
    ///
    /// # Errors
    /// [`Error::NoMetric`]; [`Error::Shape`].
    pub fn momentum_along(&self, field: &Tensor<Symbolic>) -> Result<VelocityPolynomial, Error> {
        let n = self.coordinates.len();
        expect_slots("the field", field, n, &[Up])?;
        let metric = self.metric.as_ref().ok_or(Error::NoMetric)?;
        let lowered = formula("g_ij X^j -> _i", &[("g", metric.components()), ("X", field)]);
        let along = formula("A_j X^j -> ", &[("A", &self.vector_potential), ("X", field)]);
        Ok(VelocityPolynomial {
            linear: lowered.scale(&self.mass),
            constant: along.get(&[]) * &self.charge,
            ..VelocityPolynomial::zero(n)?
        })
    }

    /// The square `g(v, v)`.
    ///
    /// # Errors
    /// [`Error::NoMetric`].
    pub fn norm(&self) -> Result<VelocityPolynomial, Error> {
        let metric = self.metric.as_ref().ok_or(Error::NoMetric)?;
        let zero = VelocityPolynomial::zero(self.coordinates.len())?;
        Ok(VelocityPolynomial { quadratic: metric.components().clone(), ..zero })
    }

    /// The energy `m g(v, v)/2 + V`.
    ///
    /// # Errors
    /// [`Error::NoMetric`].
    pub fn energy(&self) -> Result<VelocityPolynomial, Error> {
        let half = self.mass.clone() / &Symbolic::from_i64(2);
        let norm = self.norm()?;
        Ok(VelocityPolynomial {
            quadratic: norm.quadratic.scale(&half),
            constant: self.potential.clone(),
            ..norm
        })
    }

    /// Whether a polynomial in the velocity is constant along all curves.
    ///
    /// # Errors
    /// The errors of [`rate`](Self::rate).
    pub fn conserves(&self, polynomial: &VelocityPolynomial) -> Result<bool, Error> {
        Ok(self.rate(polynomial)?.is_empty())
    }

    /// Checks that a polynomial in the velocity is constant along all curves.
    ///
    /// # Errors
    /// [`Law::Conserved`] with the first term of its derivative; the errors of
    /// [`rate`](Self::rate).
    pub fn expect_conserved(
        &self,
        name: &str,
        polynomial: &VelocityPolynomial,
    ) -> Result<(), Error> {
        match self.rate(polynomial)?.into_iter().next() {
            None => Ok(()),
            Some((monomial, coefficient)) => {
                let velocities: Vec<String> =
                    monomial.iter().map(|i| format!("v_{}", self.coordinates[*i])).collect();
                let monomial = match &velocities[..] {
                    [] => "1".to_string(),
                    all => all.join("*"),
                };
                Err(Law::Conserved.broken([name.to_string(), monomial], coefficient.to_string()))
            }
        }
    }

    /// The derivative of a polynomial along the curves, as coefficients of the monomials in the
    /// velocity that do not vanish. A monomial is the sorted list of its indices.
    ///
    /// The derivative is `(nabla_i K_jk) v^i v^j v^k + (nabla_i L_j + 2 K_ip E^p_j) v^i v^j +
    /// (d_i C + 2 K_ip G^p + L_p E^p_i) v^i + L_p G^p`, where the forces per mass are
    /// `E^i_j v^j + G^i`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Symmetry`] if `K` is not symmetric.
    pub fn rate(
        &self,
        polynomial: &VelocityPolynomial,
    ) -> Result<Vec<(Vec<usize>, Symbolic)>, Error> {
        let VelocityPolynomial { quadratic: k, linear: l, constant: c } = polynomial;
        let n = self.coordinates.len();
        expect_slots("the polynomial", k, n, &[Down, Down])?;
        expect_slots("the polynomial", l, n, &[Down])?;
        crate::algebra::frame::expect_symmetry("the Killing tensor", k, [0, 1], 1)?;
        let (e, g, connection) = (&self.linear, &self.constant, &self.connection);
        let scalar = Tensor::from_components(n, &[], [([], c.clone())])?;
        let cubic = connection.nabla(k)?;
        let slope = connection.nabla(l)?;
        let quadratic =
            formula("d_ij + K_ip E^p_j + K_ip E^p_j -> _ij", &[("d", &slope), ("K", k), ("E", e)]);
        let slope = connection.frame().derivative(&scalar)?;
        let linear = formula(
            "d_i + K_ip G^p + K_ip G^p + L_p E^p_i -> _i",
            &[("d", &slope), ("K", k), ("G", g), ("L", l), ("E", e)],
        );
        let constant = formula("L_p G^p -> ", &[("L", l), ("G", g)]);
        let mut all = Vec::new();
        for part in [&cubic, &quadratic, &linear, &constant] {
            all.extend(collected(part));
        }
        Ok(all)
    }
}

/// The coefficients of the monomials `v^i v^j ...` in a form that is evaluated on equal vectors.
fn collected(form: &Tensor<Symbolic>) -> Vec<(Vec<usize>, Symbolic)> {
    let mut all = std::collections::BTreeMap::<Vec<usize>, Symbolic>::new();
    for (at, value) in form.components() {
        let mut monomial = at.to_vec();
        monomial.sort_unstable();
        let sum = all.remove(&monomial).unwrap_or_default() + value;
        all.insert(monomial, sum);
    }
    all.into_iter().filter(|(_, value)| !value.vanishes()).collect()
}
