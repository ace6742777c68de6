//! The mobility of a mechanism: rates of first order, tests of higher order, and proofs.

use super::closure::{Expansion, RationalCurve};
use super::graph::Mechanism;
use super::joint::rigid_motions;
use super::subgroups::{Division, division, generated};
use super::symmetry::{Symmetry, symmetry};
use super::twist::Twist;
use crate::tensors::Kind;
use crate::tensors::linear::Matrix;
use crate::{Error, Field, Notation, Scalar};

/// The order of expansions over numbers.
const ORDER: usize = 10;
/// The order of expansions with letters, whose coefficients grow.
const SYMBOLIC_ORDER: usize = 4;
/// The largest degree of rational curves.
const DEGREE: usize = 3;

/// A proof of bounds of the mobility.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The rates vanish, so the position is isolated.
    NoRates,
    /// The loops stay in subgroups of these dimensions, in which the closure equations are
    /// independent.
    Independent(Vec<usize>),
    /// The loop divides into two chains that reach subgroups.
    Division(Division),
    /// The loop has a symmetry.
    Symmetry(Symmetry),
    /// Coordinates that are rational functions of this degree satisfy the closure equations.
    Curve(usize),
    /// The closure equations have no solution at this order.
    Obstructed(usize),
    /// The mobility is at most the dimension of the rates.
    Rates(usize),
}

/// Bounds of the mobility, which is the dimension of the set of closed positions at the given
/// position.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The proved lower bound.
    pub lower: usize,
    /// The proved upper bound.
    pub upper: usize,
    /// The proofs of the bounds.
    pub reasons: Vec<Reason>,
}

impl Verdict {
    /// The mobility, if it is proved.
    pub fn exact(&self) -> Option<usize> {
        (self.lower == self.upper).then_some(self.lower)
    }
}

/// An account of the mobility of a mechanism at its position.
#[derive(Clone, Debug)]
pub struct Mobility<S> {
    /// The number of closure equations, six for each loop.
    pub equations: usize,
    /// The rank of the closure equations.
    pub rank: usize,
    /// A basis of the rates: vectors with one component for each joint coordinate.
    pub rates: Vec<Vec<S>>,
    /// A basis of the relations between the closure equations: six components for each loop, moments
    /// before forces. They are the reactions in equilibrium without loads.
    pub relations: Vec<Vec<S>>,
    /// For each relation, the quadratic form of the second-order test on the basis of the rates. A
    /// motion of second order begins with a common zero.
    pub forms: Vec<Vec<Vec<S>>>,
    /// The dimension of the subgroup in which each loop stays.
    pub subgroups: Vec<usize>,
    /// The expansion of the motion, if there is one rate.
    pub expansion: Option<Expansion<S>>,
    /// The highest order that was tested without an obstruction.
    pub tested: usize,
    /// The curve of closed positions in rational functions, if it was found.
    pub curve: Option<RationalCurve<S>>,
    /// The proved bounds.
    pub verdict: Verdict,
}

impl<S: Field + Scalar + Notation> Mechanism<S> {
    /// The matrix of the closure equations of first order: six rows for each loop, one column for
    /// each joint coordinate.
    ///
    /// # Errors
    /// Those of linear algebra.
    pub fn jacobian(&self) -> Result<Matrix<S>, Error> {
        let mut rows: Vec<Vec<(usize, S)>> = vec![];
        for own in self.loops() {
            let first = rows.len();
            rows.resize(first + 6, vec![]);
            for (at, twist) in self.chain(own) {
                for (i, value) in twist.into_iter().enumerate() {
                    rows[first + i].push((at, value));
                }
            }
        }
        Ok(Matrix::from_rows(self.freedom(), rows)?)
    }

    /// Determines the mobility at the position. Bounds over exact scalars are proved; with letters,
    /// they hold for generic values. Floats decide with their tolerance.
    ///
    /// # Errors
    /// Those of linear algebra.
    pub fn mobility(&self) -> Result<Mobility<S>, Error> {
        let jacobian = self.jacobian()?;
        let kernel = jacobian.nullspace()?;
        let rates = kernel.to_dense();
        let rank = self.freedom() - rates.len();
        let relations = jacobian.transpose().nullspace()?.to_dense();
        let chains: Vec<_> = self.loops().iter().map(|own| self.chain(own)).collect();
        let mut subgroups = vec![];
        for chain in &chains {
            subgroups.push(generated(chain.iter().map(|(_, twist)| twist))?.dimension());
        }
        let forms = forms(&chains, &rates, &relations)?;
        let mut mobility = Mobility {
            equations: jacobian.rows(),
            rank,
            rates,
            relations,
            forms,
            subgroups,
            expansion: None,
            tested: 1,
            curve: None,
            verdict: Verdict { lower: 0, upper: 0, reasons: vec![] },
        };
        mobility.decide(self, &jacobian, &chains)?;
        Ok(mobility)
    }
}

type Chain<S> = Vec<(usize, Twist<S>)>;

