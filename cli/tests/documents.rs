//! The documents agree with the program: quoted outputs, formats, limits and translations.
//!
//! A fenced block `console` contains commands after `$ ` and their exact standard output.
//! `UPDATE_DOCUMENTS=1 cargo test -p affinor-cli documents::` writes the current output.

use crate::program::{root, run, words};
use affinor::{Bracket, Connection, LieAlgebra, Metric};
use affinor_tensors::{Down, Rational, Tensor, expression};
use serde_json::Value;
use std::path::PathBuf;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The pages of these folders, and of the root. Their quoted outputs and their links are tested.
const FOLDERS: [&str; 4] = ["", "docs", "docs/how-to", "benches/results"];

/// The paths of the pages, from the root.
fn pages() -> Result<Vec<PathBuf>, std::io::Error> {
    let mut pages = vec![];
    for folder in FOLDERS {
        for entry in std::fs::read_dir(root().join(folder))? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    Ok(pages)
}

/// The standard output of `affinor ARGUMENTS`.
fn output(command: &str) -> Result<String, Box<dyn std::error::Error>> {
    let arguments = command.strip_prefix("affinor ").ok_or("not a command of affinor")?;
    let outcome = run(root(), &words(arguments), b"");
    if outcome.status == 2 {
        return Err(format!("{command}: {}", outcome.err).into());
    }
    Ok(outcome.out)
}

/// The document with the current output in every quotation.
fn refreshed(document: &str) -> Result<String, Box<dyn std::error::Error>> {
    let (mut fresh, mut lines) = (String::new(), document.lines());
    while let Some(line) = lines.next() {
        fresh += &format!("{line}\n");
        if line != "```console" {
            continue;
        }
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        for line in block {
            if let Some(command) = line.strip_prefix("$ ") {
                fresh += &format!("{line}\n{}", output(command)?);
            }
        }
        fresh += "```\n";
    }
    Ok(fresh)
}

#[test]
fn quoted_outputs_are_what_the_program_prints() -> Outcome {
    let mut quoting = 0;
    for path in pages()? {
        let (name, document) = (path.display(), std::fs::read_to_string(&path)?);
        if !document.contains("```console\n$ affinor ") {
            continue;
        }
        quoting += 1;
        let fresh = refreshed(&document)?;
        if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
            std::fs::write(&path, fresh)?;
        } else {
            let differing = fresh.lines().zip(document.lines()).find(|(now, quoted)| now != quoted);
            assert_eq!(differing, None, "{name}: (now, quoted)");
            assert_eq!(fresh, document, "{name}");
        }
    }
    assert!(quoting >= 10, "{quoting} pages quote outputs");
    Ok(())
}

/// The targets of the links in a document that are neither addresses nor anchors.
fn links(document: &str) -> impl Iterator<Item = &str> {
    let targets = document.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    targets
        .map(|(target, _)| target)
        .filter(|target| !target.contains("://") && !target.starts_with('#'))
}

#[test]
fn links_lead_somewhere() -> Outcome {
    for path in pages()? {
        let folder = path.parent().map(PathBuf::from).unwrap_or_default();
        for target in links(&std::fs::read_to_string(&path)?) {
            let file = target.split_once('#').map_or(target, |(file, _)| file);
            assert!(folder.join(file).exists(), "{}: {target}", path.display());
        }
    }
    Ok(())
}

/// The lines of a program without their indent.
fn lines(code: &str) -> Vec<&str> {
    code.lines().map(str::trim).collect()
}

#[test]
fn the_code_of_the_tutorial_is_part_of_the_examples() -> Outcome {
    let mut programs = vec![];
    for entry in std::fs::read_dir(root().join("examples"))? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            programs.push(std::fs::read_to_string(path)?);
        }
    }
    let page = std::fs::read_to_string(root().join("docs/rust.md"))?;
    let blocks: Vec<&str> = page.split("```rust\n").skip(1).collect();
    assert!(!blocks.is_empty());
    for block in blocks {
        let (code, _) = block.split_once("\n```").ok_or("a block that does not end")?;
        let quoted = lines(code);
        let holds = |program: &String| {
            lines(program).windows(quoted.len()).any(|window| window == quoted.as_slice())
        };
        assert!(programs.iter().any(holds), "{code}");
    }
    Ok(())
}

/// Every key that occurs anywhere in `value`, except names that are data.
fn keys<'v>(value: &'v Value, found: &mut Vec<&'v str>) {
    match value {
        Value::Object(object) => {
            for (key, inner) in object {
                found.push(key);
                if key != "conventions" {
                    keys(inner, found);
                }
            }
        }
        Value::Array(items) => items.iter().for_each(|item| keys(item, found)),
        _ => {}
    }
}

