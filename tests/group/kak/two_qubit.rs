//! Weyl coordinates of published gates (J. Zhang, J. Vala, S. Sastry, K. B. Whaley, Phys. Rev. A 67
//! (2003) 042313 and Phys. Rev. Lett. 93 (2004) 020502), and factorizations of random gates.

use super::{Matrix, Random, assert_near, exp};
use affinor::group::kak::two_qubit::{TwoQubitKak, canonical};
use nalgebra::{Complex, DMatrix, Matrix2};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, FRAC_PI_8, PI};

const O: Complex<f64> = Complex::ZERO;
const R: Complex<f64> = Complex::ONE;
const I: Complex<f64> = Complex::I;

fn unitary(random: &mut Random, n: usize) -> Matrix {
    let x = random.matrix(n);
    let g = exp(&(&x - x.adjoint()));
    let three = Matrix::identity(n, n).scale(3.0);
    &g * (three - g.adjoint() * &g).scale(0.5)
}

fn dense(m: &Matrix2<Complex<f64>>) -> Matrix {
    DMatrix::from_column_slice(2, 2, m.as_slice())
}

fn canonical_gate(c: [f64; 3]) -> Matrix {
    DMatrix::from_column_slice(4, 4, canonical(c).as_slice())
}

/// Checks all claims of a factorization.
fn factor(g: &Matrix) -> TwoQubitKak {
    let kak = TwoQubitKak::new(g).unwrap();
    for gate in kak.left().iter().chain(kak.right()) {
        assert_near(&dense(&(gate.adjoint() * gate)), &Matrix::identity(2, 2), 1e-15, "unitary");
        assert!((gate.determinant() - R).norm() < 1e-15);
    }
    let [left, right] = [kak.left(), kak.right()].map(|[a, b]| dense(a).kronecker(&dense(b)));
    let c = kak.coordinates();
    let product = left * canonical_gate(c) * right * Complex::cis(kak.phase());
    assert_near(&product, g, 2e-14, "product");
    assert!((kak.residual() - (product - g).norm()).abs() < 1e-14);
    assert!(c[0] <= FRAC_PI_4 + 1e-13 && c[0] >= c[1] && c[1] >= c[2].abs(), "{c:?}");
    assert!(c[0] < FRAC_PI_4 - 1e-13 || c[2] >= 0.0, "{c:?}");
    kak
}

fn expect(g: &Matrix, expected: [f64; 3], name: &str) {
    for (found, c) in factor(g).coordinates().into_iter().zip(expected) {
        assert!((found - c).abs() < 4e-15, "{name}: {found} {c}");
    }
}

/// The canonical gate is the exponential of the products of Pauli matrices.
#[test]
fn canonical_gates_are_exponentials() {
    let paulis = [[O, R, R, O], [O, -I, I, O], [R, O, O, -R]];
    let products = paulis.map(|rows| {
        let pauli = Matrix::from_row_slice(2, 2, &rows);
        pauli.kronecker(&pauli)
    });
    let c = [0.3, -0.7, 1.1];
    let x: Matrix = products.iter().zip(c).map(|(m, c)| m * Complex::new(0.0, c)).sum();
    assert_near(&canonical_gate(c), &exp(&x), 1e-13, "canonical");
}

