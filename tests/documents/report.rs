//! A table has the same contents in every format, and can be read back.

mod claims;
mod info;
mod statements;
mod stored;

use crate::common::property::properties;
use affinor::{Bracket, CanonicalConnection, ConnectionKind, Geometry, LieAlgebra, Metric};
use affinor_documents::Coefficient;
use affinor_documents::report::{
    Format, GROUPED, Quantity, Report, Table, TableEntry, groups, independent,
};
use affinor_tensors::{Down, Field, Notation, Rational, Symbolic, Tensor, Tolerance, Up, Variance};
use proptest::prelude::*;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::io;

type Components = BTreeMap<Vec<usize>, String>;

// the rotation algebra, [e1, e2] = e3 and cyclic
fn rotations<S: Coefficient>(labels: &[&str]) -> LieAlgebra<S> {
    let bracket = Bracket::from_fn(labels, |j, k| match (j, k) {
        (0, 1) => vec![(2, S::one())],
        (0, 2) => vec![(1, -S::one())],
        _ => vec![(0, S::one())],
    });
    bracket.unwrap().try_into().unwrap()
}

fn metric<S: Coefficient>(labels: &[String], f: impl Fn(usize, usize) -> S) -> Metric<S> {
    let components = Tensor::from_fn(labels.len(), [Down, Down], |[i, j]| f(i, j));
    Metric::new(labels, components.unwrap()).unwrap()
}

fn geometry<S: Coefficient>(
    name: &str,
    kind: ConnectionKind<S>,
    g: impl Fn(usize, usize) -> S,
) -> Geometry<S> {
    let algebra = rotations(&["e1", "e2", "e3"]);
    let metric = metric(algebra.labels(), g);
    Geometry::new(name, algebra, kind, Some(metric)).unwrap()
}

fn so3<S: Coefficient>() -> Table<S> {
    let zero = ConnectionKind::Canonical(CanonicalConnection::Zero);
    let delta = |i, j| if i == j { S::one() } else { S::zero() };
    Table::new(&geometry("SO(3)", zero, delta), &Quantity::ALL).unwrap()
}

/// The inertia `J` with six free components.
fn m3(kind: ConnectionKind<Symbolic>) -> Table<Symbolic> {
    let inertia =
        |i: usize, j: usize| Symbolic::parameter(&format!("J{}{}", i.min(j) + 1, i.max(j) + 1));
    Table::new(&geometry("M(3)", kind, inertia), &Quantity::ALL).unwrap()
}

/// A table of one tensor in the given dimension, with arbitrary components.
fn single<S: Coefficient>(quantity: Quantity, tensor: Tensor<S>) -> Table<S> {
    let labels = (1..=tensor.dimension()).map(|i| format!("e{i}")).collect();
    Table {
        name: "test".into(),
        algebra: "test".into(),
        labels,
        parameters: vec![],
        connection: "affinities".into(),
        connection_words: "affinities (given one by one)".into(),
        lambda: None,
        frame: "left-invariant",
        chart: None,
        homogeneous: None,
        tolerance: Tolerance::default(),
        independent: false,
        common_factors: false,
        index_names: None,
        point: vec![],
        metric: None,
        tensors: vec![TableEntry { quantity, tensor }],
    }
}

fn render<S: Coefficient>(table: &Table<S>, format: Format) -> String {
    let mut out = Vec::new();
    table.write(format, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

/// The text with its line breaks removed, so that a search does not depend on them.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn written<S: Coefficient>(tensor: &Tensor<S>) -> Components {
    let from_one = |at: &[usize]| at.iter().map(|i| i + 1).collect();
    tensor.components().map(|(at, value)| (from_one(&at), value.to_string())).collect()
}

fn from_csv(csv: &str) -> BTreeMap<String, Components> {
    let mut tensors: BTreeMap<String, Components> = BTreeMap::new();
    for line in csv.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let (tensor, value) = (fields[0].to_string(), fields[fields.len() - 1].to_string());
        let indices = fields[1..fields.len() - 1].iter().filter(|field| !field.is_empty());
        let indices = indices.map(|field| field.parse().unwrap()).collect();
        assert!(tensors.entry(tensor).or_default().insert(indices, value).is_none(), "{line}");
    }
    tensors
}

