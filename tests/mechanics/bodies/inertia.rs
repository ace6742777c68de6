//! Tolerances of inertia matrices: rounding errors are accepted, larger errors are rejected, in any unit.

use affinor::mechanics::{Inertia, MassProperties};
use nalgebra::{Matrix3, Vector3};

#[test]
fn matrices_are_symmetric_to_rounding() {
    for unit in [1e-100, 1.0, 1e100] {
        let accepted = |off: f64| {
            let matrix = Matrix3::new(2.0, 0.1 + off, 0.0, 0.1, 2.0, 0.0, 0.0, 0.0, 2.0) * unit;
            let body = MassProperties::new(1.0, Vector3::zeros(), &matrix);
            assert_eq!(Inertia::new(&matrix).is_ok(), body.is_ok(), "{unit} {off}");
            body.is_ok()
        };
        assert!(accepted(1e-15) && accepted(-1e-13), "{unit}");
        assert!(!accepted(1e-10) && !accepted(-1e-7), "{unit}");
    }
}

/// The largest moment is at most the sum of the others; it is equal for a plate.
#[test]
fn moments_are_physical_to_rounding() {
    for unit in [1e-100, 1.0, 1e100] {
        let accepted = |excess: f64| {
            let moments = Vector3::new(1.0, 2.0 + excess, 1.0) * unit;
            let inertia = Inertia::diagonal(&moments).unwrap();
            let body = MassProperties::new(1.0, Vector3::zeros(), &inertia.matrix());
            assert_eq!(inertia.is_physical(), body.is_ok(), "{unit} {excess}");
            body.is_ok()
        };
        assert!(accepted(-0.5) && accepted(0.0) && accepted(1e-13), "{unit}");
        assert!(!accepted(1e-10) && !accepted(1e-4), "{unit}");
    }
}
