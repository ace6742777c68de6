//! Invariant metrics of homogeneous spaces: all of them, the Killing form, multiples on the isotropy
//! summands, and natural reductivity.

use super::{ReductivePair, restricted};
use crate::Error;
use crate::algebra::frame::formula;
use crate::algebra::structure::{GroundField, Killing};
use crate::algebra::to_matrix;
use crate::geometry::metric::Metric;
use crate::geometry::properties::{LinearSystem, Property, Witness, symmetric_invariants, triples};
use affinor_tensors::linear::Matrix;
use affinor_tensors::stop::stage;
use affinor_tensors::{Down, Field, Rational, Scalar, Tensor};

impl<S: Field + Scalar> ReductivePair<S> {
    /// A basis of the symmetric forms on `m` that are invariant under `h`, in reduced row echelon
    /// form. The invariant metrics are the nondegenerate combinations.
    ///
    /// ```
    /// use affinor::geometry::homogeneous::HomogeneousSpace;
    /// // the complex flags of three lines: one factor for each of three summands
    /// assert_eq!(HomogeneousSpace::find("Fl(3)")?.pair().invariant_forms()?.len(), 3);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Size`] for more than [`MAX_UNKNOWNS`](crate::algebra::invariants::MAX_UNKNOWNS)
    /// components.
    #[doc(alias("invariant metrics"))]
    pub fn invariant_forms(&self) -> Result<Vec<Tensor<S>>, Error> {
        let _stage = stage("invariant forms");
        symmetric_invariants(self.dimension(), &self.isotropy)
    }

    /// Whether an invariant metric is naturally reductive with respect to G: a complement of `h` that
    /// contains `[h, m]` satisfies `g([x,y]_m, z) + g(y, [x,z]_m) = 0`. Its geodesics through the
    /// origin are then the orbits of the one-parameter subgroups `exp(t x)`.
    ///
    /// The complements are `{x + phi(x)}` for linear maps `phi` of `m` into `h` with
    ///
    /// ```text
    /// phi([a,x]) = [a, phi(x)]                                                   for a in h
    /// g([x,y]_m, z) + g(y, [x,z]_m) + g([x,phi(y)], z) + g(y, [x,phi(z)]) = 0
    /// ```
    ///
    /// These equations are linear in `phi`. The witness is the first equation of the second kind that
    /// contradicts earlier equations. A larger group of isometries is not considered.
    ///
    /// ```
    /// use affinor::geometry::homogeneous::HomogeneousSpace;
    /// let sphere = HomogeneousSpace::find("S^7 = Sp(2)/Sp(1)")?;
    /// let normal = sphere.pair().killing_metric()?;
    /// assert!(sphere.pair().naturally_reductive(&normal)?.holds().is_some());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Law::IsotropyInvariance`](crate::Law::IsotropyInvariance) unless the
    /// metric is invariant.
    pub fn naturally_reductive(&self, metric: &Metric<S>) -> Result<Property<S>, Error> {
        let _stage = stage("naturally reductive");
        metric.expect_dimension(self.dimension())?;
        let (r, s, g) = (self.dimension(), self.isotropy.len(), metric.components());
        self.expect_invariant("the metric", g)?;
        let structure = self.frame.structure_functions();
        let variation = formula("g_mj c^m_ki + g_im c^m_kj -> _kij", &[("g", g), ("c", structure)]);
        let c = self.algebra.structure_constants();
        // g([e_k, h_a], e_j) for a basis vector h_a of h: minus the action of h_a on e_k
        let lowered = self.isotropy.iter();
        let lowered = lowered.map(|ad| formula("g_mj a^m_k -> _kj", &[("g", g), ("a", ad)]));
        let lowered: Vec<_> = lowered.collect();
        // in phi(e_i) = phi^a_i h_a, the unknown phi^a_i has the column a r + i
        let mut system = LinearSystem::new(s * r, variation.tolerance());
        for [b, i, d] in triples(s, r, s) {
            // the component along h_d of phi([h_b, e_i]) - [h_b, phi(e_i)]
            let image = (0..r).map(|j| (d * r + j, self.isotropy[b].get(&[j, i])));
            let bracket = (0..s).map(|a| (a * r + i, -c.get(&[r + d, r + b, r + a])));
            let terms = image.chain(bracket).filter(|(_, value)| !value.vanishes());
            // homogeneous equations never contradict each other
            system.add(terms.collect(), S::zero())?;
        }
        for [k, i, j] in triples(r, r, r) {
            let first = (0..s).map(|a| (a * r + i, -lowered[a].get(&[k, j])));
            let second = (0..s).map(|a| (a * r + j, -lowered[a].get(&[k, i])));
            let terms = first.chain(second).filter(|(_, value)| !value.vanishes());
            if let Some(residual) = system.add(terms.collect(), variation.get(&[k, i, j]))? {
                let equation = "g([e_k,e_i]_m,e_j) + g(e_i,[e_k,e_j]_m) + g([e_k,phi(e_i)],e_j) \
                                + g(e_i,[e_k,phi(e_j)])";
                return Ok(Property::Fails(Witness {
                    equation: equation.into(),
                    letters: "kij",
                    indices: vec![k, i, j],
                    residual,
                }));
            }
        }
        Ok(Property::Holds(()))
    }

