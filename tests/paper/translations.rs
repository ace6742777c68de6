//! Section 3 on groups: translations, invariant fields, one-parameter groups, (17)-(27).

use crate::paper::matrices::Basis;
use crate::paper::on_groups::{
    column, differ, distance, equal, hat, on_every_group, path, rate, same, vectors,
};
use affinor::Error;
use affinor::group::fields::{InvariantField, Side, right_translate};
use affinor::group::{Coordinates, LieGroup, Sl2, So3, Velocity};
use nalgebra::{Matrix2, UnitQuaternion};

#[test]
fn axiom_of_the_neutral_element_gives_p() {
    // the paper prints `= e`; quaternions with powers of two multiply exactly
    let p = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.5, 0.5, -0.5, 0.5));
    let e = So3.identity();
    assert_eq!((So3.compose(&e, &p), So3.compose(&p, &e)), (p, p));
    assert_ne!(p, e);
    fn law<G: LieGroup>(name: &str, group: &G, _: &Basis) {
        let (e, p) = (group.identity(), group.exp(&vectors(group)[0]));
        let p_matrix = group.matrix(&p);
        same(&group.matrix(&group.compose(&e, &p)), &p_matrix, name);
        same(&group.matrix(&group.compose(&p, &e)), &p_matrix, name);
        assert!(distance(&p_matrix, &group.matrix(&e)) > 0.1, "{name}");
    }
    on_every_group!(law);
}

#[test]
fn eq_17_and_18_translations_multiply_on_their_side() {
    fn law<G: LieGroup>(name: &str, group: &G, _: &Basis) {
        let [g, h, k] = vectors(group).map(|x| group.exp(&x));
        let product = |factors: &[&G::Element]| {
            let ones = group.matrix(&group.identity());
            factors.iter().fold(ones, |product, g| product * group.matrix(g))
        };
        let left = |g: &G::Element, h: &G::Element| group.compose(g, h);
        let right = |g: &G::Element, h: &G::Element| group.compose(h, g);
        same(&group.matrix(&left(&g, &h)), &product(&[&g, &h]), name);
        same(&group.matrix(&right(&g, &h)), &product(&[&h, &g]), name);
        assert!(distance(&product(&[&g, &h]), &product(&[&h, &g])) > 0.01, "{name}");
        // L_g L_h = L_gh, R_g R_h = R_hg
        let twice = group.matrix(&left(&g, &left(&h, &k)));
        same(&twice, &group.matrix(&left(&group.compose(&g, &h), &k)), name);
        let twice = group.matrix(&right(&g, &right(&h, &k)));
        same(&twice, &group.matrix(&right(&group.compose(&h, &g), &k)), name);
        let wrong = group.matrix(&right(&group.compose(&g, &h), &k));
        assert!(distance(&twice, &wrong) > 0.01, "{name}: R_g R_h = R_hg");
    }
    on_every_group!(law);
}

fn field<V>(side: Side, vector: &V) -> InvariantField<V>
where
    V: Clone,
{
    InvariantField { side, vector: vector.clone() }
}

/// The velocity with which a field moves `g`, as a matrix.
fn moving<G: LieGroup>(
    group: &G,
    field: &InvariantField<G::Vector>,
    g: &G::Element,
) -> nalgebra::DMatrix<f64> {
    rate(|t| group.matrix(&field.flow(group, g, t)), 0.0)
}

#[test]
fn eq_19_and_20_left_translation_carries_curves_and_left_invariant_fields() {
    fn law<G: LieGroup>(name: &str, group: &G, _: &Basis) {
        let ([x, y, z], curve) = (vectors(group), path(group));
        let g = group.exp(&y);
        let translated = |t: f64| group.compose(&g, &curve(t));
        let of = |path: &dyn Fn(f64) -> G::Element| Velocity::of_path(group, path, 0.3, 0.02);
        let (there, here) = (of(&translated).unwrap(), of(&curve).unwrap());
        // (19): as matrices G dH/dt; left components stay, right ones do not
        let by_product = group.matrix(&g) * rate(|t| group.matrix(&curve(t)), 0.3);
        same(&rate(|t| group.matrix(&translated(t)), 0.3), &by_product, name);
        equal(&column(&there.body), &column(&here.body), name);
        differ(&column(&there.spatial), &column(&here.spatial), name);
        // (20) for several g and h
        for (g, h) in [(0.5, 1.0), (-1.0, 0.3), (0.8, -0.6)] {
            let (g, h) = (group.exp(&(x.clone() * g)), group.exp(&(y.clone() * h)));
            let gh = group.compose(&g, &h);
            let [left, right] = [Side::Left, Side::Right].map(|side| field(side, &z));
            let carried = |field| group.matrix(&g) * moving(group, field, &h);
            same(&moving(group, &left, &gh), &carried(&left), name);
            assert!(distance(&moving(group, &right, &gh), &carried(&right)) > 1e-3, "{name}");
        }
    }
    on_every_group!(law);
}

