//! Functions that are not given: `a(t)`, `f(r,theta)`, and their derivatives `a_t(t)`, `f_r_theta(r,theta)`.
//!
//! Such a function and its partial derivatives are variables of the fractions, independent of each other and of all
//! parameters. Second derivatives do not depend on the order, so the arguments by which a function is differentiated
//! are sorted in its name, and a name is unique.

use super::function_names::is_elementary;
use super::{PositiveFactors, Symbolic};
use crate::expression::is_name;
use std::collections::BTreeMap;

/// A partial derivative of a free function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FreeFunction {
    name: String,
    arguments: Vec<String>,
    /// The places of the arguments by which it is differentiated, sorted.
    by: Vec<usize>,
}

impl FreeFunction {
    /// The function or derivative `head` of these arguments: `a_t` of `t`.
    ///
    /// # Errors
    /// In words, if an argument is no name or occurs twice, or `head` is no name of a function of these arguments.
    ///
    /// ```
    /// use affinor_tensors::scalar::FreeFunction;
    /// let f = FreeFunction::new("f_theta_r", &["r", "theta"])?;
    /// assert_eq!(f.variable(), "f_r_theta(r,theta)");
    /// assert_eq!(f.derivative("r").unwrap().variable(), "f_r_r_theta(r,theta)");
    /// assert_eq!(f.derivative("t"), None);
    /// assert!(FreeFunction::new("f_t", &["r"]).is_err());
    /// # Ok::<(), String>(())
    /// ```
    pub fn new(head: &str, arguments: &[impl AsRef<str>]) -> Result<Self, String> {
        let arguments: Vec<String> = arguments.iter().map(|name| name.as_ref().into()).collect();
        let plain = |name: &str| is_name(name) && !name.contains('_');
        for (at, name) in arguments.iter().enumerate() {
            if !plain(name) {
                return Err(format!("the arguments of `{head}` are names without `_`"));
            }
            if arguments[..at].contains(name) {
                return Err(format!("`{head}` has the argument `{name}` twice"));
            }
        }
        let mut parts = head.split('_');
        let name = parts.next().unwrap_or_default().to_string();
        if !plain(&name) || arguments.is_empty() {
            return Err(format!("`{head}` is no name of a function"));
        }
        if is_elementary(&name) {
            return Err(format!("`{name}` is another function"));
        }
        let place = |part: &str| arguments.iter().position(|own| own == part);
        let mut by: Vec<usize> = parts.map(place).collect::<Option<_>>().ok_or_else(|| {
            let all = arguments.join(", ");
            format!("`{head}` is no derivative of a function of {all}: {name}_{}", arguments[0])
        })?;
        by.sort_unstable();
        Ok(FreeFunction { name, arguments, by })
    }

    /// Reads the name of a variable, or a function as it is declared: `f(r, theta)`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn read(text: &str) -> Result<Self, String> {
        let inside = text.trim().strip_suffix(')').and_then(|rest| rest.split_once('('));
        let (head, inside) = inside.ok_or_else(|| format!("`{text}` is no function like a(t)"))?;
        let arguments: Vec<&str> = inside.split(',').map(str::trim).collect();
        Self::new(head.trim(), &arguments)
    }

    /// The name, without arguments and derivatives.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The arguments.
    pub fn arguments(&self) -> &[String] {
        &self.arguments
    }

    /// The arguments by which it is differentiated, in their order.
    pub fn differentiated_by(&self) -> impl Iterator<Item = &str> {
        self.by.iter().map(|at| self.arguments[*at].as_str())
    }

    /// The name with derivatives: `f_r_theta`.
    pub fn head(&self) -> String {
        self.differentiated_by().fold(self.name.clone(), |head, by| head + "_" + by)
    }

    /// The name of its variable in the values: `f_r_theta(r,theta)`.
    pub fn variable(&self) -> String {
        format!("{}({})", self.head(), self.arguments.join(","))
    }

    /// The partial derivative by an argument; `None` if it is none.
    pub fn derivative(&self, argument: &str) -> Option<Self> {
        let at = self.arguments.iter().position(|own| own == argument)?;
        let mut derivative = self.clone();
        derivative.by.insert(self.by.partition_point(|other| *other <= at), at);
        Some(derivative)
    }

    /// The function without derivatives.
    pub fn original(&self) -> Self {
        FreeFunction { by: vec![], ..self.clone() }
    }

    /// The function with values for some functions and parameters.
    ///
    /// # Errors
    /// In words: an argument gets a value that is no name, or the value of the function has none at its arguments.
    pub(super) fn image(
        &self,
        positive: &PositiveFactors,
        values: &BTreeMap<String, Symbolic>,
    ) -> Result<Symbolic, String> {
        let mut own = values.clone();
        own.retain(|name, _| self.arguments.contains(name));
        if let Some(value) = values.get(&self.original().variable()) {
            let derivative =
                self.differentiated_by().fold(value.clone(), |value, by| value.derivative(by));
            return derivative.substitute_where(positive, &own);
        }
        let renamed = |name: &String| match own.get(name) {
            None => Ok(name.clone()),
            Some(value) => {
                let name = value.parameters().pop();
                let name = name.filter(|name| *value == Symbolic::parameter(name));
                name.ok_or_else(|| {
                    format!("{value} is no argument of `{}`: its arguments are names", self.name)
                })
            }
        };
        let arguments = self.arguments.iter().map(renamed).collect::<Result<Vec<_>, _>>()?;
        let renamed = Self::new(&self.name, &arguments)?;
        Ok(Symbolic::parameter(&FreeFunction { by: self.by.clone(), ..renamed }.variable()))
    }
}
