//! The structure of a homogeneous space: isotropy summands, invariant tensors and forms.

use super::{Cell, Coefficients, Grid, Info, printable, printable_list};
use crate::input::InputError;
#[cfg(feature = "modules")]
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::geometry::homogeneous::HomogeneousSpace;
use affinor::geometry::reductive::{IsotropyComponent, MAX_FORMS, RealType};
use affinor_tensors::text::combination;
use affinor_tensors::{Down, Rational, Up};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The name of the schema.
const SCHEMA: &str = "affinor.homogeneous/1";
/// The largest dimensions of spaces whose isotropy summands, and whose invariant connections, are
/// computed.
const DECOMPOSED: usize = 40;
const CONNECTIONS: usize = 12;

impl Info {
    /// Computes the structure of a homogeneous space; `algebra` is the name of the algebra of G, and
    /// `stage` is called before each part. With coefficients, the relative cohomology is added.
    ///
    /// # Errors
    /// An error of usage for coefficients by matrices, or for too many cochains.
    pub fn of_homogeneous(
        space: &HomogeneousSpace<Rational>,
        algebra: &str,
        coefficients: &Coefficients,
        stage: &dyn Fn(&str),
    ) -> Result<Self, InputError> {
        let (pair, labels) = (space.pair(), space.pair().frame().labels());
        let r = pair.dimension();
        let mut report = Rows::default();
        let dimensions = [pair.algebra().dimension(), pair.isotropy().len()];
        report.row("algebra of G", algebra, &format!("dimension {}", dimensions[0]));
        let isotropy = format!("dimension {}", dimensions[1]);
        report.row("isotropy algebra", &isotropy, space.embedding());
        report
            .json
            .insert("algebra".into(), json!({ "name": algebra, "dimension": dimensions[0] }));
        report.json.insert("isotropy".into(), json!(dimensions[1]));
        report.json.insert("embedding".into(), space.embedding().into());
        report.json.insert("complement".into(), json!(space.complement()));

        stage("isotropy summands");
        let components = match r {
            0..=DECOMPOSED => Some(pair.isotropy_components()?),
            _ => None,
        };
        report.summands(components.as_deref(), labels);

        stage("rank");
        let rank = pair.rank()?;
        let symmetric = if pair.is_symmetric() { "yes" } else { "no" };
        report.row("symmetric", symmetric, "h contains [m,m]");
        if let Some(rank) = rank {
            let why = "the dimension of a maximal abelian subspace of m";
            report.row("rank", &rank.to_string(), why);
        }
        report.json.insert("symmetric".into(), pair.is_symmetric().into());
        report.json.insert("rank".into(), json!(rank));

        stage("invariant tensors");
        let counted = |components: &[IsotropyComponent]| {
            let each = components.iter().map(IsotropyComponent::metrics);
            each.sum::<Option<usize>>()
        };
        let metrics = match components.as_deref().and_then(counted) {
            None if r <= DECOMPOSED => Some(pair.invariant_forms()?.len()),
            known => known,
        };
        let connections = match r {
            0..=CONNECTIONS => Some(pair.invariant_tensors(&[Up, Down, Down])?.len()),
            _ => None,
        };
        let why = "parameters of the general metric, --metric invariant";
        report.count("invariant metrics", "invariant_metrics", metrics, why, DECOMPOSED);
        let why = "parameters of the general connection";
        report.count(
            "invariant connections",
            "invariant_connections",
            connections,
            why,
            CONNECTIONS,
        );

        stage("forms");
        let forms = pair.differential_forms()?;
        let listed =
            |numbers: &[usize]| numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        match &forms {
            Some(forms) => {
                let why = "dimensions by degree";
                report.row("invariant forms", &listed(&forms.dimensions), why);
                let why =
                    "of G/H if G is compact and H connected: the cohomology of invariant forms";
                report.row("Betti numbers", &listed(&forms.betti), why);
                let characteristic = forms.euler_characteristic().to_string();
                report.row("Euler characteristic", &characteristic, "the alternating sum");
            }
            None => {
                let why = format!("not computed beyond dimension {MAX_FORMS}");
                report.row("invariant forms", "-", &why);
            }
        }
        let dimensions = forms.as_ref().map(|forms| &forms.dimensions);
        report.json.insert("invariant_forms".into(), json!(dimensions));
        report.json.insert("betti".into(), json!(forms.as_ref().map(|forms| &forms.betti)));
        #[cfg(feature = "modules")]
        report.cohomology(space, coefficients)?;
        #[cfg(not(feature = "modules"))]
        debug_assert!(*coefficients == Coefficients::Trivial, "the feature `modules` is missing");
        let characteristic = forms.as_ref().map(|forms| forms.euler_characteristic());
        report.json.insert("euler_characteristic".into(), json!(characteristic));
        Ok(report.finish(space))
    }
}

/// The rows and the keys of the report.
#[derive(Default)]
struct Rows {
    rows: Vec<Vec<Cell>>,
    json: Map<String, Value>,
}

impl Rows {
    fn row(&mut self, notion: &str, answer: &str, witness: &str) {
        self.rows.push(vec![notion.into(), Cell::prose(&printable(answer)), Cell::prose(witness)]);
    }

