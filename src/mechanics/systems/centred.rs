//! The inertia about the centre, where rotations and translations are decoupled.

use super::bilinear::{Bilinear, Layers};
use super::cotangent::Sizes;
use super::matrix::Matrix;
use crate::group::{Coordinates, TranslationSplit};
use crate::numerics::least_squares::least_squares;
use affinor_tensors::Tensor;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// An inertia on a group with translations. It refers to the centre.
#[derive(Clone, Debug)]
pub(in crate::mechanics) struct Centred<V, E> {
    /// The inertia about the centre; `None` if the centre is the origin of the body.
    at: Option<AtCentre<V, E>>,
    /// The covector `ad*_(P Omega) H` as a quadratic form of `H`. Terms that cancel for every
    /// momentum, such as the terms of an isotropic mass, are omitted, because their rounding errors
    /// would act as a torque.
    transfer: Layers<V>,
    sizes: Sizes,
}

/// The inertia `J(Ad_c x, Ad_c y)` about the centre.
#[derive(Clone, Debug)]
struct AtCentre<V, E> {
    /// The translation `c` to the centre.
    centre: E,
    inertia: Matrix<V>,
    inverse: Matrix<V>,
}

impl<V: Coordinates, E> Centred<V, E> {
    /// Computes the centre from the inertia, its inverse and the structure constants of the group.
    pub(in crate::mechanics) fn new(
        group: &impl TranslationSplit<Vector = V, Element = E>,
        metric: &Matrix<V>,
        inverse: &Matrix<V>,
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
    pub(in crate::mechanics) fn centre(&self) -> Option<&E> {
        self.at.as_ref().map(|at| &at.centre)
    }

    /// The inverse of the inertia at the centre, if the centre is not the origin.
    #[inline]
    pub(in crate::mechanics) fn inverse(&self) -> Option<&Matrix<V>> {
        self.at.as_ref().map(|at| &at.inverse)
    }

    #[inline]
    pub(in crate::mechanics) fn transfers(&self) -> bool {
        !self.transfer.is_zero()
    }

    /// The covector `ad*_(P Omega) H` at the centre.
    #[inline]
    pub(in crate::mechanics) fn transfer(&self, momentum: &V) -> V {
        self.transfer.apply(momentum, momentum)
    }

    pub(in crate::mechanics) fn sizes(&self) -> Sizes {
        self.sizes
    }
}

/// If the coupling of rotations and translations, relative to the inertia, is at most this value,
/// it counts as rounding error.
const SHARED: f64 = 1e-12;

/// Computes the inertia about the centre. Returns `None` if rotations and translations are
/// decoupled at the origin of the body, or if they are coupled at every point.
///
/// If `c = exp(r)`, then `Ad_c x = x + [r, x]`. Therefore, the translation `r` to the centre solves
/// `J([r, x], v) = -J(x, v)` for all rotations `x` and translations `v`.
fn at_centre<G: TranslationSplit>(
    group: &G,
    metric: &Matrix<G::Vector>,
) -> Option<AtCentre<G::Vector, G::Element>> {
    let n = group.dimension();
    let basis = group.basis();
    let translations: Vec<G::Vector> =
        basis.iter().map(|e| group.translational_part(e)).collect::<Option<_>>()?;
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
    // omits the coupling, which is only rounding error; the inertia of translations is unchanged
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

/// If a sum of terms is smaller than this value, relative to the magnitudes of the terms, it counts
/// as rounding error.
const CANCELLED: f64 = 4.0 * f64::EPSILON;

/// The quadratic form `ad*_(P J^-1 H) H`. In the component `i`, the coefficient of `H_a H_b` with
/// `a <= b` is `(P J^-1)^vb c^a_vi`, symmetrized.
fn transfer<G: TranslationSplit>(
    group: &G,
    inverse: &Matrix<G::Vector>,
    structure: &Tensor<f64>,
) -> Layers<G::Vector> {
    let n = group.dimension();
    let translations: Option<Vec<G::Vector>> =
        (0..n).map(|b| group.translational_part(&inverse.apply(&group.basis_vector(b)))).collect();
    let Some(translations) = translations else { return Layers::default() };
    // for a <= b, the sum over both orders of the indices, and the sum of the magnitudes
    let mut sums: Vec<BTreeMap<[usize; 2], (f64, f64)>> = vec![BTreeMap::new(); n];
    for (at, c) in structure.components() {
        let [a, v, i] = [at[0], at[1], at[2]];
        for (b, translation) in translations.iter().enumerate() {
            let term = translation.components()[v] * c;
            let (sum, size) = sums[i].entry([a.min(b), a.max(b)]).or_default();
            (*sum, *size) = (*sum + term, *size + term.abs());
        }
    }
    let terms = sums.into_iter().enumerate().flat_map(|(i, row)| {
        let sums = row.into_iter().filter(|(_, (sum, size))| sum.abs() > CANCELLED * size);
        sums.map(move |(at, (sum, _))| (i, at, sum))
    });
    Bilinear::new(n, terms).layers()
}

/// The largest moment of inertia of a rotational basis vector, and the largest mass of a
/// translational basis vector.
fn sizes<G: TranslationSplit>(group: &G, metric: &Matrix<G::Vector>) -> Sizes {
    let moment = |x: &G::Vector| -> f64 {
        let products = x.components().iter().zip(metric.apply(x).components().to_vec());
        products.map(|(x, p)| x * p).sum::<f64>().abs()
    };
    let mut inertia = [0.0_f64; 2];
    for unit in group.basis() {
        let translation = group.translational_part(&unit);
        let turn = translation.as_ref().map_or(unit.clone(), |part| unit - part.clone());
        inertia[0] = inertia[0].max(moment(&turn));
        inertia[1] = inertia[1].max(translation.as_ref().map_or(0.0, &moment));
    }
    let gyration = (inertia[0] / inertia[1]).sqrt();
    let length = if gyration.is_finite() && gyration > 0.0 { gyration } else { 1.0 };
    Sizes { inertia, length }
}
