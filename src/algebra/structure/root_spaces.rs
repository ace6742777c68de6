//! Root spaces of a semisimple algebra whose Cartan subalgebra splits over the rationals (de Graaf
//! 4.9, 5.11).

use super::dynkin::{block_cartan_matrix, relation_of};
use super::products::Ad;
use super::reduction::ModularAlgebra;
use super::subspace::combination;
use super::{StructureTheory, Subspace};
use crate::algebra::irreducible_factors;
use crate::algebra::matrix_polynomials::monic;
use crate::algebra::roots::{CartanType, numbering};
use affinor_tensors::linear::modular::PRIMES;
use affinor_tensors::linear::{Echelon, Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Rational, Ring};
use num_rational::BigRational;
use polycore::{Fp, Uni};
use std::collections::{BTreeMap, HashSet};

/// The largest number of eigenvalues in the decomposition of one vector.
const MAX_EIGENVALUES: usize = 24;

/// The roots of a semisimple algebra for a Cartan subalgebra that splits over the rationals.
#[derive(Clone, Debug)]
pub struct RootSpaces {
    /// The Cartan subalgebra, with its basis `h_i`.
    pub cartan: Subspace<Rational>,
    /// All roots: first the positive roots in lexicographic order of their values, then the
    /// opposite roots.
    pub roots: Vec<RootSpace>,
    /// The positions of the simple roots in `roots`, factor by factor. Within a factor, they are
    /// numbered as in Bourbaki.
    pub simple: Vec<usize>,
    /// The types of the factors.
    pub types: Vec<CartanType>,
}

/// A root and its root space.
#[derive(Clone, Debug, PartialEq)]
pub struct RootSpace {
    /// The values `a(h_i)` on the basis of the Cartan subalgebra.
    pub values: Vec<Rational>,
    /// A vector `x` with `[h_i, x] = a(h_i) x`, which spans the root space.
    pub vector: Row<Rational>,
}

impl StructureTheory<Rational> {
    /// The root spaces of a semisimple algebra for a Cartan subalgebra that splits over the
    /// rationals. The first candidate contains basis vectors with positive Killing squares; the
    /// second is [`cartan_subalgebra`](Self::cartan_subalgebra). Returns `None` if neither splits,
    /// or if a vector has components in more than 24 eigenspaces.
    pub fn root_spaces(&self) -> Option<RootSpaces> {
        let _stage = stage("roots");
        let types = self.dynkin_type().filter(|_| self.is_semisimple())?;
        let rank = types.iter().map(|one| one.rank()).sum();
        let hyperbolic = self.hyperbolic_cartan_subalgebra(rank);
        let found = hyperbolic.and_then(|cartan| self.split_by(cartan, types.clone()));
        found.or_else(|| self.split_by(self.cartan_subalgebra(), types))
    }

    fn split_by(&self, cartan: Subspace<Rational>, types: Vec<CartanType>) -> Option<RootSpaces> {
        let n = self.dimension();
        if !self.may_split(&cartan) {
            return None;
        }
        let mut spaces: BTreeMap<Vec<Rational>, Vec<Row<Rational>>> = BTreeMap::new();
        spaces.insert(vec![], self.whole().basis().to_vec());
        for h in cartan.basis() {
            let ad = self.products.ad(h);
            let mut finer: BTreeMap<Vec<Rational>, Subspace<Rational>> = BTreeMap::new();
            for (values, basis) in &spaces {
                for vector in basis {
                    for (value, part) in eigenvectors(&ad, n, vector)? {
                        let values = values.iter().cloned().chain([value]).collect();
                        finer.entry(values).or_insert_with(|| Subspace::zero(n)).add(part);
                    }
                }
            }
            spaces = finer.into_iter().map(|(at, space)| (at, space.basis().to_vec())).collect();
        }
        let zero = vec![Rational::from(0); cartan.dimension()];
        spaces.retain(|values, _| *values != zero);
        let mut roots = vec![];
        for (values, basis) in spaces {
            let [vector] = &basis[..] else { return None };
            roots.push(RootSpace { values, vector: vector.clone() });
        }
        // the lexicographic order is compatible with addition, so it defines positive roots
        let (negative, positive): (Vec<_>, Vec<_>) =
            roots.into_iter().partition(|root| root.values < zero);
        let opposites = negative.into_iter().rev();
        let mut found = RootSpaces { cartan, roots: positive, simple: vec![], types };
        let simple = found.indecomposable();
        found.roots.extend(opposites);
        found.simple = found.numbered(&simple)?;
        Some(found)
    }

