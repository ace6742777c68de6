//! Motions of the problems of `affinor simulate`, with the drift of their conserved quantities by several methods.

use super::Refusal;
use super::transport::short;
use affinor::mechanics::Inertia;
use affinor::mechanics::simulation::Method;
use affinor_documents::input::InputError;
use affinor_documents::problem::{Problem, Ready};
use affinor_documents::report::{Report, listing};
use affinor_documents::rows::RunRows;
use nalgebra::Matrix3;
use serde_json::{Value, json};

/// The largest number of rows.
const ROWS: usize = 20_000;

/// A run: its rows, and the columns that should be conserved.
struct Run {
    method: String,
    rows: RunRows,
    watched: Vec<String>,
}

/// The motion of a problem, and the drift with its own method and with others, separated by commas.
pub(super) fn motion(text: &str, methods: &str) -> Result<Box<dyn Report>, Refusal> {
    let problem = Problem::parse("problem.toml", text)?;
    if problem.times(0)?.len() > ROWS {
        let help = "make `every` longer or `end` earlier";
        return Err(InputError::usage(format!("more than {ROWS} rows")).help(help).into());
    }
    let ready = problem.motion(0)?;
    let inertia = body(&ready);
    let own = run(&problem, ready)?;
    let mut drifts = drifts(&own);
    for name in methods.split(',').map(str::trim).filter(|name| !name.is_empty()) {
        let method = Method::from_name(name)
            .ok_or_else(|| Refusal::new(format!("`{name}` is not a method")))?;
        if method.name() == own.method {
            continue;
        }
        let other = problem.with_method(method, None, None);
        match other.motion(0).map_err(Refusal::from).and_then(|ready| run(&other, ready)) {
            Ok(run) => drifts.extend(self::drifts(&run)),
            Err(refusal) => {
                drifts.push(json!({ "method": name, "refused": refusal.json()["message"] }))
            }
        }
    }
    let attitudes = own.rows.attitudes(None).ok();
    let places =
        own.rows.vectors(["x", "y", "z"]).or_else(|_| own.rows.vectors(["g14", "g24", "g34"]));
    let edges = inertia.as_ref().map(|inertia| {
        let turned = |r: &Matrix3<f64>| r * inertia.axes();
        (inertia.box_edges(), attitudes.iter().flatten().map(turned).collect::<Vec<_>>())
    });
    let json = json!({
        "schema": "affinor.motion/1",
        "name": own.rows.name,
        "method": own.method,
        "columns": own.rows.columns,
        "watched": own.watched,
        "rows": own.rows.rows,
        "edges": edges.as_ref().map(|(edges, _)| short(edges)),
        "poses": edges.map(|(_, poses)| poses.iter().map(columns).collect::<Vec<_>>()),
        "places": places.ok().map(|all| all.iter().map(short).collect::<Vec<_>>()),
        "drifts": drifts,
    });
    let header: Vec<&str> = own.rows.columns.iter().map(String::as_str).collect();
    let rows = own.rows.rows.iter().map(|row| row.iter().map(f64::to_string).collect()).collect();
    Ok(Box::new(listing(&format!("{} by {}", own.rows.name, own.method), &header, rows, json)))
}

fn run(problem: &Problem, ready: Ready) -> Result<Run, Refusal> {
    let method = ready.method.name().to_string();
    let columns: Vec<String> = ready.columns.iter().map(|column| column.name.clone()).collect();
    let watched = ready.columns.iter().filter(|column| column.watched);
    let watched = watched.map(|column| column.name.clone()).collect();
    let mut integration = problem.integrate(ready);
    let mut rows = vec![];
    loop {
        let step = integration.step()?;
        rows.extend(step.rows);
        if step.done {
            break;
        }
    }
    Ok(Run { method, rows: RunRows { name: problem.name.clone(), columns, rows }, watched })
}

/// The inertia of the rotations, for a picture of the body.
fn body(ready: &Ready) -> Option<Inertia> {
    let matrix = ready.inertia.as_ref().filter(|matrix| [3, 6].contains(&matrix.nrows()))?;
    Inertia::new(&matrix.fixed_view::<3, 3>(0, 0).into_owned()).ok()
}

/// The largest change so far of the energy, the spatial momentum, Casimir functions and named quantities.
fn drifts(run: &Run) -> Vec<Value> {
    let quantity = |name: &String| {
        let values = run.rows.column(name).ok()?;
        let first = *values.first()?;
        let largest = values.iter().scan(0.0f64, |largest, value| {
            *largest = largest.max((value - first).abs());
            Some(*largest)
        });
        let largest: Vec<f64> = largest.collect();
        Some(json!({ "method": run.method, "quantity": name, "start": first, "changes": largest }))
    };
    run.watched.iter().filter_map(quantity).collect()
}

/// The columns of a matrix.
fn columns(matrix: &Matrix3<f64>) -> Value {
    json!([0, 1, 2].map(|i| short(&matrix.column(i).into_owned())))
}
