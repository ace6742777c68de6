//! The document about the paper keeps its word: all equations are there, each is shown by a test that names it, what is
//! computed comes out as it must, and `docs/paper.md` is this document.

use crate::program::root;
use affinor_documents::paper::{Paper, PaperFormat, Standing};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// The names of all tests.
fn tests(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            tests(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            for rest in text.split("#[test]").skip(1) {
                let name = rest.split_once("fn ").and_then(|(_, rest)| rest.split_once('('));
                found.insert(name.unwrap().0.to_string());
            }
        }
    }
}

/// A row such as `57` or `a8`: its letter and its number.
type Row = (String, usize);

fn row(text: &str) -> Option<Row> {
    let digits = text.find(|c: char| c.is_ascii_digit())?;
    let letter = text[..digits].to_lowercase();
    (letter.len() < 2).then_some((letter, text[digits..].parse().ok()?))
}

fn through(first: &Row, last: &Row) -> impl Iterator<Item = Row> {
    assert!(first.0 == last.0 && first.1 < last.1, "{first:?} to {last:?}");
    let letter = first.0.clone();
    (first.1..=last.1).map(move |number| (letter.clone(), number))
}

/// The rows of a name: `eq_52_to_56_and_59_..`.
fn rows_of_test(name: &str) -> Vec<Row> {
    let words: Vec<&str> = name.split('_').collect();
    let mut rows: Vec<Row> = vec![];
    if words[0] != "eq" {
        return rows;
    }
    rows.extend(words.get(1).and_then(|word| row(word)));
    for pair in words[2.min(words.len())..].chunks(2) {
        match (pair, pair.get(1).and_then(|word| row(word)), rows.last().cloned()) {
            (["and", _], Some(next), _) => rows.push(next),
            (["to", _], Some(next), Some(last)) => rows.extend(through(&last, &next).skip(1)),
            _ => break,
        }
    }
    rows
}

/// The rows of a cell: `(17), (18)` or `(19)-(24)`.
fn rows_of_cell(cell: &str) -> Vec<Row> {
    let inside = |text: &str| row(text.trim_matches(|c| c == '(' || c == ')'));
    let ranges = cell.split(", ").map(|part| match part.split_once('-') {
        Some((first, last)) => {
            through(&inside(first).unwrap(), &inside(last).unwrap()).collect::<Vec<_>>()
        }
        None => vec![inside(part).unwrap()],
    });
    ranges.flatten().collect()
}

fn expected() -> BTreeSet<Row> {
    let rows = |letter: &str, last: usize| {
        let letter = letter.to_string();
        (1..=last).map(move |number| (letter.clone(), number))
    };
    rows("", 109).chain(rows("a", 10)).chain(rows("b", 14)).collect()
}

static PAPER: LazyLock<Paper> = LazyLock::new(|| Paper::read().unwrap());

#[test]
fn every_row_is_shown_by_a_test() {
    let mut names = BTreeSet::new();
    tests(&root().join("tests"), &mut names);
    let tested: BTreeSet<Row> = names.iter().flat_map(|name| rows_of_test(name)).collect();
    let (mut claimed, mut remarks) = (BTreeSet::new(), 0);
    for entry in PAPER.sections.iter().flat_map(|section| &section.rows) {
        let cell = entry.equation;
        if cell.starts_with('(') {
            for row in rows_of_cell(cell) {
                assert!(tested.contains(&row), "no test shows {row:?}");
                assert!(claimed.insert(row.clone()), "{row:?} stands twice");
            }
        } else if cell.ends_with(')') {
            // `after (71)`: a test `after_71_..`
            let name = cell.replace(['(', ')'], "").replace(' ', "_");
            let shown = names.iter().any(|test| test.contains(&format!("{name}_")));
            assert!(shown, "no test `{name}_..`");
            remarks += 1;
        }
        assert!(!entry.findings.is_empty(), "{cell}: nothing is computed");
    }
    assert_eq!(claimed, expected());
    assert!(remarks > 10, "{remarks}");
}

#[test]
fn whatever_is_computed_comes_out_as_it_must() {
    for entry in PAPER.sections.iter().flat_map(|section| &section.rows) {
        for finding in &entry.findings {
            let words = finding.words();
            assert!(finding.is_expected(), "{}: {}: {words}", entry.equation, finding.claim);
        }
        // what is too strong, or a misprint of a formula, has its witness
        let refuted = entry.findings.iter().any(|finding| finding.refuted);
        if let Standing::TooStrong(remark) = entry.standing {
            assert!(refuted || remark.contains("sufficient"), "{}", entry.equation);
        }
    }
}

