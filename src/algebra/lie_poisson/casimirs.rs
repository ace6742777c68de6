//! Polynomial Casimir functions, the invariants of the coadjoint action, by degree.

use super::LiePoisson;
use crate::Error;
use crate::algebra::invariants::common_kernel;
use affinor_tensors::linear::{Echelon, Row};
use affinor_tensors::{Rational, Ring, Symbolic, Tolerance};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// The largest number of monomials of one degree in a search for Casimir functions. As with
/// [`MAX_UNKNOWNS`](crate::algebra::invariants::MAX_UNKNOWNS), far fewer are practical in a dense basis.
pub const MAX_MONOMIALS: usize = 1 << 15;
/// The highest degree of a search for Casimir functions.
pub const MAX_DEGREE: u32 = 255;

impl LiePoisson {
    /// A basis of the homogeneous Casimir functions of that degree: the polynomial invariants of the
    /// coadjoint action of the connected group.
    ///
    /// For a simple algebra of rank `l` they are the polynomials in `l` generators, whose degrees are
    /// the exponents plus 1 (C. Chevalley, *Amer. J. Math.* 77 (1955) 778-782).
    ///
    /// # Errors
    /// [`Error::Size`] beyond [`MAX_DEGREE`] or [`MAX_MONOMIALS`]; [`Error::NotConstant`] when the
    /// structure constants have parameters.
    pub fn casimirs(&self, degree: u32) -> Result<Vec<Symbolic>, Error> {
        let monomials = Monomials::new(self, degree)?;
        let invariants = self.invariants(&monomials)?;
        Ok(invariants.iter().map(|row| monomials.polynomial(row)).collect())
    }

    /// Generators of the polynomial Casimir functions up to degree `most`, sorted by degree. Products
    /// and sums of earlier generators are left out.
    ///
    /// # Errors
    /// As [`casimirs`](Self::casimirs).
    pub fn casimir_generators(&self, most: u32) -> Result<Vec<Symbolic>, Error> {
        expect_size(self, most)?;
        let mut generators: Vec<(u32, Symbolic)> = vec![];
        for degree in 1..=most {
            let monomials = Monomials::new(self, degree)?;
            let mut known = Echelon::new();
            for product in products(&generators, degree) {
                known.insert(monomials.row(&product))?;
            }
            for row in self.invariants(&monomials)? {
                let rest = known.reduce(row);
                if known.insert(rest.iter().cloned())? {
                    generators.push((degree, monomials.polynomial(&rest)));
                }
            }
        }
        Ok(generators.into_iter().map(|(_, generator)| generator).collect())
    }

    fn invariants(&self, monomials: &Monomials) -> Result<Vec<Row<Rational>>, Error> {
        let varies = |value: &Symbolic| value.parameters().iter().any(|p| !self.names.contains(p));
        if let Some((at, value)) = self.tensor.components().find(|(_, value)| varies(value)) {
            let component = format!("{{mu{}, mu{}}}", at[0] + 1, at[1] + 1);
            let what = "a search for Casimir functions";
            return Err(Error::NotConstant { what, component, value: value.to_string() });
        }
        let image = |coordinate: &Symbolic, row: &[(usize, Rational)]| {
            Ok(monomials.row(&self.bracket(coordinate, &monomials.polynomial(row))?))
        };
        let size = monomials.values.len();
        let kernel =
            common_kernel(MONOMIALS, size, Tolerance::default(), &self.coordinates, image)?;
        Ok((0..kernel.rows()).map(|at| kernel.row(at).to_vec()).collect())
    }
}

const MONOMIALS: &str = "monomials";

/// A monomial as [`Symbolic::terms`] writes it.
type Powers = Vec<(String, u32)>;

/// The monomials of one degree, numbered.
struct Monomials {
    values: Vec<Symbolic>,
    places: BTreeMap<Powers, usize>,
}

impl Monomials {
    fn new(space: &LiePoisson, degree: u32) -> Result<Self, Error> {
        expect_size(space, degree)?;
        let exponents = exponents(space.names.len(), degree);
        let named = |exponents: &Vec<u32>| -> Powers {
            let powers = space.names.iter().cloned().zip(exponents.iter().copied());
            powers.filter(|(_, power)| *power > 0).collect()
        };
        let value = |exponents: &Vec<u32>| {
            let powers = space.coordinates.iter().zip(exponents);
            powers.fold(Symbolic::one(), |product, (coordinate, power)| {
                product * &num_traits::pow(coordinate.clone(), *power as usize)
            })
        };
        let places = exponents.iter().map(named).zip(0..).collect();
        Ok(Monomials { values: exponents.iter().map(value).collect(), places })
    }

    fn polynomial(&self, row: &[(usize, Rational)]) -> Symbolic {
        row.iter().fold(Symbolic::zero(), |sum, (at, coefficient)| {
            sum + &(self.values[*at].clone() * &Symbolic::constant(coefficient.clone()))
        })
    }

    /// The coefficients of a polynomial of this degree.
    fn row(&self, polynomial: &Symbolic) -> Row<Rational> {
        let place = |(powers, coefficient)| (self.places[&powers], coefficient);
        polynomial.terms().into_iter().map(place).collect()
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

/// How many monomials there are, `C(n+d-1, d)`; anything above [`MAX_MONOMIALS`] when more.
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

/// All exponents of `n` variables of that degree, the highest powers of the first variables first.
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

/// All products of that degree of factors with their degrees, each once.
fn products(factors: &[(u32, Symbolic)], degree: u32) -> Vec<Symbolic> {
    let Some(((own, factor), others)) = factors.split_first() else {
        return if degree == 0 { vec![Symbolic::from_i64(1)] } else { vec![] };
    };
    let mut all = products(others, degree);
    if let Some(rest) = degree.checked_sub(*own) {
        all.extend(products(factors, rest).into_iter().map(|product| product * factor));
    }
    all
}
