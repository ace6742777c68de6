//! Symmetry fields on charts in the functions of the chart: linear algebra over a finite set of
//! candidate functions.
//!
//! A field is sought in the form `K^i = sum_f c^i_f f` with products `f` of functions of one
//! coordinate each. The equations `L_K g = 2 phi g` are linear in the numbers `c^i_f`.
//!
//! - A coordinate on which the metric does not depend generates a field `T`. The map `[T, .]` of the
//!   symmetry algebra shows how the fields depend on the coordinate. Its nilpotent part gives
//!   polynomials, an eigenvalue `i k` gives `sin(k x)` and `cos(k x)`, and an eigenvalue `k` gives
//!   `exp(k x)` and `exp(-k x)`. The numbers `k` that are tried are 1, the parameters of the metric and their
//!   inverses.
//! - For another coordinate, the candidates are Laurent monomials in the coordinate, and in the
//!   sines, cosines, exponentials, roots and free functions that the metric contains. Roots of
//!   polynomials of the metric, such as `sqrt(1 - H^2 r^2)`, are tried in a second search.
//!
//! The equations are first solved modulo a prime at random points, which shows the few candidates of
//! each field. Then they are solved exactly, as identities of functions, so that every field is
//! proved. A field outside the span of the candidates is not found.

use super::Symmetry;
use super::modular_point::ModularPoint;
use super::translations::Translation;
use crate::Error;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::modular::{PRIMES, ResidueMatrix};
use affinor_tensors::linear::{Echelon, Row};
use affinor_tensors::scalar::{PositiveFactors, Variable};
use affinor_tensors::stop::{checkpoint, stage};
use affinor_tensors::{Field, Notation, Ring, Symbolic, Tensor, Up};
use num_traits::{One, Zero};
use std::collections::{BTreeMap, HashMap};

/// The largest number of unknown coefficients.
const MAX_COLUMNS: usize = 1200;
/// The number of further equations beyond the unknowns, so that accidental solutions are unlikely.
const SURPLUS: usize = 20;
/// The number of points that are tried until roots exist modulo the prime.
const TRIALS: u64 = 20_000;

/// The symmetry fields that the candidates contain, as components in the coordinate frame, slot `^i`.
/// They are linearly independent, and each satisfies the equation identically.
pub(super) fn find(
    coordinates: &[String],
    metric: &Metric<Symbolic>,
    symmetry: Symmetry,
    dimension: usize,
    translations: &[Translation],
) -> Result<Vec<Tensor<Symbolic>>, Error> {
    let _stage = stage("fields");
    let mut search = Search::new(coordinates, metric, symmetry, translations);
    let mut fields = search.best(dimension)?;
    // a root that the metric does not contain may change its sign, so the fields that are odd in it
    // are sought alone
    for (at, coordinate) in coordinates.iter().enumerate() {
        if translations.iter().any(|translation| translation.coordinate == *coordinate) {
            continue;
        }
        for functions in search.roots(coordinate) {
            if fields.len() >= dimension {
                return Ok(fields);
            }
            let own = search.with_slopes(coordinate, functions);
            let even = std::mem::replace(&mut search.factors[at], own);
            fields.extend(search.best(dimension - fields.len())?);
            search.factors[at] = even;
        }
    }
    Ok(fields)
}

/// A product of functions, by the index of the function of each coordinate.
type Candidate = Vec<usize>;

/// The terms of a field: a candidate and its component, or the constant factor of a homothety.
type Support = Vec<Option<(Candidate, usize)>>;

/// A function of one coordinate.
struct Factor {
    weight: usize,
    function: Symbolic,
    slope: Symbolic,
}

struct Search<'a> {
    coordinates: &'a [String],
    metric: &'a Metric<Symbolic>,
    symmetry: Symmetry,
    /// The derivatives of the metric, `e_m(g_ij)`.
    slopes: Vec<Tensor<Symbolic>>,
    /// The functions of each coordinate.
    factors: Vec<Vec<Factor>>,
}

