//! The translations of a group, which integrators treat separately.

use super::{Coordinates, LieGroup};

/// The splitting `g = K + V` of an algebra `g` into an abelian ideal `V` of translations and a
/// complementary subalgebra `K`.
///
/// Integrators of bodies treat `V` linearly, so that the momentum about the body depends neither on
/// the position of the origin nor on a uniform motion of the frame. A group with an empty
/// implementation (`impl TranslationSplit for MyGroup {}`) has no translations.
/// [`laws::translations`](super::laws::translations) checks the implementation.
///
/// ```
/// use affinor::group::{Se3, So3, TranslationSplit};
/// use nalgebra::{Vector3, Vector6};
/// // on SE(3) P (w, u) = (0, u)
/// let twist = Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
/// assert_eq!(Se3.translational_part(&twist), Some(Vector6::new(0.0, 0.0, 0.0, 4.0, 5.0, 6.0)));
/// assert_eq!(So3.translational_part(&Vector3::x()), None);
/// ```
pub trait TranslationSplit: LieGroup {
    /// The translational part `P x` of a vector. `P` is the projection onto an abelian ideal `V`
    /// along a subalgebra `K`, where `g = K + V`. Returns `None` if the group has no such ideal.
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        let _ = x;
        None
    }

    /// Whether the group has [translations](Self::translational_part). For vectors of a fixed size,
    /// the result is a constant, so that no code for translations is compiled if the group has
    /// none.
    #[inline]
    fn has_translations(&self) -> bool {
        self.translational_part(&Self::Vector::zeros(self.dimension())).is_some()
    }

    /// The translational part `P* h` of a covector, which is dual to the
    /// [translations](Self::translational_part): `(P* h)(x) = h(P x)`. Returns `None` if the group
    /// has no translations.
    fn translational_momentum(&self, h: &Self::Vector) -> Option<Self::Vector> {
        self.has_translations().then(|| {
            Self::Vector::from_fn(self.dimension(), |i| {
                let translation = self.translational_part(&self.basis_vector(i));
                let products =
                    translation.iter().flat_map(|x| x.components().iter().zip(h.components()));
                products.map(|(x, h)| h * x).sum()
            })
        })
    }

    /// The factor `k` of `g = exp(y) k`, with `y` in the ideal `V` and `k` in the group of `K`. On
    /// SE(3), the factor is the rotation. If the group has no translations, the factor is the
    /// element itself.
    fn linear_part(&self, g: &Self::Element) -> Self::Element {
        g.clone()
    }

    /// The coadjoint action `Ad*_(k^-1) h` of a [linear part](Self::linear_part) `k`. It transforms
    /// the covector `h` from body to spatial axes.
    #[inline]
    fn coadjoint_inverse(&self, k: &Self::Element, h: &Self::Vector) -> Self::Vector {
        self.coadjoint(&self.inverse(k), h)
    }

    /// The linear part `k_g^-1 k_h` from `g` to `h`, where `k_g` and `k_h` are the [linear
    /// parts](Self::linear_part) of `g` and `h`.
    #[inline]
    fn relative_linear_part(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        self.compose(&self.inverse(&self.linear_part(g)), &self.linear_part(h))
    }

    /// Whether `Ad_k` is bounded for every [linear part](Self::linear_part) `k`, as for rotations.
    /// If `Ad_k` is unbounded, a spatial momentum loses accuracy when it is transformed back to the
    /// body.
    fn has_bounded_adjoint(&self) -> bool {
        false
    }
}
