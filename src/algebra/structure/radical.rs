//! The solvable radical and the nilradical.

use super::{GroundField, StructureTheory, Subspace};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;

/// The number of elements with small coefficients that are tried first.
pub(super) const TRIALS: usize = 64;

/// The coefficients `1, t, t^2, ...`. A nonzero linear form vanishes at fewer than `count` values
/// of `t`. Therefore, after finitely many values of `t`, the combination with these coefficients
/// separates any finite set of linear forms.
pub(super) fn on_moment_curve<S: GroundField>(t: i64, count: usize) -> Vec<S> {
    let powers =
        std::iter::successors(Some(S::one()), |power| Some(power.clone() * &S::from_i64(t)));
    powers.take(count).collect()
}

impl<S: GroundField> StructureTheory<S> {
    /// The radical, the largest solvable ideal: the orthogonal complement of `[L, L]` for the
    /// Killing form (de Graaf 2.6).
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("gl(2)")?);
    /// // the scalar matrices
    /// assert_eq!(algebra.radical().dimension(), 1);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("solvable radical"))]
    pub fn radical(&self) -> &Subspace<S> {
        let _stage = stage("radical");
        self.radical.get_or_init(|| {
            let n = self.dimension();
            if self.is_semisimple() {
                return Subspace::zero(n);
            }
            if self.is_solvable() {
                return self.whole();
            }
            let derived = Matrix::from_rows(n, self.derived().basis().iter().cloned());
            let derived = derived.expect("vectors of the algebra");
            let forms = derived.mul(self.killing_matrix()).expect("vectors and a form");
            Subspace::kernel(n, (0..forms.rows()).map(|at| forms.row(at).to_vec()))
        })
    }

    /// The nilradical, the largest nilpotent ideal.
    ///
    /// The weights of the radical `R` on itself vanish on `[L, R]`, and the nilradical is the
    /// common kernel of the weights. Let `y` be an element on which distinct weights have distinct
    /// values. Then the nilradical is the set of all `x` in `R` with `tr(ad_x ad_y^k) = 0` on `R`
    /// for all `k`. For any `y`, this set contains the nilradical. So, if the set is a nilpotent
    /// ideal, it equals the nilradical.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("se(2)")?);
    /// // the translations
    /// assert_eq!(algebra.nilradical().dimension(), 2);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("nilpotent radical"))]
    pub fn nilradical(&self) -> Subspace<S> {
        let _stage = stage("nilradical");
        let radical = self.radical();
        if radical.is_zero() || self.is_nilpotent() {
            return radical.clone();
        }
        let inside = self.subalgebra(radical).expect("the radical is a subalgebra");
        if inside.is_nilpotent() {
            return radical.clone();
        }
        let lower = self.bracket(&self.whole(), radical);
        let lower = lower.basis().iter().filter_map(|row| radical.coordinates(row));
        let lower = Subspace::span(radical.dimension(), lower);
        let open: Vec<usize> = lower.complement().collect();
        let mut trial = 0;
        loop {
            trial += 1;
            let coefficients: Vec<S> = match trial <= TRIALS as i64 {
                true => {
                    let next = |power: &i64| Some((*power * trial + 1) % 101);
                    let powers = std::iter::successors(next(&1), next);
                    powers.map(S::from_i64).take(open.len()).collect()
                }
                // uses points of a moment curve, because distinct weights coincide only at a few of
                // its points
                false => on_moment_curve(trial - TRIALS as i64 + 1, open.len()),
            };
            let y: Row<S> = open.iter().copied().zip(coefficients).collect();
            let found = inside.weightless(&lower, &open, &y);
            let nilpotent =
                inside.subalgebra(&found).is_ok_and(|candidate| candidate.is_nilpotent());
            if nilpotent {
                return radical.within(&found);
            }
        }
    }

    /// The vectors `x` with `tr(ad_x ad_y^k) = 0` for all `k`. The search is among the subspace
    /// `lower` and combinations of the basis vectors `open`; all vectors of `lower` satisfy the
    /// equations.
    fn weightless(&self, lower: &Subspace<S>, open: &[usize], y: &Row<S>) -> Subspace<S> {
        let n = self.dimension();
        let matrix = |x: &[(usize, S)]| {
            let ad = self.products.ad(x);
            // stores the columns of ad as rows, which yields the transpose of ad
            Matrix::from_rows(n, (0..n).map(|k| ad.column(k).to_vec())).expect("a square matrix")
        };
        let ads: Vec<Matrix<S>> = open.iter().map(|&at| matrix(&[(at, S::one())])).collect();
        let y = matrix(y);
        let mut power = Matrix::identity(n);
        let mut equations = vec![];
        for _ in 0..n {
            let trace = |(at, ad): (usize, &Matrix<S>)| {
                let terms = ad.entries().map(|(i, j, value)| power.get(j, i) * value);
                let trace = terms.fold(S::zero(), |sum, term| sum + &term);
                (!trace.vanishes()).then_some((at, trace))
            };
            equations.push(ads.iter().enumerate().filter_map(trace).collect::<Row<S>>());
            power = power.mul(&y).expect("square matrices");
        }
        let kernel = Subspace::kernel(open.len(), equations);
        let vectors = kernel.basis().iter().map(|row| {
            row.iter().map(|(at, value)| (open[*at], value.clone())).collect::<Row<S>>()
        });
        lower.sum(&Subspace::span(n, vectors))
    }
}
