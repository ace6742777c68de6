//! The simple ideals of a semisimple algebra, over the rationals and over the reals.
//!
//! An algebra over the rationals is the sum of ideals that are simple over the rationals. The
//! centroid of such an ideal is a number field. Over the reals, the ideal is a sum: one absolutely
//! simple ideal for each real place of the field, and one complex algebra for each pair of complex
//! places.

use super::dynkin::{Split, inverse_of_columns};
use super::killing::Killing;
use super::radical::on_moment_curve;
use super::real_forms::{complex_form, real_forms};
use super::reduction::{ModularAlgebra, PseudoRandom};
use super::{StructureTheory, Subspace};
use crate::Error;
use crate::algebra::irreducible_factors;
use crate::algebra::matrix_polynomials::{evaluate, monic};
use crate::algebra::roots::CartanType;
use affinor_tensors::linear::modular::{RationalReconstruction, ResidueMatrix, primes};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Rational, Ring};
use num_rational::BigRational;
use polycore::Uni;

/// The simple ideals over the reals.
#[derive(Clone, Debug)]
pub struct SimpleIdeals {
    /// The ideals that are simple over the rationals.
    pub rational: Vec<Subspace<Rational>>,
    /// The ideals that are simple over the reals, each with the index of the rational ideal that
    /// contains it.
    pub real: Vec<RealIdeal>,
}

/// An ideal that is simple over the reals.
#[derive(Clone, Debug)]
pub struct RealIdeal {
    /// The index of the rational ideal that contains this ideal.
    pub within: usize,
    /// The type over the complex numbers; for a complex algebra, the type of one of its two
    /// factors.
    pub cartan_type: CartanType,
    /// Whether it is a complex algebra regarded as real.
    pub is_complex: bool,
    /// The numbers of positive and of negative squares of the Killing form.
    pub signature: [usize; 2],
    /// The names: one name, or two names if type and signature do not determine the real form.
    pub names: Vec<String>,
}

impl RealIdeal {
    /// The dimension over the reals.
    pub fn dimension(&self) -> usize {
        self.signature.iter().sum()
    }

    /// The type over the complex numbers: `A1`, or `A1 + A1` for a complex algebra.
    pub fn type_name(&self) -> String {
        match self.is_complex {
            true => format!("{0} + {0}", self.cartan_type),
            false => self.cartan_type.to_string(),
        }
    }
}

/// The maximum number of primes for the reconstruction of the centroid.
const PRIMES: usize = 200;
/// The number of elements of the centroid with short coefficients that are tried first, if its
/// dimension is small.
const SHORT: i64 = 64;
const FEW: usize = 12;

impl StructureTheory<Rational> {
    /// The simple ideals of a semisimple algebra. Returns `None` if the search fails.
    ///
    /// # Errors
    /// The errors of [`subalgebra`](Self::subalgebra). They cannot occur for a semisimple algebra.
    pub fn simple_ideals(&self) -> Result<Option<SimpleIdeals>, Error> {
        let _stage = stage("simple ideals");
        let Some(types) = self.dynkin_type() else { return Ok(None) };
        let mut ideals = SimpleIdeals { rational: vec![], real: vec![] };
        if let [one] = types[..] {
            let Some([plus, minus, _]) = self.killing().signature() else { return Ok(None) };
            ideals.rational.push(self.whole());
            let mut ideal = RealIdeal::real(0, one, [plus, minus]);
            ideal.names = self.by_cartan_subalgebra(one.rank(), ideal.names);
            ideals.real.push(ideal);
            return Ok(Some(ideals));
        }
        let Some(centroid) = self.centroid(types.len()) else { return Ok(None) };
        let Some((gamma, minimal)) = generator(&centroid) else { return Ok(None) };
        for (factor, _) in irreducible_factors(&minimal) {
            let Some(complementary) = minimal.exact(&factor) else { return Ok(None) };
            let projection = evaluate(&gamma, &complementary);
            let image = projection.transpose();
            let ideal = Subspace::span(
                self.dimension(),
                (0..image.rows()).map(|at| image.row(at).to_vec()),
            );
            let inside = self.subalgebra(&ideal)?;
            let Some(types) = inside.dynkin_type() else { return Ok(None) };
            let Some(&cartan_type) = types.first() else { return Ok(None) };
            let within = ideals.rational.len();
            // the columns of gamma in the basis of the ideal
            let columns = ideal.basis().iter().map(|row| {
                let image = super::subspace::combination(
                    &(0..gamma.columns()).map(|k| column(&gamma, k)).collect::<Vec<_>>(),
                    row,
                );
                ideal.coordinates(&image)
            });
            let Some(columns) = columns.collect::<Option<Vec<Row<Rational>>>>() else {
                return Ok(None);
            };
            let theta = Matrix::from_rows(ideal.dimension(), columns)?.transpose();
            let Some(real) = inside.real_places(within, cartan_type, &theta, &factor) else {
                return Ok(None);
            };
            ideals.real.extend(real);
            ideals.rational.push(ideal);
        }
        Ok(Some(ideals))
    }