impl<S: Field + Scalar + Notation> Mobility<S> {
    fn decide(
        &mut self,
        mechanism: &Mechanism<S>,
        jacobian: &Matrix<S>,
        chains: &[Chain<S>],
    ) -> Result<(), Error> {
        let count = self.rates.len();
        let exact = |dimension: usize, reason: Reason| Verdict {
            lower: dimension,
            upper: dimension,
            reasons: vec![reason],
        };
        if count == 0 {
            self.verdict = exact(0, Reason::NoRates);
            return Ok(());
        }
        if self.rank == self.subgroups.iter().sum() {
            self.verdict = exact(count, Reason::Independent(self.subgroups.clone()));
            return Ok(());
        }
        let single = match chains {
            [chain] => Some(chain.iter().map(|(_, twist)| twist.clone()).collect::<Vec<_>>()),
            _ => None,
        };
        if let Some(found) = single.as_deref().map(division).transpose()?.flatten() {
            self.verdict = exact(found.mobility, Reason::Division(found));
            return Ok(());
        }
        let obstructs = |form: &Vec<Vec<S>>| form.iter().flatten().any(|entry| !entry.vanishes());
        let bent = self.forms.iter().any(obstructs);
        self.tested = if bent { 1 } else { 2 };
        self.verdict = match (bent, count) {
            (true, 1) => exact(0, Reason::Obstructed(2)),
            // the zeros of a form that does not vanish have a smaller dimension
            (true, _) => {
                Verdict { lower: 0, upper: count - 1, reasons: vec![Reason::Obstructed(2)] }
            }
            _ => Verdict { lower: 0, upper: count, reasons: vec![Reason::Rates(count)] },
        };
        if self.verdict.upper == 0 {
            return Ok(());
        }
        if let Some(found) = single.as_deref().map(symmetry).transpose()?.flatten()
            && found.mobility() > 0
        {
            self.verdict.lower = found.mobility();
            self.verdict.reasons.push(Reason::Symmetry(found));
        }
        if count == 1 && self.verdict.lower == 0 {
            self.expand(mechanism, jacobian)?;
        }
        Ok(())
    }

    /// Expands the motion of the only rate, and looks for a rational curve.
    fn expand(&mut self, mechanism: &Mechanism<S>, jacobian: &Matrix<S>) -> Result<(), Error> {
        let order = if S::KIND == Kind::Symbolic { SYMBOLIC_ORDER } else { ORDER };
        let expansion = Expansion::new(mechanism, jacobian, &self.rates[0], order)?;
        self.tested = expansion.obstructed.map_or(order, |order| order - 1);
        if let Some(order) = expansion.obstructed {
            self.verdict = Verdict { lower: 0, upper: 0, reasons: vec![Reason::Obstructed(order)] };
        } else if S::KIND != Kind::Float {
            for degree in 1..=DEGREE {
                if let Some(curve) = expansion.rational_curve(mechanism, degree)? {
                    self.verdict.lower = 1;
                    self.verdict.reasons.push(Reason::Curve(curve.degree()));
                    self.curve = Some(curve);
                    break;
                }
            }
        }
        self.expansion = Some(expansion);
        Ok(())
    }

    /// The coordinates of which all rates vanish.
    pub fn idle(&self) -> Vec<usize> {
        let count = self.rates.first().map_or(0, Vec::len);
        let still = |at: &usize| self.rates.iter().all(|rates| rates[*at].vanishes());
        (0..count).filter(still).collect()
    }

    /// For each joint, whether the relations determine its reaction: it is undetermined if a
    /// relation contains a wrench at the joint that does not vanish.
    pub fn determined(&self, mechanism: &Mechanism<S>) -> Vec<bool> {
        let wrench = |at: usize, relation: &[S]| {
            let mut sum: Vec<S> = vec![S::zero(); 6];
            for (own, part) in mechanism.loops().iter().zip(relation.chunks(6)) {
                let Some((_, forward)) = own.joints.iter().find(|(joint, _)| *joint == at) else {
                    continue;
                };
                for (sum, value) in sum.iter_mut().zip(part) {
                    let next = sum.clone();
                    *sum = if *forward { next + value } else { next - value };
                }
            }
            sum
        };
        let determined = |at: usize| {
            self.relations.iter().all(|relation| wrench(at, relation).iter().all(S::vanishes))
        };
        (0..mechanism.joints().len()).map(determined).collect()
    }
}

/// The quadratic forms `lambda . sum_(i<j) c_i c_j [S_i, S_j]` for each relation `lambda`, on the
/// basis of the rates `c`.
fn forms<S: Field + Scalar + Notation>(
    chains: &[Chain<S>],
    rates: &[Vec<S>],
    relations: &[Vec<S>],
) -> Result<Vec<Vec<Vec<S>>>, Error> {
    let algebra = rigid_motions::<S>()?;
    let half = S::from_quotient(1, 2).unwrap_or_else(S::zero);
    let count = rates.len();
    let mut forms = vec![vec![vec![S::zero(); count]; count]; relations.len()];
    if count == 0 || relations.is_empty() {
        return Ok(forms);
    }
    for (own, chain) in chains.iter().enumerate() {
        // partial sums of a_i S_i make the double sum linear in the length of the chain
        let mut sums = vec![vec![S::zero(); 6]; count];
        for (at, twist) in chain {
            for b in 0..count {
                if rates[b][*at].vanishes() {
                    continue;
                }
                for a in 0..count {
                    let bracket = algebra.bracket(&sums[a], twist)?;
                    for (form, relation) in forms.iter_mut().zip(relations) {
                        let part = &relation[6 * own..6 * own + 6];
                        let value = part
                            .iter()
                            .zip(&bracket)
                            .fold(S::zero(), |sum, (l, x)| sum + &(l.clone() * x));
                        let value = value * &rates[b][*at] * &half;
                        form[a][b] = form[a][b].clone() + &value;
                        form[b][a] = form[b][a].clone() + &value;
                    }
                }
            }
            for (sum, rates) in sums.iter_mut().zip(rates) {
                for (sum, value) in sum.iter_mut().zip(twist) {
                    *sum = sum.clone() + &(value.clone() * &rates[*at]);
                }
            }
        }
    }
    Ok(forms)
}
