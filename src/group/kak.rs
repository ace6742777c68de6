//! Factorizations `g = k1 a k2` of elements of classical groups, for symmetric pairs.
//!
//! An involution `theta` of a compact or real reductive group `G` has the group `K` of fixed points.
//! Each element of `G` is a product of `k1` and `k2` in `K` and `a = exp(X)`. Here `X` is in a
//! maximal abelian subspace of `p = {X: theta(X) = -X}` (S. Helgason, *Differential Geometry, Lie
//! Groups, and Symmetric Spaces*, V.6 and IX.1; A. W. Knapp, *Lie Groups Beyond an Introduction*,
//! VII.3). Special cases are the singular value decomposition (`GL(n,F)`), the cosine-sine
//! decomposition (`U(p+q)/U(p)xU(q)`), the factorization of Takagi (`U(n)/O(n)`) and, in
//! [`two_qubit`], the Weyl coordinates of a quantum gate.
//!
//! All factors are accurate up to rounding errors, also if coordinates are equal or singular.

mod compact;
mod flat;
mod name;
mod pair;
mod polar;
mod structure;
pub mod two_qubit;

pub use pair::SymmetricPair;

use super::matrices::TOLERANCE;
use crate::Error;
use nalgebra::{Complex, DMatrix};
use pair::Kind;
use structure::{Matrix, Structure};

/// A factorization `g = k1 a k2` of an element of a symmetric pair.
///
/// The coordinates `x` of `a` are in a Weyl chamber:
/// - SU(n)/SO(n), SU(2n)/Sp(n): `x_1 >= ... >= x_n >= x_1 - pi`, with the sum 0; for U(n)/O(n) and
///   U(2n)/Sp(n), `pi/2 >= x_1 >= ... >= x_n >= -pi/2`;
/// - other compact pairs: `pi/2 >= x_1 >= ... >= x_r >= 0`, and for SO(2p)/S(O(p)xO(p))
///   `x_(p-1) >= |x_p|`;
/// - GL(n,F), SL(n,F): `x_1 >= ... >= x_n`, the logarithms of the singular values;
/// - other noncompact groups: `x_1 >= ... >= x_r >= 0`, and for SO(p,p) `x_(p-1) >= |x_p|`.
///
/// Inequalities hold up to rounding errors of angles.
///
/// ```
/// use affinor::group::kak::Kak;
/// use nalgebra::{Complex, DMatrix};
/// let g = DMatrix::from_row_slice(2, 2, &[0.6, -0.8, 0.8, 0.6]).map(|x| Complex::new(x, 0.0));
/// let kak = Kak::new(&"SO(2)/S(O(1)xO(1))".parse()?, &g)?;
/// assert!((kak.coordinates()[0].abs() - 0.8_f64.asin()).abs() < 1e-15);
/// assert!(kak.residual() < 1e-15);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("KAK decomposition", "Cartan decomposition", "cosine-sine decomposition", "Takagi"))]
#[derive(Clone, Debug, PartialEq)]
pub struct Kak {
    pair: SymmetricPair,
    k1: Matrix,
    a: Matrix,
    k2: Matrix,
    coordinates: Vec<f64>,
    residual: f64,
}

impl Kak {
    /// Factors an element of `G`, given as a square complex matrix. Real groups have matrices with
    /// imaginary parts zero.
    ///
    /// # Errors
    /// [`Error::Shape`] for a wrong size, [`Error::NotFinite`] for an entry that is not finite,
    /// [`Error::Invalid`] with the defect for a matrix that is not in the group up to `1e-6`.
    pub fn new(pair: &SymmetricPair, g: &DMatrix<Complex<f64>>) -> Result<Self, Error> {
        expect_size(pair, g)?;
        expect_finite(g)?;
        let inner = pair.inside(g);
        expect_element(pair, &inner)?;
        let ambient = pair.ambient().project(&inner);
        let (k1, coordinates, k2) = if pair.is_compact() {
            let (k1, coordinates) = compact::factor(pair, &ambient);
            let rest = pair.exponential(&coordinates).adjoint() * k1.adjoint() * &ambient;
            let mut k2 = orthonormal(pair.structure(), &rest);
            if pair.is_special && !pair.structure().is_real && !pair.structure().is_paired {
                // the determinant of g may differ from 1 by rounding errors
                let turn = k2.clone().determinant().arg() / pair.size() as f64;
                k2 *= Complex::cis(-turn);
            }
            (k1, coordinates, k2)
        } else {
            polar::factor(pair, &ambient).map_err(not_special)?
        };
        let a = pair.exponential(&coordinates);
        // scaling avoids overflow and underflow of squares
        let scale = inner.camax().max(f64::MIN_POSITIVE);
        let residual = (&k1 * &a * &k2 - &inner).unscale(scale).norm() * scale;
        if exceeds(residual, 1e-5 * scale * pair.size() as f64) {
            let reason = format!("its factorization has the residual {residual:e}");
            return Err(Error::Invalid { what: "element of the group", reason });
        }
        let [k1, a, k2] = [k1, a, k2].map(|m| pair.outside(&m));
        Ok(Kak { pair: *pair, k1, a, k2, coordinates, residual })
    }

