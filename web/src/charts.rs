//! Charts and spacetimes with a name: definitions of the folder of examples.

/// A chart: its name, other names in the form of [`plain`], and its definition.
struct Chart(&'static str, &'static [&'static str], &'static str);

const CHARTS: [Chart; 11] = [
    Chart("Schwarzschild", &[], include_str!("../../examples/definitions/schwarzschild.toml")),
    Chart("Kerr", &[], include_str!("../../examples/definitions/kerr.toml")),
    Chart(
        "Friedmann",
        &["flrw", "expandinguniverse", "robertsonwalker"],
        include_str!("../../examples/definitions/expanding_universe.toml"),
    ),
    Chart(
        "sphere",
        &["2sphere", "s^2", "s2"],
        include_str!("../../examples/definitions/sphere.toml"),
    ),
    Chart("3-sphere", &["hopf", "s^3", "s3"], include_str!("../../examples/definitions/hopf.toml")),
    Chart(
        "hyperbolic plane",
        &["h^2", "poincarehalfplane"],
        include_str!("../../examples/definitions/hyperbolic_plane.toml"),
    ),
    Chart(
        "Poincare half space",
        &["hyperbolicspace", "h^3"],
        include_str!("../../examples/definitions/poincare_half_space.toml"),
    ),
    Chart("Euler angles", &[], include_str!("../../examples/definitions/euler_angles.toml")),
    Chart("Gibbs vector", &[], include_str!("../../examples/definitions/gibbs_vector.toml")),
    Chart("rotation vector", &[], include_str!("../../examples/definitions/rotation_vector.toml")),
    Chart(
        "Schwarzschild observers",
        &[],
        include_str!("../../examples/definitions/schwarzschild_static.toml"),
    ),
];

/// The names of the charts.
pub(super) fn names() -> Vec<&'static str> {
    CHARTS.iter().map(|Chart(name, ..)| *name).collect()
}

/// The definition of the chart with this name.
pub(super) fn find(name: &str) -> Option<&'static str> {
    let name = plain(name);
    let name = name.trim_end_matches("metric").trim_end_matches("spacetime");
    let named = |Chart(own, others, _): &&Chart| plain(own) == name || others.contains(&name);
    CHARTS.iter().find(named).map(|Chart(.., definition)| *definition)
}

/// A name in lower case, without blanks, hyphens and accents.
fn plain(name: &str) -> String {
    let letters = name.chars().filter(|c| !c.is_whitespace() && !"-_".contains(*c));
    letters.flat_map(char::to_lowercase).map(|c| if c == 'é' { 'e' } else { c }).collect()
}
