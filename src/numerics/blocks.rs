//! Straight-line programs on many rows of floats, evaluated for blocks of rows at once.

use super::lanes::{LANES, Lane, Lanes};
use affinor_tensors::Rational;
use affinor_tensors::scalar::{Function, Output, Step, StraightLine};
#[cfg(feature = "simd")]
use multiversion::multiversion;
use std::ops::{Add, Mul};

/// A straight-line program in floats, which is evaluated for many rows of inputs.
///
/// The steps are the steps of a [`StraightLine`], in the same order. If only one sum uses a
/// product, the product is computed within this sum. A row of results depends only on its row of
/// inputs.
///
/// ```
/// use affinor::numerics::blocks::{BlockProgram, Column};
/// use affinor::tensors::{Notation, Recorded, scalar::StraightLine};
/// let [x, y] = ["x", "y"].map(|name| Recorded::parameter(name).unwrap());
/// let program = StraightLine::new(&[x.clone() * &x + &y, y]);
/// let program = BlockProgram::new(&program, &["x", "y"], &[0, 1]).unwrap();
/// let (rows, mut out) = ([1.0, 10.0, 2.0, 20.0, 3.0, 30.0], [0.0; 6]);
/// let columns = [0, 1].map(|offset| Column { numbers: &rows, offset, step: 2 });
/// program.evaluate(&columns, 0, &mut out, 2);
/// assert_eq!(out, [11.0, 10.0, 24.0, 20.0, 39.0, 30.0]);
/// // the derivative along (1, 0)
/// let rates = [1.0, 0.0, 1.0, 0.0, 1.0, 0.0];
/// let rates = [0, 1].map(|offset| Column { numbers: &rates, offset, step: 2 });
/// program.derivative(&columns, &rates, 0, &mut out, 2);
/// assert_eq!(out, [2.0, 0.0, 4.0, 0.0, 6.0, 0.0]);
/// ```
#[derive(Clone, Debug)]
pub struct BlockProgram {
    code: Vec<Instruction>,
    terms: Vec<Term>,
    /// The largest number of values that are stored at the same time.
    slots: usize,
    /// The results that are constants, as pairs of position and value.
    constants: Vec<(usize, f64)>,
}

/// The values of one input, stored in an array. The value for row `k` is at the position
/// `offset + k step`.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// The array.
    pub numbers: &'a [f64],
    /// The position of the value for the first row.
    pub offset: usize,
    /// The distance between the positions of consecutive rows. It is 0 if all rows have the same
    /// value.
    pub step: usize,
}

#[derive(Clone, Debug)]
enum Instruction {
    /// Loads an input.
    Input(usize, usize),
    /// Adds a constant and a range of terms: first the products, then the single values.
    Sum {
        constant: f64,
        products: (usize, usize),
        end: usize,
        to: usize,
    },
    Product([usize; 2], usize),
    Reciprocal(usize, usize),
    Function(Function, usize, usize),
    /// Selects the third value if the size of the first value is at least the size of the second;
    /// otherwise selects the fourth value.
    Select(Box<[(f64, Option<usize>); 4]>, usize),
    /// Writes a multiple of a value to a position of the results.
    Store(f64, usize, usize),
}

/// A multiple of the product of two values, or of the first value only.
#[derive(Clone, Copy, Debug)]
struct Term(f64, usize, usize);

/// The values of one step of a program, for several rows.
trait Value: Copy + Add<Output = Self> + Mul<Output = Self> {
    fn constant(value: f64) -> Self;
    fn scaled(self, factor: f64) -> Self;
    fn reciprocal(self) -> Self;
    fn function(self, function: Function) -> Self;
    /// Selects `x` where the size of `self` is at least the size of `other`, otherwise `y`.
    fn select(self, other: Self, x: Self, y: Self) -> Self;
    /// The number that is written to the results of a row.
    fn result(&self, row: usize) -> f64;
}

impl Value for Lanes {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Lanes::splat(value)
    }
    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        self.map(|value| factor * value)
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        self.map(|value| 1.0 / value)
    }
    #[inline(always)]
    fn function(self, function: Function) -> Self {
        self.map(|value| function.value(value))
    }
    #[inline(always)]
    fn select(self, other: Self, x: Self, y: Self) -> Self {
        other.abs().if_above(self.abs(), y, x)
    }
    #[inline(always)]
    fn result(&self, row: usize) -> f64 {
        self.0[row]
    }
}

