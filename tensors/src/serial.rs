//! Reads and writes scalars and tensors through serde.
//!
//! Exact and symbolic values are written as text, such as `"-1/2"` and `"a/(b + 1)"`. A tensor is
//! written as
//!
//! ```text
//! {"schema": "affinor.tensor/1", "dimension": 3, "slots": ["up", "down"], "tolerance": 1.4e-14,
//!  "components": [[[1, 2], "-1/2"], ...]}
//! ```
//!
//! where indices count from 1. Every value that is read passes the checks of the constructors.

use crate::{Rational, Summable, Symbolic, Tensor, Tolerance, TrackedFloat, Variance};
use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::Error as _;
use serde::{Serialize, Serializer};
use std::borrow::Cow;

/// The name and the version of the serialized form of a tensor.
const SCHEMA: &str = "affinor.tensor/1";

macro_rules! as_text {
    ($($scalar:ty),*) => {$(
        impl Serialize for $scalar {
            fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
                serializer.collect_str(self)
            }
        }
        impl<'de> Deserialize<'de> for $scalar {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let text = Cow::<str>::deserialize(deserializer)?;
                text.parse().map_err(|error| D::Error::custom(format!("`{text}`: {error}")))
            }
        }
    )*};
}
as_text!(Rational, Symbolic);

/// A tracked float is serialized as a pair of its value and its error.
impl Serialize for TrackedFloat {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        (self.value(), self.error()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for TrackedFloat {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (value, error) = Deserialize::deserialize(deserializer)?;
        Ok(TrackedFloat::with_error(value, error))
    }
}

/// The serialized form of a tensor.
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<'t, V> {
    schema: Cow<'t, str>,
    dimension: usize,
    slots: Cow<'t, [Variance]>,
    tolerance: f64,
    components: Vec<(Vec<usize>, V)>,
}

impl<S: Summable + Serialize> Serialize for Tensor<S> {
    /// # Errors
    /// Returns an error if a component is infinite or NaN, which JSON cannot represent.
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let component =
            |(at, value): (crate::Indices, _)| (at.iter().map(|index| index + 1).collect(), value);
        if let Some(value) = self.nonzero().find(|value| !value.is_number()) {
            return Err(W::Error::custom(format!("a component is {value}, not a finite number")));
        }
        Written {
            schema: SCHEMA.into(),
            dimension: self.dimension(),
            slots: self.slots().into(),
            tolerance: self.tolerance().relative(),
            components: self.components().map(component).collect(),
        }
        .serialize(serializer)
    }
}

impl<'de, S: Summable + Deserialize<'de>> Deserialize<'de> for Tensor<S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let written = Written::<S>::deserialize(deserializer)?;
        if written.schema != SCHEMA {
            return Err(D::Error::custom(format!(
                "expected schema {SCHEMA}, got {}",
                written.schema
            )));
        }
        let tolerance = Tolerance::new(written.tolerance)
            .ok_or_else(|| D::Error::custom("the tolerance must be at least 0 and less than 1"))?;
        let component = |(at, value): (Vec<usize>, S)| {
            let at: Option<Vec<usize>> = at.iter().map(|index| index.checked_sub(1)).collect();
            Ok((
                at.ok_or_else(|| D::Error::custom("an index is 0, but indices count from 1"))?,
                value,
            ))
        };
        let components = written.components.into_iter().map(component);
        let components: Vec<_> = components.collect::<Result<_, D::Error>>()?;
        let mut places: Vec<&[usize]> = components.iter().map(|(at, _)| &at[..]).collect();
        places.sort_unstable();
        if let Some(two) = places.windows(2).find(|two| two[0] == two[1]) {
            let at: Vec<usize> = two[0].iter().map(|index| index + 1).collect();
            return Err(D::Error::custom(format!("the component {at:?} is given twice")));
        }
        let tensor = Tensor::from_components(written.dimension, &written.slots, components);
        Ok(tensor.map_err(D::Error::custom)?.with_tolerance(tolerance))
    }
}
