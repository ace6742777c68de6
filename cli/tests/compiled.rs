//! Generated source code, compiled and run.

use affinor_documents::report::Language;
use std::path::Path;
use std::process::Command;

/// The output of a program. `None` if the program is not installed, which is a failure if `CI` is
/// set.
fn output(command: &mut Command) -> Option<String> {
    let output = match command.output() {
        Ok(output) => output,
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "{command:?}: {error}");
            eprintln!("not tested: {command:?}: {error}");
            return None;
        }
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).unwrap())
}

/// Whether Python has NumPy.
pub fn has_numpy() -> bool {
    let import = Command::new("python3").args(["-c", "import numpy"]).output();
    import.is_ok_and(|output| output.status.success())
}

/// A substitute for NumPy with numbers only: it shows that the formulas are right without NumPy.
const NUMPY: &str = "
import itertools
from math import sin, cos, exp, log, sqrt, sinh, cosh, tanh
class Number(float):
    shape = ()
class Array(dict):
    def __init__(self, shape):
        self.shape = shape
        super().__init__((at, 0.0) for at in itertools.product(*map(range, shape)))
    def key(self, at):
        at = at if isinstance(at, tuple) else (at,)
        return tuple(i for i in at if i is not ...)
    def __getitem__(self, at):
        return super().__getitem__(self.key(at))
    def __setitem__(self, at, value):
        assert self.key(at) in self, at
        super().__setitem__(self.key(at), value)
def asarray(x, dtype):
    if not isinstance(x, list):
        return Number(x)
    array = Array((len(x),))
    for i, value in enumerate(x):
        array[i] = value
    return array
def zeros(shape):
    return Array(shape)
def broadcast_shapes(*shapes):
    assert all(shape == () for shape in shapes)
    return ()
def moveaxis(array, source, to):
    return array
def where(condition, x, y):
    return x if condition else y
def ravel(array):
    return array.values()
";

/// The name of the function that the source code defines, and its parameters without `p_`.
pub fn signature(source: &str) -> (String, Vec<String>) {
    let starts = ["pub fn ", "void ", "def "];
    let line = |line: &&str| starts.iter().any(|start| line.starts_with(start));
    let line = source.lines().find(line).unwrap();
    let (name, rest) = line.split_once('(').unwrap();
    let words = rest.split(|c: char| !c.is_alphanumeric() && c != '_');
    let parameters = words.filter_map(|word| word.strip_prefix("p_")).map(str::to_string);
    (name.split(' ').next_back().unwrap().to_string(), parameters.collect())
}

/// Compiles the function with a main program that prints all components of its arrays, and runs it.
/// `None` if the compiler is not installed.
pub fn run(
    folder: &Path,
    language: Language,
    source: &str,
    vectors: &[&[f64]],
    parameter: &dyn Fn(&str) -> f64,
    shapes: &[Vec<usize>],
) -> Option<Vec<f64>> {
    run_at(folder, language, source, vectors, &[parameter], shapes)
}

/// As [`run`], for several values of the parameters, one after another.
pub fn run_at(
    folder: &Path,
    language: Language,
    source: &str,
    vectors: &[&[f64]],
    points: &[&dyn Fn(&str) -> f64],
    shapes: &[Vec<usize>],
) -> Option<Vec<f64>> {
    let file = |name: &str| folder.join(name);
    let (function, parameters) = signature(source);
    let [open, close] = match language {
        Language::Rust => ["&[", "]"],
        Language::C => ["(const double[]){", "}"],
        Language::Python => ["[", "]"],
    };
    let list = |v: &[f64]| v.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ");
    let names: Vec<String> = (0..shapes.len()).map(|at| format!("a{at}")).collect();
    let call = |parameter: &&dyn Fn(&str) -> f64| {
        let vectors = vectors.iter().map(|v| format!("{open}{}{close}", list(v)));
        let numbers = parameters.iter().map(|name| format!("{:?}", parameter(name)));
        let mut arguments: Vec<String> = vectors.chain(numbers).collect();
        if language == Language::C {
            arguments.extend(names.clone());
        }
        format!("{function}({})", arguments.join(", "))
    };
    let calls = points.iter().map(call);
    let tuple = if names.len() == 1 { names[0].clone() } else { format!("({})", names.join(", ")) };
    let mut command = match language {
        Language::Rust => {
            let print = |(name, shape): (&String, &Vec<usize>)| {
                let flat = match shape.len() {
                    0 => format!("[{name}].iter()"),
                    rank => format!("{name}.iter(){}", ".flatten()".repeat(rank - 1)),
                };
                format!("for x in {flat} {{ println!(\"{{x:e}}\"); }} ")
            };
            let prints: String = names.iter().zip(shapes).map(print).collect();
            let body: String =
                calls.map(|call| format!("{{ let {tuple} = {call}; {prints} }}\n")).collect();
            let main = format!("{source}\nfn main() {{ {body} }}\n");
            std::fs::write(file("main.rs"), main).unwrap();
            let mut rustc = Command::new("rustc");
            rustc.arg("main.rs").args(["-o", "rust", "-D", "warnings"]).current_dir(folder);
            output(&mut rustc)?;
            Command::new(file("rust"))
        }
        Language::C => {
            let (mut declared, mut prints) = (String::new(), String::new());
            for (name, shape) in names.iter().zip(shapes) {
                let size: usize = shape.iter().product();
                let shape = if shape.is_empty() { vec![1] } else { shape.clone() };
                let lengths: String = shape.iter().map(|n| format!("[{n}]")).collect();
                declared += &format!("static double {name}{lengths}; ");
                // the arrays are not cleared, so that zeros must be written
                declared +=
                    &format!("for (int i = 0; i < {size}; i++) ((double *){name})[i] = 7; ");
                prints += &format!(
                    "for (int i = 0; i < {size}; i++) printf(\"%.17e\\n\", ((double *){name})[i]); "
                );
            }
            let body: String =
                calls.map(|call| format!("{{ {declared} {call}; {prints} }}\n")).collect();
            let main =
                format!("#include <stdio.h>\n{source}\nint main(void) {{ {body} return 0; }}\n");
            std::fs::write(file("main.c"), main).unwrap();
            let mut cc = Command::new("cc");
            cc.args(["-std=c99", "-Wall", "-Werror", "main.c", "-o", "c", "-lm"]);
            output(cc.current_dir(folder))?;
            Command::new(file("c"))
        }
        Language::Python => {
            if !has_numpy() {
                std::fs::write(file("numpy.py"), NUMPY).unwrap();
            }
            let body = calls.map(|call| {
                let names = names.join(", ");
                format!(
                    "{tuple} = {call}\nfor a in ({names},):\n    for x in np.ravel(a):\n        \
                     print(repr(float(x)))\n"
                )
            });
            let main = format!("{source}\n{}", body.collect::<String>());
            std::fs::write(file("main.py"), main).unwrap();
            let mut python = Command::new("python3");
            python.arg("main.py");
            python
        }
    };
    let lines = output(command.current_dir(folder))?;
    Some(lines.lines().map(|line| line.parse().unwrap()).collect())
}

/// The output of a Python program; `None` without Python or NumPy.
pub fn run_numpy(folder: &Path, main: &str) -> Option<String> {
    if !has_numpy() {
        eprintln!("not tested: python3 has no NumPy");
        return None;
    }
    std::fs::write(folder.join("arrays.py"), main).unwrap();
    output(Command::new("python3").arg("arrays.py").current_dir(folder))
}