/// The values of a single row.
impl Value for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        factor * self
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    fn function(self, function: Function) -> Self {
        function.value(self)
    }
    #[inline(always)]
    fn select(self, other: Self, x: Self, y: Self) -> Self {
        if other.abs() > self.abs() { y } else { x }
    }
    #[inline(always)]
    fn result(&self, _: usize) -> f64 {
        *self
    }
}

/// Values, and their derivatives along the time derivatives of the inputs.
#[derive(Clone, Copy)]
struct Moving(Lanes, Lanes);

impl Add for Moving {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Moving(self.0 + other.0, self.1 + other.1)
    }
}

impl Mul for Moving {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Moving(self.0 * other.0, self.0 * other.1 + self.1 * other.0)
    }
}

impl Value for Moving {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Moving(Lanes::splat(value), Lanes::splat(0.0))
    }
    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        Moving(self.0.scaled(factor), self.1.scaled(factor))
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        let value = self.0.reciprocal();
        Moving(value, -(self.1 * (value * value)))
    }
    #[inline(always)]
    fn function(self, function: Function) -> Self {
        let value = self.0.function(function);
        let slope = self.0.zip(value, |x, value| function.slope(x, value));
        Moving(value, self.1 * slope)
    }
    #[inline(always)]
    fn select(self, other: Self, x: Self, y: Self) -> Self {
        let [a, b] = [self.0.abs(), other.0.abs()];
        Moving(b.if_above(a, y.0, x.0), b.if_above(a, y.1, x.1))
    }
    #[inline(always)]
    fn result(&self, row: usize) -> f64 {
        self.1.0[row]
    }
}

/// Slots for the values of steps. A slot becomes free after the last use of its value.
struct Slots {
    of: Vec<usize>,
    last: Vec<usize>,
    free: Vec<usize>,
    count: usize,
}

impl Slots {
    fn take(&mut self, step: usize) -> usize {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.of[step] = slot;
        slot
    }

    fn release(&mut self, steps: &[usize], now: usize) {
        for step in steps {
            // marks the step as released, so that a step that an instruction uses twice is released
            // only once
            if self.last[*step] == now {
                self.last[*step] = usize::MAX;
                self.free.push(self.of[*step]);
            }
        }
    }
}

impl BlockProgram {
    /// Compiles a program. The `inputs` are the names of its inputs, and `places` are the positions
    /// of its results in a row. Returns `None` if a name is missing among `inputs`, or if a
    /// constant is beyond the range of floats.
    ///
    /// # Panics
    /// If there are fewer places than outputs.
    pub fn new(
        program: &StraightLine,
        inputs: &[impl AsRef<str>],
        places: &[usize],
    ) -> Option<Self> {
        let (steps, uses) = (program.steps(), program.uses());
        let float = |value: &Rational| Some(value.to_f64()).filter(|value| value.is_finite());
        let mut stores: Vec<Vec<(f64, usize)>> = vec![vec![]; steps.len()];
        let mut constants = vec![];
        for (output, place) in program.outputs().iter().zip(places) {
            let factor = float(&output.factor)?;
            match output.step {
                Some(step) => stores[step].push((factor, *place)),
                None => constants.push((*place, factor)),
            }
        }
        let is_inner: Vec<bool> = inner(steps, &uses, &stores);
        // the values that an instruction reads, including those of its inner products
        let reads = |at: usize| -> Vec<usize> {
            let operands = steps[at].operands().into_iter();
            operands
                .flat_map(|own| if is_inner[own] { steps[own].operands() } else { vec![own] })
                .collect()
        };
        let mut slots =
            Slots { of: vec![0; steps.len()], last: vec![0; steps.len()], free: vec![], count: 0 };
        let shown = (0..steps.len()).filter(|at| !is_inner[*at]);
        for at in shown.clone() {
            slots.last[at] = at;
            for read in reads(at) {
                slots.last[read] = at;
            }
        }
        let mut own = BlockProgram { code: vec![], terms: vec![], slots: 0, constants };
        for at in shown {
            let instruction = own.instruction(&steps[at], steps, &is_inner, inputs, &slots.of)?;
            let read = reads(at);
            slots.release(&read, at);
            let to = slots.take(at);
            own.code.push(instruction.into(to));
            let stores = stores[at].iter();
            own.code.extend(stores.map(|(factor, place)| Instruction::Store(*factor, to, *place)));
            // releases the slot at once if only results use the value
            slots.release(&[at], at);
        }
        own.slots = slots.count;
        Some(own)
    }

