//! Equal functions are equal values, in whichever form they are written.
//!
//! Guards `scalar::symbolic`, through definitions.

use super::statement::LineElement;

/// Two forms of the same function of the coordinates `x`, `y`, `z`, the parameters `p`, `q`, `L`,
/// and the free functions `f(x)` and `g(x, y)`; `x`, `y`, `p`, `L` are positive.
/// `tests/references/line_elements.py` confirms each pair at random points.
#[rustfmt::skip]
const IDENTITIES: &[&str] = &[
    // powers
    "sqrt(x)^2 = x",
    "x^(1/2) = sqrt(x)",
    "sqrt(x^2) = x",
    "(x^(1/3))^3 = x",
    "x^(1/3)*x^(2/3) = x",
    "x^(2/3) = (x^2)^(1/3)",
    "(x^3)^(1/6) = sqrt(x)",
    "(x*y)^(1/3) = x^(1/3)*y^(1/3)",
    "(x/y)^(1/2) = sqrt(x)/sqrt(y)",
    "x^p*x^(1 - p) = x",
    "x^(2*p) = (x^p)^2",
    "(x^p)^q = x^(p*q)",
    "x^(p + 1/2) = x^p*sqrt(x)",
    "(x*y)^p = x^p*y^p",
    "x^(p - q)*x^q = x^p",
    "(x^(1/p))^p = x",
    "(1 + x)^p*x^p = (x + x^2)^p",
    "(1 + p/x)^q*x^q = (x + p)^q",
    "(2*x)^p = 2^p*x^p",
    "4^p = 2^(2*p)",
    "6^p = 2^p*3^p",
    "1/(sqrt(x) + 1) = (sqrt(x) - 1)/(x - 1)",
    "1/(sqrt(x) + sqrt(y)) = (sqrt(x) - sqrt(y))/(x - y)",
    "sqrt(x^2 + 2*x*y + y^2) = x + y",
    "sqrt(x^3 + x^2*y) = x*sqrt(x + y)",
    "(x^2 + y^2)^(3/2) = (x^2 + y^2)*sqrt(x^2 + y^2)",
    "sqrt(1 + 1/x) = sqrt(x + 1)/sqrt(x)",
    "x^(-1/3) = 1/x^(1/3)",
    "(1/x)^p = x^(-p)",
    "x^(p/L)*x^(-p/L) = 1",
    "x**2 = x^2",
    // numbers
    "sqrt(3)^2 = 3",
    "sqrt(6) = sqrt(2)*sqrt(3)",
    "sqrt(12) = 2*sqrt(3)",
    "sqrt(1/3) = sqrt(3)/3",
    "1/(sqrt(2) + 1) = sqrt(2) - 1",
    "8^(1/3) = 2",
    "2^(3/2) = 2*sqrt(2)",
    "16^(1/3) = 2*2^(1/3)",
    "sqrt(3*x) = sqrt(3)*sqrt(x)",
    "sqrt(0.25) = 1/2",
    "cos(pi/3) = 1/2",
    "sin(pi/3) = sqrt(3)/2",
    "sin(pi/4) = sqrt(2)/2",
    "tan(pi/6) = sqrt(3)/3",
    "cos(pi) = -1",
    "exp(0) = 1",
    "log(1) = 0",
    "log(8) = 3*log(2)",
    // exponentials and logarithms
    "exp(x + p) = exp(x)*exp(p)",
    "exp(2*f(x)) = exp(f(x))^2",
    "exp(f(x)/2)^2 = exp(f(x))",
    "exp(f(x) - g(x, y)) = exp(f(x))/exp(g(x, y))",
    "exp(x/5)^5 = exp(x)",
    "exp(0.1*x)^10 = exp(x)",
    "exp(x/L)^L = exp(x)",
    "exp(x)^p = exp(p*x)",
    "sqrt(exp(x)) = exp(x/2)",
    "exp(log(x)) = x",
    "exp(2*log(x)) = x^2",
    "exp(log(x)/2) = sqrt(x)",
    "exp(p*log(x)) = x^p",
    "exp(x + log(y)) = y*exp(x)",
    "log(exp(f(x))) = f(x)",
    "log(x*y) = log(x) + log(y)",
    "log(x/y) = log(x) - log(y)",
    "log(x^p) = p*log(x)",
    "log(sqrt(x)) = log(x)/2",
    "log(2*x) = log(2) + log(x)",
    "log(exp(x)*y) = x + log(y)",
    "ln(x) = log(x)",
    "exp(-p/x)*exp(p/x) = 1",
    "exp(2*x/L)*exp(-x/L) = exp(x/L)",
    "exp((x + y)^2) = exp(x^2)*exp(2*x*y)*exp(y^2)",
    "exp(1/(x + y))^2 = exp(2/(x + y))",
    "exp((x^2 - y^2)/(x + y)) = exp(x)/exp(y)",
    // trigonometric functions
    "sin(f(x))^2 + cos(f(x))^2 = 1",
    "sin(2*f(x)) = 2*sin(f(x))*cos(f(x))",
    "cos(2*g(x, y)) = 1 - 2*sin(g(x, y))^2",
    "sin(x + p) = sin(x)*cos(p) + cos(x)*sin(p)",
    "cos(f(x) + x) = cos(f(x))*cos(x) - sin(f(x))*sin(x)",
    "tan(f(x)) = sin(f(x))/cos(f(x))",
    "tan(2*x) = 2*tan(x)/(1 - tan(x)^2)",
    "cot(x)*tan(x) = 1",
    "sec(x)^2 - tan(x)^2 = 1",
    "csc(x)*sin(x) = 1",
    "sin^2(x) = sin(x)^2",
    "sin(x + pi) = -sin(x)",
    "sin(x + pi/2) = cos(x)",
    "cos(pi/3 - x) = cos(x)/2 + sqrt(3)/2*sin(x)",
    "sin(-f(x)) = -sin(f(x))",
    "sin(20*x)^2 + cos(20*x)^2 = 1",
    "sin(x/5)*cos(x/5) = sin(0.4*x)/2",
    "sin(x/y)^2 = (1 - cos(2*x/y))/2",
    "sin(sqrt(x))*cos(sqrt(x)) = sin(2*sqrt(x))/2",
    "sin(3*x) = 3*sin(x) - 4*sin(x)^3",
    "cos(sin(x))^2 + sin(sin(x))^2 = 1",
    // hyperbolic functions
    "cosh(f(x))^2 - sinh(f(x))^2 = 1",
    "sinh(x) + cosh(x) = exp(x)",
    "sinh(2*x) = 2*sinh(x)*cosh(x)",
    "tanh(f(x)) = sinh(f(x))/cosh(f(x))",
    "tanh(x) = (exp(2*x) - 1)/(exp(2*x) + 1)",
    "1 - tanh(x)^2 = sech(x)^2",
    "coth(x)^2 - csch(x)^2 = 1",
    "cosh(log(x)) = (x + 1/x)/2",
    "tanh(log(x)) = (x^2 - 1)/(x^2 + 1)",
    "sinh(log(x)/2) = (sqrt(x) - 1/sqrt(x))/2",
    "cosh(x/L + y) = cosh(x/L)*cosh(y) + sinh(x/L)*sinh(y)",
    "sqrt(cosh(x)^2) = cosh(x)",
    "sqrt(cosh(x) + 1) = sqrt(2)*cosh(x/2)",
    // free functions with other arguments
    "f(2*x)^2 = f(2*x)*f(x + x)",
    "f(x/y) - f(x*y/y^2) = 0",
    "g(x, y) = g(x + 0, 1*y)",
    "f(sqrt(x^2)) = f(x)",
];

