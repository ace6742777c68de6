//! Rust: the function returns the arrays, several arrays as a tuple.

use super::routine::{Array, Dialect, Routine, lengths};
use crate::input::InputError;
use affinor_tensors::scalar::Function;

struct Rust;

impl Dialect for Rust {
    fn component(&self, vector: &str, at: usize) -> String {
        format!("{vector}[{at}]")
    }
    fn call(&self, function: Function, argument: &str) -> String {
        let name = if function == Function::Log { "ln" } else { function.name() };
        format!("f64::{name}({argument})")
    }
    fn select(&self, values: [String; 4]) -> String {
        let [a, b, x, y] = values;
        format!("if f64::abs({a}) >= f64::abs({b}) {{ {x} }} else {{ {y} }}")
    }
    fn definition(&self, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }
    fn assignment(&self, array: &Array, at: &[usize], value: &str) -> String {
        format!("{}{} = {value};", array.name, lengths(at, "[", "]"))
    }
}

/// The type or the value of a nested array, if `element` is the type or the value of an element.
fn nested(array: &Array, element: &str) -> String {
    array.shape.iter().rev().fold(element.to_string(), |inner, n| format!("[{inner}; {n}]"))
}

pub fn write(routine: &Routine) -> Result<String, InputError> {
    let vectors = routine.vectors.iter().map(|(name, n)| format!("{name}: &[f64; {n}]"));
    let numbers = routine.arguments().into_iter().map(|name| format!("{name}: f64"));
    let arguments = vectors.chain(numbers).collect::<Vec<_>>().join(", ");
    let tuple = |values: Vec<String>| match <[String; 1]>::try_from(values) {
        Ok([one]) => one,
        Err(several) => format!("({})", several.join(", ")),
    };
    let types = tuple(routine.arrays.iter().map(|array| nested(array, "f64")).collect());
    let names = tuple(routine.arrays.iter().map(|array| array.name.clone()).collect());
    let declared = |array: &Array| format!("let mut {} = {};", array.name, nested(array, "0.0f64"));
    let mut statements: Vec<String> = routine.arrays.iter().map(declared).collect();
    statements.extend(routine.statements(&Rust)?);
    let body: String = statements.iter().map(|line| format!("    {line}\n")).collect();
    let about: String = routine.about.iter().map(|line| format!("/// {line}\n")).collect();
    Ok(format!(
        "{about}#[allow(non_snake_case, unused_assignments, unused_mut, unused_parens, unused_variables, \
         clippy::all)]\n\
         pub fn {}({arguments}) -> {types} {{\n{body}    {names}\n}}\n",
        routine.function
    ))
}
