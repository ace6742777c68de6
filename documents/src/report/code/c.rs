//! C99: the function has the arrays as output arguments.

use super::parts::{CodeFunction, split};
use super::routine::{Array, Dialect, Routine, lengths};
use crate::input::InputError;
use affinor_tensors::scalar::Function;

struct C;

/// The shape of the array in C, where an array without indices has one component.
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
    fn select(&self, values: [String; 4]) -> String {
        let [a, b, x, y] = values;
        format!("fabs({a}) >= fabs({b}) ? {x} : {y}")
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
    let vector = |(name, n): &(String, usize)| (format!("const double {name}[{n}]"), name.clone());
    let vectors: Vec<_> = routine.vectors.iter().map(vector).collect();
    let numbers = routine.arguments().into_iter().map(|name| format!("double {name}"));
    let declared =
        |array: &Array| format!("double {}{}", array.name, lengths(shape(array), "[", "]"));
    let arrays: Vec<_> =
        routine.arrays.iter().map(|array| (declared(array), array.name.clone())).collect();
    let declarations =
        |all: &[(String, String)]| all.iter().map(|(text, _)| text.clone()).collect();
    let [before, after]: [Vec<String>; 2] = [declarations(&vectors), declarations(&arrays)];
    let arguments = before.into_iter().chain(numbers).chain(after).collect::<Vec<_>>().join(", ");
    let mut statements = Vec::new();
    for array in routine.arrays.iter().filter(|array| array.has_zeros()) {
        let size = lengths(shape(array), "[", "]");
        statements.push(format!("memset({}, 0, sizeof(double{size}));", array.name));
    }
    let cleared = !statements.is_empty();
    let lines = routine.statements(&C)?;
    let (name, parameters) = (&routine.function, routine.arguments());
    let function = CodeFunction { name, vectors, parameters: &parameters, arrays };
    let (parts, lines) = split(&function, &lines).unwrap_or_else(|| (String::new(), lines.clone()));
    statements.extend(lines);
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
        "{headers}{space}{parts}/* {about} */\nvoid {}({arguments})\n{{\n{body}}}\n",
        routine.function
    ))
}
