//! Errors name the location of the fault, in TOML and in JSON.
//!
//! Guards `InputError`, from definitions and problems.

use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;
use affinor_documents::space::Definition;

const BODY: &str = "space = 'so3'\nmetric = 'identity'\ninitial.velocity = [1, 0, 0]\n\
                    output = { end = 1 }\n";

/// Checks that the error underlines the part of the text between « and ».
#[track_caller]
fn underlines(marked: &str, name: &str, read: impl Fn(&str, &str) -> Result<(), InputError>) {
    let start = marked.find('«').unwrap();
    let end = marked.find('»').unwrap() - '«'.len_utf8();
    let error = read(name, &marked.replace(['«', '»'], "")).unwrap_err();
    let place = error.at.clone().unwrap();
    assert_eq!(place.span, Some(start..end), "{error}: {:?}", place.text());
}

#[track_caller]
fn problem(marked: &str) {
    let read = |name: &str, text: &str| Problem::parse(name, text)?.motion(0).map(drop);
    underlines(marked, if marked.starts_with('{') { "a.json" } else { "a.toml" }, read);
}

#[track_caller]
fn definition(marked: &str) {
    let read = |name: &str, text: &str| Definition::parse(name, text).map(drop);
    underlines(marked, if marked.starts_with('{') { "a.json" } else { "a.toml" }, read);
}

/// The location is the key in its table, not the first key with this name in the file.
#[test]
fn keys() {
    problem(&format!("{BODY}[forces]\n«spatial» = []\n"));
    problem(&format!("{BODY}forces.«spatial» = []\n"));
    problem(&format!("{BODY}# body\n[forces]\n«body» = []\nspatial = [0, 0, 1]\n"));
    problem(
        &format!("# metric = 1\ninertia.moments = [1, 1, 1]\n{BODY}")
            .replace("inertia", "«inertia»"),
    );
    problem(
        "{\"space\": \"so3\", \"metric\": \"identity\", \"initial\": {\"velocity\": [1, 0, 0]}, \
         \"output\": {\"end\": 1}, \"forces\": {«\"spatial\"»: []}}",
    );
    problem(&BODY.replace("velocity = [1, 0, 0]", "«velocity» = [1, 0]"));
    problem(&format!("{BODY}[integrator]\nmethod = 'exact'\nstep = «0.1»\n"));
    definition("dimension = 2\nbrackets = ''\n[connection]\nkind = 'zero'\n«affinities» = ''\n");
}

/// Values have locations: numbers, and parts of strings with and without escapes.
#[test]
fn values() {
    problem(&format!("{BODY}[forces]\nspatial = [«1e999», 0, 0]\n").replace("1e999", "inf"));
    problem(&format!("{BODY}[forces]\nspatial = [0, 0, '2*«wind»']\n"));
    problem(&format!("{BODY}[forces]\nspatial = [0, 0, \"\\u0032*«wind»\"]\n"));
    problem(&BODY.replace("'identity'", "'diag(1, 2/«0», 3)'"));
    problem(&BODY.replace("'identity'", "[['1', 0, 0], [0, '1 + «/»', 0], [0, 0, 1]]"));
    definition("dimension = 2\nbrackets = \"\"\"\n[e1, e2] = e1 # \\t\n[e1, «e3»] = e1\n\"\"\"\n");
    definition("basis = ['x', 'y', «'x'»]\nbrackets = ''\n".replace("«'x'»", "'«x»'").as_str());
    definition("{\"dimension\": 2, \"brackets\": \"[e1, e2] = e1\\n[e1, «e3»] = e1\"}");
    definition("{\"dimension\": 2, \"structure_constants\": [[1, 2, 1, \"1 + «*»\"]]}");
    // a continued line, an escaped letter, and quotes without escapes
    definition("dimension = 2\nbrackets = \"\"\"\n[e1, e2] \\\n   = e1 + «e3»\n\"\"\"\n");
    definition("dimension = 2\nbrackets = \"# \\u00e9\\n[e1,\\t«e3»] = e1\"\n");
    definition("dimension = 2\nbrackets = '''\r\n[e1, «e3»] = e1'''\n");
    definition("dimension = 2\nbrackets = '[e1, «e3»] = e1 # \\n'\n");
    definition("{\"dimension\": 2, \"brackets\": «7»}");
    definition("{\"dimension\": 2, \"brackets\": \"\", «\"brackets\"»: \"\"}");
}
