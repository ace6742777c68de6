//! Definition files in TOML and JSON, and bytes of any kind.

use crate::claims::fuzz::assert_sound;
use crate::claims::fuzz::mutation::{mutants, texts};
use crate::common::property::properties;
use affinor_documents::space::Definition;
use proptest::collection::vec;
use proptest::prelude::*;
use std::io::Write;

const TOML: &[&str] = &[
    "name = \"Bianchi VI_h\"\nbasis = [\"e1\", \"e2\", \"e3\"]\nparameters = [\"h\"]\nbrackets = \"\"\"\n[e1, e3] = e1\n[e2, e3] = h*e2 # and more\n\"\"\"\nmetric = \"diag(1, 1, 2)\"\nconnection = \"lambda = 1/3\"\n",
    "dimension = 3\nstructure_constants = [[1, 2, 3, \"1\"], [2, 3, 1, \"1/2\"], [1, 3, 2, -1]]\nmetric = [[\"1\", \"0\", 0], [0, 1, 0], [0, 0, 1]]\n",
    "matrices = [{name = 'x', rows = [['0', '1'], ['0', '0']]}, {name = 'y', rows = [['i', '0'], ['0', '1/2*i']]}]\nmetric = 'killing'\n",
    "parameters = ['M']\nconnection = {kind = 'levi-civita'}\n[chart]\ncoordinates = ['r', 'phi']\n[frame]\na = 'sin(phi)*d_r'\nb = '1/r*d_phi - d_r'\n[metric]\ncomponents = 'diag(1 - 2*M/r, cosh(r))'\n",
    "dimension = 2\nmatrices = [[['1', '0'], ['0', '0']], [['0', '0'], ['0', '1']]]\n",
    "basis = ['x', 'y']\nbrackets = ['[x, y] = x', '[y, x] = -x']\naffinities = \"nabla[x, y] = 1/2*y\\nnabla[y, y] = x\"\n",
];

const JSON: &[&str] = &[
    "{\"chart\": {\"coordinates\": [\"t\"]}, \"frame\": {\"u\": \"exp(t)*d_t\"}, \"affinities\": \"nabla[u, u] = tan(t)*u\"}",
    "{\"name\": \"so(3)\", \"basis\": [\"x\", \"y\", \"z\"],\n \"brackets\": \"[x,y]=z\\n[y,z]=x\\n[z,x]=y\", \"metric\": \"identity\"}",
    "{\"dimension\": 2, \"structure_constants\": [[1, 2, 1, \"a\"]], \"parameters\": [\"a\"], \"connection\": \"levi-civita\", \"metric\": [[\"1\", \"0\"], [\"0\", \"2\"]]}",
    "{\"matrices\": [[[\"0\", \"1\"], [\"-1\", \"0\"]]]}",
];

const WORDS: &[&str] = &[
    "\"",
    "'",
    "\"\"\"",
    "'''",
    "[",
    "]",
    "{",
    "}",
    "[[",
    "]]",
    ",",
    ":",
    "=",
    "\n",
    "\r\n",
    " ",
    "#",
    "\\",
    "\\n",
    "\\u0041",
    "\\ud800",
    ";",
    "0",
    "-1",
    "1",
    "3",
    "1000000000",
    "0.5",
    "nan",
    "1/0",
    "x^99999",
    "9^9^9",
    "(x+y)^9999",
    "e1",
    "e2",
    "e9",
    "2e1",
    "x",
    "h",
    "i",
    "nabla",
    "@",
    "name",
    "basis",
    "dimension",
    "parameters",
    "brackets",
    "structure_constants",
    "matrices",
    "metric",
    "connection",
    "affinities",
    "diag(",
    ")",
    "killing",
    "identity",
    "lambda=",
    "zero",
    "\u{feff}",
    "\u{202e}",
    "\u{1b}[31m",
    "\u{0}",
    "у",
    "true",
    "null",
    "1979-05-27",
];

fn check(name: &'static str, text: String) {
    match Definition::parse(name, &text) {
        Ok(definition) => assert!(definition.dimension() > 0),
        Err(error) => assert_sound(&error),
    }
}

properties! {
    #![cases(256)]

    #[test]
    fn any_text(text in texts()) {
        check("a.toml", text.clone());
        check("a.json", format!("{{{text}"));
    }

    #[test]
    fn nearly_toml(text in mutants(TOML, WORDS)) {
        check("a.toml", text);
    }

    #[test]
    fn nearly_json(text in mutants(JSON, WORDS)) {
        check("a.json", text);
    }

    #[test]
    fn any_expression(text in crate::claims::fuzz::mutation::sentences(WORDS, 8)) {
        let text = text.replace(['\'', '\n', '\r'], "");
        check("a.toml", format!("dimension = 2\nparameters = ['x', 'h']\nbrackets = '''[e1, e2] = {text}'''"));
        check("a.toml", format!("dimension = 2\nbrackets = '''{text}'''"));
        check("a.toml", format!("matrices = [[['{text}']]]"));
        check("a.toml", format!("dimension = 2\nbrackets = ''\nmetric = '{text}'"));
        check("a.toml", format!("dimension = 2\nbrackets = ''\nconnection = '{text}'"));
    }

    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..300)) {
        let mut file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        let path = file.path().to_str().unwrap();
        if let Err(error) = Definition::read(path) {
            assert_sound(&error);
        }
    }
}
