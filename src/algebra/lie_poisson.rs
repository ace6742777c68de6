//! The Lie-Poisson bracket on the dual of a Lie algebra, its Casimirs and the coadjoint orbits.
//!
//! Functions are [`Symbolic`] in the coordinates `mu1 ... mun` of `mu = mu_i e^i`. The sign follows
//! J. E. Marsden and T. S. Ratiu, *Introduction to Mechanics and Symmetry* (1999), 13.1:
//! `{f,g}(mu) = +- <mu, [df, dg]>`, where the minus sign is for left-invariant systems.

mod casimirs;

pub use casimirs::{MAX_DEGREE, MAX_MONOMIALS};

use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::frame::{expect_slots, formula};
use affinor_tensors::linear::Matrix;
use affinor_tensors::{Down, Field, Ring, Scalar, Symbolic, Tensor, Up};

/// The dual of a Lie algebra with its Poisson bracket.
///
/// ```
/// use affinor::LiePoisson;
/// use affinor::algebra::catalogue;
/// let body = LiePoisson::left(&catalogue::algebra("so(3)")?)?;
/// let [x, y, _] = body.coordinates() else { unreachable!() };
/// assert_eq!(body.bracket(x, y)?.to_string(), "-mu3");
/// assert_eq!(body.casimirs(2)?[0].to_string(), "mu1^2 + mu2^2 + mu3^2");
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Poisson bracket", "coadjoint orbit"))]
#[derive(Clone, Debug)]
pub struct LiePoisson {
    coordinates: Vec<Symbolic>,
    names: Vec<String>,
    structure: Tensor<Symbolic>,
    tensor: Tensor<Symbolic>,
}

impl LiePoisson {
    /// The bracket with the minus sign, for left-invariant systems on T*G such as the rigid body.
    ///
    /// # Errors
    /// [`Error::Name`] if a parameter of the algebra has the name of a coordinate.
    pub fn left(algebra: &LieAlgebra<Symbolic>) -> Result<Self, Error> {
        Self::new(algebra, -1)
    }

    /// The bracket with the plus sign, for right-invariant systems on T*G such as the ideal fluid.
    ///
    /// # Errors
    /// The errors of [`left`](Self::left).
    pub fn right(algebra: &LieAlgebra<Symbolic>) -> Result<Self, Error> {
        Self::new(algebra, 1)
    }

    fn new(algebra: &LieAlgebra<Symbolic>, sign: i64) -> Result<Self, Error> {
        let names: Vec<_> = (1..=algebra.dimension()).map(|i| format!("mu{i}")).collect();
        let mut constants =
            algebra.structure_constants().components().flat_map(|(_, v)| v.parameters());
        if let Some(name) = constants.find(|parameter| names.contains(parameter)) {
            return Err(Error::coordinate(&name));
        }
        let coordinates: Vec<_> = names.iter().map(|name| Symbolic::parameter(name)).collect();
        let tensor = paired(algebra, &Tensor::vector(&coordinates, Down));
        let tensor = tensor.scale(&Symbolic::from_i64(sign));
        let structure = algebra.structure_constants().clone();
        Ok(LiePoisson { coordinates, names, structure, tensor })
    }

    /// The coordinates `mu_i`.
    pub fn coordinates(&self) -> &[Symbolic] {
        &self.coordinates
    }

    /// The Poisson tensor `Pi_ij = {mu_i, mu_j} = +- c^k_ij mu_k`, slots `_ij`. It acts on
    /// differentials of functions on the dual, which are vectors of the algebra.
    pub fn tensor(&self) -> &Tensor<Symbolic> {
        &self.tensor
    }

    /// The bracket of two functions, `{f,g} = Pi_ij df/dmu_i dg/dmu_j`.
    ///
    /// # Errors
    /// [`Error::Shape`]. This error cannot occur for functions of these coordinates.
    pub fn bracket(&self, f: &Symbolic, g: &Symbolic) -> Result<Symbolic, Error> {
        let field = self.hamiltonian_field(g)?;
        let operands = [("f", &self.differential(f)), ("X", &field)];
        Ok(formula("f^i X_i ->", &operands).to_scalar().expect("a tensor of rank 0"))
    }

    /// The equations of motion of a Hamiltonian: `dmu_i/dt = {mu_i, h} = Pi_ij dh/dmu_j`, slots
    /// `_i`.
    ///
    /// # Errors
    /// The errors of [`bracket`](Self::bracket).
    pub fn hamiltonian_field(&self, h: &Symbolic) -> Result<Tensor<Symbolic>, Error> {
        let dh = self.differential(h);
        expect_slots("the differential", &dh, self.names.len(), &[Up])?;
        Ok(formula("P_ij h^j -> _i", &[("P", &self.tensor), ("h", &dh)]))
    }

    /// Whether `f` is a Casimir function: `{f, h} = 0` for every function `h`.
    pub fn is_casimir(&self, f: &Symbolic) -> bool {
        self.hamiltonian_field(f).is_ok_and(|field| field.is_empty())
    }

    /// The differential `df`, a vector of the algebra.
    fn differential(&self, f: &Symbolic) -> Tensor<Symbolic> {
        let slopes: Vec<_> = self.names.iter().map(|name| f.derivative(name)).collect();
        Tensor::vector(&slopes, Up)
    }
}

impl<S: Field + Scalar> LieAlgebra<S> {
    /// The dimension of the coadjoint orbit through `mu`, which is the rank of the matrix
    /// `c^k_ij mu_k` and is always even. Near a generic `mu`, the number of independent Casimir
    /// functions is `n` minus this dimension.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `mu` has as many components as the algebra.
    pub fn coadjoint_orbit_dimension(&self, mu: &[S]) -> Result<usize, Error> {
        let mu = Tensor::vector(mu, Down).with_tolerance(self.structure_constants().tolerance());
        expect_slots("the covector", &mu, self.dimension(), &[Down])?;
        let form = paired(self, &mu);
        let rows = (0..self.dimension()).map(|i| {
            let row = form.components().filter(move |(at, _)| at[0] == i);
            row.map(|(at, value)| (at[1], value.clone())).collect::<Vec<_>>()
        });
        let matrix = Matrix::from_rows(self.dimension(), rows)?;
        Ok(matrix.with_tolerance(form.tolerance()).rank()?)
    }
}

/// The antisymmetric form `<mu, [e_i, e_j]>`.
fn paired<S: Scalar>(algebra: &LieAlgebra<S>, mu: &Tensor<S>) -> Tensor<S> {
    formula("c^k_ij u_k -> _[ij]", &[("c", algebra.structure_constants()), ("u", mu)])
}
