//! Tests of formulas: the text of a tree parses to the same tree, and every fraction has the
//! correct numerator and denominator.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use super::*;
use crate::report::{Comparison, Computation, Format, Quantity, Report, Selection};
use crate::space::{Request, Space};
use affinor::geometry::equations::EquationKind;
use affinor_tensors::expression::{Expression, Scalars};
use std::collections::BTreeSet;

fn read(text: &str) -> Row {
    notation(text).unwrap_or_else(|rest| panic!("{text}: not read from {rest:?} on"))
}

/// The numerators and denominators of all fractions, from left to right.
fn fractions(row: &[Node], found: &mut Vec<[Row; 2]>) {
    for node in row {
        match node {
            Node::Group(_, inner) | Node::Root(inner) => fractions(inner, found),
            Node::Apply(function, argument) => {
                fractions(std::slice::from_ref(function), found);
                fractions(std::slice::from_ref(argument), found);
            }
            Node::Fraction([above, below]) => {
                fractions(above, found);
                found.push([above.clone(), below.clone()]);
                fractions(below, found);
            }
            Node::Scripts(base, scripts) => {
                fractions(std::slice::from_ref(base), found);
                scripts.iter().for_each(|(_, script)| fractions(script, found));
            }
            _ => {}
        }
    }
}

/// The same fractions, found in the text by searching for the end of a factor on both sides of each
/// slash.
fn around_slashes(text: &str) -> Vec<[Row; 2]> {
    let chars: Vec<char> = text.chars().collect();
    let string = |range: std::ops::Range<usize>| chars[range].iter().collect::<String>();
    let part = |text: String| bare(read(&text));
    let slashes = (0..chars.len()).filter(|&at| chars[at] == '/');
    let glued = slashes.filter(|&at| chars[at - 1] != ' ' && chars[at + 1] != ' ');
    let parts = glued.map(|slash| {
        let end = |mut at: usize, step: isize, ends: &str, [open, close]: [&str; 2]| {
            let mut depth = 0;
            while let Some(&c) = chars.get(at) {
                let index = at > 0 && "^_".contains(chars[at - 1]);
                depth += isize::from(open.contains(c)) - isize::from(close.contains(c));
                if depth < 0 || depth == 0 && ends.contains(c) && !index {
                    break;
                }
                at = at.wrapping_add_signed(step);
            }
            at
        };
        let mut start = end(slash - 1, -1, " =,+-", [")]}", "([{"]).wrapping_add(1);
        // includes a space before the argument of a function
        if start > 0 && chars[start - 1] == ' ' {
            let word = end(start - 2, -1, " =,+-", [")]}", "([{"]).wrapping_add(1);
            let name = string(word..start - 1);
            let name = name.split(['^', '_']).next().unwrap_or_default();
            if name == "D" || is_function(name) {
                start = word;
            }
        }
        let stop = end(slash + 1, 1, " =,+-*/", ["([{", ")]}"]);
        [string(start..slash), string(slash + 1..stop)].map(part)
    });
    parts.collect()
}

/// Parses a formula. Checks that its text parses to the same tree, and that its fractions have the
/// correct numerators and denominators.
fn check(formula: &str) {
    let tree = read(formula);
    let written = text(&tree);
    assert_eq!(read(&written), tree, "{formula} is written as {written}");
    let mut found = vec![];
    fractions(&tree, &mut found);
    assert_eq!(found, around_slashes(formula), "{formula}");
}

/// The formulas between backticks in a text.
fn quoted(text: &str) -> impl Iterator<Item = String> {
    text.split('`').skip(1).step_by(2).map(str::to_string)
}

