//! Gates of two qubits: local gates and Weyl coordinates.
//!
//! In the magic basis, local gates `A (x) B` of `SU(2) x SU(2)` are the real matrices `SO(4)`, and
//! the matrices of `XX`, `YY` and `ZZ` are diagonal. So the factorization of `SU(4)/SO(4)` writes
//! a gate as `e^(i phase) (A1 (x) B1) exp(i (c1 XX + c2 YY + c3 ZZ)) (A2 (x) B2)` (N. Khaneja,
//! R. Brockett and S. J. Glaser, Phys. Rev. A 63 (2001) 032308; B. Kraus and J. I. Cirac, Phys.
//! Rev. A 63 (2001) 062309). Shifts by `pi/2`, permutations and pairs of signs of the coordinates
//! are local gates. They lead to the chamber `pi/4 >= c1 >= c2 >= |c3|`, with `c3 >= 0` if
//! `c1 = pi/4` (J. Zhang, J. Vala, S. Sastry and K. B. Whaley, Phys. Rev. A 67 (2003) 042313).

use super::{Kak, SymmetricPair, exceeds, expect_finite};
use crate::Error;
use crate::group::matrices::{TOLERANCE, expect_shape};
use nalgebra::{Complex, DMatrix, Matrix2, Matrix4};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4};

type Gate = Matrix2<Complex<f64>>;
type Gates = Matrix4<Complex<f64>>;

const I: Complex<f64> = Complex::I;

/// A gate of two qubits as local gates and Weyl coordinates.
///
/// ```
/// use affinor::group::kak::two_qubit::TwoQubitKak;
/// use nalgebra::{Complex, DMatrix};
/// use std::f64::consts::FRAC_PI_4;
/// let rows = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0., 1., 0., 0., 1., 0.];
/// let cnot = DMatrix::from_row_slice(4, 4, &rows).map(|x| Complex::new(x, 0.0));
/// let [c1, c2, c3] = TwoQubitKak::new(&cnot)?.coordinates();
/// assert!((c1 - FRAC_PI_4).abs() < 1e-15 && c2.abs() < 1e-15 && c3.abs() < 1e-15);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Weyl chamber", "magic basis", "canonical gate"))]
#[derive(Clone, Debug, PartialEq)]
pub struct TwoQubitKak {
    phase: f64,
    left: [Gate; 2],
    right: [Gate; 2],
    coordinates: [f64; 3],
    residual: f64,
}

impl TwoQubitKak {
    /// Factors a unitary matrix in the basis `|00>, |01>, |10>, |11>`.
    ///
    /// # Errors
    /// [`Error::Shape`] for a matrix that is not 4 by 4, [`Error::NotFinite`], and
    /// [`Error::Invalid`] with the defect for a matrix that is not unitary up to `1e-6`.
    pub fn new(g: &DMatrix<Complex<f64>>) -> Result<Self, Error> {
        expect_shape_of_gate(g)?;
        expect_finite(g)?;
        let gate = Gates::from_iterator(g.iter().copied());
        let defect = (gate.adjoint() * gate - Gates::identity()).norm();
        if exceeds(defect, TOLERANCE) {
            let reason = format!("the equation g^* g = 1 is off by {defect:e}");
            return Err(Error::Invalid { what: "gate", reason });
        }
        let phase = gate.determinant().arg() / 4.0;
        let magic = magic();
        let inner = magic.adjoint() * gate * magic * Complex::cis(-phase);
        let pair: SymmetricPair = "SU(4)/SO(4)".parse()?;
        let kak = Kak::new(&pair, &DMatrix::from_column_slice(4, 4, inner.as_slice()))?;
        let fixed = |m: &DMatrix<Complex<f64>>| Gates::from_iterator(m.iter().copied());
        let x = kak.coordinates();
        let mut chamber = Chamber {
            left: magic * fixed(kak.k1()) * magic.adjoint(),
            right: magic * fixed(kak.k2()) * magic.adjoint(),
            // the eigenvalues of XX, YY, ZZ on the magic basis: + - +, + + -, - - -, - + +
            c: [0.5 * (x[0] + x[1]), 0.5 * (x[1] + x[3]), 0.5 * (x[0] + x[3])],
            phase,
        };
        chamber.reduce();
        let (left, first) = local(&chamber.left);
        let (right, second) = local(&chamber.right);
        let phase = (Complex::cis(chamber.phase) * first * second).arg();
        let mut found = TwoQubitKak { phase, left, right, coordinates: chamber.c, residual: 0.0 };
        found.residual = (found.product() - gate).norm();
        Ok(found)
    }

    /// The global phase, in radians.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// The local gates `A1, B1` of SU(2) that act last.
    pub fn left(&self) -> &[Gate; 2] {
        &self.left
    }

    /// The local gates `A2, B2` of SU(2) that act first.
    pub fn right(&self) -> &[Gate; 2] {
        &self.right
    }

    /// The Weyl coordinates `c1, c2, c3` in radians.
    pub fn coordinates(&self) -> [f64; 3] {
        self.coordinates
    }

    /// The Frobenius norm of the product less the gate.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    fn product(&self) -> Gates {
        let [a1, b1] = &self.left;
        let [a2, b2] = &self.right;
        a1.kronecker(b1) * canonical(self.coordinates) * a2.kronecker(b2) * Complex::cis(self.phase)
    }
}