impl<'a> Search<'a> {
    fn new(
        coordinates: &'a [String],
        metric: &'a Metric<Symbolic>,
        symmetry: Symmetry,
        translations: &[Translation],
    ) -> Self {
        let slope = |name: &String| metric.components().map(|v| Notation::derivative(v, name));
        let slopes = coordinates.iter().map(slope).collect();
        let mut search = Search { coordinates, metric, symmetry, slopes, factors: vec![] };
        for coordinate in coordinates {
            let own = translations.iter().find(|t| t.coordinate == *coordinate);
            let functions = match own {
                Some(translation) => translation.functions(),
                None => search.functions(coordinate),
            };
            let own = search.with_slopes(coordinate, functions);
            search.factors.push(own);
        }
        search
    }

    /// The functions of a coordinate with their derivatives.
    fn with_slopes(&self, coordinate: &str, functions: Vec<(usize, Symbolic)>) -> Vec<Factor> {
        let factor = |(weight, function): (usize, Symbolic)| {
            let slope = Notation::derivative(&function, coordinate);
            Factor { weight, function, slope }
        };
        functions.into_iter().map(factor).collect()
    }

    /// The fields of the lightest candidates that have the largest number of fields.
    fn best(&self, dimension: usize) -> Result<Vec<Tensor<Symbolic>>, Error> {
        let heaviest = |factors: &Vec<Factor>| factors.iter().map(|factor| factor.weight).max();
        let most: usize = self.factors.iter().filter_map(heaviest).sum();
        let (mut best, mut known) = (vec![], 0);
        for weight in 0..=most {
            let Some(candidates) = self.candidates(weight) else { break };
            if candidates.len() == known {
                continue;
            }
            known = candidates.len();
            let Some(kernel) = self.modular(&candidates, dimension) else { break };
            if kernel.len() > best.len() {
                best = kernel.iter().map(|support| self.named(&candidates, support)).collect();
            }
            if best.len() == dimension {
                break;
            }
        }
        let mut fields = vec![];
        for support in best {
            checkpoint();
            fields.extend(self.exact(&support)?);
        }
        Ok(fields)
    }

    /// The products whose weights add up to at most `limit`, the heaviest ones first: a field is
    /// written with as few of the first ones as possible. Returns `None` if they are too many.
    fn candidates(&self, limit: usize) -> Option<Vec<Candidate>> {
        let mut all: Vec<(usize, Candidate)> = vec![(0, vec![])];
        for factors in &self.factors {
            let mut next = vec![];
            for (weight, candidate) in &all {
                for (at, factor) in factors.iter().enumerate() {
                    if weight + factor.weight <= limit {
                        let longer = [candidate.as_slice(), &[at]].concat();
                        next.push((weight + factor.weight, longer));
                    }
                }
            }
            all = next;
        }
        all.sort_by(|a, b| b.cmp(a));
        let fits = all.len() * self.coordinates.len() <= MAX_COLUMNS;
        fits.then(|| all.into_iter().map(|(_, candidate)| candidate).collect())
    }

    /// The candidate as a function.
    fn function(&self, candidate: &Candidate) -> Symbolic {
        let parts = candidate.iter().zip(&self.factors).map(|(at, own)| &own[*at].function);
        parts.fold(Symbolic::one(), |product, part| product * part)
    }

    /// The terms of some columns.
    fn named(&self, candidates: &[Candidate], columns: &[usize]) -> Support {
        let n = self.coordinates.len();
        let term = |column: &usize| {
            candidates.get(column / n).map(|candidate| (candidate.clone(), column % n))
        };
        columns.iter().map(term).collect()
    }

