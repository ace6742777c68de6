//! Tensors and equations of motion as source code: straight-line programs in double precision.

mod c;
mod parts;
mod python;
mod routine;
mod rust;

use super::Quantity;
use super::equations::{EquationReport, letters};
use super::head::printable_list;
use crate::Coefficient;
use crate::input::InputError;
use affinor::geometry::Geometry;
use affinor::geometry::equations::Variable;
use affinor_tensors::scalar::derivatives;
use affinor_tensors::{Notation, Rational, Recorded, Symbolic, Up};
use num_traits::Zero;
use routine::{Array, Routine};

/// A scalar whose values are programs, or can be converted to programs.
pub trait Programmed: Coefficient {
    /// The program of a value.
    ///
    /// # Errors
    /// A message if a function of the value does not exist in programs.
    fn program(&self) -> Result<Recorded, String>;

    /// The partial derivatives of values with respect to the parameter `name`.
    fn rates(values: &[Self], name: &str) -> Vec<Self>;
}

impl Programmed for Rational {
    fn program(&self) -> Result<Recorded, String> {
        Recorded::from_rational(self)
            .ok_or_else(|| format!("the number {self} cannot be written in a program"))
    }
    fn rates(values: &[Self], _: &str) -> Vec<Self> {
        vec![Rational::zero(); values.len()]
    }
}

impl Programmed for Recorded {
    fn program(&self) -> Result<Recorded, String> {
        Ok(self.clone())
    }
    fn rates(values: &[Self], name: &str) -> Vec<Self> {
        derivatives(values, name)
    }
}

impl Programmed for Symbolic {
    fn program(&self) -> Result<Recorded, String> {
        Recorded::try_from(self)
    }
    fn rates(values: &[Self], name: &str) -> Vec<Self> {
        values.iter().map(|value| value.derivative(name)).collect()
    }
}

/// An array and the values of its components.
struct Values<S> {
    name: String,
    shape: Vec<usize>,
    about: String,
    entries: Vec<(Vec<usize>, S)>,
}

impl<S: Programmed> Values<S> {
    fn array(self) -> Result<Array, InputError> {
        let entry = |(at, value): (Vec<usize>, S)| match value.program() {
            Ok(program) => Ok((at, program)),
            Err(reason) => Err(InputError::usage(reason)),
        };
        let entries = self.entries.into_iter().map(entry).collect::<Result<_, _>>()?;
        Ok(Array { name: self.name, shape: self.shape, about: self.about, entries })
    }
}

/// The largest number of components of one array, because the components are written one by one,
/// with the indices of the formula.
const MAX_COMPONENTS: usize = 100_000;

/// A programming language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Rust, without any crate.
    Rust,
    /// C99.
    C,
    /// Python 3 with NumPy, vectorized.
    Python,
}

impl Language {
    /// All languages.
    pub const ALL: [Language; 3] = [Language::Rust, Language::C, Language::Python];

    /// The name of the language in options.
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "rust",
            Language::C => "c",
            Language::Python => "python",
        }
    }

    /// The language with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|language| language.name() == name)
    }

    fn write(self, routine: &Routine) -> Result<String, InputError> {
        match self {
            Language::Rust => rust::write(routine),
            Language::C => c::write(routine),
            Language::Python => python::write(routine),
        }
    }
}

/// Writes source code of a function that computes tensors of a geometry, each as an array with the
/// indices of its formula.
///
/// The arguments of the function are the coordinates of the chart, as an array `x`, and the
/// parameters of the components, sorted. The name of a parameter begins with `p_`, so that it is
/// not a reserved word. The names in `by` are parameters or coordinates. For them, every tensor `t`
/// is followed by an array `d_t` of its partial derivatives, whose first index is the number of the
/// name. Tensors that do not apply to the geometry are left out.
///
/// # Errors
/// An error for a tensor of more than 100,000 components, for a constant beyond the range of
/// floats, and if none of the tensors applies.
pub fn tensors_as_code<S: Programmed>(
    geometry: &Geometry<S>,
    quantities: &[Quantity],
    language: Language,
    by: &[String],
) -> Result<String, InputError> {
    let mut arrays = Vec::new();
    let n = geometry.frame().dimension();
    for &quantity in quantities {
        // checks the size first, because the computation of the tensor may take long
        expect_size(quantity.key(), n, quantity.slots().len())?;
        if let Some(tensor) = quantity.of(geometry)? {
            let entries = tensor.components().map(|(at, value)| (at.to_vec(), value.clone()));
            arrays.push(Values {
                name: quantity.key().into(),
                shape: vec![n; quantity.slots().len()],
                about: indices(quantity),
                entries: entries.collect(),
            });
        }
    }
    let function = match arrays.as_slice() {
        [] => {
            let keys: Vec<_> = quantities.iter().map(|quantity| quantity.key()).collect();
            return Err(InputError::usage(format!(
                "not defined for this space: {}",
                keys.join(", ")
            )));
        }
        [one] => one.name.clone(),
        _ => "tensors".into(),
    };
    let about = vec![
        format!("{}, connection {}.", geometry.name(), geometry.connection_name()),
        format!(
            "Basis {}; {} frame.",
            printable_list(geometry.frame().labels()),
            geometry.frame_name()
        ),
    ];
    let coordinates = geometry.frame_origin().fields().map(|f| f.chart().coordinates().to_vec());
    let vectors = coordinates.iter().map(|names| ("x".into(), names.len())).collect();
    let arrays = with_derivatives(arrays, by)?;
    let coordinates = coordinates.unwrap_or_default();
    language.write(&Routine::new(function, about, vectors, coordinates, arrays))
}

