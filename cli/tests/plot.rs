//! Plots: well-formed SVG with every label, PNG of the requested size, and errors.

mod motions;

use crate::program::{Outcome, run};
use roxmltree::Document;
use std::collections::BTreeSet;
use std::fs;
use tempfile::TempDir;

/// Names of figures, alternative names, and labels that the figure must contain.
const FIGURES: [(&str, &str, &[&str]); 5] = [
    ("images", "figure2", &["e", "p", "γ", "η", "n", "nₚ", "w", "Ω", "ω", "Ψ¹", "Ψ²", "Ψ³"]),
    ("transport", "figure3", &["M(3): connection plus", "SO(3): connection zero", "ω′", "Ω", "ω"]),
    ("autoparallels", "figure4", &["e", "n", "q", "q¹", "q²", "q³", "η(s)"]),
    ("motion", "figure5", &["γ", "p", "w", "R E₁", "R E₂", "R E₃"]),
    ("frames", "figure6", &["e₁", "e₂", "e₃", "e₁(p)", "e₂(p)", "e₃(p)"]),
];

pub fn affinor(folder: &TempDir, arguments: &[&str]) -> Outcome {
    run(folder.path(), &[&["plot"], arguments].concat(), b"")
}

/// The texts of an SVG; empty for other formats.
pub fn texts(svg: &str) -> BTreeSet<String> {
    let document = Document::parse(svg).unwrap();
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "svg");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    let texts =
        root.descendants().filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")));
    texts.map(|node| node.text().unwrap().trim().to_string()).collect()
}

