//! Invariant fields of any Lie algebra in canonical coordinates.

use super::exponential::exponential;
use super::{Chart, Fields};
use crate::algebra::{inverse, to_matrix};
use crate::{Error, LieAlgebra};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Ring, Symbolic, Tensor, Up, Variance};
use num_traits::One;

/// Which translations keep the fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left-invariant fields: structure constants `c`.
    Left,
    /// Right-invariant fields: structure constants `-c`.
    Right,
}

/// How coordinates name group elements near the identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Canonical {
    /// `g = exp(x^1 e_1 + ... + x^n e_n)`.
    First,
    /// `g = exp(x^1 e_1) ... exp(x^n e_n)`.
    Second,
}

impl Chart {
    /// The invariant fields through the basis of an algebra, near the identity of a group with
    /// this algebra. They are dual to the forms `g^-1 dg` (left) or `dg g^-1` (right), which are
    ///
    /// ```text
    /// first kind    T_left(x) dx, T_right(x) dx      T_left(x) = sum (-ad_x)^k/(k+1)!
    /// second kind   exp(-x^n ad_n) .. exp(-x^{a+1} ad_{a+1}) e_a dx^a,
    ///               exp(x^1 ad_1) .. exp(x^{a-1} ad_{a-1}) e_a dx^a
    /// ```
    ///
    /// S. Helgason, *Differential Geometry, Lie Groups, and Symmetric Spaces* (1978), II.1.
    ///
    /// ```
    /// use affinor::chart::{Canonical, Chart, Side};
    /// use affinor::{Bracket, LieAlgebra};
    /// use affinor_tensors::{Ring, Symbolic};
    /// // the rotations and translations of a plane
    /// let plane = Bracket::from_fn(&["turn", "right", "up"], |j, k| match (j, k) {
    ///     (0, 1) => vec![(2, Symbolic::from_i64(1))],
    ///     (0, 2) => vec![(1, Symbolic::from_i64(-1))],
    ///     _ => vec![],
    /// })?;
    /// let plane = LieAlgebra::try_from(plane)?;
    /// let chart = Chart::new(&["t", "x", "y"])?;
    /// let fields = chart.invariant_fields(&plane, Canonical::Second, Side::Right)?;
    /// assert_eq!(fields.written()[1], "cos(t)*d_x - sin(t)*d_y");
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotNilpotent`] for the first kind, whose series must end; [`Error::Eigenvalue`] for
    /// the second kind where an `ad_m` has eigenvalues other than `a + ib` with small integers;
    /// [`Error::Shape`], and [`Error::Coordinate`] for one that is a parameter of the algebra.
    pub fn invariant_fields(
        &self,
        algebra: &LieAlgebra<Symbolic>,
        kind: Canonical,
        side: Side,
    ) -> Result<Fields<Symbolic>, Error> {
        let used = algebra.structure().components().flat_map(|(_, value)| value.parameters());
        if let Some(name) = used.into_iter().find(|name| self.coordinates().contains(name)) {
            return Err(Error::Coordinate { name });
        }
        let x: Vec<Symbolic> = self.coordinates().iter().map(|x| Symbolic::parameter(x)).collect();
        // also checks the dimension
        let ad_x = to_matrix(&algebra.ad(&x)?);
        let forms = match kind {
            Canonical::First => first_kind(&ad_x, side)?,
            Canonical::Second => second_kind(self, algebra, side)?,
        };
        let slots = [Up, Variance::Down];
        let forms = forms.entries().map(|(i, a, value)| ([i, a], value.clone()));
        let forms = Tensor::from_components(self.dimension(), &slots, forms)?;
        let fields = inverse(&forms).ok_or(Error::SingularBasis)?;
        let fields = Tensor::from_components(self.dimension(), &slots, fields)?;
        self.fields(algebra.labels().clone(), fields)
    }
}

/// `sum (-ad_x)^k/(k+1)!`, or `sum ad_x^k/(k+1)!` on the right.
fn first_kind(ad_x: &Matrix<Symbolic>, side: Side) -> Result<Matrix<Symbolic>, Error> {
    let n = ad_x.rows();
    let step = if side == Side::Left { ad_x.map(|v| -v.clone()) } else { ad_x.clone() };
    let (mut sum, mut term) = (Matrix::zero(n, n), Matrix::identity(n));
    for k in 0..=n as i64 {
        sum = sum.add(&term)?;
        let share = Symbolic::one() / &Symbolic::from_i64(k + 2);
        term = step.mul(&term)?.map(|value| value.clone() * &share);
    }
    match term.entries().next() {
        None => Ok(sum),
        Some((i, j, _)) => {
            let (i, j) = (i + 1, j + 1);
            Err(Error::NotNilpotent { component: format!("(ad_x)^{}, row {i}, column {j}", n + 1) })
        }
    }
}

fn second_kind(
    chart: &Chart,
    algebra: &LieAlgebra<Symbolic>,
    side: Side,
) -> Result<Matrix<Symbolic>, Error> {
    let n = algebra.dimension();
    let mut exponentials = Vec::new();
    let names = chart.coordinates().iter().zip(algebra.labels().iter());
    for ((x, label), e) in names.zip(algebra.basis()) {
        let ad = to_matrix(&algebra.ad(&e)?);
        let ad = if side == Side::Left { ad.map(|v| -v.clone()) } else { ad };
        exponentials.push(exponential(&ad, x, label)?);
    }
    let columns = algebra.basis().enumerate().map(|(a, e)| {
        let others: Vec<usize> = match side {
            Side::Left => (a + 1..n).collect(),
            Side::Right => (0..a).rev().collect(),
        };
        let apply = |e: Vec<_>, m: usize| exponentials[m].apply(&e).expect("a square matrix");
        others.into_iter().fold(e, apply)
    });
    let columns: Vec<Vec<Symbolic>> = columns.collect();
    Ok(Matrix::from_dense(&columns).expect("columns of one length").transpose())
}
