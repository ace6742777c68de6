//! The factorization of the mass matrix along the branches of a tree.

use super::{MovingTree, Tree};
use nalgebra::DVector;

/// The factorization `M = L^T L` of a symmetric positive definite matrix, with a lower triangular
/// matrix `L` in the order of the tree. In the row of a rate, only the rates on the way to the ground
/// have entries, as in `M`. So the cost is that of the branches, and small if they are short.
///
/// R. Featherstone, *Rigid Body Dynamics Algorithms* (2008), chapter 8.
#[derive(Clone, Debug)]
pub(crate) struct MassFactor {
    /// For each rate, the one before it on the way to the ground.
    before: Vec<Option<usize>>,
    /// All rates, each one after the rates before it.
    order: Vec<usize>,
    /// For each rate, its row of `L`: the entry of the rate itself, then those on the way to the
    /// ground.
    rows: Vec<Vec<f64>>,
}

impl Tree {
    /// For each rate, the one before it on the way to the ground.
    fn before(&self) -> Vec<Option<usize>> {
        let mut before = vec![None; self.freedom()];
        for node in &self.nodes {
            let parent = node.parent.map(|parent| self.nodes[parent].rates.end - 1);
            for rate in node.rates.clone() {
                before[rate] = if rate > node.rates.start { Some(rate - 1) } else { parent };
            }
        }
        before
    }
}

impl MovingTree {
    /// The factorization of the mass matrix at the configuration of [`place`](Self::place). Returns
    /// `None` if the matrix is not positive definite.
    pub(crate) fn mass_factor(&mut self) -> Option<MassFactor> {
        let before = self.tree.before();
        let order = self.tree.nodes.iter().flat_map(|node| node.rates.clone()).collect();
        let mut rows = vec![vec![]; before.len()];
        // the entries of a row come in the order of its way
        self.mass_entries(|rate, _, entry| rows[rate].push(entry));
        MassFactor { before, order, rows }.factorized()
    }
}

impl MassFactor {
    /// The factorization of a diagonal matrix with positive entries.
    pub fn diagonal(entries: impl Iterator<Item = f64>) -> Self {
        let rows: Vec<Vec<f64>> = entries.map(|entry| vec![entry.sqrt()]).collect();
        MassFactor { before: vec![None; rows.len()], order: (0..rows.len()).collect(), rows }
    }

    /// The number of rates.
    pub fn freedom(&self) -> usize {
        self.order.len()
    }

    /// Replaces the rows of `M` by those of `L`.
    fn factorized(mut self) -> Option<Self> {
        for &rate in self.order.iter().rev() {
            let mut row = std::mem::take(&mut self.rows[rate]);
            let pivot = row[0].sqrt();
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            row.iter_mut().for_each(|entry| *entry /= pivot);
            let mut next = self.before[rate];
            for (at, factor) in row.iter().enumerate().skip(1) {
                let Some(on_way) = next else { break };
                let others = self.rows[on_way].iter_mut().zip(&row[at..]);
                others.for_each(|(other, entry)| *other -= factor * entry);
                next = self.before[on_way];
            }
            self.rows[rate] = row;
        }
        Some(self)
    }

    /// The solution `y` of `L^T y = x`.
    pub fn transposed_solution(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut y = x.clone();
        self.order.iter().rev().for_each(|rate| self.eliminate(*rate, y.as_mut_slice()));
        y
    }

    /// The solutions `y` of `L^T y = x` for several `x` with few entries. Each one is the list of its
    /// entries.
    pub fn sparse_solutions(&self, list: &[Vec<(usize, f64)>]) -> Vec<Vec<(usize, f64)>> {
        let mut y = vec![0.0; self.freedom()];
        let mut is_reached = vec![false; self.freedom()];
        let mut solution = |x: &Vec<(usize, f64)>| {
            let mut reached = vec![];
            for (rate, value) in x {
                y[*rate] = *value;
                let mut next = Some(*rate);
                while let Some(at) = next.filter(|at| !is_reached[*at]) {
                    is_reached[at] = true;
                    reached.push(at);
                    next = self.before[at];
                }
            }
            // a rate is farther from the ground than all rates before it
            reached.sort_by_key(|rate| std::cmp::Reverse(self.rows[*rate].len()));
            reached.iter().for_each(|rate| self.eliminate(*rate, &mut y));
            reached.iter().for_each(|rate| is_reached[*rate] = false);
            reached.iter().map(|rate| (*rate, std::mem::take(&mut y[*rate]))).collect()
        };
        list.iter().map(&mut solution).collect()
    }

