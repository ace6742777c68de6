//! The rows of the document are the tests of the equations: every equation has a row, its checks
//! have the expected outcomes, and `docs/paper.md` is this document.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use affinor_paper::{Paper, PaperFormat, Row, Status};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// An equation such as (57) or (A8): its letter and its number.
type Equation = (String, usize);

fn equation(text: &str) -> Option<Equation> {
    let digits = text.find(|c: char| c.is_ascii_digit())?;
    let letter = text[..digits].to_lowercase();
    (letter.len() < 2).then_some((letter, text[digits..].parse().ok()?))
}

fn through(first: &Equation, last: &Equation) -> impl Iterator<Item = Equation> {
    assert!(first.0 == last.0 && first.1 < last.1, "{first:?} to {last:?}");
    let letter = first.0.clone();
    (first.1..=last.1).map(move |number| (letter.clone(), number))
}

/// The equations of a row: `(17), (18)` or `(19)-(24)`.
fn equations(numbers: &str) -> Vec<Equation> {
    let inside = |text: &str| equation(text.trim_matches(|c| c == '(' || c == ')'));
    let ranges = numbers.split(", ").map(|part| match part.split_once('-') {
        Some((first, last)) => {
            through(&inside(first).unwrap(), &inside(last).unwrap()).collect::<Vec<_>>()
        }
        None => vec![inside(part).unwrap()],
    });
    ranges.flatten().collect()
}

fn expected() -> BTreeSet<Equation> {
    let all = |letter: &str, last: usize| {
        let letter = letter.to_string();
        (1..=last).map(move |number| (letter.clone(), number))
    };
    all("", 109).chain(all("a", 10)).chain(all("b", 14)).collect()
}

/// The root of the project.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

static PAPER: LazyLock<Paper> = LazyLock::new(|| Paper::read().unwrap());

fn rows() -> impl Iterator<Item = &'static Row> {
    PAPER.sections.iter().flat_map(|section| &section.rows)
}

#[test]
fn every_equation_has_one_row() {
    let (mut found, mut remarks) = (BTreeSet::new(), 0);
    for row in rows() {
        if row.equation.starts_with('(') {
            for equation in equations(row.equation) {
                assert!(found.insert(equation.clone()), "{equation:?} has two rows");
            }
        } else {
            remarks += 1;
        }
        assert!(!row.findings.is_empty(), "{}: nothing is computed", row.equation);
    }
    assert_eq!(found, expected());
    assert!(remarks > 10, "{remarks}");
}

/// Every entry has a name of its own, in the heading of the HTML document.
#[test]
fn every_entry_has_its_own_name() {
    let mut written = vec![];
    PAPER.write(PaperFormat::Html, &[], &mut written).unwrap();
    let written = String::from_utf8(written).unwrap();
    let names: BTreeSet<&str> = rows().map(|row| row.name).collect();
    assert_eq!(names.len(), rows().count());
    for name in names {
        let heading = format!("<span class=\"name\">{}</span>", name.replace('\'', "&#x27;"));
        let plain = format!("<span class=\"name\">{name}</span>");
        assert!(written.contains(&heading) || written.contains(&plain), "{name}");
    }
}

#[test]
fn every_finding_has_its_expected_outcome() {
    let findings = rows().flat_map(|row| row.findings.iter().map(move |finding| (row, finding)));
    let unexpected = findings.filter(|(_, finding)| !finding.is_expected());
    let unexpected: Vec<String> = unexpected
        .map(|(row, finding)| format!("{}: {}: {}", row.equation, finding.claim, finding.words()))
        .collect();
    assert!(unexpected.is_empty(), "{}", unexpected.join("\n"));
}

/// A statement that is too strong has a finding that refutes it.
#[test]
fn what_is_too_strong_is_refuted() {
    for row in rows() {
        let refuted = row.findings.iter().any(|finding| finding.refuted);
        if let Status::TooStrong(remark) = row.status {
            assert!(refuted || remark.contains("sufficient"), "{}", row.equation);
        }
    }
}

