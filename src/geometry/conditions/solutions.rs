//! All real solutions of a condition on the letters of a geometry.

use super::condition::{Condition, ParametricGeometry};
use crate::Error;
use affinor_tensors::polynomial::{
    Point, RealNumber, SolutionSet, System, TooLarge, distinct_factors,
};
use affinor_tensors::stop::stage;
use affinor_tensors::{Rational, Ring, Symbolic};
use num_traits::One;
use std::collections::BTreeMap;

/// The largest number of terms of all equations, and of all equations that are solved with a limited
/// effort.
const MAX_TERMS: usize = 200_000;
const FEW_TERMS: usize = 3_000;

/// The values of all letters for which a geometry satisfies a condition.
///
/// The list is complete: every real solution is one of the points, up to the stated scale, or
/// belongs to one of the families.
///
/// ```
/// use affinor::algebra::catalogue;
/// use affinor::geometry::conditions::{Condition, ConditionSolutions, ParametricGeometry};
/// use affinor::{Connection, Metric};
/// use affinor::tensors::Symbolic;
/// let so3 = catalogue::algebra::<Symbolic>("so(3)")?;
/// let metric = Metric::diagonal(["a", "b", "c"].map(Symbolic::parameter))?;
/// let connection = Connection::levi_civita(so3.left_frame(), &metric)?;
/// let geometry = ParametricGeometry::new(&connection, Some(&metric), Some(&so3))?;
/// let found = ConditionSolutions::of(geometry, Condition::Einstein)?;
/// // the round sphere, up to scale
/// assert_eq!((found.points.len(), found.families.len()), (1, 0));
/// assert!(found.points[0].values.iter().all(|(_, value)| value.to_string() == "1"));
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ConditionSolutions {
    /// The condition.
    pub condition: Condition,
    /// The letters, in alphabetical order.
    pub letters: Vec<String>,
    /// The letters of the metric, if the equations are homogeneous in these letters. In this case,
    /// multiples of a metric are solutions too, and one letter of each point is 1.
    pub scaled: Vec<String>,
    /// The equations: the different factors of each polynomial. A polynomial vanishes if one of its
    /// factors does. A polynomial without factors never vanishes.
    pub equations: Vec<Vec<Symbolic>>,
    /// Polynomials that do not vanish, such as the factors of `det g`.
    pub nonzero: Vec<Symbolic>,
    /// The isolated solutions.
    pub points: Vec<SolutionPoint>,
    /// The solution sets of positive dimension, apart from the scale.
    pub families: Vec<SolutionFamily>,
}

/// An isolated solution.
#[derive(Clone, Debug)]
pub struct SolutionPoint {
    /// The letters and their values.
    pub values: Vec<(String, RealNumber)>,
    /// The numbers of positive and negative squares of the metric; `None` without a metric.
    pub signature: Option<[usize; 2]>,
    /// The constant `c` of an Einstein metric, or the curvature `K` of a space of constant curvature.
    pub constant: Option<RealNumber>,
}

impl SolutionPoint {
    /// Whether the metric is positive or negative definite; `None` without a metric.
    pub fn is_definite(&self) -> Option<bool> {
        self.signature.map(|signature| signature.contains(&0))
    }
}

/// A solution set of positive dimension.
#[derive(Clone, Debug)]
pub struct SolutionFamily {
    /// Equations whose real solutions are the family. Without equations, all values are solutions.
    pub equations: Vec<Symbolic>,
    /// The letters that are independent of each other.
    pub free: Vec<String>,
    /// A real point of the family, with a definite metric if one was found. Without a sample, the
    /// family may have no real points.
    pub sample: Option<SolutionPoint>,
}

impl ConditionSolutions {
    /// Finds all real values of the letters for which the condition holds.
    ///
    /// # Errors
    /// [`Error::Unsupported`] without letters, for functions of letters, and for systems that
    /// exceed the limits; the errors of [`ParametricGeometry::values`].
    pub fn of(geometry: ParametricGeometry, condition: Condition) -> Result<Self, Error> {
        Self::within(geometry, condition, None)
    }

