//! Mass properties: shapes compared with textbooks and each other, meshes with shapes and cubature;
//! invalid files.
//!
//! Guards `definition::mesh` and `mechanics::bodies::mass`.

use crate::common::property::properties;
use affinor::Error;
use affinor::mechanics::{Inertia, MassProperties, Mesh};
use affinor_documents::input::{mesh, read_mesh};
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3, Vector6};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::PI;

type Corners = Vec<[Vector3<f64>; 3]>;

fn vector(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

#[track_caller]
fn near(found: &Matrix3<f64>, expected: &Matrix3<f64>, tolerance: f64) {
    let off = (found - expected).norm() / expected.norm();
    assert!(off <= tolerance, "{found}and {expected}differ by {off:e}");
}

#[track_caller]
fn same(a: &MassProperties, b: &MassProperties, tolerance: f64) {
    assert!((a.mass() / b.mass() - 1.0).abs() <= tolerance, "{} and {}", a.mass(), b.mass());
    let size = (b.inertia_matrix().norm() / b.mass()).sqrt() + b.centre().norm();
    let off = (a.centre() - b.centre()).norm();
    assert!(off <= tolerance * size, "{} and {} differ by {off:e}", a.centre(), b.centre());
    near(&a.inertia_matrix(), &b.inertia_matrix(), tolerance);
}

fn diagonal(x: f64, y: f64, z: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&vector(x, y, z))
}

/// `sum m X~^T X~` (12), as in the paper.
fn by_definition(masses: &[(f64, Vector3<f64>)], point: &Vector3<f64>) -> Matrix3<f64> {
    let spin = |x: &Vector3<f64>| (x - point).cross_matrix();
    masses.iter().map(|(m, x)| spin(x).transpose() * spin(x) * *m).sum()
}

