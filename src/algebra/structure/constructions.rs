//! Constructions of Lie algebras: quotients, extensions, semidirect sums, tensor products,
//! contractions, complexifications.
//!
//! Each construction checks its conditions, and returns an error with a witness if a condition is
//! violated. Related functions are [`LieAlgebra::direct_sum`], [`StructureTheory::subalgebra`] and
//! [`LieAlgebra::change_basis`].

use super::subspace::{collected, combination};
use super::{GroundField, StructureTheory, Subspace};
use crate::algebra::{Bracket, LieAlgebra, Module, join_labels};
use crate::{Error, Law};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Tensor, Up};

/// The largest dimension of a commutative factor. The time to check its products grows with the
/// cube of the dimension.
const MOST_UNITS: usize = 64;

/// Structure constants `(j, k, i, v)`, which mean `[e_j, e_k] = ... + v e_i`.
type Constants<S> = Vec<(usize, usize, usize, S)>;

impl<S: GroundField> StructureTheory<S> {
    /// The structure constants with `j < k`.
    fn constants(&self) -> Constants<S> {
        let lines = (0..self.dimension()).flat_map(|j| {
            let line = self.products.of(j).iter().filter(move |(k, ..)| j < *k);
            line.map(move |(k, i, value)| (j, *k, *i, value.clone()))
        });
        lines.collect()
    }

    /// The quotient by an ideal. Its basis consists of the images of those basis vectors that
    /// complement the ideal.
    ///
    /// # Errors
    /// [`Law::Ideal`] with a bracket that leaves the subspace; [`Error::Shape`] if the subspace has
    /// another ambient dimension.
    pub fn quotient(&self, ideal: &Subspace<S>) -> Result<LieAlgebra<S>, Error> {
        if ideal.ambient() != self.dimension() {
            let (expected, found) = (self.dimension().to_string(), ideal.ambient().to_string());
            return Err(Error::Shape { what: "the vectors of the ideal", expected, found });
        }
        let labels = self.algebra.labels();
        for v in ideal.basis() {
            let ad = self.products.ad(v);
            if let Some((k, column)) = ad.columns().find(|(_, column)| !ideal.contains(column)) {
                let minus: Row<S> = column.iter().map(|(at, v)| (*at, -v.clone())).collect();
                let at = [labels[k].clone(), self.write(v)];
                return Err(Law::Ideal.broken(at, self.write(&minus)));
            }
        }
        let places: Vec<usize> = ideal.complement().collect();
        let place = |at: &usize| places.binary_search(at).ok();
        let mut constants = vec![];
        for (j, at) in places.iter().enumerate() {
            for (k, other) in places.iter().enumerate().skip(j + 1) {
                let bracket = self.products.ad(&[(*at, S::one())]).column(*other).to_vec();
                let rest = ideal.reduce(bracket).into_iter();
                constants.extend(rest.filter_map(|(i, value)| Some((j, k, place(&i)?, value))));
            }
        }
        let labels = places.iter().map(|at| labels[*at].clone());
        Bracket::from_constants(labels, constants)?.try_into()
    }

    /// The central extension by the vectors `labels`. The bracket `[x, y]` is extended by the
    /// components `omega_a(x, y)`, which are given as `(j, k, a, omega_a(e_j, e_k))`.
    ///
    /// # Errors
    /// [`Law::Cocycle`] with three basis vectors for which the cyclic sum of `omega([x,y],z)` is
    /// not zero. [`Error::Shape`] for an index `j` or `k` beyond the dimension of this algebra.
    pub fn central_extension(
        &self,
        labels: &[String],
        cocycle: impl IntoIterator<Item = (usize, usize, usize, S)>,
    ) -> Result<LieAlgebra<S>, Error> {
        let n = self.dimension();
        let cocycle: Vec<_> = cocycle.into_iter().collect();
        if let Some(found) = cocycle.iter().map(|(j, k, ..)| j.max(k)).find(|at| **at >= n) {
            let (expected, found) = (format!("indices below {n}"), found.to_string());
            return Err(Error::Shape { what: "the cocycle", expected, found });
        }
        let further = cocycle.into_iter().map(|(j, k, a, value)| (j, k, n + a, value));
        let constants = self.constants().into_iter().chain(further);
        let labels = join_labels(self.algebra.labels(), labels);
        let bracket = Bracket::from_constants(labels, constants)?;
        LieAlgebra::try_from(bracket).map_err(|error| match error {
            Error::Broken { law: Law::Jacobi, at, residual } => Law::Cocycle.broken(at, residual),
            error => error,
        })
    }

