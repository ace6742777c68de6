//! Levi subalgebras: semisimple complements of the radical (de Graaf 4.7, 4.13).

use super::subspace::{collected, combination};
use super::{GroundField, StructureTheory, Subspace};
use crate::Error;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;

impl<S: GroundField> StructureTheory<S> {
    /// A Levi subalgebra. It is not unique, but all Levi subalgebras are conjugate (Malcev).
    ///
    /// If a smaller algebra maps onto `L/R`, its Levi subalgebras are also Levi subalgebras of `L`.
    /// The normalizer of a Cartan subalgebra of the radical is such an algebra (Frattini), and so
    /// is the last term of the derived series. A complement of the remaining radical is lifted
    /// through the lower central series of the radical, by linear equations (de Graaf, Ivanyos,
    /// Kuronya, Rónyai, *AAECC* 8 (1997) 291-303).
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("gl(2)")?);
    /// assert_eq!(algebra.levi()?.dimension(), 3);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`subalgebra`](Self::subalgebra). They cannot occur for a Lie algebra.
    #[doc(alias("Levi decomposition", "semisimple part"))]
    pub fn levi(&self) -> Result<&Subspace<S>, Error> {
        let _stage = stage("levi");
        if let Some(levi) = self.levi.get() {
            return Ok(levi);
        }
        let levi = self.find_levi()?;
        Ok(self.levi.get_or_init(|| levi))
    }

    fn find_levi(&self) -> Result<Subspace<S>, Error> {
        let radical = self.radical();
        if self.is_solvable() {
            return Ok(Subspace::zero(self.dimension()));
        }
        if radical.is_zero() {
            return Ok(self.whole());
        }
        let inside = self.subalgebra(radical)?;
        let smaller = match inside.is_nilpotent() {
            false => self.normalizer(&radical.within(&inside.cartan_subalgebra())),
            true => self.derived_series().last().cloned().unwrap_or_else(|| self.whole()),
        };
        if smaller.dimension() < self.dimension() {
            let levi = self.subalgebra(&smaller)?.find_levi()?;
            return Ok(smaller.within(&levi));
        }
        self.lift(&inside)
    }

    /// Corrects a complement of a nilpotent radical, so that it becomes a subalgebra. The
    /// corrections are computed modulo each term of the lower central series of the radical.
    fn lift(&self, inside: &StructureTheory<S>) -> Result<Subspace<S>, Error> {
        let (n, radical) = (self.dimension(), self.radical());
        let mut lifted: Vec<Row<S>> = radical.complement().map(|at| vec![(at, S::one())]).collect();
        let quotient: Vec<usize> = radical.complement().collect();
        let series: Vec<Subspace<S>> =
            inside.lower_central_series().iter().map(|term| radical.within(term)).collect();
        for pair in series.windows(2) {
            let (upper, lower) = (&pair[0], &pair[1]);
            // a basis of the upper term modulo the lower term
            let mut span = lower.clone();
            let factor: Vec<&Row<S>> =
                upper.basis().iter().filter(|row| span.add((*row).clone())).collect();
            let (s, d) = (lifted.len(), factor.len());
            let ads: Vec<_> = lifted.iter().map(|x| self.products.ad(x)).collect();
            // the unknown corrections are y_i = sum of u_(i d + a) factor_a
            let moved: Vec<Vec<Row<S>>> = ads
                .iter()
                .map(|ad| factor.iter().map(|v| lower.reduce(ad.image(v))).collect())
                .collect();
            let (mut rows, mut right) = (vec![], vec![]);
            for i in 0..s {
                for j in i + 1..s {
                    let bracket = ads[i].image(&lifted[j]);
                    let reduced = radical.reduce(bracket.clone());
                    let sigma: Row<S> = reduced
                        .iter()
                        .filter_map(|(at, value)| {
                            Some((quotient.binary_search(at).ok()?, value.clone()))
                        })
                        .collect();
                    let expected = combination(&lifted, &sigma);
                    let minus = |row: Row<S>| row.into_iter().map(|(at, v)| (at, -v));
                    let residual: Row<S> = bracket.into_iter().chain(minus(expected)).collect();
                    let residual = lower.reduce(collected(residual));
                    let mut equations: std::collections::BTreeMap<usize, Row<S>> =
                        Default::default();
                    let mut put = |unknown: usize, image: &Row<S>, sign: &S| {
                        for (at, value) in image {
                            let entry = (unknown, value.clone() * sign);
                            equations.entry(*at).or_default().push(entry);
                        }
                    };
                    for a in 0..d {
                        put(j * d + a, &moved[i][a], &S::one());
                        put(i * d + a, &moved[j][a], &-S::one());
                        let own = lower.reduce(factor[a].clone());
                        for (k, value) in &sigma {
                            put(k * d + a, &own, &-value.clone());
                        }
                    }
                    for (at, _) in &residual {
                        equations.entry(*at).or_default();
                    }
                    for (at, row) in equations {
                        rows.push(row);
                        let value = residual.iter().find(|(i, _)| *i == at);
                        right.push(value.map_or_else(S::zero, |(_, v)| -v.clone()));
                    }
                }
            }
            let solution = Matrix::from_rows(s * d, rows)?.solve(&right)?;
            let solution = solution.expect("Levi's theorem: the equations have a solution");
            for (i, x) in lifted.iter_mut().enumerate() {
                let terms = (0..d).flat_map(|a| {
                    let value = solution[i * d + a].clone();
                    factor[a].iter().map(move |(at, v)| (*at, v.clone() * &value))
                });
                *x = collected(x.iter().cloned().chain(terms).collect());
            }
        }
        Ok(Subspace::span(n, lifted))
    }
}
