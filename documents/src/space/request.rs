//! The SPACE of a command line, together with the options that complete it.

use crate::input::{
    Files, InputError, Source,
    forms::{MetricText, Text},
};
use crate::space::{
    Definition, MetricChoice, Origin, add,
    catalogue_name::with_nearest,
    named::{is_path, named_space},
    notation::{self, Names, basis, lines, metric, statement},
    setting::settings,
    spelling, tables, typed,
};
use affinor_tensors::{Kind, Symbolic};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The arguments of the command line that define a space.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The SPACE, which may contain `@connection;metric=...`.
    pub space: Option<String>,
    /// A definition instead of SPACE: a name for messages, and the text of a definition file.
    pub definition: Option<(String, String)>,
    /// An alternative to SPACE: a text that is typed into a field ([`typed`](super::typed)).
    pub typed: Option<String>,
    /// The names of the basis vectors of brackets given inline.
    pub basis: Option<String>,
    /// Brackets given inline.
    pub brackets: Vec<String>,
    /// The option `--connection`.
    pub connection: Option<String>,
    /// The option `--metric`.
    pub metric: Option<String>,
    /// The option `--conformal-factor`: a function whose square multiplies the metric.
    pub conformal_factor: Option<String>,
    /// The option `--set`, of the form `name=value,...`.
    pub set: Option<String>,
    /// The cache of files.
    pub files: Files,
}

/// The choice of the scalar type of a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ScalarChoice {
    /// Rational numbers, or rational functions if parameters remain.
    #[default]
    Exact,
    /// Floats with tracked rounding errors ([`TrackedFloat`](affinor_tensors::TrackedFloat)).
    Float,
}

/// A space that was read from a request.
#[derive(Clone, Debug)]
pub struct Space {
    /// The definition of the space.
    pub definition: Definition,
    /// The parameters that the command line introduced.
    pub introduced: Vec<String>,
    /// The file from which the space was read; `None` if it was not read from a file.
    pub file: Option<PathBuf>,
    /// The values of the parameters that were set.
    pub values: BTreeMap<String, Symbolic>,
}

impl Space {
    /// Reads the space of a request.
    ///
    /// # Errors
    /// An error with its location, for a name that is unknown or ambiguous, for a file that cannot
    /// be read, and for an invalid value.
    pub fn open(request: &Request) -> Result<Self, InputError> {
        let files = &request.files;
        let inside = match (&request.space, &request.typed) {
            (Some(space), _) => split_space(space, files)?,
            (None, Some(text)) if is_completed(text) => split_space(text, files)?,
            _ => Request::default(),
        };
        let definition = Self::definition_of(request, &inside)?;
        let is_file = |name: &String| !tables::is_inline(name);
        let declared = match (&request.basis, &inside.space) {
            _ if request.typed.is_some() => vec![],
            (None, space) if space.as_ref().is_none_or(is_file) => definition.parameters(),
            _ => vec![],
        };
        let mut space = Self::of(definition);
        space.file = inside.space.filter(|name| is_path(name)).map(|name| match name.as_str() {
            // the path of standard input, for messages and comparisons; on some systems it does not
            // exist
            "-" => PathBuf::from("/dev/stdin"),
            path => PathBuf::from(path),
        });
        let given = [(&inside.metric, "@metric"), (&request.metric, "--metric")];
        for (text, origin) in given {
            if let Some(text) = text {
                let (source, n) = (Source::new(origin, text), space.definition.dimension());
                space.set_metric(|names| metric(n, names, &source))?;
            }
        }
        if let Some(text) = &request.conformal_factor {
            let source = Source::new("--conformal-factor", text);
            let labels = space.labels();
            let names = Names::open(&labels, space.definition.functions());
            let factor = names.scalar(source.content(), &source)?;
            space.definition.rescale_metric(&factor)?;
            // the result is about another metric than the one of this name
            space.definition.name += &format!(", metric times ({factor})^2");
        }
        let given = [(&inside.connection, "@connection"), (&request.connection, "--connection")];
        for (text, origin) in given {
            if let Some(text) = text {
                space.set_connection(&Source::new(origin, text))?;
            }
        }
        space.introduce(&declared);
        if let Some(text) = &request.set {
            space.set(text, &[])?;
        }
        Ok(space)
    }