    /// The symmetric pair.
    pub fn pair(&self) -> &SymmetricPair {
        &self.pair
    }

    /// The left factor, in `K`.
    pub fn k1(&self) -> &DMatrix<Complex<f64>> {
        &self.k1
    }

    /// The factor in the maximal abelian subgroup:
    /// [`SymmetricPair::abelian_exponential`] of the coordinates.
    pub fn a(&self) -> &DMatrix<Complex<f64>> {
        &self.a
    }

    /// The right factor, in `K`.
    pub fn k2(&self) -> &DMatrix<Complex<f64>> {
        &self.k2
    }

    /// The coordinates of `a`: angles in radians for compact groups, logarithms for noncompact ones.
    pub fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    /// The Frobenius norm of `k1 a k2 - g`.
    pub fn residual(&self) -> f64 {
        self.residual
    }
}

/// The element of `K` near a matrix.
fn orthonormal(structure: Structure, m: &Matrix) -> Matrix {
    let m = structure.project(m);
    let columns: Vec<_> = (0..structure.count).map(|j| m.column(j).into_owned()).collect();
    structure.assemble(&structure.orthonormalize(&columns), structure.size())
}

fn expect_size(pair: &SymmetricPair, g: &Matrix) -> Result<(), Error> {
    let n = pair.size();
    if g.shape() == (n, n) {
        return Ok(());
    }
    let [expected, found] =
        [(n, n), g.shape()].map(|(rows, columns)| format!("{rows} rows and {columns} columns"));
    Err(Error::Shape { what: "an element of the group", expected, found })
}

fn expect_finite(g: &Matrix) -> Result<(), Error> {
    let places = (0..g.nrows()).flat_map(|i| (0..g.ncols()).map(move |j| (i, j)));
    for (i, j) in places {
        let value = g[(i, j)];
        if !(value.re.is_finite() && value.im.is_finite()) {
            let value = value.to_string();
            return Err(Error::NotFinite {
                what: "element of the group",
                at: vec![i + 1, j + 1],
                value,
            });
        }
    }
    Ok(())
}

/// Checks that a matrix, in the order of [`SymmetricPair::inside`], satisfies the equations of `G`.
fn expect_element(pair: &SymmetricPair, g: &Matrix) -> Result<(), Error> {
    let refuse = |reason: String| Err(Error::Invalid { what: "element of the group", reason });
    let ambient = pair.ambient();
    let scale = 1.0 + g.camax();
    let defect = (g - ambient.project(g)).camax();
    if defect > TOLERANCE * scale {
        let law = match (ambient.is_real, ambient.is_paired) {
            (true, _) => "is not real",
            _ => "is not quaternionic, with blocks [[a, b], [-conj(b), conj(a)]]",
        };
        return refuse(format!("the matrix {law}: an entry is off by {defect:e}"));
    }
    let one = Matrix::identity(g.nrows(), g.ncols());
    let (name, form) = match pair.kind {
        Kind::Linear(_) => ("", None),
        Kind::Indefinite(_) => ("g^* I g = I", Some(pair.signed_identity())),
        Kind::RealSymplectic => ("g^T J g = J", Some(symplectic_form(g.nrows()))),
        _ => ("g^* g = 1", Some(one)),
    };
    if let Some(form) = form {
        let defect = (g.adjoint() * &form * g - &form).norm();
        if exceeds(defect, TOLERANCE * scale * scale) {
            return refuse(format!("the equation {name} is off by {defect:e}"));
        }
    }
    if matches!(pair.kind, Kind::Indefinite(_)) {
        return Ok(());
    }
    // the condition number bounds the relative rounding error of the determinant
    let scaled = g.unscale(g.camax().max(f64::MIN_POSITIVE));
    let inverse = scaled.clone().try_inverse().map_or(f64::INFINITY, |inverse| inverse.norm());
    let rounding = f64::EPSILON * scaled.norm() * inverse;
    if exceeds(rounding, 0.1) {
        return refuse("the matrix is singular up to rounding errors".into());
    }
    let determinant = g.clone().lu().determinant();
    let defect = (determinant - Complex::ONE).norm();
    if pair.is_special && exceeds(defect, TOLERANCE + 10.0 * rounding) {
        return Err(not_special(determinant));
    }
    Ok(())
}

/// Whether a value exceeds a limit, or is not a number.
fn exceeds(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

fn not_special(determinant: Complex<f64>) -> Error {
    let reason = format!("the determinant is {determinant}, but should be 1");
    Error::Invalid { what: "element of the group", reason }
}

/// The matrix `J = [[0, 1], [-1, 0]]`.
fn symplectic_form(size: usize) -> Matrix {
    let half = size / 2;
    Matrix::from_fn(size, size, |i, j| match (i + half == j, j + half == i) {
        (true, _) => Complex::ONE,
        (_, true) => -Complex::ONE,
        _ => Complex::ZERO,
    })
}