    /// Compiles the instruction of a step, without the slot of its result.
    fn instruction(
        &mut self,
        step: &Step,
        steps: &[Step],
        is_inner: &[bool],
        inputs: &[impl AsRef<str>],
        slot: &[usize],
    ) -> Option<Instruction> {
        let float = |value: &Rational| Some(value.to_f64()).filter(|value| value.is_finite());
        let to = 0;
        Some(match step {
            Step::Input(variable) => {
                let name = variable.text();
                Instruction::Input(inputs.iter().position(|own| own.as_ref() == name)?, to)
            }
            Step::Product(a, b) => Instruction::Product([slot[*a], slot[*b]], to),
            Step::Reciprocal(a) => Instruction::Reciprocal(slot[*a], to),
            Step::Function(function, a) => Instruction::Function(*function, slot[*a], to),
            Step::Select(values) => {
                let value =
                    |value: &Output| Some((float(&value.factor)?, value.step.map(|at| slot[at])));
                let [a, b, x, y] = &**values;
                Instruction::Select(Box::new([value(a)?, value(b)?, value(x)?, value(y)?]), to)
            }
            Step::Sum(constant, terms) => {
                let begin = self.terms.len();
                for (factor, at) in terms {
                    if let (true, Step::Product(a, b)) = (is_inner[*at], &steps[*at]) {
                        self.terms.push(Term(float(factor)?, slot[*a], slot[*b]));
                    }
                }
                let middle = self.terms.len();
                for (factor, at) in terms.iter().filter(|(_, at)| !is_inner[*at]) {
                    self.terms.push(Term(float(factor)?, slot[*at], 0));
                }
                let (products, end) = ((begin, middle), self.terms.len());
                Instruction::Sum { constant: float(constant)?, products, end, to }
            }
        })
    }

