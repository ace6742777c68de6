//! What the program prints of the paper's geometries, in every format: the files in `snapshots/`.

use crate::program::{root, stdout};
use affinor_tensors::expression::{Expression, Scalars, no_function};
use affinor_tensors::{Notation, Symbolic};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// What is printed, and the name of its snapshots before the format.
const OBJECTS: [(&str, &[&str]); 10] = [
    ("m3_table", &["table", "M3"]),
    ("so3_table", &["table", "SO3"]),
    ("m3_so3_comparison", &["compare"]),
    ("poincare_info", &["info", "iso(3,1)"]),
    ("bianchi_info", &["info", "bianchi(VII,h=2)"]),
    ("e8_info", &["info", "E8"]),
    ("scrambled_sum_info", &["info", "tests/data/structure/scrambled_sum.json"]),
    ("berger_properties", &["properties", "so3", "--metric", "diag(1,1,1/4)"]),
    ("heisenberg_properties", &["properties", "heisenberg(3)", "--metric", "identity"]),
    ("hyperbolic_properties", &["properties", "bianchi(V)", "--metric", "identity"]),
];
const FORMATS: [&str; 6] = ["text", "markdown", "latex", "csv", "json", "html"];

/// The formats of an object: the JSON of E8 is half a megabyte, and `info` asserts its values. One page of each kind is enough,
/// and for properties text and JSON.
fn formats(object: &str) -> impl Iterator<Item = &'static str> {
    let pages = ["so3_table", "m3_so3_comparison", "bianchi_info"].contains(&object);
    let kept = move |format: &&str| match *format {
        "html" => pages,
        format if object.ends_with("_properties") => ["text", "json"].contains(&format),
        format => (object, format) != ("e8_info", "json"),
    };
    FORMATS.into_iter().filter(kept)
}

/// Components by tensor and indices (from 1), zeros left out.
type Components = BTreeMap<String, BTreeMap<Vec<usize>, Symbolic>>;

fn snapshots() -> PathBuf {
    root().join("snapshots")
}

fn print(arguments: &[&str], format: &str) -> String {
    stdout(root(), &[arguments, &["--format", format]].concat())
}

#[test]
fn tables_and_comparison() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for (object, arguments) in OBJECTS {
            for format in formats(object) {
                insta::assert_snapshot!(format!("{object}_{format}"), print(arguments, format));
            }
        }
    });
}

#[test]
fn nothing_else_stands_in_the_folder() {
    let entries = std::fs::read_dir(snapshots()).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    // a snapshot that waits for review is not part of the project
    let found: BTreeSet<String> = names.filter(|name| !name.ends_with(".snap.new")).collect();
    let expected = OBJECTS.iter().flat_map(|(object, _)| {
        formats(object).map(move |format| format!("{object}_{format}.snap"))
    });
    // those of `programs`
    let programs = ["c", "python", "rust"].map(|name| format!("program_{name}.snap"));
    assert_eq!(found, expected.chain(programs).collect());
}

/// The text of a snapshot, without its head.
fn stored(name: &str) -> String {
    let text = std::fs::read_to_string(snapshots().join(format!("{name}.snap"))).unwrap();
    text.splitn(3, "---\n").nth(2).unwrap().to_string()
}

fn value(text: &str) -> Symbolic {
    let parameter = |name: &str| <Symbolic as Notation>::parameter(name).ok_or(format!("`{name}`"));
    Expression::parse(text).unwrap().evaluate(&Scalars(parameter, no_function)).unwrap()
}

fn from_csv(text: &str) -> Components {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("tensor,i,j,k,l,value"));
    let mut components = Components::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let indices = fields[1..5].iter().filter(|index| !index.is_empty());
        let indices = indices.map(|index| index.parse().unwrap()).collect();
        let tensor = components.entry(fields[0].into()).or_default();
        assert!(tensor.insert(indices, value(fields[5])).is_none(), "{line} stands twice");
    }
    components
}

fn from_json(text: &str) -> Components {
    let json: Value = serde_json::from_str(text).unwrap();
    let component = |component: &Value| {
        let indices = component[0].as_array().unwrap().iter();
        let indices: Vec<usize> = indices.map(|i| i.as_u64().unwrap() as usize).collect();
        (indices, value(component[1].as_str().unwrap()))
    };
    let tensors = json["tensors"].as_object().unwrap().iter();
    let tensors = tensors.map(|(key, tensor)| {
        let components = tensor["components"].as_array().unwrap().iter();
        (key.clone(), components.map(component).collect::<BTreeMap<_, _>>())
    });
    tensors.filter(|(_, components)| !components.is_empty()).collect()
}

