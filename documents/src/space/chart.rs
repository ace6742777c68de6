//! Charts in definitions: coordinates, and vector fields whose components are functions of the
//! coordinates.

use crate::Coefficient;
use crate::input::{InputError, Place, Source, forms::ChartText, shown};
use crate::space::{
    Given,
    functions::{Functions, Positive},
    notation::Names,
};
use affinor::geometry::chart::{Chart, Fields};
use affinor_tensors::expression::{canonical_name, is_abbreviation};
use affinor_tensors::scalar::FreeFunction;
use affinor_tensors::{Down, Symbolic, Tensor, Up};

/// Vector fields, given by their components in the coordinate frame.
#[derive(Clone, Debug)]
pub(super) struct OnChart {
    pub functions: Functions,
    pub fields: Vec<Given>,
    /// The location of the fields in the file.
    pub place: Place,
}

impl OnChart {
    /// Converts the fields to a scalar type.
    pub fn fields<S: Coefficient>(&self, labels: &[String]) -> Result<Fields<S>, InputError> {
        let mut entries = Vec::new();
        for (i, Given { value, place }) in self.fields.iter().enumerate() {
            for (a, value) in value {
                entries.push(([*a, i], S::read(value).map_err(|error| error.or_at(place))?));
            }
        }
        let components = Tensor::from_components(labels.len(), &[Up, Down], entries)?;
        let fields = Chart::new(&self.functions.coordinates)?.fields(labels, components);
        fields.map_err(|error| InputError::from(error).at(&self.place))
    }
}

impl ChartText {
    /// The undetermined functions, and the functions that are positive on the chart.
    pub fn functions(&self, names: &Names, source: &Source) -> Result<Functions, InputError> {
        let coordinates: Vec<_> = self.coordinates.iter().map(|name| name.to_string()).collect();
        let mut functions = Functions { coordinates, free: vec![], positive: Positive::default() };
        for text in &self.functions {
            let free = self.free(text, names, &functions);
            functions.free.push(free.map_err(|error| error.at(&source.at(text)))?);
        }
        self.declare(&functions, names, source)?;
        if !self.conditions.is_empty() {
            self.conditions(&mut functions, names, source)?;
            // declares the positive functions again, now with the conditions applied
            functions.positive = Positive::default();
            self.declare(&functions, names, source)?;
        }
        Ok(functions)
    }

    /// Declares the functions that are positive on the chart.
    fn declare(
        &self,
        functions: &Functions,
        names: &Names,
        source: &Source,
    ) -> Result<(), InputError> {
        for text in &self.positive {
            let excerpt = source.excerpt(text);
            let names = Names { functions: Some(functions), ..*names };
            let positive = names.scalar(excerpt.content(), &excerpt)?;
            let declared = functions.positive.declare(&positive);
            declared.map_err(|reason| InputError::usage(reason).at(&source.at(text)))?;
        }
        Ok(())
    }

    /// Applies the conditions `r_u = ...` on derivatives of undetermined functions. In a condition,
    /// the name of a function without arguments means the function at its declared arguments.
    fn conditions(
        &self,
        functions: &mut Functions,
        names: &Names,
        source: &Source,
    ) -> Result<(), InputError> {
        let mut found: Vec<(String, Symbolic)> = Vec::new();
        for text in &self.conditions {
            let excerpt = source.excerpt(text);
            let content = excerpt.content();
            let refuse = |message: String| Err(InputError::usage(message).at(&source.at(text)));
            let Some((head, value)) = content.split_once('=') else {
                return refuse(
                    "write a condition as derivative = value, such as \"r_u = 2*u/r\"".into(),
                );
            };
            let bare = Names { functions: Some(functions), bare: true, ..*names };
            let head = canonical_name(head.trim());
            let head = head.split('(').next().unwrap_or_default().trim().to_string();
            let name = head.split('_').next().unwrap_or_default();
            if !functions.free.iter().any(|free| free.name() == name) {
                let message =
                    format!("`{}` is not a derivative of a declared function", shown(&head));
                return refuse(message);
            }
            found.push((head, bare.scalar(value.trim(), &excerpt)?));
        }
        let found: Vec<_> =
            found.iter().map(|(head, value)| (head.as_str(), value.clone())).collect();
        if !found.is_empty() {
            let conditioned = FreeFunction::under_conditions(&functions.free, &found);
            functions.free = conditioned
                .map_err(|reason| InputError::mathematics(reason).at(&source.key("chart.where")))?;
        }
        Ok(())
    }

    /// Parses an undetermined function such as `f(r, theta)`.
    fn free(
        &self,
        text: &str,
        names: &Names,
        known: &Functions,
    ) -> Result<FreeFunction, InputError> {
        let free = FreeFunction::read(&canonical_name(text)).map_err(InputError::usage)?;
        let refuse = |message: String| Err(InputError::usage(message));
        if free != free.original() {
            return refuse(format!("the name of a function has no `_`: {}", shown(text)));
        }
        if is_abbreviation(free.name()) {
            return refuse(format!("`{}` is the name of an elementary function", free.name()));
        }
        if let Some(other) = free.arguments().iter().find(|name| !known.coordinates.contains(name))
        {
            return refuse(format!(
                "`{}` has the argument `{other}`, which is not a coordinate",
                free.name()
            ));
        }
        // the names of a function and of its derivatives, such as `a` and `a_t`, must not be used
        // otherwise. A basis vector `d_x` is allowed, because it has no arguments, unlike the
        // derivative `d_x(x)`
        let is = |name: &str| {
            FreeFunction::new(name, free.arguments()).is_ok_and(|own| own.original() == free)
        };
        let labels = names.labels.keys().filter(|label| *label == free.name());
        let declared = names.parameters.into_iter().flatten().chain(labels);
        let others = known.free.iter().map(FreeFunction::name);
        if let Some(taken) = declared.map(String::as_str).chain(others).find(|name| is(name)) {
            return refuse(format!("the function name `{}` is already in use", shown(taken)));
        }
        Ok(free)
    }
}
