//! Subalgebras that are reductive in a semisimple algebra, given by vectors: the restriction of
//! weights.
//!
//! A Cartan subalgebra of the subalgebra is extended to a Cartan subalgebra of the algebra, over
//! the rationals. Both are reduced modulo a prime for which all roots are residues. The coroots of
//! the subalgebra act on the root vectors of the algebra by integers, which are small and so known
//! from their residues. All Cartan subalgebras that contain a given one are conjugate. All bases of
//! the roots are conjugate up to automorphisms of the Dynkin diagram. So the choice of the prime
//! does not matter.

use super::dynkin::{Split, block_cartan_matrix};
use super::reduction::{ModularAlgebra, PseudoRandom};
use super::subspace::coprime;
use super::{RootSpaces, StructureTheory, Subspace};
use crate::algebra::roots::{CartanType, RootSystem, automorphisms};
use crate::{Error, Law};
use affinor_tensors::Rational;
use affinor_tensors::linear::modular::{Prime, RationalReconstruction, ResidueMatrix, primes};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::{checkpoint, stage};
use polycore::{Fp, Uni};
use std::collections::HashSet;

/// The number of primes that are tried. For a random Cartan subalgebra of a simple algebra, one in
/// the order of its Weyl group is suitable.
const PRIMES: usize = 2000;
/// The largest entry of a projection.
const LARGEST: i64 = 1 << 16;

/// The restriction of weights to a reductive subalgebra.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Embedding {
    /// The types of the simple factors of the subalgebra.
    pub types: Vec<CartanType>,
    /// The dimension of the centre of the subalgebra.
    pub centre: usize,
    /// The values `<ω_k, x_i>` of the fundamental weights of the algebra on the simple coroots `x_i`
    /// of the subalgebra, then on a basis of its centre; one row for each `x_i`. The rows of the
    /// centre contain integers without a common factor. The sum of the positive coroots of the
    /// subalgebra is dominant.
    pub projection: Vec<Vec<i64>>,
}

/// A test of the numbering of the simple roots of one factor. Its arguments are a prime, the position
/// of the factor, an element of the algebra modulo the prime, and labels. The labels are the values of
/// the fundamental weights of the factor on the element.
pub type Numbering<'t> = &'t dyn Fn(Prime, usize, &[u64], &[u64]) -> bool;

impl StructureTheory<Rational> {
    /// The restriction of weights to the subalgebra on a subspace of a semisimple algebra. The types
    /// are those of the algebra, in the order of the columns of the projection. Two numberings of the
    /// simple roots differ by an automorphism of the Dynkin diagram. For each factor, the first
    /// numbering that passes the test `fits` is chosen.
    ///
    /// Returns `None` if the types or a suitable prime are not found.
    ///
    /// # Errors
    /// [`Law::Subalgebra`] with two basis vectors whose bracket leaves the subspace.
    /// [`Law::KillingOnSubalgebra`] with a vector that is orthogonal to the subalgebra: then the
    /// subalgebra is not reductive in the algebra.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::{StructureTheory, Subspace}};
    /// use affinor::Rational;
    /// // so(3) in the split form of A2, spanned by e_a - f_a
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("A2")?);
    /// let types = algebra.dynkin_type().unwrap_or_default();
    /// let vector = |i: usize| vec![(i, Rational::from(1)), (i + 3, Rational::from(-1))];
    /// let rotations = Subspace::span(8, (0..3).map(vector));
    /// let found = algebra.embedding(&rotations, &types, &|_, _, _, _| true)?;
    /// assert_eq!(found.map(|found| found.projection), Some(vec![vec![2, 2]]));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("branching", "projection matrix"))]
    pub fn embedding(
        &self,
        subspace: &Subspace<Rational>,
        types: &[CartanType],
        fits: Numbering,
    ) -> Result<Option<Embedding>, Error> {
        let _stage = stage("subalgebra");
        let inside = self.subalgebra(subspace)?;
        self.reject_degenerate(subspace)?;
        let Some(own_types) = inside.dynkin_type() else { return Ok(None) };
        let own_cartan = inside.cartan_subalgebra();
        let rows = own_cartan.basis().iter().map(|row| subspace.vector(row));
        let toral = Subspace::span(self.dimension(), rows);
        let rank = types.iter().map(|one| one.rank()).sum();
        let Some(cartan) = self.cartan_subalgebra_around(&toral, rank)? else { return Ok(None) };
        let centre = inside.centre();
        let task = Task {
            types,
            own_types: &own_types,
            cartan: cartan.basis(),
            own_cartan: own_cartan.basis(),
            centre: centre.basis(),
            subspace: subspace.basis(),
        };
        let found = primes().take(PRIMES).find_map(|prime| {
            checkpoint();
            let [whole, part] = [self, &inside].map(|one| ModularAlgebra::new(one, prime));
            task.projection(&whole?, &part?, fits)
        });
        let centre = centre.dimension();
        Ok(found.map(|projection| Embedding { types: own_types, centre, projection }))
    }

    /// An error unless the Killing form of the algebra is nondegenerate on the subspace.
    fn reject_degenerate(&self, subspace: &Subspace<Rational>) -> Result<(), Error> {
        let n = self.dimension();
        let basis = Matrix::from_rows(n, subspace.basis().iter().cloned())?;
        let form = basis.mul(self.killing_matrix())?.mul(&basis.transpose())?;
        let null = form.nullspace()?;
        if null.rows() == 0 {
            return Ok(());
        }
        let vector = self.write(&subspace.vector(null.row(0)));
        Err(Law::KillingOnSubalgebra.broken([vector], "0"))
    }

    /// A Cartan subalgebra that contains a toral subalgebra. `None` if its dimension is not the
    /// rank, because the subalgebra is not toral.
    fn cartan_subalgebra_around(
        &self,
        toral: &Subspace<Rational>,
        rank: usize,
    ) -> Result<Option<Subspace<Rational>>, Error> {
        let split = self.hyperbolic_cartan_subalgebra(rank);
        if let Some(cartan) = split.filter(|cartan| cartan.includes(toral)) {
            return Ok(Some(cartan));
        }
        let centralizer = self.centralizer(toral);
        let cartan = self.subalgebra(&centralizer)?.cartan_subalgebra();
        let rows = cartan.basis().iter().map(|row| centralizer.vector(row));
        let cartan = Subspace::span(self.dimension(), rows);
        Ok(Some(cartan).filter(|cartan| cartan.dimension() == rank))
    }
}

