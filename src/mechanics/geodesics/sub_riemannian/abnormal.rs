//! Abnormal extremals of distributions of rank 2.

use super::{ExtremalPoint, STEPS, SubRiemannianGroup, TOLERANCE};
use crate::Error;
use crate::mechanics::systems::cotangent::State;
use crate::mechanics::{Adaptive, LiePoissonSystem, stopped};
use affinor_tensors::stop::checkpoint;
use nalgebra::{DVector, Vector2};

/// A value is zero if it is at most this multiple of the sizes of its terms.
const ROUNDING: f64 = 1e-9;
/// If `h_112` and `h_122` fall below this part of their largest values, and the steps become too
/// small, both vanish.
const VANISHING: f64 = 1e-3;

/// An abnormal extremal with unit speed.
#[derive(Clone, Debug, PartialEq)]
pub struct AbnormalExtremal {
    /// The points at the given times, up to the time [`vanishes`](Self::vanishes).
    pub points: Vec<ExtremalPoint>,
    /// The time at which `h_112` and `h_122` both vanish, so that they leave the direction open.
    /// `None` if this does not happen.
    pub vanishes: Option<f64>,
}

/// The functions of a covector that determine its abnormal extremal.
struct Brackets {
    /// The vectors `X_1`, `X_2`, `[X_1, X_2]`, `[X_1, [X_1, X_2]]` and `[X_2, [X_1, X_2]]`.
    vectors: [DVector<f64>; 5],
}

impl SubRiemannianGroup {
    /// The abnormal extremal of a distribution of rank 2 with unit speed, at the given times, which
    /// are in increasing or decreasing order from 0. With `h_1 = p(X_1)`, `h_12 = p([X_1, X_2])`,
    /// `h_112 = p([X_1, [X_1, X_2]])` and so on, it satisfies
    ///
    /// ```text
    /// h_1 = h_2 = h_12 = 0,   u1 h_112 + u2 h_122 = 0,   g' = g u,   p' = ad*_u p
    /// ```
    ///
    /// The orientation is `u = (h_122 X_1 - h_112 X_2)/|...|`, which does not depend on the basis of
    /// the distribution. Negative times follow the curve in the opposite direction.
    ///
    /// W. Liu and H. J. Sussmann, *Mem. Amer. Math. Soc.* 118 (1995), no. 564.
    ///
    /// # Errors
    /// [`Error::Unsupported`] unless the rank is 2; [`Error::Invalid`] if the covector is zero, does
    /// not annihilate the distribution and its brackets, or if `h_112 = h_122 = 0` at the start;
    /// [`Error::Integration`].
    pub fn abnormal(
        &self,
        start: &DVector<f64>,
        covector: &DVector<f64>,
        times: &[f64],
    ) -> Result<AbnormalExtremal, Error> {
        self.expect_covector(covector)?;
        let rank = self.vectors.ncols();
        if rank != 2 {
            return Err(Error::Unsupported(format!(
                "abnormal extremals are computed for distributions of rank 2 only, and the rank is \
                 {rank}"
            )));
        }
        let brackets = self.brackets();
        brackets.expect_abnormal(covector)?;
        let gradient = |p: &DVector<f64>| self.direction(&brackets, p);
        let system = LiePoissonSystem { group: self.group.clone(), gradient };
        let control = Adaptive::of_order_8(TOLERANCE);
        let mut state = system.state(0.0, start.clone(), covector);
        let (mut next, mut steps, mut points) = (control.first_step(), 0, vec![]);
        let mut before = brackets.third(covector);
        let mut largest = before.norm();
        for &end in times {
            while state.time != end {
                checkpoint();
                if steps == STEPS {
                    return Err(stopped(state.time, "too many steps"));
                }
                steps += 1;
                let mut reached = state.clone();
                let step = control.step(&system, &mut reached, &mut next, end);
                let now = brackets.third(&reached.momentum(&self.group));
                // the direction is reversed where both functions pass through zero
                if now.dot(&before) <= 0.0 || (step.is_err() && before.norm() < VANISHING * largest)
                {
                    return Ok(AbnormalExtremal { points, vanishes: Some(state.time) });
                }
                step?;
                largest = largest.max(now.norm());
                (state, before) = (reached, now);
            }
            points.push(self.point(State { time: end, ..state.clone() }));
        }
        Ok(AbnormalExtremal { points, vanishes: None })
    }

    fn brackets(&self) -> Brackets {
        let [x, y] = [0, 1].map(|a| DVector::from(self.vectors.column(a)));
        let [ad_x, ad_y] = [&x, &y].map(|x| self.ad(x));
        let xy = &ad_x * &y;
        let (xxy, yxy) = (&ad_x * &xy, &ad_y * &xy);
        Brackets { vectors: [x, y, xy, xxy, yxy] }
    }

    /// The unit vector of the velocity.
    fn direction(&self, brackets: &Brackets, covector: &DVector<f64>) -> DVector<f64> {
        let third = brackets.third(covector);
        let components = DVector::from_vec(vec![third[1], -third[0]]);
        let speed = components.dot(&(&self.products * &components)).sqrt();
        &self.vectors * components / speed
    }
}

impl Brackets {
    /// The values `h_112` and `h_122`.
    fn third(&self, covector: &DVector<f64>) -> Vector2<f64> {
        Vector2::new(covector.dot(&self.vectors[3]), covector.dot(&self.vectors[4]))
    }

    fn expect_abnormal(&self, covector: &DVector<f64>) -> Result<(), Error> {
        let invalid = |reason: String| Err(Error::Invalid { what: "covector", reason });
        if covector.amax() == 0.0 {
            return invalid("it is zero, so it determines no abnormal extremal".into());
        }
        let is_zero = |vector: &DVector<f64>| {
            covector.dot(vector).abs() <= ROUNDING * covector.norm() * vector.norm()
        };
        for (name, vector) in ["h_1", "h_2", "h_12"].iter().zip(&self.vectors) {
            if !is_zero(vector) {
                let value = covector.dot(vector);
                return invalid(format!(
                    "{name} = {value}, but an abnormal extremal has h_1 = h_2 = h_12 = 0"
                ));
            }
        }
        if self.vectors[3..].iter().all(is_zero) {
            return invalid(
                "h_112 = h_122 = 0, so u1 h_112 + u2 h_122 = 0 leaves the direction open".into(),
            );
        }
        Ok(())
    }
}
