//! Groups of matrices in floats, for what the paper says of exponentials.

use affinor::LieAlgebra;
use affinor_tensors::Rational;
use nalgebra::{DMatrix, DVector};

/// A basis of an algebra as matrices, in the order of the tables in `main.rs`.
pub struct Basis(pub Vec<DMatrix<f64>>);

fn units(size: usize, matrices: &[&[(usize, usize, f64)]]) -> Basis {
    let matrix = |entries: &&[(usize, usize, f64)]| {
        let mut matrix = DMatrix::zeros(size, size);
        entries.iter().for_each(|&(i, j, v)| matrix[(i - 1, j - 1)] = v);
        matrix
    };
    Basis(matrices.iter().map(matrix).collect())
}

pub fn so3() -> Basis {
    units(
        3,
        &[&[(2, 3, -1.0), (3, 2, 1.0)], &[(1, 3, 1.0), (3, 1, -1.0)], &[(1, 2, -1.0), (2, 1, 1.0)]],
    )
}

pub fn sl2() -> Basis {
    units(2, &[&[(1, 1, 1.0), (2, 2, -1.0)], &[(1, 2, 1.0)], &[(2, 1, 1.0)]])
}

pub fn se2() -> Basis {
    units(3, &[&[(1, 2, -1.0), (2, 1, 1.0)], &[(1, 3, 1.0)], &[(2, 3, 1.0)]])
}

/// Rotations, then translations, of space as homogeneous matrices.
pub fn se3() -> Basis {
    units(
        4,
        &[
            &[(2, 3, -1.0), (3, 2, 1.0)],
            &[(1, 3, 1.0), (3, 1, -1.0)],
            &[(1, 2, -1.0), (2, 1, 1.0)],
            &[(1, 4, 1.0)],
            &[(2, 4, 1.0)],
            &[(3, 4, 1.0)],
        ],
    )
}

pub fn heisenberg() -> Basis {
    units(3, &[&[(1, 2, 1.0)], &[(2, 3, 1.0)], &[(1, 3, 1.0)]])
}

pub fn affine() -> Basis {
    units(2, &[&[(1, 1, 1.0)], &[(1, 2, 1.0)]])
}

/// Algebras with the matrices of their tables.
pub fn represented() -> [(&'static str, LieAlgebra<Rational>, Basis); 5] {
    [
        ("so(3)", crate::paper::so3(), so3()),
        ("sl(2)", crate::paper::sl2(), sl2()),
        ("se(2)", crate::paper::se2(), se2()),
        ("heisenberg(3)", crate::paper::heisenberg(), heisenberg()),
        ("aff(1)", crate::paper::affine(), affine()),
    ]
}

impl Basis {
    pub fn combine(&self, x: &[f64]) -> DMatrix<f64> {
        let size = self.0[0].nrows();
        self.0.iter().zip(x).fold(DMatrix::zeros(size, size), |sum, (e, x)| sum + e * *x)
    }

    /// The components of a matrix of the algebra, by its inner products with the basis.
    pub fn components(&self, matrix: &DMatrix<f64>) -> DVector<f64> {
        let gram = DMatrix::from_fn(self.0.len(), self.0.len(), |i, j| self.0[i].dot(&self.0[j]));
        let products = DVector::from_iterator(self.0.len(), self.0.iter().map(|e| e.dot(matrix)));
        gram.try_inverse().unwrap() * products
    }

    /// The matrix of `u -> g u h` in components.
    pub fn conjugation(&self, g: &DMatrix<f64>, h: &DMatrix<f64>) -> DMatrix<f64> {
        let columns: Vec<_> = self.0.iter().map(|e| self.components(&(g * e * h))).collect();
        DMatrix::from_columns(&columns)
    }
}

pub fn inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    matrix.clone().try_inverse().unwrap()
}

/// The rotation about a unit vector by Rodrigues' formula with the half angle.
pub fn rodrigues(n: [f64; 3], angle: f64) -> DMatrix<f64> {
    let spin = so3().combine(&n);
    let half = (angle / 2.0).sin();
    DMatrix::identity(3, 3) + &spin * angle.sin() + &spin * &spin * (2.0 * half * half)
}

#[track_caller]
pub fn assert_close(found: &DMatrix<f64>, expected: &DMatrix<f64>, what: &str) {
    let distance = (found - expected).abs().max();
    let scale = expected.abs().max().max(1.0);
    assert!(distance < 1e-13 * scale, "{what}: {distance:e}\n{found}{expected}");
}
