//! The tangent operators of exp at one turn and at several turns: singular there, and exact nearby.

use crate::common::{algebras::catalogued, property::properties};
use affinor::group::{
    Coordinates, Heisenberg, Homotheties, LieGroup, MatrixGroup, Nilpotent, Opposite, Product, Se2,
    Se3, Se23, Sl2, So2, So3, Translations,
};
use affinor::{Error, Law, LieAlgebra};
use affinor_tensors::Rational;
use nalgebra::{Const, DMatrix, DVector, Vector2, Vector3};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn norm<V: Coordinates>(x: &V) -> f64 {
    DVector::from_column_slice(x.components()).norm()
}

/// At `x`, where `ad_x` has the eigenvalue `2 pi i k`, both inverses are errors, along any vector.
fn singular<G: LieGroup>(group: &G, x: &[f64], v: &[f64]) {
    let [x, v] = [x, v].map(|v| G::Vector::from_components(&v[..group.dimension()]));
    for vector in [&v, &x] {
        for inverse in
            [group.tangent_left_inverse(&x, vector), group.tangent_right_inverse(&x, vector)]
        {
            assert!(
                matches!(inverse, Err(Error::Broken { law: Law::RegularTangent, .. })),
                "{x:?}: {inverse:?}"
            );
        }
    }
}

/// Near `x`, at a relative distance, both inverses are inverses, up to their condition number.
fn regular<G: LieGroup>(group: &G, x: &[f64], v: &[f64]) {
    let [x, v] = [x, v].map(|v| G::Vector::from_components(&v[..group.dimension()]));
    type Inverse<'i, V> = &'i dyn Fn(&V, &V) -> Result<V, Error>;
    let check = |of: &DMatrix<f64>, image: &G::Vector, inverse: Inverse<G::Vector>| {
        let back = of.clone().try_inverse().unwrap();
        let n = group.dimension() as f64;
        // each entry of the operator has a relative rounding error
        let condition = of.norm() * back.norm() * (1.0 + norm(&x)) * n;
        let found = inverse(&x, image).unwrap();
        // and x has one too
        let moved = [-4.0, 4.0].map(|ulps| {
            let near = inverse(&(x.clone() * (1.0 + ulps * f64::EPSILON)), image).unwrap();
            norm(&(near - found.clone()))
        });
        let off = norm(&(found - v.clone()));
        let bound = 4.0 * f64::EPSILON * condition * norm(&v) + moved[0].max(moved[1]);
        assert!(off <= bound, "{x:?}: off by {off:e}, more than {bound:e}");
        assert!(norm(image).is_finite());
    };
    let of = group.operator_matrix(|v| group.tangent_left(&x, v));
    check(&of, &group.tangent_left(&x, &v), &|x, v| group.tangent_left_inverse(x, v));
    let of = group.operator_matrix(|v| group.tangent_right(&x, v));
    check(&of, &group.tangent_right(&x, &v), &|x, v| group.tangent_right_inverse(x, v));
}

/// Applies a test to groups with rotations: `turn` is the rotation vector, `rest` contains
/// translations and other components.
fn on_each(turn: &Vector3<f64>, rest: &[f64], v: &[f64], at: &dyn Fn(&dyn Check)) {
    let of = |numbers: &[&[f64]]| numbers.concat();
    let (w, angle) = (turn.as_slice(), [turn.norm()]);
    let spin = |e: Vector3<f64>| DMatrix::from_column_slice(3, 3, e.cross_matrix().as_slice());
    let spins = MatrixGroup::new(&[Vector3::x(), Vector3::y(), Vector3::z()].map(spin)).unwrap();
    // E - F generates the rotations of the plane, with half the angle in ad
    let boost = Sl2.exp(&Vector3::new(0.3 * rest[0], 0.3 * rest[1], 0.3 * rest[2]));
    let elliptic = Sl2.adjoint(&boost, &Vector3::new(0.5 * angle[0], -0.5 * angle[0], 0.0));
    at(&On(So3, w.to_vec(), v));
    at(&On(Se3, of(&[w, rest]), v));
    at(&On(Se23, of(&[w, rest]), v));
    at(&On(Se2, of(&[&angle, rest]), v));
    at(&On(Sl2, elliptic.as_slice().to_vec(), v));
    at(&On(Opposite(Se3), of(&[w, rest]), v));
    at(&On(Opposite(Sl2), elliptic.as_slice().to_vec(), v));
    at(&On(Product(Translations(Const::<2>), So3), of(&[&rest[..2], w]), v));
    at(&On(Product(Se2, Heisenberg::<Const<3>>::new()), of(&[&angle, rest]), v));
    at(&On(spins, w.to_vec(), v));
    for name in ["so(3)", "se(3)", "so(3)+R^2", "so(3)+aff(1)"] {
        let algebra: LieAlgebra<f64> = catalogued(name).map(Rational::to_f64).unwrap();
        at(&On(MatrixGroup::of_algebra(&algebra).unwrap(), of(&[w, rest]), v));
    }
}

