//! Cohomology of invariant forms against the Betti numbers of the literature, and ranks of symmetric
//! spaces.

use affinor::geometry::homogeneous::HomogeneousSpace;

fn find(name: &str) -> HomogeneousSpace {
    HomogeneousSpace::find(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Real Betti numbers: spheres, projective spaces, flags (Weyl groups by length), Grassmannians
/// (Schubert cells), and the Aloff-Wallach spaces, which are rational `S^2 x S^5`.
#[test]
fn betti_numbers() {
    let cases: [(&str, &[usize]); 13] = [
        ("S^2", &[1, 0, 1]),
        ("S^5", &[1, 0, 0, 0, 0, 1]),
        ("S^7 = Sp(2)/Sp(1)", &[1, 0, 0, 0, 0, 0, 0, 1]),
        ("S^6 = G2/SU(3)", &[1, 0, 0, 0, 0, 0, 1]),
        ("CP^2", &[1, 0, 1, 0, 1]),
        ("CP^3 = Sp(2)/Sp(1)xU(1)", &[1, 0, 1, 0, 1, 0, 1]),
        ("HP^2", &[1, 0, 0, 0, 1, 0, 0, 0, 1]),
        ("Fl(3)", &[1, 0, 2, 0, 2, 0, 1]),
        ("Gr(2,C^4)", &[1, 0, 1, 0, 2, 0, 1, 0, 1]),
        ("Gr(2,R^4)", &[1, 0, 2, 0, 1]),
        ("V(2,R^5)", &[1, 0, 0, 0, 0, 0, 0, 1]),
        ("SU(3)/U(1)_{1,1}", &[1, 0, 1, 0, 0, 1, 0, 1]),
        ("SU(3)/SO(3)", &[1, 0, 0, 0, 0, 1]),
    ];
    for (name, betti) in cases {
        let forms = find(name).pair().differential_forms().unwrap().unwrap();
        assert_eq!(forms.betti, betti, "{name}");
        // the alternating sums of forms and of cohomology agree
        let signed = forms.dimensions.iter().enumerate();
        let sum: i64 = signed.map(|(k, d)| if k % 2 == 0 { *d as i64 } else { -(*d as i64) }).sum();
        assert_eq!(sum, forms.euler_characteristic(), "{name}");
    }
    // in 4 dimensions and more V(2,R^n) is not a rational sphere
    let forms = find("V(2,R^4)").pair().differential_forms().unwrap().unwrap();
    assert_eq!(forms.betti, [1, 0, 1, 1, 0, 1]);
    assert!(find("OP^2").pair().differential_forms().unwrap().is_none());
}

/// A symmetric space has parallel forms: every invariant form is closed.
#[test]
fn invariant_forms_of_symmetric_spaces_are_closed() {
    for name in ["S^4", "CP^3", "HP^2", "Gr(2,R^5)", "SU(4)/SO(4)", "SU(3)xSU(3)/SU(3)"] {
        let forms = find(name).pair().differential_forms().unwrap().unwrap();
        assert_eq!(forms.betti, forms.dimensions, "{name}");
    }
}

/// S. Helgason, *Differential Geometry, Lie Groups, and Symmetric Spaces*, table V of chapter X.
#[test]
fn ranks_of_symmetric_spaces() {
    for (name, rank) in [
        ("S^4", Some(1)),
        ("H^3", Some(1)),
        ("CP^3", Some(1)),
        ("HP^2", Some(1)),
        ("OP^2", Some(1)),
        ("SU(3)/SO(3)", Some(2)),
        ("SL(3,R)/SO(3)", Some(2)),
        ("SU(4)/SO(4)", Some(3)),
        ("SU(4)/Sp(2)", Some(1)),
        ("Gr(2,R^5)", Some(2)),
        ("Gr(2,C^4)", Some(2)),
        ("Sp(2)/U(2)", Some(2)),
        ("G2/SO(4)", Some(2)),
        ("SU(3)xSU(3)/SU(3)", Some(2)),
        ("SE(3)/SO(3)", Some(3)),
        ("Fl(3)", None),
    ] {
        assert_eq!(find(name).pair().rank().unwrap(), rank, "{name}");
    }
}