/// The width and height in the head of a PNG.
#[cfg(feature = "png")]
fn size(png: &[u8]) -> [u32; 2] {
    assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

#[test]
fn every_figure_is_svg_with_its_labels() {
    let folder = TempDir::new().unwrap();
    for (name, alias, labels) in FIGURES {
        let outcome = affinor(&folder, &[name]);
        assert_eq!((outcome.status, outcome.err.as_str()), (0, ""), "{name}");
        let texts = texts(&outcome.out);
        for label in labels {
            assert!(texts.contains(*label), "{name}: {label} in {texts:?}");
        }
        assert_eq!(affinor(&folder, &[alias, "-o", "x.svg"]).status, 0);
        assert_eq!(fs::read_to_string(folder.path().join("x.svg")).unwrap(), outcome.out);
    }
}

#[cfg(feature = "png")]
#[test]
fn a_png_has_its_width_and_is_no_empty_sheet() {
    let folder = TempDir::new().unwrap();
    for width in ["300", "801"] {
        let outcome = affinor(&folder, &["images", "--width", width, "-o", "x.PNG"]);
        assert_eq!((outcome.status, outcome.out.as_str(), outcome.err.as_str()), (0, "", ""));
        let png = fs::read(folder.path().join("x.PNG")).unwrap();
        let [found, height] = size(&png);
        assert_eq!(found.to_string(), width);
        assert!(height > found / 2 && height < 2 * found);
        let pixels = resvg::tiny_skia::Pixmap::decode_png(&png).unwrap();
        let colors: BTreeSet<[u8; 4]> =
            pixels.pixels().iter().map(|p| [p.red(), p.green(), p.blue(), p.alpha()]).collect();
        assert!(colors.len() > 100, "{}", colors.len());
    }
}

#[cfg(not(feature = "png"))]
#[test]
fn a_png_without_the_feature_is_refused_by_its_name() {
    let folder = TempDir::new().unwrap();
    let outcome = affinor(&folder, &["images", "-o", "x.PNG"]);
    assert_eq!((outcome.status, outcome.out.as_str()), (2, ""));
    assert!(outcome.err.contains("without the feature `png`"), "{}", outcome.err);
    assert!(outcome.err.contains("--features png"), "{}", outcome.err);
}

/// File names are escaped as XML text.
#[test]
fn texts_are_escaped() {
    let folder = TempDir::new().unwrap();
    let brackets = "basis = [\"x\", \"y\", \"z\"]\nbrackets = \"[x,y]=z; [y,z]=x; [z,x]=y\"\n";
    let brackets = brackets.replace("; ", "\\n");
    fs::write(folder.path().join("x.toml"), format!("name = \"a<b> & \\\"c\\u0001\"\n{brackets}"))
        .unwrap();
    let outcome = affinor(&folder, &["dynkin", "x.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert!(texts(&outcome.out).contains("a<b> & \"c"), "{}", outcome.out);
}

#[test]
fn options_change_what_is_drawn() {
    let folder = TempDir::new().unwrap();
    let out = |arguments: &[&str]| {
        let outcome = affinor(&folder, arguments);
        assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
        outcome.out
    };
    let plain = out(&["frames"]);
    for arguments in [
        &["--fraction", "0.3"][..],
        &["--view", "-60, 10"],
        &["--factor", "0,0,-pi/2", "--factor", "1,0,0"],
        &["--connection", "lambda=1/3"],
        &["--width", "400"],
    ] {
        assert_ne!(out(&[&["frames"], arguments].concat()), plain, "{arguments:?}");
    }
    let both = ["--connection", "minus", "--connection", "levi-civita", "--metric", "diag(1,2,3)"];
    let texts = texts(&out(&[&["autoparallels"][..], &both].concat()));
    assert!(texts.contains("connection minus") && texts.contains("connection levi-civita"));
    assert_ne!(out(&["autoparallels", "--axis", "0,0,1"]), out(&["autoparallels"]));
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let folder = TempDir::new().unwrap();
    let cases: [(&[&str], &str); 12] = [
        (&["circles"], "circles"),
        (&[], "Usage"),
        (&["images", "-o", "x.jpg"], "neither .svg, .png nor .gif"),
        (&["images", "-o", "x"], "neither .svg, .png nor .gif"),
        (&["images", "-o", "missing/x.svg"], "cannot write missing/x.svg"),
        (&["images", "--width", "0"], "--width 0"),
        (&["images", "--width", "100000"], "--width 100000"),
        (&["images", "--fraction", "2"], "--fraction 2"),
        (&["images", "--fraction", "nan"], "--fraction NaN"),
        (&["images", "--factor", "1,2"], "3 numbers, not 2"),
        (&["images", "--view", "1"], "2 numbers, not 1"),
        (&["transport", "--connection", "flat"], "flat"),
    ];
    for (arguments, message) in cases {
        let outcome = affinor(&folder, arguments);
        assert_eq!((outcome.status, outcome.out.as_str()), (2, ""), "{arguments:?}");
        assert!(outcome.err.contains(message), "{arguments:?}: {}", outcome.err);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn extreme_numbers_neither_panic_nor_hang() {
    let folder = TempDir::new().unwrap();
    for arguments in [
        &["images", "--factor", "1e300, 0, 0"][..],
        &["images", "--factor", "1e-300, 0, 0"],
        &["images", "--factor", "pi, 0, 0", "--fraction", "1"],
        &["motion", "--factor", "0, 0, 0"],
        &["frames", "--connection", "plus", "--factor", "1e9, 0, 0"],
        &["transport", "--factor", "1e9, 1, 0", "--fraction", "0"],
        &["autoparallels", "--axis", "0, 0, 0"],
        &["autoparallels", "--axis", "1e12, 0, 0"],
        &["autoparallels", "--axis", "20, 0, 0", "--view", "1e300, -1e300"],
    ] {
        let outcome = affinor(&folder, arguments);
        assert!((0..=2).contains(&outcome.status), "{arguments:?}: {}", outcome.err);
        if outcome.status == 0 {
            texts(&outcome.out);
        } else {
            assert!(outcome.err.contains("error"), "{arguments:?}: {}", outcome.err);
        }
    }
}

/// The quantities for a figure of a motion are computed, whichever columns the problem writes.
#[test]
fn a_motion_needs_no_columns_to_be_drawn() {
    let folder = TempDir::new().unwrap();
    let body = "metric = \"diag(1, 2, 3)\"\ninitial.velocity = [0.3, -0.2, 0.5]\n\
                output = { end = 2, every = 0.5, columns = [\"energy\"] }\n";
    let problem = format!("space = \"so3\"\n{body}[quantities]\ng11 = \"H1\"\n");
    fs::write(folder.path().join("body.toml"), &problem).unwrap();
    let all = problem.replace("\"energy\"", "\"t\", \"element\", \"H\", \"energy\"");
    fs::write(folder.path().join("all.toml"), format!("name = \"body\"\n{all}")).unwrap();
    let simulated = run(folder.path(), &["simulate", "all.toml", "-o", "all.csv"], b"");
    assert_eq!(simulated.status, 0, "{}", simulated.err);
    for figure in ["attitude", "momentum", "drift", "animation"] {
        let drawn = affinor(&folder, &[figure, "body.toml"]);
        assert_eq!(drawn.status, 0, "{figure}: {}", drawn.err);
        let from_rows = affinor(&folder, &[figure, "body.toml", "--rows", "all.csv"]);
        assert_eq!(from_rows.status, 0, "{figure}: {}", from_rows.err);
        let words = |svg: &str| -> BTreeSet<String> {
            texts(svg).into_iter().filter(|text| text.parse::<f64>().is_err()).collect()
        };
        assert_eq!(words(&drawn.out), words(&from_rows.out), "{figure}");
    }
    fs::write(folder.path().join("few.csv"), "t,energy\n0,1\n").unwrap();
    for (figure, help) in [
        ("attitude", "the columns `g11`"),
        ("animation", "the columns `g11`"),
        ("momentum", "the columns `H1`"),
    ] {
        let refused = affinor(&folder, &[figure, "body.toml", "--rows", "few.csv"]);
        assert_eq!(refused.status, 1, "{figure}");
        assert!(refused.err.contains(help), "{figure}: {}", refused.err);
    }
    // matrices with three rows that are not rotations, coordinates, a flow
    let brackets = "definition.basis = [\"a\", \"b\", \"c\"]\ndefinition.brackets = ";
    let flow = "flow = { kind = \"toda\", positions = [0, 0], momenta = [1, -1] }\n\
                output = { end = 1 }\nintegrator.step = 0.1\n";
    let cases = [
        format!("{brackets}\"\"\"\n[a,c] = a\n[b,c] = -7/10*b\n\"\"\"\n{body}"),
        format!("space = \"heisenberg3\"\n{body}"),
        format!("{brackets}\"[a,b] = c\"\n{body}"),
        format!("space = \"R^3\"\nparameters.g = 1\n{body}"),
        flow.into(),
    ];
    for problem in cases {
        fs::write(folder.path().join("other.toml"), &problem).unwrap();
        for figure in ["attitude", "momentum", "animation"] {
            let refused = affinor(&folder, &[figure, "other.toml"]);
            assert_eq!((refused.status, &*refused.out), (1, ""), "{figure}: {problem}");
            assert!(refused.err.contains("a rotating body"), "{figure}: {}", refused.err);
        }
    }
}
