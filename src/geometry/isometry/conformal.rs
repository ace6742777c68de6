//! Conformal Killing fields: the prolonged equations on a jet, and the bracket of jets.
//!
//! A conformal Killing field satisfies `L_K g = 2 phi g` with a function `phi`. In dimension 3 and
//! more it is determined by the jet `(K, F, phi, psi)` at a point: `(n+1)(n+2)/2` numbers. With the
//! Schouten tensor `P` and the conventions of this package (T. Branson, A. Cap, M. Eastwood, A. R.
//! Gover, *Int. J. Math.* 17 (2006) 641-664),
//!
//! ```text
//! nabla_j K_i    = F_ij + phi g_ij,    F_ij = -F_ji
//! nabla_k F_ij   = R_ijkp K^p + g_ik psi_j - g_jk psi_i
//! nabla_i phi    = psi_i
//! nabla_i psi_j  = -(L_K P)_ij
//! ```
//!
//! The jets are parallel sections of this connection. They satisfy `L_K W = 0` for the Weyl tensor
//! `W^i_jkl` in dimension 4 and more, and `L_K C = 0` for the Cotton tensor in dimension 3: linear
//! equations on a jet. The derivative of an equation is again one, because the derivatives of the jet
//! are known. The equations are differentiated until no new one is found.

use super::jets::Jets;
use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::{Echelon, Row};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar, Tensor};

/// The largest number of derivatives of the equations.
pub(super) const MAX_ORDER: usize = 5;

/// The tensors of the prolonged equations, in the frame of the connection.
pub(super) struct Prolonged<S> {
    n: usize,
    /// The matrices of the derivatives of a jet: `e_m(v) = M_m v`, by rows.
    matrices: Vec<Vec<Row<S>>>,
    /// The equations on a jet.
    equations: Vec<Row<S>>,
    /// The derivatives `nabla_m` of `F_ij` and of `psi_j` as functions of the jet, for the bracket.
    metric: Tensor<S>,
    inverse: Tensor<S>,
    curvature: Tensor<S>,
    schouten: Tensor<S>,
    nabla_schouten: Tensor<S>,
}

/// The number of unknowns of a jet: `K^i`, `F_ij` for `i < j`, `phi`, `psi_i`.
pub(super) fn count(n: usize) -> usize {
    (n + 1) * (n + 2) / 2
}

/// The columns of a jet. The vector `K` has the first columns, as in `Columns`.
#[derive(Clone, Copy)]
struct Place {
    n: usize,
}

impl Place {
    fn rotation(self, i: usize, j: usize) -> usize {
        self.n + i * (2 * self.n - i - 1) / 2 + j - i - 1
    }

    fn factor(self) -> usize {
        self.n * (self.n + 1) / 2
    }

    fn slope(self, i: usize) -> usize {
        self.factor() + 1 + i
    }
}

/// A linear form on jets, dense.
struct Linear<S>(Vec<S>);

impl<S: Field + Scalar> Linear<S> {
    fn zero(n: usize) -> Self {
        Linear(vec![S::zero(); count(n)])
    }

    fn add(&mut self, at: usize, value: &S) {
        if !value.vanishes() {
            self.0[at] = self.0[at].clone() + value;
        }
    }

    /// Adds a multiple of `F_ij`.
    fn add_rotation(&mut self, place: Place, i: usize, j: usize, value: &S) {
        match i.cmp(&j) {
            std::cmp::Ordering::Less => self.add(place.rotation(i, j), value),
            std::cmp::Ordering::Greater => self.add(place.rotation(j, i), &-value.clone()),
            std::cmp::Ordering::Equal => {}
        }
    }

    fn into_row(self) -> Row<S> {
        self.0.into_iter().enumerate().filter(|(_, value)| !value.vanishes()).collect()
    }
}

