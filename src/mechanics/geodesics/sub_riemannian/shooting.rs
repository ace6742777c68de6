//! Normal geodesics between two elements, by shooting with the exact derivative.

use super::{Conjugacy, SubRiemannianGroup};
use crate::Error;
use crate::group::LieGroup;
use crate::mechanics::geodesics::{
    Connecting, ROUNDING, SINGULAR, Shooting, TOLERANCE, equal_points, spread,
};
use nalgebra::{DMatrix, DVector};

/// The largest vertical component of a covector from which the search begins, in units of the
/// estimated length: about one turn in the unit of time. The first starts have smaller components.
const VERTICAL: f64 = 8.0;

/// The largest number of steps of a curve in the search. A curve that needs more is far from a short
/// geodesic.
const STEPS: usize = 1000;
/// The largest size of the unknowns in the search.
const LARGEST: f64 = 50.0;
/// The part of the parameter by which a conjugate parameter may exceed a conjugate end.
const CONJUGATE_END: f64 = 1e-5;

/// A normal geodesic between two points, with the parameter from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizontalGeodesic {
    /// The initial covector.
    pub covector: DVector<f64>,
    /// The covector at the end.
    pub end_covector: DVector<f64>,
    /// The initial velocity.
    pub velocity: DVector<f64>,
    /// The length.
    pub length: f64,
    /// The distance between the computed and the given end: the logarithm of the difference, in
    /// units in which the geodesic has about the length 1.
    pub residual: f64,
    /// The ratio of the smallest to the largest singular value of the derivative of the end by the
    /// covector, in the same units.
    pub regularity: f64,
}

impl Connecting for HorizontalGeodesic {
    fn start(&self) -> &DVector<f64> {
        &self.covector
    }

    fn size(&self) -> f64 {
        self.length
    }

    fn residual(&self) -> f64 {
        self.residual
    }
}

/// The problem to join two elements by a normal geodesic. The unknowns are the components of the
/// initial covector in an adapted basis, in units in which the geodesic has about the length 1. The
/// miss is the logarithm of `g_1^-1 g(1)` in these units, and its derivative is exact.
///
/// [`find`](super::super::find) solves the problem from several covectors. The shortest geodesic
/// that it finds need not be the shortest one, and abnormal geodesics are not found.
#[derive(Clone, Debug)]
pub struct HorizontalShooting {
    space: SubRiemannianGroup,
    from: DVector<f64>,
    to: DVector<f64>,
    /// The inverse of the end.
    back: DVector<f64>,
    /// The vectors of the adapted basis in units of length, as columns, and the inverse matrix.
    basis: [DMatrix<f64>; 2],
    /// The estimated length.
    size: f64,
    /// The components of `log(g_0^-1 g_1)`; `None` outside the image of the exponential.
    direct: Option<DVector<f64>>,
}

impl HorizontalShooting {
    /// The problem of two elements, given by their embedding coordinates.
    ///
    /// # Errors
    /// [`Error::EndPoint`] if the points are equal, or if the distribution does not generate the
    /// algebra, so that it does not join all points.
    pub fn new(
        space: SubRiemannianGroup,
        from: DVector<f64>,
        to: DVector<f64>,
    ) -> Result<Self, Error> {
        let growth = space.growth_vector();
        let n = space.group.dimension();
        if !space.is_bracket_generating() {
            let growth: Vec<String> = growth.iter().map(usize::to_string).collect();
            let reason = format!(
                "may be out of reach: the distribution does not generate the algebra; its growth \
                 vector is {}, and the dimension is {n}",
                growth.join(", ")
            );
            return Err(Error::EndPoint { reason });
        }
        let (adapted, weights) = &space.adapted;
        let coordinates = adapted.clone().lu().try_inverse().expect("the vectors of a basis");
        let between = space.group.between(&from, &to);
        let logarithm = space.group.log(&between).ok().map(|x| &coordinates * x);
        let part = |x: &DVector<f64>| {
            let parts =
                x.iter().zip(weights).map(|(x, weight)| x.abs().powf(1.0 / f64::from(*weight)));
            parts.fold(0.0, f64::max)
        };
        let size = logarithm.as_ref().map_or(1.0, part);
        if size <= 1e-14 {
            return Err(equal_points());
        }
        let scale = DVector::from_iterator(n, weights.iter().map(|weight| size.powi(*weight)));
        let basis = adapted * DMatrix::from_diagonal(&scale);
        let inverse = DMatrix::from_diagonal(&scale.map(|x| 1.0 / x)) * coordinates;
        let direct = logarithm.map(|x| x.component_div(&scale));
        let back = space.group.inverse(&to);
        Ok(HorizontalShooting { space, from, to, back, basis: [basis, inverse], size, direct })
    }

