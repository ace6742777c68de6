//! The Dynkin type of a semisimple algebra over the algebraic closure, computed modulo a prime.
//!
//! The proof is as follows. Take a prime that does not divide the determinant of the Killing form.
//! The Casimir element acts as 1 on the algebra modulo the prime, so the second cohomology of this
//! algebra with adjoint coefficients vanishes. The algebra modulo the prime therefore lifts
//! uniquely, so it has the same type as the algebra.
//!
//! The method is as follows. Take a pseudorandom `x` with Cartan subalgebra `H = ker ad_x`, and a
//! vector `v` that generates `V = [x, L]` under `X = ad_x`. A map `A` that commutes with all `ad`
//! is a polynomial `q(X)` on `V`; it is even, because opposite roots belong to the same factor.
//! Projected to `V`, the relations `A [v,y] = [A v, y]` are linear equations in the coefficients of
//! `q`. The solutions form the centroid, and its primitive idempotents correspond to the factors.
//! The rank `r` and the dimension `n` of a factor determine its type, except that B, C and E6 are
//! distinguished by the power sums of the roots.
//!
//! The certificates are as follows. `X` is invertible on `V` and `H` is abelian, so `H` is a Cartan
//! subalgebra. The rank of each factor can only be underestimated, but the ranks add up to the rank
//! of `H`. Each type of the same rank and dimension implies an identity of power sums, and only one
//! type satisfies its own identity. If a certificate fails, another prime is tried.

use super::reduction::{ModularAlgebra, PseudoRandom};
use super::{GroundField, StructureTheory};
use crate::algebra::roots::{CartanType, Series};
use affinor_tensors::linear::modular::{Prime, ResidueMatrix};
use affinor_tensors::stop::{checkpoint, stage};
use polycore::{Fp, Uni};

impl<S: GroundField> StructureTheory<S> {
    /// The types of the simple factors of the Levi subalgebras over the algebraic closure, in
    /// order. Returns `None` if the computation fails modulo all primes that are tried.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("so(5)")?);
    /// let types = algebra.dynkin_type().unwrap_or_default();
    /// assert_eq!(types[0].to_string(), "B2");
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Dynkin diagram", "Cartan type", "simple factors"))]
    pub fn dynkin_type(&self) -> Option<Vec<CartanType>> {
        let _stage = stage("type");
        self.types.get_or_init(|| self.find_types()).clone()
    }

    fn find_types(&self) -> Option<Vec<CartanType>> {
        if self.is_semisimple() {
            return self.factors();
        }
        let levi = self.levi().ok()?;
        if levi.is_zero() {
            return Some(vec![]);
        }
        self.subalgebra(levi).ok()?.factors()
    }

    fn factors(&self) -> Option<Vec<CartanType>> {
        let mut reductions = self.semisimple_reductions().take(400);
        let mut types = reductions.find_map(|reduction| reduction.factors())?;
        types.sort_by_key(|factor| (factor.series() as usize, factor.rank()));
        Some(types)
    }
}

/// Draws the Dynkin diagram of a type as text, with the numbers of Bourbaki. Arrows point to the
/// short roots.
///
/// ```
/// use affinor::algebra::roots::{CartanType, Series};
/// use affinor::algebra::structure::dynkin::diagram;
/// assert_eq!(diagram(CartanType::new(Series::B, 3)?), "1---2==>3");
/// # Ok::<(), affinor::algebra::roots::RootError>(())
/// ```
pub fn diagram(cartan_type: CartanType) -> String {
    let r = cartan_type.rank();
    let chain =
        |from: usize, to: usize| (from..=to).map(|i| i.to_string()).collect::<Vec<_>>().join("---");
    // draws a branch below the node at which the given text ends
    let below = |text: &str, node: &str, rest: &str, branch: usize| {
        let indent = " ".repeat(text.len());
        format!("{text}{node}{rest}\n{indent}|\n{indent}{branch}")
    };
    match (cartan_type.series(), r) {
        (Series::A, _) => chain(1, r),
        (Series::B, _) => format!("{}==>{r}", chain(1, r - 1)),
        (Series::C, _) => format!("{}<=={r}", chain(1, r - 1)),
        (Series::D, 3) => "2---1---3".into(),
        (Series::D, _) => {
            let before = format!("{}---", chain(1, r - 3));
            below(&before, &(r - 2).to_string(), &format!("---{}", r - 1), r)
        }
        (Series::E, _) => below("1---3---", "4", &format!("---{}", chain(5, r)), 2),
        (Series::F, _) => "1---2==>3---4".into(),
        (Series::G, _) => "1<==2 (triple)".into(),
    }
}