/// All formulas of `docs/paper.md` are parsed. The package `paper` compares this page with its
/// rows.
#[test]
fn every_formula_of_the_paper_is_read_back() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/paper.md");
    let page = std::fs::read_to_string(page).unwrap();
    // drops the last cell, which contains names of functions in the code
    let cells = page.lines().map(|line| line.rsplit_once(" | ").map_or(line, |(cells, _)| cells));
    let mut formulas: BTreeSet<String> = cells.flat_map(quoted).collect();
    let connections = ["plus", "zero", "minus"];
    formulas.retain(|formula| !connections.contains(&formula.as_str()));
    assert!(formulas.len() > 200, "{}", formulas.len());
    for formula in &formulas {
        check(formula);
        // checks names, because a misspelled word would become the name of a quantity
        let names = words(&read(formula));
        assert!(names.iter().all(|name| name == "Ric"), "{formula}: {names:?}");
    }
}

/// The names with several letters.
fn words(row: &[Node]) -> Vec<String> {
    let debug = format!("{row:?}");
    let names = debug.split("Name(\"").skip(1);
    names.filter_map(|rest| Some(rest.split_once('"')?.0.to_string())).collect()
}

#[test]
fn every_symbol_and_convention_is_read_back() {
    for quantity in Quantity::ALL {
        check(quantity.symbol());
        if !quantity.definition().contains(" / ") {
            check(&quantity.definition());
        }
    }
    check("[e_j, e_k] = c^i_jk e_i");
}

/// The formulas of a page are equal to their alternative texts, so nothing is lost between tree,
/// text and MathML.
#[test]
fn every_formula_of_a_page_is_read_back() {
    let mut pages: Vec<String> = vec![];
    let mut page = |report: &dyn Report| {
        let mut html = vec![];
        report.write(Format::Html, &mut html).unwrap();
        pages.push(String::from_utf8(html).unwrap());
    };
    let spaces = [
        "M3",
        "SO3",
        "so3@lambda=1/3;metric=diag(1,2,3)",
        "so3@levi-civita;metric=diag(a,b,c)",
        "heisenberg(3)@levi-civita;metric=[[a,0,b],[0,1,0],[b,0,c]]",
        "aff1@minus",
    ];
    for space in spaces {
        let request = Request { space: Some(space.into()), ..Request::default() };
        let space = Space::open(&request).unwrap();
        let computation = Computation::of(&space);
        let selection = Selection { quantities: Quantity::ALL.to_vec(), ..Selection::default() };
        page(&*computation.table(&selection).unwrap().report);
        for kind in [EquationKind::Autoparallel, EquationKind::Transport] {
            page(&*computation.equations(kind, false).unwrap());
        }
        if space.definition.has_metric() {
            page(&*computation.equations(EquationKind::EulerPoincare, true).unwrap());
        }
        let [left, right] = [(); 2].map(|()| computation.side().unwrap());
        page(&Comparison::new(left, right));
    }
    let mut count = 0;
    for element in pages.iter().flat_map(|page| page.split("<math").skip(1)) {
        let (element, _) = element.split_once("</math>").unwrap();
        let (_, rest) = element.split_once("alttext=\"").unwrap();
        let (alternative, content) = rest.split_once("\">").unwrap();
        assert!(!content.contains("<mtext>"), "{alternative}");
        let again = mathml::block(
            &read(&alternative.replace("&lt;", "<").replace("&gt;", ">")),
            usize::MAX,
        );
        let plain =
            |text: &str| text.replace("infix", "prefix").replace("<mspace width=\"1em\"/>", "");
        assert!(
            plain(&again).ends_with(&(plain(content) + "</math>")),
            "{alternative}\n{content}\n{again}"
        );
        count += 1;
    }
    assert!(count > 200, "{count}");
}

#[test]
fn precedence() {
    for (formula, parts) in [
        ("1/2 a b", ["1", "2"]),
        ("a*b/c", ["a*b", "c"]),
        ("sin theta/theta x", ["sin theta", "theta"]),
        ("D Omega/Dt", ["D Omega", "Dt"]),
        ("J D(J Omega)/Dt", ["D(J Omega)", "Dt"]),
        ("Psi(t)/t", ["Psi(t)", "t"]),
        ("-a*(b - c)/2", ["a*(b - c)", "2"]),
        ("2 (1 - cos theta)/theta^2", ["1 - cos theta", "theta^2"]),
        ("dOmega^j/dt", ["dOmega^j", "dt"]),
        ("f(x)/g(x)^2", ["f(x)", "g(x)^2"]),
        ("(a + b)^2/(c d)", ["(a + b)^2", "c d"]),
    ] {
        let mut found = vec![];
        fractions(&read(formula), &mut found);
        let [above, below] = parts.map(read);
        assert_eq!(found, [[above, below]], "{formula}");
        check(formula);
    }
}

