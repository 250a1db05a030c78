//! What tables that are cut together have in common.

use arrow_schema::{Field, Schema, SchemaRef};
use std::sync::Arc;

use super::rows::Table;
use crate::error::InputErrors;
use crate::source::whole;

/// The columns that all tables have.
pub(super) fn alike(tables: &[Table]) -> Result<SchemaRef, InputErrors> {
    let Some(first) = tables.first() else { return Err(whole("the tables", "there is none").into()) };
    for table in tables {
        let fields = |table: &Table| -> Vec<_> {
            table
                .schema
                .fields()
                .iter()
                .map(|field| (field.name().clone(), field.data_type().clone()))
                .collect()
        };
        let (own, others) = (fields(table), fields(first));
        if own != others {
            let differ = own.iter().zip(&others).find(|(a, b)| a != b);
            let what = differ.map_or_else(
                || format!("it has {} columns, and {} has {}", own.len(), first.name, others.len()),
                |(a, b)| format!("its column `{}` ({}) is `{}` ({}) in {}", a.0, a.1, b.0, b.1, first.name),
            );
            let error = whole(&table.name, what);
            return Err(error
                .with_help(
                    "tables that are cut together have the same columns in one order; one of a CSV holds words if any \
                     of its cells is no number",
                )
                .into());
        }
    }
    // what is missing in one table may be missing
    let missing = |k: usize| tables.iter().any(|table| table.schema.field(k).is_nullable());
    let fields = first.schema.fields().iter().enumerate();
    let fields = fields.map(|(k, field)| Field::clone(field).with_nullable(missing(k))).collect::<Vec<_>>();
    Ok(Arc::new(Schema::new_with_metadata(fields, first.schema.metadata().clone())))
}