/// The symbols of the tensors in text, and their names in CSV and JSON.
const SYMBOLS: [(&str, &str); 8] = [
    ("c", "structure"),
    ("Lambda", "affinities"),
    ("tau", "torsion"),
    ("R", "curvature"),
    ("Ric", "ricci"),
    ("S", "scalar_curvature"),
    ("g", "metric"),
    ("Q", "nonmetricity"),
];

/// A component such as `-R^1_221`: whether it has a minus sign, its tensor and its indices.
fn component(text: &str) -> Option<(bool, &'static str, Vec<usize>)> {
    let positive = text.strip_prefix('-');
    let unsigned = positive.unwrap_or(text);
    let (symbol, indices) = unsigned.split_at(unsigned.find(['^', '_']).unwrap_or(unsigned.len()));
    let (_, tensor) = SYMBOLS.iter().find(|(known, _)| *known == symbol)?;
    let digits = indices.chars().filter(|c| !['^', '_'].contains(c));
    let digits = digits.map(|c| Some(c.to_digit(10)? as usize)).collect::<Option<_>>()?;
    Some((positive.is_some(), tensor, digits))
}

/// The components of the lines `g_12 = g_21 = J12`. Lines of other things, such as brackets, are skipped.
fn from_lines(lines: impl Iterator<Item = String>) -> Components {
    let mut components = Components::new();
    for line in lines {
        let mut members: Vec<&str> = line.split(" = ").map(str::trim).collect();
        let last = members.pop().unwrap();
        for (negative, tensor, indices) in members.iter().filter_map(|text| component(text)) {
            let found = if negative { -value(last) } else { value(last) };
            let tensor = components.entry(tensor.into()).or_default();
            assert!(tensor.insert(indices, found).is_none(), "{line} stands twice");
        }
    }
    // a tensor of rank 0 is written even where it is zero
    components.retain(|_, tensor| tensor.values().any(|v| *v != value("0")));
    components
}

/// Values continue on the next line with four spaces and an equals sign.
fn from_text(text: &str) -> Components {
    from_lines(text.replace("\n    =", " =").lines().map(str::to_string))
}

/// Rows `| component = component | value |`.
fn from_markdown(text: &str) -> Components {
    let rows = text.lines().map(|line| line.trim_matches(['|', ' ']).replace('`', ""));
    from_lines(rows.map(|row| row.replace(" | ", " = ")))
}

fn from_latex(text: &str) -> Components {
    from_lines(ascii(&text.replace(" \\\\*\n&=", " =").replace('&', "")).lines().map(|line| {
        // a space between a number and a letter is a product
        let (members, last) = line.rsplit_once(" = ").unwrap_or(("", line));
        let factors = last.trim_end_matches("\\\\").trim().replace(" J", "*J");
        format!("{members} = {}", factors.replace("+*", "+ ").replace("-*", "- "))
    }))
}

/// Formulas of LaTeX as text writes them.
fn ascii(latex: &str) -> String {
    let mut text = latex.replace("{}", "").replace("J_{", "J{").replace("e_{", "e{");
    for (command, word) in [
        ("\\frac{d u}{d t}", "du/dt"),
        ("\\frac{1}{2}", "1/2"),
        ("\\frac{1}{4}", "1/4"),
        ("\\frac{3}{4}", "3/4"),
        ("\\hangindent=2em", ""),
        ("\\newline", ""),
        ("\\par", ""),
        ("\\mathrm", ""),
        ("\\operatorname", ""),
        ("\\_", "_"),
    ] {
        text = text.replace(command, word);
    }
    for name in ["Lambda", "tau", "nabla"] {
        text = text.replace(&format!("\\{name}"), name);
    }
    text.replace(['{', '}', '$'], "")
}

/// The components that `f` does not make zero.
fn all<const R: usize>(f: impl Fn([usize; R]) -> Symbolic) -> BTreeMap<Vec<usize>, Symbolic> {
    let places = (0..3usize.pow(R as u32)).map(|mut at| {
        let mut indices = [0; R];
        for index in indices.iter_mut().rev() {
            (*index, at) = (at % 3 + 1, at / 3);
        }
        (indices.to_vec(), f(indices))
    });
    places.filter(|(_, v)| *v != value("0")).collect()
}

fn epsilon(indices: [usize; 3]) -> Symbolic {
    match indices {
        [1, 2, 3] | [2, 3, 1] | [3, 1, 2] => value("1"),
        [3, 2, 1] | [2, 1, 3] | [1, 3, 2] => value("-1"),
        _ => value("0"),
    }
}

fn inertia([i, j]: [usize; 2]) -> Symbolic {
    value(&format!("J{}{}", i.min(j), i.max(j)))
}

