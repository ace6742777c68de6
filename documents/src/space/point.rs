//! Points: values of the coordinates, parameters and functions of a space, in floats.

use super::notation::{Names, split};
use super::request::Space;
use super::setting::no_parameter;
use crate::Coefficient;
use crate::input::{InputError, Source, shown};
use affinor_tensors::scalar::StraightLine;
use affinor_tensors::{Recorded, Symbolic, TrackedFloat};

/// The values of coordinates, parameters and functions, each with its name, in the given order.
#[derive(Clone, Debug, Default)]
pub struct Point(Vec<(String, TrackedFloat)>);

impl Point {
    /// The value of a coordinate, a parameter or a function.
    pub fn get(&self, name: &str) -> Option<TrackedFloat> {
        self.iter().find(|(own, _)| *own == name).map(|(_, value)| value)
    }

    /// The names with their values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, TrackedFloat)> {
        self.0.iter().map(|(name, value)| (name.as_str(), *value))
    }
}

impl Space {
    /// The name by which programs refer to a coordinate, a parameter, or an undetermined function
    /// such as `a(t)` or its derivative `a_t(t)`. `others` are further parameters.
    ///
    /// # Errors
    /// An error for a name that is unknown, or that already has a value.
    pub fn input(&self, text: &str, others: &[String]) -> Result<String, InputError> {
        self.input_in(&Source::new("the name of a value", text), text, others)
    }

    fn input_in(
        &self,
        source: &Source,
        text: &str,
        others: &[String],
    ) -> Result<String, InputError> {
        let place = source.whole(text);
        let labels = self.labels();
        let names = Names::open(&labels, self.definition.functions());
        let value = names.scalar(text, source)?;
        let input = Recorded::try_from(&value).ok().and_then(|value| value.as_input());
        let input = input.ok_or_else(|| {
            let message = format!(
                "`{}` is not a coordinate, a parameter or a function without a value",
                shown(text.trim())
            );
            InputError::usage(message).at(&place)
        })?;
        let name = input.text().to_string();
        if let Some(value) = self.values.get(&name) {
            let message = format!("{} has the value {value} already", shown(&name));
            return Err(InputError::usage(message).at(&place));
        }
        let mut known = self.definition.known_parameters();
        known.retain(|name| !self.values.contains_key(name));
        known.extend_from_slice(others);
        if input.is_parameter() && !known.contains(&name) {
            return Err(no_parameter(&name, &known).at(&place));
        }
        Ok(name)
    }

    /// Parses a point, `name=value,...`. Values are numbers such as `1/2`, `0.1` or `pi/3`.
    ///
    /// ```
    /// use affinor_documents::space::{Request, Space};
    /// let name = Some("so3@levi-civita;metric=diag(a,a,b)".into());
    /// let space = Space::open(&Request { space: name, ..Request::default() })?;
    /// let point = space.point("a=1/2, b=pi")?;
    /// assert_eq!(point.get("a").map(|a| a.value()), Some(0.5));
    /// assert!(space.point("c=1").unwrap_err().message.contains("`c` is not a parameter"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// An error for a name that is unknown, that already has a value, or that occurs twice, and for
    /// a value that is not a number.
    pub fn point(&self, text: &str) -> Result<Point, InputError> {
        let source = Source::new("--at", text);
        let labels = self.labels();
        let names = Names::open(&labels, self.definition.functions());
        let mut point = Point::default();
        for part in split(&source.text) {
            let place = source.whole(part);
            let Some((name, value)) = part.split_once('=') else {
                let error = InputError::usage("a value of a point is name=value").at(&place);
                return Err(error.help("separate several by commas, as in --at \"r=3,theta=pi/2\""));
            };
            let name = self.input_in(&source, name, &[])?;
            let number = number(&names.scalar(value, &source)?).ok_or_else(|| {
                let message = format!("`{}` is not a finite number", shown(value.trim()));
                InputError::usage(message).at(&source.whole(value))
            })?;
            if point.get(&name).is_some() {
                let message = format!("{} is given twice", shown(&name));
                return Err(InputError::usage(message).at(&place));
            }
            point.0.push((name, number));
        }
        Ok(point)
    }
}

impl Space {
    /// The numbers of an option: values for all `names`, as `name=value,...` or as a list in this
    /// order; or, if `others` is given, a list of so many values.
    ///
    /// # Errors
    /// An error for a wrong number of values, for an unknown name, and for a value that is not a
    /// number.
    pub fn numbers(
        &self,
        option: &str,
        text: &str,
        names: &[String],
        others: Option<usize>,
    ) -> Result<Vec<f64>, InputError> {
        let source = Source::new(option, text);
        let labels = self.labels();
        let scope = Names::open(&labels, self.definition.functions());
        let parts = split(&source.text);
        let all = || names.iter().map(|name| shown(name)).collect::<Vec<_>>().join(", ");
        let value = |part: &str| {
            number(&scope.scalar(part, &source)?).map(|value| value.value()).ok_or_else(|| {
                let message = format!("`{}` is not a finite number", shown(part.trim()));
                InputError::usage(message).at(&source.whole(part))
            })
        };
        let has_names = parts.iter().any(|part| part.contains('='));
        let mut values: Vec<Option<f64>> = vec![None; if has_names { names.len() } else { 0 }];
        for part in &parts {
            let Some((name, text)) = part.split_once('=') else {
                if has_names {
                    let message = format!("the value `{}` has no name", shown(part.trim()));
                    let help = "give all values with their names, or none";
                    return Err(InputError::usage(message).at(&source.whole(part)).help(help));
                }
                values.push(Some(value(part)?));
                continue;
            };
            let place = source.whole(name);
            let Some(at) = names.iter().position(|own| own == name.trim()) else {
                let message = format!("`{}` is not a name of a component", shown(name.trim()));
                return Err(InputError::usage(message).at(&place).help(format!("give {}", all())));
            };
            if values[at].replace(value(text)?).is_some() {
                let message = format!("{} is given twice", shown(name.trim()));
                return Err(InputError::usage(message).at(&place));
            }
        }
        let known: Option<Vec<f64>> = values.iter().copied().collect();
        if let Some(known) = known
            && (known.len() == names.len() || Some(known.len()) == others)
        {
            return Ok(known);
        }
        let found = values.iter().flatten().count();
        let count = if found == 1 { "1 value".into() } else { format!("{found} values") };
        let whole = if option == "--covector" { "a covector" } else { "a point" };
        let message = format!("{option} has {count}, but {whole} has {}", names.len());
        let error = InputError::usage(message).at(&source.whole(&source.text));
        Err(error.help(match others {
            Some(others) => format!("give {}, or the {others} entries of a matrix", all()),
            None => format!("give {}", all()),
        }))
    }
}

/// The value of an expression without parameters.
fn number(value: &Symbolic) -> Option<TrackedFloat> {
    let exact = || TrackedFloat::from_symbolic(value);
    let computed = || {
        let program = StraightLine::new(&[Recorded::try_from(value).ok()?]);
        let input = |_: &str| TrackedFloat::new(f64::NAN);
        program.evaluate(input, |function, x: &TrackedFloat| x.applied(function))?.pop()
    };
    exact().or_else(computed).filter(|number| number.value().is_finite())
}
