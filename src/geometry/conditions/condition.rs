//! Properties of a geometry as polynomial equations in its letters.

use crate::Error;
use crate::algebra::LieAlgebra;
use crate::algebra::frame::formula;
use crate::geometry::Geometry;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::polynomial::distinct_factors;
use affinor_tensors::stop::{checkpoint, stage};
use affinor_tensors::{Field, Notation, Ring, Symbolic, Tensor};
use std::collections::BTreeSet;

/// A property of a geometry that depends on the values of its letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// `Ric = c g`.
    Einstein,
    /// `R = 0`.
    Flat,
    /// `Ric = 0`.
    RicciFlat,
    /// `R^i_jkl = K (delta^i_k g_jl - delta^i_l g_jk)`.
    ConstantCurvature,
    /// `tau = 0` and `nabla R = 0`.
    LocallySymmetric,
    /// `g([z,x],y) + g(x,[z,y]) = 0`.
    BiInvariant,
    /// `Ric^i_j = c delta^i_j + D^i_j`, where `D` is a derivation of the algebra.
    RicciSoliton,
    /// `tau = 0`.
    TorsionFree,
    /// `nabla tau = 0`.
    ParallelTorsion,
    /// `nabla R = 0`.
    ParallelCurvature,
    /// `nabla g = 0`.
    MetricCompatible,
}

impl Condition {
    /// All conditions.
    pub const ALL: [Condition; 11] = [
        Condition::Einstein,
        Condition::Flat,
        Condition::RicciFlat,
        Condition::ConstantCurvature,
        Condition::LocallySymmetric,
        Condition::BiInvariant,
        Condition::RicciSoliton,
        Condition::TorsionFree,
        Condition::ParallelTorsion,
        Condition::ParallelCurvature,
        Condition::MetricCompatible,
    ];

    /// The name, such as `ricci-flat`.
    pub fn name(self) -> &'static str {
        match self {
            Condition::Einstein => "einstein",
            Condition::Flat => "flat",
            Condition::RicciFlat => "ricci-flat",
            Condition::ConstantCurvature => "constant-curvature",
            Condition::LocallySymmetric => "locally-symmetric",
            Condition::BiInvariant => "bi-invariant",
            Condition::RicciSoliton => "ricci-soliton",
            Condition::TorsionFree => "torsion-free",
            Condition::ParallelTorsion => "parallel-torsion",
            Condition::ParallelCurvature => "parallel-curvature",
            Condition::MetricCompatible => "metric-compatible",
        }
    }

    /// The equation that defines the condition.
    pub fn statement(self) -> &'static str {
        match self {
            Condition::Einstein => "Ric = c g",
            Condition::Flat => "R = 0",
            Condition::RicciFlat => "Ric = 0",
            Condition::ConstantCurvature => "R^i_jkl = K (delta^i_k g_jl - delta^i_l g_jk)",
            Condition::LocallySymmetric => "tau = 0, nabla R = 0",
            Condition::BiInvariant => "g([z,x],y) + g(x,[z,y]) = 0",
            Condition::RicciSoliton => "Ric = c Id + a derivation",
            Condition::TorsionFree => "tau = 0",
            Condition::ParallelTorsion => "nabla tau = 0",
            Condition::ParallelCurvature => "nabla R = 0",
            Condition::MetricCompatible => "nabla g = 0",
        }
    }

    /// The condition with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|condition| condition.name() == name)
    }
}

/// A connection whose components may contain letters, with its metric and its Lie algebra, if there
/// are any. The frame is invariant: the frame of a group, or of a reductive homogeneous space.
#[derive(Clone, Copy, Debug)]
pub struct ParametricGeometry<'a> {
    pub(super) connection: &'a Connection<Symbolic>,
    pub(super) metric: Option<&'a Metric<Symbolic>>,
    pub(super) algebra: Option<&'a LieAlgebra<Symbolic>>,
}

impl<'a> ParametricGeometry<'a> {
    /// The parts of a geometry.
    ///
    /// # Errors
    /// [`Error::Unsupported`] on a chart, where the components are functions.
    pub fn of(geometry: &'a Geometry<Symbolic>) -> Result<Self, Error> {
        let algebra = geometry.algebra().filter(|_| geometry.frame_origin().fields().is_none());
        Self::new(geometry.connection(), geometry.metric(), algebra)
    }

    /// A connection, a metric and an algebra; `None` for the algebra on a homogeneous space.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the frame has derivations, as on a chart; [`Error::Shape`].
    pub fn new(
        connection: &'a Connection<Symbolic>,
        metric: Option<&'a Metric<Symbolic>>,
        algebra: Option<&'a LieAlgebra<Symbolic>>,
    ) -> Result<Self, Error> {
        if !connection.frame().is_homogeneous() {
            let message = "conditions are solved on groups and homogeneous spaces; on a chart, the \
                           components are functions of the coordinates";
            return Err(Error::Unsupported(message.into()));
        }
        if let Some(metric) = metric {
            metric.expect_dimension(connection.frame().dimension())?;
        }
        Ok(ParametricGeometry { connection, metric, algebra })
    }

    /// The letters of the connection, the brackets and the metric, in alphabetical order.
    pub fn letters(&self) -> Vec<String> {
        let mut values = self.inputs().into_iter();
        let names: BTreeSet<String> = Symbolic::parameters_of(&mut values);
        names.into_iter().collect()
    }

    /// The letters of the metric.
    pub(super) fn metric_letters(&self) -> BTreeSet<String> {
        let values = self.metric.iter().flat_map(|g| g.components().nonzero());
        Symbolic::parameters_of(&mut { values })
    }

