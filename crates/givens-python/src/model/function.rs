//! Functions that are not made of expressions: of Python, and by address.

use numpy::{AllowTypeChange, IntoPyArray, PyArray1, PyArrayLikeDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::errors::{Input, Result};
use crate::listed::Listed;
use crate::numbers::{numbers, tuple};
use crate::watch;

/// void f(double t, const double *x, const double *p, double *out)
type Plain = unsafe extern "C" fn(f64, *const f64, *const f64, *mut f64);
/// void f(double t, double dt, const double *x, const double *p, double *out)
type Stepped = unsafe extern "C" fn(f64, f64, *const f64, *const f64, *mut f64);

/// A function of a model that is not made of expressions.
#[pyclass(module = "givens._native", frozen)]
#[derive(Debug)]
pub struct Function(pub How);

/// How it is called.
#[derive(Debug)]
pub enum How {
    /// f(t, dt, x, u, p) of Python; x is n × points and the result d × points.
    Callable(Py<PyAny>),
    /// A function of C, which reads the controls behind the parameters.
    Plain(Plain, Owned),
    /// The same with the length of the step.
    Stepped(Stepped, Owned),
}

/// What a function of C is called with besides where it is.
#[derive(Debug)]
pub struct Owned {
    /// Keeps the function where it is.
    owner: Py<PyAny>,
    /// Which of the model's parameters are its own, in its order; all of them if it does not say.
    parameters: Option<Box<[usize]>>,
}

impl Owned {
    fn again(&self, py: Python<'_>) -> Self {
        Self { owner: self.owner.clone_ref(py), parameters: self.parameters.clone() }
    }

    /// Its parameters, the controls behind them, and a zero so that there is no empty array.
    fn numbers(&self, at: &Place) -> Vec<f64> {
        let own: Vec<f64> = match &self.parameters {
            Some(places) => places.iter().map(|&i| at.p.get(i).copied().unwrap_or(f64::NAN)).collect(),
            None => at.p.to_vec(),
        };
        own.iter().chain(at.u).copied().chain([0.0]).collect()
    }
}

impl How {
    /// The same function again.
    pub fn again(&self, py: Python<'_>) -> Self {
        match self {
            How::Callable(f) => How::Callable(f.clone_ref(py)),
            How::Plain(f, owner) => How::Plain(*f, owner.again(py)),
            How::Stepped(f, owner) => How::Stepped(*f, owner.again(py)),
        }
    }

    /// Whether a call needs the interpreter.
    pub fn needs_python(&self) -> bool {
        matches!(self, How::Callable(_))
    }
}

#[pymethods]
impl Function {
    /// A function of Python; see the stub.
    #[staticmethod]
    fn callable(py: Python<'_>, function: Py<PyAny>) -> Result<Self> {
        if !function.bind(py).is_callable() {
            return Err(PyTypeError::new_err("a function of a model must be callable").into());
        }
        Ok(Self(How::Callable(function)))
    }

    /// A function of C at an address; see the stub. `owner` is kept alive as long as the function may be called.
    #[staticmethod]
    #[pyo3(signature = (address, owner, *, step=false, parameters=None))]
    #[allow(unsafe_code)]
    fn address(
        address: usize,
        owner: Py<PyAny>,
        step: bool,
        parameters: Option<Listed<usize>>,
    ) -> Result<Self> {
        if address == 0 {
            return Err(Input::new("address", "the address of the function is null").into());
        }
        let owner = Owned { owner, parameters: parameters.map(|all| all.0.into_boxed_slice()) };
        let pointer = core::ptr::without_provenance::<()>(address);
        // SAFETY: the address is not null, and the user says that a function of this signature stands there: nothing else
        // can be known about it. The owner keeps it there.
        let how = unsafe {
            if step {
                How::Stepped(core::mem::transmute::<*const (), Stepped>(pointer), owner)
            } else {
                How::Plain(core::mem::transmute::<*const (), Plain>(pointer), owner)
            }
        };
        Ok(Self(how))
    }
}

/// Where a function is called, in plain numbers.
pub struct Place<'a> {
    pub t: f64,
    pub dt: f64,
    pub u: &'a [f64],
    pub p: &'a [f64],
}

impl How {
    /// Evaluates `points` points, component by component: `x` is n × `points`, and `out` of this shape is d × `points`, or
    /// a matrix at one point. An exception ends the run on this thread.
    pub fn call(&self, what: &str, at: &Place, points: usize, x: &[f64], out: &mut [f64], shape: [usize; 2]) {
        match self {
            How::Callable(f) => {
                let called = Python::attach(|py| python(py, f.bind(py), what, at, points, x, out, shape));
                if let Err(error) = called {
                    out.fill(f64::NAN);
                    watch::raise(error);
                }
            }
            How::Plain(_, owned) | How::Stepped(_, owned) => {
                self.by_address(at, &owned.numbers(at), points, x, out);
            }
        }
    }

    #[allow(unsafe_code)]
    fn by_address(&self, at: &Place, p: &[f64], points: usize, x: &[f64], out: &mut [f64]) {
        let (n, d) = (x.len() / points.max(1), out.len() / points.max(1));
        let (mut point, mut image) = (vec![0.0; n.max(1)], vec![f64::NAN; d.max(1)]);
        for k in 0..points {
            (0..n).for_each(|i| point[i] = x[i * points + k]);
            let (from, p, to) = (point.as_ptr(), p.as_ptr(), image.as_mut_ptr());
            // SAFETY: the pointers are to arrays of the lengths that the signature promises (n, parameters and controls,
            // d), which nobody else uses; that the function keeps to them is the user's word, as its address is.
            match self {
                How::Plain(f, _) => unsafe { f(at.t, from, p, to) },
                How::Stepped(f, _) => unsafe { f(at.t, at.dt, from, p, to) },
                How::Callable(_) => {}
            }
            (0..d).for_each(|i| out[i * points + k] = image[i]);
        }
    }
}

/// Calls a function of Python with all points at once.
fn python(
    py: Python<'_>,
    f: &Bound<'_, PyAny>,
    what: &str,
    at: &Place,
    points: usize,
    x: &[f64],
    out: &mut [f64],
    shape: [usize; 2],
) -> PyResult<()> {
    let states = PyArray1::from_slice(py, x).reshape([x.len() / points.max(1), points])?;
    let (u, p) = (at.u.to_vec().into_pyarray(py), at.p.to_vec().into_pyarray(py));
    let result = f.call1((at.t, at.dt, states, u, p))?;
    let none = result.is_none();
    let values = result.extract::<PyArrayLikeDyn<'_, f64, AllowTypeChange>>().ok().filter(|_| !none);
    let Some(values) = values else {
        let found = result.get_type().name()?.to_string();
        return Err(Input::plain(format!("`{what}` gave {found}, which is not an array of numbers")).into());
    };
    // one column may stand without its dimension, and one row
    let flat = values.ndim() <= 1 && values.len() == out.len() && shape.contains(&1);
    if values.shape() != shape && !flat {
        let (found, expected) = (tuple(values.shape()), tuple(&shape));
        let message = format!("`{what}` gave an array of shape {found}, not {expected}");
        let help = "it is called with all points at once: x[i] is component i of all of them";
        return Err(Input::plain(message).help(help).into());
    }
    out.copy_from_slice(&numbers(&values)?);
    Ok(())
}