impl<S: Field + Scalar> Prolonged<S> {
    /// The prolonged equations of a Levi-Civita connection in dimension 3 or more.
    pub fn new(connection: &Connection<S>, metric: &Metric<S>) -> Result<Self, Error> {
        let n = connection.frame().dimension();
        let operands = [("g", metric.components()), ("R", connection.curvature())];
        let curvature = formula("g_im R^m_jkl -> _ij[kl]", &operands);
        let schouten = connection.schouten(metric)?;
        let nabla_schouten = connection.nabla(&schouten)?;
        let mut prolonged = Prolonged {
            n,
            matrices: vec![],
            equations: vec![],
            metric: metric.components().clone(),
            inverse: metric.inverse().clone(),
            curvature,
            schouten,
            nabla_schouten,
        };
        prolonged.matrices = (0..n).map(|m| prolonged.matrix(connection, m)).collect();
        let tensor = match n {
            3 => connection.cotton(metric)?,
            _ => connection.weyl(metric)?.lower(0, metric.components())?,
        };
        let derivative = connection.nabla(&tensor)?;
        // the weights of `W_ijkl` and `C_jkl`: `L_K W = 2 phi W`, `L_K C = 0`
        let weight = if n == 3 { 3 } else { 2 };
        prolonged.equations = prolonged.conditions(&tensor, &derivative, weight);
        Ok(prolonged)
    }

    fn place(&self) -> Place {
        Place { n: self.n }
    }

    /// Adds `value * nabla_j K^i` to a linear form: `g^iq F_qj + phi delta^i_j`.
    fn add_slope_of_field(&self, form: &mut Linear<S>, i: usize, j: usize, value: &S) {
        let place = self.place();
        for q in 0..self.n {
            let raise = self.inverse.get(&[i, q]);
            if !raise.vanishes() {
                form.add_rotation(place, q, j, &(raise * value));
            }
        }
        if i == j {
            form.add(place.factor(), value);
        }
    }

    /// Adds `value * nabla_i psi_j` to a linear form.
    fn add_slope_of_psi(&self, form: &mut Linear<S>, i: usize, j: usize, value: &S) {
        let minus = -value.clone();
        for p in 0..self.n {
            form.add(p, &(self.nabla_schouten.get(&[p, i, j]) * &minus));
            let [left, right] = [[p, j], [i, p]].map(|at| self.schouten.get(&at) * &minus);
            if !left.vanishes() {
                self.add_slope_of_field(form, p, i, &left);
            }
            if !right.vanishes() {
                self.add_slope_of_field(form, p, j, &right);
            }
        }
    }

    /// The rows of the matrix of the derivative along `e_m`.
    fn matrix(&self, connection: &Connection<S>, m: usize) -> Vec<Row<S>> {
        let (n, place) = (self.n, self.place());
        let affinity = |i: usize, k: usize| connection.affinities().get(&[i, m, k]);
        let one = S::one();
        let mut rows = vec![];
        for i in 0..n {
            let mut form = Linear::zero(n);
            self.add_slope_of_field(&mut form, i, m, &one);
            (0..n).for_each(|p| form.add(p, &-affinity(i, p)));
            rows.push(form.into_row());
        }
        for i in 0..n {
            for j in i + 1..n {
                let mut form = Linear::zero(n);
                for p in 0..n {
                    form.add(p, &self.curvature.get(&[i, j, m, p]));
                    form.add_rotation(place, p, j, &affinity(p, i));
                    form.add_rotation(place, i, p, &affinity(p, j));
                }
                form.add(place.slope(j), &self.metric.get(&[i, m]));
                form.add(place.slope(i), &-self.metric.get(&[j, m]));
                rows.push(form.into_row());
            }
        }
        let mut form = Linear::zero(n);
        form.add(place.slope(m), &one);
        rows.push(form.into_row());
        for j in 0..n {
            let mut form = Linear::zero(n);
            self.add_slope_of_psi(&mut form, m, j, &one);
            (0..n).for_each(|p| form.add(place.slope(p), &affinity(p, j)));
            rows.push(form.into_row());
        }
        rows
    }

