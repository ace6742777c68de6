//! Tensor products, symmetric and exterior powers of modules.

use super::{MAX_DIMENSION, Module};
use crate::Error;
use crate::algebra::structure::collected;
use affinor_tensors::linear::Row;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar};
use std::collections::BTreeMap;

impl<S: Field + Scalar> Module<S> {
    /// The tensor product: `x (v ⊗ w) = x v ⊗ w + v ⊗ x w`. The vector `v_a ⊗ w_b` has the index
    /// `a dim W + b`.
    ///
    /// # Errors
    /// [`Error::Shape`] if the modules belong to different algebras; [`Error::Size`] beyond
    /// [`MAX_DIMENSION`].
    pub fn tensor(&self, other: &Self) -> Result<Self, Error> {
        if self.algebra != other.algebra {
            return Err(Error::Shape {
                what: "the second module",
                expected: "a module of the same algebra".into(),
                found: "another algebra".into(),
            });
        }
        let (m, n) = (self.dimension(), other.dimension());
        limited(m.saturating_mul(n))?;
        let pairs = || (0..m).flat_map(|a| (0..n).map(move |b| (a, b)));
        let image = |j: usize, a: usize, b: usize| {
            let left = self.images[j][a].iter().map(|(at, value)| (at * n + b, value.clone()));
            let right = other.images[j][b].iter().map(|(at, value)| (a * n + at, value.clone()));
            collected(left.chain(right).collect())
        };
        let images = (0..self.images.len()).map(|j| pairs().map(|(a, b)| image(j, a, b)).collect());
        let labels = pairs().map(|(a, b)| format!("{}.{}", self.labels[a], other.labels[b]));
        Ok(Module {
            algebra: self.algebra.clone(),
            labels: labels.collect(),
            images: images.collect(),
        })
    }

    /// The symmetric power, on the monomials `v_a v_b ...` with `a <= b <= ...` in lexicographic order.
    ///
    /// # Errors
    /// [`Error::Size`] beyond [`MAX_DIMENSION`].
    pub fn symmetric_power(&self, degree: usize) -> Result<Self, Error> {
        self.power(degree, true)
    }

    /// The exterior power, on the products `v_a ^ v_b ^ ...` with `a < b < ...` in lexicographic
    /// order.
    ///
    /// # Errors
    /// [`Error::Size`] beyond [`MAX_DIMENSION`].
    pub fn exterior_power(&self, degree: usize) -> Result<Self, Error> {
        self.power(degree, false)
    }

    fn power(&self, degree: usize, symmetric: bool) -> Result<Self, Error> {
        let m = self.dimension();
        let mut monomials: Vec<Vec<usize>> = vec![vec![]];
        for _ in 0..degree {
            checkpoint();
            let longer = monomials.iter().flat_map(|monomial| {
                let from = monomial.last().map_or(0, |last| last + usize::from(!symmetric));
                (from..m).map(move |next| [&monomial[..], &[next]].concat())
            });
            monomials = longer.take(MAX_DIMENSION + 1).collect();
            limited(monomials.len())?;
        }
        let places: BTreeMap<&[usize], usize> =
            monomials.iter().enumerate().map(|(at, monomial)| (&monomial[..], at)).collect();
        let image = |j: usize, monomial: &Vec<usize>| -> Row<S> {
            let mut terms = vec![];
            for position in 0..degree {
                for (at, value) in &self.images[j][monomial[position]] {
                    let mut rest = monomial.clone();
                    rest.remove(position);
                    let target = rest.partition_point(|other| other < at);
                    if !symmetric && rest.get(target) == Some(at) {
                        continue;
                    }
                    rest.insert(target, *at);
                    let odd = !symmetric && target.abs_diff(position) % 2 == 1;
                    let value = if odd { -value.clone() } else { value.clone() };
                    terms.extend(places.get(&rest[..]).map(|place| (*place, value)));
                }
            }
            collected(terms)
        };
        let images = (0..self.images.len()).map(|j| {
            checkpoint();
            monomials.iter().map(|monomial| image(j, monomial)).collect()
        });
        let separator = if symmetric { " " } else { "^" };
        let label = |monomial: &Vec<usize>| match monomial.is_empty() {
            true => "1".into(),
            false => {
                let factors: Vec<&str> = monomial.iter().map(|a| &self.labels[*a][..]).collect();
                factors.join(separator)
            }
        };
        Ok(Module {
            algebra: self.algebra.clone(),
            labels: monomials.iter().map(label).collect(),
            images: images.collect(),
        })
    }
}

fn limited(dimension: usize) -> Result<(), Error> {
    match dimension > MAX_DIMENSION {
        true => Err(Error::Size {
            what: "basis vectors of a module",
            size: dimension,
            limit: MAX_DIMENSION,
        }),
        false => Ok(()),
    }
}
