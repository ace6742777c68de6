//! Reads and writes algebras, metrics, connections and geometries through serde.
//!
//! ```text
//! {"schema": "affinor.algebra/1", "basis": ["e1", ...], "structure": TENSOR}
//! {"schema": "affinor.metric/1", "components": TENSOR}
//! {"schema": "affinor.connection/1", "algebra": ALGEBRA, "affinities": TENSOR}
//! {"schema": "affinor.geometry/1", "name": "M(3)", "algebra": ALGEBRA, "connection": "plus", "metric": METRIC}
//! ```
//!
//! In the formats above, TENSOR is the serialized form of [`Tensor`]. The connection of a geometry
//! is `"plus"`, `"zero"`, `"minus"`, `"levi-civita"`, `{"lambda": "1/3"}` or
//! `{"affinities": TENSOR}`. Every value that is read passes the checks of the constructors:
//! antisymmetry, the Jacobi identity, symmetry and the rank of a metric. Frames on charts and
//! right-invariant frames cannot be serialized.

use crate::geometry::connection::{CanonicalConnection, Connection};
use crate::{
    Bracket, ConnectionKind, Field, FrameOrigin, Geometry, LieAlgebra, Metric, Notation, Scalar,
    Tensor,
};
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Error as _, Serialize, Serializer};
use std::borrow::Cow;

/// The schema of a serialized value: its name and its version.
struct Schema<const AT: usize>;

const SCHEMAS: [&str; 4] =
    ["affinor.algebra/1", "affinor.metric/1", "affinor.connection/1", "affinor.geometry/1"];

impl<const AT: usize> Serialize for Schema<AT> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        SCHEMAS[AT].serialize(serializer)
    }
}

impl<'de, const AT: usize> Deserialize<'de> for Schema<AT> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found = Cow::<str>::deserialize(deserializer)?;
        if found != SCHEMAS[AT] {
            return Err(D::Error::custom(format!("expected schema {}, got {found}", SCHEMAS[AT])));
        }
        Ok(Schema)
    }
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Algebra<L, T> {
    schema: Schema<0>,
    basis: L,
    structure: T,
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Components<T> {
    schema: Schema<1>,
    components: T,
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Affinities<A, T> {
    schema: Schema<2>,
    algebra: A,
    affinities: T,
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Space<N, A, S, T, M> {
    schema: Schema<3>,
    name: N,
    #[serde(default = "Option::default", skip_serializing_if = "Option::is_none")]
    algebra_name: Option<N>,
    algebra: A,
    connection: Kind<S, T>,
    #[serde(default = "Option::default", skip_serializing_if = "Option::is_none")]
    metric: Option<M>,
}

/// The serialized choice of a connection.
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Kind<S, T> {
    Plus,
    Zero,
    Minus,
    LeviCivita,
    Lambda(S),
    Affinities(T),
}

impl<S: Scalar + Serialize> Serialize for LieAlgebra<S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Algebra { schema: Schema, basis: self.labels(), structure: self.structure_constants() }
            .serialize(serializer)
    }
}

impl<'de, S: Scalar + Deserialize<'de>> Deserialize<'de> for LieAlgebra<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = Algebra::<Vec<String>, Tensor<S>>::deserialize(deserializer)?;
        let bracket = Bracket::new(read.basis, read.structure).map_err(D::Error::custom)?;
        LieAlgebra::try_from(bracket).map_err(D::Error::custom)
    }
}

impl<S: Field + Scalar + Serialize> Serialize for Metric<S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Components { schema: Schema, components: self.components() }.serialize(serializer)
    }
}

impl<'de, S: Field + Scalar + Deserialize<'de>> Deserialize<'de> for Metric<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let components = Components::<Tensor<S>>::deserialize(deserializer)?.components;
        let labels = (1..=components.dimension()).map(|i| format!("e{i}"));
        Metric::new(labels, components).map_err(D::Error::custom)
    }
}

impl<S: Scalar + Serialize> Serialize for Connection<S> {
    /// # Errors
    /// Returns an error for a frame that is not invariant, and for the frame of a homogeneous
    /// space.
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let frame = self.frame();
        let bracket = Bracket::new(frame.labels(), frame.structure_functions().clone());
        let algebra = bracket.ok().and_then(|bracket| LieAlgebra::try_from(bracket).ok());
        let algebra = algebra.filter(|algebra| algebra.left_frame() == frame);
        let algebra = algebra.ok_or_else(|| {
            W::Error::custom(
                "a connection that is not in the frame of a Lie algebra cannot be serialized",
            )
        })?;
        Affinities { schema: Schema, algebra, affinities: self.affinities() }.serialize(serializer)
    }
}

impl<'de, S: Scalar + Deserialize<'de>> Deserialize<'de> for Connection<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = Affinities::<LieAlgebra<S>, Tensor<S>>::deserialize(deserializer)?;
        Connection::new(read.algebra.left_frame().clone(), read.affinities)
            .map_err(D::Error::custom)
    }
}

impl<S: Notation + Scalar + Serialize> Serialize for Geometry<S> {
    /// # Errors
    /// Returns an error for a geometry on a chart, or in a right-invariant frame.
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let FrameOrigin::Algebra(algebra) = self.frame_origin() else {
            let on = self.frame_origin().homogeneous().map_or("chart", |_| "homogeneous space");
            let message = format!("a geometry on a {on} cannot be serialized");
            return Err(W::Error::custom(message));
        };
        if self.frame_name() == "right-invariant" {
            return Err(W::Error::custom(
                "a geometry in its right-invariant frame cannot be serialized",
            ));
        }
        let connection = match self.kind() {
            ConnectionKind::Canonical(CanonicalConnection::Plus) => Kind::Plus,
            ConnectionKind::Canonical(CanonicalConnection::Zero) => Kind::Zero,
            ConnectionKind::Canonical(CanonicalConnection::Minus) => Kind::Minus,
            ConnectionKind::LeviCivita => Kind::LeviCivita,
            ConnectionKind::Family(lambda) => Kind::Lambda(lambda),
            ConnectionKind::Affinities(gamma) => Kind::Affinities(gamma),
            // the schema has no distributions, and the affinities define the same connection
            ConnectionKind::Nonholonomic(_) => Kind::Affinities(self.connection().affinities()),
        };
        let (name, metric) = (self.name(), self.metric());
        let algebra_name = Some(self.algebra_name()).filter(|other| *other != name);
        Space { schema: Schema, name, algebra_name, algebra, connection, metric }
            .serialize(serializer)
    }
}

impl<'de, S: Notation + Scalar + Deserialize<'de>> Deserialize<'de> for Geometry<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read =
            Space::<String, LieAlgebra<S>, S, Tensor<S>, Metric<S>>::deserialize(deserializer)?;
        let kind = match read.connection {
            Kind::Plus => ConnectionKind::Canonical(CanonicalConnection::Plus),
            Kind::Zero => ConnectionKind::Canonical(CanonicalConnection::Zero),
            Kind::Minus => ConnectionKind::Canonical(CanonicalConnection::Minus),
            Kind::LeviCivita => ConnectionKind::LeviCivita,
            Kind::Lambda(lambda) => ConnectionKind::Family(lambda),
            Kind::Affinities(gamma) => ConnectionKind::Affinities(gamma),
        };
        let geometry = Geometry::new(read.name, read.algebra, kind, read.metric);
        let geometry = geometry.map_err(D::Error::custom)?;
        Ok(match read.algebra_name {
            Some(name) => geometry.over(name),
            None => geometry,
        })
    }
}