const CHART: &str = "
parameters = [\"p\", \"q\", \"L\"]
[chart]
coordinates = [\"x\", \"y\", \"z\"]
functions = [\"f(x)\", \"g(x, y)\"]
positive = [\"x\", \"y\", \"p\", \"L\"]
[metric]
components = \"diag(1, 1, 1)\"
";

#[test]
fn equal_functions_are_equal_values() {
    let chart = LineElement::read(CHART).unwrap();
    let failures: Vec<String> = IDENTITIES
        .iter()
        .filter_map(|identity| {
            let (left, right) = identity.split_once(" = ").unwrap();
            match (chart.function(left), chart.function(right)) {
                (Ok(left), Ok(right)) if left == right => None,
                (Ok(left), Ok(right)) => Some(format!("{identity}: {left} and {right}")),
                (Err(error), _) | (_, Err(error)) => Some(format!("{identity}: {error}")),
            }
        })
        .collect();
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}

/// The derivatives of equal functions are equal.
#[test]
fn derivatives_of_equal_functions_are_equal() {
    let chart = LineElement::read(CHART).unwrap();
    for identity in IDENTITIES {
        let (left, right) = identity.split_once(" = ").unwrap();
        let (Ok(left), Ok(right)) = (chart.function(left), chart.function(right)) else { continue };
        for name in ["x", "y"] {
            assert_eq!(left.derivative(name), right.derivative(name), "d/d{name} of {identity}");
        }
    }
}
