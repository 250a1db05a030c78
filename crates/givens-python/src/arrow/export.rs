//! Columns as a stream of one record batch.

use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::types::{
    ArrowTimestampType, TimestampMicrosecondType, TimestampMillisecondType, TimestampNanosecondType,
    TimestampSecondType,
};
use arrow_array::{
    Array, ArrayRef, Date32Array, Float64Array, Int64Array, LargeStringArray, PrimitiveArray, RecordBatch,
    RecordBatchIterator, RecordBatchOptions,
};
use arrow_buffer::NullBuffer;
use arrow_schema::{Field, Schema};
use numpy::{PyReadonlyArray1, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::arrow::import::STREAM;
use crate::errors::{Input, Result};
use crate::listed::Listed;
use crate::numbers::numbers;

/// A stream of one record batch; see the stub.
#[pyfunction]
pub fn arrow_stream<'py>(
    py: Python<'py>,
    columns: Listed<(String, String, Bound<'py, PyAny>)>,
) -> Result<Bound<'py, PyCapsule>> {
    let (mut fields, mut arrays) = (Vec::new(), Vec::new());
    for (name, kind, values) in &*columns {
        let array = column(kind, values)?;
        fields.push(Field::new(name, array.data_type().clone(), true));
        arrays.push(array);
    }
    let rows = arrays.first().map_or(0, |array: &ArrayRef| array.len());
    let schema = Arc::new(Schema::new(fields));
    let options = RecordBatchOptions::new().with_row_count(Some(rows));
    let batch = RecordBatch::try_new_with_options(Arc::clone(&schema), arrays, &options);
    let batch = batch.map_err(|error| Input::plain(error.to_string()))?;
    let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(batch)], schema)));
    // a stream that nobody takes out of the capsule is released with it
    Ok(PyCapsule::new_with_value(py, stream, STREAM)?)
}

/// One column of a kind.
fn column(kind: &str, values: &Bound<'_, PyAny>) -> Result<ArrayRef> {
    let (kind, zone) = match kind.strip_suffix(" UTC") {
        Some(unit) => (unit, Some(Arc::from("UTC"))),
        None => (kind, None),
    };
    Ok(match kind {
        "number" => Arc::new(floats(numbers(&values.extract::<PyReadonlyArrayDyn<'_, f64>>()?)?)),
        "whole" => Arc::new(Int64Array::from(integers(values)?)),
        "text" => {
            let (words, rows): (Listed<String>, PyReadonlyArray1<'_, i64>) = values.extract()?;
            let rows = rows.as_array();
            let each = words.iter().zip(rows).flat_map(|(word, &rows)| (0..rows).map(move |_| word));
            Arc::new(LargeStringArray::from_iter_values(each))
        }
        "D" => {
            let days: core::result::Result<Vec<i32>, _> =
                integers(values)?.into_iter().map(i32::try_from).collect();
            Arc::new(Date32Array::from(days.map_err(|error| Input::plain(error.to_string()))?))
        }
        "s" => instants::<TimestampSecondType>(values, zone)?,
        "ms" => instants::<TimestampMillisecondType>(values, zone)?,
        "us" => instants::<TimestampMicrosecondType>(values, zone)?,
        "ns" => instants::<TimestampNanosecondType>(values, zone)?,
        other => return Err(Input::plain(format!("no column is of the kind {other}")).into()),
    })
}

/// Numbers, of which those that are not known are null.
fn floats(values: Vec<f64>) -> Float64Array {
    let known = values.iter().any(|value| value.is_nan());
    let known = known.then(|| values.iter().map(|value| !value.is_nan()).collect::<NullBuffer>());
    Float64Array::new(values.into(), known)
}

fn integers(values: &Bound<'_, PyAny>) -> PyResult<Vec<i64>> {
    Ok(values.extract::<PyReadonlyArray1<'_, i64>>()?.as_array().to_vec())
}

fn instants<T: ArrowTimestampType>(values: &Bound<'_, PyAny>, zone: Option<Arc<str>>) -> Result<ArrayRef> {
    let array = PrimitiveArray::<T>::from_iter_values(integers(values)?);
    Ok(Arc::new(array.with_timezone_opt(zone)))
}
