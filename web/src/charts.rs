//! Charts and spacetimes with a name: definitions of the folder of examples.

/// A name, without blanks and in lower case, and its definition.
const CHARTS: [(&[&str], &str); 11] = [
    (&["schwarzschild"], include_str!("../../examples/definitions/schwarzschild.toml")),
    (&["kerr"], include_str!("../../examples/definitions/kerr.toml")),
    (
        &["friedmann", "flrw", "expandinguniverse", "robertsonwalker"],
        include_str!("../../examples/definitions/expanding_universe.toml"),
    ),
    (&["sphere", "2sphere", "s^2", "s2"], include_str!("../../examples/definitions/sphere.toml")),
    (&["hopf", "3sphere", "s^3", "s3"], include_str!("../../examples/definitions/hopf.toml")),
    (
        &["hyperbolicplane", "h^2", "poincarehalfplane"],
        include_str!("../../examples/definitions/hyperbolic_plane.toml"),
    ),
    (
        &["poincarehalfspace", "hyperbolicspace", "h^3"],
        include_str!("../../examples/definitions/poincare_half_space.toml"),
    ),
    (&["eulerangles"], include_str!("../../examples/definitions/euler_angles.toml")),
    (&["gibbsvector"], include_str!("../../examples/definitions/gibbs_vector.toml")),
    (&["rotationvector"], include_str!("../../examples/definitions/rotation_vector.toml")),
    (
        &["schwarzschildobservers"],
        include_str!("../../examples/definitions/schwarzschild_static.toml"),
    ),
];

/// Names of charts for suggestions.
pub(super) const NAMES: [&str; 9] = [
    "Schwarzschild",
    "Kerr",
    "Friedmann",
    "sphere",
    "3-sphere",
    "hyperbolic plane",
    "Poincare half space",
    "Euler angles",
    "Gibbs vector",
];

/// The definition of a chart with this name.
pub(super) fn find(name: &str) -> Option<&'static str> {
    let plain = |c: char| match c {
        'é' => 'e',
        other => other,
    };
    let name: String = name
        .chars()
        .filter(|c| !c.is_whitespace() && !"-_".contains(*c))
        .flat_map(char::to_lowercase)
        .map(plain)
        .collect();
    let name = name.trim_end_matches("metric").trim_end_matches("spacetime");
    CHARTS.iter().find(|(names, _)| names.contains(&name)).map(|(_, text)| *text)
}