/// A group and two vectors.
struct On<'v, G>(G, Vec<f64>, &'v [f64]);

trait Check {
    fn singular(&self);
    fn regular(&self);
}

impl<G: LieGroup> Check for On<'_, G> {
    fn singular(&self) {
        singular(&self.0, &self.1, self.2);
    }
    fn regular(&self) {
        regular(&self.0, &self.1, self.2);
    }
}

properties! {
    #![cases(128)]

    #[test]
    fn at_full_turns(
        axis in prop::array::uniform3(-1.0..1.0f64),
        k in 1..4u8,
        rest in prop::collection::vec(-2.0..2.0f64, 8),
        v in prop::collection::vec(-1.0..1.0f64, 12),
    ) {
        let axis = Vector3::from(axis);
        prop_assume!(axis.norm() > 0.1);
        let turn = axis.normalize() * (f64::from(k) * TAU);
        on_each(&turn, &rest, &v, &|on| on.singular());
    }

    #[test]
    fn beside_full_turns(
        axis in prop::array::uniform3(-1.0..1.0f64),
        k in 0..4u8,
        decade in -5.0..-0.5f64,
        below in any::<bool>(),
        rest in prop::collection::vec(-2.0..2.0f64, 8),
        v in prop::collection::vec(-1.0..1.0f64, 12),
    ) {
        let axis = Vector3::from(axis);
        prop_assume!(axis.norm() > 0.1);
        let beside = if below && k > 0 { -1.0 } else { 1.0 } * 10f64.powf(decade);
        let turn = axis.normalize() * ((f64::from(k) + beside) * TAU);
        on_each(&turn, &rest, &v, &|on| on.regular());
    }
}

/// A rotation about a coordinate axis by a full turn has the same answer in each of the groups.
#[test]
fn one_turn_about_an_axis() {
    let (rest, v) = ([0.0, 1.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0], [1.0; 12]);
    for turn in [Vector3::x(), Vector3::y(), Vector3::z()] {
        on_each(&(turn * TAU), &rest, &v, &|on| on.singular());
        // half a turn is regular, and so is zero
        on_each(&(turn * (0.5 * TAU)), &rest, &v, &|on| on.regular());
        on_each(&(turn * 0.0), &rest, &v, &|on| on.regular());
    }
}

/// Groups without rotations, or with commuting ones, do not have singular vectors.
#[test]
fn what_does_not_turn_is_never_singular() {
    let x = [TAU, -TAU, 2.0 * TAU, TAU, 0.5, -TAU];
    let v = [1.0, -2.0, 0.5, 3.0, 1.0, 0.25];
    regular(&So2, &x, &v);
    regular(&Translations(Const::<3>), &x, &v);
    regular(&Heisenberg::<Const<3>>::new(), &x, &v);
    regular(&Heisenberg::<Const<5>>::new(), &x, &v);
    let filiform = crate::common::algebras::by_table(4, &[(1, 2, 3, 1), (1, 3, 4, 1)]);
    regular(&Nilpotent::new(filiform.map(Rational::to_f64).unwrap()).unwrap(), &x, &v);
    // hyperbolic and parabolic vectors of SL(2)
    regular(&Sl2, &[TAU, TAU, 0.0], &v);
    regular(&Sl2, &[TAU, 0.0, 0.0], &v);
}

/// On the group of homotheties `T_left(w, u)(1, 0) = (1, u sum (-w)^k/(k + 2)!)`: to all digits for small and large `w`.
#[test]
fn homotheties_have_all_digits() {
    let line = Homotheties::<Const<2>>::new();
    for w in [0.0, 1e-9, 1e-6, -1e-4, 1e-3, 0.01, -0.1, 0.5, -0.99, 1.01, -2.0_f64] {
        let exact = (3..60).rev().fold(1.0, |rest, k| 1.0 - rest * w / f64::from(k)) / 2.0;
        let image = line.tangent_left(&Vector2::new(w, 3.0), &Vector2::new(1.0, 0.0));
        assert!((image[1] / (3.0 * exact) - 1.0).abs() <= 8.0 * f64::EPSILON, "{w}: {image}");
    }
}