/// The Cartan matrix `<α_i, α_j^v>` of a sum of simple types.
pub(super) fn block_cartan_matrix(types: &[CartanType]) -> Vec<Vec<i64>> {
    let rank = types.iter().map(|one| one.rank()).sum();
    let mut all = vec![vec![0; rank]; rank];
    let mut start = 0;
    for one in types {
        for (i, row) in one.cartan_matrix().into_iter().enumerate() {
            all[start + i][start..start + row.len()].copy_from_slice(&row);
        }
        start += one.rank();
    }
    all
}

/// The exponents of a type: the degrees of the invariants of its Weyl group, each minus one.
pub fn exponents(cartan_type: CartanType) -> Vec<usize> {
    let r = cartan_type.rank();
    match (cartan_type.series(), r) {
        (Series::A, _) => (1..=r).collect(),
        (Series::B | Series::C, _) => (0..r).map(|i| 2 * i + 1).collect(),
        (Series::D, _) => (0..r - 1).map(|i| 2 * i + 1).chain([r - 1]).collect(),
        (Series::E, 6) => vec![1, 4, 5, 7, 8, 11],
        (Series::E, 7) => vec![1, 5, 7, 9, 11, 13, 17],
        (Series::E, _) => vec![1, 7, 11, 13, 17, 19, 23, 29],
        (Series::F, _) => vec![1, 5, 7, 11],
        (Series::G, _) => vec![1, 5],
    }
}

/// A Cartan subalgebra `H` and a cyclic vector of `V`, modulo a prime.
pub(super) struct Split {
    prime: Prime,
    pub rank: usize,
    /// A basis of H, followed by the vectors `X^k v`.
    pub basis: Vec<Vec<u64>>,
    /// Maps a vector to its coordinates in `basis`.
    pub coordinates: ResidueMatrix,
    /// The coefficients of `X^m v = sum relation_k X^k v`.
    relation: Vec<u64>,
    /// A basis of the centroid. Each element is an even polynomial in `X`, stored as its
    /// coefficients.
    pub centroid: Vec<Vec<u64>>,
}

impl ModularAlgebra {
    /// The types of the simple factors. Returns `None` if the prime or the random elements are
    /// unsuitable.
    pub fn factors(&self) -> Option<Vec<CartanType>> {
        let mut draw = PseudoRandom::new(3);
        let split = Split::new(self, &mut draw)?;
        let sums = split.power_sums();
        if split.centroid.len() == 1 {
            return Some(vec![split.recognise(self.dimension(), split.rank, &sums)?]);
        }
        let (mut types, mut ranks) = (vec![], 0);
        for (idempotent, degree) in split.idempotents(&mut draw)? {
            let sums: Vec<u64> = (0..=2 * split.rank + 2)
                .map(|shift| {
                    let terms = idempotent.iter().enumerate();
                    terms.fold(0, |sum, (k, &e)| split.prime.reduce(sum + e * sums[k + shift]))
                })
                .collect();
            let roots = usize::try_from(sums[0]).ok()?;
            let rank = split.rank_within(self, &idempotent);
            if rank % degree != 0 || roots % degree != 0 {
                return None;
            }
            let sums = if degree == 1 { &sums[..] } else { &[] };
            let factor = split.recognise((roots + rank) / degree, rank / degree, sums)?;
            types.extend(std::iter::repeat_n(factor, degree));
            ranks += rank;
        }
        (ranks == split.rank).then_some(types)
    }
}