/// Numbers printed in the paper: (46), the table after (65), (102), and Euler's equations (108).
#[test]
fn the_numbers_of_the_paper() {
    let claims = |equation: &str| -> Vec<String> {
        let rows = rows().filter(|row| row.equation == equation);
        rows.flat_map(|row| &row.findings).map(|finding| finding.claim.replace('`', "")).collect()
    };
    let has = |equation: &str, line: &str| {
        assert!(
            claims(equation).iter().any(|claim| claim == line),
            "{equation} {line}: {:?}",
            claims(equation)
        );
    };
    let alternating = |symbol: &str, value: &str| {
        let names = ["^1_23 = -", "^1_32 = ", "^2_31 = -", "^2_13 = ", "^3_12 = -", "^3_21"];
        names.map(|name| format!("{symbol}{name}")).concat() + " = " + value
    };
    has("(46)", &alternating("Lambda", "1"));
    has("(65)", &alternating("Lambda", "1/2"));
    has("(64)", &alternating("c", "1"));
    has("after (38)", &alternating("tau", "1"));
    has(
        "after (65)",
        "R^1_212 = -R^1_221 = R^1_313 = -R^1_331 = R^2_121 = -R^2_112 = R^2_323 = -R^2_332 \
         = R^3_131 = -R^3_113 = R^3_232 = -R^3_223 = 1/4",
    );
    has("after (65)", "S = 3/4 with the metric (102)");
    has("(102)", "ghat_11 = ghat_22 = ghat_33 = 2");
    has("(99)", "g_12 = g_21 = J12");
    has("(103)", "H_1 = J11*Omega1 + J12*Omega2 + J13*Omega3");
    has("(108)", "J11 dOmega1/dt = Omega2*Omega3*(J22 - J33) + M1");
}

/// `affinor paper --format markdown -o docs/paper.md` writes it anew.
#[test]
fn the_page_is_the_document() {
    let mut written = vec![];
    PAPER.write(PaperFormat::Markdown, &[], &mut written).unwrap();
    let page = fs::read_to_string(root().join("docs/paper.md")).unwrap();
    let written = String::from_utf8(written).unwrap();
    for (line, (found, expected)) in page.lines().zip(written.lines()).enumerate() {
        assert_eq!(found, expected, "docs/paper.md:{}", line + 1);
    }
    assert_eq!(page, written);
}

/// The LaTeX document has one paragraph per entry, is ASCII, and closes all braces, formulas and
/// environments.
#[test]
fn the_latex_document_is_closed() {
    let mut written = vec![];
    PAPER.write(PaperFormat::Latex, &[], &mut written).unwrap();
    let text = String::from_utf8(written).unwrap();
    assert!(text.is_ascii());
    let entries: usize = PAPER.sections.iter().map(|section| section.rows.len()).sum();
    assert_eq!(text.matches("\\paragraph{").count(), entries);
    let (mut open, mut environments) = (0_usize, vec![]);
    for (line, number) in text.lines().zip(1..) {
        let bare =
            ["\\\\", "\\{", "\\}", "\\$"].iter().fold(line.to_string(), |s, c| s.replace(c, ""));
        assert!(bare.matches('$').count() % 2 == 0, "line {number}: {line}");
        for c in bare.chars() {
            match c {
                '{' => open += 1,
                '}' => {
                    open = open.checked_sub(1).unwrap_or_else(|| panic!("line {number}: {line}"))
                }
                _ => {}
            }
        }
        assert_eq!(open, 0, "line {number}: {line}");
        for part in bare.split('\\').skip(1) {
            if let Some(name) = part.strip_prefix("begin{") {
                environments.push(name.split('}').next().unwrap().to_string());
            } else if let Some(name) = part.strip_prefix("end{") {
                assert_eq!(environments.pop().as_deref(), name.split('}').next(), "line {number}");
            }
        }
    }
    assert!(environments.is_empty(), "{environments:?}");
}

/// The text of an element, with bars as slashes.
fn content(node: roxmltree::Node) -> String {
    let inside = || node.children().filter(|child| child.is_element()).map(content);
    match node.tag_name().name() {
        "mfrac" => format!("({})", inside().collect::<Vec<_>>().join("/")),
        _ if node.children().any(|child| child.is_element()) => inside().collect(),
        // the sign between a function and its argument is not seen
        _ => node.text().unwrap_or_default().replace('\u{2061}', ""),
    }
}

