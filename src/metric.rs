//! Metrics: symmetric, non-degenerate bilinear forms.

use crate::Error;
use crate::algebra::{LieAlgebra, inverse, to_matrix};
use crate::connection::Connection;
use crate::error::{combination, written};
use crate::frame::{expect_numbers, expect_slots, formula};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Notation, Rational, Tensor, Up};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A metric `g_ij` with its inverse `g^ij`; of any signature.
#[derive(Clone, Debug)]
pub struct Metric<S> {
    components: Tensor<S>,
    inverse: Tensor<S>,
}

impl<S: Field> Metric<S> {
    /// The metric with these components, slots `[Down, Down]`.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::NotSymmetric`]; [`Error::Degenerate`] with a
    /// vector of the kernel.
    pub fn new(labels: &Arc<[String]>, components: Tensor<S>) -> Result<Self, Error> {
        expect_slots("the metric", &components, labels.len(), &[Down, Down])?;
        expect_numbers("the metric", &components)?;
        let skew = formula("g_ij - g_ji -> _ij", &[("g", &components)]);
        if let Some((at, residual)) = skew.components().next() {
            return Err(Error::NotSymmetric {
                x: labels[at[0]].clone(),
                y: labels[at[1]].clone(),
                residual: written(residual),
            });
        }
        let tolerance = components.tolerance();
        let Some(entries) = inverse(&components) else {
            let kernel = to_matrix(&components).nullspace().ok();
            let null = kernel.map(|kernel| {
                let row = if kernel.rows() > 0 { kernel.row(0) } else { &[] };
                combination(row.iter().map(|(i, v)| (v, labels[*i].clone())))
            });
            return Err(Error::Degenerate { null: null.unwrap_or_default() });
        };
        // rounding must not make the inverse unsymmetric
        let upper = entries.into_iter().filter(|([i, j], _)| i <= j);
        let both = upper.flat_map(|([i, j], v)| {
            let mirrored = (i < j).then(|| ([j, i], v.clone()));
            [Some(([i, j], v)), mirrored].into_iter().flatten()
        });
        let inverse = Tensor::from_components(labels.len(), &[Up, Up], both)?;
        Ok(Metric { components, inverse: inverse.with_tolerance(tolerance) })
    }

    /// The components `g_ij`.
    pub fn components(&self) -> &Tensor<S> {
        &self.components
    }

    /// The inverse `g^ij`.
    pub fn inverse(&self) -> &Tensor<S> {
        &self.inverse
    }

    /// The trace `g^jl t_jl` of a bilinear form with the slots `_jl`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the form has these slots and the dimension of the metric.
    pub fn trace(&self, form: &Tensor<S>) -> Result<S, Error> {
        expect_slots("the form", form, self.components.dimension(), &[Down, Down])?;
        let trace = formula("g^jl t_jl ->", &[("g", &self.inverse), ("t", form)]);
        Ok(trace.to_scalar().expect("a tensor of rank 0"))
    }

    /// How the generators move the metric, slots `_kij`: `g_mj c^m_ki + g_im c^m_kj`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn ad_variation(&self, algebra: &LieAlgebra<S>) -> Result<Tensor<S>, Error> {
        self.expect_dimension(algebra.dimension())?;
        Connection::family(algebra, &S::from_i64(-1)).nabla(&self.components)
    }

    /// Whether the metric is bi-invariant: `g([z,x],y) + g(x,[z,y]) = 0`.
    pub fn is_bi_invariant(&self, algebra: &LieAlgebra<S>) -> bool {
        self.ad_variation(algebra).is_ok_and(|variation| variation.is_empty())
    }

    /// Checks that the metric is one of this dimension.
    pub(crate) fn expect_dimension(&self, dimension: usize) -> Result<(), Error> {
        expect_slots("the metric", &self.components, dimension, &[Down, Down])
    }

    /// The covector `v_i = g_ij v^j` (97).
    ///
    /// # Errors
    /// [`Error::Shape`] unless `v` has as many components as the metric has rows.
    pub fn lower(&self, v: &[S]) -> Result<Vec<S>, Error> {
        let v = Tensor::vector(v, Up);
        expect_slots("the vector", &v, self.components.dimension(), &[Up])?;
        let lowered = formula("g_ij v^j -> _i", &[("g", &self.components), ("v", &v)]);
        Ok(lowered.to_vector().expect("a tensor of rank 1"))
    }
}