    /// Like [`of`](Self::of), but with a limit of the effort in operations on terms.
    ///
    /// # Errors
    /// The errors of [`of`](Self::of).
    pub fn within(
        geometry: ParametricGeometry,
        condition: Condition,
        effort: Option<u64>,
    ) -> Result<Self, Error> {
        let letters = geometry.letters();
        if letters.is_empty() {
            let message = "nothing to solve for: the metric, the connection and the brackets \
                           contain no letters";
            return Err(Error::Unsupported(message.into()));
        }
        let values = geometry.values(condition)?;
        let _stage = stage("solutions");
        let limit = if effort.is_some() { FEW_TERMS } else { MAX_TERMS };
        let terms: usize = values.iter().map(|value| value.terms().len()).sum();
        if terms > limit {
            let message = format!(
                "the system of equations is too large to be solved: it has {terms} terms, but the \
                 limit is {limit}"
            );
            return Err(Error::Unsupported(message));
        }
        let nonzero = geometry.nonzero();
        let equations = equations(&values, &nonzero);
        let numerators: Vec<Symbolic> = equations
            .iter()
            .map(|factors| factors.iter().fold(Symbolic::from_i64(1), |p, f| p * f))
            .collect();
        let system = System::new(&letters, &numerators, &nonzero).ok_or_else(|| {
            let message = "the conditions contain functions or square roots; only polynomials in \
                           the letters are solved";
            Error::Unsupported(message.into())
        })?;
        let system = effort.map_or(system.clone(), |effort| system.with_effort(effort));
        let inputs = geometry.metric_letters();
        let of_metric: Vec<bool> = letters.iter().map(|letter| inputs.contains(letter)).collect();
        let homogeneous = of_metric.contains(&true) && system.is_homogeneous_in(&of_metric);
        let scaled = letters.iter().zip(&of_metric).filter(|(_, own)| **own && homogeneous);
        let scaled: Vec<String> = scaled.map(|(letter, _)| letter.clone()).collect();
        let mut found = ConditionSolutions {
            condition,
            letters,
            scaled,
            equations,
            nonzero,
            points: vec![],
            families: vec![],
        };
        found
            .solve(&system, &of_metric, geometry)
            .map_err(|e| Error::Unsupported(e.to_string()))?;
        Ok(found)
    }

