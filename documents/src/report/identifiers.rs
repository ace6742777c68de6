//! Converts names to ASCII identifiers that programs accept.

use std::borrow::Cow;

/// The names of the Greek letters from alpha to omega, including the final sigma.
const GREEK: [&str; 25] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon", "phi",
    "chi", "psi", "omega",
];

/// Converts names to distinct identifiers. ASCII names are unchanged if they are distinct.
pub(super) fn identifiers(names: &[impl AsRef<str>]) -> Vec<String> {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    let mut taken: Vec<String> = vec![];
    for name in &names {
        let identifier = match transliterated(name) {
            Cow::Borrowed(own) if !taken.iter().any(|other| other == own) => own.to_string(),
            other => {
                let free = |own: &String| !taken.contains(own) && !names.contains(&own.as_str());
                let numbered = (2..).map(|at| format!("{other}_{at}"));
                let mut tried = std::iter::once(other.to_string()).chain(numbered);
                tried.find(free).unwrap_or_default()
            }
        };
        taken.push(identifier);
    }
    taken
}

/// Writes out Greek letters, and writes other non-ASCII letters as numbers: `theta_1` for `θ_1`.
fn transliterated(name: &str) -> Cow<'_, str> {
    if name.is_ascii() {
        return name.into();
    }
    let mut text = String::new();
    for c in name.chars() {
        let code = u32::from(c);
        let capital = ('Α'..='Ω').contains(&c);
        let greek = code.checked_sub(u32::from(if capital { 'Α' } else { 'α' }));
        let greek = greek.and_then(|at| GREEK.get(at as usize));
        match (c, greek) {
            _ if c.is_ascii() => text.push(c),
            ('₀'..='₉', _) => text += &(code - u32::from('₀')).to_string(),
            ('ϑ', _) => text += "vartheta",
            ('ϕ', _) => text += "varphi",
            ('ϵ', _) => text += "varepsilon",
            (_, Some(letter)) if capital => {
                text += &letter[..1].to_ascii_uppercase();
                text += &letter[1..];
            }
            (_, Some(letter)) => text += letter,
            _ => text += &format!("u{code:X}"),
        }
    }
    text.into()
}

#[cfg(test)]
mod tests {
    use super::identifiers;

    #[test]
    fn letters_have_names() {
        let names = ["Θ", "ω_1", "φ₂", "é", "x_1", "ς", "σ", "Σ"];
        let expected = ["Theta", "omega_1", "phi2", "uE9", "x_1", "sigma", "sigma_2", "Sigma"];
        assert_eq!(identifiers(&names), expected);
    }

    #[test]
    fn identifiers_differ_and_names_in_ascii_are_kept() {
        let names = ["θ", "theta", "theta_2", "θ_2", "θ"];
        assert_eq!(identifiers(&names), ["theta_3", "theta", "theta_2", "theta_2_2", "theta_4"]);
    }
}
