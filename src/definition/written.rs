//! The values of a definition file as they are written, in TOML or JSON.

use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// A string: a piece of the file, or a copy where it has escapes.
#[derive(Clone)]
pub(super) struct Text<'t>(pub Cow<'t, str>);

/// A value: an expression in a string, or an integer.
pub(super) struct Cell<'t>(pub Text<'t>);

/// A structure constant `[i, j, k, "v"]`.
pub(super) struct Row<'t>(pub [i64; 3], pub Cell<'t>);

/// A block of statements: one string with a line each, or an array of such strings.
pub(super) struct Block<'t>(pub Vec<Text<'t>>);

/// A metric in words, or its rows; either may stand in a table as its `components`.
pub(super) enum MetricText<'t> {
    Word(Text<'t>),
    Rows(Vec<Vec<Cell<'t>>>),
}

/// A connection by name, or a table with its `kind` or its `affinities`.
pub(super) struct ConnectionText<'t> {
    pub kind: Option<Text<'t>>,
    pub affinities: Option<Block<'t>>,
}

/// Coordinates.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ChartText<'t> {
    #[serde(borrow)]
    pub coordinates: Vec<Text<'t>>,
}

/// Fields by their names, in order.
pub(super) struct FieldsText<'t>(pub Vec<(Text<'t>, Text<'t>)>);

/// A number: an expression in a string, an integer, or a decimal.
#[derive(Clone)]
pub(super) struct Number<'t>(pub Text<'t>);

/// A number, or a list of them.
pub(super) struct OneOrMore<'t>(pub Vec<Number<'t>>);

/// Numbers by their names, in order.
pub(super) struct NumbersText<'t>(pub Vec<(Text<'t>, Number<'t>)>);

/// Texts by their names, in order.
pub(super) struct TextsText<'t>(pub Vec<(Text<'t>, Text<'t>)>);

/// A matrix: `{name, rows}`, or its rows alone.
pub(super) struct MatrixRows<'t> {
    pub name: Option<Text<'t>>,
    pub rows: Vec<Vec<Cell<'t>>>,
}

/// What may stand in the place of a value; each form refuses what it does not override.
trait Form<'t>: Sized {
    const EXPECTED: &'static str;

    fn text(text: Text<'t>) -> Option<Self> {
        let _ = text;
        None
    }

    fn integer(digits: String) -> Option<Self> {
        let _ = digits;
        None
    }

    fn decimal(digits: String) -> Option<Self> {
        let _ = digits;
        None
    }

    fn list<A: SeqAccess<'t>>(items: A) -> Result<Self, A::Error> {
        let _ = items;
        Err(de::Error::invalid_type(de::Unexpected::Seq, &Self::EXPECTED))
    }

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        let _ = items;
        Err(de::Error::invalid_type(de::Unexpected::Map, &Self::EXPECTED))
    }
}

/// Reads a [`Form`], whatever stands there.
struct Any<F>(PhantomData<F>);

fn read<'t, F: Form<'t>, D: Deserializer<'t>>(deserializer: D) -> Result<F, D::Error> {
    deserializer.deserialize_any(Any(PhantomData))
}

impl<'t, F: Form<'t>> Visitor<'t> for Any<F> {
    type Value = F;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(F::EXPECTED)
    }

    fn visit_borrowed_str<E: de::Error>(self, text: &'t str) -> Result<F, E> {
        let form = F::text(Text(Cow::Borrowed(text)));
        form.ok_or_else(|| E::invalid_type(de::Unexpected::Str(text), &self))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<F, E> {
        let form = F::text(Text(Cow::Owned(text.into())));
        form.ok_or_else(|| E::invalid_type(de::Unexpected::Str(text), &self))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<F, E> {
        let form = F::integer(number.to_string());
        form.ok_or_else(|| E::invalid_type(de::Unexpected::Signed(number), &self))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<F, E> {
        let form = F::integer(number.to_string());
        form.ok_or_else(|| E::invalid_type(de::Unexpected::Unsigned(number), &self))
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<F, E> {
        let form = F::decimal(format!("{number:?}"));
        form.ok_or_else(|| E::invalid_type(de::Unexpected::Float(number), &self))
    }

    fn visit_seq<A: SeqAccess<'t>>(self, items: A) -> Result<F, A::Error> {
        F::list(items)
    }

    fn visit_map<A: MapAccess<'t>>(self, items: A) -> Result<F, A::Error> {
        F::table(items)
    }
}

fn all<'t, T: Deserialize<'t>, A: SeqAccess<'t>>(items: A) -> Result<Vec<T>, A::Error> {
    Vec::deserialize(de::value::SeqAccessDeserializer::new(items))
}

impl<'t> Form<'t> for Text<'t> {
    const EXPECTED: &'static str = "a string";

    fn text(text: Text<'t>) -> Option<Self> {
        Some(text)
    }
}

impl<'t> Form<'t> for Cell<'t> {
    const EXPECTED: &'static str = "an integer, or an expression in quotes like \"1/2\"";

    fn text(text: Text<'t>) -> Option<Self> {
        Some(Cell(text))
    }

    fn integer(digits: String) -> Option<Self> {
        Some(Cell(Text(Cow::Owned(digits))))
    }
}