    /// The definition of a request without its connection and metric.
    fn definition_of(request: &Request, inside: &Request) -> Result<Definition, InputError> {
        let files = &request.files;
        if let Some(text) = &request.typed {
            let text = inside.space.as_ref().unwrap_or(text);
            return Ok(typed::definition(text)?.0);
        }
        let inline_brackets = !request.brackets.is_empty();
        match (&request.definition, &inside.space, &request.basis) {
            (Some((name, text)), None, None) if !inline_brackets => {
                Definition::parse_part(name, text, files)
            }
            (None, Some(name), None) if !inline_brackets => find(name, files),
            (None, None, Some(labels)) => inline(labels, &request.brackets),
            (None, None, None) => Err(InputError::usage("no SPACE is given")
                .help("name one (so3, E8, file.toml), or give --basis and --bracket")),
            _ => Err(InputError::usage("give a SPACE or --basis and --bracket, not both")),
        }
    }

    /// The space with this definition, without further options.
    pub(crate) fn of(definition: Definition) -> Self {
        Space { definition, introduced: vec![], file: None, values: BTreeMap::new() }
    }

    /// Adds the metric and the connection that a file contains, as far as they are given.
    pub(crate) fn completed_by(
        mut self,
        metric: Option<&MetricText>,
        connection: Option<&Text>,
        source: &Source,
    ) -> Result<Self, InputError> {
        let n = self.definition.dimension();
        if let Some(text) = metric {
            self.set_metric(|names| text.read(n, names, source))?;
        }
        if let Some(text) = connection {
            self.set_connection(&source.excerpt(text))?;
        }
        Ok(self)
    }

    /// The index of each basis vector, by name.
    pub(super) fn labels(&self) -> BTreeMap<String, usize> {
        let labels = self.definition.labels.iter().enumerate();
        labels.map(|(at, label)| (label.clone(), at)).collect()
    }

    fn set_metric(
        &mut self,
        read: impl FnOnce(&Names) -> Result<MetricChoice, InputError>,
    ) -> Result<(), InputError> {
        let labels = self.labels();
        let names = Names::open(&labels, self.definition.functions());
        let choice = read(&names).map_err(|error| match error.help {
            None if self.definition.is_homogeneous() => error.help(
                "on a homogeneous space, summands(a, b, ...) has one factor per isotropy summand",
            ),
            _ => error,
        })?;
        self.definition.set_metric(choice)
    }

    fn set_connection(&mut self, source: &Source) -> Result<(), InputError> {
        let labels = self.labels();
        let names = Names::open(&labels, self.definition.functions());
        let choice = notation::connection(&names, source)?;
        self.definition.connection = Some(choice);
        Ok(())
    }

    /// Replaces parameters by values, `name=value,...`. Names that are parameters of `others`, but
    /// not of this space, are ignored.
    ///
    /// # Errors
    /// Those of [`Definition::set`].
    pub fn set(&mut self, text: &str, others: &[String]) -> Result<(), InputError> {
        let source = Source::new("--set", text);
        let before = self.definition.parameters();
        let labels = self.labels();
        let names = Names::open(&labels, self.definition.functions());
        let mut values = settings(&source, &names)?;
        values.retain(|name, _| before.contains(name) || !others.contains(name));
        let set = self.definition.set(&values);
        set.map_err(|error| error.or_at(&source.whole(&source.text)))?;
        self.introduce(&before);
        self.values.extend(values);
        Ok(())
    }

    /// Records the parameters that are new since `before`.
    fn introduce(&mut self, before: &[String]) {
        let now = self.definition.parameters();
        self.introduced.extend(now.into_iter().filter(|name| !before.contains(name)));
    }

    /// The kind of scalars for the values of the space: rational numbers if the definition has no
    /// parameters, otherwise rational functions; floats if `choice` asks for them. See
    /// [`over_kind`](crate::over_kind).
    ///
    /// # Errors
    /// An error for floats on a chart, and for floats if parameters have no value.
    pub fn kind(&self, choice: ScalarChoice) -> Result<Kind, InputError> {
        match choice {
            ScalarChoice::Float if self.definition.is_on_chart() => {
                Err(on_chart().help("leave --scalar float out"))
            }
            ScalarChoice::Float => self.in_floats().map(|_| Kind::Float),
            ScalarChoice::Exact if self.definition.is_rational() => Ok(Kind::Exact),
            ScalarChoice::Exact => Ok(Kind::Symbolic),
        }
    }