    /// The semidirect sum in which this algebra acts on the algebra `on`: `[e_j, v] = D_j v`.
    ///
    /// # Errors
    /// [`Law::Derivation`] with two vectors of `on`; [`Law::Action`] with two basis vectors and a
    /// component in which `D_[x,y]` differs from `[D_x, D_y]`; [`Error::Shape`] for a wrong number
    /// or size of matrices.
    pub fn semidirect(
        &self,
        on: &StructureTheory<S>,
        by: &[Matrix<S>],
    ) -> Result<LieAlgebra<S>, Error> {
        let (n, m) = (self.dimension(), on.dimension());
        let module = Module::unchecked(&self.algebra, on.algebra.labels(), by.to_vec())?;
        let minus =
            |row: Row<S>| row.into_iter().map(|(at, value)| (at, -value)).collect::<Row<S>>();
        let labels = self.algebra.labels();
        for (at, label) in labels.iter().enumerate() {
            let d = |j: usize| module.image(at, j);
            for j in 0..m {
                let ad = on.products.ad(&[(j, S::one())]);
                let moved = on.products.ad(d(j));
                for k in j + 1..m {
                    let right = [moved.column(k).to_vec(), ad.image(d(k))].concat();
                    let left = module.act(at, ad.column(k));
                    let residual = collected([left, minus(right)].concat());
                    if !residual.is_empty() {
                        let [x, y] = [j, k].map(|at| on.algebra.labels()[at].clone());
                        let at = [label.clone(), x, y];
                        return Err(Law::Derivation.broken(at, on.write(&residual)));
                    }
                }
            }
        }
        module.expect_action()?;
        let shifted = on.constants().into_iter().map(|(j, k, i, v)| (j + n, k + n, i + n, v));
        let pairs = (0..n).flat_map(|j| (0..m).map(move |k| (j, k)));
        let acted = pairs.flat_map(|(j, k)| {
            let image = module.image(j, k).iter();
            image.map(move |(i, value)| (j, n + k, n + i, value.clone()))
        });
        let constants = self.constants().into_iter().chain(shifted).chain(acted);
        let labels = join_labels(labels, on.algebra.labels());
        Bracket::from_constants(labels, constants)?.try_into()
    }

    /// The semidirect sum with the dual space, on which the algebra acts by the coadjoint action:
    /// `[x, f](y) = -f([x, y])`. The labels of the dual basis end in `_star`.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for the indices of a tensor, 64 bits.
    pub fn with_dual(&self) -> Result<LieAlgebra<S>, Error> {
        let n = self.dimension();
        let labels = self.algebra.labels().iter().map(|label| format!("{label}_star"));
        let dual = Bracket::from_constants(labels, [])?.try_into()?;
        let coadjoint = (0..n).map(|j| {
            let mut rows = vec![vec![]; n];
            for (k, i, value) in self.products.of(j) {
                // row k and column i of the negative transpose of ad
                rows[*k].push((*i, -value.clone()));
            }
            Matrix::from_rows(n, rows)
        });
        let coadjoint = coadjoint.collect::<Result<Vec<_>, _>>()?;
        self.semidirect(&StructureTheory::new(dual), &coadjoint)
    }

