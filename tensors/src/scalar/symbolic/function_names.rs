//! The names of elementary functions, which no other function may have.

/// The names of the functions.
pub(super) const FUNCTIONS: [&str; 10] =
    ["sin", "cos", "tan", "cot", "exp", "sinh", "cosh", "tanh", "log", "sqrt"];

/// Whether this is the name of an elementary function.
pub(crate) fn is_elementary(name: &str) -> bool {
    FUNCTIONS.contains(&name)
}
