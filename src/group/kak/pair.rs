//! Symmetric pairs of classical groups: involutions and maximal abelian subspaces.

use super::flat::rotated;
use super::structure::{Matrix, Structure};
use crate::Error;
use nalgebra::Complex;

/// The real numbers, the complex numbers or the quaternions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Field {
    Real,
    Complex,
    Quaternion,
}

/// The types of symmetric pairs, by the involution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `theta(g) = conj(g)` (AI, field of real numbers), or `P g P^-1` (AII, quaternions).
    Conjugation(Field),
    /// `theta(g) = I g I` with `I = diag(1, -1)`: AIII, BDI, CII.
    Grading(Field),
    /// `theta(g) = J g J^-1`: DIII for real, CI for quaternionic `g`.
    ComplexStructure(Field),
    /// `theta(g) = g^-*` on a general linear group.
    Linear(Field),
    /// `theta(g) = g^-*` on the group of a Hermitian form.
    Indefinite(Field),
    /// `theta(g) = g^-T` on `Sp(2n,R)`.
    RealSymplectic,
}

/// A symmetric pair `(G, K)` of classical groups, where `K` is the group of fixed points of an
/// involution `theta` of `G`.
///
/// | name | type | `theta(g)` | `K` | real rank |
/// |---|---|---|---|---|
/// | `U(n)/O(n)`, `SU(n)/SO(n)` | AI | `conj(g)` | real matrices | n, n - 1 |
/// | `U(2n)/Sp(n)`, `SU(2n)/Sp(n)` | AII | `P g P^-1` | quaternionic matrices | n, n - 1 |
/// | `U(n)/U(p)xU(q)`, `SU(n)/S(U(p)xU(q))` | AIII | `I g I` | block matrices | min(p, q) |
/// | `O(n)/O(p)xO(q)`, `SO(n)/S(O(p)xO(q))` | BDI | `I g I` | block matrices | min(p, q) |
/// | `SO(2n)/U(n)` | DIII | `J g J^-1` | complex matrices | floor(n/2) |
/// | `Sp(n)/U(n)` | CI | `conj(g)` | real matrices | n |
/// | `Sp(n)/Sp(p)xSp(q)` | CII | `I g I` | block matrices | min(p, q) |
/// | `GL(n,F)`, `SL(n,F)` with F = R, C, H | | `g^-*` | unitary matrices | n, n - 1 |
/// | `O(p,q)`, `SO(p,q)`, `U(p,q)`, `SU(p,q)`, `Sp(p,q)` | | `g^-*` | block matrices | min(p, q) |
/// | `Sp(2n,R)` | | `g^-T` | unitary matrices | n |
///
/// All elements are complex matrices; those of real groups have real entries. A quaternion
/// `a + b i + c j + d k` is the block `[[a + b i, c + d i], [-c + d i, a - b i]]`, and a complex
/// number `a + b i` in `SO(2n)/U(n)` is `[[a, b], [-b, a]]`, as in the catalogue of algebras. For
/// `Sp(2n,R)`, `g^T J g = J` with `J = [[0, 1], [-1, 0]]` in blocks of size n.
///
/// ```
/// use affinor::group::kak::SymmetricPair;
/// let pair: SymmetricPair = "SU(4)/S(U(3)xU(1))".parse()?;
/// assert_eq!((pair.size(), pair.rank()), (4, 1));
/// assert!("SU(4)/S(U(3)xU(2))".parse::<SymmetricPair>().is_err());
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SymmetricPair {
    pub(super) kind: Kind,
    /// The numbers of coordinates over the field of `K` in the two blocks; the second number is 0
    /// without blocks.
    pub(super) counts: [usize; 2],
    /// Whether elements have determinant 1.
    pub(super) is_special: bool,
}

impl SymmetricPair {
    /// The number of rows of the matrices.
    pub fn size(&self) -> usize {
        self.structure().size()
    }

    /// The number of coordinates of `a`: the dimension of a maximal abelian subspace of `p`, and
    /// one more for `SU(n)/SO(n)`, `SU(2n)/Sp(n)` and `SL(n,F)`, whose coordinates have the sum 0.
    pub fn coordinate_count(&self) -> usize {
        let [p, q] = self.counts;
        match self.kind {
            Kind::Grading(_) | Kind::Indefinite(_) => p.min(q),
            Kind::ComplexStructure(Field::Real) => p / 2,
            _ => p,
        }
    }

    /// The dimension of a maximal abelian subspace of `p`: the rank of the symmetric space.
    pub fn rank(&self) -> usize {
        self.coordinate_count() - usize::from(self.has_sum_zero() && self.counts[0] > 0)
    }

