//! Conserved quantities are exact, and wrong ones are errors with a witness.

use super::{Curve, SPHERE, near, refused};

#[test]
fn the_rotations_of_the_sphere_are_conserved() {
    let more = "[killing.fields]\n\
        Lx = \"-sin(phi)*d_theta - cos(theta)/sin(theta)*cos(phi)*d_phi\"\n\
        Ly = \"cos(phi)*d_theta - cos(theta)/sin(theta)*sin(phi)*d_phi\"\n\
        Lz = \"d_phi\"\n[killing.tensors]\nsquare = [1, \"sin(theta)^2\"]";
    let found = Curve { more, ..SPHERE }.rows();
    assert_eq!(found.conserved, ["norm", "p_phi", "Lx", "Ly", "Lz", "square"]);
    found.keeps_all(1e-10);
    let [x, y, z, square] = ["Lx", "Ly", "Lz", "square"].map(|name| found.last(name));
    near(x * x + y * y + z * z, square, 1e-10);
}

#[test]
fn a_field_that_is_not_killing_is_an_error_with_a_term() {
    let more = "[killing.fields]\nK = \"theta*d_theta\"";
    let message = refused(&Curve { more, ..SPHERE }.text());
    assert!(message.starts_with("K is not conserved"), "{message}");
    assert!(message.contains("(1)*v_theta*v_theta"), "{message}");
    let more = "[killing.tensors]\nK = [[1, 1], [0, 1]]";
    let message = refused(&Curve { more, ..SPHERE }.text());
    assert!(message.contains("is not symmetric"), "{message}");
    let more = "[killing.tensors]\nK = [[1, 1, 0], [0, 1]]";
    let message = refused(&Curve { more, ..SPHERE }.text());
    assert!(message.contains("the tensor has 2 rows of 2 or 3 entries"), "{message}");
}

/// A potential breaks the symmetries that it does not have.
#[test]
fn a_potential_breaks_symmetries() {
    let more = "[forces]\npotential = \"cos(theta)\"";
    let found = Curve { more, ..SPHERE }.rows();
    assert_eq!(found.conserved, ["energy", "p_phi"]);
    found.keeps_all(1e-10);
    let more = "[forces]\npotential = \"sin(theta)*cos(phi)\"";
    let found = Curve { more, ..SPHERE }.rows();
    assert_eq!(found.conserved, ["energy"]);
    found.keeps_all(1e-10);
    let more = "[forces]\npotential = \"sin(theta)*cos(phi)\"\n[killing.fields]\nLz = \"d_phi\"";
    let message = refused(&Curve { more, ..SPHERE }.text());
    assert!(message.contains("Lz is not conserved"), "{message}");
}

/// A geometry in a frame has the same curves as in the coordinates.
#[test]
fn a_frame_does_not_change_the_curve() {
    let frame =
        "metric = \"identity\"\n[definition.frame]\ne1 = \"d_theta\"\ne2 = \"1/sin(theta)*d_phi\"";
    let more = "[killing.fields]\nLz = \"sin(theta)*e2\"";
    let framed = Curve { geometry: frame, more, ..SPHERE }.rows();
    let plain = SPHERE.rows();
    for name in ["theta", "phi", "v_theta", "v_phi", "p_phi", "length"] {
        near(framed.last(name), plain.last(name), 1e-13);
    }
    near(framed.last("Lz"), framed.last("p_phi"), 1e-13);
}

#[test]
fn names_and_keys_are_checked() {
    let with = |more: &str| refused(&Curve { more, ..SPHERE }.text());
    for (more, part) in [
        ("[killing.fields]\nphi = \"d_phi\"", "the name is already in use"),
        ("[parameters]\nv_phi = 1", "already in use"),
        ("normalize = \"timelike\"", "the metric has no time direction: its signature is (2, 0)"),
        ("normalize = \"null\"", "a null velocity needs a component that is not given"),
        ("normalize = \"fast\"", "is not a normalization"),
        ("solve = \"phi\"", "`solve` needs `normalize`"),
        ("momentum = [1, 2]", "a curve on a chart has no `momentum`"),
        ("[forces]\nbody = [1, 2]", "a curve on a chart has no `body`"),
        ("[forces]\npotential = \"k\"", "`k` is neither"),
    ] {
        let message = with(more);
        assert!(message.contains(part), "{part}: {message}");
    }
    let text = SPHERE.text();
    for (old, new, part) in [
        ("theta = 1.1, phi = 0.4", "theta = 1.1", "the initial coordinate `phi` is missing"),
        ("phi = 0.9", "psi = 0.9", "`psi` is not a coordinate"),
        (
            "tolerance = 1e-12",
            "method = \"rkmk4\"\nstep = 0.1",
            "curves on a chart need one of dop853",
        ),
        ("tolerance = 1e-12", "step = 0.1", "the method dop853 has no `step`"),
        ("sin(theta)^2", "sin(theta)^2*k", "`k`"),
    ] {
        let message = refused(&text.replacen(old, new, 1));
        assert!(message.contains(part), "{part}: {message}");
    }
    let group =
        "space = \"so3\"\nmetric = \"identity\"\ninitial.velocity = { x = 1 }\noutput.end = 1";
    assert!(refused(group).contains("has no coordinates"), "{}", refused(group));
    let group = "space = \"so3\"\nmetric = \"identity\"\ninitial.velocity = [1, 0, 0]\noutput.end = 1\nembedding = [\"1\", \"2\"]";
    assert!(
        refused(group).contains("a motion on a group has no `embedding`"),
        "{}",
        refused(group)
    );
}

#[test]
fn the_embedding_maps_the_curve() {
    let text = SPHERE.text();
    let text =
        text.replace("[output]\n", "[output]\ncolumns = [\"embedding\", \"theta\", \"phi\"]\n");
    let text = format!(
        "embedding = [\"sin(theta)*cos(phi)\", \"sin(theta)*sin(phi)\", \"cos(theta)\"]\n{text}"
    );
    let found = super::rows(&text);
    for k in 0..found.rows.len() {
        let of = |name: &str| found.column(name)[k];
        near(of("X1"), of("theta").sin() * of("phi").cos(), 1e-15);
        near(of("X2"), of("theta").sin() * of("phi").sin(), 1e-15);
        near(of("X3"), of("theta").cos(), 1e-15);
    }
}