fn in_every_format(object: &str, expected: &Components) {
    let readers = [from_text, from_markdown, from_latex, from_csv, from_json];
    for (format, read) in FORMATS.into_iter().zip(readers as [fn(&str) -> Components; 5]) {
        assert_eq!(read(&stored(&format!("{object}_{format}"))), *expected, "{object} {format}");
    }
}

#[test]
fn every_number_of_the_m3_table_is_the_papers() {
    // (46), after (38), (99); nabla g by (B3) for covectors: -eps_mki J_mj - eps_mkj J_im
    let nonmetricity = |[k, i, j]: [usize; 3]| {
        (1..=3).fold(value("0"), |sum, m| {
            let first = epsilon([m, k, i]) * &inertia([m, j]);
            sum - &first - &(epsilon([m, k, j]) * &inertia([i, m]))
        })
    };
    let expected = Components::from([
        ("structure".into(), all(epsilon)),
        ("affinities".into(), all(epsilon)),
        ("torsion".into(), all(epsilon)),
        ("metric".into(), all(inertia)),
        ("nonmetricity".into(), all(nonmetricity)),
    ]);
    let count: Vec<usize> = expected.values().map(BTreeMap::len).collect();
    assert_eq!(count, [6, 9, 24, 6, 6]);
    in_every_format("m3_table", &expected);
}

#[test]
fn every_number_of_the_so3_table_is_the_papers() {
    // (64), (65), the table of twelve after (65), Ric = 1/2 delta, (102) and S = 3/4 of it
    let plus = ["1212", "1313", "2121", "2323", "3131", "3232"];
    let minus = ["1221", "1331", "2112", "2332", "3113", "3223"];
    let twelve = |[i, j, k, l]: [usize; 4]| {
        let name = format!("{i}{j}{k}{l}");
        let sign =
            i64::from(plus.contains(&name.as_str())) - i64::from(minus.contains(&name.as_str()));
        value(&format!("{sign}/4"))
    };
    let delta =
        |share: &'static str| move |[i, j]: [usize; 2]| value(if i == j { share } else { "0" });
    let expected = Components::from([
        ("structure".into(), all(epsilon)),
        ("affinities".into(), all(|at| epsilon(at) * &value("1/2"))),
        ("curvature".into(), all(twelve)),
        ("ricci".into(), all(delta("1/2"))),
        ("scalar_curvature".into(), BTreeMap::from([(vec![], value("3/4"))])),
        ("metric".into(), all(delta("2"))),
    ]);
    assert_eq!(expected["curvature"].len(), 12);
    in_every_format("so3_table", &expected);
}

#[test]
fn the_comparison_holds_the_papers_tables() {
    let json: Value = serde_json::from_str(&stored("m3_so3_comparison_json")).unwrap();
    let row = |title: &str| {
        let rows = json["rows"].as_array().unwrap();
        let row = rows.iter().find(|row| row["title"] == title).unwrap();
        [0, 1].map(|side| {
            let lines = row["cells"][side].as_array().unwrap().iter();
            lines.map(|line| line.as_str().unwrap().to_string()).collect::<Vec<_>>().join("; ")
        })
    };
    let eps = |symbol: &str, share: &str| {
        let names = ["1_23", "1_32", "2_31", "2_13", "3_12", "3_21"];
        let signs = ["", "-", "", "-", "", "-"];
        let members: Vec<_> =
            signs.iter().zip(names).map(|(sign, name)| format!("{sign}{symbol}^{name}")).collect();
        format!("{} = {share}", members.join(" = "))
    };
    assert_eq!(row("structure constants"), [eps("c", "1"), eps("c", "1")]);
    assert_eq!(row("affinities"), [eps("Lambda", "1"), eps("Lambda", "1/2")]);
    assert_eq!(row("torsion (B10)"), [eps("tau", "1"), "0".into()]);
    let twelve = "R^1_212 = -R^1_221 = R^1_313 = -R^1_331 = R^2_121 = -R^2_112 = R^2_323 = \
                  -R^2_332 = R^3_131 = -R^3_113 = R^3_232 = -R^3_223 = 1/4";
    assert_eq!(row("curvature (B14)"), ["0", twelve].map(String::from));
    assert_eq!(row("metric")[1], "g_11 = g_22 = g_33 = 2");
    assert_eq!(
        row("transport along n"),
        ["-", "-1/2 "].map(|s| format!("du/dt = G u, G = {s}ad_n"))
    );
    // five claims about M(3), one about both, six about SO(3): each holds there and nowhere else
    let claims = json["claims"].as_array().unwrap();
    assert_eq!(claims.len(), 12);
    for claim in claims {
        let about = claim["about"].as_array().unwrap();
        for (side, name) in ["M(3)", "SO(3)"].into_iter().enumerate() {
            let holds = claim["verdicts"][side]["holds"].as_bool().unwrap();
            assert_eq!(holds, about.iter().any(|about| about == name), "{claim}");
        }
    }
}

