//! What is the curvature of a left-invariant metric?
//!
//! The algebra is so(3) with the metric diag(a, b, c), the moments of inertia of a rigid body. All components
//! are rational functions of a, b, c. The Ricci curvature is compared with J. Milnor,
//! *Advances in Mathematics* 21 (1976) 293-329, theorem 4.3.

use affinor::algebra::catalogue;
use affinor::tensors::{Down, Ring, Symbolic, Tensor};
use affinor::{Connection, LieAlgebra, Metric};
use std::error::Error;

/// Computes the Levi-Civita connection and its curvature.
pub fn main() -> Result<(), Box<dyn Error>> {
    let so3: LieAlgebra<Symbolic> = catalogue::find("so(3)")?
        .bracket(|value| Ok::<_, affinor::Error>(value.clone()))?
        .try_into()?;
    let moments = ["a", "b", "c"].map(Symbolic::parameter);
    let diagonal = |[i, j]: [usize; 2]| match i == j {
        true => moments[i].clone(),
        false => Symbolic::from_i64(0),
    };
    let metric = Metric::new(so3.labels(), Tensor::from_fn(3, [Down, Down], diagonal)?)?;

    let connection = Connection::levi_civita(so3.left_frame(), &metric)?;
    assert!(connection.torsion().is_empty());
    assert!(connection.nonmetricity(&metric)?.is_empty());

    let ricci = connection.ricci();
    println!("Ric_11 = {}", ricci.get(&[0, 0]));
    println!("S      = {}", connection.scalar_curvature(&metric)?);

    // Milnor: Ric(u1, u1) = 2 mu_2 mu_3 for the unit vector u1, so Ric_11 = a Ric(u1, u1)
    let [a, b, c] = moments;
    let difference = b.clone() - &c;
    let numerator = a.clone() * &a - &(difference.clone() * &difference);
    assert_eq!(ricci.get(&[0, 0]), numerator / &(b * &c * &Symbolic::from_i64(2)));

    // equal moments, as of a ball, give the sphere of radius 2, with Ric = 1/2 delta
    let ball = metric.components().map(|_| Symbolic::from_i64(1));
    let ball = Metric::new(so3.labels(), ball)?;
    let round = Connection::levi_civita(so3.left_frame(), &ball)?;
    assert_eq!(round.scalar_curvature(&ball)?.to_string(), "3/2");
    Ok(())
}
