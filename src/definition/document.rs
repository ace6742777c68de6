//! The keys of a definition, and what they define.

use super::chart::OnChart;
use super::input::{InputError, Place, Source, shown};
use super::notation::{
    Names, basis, check_name, connection, lines, metric, metric_rows, statement,
};
use super::written::{
    Block, Cell, ChartText, ConnectionText, FieldsText, MatrixRows, MetricText, Row, Text,
};
use super::{ConnectionChoice, Definition, Given, MatrixEntries, Origin, Pairs, check_dimension};
use crate::chart::field_of;
use affinor_tensors::{Ring, Symbolic};
use std::borrow::Cow;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

/// The keys of a file. Unknown and duplicate ones are refused.
///
/// Strings are kept as pieces of the text they were read from, so that they know their places.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document<'t> {
    name: Option<String>,
    #[serde(borrow)]
    basis: Option<Vec<Text<'t>>>,
    dimension: Option<i64>,
    #[serde(borrow, default)]
    parameters: Vec<Text<'t>>,
    #[serde(borrow)]
    brackets: Option<Block<'t>>,
    #[serde(borrow)]
    structure_constants: Option<Vec<Row<'t>>>,
    #[serde(borrow)]
    matrices: Option<Vec<MatrixRows<'t>>>,
    #[serde(borrow)]
    chart: Option<ChartText<'t>>,
    #[serde(borrow)]
    frame: Option<FieldsText<'t>>,
    #[serde(borrow)]
    metric: Option<MetricText<'t>>,
    #[serde(borrow)]
    connection: Option<ConnectionText<'t>>,
    #[serde(borrow)]
    affinities: Option<Block<'t>>,
}

impl<'t> Document<'t> {
    /// What the keys define.
    ///
    /// # Errors
    /// The first thing that makes no sense, with its place.
    pub fn define(self, source: &Source) -> Result<Definition, InputError> {
        let labels = self.labels(source)?;
        let labels: Vec<&str> = labels.iter().map(|label| &**label).collect();
        let indices = basis(&labels, source)?;
        let parameters = self.declared(&indices, source)?;
        let coordinates: Vec<String> =
            self.coordinates().iter().map(|Text(name)| name.to_string()).collect();
        let declared = parameters.iter().cloned().collect();
        let (parameters, coordinates) = (Some(&parameters), &coordinates);
        let names = Names { labels: &indices, parameters, coordinates };
        // values know no basis vectors
        let none = BTreeMap::new();
        let scalars = Names { labels: &none, parameters, coordinates };
        let origin = match (&self.brackets, &self.structure_constants, &self.matrices) {
            (None, None, None) if self.chart.is_some() => self.fields(&names, source)?,
            _ if self.chart.is_some() => {
                let message = "a chart has the brackets of its fields, and no others";
                return Err(InputError::usage(message).at(&source.key("chart")));
            }
            (Some(block), None, None) => Origin::Brackets(block.statements("", &names, source)?),
            (None, Some(rows), None) => {
                Origin::Brackets(structure_constants(rows, labels.len(), &scalars, source)?)
            }
            (None, None, Some(matrices)) => matrix_basis(matrices, &labels, &scalars, source)?,
            (None, None, None) => {
                return Err(InputError::usage(format!("{} defines no bracket", source.name))
                    .help("give one of brackets, structure_constants, matrices, chart"));
            }
            _ => {
                let message = format!("{} defines its bracket more than once", source.name);
                return Err(InputError::usage(message)
                    .help("give exactly one of brackets, structure_constants, matrices"));
            }
        };
        let metric = match &self.metric {
            None => None,
            Some(MetricText::Word(Text(text))) => {
                let source = source.holding(text);
                Some(metric(source.own(text), labels.len(), &scalars, &source)?)
            }
            Some(MetricText::Rows(rows)) => {
                let rows: Vec<Vec<&str>> = rows.iter().map(|row| texts(row)).collect();
                Some(metric_rows(&rows, labels.len(), &scalars, source, source.key("metric"))?)
            }
        };
        let table = self.connection.as_ref();
        let kind = table.and_then(|table| table.kind.as_ref());
        let within = table.and_then(|table| table.affinities.as_ref());
        let connection = match (kind, within.or(self.affinities.as_ref())) {
            (None, None) if table.is_some() => {
                let error = InputError::usage("the connection has neither kind nor affinities");
                return Err(error.at(&source.key("connection")));
            }
            (None, None) => None,
            (Some(Text(text)), None) => Some(connection(text, &scalars, source)?),
            (None, Some(block)) if within.is_none() || self.affinities.is_none() => {
                let given = block.statements("nabla", &names, source)?;
                Some((ConnectionChoice::Affinities(given), source.key("affinities")))
            }
            _ => {
                let message = "a definition has a connection or affinities, not both";
                return Err(InputError::usage(message).at(&source.key("affinities")));
            }
        };
        let stem = || source.name.rsplit('/').next().unwrap_or("").to_string();
        let name = self.name.clone().unwrap_or_else(stem);
        let labels = labels.into_iter().map(str::to_string).collect();
        let algebra_name = None;
        Ok(Definition {
            name,
            algebra_name,
            labels,
            origin,
            metric,
            connection,
            declared,
            source: Some(source.clone()),
        })
    }

