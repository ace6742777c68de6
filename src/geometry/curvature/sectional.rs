//! The sectional curvature.

use crate::Error;
use crate::algebra::frame::{expect_slots, formula};
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::{Field, Tensor, Up};

impl<S: Field> Connection<S> {
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
        let r = formula("R^i_jkl y^j -> ^i_kl", &[("R", self.curvature()), ("y", &y)]);
        let r = formula("R^i_kl x^k -> ^i_l", &[("R", &r), ("x", &x)]);
        let r = formula("R^i_l y^l -> ^i", &[("R", &r), ("y", &y)]);
        let area = product(&x, &x) * &product(&y, &y) - &(product(&x, &y) * &product(&x, &y));
        Ok(area.recip().map(|recip| product(&r, &x) * &recip))
    }
}
