//! C99: the arrays are arguments that are written.

use super::routine::{Array, Dialect, Routine, lengths};
use crate::definition::InputError;
use affinor_tensors::scalar::Function;

struct C;

/// An array without indices has one component.
fn shape(array: &Array) -> &[usize] {
    if array.shape.is_empty() { &[1] } else { &array.shape }
}

impl Dialect for C {
    fn component(&self, vector: &str, at: usize) -> String {
        format!("{vector}[{at}]")
    }
    fn call(&self, function: Function, argument: &str) -> String {
        format!("{}({argument})", function.name())
    }
    fn definition(&self, name: &str, value: &str) -> String {
        format!("const double {name} = {value};")
    }
    fn assignment(&self, array: &Array, at: &[usize], value: &str) -> String {
        let at = if at.is_empty() { &[0] } else { at };
        format!("{}{} = {value};", array.name, lengths(at, "[", "]"))
    }
}

pub fn write(routine: &Routine) -> Result<String, InputError> {
    let vectors = routine.vectors.iter().map(|(name, n)| format!("const double {name}[{n}]"));
    let numbers = routine.arguments().into_iter().map(|name| format!("double {name}"));
    let declared =
        |array: &Array| format!("double {}{}", array.name, lengths(shape(array), "[", "]"));
    let arrays = routine.arrays.iter().map(declared);
    let arguments = vectors.chain(numbers).chain(arrays).collect::<Vec<_>>().join(", ");
    let mut statements = Vec::new();
    for array in routine.arrays.iter().filter(|array| array.has_zeros()) {
        let size = lengths(shape(array), "[", "]");
        statements.push(format!("memset({}, 0, sizeof(double{size}));", array.name));
    }
    let cleared = !statements.is_empty();
    statements.extend(routine.statements(&C)?);
    let body: String = statements.iter().map(|line| format!("    {line}\n")).collect();
    let about = routine.about.join("\n   ").replace("*/", "* /").replace("/*", "/ *");
    let mut headers = String::new();
    for (needed, header) in [(routine.calls(), "math"), (cleared, "string")] {
        if needed {
            headers.push_str(&format!("#include <{header}.h>\n"));
        }
    }
    let space = if headers.is_empty() { "" } else { "\n" };
    Ok(format!(
        "{headers}{space}/* {about} */\nvoid {}({arguments})\n{{\n{body}}}\n",
        routine.function
    ))
}