/// The canonical gate `exp(i (c1 XX + c2 YY + c3 ZZ))`.
pub fn canonical([c1, c2, c3]: [f64; 3]) -> Matrix4<Complex<f64>> {
    let angles = [c1 - c2 + c3, c1 + c2 - c3, -c1 - c2 - c3, -c1 + c2 + c3];
    let magic = magic();
    magic * Gates::from_diagonal(&angles.map(Complex::cis).into()) * magic.adjoint()
}

/// The magic basis, as columns.
fn magic() -> Gates {
    let (o, r) = (Complex::ZERO, Complex::new(FRAC_1_SQRT_2, 0.0));
    let i = r * I;
    Gates::from_row_slice(&[r, o, o, i, o, i, r, o, o, i, -r, o, r, o, o, -i])
}

/// The Pauli matrices.
fn pauli(k: usize) -> Gate {
    let (o, r) = (Complex::ZERO, Complex::ONE);
    match k {
        0 => Gate::new(o, r, r, o),
        1 => Gate::new(o, -I, I, o),
        _ => Gate::new(r, o, o, -r),
    }
}

/// Coordinates with `e^(i phase) left exp(i (c1 XX + c2 YY + c3 ZZ)) right` equal to the gate.
struct Chamber {
    left: Gates,
    right: Gates,
    c: [f64; 3],
    phase: f64,
}

/// Coordinates that are nearer to `pi/4` are equal to it up to rounding errors.
const FACE: f64 = 1e-13;

impl Chamber {
    fn reduce(&mut self) {
        for k in 0..3 {
            self.shift(k, (self.c[k] / FRAC_PI_2).round());
        }
        for (k, l) in [(0, 1), (1, 2), (0, 1)] {
            if self.c[k].abs() < self.c[l].abs() {
                self.exchange(k, l);
            }
        }
        match (self.c[0] < 0.0, self.c[1] < 0.0) {
            (true, true) => self.negate(0, 1),
            (true, false) => self.negate(0, 2),
            (false, true) => self.negate(1, 2),
            _ => {}
        }
        if self.c[0] > FRAC_PI_4 - FACE && self.c[2] < 0.0 {
            self.shift(0, 1.0);
            self.negate(0, 2);
        }
    }

    /// Subtracts `turns pi/2` from a coordinate: `exp(i pi/2 XX) = i XX`.
    fn shift(&mut self, k: usize, turns: f64) {
        self.c[k] -= turns * FRAC_PI_2;
        self.phase += turns * FRAC_PI_2;
        if turns.rem_euclid(2.0) == 1.0 {
            self.left *= pauli(k).kronecker(&pauli(k));
        }
    }

    /// Exchanges two coordinates by the gate `(X + Y)/sqrt(2)` on both qubits.
    fn exchange(&mut self, k: usize, l: usize) {
        self.c.swap(k, l);
        let gate = (pauli(k) + pauli(l)).scale(FRAC_1_SQRT_2);
        self.conjugate(gate.kronecker(&gate));
    }

    /// Negates two coordinates by a Pauli matrix on the first qubit.
    fn negate(&mut self, k: usize, l: usize) {
        self.c[k] = -self.c[k];
        self.c[l] = -self.c[l];
        self.conjugate(pauli(3 - k - l).kronecker(&Gate::identity()));
    }

    /// Multiplies both sides by a Hermitian gate, whose square is 1.
    fn conjugate(&mut self, gate: Gates) {
        self.left *= gate;
        self.right = gate * self.right;
    }
}

/// The factors of SU(2) of a local gate, and its phase.
fn local(m: &Gates) -> ([Gate; 2], Complex<f64>) {
    let block = |i: usize, j: usize| -> Gate { m.fixed_view::<2, 2>(2 * i, 2 * j).into_owned() };
    let places = [(0, 0), (0, 1), (1, 0), (1, 1)];
    let largest =
        places.into_iter().max_by(|a, b| block(a.0, a.1).norm().total_cmp(&block(b.0, b.1).norm()));
    let (i, j) = largest.unwrap_or((0, 0));
    let (b, _) = special(&block(i, j));
    let a = Gate::from_fn(|i, j| (b.adjoint() * block(i, j)).trace() * 0.5);
    let (a, phase) = special(&a);
    ([a, b], phase)
}

/// The nearest matrix of SU(2) to a multiple of such a matrix, and the phase of the multiple.
fn special(m: &Gate) -> (Gate, Complex<f64>) {
    let phase = m.determinant().sqrt();
    let phase = phase.unscale(phase.norm());
    let m = m * phase.conj();
    let (a, b) = ((m[(0, 0)] + m[(1, 1)].conj()) * 0.5, (m[(0, 1)] - m[(1, 0)].conj()) * 0.5);
    let norm = a.norm().hypot(b.norm());
    let (a, b) = (a.unscale(norm), b.unscale(norm));
    (Gate::new(a, b, -b.conj(), a.conj()), phase)
}

fn expect_shape_of_gate(g: &DMatrix<Complex<f64>>) -> Result<(), Error> {
    expect_shape(&g.map(|value| value.re), (4, 4))
}
