//! Plots of trajectories: curves, ends and directions, captions and colours, drift, slopes,
//! animations.

use crate::plot::{affinor, texts};
use crate::program::{root, run};
use roxmltree::{Document, Node};
use std::collections::BTreeSet;
use std::fs;
use tempfile::TempDir;

/// A rotation about the third axis in space and body, with one row at its end.
const WHEEL: &str = "space = \"so3\"\nmetric = \"diag(1, 2, 2.5)\"\ninitial.velocity = [0, 0, 1]\n\
                     output = { end = 6.283185307179586 }\n";
/// A ball that is thrown to the right; its few steps reach only seven points of the path.
const BALL: &str = "space = \"R^2\"\nmetric = \"diag(2, 2)\"\ninitial.velocity = [3, 12]\n\
                    forces.potential = \"12*x2\"\nintegrator.step = 0.5\noutput = { end = 3 }\n";

fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, content) in files {
        fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

fn drawn(folder: &TempDir, arguments: &[&str]) -> String {
    let outcome = affinor(folder, arguments);
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.err);
    texts(&outcome.out);
    outcome.out
}

fn example(name: &str) -> String {
    format!("{}/examples/motions/{name}.toml", root().display())
}

fn points(text: &str) -> Vec<[f64; 2]> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    text.split_whitespace().map(point).collect()
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The elements with this tag.
fn all<'a>(svg: &'a Document, name: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    svg.descendants().filter(move |node| node.tag_name().name() == name)
}

/// The polylines of a colour, or of all colours.
fn lines(svg: &str, stroke: &str) -> Vec<Vec<[f64; 2]>> {
    let svg = Document::parse(svg).unwrap();
    let lines = all(&svg, "polyline");
    let lines = lines.filter(|node| node.attribute("stroke").unwrap().starts_with(stroke));
    lines.map(|node| points(node.attribute("points").unwrap())).collect()
}

#[test]
fn curves_are_smooth_whatever_the_rows() {
    for (name, integrator) in [
        ("exact", ""),
        ("controlled", "integrator = { method = \"rkmk853\", tolerance = 1e-9 }\n"),
        ("fixed", "integrator = { method = \"rkmk4\", step = 0.7 }\n"),
    ] {
        let folder = folder(&[("wheel.toml", &format!("{WHEEL}{integrator}"))]);
        let svg = drawn(&folder, &["attitude", "wheel.toml"]);
        // the curves of the first axis on both sides of the sphere, of radius 249
        for stroke in ["#a3173f", "#daa2b2"] {
            let path = lines(&svg, stroke).into_iter().max_by_key(Vec::len).unwrap();
            assert!(path.len() > 12, "{name} {stroke}: {}", path.len());
            let longest =
                path.windows(2).map(|pair| distance(&pair[0], &pair[1])).fold(0.0, f64::max);
            assert!(longest < 40.0, "{name} {stroke}: {longest}");
        }
    }
    // five rows of a top that rotates by three hundred radians
    let folder = TempDir::new().unwrap();
    let svg = drawn(&folder, &["attitude", &example("heavy_top")]);
    let count: usize = lines(&svg, "#1f4e9c").iter().map(Vec::len).sum();
    assert!(count > 1000, "{count}");
    assert!(svg.len() < 2_000_000);
}

#[test]
fn both_sides_of_the_sphere_and_both_ends_differ() {
    let folder = folder(&[("wheel.toml", WHEEL)]);
    let svg = drawn(&folder, &["attitude", "wheel.toml"]);
    for caption in ["start of a path", "end of a path", "far side: thin and pale"] {
        assert!(texts(&svg).contains(caption), "{caption}");
    }
    // the circle of the first axis is drawn once on each side, below and above the middle
    let height = |stroke| {
        let path = lines(&svg, stroke).into_iter().max_by_key(Vec::len).unwrap();
        path.iter().map(|point| point[1]).sum::<f64>() / path.len() as f64
    };
    assert!(height("#a3173f") > height("#daa2b2") + 100.0);
}

