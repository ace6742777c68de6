//! Groups chosen at run time, and their direct products.

use super::{
    Block, Coordinates, Embedded, Generator, LieGroup, MatrixNotation, Partial, Product,
    TranslationSplit,
};
use crate::{Error, LieAlgebra};
use nalgebra::{DMatrix, DVector};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// A group chosen at run time. It is found [by its name](AnyGroup::named), or [made](AnyGroup::new)
/// from any group type.
///
/// It is a [`LieGroup`] like every other group. Elements are lists of embedding coordinates
/// ([`Embedded::coordinates`]), vectors are lists of components. Not every call checks lengths: a
/// list of a wrong length panics or yields a wrong result. [`MatrixNotation::write`] returns the
/// matrix of an element.
///
/// ```
/// use affinor::group::{AnyGroup, LieGroup, MatrixNotation};
/// use nalgebra::dvector;
/// // two rigid bodies: twists of the first, then of the second
/// let bodies = AnyGroup::named("se3+se3")?;
/// let x = dvector![0.0, 0.0, 0.5, 1.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0];
/// let g = bodies.exp(&x);
/// assert!((bodies.log(&bodies.compose(&g, &bodies.inverse(&g)))?).norm() < 1e-15);
/// // the matrices of both, row by row, in one column
/// assert_eq!(bodies.write(&g).shape(), (16 + 16, 1));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct AnyGroup(Arc<dyn Erased>);

impl AnyGroup {
    /// Wraps a group and hides its type.
    pub fn new<G: MatrixNotation + TranslationSplit + Debug + Send + Sync + 'static>(
        group: G,
    ) -> Self {
        AnyGroup(Arc::new(Flat(group)))
    }

    /// The group with this name, as [`registry::find`](super::registry::find) returns it.
    ///
    /// # Errors
    /// The errors of [`registry::find`](super::registry::find).
    pub fn named(name: &str) -> Result<Self, Error> {
        super::registry::find(name)
    }

    /// The factors, in order, of a direct product of groups that were chosen at run time. The only
    /// factor of any other group is the group itself.
    ///
    /// ```
    /// use affinor::group::{AnyGroup, LieGroup};
    /// let bodies = AnyGroup::named("se3+so3+R^2")?;
    /// let dimensions: Vec<usize> = bodies.factors().iter().map(|factor| factor.dimension()).collect();
    /// assert_eq!(dimensions, [6, 3, 2]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    pub fn factors(&self) -> Vec<&AnyGroup> {
        match self.downcast_ref::<Product<AnyGroup, AnyGroup>>() {
            Some(Product(first, second)) => [first.factors(), second.factors()].concat(),
            None => vec![self],
        }
    }

    /// The group from which this group was [made](Self::new), if it has the type `G`.
    pub fn downcast_ref<G: 'static>(&self) -> Option<&G> {
        self.0.group().downcast_ref()
    }
}

/// The interface of groups whose elements and vectors are lists of numbers.
trait Erased:
    LieGroup<Element = DVector<f64>, Vector = DVector<f64>>
    + TranslationSplit
    + MatrixNotation<Ambient = DVector<f64>>
    + Debug
    + Send
    + Sync
{
    /// The wrapped group.
    fn group(&self) -> &dyn Any;
}

/// A wrapper of a group that converts its elements and vectors to lists of numbers.
#[derive(Debug)]
struct Flat<G>(G);

impl<G: MatrixNotation + TranslationSplit + Debug + Send + Sync + 'static> Erased for Flat<G> {
    fn group(&self) -> &dyn Any {
        &self.0
    }
}

impl<G: MatrixNotation + TranslationSplit> Flat<G> {
    fn element(&self, numbers: &DVector<f64>) -> G::Element {
        self.0.from_coordinates(&G::Ambient::from_components(numbers.as_slice()))
    }

    fn owned_element(&self, numbers: DVector<f64>) -> G::Element {
        self.element(&numbers)
    }

    fn vector(&self, components: &DVector<f64>) -> G::Vector {
        G::Vector::from_components(components.as_slice())
    }

    fn to_element(&self, g: G::Element) -> DVector<f64> {
        list(self.0.coordinates(&g))
    }

