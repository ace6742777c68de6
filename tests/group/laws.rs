//! The laws of groups attribute a mistake to the function that contains it.

use affinor::Error;
use affinor::group::{LieGroup, laws};
use nalgebra::{DMatrix, Vector2};

/// Affine maps `a t + b` of the line, with one mistake.
#[derive(Clone, Copy, Debug)]
struct Mistaken(&'static str);

impl LieGroup for Mistaken {
    type Element = (f64, f64);
    type Vector = Vector2<f64>;
    fn dimension(&self) -> usize {
        2
    }
    fn identity(&self) -> (f64, f64) {
        (1.0, if self.0 == "identity" { 1e-3 } else { 0.0 })
    }
    fn compose(&self, g: &(f64, f64), h: &(f64, f64)) -> (f64, f64) {
        let sign = if self.0 == "compose" { -1.0 } else { 1.0 };
        (g.0 * h.0, g.0 * h.1 + sign * g.1)
    }
    fn inverse(&self, g: &(f64, f64)) -> (f64, f64) {
        (1.0 / g.0, if self.0 == "inverse" { -g.1 } else { -g.1 / g.0 })
    }
    fn exp(&self, x: &Vector2<f64>) -> (f64, f64) {
        let mean = if x[0] == 0.0 { 1.0 } else { x[0].exp_m1() / x[0] };
        (x[0].exp(), if self.0 == "exp" { x[1] } else { mean * x[1] })
    }
    fn log(&self, g: &(f64, f64)) -> Result<Vector2<f64>, Error> {
        let log = g.0.ln();
        let mean = if log == 0.0 { 1.0 } else { log.exp_m1() / log };
        Ok(match self.0 {
            "log" => Vector2::new(log, g.1),
            "log of the identity" => Vector2::new(log, g.1 / mean + 1e-3),
            _ => Vector2::new(log, g.1 / mean),
        })
    }
    fn adjoint(&self, g: &(f64, f64), x: &Vector2<f64>) -> Vector2<f64> {
        let sign = if self.0 == "adjoint" { 1.0 } else { -1.0 };
        Vector2::new(x[0], g.0 * x[1] + sign * g.1 * x[0])
    }
    fn bracket(&self, x: &Vector2<f64>, y: &Vector2<f64>) -> Vector2<f64> {
        let factor = if self.0 == "bracket" { 2.0 } else { 1.0 };
        Vector2::new(0.0, factor * (x[0] * y[1] - x[1] * y[0]))
    }
    fn matrix(&self, g: &(f64, f64)) -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &[g.0, g.1, 0.0, 1.0])
    }
}

/// A mistake in a function violates a law of this function.
#[test]
fn a_mistake_is_blamed_on_its_law() {
    let [x, y, z] = [[0.3, -0.7], [-0.4, 0.5], [0.2, 0.9]].map(Vector2::from);
    assert_eq!(laws::all(&Mistaken("nothing"), &x, &y, &z), Ok(()));
    for (mistake, law) in [
        ("identity", "g e = g"),
        ("compose", "g e = g"),
        ("inverse", "g^-1 g = e"),
        ("exp", "log(exp(x)) = x"),
        ("log", "log(exp(x)) = x"),
        ("log of the identity", "log(e) = 0"),
        ("adjoint", "Ad_exp(x) = exp(ad_x)"),
        ("bracket", "Ad_exp(x) = exp(ad_x)"),
    ] {
        let broken = laws::all(&Mistaken(mistake), &x, &y, &z).unwrap_err();
        assert_eq!(broken.law, law, "{mistake}: {broken}");
    }
}