/// The numbers that the paper prints: (46), the table after (65), (102), and Euler's equations (108).
#[test]
fn the_numbers_of_the_paper() {
    let claims = |equation: &str| -> Vec<String> {
        let rows = PAPER.sections.iter().flat_map(|section| &section.rows);
        let rows = rows.filter(|row| row.equation == equation);
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

/// For pdfLaTeX: an entry a paragraph, in ASCII, with all braces, formulas and environments closed.
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

/// It is well-formed, its links lead to its own elements, and nothing is fetched from elsewhere.
#[test]
fn html_stands_alone() {
    let text = crate::program::stdout(root(), &["paper"]);
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(&text, options).unwrap();
    let elements = || document.descendants().filter(|node| node.is_element());
    let mut ids = BTreeSet::new();
    for id in elements().filter_map(|node| node.attribute("id")) {
        assert!(ids.insert(id), "{id} stands twice");
    }
    for node in elements() {
        let name = node.tag_name().name();
        assert!(!["script", "link", "iframe", "img"].contains(&name), "{name}");
        assert!(node.attribute("src").is_none(), "{name}");
        if let Some(link) = node.attribute("href") {
            match link.strip_prefix('#') {
                Some(id) => assert!(ids.contains(id), "{link} leads nowhere"),
                // relative to the repository
                None => assert!(root().join(link).is_file(), "{link} leads nowhere"),
            }
        }
    }
    assert!(!text.contains("@import") && !text.contains("url("));
    let count = |name: &str| elements().filter(|node| node.tag_name().name() == name).count();
    assert_eq!((count("h1"), count("main")), (1, 1));
    assert_eq!(count("figure"), 5);
    assert!(count("math") > 300);
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

/// A function is a link to the file that defines it, a test one to a file with a test of the equation.
#[test]
fn links_lead_to_functions_and_tests() {
    let read = |file: &str| {
        assert!(!file.contains('#'), "{file}: lines move");
        fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    };
    let (mut functions, mut tests) = (0, 0);
    for row in PAPER.sections.iter().flat_map(|section| &section.rows) {
        for (name, file) in row.sources() {
            let file = file.unwrap_or_else(|| panic!("`{name}` is no link"));
            let (text, last) = (read(file), name.rsplit("::").next().unwrap());
            let kinds = ["fn ", "struct ", "trait ", "enum "];
            let defined = kinds.iter().any(|kind| {
                text.match_indices(&format!("{kind}{last}")).any(|(at, found)| {
                    text[at + found.len()..].starts_with(['(', '<', ' ', ';', '{'])
                })
            });
            assert!(defined, "{file} does not define `{name}`");
            functions += 1;
        }
        for file in row.tests() {
            let mut names = BTreeSet::new();
            for rest in read(file).split("#[test]").skip(1) {
                let name = rest.split_once("fn ").and_then(|(_, rest)| rest.split_once('('));
                names.insert(name.unwrap().0.to_string());
            }
            let tested: BTreeSet<Row> = names.iter().flat_map(|name| rows_of_test(name)).collect();
            let plain = row.equation.replace(['(', ')'], "");
            let shown = match row.equation.starts_with('(') {
                true => rows_of_cell(row.equation).iter().any(|row| tested.contains(row)),
                // `after (71)` by its own test, `at (72)` by that of the equation
                false => {
                    let words: Vec<&str> = plain.split(' ').collect();
                    let number = words.last().and_then(|word| super::paper_page::row(word));
                    names.iter().any(|name| name.contains(&format!("{}_", words.join("_"))))
                        || number.is_some_and(|number| tested.contains(&number))
                }
            };
            assert!(shown, "{file} has no test of {}", row.equation);
            tests += 1;
        }
    }
    assert!(functions > 80 && tests > 80, "{functions} {tests}");
}

/// `Type::function` and modules are words of the source.
#[test]
fn every_function_exists() {
    let root = root();
    let mut source = String::new();
    let mut open = vec![root.join("src"), root.join("documents/src"), root.join("cli/src")];
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
    let rows = PAPER.sections.iter().flat_map(|section| &section.rows);
    let mut found = 0;
    for code in rows.flat_map(|row| &row.functions) {
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
fn names_are_read() {
    let plain = |numbers: &[usize]| numbers.iter().map(|n| (String::new(), *n)).collect::<Vec<_>>();
    assert_eq!(rows_of_test("eq_41_and_52_to_54_the_velocity"), plain(&[41, 52, 53, 54]));
    assert_eq!(
        rows_of_test("eq_a3_to_a5"),
        ["a"; 3].into_iter().map(String::from).zip(3..).collect::<Vec<_>>()
    );
    assert_eq!(rows_of_test("after_71_holonomy"), []);
    assert_eq!(rows_of_cell("(9), (10)"), plain(&[9, 10]));
    assert_eq!(rows_of_cell("(1)-(4)"), plain(&[1, 2, 3, 4]));
}
