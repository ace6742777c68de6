//! Tensors at points: programs that compute components from numbers, and tables of these
//! components.

use super::{Programmed, Table, TableEntry};
use crate::input::InputError;
use crate::space::Point;
use affinor_tensors::scalar::StraightLine;
use affinor_tensors::{Recorded, Tensor, TrackedFloat};

/// A tensor as a program, which computes the components from numbers for the coordinates,
/// parameters and functions.
///
/// ```
/// use affinor_documents::report::TensorProgram;
/// use affinor::tensors::{Down, Symbolic, Tensor};
/// let form = Tensor::from_components(2, &[Down, Down], [([0, 1], "2*x".parse::<Symbolic>()?)])?;
/// let program = TensorProgram::new(&form)?;
/// assert_eq!(program.indices, [[0, 1]]);
/// assert_eq!(program.inputs().collect::<Vec<_>>(), ["x"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct TensorProgram {
    /// The indices of the components that do not vanish identically, from 0.
    pub indices: Vec<Vec<usize>>,
    /// The program of these components.
    pub program: StraightLine,
}

impl TensorProgram {
    /// Converts a tensor to a program.
    ///
    /// # Errors
    /// An error if a component contains a function that programs do not support.
    pub fn new<S: Programmed>(tensor: &Tensor<S>) -> Result<Self, InputError> {
        let program = |value: &S| value.program().map_err(InputError::usage);
        let indices = tensor.components().map(|(at, _)| at.to_vec()).collect();
        let values = tensor.components().map(|(_, value)| program(value));
        let program = StraightLine::new(&values.collect::<Result<Vec<Recorded>, _>>()?);
        Ok(TensorProgram { indices, program })
    }

    /// The coordinates, parameters and functions on which the components depend.
    pub fn inputs(&self) -> impl Iterator<Item = &'static str> {
        self.program.inputs().map(|input| input.text())
    }
}

impl<S: Programmed> Table<S> {
    /// Evaluates the table in floats at a point.
    ///
    /// # Errors
    /// An error if a tensor depends on a name without a value, or is not defined at the point.
    pub(super) fn at(&self, point: &Point) -> Result<Table<TrackedFloat>, InputError> {
        let mut tensors = Vec::new();
        for TableEntry { quantity, tensor } in &self.tensors {
            let tensor = at(tensor, point, quantity.key(), self)?;
            tensors.push(TableEntry { quantity: *quantity, tensor });
        }
        let lambda = self.lambda.as_ref().map(|lambda| {
            let scalar = Tensor::from_components(self.labels.len(), &[], [([], lambda.clone())])?;
            Ok::<_, InputError>(at(&scalar, point, "lambda", self)?.get(&[]))
        });
        Ok(Table {
            name: self.name.clone(),
            algebra: self.algebra.clone(),
            labels: self.labels.clone(),
            parameters: vec![],
            connection: self.connection.clone(),
            connection_words: self.connection_words.clone(),
            lambda: lambda.transpose()?,
            frame: self.frame,
            chart: self.chart.clone(),
            homogeneous: self.homogeneous.clone(),
            tolerance: self.tolerance,
            independent: self.independent,
            common_factors: self.common_factors,
            index_names: self.index_names.clone(),
            // omits the metric, which is needed only for common factors of denominators; floats
            // have none
            metric: None,
            point: point.iter().map(|(name, value)| (name.into(), value.corrected())).collect(),
            tensors,
        })
    }
}

/// Evaluates a tensor at a point; `key` is the name of the tensor.
fn at<S: Programmed>(
    tensor: &Tensor<S>,
    point: &Point,
    key: &str,
    table: &Table<S>,
) -> Result<Tensor<TrackedFloat>, InputError> {
    let TensorProgram { indices, program } = TensorProgram::new(tensor)?;
    if let Some(missing) = program.inputs().find(|input| point.get(input.text()).is_none()) {
        let message = format!("the quantity {key} depends on {missing}, which has no value");
        return Err(InputError::usage(message)
            .help(format!("give {missing} a value, as in --at \"{missing}=1\"")));
    }
    let value = |name: &str| point.get(name).unwrap_or_default();
    let values = program.evaluate(value, |function, x: &TrackedFloat| x.applied(function));
    let finite = |value: &TrackedFloat| value.value().is_finite();
    let values = values.filter(|values| values.iter().all(finite)).ok_or_else(|| {
        let reason = program.failure(|name| value(name).value());
        let reason = reason.unwrap_or_else(|| "its values are not finite".into());
        let listed = point.iter().map(|(name, value)| format!("{name} = {value}"));
        let listed = listed.collect::<Vec<_>>().join(", ");
        InputError::mathematics(format!("the quantity {key} is not defined at {listed}: {reason}"))
            .help("choose another point, or tensors that are defined there, with --show")
    })?;
    let shown =
        |(at, value): (Vec<usize>, TrackedFloat)| Some((at, value.significant(table.tolerance)?));
    let components = indices.into_iter().zip(values).filter_map(shown);
    Ok(Tensor::from_components(tensor.dimension(), tensor.slots(), components)?)
}
