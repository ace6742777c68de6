//! Algebras that are constructed from other algebras: the keys `sum`, `semidirect`, `subalgebra`,
//! `quotient` and others.

use crate::input::{
    InputError, Place, Source,
    forms::{ActionText, Block, Cell, MatrixRows, Part, Text},
};
use crate::space::notation::{Names, lines, statement};
use affinor::algebra::structure::{StructureTheory, Subspace};
use affinor::{BasisChange, LieAlgebra};
use affinor_tensors::linear::{Matrix, Row};
use affinor_tensors::{Down, Ring, Symbolic, Tensor, Up};
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};

/// A semidirect sum: an algebra that acts on another algebra.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct Semidirect<D> {
    of: Part<D>,
    on: Option<Part<D>>,
    by: ActionText,
}

/// A subalgebra, given by a basis or by generators.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct Subalgebra<D> {
    of: Part<D>,
    spanned_by: Option<Vec<Text>>,
    generated_by: Option<Vec<Text>>,
    centralizer_of: Option<Vec<Text>>,
}

/// A quotient by the span of vectors.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct Quotient<D> {
    of: Part<D>,
    by: Vec<Text>,
}

/// A central extension by new basis vectors. Its cocycle is written as brackets.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct Extension<D> {
    of: Part<D>,
    centre: Vec<Text>,
    cocycle: Block,
}

/// A contraction, given by the weights of the basis vectors.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct Contraction<D> {
    of: Part<D>,
    weights: Vec<i64>,
}

/// An algebra in another basis.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct OtherBasis<D> {
    of: Part<D>,
    vectors: Vec<Text>,
}

/// The truncated polynomials with values in an algebra.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct Truncated<D> {
    of: Part<D>,
    order: usize,
}

/// The tensor product of an algebra with a commutative algebra, which is given by the products of
/// its basis vectors.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound = "D: DeserializeOwned")]
pub(crate) struct TensorProduct<D> {
    of: Part<D>,
    basis: Vec<Text>,
    products: Block,
}

