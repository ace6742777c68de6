//! The statements of Paraskevopoulos and Natsiavas (2013) about their two geometries, as predicates
//! on any geometry.

use crate::Coefficient;
use affinor::algebra::frame::expect_numbers;
use affinor::geometry::properties::{Property, Witness};
use affinor::{Error, Geometry, Law};
use affinor_tensors::text::written;
use affinor_tensors::{Tensor, Up, contract};

/// A statement about a geometry of Paraskevopoulos and Natsiavas (2013), with the number of its
/// equation. [`holds`](Claim::holds) tests the statement on any geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// `Lambda^i_jk = c^i_jk` (38).
    AffinitiesAreStructure,
    /// `tau^i_jk = c^i_jk` (after 38).
    TorsionIsStructure,
    /// `R^i_jkl = 0` (after 38).
    Flat,
    /// `-ad_n` generates parallel transport along autoparallels (45).
    TransportByAd,
    /// The connection does not preserve the metric (section 5).
    Incompatible,
    /// `Lambda^i_jk = -Lambda^i_kj` (40), so autoparallels have constant components (43).
    Antisymmetric,
    /// `c^i_jk = 2 Lambda^i_jk` (39).
    StructureIsTwiceAffinities,
    /// `tau^i_jk = 0` (after 39).
    TorsionFree,
    /// `R^i_jkl = -1/4 c^m_kl c^i_mj`, and it is not zero (the table after 65).
    CurvedByBracket,
    /// `-1/2 ad_n` generates parallel transport along autoparallels (71).
    TransportByHalfAd,
    /// The connection preserves the metric (after 102).
    Compatible,
    /// The metric is bi-invariant, `g([z,x],y) + g(x,[z,y]) = 0` (102).
    BiInvariant,
}

impl Claim {
    /// All claims; those about M(3) come first.
    pub const ALL: [Claim; 12] = {
        use Claim::*;
        [
            AffinitiesAreStructure,
            TorsionIsStructure,
            Flat,
            TransportByAd,
            Incompatible,
            Antisymmetric,
            StructureIsTwiceAffinities,
            TorsionFree,
            CurvedByBracket,
            TransportByHalfAd,
            Compatible,
            BiInvariant,
        ]
    };

    /// The equation or section of the paper.
    pub fn equation(self) -> &'static str {
        self.entry().0
    }

    /// A short statement of the claim.
    pub fn statement(self) -> &'static str {
        self.entry().1
    }

    fn entry(self) -> (&'static str, &'static str) {
        match self {
            Claim::AffinitiesAreStructure => ("(38)", "affinities = structure constants"),
            Claim::TorsionIsStructure => ("after (38)", "torsion = structure constants"),
            Claim::Flat => ("after (38)", "no curvature"),
            Claim::TransportByAd => ("(45)", "transport by G = -ad_n"),
            Claim::Incompatible => ("section 5", "metric not preserved"),
            Claim::Antisymmetric => ("(40)", "affinities antisymmetric"),
            Claim::StructureIsTwiceAffinities => ("(39)", "structure constants = 2 affinities"),
            Claim::TorsionFree => ("after (39)", "no torsion"),
            Claim::CurvedByBracket => ("after (65)", "curvature -1/4 [[X,Y],Z] and not 0"),
            Claim::TransportByHalfAd => ("(71)", "transport by G = -1/2 ad_n"),
            Claim::Compatible => ("after (102)", "metric preserved"),
            Claim::BiInvariant => ("(102)", "metric bi-invariant"),
        }
    }

    /// The geometries about which the paper makes the claim: `M(3)`, `SO(3)`, or both geometries.
    pub fn about(self) -> &'static [&'static str] {
        match self {
            Claim::AffinitiesAreStructure
            | Claim::TorsionIsStructure
            | Claim::Flat
            | Claim::TransportByAd
            | Claim::Incompatible => &["M(3)"],
            Claim::Antisymmetric => &["M(3)", "SO(3)"],
            _ => &["SO(3)"],
        }
    }

    /// Whether the claim holds for a geometry; `None` if the claim is about a metric and the
    /// geometry has none.
    ///
    /// The witness of a failure is the first nonzero component, whose indices are inserted in the
    /// equation. For a claim about transport along a basis vector, the residual ends with the name
    /// of this vector.
    ///
    /// ```
    /// use affinor_documents::space::paper;
    /// use affinor_documents::report::Claim;
    /// let witness = Claim::Flat.holds(&paper::so3()?)?.and_then(|property| property.witness());
    /// assert_eq!(witness.map(|witness| witness.to_string()).as_deref(), Some("R^1_212 = 1/4"));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Law::Constant`], because the claims are about structure constants; [`Error::NotFinite`] if
    /// floats exceed their range.
    pub fn holds<S: Coefficient>(
        self,
        geometry: &Geometry<S>,
    ) -> Result<Option<Property<String>>, Error> {
        let connection = geometry.connection();
        let c = geometry.frame_origin().constant_structure("a claim of the paper")?;
        let vanish = |sum: &'static str| {
            let torsion = connection.torsion();
            let operands = [("Lambda", connection.affinities()), ("c", c), ("tau", &torsion)];
            vanishes(&contract(&format!("{sum} -> ^i_jk"), &operands)?, sum, "ijk")
        };
        let property = match (self, geometry.metric()) {
            (Claim::AffinitiesAreStructure, _) => vanish("Lambda^i_jk - c^i_jk"),
            (Claim::TorsionIsStructure, _) => vanish("tau^i_jk - c^i_jk"),
            (Claim::Antisymmetric, _) => vanish("Lambda^i_jk + Lambda^i_kj"),
            (Claim::StructureIsTwiceAffinities, _) => vanish("c^i_jk - 2 Lambda^i_jk"),
            (Claim::TorsionFree, _) => vanish("tau^i_jk"),
            (Claim::Flat, _) => vanishes(connection.curvature(), "R^i_jkl", "ijkl"),
            (Claim::CurvedByBracket, _) => {
                let curvature = connection.curvature();
                let quarter = c.scale(&share(4));
                let operands = [("R", curvature), ("q", &quarter), ("c", c)];
                let residual = contract("R^i_jkl + q^m_kl c^i_mj -> ^i_jkl", &operands)?;
                match vanishes(&residual, "R^i_jkl + 1/4 c^m_kl c^i_mj", "ijkl")? {
                    Property::Holds(()) if curvature.is_empty() => Ok(fails("R^i_jkl", "0")),
                    property => Ok(property),
                }
            }
            (Claim::TransportByAd, _) => transport(geometry, &S::one(), "G^i_k + ad^i_k"),
            (Claim::TransportByHalfAd, _) => transport(geometry, &share(2), "G^i_k + 1/2 ad^i_k"),
            (Claim::Compatible | Claim::Incompatible | Claim::BiInvariant, None) => {
                return Ok(None);
            }
            (Claim::Compatible, Some(metric)) => {
                vanishes(&connection.nonmetricity(metric)?, "(nabla_k g)_ij", "kij")
            }
            (Claim::Incompatible, Some(metric)) => {
                Ok(match connection.nonmetricity(metric)?.is_empty() {
                    true => fails("(nabla_k g)_ij", "0"),
                    false => Property::Holds(()),
                })
            }
            (Claim::BiInvariant, Some(metric)) => {
                let sum = "g_mj c^m_ki + g_im c^m_kj";
                let operands = [("g", metric.components()), ("c", c)];
                vanishes(&contract(&format!("{sum} -> _kij"), &operands)?, sum, "kij")
            }
        };
        property.map(Some)
    }
}

