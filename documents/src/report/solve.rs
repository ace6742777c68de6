//! The values of letters for which a geometry has a property.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::input::InputError;
use crate::space::Definition;
use affinor::Geometry;
use affinor::geometry::conditions::{
    Condition, ConditionSolutions, ParametricGeometry, SolutionFamily, SolutionPoint,
};
use affinor_tensors::polynomial::RealNumber;
use affinor_tensors::{Notation, Rational, Ring, Symbolic, Tolerance};
use num_traits::{One, Zero};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.solve/1";
/// The largest number of equations in the report. JSON contains all of them.
const MOST: usize = 12;
/// The number of characters above which an equation is written in JSON only.
const LONGEST: usize = 400;
/// The number of significant digits of decimal numbers.
const DIGITS: u32 = 12;
/// The effort of the solver for the rows of other reports.
const QUICK: u64 = 3_000_000;

/// All values of the letters for which a condition holds, ready for output.
#[derive(Clone, Debug)]
pub struct Solutions(Grid);

impl Solutions {
    /// The solutions of a condition on the letters of a definition.
    ///
    /// # Errors
    /// Those of [`Definition::geometry`] and [`ConditionSolutions::of`].
    pub fn of(definition: &Definition, condition: Condition) -> Result<Self, InputError> {
        Self::of_geometry(&definition.geometry(Tolerance::default())?, condition)
    }

    /// The solutions of a condition on the letters of a geometry.
    ///
    /// # Errors
    /// Those of [`ParametricGeometry::of`] and [`ConditionSolutions::of`].
    pub fn of_geometry(
        geometry: &Geometry<Symbolic>,
        condition: Condition,
    ) -> Result<Self, InputError> {
        let found = ConditionSolutions::of(ParametricGeometry::of(geometry)?, condition)?;
        Ok(Self::new(geometry, &found))
    }

    fn new(geometry: &Geometry<Symbolic>, found: &ConditionSolutions) -> Self {
        let condition = found.condition;
        let mut rows: Vec<Vec<Cell>> = vec![];
        let mut row = |values: Vec<String>, remark: Vec<String>| {
            let cell = |text: Vec<String>| Cell { text, ..Cell::default() };
            rows.push(vec![cell(values), cell(remark)]);
        };
        for point in &found.points {
            row(values(point), remarks(point, found));
        }
        for family in &found.families {
            row(family_lines(family), family_remarks(family, found));
        }
        if found.is_empty() {
            row(vec!["none".into()], vec!["no real values of the letters are solutions".into()]);
        }
        let letters = printable_list(&found.letters);
        let scale = match &found.scaled[..] {
            [] => letters,
            scaled => format!("{letters}; up to a common factor of {}", printable_list(scaled)),
        };
        let head: Vec<(&str, Cell)> = vec![
            ("connection", printable(&geometry.kind().describe()).into()),
            ("metric", metric_line(geometry).into()),
            ("condition", condition.statement().into()),
            ("letters", scale.into()),
            ("not zero", list(&found.nonzero, "no condition").into()),
            ("equations", equations(found).into()),
            ("solutions", summary(found).into()),
        ];
        let name = printable(geometry.name());
        let title = format!("Values for which {name} is {}", adjective(condition));
        let header = ["values", "remark"];
        let grid = Grid::new(title, &header, rows, document(geometry, found));
        Solutions(grid.with_head(head))
    }
}

/// The metric, if its text is short.
fn metric_line(geometry: &Geometry<Symbolic>) -> String {
    let Some(metric) = geometry.metric() else { return "none".into() };
    match metric.to_string() {
        text if text.chars().count() > LONGEST => "given".into(),
        text => printable(&text),
    }
}

/// The condition as an adjective of the space.
fn adjective(condition: Condition) -> String {
    match condition {
        Condition::Einstein => "Einstein".into(),
        Condition::RicciFlat => "Ricci-flat".into(),
        Condition::ConstantCurvature => "of constant curvature".into(),
        Condition::RicciSoliton => "an algebraic Ricci soliton".into(),
        Condition::ParallelTorsion => "of parallel torsion".into(),
        Condition::ParallelCurvature => "of parallel curvature".into(),
        other => other.name().into(),
    }
}

fn list(values: &[Symbolic], empty: &str) -> String {
    let text: Vec<String> = values.iter().map(Symbolic::to_string).collect();
    if text.is_empty() { empty.into() } else { text.join(", ") }
}