impl<S: Field> Connection<S> {
    /// The nonmetricity `Q_kij = (nabla_k g)_ij`; zero when the metric is compatible.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn nonmetricity(&self, metric: &Metric<S>) -> Result<Tensor<S>, Error> {
        self.nabla(metric.components())
    }

    /// The scalar curvature `S = g^jl Ric_jl`.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn scalar_curvature(&self, metric: &Metric<S>) -> Result<S, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        metric.trace(&self.ricci())
    }

    /// The sectional curvature `K(x,y) = g(R(x,y)y, x) / (g(x,x) g(y,y) - g(x,y)^2)`; `None` where
    /// the plane is degenerate.
    ///
    /// # Errors
    /// [`Error::Shape`] unless the vectors and the metric have the dimension of the frame.
    pub fn sectional_curvature(
        &self,
        metric: &Metric<S>,
        x: &[S],
        y: &[S],
    ) -> Result<Option<S>, Error> {
        let n = self.frame().dimension();
        let (x, y) = (Tensor::vector(x, Up), Tensor::vector(y, Up));
        metric.expect_dimension(n)?;
        expect_slots("the first vector", &x, n, &[Up])?;
        expect_slots("the second vector", &y, n, &[Up])?;
        let g = metric.components();
        let product = |a: &Tensor<S>, b: &Tensor<S>| {
            let lowered = formula("g_ij a^i -> _j", &[("g", g), ("a", a)]);
            let value = formula("l_j b^j ->", &[("l", &lowered), ("b", b)]);
            value.to_scalar().expect("a tensor of rank 0")
        };
        // R(x,y)y, one argument at a time
        let r = formula("R^i_jkl y^j -> ^i_kl", &[("R", &self.curvature()), ("y", &y)]);
        let r = formula("R^i_kl x^k -> ^i_l", &[("R", &r), ("x", &x)]);
        let r = formula("R^i_l y^l -> ^i", &[("R", &r), ("y", &y)]);
        let area = product(&x, &x) * &product(&y, &y) - &(product(&x, &y) * &product(&x, &y));
        Ok(area.recip().map(|recip| product(&r, &x) * &recip))
    }
}

/// The independent equations that make all components of an exact tensor vanish: each result is
/// to be zero.
///
/// Numerators are taken as vectors over their monomials and reduced, so the equations are a basis
/// of the linear span of all that the components impose. For the nonmetricity of M(3) they say
/// that `J` is a multiple of the identity.
pub fn equations<S: Notation>(tensor: &Tensor<S>) -> Vec<S> {
    let polynomials: Vec<_> = tensor.components().map(|(_, v)| v.numerator_terms()).collect();
    let monomials: BTreeSet<_> = polynomials.iter().flatten().map(|(m, _)| m.clone()).collect();
    let columns: BTreeMap<_, _> = monomials.iter().zip(0..).collect();
    let rows = polynomials.iter().map(|terms| terms.iter().map(|(m, v)| (columns[m], v.clone())));
    let space = Matrix::from_rows(columns.len(), rows).ok().and_then(|m| m.echelon().ok());
    let monomials: Vec<S> = monomials
        .iter()
        .map(|powers| {
            let factors = powers.iter().filter_map(|(name, power)| {
                S::parameter(name).map(|parameter| num_traits::pow(parameter, *power as usize))
            });
            factors.fold(S::one(), |product, factor| product * &factor)
        })
        .collect();
    let polynomial = |row: &[(usize, Rational)]| {
        row.iter().fold(S::zero(), |sum, (at, coefficient)| {
            let coefficient = S::from_rational(coefficient).unwrap_or_else(S::zero);
            sum + &(monomials[*at].clone() * &coefficient)
        })
    };
    space.iter().flat_map(|space| space.rows().iter().map(|row| polynomial(row))).collect()
}
