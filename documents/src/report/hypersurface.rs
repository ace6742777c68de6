//! The extrinsic curvature of the hypersurfaces on which a function is constant.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::input::{InputError, Source};
use crate::space::Definition;
use affinor::Connection;
use affinor::geometry::hypersurface::Hypersurface;
use affinor_tensors::{Symbolic, Tensor, Tolerance};
use num_traits::Zero;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.hypersurface/1";
/// The number of characters above which a value is written in JSON only.
const LONGEST: usize = 600;

/// The hypersurfaces of a function, ready for output.
#[derive(Clone, Debug)]
pub struct HypersurfaceReport(Grid);

impl HypersurfaceReport {
    /// The hypersurfaces on which a function of the coordinates is constant.
    ///
    /// # Errors
    /// An error with its location for a text that is not a function; those of
    /// [`Definition::geometry`] and [`Hypersurface::new`].
    pub fn of(definition: &Definition, function: &str) -> Result<Self, InputError> {
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        let metric = geometry.metric().ok_or_else(|| definition.without_metric())?;
        let value = definition.formulas(&[]).scalar(&Source::new("--function", function))?;
        let connection = Connection::levi_civita(geometry.frame(), metric)?;
        let positive = definition.positive_factors();
        let found = Hypersurface::new(&connection, metric, &value, positive)?;
        Ok(Self::new(definition, &value, &found))
    }

    fn new(definition: &Definition, function: &Symbolic, found: &Hypersurface) -> Self {
        let mut rows: Vec<Vec<Cell>> = vec![];
        let mut row = |notion: &str, value: &str, remark: &str| {
            let value = if value.chars().count() > LONGEST { "in --format json" } else { value };
            rows.push(vec![notion.into(), value.into(), remark.into()]);
        };
        let normal = match found.sign {
            1 => "g(n,n) = 1",
            _ => "g(n,n) = -1",
        };
        row("unit normal", &components("n", &found.normal), normal);
        row("first form", &components("h", &found.first), "h_ij = g_ij - g(n,n) n_i n_j");
        row("second form", &components("K", &found.second), "K(x,y) = g(nabla_x n, y)");
        row("mean curvature", &found.mean_curvature.to_string(), "H = g^ij K_ij = div n");
        row("square", &found.square.to_string(), "K_ij K^ij");
        let gauss = "of the hypersurface, by the equation of Gauss";
        row("scalar curvature", &found.scalar_curvature.to_string(), gauss);
        let kind = match (found.second.is_empty(), found.mean_curvature.is_zero()) {
            (true, _) => "totally geodesic",
            _ if found.is_umbilic() => "umbilic",
            (_, true) => "minimal",
            _ => "none of: totally geodesic, umbilic, minimal",
        };
        row("kind", kind, "for all constants");
        if let Some((name, square)) = &found.length {
            row(
                &format!("{name}^2"),
                &square.to_string(),
                &format!("{name} > 0 is the length of the gradient"),
            );
        }
        let assumed: Vec<String> = found.assumed.iter().map(Symbolic::to_string).collect();
        if !assumed.is_empty() {
            row("assumed positive", &assumed.join(", "), "in the length of the normal");
        }
        let title = format!("Hypersurfaces of {}", printable(&definition.name));
        let head = vec![
            ("basis", printable_list(&definition.labels).into()),
            ("constant", function.to_string().into()),
        ];
        let json = json!({
            "schema": SCHEMA,
            "name": definition.name,
            "function": function.to_string(),
            "sign": found.sign,
            "normal": entries(&found.normal),
            "first": entries(&found.first),
            "second": entries(&found.second),
            "mean_curvature": found.mean_curvature.to_string(),
            "square": found.square.to_string(),
            "scalar_curvature": found.scalar_curvature.to_string(),
            "kind": kind,
            "length": found.length.as_ref().map(|(name, square)| {
                json!({ "name": name, "square": square.to_string() })
            }),
            "assumed_positive": assumed,
        });
        HypersurfaceReport(
            Grid::new(title, &["notion", "value", "remark"], rows, json).with_head(head),
        )
    }
}

/// The nonzero components, a line for each; of a symmetric tensor, those with ordered indices.
fn components(letter: &str, tensor: &Tensor<Symbolic>) -> String {
    let ordered = tensor.components().filter(|(at, _)| at.is_sorted());
    let lines: Vec<String> = ordered
        .map(|(at, value)| {
            let indices: Vec<String> = at.iter().map(|i| (i + 1).to_string()).collect();
            format!(
                "{letter}_{} = {value}",
                indices.join(if tensor.dimension() > 9 { "," } else { "" })
            )
        })
        .collect();
    if lines.is_empty() { "0".into() } else { lines.join("\n") }
}

fn entries(tensor: &Tensor<Symbolic>) -> Vec<Value> {
    let entry = |(at, value): (affinor_tensors::Indices, &Symbolic)| {
        json!([at.iter().map(|i| i + 1).collect::<Vec<_>>(), value.to_string()])
    };
    tensor.components().map(entry).collect()
}

impl Report for HypersurfaceReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