fn summary(found: &ConditionSolutions) -> String {
    let count = |n: usize, one: &str, many: &str| match n {
        1 => format!("1 {one}"),
        n => format!("{n} {many}"),
    };
    let points = count(found.points.len(), "isolated solution", "isolated solutions");
    let families = count(found.families.len(), "family", "families");
    format!("{points}, {families}; complete over the real numbers")
}

/// A product of factors as text; the empty product is 1.
fn product(factors: &[Symbolic]) -> String {
    match factors {
        [] => "1".into(),
        [one] => one.to_string(),
        several => {
            let text = several.iter().map(|factor| match factor.to_string() {
                text if text.contains(' ') => format!("({text})"),
                text => text,
            });
            text.collect::<Vec<_>>().join("*")
        }
    }
}

/// The equations, separated by semicolons.
fn equations(found: &ConditionSolutions) -> String {
    if found.equations.is_empty() {
        return "none: the condition always holds".into();
    }
    let line = |factors: &Vec<Symbolic>| match product(factors) {
        text if text.chars().count() > LONGEST => "... = 0, in --format json".into(),
        text => format!("{text} = 0"),
    };
    let mut lines: Vec<String> = found.equations.iter().take(MOST).map(line).collect();
    if found.equations.len() > MOST {
        lines.push(format!("and {} more in --format json", found.equations.len() - MOST));
    }
    lines.join("; ")
}

/// The values of a point: rational values in one line, and a line for each other value.
fn values(point: &SolutionPoint) -> Vec<String> {
    let rational = point.values.iter().filter(|(_, value)| value.rational().is_some());
    let rational: Vec<String> =
        rational.map(|(name, value)| format!("{} = {value}", printable(name))).collect();
    let other = point.values.iter().filter(|(_, value)| value.rational().is_none());
    let other = other.map(|(name, value)| {
        let decimal = value.decimal(DIGITS);
        match value.degree() {
            2 => format!("{} = {value} = {decimal}...", printable(name)),
            _ => format!("{} = {decimal}..., {} = 0", printable(name), defining(name, value)),
        }
    });
    let first = (!rational.is_empty()).then(|| rational.join(", "));
    first.into_iter().chain(other).collect()
}

/// The defining polynomial of a number.
fn defining(name: &str, value: &RealNumber) -> String {
    let x = Symbolic::parameter(name);
    let horner = value
        .polynomial()
        .iter()
        .rev()
        .fold(Symbolic::from_i64(0), |sum, c| sum * &x + &Symbolic::constant(c.clone()));
    match horner.to_string() {
        text if text.chars().count() > LONGEST => {
            format!("polynomial of degree {}", value.degree())
        }
        text => text,
    }
}

/// The signature in words, with its numbers.
fn signature(point: &SolutionPoint) -> Option<String> {
    let [plus, minus] = point.signature?;
    Some(match (plus, minus) {
        (_, 0) => "definite metric".into(),
        (0, _) => "negative definite metric".into(),
        _ => format!("signature ({plus}, {minus})"),
    })
}

fn remarks(point: &SolutionPoint, found: &ConditionSolutions) -> Vec<String> {
    let constant = point.constant.as_ref().map(|c| {
        let text = match c.rational().is_some() || c.degree() == 2 {
            true => c.to_string(),
            false => format!("{}...", c.decimal(DIGITS)),
        };
        match found.condition {
            Condition::Einstein if c.rational().is_some_and(|c| c.is_zero()) => "Ric = 0".into(),
            Condition::Einstein if c.rational().is_some_and(|c| c.is_one()) => "Ric = g".into(),
            Condition::Einstein if text.contains(' ') => format!("Ric = ({text}) g"),
            Condition::Einstein => format!("Ric = {text} g"),
            _ => format!("curvature {text}"),
        }
    });
    signature(point).into_iter().chain(constant).collect()
}

/// An equation, solved for a letter if it is linear with a constant coefficient.
fn solved(equation: &Symbolic) -> String {
    let solution = equation.parameters().into_iter().find_map(|letter| {
        let slope = Notation::derivative(equation, &letter);
        let inverse = slope.as_constant().and_then(affinor_tensors::Field::recip)?;
        let x = Symbolic::parameter(&letter);
        let value = x - &(equation.clone() * &Symbolic::constant(inverse));
        Some(format!("{letter} = {value}"))
    });
    solution.unwrap_or_else(|| format!("{equation} = 0"))
}

