//! The Weyl tensor of a spacetime: Petrov type, frame, Newman-Penrose scalars, invariants, and the
//! electric and magnetic parts.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::input::InputError;
use crate::space::Definition;
use affinor::algebra::Complex;
use affinor::geometry::null_tetrad::{NullTetrad, WeylScalars};
use affinor::geometry::petrov::PetrovType;
use affinor::{Connection, Error};
use affinor_tensors::text::combination;
use affinor_tensors::{Symbolic, Tensor, Tolerance};
use num_traits::{One, Zero};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.spacetime/1";
/// The number of characters above which a value is written in JSON only.
const LONGEST: usize = 300;

/// The Weyl tensor of a spacetime in a null tetrad, ready for output.
#[derive(Clone, Debug)]
pub struct Spacetime(Grid);

impl Spacetime {
    /// The Weyl tensor of the metric of a definition. The text `vectors` contains the first vectors
    /// of the frame, separated by commas; see [`NullTetrad::new`].
    ///
    /// # Errors
    /// An error with its location for a text that is not a list of vectors; those of
    /// [`Definition::geometry`] and [`NullTetrad::new`].
    pub fn of(definition: &Definition, vectors: Option<&str>) -> Result<Self, InputError> {
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        let metric = geometry.metric().ok_or_else(|| definition.without_metric())?;
        let given = vectors.map(|text| definition.vector_list("--tetrad", text)).transpose()?;
        let tetrad = NullTetrad::new(
            metric,
            given.as_deref().unwrap_or_default(),
            definition.positive_factors(),
        );
        let advise = |error: Error| {
            let help =
                "the first vector of --tetrad is timelike or null, the others complete a basis";
            let error = InputError::from(error);
            if definition.dimension() == 4 { error.help(help) } else { error }
        };
        let mut tetrad = tetrad.map_err(advise)?;
        let connection = Connection::levi_civita(geometry.frame(), metric)?;
        let scalars = tetrad.weyl_scalars(&connection, metric).map_err(advise)?;
        let kind = connection.petrov(metric)?.map(|petrov| petrov.kind);
        Ok(Self::new(definition, &tetrad, &scalars, kind))
    }

    fn new(
        definition: &Definition,
        tetrad: &NullTetrad,
        scalars: &WeylScalars,
        kind: Option<PetrovType>,
    ) -> Self {
        let mut rows: Vec<Vec<Cell>> = vec![];
        let mut row = |notion: &str, value: &str, remark: &str| {
            let value = match value.chars().count() {
                0..=LONGEST => value,
                _ => "in --format json",
            };
            rows.push(vec![notion.into(), value.into(), remark.into()]);
        };
        let kind = kind.map(|kind| kind.to_string());
        row("Petrov type", kind.as_deref().unwrap_or("-"), "at generic points");
        for (name, vector, norm) in named_vectors(tetrad) {
            row(name, &written(definition, vector, norm), "");
        }
        row("tetrad", "", tetrad_in_words(tetrad));
        for (at, psi) in scalars.psi.iter().enumerate() {
            row(&format!("Psi{at}"), &complex(psi), PSI[at]);
        }
        row("I", &complex(&scalars.quadratic), "Psi0 Psi4 - 4 Psi1 Psi3 + 3 Psi2^2");
        row("J", &complex(&scalars.cubic), "determinant of Psi_(i+j)");
        for ((letter, formula), part) in PARTS.iter().zip(scalars.parts.iter().flatten()) {
            let entries = (0..3).flat_map(|i| (i..3).map(move |j| (i, j)));
            let entries = entries.filter(|(i, j)| !part[*i][*j].is_zero());
            let entries: Vec<String> = entries
                .map(|(i, j)| format!("{letter}_{}{} = {}", i + 2, j + 2, part[i][j]))
                .collect();
            let text = if entries.is_empty() { "0".into() } else { entries.join("\n") };
            let name = if *letter == "E" { "electric part" } else { "magnetic part" };
            row(name, &text, formula);
        }
        let [plus, minus] = tetrad.signature();
        row("signature", &format!("({plus}, {minus})"), "positive and negative squares");
        let assumed: Vec<String> = tetrad.assumed().iter().map(Symbolic::to_string).collect();
        if !assumed.is_empty() {
            row("assumed positive", &assumed.join(", "), "in the roots of the frame");
        }
        let title = format!("Weyl tensor of {}", printable(&definition.name));
        let head = vec![("basis", printable_list(&definition.labels).into())];
        let json = document(definition, tetrad, scalars, kind.as_deref(), &assumed);
        let grid = Grid::new(title, &["notion", "value", "remark"], rows, json);
        Spacetime(grid.with_head(head))
    }
}

