//! The keys of a definition file, converted to a definition.

use crate::input::{
    InputError, Place, Source,
    forms::{
        Block, Cell, ChartText, ConnectionText, Entries, Formulas, HomogeneousText, MatrixRows,
        MetricText, Part, Row, Text, canonical_names, optional_names,
    },
    shown,
};
use crate::space::{
    ConnectionChoice, Definition, Given, MatrixEntries, MetricChoice, Origin, Pairs, add,
    chart::OnChart,
    check_dimension,
    construction::{
        Construction, Contraction, Extension, OtherBasis, Quotient, Semidirect, Site, Subalgebra,
        TensorProduct, Truncated, pairs,
    },
    functions::Functions,
    homogeneous::CosetSpace,
    named,
    notation::{
        Names, basis, check_name, connection, lines, metric, metric_rows, shape, statement,
    },
};
use affinor::LieAlgebra;
use affinor::geometry::chart::field_of;
use affinor_tensors::{Ring, Symbolic, Tolerance};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

/// The keys of a file. Unknown and duplicate keys are errors.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Document {
    name: Option<String>,
    #[serde(default, deserialize_with = "optional_names")]
    basis: Option<Vec<Text>>,
    dimension: Option<i64>,
    #[serde(default, deserialize_with = "canonical_names")]
    parameters: Vec<Text>,
    brackets: Option<Block>,
    structure_constants: Option<Vec<Row>>,
    matrices: Option<Vec<MatrixRows>>,
    sum: Option<Vec<Part<Document>>>,
    semidirect: Option<Semidirect<Document>>,
    subalgebra: Option<Subalgebra<Document>>,
    quotient: Option<Quotient<Document>>,
    central_extension: Option<Extension<Document>>,
    contraction: Option<Contraction<Document>>,
    change_of_basis: Option<OtherBasis<Document>>,
    truncated: Option<Truncated<Document>>,
    tensor_product: Option<TensorProduct<Document>>,
    complexification: Option<Part<Document>>,
    homogeneous: Option<HomogeneousText<Document>>,
    chart: Option<ChartText>,
    frame: Option<Formulas>,
    metric: Option<MetricText>,
    conformal: Option<Text>,
    connection: Option<ConnectionText>,
    affinities: Option<Block>,
}