    /// The values that define the geometry.
    fn inputs(&self) -> Vec<&Symbolic> {
        let frame = self.connection.frame();
        let tensors = [self.connection.affinities(), frame.structure_functions()];
        let metric = self.metric.iter().flat_map(|g| [g.components(), g.inverse()]);
        tensors.into_iter().chain(metric).flat_map(Tensor::nonzero).collect()
    }

    /// The factors that do not vanish: those of `det g`, and of the denominators of the components.
    pub fn nonzero(&self) -> Vec<Symbolic> {
        let mut found: Vec<Symbolic> = vec![];
        let mut seen: Vec<Symbolic> = vec![];
        for value in self.inputs() {
            let denominator = value.denominator();
            if denominator.as_constant().is_some() || seen.contains(&denominator) {
                continue;
            }
            let factors = distinct_factors(&denominator);
            found.extend(factors.into_iter().filter(|f| !found.contains(f)).collect::<Vec<_>>());
            seen.push(denominator);
        }
        found
    }

    /// Values that vanish exactly if the condition holds.
    ///
    /// # Errors
    /// [`Error::NoMetric`] if the condition needs a metric; [`Error::Unsupported`] if it needs the
    /// algebra of a group.
    pub fn values(&self, condition: Condition) -> Result<Vec<Symbolic>, Error> {
        let _stage = stage("conditions");
        let connection = self.connection;
        let all = |tensor: &Tensor<Symbolic>| tensor.nonzero().cloned().collect::<Vec<_>>();
        let metric = || self.metric.ok_or(Error::NoMetric);
        Ok(match condition {
            Condition::Flat => all(connection.curvature()),
            Condition::RicciFlat => all(&connection.ricci()),
            Condition::TorsionFree => all(&connection.torsion()),
            Condition::ParallelTorsion => all(&connection.nabla_torsion()),
            Condition::ParallelCurvature => all(&connection.nabla_curvature()),
            Condition::LocallySymmetric => {
                [all(&connection.torsion()), all(&connection.nabla_curvature())].concat()
            }
            Condition::MetricCompatible => all(&connection.nabla(metric()?.components())?),
            Condition::BiInvariant => all(&metric()?.ad_invariance_defect(self.algebra()?)?),
            Condition::Einstein => {
                let ricci = connection.ricci().raise(0, metric()?.inverse())?;
                proportional(&ricci, &Tensor::identity(ricci.dimension()))
            }
            Condition::ConstantCurvature => {
                let n = connection.frame().dimension();
                let inverse = metric()?.inverse();
                let operands = [("R", connection.curvature()), ("I", inverse)];
                let curvature = formula("R^i_mkl I^mj -> ^ij_[kl]", &operands);
                let unit = [("d", &Tensor::identity(n))];
                let unit = formula("d^i_k d^j_l - d^i_l d^j_k -> ^ij_[kl]", &unit);
                proportional(&curvature, &unit)
            }
            Condition::RicciSoliton => {
                let (metric, algebra) = (metric()?, self.algebra()?);
                let levi_civita = Connection::levi_civita(algebra.left_frame(), metric)?;
                let ricci = levi_civita.ricci().raise(0, metric.inverse())?;
                let c = algebra.structure_constants();
                // Ric is c Id + a derivation if its defect is -c times the structure constants
                let defect = formula(
                    "D^i_m c^m_jk - c^i_mk D^m_j - c^i_jm D^m_k -> ^i_[jk]",
                    &[("D", &ricci), ("c", c)],
                );
                proportional(&defect, c)
            }
        })
    }

    fn algebra(&self) -> Result<&'a LieAlgebra<Symbolic>, Error> {
        self.algebra.ok_or_else(|| {
            let message = "bi-invariance and Ricci solitons need the Lie algebra of a group";
            Error::Unsupported(message.into())
        })
    }
}

/// Values that vanish exactly if `a = s b` for some `s`, where `a` vanishes wherever `b` does.
fn proportional(a: &Tensor<Symbolic>, b: &Tensor<Symbolic>) -> Vec<Symbolic> {
    let number = |(_, value): &(_, &Symbolic)| value.as_constant().is_some();
    let places: BTreeSet<Vec<usize>> = a
        .components()
        .map(|(at, _)| at.to_vec())
        .chain(b.components().map(|(at, _)| at.to_vec()))
        .collect();
    let found = match b.components().find(number) {
        // one component of b is a number: it determines s, and neighbours give short differences
        Some((at, value)) => {
            let ratio = |value: &Symbolic, of: &Symbolic| of.recip().map(|r| value.clone() * &r);
            let mut last = ratio(&a.get(&at), value);
            let differences = places.iter().map(|at| {
                checkpoint();
                let (x, y) = (a.get(at), b.get(at));
                let own = y.as_constant().is_some().then(|| ratio(&x, &y)).flatten();
                let Some(before) = last.clone() else { return x };
                match own {
                    Some(own) => {
                        let difference = own.clone() - &before;
                        last = Some(own);
                        difference
                    }
                    None => x - &(before * &y),
                }
            });
            differences.collect::<Vec<_>>()
        }
        // otherwise the sum of squares vanishes only with b
        None => {
            let sum = |f: &dyn Fn(&[usize]) -> Symbolic| {
                places.iter().fold(Symbolic::from_i64(0), |sum, at| sum + &f(at))
            };
            let square = sum(&|at| b.get(at) * &b.get(at));
            let product = sum(&|at| a.get(at) * &b.get(at));
            let value = |at: &Vec<usize>| a.get(at) * &square - &(product.clone() * &b.get(at));
            places.iter().map(value).collect()
        }
    };
    found.into_iter().filter(|value| !value.vanishes()).collect()
}
