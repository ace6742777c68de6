//! Dimensions of the cohomology of Chevalley and Eilenberg with coefficients in a module. Betti
//! numbers are those of the trivial module.

use super::certificates::Certified;
use super::dynkin::exponents;
use super::reduction::ModularAlgebra;
use super::subspace::collected;
use super::{GroundField, StructureTheory, Subspace};
use crate::Error;
use crate::algebra::cochains::{Dimensions, Indices, differential, relative_cohomology, sets};
use crate::algebra::{BasisChange, Module};
use affinor_tensors::linear::Row;
use affinor_tensors::stop::{checkpoint, stage};
use affinor_tensors::{Down, Tensor, Up};
use polycore::Lead;
use polycore::modp_echelon::Echelon;
use std::collections::{BTreeMap, HashSet};

/// The largest dimension at which closed forms of all degrees are lifted to the rationals and
/// verified.
const MAX_CERTIFIED: usize = 11;
/// The largest dimension at which the ranks of all differentials are computed modulo primes.
pub const MAX_DIMENSION: usize = 18;
/// Limits beyond [`MAX_CERTIFIED`]: the number of forms of one degree, and its product with the
/// number of structure constants.
const MAX_ROWS: usize = 13_000;
const MAX_WORK: usize = 1_500_000;

/// The largest number of cochains of one degree that are lifted to the rationals and verified.
const MAX_LIFTED: usize = 2000;

/// Larger Betti numbers are not returned.
const LARGEST: u64 = 1 << 53;