/// The six faces of a box from the origin to a corner, as twelve triangles.
fn box_triangles(edges: &Vector3<f64>) -> Corners {
    let corner = |bits: usize| {
        let on = |bit: usize| if bits >> bit & 1 == 1 { edges[bit] } else { 0.0 };
        vector(on(0), on(1), on(2))
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    halves.map(|triangle| triangle.map(corner)).collect()
}

fn solid(corners: Corners) -> MassProperties {
    Mesh::from_triangles(corners).unwrap().mass_properties()
}

fn moved(corners: &Corners, motion: &Isometry3<f64>) -> Corners {
    let move_one = |x: Vector3<f64>| motion.rotation * x + motion.translation.vector;
    corners.iter().map(|triangle| triangle.map(move_one)).collect()
}

/// Moments of shapes in F. P. Beer and E. R. Johnston, *Vector Mechanics for Engineers: Dynamics*,
/// appendix B.
#[test]
fn shapes_are_those_of_the_textbook() {
    let (a, b, c, m) = (0.7, 1.3, 2.1, 3.5);
    let third = 1.0 / 12.0;
    let body = MassProperties::cuboid(&vector(a, b, c)).unwrap();
    assert!((body.mass() - a * b * c).abs() < 1e-15);
    let expected = diagonal(b * b + c * c, a * a + c * c, a * a + b * b) * (m * third);
    near(&body.of_mass(m).unwrap().inertia_matrix(), &expected, 1e-15);

    let body = MassProperties::ellipsoid(&vector(a, b, c)).unwrap();
    assert!((body.mass() - 4.0 / 3.0 * PI * a * b * c).abs() < 1e-14);
    let expected = diagonal(b * b + c * c, a * a + c * c, a * a + b * b) * (m / 5.0);
    near(&body.of_mass(m).unwrap().inertia_matrix(), &expected, 1e-15);

    let ball = MassProperties::ball(b).unwrap().of_density(2.0).unwrap();
    assert!((ball.mass() - 8.0 / 3.0 * PI * b.powi(3)).abs() < 1e-13);
    near(&ball.inertia_matrix(), &(Matrix3::identity() * (0.4 * ball.mass() * b * b)), 1e-15);

    let body = MassProperties::cylinder(a, c).unwrap();
    assert!((body.mass() - PI * a * a * c).abs() < 1e-14);
    let across = m * third * (3.0 * a * a + c * c);
    let expected = diagonal(across, across, 0.5 * m * a * a);
    near(&body.of_mass(m).unwrap().inertia_matrix(), &expected, 1e-15);

    let rod = MassProperties::rod(c).unwrap().of_mass(m).unwrap();
    near(&rod.inertia_matrix(), &(diagonal(1.0, 1.0, 0.0) * (m * third * c * c)), 1e-15);
    let end = rod.inertia_matrix_about(&vector(0.0, 0.0, 0.5 * c));
    near(&end, &(diagonal(1.0, 1.0, 0.0) * (m * c * c / 3.0)), 1e-15);
    // about its end a rotation about itself still has no inertia; about a point next to it the
    // inertia is positive
    assert!(matches!(rod.inertia(), Err(Error::Invalid { what: "inertia", .. })));
    assert!(rod.inertia_about(&Vector3::x()).is_ok());
    // so it is not a rigid body: wherever it is, a rotation about itself needs no energy
    for turn in [Vector3::zeros(), vector(0.3, -0.5, 0.2), vector(1.0, 1.0, -2.0)] {
        let beside = rod.moved(&Isometry3::new(vector(1.0, 2.0, 3.0), turn));
        assert!(matches!(beside.inertia(), Err(Error::Invalid { what: "inertia", .. })), "{turn}");
        assert!(matches!(beside.metric(), Err(Error::Invalid { what: "inertia", .. })), "{turn}");
    }
}

/// The heavy top of Bruels, Cardona and Arnold: moments about the fixed point by Steiner.
#[test]
fn a_top_about_its_point() {
    let about_centre = diagonal(0.234375, 0.46875, 0.234375);
    let top = MassProperties::new(15.0, Vector3::y(), &about_centre).unwrap();
    let moments = vector(15.234375, 0.46875, 15.234375);
    assert_eq!(top.inertia_about(&Vector3::zeros()).unwrap().principal_moments(), &moments);
    assert_eq!(top.inertia().unwrap(), Inertia::new(&about_centre).unwrap());
}

#[test]
fn impossible_inertias_are_refused_with_the_reason() {
    let refused = |x: f64, y: f64, z: f64| {
        MassProperties::new(1.0, Vector3::zeros(), &diagonal(x, y, z)).unwrap_err().to_string()
    };
    let reason = "invalid inertia: moments 1, 1, 3: no body has these moments, because 3 > 1 + 1";
    assert_eq!(refused(1.0, 1.0, 3.0), reason);
    assert_eq!(refused(3.0, 1.0, 1.0), reason);
    assert!(refused(-1.0, 1.0, 1.0).contains("1 > -1 + 1"));
    assert!(refused(-1.0, -1.0, -3.0).contains("no body has these moments"));
    assert!(refused(0.0, 0.0, 1e-300).contains("no body has these moments"));
    assert_eq!(
        refused(f64::NAN, 1.0, 1.0),
        "invalid inertia: the matrix is not symmetric: entries differ by NaN"
    );
    assert!(Inertia::new(&diagonal(f64::NAN, 1.0, 1.0)).is_err());
    assert!(Inertia::new(&diagonal(f64::INFINITY, 1.0, 1.0)).is_err());
    let inertia = Inertia::diagonal(&vector(1.0, 1.0, 3.0)).unwrap();
    assert_eq!(inertia.require_physical().unwrap_err().to_string(), reason);
    // a plate and a point are valid bodies, also if their moments have rounding errors
    let plate = diagonal(1.0, 2.0, 3.0);
    assert!(MassProperties::new(1.0, Vector3::zeros(), &plate).is_ok());
    let turn = UnitQuaternion::new(vector(0.3, -1.0, 0.5)).to_rotation_matrix();
    assert!(MassProperties::new(1.0, Vector3::zeros(), &(turn * plate * turn.transpose())).is_ok());
    assert!(MassProperties::new(1.0, Vector3::zeros(), &Matrix3::zeros()).is_ok());
    let skew = Matrix3::new(2.0, 0.1, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0);
    let skew = MassProperties::new(1.0, Vector3::zeros(), &skew).unwrap_err();
    assert_eq!(
        skew.to_string(),
        "invalid inertia: the matrix is not symmetric: entries differ by 0.1"
    );
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(MassProperties::new(mass, Vector3::zeros(), &plate).is_err(), "{mass}");
        assert!(MassProperties::points(&[(mass, Vector3::x())]).is_err(), "{mass}");
        assert!(MassProperties::ball(mass).is_err(), "{mass}");
        assert!(MassProperties::ball(1.0).unwrap().of_density(mass).is_err(), "{mass}");
        assert!(MassProperties::ball(1.0).unwrap().of_mass(mass).is_err(), "{mass}");
    }
    assert!(MassProperties::points(&[]).is_err());
    assert!(matches!(MassProperties::ball(1e150), Err(Error::Overflow { .. })));
    assert!(MassProperties::ball(1e-150).is_err());
    // a hole larger than the body, and a hole next to it
    let (small, large) = (MassProperties::ball(0.5).unwrap(), MassProperties::ball(1.0).unwrap());
    assert!(small.subtract(&large).is_err());
    let beside = small.moved(&Isometry3::translation(5.0, 0.0, 0.0));
    assert!(large.subtract(&beside).unwrap_err().to_string().contains("no body has these moments"));
}