/// The fraction `1/n`; zero in a field that does not contain it.
fn share<S: Coefficient>(n: i64) -> S {
    S::from_quotient(1, n).unwrap_or_else(S::zero)
}

/// Whether the generator of parallel transport along the autoparallel of each basis vector `n` is
/// `-share ad_n`.
fn transport<S: Coefficient>(
    geometry: &Geometry<S>,
    share: &S,
    sum: &'static str,
) -> Result<Property<String>, Error> {
    let c = geometry.frame_origin().constant_structure("transport by ad")?;
    for (j, label) in geometry.frame().labels().iter().enumerate() {
        let unit = |i| if i == j { S::one() } else { S::zero() };
        let n: Vec<S> = (0..c.dimension()).map(unit).collect();
        let generator = match geometry.connection().transport_generator(&n) {
            Ok(generator) => generator,
            Err(Error::Broken { law: Law::ConstantTangent, residual, .. }) => {
                return Ok(fails("nabla_n n", format!("{residual} for n = {label}")));
            }
            Err(error) => return Err(error),
        };
        let operands = [("c", c), ("n", &Tensor::vector(&n, Up))];
        let ad = contract("c^i_jk n^j -> ^i_k", &operands)?.scale(share);
        let residual = contract("G^i_k + a^i_k -> ^i_k", &[("G", &generator), ("a", &ad)])?;
        if let Property::Fails(mut witness) = vanishes(&residual, sum, "ik")? {
            witness.residual += &format!(" for n = {label}");
            return Ok(Property::Fails(witness));
        }
    }
    Ok(Property::Holds(()))
}

/// Whether a tensor is zero. If it is not, the witness is its first nonzero component. `sum` is the
/// formula of the tensor, and `letters` are the index letters of its slots.
fn vanishes<S: Coefficient>(
    tensor: &Tensor<S>,
    sum: &'static str,
    letters: &str,
) -> Result<Property<String>, Error> {
    expect_numbers(sum, tensor)?;
    let Some((at, value)) = tensor.components().next() else {
        return Ok(Property::Holds(()));
    };
    let index = |letter: char| match letters.find(letter) {
        Some(slot) => (at[slot] + 1).to_string(),
        None => letter.to_string(),
    };
    // separates indices by commas above dimension 9, because they may have two digits
    let comma = if tensor.dimension() > 9 { "," } else { "" };
    let indices = |letters: &str| letters.chars().map(index).collect::<Vec<_>>().join(comma);
    Ok(fails(with_indices(sum, indices), written(value)))
}

fn fails(equation: impl Into<String>, residual: impl Into<String>) -> Property<String> {
    let (equation, residual) = (equation.into(), residual.into());
    Property::Fails(Witness { equation, letters: "", indices: vec![], residual })
}

/// Replaces the index letters in the formula of a sum.
fn with_indices(sum: &str, indices: impl Fn(&str) -> String) -> String {
    let (mut text, mut rest) = (String::new(), sum);
    while let Some(place) = rest.find(['^', '_']) {
        let (name, script) = rest.split_at(place + 1);
        let end = script.find(|c: char| !c.is_alphanumeric()).unwrap_or(script.len());
        text += name;
        text += &indices(&script[..end]);
        rest = &script[end..];
    }
    text + rest
}
