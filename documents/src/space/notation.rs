//! Parsers of expressions in definitions: linear combinations such as `h*e2 + 1/2 e1`, complex
//! entries, metrics, connections.

use crate::input::{InputError, Place, Source, shown};
use crate::space::{
    ConnectionChoice, Given, MetricChoice,
    functions::{self, Functions},
};
use affinor::CanonicalConnection;
use affinor::algebra::Complex;
use affinor_tensors::expression::{
    Evaluator, Expression, ExpressionError, POWER, Scalars, canonical_name, is_name, no_function,
};
use affinor_tensors::{Field, Rational, Ring, Symbolic};
use std::collections::{BTreeMap, BTreeSet};

/// The names that an expression may contain, with their meanings.
pub(crate) struct Names<'n> {
    pub labels: &'n BTreeMap<String, usize>,
    /// The declared parameters; if `None`, every unknown name is a parameter.
    pub parameters: Option<&'n BTreeSet<String>>,
    /// The functions on a chart. The coordinates of the chart are declared as parameters too.
    pub functions: Option<&'n Functions>,
    /// Whether the name of an undetermined function without arguments means the function at its
    /// declared arguments.
    pub bare: bool,
}

impl<'n> Names<'n> {
    /// Allows these basis vectors and any other name. Every unknown name is a parameter.
    pub fn open(labels: &'n BTreeMap<String, usize>, functions: Option<&'n Functions>) -> Self {
        Names { labels, parameters: None, functions, bare: false }
    }

    /// Parses and evaluates `text`, which is a piece of `source`.
    pub fn read<M: Evaluator>(
        &self,
        text: &str,
        source: &Source,
        meaning: &M,
    ) -> Result<M::Value, InputError> {
        let known = |name: &str| self.labels.contains_key(name);
        let refused = |ExpressionError { span, reason }: ExpressionError| {
            InputError::usage(reason).at(&source.find(text, span))
        };
        let expression = Expression::parse_beside(text, &known).map_err(refused)?;
        expression.evaluate(meaning).map_err(|error| {
            let name = text.get(error.span.clone()).map(canonical_name);
            match name.filter(|name| self.parameters.is_some() && self.is_unknown(name)) {
                Some(name) => refused(error).help(self.allowed(&name, source)),
                None => refused(error),
            }
        })
    }

    /// Advice for an unknown name. In an option, the declared names are allowed; a file may declare
    /// others.
    fn allowed(&self, name: &str, source: &Source) -> String {
        let declared = self.parameters.into_iter().flatten();
        let all: Vec<String> = declared.map(|name| shown(name)).collect();
        if source.name.starts_with("--") && !all.is_empty() {
            return format!("the names are {}", all.join(", "));
        }
        format!("declare a parameter: parameters = [\"{}\"]", shown(name))
    }

    /// Whether a name is neither declared nor a basis vector.
    fn is_unknown(&self, name: &str) -> bool {
        let declared = self.parameters.is_some_and(|declared| declared.contains(name));
        is_name(name) && !declared && !is_no_number(name) && !self.labels.contains_key(name)
    }

    /// Parses and evaluates a scalar.
    pub fn scalar(&self, text: &str, source: &Source) -> Result<Symbolic, InputError> {
        let function = |name: &str, arguments: &[Symbolic]| self.call(name, arguments);
        self.read(text, source, &Scalars(|name: &str| self.parameter(name), function))
    }

    /// Evaluates a function of coordinates, or the square root of a square.
    pub(crate) fn call(&self, name: &str, arguments: &[Symbolic]) -> Result<Symbolic, String> {
        self.functions.map_or_else(
            || functions::without_chart(name, arguments),
            |functions| functions.call(name, arguments),
        )
    }

    /// Parses a linear combination of basis vectors.
    pub fn vector(
        &self,
        text: &str,
        source: &Source,
    ) -> Result<BTreeMap<usize, Symbolic>, InputError> {
        let element = self.read(text, source, &Elements(self))?;
        if element.scalar.vanishes() {
            return Ok(element.vector);
        }
        let message = format!("the term {} does not contain a basis vector", element.scalar);
        Err(InputError::usage(message)
            .at(&source.whole(text.trim()))
            .help("a bracket must be a sum of multiples of basis vectors"))
    }