/// The arrowheads of a ball that is thrown to the right point right. Its parabola is smooth, not a
/// polygon of its steps.
#[test]
fn a_phase_plot_has_a_direction_a_start_and_an_end() {
    let folder = folder(&[("ball.toml", BALL)]);
    let svg = drawn(&folder, &["phase", "ball.toml", "--columns", "x1,x2"]);
    assert!(texts(&svg).is_superset(&["start", "end", "x1", "x2"].map(String::from).into()));
    let path = lines(&svg, "#111111").into_iter().max_by_key(Vec::len).unwrap();
    assert!(path.len() > 4 * 7, "{}", path.len());
    let document = Document::parse(&svg).unwrap();
    let heads: Vec<_> = all(&document, "polygon").collect();
    assert_eq!(heads.len(), 3);
    for head in heads {
        let corners = points(head.attribute("points").unwrap());
        // from the base of the arrowhead to its tip
        assert!(corners[2][0] < corners[0][0], "{corners:?}");
    }
    let discs: Vec<[f64; 2]> = all(&document, "circle")
        .map(|disc| ["cx", "cy"].map(|key| disc.attribute(key).unwrap().parse().unwrap()))
        .collect();
    // a disc marks the end, a ring the start
    assert_eq!(discs, [path[path.len() - 1], path[0], path[0]]);
}

#[test]
fn a_section_has_a_point_for_each_row() {
    let problem = "space = \"so3\"\nmetric = \"diag(2, 3, 4)\"\ninitial.velocity = [1, 0.4, 0.3]\n\
                   forces.potential = \"R33 + R11\"\nevents.crossing = \"H3\"\n\
                   output = { end = 30, section = \"crossing\" }\n";
    let folder = folder(&[("section.toml", problem), ("wheel.toml", WHEEL)]);
    let svg = drawn(&folder, &["section", "section.toml", "--columns", "H1,H2"]);
    let simulated = run(folder.path(), &["simulate", "section.toml", "-o", "x.csv"], b"");
    assert_eq!(simulated.status, 0, "{}", simulated.err);
    let rows = fs::read_to_string(folder.path().join("x.csv")).unwrap().lines().count() - 1;
    assert!(rows > 3);
    let document = Document::parse(&svg).unwrap();
    assert_eq!(all(&document, "circle").count(), rows);
    let title = format!("section: section at crossing, {rows} points");
    assert!(texts(&svg).contains(&title));
    let rows = ["section", "section.toml", "--columns", "H1,H2", "--rows", "x.csv"];
    assert!(drawn(&folder, &rows) == svg);
    let cases: [(&[&str], i32, &str); 5] = [
        (&["section", "wheel.toml", "--columns", "H1,H2"], 1, "no section"),
        (&["phase", "wheel.toml", "--columns", "H"], 2, "two columns, not 3: H1, H2, H3"),
        (&["phase", "wheel.toml", "--columns", "H1"], 2, "not 1"),
        (&["series", "wheel.toml", "--columns", "height"], 2, "height"),
        (&["series", "wheel.toml"], 2, "--columns"),
    ];
    for (arguments, status, message) in cases {
        let refused = affinor(&folder, arguments);
        assert_eq!((refused.status, &*refused.out), (status, ""), "{arguments:?}");
        assert!(refused.err.contains(message), "{arguments:?}: {}", refused.err);
    }
}

