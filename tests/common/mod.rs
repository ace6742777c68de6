//! Random Lie algebras, metrics and affinities over the rationals, and explicit transformations of
//! tensors.
#![allow(dead_code, reason = "each test takes what it needs")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

pub mod algebras;
pub mod charts;
pub mod property;
pub mod spaces;
pub mod steps;

use affinor::{Connection, LieAlgebra, Metric};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Rational, Ring, Scalar, Tensor, Up, Variance};
use proptest::collection::vec;
use proptest::prelude::*;
use std::path::Path;

/// The folder of the workspace.
pub fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().find(|folder| folder.join("Cargo.lock").exists()).unwrap()
}

pub fn integer(n: i64) -> Rational {
    Rational::from(n)
}

pub fn fraction(n: i64, d: i64) -> Rational {
    Rational::new(n, d).unwrap()
}

/// `e1 .. en`.
pub fn labels(n: usize) -> Vec<String> {
    (1..=n).map(|at| format!("e{at}")).collect()
}

/// The nonzero components in order.
pub fn stored<S: Scalar>(tensor: &Tensor<S>) -> Vec<(Vec<usize>, S)> {
    tensor.components().map(|(at, value)| (at.to_vec(), value.clone())).collect()
}

/// Small rationals, many of them zero.
pub fn rationals() -> impl Strategy<Value = Rational> {
    prop_oneof![
        2 => Just(integer(0)),
        4 => (-3i64..=3).prop_map(integer),
        2 => (-5i64..=5, 2i64..=3).prop_map(|(n, d)| fraction(n, d)),
    ]
}

/// A tensor with every component drawn from [`rationals`].
pub fn tensors<const RANK: usize>(
    n: usize,
    slots: [Variance; RANK],
) -> impl Strategy<Value = Tensor<Rational>> {
    vec(rationals(), n.pow(RANK as u32)).prop_map(move |values| {
        let mut values = values.into_iter();
        Tensor::from_fn(n, slots, |_| values.next().unwrap()).unwrap()
    })
}

/// Dense invertible matrices `A^i_a`: lower times upper triangular.
pub fn invertible(n: usize) -> impl Strategy<Value = Tensor<Rational>> {
    tensors(n, [Up, Down]).prop_map(move |entries| {
        let unit = |at: [usize; 2]| {
            let entry = entries.get(&at);
            if entry.vanishes() { integer(1) } else { entry }
        };
        let lower = |i, k| {
            if i == k { integer(1) } else { entries.get(&[i, k]) }
        };
        let upper = |k, j| {
            if k == j { unit([k, j]) } else { entries.get(&[k, j]) }
        };
        Tensor::from_fn(n, [Up, Down], |[i, j]| {
            let terms = (0..=i.min(j)).map(|k| lower(i, k) * &upper(k, j));
            terms.fold(integer(0), |sum, term| sum + &term)
        })
        .unwrap()
    })
}

/// Symmetric, nondegenerate matrices of any signature: `A^T D A`.
pub fn metrics(n: usize) -> impl Strategy<Value = Metric<Rational>> {
    let diagonal = vec(prop::sample::select(vec![1, -1, 2, -3]), n);
    (invertible(n), diagonal).prop_map(move |(a, d)| {
        let g = Tensor::from_fn(n, [Down, Down], |[i, j]| {
            let terms = (0..n).map(|k| a.get(&[k, i]) * &a.get(&[k, j]) * &integer(d[k]));
            terms.fold(integer(0), |sum, term| sum + &term)
        });
        Metric::new(labels(n), g.unwrap()).unwrap()
    })
}

/// A Lie algebra with a metric and affinities.
#[derive(Clone, Debug)]
pub struct Space {
    pub algebra: LieAlgebra<Rational>,
    pub lambda: Rational,
    pub metric: Metric<Rational>,
    pub affinities: Tensor<Rational>,
}

impl Space {
    pub fn dimension(&self) -> usize {
        self.algebra.dimension()
    }

    /// The connection with the random affinities, which have any torsion and nonmetricity.
    pub fn connection(&self) -> Connection<Rational> {
        Connection::new(self.algebra.left_frame().clone(), self.affinities.clone()).unwrap()
    }

    pub fn family(&self) -> Connection<Rational> {
        Connection::cartan_schouten(&self.algebra, &self.lambda)
    }

    pub fn levi_civita(&self) -> Connection<Rational> {
        Connection::levi_civita(self.algebra.left_frame(), &self.metric).unwrap()
    }

    /// One connection of every kind.
    pub fn connections(&self) -> [Connection<Rational>; 3] {
        [self.connection(), self.family(), self.levi_civita()]
    }
}

/// Spaces of dimension 3 up to `most`.
pub fn spaces(most: usize) -> impl Strategy<Value = Space> {
    algebras::algebras(most).prop_flat_map(|algebra| {
        let n = algebra.dimension();
        let affinities = tensors(n, [Up, Down, Down]);
        (Just(algebra), rationals(), metrics(n), affinities).prop_map(
            |(algebra, lambda, metric, affinities)| Space { algebra, lambda, metric, affinities },
        )
    })
}

/// The components in the basis `e'_a = A^i_a e_i`, slot by slot; `inverse` is the inverse of `A`.
pub fn transform<S: Scalar>(tensor: &Tensor<S>, a: &Tensor<S>, inverse: &Tensor<S>) -> Tensor<S> {
    let n = tensor.dimension();
    let mut result = tensor.clone();
    for (slot, variance) in tensor.slots().iter().enumerate() {
        let moved: Vec<_> = result
            .components()
            .flat_map(|(at, value)| {
                (0..n).map(move |new| {
                    let factor = match variance {
                        Up => inverse.get(&[new, at[slot]]),
                        Down => a.get(&[at[slot], new]),
                    };
                    let mut at = at.to_vec();
                    at[slot] = new;
                    (at, value.clone() * &factor)
                })
            })
            .collect();
        result = Tensor::from_components(n, tensor.slots(), moved).unwrap();
    }
    result
}

/// The inverse of a matrix `A^i_a`.
pub fn inverse<S: Field + Scalar>(a: &Tensor<S>) -> Tensor<S> {
    let n = a.dimension();
    let rows = (0..n).map(|i| (0..n).map(|j| a.get(&[i, j])).collect()).collect::<Vec<_>>();
    let inverse = Matrix::from_dense(&rows).unwrap().inverse().unwrap();
    Tensor::from_fn(n, [Up, Down], |[i, j]| inverse.get(i, j)).unwrap()
}
