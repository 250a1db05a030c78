//! Sequences of Python, of which no more is believed than there is memory for.

use core::ops::Deref;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;

use crate::errors::Input;

/// The items of a sequence. `Vec` by itself makes room for as many as the sequence says it has, and that there is no such
/// room ends the program.
pub struct Listed<T>(pub Vec<T>);

impl<T> Default for Listed<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Deref for Listed<T> {
    type Target = Vec<T>;
    fn deref(&self) -> &Vec<T> {
        &self.0
    }
}

impl<'py, T: FromPyObjectOwned<'py>> FromPyObject<'_, 'py> for Listed<T> {
    type Error = PyErr;

    fn extract(object: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let said = object.len().unwrap_or(0);
        if Vec::<T>::new().try_reserve_exact(said).is_err() {
            let message = format!("a sequence says that it has {said} items, more than there is memory for");
            return Err(Input::plain(message).into());
        }
        object.extract().map(Self)
    }
}
