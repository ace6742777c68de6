//! Solutions of linear systems of recorded values. They are computed by an elimination that chooses
//! its pivots when the program runs.
//!
//! The method is partial pivoting. Sizes are compared in the matrix `A_ij / (d_i d_j)` with
//! `d_i^2 = max(|A_ii|, m_i^2 / M)`. Here `m_i` is the largest size in row `i`, and `M` is the
//! largest size in the matrix. The relative error of the inverse of the scaled matrix is a small
//! multiple of the machine precision times its condition number (N. J. Higham, *Accuracy and
//! Stability of Numerical Algorithms*, 2002, section 9.3). A definite matrix has
//! `A_ij^2 < A_ii A_jj`, so `d_i^2 = |A_ii|`. In this case, the bound does not depend on the units
//! of the basis.

use super::image::Image;
use super::{Node, Operation, Recorded};
use crate::linear::Matrix;
use crate::{Field, Ring};
use num_traits::Zero;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The solution of `A x = b`.
pub(super) struct Solution {
    factors: Arc<Factors>,
    right: Vec<Recorded>,
    /// The components, which a program computes by elimination.
    eliminated: Vec<Recorded>,
}

/// A matrix, and the operations that make it upper triangular.
struct Factors {
    /// The columns of the matrix.
    matrix: Vec<Vec<Recorded>>,
    /// The rows of the image of the transposed inverse. It is `None` if an entry of the matrix has
    /// no image.
    inverse: Option<Vec<Vec<Image>>>,
    moves: Vec<Move>,
    /// The columns of the triangular matrix above its diagonal, each with the reciprocal of its
    /// diagonal entry.
    triangle: Vec<(Vec<Recorded>, Recorded)>,
}

/// An operation on the rows of a matrix.
enum Move {
    /// Exchanges two rows, unless the first size is at least the second size.
    Exchange([usize; 2], [Recorded; 2]),
    /// Subtracts a multiple of the first row from the second row.
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
    /// Factors the matrix with these columns. Returns `None` if it is singular.
    fn new(matrix: Vec<Vec<Recorded>>) -> Option<Self> {
        let images = matrix.iter().map(|column| column.iter().map(Recorded::image).collect());
        let inverse = match images.collect::<Option<Vec<Vec<Image>>>>() {
            Some(images) => Some(inverse_image(images)?),
            None => None,
        };
        let mut weights = weights(&matrix)?;
        let (mut moves, mut triangle): (Vec<Move>, Vec<_>) = (vec![], vec![]);
        for (k, mut column) in matrix.iter().cloned().enumerate() {
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
            triangle.push((column, unit));
        }
        Some(Factors { matrix, inverse, moves, triangle })
    }

    /// The solution for a right-hand side, which a program computes by elimination.
    fn eliminated(&self, mut x: Vec<Recorded>) -> Vec<Recorded> {
        self.moves.iter().for_each(|own| own.apply(&mut x));
        for (k, (column, unit)) in self.triangle.iter().enumerate().rev() {
            x[k] = std::mem::take(&mut x[k]) * unit;
            for (i, entry) in column.iter().enumerate() {
                let multiple = entry.clone() * &x[k];
                x[i] = std::mem::take(&mut x[i]) - &multiple;
            }
        }
        x
    }
}

/// The weights `1 / d_i^2` of the rows of the matrix with these columns. Returns `None` if a row
/// vanishes.
fn weights(matrix: &[Vec<Recorded>]) -> Option<Vec<Recorded>> {
    let larger = |a: Recorded, b: &Recorded| Recorded::select([&a, b, &a, b]);
    let row = |i| matrix.iter().map(|column| &column[i]).fold(Recorded::zero(), larger);
    let rows: Vec<Recorded> = (0..matrix.len()).map(row).collect();
    let unit = rows.iter().fold(Recorded::zero(), larger).recip()?;
    let weight = |(i, row): (usize, &Recorded)| {
        larger(row.clone() * &(row.clone() * &unit), &matrix[i][i]).recip()
    };
    rows.iter().enumerate().map(weight).collect()
}

impl Solution {
    fn new(factors: &Arc<Factors>, right: Vec<Recorded>) -> Self {
        let eliminated = factors.eliminated(right.clone());
        Solution { factors: factors.clone(), right, eliminated }
    }

    /// All components, with their images.
    fn components(self: &Arc<Self>) -> Vec<Recorded> {
        let right: Option<Vec<Image>> = self.right.iter().map(Recorded::image).collect();
        let images = self.factors.inverse.as_ref().zip(right);
        let component = |(i, own): (usize, &Recorded)| {
            let image = images.as_ref().map(|(inverse, right)| {
                let products = inverse.iter().zip(right).map(|(row, b)| row[i].mul(*b));
                products.fold(Image::ZERO, Image::add)
            });
            match own.node {
                None => own.clone(),
                Some(_) => Recorded::of(Operation::Solution(self.clone(), i), image),
            }
        };
        self.eliminated.iter().enumerate().map(component).collect()
    }