    /// Returns the definition, after a check that its values are numbers.
    ///
    /// # Errors
    /// An error for a chart, because its functions must be exact, and for parameters without
    /// values.
    pub fn in_floats(&self) -> Result<&Definition, InputError> {
        if self.definition.is_on_chart() {
            return Err(on_chart().help("give a Lie algebra: this command computes in floats"));
        }
        let parameters = self.definition.parameters();
        if !parameters.is_empty() {
            let message = format!("floats need numbers for {}", parameters.join(", "));
            let help = "set them, as in --set \"J1=1/2,h=-1\"";
            return Err(InputError::usage(message).help(help));
        }
        Ok(&self.definition)
    }
}

/// The error for a computation in floats on a chart.
fn on_chart() -> InputError {
    InputError::usage("functions on a chart must be exact, because they are differentiated")
}

/// Whether a typed text is a name with a connection, `so3@plus`.
fn is_completed(text: &str) -> bool {
    text.contains('@') && !text.contains(['\n', '=', '['])
        || text.split_once('@').is_some_and(|(name, _)| !name.contains(['\n', '=', '[']))
}

/// Splits `NAME@connection;metric=...` into its parts.
fn split_space(space: &str, files: &Files) -> Result<Request, InputError> {
    let mut parts = Request::default();
    if is_path(space) && (files.content(space).is_some() || Path::new(space).is_file()) {
        return Ok(Request { space: Some(space.into()), ..parts });
    }
    let source = Source::new("SPACE", space);
    let space = &*source.text;
    let metric = |at: &usize| space[at + 1..].trim_start().starts_with("metric");
    let split = space.rsplit_once('@').or_else(|| match tables::is_inline(space) {
        // an inline table may contain semicolons between brackets, so the first one before `metric`
        // is used
        true => {
            let at = space.match_indices(';').map(|(at, _)| at).find(metric)?;
            Some((&space[..at], &space[at + 1..]))
        }
        false => space.split_once(';'),
    });
    let (name, behind) = split.unwrap_or((space, ""));
    if split.is_some() && behind.trim().is_empty() {
        let error = InputError::usage("the connection is missing after `@`");
        let place = source.find(space, name.len()..space.len());
        return Err(error.at(&place).help("write so3@plus, or the name alone"));
    }
    if let Some(first) = name.find('@').filter(|_| !is_path(name)) {
        let error = InputError::usage("more than one `@`: write one connection after a single `@`");
        let place = source.find(space, first..space.len());
        return Err(error.at(&place).help("write so3@levi-civita;metric=diag(1,2,3)"));
    }
    parts.space = Some(name.trim().into());
    for part in behind.split(';').map(str::trim).filter(|part| !part.is_empty()) {
        let (place, value) = match part.split_once('=') {
            Some((key, value)) if key.trim() == "metric" => (&mut parts.metric, value),
            _ => (&mut parts.connection, part),
        };
        if place.replace(value.trim().to_string()).is_some() {
            let error = InputError::usage("the connection or the metric is given twice");
            return Err(error.at(&source.whole(part)));
        }
    }
    Ok(parts)
}

/// Finds the definition that a name means: a geometry of Paraskevopoulos and Natsiavas (2013), a
/// file, a homogeneous space, or a sum of catalogue names.
fn find(name: &str, files: &Files) -> Result<Definition, InputError> {
    if let Some(table) = tables::inline(&Source::new("SPACE", name)) {
        return table;
    }
    if is_path(name) {
        let read = Definition::read_part(name, 0, files);
        return read.map_err(|error| match Path::new(name).exists() {
            true => error,
            false => with_nearest(error, name),
        });
    }
    named_space(&Source::new("SPACE", &spelling::folded(name)))
}

/// Reads brackets that are given on the command line.
fn inline(labels: &str, brackets: &[String]) -> Result<Definition, InputError> {
    let source = Source::new("--basis", labels);
    let labels = source.text.split([' ', ',', '\t', '\n']);
    let labels: Vec<&str> = labels.filter(|label| !label.is_empty()).collect();
    let indices = basis(&labels, &|at| source.whole(labels[at]))?;
    let names = Names { labels: &indices, parameters: None, functions: None, bare: false };
    let mut given = BTreeMap::new();
    for block in brackets {
        let source = Source::new("--bracket", block);
        for line in lines(&source.text) {
            let (pair, right) = statement(line, "", &names, &source)?;
            add(&mut given, pair, right)?;
        }
    }
    let labels = labels.into_iter().map(str::to_string).collect();
    Ok(Definition::new("inline algebra", labels, Origin::Brackets(given)))
}