impl EquationReport<Recorded> {
    /// Writes source code of a function that returns the time derivatives.
    ///
    /// The arguments of the function are the state, the external covector or the velocity of the
    /// curve, and the parameters, as in [`tensors_as_code`]. On a chart, the position is the first
    /// argument, and its time derivatives come first. The linear system for the time derivatives
    /// is solved by elimination, not by an inverse. The names in `by` are parameters or
    /// coordinates. For them, an array `d_rate` follows with the partial derivatives of the time
    /// derivatives, whose first index is the number of the name.
    ///
    /// # Errors
    /// An error for a constant beyond the range of floats.
    pub fn code(&self, language: Language, by: &[String]) -> Result<String, InputError> {
        let motion = self.equations.kind();
        let n = self.equations.dimension();
        let [state, other] = letters(motion).map(str::to_lowercase);
        let component = |name: &str, at: usize| Recorded::input(&format!("{name}[{at}]"));
        let vector = |name: &str| (0..n).map(|at| component(name, at)).collect::<Vec<_>>();
        let beside = if other.is_empty() { vec![] } else { vector(&other) };
        let rates = self.equations.rate(&vector(&state), &beside)?;
        let position = self.positions().into_iter().map(|(_, terms)| {
            terms.into_iter().fold(Recorded::zero(), |sum, (value, variable)| {
                let variable = match variable {
                    Variable::State(j) => component(&state, j),
                    Variable::Along(j) | Variable::Force(j) => component(&other, j),
                };
                sum + &(value * &variable)
            })
        });
        let values: Vec<Recorded> = position.chain(rates).collect();
        let rate = Values {
            name: "rate".into(),
            shape: vec![values.len()],
            about: format!(
                "d/dt of the {} components of {}",
                values.len(),
                match &self.position {
                    Some(_) => format!("x and {state}"),
                    None => state.clone(),
                }
            ),
            entries: values.into_iter().enumerate().map(|(at, value)| (vec![at], value)).collect(),
        };
        let about = vec![
            format!("{}, connection {}.", self.title(), self.connection[0]),
            motion.statement().join(": "),
        ];
        let coordinates = self.position.as_ref().map_or(vec![], |(names, _)| names.clone());
        let position = if coordinates.is_empty() { "" } else { "x" }.to_string();
        let vectors = [position, state, other].into_iter().filter(|name| !name.is_empty());
        let vectors = vectors.map(|name| (name, n)).collect();
        let function = motion.name().replace('-', "_");
        let arrays = with_derivatives(vec![rate], by)?;
        language.write(&Routine::new(function, about, vectors, coordinates, arrays))
    }
}

/// Returns an error if an array has too many components to be written one by one.
fn expect_size(name: &str, dimension: usize, rank: usize) -> Result<(), InputError> {
    let size = u32::try_from(rank).ok().and_then(|rank| dimension.checked_pow(rank));
    if size.is_some_and(|size| size <= MAX_COMPONENTS) {
        return Ok(());
    }
    let message = format!(
        "{name} has {dimension}^{rank} components, but a program can have at most {MAX_COMPONENTS}"
    );
    Err(InputError::usage(message).help("choose smaller tensors with --show"))
}

/// The arrays, each followed by the array of its derivatives.
fn with_derivatives<S: Programmed>(
    arrays: Vec<Values<S>>,
    by: &[String],
) -> Result<Vec<Array>, InputError> {
    if by.is_empty() {
        return arrays.into_iter().map(Values::array).collect();
    }
    let mut all = Vec::new();
    for array in arrays {
        let size = array.shape.iter().product::<usize>().saturating_mul(by.len());
        if size > MAX_COMPONENTS {
            let message = format!(
                "the derivatives of {} have {size} components, but a program can have at most {MAX_COMPONENTS}",
                array.name
            );
            return Err(InputError::usage(message).help("choose fewer --derivatives"));
        }
        let values: Vec<S> = array.entries.iter().map(|(_, value)| value.clone()).collect();
        let mut entries = Vec::new();
        for (number, name) in by.iter().enumerate() {
            let rates = S::rates(&values, name).into_iter().zip(&array.entries);
            entries.extend(
                rates
                    .filter(|(rate, _)| !rate.is_zero())
                    .map(|(rate, (at, _))| ([&[number][..], at].concat(), rate)),
            );
        }
        let derivative = Values {
            name: format!("d_{}", array.name),
            shape: [&[by.len()][..], &array.shape].concat(),
            about: format!(
                "the derivatives of {} by {}, the first index",
                array.name,
                by.join(", ")
            ),
            entries,
        };
        all.extend([array.array()?, derivative.array()?]);
    }
    Ok(all)
}

/// The text that explains the indices of a quantity: `R^i_jkl, indices i, j, k, l`.
fn indices(quantity: Quantity) -> String {
    let (letters, mut text) = (quantity.letters(), quantity.symbol().to_string());
    let mut level = None;
    for (letter, slot) in letters.chars().zip(quantity.slots()) {
        if level.replace(slot) != Some(slot) {
            text.push(if slot == Up { '^' } else { '_' });
        }
        text.push(letter);
    }
    let listed: Vec<String> = letters.chars().map(String::from).collect();
    match listed.as_slice() {
        [] => text,
        [one] => format!("{text}, index {one}"),
        all => format!("{text}, indices {}", all.join(", ")),
    }
}
