//! Do the same formulas hold in coordinates and in a moving frame?
//!
//! A [`Frame`] consists of structure functions and derivations. In a coordinate frame, the
//! structure functions are zero. In the left-invariant frame of a group, the structure functions
//! and all components are constant, so their derivatives vanish. A moving frame has both structure
//! functions and derivatives. The same formulas for the Levi-Civita connection and the curvature
//! apply to all these frames.

use affinor::tensors::{Down, Notation, Ring, Symbolic, Tensor, Up};
use affinor::{Chart, Connection, Frame, Metric};
use std::error::Error;

/// Computes the plane in polar coordinates and in their unit vectors, and the sphere.
pub fn main() -> Result<(), Box<dyn Error>> {
    let r = Symbolic::parameter("r");
    let one = || Symbolic::from_i64(1);
    let over_r = one() / &r;

    // the coordinates r, t of the plane: g = dr^2 + r^2 dt^2
    let polar = Frame::coordinates(&["r", "t"])?;
    let metric = diagonal(&polar, [one(), r.clone() * &r])?;
    let connection = Connection::levi_civita(&polar, &metric)?;
    println!("polar coordinates: nabla_t d_t = {} d_r", connection.affinities().get(&[0, 1, 1]));
    assert!(connection.curvature().is_empty());

    // the unit vectors e_r = d_r, e_t = 1/r d_t; their bracket is computed
    let fields = [([0, 0], one()), ([1, 1], over_r)];
    let fields = Tensor::from_components(2, &[Up, Down], fields)?;
    let labels = ["e_r", "e_t"];
    let fields = Chart::new(&["r", "t"])?.fields(labels, fields)?;
    let unit = fields.frame();
    println!("unit vectors:      [e_r, e_t] = {} e_t", unit.structure_functions().get(&[1, 0, 1]));
    let metric = diagonal(unit, [one(), one()])?;
    let connection = Connection::levi_civita(unit, &metric)?;
    println!("unit vectors:      nabla_t e_t = {} e_r", connection.affinities().get(&[0, 1, 1]));
    assert!(connection.curvature().is_empty());

    // the unit sphere, projected from its pole: g = 4 (dx^2 + dy^2) / (1 + x^2 + y^2)^2
    let [x, y] = ["x", "y"].map(Symbolic::parameter);
    let sphere = Frame::coordinates(&["x", "y"])?;
    let half = (one() + &(x.clone() * &x) + &(y.clone() * &y)) / &Symbolic::from_i64(2);
    let scale = one() / &(half.clone() * &half);
    let metric = diagonal(&sphere, [scale.clone(), scale])?;
    let connection = Connection::levi_civita(&sphere, &metric)?;
    let [d_x, d_y] = [[1, 0], [0, 1]].map(|v| v.map(Symbolic::from_i64));
    let curvature = connection.sectional_curvature(&metric, &d_x, &d_y)?;
    println!("sphere: K = {}", curvature.as_ref().ok_or("a degenerate plane")?);
    assert_eq!(curvature, Some(one()));

    // the same sphere in spherical angles: g = d theta^2 + sin(theta)^2 d phi^2
    let angles = Frame::coordinates(&["theta", "phi"])?;
    let sine = Symbolic::function("sin", &Symbolic::parameter("theta"))?;
    let metric = diagonal(&angles, [one(), sine.clone() * &sine])?;
    let connection = Connection::levi_civita(&angles, &metric)?;
    println!(
        "by its angles: nabla_phi d_phi = {} d_theta",
        connection.affinities().get(&[0, 1, 1])
    );
    assert_eq!(connection.scalar_curvature(&metric)?, Symbolic::from_i64(2));
    Ok(())
}

/// The metric with these diagonal components.
fn diagonal(
    frame: &Frame<Symbolic>,
    [a, b]: [Symbolic; 2],
) -> Result<Metric<Symbolic>, Box<dyn Error>> {
    let components = Tensor::from_components(2, &[Down, Down], [([0, 0], a), ([1, 1], b)])?;
    Ok(Metric::new(frame.labels(), components)?)
}