    /// Adds a number, or the largest dimension at which it is computed.
    fn count(&mut self, notion: &str, key: &str, count: Option<usize>, why: &str, limit: usize) {
        match count {
            Some(count) => self.row(notion, &count.to_string(), why),
            None => self.row(notion, "-", &format!("not computed beyond dimension {limit}")),
        }
        self.json.insert(key.into(), json!(count));
    }

    fn summands(&mut self, components: Option<&[IsotropyComponent]>, labels: &[String]) {
        for (at, component) in components.into_iter().flatten().enumerate() {
            let dimension = component.subspace.dimension();
            let answer = match component.summands {
                Some((1, of)) => format!("dimension {dimension}, {}", type_name(of)),
                Some((count, of)) => {
                    let each = dimension / count;
                    format!("{count} equivalent of dimension {each}, {}", type_name(of))
                }
                None => format!("dimension {dimension}, irreducible over the rational numbers"),
            };
            self.row(&format!("isotropy summand {}", at + 1), &answer, &span(component, labels));
        }
        if components.is_none() {
            let why = format!("not computed beyond dimension {DECOMPOSED}");
            self.row("isotropy summands", "-", &why);
        }
        let summand = |component: &IsotropyComponent| {
            let dimension = component.subspace.dimension();
            let vectors = component.subspace.dense();
            let basis: Vec<Vec<String>> =
                vectors.iter().map(|x| x.iter().map(Rational::to_string).collect()).collect();
            json!({
                "dimension": dimension,
                "multiplicity": component.summands.map(|(count, _)| count),
                "type": component.summands.map(|(_, of)| type_word(of)),
                "basis": basis,
            })
        };
        let summands = components.map(|all| all.iter().map(summand).collect::<Vec<_>>());
        self.json.insert("summands".into(), json!(summands));
    }

    /// Adds the cohomology of the algebra of G relative to the isotropy algebra, unless the coefficients
    /// are trivial.
    #[cfg(feature = "modules")]
    fn cohomology(
        &mut self,
        space: &HomogeneousSpace<Rational>,
        coefficients: &Coefficients,
    ) -> Result<(), InputError> {
        match coefficients {
            Coefficients::Trivial => return Ok(()),
            Coefficients::Matrices(_) => {
                let error = "coefficients by matrices are accepted only for an algebra";
                return Err(InputError::usage(error).help("write adjoint or coadjoint"));
            }
            Coefficients::Adjoint | Coefficients::Coadjoint => {}
        }
        let (algebra, r) = (space.pair().algebra(), space.pair().dimension());
        let n = algebra.dimension();
        let module = coefficients.module(algebra)?;
        let isotropy = Subspace::span(n, (r..n).map(|at| vec![(at, Rational::from(1))]));
        let found =
            StructureTheory::new(algebra.clone()).relative_cohomology(&isotropy, &module)?;
        let text: Vec<String> = found.betti.iter().map(usize::to_string).collect();
        let why = format!("relative to the isotropy algebra, with a module of dimension {n}");
        let title = format!("cohomology, {} coefficients", coefficients.name());
        self.row(&title, &text.join(", "), &why);
        let value = json!({
            "coefficients": coefficients.name(),
            "dimension": n,
            "cochains": found.cochains,
            "numbers": found.betti,
            "proved": true,
        });
        self.json.insert("cohomology".into(), value);
        Ok(())
    }

    fn finish(self, space: &HomogeneousSpace<Rational>) -> Info {
        let (r, labels) = (space.pair().dimension(), space.pair().frame().labels());
        let mut json = Map::new();
        json.insert("schema".into(), SCHEMA.into());
        json.insert("name".into(), space.name().into());
        json.insert("dimension".into(), r.into());
        json.insert("basis".into(), json!(labels));
        json.extend(self.json);
        let equal = labels.iter().zip(space.complement()).map(|(e, x)| format!("{e} = {x}"));
        let head: Vec<(&str, Cell)> = vec![
            ("dimension", r.to_string().into()),
            ("basis", Cell::prose(&printable_list(labels))),
            ("complement", Cell::prose(&printable_list(&equal.collect::<Vec<_>>()))),
        ];
        let title = format!("Structure of {}", printable(space.name()));
        let header = ["notion", "answer", "witness"];
        let grid = Grid::new(title, &header, self.rows, Value::Null).with_head(head);
        Info { grid, json, matrices: BTreeMap::new() }
    }
}

/// The basis vectors of a component.
fn span(component: &IsotropyComponent, labels: &[String]) -> String {
    let vectors = component
        .subspace
        .basis()
        .iter()
        .map(|row| combination(row.iter().map(|(at, value)| (value, printable(&labels[*at])))));
    vectors.collect::<Vec<_>>().join(", ")
}

fn type_word(of: RealType) -> &'static str {
    match of {
        RealType::Real => "real",
        RealType::Complex => "complex",
        RealType::Quaternionic => "quaternionic",
    }
}

fn type_name(of: RealType) -> String {
    format!("{} type", type_word(of))
}
