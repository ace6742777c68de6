//! Options for the output of source code: the language, and derivatives.

use super::failure::Failure;
use super::options::{Scalar, Shared};
use super::output::deliver;
use super::stages::Stages;
use affinor_documents::input::InputError;
use affinor_documents::report::Language;
use affinor_documents::space::{Definition, Space};
use clap::Args;

#[derive(Args)]
pub struct CodeOptions {
    /// Print a function that computes the components in double precision, in this language: rust,
    /// c, or python (NumPy)
    #[arg(long, value_name = "LANGUAGE", value_parser = language, conflicts_with = "format")]
    pub code: Option<Language>,
    /// With --code, also compute the partial derivatives with respect to these parameters or
    /// coordinates, separated by commas
    #[arg(long, value_name = "NAMES", requires = "code", value_delimiter = ',')]
    pub derivatives: Vec<String>,
}

impl CodeOptions {
    /// The language of the requested source code, if any. Source code is written from exact
    /// formulas, so other scalars are an error.
    pub fn language(&self, shared: &Shared) -> Result<Option<Language>, InputError> {
        match self.code {
            Some(_) if shared.scalar == Scalar::Float => Err(InputError::usage(
                "--code cannot be combined with --scalar float, because it writes exact formulas",
            )
            .help("leave --scalar float out: the program computes in double precision")),
            language => Ok(language),
        }
    }

    /// The names given to `--derivatives`. Each name must be a parameter or a coordinate of the
    /// space.
    pub fn derivatives(&self, definition: &Definition) -> Result<Vec<String>, InputError> {
        let mut known = [definition.parameters().as_slice(), definition.coordinates()].concat();
        let declared = definition.known_parameters();
        known.extend(declared.into_iter().filter(|name| !known.contains(name)).collect::<Vec<_>>());
        let mut names: Vec<String> = Vec::new();
        for name in self.derivatives.iter().map(|name| name.trim()) {
            if !known.iter().any(|own| own == name) {
                let message = format!("there is no parameter `{}`", name.escape_debug());
                return Err(InputError::usage(message).help(match known.as_slice() {
                    [] => "this space has no parameters".into(),
                    known => format!("the parameters are {}", known.join(", ")),
                }));
            }
            if names.iter().any(|own| own == name) {
                return Err(InputError::usage(format!("--derivatives names {name} twice")));
            }
            names.push(name.into());
        }
        Ok(names)
    }
}

/// Prints source code to standard output, or writes it to the file that the options name.
pub fn print(code: &str, space: &Space, shared: &Shared, stages: &Stages) -> Result<(), Failure> {
    stages.begin_output();
    let file = shared.output.file.as_deref();
    deliver(file, space.file.as_slice(), |out| out.write_all(code.as_bytes()))
}

fn language(name: &str) -> Result<Language, String> {
    Language::from_name(name).ok_or_else(|| {
        format!("the languages are {}", Language::ALL.map(Language::name).join(", "))
    })
}