    /// The functions of a coordinate on which the metric depends, each with its weight.
    fn functions(&self, coordinate: &String) -> Vec<(usize, Symbolic)> {
        let mut variables: Vec<Variable> = vec![];
        for (_, value) in self.metric.components().components() {
            for part in [value.numerator(), value.denominator()] {
                for (powers, _) in part.terms() {
                    for (variable, _) in powers {
                        let depends =
                            Symbolic::variable(variable).parameters().contains(coordinate);
                        if depends && !variables.contains(&variable) {
                            variables.push(variable);
                        }
                    }
                }
            }
        }
        let mut all = vec![(0, Symbolic::one())];
        for variable in variables {
            let own = Symbolic::variable(variable);
            let others = own
                .parameters()
                .iter()
                .any(|name| name != coordinate && self.coordinates.contains(name));
            if others {
                continue;
            }
            let slope = Notation::derivative(&own, coordinate);
            let square = own.clone() * &own;
            let one = Symbolic::one();
            // the half tangent satisfies t' = k (1 + t^2)/2
            let tangent = slope * &(square.clone() + &one).recip().unwrap_or_default();
            let is_tangent = !variable.is_parameter()
                && variable.free_function().is_none()
                && variable.root().is_none()
                && Notation::derivative(&tangent, coordinate).vanishes();
            let inverse = |value: &Symbolic| value.recip().unwrap_or_default();
            if is_tangent {
                let below = inverse(&(one.clone() + &square));
                let sine = own.clone() * &Symbolic::from(2) * &below;
                let cosine = (one - &square) * &below;
                let [over_sine, over_cosine] = [inverse(&sine), inverse(&cosine)];
                all.extend([
                    (1, cosine.clone()),
                    (1, sine.clone()),
                    (1, cosine * &over_sine),
                    (2, over_sine),
                    (3, sine * &over_cosine),
                    (3, over_cosine),
                ]);
            } else {
                let weight = if variable.free_function().is_some() { 3 } else { 1 };
                let below = inverse(&own);
                all.extend([(weight, own.clone()), (weight, below.clone())]);
                all.extend([(weight + 1, square), (weight + 1, below.clone() * &below)]);
            }
        }
        all
    }

    /// Roots of functions `f` of one coordinate `x` that the metric contains, as in `f dt^2 + dx^2/f`,
    /// and their products with powers of `x`: a list for each `f`, with weights.
    fn roots(&self, coordinate: &str) -> Vec<Vec<(usize, Symbolic)>> {
        let x = Symbolic::parameter(coordinate);
        let is_other = |name: &String| name != coordinate && self.coordinates.contains(name);
        let mut arguments: Vec<Symbolic> = vec![];
        for (_, value) in self.metric.components().components() {
            for part in [value.numerator(), value.denominator()] {
                let (names, terms) = (part.parameters(), part.terms());
                let mut variables = terms.iter().flat_map(|(powers, _)| powers);
                let is_own = names.iter().any(|name| name == coordinate)
                    && !names.iter().any(is_other)
                    && variables.all(|(variable, _)| variable.is_parameter());
                if !is_own || terms.len() < 2 {
                    continue;
                }
                // the root of -f is a constant multiple; f is positive near the origin
                let is_negative = part.evaluate(|_: &str| Some(0.3)).is_some_and(|v| v < 0.0);
                let part = if is_negative { -part } else { part };
                if !arguments.contains(&part) {
                    arguments.push(part);
                }
            }
        }
        let over = x.recip().unwrap_or_default();
        let functions = |argument: &Symbolic| {
            // a field with the root is proved where the root is real, whatever the signs of letters
            let mut positive = PositiveFactors::default();
            for name in argument.parameters() {
                positive.declare(&Symbolic::parameter(&name)).ok()?;
            }
            let root = positive.assumed_root(argument).ok()?;
            let below = root.recip()?;
            let others = [(1, below.clone() * &x), (1, root.clone() * &over)];
            Some([(0, root), (1, below)].into_iter().chain(others).collect())
        };
        arguments.iter().filter_map(functions).collect()
    }

    /// The number of unknowns besides the coefficients of the candidates.
    fn further(&self) -> usize {
        usize::from(self.symmetry == Symmetry::Homothetic)
    }

    /// The pairs `(i, j)` of the equations.
    fn pairs(&self) -> Vec<(usize, usize)> {
        let n = self.coordinates.len();
        (0..n).flat_map(|i| (i..n).map(move |j| (i, j))).collect()
    }

