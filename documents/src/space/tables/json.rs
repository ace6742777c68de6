//! Structure constants in a JSON table with the schema `affinor.table/1`, as `affinor table
//! --format json` writes it.

use super::{add_constant, number, of_brackets};
use crate::input::forms::{Entries, Number, Text};
use crate::input::{InputError, Source, parse_keys};
use crate::space::notation::{Names, basis};
use crate::space::{Definition, Pairs};
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// The schema of a JSON table.
const SCHEMA: &str = "affinor.table/1";

/// Whether a text is a JSON object that contains a schema. Definition files contain no schema.
pub(super) fn is_table(text: &str) -> bool {
    text.trim_start().starts_with('{') && text.contains("\"schema\"")
}

/// The keys of a table that are used to define the algebra.
#[derive(serde::Deserialize)]
struct Table {
    schema: Text,
    name: Option<Text>,
    algebra: Option<Algebra>,
    chart: Option<IgnoredAny>,
    homogeneous: Option<IgnoredAny>,
    conventions: Option<Conventions>,
    #[serde(rename = "where")]
    factors: Option<Entries<String, Text>>,
    tensors: Option<Entries<String, Components>>,
}

#[derive(serde::Deserialize)]
struct Algebra {
    basis: Vec<Text>,
}

#[derive(serde::Deserialize)]
struct Conventions {
    frame: Option<Text>,
}

#[derive(serde::Deserialize)]
struct Components {
    components: Vec<(Vec<i64>, Number)>,
}

/// Reads the algebra from a table.
pub(super) fn definition(source: &Source) -> Result<Definition, InputError> {
    let (table, source) = parse_keys::<Table>(source, "")?;
    if &*table.schema != SCHEMA {
        let message = format!("a report {} is not a table", &*table.schema);
        let help = format!("a space can be read from {SCHEMA}, written by `affinor table`");
        return Err(source.refused("schema", message).help(help));
    }
    if table.homogeneous.is_some() {
        let message = "a space cannot be read from a table of a homogeneous space";
        return Err(source.refused("homogeneous", message).help("give the name of the space"));
    }
    if table.chart.is_some() {
        return Err(source
            .refused("chart", "a space cannot be read from a table over a chart")
            .help("give the definition file of the space"));
    }
    let frame = table.conventions.and_then(|conventions| conventions.frame);
    if let Some(frame) = frame.filter(|frame| &**frame != "left-invariant") {
        let message = format!("the components are in the {} frame", &*frame);
        return Err(InputError::usage(message)
            .at(&source.at(&frame))
            .help("write the table with --frame left"));
    }
    let Some(Algebra { basis: texts }) = table.algebra else {
        return Err(source.refused("schema", "the key `algebra` is missing"));
    };
    let names: Vec<&str> = texts.iter().map(|text| &**text).collect();
    basis(&names, &|at| source.at(&texts[at]))?;
    let labels: Vec<String> = names.iter().map(|name| name.to_string()).collect();
    let Entries(tensors) = table.tensors.unwrap_or(Entries(vec![]));
    let others = tensors.len() > 1;
    let structure = tensors.into_iter().find(|(name, _)| name == "structure");
    let Some((_, Components { components })) = structure else {
        return Err(source
            .refused("tensors", "the table has no tensor `structure`")
            .help("write it with --show structure"));
    };
    let n = labels.len();
    let (none, mut given) = (BTreeMap::new(), Pairs::new());
    let names = Names::open(&none, None);
    for (at, Number(text)) in &components {
        let place = source.at(text);
        let refused = |reason: String| InputError::usage(reason).at(&place);
        let [i, j, k] = at[..] else {
            return Err(refused(format!("a structure constant has 3 indices, not {}", at.len())));
        };
        let index = |at: i64| number(&at.to_string(), n).map_err(refused);
        let source = source.excerpt(text);
        let at = [index(i)?, index(j)?, index(k)?];
        let value = names.scalar(source.content(), &source)?;
        add_constant(&mut given, at, value, &place);
    }
    let mut definition = of_brackets(&source, labels, given);
    if let Some(name) = &table.name {
        definition.name = name.to_string();
    }
    if let Some(Entries(factors)) = &table.factors {
        let known = definition.parameters();
        let used = factors.iter().filter(|(name, _)| known.contains(name));
        let value = |(name, text): &(String, Text)| {
            let source = source.excerpt(text);
            Ok((name.clone(), names.scalar(source.content(), &source)?))
        };
        let values = used.map(value).collect::<Result<_, InputError>>()?;
        definition.set(&values)?;
    }
    if others {
        definition.notes.push("only the structure constants of the table are read".into());
    }
    Ok(definition)
}
