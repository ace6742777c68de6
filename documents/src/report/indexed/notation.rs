//! Tensors with indices in a text: `Ric_11`, `R^i_jkl`, `g^{ij}`, `Lambda^t_tr`, `torsion`.

use super::super::Quantity;
use crate::Coefficient;
use affinor::Geometry;
use affinor_tensors::expression::{Expression, ExpressionError, is_name_character};
use affinor_tensors::{Down, Up, Variance};
use std::collections::BTreeSet;
use std::ops::Range;

/// The names that an expression of tensors may use.
#[derive(Clone, Debug, Default)]
pub(in crate::report) struct Names {
    pub dimension: usize,
    /// The names of the basis vectors and coordinates, each with its index from 0.
    pub indices: Vec<(String, usize)>,
    /// Parameters and coordinates, which are scalars even if a tensor has the same name.
    pub scalars: BTreeSet<String>,
}

/// An index of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::report) enum Index {
    /// A letter, free or summed.
    Letter(char),
    /// A number, from 0.
    Number(usize),
}

/// A tensor that occurs in a text.
#[derive(Clone, Debug)]
pub(in crate::report) struct Occurrence {
    pub quantity: Quantity,
    /// The byte range in the text.
    pub span: Range<usize>,
    /// The name in the text, without the indices.
    pub name: String,
    /// The indices with their variances; `None` if the text means the whole tensor.
    pub indices: Option<Vec<(Index, Variance)>>,
    /// The name of the tensor in the parsed expression.
    pub placeholder: String,
}

/// A parsed expression of tensors.
#[derive(Clone, Debug)]
pub(in crate::report) struct Parsed {
    pub text: String,
    pub expression: Expression,
    pub occurrences: Vec<Occurrence>,
}

impl Names {
    /// The names that expressions on a geometry may use; `scalars` are names of scalars.
    pub fn new<S: Coefficient>(
        geometry: &Geometry<S>,
        scalars: impl IntoIterator<Item = String>,
    ) -> Self {
        let frame = geometry.frame();
        let labels = frame.labels().iter().cloned().zip(0..);
        let fields = geometry.frame_origin().fields();
        let coordinates = fields.filter(|fields| fields.are_coordinates());
        let coordinates = coordinates.map_or(&[][..], |fields| fields.chart().coordinates());
        Names {
            dimension: frame.dimension(),
            indices: labels.chain(coordinates.iter().cloned().zip(0..)).collect(),
            scalars: scalars.into_iter().collect(),
        }
    }

    fn index(&self, name: &str) -> Option<usize> {
        self.indices.iter().find(|(other, _)| other == name).map(|(_, at)| *at)
    }

    /// Parses an expression of tensors, parameters and numbers. A space between two tensors means
    /// their product.
    ///
    /// # Errors
    /// The first syntax error; an error for a tensor with a wrong number of indices, and for an
    /// index that is out of range.
    pub fn parse(&self, text: &str) -> Result<Parsed, ExpressionError> {
        let mut occurrences: Vec<Occurrence> = Vec::new();
        let mut at = 0;
        while let Some(first) = text[at..].chars().next() {
            let rest = &text[at..];
            at = match self.occurrence(text, at)? {
                Some(found) => {
                    let end = found.span.end;
                    occurrences.push(found);
                    end
                }
                None if is_name_character(first) => at + name_length(rest),
                None => at + first.len_utf8(),
            };
        }
        let masked = masked(text, &mut occurrences)?;
        let expression = Expression::parse(&masked).map_err(|mut error| {
            for Occurrence { placeholder, span, .. } in &occurrences {
                error.reason = error.reason.replace(placeholder.as_str(), &text[span.clone()]);
            }
            error
        })?;
        Ok(Parsed { text: text.into(), expression, occurrences })
    }

    /// The tensor whose name begins at the byte `at` of the text; `None` if there is none.
    fn occurrence(&self, text: &str, at: usize) -> Result<Option<Occurrence>, ExpressionError> {
        let rest = &text[at..];
        let word = name_length(rest);
        // if there is a parameter `c`, then `c` and `c^2` mean the parameter, but `c^i_jk` means
        // the tensor
        if self.scalars.contains(&rest[..word]) && !has_both_levels(text, at + word) {
            return Ok(None);
        }
        let names = Quantity::ALL.into_iter().flat_map(|q| [(q, q.symbol()), (q, q.key())]);
        let begins = |(quantity, name): &(Quantity, &str)| {
            let Some(behind) = rest.strip_prefix(name) else { return false };
            let indexed = behind.starts_with(['^', '_']) && !quantity.slots().is_empty();
            indexed || !behind.starts_with(|c| is_name_character(c) || c == '(')
        };
        // chooses the first of several tensors with the same name, so that `g` is the metric
        let longest = names.filter(begins).rev().max_by_key(|(_, name)| name.len());
        let Some((quantity, name)) = longest else { return Ok(None) };
        let rank = quantity.slots().len();
        let (mut indices, mut end) = (vec![], at + name.len());
        while indices.len() < rank && text[end..].starts_with(['^', '_']) {
            let variance = if text[end..].starts_with('^') { Up } else { Down };
            let (run, length) = run(text, end + 1)?;
            let span = end + 1..end + 1 + length;
            let fail = |reason: String| ExpressionError { span: span.clone(), reason };
            let found = self.indices(run).map_err(fail)?;
            indices.extend(found.into_iter().map(|index| (index, variance)));
            end = span.end;
        }
        if !indices.is_empty() && indices.len() != rank {
            let reason = match rank {
                1 => format!("{name} has 1 index, not {}", indices.len()),
                _ => format!("{name} has {rank} indices, not {}", indices.len()),
            };
            return Err(ExpressionError { span: at..end, reason });
        }
        let indices = (!indices.is_empty()).then_some(indices);
        let (name, span) = (name.to_string(), at..end);
        Ok(Some(Occurrence { quantity, span, name, indices, placeholder: String::new() }))
    }