    /// Parses linear combinations of basis vectors, separated by commas.
    #[cfg(feature = "mechanisms")]
    pub fn vectors(
        &self,
        text: &str,
        source: &Source,
    ) -> Result<Vec<BTreeMap<usize, Symbolic>>, InputError> {
        split(text).into_iter().map(|text| self.vector(text, source)).collect()
    }

    /// Parses a complex number; `i` is the imaginary unit.
    pub fn complex(&self, text: &str, source: &Source) -> Result<Complex<Symbolic>, InputError> {
        self.read(text, source, &ComplexNumbers(self))
    }

    /// A list of the basis vectors, for messages.
    pub fn basis(&self) -> String {
        const SHOWN: usize = 12;
        let mut labels: Vec<_> = self.labels.iter().map(|(label, at)| (*at, label)).collect();
        labels.sort_unstable();
        let first: Vec<_> = labels.iter().take(SHOWN).map(|(_, label)| label.as_str()).collect();
        let more = if labels.len() > SHOWN { ", ..." } else { "" };
        format!("the basis is {}{more}", first.join(", "))
    }

    pub(crate) fn parameter(&self, name: &str) -> Result<Symbolic, String> {
        if is_no_number(name) {
            return Err(format!("`{name}` is not a number"));
        }
        if name.ends_with('\'') {
            return Err(format!("`{}` is not a basis vector here", shown(name)));
        }
        if let (true, Some(functions)) = (self.bare, self.functions)
            && let Some(function) = functions.derivative(name)
        {
            return Ok(function.value());
        }
        match self.parameters {
            None if name == "pi" => Ok(Symbolic::pi()),
            Some(declared) if name == "pi" && !declared.contains(name) => Ok(Symbolic::pi()),
            Some(declared) if !declared.contains(name) => {
                let name = shown(name);
                let known = if self.functions.is_none() { "" } else { "coordinate nor a " };
                Err(format!(
                    "`{name}` is neither a basis vector here nor a {known}declared parameter"
                ))
            }
            _ => Ok(Symbolic::parameter(name)),
        }
    }
}

/// Whether a name means infinity or NaN.
fn is_no_number(name: &str) -> bool {
    ["nan", "inf", "infinity"].contains(&name.to_ascii_lowercase().as_str())
}

/// Parses a statement `head[x, y] = right-hand side`.
pub(super) fn statement(
    line: &str,
    head: &str,
    names: &Names,
    source: &Source,
) -> Result<((usize, usize), Given), InputError> {
    let form = format!("{head}[x, y] = ...");
    let refuse =
        |at: &Place, reason: &str| InputError::usage(reason).at(at).help(format!("write {form}"));
    let line = line.trim();
    let whole = source.whole(line);
    let rest = line.strip_prefix(head).map(str::trim_start);
    let inside = rest.and_then(|rest| rest.strip_prefix('['));
    let Some((pair, right)) = inside.and_then(|inside| inside.split_once(']')) else {
        return Err(refuse(&whole, "this is not a bracket statement"));
    };
    let Some((x, y)) = pair.split_once(',').filter(|(_, y)| !y.contains(',')) else {
        let reason = "write two basis vectors in the bracket, separated by a comma";
        return Err(refuse(&source.whole(pair), reason));
    };
    let Some(right) = right.trim_start().strip_prefix('=') else {
        return Err(refuse(&whole, "`=` is missing after the bracket"));
    };
    let vector = |name: &str| {
        let trimmed = name.trim();
        names.labels.get(&*canonical_name(trimmed)).copied().ok_or_else(|| {
            let place = source.whole(if trimmed.is_empty() { name } else { trimmed });
            InputError::usage(format!("`{}` is not a basis vector", shown(trimmed)))
                .at(&place)
                .help(names.basis())
        })
    };
    let pair = (vector(x)?, vector(y)?);
    let value = names.vector(right, source)?;
    Ok((pair, Given { value, place: whole }))
}

/// The statements of a block. They are separated by lines, by `;`, or by commas before a bracket.
/// Comments and blank lines are left out.
pub(super) fn lines(block: &str) -> impl Iterator<Item = &str> {
    block
        .lines()
        .map(|line| line.split('#').next().unwrap_or(""))
        .flat_map(|line| line.split(';'))
        .flat_map(between_commas)
        .filter(|line| !line.trim().is_empty())
}