fn from_json(json: &str) -> BTreeMap<String, Components> {
    let value: Value = serde_json::from_str(json).unwrap();
    let component = |component: &Value| {
        let indices = component[0].as_array().unwrap().iter();
        let indices = indices.map(|index| index.as_u64().unwrap() as usize).collect();
        let value = match &component[1] {
            Value::String(text) => text.clone(),
            number => number.as_f64().unwrap().to_string(),
        };
        (indices, value)
    };
    let tensors = value["tensors"].as_object().unwrap().iter();
    tensors
        .map(|(key, tensor)| {
            let components = tensor["components"].as_array().unwrap();
            (key.clone(), components.iter().map(component).collect())
        })
        .collect()
}

/// CSV and JSON are read back as the same tensors.
fn round_trip<S: Coefficient>(table: &Table<S>) {
    let expected: BTreeMap<String, Components> = table
        .tensors
        .iter()
        .map(|entry| (entry.quantity.key().to_string(), written(&entry.tensor)))
        .collect();
    let json = render(table, Format::Json);
    assert_eq!(from_json(&json), expected);
    let mut nonzero = expected;
    nonzero.retain(|_, components| !components.is_empty());
    assert_eq!(from_csv(&render(table, Format::Csv)), nonzero);
}

#[test]
fn curvature_of_so3_is_printed_as_in_the_paper() {
    let table = so3::<Rational>();
    let text = unwrapped(&render(&table, Format::Text)) + " ";
    // the twelve components below (31), in the order of the paper
    let twelve = "R^1_212 = -R^1_221 = R^1_313 = -R^1_331 = R^2_121 = -R^2_112 = R^2_323 \
                  = -R^2_332 = R^3_131 = -R^3_113 = R^3_232 = -R^3_223 = 1/4";
    assert!(text.contains(twelve), "{text}");
    let eq = "c^1_23 = -c^1_32 = c^2_31 = -c^2_13 = c^3_12 = -c^3_21 = 1";
    assert!(text.contains(eq), "{text}");
    assert!(text.contains("[e1, e2] = e3 [e1, e3] = -e2 [e2, e3] = e1"), "{text}");
    assert!(text.contains("Ric_11 = Ric_22 = Ric_33 = 1/2 all others are zero"), "{text}");
    assert!(text.contains("K_11 = K_22 = K_33 = -2"), "{text}");
    assert!(text.contains("Torsion tau^i_jk = 0"), "{text}");
    assert!(text.contains("S = 3/2"), "{text}");
    assert!(text.contains("zero (symmetric), lambda = 1/2"), "{text}");
}

#[test]
fn latex_of_the_curvature() {
    let latex = unwrapped(&render(&so3::<Rational>(), Format::Latex).replace("\\\\*\n&=", "="));
    assert!(latex.contains("R^{1}{}_{212} &= -R^{1}{}_{221} = R^{1}{}_{313} ="), "{latex}");
    assert!(latex.contains("= -R^{3}{}_{223} = \\frac{1}{4} \\end{align*}"), "{latex}");
    assert!(latex.contains("\\begin{align*} \\tau^{i}{}_{jk} &= 0 \\end{align*}"), "{latex}");
}

#[test]
fn latex_of_a_value_wider_than_the_page() {
    let parameter = |name: &str| Symbolic::parameter(name);
    let sum = ('a'..='z').fold(parameter("a"), |sum, c| sum + &parameter(&c.to_string()));
    let below = (parameter("x") + &parameter("y")).recip().unwrap();
    let of = |value| {
        let tensor = Tensor::from_components(3, &[], [([], value)]).unwrap();
        render(&single(Quantity::ScalarCurvature, tensor), Format::Latex)
    };
    // a fraction bar does not allow a line break, a slash does
    let latex = of(-(sum.clone() * &below));
    let line = format!("$S = -({})/(x + y)$\\par\n", sum.latex());
    assert!(latex.contains(&line), "{latex}");
    let latex = of(-below);
    assert!(latex.contains("S &= -\\frac{1}{x + y}\n"), "{latex}");
}

