//! Subspaces of an algebra. They are represented by a basis in reduced row echelon form.

use affinor_tensors::linear::{Echelon, Matrix, Row};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Rational, Ring, Scalar};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// A subspace of the vectors with `ambient` components. Equal subspaces have equal bases.
#[derive(Clone, Debug)]
pub struct Subspace<S> {
    ambient: usize,
    echelon: Echelon<S>,
}

/// The reason why elimination over a field cannot fail.
const FIELD: &str = "every pivot of a field has an inverse";

impl<S: Field + Scalar> Subspace<S> {
    /// The zero subspace.
    pub fn zero(ambient: usize) -> Self {
        Subspace { ambient, echelon: Echelon::new() }
    }

    /// The whole space.
    pub fn whole(ambient: usize) -> Self {
        Self::span(ambient, (0..ambient).map(|at| vec![(at, S::one())]))
    }

    /// The span of vectors.
    pub fn span(ambient: usize, vectors: impl IntoIterator<Item = Row<S>>) -> Self {
        let mut subspace = Self::zero(ambient);
        for vector in vectors {
            if subspace.dimension() == ambient {
                break;
            }
            subspace.add(vector);
        }
        subspace
    }

    /// The vectors `x` with `v_i x_i = 0` for all given rows `v`.
    pub fn kernel(ambient: usize, rows: impl IntoIterator<Item = Row<S>>) -> Self {
        let matrix = Matrix::from_rows(ambient, rows).expect("columns of the subspace");
        let kernel = matrix.nullspace().expect(FIELD);
        Self::span(ambient, (0..kernel.rows()).map(|at| kernel.row(at).to_vec()))
    }

    /// The number of components of the vectors.
    pub fn ambient(&self) -> usize {
        self.ambient
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.echelon.rank()
    }

    /// Whether the subspace is zero.
    pub fn is_zero(&self) -> bool {
        self.dimension() == 0
    }

    /// The basis in reduced row echelon form, as sparse rows.
    pub fn basis(&self) -> &[Row<S>] {
        self.echelon.rows()
    }

    /// The basis as rows that contain all components.
    pub fn dense(&self) -> Vec<Vec<S>> {
        let dense = |row: &Row<S>| {
            let mut vector = vec![S::zero(); self.ambient];
            row.iter().for_each(|(at, value)| vector[*at] = value.clone());
            vector
        };
        self.basis().iter().map(dense).collect()
    }

    /// Adds a vector. Returns whether the subspace grew.
    pub fn add(&mut self, vector: Row<S>) -> bool {
        self.echelon.insert(vector).expect(FIELD)
    }

    /// The sum of two subspaces.
    #[must_use]
    pub fn sum(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        for row in other.basis() {
            sum.add(row.clone());
        }
        sum
    }

    /// Whether the vector lies in the subspace.
    pub fn contains(&self, vector: &[(usize, S)]) -> bool {
        self.echelon.contains(vector.iter().cloned())
    }

    /// Whether this subspace contains the other subspace.
    pub fn includes(&self, other: &Self) -> bool {
        other.basis().iter().all(|row| self.contains(row))
    }

    /// The remainder of a vector modulo the subspace; it is zero at every pivot.
    pub fn reduce(&self, vector: Row<S>) -> Row<S> {
        self.echelon.reduce(vector)
    }

    /// The nonzero coordinates of a vector in [`basis`](Self::basis); `None` if the subspace does
    /// not contain the vector.
    pub fn coordinates(&self, vector: &[(usize, S)]) -> Option<Row<S>> {
        let place = |at: &usize| self.echelon.pivots().binary_search(at).ok();
        let own = vector.iter().filter_map(|(at, value)| Some((place(at)?, value.clone())));
        let own: Row<S> = own.collect();
        self.contains(vector).then_some(own)
    }

    /// The vector with these coordinates in [`basis`](Self::basis).
    pub fn vector(&self, coordinates: &[(usize, S)]) -> Row<S> {
        combination(self.basis(), coordinates)
    }

