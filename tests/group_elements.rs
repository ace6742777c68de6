//! Elements as numbers, elements brought back to the group, and `Ad*`, on every group.

use affinor::group::{
    Coordinates, Embedded, Heisenberg, LieGroup, Opposite, Se2, Se3, Se23, Sl2, So2, So3,
};
use nalgebra::{DVector, SVector, UnitQuaternion, Vector2, Vector3, Vector6};

/// The covector that a group's own `Ad*` gives is that of `Ad`; elements that are off the group come back.
#[test]
fn coadjoint_and_restored() {
    fn check<G: LieGroup>(group: G, x: &G::Vector, grown: impl Fn(G::Element) -> G::Element) {
        let g = group.exp(x);
        for i in 0..group.dimension() {
            let h = group.unit(i) * 2.0 + x.clone();
            let h = group.coadjoint(&g, &h).components().to_vec();
            let expected = group.operator(|v| group.adjoint(&g, v)).transpose()
                * DVector::from_column_slice((group.unit(i) * 2.0 + x.clone()).components());
            assert!((DVector::from_vec(h) - expected).amax() < 1e-14);
        }
        // up to where the series of small angles end, and beyond
        for size in [1e-3, 0.3, 1.0, 30.0] {
            let (x, h) = (x.clone() * size, group.unit(0) * 2.0 + x.clone());
            let off = group.coadjoint_exp(&x, &h) - group.coadjoint(&group.exp(&x), &h);
            let scale = 1.0 + group.matrix(&group.exp(&x)).amax().powi(2);
            assert!(off.largest() < 1e-14 * scale, "{x:?}: {off:?}");
        }
        let restored = group.restored(grown(g.clone()));
        assert!((group.matrix(&restored) - group.matrix(&g)).amax() < 1e-15);
    }
    let grown = |q: UnitQuaternion<f64>| UnitQuaternion::new_unchecked(q.into_inner() * 1.001);
    check(So3, &Vector3::new(0.3, -1.0, 2.0), grown);
    check(Se3, &Vector6::new(0.3, -1.0, 2.0, 0.5, 0.6, -0.7), |mut g| {
        g.rotation = grown(g.rotation);
        g
    });
    check(Se23, &SVector::from_fn(|i, _| 0.3 * i as f64 - 0.8), |mut g| {
        g.attitude = grown(g.attitude);
        g
    });
    check(Sl2, &Vector3::new(0.3, -0.5, 0.2), |g| g * 1.001);
    check(Heisenberg::<3>, &Vector3::new(0.3, -0.5, 0.2), |g| g);
    let x = Vector2::new(1.0, 2.0);
    check(Se2, &Vector3::new(0.3, x.x, x.y), |mut g| {
        g.rotation = nalgebra::UnitComplex::new_unchecked(g.rotation.into_inner() * 1.001);
        g
    });
}

/// Numbers of elements make them again, and change as differences say, of right-invariant systems as well.
#[test]
fn numbers_of_elements() {
    fn check<G: Embedded>(group: G) {
        let x = G::Vector::from_fn(group.dimension(), |i| [0.3, -0.5, 0.2, 0.7][i % 4]);
        let v = G::Vector::from_fn(group.dimension(), |i| [0.4, 0.1, -0.6][i % 3]);
        let g = group.exp(&x);
        let again = group.from_numbers(&group.numbers(&g));
        assert_eq!(group.matrix(&again), group.matrix(&g));
        let at = |t: f64| group.numbers(&group.compose(&g, &group.exp(&(v.clone() * t))));
        let step = 1e-4;
        // Richardson's extrapolation of central differences
        let difference = |h: f64| (at(h) - at(-h)) * (0.5 / h);
        let slope = difference(step) * (4.0 / 3.0) - difference(2.0 * step) * (1.0 / 3.0);
        let off = slope - group.rate(&g, &v);
        assert!(off.largest() < 1e-11, "{off:?}");
    }
    check(So2);
    check(So3);
    check(Se2);
    check(Se3);
    check(Se23);
    check(Sl2);
    check(Heisenberg::<5>);
    check(Opposite(So3));
    check(Opposite(Se3));
    check(Opposite(Sl2));
}