    /// The indices of a run: names, numbers or letters, optionally separated by commas or spaces.
    fn indices(&self, run: &str) -> Result<Vec<Index>, String> {
        let mut indices = Vec::new();
        for piece in run.split([',', ' ']).filter(|piece| !piece.is_empty()) {
            if let Some(at) = self.index(piece) {
                indices.push(Index::Number(at));
                continue;
            }
            let mut rest = piece;
            while let Some(first) = rest.chars().next() {
                // an index may have several digits above dimension 9
                let length = match first.is_ascii_digit() && self.dimension > 9 {
                    true => rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()),
                    false => first.len_utf8(),
                };
                let (index, behind) = rest.split_at(length);
                indices.push(self.one(index, first)?);
                rest = behind;
            }
        }
        match indices.is_empty() {
            true => Err("an index is missing".into()),
            false => Ok(indices),
        }
    }

    fn one(&self, text: &str, first: char) -> Result<Index, String> {
        if let Some(at) = self.index(text) {
            return Ok(Index::Number(at));
        }
        if !first.is_ascii_digit() {
            return Ok(Index::Letter(first));
        }
        let number = text.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        let known = number.filter(|number| *number < self.dimension);
        known
            .map(Index::Number)
            .ok_or_else(|| format!("the index {text} is not from 1 to {}", self.dimension))
    }
}

/// Whether upper indices, followed by lower indices, begin at this byte of the text.
fn has_both_levels(text: &str, at: usize) -> bool {
    text[at..].starts_with('^')
        && run(text, at + 1)
            .is_ok_and(|(_, length)| length > 0 && text[at + 1 + length..].starts_with('_'))
}

/// The length, in bytes, of the name at the start of a text.
fn name_length(text: &str) -> usize {
    text.find(|c| !is_name_character(c)).unwrap_or(text.len())
}

/// The indices at the byte `at`, such as `212`, `10,2` or `{theta phi}`, and their length in bytes,
/// including braces.
fn run(text: &str, at: usize) -> Result<(&str, usize), ExpressionError> {
    let rest = &text[at..];
    if let Some(inside) = rest.strip_prefix('{') {
        let Some(end) = inside.find('}') else {
            let reason = "`{` is not closed".into();
            return Err(ExpressionError { span: at..at + 1, reason });
        };
        return Ok((&inside[..end], end + 2));
    }
    let is_index = |c: char| c != '_' && is_name_character(c);
    let mut end = 0;
    for (place, c) in rest.char_indices() {
        let joins = c == ',' && place > 0 && rest[place + 1..].starts_with(is_index);
        if !is_index(c) && !joins {
            break;
        }
        end = place + c.len_utf8();
    }
    Ok((&rest[..end], end))
}

/// Replaces every tensor with indices by a name of the same length, and inserts `*` between
/// adjacent tensors.
fn masked(text: &str, occurrences: &mut [Occurrence]) -> Result<String, ExpressionError> {
    let unused = |prefix: &char| {
        !text
            .match_indices(*prefix)
            .any(|(at, _)| text[at + 1..].starts_with(|c: char| c.is_ascii_digit()))
    };
    let prefix = ('A'..='Z').find(unused).unwrap_or('A');
    let (mut masked, mut end) = (String::with_capacity(text.len()), 0);
    for (number, occurrence) in occurrences.iter_mut().enumerate() {
        let Range { start, end: behind } = occurrence.span.clone();
        masked += &text[end..start];
        let before = masked.trim_end();
        let (length, follows) =
            (before.len(), before.ends_with(|c| is_name_character(c) || c == ')'));
        if follows && masked[length..].starts_with([' ', '\t']) {
            masked.replace_range(length..length + 1, "*");
        }
        let width = behind - start;
        let plain = is_plain(&text[start..behind]);
        occurrence.placeholder = match plain {
            true => text[start..behind].into(),
            false => format!("{prefix}{number:0>0$}", width - 1),
        };
        if occurrence.placeholder.len() != width {
            let reason = "too many tensors in one expression".into();
            return Err(ExpressionError { span: start..behind, reason });
        }
        masked += &occurrence.placeholder;
        end = behind;
    }
    Ok(masked + &text[end..])
}

/// Whether the name of a whole tensor is also a valid name in the grammar of expressions.
fn is_plain(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && {
        Quantity::ALL.into_iter().any(|q| q.symbol() == text || q.key() == text)
    }
}