    /// The subspace of this space that consists of the vectors with these `coordinates` in
    /// [`basis`](Self::basis).
    pub fn within(&self, coordinates: &Self) -> Self {
        Self::span(self.ambient, coordinates.basis().iter().map(|row| self.vector(row)))
    }

    /// The vectors of this subspace that a linear map sends to zero. The function `image` maps a
    /// basis vector.
    pub fn kernel_of(&self, image: impl Fn(&Row<S>) -> Row<S>) -> Self {
        let mut rows: std::collections::BTreeMap<usize, Row<S>> = Default::default();
        for (at, vector) in self.basis().iter().enumerate() {
            for (component, value) in image(vector) {
                rows.entry(component).or_default().push((at, value));
            }
        }
        self.within(&Self::kernel(self.dimension(), rows.into_values()))
    }

    /// The indices that are not pivots. The basis vectors of the whole space with these indices
    /// span a complement.
    pub fn complement(&self) -> impl Iterator<Item = usize> {
        (0..self.ambient).filter(|at| self.echelon.pivots().binary_search(at).is_err())
    }
}

/// Two subspaces are equal if their echelon bases are equal.
impl<S: Field + Scalar> PartialEq for Subspace<S> {
    fn eq(&self, other: &Self) -> bool {
        self.ambient == other.ambient && self.basis() == other.basis()
    }
}

/// The linear combination of rows with these coefficients.
pub(crate) fn combination<S: Field + Scalar>(
    rows: &[Row<S>],
    coefficients: &[(usize, S)],
) -> Row<S> {
    let terms = coefficients.iter().flat_map(|(at, factor)| {
        rows[*at].iter().map(move |(i, value)| (*i, value.clone() * factor))
    });
    collected(terms.collect())
}

/// Collects the terms of a sum: sorts them, adds terms of the same key, and removes zeros.
pub(crate) fn collected<K: Copy + Ord, S: Field + Scalar>(mut terms: Vec<(K, S)>) -> Vec<(K, S)> {
    checkpoint();
    terms.sort_by_key(|(at, _)| *at);
    let sum = |run: &[(K, S)]| {
        let total = run[1..].iter().fold(run[0].1.clone(), |total, (_, value)| total + value);
        (run[0].0, total)
    };
    let sums = terms.chunk_by(|a, b| a.0 == b.0).map(sum);
    sums.filter(|(_, value)| !value.vanishes()).collect()
}

/// The least positive integer whose product with every value is an integer.
pub(in crate::algebra) fn denominator<'a>(values: impl Iterator<Item = &'a Rational>) -> Rational {
    values.fold(Rational::from(1), |factor, value| {
        let rest = BigRational::from(&(value.clone() * &factor));
        factor * &Rational::from(BigRational::from_integer(rest.denom().clone()))
    })
}

/// The positive factor that turns the numbers into coprime integers.
pub(in crate::algebra) fn primitive_factor(numbers: &[Rational]) -> Rational {
    let above = denominator(numbers.iter());
    let divisor = numbers.iter().fold(BigInt::zero(), |mut divisor, number| {
        let mut rest = BigRational::from(&(number.clone() * &above)).to_integer();
        while !rest.is_zero() {
            (divisor, rest) = (rest.clone(), divisor % rest);
        }
        divisor
    });
    let below = Rational::from(BigRational::from_integer(divisor.abs()));
    below.recip().map_or(above.clone(), |unit| above * &unit)
}

/// The coprime integers that are proportional to the numbers; the first one that is not zero is
/// positive. Returns `None` if an integer exceeds 64 bits.
pub(crate) fn coprime(numbers: &[Rational]) -> Option<Vec<i64>> {
    let mut unit = primitive_factor(numbers);
    if numbers.iter().find(|number| !number.vanishes()).is_some_and(Rational::is_negative) {
        unit = -unit;
    }
    numbers.iter().map(|number| (number.clone() * &unit).to_i64()).collect()
}