    /// Whether the coordinates have the sum 0.
    pub(super) fn has_sum_zero(&self) -> bool {
        self.is_special && matches!(self.kind, Kind::Conjugation(_) | Kind::Linear(_))
    }

    /// Whether `G` is compact.
    pub fn is_compact(&self) -> bool {
        matches!(self.kind, Kind::Conjugation(_) | Kind::Grading(_) | Kind::ComplexStructure(_))
    }

    /// The involution `theta` of an invertible matrix. `K` is the group of its fixed points in `G`.
    ///
    /// # Errors
    /// [`Error::Shape`] for a matrix of a wrong size, [`Error::Invalid`] for a singular matrix.
    pub fn involution(&self, g: &Matrix) -> Result<Matrix, Error> {
        super::expect_size(self, g)?;
        if self.is_compact() {
            return Ok(self.outside(&self.theta(&self.inside(g))));
        }
        let reason = || "the matrix is singular".to_string();
        let inverse = g.adjoint().try_inverse();
        inverse.ok_or_else(|| Error::Invalid { what: "element of the group", reason: reason() })
    }

    /// The element `X` of the maximal abelian subspace with these coordinates; `a = exp(X)`.
    ///
    /// # Errors
    /// [`Error::Shape`] for a wrong number of coordinates.
    pub fn abelian_element(&self, coordinates: &[f64]) -> Result<Matrix, Error> {
        self.expect_coordinates(coordinates)?;
        Ok(self.outside(&self.torus(coordinates, |x| [Complex::ZERO, Complex::new(x, 0.0)])))
    }

    /// The element `a` of the maximal abelian subgroup with these coordinates.
    ///
    /// # Errors
    /// [`Error::Shape`] for a wrong number of coordinates.
    pub fn abelian_exponential(&self, coordinates: &[f64]) -> Result<Matrix, Error> {
        self.expect_coordinates(coordinates)?;
        Ok(self.outside(&self.exponential(coordinates)))
    }

    fn expect_coordinates(&self, coordinates: &[f64]) -> Result<(), Error> {
        let (expected, found) = (self.coordinate_count(), coordinates.len());
        if expected == found {
            return Ok(());
        }
        let [expected, found] = [expected, found].map(|count| format!("{count} coordinates"));
        Err(Error::Shape { what: "an element of the maximal abelian subspace", expected, found })
    }

    pub(super) fn exponential(&self, coordinates: &[f64]) -> Matrix {
        let real = |c, s| [Complex::new(c, 0.0), Complex::new(s, 0.0)];
        match self.kind {
            Kind::Grading(_) | Kind::ComplexStructure(Field::Real) => {
                let mut a = self.torus(coordinates, |x| real(x.cos(), x.sin()));
                self.fill_diagonal(&mut a, coordinates.len());
                a
            }
            Kind::Indefinite(_) => {
                let mut a = self.torus(coordinates, |x| real(x.cosh(), x.sinh()));
                self.fill_diagonal(&mut a, coordinates.len());
                a
            }
            Kind::Linear(_) | Kind::RealSymplectic => {
                let m = self.torus(coordinates, |x| real(0.0, x));
                Matrix::from_diagonal(&m.diagonal().map(|x| Complex::new(x.re.exp(), 0.0)))
            }
            Kind::Conjugation(_) | Kind::ComplexStructure(_) => {
                let m = self.torus(coordinates, |x| real(0.0, x));
                Matrix::from_diagonal(&m.diagonal().map(|x| Complex::cis(x.im)))
            }
        }
    }

    /// Sets the diagonal entries of `a` outside the planes of the coordinates to 1.
    fn fill_diagonal(&self, a: &mut Matrix, count: usize) {
        let n = self.structure().count;
        let [p, _] = self.counts;
        let is_plane = |i: usize| match self.kind {
            Kind::ComplexStructure(_) => i < 2 * count,
            _ => i < count || (p..p + count).contains(&i),
        };
        (0..a.nrows()).filter(|i| !is_plane(i % n)).for_each(|i| a[(i, i)] = Complex::ONE);
    }