    fn to_vector(&self, x: G::Vector) -> DVector<f64> {
        list(x)
    }
}

impl AnyGroup {
    fn element<'g>(&self, g: &'g DVector<f64>) -> &'g DVector<f64> {
        g
    }

    fn owned_element(&self, g: DVector<f64>) -> DVector<f64> {
        g
    }

    fn vector<'x>(&self, x: &'x DVector<f64>) -> &'x DVector<f64> {
        x
    }

    fn to_element(&self, g: DVector<f64>) -> DVector<f64> {
        g
    }

    fn to_vector(&self, x: DVector<f64>) -> DVector<f64> {
        x
    }
}

fn list(x: impl Coordinates) -> DVector<f64> {
    DVector::from_column_slice(x.components())
}

/// Implements the traits of a group for a wrapper: each call is forwarded to the wrapped group. The
/// functions `element`, `vector`, `to_element` and `to_vector` convert arguments and results.
macro_rules! on_lists {
    ([$($parameters:tt)*] $Group:ty) => {
        impl $($parameters)* LieGroup for $Group {
            type Element = DVector<f64>;
            type Vector = DVector<f64>;

            fn compose(&self, g: &DVector<f64>, h: &DVector<f64>) -> DVector<f64> {
                self.to_element(self.0.compose(&self.element(g), &self.element(h)))
            }

            fn inverse(&self, g: &DVector<f64>) -> DVector<f64> {
                self.to_element(self.0.inverse(&self.element(g)))
            }

            fn exp(&self, x: &DVector<f64>) -> DVector<f64> {
                self.to_element(self.0.exp(&self.vector(x)))
            }

            fn adjoint(&self, g: &DVector<f64>, x: &DVector<f64>) -> DVector<f64> {
                self.to_vector(self.0.adjoint(&self.element(g), &self.vector(x)))
            }

            fn adjoint_exp(&self, x: &DVector<f64>) -> DMatrix<f64> {
                self.0.adjoint_exp(&self.vector(x))
            }

            fn log_product(&self, x: &DVector<f64>, y: &DVector<f64>) -> Result<DVector<f64>, Error> {
                self.0.log_product(&self.vector(x), &self.vector(y)).map(|x| self.to_vector(x))
            }

            fn coadjoint(&self, g: &DVector<f64>, h: &DVector<f64>) -> DVector<f64> {
                self.to_vector(self.0.coadjoint(&self.element(g), &self.vector(h)))
            }

            fn coadjoint_exp(&self, x: &DVector<f64>, h: &DVector<f64>) -> DVector<f64> {
                self.to_vector(self.0.coadjoint_exp(&self.vector(x), &self.vector(h)))
            }

            fn bracket(&self, x: &DVector<f64>, y: &DVector<f64>) -> DVector<f64> {
                self.to_vector(self.0.bracket(&self.vector(x), &self.vector(y)))
            }

            fn tangent_left(&self, x: &DVector<f64>, v: &DVector<f64>) -> DVector<f64> {
                self.to_vector(self.0.tangent_left(&self.vector(x), &self.vector(v)))
            }

            fn dimension(&self) -> usize {
                self.0.dimension()
            }

            fn identity(&self) -> DVector<f64> {
                self.to_element(self.0.identity())
            }

            fn log(&self, g: &DVector<f64>) -> Result<DVector<f64>, Error> {
                self.0.log(&self.element(g)).map(|x| self.to_vector(x))
            }

            fn tangent_left_inverse(
                &self,
                x: &DVector<f64>,
                v: &DVector<f64>,
            ) -> Result<DVector<f64>, Error> {
                self.0.tangent_left_inverse(&self.vector(x), &self.vector(v)).map(|x| self.to_vector(x))
            }

            fn matrix(&self, g: &DVector<f64>) -> DMatrix<f64> {
                self.0.matrix(&self.element(g))
            }

            fn project(&self, g: DVector<f64>) -> DVector<f64> {
                self.to_element(self.0.project(self.owned_element(g)))
            }

            fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
                self.0.algebra()
            }
        }

        impl $($parameters)* TranslationSplit for $Group {
            fn translational_part(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
                self.0.translational_part(&self.vector(x)).map(|x| self.to_vector(x))
            }

            fn has_translations(&self) -> bool {
                self.0.has_translations()
            }

            fn translational_momentum(&self, h: &DVector<f64>) -> Option<DVector<f64>> {
                self.0.translational_momentum(&self.vector(h)).map(|h| self.to_vector(h))
            }

            fn linear_part(&self, g: &DVector<f64>) -> DVector<f64> {
                self.to_element(self.0.linear_part(&self.element(g)))
            }

            fn coadjoint_inverse(&self, k: &DVector<f64>, h: &DVector<f64>) -> DVector<f64> {
                self.to_vector(self.0.coadjoint_inverse(&self.element(k), &self.vector(h)))
            }

            fn relative_linear_part(&self, g: &DVector<f64>, h: &DVector<f64>) -> DVector<f64> {
                self.to_element(self.0.relative_linear_part(&self.element(g), &self.element(h)))
            }

            fn has_bounded_adjoint(&self) -> bool {
                self.0.has_bounded_adjoint()
            }
        }

        impl $($parameters)* Embedded for $Group {
            type Ambient = DVector<f64>;

            fn coordinates(&self, g: &DVector<f64>) -> DVector<f64> {
                g.clone()
            }

            fn from_coordinates(&self, y: &DVector<f64>) -> DVector<f64> {
                y.clone()
            }

            fn rate(&self, g: &DVector<f64>, v: &DVector<f64>) -> DVector<f64> {
                list(self.0.rate(&self.element(g), &self.vector(v)))
            }

            fn rate_at_projected(
                &self,
                point: &DVector<f64>,
                projected: &DVector<f64>,
                v: &DVector<f64>,
            ) -> DVector<f64> {
                let (point, projected) = (self.element(point), self.element(projected));
                list(self.0.rate_at_projected(&point, &projected, &self.vector(v)))
            }

            fn embedding_dimension(&self) -> usize {
                self.0.embedding_dimension()
            }

            fn is_translation_coordinate(&self, at: usize) -> bool {
                self.0.is_translation_coordinate(at)
            }

            fn has_projection(&self) -> bool {
                self.0.has_projection()
            }
        }

        impl $($parameters)* MatrixNotation for $Group {
            fn write(&self, g: &DVector<f64>) -> DMatrix<f64> {
                self.0.write(&self.element(g))
            }

            fn read(&self, matrix: &DMatrix<f64>) -> Result<DVector<f64>, Error> {
                self.0.read(matrix).map(|g| self.to_element(g))
            }

            fn is_angle(&self, at: usize) -> bool {
                self.0.is_angle(at)
            }

            fn names(&self) -> &'static [&'static str] {
                self.0.names()
            }

            fn named(&self, g: &DVector<f64>, k: usize) -> f64 {
                self.0.named(&self.element(g), k)
            }

            fn entries(&self, g: &DVector<f64>, entries: &mut Vec<f64>) {
                self.0.entries(&self.element(g), entries);
            }

            fn blocks(&self) -> Vec<Block> {
                self.0.blocks()
            }

            fn generators(&self) -> Vec<DMatrix<f64>> {
                self.0.generators()
            }

            fn derivatives(
                &self,
                g: &DVector<f64>,
                entries: &[f64],
                generators: &[Generator],
                partial: &[Partial],
            ) -> DVector<f64> {
                let derivatives = self.0.derivatives(&self.element(g), entries, generators, partial);
                self.to_vector(derivatives)
            }

            fn second_derivative(
                &self,
                g: &DVector<f64>,
                entries: &[f64],
                generators: &[Generator],
                partial: &[Partial],
                v: &DVector<f64>,
            ) -> f64 {
                let (g, v) = (self.element(g), self.vector(v));
                self.0.second_derivative(&g, entries, generators, partial, &v)
            }

            fn log_rounding(&self, g: &DVector<f64>, x: &DVector<f64>) -> Option<f64> {
                self.0.log_rounding(&self.element(g), &self.vector(x))
            }
        }
    };
}

on_lists!([<G: MatrixNotation + TranslationSplit>] Flat<G>);
on_lists!([] AnyGroup);
