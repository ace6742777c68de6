//! A differential form: its exterior derivative, Hodge star, codifferential and Laplacian.

use super::grid::{Cell, Grid};
use super::head::{printable, printable_list};
use super::{Format, Report};
use crate::input::InputError;
use crate::space::Definition;
use affinor::{Connection, Form, Geometry};
use affinor_tensors::text::combination;
use affinor_tensors::{Symbolic, Tolerance};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// The name of the schema.
const SCHEMA: &str = "affinor.forms/1";
/// The number of characters above which a form is written in JSON only.
const LONGEST: usize = 600;

/// The derivatives and the dual of a form, ready for output.
#[derive(Clone, Debug)]
pub struct FormReport(Grid);

impl FormReport {
    /// The report of a form, which a text defines. Without a metric, it has the exterior derivative
    /// only.
    ///
    /// # Errors
    /// Those of [`Definition::geometry`] and [`Definition::form`]; an error beyond dimension 8.
    pub fn of(definition: &Definition, text: &str) -> Result<Self, InputError> {
        let geometry = definition.geometry::<Symbolic>(Tolerance::default())?;
        let form = definition.form(text, &geometry)?;
        let (p, n) = (form.degree(), definition.dimension());
        let mut rows =
            Rows { names: dual_names(definition, &geometry), rows: vec![], json: Map::new() };
        rows.form("form", "form", &form, &format!("degree {p}"));
        if p < n {
            let derivative = geometry.frame().exterior_derivative(&form)?;
            let remark = if derivative.is_zero() { "closed" } else { "" };
            rows.form("d", "derivative", &derivative, remark);
        } else {
            rows.plain("d", "derivative", "0", "the degree is the dimension");
        }
        let mut assumed = vec![];
        if let Some(metric) = geometry.metric() {
            match metric.volume(definition.positive_factors()) {
                Ok((volume, functions)) => {
                    rows.form(
                        "star",
                        "star",
                        &metric.hodge_star(&form, &volume)?,
                        "a ^ *b = <a,b> vol",
                    );
                    let volume_of_frame =
                        format!("vol({}) > 0", printable_list(&definition.labels));
                    rows.plain("volume", "volume", &volume.to_string(), &volume_of_frame);
                    assumed = functions;
                }
                Err(error) => rows.plain("star", "star", "-", &error.to_string()),
            }
            let connection = Connection::levi_civita(geometry.frame(), metric)?;
            if p > 0 {
                let codifferential = connection.codifferential(metric, &form)?;
                let remark = if codifferential.is_zero() { "coclosed" } else { "-div" };
                rows.form("codifferential", "codifferential", &codifferential, remark);
            } else {
                rows.plain("codifferential", "codifferential", "0", "of a function");
            }
            let laplacian = connection.hodge_laplacian(metric, &form)?;
            let remark = match (laplacian.is_zero(), p) {
                (true, _) => "harmonic",
                (false, 0) => "-div grad, the negative of Laplace-Beltrami",
                (false, _) => "d delta + delta d",
            };
            rows.form("Laplacian", "laplacian", &laplacian, remark);
            let square = metric.form_product(&form, &form)?;
            rows.plain("square", "square", &square.to_string(), "<w,w> = 1/p! w_i... w^i...");
        } else {
            rows.plain("star", "star", "-", "needs a metric");
        }
        let assumed: Vec<String> = assumed.iter().map(Symbolic::to_string).collect();
        if !assumed.is_empty() {
            let text = assumed.join(", ");
            rows.rows.push(vec!["assumed positive".into(), text.into(), "in the volume".into()]);
        }
        let mut json = rows.json;
        json.insert("schema".into(), SCHEMA.into());
        json.insert("name".into(), definition.name.clone().into());
        json.insert("degree".into(), p.into());
        json.insert("forms".into(), rows.names.clone().into());
        json.insert("assumed_positive".into(), assumed.into());
        let title = format!("Form on {}", printable(&definition.name));
        let head = vec![("forms", printable_list(&rows.names).into())];
        let grid = Grid::new(title, &["notion", "value", "remark"], rows.rows, Value::Object(json));
        Ok(FormReport(grid.with_head(head)))
    }
}

/// The names of the dual forms of the frame: `dr` for the coordinate field `d_r`.
fn dual_names(definition: &Definition, geometry: &Geometry<Symbolic>) -> Vec<String> {
    let fields = geometry.frame_origin().fields();
    match fields.filter(|fields| fields.are_coordinates()) {
        Some(_) => definition.coordinates().iter().map(|name| format!("d{name}")).collect(),
        None => definition.labels.clone(),
    }
}

struct Rows {
    names: Vec<String>,
    rows: Vec<Vec<Cell>>,
    json: Map<String, Value>,
}

impl Rows {
    fn plain(&mut self, notion: &str, key: &str, value: &str, remark: &str) {
        self.rows.push(vec![notion.into(), shortened(value).into(), remark.into()]);
        self.json.insert(key.into(), value.into());
    }

    /// Adds a form. In JSON, it is a list of its components at increasing indices.
    fn form(&mut self, notion: &str, key: &str, form: &Form<Symbolic>, remark: &str) {
        let increasing = |at: &[usize]| at.windows(2).all(|pair| pair[0] < pair[1]);
        let components: Vec<_> =
            form.components().components().filter(|(at, _)| increasing(at)).collect();
        let product =
            |at: &[usize]| at.iter().map(|i| &*self.names[*i]).collect::<Vec<_>>().join("^");
        let text = match form.degree() {
            0 => form.components().get(&[]).to_string(),
            _ => combination(components.iter().map(|(at, v)| (v.to_string(), product(at)))),
        };
        self.rows.push(vec![notion.into(), shortened(&text).into(), remark.into()]);
        let entries = components.iter().map(|(at, value)| {
            json!([at.iter().map(|i| i + 1).collect::<Vec<_>>(), value.to_string()])
        });
        self.json.insert(key.into(), entries.collect());
    }
}

fn shortened(text: &str) -> &str {
    if text.chars().count() > LONGEST { "in --format json" } else { text }
}

impl Report for FormReport {
    fn write(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(format, out)
    }
}
