//! Polynomial Casimir functions, the invariants of the coadjoint action, by degree.
//!
//! The coordinate `mu_i` acts on a monomial by `{mu_i, mu^a} = c^k_ij a_j mu_k mu^a / mu_j`, up to
//! the sign of the bracket. A function that all coordinates annihilate is a Casimir function. If
//! the brackets contain parameters, the linear equations are solved over the field of rational
//! functions of the parameters.

use super::LiePoisson;
use crate::Error;
use crate::algebra::invariants::common_kernel;
use crate::algebra::structure::primitive_factor;
use affinor_tensors::linear::{Echelon, Row};
use affinor_tensors::stop::stage;
use affinor_tensors::{Field, Rational, Scalar, Symbolic, Tolerance};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// The largest number of monomials of one degree in a search for Casimir functions. In a dense
/// basis, only far smaller searches are practical; see
/// [`MAX_UNKNOWNS`](crate::algebra::invariants::MAX_UNKNOWNS).
pub const MAX_MONOMIALS: usize = 1 << 15;
/// The highest degree of a search for Casimir functions.
pub const MAX_DEGREE: u32 = 255;

impl LiePoisson {
    /// A basis of the homogeneous Casimir functions of a degree. They are the polynomial invariants
    /// of the coadjoint action of the connected group.
    ///
    /// For a simple algebra of rank `l` the Casimir functions are the polynomials in `l`
    /// generators, whose degrees are the exponents plus 1 (C. Chevalley, *Amer. J. Math.* 77 (1955)
    /// 778-782).
    ///
    /// If the structure constants contain parameters, the basis is valid for generic values. Each
    /// function is also a polynomial in the parameters, without a common factor. Each function is
    /// therefore a Casimir function at all parameter values for which the structure constants are
    /// defined. At exceptional values the functions may be linearly dependent, and there may be
    /// more Casimir functions.
    ///
    /// ```
    /// use affinor::algebra::Bracket;
    /// use affinor::{LieAlgebra, LiePoisson, Symbolic};
    /// let [a, b, c] = ["a", "b", "c"].map(Symbolic::parameter);
    /// let labels = ["e1", "e2", "e3"].map(String::from).to_vec();
    /// let constants = [(0, 1, 2, a), (1, 2, 0, b), (2, 0, 1, c)];
    /// let space = LiePoisson::left(&LieAlgebra::try_from(Bracket::from_constants(labels, constants)?)?)?;
    /// assert_eq!(space.casimirs(2)?[0].to_string(), "a*mu3^2 + b*mu1^2 + c*mu2^2");
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Size`] if the degree exceeds [`MAX_DEGREE`], or the number of monomials exceeds
    /// [`MAX_MONOMIALS`].
    #[doc(alias("Casimir invariants"))]
    pub fn casimirs(&self, degree: u32) -> Result<Vec<Symbolic>, Error> {
        let _stage = stage("casimirs");
        match self.constants::<Rational>() {
            Some(constants) => self.of_degree(&constants, degree),
            None => self.of_degree(&self.constants::<Symbolic>().unwrap_or_default(), degree),
        }
    }

    /// Generators of the polynomial Casimir functions up to degree `most`, sorted by degree.
    /// Polynomials in earlier generators are omitted. If the structure constants contain
    /// parameters, the generators are valid for generic values.
    ///
    /// # Errors
    /// The errors of [`casimirs`](Self::casimirs).
    pub fn casimir_generators(&self, most: u32) -> Result<Vec<Symbolic>, Error> {
        let _stage = stage("casimirs");
        match self.constants::<Rational>() {
            Some(constants) => self.generators(&constants, most),
            None => self.generators(&self.constants::<Symbolic>().unwrap_or_default(), most),
        }
    }

    fn of_degree<F: Coefficient>(
        &self,
        constants: &[Vec<Constant<F>>],
        degree: u32,
    ) -> Result<Vec<Symbolic>, Error> {
        let monomials = Monomials::new(self, degree)?;
        let invariants = monomials.invariants(constants)?;
        Ok(invariants.iter().map(|row| self.written(&monomials, row)).collect())
    }

    fn generators<F: Coefficient>(
        &self,
        constants: &[Vec<Constant<F>>],
        most: u32,
    ) -> Result<Vec<Symbolic>, Error> {
        expect_size(self, most)?;
        let mut generators: Vec<(u32, Polynomial<F>)> = vec![];
        let mut written = vec![];
        for degree in 1..=most {
            let monomials = Monomials::new(self, degree)?;
            let mut known = Echelon::new();
            for product in products(&generators, degree, self.names.len()) {
                known.insert(monomials.row(product))?;
            }
            for row in monomials.invariants(constants)? {
                let rest = known.reduce(row);
                if known.insert(rest.iter().cloned())? {
                    written.push(self.written(&monomials, &rest));
                    generators.push((degree, monomials.polynomial(&rest)));
                }
            }
        }
        Ok(written)
    }

    /// The constants `c^k_ij` for each `i`, as `(j, k, c)`. Returns `None` unless all constants
    /// belong to the field `F`.
    fn constants<F: Coefficient>(&self) -> Option<Vec<Vec<Constant<F>>>> {
        let mut constants = vec![vec![]; self.names.len()];
        for (at, value) in self.structure.components() {
            constants[at[1]].push((at[2], at[0], F::of(value)?));
        }
        Some(constants)
    }

    /// Writes a basis row as a polynomial, multiplied by a common factor. No denominator then
    /// depends on parameters, and the rational coefficients are coprime integers.
    fn written<F: Coefficient>(&self, monomials: &Monomials, row: &[(usize, F)]) -> Symbolic {
        let mut common = Symbolic::one();
        let values: Vec<Symbolic> = row.iter().map(|(_, value)| value.symbolic()).collect();
        for value in &values {
            common = common.clone() * &(value.clone() * &common).denominator();
        }
        let values: Vec<Symbolic> = values.into_iter().map(|value| value * &common).collect();
        let coefficients = values.iter().flat_map(Symbolic::terms).map(|(_, value)| value);
        let unit = Symbolic::constant(primitive_factor(&coefficients.collect::<Vec<_>>()));
        row.iter().zip(values).fold(Symbolic::zero(), |sum, ((at, _), value)| {
            let powers = self.coordinates.iter().zip(&monomials.exponents[*at]);
            sum + &powers.fold(value * &unit, |product, (coordinate, power)| {
                product * &num_traits::pow(coordinate.clone(), *power as usize)
            })
        })
    }
}

const MONOMIALS: &str = "monomials";

/// An entry `(j, k, c^k_ij)` of the list for a fixed `i`.
type Constant<F> = (usize, usize, F);

/// A polynomial: a map from exponents to coefficients.
type Polynomial<F> = BTreeMap<Vec<u32>, F>;

/// The fields of coefficients: the rational numbers, and rational functions of parameters.
trait Coefficient: Field + Scalar {
    fn of(value: &Symbolic) -> Option<Self>;
    fn symbolic(&self) -> Symbolic;
}

impl Coefficient for Rational {
    fn of(value: &Symbolic) -> Option<Self> {
        value.as_constant().cloned()
    }

    fn symbolic(&self) -> Symbolic {
        Symbolic::constant(self.clone())
    }
}

impl Coefficient for Symbolic {
    fn of(value: &Symbolic) -> Option<Self> {
        Some(value.clone())
    }

    fn symbolic(&self) -> Symbolic {
        self.clone()
    }
}

/// The monomials of one degree, with their numbers.
struct Monomials {
    exponents: Vec<Vec<u32>>,
    places: BTreeMap<Vec<u32>, usize>,
}

impl Monomials {
    fn new(space: &LiePoisson, degree: u32) -> Result<Self, Error> {
        expect_size(space, degree)?;
        let exponents = exponents(space.names.len(), degree);
        let places = exponents.iter().cloned().zip(0..).collect();
        Ok(Monomials { exponents, places })
    }

    /// A basis of the polynomials that the action of every coordinate maps to zero.
    fn invariants<F: Coefficient>(
        &self,
        constants: &[Vec<Constant<F>>],
    ) -> Result<Vec<Row<F>>, Error> {
        let image = |action: &Vec<Constant<F>>, row: &[(usize, F)]| Ok(self.image(action, row));
        let size = self.exponents.len();
        let kernel = common_kernel(MONOMIALS, size, Tolerance::default(), constants, image)?;
        Ok((0..kernel.rows()).map(|at| kernel.row(at).to_vec()).collect())
    }

    /// The image of a polynomial under the action of a coordinate: `c^k_j mu_k df/dmu_j`.
    fn image<F: Coefficient>(&self, action: &[Constant<F>], row: &[(usize, F)]) -> Row<F> {
        let mut image: BTreeMap<usize, F> = BTreeMap::new();
        for (at, coefficient) in row {
            for (j, k, constant) in action {
                let mut exponents = self.exponents[*at].clone();
                let power = exponents[*j];
                if power == 0 {
                    continue;
                }
                exponents[*j] -= 1;
                exponents[*k] += 1;
                let term = coefficient.clone() * constant * &F::from_i64(power.into());
                let entry = image.entry(self.places[&exponents]).or_insert_with(F::zero);
                *entry = entry.clone() + &term;
            }
        }
        image.into_iter().filter(|(_, value)| !value.vanishes()).collect()
    }

    fn polynomial<F: Coefficient>(&self, row: &[(usize, F)]) -> Polynomial<F> {
        row.iter().map(|(at, value)| (self.exponents[*at].clone(), value.clone())).collect()
    }

    /// The coefficients of a polynomial of this degree as a sparse row.
    fn row<F: Coefficient>(&self, polynomial: Polynomial<F>) -> Row<F> {
        polynomial.into_iter().map(|(powers, value)| (self.places[&powers], value)).collect()
    }
}

fn expect_size(space: &LiePoisson, degree: u32) -> Result<(), Error> {
    let bounded = |what, size, limit| match size > limit {
        true => Err(Error::Size { what, size, limit }),
        false => Ok(()),
    };
    bounded("degrees", degree as usize, MAX_DEGREE as usize)?;
    bounded(MONOMIALS, count(space.names.len(), degree), MAX_MONOMIALS)
}

/// The number of monomials, `C(n+d-1, d)`. If this number exceeds [`MAX_MONOMIALS`], returns some
/// number above the limit.
fn count(n: usize, degree: u32) -> usize {
    let Some(others) = n.checked_sub(1) else { return usize::from(degree == 0) };
    let (small, large) = (others.min(degree as usize), others.max(degree as usize));
    let mut size = 1usize;
    for k in 1..=small {
        size = size.saturating_mul(large + k) / k;
        if size > MAX_MONOMIALS {
            break;
        }
    }
    size
}

/// All exponents of monomials in `n` variables of a degree. Exponents with high powers of the first
/// variables come first.
fn exponents(n: usize, degree: u32) -> Vec<Vec<u32>> {
    match n {
        0 => (degree == 0).then(Vec::new).into_iter().collect(),
        1 => vec![vec![degree]],
        _ => {
            let with = |first: u32| {
                let rest = exponents(n - 1, degree - first).into_iter();
                rest.map(move |rest| [&[first], &rest[..]].concat())
            };
            (0..=degree).rev().flat_map(with).collect()
        }
    }
}

/// All products of `factors` that have the given degree, each product once. Each factor has its
/// degree and is a polynomial in `n` variables.
fn products<F: Coefficient>(
    factors: &[(u32, Polynomial<F>)],
    degree: u32,
    n: usize,
) -> Vec<Polynomial<F>> {
    let Some(((own, factor), others)) = factors.split_first() else {
        return if degree == 0 { vec![[(vec![0; n], F::one())].into()] } else { vec![] };
    };
    let mut all = products(others, degree, n);
    if let Some(rest) = degree.checked_sub(*own) {
        all.extend(products(factors, rest, n).iter().map(|product| multiplied(product, factor)));
    }
    all
}

fn multiplied<F: Coefficient>(a: &Polynomial<F>, b: &Polynomial<F>) -> Polynomial<F> {
    let mut product = Polynomial::new();
    for (left, first) in a {
        for (right, second) in b {
            let powers = left.iter().zip(right).map(|(a, b)| a + b).collect();
            let entry = product.entry(powers).or_insert_with(F::zero);
            *entry = entry.clone() + &(first.clone() * second);
        }
    }
    product.retain(|_, value: &mut F| !value.vanishes());
    product
}
