//! Solutions of linear systems of recorded values, by an elimination whose pivots are chosen when the program runs.
//!
//! The method is partial pivoting. Sizes are compared in the matrix `A_ij / (d_i d_j)` with `d_i^2 = max(|A_ii|, m_i^2 / M)`, where
//! `m_i` is the largest size in row `i` and `M` the largest size in the matrix. The relative error of the inverse of that matrix
//! is a small multiple of the machine precision times its condition number (N. J. Higham, *Accuracy and Stability of
//! Numerical Algorithms*, 2002, section 9.3). A definite matrix has `A_ij^2 < A_ii A_jj` and so `d_i^2 = |A_ii|`: then the
//! bound does not depend on the units of the basis.

use super::image::Image;
use super::{Node, Operation, Recorded};
use crate::linear::Matrix;
use crate::{Field, Ring};
use num_traits::Zero;
use std::sync::Arc;

/// The most rows of a block that is eliminated in the order of its rows.
const SMALL: usize = 2;

/// The solution of `A x = b`.
pub(super) struct Solution {
    factors: Arc<Factors>,
    right: Vec<Recorded>,
    /// The components, as a program computes them.
    eliminated: Vec<Recorded>,
}

/// A matrix and the operations that make it upper triangular.
struct Factors {
    matrix: Vec<Vec<Recorded>>,
    /// The image of the inverse; `None` if an entry of the matrix has none.
    inverse: Option<Vec<Vec<Image>>>,
    moves: Vec<Move>,
    /// The columns of the triangular matrix above its diagonal, and the reciprocals of the diagonal.
    columns: Vec<(Vec<Recorded>, Recorded)>,
}

/// An operation on the rows of a matrix.
enum Move {
    /// Exchanges two rows, unless the first size is at least the second one.
    Exchange([usize; 2], [Recorded; 2]),
    /// Subtracts from the second row a multiple of the first one.
    Subtract([usize; 2], Recorded),
}

impl Move {
    fn apply(&self, column: &mut [Recorded]) {
        match self {
            Move::Exchange([k, j], [a, b]) => {
                let [x, y] = [k, j].map(|at| column[*at].clone());
                column[*k] = Recorded::select([a, b, &x, &y]);
                column[*j] = Recorded::select([a, b, &y, &x]);
            }
            Move::Subtract([k, j], factor) => {
                let multiple = factor.clone() * &column[*k];
                column[*j] = std::mem::take(&mut column[*j]) - &multiple;
            }
        }
    }
}

impl Factors {
    /// `None` for a singular matrix.
    fn new(matrix: Vec<Vec<Recorded>>) -> Option<Self> {
        let images = matrix.iter().map(|row| row.iter().map(Recorded::image).collect());
        let inverse = match images.collect::<Option<Vec<Vec<Image>>>>() {
            Some(images) => Some(inverse_image(images)?),
            None => None,
        };
        let mut weights = weights(&matrix)?;
        let (mut moves, mut columns): (Vec<Move>, Vec<_>) = (vec![], vec![]);
        for k in 0..matrix.len() {
            let mut column: Vec<_> = matrix.iter().map(|row| row[k].clone()).collect();
            moves.iter().for_each(|own| own.apply(&mut column));
            for j in k + 1..column.len() {
                if !column[j].vanishes() {
                    let sizes =
                        [k, j].map(|i| column[i].clone() * &(column[i].clone() * &weights[i]));
                    let exchange = Move::Exchange([k, j], sizes);
                    exchange.apply(&mut column);
                    exchange.apply(&mut weights);
                    moves.push(exchange);
                }
            }
            let unit = column[k].recip()?;
            for (j, entry) in column.iter().enumerate().skip(k + 1) {
                if !entry.vanishes() {
                    moves.push(Move::Subtract([k, j], entry.clone() * &unit));
                }
            }
            column.truncate(k);
            columns.push((column, unit));
        }
        Some(Factors { matrix, inverse, moves, columns })
    }

    fn eliminated(&self, right: &[Recorded]) -> Vec<Recorded> {
        let mut x = right.to_vec();
        self.moves.iter().for_each(|own| own.apply(&mut x));
        for (k, (column, unit)) in self.columns.iter().enumerate().rev() {
            x[k] = std::mem::take(&mut x[k]) * unit;
            for (i, entry) in column.iter().enumerate() {
                let multiple = entry.clone() * &x[k];
                x[i] = std::mem::take(&mut x[i]) - &multiple;
            }
        }
        x
    }
}

/// The weights `1 / d_i^2` of the rows; `None` if a row vanishes.
fn weights(matrix: &[Vec<Recorded>]) -> Option<Vec<Recorded>> {
    let larger = |a: Recorded, b: &Recorded| Recorded::select([&a, b, &a, b]);
    let largest = |values: &[Recorded]| values.iter().fold(Recorded::zero(), larger);
    let rows: Vec<Recorded> = matrix.iter().map(|row| largest(row)).collect();
    let unit = largest(&rows).recip()?;
    let weight = |(i, row): (usize, &Recorded)| {
        larger(row.clone() * &(row.clone() * &unit), &matrix[i][i]).recip()
    };
    rows.iter().enumerate().map(weight).collect()
}

impl Solution {
    /// All components, with their images.
    fn components(self: &Arc<Self>) -> Vec<Recorded> {
        let right: Option<Vec<Image>> = self.right.iter().map(Recorded::image).collect();
        let images = self.factors.inverse.as_ref().zip(right);
        let component = |i: usize| {
            let image = images.as_ref().map(|(inverse, right)| {
                let products = inverse[i].iter().zip(right).map(|(a, b)| a.mul(*b));
                products.fold(Image::ZERO, Image::add)
            });
            match self.eliminated[i].node {
                None => self.eliminated[i].clone(),
                Some(_) => Recorded::of(Operation::Solution(self.clone(), i), image),
            }
        };
        (0..self.right.len()).map(component).collect()
    }

