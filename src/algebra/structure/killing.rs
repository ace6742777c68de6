//! The Killing form: rank, signature, determinant, and a basis in which it is diagonal.

use super::{GroundField, StructureTheory};
use affinor_tensors::linear::modular::{PRIMES, Prime, ResidueMatrix};
use affinor_tensors::linear::{Matrix, Row};
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// A symmetric form with a basis `x_a` in which it is diagonal: `x_a^T K x_b = 0` for different
/// `a`, `b`.
#[derive(Clone, Debug)]
pub struct Killing<S> {
    /// The matrix of the form in the basis of the algebra.
    pub matrix: Matrix<S>,
    /// The basis `x_a`; the change from the basis of the algebra is unimodular.
    pub basis: Vec<Row<S>>,
    /// The values `x_a^T K x_a`.
    pub values: Vec<S>,
}

impl<S: GroundField> Killing<S> {
    /// Diagonalizes a symmetric matrix by elimination on rows and columns.
    pub fn new(matrix: Matrix<S>) -> Self {
        let n = matrix.rows();
        let mut gram = Gram::new(&matrix);
        let mut vectors: Vec<Row<S>> = (0..n).map(|at| vec![(at, S::one())]).collect();
        let (mut basis, mut values) = (vec![], vec![]);
        // the loop ends if all remaining rows are zero, because such rows have no effect on other
        // rows
        while let Some(pivot) = gram.anisotropic.first().copied().or_else(|| {
            // if all vectors are isotropic but some K_ij is nonzero, x_i + x_j is not isotropic
            let (i, j) = gram.first_entry()?;
            gram.add(i, j);
            vectors[i] = sum_of_rows(&vectors[i], &vectors[j], &S::one());
            Some(i)
        }) {
            let (value, row) = gram.remove(pivot);
            let unit = value.recip().expect("a pivot that is not zero");
            for (i, entry) in &row {
                let factor = -(entry.clone() * &unit);
                gram.add_to_row(*i, &row, &factor);
                vectors[*i] = sum_of_rows(&vectors[*i], &vectors[pivot], &factor);
            }
            basis.push(std::mem::take(&mut vectors[pivot]));
            values.push(value);
        }
        // appends the remaining vectors, on which the form vanishes
        basis.extend(gram.open.iter().map(|&i| std::mem::take(&mut vectors[i])));
        values.resize(n, S::zero());
        Killing { matrix, basis, values }
    }

    /// The rank.
    pub fn rank(&self) -> usize {
        self.values.iter().filter(|value| !value.vanishes()).count()
    }

    /// The numbers of positive, negative and zero values; `None` if a sign depends on parameters.
    pub fn signature(&self) -> Option<[usize; 3]> {
        self.values.iter().try_fold([0; 3], |mut count, value| {
            count[match value.sign()? {
                Ordering::Greater => 0,
                Ordering::Less => 1,
                Ordering::Equal => 2,
            }] += 1;
            Some(count)
        })
    }

    /// The determinant: the product of the values.
    pub fn determinant(&self) -> S {
        self.values.iter().fold(S::one(), |product, value| product * value)
    }
}

/// The Gram matrix of the remaining vectors, in sparse rows.
struct Gram<S> {
    rows: Vec<Row<S>>,
    open: BTreeSet<usize>,
    /// The indices `i` of the remaining vectors with nonzero `K_ii`.
    anisotropic: BTreeSet<usize>,
}

impl<S: GroundField> Gram<S> {
    fn new(matrix: &Matrix<S>) -> Self {
        let n = matrix.rows();
        let rows: Vec<Row<S>> = (0..n).map(|i| matrix.row(i).to_vec()).collect();
        let mut gram = Gram { rows, open: (0..n).collect(), anisotropic: BTreeSet::new() };
        (0..n).for_each(|i| gram.note(i));
        gram
    }

    /// Records whether `K_ii` is zero.
    fn note(&mut self, i: usize) {
        match place(&self.rows[i], i) {
            Ok(_) => self.anisotropic.insert(i),
            Err(_) => self.anisotropic.remove(&i),
        };
    }

    /// The first entry that is not zero.
    fn first_entry(&self) -> Option<(usize, usize)> {
        self.open.iter().find_map(|&i| Some((i, self.rows[i].first()?.0)))
    }

    /// Replaces `x_i` by `x_i + x_j`, where both vectors are isotropic.
    fn add(&mut self, i: usize, j: usize) {
        let row = self.rows[j].clone();
        for (k, value) in &row {
            // the change of K_ii is the sum of K_ji and K_ij
            let value = if *k == i { value.clone() + value } else { value.clone() };
            add_entry(&mut self.rows[i], *k, &value);
            if *k != i {
                add_entry(&mut self.rows[*k], i, &value);
            }
        }
        self.note(i);
    }

    /// Removes `x_i`. Returns `K_ii` and the other entries of its row.
    fn remove(&mut self, i: usize) -> (S, Row<S>) {
        let mut row = std::mem::take(&mut self.rows[i]);
        let at = place(&row, i).expect("an entry that is not zero");
        let (_, value) = row.remove(at);
        for (k, _) in &row {
            if let Ok(at) = place(&self.rows[*k], i) {
                self.rows[*k].remove(at);
            }
        }
        self.open.remove(&i);
        self.anisotropic.remove(&i);
        (value, row)
    }

