//! The forms in which values of a definition file are written, in TOML or JSON, with their
//! locations.

use affinor_tensors::expression::canonical_name;
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Unexpected, Visitor};
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, Range};
use toml::Spanned;

/// A string or a number of a file.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    /// The string with escapes resolved, or the digits of the number.
    pub content: String,
    /// The byte range in the file, including quotes.
    pub span: Range<usize>,
}

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        &self.content
    }
}

/// Deserializes names, and converts them to their canonical form.
pub(crate) fn canonical_names<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Text>, D::Error> {
    let mut names = Vec::<Text>::deserialize(from)?;
    names.iter_mut().for_each(|name| name.content = canonical_name(&name.content).into_owned());
    Ok(names)
}

/// Deserializes the optional names of a key, and converts them to their canonical form.
pub(crate) fn optional_names<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<Vec<Text>>, D::Error> {
    canonical_names(from).map(Some)
}

/// A value: an expression in a string, or an integer.
pub(crate) struct Cell(pub Text);

/// A structure constant `[i, j, k, "v"]`.
pub(crate) struct Row(pub [i64; 3], pub Cell);

/// A block of statements: one string with one statement per line, or an array of such strings.
pub(crate) struct Block(pub Vec<Text>);

/// A metric as text, its rows, or its diagonal. A table may contain any of them as its `components`.
pub(crate) enum MetricText {
    Word(Text),
    Rows(Vec<Vec<Cell>>),
    Diagonal(Vec<Cell>),
}

/// An item of the list of a metric: a row, or an entry of the diagonal.
enum MetricItem {
    Row(Vec<Cell>),
    Entry(Cell),
}

/// A connection, given by its name, or by a table with its `kind` or its `affinities`.
pub(crate) struct ConnectionText {
    pub kind: Option<Text>,
    pub affinities: Option<Block>,
}

/// A chart: its coordinates, its undetermined functions, and functions that are positive on it.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChartText {
    #[serde(deserialize_with = "canonical_names")]
    pub coordinates: Vec<Text>,
    #[serde(default)]
    pub functions: Vec<Text>,
    #[serde(default)]
    pub positive: Vec<Text>,
    #[serde(default, rename = "where")]
    pub conditions: Vec<Text>,
}

/// A number: an expression in a string, an integer, or a decimal.
#[derive(Clone)]
pub(crate) struct Number(pub Text);

/// A number, or a list of numbers.
pub(crate) struct OneOrMore(pub Vec<Number>);

/// The reference point of an inertia: a word, or coordinates.
pub(crate) enum PointText {
    Word(Text),
    Numbers(Vec<Number>),
}

/// The components of a vector: a list, or a table of names and values.
pub(crate) enum VectorText {
    List(Vec<Number>),
    Named(Entries<Text, Number>),
}

/// A table, or a list of tables.
pub(crate) enum OneOrEach<T> {
    One(T),
    Each(Vec<T>),
}

/// The names and values of a table, in order.
pub(crate) struct Entries<K, V>(pub Vec<(K, V)>);

/// Formulas with their names.
pub(crate) type Formulas = Entries<Text, Text>;

/// A matrix: a table `{name, rows}`, or only the rows.
pub(crate) struct MatrixRows {
    pub name: Option<Text>,
    pub rows: Vec<Vec<Cell>>,
}

/// An action of an algebra: its name, or its matrices.
pub(crate) enum ActionText {
    Word(Text),
    Matrices(Vec<MatrixRows>),
}

/// The algebra from which a construction starts: a name, a file, or an inline document.
pub(crate) enum Part<D> {
    Name(Text),
    Nested(Box<D>),
}

/// The key `homogeneous` of a definition file.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: de::DeserializeOwned")]
#[cfg_attr(not(feature = "homogeneous"), allow(dead_code, reason = "only its presence matters"))]
pub(crate) struct HomogeneousText<D> {
    /// The algebra of G.
    pub of: Part<D>,
    /// A basis of the isotropy algebra.
    pub by: Vec<Text>,
    /// A basis of the complement.
    pub complement: Option<Vec<Text>>,
}

/// How a scalar value is written in the file.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Text,
    Integer,
    Decimal,
}

/// A type of values that can be written in several ways. By default each way is an error, so that a
/// type implements only the ways that it accepts.
trait Form: Sized {
    const EXPECTED: &'static str;

    fn scalar(_: Kind, _: Text) -> Option<Self> {
        None
    }

    fn list<'de, A: SeqAccess<'de>>(_: A) -> Result<Self, A::Error> {
        Err(de::Error::invalid_type(Unexpected::Seq, &Self::EXPECTED))
    }