/// Splits a line at each comma that is followed by another bracket or by the end of the line: `[x,
/// y] = z, [y, z] = x`.
fn between_commas(line: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0i64, 0, Vec::new());
    for (at, symbol) in line.char_indices() {
        depth += i64::from("([".contains(symbol)) - i64::from(")]".contains(symbol));
        let rest = line[at..].strip_prefix(',').map(str::trim_start);
        let ends =
            |rest: &str| rest.is_empty() || rest.starts_with('[') || rest.starts_with("nabla[");
        if depth == 0 && at > start && rest.is_some_and(ends) {
            parts.push(&line[start..at]);
            start = at + 1;
        }
    }
    parts.push(&line[start..]);
    parts
}

/// Parses a metric: `identity`, `killing`, `invariant`, `diag(...)`, `summands(...)`, or rows
/// `[[...], ...]`.
pub(super) fn metric(
    dimension: usize,
    names: &Names,
    source: &Source,
) -> Result<MetricChoice, InputError> {
    let trimmed = source.content().trim();
    let place = source.whole(trimmed);
    match trimmed {
        "identity" => return Ok(MetricChoice::Identity),
        "killing" => return Ok(MetricChoice::Killing(place)),
        "invariant" => return Ok(MetricChoice::Invariant(place)),
        _ => {}
    }
    if let Some(inside) = enclosed(trimmed, "summands(", ')') {
        let factors = list(inside).into_iter().map(|factor| names.scalar(factor, source));
        return Ok(MetricChoice::Summands(factors.collect::<Result<_, _>>()?, place));
    }
    if let Some(inside) = enclosed(trimmed, "diag(", ')') {
        let entries = list(inside);
        if entries.len() != dimension {
            let found = entries_of(entries.len());
            let message = format!("diag has {found}, but the dimension is {dimension}");
            return Err(InputError::usage(message).at(&place));
        }
        let mut components = Vec::new();
        for (i, entry) in entries.iter().enumerate() {
            components.push(([i, i], names.scalar(entry, source)?));
        }
        return Ok(MetricChoice::Components(components, Some(place)));
    }
    if let Some(inside) = enclosed(trimmed, "[", ']') {
        let mut rows = Vec::new();
        for row in list(inside) {
            let Some(row) = enclosed(row.trim(), "[", ']') else {
                let at = source.whole(row.trim());
                return Err(
                    InputError::usage("write each row of the metric as `[a, b, ...]`").at(&at)
                );
            };
            rows.push(list(row));
        }
        return metric_rows(&rows, dimension, |entry| names.scalar(entry, source), place);
    }
    Err(InputError::usage(format!("`{}` is not a metric", shown(trimmed)))
        .at(&place)
        .help("identity, killing, diag(a, b, ...), [[a, b], [b, c]], or invariant"))
}

/// Reads a metric from its rows; `read` converts an entry to its value.
pub(super) fn metric_rows<T>(
    rows: &[Vec<T>],
    dimension: usize,
    read: impl Fn(&T) -> Result<Symbolic, InputError>,
    place: Place,
) -> Result<MetricChoice, InputError> {
    let square = rows.len() == dimension && rows.iter().all(|row| row.len() == dimension);
    if !square {
        let found = shape(rows);
        let message = format!("the metric has {found}, but the dimension is {dimension}");
        return Err(InputError::usage(message).at(&place));
    }
    let mut components = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            components.push(([i, j], read(entry)?));
        }
    }
    Ok(MetricChoice::Components(components, Some(place)))
}

/// Describes the shape of rows in words: `3 rows of 2 or 3 entries`.
pub(super) fn shape<T>(rows: &[Vec<T>]) -> String {
    let widths: BTreeSet<usize> = rows.iter().map(Vec::len).collect();
    let last = widths.last().copied().unwrap_or(0);
    let others = widths.iter().filter(|width| **width != last);
    let others: String = others.map(|width| format!("{width} or ")).collect();
    match rows.len() {
        0 => "no rows".into(),
        1 => format!("1 row of {}", entries_of(last)),
        n => format!("{n} rows of {others}{}", entries_of(last)),
    }
}

fn entries_of(count: usize) -> String {
    if count == 1 { "1 entry".into() } else { format!("{count} entries") }
}

/// Splits a list at its commas; an empty list has no parts.
fn list(text: &str) -> Vec<&str> {
    if text.trim().is_empty() { vec![] } else { split(text) }
}