    /// A component, which a program computes by elimination.
    pub(super) fn eliminated(&self, i: usize) -> &Recorded {
        &self.eliminated[i]
    }

    /// The entries of the matrix and of the right-hand side.
    pub(super) fn arguments(&self) -> impl Iterator<Item = &Arc<Node>> {
        let values = self.factors.matrix.iter().flatten().chain(&self.right);
        values.filter_map(|value| value.node.as_ref())
    }

    /// The derivatives `A^-1 (db - dA x)` of the components, computed from the derivatives of the
    /// arguments.
    pub(super) fn rates(self: &Arc<Self>, of: impl Fn(&Recorded) -> Recorded) -> Vec<Recorded> {
        let mut right: Vec<Recorded> = self.right.iter().map(&of).collect();
        for (column, x) in self.factors.matrix.iter().zip(self.components()) {
            for (own, entry) in right.iter_mut().zip(column) {
                *own = std::mem::take(own) - &(of(entry) * &x);
            }
        }
        Arc::new(Solution::new(&self.factors, right)).components()
    }
}

/// The solution `X` of `A X = B`. Returns `None` unless the square matrix `A` is invertible, and
/// has a block of several rows that is not constant.
pub(super) fn solved(
    matrix: &Matrix<Recorded>,
    right: &Matrix<Recorded>,
) -> Option<Matrix<Recorded>> {
    let constant = |(_, value): &(usize, Recorded)| value.node.is_none();
    let plain = |block: &[usize]| {
        block.len() == 1 || block.iter().all(|i| matrix.row(*i).iter().all(constant))
    };
    let blocks = blocks(matrix);
    if blocks.iter().all(|block| plain(block)) {
        return None;
    }
    let mut rows = vec![vec![]; matrix.rows()];
    for block in blocks {
        let columns = |of: &Matrix<Recorded>, places: &[usize]| -> Vec<Vec<Recorded>> {
            places.iter().map(|c| block.iter().map(|i| of.get(*i, *c)).collect()).collect()
        };
        let places: BTreeSet<usize> =
            block.iter().flat_map(|i| right.row(*i)).map(|(c, _)| *c).collect();
        let places = Vec::from_iter(places);
        let (own, given) = (columns(matrix, &block), columns(right, &places));
        let values = if plain(&block) {
            let own = Matrix::from_dense(&own).ok()?.transpose();
            given.iter().map(|right| own.solve(right).ok()?).collect::<Option<_>>()?
        } else if let [first, second] = &own[..] {
            by_adjugate(first, second, &given)?
        } else {
            pivoted(own, given)?
        };
        for (c, values) in places.into_iter().zip(values) {
            block.iter().zip(values).for_each(|(i, value)| rows[*i].push((c, value)));
        }
    }
    Matrix::from_rows(right.columns(), rows).ok()
}

/// The solutions for several right-hand sides and a matrix with two columns. They are computed by
/// Cramer's rule.
fn by_adjugate(
    first: &[Recorded],
    second: &[Recorded],
    right: &[Vec<Recorded>],
) -> Option<Vec<Vec<Recorded>>> {
    let determinant =
        |x: &[Recorded], y: &[Recorded]| x[0].clone() * &y[1] - &(x[1].clone() * &y[0]);
    let unit = determinant(first, second).recip()?;
    let solution =
        |b: &Vec<Recorded>| vec![determinant(b, second) * &unit, determinant(first, b) * &unit];
    Some(right.iter().map(solution).collect())
}

/// The solutions for several right-hand sides. If the matrix is symmetric, its inverse is computed
/// only on and below the diagonal.
fn pivoted(matrix: Vec<Vec<Recorded>>, right: Vec<Vec<Recorded>>) -> Option<Vec<Vec<Recorded>>> {
    let n = matrix.len();
    let symmetric = (0..n).all(|i| (0..i).all(|j| matrix[i][j] == matrix[j][i]));
    let inverse = symmetric && right == Matrix::identity(n).to_dense();
    let factors = Arc::new(Factors::new(matrix)?);
    let mut solutions: Vec<Solution> = vec![];
    for (q, right) in right.into_iter().enumerate() {
        let mut solution = Solution::new(&factors, right);
        if inverse {
            let above = solutions.iter().map(|earlier| earlier.eliminated[q].clone());
            solution.eliminated.splice(..q, above);
        }
        solutions.push(solution);
    }
    Some(solutions.into_iter().map(|solution| Arc::new(solution).components()).collect())
}

/// The diagonal blocks of a matrix. They are sets of rows and columns, and there are no entries
/// between different sets.
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