    /// A fast test modulo a prime whether the Cartan subalgebra may split. The test decomposes some
    /// unit vectors by the first vector of the Cartan subalgebra. It returns `false` if their
    /// components belong to more than [`MAX_EIGENVALUES`] eigenvalues, or to irrational
    /// eigenvalues. Over the rationals, this test would be slow in a dense basis, because the
    /// powers of `ad` contain long numbers.
    fn may_split(&self, cartan: &Subspace<Rational>) -> bool {
        let Some(h) = cartan.basis().first() else { return true };
        let found = PRIMES.into_iter().find_map(|prime| {
            let mut dense = vec![0; self.dimension()];
            for (at, value) in h {
                dense[*at] = prime.rational(value)?;
            }
            Some((ModularAlgebra::new(self, prime)?, dense))
        });
        let Some((reduction, h)) = found else { return true };
        let (n, p, ad) = (self.dimension(), reduction.prime(), reduction.ad(&h));
        [0, n / 2, n - 1].into_iter().all(|at| {
            let mut unit = vec![0; n];
            unit[at] = 1;
            let mut powers = vec![unit];
            while powers.len() <= MAX_EIGENVALUES {
                let next = ad.apply(&powers[powers.len() - 1]);
                powers.push(next);
                if let Some(minimal) = relation_of(p, &powers) {
                    let coefficients = minimal.iter().map(|v| Fp::new(*v, p.get()));
                    let (_, factors) = polyfactor::factor_mod(&Uni::new(coefficients.collect()));
                    return factors.iter().all(|(factor, _)| factor.deg() == 1);
                }
            }
            false
        })
    }
}

impl RootSpaces {
    /// The positions of simple roots among all roots, which are given by integers that determine
    /// them linearly. The simple roots are in the order of the types, and numbered as in Bourbaki.
    /// `None` if the roots have other types.
    pub(super) fn simple_roots(roots: Vec<Vec<i64>>, types: &[CartanType]) -> Option<Vec<usize>> {
        let rational = |root: &Vec<i64>| root.iter().map(|v| Rational::from(*v)).collect();
        let values: Vec<Vec<Rational>> = roots.iter().map(rational).collect();
        let zero = vec![Rational::from(0); values.first().map_or(0, Vec::len)];
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|a, b| values[*a].cmp(&values[*b]));
        order.retain(|at| values[*at] > zero);
        let space = |at: &usize| RootSpace { values: values[*at].clone(), vector: vec![] };
        let positive: Vec<RootSpace> = order.iter().map(space).collect();
        let opposite = positive.iter().map(|root| {
            let values = root.values.iter().map(|v| -v.clone()).collect();
            RootSpace { values, vector: vec![] }
        });
        let opposite: Vec<RootSpace> = opposite.collect();
        let (cartan, types) = (Subspace::zero(0), types.to_vec());
        let mut found = RootSpaces { cartan, roots: positive, simple: vec![], types };
        let simple = found.indecomposable();
        found.roots.extend(opposite);
        Some(found.numbered(&simple)?.into_iter().map(|at| order[at]).collect())
    }

    /// The Cartan matrix `a_ij = <a_i, a_j^v>` of the simple roots, computed from root strings.
    /// `a_i - a_j` is not a root, and `-a_ij` is the largest `k` such that `a_i + k a_j` is a root.
    pub fn cartan_matrix(&self) -> Vec<Vec<i64>> {
        self.matrix(&self.simple)
    }

    fn matrix(&self, simple: &[usize]) -> Vec<Vec<i64>> {
        let all: HashSet<&[Rational]> = self.roots.iter().map(|r| &r.values[..]).collect();
        let string = |i: usize, j: usize| {
            let mut root = self.roots[i].values.clone();
            let mut steps = 0;
            loop {
                root = sum(&root, &self.roots[j].values);
                if !all.contains(&root[..]) {
                    return -steps;
                }
                steps += 1;
            }
        };
        let entry = |i: usize, j: usize| if i == j { 2 } else { string(i, j) };
        simple.iter().map(|&i| simple.iter().map(|&j| entry(i, j)).collect()).collect()
    }

    /// The indices of the positive roots that are not a sum of two positive roots. When this
    /// function is called, `roots` contains only the positive roots.
    fn indecomposable(&self) -> Vec<usize> {
        let all: HashSet<&[Rational]> = self.roots.iter().map(|r| &r.values[..]).collect();
        let mut simple: Vec<usize> = vec![];
        for (at, root) in self.roots.iter().enumerate() {
            // searches for the difference among the earlier roots, because smaller roots come first
            let rest = |other: &usize| {
                let minus = self.roots[*other].values.iter().map(|v| -v.clone());
                sum(&root.values, &minus.collect::<Vec<_>>())
            };
            if !simple.iter().any(|other| all.contains(&rest(other)[..])) {
                simple.push(at);
            }
        }
        simple
    }

    /// The simple roots, ordered so that their Cartan matrix is the Cartan matrix of the types.
    fn numbered(&self, simple: &[usize]) -> Option<Vec<usize>> {
        let matrix = self.matrix(simple);
        let wanted = block_cartan_matrix(&self.types);
        if wanted.len() != simple.len() {
            return None;
        }
        let nodes: Vec<usize> = (0..simple.len()).collect();
        let order = numbering(&matrix, &wanted, &nodes)?;
        Some(order.iter().map(|&at| simple[at]).collect())
    }
}

