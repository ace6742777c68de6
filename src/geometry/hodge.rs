//! The Hodge star, the codifferential and the Laplacian of differential forms.
//!
//! Let `g` have `q` negative squares, and let `vol` be the volume form of the frame: it is
//! `vol(e_1, ..., e_n) = s > 0` with `s^2 = |det g|`. For a form of degree `p`,
//!
//! ```text
//! (*w)_{j...} = 1/p! w^{i1...ip} vol_{i1...ip j...},   a ^ *b = <a, b> vol,   ** = (-1)^(p(n-p) + q)
//! (delta w)_{j...} = -g^{ik} (nabla_k w)_{i j...} = (-1)^(n(p+1) + 1 + q) * d * w
//! Delta = d delta + delta d
//! ```
//!
//! On functions, `Delta f = -div grad f`: the Laplacian of Hodge and de Rham is the negative of the
//! operator of Laplace and Beltrami. Its eigenvalues on a compact Riemannian space are not
//! negative (F. W. Warner, *Foundations of Differentiable Manifolds and Lie Groups* (1983), chapter 6).
//! The codifferential and the Laplacian need no orientation and no root of the determinant.

use crate::Error;
use crate::algebra::frame::{expect_slots, formula};
use crate::algebra::to_matrix;
use crate::geometry::connection::Connection;
use crate::geometry::forms::Form;
use crate::geometry::isometry::signature_at_sample;
use crate::geometry::metric::Metric;
use crate::geometry::roots::Roots;
use affinor_tensors::scalar::PositiveFactors;
use affinor_tensors::stop::{checkpoint, stage};
use affinor_tensors::{Down, Field, Scalar, Symbolic, Tensor};
use std::collections::BTreeMap;

impl<S: Field + Scalar> Metric<S> {
    /// The Hodge star of a form, where `volume` is the value `s` of the volume form on the frame. Its
    /// square is the determinant of the metric up to sign, which is not checked. The other root
    /// belongs to the opposite orientation.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let e = so3.left_frame().coframe();
    /// let metric = Metric::diagonal([1, 4, 9].map(Rational::from))?;
    /// // *e^1 = 6 e^2 ^ e^3
    /// let star = metric.hodge_star(&e[0], &6.into())?;
    /// assert_eq!(star.components().get(&[1, 2]), 6.into());
    /// assert_eq!(metric.hodge_star(&star, &6.into())?, e[0]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Tensor`] beyond dimension 8.
    #[doc(alias("Hodge dual"))]
    pub fn hodge_star(&self, form: &Form<S>, volume: &S) -> Result<Form<S>, Error> {
        let _stage = stage("star");
        let (n, p) = (self.components().dimension(), form.degree());
        expect_slots("the form", form.components(), n, &vec![Down; p])?;
        let mut raised = form.components().clone();
        for slot in 0..p {
            raised = raised.raise(slot, self.inverse())?;
        }
        let mut entries = BTreeMap::new();
        for (at, value) in raised.components() {
            checkpoint();
            if at.windows(2).all(|pair| pair[0] < pair[1]) {
                let rest: Vec<usize> = (0..n).filter(|j| !at.contains(j)).collect();
                // each index of `at` moves past the smaller indices of the rest
                let moves =
                    at.iter().map(|i| rest.iter().filter(|j| *j < i).count()).sum::<usize>();
                let value = value.clone() * volume;
                entries.insert(rest, if moves % 2 == 1 { -value } else { value });
            }
        }
        Form::from_increasing(n, n - p, entries)
    }

    /// The product of two forms of the same degree, `<a, b> = 1/p! a_{i1...ip} b^{i1...ip}`.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions or degrees differ.
    pub fn form_product(&self, a: &Form<S>, b: &Form<S>) -> Result<S, Error> {
        let (n, p) = (self.components().dimension(), a.degree());
        expect_slots("the first form", a.components(), n, &vec![Down; p])?;
        expect_slots("the second form", b.components(), n, &vec![Down; p])?;
        let mut raised = a.components().clone();
        for slot in 0..p {
            raised = raised.raise(slot, self.inverse())?;
        }
        let increasing = |at: &[usize]| at.windows(2).all(|pair| pair[0] < pair[1]);
        let terms = raised.components().filter(|(at, _)| increasing(at));
        let terms = terms.map(|(at, value)| value.clone() * &b.components().get(&at));
        Ok(terms.fold(S::zero(), |sum, term| sum + &term))
    }
}

