//! Metrics by words that depend on the space: the Killing form, the general invariant metric, and
//! factors of isotropy summands.

use super::homogeneous::CosetSpace;
use super::{Definition, MetricChoice};
use crate::Coefficient;
use crate::input::InputError;
use affinor::ReductivePair;
use affinor::algebra::structure::GroundField;
use affinor_tensors::{Rational, Ring, Symbolic, Tensor, Tolerance};
use num_traits::Zero;
use std::collections::{BTreeMap, BTreeSet};

/// The beginning of the note on the metric.
const METRIC: &str = "metric: ";

type Components = Vec<([usize; 2], Symbolic)>;

impl Definition {
    /// Multiplies the metric by the square of a conformal factor.
    ///
    /// # Errors
    /// An error without a metric, for the Killing form, for a factor that is zero, and for one that
    /// is not constant on a homogeneous space.
    pub(super) fn rescale_metric(&mut self, factor: &Symbolic) -> Result<(), InputError> {
        let refuse = |message: &str, help: &str| Err(InputError::usage(message).help(help));
        if factor.vanishes() {
            return refuse("the conformal factor is zero", "give a function that is not zero");
        }
        let square = factor.clone() * factor;
        let n = self.dimension();
        match &mut self.metric {
            Some(MetricChoice::Components(entries, _)) => {
                for (_, value) in entries {
                    *value = value.clone() * &square;
                }
            }
            Some(metric @ MetricChoice::Identity) => {
                let entries = (0..n).map(|i| ([i, i], square.clone())).collect();
                *metric = MetricChoice::Components(entries, None);
            }
            Some(_) => {
                let help = "give the metric in components, as in diag(1, 1, 2)";
                return refuse("this metric cannot be rescaled", help);
            }
            None => {
                let help = "give a metric, as in --metric identity";
                return refuse("a conformal factor needs a metric", help);
            }
        }
        Ok(())
    }

    /// Sets the metric. Words that depend on the space become components.
    ///
    /// # Errors
    /// An error for a word that the space does not have, and for factors that are not one for each
    /// isotropy summand.
    pub(super) fn set_metric(&mut self, choice: MetricChoice) -> Result<(), InputError> {
        let rational = self.coset_space().is_some_and(CosetSpace::is_rational);
        self.notes.retain(|note| !note.starts_with(METRIC));
        let choice = match (choice, self.coset_space()) {
            (MetricChoice::Killing(place), Some(coset)) => {
                let (form, sign) = match rational {
                    true => killing::<Rational>(coset),
                    false => killing::<Symbolic>(coset),
                }
                .map_err(|error| error.or_at(&place))?;
                let sign = if sign < 0 { "minus the" } else { "the" };
                let algebra = &coset.algebra;
                let note = format!("{METRIC}{sign} Killing form of {algebra} on the complement");
                self.notes.push(note);
                MetricChoice::Components(form, Some(place))
            }
            (MetricChoice::Invariant(place), coset) => {
                let forms = match coset {
                    Some(coset) if rational => invariant::<Rational>(coset),
                    Some(coset) => invariant::<Symbolic>(coset),
                    None if self.is_on_chart() => {
                        let message = "a chart has no invariant metrics: its frame has no group";
                        Err(InputError::usage(message))
                    }
                    None => Ok(all_forms(self.dimension())),
                };
                let forms = forms.map_err(|error| error.or_at(&place))?;
                MetricChoice::Components(self.general(&forms), Some(place))
            }
            (MetricChoice::Summands(factors, place), coset) => {
                let forms = match coset {
                    Some(coset) if rational => summands(coset),
                    Some(_) => {
                        let message = "isotropy summands are found over the rational numbers only";
                        Err(InputError::usage(message).help("set all parameters of the algebra"))
                    }
                    None => {
                        let message = "only a homogeneous space G/H has isotropy summands";
                        Err(InputError::usage(message))
                    }
                };
                let forms = forms.map_err(|error| error.or_at(&place))?;
                if forms.len() != factors.len() {
                    let (found, count) = (factors.len(), forms.len());
                    let message = format!(
                        "{found} factors for {count} isotropy summands; `affinor info` lists them"
                    );
                    return Err(InputError::usage(message).at(&place));
                }
                MetricChoice::Components(combined(&forms, &factors), Some(place))
            }
            (choice, _) => choice,
        };
        self.metric = Some(choice);
        Ok(())
    }