#[test]
fn csv_of_the_curvature() {
    let mut table = so3::<Rational>();
    table.tensors.retain(|entry| entry.quantity == Quantity::Curvature);
    let csv = render(&table, Format::Csv);
    let expected = "tensor,i,j,k,l,value\n\
                    curvature,1,2,1,2,1/4\ncurvature,1,2,2,1,-1/4\n\
                    curvature,1,3,1,3,1/4\ncurvature,1,3,3,1,-1/4\n\
                    curvature,2,1,1,2,-1/4\ncurvature,2,1,2,1,1/4\n\
                    curvature,2,3,2,3,1/4\ncurvature,2,3,3,2,-1/4\n\
                    curvature,3,1,1,3,-1/4\ncurvature,3,1,3,1,1/4\n\
                    curvature,3,2,2,3,-1/4\ncurvature,3,2,3,2,1/4\n";
    assert_eq!(csv, expected);
    table.independent = true;
    let csv = render(&table, Format::Csv);
    let k_below_l: String = expected
        .lines()
        .filter(|line| line.starts_with('t') || line.as_bytes()[14] < line.as_bytes()[16])
        .map(|line| format!("{line}\n"))
        .collect();
    assert_eq!(csv, k_below_l);
    assert_eq!(csv.lines().count(), 7);
}

#[test]
fn csv_has_a_column_for_every_index() {
    let slots = [Up, Down, Down, Down, Down];
    let tensor =
        Tensor::from_components(2, &slots, [([0, 1, 0, 1, 0], Rational::from(3))]).unwrap();
    let csv = render(&single(Quantity::Curvature, tensor), Format::Csv);
    assert_eq!(csv, "tensor,i,j,k,l,m,value\ncurvature,1,2,1,2,1,3\n");
    let scalar = Tensor::from_components(2, &[], [([], Rational::from(-7))]).unwrap();
    let csv = render(&single(Quantity::ScalarCurvature, scalar), Format::Csv);
    assert_eq!(csv, "tensor,i,j,k,l,value\nscalar_curvature,,,,,-7\n");
}

#[test]
fn every_scalar_is_read_back() {
    let float = so3::<f64>();
    round_trip(&float);
    round_trip(&so3::<Rational>());
    round_trip(&m3(ConnectionKind::Canonical(CanonicalConnection::Plus)));
    round_trip(&m3(ConnectionKind::LeviCivita));
    let half = ConnectionKind::Family(0.5);
    round_trip(
        &Table::new(&geometry("f", half, |i, j| f64::from(i == j) / 3.0), &Quantity::ALL).unwrap(),
    );
}

