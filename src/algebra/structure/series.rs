//! Series, centre, centralizers and normalizers (de Graaf 1.6, 1.7).

use super::{GroundField, StructureTheory, Subspace};
use affinor_tensors::linear::Row;

impl<S: GroundField> StructureTheory<S> {
    /// The span of the brackets of two subspaces.
    pub fn bracket(&self, v: &Subspace<S>, w: &Subspace<S>) -> Subspace<S> {
        let n = self.dimension();
        let mut span = Subspace::zero(n);
        for (at, x) in v.basis().iter().enumerate() {
            let ad = self.products.ad(x);
            let all = w.dimension() == n;
            let images: Vec<Row<S>> = match all {
                true => ad.columns().map(|(_, column)| column.clone()).collect(),
                false => {
                    let from = if v == w { at + 1 } else { 0 };
                    w.basis()[from.min(w.dimension())..].iter().map(|y| ad.image(y)).collect()
                }
            };
            for image in images {
                span.add(image);
            }
            if span.dimension() == n {
                break;
            }
        }
        span
    }

    /// The derived series `L, [L,L], [[L,L],[L,L]], ...`, until the terms no longer change.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("se(2)")?);
    /// let dimensions: Vec<usize> = algebra.derived_series().iter().map(|term| term.dimension()).collect();
    /// assert_eq!(dimensions, [3, 2, 0]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("commutator subalgebra"))]
    pub fn derived_series(&self) -> &[Subspace<S>] {
        self.derived.get_or_init(|| {
            if self.is_semisimple() {
                return vec![self.whole()];
            }
            descend(self.whole(), |v| self.bracket(v, v))
        })
    }

    /// The derived algebra `[L, L]`.
    pub fn derived(&self) -> &Subspace<S> {
        let series = self.derived_series();
        series.get(1).unwrap_or(&series[0])
    }

    /// The lower central series `L, [L,L], [[L,L],L], ...`, until the terms no longer change.
    pub fn lower_central_series(&self) -> &[Subspace<S>] {
        self.lower.get_or_init(|| {
            let whole = self.whole();
            if self.is_perfect() {
                return vec![whole];
            }
            let mut series = vec![whole.clone(), self.derived().clone()];
            let last = descend(self.derived().clone(), |v| self.bracket(v, &whole));
            series.extend(last.into_iter().skip(1));
            series
        })
    }

    /// The upper central series `0, Z, ...`, until the terms no longer change.
    pub fn upper_central_series(&self) -> Vec<Subspace<S>> {
        let n = self.dimension();
        let mut series = vec![Subspace::zero(n)];
        if self.is_semisimple() {
            return series;
        }
        loop {
            let last = &series[series.len() - 1];
            let next = self.transporter(&self.whole(), last);
            if next.dimension() == last.dimension() {
                return series;
            }
            series.push(next);
        }
    }

    /// The centre.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("heisenberg(3)")?);
    /// assert_eq!(algebra.centre().dimension(), 1);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("central"))]
    pub fn centre(&self) -> Subspace<S> {
        let zero = || Subspace::zero(self.dimension());
        let find = || match self.is_semisimple() {
            true => zero(),
            false => self.transporter(&self.whole(), &zero()),
        };
        self.centre.get_or_init(find).clone()
    }

    /// The vectors `x` of `v` for which `target` contains `[x, L]`.
    fn transporter(&self, v: &Subspace<S>, target: &Subspace<S>) -> Subspace<S> {
        let n = self.dimension();
        v.kernel_of(|x| {
            let ad = self.products.ad(x);
            let columns = ad.columns().flat_map(|(k, column)| {
                let rest = target.reduce(column.clone());
                rest.into_iter().map(move |(i, value)| (k * n + i, value))
            });
            columns.collect()
        })
    }

    /// The centralizer of a subspace: all `x` with `[x, V] = 0`.
    pub fn centralizer(&self, v: &Subspace<S>) -> Subspace<S> {
        v.basis().iter().fold(self.whole(), |kernel, y| {
            let ad = self.products.ad(y);
            kernel.kernel_of(|x| ad.image(x))
        })
    }

    /// The normalizer of a subspace: all `x` with `[x, V]` in `V`.
    pub fn normalizer(&self, v: &Subspace<S>) -> Subspace<S> {
        v.basis().iter().fold(self.whole(), |kernel, y| {
            let ad = self.products.ad(y);
            kernel.kernel_of(|x| v.reduce(ad.image(x)))
        })
    }

    /// The subalgebra that the vectors generate.
    pub fn generated(&self, vectors: impl IntoIterator<Item = Row<S>>) -> Subspace<S> {
        let mut span = Subspace::zero(self.dimension());
        let mut generators = vec![];
        for vector in vectors {
            if span.add(vector.clone()) {
                generators.push(self.products.ad(&vector));
            }
        }
        // computes only brackets with generators: repeated brackets with a generator on the left
        // span the whole subalgebra
        let mut open: Vec<Row<S>> = span.basis().to_vec();
        while let Some(x) = open.pop() {
            for ad in &generators {
                let image = ad.image(&x);
                if span.add(image.clone()) {
                    open.push(image);
                }
            }
        }
        span
    }

    /// Whether all brackets vanish.
    pub fn is_abelian(&self) -> bool {
        self.algebra.structure_constants().is_empty()
    }

    /// Whether `[L, L] = L`.
    pub fn is_perfect(&self) -> bool {
        self.derived_series().len() == 1
    }

    /// Whether the derived series ends with 0.
    pub fn is_solvable(&self) -> bool {
        self.derived_series().last().is_some_and(Subspace::is_zero)
    }

    /// Whether the lower central series ends with 0.
    pub fn is_nilpotent(&self) -> bool {
        self.is_solvable() && self.lower_central_series().last().is_some_and(Subspace::is_zero)
    }

    /// Whether `tr ad_x = 0` for all `x`.
    pub fn is_unimodular(&self) -> bool {
        (0..self.dimension()).all(|j| {
            let diagonal = self.products.of(j).iter().filter(|(k, i, _)| k == i);
            diagonal.fold(S::zero(), |sum, (.., value)| sum + value).vanishes()
        })
    }

    /// Whether the radical is the centre.
    pub fn is_reductive(&self) -> bool {
        let radical = self.radical();
        radical.is_zero() || radical == &self.centre()
    }

    /// Whether a subspace is an ideal: `[v, L]` is contained in `v`.
    ///
    /// ```
    /// use affinor::algebra::structure::{StructureTheory, Subspace};
    /// use affinor::{Rational, algebra::catalogue};
    /// let se3 = catalogue::algebra::<Rational>("se(3)")?;
    /// let structure = StructureTheory::new(se3);
    /// let span = |from: usize| Subspace::span(6, (from..from + 3).map(|i| vec![(i, 1.into())]));
    /// let (rotations, translations) = (span(0), span(3));
    /// assert!(structure.is_ideal(&translations) && !structure.is_ideal(&rotations));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn is_ideal(&self, v: &Subspace<S>) -> bool {
        v.includes(&self.bracket(v, &self.whole()))
    }
}

/// A descending series of subspaces. `next` computes each subspace from the previous subspace,
/// until the dimension is stable.
fn descend<S: GroundField>(
    first: Subspace<S>,
    next: impl Fn(&Subspace<S>) -> Subspace<S>,
) -> Vec<Subspace<S>> {
    let mut series = vec![first];
    loop {
        let last = &series[series.len() - 1];
        if last.is_zero() {
            return series;
        }
        let smaller = next(last);
        if smaller.dimension() == last.dimension() {
            return series;
        }
        series.push(smaller);
    }
}