    /// The coordinates as written; none without a chart.
    fn coordinates(&self) -> &[Text<'t>] {
        self.chart.as_ref().map_or(&[], |chart| &chart.coordinates)
    }

    /// The parameters, coordinates among them; none the name of something else.
    fn declared(
        &self,
        labels: &BTreeMap<String, usize>,
        source: &Source,
    ) -> Result<BTreeSet<String>, InputError> {
        let fields: Vec<_> = self.coordinates().iter().map(|Text(name)| field_of(name)).collect();
        let mut parameters = BTreeSet::new();
        let coordinates = self.coordinates().iter().map(|text| (text, "coordinate"));
        for (Text(name), what) in
            coordinates.chain(self.parameters.iter().map(|t| (t, "parameter")))
        {
            let place = source.whole(name);
            check_name(name).map_err(|error| error.at(&place))?;
            let known = labels.contains_key(&**name) || fields.iter().any(|field| field == name);
            let taken = known || !parameters.insert(name.to_string());
            if taken || (name == "i" && self.matrices.is_some()) {
                let message = format!("the {what} `{name}` is already the name of something");
                return Err(InputError::usage(message).at(&place));
            }
        }
        Ok(parameters)
    }

    /// The fields of `frame`, by the coordinate fields; without it these themselves.
    fn fields(&self, names: &Names, source: &Source) -> Result<Origin, InputError> {
        let coordinates = names.coordinates;
        let labels = coordinates.iter().zip(0..).map(|(name, at)| (field_of(name), at)).collect();
        let names = Names { labels: &labels, ..*names };
        let place = source.key(if self.frame.is_some() { "frame" } else { "chart" });
        let fields = match &self.frame {
            None => {
                let unit = |a| BTreeMap::from([(a, Symbolic::from_i64(1))]);
                let fields = (0..coordinates.len()).map(|a| (unit(a), place.clone()));
                fields.map(|(value, place)| Given { value, place }).collect()
            }
            Some(FieldsText(fields)) => {
                let (found, n) = (fields.len(), coordinates.len());
                if found != n {
                    let message = format!("the frame has {found} fields for {n} coordinates");
                    return Err(InputError::usage(message).at(&place));
                }
                let field = |(_, Text(field)): &(Text, Text)| {
                    let value = names.vector(field, source)?;
                    Ok(Given { value, place: source.whole(field) })
                };
                fields.iter().map(field).collect::<Result<_, InputError>>()?
            }
        };
        Ok(Origin::Chart(OnChart { coordinates: coordinates.to_vec(), fields, place }))
    }

    /// The basis, from `basis`, `dimension`, the matrices' names, or their number.
    fn labels<'s>(&'s self, source: &Source) -> Result<Vec<Cow<'s, str>>, InputError> {
        let numbered = |at: usize| Cow::Owned(format!("e{}", at + 1));
        let named = |text: &'s Option<Text>, at| match text {
            Some(Text(name)) => Cow::Borrowed(&**name),
            None => numbered(at),
        };
        if let Some(ChartText { coordinates }) = &self.chart {
            if self.basis.is_some() || self.dimension.is_some() {
                let message = "a chart has its coordinates and its frame for a basis";
                return Err(InputError::usage(message).at(&source.key("chart")));
            }
            for (at, Text(name)) in coordinates.iter().enumerate() {
                if coordinates[..at].iter().any(|Text(other)| other == name) {
                    let message = format!("the coordinate `{}` is named twice", shown(name));
                    return Err(InputError::usage(message).at(&source.whole(name)));
                }
                check_name(name).map_err(|error| error.at(&source.whole(name)))?;
            }
            return Ok(match &self.frame {
                Some(FieldsText(fields)) => {
                    fields.iter().map(|(Text(name), _)| Cow::Borrowed(&**name)).collect()
                }
                None => coordinates.iter().map(|Text(name)| field_of(name).into()).collect(),
            });
        }
        if self.frame.is_some() {
            let error = InputError::usage("a frame stands over a chart");
            let help = "give its coordinates: [chart] coordinates = [\"x\", \"y\"]";
            return Err(error.at(&source.key("frame")).help(help));
        }
        match (&self.basis, self.dimension, &self.matrices) {
            (Some(basis), None, _) => {
                Ok(basis.iter().map(|Text(label)| Cow::Borrowed(&**label)).collect())
            }
            (None, Some(dimension), _) => {
                let n = check_dimension(dimension)
                    .map_err(|error| error.at(&source.key("dimension")))?;
                Ok((0..n).map(numbered).collect())
            }
            (None, None, Some(matrices)) => {
                Ok(matrices.iter().enumerate().map(|(at, m)| named(&m.name, at)).collect())
            }
            (Some(_), Some(_), _) => {
                let place = source.key("dimension");
                Err(InputError::usage("give either basis or dimension, not both").at(&place))
            }
            (None, None, None) => Err(InputError::usage(format!("{} has no basis", source.name))
                .help("give basis = [\"x\", \"y\", ...] or dimension = 3")),
        }
    }
}