    /// The component as a program computes it.
    pub(super) fn eliminated(&self, i: usize) -> &Recorded {
        &self.eliminated[i]
    }

    /// The entries of the matrix and of the right side.
    pub(super) fn arguments(&self) -> impl Iterator<Item = &Arc<Node>> {
        let values = self.factors.matrix.iter().flatten().chain(&self.right);
        values.filter_map(|value| value.node.as_ref())
    }

    /// The derivatives `A^-1 (db - dA x)`, for the derivatives of the arguments.
    pub(super) fn rates(self: &Arc<Self>, of: impl Fn(&Recorded) -> Recorded) -> Vec<Recorded> {
        let x = self.components();
        let rate = |(row, right): (&Vec<Recorded>, &Recorded)| {
            let terms = row.iter().zip(&x).map(|(entry, x)| of(entry) * x);
            terms.fold(of(right), |sum, term| sum - &term)
        };
        let right: Vec<_> = self.factors.matrix.iter().zip(&self.right).map(rate).collect();
        let eliminated = self.factors.eliminated(&right);
        Arc::new(Solution { factors: self.factors.clone(), right, eliminated }).components()
    }
}

/// The solution `X` of `A X = B`, if the square matrix `A` has an inverse and a block of more than two rows that is not constant.
pub(super) fn solved(
    matrix: &Matrix<Recorded>,
    right: &Matrix<Recorded>,
) -> Option<Matrix<Recorded>> {
    let constant = |(_, value): &(usize, Recorded)| value.node.is_none();
    let small = |block: &[usize]| {
        block.len() <= SMALL || block.iter().all(|i| matrix.row(*i).iter().all(constant))
    };
    let blocks = blocks(matrix);
    if blocks.iter().all(|block| small(block)) {
        return None;
    }
    let (rows, right) = (matrix.to_dense(), right.to_dense());
    let mut solution = vec![vec![Recorded::zero(); right[0].len()]; right.len()];
    for block in blocks {
        let entries = |rows: &[Vec<Recorded>], c: usize| -> Vec<Recorded> {
            block.iter().map(|i| rows[*i][c].clone()).collect()
        };
        let part: Vec<_> =
            block.iter().map(|i| block.iter().map(|j| rows[*i][*j].clone()).collect()).collect();
        let places =
            (0..right[0].len()).filter(|c| block.iter().any(|i| !right[*i][*c].vanishes()));
        let places: Vec<usize> = places.collect();
        let columns: Vec<_> = places.iter().map(|c| entries(&right, *c)).collect();
        let values = if small(&block) {
            let part = Matrix::from_dense(&part).ok()?;
            columns.iter().map(|column| part.solve(column).ok()?).collect::<Option<Vec<_>>>()?
        } else {
            pivoted(part, &columns)?
        };
        for (c, values) in places.into_iter().zip(values) {
            block.iter().zip(values).for_each(|(i, value)| solution[*i][c] = value);
        }
    }
    Matrix::from_dense(&solution).ok()
}

/// The solutions for the columns of the right side. The inverse of a symmetric matrix is computed on and below its diagonal.
fn pivoted(matrix: Vec<Vec<Recorded>>, columns: &[Vec<Recorded>]) -> Option<Vec<Vec<Recorded>>> {
    let n = matrix.len();
    let symmetric = (0..n).all(|i| (0..i).all(|j| matrix[i][j] == matrix[j][i]));
    let mirrored = symmetric && *columns == *Matrix::identity(n).to_dense();
    let factors = Arc::new(Factors::new(matrix)?);
    let mut solutions: Vec<Arc<Solution>> = vec![];
    for (q, right) in columns.iter().enumerate() {
        let mut eliminated = factors.eliminated(right);
        if mirrored {
            let above = solutions.iter().map(|earlier| earlier.eliminated[q].clone());
            eliminated.splice(..q, above);
        }
        let (factors, right) = (factors.clone(), right.clone());
        solutions.push(Arc::new(Solution { factors, right, eliminated }));
    }
    Some(solutions.iter().map(Solution::components).collect())
}

/// The rows and columns in blocks without entries between them.
fn blocks(matrix: &Matrix<Recorded>) -> Vec<Vec<usize>> {
    let mut first: Vec<usize> = (0..matrix.rows()).collect();
    let mut changed = true;
    while std::mem::take(&mut changed) {
        for (i, j, _) in matrix.entries() {
            let least = first[i].min(first[j]);
            changed |= first[i] != first[j];
            (first[i], first[j]) = (least, least);
        }
    }
    let members = |own: usize| (0..first.len()).filter(|i| first[*i] == own).collect();
    (0..first.len()).filter(|own| first[*own] == *own).map(members).collect()
}

/// The inverse of a matrix of images.
fn inverse_image(mut rows: Vec<Vec<Image>>) -> Option<Vec<Vec<Image>>> {
    let n = rows.len();
    for (i, row) in rows.iter_mut().enumerate() {
        row.extend((0..n).map(|j| if i == j { Image::ONE } else { Image::ZERO }));
    }
    for k in 0..n {
        let (at, unit) = (k..n).find_map(|i| Some((i, rows[i][k].recip()?)))?;
        rows.swap(k, at);
        let pivot: Vec<Image> = rows[k].iter().map(|entry| entry.mul(unit)).collect();
        for row in &mut rows {
            let factor = row[k].negated();
            row.iter_mut().zip(&pivot).for_each(|(own, x)| *own = own.add(factor.mul(*x)));
        }
        rows[k] = pivot;
    }
    Some(rows.into_iter().map(|mut row| row.split_off(n)).collect())
}
