//! The errors for homogeneous spaces in a build without the feature `homogeneous`. The first module of the
//! page is such a build; its worker then asks the module that has everything.

use super::{Definition, Origin};
use crate::Coefficient;
use crate::input::forms::HomogeneousText;
use crate::input::{InputError, Refusal, Source};
use affinor::LieAlgebra;
use affinor::geometry::homogeneous::{HomogeneousSpace, has_form};
use affinor::group::{AnyGroup, registry};
use affinor_tensors::{Symbolic, Tolerance};
use nalgebra::DMatrix;
use std::collections::BTreeSet;
use std::convert::Infallible;

/// A homogeneous space, of which there are none in this build.
#[derive(Clone, Debug)]
pub(super) struct CosetSpace {
    pub algebra: String,
    never: Infallible,
}

impl<D> HomogeneousText<D> {
    /// Refuses the key.
    pub(super) fn read(
        &self,
        _: &str,
        _: &LieAlgebra<Symbolic>,
        _: &BTreeSet<String>,
        source: &Source,
    ) -> Result<CosetSpace, InputError> {
        Err(absent().at(&source.key("homogeneous")))
    }
}

impl CosetSpace {
    pub fn labels(&self) -> Vec<String> {
        match self.never {}
    }

    pub fn space<S: Coefficient>(
        &self,
        _: &str,
        _: &[String],
        _: Tolerance,
    ) -> Result<HomogeneousSpace<S>, InputError> {
        match self.never {}
    }

    pub fn is_rational(&self) -> bool {
        match self.never {}
    }

    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut Symbolic> {
        match self.never {}
        #[allow(unreachable_code, reason = "it names the type")]
        std::iter::empty()
    }
}

impl Definition {
    /// The homogeneous space, if the definition is one.
    pub(super) fn coset_space(&self) -> Option<&CosetSpace> {
        match &self.origin {
            Origin::Homogeneous(coset) => match coset.never {},
            _ => None,
        }
    }

    /// Whether the definition is a homogeneous space.
    pub fn is_homogeneous(&self) -> bool {
        false
    }

    /// The group G of a homogeneous space and its adapted basis; `None` for other definitions.
    ///
    /// # Errors
    /// None in this build.
    pub fn transitive_group(
        &self,
        _: Tolerance,
    ) -> Result<Option<(AnyGroup, DMatrix<f64>)>, InputError> {
        Ok(None)
    }

    /// The name of the algebra of G, if the definition is a homogeneous space G/H.
    pub fn algebra_of_group(&self) -> Option<&str> {
        None
    }

    /// The homogeneous space over a scalar type; `None` for other definitions.
    ///
    /// # Errors
    /// None in this build.
    pub fn homogeneous<S: Coefficient>(
        &self,
        _: Tolerance,
    ) -> Result<Option<HomogeneousSpace<S>>, InputError> {
        Ok(None)
    }
}

/// Refuses a text that has the form of a name of a homogeneous space, or of a sum in which such a
/// name occurs.
pub(super) fn named(source: &Source) -> Option<Result<Definition, InputError>> {
    let parts = registry::summands(source.content());
    let is_space = parts.iter().any(|part| has_form(part.trim()));
    is_space.then(|| Err(absent().at(&source.whole(source.content()))))
}

fn absent() -> InputError {
    let error = InputError::usage("this build contains no homogeneous spaces");
    InputError { refusal: Refusal::Absent, ..error }
}