#[test]
fn json_is_the_object_of_the_contract() {
    let table = m3(ConnectionKind::Canonical(CanonicalConnection::Plus));
    let json: Value = serde_json::from_str(&render(&table, Format::Json)).unwrap();
    let keys: Vec<&String> = json.as_object().unwrap().keys().collect();
    let contract = ["schema", "name", "algebra", "connection", "scalar", "conventions", "tensors"];
    assert_eq!(keys, contract);
    assert_eq!(json["schema"], "affinor.table/1");
    assert_eq!(json["name"], "M(3)");
    assert_eq!(json["algebra"]["basis"], serde_json::json!(["e1", "e2", "e3"]));
    let parameters = serde_json::json!(["J11", "J12", "J13", "J22", "J23", "J33"]);
    assert_eq!(json["algebra"]["parameters"], parameters);
    assert_eq!(json["connection"], serde_json::json!({"name": "plus", "lambda": "1"}));
    assert_eq!(json["scalar"], "symbolic");
    let structure = &json["tensors"]["structure"];
    assert_eq!(structure["symbol"], "c");
    assert_eq!(structure["indices"], serde_json::json!(["up", "down", "down"]));
    assert_eq!(structure["components"][0], serde_json::json!([[1, 2, 3], "1"]));
    assert_eq!(json["tensors"]["curvature"]["components"], serde_json::json!([]));
    // Q_kij of the inertia with Lambda = c: Q_112 = -(c^m_11 J_m2 + c^m_12 J_1m) = -J13
    let nonmetricity = json["tensors"]["nonmetricity"]["components"].as_array().unwrap();
    assert!(nonmetricity.contains(&serde_json::json!([[1, 1, 2], "-J13"])), "{nonmetricity:?}");
    assert!(nonmetricity.contains(&serde_json::json!([[1, 2, 2], "-2*J23"])), "{nonmetricity:?}");

    let float: Value = serde_json::from_str(&render(&so3::<f64>(), Format::Json)).unwrap();
    assert_eq!(float["connection"]["lambda"], 0.5);
    assert_eq!(float["tensors"]["scalar_curvature"]["components"], serde_json::json!([[[], 1.5]]));
    assert!(float["conventions"]["zero"].as_str().unwrap().contains("1.421e-14"));

    let algebra = rotations::<Rational>(&["x", "y", "z"]);
    let bare = ConnectionKind::Affinities(Tensor::zero(3, &[Up, Down, Down]).unwrap());
    let bare = Table::new(&Geometry::new("bare", algebra, bare, None).unwrap(), &Quantity::ALL);
    let bare: Value = serde_json::from_str(&render(&bare.unwrap(), Format::Json)).unwrap();
    assert_eq!(bare["connection"], serde_json::json!({"name": "affinities"}));
    let tensors: Vec<&String> = bare["tensors"].as_object().unwrap().keys().collect();
    let basic = ["structure", "affinities", "torsion", "curvature", "ricci", "killing"];
    let derived = ["nabla_torsion", "nabla_curvature", "ricci_symmetric", "ricci_antisymmetric"];
    let without_metric = [&basic[..], &derived].concat();
    assert_eq!(tensors, without_metric, "what needs a metric is absent");
}

#[test]
fn no_format_turns_infinity_into_a_number() {
    let tensor = Tensor::from_components(1, &[], [([], f64::INFINITY)]).unwrap();
    let table = single(Quantity::ScalarCurvature, tensor);
    let error = table.write(Format::Json, &mut Vec::new()).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::InvalidData);
    assert!(render(&table, Format::Csv).ends_with(",inf\n"));
}

#[test]
fn floats_far_from_one_have_exponents() {
    let values = [1e-300, 0.1 + 0.2, 1e15, -2.5e200];
    let tensor = Tensor::from_fn(2, [Down, Down], |[i, j]| values[2 * i + j]).unwrap();
    let table = single(Quantity::Ricci, tensor.clone());
    let csv = render(&table, Format::Csv);
    let read: Vec<f64> =
        from_csv(&csv)["ricci"].values().map(|value| value.parse().unwrap()).collect();
    assert_eq!(read, values, "shortest text, exact value");
    let longest = csv.lines().map(str::len).max().unwrap();
    assert!(longest < 40, "{csv}");
}

#[test]
fn a_closed_pipe_is_known_as_one() {
    struct Closed;
    impl io::Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    // long enough to exceed every buffer
    let tensor = Tensor::from_fn(70, [Down, Down], |[i, j]| Rational::from((i + j + 1) as i64));
    let table = single(Quantity::Killing, tensor.unwrap());
    for format in Format::ALL {
        let error = table.write(format, &mut Closed).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::BrokenPipe, "{format:?}");
    }
}