impl Split {
    pub fn new(algebra: &ModularAlgebra, draw: &mut PseudoRandom) -> Option<Self> {
        let (n, p) = (algebra.dimension(), algebra.prime());
        let mut split = Self::of(&algebra.ad(&draw.vector(p, n)), draw)?;
        let (rank, m) = (split.rank, n - split.rank);
        for (at, x) in split.basis[..rank].iter().enumerate() {
            let zero = |y: &Vec<u64>| algebra.bracket(x, y).iter().all(|value| *value == 0);
            if !split.basis[..at].iter().all(zero) {
                return None;
            }
        }
        let v = split.basis.get(rank)?.clone();
        // computes the columns of the equation A w = [A v, y] on V, for w = [v, y]
        let right = algebra.ad(&draw.vector(p, n)).sparse();
        let mut w = split.roots_part(&right.apply(&v));
        let mut columns = vec![];
        for k in 0..m {
            if k % 2 == 0 {
                let image = split.roots_part(&right.apply(&split.basis[rank + k]));
                let difference = w.iter().zip(&image).map(|(a, b)| p.add(*a, p.neg(*b)));
                columns.push(difference.collect::<Vec<u64>>());
            }
            w = split.times_x(&w);
        }
        let rows = (0..m).map(|i| columns.iter().map(|column| column[i]).collect());
        let kernel = ResidueMatrix::new(p, columns.len(), rows.collect()).kernel();
        split.centroid = kernel
            .into_iter()
            .map(|even| even.into_iter().flat_map(|q| [q, 0]).collect())
            .collect();
        (!split.centroid.is_empty()).then_some(split)
    }

    /// Computes the kernel of `X` and a cyclic vector of its image. The centroid remains empty.
    /// Returns `None` if some power of `X` has a larger kernel than `X`, or if the vector is not
    /// cyclic.
    pub fn of(ad: &ResidueMatrix, draw: &mut PseudoRandom) -> Option<Self> {
        let (n, p) = (ad.columns(), ad.prime());
        let mut basis = ad.clone().kernel();
        let rank = basis.len();
        let m = n - rank;
        let ad = ad.sparse();
        let v = ad.apply(&draw.vector(p, n));
        let mut power = v.clone();
        for _ in 0..m {
            let next = ad.apply(&power);
            basis.push(std::mem::replace(&mut power, next));
        }
        let coordinates = inverse_of_columns(p, &basis)?;
        let relation = coordinates.apply(&power)[rank..].to_vec();
        Some(Split { prime: p, rank, basis, coordinates, relation, centroid: vec![] })
    }

    /// The coefficients `s_k` of the relation `X^m v = sum of s_k X^k v`.
    pub fn relation(&self) -> &[u64] {
        &self.relation
    }

    fn dimension_of_v(&self) -> usize {
        self.basis.len() - self.rank
    }

    /// The coordinates of the component of a vector in V.
    fn roots_part(&self, vector: &[u64]) -> Vec<u64> {
        self.coordinates.apply(vector)[self.rank..].to_vec()
    }

    /// The product of `X` and a polynomial in `X`.
    pub fn times_x(&self, polynomial: &[u64]) -> Vec<u64> {
        checkpoint();
        let (p, m) = (self.prime, polynomial.len());
        let lead = polynomial[m - 1];
        let shifted = [0].iter().chain(&polynomial[..m - 1]);
        shifted.zip(&self.relation).map(|(a, r)| p.reduce(a + lead * r)).collect()
    }

    /// The product of two polynomials in `X`.
    pub fn product(&self, a: &[u64], b: &[u64]) -> Vec<u64> {
        let p = self.prime;
        let mut sum = vec![0; a.len()];
        let mut power = a.to_vec();
        for &factor in b {
            if factor != 0 {
                let pairs = sum.iter_mut().zip(&power);
                pairs.for_each(|(s, &v)| *s = p.reduce(*s + factor * v));
            }
            power = self.times_x(&power);
        }
        sum
    }

    /// The traces of `X^k` on V, for `k` below `2 m + 3`, by Newton's identities.
    pub fn power_sums(&self) -> Vec<u64> {
        let (p, m) = (self.prime, self.dimension_of_v());
        // Newton's identities apply, because the coefficients of t^m - sum of relation_k t^k are
        // the elementary symmetric functions up to signs
        let mut sums = vec![p.integer(m as i64)];
        for k in 1..2 * m + 3 {
            checkpoint();
            let mut sum = 0;
            for i in 1..=k.min(m) {
                let factor = if i == k { p.integer(k as i64) } else { sums[k - i] };
                sum = p.reduce(sum + self.relation[m - i] * factor);
            }
            sums.push(sum);
        }
        sums
    }