    /// The element at the end.
    pub fn end(&self) -> &DVector<f64> {
        &self.to
    }

    /// The first conjugate parameter of a geodesic, from 0 to 1 up to rounding. A geodesic with a
    /// conjugate parameter before 1 is not shortest.
    ///
    /// # Errors
    /// The errors of [`SubRiemannianGroup::first_conjugate`].
    pub fn conjugacy(&self, geodesic: &HorizontalGeodesic) -> Result<Conjugacy, Error> {
        // at a conjugate end, the covector is less accurate
        let is_singular = geodesic.regularity < SINGULAR;
        let end = if is_singular { 1.0 + CONJUGATE_END } else { 1.0 };
        Ok(match self.space.first_conjugate(&geodesic.covector, end)? {
            Conjugacy::None { until } => Conjugacy::None { until: until.min(1.0) },
            found => found,
        })
    }

    /// The covector with these unknowns. For time 1 and a basis of the size of the curve, components
    /// of covectors have the size of its square.
    fn covector(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        self.basis[1].tr_mul(unknowns) * self.size.powi(2)
    }

    /// The logarithm of `g_1^-1 g(1)`.
    fn difference(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        let size = unknowns.norm();
        if size > LARGEST {
            return Err(Error::Invalid {
                what: "covector",
                reason: format!("its size {size:.1} is above {LARGEST}, where the search ends"),
            });
        }
        let covector = self.covector(unknowns);
        let end = self.space.normal(&self.from, &covector, &[1.0], tolerance, STEPS)?.remove(0);
        self.space.group.log(&self.space.group.compose(&self.back, &end.element))
    }
}

impl Shooting for HorizontalShooting {
    type Curve = HorizontalGeodesic;

    fn miss(&self, unknowns: &DVector<f64>, tolerance: f64) -> Result<DVector<f64>, Error> {
        Ok(&self.basis[1] * self.difference(unknowns, tolerance)?)
    }

    fn derivative(
        &self,
        unknowns: &DVector<f64>,
        tolerance: f64,
    ) -> Result<Option<DMatrix<f64>>, Error> {
        let group = &self.space.group;
        let x = self.difference(unknowns, tolerance)?;
        let moved = self.space.varied(&self.covector(unknowns), 1.0, tolerance, STEPS)?;
        let moved = moved * self.basis[1].transpose() * self.size.powi(2);
        let columns = moved
            .column_iter()
            .map(|v| Ok(&self.basis[1] * group.tangent_left_inverse(&x, &v.into_owned())?));
        let columns = columns.collect::<Result<Vec<_>, Error>>()?;
        Ok(Some(DMatrix::from_columns(&columns)))
    }

    fn geodesic(
        &self,
        unknowns: &DVector<f64>,
        miss: &DVector<f64>,
        regularity: f64,
    ) -> Result<HorizontalGeodesic, Error> {
        let covector = self.covector(unknowns);
        let end = self.space.extremal(&self.from, &covector, &[1.0])?.remove(0);
        Ok(HorizontalGeodesic {
            velocity: self.space.velocity(&covector),
            length: self.space.speed(&covector),
            end_covector: end.covector,
            residual: miss.norm(),
            regularity,
            covector,
        })
    }

    fn starts(&self, count: usize) -> Vec<DVector<f64>> {
        let (n, rank) = (self.space.group.dimension(), self.space.vectors.ncols());
        let products = &self.space.products;
        // the covector of the curve whose velocity is the horizontal part of the logarithm
        let direct = self.direct.as_ref().map(|x| {
            let mut covector = DVector::zeros(n);
            covector.rows_mut(0, rank).copy_from(&(products * x.rows(0, rank)));
            covector
        });
        let direct = direct.filter(|covector| covector.amax() > 1e-3);
        let around = direct.into_iter();
        let others = (1..=count).map(|index| {
            let spread = spread(index, n);
            let vertical = VERTICAL * index as f64 / count as f64;
            DVector::from_fn(n, |i, _| {
                let base = self.direct.as_ref().map_or(0.0, |x| x[i]);
                match i < rank {
                    true => base + 2.0 * spread[i],
                    false => vertical * spread[i],
                }
            })
        });
        around.chain(others).take(count).collect()
    }

    fn sizes(&self) -> DVector<f64> {
        DVector::from_element(self.space.group.dimension(), 1.0)
    }

    fn resolution(&self) -> f64 {
        ROUNDING.max(TOLERANCE)
    }
}