    /// The combination of forms with letters as factors: `x1, x2, ...` for forms that begin with a
    /// diagonal component, `y1, y2, ...` for others.
    fn general(&self, forms: &[Components]) -> Components {
        let mut taken: BTreeSet<String> = self.known_parameters().into_iter().collect();
        taken.extend(self.labels.iter().cloned());
        let free = |letter: &str| {
            let mut letter = letter.to_string();
            let numbered = |name: &String, letter: &str| {
                name.strip_prefix(letter).is_some_and(|rest| rest.parse::<usize>().is_ok())
            };
            while taken.iter().any(|name| numbered(name, &letter)) {
                letter.push('_');
            }
            letter
        };
        let letters = [free("x"), free("y")];
        let mut counts = [0; 2];
        let factors = forms.iter().map(|form| {
            let first = form.iter().map(|(at, _)| *at).min();
            let kind = usize::from(first.is_some_and(|[i, j]| i != j));
            counts[kind] += 1;
            Symbolic::parameter(&format!("{}{}", letters[kind], counts[kind]))
        });
        let factors: Vec<_> = factors.collect();
        combined(forms, &factors)
    }
}

/// A combination of forms.
fn combined(forms: &[Components], factors: &[Symbolic]) -> Components {
    let mut sum = BTreeMap::<[usize; 2], Symbolic>::new();
    for (form, factor) in forms.iter().zip(factors) {
        for (at, value) in form {
            let entry = sum.entry(*at).or_insert_with(Symbolic::zero);
            *entry = entry.clone() + &(value.clone() * factor);
        }
    }
    sum.into_iter().filter(|(_, value)| !value.vanishes()).collect()
}

/// All symmetric forms: the diagonal components, then the others.
fn all_forms(n: usize) -> Vec<Components> {
    let diagonal = (0..n).map(|i| (i, i));
    let others = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let form = |(i, j): (usize, usize)| {
        let places = if i == j { vec![[i, i]] } else { vec![[i, j], [j, i]] };
        places.into_iter().map(|at| (at, Symbolic::from_i64(1))).collect()
    };
    diagonal.chain(others).map(form).collect()
}

fn components<E: GroundField>(form: &Tensor<E>) -> Components {
    form.components().map(|(at, value)| ([at[0], at[1]], value.symbolic())).collect()
}

fn pair<E: GroundField + Coefficient>(coset: &CosetSpace) -> Result<ReductivePair<E>, InputError> {
    let space = coset.space::<E>("", &coset.labels(), Tolerance::default())?;
    Ok(space.pair().clone())
}

/// The metric of the Killing form, and its sign.
fn killing<E: GroundField + Coefficient>(
    coset: &CosetSpace,
) -> Result<(Components, i64), InputError> {
    let pair = pair::<E>(coset)?;
    let sign = pair.killing_sign()?;
    Ok((components(&pair.killing_form()?.scale(&E::from_i64(sign))), sign))
}

fn invariant<E: GroundField + Coefficient>(
    coset: &CosetSpace,
) -> Result<Vec<Components>, InputError> {
    Ok(pair::<E>(coset)?.invariant_forms()?.iter().map(components).collect())
}

fn summands(coset: &CosetSpace) -> Result<Vec<Components>, InputError> {
    Ok(pair::<Rational>(coset)?.summand_forms()?.iter().map(components).collect())
}
