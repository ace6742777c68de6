//! Elements in tables and files. An element is written and read as a matrix of numbers.

use super::{Coordinates, Embedded};
use crate::Error;
use crate::numerics::logarithm::logarithm;
use nalgebra::{DMatrix, DVectorView};

/// The tolerance of the equations of the group for a matrix that is read.
pub(super) const TOLERANCE: f64 = 1e-6;

/// A group whose elements can be written as matrices of numbers and read back.
///
/// The written form of a linear group is its matrix. The written form of a vector group, such as
/// R^n, is a column of coordinates. The written form of a [`Product`](super::Product) is one
/// column: the entries of the first factor, row by row, followed by the entries of the second
/// factor.
pub trait MatrixNotation: Embedded {
    /// The written form of an element.
    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        self.matrix(g)
    }

    /// The element whose written form is `matrix`.
    ///
    /// # Errors
    /// [`Error::Shape`] for a wrong shape; [`Error::Invalid`] with the defect if the matrix is not
    /// an element.
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error>;

    /// A bound on the error of the components of `x = log(g)` if each entry of `g` is rounded to a
    /// float. `None` if the group does not estimate this error, for example because it has closed
    /// forms.
    fn log_rounding(&self, g: &Self::Element, x: &Self::Vector) -> Option<f64> {
        let _ = (g, x);
        None
    }

    /// Whether a component of a vector, counted from 0, is an angle in radians.
    fn is_angle(&self, at: usize) -> bool {
        let _ = at;
        false
    }

    /// Names of additional coordinates that are not entries of the matrix, such as the components
    /// of a quaternion.
    fn names(&self) -> &'static [&'static str] {
        &[]
    }

    /// The value of the coordinate with the `k`-th name. The names of all [`blocks`](Self::blocks)
    /// are counted from 0.
    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        let _ = (g, k);
        f64::NAN
    }

    /// Replaces the content of `entries` by the entries of the [written](Self::write) element,
    /// listed column by column.
    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, self.write(g).as_slice());
    }

    /// The written forms of the factors of a product. If a group is not a product, its only factor
    /// is the group itself.
    fn blocks(&self) -> Vec<Block> {
        vec![Block { names: self.names(), shape: self.write(&self.identity()).shape() }]
    }

    /// The derivatives at `s = 0` of the written form of `exp(s e_i)`, one for each basis vector.
    ///
    /// Entries that are zero must be exactly zero, because [`derivatives`](Self::derivatives)
    /// multiplies them by coordinates, which may be large.
    fn generators(&self) -> Vec<DMatrix<f64>> {
        let half = |x: &Self::Vector| self.write(&self.exp(&(x.clone() * 0.5)));
        // uses half of the basis vector, so that it is short enough to be the principal logarithm
        // of its exponential
        let log = |x: &Self::Vector| {
            let half = half(x);
            match logarithm(&half) {
                Ok(log) => log * 2.0,
                Err(_) => half.map(|_| f64::NAN),
            }
        };
        self.basis().iter().map(log).collect()
    }

    /// The derivatives at `s = 0` of a function of the written form of `g exp(s e_i)`, one for each
    /// `i`. The list `entries` contains the entries of `g`, and `generators` is the result of
    /// [`Generator::of`]. The list `partial` contains the nonzero derivatives of the function with
    /// respect to the entries.
    #[inline]
    fn derivatives(
        &self,
        g: &Self::Element,
        entries: &[f64],
        generators: &[Generator],
        partial: &[Partial],
    ) -> Self::Vector {
        let _ = g;
        Self::Vector::from_fn(generators.len(), |i| generators[i].derivative(entries, partial))
    }

    /// The second derivative at `s = 0` of a linear function of the written form of `g exp(s v)`.
    /// The arguments are those of [`derivatives`](Self::derivatives), where `partial` contains the
    /// coefficients of the linear function.
    fn second_derivative(
        &self,
        g: &Self::Element,
        entries: &[f64],
        generators: &[Generator],
        partial: &[Partial],
        v: &Self::Vector,
    ) -> f64 {
        let _ = g;
        let along = |entries: &[f64], partial: &[Partial]| -> f64 {
            let terms = generators.iter().zip(v.components());
            terms.map(|(generator, v)| v * generator.derivative(entries, partial)).sum()
        };
        // the matrix `g V` of the first derivatives of the entries
        let rows = generators.first().map_or(1, |generator| generator.columns.len().max(1));
        let rate = |at: usize| along(entries, &[(at % rows, at / rows, 1.0)]);
        let rates: Vec<f64> = (0..entries.len()).map(rate).collect();
        along(&rates, partial)
    }
}

/// The derivative of a function with respect to an entry of the written element, as row, column and
/// value.
pub type Partial = (usize, usize, f64);

/// The square matrix of a basis vector, stored as its nonzero entries.
#[derive(Clone, Debug, Default)]
pub struct Generator {
    /// For each column, the list of its nonzero entries. An entry consists of its value and the
    /// offset, in the list of entries of `g`, of the column that it multiplies.
    columns: Vec<Vec<(usize, f64)>>,
}

impl Generator {
    /// The [generators](MatrixNotation::generators) of a group.
    pub fn of<G: MatrixNotation>(group: &G) -> Vec<Self> {
        let sparse = |matrix: DMatrix<f64>| {
            let terms = |column: DVectorView<f64>| {
                let entries = column.iter().enumerate().filter(|(_, value)| **value != 0.0);
                entries.map(|(k, value)| (k * matrix.nrows(), *value)).collect()
            };
            Generator { columns: matrix.column_iter().map(terms).collect() }
        };
        group.generators().into_iter().map(sparse).collect()
    }