    /// Divides the entry of a rate by the pivot, and subtracts its share from the rates before it.
    fn eliminate(&self, rate: usize, y: &mut [f64]) {
        let row = &self.rows[rate];
        let value = y[rate] / row[0];
        y[rate] = value;
        let mut next = self.before[rate];
        for entry in &row[1..] {
            let Some(at) = next else { break };
            y[at] -= entry * value;
            next = self.before[at];
        }
    }

    /// The product of the row of a rate, without its first entry, and a vector.
    fn dot(&self, rate: usize, x: &DVector<f64>) -> f64 {
        let mut sum = 0.0;
        let mut next = self.before[rate];
        for entry in &self.rows[rate][1..] {
            let Some(at) = next else { break };
            sum += entry * x[at];
            next = self.before[at];
        }
        sum
    }

    /// The solution `x` of `L x = y`.
    pub fn solution(&self, y: &DVector<f64>) -> DVector<f64> {
        let mut x = y.clone();
        for &rate in &self.order {
            x[rate] = (y[rate] - self.dot(rate, &x)) / self.rows[rate][0];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::MassProperties;
    use crate::mechanism::{Joint, Mechanism};
    use nalgebra::{DMatrix, Isometry3, Vector3};

    /// A tree with two branches, one of which has a ball joint, at a bent configuration.
    fn branched() -> Result<MovingTree, crate::Error> {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [1.0, 1.0, 0.0], [2.0, 0.5, 0.0]];
        let joints = vec![
            // joints need not come in the order of the tree
            Joint::revolute(&points[3], &[0.0, 1.0, 1.0])?.between("D", [1, 4]),
            Joint::spherical(&points[1])?.between("B", [1, 2]),
            Joint::revolute(&points[0], &[0.0, 0.0, 1.0])?.between("A", [0, 1]),
            Joint::cylindrical(&points[2], &[1.0, 0.0, 0.0])?.between("C", [2, 3]),
        ];
        let names = ["ground", "a", "b", "c", "d"].map(String::from).to_vec();
        let mechanism = Mechanism::new(names, &[0], joints)?;
        let body = |k: usize| -> Result<Option<MassProperties>, crate::Error> {
            let place = Isometry3::translation(k as f64, 0.3, -0.2 * k as f64);
            Ok(Some(MassProperties::rod(1.0)?.moved(&place)))
        };
        let inertias = [None, body(1)?, body(2)?, body(3)?, body(4)?];
        let tree = Tree::new(&mechanism, &inertias, &Vector3::zeros())?;
        let mut numbers = tree.home();
        for (at, number) in numbers.iter_mut().enumerate() {
            *number += 0.1 * (at as f64 + 1.0);
        }
        let freedom = tree.freedom();
        let mut moving = MovingTree::new(tree.into());
        moving.place(&numbers, &vec![0.0; freedom]);
        Ok(moving)
    }

    #[test]
    fn solutions_agree_with_the_matrix() -> Result<(), crate::Error> {
        let mut moving = branched()?;
        let mass = moving.mass_matrix();
        let factor = moving.mass_factor().expect("a positive definite matrix");
        let n = mass.nrows();
        let mut lower = DMatrix::zeros(n, n);
        for (rate, row) in factor.rows.iter().enumerate() {
            let way = std::iter::successors(Some(rate), |at| factor.before[*at]);
            way.zip(row).for_each(|(at, entry)| lower[(rate, at)] = *entry);
        }
        assert!((lower.tr_mul(&lower) - &mass).amax() < 1e-13);
        let x = DVector::from_fn(n, |i, _| (i as f64).cos());
        assert!((&lower * factor.solution(&x) - &x).amax() < 1e-13);
        let y = factor.transposed_solution(&x);
        assert!((lower.tr_mul(&y) - &x).amax() < 1e-13);
        // vectors with one or two entries
        for pair in [[0, 3], [2, 2], [4, 1], [6, 0]] {
            let entries: Vec<(usize, f64)> = pair.iter().map(|at| (*at, x[*at])).collect();
            let mut right = DVector::zeros(n);
            entries.iter().for_each(|(at, value)| right[*at] = *value);
            let [found] = &factor.sparse_solutions(&[entries])[..] else { panic!() };
            let mut y = DVector::zeros(n);
            found.iter().for_each(|(at, value)| y[*at] = *value);
            assert!((lower.tr_mul(&y) - right).amax() < 1e-13, "{pair:?}");
        }
        Ok(())
    }
}