    /// The equations `K^m nabla_m T + T(nabla K, ...) - (rank - weight) phi T = 0`, where `weight`
    /// is the factor of `phi` that remains.
    fn conditions(&self, tensor: &Tensor<S>, derivative: &Tensor<S>, weight: i64) -> Vec<Row<S>> {
        let (n, rank, place) = (self.n, tensor.rank(), self.place());
        let weight = S::from_i64(weight);
        let mut rows = vec![];
        let total = n.pow(rank as u32);
        for code in 0..total {
            let mut at = vec![0; rank];
            let mut rest = code;
            for entry in at.iter_mut().rev() {
                *entry = rest % n;
                rest /= n;
            }
            // the symmetries of the tensors make the other rows redundant
            let is_needed = match at[..] {
                [i, j, k, l] => i < j && k < l && (i, j) <= (k, l),
                [_, k, l] => k < l,
                _ => true,
            };
            if !is_needed {
                continue;
            }
            checkpoint();
            let mut form = Linear::zero(n);
            for m in 0..n {
                let slots: Vec<usize> = std::iter::once(m).chain(at.iter().copied()).collect();
                form.add(m, &derivative.get(&slots));
            }
            for slot in 0..rank {
                for p in 0..n {
                    let mut other = at.clone();
                    other[slot] = p;
                    let value = tensor.get(&other);
                    if value.vanishes() {
                        continue;
                    }
                    for q in 0..n {
                        let raise = self.inverse.get(&[p, q]);
                        if !raise.vanishes() {
                            form.add_rotation(place, q, at[slot], &(raise * &value));
                        }
                    }
                }
            }
            form.add(place.factor(), &(tensor.get(&at) * &weight));
            rows.push(form.into_row());
        }
        rows
    }

    /// Solves the equations order by order, until an order has no new equation, or the dimension is
    /// `least`. The function `value` evaluates a scalar at the point, and `orders` is the number of
    /// derivatives for which the scalars are known.
    pub fn solve<V: Field + Scalar>(
        &self,
        connection: &Connection<S>,
        value: impl Fn(&S) -> V,
        orders: usize,
        least: usize,
    ) -> Result<Jets<V>, Error> {
        let count = count(self.n);
        let mut span: Echelon<V> = Echelon::new();
        let mut dimensions = vec![count];
        let mut last = vec![];
        let mut open = self.equations.clone();
        let mut is_stable = false;
        for order in 0..=orders {
            last.clear();
            for row in open.drain(..) {
                checkpoint();
                let at_point = row.iter().map(|(at, entry)| (*at, value(entry)));
                if span.insert(at_point.filter(|(_, v)| !v.vanishes()))? {
                    last.push(row);
                }
            }
            let dimension = count - span.rank();
            dimensions.push(dimension);
            is_stable = last.is_empty() || dimension <= least;
            if is_stable || order == orders {
                break;
            }
            for row in &last {
                for m in 0..self.n {
                    open.push(self.derived(connection, row, m));
                }
            }
        }
        let mut space = Echelon::new();
        for row in span.nullspace(count) {
            space.insert(row)?;
        }
        Ok(Jets { space, dimensions, is_stable })
    }

    /// The derivative of an equation along `e_m`: `e_m(r) + r M_m`.
    fn derived(&self, connection: &Connection<S>, row: &Row<S>, m: usize) -> Row<S> {
        let mut form = Linear::zero(self.n);
        for (at, entry) in row {
            form.add(*at, &connection.frame().derive(m, entry));
            for (column, factor) in &self.matrices[m][*at] {
                form.add(*column, &(entry.clone() * factor));
            }
        }
        form.into_row()
    }

    /// The same tensors at the point.
    pub fn at<V: Field + Scalar>(&self, value: impl Fn(&S) -> V) -> Prolonged<V> {
        let value = &value;
        Prolonged {
            n: self.n,
            matrices: vec![],
            equations: vec![],
            metric: self.metric.map(value),
            inverse: self.inverse.map(value),
            curvature: self.curvature.map(value),
            schouten: self.schouten.map(value),
            nabla_schouten: self.nabla_schouten.map(value),
        }
    }