impl Document {
    /// Converts the keys to a definition.
    pub fn define(&self, source: &Source) -> Result<Definition, InputError> {
        let built = self.constructed(source)?;
        let coset = self.coset_space(source)?;
        let given = built.as_ref().map(LieAlgebra::labels).map(<[String]>::to_vec);
        let given = given.or_else(|| coset.as_ref().map(CosetSpace::labels));
        let labels = self.labels(given, source)?;
        let place = |at: usize| {
            let (_, text): &(String, Option<&Text>) = &labels[at];
            text.map_or_else(|| Place::within(source.clone()), |text| source.at(text))
        };
        let names: Vec<&str> = labels.iter().map(|(label, _)| &**label).collect();
        let indices = match built.is_some() || coset.is_some() {
            // accepts labels with primes at their ends, which direct sums have
            true if self.basis.is_none() => {
                names.iter().map(|name| name.to_string()).zip(0..).collect()
            }
            _ => basis(&names, &place)?,
        };
        let labels: Vec<String> = labels.iter().map(|(label, _)| label.clone()).collect();
        let parameters = self.declared(&indices, source)?;
        let declared = parameters.iter().cloned().collect();
        let closed = (!source.declares_names()).then_some(&parameters);
        let names = Names { parameters: closed, ..Names::open(&indices, None) };
        let functions = self.chart.as_ref().map(|chart| chart.functions(&names, source));
        let functions = functions.transpose()?;
        let names = Names { functions: functions.as_ref(), ..names };
        let given = (&self.brackets, &self.structure_constants, &self.matrices);
        let origin = match (coset, given, &functions) {
            (Some(coset), ..) => Origin::Homogeneous(Box::new(coset)),
            (_, (None, None, None), _) if built.is_some() => {
                let place = Place::within(source.clone());
                Origin::Brackets(built.iter().flat_map(|algebra| pairs(algebra, &place)).collect())
            }
            (_, (None, None, None), Some(functions)) => self.fields(functions, &names, source)?,
            (_, _, Some(_)) => {
                let message = "brackets are given twice: the fields of the chart define them";
                return Err(source.refused("chart", message));
            }
            (_, (Some(block), None, None), None) => {
                Origin::Brackets(block.statements("", &names, source)?)
            }
            (_, (None, Some(rows), None), None) => {
                Origin::Brackets(structure_constants(rows, labels.len(), &names, source)?)
            }
            (_, (None, None, Some(matrices)), None) => {
                matrix_basis(matrices, &labels, &names, source)?
            }
            (_, (None, None, None), None) => {
                return Err(InputError::usage(format!("{} defines no bracket", source.name)).help(
                    "give one of brackets, structure_constants, matrices, chart, homogeneous, or a construction",
                ));
            }
            _ => {
                let message = format!("{} defines its bracket more than once", source.name);
                return Err(InputError::usage(message)
                    .help("give exactly one of brackets, structure_constants, matrices"));
            }
        };
        let metric = self.metric.as_ref().map(|text| text.read(labels.len(), &names, source));
        let metric = metric.transpose()?;
        let factor = self.conformal.as_ref().map(|text| {
            let source = source.excerpt(text);
            names.scalar(source.content(), &source)
        });
        let factor = factor.transpose()?;
        let table = self.connection.as_ref();
        let kind = table.and_then(|table| table.kind.as_ref());
        let within = table.and_then(|table| table.affinities.as_ref());
        let affinities = source.key(match within {
            Some(_) => "connection.affinities",
            None => "affinities",
        });
        let connection = match (kind, within.or(self.affinities.as_ref())) {
            (None, None) if table.is_some() => {
                let message = "the connection has neither kind nor affinities";
                return Err(source.refused("connection", message));
            }
            (None, None) => None,
            (Some(text), None) => {
                let source = source.excerpt(text);
                Some(connection(&names, &source)?)
            }
            (None, Some(block)) if within.is_none() || self.affinities.is_none() => {
                let given = block.statements("nabla", &names, source)?;
                Some((ConnectionChoice::Affinities(given), affinities))
            }
            _ => {
                let message = "give either a connection or affinities, not both";
                return Err(InputError::usage(message).at(&affinities));
            }
        };
        let stem = || source.name.rsplit('/').next().unwrap_or("").to_string();
        let name = self.name.clone().unwrap_or_else(stem);
        let source = Some(source.clone());
        let definition = Definition::new(name, labels, origin);
        let mut definition = Definition { connection, declared, source, ..definition };
        if let Some(metric) = metric {
            definition.set_metric(metric)?;
        }
        if let Some((factor, text)) = factor.zip(self.conformal.as_ref()) {
            let source = definition.source.clone();
            let rescaled = definition.rescale_metric(&factor);
            rescaled.map_err(|error| source.map_or(error.clone(), |s| error.at(&s.at(text))))?;
        }
        Ok(definition)
    }

    /// The homogeneous space that the key `homogeneous` defines.
    fn coset_space(&self, source: &Source) -> Result<Option<CosetSpace>, InputError> {
        let Some(given) = &self.homogeneous else { return Ok(None) };
        if self.has_brackets() || self.dimension.is_some() {
            let message = "`homogeneous` defines the space: give no brackets and no dimension";
            return Err(source.refused("homogeneous", message));
        }
        let (name, algebra) = self.algebra_of(&given.of, "homogeneous.of", source)?;
        given.read(&name, &algebra, &self.parameter_names(), source).map(Some)
    }

