//! The structure of a Lie algebra, computed exactly: series, radicals, Levi subalgebras, types. In
//! reading order:
//!
//! - [`GroundField`]: the scalars, rationals and rational functions of parameters;
//! - [`Subspace`]: subspaces in reduced row echelon form; `products`: brackets of vectors;
//! - `kernels`: kernels of matrices, lifted from residues;
//! - [`StructureTheory`]: an algebra with a table of its brackets; `series`, `killing`, `radical`,
//!   `cartan`, `levi`;
//! - [`reduction`]: the algebra modulo a prime, for ranks; `derivations`, `cohomology`;
//!   `certificates`: dimensions proved over the rationals; `index`;
//! - [`dynkin`], `root_spaces`, `ideals`, [`real_forms`], `orthogonal_forms`: Dynkin types, roots,
//!   simple ideals over the reals and their names;
//! - `vogan`, `satake`: Cartan decompositions, Vogan and Satake diagrams; `embedding`: weights of
//!   subalgebras;
//! - `quadratic`: quadratic Casimir functions of reductive algebras;
//! - `cocycles`, `symplectic`, `complex_structures`: closed forms of low degree, symplectic and
//!   contact forms, Casimir functions;
//! - `decomposition`: indecomposable ideals; `identification`: names in low dimension;
//! - [`exceptional`]: candidates for exceptional values of a parameter;
//! - `constructions`: quotients, extensions, semidirect sums, contractions, complexifications.
//!
//! W. A. de Graaf, *Lie Algebras: Theory and Algorithms*, North-Holland 2000.
//!
//! # Choices by trial
//!
//! Some algorithms try elements, forms or primes. Such a search ends with a certificate; otherwise
//! the answer states that it is not proved. Primes that divide a denominator or a structure
//! constant are skipped.
//!
//! | choice | certificate |
//! |---|---|
//! | `radical`: element that separates the weights | the subspace is a nilpotent ideal; points of a moment curve until one separates them |
//! | `cartan`: regular element | its null component is nilpotent, or has the dimension of the rank; tried until one succeeds |
//! | `cartan`, dense basis: prime | the Killing form is regular modulo the prime; the kernel is verified by exact multiplication |
//! | `kernels`: primes | as many rational vectors as modulo a prime, verified by exact multiplication; otherwise elimination |
//! | `killing`: prime for the rank | full rank modulo a prime; otherwise elimination |
//! | `dynkin`: prime and regular element | the Killing form is regular modulo the prime; ranks add up; one type satisfies its identities |
//! | `ideals`: primes for the centroid | the maps commute with all `ad`, one for each simple factor |
//! | `ideals`: generator of the centroid | degree of its minimal polynomial; points of a moment curve until one generates it |
//! | `decomposition`: element of the centroid | number of its eigenvalues; points of a moment curve until one suffices |
//! | `certificates`: primes for derivations, invariant forms, closed forms | a basis is verified by exact multiplication; otherwise "modulo two primes", as always for Betti numbers beyond dimension 11 |
//! | `index`: form and primes | centre, abelian ideals, parity, or vanishing Pfaffians; otherwise "modulo two primes" |
//! | `symplectic`: symplectic, contact and regular forms | full rank modulo a prime; "none" by Pfaffian, index theorem or common kernel; otherwise "modulo two primes" |
//! | `orthogonal_forms`: regular element and primes | bounds of the coefficients, and intervals; otherwise the answer has two possible names |
//! | `embedding`: primes that split the roots | integers from their residues; the adjoint representation must restrict with multiplicities that are not negative |
//! | `root_spaces`: prime | the prime only excludes Cartan subalgebras that do not split; root vectors are exact |
//! | `identification`: names of nilpotent algebras | proved dimensions, or an isomorphism verified by exact multiplication; otherwise "modulo two primes" |
//! | `identification`: isomorphisms | verified by exact multiplication; otherwise "by invariants", or the root that is needed |
//! | `complex_structures`: rational frames | existence by a theorem; otherwise "no rational one is found" |
//! | generators for the Jacobi identity | independent modulo a prime; otherwise all triples |
//! | sectional curvature: planes | exact curvature; "found by a search, not proved" unless a theorem decides |
//! | charts: eigenvalues at sample points | the polynomial annihilates the matrix of all coordinates |

mod cartan;
mod certificates;
mod cocycles;
mod cohomology;
mod complex_structures;
mod constructions;
mod decomposition;
mod derivations;
pub mod dynkin;
mod embedding;
pub mod exceptional;
mod ground;
mod ideals;
mod identification;
mod index;
mod kernels;
mod killing;
mod levi;
mod orthogonal_forms;
mod products;
mod quadratic;
mod radical;
pub mod real_forms;
pub mod reduction;
mod root_spaces;
mod satake;
mod series;
mod subspace;
mod symplectic;
mod vogan;

pub use certificates::Certified;
pub use cocycles::{MAX_ANY as MAX_FORMS_WITH_PARAMETERS, MAX_DIMENSION as MAX_FORMS, TwoForms};
pub use cohomology::MAX_DIMENSION as MAX_BETTI;
pub use complex_structures::ComplexStructure;
pub use decomposition::{Indecomposable, MAX_DIMENSION as MAX_DECOMPOSED};
pub use derivations::MAX_DIMENSION as MAX_DERIVATIONS;
pub use embedding::{Embedding, Numbering};
pub use ground::GroundField;
pub use ideals::{RealIdeal, SimpleIdeals};
pub use identification::Identification;
pub use killing::Killing;
pub use root_spaces::{RootSpace, RootSpaces};
pub use satake::{RealForm, RestrictedType};
pub use subspace::Subspace;
pub(in crate::algebra) use subspace::primitive_factor;
pub(crate) use subspace::{collected, combination, coprime};
pub use symplectic::Existence;
pub use vogan::VoganDiagram;