/// The rational data of an embedding. The rows `own_cartan` and `centre` are in the basis of the
/// subspace.
struct Task<'t> {
    types: &'t [CartanType],
    own_types: &'t [CartanType],
    cartan: &'t [Row<Rational>],
    own_cartan: &'t [Row<Rational>],
    centre: &'t [Row<Rational>],
    subspace: &'t [Row<Rational>],
}

impl Task<'_> {
    /// The projection; `None` if the prime is unsuitable.
    fn projection(
        &self,
        whole: &ModularAlgebra,
        part: &ModularAlgebra,
        fits: Numbering,
    ) -> Option<Vec<Vec<i64>>> {
        let (p, n, m) = (whole.prime(), whole.dimension(), part.dimension());
        let dense = |rows: &[Row<Rational>], n| {
            rows.iter().map(|row| residues(p, n, row)).collect::<Option<Vec<_>>>()
        };
        let mut draw = PseudoRandom::new(5);
        let cartan = dense(self.cartan, n)?;
        let roots = Roots::new(whole, &cartan, &mut draw)?;
        let simple = roots.simple(p, self.types)?;
        let own_roots = Roots::new(part, &dense(self.own_cartan, m)?, &mut draw)?;
        let own_simple = own_roots.simple(p, self.own_types)?;
        let subspace = dense(self.subspace, n)?;
        let inverses = self.types.iter().map(|one| inverse_cartan_matrix(p, *one));
        let inverses = inverses.collect::<Option<Vec<_>>>()?;
        // the values of the fundamental weights of a factor on a toral element
        let labels_of = |factor: usize, element: &[u64], simple: &[usize]| {
            let value = |root: &usize| eigenvalue(whole, element, &roots.vectors[*root]);
            let values = simple.iter().map(value).collect::<Option<Vec<u64>>>()?;
            Some(inverses[factor].iter().map(|row| p.dot(row, &values)).collect::<Vec<u64>>())
        };
        let labels = |element: &[u64], factors: &[Vec<usize>]| {
            let parts = factors.iter().enumerate();
            let parts = parts.map(|(at, simple)| labels_of(at, element, simple));
            Some(parts.collect::<Option<Vec<_>>>()?.concat())
        };
        let factors = draw.vector(p, cartan.len());
        let element = combination(p, n, &factors, &cartan);
        // the factors of the algebra that have no number yet, with their simple roots
        let mut start = 0;
        let blocks = self.types.iter().map(|one| {
            start += one.rank();
            (*one, simple[start - one.rank()..start].to_vec())
        });
        let mut open: Vec<(CartanType, Vec<usize>)> = blocks.collect();
        let mut simple: Vec<Vec<usize>> = vec![];
        for (factor, one) in self.types.iter().enumerate() {
            let (at, found) = open.iter().enumerate().find_map(|(at, (other, block))| {
                checkpoint();
                let orders = automorphisms(*one).into_iter().filter(|_| one == other);
                let mut orders =
                    orders.map(|order| order.iter().map(|&i| block[i]).collect::<Vec<_>>());
                let found = orders.find(|simple| {
                    labels_of(factor, &element, simple)
                        .is_some_and(|labels| fits(p, factor, &element, &labels))
                });
                Some((at, found?))
            })?;
            open.remove(at);
            simple.push(found);
        }
        let mut rows = vec![];
        for &root in &own_simple {
            let coroot = own_roots.coroot(part, root)?;
            let coroot = combination(p, n, &coroot, &subspace);
            rows.push(integers(p, &labels(&coroot, &simple)?)?);
        }
        let centre = dense(self.centre, m)?
            .into_iter()
            .map(|row| labels(&combination(p, n, &row, &subspace), &simple));
        let mut centre =
            ResidueMatrix::new(p, simple.concat().len(), centre.collect::<Option<_>>()?);
        if centre.reduce().len() < self.centre.len() {
            return None;
        }
        for row in centre.rows() {
            rows.push(primitive(p, row)?);
        }
        make_dominant(&mut rows, self.types, self.own_types);
        Some(rows)
    }
}