impl<S: Field + Scalar> Connection<S> {
    /// The codifferential `(delta w)_{j...} = -g^{ik} (nabla_k w)_{i j...}` of a form. The connection
    /// must be the Levi-Civita connection of the metric. The codifferential of a function is zero, of
    /// degree 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if the dimensions differ; [`Error::Tensor`] beyond degree 7.
    #[doc(alias("divergence"))]
    pub fn codifferential(&self, metric: &Metric<S>, form: &Form<S>) -> Result<Form<S>, Error> {
        let _stage = stage("codifferential");
        let (n, p) = (self.frame().dimension(), form.degree());
        metric.expect_dimension(n)?;
        expect_slots("the form", form.components(), n, &vec![Down; p])?;
        if p == 0 {
            return Form::new(Tensor::zero(n, &[])?);
        }
        let nabla = self.nabla(form.components())?;
        let rest = &"abcdefgh"[..p - 1];
        let lower = |letters: &str| match letters {
            "" => String::new(),
            letters => format!("_{letters}"),
        };
        let text = format!("g^ik D_ki{rest} -> {}", lower(rest));
        let components = formula(&text, &[("g", metric.inverse()), ("D", &nabla)]);
        let increasing =
            components.components().filter(|(at, _)| at.windows(2).all(|p| p[0] < p[1]));
        // the other components follow exactly, also in floats
        Form::from_increasing(n, p - 1, increasing.map(|(at, v)| (at.to_vec(), -v.clone())))
    }

    /// The Laplacian of Hodge and de Rham, `d delta + delta d`, of a form. The connection must be the
    /// Levi-Civita connection of the metric.
    ///
    /// ```
    /// use affinor::{Chart, Connection, Down, Form, Metric, Symbolic, Tensor};
    /// // the plane in polar coordinates: r^2 has the Laplacian -4
    /// let chart = Chart::new(["r", "phi"])?;
    /// let [one, square]: [Symbolic; 2] = ["1".parse()?, "r^2".parse()?];
    /// let g = Tensor::from_components(2, &[Down, Down], [([0, 0], one), ([1, 1], square.clone())])?;
    /// let metric = Metric::new(chart.labels(), g)?;
    /// let connection = Connection::levi_civita(&chart.coordinate_frame()?, &metric)?;
    /// let function = Form::new(Tensor::from_components(2, &[], [([], square)])?)?;
    /// let laplacian = connection.hodge_laplacian(&metric, &function)?;
    /// assert_eq!(laplacian.components().get(&[]).to_string(), "-4");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`codifferential`](Self::codifferential) and
    /// [`exterior_derivative`](crate::Frame::exterior_derivative).
    #[doc(alias("Laplace-de Rham", "Laplace-Beltrami"))]
    pub fn hodge_laplacian(&self, metric: &Metric<S>, form: &Form<S>) -> Result<Form<S>, Error> {
        let _stage = stage("laplacian");
        let n = self.frame().dimension();
        let mut parts = vec![];
        if form.degree() > 0 {
            let inner = self.codifferential(metric, form)?;
            parts.push(self.frame().exterior_derivative(&inner)?);
        }
        if form.degree() < n {
            let outer = self.frame().exterior_derivative(form)?;
            parts.push(self.codifferential(metric, &outer)?);
        }
        let mut sum = Tensor::zero(n, form.components().slots())?;
        for part in parts {
            sum = &sum + part.components();
        }
        Form::new(sum)
    }
}

impl Metric<Symbolic> {
    /// The value `s > 0` of the volume form on the frame, `s^2 = |det g|`, and the functions that are
    /// assumed to be positive for it. Squares in the determinant have the root that is positive at
    /// some point, so that the volume of the sphere is `sin(theta)`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the root has factors of unknown sign, or if the sign of the
    /// determinant is not found at a rational point.
    #[doc(alias("volume form", "Levi-Civita symbol"))]
    pub fn volume(&self, positive: PositiveFactors) -> Result<(Symbolic, Vec<Symbolic>), Error> {
        let g = self.components();
        let determinant = to_matrix(g).determinant()?;
        let Some([_, minus]) = signature_at_sample(g, positive.factors()) else {
            return Err(Error::Unsupported(
                "the sign of the determinant is unknown: no sample point is rational".into(),
            ));
        };
        let determinant = if minus % 2 == 1 { -determinant } else { determinant };
        let mut roots = Roots::new(positive);
        roots.sample(std::slice::from_ref(&determinant));
        let volume = roots.root(&determinant)?;
        Ok((volume, roots.assumed()))
    }
}