#[test]
fn a_shell_is_a_ball_without_a_ball() {
    let (r, s) = (1.0, 0.8);
    let [outer, inner] = [r, s].map(|radius| MassProperties::ball(radius).unwrap());
    let shell = outer.subtract(&inner).unwrap();
    let factor = (r.powi(5) - s.powi(5)) / (r.powi(3) - s.powi(3));
    near(&shell.inertia_matrix(), &(Matrix3::identity() * (0.4 * shell.mass() * factor)), 1e-14);
    same(&(shell + inner), &outer, 1e-14);
    // the remaining body may be a point
    let point = MassProperties::points(&[(1.0, vector(0.1, 0.2, 0.3))]).unwrap();
    let left = (outer + point).subtract(&outer).unwrap();
    assert!((left.mass() - 1.0).abs() < 1e-14 && left.inertia_matrix().norm() < 1e-13);
}

/// An approximate sphere: each triangle of an octahedron is divided in four, and its vertices are
/// projected to the sphere.
fn sphere(divisions: usize) -> Corners {
    let mut corners: Corners = vec![];
    for signs in 0..8 {
        let sign = |bit: usize| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 };
        let [x, y, z] = [0, 1, 2].map(|i| {
            let mut e = Vector3::zeros();
            e[i] = sign(i);
            e
        });
        let turned = sign(0) * sign(1) * sign(2) < 0.0;
        corners.push(if turned { [x, z, y] } else { [x, y, z] });
    }
    for _ in 0..divisions {
        let between = |a: &Vector3<f64>, b: &Vector3<f64>| (a + b).normalize();
        corners = corners
            .iter()
            .flat_map(|[a, b, c]| {
                let (ab, bc, ca) = (between(a, b), between(b, c), between(c, a));
                [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
            })
            .collect();
    }
    corners
}

#[test]
fn a_divided_octahedron_becomes_a_ball() {
    let ball = MassProperties::ball(1.0).unwrap();
    let off = |divisions: usize| {
        let body = solid(sphere(divisions));
        assert!(body.centre().norm() < 1e-15);
        let moments = body.inertia_matrix() - ball.inertia_matrix();
        (ball.mass() - body.mass(), moments.norm())
    };
    let errors: Vec<_> = (3..=5).map(off).collect();
    for pair in errors.windows(2) {
        // the error is of second order, and the volume is too small
        assert!((pair[0].0 / pair[1].0 - 4.0).abs() < 0.1, "{errors:?}");
        assert!((pair[0].1 / pair[1].1 - 4.0).abs() < 0.1, "{errors:?}");
    }
    // the octahedron: V = 4/3, J = 2/15 I
    let octahedron = solid(sphere(0));
    assert!((octahedron.mass() - 4.0 / 3.0).abs() < 1e-15);
    near(&octahedron.inertia_matrix(), &(Matrix3::identity() * (4.0 / 15.0)), 1e-15);
}

