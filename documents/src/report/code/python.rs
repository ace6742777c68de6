//! Python with NumPy: the arguments are numbers or arrays that broadcast. The indices of a result
//! come after the broadcast axes.

use super::routine::{Array, Dialect, Routine, list};
use crate::input::InputError;
use affinor_tensors::scalar::Function;

struct Python;

impl Dialect for Python {
    fn component(&self, vector: &str, at: usize) -> String {
        format!("{vector}[..., {at}]")
    }
    fn call(&self, function: Function, argument: &str) -> String {
        format!("np.{}({argument})", function.name())
    }
    fn select(&self, values: [String; 4]) -> String {
        let [a, b, x, y] = values;
        format!("np.where(abs({a}) >= abs({b}), {x}, {y})")
    }
    fn definition(&self, name: &str, value: &str) -> String {
        format!("{name} = {value}")
    }
    fn assignment(&self, array: &Array, at: &[usize], value: &str) -> String {
        let at = if at.is_empty() { "...".into() } else { list(at) };
        format!("{}[{at}] = {value}", array.name)
    }
}

/// Writes numbers as a tuple in Python.
fn tuple<T: ToString>(values: &[T]) -> String {
    match values {
        [one] => format!("({},)", one.to_string()),
        several => format!("({})", list(several.iter().map(T::to_string))),
    }
}

pub fn write(routine: &Routine) -> Result<String, InputError> {
    let numbers = routine.arguments();
    let vectors: Vec<String> = routine.vectors.iter().map(|(name, _)| name.clone()).collect();
    let arguments = [vectors.as_slice(), &numbers].concat();
    let mut body = Vec::new();
    for name in &arguments {
        body.push(format!("{name} = np.asarray({name}, dtype=float)"));
    }
    let shapes = vectors.iter().map(|name| format!("{name}.shape[:-1]"));
    let shapes = shapes.chain(numbers.iter().map(|name| format!("{name}.shape")));
    body.push(format!("shape = np.broadcast_shapes({})", list(shapes)));
    for Array { name, shape, .. } in &routine.arrays {
        // makes each component contiguous; the end of the function moves the indices to the last
        // axes
        body.push(format!("{name} = np.zeros({} + shape)", tuple(shape)));
    }
    body.extend(routine.statements(&Python)?);
    let moved = routine.arrays.iter().map(|Array { name, shape, .. }| {
        let n = shape.len() as i64;
        let (from, to): (Vec<i64>, Vec<i64>) = ((0..n).collect(), (-n..0).collect());
        match n {
            0 => name.clone(),
            _ => format!("np.moveaxis({name}, {}, {})", tuple(&from), tuple(&to)),
        }
    });
    body.push(format!("return {}", list(moved)));
    let body: String = body.iter().map(|line| format!("    {line}\n")).collect();
    let about = routine.about.join("\n    ").replace('\\', "/").replace('"', "'");
    let about =
        format!("{about}\n    Arguments broadcast; indices are the last axes of the results.");
    Ok(format!(
        "import numpy as np\n\n\ndef {}({}):\n    \"\"\"{about}\"\"\"\n{body}",
        routine.function,
        arguments.join(", ")
    ))
}
