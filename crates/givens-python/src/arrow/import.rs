//! A table that another library lends.

use core::ffi::CStr;

use arrow_array::cast::AsArray;
use arrow_array::ffi_stream::{FFI_ArrowArrayStream, RecordBatchStreamReader};
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, RecordBatchReader};
use arrow_schema::{ArrowError, DataType, Schema};
use numpy::ndarray::ArrayView1;
use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyCapsuleMethods, PyString};

use crate::errors::{Input, Result};
use givens_io::decode::{Kind, floats, integers, kind, texts, unsigned};

/// The name that the protocol gives to capsules of streams.
pub const STREAM: &CStr = c"arrow_array_stream";

/// What NumPy writes for no date and no duration.
const NO_TIME: i64 = i64::MIN;

/// The columns of a table; see the stub. They stay where they are, in the other library's memory.
#[pyclass(module = "givens._native", frozen)]
#[derive(Debug)]
pub struct ArrowTable {
    schema: Schema,
    /// Of each column, the arrays that stand below each other.
    columns: Vec<Vec<ArrayRef>>,
    rows: usize,
}

#[pymethods]
impl ArrowTable {
    /// Takes the stream out of a capsule and reads it to its end; see the stub.
    #[staticmethod]
    fn read(py: Python<'_>, capsule: &Bound<'_, PyAny>) -> Result<Self> {
        let stream = taken(capsule)?;
        // a producer may need the interpreter on threads of its own
        let read = py.detach(move || -> core::result::Result<Self, ArrowError> {
            let reader = RecordBatchStreamReader::try_new(stream)?;
            let schema = Schema::clone(&reader.schema());
            let (mut columns, mut rows) = (vec![Vec::new(); schema.fields().len()], 0);
            for batch in reader {
                let batch = batch?;
                rows += batch.num_rows();
                for (column, array) in columns.iter_mut().zip(batch.columns()) {
                    column.push(ArrayRef::clone(array));
                }
            }
            Ok(Self { schema, columns, rows })
        });
        read.map_err(|error| Input::plain(format!("the table could not be read: {error}")).into())
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    #[getter]
    fn names(&self) -> Vec<&String> {
        self.schema.fields().iter().map(|field| field.name()).collect()
    }

    /// Kind, unit and values of a column; see the stub.
    fn column<'py>(
        slf: &Bound<'py, Self>,
        index: usize,
    ) -> Result<(&'static str, &'static str, Bound<'py, PyAny>)> {
        let (py, table) = (slf.py(), slf.get());
        let Some(arrays) = table.columns.get(index) else {
            return Err(PyIndexError::new_err("the table has fewer columns").into());
        };
        let of = table.schema.field(index).data_type();
        let whole = arrays.iter().all(|array| array.logical_null_count() == 0);
        let counted = || {
            let counts = gather(arrays, integers).into_iter().map(|count| count.unwrap_or(NO_TIME));
            counts.collect::<Vec<i64>>().into_pyarray(py).into_any()
        };
        Ok(match kind(of) {
            Kind::Whole if whole => ("whole", "", counted()),
            Kind::Unsigned if whole => ("whole", "", gather(arrays, unsigned).into_pyarray(py).into_any()),
            Kind::Number | Kind::Whole | Kind::Unsigned => ("number", "", Self::numbers(slf, arrays)),
            Kind::Date(unit, false) => ("date", unit, counted()),
            Kind::Date(unit, true) => ("zoned", unit, counted()),
            Kind::Duration(unit) => ("duration", unit, counted()),
            Kind::Text => ("text", "", gather(arrays, texts).into_pyobject(py)?),
            Kind::Other => ("other", "", PyString::new(py, &of.to_string()).into_any()),
        })
    }
}

impl ArrowTable {
    /// A column as numbers: without a copy if it is one array of them that has no nulls.
    fn numbers<'py>(slf: &Bound<'py, Self>, arrays: &[ArrayRef]) -> Bound<'py, PyAny> {
        match arrays {
            [one] if *one.data_type() == DataType::Float64 && one.null_count() == 0 => {
                Self::lent(slf, one.as_primitive::<Float64Type>().values())
            }
            _ => gather(arrays, floats).into_pyarray(slf.py()).into_any(),
        }
    }

    /// Numbers of one of the table's own arrays, where they are.
    #[allow(unsafe_code)]
    fn lent<'py>(slf: &Bound<'py, Self>, values: &[f64]) -> Bound<'py, PyAny> {
        // SAFETY: the values stand in an array of `slf`, which cannot change and which NumPy keeps alive as long as it
        // looks at them; by Arrow's protocol nobody writes to them, and NumPy is forbidden to in the next line
        let array = unsafe { PyArray1::borrow_from_array(&ArrayView1::from(values), slf.clone().into_any()) };
        array.readwrite().make_nonwriteable();
        array.into_any()
    }
}

/// One column of arrays below each other.
fn gather<V>(arrays: &[ArrayRef], read: impl Fn(&dyn Array) -> Vec<V>) -> Vec<V> {
    arrays.iter().flat_map(|array| read(array)).collect()
}

/// Takes the stream out of a capsule, which is left empty.
#[allow(unsafe_code)]
pub fn taken(capsule: &Bound<'_, PyAny>) -> Result<FFI_ArrowArrayStream> {
    let found = capsule.cast::<PyCapsule>().ok();
    let Some(pointer) = found.and_then(|capsule| capsule.pointer_checked(Some(STREAM)).ok()) else {
        return Err(Input::plain("`__arrow_c_stream__` gives no capsule with a stream").into());
    };
    // SAFETY: by Arrow's protocol a capsule of this name points to a stream, valid as long as the capsule, that whoever
    // is given the capsule may move out; what is left behind there says that it has been
    Ok(unsafe { FFI_ArrowArrayStream::from_raw(pointer.as_ptr().cast()) })
}
