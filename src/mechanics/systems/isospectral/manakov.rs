//! The free rigid body in n dimensions.

use super::{Isospectral, MatrixState, Symmetry, checked, spectrum};
use crate::Error;
use crate::mechanics::invalid_inertia;
use nalgebra::{Complex, DMatrix};

/// The free rigid body in n dimensions, on so(n). Its equations are `M' = [M, Omega]` and
/// `M = A Omega + Omega A`, with the mass tensor `A = diag(a_1, ..., a_n)`. Therefore,
/// `Omega_ij = M_ij/(a_i + a_j)`.
///
/// `M` is the momentum in body components. With `B = -Omega`, the flow is isospectral. Because
/// `[M, A] = [Omega, A^2]`, the flow is also the isospectral flow of `M + z A^2`, for any number
/// `z`. All [`Manakov::integral`]s are coefficients of the traces of powers of this matrix. S. V.
/// Manakov, *Funct. Anal. Appl.* 10 (1976) 328-329. Methods panic, as nalgebra does, if a matrix
/// does not have the size of `A`.
///
/// ```
/// use affinor::mechanics::systems::isospectral::Manakov;
/// use nalgebra::DMatrix;
/// // in three dimensions the moments are sums of two masses
/// let body = Manakov::new(&[1.0, 2.0, 3.0])?;
/// let m = DMatrix::from_row_slice(3, 3, &[0.0, -6.0, 0.0, 6.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// assert_eq!(body.energy(&body.state(0.0, m)?.matrix), 6.0 * 6.0 / (2.0 * 3.0));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Manakov {
    masses: Vec<f64>,
}

impl Manakov {
    /// The body whose mass tensor, in its principal axes, has these entries.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are fewer than two axes, or if a sum `a_i + a_j` for different
    /// axes is not positive and finite.
    pub fn new(masses: &[f64]) -> Result<Self, Error> {
        if masses.len() < 2 {
            return Err(invalid_inertia(format!(
                "a rotation needs two or more axes, not {}",
                masses.len()
            )));
        }
        for (i, j) in pairs(masses.len()) {
            let sum = masses[i] + masses[j];
            if sum.is_nan() || sum <= 0.0 || sum.is_infinite() {
                return Err(invalid_inertia(format!(
                    "a_{} + a_{} = {sum}, but each sum must be positive and finite",
                    i + 1,
                    j + 1
                )));
            }
        }
        Ok(Manakov { masses: masses.to_vec() })
    }

    /// The masses `a_i`.
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// The state with the momentum `M`.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `M` has one row and one column for each mass; [`Error::Invalid`]
    /// unless it is finite and antisymmetric.
    pub fn state(&self, time: f64, momentum: DMatrix<f64>) -> Result<MatrixState<f64>, Error> {
        checked(time, momentum, Some(self.masses.len()), self.symmetry())
    }

    /// The angular velocity `Omega` in body components.
    pub fn velocity(&self, momentum: &DMatrix<f64>) -> DMatrix<f64> {
        let a = &self.masses;
        momentum.map_with_location(|i, j, m| if i == j { 0.0 } else { m / (a[i] + a[j]) })
    }

    /// The kinetic energy `T = sum_(i<j) M_ij Omega_ij/2`.
    pub fn energy(&self, momentum: &DMatrix<f64>) -> f64 {
        let velocity = self.velocity(momentum);
        pairs(self.masses.len()).map(|at| 0.5 * momentum[at] * velocity[at]).sum()
    }

    /// The squared norm `sum_(i<j) M_ij^2`, which is a Casimir function.
    pub fn norm_squared(&self, momentum: &DMatrix<f64>) -> f64 {
        pairs(self.masses.len()).map(|at| momentum[at] * momentum[at]).sum()
    }

    /// The Pfaffian `Pf M`, which is a Casimir function with `Pf^2 = det M`. It is
    /// `M_12 M_34 - M_13 M_24 + M_14 M_23` for so(4), and 0 for odd n.
    pub fn pfaffian(&self, momentum: &DMatrix<f64>) -> f64 {
        let (mut m, n) = (momentum.clone(), self.masses.len());
        if n % 2 == 1 {
            return 0.0;
        }
        let mut product = 1.0;
        // eliminates two rows and two columns at a time, with pivoting
        for k in (0..n).step_by(2) {
            let size = |j: &usize| m[(k, *j)].abs();
            let pivot = (k + 1..n).max_by(|i, j| size(i).total_cmp(&size(j))).unwrap_or(k + 1);
            if pivot != k + 1 {
                m.swap_rows(k + 1, pivot);
                m.swap_columns(k + 1, pivot);
                product = -product;
            }
            let entry = m[(k, k + 1)];
            product *= entry;
            if entry == 0.0 {
                return product;
            }
            for (i, j) in (k + 2..n).flat_map(|i| (k + 2..n).map(move |j| (i, j))) {
                let change = (m[(k + 1, i)] * m[(k, j)] - m[(k, i)] * m[(k + 1, j)]) / entry;
                m[(i, j)] += change;
            }
        }
        product
    }

    /// The coefficient of `z^degree` in `tr (M + z A^2)^power`, which is a conserved quantity. For
    /// `(power, degree) = (2, 0)` it is `-2` times the squared norm, for `(3, 1)` it is
    /// `3 tr M^2 A^2`, and for `(4, 2)` it is `4 tr M^2 A^4 + 2 tr M A^2 M A^2`. It is 0 if
    /// `power - degree` is odd.
    pub fn integral(&self, momentum: &DMatrix<f64>, power: usize, degree: usize) -> f64 {
        let n = self.masses.len();
        if degree > power {
            return 0.0;
        }
        // the coefficients of a power of M + z A^2, up to `degree`
        let mut coefficients = vec![DMatrix::zeros(n, n); degree + 1];
        coefficients[0] = DMatrix::identity(n, n);
        for _ in 0..power {
            for k in (0..=degree).rev() {
                let mut next = &coefficients[k] * momentum;
                if k > 0 {
                    let below = &coefficients[k - 1];
                    next += below.map_with_location(|_, j, x| x * self.masses[j] * self.masses[j]);
                }
                coefficients[k] = next;
            }
        }
        coefficients[degree].trace()
    }

    /// The eigenvalues of `i M`, in ascending order.
    pub fn spectrum(&self, momentum: &DMatrix<f64>) -> Vec<f64> {
        spectrum(&momentum.map(|m| Complex::new(0.0, m)))
    }
}

/// The pairs `i < j` of indices below `n`.
fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

impl Isospectral for Manakov {
    type Entry = f64;

    fn generator(&self, momentum: &DMatrix<f64>) -> DMatrix<f64> {
        -self.velocity(momentum)
    }

    fn symmetry(&self) -> Option<Symmetry> {
        Some(Symmetry::Antihermitian)
    }
}