#[test]
fn lines_stay_within_eighty_columns() {
    let mut tables = vec![render(&so3::<Rational>(), Format::Text)];
    tables.push(render(&so3::<f64>(), Format::Text));
    tables.push(render(&m3(ConnectionKind::LeviCivita), Format::Text));
    let labels: Vec<String> = (0..60).map(|i| format!("生成元{i}")).collect();
    let tensor = Tensor::from_fn(60, [Down, Down], |_| Rational::from(i64::MAX)).unwrap();
    let mut wide = single(Quantity::Killing, tensor);
    wide.labels = labels;
    wide.name = "direct sum of + many + algebras ".repeat(9);
    tables.push(render(&wide, Format::Text));
    for text in tables {
        for line in text.lines() {
            assert!(unicode_width::UnicodeWidthStr::width(line) <= 80, "{line}");
        }
    }
}

#[test]
fn wrapping_loses_nothing() {
    let table = m3(ConnectionKind::LeviCivita);
    let text = unwrapped(&render(&table, Format::Text)) + " ";
    // with the common factor instead of its name
    let (_, rest) = text.split_once("D = det g = ").unwrap();
    let factor = format!("({})", rest.split_once(" Structure").unwrap().0);
    let text = text.replace("/D", &format!("/{factor}")).replace("*D", &format!("*{factor}"));
    for entry in &table.tensors {
        for (_, value) in entry.tensor.components() {
            let size = if value.is_negative() { -value.clone() } else { value.clone() };
            let (size, value) = (format!("= {size} "), format!("= {value} "));
            assert!(text.contains(&size) || text.contains(&value), "{value}");
        }
    }
}

#[test]
fn indices_beyond_nine_are_set_apart() {
    let at = [([9, 1, 0, 11], Rational::from(1)), ([9, 1, 11, 0], Rational::from(-1))];
    let tensor = Tensor::from_components(12, &[Up, Down, Down, Down], at).unwrap();
    let table = single(Quantity::Curvature, tensor);
    assert!(render(&table, Format::Text).contains("R^10_2,1,12 = -R^10_2,12,1 = 1\n"));
    assert!(render(&table, Format::Latex).contains("R^{10}{}_{2,1,12} &= -R^{10}{}_{2,12,1} = 1"));
    assert!(render(&table, Format::Markdown).contains("| `R^10_2,1,12` = `-R^10_2,12,1` | `1` |"));
    let nine = Tensor::from_components(9, &[Down, Down], [([8, 8], Rational::from(1))]).unwrap();
    assert!(render(&single(Quantity::Metric, nine), Format::Text).contains("g_99 = 1\n"));
}

#[test]
fn long_tensors_are_listed_one_by_one() {
    for (n, grouped) in [(GROUPED, true), (GROUPED + 1, false)] {
        let at = (0..n).map(|i| ([i, i], Rational::from(5)));
        let tensor = Tensor::from_components(n, &[Down, Down], at).unwrap();
        let table = single(Quantity::Metric, tensor);
        let text = render(&table, Format::Text);
        assert_eq!(text.contains("one per line"), !grouped);
        assert!(text.contains(&format!("{n} nonzero components")));
        assert_eq!(text.matches("g_").count(), n);
        let markdown = render(&table, Format::Markdown);
        let rows = markdown.lines().filter(|line| line.starts_with("| `")).count();
        assert_eq!(rows, if grouped { 1 } else { n });
        let latex = render(&table, Format::Latex);
        assert_eq!(latex.contains("align*"), grouped);
        assert_eq!(latex.matches("g_{").count(), n);
    }
}