/// The rows of the boxes that text draws, cell by cell; the heads give the columns.
fn boxed(text: &str) -> Vec<Vec<String>> {
    let (mut rows, mut starts) = (Vec::<Vec<String>>::new(), vec![]);
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let Some(inside) = line.strip_prefix('│').and_then(|line| line.strip_suffix('│'))
        else {
            continue;
        };
        let inside: Vec<char> = inside.chars().collect();
        if lines.peek().is_some_and(|next| next.starts_with('╞')) {
            // a column begins behind two spaces; the first head may be empty
            let begins = |at: &usize| inside[at - 2..*at] == [' '; 2] && inside[*at] != ' ';
            starts = [1].into_iter().chain((3..inside.len()).filter(begins)).collect();
            continue;
        }
        let ends = starts.iter().skip(1).copied().chain([inside.len()]);
        let cells = starts.iter().zip(ends).map(|(from, to)| inside[*from..to].iter().collect());
        let cells: Vec<String> = cells.collect();
        match rows.last_mut() {
            // only the first line of a row has both its title and the next cell
            Some(row) if cells[..2].iter().any(|cell| cell.trim().is_empty()) => {
                row.iter_mut().zip(&cells).for_each(|(cell, more)| cell.push_str(more));
            }
            _ => rows.push(cells),
        }
    }
    rows
}

/// Each line of components on the page is one of the table in text.
#[test]
fn the_page_has_the_components_of_the_text() {
    let (page, text) = (stored("so3_table_html"), stored("so3_table_text"));
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let page = roxmltree::Document::parse_with_options(&page, options).unwrap();
    let text: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut found = 0;
    for item in page.descendants().filter(|node| node.has_tag_name("li")) {
        let formulas = item.descendants().filter_map(|node| node.attribute("alttext"));
        let line = formulas.collect::<Vec<_>>().join(" ");
        assert!(text.contains(&line), "{line}");
        found += 1;
    }
    assert!(found >= 9, "{found}");
    assert!(
        text.contains("= 1/4") && page.input_text().contains("<mfrac><mn>1</mn><mn>4</mn></mfrac>")
    );
}

/// Rows of cells without the separators, spaces left out.
fn rows<'t>(lines: impl Iterator<Item = &'t str>, separator: &str) -> Vec<Vec<String>> {
    lines.map(|line| line.split(separator).map(str::to_string).collect()).collect()
}

/// The rows of both tables are the same in every format, up to the marks of the format.
#[test]
fn the_comparison_is_the_same_in_every_format() {
    let of = |format: &str| stored(&format!("m3_so3_comparison_{format}"));
    let json: Value = serde_json::from_str(&of("json")).unwrap();
    let list = |value: &Value| value.as_array().unwrap().clone();
    let strings = |value: &Value| -> Vec<String> {
        list(value).iter().map(|text| text.as_str().unwrap().to_string()).collect()
    };
    let mut expected = vec![];
    for row in list(&json["rows"]) {
        let cells = list(&row["cells"]);
        let title = row["title"].as_str().unwrap().to_string();
        expected.push([vec![title], cells.iter().map(|c| strings(c).concat()).collect()].concat());
    }
    for claim in list(&json["claims"]) {
        let about = strings(&claim["about"]);
        let about = if about.len() == 2 { "both".to_string() } else { about[0].clone() };
        let verdicts = list(&claim["verdicts"]).into_iter().map(|verdict| {
            let found = verdict["residual"].as_str().unwrap_or_default();
            if verdict["holds"] == true { "yes".into() } else { format!("no: {found}") }
        });
        let word = |key: &str| claim[key].as_str().unwrap();
        let title = format!("{} {}", word("equation"), word("statement"));
        expected.push([vec![title, about], verdicts.collect()].concat());
    }
    let unspaced = |row: &Vec<String>| -> Vec<String> {
        row.iter().map(|cell| cell.split_whitespace().collect()).collect()
    };
    let (markdown, latex) = (of("markdown").replace("<br>", ""), ascii(&of("latex")));
    let piped = markdown.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    let markdown = rows(piped, " | ").into_iter();
    let markdown = markdown.map(|row| row.iter().map(|cell| cell.replace('\\', "")).collect());
    let latex = rows(latex.lines().filter_map(|line| line.strip_suffix(" \\\\")), " & ");
    for (format, found) in
        [("text", boxed(&of("text"))), ("markdown", markdown.collect()), ("latex", latex)]
    {
        let found: Vec<Vec<String>> = found.iter().map(unspaced).collect();
        for row in &expected {
            assert!(found.contains(&unspaced(row)), "{format}: {row:?}\n{found:#?}");
        }
    }
}
