//! Arrays of NumPy and plain memory.

use numpy::ndarray::{ArrayD, Dimension, IxDyn};
use numpy::{
    Element, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArray, PyReadonlyArrayDyn, PyUntypedArrayMethods,
};
use pyo3::prelude::*;

use crate::errors::{Input, Result};

/// The numbers of an array, row by row, however they lie in memory.
///
/// # Errors
/// More than there is memory for: an array may repeat one number without end, and take none itself.
pub fn numbers(array: &PyReadonlyArrayDyn<'_, f64>) -> Result<Vec<f64>> {
    let mut values = Vec::new();
    if values.try_reserve_exact(array.len()).is_err() {
        let message = format!("an array of {} numbers is longer than there is memory for", array.len());
        return Err(Input::plain(message).into());
    }
    if !aligned(array) {
        // such as a part of a buffer of bytes; Rust must not look at it
        return numbers(&array.call_method0("copy")?.extract()?);
    }
    match array.as_slice() {
        Ok(slice) => values.extend_from_slice(slice),
        Err(_) => values.extend(array.as_array().iter()),
    }
    Ok(values)
}

/// Whether all numbers of an array lie where memory may be read as such.
pub fn aligned<T: Element, D: Dimension>(array: &PyReadonlyArray<'_, T, D>) -> bool {
    let to = align_of::<T>();
    let strides = array.strides().iter().all(|stride| stride.unsigned_abs() % to == 0);
    strides && (array.data() as usize).is_multiple_of(to)
}

/// The numbers of an argument that must have this shape.
pub fn shaped(
    argument: &'static str,
    array: &PyReadonlyArrayDyn<'_, f64>,
    shape: &[usize],
) -> Result<Vec<f64>> {
    if array.shape() == shape {
        return numbers(array);
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