/// The text between `open` at its start and `close` at its end.
fn enclosed<'t>(text: &'t str, open: &str, close: char) -> Option<&'t str> {
    text.strip_prefix(open)?.strip_suffix(close)
}

/// Splits a text at commas outside parentheses and brackets.
pub(crate) fn split(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0i64, 0, Vec::new());
    for (at, symbol) in text.char_indices() {
        match symbol {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

/// Numbers the basis vectors by their names, which must be distinct. `place` returns the location
/// of a label.
pub(super) fn basis(
    labels: &[&str],
    place: &dyn Fn(usize) -> Place,
) -> Result<BTreeMap<String, usize>, InputError> {
    super::check_dimension(labels.len())?;
    let mut indices = BTreeMap::new();
    for (at, label) in labels.iter().enumerate() {
        // allows primes at the end, because labels of a second summand end in primes
        check_name(label.trim_end_matches('\'')).map_err(|error| error.at(&place(at)))?;
        if indices.insert(label.to_string(), at).is_some() {
            let message = format!("the basis vector `{label}` is named twice");
            return Err(InputError::usage(message).at(&place(at)));
        }
    }
    Ok(indices)
}

/// Returns an error for a text that is not a name.
pub(crate) fn check_name(name: &str) -> Result<(), InputError> {
    if is_name(name) && name.chars().count() <= 64 {
        return Ok(());
    }
    Err(InputError::usage(format!("`{}` is not a name", shown(name)))
        .help("a name is a letter or _, then letters, digits and _, at most 64 in all"))
}

/// Evaluates the expressions within a right-hand side: sums of a vector and a scalar.
struct Elements<'n>(&'n Names<'n>);

#[derive(Clone)]
struct Element {
    scalar: Symbolic,
    vector: BTreeMap<usize, Symbolic>,
}

impl Element {
    fn scalar(scalar: Symbolic) -> Self {
        Element { scalar, vector: BTreeMap::new() }
    }

    fn map(&self, f: impl Fn(&Symbolic) -> Result<Symbolic, String>) -> Result<Self, String> {
        let vector = self.vector.iter().map(|(i, value)| Ok((*i, f(value)?)));
        Ok(Element { scalar: f(&self.scalar)?, vector: vector.collect::<Result<_, String>>()? })
    }
}

/// Evaluates the arithmetic of scalars, within the limits on their size.
pub(super) fn scalars() -> impl Evaluator<Value = Symbolic> {
    Scalars(|name: &str| -> Result<Symbolic, String> { Err(name.into()) }, no_function)
}

impl Evaluator for Elements<'_> {
    type Value = Element;
    fn number(&self, number: &Rational) -> Result<Element, String> {
        Ok(Element::scalar(Symbolic::constant(number.clone())))
    }
    fn name(&self, name: &str) -> Result<Element, String> {
        match self.0.labels.get(name) {
            Some(at) => Ok(Element {
                scalar: Symbolic::from_i64(0),
                vector: [(*at, Symbolic::from_i64(1))].into(),
            }),
            None => self.0.parameter(name).map(Element::scalar),
        }
    }
    fn add(&self, a: Element, b: Element) -> Result<Element, String> {
        let mut sum = a;
        sum.scalar = scalars().add(sum.scalar, b.scalar)?;
        for (i, value) in b.vector {
            let value = match sum.vector.remove(&i) {
                Some(other) => scalars().add(other, value)?,
                None => value,
            };
            if !value.vanishes() {
                sum.vector.insert(i, value);
            }
        }
        Ok(sum)
    }
    fn multiply(&self, a: Element, b: Element) -> Result<Element, String> {
        let (factor, element) = match (a.vector.is_empty(), b.vector.is_empty()) {
            (true, _) => (a.scalar, b),
            (_, true) => (b.scalar, a),
            _ => return Err("the product of two basis vectors is not defined here".into()),
        };
        let mut product = element.map(|value| scalars().multiply(value.clone(), factor.clone()))?;
        product.vector.retain(|_, value| !value.vanishes());
        Ok(product)
    }
    fn negate(&self, a: Element) -> Element {
        let vector = a.vector.into_iter().map(|(i, value)| (i, -value)).collect();
        Element { scalar: -a.scalar, vector }
    }
    fn reciprocal(&self, a: Element) -> Result<Element, String> {
        if !a.vector.is_empty() {
            return Err("a basis vector cannot divide".into());
        }
        scalars().reciprocal(a.scalar).map(Element::scalar)
    }
    fn raise(&self, base: Element, exponent: Element) -> Result<Element, String> {
        self.call(POWER, vec![base, exponent])
    }
    fn call(&self, name: &str, arguments: Vec<Element>) -> Result<Element, String> {
        if arguments.iter().any(|argument| !argument.vector.is_empty()) {
            return Err("a basis vector cannot be an argument".into());
        }
        let arguments: Vec<_> = arguments.into_iter().map(|argument| argument.scalar).collect();
        self.0.call(name, &arguments).map(Element::scalar)
    }
}

/// Evaluates complex numbers over the scalars.
struct ComplexNumbers<'n>(&'n Names<'n>);

impl Evaluator for ComplexNumbers<'_> {
    type Value = Complex<Symbolic>;
    fn number(&self, number: &Rational) -> Result<Self::Value, String> {
        Ok(Complex::real(Symbolic::constant(number.clone())))
    }
    fn name(&self, name: &str) -> Result<Self::Value, String> {
        match name {
            "i" => Ok(Complex { re: Symbolic::from_i64(0), im: Symbolic::from_i64(1) }),
            _ => self.0.parameter(name).map(Complex::real),
        }
    }
    fn add(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String> {
        let s = scalars();
        Ok(Complex { re: s.add(a.re, b.re)?, im: s.add(a.im, b.im)? })
    }
    fn multiply(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, String> {
        let s = scalars();
        let product = |x: &Symbolic, y: &Symbolic| s.multiply(x.clone(), y.clone());
        let re = s.add(product(&a.re, &b.re)?, -product(&a.im, &b.im)?)?;
        let im = s.add(product(&a.re, &b.im)?, product(&a.im, &b.re)?)?;
        Ok(Complex { re, im })
    }
    fn negate(&self, a: Self::Value) -> Self::Value {
        Complex { re: -a.re, im: -a.im }
    }
    fn reciprocal(&self, a: Self::Value) -> Result<Self::Value, String> {
        let s = scalars();
        let square = |x: &Symbolic| s.multiply(x.clone(), x.clone());
        let norm = s.add(square(&a.re)?, square(&a.im)?)?;
        let factor = norm.recip().ok_or("division by zero")?;
        let conjugate = Complex { re: a.re, im: -a.im };
        self.multiply(conjugate, Complex::real(factor))
    }
}

/// Parses the name of a connection. Returns the connection and its location.
pub(super) fn connection(
    names: &Names,
    source: &Source,
) -> Result<(ConnectionChoice, Place), InputError> {
    let trimmed = source.content().trim();
    let family =
        trimmed.strip_prefix("lambda").and_then(|rest| rest.trim_start().strip_prefix('='));
    let place = source.whole(trimmed);
    #[cfg(feature = "mechanisms")]
    let of = trimmed.strip_prefix("nonholonomic");
    #[cfg(feature = "mechanisms")]
    if let Some(vectors) = of.and_then(|rest| enclosed(rest.trim_start(), "(", ')')) {
        return Ok((ConnectionChoice::Nonholonomic(names.vectors(vectors, source)?), place));
    }
    let choice = match (trimmed, family) {
        ("plus", _) => ConnectionChoice::Canonical(CanonicalConnection::Plus),
        ("zero", _) => ConnectionChoice::Canonical(CanonicalConnection::Zero),
        ("minus", _) => ConnectionChoice::Canonical(CanonicalConnection::Minus),
        // the names on a homogeneous space; on a group G/{e} they are the same connections
        ("natural", _) => ConnectionChoice::Canonical(CanonicalConnection::Zero),
        ("canonical", _) => ConnectionChoice::Canonical(CanonicalConnection::Minus),
        ("levi-civita", _) => ConnectionChoice::LeviCivita,
        (_, Some(value)) => ConnectionChoice::Family(names.scalar(value, source)?),
        _ => {
            let message = format!("`{}` is not a connection", shown(trimmed));
            let help = if cfg!(feature = "mechanisms") {
                "plus, zero, minus, lambda=1/3, levi-civita, or nonholonomic(VECTOR, ...) of vectors that span the distribution; canonical or natural on G/H"
            } else {
                "plus, zero, minus, lambda=1/3, or levi-civita; canonical or natural on G/H"
            };
            return Err(InputError::usage(message).at(&place).help(help));
        }
    };
    Ok((choice, place))
}
