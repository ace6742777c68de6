//! Einstein metrics and spaces of constant curvature.

use super::{Property, vanishing};
use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Scalar, Tensor, contraction};

impl<S: Field + Scalar> Connection<S> {
    /// Whether the Ricci tensor is a constant multiple of the metric, `Ric = c g`. The value of the
    /// property is `c`. For a Levi-Civita connection, the property means that the metric is
    /// Einstein.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// assert!(connection.einstein_constant(&round)?.holds().is_some());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    #[doc(alias("Einstein metric"))]
    pub fn einstein_constant(&self, metric: &Metric<S>) -> Result<Property<S, S>, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        let equation = |c: &S| format!("Ric_jl - ({c}) g_jl");
        let found = ratio(&self.ricci(), metric.components(), equation, "jl");
        self.constant(metric, found)
    }

    /// Whether the curvature is the curvature of a space form,
    /// `R^i_jkl = K (delta^i_k g_jl - delta^i_l g_jk)`. The value of the property is the constant
    /// `K`. In dimension 1, where every `K` is possible, the value is 0.
    ///
    /// # Errors
    /// [`Error::Shape`] when the dimensions differ.
    pub fn constant_curvature(&self, metric: &Metric<S>) -> Result<Property<S, S>, Error> {
        metric.expect_dimension(self.frame().dimension())?;
        let unit = formula(
            "d^i_k g_jl - d^i_l g_jk -> ^i_j[kl]",
            &[("d", &Tensor::identity(self.frame().dimension())), ("g", metric.components())],
        );
        let equation = |k: &S| format!("R^i_jkl - ({k}) (delta^i_k g_jl - delta^i_l g_jk)");
        self.constant(metric, ratio(self.curvature(), &unit, equation, "ijkl"))
    }

    /// Checks that the factor is constant, because it may be a function in a moving frame. Also
    /// checks the scalar curvature, which is a multiple of the factor, because derivatives of the
    /// factor may be unknown where the factor is zero.
    fn constant(&self, metric: &Metric<S>, found: Property<S, S>) -> Result<Property<S, S>, Error> {
        let Property::Holds(c) = found else { return Ok(found) };
        let frame = self.frame();
        let value = Tensor::from_components(frame.dimension(), &[], [([], c.clone())])?;
        let scalar = formula("I^jl R_jl -> ", &[("I", metric.inverse()), ("R", &self.ricci())]);
        let constant = match vanishing(&frame.derivative(&value)?, format!("e_k({c})"), "k") {
            Property::Holds(()) => vanishing(&frame.derivative(&scalar)?, "e_k(S)".into(), "k"),
            fails => fails,
        };
        Ok(constant.with(|()| c))
    }
}

/// Whether `a = c b`. The value of the property is the factor `c`, which is 0 if both tensors
/// vanish.
pub(super) fn ratio<S: Field + Scalar>(
    a: &Tensor<S>,
    b: &Tensor<S>,
    equation: impl Fn(&S) -> String,
    letters: &'static str,
) -> Property<S, S> {
    let pivots = b.components().filter_map(|(at, value)| Some((at, value, value.recip()?)));
    // the first component among those with the best pivot
    let best = pivots.min_by(|x, y| y.1.pivot_weight().total_cmp(&x.1.pivot_weight()));
    let c = best.map_or_else(S::zero, |(at, _, inverse)| a.get(&at) * &inverse);
    let slots = contraction::indices(letters.chars().zip(a.slots().iter().copied()));
    let scaled = b.scale(&c);
    let residual = formula(&format!("a{slots} - b{slots} -> {slots}"), &[("a", a), ("b", &scaled)]);
    vanishing(&residual, equation(&c), letters).with(|()| c)
}