#[test]
fn words_indices_and_accents() {
    let letter = |c| Node::Letter(c);
    let scripts = |base, scripts| vec![Node::Scripts(Box::new(base), scripts)];
    let jkl = vec![Node::Indices("jkl".into())];
    assert_eq!(
        read("R^i_jkl"),
        scripts(letter('R'), vec![(true, vec![letter('i')]), (false, jkl)])
    );
    let eleven = vec![(false, vec![Node::Number("11".into())])];
    assert_eq!(read("J11"), scripts(letter('J'), eleven));
    assert_eq!(read("J11"), [name("J11")]);
    assert_eq!(read("DH"), read("D H"));
    assert_eq!(read("omega~"), [Node::Accent(Accent::Tilde, Box::new(letter('ω')))]);
    assert_eq!(read("Hdot"), [Node::Accent(Accent::Dot, Box::new(letter('H')))]);
    assert_eq!(read("a x b")[1], Node::Sign("×"));
    assert_eq!(read("mass"), [Node::Name("mass".into())]);
    for wrong in ["(a", "a)", "a^", "_i", "a / ", "§", "a^{b", "\"a", "a <b", "[a)"] {
        assert!(notation(wrong).is_err(), "{wrong}");
    }
    for odd in [
        "(", "_{", "^{", "/(", "a/", "a/(b)", "a(b)", "(b)", "sin ", "sin(", "<", "d", "D ", "-",
        "a^b",
    ] {
        let odd = odd.repeat(10_000);
        let _ = (notation(&odd), value(&odd));
    }
}

#[test]
fn values_follow_the_grammar_of_expressions() {
    for (text, tex) in [
        ("(a - 3*b)/(4*a^2)", r"\frac{a - 3 b}{4 a^{2}}"),
        (
            "-Omega2*Omega3*(J22 - J33)/2",
            r"-\frac{\Omega_{2} \Omega_{3} \left(J_{22} - J_{33}\right)}{2}",
        ),
        ("1/2*lambda*mu3^2", r"\frac{1}{2} \lambda \mu_{3}^{2}"),
        ("mass_max*x", r"\mathit{mass}_{\mathit{max}} x"),
        ("sin(x)^2*y", r"\sin^{2} x \, y"),
        ("sin(x)*cos(x)", r"\sin x \cos x"),
        ("cos(2*x)/sqrt(r - 1)", r"\frac{\cos(2 x)}{\sqrt{r - 1}}"),
        ("exp(a*x/2)", r"e^{\frac{a x}{2}}"),
        ("f1_r_theta(r,theta)^2", r"f_{1,r \theta}^{2}"),
        ("(a + b)^2", r"\left(a + b\right)^{2}"),
        ("2.5e-7", r"2.5 \times 10^{-7}"),
        ("a^-1", "a^{-1}"),
        ("a/b/c", r"\frac{a}{b c}"),
        ("a - (b - c)", r"a - \left(b - c\right)"),
    ] {
        assert_eq!(tex::formula(&value(text)), tex, "{text}");
    }
    assert_eq!(value("a +"), [Node::Text("a +".into())]);
    let terms = [("1", "e1"), ("-2/3", "e2"), ("p - q", "e3"), ("-(p + q)/2", "e4")];
    let terms = terms.map(|(coefficient, label)| (value(coefficient), vec![name(label)]));
    let sum = sum(terms);
    assert_eq!(text(&sum), "e1 - 2/3 e2 + (p - q) e3 - (p + q)/2 e4");
}