impl<S: GroundField> StructureTheory<S> {
    /// The Betti numbers `b_0, ..., b_n`. Unless the algebra is reductive, the method returns
    /// `None` beyond [`MAX_DIMENSION`], or if the differentials have too many entries. It also
    /// returns `None` if a number exceeds `2^53`, because floats represent all integers only up to
    /// this limit.
    ///
    /// The Poincaré polynomial of a reductive algebra is `(1+t)^z prod (1 + t^(2m+1))`, with the
    /// dimension `z` of the centre and the exponents `m` of its simple factors.
    ///
    /// The flag tells whether the numbers are proved: by a theorem, or, up to dimension 11, by
    /// verified closed forms. Beyond dimension 11, they follow from ranks modulo two primes. In a
    /// unimodular algebra, `d` on `Lambda^k` has the same rank as `d` on `Lambda^(n-1-k)` (Poincare
    /// duality).
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("heisenberg(3)")?);
    /// assert_eq!(algebra.betti_numbers(), Some((vec![1, 2, 2, 1], true)));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("cohomology", "Chevalley-Eilenberg"))]
    pub fn betti_numbers(&self) -> Option<(Vec<u64>, bool)> {
        let _stage = stage("cohomology");
        let trivial = Module::trivial(self.algebra(), 1);
        if self.dimension() <= MAX_CERTIFIED || !self.is_reductive() {
            return self.cohomology_of(&trivial);
        }
        self.by_exponents().map(|numbers| (numbers, true))
    }

    /// The dimensions of the cohomology `H^0, ..., H^n` with coefficients in a module of the algebra.
    /// [`betti_numbers`](Self::betti_numbers) are those of the trivial module; `H^0` are the
    /// invariants, `H^1` the derivations modulo inner ones. With the adjoint module, `H^2` describes
    /// infinitesimal deformations (A. Nijenhuis and R. Richardson, *Bull. Amer. Math. Soc.* 72 (1966)
    /// 1-29).
    ///
    /// The differential of a cochain `f` of degree 1 is `x f(y) - y f(x) - f([x, y])`. For a
    /// semisimple algebra, the cohomology is the product of the Betti numbers and the dimension of the
    /// invariants (Whitehead).
    ///
    /// `None` and the flag are as in `betti_numbers`.
    ///
    /// ```
    /// use affinor::algebra::{Module, catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = catalogue::algebra::<Rational>("heisenberg(3)")?;
    /// let theory = StructureTheory::new(algebra.clone());
    /// let numbers = theory.cohomology(&Module::adjoint(&algebra))?;
    /// assert_eq!(numbers, Some((vec![1, 4, 5, 2], true)));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`] if the module belongs to another algebra. The errors of
    /// [`Module::invariants`].
    #[doc(alias("deformations", "Whitehead"))]
    pub fn cohomology(&self, module: &Module<S>) -> Result<Option<(Vec<u64>, bool)>, Error> {
        self.expect_module(module)?;
        if module.is_trivial() {
            let m = module.dimension() as u64;
            let numbers = |betti: Vec<u64>| betti.into_iter().map(|b| b * m).collect();
            return Ok(self.betti_numbers().map(|(betti, proved)| (numbers(betti), proved)));
        }
        let large = self.dimension() > MAX_CERTIFIED
            || binomial(self.dimension(), self.dimension() / 2) * module.dimension() > MAX_LIFTED;
        if large && self.is_semisimple() {
            let _stage = stage("cohomology");
            let invariants = module.invariants()?.dimension() as u64;
            let Some(betti) = self.by_exponents() else { return Ok(None) };
            let numbers = betti.into_iter().map(|b| b.checked_mul(invariants));
            return Ok(numbers.collect::<Option<Vec<u64>>>().map(|numbers| (numbers, true)));
        }
        let _stage = stage("cohomology");
        Ok(self.cohomology_of(module))
    }

    fn expect_module(&self, module: &Module<S>) -> Result<(), Error> {
        match module.algebra() == self.algebra() {
            true => Ok(()),
            false => Err(Error::Shape {
                what: "the module",
                expected: "a module of this algebra".into(),
                found: "a module of another algebra".into(),
            }),
        }
    }

    /// The cohomology relative to a subalgebra `h`, with coefficients in a module: of the forms on
    /// `g/h` that `h` preserves. For a compact group and a connected closed subgroup with the algebra
    /// `h`, and trivial coefficients, the dimensions are the Betti numbers of the quotient.
    ///
    /// ```
    /// use affinor::algebra::{Module, catalogue, structure::{StructureTheory, Subspace}};
    /// use affinor::Rational;
    /// // the sphere SO(3)/SO(2)
    /// let algebra = catalogue::algebra::<Rational>("so(3)")?;
    /// let axis = Subspace::span(3, [vec![(2, Rational::from(1))]]);
    /// let theory = StructureTheory::new(algebra.clone());
    /// let found = theory.relative_cohomology(&axis, &Module::trivial(&algebra, 1))?;
    /// assert_eq!(found.betti, [1, 0, 1]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::Subalgebra`](crate::Law::Subalgebra) with two vectors; [`Error::Shape`] if the module belongs to another algebra
    /// or the subspace has another number of components; [`Error::Size`] for too many cochains.
    #[doc(alias("relative cohomology", "homogeneous space"))]
    pub fn relative_cohomology(
        &self,
        subalgebra: &Subspace<S>,
        module: &Module<S>,
    ) -> Result<Dimensions, Error> {
        self.expect_module(module)?;
        let n = self.dimension();
        if subalgebra.ambient() != n {
            return Err(Error::Shape {
                what: "the subalgebra",
                expected: format!("vectors with {n} components"),
                found: subalgebra.ambient().to_string(),
            });
        }
        self.subalgebra(subalgebra)?;
        let _stage = stage("relative cohomology");
        // a basis of a complement, then of the subalgebra
        let rows: Vec<Row<S>> = subalgebra
            .complement()
            .map(|at| vec![(at, S::one())])
            .chain(subalgebra.basis().iter().cloned())
            .collect();
        let entries = rows
            .iter()
            .enumerate()
            .flat_map(|(a, row)| row.iter().map(move |(i, value)| ([*i, a], value.clone())));
        let change = BasisChange::new(Tensor::from_components(n, &[Up, Down], entries)?)?;
        let algebra = self.algebra().change_basis(&change)?;
        let images: Vec<Vec<Row<S>>> = rows
            .iter()
            .map(|row| {
                let image = |v: usize| {
                    let terms = row.iter().flat_map(|(j, factor)| {
                        let image = module.image(*j, v).iter();
                        image.map(move |(at, value)| (*at, value.clone() * factor))
                    });
                    collected(terms.collect())
                };
                (0..module.dimension()).map(image).collect()
            })
            .collect();
        relative_cohomology(&algebra, n - subalgebra.dimension(), &images, module.dimension())
    }

    /// The dimensions of the cohomology from the ranks of the differentials.
    fn cohomology_of(&self, module: &Module<S>) -> Option<(Vec<u64>, bool)> {
        let (n, m) = (self.dimension(), module.dimension());
        if n > MAX_CERTIFIED || binomial(n, n / 2) * m > MAX_LIFTED {
            return Some((self.dimensions_modulo_primes(module)?, false));
        }
        let has_duality = self.is_unimodular() && module.is_trivial();
        let mut closed: Vec<Certified> = vec![];
        for k in 0..=n {
            let dual = n.checked_sub(k + 1).filter(|dual| *dual < k && has_duality);
            closed.push(match dual.map(|dual| (dual, closed[dual])) {
                Some((dual, Certified { dimension, proved })) => {
                    let rank = binomial(n, dual) * m - dimension;
                    Certified { dimension: binomial(n, k) * m - rank, proved }
                }
                None => self.closed_forms(k, module),
            });
        }
        let rank = |k: usize| binomial(n, k) * m - closed[k].dimension;
        let exact = |k: usize| if k == 0 { 0 } else { rank(k - 1) };
        let dimensions = (0..=n).map(|k| (closed[k].dimension - exact(k)) as u64);
        Some((dimensions.collect(), closed.iter().all(|counted| counted.proved)))
    }

    /// The Betti numbers of a reductive algebra.
    fn by_exponents(&self) -> Option<Vec<u64>> {
        let degrees = self.dynkin_type()?.into_iter().flat_map(exponents);
        let degrees = degrees.map(|m| 2 * m + 1);
        let lines = std::iter::repeat_n(1, self.radical().dimension());
        let mut polynomial = vec![1];
        for degree in degrees.chain(lines) {
            let mut product = polynomial.clone();
            product.resize(polynomial.len() + degree, 0);
            polynomial.iter().enumerate().for_each(|(at, value)| product[at + degree] += value);
            if product.iter().any(|value| *value > LARGEST) {
                return None;
            }
            polynomial = product;
        }
        Some(polynomial)
    }

    /// The dimensions of the cohomology from the ranks modulo two primes; if these differ, the larger
    /// rank is used.
    fn dimensions_modulo_primes(&self, module: &Module<S>) -> Option<Vec<u64>> {
        let n = self.dimension();
        if n > MAX_DIMENSION {
            return None;
        }
        let has_duality = self.is_unimodular() && module.is_trivial();
        let mut best: Option<Vec<Vec<u64>>> = None;
        let reductions = self.reductions().filter_map(|reduction| {
            let images = module.images_in(|value| value.residue(reduction.prime()))?;
            Some((reduction, images))
        });
        for (reduction, images) in reductions.take(2) {
            let [forms, ranks] = reduction.ranks_of_differentials(&images, has_duality)?;
            best = Some(match best {
                // combines the ranks only if the numbers of forms agree modulo both primes
                Some(known) if known[0] == forms => {
                    let larger = known[1].iter().zip(&ranks).map(|(a, b)| *a.max(b)).collect();
                    vec![forms, larger]
                }
                _ => vec![forms, ranks],
            });
        }
        let [forms, ranks] = &best?[..] else { return None };
        let exact = |k: usize| if k == 0 { 0 } else { ranks[k - 1] };
        (0..=n).map(|k| forms[k].checked_sub(ranks[k])?.checked_sub(exact(k))).collect()
    }

    /// The dimension of the space of closed cochains of degree `k`.
    fn closed_forms(&self, k: usize, module: &Module<S>) -> Certified {
        let (n, m) = (self.dimension(), module.dimension());
        let sets = sets(n, k);
        let kernel = |reduction: &ModularAlgebra| {
            let images = module.images_in(|value| value.residue(reduction.prime()))?;
            Some(reduction.closed_forms(&sets, &images))
        };
        let rational = module.images_in(GroundField::rational);
        self.counted(sets.len() * m, kernel, |structure, form| {
            let Some(images) = &rational else { return false };
            let image = form.iter().flat_map(|(at, factor)| {
                let (set, v) = (sets[at / m], at % m);
                let terms =
                    differential(n, |j| structure.products.of(j), |j| &images[j][v][..], set, v);
                terms.into_iter().map(move |(to, w, minus, c)| {
                    let value = c.clone() * factor;
                    ((to, w), if minus { -value } else { value })
                })
            });
            collected(image.collect()).is_empty()
        })
    }
}