impl<'t> Form<'t> for Row<'t> {
    const EXPECTED: &'static str = "[i, j, k, \"v\"]";

    fn list<A: SeqAccess<'t>>(mut items: A) -> Result<Self, A::Error> {
        let short = |length: usize| de::Error::invalid_length(length, &Self::EXPECTED);
        let mut indices = [0; 3];
        for (at, index) in indices.iter_mut().enumerate() {
            *index = items.next_element()?.ok_or_else(|| short(at))?;
        }
        let value = items.next_element()?.ok_or_else(|| short(3))?;
        // a parser may not mind what is left
        match items.next_element::<de::IgnoredAny>()? {
            None => Ok(Row(indices, value)),
            Some(_) => Err(short(5)),
        }
    }
}

impl<'t> Form<'t> for Block<'t> {
    const EXPECTED: &'static str =
        "a string with one statement a line, or an array of such strings";

    fn text(text: Text<'t>) -> Option<Self> {
        Some(Block(vec![text]))
    }

    fn list<A: SeqAccess<'t>>(items: A) -> Result<Self, A::Error> {
        all(items).map(Block)
    }
}

impl<'t> Form<'t> for MetricText<'t> {
    const EXPECTED: &'static str = "identity, killing, diag(...), or an array of rows";

    fn text(text: Text<'t>) -> Option<Self> {
        Some(MetricText::Word(text))
    }

    fn list<A: SeqAccess<'t>>(items: A) -> Result<Self, A::Error> {
        all(items).map(MetricText::Rows)
    }

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table<'t> {
            #[serde(borrow)]
            components: MetricText<'t>,
        }
        let table = Table::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(table.components)
    }
}

impl<'t> Form<'t> for ConnectionText<'t> {
    const EXPECTED: &'static str = "the name of a connection, or a table with kind or affinities";

    fn text(text: Text<'t>) -> Option<Self> {
        Some(ConnectionText { kind: Some(text), affinities: None })
    }

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Table<'t> {
            #[serde(borrow)]
            kind: Option<Text<'t>>,
            #[serde(borrow)]
            affinities: Option<Block<'t>>,
        }
        let Table { kind, affinities } =
            Table::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(ConnectionText { kind, affinities })
    }
}

/// Names and values in order.
fn named<'t, T: Deserialize<'t>, A: MapAccess<'t>>(
    mut items: A,
) -> Result<Vec<(Text<'t>, T)>, A::Error> {
    let mut all: Vec<(Text, T)> = Vec::new();
    while let Some((name, value)) = items.next_entry::<Text, T>()? {
        if all.iter().any(|(other, _)| other.0 == name.0) {
            return Err(de::Error::custom(format_args!("duplicate key `{}`", name.0)));
        }
        all.push((name, value));
    }
    Ok(all)
}

impl<'t> Form<'t> for FieldsText<'t> {
    const EXPECTED: &'static str = "a table of fields, like e1 = \"d_x\"";

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        named(items).map(FieldsText)
    }
}

impl<'t> Form<'t> for TextsText<'t> {
    const EXPECTED: &'static str = "a table of formulas, like k = \"H1^2\"";

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        named(items).map(TextsText)
    }
}

impl<'t> Form<'t> for NumbersText<'t> {
    const EXPECTED: &'static str = "a table of numbers, like m = 15";

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        named(items).map(NumbersText)
    }
}

impl<'t> Form<'t> for Number<'t> {
    const EXPECTED: &'static str = "a number, or an expression in quotes like \"pi/2\"";

    fn text(text: Text<'t>) -> Option<Self> {
        Some(Number(text))
    }

    fn integer(digits: String) -> Option<Self> {
        Some(Number(Text(Cow::Owned(digits))))
    }

    fn decimal(digits: String) -> Option<Self> {
        Some(Number(Text(Cow::Owned(digits))))
    }
}

impl<'t> Form<'t> for OneOrMore<'t> {
    const EXPECTED: &'static str = "a number, or a list of numbers";

    fn text(text: Text<'t>) -> Option<Self> {
        Number::text(text).map(|number| OneOrMore(vec![number]))
    }

    fn integer(digits: String) -> Option<Self> {
        Number::integer(digits).map(|number| OneOrMore(vec![number]))
    }

    fn decimal(digits: String) -> Option<Self> {
        Number::decimal(digits).map(|number| OneOrMore(vec![number]))
    }

    fn list<A: SeqAccess<'t>>(items: A) -> Result<Self, A::Error> {
        Ok(OneOrMore(all(items)?))
    }
}

impl<'t> Form<'t> for MatrixRows<'t> {
    const EXPECTED: &'static str = "an array of rows, or {name, rows}";

    fn list<A: SeqAccess<'t>>(items: A) -> Result<Self, A::Error> {
        Ok(MatrixRows { name: None, rows: all(items)? })
    }

    fn table<A: MapAccess<'t>>(items: A) -> Result<Self, A::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Named<'t> {
            #[serde(borrow)]
            name: Option<Text<'t>>,
            #[serde(borrow)]
            rows: Vec<Vec<Cell<'t>>>,
        }
        let Named { name, rows } =
            Named::deserialize(de::value::MapAccessDeserializer::new(items))?;
        Ok(MatrixRows { name, rows })
    }
}

impl<'de: 't, 't> Deserialize<'de> for Text<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for Cell<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for Row<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for Block<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for MetricText<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for ConnectionText<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for FieldsText<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for TextsText<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for NumbersText<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for Number<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for OneOrMore<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}

impl<'de: 't, 't> Deserialize<'de> for MatrixRows<'t> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read(deserializer)
    }
}
