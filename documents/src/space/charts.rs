//! Charts with a name: spacetimes, surfaces and classical spaces. Each is a definition file in the
//! folder `charts` of this package, with its source.

use super::Definition;
use crate::input::InputError;

/// A chart with a name.
#[derive(Clone, Copy, Debug)]
pub struct NamedChart {
    /// The name, in the form of [`plain`] but with hyphens.
    name: &'static str,
    /// Other names, in the form of [`plain`].
    aliases: &'static [&'static str],
    /// The definition file.
    text: &'static str,
}

/// The chart in the file with this name, with its other names.
macro_rules! chart {
    ($name:literal $(, $alias:literal)*) => {
        NamedChart {
            name: $name,
            aliases: &[$($alias),*],
            text: include_str!(concat!("../../charts/", $name, ".toml")),
        }
    };
}

/// Solutions of Einstein's equations, and other Lorentzian metrics.
#[rustfmt::skip]
const SPACETIMES: [NamedChart; 44] = [
    chart!("minkowski", "flatspacetime"),
    chart!("rindler"),
    chart!("milne"),
    chart!("de-sitter", "desitterspace"),
    chart!("de-sitter-static"),
    chart!("anti-de-sitter", "ads"),
    chart!("anti-de-sitter-static"),
    chart!("einstein-static", "einsteinuniverse"),
    chart!("friedmann", "flrw", "expandinguniverse", "robertsonwalker"),
    chart!("friedmann-dust", "einsteindesitter"),
    chart!("schwarzschild"),
    chart!("schwarzschild-isotropic"),
    chart!("schwarzschild-observers"),
    chart!("eddington-finkelstein"),
    chart!("painleve-gullstrand", "gullstrandpainleve"),
    chart!("lemaitre-tolman", "lemaitretolmanbondi", "ltb"),
    chart!("schwarzschild-de-sitter", "kottler"),
    chart!("reissner-nordstrom", "reissnernordstroem"),
    chart!("bardeen"),
    chart!("hayward"),
    chart!("vaidya"),
    chart!("kerr"),
    chart!("kerr-newman"),
    chart!("taub-nut"),
    chart!("kasner"),
    chart!("bianchi-i"),
    chart!("kantowski-sachs"),
    chart!("goedel", "godel"),
    chart!("bertotti-robinson"),
    chart!("nariai"),
    chart!("pp-wave", "ppwaves"),
    chart!("plane-wave", "gravitationalwave"),
    chart!("cahen-wallach"),
    chart!("ellis-wormhole", "wormhole", "morristhorne"),
    chart!("cosmic-string"),
    chart!("melvin", "bonnormelvin"),
    chart!("van-stockum"),
    chart!("levi-civita-cylinder"),
    chart!("curzon-chazy"),
    chart!("weyl"),
    chart!("c-metric"),
    chart!("petrov"),
    chart!("btz", "banadosteitelboimzanelli"),
    chart!("tangherlini", "schwarzschildtangherlini"),
];

/// Surfaces, Riemannian spaces, and charts of the rotation group.
#[rustfmt::skip]
const SPACES: [NamedChart; 25] = [
    chart!("eguchi-hanson"),
    chart!("sphere", "2sphere"),
    chart!("ellipsoid", "spheroid"),
    chart!("torus"),
    chart!("cylinder"),
    chart!("cone"),
    chart!("catenoid"),
    chart!("helicoid"),
    chart!("enneper", "enneperssurface"),
    chart!("pseudosphere"),
    chart!("paraboloid"),
    chart!("hyperbolic-paraboloid"),
    chart!("graph"),
    chart!("surface-of-revolution"),
    chart!("hyperbolic-plane", "poincarehalfplane", "halfplane"),
    chart!("poincare-disk", "poincaredisc"),
    chart!("hyperbolic-space", "poincarehalfspace"),
    chart!("3-sphere", "hopf"),
    chart!("berger-sphere"),
    chart!("nil-geometry"),
    chart!("sol-geometry"),
    chart!("fubini-study"),
    chart!("euler-angles"),
    chart!("gibbs-vector"),
    chart!("rotation-vector"),
];

impl NamedChart {
    /// All charts with a name: first spacetimes, then surfaces and other spaces.
    pub fn all() -> impl Iterator<Item = &'static NamedChart> {
        SPACETIMES.iter().chain(&SPACES)
    }

    /// Whether the chart is one of a spacetime.
    pub fn is_spacetime(&self) -> bool {
        SPACETIMES.iter().any(|chart| chart.name == self.name)
    }

    /// The chart that a name means. Capitals, blanks, hyphens, accents, and the words "metric" and
    /// "spacetime" at the end make no difference.
    ///
    /// ```
    /// use affinor_documents::space::NamedChart;
    /// let chart = NamedChart::find("Gödel spacetime").expect("a chart of the catalogue");
    /// assert_eq!(chart.name(), "goedel");
    /// assert_eq!(chart.definition()?.coordinates(), ["t", "x", "y", "z"]);
    /// # Ok::<(), affinor_documents::input::InputError>(())
    /// ```
    pub fn find(name: &str) -> Option<&'static NamedChart> {
        let name = plain(name);
        let named = |name: &str| {
            Self::all().find(|chart| plain(chart.name) == name || chart.aliases.contains(&name))
        };
        let ending = |word: &str| named(name.strip_suffix(word)?);
        named(&name).or_else(|| ending("metric")).or_else(|| ending("spacetime"))
    }

    /// The name by which the program lists the chart.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The definition: the coordinates and the metric.
    ///
    /// # Errors
    /// None for the charts of the catalogue, which a test reads.
    pub fn definition(&self) -> Result<Definition, InputError> {
        Definition::parse(self.name, self.text)
    }
}

/// The name of a chart that differs from this name by few letters.
pub(super) fn nearest(name: &str) -> Option<&'static str> {
    let name = plain(name);
    let distance = |chart: &NamedChart| strsim::damerau_levenshtein(&plain(chart.name), &name);
    let close = NamedChart::all().map(|chart| (distance(chart), chart.name));
    let close = close.filter(|(letters, chart)| *letters < 3 && 3 * letters < chart.len());
    close.min().map(|(_, chart)| chart)
}

/// A name in lower case, without blanks, hyphens and accents.
fn plain(name: &str) -> String {
    let letters = name.chars().filter(|c| !c.is_whitespace() && !"-_".contains(*c));
    let ascii = |c: char| match c {
        'é' | 'è' | 'ê' => "e".into(),
        'ö' | 'ø' => "oe".into(),
        'ñ' => "n".into(),
        'î' => "i".into(),
        c => c.to_string(),
    };
    letters.flat_map(char::to_lowercase).map(ascii).collect()
}