/// The right sides by ordered pair, from rows `[i, j, k, "v"]`.
fn structure_constants(
    rows: &[Row],
    dimension: usize,
    names: &Names,
    source: &Source,
) -> Result<Pairs, InputError> {
    let mut given = Pairs::new();
    let key = source.key("structure_constants");
    for (at, Row([i, j, k], Cell(Text(text)))) in rows.iter().enumerate() {
        let place = match source.whole(text) {
            Place { span: None, .. } => key.clone(),
            place => place,
        };
        let refuse = |reason: String| {
            let row = format!("[{i}, {j}, {k}, \"{}\"]", shown(text));
            let message = format!("structure_constants, entry {}, {row}: {reason}", at + 1);
            InputError::usage(message).at(&place)
        };
        let index = |index: &i64| {
            let below = index.checked_sub(1).and_then(|index| usize::try_from(index).ok());
            below
                .filter(|index| *index < dimension)
                .ok_or_else(|| refuse(format!("the index {index} is not in 1..{dimension}")))
        };
        let (i, j, k) = (index(i)?, index(j)?, index(k)?);
        let value = names.scalar(text, source).map_err(|error| {
            let message = refuse(error.message.clone()).message;
            InputError { message, ..error }.or_at(&place)
        })?;
        let pair = given
            .entry((i, j))
            .or_insert_with(|| Given { value: BTreeMap::new(), place: place.clone() });
        match pair.value.entry(k) {
            Entry::Vacant(free) => drop(free.insert(value)),
            Entry::Occupied(_) => return Err(refuse("this component is given twice".into())),
        }
    }
    Ok(given)
}

fn matrix_basis(
    matrices: &[MatrixRows],
    labels: &[&str],
    names: &Names,
    source: &Source,
) -> Result<Origin, InputError> {
    let key = source.key("matrices");
    let refuse = |at: &Place, message: String| Err(InputError::usage(message).at(at));
    if matrices.len() != labels.len() {
        let (found, n) = (matrices.len(), labels.len());
        return refuse(&key, format!("{found} matrices for {n} basis vectors"));
    }
    let size = matrices.first().map_or(0, |m| m.rows.len());
    let mut read: Vec<MatrixEntries> = Vec::new();
    for (matrix, label) in matrices.iter().zip(labels) {
        let first = matrix.rows.iter().flatten().map(|Cell(Text(text))| source.whole(text));
        let place = first.into_iter().find(|place| place.span.is_some());
        let place = place.as_ref().unwrap_or(&key);
        if let Some(Text(name)) = &matrix.name
            && name != label
        {
            let (name, place) = (shown(name), source.whole(name));
            return refuse(&place, format!("the matrix of `{label}` is named `{name}`"));
        }
        let widths = matrix.rows.iter().map(Vec::len);
        if size == 0 || matrix.rows.len() != size || widths.clone().any(|width| width != size) {
            let (rows, widths) = (matrix.rows.len(), widths.collect::<BTreeSet<_>>());
            let widths: Vec<_> = widths.iter().map(usize::to_string).collect();
            let form = format!("{rows} rows of {} entries", widths.join(" or "));
            let square = format!("not {0} x {0}", size.max(1));
            return refuse(place, format!("the matrix of `{label}` has {form}, {square}"));
        }
        let mut entries = Vec::new();
        for (i, row) in matrix.rows.iter().enumerate() {
            for (j, text) in texts(row).into_iter().enumerate() {
                let value = names.complex(text, source)?;
                if !(value.re.vanishes() && value.im.vanishes()) {
                    entries.push((i, j, value));
                }
            }
        }
        read.push(entries);
    }
    Ok(Origin::Matrices(size, read))
}

fn texts<'c>(cells: &'c [Cell]) -> Vec<&'c str> {
    cells.iter().map(|Cell(Text(text))| text.as_ref()).collect()
}

impl Block<'_> {
    fn statements(&self, head: &str, names: &Names, source: &Source) -> Result<Pairs, InputError> {
        let mut all = Pairs::new();
        for Text(block) in &self.0 {
            let source = source.holding(block);
            for line in lines(source.own(block)) {
                let (pair, given) = statement(line, head, names, &source)?;
                add(&mut all, pair, given)?;
            }
        }
        Ok(all)
    }
}

/// Takes in a statement; the same pair twice must say the same.
pub(super) fn add(all: &mut Pairs, pair: (usize, usize), given: Given) -> Result<(), InputError> {
    match all.entry(pair) {
        Entry::Vacant(free) => drop(free.insert(given)),
        Entry::Occupied(other) if other.get().value == given.value => {}
        Entry::Occupied(other) => {
            let error = InputError::usage("this pair is given a second, different value");
            let error = error.at(&given.place);
            return Err(match other.get().place.text() {
                Some(first) => error.help(format!("the first is `{}`", shown(first))),
                None => error,
            });
        }
    }
    Ok(())
}