#[test]
fn published_gates() {
    let gate = |rows: [Complex<f64>; 16]| Matrix::from_row_slice(4, 4, &rows);
    let h = Complex::new(0.5, 0.5);
    let k = h.conj();
    let cnot = gate([R, O, O, O, O, R, O, O, O, O, O, R, O, O, R, O]);
    let controlled_z = gate([R, O, O, O, O, R, O, O, O, O, R, O, O, O, O, -R]);
    let swap = gate([R, O, O, O, O, O, R, O, O, R, O, O, O, O, O, R]);
    let iswap = gate([R, O, O, O, O, O, I, O, O, I, O, O, O, O, O, R]);
    // the singlet has the eigenvalue -i; of the other root, its adjoint, i
    let root_of_swap = gate([R, O, O, O, O, k, h, O, O, h, k, O, O, O, O, R]);
    let s = Complex::new(FRAC_1_SQRT_2, 0.0);
    let root_of_iswap = gate([R, O, O, O, O, s, s * I, O, O, s * I, s, O, O, O, O, R]);
    let fourier = Matrix::from_fn(4, 4, |i, j| Complex::cis(PI / 2.0 * (i * j) as f64) * 0.5);
    let q = FRAC_PI_4;
    let e = FRAC_PI_8;
    let gates: [(&str, &Matrix, [f64; 3]); 8] = [
        ("identity", &Matrix::identity(4, 4), [0.0; 3]),
        ("CNOT", &cnot, [q, 0.0, 0.0]),
        ("CZ", &controlled_z, [q, 0.0, 0.0]),
        ("SWAP", &swap, [q, q, q]),
        ("iSWAP", &iswap, [q, q, 0.0]),
        ("sqrt(SWAP)", &root_of_swap, [e, e, e]),
        ("sqrt(iSWAP)", &root_of_iswap, [e, e, 0.0]),
        // the Fourier transform of two qubits is between iSWAP and SWAP
        ("QFT", &fourier, [q, q, e]),
    ];
    let mut random = Random(77);
    for (name, gate, c) in gates {
        expect(gate, c, name);
        // local gates and phases do not change the coordinates
        let local = |random: &mut Random| unitary(random, 2).kronecker(&unitary(random, 2));
        for _ in 0..20 {
            let dressed = local(&mut random) * gate * local(&mut random);
            expect(&dressed, c, name);
        }
    }
    // the inverse of sqrt(SWAP) is another class
    expect(&root_of_swap.adjoint(), [e, e, -e], "sqrt(SWAP)^-1");
    // the B gate is exp(i pi/4 (XX + YY/2))
    expect(&canonical_gate([q, e, 0.0]), [q, e, 0.0], "B");
    // all local gates
    expect(&Matrix::identity(4, 4).scale(-1.0), [0.0; 3], "-1");
}

#[test]
fn random_and_degenerate_gates() {
    let mut random = Random(3);
    for _ in 0..200 {
        factor(&unitary(&mut random, 4));
    }
    let special = [
        0.0,
        1e-16,
        1e-12,
        1e-8,
        FRAC_PI_8,
        FRAC_PI_4,
        FRAC_PI_4 - 1e-9,
        FRAC_PI_4 - 1e-15,
        0.3,
        PI / 2.0,
        -0.3,
    ];
    for (i, a) in special.iter().enumerate() {
        for b in special.iter().skip(i % 2) {
            for c in special {
                let [left, right] =
                    [0, 1].map(|_| unitary(&mut random, 2).kronecker(&unitary(&mut random, 2)));
                factor(&(left * canonical_gate([*a, *b, c]) * right));
                factor(&canonical_gate([*a, *b, c]));
            }
        }
    }
}

/// All gates that permute the states with signs.
#[test]
fn permutations_of_states() {
    for code in 0..256 {
        let images = [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6];
        let mut sorted = images;
        sorted.sort_unstable();
        if sorted == [0, 1, 2, 3] {
            let sign = |j: usize| if (code * 7 + 3) >> j & 1 == 1 { -R } else { R };
            factor(&Matrix::from_fn(4, 4, |i, j| if images[j] == i { sign(j) } else { O }));
        }
    }
}

#[test]
fn bad_gates() {
    let message = |g: &Matrix| TwoQubitKak::new(g).unwrap_err().to_string();
    assert!(message(&Matrix::identity(3, 3)).contains("4 rows and 4 columns"));
    assert!(message(&Matrix::identity(4, 4).scale(2.0)).contains("g^* g = 1 is off by 6e0"));
    let mut bad = Matrix::identity(4, 4);
    bad[(1, 2)] = Complex::new(f64::NAN, 0.0);
    assert!(TwoQubitKak::new(&bad).is_err());
}
