//! Quadratic Casimir functions of reductive algebras, in any dimension.
//!
//! An invariant form `B` on the semisimple part is `K(A x, y)`, where `K` is the Killing form and
//! `A` is a map of the centroid. The inverse of `B` is an invariant quadratic form on the dual. The
//! centroid is a field on each ideal that is simple over the rationals. Therefore every invariant
//! quadratic form is `A K^-1`, and there is one such form for each simple factor over the complex
//! numbers.

use super::StructureTheory;
use super::subspace::primitive_factor;
use crate::Error;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Rational, Ring, Symbolic};
use num_traits::Zero;

impl StructureTheory<Rational> {
    /// Generators of the Casimir functions of degree 1 and 2 of a reductive algebra, as in
    /// [`casimirs`](Self::casimirs). They are a basis of the centre, and one quadratic form for
    /// each simple factor over the complex numbers. Returns `None` if the algebra is not reductive,
    /// or if its simple ideals are not found.
    ///
    /// ```
    /// use affinor::algebra::structure::StructureTheory;
    /// use affinor::{Rational, algebra::catalogue};
    /// let [so3, line] = ["so(3)", "R^1"].map(catalogue::algebra::<Rational>);
    /// let sum = StructureTheory::new(so3?.direct_sum(&line?)?);
    /// let casimirs = sum.quadratic_casimirs()?.expect("a reductive algebra");
    /// assert_eq!(casimirs[0].to_string(), "mu4");
    /// assert_eq!(casimirs[1].to_string(), "mu1^2 + mu2^2 + mu3^2");
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`subalgebra`](Self::subalgebra). They cannot occur for a Lie algebra.
    pub fn quadratic_casimirs(&self) -> Result<Option<Vec<Symbolic>>, Error> {
        let _stage = stage("casimirs");
        if !self.is_reductive() {
            return Ok(None);
        }
        let coordinates: Vec<Symbolic> =
            (1..=self.dimension()).map(|i| Symbolic::parameter(&format!("mu{i}"))).collect();
        let linear =
            |row: &Row<Rational>| written(row.iter().map(|(i, v)| (v, vec![*i])), &coordinates);
        let mut found: Vec<Symbolic> = self.centre().basis().iter().map(linear).collect();
        let levi = self.levi()?;
        if levi.is_zero() {
            return Ok(Some(found));
        }
        let inside = self.subalgebra(levi)?;
        let Some(ideals) = inside.simple_ideals()? else { return Ok(None) };
        for ideal in &ideals.rational {
            let part = inside.subalgebra(ideal)?;
            let Some(types) = part.dynkin_type() else { return Ok(None) };
            let Some(inverse) = part.killing_matrix().inverse() else { return Ok(None) };
            let centroid = match types.len() {
                1 => Some(vec![Matrix::identity(part.dimension())]),
                all => part.centroid(all),
            };
            let Some(centroid) = centroid else { return Ok(None) };
            let basis = levi.within(ideal);
            let vectors = Matrix::from_rows(self.dimension(), basis.basis().iter().cloned())?;
            for map in centroid {
                let form = vectors.transpose().mul(&map.mul(&inverse)?)?.mul(&vectors)?;
                let terms: Vec<(Rational, Vec<usize>)> = (0..form.rows())
                    .flat_map(|i| {
                        let row = form.row(i).iter().filter(move |(j, _)| i <= *j);
                        row.map(move |(j, value)| {
                            let factor = Rational::from(if i == *j { 1 } else { 2 });
                            (value.clone() * &factor, vec![i, *j])
                        })
                    })
                    .collect();
                found.push(written(terms.iter().map(|(v, at)| (v, at.clone())), &coordinates));
            }
        }
        Ok(Some(found))
    }
}

/// Writes a polynomial, scaled to coprime integer coefficients; the first coefficient is positive.
fn written<'a>(
    terms: impl Iterator<Item = (&'a Rational, Vec<usize>)>,
    coordinates: &[Symbolic],
) -> Symbolic {
    let terms: Vec<(&Rational, Vec<usize>)> = terms.filter(|(v, _)| !v.vanishes()).collect();
    let values: Vec<Rational> = terms.iter().map(|(value, _)| (*value).clone()).collect();
    let mut unit = primitive_factor(&values);
    if values.first().is_some_and(Rational::is_negative) {
        unit = -unit;
    }
    terms.into_iter().fold(Symbolic::zero(), |sum, (value, at)| {
        let term = Symbolic::constant(value.clone() * &unit);
        sum + &at.iter().fold(term, |product, i| product * &coordinates[*i])
    })
}