#[test]
fn odd_names_are_text_in_every_format() {
    let odd = "a_b*c^d|e\\f{g}$h%i#j&k~l<m>`n[o]\u{7}\n# p";
    let algebra = rotations::<Rational>(&[odd, "e2", "x'"]);
    let zero = ConnectionKind::Canonical(CanonicalConnection::Zero);
    let table = Table::new(&Geometry::new(odd, algebra, zero, None).unwrap(), &Quantity::ALL);
    let table = table.unwrap();
    let text = render(&table, Format::Text);
    assert!(text.starts_with("a_b*c^d|e\\f{g}$h%i#j&k~l<m>`n[o]\\u{7}\\n# p\n"), "{text}");
    let markdown = render(&table, Format::Markdown);
    let heading =
        "# a\\_b\\*c\\^d\\|e\\\\f{g}\\$h%i\\#j\\&k\\~l\\<m\\>\\`n\\[o\\]\\\\u{7}\\\\n\\# p\n";
    assert!(markdown.starts_with(heading), "{markdown}");
    let latex = render(&table, Format::Latex);
    let section = "\\section*{a\\_b*c\\textasciicircum{}d\\textbar{}e\\textbackslash{}f\\{g\\}\\$h\
                   \\%i\\#j\\&k\\textasciitilde{}l\\textless{}m\\textgreater{}`n[o]\
                   \\textbackslash{}u\\{7\\}\\textbackslash{}n\\# p}\n";
    assert!(latex.contains(section), "{latex}");
    assert!(latex.contains(", $e_{2}$, x'\\par"), "{latex}");
    let json: Value = serde_json::from_str(&render(&table, Format::Json)).unwrap();
    assert_eq!(json["name"], odd);
    assert_eq!(json["algebra"]["basis"][0], odd);
    for format in Format::ALL {
        let control = |c: char| c.is_control() && c != '\n';
        assert!(!render(&table, format).contains(control), "{format:?}");
    }
}

#[test]
fn formats_have_names() {
    for format in Format::ALL {
        assert_eq!(Format::from_name(format.name()), Some(format));
    }
    assert_eq!(Format::from_name("Text"), None);
}

#[test]
fn quantities_agree_with_their_slots() {
    let table = so3::<Rational>();
    assert_eq!(table.tensors.len(), Quantity::ALL.len());
    for entry in &table.tensors {
        assert_eq!(entry.tensor.slots(), entry.quantity.slots(), "{:?}", entry.quantity);
        assert_eq!(entry.quantity.letters().len(), entry.quantity.slots().len());
        assert_eq!(Quantity::from_key(entry.quantity.key()), Some(entry.quantity));
        let symbol = entry.quantity.symbol();
        assert!(entry.quantity.definition().contains(symbol), "{symbol}");
    }
}

/// Tensors in dimension 3 with small values; `sign` makes them (anti)symmetric in two slots.
fn tensors() -> impl Strategy<Value = Tensor<Rational>> {
    let slots = proptest::collection::vec(prop_oneof![Just(Up), Just(Down)], 0..=4);
    let value = prop_oneof![3 => Just(0i64), 2 => -2..=2i64];
    (slots, proptest::collection::vec(value, 81), 0..3usize, any::<(usize, usize)>()).prop_map(
        |(slots, values, symmetry, (a, b))| {
            let n = 3usize.pow(slots.len() as u32);
            let indices = |at: usize| -> Vec<usize> {
                (0..slots.len()).rev().map(|slot| at / 3usize.pow(slot as u32) % 3).collect()
            };
            let mut components = Vec::new();
            for (at, &value) in values[..n].iter().enumerate() {
                components.push((indices(at), Rational::from(value)));
                let (a, b) = (a % slots.len().max(1), b % slots.len().max(1));
                if symmetry > 0 && a != b {
                    let mut mirror = indices(at);
                    mirror.swap(a, b);
                    let sign = if symmetry == 1 { value } else { -value };
                    components.push((mirror, Rational::from(sign)));
                }
            }
            Tensor::from_components(3, &slots, components).unwrap()
        },
    )
}

/// The permutations of slots that map the tensor to itself or its negative, with the sign.
fn symmetries(tensor: &Tensor<Rational>) -> Vec<(Vec<usize>, i64)> {
    let slots: &[Variance] = tensor.slots();
    let mut orders = vec![vec![]];
    for _ in slots {
        orders = orders
            .iter()
            .flat_map(|order: &Vec<usize>| {
                let rest = (0..slots.len()).filter(|slot| !order.contains(slot));
                rest.map(|slot| [&order[..], &[slot]].concat()).collect::<Vec<_>>()
            })
            .collect();
    }
    let sign = |order: &Vec<usize>| {
        let moved = tensor.permute(order).unwrap();
        if moved.slots() != slots {
            return None;
        }
        [1, -1].into_iter().find(|&sign| moved == tensor.scale(&Rational::from(sign)))
    };
    orders.into_iter().filter_map(|order| sign(&order).map(|sign| (order, sign))).collect()
}

