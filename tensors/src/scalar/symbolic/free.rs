//! Undetermined (free) functions, such as `a(t)` and `f(r,theta)`, and their derivatives, such as
//! `a_t(t)` and `f_r_theta(r,theta)`.
//!
//! A free function and its partial derivatives are variables of the fractions. They are independent
//! of each other and of all parameters, even if only their arguments differ. Second derivatives do
//! not depend on the order, so the positions of the arguments of differentiation are sorted. The
//! derivative with respect to the first argument of `A(r/t)` is written `A_1(r/t)`.

use super::substitution::Substitution;
use super::variable::{Kind, Variable};
use super::{PositiveFactors, Symbolic};
use crate::expression::is_name;
use crate::function::is_elementary;
use num_traits::Zero;
use std::sync::Arc;

/// A partial derivative of a free function, with the names of its arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FreeFunction {
    name: String,
    arguments: Vec<String>,
    /// The sorted positions of the arguments with respect to which the function is differentiated.
    by: Vec<usize>,
    conditions: Conditions,
}

/// Prescribed values of partial derivatives. The values are formulas of the named arguments and of
/// functions.
type Conditions = Option<Arc<Vec<Condition>>>;

#[derive(Debug, PartialEq, Eq, Hash)]
struct Condition {
    /// The name of the function.
    name: String,
    /// The sorted positions of the arguments with respect to which the function is differentiated.
    by: Vec<usize>,
    arguments: Vec<String>,
    value: Symbolic,
}

/// A partial derivative of a free function at arguments.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct Applied {
    pub name: Box<str>,
    /// The sorted positions of the arguments with respect to which the function is differentiated.
    pub by: Vec<usize>,
    pub arguments: Vec<Symbolic>,
    conditions: Conditions,
}

impl FreeFunction {
    /// The function or derivative `head` of these arguments, such as `a_t` of `t`. The derivative
    /// with respect to the first argument may also be written `a_1`.
    ///
    /// # Errors
    /// A message if an argument is not a name or occurs twice, or if `head` is not the name of a
    /// function of these arguments.
    ///
    /// ```
    /// use affinor_tensors::scalar::FreeFunction;
    /// let f = FreeFunction::new("f_theta_r", &["r", "theta"])?;
    /// assert_eq!(f.value().to_string(), "f_r_theta(r,theta)");
    /// assert_eq!(f.derivative("r").unwrap().value().to_string(), "f_r_r_theta(r,theta)");
    /// assert_eq!(f.derivative("t"), None);
    /// assert!(FreeFunction::new("f_t", &["r"]).is_err());
    /// # Ok::<(), String>(())
    /// ```
    pub fn new(head: &str, arguments: &[impl AsRef<str>]) -> Result<Self, String> {
        let arguments: Vec<String> = arguments.iter().map(|name| name.as_ref().into()).collect();
        for (at, name) in arguments.iter().enumerate() {
            if !is_plain(name) {
                return Err(format!("the arguments of `{head}` must be names without `_`"));
            }
            if arguments[..at].contains(name) {
                return Err(format!("`{head}` has the argument `{name}` twice"));
            }
        }
        let place = |part: &str| arguments.iter().position(|own| own == part);
        let (name, by) = positions(head, arguments.len(), &place)?;
        let by = by.ok_or_else(|| {
            let (name, all) = (&name, arguments.join(", "));
            format!("`{head}` is not a derivative of a function of {all}: {name}_{}", arguments[0])
        })?;
        Ok(FreeFunction { name, arguments, by, conditions: None })
    }