    /// The matrix with the even part (`cos`) and the odd part (`sin`) of each coordinate at the
    /// positions of the maximal abelian subspace.
    fn torus(&self, coordinates: &[f64], parts: impl Fn(f64) -> [Complex<f64>; 2]) -> Matrix {
        let structure = self.structure();
        let (n, [p, _]) = (structure.count, self.counts);
        let mut m = Matrix::zeros(structure.size(), structure.size());
        for (j, &x) in coordinates.iter().enumerate() {
            let [even, odd] = parts(x);
            let mut plane = |x: usize, y: usize, lower: Complex<f64>, upper: Complex<f64>| {
                (m[(x, x)], m[(y, y)], m[(y, x)], m[(x, y)]) = (even, even, lower, upper);
            };
            match self.kind {
                Kind::Grading(_) | Kind::Indefinite(_) => {
                    let upper = if self.is_compact() { -odd } else { odd };
                    plane(j, p + j, odd, upper);
                    if structure.is_paired {
                        plane(n + j, n + p + j, odd, upper);
                    }
                }
                Kind::ComplexStructure(Field::Real) => {
                    plane(2 * j, 2 * j + 1, odd, -odd);
                    plane(n + 2 * j, n + 2 * j + 1, -odd, odd);
                }
                _ => {
                    m[(j, j)] = odd;
                    if structure.is_paired {
                        let is_opposite =
                            matches!(self.kind, Kind::ComplexStructure(_) | Kind::RealSymplectic);
                        m[(n + j, n + j)] = if is_opposite { -odd } else { odd };
                    }
                }
            }
        }
        match self.kind {
            Kind::Conjugation(_) | Kind::ComplexStructure(Field::Quaternion) => rotated(&m, 1.0),
            _ => m,
        }
    }

    /// The operators that commute with `K`.
    pub(super) fn structure(&self) -> Structure {
        let [p, q] = self.counts;
        let (is_real, is_paired) = match self.kind {
            Kind::Conjugation(field)
            | Kind::Grading(field)
            | Kind::Linear(field)
            | Kind::Indefinite(field) => (field == Field::Real, field == Field::Quaternion),
            Kind::ComplexStructure(_) | Kind::RealSymplectic => (true, true),
        };
        Structure { count: p + q, first: p, is_real, is_paired }
    }

    /// The operators that commute with `G`.
    pub(super) fn ambient(&self) -> Structure {
        let inner = self.structure();
        let [is_real, is_paired] = match self.kind {
            Kind::Conjugation(_) => [false, false],
            Kind::Grading(_) | Kind::Linear(_) | Kind::Indefinite(_) => {
                [inner.is_real, inner.is_paired]
            }
            Kind::ComplexStructure(field) => [field == Field::Real, field == Field::Quaternion],
            Kind::RealSymplectic => [true, false],
        };
        let count = if is_paired { inner.count } else { inner.size() };
        Structure { count, first: count, is_real, is_paired }
    }

    /// The involution of an element of a compact group, in the order of [`Self::inside`].
    pub(super) fn theta(&self, g: &Matrix) -> Matrix {
        let conjugate = g.conjugate();
        let half = g.nrows() / 2;
        let swapped = |m: &Matrix| {
            Matrix::from_fn(m.nrows(), m.ncols(), |i, j| {
                let value = m[((i + half) % m.nrows(), (j + half) % m.ncols())];
                if (i < half) == (j < half) { value } else { -value }
            })
        };
        match self.kind {
            Kind::Conjugation(Field::Quaternion) => swapped(&conjugate),
            Kind::Conjugation(_) | Kind::ComplexStructure(Field::Quaternion) => conjugate,
            Kind::ComplexStructure(_) => swapped(g),
            _ => self.signed(g),
        }
    }

    /// The matrix `I g I` with `I = diag(1, -1)`.
    pub(super) fn signed(&self, g: &Matrix) -> Matrix {
        let structure = self.structure();
        let is_second = |i: usize| i % structure.count >= structure.first;
        Matrix::from_fn(g.nrows(), g.ncols(), |i, j| {
            if is_second(i) == is_second(j) { g[(i, j)] } else { -g[(i, j)] }
        })
    }

    /// The matrix `I = diag(1, -1)`.
    pub(super) fn signed_identity(&self) -> Matrix {
        let structure = self.structure();
        let sign = |i: usize| if i % structure.count < structure.first { 1.0 } else { -1.0 };
        let size = structure.size();
        Matrix::from_fn(size, size, |i, j| Complex::new(if i == j { sign(i) } else { 0.0 }, 0.0))
    }

    /// Moves the pairs of coordinates behind the coordinates.
    pub(super) fn inside(&self, g: &Matrix) -> Matrix {
        let n = self.structure().count;
        let at = |i: usize| if i < n { 2 * i } else { 2 * (i - n) + 1 };
        self.permuted(g, at)
    }

    /// The inverse of [`Self::inside`].
    pub(super) fn outside(&self, g: &Matrix) -> Matrix {
        let n = self.structure().count;
        self.permuted(g, |i| i / 2 + n * (i % 2))
    }

    fn permuted(&self, g: &Matrix, at: impl Fn(usize) -> usize) -> Matrix {
        if !self.structure().is_paired || self.kind == Kind::RealSymplectic {
            return g.clone();
        }
        Matrix::from_fn(g.nrows(), g.ncols(), |i, j| g[(at(i), at(j))])
    }
}