    /// The tensor product with a commutative algebra: `[x u_a, y u_b] = [x, y] (u_a u_b)`. The
    /// basis is `x u_a`, with the labels `x_u`. `products` has the slots `^d_ab` and defines
    /// `u_a u_b = p^d_ab u_d` for the basis `units`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::algebra::structure::StructureTheory;
    /// use affinor::tensors::{Down, Rational, Tensor, Up};
    /// // two units with u u = u, v v = v, u v = 0: two copies of the algebra
    /// let diagonal = |[d, a, b]: [usize; 3]| Rational::from(i64::from(d == a && a == b));
    /// let products = Tensor::from_fn(2, [Up, Down, Down], diagonal)?;
    /// let so3 = StructureTheory::new(catalogue::algebra::<Rational>("so(3)")?);
    /// let twice = so3.tensor_product(&["u".into(), "v".into()], &products)?;
    /// assert_eq!(twice.labels()[3], "e1_v");
    /// assert_eq!(StructureTheory::new(twice).killing().signature(), Some([0, 6, 0]));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::Commutative`] and [`Law::Associative`] with vectors that violate the law;
    /// [`Error::Shape`]; [`Error::Size`] for more than 64 vectors.
    pub fn tensor_product(
        &self,
        units: &[String],
        products: &Tensor<S>,
    ) -> Result<LieAlgebra<S>, Error> {
        let m = units.len();
        if m > MOST_UNITS {
            return Err(Error::Size { what: "vectors of the factor", size: m, limit: MOST_UNITS });
        }
        if products.dimension() != m || products.slots() != [Up, Down, Down] {
            let expected = format!("the slots ^d_ab and the dimension {m}");
            let found =
                format!("{} slots and the dimension {}", products.rank(), products.dimension());
            return Err(Error::Shape { what: "the table of products", expected, found });
        }
        let mut table = vec![vec![Row::new(); m]; m];
        for (at, value) in products.components() {
            table[at[1]][at[2]].push((at[0], value.clone()));
        }
        expect_commutative_algebra(units, &table)?;
        let label = |unit: &String| {
            let labels = self.algebra.labels().iter();
            labels.map(|label| format!("{label}_{unit}")).collect::<Vec<_>>()
        };
        self.over(units.iter().flat_map(label).collect(), &table)
    }

    /// The tensor product with the truncated polynomials `R[t]/(t^order)`:
    /// `[x t^a, y t^b] = [x,y] t^(a+b)`. If the order is 2, the polynomials are the dual numbers,
    /// and the product is the tangent algebra.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for the indices of a tensor, 64 bits.
    pub fn truncated(&self, order: usize) -> Result<LieAlgebra<S>, Error> {
        let name = |power: usize| {
            move |label: &String| match power {
                0 => label.clone(),
                _ => format!("{label}_t{power}"),
            }
        };
        let labels = (0..order).flat_map(|power| self.algebra.labels().iter().map(name(power)));
        let power = |a: usize, b: usize| (a + b < order).then(|| (a + b, S::one()));
        let row = |a: usize| (0..order).map(|b| power(a, b).into_iter().collect()).collect();
        self.over(labels.collect(), &(0..order).map(row).collect::<Vec<_>>())
    }

    /// The complexification as a real algebra, in the basis `x` and `i x`. The label of `i x` is
    /// `ix`.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for the indices of a tensor, 64 bits.
    pub fn complexified(&self) -> Result<LieAlgebra<S>, Error> {
        let imaginary: Vec<String> =
            self.algebra.labels().iter().map(|label| format!("i{label}")).collect();
        let labels = join_labels(self.algebra.labels(), &imaginary);
        let [one, i, minus] = [(0, S::one()), (1, S::one()), (0, -S::one())].map(|unit| vec![unit]);
        self.over(labels, &[vec![one, i.clone()], vec![i, minus]])
    }

