//! The normalization of an initial velocity.

use crate::input::{InputError, Place, shown};
use crate::problem::initial::InitialKeys;
use crate::problem::reader::{Reader, Value};
use nalgebra::DMatrix;

/// The condition on the square `g(v, v)` of the initial velocity, and the component that it
/// determines.
#[derive(Clone, Debug)]
pub(in crate::problem) struct Normalization {
    kind: Kind,
    /// The component that is solved for; `None` if the velocity is scaled.
    solve: Option<usize>,
    /// Whether the larger root is chosen.
    larger: bool,
    place: Place,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Timelike,
    Null,
    Unit,
}

impl Normalization {
    pub fn read(
        keys: &InitialKeys,
        coordinates: &[String],
        velocity: &[Option<Value>],
        reader: &Reader,
    ) -> Result<Option<Self>, InputError> {
        let source = reader.source;
        let kind = match keys.normalize.as_deref() {
            None => {
                let unused = [("solve", &keys.solve), ("root", &keys.root)];
                let unused = unused.into_iter().find(|(_, value)| value.is_some());
                return unused.map_or(Ok(None), |(key, _)| {
                    let message = format!("`{key}` needs `normalize`, which is missing");
                    let error = source.refused(&format!("initial.{key}"), message);
                    Err(error.help("give normalize = \"timelike\", \"null\" or \"unit\""))
                });
            }
            Some("timelike") => Kind::Timelike,
            Some("null") => Kind::Null,
            Some("unit") => Kind::Unit,
            Some(other) => {
                let message = format!("`{}` is not a normalization", shown(other));
                let error = source.refused("initial.normalize", message);
                return Err(error.help("choose timelike, null or unit"));
            }
        };
        let place = source.key("initial.normalize");
        let refused = |message: &str| {
            let help = "give the coordinate whose velocity is solved for, as in solve = \"t\"";
            Err(InputError::usage(message).at(&place).help(help))
        };
        let missing: Vec<usize> =
            (0..coordinates.len()).filter(|i| velocity[*i].is_none()).collect();
        let solve = match &keys.solve {
            Some(name) => match coordinates.iter().position(|own| *own == name.content) {
                Some(i) if velocity[i].is_some() => {
                    let message = format!("the velocity of `{}` is given", shown(name));
                    let error = InputError::usage(message).at(&source.at(name));
                    return Err(error.help("leave out this component, or `solve`"));
                }
                Some(i) => Some(i),
                None => {
                    let message = format!("`{}` is not a coordinate", shown(name));
                    let help = format!("the coordinates are {}", coordinates.join(", "));
                    return Err(InputError::usage(message).at(&source.at(name)).help(help));
                }
            },
            None => match missing[..] {
                [] if kind == Kind::Null => {
                    return refused("a null velocity needs a component that is not given");
                }
                [] => None,
                [i] => Some(i),
                _ => return refused("several components of the velocity are not given"),
            },
        };
        let larger = match keys.root.as_deref() {
            None | Some("larger") => true,
            Some("smaller") => false,
            Some(other) => {
                let message = format!("`{}` is neither larger nor smaller", shown(other));
                return Err(source.refused("initial.root", message));
            }
        };
        if keys.root.is_some() && solve.is_none() {
            let error = source.refused("initial.root", "no component is solved for");
            return Err(error.help("leave the key out"));
        }
        Ok(Some(Normalization { kind, solve, larger, place }))
    }

    pub fn is_timelike(&self) -> bool {
        self.kind == Kind::Timelike
    }

