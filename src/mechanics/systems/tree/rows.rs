//! Constraints as linear equations for the rates.

use nalgebra::{DMatrix, DVector};

/// All constraints at a state, as linear equations `matrix v = right` for the rates.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    /// For each row, the rates with their coefficients. The others vanish.
    pub entries: Vec<Vec<(usize, f64)>>,
    freedom: usize,
    pub right: DVector<f64>,
    /// The time derivatives of `matrix v - right` for rates that do not change.
    pub bias: DVector<f64>,
    /// The values of the constraints on the coordinates; `None` for constraints on the rates.
    pub values: Vec<Option<f64>>,
    /// For each row, the first row of its constraint. All rows of a constraint have the same unit.
    pub first: Vec<usize>,
    /// For each row, a size of its terms that is known beforehand.
    known: Vec<f64>,
    /// The number of rows so far.
    next: usize,
    /// The first row of the present constraint, and the known size of its terms.
    own: (usize, f64),
}

impl Rows {
    pub fn new(count: usize, freedom: usize) -> Self {
        Rows {
            entries: vec![vec![]; count],
            freedom,
            right: DVector::zeros(count),
            bias: DVector::zeros(count),
            values: Vec::with_capacity(count),
            first: Vec::with_capacity(count),
            known: Vec::with_capacity(count),
            next: 0,
            own: (0, 0.0),
        }
    }

    /// Begins a constraint, and returns the index of its first row. The terms of its equations have at
    /// least the size `known`.
    pub fn begin(&mut self, known: f64) -> usize {
        self.own = (self.next, known);
        self.next
    }

    /// Appends a row without its entries, and returns its index.
    pub fn push(&mut self, value: Option<f64>, right: f64, bias: f64) -> usize {
        let row = self.next;
        (self.right[row], self.bias[row]) = (right, bias);
        self.values.push(value);
        self.first.push(self.own.0);
        self.known.push(self.own.1);
        self.next += 1;
        row
    }

    /// The number of rates.
    pub fn freedom(&self) -> usize {
        self.freedom
    }

    /// Adds to the coefficient of a rate in a row.
    pub fn add(&mut self, row: usize, rate: usize, coefficient: f64) {
        self.entries[row].push((rate, coefficient));
    }

    /// Adds up the coefficients of the same rate. The rows are complete.
    pub fn complete(mut self) -> Self {
        for entries in &mut self.entries {
            entries.sort_by_key(|(rate, _)| *rate);
            entries.dedup_by(|next, kept| {
                let is_same = next.0 == kept.0;
                if is_same {
                    kept.1 += next.1;
                }
                is_same
            });
        }
        self
    }

    /// The equations without some rates.
    pub fn without(&self, is_left_out: impl Fn(usize) -> bool) -> Self {
        let mut rows = self.clone();
        rows.entries.iter_mut().for_each(|own| own.retain(|(rate, _)| !is_left_out(*rate)));
        rows
    }

    /// The matrix.
    pub fn matrix(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.entries.len(), self.freedom);
        for (row, entries) in self.entries.iter().enumerate() {
            entries.iter().for_each(|(rate, entry)| matrix[(row, *rate)] = *entry);
        }
        matrix
    }

    /// The product of the matrix and a vector.
    pub fn product(&self, x: &DVector<f64>) -> DVector<f64> {
        let row = |own: &Vec<(usize, f64)>| own.iter().map(|(rate, entry)| entry * x[*rate]).sum();
        DVector::from_iterator(self.entries.len(), self.entries.iter().map(row))
    }

    /// The size of each constraint: the largest sum of the terms of one of its rows, for rates of
    /// these units, or a known size.
    pub fn sizes(&self, units: &[f64]) -> Vec<f64> {
        let mut sizes = self.known.clone();
        for (row, first) in self.first.iter().enumerate() {
            let terms = self.entries[row].iter();
            let sum = terms.map(|(rate, entry)| (entry * units[*rate]).abs()).sum();
            sizes[*first] = sizes[*first].max(sum);
        }
        self.first.iter().map(|first| sizes[*first]).collect()
    }

    /// The negative values of the constraints on the coordinates, and zeros for the other rows: the
    /// right side of equations for displacements that satisfy the constraints.
    pub fn missing(&self) -> DVector<f64> {
        let values = self.values.iter().map(|value| -value.unwrap_or(0.0));
        DVector::from_iterator(self.values.len(), values)
    }

    /// The violations `matrix v - right` of the rates.
    pub fn residual(&self, rates: &DVector<f64>) -> DVector<f64> {
        self.product(rates) - &self.right
    }
}