#[test]
fn formats_names_every_key_of_every_schema() -> Outcome {
    let formats = std::fs::read_to_string(root().join("docs/formats.md"))?;
    let stored = tempfile::Builder::new().suffix(".json").tempfile()?;
    let path = stored.path().to_str().ok_or("a path that is not valid text")?.to_string();
    std::fs::write(
        &path,
        output("affinor table so3@zero --show torsion,curvature --format json")?,
    )?;
    let commands = [
        (
            "affinor.table/1",
            "affinor table so3 --metric \"diag(a,b,c)\" --show all --independent".into(),
        ),
        ("affinor.table/1", "affinor table so3@zero --scalar float".into()),
        ("affinor.table/1", "affinor table examples/definitions/sphere.toml".into()),
        ("affinor.compare/1", "affinor compare M3 so3@zero".into()),
        (
            "affinor.check/1",
            "affinor check --basis \"x y z\" --bracket \"[x,y]=z; [y,z]=y\"".into(),
        ),
        ("affinor.verify/1", format!("affinor verify so3@plus \"{path}\"")),
        ("affinor.verify/1", format!("affinor verify so3@plus \"{path}\" \"{path}\"")),
        ("affinor.claims/1", "affinor claims so3@plus --claim torsion=0 --claim flat".into()),
        (
            "affinor.equations/1",
            "affinor equations so3 --metric \"diag(a,b,c)\" --connection zero".into(),
        ),
        (
            "affinor.equations/1",
            "affinor equations examples/definitions/sphere.toml --kind autoparallel".into(),
        ),
        ("affinor.list/1", "affinor list".into()),
        ("affinor.list/1", "affinor list --where \"dimension=2\"".into()),
        ("affinor.info/1", "affinor info \"iso(2,1)\"".into()),
        ("affinor.info/1", "affinor info \"bianchi(II)\"".into()),
        ("affinor.homogeneous/1", "affinor info \"CP^2\"".into()),
        ("affinor.table/1", "affinor table \"CP^2\" --metric killing".into()),
        ("affinor.properties/1", "affinor properties M3".into()),
        ("affinor.properties/1", "affinor properties SO3".into()),
        ("affinor.isometries/1", "affinor isometries so3 --metric \"diag(a,a,b)\"".into()),
        ("affinor.isometries/1", "affinor isometries sphere --fields".into()),
        ("affinor.spacetime/1", "affinor spacetime schwarzschild".into()),
        ("affinor.hypersurface/1", "affinor hypersurface schwarzschild --function r".into()),
        ("affinor.forms/1", "affinor forms sphere --form \"cos(theta)*dphi\"".into()),
        (
            "affinor.geodesic/1",
            "affinor geodesic so3 --metric \"diag(1,2,3)\" --from 0,0,0 --to 0.3,1,-0.5".into(),
        ),
        (
            "affinor.horizontal/1",
            "affinor geodesic se2 --distribution \"e1, p1\" --covector 1,0,2 --time 3".into(),
        ),
        (
            "affinor.horizontal/1",
            "affinor geodesic se2 --distribution \"e1, p1\" --from 0,0,0 --to 1,1,0".into(),
        ),
        (
            "affinor.solve/1",
            "affinor solve so3 --metric \"diag(1,p^3-1,q^2-1)\" --for einstein".into(),
        ),
        ("affinor.mobility/1", "affinor mobility examples/mechanisms/bennett.toml".into()),
        ("affinor.mobility/1", "affinor mobility examples/mechanisms/bricard.toml".into()),
        (
            "affinor.linearization/1",
            "affinor linearize examples/mechanisms/double_pendulum.toml".into(),
        ),
        ("affinor.solve/1", "affinor solve se2 --metric \"diag(a,b,c)\" --for flat".into()),
        ("affinor.rep/1", "affinor rep G2 7 --power 2 --tensor 7 --weights".into()),
        ("affinor.rep/1", "affinor rep \"SU(5)\" 10 --branch \"SU(3)xSU(2)xU(1)\"".into()),
        ("affinor.matrices/1", "affinor rep G2 7 --matrices".into()),
        ("affinor.coupling/1", "affinor coupling 1 1/2".into()),
        ("affinor.conventions/1", "affinor conventions".into()),
    ];
    for (schema, command) in commands {
        let all: Value = serde_json::from_str(&output(&format!("{command} --format json"))?)?;
        assert_eq!(all["schema"], schema, "{command}");
        assert!(formats.contains(&format!("## {schema}\n")), "{schema} has no section");
        let mut found = vec![];
        keys(&all, &mut found);
        for key in found {
            let named = [format!("`{key}`"), format!("\"{key}\"")];
            assert!(named.iter().any(|name| formats.contains(name)), "{schema}: {key}");
        }
    }
    Ok(())
}

