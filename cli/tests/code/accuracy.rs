//! Programs of tensors on charts, against references in 17 digits: `tests/data/programs.json`, by `tests/references/programs.py`.
//!
//! Points are close to and far from the special values of the functions. The error of a component is at most 1000 times the
//! machine precision times the sum of `|F|` and `|x dF/dx|` over all arguments `x`.

use crate::common::root;
use crate::compiled;
use affinor_documents::report::{Computation, Language, Quantity, Selection};
use affinor_documents::space::{Request, Space};
use affinor_tensors::scalar::{Step, StraightLine};
use affinor_tensors::{Notation, Rational, Recorded, Symbolic, Tolerance};
use serde::Deserialize;

/// The largest error, in units of the machine precision and the condition number.
const LARGEST: f64 = 1000.0;

#[derive(Deserialize)]
struct Chart {
    name: String,
    parameters: Vec<String>,
    coordinates: Vec<String>,
    functions: Vec<String>,
    positive: Vec<String>,
    metric: String,
    arguments: Vec<String>,
    components: Vec<String>,
    points: Vec<Point>,
}

#[derive(Deserialize)]
struct Point {
    at: Vec<f64>,
    values: Vec<String>,
}

fn charts() -> Vec<Chart> {
    let text = std::fs::read_to_string(root().join("tests/data/programs.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

impl Chart {
    fn space(&self) -> Space {
        let text = format!(
            "parameters = {:?}\n[chart]\ncoordinates = {:?}\nfunctions = {:?}\npositive = {:?}\n\
             [metric]\ncomponents = {:?}\n",
            self.parameters, self.coordinates, self.functions, self.positive, self.metric
        );
        let definition = Some((self.name.clone(), text));
        Space::open(&Request { definition, ..Request::default() }).unwrap()
    }

    /// The programs of the components with references.
    fn program(&self) -> StraightLine {
        let space = self.space();
        let geometry = space.definition.geometry::<Symbolic>(Tolerance::default()).unwrap();
        let mut last = None;
        let mut values = Vec::new();
        for component in &self.components {
            let (key, at) = component.split_once(' ').unwrap_or((component, ""));
            if last.as_ref().is_none_or(|(own, _)| own != key) {
                let tensor = Quantity::from_key(key).unwrap().of(&geometry).unwrap().unwrap();
                last = Some((key.to_string(), tensor));
            }
            let at: Vec<usize> = at.bytes().map(|digit| usize::from(digit - b'1')).collect();
            let value = last.as_ref().unwrap().1.get(&at);
            values.push(Recorded::try_from(&value).unwrap());
        }
        StraightLine::new(&values)
    }
}

/// The outputs of a program in floats, with infinite and undefined results as in programs.
fn run(program: &StraightLine, input: &dyn Fn(&str) -> f64) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::new();
    let number = |c: &Rational| f64::from_rational(c).unwrap();
    for step in program.steps() {
        let value = match step {
            Step::Input(variable) => input(variable.text()),
            Step::Function(function, a) => function.value(values[*a]),
            Step::Sum(constant, terms) => {
                let terms = terms.iter().map(|(factor, at)| number(factor) * values[*at]);
                let sum = terms.reduce(|sum, term| sum + term).unwrap_or(0.0);
                sum + number(constant)
            }
            Step::Product(a, b) => values[*a] * values[*b],
            Step::Reciprocal(a) => 1.0 / values[*a],
            Step::Select(_) => panic!("the metric of a chart is inverted before it is recorded"),
        };
        values.push(value);
    }
    let outputs = program.outputs().iter();
    outputs.map(|o| number(&o.factor) * o.step.map_or(1.0, |at| values[at])).collect()
}

/// Descriptions of components that violate the bound.
fn violations(chart: &Chart, point: &Point, found: &[f64]) -> Vec<String> {
    let mut all = Vec::new();
    for ((component, text), found) in chart.components.iter().zip(&point.values).zip(found) {
        // singular, or outside the range of doubles
        let Some((value, size)) = text.split_once(' ') else { continue };
        let [value, size] = [value, size].map(|text| text.parse::<f64>().unwrap());
        let units = (found - value).abs() / size / f64::EPSILON;
        if units.is_nan() || units > LARGEST {
            let (name, at) = (&chart.name, &point.at);
            all.push(format!(
                "{name}, {component} at {at:?}: {found:e}, right {value:e}: {units:e}"
            ));
        }
    }
    all
}

/// Charts whose programs lose accuracy: near the largest and smallest doubles because of
/// exponentials, and in the third chart near the tip of a cone.
const BEYOND: [&str; 3] = ["one_plus_tanh", "difference_of_exponentials", "tanh_radius"];

#[test]
fn programs_on_charts_are_accurate() {
    let mut all = Vec::new();
    for chart in charts().into_iter().filter(|chart| !BEYOND.contains(&chart.name.as_str())) {
        let program = chart.program();
        for point in &chart.points {
            let input = |name: &str| {
                let at = chart.arguments.iter().position(|own| own == name);
                point.at[at.unwrap_or_else(|| panic!("{name}"))]
            };
            all.extend(violations(&chart, point, &run(&program, &input)));
        }
    }
    assert!(all.is_empty(), "{} violations:\n{}", all.len(), all.join("\n"));
}

/// The compiled programs are as accurate as the recorded steps, in every language.
#[test]
fn compiled_programs_on_charts_are_accurate() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["two_plus_tanh", "fermi", "schwarzschild", "root_of_linear", "anti_de_sitter"];
    let keys = ["metric", "affinities", "curvature", "ricci", "scalar_curvature", "kretschmann"];
    for chart in charts().iter().filter(|chart| names.contains(&chart.name.as_str())) {
        let n = chart.coordinates.len();
        let present =
            |key: &&str| chart.components.iter().any(|c| c.split(' ').next() == Some(key));
        let keys: Vec<&str> = keys.into_iter().filter(present).collect();
        let quantities: Vec<Quantity> =
            keys.iter().map(|key| Quantity::from_key(key).unwrap()).collect();
        let ranks: Vec<usize> = quantities.iter().map(|quantity| quantity.slots().len()).collect();
        let shapes: Vec<Vec<usize>> = ranks.iter().map(|rank| vec![n; *rank]).collect();
        let place = |component: &String| {
            let (key, at) = component.split_once(' ').unwrap_or((component, ""));
            let array = keys.iter().position(|own| *own == key).unwrap();
            let before: usize = ranks[..array].iter().map(|rank| n.pow(*rank as u32)).sum();
            before + at.bytes().fold(0, |place, digit| place * n + usize::from(digit - b'1'))
        };
        let places: Vec<usize> = chart.components.iter().map(place).collect();
        let space = chart.space();
        let selection = Selection { quantities, ..Selection::default() };
        for language in Language::ALL {
            let source = Computation::of(&space).table_as_code(&selection, language, &[]).unwrap();
            // rustc is slow
            for point in chart.points.iter().step_by(3).take(2) {
                let input = |name: &str| {
                    point.at[chart.arguments.iter().position(|own| own == name).unwrap()]
                };
                let x = &point.at[..n];
                let found = compiled::run(folder.path(), language, &source, &[x], &input, &shapes);
                let Some(found) = found else { continue };
                let found: Vec<f64> = places.iter().map(|at| found[*at]).collect();
                let all = violations(chart, point, &found);
                assert!(all.is_empty(), "{}\n{source}", all.join("\n"));
            }
        }
    }
}