    /// The derivative `sum_rc (g E)_rc p_rc` for the generator `E` and the derivatives `p_rc`. The
    /// list `entries` contains the entries of `g`, column by column.
    #[inline]
    fn derivative(&self, entries: &[f64], partial: &[Partial]) -> f64 {
        let slope = |&(row, column, share): &Partial| {
            let terms = self.columns[column].iter();
            let rates = terms.map(|(start, value)| entries[row + start] * value);
            share * rates.sum::<f64>()
        };
        partial.iter().map(slope).sum()
    }
}

/// Replaces the content of a list and reuses the memory of the list.
pub(super) fn replace(list: &mut Vec<f64>, numbers: &[f64]) {
    list.clear();
    list.extend_from_slice(numbers);
}

/// The written form of one factor of a group: named coordinates and the shape of its matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Names of additional coordinates that are not entries of the matrix.
    pub names: &'static [&'static str],
    /// The numbers of rows and columns.
    pub shape: (usize, usize),
}

/// The coordinate to which a name of a [`Block`] refers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// A named coordinate, given by its index from 0.
    Named(usize),
    /// An entry of the matrix, given by its row and column from 0.
    Entry(usize, usize),
}

/// The names of the components of a position. These are entries of the last column of the matrix.
const POSITION: [&str; 3] = ["x", "y", "z"];

impl Block {
    /// The letter in the names of entries: `g` for matrices, `x` for columns.
    pub fn letter(&self) -> &'static str {
        if self.shape.1 == 1 { "x" } else { "g" }
    }

    /// The coordinate with this name. Names are `qw` or `x` for named coordinates, `g12` or `R12`
    /// for a row and a column (`g1_12` in larger matrices), and `x1` in a column.
    pub fn find(&self, name: &str) -> Option<Coordinate> {
        if let Some(k) = self.names.iter().position(|named| *named == name) {
            let axis = POSITION.iter().position(|axis| *axis == name);
            let entry = |row| Coordinate::Entry(row, self.shape.1 - 1);
            return Some(axis.map_or(Coordinate::Named(k), entry));
        }
        let digits = name.find(|c: char| c.is_ascii_digit())?;
        let (letter, behind) = name.split_at(digits);
        if letter != self.letter() && (letter != "R" || self.shape.1 == 1) {
            return None;
        }
        let (row, column): (usize, usize) = match behind.split_once('_') {
            _ if self.shape.1 == 1 => (behind.parse().ok()?, 1),
            Some((row, column)) => (row.parse().ok()?, column.parse().ok()?),
            None if behind.len() == 2 => (behind[..1].parse().ok()?, behind[1..].parse().ok()?),
            None => return None,
        };
        let inside = (1..=self.shape.0).contains(&row) && (1..=self.shape.1).contains(&column);
        inside.then(|| Coordinate::Entry(row - 1, column - 1))
    }

    /// The names of all entries, row by row.
    pub fn entries(&self) -> Vec<String> {
        let (letter, (rows, columns)) = (self.letter(), self.shape);
        if columns == 1 {
            return (1..=rows).map(|i| format!("{letter}{i}")).collect();
        }
        let between = if rows.max(columns) > 9 { "_" } else { "" };
        let entries = (1..=rows).flat_map(|i| (1..=columns).map(move |j| (i, j)));
        entries.map(|(i, j)| format!("{letter}{i}{between}{j}")).collect()
    }

    /// Whether a name is the name of a component of a position.
    pub(crate) fn is_position(name: &str) -> bool {
        POSITION.contains(&name)
    }
}

/// Calls `of` to convert a matrix to an element. Returns the element after checking that its
/// written form is the matrix.
pub(super) fn checked<G: MatrixNotation>(
    group: &G,
    matrix: &DMatrix<f64>,
    of: impl FnOnce(&DMatrix<f64>) -> Result<G::Element, Error>,
) -> Result<G::Element, Error> {
    expect_shape(matrix, group.write(&group.identity()).shape())?;
    if let Some(value) = matrix.iter().find(|value| !value.is_finite()) {
        let reason = format!("it has the entry {value}");
        return Err(Error::Invalid { what: "element of the group", reason });
    }
    let element = of(matrix)?;
    // treats a NaN as an infinite distance
    let written = group.write(&element);
    let differences = matrix.iter().zip(&written).map(|(a, b)| (a - b).abs());
    let defect = differences.fold(0.0, |largest, d| if d <= largest { largest } else { d });
    if defect <= TOLERANCE * (1.0 + matrix.amax()) {
        return Ok(element);
    }
    let reason = format!("the nearest element found differs by {defect:e} in an entry");
    Err(Error::Invalid { what: "element of the group", reason })
}

/// Checks the numbers of rows and columns.
pub(super) fn expect_shape(matrix: &DMatrix<f64>, shape: (usize, usize)) -> Result<(), Error> {
    if matrix.shape() == shape {
        return Ok(());
    }
    let [expected, found] =
        [shape, matrix.shape()].map(|(rows, columns)| format!("{rows} rows and {columns} columns"));
    Err(Error::Shape { what: "an element", expected, found })
}

/// Writes coordinates as a column.
pub(super) fn column(x: &impl Coordinates) -> DMatrix<f64> {
    DMatrix::from_column_slice(x.components().len(), 1, x.components())
}

/// A matrix that is given by its nonzero entries: row, column and value.
pub(super) fn sparse(size: usize, entries: &[(usize, usize, f64)]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(size, size);
    entries.iter().for_each(|&(row, column, value)| matrix[(row, column)] = value);
    matrix
}

/// The matrices `spin(e_i)`, `i = 1, 2, 3`, in the upper left corner of a larger matrix.
pub(super) fn spins(size: usize) -> impl Iterator<Item = DMatrix<f64>> {
    (0..3).map(move |i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        sparse(size, &[(k, j, 1.0), (j, k, -1.0)])
    })
}