#[test]
fn the_documents_state_the_limits() -> Outcome {
    let texts =
        ["README.md", "docs/limits.md"].map(|name| std::fs::read_to_string(root().join(name)));
    let [readme, limits] = texts;
    let all = readme? + &limits?;
    let stated_texts = all.split_whitespace().collect::<Vec<_>>().join(" ");
    let stated = [
        format!("at most {} dimensions", affinor::algebra::catalogue::MAX_DIMENSION),
        format!("at most {} indices", affinor_tensors::Indices::MAX),
        format!("at most {} digits", expression::MAX_DIGITS),
        format!("exponent is at most {}", expression::MAX_EXPONENT),
        format!("nest at most {} deep", expression::MAX_DEPTH),
        format!("at most {} signs", expression::MAX_SIGNS),
        format!("Rust {}", env!("CARGO_PKG_RUST_VERSION")),
    ];
    for limit in stated {
        assert!(stated_texts.contains(&limit), "{limit}");
    }
    Ok(())
}

/// aff(1), `[x, y] = y`, with orthonormal x and y.
fn hyperbolic_plane() -> Result<(LieAlgebra<Rational>, Connection<Rational>), affinor::Error> {
    let bracket = Bracket::from_fn(&["x", "y"], |_, _| vec![(1, Rational::from(1))])?;
    let algebra = LieAlgebra::try_from(bracket)?;
    let identity = Tensor::from_fn(2, [Down, Down], |[i, j]| Rational::from(i64::from(i == j)))?;
    let metric = Metric::new(algebra.labels(), identity)?;
    let connection = Connection::levi_civita(algebra.left_frame(), &metric)?;
    Ok((algebra, connection))
}

const PLANE: [usize; 2] = [0, 1];

#[test]
fn mtw_13_23_is_ours_with_the_direction_last() -> Outcome {
    let (algebra, connection) = hyperbolic_plane()?;
    // c_abm = c_ab^n g_nm, the metric being the identity
    let c = |a, b, m| algebra.structure_constants().get(&[m, a, b]);
    let half = Rational::new(1, 2).ok_or("1/2")?;
    for (m, b, d) in triples() {
        let gamma = (c(m, b, d) + &c(m, d, b) - &c(b, d, m)) * &half;
        assert_eq!(gamma, connection.affinities().get(&[m, d, b]), "Gamma_{m}{b}{d}");
    }
    Ok(())
}

#[test]
fn the_curvature_of_sage_is_ours_and_that_of_geomstats_its_negative() -> Outcome {
    let (algebra, connection) = hyperbolic_plane()?;
    let curvature = connection.curvature();
    let zero = || Rational::from(0);
    let c = |i, j, k| algebra.structure_constants().get(&[i, j, k]);
    // Sage: gam[k,i,j] with the direction last
    let gam = |k, i, j| connection.affinities().get(&[k, j, i]);
    // geomstats: nabla(x, y), the direction first, by components
    let nabla = |x: &[Rational; 2], y: &[Rational; 2]| {
        PLANE.map(|i| {
            let terms = PLANE.into_iter().flat_map(|j| PLANE.map(|k| (j, k)));
            terms.fold(zero(), |sum, (j, k)| {
                sum + &(connection.affinities().get(&[i, j, k]) * &x[j] * &y[k])
            })
        })
    };
    let e = |j: usize| PLANE.map(|i| Rational::from(i64::from(i == j)));
    for (j, k, l) in triples() {
        let bracket = PLANE.map(|i| c(i, k, l));
        let (kl, lk) = (nabla(&e(k), &nabla(&e(l), &e(j))), nabla(&e(l), &nabla(&e(k), &e(j))));
        let geomstats = nabla(&bracket, &e(j));
        for i in PLANE {
            let sage = PLANE.into_iter().fold(zero(), |sum, m| {
                sum + &(gam(i, m, k) * &gam(m, j, l))
                    - &(gam(i, m, l) * &gam(m, j, k))
                    - &(gam(i, j, m) * &c(m, k, l))
            });
            let ours = curvature.get(&[i, j, k, l]);
            assert_eq!(sage, ours);
            assert_eq!(geomstats[i].clone() - &kl[i] + &lk[i], -ours);
        }
    }
    assert!(!curvature.is_empty());
    Ok(())
}

fn triples() -> impl Iterator<Item = (usize, usize, usize)> {
    PLANE.into_iter().flat_map(|a| PLANE.into_iter().flat_map(move |b| PLANE.map(|c| (a, b, c))))
}