    /// Whether the file has brackets, matrices or a chart.
    fn has_brackets(&self) -> bool {
        self.brackets.is_some()
            || self.structure_constants.is_some()
            || self.matrices.is_some()
            || self.chart.is_some()
    }

    /// The algebra that a part of the file names or defines, with its name; `key` is the key of the
    /// part.
    fn algebra_of(
        &self,
        part: &Part<Self>,
        key: &str,
        source: &Source,
    ) -> Result<(String, LieAlgebra<Symbolic>), InputError> {
        let (definition, place) = match part {
            Part::Name(text) => (named::part(&source.excerpt(text))?, source.at(text)),
            Part::Nested(document) => (document.define(&source.table(key))?, source.key(key)),
        };
        let algebra = definition.algebra_alone().algebra(Tolerance::default());
        Ok((definition.name, algebra.map_err(|error| error.or_at(&place))?))
    }

    /// The algebra that a construction of the file builds; `None` if the file has no construction.
    fn constructed(&self, source: &Source) -> Result<Option<LieAlgebra<Symbolic>>, InputError> {
        let given = [
            ("sum", self.sum.as_deref().map(Construction::Sum)),
            ("semidirect", self.semidirect.as_ref().map(Construction::Semidirect)),
            ("subalgebra", self.subalgebra.as_ref().map(Construction::Subalgebra)),
            ("quotient", self.quotient.as_ref().map(Construction::Quotient)),
            (
                "central_extension",
                self.central_extension.as_ref().map(Construction::CentralExtension),
            ),
            ("contraction", self.contraction.as_ref().map(Construction::Contraction)),
            ("change_of_basis", self.change_of_basis.as_ref().map(Construction::ChangeOfBasis)),
            ("truncated", self.truncated.as_ref().map(Construction::Truncated)),
            ("tensor_product", self.tensor_product.as_ref().map(Construction::TensorProduct)),
            (
                "complexification",
                self.complexification.as_ref().map(Construction::Complexification),
            ),
        ];
        let mut given =
            given.into_iter().filter_map(|(key, construction)| Some((key, construction?)));
        let Some((key, construction)) = given.next() else { return Ok(None) };
        let others = self.has_brackets() || self.homogeneous.is_some();
        if given.next().is_some() || others || self.dimension.is_some() {
            let message =
                format!("`{key}` defines the algebra: give no other brackets and no dimension");
            return Err(source.refused(key, message));
        }
        let read = |part: &Part<Self>, key: &str| Ok(self.algebra_of(part, key, source)?.1);
        let (place, declared) = (source.key(key), self.parameter_names());
        Site { source, place, declared, read: &read }.build(&construction).map(Some)
    }

    /// The names of the parameters, before any check.
    fn parameter_names(&self) -> BTreeSet<String> {
        self.parameters.iter().map(|text| text.to_string()).collect()
    }

    /// The names of the coordinates; none without a chart.
    fn coordinates(&self) -> &[Text] {
        self.chart.as_ref().map_or(&[], |chart| &chart.coordinates)
    }

    /// The names of the parameters and coordinates. A name that is already used is an error.
    fn declared(
        &self,
        labels: &BTreeMap<String, usize>,
        source: &Source,
    ) -> Result<BTreeSet<String>, InputError> {
        let fields: Vec<_> = self.coordinates().iter().map(|name| field_of(name)).collect();
        let mut parameters = BTreeSet::new();
        let coordinates = self.coordinates().iter().map(|text| (text, "coordinate"));
        for (name, what) in coordinates.chain(self.parameters.iter().map(|t| (t, "parameter"))) {
            let place = source.at(name);
            check_name(name).map_err(|error| error.at(&place))?;
            let known = labels.contains_key(&**name) || fields.contains(&name.content);
            let taken = known || !parameters.insert(name.to_string());
            if taken || (&**name == "i" && self.matrices.is_some()) {
                let message = format!("the name `{}` of the {what} is already in use", &**name);
                return Err(InputError::usage(message).at(&place));
            }
        }
        Ok(parameters)
    }