fn sum(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    a.iter().zip(b).map(|(a, b)| a.clone() + b).collect()
}

/// Decomposes a vector into eigenvectors of a map. Returns `None` unless all eigenvalues that occur
/// are rational, and are simple roots of the minimal polynomial of the vector.
fn eigenvectors(
    ad: &Ad<Rational>,
    n: usize,
    vector: &Row<Rational>,
) -> Option<Vec<(Rational, Row<Rational>)>> {
    if let Some(value) = eigenvalue(&ad.image(vector), vector) {
        return Some(vec![(value, vector.clone())]);
    }
    let mut powers = vec![vector.clone()];
    let mut span = Echelon::new();
    span.insert(vector.iter().cloned()).ok()?;
    let minimal = loop {
        let next = ad.image(powers.last()?);
        if !span.contains(next.iter().cloned()) {
            span.insert(next.iter().cloned()).ok()?;
            powers.push(next);
            if powers.len() > MAX_EIGENVALUES {
                return None;
            }
            continue;
        }
        let mut dense = vec![Rational::from(0); n];
        next.into_iter().for_each(|(at, value)| dense[at] = value);
        let system = Matrix::from_rows(n, powers.iter().cloned()).ok()?.transpose();
        break monic(&system.solve(&dense).ok()??);
    };
    let mut parts = vec![];
    for (factor, multiplicity) in irreducible_factors(&minimal) {
        if factor.deg() != 1 || multiplicity > 1 {
            return None;
        }
        let root = -Rational::from(&factor.0[0] / &factor.0[1]);
        let others = minimal.exact(&factor)?;
        let value = |at: &Rational| {
            others.0.iter().rev().fold(Rational::from(0), |sum, c: &BigRational| {
                sum * at + &Rational::from(c.clone())
            })
        };
        let unit = value(&root).recip()?;
        let coefficients = others.0.iter().enumerate();
        let coefficients: Row<Rational> = coefficients
            .map(|(at, c)| (at, Rational::from(c.clone()) * &unit))
            .filter(|(_, c)| !c.vanishes())
            .collect();
        parts.push((root, combination(&powers, &coefficients)));
    }
    Some(parts)
}

/// The factor between a vector and its image. Returns `None` if the two are not proportional.
fn eigenvalue(image: &Row<Rational>, vector: &Row<Rational>) -> Option<Rational> {
    let Some((at, first)) = image.first() else { return Some(Rational::from(0)) };
    let (_, own) = vector.first().filter(|(place, _)| place == at)?;
    let factor = first.clone() * &own.recip()?;
    let same = |((i, value), (j, entry)): (&(usize, Rational), &(usize, Rational))| {
        i == j && *value == entry.clone() * &factor
    };
    let parallel = image.len() == vector.len() && image.iter().zip(vector).all(same);
    parallel.then_some(factor)
}
