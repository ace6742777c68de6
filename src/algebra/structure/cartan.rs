//! Cartan subalgebras: nilpotent subalgebras that are their own normalizers (de Graaf 3.2).

use super::radical::TRIALS;
use super::{GroundField, StructureTheory, Subspace};
use affinor_tensors::linear::modular::ResidueMatrix;
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use std::cmp::Ordering;

impl<S: GroundField> StructureTheory<S> {
    /// A Cartan subalgebra. It is the null component of `ad x` for an element `x` whose null
    /// component is nilpotent; every null component is its own normalizer.
    ///
    /// The first candidates for `x` alternate between sums of commuting basis vectors, which yield
    /// short numbers, and sums of more and more basis vectors. For `m` commuting vectors, an
    /// algebra may have about `m^2` roots, so the coefficients have about this size. With smaller
    /// coefficients, some root would vanish on the element. Finally, sums of all basis vectors are
    /// tried until one succeeds.
    pub fn cartan_subalgebra(&self) -> Subspace<S> {
        let _stage = stage("cartan");
        self.cartan.get_or_init(|| self.search_cartan_subalgebra()).clone()
    }

    fn search_cartan_subalgebra(&self) -> Subspace<S> {
        let n = self.dimension();
        if self.is_nilpotent() {
            return self.whole();
        }
        let rank = self.rank_of_semisimple();
        let commuting = self.commuting_basis_vectors(|_| true);
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let mut draw = move |below: usize| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize % below.max(1)
        };
        let mut best: Option<Subspace<S>> = None;
        let large = commuting.len() * commuting.len() / 2;
        let mut trials = 0;
        loop {
            let trial = trials;
            trials += 1;
            let mut weight = |below: usize| S::from_i64(1 + draw(below) as i64);
            let mut x: Row<S> = vec![];
            if trial >= TRIALS {
                x.extend((0..n).map(|at| (at, weight(1 << 30))));
            } else if trial % 2 == 0 {
                x.extend(commuting.iter().map(|&at| (at, weight(large.max(4 + 4 * trial)))));
            } else {
                for _ in 0..(2 + trial / 2).min(n) {
                    x.push((draw(n), S::from_i64(1 + draw(4 + 4 * trial) as i64)));
                }
            }
            let x = super::subspace::collected(x);
            if let Some(rank) = rank {
                // if the rank is known, a dimension equal to the rank is sufficient, because Cartan
                // subalgebras are the null components of smallest dimension
                match self.null_component_of_dimension(&x, rank) {
                    Some(null) => return null,
                    None => continue,
                }
            }
            let null = self.null_component(&x);
            let smaller = best.as_ref().is_none_or(|best| null.dimension() < best.dimension());
            if smaller {
                let sub = self.subalgebra(&null).expect("a null component is a subalgebra");
                if sub.is_nilpotent() {
                    return null;
                }
                best = Some(null);
            }
        }
    }

    /// The rank of a semisimple algebra, from its types.
    fn rank_of_semisimple(&self) -> Option<usize> {
        let types = self.dynkin_type().filter(|_| self.is_semisimple())?;
        Some(types.iter().map(|one| one.rank()).sum())
    }

    /// Whether brackets of basis vectors have more than two terms on average. In such a basis, the
    /// numbers in rational eliminations become long.
    fn is_dense(&self) -> bool {
        let n = self.dimension();
        let constants: usize = (0..n).map(|j| self.products.of(j).len()).sum();
        constants > 2 * n * n
    }

    /// The null component of `ad x` in a semisimple algebra, if its dimension equals the rank; the
    /// null component then is the kernel. The dimension modulo a prime is an upper bound, and the
    /// rank is a lower bound over the rationals.
    fn null_component_of_dimension(&self, x: &[(usize, S)], rank: usize) -> Option<Subspace<S>> {
        let n = self.dimension();
        if !self.is_dense() {
            let ad = self.products.ad(x);
            let kernel = self.whole().kernel_of(|v| ad.image(v));
            // if the Killing form is nondegenerate on the kernel, the kernel and the image
            // intersect in zero, because they are orthogonal
            let basis = Matrix::from_rows(n, kernel.basis().iter().cloned()).ok()?;
            let form = basis.mul(self.killing_matrix()).ok()?.mul(&basis.transpose()).ok()?;
            return (kernel.dimension() == rank && form.rank().ok()? == rank).then_some(kernel);
        }
        let regular = self.semisimple_reductions().find_map(|reduction| {
            let prime = reduction.prime();
            let mut dense = vec![0; n];
            for (at, value) in x {
                dense[*at] = value.residue(prime)?;
            }
            let ad = reduction.ad(&dense);
            let kernel = ad.clone().kernel();
            // checks that no nonzero vector of the kernel is in the image
            let image = (0..n).map(|k| ad.rows().iter().map(|row| row[k]).collect()).collect();
            let mut image = ResidueMatrix::new(prime, n, image);
            image.reduce();
            let both = ResidueMatrix::new(prime, n, [image.rows(), &kernel[..]].concat()).rank();
            Some(kernel.len() == rank && both == n)
        });
        if regular != Some(true) {
            return None;
        }
        let mut rows = vec![vec![]; n];
        for (k, column) in self.products.ad(x).columns() {
            column.iter().for_each(|(i, value)| rows[*i].push((k, value.clone())));
        }
        Subspace::lifted_kernel(n, &rows).or_else(|| Some(self.null_component(x)))
    }

    /// The subspace of the vectors that some power of `ad x` maps to zero.
    pub fn null_component(&self, x: &[(usize, S)]) -> Subspace<S> {
        let ad = self.products.ad(x);
        let mut kernel = Subspace::zero(self.dimension());
        loop {
            let next = self.whole().kernel_of(|v| kernel.reduce(ad.image(v)));
            if next.dimension() == kernel.dimension() {
                return kernel;
            }
            kernel = next;
        }
    }

    /// A Cartan subalgebra of a semisimple algebra that contains commuting basis vectors. As many
    /// of these as possible have positive Killing squares. Returns `None` if the null component of
    /// the chosen vectors has a dimension larger than the rank.
    pub(super) fn hyperbolic_cartan_subalgebra(&self, rank: usize) -> Option<Subspace<S>> {
        let positive = |square: &S| square.sign() == Some(Ordering::Greater);
        let chosen = self.commuting_basis_vectors(positive);
        // the weights are powers of 3, so that the combination is generic
        let mut weight = S::one();
        let mut x: Row<S> = vec![];
        for at in chosen {
            x.push((at, weight.clone()));
            weight = weight * &S::from_i64(3);
        }
        self.null_component_of_dimension(&x, rank)
    }

    /// Chooses commuting basis vectors with nonzero Killing squares. Vectors whose square is
    /// `preferred` are chosen first.
    fn commuting_basis_vectors(&self, preferred: impl Fn(&S) -> bool) -> Vec<usize> {
        let square = |at: usize| self.killing_matrix().get(at, at);
        let semisimple = (0..self.dimension()).filter(|at| !square(*at).vanishes());
        let (first, others): (Vec<usize>, Vec<usize>) =
            semisimple.partition(|at| preferred(&square(*at)));
        let mut chosen: Vec<usize> = vec![];
        for at in first.into_iter().chain(others) {
            if self.products.of(at).iter().all(|(k, ..)| !chosen.contains(k)) {
                chosen.push(at);
            }
        }
        chosen
    }

    /// The rank: the dimension of the Cartan subalgebras.
    pub fn rank(&self) -> usize {
        self.cartan_subalgebra().dimension()
    }
}