    /// The supports of a basis of the solutions modulo a prime: the columns of the candidates with a
    /// nonzero coefficient. Returns `None` if there are no points, or more solutions than the
    /// dimension, which are accidental.
    fn modular(&self, candidates: &[Candidate], dimension: usize) -> Option<Vec<Vec<usize>>> {
        let n = self.coordinates.len();
        let pairs = self.pairs();
        let columns = n * candidates.len() + self.further();
        // points for the equations, and points that separate the candidates
        let enough = SURPLUS + columns.div_ceil(pairs.len());
        let count = enough.max(candidates.len() + SURPLUS);
        let prime = PRIMES[0];
        let mut constants = HashMap::new();
        let (mut values, mut rows) = (vec![], vec![]);
        let mut found = 0;
        for seed in 1..TRIALS {
            checkpoint();
            if found == count {
                break;
            }
            let mut at = ModularPoint { prime, seed, values: constants.clone() };
            let Some(own) = at.rows(self, candidates, &pairs) else { continue };
            if found == 0 {
                constants = at.constants(self.coordinates);
            }
            found += 1;
            values.push(own.values);
            if found <= enough {
                rows.extend(own.rows);
            }
        }
        if found < count {
            return None;
        }
        // candidates that depend linearly on others are left out
        let mut independent = ResidueMatrix::new(prime, candidates.len(), values);
        let pivots = independent.reduce();
        let kept: Vec<usize> = (0..columns)
            .filter(|column| {
                *column >= n * candidates.len() || pivots.binary_search(&(column / n)).is_ok()
            })
            .collect();
        let rows: Vec<Vec<u64>> =
            rows.iter().map(|row: &Vec<u64>| kept.iter().map(|at| row[*at]).collect()).collect();
        let kernel = ResidueMatrix::new(prime, kept.len(), rows).kernel();
        let support = |vector: &Vec<u64>| {
            let nonzero = vector.iter().zip(&kept).filter(|(value, _)| **value != 0);
            nonzero.map(|(_, at)| *at).collect()
        };
        (kernel.len() <= dimension).then(|| kernel.iter().map(support).collect())
    }

    /// The exact field with these terms, if there is one.
    fn exact(&self, support: &Support) -> Result<Option<Tensor<Symbolic>>, Error> {
        let n = self.coordinates.len();
        let names: Vec<Symbolic> = (0..support.len())
            .map(|at| Symbolic::parameter(&format!("coefficient_{at}")))
            .collect();
        let mut components = vec![Symbolic::zero(); n];
        let mut factor = Symbolic::zero();
        for (name, term) in names.iter().zip(support) {
            match term {
                Some((candidate, at)) => {
                    let term = name.clone() * &self.function(candidate);
                    components[*at] = components[*at].clone() + &term;
                }
                None => factor = name.clone(),
            }
        }
        let g = self.metric.components();
        let mut equations = BTreeMap::new();
        for (i, j) in self.pairs() {
            checkpoint();
            let mut sum = Symbolic::zero();
            for (m, component) in components.iter().enumerate() {
                sum += &(component.clone() * &self.slopes[m].get(&[i, j]));
                let along = |x: &String| Notation::derivative(component, x);
                sum += &(g.get(&[m, j]) * &along(&self.coordinates[i]));
                sum += &(g.get(&[i, m]) * &along(&self.coordinates[j]));
            }
            equations.insert((i, j), sum - &(factor.clone() * &g.get(&[i, j])));
        }
        if self.symmetry == Symmetry::Conformal {
            let mut trace = Symbolic::zero();
            for (at, inverse) in self.metric.inverse().components() {
                let pair = (at[0].min(at[1]), at[0].max(at[1]));
                trace += &(equations[&pair].clone() * inverse);
            }
            let share = trace * &Symbolic::from(n as i64).recip().unwrap_or_default();
            for ((i, j), equation) in &mut equations {
                *equation = equation.clone() - &(share.clone() * &g.get(&[*i, *j]));
            }
        }
        let mut span = Echelon::new();
        for equation in equations.values() {
            for row in self.rows_of(equation, &names) {
                span.insert(row)?;
            }
        }
        let Some(solution) = span.nullspace(names.len()).into_iter().next() else {
            return Ok(None);
        };
        let mut components = vec![Symbolic::zero(); n];
        for (at, value) in solution {
            if let Some((candidate, at)) = &support[at] {
                let place = &mut components[*at];
                *place = place.clone() + &(value * &self.function(candidate));
            }
        }
        let field = Tensor::vector(&components, Up);
        Ok((!field.is_empty()).then_some(field))
    }