/// Columns of the output and of the problem, and named quantities; each line has its caption in its
/// own colour.
#[test]
fn no_colour_is_used_twice() {
    let folder = folder(&[("wheel.toml", &format!("{WHEEL}quantities.half = \"H3/2\"\n"))]);
    let svg =
        drawn(&folder, &["series", "wheel.toml", "--columns", "half,g,H,h,Omega,omega,energy"]);
    let document = Document::parse(&svg).unwrap();
    let names: Vec<String> = ["half", "energy"].map(String::from).into_iter().collect();
    let mut names: BTreeSet<String> = names.into_iter().collect();
    for stem in ["H", "h", "Omega", "omega", "g1", "g2", "g3"] {
        names.extend((1..=3).map(|i| format!("{stem}{i}")));
    }
    assert!(texts(&svg).is_superset(&names), "{:?}", texts(&svg));
    let captions =
        all(&document, "text").filter(|node| names.contains(node.text().unwrap().trim()));
    let colours: Vec<&str> = captions.map(|node| node.attribute("fill").unwrap()).collect();
    assert_eq!(colours.len(), names.len());
    assert_eq!(colours.iter().collect::<BTreeSet<_>>().len(), names.len());
    // the axes end before the captions begin
    let plain = drawn(&folder, &["series", "wheel.toml", "--columns", "energy"]);
    assert!(texts(&plain).contains("energy") && texts(&plain).contains("time t"));
}

#[test]
fn the_drift_of_methods_is_compared() {
    let folder = TempDir::new().unwrap();
    let problem = example("body_in_potential");
    let methods =
        ["--method", "rkmk4", "--method", "cf4", "--method", "simo-wong", "--step", "0.1"];
    let absolute = drawn(&folder, &[&["drift", &problem][..], &methods].concat());
    let relative = drawn(&folder, &[&["drift", &problem, "--relative"][..], &methods].concat());
    for method in ["rkmk4", "cf4", "simo-wong"] {
        for quantity in ["energy", "vertical"] {
            let caption = format!("{quantity}, {method}");
            assert!(texts(&absolute).contains(&caption) && texts(&relative).contains(&caption));
        }
    }
    assert!(texts(&absolute).contains("largest absolute change |q(t) − q(0)|"));
    assert!(texts(&relative).contains("largest relative change |q(t) − q(0)| / |q(0)|"));
    // the height of the end of a line is the logarithm of its largest change: relative to an energy of 4.205
    assert_ne!(absolute, relative);
    let cases: [(&[&str], i32, &str); 4] = [
        (&["--set", "q=1"], 2, "`q` is not a parameter"),
        (&["--method", "euler"], 2, "unknown method `euler`"),
        (&["--method", "rkmk4"], 1, "--step H gives the step"),
        (&["--method", "rkmk54", "--method", "rkmk54"], 2, "is given twice"),
    ];
    for (arguments, status, message) in cases {
        let refused = affinor(&folder, &[&["drift", &problem][..], arguments].concat());
        assert_eq!((refused.status, &*refused.out), (status, ""), "{arguments:?}");
        assert!(refused.err.contains(message), "{arguments:?}: {}", refused.err);
    }
}

/// The slope in a caption is the median of the observed orders, next to lines with integer slopes.
#[test]
fn convergence_has_slopes() {
    let folder = TempDir::new().unwrap();
    let outcome =
        affinor(&folder, &["convergence", &example("body_in_potential"), "--halvings", "5"]);
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    let texts = texts(&outcome.out);
    for line in outcome.err.lines() {
        let (method, orders) = line.split_once(": observed orders: ").unwrap();
        let mut orders: Vec<f64> = orders.split(' ').map(|order| order.parse().unwrap()).collect();
        orders.sort_by(f64::total_cmp);
        let median = 0.5 * (orders[orders.len() / 2] + orders[(orders.len() - 1) / 2]);
        let slope = texts.iter().find_map(|text| text.strip_prefix(&format!("{method}, slope ")));
        let slope: f64 = slope.unwrap().parse().unwrap();
        assert!((slope - median).abs() <= 0.056, "{method}: {slope} {median}");
        assert!(texts.contains(&format!("slope {median:.0}")), "{texts:?}");
    }
}

/// The frames of the polygons of an animation.
fn frames(svg: &str) -> Vec<(String, Vec<Vec<[f64; 2]>>)> {
    let document = Document::parse(svg).unwrap();
    let films =
        all(&document, "animate").filter(|node| node.attribute("attributeName") == Some("points"));
    let film = |node: Node| {
        let values = node.attribute("values").unwrap().split(';').map(points).collect();
        let stroke = node.parent_element().unwrap().attribute("stroke").unwrap();
        (stroke.to_string(), values)
    };
    films.map(film).collect()
}