/// A construction from algebras, each of which is named or defined by a nested document `D`.
pub(super) enum Construction<'d, D> {
    Sum(&'d [Part<D>]),
    Semidirect(&'d Semidirect<D>),
    Subalgebra(&'d Subalgebra<D>),
    Quotient(&'d Quotient<D>),
    CentralExtension(&'d Extension<D>),
    Contraction(&'d Contraction<D>),
    ChangeOfBasis(&'d OtherBasis<D>),
    Truncated(&'d Truncated<D>),
    TensorProduct(&'d TensorProduct<D>),
    Complexification(&'d Part<D>),
}

type Algebra = LieAlgebra<Symbolic>;

/// A function that reads the algebra of a part; the string is the key of the part.
type Read<'s, D> = &'s dyn Fn(&Part<D>, &str) -> Result<Algebra, InputError>;

/// The context of a construction: its key in the file, and the declared parameters.
pub(super) struct Site<'s, D> {
    pub(super) source: &'s Source,
    pub(super) place: Place,
    pub(super) declared: BTreeSet<String>,
    /// Reads the algebra that a part of the file names or defines.
    pub(super) read: Read<'s, D>,
}

impl<D> Site<'_, D> {
    /// Builds the algebra of the construction.
    pub(super) fn build(&self, construction: &Construction<D>) -> Result<Algebra, InputError> {
        let built = match construction {
            Construction::Sum(summands) => {
                let mut parts = summands
                    .iter()
                    .enumerate()
                    .map(|(at, part)| (self.read)(part, &format!("sum.{at}")));
                let first = parts.next().unwrap_or_else(|| {
                    Err(self.refuse("`sum` is empty: list at least one algebra"))
                })?;
                return parts.try_fold(first, |sum, next| self.placed(sum.direct_sum(&next?)));
            }
            Construction::Complexification(of) => {
                self.structure(of, "complexification")?.complexified()
            }
            Construction::Truncated(Truncated { of, order }) => {
                if !(1..=64).contains(order) {
                    return Err(self.refuse("the order of truncation is not between 1 and 64"));
                }
                self.structure(of, "truncated.of")?.truncated(*order)
            }
            Construction::Contraction(Contraction { of, weights }) => {
                self.structure(of, "contraction.of")?.inonu_wigner_contraction(weights)
            }
            Construction::Quotient(Quotient { of, by }) => {
                let structure = self.structure(of, "quotient.of")?;
                let ideal = Subspace::span(structure.dimension(), self.vectors(&structure, by)?);
                if ideal.dimension() == structure.dimension() {
                    return Err(self.refuse("the quotient by the whole algebra is zero"));
                }
                structure.quotient(&ideal)
            }
            Construction::ChangeOfBasis(OtherBasis { of, vectors }) => {
                let structure = self.structure(of, "change_of_basis.of")?;
                let rows = self.vectors(&structure, vectors)?;
                if rows.len() != structure.dimension() {
                    let message =
                        format!("{} vectors for dimension {}", rows.len(), structure.dimension());
                    return Err(self.refuse(&message));
                }
                return self.in_basis(structure.algebra(), &rows);
            }
            Construction::TensorProduct(given) => return self.tensor_product(given),
            Construction::Subalgebra(subalgebra) => return self.subalgebra(subalgebra),
            Construction::CentralExtension(extension) => return self.extension(extension),
            Construction::Semidirect(semidirect) => return self.semidirect(semidirect),
        };
        self.placed(built)
    }

    fn subalgebra(&self, given: &Subalgebra<D>) -> Result<Algebra, InputError> {
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

    /// Changes the basis of the algebra to these vectors.
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

    fn extension(&self, given: &Extension<D>) -> Result<Algebra, InputError> {
        let structure = self.structure(&given.of, "central_extension.of")?;
        let n = structure.dimension();
        let centre: Vec<String> = given.centre.iter().map(|text| text.to_string()).collect();
        let labels = structure.algebra().labels().iter().chain(&centre);
        let indices: BTreeMap<String, usize> = labels.cloned().zip(0..).collect();
        if indices.len() != n + centre.len() {
            return Err(self.refuse("a vector of the centre has the name of another vector"));
        }
        let names = Names {
            labels: &indices,
            parameters: Some(&self.declared),
            functions: None,
            bare: false,
        };
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

    fn tensor_product(&self, given: &TensorProduct<D>) -> Result<Algebra, InputError> {
        let structure = self.structure(&given.of, "tensor_product.of")?;
        let units: Vec<String> = given.basis.iter().map(|text| text.to_string()).collect();
        let indices: BTreeMap<String, usize> = units.iter().cloned().zip(0..).collect();
        if units.is_empty() || indices.len() != units.len() {
            return Err(
                self.refuse("the basis of the factor must have names that differ from each other")
            );
        }
        let names = Names {
            labels: &indices,
            parameters: Some(&self.declared),
            functions: None,
            bare: false,
        };
        let mut products = BTreeMap::new();
        for block in &given.products.0 {
            let source = self.source.excerpt(block);
            for line in lines(source.content()) {
                let ((a, b), product) = statement(line, "product", &names, &source)?;
                let place = product.place.clone();
                if products.insert((a.min(b), a.max(b)), product.value).is_some() {
                    let message = "this product is given twice: factors in the other order are the same product";
                    return Err(InputError::usage(message).at(&place));
                }
            }
        }
        let components = products.into_iter().flat_map(|((a, b), value)| {
            let of = move |(d, v): (usize, Symbolic)| {
                let mirrored = (a != b).then(|| ([d, b, a], v.clone()));
                [Some(([d, a, b], v)), mirrored].into_iter().flatten()
            };
            value.into_iter().flat_map(of)
        });
        let table = Tensor::from_components(units.len(), &[Up, Down, Down], components)?;
        self.placed(structure.tensor_product(&units, &table))
    }

    fn semidirect(&self, given: &Semidirect<D>) -> Result<Algebra, InputError> {
        let structure = self.structure(&given.of, "semidirect.of")?;
        match (&given.by, &given.on) {
            (ActionText::Word(word), None) => match &**word {
                "adjoint" => self.placed(structure.truncated(2)),
                "coadjoint" => self.placed(structure.with_dual()),
                _ => {
                    let error = InputError::usage(
                        "the action must be adjoint, coadjoint, or a list of matrices",
                    );
                    Err(error.at(&self.source.at(word)))
                }
            },
            (ActionText::Matrices(matrices), Some(on)) => {
                let on = self.structure(on, "semidirect.on")?;
                let by = matrices.iter().map(|matrix| self.matrix(matrix));
                let by = by.collect::<Result<Vec<_>, _>>()?;
                self.placed(structure.semidirect(&on, &by))
            }
            (ActionText::Word(_), Some(_)) => Err(self
                .refuse("leave `on` out: adjoint and coadjoint actions are on the algebra itself")),
            (ActionText::Matrices(_), None) => {
                Err(self.refuse("`on` is missing: name the algebra that is acted on"))
            }
        }
    }

    fn matrix(&self, matrix: &MatrixRows) -> Result<Matrix<Symbolic>, InputError> {
        let labels = BTreeMap::new();
        let names = Names {
            labels: &labels,
            parameters: Some(&self.declared),
            functions: None,
            bare: false,
        };
        let entry = |Cell(text): &Cell| {
            let source = self.source.excerpt(text);
            names.scalar(source.content(), &source)
        };
        let rows = matrix.rows.iter().map(|row| row.iter().map(entry).collect());
        let rows = rows.collect::<Result<Vec<Vec<Symbolic>>, _>>()?;
        Matrix::from_dense(&rows).map_err(|error| self.refuse(&error.to_string()))
    }

    fn structure(
        &self,
        part: &Part<D>,
        key: &str,
    ) -> Result<StructureTheory<Symbolic>, InputError> {
        Ok(StructureTheory::new((self.read)(part, key)?))
    }

    /// Reads vectors as combinations of the basis vectors.
    fn vectors(
        &self,
        structure: &StructureTheory<Symbolic>,
        texts: &[Text],
    ) -> Result<Vec<Row<Symbolic>>, InputError> {
        let labels = structure.algebra().labels().iter().cloned();
        let indices: BTreeMap<String, usize> = labels.zip(0..).collect();
        let names = Names {
            labels: &indices,
            parameters: Some(&self.declared),
            functions: None,
            bare: false,
        };
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

    /// Adds the location of the key to an error of the library.
    fn placed<T>(&self, result: Result<T, affinor::Error>) -> Result<T, InputError> {
        result.map_err(|error| InputError::from(error).or_at(&self.place))
    }
}

/// The brackets of a constructed algebra: the right-hand side for each ordered pair.
pub(super) fn pairs(algebra: &Algebra, place: &Place) -> super::Pairs {
    let mut pairs = super::Pairs::new();
    for (at, value) in algebra.structure_constants().components().filter(|(at, _)| at[1] < at[2]) {
        let given = pairs
            .entry((at[1], at[2]))
            .or_insert_with(|| super::Given { value: BTreeMap::new(), place: place.clone() });
        given.value.insert(at[0], value.clone());
    }
    pairs
}