fn binomial(n: usize, k: usize) -> usize {
    (0..k).fold(1usize, |value, i| value.saturating_mul(n - i) / (i + 1))
}

/// The images `[j][v]` of the basis vectors of a module, modulo a prime.
type Images = [Vec<Row<u64>>];

impl ModularAlgebra {
    /// The dimensions of a complex whose cohomology is the cohomology with coefficients in a module,
    /// and the ranks of its differentials, by degree. Returns `None` if the matrices are too large. If
    /// `duality` is set, the ranks above the middle degree are copied from the ranks below it.
    ///
    /// The Lie derivative of a vector acts as zero on cohomology. If the vector acts diagonally on the
    /// algebra and on the module, the cochains of weight zero are therefore sufficient. Cochains that
    /// are pivots of exact cochains are omitted, because they are closed up to others (`d d = 0`).
    fn ranks_of_differentials(&self, images: &Images, duality: bool) -> Option<[Vec<u64>; 2]> {
        let (n, p) = (self.dimension(), self.prime());
        let m = images.first().map_or(0, Vec::len);
        let is_diagonal = |j: &usize| {
            let mut columns = images[*j].iter().enumerate();
            self.of(*j).iter().all(|(k, i, _)| k == i)
                && columns.all(|(v, image)| image.iter().all(|(at, _)| *at == v))
        };
        let weights = (0..n).filter(is_diagonal).map(|j| {
            let mut weights = vec![0; n];
            self.of(j).iter().for_each(|&(k, _, value)| weights[k] = p.neg(value));
            let vectors = images[j].iter().map(|image| image.first().map_or(0, |one| one.1));
            (weights, vectors.collect::<Vec<u64>>())
        });
        let is_zero = |w: &[u64]| w.iter().all(|v| *v == 0);
        let weights: Vec<(Vec<u64>, Vec<u64>)> =
            weights.filter(|(forms, vectors)| !is_zero(forms) || !is_zero(vectors)).collect();
        let elements = |set: Indices| (0..n).filter(move |i| set >> i & 1 == 1);
        let invariant = |set: Indices, v: usize| {
            let weight = |(forms, vectors): &(Vec<u64>, Vec<u64>)| {
                elements(set).fold(vectors[v], |sum, i| p.add(sum, forms[i]))
            };
            weights.iter().all(|w| weight(w) == 0)
        };
        let mut cochains: Vec<Vec<(Indices, usize)>> = vec![];
        for k in 0..=n {
            checkpoint();
            if binomial(n, k).saturating_mul(m) > MAX_ROWS * MAX_DIMENSION * 8 {
                return None;
            }
            let pairs = sets(n, k).into_iter().flat_map(|set| (0..m).map(move |v| (set, v)));
            cochains.push(pairs.filter(|(set, v)| invariant(*set, *v)).collect());
        }
        let rows = cochains.iter().map(Vec::len).max().unwrap_or(0);
        let constants: usize = (0..n).map(|j| self.of(j).len() / 2).sum();
        let actions: usize = images.iter().flatten().map(Vec::len).sum::<usize>() / m.max(1);
        if rows > MAX_ROWS || rows * (constants + actions) > MAX_WORK {
            return None;
        }
        let column = |set: Indices, v: usize| set as usize * m + v;
        let mut ranks: Vec<u64> = vec![];
        let mut exact: HashSet<usize> = HashSet::new();
        for (k, cochains) in cochains.iter().enumerate() {
            if let Some(&dual) = n.checked_sub(k + 1).and_then(|dual| ranks.get(dual))
                && duality
            {
                ranks.push(dual);
                continue;
            }
            let mut echelon = Echelon::new(Lead::Low, p.get());
            let mut pivots = vec![];
            for &(set, v) in cochains.iter().filter(|(set, v)| !exact.contains(&column(*set, *v))) {
                checkpoint();
                let row = self.row(images, set, v).into_iter();
                let row = row.map(|((to, w), value)| (column(to, w), value));
                pivots.extend(echelon.insert(&row.collect::<Vec<_>>()));
            }
            exact.extend(&pivots);
            ranks.push(pivots.len() as u64);
        }
        Some([cochains.iter().map(|all| all.len() as u64).collect(), ranks])
    }