/// The definitions of the scalars.
const PSI: [&str; 5] = ["W(l,m,l,m)", "W(l,n,l,m)", "W(l,m,m*,n)", "W(l,n,m*,n)", "W(n,m*,n,m*)"];
/// The letters of the parts of the Weyl tensor, and their definitions.
const PARTS: [(&str, &str); 2] =
    [("E", "E_ij = W(e_i,e1,e_j,e1)"), ("B", "B_ij = 1/2 eps_ikl W(e_k,e_l,e1,e_j)")];

fn tetrad_in_words(tetrad: &NullTetrad) -> &'static str {
    match tetrad.is_orthonormal() {
        true => "l, n = (e1 +- e2)/sqrt(2), m = (e3 + i e4)/sqrt(2)",
        false => "g(l,n) = -1 in signature (3,1), m = (e3 + i e4)/sqrt(2)",
    }
}

/// The vectors of the tetrad, with their names and the squares of their lengths.
fn named_vectors(
    tetrad: &NullTetrad,
) -> impl Iterator<Item = (&'static str, &Tensor<Symbolic>, &Symbolic)> {
    let names = match tetrad.is_orthonormal() {
        true => ["e1", "e2", "e3", "e4"],
        false => ["l", "n", "e3", "e4"],
    };
    names
        .into_iter()
        .zip(tetrad.vectors())
        .zip(tetrad.norms())
        .map(|((name, v), norm)| (name, v, norm))
}

/// A vector divided by its length.
fn written(definition: &Definition, vector: &Tensor<Symbolic>, norm: &Symbolic) -> String {
    let label = |at: usize| printable(&definition.labels[at]);
    let text =
        combination(vector.components().map(|(at, value)| (value.to_string(), label(at[0]))));
    let single = vector.len() == 1;
    match (norm.is_one(), single) {
        (true, _) => text,
        (false, true) => format!("{text}/sqrt({norm})"),
        (false, false) => format!("({text})/sqrt({norm})"),
    }
}

/// A complex number in the form `a + i*b`.
fn complex(value: &Complex<Symbolic>) -> String {
    let imaginary = || {
        let text = value.im.to_string();
        let simple = !text.contains(' ');
        match text.strip_prefix('-') {
            Some("1") => "-i".to_string(),
            Some(rest) if simple => format!("-i*{rest}"),
            _ if text == "1" => "i".into(),
            _ if simple => format!("i*{text}"),
            _ => format!("i*({text})"),
        }
    };
    match (value.re.is_zero(), value.im.is_zero()) {
        (_, true) => value.re.to_string(),
        (true, false) => imaginary(),
        (false, false) => match imaginary() {
            text if text.starts_with('-') => format!("{} - {}", value.re, &text[1..]),
            text => format!("{} + {text}", value.re),
        },
    }
}

/// The report in JSON.
fn document(
    definition: &Definition,
    tetrad: &NullTetrad,
    scalars: &WeylScalars,
    kind: Option<&str>,
    assumed: &[String],
) -> Value {
    let pair = |value: &Complex<Symbolic>| json!([value.re.to_string(), value.im.to_string()]);
    let vectors = named_vectors(tetrad).map(|(name, vector, norm)| {
        let components: Vec<String> = (0..4).map(|i| vector.get(&[i]).to_string()).collect();
        json!({ "name": name, "components": components, "norm": norm.to_string() })
    });
    let part = |at: usize| {
        scalars.parts.as_ref().map(|parts| {
            let rows = parts[at].iter();
            rows.map(|row| row.iter().map(Symbolic::to_string).collect()).collect::<Vec<Vec<_>>>()
        })
    };
    json!({
        "schema": SCHEMA,
        "name": definition.name,
        "signature": tetrad.signature(),
        "petrov": kind,
        "vectors": vectors.collect::<Vec<_>>(),
        "psi": scalars.psi.iter().map(pair).collect::<Vec<_>>(),
        "I": pair(&scalars.quadratic),
        "J": pair(&scalars.cubic),
        "electric": part(0),
        "magnetic": part(1),
        "assumed_positive": assumed,
    })
}

impl Report for Spacetime {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