    /// The fields that `frame` defines in terms of the coordinate fields. Without `frame`, the
    /// coordinate fields.
    fn fields(
        &self,
        functions: &Functions,
        names: &Names,
        source: &Source,
    ) -> Result<Origin, InputError> {
        let coordinates = &functions.coordinates;
        let labels = coordinates.iter().zip(0..).map(|(name, at)| (field_of(name), at)).collect();
        let names = Names { labels: &labels, ..*names };
        let place = source.key(if self.frame.is_some() { "frame" } else { "chart" });
        let fields = match &self.frame {
            None => {
                let unit = |a| BTreeMap::from([(a, Symbolic::from_i64(1))]);
                let fields = (0..coordinates.len()).map(|a| (unit(a), place.clone()));
                fields.map(|(value, place)| Given { value, place }).collect()
            }
            Some(Entries(fields)) => {
                let (found, n) = (fields.len(), coordinates.len());
                if found != n {
                    let message = format!("the frame has {found} fields for {n} coordinates");
                    return Err(InputError::usage(message).at(&place));
                }
                let field = |(_, field): &(Text, Text)| {
                    let excerpt = source.excerpt(field);
                    let value = names.vector(excerpt.content(), &excerpt)?;
                    Ok(Given { value, place: source.at(field) })
                };
                fields.iter().map(field).collect::<Result<_, InputError>>()?
            }
        };
        Ok(Origin::Chart(OnChart { functions: functions.clone(), fields, place }))
    }

    /// The names of the basis vectors, from the keys `basis` or `dimension`, from a construction,
    /// whose names are `given`, or from the names or the number of the matrices. A name that the file contains comes with its location.
    fn labels(
        &self,
        given: Option<Vec<String>>,
        source: &Source,
    ) -> Result<Vec<(String, Option<&Text>)>, InputError> {
        fn named(text: &Text) -> (String, Option<&Text>) {
            (text.to_string(), Some(text))
        }
        if let Some(labels) = given {
            let n = labels.len();
            return match &self.basis {
                None => Ok(labels.into_iter().map(|label| (label, None)).collect()),
                Some(basis) if basis.len() == n => Ok(basis.iter().map(named).collect()),
                Some(basis) => {
                    let message = format!("{} names for dimension {n}", basis.len());
                    Err(source.refused("basis", message))
                }
            };
        }
        let numbered = |at: usize| (format!("e{}", at + 1), None);
        if let Some(ChartText { coordinates, .. }) = &self.chart {
            if self.basis.is_some() || self.dimension.is_some() {
                let message = "the basis of a chart is its frame: give no other";
                return Err(source.refused("chart", message));
            }
            for (at, name) in coordinates.iter().enumerate() {
                if coordinates[..at].iter().any(|other| other.content == name.content) {
                    let message = format!("the coordinate `{}` is named twice", shown(name));
                    return Err(InputError::usage(message).at(&source.at(name)));
                }
                check_name(name).map_err(|error| error.at(&source.at(name)))?;
            }
            return Ok(match &self.frame {
                Some(Entries(fields)) => fields.iter().map(|(name, _)| named(name)).collect(),
                None => coordinates.iter().map(|name| (field_of(name), Some(name))).collect(),
            });
        }
        if self.frame.is_some() {
            let help = "give its coordinates: [chart] coordinates = [\"x\", \"y\"]";
            return Err(source.refused("frame", "a frame needs a chart").help(help));
        }
        match (&self.basis, self.dimension, &self.matrices) {
            (Some(basis), None, _) => Ok(basis.iter().map(named).collect()),
            (None, Some(dimension), _) => {
                let n = check_dimension(dimension)
                    .map_err(|error| error.at(&source.key("dimension")))?;
                Ok((0..n).map(numbered).collect())
            }
            (None, None, Some(matrices)) => {
                let names = matrices.iter().map(|matrix| matrix.name.as_ref()).enumerate();
                Ok(names.map(|(at, name)| name.map_or_else(|| numbered(at), named)).collect())
            }
            (Some(_), Some(_), _) => {
                Err(source.refused("dimension", "give either basis or dimension, not both"))
            }
            (None, None, None) => Err(InputError::usage(format!("{} has no basis", source.name))
                .help("give basis = [\"x\", \"y\", ...] or dimension = 3")),
        }
    }
}