    /// Adds a multiple of `row` to the row of `x_i`.
    fn add_to_row(&mut self, i: usize, row: &[(usize, S)], factor: &S) {
        self.rows[i] = sum_of_rows(&self.rows[i], row, factor);
        self.note(i);
    }
}

fn place<S>(row: &[(usize, S)], at: usize) -> Result<usize, usize> {
    row.binary_search_by_key(&at, |(i, _)| *i)
}

fn add_entry<S: GroundField>(row: &mut Row<S>, at: usize, value: &S) {
    match place(row, at) {
        Ok(here) => {
            let sum = row[here].1.clone() + value;
            if sum.vanishes() {
                row.remove(here);
            } else {
                row[here].1 = sum;
            }
        }
        Err(here) => row.insert(here, (at, value.clone())),
    }
}

/// The sum of `row` and `factor` times `other`.
fn sum_of_rows<S: GroundField>(row: &[(usize, S)], other: &[(usize, S)], factor: &S) -> Row<S> {
    let mut sum = Vec::with_capacity(row.len() + other.len());
    let (mut left, mut right) = (row.iter().peekable(), other.iter().peekable());
    loop {
        let first = match (left.peek(), right.peek()) {
            (Some((i, _)), Some((j, _))) => i.cmp(j),
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (None, None) => return sum,
        };
        let own = left.next_if(|_| first.is_le()).map(|(i, value)| (*i, value.clone()));
        let added = right.next_if(|_| first.is_ge()).map(|(i, value)| (*i, value.clone() * factor));
        match (own, added) {
            (Some((i, own)), Some((_, added))) => {
                let total = own + &added;
                if !total.vanishes() {
                    sum.push((i, total));
                }
            }
            (one, other) => sum.extend(one.or(other)),
        }
    }
}

impl<S: GroundField> StructureTheory<S> {
    /// The matrix of the Killing form, `K_ij = tr(ad_i ad_j)`.
    pub fn killing_matrix(&self) -> &Matrix<S> {
        self.form.get_or_init(|| {
            let n = self.dimension();
            let form = self.algebra.killing_form();
            let mut rows = vec![vec![]; n];
            form.components().for_each(|(at, value)| rows[at[0]].push((at[1], value.clone())));
            Matrix::from_rows(n, rows).expect("a square matrix")
        })
    }

    /// The Killing form in a basis in which it is diagonal.
    ///
    /// ```
    /// use affinor::algebra::{catalogue, structure::StructureTheory};
    /// use affinor::Rational;
    /// let algebra = StructureTheory::new(catalogue::algebra::<Rational>("sl(2)")?);
    /// assert_eq!(algebra.killing().rank(), 3);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Cartan-Killing form", "signature"))]
    pub fn killing(&self) -> &Killing<S> {
        self.killing.get_or_init(|| Killing::new(self.killing_matrix().clone()))
    }

    /// Whether the radical is zero. By Cartan's criterion, the radical is zero if and only if the
    /// Killing form is nondegenerate.
    ///
    /// A rank modulo a prime is a lower bound of the rank, so a full rank modulo one prime is a
    /// proof.
    pub fn is_semisimple(&self) -> bool {
        let n = self.dimension();
        *self.semisimple.get_or_init(|| {
            let full = |prime: Prime| self.has_regular_killing_form(prime);
            let regular = PRIMES.into_iter().find_map(full).unwrap_or(false);
            n > 0 && (regular || self.killing().rank() == n)
        })
    }

    /// Whether the Killing form has full rank modulo a prime. Returns `None` if the prime divides a
    /// denominator.
    pub(super) fn has_regular_killing_form(&self, prime: Prime) -> Option<bool> {
        let mut regular = true;
        for block in blocks(self.killing_matrix()) {
            let row = |&i: &usize| {
                let mut row = vec![0; block.len()];
                for (j, value) in self.killing_matrix().row(i) {
                    row[block.binary_search(j).ok()?] = value.residue(prime)?;
                }
                Some(row)
            };
            let rows = block.iter().map(row).collect::<Option<_>>()?;
            regular &= ResidueMatrix::new(prime, block.len(), rows).rank() == block.len();
        }
        Some(regular)
    }
}

/// The finest partition of the indices such that a symmetric matrix has no entries between
/// different blocks. Each block is sorted.
fn blocks<S: GroundField>(matrix: &Matrix<S>) -> Vec<Vec<usize>> {
    let mut block_of = vec![None; matrix.rows()];
    let mut blocks = vec![];
    for first in 0..matrix.rows() {
        if block_of[first].is_some() {
            continue;
        }
        block_of[first] = Some(blocks.len());
        let mut block = vec![first];
        let mut at = 0;
        while let Some(&i) = block.get(at) {
            for (j, _) in matrix.row(i) {
                if block_of[*j].replace(blocks.len()).is_none() {
                    block.push(*j);
                }
            }
            at += 1;
        }
        block.sort_unstable();
        blocks.push(block);
    }
    blocks
}