    /// The absolutely simple ideals, over the reals, of an ideal that is simple over the rationals.
    /// `theta` generates the centroid of the ideal.
    ///
    /// The signature at one real place is half the sum of the signatures of `K(x, y)` and of
    /// `K(g(theta) x, y)`. Here `g` is positive at this place, and negative at the other real
    /// places. Complex places contribute nothing.
    fn real_places(
        &self,
        within: usize,
        cartan_type: CartanType,
        theta: &Matrix<Rational>,
        minimal: &Uni<BigRational>,
    ) -> Option<Vec<RealIdeal>> {
        let places = separated(minimal);
        let n = cartan_type.dimension();
        let excess = |killing: &Killing<Rational>| {
            killing.signature().map(|[plus, minus, _]| plus as i64 - minus as i64)
        };
        let all = excess(self.killing())?;
        let mut ideals = vec![];
        for (lower, upper) in &places {
            let own = if places.len() == 1 {
                all
            } else {
                let linear = |root: &BigRational| {
                    Uni::new(vec![-root.clone(), BigRational::from_integer(1.into())])
                };
                let g = &linear(lower) * &linear(upper);
                let g = g.scale(&BigRational::from_integer((-1).into()));
                let form = evaluate(theta, &g).transpose().mul(self.killing_matrix()).ok()?;
                (all + excess(&Killing::new(form))?) / 2
            };
            let plus = usize::try_from((n as i64 + own) / 2).ok()?;
            ideals.push(RealIdeal::real(within, cartan_type, [plus, n.checked_sub(plus)?]));
        }
        if let (1, [one]) = (minimal.deg(), &mut ideals[..]) {
            one.names =
                self.by_cartan_subalgebra(cartan_type.rank(), std::mem::take(&mut one.names));
        }
        let complex = (minimal.deg() - places.len()) / 2;
        ideals.extend((0..complex).map(|_| RealIdeal {
            within,
            cartan_type,
            is_complex: true,
            signature: [n, n],
            names: vec![complex_form(cartan_type)],
        }));
        Some(ideals)
    }

    /// Chooses between two real forms with the same type and signature. A regular element or the
    /// Cartan subalgebra may exclude one of them; otherwise both names are returned.
    ///
    /// The dimension of the noncompact part of a Cartan subalgebra is at most the real rank. The
    /// real rank is the minimum of `p` and `q` for su(p,q) and so(p,q), and half of `n` for
    /// so*(2n). The Cartan subalgebras of su*(2n) are conjugate, and their noncompact part has
    /// dimension `n - 1`, which exceeds the real rank of the other form.
    fn by_cartan_subalgebra(&self, rank: usize, names: Vec<String>) -> Vec<String> {
        let [indefinite, quaternionic] = &names[..] else { return names };
        if let Some(quaternionic) = self.is_quaternionic_orthogonal() {
            return vec![names[usize::from(quaternionic)].clone()];
        }
        let noncompact = |cartan: Subspace<Rational>| {
            let basis = Matrix::from_rows(self.dimension(), cartan.basis().iter().cloned()).ok()?;
            let form = basis.mul(self.killing_matrix()).ok()?.mul(&basis.transpose()).ok()?;
            Killing::new(form).signature().map(|[plus, ..]| plus)
        };
        let hyperbolic = self.hyperbolic_cartan_subalgebra(rank).and_then(noncompact);
        let Some(noncompact) = hyperbolic.or_else(|| noncompact(self.cartan_subalgebra())) else {
            return names;
        };
        let number = |text: &str| text.parse::<usize>().ok();
        let argument =
            quaternionic.split_once('(').and_then(|(_, n)| number(n.trim_end_matches(')')));
        let Some(half) = argument.map(|argument| argument / 2) else { return names };
        match quaternionic.starts_with("su*") {
            true if noncompact + 1 == half => vec![quaternionic.clone()],
            true => vec![indefinite.clone()],
            false if noncompact > half / 2 => vec![indefinite.clone()],
            false => names,
        }
    }

