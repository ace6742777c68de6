//! An inertia seen from its centre, where turns and translations do not share it.

use super::cotangent::Sizes;
use super::matrix::Matrix;
use crate::dense::least_squares;
use crate::group::{Coordinates, LieGroup};
use affinor_tensors::Tensor;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// What steps of an inertia on a group with translations need.
#[derive(Debug)]
pub(super) struct Centred<G: LieGroup> {
    /// Unless the centre is the origin of the body.
    at: Option<AtCentre<G>>,
    /// By `i`: `(a, b)`, `a <= b`, and the coefficient of `H_a H_b` in `(ad*_(P Omega) H)_i`. Terms that cancel for every
    /// momentum, as of a mass that is alike in all directions, are not there: their rounding would be a torque.
    transfer: Vec<Vec<([usize; 2], f64)>>,
    sizes: Sizes,
}

// derived, it would ask the group to be `Clone` as well
impl<G: LieGroup> Clone for Centred<G> {
    fn clone(&self) -> Self {
        let (at, transfer, sizes) = (self.at.clone(), self.transfer.clone(), self.sizes);
        Centred { at, transfer, sizes }
    }
}

/// The inertia `J(Ad_c x, Ad_c y)` at the centre.
#[derive(Debug)]
struct AtCentre<G: LieGroup> {
    /// The translation `c` to it.
    centre: G::Element,
    inertia: Matrix<G::Vector>,
    inverse: Matrix<G::Vector>,
}

impl<G: LieGroup> Clone for AtCentre<G> {
    fn clone(&self) -> Self {
        let AtCentre { centre, inertia, inverse } = self;
        let (inertia, inverse) = (inertia.clone(), inverse.clone());
        AtCentre { centre: centre.clone(), inertia, inverse }
    }
}

impl<G: LieGroup> Centred<G> {
    /// From an inertia, its inverse, and the structure constants of the group.
    pub(super) fn new(
        group: &G,
        metric: &Matrix<G::Vector>,
        inverse: &Matrix<G::Vector>,
        structure: &Tensor<f64>,
    ) -> Self {
        let at = at_centre(group, metric);
        let (metric, inverse) = match &at {
            Some(AtCentre { inertia, inverse, .. }) => (inertia, inverse),
            None => (metric, inverse),
        };
        let transfer = transfer(group, inverse, structure);
        let sizes = sizes(group, metric);
        Centred { at, transfer, sizes }
    }

    #[inline]
    pub(super) fn centre(&self) -> Option<&G::Element> {
        self.at.as_ref().map(|at| &at.centre)
    }

    /// The inverse of the inertia at the centre, unless it is that at the origin.
    #[inline]
    pub(super) fn inverse(&self) -> Option<&Matrix<G::Vector>> {
        self.at.as_ref().map(|at| &at.inverse)
    }

    #[inline]
    pub(super) fn transfers(&self) -> bool {
        !self.transfer.is_empty()
    }

    /// `ad*_(P Omega) H` at the centre.
    pub(super) fn transfer(&self, momentum: &G::Vector) -> G::Vector {
        let h = momentum.components();
        let term = |([a, b], value): &([usize; 2], f64)| value * h[*a] * h[*b];
        let row = |i: usize| self.transfer.get(i).map_or(0.0, |row| row.iter().map(term).sum());
        G::Vector::from_fn(h.len(), row)
    }

    pub(super) fn sizes(&self) -> Sizes {
        self.sizes
    }
}

/// What is left of an inertia that turns and translations share, relative to the whole, is rounding.
const SHARED: f64 = 1e-12;

