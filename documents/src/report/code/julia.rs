//! Julia: the arrays are returned, several as a tuple; indices count from 1.

use super::routine::{Array, Dialect, Routine, list};
use crate::definition::InputError;
use affinor_tensors::scalar::Function;

struct Julia;

impl Dialect for Julia {
    fn component(&self, vector: &str, at: usize) -> String {
        format!("{vector}[{}]", at + 1)
    }
    fn call(&self, function: Function, argument: &str) -> String {
        format!("{}({argument})", function.name())
    }
    fn select(&self, values: [String; 4]) -> String {
        let [a, b, x, y] = values;
        format!("abs({a}) >= abs({b}) ? {x} : {y}")
    }
    fn definition(&self, name: &str, value: &str) -> String {
        format!("{name} = {value}")
    }
    fn assignment(&self, array: &Array, at: &[usize], value: &str) -> String {
        match at {
            [] => format!("{} = {value}", array.name),
            _ => format!("{}[{}] = {value}", array.name, list(at.iter().map(|i| i + 1))),
        }
    }
}

pub fn write(routine: &Routine) -> Result<String, InputError> {
    let numbers = routine.arguments();
    let vectors: Vec<String> = routine.vectors.iter().map(|(name, _)| name.clone()).collect();
    let types = vectors.iter().map(|name| format!("eltype({name})"));
    let types: Vec<String> =
        types.chain(numbers.iter().map(|name| format!("typeof({name})"))).collect();
    let mut body = vec![match types.as_slice() {
        [] => "T = Float64".to_string(),
        types => format!("T = float(promote_type({}))", list(types)),
    }];
    for Array { name, shape, .. } in &routine.arrays {
        body.push(match shape.as_slice() {
            [] => format!("{name} = zero(T)"),
            shape => format!("{name} = zeros(T, {})", list(shape)),
        });
    }
    body.extend(routine.statements(&Julia)?);
    body.push(format!("return {}", list(routine.arrays.iter().map(|array| &array.name))));
    let body: String = body.iter().map(|line| format!("    {line}\n")).collect();
    let about: String = routine.about.iter().map(|line| format!("# {line}\n")).collect();
    let arguments = list(vectors.into_iter().chain(numbers));
    Ok(format!("{about}function {}({arguments})\n{body}end\n", routine.function))
}
