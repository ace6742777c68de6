//! Groebner bases by Buchberger's algorithm with the criteria of Gebauer and Moeller (*J. Symb.
//! Comp.* 6 (1988) 275-286).
//!
//! Every new polynomial is factored. Factors that do not vanish are removed, and several other
//! factors split the system into cases. Only the real zeros are preserved, not the ideal.

use super::factors::primitive;
use super::reality::cases;
use super::{Budget, Polynomial, TooLarge};
use polycore::{Monomial, Order};
use std::collections::BTreeSet;

/// The largest total degree of a polynomial.
const MAX_DEGREE: u32 = 60;
/// The largest number of terms of a polynomial.
const MAX_TERMS: usize = 5000;

/// The outcome of the computation of a Groebner basis.
pub(super) enum Outcome {
    /// The reduced Groebner basis.
    Basis(Vec<Polynomial>),
    /// Systems that have together the same real zeros.
    Cases(Vec<Vec<Polynomial>>),
}

/// A pair of polynomials of the basis, sorted by the degree of the least common multiple of their
/// leading monomials.
type Pair = (u32, usize, usize);

/// A basis under construction.
struct Construction<'a> {
    nonzero: &'a [Polynomial],
    order: &'a Order,
    all: Vec<Polynomial>,
    /// The polynomials whose leading monomials are not multiples of later ones.
    active: Vec<usize>,
    pairs: BTreeSet<Pair>,
    waiting: Vec<Polynomial>,
}

/// The Groebner basis of the equations, or the cases into which the equations split. In all
/// solutions, the polynomials `nonzero` do not vanish.
pub(super) fn basis(
    equations: &[Polynomial],
    nonzero: &[Polynomial],
    order: &Order,
    budget: &mut Budget,
) -> Result<Outcome, TooLarge> {
    let nonzero: Vec<_> = nonzero.iter().map(|f| f.reorder(order.clone())).collect();
    let nonzero: Vec<_> = nonzero.iter().map(primitive).collect();
    let mut waiting: Vec<_> = equations.iter().map(|f| f.reorder(order.clone())).collect();
    // takes small polynomials first, from the end of the list
    waiting.sort_by_key(|f| std::cmp::Reverse((f.total_degree(), f.terms.len())));
    let (all, active, pairs) = (vec![], vec![], BTreeSet::new());
    let mut construction = Construction { nonzero: &nonzero, order, all, active, pairs, waiting };
    loop {
        let next = match construction.waiting.pop() {
            Some(next) => next,
            None => match construction.pairs.pop_first() {
                Some((_, i, j)) => construction.all[i].spoly(&construction.all[j]),
                None => return construction.reduced(budget),
            },
        };
        if let Some(cases) = construction.add(&next, budget)? {
            return Ok(Outcome::Cases(cases));
        }
    }
}

impl Construction<'_> {
    /// Reduces a polynomial and adds it to the basis. Returns the cases if it splits.
    fn add(
        &mut self,
        f: &Polynomial,
        budget: &mut Budget,
    ) -> Result<Option<Vec<Vec<Polynomial>>>, TooLarge> {
        let divisors: Vec<&Polynomial> = self.active.iter().map(|at| &self.all[*at]).collect();
        let remainder = remainder(f, &divisors, budget)?;
        if remainder.is_zero() {
            return Ok(None);
        }
        if remainder.total_degree() > MAX_DEGREE {
            return Err(TooLarge("the degrees in its Groebner bases are too high"));
        }
        if remainder.terms.len() > MAX_TERMS {
            return Err(TooLarge("its Groebner bases have too many terms"));
        }
        let mut cases = cases(&remainder, self.nonzero);
        match (cases.pop(), cases.is_empty()) {
            (Some(case), true) => {
                if let [only] = &case[..]
                    && *only == primitive(&remainder)
                {
                    self.insert(only.monic());
                } else {
                    // the remainder is processed again, after the polynomials of the case
                    self.waiting.push(remainder);
                    self.waiting.extend(case);
                }
                Ok(None)
            }
            (last, _) => {
                let cases = cases.into_iter().chain(last);
                let known: Vec<_> = self.all.iter().chain(&self.waiting).cloned().collect();
                Ok(Some(cases.map(|case| [known.clone(), case].concat()).collect()))
            }
        }
    }

    /// Adds a reduced monic polynomial, and updates the pairs.
    fn insert(&mut self, f: Polynomial) {
        let Some(lead) = f.lm().cloned() else { return };
        let new = self.all.len();
        let head = |at: usize| self.all[at].lm().cloned().unwrap_or_else(|| lead.clone());
        let heads: Vec<Monomial> = (0..new).map(head).collect();
        // old pairs whose least common multiple is a proper multiple of those with the new lead
        self.pairs.retain(|(_, i, j)| {
            let common = heads[*i].lcm(&heads[*j]);
            !lead.divides(&common)
                || heads[*i].lcm(&lead) == common
                || heads[*j].lcm(&lead) == common
        });
        let mut fresh: Vec<(Monomial, usize)> =
            self.active.iter().map(|at| (heads[*at].lcm(&lead), *at)).collect();
        fresh.sort_by_key(|(common, at)| (common.degree(), !heads[*at].is_coprime(&lead), *at));
        let mut kept: Vec<(Monomial, usize)> = vec![];
        for (common, at) in fresh {
            if !kept.iter().any(|(other, _)| other.divides(&common)) {
                kept.push((common, at));
            }
        }
        let needed = kept.into_iter().filter(|(_, at)| !heads[*at].is_coprime(&lead));
        self.pairs.extend(needed.map(|(common, at)| (common.degree(), at, new)));
        self.active.retain(|at| !lead.divides(&heads[*at]));
        self.active.push(new);
        self.all.push(f);
    }

    /// The reduced basis.
    fn reduced(&self, budget: &mut Budget) -> Result<Outcome, TooLarge> {
        let mut basis = vec![];
        for at in &self.active {
            let others = self.active.iter().filter(|other| *other != at);
            let others: Vec<&Polynomial> = others.map(|other| &self.all[*other]).collect();
            basis.push(remainder(&self.all[*at], &others, budget)?.monic());
        }
        basis.sort_by(|f, g| match (f.lm(), g.lm()) {
            (Some(f), Some(g)) => self.order.compare(f, g),
            _ => std::cmp::Ordering::Equal,
        });
        Ok(Outcome::Basis(basis))
    }
}

/// The remainder of a polynomial after divisions. No term is a multiple of a leading monomial.
pub(super) fn remainder(
    f: &Polynomial,
    divisors: &[&Polynomial],
    budget: &mut Budget,
) -> Result<Polynomial, TooLarge> {
    let heads: Vec<_> = divisors.iter().filter_map(|g| g.lt().map(|lead| (lead, *g))).collect();
    let mut rest = f.clone();
    let mut done = vec![];
    while let Some((m, c)) = rest.terms.first() {
        let found =
            heads.iter().find_map(|((lead, scale), g)| Some((m.quo(lead)?, c.clone() / scale, *g)));
        match found {
            Some((shift, factor, g)) => {
                let bits = 1 + crate::Notation::size(&factor) / 64;
                budget.spend((rest.terms.len() + g.terms.len()) * bits)?;
                rest = rest.sub_mul(&factor, &shift, g);
            }
            None => done.push(rest.terms.remove(0)),
        }
    }
    rest.terms = done;
    Ok(rest)
}
