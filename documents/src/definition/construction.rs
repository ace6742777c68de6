//! Algebras built from others: the keys `sum`, `semidirect`, `subalgebra`, `quotient` and their like.

use super::document::Document;
use super::input::InputError;
use super::notation::{Names, lines, statement};
use super::source::{Place, Source};
use super::written::{ActionText, Block, Cell, MatrixRows, Part, Text};
use super::{Definition, Reading, space};
use affinor::algebra::structure::{Structure, Subspace};
use affinor::{BasisChange, LieAlgebra};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Ring, Symbolic, Tensor, Tolerance, Up};
use std::collections::{BTreeMap, BTreeSet};

/// The key of a construction and its parts.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Semidirect {
    of: Part<Document>,
    on: Option<Part<Document>>,
    by: ActionText,
}

/// A subalgebra by a basis, or by generators.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Subalgebra {
    of: Part<Document>,
    spanned_by: Option<Vec<Text>>,
    generated_by: Option<Vec<Text>>,
    centralizer_of: Option<Vec<Text>>,
}

/// A quotient by the span of vectors.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Quotient {
    of: Part<Document>,
    by: Vec<Text>,
}

/// A central extension by new vectors, with the cocycle as brackets.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Extension {
    of: Part<Document>,
    centre: Vec<Text>,
    cocycle: Block,
}

/// A contraction by the weights of the basis vectors.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Contraction {
    of: Part<Document>,
    weights: Vec<i64>,
}

/// The algebra in another basis.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OtherBasis {
    of: Part<Document>,
    vectors: Vec<Text>,
}

/// Truncated polynomials with values in an algebra.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Truncated {
    of: Part<Document>,
    order: usize,
}

type Algebra = LieAlgebra<Symbolic>;

impl Document {
    /// The algebra that a construction of the file builds, if it has one.
    pub(super) fn constructed(&self, source: &Source) -> Result<Option<Algebra>, InputError> {
        let keys = [
            ("sum", self.sum.is_some()),
            ("semidirect", self.semidirect.is_some()),
            ("subalgebra", self.subalgebra.is_some()),
            ("quotient", self.quotient.is_some()),
            ("central_extension", self.central_extension.is_some()),
            ("contraction", self.contraction.is_some()),
            ("change_of_basis", self.change_of_basis.is_some()),
            ("truncated", self.truncated.is_some()),
            ("complexification", self.complexification.is_some()),
        ];
        let given: Vec<&str> = keys.iter().filter(|(_, is)| *is).map(|(key, _)| *key).collect();
        let Some(key) = given.first() else { return Ok(None) };
        let others = self.brackets.is_some()
            || self.structure_constants.is_some()
            || self.matrices.is_some()
            || self.chart.is_some();
        if given.len() > 1 || others || self.dimension.is_some() {
            let message =
                format!("`{key}` defines the algebra: give no other brackets and no dimension");
            return Err(source.refused(key, message));
        }
        let declared = self.parameter_names();
        let site = Site { source, place: source.key(key), declared };
        site.build(self).map(Some)
    }
}

/// The file, the place of the key, and the declared parameters.
struct Site<'s> {
    source: &'s Source,
    place: Place,
    declared: BTreeSet<String>,
}