/// The value of a tree whose letters are replaced by numbers.
fn number(row: &[Node]) -> f64 {
    let mut terms = vec![(1.0, 1.0)];
    for node in row {
        match node {
            Node::Sign("+") => terms.push((1.0, 1.0)),
            Node::Sign("−") => terms.push((-1.0, 1.0)),
            node => terms.last_mut().unwrap().1 *= factor_of(node),
        }
    }
    // skips the empty term that a leading sign leaves
    let skipped = usize::from(matches!(row.first(), Some(Node::Sign(_))));
    terms[skipped..].iter().map(|(sign, value)| sign * value).sum()
}

fn factor_of(node: &Node) -> f64 {
    match node {
        Node::Letter(c) => f64::from(*c as u32 - 96) + 0.37,
        Node::Number(number) => number.parse().unwrap(),
        Node::Group(_, row) => number(row),
        Node::Fraction([above, below]) => number(above) / number(below),
        Node::Apply(function, argument) => match &**function {
            Node::Scripts(_, scripts) => factor_of(argument).sin().powf(number(&scripts[0].1)),
            _ => factor_of(argument).sin(),
        },
        Node::Scripts(base, scripts) => factor_of(base).powf(number(&scripts[0].1)),
        other => panic!("{other:?}"),
    }
}

/// The tree of a random expression has the same value as the expression.
#[test]
fn trees_have_the_values_of_their_expressions() {
    let mut seed = 7_u64;
    let mut draw = |n: u64| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) % n
    };
    fn expression(depth: usize, draw: &mut dyn FnMut(u64) -> u64) -> String {
        if depth == 0 {
            return ["a", "b", "c", "2", "7", "0.5"][draw(6) as usize].into();
        }
        let [x, y] = [(); 2].map(|()| expression(depth - 1, draw));
        match draw(8) {
            0 => format!("{x} + {y}"),
            1 => format!("{x} - {y}"),
            2 => format!("{x}*{y}"),
            3 => format!("{x}/{y}"),
            4 => format!("({x})/({y})"),
            5 => format!("({x})^{}", draw(3) + 1),
            6 => format!("-({x})*({y})"),
            _ => format!("sin({x})^{}*{y}", draw(2) + 1),
        }
    }
    for depth in (0..400).map(|at| at % 4) {
        let text = expression(depth, &mut draw);
        let name = |name: &str| Ok(f64::from(name.as_bytes()[0] - 96) + 0.37);
        let sine = |_: &str, arguments: &[f64]| Ok(arguments[0].sin());
        let Ok(expected) = Expression::parse(&text).unwrap().evaluate(&Scalars(name, sine)) else {
            continue;
        };
        let found = number(&value(&text));
        assert!(
            (found - expected).abs() <= 1e-9 * expected.abs().max(1.0),
            "{text}: {found} {expected}"
        );
    }
}

#[test]
fn lines_break_in_front_of_signs() {
    let row = read("a = b + c - (d + e), f = -g");
    let pieces: Vec<String> = lines::pieces(&row).into_iter().map(text).collect();
    assert_eq!(
        pieces,
        ["a", "= b", "+ c", "- (d + e),", "f", "= -g"].map(|piece| text(&read(piece)))
    );
    let long = chain_of(30);
    for most in [20, 40, 60] {
        let broken = lines::lines(&long, most);
        assert!(broken.iter().all(|line| lines::width(line) <= most + 1), "{most}");
        assert_eq!(broken.concat(), long);
    }
}

fn chain_of(n: usize) -> Row {
    lines::chain((0..n).map(|at| read(&format!("R^{}_12", at % 9 + 1))))
}

#[test]
fn signs_have_the_form_of_their_place() {
    let forms = |formula: &str| {
        let written = mathml::inline(&read(formula));
        let forms = written.split("form=\"").skip(1);
        forms.map(|rest| rest.split_once('"').unwrap().0.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(forms("a - b"), ["infix"]);
    assert_eq!(forms("-a + b = -c"), ["prefix", "infix", "prefix"]);
    assert_eq!(forms("(-a - b), -10^-12"), ["prefix", "infix", "prefix", "prefix"]);
    assert!(!mathml::inline(&read("a - b^-1")).split("\">").nth(1).unwrap().contains('-'));
}
