//! The Killing form: rank, signature, determinant, and a basis in which it is diagonal.

use super::subspace::collected;
use super::{Ground, Structure};
use affinor_tensors::linear::modular::{PRIMES, Prime, Residues};
use affinor_tensors::linear::{Matrix, Row};
use std::cmp::Ordering;

/// A symmetric form and a basis `x_a` in which it is diagonal: `x_a^T K x_b = 0` for different `a`, `b`.
#[derive(Clone, Debug)]
pub struct Killing<S> {
    /// The matrix of the form in the basis of the algebra.
    pub matrix: Matrix<S>,
    /// The basis `x_a`, a unimodular change of the basis of the algebra.
    pub basis: Vec<Row<S>>,
    /// The values `x_a^T K x_a`.
    pub values: Vec<S>,
}

impl<S: Ground> Killing<S> {
    /// Diagonalises a symmetric matrix by elimination on rows and columns.
    pub fn new(matrix: Matrix<S>) -> Self {
        let n = matrix.rows();
        let mut gram = matrix.to_dense();
        let mut vectors: Vec<Row<S>> = (0..n).map(|at| vec![(at, S::one())]).collect();
        let mut open: Vec<usize> = (0..n).collect();
        let (mut basis, mut values) = (vec![], vec![]);
        while !open.is_empty() {
            let diagonal = open.iter().position(|&i| !gram[i][i].vanishes());
            let place = diagonal.or_else(|| {
                // all are isotropic: x_i + x_j is not, where K_ij is not zero
                let (place, j) = open.iter().enumerate().find_map(|(place, &i)| {
                    Some((place, *open.iter().find(|&&j| !gram[i][j].vanishes())?))
                })?;
                let i = open[place];
                add_multiple(&mut gram, &mut vectors, &open, (i, j), &S::one());
                Some(place)
            });
            let Some(place) = place else {
                // the form vanishes on the rest
                basis.extend(open.iter().map(|&i| std::mem::take(&mut vectors[i])));
                values.extend(open.drain(..).map(|_| S::zero()));
                break;
            };
            let pivot = open.remove(place);
            let value = gram[pivot][pivot].clone();
            let unit = value.recip().expect("a pivot that is not zero");
            for &i in &open {
                if !gram[i][pivot].vanishes() {
                    let factor = -(gram[i][pivot].clone() * &unit);
                    let live: Vec<usize> = open.iter().copied().chain([pivot]).collect();
                    add_multiple(&mut gram, &mut vectors, &live, (i, pivot), &factor);
                }
            }
            basis.push(std::mem::take(&mut vectors[pivot]));
            values.push(value);
        }
        Killing { matrix, basis, values }
    }

    /// The rank.
    pub fn rank(&self) -> usize {
        self.values.iter().filter(|value| !value.vanishes()).count()
    }

    /// How many values are positive, negative and zero; `None` where a sign depends on parameters.
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

/// Replaces `x_i` by `x_i + factor x_j` in the Gram matrix of the vectors that are left.
fn add_multiple<S: Ground>(
    gram: &mut [Vec<S>],
    vectors: &mut [Row<S>],
    open: &[usize],
    (i, j): (usize, usize),
    factor: &S,
) {
    for &k in open {
        if !gram[j][k].vanishes() {
            let value = gram[j][k].clone() * factor;
            gram[i][k] = std::mem::replace(&mut gram[i][k], S::zero()) + &value;
        }
    }
    for &k in open {
        if !gram[k][j].vanishes() {
            let value = gram[k][j].clone() * factor;
            gram[k][i] = std::mem::replace(&mut gram[k][i], S::zero()) + &value;
        }
    }
    let scaled = vectors[j].iter().map(|(at, value)| (*at, value.clone() * factor));
    vectors[i] = collected(vectors[i].iter().cloned().chain(scaled.collect::<Row<S>>()).collect());
}

impl<S: Ground> Structure<S> {
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
    pub fn killing(&self) -> &Killing<S> {
        self.killing.get_or_init(|| Killing::new(self.killing_matrix().clone()))
    }

    /// Whether the radical is zero, by Cartan's criterion: the Killing form is not degenerate.
    ///
    /// A rank modulo a prime is at most the rank, so a full rank modulo one prime is a proof.
    pub fn is_semisimple(&self) -> bool {
        let n = self.dimension();
        *self.semisimple.get_or_init(|| {
            let full = |prime: Prime| {
                let mut rows = vec![vec![0; n]; n];
                for (i, j, value) in self.killing_matrix().entries() {
                    rows[i][j] = value.residue(prime)?;
                }
                Some(Residues::new(prime, n, rows).rank() == n)
            };
            let regular = PRIMES.into_iter().find_map(full).unwrap_or(false);
            n > 0 && (regular || self.killing().rank() == n)
        })
    }
}