    fn table<'de, A: MapAccess<'de>>(_: A) -> Result<Self, A::Error> {
        Err(de::Error::invalid_type(Unexpected::Map, &Self::EXPECTED))
    }
}

/// A value before its location is known.
enum Value<F> {
    Scalar(Kind, String),
    Whole(F),
}

/// Deserializes a [`Form`] that is written in any of its ways.
fn read<'de, F: Form, D: Deserializer<'de>>(deserializer: D) -> Result<F, D::Error> {
    let value = Spanned::<Value<F>>::deserialize(deserializer)?;
    let span = value.span();
    match value.into_inner() {
        Value::Whole(form) => Ok(form),
        Value::Scalar(kind, content) => {
            F::scalar(kind, Text { content, span }).ok_or_else(|| de::Error::custom(F::EXPECTED))
        }
    }
}

/// Checks a scalar at once, while the parser still knows its location.
fn scalar<F: Form, E: de::Error>(kind: Kind, content: String) -> Result<Value<F>, E> {
    if F::scalar(kind, Text { content: String::new(), span: 0..0 }).is_some() {
        return Ok(Value::Scalar(kind, content));
    }
    let found = match kind {
        Kind::Text => format!("string {content:?}"),
        Kind::Integer => format!("integer `{content}`"),
        Kind::Decimal => format!("floating point `{content}`"),
    };
    Err(E::invalid_type(Unexpected::Other(&found), &F::EXPECTED))
}

impl<'de, F: Form> Deserialize<'de> for Value<F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Any(PhantomData))
    }
}

struct Any<F>(PhantomData<F>);

impl<'de, F: Form> Visitor<'de> for Any<F> {
    type Value = Value<F>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(F::EXPECTED)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Value<F>, E> {
        scalar(Kind::Text, text.into())
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Value<F>, E> {
        scalar(Kind::Integer, number.to_string())
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Value<F>, E> {
        scalar(Kind::Integer, number.to_string())
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Value<F>, E> {
        scalar(Kind::Decimal, format!("{number:?}"))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Value<F>, A::Error> {
        F::list(items).map(Value::Whole)
    }

    fn visit_map<A: MapAccess<'de>>(self, items: A) -> Result<Value<F>, A::Error> {
        F::table(items).map(Value::Whole)
    }
}

fn all<'de, T: Deserialize<'de>, A: SeqAccess<'de>>(items: A) -> Result<Vec<T>, A::Error> {
    Vec::deserialize(de::value::SeqAccessDeserializer::new(items))
}

impl Form for Text {
    const EXPECTED: &'static str = "a string";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then_some(text)
    }
}

impl Form for Cell {
    const EXPECTED: &'static str = "an integer, or an expression in quotes like \"1/2\"";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind != Kind::Decimal).then_some(Cell(text))
    }
}

impl Form for Row {
    const EXPECTED: &'static str = "[i, j, k, \"v\"]";

    fn list<'de, A: SeqAccess<'de>>(mut items: A) -> Result<Self, A::Error> {
        let short = |length: usize| de::Error::invalid_length(length, &Self::EXPECTED);
        let mut indices = [0; 3];
        for (at, index) in indices.iter_mut().enumerate() {
            *index = items.next_element()?.ok_or_else(|| short(at))?;
        }
        let value = items.next_element()?.ok_or_else(|| short(3))?;
        // reports further items as an error, because some parsers would ignore them
        match items.next_element::<de::IgnoredAny>()? {
            None => Ok(Row(indices, value)),
            Some(_) => Err(short(5)),
        }
    }
}

impl Form for Block {
    const EXPECTED: &'static str =
        "a string with one statement per line, or an array of such strings";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then(|| Block(vec![text]))
    }

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        all(items).map(Block)
    }
}

impl Form for MetricItem {
    const EXPECTED: &'static str = "a row of the metric, or an integer or an expression in quotes";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        Cell::scalar(kind, text).map(MetricItem::Entry)
    }

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        all(items).map(MetricItem::Row)
    }
}

impl Form for MetricText {
    const EXPECTED: &'static str =
        "identity, killing, diag(...), an array of rows, or the list of a diagonal";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then_some(MetricText::Word(text))
    }

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        let (mut rows, mut entries) = (vec![], vec![]);
        for item in all::<MetricItem, A>(items)? {
            match item {
                MetricItem::Row(row) => rows.push(row),
                MetricItem::Entry(entry) => entries.push(entry),
            }
        }
        match (rows.is_empty(), entries.is_empty()) {
            (_, true) => Ok(MetricText::Rows(rows)),
            (true, false) => Ok(MetricText::Diagonal(entries)),
            (false, false) => Err(de::Error::custom("the metric mixes rows and single entries")),
        }
    }

    fn table<'de, A: MapAccess<'de>>(items: A) -> Result<Self, A::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table {
            components: MetricText,
        }
        let table = Table::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(table.components)
    }
}