impl Site<'_> {
    fn build(&self, file: &Document) -> Result<Algebra, InputError> {
        let built = if let Some(summands) = &file.sum {
            let mut parts = summands
                .iter()
                .enumerate()
                .map(|(at, part)| self.algebra(part, &format!("sum.{at}")));
            let first = parts.next().unwrap_or_else(|| Err(self.refuse("a sum has summands")))?;
            return parts.try_fold(first, |sum, next| self.placed(sum.direct_sum(&next?)));
        } else if let Some(of) = &file.complexification {
            self.structure(of, "complexification")?.complexified()
        } else if let Some(Truncated { of, order }) = &file.truncated {
            if !(1..=64).contains(order) {
                return Err(self.refuse("the order of truncation is not between 1 and 64"));
            }
            self.structure(of, "truncated.of")?.truncated(*order)
        } else if let Some(Contraction { of, weights }) = &file.contraction {
            self.structure(of, "contraction.of")?.contraction(weights)
        } else if let Some(Quotient { of, by }) = &file.quotient {
            let structure = self.structure(of, "quotient.of")?;
            let ideal = Subspace::span(structure.dimension(), self.vectors(&structure, by)?);
            if ideal.dimension() == structure.dimension() {
                return Err(self.refuse("the quotient by the whole algebra is zero"));
            }
            structure.quotient(&ideal)
        } else if let Some(OtherBasis { of, vectors }) = &file.change_of_basis {
            let structure = self.structure(of, "change_of_basis.of")?;
            let rows = self.vectors(&structure, vectors)?;
            if rows.len() != structure.dimension() {
                let message =
                    format!("{} vectors for dimension {}", rows.len(), structure.dimension());
                return Err(self.refuse(&message));
            }
            return self.in_basis(structure.algebra(), &rows);
        } else if let Some(subalgebra) = &file.subalgebra {
            return self.subalgebra(subalgebra);
        } else if let Some(extension) = &file.central_extension {
            return self.extension(extension);
        } else if let Some(semidirect) = &file.semidirect {
            return self.semidirect(semidirect);
        } else {
            return Err(self.refuse("a construction is missing"));
        };
        self.placed(built)
    }

    fn subalgebra(&self, given: &Subalgebra) -> Result<Algebra, InputError> {
        let structure = self.structure(&given.of, "subalgebra.of")?;
        let n = structure.dimension();
        let parts = (&given.spanned_by, &given.generated_by, &given.centralizer_of);
        let (subspace, basis) = match parts {
            (Some(texts), None, None) => {
                let rows = self.vectors(&structure, texts)?;
                (Subspace::span(n, rows.clone()), Some(rows))
            }
            (None, Some(texts), None) => {
                (structure.generated(self.vectors(&structure, texts)?), None)
            }
            (None, None, Some(texts)) => {
                let span = Subspace::span(n, self.vectors(&structure, texts)?);
                (structure.centralizer(&span), None)
            }
            _ => {
                let message = "give one of spanned_by, generated_by, centralizer_of";
                return Err(self.refuse(message));
            }
        };
        if subspace.is_zero() {
            return Err(self.refuse("the subalgebra is zero"));
        }
        let inside = self.placed(structure.subalgebra(&subspace))?;
        let Some(rows) = basis else { return Ok(inside.algebra().clone()) };
        let coordinates =
            rows.iter().filter_map(|row| subspace.coordinates(row)).collect::<Vec<_>>();
        self.in_basis(inside.algebra(), &coordinates)
    }

    /// The algebra in the basis of these vectors.
    fn in_basis(&self, algebra: &Algebra, rows: &[Row<Symbolic>]) -> Result<Algebra, InputError> {
        let n = algebra.dimension();
        if rows.len() != n {
            return Err(self.refuse("the vectors are linearly dependent"));
        }
        let entries = rows
            .iter()
            .enumerate()
            .flat_map(|(a, row)| row.iter().map(move |(i, value)| ([*i, a], value.clone())));
        let matrix = Tensor::from_components(n, &[Up, Down], entries)?;
        let change = BasisChange::new(matrix);
        let change = change.map_err(|_| self.refuse("the vectors are linearly dependent"))?;
        self.placed(algebra.change_basis(&change))
    }

    fn extension(&self, given: &Extension) -> Result<Algebra, InputError> {
        let structure = self.structure(&given.of, "central_extension.of")?;
        let n = structure.dimension();
        let centre: Vec<String> = given.centre.iter().map(|text| text.to_string()).collect();
        let labels = structure.algebra().labels().iter().chain(&centre);
        let indices: BTreeMap<String, usize> = labels.cloned().zip(0..).collect();
        if indices.len() != n + centre.len() {
            return Err(self.refuse("a vector of the centre has the name of another vector"));
        }
        let names = Names { labels: &indices, parameters: Some(&self.declared), coordinates: &[] };
        let mut cocycle = vec![];
        for block in &given.cocycle.0 {
            let source = self.source.excerpt(block);
            for line in lines(source.content()) {
                let ((j, k), value) = statement(line, "", &names, &source)?;
                let central = value.value.keys().all(|i| *i >= n);
                if j >= n || k >= n || !central {
                    let message = "a cocycle maps two vectors of the algebra into the centre";
                    return Err(InputError::usage(message).at(&value.place));
                }
                cocycle.extend(value.value.into_iter().map(|(i, v)| (j, k, i - n, v)));
            }
        }
        self.placed(structure.central_extension(&centre, cocycle))
    }

    fn semidirect(&self, given: &Semidirect) -> Result<Algebra, InputError> {
        let structure = self.structure(&given.of, "semidirect.of")?;
        match (&given.by, &given.on) {
            (ActionText::Word(word), None) => match &**word {
                "adjoint" => self.placed(structure.truncated(2)),
                "coadjoint" => self.placed(structure.with_dual()),
                _ => {
                    let error =
                        InputError::usage("an action is adjoint, coadjoint, or a list of matrices");
                    Err(error.at(&self.source.at(word)))
                }
            },
            (ActionText::Matrices(matrices), Some(on)) => {
                let on = self.structure(on, "semidirect.on")?;
                let by = matrices.iter().map(|matrix| self.matrix(matrix));
                let by = by.collect::<Result<Vec<_>, _>>()?;
                self.placed(structure.semidirect(&on, &by))
            }
            (ActionText::Word(_), Some(_)) => Err(self.refuse(
                "the adjoint and coadjoint actions are on the algebra itself: leave `on` away",
            )),
            (ActionText::Matrices(_), None) => {
                Err(self.refuse("`on` is missing: the algebra acted on"))
            }
        }
    }

    fn matrix(&self, matrix: &MatrixRows) -> Result<Matrix<Symbolic>, InputError> {
        let labels = BTreeMap::new();
        let names = Names { labels: &labels, parameters: Some(&self.declared), coordinates: &[] };
        let entry = |Cell(text): &Cell| {
            let source = self.source.excerpt(text);
            names.scalar(source.content(), &source)
        };
        let rows = matrix.rows.iter().map(|row| row.iter().map(entry).collect());
        let rows = rows.collect::<Result<Vec<Vec<Symbolic>>, _>>()?;
        Matrix::from_dense(&rows).map_err(|error| self.refuse(&error.to_string()))
    }

    /// The algebra of a name of the catalogue, of a file, or of a nested definition at `key`.
    fn algebra(&self, part: &Part<Document>, key: &str) -> Result<Algebra, InputError> {
        let (definition, place): (Definition, Place) = match part {
            Part::Name(text) => {
                let source = self.source.excerpt(text);
                (space::part(&source)?, self.source.at(text))
            }
            Part::Nested(document) => {
                (document.define(&self.source.table(key))?, self.source.key(key))
            }
        };
        let convert = |value: &Symbolic| Some(value.clone());
        let algebra = definition
            .algebra_alone()
            .algebra(&Reading { convert: &convert, tolerance: Tolerance::default() });
        algebra.map_err(|error| error.or_at(&place))
    }

    fn structure(
        &self,
        part: &Part<Document>,
        key: &str,
    ) -> Result<Structure<Symbolic>, InputError> {
        Ok(Structure::new(self.algebra(part, key)?))
    }

    /// Combinations of the basis vectors.
    fn vectors(
        &self,
        structure: &Structure<Symbolic>,
        texts: &[Text],
    ) -> Result<Vec<Row<Symbolic>>, InputError> {
        let labels = structure.algebra().labels().iter().cloned();
        let indices: BTreeMap<String, usize> = labels.zip(0..).collect();
        let names = Names { labels: &indices, parameters: Some(&self.declared), coordinates: &[] };
        let vector = |text: &Text| {
            let source = self.source.excerpt(text);
            let vector = names.vector(source.content(), &source)?;
            Ok(vector.into_iter().filter(|(_, value)| !value.vanishes()).collect())
        };
        texts.iter().map(vector).collect()
    }

    fn refuse(&self, message: &str) -> InputError {
        InputError::usage(message).at(&self.place)
    }

    /// A refusal of the library at the place of the key.
    fn placed<T>(&self, result: Result<T, affinor::Error>) -> Result<T, InputError> {
        result.map_err(|error| InputError::from(error).or_at(&self.place))
    }
}

/// The right sides by ordered pair of an algebra that is built.
pub(super) fn pairs(algebra: &Algebra, place: &Place) -> super::Pairs {
    let mut pairs = super::Pairs::new();
    for (at, value) in algebra.structure().components().filter(|(at, _)| at[1] < at[2]) {
        let given = pairs
            .entry((at[1], at[2]))
            .or_insert_with(|| super::Given { value: BTreeMap::new(), place: place.clone() });
        given.value.insert(at[0], value.clone());
    }
    pairs
}