fn family_lines(family: &SolutionFamily) -> Vec<String> {
    match family.equations.is_empty() {
        true => vec!["all values".into()],
        false => family.equations.iter().map(solved).map(|text| printable(&text)).collect(),
    }
}

fn family_remarks(family: &SolutionFamily, found: &ConditionSolutions) -> Vec<String> {
    let scale = usize::from(!found.scaled.is_empty());
    let up_to = if scale > 0 { ", up to scale" } else { "" };
    let dimension =
        format!("family of dimension {}{up_to}", family.free.len() - scale.min(family.free.len()));
    let free = format!("free: {}", printable_list(&family.free));
    let sample = match &family.sample {
        Some(sample) => {
            let metric = signature(sample).map_or(String::new(), |text| format!("{text} at "));
            format!("{metric}{}", values(sample).join(", "))
        }
        None => "no real point found".into(),
    };
    vec![dimension, free, sample]
}

/// The report in JSON.
fn document(geometry: &Geometry<Symbolic>, found: &ConditionSolutions) -> Value {
    let strings = |values: &[Symbolic]| values.iter().map(Symbolic::to_string).collect::<Vec<_>>();
    let equations: Vec<String> = found.equations.iter().map(|factors| product(factors)).collect();
    let families = found.families.iter().map(|family| {
        json!({
            "equations": strings(&family.equations),
            "free": family.free,
            "sample": family.sample.as_ref().map(point_document),
        })
    });
    json!({
        "schema": SCHEMA,
        "name": geometry.name(),
        "connection": geometry.kind().name(),
        "condition": found.condition.name(),
        "statement": found.condition.statement(),
        "letters": found.letters,
        "scaled": found.scaled,
        "nonzero": strings(&found.nonzero),
        "equations": equations,
        "complete": true,
        "points": found.points.iter().map(point_document).collect::<Vec<_>>(),
        "families": families.collect::<Vec<_>>(),
    })
}

fn point_document(point: &SolutionPoint) -> Value {
    let number = |value: &RealNumber| {
        let width = Rational::new(1, 1 << 40).unwrap_or_default();
        let interval = value.interval(&width).map(|end| end.to_string());
        let polynomial: Vec<String> = value.polynomial().iter().map(Rational::to_string).collect();
        json!({
            "value": value.to_string(),
            "decimal": value.decimal(DIGITS),
            "polynomial": polynomial,
            "interval": interval,
        })
    };
    let values = point.values.iter().map(|(name, value)| {
        let mut entry = number(value);
        entry["letter"] = name.as_str().into();
        entry
    });
    json!({
        "values": values.collect::<Vec<_>>(),
        "signature": point.signature,
        "definite": point.is_definite(),
        "constant": point.constant.as_ref().map(number),
    })
}

/// The alternatives under which a condition holds, each as equations such as `a = b and c = 2*b`.
/// Returns `None` if the geometry has no letters, or if the equations are too hard to solve quickly.
pub(super) fn alternatives(
    geometry: &Geometry<Symbolic>,
    condition: Condition,
) -> Option<Vec<String>> {
    let parts = ParametricGeometry::of(geometry).ok()?;
    let found = ConditionSolutions::within(parts, condition, Some(QUICK)).ok()?;
    let of_point = |point: &SolutionPoint| {
        let unit = point.values.iter().find(|(name, value)| {
            found.scaled.contains(name) && value.rational().is_some_and(|value| value.is_one())
        });
        let equation = |(name, value): &(String, RealNumber)| {
            let text = match value.rational().is_some() || value.degree() == 2 {
                true => value.to_string(),
                false => format!("{}...", value.decimal(DIGITS)),
            };
            let right = match unit {
                Some((own, _)) if own == name => return None,
                Some((own, _)) if found.scaled.contains(name) => match text.as_str() {
                    "0" => "0".into(),
                    "1" => own.clone(),
                    "-1" => format!("-{own}"),
                    text if text.contains(' ') => format!("({text})*{own}"),
                    text => format!("{text}*{own}"),
                },
                _ => text,
            };
            Some(format!("{name} = {right}"))
        };
        point.values.iter().filter_map(equation).collect::<Vec<_>>().join(" and ")
    };
    let of_family = |family: &SolutionFamily| {
        family.equations.iter().map(solved).collect::<Vec<_>>().join(" and ")
    };
    let real = found.families.iter().filter(|family| family.sample.is_some());
    if real.clone().count() < found.families.len() {
        return None;
    }
    let all = found.points.iter().map(of_point).chain(real.map(of_family));
    Some(all.collect())
}

impl Report for Solutions {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