#[test]
fn eq_21_and_22_left_frame_is_translated_from_the_identity() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let g = group.exp(&vectors(group)[0]);
        let matrix = group.matrix(&g);
        for (e, unit) in basis.0.iter().zip(group.basis()) {
            same(&moving(group, &field(Side::Left, &unit), &g), &(&matrix * e), name);
            same(&moving(group, &field(Side::Right, &unit), &g), &(e * &matrix), name);
        }
        // (21) for a vector, with its value at g in left components
        let x = &vectors(group)[1];
        let at = field(Side::Right, x).at(group, &g);
        same(&(&matrix * hat(basis, &at)), &(hat(basis, x) * &matrix), name);
        equal(&column(&at), &column(&right_translate(group, x, &g)), name);
    }
    on_every_group!(law);
}

#[test]
fn eq_23_and_24_components_of_vectors_and_of_left_invariant_fields() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let (curve, t) = (path(group), 0.7);
        let v = Velocity::of_path(group, &curve, t, 0.02).unwrap().body;
        let p = group.matrix(&curve(t));
        // v^i(p) e_i(p), with e_i(p) = P E_i
        let frame = basis.0.iter().map(|e| &p * e).zip(v.components());
        let vector = frame.fold(&p * 0.0, |sum, (e, v)| sum + e * *v);
        same(&vector, &rate(|t| group.matrix(&curve(t)), t), name);
        // (24): constant for a left-invariant field alone
        let (left, right) = (field(Side::Left, &v), field(Side::Right, &v));
        assert_eq!(left.at(group, &curve(t)), left.at(group, &group.identity()));
        let (here, there) = (right.at(group, &group.identity()), right.at(group, &curve(t)));
        differ(&column(&there), &column(&here), name);
    }
    on_every_group!(law);
}

#[test]
fn eq_25_one_parameter_groups() {
    fn law<G: LieGroup>(name: &str, group: &G, _: &Basis) {
        let [x, y, _] = vectors(group);
        let g = |t: f64| group.exp(&(x.clone() * t));
        for (t, s) in [(0.3, 1.1), (-0.8, 0.5), (2.0, 1.5)] {
            let sum = group.matrix(&g(t + s));
            same(&group.matrix(&group.compose(&g(t), &g(s))), &sum, name);
            same(&group.matrix(&group.compose(&g(s), &g(t))), &sum, name);
        }
        // not of two directions
        let product = group.matrix(&group.compose(&g(1.0), &group.exp(&y)));
        assert!(distance(&group.matrix(&group.exp(&(x.clone() + y))), &product) > 1e-3, "{name}");
    }
    on_every_group!(law);
}

#[test]
fn eq_26_the_exponential_of_the_derivative_at_the_identity() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        for x in vectors(group) {
            let g = |t: f64| group.matrix(&group.exp(&(x.clone() * t)));
            same(&rate(g, 0.0), &hat(basis, &x), name);
            for t in [-2.0, 0.4, 1.0, 3.0] {
                same(&g(t), &(hat(basis, &x) * t).exp(), name);
            }
        }
    }
    on_every_group!(law);
    // not every element is an exponential
    let refused = Sl2.log(&Matrix2::new(-2.0, 0.0, 0.0, -0.5));
    assert!(matches!(refused, Err(Error::Invalid { what: "logarithm", .. })));
}

#[test]
fn eq_27_and_70_the_derivative_is_both_left_and_right_translated() {
    fn law<G: LieGroup>(name: &str, group: &G, basis: &Basis) {
        let [x, _, _] = vectors(group);
        for t in [-1.0, 0.6, 2.0] {
            let g = |t: f64| group.exp(&(x.clone() * t));
            let (derivative, matrix) = (rate(|t| group.matrix(&g(t)), t), group.matrix(&g(t)));
            same(&derivative, &(&matrix * hat(basis, &x)), name);
            same(&derivative, &(hat(basis, &x) * &matrix), name);
            let velocity = Velocity::of_path(group, g, t, 0.02).unwrap();
            equal(&column(&velocity.body), &column(&x), name);
            equal(&column(&velocity.spatial), &column(&x), name);
        }
        // of another curve the two differ
        let velocity = Velocity::of_path(group, path(group), 1.2, 0.02).unwrap();
        differ(&column(&velocity.body), &column(&velocity.spatial), name);
    }
    on_every_group!(law);
}