    /// The same functions with prescribed values for some of their derivatives. The values are
    /// formulas of the arguments and of functions without conditions. They also determine the
    /// values of higher derivatives.
    ///
    /// ```
    /// use affinor_tensors::scalar::FreeFunction;
    /// let f = FreeFunction::read("f(x,y)")?;
    /// let conditions = [("f_x", "y*f(x,y)".parse()?), ("f_y", "x*f(x,y)".parse()?)];
    /// let [g] = &FreeFunction::under_conditions(&[f.clone()], &conditions)?[..] else { panic!() };
    /// assert_eq!(g.value().derivative("x").derivative("y").to_string(), "f(x,y)*(x*y + 1)");
    /// let both = [("f_x", "y".parse()?), ("f_y", "x^2".parse()?)];
    /// assert!(FreeFunction::under_conditions(&[f], &both).unwrap_err().contains("f_x_y"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A message if a left side is not a derivative of a function, if a derivative has two values,
    /// or if a value depends on the derivative itself. Also a message if the mixed derivatives of
    /// two conditions differ.
    pub fn under_conditions(
        functions: &[Self],
        conditions: &[(&str, Symbolic)],
    ) -> Result<Vec<Self>, String> {
        let mut all: Vec<Condition> = Vec::new();
        for (head, value) in conditions {
            let name = head.split('_').next();
            let function = functions.iter().find(|f| Some(f.name()) == name);
            let unknown = || format!("`{head}` is not a derivative of a declared function");
            let function = function.ok_or_else(unknown)?;
            let FreeFunction { name, by, .. } = FreeFunction::new(head, &function.arguments)?;
            if by.is_empty() {
                return Err(unknown());
            }
            let itself = |inner: &&Applied| *inner.name == *name && contains(&inner.by, &by);
            if value.functions().iter().any(itself) {
                return Err(format!("the value of {head} contains {head} or a derivative of it"));
            }
            let related = |other: &Condition| {
                other.name == name && (contains(&by, &other.by) || contains(&other.by, &by))
            };
            if all.iter().any(related) {
                return Err(format!(
                    "{head} is given a value twice, or its value follows from another condition"
                ));
            }
            let arguments = function.arguments.clone();
            all.push(Condition { name, by, arguments, value: value.clone() });
        }
        let all = Arc::new(all);
        for (at, one) in all.iter().enumerate() {
            for other in all[..at].iter().filter(|other| other.name == one.name) {
                let mut by = one.by.clone();
                by.extend(without(&other.by, &one.by));
                by.sort_unstable();
                let mixed = Applied {
                    name: one.name.as_str().into(),
                    by,
                    arguments: one.arguments.iter().map(|name| Symbolic::parameter(name)).collect(),
                    conditions: Some(all.clone()),
                };
                if mixed.under(one) != mixed.under(other) {
                    return Err(format!("the conditions give two values of {}", mixed.head()));
                }
            }
        }
        let conditioned = |f: &Self| FreeFunction { conditions: Some(all.clone()), ..f.clone() };
        Ok(functions.iter().map(conditioned).collect())
    }

    /// Parses the declaration of a function, such as `f(r, theta)`.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn read(text: &str) -> Result<Self, String> {
        let inside = text.trim().strip_suffix(')').and_then(|rest| rest.split_once('('));
        let (head, inside) =
            inside.ok_or_else(|| format!("`{text}` is not a function of the form a(t)"))?;
        let arguments: Vec<&str> = inside.split(',').map(str::trim).collect();
        Self::new(head.trim(), &arguments)
    }

    /// The name of the function, without arguments and derivatives.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The arguments.
    pub fn arguments(&self) -> &[String] {
        &self.arguments
    }

    /// The names of the arguments with respect to which the function is differentiated, in the
    /// order of the arguments.
    pub fn differentiated_by(&self) -> impl Iterator<Item = &str> {
        self.by.iter().map(|at| self.arguments[*at].as_str())
    }

    /// The declaration of the function, such as `f(r,theta)`.
    pub fn declaration(&self) -> String {
        format!("{}({})", self.name, self.arguments.join(","))
    }

    /// The value of the function or derivative at its declared arguments.
    pub fn value(&self) -> Symbolic {
        let arguments: Vec<_> =
            self.arguments.iter().map(|name| Symbolic::parameter(name)).collect();
        self.applied(&arguments).value()
    }

    /// The value of the function or derivative at these arguments.
    ///
    /// ```
    /// use affinor_tensors::scalar::FreeFunction;
    /// let scale = FreeFunction::read("A(r)")?.at(&["r/t".parse()?])?;
    /// assert_eq!(scale.derivative("r").to_string(), "A_1(r/t)/t");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A message if the number of arguments differs, or if all arguments are numbers.
    pub fn at(&self, arguments: &[Symbolic]) -> Result<Symbolic, String> {
        if arguments.len() != self.arguments.len() {
            return Err(format!(
                "wrong number of arguments: the function is declared as {}",
                self.declaration()
            ));
        }
        self.applied(arguments).checked()
    }

    fn applied(&self, arguments: &[Symbolic]) -> Applied {
        Applied {
            name: self.name.as_str().into(),
            by: self.by.clone(),
            arguments: arguments.to_vec(),
            conditions: self.conditions.clone(),
        }
    }

    /// The partial derivative with respect to an argument. Returns `None` if no argument has this
    /// name.
    pub fn derivative(&self, argument: &str) -> Option<Self> {
        let at = self.arguments.iter().position(|own| own == argument)?;
        let mut derivative = self.clone();
        derivative.by.insert(self.by.partition_point(|other| *other <= at), at);
        Some(derivative)
    }

    /// The function or derivative with the name `head`, such as `f_r` for `f`. It has the
    /// conditions of this function.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn named(&self, head: &str) -> Result<Self, String> {
        let conditions = self.conditions.clone();
        Ok(FreeFunction { conditions, ..Self::new(head, &self.arguments)? })
    }

    /// The same function without derivatives.
    pub fn original(&self) -> Self {
        FreeFunction { by: vec![], ..self.clone() }
    }

    /// The partial derivative that the value represents. Returns `None` unless the value is a
    /// partial derivative of this function at its declared arguments.
    pub fn of_value(&self, value: &Symbolic) -> Option<Self> {
        let [variable] = value.variables() else { return None };
        let Kind::Applied(applied) = variable.kind() else { return None };
        let own = FreeFunction { by: applied.by.clone(), ..self.clone() };
        (own.value() == *value).then_some(own)
    }
}

