//! Arrays of NumPy and plain memory.

use numpy::ndarray::{ArrayD, IxDyn};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::errors::{Input, Result};

/// The numbers of an array, row by row, however they lie in memory.
pub fn numbers(array: &PyReadonlyArrayDyn<'_, f64>) -> Vec<f64> {
    match array.as_slice() {
        Ok(slice) => slice.to_vec(),
        Err(_) => array.as_array().iter().copied().collect(),
    }
}

/// The numbers of an argument that must have this shape.
pub fn shaped(
    argument: &'static str,
    array: &PyReadonlyArrayDyn<'_, f64>,
    shape: &[usize],
) -> Result<Vec<f64>> {
    if array.shape() == shape {
        return Ok(numbers(array));
    }
    let message = format!("`{argument}` has shape {}, not {}", tuple(array.shape()), tuple(shape));
    Err(Input::new(argument, message).into())
}

/// A shape as Python writes it.
pub fn tuple(shape: &[usize]) -> String {
    let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
    match lengths.as_slice() {
        [one] => format!("({one},)"),
        all => format!("({})", all.join(", ")),
    }
}

/// An array that takes over the memory and cannot be written to.
pub fn frozen<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let array = ArrayD::from_shape_vec(IxDyn(shape), values);
    let array = array.map_err(|error| Input::plain(error.to_string()))?;
    let array = PyArrayDyn::from_owned_array(py, array);
    array.readwrite().make_nonwriteable();
    Ok(array)
}

/// Whole numbers as an array that cannot be written to.
pub fn counts(py: Python<'_>, values: impl Iterator<Item = usize>) -> Bound<'_, PyArray1<i64>> {
    let values = values.map(|value| i64::try_from(value).unwrap_or(i64::MAX));
    let array = PyArray1::from_iter(py, values);
    array.readwrite().make_nonwriteable();
    array
}