/// The brackets, by ordered pair, from rows `[i, j, k, "v"]`.
fn structure_constants(
    rows: &[Row],
    dimension: usize,
    names: &Names,
    source: &Source,
) -> Result<Pairs, InputError> {
    let mut given = Pairs::new();
    for (at, Row([i, j, k], Cell(text))) in rows.iter().enumerate() {
        let source = source.excerpt(text);
        let place = source.whole(source.content());
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
        let value = names.scalar(source.content(), &source).map_err(|error| {
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
    labels: &[String],
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
        let first = matrix.rows.iter().flatten().next();
        let place = &first.map_or_else(|| key.clone(), |Cell(text)| source.at(text));
        if let Some(name) = &matrix.name
            && **name != **label
        {
            let (name, place) = (shown(name), source.at(name));
            return refuse(&place, format!("the matrix of `{label}` is named `{name}`"));
        }
        let mut widths = matrix.rows.iter().map(Vec::len);
        if size == 0 || matrix.rows.len() != size || widths.any(|width| width != size) {
            let form = shape(&matrix.rows);
            let square = format!("not {0} x {0}", size.max(1));
            return refuse(place, format!("the matrix of `{label}` has {form}, {square}"));
        }
        let mut entries = Vec::new();
        for (i, row) in matrix.rows.iter().enumerate() {
            for (j, Cell(text)) in row.iter().enumerate() {
                let source = source.excerpt(text);
                let value = names.complex(source.content(), &source)?;
                if !(value.re.vanishes() && value.im.vanishes()) {
                    entries.push((i, j, value));
                }
            }
        }
        read.push(entries);
    }
    Ok(Origin::Matrices(size, read))
}

impl MetricText {
    /// Converts the metric of the file.
    pub(super) fn read(
        &self,
        dimension: usize,
        names: &Names,
        source: &Source,
    ) -> Result<MetricChoice, InputError> {
        match self {
            MetricText::Word(text) => metric(dimension, names, &source.excerpt(text)),
            MetricText::Rows(rows) => {
                let entry = |Cell(text): &Cell| {
                    let source = source.excerpt(text);
                    names.scalar(source.content(), &source)
                };
                metric_rows(rows, dimension, entry, source.key("metric"))
            }
            MetricText::Diagonal(entries) => {
                let place = source.key("metric");
                if entries.len() != dimension {
                    let found = entries.len();
                    let message = format!(
                        "the diagonal of the metric has {found} entries, but the dimension is {dimension}"
                    );
                    return Err(InputError::usage(message).at(&place));
                }
                let values = entries.iter().enumerate().map(|(i, Cell(text))| {
                    let source = source.excerpt(text);
                    Ok(([i, i], names.scalar(source.content(), &source)?))
                });
                let values = values.collect::<Result<_, InputError>>()?;
                Ok(MetricChoice::Components(values, Some(place)))
            }
        }
    }
}

impl Block {
    fn statements(&self, head: &str, names: &Names, source: &Source) -> Result<Pairs, InputError> {
        let mut all = Pairs::new();
        for block in &self.0 {
            let source = source.excerpt(block);
            for line in lines(source.content()) {
                let (pair, given) = statement(line, head, names, &source)?;
                add(&mut all, pair, given)?;
            }
        }
        Ok(all)
    }
}
