//! The diagram of cost over accuracy.

use affinor_documents::figures::diagram::{Diagram, Drawn, Graph, Line, Scale};
use affinor_documents::picture::{diagram, svg};

/// Reads rows and writes SVG: a panel for each problem, a line for each method.
pub fn draw() {
    let mut graphs: Vec<(String, Graph)> = vec![];
    for row in csv::Reader::from_reader(std::io::stdin()).records() {
        let row = row.expect("a row");
        let (Ok(error), Ok(seconds)) = (row[3].parse::<f64>(), row[4].parse::<f64>()) else {
            continue;
        };
        // beyond this no one looks
        if !(1e-15..=1e-1).contains(&error) {
            continue;
        }
        let at = graphs.iter().position(|(problem, _)| *problem == row[0]).unwrap_or_else(|| {
            let x = Scale::logarithmic(&format!("error: {}", &row[0]));
            let y = Scale::logarithmic("CPU seconds");
            graphs.push((row[0].into(), Graph { x, y, equal: false, lines: vec![] }));
            graphs.len() - 1
        });
        let lines = &mut graphs[at].1.lines;
        let line = lines.iter().position(|line| line.caption == row[1]).unwrap_or_else(|| {
            lines.push(Line { caption: row[1].into(), points: vec![], drawn: Drawn::Marked });
            lines.len() - 1
        });
        lines[line].points.push([error, seconds]);
    }
    let title = "CPU time over the error at the end".into();
    let graphs: Vec<Graph> = graphs.into_iter().map(|(_, graph)| graph).collect();
    let width = 560 * graphs.len() as u32;
    println!("{}", svg(&diagram(&Diagram { title, graphs }), width));
}