    /// Writes the results of all rows, beginning with the row `start`. Each row of `out` has
    /// `width` numbers. Positions without a result are not changed.
    ///
    /// # Panics
    /// If a column is shorter than the rows require, or if a position is not below `width`.
    pub fn evaluate(&self, inputs: &[Column<'_>], start: usize, out: &mut [f64], width: usize) {
        let load = |at: usize, rows: [usize; LANES]| inputs[at].load(rows);
        let mut values = vec![Lanes::splat(0.0); self.slots];
        run(self, &load, &mut values, start, out, width);
        self.write_constants(out, width, false);
    }

    /// Writes the results of a single row, as [`evaluate`](Self::evaluate) does. The buffer `values`
    /// is reused from one row to the next.
    ///
    /// # Panics
    /// If there are fewer inputs or results than the program has.
    pub fn evaluate_row(&self, inputs: &[f64], values: &mut Vec<f64>, out: &mut [f64]) {
        values.resize(self.slots, 0.0);
        let width = out.len();
        if width > 0 {
            run(self, &|at: usize, _: [usize; LANES]| inputs[at], values, 0, out, width);
            self.write_constants(out, width, false);
        }
    }

    /// Writes the time derivatives of the results, for inputs whose time derivatives are `rates`,
    /// in the same form as [`evaluate`](Self::evaluate).
    ///
    /// # Panics
    /// If [`evaluate`](Self::evaluate) would panic.
    pub fn derivative(
        &self,
        inputs: &[Column<'_>],
        rates: &[Column<'_>],
        start: usize,
        out: &mut [f64],
        width: usize,
    ) {
        let load =
            |at: usize, rows: [usize; LANES]| Moving(inputs[at].load(rows), rates[at].load(rows));
        let mut values = vec![Moving::constant(0.0); self.slots];
        run(self, &load, &mut values, start, out, width);
        self.write_constants(out, width, true);
    }

    fn write_constants(&self, out: &mut [f64], width: usize, rates: bool) {
        for row in out.chunks_exact_mut(width) {
            for (place, value) in &self.constants {
                row[*place] = if rates { 0.0 } else { *value };
            }
        }
    }

    /// Makes all positions below `width` results. Positions without a result become 0.
    ///
    /// ```
    /// use affinor::numerics::blocks::BlockProgram;
    /// use affinor::tensors::{Recorded, scalar::StraightLine};
    /// let program = StraightLine::new(&[Recorded::input("x")]);
    /// let mut program = BlockProgram::new(&program, &["x"], &[1]).unwrap();
    /// program.fill(3);
    /// let mut row = [f64::NAN; 3];
    /// let x = affinor::numerics::blocks::Column { numbers: &[2.0], offset: 0, step: 0 };
    /// program.evaluate(&[x], 0, &mut row, 3);
    /// assert_eq!(row, [0.0, 2.0, 0.0]);
    /// ```
    pub fn fill(&mut self, width: usize) {
        let mut assigned = vec![false; width];
        let stored = self.code.iter().filter_map(|instruction| match instruction {
            Instruction::Store(_, _, place) => Some(*place),
            _ => None,
        });
        let places = stored.chain(self.constants.iter().map(|(place, _)| *place));
        places.filter(|place| *place < width).for_each(|place| assigned[place] = true);
        let free = assigned.iter().enumerate().filter(|(_, assigned)| !**assigned);
        self.constants.extend(free.map(|(place, _)| (place, 0.0)));
    }

    /// The approximate number of operations for one row.
    pub fn size(&self) -> usize {
        self.code.len() + self.terms.len()
    }
}

/// For each step, whether it is a product that only one sum uses.
fn inner(steps: &[Step], uses: &[usize], stores: &[Vec<(f64, usize)>]) -> Vec<bool> {
    let mut inner = vec![false; steps.len()];
    for step in steps {
        let Step::Sum(_, terms) = step else { continue };
        for (_, at) in terms {
            inner[*at] =
                uses[*at] == 1 && stores[*at].is_empty() && matches!(steps[*at], Step::Product(..));
        }
    }
    inner
}

impl Instruction {
    /// The same instruction, with a slot for its result.
    fn into(mut self, slot: usize) -> Self {
        match &mut self {
            Instruction::Input(_, to)
            | Instruction::Sum { to, .. }
            | Instruction::Product(_, to)
            | Instruction::Reciprocal(_, to)
            | Instruction::Function(_, _, to)
            | Instruction::Select(_, to) => *to = slot,
            Instruction::Store(..) => {}
        }
        self
    }
}

impl Column<'_> {
    /// The value for the row at the index `row`.
    ///
    /// # Panics
    /// If the column is too short.
    #[inline(always)]
    pub fn number(&self, row: usize) -> f64 {
        self.numbers[self.offset + row * self.step]
    }

    #[inline(always)]
    fn load(&self, rows: [usize; LANES]) -> Lanes {
        let mut lanes = Lanes::splat(0.0);
        for (value, row) in lanes.0.iter_mut().zip(rows) {
            *value = self.number(row);
        }
        lanes
    }
}

/// Evaluates the program on all rows of `out`.
#[cfg_attr(
    feature = "simd",
    multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))
)]
fn run<V: Value, L: Fn(usize, [usize; LANES]) -> V>(
    program: &BlockProgram,
    load: &L,
    values: &mut [V],
    start: usize,
    out: &mut [f64],
    width: usize,
) {
    let count = out.len() / width.max(1);
    for (block, out) in out.chunks_mut(LANES * width.max(1)).enumerate() {
        let begin = block * LANES;
        let here = LANES.min(count - begin);
        // fills unused lanes with copies of the last row
        let rows = std::array::from_fn(|t| start + begin + t.min(here - 1));
        for instruction in &program.code {
            match instruction {
                Instruction::Input(input, to) => values[*to] = load(*input, rows),
                Instruction::Sum { constant, products, end, to } => {
                    let mut sum = V::constant(*constant);
                    for Term(factor, a, b) in &program.terms[products.0..products.1] {
                        sum = sum + (values[*a] * values[*b]).scaled(*factor);
                    }
                    for Term(factor, a, _) in &program.terms[products.1..*end] {
                        sum = sum + values[*a].scaled(*factor);
                    }
                    values[*to] = sum;
                }
                Instruction::Product([a, b], to) => values[*to] = values[*a] * values[*b],
                Instruction::Reciprocal(a, to) => values[*to] = values[*a].reciprocal(),
                Instruction::Function(function, a, to) => {
                    values[*to] = values[*a].function(*function);
                }
                Instruction::Select(choice, to) => {
                    let value = |(factor, at): (f64, Option<usize>)| match at {
                        Some(at) => values[at].scaled(factor),
                        None => V::constant(factor),
                    };
                    let [a, b, x, y] = choice.each_ref().map(|own| value(*own));
                    values[*to] = a.select(b, x, y);
                }
                Instruction::Store(factor, at, place) => {
                    let value = values[*at].scaled(*factor);
                    for (t, row) in out.chunks_exact_mut(width).enumerate() {
                        row[*place] = value.result(t);
                    }
                }
            }
        }
    }
}