/// `None` where turns and translations share no inertia at the origin of the body, or share some at every point.
///
/// With `c = exp(r)`, `Ad_c x = x + [r, x]`, so the translation `r` to the centre solves `J([r, x], v) = -J(x, v)` for all
/// turns `x` and translations `v`.
fn at_centre<G: LieGroup>(group: &G, metric: &Matrix<G::Vector>) -> Option<AtCentre<G>> {
    let n = group.dimension();
    let basis = group.basis();
    let translations: Vec<G::Vector> =
        basis.iter().map(|e| group.translation(e)).collect::<Option<_>>()?;
    let turns: Vec<G::Vector> =
        basis.iter().zip(&translations).map(|(e, v)| e.clone() - v.clone()).collect();
    let form = |x: &G::Vector, y: &G::Vector| -> f64 {
        metric.apply(x).components().iter().zip(y.components()).map(|(p, y)| p * y).sum()
    };
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (0..n).map(move |k| (i, k))).collect();
    let shared = pairs.iter().map(|&(i, k)| -form(&turns[i], &translations[k]));
    let shared = DVector::from_iterator(n * n, shared);
    if shared.amax() == 0.0 {
        return None;
    }
    let entry = |row: usize, column: usize| {
        let (i, k) = pairs[row];
        form(&group.bracket(&translations[column], &turns[i]), &translations[k])
    };
    let matrix = DMatrix::from_fn(n * n, n, entry);
    let shares = least_squares(&matrix, &shared);
    let terms = shared.amax().max(matrix.amax() * shares.amax());
    if (&matrix * &shares - &shared).amax() > SHARED * terms {
        return None;
    }
    let zero = G::Vector::zeros(n);
    let way = shares.iter().zip(&translations).fold(zero, |sum, (s, v)| sum + v.clone() * *s);
    let centre = group.exp(&way);
    let moved: Vec<G::Vector> = basis.iter().map(|e| group.adjoint(&centre, e)).collect();
    let image = |x: &G::Vector| {
        let terms = x.components().iter().zip(&moved);
        terms.fold(G::Vector::zeros(n), |sum, (share, image)| sum + image.clone() * *share)
    };
    let images: Vec<G::Vector> = turns.iter().map(image).collect();
    // what turns and translations share there is rounding, and translations stay what they are
    let inertia = DMatrix::from_fn(n, n, |i, k| {
        form(&images[i], &images[k]) + form(&translations[i], &translations[k])
    });
    let inverse = inertia.clone().try_inverse()?;
    let rows = |m: &DMatrix<f64>| {
        let row = |i| G::Vector::from_fn(n, |k| 0.5 * (m[(i, k)] + m[(k, i)]));
        Matrix::Full((0..n).map(row).collect())
    };
    Some(AtCentre { centre, inertia: rows(&inertia), inverse: rows(&inverse) })
}

/// A sum of two terms of which less is left, relative to both, is their rounding.
const CANCELLED: f64 = 4.0 * f64::EPSILON;

/// The coefficients of `ad*_(P J^-1 H) H`: of `H_a H_b` in the component `i`, `(P J^-1)^vb c^a_vi`, symmetric in `a` and `b`.
fn transfer<G: LieGroup>(
    group: &G,
    inverse: &Matrix<G::Vector>,
    structure: &Tensor<f64>,
) -> Vec<Vec<([usize; 2], f64)>> {
    let n = group.dimension();
    let translations: Option<Vec<G::Vector>> =
        (0..n).map(|b| group.translation(&inverse.apply(&group.unit(b)))).collect();
    let Some(translations) = translations else { return vec![] };
    // by a <= b: the sum of both orders, and of their sizes
    let mut sums: Vec<BTreeMap<[usize; 2], (f64, f64)>> = vec![BTreeMap::new(); n];
    for (at, c) in structure.components() {
        let [a, v, i] = [at[0], at[1], at[2]];
        for (b, translation) in translations.iter().enumerate() {
            let term = translation.components()[v] * c;
            let (sum, size) = sums[i].entry([a.min(b), a.max(b)]).or_default();
            (*sum, *size) = (*sum + term, *size + term.abs());
        }
    }
    let left = |([a, b], (sum, size)): ([usize; 2], (f64, f64))| {
        (sum.abs() > CANCELLED * size).then_some(([a, b], sum))
    };
    let rows: Vec<Vec<_>> =
        sums.into_iter().map(|row| row.into_iter().filter_map(left).collect()).collect();
    if rows.iter().all(Vec::is_empty) { vec![] } else { rows }
}

/// The largest moments of inertia of the basis along turns, and along translations.
fn sizes<G: LieGroup>(group: &G, metric: &Matrix<G::Vector>) -> Sizes {
    let moment = |x: &G::Vector| -> f64 {
        let products = x.components().iter().zip(metric.apply(x).components().to_vec());
        products.map(|(x, p)| x * p).sum::<f64>().abs()
    };
    let mut inertia = [0.0_f64; 2];
    for unit in group.basis() {
        let translation = group.translation(&unit);
        let turn = translation.as_ref().map_or(unit.clone(), |part| unit - part.clone());
        inertia[0] = inertia[0].max(moment(&turn));
        inertia[1] = inertia[1].max(translation.as_ref().map_or(0.0, &moment));
    }
    let gyration = (inertia[0] / inertia[1]).sqrt();
    let length = if gyration.is_finite() && gyration > 0.0 { gyration } else { 1.0 };
    Sizes { inertia, length }
}