    /// A basis of the maps that commute with all `ad`. The basis is reconstructed from residues and
    /// verified.
    pub(super) fn centroid(&self, dimension: usize) -> Option<Vec<Matrix<Rational>>> {
        let n = self.dimension();
        let mut images = RationalReconstruction::new(dimension * n * n);
        let mut draw = PseudoRandom::new(4);
        let mut pivots: Option<Vec<usize>> = None;
        for prime in primes().take(PRIMES) {
            let Some(reduction) = ModularAlgebra::new(self, prime) else { continue };
            let Some(rows) = reduction.centroid(&mut draw) else { continue };
            let mut echelon = ResidueMatrix::new(prime, n * n, rows);
            let found = echelon.reduce();
            if found.len() != dimension {
                continue;
            }
            if pivots.as_ref().is_some_and(|pivots| *pivots != found) {
                images = RationalReconstruction::new(dimension * n * n);
            }
            pivots = Some(found);
            images.add(prime, &echelon.rows().concat());
            let Some(values) = images.rationals() else { continue };
            let matrices: Vec<Matrix<Rational>> = values
                .chunks(n * n)
                .filter_map(|entries| {
                    Matrix::from_dense(&entries.chunks(n).map(<[_]>::to_vec).collect::<Vec<_>>())
                        .ok()
                })
                .collect();
            if matrices.iter().all(|matrix| self.commutes(matrix)) {
                return Some(matrices);
            }
        }
        None
    }

    /// Whether `A [e_j, e_k] = [e_j, A e_k]` for all `j`, `k`.
    fn commutes(&self, a: &Matrix<Rational>) -> bool {
        let n = self.dimension();
        let columns: Vec<Row<Rational>> = (0..n).map(|k| column(a, k)).collect();
        (0..n).all(|j| {
            let ad = self.products.ad(&[(j, Rational::from_i64(1))]);
            (0..n).all(|k| {
                super::subspace::combination(&columns, ad.column(k)) == ad.image(&columns[k])
            })
        })
    }
}

impl RealIdeal {
    fn real(within: usize, cartan_type: CartanType, signature: [usize; 2]) -> Self {
        let names = real_forms(cartan_type, signature[1]);
        RealIdeal { within, cartan_type, is_complex: false, signature, names }
    }
}