    /// The differential of `e^set ⊗ v`. Several terms may belong to one cochain.
    fn row(&self, images: &Images, set: Indices, v: usize) -> Vec<((Indices, usize), u64)> {
        let (n, p) = (self.dimension(), self.prime());
        let terms = differential(n, |j| self.of(j), |j| &images[j][v][..], set, v).into_iter();
        let signed = |minus: bool, c: u64| if minus { p.neg(c) } else { c };
        terms.map(|(to, w, minus, &c)| ((to, w), signed(minus, c))).collect()
    }

    /// A basis of the closed cochains that are combinations of the forms with these index `sets`, in
    /// reduced echelon form.
    fn closed_forms(&self, sets: &[Indices], images: &Images) -> Vec<Vec<u64>> {
        let p = self.prime();
        let m = images.first().map_or(0, Vec::len);
        let mut equations: BTreeMap<(Indices, usize), Vec<(usize, u64)>> = BTreeMap::new();
        for (at, &set) in sets.iter().enumerate() {
            checkpoint();
            for v in 0..m {
                for (to, value) in self.row(images, set, v) {
                    equations.entry(to).or_default().push((at * m + v, value));
                }
            }
        }
        let mut echelon = Echelon::new(Lead::Low, p.get());
        equations.values().for_each(|row| {
            checkpoint();
            echelon.insert(row);
        });
        let length = sets.len() * m;
        let dense = |row: Vec<(usize, u64)>| {
            let mut vector = vec![0; length];
            row.into_iter().for_each(|(at, value)| vector[at] = value);
            vector
        };
        echelon.nullspace(length).into_iter().map(dense).collect()
    }
}