    /// Completes or scales a velocity, and returns a note about the solution.
    pub fn apply(
        &self,
        metric: Option<&DMatrix<f64>>,
        coordinates: &[String],
        velocity: &mut [Option<f64>],
    ) -> Result<String, InputError> {
        let refused = |message: String| InputError::mathematics(message).at(&self.place);
        let Some(g) = metric else {
            return Err(refused("a normalization needs a metric, but the space has none".into()));
        };
        let wanted = self.square(g).map_err(refused)?;
        let given: Vec<f64> = velocity.iter().map(|value| value.unwrap_or_default()).collect();
        let Some(k) = self.solve else {
            let own = square(g, &given);
            let factor = (wanted / own).sqrt();
            if !(factor > 0.0 && factor.is_finite()) {
                let message = format!(
                    "the velocity has g(v, v) = {own}, so no multiple has g(v, v) = {wanted}"
                );
                return Err(refused(message));
            }
            velocity.iter_mut().flatten().for_each(|value| *value *= factor);
            return Ok(format!(
                "the velocity is multiplied by {factor}, so that g(v, v) = {wanted}"
            ));
        };
        let name = &coordinates[k];
        let a = g[(k, k)];
        let b: f64 = (0..given.len()).filter(|j| *j != k).map(|j| g[(k, j)] * given[j]).sum();
        let c = square(g, &given) - wanted;
        let roots = roots(a, b, c).ok_or_else(|| {
            refused(format!("no real v_{name} has g(v, v) = {wanted} with the other components"))
                .help("change the other components of the velocity")
        })?;
        let [chosen, other] = if self.larger { [roots[1], roots[0]] } else { roots };
        velocity[k] = Some(chosen);
        let which = if self.larger { "larger" } else { "smaller" };
        Ok(if chosen == other {
            format!("v_{name} = {chosen} is the only root of g(v, v) = {wanted}")
        } else {
            format!(
                "v_{name} = {chosen} is the {which} root of g(v, v) = {wanted}; the other root is {other}"
            )
        })
    }

    /// The required value of `g(v, v)`. The sign depends on the signature: a time direction is the
    /// only one with its sign.
    fn square(&self, g: &DMatrix<f64>) -> Result<f64, String> {
        if self.kind == Kind::Null {
            return Ok(0.0);
        }
        // the scales of the coordinates do not change the signature
        let scale = |i: usize| {
            let size = g.row(i).iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            if size > 0.0 && size.is_finite() { size.sqrt() } else { 1.0 }
        };
        let scaled = DMatrix::from_fn(g.nrows(), g.ncols(), |i, j| g[(i, j)] / scale(i) / scale(j));
        if scaled.iter().any(|value| !value.is_finite()) {
            return Err("the metric is not finite at the start".into());
        }
        let eigenvalues = scaled.symmetric_eigenvalues();
        let positive = eigenvalues.iter().filter(|value| **value > 0.0).count();
        let negative = eigenvalues.len() - positive;
        match (self.kind, positive, negative) {
            (Kind::Timelike, 1.., 1) => Ok(-1.0),
            (Kind::Timelike, 1, 2..) => Ok(1.0),
            (Kind::Timelike, ..) => Err(format!(
                "the metric has no time direction: its signature is ({positive}, {negative})"
            )),
            (_, 0 | 1, 2..) | (_, 0, 1) => Ok(-1.0),
            _ => Ok(1.0),
        }
    }
}

/// The square `g(v, v)`.
pub(super) fn square(g: &DMatrix<f64>, v: &[f64]) -> f64 {
    let terms = (0..v.len()).flat_map(|i| (0..v.len()).map(move |j| (i, j)));
    terms.map(|(i, j)| g[(i, j)] * v[i] * v[j]).sum()
}

/// The real roots of `a x^2 + 2 b x + c`, the smaller one first.
fn roots(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let discriminant = b * b - a * c;
    let roots = match (a == 0.0, discriminant >= 0.0) {
        (true, _) => [-0.5 * c / b; 2],
        (false, false) => return None,
        (false, true) => {
            // avoids cancellation: adds numbers of equal sign
            let q = -(b + discriminant.sqrt().copysign(b));
            if q == 0.0 { [0.0, 0.0] } else { [q / a, c / q] }
        }
    };
    let sorted = [roots[0].min(roots[1]), roots[0].max(roots[1])];
    sorted.iter().all(|root| root.is_finite()).then_some(sorted)
}
