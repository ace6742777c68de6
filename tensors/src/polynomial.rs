//! Systems of polynomial equations over the rationals, and all their real solutions. In reading
//! order:
//!
//! - [`System`]: equations and inequations `p != 0`, and the decomposition into cases; the result is
//!   a [`SolutionSet`] of [`Point`]s and [`Family`]s;
//! - `groebner`: Groebner bases that split at factors; `factors`, `reality`: factors of polynomials,
//!   and consequences of sums of squares;
//! - `quotient`: the quotient algebra of finitely many points; `minimal`: minimal polynomials in it;
//! - `real_roots`: isolating intervals; [`RealNumber`]: real algebraic numbers.
//!
//! All steps are exact. Floats occur only where a value is printed.

mod algebraic;
mod factors;
mod groebner;
mod minimal;
mod point;
mod quotient;
mod real_roots;
mod reality;
mod system;

pub use algebraic::RealNumber;
pub use point::Point;
pub use system::{Family, SolutionSet, System, distinct_factors};

use crate::Rational;
use polycore::{Order, Poly, Uni};

/// A polynomial in the letters of a system.
type Polynomial = Poly<Rational>;
/// A polynomial in one variable.
type Univariate = Uni<Rational>;

/// The order of monomials of all bases, except for eliminations.
const ORDER: Order = Order::GRevLex;

/// The system exceeds the limit of the effort.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the system of equations is too large to be solved: {0}")]
pub struct TooLarge(&'static str);

/// The remaining effort of a computation, in operations on terms.
struct Budget(u64);

impl Budget {
    /// Uses up some operations.
    fn spend(&mut self, operations: usize) -> Result<(), TooLarge> {
        crate::stop::checkpoint();
        let left = self.0.checked_sub(operations as u64);
        self.0 = left.ok_or(TooLarge("its Groebner bases need too many operations"))?;
        Ok(())
    }
}