/// The roots of a reductive algebra modulo a prime.
struct Roots {
    vectors: Vec<Vec<u64>>,
    /// The values on the basis of the Cartan subalgebra.
    values: Vec<Vec<u64>>,
}

impl Roots {
    /// The roots for a Cartan subalgebra; `None` if they are not residues.
    ///
    /// A random element `x` of the Cartan subalgebra acts on the root spaces by distinct
    /// eigenvalues. If `q` is the product of `x - b` over the other eigenvalues `b`, a cyclic vector
    /// `v` yields the root vector `q v`.
    fn new(algebra: &ModularAlgebra, cartan: &[Vec<u64>], draw: &mut PseudoRandom) -> Option<Self> {
        let (n, p) = (algebra.dimension(), algebra.prime());
        let mut roots = Roots { vectors: vec![], values: vec![] };
        if n == cartan.len() {
            return Some(roots);
        }
        let x = combination(p, n, &draw.vector(p, cartan.len()), cartan);
        let split = Split::of(&algebra.ad(&x), draw)?;
        if split.rank != cartan.len() {
            return None;
        }
        let mut minimal: Vec<u64> = split.relation().iter().map(|v| p.neg(*v)).collect();
        minimal.push(1);
        let coefficients = minimal.iter().map(|v| Fp::new(*v, p.get())).collect();
        for (factor, multiplicity) in polyfactor::factor_mod(&Uni::new(coefficients)).1 {
            if factor.deg() != 1 || multiplicity != 1 {
                return None;
            }
            let root = p.mul(p.neg(factor.0[0].value()), p.inv(factor.0[1].value())?);
            // the quotient of the minimal polynomial by t - root
            let mut quotient = vec![0; minimal.len() - 1];
            let mut carry = 0;
            for (place, value) in quotient.iter_mut().zip(&minimal[1..]).rev() {
                carry = p.add(*value, p.mul(carry, root));
                *place = carry;
            }
            let vector = split.vector(&quotient);
            let values = cartan.iter().map(|h| eigenvalue(algebra, h, &vector));
            roots.values.push(values.collect::<Option<_>>()?);
            roots.vectors.push(vector);
        }
        Some(roots)
    }

    /// The simple roots in the order of the types.
    fn simple(&self, p: Prime, types: &[CartanType]) -> Option<Vec<usize>> {
        let set: HashSet<&[u64]> = self.values.iter().map(|values| &values[..]).collect();
        let mut span = ResidueMatrix::new(p, self.values.first().map_or(0, Vec::len), vec![]);
        let mut spanning = vec![];
        for (at, values) in self.values.iter().enumerate() {
            let rows = [span.rows(), std::slice::from_ref(values)].concat();
            let mut larger = ResidueMatrix::new(p, values.len(), rows);
            if larger.reduce().len() > spanning.len() {
                span = larger;
                spanning.push(at);
            }
        }
        // the number of steps from one root in a direction within the roots
        let steps = |from: &[u64], direction: &[u64]| {
            let mut root = from.to_vec();
            let mut count = 0;
            loop {
                root.iter_mut().zip(direction).for_each(|(a, b)| *a = p.add(*a, *b));
                if !set.contains(&root[..]) {
                    return count;
                }
                count += 1;
            }
        };
        // the integers <a, b^v> for the spanning roots b determine the root a
        let integer = |a: &[u64], b: &[u64]| {
            let minus: Vec<u64> = b.iter().map(|v| p.neg(*v)).collect();
            if a == b {
                2
            } else if a == minus {
                -2
            } else {
                steps(a, &minus) - steps(a, b)
            }
        };
        let integers = self.values.iter().map(|a| {
            checkpoint();
            spanning.iter().map(|&b| integer(a, &self.values[b])).collect()
        });
        RootSpaces::simple_roots(integers.collect(), types)
    }