    /// Whether no real values satisfy the condition.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.families.is_empty()
    }

    /// Solves the system, or its projective form: one letter of the metric is 1, and letters before
    /// it are 0.
    fn solve(
        &mut self,
        system: &System,
        of_metric: &[bool],
        geometry: ParametricGeometry,
    ) -> Result<(), TooLarge> {
        if self.scaled.is_empty() {
            let all = system.solve()?;
            self.add(system, all, None, geometry);
            return Ok(());
        }
        let own: Vec<usize> = (0..of_metric.len()).filter(|at| of_metric[*at]).collect();
        let never = own.iter().copied().find(|at| system.excludes_zero(*at));
        let strata = never.map_or(own.clone(), |at| vec![at]);
        let mut rest = system.clone();
        for letter in strata {
            let one = rest.with_value(letter, &Rational::one());
            self.add(&one, one.solve()?, Some(letter), geometry);
            rest = rest.with_value(letter, &Rational::from(0));
        }
        Ok(())
    }

    /// Adds the solutions of a system in which a letter is 1.
    fn add(
        &mut self,
        system: &System,
        all: SolutionSet,
        unit: Option<usize>,
        geometry: ParametricGeometry,
    ) {
        let point = |point: &Point| self.point(system, point, geometry);
        let points: Vec<SolutionPoint> = all.points.iter().map(point).collect();
        let families: Vec<SolutionFamily> = all
            .families
            .into_iter()
            .map(|family| {
                let samples: Vec<SolutionPoint> = family.samples.iter().map(point).collect();
                let definite = samples.iter().find(|sample| sample.is_definite() == Some(true));
                let unit = unit.map(|at| self.letters[at].as_str());
                let equations = family.equations.iter().filter_map(|f| self.scaled_back(f, unit));
                let free = self
                    .letters
                    .iter()
                    .filter(|letter| family.free.contains(letter) || unit == Some(letter.as_str()));
                SolutionFamily {
                    equations: equations.collect(),
                    free: free.cloned().collect(),
                    sample: definite.or(samples.first()).cloned(),
                }
            })
            .collect();
        self.points.extend(points);
        self.families.extend(families);
    }

    /// The homogeneous equation that becomes `f` where a letter is 1. Returns `None` for the equation
    /// that sets the letter to 1.
    fn scaled_back(&self, f: &Symbolic, unit: Option<&str>) -> Option<Symbolic> {
        let Some(unit) = unit else { return Some(f.clone()) };
        let one = Symbolic::parameter(unit);
        if *f == one.clone() - &Symbolic::from_i64(1) {
            return None;
        }
        let values: BTreeMap<String, Symbolic> = self
            .scaled
            .iter()
            .filter(|letter| *letter != unit)
            .map(|letter| (letter.clone(), Symbolic::parameter(letter) / &one))
            .collect();
        let scaled = f.substitute(&values).map(|value| value.numerator());
        Some(scaled.unwrap_or_else(|| f.clone()))
    }

    fn point(&self, system: &System, point: &Point, geometry: ParametricGeometry) -> SolutionPoint {
        let values = self.letters.iter().cloned().zip(point.values().iter().cloned());
        let signature = geometry.metric.and_then(|metric| {
            let (g, n) = (metric.components(), metric.components().dimension());
            // the square of the common denominator does not change the signs
            let one = || Symbolic::from_i64(1);
            let denominators = g.nonzero().map(Symbolic::denominator);
            let common = denominators.fold(one(), |product, d| match d == one() {
                true => product,
                false => product * &d,
            });
            let scale = common.clone() * &common;
            let entry = |i, j| g.get(&[i, j]) * &scale;
            let rows: Vec<Vec<Symbolic>> =
                (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
            let [plus, minus, _] = system.inertia(point, &rows)?;
            Some([plus, minus])
        });
        let constant = self.constant(geometry).and_then(|value| system.value(point, &value));
        SolutionPoint { values: values.collect(), signature, constant }
    }

    /// The constant of the condition, as a function of the letters.
    fn constant(&self, geometry: ParametricGeometry) -> Option<Symbolic> {
        let metric = geometry.metric?;
        let inverse = metric.inverse();
        let n = inverse.dimension();
        match self.condition {
            Condition::Einstein => {
                let ricci = geometry.connection.ricci().raise(0, inverse).ok()?;
                Some(ricci.get(&[0, 0]))
            }
            Condition::ConstantCurvature if n > 1 => {
                let scalar = geometry.connection.scalar_curvature(metric).ok()?;
                let count = Rational::new(1, (n * (n - 1)) as i64)?;
                Some(scalar * &Symbolic::constant(count))
            }
            _ => None,
        }
    }
}

/// The different factors of the numerators, without factors that do not vanish.
fn equations(values: &[Symbolic], nonzero: &[Symbolic]) -> Vec<Vec<Symbolic>> {
    let mut numerators: Vec<Symbolic> = vec![];
    let mut found: Vec<Vec<Symbolic>> = vec![];
    for value in values {
        let numerator = value.numerator();
        if numerators.contains(&numerator) {
            continue;
        }
        let factors = distinct_factors(&numerator).into_iter();
        let factors: Vec<Symbolic> = factors.filter(|f| !nonzero.contains(f)).collect();
        numerators.push(numerator);
        if !found.contains(&factors) {
            found.push(factors);
        }
    }
    found.sort_by_cached_key(|factors| {
        let text = factors.iter().map(Symbolic::to_string).collect::<Vec<_>>().join(" ");
        (text.len(), text)
    });
    found
}
