//! The functions that formulas may call, with their derivatives.

use std::hash::{Hash, Hasher};

/// A function of one number. Its derivative at `x` is `slope(x, y)`, where `y` is the value of the
/// function at `x`. Its second derivative is `bend(x, y)`.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) value: fn(f64) -> f64,
    pub(super) slope: fn(f64, f64) -> f64,
    pub(super) bend: fn(f64, f64) -> f64,
}

/// A function of two numbers. Its partial derivatives are `slopes(x, y)`. Its second derivatives
/// are `bends(x, y)`, in the order `xx`, `xy`, `yy`.
#[derive(Debug)]
pub(super) struct FunctionOfTwo {
    pub(super) name: &'static str,
    pub(super) value: fn(f64, f64) -> f64,
    pub(super) slopes: fn(f64, f64) -> [f64; 2],
    pub(super) bends: fn(f64, f64) -> [f64; 3],
    /// Whether the function accepts more than two arguments, which are combined pairwise.
    pub(super) folds: bool,
}

// compares names, because the addresses of functions need not be unique
impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl PartialEq for FunctionOfTwo {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Function {}
impl Eq for FunctionOfTwo {}

impl Hash for Function {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl Hash for FunctionOfTwo {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

/// The functions of one number that formulas may call. At points without a derivative, the slope is
/// the mean of the one-sided derivatives.
pub(super) static FUNCTIONS: [Function; 16] = [
    Function { name: "sin", value: f64::sin, slope: |x, _| x.cos(), bend: |_, y| -y },
    Function { name: "cos", value: f64::cos, slope: |x, _| -x.sin(), bend: |_, y| -y },
    Function {
        name: "tan",
        value: f64::tan,
        slope: |_, y| 1.0 + y * y,
        bend: |_, y| 2.0 * y * (1.0 + y * y),
    },
    Function {
        name: "asin",
        value: f64::asin,
        slope: |x, _| 1.0 / (1.0 - x * x).sqrt(),
        bend: |x, _| x * (1.0 - x * x).powf(-1.5),
    },
    Function {
        name: "acos",
        value: f64::acos,
        slope: |x, _| -1.0 / (1.0 - x * x).sqrt(),
        bend: |x, _| -x * (1.0 - x * x).powf(-1.5),
    },
    Function {
        name: "atan",
        value: f64::atan,
        slope: |x, _| 1.0 / (1.0 + x * x),
        bend: |x, _| -2.0 * x / (1.0 + x * x).powi(2),
    },
    Function { name: "sinh", value: f64::sinh, slope: |x, _| x.cosh(), bend: |_, y| y },
    Function { name: "cosh", value: f64::cosh, slope: |x, _| x.sinh(), bend: |_, y| y },
    Function {
        name: "tanh",
        value: f64::tanh,
        slope: |_, y| 1.0 - y * y,
        bend: |_, y| 2.0 * y * (y * y - 1.0),
    },
    Function { name: "exp", value: f64::exp, slope: |_, y| y, bend: |_, y| y },
    Function { name: "log", value: f64::ln, slope: |x, _| 1.0 / x, bend: |x, _| -1.0 / (x * x) },
    Function {
        name: "sqrt",
        value: f64::sqrt,
        slope: |_, y| 0.5 / y,
        bend: |_, y| -0.25 / (y * y * y),
    },
    Function { name: "abs", value: f64::abs, slope: |x, _| sign(x), bend: |_, _| 0.0 },
    Function { name: "sign", value: sign, slope: |_, _| 0.0, bend: |_, _| 0.0 },
    // the step function, which is 1 for x >= 0
    Function {
        name: "step",
        value: |x| if x.is_nan() { x } else { f64::from(x >= 0.0) },
        slope: |_, _| 0.0,
        bend: |_, _| 0.0,
    },
    Function { name: "floor", value: f64::floor, slope: |_, _| 0.0, bend: |_, _| 0.0 },
];

/// The functions of two numbers that formulas may call.
pub(super) static FUNCTIONS_OF_TWO: [FunctionOfTwo; 3] = [
    FunctionOfTwo {
        name: "min",
        value: |x, y| if x.is_nan() || x < y { x } else { y },
        slopes: |x, y| selected(x < y, y < x),
        bends: |_, _| [0.0; 3],
        folds: true,
    },
    FunctionOfTwo {
        name: "max",
        value: |x, y| if x.is_nan() || x > y { x } else { y },
        slopes: |x, y| selected(x > y, y > x),
        bends: |_, _| [0.0; 3],
        folds: true,
    },
    FunctionOfTwo {
        name: "atan2",
        value: f64::atan2,
        slopes: |y, x| {
            let square = x * x + y * y;
            [x / square, -y / square]
        },
        bends: |y, x| {
            let fourth = (x * x + y * y).powi(2);
            let twice = 2.0 * x * y / fourth;
            [-twice, (y * y - x * x) / fourth, twice]
        },
        folds: false,
    },
];

/// The sign of a number: `-1`, `0` or `1`.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// The derivatives of a function that selects one of two numbers. If it selects neither number,
/// both derivatives are 1/2.
fn selected(first: bool, second: bool) -> [f64; 2] {
    let share = 0.5 * (1.0 + f64::from(first) - f64::from(second));
    [share, 1.0 - share]
}