/// Whether a sorted list contains all members of another list, with their multiplicities.
fn contains(by: &[usize], other: &[usize]) -> bool {
    by.len() >= other.len() && without(by, other).len() == by.len() - other.len()
}

/// A sorted list without the members of another list.
fn without(by: &[usize], other: &[usize]) -> Vec<usize> {
    let mut rest = by.to_vec();
    for at in other {
        if let Some(place) = rest.iter().position(|own| own == at) {
            rest.remove(place);
        }
    }
    rest
}

impl Symbolic {
    /// All free functions in the value, including those in arguments.
    fn functions(&self) -> Vec<&'static Applied> {
        let mut all = Vec::new();
        for variable in self.variables() {
            if let Kind::Applied(applied) = variable.kind() {
                all.push(applied);
            }
            variable.kind().arguments().iter().for_each(|inner| all.extend(inner.functions()));
        }
        all
    }

    /// The value, without the conditions on its free functions.
    pub(super) fn without_conditions(&self) -> Symbolic {
        match self.functions().iter().any(|function| function.conditions.is_some()) {
            true => self.with_conditions(&None),
            false => self.clone(),
        }
    }

    /// The value, with conditions on its free functions.
    fn with_conditions(&self, conditions: &Conditions) -> Symbolic {
        let mut substitution = Substitution::default();
        for function in self.functions() {
            let count = function.arguments.len();
            let arguments: Vec<String> = (1..=count).map(|at| format!("x{at}")).collect();
            let value = Applied {
                name: function.name.clone(),
                by: vec![],
                arguments: arguments.iter().map(|name| Symbolic::parameter(name)).collect(),
                conditions: conditions.clone(),
            };
            substitution.add_function(&function.name, &arguments, value.value());
        }
        if substitution.has_no_functions() {
            return self.clone();
        }
        let positive = PositiveFactors::default();
        self.substitute_where(&positive, &substitution).unwrap_or_else(|_| self.clone())
    }
}

/// Whether the text is a name without `_`.
fn is_plain(name: &str) -> bool {
    is_name(name) && !name.contains('_')
}

/// Parses the name of a function, and the arguments of differentiation: `f_r_1` is the derivative
/// of `f` with respect to `r` and to the first argument. Returns `None` if the function does not
/// have such an argument.
///
/// # Errors
/// A message if `head` is not the name of a function.
fn positions(
    head: &str,
    count: usize,
    place: &dyn Fn(&str) -> Option<usize>,
) -> Result<(String, Option<Vec<usize>>), String> {
    let mut parts = head.split('_');
    let name = parts.next().unwrap_or_default().to_string();
    if !is_plain(&name) || count == 0 {
        return Err(format!("`{head}` is not the name of a function"));
    }
    if is_elementary(&name) {
        return Err(format!("`{name}` is the name of an elementary function"));
    }
    let numbered = |part: &str| {
        let number = part.parse::<usize>().ok().filter(|number| (1..=count).contains(number));
        number.map(|number| number - 1)
    };
    let by: Option<Vec<usize>> = parts.map(|part| place(part).or_else(|| numbered(part))).collect();
    let sorted = |mut by: Vec<usize>| {
        by.sort_unstable();
        by
    };
    Ok((name, by.map(sorted)))
}