    /// The Killing form of the algebra on `m`, slots `[Down, Down]`.
    ///
    /// # Errors
    /// No error occurs for a valid pair. An [`Error::Tensor`] of a computation is returned unchanged.
    pub fn killing_form(&self) -> Result<Tensor<S>, Error> {
        restricted(&self.algebra.killing_form(), self.dimension())
    }
}

impl<S: GroundField> ReductivePair<S> {
    /// The sign of [`killing_metric`](Self::killing_metric). It is 1 if the Killing form is positive
    /// definite on `m`, as for the dual of a compact symmetric space, and otherwise -1.
    ///
    /// # Errors
    /// Those of [`killing_form`](Self::killing_form).
    pub fn killing_sign(&self) -> Result<i64, Error> {
        let form = Killing::new(to_matrix(&self.killing_form()?));
        let positive = form.signature() == Some([self.dimension(), 0, 0]);
        Ok(if positive { 1 } else { -1 })
    }

    /// The metric `-B` on `m`, where `B` is the Killing form of the algebra. If `B` is positive
    /// definite on `m`, the metric is `B`. If G is compact and semisimple, the metric is normal.
    ///
    /// ```
    /// use affinor::geometry::homogeneous::HomogeneousSpace;
    /// let sphere = HomogeneousSpace::find("S^2")?;
    /// assert_eq!(sphere.pair().killing_metric()?.components().get(&[0, 0]), 2.into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Degenerate`] if the Killing form is degenerate on `m`.
    #[doc(alias("normal metric", "normal homogeneous"))]
    pub fn killing_metric(&self) -> Result<Metric<S>, Error> {
        let sign = S::from_i64(self.killing_sign()?);
        Metric::new(self.frame.labels(), self.killing_form()?.scale(&sign))
    }
}

impl ReductivePair<Rational> {
    /// The form of [`killing_metric`](Self::killing_metric), restricted to each isotropy summand:
    /// every invariant metric is a combination of them. The order is the order of
    /// [`isotropy_components`](Self::isotropy_components).
    ///
    /// # Errors
    /// [`Error::Unsupported`] if two summands are equivalent, or if a summand is not irreducible over
    /// the real numbers. Also if `m` is not the sum of the components. The errors of
    /// [`isotropy_components`](Self::isotropy_components).
    pub fn summand_forms(&self) -> Result<Vec<Tensor<Rational>>, Error> {
        let components = self.isotropy_components()?;
        let r = self.dimension();
        for (at, component) in components.iter().enumerate() {
            if component.summands.is_none_or(|(count, _)| count != 1) {
                let reason = match component.summands {
                    Some((count, _)) => format!("{count} equivalent summands"),
                    None => "summands that are not known".into(),
                };
                let dimension = component.subspace.dimension();
                return Err(Error::Unsupported(format!(
                    "the isotropy component {} of dimension {dimension} has {reason}, \
                     so that it has no factor of its own",
                    at + 1
                )));
            }
        }
        let vectors = components.iter().map(|component| component.subspace.dense());
        let vectors: Vec<Vec<Vec<Rational>>> = vectors.collect();
        let all = Matrix::from_dense(&vectors.concat())?;
        let Some(inverse) = all.inverse().filter(|_| all.rows() == r) else {
            return Err(Error::Unsupported(
                "the complement is not a sum of isotropy summands".into(),
            ));
        };
        let sign = Rational::from(self.killing_sign()?);
        let form = to_matrix(&self.killing_form()?.scale(&sign));
        let mut before = 0;
        let forms = vectors.iter().map(|own| {
            // row i of `inverse` contains the components of e_i along the vectors of the summands
            let range = before..before + own.len();
            before += own.len();
            let row = |i: usize| range.clone().map(|a| inverse.get(i, a)).collect::<Vec<_>>();
            let along = Matrix::from_dense(&(0..r).map(row).collect::<Vec<_>>())?;
            let projection = along.mul(&Matrix::from_dense(own)?)?;
            let form = projection.mul(&form)?.mul(&projection.transpose())?;
            let entries = form.entries().map(|(i, j, value)| ([i, j], value.clone()));
            Ok(Tensor::from_components(r, &[Down, Down], entries.collect::<Vec<_>>())?)
        });
        forms.collect()
    }
}