fn balanced(text: &str) -> bool {
    let mut depth = 0;
    text.chars().all(|c| {
        depth += i32::from("([⟨".contains(c)) - i32::from(")]⟩".contains(c));
        depth >= 0
    }) && depth == 0
}

/// Every slash of a formula is a bar with whole factors above and below, signs are no hyphens, and nothing is words.
#[test]
fn every_bar_has_whole_factors() {
    let mut written = vec![];
    PAPER.write(PaperFormat::Html, &[], &mut written).unwrap();
    let text = String::from_utf8(written).unwrap();
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let page = roxmltree::Document::parse_with_options(&text, options).unwrap();
    let (mut parts, mut slashes) = (vec![], 0);
    for formula in page.descendants().filter(|node| node.has_tag_name("math")) {
        let alternative = formula.attribute("alttext").unwrap();
        slashes += alternative.matches('/').count();
        assert!(!content(formula).contains('-'), "{alternative}");
        assert!(!formula.descendants().any(|node| node.has_tag_name("mtext")), "{alternative}");
        for bar in formula.descendants().filter(|node| node.has_tag_name("mfrac")) {
            let part: Vec<String> =
                bar.children().filter(|child| child.is_element()).map(content).collect();
            assert!(part.len() == 2 && part.iter().all(|text| balanced(text)), "{alternative}");
            parts.push(part.join(" over "));
        }
    }
    assert_eq!(parts.len(), slashes);
    assert!(parts.len() > 50, "{parts:?}");
    for part in [
        "Ψ(t) over t",
        "sinθ over θ",
        "sin((θ/2)) over (θ/2)",
        "1−cosθ over θ2",
        "θ−sinθ over θ3",
        "Ω2Ω3(J22−J33) over 2",
        "DΩ over Dt",
        "D(JΩ) over Dt",
        "dΩj over dt",
    ] {
        assert!(parts.iter().any(|found| found == part), "{part}: {parts:?}");
    }

    // LaTeX has the same bars
    let mut written = vec![];
    PAPER.write(PaperFormat::Latex, &[], &mut written).unwrap();
    let latex = String::from_utf8(written).unwrap();
    assert_eq!(latex.matches("\\frac{").count(), slashes);
    for (at, bar) in latex.match_indices("\\frac{") {
        let rest = &latex[at + bar.len()..];
        let above = &rest[..closing(rest)];
        let below = rest[above.len() + 1..].strip_prefix('{').unwrap();
        let below = &below[..closing(below)];
        assert!([above, below].iter().all(|part| balanced(part)), "{above} over {below}");
    }
}

/// The position of the brace that closes one in front of the text.
fn closing(text: &str) -> usize {
    let mut depth = 0;
    let closes = |(_, c): &(usize, char)| {
        depth += i32::from(*c == '{') - i32::from(*c == '}');
        depth < 0
    };
    text.char_indices().find(closes).unwrap().0
}

/// `Type::function` and modules are words of the source.
#[test]
fn every_function_exists() {
    let root = root();
    let mut source = String::new();
    let mut open = vec![root.join("src"), root.join("documents/src")];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                source += &fs::read_to_string(&path).unwrap();
            }
        }
    }
    let mut found = 0;
    for code in rows().flat_map(|row| &row.functions) {
        for word in code.split("::") {
            let kinds = ["fn ", "struct ", "trait ", "mod ", "pub "];
            let known = kinds.iter().any(|kind| {
                source.match_indices(&format!("{kind}{word}")).any(|(at, name)| {
                    !source[at + name.len()..]
                        .starts_with(|c: char| c.is_alphanumeric() || c == '_')
                })
            });
            assert!(known, "`{code}`: {word}");
            found += 1;
        }
    }
    assert!(found > 80, "{found}");
}

#[test]
fn numbers_of_equations_are_read() {
    let plain = |numbers: &[usize]| numbers.iter().map(|n| (String::new(), *n)).collect::<Vec<_>>();
    assert_eq!(equations("(9), (10)"), plain(&[9, 10]));
    assert_eq!(equations("(1)-(4)"), plain(&[1, 2, 3, 4]));
    assert_eq!(equations("(A3)-(A8)").len(), 6);
}