impl Form for ActionText {
    const EXPECTED: &'static str = "adjoint, coadjoint, or an array of matrices";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then_some(ActionText::Word(text))
    }

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        all(items).map(ActionText::Matrices)
    }
}

impl<D: de::DeserializeOwned> Form for Part<D> {
    const EXPECTED: &'static str =
        "a name of the catalogue, a file, or a table with the keys of a definition";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then_some(Part::Name(text))
    }

    fn table<'de, A: MapAccess<'de>>(items: A) -> Result<Self, A::Error> {
        let document = D::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(Part::Nested(Box::new(document)))
    }
}

impl<T: de::DeserializeOwned> Form for OneOrEach<T> {
    const EXPECTED: &'static str = "a table, or a list of tables";

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        all(items).map(OneOrEach::Each)
    }

    fn table<'de, A: MapAccess<'de>>(items: A) -> Result<Self, A::Error> {
        T::deserialize(de::value::MapAccessDeserializer::new(items)).map(OneOrEach::One)
    }
}

impl Form for ConnectionText {
    const EXPECTED: &'static str = "the name of a connection, or a table with kind or affinities";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then_some(ConnectionText { kind: Some(text), affinities: None })
    }

    fn table<'de, A: MapAccess<'de>>(items: A) -> Result<Self, A::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table {
            kind: Option<Text>,
            affinities: Option<Block>,
        }
        let Table { kind, affinities } =
            Table::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(ConnectionText { kind, affinities })
    }
}

impl Form for Number {
    const EXPECTED: &'static str = "a number, or an expression in quotes like \"pi/2\"";

    fn scalar(_: Kind, text: Text) -> Option<Self> {
        Some(Number(text))
    }
}

impl Form for OneOrMore {
    const EXPECTED: &'static str = "a number, or a list of numbers";

    fn scalar(_: Kind, text: Text) -> Option<Self> {
        Some(OneOrMore(vec![Number(text)]))
    }

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        Ok(OneOrMore(all(items)?))
    }
}

impl Form for VectorText {
    const EXPECTED: &'static str = "a list of numbers, or a table of names and numbers";

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        all(items).map(VectorText::List)
    }

    fn table<'de, A: MapAccess<'de>>(items: A) -> Result<Self, A::Error> {
        Entries::deserialize(de::value::MapAccessDeserializer::new(items)).map(VectorText::Named)
    }
}

impl Form for PointText {
    const EXPECTED: &'static str = "a point, \"centre\" or [x, y, z]";

    fn scalar(kind: Kind, text: Text) -> Option<Self> {
        (kind == Kind::Text).then_some(PointText::Word(text))
    }

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        all(items).map(PointText::Numbers)
    }
}

impl Form for MatrixRows {
    const EXPECTED: &'static str = "an array of rows, or {name, rows}";

    fn list<'de, A: SeqAccess<'de>>(items: A) -> Result<Self, A::Error> {
        Ok(MatrixRows { name: None, rows: all(items)? })
    }

    fn table<'de, A: MapAccess<'de>>(items: A) -> Result<Self, A::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Named {
            name: Option<Text>,
            rows: Vec<Vec<Cell>>,
        }
        let Named { name, rows } =
            Named::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(MatrixRows { name, rows })
    }
}

impl<'de, K: Deserialize<'de>, V: Deserialize<'de>> Deserialize<'de> for Entries<K, V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Each<K, V>(PhantomData<(K, V)>);

        impl<'de, K: Deserialize<'de>, V: Deserialize<'de>> Visitor<'de> for Each<K, V> {
            type Value = Entries<K, V>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a table of names and values, like x = \"1\"")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = items.next_entry()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }
        deserializer.deserialize_map(Each(PhantomData))
    }
}

/// Implements deserialization of each [`Form`] by the function [`read`].
macro_rules! deserialize {
    ($($form:ty),*) => {
        $(impl<'de> Deserialize<'de> for $form {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                read(deserializer)
            }
        })*
    };
}

deserialize!(
    Text,
    Cell,
    Row,
    Block,
    MetricItem,
    MetricText,
    ActionText,
    ConnectionText,
    Number,
    OneOrMore,
    VectorText,
    PointText,
    MatrixRows
);

impl<'de, D: de::DeserializeOwned> Deserialize<'de> for Part<D> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        read(deserializer)
    }
}

impl<'de, O: de::DeserializeOwned> Deserialize<'de> for OneOrEach<O> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        read(deserializer)
    }
}