properties! {
    #![cases(256)]
    /// The page is well-formed, whatever names and values contain.
    #[test]
    fn pages_are_well_formed(
        name in r#"[-a-zA-Z0-9^_{}()\[\]/*+=<>&"' ~°Ω]{1,20}"#,
        labels in prop::collection::hash_set(r#"[-a-z0-9^_{}()\[\]/*+=<>&"' ~Ω]{1,8}"#, 3),
    ) {
        let mut table = so3::<Rational>();
        (table.name, table.labels) = (name, labels.into_iter().collect());
        let page = render(&table, Format::Html);
        let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
        let document = roxmltree::Document::parse_with_options(&page, options);
        prop_assert!(document.is_ok(), "{document:?}\n{page}");
    }


    #[test]
    fn groups_hold_every_component_once(tensor in tensors()) {
        let groups = groups(&tensor);
        let sizes: BTreeSet<String> = groups
            .iter()
            .map(|group| group.value.to_string().trim_start_matches('-').into())
            .collect();
        prop_assert_eq!(sizes.len(), groups.len(), "one group for each size");
        for group in &groups {
            let plain = group.members.iter().all(|(_, negative)| !negative);
            prop_assert!(plain || !group.value.is_negative());
        }
        let mut seen = BTreeSet::new();
        let members = groups.iter().flat_map(|group| {
            group.members.iter().map(|(at, negative)| {
                let value = group.value.clone();
                (at.clone(), if *negative { -value } else { value })
            })
        });
        let members: Vec<_> = members.collect();
        prop_assert!(members.iter().all(|(at, _)| seen.insert(at.clone())));
        prop_assert_eq!(Tensor::from_components(3, tensor.slots(), members).unwrap(), tensor);
    }

    #[test]
    fn independent_components_determine_the_tensor(tensor in tensors()) {
        let kept = independent(&tensor);
        let symmetries = symmetries(&tensor);
        let mut rebuilt = BTreeMap::new();
        for (at, value) in kept.components() {
            prop_assert_eq!(&tensor.get(&at), value);
            for (order, sign) in &symmetries {
                let moved: Vec<usize> = order.iter().map(|&slot| at[slot]).collect();
                rebuilt.insert(moved, value.clone() * &Rational::from(*sign));
            }
            // and no other component of its set is stored with it
            for (order, _) in &symmetries {
                let moved: Vec<usize> = order.iter().map(|&slot| at[slot]).collect();
                let swaps = order.iter().enumerate().filter(|(a, b)| a != *b).count();
                let here = swaps != 2 || moved == at.to_vec();
                prop_assert!(here || kept.get(&moved) == Rational::from(0), "{:?}", moved);
            }
        }
        let rebuilt = Tensor::from_components(3, tensor.slots(), rebuilt).unwrap();
        prop_assert_eq!(rebuilt, tensor);
    }

    #[test]
    fn tables_are_read_back(tensor in tensors()) {
        // any quantity works: formats depend on the slots of the tensor
        round_trip(&single(Quantity::Curvature, tensor.clone()));
        let half = tensor.map(|value| value.to_f64() / 3.0);
        round_trip(&single(Quantity::Curvature, half));
    }
}

#[test]
fn the_schema_of_tables_names_every_quantity() {
    let text =
        std::fs::read_to_string(crate::common::root().join("docs/schemas/table.schema.json"));
    let schema: serde_json::Value = serde_json::from_str(&text.unwrap()).unwrap();
    let names = &schema["properties"]["tensors"]["propertyNames"]["enum"];
    assert_eq!(*names, serde_json::json!(Quantity::ALL.map(Quantity::key)));
}