#[test]
fn a_film_shows_the_body_turn() {
    let folder = folder(&[("wheel.toml", WHEEL)]);
    let svg = drawn(&folder, &["animation", "wheel.toml", "--seconds", "4"]);
    assert!(drawn(&folder, &["animation", "wheel.toml", "--seconds", "4"]) == svg);
    for caption in
        ["axis 2 of inertia, moment 2", "axis 3 of inertia, moment 2.5", "t = 0", "t = 6.283185"]
    {
        assert!(texts(&svg).contains(caption), "{caption}");
    }
    let films = frames(&svg);
    // six faces, three axes before and behind the box, the time
    assert_eq!(films.len(), 6 + 3 + 3 + 1);
    let axis = |stroke: &str| {
        &films.iter().find(|(found, frames)| found == stroke && frames[0].len() == 2).unwrap().1
    };
    // the axis of the rotation is at rest; the first axis points the other way after half a turn
    let (first, third) = (axis("#a3173f"), axis("#1f4e9c"));
    assert_eq!(first.len(), 101);
    assert!(third.iter().all(|frame| distance(&frame[1], &third[0][1]) < 0.02));
    for k in 0..=50 {
        let (now, then) = (&first[k], &first[k + 50]);
        let sum = |end: usize| [now[end][0] + then[end][0], now[end][1] + then[end][1]];
        assert!(distance(&sum(0), &sum(1)) < 0.5, "{k}");
    }
    let document = Document::parse(&svg).unwrap();
    for node in all(&document, "animate") {
        assert_eq!(node.attribute("dur"), Some("4s"));
        assert_eq!(node.attribute("repeatCount"), Some("indefinite"));
        let Some(times) = node.attribute("keyTimes") else { continue };
        let times: Vec<f64> = times.split(';').map(|time| time.parse().unwrap()).collect();
        assert!(times[0] == 0.0 && times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
        let values = node.attribute("values").unwrap().split(';').count();
        assert!(values == times.len() && times[values - 1] < 1.0);
    }
    // of two opposite faces one is visible at a time
    let faces: Vec<_> = all(&document, "polygon")
        .filter(|node| node.attribute("stroke") == Some("#111111"))
        .collect();
    assert_eq!(faces.len(), 6);
    for pair in faces.chunks(2) {
        assert_ne!(pair[0].attribute("visibility"), pair[1].attribute("visibility"));
    }
    for seconds in ["0", "nan", "1000"] {
        let refused = affinor(&folder, &["animation", "wheel.toml", "--seconds", seconds]);
        assert_eq!((refused.status, &*refused.out), (2, ""), "{seconds}");
        assert!(refused.err.contains("--seconds"), "{}", refused.err);
    }
}

#[test]
fn films_stay_small_and_follow_the_position() {
    let fast = WHEEL.replace("[0, 0, 1]", "[0, 30, 200]");
    let folder = folder(&[("fast.toml", &fast)]);
    let outcome = affinor(&folder, &["animation", "fast.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.err);
    assert!(outcome.err.contains("radians between frames"), "{}", outcome.err);
    assert!(outcome.out.len() < 2_000_000, "{}", outcome.out.len());
    let body = drawn(&folder, &["animation", &example("kirchhoff")]);
    let films = frames(&body);
    let (_, face) = films.iter().find(|(stroke, _)| stroke == "#111111").unwrap();
    let centre = |frame: &Vec<[f64; 2]>| {
        let sum = frame.iter().fold([0.0, 0.0], |sum, at| [sum[0] + at[0], sum[1] + at[1]]);
        sum.map(|sum| sum / frame.len() as f64)
    };
    assert!(distance(&centre(&face[0]), &centre(&face[face.len() - 1])) > 100.0);
    assert!(texts(&body).contains("path of the body"));
    #[cfg(feature = "png")]
    {
        let still = affinor(&folder, &["animation", &example("kirchhoff"), "-o", "x.png"]);
        assert_eq!(still.status, 0, "{}", still.err);
        assert_eq!(fs::read(folder.path().join("x.png")).unwrap()[..4], *b"\x89PNG");
        let options = ["--seconds", "0.5", "--width", "200", "-o", "x.gif"];
        let film =
            affinor(&folder, &[&["animation", &example("kirchhoff")][..], &options].concat());
        assert_eq!(film.status, 0, "{}", film.err);
        let film = fs::read(folder.path().join("x.gif")).unwrap();
        assert_eq!(film[..6], *b"GIF89a");
        // ten frames, each after a block that controls it
        assert_eq!(film.windows(3).filter(|bytes| bytes == b"\x21\xf9\x04").count(), 10);
    }
}

/// A motion ends at its terminal event, in a picture too.
#[test]
fn a_picture_ends_at_the_terminal_event() {
    let stopping = format!("{BALL}events.floor = \"x2\"\n")
        .replace("{ end = 3 }", "{ end = 9, stop = \"floor\" }");
    // at rest at the start, the height changes its sign at t = 4
    let folder = folder(&[("ball.toml", &stopping.replace("12*x2", "12*x2 + 0*x1"))]);
    let svg = drawn(&folder, &["series", "ball.toml", "--columns", "x1"]);
    let numbers: Vec<f64> = texts(&svg).iter().filter_map(|text| text.parse().ok()).collect();
    let last = numbers.into_iter().fold(0.0, f64::max);
    // x1 = 3 t ends at 12
    assert!((10.0..13.0).contains(&last), "{last}");
}

/// The labels of an axis have equal distances, for values of every size.
#[test]
fn labels_at_every_scale() {
    for size in ["1e-300", "1e-30", "1e-10", "2e-5", "0.03", "1", "7e5", "3e12", "1e300"] {
        let ball = BALL.replace("[3, 12]", &format!("[{size}, 0]")).replace("12*x2", "0*x2");
        let folder = folder(&[("ball.toml", &ball.replace("end = 3", "end = 1"))]);
        let svg = drawn(&folder, &["series", "ball.toml", "--columns", "x1"]);
        let size: f64 = size.parse().unwrap();
        let numbers = texts(&svg).into_iter().filter_map(|text| text.parse::<f64>().ok());
        // the labels of the time axis are the same in every picture
        let time = |x: &f64| size != 1.0 && (*x * 10.0).fract() == 0.0 && (0.1..=1.0).contains(x);
        let mut labels: Vec<f64> = numbers.filter(|x| !time(x)).collect();
        labels.sort_by(f64::total_cmp);
        assert!((5..20).contains(&labels.len()), "{size}: {labels:?}");
        let step = labels[1] - labels[0];
        assert!(step > 0.0 && labels[0] >= -0.1 * size, "{size}: {labels:?}");
        let even = labels.windows(2).all(|pair| ((pair[1] - pair[0]) / step - 1.0).abs() < 1e-6);
        assert!(even, "{size}: {labels:?}");
        assert!(
            labels.last().is_some_and(|last| (0.8..1.1).contains(&(last / size))),
            "{labels:?}"
        );
    }
}

/// The options of `simulate` replace keys of the file in every picture of a trajectory.
#[test]
fn options_replace_keys_of_the_file() {
    let parameters = BALL.replace("end = 3", "end = \"T\"") + "parameters.T = 3\n";
    let other = parameters.replace("step = 0.5", "step = 0.25").replace("T = 3", "T = 2");
    let folder = folder(&[("a.toml", &parameters), ("b.toml", &other)]);
    let series = |file: &str, options: &[&str]| {
        let picture = ["series", file, "--columns", "x1,x2"];
        drawn(&folder, &[&picture[..], options].concat()).replace("b:", "a:")
    };
    let other = series("b.toml", &[]);
    for options in [
        &["--set", "T=2", "--step", "0.25"][..],
        &["--end", "2", "--step", "1/4"],
        &["--end=T - 1", "--method", "rkmk4", "--step", "1/4"],
    ] {
        assert_eq!(lines(&series("a.toml", options), ""), lines(&other, ""), "{options:?}");
    }
    assert_ne!(lines(&series("a.toml", &[]), ""), lines(&other, ""));
    let refused = affinor(&folder, &["attitude", "a.toml", "--rows", "r.csv", "--end", "1"]);
    assert_eq!(refused.status, 2, "{}", refused.err);
    assert!(refused.err.contains("cannot be used with"), "{}", refused.err);
}

/// A circle in the plane of two components is drawn as a circle.
#[test]
fn components_of_one_quantity_have_equal_units() {
    let folder = folder(&[("wheel.toml", WHEEL)]);
    let svg = drawn(&folder, &["phase", "wheel.toml", "--columns", "g11,g21"]);
    let path = lines(&svg, "#111111").into_iter().max_by_key(Vec::len).unwrap();
    let width = |k: usize| {
        let values = path.iter().map(|point| point[k]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    assert!(width(0) > 300.0 && (width(0) - width(1)).abs() < 3.0, "{} {}", width(0), width(1));
    // the angle of the rotation and its cosine have different units
    let svg = drawn(&folder, &["phase", "wheel.toml", "--columns", "t,g11"]);
    let path = lines(&svg, "#111111").into_iter().max_by_key(Vec::len).unwrap();
    let end = path[path.len() - 1];
    assert!(end[0] - path[0][0] > 400.0 && (end[1] - path[0][1]).abs() < 0.1);
}

/// If the ticks of a small range of large values would be equal floats, the range is widened.
/// Values near the largest float are an error.
#[test]
fn large_values() {
    let line = |from: &str, rate: &str, rest: &str| {
        let problem = format!(
            "space = \"R^1\"\nmetric = \"identity\"\ninitial = {{ coordinates = [{from}], velocity = [{rate}]{rest} }}\n\
             output = {{ end = 1, every = 0.1 }}\n"
        );
        folder(&[("a.toml", &problem)])
    };
    for (from, rate) in
        [("4.4e15", "1"), ("4.6e15", "1"), ("1e16", "1"), ("-1e17", "0"), ("1e299", "1e299")]
    {
        let svg = drawn(&line(from, rate, ""), &["series", "a.toml", "--columns", "x1"]);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{from}: {svg}");
    }
    let refused =
        affinor(&line("-1.7e308", "1.7e308", ""), &["series", "a.toml", "--columns", "x1"]);
    assert_eq!(refused.status, 1, "{}", refused.err);
    assert!(refused.err.contains("too large for a plot"), "{}", refused.err);
}

/// Positions and momenta whose squares are beyond the range of floats are rejected. No figure contains NaN.
#[test]
fn large_figures() {
    let problem = |space: &str, metric: &str, velocity: &str, end: f64| {
        let step = end / 10.0;
        let text = format!(
            "space = \"{space}\"\nmetric = \"diag({metric})\"\ninitial.velocity = [{velocity}]\n\
             integrator = {{ method = \"rkmk4\", step = {step:e} }}\noutput = {{ end = {end:e}, every = {step:e} }}\n"
        );
        folder(&[("a.toml", &text)])
    };
    let thrown =
        |size: f64| problem("se3", "1, 2, 3, 1, 1, 1", &format!("0, 0, 1, {size:e}, 0, 0"), 1.0);
    let turning =
        |size: f64| problem("so3", "1, 2, 3", &format!("{size:e}, 0, {size:e}"), 1.0 / size);
    for (kind, folder) in [("animation", thrown(1e160)), ("momentum", turning(1e160))] {
        let outcome = affinor(&folder, &[kind, "a.toml"]);
        assert_eq!(outcome.status, 1, "{kind}: {}", outcome.err);
        assert!(outcome.err.contains("too large to be drawn"), "{kind}: {}", outcome.err);
    }
    for (kind, folder) in [("animation", thrown(1e140)), ("momentum", turning(1e140))] {
        let svg = drawn(&folder, &[kind, "a.toml"]);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{kind}");
    }
}

/// Without `--method` the methods are those of the class of the problem, and so is the method of the reference.
#[test]
fn convergence_in_every_class() {
    for (name, end, methods) in [
        ("double_pendulum", "0.1", "generalised-alpha"),
        ("coning", "1", "magnus6"),
        ("toda", "1", "isospectral2 isospectral4"),
        ("free_body", "1", "rkmk4 cf4"),
        ("clairaut", "1", "dop853"),
    ] {
        let text = fs::read_to_string(example(name)).unwrap();
        let shorter = |line: &str| match line.split('=').next().map(str::trim) {
            Some("end") => format!("end = {end}\n"),
            Some("every") => format!("every = {end}\n"),
            _ => format!("{line}\n"),
        };
        let text: String = text.lines().map(shorter).collect();
        let folder = folder(&[("a.toml", &text)]);
        let outcome = affinor(&folder, &["convergence", "a.toml", "--halvings", "3"]);
        assert_eq!(outcome.status, 0, "{name}: {}", outcome.err);
        let found: Vec<&str> = outcome
            .err
            .lines()
            .filter_map(|line| line.split_once(": observed"))
            .map(|(m, _)| m)
            .collect();
        assert_eq!(found.join(" "), methods, "{name}: {}", outcome.err);
    }
    // a geodesic of a homogeneous space
    let flags = "space = 'Fl(3)'\nmetric = 'summands(1,2,3)'\noutput.end = 1\n\
                 initial.velocity = [0.1, 0.2, -0.3, 0.5, 0.4, 0.2]\n";
    let folder = folder(&[("flags.toml", flags)]);
    let outcome = affinor(&folder, &["convergence", "flags.toml", "--halvings", "3"]);
    let slopes = ["rkmk4, slope 4.0", "cf4, slope 4.0"];
    assert!(slopes.iter().all(|slope| outcome.out.contains(slope)), "{}", outcome.err);
    let outcome = affinor(
        &TempDir::new().unwrap(),
        &["convergence", &example("double_pendulum"), "--method", "magnus6"],
    );
    assert!(outcome.err.contains("generalised-alpha"), "{}", outcome.err);
}

/// The picture of an orbit is the projection of its embedding: the geodesic of a torus begins at
/// the distance `a + b` from the axis.
#[test]
fn an_orbit_in_space() {
    let folder = folder(&[]);
    let torus = example("clairaut");
    let svg = drawn(&folder, &["orbit", &torus, "--view", "0,90"]);
    assert!(svg.contains("curve in space"), "{svg}");
    let longest = lines(&svg, "").into_iter().max_by_key(Vec::len).unwrap();
    assert!(longest.len() > 20, "{}", longest.len());
    assert_ne!(svg, drawn(&folder, &["orbit", &torus, "--view", "28,20"]));
    let plain = affinor(&folder, &["orbit", &example("free_body")]);
    assert!(plain.err.contains("embedding"), "{}", plain.err);
}

/// Rows with gaps are read, and rows of different members are not joined by a line.
#[test]
fn rows_of_a_file() {
    let folder = folder(&[("wheel.toml", WHEEL)]);
    let draw = |rows: &str| {
        std::fs::write(folder.path().join("r.csv"), rows).unwrap();
        affinor(&folder, &["series", "wheel.toml", "--columns", "a", "--rows", "r.csv"])
    };
    let gaps = draw("t,a,b\n0,1,NaN\n1,2,inf\n2,3,-inf\n");
    assert_eq!(gaps.status, 0, "{}", gaps.err);
    assert_eq!(gaps.out, draw("t,a,b\n0,1,1\n1,2,1\n2,3,1\n").out);
    assert_eq!(draw("member,t,a\n1,0,1\n1,1,2\n").status, 0);
    let several = draw("member,t,a\n1,0,1\n1,1,2\n2,0,1\n2,1,2\n");
    assert_eq!(several.status, 2);
    assert!(several.err.contains("rows of several members, such as 1 and 2"), "{}", several.err);
}