    /// The tensor product with the algebra that has this table of `products`:
    /// `[x u_a, y u_b] = [x, y] (u_a u_b)`. The basis consists of all `x u_0`, then all `x u_1`,
    /// and so on.
    fn over(&self, labels: Vec<String>, products: &[Vec<Row<S>>]) -> Result<LieAlgebra<S>, Error> {
        let (n, all) = (self.dimension(), self.products_of_all());
        let mut constants = vec![];
        for (a, row) in products.iter().enumerate() {
            for (b, product) in row.iter().enumerate() {
                for (j, k, i, value) in all.iter().filter(|(j, k, ..)| a * n + j < b * n + k) {
                    constants.extend(product.iter().map(|(d, factor)| {
                        (a * n + j, b * n + k, d * n + i, value.clone() * factor)
                    }));
                }
            }
        }
        Bracket::from_constants(labels, constants)?.try_into()
    }

    /// The contraction that scales `e_i` by `t^w_i` in the limit of `t` to 0. Constants with
    /// `w_j + w_k = w_i` are unchanged, and constants with `w_j + w_k > w_i` vanish (Inönü and
    /// Wigner, *Proc. Natl. Acad. Sci.* 39 (1953) 510-524; E. J. Saletan, *J. Math. Phys.* 2 (1961)
    /// 1-21).
    ///
    /// # Errors
    /// [`Law::Limit`] with a constant for which `w_j + w_k < w_i`; [`Error::Shape`] if the number
    /// of weights is wrong.
    pub fn inonu_wigner_contraction(&self, weights: &[i64]) -> Result<LieAlgebra<S>, Error> {
        if weights.len() != self.dimension() {
            let (expected, found) = (self.dimension().to_string(), weights.len().to_string());
            return Err(Error::Shape { what: "the number of weights", expected, found });
        }
        let labels = self.algebra.labels();
        let mut kept = vec![];
        for (j, k, i, value) in self.constants() {
            let [j_weight, k_weight, i_weight] = [j, k, i].map(|at| i128::from(weights[at]));
            match (j_weight + k_weight).cmp(&i_weight) {
                std::cmp::Ordering::Equal => kept.push((j, k, i, value)),
                std::cmp::Ordering::Greater => {}
                std::cmp::Ordering::Less => {
                    let at = [j, k, i].map(|at| labels[at].clone());
                    return Err(Law::Limit.broken(at, value.to_string()));
                }
            }
        }
        Bracket::from_constants(labels, kept)?.try_into()
    }

    /// The structure constants of all pairs, including those with `j > k`.
    fn products_of_all(&self) -> Constants<S> {
        let lines = (0..self.dimension()).flat_map(|j| {
            self.products.of(j).iter().map(move |(k, i, value)| (j, *k, *i, value.clone()))
        });
        lines.collect()
    }
}

/// Checks that a table of products of vectors is commutative and associative.
fn expect_commutative_algebra<S: GroundField>(
    units: &[String],
    table: &[Vec<Row<S>>],
) -> Result<(), Error> {
    let m = units.len();
    let minus = |row: &Row<S>| -> Row<S> { row.iter().map(|(d, v)| (*d, -v.clone())).collect() };
    let write = |row: &Row<S>| {
        let terms = row.iter().map(|(d, value)| (value.to_string(), units[*d].clone()));
        affinor_tensors::text::combination(terms.collect::<Vec<_>>())
    };
    for (x, y) in (0..m).flat_map(|y| (0..y).map(move |x| (x, y))) {
        let residual = collected([table[x][y].clone(), minus(&table[y][x])].concat());
        if !residual.is_empty() {
            let at = [x, y].map(|at| units[at].clone());
            return Err(Law::Commutative.broken(at, write(&residual)));
        }
    }
    for (x, y, z) in (0..m).flat_map(|x| (0..m).flat_map(move |y| (0..x).map(move |z| (z, y, x)))) {
        let left = combination(&table[z], &table[x][y]);
        let right = combination(&table[x], &table[y][z]);
        let residual = collected([left, minus(&right)].concat());
        if !residual.is_empty() {
            let at = [x, y, z].map(|at| units[at].clone());
            return Err(Law::Associative.broken(at, write(&residual)));
        }
    }
    Ok(())
}