impl ModularAlgebra {
    /// The centroid modulo the prime. Each map is a list of its matrix entries, row by row.
    fn centroid(&self, draw: &mut PseudoRandom) -> Option<Vec<Vec<u64>>> {
        let (n, p) = (self.dimension(), self.prime());
        let split = Split::new(self, draw)?;
        let (r, m) = (split.rank, n - split.rank);
        let mut one = vec![0; m];
        one[0] = 1;
        // the columns are the coordinates in H of the coroots h_k, and of their images under each
        // map
        let coroots = split.coroots(self, &one, &one);
        let from = inverse_of_columns(p, &coroots)?;
        let mut matrices = vec![];
        for polynomial in &split.centroid {
            let images = split.coroots(self, polynomial, &one);
            // the matrix of the map on H is the product of the images and the inverse of the
            // columns
            let mut coordinates = vec![vec![0; n]; n];
            for (at, column) in coordinates.iter_mut().enumerate() {
                if at < r {
                    for (k, image) in images.iter().enumerate() {
                        let factor = from.rows()[k][at];
                        let pairs = column.iter_mut().zip(image);
                        pairs.for_each(|(c, &v)| *c = p.reduce(*c + factor * v));
                    }
                }
            }
            let mut power = polynomial.clone();
            for column in &mut coordinates[r..] {
                column[r..].copy_from_slice(&power);
                power = split.times_x(&power);
            }
            // transforms the matrix from coordinates to vectors, for arguments and for images
            let columns: Vec<Vec<u64>> = coordinates
                .iter()
                .map(|column| {
                    let mut sum = vec![0; n];
                    for (&factor, vector) in column.iter().zip(&split.basis) {
                        let pairs = sum.iter_mut().zip(vector);
                        pairs.for_each(|(s, &v)| *s = p.reduce(*s + factor * v));
                    }
                    sum
                })
                .collect();
            let mut matrix = vec![0; n * n];
            for (k, column) in columns.iter().enumerate() {
                for (i, &value) in column.iter().enumerate().filter(|(_, value)| **value != 0) {
                    for (j, &entry) in split.coordinates.rows()[k].iter().enumerate() {
                        matrix[i * n + j] = p.reduce(matrix[i * n + j] + value * entry);
                    }
                }
            }
            matrices.push(matrix);
        }
        Some(matrices)
    }
}

fn column(matrix: &Matrix<Rational>, k: usize) -> Row<Rational> {
    let entries = (0..matrix.rows()).map(|i| (i, matrix.get(i, k)));
    entries.filter(|(_, value)| !value.vanishes()).collect()
}

/// An element that generates the algebra of commuting matrices, and its minimal polynomial. The
/// degree of the polynomial proves that the element is a generator.
fn generator(matrices: &[Matrix<Rational>]) -> Option<(Matrix<Rational>, Uni<BigRational>)> {
    let (degree, n) = (matrices.len(), matrices.first()?.rows());
    let first = if degree <= FEW { 1 } else { SHORT };
    for trial in first.. {
        let (factors, start): (Vec<Rational>, Vec<Rational>) = match trial < SHORT {
            true => {
                let factor = |at: i64| (trial * (at + 1) * (at + trial)) % 11;
                let component = |i: i64| (i * 7 + trial) % 13 + 1;
                let integers = |count: usize, value: &dyn Fn(i64) -> i64| {
                    (0..count as i64).map(|at| Rational::from(value(at))).collect()
                };
                (integers(degree, &factor), integers(n, &component))
            }
            // uses points of a moment curve: at all but a few of them, distinct eigenvalues remain
            // distinct and the vector has components in all eigenspaces
            false => {
                let t = trial - SHORT + 2;
                (on_moment_curve(t, degree), on_moment_curve(t, n))
            }
        };
        let mut gamma = Matrix::zero(n, n);
        for (matrix, factor) in matrices.iter().zip(&factors) {
            gamma = gamma.add(&matrix.map(|v| v.clone() * factor)).ok()?;
        }
        let mut powers = vec![start];
        for at in 0..degree {
            powers.push(gamma.apply(&powers[at]).ok()?);
        }
        let system = Matrix::from_dense(&powers[..degree]).ok()?.transpose();
        if system.rank().ok()? < degree {
            continue;
        }
        let solution = system.solve(&powers[degree]).ok()??;
        return Some((gamma, monic(&solution)));
    }
    None
}

/// Isolating intervals of the real roots, one for each root.
fn separated(polynomial: &Uni<BigRational>) -> Vec<(BigRational, BigRational)> {
    let two = BigRational::from_integer(2.into());
    polynomial
        .isolate()
        .into_iter()
        .map(|(lower, upper)| {
            // enlarges the interval of a rational root; other roots are irrational, so they differ
            // from the rational bounds
            let room = (&upper - &lower) / &two;
            if polynomial.deg() == 1 { (&lower - &room, &upper + &room) } else { (lower, upper) }
        })
        .collect()
}