use crate::algebra::SparseBracket;
use crate::algebra::roots::CartanType;
use crate::algebra::{Bracket, LieAlgebra};
use crate::{Error, Law};
use affinor_tensors::Rational;
use affinor_tensors::linear::Matrix;

use std::cell::OnceCell;

/// A Lie algebra, with a cache of computed properties of its structure.
///
/// ```
/// use affinor::algebra::structure::StructureTheory;
/// use affinor::{Rational, algebra::catalogue};
/// let motions = StructureTheory::new(catalogue::algebra::<Rational>("se(3)")?);
/// assert_eq!(motions.radical().dimension(), 3);
/// assert_eq!(motions.levi()?.dimension(), 3);
/// # Ok::<(), affinor::Error>(())
/// ```
#[doc(alias("Levi decomposition", "ideals", "radical"))]
#[derive(Clone, Debug)]
pub struct StructureTheory<S> {
    algebra: LieAlgebra<S>,
    products: SparseBracket<S>,
    form: OnceCell<Matrix<S>>,
    killing: OnceCell<Killing<S>>,
    semisimple: OnceCell<bool>,
    derived: OnceCell<Vec<Subspace<S>>>,
    lower: OnceCell<Vec<Subspace<S>>>,
    centre: OnceCell<Subspace<S>>,
    radical: OnceCell<Subspace<S>>,
    levi: OnceCell<Subspace<S>>,
    cartan: OnceCell<Subspace<S>>,
    types: OnceCell<Option<Vec<CartanType>>>,
}

impl<S: GroundField> StructureTheory<S> {
    /// Prepares the structure theory of an algebra.
    pub fn new(algebra: LieAlgebra<S>) -> Self {
        let products = SparseBracket::of_tensor(algebra.structure_constants());
        StructureTheory {
            algebra,
            products,
            form: OnceCell::new(),
            killing: OnceCell::new(),
            semisimple: OnceCell::new(),
            derived: OnceCell::new(),
            lower: OnceCell::new(),
            centre: OnceCell::new(),
            radical: OnceCell::new(),
            levi: OnceCell::new(),
            cartan: OnceCell::new(),
            types: OnceCell::new(),
        }
    }

    /// The algebra.
    pub fn algebra(&self) -> &LieAlgebra<S> {
        &self.algebra
    }

    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.algebra.dimension()
    }

    /// The whole algebra as a subspace.
    pub fn whole(&self) -> Subspace<S> {
        Subspace::whole(self.dimension())
    }

    /// The subalgebra on a subspace, in the basis of the echelon form of the subspace.
    ///
    /// # Errors
    /// [`Law::Subalgebra`] with two basis vectors whose bracket leaves the subspace.
    pub fn subalgebra(&self, subspace: &Subspace<S>) -> Result<StructureTheory<S>, Error> {
        if subspace.dimension() == self.dimension() {
            return Ok(self.clone());
        }
        let basis = subspace.basis();
        let mut constants = vec![];
        for (j, x) in basis.iter().enumerate() {
            let ad = self.products.ad(x);
            for (k, y) in basis.iter().enumerate().skip(j + 1) {
                let bracket = ad.image(y);
                let Some(coordinates) = subspace.coordinates(&bracket) else {
                    let at = [self.write(x), self.write(y)];
                    return Err(Law::Subalgebra.broken(at, self.write(&bracket)));
                };
                let terms = coordinates.into_iter().map(|(i, value)| (j, k, i, value));
                constants.extend(terms);
            }
        }
        let labels = (1..=basis.len()).map(|at| format!("e{at}"));
        // no check is needed, because a subalgebra satisfies the Jacobi identity
        let bracket = Bracket::from_constants(labels, constants)?;
        let inside = StructureTheory::new(LieAlgebra { frame: bracket.into_frame() });
        if self.levi.get() == Some(subspace) {
            inside.know_types(self.types.get());
        }
        Ok(inside)
    }

    /// The algebra over the rationals, with the Cartan types if they are already known; `None` if a
    /// constant is not rational.
    pub fn over_the_rationals(&self) -> Option<StructureTheory<Rational>> {
        let constants = self.algebra.structure_constants();
        let rational = constants.components().all(|(_, value)| value.rational().is_some());
        let algebra = || self.algebra.map(|value| value.rational().unwrap_or_default()).ok();
        let same = StructureTheory::new(rational.then(algebra)??);
        same.know_types(self.types.get());
        if let Some(cartan) = self.cartan.get() {
            let value = |(at, value): &(usize, S)| (*at, value.rational().unwrap_or_default());
            let rows = cartan.basis().iter().map(|row| row.iter().map(value).collect::<Vec<_>>());
            same.cartan.get_or_init(|| Subspace::span(self.dimension(), rows));
        }
        Some(same)
    }

    /// Stores the Cartan types that were computed for the same algebra elsewhere.
    fn know_types(&self, types: Option<&Option<Vec<CartanType>>>) {
        if let Some(types) = types {
            self.types.get_or_init(|| types.clone());
        }
    }

    /// Writes a vector as a linear combination of the basis vectors.
    pub(crate) fn write(&self, row: &[(usize, S)]) -> String {
        let labels = self.algebra.labels();
        let terms = row.iter().map(|(i, value)| (value.to_string(), labels[*i].clone()));
        affinor_tensors::text::combination(terms.collect::<Vec<_>>())
    }
}