    /// The primitive idempotents of the centroid over the prime field, and their degrees.
    fn idempotents(&self, draw: &mut PseudoRandom) -> Option<Vec<(Vec<u64>, usize)>> {
        let (p, c) = (self.prime, self.centroid.len());
        let combine = |coefficients: &[u64], of: &[Vec<u64>]| {
            let mut sum = vec![0; of[0].len()];
            for (factor, row) in coefficients.iter().zip(of) {
                sum.iter_mut().zip(row).for_each(|(s, &v)| *s = p.reduce(*s + factor * v));
            }
            sum
        };
        let gamma = combine(&draw.vector(p, c), &self.centroid);
        let mut powers = vec![self.one()];
        for at in 0..c {
            powers.push(self.product(&powers[at], &gamma));
        }
        let minimal = relation_of(p, &powers)?;
        let to_fp = |v: &u64| Fp::new(*v, p.get());
        let polynomial = Uni::new(minimal.iter().map(to_fp).collect());
        let (_, factors) = polyfactor::factor_mod(&polynomial);
        let mut idempotents = vec![];
        for (factor, multiplicity) in factors {
            if multiplicity > 1 {
                return None;
            }
            // computes the idempotent e = u h, where h = g/factor, and u h = 1 modulo the factor
            let h = polynomial.exact(&factor)?;
            let (u, ..) = h.bezout(&factor);
            let (_, e) = (&u * &h).divrem(&polynomial);
            let coefficients: Vec<u64> = e.0.iter().map(|v| v.value()).collect();
            idempotents.push((combine(&coefficients, &powers), factor.deg()));
        }
        Some(idempotents)
    }

    fn one(&self) -> Vec<u64> {
        let mut one = vec![0; self.dimension_of_v()];
        one[0] = 1;
        one
    }

    /// The dimension of the part of H that belongs to the factors of an idempotent `e`. The vectors
    /// `[e v, X^k e v]` with odd `k` span this part.
    fn rank_within(&self, algebra: &ModularAlgebra, idempotent: &[u64]) -> usize {
        let rows = self.coroots(algebra, idempotent, idempotent);
        ResidueMatrix::new(self.prime, self.rank, rows).rank()
    }

    /// The coordinates in H of `[a(X) v, X^k b(X) v]` for odd `k`.
    pub fn coroots(&self, algebra: &ModularAlgebra, a: &[u64], b: &[u64]) -> Vec<Vec<u64>> {
        let left = algebra.ad(&self.vector(a));
        let mut polynomial = b.to_vec();
        (0..self.rank)
            .map(|_| {
                let odd = self.times_x(&polynomial);
                polynomial = self.times_x(&odd);
                let image = self.coordinates.apply(&left.apply(&self.vector(&odd)));
                image[..self.rank].to_vec()
            })
            .collect()
    }

    /// The vector `q(X) v`.
    pub fn vector(&self, polynomial: &[u64]) -> Vec<u64> {
        let mut sum = vec![0; self.basis.len()];
        for (&factor, power) in polynomial.iter().zip(&self.basis[self.rank..]) {
            if factor != 0 {
                let pairs = sum.iter_mut().zip(power);
                pairs.for_each(|(s, &v)| *s = self.prime.reduce(*s + factor * v));
            }
        }
        sum
    }

    /// The simple type of dimension `n` and rank `r`. The parameter `sums` contains the power sums
    /// of the roots, which distinguish B, C and E6.
    fn recognise(&self, n: usize, r: usize, sums: &[u64]) -> Option<CartanType> {
        let simple = |series| CartanType::new(series, r).ok().filter(|t| t.dimension() == n);
        let mut fits: Vec<CartanType> =
            [Series::A, Series::B, Series::C, Series::D, Series::E, Series::F, Series::G]
                .into_iter()
                .filter_map(simple)
                .collect();
        // selects one of two names of the same type: B2 instead of C2, A3 instead of D3
        if r <= 3 && fits.len() > 1 && fits.iter().any(|t| t.series() != Series::C || r == 2) {
            fits.retain(|t| r > 2 || t.series() == Series::B);
            fits.retain(|t| r != 3 || t.series() != Series::D);
        }
        if fits.len() <= 1 {
            return fits.pop();
        }
        if sums.len() < 2 * r + 3 {
            return None;
        }
        fits.retain(|t| match t.series() {
            Series::B | Series::C => self.is_classical(t.series(), r, sums),
            _ => self.has_no_quartic_invariant(n, sums),
        });
        match fits[..] {
            [one] => Some(one),
            _ => None,
        }
    }