    /// The structure constants `(j, k, i, c^i_jk)` of jets in the basis of their space, by the bracket
    /// of vector fields. With `B^i_j = nabla_j K^i` and `D_jp = nabla_j psi_p`,
    ///
    /// ```text
    /// K''   = B' K - B K'
    /// B''   = B' B - B B' + (R^i_pjq K^p K'^q + K^p psi'_p delta^i_j - K_j psi'^i + K^i psi'_j) - (exchanged)
    /// phi'' = K^p psi'_p - K'^p psi_p
    /// psi''_j = B^p_j psi'_p + K^p D'_jp - (exchanged)
    /// ```
    ///
    /// Returns `None` if a bracket lies outside the space.
    pub fn structure(&self, jets: &Echelon<S>) -> Option<Vec<(usize, usize, usize, S)>> {
        let (n, place) = (self.n, self.place());
        let all: Vec<Jet<S>> = jets.rows().iter().map(|row| self.jet(row)).collect();
        let sum = |terms: &mut dyn Iterator<Item = S>| terms.fold(S::zero(), |a, b| a + &b);
        let mut constants = vec![];
        for (j, x) in all.iter().enumerate() {
            for (k, y) in all.iter().enumerate().skip(j + 1) {
                checkpoint();
                let mut row: Row<S> = vec![];
                for i in 0..n {
                    let terms = (0..n)
                        .map(|m| y.b[i][m].clone() * &x.k[m] - &(x.b[i][m].clone() * &y.k[m]));
                    row.push((i, sum(&mut terms.into_iter())));
                }
                let pairing =
                    |x: &Jet<S>, y: &Jet<S>| sum(&mut (0..n).map(|p| x.k[p].clone() * &y.psi[p]));
                let factor = pairing(x, y) - &pairing(y, x);
                // F''_lj = g_li B''^i_j - phi'' g_lj, in which the terms with phi'' cancel
                let half = |x: &Jet<S>, y: &Jet<S>, l: usize, j: usize| {
                    let product = (0..n).map(|i| {
                        let inner = sum(&mut (0..n).map(|m| y.b[i][m].clone() * &x.b[m][j]));
                        self.metric.get(&[l, i]) * &inner
                    });
                    let bent = (0..n)
                        .flat_map(|p| (0..n).map(move |q| (p, q)))
                        .map(|(p, q)| self.curvature.get(&[l, p, j, q]) * &x.k[p] * &y.k[q]);
                    let outer = self.lower(x, l) * &y.psi[j] - &(self.lower(x, j) * &y.psi[l]);
                    sum(&mut product.into_iter()) + &sum(&mut bent.into_iter()) + &outer
                };
                for l in 0..n {
                    for m in l + 1..n {
                        let value = half(x, y, l, m) - &half(y, x, l, m);
                        row.push((place.rotation(l, m), value));
                    }
                }
                row.push((place.factor(), factor));
                for m in 0..n {
                    let part = |x: &Jet<S>, y: &Jet<S>| {
                        sum(&mut (0..n).map(|p| {
                            x.b[p][m].clone() * &y.psi[p] + &(x.k[p].clone() * &y.slope[m][p])
                        }))
                    };
                    row.push((place.slope(m), part(x, y) - &part(y, x)));
                }
                let nonzero = row.into_iter().filter(|(_, v)| !v.vanishes());
                let coordinates = jets.coordinates(nonzero)?;
                let nonzero = coordinates.into_iter().enumerate().filter(|(_, v)| !v.vanishes());
                constants.extend(nonzero.map(|(i, value)| (j, k, i, value)));
            }
        }
        Some(constants)
    }

    fn lower(&self, jet: &Jet<S>, l: usize) -> S {
        let terms = (0..self.n).map(|i| self.metric.get(&[l, i]) * &jet.k[i]);
        terms.fold(S::zero(), |a, b| a + &b)
    }

    fn jet(&self, row: &Row<S>) -> Jet<S> {
        let (n, place) = (self.n, self.place());
        let mut values = vec![S::zero(); count(n)];
        row.iter().for_each(|(at, value)| values[*at] = value.clone());
        let on_jet = |form: Linear<S>| {
            let terms = form.0.into_iter().zip(&values).map(|(a, v)| a * v);
            terms.fold(S::zero(), |a, b| a + &b)
        };
        let one = S::one();
        let field = |i: usize, j: usize| {
            let mut form = Linear::zero(n);
            self.add_slope_of_field(&mut form, i, j, &one);
            on_jet(form)
        };
        let slope = |i: usize, j: usize| {
            let mut form = Linear::zero(n);
            self.add_slope_of_psi(&mut form, i, j, &one);
            on_jet(form)
        };
        Jet {
            b: (0..n).map(|i| (0..n).map(|j| field(i, j)).collect()).collect(),
            slope: (0..n).map(|i| (0..n).map(|j| slope(i, j)).collect()).collect(),
            psi: (0..n).map(|i| values[place.slope(i)].clone()).collect(),
            k: values[..n].to_vec(),
        }
    }
}

/// A jet: `K^i`, `B^i_j = nabla_j K^i`, `psi_i`, `nabla_i psi_j`.
struct Jet<S> {
    k: Vec<S>,
    b: Vec<Vec<S>>,
    psi: Vec<S>,
    slope: Vec<Vec<S>>,
}
