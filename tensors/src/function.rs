//! The elementary functions. One table contains their values, and their names in generated
//! programs.

use std::fmt;

/// An elementary function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent.
    Tan,
    /// The exponential.
    Exp,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
    /// The natural logarithm.
    Log,
    /// The square root.
    Sqrt,
}

impl Function {
    /// All functions.
    pub const ALL: [Function; 9] = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Exp,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Log,
        Function::Sqrt,
    ];

    /// The name of the function. Most programming languages use the same name.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Exp => "exp",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Log => "log",
            Function::Sqrt => "sqrt",
        }
    }

    /// The function with this name; `None` if there is no such function.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == name)
    }

    /// The value of the function in floats.
    pub fn value(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Tan => x.tan(),
            Function::Exp => x.exp(),
            Function::Sinh => x.sinh(),
            Function::Cosh => x.cosh(),
            Function::Tanh => x.tanh(),
            Function::Log => x.ln(),
            Function::Sqrt => x.sqrt(),
        }
    }

    /// The derivative at `x`, in floats. The parameter `value` is the value of the function at `x`.
    pub fn slope(self, x: f64, value: f64) -> f64 {
        match self {
            Function::Sin => x.cos(),
            Function::Cos => -x.sin(),
            Function::Tan => 1.0 + value * value,
            Function::Exp => value,
            Function::Sinh => x.cosh(),
            Function::Cosh => x.sinh(),
            Function::Tanh => 1.0 - value * value,
            Function::Log => 1.0 / x,
            Function::Sqrt => 0.5 / value,
        }
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The name of the cotangent. It is computed as a quotient of functions in the table.
const COTANGENT: &str = "cot";

/// The names of the functions that expressions may call, as text for messages.
pub(crate) fn names() -> String {
    let named = |function: Function| match function {
        Function::Tan => vec![function.name(), COTANGENT],
        _ => vec![function.name()],
    };
    Function::ALL.into_iter().flat_map(named).collect::<Vec<_>>().join(", ")
}

/// Whether a name is reserved for an elementary function. Free functions must have other names.
pub(crate) fn is_elementary(name: &str) -> bool {
    name == COTANGENT || Function::from_name(name).is_some()
}
