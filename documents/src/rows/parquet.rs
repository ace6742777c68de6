//! Writes runs in Parquet: for each name, a required column of doubles.

use super::{Head, Rows};
use ::parquet::basic::{Repetition, Type as Physical};
use ::parquet::data_type::DoubleType;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;
use std::io::{self, Write};
use std::sync::Arc;

/// The number of rows in a row group, which is buffered in memory.
const GROUP: usize = 1 << 16;

pub(super) fn write(head: &Head, rows: &mut Rows, out: &mut dyn Write) -> io::Result<()> {
    let fields: Result<Vec<_>, _> = head.columns.iter().map(|name| column(name)).collect();
    let schema = Type::group_type_builder("run").with_fields(fields.map_err(io::Error::other)?);
    let schema = Arc::new(schema.build().map_err(io::Error::other)?);
    let text = |key: &str, value: &str| KeyValue::new(key.to_string(), value.to_string());
    let said = vec![text("name", &head.name), text("method", &head.method)];
    let properties = WriterProperties::builder().set_key_value_metadata(Some(said)).build();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties))
        .map_err(io::Error::other)?;
    let mut columns = vec![Vec::with_capacity(GROUP); head.columns.len()];
    let mut held = 0;
    for row in rows {
        for (column, value) in columns.iter_mut().zip(row?) {
            column.push(value);
        }
        held += 1;
        if held == GROUP {
            group(&mut writer, &mut columns).map_err(io::Error::other)?;
            out.write_all(writer.inner_mut())?;
            writer.inner_mut().clear();
            held = 0;
        }
    }
    if held > 0 {
        group(&mut writer, &mut columns).map_err(io::Error::other)?;
    }
    out.write_all(&writer.into_inner().map_err(io::Error::other)?)
}

fn column(name: &str) -> Result<Arc<Type>, ParquetError> {
    let column = Type::primitive_type_builder(name, Physical::DOUBLE);
    Ok(Arc::new(column.with_repetition(Repetition::REQUIRED).build()?))
}

fn group(
    writer: &mut SerializedFileWriter<Vec<u8>>,
    columns: &mut [Vec<f64>],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for values in columns {
        if let Some(mut column) = group.next_column()? {
            column.typed::<DoubleType>().write_batch(values, None, None)?;
            column.close()?;
        }
        values.clear();
    }
    group.close()?;
    Ok(())
}