    /// Whether `2 (n + 2) tr X^4 = 5 (tr X^2)^2`, which holds for the types without an invariant of
    /// degree 4: A1, A2 and the exceptional types.
    fn has_no_quartic_invariant(&self, n: usize, sums: &[u64]) -> bool {
        let p = self.prime;
        p.mul(p.integer(2 * n as i64 + 4), sums[4]) == p.mul(5, p.mul(sums[2], sums[2]))
    }

    /// Whether the roots are the roots of B_r or C_r for some numbers `a_1, ..., a_r`. The power
    /// sums `s_2k` are those of `r` numbers if Newton's identity of order `r + 1` holds.
    fn is_classical(&self, series: Series, r: usize, sums: &[u64]) -> bool {
        let p = self.prime;
        let functions = weight_power_sums(p, series, r, sums, r + 1)
            .and_then(|sums| elementary_functions(p, &sums));
        functions.is_some_and(|functions| functions[r + 1] == 0)
    }
}

/// The power sums `s_0, s_2, ..., s_2k` up to `k = count` of the weights `a_1, ..., a_r` of B_r,
/// C_r or D_r. They are computed from the power sums of the roots by
/// `tr X^2k = 2 sum over even m of binomial(2k,m) s_m s_(2k-m) + f s_2k`. The factor `f` is
/// `2 - 4^k` for B_r, `4^k` for C_r and `-4^k` for D_r. Returns `None` if a factor of `s_2k` is
/// zero.
pub(super) fn weight_power_sums(
    p: Prime,
    series: Series,
    r: usize,
    sums: &[u64],
    count: usize,
) -> Option<Vec<u64>> {
    let mut s = vec![p.integer(r as i64)];
    for k in 1..=count {
        let four = polycore::modp::pow(4, k as u64, p.get());
        let own = match series {
            Series::B => p.add(2, p.neg(four)),
            Series::D => p.neg(four),
            _ => four,
        };
        let mut inner = 0;
        for i in 1..k {
            inner = p.reduce(inner + p.mul(binomial(p, 2 * k, 2 * i), s[i]) * s[k - i]);
        }
        let known = p.add(sums[2 * k], p.neg(p.mul(2, inner)));
        s.push(p.mul(known, p.inv(p.add(p.integer(4 * r as i64), own))?));
    }
    Some(s)
}

/// The elementary symmetric functions of numbers, computed from their power sums by
/// `k e_k = sum of (-1)^(i-1) e_(k-i) s_i`.
pub(super) fn elementary_functions(p: Prime, s: &[u64]) -> Option<Vec<u64>> {
    let mut e = vec![1];
    for k in 1..s.len() {
        let mut sum = 0;
        for i in 1..=k {
            let term = p.mul(e[k - i], s[i]);
            sum = p.add(sum, if i % 2 == 1 { term } else { p.neg(term) });
        }
        e.push(p.mul(sum, p.inv(p.integer(k as i64))?));
    }
    Some(e)
}

fn binomial(p: Prime, n: usize, k: usize) -> u64 {
    (0..k).fold(1, |value, i| {
        let unit = p.inv(p.integer(i as i64 + 1)).unwrap_or(1);
        p.mul(p.mul(value, p.integer((n - i) as i64)), unit)
    })
}

/// The inverse of the matrix that has these columns.
pub(super) fn inverse_of_columns(p: Prime, columns: &[Vec<u64>]) -> Option<ResidueMatrix> {
    let n = columns.len();
    let row = |i: usize| {
        let left = columns.iter().map(|column| column[i]);
        left.chain((0..n).map(|j| u64::from(i == j))).collect()
    };
    let mut both = ResidueMatrix::new(p, 2 * n, (0..n).map(row).collect());
    let pivots = both.reduce();
    let regular = pivots.len() == n && pivots.last().is_none_or(|last| *last < n);
    regular.then(|| {
        ResidueMatrix::new(p, n, both.rows().iter().map(|row| row[n..].to_vec()).collect())
    })
}

/// The coefficients of the monic relation between the powers, in ascending order. Returns `None`
/// unless the last power depends on the earlier powers, and these are independent.
pub(super) fn relation_of(p: Prime, powers: &[Vec<u64>]) -> Option<Vec<u64>> {
    let rows = (0..powers[0].len()).map(|i| powers.iter().map(|power| power[i]).collect());
    let kernel = ResidueMatrix::new(p, powers.len(), rows.collect()).kernel();
    match kernel.as_slice() {
        [one] if one[powers.len() - 1] == 1 => Some(one.clone()),
        _ => None,
    }
}