impl Applied {
    /// The function or derivative `head` at these arguments. If arguments are names, these names
    /// may occur in `head`.
    ///
    /// # Errors
    /// A message if `head` is not the name of a function of these arguments, or if all arguments
    /// are numbers.
    pub fn read(head: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
        let names: Vec<Option<&str>> = arguments.iter().map(Symbolic::as_parameter).collect();
        let place = |part: &str| names.iter().position(|name| *name == Some(part));
        let (name, by) = positions(head, arguments.len(), &place)?;
        let by = by.ok_or_else(|| {
            let all: Vec<String> = arguments.iter().map(Symbolic::to_string).collect();
            format!("`{head}` is not a derivative of a function of {}: {name}_1", all.join(", "))
        })?;
        Applied { name: name.into(), by, arguments: arguments.to_vec(), conditions: None }.checked()
    }

    /// The value of the function. Returns an error if all arguments are numbers.
    fn checked(self) -> Result<Symbolic, String> {
        if self.arguments.iter().all(|value| value.parameters().is_empty()) {
            return Err(format!("the value of `{}` at a number is not known", self.name));
        }
        Ok(self.value())
    }

    /// The value of the function. If a derivative has a condition, this is the prescribed value.
    pub fn value(self) -> Symbolic {
        let conditions = self.conditions.clone();
        let mut all = conditions.iter().flat_map(|all| all.iter());
        let own = |condition: &&Condition| {
            *condition.name == *self.name && contains(&self.by, &condition.by)
        };
        match all.find(own) {
            Some(condition) => self.under(condition),
            None => Symbolic::variable(Variable::function(Kind::Applied(self))),
        }
    }

    /// The value of a derivative that is a further derivative of the left side of a condition.
    fn under(&self, condition: &Condition) -> Symbolic {
        let by = without(&self.by, &condition.by).into_iter();
        let by = by.map(|at| Variable::parameter(&condition.arguments[at]));
        let value = by.fold(condition.value.with_conditions(&self.conditions), |value, by| {
            value.derivative_by(by)
        });
        let own = condition.arguments.iter().map(|name| Symbolic::parameter(name));
        if own.eq(self.arguments.iter().cloned()) {
            return value;
        }
        let at = condition.arguments.iter().cloned().zip(self.arguments.iter().cloned()).collect();
        let positive = PositiveFactors::default();
        value.substitute_where(&positive, &Substitution::of_parameters(at)).unwrap_or(value)
    }

    /// The names of the arguments. Returns `None` unless they are different names without `_`.
    pub fn names(&self) -> Option<Vec<&str>> {
        let name = |value| Symbolic::as_parameter(value).filter(|name| is_plain(name));
        let names = self.arguments.iter().map(name).collect::<Option<Vec<&str>>>()?;
        let twice = |at: usize| names[..at].contains(&names[at]);
        (!(0..names.len()).any(twice)).then_some(names)
    }

    /// The arguments with respect to which the function is differentiated. They are the names of
    /// the arguments or, if these are not names, their numbers from 1.
    pub fn differentiated_by(&self) -> Vec<String> {
        match self.names() {
            Some(names) => self.by.iter().map(|at| names[*at].to_string()).collect(),
            None => self.by.iter().map(|at| (at + 1).to_string()).collect(),
        }
    }

    /// The partial derivative with respect to a parameter, computed by the chain rule.
    pub fn derivative(&self, parameter: Variable) -> Symbolic {
        let terms = self.arguments.iter().enumerate().map(|(at, argument)| {
            let slope = argument.derivative_by(parameter);
            if slope.is_zero() {
                return slope;
            }
            let mut derivative = self.clone();
            derivative.by.insert(self.by.partition_point(|other| *other <= at), at);
            derivative.value() * &slope
        });
        terms.fold(Symbolic::zero(), |sum, term| sum + &term)
    }

    /// The function after a substitution of functions and parameters.
    ///
    /// # Errors
    /// A message if all arguments become numbers, or if the substituted function has no value at
    /// its arguments.
    pub fn image(
        &self,
        positive: &PositiveFactors,
        values: &Substitution,
    ) -> Result<Symbolic, String> {
        let arguments = self.arguments.iter();
        let arguments = arguments.map(|argument| argument.substitute_where(positive, values));
        let arguments = arguments.collect::<Result<Vec<_>, _>>()?;
        let Some((names, value)) = values.function(&self.name, arguments.len()) else {
            return Applied { arguments, ..self.clone() }.checked();
        };
        let by = self.by.iter().map(|at| Variable::parameter(&names[*at]));
        let derivative = by.fold(value.clone(), |value, by| value.derivative_by(by));
        let at = names.iter().cloned().zip(arguments).collect();
        derivative.substitute_where(positive, &Substitution::of_parameters(at))
    }
}
