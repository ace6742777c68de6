//! The index notation of a contraction. It is parsed, and its names are bound to tensors.

use super::{Product, Role};
use crate::{Down, NotationError, Rational, Scalar, Tensor, TensorError, Up, Variance};
use num_rational::Ratio;
use std::borrow::Cow;
use std::ops::Range;

/// A parsed contraction.
pub(super) struct Expression<'e> {
    text: &'e str,
    terms: Vec<(Ratio<i64>, Vec<Factor<'e>>)>,
    letters: Vec<char>,
    /// The slots of the result.
    pub slots: Vec<Variance>,
    /// The ranges of result letters in which the sum is declared antisymmetric.
    pub groups: Vec<Range<usize>>,
}

/// A name with its indices.
struct Factor<'e> {
    name: &'e str,
    indices: Vec<(char, Variance)>,
}

impl<'e> Expression<'e> {
    pub fn parse(text: &'e str) -> Result<Self, TensorError> {
        let fail = |error| TensorError::Notation { expression: text.into(), error };
        let (sum, result) = text.split_once("->").ok_or_else(|| fail(NotationError::NoArrow))?;
        let (indices, groups) = indices(result.trim()).map_err(fail)?;
        let (letters, slots): (Vec<char>, _) = indices.into_iter().unzip();
        if let Some(at) = (1..letters.len()).find(|&at| letters[..at].contains(&letters[at])) {
            return Err(fail(NotationError::Twice(letters[at])));
        }
        let is_sign = |word: &&str| matches!(*word, "+" | "-");
        let mut words = sum.split_whitespace().peekable();
        let mut terms = Vec::new();
        while terms.is_empty() || words.peek().is_some() {
            let negative = words.next_if(is_sign) == Some("-");
            let mut coefficient = Rational::from(if negative { -1 } else { 1 });
            let mut factors = Vec::new();
            while let Some(word) = words.next_if(|word| !is_sign(word)) {
                match number(word) {
                    Some(number) => coefficient *= number,
                    None => factors.push(Factor::parse(word).map_err(fail)?),
                }
            }
            let words = Ratio::try_from(&coefficient);
            terms.push((words.map_err(|_| fail(NotationError::Coefficient))?, factors));
        }
        Ok(Expression { text, terms, letters, slots, groups })
    }

    /// The last two positions of the result, if they form an antisymmetric group.
    pub fn last_pair(&self) -> Option<(usize, usize)> {
        let rank = self.slots.len();
        let paired = |group: &Range<usize>| group.end == rank && group.len() >= 2;
        self.groups.iter().any(paired).then(|| (rank - 2, rank - 1))
    }

    /// Finds the operand of every name, checks ranks and variances, and assigns a role to each
    /// letter.
    pub fn bind<'a, S: Scalar>(
        &self,
        operands: &[(&str, &'a Tensor<S>)],
    ) -> Result<Vec<Product<'a, S>>, TensorError> {
        let fail = |error| TensorError::Notation { expression: self.text.into(), error };
        let mut names: Vec<&str> = operands.iter().map(|(name, _)| *name).collect();
        names.sort_unstable();
        if let Some(two) = names.windows(2).find(|two| two[0] == two[1]) {
            return Err(fail(NotationError::Ambiguous(two[0].into())));
        }
        let mut products = Vec::new();
        for (coefficient, factors) in &self.terms {
            let letters = self.roles(factors).map_err(fail)?;
            let denominator = *coefficient.denom();
            if S::from_quotient(1, denominator).is_none() {
                return Err(TensorError::NotInvertible(denominator));
            }
            let mut bound = Vec::new();
            for factor in factors {
                let name = factor.name;
                let (_, tensor) = operands
                    .iter()
                    .find(|(operand, _)| *operand == name)
                    .ok_or_else(|| fail(NotationError::Unknown(name.into())))?;
                if !factor.indices.iter().map(|(_, v)| v).eq(tensor.slots()) {
                    return Err(fail(NotationError::Slots(name.into())));
                }
                let role = |(letter, _): &(char, Variance)| {
                    letters.iter().find(|(l, _)| l == letter).map(|(_, role)| *role)
                };
                let roles = factor.indices.iter().filter_map(role).collect();
                bound.push((roles, Cow::Borrowed(*tensor)));
            }
            products.push(Product { coefficient: *coefficient, mirrored: false, factors: bound });
        }
        Ok(products)
    }

    /// The role of every letter in a term.
    fn roles(&self, factors: &[Factor]) -> Result<Vec<(char, Role)>, NotationError> {
        if factors.is_empty() {
            return Err(NotationError::NoFactor);
        }
        let all: Vec<_> = factors.iter().flat_map(|f| f.indices.iter().copied()).collect();
        let mut roles = Vec::new();
        for &(letter, variance) in &all {
            let uses: Vec<_> = all.iter().filter(|(l, _)| *l == letter).collect();
            let free = self.letters.iter().position(|&l| l == letter);
            let role = match (free, uses.as_slice()) {
                (Some(at), [_]) if self.slots[at] == variance => Role::Free(at),
                (Some(_), [_]) => return Err(NotationError::Variance(letter)),
                (None, [a, b]) if a.1 != b.1 => Role::Summed(
                    roles.iter().position(|&(l, _)| l == letter).unwrap_or(roles.len()),
                ),
                (None, [_, _]) => return Err(NotationError::Level(letter)),
                _ => return Err(NotationError::Count(letter)),
            };
            if !roles.contains(&(letter, role)) {
                roles.push((letter, role));
            }
        }
        match self.letters.iter().find(|&&l| !all.iter().any(|&(letter, _)| letter == l)) {
            Some(letter) => Err(NotationError::Missing(*letter)),
            None => Ok(roles),
        }
    }
}

impl<'e> Factor<'e> {
    fn parse(word: &'e str) -> Result<Self, NotationError> {
        let (name, rest) = word.split_at(word.find(['^', '_']).unwrap_or(word.len()));
        let (indices, groups) = indices(rest)?;
        if name.is_empty() || !name.chars().all(char::is_alphanumeric) {
            return Err(NotationError::Word(word.into()));
        }
        if !groups.is_empty() {
            return Err(NotationError::Brackets);
        }
        Ok(Factor { name, indices })
    }
}

/// Parses a coefficient: an integer, or a quotient of two integers.
fn number(word: &str) -> Option<Rational> {
    let (numerator, denominator) = word.split_once('/').unwrap_or((word, "1"));
    Rational::new(numerator.parse().ok()?, denominator.parse().ok()?)
}

/// The letters of a text such as `^ij_k[lm]` with their variances, and the ranges of letters in
/// brackets.
type Letters = (Vec<(char, Variance)>, Vec<Range<usize>>);

fn indices(text: &str) -> Result<Letters, NotationError> {
    let (mut letters, mut groups) = (Vec::new(), Vec::new());
    let (mut variance, mut open) = (None, None);
    for symbol in text.chars() {
        match (symbol, variance) {
            ('^' | '_', _) if open.is_none() => {
                variance = Some(if symbol == '^' { Up } else { Down });
            }
            ('[', Some(_)) if open.is_none() => open = Some(letters.len()),
            (']', _) => groups.push(open.take().ok_or(NotationError::Unopened)?..letters.len()),
            (letter, Some(v)) if letter.is_alphabetic() => letters.push((letter, v)),
            _ => return Err(NotationError::Symbol(symbol, text.into())),
        }
    }
    if open.is_some() {
        return Err(NotationError::Unclosed);
    }
    Ok((letters, groups))
}