/// A cavity has its triangles in the opposite orientation; the solid part does not depend on the
/// position of the mesh.
#[test]
fn meshes_may_have_cavities_and_be_far_out() {
    let (outer, inner) = (vector(3.0, 2.0, 4.0), vector(1.0, 0.5, 2.0));
    let shift = Isometry3::translation(0.5, 0.75, 1.0);
    let mut corners = box_triangles(&outer);
    let cavity = moved(&box_triangles(&inner), &shift);
    corners.extend(cavity.iter().map(|[a, b, c]| [*a, *c, *b]));
    let place = |edges: &Vector3<f64>| Isometry3::from(Translation3::from(edges * 0.5));
    let whole = MassProperties::cuboid(&outer).unwrap().moved(&place(&outer));
    let part = MassProperties::cuboid(&inner).unwrap().moved(&(shift * place(&inner)));
    let body = whole.subtract(&part).unwrap();
    same(&solid(corners.clone()), &body, 1e-14);
    let far = Isometry3::translation(1e5, -2e5, 3e5);
    near(&solid(moved(&corners, &far)).inertia_matrix(), &body.inertia_matrix(), 1e-10);
}

fn vectors(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

fn motions() -> impl Strategy<Value = Isometry3<f64>> {
    (vectors(3.0), vectors(2.0)).prop_map(|(x, turn)| Isometry3::new(x, turn))
}

fn masses() -> impl Strategy<Value = Vec<(f64, Vector3<f64>)>> {
    vec((0.1..3.0, vectors(2.0)), 4..9)
}

/// The body as masses at the four points of the cubature of degree 2 on a tetrahedron (P. C. Hammer and A. H. Stroud, *Math.
/// Tables Aids Comput.* 10 (1956) 137-139), which has its mass, centre and inertia exactly.
fn cubature(corners: &[Vector3<f64>; 4]) -> Option<MassProperties> {
    let [a, b, c, d] = corners;
    let volume = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
    let beta = (5.0 - 5.0_f64.sqrt()) / 20.0;
    let sum = a + b + c + d;
    let point = |x: &Vector3<f64>| (volume.abs() / 4.0, sum * beta + x * (1.0 - 4.0 * beta));
    MassProperties::points(&corners.each_ref().map(point)).ok().filter(|_| volume.abs() > 1e-3)
}

/// The faces of a tetrahedron, oriented outwards.
fn tetrahedron([a, b, c, d]: [Vector3<f64>; 4]) -> Corners {
    let [b, c] = if (b - a).cross(&(c - a)).dot(&(d - a)) > 0.0 { [b, c] } else { [c, b] };
    vec![[a, c, b], [a, b, d], [b, c, d], [c, a, d]]
}

properties! {
    #![cases(256)]

    #[test]
    fn point_masses_by_definition(masses in masses(), point in vectors(3.0), motion in motions()) {
        let body = MassProperties::points(&masses).unwrap();
        let about = by_definition(&masses, &point);
        near(&body.inertia_matrix_about(&point), &about, 1e-13);
        near(&body.inertia_matrix(), &by_definition(&masses, body.centre()), 1e-12);
        let elsewhere = |(m, x): &(f64, Vector3<f64>)| (*m, motion.rotation * x + motion.translation.vector);
        let turned: Vec<_> = masses.iter().map(elsewhere).collect();
        same(&MassProperties::points(&turned).unwrap(), &body.moved(&motion), 1e-12);
        // in any order, and for any two parts
        let (some, others) = masses.split_at(2);
        let [some, others] = [some, others].map(|part| MassProperties::points(part).unwrap());
        same(&(others + some), &body, 1e-12);
        same(&body.subtract(&some).unwrap(), &others, 1e-9);
        prop_assert!(body.inertia().unwrap().is_physical());
        // a body with these moments of inertia has the moments of the original body
        let again = MassProperties::new(body.mass(), *body.centre(), &body.inertia_matrix()).unwrap();
        same(&again, &body, 1e-12);
    }

    /// `G(xi, xi) = sum m |v + Omega x X|^2` on se(3).
    #[test]
    fn the_metric_is_twice_the_kinetic_energy(masses in masses(), turn in vectors(2.0), v in vectors(2.0)) {
        let metric = MassProperties::points(&masses).unwrap().metric().unwrap();
        let xi = Vector6::new(turn.x, turn.y, turn.z, v.x, v.y, v.z);
        let lowered = metric.lower(xi.as_slice()).unwrap();
        let found: f64 = lowered.iter().zip(xi.iter()).map(|(h, x)| h * x).sum();
        let expected: f64 = masses.iter().map(|(m, x)| m * (v + turn.cross(x)).norm_squared()).sum();
        prop_assert!((found - expected).abs() <= 1e-12 * (1.0 + expected), "{} {}", found, expected);
    }

    #[test]
    fn a_box_of_triangles_is_a_box(edges in prop::array::uniform3(0.1..5.0), motion in motions()) {
        let edges = Vector3::from(edges);
        let middle = Isometry3::from(Translation3::from(edges * 0.5));
        let body = MassProperties::cuboid(&edges).unwrap().moved(&(motion * middle));
        same(&solid(moved(&box_triangles(&edges), &motion)), &body, 1e-11);
    }

    #[test]
    fn tetrahedra_are_their_cubature(corners in prop::array::uniform4(vectors(2.0)), inside in prop::array::uniform4(0.1..1.0)) {
        let Some(expected) = cubature(&corners) else { return Ok(()) };
        let whole = solid(tetrahedron(corners));
        same(&whole, &expected, 1e-11);
        // the tetrahedron divided in four from an interior point
        let total: f64 = inside.iter().sum();
        let point = (0..4).map(|i| corners[i] * (inside[i] / total)).sum();
        let parts = (0..4).map(|i| {
            let mut part = corners;
            part[i] = point;
            solid(tetrahedron(part))
        });
        same(&parts.reduce(|a, b| a + b).unwrap(), &whole, 1e-10);
    }
}

/// The error for an invalid surface.
fn refusal(corners: Corners) -> String {
    Mesh::from_triangles(corners).unwrap_err().to_string()
}

#[test]
fn what_bounds_no_solid_is_refused_with_an_edge() {
    let whole = box_triangles(&vector(1.0, 2.0, 3.0));
    let open = refusal(whole[1..].to_vec());
    assert!(
        open.contains("belongs to no triangle, but triangle")
            && open.contains("the edge from (1, 2, 0) to (0, 0, 0)"),
        "{open}"
    );
    let mut flipped = whole.clone();
    flipped[4].swap(0, 1);
    let flipped = refusal(flipped);
    assert!(flipped.contains("and, in the same direction, in triangle"), "{flipped}");
    let inside_out = whole.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let inside_out = refusal(inside_out);
    assert_eq!(
        inside_out,
        "invalid solid: the surface is inside out: its volume with this orientation is -6"
    );
    // two boxes that touch along an edge, where four triangles meet
    let mut branching = whole.clone();
    branching.extend(moved(&whole, &Isometry3::translation(1.0, 2.0, 0.0)));
    let branching = refusal(branching);
    assert!(
        branching.contains("the edge from (1, 2, 0) to (1, 2, 3)")
            || branching.contains("the edge from (1, 2, 3) to (1, 2, 0)"),
        "{branching}"
    );
    // two boxes that touch at a vertex are two solids
    let mut two = whole.clone();
    two.extend(moved(&whole, &Isometry3::translation(1.0, 2.0, 3.0)));
    assert!((solid(two).mass() - 12.0).abs() < 1e-14);
    // a triangle with two equal vertices, and an empty mesh
    let [a, b, c] = whole[0];
    assert!(refusal(vec![[a, b, c], [a, c, b]]).contains("encloses no volume"));
    assert!(refusal(vec![]).contains("encloses no volume"));
    assert!(refusal(vec![[a, a, b]]).contains("encloses no volume"));
    // a negative zero is zero
    let signed = |x: f64| if x == 0.0 { -0.0 } else { x };
    let mut signed_zeros = whole.clone();
    signed_zeros[0] = whole[0].map(|x| x.map(signed));
    assert!((solid(signed_zeros).mass() - 6.0).abs() < 1e-14);
    // a degenerate triangle neither closes nor opens the surface
    let mut collapsed = whole.clone();
    collapsed.push([a, b, a]);
    assert!((solid(collapsed).mass() - 6.0).abs() < 1e-14);
    let index = Mesh::new(vec![a, b, c], vec![[0, 1, 3]]).unwrap_err();
    assert_eq!(
        index.to_string(),
        "invalid solid: triangle 1 refers to vertex 4, but there are 3 vertices"
    );
    for far in [f64::NAN, f64::INFINITY, 1e200] {
        let triangles: Corners = whole.iter().map(|t| t.map(|x| x * far)).collect();
        assert!(matches!(Mesh::from_triangles(triangles), Err(Error::Overflow { .. })), "{far}");
    }
}

fn stl_text(corners: &Corners) -> String {
    let vertex = |v: &Vector3<f64>| format!("      vertex {} {} {}\n", v.x, v.y, v.z);
    let facet = |t: &[Vector3<f64>; 3]| {
        let vertices: String = t.iter().map(vertex).collect();
        format!("  facet normal 0 0 0\n    outer loop\n{vertices}    endloop\n  endfacet\n")
    };
    let facets: String = corners.iter().map(facet).collect();
    format!("solid part\n{facets}endsolid part\n")
}

fn stl_binary(corners: &Corners) -> Vec<u8> {
    let single = |v: &Vector3<f64>| stl_io::Vertex::new([v.x as f32, v.y as f32, v.z as f32]);
    let triangles = corners.iter().map(|t| stl_io::Triangle {
        normal: stl_io::Normal::new([0.0; 3]),
        vertices: [single(&t[0]), single(&t[1]), single(&t[2])],
    });
    let mut bytes = vec![];
    stl_io::write_stl(&mut bytes, triangles.collect::<Vec<_>>().iter()).unwrap();
    bytes
}

/// An OBJ file as modelling programs write it: quadrangles with textures, normals, colours and
/// objects.
fn obj_text(edges: [f64; 3]) -> String {
    let [x, y, z] = edges;
    format!(
        "# a box\nmtllib none.mtl\no box\nv 0 0 0\nv {x} 0 0\nv 0 {y} 0 1 0.5 0\nv {x} {y} 0\nvt 0 0\nvn 0 0 1\n\
         v 0 0 {z}\nv {x} 0 {z}\nv 0 {y} {z}\nv {x} {y} {z}\nusemtl steel\n\
         f 1/1/1 3/1/1 4/1/1 2/1/1\nf 5//1 6//1 8//1 7//1\ng side\nf 1 2 6 5\nf 3 7 8 4\nf -8 -4 -2 -6\nf 2/9 4/-99 8 6\n"
    )
}

#[test]
fn files_of_meshes_are_read() {
    let edges = [0.1, 2.25, 3.0];
    let corners = box_triangles(&edges.into());
    let middle = Isometry3::from(Translation3::from(Vector3::from(edges) * 0.5));
    let body = MassProperties::cuboid(&edges.into()).unwrap().moved(&middle);
    let text = stl_text(&corners);
    let binary = stl_binary(&corners);
    let read = |name: &str, bytes: &[u8]| mesh(name, bytes).unwrap().mass_properties();
    // coordinates of a binary STL file have 24 bits, in text files all bits
    same(&read("part.STL", &binary), &body, 1e-7);
    same(&read("part.stl", text.as_bytes()), &body, 1e-14);
    let far = Isometry3::translation(1000.05, -3000.1, 0.7);
    let placed = stl_text(&moved(&corners, &far));
    same(&read("part.stl", placed.as_bytes()), &body.moved(&far), 1e-8);
    same(&read("part.obj", obj_text(edges).as_bytes()), &body, 1e-14);
    // headers without a name, in capitals, and with other line ends
    for variant in [
        text.replace("solid part", "solid"),
        text.to_uppercase(),
        text.replace('\n', "\r\n"),
        format!("\n  {text}\n\n"),
    ] {
        assert_eq!(
            read("part.stl", variant.as_bytes()),
            read("part.stl", text.as_bytes()),
            "{variant}"
        );
    }
    // a name in another encoding
    let latin = [&b"solid caf\xe9\n"[..], text.split_once('\n').unwrap().1.as_bytes()].concat();
    assert_eq!(read("part.stl", &latin), read("part.stl", text.as_bytes()));
    // a binary file whose header begins with `solid`, and a file with additional bytes at its end
    let mut solid = binary.clone();
    solid[..11].copy_from_slice(b"solid part\n");
    assert_eq!(read("part.stl", &solid), read("part.stl", &binary));
    let longer = [&binary[..], &[0; 7]].concat();
    assert_eq!(read("part.stl", &longer), read("part.stl", &binary));
    // both solids of a file are read, not only the first
    let other = moved(&corners, &Isometry3::translation(10.0, 0.0, 0.0));
    let both = read("part.stl", (text.clone() + &stl_text(&other)).as_bytes());
    assert!((both.mass() - 2.0 * body.mass()).abs() < 1e-5);
    // read from a file
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.stl");
    std::fs::write(&path, &binary).unwrap();
    let found = read_mesh(path.to_str().unwrap()).unwrap();
    assert_eq!((found.vertices().len(), found.triangles().len()), (8, 12));
    let missing = read_mesh(folder.path().join("none.stl").to_str().unwrap()).unwrap_err();
    assert!(missing.message.contains("cannot read"), "{missing}");
}

/// The error for an invalid file, and the text at its location.
fn broken(name: &str, bytes: &[u8]) -> (String, String) {
    let error = mesh(name, bytes).unwrap_err();
    let place = error.at.as_ref().expect("a place");
    assert_eq!(place.source.name, name);
    (error.message.clone(), place.text().unwrap_or_default().to_string())
}

#[test]
fn broken_files_say_where() {
    let corners = box_triangles(&vector(1.0, 2.0, 3.0));
    let (text, binary) = (stl_text(&corners), stl_binary(&corners));
    let stl = |text: &str| broken("part.stl", text.as_bytes());
    let (message, at) = stl(&text.replacen("vertex 1 2 0", "vertex 1 two 0", 1));
    assert_eq!(message, "not a valid STL file: triangle 1: invalid float literal");
    assert!(at.contains("facet normal"), "{at}");
    let (message, _) = stl(&text.replacen("vertex 1 2 0", "vertex 1 nan 0", 1));
    assert!(message.contains("triangle 1: expected finite f32, got NaN"), "{message}");
    let (message, _) = stl(&text.replacen("vertex 1 2 0", "vertex 1 1e99 0", 1));
    assert!(message.contains("expected finite f32, got inf"), "{message}");
    // truncated at every position
    for cut in [text.len() - 20, text.len() / 2, 200, 13, 6] {
        let (message, _) = stl(&text[..cut]);
        assert!(message.starts_with("not a valid STL file: triangle"), "{cut}: {message}");
    }
    let (message, at) = stl(&(text.clone() + "and more\n"));
    assert_eq!(
        (message.as_str(), at.as_str()),
        ("not a valid STL file: `solid` is expected here", "and more")
    );
    let (message, _) = stl("");
    assert!(message.contains("neither begins with `solid` nor has a binary head"), "{message}");

    let (message, _) = broken("part.stl", &binary[..binary.len() - 1]);
    assert_eq!(message, "not a valid STL file: 12 triangles need 684 bytes, but the file has 683");
    let mut endless = binary.clone();
    endless[80..84].copy_from_slice(&[255; 4]);
    assert!(broken("part.stl", &endless).0.contains("4294967295 triangles"));
    let mut not_a_number = binary.clone();
    not_a_number[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(
        broken("part.stl", &not_a_number).0,
        "not a valid STL file: triangle 2: the coordinate NaN is not finite"
    );
    let open = stl_binary(&corners[1..].to_vec());
    let error = mesh("part.stl", &open).unwrap_err();
    assert!(
        error.message.contains("invalid solid: the edge from (1, 2, 0) to (0, 0, 0)"),
        "{error}"
    );
    assert!(error.help.unwrap().contains("mesh must be closed"));

    let box_text = obj_text([1.0, 2.0, 3.0]);
    let obj = |from: &str, to: &str| broken("part.obj", box_text.replacen(from, to, 1).as_bytes());
    assert_eq!(
        obj("v 1 0 0", "v 1 0"),
        ("not a valid OBJ file: a vertex needs three numbers".into(), "v 1 0".into())
    );
    assert_eq!(obj("v 1 0 0", "v 1 0 z").1, "v 1 0 z");
    assert_eq!(
        obj("v 1 0 0", "v 1 nan 0"),
        ("not a valid OBJ file: the coordinate nan is not finite".into(), "v 1 nan 0".into())
    );
    assert_eq!(
        obj("v 1 0 0", "v 1 0 1e999").0,
        "not a valid OBJ file: the coordinate 1e999 is not finite"
    );
    assert_eq!(
        obj("f 1 2 6 5", "f 1 2 6 x"),
        (
            "not a valid OBJ file: the vertices of a face must be three or more integers".into(),
            "f 1 2 6 x".into()
        )
    );
    assert_eq!(
        obj("f 1 2 6 5", "f 1 2 6 9"),
        ("not a valid OBJ file: the file has no vertex 9".into(), "f 1 2 6 9".into())
    );
    assert_eq!(obj("f 1 2 6 5", "f 0 2 6 5").0, "not a valid OBJ file: the file has no vertex 0");
    assert_eq!(obj("f 1 2 6 5", "f -9 2 6 5").0, "not a valid OBJ file: the file has no vertex -9");
    // relative indices count backwards from the face, though more vertices follow
    let (message, at) = obj("vt 0 0", "f -4 -3 -2\nf -5 1 2");
    assert_eq!(
        (message.as_str(), at.as_str()),
        ("not a valid OBJ file: the file has no vertex -5", "f -5 1 2")
    );
    let least = format!("f {} 2 6 5", isize::MIN);
    assert!(obj("f 1 2 6 5", &least).0.contains("no vertex -9223372036854775808"));
    assert!(obj("f 1 2 6 5", "f").0.contains("not a valid OBJ file"));
    assert!(obj("f 1 2 6 5", "").0.contains("invalid solid: the edge"));
    assert!(broken("part.obj", b"").0.contains("encloses no volume"));
    let other = mesh("part.ply", b"").unwrap_err();
    assert_eq!(other.help.unwrap(), "the name of a mesh file must end in .stl or .obj");
}

properties! {
    #![cases(400)]
    /// Files with changed, lost or duplicated bytes give a mesh or an error.
    #[test]
    fn damaged_files_do_no_harm(kind in 0..3, at in any::<prop::sample::Index>(), change in 0..4, byte in any::<u8>()) {
        let corners = box_triangles(&vector(1.0, 2.0, 3.0));
        let (name, mut bytes) = match kind {
            0 => ("part.stl", stl_text(&corners).into_bytes()),
            1 => ("part.stl", stl_binary(&corners)),
            _ => ("part.obj", obj_text([1.0, 2.0, 3.0]).into_bytes()),
        };
        let at = at.index(bytes.len());
        match change {
            0 => bytes[at] = byte,
            1 => bytes.truncate(at),
            2 => bytes.insert(at, byte),
            _ => bytes = [&bytes[..at], &bytes[at / 2..]].concat(),
        }
        let _ = mesh(name, &bytes);
    }
}