    /// The linear equations for the named coefficients under which a function vanishes identically:
    /// one for each monomial in the functions of the coordinates.
    fn rows_of(&self, equation: &Symbolic, names: &[Symbolic]) -> Vec<Row<Symbolic>> {
        let mut rows: BTreeMap<Vec<(&'static str, u32)>, BTreeMap<usize, Symbolic>> =
            BTreeMap::new();
        for (powers, coefficient) in equation.numerator().terms() {
            let mut monomial = vec![];
            let mut value = Symbolic::constant(coefficient);
            let mut place = None;
            for (variable, power) in powers {
                let own = Symbolic::variable(variable);
                if let Some(at) = names.iter().position(|name| *name == own) {
                    place = Some(at);
                } else if own.parameters().iter().any(|name| self.coordinates.contains(name)) {
                    monomial.push((variable.text(), power));
                } else {
                    value *= &num_traits::pow(own, power as usize);
                }
            }
            monomial.sort_unstable();
            if let Some(at) = place {
                let sum =
                    rows.entry(monomial).or_default().entry(at).or_insert_with(Symbolic::zero);
                *sum = sum.clone() + &value;
            }
        }
        rows.into_values()
            .map(|row| row.into_iter().filter(|(_, value)| !value.vanishes()).collect())
            .collect()
    }
}

/// The values of the candidates at a point, and the equations there.
struct AtPoint {
    values: Vec<u64>,
    rows: Vec<Vec<u64>>,
}

impl ModularPoint {
    /// The values of the candidates, and a row for each equation. Columns: the component `i` of
    /// candidate `f` is `n f + i`.
    fn rows(
        &mut self,
        search: &Search,
        candidates: &[Candidate],
        pairs: &[(usize, usize)],
    ) -> Option<AtPoint> {
        let (n, prime) = (search.coordinates.len(), self.prime);
        let mut tensor = |tensor: &Tensor<Symbolic>| -> Option<Vec<Vec<u64>>> {
            let mut values = vec![vec![0; n]; n];
            for (at, value) in tensor.components() {
                values[at[0]][at[1]] = self.value(value)?;
            }
            Some(values)
        };
        let g = tensor(search.metric.components())?;
        let inverse = tensor(search.metric.inverse())?;
        let changes = search.slopes.iter().map(tensor).collect::<Option<Vec<_>>>()?;
        // the values and slopes of the functions of each coordinate
        let mut factors = vec![];
        for own in &search.factors {
            let pair =
                |factor: &Factor| Some([self.value(&factor.function)?, self.value(&factor.slope)?]);
            factors.push(own.iter().map(pair).collect::<Option<Vec<_>>>()?);
        }
        let product = |candidate: &Candidate, slope_of: Option<usize>| {
            let parts = candidate.iter().zip(&factors).enumerate();
            parts.fold(1, |product, (at, (index, own))| {
                let [value, slope] = own[*index];
                prime.mul(product, if slope_of == Some(at) { slope } else { value })
            })
        };
        let values: Vec<u64> = candidates.iter().map(|f| product(f, None)).collect();
        let share = prime.inv(n as u64)?;
        let columns = n * candidates.len() + search.further();
        let mut rows = vec![vec![0; columns]; pairs.len()];
        for (f, value) in values.iter().enumerate() {
            let slope: Vec<u64> = (0..n).map(|k| product(&candidates[f], Some(k))).collect();
            for m in 0..n {
                let entry = |i: usize, j: usize| {
                    let terms = [
                        prime.mul(*value, changes[m][i][j]),
                        prime.mul(g[m][j], slope[i]),
                        prime.mul(g[i][m], slope[j]),
                    ];
                    terms.into_iter().fold(0, |sum, term| prime.add(sum, term))
                };
                let mut part = 0;
                if search.symmetry == Symmetry::Conformal {
                    for (i, row) in inverse.iter().enumerate() {
                        for (j, raise) in row.iter().enumerate() {
                            part = prime.add(part, prime.mul(*raise, entry(i, j)));
                        }
                    }
                    part = prime.mul(part, share);
                }
                for (row, (i, j)) in rows.iter_mut().zip(pairs) {
                    let trace = prime.mul(part, g[*i][*j]);
                    row[n * f + m] = prime.add(entry(*i, *j), prime.neg(trace));
                }
            }
        }
        if search.further() > 0 {
            for (row, (i, j)) in rows.iter_mut().zip(pairs) {
                row[columns - 1] = prime.neg(g[*i][*j]);
            }
        }
        Some(AtPoint { values, rows })
    }
}