    /// The coroot of a root: the multiple `h` of `[e, f]` with `[h, e] = 2 e`.
    fn coroot(&self, algebra: &ModularAlgebra, root: usize) -> Option<Vec<u64>> {
        let p = algebra.prime();
        let opposite = |values: &Vec<u64>| {
            values.iter().zip(&self.values[root]).all(|(a, b)| p.add(*a, *b) == 0)
        };
        let other = self.values.iter().position(opposite)?;
        let h = algebra.bracket(&self.vectors[root], &self.vectors[other]);
        let factor = p.mul(2, p.inv(eigenvalue(algebra, &h, &self.vectors[root])?)?);
        Some(h.into_iter().map(|v| p.mul(v, factor)).collect())
    }
}

/// The factor `a` of `[h, e] = a e`; `None` if `e` is not an eigenvector.
fn eigenvalue(algebra: &ModularAlgebra, h: &[u64], e: &[u64]) -> Option<u64> {
    let p = algebra.prime();
    let image = algebra.bracket(h, e);
    let pivot = e.iter().position(|v| *v != 0)?;
    let factor = p.mul(image[pivot], p.inv(e[pivot])?);
    image.iter().zip(e).all(|(a, b)| *a == p.mul(*b, factor)).then_some(factor)
}

fn residues(p: Prime, n: usize, row: &Row<Rational>) -> Option<Vec<u64>> {
    let mut dense = vec![0; n];
    for (at, value) in row {
        dense[*at] = p.rational(value)?;
    }
    Some(dense)
}

fn combination(p: Prime, n: usize, factors: &[u64], rows: &[Vec<u64>]) -> Vec<u64> {
    let mut sum = vec![0; n];
    for (factor, row) in factors.iter().zip(rows) {
        sum.iter_mut().zip(row).for_each(|(s, v)| *s = p.reduce(*s + factor * v));
    }
    sum
}

/// The inverse of the matrix `<α_j, α_k^v>` of a type, modulo a prime.
fn inverse_cartan_matrix(p: Prime, cartan_type: CartanType) -> Option<Vec<Vec<u64>>> {
    let cartan = cartan_type.cartan_matrix();
    let rational = |row: &Vec<i64>| row.iter().map(|v| Rational::from(*v)).collect::<Vec<_>>();
    let inverse = Matrix::from_dense(&cartan.iter().map(rational).collect::<Vec<_>>()).ok()?;
    let dense = inverse.inverse()?.to_dense();
    dense.iter().map(|row| row.iter().map(|v| p.rational(v)).collect()).collect()
}

/// The integers of least magnitude with these residues, if they are small.
fn integers(p: Prime, residues: &[u64]) -> Option<Vec<i64>> {
    let least = |&v: &u64| {
        let v = if v > p.get() / 2 { v as i64 - p.get() as i64 } else { v as i64 };
        (v.abs() <= LARGEST).then_some(v)
    };
    residues.iter().map(least).collect()
}

/// Applies simple reflections of the algebra to the rows, until a dominant element of the
/// subalgebra is dominant in the algebra. The first element is the sum of the positive coroots of the
/// subalgebra; ties are decided by the centre, then by the simple coroots.
fn make_dominant(rows: &mut [Vec<i64>], types: &[CartanType], own_types: &[CartanType]) {
    let cartan = block_cartan_matrix(types);
    let mut factors: Vec<i64> = vec![];
    for one in own_types {
        let roots = RootSystem::new(*one);
        let sum =
            |i: usize| roots.positive_roots().iter().map(|root| root.coroot()[i]).sum::<i64>();
        factors.extend((0..one.rank()).map(sum));
    }
    let count = factors.len();
    let negative = |rows: &[Vec<i64>]| {
        (0..cartan.len()).find_map(|j| {
            let value =
                |row: &Vec<i64>| -> i64 { cartan[j].iter().zip(row).map(|(a, c)| a * c).sum() };
            let values: Vec<i64> = rows.iter().map(value).collect();
            let first: i64 = factors.iter().zip(&values).map(|(f, v)| f * v).sum();
            let all = [first].into_iter().chain(values[count..].iter().copied());
            let sign = all.chain(values[..count].iter().copied()).find(|v| *v != 0);
            sign.is_some_and(|sign| sign < 0).then_some((j, values))
        })
    };
    while let Some((j, values)) = negative(rows) {
        checkpoint();
        rows.iter_mut().zip(values).for_each(|(row, value)| row[j] -= value);
    }
}

/// The coprime integers that are proportional to rational numbers with these residues.
fn primitive(p: Prime, residues: &[u64]) -> Option<Vec<i64>> {
    let mut numbers = RationalReconstruction::new(residues.len());
    numbers.add(p, residues);
    let numbers = numbers.rationals()?;
    let small = |values: &Vec<i64>| values.iter().all(|value| value.abs() <= LARGEST);
    coprime(&numbers).filter(small)
}
